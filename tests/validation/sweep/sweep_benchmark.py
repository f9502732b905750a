#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a million rods and a thousand phones take: tests/validation/sweep/sweep_benchmark.py PROGRAM"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

CASES = Path(__file__).resolve().parents[3] / "validation" / "cases"
SWEEPS = {
    "10^6 rods, discrete model": ["rod-45.toml", "--model", "discrete", "--random", "1000000", "--set", "drop.angle_deg=1:89",
                                  "--set", "impact.restitution=0.5:1", "--set", "run.impacts=3"],
    "1000 phones, two impacts, 4 digits": ["phone-damped.toml", "--random", "1000", "--set", "drop.angle_deg=5:85",
                                           "--set", "run.impacts=2", "--set", "run.digits=4"],
}


def seconds(program, sweep, folder):
    begin = time.perf_counter()
    subprocess.run([program, "sweep", CASES / sweep[0], *sweep[1:], "--output", Path(folder) / "rows.csv"], check=True,
                   stderr=subprocess.DEVNULL)
    taken = time.perf_counter() - begin
    (Path(folder) / "rows.csv").unlink()
    return taken


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, sweep in SWEEPS.items():
            print(f"{name}: {min(seconds(sys.argv[1], sweep, folder) for _ in range(3)):.2f} s, least of three")


if __name__ == "__main__":
    main()
