#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what the documents show of the program's output: blocks of README.md and of the reference's pages,
verification.md, the figures' data, extremes.md with figures/extremes.svg.

A block stands between "<!-- output: COMMAND -->", "<!-- table: COMMAND -->", "<!-- code: FILE -->", "<!-- measurement -->",
"<!-- errata -->" or "<!-- costs -->" and "<!-- end -->".  The costs are those of tradeoff.csv, which tradeoff.py measures.  The paper's figures and other pictures
are drawn from the data by figures.py, to be run after this.
"""

import argparse
import csv
import functools
import itertools
import json
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
README = ROOT / "README.md"
FAULTS = ROOT / "tests" / "seeded_faults" / "faults.toml"
VERIFICATION = ROOT / "notebooks-data" / "verification.md"
TRADEOFF = ROOT / "notebooks-data" / "tradeoff.csv"
PAGES = ROOT / "notebooks-data" / "reference"
BLOCK = re.compile(r"(<!-- ((?P<kind>output|table|code|measurement|errata|costs)(: (?P<what>[^\n]+?))?) -->\n).*?(?P<end><!-- end -->)", re.DOTALL)
LANGUAGES = {".txt": "cmake", ".cpp": "cpp", ".py": "python", ".toml": "toml"}
EXTREMES = ROOT / "notebooks-data" / "extremes.md"
FIGURES = ROOT / "notebooks-data" / "figures"
DRAWN = {  # pictures of README that a command draws; no test compares their bytes
    "map.png": ("map", "--over", "drop.angle_deg=0:60", "--over", "impact.restitution=0:1", "--quantity", "impacts",
                "--restart", "--output"),
    "atlas.svg": ("atlas", "handset", "--plot"),
    "shock.svg": ("shock", "phone-damped", "--impacts", "2", "--probe", "camera:0.048,0.016,0.0095", "--no-sensitivity", "--severity", "2",
                  "--plot")}
COSTS_OF = ("rod-10", "rod-45", "phone-damped")
GROUPS = {"C": "Claims of the paper", "E": "Errata", "F": "Figures", "X": "Exact results",
          "M": "Both models over every scene", "R": "Random scenes", "B": "Error bars",
          "S": "The discrete model in space"}


@functools.cache
def printed_once(program, command):
    return printed(program, shlex.split(command)[1:])


def printed(program, arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True, cwd=ROOT).stdout


def number(check):
    """Five digits; errors below them differ from machine to machine."""
    value = check["number"]
    text = str(int(value)) if value == int(value) and abs(value) < 1e5 else f"{value:.5g}"
    # A rounding error has no digits that other machines would print too.
    text = "below 1e-15" if 0 < abs(value) < 1e-15 else text
    return text.replace("-", "−") + (f" {check['unit']}" if check["unit"] else "")


def cell(text):
    return text.replace("|", "\\|")


def settled(text):
    """Without rounding errors and what hangs on them, which differ from machine to machine, and without times."""
    return re.sub(r"\d(\.\d+)?e[-−]\d\d|\d+ force evaluations|[\d.]+ s of processor time", "", text)


MEASURED = {  # rows of `clatter measured score` as README shows them
    "first impacts that one impulse at a corner explains": ("point impacts",),
    "as fitted: e, μ and, of the body, axes and inertia": ("as fitted",),
    "e and μ fitted, the body as described": ("body as described",),
    "published e and μ, the body as described": ("published parameters",),
    "no impact at all": ("no change",),
    "the other first impacts: as one, as a sequence of impacts": ("no point impact: one impact",
                                                                  "no point impact: the sequence"),
}


@functools.cache
def measurement(program):
    """Median misses of the predicted motion after impact 1, for both sets of tracked drops."""
    sets = {name: {row["quantity"]: row for row in
                   json.loads(printed(program, ["measured", "score", name, "--format", "json"]))["scores"]}
            for name in ("square-drops", "cube-tosses")}

    def share(row):
        value = row["value"]
        return (f"{value:.0f} %" if value >= 100 else f"{value:.2g} %") + (f" of {row['drops']}" if row["quantity"] == "point impacts" else "")

    lines = ["| motion after impact 1 misses the measured one by, in the median | squares | cubes |", "|---|---|---|"]
    for words, quantities in MEASURED.items():
        cells = [", ".join(share(rows[quantity]) for quantity in quantities if quantity in rows) or "–"
                 for rows in sets.values()]
        lines.append(f"| {words} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


@functools.cache
def errata(program):
    """What the paper prints and what is right, with the number that each gives, by the paper's equations and then its figures."""
    def order(check):
        figure, number = "Fig" in check["place"], int(re.search(r"\d+", check["place"]).group())
        return figure, number, "after" in check["place"], int(check["id"][1:])

    def value(check, form):
        given = check[form + "_value"]
        return "–" if given is None else number({"number": given, "unit": check["compared_unit"]})

    checks = json.loads(printed(program, ["verify", "--only", *(f"E{i}" for i in range(1, 12)), "--format", "json"]))["checks"]
    lines = ["| | printed | right | number | printed gives | right gives | |", "|---|---|---|---|---|---|---|"]
    for check in sorted(checks, key=order):
        cells = [check["place"], check["printed"], check["right"], check["compared"], value(check, "printed"), value(check, "right"), check["id"]]
        lines.append("| " + " | ".join(cell(text) for text in cells) + " |")
    return "\n".join(lines) + "\n"


def cheapest(points, digits):
    """The cheapest point of a scene that gives the digits, as words."""
    serving = [p for p in points if p["error"] and float(p["error"]) <= 10.0**-digits and not p["mesh"]]
    if not serving:
        return "–"
    best = min(serving, key=lambda p: float(p["seconds"]))
    setting = f"{float(best['tolerance']):.0e}" if best["tolerance"] else ""
    how = " ".join(part for part in (best["method"], setting) if part) or best["model"]
    return f"{how}, {1e3 * float(best['seconds']):.2g} ms"


def costs():
    """A scene a row: what the models without contact times miss, and the cheapest setting for some digits."""
    lines = TRADEOFF.read_text(encoding="utf-8").splitlines()
    points = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    rows = ["| scene (`validation/cases/`) | error of the discrete model | 3 digits | 6 digits | 9 digits |",
            "|---|---|---|---|---|"]
    for scene, of_scene in itertools.groupby(points, key=lambda p: p["scene"]):
        if scene not in COSTS_OF:
            continue
        own = list(of_scene)
        discrete = next(p for p in own if p["model"] == "discrete")
        miss = f"{float(discrete['error']):.1g}" if discrete["error"] else "does not apply"
        rows.append(f"| `{scene}` | {miss} | {' | '.join(cheapest(own, digits) for digits in (3, 6, 9))} |")
    return "\n".join(rows) + "\n"


def verification(result):
    lines = [f"# What `clatter verify` found (clatter {result['clatter']})", "",
             "Written by `notebooks-data/documents.py`.  `clatter verify --html FILE` draws the figures too.",
             "A tolerance is at most five times the error seen when it was set; \"because\" says what that error is made of.",
             "", f"{result['passed']} of {len(result['checks'])} checks passed."]
    for letter, title in GROUPS.items():
        lines += ["", f"## {title}", "", "| | claim | answer | number | found | oracle | error at most | because |",
                  "|---|---|---|---|---|---|---|---|"]
        for check in result["checks"]:
            if check["id"][0] == letter:
                cells = [check["id"], check["claim"], check["answer"], f"{check['quantity']}: {number(check)}", check["found"],
                         f"{check['oracle']}; {check['metric']}", f"{check['tolerance']:.2g}", check["reason"]]
                lines.append("| " + " | ".join(cell(text) for text in cells) + " |")
    return "\n".join([*lines, *faults_that_turn_red(result["checks"])]) + "\n"


def faults_that_turn_red(checks):
    """For each check the faults that make it fail, as tests/seeded_faults/run --verify sees them do."""
    faults = tomllib.loads(FAULTS.read_text(encoding="utf-8")).values()
    lines = ["", "## Faults that turn each check red", "",
             "`tests/seeded_faults/run --verify` puts each of these faults into the program and sees the checks fail.", "",
             "| | what is wrong then |", "|---|---|"]
    for check in checks:
        wrong = [fault["what"] for fault in faults if check["id"] in fault.get("turns_red", "").split()]
        lines.append(f"| {check['id']} | {cell('; '.join(wrong))} |")
    return lines


def span(region):
    first, last = region["labels"]
    return first if first == last else f"{first} … {last}"


def digits(region):
    if region["fewest_digits"] is None:
        return ""
    low, high = int(region["fewest_digits"]), int(region["most_digits"])
    return str(low) if low == high else f"{low}–{high}"


def extremes(result):
    """Without costs, which no two runs share."""
    lines = [f"# What holds at the extremes (clatter {result['clatter']})", "",
             "Written by `notebooks-data/documents.py` from `clatter verify --extremes --format json --plot notebooks-data/figures/extremes.svg`;",
             "no test compares it, since digits near rounding differ from machine to machine.  Costs are left out.",
             "F2 and F3 are the folds at 58.488442288312° and 27.577809606636°; long: 10⁴ impacts (hits), random scenes (sc).", "",
             f"{result['message'][0].upper() + result['message'][1:]}.", "",
             "![digits of each model over each quantity](figures/extremes.svg)", "",
             "| quantity | model | values | right digits | outcome, or why there is no number |", "|---|---|---|---|---|"]
    for region in result["regions"]:
        outcome = region["outcome"] or region["verdict"]
        words = outcome if region["reason"] is None else f"{outcome}: {region['reason']}"
        lines.append("| " + " | ".join(cell(text) for text in (region["axis"], region["model"], span(region), digits(region),
                                                               words)) + " |")
    return "\n".join(lines) + "\n"


def code(name):
    """A file of the source tree as a listing, without its line on the licence."""
    text = (ROOT / name).read_text(encoding="utf-8")
    kept = "".join(line for line in text.splitlines(keepends=True) if "SPDX-License-Identifier" not in line and not line.startswith("#!"))
    return f"```{LANGUAGES[Path(name).suffix]}\n{kept}```\n"


def table(program, command):
    """The rows that a command prints as Markdown, apart from what else it says."""
    lines = printed_once(program, command + " --format markdown").splitlines(keepends=True)
    return "".join(line for line in lines if line.startswith("|"))


def renewed(program, text):
    """The text of a document with what its blocks show now."""
    def block(found):
        kind, what = found.group("kind"), found.group("what")
        if kind == "output":
            content = f"```\n{printed_once(program, what)}```\n"
        elif kind == "table":
            content = "\n" + table(program, what) + "\n"
        else:
            content = code(what) if kind == "code" else costs() if kind == "costs" else {"measurement": measurement, "errata": errata}[kind](program)
        return found.group(1) + content + found.group("end")
    return BLOCK.sub(block, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--check", action="store_true", help="say which are not what the program prints, and change nothing")
    asked = parser.parse_args()
    program = str(asked.program.resolve())
    result = json.loads(printed(program, ["verify", "--format", "json"]))
    shown = [README, *sorted(PAGES.rglob("*.md"))]
    wanted = {path: renewed(program, path.read_text(encoding="utf-8")) for path in shown} | {VERIFICATION: verification(result)}
    stale = [path for path, text in wanted.items() if not path.exists() or settled(path.read_text(encoding="utf-8")) != settled(text)]
    if asked.check:
        for path in stale:
            print(f"{path.relative_to(ROOT)} is not what the program prints; run notebooks-data/documents.py")
        return 1 if stale else 0
    for path in stale:
        path.write_text(wanted[path], encoding="utf-8")
    printed(program, ["verify", "--figures", "--output", str(FIGURES)])
    for name, command in DRAWN.items():
        printed(program, [*command, str(FIGURES / name)])
    map_of_extremes = printed(program, ["verify", "--extremes", "--format", "json", "--plot", str(FIGURES / "extremes.svg")])
    EXTREMES.write_text(extremes(json.loads(map_of_extremes)), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
