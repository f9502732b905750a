# SPDX-License-Identifier: GPL-3.0-or-later
"""The copy of the source in which faults are tried, and what of it a fault changes."""

import collections
import concurrent.futures
import contextlib
import functools
import itertools
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
# Two build the project themselves, and the third fails with any fault.
LEFT_OUT = {"launcher_test", "install.packages_test", "seeded_faults.places"}
TEST_SECONDS = 60  # or four times what the slowest of the tests takes without a fault, if that is known
FIRST_SECONDS = 2400
VERIFY_SECONDS = 600
CONFIGURE = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1",
             "-DCLATTER_TESTS=ON", "-DCLATTER_PYTHON=ON", "-DCLATTER_BENCHMARKS=OFF", "-DCLATTER_GMSH=OFF",
             "-DCLATTER_UNITY_BUILD=ON", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"]
if shutil.which("ccache"):  # it keeps the objects of the files without their faults
    CONFIGURE.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    os.environ.setdefault("CCACHE_SLOPPINESS", "pch_defines,time_macros")
LINKED = re.compile(r"^(?:LOAD )?(?:(\S+\.a)\()?(\S+?\.o)\)?$", re.MULTILINE)
PASSED = re.compile(r"^ *\d+/\d+ Test +#\d+: (\S+) .* Passed +([\d.]+) sec", re.MULTILINE)
FAILED = re.compile(r"^ *\d+/\d+ Test +#\d+: (\S+) .*?\*\*\*(?!Skipped|Not Run)(\w+)", re.MULTILINE)
CASE = re.compile(r"^(\w+)\*$", re.MULTILINE)  # or a whole suite
NOTICED = re.compile(r"(?:fatal )?error: in \"|^(?:FAIL|ERROR): ")  # first lines of a failure of Boost.Test and unittest


class Refused(Exception):
    """The campaign cannot go on; the text says why."""


class NotCompiled(Exception):
    """With its fault; the text names the file that says why.  Such a fault tries nothing."""


def say(text):
    print(text, file=sys.stderr, flush=True)


class Processes:
    """Commands that run now, each of which leads a group: on an interrupt all end together with what they started."""

    def __init__(self):
        self.leaders = set()
        self.lock = threading.Lock()
        self.ended = False

    @contextlib.contextmanager
    def start(self, command, **options):
        with self.lock:
            if self.ended:
                raise KeyboardInterrupt
            process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                       errors="replace", stdin=subprocess.DEVNULL, start_new_session=True, **options)
            self.leaders.add(process.pid)
        try:
            with process:
                try:
                    yield process
                finally:
                    end_group(process.pid)
        finally:
            self.leaders.discard(process.pid)

    def end_all(self):
        with self.lock:
            self.ended = True
            for leader in list(self.leaders):
                end_group(leader)


PROCESSES = Processes()


def run(command, timeout=None, **options):
    """Output and status of a command."""
    with PROCESSES.start(command, **options) as process:
        output = process.communicate(timeout=timeout)[0]
    return output, process.returncode


def end_group(leader):
    try:
        os.killpg(leader, signal.SIGKILL)
    except ProcessLookupError:
        pass


@dataclass
class Test:
    name: str
    command: list
    environment: dict
    folder: str
    target: str  # what is built for it
    executable: str = ""  # what of that a fault in C++ changes; none if it is more than one file
    parts: tuple = ((),)  # options of the runs that make it up

    def is_in_cpp(self):
        return self.executable == f"tests/{self.name}"

    def is_unittest(self):
        return self.command[-1].endswith("_test.py")

    def measure(self):
        """Seconds without a fault.  Later the quickest cases come first, so that a fault is noticed early, of a test in C++:
        these are run one by one, but for those that take a second together."""
        parts = self.parts
        if self.is_in_cpp():
            parts = [(f"--run_test={name}",) for name in CASE.findall(run([*self.command, "--list_content"])[0])]
        seconds = {}
        for part in parts:
            start = time.monotonic()
            if self.part_fails(part, FIRST_SECONDS):
                raise Refused(f"{' '.join([self.name, *part])} fails without a fault")
            seconds[part] = time.monotonic() - start
        ordered = sorted(seconds, key=seconds.get)
        quick = sum(total <= 1 for total in itertools.accumulate(map(seconds.get, ordered)))
        self.parts = [sum(ordered[:quick], ())] * (quick > 0) + ordered[quick:]
        return sum(seconds.values())

    def fails(self, limit, executables):
        """How: empty if it passes.  `executables`: what to run instead, with another path, of what was built."""
        return next(filter(None, (self.part_fails(part, limit, executables) for part in self.parts)), "")

    def part_fails(self, part, limit, executables=None):
        def replaced(text):
            return functools.reduce(lambda text, paths: text.replace(*paths), (executables or {}).items(), text)

        environment = {**os.environ, **{key: replaced(value) for key, value in self.environment.items()}}
        command = [*map(replaced, self.command), *part]
        if self.is_unittest():
            command.insert(-1, "--failfast")
        if self.is_in_cpp():
            command.append("--log_sink=stderr")  # at once, since no more is read once it has failed
        with PROCESSES.start(command, cwd=self.folder, env=environment) as process:
            timer = threading.Timer(limit, end_group, [process.pid])
            timer.start()
            try:
                noticed = any(NOTICED.search(line) for line in process.stdout)
                status = 1 if noticed else process.wait()
            finally:
                timer.cancel()
        if status == -signal.SIGKILL:
            return f"{self.name} (no end)"
        return self.name if status else ""


class Campaign:
    """A build without faults, and what the tests in it are made of.  `built`: a build of the source itself, which is not
    changed, so that all faults must be judged apart; else one of a copy is made."""

    def __init__(self, work, jobs, built=None):
        self.of_a_copy = built is None
        self.source = work / "source" if self.of_a_copy else ROOT
        self.build_folder = work / "build" if self.of_a_copy else built.resolve()
        self.apart = work / "apart"
        self.logs = work / "logs"
        self.jobs = jobs
        self.tests = {}
        self.read_by = {}  # of each object: the files of the source that it is made of
        self.commands = {}  # of each object: the command that makes it, and its source
        self.linked = {}  # of each executable: its objects, as the map of the linker has them
        self.seconds = {}  # of each test without a fault
        self.locks = collections.defaultdict(threading.Lock)  # of each test, while these are measured

    def prepare(self, faults):
        self.logs.mkdir(parents=True, exist_ok=True)
        if self.of_a_copy:
            self.copy_source()
            self.configure()
        self.list_tests()
        unnamed = [fault.id for fault in faults if not self.likely(fault)]
        if unnamed:
            raise Refused(f"no test is likely to notice {', '.join(unnamed)}")
        likely = [test for fault in faults for test in self.likely(fault)]
        output, status = self.build({test.target for test in likely})
        if status:
            raise Refused(f"the build failed without a fault:\n{output}")
        self.read_objects({test.executable for test in likely} - {""})
        others = [fault.id for fault in faults if not self.is_judged_apart(fault) or not self.is_said_apart(fault)]
        if others and not self.of_a_copy:  # a fault must not come into the source itself
            raise Refused(f"in a copy alone can be judged {', '.join(others)}")

    def configure(self):
        say("building without a fault ...")
        output, status = run(["cmake", "-S", self.source, "-B", self.build_folder, *CONFIGURE])
        if status:
            raise Refused(f"cmake failed:\n{output}")

    def copy_source(self):
        """The tracked files as they are now; those that have not changed keep their build.  Also after an interrupt."""
        if not self.of_a_copy:
            return
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True, text=True)
        if listed.returncode:
            raise Refused(f"git does not list the source:\n{listed.stderr}")
        files = {name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file()}
        for old in [path for path in self.source.rglob("*") if path.is_file()]:
            if str(old.relative_to(self.source)) not in files:
                old.unlink()
        for name in sorted(files):
            copy_if_changed(ROOT / name, self.source / name)

    def list_tests(self):
        output, status = run(["ctest", "--test-dir", self.build_folder, "--show-only=json-v1"])
        if status:
            raise Refused(f"ctest failed:\n{output}")
        listed = [self.read_test(test) for test in json.loads(output)["tests"] if test["name"] not in LEFT_OUT]
        self.tests = {test.name: test for test in listed}

    def read_test(self, test):
        """A C++ test, which has no command before it is built, is a target of its own name; scripts run the program."""
        properties = {one["name"]: one["value"] for one in test["properties"]}
        environment = dict(setting.split("=", 1) for setting in properties.get("ENVIRONMENT", []))
        name, program = test["name"], self.build_folder / "tests" / test["name"]
        command = test.get("command") or [str(program), "--color_output=no"]
        made = functools.partial(Test, name, command, environment, properties["WORKING_DIRECTORY"])
        if command[0] == str(program):
            return made(name, f"tests/{name}")
        if name.startswith(("install.", "notebooks-data.")):
            return made("all")
        reads_the_copy = "." not in name or "FIXTURES_REQUIRED" in properties  # its files, or the page built of them
        return made("clatter", "" if reads_the_copy else "validation/clatter")

    def build(self, targets):
        return run(["cmake", "--build", self.build_folder, "--parallel", str(self.jobs), "--target", *sorted(targets)])

    def read_objects(self, executables):
        output, status = run(["ninja", "-C", self.build_folder, "-t", "deps"])
        if status:
            raise Refused(f"ninja does not list what files are made of:\n{output}")
        for block in output.split("\n\n"):
            head, *files = block.splitlines() or [""]
            self.read_by[head.partition(":")[0]] = {
                os.path.relpath(os.path.join(self.build_folder, file.strip()), self.source) for file in files}
        for entry in json.loads((self.build_folder / "compile_commands.json").read_text(encoding="utf-8")):
            words = shlex.split(entry["command"])
            self.commands[words[words.index("-o") + 1]] = words, entry["file"]
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            self.linked = dict(zip(executables, pool.map(self.objects_linked, executables)))

    def objects_linked(self, executable):
        """Those of the libraries too, which a map of the linker tells."""
        folder = self.apart / executable
        folder.mkdir(parents=True, exist_ok=True)
        self.link(executable, f" -Wl,-Map={shlex.quote(str(folder / 'map'))} -o {shlex.quote(str(folder / 'executable'))} ")
        said = (folder / "map").read_text(encoding="utf-8", errors="replace")
        shutil.rmtree(folder)
        return set(LINKED.findall(said))

    def link(self, executable, output, replaced=()):
        """As it is linked in the build, but for the output and the objects that this replaces."""
        commands, _ = run(["ninja", "-C", self.build_folder, "-t", "commands", executable])
        command = commands.splitlines()[-1]
        for made in replaced:
            command = command.replace(f" {made} ", " ")
        said, status = run(command.replace(f" -o {executable} ", output), shell=True, cwd=self.build_folder)
        if status:
            raise Refused(f"{executable} is not linked:\n{said}")

    def objects(self, executable, file):
        """Those of an executable that are made of this file; an archive's is any of its library with that name."""
        return [made for made, files in self.read_by.items() if file in files and made in self.commands and any(
            made == name or library and made.startswith(f"{Path(library).parent}/") and made.endswith(f"/{name}")
            for library, name in self.linked[executable])]

    def likely(self, fault):
        return [test for test in self.tests.values() if re.search(fault.tests, test.name)]

    def limit(self, test):
        """Seconds after which it is thought to have no end; it is run without a fault when this is first asked for."""
        with self.locks[test.name]:
            if test.name not in self.seconds:
                self.seconds[test.name] = test.measure()
        return max(TEST_SECONDS, 4 * self.seconds[test.name])

    def is_judged_apart(self, fault):
        """With objects and executables of its own; the others come into the copy, where nothing else is judged meanwhile."""
        return fault.file.endswith((".cpp", ".hpp")) and any(self.containing(fault))

    def containing(self, fault):
        return (test for test in self.likely(fault) if test.executable in self.linked and self.objects(test.executable, fault.file))

    def judge_apart(self, fault):
        """What notices it; None if that is not known before it is in the copy itself."""
        with FaultyFiles(self, fault) as faulty:
            for test in self.containing(fault):
                limit = self.limit(test)
                faulty.link(test.executable)
                if caught_by := test.fails(limit, faulty.executables):
                    return caught_by
        return "" if self.is_said_apart(fault) else None

    def is_said_apart(self, fault):
        """Whether no test of it needs the copy."""
        return all(test.executable in self.linked for test in self.likely(fault))

    def try_without_faults(self, faults):
        """The tests of faults in the copy, of which none may fail yet."""
        names = {test.name for fault in faults for test in self.likely(fault)} - self.seconds.keys()
        if not names:
            return
        say(f"running {len(names)} tests without a fault ...")
        failed, output = self.failing(names, "without-fault", ["--parallel", str(self.jobs)])
        if failed:
            raise Refused(f"{', '.join(failed)} fails without a fault:\n{output}")
        self.seconds |= {name: float(seconds) for name, seconds in PASSED.findall(output)}

    def judge_in_the_copy(self, fault):
        path = self.source / fault.file
        original = path.read_text(encoding="utf-8")
        try:
            path.write_text(fault.applied_to(original), encoding="utf-8")
            return self.caught_in_the_copy(fault)
        finally:
            path.write_text(original, encoding="utf-8")

    def caught_in_the_copy(self, fault):
        likely = self.likely(fault)
        self.check_compiled(fault, *self.build({test.target for test in likely}))
        names = [test.name for test in likely]
        failed, output = self.failing(names, fault.id)
        caught_by = [name for name in failed if name.split()[0] in names]
        self.check_compiled(fault, output, failed and not caught_by)  # what the tests need could not be made
        return next(iter(caught_by), "")

    def check_compiled(self, fault, output, status):
        if status:
            log = self.logs / f"{fault.id}.log"
            log.write_text(output, encoding="utf-8")
            raise NotCompiled(log)

    def failing(self, names, log, options=("--stop-on-failure",)):
        """Those of the tests that fail, and what was printed."""
        pattern = "^(" + "|".join(name.replace(".", r"\.") for name in names) + ")$"
        limit = max(TEST_SECONDS, *(4 * self.seconds.get(name, FIRST_SECONDS) for name in names))
        output, status = run(["ctest", "--test-dir", self.build_folder, "--tests-regex", pattern, "--no-tests=error",
                              "--timeout", f"{limit:.0f}", "--output-on-failure", *options])
        (self.logs / f"{log}.log").write_text(output, encoding="utf-8")
        failed = [name + (" (no end)" if how == "Timeout" else "") for name, how in FAILED.findall(output)]
        if status and not failed:
            raise Refused(f"ctest failed without naming a test:\n{output}")
        return failed, output


class FaultyFiles:
    """The objects and executables that a fault changes, in a folder of their own that goes when all is said."""

    def __init__(self, campaign, fault):
        self.campaign = campaign
        self.fault = fault
        self.folder = campaign.apart / fault.id
        self.objects = {}  # of each object in the build: the faulty one
        self.executables = {}  # of each path in the build: that of the faulty one

    def __enter__(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        path = self.folder / "source" / self.fault.file
        path.parent.mkdir(parents=True)
        path.write_text(self.fault.applied_to((self.campaign.source / self.fault.file).read_text(encoding="utf-8")),
                        encoding="utf-8")
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder)

    def link(self, executable):
        """Makes the faulty executable.  The linker takes the first definition of what is defined twice: that in the
        faulty objects, which stand before the libraries."""
        built = self.campaign.build_folder / executable
        if str(built) in self.executables:
            return
        changed = self.campaign.objects(executable, self.fault.file)
        if not changed:
            raise Refused(f"{self.fault.id}: {executable} contains nothing of {self.fault.file}")
        for made in changed:
            self.compile(made)
        target = self.folder / executable
        target.parent.mkdir(parents=True, exist_ok=True)
        objects = " ".join(shlex.quote(str(self.objects[made])) for made in changed)
        self.campaign.link(executable, f" -Wl,-z,muldefs -o {shlex.quote(str(target))} {objects} ", changed)
        for beside in built.parent.iterdir():  # what the program loads
            if beside.is_file() and not (target.parent / beside.name).exists():
                (target.parent / beside.name).symlink_to(beside)
        self.executables[str(built)] = str(target)

    def compile(self, made):
        if made in self.objects:
            return
        words, file = self.campaign.commands[made]
        # A source that others are compiled with is compiled by itself: in position-independent code they call what it
        # defines through its symbols.
        compiled = self.folder / "source" / self.fault.file if self.fault.file.endswith(".cpp") else file
        target = self.folder / "objects" / f"{len(self.objects)}.o"
        target.parent.mkdir(exist_ok=True)
        options = next(i for i, word in enumerate(words) if word.startswith("-"))
        command = [*words[:options], f"-I{self.folder / 'source'}", *words[options:], "-Wno-error"]
        command = [str({made: target, file: compiled}.get(word, word)) for word in command]
        self.campaign.check_compiled(self.fault, *run(command, cwd=self.campaign.build_folder))
        self.objects[made] = target


class VerifyCampaign(Campaign):
    """A fault is caught if each check of `clatter verify` that it is to turn red fails."""

    PROGRAM = "validation/clatter"

    def prepare(self, faults):
        super().prepare(faults)
        checks = {check for fault in faults for check in fault.turns_red.split()}
        if failing := checks - self.checks_that(True, checks, self.build_folder / self.PROGRAM):
            raise Refused(f"{' '.join(sorted(failing))} fail without a fault")

    def list_tests(self):
        self.tests = {"verify": Test("verify", [], {}, "", "clatter", self.PROGRAM)}

    def likely(self, fault):
        return list(self.tests.values())

    def checks_that(self, pass_, checks, program):
        """Those of the checks that pass, or fail; none if the program says nothing, since a crash is not their doing."""
        command = [program, "verify", "--format", "json", "--only", *sorted(checks)]
        try:
            said = json.loads(run(command, timeout=VERIFY_SECONDS)[0])["checks"]
        except (subprocess.TimeoutExpired, ValueError):
            return set()
        return {check["id"] for check in said if (check["verdict"] == "passed") == pass_}

    def judge_apart(self, fault):
        checks = set(fault.turns_red.split())
        with FaultyFiles(self, fault) as faulty:
            faulty.link(self.PROGRAM)
            missed = checks - self.checks_that(False, checks, faulty.folder / self.PROGRAM)
        if missed:
            say(f"{fault.id}: {' '.join(sorted(missed))} still pass")
        return "" if missed else fault.turns_red


def copy_if_changed(source, target):
    content = source.read_bytes()
    if target.is_file() and target.read_bytes() == content:
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(content)
    shutil.copymode(source, target)
