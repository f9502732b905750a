# SPDX-License-Identifier: GPL-3.0-or-later
"""The discrete model: sequences, explanations, regimes."""

import warnings
from numbers import Real

from clatter import _clatter
from clatter.errors import BadInput, ClatterWarning, NotComputed
from clatter.findings import Explanation, Rows
from clatter.results import Run, Sequence
from clatter.scenes import Scene, SceneText, Value, called, scene_text, texts_of

# Outcomes after which rows are missing because a number could not be computed.
_CUT_SHORT = {"evaluation-limit", "step-too-small", "not-representable", "flight-undecided", "not-computed", "outside-model"}


def check_run(run: Run) -> None:
    """Warns of rows that are missing, raises NotComputed if all are or if required digits are not known."""
    if run.shortfall is None:
        return
    if run.outcome not in _CUT_SHORT or not run.impacts:
        raise NotComputed(run.shortfall)
    warnings.warn(run.shortfall, ClatterWarning, stacklevel=3)


def source_of(scene: Scene | float | None, angle: float | None) -> tuple[SceneText, float | None]:
    """The scene, and the angle, which may stand in its place."""
    if scene is None:
        return SceneText("", None), angle
    if isinstance(scene, (int, float)) or isinstance(scene, Real):
        if angle is not None:
            raise BadInput(f"angle {angle!r}: given twice")
        return SceneText("", None), scene if isinstance(scene, int) else float(scene)
    return scene_text(scene), angle


def sequence(
    scene: Scene | float | None = None,
    *,
    angle: float | None = None,
    tilt: float | None = None,
    attitude: Value | None = None,
    orientation: int | None = None,
    speed: float | None = None,
    height: float | None = None,
    tangential_velocity: float | None = None,
    velocity: Value | None = None,
    spin: float | None = None,
    angular_velocity: Value | None = None,
    gravity: float | None = None,
    restitution: float | None = None,
    restitution_law: str | None = None,
    impulse_ratio: float | None = None,
    friction: float | None = None,
    body: str | None = None,
    mass: float | None = None,
    length: float | None = None,
    radius: float | None = None,
    size: Value | None = None,
    inertia: Value | None = None,
    centre: Value | None = None,
    impacts: int | None = None,
    digits: int | None = None,
    require_digits: bool | None = None,
    method: str = "auto",
) -> Sequence:
    """Impact sequence of a drop by the discrete model: Eqs. 8 to 12, or in space where it leaves its plane.

    scene: a scene file, the name of one of cases(), a dict like case(name), or the angle; what follows takes the place
    of its keys.
    angle: inclination at the first impact, end a low; 0 flat, 90 upright [°]; tilt (0) before that [°]; or attitude:
    Euler parameters (q0, q1, q2, q3), body to world; or orientation: which part of a box points down, 1 to 26.
    speed: downward, of the centre of mass at the first touch (1) [m/s]; or height: of the centre of mass at release [m].
    tangential_velocity (0) [m/s]; or velocity=(x, y, z) instead of both.
    spin (0) [rad/s, sign of Eq. 8]; or angular_velocity=(x, y, z).  gravity (0; of a scene 9.81) [m/s²].
    restitution (1), restitution_law ("newton", "poisson", "stronge").
    impulse_ratio: Eq. 8's mu_i as given; or friction: Coulomb's mu (0).
    body: "rod" (mass 1 kg, length 1 m, radius 0 m) or "box" (mass, size=(L, W, T) in m).
    centre=(x, y, z): of mass, from the geometric centre [m]; inertia: three or six numbers about it [kg·m²].
    impacts: most to report (6).  digits: shown in the table (6); require_digits: NotComputed if fewer are known.
    method: "auto", "discrete" or "closed-form" (Eqs. 9 and 12).

    Raises BadInput; OutsideModel at the jamming limit; NotComputed.  Warns of energy that an
    impulse ratio creates, and of a sequence that ended early because a number could not be computed.

    >>> clatter.sequence(angle=10)[1].impulse_normal
    1.0028424649698549
    """
    given: dict[str, Value | None] = {
        "tilt": tilt, "attitude": attitude, "orientation": orientation, "speed": speed, "height": height,
        "tangential_velocity": tangential_velocity, "velocity": velocity, "spin": spin,
        "angular_velocity": angular_velocity, "inertia": inertia, "centre": centre, "gravity": gravity,
        "restitution": restitution, "restitution_law": restitution_law,
        "impulse_ratio": impulse_ratio, "friction": friction, "body": body, "mass": mass, "length": length,
        "radius": radius, "size": size, "impacts": impacts, "digits": digits,
        "require_digits": require_digits,
    }
    source, given["angle"] = source_of(scene, angle)
    result = Sequence(called(_clatter.sequence, *source, texts_of(given), method))
    check_run(result)
    for warning in result.to_dict().get("warnings", []):
        warnings.warn(warning, ClatterWarning, stacklevel=2)
    return result


def explain(impact: int, scene: Scene | float | None = None, **changes: Value | None) -> Explanation:
    """How an impact of a sequence came about: flight, contact, impulse and energy as equations with their numbers.

    impact: its number, from 1.  scene and changes as for sequence().
    Raises BadInput, OutsideModel, NotComputed; warns of energy that the impulse creates.

    >>> clatter.explain(2, angle=10)["Eq. 8"]["P_n"]
    1.0028424649698549
    """
    angle = changes.pop("angle", None)
    if angle is not None and not isinstance(angle, (Real, str)):
        raise BadInput(f"angle {angle!r}: must be a number")
    source, given = source_of(scene, angle)  # type: ignore[arg-type]
    report, created = called(_clatter.explain, impact, *source, texts_of({**changes, "angle": given}))
    result = Explanation(report)
    for warning in created:
        warnings.warn(warning, ClatterWarning, stacklevel=2)
    if result.to_dict()["shortfall"] is not None:
        raise NotComputed(str(result.to_dict()["shortfall"]))
    return result


def regimes(over: str = "gravity-number", **options: Value | None) -> Rows:
    """How many impacts the thin rod has, and the angles where that changes, over one of its parameters.

    over: "gravity-number", "restitution" or "impulse-ratio".
    options: from_, to and step or count (log=True: in geometric progression); gravity_number, gravity, length, speed,
    restitution, impulse_ratio for the others; digits of the table.

    >>> clatter.regimes("restitution", from_=0.5, to=1, step=0.5).column("restitution")
    array([0.5, 1. ])
    """
    given = {name.rstrip("_"): value for name, value in options.items()}
    return Rows(called(_clatter.regimes, texts_of({"over": over, **given})))
