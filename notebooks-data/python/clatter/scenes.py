# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes in the forms that Python has for them, and arguments as the texts that the program checks."""

import difflib
import os
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from numbers import Integral, Real
from typing import Any, NamedTuple, TypeVar

from clatter import _clatter
from clatter.errors import BadInput

Value = str | float | bool | Iterable[float]
Scene = str | os.PathLike[str] | Mapping[str, Any]
Path = str | os.PathLike[str]
Progress = Callable[[int, int], object]  # called with (done, of) a few times a second; what it raises ends the work
Returned = TypeVar("Returned")

class SceneText(NamedTuple):
    """A scene for the compiled part: a file's name, or a text with the name that messages call it."""

    name: str
    text: str | None


def text_of(name: str, value: Any) -> str:
    """The argument as it would be typed; numbers keep all their bits."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    if isinstance(value, Iterable):
        return "x".join(repr(float(part)) for part in value)
    raise BadInput(f"{name} {value!r}: must be a number, a text or a list of numbers")


def texts_of(arguments: Mapping[str, Value | None]) -> dict[str, str]:
    """Without those that were not given."""
    return {name: text_of(name, value) for name, value in arguments.items() if value is not None}


def toml_value(key: str, value: Any) -> str:
    """A number, truth, text or list in TOML."""
    if isinstance(value, str):
        return '"' + "".join(c if c.isprintable() and c not in '"\\' else f"\\U{ord(c):08X}" for c in value) + '"'
    if isinstance(value, (bool, Integral, Real)):
        return text_of(key, value)
    if isinstance(value, Iterable):
        return "[" + ", ".join(toml_value(key, item) for item in value) + "]"
    raise BadInput(f"{key} = {value!r}: must be a number, a truth, a text or a list")


def toml_lines(table: Mapping[str, Any], prefix: str = "") -> list[str]:
    """Dotted keys; what is None is left out."""
    lines = []
    for name, value in table.items():
        key = f"{prefix}{name}"
        if isinstance(value, Mapping):
            lines += toml_lines(value, key + ".")
        elif value is not None:
            if not re.fullmatch(r"[\w.-]+", key, re.ASCII):
                raise BadInput(f"{key!r}: unknown key")
            lines.append(f"{key} = {toml_value(key, value)}")
    return lines


def scene_text(scene: Scene) -> SceneText:
    """@raise BadInput: neither a file nor a case."""
    if isinstance(scene, Mapping):
        return SceneText("scene", "\n".join(toml_lines({k: v for k, v in scene.items() if k != "file"})))
    name = os.fspath(scene)
    known = _clatter.cases()
    if isinstance(scene, str) and name in known and not os.path.exists(name):
        return SceneText(f"validation/cases/{name}.toml", known[name])
    if os.sep not in name and not name.endswith(".toml") and not os.path.exists(name):
        near = difflib.get_close_matches(name, known, 1, 0)[0]
        raise BadInput(f"scene '{name}': neither a file nor a case; did you mean '{near}'?")
    return SceneText(name, None)


def cases() -> list[str]:
    """Names of the scenes that come with clatter: simulate("phone-damped")."""
    return list(_clatter.cases())


def case(name: str) -> dict[str, Any]:
    """A scene that comes with clatter, as a dict to change and to give to simulate() or compare().

    >>> scene = case("rod-45")
    >>> scene["ground"]["damping"] = 1e8
    """
    known = _clatter.cases()
    if name not in known:
        near = difflib.get_close_matches(name, known, 1, 0)[0]
        raise BadInput(f"case '{name}': there is none; did you mean '{near}'?")
    return tomllib.loads(known[name])


def called(function: Callable[..., Returned], *arguments: Any) -> Returned:
    """The compiled function's result, its complaints in the words of Python."""
    try:
        return function(*arguments)
    except BadInput as error:
        words = re.sub(r"^scene(:\d+:\d+)?: ", "", str(error))
        words = words.replace("--from ", "start ").replace("--to ", "stop ")
        words = re.sub(r"--([a-z][a-z-]*)", lambda flag: flag[1].replace("-", "_"), words)
        raise BadInput(words) from None
