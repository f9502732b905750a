# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run reads, or has written, is not overwritten by whatever name."""

import itertools
import os
import shutil
import subprocess
from pathlib import Path

from run_folder import PROGRAM, ROOT, Folder, case

SWEEP = ["sweep", "rod-at-1ms", "--model", "discrete"]


class Overwriting(Folder):
    def spellings(self, name):
        """Other names of a file."""
        os.link(self.path(name), self.path("hard." + name))
        os.symlink(name, self.path("soft." + name))
        os.symlink("soft." + name, self.path("twice." + name))
        os.symlink(self.folder, self.path("folder." + name))
        return [name, "./" + name, self.path(name), f"folder.{name}/../{os.path.basename(self.folder)}/{name}", f"folder.{name}/{name}",
                ".//" + name, "hard." + name, "soft." + name, "twice." + name]

    def test_no_spelling_of_an_output_overwrites_what_is_read(self):
        """A scene, its mesh, a file to score, what was tracked."""
        self.write("run.csv", "# problem: rod-10\nt,place,Pn,Pt,V,Omega\n0,a,0.5,0,0,1\n")
        shutil.copy(case("rod-10"), self.path("rod.toml"))
        for name in ("sq.csv", "sq.toml", "other.toml", "more.csv"):
            shutil.copy(os.path.join(ROOT, "validation/measured/square-drops" + os.path.splitext(name)[1]), self.path(name))
        scenes = [*(f"{command} scene.toml --output" for command in ("simulate", "compare", "plan --tradeoff", "plan", "sweep", "sequence", "explain 1")),
                  "simulate scene.toml --history"]
        for name, commands in {"scene.toml": scenes, "body.stl": scenes, "sq.toml": ["measured fit sq.csv --output"],
                               "run.csv": ["benchmark score run.csv --output", "compare rod.toml --against run.csv --output"]}.items():
            for spelling, command in itertools.product(self.spellings(name), commands):
                self.refused(f"must be another file than {name}, which is read", *command.split(), spelling)
        for command in ("fit sq.csv --output sq.csv", "fit sq.csv --body other.toml --output other.toml",
                        "score sq.csv --fit-from more.csv --output more.csv"):
            self.refused("which is read", "measured", *command.split())

    def test_a_scene_to_begin_with_takes_the_place_of_no_file(self):
        for name in ("scene.toml", "body.stl"):
            for spelling in self.spellings(name):
                self.refused("is there already", "init", "--output", spelling)
        self.assertEqual(self.run_program("init", "--output", "new.toml").returncode, 0)
        self.assertEqual(self.run_program("init", "--output", "/dev/stdout").stdout, self.read("new.toml"))

    def test_no_spelling_of_a_picture_overwrites_the_scene(self):
        os.rename(self.path("scene.toml"), self.path("scene.svg"))
        for spelling in self.spellings("scene.svg"):
            for command in ("simulate", "compare", "tradeoff"):
                self.refused("must be another file than scene.svg, which is read", command, "scene.svg", "--plot", spelling)
        os.link(self.path("scene.svg"), self.path("p.gnuplot"))
        self.refused("--plot-script p.gnuplot: must be another file than scene.svg, which is read", "simulate", "scene.svg", "--plot", "p.svg",
                     "--plot-script")

    def test_no_two_outputs_are_one_file_that_is_there_or_is_not(self):
        os.symlink(".", self.path("here"))
        os.symlink("new.svg", self.path("dangling.svg"))
        self.write("old.svg", "old")
        os.link(self.path("old.svg"), self.path("hard.svg"))
        for one, other in (("new.svg", "./new.svg"), ("new.svg", self.path("new.svg")), ("here/new.svg", "new.svg"),
                           ("dangling.svg", "new.svg"), ("new.svg", "dangling.svg"), ("hard.svg", "old.svg"), ("old.svg", "here/old.svg")):
            self.refused("--history", "simulate", "scene.toml", "--output", one, "--history", other)
            for command in (["simulate", "scene.toml"], ["sequence", "--angle", "10"], ["angles"], ["angles", "--regimes"],
                            ["compare", "scene.toml"], ["plan", "--tradeoff", "scene.toml"], ["verify", "--extremes"]):
                self.refused("--plot", *command, "--output", one, "--plot", other)
            self.refused("--plot", "simulate", "scene.toml", "--history", one, "--plot", other)
            self.refused("--html", "verify", "--quick", "--output", one, "--html", other)
        os.symlink("p.gnuplot", self.path("p.svg"))
        self.refused("--plot-script", "sequence", "--angle", "10", "--plot", "p.svg", "--plot-script")

    def test_no_two_figures_are_one_file(self):
        os.mkdir(self.path("figures"))
        os.symlink("figure_08.csv", self.path("figures/figure_07.csv"))
        self.refused("must be another file", "verify", "--figures", "--only", "7", "8", "--output", "figures")

    def test_the_part_of_a_sweep_does_not_overwrite_the_scene(self):
        for ending, output in itertools.product((".part", ".part.digests"), ("s", "./s")):
            shutil.copy(self.path("scene.toml"), self.path("s" + ending))
            self.refused("which is read", "sweep", "s" + ending, "--output", output)

    def test_an_output_that_cannot_be_written_is_found_before_anything_is(self):
        for output in ("no/out", "scene.toml/out", "."):
            self.refused("--output " + output, "simulate", "scene.toml", "--history", "h.csv", "--output", output)

    def test_a_symbolic_link_is_written_through(self):
        """Its target is replaced whole, with the permissions that it had; the link stays one."""
        for arguments, again in ((["sequence", "--angle", "10"], []), (SWEEP, ["--restart"])):
            os.mkdir(self.path("away"))
            text = self.run_program(*arguments).stdout
            for target in ("away/there", "away/new", self.path("away/absolute")):
                self.write("away/there", "old")
                os.chmod(self.path("away/there"), 0o640)
                os.symlink(target, self.path("link"))
                os.symlink("link", self.path("link.of.link"))
                done = self.run_program(*arguments, *again, "--output", "link.of.link")
                self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", ""))
                self.assertEqual(os.readlink(self.path("link")), target)
                self.assertEqual(self.read(target), text)
                if target == "away/there":
                    self.assertEqual(os.stat(self.path(target)).st_mode & 0o777, 0o640)
                os.remove(self.path("link"))
                os.remove(self.path("link.of.link"))
            self.assertEqual(sorted(os.listdir(self.path("away"))), ["absolute", "new", "there"])
            shutil.rmtree(self.path("away"))

    def test_links_without_end_are_refused_and_another_name_of_an_old_output_keeps_its_text(self):
        for link, target in (("a", "b"), ("b", "a")):
            os.symlink(target, self.path(link))
        self.refused("--output a", "sequence", "--angle", "10", "--output", "a")
        self.write("out", "old")
        os.link(self.path("out"), self.path("kept"))
        self.assertEqual(self.run_program("sequence", "--angle", "10", "--output", "out").returncode, 0)
        self.assertEqual(self.read("kept"), "old")

    def test_a_name_as_long_as_names_can_be_is_written_and_a_longer_one_is_one_line_before_the_run(self):
        longest = os.pathconf(self.folder, "PC_NAME_MAX")
        self.assertEqual(self.run_program("sequence", "--angle", "10", "--output", "x" * longest).returncode, 0)
        self.assertIn("clatter", self.read("x" * longest))
        for length in (longest + 1, 5000, 100_000):
            name = "x" * length
            for option, command in (("--output", ["sequence", "--angle", "10"]), ("--history", ["simulate", "scene.toml"]),
                                    ("--output", ["sweep", "scene.toml"]), ("--output", ["verify", "--figures", "--only", "7"]),
                                    ("--html", ["verify", "--quick"])):
                self.refused(option, *command, option, name)
            self.refused("--plot", "sequence", "--angle", "10", "--plot", name + ".svg")
        self.refused("out.part", "sweep", "scene.toml", "--output", "y" * 240 + "out")  # FILE.part.digests is longer

    def test_a_name_of_any_bytes_is_read_and_written(self):
        name = os.fsencode(self.folder) + b"/s\xff\xc3(\n'.toml"
        shutil.copy(self.path("scene.toml"), name)
        for form in ("table", "csv", "json"):
            done = subprocess.run([PROGRAM, "simulate", name, "--output", name + b".out", "--history", name + b".csv", "--format", form],
                                  capture_output=True, timeout=3000, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            self.assertIn("continuous", Path(os.fsdecode(name + b".out")).read_text(encoding="utf-8"))
