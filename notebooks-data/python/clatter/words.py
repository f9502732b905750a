# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program says, in the words of Python: arguments in place of flags, their values as Python writes them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from clatter import _clatter

_KEYS = _clatter.keys()
_ARGUMENT_OF = {row["key"]: row["argument"] for row in _KEYS}
_NAMES_OF: dict[str, list[str]] = {row["argument"]: row["names"] for row in _KEYS}
_CHOICES: dict[str, list[str]] = {"model": ["discrete", "continuous"], "unit": ["g", "m/s2", "mm", "cm", "m", "in"],
                                  "rows": ["impact", "scene", "spectrum", "pulse"]}
_FUNCTION_OF = {"shock --ground": "ground", "angles --regimes": "regimes", "plan --tradeoff": "tradeoff", "verify --extremes": "extremes",
                "verify --figures": "figure"}
_FUNCTIONS = {*_clatter.command_options(), *_FUNCTION_OF.values(), "angles", "verify"}
# A command in a sentence: no scene follows, and of its options at most the words for their values.
_COMMAND = (r"\bclatter\s+(shock\s+--ground|angles\s+--regimes|plan\s+--tradeoff|verify\s+--extremes|verify\s+--figures|[a-z]+)\b"
            r"((?:\s+--[a-z-]+(?:\s+[A-Z][A-Z0-9/]*\b)?)*)(?=[;:,.)]|\s(?!\s*--|[0-9\"'{])|$)(?!\s+--)")
_MOST_SHOWN = 60  # characters of a value in a message
ARGUMENTS_OF: dict[str, frozenset[str]] = {}  # of each function, which says them when it is made


def _arguments_of_flags(found: re.Match[str]) -> str:
    """Flags with their values, as a call has them."""
    words = found["flags"].split()
    pairs = [(flag.removeprefix("--").replace("-", "_"), value.strip("'")) for flag, value in zip(words[::2], words[1::2])]
    return "or as arguments: " + ", ".join(f"{name}={value}" if _is_number(value) else f'{name}="{value}"' for name, value in pairs)

# Forms of the command line, and what Python has for them.
_FORMS: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"(?<=--probe )NAME:X,Y,Z\b|(?<=as )NAME:X,Y,Z\b|(?<=must be )NAME:X,Y,Z\b", '{"NAME": (x, y, z)}'),
    (r"or as flags:(?P<flags>(?:\s+--[a-z-]+\s+[^\s-]\S*)+)", _arguments_of_flags),
    (r"(further\s+contacts\s+like\s+these\s+are\s+in)\s+JSON\b", r"\1 .contacts"),
    (r"(further\s+landings\s+like\s+these\s+are\s+in)\s+JSON\b", r"\1 .outcomes"),
    (r"JSON\s+of\s+sequence\s+has\s+all\b", "sequence(...).outcomes has all"),
    (r"\bLOW:HIGH:COUNT\b", "(low, high, count)"), (r"\bHIGH must be greater than LOW\b", "high must be greater than low"),
    (r"\bHZ:G\b", "(Hz, g)"), (r"(?<=as )500:300(?= or )", "(500, 300)"),
    (r"as in ([-\d.e]+(?:[,:][-\d.e]+)+)", lambda found: f"as in ({', '.join(re.split('[,:]', found[1]))})"),
    (r"with the flag it acts in flight only", "False: in flight alone"),
    (r"\bfalse leaves (them|it) out", r"False leaves \1 out"), (r"exit status 3 if", "NotComputed if"),
    (r"and others of clatter help keys", "and others"), (r"\bis null\b", "is None"))


def shown(value: Any) -> str:
    """A value on one line, in a message."""
    text = " ".join(repr(value).split())
    return text if len(text) <= _MOST_SHOWN else text[:_MOST_SHOWN - 3] + "..."


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _of_flag(found: re.Match[str], renamed: Mapping[str, str]) -> str:
    """A flag, and what stands behind it: a value, or in capitals the word for one, or neither."""
    flag, rest = found["flag"], found["rest"] or ""
    name, value = renamed.get(flag, flag.replace("-", "_")), rest.strip()
    if flag.startswith("no-"):
        return f"{name.removeprefix('no_')}=False{rest}"
    if value.startswith("{"):
        return f"{name}={value}"
    if re.fullmatch(r"[A-Z][A-Z0-9/.,:|²³]*", value):  # the word for a value
        return name
    if value and _is_number(value):
        return f"{name}={value}"
    return f'{name}="{value}"' if value and value in _NAMES_OF.get(name, []) + _CHOICES.get(name, []) else name + rest


def _of_command(found: re.Match[str]) -> str:
    """A command's function, with what is to be given it, where it has one that takes all of that."""
    name = _FUNCTION_OF.get(" ".join(found[1].split()), found[1])
    if name not in _FUNCTIONS:
        return found[0]
    given = re.findall(r"--([a-z-]+)(?:\s+([A-Z][A-Z0-9/]*))?", found[2])
    if any(flag.replace("-", "_") not in ARGUMENTS_OF.get(name, [flag.replace("-", "_")]) for flag, _ in given):
        return f"the command line's clatter {found[1]}"
    return f"clatter.{name}({', '.join(flag.replace('-', '_') + '=' + (value or '...') for flag, value in given)})"


def _echoed(text: str, given: Mapping[str, Any], renamed: Mapping[str, str]) -> str:
    """What a message begins with, "--angle '100': ", as it was given: the argument's own value, a number without quotes."""
    found = re.match(r"(?s)(?P<flag>--)?(?P<set>set |over )?(?P<name>[\w.-]+)[ =](?P<value>'.*?'|\S+)(?=: )", text)
    if not found or not (found["flag"] or found["name"] in _NAMES_OF):
        return text
    name, value = found["name"], found["value"].strip("'")
    name = name if "." in name else renamed.get(name, name.replace("-", "_"))
    if given.get(_ARGUMENT_OF.get(name, "")) is not None:
        name = _ARGUMENT_OF[name]
    if given.get(name) is not None and not _is_number(value):
        value = shown(given[name])
    elif not _is_number(value):
        value = found["value"]
    return f"{name} {value}{text[found.end():]}"


def in_python(text: str, given: Mapping[str, Any] | None = None, renamed: Mapping[str, str] | None = None) -> str:
    """What the program says, with arguments as they were given; renamed: flags that have other names here.

    A command that can be typed stays as it is.
    """
    said, is_of_argument = text, text.startswith("--")
    for form, words in _FORMS:
        text = re.sub(form, words, text)
    text = _echoed(text, given or {}, renamed or {})
    text = re.sub(r"^(?:--)?(?:set|over) (?=[a-z_]+[.:])", "", text)
    if any("--" in re.split(r"[;)]|, |: ", text[found.end():])[0] for found in re.finditer(_COMMAND, text)):
        return said
    text = re.sub(_COMMAND, _of_command, text)
    if re.search(r"\bclatter [a-z]+ [^;]*--[a-z]", text):
        return said
    text = re.sub(r"\(--([a-z][a-z-]*)\)", lambda found: f"({found[1].replace('-', '_')}=)", text)
    text = re.sub(r"(?<![\w-])--(?P<flag>[a-z][a-z-]*)(?P<rest>\s+(?:\{[^}]*\}|[\w./²³,:|-]*[\w/]))?",
                  lambda found: _of_flag(found, renamed or {}), text)
    return by_arguments(text) if is_of_argument else text


def by_arguments(text: str) -> str:
    """Keys of scene files by the names that arguments have."""
    return re.sub(r"(?<![\w./-])[a-z]+(?:\.[a-z_]+)+\b(?! =)", lambda found: _ARGUMENT_OF.get(found[0], found[0]), text)


def paragraphs_in_python(text: str) -> str:
    """The same of a text for a terminal, whose long lines go on behind two blanks."""
    return "\n".join(in_python(one) for one in re.split(r"\n(?!  )", text))
