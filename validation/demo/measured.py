#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracked drops for the page of `clatter demo`, each with its motion at the first touch, from which the page predicts the rest.

Usage: measured.py PROGRAM [OUTPUT]
  OUTPUT  validation/demo/page/measured.json
The drops are the first ones that the law was not fitted on and that strike with a corner.
"""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy

HERE = Path(__file__).resolve().parent
TRACKS = HERE.parent / "measured/square-drops.csv"
COUNT = 6
FRAMES = 60
RATE, SIDE = 250, 0.06  # Hz, m
CLEAR = 2e-3  # m over the ground: frames of the fall
LENGTH, ANGLE = 1e4, 1e3  # places are whole tenths of a millimetre, angles whole milliradians


def printed(program, action):
    return json.loads(subprocess.run([program, "measured", action, "square-drops", "--format", "json"], check=True, capture_output=True, text=True).stdout)


def tracks():
    found = {}
    with TRACKS.open(encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            found.setdefault(row["drop"], []).append([float(row[name]) for name in ("sample", "x_m", "z_m", "angle_rad")])
    return {name: numpy.array(rows) for name, rows in found.items()}


def reach(angle):
    """From the centre of a square down to its lowest corner."""
    return SIDE / 2 * (abs(numpy.sin(angle)) + abs(numpy.cos(angle)))


def first_touch(time, x, z, angle):
    """Of the falling square, by least squares over the frames before: time, place and velocity. z from the ground."""
    low = int(numpy.argmax(z - reach(angle) < CLEAR))
    fits = [numpy.polynomial.Polynomial.fit(time[:low], values[:low], degree) for values, degree in ((x, 1), (z, 2), (angle, 1))]
    after = numpy.linspace(time[low - 1], time[low - 1] + 5 / RATE, 5001)
    at = after[int(numpy.argmax(fits[1](after) - reach(fits[2](after)) <= 0))]
    place, speed = [float(fit(at)) for fit in fits], [float(fit.deriv()(at)) for fit in fits]
    return float(at), place, speed


def drop(name, rows, turn):
    """Heights are from the ground under this square, on which it comes to rest in the end."""
    seen, rest = rows[rows[:, 0] < FRAMES], rows[-3:]
    ground = float(numpy.mean(rest[:, 2] - reach(rest[:, 3] - turn)))
    time, x, z, angle = seen[:, 0] / RATE, seen[:, 1] - seen[0, 1], seen[:, 2] - ground, seen[:, 3] - turn
    at, place, speed = first_touch(time, x, z, angle)
    return {"name": name, "touch": round(at, 6), "place": [round(p, 6) for p in place], "speed": [round(v, 5) for v in speed],
            "x": [round(v * LENGTH) for v in x], "z": [round(v * LENGTH) for v in z], "angle": [round(v * ANGLE) for v in angle]}


def main():
    program, output = sys.argv[1], Path(sys.argv[2]) if len(sys.argv) > 2 else HERE / "page/measured.json"
    predicted, fitted = printed(program, "predict"), printed(program, "fit")
    law = next(fit for fit in fitted["fits"] if fit["model"] == "newton")
    gives = {"gravity": predicted["data"]["gravity"], "e": law["restitution"], "friction": law["friction"], "inertia": predicted["calibration"]["inertia_factor"]}
    names = [row["drop"] for row in predicted["drops"] if row["point"]][:COUNT]
    all_tracks = tracks()
    drops = [drop(name, all_tracks[name], predicted["calibration"]["turn"][1]) for name in names]
    output.write_text(json.dumps({"rate": RATE, "side": SIDE, **{name: round(value, 5) for name, value in gives.items()}, "drops": drops}, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
