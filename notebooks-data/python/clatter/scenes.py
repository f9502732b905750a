# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes in the forms that Python has for them."""

from __future__ import annotations

import os
import re
import tomllib
import warnings
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeVar

from clatter import _clatter
from clatter.arguments import KEYS, Scene, checked, is_list, is_number, number_text, plain, text_of
from clatter.errors import BadArgument, BadInput, ClatterWarning, NotComputed, OutsideModel
from clatter.words import by_arguments, in_python, shown

Returned = TypeVar("Returned")


class SceneText(NamedTuple):
    """A scene for the compiled part: a file's name, or a text with the name that messages call it, and what takes the
    place of its keys."""

    name: str
    text: str | None
    changes: dict[str, str]


def toml_value(key: str, value: Any) -> str:
    """A number, truth, text or list in TOML."""
    value = plain(value)
    if isinstance(value, str):
        return '"' + "".join(c if c.isprintable() and c not in '"\\' else f"\\U{ord(c):08X}" for c in value) + '"'
    if isinstance(value, bool):
        return "true" if value else "false"
    if is_number(value):
        return number_text(value)
    if is_list(value):
        return "[" + ", ".join(toml_value(key, item) for item in value) + "]"
    if isinstance(value, Mapping):  # in a list, as probes are
        return "{ " + ", ".join(toml_lines(value)) + " }"
    raise BadArgument(f"{key} = {shown(value)}: must be a number, a truth, a text or a list")


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


def scene_text(scene: Scene | float | None, changes: Mapping[str, Any]) -> SceneText:
    """The scene, which may be an angle, and the keys that change.  @raise BadInput: neither a file nor a case."""
    texts = {name: text_of(name, KEYS[name], value) for name, value in changes.items() if value is not None}
    if scene is None:
        return SceneText("", None, texts)
    if is_number(scene):
        if "angle" in texts:
            raise BadInput(f"angle {shown(changes['angle'])}: given twice")
        return SceneText("", None, texts | {"angle": number_text(scene)})
    if isinstance(scene, Mapping):
        return SceneText("scene", "\n".join(toml_lines({k: v for k, v in scene.items() if k != "file"})), texts)
    name = os.fspath(scene)  # type: ignore[arg-type]
    known = _clatter.cases()
    if isinstance(scene, str) and name in known and not os.path.exists(name):
        return SceneText(f"validation/cases/{name}.toml", known[name], texts)
    if os.sep not in name and not name.endswith(".toml") and not os.path.exists(name):
        raise BadInput(f"scene '{name}': neither a file nor a case{_near_case(name)}")
    return SceneText(name, None, texts)


def _near_case(name: str) -> str:
    near = re.sub(r"(?<=mean )(.*)(?=\?)", r"'\1'", _clatter.suggestion(name, cases()))
    return f"{near or ';'} clatter.cases() lists them"


def cases() -> list[str]:
    """Names of the scenes that come with clatter: simulate("phone-damped")."""
    return list(_clatter.cases())


@checked
def case(name: str) -> dict[str, Any]:
    """A scene that comes with clatter, as a dict to change and to give to simulate() or compare().

    >>> scene = case("rod-45")
    >>> scene["ground"]["damping"] = 1e8
    """
    known = _clatter.cases()
    if name not in known:
        raise BadInput(f"case '{name}': there is none{_near_case(name)}")
    return tomllib.loads(known[name])


def called(function: Callable[..., Returned], *arguments: Any, given: Mapping[str, Any] | None = None,
           renamed: Mapping[str, str] | None = None) -> Returned:
    """The compiled function's result, its complaints in the words of Python: arguments as they were given; renamed: flags that have
    other names here."""
    try:
        return function(*arguments)
    except (BadInput, NotComputed, OutsideModel) as error:
        words = in_python(re.sub(r"^scene(:\d+:\d+)?: ", "", str(error)), given, renamed)
        raise type(error)(words) from None


def warn(words: str, stacklevel: int) -> None:
    """What the program says beside a result, in the words of Python, of a line so many calls above."""
    warnings.warn(by_arguments(in_python(words.removeprefix("warning: "))), ClatterWarning, stacklevel=stacklevel + 1)
