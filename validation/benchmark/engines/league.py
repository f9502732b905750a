#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the league: every engine on every problem, with every step and starting height, its own settings and tuned ones.

Started by `run`, which builds what this needs.  Writes league.csv, the numbers, which repeat to the bit on one machine, and
league_costs.csv, the times, which do not.  A cell (engine, problem, settings) that is done is kept in build/league/cells
until its adapter, its problem or the program changes; so a league that was interrupted goes on.
"""

import argparse
import csv
import functools
import hashlib
import json
import sys
import time
from pathlib import Path

import matrix
import runs
import scores

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent.parent
BENCHMARK = HERE.parent


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", type=Path, required=True, help="clatter, which scores")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "league", help="folder of adapters, trajectories and cells")
    parser.add_argument("--output", type=Path, default=ROOT / "notebooks-data", help="folder of league.csv and league_costs.csv")
    parser.add_argument("--engines", help="IDs, separated by commas (all)")
    parser.add_argument("--problems", help="IDs, separated by commas (all)")
    parser.add_argument("--keep", action="store_true", help="keep the trajectories, so that another scorer can judge them without new runs (600 MB for all)")
    parser.add_argument("--again", action="store_true", help="run every cell anew and say which numbers differ from those kept")
    parser.add_argument("--check", action="store_true", help="look at the arguments and stop")
    return parser.parse_args()


def chosen(names, known, what):
    """The named ones of `known`, all without names."""
    wanted = names.split(",") if names else list(known)
    unknown = [name for name in wanted if name not in known]
    if unknown:
        print(f"engines/run: unknown {what} '{unknown[0]}'; known: {', '.join(known)}", file=sys.stderr)
        sys.exit(2)
    return [known[name] for name in wanted]


@functools.lru_cache(maxsize=None)
def digest_of(files):
    total = hashlib.sha256()
    for file in files:
        total.update(file.read_bytes() if file.exists() else b"absent")
    return total.hexdigest()


def fingerprints(engine, problem, places):
    """Of all that a cell's trajectories depend on, and of all that its scores depend on besides."""
    adapter = {"native": [places.native / f"run-{engine.id}"],
               "node": [places.node / f"{engine.id}.mjs", places.node / "package-lock.json", places.node / "problem.mjs"],
               "program": [HERE / "program.py", places.program]}
    shared = [BENCHMARK / "problems" / f"{problem.id}.toml", BENCHMARK / "truth.csv", HERE / "runs.py", HERE / "matrix.py"]
    return {"ran": digest_of((*adapter[engine.adapter], *shared)), "judged": digest_of((places.program, HERE / "scores.py"))}


def carried_out_before(cell, kept):
    """Takes over the runs of a cell if their trajectories are still there."""
    told = {one["file"]: one for one in kept["runs"]}
    if not all(str(run.file) in told and (told[str(run.file)]["reason"] or run.file.exists()) for run in cell.runs):
        return False
    for run in cell.runs:
        run.seconds, run.reason = told[str(run.file)]["seconds"], told[str(run.file)]["reason"]
    return True


def scores_of(cell, places):
    """Rows and costs of a cell that has been carried out."""
    told = [{"file": str(run.file), "seconds": run.seconds, "reason": run.reason} for run in cell.runs]
    try:
        rows, costs = scores.scored(cell, str(places.program))
    except scores.CannotScore as refusal:
        for run in cell.runs:
            run.reason = run.reason or f"refused by the scorer: {str(refusal).splitlines()[-1]}".replace(",", ";")
        rows, costs = scores.scored(cell, str(places.program))
    return {"rows": rows, "costs": costs, "runs": told}


class League:
    def __init__(self, options):
        self.options = options
        self.places = matrix.Places(options.build / "native", options.build / "node", options.program.resolve(), options.build / "trajectories")
        self.cells = options.build / "cells"
        self.cells.mkdir(parents=True, exist_ok=True)
        self.differ = []

    def result(self, cell):
        """Kept or new."""
        file = self.cells / f"{cell.name}.json"
        marks = fingerprints(cell.engine, cell.problem, self.places)
        kept = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {"marks": {}}
        if kept["marks"] == marks and not self.options.again:
            return kept
        if self.options.again or kept["marks"].get("ran") != marks["ran"] or not carried_out_before(cell, kept):
            matrix.carry_out(cell, self.places)
        result = scores_of(cell, self.places) | {"marks": marks}
        if kept["marks"] == marks and kept["rows"] != result["rows"]:
            self.differ.append(cell.name)
        file.write_text(json.dumps(result), encoding="utf-8")
        if not self.options.keep:
            for run in cell.runs:
                run.file.unlink(missing_ok=True)
        return result

    def run(self, engines, problems):
        """Results in the order of the tables; tells how far it is on standard error."""
        cells = [matrix.planned(engine, problem, settings, self.places.trajectories)
                 for engine in engines for problem in problems for settings in matrix.SETTINGS]
        begun, results = time.monotonic(), []
        for number, cell in enumerate(cells, 1):
            results.append(self.result(cell))
            tell(f"{number}/{len(cells)} {time.monotonic() - begun:.0f} s  {cell.name}", number == len(cells))
        return results


def tell(text, is_last):
    """Progress in one line of a terminal; elsewhere every hundredth."""
    if sys.stderr.isatty():
        print(f"\r{text:72}", end="\n" if is_last else "", file=sys.stderr, flush=True)
    elif is_last or int(text.split("/")[0]) % 100 == 0:
        print(f"league: {text}", file=sys.stderr, flush=True)


def written(value):
    """Errors to six digits: the digest holds the rest."""
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)


def write_table(file, title, columns, rows):
    with file.open("w", encoding="utf-8", newline="") as out:
        out.write(f"# {title}\n")
        out.writelines(f"# {name}: {meaning}\n" for name, meaning in columns.items() if meaning)
        table = csv.writer(out, lineterminator="\n")
        table.writerow(columns)
        table.writerows([written(row.get(name)) for name in columns] for row in rows)


def main():
    options = arguments()
    engines = chosen(options.engines, matrix.read_engines()[0], "engine")
    problems = chosen(options.problems, runs.read_problems(BENCHMARK), "problem")
    if options.check:
        return
    league = League(options)
    results = league.run(engines, problems)
    options.output.mkdir(parents=True, exist_ok=True)
    write_table(options.output / "league.csv", "The league: errors of engines on the benchmark, by validation/benchmark/engines/run",
                scores.COLUMNS, [row for result in results for row in result["rows"]])
    write_table(options.output / "league_costs.csv", "Times of the league's runs on one machine: not for ranking", scores.COST_COLUMNS,
                [row for result in results for row in result["costs"]])
    if league.differ:
        sys.exit(f"league: numbers differ from those of the run before: {', '.join(league.differ)}")


if __name__ == "__main__":
    main()
