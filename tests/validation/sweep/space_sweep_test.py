# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter sweep of the discrete model over drops in space: one row per scene or impact, those of the drops by themselves."""

import itertools
import math

from run_folder import rows_of
from space_folder import MASS, SIZE, SpaceFolder

FALLING = '[drop]\nangle_deg = 35\nspeed = 2\n[body]\nshape = "box"\nsize = [%r, %r, %r]\nmass = %r\n[run]\nimpacts = 3\n[world]\ngravity = 9.81\n' % (
    *SIZE, MASS)


class Sweep(SpaceFolder):
    def setUp(self):
        super().setUp()
        self.write("box.toml", FALLING)

    def swept(self, *arguments, model="discrete"):
        return rows_of("sweep", "box.toml", "--model", model, *arguments, cwd=self.folder)

    def sequence(self, *arguments):
        return [row for row in rows_of("sequence", "box.toml", *arguments, cwd=self.folder) if row["n"].isdigit()]

    def test_each_impact_of_a_sweep_out_of_the_plane_has_every_quantity_and_error_of_its_own_sequence(self):
        rows = self.swept("--set", "drop.tilt_deg=0:20:10", "--set", "impact.friction=0:0.4:0.4", "--rows", "impact")
        seen = set()
        for (tilt, friction), group in itertools.groupby(rows, lambda row: (row["drop.tilt_deg"], row["impact.friction"])):
            own = self.sequence("--tilt", tilt, "--friction", friction)
            group = list(group)
            self.assertEqual(len(group), len(own))
            for row, expected in zip(group, own):
                for name, value in expected.items():
                    self.assertEqual(row[name], value, (tilt, friction, name))
                if float(tilt) == 0:
                    self.assertEqual({row[name] for name in ("corners", "place_x", "attitude_q0", "touches")}, {""})
            seen.add((tilt, friction))
        self.assertEqual(len(seen), 6)

    def test_a_scene_that_the_model_cannot_do_is_a_row_with_its_reason_beside_the_others(self):
        rows = self.swept("--set", "drop.tilt_deg=10:30:20", "--set", "drop.velocity=0,0.1,-1", "--set", "impact.impulse_ratio=-9:0:9",
                          "--rows", "impact")
        by_ratio = {row["impact.impulse_ratio"]: row for row in rows}
        self.assertIn("jamming", by_ratio["-9"]["reason"] + by_ratio["-9"]["outcome"])
        self.assertEqual(by_ratio["0"]["outcome"], "impact-limit")
        self.assertEqual(len(by_ratio["-9"]), len(by_ratio["0"]))

    def test_26_attitudes_are_the_orientations_of_the_box_in_their_order(self):
        swept = {"--set": ["drop.attitude=26", "impact.restitution=0.5:1:0.5"]}
        rows = self.swept(*[part for value in swept["--set"] for part in ("--set", value)])
        numbered = self.swept("--set", "drop.orientation=1:26:1", "--set", "impact.restitution=0.5:1:0.5")
        self.assertEqual(len(rows), 52)
        for row, expected in zip(rows, numbered):
            result = {name: value for name, value in row.items() if not name.startswith("drop.attitude")}
            number = expected.pop("drop.orientation")
            self.assertEqual(result, expected, number)
        self.refused("the attitudes depend on the size; give drop.orientation=1:26:1", "sweep", "box.toml", "--set", "drop.attitude=26",
                     "--set", "body.size.length=1:2:1")

    def test_a_list_of_attitudes_in_brackets_or_in_a_file_is_each_of_them_by_itself(self):
        listed = [(0.9, 0.3, -0.2, 0.1), (0.1, 0.7, 0.7, 0.1), (0.5, 0.5, 0.5, 0.5)]
        listed = [tuple(x / math.hypot(*q) for x in q) for q in listed]
        self.write("list.csv", "# three\nq1,q2,q3,q0\n" + "".join(f"{b!r},{c!r},{d!r},{a!r}\n" for a, b, c, d in listed))
        in_brackets = ",".join("[" + ",".join(map(repr, q)) + "]" for q in listed)
        rows = self.swept("--set", "drop.attitude=" + in_brackets, "--rows", "impact")
        self.assertEqual(rows, self.swept("--set", "drop.attitude=@list.csv", "--rows", "impact"))
        for n, q in enumerate(listed):
            own = self.sequence("--attitude", ",".join(map(repr, q)))
            of_it = [row for row in rows if row["index"] == str(n)]
            self.assertEqual([float(of_it[0][f"drop.attitude_q{i}"]) for i in range(4)], list(q))
            self.assertEqual(len(of_it), len(own))
            for row, expected in zip(of_it, own):
                self.assertEqual({name: row[name] for name in expected}, expected)

    def test_a_file_of_attitudes_is_refused_at_its_line_read_only_and_known_by_its_digest(self):
        for text, words, more in (("q0,q1,q2,q3\n1,0,0,0\n1,0.2,0,0\n", "list.csv:3:1: q0 = 1: must be four numbers", ()), ("a,b\n1,0\n", "list.csv:1", ()),
                                  ("q0,q1,q2,q3\n1,0,0,0\n", "list.csv", ("--output", "list.csv"))):
            self.write("list.csv", text)
            self.refused(words, "sweep", "box.toml", "--set", "drop.attitude=@list.csv", *more)
        heads = set()
        for attitude in ("1,0,0,0", "0,1,0,0"):
            self.write("list.csv", "q0,q1,q2,q3\n" + attitude + "\n")
            text = self.run_program("sweep", "box.toml", "--set", "drop.attitude=@list.csv").stdout
            heads.add(text[:text.index("index,")])
        self.assertEqual(len(heads), 2)

    def test_random_attitudes_are_the_same_by_any_number_of_threads_and_of_scenes(self):
        arguments = ["--set", "drop.attitude=uniform", "--set", "drop.speed=1:3", "--seed", "3", "--columns", "hardest,hardest_corners"]
        texts = {self.run_program("sweep", "box.toml", "--model", "discrete", *arguments, "--random", "300", "--threads", n).stdout
                 for n in ("1", "3")}
        self.assertEqual(len(texts), 1)
        many = self.swept(*arguments, "--random", "300")
        self.assertEqual(self.swept(*arguments, "--random", "7"), many[:7])
        self.assertNotEqual(self.swept(*arguments[:4], "--seed", "4", *arguments[6:], "--random", "7"), many[:7])
        for row in many:
            q = [float(row[f"drop.attitude_q{i}"]) for i in range(4)]
            self.assertAlmostEqual(math.hypot(*q), 1, delta=1e-15)
            own = self.sequence("--attitude", ",".join(row[f"drop.attitude_q{i}"] for i in range(4)), "--speed", row["drop.speed"])
            if row["index"] in ("0", "17"):
                total = sum(float(impact["impulse_normal"]) for impact in own)
                self.assertAlmostEqual(float(row["total_normal_impulse"]), total, delta=1e-14)
            if row["index"] == "17":
                break

    def test_columns_asked_for_are_the_cells_of_rows_of_impacts_and_empty_where_a_scene_has_fewer(self):
        attitudes = ["--set", "drop.attitude=uniform", "--random", "40", "--set", "world.gravity=0"]  # where nothing brings them back
        some = ["corners", "place_z", "attitude_q2", "start", "impulse_normal", "velocity_after_x", "mode", "predictable", "n"]
        names = ["hardest", "hardest_corners", "hardest_impulse_normal", "hardest_start"] + [f"{name}_{n}" for name in some for n in (1, 3)]
        scenes = self.swept(*attitudes, "--columns", ",".join(names + ["energy_loss"]))
        impacts = self.swept(*attitudes, "--rows", "impact")
        hardest_seen, fewer = set(), 0
        for scene in scenes:
            own = [row for row in impacts if row["index"] == scene["index"] and row["n"].isdigit()]
            hardest = max(own, key=lambda row: float(row["impulse_normal"]))
            hardest_seen.add(hardest["n"])
            self.assertEqual([scene[f"hardest{part}"] for part in ("", "_corners", "_impulse_normal", "_start", "_start_error")],
                             [hardest[name] for name in ("n", "corners", "impulse_normal", "start", "start_error")])
            fewer += len(own) < 3
            for name in (*some, "energy_loss"):
                for n in (1, 2, 3) if name == "energy_loss" else (1, 3):
                    expected = own[n - 1] if n <= len(own) else {}
                    self.assertEqual(scene[f"{name}_{n}"], expected.get(name, ""), (name, n))
                    if name + "_error" in impacts[0]:
                        self.assertEqual(scene[f"{name}_{n}_error"], expected.get(name + "_error", ""), (name, n))
                    else:
                        self.assertNotIn(f"{name}_{n}_error", scene)
        self.assertGreater(len(hardest_seen), 1)
        self.assertGreater(fewer, 0)

    def test_columns_asked_for_of_the_plane_and_of_the_continuous_model_are_those_of_their_impacts(self):
        asked = ["--columns", "impulse_normal,hardest,hardest_end", "--set", "drop.angle_deg=20:40:20", "--set", "run.impacts=2"]
        for model, ground in (("discrete", []), ("continuous", ["--set", "ground.stiffness=1e7", "--set", "run.digits=3"])):
            scenes = self.swept(*asked, *ground, model=model)
            impacts = self.swept(*asked[2:], *ground, "--rows", "impact", model=model)
            for scene in scenes:
                own = [row for row in impacts if row["index"] == scene["index"]]
                self.assertEqual([scene["impulse_normal_1"], scene["impulse_normal_2"], scene["impulse_normal_2_error"]],
                                 [own[0]["impulse_normal"], own[1]["impulse_normal"], own[1]["impulse_normal_error"]])
                hardest = max(own, key=lambda row: float(row["impulse_normal"]))
                self.assertEqual((scene["hardest"], scene["hardest_end"]), (hardest["n"], hardest["end"]))

    def test_a_column_of_local_slip_is_that_of_rows_of_impacts_and_changes_no_other_column(self):
        arguments = ["--set", "drop.angle_deg=2:42:20", "--set", "ground.stiffness=1e7", "--set", "ground.static_friction=0.3",
                     "--set", "ground.sliding_friction=0.3", "--set", "run.impacts=1", "--set", "run.digits=4"]
        asked = self.swept(*arguments, "--columns", "local_slip", model="continuous")
        impacts = self.swept(*arguments, "--rows", "impact", model="continuous")
        self.assertEqual([row["local_slip_1"] for row in asked], [row["local_slip"] for row in impacts])
        self.assertTrue(any(float(row["local_slip"]) > 0 for row in impacts))
        for row, other in zip(asked, self.swept(*arguments, model="continuous")):
            self.assertEqual({name: row[name] for name in other}, other)

    def test_the_head_of_a_sweep_says_nothing_of_the_keys_that_are_swept(self):
        for swept, said, unsaid in (("drop.spin=0:0.1:0.1", "drop: 35° at 2 m/s,", "spin"), ("drop.angle_deg=5:85:40", "drop: at 2 m/s,", "35°"),
                                    ("drop.attitude=26", "drop: at 2 m/s,", "35°"), ("drop.orientation=1:26:5", "drop: at 2 m/s,", "35°"),
                                    ("drop.height=1:2:1", "drop: 35°, tangential", "2 m"), ("body.size.length=0.1:0.2:0.1", "box 0.08814 kg\n", "0.10566"),
                                    ("impact.restitution=0.5:1:0.5", "drop: 35° at 2 m/s,", "e ="), ("world.gravity=1:2:1", "drop: 35° at 2 m/s,", "gravity")):
            head = self.run_program("sweep", "box.toml", "--set", swept, "--format", "table").stdout.partition("index")[0]
            self.assertEqual((said in head, unsaid in head), (True, False), (swept, head))
        data = self.json_of("sweep", "box.toml", "--set", "drop.angle_deg=5:85:40", "--set", "drop.speed=1:2:1")
        self.assertEqual((data["scene"]["drop"]["angle_deg"], data["scene"]["drop"]["speed"]), (None, None))

    def test_every_orientation_has_the_same_corners_by_either_model_and_its_name_among_the_keys(self):
        self.write("box.toml", FALLING.replace("angle_deg = 35\n", "orientation = 1\n") + "[ground]\nstiffness = 1e7\n")
        arguments = ["--set", "drop.orientation=1:26:1", "--set", "run.impacts=1", "--rows", "impact"]
        discrete = self.swept(*arguments)
        continuous = self.swept(*arguments, "--no-errors", model="continuous")
        keys = self.json_of("help", "keys")["orientations"]
        self.assertEqual([one["orientation"] for one in keys], list(range(1, 27)))
        seen = set()
        for one, row, other in zip(keys, discrete, continuous):
            signs = {axis: sign for sign, axis in zip(one["down"][::2], one["down"][1::2])}
            corners = {f"{x}x{y}y{z}z" for x in signs.get("x", "-+") for y in signs.get("y", "-+") for z in signs.get("z", "-+")}
            self.assertEqual(set(other["corners"].split()), corners, one)
            if row["corners"]:  # a drop that stays in its plane has none
                self.assertEqual(set(row["corners"].split()), corners, one)
                seen.add(one["part"])
            self.assertEqual(one["part"], {4: "face", 2: "edge", 1: "corner"}[len(corners)])
        self.assertEqual(seen, {"face", "edge", "corner"})
        text = self.run_program("help", "keys").stdout
        for one in keys:
            self.assertIn(f"{one['orientation']} {one['down']}", text)
        self.assertLessEqual(max(map(len, text.splitlines())), 80)
