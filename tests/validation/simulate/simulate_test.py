# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter simulate` as its users meet it: scene files, their errors, overrides, bodies of files, histories, facets."""

import itertools
import json
import math
import os
import re
from pathlib import Path

from run_folder import EmptyFolder, case, run, stl
from space_folder import MASS, SIZE, box_faces, box_moments, product, rotated, turn, turned_back

SCENE = "[drop]\nangle_deg = 10\nspeed = 1\n[ground]\nstiffness = 1e8\n[run]\nimpacts = 2\n"
GROUND, DROP = "[ground]\nstiffness = 1\n", "[drop]\nangle_deg = 1\n"
# The file's text, where the error stands in it, and what its line must say.
BAD_SCENES = (
    ("[drop]\nangle = 10\n", "2:1", "drop.angle_deg"), (DROP + "[grund]\nstiffness = 1\n", "3:2", "ground"),
    (DROP + "angle_deg = 11\n", "3:", "angle_deg"), ("[drop\nangle_deg = 10\n", "1:", ""),
    ("[drop]\nangle_deg = nan\n" + GROUND, "2:13", "drop.angle_deg = nan"), (DROP + "spin = inf\n" + GROUND, "3:8", "drop.spin"),
    ("[drop]\nangle_deg = 1e400\n", "2:", "1e400"), ("[drop]\nangle_deg = 'ten'\n" + GROUND, "2:13", "'ten'"),
    (DROP + "[body]\nshape = 3\n" + GROUND, "4:9", "rod, box, mesh"),
    (DROP + GROUND + "area = 'surfce'\n", "5:8", "did you mean surface?"), ("[drop]\nangle_deg = 91\n" + GROUND, "2:13", "from 0 to 90"),
    (DROP + "[ground]\nstiffness = 0\n", "4:13", "greater than 0"), (DROP + GROUND + "damping = -1\n", "5:11", "at least 0"),
    (DROP + GROUND + "static_friction = 0.1\nsliding_friction = 0.2\n", "5:19", "at least ground.sliding_friction"),
    (DROP + "speed = 1\nheight = 2\n" + GROUND, "4:10", "not both"), (DROP + "height = 2\n[world]\ngravity = 0\n" + GROUND, "3:10", "gravity"),
    (DROP + "[body]\nshape = 'box'\n" + GROUND, "", "body.size"), (DROP + "[body]\nshape = 'box'\nsize = [1, 2]\n" + GROUND, "5:8", "three lengths"),
    (DROP + "[body]\nshape = 'box'\nsize = [1, 2, 3]\nradius = 1\n" + GROUND, "6:10", "only for a rod"),
    (DROP + GROUND + "[run]\nmethod = 'rk8pd'\nstep = 1e-6\n", "7:8", "rk8pd"), (DROP + GROUND + '["drop.angle_deg"]\n', "5:2", "no dots"),
    (DROP + "spin = 1e308\n" + GROUND, "3:8", "1e9"), (DROP + GROUND + "[run]\ndigits = 13\n", "6:10", "from 2 to 12"),
    (DROP + GROUND + "[run]\nimpacts = 2.5\n", "6:11", "whole"), (GROUND, "", "drop.angle_deg: required"), (DROP, "", "ground.stiffness: required"),
    (DROP + GROUND + "[sweep]\nangle_deg = { from = 1, to = 2, step = 1 }\n", "2:13", "sweep"),
    (GROUND + "[sweep]\nangle_deg = { from = 1, to = 2 }\n", "", "sweep.angle_deg.step"),
    (DROP + "[body]\nshape = 'mesh'\n" + GROUND, "", "body.mesh.file"),
    (DROP + "[body]\nshape = 'mesh'\nmass = 1\ninertia = [1, 1, 1]\nmesh = { file = 'no.stl' }\n" + GROUND, "", "no.stl"))
BAD_FLAGS = ("--angle 91", "--stiffness 0", "--digits 1", "--digits 6.5", "--size 1x2", "--size 1x1x1x", "--height 1e308", "--area round",
             "--method euler", "--impacts 0", "--spin nan", "--friction -1", "--step 1e-6x")


def simulate(*arguments, **options):
    return run("simulate", *arguments, **options)


class Folder(EmptyFolder):
    def scene(self, text=SCENE, name="scene.toml"):
        return self.write(name, text)

    def json(self, *arguments):
        return self.json_of("simulate", *arguments, status=(0,))


class Input(Folder):
    def test_every_error_of_a_file_is_one_line_with_its_place(self):
        for text, place, words in BAD_SCENES:
            with self.subTest(text):
                self.scene(text)
                message = self.refused(words, "simulate", "scene.toml", "--output", "out")
                self.assertTrue(message.startswith(f"clatter: scene.toml:{place}") or not place, message)

    def test_what_flags_and_names_of_files_cannot_be_is_one_line(self):
        self.scene()
        self.each_refused({f"scene.toml {flag}": flag.split()[0] for flag in BAD_FLAGS} | {
            "nowhere.toml": "nowhere.toml", ".": "not a file", "": "--angle: required", "scene.toml --history no/h.csv": "--history",
            "scene.toml --history out --output out": "--history", "rod-sweep --history h.csv": "sweep",
            "rod-friction-sweep --sliding-friction 0.2": "--sliding-friction", "scene.toml --speed 1 --height 1": "not both",
            "scene.toml --height 0.001": "0.0"}, "simulate")

    def test_a_flag_takes_the_place_of_its_key_and_one_friction_coefficient_is_both(self):
        scene = self.json(self.scene(), "--angle", "20", "--digits", "8", "--damping", "1e5", "--impacts", "1", "--planar")["scene"]
        self.assertEqual((scene["drop"]["angle_deg"], scene["ground"]["damping"]), (20, 1e5))
        self.assertEqual([scene["run"][key] for key in ("digits", "impacts", "planar")], [8, 1, True])
        for flag in ("--static-friction", "--sliding-friction"):
            ground = self.json(self.scene(), flag, "0.3", "--impacts", "1")["scene"]["ground"]
            self.assertEqual((ground["static_friction"], ground["sliding_friction"]), (0.3, 0.3), flag)

    def test_height_and_speed_replace_each_other(self):
        drop = self.json(self.scene(), "--height", "2", "--impacts", "1")
        self.assertEqual(drop["scene"]["drop"]["height"], 2)
        self.assertIsNone(drop["scene"]["drop"]["speed"])
        touch = 0.5 * math.sin(math.radians(10)) + 0.01 * math.cos(math.radians(10))
        self.assertAlmostEqual(drop["impacts"][0]["approach_speed"], math.sqrt(2 * 9.81 * (2 - touch)), places=12)

    def test_a_box_that_lies_askew_in_its_file_falls_like_the_box_that_it_is(self):
        # Turned in the file by what the drop's angle and tilt then take back, in mm.
        askew, centre = product(turn(1, -25), turn(2, 15)), (30.0, -20.0, 10.0)
        self.write("box.stl", stl([[1000 * x + c for x, c in zip(rotated(askew, corner), centre)] for corner in face] for face in box_faces(SIZE)))
        axes = list(zip(*(rotated(askew, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))))
        inertia = [sum(m * a * b for m, a, b in zip(box_moments(SIZE, MASS), axes[i], axes[j]))
                   for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        ground = "[ground]\nstiffness = 1e8\ndamping = 1e7\n[run]\nimpacts = 2\n[drop]\nspeed = 4\n"
        meshed, box = (self.json(self.scene(f"{ground}{drop}[body]\nmass = {MASS}\n{body}"))["impacts"] for drop, body in (
            ("angle_deg = 25\ntilt_deg = 25\n", f"shape = 'mesh'\ninertia = {inertia}\ncentre = {list(centre)}\n"
             "mesh = { file = 'box.stl', unit = 0.001 }\n"), ("angle_deg = 10\n", f"shape = 'box'\nsize = {list(SIZE)}\n")))
        for (a, b), key in itertools.product(zip(meshed, box, strict=True), ("impulse_normal", "peak_force")):
            self.assertAlmostEqual(a[key] / b[key], 1, delta=1e-8)  # of six digits asked for, grown by two impacts

    def test_a_body_from_a_gmsh_file_falls_like_the_box_that_it_is(self):
        x, y, z = (side / 2 for side in SIZE)
        corners = [(-x, -y, -z), (x, -y, -z), (x, y, -z), (-x, y, -z), (-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)]
        self.write("box.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n" +
                   "".join("%d %r %r %r\n" % (i + 1, *p) for i, p in enumerate(corners)) +
                   "$EndNodes\n$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n")
        scene = "[ground]\nstiffness = 1e8\n[drop]\nangle_deg = 10\nspeed = 4\n[run]\nimpacts = 1\n[body]\nmass = 0.08814\n"
        path = self.scene(scene + "shape = 'mesh'\nmesh = { file = 'box.msh' }\n")
        # Gmsh's library itself leaks a little.
        result = simulate(path, "--format", "json", env={**os.environ, "ASAN_OPTIONS": "detect_leaks=0"})
        if "no Gmsh" in result.stderr:
            self.skipTest("this build reads no Gmsh files")
        self.assertEqual(result.returncode, 0, result.stderr)
        box = self.json(self.scene(scene + f"shape = 'box'\nsize = {list(SIZE)}\n"))["impacts"][0]
        meshed = json.loads(result.stdout)["impacts"][0]
        self.assertAlmostEqual(meshed["impulse_normal"] / box["impulse_normal"], 1, delta=1e-8)

    def test_a_step_too_long_for_the_contact_knows_few_digits(self):
        for row in self.json(self.scene(), "--step", "1e300")["impacts"]:
            error = row["error_estimate"]["impulse_normal"]
            self.assertEqual(error is None, not row["predictable"])
            self.assertGreater(math.inf if error is None else error, 1e-4 * abs(row["impulse_normal"]))

    def test_the_angular_velocity_is_along_the_axes_of_the_world(self):
        def momentum_of(row):
            """About the centre of mass, A I Aᵀ ω with the attitude's rotation A."""
            attitude = [row[f"beta{i}"] for i in range(4)]
            spin = turned_back(attitude, (row["wx"], row["wy"], row["wz"]))
            return rotated(attitude, [m * s for m, s in zip(box_moments(SIZE, MASS), spin)])

        path = self.scene("[drop]\nangle_deg = 20\ntilt_deg = 30\nspeed = 4\n[ground]\nstiffness = 1e8\n"
                          f"[body]\nshape = 'box'\nmass = {MASS}\nsize = {list(SIZE)}\n")
        self.assertEqual(simulate(path, "--impacts", "2", "--history", self.path("history.csv")).returncode, 0)
        momenta = [momentum_of({name: float(cell) for name, cell in row.items()}) for row in self.records("history.csv")]
        # Without friction none of it is vertical; to the integrator's six digits.
        self.assertLessEqual(max(abs(up) for *_, up in momenta), 1e-6 * max(math.hypot(*momentum) for momentum in momenta))


class Rows(Folder):
    def test_errors_of_damped_phones_cost_little_more_than_the_runs_and_no_more_without_their_growth(self):
        def cost(*keys):
            path = self.write("phone.toml", Path(case("phone-damped")).read_text(encoding="utf-8") + "".join(f"{key} = false\n" for key in keys))
            return sum(self.json(path, "--angle", str(angle))["cost"]["force_evaluations"] for angle in (5, 13, 21, 29, 37))

        plain, errors, both = cost("errors", "amplification"), cost("amplification"), cost()
        self.assertLess(plain, errors)
        # The growth also tells from where on a second run says nothing, which saves what it costs.
        self.assertLess(errors, 1.05 * both)
        self.assertLess(both, 2.7 * plain)

    def test_on_stiff_grounds_with_much_damping_no_known_number_is_withheld(self):
        free = ["--sliding-friction", "0", "--static-friction", "0", "--impacts", "2"]
        for angle, stiffness, damping in ((20, 1e9, 4e8), (20, 1e10, 4e9), (12, 1e10, 1e10), (5, 1e10, 1e11)):
            scene = ["phone-damped", *free, "--angle", str(angle), "--stiffness", str(stiffness), "--damping", str(damping)]
            close = self.json(*scene, "--digits", "10")["impacts"]
            for digits in (4, 6):
                rows = self.json(*scene, "--digits", str(digits))["impacts"]
                for row, truth in zip(rows, close):
                    self.assertLess(abs(row["impulse_normal"] - truth["impulse_normal"]), 10**-digits * truth["impulse_normal"])
                self.assertNotIn("?", simulate(*scene, "--digits", str(digits)).stdout, (stiffness, damping, digits))

    def test_a_law_of_impact_beside_another_ground_is_said_to_be_the_other_models(self):
        note = self.json(self.scene(SCENE + "[impact]\nrestitution = 0.5\nfriction = 0.3\n"), "--damping", "1e6", "--impacts", "1")["notes"][0]
        self.assertRegex(note, r"\[impact\] is the discrete model's alone: e = 0.5 where the ground has 0\.\d+ at 1.00 m/s, "
                               "μ = 0.3 where the ground has μ = 0; clatter shock --ground")
        self.assertEqual(self.json("phone-damped", "--impacts", "1")["notes"], [])

    FINE = "sectors = 1024, layers = 1, rings = 1"

    def of(self, angle, body, mesh, ground):
        scene = self.write("body.toml", f"[body]\n{body}\n" + (f"mesh = {{ {mesh} }}\n" if mesh else ""))
        return self.json(scene, "--mass", "1", "--angle", str(angle), "--speed", "1", "--impacts", "1", *ground)

    def test_the_head_says_how_far_facets_may_put_an_impact_off(self):
        rod, ball = 'shape = "rod"\nlength = 0.3\nradius = 0.03', 'shape = "sphere"\nradius = 0.1'
        grounds = (["--stiffness", "1e9", "--area", "projected"],
                   ["--stiffness", "1e10", "--damping", "2e9", "--static-friction", "0.3", "--sliding-friction", "0.3"])
        for body, mesh, fine in ((rod, "sectors = 64", self.FINE), (ball, "sectors = 32, rings = 8", "")):
            for angle, ground in itertools.product((0.5, 20, 70), grounds):
                meshed, true = self.of(angle, body, mesh, ground), self.of(angle, body, fine, ground)
                said = re.search(r"facets: up to (\S+) m inside .* by (\S+) % in impact 1, its peak force by half", meshed["warnings"][0])
                part = float(said[2]) / 100
                one, other = meshed["impacts"][0], true["impacts"][0]
                self.assertLessEqual(part * one["indentation"], 1.2 * float(said[1]))
                for number, share in (("indentation", 1), ("duration", 1), ("peak_force", 1 / 2)):
                    self.assertLessEqual(abs(one[number] / other[number] - 1), share * part, (body, angle, number))
                self.assertLessEqual(math.dist(one["velocity_after"], other["velocity_after"]), part / 8, (body, angle))
                self.assertEqual(len(true["warnings"]), 1 if fine else 0)
        for command in ("simulate", "compare"):
            self.assertIn("facets: up to 0.0002 m inside", run(command, "rod-45", "--impacts", "1").stdout)

    def test_error_estimates_hold_what_the_facets_of_the_program_s_own_mesh_leave(self):
        rod, coin, slim = ('shape = "rod"\nlength = %s\nradius = %s' % size for size in ((0.3, 0.03), (0.004, 0.01), (0.5, 0.018)))
        grounds = (["--stiffness", "1e9", "--area", "projected"], ["--stiffness", "1e9", "--sliding-friction", "0.3"])
        for body, angle, ground in itertools.product((rod, coin, slim), (2, 13.5, 45, 71), grounds):
            meshed, true = (self.of(angle, body, mesh, ground)["impacts"][0] for mesh in ("", self.FINE))
            for number in ("duration", "impulse_normal", "peak_force", "indentation", "velocity_after", "angular_velocity_after"):
                one, other, bar = (v if isinstance(v, list) else [v] for v in
                                   (meshed[number], true[number], meshed["error_estimate"][number]))
                for x, y, allowed in zip(one, other, bar):
                    self.assertLessEqual(abs(x - y), allowed, (body, angle, ground, number))
            self.assertLess(meshed["error_estimate"]["peak_force"], 0.5 * meshed["peak_force"])
            if body == rod:  # a mesh of the scene's own is the body; one that says the program's numbers is the program's
                said = self.of(angle, body, "sectors = 64, rings = 4, layers = 30", ground)["impacts"][0]
                self.assertEqual((said["peak_force"], said["error_estimate"]), (meshed["peak_force"], meshed["error_estimate"]))
                given = self.of(angle, body, "sectors = 60, rings = 4, layers = 30", ground)["impacts"][0]
                self.assertLess(given["error_estimate"]["peak_force"], 1e-6 * given["peak_force"])

    def test_a_first_contact_that_recedes_is_refused_in_the_words_of_the_discrete_model(self):
        words = run("sequence", "--angle", "10", "--spin", "50").stderr
        for command in ("simulate", "compare", "tradeoff"):
            self.refused(words, command, "rod-10", "--spin", "50")
        self.assertEqual(simulate("rod-10", "--spin", "1", "--impacts", "1").returncode, 0)

    def test_a_tilted_body_kept_in_its_plane_is_warned_of(self):
        for (tilt, warned), form in itertools.product((("20", True), ("0", False), ("90", False)), ("table", "json")):
            result = simulate("phone-elastic", "--planar", "--tilt", tilt, "--impacts", "1", "--format", form)
            self.assertEqual(result.returncode, 0)
            self.assertEqual("its own mirror image" in result.stderr, warned, (tilt, form))
            self.assertEqual("mirror image" in " ".join(result.stdout.split()), warned, (tilt, form))

    def test_a_body_that_sinks_wholly_is_marked_in_its_row(self):
        for stiffness, sinks in (("1e4", True), ("1e8", False)):
            drop = ("phone-elastic", "--stiffness", stiffness, "--impacts", "1")
            result, rows = simulate(*drop), self.json(*drop)
            self.assertEqual(("1!" in result.stdout, "sinks below the ground in impact 1" in result.stderr), (sinks, sinks))
            self.assertEqual([row["submerged"] for row in rows["impacts"]], [sinks])
            self.assertEqual(["sinks below" in warning for warning in rows["warnings"]], [sinks])  # else: goes deep
