# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter measured` with a mesh and with balls: tracks are made here, by Euler's equations step by step and by impulses at the
touching point, so that the restitution and friction that are fitted must be those of the impacts."""

import math
import random

import numpy as np
from run_folder import Folder
from space_folder import cross, product, rotated, runge_kutta, turned_back

RATE, GRAVITY = 240, 9.81
POSITION_NOISE, ROTATION_NOISE = 5e-5, 5e-4  # [m], [rad]
CORNERS_MM = ((0, 0, 0), (80, 0, 10), (20, 70, 0), (15, 20, 60))


def add(a, b, factor=1.0):
    return tuple(x + factor * y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def times(m, v):
    return tuple(dot(row, v) for row in m)


def unit(v):
    size = math.sqrt(dot(v, v))
    return tuple(x / size for x in v)


def turn_by(v):
    angle = math.sqrt(dot(v, v))
    factor = math.sin(angle / 2) / angle if angle > 0 else 0.5
    return (math.cos(angle / 2), *(factor * x for x in v))


class Body:
    """Of mass 1; corners and inertia about the centre of mass."""

    def __init__(self, corners, inertia, radius=0.0):
        self.corners, self.inertia, self.inverse, self.radius = corners, inertia, np.linalg.inv(inertia).tolist(), radius

    def arms(self, q):
        return [rotated(q, corner) for corner in self.corners] or [(0, 0, -self.radius)]

    def lowest(self, q):
        return min(self.arms(q), key=lambda arm: arm[2])

    def flown(self, q, spin, time):
        """Attitude and angular velocity (body axes) later, by Runge and Kutta's rule."""
        def rate(y):
            return (*(x / 2 for x in product(y[:4], (0, *y[4:]))), *times(self.inverse, cross(times(self.inertia, y[4:]), y[4:])))
        y, steps = (*q, *spin), max(1, math.ceil(abs(time) * 480))
        for _ in range(steps):
            y = runge_kutta(rate, y, time / steps)
        return unit(y[:4]), y[4:]

    def struck(self, arm, q, velocity, spin, e, mu):
        """Velocity and angular velocity (world) after an impulse with Poisson's restitution, in small normal steps."""
        slip_scale = 1e-3  # [m/s]
        world = list(zip(*(rotated(q, times(self.inverse, turned_back(q, axis))) for axis in np.eye(3).tolist())))  # A I⁻¹ Aᵀ

        def slip_after(u, push):
            return add(u, add(push, cross(times(world, cross(arm, push)), arm)))

        def force(u):
            size = math.hypot(u[0], u[1], slip_scale)
            return (-mu * u[0] / size, -mu * u[1] / size, 1.0), size
        u, total, end, is_compressed = add(velocity, cross(spin, arm)), (0.0, 0.0, 0.0), math.inf, False
        while total[2] < end:
            push, size = force(u)
            step = min(max(1e-4, 0.01 * size), 5e-3, end - total[2])
            push, _ = force(slip_after(u, tuple(step / 2 * f for f in push)))
            push = tuple(step * f for f in push)
            after = slip_after(u, push)
            if after[2] >= 0 and not is_compressed:
                is_compressed, end = True, (1 + e) * (total[2] + step * u[2] / (u[2] - after[2]))
            total, u = add(total, push), after
        return add(velocity, total), add(spin, times(world, cross(arm, total)))


def track(body, e, mu, rng, spin_size, slip):
    """Frames (time, centre, attitude) about one impact, or None: another corner comes first."""
    arm = body.corners and rng.choice(body.corners)
    q = unit(tuple(rng.gauss(0, 1) for _ in range(4)))
    if arm:  # the corner below the centre, tilted by up to 0.4 rad
        down = unit(arm)
        axis = cross(down, (0, 0, -1))
        angle = math.acos(max(-1.0, min(1.0, -down[2])))
        q = turn_by(tuple(angle * x for x in unit(axis)))
        heading = rng.uniform(0, 2 * math.pi)
        tilt = rng.uniform(0.05, 0.4)
        q = product(turn_by((tilt * math.cos(heading), tilt * math.sin(heading), 0)), q)
    arm = body.lowest(q)
    heading, speed = rng.uniform(0, 2 * math.pi), rng.uniform(*slip)
    velocity = (speed * math.cos(heading), speed * math.sin(heading), -rng.uniform(1.5, 2.5))
    spin = tuple(rng.uniform(-spin_size, spin_size) for _ in range(3))
    if add(velocity, cross(spin, arm))[2] > -0.5:
        return None
    after, spin_after = body.struck(arm, q, velocity, spin, e, mu)
    before_time, frames = 0.1 + rng.uniform(0, 1 / RATE), []
    first_after = math.ceil(before_time * RATE)
    for samples, v, w in ((range(first_after - 1, -1, -1), velocity, spin), (range(first_after, 60), after, spin_after)):
        time, motion = 0.0, (q, turned_back(q, w))
        for k in samples:
            t = k / RATE - before_time
            motion, time = body.flown(*motion, t - time), t
            place = add(add((0.3, -0.2, -arm[2]), v, t), (0, 0, -GRAVITY / 2 * t * t))
            if place[2] + body.lowest(motion[0])[2] < 0:
                break
            frames.append((k, place, motion[0]))
        if place[2] + body.lowest(motion[0])[2] < 0 and k < first_after + 10:
            return None
    return sorted(frames)


def tracks(count, body, e, mu, seed, spin_size=12.0, slip=(0.3, 1.5)):
    """Drops, each its frames with noise."""
    rng, drops = random.Random(seed), []
    while len(drops) < count:
        frames = track(body, e, mu, rng, spin_size, slip)
        if frames:
            noise = [[tuple(rng.gauss(0, size) for _ in range(3)) for size in (POSITION_NOISE, ROTATION_NOISE)] for _ in frames]
            drops.append([(k, add(place, shift), product(turn_by(turn), q)) for (k, place, q), (shift, turn) in zip(frames, noise)])
    return drops


def table(drops, origin=(0, 0, 0)):
    """@param origin  what is tracked, from the centre of mass, body axes"""
    rows = [",".join([str(number + 1), str(k), *(f"{x:.9f}" for x in (*add(place, rotated(q, origin)), *q))])
            for number, drop in enumerate(drops) for k, place, q in drop]
    return "\n".join(["drop,sample,x_m,y_m,z_m,q0,q1,q2,q3", *rows, ""])


def tetrahedron():
    """In m about the centre of mass, and that centre: C = m/20 Σ v vᵀ, I = tr C − C."""
    corners = [tuple(x / 1000 for x in corner) for corner in CORNERS_MM]
    centre = tuple(sum(x) / 4 for x in zip(*corners))
    corners = [add(corner, centre, -1) for corner in corners]
    c = [[sum(v[i] * v[j] for v in corners) / 20 for j in range(3)] for i in range(3)]
    trace = sum(c[i][i] for i in range(3))
    return Body(corners, [tuple((trace if i == j else 0) - c[i][j] for j in range(3)) for i in range(3)]), centre


def ball(radius, factor):
    return Body([], [tuple(factor * 0.4 * radius * radius * (i == j) for j in range(3)) for i in range(3)], radius)


FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))
OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS_MM) + "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in FACES)
MESH = "[body]\nmass = 0.2\nmesh.file = 'part.obj'\nmesh.unit = 'mm'\n[track]\nmotion = 'space'\nrate = 240\n"


class MeasuredBodies(Folder):
    def fitted(self, name, e, mu):
        found = self.json_of("measured", "fit", name, status=(0,))
        row = next(row for row in found["fits"] if row["model"] == "poisson")
        for value, truth in (("restitution", e), ("friction", mu)):
            bar = row[value + "_half_width"]
            self.assertLess(bar, 0.002)
            self.assertLess(abs(row[value] - truth), bar, (value, row[value], truth, bar))
        return found

    def test_a_mesh_gives_back_the_restitution_and_friction_of_its_impacts(self):
        self.write("part.obj", OBJ)
        body, centre = tetrahedron()
        drops = tracks(40, body, 0.5, 0.2, seed=1)
        self.write("a.csv", table(drops))
        self.write("a.toml", MESH)
        found = self.fitted("a.csv", 0.5, 0.2)
        self.assertLess(abs(found["calibration"]["inertia_factor"] - 1), 0.02)
        self.assertNotIn("rounding", found["calibration"])
        scores = {row["quantity"]: row for row in self.json_of("measured", "score", "a.csv", status=(0,))["scores"]}
        self.assertGreaterEqual(scores["point impacts"]["value"], 95)
        self.assertGreaterEqual(scores["first corner"]["value"], 95)
        self.assertLess(scores["poisson"]["value"], 0.3)
        predicted = self.json_of("measured", "predict", "a.csv", status=(0,))["drops"]
        self.assertLessEqual({row["corner"] for row in predicted}, {"1", "2", "3", "4"})
        # The place of the mesh's own origin in place of the centre of mass.
        self.write("b.csv", table(drops, tuple(-x for x in centre)))
        self.write("b.toml", MESH + "point = 'origin'\n")
        self.fitted("b.csv", 0.5, 0.2)
        head = " ".join(self.run_program("measured", "fit", "b.csv").stdout.split())
        for words in ("part.obj, extents 0.08", "4 corners touch", "mesh: 4 triangles, nothing repaired", "poses: of the file's origin, axes of part.obj; z up",
                      "corners as the mesh has them"):
            self.assertIn(words, head)

    def test_a_ball_gives_back_restitution_friction_and_inertia(self):
        self.write("hollow.csv", table(tracks(40, ball(0.03, 5 / 3), 0.7, 0.25, seed=3, spin_size=30.0, slip=(1.0, 4.0))))
        self.write("hollow.toml", "[body]\nradius = 0.03\n[track]\nmotion = 'space'\nrate = 240\n")
        calibration = self.fitted("hollow.csv", 0.7, 0.25)["calibration"]
        self.assertLess(abs(calibration["inertia_factor"] - 5 / 3), 2 * calibration["inertia_half_width"])
        self.assertLess(calibration["inertia_half_width"], 0.05)
        self.assertNotIn("turn", calibration)
        report = self.run_program("measured", "score", "hollow.csv").stdout
        self.assertIn("body: ball of radius 0.03 m", report)
        for word in ("corner", "turned by", "face", "by angle"):
            self.assertNotIn(word, report)
        self.json_of("measured", "predict", "hollow.csv", status=(0,))

    def test_friction_that_no_impact_settles_has_no_bar(self):
        # Every impact ends without slip: friction beyond what that needs changes nothing.
        self.write("a.csv", table(tracks(24, ball(0.03, 1.0), 0.7, 0.5, seed=5, spin_size=5.0, slip=(0.3, 1.5))))
        self.write("a.toml", "[body]\nradius = 0.03\n[track]\nmotion = 'space'\nrate = 240\n")
        for row in self.json_of("measured", "fit", "a.csv", status=(0,))["fits"]:
            self.assertIsNone(row["friction_half_width"])
            self.assertLess(abs(row["restitution"] - 0.7), 0.005)
        self.assertIn("μ is not settled", self.run_program("measured", "fit", "a.csv").stdout)

    def test_what_cannot_be_is_said_in_one_line(self):
        self.write("part.obj", OBJ)
        self.write("open.obj", OBJ.rsplit("f ", 1)[0])
        self.write("a.csv", "drop,sample,x_m,y_m,z_m,q0,q1,q2,q3\n1,0,0,0,1,1,0,0,0\n")
        track_words = "[track]\nmotion = 'space'\nrate = 240\n"
        for body, words in (("mass = 1\n", "body.size: required, the box's [L, W, T] in m, or body.radius of a ball, or body.mesh.file"),
                            ("size = [1, 1, 1]\nradius = 1\n", "body.radius"), ("radius = 1\nmesh.file = 'part.obj'\n", "body.mesh.file"),
                            ("radius = 0\n", "body.radius"), ("radius = 1\nmesh.unit = 'mm'\n", "body.mesh.unit"),
                            ("mesh.file = 'part.obj'\nmesh.unit = 'mil'\n", "mm, cm, m, in, or a length in m"), ("mesh.file = 'none.obj'\n", "none.obj"),
                            ("mesh.file = 'open.obj'\n", "open.obj")):
            self.write("a.toml", "[body]\n" + body + track_words)
            self.refused(words, "measured", "fit", "a.csv")
        self.write("a.toml", MESH.replace("mesh.unit = 'mm'\n", ""))
        self.refused("body.mesh.unit: required, mm, cm, m or in: without it the mesh is 80 m across", "measured", "fit", "a.csv")
        self.write("a.toml", "[body]\nradius = 1\n" + track_words + "point = 'origin'\n")
        self.refused("track.point", "measured", "fit", "a.csv")
        self.write("a.toml", MESH + "point = 'tip'\n")
        self.refused("track.point", "measured", "fit", "a.csv")
        self.write("a.toml", MESH.replace("space", "plane"))
        self.refused("\"space\": the body is a mesh", "measured", "fit", "a.csv")
