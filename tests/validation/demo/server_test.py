# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter demo`: its answers are the program's, and nobody but its own page can use it.

CLATTER_PROGRAM is the program.
"""

import json
import os
import re
import signal
import socket
import subprocess
import tempfile
import threading
import unittest
import urllib.parse
from pathlib import Path

from running_demo import JSON, PROGRAM, Demo, WithServer, free_port, printed


BOX = {"body": "box", "size": [0.10566, 0.04394, 0.01905]}
IN_WORDS = ["--body", "box", "--size", "0.10566x0.04394x0.01905"]


class Answers(WithServer):
    def test_they_are_what_the_program_prints(self):
        for path, arguments, command in (
                ("sequence", {"angle": 10, "gravity": 9.81, "restitution": 0.8}, ["sequence", "--angle", "10", "--gravity", "9.81", "--restitution", "0.8"]),
                ("sequence", {"angle": 12.5, "body": "box", "size": [0.10566, 0.04394, 0.01905], "friction": 0.1},
                 ["sequence", "--angle", "12.5", "--body", "box", "--size", "0.10566x0.04394x0.01905", "--friction", "0.1"]),
                ("angles", {"step": 10, "gravity_number": 0.1}, ["angles", "--step", "10", "--gravity-number", "0.1"]),
                ("explain", {"angle": 10, "impact": 2}, ["explain", "2", "--angle", "10"]),
                ("sequence", {"angle": 30, "tilt": 40, **BOX, "friction": 0.3}, ["sequence", "--angle", "30", "--tilt", "40", *IN_WORDS,
                                                                               "--friction", "0.3"]),
                ("sequence", {"orientation": 22, **BOX, "velocity": [0.1, 0.2, -1]}, ["sequence", "--orientation", "22", *IN_WORDS,
                                                                                      "--velocity", "0.1,0.2,-1.0"]),
                ("explain", {"attitude": [0.8, 0.36, -0.48, 0], **BOX, "gravity": 9.81, "impact": 2},
                 ["explain", "2", "--attitude", "0.8,0.36,-0.48,0", *IN_WORDS, "--gravity", "9.81"])):
            with self.subTest(path=path, arguments=arguments):
                status, headers, text = self.demo.post(f"/api/{path}", arguments)
                self.assertEqual((status, headers["Content-Type"]), (200, "application/json; charset=utf-8"))
                self.assertEqual(text, printed(*command))

    def test_simulations_and_comparisons_are_the_programs(self):
        with tempfile.TemporaryDirectory() as folder:
            scene, history = Path(folder) / "scene", Path(folder) / "history.csv"
            scene.write_text("", encoding="utf-8")
            flags = ["--angle", "20", "--stiffness", "1e9", "--damping", "1e7", "--impacts", "2", "--height", "1"]
            given = {"angle": 20, "stiffness": 1e9, "damping": 1e7, "impacts": 2, "height": 1}
            expected = json.loads(printed("simulate", str(scene), *flags, "--history", str(history)))
            answer = json.loads(self.demo.post("/api/simulate", {**given, "history": True})[2])
            columns = answer.pop("history")
            for scene_of in (expected["scene"], answer["scene"]):
                del scene_of["file"], scene_of["run"]["history"]
            self.assertEqual(answer, expected)
            rows = [line for line in history.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
            self.assertEqual(list(columns), rows[0].split(","))
            for name, column in zip(columns, zip(*(map(float, row.split(",")) for row in rows[1:]))):
                self.assertEqual(columns[name], list(column))
            expected = json.loads(printed("compare", str(scene), *flags))
            answer = json.loads(self.demo.post("/api/compare", given)[2])
            del expected["scene"]["file"], answer["scene"]["file"]
            self.assertEqual(answer, expected)

    def test_cases_are_the_scenes_that_come_with_the_program(self):
        cases = json.loads(self.demo.ask("GET", "/api/cases")[2])["cases"]
        self.assertEqual(cases["phone-damped"]["ground"]["damping"], 1e7)
        answer = json.loads(self.demo.post("/api/simulate", {"case": "phone-damped", "impacts": 1})[2])
        self.assertEqual(answer["scene"]["ground"], cases["phone-damped"]["ground"])

    def test_the_discrete_model_takes_the_cases_too_those_in_space_among_them(self):
        for case in ("phone-corner", "rod-10"):
            answer = json.loads(self.demo.post("/api/sequence", {"case": case, "friction": 0.2})[2])
            expected = json.loads(printed("sequence", case, "--friction", "0.2"))
            self.assertEqual(answer["impacts"], expected["impacts"])
            steps = json.loads(self.demo.post("/api/explain", {"case": case, "friction": 0.2, "impact": 1})[2])["steps"]
            self.assertEqual(steps, json.loads(printed("explain", "1", case, "--friction", "0.2"))["steps"])

    def test_two_hundred_at_once_are_all_right(self):
        angles = [5 + 0.25 * i for i in range(200)]
        answers = [None] * len(angles)

        def ask(index):
            answers[index] = self.demo.post("/api/sequence", {"angle": angles[index]})
        threads = [threading.Thread(target=ask, args=(index,)) for index in range(len(angles))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for angle, answer in zip(angles, answers):
            self.assertEqual(answer[0], 200)
            self.assertEqual(json.loads(answer[2])["scene"]["drop"]["angle_deg"], angle)
        self.assertEqual(answers[20][2], printed("sequence", "--angle", str(angles[20])))

    def test_two_hundred_may_wait_while_the_server_is_busy(self):
        """Stopped, it accepts nobody: whoever has no place in the queue is turned away or waits for seconds."""
        body = b'{"angle": 10}'
        request = (b"POST /api/sequence HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%s"
                   % (self.demo.port, len(body), body))
        waiting = []
        self.demo.process.send_signal(signal.SIGSTOP)
        try:
            for _ in range(200):
                waiting.append(socket.create_connection(("127.0.0.1", self.demo.port), 3000))
                waiting[-1].sendall(request)
        finally:
            self.demo.process.send_signal(signal.SIGCONT)
        for connection in waiting:
            connection.settimeout(3000)
            with connection, connection.makefile("rb") as answer:
                self.assertIn(b" 200 ", answer.readline())

    def test_the_page_holds_everything_itself(self):
        status, headers, text = self.demo.ask("GET", "/")
        self.assertEqual((status, headers["Content-Type"]), (200, "text/html; charset=utf-8"))
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        markup = re.sub(r"(<(script|style)[^>]*>).*?</\2>", r"\1", text, flags=re.DOTALL)
        self.assertLess(len(markup), 100_000)
        self.assertEqual(re.findall(r'<(?:script|link|img|iframe)[^>]+(?:src|href)="(?!data:)[^"]*"', markup), [])


class Refusals(WithServer):
    def test_bad_input_is_400_with_the_reason(self):
        for path, arguments, words in (
                ("sequence", {"angle": 95}, "angle '95': must be from 0 to 90 degrees"), ("sequence", {}, "angle: required"),
                ("sequence", {"angle": 10, "gravty": 1}, "did you mean gravity?"), ("sequence", {"angle": "nan"}, "angle 'nan'"),
                ("sequence", {"angle": {"a": 1}}, "angle: must be"), ("sequence", {"angle": 10, "impacts": 1000000}, "impacts 1000000"),
                ("sequence", {"angle": 10, "impulse_ratio": 0.1, "friction": 0.1}, "impulse_ratio 0.1 and friction 0.1"),
                ("angles", {"count": 1000000}, "count 1000000"), ("explain", {"angle": 10}, "impact ''"),
                ("simulate", {"angle": 10}, "ground.stiffness: required"), ("simulate", {"case": "phone-dampd"}, "case 'phone-dampd'"),
                ("simulate", {"case": "../cases/rod-45"}, "case '../cases/rod-45'"), ("simulate", {"case": "rod-sweep"}, "sweeps"),
                ("sequence", {"case": "phone-corer"}, "did you mean phone-corner?"), ("explain", {"case": "rod-friction-sweep", "impact": 1}, "must be left out here; give friction"),
                ("sequence", {"case": "../cases/rod-45"}, "case '../cases/rod-45'"),
                ("compare", {"angle": 10, "stiffness": -1}, "stiffness '-1'"),
                ("scene", {}, "scene file: drop.angle_deg: required"), ("scene", {"name": "a\nb", "text": "x"}, "scene file:1:"),
                ("scene", {"name": "my.toml", "text": "[drop]\nangle_deg = 95\n"}, "my.toml:2:13: drop.angle_deg = 95: must be"),
                ("scene", {"text": "[drop]\nangle_deg = 1\n[body]\nshape = 'mesh'\nmesh.file = '/etc/passwd'\n"}, "mesh"),
                ("file", {"angle": 10, "restitution": 2}, "restitution '2'"), ("file", {"angel": 10}, "did you mean angle?")):
            with self.subTest(path=path, arguments=arguments):
                self.refused(self.demo.post(f"/api/{path}", arguments), 400, words)
        for body in ("", "[1]", "{", "{\"angle\": 10} x", "\xff\xfe", "[" * 30000):
            with self.subTest(body=body[:20]):
                self.refused(self.demo.ask("POST", "/api/sequence", body.encode("latin-1"), JSON), 400, "JSON object")

    def test_outside_the_model_is_422(self):
        answer = self.demo.post("/api/sequence", {"angle": 63.434948822922, "impulse_ratio": 4 / 3})
        self.refused(answer, 422, "jam")
        self.assertEqual(json.loads(answer[2])["status"], 4)

    def test_no_argument_can_name_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            target = Path(folder) / "written.csv"
            for arguments in ({"history": str(target)}, {"body": "mesh", "file": "/etc/passwd"}, {"body": "mesh"}, {"output": str(target)},
                              {"body.mesh.file": "/etc/passwd"}, {"case": "/etc/passwd"}, {"text": "[run]\nhistory = 'x'"}):
                with self.subTest(arguments=arguments):
                    status, _, text = self.demo.post("/api/simulate", {"angle": 10, "stiffness": 1e9, **arguments})
                    self.assertNotIn("root:", text)
                    self.assertEqual(status, 200 if list(arguments) == ["history"] else 400)
            self.assertEqual(list(Path(folder).iterdir()), [])

    def test_other_paths_are_404(self):
        for path in ("/index.html", "/etc/passwd", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/api", "/api/", "//", "/api/sequence/"):
            with self.subTest(path=path):
                status, _, text = self.demo.ask("GET", path)
                self.assertIn(status, (404, 405))
                self.assertNotIn("root:", text)
        self.assertEqual(self.demo.post("/api/run", {})[0], 404)
        for target in (b"/\xff", b"/api/\xf6\xba", b"/api/sequence\xc3"):
            for method in (b"GET", b"POST"):
                self.assertRegex(self.demo.raw(b"%s %s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nContent-Type: application/json\r\n"
                                               b"Content-Length: 2\r\n\r\n{}" % (method, target, self.demo.port)), "40[045]")
        self.assertIn("404", self.demo.raw(b"GET /../../../etc/passwd HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n\r\n" % self.demo.port))

    def test_other_methods_are_405(self):
        self.assertEqual(self.demo.ask("GET", "/api/sequence")[0], 405)
        self.assertEqual(self.demo.ask("POST", "/", "{}", JSON)[0], 405)
        for method in ("PUT", "DELETE", "OPTIONS", "PATCH"):
            self.assertIn(self.demo.ask(method, "/")[0], (404, 405))

    def test_a_body_over_64_kib_is_413(self):
        self.assertEqual(self.demo.ask("POST", "/api/sequence", b" " * 65536, JSON)[0], 400)
        self.refused(self.demo.ask("POST", "/api/sequence", b" " * 65537, JSON), 413, "64 KiB")

    def test_a_body_of_another_type_is_415(self):
        self.refused(self.demo.ask("POST", "/api/sequence", "{}", {"Content-Type": "text/plain"}), 415, "application/json")

    def test_a_foreign_host_or_origin_is_403(self):
        own = f"127.0.0.1:{self.demo.port}"
        for headers in ({"Host": "clatter.example"}, {"Host": f"clatter.example:{self.demo.port}"}, {"Host": "127.0.0.1"},
                        {"Host": own, "Origin": "http://clatter.example"}, {"Host": own, "Origin": "null"},
                        {"Host": own, "Origin": f"https://{own}"}, {"Host": own, "Origin": f"http://{own}.example"}):
            with self.subTest(headers=headers):
                self.refused(self.demo.ask("GET", "/", None, headers), 403, "must be this server's own")
                self.refused(self.demo.post("/api/sequence", {"angle": 10}, **headers), 403, "must be this server's own")
        self.assertEqual(self.demo.post("/api/sequence", {"angle": 10}, Host=own, Origin=f"http://{own}")[0], 200)
        self.assertIn("403", self.demo.raw(b"GET / HTTP/1.0\r\n\r\n"))

    def test_it_listens_on_this_machine_alone(self):
        with open("/proc/net/tcp", encoding="ascii") as table:
            local = [line.split()[1] for line in table if line.split()[3] == "0A"]
        self.assertIn(f"0100007F:{self.demo.port:04X}", local)
        self.assertNotIn(f"00000000:{self.demo.port:04X}", local)


class Command(unittest.TestCase):
    def test_ctrl_c_ends_it_with_130(self):
        demo = Demo("--port", str(free_port()))
        status, out, err = demo.stop()
        self.assertEqual((status, out, err), (130, "", ""))

    def test_a_port_in_use_is_bad_input(self):
        demo = Demo("--port", str(free_port()))
        try:
            done = subprocess.run([PROGRAM, "demo", "--port", str(demo.port)], capture_output=True, text=True, timeout=3000)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(f"--port {demo.port}: is in use", done.stderr)
        finally:
            demo.stop()

    def test_bad_arguments_are_one_line(self):
        for arguments in (["--port", "0"], ["--port", "65536"], ["--scene", "rod"], ["--export", "/no/such/folder/x.html"],
                          ["--seconds", "0"], ["--seconds", "nan"], ["--export", "x.html", "--seconds", "1"],
                          ["--export", "x.html", "--scene", "rodd"], ["--export", "x.html", "--port", "8000"]):
            with self.subTest(arguments=arguments), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([PROGRAM, "demo", *arguments], capture_output=True, text=True, cwd=folder, timeout=3000)
                self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
                self.assertEqual(os.listdir(folder), [])

    def test_the_address_printed_gives_the_scene_given(self):
        """Its query holds the arguments that give the scene again."""
        for arguments in (["--angle", "20", "--height", "1", "--gravity", "9.81"], ["phone-damped", "--angle", "25"], ["phone-corner"],
                          ["--angle", "10", "--spin", "-1", "--tangential-velocity", "-0.5", "--friction", "0.1"],
                          ["--orientation", "20", *IN_WORDS, "--velocity", "0.1,0.2,-1", "--restitution", "0.5"]):
            with self.subTest(arguments=arguments):
                demo = Demo(*arguments)
                try:
                    query = dict(urllib.parse.parse_qsl(re.search(r"\?(\S+)", demo.line)[1]))
                    self.assertEqual(query.pop("given"), "1")
                    flags = [part for name, value in query.items() for part in ("--" + name.replace("_", "-"), value)]
                    model = "simulate" if "stiffness" in query else "sequence"
                    expected, answer = json.loads(printed(model, *arguments)), json.loads(printed(model, *flags))
                    self.assertEqual(answer["impacts"], expected["impacts"])
                finally:
                    demo.stop()
        for arguments, key in ((["phone-sweep"], "sweep"), (["--body", "mesh", "--angle", "10"], "mesh")):
            done = subprocess.run([PROGRAM, "demo", *arguments], capture_output=True, text=True, timeout=3000)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(key, done.stderr)

    def test_an_exported_copy_holds_its_answers_and_stays_small(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "copy.html"
            subprocess.run([PROGRAM, "demo", "--export", str(path)], check=True, timeout=3000)
            text = path.read_text(encoding="utf-8")
            self.assertLessEqual(path.stat().st_size, 2_000_000)
            data = json.loads(re.search(r'id="precomputed">(.*?)</script>', text, re.DOTALL)[1])
            rod = next(scene for scene in data["scenes"] if scene["name"] == "rod")
            mine = next(answer for key, answer in rod["answers"].items()
                        if key.startswith("sequence") and answer["scene"]["drop"]["angle_deg"] == 10)
            self.assertEqual(mine["impacts"], json.loads(printed("sequence", "--angle", "10"))["impacts"])


if __name__ == "__main__":
    unittest.main()
