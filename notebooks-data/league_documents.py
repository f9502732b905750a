#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what the league's numbers say: league.md, league.html, two pictures and the blocks "<!-- league -->" of README.md and the reference, from
league.csv and league_costs.csv.

    notebooks-data/league_documents.py            writes them
    notebooks-data/league_documents.py --check    says which are not what the numbers say, and changes nothing

The numbers are made by validation/benchmark/engines/run.  A row of "what goes wrong" stands only as long as the runs that
it names show it.
"""

import re
import sys
import tomllib
from pathlib import Path

from league_pages import as_html, as_markdown, heading, items, picture, table, text
from league_pictures import against_cost, against_step
from league_tables import League
from plotting import svg

DATA = Path(__file__).resolve().parent
ENGINES = DATA.parent / "validation" / "benchmark" / "engines"
SHOWN_IN = (DATA.parent / "README.md", DATA / "reference" / "benchmark.md")
BLOCK = re.compile(r"(?<=<!-- league -->\n).*?(?=<!-- end -->)", re.DOTALL)
FIRST_ROWS = 5
COMMAND = "validation/benchmark/engines/run"
PICTURES = {"league_steps.svg": against_step, "league_costs.svg": against_cost}


def power(value):
    """A size of an error: two digits."""
    return "?" if value is None else "0" if value == 0 else f"{value:.1e}".replace("e-0", "e-").replace("e+00", "")


def main_table(league, settings_of):
    """An engine a row, with the settings that `settings_of` names."""
    head = ["engine", "settings", "bits", "law", "V, Ω at 1/60 s", "1/240 s", "1/960 s", "energy", "sequences right"]
    rows = []
    for engine in league.ranked():
        settings, last = settings_of(engine), league.last_step(engine)
        steps = [power(league.median(engine, settings, step, "velocities")) for step in league.STEPS] if last else \
            ["", "", power(league.median(engine, settings, last, "velocities"))]
        right, all_phases = league.right(engine, settings, last)
        rows.append([engine["name"], settings, str(engine["precision"]), power(league.median(engine, settings, last, "law_error")), *steps,
                     power(league.median(engine, settings, last, "energy_error")), f"{right} of {all_phases}"])
    return table(head, rows)


def first_lines(league):
    """The head of the table: the best settings, and the error with the engine's own."""
    head = ["engine", "V, Ω off by", "impulse off by", "sequences right", "V, Ω by default"]
    rows = []
    for engine in league.ranked()[:FIRST_ROWS]:
        best, last = league.best(engine), league.last_step(engine)
        rows.append([engine["name"], power(league.median(engine, best, last, "velocities")),
                     power(league.median(engine, best, last, "law_error")), "{} of {}".format(*league.right(engine, best, last)),
                     power(league.median(engine, "default", last, "velocities"))])
    return as_markdown([table(head, rows)])


def digits_table(league):
    """Right digits of V and Ω on each problem, default/tuned."""
    head = ["engine", *(str(number) for number, _ in enumerate(league.problems, 1))]
    rows = [[engine["name"], *("/".join(league.digits(engine, settings, problem, league.last_step(engine))
                                        for settings in league.settings_of(engine)) for problem in league.problems)]
            for engine in league.ranked()]
    return table(head, rows)


def findings_table(league, findings):
    rows = []
    for finding in findings:
        engine = league.engine(finding["engine"])
        shown = [f"{run['problem']}, {run['settings']}{', ' + run['step'] + ' s' if run['step'] else ''}: {words_of(run)} "
                 f"{number_of(run, league.shown(finding['engine'], run))}" for run in finding["shown"]]
        rows.append([engine["name"], finding["says"], "; ".join(shown)])
    return table(["engine", "what goes wrong", "shown by"], rows)


def number_of(run, value):
    return f"{value:.0f}" if run["column"] == "right" else power(value)


def words_of(run):
    return {"law_error": "law", "velocity_error": "V", "angular_velocity_error": "Ω", "energy_error": "energy", "time_error": "t",
            "flight_error": "flight", "right": "starting heights right"}[run["column"]]


def settings_table(league):
    rows = [[engine["name"], league.version(engine), engine["licence"], engine["package"], engine["form"], engine["default"], engine["tuned"]]
            for engine in league.engines]
    return table(["engine", "version", "licence", "package", "body and floor", "default", "tuned"], rows)


def unanswered(league):
    rows = [[engine["name"], reason, ", ".join(problems)] for engine in league.engines for reason, problems in league.reasons(engine).items()]
    return table(["engine", "why there is no answer", "problems"], rows)


def blocks(league, findings, notes):
    problems = items(f"{number}: {problem}" for number, problem in enumerate(league.problems, 1))
    return [
        heading(1, "The league: how engines do on the clattering benchmark"),
        text(f"Made by `{COMMAND}` and `notebooks-data/league_documents.py` from league.csv beside this page. {league.summary()}"),
        text(notes["measures"]), picture("figures/league_steps.svg", "Error of the velocities over the step, engine by engine"),
        heading(2, "Engines with the best settings that were tried"), text(notes["best"]), main_table(league, league.best),
        heading(2, "Engines as they come"), text(notes["default"]), main_table(league, lambda engine: "default"),
        heading(2, "Right digits of V and Ω, problem by problem"), text(notes["digits"]), digits_table(league), problems,
        heading(2, "What goes wrong"), text(notes["wrong"]), findings_table(league, findings),
        heading(2, "Error against cost"), text(notes["cost"]), picture("figures/league_costs.svg", "Error of the velocities over the time of a run"),
        heading(2, "Fairness"), items(notes["fairness"]),
        heading(2, "Settings, versions, licences"), text(notes["settings"]), settings_table(league),
        heading(2, "What is not answered"), unanswered(league),
        heading(2, "Engines that are not run here"), text(notes["submit"]),
        table(["engine", "why"], [[one["name"], one["reason"]] for one in league.absent])]


def documents():
    """File names and texts."""
    league = League(DATA, ENGINES / "engines.toml")
    told = tomllib.loads((ENGINES / "findings.toml").read_text(encoding="utf-8"))
    page = blocks(league, told["finding"], told["notes"])
    pictures = {DATA / "figures" / name: svg(draw(league)) for name, draw in PICTURES.items()}
    drawn = {f"figures/{path.name}": text for path, text in pictures.items()}
    shown = {path: BLOCK.sub(lambda _: first_lines(league), path.read_text(encoding="utf-8"), count=1) for path in SHOWN_IN}
    return pictures | shown | {DATA / "league.md": as_markdown(page), DATA / "league.html": as_html(page, drawn)}


def main():
    check = "--check" in sys.argv[1:]
    old = [file for file, now in documents().items() if not file.exists() or file.read_text(encoding="utf-8") != now]
    for file, now in documents().items():
        if file in old and not check:
            file.write_text(now, encoding="utf-8")
    for file in old if check else []:
        print(f"{file.relative_to(DATA.parent)} is not what the league's numbers say; run notebooks-data/league_documents.py")
    return 1 if check and old else 0


if __name__ == "__main__":
    sys.exit(main())
