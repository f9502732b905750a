# SPDX-License-Identifier: GPL-3.0-or-later
"""Clattering: impact sequences of falling rigid bodies.

>>> import clatter
>>> clatter.sequence(angle=10)                      # discrete model: the impact-sequence table
>>> clatter.explain(2, angle=10)                    # how impact 2 came about, equation by equation
>>> clatter.sequence("phone-corner")                # any scene, in the plane or in space
>>> clatter.angles(step=5)                          # contact angles and impulses of the thin rod
>>> clatter.simulate("phone-damped", history=True)  # continuous model of a scene
>>> clatter.compare("rod-45")                       # both models, impact by impact
>>> clatter.sweep("phone-corner", {"drop.orientation": "1:26:1"})   # many scenes: grids or random ones
>>> clatter.plan("phone-corner", digits=3)          # the smallest model that serves; tradeoff() measures them
>>> clatter.verify(quick=True)                      # every claim of the paper, checked
>>> clatter.measured_score("cube-tosses")           # impact laws against tracked drops
>>> clatter.benchmark_score(["run.csv"])            # another program's run of a problem with a certified answer

Numbers are those of the program `clatter`, bit for bit; names are those of its JSON; SI units, angles in degrees where
a name says so.  Results show themselves as tables.  Errors are BadInput, NotComputed and OutsideModel; Ctrl-C ends a
long call with KeyboardInterrupt; progress=print shows how far it is.  Other Python threads run while a call computes.
"""

from clatter import _clatter
from clatter.angles import Angles, angles
from clatter.arrays import numpy_for
from clatter.discrete import check_run, explain, regimes, sequence
from clatter.errors import BadInput, ClatterWarning, Error, NotComputed, OutsideModel
from clatter.evidence import (benchmark_list, benchmark_score, benchmark_show, benchmark_truth, compare_against, extremes,
                              figure, measured_fit, measured_predict, measured_score)
from clatter.findings import Explanation, Measured, Plan, Problem, Rows, Scored, Table, Tradeoff
from clatter.records import History, Impact, Record
from clatter.results import Comparison, ComparisonSweep, Result, Run, Sequence, Simulation, Sweep, Verification
from clatter.scenes import Progress, Scene, Value, called, case, cases, scene_text, texts_of
from clatter.studies import plan, sweep, tradeoff

__version__ = _clatter.version
__all__ = [
    "Angles", "BadInput", "ClatterWarning", "Comparison", "ComparisonSweep", "Error", "Explanation", "History",
    "Impact", "Measured", "NotComputed", "OutsideModel", "Plan", "Problem", "Record", "Result", "Rows", "Run",
    "Scored", "Sequence", "Simulation", "Sweep", "Table", "Tradeoff", "Verification", "angles", "benchmark_list",
    "benchmark_score", "benchmark_show", "benchmark_truth", "case", "cases", "compare", "compare_against", "explain",
    "extremes", "figure", "measured_fit", "measured_predict", "measured_score", "plan", "regimes", "sequence",
    "simulate", "sweep", "tradeoff", "verify",
]

def simulate(
    scene: Scene, *, history: bool = False, progress: Progress | None = None, **changes: Value | None
) -> Simulation | Sweep:
    """Drop of any body by the continuous model.

    scene: a scene file, the name of one of cases(), or a dict like case(name); a file that the scene names for its
    time history is not written.
    history: keep the time history in memory.  A sweep keeps none.
    progress(done, of): of the impacts, or of a sweep's values; called a few times a second, and what it raises ends the run.
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
    report, arrays = called(_clatter.simulate, *scene_text(scene), texts_of(changes), history, progress)
    if "runs" in report.data():
        return Sweep(report)
    run = Simulation(report, None if arrays is None else History(arrays))
    check_run(run)
    return run


def compare(scene: Scene, *, progress: Progress | None = None, **changes: Value | None) -> Comparison | ComparisonSweep:
    """Both models over one scene, aligned by impact, with the limit of ever stiffer grounds.

    scene and changes as for simulate().  A scene with a table [sweep] gives a ComparisonSweep, progress(done, of) its values.
    Raises BadInput, and OutsideModel if the discrete model cannot represent the scene.

    >>> clatter.compare("phone-damped", impacts=2).agrees
    True
    """
    report = called(_clatter.compare, *scene_text(scene), texts_of(changes), progress)
    return ComparisonSweep(report) if "runs" in report.data() else Comparison(report)


def verify(
    only: list[str] | None = None, *, quick: bool = False, progress: Progress | None = None
) -> Verification:
    """Every claim of the paper, its errata, figures and exact results, each against an independent oracle.

    only: ids such as ["C1", "E2"]; quick: without the checks that take long.  progress(done, of): of the checks.  Some
    minutes for all.
    """
    return Verification(called(_clatter.verify, quick, list(only or []), progress))
