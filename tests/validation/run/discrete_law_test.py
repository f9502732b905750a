# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene means: the law, the body and the defaults that the discrete model takes, the same in every command."""

import math
import random

from run_folder import EmptyFolder, json_of

GROUND = ["--stiffness", "1e8", "--damping", "1e7"]


def answer(*arguments):
    return json_of(*arguments, status=(0, 1, 3))


class Law(EmptyFolder):
    """A rod of 1 m and 1 kg that strikes at 45 degrees with 1 m/s: P = (1 + e) v / (1/m + d²/I), d² = 1/8, I = 1/12."""

    def told(self, *flags):
        run = answer("sequence", "--angle", "45", "--impacts", "1", *flags)
        return run["scene"]["discrete_law"], run["impacts"][0]

    def test_the_grounds_damping_gives_the_restitution_where_none_is_given_and_without_a_ground_impacts_are_elastic(self):
        e = 0.937475579949905  # at s = c v/k = 0.1, by ln[(1+s)/(1−s e)] = s (1+e)
        for restitution, *flags in ((1,), (e, *GROUND), (e, *GROUND, "--restitution-law", "viscoelastic"), (0.5, *GROUND, "--restitution", "0.5")):
            law, impact = self.told(*flags)
            self.assertAlmostEqual(impact["impulse_normal"], (1 + restitution) / 2.5, delta=1e-13, msg=flags)
        self.assertEqual((law["law"], law["restitution"], law["restitution_from"]), ("newton", 0.5, "impact"))

    def test_restitution_and_friction_are_taken_each_on_its_own(self):
        rough = [*GROUND, "--static-friction", "0.3", "--sliding-friction", "0.2"]
        for flags, friction, source in ((rough, 0.2, "ground.sliding_friction"), ([*rough, "--restitution", "0.5"], 0.2, "ground.sliding_friction"),
                                        ([*rough, "--friction", "0.4"], 0.4, "impact")):
            law, _ = self.told(*flags)
            self.assertEqual((law["friction_law"], law["friction"], law["friction_from"]), ("coulomb", friction, source))
        law, impact = self.told(*rough, "--impulse-ratio", "0.1")
        self.assertEqual(law["friction_law"], "impulse-ratio")
        self.assertAlmostEqual(impact["impulse_ratio"], 0.1, delta=1e-15)

    def test_what_goes_together_is_said_in_one_line(self):
        ground = " ".join(GROUND)
        self.each_refused({"--restitution-law viscoelastic": "where no ground is given", "--restitution-law poisson": "given with impact.restitution",
                           f"{ground} --restitution-law viscoelastic --restitution 0.5": "not both",
                           f"{ground} --restitution-law stronge": "given with impact.restitution"}, "sequence", "--angle", "45")

    def test_files_and_flags_have_the_same_gravity_and_radius(self):
        for drop, flags in (("speed = 2", ["--speed", "2"]), ("height = 1", ["--height", "1"]), ("clearance = 1", ["--clearance", "1"])):
            file = self.write("scene.toml", f"[drop]\nangle_deg = 10\n{drop}\n")
            by_file, by_flags = answer("sequence", file), answer("sequence", "--angle", "10", *flags)
            by_file["scene"].pop("file")
            self.assertEqual(by_file, by_flags)
            self.assertEqual(by_file["scene"]["world"]["gravity"], 0 if "speed" in drop else 9.81)
            self.assertEqual(by_file["scene"]["body"]["radius"], 0)

    def test_a_clearance_is_the_height_of_the_lowest_point(self):
        for flags in (["--angle", "10"], ["--body", "box", "--size", "0.2x0.1x0.05", "--angle", "30", "--tilt", "20"]):
            speed = answer("sequence", *flags, "--clearance", "0.7", "--impacts", "1")["impacts"][0]["approach_speed"]
            self.assertAlmostEqual(speed, math.sqrt(2 * 9.81 * 0.7), delta=1e-14)

    def test_the_simulated_rod_is_a_round_cylinder_whatever_its_mesh(self):
        for found, exact in zip(answer("simulate", "rod-45")["body"]["principal_inertia"], (0.01**2 / 2, *(2 * [1 / 12 + 0.01**2 / 4]))):
            self.assertAlmostEqual(found / exact, 1, delta=1e-14)

    @staticmethod
    def numbers(impact):
        """By the names of compare, in the plane and in space."""
        (_, _, up), (_, spin, _) = impact["velocity_after"], impact["angular_velocity_after"]
        return {**{name: impact[name] for name in ("start", "contact_angle_deg", "impulse_normal")}, "impulse_z": impact["impulse"][2],
                "velocity_normal": up, "velocity_after_z": up, "angular_velocity": spin, "angular_velocity_after_y": spin}

    def random_scene(self, rng):
        box = rng.random() < 0.5
        lines = ["[drop]", f"angle_deg = {rng.uniform(2, 80)}", f"tilt_deg = {rng.choice([0, 0, rng.uniform(-50, 50)])}",
                 rng.choice([f"height = {rng.uniform(2, 4)}", f"clearance = {rng.uniform(0.1, 1)}", f"speed = {rng.uniform(0.5, 3)}"]),
                 "[body]", "shape = 'box'" if box else "shape = 'rod'",
                 f"size = [{rng.uniform(0.1, 0.2)}, {rng.uniform(0.05, 0.1)}, {rng.uniform(0.01, 0.04)}]" if box
                 else rng.choice(["length = 0.8", f"radius = {rng.uniform(0.002, 0.02)}"]),
                 "[ground]", f"stiffness = {10 ** rng.uniform(8, 10)}", f"damping = {rng.choice([0, 10 ** rng.uniform(5, 7)])}",
                 f"sliding_friction = {rng.choice([0, rng.uniform(0.05, 0.5)])}", "[run]", "impacts = 2"]
        if rng.random() < 0.2:
            lines += ["[impact]", f"restitution = {rng.uniform(0.3, 1)}"]
        return self.write("scene.toml", "\n".join(lines) + "\n")

    def test_compare_prints_the_numbers_of_sequence_to_the_bit(self):
        rng = random.Random(25)
        for _ in range(12):
            scene = self.random_scene(rng)
            for impact, compared in zip(answer("sequence", scene)["impacts"], answer("compare", scene)["impacts"]):
                own = self.numbers(impact)
                for name in compared["numbers"].keys() & own.keys():
                    self.assertEqual(compared["numbers"][name]["discrete"], own[name], name)

    def test_other_corners_of_a_mesh_are_a_column_of_their_own(self):
        thin = answer("compare", "--angle", "10", "--stiffness", "1e11", "--impacts", "1")["impacts"][0]["numbers"]["impulse_normal"]
        self.assertEqual(thin["discrete"], answer("sequence", "--angle", "10")["impacts"][0]["impulse_normal"])
        thick = answer("sequence", "--angle", "10", "--radius", "0.01", "--stiffness", "1e11")["impacts"][0]["impulse_normal"]
        self.assertAlmostEqual(thin["mesh_corners"] / thick, 1, delta=1e-14)
        self.assertAlmostEqual(thin["limit"] / thick, 1, delta=1e-9)
        same = answer("compare", "rod-10", "--radius", "0.01", "--impacts", "1")["impacts"][0]["numbers"]["impulse_normal"]
        self.assertIsNone(same["mesh_corners"])
