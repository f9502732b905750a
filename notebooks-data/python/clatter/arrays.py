# SPDX-License-Identifier: GPL-3.0-or-later
"""NumPy's arrays where NumPy is installed; without it numbers come as lists."""

from __future__ import annotations

from collections.abc import Iterable
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


def numbers(values: Iterable[Any]) -> Array:
    """An array of numbers or of rows of numbers; the list itself without NumPy."""
    try:
        numpy = numpy_for("an array")
    except ImportError:
        return list(values)  # type: ignore[return-value]
    array: Array = numpy.array(list(values), dtype=float)
    return array


def words(values: Iterable[Any]) -> Array:
    """An array of texts or truths; the list itself without NumPy."""
    try:
        numpy = numpy_for("an array")
    except ImportError:
        return list(values)  # type: ignore[return-value]
    array: Array = numpy.array(list(values))
    return array
