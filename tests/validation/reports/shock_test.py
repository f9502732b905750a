#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter shock` as its users meet it: probes, tables, JSON, bad input."""

import json
import math
import unittest

from run_folder import EmptyFolder, records, run

PROBE = ("--probe", "camera:0.048,0.016,0.0095")
FEW = ("--impacts", "2", "--frequencies", "100:3000:4", "--no-sensitivity")

BAD = {
    "no probe": (("phone-damped",), "--probe: required"),
    "a probe without a name": (("phone-damped", "--probe", ":1,2,3"), "NAME:X,Y,Z"),
    "a probe of two numbers": (("phone-damped", "--probe", "a:1,2"), "NAME:X,Y,Z"),
    "a probe at nan": (("phone-damped", "--probe", "a:nan,0,0"), "NAME:X,Y,Z"),
    "a probe at 1e400": (("phone-damped", "--probe", "a:1e400,0,0"), "NAME:X,Y,Z"),
    "a probe with an empty number": (("phone-damped", "--probe", "a:1,,3"), "NAME:X,Y,Z"),
    "a probe twice": (("phone-damped", "--probe", "a:0,0,0", "--probe", "a:0,0,1"), "already"),
    "a quality of a half": (("phone-damped", *PROBE, "--quality", "0.5"), "--quality"),
    "frequencies that fall": (("phone-damped", *PROBE, "--frequencies", "10:5:3"), "--frequencies"),
    "one frequency": (("phone-damped", *PROBE, "--frequencies", "10:20:1"), "--frequencies"),
    "an axis of no body": (("phone-damped", *PROBE, "--axis", "w"), "--axis"),
    "a severity of 0": (("phone-damped", *PROBE, "--severity", "0"), "--severity"),
    "rows of no kind": (("phone-damped", *PROBE, "--rows", "spectra"), "did you mean spectrum"),
    "a continuous model without a ground": (("rod-10", *PROBE, "--model", "continuos"), "continuous"),
    "a history": (("phone-damped", *PROBE, "--history", "x.csv"), "--history"),
}
BAD_FILES = {
    "a probe table": ("[probe]\nname = 'a'\n", "1:", "[[probe]]"),
    "an unknown key": ("[[probe]]\nname = 'a'\nplce = [1, 2, 3]\n", "3:1", "probe.place"),
    "no place": ("[[probe]]\nname = 'a'\n", "", "probe.0.place"),
    "a place of two": ("[[probe]]\nname = 'a'\nplace = [1, 2]\n", "3:", "three coordinates"),
    "a name with a blank": ("[[probe]]\nname = 'a b'\nplace = [1, 2, 3]\n", "2:", "letters"),
    "two of one name": ("[[probe]]\nname = 'a'\nplace = [1, 2, 3]\n[[probe]]\nname = 'a'\nplace = [1, 2, 3]\n", "5:", "another name"),
    "an empty table": ("[[probe]]\n[[probe]]\nname = 'a'\nplace = [1, 2, 3]\n", "1:", "name and place"),
}


def shock(*arguments):
    result = run("shock", *arguments, "--format", "json")
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


class Shock(EmptyFolder):
    def test_one_command_prints_what_a_camera_near_a_corner_sees(self):
        found = shock("phone-damped", "--impacts", "2", *PROBE)
        first = found["impacts"][0]
        self.assertEqual([row["n"] for row in found["impacts"]], [1, 2])
        self.assertAlmostEqual(first["peak_g"] * 9.80665, first["peak"], delta=1e-9 * first["peak"])
        for row in found["impacts"]:
            size = math.hypot(row["delta_v_x"], row["delta_v_y"], row["delta_v_z"])
            self.assertAlmostEqual(size, row["delta_v"], delta=1e-12)
            self.assertLess(row["closure"], 1e-6)
            self.assertLess(abs(row["sensitivity"] - 0.4), 0.3)
        blows = {(one["model"], one["blows"]) for one in found["spectra"]}
        self.assertLessEqual({("continuous", "1"), ("continuous", "1-2"), ("continuous", "flat")}, blows)
        table = run("shock", "phone-damped", "--impacts", "2", *PROBE).stdout
        self.assertLessEqual(max(len(line) for line in table.splitlines()), 80)
        self.assertIn("oscillator of", table)

    def test_a_centre_of_mass_feels_the_force_and_the_discrete_model_agrees_with_sequence(self):
        found = shock("--angle", "10", "--probe", "centre:0,0,0", "--frequencies", "10:100:2")
        sequence = json.loads(run("sequence", "--angle", "10", "--format", "json").stdout)
        self.assertEqual(found["model"], "discrete")
        for row, impact in zip(found["impacts"], sequence["impacts"], strict=True):
            self.assertAlmostEqual(row["discrete_delta_v_z"], impact["impulse_normal"], delta=1e-14)

    def test_probes_of_a_file_are_those_of_flags(self):
        scene = "[drop]\nangle_deg = 10\n[[probe]]\nname = 'tip'\nplace = [-0.5, 0, 0]\n"
        path = self.write("scene.toml", scene)
        of_file = shock(path, "--frequencies", "10:100:2")
        of_flag = shock("--angle", "10", "--probe", "tip:-0.5,0,0", "--frequencies", "10:100:2")
        self.assertEqual(of_file["impacts"], of_flag["impacts"])
        self.assertEqual(of_file["scene"]["probe"], [{"name": "tip", "place": [-0.5, 0, 0]}])
        other = shock(path, "--probe", "middle:0,0,0", "--frequencies", "10:100:2")
        self.assertEqual([one["name"] for one in other["scene"]["probe"]], ["middle"])
        self.assertEqual(run("sequence", path).returncode, 0)

    def test_the_centre_of_mass_is_where_the_scene_puts_it(self):
        box = ("--body", "box", "--size", "0.1x0.06x0.02", "--mass", "0.2", "--orientation", "20", "--impacts", "1")
        moved = shock(*box, "--centre", "0.01,0.005,-0.002", "--probe", "c:0.01,0.005,-0.002", "--frequencies", "10:20:2")
        row = moved["impacts"][0]
        sequence = json.loads(run("sequence", *box, "--centre", "0.01,0.005,-0.002", "--format", "json").stdout)
        self.assertAlmostEqual(row["discrete_delta_v_z"], sequence["impacts"][0]["impulse_normal"] / 0.2, delta=1e-13)

    def test_spectrum_rows_are_those_of_json(self):
        rows = records(run("shock", "phone-damped", *PROBE, *FEW, "--rows", "spectrum", "--format", "csv").stdout)
        found = shock("phone-damped", *PROBE, *FEW)
        points = [(one["model"], one["blows"], point) for one in found["spectra"] for point in one["points"]]
        self.assertEqual(len(rows), len(points))
        for row, (model, blows, point) in zip(rows, points):
            self.assertEqual((row["model"], row["blows"]), (model, blows))
            self.assertEqual(float(row["pseudo_velocity"]), point["pseudo_velocity"]["maximax"])
        table = run("shock", "phone-damped", *PROBE, *FEW, "--rows", "spectrum").stdout
        self.assertLessEqual(max(len(line) for line in table.splitlines()), 80)

    def test_a_severity_is_told_where_it_is_exceeded(self):
        found = run("shock", "phone-damped", *PROBE, *FEW, "--severity", "0.01")
        self.assertIn("above the severity of 0.01 m/s", found.stdout)
        self.assertIn("nowhere above", run("shock", "phone-damped", *PROBE, *FEW, "--severity", "1e6").stdout)

    def test_bad_input_is_one_line_and_status_2(self):
        for name, (arguments, words) in BAD.items():
            with self.subTest(name):
                found = run("shock", *arguments)
                self.assertEqual((found.returncode, found.stdout), (2, ""))
                self.assertEqual(len(found.stderr.splitlines()), 1)
                self.assertIn(words, found.stderr)

    def test_bad_probes_of_files_are_told_with_their_place(self):
        for name, (text, place, words) in BAD_FILES.items():
            with self.subTest(name):
                path = self.write("scene.toml", text)
                found = run("shock", path, "--angle", "10")
                self.assertEqual((found.returncode, found.stdout), (2, ""), found.stderr)
                self.assertEqual(len(found.stderr.splitlines()), 1)
                self.assertIn(words, found.stderr)
                self.assertIn(f"{path}:{place}" if place else path, found.stderr)


if __name__ == "__main__":
    unittest.main()
