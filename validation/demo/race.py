#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The race of the page of `clatter demo`: the league's runs of one drop, small enough to be shipped.

Usage: race.py [TRAJECTORIES [OUTPUT]]
  TRAJECTORIES  of validation/benchmark/engines/run --problems rod-10-brisk --keep (build/league/trajectories)
  OUTPUT        validation/demo/page/race.json
"""

import csv
import json
import math
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BENCHMARK = ROOT / "validation/benchmark"
PROBLEM = "rod-10-brisk"
# As a game runs: each engine's own settings, a picture a step.
SETTINGS, STEP = "default", "1/60"
GAP = 1  # of the problem's starting heights, from 0
LENGTH = 1e4  # places are whole tenths of a millimetre, angles whole milliradians
ANGLE = 1e3


def head_and_rows(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    head = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# ") and ": " in line)
    return head, [{name: float(text) for name, text in row.items()} for row in csv.DictReader(line for line in lines if not line.startswith("#"))]


def kept(row, body, speed):
    """The part of its energy that a thin rod has left at the end."""
    return (row["vx"] ** 2 + row["vz"] ** 2 + (body["length"] * row["omega"]) ** 2 / 12) / speed ** 2


def runs(folder, engines, problem):
    for path in sorted(folder.glob(f"*-{PROBLEM}-{SETTINGS}-{STEP.replace('/', '_')}-{GAP + 1}.csv")):
        engine = engines.get(path.name.split(f"-{PROBLEM}-")[0])
        if engine is None or engine["id"].startswith("clatter"):
            continue
        head, rows = head_and_rows(path)
        yield {"name": engine["name"], "version": head["version"], "settings": engine[SETTINGS], "energy": round(kept(rows[-1], problem["body"], problem["drop"]["speed"]), 4),
               "z": [round(row["z"] * LENGTH) for row in rows], "phi": [round(row["phi"] * ANGLE) for row in rows]}


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/league/trajectories"
    output = Path(sys.argv[2]) if len(sys.argv) > 2 else HERE / "page/race.json"
    problem = tomllib.loads((BENCHMARK / f"problems/{PROBLEM}.toml").read_text(encoding="utf-8"))
    engines = {engine["id"]: engine for engine in tomllib.loads((BENCHMARK / "engines/engines.toml").read_text(encoding="utf-8"))["engine"]}
    found = list(runs(folder, engines, problem))
    if not found:
        sys.exit(f"race.py: no run in {folder}; first:  validation/benchmark/engines/run --problems {PROBLEM} --keep")
    steps = float(STEP.split("/")[0]) / float(STEP.split("/")[1])
    drop = {"angle": problem["drop"]["angle_deg"], "speed": problem["drop"]["speed"], "gap": problem["problem"]["gaps"][GAP]}
    assert all(math.isfinite(run["energy"]) for run in found)
    output.write_text(json.dumps({"drop": drop, "step": steps, "runs": found}, ensure_ascii=False, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
