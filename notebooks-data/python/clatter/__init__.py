# SPDX-License-Identifier: GPL-3.0-or-later
"""Clattering: impact sequences of falling rigid bodies.

>>> import clatter
>>> clatter.sequence(angle=10)                      # discrete model: the impact-sequence table
>>> clatter.explain(2, angle=10)                    # how impact 2 came about, equation by equation
>>> clatter.sequence("phone-corner")                # any scene, in the plane or in space
>>> clatter.gradient(angle=10)                      # how each impact changes with the drop
>>> clatter.angles(step=5)                          # contact angles and impulses of the thin rod
>>> clatter.simulate("phone-damped", history=True)  # continuous model of a scene
>>> clatter.compare("rod-45")                       # both models, impact by impact
>>> clatter.sweep("phone-corner", orientation=range(1, 27))  # many scenes: grids or random ones
>>> clatter.plan("phone-corner", digits=3)          # the smallest model that serves; tradeoff() measures them
>>> clatter.verify(quick=True)                      # every claim of the paper, checked
>>> clatter.measured_score("cube-tosses")           # impact laws against tracked drops
>>> clatter.benchmark_score(["run.csv"])            # another program's run of a problem with a certified answer

Numbers are those of the program `clatter`, bit for bit (of an array of angles() within their error bars); names are those
of its JSON; SI units, angles in degrees where a name says so.  Results show themselves as tables, can be pickled and copied.  Wherever numbers are listed, arrays do.  Errors are BadInput, NotComputed and OutsideModel; Ctrl-C ends a
long call with KeyboardInterrupt; progress=print shows how far it is.  Other Python threads run while a call computes.
"""

from clatter import _clatter
from clatter.angles import Angles, angles, regimes
from clatter.calls import compare, compare_against, explain, gradient, plan, sequence, simulate, sweep, tradeoff
from clatter.commands import atlas, ground, map, report, shock
from clatter.errors import BadArgument, BadInput, ClatterWarning, Error, NotComputed, OutsideModel
from clatter.evidence import (benchmark_list, benchmark_score, benchmark_show, benchmark_truth, extremes, figure, measured_fit,
                              measured_predict, measured_score, verify)
from clatter.fields import Accuracy, Answer, Check, Choice, Cost, Equation, Impact, ImpactErrors, Rung, SimulatedImpact, Step, Tail
from clatter.findings import Atlas, Explanation, Gradient, Measured, Plan, Problem, Ranking, Rows, Scored, Summary, Table, Tradeoff
from clatter.records import History, Record
from clatter.results import Comparison, ComparisonSweep, Result, RowList, Run, Sequence, Simulation, States, Sweep, Verification
from clatter.scenes import case, cases

__version__ = _clatter.version
__all__ = [
    "Accuracy", "Angles", "Answer", "Atlas", "BadArgument", "BadInput", "Check", "Choice", "ClatterWarning", "Comparison",
    "ComparisonSweep", "Cost", "Equation", "Error", "Explanation", "Gradient", "History", "Impact", "ImpactErrors",
    "Measured", "NotComputed", "OutsideModel", "Plan", "Problem", "Ranking", "Record", "Result", "RowList", "Rows", "Run",
    "Rung", "Scored", "Sequence", "SimulatedImpact", "Simulation", "States", "Step", "Summary", "Sweep", "Table",
    "Tail", "Tradeoff", "Verification", "angles", "atlas", "benchmark_list", "benchmark_score", "benchmark_show",
    "benchmark_truth", "case", "cases", "compare", "compare_against", "explain", "extremes", "figure", "gradient",
    "ground", "map", "measured_fit", "measured_predict", "measured_score", "plan", "regimes", "report", "sequence",
    "shock", "simulate", "sweep", "tradeoff", "verify",
]


def __dir__() -> list[str]:
    return list(__all__)
