#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Processor time of programs side by side on works that users wait for.

tests/speed_benchmark.py [--runs N] [--only WORD] [--limit RATIO] [--output FILE] [NAME=]PROGRAM ...

Each work is run N times (3) by each program in turn, so that all meet the same machine; the least counts.  With two or
more the last column is the last over the one before it, and the exit status is 1 if a ratio exceeds RATIO (1.05).  Works
shorter than 50 ms are shown, not judged: what starts a process varies by more.  FILE gets the seconds as CSV under the
NAMEs, without a number where a program refuses the work.
"""

import argparse
import csv
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

CASES = Path(__file__).resolve().parents[1] / "validation" / "cases"
ROWS = "--output rows.csv"
WORKS = {
    "one sequence": "sequence --angle 10",
    "10^6 angles": f"angles --from 0.1 --to 58 --count 1000000 --format csv {ROWS}",
    "10^6 rods, discrete": "sweep rod-45 --model discrete --random 1000000 --set drop.angle_deg=1:89 "
                           f"--set impact.restitution=0.5:1 --set run.impacts=3 {ROWS}",
    "20 000 phones in space": "sweep phone-corner --model discrete --random 20000 --set drop.angle_deg=0:90 "
                              f"--set drop.tilt_deg=-180:180 --set impact.friction=0 {ROWS}",
    "2000 phones in space, friction": "sweep phone-corner --model discrete --random 2000 --set drop.angle_deg=0:90 "
                                      f"--set impact.friction=0.05:0.5 {ROWS}",
    "a damped phone": "simulate phone-damped",
    "a damped phone, two impacts": "simulate phone-damped --impacts 2",
    "a rod at 45 degrees": "simulate rod-45",
    "41 damped phones": f"sweep phone-damped --set drop.angle_deg=5:85:2 {ROWS}",
    "41 damped phones, no errors": "sweep phone-damped --set drop.angle_deg=5:85:2 --set run.errors=false "
                                   f"--set run.amplification=false {ROWS}",
    "1000 phones, two impacts": "sweep phone-damped --random 1000 --set drop.angle_deg=5:85 --set run.impacts=2 "
                                f"--set run.digits=4 {ROWS}",
    "both models of a phone": "compare phone-elastic",
    "checks": "verify --quick",
    "161 damped phones": f"sweep phone-damped --set drop.angle_deg=5:85:0.5 {ROWS}",
    "161 damped phones, no errors": "sweep phone-damped --set drop.angle_deg=5:85:0.5 --set run.errors=false "
                                    f"--set run.amplification=false {ROWS}",
    "161 damped phones, errors alone": "sweep phone-damped --set drop.angle_deg=5:85:0.5 --set run.amplification=false "
                                       f"{ROWS}",
}
WORKS["the score of 10^6 rows"] = "benchmark score motion.csv"
JUDGED_FROM = 0.05  # s


def write_motion(folder):
    """A level rod that falls and rebounds."""
    with open(Path(folder, "motion.csv"), "w", encoding="utf-8") as file:
        file.write("# problem: flat\nt,x,z,phi,vx,vz,omega\n")
        file.writelines(f"{k * 1e-6!r},0,{1.5 * abs(k * 1e-6 - 1e-2)!r},0,0,{-1.5 if k < 10000 else 1.5},0\n" for k in range(10**6))


def processor_time(program, work, folder):
    """Of one run [s], over all its threads; None if the program refuses the work."""
    words = [str(CASES / f"{word}.toml") if (CASES / f"{word}.toml").exists() else word for word in work.split()]
    (Path(folder) / "rows.csv").unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run([program, *words], cwd=folder, capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    taken = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return taken if run.returncode in (0, 1) else None  # 1: a check failed, in the same time


def least_times(programs, work, runs, folder):
    times = [[processor_time(program, work, folder) for program in programs] for _ in range(runs)]
    return [None if None in of_one else min(of_one) for of_one in zip(*times)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", metavar="[NAME=]PROGRAM")
    parser.add_argument("--output", type=Path, metavar="FILE")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", default="", metavar="WORD")
    parser.add_argument("--limit", type=float, default=1.05, metavar="RATIO")
    given = parser.parse_args()
    names = [program.split("=")[0] for program in given.programs]
    programs = [str(Path(program.split("=")[-1]).resolve()) for program in given.programs]
    is_slower, rows = False, []
    with tempfile.TemporaryDirectory() as folder:
        write_motion(folder)
        for name, work in WORKS.items():
            if given.only not in name:
                continue
            times = least_times(programs, work, given.runs, folder)
            rows.append([name, *("" if time is None else f"{time:.3g}" for time in times)])
            line = f"{name:32}" + "".join("   refused" if time is None else f"{time:8.2f} s" for time in times)
            if len(times) > 1 and None not in times[-2:]:
                ratio = times[-1] / max(times[-2], 1e-3)
                is_slow = ratio > given.limit and times[-1] > JUDGED_FROM
                is_slower = is_slower or is_slow
                line += f"{ratio:8.2f}" + ("  slower" if is_slow else "")
            print(line, flush=True)
    if given.output:
        with given.output.open("w") as file:
            csv.writer(file, lineterminator="\n").writerows([["work", *names], *rows])
    return 1 if is_slower else 0


if __name__ == "__main__":
    sys.exit(main())
