#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures cost against true error on eight scenes: tradeoff.csv, tradeoff.md and figures/tradeoff.svg.

    notebooks-data/tradeoff.py PROGRAM
    notebooks-data/tradeoff.py --page             tradeoff.md again, from the measurements that there are

Times of whole commands by earlier builds and this one are those of speed.csv, which tests/speed_benchmark.py --output writes.
The program carries tradeoff.csv: `clatter plan` predicts costs and errors from its counts of evaluations and its errors,
never from its times, which are those of the machine that measured them.
"""

import csv
import io
import subprocess
import sys
from pathlib import Path

DATA = Path(__file__).resolve().parent
ROOT = DATA.parent
SCENES = {"rod-10": "rod 10°", "rod-45": "rod 45°", "rod-friction-03": "rod with friction", "rod-damped": "rod with damping",
          "phone-elastic": "phone elastic", "phone-damped": "phone damped", "phone-corner": "phone on a corner",
          "box-flat": "flat landing"}
PICTURED, PICTURED_RUN = "phone-damped", ["--impacts", "2"]
COMMAND = "notebooks-data/tradeoff.py build/release/validation/clatter"


def case(scene):
    return f"validation/cases/{scene}.toml"


def measured(program, scene):
    """Header comments and rows of one scene."""
    run = subprocess.run([program, "plan", "--tradeoff", case(scene), "--format", "csv"], capture_output=True, text=True,
                         check=True, cwd=ROOT)
    lines = run.stdout.splitlines()
    return ([line for line in lines if line.startswith("#")],
            list(csv.DictReader(line for line in lines if not line.startswith("#"))))


def write_csv(table):
    text = io.StringIO()
    text.write(f"# Cost against true error on eight scenes: {COMMAND}\n")
    for scene, (comments, _) in table.items():
        text.writelines(f"# {scene}: {line[2:]}\n" for line in comments if "reference" in line or "error" in line)
    names = ["scene", *next(iter(table.values()))[1][0]]
    writer = csv.DictWriter(text, names, lineterminator="\n")
    writer.writeheader()
    for scene, (_, rows) in table.items():
        # Commas would split the words for readers that know no quotes.
        writer.writerows({"scene": scene} | {name: value.replace(",", ";") for name, value in row.items()} for row in rows)
    (DATA / "tradeoff.csv").write_text(text.getvalue())


def setting(row):
    how = row["tolerance"] and f"tolerance {float(row['tolerance']):.0e}" or row["step"] and f"step {float(row['step']):.1e} s"
    return " ".join(part for part in (row["method"], how, row["mesh"]) if part)


def front(rows):
    return sorted((row for row in rows if row["front"] == "true"), key=lambda row: float(row["seconds"]))


def speed_section():
    """Processor times of whole commands, build by build."""
    with (DATA / "speed.csv").open(encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    lines = ["", "## Whole commands, build by build", "",
             "Processor time [s] of the same works (`tests/speed_benchmark.py`), the least of repeated runs in turns on one machine;",
             f"{', '.join(names[1:-1])} are earlier commits. {names[1]} has no discrete model in space: its rows there are empty; and no errors",
             "beside numbers, which the later ones have by default:",
             "`run.errors=false` and `run.amplification=false` turn them off.", "",
             "| " + " | ".join(names) + f" | {names[-1]} / {names[1]} |", "|---" * (len(names) + 1) + "|"]
    for work, *times in rows:
        ratio = f"{float(times[-1]) / float(times[0]):.2f}" if times[0] and times[-1] else ""
        lines.append("| " + " | ".join([work, *(time or "not there" for time in times), ratio]) + " |")
    return lines


def measured_before():
    """The rows of tradeoff.csv."""
    with (DATA / "tradeoff.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {scene: ([], [row for row in rows if row["scene"] == scene]) for scene in SCENES}


def write_page(table):
    lines = ["# Cost against true error", "", f"Made by `{COMMAND}`, from tradeoff.csv beside it. Of every model, method,",
             "tolerance, step and mesh these are the ones that no other beats in both cost and error. Cost is the least",
             "wall time of repeated runs in milliseconds on the machine that measured them; the error is the largest over",
             "all impacts and numbers, relative to the sequence's sizes."]
    for scene, (_, rows) in table.items():
        failed = sum(1 for row in rows if row["failure"])
        lines += ["", f"## {SCENES[scene]} (`{case(scene)}`)", "",
                  f"{len(rows)} points, {failed} of them without an error (the CSV says why).", "",
                  "| model | setting | cost [ms] | evaluations | error |", "|---|---|---|---|---|"]
        lines += [f"| {row['model']} | {setting(row)} | {1e3 * float(row['seconds']):.2g} | {row['force_evaluations']} | "
                  f"{float(row['error']):.1e} |" for row in front(rows)]
    (DATA / "tradeoff.md").write_text("\n".join(lines + speed_section()) + "\n")


def main():
    if sys.argv[1] == "--page":
        write_page(measured_before())
        return
    program = str(Path(sys.argv[1]).resolve())
    table = {scene: measured(program, scene) for scene in SCENES}
    write_csv(table)
    write_page(table)
    picture = DATA / "figures" / "tradeoff.svg"
    subprocess.run([program, "plan", "--tradeoff", case(PICTURED), *PICTURED_RUN, "--plot", str(picture)], check=True, cwd=ROOT,
                   stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()
