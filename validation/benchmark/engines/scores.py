# SPDX-License-Identifier: GPL-3.0-or-later
"""Scores of a cell's trajectories, by `clatter benchmark score`, as rows of the league's tables: one for each step."""

import json
import subprocess

import matrix

VERDICTS = ("exact", "sharp", "good", "coarse", "fails")  # the best first
ERRORS = ("law_error", "velocity_error", "angular_velocity_error", "time_error", "energy_error", "flight_error", "error")
COLUMNS = {
    "engine": "of engines.toml", "settings": "default: the engine's own; tuned: as its adapter says",
    "problem": "of clatter benchmark list", "step": "s; empty where there is none to choose",
    "version": "of the engine", "law": "that impacts are judged by", "phases": "starting heights; numbers are those of the worst",
    "verdict": "of the worst phase: exact, sharp, good, coarse, fails; none without an answer",
    "right": "phases with the right number and order of impacts", "law_error": "an impact against the exact map at the engine's own state",
    "velocity_error": "of V after impacts", "angular_velocity_error": "of Omega after impacts", "time_error": "of impacts' times",
    "energy_error": "after impacts and between them", "flight_error": "way that free flight does not explain", "error": "the largest",
    "order": "of convergence of V, Omega and t over the steps", "digest": "of the trajectories: equal numbers to the bit have equal ones",
    "finding": "what is wrong in the worst phase, the first", "reason": "why there is no answer"}
COST_COLUMNS = {"engine": "", "settings": "", "problem": "", "step": "s", "duration": "of the motion that is asked for, s",
                "seconds": "wall time of the steps alone, the least over the phases"}


class CannotScore(Exception):
    """The scorer refused a file; the text is what it said."""


def scored(cell, program):
    """Rows of the league and of its costs."""
    answered = [run for run in cell.runs if not run.reason]
    told = judged(program, [str(run.file) for run in answered]) if answered else {"files": [], "problems": []}
    by_file = {one["file"]: one for one in told["files"]}
    order = told["problems"][0]["order"] if told["problems"] else None
    steps = dict.fromkeys(run.step for run in cell.runs)
    rows, costs = [], []
    for step in steps:
        chosen = [run for run in cell.runs if run.step == step]
        head = {"engine": cell.engine.id, "settings": cell.settings, "problem": cell.problem.id, "step": step}
        rows.append(head | row_of(chosen, by_file, order))
        costs += [head | cost_of(chosen, cell.problem)] if any(not run.reason for run in chosen) else []
    return rows, costs


def judged(program, files):
    ended = subprocess.run([program, "benchmark", "score", *files, "--format", "json"], capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        raise CannotScore(ended.stderr.strip() or f"status {ended.returncode}")
    return json.loads(ended.stdout)


def row_of(chosen, by_file, order):
    """Of the phases of one step.  A phase without an answer is the worst."""
    row = {"phases": len(chosen), "digest": matrix.digest(chosen)}
    reasons = [run.reason for run in chosen if run.reason]
    if reasons:
        return row | {"reason": reasons[0]}
    ones = [by_file[str(run.file)] for run in chosen]
    worst = max(ones, key=lambda one: (VERDICTS.index(one["verdict"]), size(one["error"])))
    row |= {name: largest(one[name] for one in ones) for name in ERRORS}
    return row | {"version": worst["engine_version"], "law": worst["law"], "verdict": worst["verdict"], "order": order,
                  "right": sum(one["order_right"] for one in ones), "finding": (worst["finding"] or "").replace(",", ";")}


def size(error):
    """An error that cannot be had is larger than any."""
    return float("inf") if error is None else error


def largest(errors):
    """The largest; nothing if one cannot be had or none applies."""
    errors = list(errors)
    return None if None in errors else max(errors)


def cost_of(chosen, problem):
    return {"duration": f"{problem.until:.4g}", "seconds": f"{min(run.seconds for run in chosen if not run.reason):.3g}"}
