# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter demo` and clients that are slow, idle, gone or no clients at all.

CLATTER_PROGRAM is the program.
"""

import contextlib
import json
import os
import select
import signal
import socket
import unittest

from running_demo import Demo, WithServer, free_port, printed, received

from waiting import until

# A step so short that the contact would take for ever; the limit of force evaluations ends it after many seconds.
LONG = {"case": "rod-45", "method": "tvd-rk3", "step": 1e-12, "sectors": 128}


# Refused once the body is made: an answer of one piece.
SHORT = {"angle": 10, "stiffness": 1e8, "height": 0.001}


def process_state(pid):
    """One letter: T stopped, Z ended and not yet waited for; None: there is no such process."""
    try:
        with open(f"/proc/{pid}/stat", encoding="ascii", errors="replace") as file:
            return file.read().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return None


class Patience(unittest.TestCase):
    """What clients do to the server does not keep it from the others."""

    def setUp(self, *arguments):
        self.demo = Demo("--port", str(free_port()), *arguments)
        self.addCleanup(self.demo.process.stdout.close)
        self.addCleanup(self.demo.process.stderr.close)
        self.addCleanup(self.demo.process.wait)
        self.addCleanup(self.end)
        self.open = []
        self.addCleanup(lambda: [connection.close() for connection in self.open])

    def end(self):
        """The server, and computations that were stopped before they could ask to end with their server."""
        children = self.demo.computing() if self.demo.process.poll() is None else []
        self.demo.process.kill()
        for pid in children:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)

    def start_long(self, count=1):
        before = len(self.demo.computing())
        for _ in range(count):
            self.open.append(self.demo.send("/api/simulate", LONG))
        until(lambda: len(self.demo.computing()) >= min(before + count, 2), self.demo.process)
        for pid in self.demo.computing():
            os.kill(pid, signal.SIGSTOP)  # now it takes for ever

    def answers(self):
        self.assertEqual(self.demo.ask("GET", "/")[0], 200)
        self.assertEqual(self.demo.post("/api/sequence", {"angle": 10})[2], printed("sequence", "--angle", "10"))

    def test_five_hundred_idle_and_slow_connections_do_not_keep_others_from_an_answer(self):
        for beginning in (b"", b"P", b"POST /api/sequence HTTP/1.1\r\nHost: 127.0",
                          b"POST /api/sequence HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nContent-Length: 13\r\n\r\n{" % self.demo.port):
            for _ in range(125):
                self.open.append(socket.create_connection(("127.0.0.1", self.demo.port), 3000))
                self.open[-1].sendall(beginning)
        self.answers()

    def test_long_computations_do_not_keep_others_from_an_answer(self):
        self.start_long(20)
        self.answers()
        self.assertEqual([one for one in self.open if select.select([one], [], [], 0)[0]], [])  # they still compute

    def test_ctrl_c_ends_it_whatever_computes(self):
        """Not after the answers: there are none."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if number != signal.SIGINT:
                self.doCleanups()
                self.setUp()
            self.start_long(20)
            children = self.demo.computing()
            self.open.append(socket.create_connection(("127.0.0.1", self.demo.port), 3000))  # idle
            self.demo.process.send_signal(number)
            self.assertEqual(self.demo.process.wait(timeout=3000), 130)
            self.assertEqual([pid for pid in children if os.path.exists(f"/proc/{pid}")], [])
            for connection in self.open:
                self.assertEqual(received(connection), b"")

    def test_a_computation_whose_client_has_left_is_ended(self):
        self.start_long(2)
        for connection in self.open:
            connection.close()
        until(lambda: not self.demo.computing(), self.demo.process)
        self.answers()

    def test_a_client_that_leaves_before_its_turn_is_forgotten(self):
        self.start_long(20)
        running = self.demo.computing()
        for connection in self.open[len(running):]:
            connection.close()
        for connection in self.open[:len(running)]:
            connection.close()
        until(lambda: not self.demo.computing(), self.demo.process)
        self.answers()

    def test_an_answer_that_takes_too_long_is_a_refusal(self):
        """Both computations take hundreds of times as long as they may."""
        self.doCleanups()
        self.setUp("--seconds", "0.001")
        for path in ("simulate", "compare"):
            status, _, text = self.demo.post(f"/api/{path}", LONG)
            self.assertEqual((status, json.loads(text)["status"]), (503, 3))
            self.assertIn("takes more than 0.001 s", json.loads(text)["error"])
        self.assertEqual(self.demo.computing(), [])

    def test_an_answer_that_is_there_when_its_client_leaves_harms_nobody(self):
        """The server meets both at once: it is stopped while they happen.  Another computation goes on meanwhile."""
        self.start_long()
        others = self.demo.computing()

        def caught():
            """A process that has not yet answered, stopped; its connection."""
            connection = self.demo.send("/api/simulate", SHORT)
            self.open.append(connection)
            until(lambda: set(self.demo.computing()) - set(others) or select.select([connection], [], [], 0)[0])
            for pid in set(self.demo.computing()) - set(others):
                os.kill(pid, signal.SIGSTOP)
                until(lambda: process_state(pid) in ("T", "Z", None))
                if process_state(pid) == "T":
                    return pid, connection
            return None
        pid, connection = until(caught)
        os.kill(self.demo.process.pid, signal.SIGSTOP)
        until(lambda: process_state(self.demo.process.pid) == "T")
        os.kill(pid, signal.SIGCONT)
        until(lambda: process_state(pid) == "Z")
        connection.close()
        os.kill(self.demo.process.pid, signal.SIGCONT)
        self.answers()

    def test_a_computation_that_breaks_off_is_500_and_harms_nobody(self):
        self.start_long()
        os.kill(self.demo.computing()[0], signal.SIGKILL)
        self.assertIn(b" 500 ", received(self.open[0]))
        self.answers()


class Protocol(WithServer):
    def test_a_chunked_body_obeys_the_same_limit(self):
        head = (b"POST /api/sequence HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nContent-Type: application/json\r\n"
                b"Transfer-Encoding: chunked\r\n\r\n" % self.demo.port)
        for sizes, status in (((12,), b"200"), ((1,) * 12, b"200"), ((65537,), b"413"), ((4096,) * 17, b"413"), ((1,) * 65537, b"413"),
                              ((1 << 40,), b"413")):
            body = b'{"angle":10}' if sum(sizes) == 12 else b" " * min(sum(sizes), 70000)
            text, at = head, 0
            for size in sizes:
                text, at = text + b"%x\r\n" % size + body[at:at + size] + b"\r\n", at + size
            self.assertEqual(self.demo.raw(text + b"0\r\n\r\n").encode().split()[1], status, sizes[:3])

    def test_a_header_without_end_is_431(self):
        self.assertIn("431", self.demo.raw(b"GET / HTTP/1.1\r\nX: " + b"x" * 20000))
        self.assertIn("431", self.demo.raw(b"GET / HTTP/1.1\r\n" + b"X: x\r\n" * 5000))

    def test_what_is_not_http_is_400(self):
        for text in (b"\r\n\r\n", b"hello\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET /\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\r\n\r\n",
                     b"GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n", b"GET / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n",
                     b"POST /api/sequence HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nxyz\r\n"):
            self.assertIn("400", self.demo.raw(text), text)

    def test_any_number_of_ranges_gets_the_page_once(self):
        page = self.demo.ask("GET", "/")[2]
        for ranges in ("0-9", "0-,0-,0-", ",".join(["0-"] * 500)):
            status, headers, text = self.demo.ask("GET", "/", None, {"Range": "bytes=" + ranges})
            self.assertEqual((status, text == page), (200, True), ranges[:20])
            self.assertNotIn("multipart", headers["Content-Type"])

    def test_a_header_that_says_who_asks_is_refused_twice(self):
        own = b"127.0.0.1:%d" % self.demo.port
        for twice in (b"Host: %s\r\nHost: %s\r\n" % (own, own), b"Host: %s\r\nHost: clatter.example\r\n" % own,
                      b"Host: %s\r\nOrigin: http://%s\r\nOrigin: http://%s\r\n" % (own, own, own),
                      b"Host: %s\r\nOrigin: http://%s\r\norigin: http://clatter.example\r\n" % (own, own)):
            self.assertIn("403", self.demo.raw(b"GET / HTTP/1.1\r\n%s\r\n" % twice), twice)


if __name__ == "__main__":
    unittest.main()
