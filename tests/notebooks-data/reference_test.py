# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference is built without a warning, opens and is searched offline, has no broken link, and holds every command, key,
column, public function and public header."""

import html
import os
import re
import subprocess
import tempfile
import unittest
import urllib.parse
from html.parser import HTMLParser
from pathlib import Path

import run_folder
from run_folder import PROGRAM, commands, printed

ROOT = Path(run_folder.ROOT)
BUILDER = ROOT / "notebooks-data/reference.py"
THEME = "https://github.com/pradyunsg/furo"  # named in the foot of each page, the only way out of the site


class Page(HTMLParser):
    """Where a page's links and files lead, and what can be linked to."""

    def __init__(self, path):
        super().__init__()
        self.links, self.files, self.names = [], [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names |= {given[name] for name in ("id", "name") if given.get(name)}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        elif tag != "use":  # of the page itself
            self.files += [given[name] for name in ("href", "src") if given.get(name)]


class Reference(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = Path(scratch.name)
        cls.built = subprocess.run(["/usr/bin/python3", "-B", BUILDER, PROGRAM, cls.folder], capture_output=True, text=True)
        cls.pages = {path: Page(path) for path in cls.folder.rglob("*.html")}

    def text(self, name):
        return html.unescape(re.sub(r"<[^>]*>", "", (self.folder / name).read_text(encoding="utf-8")))

    def test_it_is_built_without_a_warning_and_no_link_or_anchor_is_broken(self):
        self.assertEqual((self.built.returncode, self.built.stderr), (0, ""))
        broken = []
        for path, page in self.pages.items():
            for link in page.links:
                if link == THEME:
                    continue
                place, _, anchor = urllib.parse.unquote(link).partition("#")
                target = (path.parent / place).resolve() if place else path
                if not target.exists() or (anchor and anchor not in self.pages[target].names):
                    broken.append(f"{path.relative_to(self.folder)}: {link}")
        self.assertEqual(broken, [])
        self.assertGreater(sum(len(page.links) for page in self.pages.values()), 1000)

    def test_its_pages_ask_for_nothing_from_outside(self):
        asked = [(path, file) for path, page in self.pages.items() for file in page.files if not file.startswith("data:")]
        self.assertEqual([one for one in asked if not (one[0].parent / urllib.parse.unquote(re.sub(r"[?#].*", "", one[1]))).exists()], [])

    def test_formulas_are_drawn_by_the_browser_itself_and_no_page_tells_where_it_was_built(self):
        page = (self.folder / "discrete_model.html").read_text(encoding="utf-8")
        self.assertGreater(page.count("<math"), 40)
        self.assertIn(r"P_n = -\frac{(1 + e)\, m\, u}{A - \mu_i B}", html.unescape(page))  # beside what is drawn, for readers' tools
        for path in self.pages:
            self.assertNotRegex(path.read_text(encoding="utf-8"), f"katex-error|{re.escape(str(ROOT))}", path.name)

    def test_every_command_has_a_page_with_its_help_whose_flags_keep_their_two_dashes(self):
        for words in commands():
            if words != ["help"]:
                page = self.text(f"commands/{words[-1].lstrip('-')}.html")
                self.assertIn(f"Usage: clatter {' '.join(words)} ", page)
                self.assertNotRegex(page, "[–—]angle")

    def test_it_holds_every_key_and_column(self):
        for command in ("keys", "columns"):
            names = [line.split(",")[0] for line in printed("help", command, "--format", "csv", "--bare").splitlines()[1:]]
            self.assertGreater(len(names), 20)
            page = self.text(f"{command}.html")
            self.assertEqual([name for name in names if name not in page], [])

    def test_it_explains_every_name_that_a_cell_may_hold(self):
        source = (ROOT / "validation/scene/names.cpp").read_text(encoding="utf-8")
        names = re.findall(r'"([a-z-]+)"', source[source.index("mode_name"):])
        self.assertGreater(len(names), 30)
        explained = re.findall(r"`([^`]+)`", (ROOT / "notebooks-data/reference/columns.md").read_text(encoding="utf-8"))
        self.assertEqual([name for name in names if name not in explained], [])

    def test_the_sources_that_it_names_exist(self):
        files = [str(path) for folder in ("analytic", "numeric", "validation", "tests") for path in (ROOT / folder).rglob("*.[ch]pp")]
        named = [(page.name, name) for page in (ROOT / "notebooks-data/reference").rglob("*.md")
                 for name in re.findall(r"`<?([\w./]+\.[ch]pp)>?`", page.read_text(encoding="utf-8"))]
        self.assertGreater(len(named), 30)
        self.assertEqual([one for one in named if not any(file.endswith("/" + one[1].removeprefix("clatter/")) for file in files)], [])

    def test_it_holds_all_that_the_python_module_offers(self):
        source = (ROOT / "notebooks-data/python/clatter/__init__.py").read_text(encoding="utf-8")
        names = re.findall(r'"(\w+)"', source.split("__all__ =")[1])
        self.assertGreater(len(names), 40)
        described = self.pages[self.folder / "python.html"].names
        self.assertEqual([name for name in names if not any(one.endswith(f".{name}") for one in described)], [])

    def test_it_holds_every_public_header(self):
        for library in ("analytic", "numeric"):
            listed = re.search(r"PUBLIC_HEADERS\s+([^)]*?)\)", (ROOT / library / "CMakeLists.txt").read_text(encoding="utf-8"))[1].split()
            self.assertGreater(len(listed), 10)
            for header in listed:
                folder = os.path.dirname(header).replace("/", "_")
                page = " ".join(self.text(f"headers/{library}{'_' + folder if folder else ''}.html").split())
                self.assertIn(f"{library}/{header}", page)
                text = (ROOT / library / header).read_text(encoding="utf-8")
                for contract in re.findall(r"^/// (.*)", text, re.M):
                    self.assertIn(" ".join(contract.split()), page)

    def test_each_notebook_is_a_page_in_the_order_of_their_numbers_and_their_solutions_come_last(self):
        page = (self.folder / "notebooks.html").read_text(encoding="utf-8")
        listed = list(dict.fromkeys(re.findall(r'toctree-l2"?[^>]*><a[^>]*href="notebooks/(\w+)\.html"', page)))
        self.assertEqual(listed, [*sorted(listed[:-1], key=lambda name: int(name.split("_")[0])), "solutions"])
        self.assertEqual(set(listed), {path.stem for path in (ROOT / "notebooks-data/notebooks").glob("*.ipynb")})
        for name in listed:
            self.assertIn("import clatter", self.text(f"notebooks/{name}.html"))

    def test_its_sheet_asks_for_no_other_and_is_dark_where_the_system_is_headings_have_levels_and_tables_take_the_keyboard(self):
        for name, there, absent in (
                ("_static/styles/furo.css", r'prefers-color-scheme: dark\) \{ body\[data-theme="auto"\] \{[^}]*--color-background-primary: #1', "@import"),
                ("index.html", 'role="heading" aria-level="2"', 'role="heading">'),
                ("league.html", '<table tabindex="0" class="docutils', '<table class="docutils')):
            page = (self.folder / name).read_text(encoding="utf-8")
            self.assertRegex(page, there)
            self.assertNotIn(absent, page)

    def test_search_finds_what_a_reader_asks_for(self):
        # The words of the index, which the browser reads without a server.
        index = (self.folder / "searchindex.js").read_text(encoding="utf-8")
        self.assertTrue(index.startswith("Search.setIndex("))
        for word in ("fold", "jamming", "restitut", "stiff", "angle_deg", "quaternion"):
            self.assertRegex(index, rf'\b"?{word}\w*"?:')

    def test_a_missing_tool_is_named_with_its_package(self):
        with tempfile.TemporaryDirectory() as empty:
            run = subprocess.run(["/usr/bin/python3", "-B", BUILDER, PROGRAM, f"{empty}/site"], capture_output=True, text=True,
                                 env={"PATH": empty})
        self.assertNotEqual(run.returncode, 0)
        self.assertRegex(run.stderr, r"apt-get install .*nodejs")
