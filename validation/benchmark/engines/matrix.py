# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of one engine on one problem with one of its settings: every step and gap, each a trajectory in a file."""

import hashlib
import math
import re
import subprocess
import sys
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import runs

HERE = Path(__file__).resolve().parent
STEPS = {"1/60": 1 / 60, "1/240": 1 / 240, "1/960": 1 / 960}  # s
SETTINGS = ("default", "tuned")
LONGEST = 120  # s for the runs of one engine, problem and setting together
NOT_FINITE = re.compile(r"\b(nan|inf|infinity)\b", re.IGNORECASE)
COMPLIANT = "the problem's ground cannot be set: this adapter knows a coefficient of restitution alone"


@dataclass(frozen=True)
class Engine:
    id: str
    name: str
    adapter: str
    package: str
    licence: str
    precision: int
    default: str
    tuned: str
    form: str
    phases: bool = True
    steps: bool = True

    def command(self, places):
        """What reads runs from standard input."""
        return {"native": [str(places.native / f"run-{self.id}")],
                "node": ["node", str(places.node / f"{self.id}.mjs")],
                "program": [sys.executable, "-B", str(HERE / "program.py"), self.id, str(places.program)]}[self.adapter]


@dataclass(frozen=True)
class Places:
    """Where things are built and kept."""
    native: Path
    node: Path
    program: Path
    trajectories: Path


@dataclass
class Run:
    """One trajectory: where it is, how long its steps took, or why there is none."""
    step: str  # of STEPS, or empty
    gap: float
    file: Path
    seconds: float = math.nan
    reason: str = ""


@dataclass
class Cell:
    engine: Engine
    problem: runs.Problem
    settings: str
    runs: list = field(default_factory=list)

    @property
    def name(self):
        return f"{self.engine.id}-{self.problem.id}-{self.settings}"


def read_engines():
    """Engines by their names, and those that are absent."""
    data = tomllib.loads((HERE / "engines.toml").read_text(encoding="utf-8"))
    return {row["id"]: Engine(**row) for row in data["engine"]}, data["absent"]


def planned(engine, problem, settings, folder):
    """The runs of a cell, none of them done."""
    cell = Cell(engine, problem, settings)
    gaps = problem.gaps if engine.phases else problem.gaps[:1]
    for step in STEPS if engine.steps else ("",):
        for number, gap in enumerate(gaps, 1):
            label = f"{cell.name}-{step.replace('/', '_')}-{number}.csv"
            cell.runs.append(Run(step, gap, folder / label))
    return cell


def carry_out(cell, places):
    """Fills in the runs of a cell.  What a crash or the time limit leaves undone is tried once more, alone."""
    places.trajectories.mkdir(parents=True, exist_ok=True)
    for run in cell.runs:
        run.file.unlink(missing_ok=True)
    if cell.problem.compliant and cell.engine.id != "clatter-simulate":
        for run in cell.runs:
            run.reason = COMPLIANT
        return
    attempt(cell, cell.runs, places)
    for run in filter(is_undone, cell.runs):
        failure = attempt(cell, [run], places)
        if is_undone(run):
            run.reason = failure
    for run in cell.runs:
        if not run.reason:
            run.reason = what_is_wrong_with(run.file)


def is_undone(run):
    return math.isnan(run.seconds) and not run.reason


def attempt(cell, chosen, places):
    """Hands the chosen runs to the adapter.  Returns why the last one undone is so."""
    lines = [runs.flat_numbers(cell.problem, run.gap, STEPS.get(run.step, 0.0) or STEPS["1/960"], cell.settings, run.file)
             for run in chosen]
    try:
        ended = subprocess.run(cell.engine.command(places), input="\n".join(lines) + "\n", capture_output=True, text=True,
                               timeout=LONGEST, check=False)
        output, failure = ended.stdout, ended.returncode and why_it_ended(ended)
    except subprocess.TimeoutExpired as late:
        output, failure = (late.stdout or b"").decode(), f"no end within {LONGEST} s"
    by_file = {str(run.file): run for run in chosen}
    for line in output.splitlines():
        word, _, rest = line.partition(" ")
        file, _, told = rest.partition(" ")
        if word == "done" and file in by_file:
            by_file[file].seconds = float(told)
        elif word == "cannot" and file in by_file:
            by_file[file].reason = told
    return failure or "the adapter left it out"


def why_it_ended(ended):
    """One clause: the last thing that the adapter said, or its status."""
    said = [line.strip() for line in ended.stderr.splitlines() if line.strip() and not line.startswith("    at ")]
    status = f"signal {-ended.returncode}" if ended.returncode < 0 else f"status {ended.returncode}"
    return f"ended with {status}" + (f": {said[-1][:160]}" if said else "")


def what_is_wrong_with(file):
    """Why a trajectory cannot be scored, or nothing."""
    for line in file.read_text(encoding="utf-8").splitlines():
        if not line.startswith("#") and NOT_FINITE.search(line):
            return f"a number that is none at t = {line.split(',')[0]}"
    return ""


def digest(chosen):
    """Of the trajectories' bytes: equal digests are equal numbers, to the bit."""
    total = hashlib.sha256()
    for run in chosen:
        total.update(run.reason.encode() if run.reason else run.file.read_bytes())
    return total.hexdigest()[:16]
