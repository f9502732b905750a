#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The adapter of this program's own two models: program.py clatter-simulate|clatter-sequence PROGRAM

Reads runs as every adapter does (native/problem.hpp).  Both models locate their impacts, so a run begins at the touch.
"""

import json
import math
import subprocess
import sys
import time
from pathlib import Path

from runs import rotated

PAPER = {"stiffness": 1e11, "radius": 0.01, "digits": 6}  # the ground of Shan et al. (2005) and their rod
STIFF = {"stiffness": 1e19, "radius": 0.0001, "digits": 9}


def numbers(text):
    return [float(part) for part in text.split(",")]


def read(line):
    pairs = dict(pair.split("=", 1) for pair in line.split())
    words = ("problem", "shape", "settings", "output")
    return {key: text if key in words else numbers(text) if "," in text else float(text) for key, text in pairs.items()}


def damping_ratio(restitution):
    """s = (c_G/k_G) v at which a contact returns e: ln((1 + s)/(1 - s e)) = s (1 + e), by bisection."""
    if restitution >= 1:
        return 0.0
    low, high = 1e-12, 1 / restitution - 1e-12 if restitution else 1e6
    for _ in range(200):
        s = (low + high) / 2
        if math.log((1 + s) / (1 - s * restitution)) < s * (1 + restitution):
            low = s
        else:
            high = s
    return low


def approach_speed(run):
    """Of the body's lowest point, downward."""
    half = [run["length"] / 2, run["width"] / 2, run["height"] / 2]
    corners = [(x * half[0], y * half[1], z * half[2]) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    arm = min((rotated(run["attitude"], corner) for corner in corners), key=lambda place: place[2])
    spin = run["angular_velocity"]
    return -(run["velocity"][2] + spin[0] * arm[1] - spin[1] * arm[0])


def scene_of(run, continuous):
    """The scene file's text."""
    rod = run["shape"] == "rod" or run["cylinder"] > 0
    use = STIFF if run["settings"] == "tuned" else PAPER
    radius = run["cylinder"] or (use["radius"] * run["length"] if continuous else 0.0)
    drop = [f"velocity = {run['velocity']}", f"angular_velocity = {run['angular_velocity']}", f"attitude = {run['attitude']}"]
    if not run["space"]:
        angle = math.degrees(-2 * math.atan2(run["attitude"][2], run["attitude"][0]))
        drop = [f"angle_deg = {angle!r}", f"speed = {-run['velocity'][2]!r}", f"tangential_velocity = {run['velocity'][0]!r}",
                f"spin = {run['angular_velocity'][1]!r}"]
    body = [f'shape = "{"rod" if rod else "box"}"', f"mass = {run['mass']!r}"]
    body += [f"length = {run['length']!r}", f"radius = {radius!r}"] if rod else [f"size = {[run['length'], run['width'], run['height']]}"]
    parts = {"drop": drop, "world": [f"gravity = {run['gravity']!r}"], "body": body,
             "run": [f"impacts = {run['impacts']:.0f}", f"digits = {use['digits']}"]}
    if continuous:
        stiffness = run["stiffness"] or use["stiffness"]
        damping = run["damping"] or stiffness * damping_ratio(run["restitution"]) / approach_speed(run)
        parts["ground"] = [f"stiffness = {stiffness!r}", f"damping = {damping!r}", f"static_friction = {run['friction']!r}",
                           f"sliding_friction = {run['friction']!r}", 'area = "projected"']
    else:
        parts["impact"] = [f"restitution = {run['restitution']!r}"] + [f"friction = {run['friction']!r}"] * (run["friction"] > 0)
    return "".join(f"[{name}]\n" + "\n".join(lines) + "\n\n" for name, lines in parts.items()), radius


def heads(run, engine, version):
    lines = {"engine": engine.replace("-", " "), "version": version, "problem": run["problem"], "settings": run["settings"],
             "law": "newton routh"}
    return [f"# {key}: {value}" for key, value in lines.items()]


def trajectory(history, run, radius):
    """Flights of the history in the form that is asked for: rows within a contact are left out, but for its ends."""
    lines = [line for line in history.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    names = lines[0].split(",")
    states = [{name: float(cell) for name, cell in zip(names, line.split(",")) if cell} for line in lines[1:]]
    touching = [True, *(state["in_contact"] > 0 for state in states), True]
    rows, phi = [], 0.0
    for number, now in enumerate(states, 1):
        is_within = all(touching[number - 1:number + 2])
        if (is_within and 1 < number < len(states)) or (rows and not now["t"] > rows[-1][0]):
            continue
        q = [now[f"beta{i}"] for i in range(4)]
        v, w = [now[f"v{axis}"] for axis in "xyz"], [now[f"w{axis}"] for axis in "xyz"]
        if run["space"]:
            rows.append([now["t"], now["x"], now["y"], now["z"], *q, *v, *w])
            continue
        angle = -2 * math.atan2(q[2], q[0])
        phi = angle + 2 * math.pi * round((phi - angle) / (2 * math.pi))
        # A thin rod stands here with a radius: its rim is lower than its axis.
        lift = 0.0 if run["cylinder"] or run["shape"] == "box" else radius * math.cos(rows[0][3] if rows else phi)
        rows.append([now["t"], now["x"], now["z"] - lift, phi, v[0], v[2], -w[1]])
    columns = "t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz" if run["space"] else "t,x,z,phi,vx,vz,omega"
    return [columns] + [",".join(map(repr, row)) for row in rows]


def place_of(impact):
    """An end's name, or a corner's signs in space."""
    if not impact.get("place"):
        return impact["end"]
    return "".join(f"{'-' if part < 0 else '+'}{axis}" for part, axis in zip(impact["place"], "xyz"))


def impact_list(told, run):
    rows = ["t,place,Px,Py,Pz,Vx,Vy,Vz,Wx,Wy,Wz" if run["space"] else "t,place,Pn,Pt,V,Omega"]
    for impact in told["impacts"]:
        v, w, push = impact["velocity_after"], impact["angular_velocity_after"], impact["impulse"]
        values = [*push, *v, *w] if run["space"] else [push[2], push[0], v[2], w[1]]
        rows.append(",".join([repr(impact["start"]), place_of(impact), *map(repr, values)]))
    return rows


def answer(engine, program, run):
    """Writes the answer; returns the program's wall time."""
    output = Path(run["output"])
    scene, history = output.with_suffix(".toml"), output.with_suffix(".history")
    continuous = engine == "clatter-simulate"
    text, radius = scene_of(run, continuous)
    scene.write_text(text, encoding="utf-8")
    command = [program, "simulate" if continuous else "sequence", str(scene), "--format", "json"]
    if continuous:
        command += ["--history", str(history)] + ["--planar"] * (not run["space"])
    before = time.perf_counter()
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    seconds = time.perf_counter() - before
    if ended.returncode not in (0, 3):
        raise ValueError((ended.stderr.strip().splitlines() or [f"status {ended.returncode}"])[-1])
    told = json.loads(ended.stdout)
    rows = trajectory(history, run, radius) if continuous else impact_list(told, run)
    output.write_text("\n".join(heads(run, engine, told["clatter"]) + rows) + "\n", encoding="utf-8")
    scene.unlink()
    history.unlink(missing_ok=True)
    return seconds


def main():
    engine, program = sys.argv[1:]
    for line in filter(str.strip, sys.stdin):
        run = read(line)
        try:
            print("done", run["output"], answer(engine, program, run))
        except ValueError as reason:
            print("cannot", run["output"], reason)


if __name__ == "__main__":
    main()
