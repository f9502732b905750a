# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter demo`: the page that it writes, the address that it prints, the browser that it opens."""

import html
import os
import re
import urllib.parse
from pathlib import Path

from run_folder import EmptyFolder, json_of

HINT = "clatter: no desktop here to open the page; --export FILE writes a copy to carry elsewhere\n"
BOX = ["--body", "box", "--mass", "0.2", "--size", "0.15x0.07x0.01"]


def scene_in(page):
    return html.unescape(re.search(r'name="clatter-scene" content="([^"]*)"', page.read_text(encoding="utf-8"))[1])


class Demo(EmptyFolder):
    def demo(self, *arguments, said=HINT, **variables):
        """What it prints, in its own folder without a desktop."""
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "XDG_CACHE_HOME")}
        done = self.run_program("demo", *arguments, env={**environment, "HOME": self.folder, **variables})
        self.assertEqual((done.returncode, done.stderr), (0, said))
        return done.stdout

    def test_the_address_is_of_a_page_that_has_the_scene_given(self):
        """Its fragment holds the arguments that give the scene again."""
        for arguments in (["--angle", "20", "--height", "1", "--gravity", "9.81"], ["phone-damped", "--angle", "25"], ["phone-corner"],
                          ["--angle", "10", "--spin", "-1", "--tangential-velocity", "-0.5", "--friction", "0.1"],
                          ["--angle", "20", "--clearance", "1"], ["--orientation", "20", *BOX, "--velocity", "0.1,0.2,-1", "--restitution", "0.5"]):
            with self.subTest(arguments=arguments):
                path, fragment = re.fullmatch("file://(.*)#(.*)\n", self.demo(*arguments)).groups()
                self.assertEqual((path, scene_in(Path(path))), (self.path(".cache/clatter/demo.html"), fragment))
                query = dict(urllib.parse.parse_qsl(fragment))
                self.assertEqual(query.pop("given"), "1")
                flags = [part for name, value in query.items() for part in ("--" + name.replace("_", "-"), value)]
                model = "simulate" if "stiffness" in query else "sequence"
                self.assertEqual(json_of(model, *flags)["impacts"], json_of(model, *arguments)["impacts"])

    def test_a_file_without_a_ground_is_the_drop_of_the_same_flags(self):
        flags = ["--angle", "10", "--gravity", "9.81", "--friction", "0.3", "--restitution", "0.8"]
        text = "[drop]\nangle_deg = 10\n[world]\ngravity = 9.81\n[impact]\nfriction = 0.3\nrestitution = 0.8\n"
        self.write("lesson.toml", text)
        for more in ([], ["--height", "1"], ["--stiffness", "1e9"]):
            self.assertEqual(self.demo("lesson.toml", *more), self.demo(*flags, *more), more)

    def test_without_a_scene_the_page_has_its_own(self):
        page = Path(urllib.parse.unquote(self.demo(XDG_CACHE_HOME=self.path("a folder #")).strip().removeprefix("file://")))
        self.assertEqual((page, scene_in(page)), (Path(self.path("a folder #"), "clatter/demo.html"), ""))

    def test_the_desktop_s_browser_opens_the_page(self):
        os.chmod(self.write("xdg-open", '#!/bin/sh\necho "$1" >"$HOME/opened"\n'), 0o755)
        self.demo("rod-10", said="", PATH=f"{self.folder}:{os.environ['PATH']}", DISPLAY=":9")
        self.assertEqual(self.read("opened").strip(), self.path(".cache/clatter/demo.html"))

    def test_export_writes_the_page_with_the_scene_and_opens_nothing(self):
        out = self.demo("phone-corner", "--export", "page.html", said="", DISPLAY=":9", PATH=self.folder)
        self.assertEqual((out, os.listdir(self.folder)), ("", ["page.html"]))
        self.assertIn("body=box", scene_in(Path(self.path("page.html"))))
        self.assertLess(os.path.getsize(self.path("page.html")), 2_500_000)

    def test_bad_arguments_are_one_line(self):
        self.each_refused({"--export /no/such/folder/x.html": "--export", "phone-sweep": "sweep", "--port 8000": "--port", "--angle 95": "--angle",
                           "--body mesh --angle 10": "mesh", "--topple 0.1": "topple", "--angle 10 --incline 5": "incline",
                           "--angle 10 --release-height 1": "release", "no-such-case": "no-such-case"}, "demo", env={**os.environ, "HOME": self.folder})

    def test_without_a_folder_of_its_own_it_says_so(self):
        self.refused("--export", "demo", env={name: value for name, value in os.environ.items() if name not in ("HOME", "XDG_CACHE_HOME")} | {"HOME": ""})
