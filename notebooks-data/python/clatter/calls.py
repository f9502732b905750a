# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions that take a scene.  The keys of scenes are their keyword arguments (the stub beside lists them)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from clatter import _clatter
from clatter.arguments import (KEYS, AnyKey, DiscreteKey, Model, Part, Path, Probes, Progress, Scene, Swept, SweepRows, SweptKey,
                               checked, is_number, part_text, probe_texts, set_texts, texts_of)
from clatter.arrays import numpy_for
from clatter.errors import NotComputed
from clatter.evidence import listed
from clatter.findings import Explanation, Gradient, Plan, Rows, Scored, Summary, Tradeoff
from clatter.records import History
from clatter.results import Comparison, ComparisonSweep, Sequence, Simulation, Sweep
from clatter.scenes import called, scene_text, warn

# A scene with a table [sweep] gives other results than one without.  Their types say `| Any`, so that what has no such table,
# nearly every scene, needs no cast, and a name that neither has is found.

# What the ground has in place of an impact's.
_OF_THE_GROUND = {"friction": "; the ground's own is sliding_friction", "restitution": "; the ground's own is floor_restitution"}
# Outcomes after which rows are missing because a number could not be computed.
_CUT_SHORT = {"evaluation-limit", "step-too-small", "not-representable", "flight-undecided", "not-computed", "outside-model"}


def _warn(reservations: Iterable[str]) -> None:
    """Of the line that calls a function of this file."""
    for words in reservations:
        warn(words, 4)


def as_given(scene: Scene | float | None, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments by their names, the scene's angle too."""
    return {**changes, **({"angle": scene} if is_number(scene) else {})}


def _reservations(shortfall: str | None, outcome: str, impacts: int) -> list[str]:
    """That rows are missing.  @raise NotComputed: all are, or required digits are not known."""
    if not shortfall:
        return []
    if outcome not in _CUT_SHORT or not impacts:
        raise NotComputed(shortfall)
    return [shortfall]


@checked
def sequence(scene: Scene | float | None = None, *, method: str = "auto", **changes: DiscreteKey) -> Sequence:
    """Impact sequence of a drop by the discrete model: Eqs. 8 to 12, or in space where it leaves its plane.

    scene: a scene file, the name of one of cases(), a dict like case(name), or the angle; what follows takes the place
    of its keys.
    method: "auto" or "discrete", which are the same.

    Raises BadInput; OutsideModel at the jamming limit; NotComputed.  Warns of sizes that look like mm or g, of energy that
    an impulse ratio creates, and of a sequence that ended early because a number could not be computed.

    >>> clatter.sequence(angle=10)[1].impulse_normal
    1.0028424649698549
    """
    report, shortfall, outcome, impacts, said = called(_clatter.sequence, *scene_text(scene, changes), method, given=as_given(scene, changes))
    _warn([*_reservations(shortfall, outcome, impacts), *said])
    run = Sequence(report)
    run._length = impacts
    return run


@checked
def explain(impact: int, scene: Scene | float | None = None, **changes: DiscreteKey) -> Explanation:
    """How an impact of a sequence came about: flight, contact, impulse and energy as equations with their numbers.

    impact: its number, from 1.  scene and keys as for sequence().
    Raises BadInput, OutsideModel, NotComputed; warns of energy that the impulse creates.

    >>> clatter.explain(2, angle=10)["Eq. 8"]["P_n"]
    1.0028424649698549
    """
    report, created = called(_clatter.explain, impact, *scene_text(scene, changes), given=as_given(scene, changes))
    result = Explanation(report)
    _warn(created)
    if result.to_dict()["shortfall"] is not None:
        raise NotComputed(str(result.to_dict()["shortfall"]))
    return result


@checked
def gradient(scene: Scene | float | None = None, **changes: DiscreteKey) -> Gradient:
    """Derivatives of the state after each impact of the discrete model: with respect to the angle (in radians), in space
    the tilt, the speed or height, the restitution and the friction; not those of a program's time steps.

    scene and keys as for sequence().  Warns where a number of the drop has none, as at a fold.
    Raises BadInput, OutsideModel, NotComputed.

    >>> clatter.gradient(angle=10).of("speed")[0].velocity_after_z
    -0.48843072413223654
    """
    report, shortfall = called(_clatter.gradient, *scene_text(scene, changes), given=as_given(scene, changes))
    _warn([shortfall] if shortfall else [])
    return Gradient(report)


@checked
def simulate(scene: Scene | float | None = None, *, history: bool = False, progress: Progress | None = None, **changes: AnyKey) -> Simulation | Any:
    """Drop of any body by the continuous model.

    scene: a scene file, the name of one of cases(), a dict like case(name), or the angle, beside which a ground must be given;
    a file that the scene names for its time history is not written.
    history: keep the time history in memory.  A sweep keeps none.
    progress(done, of): of the impacts, or of a sweep's values; called a few times a second, and what it raises ends the run.

    A scene with a table [sweep] gives a Sweep.  Raises BadInput, and NotComputed if there is no impact at all because
    of what the run met or required digits are not known; warns if it ended early with some.

    >>> clatter.simulate("rod-45", stiffness=1e9, impacts=1)
    """
    if history:
        numpy_for("history=True")
    report, arrays, doubts = called(_clatter.simulate, *scene_text(scene, changes), history, progress, given=as_given(scene, changes))
    if "runs" in report.data():
        _warn(doubts)
        return Sweep(report)
    run = Simulation(report, None if arrays is None else History(arrays))
    left_out = [f"{name}: the discrete model's alone, which simulate() leaves out{_OF_THE_GROUND.get(name, '')}" for name, value in changes.items()
                if value is not None and (KEYS[name].key.startswith("impact.") or not KEYS[name].is_continuous)]
    _warn([*doubts, *_reservations(run.shortfall, run.outcome, len(run)), *left_out])
    return run


@checked
def compare(scene: Scene | float | None = None, *, progress: Progress | None = None, **changes: AnyKey) -> Comparison | Any:
    """Both models over one scene, aligned by impact, with the limit of ever stiffer grounds.

    scene and keys as for simulate().  A scene with a table [sweep] gives a ComparisonSweep, progress(done, of) its values.
    Raises BadInput, and OutsideModel if the discrete model cannot represent the scene.

    >>> clatter.compare("phone-damped", impacts=2).agrees
    True
    """
    report = called(_clatter.compare, *scene_text(scene, changes), progress, given=as_given(scene, changes))
    return ComparisonSweep(report) if "runs" in report.data() else Comparison(report)


@checked
def compare_against(
    scene: Scene | float,
    files: Path | Iterable[Path],
    *,
    columns: str | None = None,
    require: str | float | None = None,
    progress: Progress | None = None,
    **changes: DiscreteKey,
) -> Scored:
    """Scores others' runs of any scene by the discrete model, as benchmark_score() does; scene as for sequence()."""
    options = texts_of({"columns": columns, "require": require})
    return Scored(*called(_clatter.compare_against, *scene_text(scene, changes), listed(files), options, progress,
                          given=as_given(scene, changes)))


@checked
def sweep(
    scene: Scene | None = None,
    values: Mapping[str, Swept] | None = None,
    *,
    model: Model | None = None,
    rows: SweepRows = "scene",
    random: int | None = None,
    seed: int | None = None,
    scatter: float | None = None,
    columns: str | Iterable[str] | None = None,
    probe: str | Iterable[str] | Probes | None = None,
    part: Part | None = None,
    errors: bool = True,
    require_digits: bool = False,
    summary: bool = False,
    rank_by: str | None = None,
    progress: Progress | None = None,
    **changes: SweptKey,
) -> Rows | Summary:
    """Many scenes that differ in the values of a few keys, computed on all cores.

    scene: a scene file, the name of one of cases(), or a dict like case(name).
    values: by the key of the scene file ("drop.angle_deg"), or as arguments by the names that sequence() takes (angle),
    a value, a list or array of values, or a grid "FROM:TO:STEP",
    "FROM:TO:lin:COUNT", "FROM:TO:log:COUNT" or "A,B,..." ("LOW:HIGH" or "LOW:HIGH:log" with random).  The last key varies fastest, so that a column
    of two keys is .reshape(len(first), len(second)).  Of keys that are lists drop.attitude alone can vary: a row of four for
    each scene, 26 for a box's faces, edges and corners, or with random "uniform".
    model: "discrete" or "continuous"; without it a scene with a ground takes the continuous one, which costs tens to hundreds of times
    as much.  rows: one per "scene" or per "impact".
    random: so many scenes with values at random, which depend on seed (1).  scatter [°]: turns attitudes at random, about
    those of values or the scene's own.  columns: more of them with rows of scenes, as "hardest_impulse_normal" or
    "impulse_normal_2".  probe and part: as for shock(), columns peak_g_NAME, delta_v_NAME, margin_NAME of each point.
    errors: without them at half the cost.
    summary: percentiles and extremes of each number, however many scenes there are, in place of their rows: a Summary; of
    listed attitudes also which is the worst, by the column rank_by, which without a list gives the ten worst scenes,
    to_dict()["worst"].
    progress(done, of): of the scenes.
    Raises BadInput; NotComputed if require_digits and a scene has fewer; warns of scenes that fall short.  A scene that is
    refused or outside the model is a row with its outcome and reason; a warning counts them.

    >>> clatter.sweep("phone-corner", orientation=range(19, 27), model="discrete")["impacts"]
    array([3, 3, 3, 3, 3, 3, 3, 3])
    """
    sets = set_texts(values, changes)
    sets += [] if errors else ["run.errors=false"]
    sets += ["run.require_digits=true"] if require_digits else []
    names = columns if columns is None or isinstance(columns, str) else ",".join(columns)
    options = texts_of({"random": random, "seed": seed, "scatter": scatter, "model": model, "rows": rows, "columns": names,
                        "rank_by": rank_by, "part": part_text(part)})
    name, text, _ = scene_text(scene, {})
    if isinstance(scene, str):  # the program finds a case by its name, which its commands then have, too
        name, text = scene, None
    report, shortfall, said = called(_clatter.sweep, name, text, sets, probe_texts(probe), options, summary, progress,
                                     given={**(values or {}), **changes, "columns": columns, "probe": probe, "part": part})
    if shortfall and require_digits:
        raise NotComputed(shortfall)
    _warn([*([shortfall] if shortfall else []), *said])
    return Summary(report) if summary else Rows(report)


@checked
def plan(scene: Scene | float | None = None, *, within: float | None = None, **changes: AnyKey) -> Plan:
    """The smallest model that gives the digits asked for, with its setting and cost.

    scene and keys as for simulate(); digits: asked for.  within: ms that the run may take; without digits the most
    accurate that fits.  Raises BadInput; warns if no model gives the digits.

    >>> clatter.plan("phone-corner", digits=3).choice.model
    'spatial'
    """
    time = texts_of({"within": within}).get("within")
    report, shortfall = called(_clatter.plan, *scene_text(scene, changes), time, given=as_given(scene, changes) | {"within": within})
    _warn([shortfall] if shortfall else [])
    return Plan(report)


@checked
def tradeoff(scene: Scene | float | None = None, *, progress: Progress | None = None, **changes: AnyKey) -> Tradeoff:
    """Cost against true error of every model and method on one scene; some seconds to a minute.

    scene and keys as for simulate().  progress(done, of): of the runs.  Raises BadInput, NotComputed; warns if the reference falls short.
    """
    report, shortfall = called(_clatter.tradeoff, *scene_text(scene, changes), progress, given=as_given(scene, changes))
    _warn([shortfall] if shortfall else [])
    return Tradeoff(report)
