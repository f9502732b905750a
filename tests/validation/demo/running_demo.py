# SPDX-License-Identifier: GPL-3.0-or-later
"""A running `clatter demo`, for its tests.  CLATTER_PROGRAM is the program."""

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import unittest

PROGRAM = os.environ["CLATTER_PROGRAM"]
JSON = {"Content-Type": "application/json"}


class Demo:
    """A running server, on a port that was free."""

    def __init__(self, *arguments):
        # No answer that a test waits for is late, however busy the machine is.
        limit = [] if "--seconds" in arguments else ["--seconds", "80000"]
        self.process = subprocess.Popen([PROGRAM, "demo", *arguments, *limit], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL))  # also under nohup
        self.line = self.process.stdout.readline()
        self.port = int(re.search(r"127\.0\.0\.1:(\d+)/", self.line)[1])

    def ask(self, method, path, body=None, headers=None):
        """(status, headers, text)"""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=3000)
        try:
            connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read().decode()
        finally:
            connection.close()

    def post(self, path, arguments, **headers):
        return self.ask("POST", path, json.dumps(arguments), {**JSON, **headers})

    def raw(self, text):
        """The first line of the answer to bytes that no library would send."""
        with socket.create_connection(("127.0.0.1", self.port), 3000) as connection:
            connection.sendall(text)
            return connection.makefile("rb").readline().decode().strip()

    def send(self, path, arguments, end=b""):
        """A connection on which a request has been sent."""
        body = json.dumps(arguments).encode()
        connection = socket.create_connection(("127.0.0.1", self.port), 3000)
        connection.sendall(b"POST %s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%s%s"
                           % (path.encode(), self.port, len(body), body, end))
        return connection

    def computing(self):
        """Processes that compute answers."""
        with open(f"/proc/{self.process.pid}/task/{self.process.pid}/children", encoding="ascii") as file:
            return [int(pid) for pid in file.read().split()]

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        out, err = self.process.communicate(timeout=3000)
        return self.process.returncode, out, err


def received(connection):
    """All that comes until the other side closes."""
    text = b""
    try:
        while part := connection.recv(65536):
            text += part
    except ConnectionResetError:
        pass
    return text


def printed(*arguments):
    return subprocess.run([PROGRAM, *arguments, "--format", "json"], capture_output=True, text=True, check=True).stdout


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class WithServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.demo = Demo("--port", str(free_port()))

    @classmethod
    def tearDownClass(cls):
        cls.status = cls.demo.stop()

    def refused(self, answer, status, words):
        self.assertEqual(answer[0], status, answer[2])
        error = json.loads(answer[2])["error"]
        self.assertIn(words, error)
        self.assertNotIn("\n", error)
