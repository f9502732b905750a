# SPDX-License-Identifier: GPL-3.0-or-later
"""One language of scenes for every command: files, cases and flags alone; what clatter help keys and clatter init say of it."""

import re
import shutil

from run_folder import Folder, case

FORMS = {"sequence": [], "explain": ["2"], "simulate": [], "compare": [], "plan": ["--digits", "3"]}


def leaves(scene, prefix=""):
    """Dotted keys and their values, lists whole."""
    for name, value in scene.items():
        key = f"{prefix}{name}"
        if isinstance(value, dict):
            yield from leaves(value, key + ".")
        else:
            yield key, value


class Sources(Folder):
    def keys(self):
        return self.json_of("help", "keys")["keys"]

    def flags_of(self, scene):
        """The flags that say what the echo of a scene says."""
        flags = {key["key"]: key["flag"] for key in self.keys()}
        words = []
        for key, value in leaves(scene):
            flag = flags.get(key)
            if flag is None or value is None or isinstance(value, bool) or key in ("run.digits", "run.impacts", "run.method"):
                continue
            if key == "impact.impulse_ratio" and value == 0:  # so an echo says that there is no friction
                continue
            if key == "drop.speed" and (scene["drop"]["height"], scene["drop"]["clearance"]) != (None, None):
                continue
            text = "x".join(map(repr, value)) if isinstance(value, list) else str(value)
            words.append(f"{flag}={text}")
        return words

    def test_every_command_takes_a_file_the_name_of_a_case_and_flags_alone(self):
        shutil.copy(case("phone-damped"), self.path("mine.toml"))
        for command in FORMS:
            with self.subTest(command):
                drop = (command, *FORMS[command], "--impacts", "2")
                named, file = self.json_of(*drop, "phone-damped"), self.json_of(*drop, "mine.toml")
                echoed = {key for key, _ in leaves(named["scene"]) if not key.startswith("discrete_law.")}
                self.assertLessEqual(echoed - {"file"}, {key["key"] for key in self.keys()})
                self.assertEqual(named["scene"].pop("file"), "validation/cases/phone-damped.toml")
                self.assertEqual(file["scene"].pop("file"), "mine.toml")
                flags = self.json_of(*drop, *self.flags_of(named["scene"]))
                for part in ("scene",) if command == "plan" else named.keys() - {"times"}:  # a plan measures what a run takes
                    self.assertEqual((file[part], flags[part]), (named[part], named[part]), part)

    def test_a_name_that_is_neither_a_file_nor_a_case_gets_the_nearest_case_and_a_file_comes_before_a_case(self):
        for command in FORMS:
            self.refused("phone-dampd: neither a file nor a case; did you mean phone-damped?", command, *FORMS[command], "phone-dampd")
        self.write("phone-damped", "[drop]\nangle_deg = 7\n")
        self.assertEqual(self.json_of("sequence", "phone-damped")["scene"]["drop"]["angle_deg"], 7)

    def test_a_list_takes_blanks_and_what_is_allowed_is_told_as_a_flag_takes_it(self):
        box = ["sequence", "--angle", "10", "--body", "box", "--mass", "1", "--size"]
        self.assertEqual(self.json_of(*box, "0.1 x 0.05 x 0.01")["impacts"], self.json_of(*box, "0.1x0.05x0.01")["impacts"])
        self.refused("as in 0.106,0.044,0.019", *box, "0.1 x 0.05")
        self.refused("--probe: is for shock, sweep and report", *box, "0.1x0.05x0.01", "--probe", "a:0,0,0")

    def test_the_discrete_model_refuses_a_file_that_sweeps_its_angle_unless_one_is_given(self):
        self.write("swept.toml", "[body]\nshape = 'box'\nsize = [1, 0.1, 0.1]\n[sweep]\nangle_deg = { from = 10, to = 20, step = 5 }\n")
        self.refused("give --angle", "sequence", "swept.toml")
        self.assertEqual(self.json_of("sequence", "swept.toml", "--angle", "12")["scene"]["drop"]["angle_deg"], 12)

    def test_every_flag_of_simulate_that_is_a_key_s_is_in_its_help(self):
        for command in ("sequence", "simulate", "compare"):
            flags = set(re.findall(r"--[a-z][a-z-]*", self.run_program(command, "--help").stdout))
            for key in self.keys():
                if key["key"] == "run.until_rest":  # of the discrete model alone
                    self.assertEqual(key["flag"] in flags, command == "sequence")
                elif key["key"] in ("run.until", "run.at", "run.rate"):  # of the commands that tell where the body is
                    self.assertEqual(key["flag"] in flags, command != "compare")
                elif key["flag"] and command != "sequence":
                    self.assertIn(key["flag"], flags, command)

    def test_the_help_on_scenes_explains_every_flag_once_and_a_command_its_own_first(self):
        text = self.run_program("help", "scene").stdout
        explained = re.findall(r"^  (--[a-z][a-z-]*)", text, re.M)
        self.assertEqual(len(explained), len(set(explained)))
        self.assertEqual({key["flag"] for key in self.keys() if key["flag"]} - set(explained), set())
        shock = self.run_program("shock", "--help").stdout
        self.assertLess(shock.index("--probe NAME"), shock.index("scene explains them"))
        self.assertNotIn("--angle DEG", shock)
        self.refused("did you mean clatter sequence --angle", "--angle", "10")

    def test_the_file_runs_with_either_model(self):
        self.assertEqual(self.run_program("init", "new.toml").returncode, 0)
        self.refused("is there already", "init", "new.toml")
        self.refused("new.toml is the file", "init", "new.toml", "--output", "other.toml")
        for command in ("simulate", "sequence", "compare"):
            found = self.json_of(command, "new.toml", "--impacts", "1", "--digits", "3", status=(0,))
            self.assertEqual(found["scene"]["drop"]["angle_deg"], 10)

    def test_every_line_that_is_a_comment_is_a_setting_of_a_key_that_is_known(self):
        text = self.run_program("init").stdout
        lines = re.findall(r"^# ([a-z_.]+ = .*)$", text, re.MULTILINE)
        self.assertGreater(len(lines), 10)
        for line in lines:
            self.write("one.toml", text.replace("# " + line, line))
            said = self.run_program("simulate", "one.toml", "--impacts", "1", "--digits", "3").stderr
            self.assertNotRegex(said.lower(), "unknown|error while parsing", line)

    def test_its_probe_is_one_that_shock_takes(self):
        scene, probe = self.run_program("init").stdout.split("# [[probe]]")
        self.write("probe.toml", scene + "[[probe]]" + probe.replace("#   ", ""))
        shock = self.json_of("shock", "probe.toml", "--impacts", "1", "--digits", "3", "--no-sensitivity")
        self.assertEqual({impact["probe"] for impact in shock["impacts"]}, {"camera"})

    def test_each_key_has_its_line(self):
        tables = re.split(r"^\[(\w+)\]$", self.run_program("init").stdout, flags=re.MULTILINE)[1:]
        self.assertEqual({key["key"] for key in self.keys()}, {f"{table}.{name}" for table, text in zip(tables[::2], tables[1::2])
                                                               for name in re.findall(r"^(?:# )?([a-z_.]+) = ", text, re.MULTILINE)})
