#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the notebooks.

    notebooks-data/notebooks.py [NOTEBOOK ...]           executes them (all of notebooks/) and writes what they show
    notebooks-data/notebooks.py --check [NOTEBOOK ...]   executes them, says where the outputs differ, changes nothing
    ... --in FOLDER ...                                  they are opened there; otherwise in an empty folder

The module clatter comes from PYTHONPATH, or from build/full/python without one.  Exit status 0, or 1 if a cell fails or an output differs.
"""

import os
import re
import sys
import tempfile
from pathlib import Path

import nbformat
from nbconvert.preprocessors import CellExecutionError, ExecutePreprocessor

FOLDER = Path(__file__).resolve().parent / "notebooks"
SECONDS_PER_CELL = 120
IMAGES = ("image/svg+xml", "image/png")


def prepare_kernel(scratch):
    """Nothing of the user's own settings, nothing left behind."""
    os.environ.update(IPYTHONDIR=scratch, JUPYTER_CONFIG_DIR=scratch, JUPYTER_DATA_DIR=scratch, JUPYTER_RUNTIME_DIR=scratch,
                      MPLCONFIGDIR=scratch, PYTHONDONTWRITEBYTECODE="1", PYDEVD_DISABLE_FILE_VALIDATION="1")
    given = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    search = [Path(path).resolve() for path in given if path] or [FOLDER.parent.parent / "build" / "full" / "python"]
    os.environ["PYTHONPATH"] = os.pathsep.join(map(str, search))  # the kernel starts in another folder


def joined(outputs):
    """Text that the kernel sent in several pieces, cut anywhere, as one output."""
    whole = []
    for output in outputs:
        last = whole[-1] if whole else None
        if last and last.output_type == output.output_type == "stream" and last.name == output.name:
            last.text += output.text
        else:
            whole.append(output)
    return whole


def executed(notebook, folder):
    """The notebook with new outputs, without what changes from run to run.  @raise CellExecutionError"""
    ExecutePreprocessor(timeout=SECONDS_PER_CELL, kernel_name="python3").preprocess(notebook, {"metadata": {"path": folder}})
    notebook.metadata = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
                         "language_info": {"name": "python"}}
    for number, cell in enumerate(notebook.cells, 1):
        cell.id = f"cell-{number}"
        cell.metadata = {}
        if cell.cell_type == "code":
            cell.outputs = joined(cell.outputs)
        for output in cell.get("outputs", []):
            output.pop("execution_count", None)
            if output.output_type == "execute_result":
                output.execution_count = cell.execution_count
    return notebook


def shown(notebook):
    """The outputs of each cell as text; of pictures only that they are there."""
    def text(output):
        if output.output_type == "stream":
            return output.text
        data = output.get("data", {})
        picture = next((kind for kind in IMAGES if kind in data), None)
        return picture or data.get("text/html") or data.get("text/plain", "")
    return [[re.sub(r"0x[0-9a-f]+", "0x", text(output)) for output in cell.get("outputs", [])] for cell in notebook.cells]


def failure(error):
    """The last line of a traceback, without colours."""
    return re.sub(r"\x1b\[[0-9;]*m", "", str(error)).strip().splitlines()[-1]


def process(path, check, folder):
    """What is wrong, one line each."""
    old = nbformat.read(path, as_version=4)
    try:
        new = executed(nbformat.read(path, as_version=4), folder)
    except CellExecutionError as error:
        return [f"{path.name}: {failure(error)}"]
    if not check:
        nbformat.write(new, path)
        return []
    return [f"{path.name}: cell {number} shows something else; run notebooks-data/notebooks.py"
            for number, (before, after) in enumerate(zip(shown(old), shown(new)), 1) if before != after]


def main(arguments):
    check = "--check" in arguments
    names = [argument for argument in arguments if argument != "--check"]
    opened = ""
    if "--in" in names[:-1]:
        place = names.index("--in")
        opened = os.path.abspath(names[place + 1])
        del names[place:place + 2]
    if any(name.startswith("-") for name in names):
        print(__doc__, file=sys.stderr)
        return 2
    paths = [Path(name).resolve() for name in names] or sorted(FOLDER.glob("*.ipynb"))
    complaints = []
    with tempfile.TemporaryDirectory() as scratch:
        prepare_kernel(scratch)
        empty = Path(scratch, "empty")
        empty.mkdir()
        for path in paths:
            complaints += process(path, check, opened or str(empty))
    print("\n".join(complaints), end="\n" if complaints else "")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
