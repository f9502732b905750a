# SPDX-License-Identifier: GPL-3.0-or-later
"""Every block of code of README and the reference runs in an empty folder, but for what documents.py fills and holds, and
what is listed here with who runs it."""

import doctest
import math
import os
import re
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

import clatter
import run_folder

ROOT = Path(run_folder.ROOT)
PAGES = [ROOT / "README.md", *sorted((ROOT / "notebooks-data/reference").rglob("*.md"))]
FILLED = re.compile(r"<!-- (output|code|table): .*? -->.*?<!-- end -->", re.DOTALL)
BLOCK = re.compile(r"^```(\S*)\n(.*?)^```$|(?<=\n\n)((?:^ {4}[^\n]+\n)+)", re.MULTILINE | re.DOTALL)
IN_ORDER = Path("notebooks-data/reference/many_drops.md")  # whose Python reads what commands before it wrote
SPHINX = {"{eval-rst}", "{toctree}"}
# By the beginning of the block.
RUN_ELSEWHERE = {
    "./clatter sequence --angle 10\ntests/run": "tests/launcher_test.bash runs the first, this is the second",
    "python3 -m venv": "tests/install/packages_test.bash",
    "# problem: rod-10": "tests/validation/benchmark: the beginning of a file, which tells its form",
    "# engine: Name": "the lines above the header of a file",
    "mpirun ": "tests/validation/sweep/sweep_test.py", "#!/bin/bash\n#SBATCH": "needs Slurm", "#SBATCH": "needs Slurm",
    "clatter verify --extremes --quick": "tests/validation/evidence/extremes_test.py, by its parts: a minute or more",
}
BOX = "\n".join([*(f"v {x} {y} {z}" for x in (0, 80) for y in (0, 40) for z in (0, 10)),
                 "f 1 2 4 3", "f 5 7 8 6", "f 1 5 6 2", "f 3 4 8 7", "f 1 3 7 5", "f 2 6 8 4", ""])


def blocks():
    """(page, line, language, text) of each that is not filled from what it shows; what is indented is commands or no code."""
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        bare = FILLED.sub(lambda found: "\n" * found[0].count("\n"), text)
        for found in BLOCK.finditer(bare):
            if found[1] not in SPHINX and (not found[3] or re.match(" +(clatter|mpirun|srun|#)", found[3])):
                text = textwrap.dedent(found[3]) if found[3] else found[2]
                yield page.relative_to(ROOT), bare.count("\n", 0, found.start()) + 1, found[1] or "", text


class Blocks(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder, programs = Path(scratch.name, "empty"), Path(scratch.name, "bin")
        self.folder.mkdir()
        programs.mkdir()
        (programs / "clatter").symlink_to(run_folder.PROGRAM)
        self.environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}", MPLBACKEND="Agg", HOME=scratch.name)

    def ran(self, *command):
        done = subprocess.run(command, cwd=self.folder, env=self.environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def with_parts(self):
        """The files of a user, as a page names them."""
        (self.folder / "part.obj").write_text(BOX, encoding="utf-8")
        (self.folder / "part.stl").write_text(run_folder.TETRAHEDRON.replace(" 1", " 50"), encoding="utf-8")
        for name in ("phone.toml", "handset.toml", "concrete.toml", "pad.toml"):
            scene = Path(run_folder.case("phone-damped")).read_text(encoding="utf-8")
            (self.folder / name).write_text(scene + "[[probe]]\nname = 'camera'\nplace = [0.04, 0.01, 0]\n", encoding="utf-8")
        pulse = (100 * math.sin(math.pi * (n - 100) / 20) * (100 <= n <= 120) for n in range(300))  # g, 2 ms long
        (self.folder / "drop.csv").write_text("time,acceleration\n" + "".join(f"{n / 1e4},{a}\n" for n, a in enumerate(pulse)), encoding="utf-8")
        truth = run_folder.printed("benchmark", "truth", "rod-10", "--format", "csv")
        for step in ("0.001", "0.002"):
            (self.folder / f"rod-10-{step}-1.csv").write_text(f"# step: {step}\n{truth}", encoding="utf-8")
        return self.folder

    def test_every_block_runs_or_is_listed(self):
        seen, listed = 0, set()
        for page, line, language, text in blocks():
            elsewhere = [begin for begin in RUN_ELSEWHERE if text.startswith(begin)]
            listed.update(elsewhere)
            if elsewhere or (language == "python" and page != IN_ORDER):
                continue
            with self.subTest(page=str(page), line=line):
                seen += 1
                if language == "toml":
                    (self.with_parts() / "scene.toml").write_text(text, encoding="utf-8")
                    self.ran("clatter", "sequence", "scene.toml")
                    continue
                if language == "python":
                    self.ran(sys.executable, "-B", "-W", "error", "-c", text)
                    continue
                self.assertTrue(text.startswith("clatter "), "neither run here nor listed")
                if re.search(r"part\.|drop\.csv|rod-10-", text):
                    self.with_parts()
                for command in text.replace("\\\n", " ").splitlines():
                    if "part.3mf" not in command:  # tests/validation/scene/mesh_files_test.py writes and reads such files
                        self.ran("bash", "-c", command)
        self.assertGreater(seen, 5)
        self.assertEqual(listed, set(RUN_ELSEWHERE), "what is listed is there")

    def test_blocks_of_python_run_page_by_page_and_give_what_stands_beside_them(self):
        try:
            import matplotlib, pandas  # noqa: F401, E401, PLC0415
        except ImportError as error:
            self.skipTest(str(error))
        pages, promised = {}, 0
        for page, _, language, text in blocks():
            if language == "python" and page != IN_ORDER:
                pages.setdefault(page, []).append(text)
        self.assertGreater(len(pages), 1)
        for page, texts in pages.items():
            lines = []
            for line in "".join(texts).splitlines():
                value = re.match(r"(?:print\()?([^\s#(][^#]*?)\)?\s+# (-?\d+\.\d+)", line)
                promised += bool(value)
                lines.append(line + (f"\nassert float({value[1]}) == {value[2]}" if value else ""))
            with self.subTest(page=str(page)):
                self.ran(sys.executable, "-B", "-W", "error", "-c", "\n".join(lines))
        self.assertGreater(promised, 1)

    def test_types_of_blocks_of_python_are_sound(self):
        pages = {}
        for page, _, language, text in blocks():
            if language == "python":
                pages.setdefault(page.stem, []).append(text)
        self.assertIn("python", pages)
        for name, texts in pages.items():
            (self.folder / f"{name}_page.py").write_text("".join(texts), encoding="utf-8")
        self.environment["MYPYPATH"] = str(Path(clatter.__file__).resolve().parents[1])
        self.ran(sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", *(f"{name}_page.py" for name in pages))

    def test_examples_of_the_documentation_give_what_stands_below_them(self):
        seen = 0
        for name in clatter.__all__:
            for example in doctest.DocTestParser().get_examples(getattr(clatter, name).__doc__ or ""):
                if example.want:
                    with self.subTest(name=name):
                        seen += 1
                        self.assertEqual(repr(eval(example.source, {"clatter": clatter})).split(), example.want.split())
        self.assertGreater(seen, 5)
