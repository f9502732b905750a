# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of scenes: sweeps, plans, what accuracy costs."""

import warnings
from collections.abc import Mapping

from clatter import _clatter
from clatter.errors import ClatterWarning, NotComputed
from clatter.findings import Plan, Rows, Tradeoff
from clatter.scenes import Progress, Scene, Value, called, scene_text, text_of, texts_of


def sweep(
    scene: Scene,
    values: Mapping[str, Value],
    *,
    model: str | None = None,
    rows: str = "scene",
    random: int | None = None,
    seed: int | None = None,
    errors: bool = True,
    require_digits: bool = False,
    progress: Progress | None = None,
) -> Rows:
    """Many scenes that differ in the values of a few keys, computed on all cores.

    scene: a scene file, the name of one of cases(), or a dict like case(name).
    values: by the key of the scene file a value, or a grid "FROM:TO:STEP", "FROM:TO:log:COUNT" or "A,B,..." ("LOW:HIGH" or
    "LOW:HIGH:log" with random).
    model: "discrete" or "continuous" (that if the scene has a ground).  rows: one per "scene" or per "impact".
    random: so many scenes with values at random, which depend on seed (1).  errors: without them at half the cost.
    progress(done, of): of the scenes.
    Raises BadInput; NotComputed if require_digits and a scene has fewer; warns of scenes that fall short.  A scene that is
    refused or outside the model is a row with its outcome and reason.

    >>> clatter.sweep("phone-corner", {"drop.orientation": "19:26:1"}, model="discrete").column("impacts")
    array([3., 3., 3., 3., 3., 3., 3., 3.])
    """
    sets = [f"{key}={text_of(key, value)}" for key, value in values.items()]
    sets += [] if errors else ["run.errors=false"]
    sets += ["run.require_digits=true"] if require_digits else []
    options = texts_of({"random": random, "seed": seed, "model": model, "rows": rows})
    report, shortfall = called(_clatter.sweep, *scene_text(scene), sets, options, progress)
    if shortfall and require_digits:
        raise NotComputed(shortfall)
    if shortfall:
        warnings.warn(shortfall, ClatterWarning, stacklevel=2)
    return Rows(report)


def plan(scene: Scene, *, within: float | None = None, **changes: Value | None) -> Plan:
    """The smallest model that gives the digits asked for, with its setting and cost.

    scene and changes as for simulate(); digits: asked for.  within: ms that the run may take; without digits the most
    accurate that fits.  Raises BadInput; warns if no model gives the digits.

    >>> clatter.plan("phone-corner", digits=3).choice.model
    'spatial'
    """
    time = None if within is None else text_of("within", within)
    report, shortfall = called(_clatter.plan, *scene_text(scene), texts_of(changes), time)
    if shortfall:
        warnings.warn(shortfall, ClatterWarning, stacklevel=2)
    return Plan(report)


def tradeoff(scene: Scene, *, progress: Progress | None = None, **changes: Value | None) -> Tradeoff:
    """Cost against true error of every model and method on one scene; some seconds to a minute.

    scene and changes as for simulate().  progress(done, of): of the runs.  Raises BadInput, NotComputed; warns if the reference falls short.
    """
    report, shortfall = called(_clatter.tradeoff, *scene_text(scene), texts_of(changes), progress)
    if shortfall:
        warnings.warn(shortfall, ClatterWarning, stacklevel=2)
    return Tradeoff(report)
