# SPDX-License-Identifier: GPL-3.0-or-later
"""The league's numbers by engine, settings, problem and step."""

import csv
import math
import statistics
import tomllib


def rows_of(path):
    return list(csv.DictReader(line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")))


def number(cell):
    return float(cell) if cell else math.inf


class League:
    STEPS = ("1/60", "1/240", "1/960")

    def __init__(self, data, catalogue):
        told = tomllib.loads(catalogue.read_text(encoding="utf-8"))
        self.rows = rows_of(data / "league.csv")
        self.costs = rows_of(data / "league_costs.csv")
        run = {row["engine"] for row in self.rows}
        self.engines = [engine for engine in told["engine"] if engine["id"] in run]
        self.absent = told["absent"]
        self.problems = list(dict.fromkeys(row["problem"] for row in self.rows))
        ids = (path.stem for path in sorted((catalogue.parent.parent / "problems").glob("*.toml")))
        self.not_run = [problem for problem in ids if problem not in self.problems]
        self.by_key = {(row["engine"], row["settings"], row["problem"], row["step"]): row for row in self.rows}

    def engine(self, name):
        return next(engine for engine in self.engines if engine["id"] == name)

    def settings_of(self, engine):
        return list(dict.fromkeys(row["settings"] for row in self.rows if row["engine"] == engine["id"]))

    def last_step(self, engine):
        """The finest; empty for what chooses its own."""
        return self.STEPS[-1] if engine.get("steps", True) else ""

    def answered(self, engine, settings, step):
        return [row for row in self.rows if (row["engine"], row["settings"], row["step"]) == (engine["id"], settings, step) and not row["reason"]]

    @staticmethod
    def error(row, column):
        """Of V and Ω together for "velocities"; unknown is infinite.  A wrong sequence is an error of 1 at least, as its
        impacts are compared only as far as there are any."""
        if column == "law_error":
            return number(row[column])
        least = 0.0 if row["right"] == row["phases"] else 1.0
        columns = ("velocity_error", "angular_velocity_error") if column == "velocities" else (column,)
        return max(least, *(number(row[name]) for name in columns))

    def median(self, engine, settings, step, column):
        """Over the problems that are answered; None where half of them have no error."""
        rows = self.answered(engine, settings, step)
        if column == "law_error":  # of a code without impacts it says nothing
            rows = [row for row in rows if row["right"] != "0"]
        errors = [self.error(row, column) for row in rows]
        middle = statistics.median_high(errors) if errors else math.inf
        return middle if math.isfinite(middle) else None

    def right(self, engine, settings, step):
        """Runs with the right number and order of impacts, of how many."""
        rows = self.answered(engine, settings, step)
        return sum(int(row["right"]) for row in rows), sum(int(row["phases"]) for row in rows)

    def judged(self, engine, settings):
        """What ranks settings: the median error of the velocities at the finest step."""
        error = self.median(engine, settings, self.last_step(engine), "velocities")
        return math.inf if error is None else error

    def best(self, engine):
        """Of the settings that were tried, those with the least error; the engine's own where that is equal."""
        return min(self.settings_of(engine), key=lambda settings: (self.judged(engine, settings), settings != "default"))

    def ranked(self):
        """By the error with the best settings; this program's models last."""
        return sorted(self.engines, key=lambda engine: (engine["adapter"] == "program",
                                                        self.judged(engine, self.best(engine)), engine["name"]))

    def digits(self, engine, settings, problem, step):
        """Right digits of V and Ω; a cross for a wrong sequence, a dash without an answer."""
        row = self.by_key.get((engine["id"], settings, problem, step))
        if row is None or row["reason"]:
            return "–"
        if row["right"] != row["phases"]:
            return "×"
        return str(max(0, min(15, math.floor(-math.log10(max(self.error(row, "velocities"), 1e-16))))))

    def reasons(self, engine):
        """Problems without an answer, by the reason."""
        by_reason = {}
        for row in self.rows:
            if row["engine"] == engine["id"] and row["reason"]:
                named = by_reason.setdefault(row["reason"], [])
                if row["problem"] not in named:
                    named.append(row["problem"])
        return by_reason

    def version(self, engine):
        return next((row["version"] for row in self.rows if row["engine"] == engine["id"] and row["version"]), "")

    def shown(self, engine, run):
        """The number of a run that a finding names.  ValueError if the run does not show it."""
        row = self.by_key[engine, run["settings"], run["problem"], run["step"]]
        value = number(row[run["column"]])
        if not run.get("above", -math.inf) < value < run.get("below", math.inf) and not (value == math.inf and "above" in run):
            raise ValueError(f"{engine}, {run}: {value} does not show it")
        return value if math.isfinite(value) else None

    def cost(self, engine, settings, step):
        """Wall time of the steps for a second of motion [s], over all answered problems."""
        chosen = [row for row in self.costs if (row["engine"], row["settings"], row["step"]) == (engine["id"], settings, step)]
        return sum(float(row["seconds"]) for row in chosen) / (sum(float(row["duration"]) for row in chosen) or math.nan)

    def summary(self):
        runs = sum(int(row["phases"]) for row in self.rows if not row["reason"])
        others = [engine for engine in self.engines if engine["package"] != "clatter"]
        return (f"{len(others)} engine builds of others and {len(self.engines) - len(others)} models of this program on {len(self.problems)} "
                f"of the benchmark's {len(self.problems) + len(self.not_run)} problems: {runs} runs. Not run: {', '.join(self.not_run)}.")
