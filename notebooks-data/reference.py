#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the reference, a site that opens offline and is searched offline.  A warning is an error.

Usage: reference.py PROGRAM FOLDER    (then open FOLDER/index.html)

A page is a Markdown file of notebooks-data/reference/ (index.md has their order; one that it does not name comes under
"More"), of reference/commands/ for a command of the program, or of notebooks-data/ for tables that programs wrote; the
notebooks are pages, too.  What each command prints as help, Python's docstrings and the public headers
are added from the program and the sources.
"""

import argparse
import importlib.util
import itertools
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
PAGES = HERE / "reference"
LIBRARIES = ("analytic", "numeric")
TABLES = ("accuracy", "extremes", "league", "seeded_faults", "tradeoff", "verification")  # pages that programs wrote
MODULES = {"sphinx": "python3-sphinx", "furo": "furo", "myst_parser": "python3-myst-parser",
           "nbconvert": "jupyter-nbconvert"}
TOOLS = {"node": "nodejs"}
NORMALIZE = Path("/usr/share/nodejs/normalize.css/normalize.css")
FILES = {"/usr/share/javascript/katex/katex.js": "libjs-katex", str(NORMALIZE): "node-normalize.css"}


class Unbuilt(Exception):
    """Why there is no reference, in one line."""


def missing():
    """Debian packages of what is not there."""
    return sorted([package for name, package in MODULES.items() if importlib.util.find_spec(name) is None]
                  + [package for name, package in TOOLS.items() if shutil.which(name) is None]
                  + [package for name, package in FILES.items() if not Path(name).exists()])


def printed(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def commands(program):
    """The words of each command and of its forms, such as "plan --tradeoff", by the name of its page, in the order of the manual page."""
    names = re.findall(r"^\.SH clatter (.+)$", printed(program, "man"), re.M)
    return {name.split()[-1].lstrip("-"): name.split() for name in (name.replace("\\", "") for name in names)}


def as_myst(text, name, depth=0):
    """A page as Sphinx reads it, from a folder `depth` levels below reference/, beside which the tables lie here.

    "# Title {#name}" and "@ref name" of doxygen are understood, too; a page without a title is called by its name.
    """
    text = re.sub(r"^(# .*?) \{#(\w+)\}$", r"(\2)=\n\1", text, count=1, flags=re.M)
    text = re.sub(r"@(?:sub)?(?:ref|page) (\w+)", r"[](\1.md)", text)
    if not re.search("^# ", text, re.M):
        text = f"# {name.replace('_', ' ').capitalize()}\n\n{text}"
    text = text.replace("](../../validation/demo/page/", "](")
    return text.replace("](" + "../" * (depth + 1), "](" + "../" * depth).replace(".ipynb)", ".md)")


def command_page(program, name, words):
    """What a page of reference/commands/ says, then the help."""
    own = PAGES / "commands" / f"{name}.md"
    head = own.read_text(encoding="utf-8") if own.exists() else f"# clatter {' '.join(words)}\n"
    return f"{head}\n## Options\n\n```text\n{printed(program, *words, '--help')}```\n"


def public_headers(library):
    """As its CMakeLists.txt lists them."""
    text = (ROOT / library / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"PUBLIC_HEADERS\s+([^)]*?)\)", text)[1].split()


def header_text(library, header):
    """What it is about, from its first lines, and the header itself, whose comments are the contract."""
    lines = (ROOT / library / header).read_text(encoding="utf-8").splitlines()[1:]  # without the licence
    about = list(itertools.takewhile(lambda line: line.startswith("// "), lines))
    code = "\n".join(lines[len(about):]).replace("#pragma once\n", "").strip()
    words = " ".join(line.removeprefix("// ") for line in about)
    return f"{words}\n\n```cpp\n{code}\n```\n"


def header_pages():
    """The public headers of a library by folder, each with its folder's name."""
    for library in LIBRARIES:
        folders = {}
        for header in public_headers(library):
            folders.setdefault(str(Path(header).parent), []).append(header)
        for folder, headers in folders.items():
            name = library if folder == "." else f"{library}/{folder}"
            body = "\n\n".join(f"## {library}/{header}\n\n{header_text(library, header)}" for header in headers)
            yield f"headers/{name.replace('/', '_')}.md", f"# {name}\n\n{body}\n"


def notebook_pages(folder):
    """Each notebook as Markdown with its pictures beside it."""
    from nbconvert import MarkdownExporter
    for path in sorted((HERE / "notebooks").glob("*.ipynb")):
        text, resources = MarkdownExporter().from_filename(str(path))
        for name, data in resources["outputs"].items():
            (folder / f"{path.stem}_{name}").write_bytes(data)
            text = text.replace(f"]({name})", f"]({path.stem}_{name})")
        (folder / f"{path.stem}.md").write_text(re.sub(r"</?style[^>]*>", "", text), encoding="utf-8")


def stage(program, source):
    """All pages in one folder."""
    sheets = (HERE.parent / "validation" / "demo" / "page").glob("*.md")
    for path in [*PAGES.glob("*.md"), *sheets, *(HERE / f"{name}.md" for name in TABLES)]:
        (source / path.name).write_text(as_myst(path.read_text(encoding="utf-8"), path.stem), encoding="utf-8")
    shutil.copytree(PAGES / "theme", source / "theme")
    for path in PAGES.glob("*.py"):
        shutil.copy(path, source)
    shutil.copytree(HERE / "figures", source / "figures", ignore=shutil.ignore_patterns("*.csv"))
    for picture in HERE.glob("*.svg"):
        shutil.copy(picture, source)
    for folder in ("commands", "headers", "notebooks"):
        (source / folder).mkdir()
    for name, words in {"clatter": [], **commands(program)}.items():
        (source / "commands" / f"{name}.md").write_text(as_myst(command_page(program, name, words), name, 1), encoding="utf-8")
    for name, text in header_pages():
        (source / name).write_text(text, encoding="utf-8")
    notebook_pages(source / "notebooks")
    index = (source / "index.md").read_text(encoding="utf-8")
    more = sorted(path.stem for path in source.glob("*.md") if path.stem != "index" and not re.search(rf"^{path.stem}$", index, re.M))
    (source / "index.md").write_text(index.replace("<!-- more -->", "\n".join(more)), encoding="utf-8")


def python_module(program, folder):
    """The Python files of the module beside a stand-in for its compiled part, of which docstrings need nothing."""
    package = folder / "clatter"
    shutil.copytree(HERE / "python" / "clatter", package, ignore=shutil.ignore_patterns("__pycache__", "*.pyi"))
    shutil.copy(HERE / "look.py", package)
    (package / "_clatter.py").write_text(f"version = {version(program)!r}\ndef keys():\n    return []\n"
                                         "def command_options():\n    return {}\n"
                                         "def __getattr__(name):\n    return None\n", encoding="utf-8")


def version(program):
    return printed(program, "--version").split()[1]


def mend_theme(sheet):
    """Debian's theme asks a server for a sheet of another package, and is dark only where a reader says so, not where the system does."""
    text = re.sub(r"@import url\([^)]*normalize.css\);", lambda _: NORMALIZE.read_text(encoding="utf-8"), sheet.read_text(encoding="utf-8"))
    dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*\})', text)[1]
    sheet.write_text(f'{text}\n@media screen and (prefers-color-scheme: dark) {{ body[data-theme="auto"] {dark} }}\n', encoding="utf-8")


def build(program, folder):
    """@raise CalledProcessError: Sphinx found a warning."""
    with tempfile.TemporaryDirectory() as scratch:
        source, module = Path(scratch, "source"), Path(scratch, "python")
        source.mkdir()
        module.mkdir()
        stage(program, source)
        python_module(program, module)
        settings = {"CLATTER_REFERENCE_PYTHON": str(module), "CLATTER_REFERENCE_VERSION": version(program), "PYTHONDONTWRITEBYTECODE": "1"}
        subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-d", f"{scratch}/trees", source, folder],
                       env=os.environ | settings, check=True)
    mend_theme(folder / "_static/styles/furo.css")
    for page in folder.rglob("*.html"):  # whose theme gives its headings no level, and keys nothing to scroll wide tables by
        text = page.read_text(encoding="utf-8").replace('role="heading">', 'role="heading" aria-level="2">')
        page.write_text(text.replace('<table class="docutils', '<table tabindex="0" class="docutils'), encoding="utf-8")
    for made_by_sphinx in (".buildinfo", "objects.inv"):
        (folder / made_by_sphinx).unlink(missing_ok=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    given = parser.parse_args()
    try:
        if packages := missing():
            raise Unbuilt(f"packages are missing: apt-get install --no-install-recommends {' '.join(packages)}")
        build(given.program.resolve(), given.folder.resolve())
    except (OSError, Unbuilt, subprocess.CalledProcessError) as error:
        sys.exit(f"reference.py: {error}")


if __name__ == "__main__":
    main()
