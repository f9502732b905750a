# SPDX-License-Identifier: GPL-3.0-or-later
"""Docstrings are plain text; here they become what Sphinx reads.

A paragraph of lines "name: meaning" lists parameters, ">>> " begins an example, and all else is prose.
"""

import inspect
import re

PARAMETER = re.compile(r"([a-z_]+(?:, [a-z_]+)*): (.*)")


KEYS = "Keys of the scene:"


def plain(text):
    """Without marks that Sphinx would read."""
    return re.sub(r"([*`|\\]|_\b)", r"\\\1", text)


def rewritten(lines):
    if KEYS in lines:  # the list of them is a page
        lines = [*lines[:lines.index(KEYS)], ""]
    example = False
    described = False  # the line before belongs to a parameter
    for line in lines:
        example = line.startswith(">>> ") or (example and bool(line.strip()))
        parameter = PARAMETER.fullmatch(line)
        if example:
            yield line
            continue
        if parameter and not described:
            yield ""
        described = bool(parameter) or (described and bool(line.strip()))
        if parameter:
            yield f":param {parameter[1]}: {plain(parameter[2])}"
        else:
            yield ("    " if described else "") + plain(line)


def process_docstring(app, what, name, thing, options, lines):
    has_keys = KEYS in lines
    lines[:] = list(rewritten(lines))
    if has_keys:
        lines += ["", "Further arguments are :doc:`keys of the scene <keys>`.", ""]


def process_signature(app, what, name, thing, options, signature, returned):
    """Keys of scenes stand in a table of their own, so that a signature names what belongs to the function alone."""
    if what != "function":
        return None
    own = inspect.signature(getattr(thing, "__wrapped__", thing))
    parameters = [one.replace(annotation=one.empty) for one in own.parameters.values()]
    return str(inspect.Signature(parameters)), None


def setup(app):
    app.connect("autodoc-process-docstring", process_docstring)
    app.connect("autodoc-process-signature", process_signature)
    return {"parallel_read_safe": True}
