# SPDX-License-Identifier: GPL-3.0-or-later
"""The thin rod: contact angles as arrays, and how many impacts there are."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, overload

from clatter import _clatter
from clatter.arguments import Progress, checked, is_list, is_number, plain, texts_of
from clatter.arrays import Array, frozen, numpy_for, same_arrays
from clatter.errors import BadArgument
from clatter.findings import Rows
from clatter.records import Record, absent, as_array
from clatter.results import Report, RowList, shown_html, shown_text
from clatter.scenes import called
from clatter.words import shown

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_MOST_ROWS_SHOWN = 200


class Angles:
    """The first three impacts over the angle of the first: one array a quantity, NaN for what does not happen.

    theta_deg, beta_deg, gamma_deg [°]; P1, P2, P3 [m |v_n|]; V1, V2, V3 [|v_n|] and Omega1, Omega2, Omega3 [|v_n|/L]
    after each impact; T1, T2 [L/|v_n|] between them; gamma_minus_theta_deg [°] and impulse_deficit = 2 - P1 - P2 - P3,
    free of cancellation; impacts: how many there are; as printed: beta_printed_deg, beta_printed_negative_g_deg [°].

    Of angles that came as an array the batch has beta_deg, gamma_deg, P1, P2, P3, T1, T2 and impacts; the others, and the
    table, are computed one angle after the other when they are first asked for.
    """

    theta_deg: Array
    beta_deg: Array
    gamma_deg: Array
    P1: Array
    P2: Array
    P3: Array
    V1: Array
    Omega1: Array
    V2: Array
    Omega2: Array
    V3: Array
    Omega3: Array
    T1: Array
    T2: Array
    gamma_minus_theta_deg: Array
    impulse_deficit: Array
    impacts: Array
    beta_printed_deg: Array
    beta_printed_negative_g_deg: Array

    def __init__(self, report: Report, arrays: dict[str, Array], given: dict[str, str] | None = None) -> None:
        """given: options of a batch, which has not all arrays."""
        self._report, self._given, self._is_whole = report, given, given is None
        self._names = list(arrays)
        self._keep(arrays)

    def _keep(self, arrays: dict[str, Array]) -> None:
        for name, array in arrays.items():
            setattr(self, name, frozen(array))

    def _arrays(self) -> dict[str, Array]:
        return {name: self[name] for name in self._names}

    def __getattr__(self, name: str) -> Array:
        if name in type(self).__annotations__ and self._given is not None and not self._is_whole:
            _, arrays = _called(_clatter.angles, self.theta_deg, self._given, None)
            self._is_whole = True
            self._keep({other: array for other, array in arrays.items() if other not in self._names})
            if name in arrays:
                return self[name]
        raise AttributeError(absent(name, (key for key in vars(self) if not key.startswith("_"))))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._report, self._arrays(), self._given)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Angles) and same_arrays(self._arrays(), other._arrays())

    def __len__(self) -> int:
        return len(self.theta_deg)

    def __iter__(self) -> Iterator[Record]:
        return iter(self[:])

    @overload
    def __getitem__(self, name: int) -> Record: ...
    @overload
    def __getitem__(self, name: slice) -> RowList[Record]: ...
    @overload
    def __getitem__(self, name: str) -> Array: ...
    def __getitem__(self, name: int | slice | str) -> Record | RowList[Record] | Array:
        """An array by its name, the numbers of one angle, or those of some."""
        if not isinstance(name, str):
            rows = self._rows[name]
            return RowList(Record(row) for row in rows) if isinstance(rows, list) else Record(rows)
        array: Array | None = getattr(self, name, None) if name in type(self).__annotations__ else None
        if array is None and self._rows and name in self._rows[0]:
            array = as_array([row[name] for row in self._rows])
        if array is None:
            raise KeyError(absent(name, self._arrays()))
        return array

    def to_dict(self) -> dict[str, Any]:
        """The program's JSON as dicts and lists."""
        return self._report.data()

    @checked
    def to_text(self, format: str = "table", *, ascii: bool = False) -> str:
        """What the program prints with --format `format`: table, csv, json, markdown or latex."""
        return self._report.text(format, ascii)

    @functools.cached_property
    def _rows(self) -> list[dict[str, Any]]:
        """Those of the table; of a batch what it has."""
        columns = self._report.columns() if self._given is None else {one: list(array) for one, array in self._arrays().items()}
        return [dict(zip(columns, row)) for row in zip(*columns.values())]

    def _summary(self) -> str:
        return f"Angles for {len(self)} values of θ, {self.theta_deg[0]}° to {self.theta_deg[-1]}°; to_text() shows them"

    def __repr__(self) -> str:
        return shown_text(self.to_text(), len(self)) if len(self) <= _MOST_ROWS_SHOWN else self._summary()

    def _repr_html_(self) -> str:
        return shown_html(self._report.html()) if len(self) <= _MOST_ROWS_SHOWN else f"<p>{self._summary()}</p>"


def _called(function: Any, theta: Array | None, given: dict[str, str], progress: Progress | None) -> Any:
    return called(function, theta, given, progress, renamed={"from": "start", "to": "stop"})


def _filled(out: Mapping[str, Array], arrays: dict[str, Array], shape: tuple[int, ...]) -> dict[str, Array]:
    """The arrays, those of `out` written there and seen there.  @raise BadArgument: one does not fit, and none is written."""
    np = numpy_for("angles()")
    for name, place in out.items():
        if name not in arrays:
            raise BadArgument(f"out[{name!r}]: must be one of {', '.join(arrays)}")
        kind = arrays[name].dtype
        if not (isinstance(place, np.ndarray) and place.shape == shape and place.flags.writeable and np.can_cast(kind, place.dtype, "same_kind")):
            raise BadArgument(f"out[{name!r}]: must be an array of shape {shape} that takes {kind}")
    for name, place in out.items():
        np.copyto(place, arrays[name].reshape(shape), casting="same_kind")
    return arrays | {name: place.reshape(-1) for name, place in out.items()}


def _batched(theta: Array, given: dict[str, str], out: Mapping[str, Array], progress: Progress | None) -> Angles:
    np = numpy_for("angles()")
    flat = np.array(theta, dtype=float).reshape(-1)
    report, arrays = _called(_clatter.angle_arrays, flat, given, progress)
    return Angles(report, {"theta_deg": flat} | _filled(out, arrays, theta.shape), given)


@checked
def angles(
    theta: ArrayLike | None = None,
    *,
    start: float | None = None,
    stop: float | None = None,
    step: float | None = None,
    count: int | None = None,
    gravity_number: float | None = None,
    gravity: float | None = None,
    length: float | None = None,
    speed: float | None = None,
    restitution: float | None = None,
    impulse_ratio: float | None = None,
    as_printed: bool = False,
    digits: int | None = None,
    out: Mapping[str, Array] | None = None,
    progress: Progress | None = None,
) -> Angles:
    """Contact angles beta and gamma (Eq. 12) and impulses of the thin rod's first three impacts.

    theta: angles of the first impact [°]; or start (0), stop (90) and step (5) or count.  An array (of NumPy, a column of
    a data frame) goes through the batch, many angles at once, and its numbers are within the error bars of those that a
    list gives, which are the program's bit for bit.
    gravity_number: G = g L/v_n^2 (0); or gravity [m/s²] with length (1 m) and speed (1 m/s).
    restitution (1), impulse_ratio: Eq. 8's mu_i (0).
    as_printed: also beta by the paper's printed gravity term, whose sign and factor are wrong.
    digits: shown in the table (6).  progress(done, of): of the angles.  Raises BadInput, NotComputed.
    out: for an array theta a dict of arrays of its shape, which are filled when all is computed and are those of the result:
    any of beta_deg, gamma_deg, P1, P2, P3, T1, T2, impacts.  Of a structured array {name: table[name] for name in table.dtype.names}.

    >>> clatter.angles([10]).beta_deg
    array([5.08198288])
    >>> clatter.angles(np.linspace(1, 89, 10**6), restitution=0.5, out={"beta_deg": beta}).impacts
    """
    given = texts_of({"from": start, "to": stop, "step": step, "count": count, "gravity_number": gravity_number,
                      "gravity": gravity, "length": length, "speed": speed, "restitution": restitution,
                      "impulse_ratio": impulse_ratio, "digits": digits, "as_printed": as_printed})
    np = numpy_for("angles()")
    if theta is not None and not (is_number(plain(theta)) or is_list(theta)):
        raise BadArgument(f"theta {shown(theta)}: must be a number or an array of numbers")
    many = plain(theta)
    if isinstance(many, np.ndarray) and many.dtype.kind in "fiu":
        return _batched(many, given, out or {}, progress)
    if out is not None:
        raise BadArgument(f"out {shown(out)}: must be left out unless theta is an array")
    try:
        values = None if theta is None else np.asarray(plain(theta) if is_number(plain(theta)) else list(plain(theta)), dtype=float).ravel()
    except (TypeError, ValueError):
        raise BadArgument(f"theta {shown(theta)}: must be a number or an array of numbers") from None
    return Angles(*_called(_clatter.angles, values, given, progress))


@checked
def regimes(
    over: str = "gravity-number",
    *,
    from_: float | None = None,
    to: float | None = None,
    step: float | None = None,
    count: int | None = None,
    log: bool = False,
    gravity_number: float | None = None,
    gravity: float | None = None,
    length: float | None = None,
    speed: float | None = None,
    restitution: float | None = None,
    impulse_ratio: float | None = None,
    digits: int | None = None,
) -> Rows:
    """How many impacts the thin rod has, and the angles where that changes, over one of its parameters.

    over: "gravity-number", "restitution" or "impulse-ratio"; from_, to and step or count of its values (log: in geometric
    progression); the others as for angles().  digits: shown in the table (6).

    >>> clatter.regimes("restitution", from_=0.5, to=1, step=0.5).column("restitution")
    array([0.5, 1. ])
    """
    given = texts_of({"over": over, "from": from_, "to": to, "step": step, "count": count, "gravity_number": gravity_number,
                      "gravity": gravity, "length": length, "speed": speed, "restitution": restitution,
                      "impulse_ratio": impulse_ratio, "digits": digits, "log": True if log else None})
    return Rows(called(_clatter.regimes, given, renamed={"from": "from_"}))
