#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds to score a file of a million rows, in the plane and in space.  usage: score_benchmark.py PROGRAM"""
import math
import os
import pathlib
import sys
import tempfile
import time

os.environ["CLATTER_PROGRAM"] = sys.argv[1]

import exact_motion  # noqa: E402: reads the program's name from the environment

ROWS = 10 ** 6


def main():
    motion = exact_motion.Motion("rod-10-slow", 1)
    step = motion.end() / ROWS
    rows = motion.rows(step)
    space = ["# problem: rod-10-slow", "t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz"]
    for t, x, z, phi, vx, vz, omega in rows:
        space.append(f"{t!r},{x!r},0,{z!r},{math.cos(phi / 2)!r},0,{-math.sin(phi / 2)!r},0,{vx!r},0,{vz!r},0,{-omega!r},0")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("plane", motion.text(rows, step=step)), ("space", "\n".join(space) + "\n")):
            path = pathlib.Path(folder, name + ".csv")
            path.write_text(text)
            seconds = []
            for _ in range(3):
                start = time.perf_counter()
                done = exact_motion.run("benchmark", "score", str(path), "--require", "exact")
                seconds.append(time.perf_counter() - start)
                assert done.returncode == 0, done.stderr + done.stdout
            print(f"{name}: {len(rows)} rows in {min(seconds):.2f} s")


if __name__ == "__main__":
    main()
