# SPDX-License-Identifier: GPL-3.0-or-later
"""Small objects over the program's JSON: each name of the JSON is an attribute."""

from collections.abc import ItemsView, Iterable, Iterator, Mapping, ValuesView
from typing import TYPE_CHECKING, Any, overload

from clatter import _clatter
from clatter.arrays import Array, frozen, lists, numbers, same_arrays, words

JsonObject = Mapping[str, Any]


def as_array(values: list[Any]) -> Array:
    """Numbers as an array with NaN for None; vectors as rows, lists of other lengths as they are."""
    nan = float("nan")
    wide = {len(value) for value in values if isinstance(value, list)}
    if len(wide) > 1:
        return lists(values)
    if wide:
        return numbers([nan] * max(wide) if value is None else value for value in values)
    if any(isinstance(value, (str, bool)) for value in values):
        return words(values)
    if values and all(type(value) is int for value in values):
        return numbers(values, int)
    return numbers(nan if value is None else value for value in values)


def absent(name: str, known: Iterable[str]) -> str:
    """What is said of a name that there is not: those that begin so, else the nearest one, or if none is near all that there are."""
    names = list(known)
    near = [one for one in names if name and one.startswith(name)][:5]
    meant = f"; did you mean {', '.join(near)}?" if near else _clatter.suggestion(name, names)
    return f"no '{name}' here" + (meant or f"; there are {', '.join(names)}")


def value_of(row: JsonObject, name: str) -> Any:
    """A value of a row by its name, by that of its error, as impulse_normal_error, or of a vector's part, as velocity_after_z.

    @raise KeyError: there is none, with those that there are.
    """
    if name in row and not isinstance(row[name], dict):
        return row[name]
    errors = row.get("error_estimate") or {}
    if name.endswith("_error") and name.removesuffix("_error") in row:
        return errors.get(name.removesuffix("_error"))
    whole, _, part = name.rpartition("_")
    if part in ("x", "y", "z") and isinstance(row.get(whole), list):
        return row[whole]["xyz".index(part)]
    if isinstance(row.get(name), dict):
        raise KeyError(f"'{name}' is no number; its numbers are {', '.join(f'{key}_error' for key in errors)}")
    raise KeyError(absent(name, row))


def flat(row: JsonObject) -> dict[str, Any]:
    """A row as columns of numbers: a vector's parts as NAME_x, NAME_y, NAME_z, Euler parameters as NAME_q0 ..., errors as
    NAME_error."""
    columns: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, dict):
            is_error = name == "error_estimate"
            columns |= {f"{key}_error" if is_error else f"{name}_{key}": part for key, part in flat(value).items()}
        elif isinstance(value, (list, tuple)) or getattr(value, "ndim", 0) == 1:
            parts = "xyz" if len(value) == 3 else [f"q{i}" for i in range(len(value))]
            columns |= {f"{name}_{part}": number for part, number in zip(parts, value)}
        else:
            columns[name] = value
    return columns


def column_of(rows: Iterable[JsonObject], name: str) -> Array:
    """A value of each row, vectors as rows; NaN where there is none."""
    return as_array([value_of(row, name) for row in rows])


class Values(dict[str, Any]):
    """Values by name, as `record.name` or `record["name"]`; vectors are arrays, what a model has no value for is None.

    A record cannot be changed; records of the same values are equal.  A row of a table has its columns as keys, in their
    order, and its vectors and errors by their names besides.  dict(record), from which data frames are made, has NaN in place
    of numbers that are None, so that their columns are of numbers.
    """

    __slots__ = ("_raw",)
    _raw: dict[str, Any]

    def __init__(self, data: JsonObject, columns: JsonObject | None = None) -> None:
        super().__init__({name: self._converted(name, value) for name, value in data.items()} if columns is None else columns)
        object.__setattr__(self, "_raw", dict(data))

    @classmethod
    def _converted(cls, name: str, value: Any) -> Any:
        if isinstance(value, dict):
            return Record(value)
        if isinstance(value, list) and value and all(item is None or isinstance(item, (int, float)) for item in value):
            return frozen(numbers(float("nan") if item is None else item for item in value))
        return value

    def __getitem__(self, name: str) -> Any:
        value = super().__getitem__(name)
        return None if isinstance(value, float) and value != value else value

    def items(self) -> ItemsView[str, Any]:  # type: ignore[override]
        """Names and values, None for what there is not."""
        return {name: self[name] for name in self}.items()

    def values(self) -> ValuesView[Any]:  # type: ignore[override]
        """Values, None for what there is not."""
        return {name: self[name] for name in self}.values()

    def __missing__(self, name: str) -> Any:
        if name in self._raw:
            return self._converted(name, self._raw[name])
        raise KeyError(self._absent(name))

    def _absent(self, name: str) -> str:
        return absent(name, self)

    if not TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            if name.startswith("_"):
                raise AttributeError(name)
            try:
                return self[name]
            except KeyError:
                raise AttributeError(self._absent(name)) from None

    def __contains__(self, name: object) -> bool:
        return super().__contains__(name) or name in self._raw

    def get(self, name: str, default: Any = None) -> Any:
        """The value of that name, or what is given in its place."""
        return self[name] if name in self else default

    def _refused(self, *_: Any, **__: Any) -> Any:
        raise TypeError(f"{type(self).__name__} cannot be changed")

    __delitem__ = __setitem__ = __ior__ = clear = pop = popitem = setdefault = update = _refused  # type: ignore[assignment]

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{name}: {type(self).__name__} cannot be changed")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{name}: {type(self).__name__} cannot be changed")

    def __eq__(self, other: object) -> bool:
        return self._raw == (other._raw if isinstance(other, Values) else other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._raw, dict(self))

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self, *self._raw]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self.items())})"


def as_record(value: Any) -> Any:
    """What JSON has, as records are: objects as records, also in lists, numbers in a list as an array."""
    if isinstance(value, list) and value and all(isinstance(one, dict) for one in value):
        return [Record(one) for one in value]
    return Values._converted("", value)


class Record(Values):
    __doc__ = Values.__doc__
    __slots__ = ()

    if TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any: ...


class History:
    """Time history of a run: one array a quantity, a sample a row, in the order of time.

    time [s] after the first touch, centre (n, 3) [m], attitude (n, 4) Euler parameters, velocity (n, 3) [m/s],
    angular_velocity (n, 3) [rad/s], force (n, 3) of contact [N], point_velocity (n, 3) of the contact point (else of
    the lowest vertex) [m/s], energy_translation, energy_rotation, energy_potential, energy_ground, energy_total [J],
    in_contact.  World frame.
    """

    time: Array
    centre: Array
    attitude: Array
    velocity: Array
    angular_velocity: Array
    force: Array
    point_velocity: Array
    energy_translation: Array
    energy_rotation: Array
    energy_potential: Array
    energy_ground: Array
    energy_total: Array
    in_contact: Array

    def __init__(self, arrays: Mapping[str, Array]) -> None:
        for name, array in arrays.items():
            setattr(self, name, frozen(array))

    if not TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            raise AttributeError(name if name.startswith("_") else absent(name, vars(self)))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(vars(self)),)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, History) and same_arrays(vars(self), vars(other))

    def __len__(self) -> int:
        return len(self.time)

    def __iter__(self) -> Iterator[Record]:
        return (self[i] for i in range(len(self)))

    @overload
    def __getitem__(self, index: int) -> Record: ...
    @overload
    def __getitem__(self, index: slice) -> "History": ...
    @overload
    def __getitem__(self, index: str) -> Array: ...
    def __getitem__(self, index: int | slice | str) -> "Record | History | Array":
        """A sample, some of them, or an array by its name, history["force"], or that of a vector's part, history["force_z"]."""
        arrays = vars(self)
        if isinstance(index, slice):
            return History({name: array[index] for name, array in arrays.items()})
        if isinstance(index, str):
            whole, _, part = index.rpartition("_")
            if index not in arrays and part in ("x", "y", "z") and getattr(arrays.get(whole), "ndim", 1) == 2:
                column: Array = arrays[whole][:, "xyz".index(part)]
                return column
            if index not in arrays:
                raise KeyError(absent(index, arrays))
            array: Array = arrays[index]
            return array
        row = {name: array[index].tolist() for name, array in arrays.items()}
        return Record(row, flat(row))

    def __repr__(self) -> str:
        if not len(self):
            return "History of 0 samples"
        return f"History of {len(self)} samples, {self.time[0]:.6g} s to {self.time[-1]:.6g} s"

    def between(self, start: float, end: float) -> "History":
        """The samples with start <= time <= end."""
        chosen = (self.time >= start) & (self.time <= end)
        return History({name: array[chosen] for name, array in vars(self).items()})
