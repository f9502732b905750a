# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `clatter verify --html` in headless Chromium: whole, without script errors, without a request to anywhere."""

import json
import os
import re
import subprocess
import tempfile
import unittest
import urllib.request

PROGRAM = os.environ["CLATTER_PROGRAM"]
ALLOWED = ("file:", "data:")
BROWSER = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
           "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
           "--window-size=1200,900"]


class Driver:
    """As much of the WebDriver protocol as the test needs."""

    def __init__(self):
        self.session = None
        self.process = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)

    def start(self, folder):
        port = None
        while port is None:
            line = self.process.stdout.readline()
            if not line:
                raise RuntimeError("chromedriver does not start")
            found = re.search(r"successfully on port (\d+)", line)
            port = found.group(1) if found else None
        self.base = f"http://127.0.0.1:{port}/session"
        chrome = {"binary": "/usr/bin/chromium", "args": BROWSER + [f"--user-data-dir={folder}"],
                  "perfLoggingPrefs": {"enableNetwork": True, "enablePage": True}}
        wanted = {"browserName": "chrome", "goog:chromeOptions": chrome,
                  "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        self.session = self.post("", {"capabilities": {"alwaysMatch": wanted}})["sessionId"]
        self.base += "/" + self.session

    def post(self, path, body, method="POST"):
        request = urllib.request.Request(self.base + path, json.dumps(body).encode(), {"Content-Type": "application/json"},
                                         method=method)
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with opener.open(request, timeout=3000) as answer:
            return json.load(answer)["value"]

    def open(self, path):
        self.post("/url", {"url": "file://" + path})

    def run(self, script):
        return self.post("/execute/sync", {"script": script, "args": []})

    def run_until_drawn(self):
        """Waits until the page has been drawn twice and has nothing left to do."""
        self.post("/execute/async", {"args": [], "script": "const done = arguments[0]; requestAnimationFrame(() => "
                                     "requestAnimationFrame(() => requestIdleCallback(() => done())));"})

    def log(self, kind):
        return self.post("/se/log", {"type": kind})

    def close(self):
        if self.session:
            self.post("", {}, "DELETE")  # ends the browser too
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.path = os.path.join(cls.folder.name, "verification.html")
        run = subprocess.run([PROGRAM, "verify", "--quick", "--html", cls.path, "--format", "json"], capture_output=True,
                             text=True)
        cls.status = run.returncode
        cls.results = json.loads(run.stdout)
        cls.driver = Driver()
        cls.addClassCleanup(cls.driver.close)
        cls.driver.start(os.path.join(cls.folder.name, "profile"))
        cls.driver.open(cls.path)
        cls.driver.run_until_drawn()

    def test_the_run_passed(self):
        self.assertEqual(self.status, 0)

    def test_nothing_is_requested_but_the_file_itself(self):
        requests = []
        for entry in self.driver.log("performance"):
            message = json.loads(entry["message"])["message"]
            # The browser's own start page is not the page under test.
            if (message["method"] == "Network.requestWillBeSent" and
                    not message["params"]["documentURL"].startswith("chrome:")):
                requests.append(message["params"]["request"]["url"])
        self.assertIn("file://" + self.path, requests)
        self.assertEqual([url for url in requests if not url.startswith(ALLOWED)], [])

    def test_the_browser_has_nothing_to_complain_of(self):
        self.assertEqual(self.driver.log("browser"), [])

    def test_every_check_has_its_row(self):
        for check in self.results["checks"]:
            row = self.driver.run(f"return document.getElementById('{check['id']}').innerText")
            self.assertIn(check["answer"], row)
            self.assertIn(check["verdict"], row)
            self.assertIn(check["command"], " ".join(row.split()))

    def test_every_figure_is_drawn_with_its_command(self):
        figures = {check["figure"] for check in self.results["checks"] if check["figure"]}
        self.assertEqual(len(figures), 16)
        text = self.driver.run("return document.body.innerText")
        for number in figures:
            self.assertIn(f"clatter figures --only {number} ", text)
        pictures = self.driver.run("return Array.from(document.querySelectorAll('.plots svg'), svg => {"
                                   "const box = svg.getBoundingClientRect();"
                                   "return [box.width, box.height, svg.querySelectorAll('path').length]; })")
        self.assertGreaterEqual(len(pictures), 35)
        for width, height, paths in pictures:
            self.assertGreater(width, 200)
            self.assertGreater(height, 100)
            self.assertGreater(paths, 5)

    def test_it_fits_its_window(self):
        wide = self.driver.run("return [document.documentElement.scrollWidth, window.innerWidth]")
        self.assertLessEqual(wide[0], wide[1])
