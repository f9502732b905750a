# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the stubs of those modules of clatter whose names are the program's: in calls, commands and evidence each key of
scenes is a keyword argument, in fields each name of a result's JSON an attribute.

Usage: stubs.py FOLDER, with the built module in PYTHONPATH.
"""

import inspect
import sys
import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import clatter
from clatter import calls, commands, evidence, fields
from clatter.arguments import KEYS

HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
"""Made from the keys of scenes when the module is built."""

from collections.abc import Iterable, Mapping
from typing import Any, Literal, overload

from clatter.arguments import (Axis, MapQuantity, Model, Over, Part, Parts, Path, Probes, Progress, Scene, Scenes, ShockRows, Swept,
                               SweepRows)
from clatter.arrays import Array
from clatter.findings import (Atlas, Explanation, Gradient, Measured, Plan, Problem, Ranking, Rows, Scored, Summary, Table,
                              Tradeoff)
from clatter.results import Comparison, Sequence, Simulation, Verification

'''
FIELDS_HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
"""Made from results of the program when the module is built."""

from typing import Any

from clatter.arrays import Array
from clatter.records import Values

'''


NOTHING = "None"  # of samples none of which has a value


def declaration(name: str, function: Any) -> str:
    """The function with its own parameters as they are written, and the keys; of a sweep one with and one without summary, of a
    map one with samples, whose quantity is NAME=CLASS, and one without."""
    own = inspect.signature(inspect.unwrap(function))
    changes = own.parameters.get("changes")
    swept = changes is not None and changes.annotation == "SweptKey"

    def declared(is_other: bool | None, returned: str) -> str:
        parameters = []
        for one in inspect.signature(function).parameters.values():
            known = own.parameters.get(one.name)
            annotation = known.annotation if known else "Swept | None" if swept else f"{KEYS[one.name].type_name()} | None"
            default = "" if one.default is one.empty else f" = {one.default!r}"
            if one.name == "summary" and is_other is not None:
                annotation, default = f"Literal[{is_other}]", "" if is_other else default
            if one.name == "samples" and is_other is not None:
                annotation, default = ("int", "") if is_other else ("None", default)
            if one.name == "quantity" and is_other is False:
                annotation = "MapQuantity"
            if one.kind is one.KEYWORD_ONLY and "*" not in parameters:
                parameters.append("*")
            parameters.append(f"{one.name}: {annotation}{default}")
        return f"def {name}(\n    " + ",\n    ".join(parameters) + f",\n) -> {returned}: ...\n" if parameters else \
            f"def {name}() -> {returned}: ...\n"
    if "summary" in own.parameters:
        return f"@overload\n{declared(False, 'Rows')}@overload\n{declared(True, 'Summary')}"
    if "quantity" in own.parameters:
        return "".join(f"@overload\n{declared(is_other, own.return_annotation)}" for is_other in (False, True))
    return declared(None, own.return_annotation)


def stub(module: ModuleType) -> str:
    """Of the module's public functions."""
    functions = {name: value for name, value in vars(module).items()
                 if inspect.isfunction(value) and value.__module__ == module.__name__ and not name.startswith("_")}
    return HEAD + "".join(declaration(*item) for item in functions.items())


def type_of(values: list[Any]) -> str:
    """What the values of one name are."""
    def one(value: Any) -> str:
        name = type(value[0] if isinstance(value, list) else value).__name__
        if name == "ndarray" or isinstance(value, list) and name == "float":
            return "Array"  # without NumPy a list
        name = {"dict": "dict[str, Any]"}.get(name, name)
        return f"list[{name}]" if isinstance(value, list) else name
    known = {one(value) for value in values if value is not None and not (isinstance(value, list) and not value)}
    if not known:
        return NOTHING
    return " | ".join(sorted(known - ({"int"} if "float" in known else set())) + (["None"] if any(value is None for value in values) else []))


def fields_of(samples: Iterable[Any]) -> dict[str, str]:
    """The names of records of one class, and what they are: of the JSON, and where a table has them its columns, of which each
    error may be unknown."""
    records = list(samples)
    own = dict.fromkeys(name for record in records for name in record._raw)
    names = own | dict.fromkeys(name for record in records for name in record if name.isidentifier())
    kinds = {name: type_of([record[name] for record in records if name in record]) for name in names}
    return {name: "float | None" if name not in own and name.endswith("_error") else kind for name, kind in kinds.items()}


def samples() -> Mapping[str, list[Any]]:
    """Records of each class, of drops that differ in what there is to say."""
    rest = clatter.sequence(0, gravity=9.81, restitution=0.5, friction=0.3)
    sequences = [clatter.sequence(angle=10), clatter.sequence("phone-corner", friction=0.3), rest, clatter.sequence("cube"),
                 clatter.sequence("coin"), clatter.sequence("die")]
    simulated = [clatter.simulate("phone-corner", impacts=3), clatter.simulate("bracket", impacts=1)]
    explanation, plan = clatter.explain(2, 10), clatter.plan("phone-corner", digits=3)
    runs = [*sequences, *simulated]
    point = {"probe": {"camera": (0.048, 0.016, 0.0095)}, "impacts": 1, "drops": 4}
    answers = [clatter.report("phone-damped", **point, sensitivity=False), clatter.report("phone-damped", **point, part=(500, 300)),
               clatter.report("phone-damped", **point, model="discrete", part=(500, 300)), clatter.report("phone-damped", impacts=1, drops=0)]
    return {
        "ImpactErrors": [impact.error_estimate for run in runs for impact in run],
        "Impact": [impact for run in sequences for impact in run],
        "SimulatedImpact": [impact for run in simulated for impact in run],
        "Accuracy": [run.accuracy for run in runs], "Answer": [worst.answer for worst in answers], "Cost": [run.cost for run in runs],
        "Tail": [run.tail for run in sequences if run.tail],
        "Check": list(clatter.verify(["C1", "E1", "X1"])), "Rung": list(plan), "Choice": [plan.choice],
        "Equation": [equation for step in explanation.steps for equation in step.equations], "Step": explanation.steps,
    }


def fields_stub() -> str:
    """Of the records, each a class with its names; an error may be unknown."""
    records = samples()
    found = {name: fields_of(some) for name, some in records.items()}
    found["Answer"] = {name: kind if all(name in worst for worst in records["Answer"]) else f"{kind} | None"
                       for name, kind in found["Answer"].items()}
    found["ImpactErrors"] = {name: "float | None" if kind == "float" else kind for name, kind in found["ImpactErrors"].items()}
    discrete, simulated = found["Impact"], found["SimulatedImpact"]
    for name in discrete.keys() & simulated.keys():
        if discrete[name] == NOTHING:  # of the other model alone
            discrete[name] = f"{simulated[name]} | None"
        else:
            kinds = dict.fromkeys(f"{discrete[name]} | {simulated.pop(name)}".split(" | "))
            discrete[name] = " | ".join(sorted(kinds, key=lambda kind: kind == "None"))
    text = FIELDS_HEAD
    for name, value in vars(fields).items():
        if name in found:
            text += f"class {name}({value.__base__.__name__}):\n"
            kinds = {field: "float | None" if kind == NOTHING else kind for field, kind in found[name].items()}
            text += "".join(f"    {field}: {kind}\n" for field, kind in kinds.items()) + "\n"
    return text


if __name__ == "__main__":
    warnings.simplefilter("ignore", clatter.ClatterWarning)
    made = {module: stub(module) for module in (calls, commands, evidence)} | {fields: fields_stub()}
    for module, text in made.items():
        Path(sys.argv[1], f"{module.__name__.rpartition('.')[2]}.pyi").write_text(text, encoding="utf-8")
