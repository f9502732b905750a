# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas are laid out by KaTeX while the pages are made, so that a page needs its style and fonts alone; MathML stands beside them
for readers' tools."""

import json
import shutil
import subprocess
from pathlib import Path

from docutils.nodes import SkipNode
from sphinx.errors import ExtensionError

FOLDER = Path("/usr/share/javascript/katex")
KATEX = str(FOLDER / "katex.js")
TRANSLATOR = f"""
const katex = require({KATEX!r});
require('readline').createInterface({{input: process.stdin}}).on('line', line => {{
  const {{tex, display}} = JSON.parse(line);
  let answer;
  try {{
    answer = {{html: katex.renderToString(tex, {{displayMode: display, strict: 'error', throwOnError: true}})}};
  }} catch (error) {{
    answer = {{error: error.message}};
  }}
  console.log(JSON.stringify(answer));
}});
"""


class Formulas:
    """One KaTeX for all formulas of a build."""

    def __init__(self):
        self.process = None

    def laid_out(self, tex, display):
        if self.process is None:
            self.process = subprocess.Popen(["node", "-e", TRANSLATOR], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                            encoding="utf-8")
        self.process.stdin.write(json.dumps({"tex": tex, "display": display}) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline() or '{"error": "node ended"}')
        if "error" in answer:
            raise ExtensionError(f"formula {tex!r}: {answer['error']}")
        return answer["html"]

    def close(self, *_):
        if self.process:
            self.process.stdin.close()
            self.process.wait()


def copy_style(app, error):
    target = Path(app.outdir, "_static", "katex")
    shutil.copytree(FOLDER / "fonts", target / "fonts", ignore=shutil.ignore_patterns("*.ttf", "*.woff"), dirs_exist_ok=True)
    shutil.copy(FOLDER / "katex.min.css", target)


def setup(app):
    formulas = Formulas()

    def inline(writer, node):
        writer.body.append(formulas.laid_out(node.astext(), False))
        raise SkipNode

    def block(writer, node):
        writer.body.append(f'<div class="formula">{formulas.laid_out(node.astext(), True)}</div>\n')
        raise SkipNode

    app.add_html_math_renderer("katex", (inline, None), (block, None))
    app.config.html_math_renderer = "katex"
    app.add_css_file("katex/katex.min.css")
    app.connect("build-finished", copy_style)
    app.connect("build-finished", formulas.close)
    return {"parallel_read_safe": True, "parallel_write_safe": False}
