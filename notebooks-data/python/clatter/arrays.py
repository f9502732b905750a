# SPDX-License-Identifier: GPL-3.0-or-later
"""NumPy's arrays where NumPy is installed; without it numbers come as lists."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]
else:
    Array = Any


def numpy_for(what: str) -> ModuleType:
    """NumPy.  @raise ImportError: it is not installed, and `what` needs it."""
    try:
        import numpy
    except ImportError as error:
        raise ImportError(f"{what} needs NumPy: pip install numpy, or Debian's package python3-numpy") from error
    return numpy


def numbers(values: Iterable[Any], kind: type = float) -> Array:
    """An array of numbers or of rows of numbers; the list itself without NumPy."""
    try:
        numpy = numpy_for("an array")
    except ImportError:
        return list(values)  # type: ignore[return-value]
    array: Array = numpy.array(list(values), dtype=kind)
    return array


def words(values: Iterable[Any]) -> Array:
    """An array of texts or truths; the list itself without NumPy."""
    try:
        numpy = numpy_for("an array")
    except ImportError:
        return list(values)  # type: ignore[return-value]
    array: Array = numpy.array(list(values))
    return array


def lists(values: list[Any]) -> Array:
    """An array of lists, each as long as it is; the list itself without NumPy."""
    try:
        numpy = numpy_for("an array")
    except ImportError:
        return values  # type: ignore[return-value]
    array: Array = numpy.empty(len(values), dtype=object)
    array[:] = values
    return array


def frozen(array: Array) -> Array:
    """Not to be changed by accident; without NumPy the list as it is."""
    if hasattr(array, "flags"):
        array.flags.writeable = False
    return array


def same_arrays(some: Mapping[str, Array], others: Mapping[str, Array]) -> bool:
    """Whether both have the same values under the same names, NaN being equal to NaN."""
    numpy = numpy_for("an array")
    return some.keys() == others.keys() and all(
        numpy.array_equal(array, others[name], equal_nan=array.dtype.kind == "f") for name, array in some.items())
