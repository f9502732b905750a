# SPDX-License-Identifier: GPL-3.0-or-later
"""A page as blocks, written as Markdown or as HTML that opens offline."""

import html
import re

STYLE = """body{font:15px/1.45 system-ui,sans-serif;color:#222;max-width:76rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse;font-size:13px;display:block;overflow-x:auto}td,th{border-bottom:1px solid #ddd;padding:.2rem .5rem;
text-align:left;vertical-align:top;white-space:nowrap}td.long{white-space:normal;min-width:16rem}svg{max-width:100%;height:auto}
@media screen and (prefers-color-scheme:dark){body{background:#14181c;color:#e6ebf0}td,th{border-color:#39434d}figure{background:#fff}}"""
LONG = 40  # letters from which a cell breaks its lines


def heading(level, words):
    return ("heading", level, words)


def text(words):
    return ("text", words)


def items(lines):
    return ("items", list(lines))


def table(head, rows):
    return ("table", head, rows)


def picture(file, words):
    return ("picture", file, words)


def as_markdown(blocks):
    return "\n\n".join(markdown_block(*block) for block in blocks) + "\n"


def markdown_block(kind, *parts):
    if kind == "heading":
        return f"{'#' * parts[0]} {parts[1]}"
    if kind == "text":
        return parts[0].strip()
    if kind == "items":
        return "\n".join(f"- {line}" for line in parts[0])
    if kind == "picture":
        return f"![{parts[1]}]({parts[0]})"
    lines = [parts[0], ["---"] * len(parts[0]), *parts[1]]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)


def as_html(blocks, pictures):
    """`pictures`: SVG by the names that blocks use."""
    title = html.escape(blocks[0][2])
    body = "\n".join(html_block(pictures, *block) for block in blocks)
    return f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>\n{body}\n</html>\n'


def inline(words):
    return re.sub(r"\*([^*]+)\*", r"<em>\1</em>", re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(words, quote=False)))


def html_block(pictures, kind, *parts):
    if kind == "heading":
        return f"<h{parts[0]}>{inline(parts[1])}</h{parts[0]}>"
    if kind == "text":
        return f"<p>{inline(parts[0])}</p>"
    if kind == "items":
        return "<ul>" + "".join(f"<li>{inline(line)}</li>" for line in parts[0]) + "</ul>"
    if kind == "picture":
        drawing = pictures[parts[0]]
        return f'<figure aria-label="{html.escape(parts[1])}">{drawing[drawing.index("<svg"):]}</figure>'
    head = "".join(f"<th>{inline(cell)}</th>" for cell in parts[0])
    rows = "".join("<tr>" + "".join(f'<td{" class=long" if len(cell) > LONG else ""}>{inline(cell)}</td>' for cell in row) + "</tr>\n"
                   for row in parts[1])
    return f"<table tabindex=\"0\"><tr>{head}</tr>\n{rows}</table>"
