#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the phone's two blows as a picture that moves, figures/phone.svg, from the simulator's history.

Motion is by style sheet, so that it stops where a reader asks for less motion, and on paper.
"""

import argparse
import csv
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from look import CONTINUOUS, GREEN, GREY, INK

ROOT = Path(__file__).resolve().parent.parent
FILE = ROOT / "notebooks-data" / "figures" / "phone.svg"
SCENE = "phone-damped"
WIDTH, HEIGHT, GROUND = 800, 300, 236  # of the picture, and where its ground is [px]
SCALE = 3200  # [px/m]
SECONDS = 520  # of the picture for one of the drop: slow motion
BEFORE, AFTER = 4e-3, 9e-3  # from this before the first touch to this after the second [s]
HOLD = 2.0  # at the end [s of the picture]
ARROW = 420  # of an impulse [px/(N·s)]
SHARE = 12  # a frame for so many px of the quickest point


def run(program):
    """The scene, its impacts as the program prints them, and the history of the motion."""
    with tempfile.TemporaryDirectory() as folder:
        history = Path(folder) / "history.csv"
        result = json.loads(subprocess.run([program, "simulate", SCENE, "--impacts", "3", "--format", "json", "--history", history],
                                           check=True, capture_output=True, text=True).stdout)
        rows = list(csv.DictReader(line for line in history.read_text(encoding="utf-8").splitlines() if not line.startswith("#")))
    names = ("t", "x", "z", "beta0", "beta2")
    return result, {name: np.array([float(row[name]) for row in rows]) for name in names}


def peak_of(impact):
    """When the contact's force is greatest, after the first touch [s]."""
    return impact["start"] + impact["peak_time"]


class Motion:
    """Place of the centre on the page [px] and turn, clockwise [°], of the phone at any time [s]."""

    def __init__(self, result, history):
        self.length, _, self.thickness = result["scene"]["body"]["size"]
        self.gravity = result["scene"]["world"]["gravity"]
        self.history = history
        self.turn = np.degrees(np.unwrap(2 * np.arctan2(history["beta2"], history["beta0"])))
        self.speed = result["impacts"][0]["approach_speed"]

    def at(self, t):
        """Before the first touch the phone falls without turning."""
        late = max(t, 0)
        x, z, turn = (np.interp(late, self.history["t"], values) for values in (self.history["x"], self.history["z"], self.turn))
        early = min(t, 0)
        return (WIDTH / 2 + SCALE * (x - self.history["x"][0]), GROUND - SCALE * (z - self.speed * early - self.gravity * early**2 / 2), turn)

    def corners(self, t):
        x, y, turn = self.at(t)
        c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
        half = SCALE / 2 * np.array([[i * self.length, j * self.thickness] for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
        return half @ np.array([[c, s], [-s, c]]) + [x, y]


def frames(motion, first, last):
    """Times between which no corner moves by more than SHARE [px], those of quick turns closer together."""
    times = np.linspace(first, last, 4000)
    way = np.cumsum([0] + [np.abs(motion.corners(b) - motion.corners(a)).max() for a, b in zip(times, times[1:])])
    return np.interp(np.linspace(0, way[-1], int(way[-1] / SHARE) + 2), way, times)


def percent(t, first, total):
    return f"{100 * (t - first) * SECONDS / total:.2f}%"


def pose(x, y, turn):
    return f"translate({x:.1f}px,{y:.1f}px) rotate({turn:.2f}deg)"


def box(motion, kind, place=None):
    length, thickness = SCALE * motion.length, SCALE * motion.thickness
    at = f' style="transform:{pose(*place)}"' if place else ""
    return (f'<g class="{kind}"{at}><rect x="{-length / 2:.1f}" y="{-thickness / 2:.1f}" width="{length:.1f}" height="{thickness:.1f}" rx="7"/>'
            f'<line x1="{-length / 2 + 9:.1f}" x2="{length / 2 - 9:.1f}" y1="{-thickness / 2 + 5:.1f}" y2="{-thickness / 2 + 5:.1f}"/></g>')


def blow(motion, impact, number, words):
    """The arrow of an impulse, where the lowest corner is when its force is greatest, and what it says."""
    peak = peak_of(impact)
    corners = motion.corners(peak)
    x = corners[np.argmax(corners[:, 1]), 0]
    length = ARROW * impact["impulse_normal"]
    return [box(motion, f"outline b{number}", motion.at(peak)),
            f'<g class="blow b{number}"><path d="M{x:.1f},{GROUND} v{-length:.1f} m-7,13 l7,-13 l7,13"/>'
            f'<text x="{x:.1f}" y="{GROUND + 24}"><tspan class="number">{impact["impulse_normal"]:.2f} N·s</tspan>'
            f'<tspan x="{x:.1f}" dy="19">{words}</tspan></text></g>']


def style(motion, times, peaks, total):
    first = times[0]
    keys = "".join(f"{percent(t, first, total)}{{transform:{pose(*motion.at(t))}}}" for t in times)
    end = pose(*motion.at(times[-1]))
    shown = "".join(f"@keyframes b{number}{{0%,{percent(peak, first, total)}{{opacity:0}}{percent(peak + 3e-4, first, total)},100%{{opacity:1}}}}"
                    f".b{number}{{animation:b{number} {total:.1f}s linear infinite}}" for number, peak in enumerate(peaks, 1))
    return f"""<style>
text{{font:15px "DejaVu Sans",sans-serif;fill:{INK};text-anchor:middle}}
.number{{font-weight:bold;fill:{CONTINUOUS}}}
.quiet{{fill:{GREY};font-size:13px}}
.ground{{stroke:{GREEN};stroke-width:3}}
.body rect{{fill:{CONTINUOUS};fill-opacity:.25;stroke:{CONTINUOUS};stroke-width:2.5}}
.outline rect{{fill:none;stroke:{GREY};stroke-width:1;stroke-dasharray:4 3}}
.body line{{stroke:{CONTINUOUS};stroke-width:1.5}} .outline line{{stroke:none}}
.blow path{{fill:none;stroke:{CONTINUOUS};stroke-width:4}}
@media (prefers-color-scheme:dark){{text{{fill:#dddddd}}.quiet{{fill:#aaaaaa}}}}
.body{{transform:{end};animation:move {total:.1f}s linear infinite}}
@keyframes move{{{keys}100%{{transform:{end}}}}}
{shown}
@media print,(prefers-reduced-motion:reduce){{.body,.blow,.outline{{animation:none}}}}
</style>"""


def picture(program):
    result, history = run(program)
    motion = Motion(result, history)
    one, two = result["impacts"][:2]
    first, last = -BEFORE, two["start"] + AFTER
    total = (last - first) * SECONDS + HOLD
    later = f"{1e3 * (peak_of(two) - peak_of(one)):.1f} ms from peak to peak, {two['impulse_normal'] / one['impulse_normal']:.1f} times as hard"
    angle = result["scene"]["drop"]["angle_deg"]
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="A phone falls at {angle:g}° and strikes the ground twice">',
        style(motion, frames(motion, first, last), [peak_of(one), peak_of(two)], total),
        f'<text class="quiet" x="{WIDTH / 2}" y="20">a phone falls from {result["scene"]["drop"]["height"]:g} m at {angle:g}°, '
        f'seen {SECONDS} times slower</text>',
        f'<line class="ground" x1="40" x2="{WIDTH - 40}" y1="{GROUND}" y2="{GROUND}"/>',
        *blow(motion, one, 1, "the low end strikes"), *blow(motion, two, 2, later),
        box(motion, "body"), "</svg>", ""])


def numbers(text):
    return np.array([float(number) for number in re.findall(r"-?\d+\.\d+", text)])


def same(kept, text):
    """But for a tenth of a pixel: another machine rounds differently."""
    pattern = r"-?\d+\.\d+"
    return re.sub(pattern, "", kept) == re.sub(pattern, "", text) and np.allclose(numbers(kept), numbers(text), rtol=0, atol=0.11)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path)
    parser.add_argument("--check", action="store_true", help="say whether it is what would be written, and change nothing")
    asked = parser.parse_args()
    text = picture(str(asked.program.resolve()))
    stale = not FILE.exists() or not same(FILE.read_text(encoding="utf-8"), text)
    if asked.check:
        if stale:
            print(f"{FILE.relative_to(ROOT)} is not what would be written; run notebooks-data/moving_picture.py")
        return 1 if stale else 0
    if stale:
        FILE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
