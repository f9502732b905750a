#!/usr/bin/python3
"""Draws beta and gamma over theta (Figs. 7, 10 and 11 of the paper) from the program's own numbers.

    notebooks-data/contact_angles_picture.py PROGRAM > notebooks-data/contact_angles.svg
"""

import csv
import itertools
import subprocess
import sys

WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 640, 420, 60, 20, 20, 50
SPAN_X, SPAN_Y = 60, 90
CURVES = [("0", "beta_deg", "#0072b2", "", "β, no gravity"), ("0.1", "beta_deg", "#0072b2", "6 4", "β, G = 0.1"),
          ("0", "gamma_deg", "#d55e00", "", "γ, no gravity"), ("0.1", "gamma_deg", "#d55e00", "6 4", "γ, G = 0.1")]


def x_of(theta):
    return LEFT + theta / SPAN_X * (WIDTH - LEFT - RIGHT)


def y_of(angle):
    return HEIGHT - BOTTOM - angle / SPAN_Y * (HEIGHT - TOP - BOTTOM)


def rows(program, gravity_number):
    text = subprocess.run([program, "angles", "--from", "0", "--to", "60", "--step", "0.05", "--gravity-number",
                           gravity_number, "--format", "csv"], check=True, capture_output=True, text=True).stdout
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def curve(table, column, colour, dashes):
    """One polyline for each stretch of theta on which the impact happens."""
    out = []
    for happens, stretch in itertools.groupby(table, key=lambda row: bool(row[column])):
        points = " ".join(f"{x_of(float(r['theta_deg'])):.1f},{y_of(float(r[column])):.1f}" for r in stretch if happens)
        if happens:
            out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2" '
                       f'stroke-dasharray="{dashes}"/>')
    return "\n".join(out)


def axes():
    out = [f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{HEIGHT - TOP - BOTTOM}" '
           'fill="none" stroke="black"/>']
    for theta in range(0, SPAN_X + 1, 10):
        out.append(f'<line x1="{x_of(theta)}" x2="{x_of(theta)}" y1="{y_of(0)}" y2="{y_of(0) + 5}" stroke="black"/>')
        out.append(f'<text x="{x_of(theta)}" y="{y_of(0) + 20}" text-anchor="middle">{theta}</text>')
    for angle in range(0, SPAN_Y + 1, 15):
        out.append(f'<line x1="{LEFT - 5}" x2="{LEFT}" y1="{y_of(angle)}" y2="{y_of(angle)}" stroke="black"/>')
        out.append(f'<text x="{LEFT - 9}" y="{y_of(angle) + 4}" text-anchor="end">{angle}</text>')
    out.append(f'<text x="{x_of(30)}" y="{HEIGHT - 10}" text-anchor="middle">contact angle θ of the first impact [°]</text>')
    out.append(f'<text x="16" y="{y_of(45)}" text-anchor="middle" transform="rotate(-90 16 {y_of(45)})">'
               'contact angle of the second (β) and third (γ) impact [°]</text>')
    return out


def legend():
    out = []
    for i, (_, _, colour, dashes, name) in enumerate(CURVES):
        y = TOP + 22 + 20 * i
        out.append(f'<line x1="{LEFT + 15}" x2="{LEFT + 50}" y1="{y - 4}" y2="{y - 4}" stroke="{colour}" '
                   f'stroke-width="2" stroke-dasharray="{dashes}"/><text x="{LEFT + 58}" y="{y}">{name}</text>')
    return out


def main():
    tables = {g: rows(sys.argv[1], g) for g in ("0", "0.1")}
    body = axes() + [curve(tables[g], column, colour, dashes) for g, column, colour, dashes, _ in CURVES] + legend()
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
          f'font-size="13">\n<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>')
    print("\n".join(body))
    print("</svg>")


if __name__ == "__main__":
    main()
