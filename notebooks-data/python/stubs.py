# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the stubs of clatter.calls and clatter.commands, in which each key of scenes is a keyword argument.

Usage: stubs.py FOLDER, with the built module in PYTHONPATH.
"""

import inspect
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

from clatter import calls, commands
from clatter.arguments import KEYS

HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
"""Made from the keys of scenes when the module is built."""

from collections.abc import Iterable, Mapping
from typing import Literal

from clatter.arguments import Path, Probes, Progress, Scene, Swept
from clatter.arrays import Array
from clatter.findings import Explanation, Gradient, Plan, Rows, Scored, Table, Tradeoff
from clatter.results import Comparison, ComparisonSweep, Sequence, Simulation, Sweep

'''


def declaration(name: str, function: Any) -> str:
    """The function with its own parameters as they are written, and the keys."""
    own = inspect.signature(function.__wrapped__)
    changes = own.parameters.get("changes")
    swept = changes is not None and changes.annotation == "SweptKey"
    parameters = []
    for one in inspect.signature(function).parameters.values():
        declared = own.parameters.get(one.name)
        annotation = declared.annotation if declared else "Swept | None" if swept else f"{KEYS[one.name].type_name()} | None"
        if one.kind is one.KEYWORD_ONLY and "*" not in parameters:
            parameters.append("*")
        parameters.append(f"{one.name}: {annotation}" + ("" if one.default is one.empty else f" = {one.default!r}"))
    return f"def {name}(\n    " + ",\n    ".join(parameters) + f",\n) -> {own.return_annotation}: ...\n"


def stub(module: ModuleType) -> str:
    """Of the module's public functions."""
    functions = {name: value for name, value in vars(module).items()
                 if inspect.isfunction(value) and value.__module__ == module.__name__ and not name.startswith("_")}
    return HEAD + "".join(declaration(*item) for item in functions.items())


if __name__ == "__main__":
    for module in (calls, commands):
        name = module.__name__.rpartition(".")[2]
        Path(sys.argv[1], f"{name}.pyi").write_text(stub(module), encoding="utf-8")
