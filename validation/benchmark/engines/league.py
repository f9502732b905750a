#!/usr/bin/python3
"""Runs the league: every engine on every problem, with every step and starting height, its own settings and tuned ones.

Started by `run`, which builds what this needs.  Writes league.csv, the numbers, which repeat to the bit on one machine, and
league_costs.csv, the times, which do not.  A cell (engine, problem, settings) that is done is kept in build/league/cells
until its adapter, its problem or the program changes; so a league that was interrupted goes on.
"""

import argparse
import csv
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
    parser.add_argument("--keep", action="store_true", help="keep the trajectories (600 MB for all)")
    parser.add_argument("--again", action="store_true", help="run every cell anew and say which numbers differ from those kept")
    return parser.parse_args()


def chosen(names, known, what):
    """The named ones of `known`, all without names."""
    wanted = names.split(",") if names else list(known)
    unknown = [name for name in wanted if name not in known]
    if unknown:
        sys.exit(f"league: unknown {what} '{unknown[0]}'; known: {', '.join(known)}")
    return [known[name] for name in wanted]


def fingerprint(engine, problem_file, places):
    """Of all that a cell depends on."""
    adapter = {"native": places.native / f"run-{engine.id}", "node": places.node / f"{engine.id}.mjs", "program": HERE / "program.py"}
    parts = [adapter[engine.adapter], problem_file, places.program, HERE / "runs.py", HERE / "matrix.py", HERE / "scores.py"]
    parts += [places.node / "package-lock.json", places.node / "problem.mjs"] if engine.adapter == "node" else []
    total = hashlib.sha256()
    for part in parts:
        total.update(part.read_bytes() if part.exists() else b"absent")
    return total.hexdigest()


def done(cell, places):
    """Rows and costs of a cell that is run now."""
    matrix.carry_out(cell, places)
    try:
        rows, costs = scores.scored(cell, str(places.program))
    except scores.CannotScore as refusal:
        for run in cell.runs:
            run.reason = run.reason or f"refused by the scorer: {str(refusal).splitlines()[-1]}".replace(",", ";")
        rows, costs = scores.scored(cell, str(places.program))
    return {"rows": rows, "costs": costs}


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
        mark = fingerprint(cell.engine, BENCHMARK / "problems" / f"{cell.problem.id}.toml", self.places)
        kept = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
        is_same = kept.get("fingerprint") == mark
        if is_same and not self.options.again:
            return kept
        result = done(cell, self.places) | {"fingerprint": mark}
        if is_same and kept["rows"] != result["rows"]:
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
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)


def write_table(file, title, columns, rows):
    with file.open("w", encoding="utf-8", newline="") as out:
        out.write(f"# {title}\n")
        out.writelines(f"# {name}: {meaning}\n" for name, meaning in columns.items() if meaning)
        table = csv.writer(out, lineterminator="\n")
        table.writerow(columns)
        table.writerows([written(row.get(name)) for name in columns] for row in rows)


def main():
    options = arguments()
    known, _ = matrix.read_engines()
    league = League(options)
    results = league.run(chosen(options.engines, known, "engine"), chosen(options.problems, runs.read_problems(BENCHMARK), "problem"))
    options.output.mkdir(parents=True, exist_ok=True)
    write_table(options.output / "league.csv", "The league: errors of engines on the benchmark, by validation/benchmark/engines/run",
                scores.COLUMNS, [row for result in results for row in result["rows"]])
    write_table(options.output / "league_costs.csv", "Times of the league's runs on one machine: not for ranking", scores.COST_COLUMNS,
                [row for result in results for row in result["costs"]])
    if league.differ:
        sys.exit(f"league: numbers differ from those of the run before: {', '.join(league.differ)}")


if __name__ == "__main__":
    main()
