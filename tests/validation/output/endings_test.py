# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run writes appears whole or not at all, wherever it goes and however it ends, and nothing else stays behind."""

import os
import resource
import signal
import subprocess
import threading

from run_folder import PROGRAM, Folder
from waiting import computing_seconds, sizes, until

LONG_RUN = ["angles", "--count", "50000000", "--format", "csv"]
SWEEP = ["sweep", "rod-at-1ms", "--model", "discrete"]


def hangups(action):
    """Also where the tests themselves are run under nohup."""
    return lambda: signal.signal(signal.SIGHUP, action)


def limited_to(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class Endings(Folder):
    COMMANDS = (["sequence", "--angle", "10"], ["angles", "--format", "csv"], ["explain", "2", "--angle", "10"], SWEEP)

    def others(self):
        """What a run has left beside its input."""
        return sorted({*os.listdir(self.folder)} - {"body.stl", "scene.toml"})

    def test_devices_and_standard_output_by_its_dash_are_written_through(self):
        for command in self.COMMANDS:
            expected = self.run_program(*command).stdout
            before = self.contents()
            for device in ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
                done = self.run_program(*command, "--output", device)
                self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", expected), (command, device))
            done = self.run_program(*command, "--output", "/dev/null")
            self.assertEqual((done.returncode, done.stderr, done.stdout, self.contents()), (0, "", "", before), command)
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
        self.assertEqual(self.others(), ["fifo"])

    def test_a_full_device_is_one_line(self):
        for command in self.COMMANDS:
            self.refused("--output /dev/full: cannot be written (No space left on device)", *command, "--output", "/dev/full")
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = self.run_program(*command, stdout=full, stderr=subprocess.PIPE, capture_output=False)
            self.assertEqual((done.returncode, done.stderr), (2, "clatter: standard output: cannot be written (No space left on device)\n"))
        self.refused("--history /dev/full", "simulate", "scene.toml", "--history", "/dev/full")

    def test_it_is_one_line_and_leaves_nothing(self):
        for size in (0, 1, 100):
            limit = limited_to(size)
            for option, command in (("--output", ["angles", "--format", "csv"]), ("--output", ["sequence", "--angle", "10"]),
                                    ("--history", ["simulate", "scene.toml"]), ("--output", [*SWEEP, "--restart"])):
                self.refused("File too large", *command, option, "out", preexec_fn=limit)
                self.write("out", "x")
                self.refused("File too large", *command, option, "out", preexec_fn=limit)
                os.remove(self.path("out"))

    def test_a_sweep_goes_on_when_there_is_room_again(self):
        command = [*SWEEP, "--set", "drop.angle_deg=0.001:60:0.001"]
        whole = self.run_program(*command).stdout
        done = self.run_program(*command, "--output", "out", preexec_fn=limited_to(2_000_000))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"\Aclatter: --output out: out.part cannot be written [^\n]+\n\Z")
        done = self.run_program(*command, "--output", "out")
        self.assertEqual((done.returncode, self.read("out"), self.others()), (0, whole, ["out"]))
        self.assertRegex(done.stderr, r"\Aclatter: goes on after \d+ of 60000 scenes\n\Z")

    def closed(self, redirection, *arguments):
        return subprocess.run(["/bin/bash", "-c", 'exec "$0" "$@" ' + redirection, PROGRAM, *arguments], cwd=self.folder, text=True,
                              capture_output=True, timeout=3000, check=False)

    def test_a_closed_or_full_stderr_changes_neither_output_nor_status(self):
        for redirection in ("2>&-", "2>/dev/full"):
            self.assertEqual(self.closed(redirection, "sequence", "--angle", "10").stdout, self.run_program("sequence", "--angle", "10").stdout)
            for arguments, status in ((["sequence", "--angle", "91"], 2), (["sequence", "--angle", "63.4", "--impulse-ratio", "1.5"], 4)):
                self.assertEqual(self.closed(redirection, *arguments).returncode, status, redirection)
            self.assertEqual(self.closed(redirection, "simulate", "scene.toml", "--output", "out", "--history", "h").returncode, 0)
            self.assertEqual(self.read("out"), self.run_program("simulate", "scene.toml").stdout)

    def test_no_file_gets_the_number_of_a_closed_stream_and_words_for_it(self):
        with subprocess.Popen(["/bin/bash", "-c", 'exec "$0" "$@" <&- 2>&-', PROGRAM, *LONG_RUN], cwd=self.folder,
                              stdout=subprocess.PIPE) as process:
            process.stdout.readline()
            self.assertEqual([os.readlink(f"/proc/{process.pid}/fd/{number}") for number in (0, 2)], ["/dev/null"] * 2)
            process.kill()

    def test_a_closed_stdout_is_one_line_where_there_is_something_to_print(self):
        for arguments in (["sequence", "--angle", "10"], ["--version"], ["--help"], ["man"], ["completion", "bash"],
                          ["sweep", "scene.toml"]):
            done = self.closed(">&-", *arguments)
            self.assertEqual((done.returncode, done.stderr), (2, "clatter: standard output: cannot be written (Bad file descriptor)\n"),
                             arguments)
        for redirection in (">&-", "<&- >&- 2>&-"):
            done = self.closed(redirection, "simulate", "scene.toml", "--output", "out", "--history", "h")
            self.assertEqual((done.returncode, done.stderr, self.read("out")), (0, "", self.run_program("simulate", "scene.toml").stdout))

    def test_a_reader_that_leaves_early_leaves_no_litter(self):
        with subprocess.Popen([PROGRAM, *LONG_RUN, "--plot", "p.svg", "--plot-script"], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as process:
            process.stdout.readline()
            process.stdout.close()
            self.assertEqual(process.stderr.read(), b"")
        self.assertEqual((process.returncode, self.others()), (0, []))

    def growing(self):
        """Size of the largest file that has no name yet."""
        return max((size for name, size in sizes(self.folder).items() if name.startswith(".clatter-")), default=0)

    def test_each_ends_the_run_with_130_and_leaves_nothing(self):
        for numbers in ((signal.SIGINT,), (signal.SIGTERM,), (signal.SIGHUP,), (signal.SIGTERM, signal.SIGINT)):  # the second does not wait
            with subprocess.Popen([PROGRAM, *LONG_RUN, "--output", "out", "--plot", "p.svg", "--plot-script"], cwd=self.folder,
                                  stderr=subprocess.DEVNULL, preexec_fn=hangups(signal.SIG_DFL)) as process:
                until(self.growing, process)
                for number in numbers:
                    process.send_signal(number)
            self.assertEqual((process.returncode, self.others()), (130, []), numbers)

    def test_an_interrupt_ends_stdout_with_whole_rows_and_their_number(self):
        for command, head in ((LONG_RUN, "theta"), ([*SWEEP, "--set", "drop.angle_deg=0.000001:60:0.000001"], "index,")):
            with subprocess.Popen([PROGRAM, *command], stdout=subprocess.PIPE, text=True) as process:
                lines = [process.stdout.readline() for _ in range(1000)]
                process.send_signal(signal.SIGINT)
                lines += process.stdout.read().splitlines(keepends=True)
            self.assertEqual(process.returncode, 130)
            rows = [line for line in lines if line[0].isdigit()]
            self.assertRegex(lines[-1], rf"^# interrupted after {len(rows)} of \d+ ")
            width = next(line for line in lines if line.startswith(head)).count(",")
            self.assertEqual({row.count(",") for row in rows}, {width})
            if head == "index,":
                self.assertEqual([int(row[:row.index(",")]) for row in rows], list(range(len(rows))))

    def test_a_table_of_an_interrupted_run_says_so(self):
        told = 0
        elastic = self.write("elastic.toml", "[drop]\nangle_deg = 10\n[world]\ngravity = 9.81\n[ground]\nstiffness = 1e9\n[run]\nimpacts = 100000\n"
                             "evaluation_limit = 1000000000\nerrors = false\namplification = false\n")  # it bounces on for a quarter of an hour
        for command in (["plan", "--tradeoff", "rod-45"], ["shock", "phone-damped", "--probe", "a:0.01,0,0", "--digits", "11"], ["simulate", elastic]):
            for seconds in (0.1, 0.2, 0.4):  # of computing; where it has ended by then nothing is to be said
                with subprocess.Popen([PROGRAM, *command], stdout=subprocess.PIPE, text=True) as process:
                    until(lambda: process.poll() is not None or computing_seconds(process.pid) >= seconds)
                    process.send_signal(signal.SIGINT)
                    out = process.stdout.read()
                if command[0] == "simulate" or process.returncode != 0 and out:
                    self.assertEqual((process.returncode, "interrupted: " in out), (130, True), out)
                    told += command[0] != "simulate"
        self.assertGreater(told, 0)

    def test_nohup_keeps_a_run_going(self):
        with subprocess.Popen([PROGRAM, *LONG_RUN, "--output", "out"], cwd=self.folder, preexec_fn=hangups(signal.SIG_IGN)) as process:
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
        self.write("wait", "")
        self.assertEqual(process.returncode, 130)
        self.assertEqual(os.listdir(self.path("tmp")), [])
        self.assertEqual([name for name in os.listdir(self.folder) if "clatter" in name], [])
