# SPDX-License-Identifier: GPL-3.0-or-later
"""Small objects over the program's JSON: each name of the JSON is an attribute."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from clatter.arrays import Array, frozen, numbers, same_arrays, words

JsonObject = Mapping[str, Any]


def as_array(values: list[Any]) -> Array:
    """Numbers as an array with NaN for None; vectors as rows."""
    nan = float("nan")
    wide = next((len(value) for value in values if isinstance(value, list)), None)
    if wide is not None:
        return numbers([nan] * wide if value is None else value for value in values)
    if any(isinstance(value, (str, bool)) for value in values):
        return words(values)
    return numbers(nan if value is None else value for value in values)


def absent(name: str, known: Iterable[str]) -> str:
    """What is said of a name that there is not."""
    return f"no '{name}' here; there are {', '.join(known)}"


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


def column_of(rows: Iterable[JsonObject], name: str) -> Array:
    """A value of each row, vectors as rows; NaN where there is none."""
    return as_array([value_of(row, name) for row in rows])


class Record(Mapping[str, Any]):
    """Values by name, as `record.name` or `record["name"]`; vectors are arrays, what a model has no value for is None.

    A record cannot be changed; records of the same values are equal.
    """

    __slots__ = ("_raw", "_values")
    _raw: dict[str, Any]
    _values: dict[str, Any]

    def __init__(self, data: JsonObject) -> None:
        object.__setattr__(self, "_raw", dict(data))
        object.__setattr__(self, "_values", {name: self._converted(value) for name, value in data.items()})

    @staticmethod
    def _converted(value: Any) -> Any:
        if isinstance(value, dict):
            return Record(value)
        if isinstance(value, list) and value and all(isinstance(item, (int, float)) for item in value):
            return frozen(numbers(value))
        return value

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._values[name]
        except KeyError:
            raise AttributeError(absent(name, self._values)) from None

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{name}: {type(self).__name__} cannot be changed")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{name}: {type(self).__name__} cannot be changed")

    def __getitem__(self, name: str) -> Any:
        if name not in self._values:
            raise KeyError(absent(name, self._values))
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __eq__(self, other: object) -> bool:
        return self._raw == (other._raw if isinstance(other, Record) else other)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._raw,)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._values]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self._values.items())})"


class Impact(Record):
    """One impact, SI units, world frame (x right, z up).

    n, start, duration, end ("a", "b", "both" ...), inclination_deg, contact_angle_deg, approach_speed, restitution,
    impulse_normal, impulse_tangential, impulse_ratio, mode, peak_force, peak_time, velocity_after (3),
    angular_velocity_after (3), energy_before, energy_after, energy_loss, error_estimate (a record), amplification,
    predictable.  In space and from the continuous model also touches, impulse (3), and in space corners, place (3) and
    attitude (4); from the continuous model indentation, work_damping, work_friction, work_released, submerged, local_slip, energy_stored,
    ledger_gap.  An error is a bound by the discrete model, an estimate by the continuous one, None where it is not known.  start counts from the first touch, peak_time from the impact's start.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        return f"Impact {self.n}: end {self.end} at " + ", ".join(
            [f"{self.start:.6g} s",
             *([] if self.get("contact_angle_deg") is None else [f"{self.contact_angle_deg:.6g}°"]),
             f"P = {self.impulse_normal:.6g} N·s"])


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

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(vars(self)),)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, History) and same_arrays(vars(self), vars(other))

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        if not len(self):
            return "History of 0 samples"
        return f"History of {len(self)} samples, {self.time[0]:.6g} s to {self.time[-1]:.6g} s"

    def between(self, start: float, end: float) -> "History":
        """The samples with start <= time <= end."""
        chosen = (self.time >= start) & (self.time <= end)
        return History({name: array[chosen] for name, array in vars(self).items()})
