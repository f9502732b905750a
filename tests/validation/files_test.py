#!/usr/bin/python3
"""What a run reads is not overwritten, what it writes appears whole or not at all, and nothing else stays behind."""

import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from waiting import sizes, until  # noqa: E402

PROGRAM = os.environ["CLATTER_PROGRAM"]
CASES = os.path.join(os.environ["CLATTER_ROOT"], "validation", "cases")
TETRAHEDRON = """solid t
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 1 0 vertex 1 0 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 0 1 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 1 vertex 0 1 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet
endsolid t
"""
MESHED = ("[drop]\nangle_deg = 10\n[body]\nshape = 'mesh'\nmass = 1\ninertia = [0.1, 0.1, 0.1]\ncentre = [0.25, 0.25, 0.25]\n"
          "mesh = { file = 'body.stl' }\n[ground]\nstiffness = 1e8\n[run]\nimpacts = 1\ndigits = 3\n")
LONG_RUN = ["angles", "--count", "50000000", "--format", "csv"]


def heed_hangups():
    """Also where the tests themselves are run under nohup."""
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("scene.toml", MESHED)
        self.write("body.stl", TETRAHEDRON)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def contents(self):
        """Names with what is below them: a link's target, a file's text."""
        found = {}
        for folder, folders, files in os.walk(self.folder):
            for name in folders + files:
                path = os.path.join(folder, name)
                found[path] = os.readlink(path) if os.path.islink(path) else self.read(path) if os.path.isfile(path) else None
        return found

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, *arguments], **{"capture_output": True, "text": True, "timeout": 3000, "cwd": self.folder,
                                                       **options})

    def refused(self, words, *arguments, status=2, **options):
        """One line that says so, and nothing has changed."""
        before = self.contents()
        done = self.run_program(*arguments, **options)
        self.assertEqual(done.returncode, status, (arguments, done.stderr))
        self.assertRegex(done.stderr, r"\Aclatter: [^\n]+\n\Z", arguments)
        self.assertIn(words, done.stderr, arguments)
        self.assertEqual(self.contents(), before, arguments)


class Overwriting(Folder):
    def spellings(self, name):
        """Other names of a file."""
        os.link(self.path(name), self.path("hard." + name))
        os.symlink(name, self.path("soft." + name))
        os.symlink("soft." + name, self.path("twice." + name))
        os.symlink(self.folder, self.path("folder." + name))
        return [name, "./" + name, self.path(name), f"folder.{name}/../{os.path.basename(self.folder)}/{name}", f"folder.{name}/{name}",
                ".//" + name, "hard." + name, "soft." + name, "twice." + name]

    def test_no_spelling_of_an_output_overwrites_the_scene_or_its_mesh(self):
        for name, words in (("scene.toml", "the scene file"), ("body.stl", "the mesh file")):
            for spelling in self.spellings(name):
                for command in ("simulate", "compare", "tradeoff", "plan", "sweep"):
                    self.refused("must be another file than " + words, command, "scene.toml", "--output", spelling)
                self.refused("must be another file than " + words, "simulate", "scene.toml", "--history", spelling)

    def test_no_spelling_of_a_picture_overwrites_the_scene(self):
        os.rename(self.path("scene.toml"), self.path("scene.svg"))
        for spelling in self.spellings("scene.svg"):
            if not spelling.endswith(".svg"):
                continue
            for command in ("simulate", "compare", "tradeoff"):
                self.refused("must be another file than the scene file", command, "scene.svg", "--plot", spelling)
        os.link(self.path("scene.svg"), self.path("p.gnuplot"))
        self.refused("--plot-script p.gnuplot: must be another file than the scene file", "simulate", "scene.svg", "--plot", "p.svg",
                     "--plot-script")

    def test_no_two_outputs_are_one_file_that_is_there_or_is_not(self):
        os.symlink(".", self.path("here"))
        os.symlink("new.svg", self.path("dangling.svg"))
        self.write("old.svg", "old")
        os.link(self.path("old.svg"), self.path("hard.svg"))
        for one, other in (("new.svg", "./new.svg"), ("new.svg", self.path("new.svg")), ("here/new.svg", "new.svg"),
                           ("dangling.svg", "new.svg"), ("new.svg", "dangling.svg"), ("hard.svg", "old.svg"), ("old.svg", "here/old.svg")):
            self.refused("--history", "simulate", "scene.toml", "--output", one, "--history", other)
            for command in (["simulate", "scene.toml"], ["sequence", "--angle", "10"], ["angles"], ["regimes"],
                            ["compare", "scene.toml"], ["tradeoff", "scene.toml"], ["extremes"]):
                self.refused("--plot", *command, "--output", one, "--plot", other)
            self.refused("--plot", "simulate", "scene.toml", "--history", one, "--plot", other)
            self.refused("--html", "verify", "--quick", "--output", one, "--html", other)
        os.symlink("p.gnuplot", self.path("p.svg"))
        self.refused("--plot-script", "sequence", "--angle", "10", "--plot", "p.svg", "--plot-script")

    def test_no_two_figures_are_one_file(self):
        os.mkdir(self.path("figures"))
        os.symlink("figure_08.csv", self.path("figures/figure_07.csv"))
        self.refused("must be another file", "figures", "--only", "7", "8", "--output", "figures")

    def test_the_part_of_a_sweep_does_not_overwrite_the_scene(self):
        for ending in (".part", ".part.digests"):
            shutil.copy(self.path("scene.toml"), self.path("s" + ending))
            self.refused("must be another file than the scene file", "sweep", "s" + ending, "--output", "s")
            self.refused("must be another file than the scene file", "sweep", "s" + ending, "--output", "./s")

    def test_an_output_that_cannot_be_written_is_found_before_anything_is(self):
        self.refused("--output no/out", "simulate", "scene.toml", "--history", "h.csv", "--output", "no/out")
        self.refused("--output scene.toml/out", "simulate", "scene.toml", "--history", "h.csv", "--output", "scene.toml/out")
        self.refused("--output .", "simulate", "scene.toml", "--history", "h.csv", "--output", ".")


class Links(Folder):
    def test_a_symbolic_link_is_written_through(self):
        """Its target is replaced whole, with the permissions that it had; the link stays one."""
        expected = self.run_program("sequence", "--angle", "10").stdout
        swept = self.run_program("sweep", os.path.join(CASES, "rod-at-1ms.toml"), "--model", "discrete").stdout
        os.mkdir(self.path("away"))
        for arguments, text in ((["sequence", "--angle", "10"], expected),
                                (["sweep", os.path.join(CASES, "rod-at-1ms.toml"), "--model", "discrete"], swept)):
            for target in ("away/there", "away/new", self.path("away/absolute")):
                self.write("away/there", "old")
                os.chmod(self.path("away/there"), 0o640)
                os.symlink(target, self.path("link"))
                os.symlink("link", self.path("link.of.link"))
                done = self.run_program(*arguments, "--output", "link.of.link")
                self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", ""))
                self.assertEqual(os.readlink(self.path("link")), target)
                self.assertEqual(self.read(target), text)
                if target == "away/there":
                    self.assertEqual(os.stat(self.path(target)).st_mode & 0o777, 0o640)
                os.remove(self.path("link"))
                os.remove(self.path("link.of.link"))
            self.assertEqual(sorted(os.listdir(self.path("away"))), ["absolute", "new", "there"])
            shutil.rmtree(self.path("away"))
            os.mkdir(self.path("away"))

    def test_links_without_end_are_refused(self):
        os.symlink("b", self.path("a"))
        os.symlink("a", self.path("b"))
        self.refused("--output a", "sequence", "--angle", "10", "--output", "a")

    def test_another_name_of_an_old_output_keeps_its_text(self):
        self.write("out", "old")
        os.link(self.path("out"), self.path("kept"))
        self.assertEqual(self.run_program("sequence", "--angle", "10", "--output", "out").returncode, 0)
        self.assertEqual(self.read("kept"), "old")


class Devices(Folder):
    COMMANDS = (["sequence", "--angle", "10"], ["angles", "--format", "csv"], ["explain", "2", "--angle", "10"],
                ["sweep", os.path.join(CASES, "rod-at-1ms.toml"), "--model", "discrete"])

    def test_devices_are_written_through(self):
        for command in self.COMMANDS:
            expected = self.run_program(*command).stdout
            before = self.contents()
            for device in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
                done = self.run_program(*command, "--output", device)
                self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", expected), (command, device))
            done = self.run_program(*command, "--output", "/dev/null")
            self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", ""), command)
            self.assertEqual(self.contents(), before)
            with open(self.path("out"), "w", encoding="utf-8") as out:  # what stands in an open file stays
                out.write("before\n")
                out.flush()
                self.run_program(*command, "--output", "/dev/stdout", stdout=out, capture_output=False)
            self.assertEqual(self.read("out"), "before\n" + expected)
            os.remove(self.path("out"))

    def test_a_fifo_is_written_through(self):
        os.mkfifo(self.path("fifo"))
        for command in self.COMMANDS:
            texts = []
            reader = threading.Thread(target=lambda: texts.append(self.read("fifo")))
            reader.start()
            done = self.run_program(*command, "--output", "fifo")
            reader.join()
            self.assertEqual((done.returncode, done.stderr, texts[0]), (0, "", self.run_program(*command).stdout))
        self.assertEqual(sorted(os.listdir(self.folder)), ["body.stl", "fifo", "scene.toml"])

    def test_a_full_device_is_one_line(self):
        for command in self.COMMANDS:
            self.refused("--output /dev/full: cannot be written (No space left on device)", *command, "--output", "/dev/full")
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = self.run_program(*command, stdout=full, stderr=subprocess.PIPE, capture_output=False)
            self.assertEqual((done.returncode, done.stderr),
                             (3, "clatter: standard output: cannot be written (No space left on device)\n"))
        self.refused("--history /dev/full", "simulate", "scene.toml", "--history", "/dev/full")


class FullDisk(Folder):
    """A file that may not grow beyond a size stands for a disk that is full."""

    def test_it_is_one_line_and_leaves_nothing(self):
        for size in (0, 1, 100):
            def limit(size=size):
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
            for option, command in (("--output", ["angles", "--format", "csv"]), ("--output", ["sequence", "--angle", "10"]),
                                    ("--history", ["simulate", "scene.toml"]),
                                    ("--output", ["sweep", os.path.join(CASES, "rod-at-1ms.toml"), "--model", "discrete"])):
                self.refused("File too large", *command, option, "out", preexec_fn=limit)
                self.write("out", "x")
                self.refused("File too large", *command, option, "out", preexec_fn=limit)
                os.remove(self.path("out"))

    def test_a_sweep_goes_on_when_there_is_room_again(self):
        scene = os.path.join(CASES, "rod-at-1ms.toml")
        command = ["sweep", scene, "--model", "discrete", "--set", "drop.angle_deg=0.001:60:0.001"]
        whole = self.run_program(*command).stdout
        done = self.run_program(*command, "--output", "out",
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, 2_000_000)))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"\Aclatter: --output out: out.part cannot be written [^\n]+\n\Z")
        done = self.run_program(*command, "--output", "out")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.read("out"), whole)
        self.assertEqual(sorted(os.listdir(self.folder)), ["body.stl", "out", "scene.toml"])


class Names(Folder):
    def test_a_name_as_long_as_names_can_be_is_written(self):
        name = "x" * os.pathconf(self.folder, "PC_NAME_MAX")
        self.assertEqual(self.run_program("sequence", "--angle", "10", "--output", name).returncode, 0)
        self.assertIn("clatter", self.read(name))

    def test_a_longer_one_is_one_line_before_the_run(self):
        for length in (os.pathconf(self.folder, "PC_NAME_MAX") + 1, 5000, 100_000):
            name = "x" * length
            for option, command in (("--output", ["sequence", "--angle", "10"]), ("--history", ["simulate", "scene.toml"]),
                                    ("--output", ["sweep", "scene.toml"]), ("--output", ["figures", "--only", "7"]),
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
            with open(name + b".out", encoding="utf-8") as file:
                self.assertIn("continuous", file.read())


class Streams(Folder):
    def closed(self, redirection, *arguments):
        return subprocess.run(["/bin/bash", "-c", 'exec "$0" "$@" ' + redirection, PROGRAM, *arguments], cwd=self.folder, text=True,
                              capture_output=True, timeout=3000, check=False)

    def test_a_closed_or_full_stderr_changes_neither_output_nor_status(self):
        for redirection in ("2>&-", "2>/dev/full"):
            self.assertEqual(self.closed(redirection, "sequence", "--angle", "10").stdout, self.run_program("sequence", "--angle", "10").stdout)
            for arguments, status in ((["sequence", "--angle", "91"], 2), (["sequence", "--angle", "63.4", "--impulse-ratio", "1.5"], 4)):
                self.assertEqual(self.closed(redirection, *arguments).returncode, status, redirection)
            # No file has got the number of stderr, and words for it.
            self.assertEqual(self.closed(redirection, "simulate", "scene.toml", "--output", "out", "--history", "h").returncode, 0)
            self.assertEqual(self.read("out"), self.run_program("simulate", "scene.toml").stdout)

    def test_a_closed_stdout_is_one_line_where_there_is_something_to_print(self):
        for arguments in (["sequence", "--angle", "10"], ["--version"], ["--help"], ["man"], ["completion", "bash"],
                          ["sweep", "scene.toml"], ["demo", "--port", "65535"]):
            done = self.closed(">&-", *arguments)
            self.assertEqual((done.returncode, done.stderr), (3, "clatter: standard output: cannot be written (Bad file descriptor)\n"),
                             arguments)
        done = self.closed(">&-", "simulate", "scene.toml", "--output", "out", "--history", "h")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.read("out"), self.run_program("simulate", "scene.toml").stdout)

    def test_all_streams_closed_still_writes_the_file(self):
        self.assertEqual(self.closed("<&- >&- 2>&-", "sequence", "--angle", "10", "--output", "out").returncode, 0)
        self.assertEqual(self.read("out"), self.run_program("sequence", "--angle", "10").stdout)

    def test_a_reader_that_leaves_early_leaves_no_litter(self):
        with subprocess.Popen([PROGRAM, *LONG_RUN, "--plot", "p.svg", "--plot-script"], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as process:
            process.stdout.readline()
            process.stdout.close()
            self.assertEqual(process.stderr.read(), b"")
        self.assertEqual(process.returncode, 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["body.stl", "scene.toml"])


class Signals(Folder):
    def growing(self):
        """Size of the largest file that has no name yet."""
        return max((size for name, size in sizes(self.folder).items() if name.startswith(".clatter-")), default=0)

    def test_each_ends_the_run_with_130_and_leaves_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with subprocess.Popen([PROGRAM, *LONG_RUN, "--output", "out", "--plot", "p.svg", "--plot-script"], cwd=self.folder,
                                  stderr=subprocess.DEVNULL, preexec_fn=heed_hangups) as process:
                until(self.growing, process)
                process.send_signal(number)
            self.assertEqual(process.returncode, 130, number)
            self.assertEqual(sorted(os.listdir(self.folder)), ["body.stl", "scene.toml"], number)

    def test_nohup_keeps_a_run_going(self):
        with subprocess.Popen([PROGRAM, *LONG_RUN, "--output", "out"], cwd=self.folder,
                              preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)) as process:
            until(self.growing, process)
            process.send_signal(signal.SIGHUP)
            size = self.growing()
            until(lambda: self.growing() > size + 10_000_000, process)
            process.send_signal(signal.SIGTERM)
        self.assertEqual(process.returncode, 130)

    def test_a_signal_while_gnuplot_draws_leaves_no_file_of_its_own(self):
        """gnuplot's stand-in waits at a FIFO for the signal to be over."""
        os.mkdir(self.path("bin"))
        os.mkdir(self.path("tmp"))
        os.mkfifo(self.path("wait"))
        self.write("bin/gnuplot", f"#!/bin/bash\ntouch {self.path('drawing')}\nread <{self.path('wait')}\n")
        os.chmod(self.path("bin/gnuplot"), 0o755)
        environment = {**os.environ, "PATH": self.path("bin") + ":" + os.environ["PATH"], "TMPDIR": self.path("tmp")}
        with subprocess.Popen([PROGRAM, "sequence", "--angle", "10", "--plot", "p.svg"], cwd=self.folder, env=environment) as process:
            until(lambda: os.path.exists(self.path("drawing")), process)
            process.send_signal(signal.SIGTERM)
        with open(self.path("wait"), "w", encoding="ascii"):
            pass
        self.assertEqual(process.returncode, 130)
        self.assertEqual(os.listdir(self.path("tmp")), [])
        self.assertEqual([name for name in os.listdir(self.folder) if "clatter" in name], [])


if __name__ == "__main__":
    unittest.main()
