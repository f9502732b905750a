# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter sweep` as its users meet it: the same file however it came about, rows as the other commands have them."""

import importlib.util
import itertools
import collections
import json
import math
import os
import re
import shlex
import shutil
import signal
import struct
import subprocess
import unittest

from run_folder import MPIRUN, PROGRAM, EmptyFolder, case, records, rows_of, run, stl
from space_folder import box_faces
from waiting import until

HDF5 = os.path.exists(os.path.join(os.path.dirname(PROGRAM), "clatter-hdf5.so")) and importlib.util.find_spec("h5py")

THIN_ROD = "[drop]\nangle_deg = 10\n[world]\ngravity = 9.81\n[body]\nradius = 0\n[run]\nimpacts = 4\n"
PHONE = "phone-damped"
# With a tolerance the runs are those of simulate to the bit; without one, simulate goes on until its estimates keep to
# the digits, and a sweep makes none.
QUICK = ["--set", "run.impacts=2", "--set", "run.digits=4", "--set", "run.tolerance=1e-8"]
QUICK_FLAGS = ["--impacts", "2", "--digits", "4", "--tolerance", "1e-8"]

# What is typed behind the scene, and what the line must say; what axes cannot be is a claim of sweep_test.cpp.
REFUSED = {
    **{f"--set '{setting}' --output out": words for setting, words in {
        "drop.angle=1:2:1": "did you mean drop.angle_deg?", "drop.angle_deg": "KEY=VALUE", "drop.angle_deg=": "empty", "drop.angle_deg=nan": "nan",
        "drop.angle_deg=1:2:0": "STEP", "drop.angle_deg=80:100:10": "'100': must be from 0 to 90", "run.impacts=1:2:0.5": "whole",
        "impact.restitution=0.5:1.5:0.5": "from 0 to 1", "impact.law=newtn": "did you mean newton?", "body.size=1x1x1": "only for a box",
        "body.size.width=1:2:1": "body.size: required", "sweep.angle_deg.from=1": "unknown key", "run.history=h.csv": "unknown key",
        "drop.attitude=uniform": "needs --random N", "drop.attitude=26": "is for a box", "drop.attitude=[1,0,0,0],[1,0,0]": "attitude 2, '[1,0,0]'",
        "drop.attitude=random": "four numbers", "drop.velocity=[0,0,-1],[0,0,-2]": "three numbers", "=1": "unknown key"}.items()},
    "--set drop.spin=1 --set drop.spin=2": "twice", "--set drop.speed=1 --set drop.height=1:2:1": "not both", "--random 5": "LOW:HIGH",
    "--random 0 --set drop.angle_deg=10:20": "--random '0'", "--random 1000000001 --set drop.angle_deg=10:20": "1000000000",
    "--random x --set drop.angle_deg=10:20": "--random", "--random 5 --seed -1 --set drop.angle_deg=10:20": "--seed",
    "--random 5 --set drop.angle_deg=20:10": "LOW", "--seed 5": "--random",
    "--random 5 --set drop.attitude=26": "must be uniform or one attitude with --random",
    "--random 5 --set drop.attitude=[1,0,0,0],[0,1,0,0]": "must be uniform or one attitude with --random",
    "--random 5 --set drop.attitude=1,0,0,0": "needs a --set", "--columns impulse_norml_1": "did you mean impulse_normal_1?",
    "--columns impulse_normal_5": "from 1 to 4", "--columns impulse_normal_0": "from 1 to 4", "--columns hardest,,start_1": "--columns ''",
    "--columns hardest_hardest": "--columns 'hardest_hardest'", "--columns start,start_2": "start_2: asked for twice",
    "--columns impulse_normal_error_1": "must be hardest", "--columns peak_force_1,corners_1": "--columns 'corners_1'",
    "--rows impact --columns hardest": "--rows scene", "--model discreet": "did you mean discrete?",
    "--rows impact --probe tip:0,0,0": "is for --rows scene", "--probe tip:0,0,0 --columns delta_v_tip,delta_v_tip": "delta_v_tip: asked for twice",
    "--probe tip:0,0,0 --columns delta_v_top": "did you mean delta_v_tip?", "--probe tip:0,0": "--probe",
    "--probe tip:0,0,0 --probe tip_impact:0,0,0": "delta_v_tip_impact would be there twice", "--probe tip:0,0,0 --probe tip:1,0,0": "--probe",
    "--rows impacts": "did you mean impact?", "--rows scene --rows scene": "twice", "--threads 0": "--threads", "--threads nan": "--threads",
    **{f"--set drop.angle_deg=1,2 --output x{ending}": f"must not end in {'.gz' if 'gz' in ending else ending}, rows are written as CSV or, to FILE.h5, HDF5"
       for ending in (".gz", ".csv.gz", ".xz", ".zst", ".bz2", ".zip", ".parquet", ".feather", ".xlsx", ".json")}
    | {"--set drop.angle_deg=1,2 --format json --output x.json.gz": "must not end in .gz", "--set drop.angle_deg=1,2 --output x.parquet --check": ".parquet"},
    "--set drop.angle_deg=1:2:log": "log needs a COUNT, FROM:TO:log:COUNT; LOW:HIGH:log is drawn with --random N",
    "--set drop.angle_deg=1:2:lin": "lin needs a COUNT, FROM:TO:lin:COUNT", "--restart": "--output", "--restart --output /dev/null": "--output", "--output /no/such/folder/x": "/no/such/folder/x",
    "--output rod.toml": "which is read", "--model continuous --set body.radius=0.01": "ground.stiffness: required",
    "--set drop.angle_deg=10:30:5 --summary --output rows.h5": "no rows", "--set drop.angle_deg=10:30:5 --format csv --output rows.h5": "left out",
    "--set drop.angle_deg=10:30:5 --summary --output a.txt --restart": "--restart", "--set drop.angle_deg=10:30:5 --scatter 3": "--random",
    "--set drop.angle_deg=1:2 --random 5 --scatter 3": "drop.attitude", "--set drop.attitude=[1,0,0,0],[0,1,0,0] --random 5": "--scatter",
    **{f"--set drop.attitude=[1,0,0,0],[0,1,0,0] --random 5 --scatter '{scatter}'": "--scatter" for scatter in ("nan", "-1", "181", "")},
    "--set drop.attitude=uniform --random 5 --scatter 3": "--scatter"}


def octahedron_stl(side):
    """The middles of the faces of a cube about the origin."""
    half = side / 2
    return stl(((x, 0, 0), (0, y, 0), (0, 0, z)) if x * y * z > 0 else ((0, y, 0), (x, 0, 0), (0, 0, z))
               for x in (-half, half) for y in (-half, half) for z in (-half, half))


def box_stl(side):
    return stl(box_faces((side,) * 3))


class Folder(EmptyFolder):
    def setUp(self):
        super().setUp()
        self.scene = self.write("rod.toml", THIN_ROD)

    def sweep(self, *arguments, said=""):
        done = run("sweep", *arguments)
        self.assertEqual(done.returncode, 0, arguments)
        self.assertRegex(done.stderr, rf"\A{said}\Z", arguments)
        return done.stdout

    def summary(self, *arguments):
        return json.loads(self.sweep(*arguments, "--summary", "--format", "json"))


class SameAsTheOtherCommands(Folder):
    def check(self, swept, single, swept_key, value):
        rows = [row for row in swept if float(row[swept_key]) == value]
        self.assertEqual(len(rows), len(single))
        for row, expected in zip(rows, single):
            self.assertEqual({name: row[name] for name in expected}, expected)

    def test_impacts_of_the_discrete_model_are_those_of_sequence(self):
        for flags, sets in (("", ""), ("--restitution 0.7", "impact.restitution=0.7"),
                            ("--friction 0.3 --restitution-law stronge --restitution 0.9", "impact.friction=0.3 impact.law=stronge impact.restitution=0.9"),
                            ("--impulse-ratio 0.1", "impact.impulse_ratio=0.1"), ("--height 1", "drop.height=1"),
                            ("--radius 0.02 --mass 2 --length 0.5", "body.radius=0.02 body.mass=2 body.length=0.5"),
                            ("--restitution 0.5 --impacts 50", "impact.restitution=0.5 run.impacts=50")):  # with a tail
            sets = [word for one in sets.split() for word in ("--set", one)]
            said = r"clatter: \d+ of \d+ scenes warn, column warning; scene 0: the impulse ratio .*\n" if "--impulse-ratio" in flags else ""
            swept = records(self.sweep(self.scene, "--set", "drop.angle_deg=0:40:10", "--rows", "impact", *sets, said=said))
            for angle in (0, 10, 40):
                impacts = [] if "--impacts" in flags else ["--impacts", "4"]
                self.check(swept, rows_of("sequence", "--angle", str(angle), "--gravity", "9.81", *impacts, *flags.split()), "drop.angle_deg", angle)
        self.assertIn("tail", [row["n"] for row in swept])

    def test_the_head_says_whether_drops_go_on_to_rest(self):  # by which a sweep that goes on knows its own file
        flags = ("--model", "discrete", "--set", "drop.angle_deg=10:20:10", "--set", "impact.restitution=0.5")
        heads = [[line for line in self.sweep(self.scene, *flags, "--set", f"run.until_rest={rest}", "--set", "run.impacts=3").splitlines()
                  if line.startswith("# scene")] for rest in ("true", "false")]
        self.assertNotEqual(*heads)

    def test_impacts_of_the_continuous_model_are_those_of_simulate(self):
        swept = records(self.sweep(PHONE, "--set", "drop.angle_deg=10:30:20", "--rows", "impact", *QUICK))
        for angle in (10, 30):
            self.check(swept, rows_of("simulate", PHONE, "--angle", str(angle), *QUICK_FLAGS), "drop.angle_deg", angle)

    def test_rows_of_scenes_sum_up_those_of_impacts(self):
        arguments = [PHONE, "--set", "drop.angle_deg=10:30:10", *QUICK]
        scenes = records(self.sweep(*arguments))
        impacts = records(self.sweep(*arguments, "--rows", "impact"))
        self.assertEqual([row["index"] for row in scenes], ["0", "1", "2"])
        for row in scenes:
            own = [impact for impact in impacts if impact["index"] == row["index"]]
            peaks = [float(impact["peak_force"]) for impact in own]
            self.assertEqual((int(row["impacts"]), row["outcome"]), (len(own), own[0]["outcome"]))
            self.assertEqual((float(row["first_peak_force"]), float(row["largest_peak_force"])), (peaks[0], max(peaks)))
            for total, part in (("first_peak_force", own[0]["peak_force_error"]), ("last_start", own[-1]["start_error"])):
                self.assertEqual(row[total + "_error"], part)
            self.assertEqual(row["last_start"], own[-1]["start"])
            # Sums of two doubles: one rounding.
            for total, part in (("total_normal_impulse", "impulse_normal"), ("energy_loss", "energy_loss")):
                self.assertAlmostEqual(float(row[total]), sum(float(impact[part]) for impact in own), delta=1e-15)
                errors = sum(float(impact[part + "_error"]) for impact in own)  # in two digits, rounded up
                self.assertAlmostEqual(float(row[total + "_error"]), errors, delta=0.1 * errors)

    def test_what_a_point_goes_through_is_that_of_shock_in_the_plane_in_space_and_on_a_ground(self):
        flags = ["--probe", "camera:0.048,0.016,0.0095", "--probe", "back.left-1:-0.05,0.02,0"]
        with open(case(PHONE), encoding="utf-8") as file:
            off_centre = self.write("off.toml", file.read().replace("[body]\n", "[body]\ncentre = [0.004, 0.001, 0.002]\n"))
        discrete, ground = ["--model", "discrete"], ["--impacts", "2", "--digits", "4", "--no-sensitivity", "--frequencies", "100:200:2"]
        for scene, tilt, given, sets, columns in (
                (PHONE, "0", discrete, discrete, {"delta_v": "discrete_delta_v"}), (off_centre, "20", discrete, discrete, {"delta_v": "discrete_delta_v"}),
                (PHONE, "0", ground, ["--set", "run.impacts=2", "--set", "run.digits=4"], {"peak_g": "peak_g", "delta_v": "delta_v"})):
            for row in records(self.sweep(scene, "--set", "drop.angle_deg=10:40:30", "--set", f"drop.tilt_deg={tilt}", *sets, *flags)):
                shocks = rows_of("shock", scene, "--angle", row["drop.angle_deg"], "--tilt", tilt, *given, *flags)
                for name, (column, of_shock) in itertools.product(("camera", "back.left-1"), columns.items()):
                    hardest = max((shock for shock in shocks if shock["probe"] == name), key=lambda shock: float(shock[of_shock]))
                    self.assertEqual((row[f"{column}_{name}"], row[f"{column}_{name}_impact"]), (hardest[of_shock], hardest["n"]))
                    self.assertGreaterEqual(float(row[f"{column}_{name}_error"]), float(hardest[of_shock + "_error"]))
                    if column == "peak_g":
                        self.assertEqual(row[f"width_{name}"], hardest["width"])

    def test_points_of_the_scene_file_have_columns_too_where_rows_can_have_them(self):
        scene = self.write("probed.toml", THIN_ROD + '[[probe]]\nname = "tip"\nplace = [0.5, 0, 0]\n')
        swept = (scene, "--set", "drop.speed=1:2:1")
        rows = records(self.sweep(*swept))
        self.assertGreater(float(rows[0]["delta_v_tip"]), 0)
        for more, is_there in ((("--rows", "impact"), False), (("--probe", "middle:0,0,0"), False), (("--summary",), True)):
            self.assertEqual("delta_v_tip" in self.sweep(*swept, *more), is_there, more)
        # The command of a probe's largest shows that number, also where one probe's name is the end of another's.
        two = ("--probe", "tip:0.5,0,0", "--probe", "far_tip:-0.5,0,0")
        for summed in json.loads(self.sweep(*swept, *two, "--summary", "--format", "json"))["rows"]:
            if summed["quantity"] in ("delta_v_tip", "delta_v_far_tip"):
                row, = records(run(*shlex.split(summed["largest_command"])[1:]).stdout)
                self.assertEqual(float(row[summed["quantity"]]), summed["largest"])
        bare = records(self.sweep(*swept, "--no-errors"))
        self.assertEqual((bare[0]["delta_v_tip"], bare[0]["delta_v_tip_error"]), (rows[0]["delta_v_tip"], ""))

    def test_a_column_that_is_there_anyway_can_be_asked_for_and_is_there_once(self):
        camera = ["--probe", "camera:0.048,0.016,0.0095"]
        for scene, name in (([PHONE, *camera], "peak_g_camera"), ([self.scene], "last_start")):
            arguments = [*scene, "--set", "drop.angle_deg=10:40:30", "--set", "run.impacts=1"]
            plain, asked = (records(self.sweep(*arguments, *more)) for more in ([], ["--columns", f"{name},impulse_normal_1"]))
            self.assertEqual([row[name] for row in asked], [row[name] for row in plain])
            self.assertEqual(set(asked[0]) - set(plain[0]), {"impulse_normal_1", "impulse_normal_1_error"})

    def test_a_body_that_is_swept_is_the_body_of_each_scene(self):
        swept = records(self.sweep("rod-at-1ms", "--set", "body.length=0.5:1:0.5", "--set", "body.mass=1:2:1", "--rows", "impact", *QUICK))
        for n, (length, mass) in enumerate((("0.5", "1"), ("0.5", "2"), ("1", "1"), ("1", "2"))):
            own = [row for row in swept if row["index"] == str(n)]
            for row, expected in zip(own, rows_of("simulate", "rod-at-1ms", "--length", length, "--mass", mass, *QUICK_FLAGS), strict=True):
                self.assertEqual({name: row[name] for name in expected}, expected)
        swept = records(self.sweep(PHONE, "--set", "body.size.thickness=0.01:0.02:0.01", "--rows", "impact", *QUICK))
        self.check(swept, rows_of("simulate", PHONE, "--size", "0.10566x0.04394x0.02", *QUICK_FLAGS), "body.size.thickness", 0.02)


class EnergyToRest(Folder):
    def test_a_drop_to_rest_loses_all_that_its_fall_gave_it(self):
        """m g (h - height of the centre of mass at rest): upright, flat and tipped over in the plane, on faces in space."""
        box = "[drop]\nheight = 1\n[body]\nshape = 'box'\nsize = [0.3, 0.2, 0.1]\nmass = 1.2\n[impact]\nrestitution = 0.4\nfriction = 0.3\n"
        rod = "[drop]\nheight = 1\n[body]\nradius = 0\n[impact]\nrestitution = 0.5\n"
        for scene, mass, drops in ((rod, 1, {"drop.angle_deg=90": 0.5, "drop.angle_deg=0": 0}), (box, 1.2, {"drop.angle_deg=0": 0.05, "drop.angle_deg=90": 0.15, "drop.angle_deg=30": None,
                                   "drop.attitude=[1,0,0,0]": 0.05, "drop.orientation=1": 0.15, "drop.orientation=4": 0.1})):
            for drop, height in drops.items():
                with self.subTest(drop, mass=mass):
                    arguments = [self.write("fall.toml", scene), *(word for key in (drop, "run.until_rest=true", "impact.restitution=0.5") for word in ("--set", key)), "--columns", "rest_face"]
                    row, = records(run("sweep", *arguments).stdout)
                    self.assertEqual(row["outcome"], "at-rest")
                    lies = height if height is not None else {"x": 0.15, "y": 0.1, "z": 0.05}[row["rest_face"][1]]
                    lost, error = float(row["energy_loss"]), float(row["energy_loss_error"] or "inf")
                    self.assertLessEqual(abs(lost - mass * 9.81 * (1 - lies)), min(error, 1e-9))
                    if height is not None:
                        self.assertLess(error, 1e-9)


class Scenes(Folder):
    def test_the_last_set_varies_fastest_and_one_value_is_no_column(self):
        text = self.sweep(self.scene, "--set", "drop.angle_deg=10:20:10", "--set", "drop.speed=2",
                          "--set", "drop.spin=0:0.2:0.1")
        rows = records(text)
        self.assertEqual([(row["drop.angle_deg"], row["drop.spin"]) for row in rows],
                         [(a, s) for a in ("10", "20") for s in ("0", "0.1", "0.2")])
        self.assertNotIn("drop.speed", rows[0])
        self.assertEqual(text, self.sweep("--set", "drop.angle_deg=10:20:10", "--set", "drop.speed=2", "--set", "drop.spin=0:0.2:0.1", self.scene))
        head = text[:text.index("index,")]
        for part in ("# clatter ", '"speed":2,', "# set: drop.spin = 0:0.2:0.1\n", "# scenes: 6\n"):
            self.assertIn(part, head)

    def test_a_ground_makes_the_model_continuous_unless_another_is_named(self):
        self.assertIn("discrete model", self.sweep(self.scene))
        self.assertIn("continuous model", self.sweep(PHONE, *QUICK))
        self.assertIn("discrete model", self.sweep(PHONE, "--model", "discrete"))
        thick = ["--set", "body.radius=0.01", "--set", "run.impacts=1", "--set", "run.digits=3"]
        self.assertIn("continuous model", self.sweep(self.scene, "--set", "ground.stiffness=1e8", *thick))

    def test_scenes_without_numbers_are_rows_with_their_outcome(self):
        # Spin lifts end a; an impulse ratio jams.
        spun = records(self.sweep(self.scene, "--set", "drop.spin=0:20:10", "--set", "drop.angle_deg=30", said=r"clatter: 2 of 3 scenes are refused; 1: .*\n"))
        self.assertEqual([(row["outcome"], row["impacts"]) for row in spun][1:], [("refused", "")] * 2)
        self.assertEqual(spun[1]["total_normal_impulse"], "")
        outside = r"clatter: 1 of 2 scenes are outside the model; 1: .*\n"
        jammed = records(self.sweep(self.scene, "--set", "impact.impulse_ratio=0:1.5:1.5", "--set", "drop.angle_deg=63.4", said=outside))
        self.assertEqual([row["outcome"] for row in jammed], ["impact-limit", "outside-model"])
        rows = records(self.sweep(self.scene, "--set", "impact.impulse_ratio=0:1.5:1.5", "--set", "drop.angle_deg=63.4", "--rows", "impact", said=outside))
        self.assertEqual((rows[-1]["outcome"], rows[-1]["n"], rows[-1]["energy_loss"]), ("outside-model", "", ""))
        low = records(self.sweep(PHONE, "--set", "drop.height=0.001:1.001:1", *QUICK, said="clatter: 1 of 2 scenes are refused; 0: .*\n"))
        self.assertEqual([row["outcome"] for row in low], ["refused", "impact-limit"])
        self.assertEqual(low[0]["first_peak_force"], "")

    def test_a_line_counts_the_scenes_that_are_refused_wherever_rows_go(self):
        """Spin of 10 rad/s lifts end a; that leaves the status, as no number is missing that the model has."""
        for spins, count, first in (("0,10,20,0", 2, 1), ("10,20", 2, 0)):
            keys = ("--set", "drop.angle_deg=30", "--set", f"drop.spin={spins}")
            line = rf"clatter: {count} of {spins.count(',') + 1} scenes are refused; {first}: [^\n]*does not approach[^\n]*\n"
            for more in ((), ("--summary",), ("--rows", "impact"), ("--format", "json")):
                self.sweep(self.scene, *keys, *more, said=line)
            self.sweep(self.scene, *keys, "--dry-run", said=line.replace("scenes are", "scenes tried are"))
            for name in ["x.csv"] + ["x.h5"] * bool(HDF5):
                self.sweep(self.scene, *keys, "--output", self.path(name), said=line)
                self.sweep(self.scene, *keys, "--output", self.path(name), said=".* is complete, .*\n" + line)
                self.sweep(self.scene, *keys, "--output", self.path(name), "--check", said=".* is whole, .*\n" + line)
                os.remove(self.path(name))

    def test_what_settings_and_options_cannot_be_is_one_line(self):
        self.each_refused(REFUSED, "sweep", "rod.toml")

    def test_a_sweep_in_the_scene_file_is_refused_unless_it_is_set(self):
        self.refused("--set", "sweep", "phone-sweep")
        self.assertEqual(len(records(self.sweep("phone-sweep", "--set", "drop.angle_deg=10:20:10", "--set", "run.digits=3"))), 2)

    def test_keys_that_the_other_model_reads_alone_cannot_be_swept(self):
        """They would give the same scene again and again; one value of them is no sweep of them."""
        for model, other, keys in (("continuous", "discrete", ("impact.restitution=0.5:1:0.1", "impact.friction=0,0.3")),
                                   ("discrete", "continuous", ("body.mesh.layers=10,20", "run.tolerance=1e-6,1e-5"))):
            for key in keys:
                self.refused(f"changes nothing in the {model} model; give --model {other}", "sweep", "rod-10", "--model", model, "--set", key)
        law = "[impact]\nrestitution = 0.4\nfriction = 0.3\n"
        ground = "[ground]\nstiffness = 1e9\ndamping = 1e8\nstatic_friction = 0.9\nsliding_friction = 0.3\n"
        crate = "[drop]\nangle_deg = 10\nheight = 1\n[body]\nshape = 'box'\nsize = [0.3, 0.2, 0.1]\nmass = 1.2\n"
        for scene, keys, words in ((crate + law + ground, ("ground.sliding_friction=0.1:0.4:0.1",), "where impact.friction goes before it; leave out impact.friction"),
                                   (crate + law + ground, ("ground.damping=0:1e8:5e7", "drop.angle_deg=1,2"), "where impact.restitution goes before it"),
                                   (crate + ground, ("ground.damping=0:1e8:5e7", "impact.restitution=0.3,0.4"), "where impact.restitution goes before it"),
                                   (crate + law.replace("friction", "law = 'poisson'\nfriction") + ground, ("ground.stiffness=1e8,1e9",), "where impact.restitution with impact.law goes before it"),
                                   (crate + ground, ("ground.static_friction=0.5,0.9",), "where ground.sliding_friction goes before it"),
                                   (crate + ground.replace("damping = 1e8\n", ""), ("ground.stiffness=1e8,1e9",), "in the discrete model; give --model")):
            with self.subTest(keys):
                self.write("crate.toml", scene)
                said = self.refused(words, "sweep", "crate.toml", "--model", "discrete", *(word for key in keys for word in ("--set", key)))
                self.assertIn("changes nothing in the discrete model", said)
                key, *ends = re.split("[=,:]", keys[0])
                law_too = ["--set", "impact.restitution=0.3"] * ("impact" in keys[-1])
                said = self.refused(words.replace("; give --model", ""), "map", "crate.toml", "--over", f"{key}={ends[0]}:{ends[1]}",
                                    "--over", "drop.speed=1:2", *law_too, "--output", "x.npy")
                self.assertNotIn("--model", said)
        for keys in ("ground.damping=0:1e8:5e7", "ground.stiffness=1e8,1e9", "ground.sliding_friction=0.1,0.3"):  # which the law is made of
            rows = records(run("sweep", self.write("crate.toml", crate + ground), "--model", "discrete", "--set", keys).stdout)
            self.assertGreater(len({row["energy_loss"] for row in rows}), 1)
        rows = records(self.sweep("rod-10", "--set", "impact.restitution=0.5", "--set", "drop.speed=1,2", "--set", "run.impacts=1",
                                  "--set", "run.digits=3", said="clatter: warning: --restitution 0.5 is the discrete model's alone: .*\n"))
        self.assertEqual(len(rows), 2)

    def test_a_drop_that_no_motion_brings_down_is_a_row_whatever_the_ground_asks_of_it(self):
        """The damping for the restitution of the first impact follows from an approach that such a drop has not."""
        scene = self.write("floor.toml", THIN_ROD.replace("radius = 0\n", "radius = 0.02\n") + "[ground]\nstiffness = 1e9\nrestitution = 0.5\n")
        for spins in ("-40:40:20", "40:-40:-20"):
            for model in ("discrete", "continuous"):
                done = run("sweep", scene, "--model", model, "--set", "drop.angle_deg=10,20", "--set", f"drop.spin={spins}", "--set", "run.impacts=1",
                           "--set", "run.digits=2")
                refused = [row for row in records(done.stdout) if row["outcome"] == "refused"]
                self.assertEqual((done.returncode, len(records(done.stdout))), (0, 10), done.stderr)
                self.assertEqual({float(row["drop.spin"]) for row in refused}, {20, 40})
        topple = self.write("topple.toml", "[drop]\nangle_deg = 0\ntopple = 0.1\n[body]\nshape = 'box'\nsize = [0.3, 0.2, 0.1]\n[impact]\nrestitution = 0.3\n")
        done = run("sweep", topple, "--set", "drop.topple=0.1,0.2,0.299")
        self.assertEqual([row["outcome"] == "refused" for row in records(done.stdout)], [False, False, True], done.stderr)

    def test_rows_whose_law_creates_energy_are_found_by_a_column(self):
        arguments = ["--set", "drop.angle_deg=10:60:10", "--set", "impact.impulse_ratio=0,0.5", "--set", "impact.restitution=0.5"]
        for more in ([], ["--rows", "impact"], ["--output", self.path("x.csv")]):
            done = run("sweep", self.scene, *arguments, *more)
            rows = records(done.stdout or self.read("x.csv"))
            warned = sorted({int(row["index"]) for row in rows if row["warning"]})
            self.assertEqual((done.returncode, {row["reason"] for row in rows if row["outcome"] != "outside-model"}), (0, {""}))
            self.assertIn(f"clatter: {len(warned)} of 12 scenes warn, column warning; scene {warned[0]}: the impulse ratio", done.stderr)
            for row in rows:  # Eq. 8 gives and takes: a law that creates energy loses less than nothing in some impact
                if more == ["--rows", "impact"] and row["energy_loss"] and float(row["energy_loss"]) < -1e-12:
                    self.assertIn(int(row["index"]), warned)
        self.assertTrue(0 < len(warned) < 12)
        self.assertIn(f"warning: {len(warned)} rows, as the impulse ratio", run("sweep", self.scene, *arguments, "--summary").stdout.replace("\n  ", " "))

    def test_a_limit_that_nobody_gave_is_said_where_it_cuts(self):
        scene = self.write("free.toml", "[drop]\nangle_deg = 10\n[body]\nradius = 0\n")
        cuts = {}
        for options in ((), ("--rows", "impact"), ("--output", self.path("rows.csv")), ("--set", "run.impacts=6")):
            done = run("sweep", scene, "--set", "drop.angle_deg=1:89:1", "--set", "impact.restitution=0.05", *options)
            rows = records(self.read("rows.csv") if "--output" in options else done.stdout)
            cuts[options] = len({row["index"] for row in rows if row["outcome"] == "impact-limit"})
            self.assertEqual((done.returncode, {row["reason"] for row in rows}), (0, {""}))
            words = f"clatter: {cuts[options]} of 89 scenes end at 6 impacts, where more may follow: run.impacts is not given\n"
            self.assertEqual(done.stderr, "" if "run.impacts=6" in options else words)
        self.assertEqual(len(set(cuts.values())), 1)
        self.assertTrue(0 < cuts[()] < 89)

    def test_the_file_does_not_depend_on_the_number_of_threads(self):
        for arguments in ([self.scene, "--set", "drop.angle_deg=0.1:60:0.1", "--rows", "impact"],
                          [self.scene, "--set", "drop.angle_deg=1:60", "--set", "body.length=0.1:3:log", "--random", "3000"],
                          [PHONE, "--set", "drop.angle_deg=3:89:2", *QUICK]):
            texts = {self.sweep(*arguments, "--threads", threads) for threads in ("1", "2", "3")}
            self.assertEqual(len(texts), 1, arguments)
            self.assertEqual(self.sweep(*arguments, "--output", self.path("out.csv"), "--restart"), "")
            self.assertEqual({self.read("out.csv")}, texts)
            self.assertEqual(sorted(os.listdir(self.folder)), ["out.csv", "rod.toml"])

    def test_an_interrupted_sweep_goes_on_to_the_same_bytes(self):
        for arguments in ([self.scene, "--set", "drop.angle_deg=0.0004:60:0.0004"],
                          [PHONE, "--set", "drop.angle_deg=3:89:0.05", "--rows", "impact", *QUICK]):
            for number in (signal.SIGINT, signal.SIGKILL, signal.SIGTERM):
                status, words = self.stopped(number, "out.csv", "sweep", *arguments)
                if os.path.exists(self.path("out.csv")):  # all was done when the signal came
                    self.assertNotEqual(number, signal.SIGINT, "too short a sweep to interrupt")
                    break
                self.assertEqual(status, -number if number == signal.SIGKILL else 130)
                if status == 130:
                    self.assertRegex(words, r"\A(clatter: goes on after .*\n)?clatter: interrupted after \d+ of \d+ scenes; the same command goes on\n$")
                self.assertTrue(os.path.exists(self.path("out.csv.part")))
            if not os.path.exists(self.path("out.csv")):
                done = run("sweep", *arguments, "--output", self.path("out.csv"))
                self.assertRegex(done.stderr, r"\Aclatter: goes on after \d+ of \d+ scenes\n\Z")
                self.assertEqual(done.returncode, 0)
            self.assertEqual(self.read("out.csv"), self.sweep(*arguments))
            self.assertFalse(os.path.exists(self.path("out.csv.part")))
            os.remove(self.path("out.csv"))

    def test_a_file_that_lacks_rows_is_refused_and_parts_joined_are_the_whole(self):
        arguments = ("sweep", self.scene, "--set", "drop.angle_deg=1:40:0.5")
        whole = self.sweep(*arguments[1:])
        lines = whole.splitlines(keepends=True)
        for damaged in (lines[:-20] + lines[-12:], lines[:-9], [*lines[:-1], lines[-1][:-1]]):
            self.write("rows.csv", "".join(damaged))
            done = self.run_program(*arguments, "--output", "rows.csv")
            self.assertRegex(done.stderr, r"\Aclatter: --output rows\.csv: is of this sweep, but not whole after scene \d+; .*--restart")
            self.assertEqual((done.returncode, self.read("rows.csv")), (2, "".join(damaged)))
            self.assertEqual(self.run_program(*arguments, "--output", "rows.csv", "--restart").returncode, 0)
            self.assertEqual(self.read("rows.csv"), whole)
        parts = [self.run_program(*arguments, "--scenes", some).stdout.splitlines(keepends=True) for some in ("0:29", "30:78")]
        joined = [line for line in parts[0] if not line.startswith("# here")] + [line for line in parts[1] if line[0].isdigit()]
        self.write("all.csv", "".join(joined))
        self.assertIn("is complete", self.run_program(*arguments, "--output", "all.csv").stderr)
        self.assertEqual(self.read("all.csv"), whole)

    def test_a_sweep_of_keys_alone_needs_no_scene(self):
        keys = ("--set", "world.gravity=9.81", "--set", "body.radius=0", "--set", "run.impacts=4")
        self.assertEqual(self.sweep(*keys, "--set", "drop.angle_deg=10,20", "--bare"), self.sweep(self.scene, "--set", "drop.angle_deg=10,20", "--bare"))
        self.refused("SCENE, or keys by --set: required", "sweep")

    def test_a_complete_file_of_the_same_sweep_is_left_as_it_is(self):
        for name in ["out.csv"] + ["out.h5"] * bool(HDF5):
            command = ["sweep", self.scene, "--set", "drop.angle_deg=1:40:0.01", "--rows", "impact", "--output", self.path(name)]
            self.sweep(*command[1:])
            whole, inode = self.bytes(name), os.stat(self.path(name)).st_ino
            again = run(*command)
            self.assertEqual((again.returncode, again.stderr), (0, f"clatter: {self.path(name)} is complete, nothing is left to do; --restart computes it anew\n"))
            self.assertEqual((os.stat(self.path(name)).st_ino, self.bytes(name)), (inode, whole))
            self.assertFalse(os.path.exists(self.path(name + ".part")))
            self.sweep(*command[1:], "--restart")
            self.assertNotEqual(os.stat(self.path(name)).st_ino, inode)
            for other, words in ((["--set", "drop.speed=2"], "drop.speed is 1 there, 2 here"), (["--set", "run.errors=false"], "run.errors is true there, false here"),
                                 (["--set", "body.length=2"], "body.length is 1 there, 2 here"), (["--columns", "hardest", "--rows", "scene"], "one row per impact there, "),
                                 (["--set", "drop.spin=0:1:1"], "drop.spin is 0 there, null here")):
                other = [*command[:-4], *command[-2:], *(other if "--rows" in other else ["--rows", "impact", *other])]
                said = self.refused(f"{name}: is there already, of another sweep (", *other)
                self.assertIn(words, said)
                self.assertIn("; --restart overwrites it", said)
                self.sweep(*other[1:], "--restart")
                self.assertNotEqual(self.bytes(name), whole, other)
                self.sweep(*command[1:], "--restart")
                self.assertEqual(self.bytes(name), whole, other)

    def test_no_file_of_others_is_written_over_unless_it_is_asked_for(self):
        sweep = ["sweep", self.scene, "--set", "drop.angle_deg=1:40:13"]
        a_map = ["map", "--over", "drop.angle_deg=1:60", "--over", "drop.speed=1:2", "--size", "4x2"]
        rows, pixels = self.sweep(*sweep[1:]), run(*a_map, "--output", self.path("map.csv"))
        self.assertEqual(pixels.returncode, 0)
        for command, name, foreign in ((sweep, "x.csv", {"notes": "and is not of this sweep", rows.replace("13", "14"): "of another sweep (",
                                                         self.read("map.csv"): "and is not of this sweep"}),
                                       ([*sweep, "--bare"], "x.csv", {"notes": "does not say of which sweep", rows: "does not say of which sweep"}),
                                       *[(sweep, "x.h5", {"notes": "and is not of this sweep", rows: "and is not of this sweep"})] * bool(HDF5),
                                       (a_map, "x.csv", {"notes": "and is not of this map", rows: "and is not of this map",
                                                         self.read("map.csv").replace("speed = 1:2", "speed = 1:3"): "of another map ("}),
                                       (a_map, "x.npy", {"notes": "does not say of which map"})):
            for text, words in foreign.items():
                with self.subTest(command=command[0], name=name, words=words):
                    self.write(name, text)
                    said = self.refused(words, *command, "--output", name)
                    self.assertIn(f"--output {name}: is there already, ", said)
                    self.assertIn("; --restart overwrites it", said)
                    self.assertEqual((self.read(name), os.path.exists(self.path(name + ".part"))), (text, False))
                    self.assertEqual(self.run_program(*command, "--output", name, "--restart").returncode, 0)
            os.remove(self.path(name))
            self.write(name, "")
            self.assertEqual(self.run_program(*command, "--output", name).returncode, 0)
        again = self.run_program(*a_map, "--output", "map.csv")
        self.assertEqual((again.returncode, again.stderr), (0, "clatter: map.csv is complete, nothing is left to do; --restart computes it anew\n"))

    def test_a_file_of_a_scene_that_lay_elsewhere_is_of_the_same_sweep(self):
        os.mkdir(self.path("other"))
        for name in ["x.csv"] + ["x.h5"] * bool(HDF5):
            self.sweep(self.scene, "--set", "drop.angle_deg=1:40:13", "--output", self.path(name))
            other = self.write("other/rod.toml", THIN_ROD)
            self.assertIn("is complete", run("sweep", other, "--set", "drop.angle_deg=1:40:13", "--output", self.path(name)).stderr)
            self.write("other/rod.toml", THIN_ROD + "digits = 7\n")
            self.refused("run.digits is 6 there, 7 here", "sweep", other, "--set", "drop.angle_deg=1:40:13", "--output", self.path(name))

    def test_what_one_of_two_sweeps_alone_has_is_named(self):
        for name in ["x.csv"] + ["x.h5"] * bool(HDF5):
            command = ["sweep", self.scene, "--set", "drop.angle_deg=1:40:13", "--output", self.path(name)]
            self.sweep(*command[1:], "--scenes", "0:2")
            self.refused("(here is scenes 0 to 2 there, nothing here)", *command)
            self.refused("(here is scenes 0 to 2 there, scenes 0 to 1 here)", *command, "--scenes", "0:1")
            self.refused("(columns is nothing there, hardest here)", *command, "--scenes", "0:2", "--columns", "hardest")

    def test_a_part_without_its_digests_is_kept_and_refused(self):
        command = ["sweep", self.scene, "--set", "drop.angle_deg=1:40:13"]
        whole = self.sweep(*command[1:])
        self.write("x.csv.part", whole)
        self.refused("x.csv.part has rows, but x.csv.part.digests, which tells how many of them are whole, is not there", *command, "--output", "x.csv")
        self.assertEqual(self.read("x.csv.part"), whole)
        self.write("x.csv.part.digests", "")
        done = self.run_program(*command, "--output", "x.csv")
        self.assertIn("rows after its first 0 scenes are not as they were written, and are computed anew", done.stderr)
        self.assertEqual(self.read("x.csv"), whole)

    def test_check_says_what_a_file_lacks_and_computes_nothing(self):
        command = ["sweep", self.scene, "--set", "drop.angle_deg=1:40:0.5", "--output", "all.csv", "--check"]
        whole = self.sweep(*command[1:-3])
        lines = whole.splitlines(keepends=True)
        head, rows = [line for line in lines if not line[0].isdigit()], [line for line in lines if line[0].isdigit()]
        for some, status, words in ((rows, 0, "all.csv is whole, with 79 scenes"), (rows[:30] + rows[40:70] + rows[71:], 1, "lacks 11 of 79 scenes: 30 to 39, 70"),
                                    (rows[40:] + rows[:40], 1, "a row of scene 0 follows one of scene 78"), (rows[:9] + rows[8:], 1, "a row of scene 8 follows one of scene 8"),
                                    ([*rows[:-1], rows[-1][:-1]], 1, "its last row is cut"), (rows[:7], 1, "lacks 72 of 79 scenes: 7 to 78"),
                                    ([*rows[:5], rows[5].replace("5,3.5", "5,3.6"), *rows[6:]], 1, "scene 5 has other values of its keys")):
            with self.subTest(words):
                self.write("all.csv", text := "".join(head + some))
                done = self.run_program(*command)
                self.assertEqual((done.returncode, done.stdout, self.read("all.csv")), (status, "", text))
                self.assertIn(words, done.stderr)
                self.assertEqual(sorted(os.listdir(self.folder)), ["all.csv", "rod.toml"])
        self.write("all.csv", "notes")
        self.refused("and is not of this sweep", *command)
        os.remove(self.path("all.csv"))
        done = self.run_program(*command)
        self.assertEqual((done.returncode, done.stderr, os.listdir(self.folder)), (1, "clatter: all.csv is not there: all of 79 scenes are missing\n", ["rod.toml"]))
        for bad in (["--restart"], ["--bare"], ["--summary"]):
            self.refused("--", *command, *bad)
        if HDF5:
            self.sweep(*command[1:-3], "--scenes", "0:40", "--output", self.path("a.h5"))
            parts = [run(*command[:-3], "--scenes", "0:40", "--output", self.path("a.h5"), "--check") for _ in range(2)]
            self.assertEqual([(part.returncode, part.stderr) for part in parts], [(0, f"clatter: {self.path('a.h5')} is whole, with 41 scenes\n")] * 2)

    def test_check_finds_impacts_that_are_missing_within_a_scene(self):
        """A rod that comes to rest has a tail, which no number of an impact vouches for."""
        command = ["sweep", self.scene, "--set", "drop.angle_deg=10:40:5", "--set", "impact.restitution=0.5", "--set", "run.impacts=50",
                   "--rows", "impact", "--output", "all.csv", "--check"]
        lines = self.sweep(*command[1:-3]).splitlines(keepends=True)
        head, rows = [line for line in lines if not line[0].isdigit()], [line for line in lines if line[0].isdigit()]
        self.assertIn(",tail,", rows[-1])
        places = {name: [k for k, row in enumerate(rows) if row.split(",")[0] == name] for name in "013"}
        for gone, words in ((places["3"][1:4], "lacks impacts of 1 scenes: 3"), (places["0"][:1], "lacks impacts of 1 scenes: 0"),
                            ([len(rows) - 1], "lacks impacts of 1 scenes: 6"), (places["1"][-2:-1] + places["3"][-1:], "lacks impacts of 2 scenes: 1, 3"),
                            (places["0"] + places["1"][1:], "lacks 1 of 7 scenes: 0; impacts of 1 scenes: 1")):
            with self.subTest(words):
                self.write("all.csv", "".join(head + [row for k, row in enumerate(rows) if k not in gone]))
                done = self.run_program(*command)
                self.assertEqual((done.returncode, done.stderr), (1, f"clatter: all.csv {words}\n"))
                self.assertIn("is of this sweep, but not whole", self.run_program(*command[:-1]).stderr)
        first = places["3"][1]
        for twice in ([*rows[:first], rows[first], *rows[first:]], [*rows[:first], rows[first + 1], rows[first], *rows[first + 2:]]):
            self.write("all.csv", "".join(head + twice))
            self.assertIn("impact 2 of scene 3 is there again, or late", self.run_program(*command).stderr)
        self.write("all.csv", "".join(head + rows))
        self.assertEqual(self.run_program(*command).returncode, 0)

    def test_check_knows_the_part_of_a_run_that_was_interrupted(self):
        command = ["sweep", self.scene, "--set", "drop.angle_deg=1:40:0.5"]
        part = ("--scenes", "20:69")
        whole = self.sweep(*command[1:], *part).splitlines(keepends=True)
        for suffix in [".csv"] + [".h5"] * bool(HDF5):
            self.sweep(*command[1:], "--scenes", "0:19", "--output", self.path("a" + suffix))
            text = "".join(whole[:-40])  # ten scenes
            self.write(f"b{suffix}.part", text)
            self.write(f"b{suffix}.part.digests", f"{len(text.encode())} 10 0123456789abcdef\n{len(text.encode()) + 1} 11 0123456789abcdef\n")
            done = self.run_program(*command, "--check", "--parts", "a" + suffix, "b" + suffix)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"b{suffix}: b{suffix}.part has 10 of 50 scenes; its command goes on\n", done.stderr)
            self.assertIn("20 of 79 scenes are there; missing: 20 to 78\n", done.stderr)
            done = self.run_program(*command, *part, "--output", "b" + suffix, "--check")
            self.assertEqual((done.returncode, done.stderr), (1, f"clatter: b{suffix} is not there; b{suffix}.part has 10 of 50 scenes; the same command goes on\n"))

    def test_check_says_of_each_part_and_of_all_of_them_what_they_lack(self):
        command = ["sweep", self.scene, "--set", "drop.angle_deg=1:40:1"]
        for suffix in [".csv"] + [".h5"] * bool(HDF5):
            names = [name + suffix for name in "abcd"]
            for name, scenes in zip(names, ("0:9", "10:38:2", "11:39:2", "5:12"), strict=True):
                self.run_program(*command, "--scenes", scenes, "--output", name)
            self.run_program(*command, "--set", "drop.speed=2", "--scenes", "10:19", "--output", "e" + suffix)
            for parts, status, *lines in (
                ("abc", 0, "a: scenes 0 to 9, whole", "b: scenes 10 to 38 by 2, whole", "c: scenes 11 to 39 by 2, whole", "40 of 40 scenes are there"),
                ("ac", 1, "a: scenes 0 to 9, whole", "25 of 40 scenes are there; missing: 10, 12, 14, "),
                ("abcd", 1, "d: scenes 5 to 12, whole", "40 of 40 scenes are there; more than once: 5 to 12"),
                ("abcf", 1, "f: is not there, or empty", "40 of 40 scenes are there"),
                ("ae", 1, "e: of another sweep (drop.speed is 2 there, 1 here)", "10 of 40 scenes are there; missing: 10 to 39"),
            ):
                with self.subTest(parts=parts, suffix=suffix):
                    done = self.run_program(*command, "--check", "--parts", *(part + suffix for part in parts))
                    self.assertEqual((done.returncode, done.stdout), (status, ""))
                    for line in lines:
                        self.assertIn("clatter: " + line.replace(": ", suffix + ": ", 1) if line[1] == ":" else line, done.stderr)
        text = self.read("a.csv").splitlines(keepends=True)
        self.write("a.csv", "".join(text[:-9] + text[-8:-6] + text[-4:-2]))  # without 1, 4, 5, 8 and 9
        done = self.run_program(*command, "--check", "--parts", "a.csv", "b.csv", "c.csv", "d.csv")
        self.assertEqual(done.returncode, 1)
        self.assertIn("a.csv: scenes 0 to 9, lacks 5 of 10 scenes: 1, 4 to 5, 8 to 9\n", done.stderr)
        self.assertIn("38 of 40 scenes are there; missing: 1, 4; more than once: 6 to 7, 10 to 12\n", done.stderr)
        self.write("all.csv", "".join(text) + self.read("b.csv") + self.read("c.csv"))
        for joined in (self.read("all.csv"), "".join(text)):
            self.write("all.csv", joined)
            done = self.run_program(*command, "--output", "all.csv", "--check")
            self.assertEqual((done.returncode, "line '# here' of a part: leave it out" in done.stderr, "--restart" in done.stderr), (1, True, False))
        for bad in ([], ["--check", "--output", "a.csv"], ["--check", "--scenes", "0:9"]):
            self.refused("--parts", *command, "--parts", "a.csv", *bad)

    def test_a_dry_run_tells_the_size_and_the_time_of_a_sweep_and_writes_nothing(self):
        command = ["sweep", self.scene, "--set", "drop.angle_deg=1:80:lin:3000", "--output", "all.csv"]
        done = self.run_program(*command, "--dry-run", "--threads", "4", "--format", "json")
        [told] = json.loads(done.stdout)["rows"]
        self.assertEqual((done.returncode, told["scenes"], told["threads"], told["tried"]), (0, 3000, 4, 1000))
        self.assertNotIn("all.csv", os.listdir(self.folder))
        self.assertEqual(told["time"], told["cpu_time"] / 4)
        self.run_program(*command)
        size = os.path.getsize(self.path("all.csv"))
        self.assertLess(abs(told["bytes"] - size), 0.02 * size)  # a third of the rows, spread evenly
        few = json.loads(self.run_program(*command[:-2], "--scenes", "0:6", "--dry-run", "--format", "json").stdout)["rows"][0]
        self.assertEqual((few["scenes"], few["tried"]), (7, 7))
        for bad in ("--summary", "--check", "--restart"):
            self.refused("--dry-run", *command, "--dry-run", bad)

    def test_every_so_many_scenes_are_those_of_the_whole(self):
        for arguments in (["--set", "drop.angle_deg=1:40:1", "--set", "drop.speed=1,2"], ["--set", "drop.angle_deg=1:60", "--random", "100", "--seed", "7"]):
            whole = [line for line in self.sweep(self.scene, *arguments).splitlines() if line[0].isdigit()]
            text = self.sweep(self.scene, *arguments, "--scenes", "3:70:9")
            self.assertIn("# here: scenes 3 to 66 by 9\n", text)
            self.assertEqual([line for line in text.splitlines() if line[0].isdigit()], whole[3:71:9])
            self.sweep(self.scene, *arguments, "--scenes", "3:70:9", "--output", self.path("x.csv"))
            self.assertEqual(self.read("x.csv"), text)
            again = run("sweep", self.scene, *arguments, "--scenes", "3:70:9", "--output", self.path("x.csv"))
            self.assertIn("is complete", again.stderr)
            os.remove(self.path("x.csv"))

    def test_what_falls_short_is_said_again_of_a_file_that_is_there(self):
        arguments = ["sweep", PHONE, "--set", "run.evaluation_limit=20:60020:20000", *QUICK]
        said = "clatter: 1 of 4 scenes fall short; 0: evaluation-limit: "
        for name in ["out.csv"] + ["out.h5"] * bool(HDF5):
            first, again = (run(*arguments, "--output", self.path(name)) for _ in range(2))
            self.assertEqual((first.returncode, again.returncode), (3, 3))
            self.assertTrue(first.stderr.startswith(said), first.stderr)
            self.assertEqual(again.stderr.splitlines()[1:], first.stderr.splitlines())

    def test_scenes_of_a_range_are_those_of_the_whole(self):
        for arguments in (["--set", "drop.angle_deg=1:40:0.01"], ["--set", "drop.angle_deg=5,10,15,20"],
                          ["--set", "drop.angle_deg=1:60", "--random", "3000", "--seed", "7"],
                          ["--set", "drop.attitude=[1,0,0,0],[0.96,0,0.28,0]", "--random", "3000", "--scatter", "3"]):
            for rows in ("scene", "impact"):
                command = [self.scene, *arguments, "--rows", rows]
                whole = [line for line in self.sweep(*command).splitlines() if line[0].isdigit()]
                scenes = 1 + int(whole[-1].split(",")[0])
                ranges = [f"0:{scenes // 3}", f"{scenes // 3 + 1}:{scenes - 1}"]
                joined, heads = [], []
                for one in ranges:
                    lines = self.sweep(*command, "--scenes", one).splitlines()
                    joined += [line for line in lines if line[0].isdigit()]
                    heads += [line for line in lines if line.startswith("# here: ")]
                self.assertEqual(joined, whole)
                self.assertEqual(heads, [f"# here: scenes {one.replace(':', ' to ')}" for one in ranges])
        for bad in ("0:4", "-1:2", "1", "1:", ":2", "a:b", "0:1.5", "4:3", "0:3:0", "0:3:-1", "0:3:x", "0:3:1:1", "3:2"):
            self.refused("--scenes '3:2': FROM must not be greater than TO" if bad == "3:2" else
                         "must be FROM:TO or FROM:TO:STEP, whole numbers, FROM and TO from 0 to 3, STEP from 1", "sweep", self.scene, "--set", "drop.angle_deg=5,10,15,20", "--scenes", bad)
        if HDF5:
            import h5py  # pylint: disable=import-outside-toplevel
            files = []
            for name, one in (("whole.h5", "0:3899"), ("a.h5", "0:1700"), ("b.h5", "1701:3899")):
                for _ in range(2):
                    done = run("sweep", self.scene, "--set", "drop.angle_deg=1:39.99:0.01", "--scenes", one, "--output", self.path(name))
                    self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("is complete", done.stderr)
                with h5py.File(self.path(name)) as file:
                    files.append([(column, file[column][:].tobytes()) for column in file if column not in ("words", "outcome", "reason")])
            for (column, whole), (_, one), (_, other) in zip(*files, strict=True):
                self.assertEqual(one + other, whole, column)

    def test_a_sweep_does_not_go_on_with_another_mesh_of_the_same_name(self):
        self.write("body.stl", box_stl(0.1))
        scene = self.write("mesh.toml", "[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\nmass = 1\ninertia = [1e-3, 1e-3, 1e-3]\n"
                           "centre = [0, 0, 0]\nmesh = { file = 'body.stl' }\n[ground]\nstiffness = 1e8\n"
                           "[run]\nimpacts = 1\ndigits = 3\n")
        arguments = [scene, "--set", "drop.angle_deg=1:3:1"]
        whole = self.sweep(*arguments)
        self.write("out.csv.part", whole[:-10])
        for other, words in ((box_stl(0.2), "body.extents.0 is 0.1 there, 0.2 here"),
                             (octahedron_stl(0.1), "body.mesh.triangles is 12 there, 8 here")):  # extents, mass and inertia are those of the first
            self.write("body.stl", other)
            self.refused(f"is of another sweep ({words}", "sweep", *arguments, "--output", self.path("out.csv"))
        self.write("body.stl", box_stl(0.1))
        self.write("out.csv.part.digests", "")
        self.sweep(*arguments, "--output", self.path("out.csv"), said=".* are computed anew\n")
        self.assertEqual(self.read("out.csv"), whole)
        self.write("out.csv.part", whole.replace("drop", "crop"))
        self.sweep(*arguments, "--output", self.path("out.csv"), "--restart")
        self.assertEqual(self.read("out.csv"), whole)

    @unittest.skipUnless(MPIRUN[0], "a build without MPI")
    def test_several_processes_write_the_same_bytes(self):
        def mpirun(*command):
            return subprocess.run([*MPIRUN, *command], capture_output=True, text=True, timeout=3000, check=False)

        for arguments in ([self.scene, "--set", "drop.angle_deg=0.01:60:0.01"],
                          [PHONE, "--set", "drop.angle_deg=3:89:2", "--rows", "impact", *QUICK]):
            for count in ("2", "3"):
                done = mpirun(count, PROGRAM, "sweep", *arguments, "--output", self.path("out.csv"), "--restart")
                self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
                self.assertEqual(self.read("out.csv"), self.sweep(*arguments), count)
        bad = mpirun("3", PROGRAM, "sweep", self.scene, "--set", "drop.angle=1:2:1")
        self.assertEqual((bad.returncode == 0, bad.stderr.count("did you mean")), (False, 1))
        # A program without MPI does not compute all scenes in each process.
        alone = mpirun("2", shutil.copy(PROGRAM, self.path("clatter")), "sweep", self.scene, "--set", "drop.angle_deg=1:2:1")
        self.assertEqual((alone.returncode == 0, alone.stdout, "install clatter-mpi" in alone.stderr), (False, "", True))

    @unittest.skipUnless(MPIRUN[0], "a build without MPI")
    def test_a_killed_process_costs_its_scenes_only(self):
        arguments = [PHONE, "--set", "drop.angle_deg=3:89:0.05", *QUICK]
        command, part, out = [PROGRAM, "sweep", *arguments, "--output", self.path("out.csv")], self.path("out.csv.part"), self.path("out.csv")
        for count in ("2", "3", "2"):
            size = os.path.getsize(part) if os.path.exists(part) else 0
            with subprocess.Popen([*MPIRUN, count, *command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as mpirun:
                until(lambda: mpirun.poll() is not None or os.path.exists(part) and os.path.getsize(part) > size + 20000)
                children = subprocess.run(["pgrep", "--parent", str(mpirun.pid)], capture_output=True, text=True, check=False)
                for child in children.stdout.split()[-1:]:
                    os.kill(int(child), signal.SIGKILL)
            if os.path.exists(out):  # all was written when the process was killed
                break
        if not os.path.exists(out):
            run(*command[1:])
        self.assertEqual(self.read("out.csv"), self.sweep(*arguments))


class RowsTogether(Folder):
    """Summaries and HDF5, against the rows as CSV."""

    def numbers(self, text, name):
        return [float(row[name]) for row in records(text) if row[name]]

    def test_a_summary_has_counts_percentiles_and_extremes_of_the_rows(self):
        arguments = [self.scene, "--set", "drop.angle_deg=0.5:89:0.5", "--set", "impact.restitution=0.3:1:0.1"]
        rows = self.sweep(*arguments)
        summary = self.summary(*arguments)
        self.assertEqual([row["quantity"] for row in summary["rows"]],
                         ["impacts", "total_normal_impulse", "energy_loss", "last_start"])
        for row in summary["rows"]:
            values = sorted(self.numbers(rows, row["quantity"]))
            self.assertEqual((row["count"], row["least"], row["largest"]), (len(values), values[0], values[-1]))
            for percent in (1, 5, 25, 50, 75, 95, 99):
                exact = values[-(-percent * len(values) // 100) - 1]
                error = row["error_estimate"][f"p{percent}"]
                self.assertLessEqual(abs(row[f"p{percent}"] - exact), error, (row["quantity"], percent))
                self.assertLessEqual(error, 2.0**-12 * abs(exact))
            at = [record for record in records(rows) if int(record["index"]) == row["largest_index"]][0]
            self.assertEqual(float(at[row["quantity"]]), row["largest"])
        counted = {name: collections.Counter(row[name] for row in records(rows)) for name in ("outcome", "impacts", "predictable")}
        self.assertEqual((summary["texts"]["outcome"], summary["counts"]), (counted["outcome"], {"impacts": counted["impacts"]}))
        self.assertEqual({share["text"]: share["count"] for share in summary["shares"]["predictable"]}, counted["predictable"])

    def test_a_summary_of_attitudes_names_the_worst_of_them_and_its_blow(self):
        arguments = ["phone-corner", "--model", "discrete", "--set", "drop.attitude=26", "--random", "104", "--scatter", "4"]
        rows = records(self.sweep(*arguments, "--columns", "hardest,hardest_impulse_normal,hardest_corners"))
        summary = self.summary(*arguments)
        self.assertEqual(len(summary["attitudes"]), 26)
        largest = {}
        for row in rows:
            if row["hardest_impulse_normal"]:
                place = int(row["index"]) % 26
                largest[place] = max(largest.get(place, 0), float(row["hardest_impulse_normal"]))
        found = [one["hardest_impulse_normal"]["largest"] for one in summary["attitudes"]]
        self.assertEqual(found, sorted(largest.values(), reverse=True))
        self.assertEqual([int(one["attitude"].split()[0]) - 1 for one in summary["attitudes"]],
                         sorted(largest, key=lambda place: -largest[place]))
        self.assertEqual(summary["texts"]["hardest_corners"], collections.Counter(row["hardest_corners"] for row in rows))
        self.assertEqual(summary["counts"]["hardest"], collections.Counter(row["hardest"] for row in rows))
        worst = [row for row in summary["rows"] if row["quantity"] == "hardest_impulse_normal"][0]
        again = self.numbers(self.sweep(*shlex.split(worst["largest_command"])[2:]), "impulse_normal")
        self.assertEqual(max(again), worst["largest"])

    def test_without_attitudes_a_scatter_is_about_the_scenes_own(self):
        rows = records(self.sweep(self.scene, "--set", "drop.angle_deg=12", "--random", "400", "--scatter", "3"))
        cosines = [abs(math.cos(math.radians(6)) * float(row["drop.attitude_q0"]) - math.sin(math.radians(6)) * float(row["drop.attitude_q2"]))
                   for row in rows]
        # Three turns of variance 9: the mean square is 27, known to sqrt(2/3/400) = 4 per cent.
        mean = sum((2 * math.degrees(math.acos(min(1, cosine)))) ** 2 for cosine in cosines) / len(rows)
        self.assertAlmostEqual(mean, 27, delta=27 * 0.2)

    def test_a_summary_tells_first_what_was_asked_and_then_what_else_is_remarkable(self):
        arguments = ["phone-corner", "--model", "discrete", "--set", "drop.attitude=26", "--random", "52", "--scatter", "4", "--set", "run.impacts=3"]
        asked = ["--probe", "lens:0.03,0.01,0.002", "--columns", "hardest,restitution_2"]
        table, notes = re.split(r"\n(?=attitudes by delta_v_lens)", self.sweep(*arguments, *asked, "--summary"))
        names = re.findall(r"^  ([a-z_]+\w*) +(?:\S+ +)?52 ", table, re.M)
        self.assertEqual(names[:2], ["delta_v_lens", "hardest"])
        self.assertNotIn("energy_loss", table)
        text = self.sweep(*arguments, *asked)
        tail = re.search(r"(?m)^(\w+): the largest, (\S+) \S+, is (\S+) times the median$", re.sub(r"\n  ", " ", notes))
        values = sorted(self.numbers(text, tail[1]))
        self.assertAlmostEqual(float(tail[3]), values[-1] / values[len(values) // 2 - 1], delta=0.01 * float(tail[3]))
        everything = json.loads(self.sweep(*arguments, *asked, "--summary", "--format", "json"))["rows"]
        self.assertIn("energy_loss", [row["quantity"] for row in everything])

    def test_the_commands_below_a_summary_can_be_pasted_into_a_shell(self):
        summary = self.sweep("phone-corner", "--model", "discrete", "--set", "drop.attitude=26", "--random", "26", "--scatter", "4", "--summary")
        commands = re.findall(r"^(\w+), the largest:\n((?:.*\\\n)*.*)$", summary, re.M)
        self.assertIn("hardest_impulse_normal", dict(commands))
        for name, command in commands:
            done = subprocess.run(["bash", "-c", f'clatter() {{ "$PROGRAM" "$@"; }}\n{command}'], capture_output=True, text=True,
                                  check=False, env={**os.environ, "PROGRAM": PROGRAM})
            self.assertEqual((done.returncode, done.stderr), (0, ""), (name, command))
            self.assertIn("drop.attitude=", command)
            self.assertGreater(len(records(done.stdout)), 0)

    @unittest.skipUnless(HDF5, "a build without HDF5")
    def test_hdf5_holds_the_numbers_of_csv_bit_for_bit(self):
        import h5py  # pylint: disable=import-outside-toplevel
        for arguments in ([self.scene, "--set", "drop.angle_deg=0.5:89:0.5", "--columns", "hardest,end_1"],
                          [self.scene, "--set", "drop.angle_deg=0.5:89:0.5", "--rows", "impact"],
                          ["phone-corner", "--model", "discrete", "--set", "drop.attitude=26", "--columns", "corners,hardest_corners,hardest_mode"],
                          [self.scene, "--set", "drop.angle_deg=0.0005:60:0.0005"]):
            rows = records(self.sweep(*arguments))
            self.assertEqual(self.sweep(*arguments, "--output", self.path("rows.h5"), "--restart"), "")
            self.assertEqual(sorted(os.listdir(self.folder)), ["rod.toml", "rows.h5"])
            with h5py.File(self.path("rows.h5")) as file:
                self.assertEqual(json.loads(file.attrs["scene"])["world"]["gravity"], 9.81)
                for name in rows[0]:
                    column = file[name][:]
                    if name in file.get("words", {}):
                        texts = [text.decode() for text in file["words"][name][:]] + [""]
                        self.assertEqual([texts[code] for code in column], [row[name] for row in rows], name)
                    else:
                        truths = {"true": 1, "false": 0, "": -1}
                        is_truth = column.dtype == "int8"
                        self.assertEqual(is_truth, name == "predictable", name)
                        values = [truths[row[name]] if is_truth else float(row[name] or "nan") for row in rows]
                        self.assertEqual(struct.pack(f"{len(values)}d", *column), struct.pack(f"{len(values)}d", *values), name)
                for column in file.values():
                    if column.name != "/words":  # a chunk is stored whole: they hold the rows and hardly more
                        self.assertLess(-(-len(rows) // column.chunks[0]) * column.chunks[0], len(rows) + 9)
                self.assertEqual(file["last_start" if "last_start" in file else "start"].attrs["unit"], "s")

    @unittest.skipUnless(HDF5, "a build without HDF5")
    def test_an_interrupted_sweep_to_hdf5_goes_on(self):
        arguments = [self.scene, "--set", "drop.angle_deg=0.0004:60:0.0004"]
        self.assertEqual(self.stopped(signal.SIGKILL, "rows.h5", "sweep", *arguments)[0], -signal.SIGKILL, "too short a sweep to interrupt")
        self.assertFalse(os.path.exists(self.path("rows.h5")))
        self.assertRegex(run("sweep", *arguments, "--output", self.path("rows.h5")).stderr, r"\A(clatter: (.* computed anew|goes on after \d+ of 150000 scenes)\n)?\Z")  # killed before the first digest
        self.sweep(*arguments, "--output", self.path("whole.h5"))
        self.assertEqual(self.bytes("rows.h5"), self.bytes("whole.h5"))
