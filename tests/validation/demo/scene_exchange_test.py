# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene files that the page of `clatter demo` opens and gives back: the same scenes, and nobody else's files.

CLATTER_PROGRAM is the program, CLATTER_ROOT the folder of the source.
"""

import json
import math
import os
import re
import tempfile
import unittest
from pathlib import Path

from running_demo import WithServer, printed


class SceneFiles(WithServer):
    def test_a_scene_file_and_its_arguments_are_the_same_scene(self):
        """Of every case that comes with the program: file, arguments, file, arguments; and of the numbers that they give."""
        folder = Path(os.environ["CLATTER_ROOT"]) / "validation" / "cases"
        count = 0
        for file in sorted(folder.glob("*.toml")):
            if "sweep" in file.name:
                continue
            if not re.search(r'shape = "(rod|box)"', file.read_text(encoding="utf-8")):
                status, _, answer = self.demo.post("/api/scene", {"name": file.name, "text": file.read_text(encoding="utf-8")})
                self.assertEqual((status, "must be rod or box" in answer), (400, True), file.name)
                continue
            with self.subTest(case=file.stem), tempfile.TemporaryDirectory() as scratch:
                opened = json.loads(self.demo.post("/api/scene", {"name": file.name, "text": file.read_text(encoding="utf-8")})[2])
                written = json.loads(self.demo.post("/api/file", opened["arguments"])[2])["file"]
                again = json.loads(self.demo.post("/api/scene", {"name": "again.toml", "text": written})[2])
                self.assertEqual(again, {"arguments": opened["arguments"], "notes": []})
                copy = Path(scratch) / "copy.toml"
                copy.write_text(written, encoding="utf-8")
                self.assertEqual(json.loads(printed("simulate", str(copy)))["impacts"], json.loads(printed("simulate", str(file)))["impacts"])
                count += 1
        self.assertGreater(count, 10)

    def test_a_scene_file_without_impact_keys_keeps_the_law_of_its_ground(self):
        text = "[drop]\nangle_deg = 90\nheight = 2\n[ground]\nstiffness = 1e9\ndamping = 1e8\nsliding_friction = 0.3\n"
        opened = json.loads(self.demo.post("/api/scene", {"name": "own.toml", "text": text})[2])
        self.assertEqual((opened["notes"], opened["arguments"]["restitution_law"]), ([], "viscoelastic"))
        law = json.loads(self.demo.post("/api/sequence", opened["arguments"])[2])["scene"]["discrete_law"]
        # The exact relation of one frictionless contact: ln[(1 + s)/(1 - s e)] = s (1 + e), s = (c/k) v.
        e, s = law["restitution"], 1e8 / 1e9 * math.sqrt(2 * 9.81 * (2 - 0.5))
        self.assertLess(abs(math.log((1 + s) / (1 - s * e)) - s * (1 + e)), 1e-14)
        self.assertEqual((law["friction"], law["friction_from"]), (0.3, "ground.sliding_friction"))
        opened = json.loads(self.demo.post("/api/scene", {"name": "own.toml", "text": text + "[impact]\nrestitution = 1\n"})[2])
        self.assertEqual((opened["notes"], opened["arguments"]["restitution"], "friction" in opened["arguments"]), ([], 1, False))

    def test_no_scene_file_can_name_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            target = Path(folder) / "written.csv"
            text = f"[drop]\nangle_deg = 10\n[ground]\nstiffness = 1e9\n[run]\nhistory = '{target}'\n"
            status, _, answer = self.demo.post("/api/scene", {"name": "/etc/passwd", "text": text})
            self.assertEqual(status, 200, answer)
            self.assertNotIn(str(target), answer)
            self.assertIn("run.history is left out", answer)
            self.assertEqual(self.demo.post("/api/simulate", json.loads(answer)["arguments"])[0], 200)
            self.assertEqual(list(Path(folder).iterdir()), [])


if __name__ == "__main__":
    unittest.main()
