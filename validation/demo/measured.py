#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracked drops for the page of `clatter demo`, each with its motion at the first touch, from which the page predicts the rest.

Usage: measured.py PROGRAM [SQUARES [CUBES]]
  SQUARES  validation/demo/page/measured.json
  CUBES    validation/demo/page/cubes.json
The drops are the first ones that the law was not fitted on and that strike with a corner.
"""

import csv
import itertools
import json
import subprocess
import sys
from pathlib import Path

import numpy

HERE = Path(__file__).resolve().parent
TRACKS = HERE.parent / "measured"
COUNT = 6
FRAMES = 60
RATE, SIDE = 250, 0.06  # Hz, m
CUBE_RATE, CUBE_SIDE, CUBE_FRAMES = 148, 0.1048, 45  # Hz, m; later frames were not in hand
CLEAR = 2e-3  # m over the ground: frames of the fall
LENGTH, ANGLE = 1e4, 1e3  # places are whole tenths of a millimetre, angles whole milliradians


def printed(program, action, data="square-drops"):
    return json.loads(subprocess.run([program, "measured", action, data, "--format", "json"], check=True, capture_output=True, text=True).stdout)


def tracks(data, drop, names):
    found = {}
    with (TRACKS / f"{data}.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            found.setdefault(row[drop], []).append([float(row[name]) for name in ("sample", *names)])
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


def law_of(predicted, fitted):
    law = next(fit for fit in fitted["fits"] if fit["model"] == "newton")
    gives = {"gravity": predicted["data"]["gravity"], "e": law["restitution"], "friction": law["friction"], "inertia": predicted["calibration"]["inertia_factor"]}
    return {name: round(value, 5) for name, value in gives.items()}


def product(p, q):
    """Of Euler parameters: first the second, then the first."""
    (a, u), (b, v) = (p[..., 0], p[..., 1:]), (q[..., 0], q[..., 1:])
    return numpy.concatenate([(a * b - (u * v).sum(-1))[..., None], a[..., None] * v + b[..., None] * u + numpy.cross(u, v)], -1)


def turned_by(vectors):
    """Euler parameters of rotation vectors."""
    size = numpy.linalg.norm(vectors, axis=-1, keepdims=True)
    return numpy.concatenate([numpy.cos(size / 2), 0.5 * numpy.sinc(size / 2 / numpy.pi) * vectors], -1)


def lowest(q):
    """From the centre of a cube down to its lowest corner, for each attitude."""
    corners = CUBE_SIDE / 2 * numpy.array(list(itertools.product((-1, 1), repeat=3)))
    turned = [product(product(q, numpy.broadcast_to(numpy.r_[0, corner], q.shape)), q * [1, -1, -1, -1])[..., 3] for corner in corners]
    return -numpy.min(turned, axis=0)


def first_touch_of_cube(time, places, q):
    """Of the falling cube: time, place, velocity, attitude, spin. A cube's moments of inertia are alike: its spin is constant."""
    low = int(numpy.argmax(places[:, 2] - lowest(q) < CLEAR))
    fits = [numpy.polynomial.Polynomial.fit(time[:low], places[:low, axis], 1 + (axis == 2)) for axis in range(3)]
    since = product(q[:low], numpy.broadcast_to(q[0] * [1, -1, -1, -1], q[:low].shape))
    since *= numpy.sign(since[:, :1])
    size = numpy.linalg.norm(since[:, 1:], axis=1, keepdims=True)
    turned = since[:, 1:] * numpy.where(size > 0, 2 * numpy.arctan2(size, since[:, :1]) / numpy.where(size > 0, size, 1), 2)
    slopes = [numpy.polynomial.Polynomial.fit(time[:low], turned[:, axis], 1).convert() for axis in range(3)]
    at = numpy.linspace(time[low - 1], time[low - 1] + 5 / CUBE_RATE, 5001)
    attitude = product(turned_by(numpy.stack([slope(at) for slope in slopes], -1)), numpy.broadcast_to(q[0], (len(at), 4)))
    touch = int(numpy.argmax(fits[2](at) - lowest(attitude) <= 0))
    return float(at[touch]), [fit(at[touch]) for fit in fits], [fit.deriv()(at[touch]) for fit in fits], attitude[touch], [slope.coef[1] for slope in slopes]


def cube(name, rows):
    """Heights are from the ground under this cube, on which it comes to rest in the end."""
    seen, rest = rows[rows[:, 0] < CUBE_FRAMES], rows[-3:]
    ground = float(numpy.mean(rest[:, 3] - lowest(rest[:, 4:])))
    time, q = seen[:, 0] / CUBE_RATE, seen[:, 4:] / numpy.linalg.norm(seen[:, 4:], axis=1, keepdims=True)
    places = seen[:, 1:4] - [*seen[0, 1:3], ground]
    at, place, speed, attitude, spin = first_touch_of_cube(time, places, q)
    digits = {"touch": round(at, 6), "place": [round(float(p), 6) for p in place], "speed": [round(float(v), 5) for v in speed],
              "attitude": [round(float(p), 6) for p in attitude], "spin": [round(float(w), 5) for w in spin]}
    return {"name": name, **digits, "places": numpy.rint(places * LENGTH).astype(int).ravel().tolist(), "turns": numpy.rint(q * ANGLE).astype(int).ravel().tolist()}


def write(output, head, drops):
    output.write_text(json.dumps({**head, "drops": drops}, separators=(",", ":")) + "\n", encoding="utf-8")


def main():
    program, *outputs = sys.argv[1:]
    squares, cubes = [Path(given) if given else HERE / "page" / name for given, name in itertools.zip_longest(outputs, ("measured.json", "cubes.json"))]
    predicted = printed(program, "predict")
    names = [row["drop"] for row in predicted["drops"] if row["point"]][:COUNT]
    all_tracks = tracks("square-drops", "drop", ("x_m", "z_m", "angle_rad"))
    drops = [drop(name, all_tracks[name], predicted["calibration"]["turn"][1]) for name in names]
    write(squares, {"rate": RATE, "side": SIDE, **law_of(predicted, printed(program, "fit"))}, drops)
    predicted = printed(program, "predict", "cube-tosses")
    names = [row["drop"] for row in predicted["drops"] if row["point"]][:COUNT]
    all_tracks = tracks("cube-tosses", "toss", ("x_m", "y_m", "z_m", "q0", "q1", "q2", "q3"))
    write(cubes, {"rate": CUBE_RATE, "side": CUBE_SIDE, **law_of(predicted, printed(program, "fit", "cube-tosses"))}, [cube(name, all_tracks[name]) for name in names])


if __name__ == "__main__":
    main()
