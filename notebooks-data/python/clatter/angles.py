# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact angles of the thin rod as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from clatter import _clatter
from clatter.arrays import Array, numpy_for
from clatter.scenes import Progress, called, texts_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_MOST_ROWS_SHOWN = 200


class Angles:
    """The first three impacts over the angle of the first: one array a quantity, NaN for what does not happen.

    theta_deg, beta_deg, gamma_deg [°]; P1, P2, P3 [m |v_n|]; V1, V2, V3 [|v_n|] and Omega1, Omega2, Omega3 [|v_n|/L]
    after each impact; T1, T2 [L/|v_n|] between them; gamma_minus_theta_deg [°] and impulse_deficit = 2 - P1 - P2 - P3,
    free of cancellation; impacts: how many there are; as printed: beta_printed_deg, beta_printed_negative_g_deg [°].
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

    def __init__(self, report: _clatter.Report, arrays: dict[str, Array]) -> None:
        self._report = report
        self._names = list(arrays)
        for name, array in arrays.items():
            array.flags.writeable = False
            setattr(self, name, array)

    def __len__(self) -> int:
        return len(self.theta_deg)

    def __getitem__(self, name: str) -> Array:
        if name not in self._names:
            raise KeyError(name)
        array: Array = getattr(self, name)
        return array

    def to_dict(self) -> dict[str, Any]:
        """The program's JSON as dicts and lists."""
        return self._report.data()

    def to_text(self, format: str = "table", *, ascii: bool = False) -> str:
        """What the program prints with --format `format`: table, csv, json, markdown or latex."""
        return self._report.text(format, ascii)

    def _summary(self) -> str:
        return f"Angles for {len(self)} values of θ, {self.theta_deg[0]}° to {self.theta_deg[-1]}°; to_text() shows them"

    def __repr__(self) -> str:
        return self.to_text().rstrip("\n") if len(self) <= _MOST_ROWS_SHOWN else self._summary()

    def _repr_html_(self) -> str:
        return self._report.html() if len(self) <= _MOST_ROWS_SHOWN else f"<p>{self._summary()}</p>"


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
    progress: Progress | None = None,
) -> Angles:
    """Contact angles beta and gamma (Eq. 12) and impulses of the thin rod's first three impacts.

    theta: angles of the first impact [°]; or start (0), stop (90) and step (5) or count.
    gravity_number: G = g L/v_n^2 (0); or gravity [m/s²] with length (1 m) and speed (1 m/s).
    restitution (1), impulse_ratio: Eq. 8's mu_i (0).
    as_printed: also beta by the paper's printed gravity term, whose sign and factor are wrong.
    digits: shown in the table (6).  progress(done, of): of the angles.  Raises BadInput, NotComputed.

    >>> clatter.angles([10]).beta_deg
    array([5.08198288])
    """
    given = texts_of({"from": start, "to": stop, "step": step, "count": count, "gravity_number": gravity_number,
                      "gravity": gravity, "length": length, "speed": speed, "restitution": restitution,
                      "impulse_ratio": impulse_ratio, "digits": digits, "as_printed": as_printed})
    np = numpy_for("angles()")
    values = None if theta is None else np.atleast_1d(np.asarray(theta, dtype=float)).ravel()
    return Angles(*called(_clatter.angles, values, given, progress))
