"""Clattering: impact sequences of falling rigid bodies.

>>> import clatter
>>> clatter.sequence(angle=10)                      # discrete model: the impact-sequence table
>>> clatter.angles(step=5)                          # contact angles and impulses of the thin rod
>>> clatter.simulate("phone-damped", history=True)  # continuous model of a scene
>>> clatter.compare("rod-45")                       # both models, impact by impact
>>> clatter.verify(quick=True)                      # every claim of the paper, checked

Numbers are those of the program `clatter`, bit for bit; names are those of its JSON; SI units, angles in degrees where
a name says so.  Results show themselves as tables.  Errors are BadInput, NotComputed and OutsideModel; Ctrl-C ends a
long call with KeyboardInterrupt.  Other Python threads run while a call computes.
"""

import warnings

from clatter import _clatter
from clatter.angles import Angles, angles
from clatter.arrays import numpy_for
from clatter.errors import BadInput, ClatterWarning, Error, NotComputed, OutsideModel
from clatter.records import History, Impact, Record
from clatter.results import Comparison, ComparisonSweep, Result, Run, Sequence, Simulation, Sweep, Verification
from clatter.scenes import Scene, Value, called, case, cases, scene_text, texts_of

__version__ = _clatter.version
__all__ = [
    "Angles", "BadInput", "ClatterWarning", "Comparison", "ComparisonSweep", "Error", "History", "Impact", "NotComputed",
    "OutsideModel", "Record", "Result", "Run", "Sequence", "Simulation", "Sweep", "Verification", "angles", "case",
    "cases", "compare", "sequence", "simulate", "verify",
]

# Outcomes after which rows are missing because a number could not be computed.
_CUT_SHORT = {"evaluation-limit", "step-too-small", "not-representable", "flight-undecided", "not-computed", "outside-model"}


def _check(run: Run) -> None:
    """Warns of rows that are missing, raises NotComputed if all are or if required digits are not known."""
    if run.shortfall is None:
        return
    if run.outcome not in _CUT_SHORT or not run.impacts:
        raise NotComputed(run.shortfall)
    warnings.warn(run.shortfall, ClatterWarning, stacklevel=3)


def sequence(
    angle: float | None = None,
    *,
    tilt: float | None = None,
    attitude: Value | None = None,
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
    """Impact sequence of a falling rod or box by the discrete model, Eqs. 8 to 12.

    angle: inclination at the first impact, end a low; 0 flat, 90 upright [°]; tilt (0) before that [°]; or attitude:
    Euler parameters (q0, q1, q2, q3), body to world.
    speed: downward, of the centre of mass at the first touch (1) [m/s]; or height: of the centre of mass at release [m].
    tangential_velocity (0) [m/s]; or velocity=(x, y, z) instead of both.
    spin (0) [rad/s, sign of Eq. 8]; or angular_velocity=(0, y, 0).  gravity (0) [m/s²].
    restitution (1), restitution_law ("newton", "poisson", "stronge").
    impulse_ratio: Eq. 8's mu_i as given; or friction: Coulomb's mu (0).
    body: "rod" (mass 1 kg, length 1 m, radius 0 m) or "box" (mass, size=(L, W, T) in m).
    centre=(x, y, z): of mass, from the geometric centre [m]; inertia: three or six numbers about it [kg·m²].
    impacts: most to report (6).  digits: shown in the table (6); require_digits: NotComputed if fewer are known.
    method: "auto", "discrete" or "closed-form" (Eqs. 9 and 12).

    Raises BadInput; OutsideModel at the jamming limit and for a drop in space; NotComputed.  Warns of energy that an
    impulse ratio creates, and of a sequence that ended early because a number could not be computed.

    >>> clatter.sequence(angle=10)[1].impulse_normal
    1.0028424649698549
    """
    given: dict[str, Value | None] = {
        "angle": angle, "tilt": tilt, "attitude": attitude, "speed": speed, "height": height,
        "tangential_velocity": tangential_velocity, "velocity": velocity, "spin": spin,
        "angular_velocity": angular_velocity, "inertia": inertia, "centre": centre, "gravity": gravity,
        "restitution": restitution, "restitution_law": restitution_law,
        "impulse_ratio": impulse_ratio, "friction": friction, "body": body, "mass": mass, "length": length,
        "radius": radius, "size": size, "impacts": impacts, "digits": digits,
        "require_digits": require_digits,
    }
    result = Sequence(called(_clatter.sequence, texts_of(given), method))
    _check(result)
    for warning in result.to_dict().get("warnings", []):
        warnings.warn(warning, ClatterWarning, stacklevel=2)
    return result


def simulate(scene: Scene, *, history: bool = False, **changes: Value | None) -> Simulation | Sweep:
    """Drop of any body by the continuous model.

    scene: a scene file, the name of one of cases(), or a dict like case(name); a file that the scene names for its
    time history is not written.
    history: keep the time history in memory.  A sweep keeps none.
    changes: take the place of keys of the scene: angle, tilt, attitude, speed, height, tangential_velocity, velocity,
    spin, angular_velocity, gravity, body, mass, length, radius, size, inertia, centre, stiffness, damping,
    static_friction, sliding_friction, area, impacts, digits, require_digits, method,
    tolerance, step, planar, contact_gravity, errors, amplification, evaluation_limit; restitution, restitution_law,
    impulse_ratio and friction belong to the discrete model and are only kept.

    A scene with a table [sweep] gives a Sweep.  Raises BadInput, and NotComputed if there is no impact at all because
    of what the run met or required digits are not known; warns if it ended early with some.

    >>> clatter.simulate("rod-45", stiffness=1e9, impacts=1)
    """
    if history:
        numpy_for("history=True")
    report, arrays = called(_clatter.simulate, *scene_text(scene), texts_of(changes), history)
    if "runs" in report.data():
        return Sweep(report)
    run = Simulation(report, None if arrays is None else History(arrays))
    _check(run)
    return run


def compare(scene: Scene, **changes: Value | None) -> Comparison | ComparisonSweep:
    """Both models over one scene, aligned by impact, with the limit of ever stiffer grounds.

    scene and changes as for simulate().  A scene with a table [sweep] gives a ComparisonSweep.
    Raises BadInput, and OutsideModel if the discrete model cannot represent the scene.

    >>> clatter.compare("phone-damped", impacts=2).agrees
    True
    """
    report = called(_clatter.compare, *scene_text(scene), texts_of(changes))
    return ComparisonSweep(report) if "runs" in report.data() else Comparison(report)


def verify(only: list[str] | None = None, *, quick: bool = False) -> Verification:
    """Every claim of the paper, its errata, figures and exact results, each against an independent oracle.

    only: ids such as ["C1", "E2"]; quick: without the checks that take long.  Some ten seconds for all.
    """
    return Verification(called(_clatter.verify, quick, list(only or [])))
