# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter demo`: the page that it writes, the address that it prints, the browser that it opens."""

import html
import os
import re
import tempfile
import urllib.parse
from pathlib import Path

import run_folder
from run_folder import EmptyFolder, json_of

HINT = "clatter: no desktop here to open the page; --export FILE writes a copy to carry elsewhere\n"
BOX = ["--body", "box", "--mass", "0.2", "--size", "0.15x0.07x0.01"]


def run(*arguments, folder, **variables):
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "XDG_CACHE_HOME")}
    return run_folder.run("demo", *arguments, cwd=folder, env={**environment, "HOME": folder, **variables})


def scene_in(page):
    return html.unescape(re.search(r'name="clatter-scene" content="([^"]*)"', page.read_text(encoding="utf-8"))[1])


class Demo(EmptyFolder):
    def test_the_address_is_of_a_page_that_has_the_scene_given(self):
        """Its fragment holds the arguments that give the scene again."""
        for arguments in (["--angle", "20", "--height", "1", "--gravity", "9.81"], ["phone-damped", "--angle", "25"], ["phone-corner"],
                          ["--angle", "10", "--spin", "-1", "--tangential-velocity", "-0.5", "--friction", "0.1"],
                          ["--angle", "20", "--clearance", "1"], ["--orientation", "20", *BOX, "--velocity", "0.1,0.2,-1", "--restitution", "0.5"]):
            with self.subTest(arguments=arguments), tempfile.TemporaryDirectory() as folder:
                done = run(*arguments, folder=folder)
                self.assertEqual((done.returncode, done.stderr, done.stdout.count("\n")), (0, HINT, 1))
                path, fragment = done.stdout.strip().removeprefix("file://").split("#")
                self.assertEqual(Path(path), Path(folder) / ".cache/clatter/demo.html")
                self.assertEqual(scene_in(Path(path)), fragment)
                query = dict(urllib.parse.parse_qsl(fragment))
                self.assertEqual(query.pop("given"), "1")
                flags = [part for name, value in query.items() for part in ("--" + name.replace("_", "-"), value)]
                model = "simulate" if "stiffness" in query else "sequence"
                self.assertEqual(json_of(model, *flags)["impacts"], json_of(model, *arguments)["impacts"])

    def test_a_file_without_a_ground_is_the_drop_of_the_same_flags(self):
        flags = ["--angle", "10", "--gravity", "9.81", "--friction", "0.3", "--restitution", "0.8"]
        text = "[drop]\nangle_deg = 10\n[world]\ngravity = 9.81\n[impact]\nfriction = 0.3\nrestitution = 0.8\n"
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "lesson.toml").write_text(text, encoding="utf-8")
            for more in ([], ["--height", "1"], ["--stiffness", "1e9"]):
                with self.subTest(more=more):
                    done = run("lesson.toml", *more, folder=folder)
                    self.assertEqual((done.returncode, done.stderr), (0, HINT))
                    self.assertEqual(done.stdout, run(*flags, *more, folder=folder).stdout)

    def test_without_a_scene_the_page_has_its_own(self):
        with tempfile.TemporaryDirectory(prefix="a folder #") as folder:
            done = run(folder=folder, XDG_CACHE_HOME=folder + "/cache")
            self.assertEqual((done.returncode, done.stderr), (0, HINT))
            page = Path(urllib.parse.unquote(done.stdout.strip().removeprefix("file://")))
            self.assertEqual((page, scene_in(page)), (Path(folder) / "cache/clatter/demo.html", ""))

    def test_the_desktop_s_browser_opens_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            opener = Path(folder) / "xdg-open"
            opener.write_text('#!/bin/sh\necho "$1" >"$HOME/opened"\n', encoding="utf-8")
            opener.chmod(0o755)
            done = run("rod-10", folder=folder, PATH=f"{folder}:{os.environ['PATH']}", DISPLAY=":9")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual((Path(folder) / "opened").read_text(encoding="utf-8").strip(), f"{folder}/.cache/clatter/demo.html")

    def test_export_writes_the_page_with_the_scene_and_opens_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run("phone-corner", "--export", "page.html", folder=folder, DISPLAY=":9", PATH=folder)
            self.assertEqual((done.returncode, done.stdout, done.stderr, os.listdir(folder)), (0, "", "", ["page.html"]))
            page = Path(folder) / "page.html"
            self.assertIn("body=box", scene_in(page))
            self.assertLess(page.stat().st_size, 2_500_000)

    def test_bad_arguments_are_one_line(self):
        self.each_refused({"--export /no/such/folder/x.html": "--export", "phone-sweep": "sweep", "--port 8000": "--port", "--angle 95": "--angle",
                           "--body mesh --angle 10": "mesh", "--topple 0.1": "topple", "--angle 10 --incline 5": "incline",
                           "--angle 10 --release-height 1": "release", "no-such-case": "no-such-case"}, "demo", env={**os.environ, "HOME": self.folder})

    def test_without_a_folder_of_its_own_it_says_so(self):
        self.refused("--export", "demo", env={name: value for name, value in os.environ.items() if name not in ("HOME", "XDG_CACHE_HOME")} | {"HOME": ""})
