# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments: their names and types, checked, and as the texts that the program reads.

The keys of scenes are keyword arguments; their names, types and what is allowed come from the program's table of keys.
"""

from __future__ import annotations

import functools
import inspect
import os
from collections.abc import Callable, Iterable, Mapping, Set
from decimal import Decimal
from numbers import Integral, Real
from typing import Any, Literal, NamedTuple, ParamSpec, TypeVar

from clatter import _clatter
from clatter.errors import BadArgument, BadInput
from clatter.words import ARGUMENTS_OF, by_arguments, in_python, shown

Value = str | float | bool | Iterable[float]
Swept = str | float | bool | Iterable[str] | Iterable[float] | Iterable[Iterable[float]]
Path = str | os.PathLike[str]
Probes = Mapping[str, Iterable[float]]  # a place on the body by the name of each
Part = str | Iterable[float]  # (500, 300): Hz and g; or as --part has it
Parts = Part | Iterable[Part] | Mapping[str, Part | Iterable[Part]]  # one, several, or those of each probe by its name
Scene = str | os.PathLike[str] | Mapping[str, Any]
Scenes = Iterable[str | os.PathLike[str]]  # several
Model = Literal["discrete", "continuous"]
Axis = Literal["x", "y", "z"]
ShockRows = Literal["impact", "spectrum", "pulse"]
SweepRows = Literal["scene", "impact"]
MapQuantity = Literal["impacts", "last_end", "hardest", "outcome", "rest_face", "ratio", "largest", "total", "loss", "last_start"]
Over = Mapping[str, str | Iterable[float]]  # ranges of two keys
Progress = Callable[[int, int], object]  # called with (done, of) a few times a second; what it raises ends the work

_Arguments = ParamSpec("_Arguments")
_Returned = TypeVar("_Returned")


class Key(NamedTuple):
    """A key of scenes that is an argument."""

    argument: str
    key: str
    kind: str  # "number", "whole", "truth", "text", "name", "list" or "curve"
    names: list[str]
    flag: str  # of the command line, or ""
    unit: str
    allowed: str
    meaning: str
    is_discrete: bool
    is_continuous: bool

    def type_name(self) -> str:
        """As stubs have it."""
        if self.kind == "name":
            return f"Literal[{', '.join(map(repr, self.names))}]"
        return {"number": "float", "whole": "int", "truth": "bool", "text": "str", "list": "Iterable[float]",
                "curve": "str | Iterable[Iterable[float]]"}[self.kind]

    def parameter(self) -> inspect.Parameter:
        """In a signature."""
        known = {"Literal": Literal, "Iterable": Iterable}
        annotation = eval(f"{self.type_name()} | None", known)  # of the program's own names
        return inspect.Parameter(self.argument, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=annotation)

    def requirement(self) -> str:
        """What is allowed, in words."""
        return {"number": f"a number, {self.allowed}", "truth": "True or False", "text": "a text"}.get(self.kind, self.allowed)


KEYS = {key.argument: key._replace(meaning=by_arguments(in_python(key.meaning))) for key in (Key(**row) for row in _clatter.keys())}
_BY_NAME = {key.key: key for key in KEYS.values()}


def plain(value: Any) -> Any:
    """Numbers of NumPy and the like as Python's, tables of data frames as arrays."""
    if hasattr(value, "to_numpy"):
        return value.to_numpy()
    return value.item() if getattr(value, "ndim", None) == 0 and hasattr(value, "item") else value


def is_number(value: Any) -> bool:
    """Not a truth."""
    return isinstance(value, (Real, Decimal)) and not isinstance(value, bool)


def number_text(value: Any) -> str:
    """With all its bits."""
    return str(int(value)) if isinstance(value, Integral) else repr(float(value))


def is_list(value: Any) -> bool:
    """What stands for several values in an order."""
    return isinstance(value, Iterable) and not isinstance(value, (str, bytes, Mapping, Set))


def _vector(value: Any) -> list[str] | None:
    """The numbers of a list; None if something else is in it."""
    parts = [plain(part) for part in value] if is_list(value) else [None]
    return [number_text(part) for part in parts] if all(map(is_number, parts)) else None


def text_of(name: str, key: Key | None, value: Any) -> str:
    """The value of a key as it would be typed, or of any argument of numbers and texts.  @raise BadArgument: its type."""
    value = plain(value)
    kind = key.kind if key else "any"
    if isinstance(value, str):
        return value
    if isinstance(value, bool) and kind in ("truth", "any"):
        return "true" if value else "false"
    if is_number(value) and kind in ("number", "whole", "any"):
        return number_text(int(value) if kind == "whole" and value == value // 1 else value)
    if kind == "curve" and is_list(value):
        points = [_vector(plain(point)) or [] for point in value]
        return f"[{','.join('[' + ','.join(point) + ']' for point in points)}]"
    vector = _vector(value) if kind in ("list", "any") else None
    if vector is None:
        several = "; sweep() takes several" if kind in ("number", "whole") and _vector(value) else ""
        raise BadArgument(f"{name} {shown(value)}: must be {key.requirement() if key else 'a number, a text or a list of numbers'}{several}")
    return "x".join(vector)


def texts_of(arguments: Mapping[str, Any]) -> dict[str, str]:
    """Arguments that are no keys; without those that were not given."""
    return {name: text_of(name, None, value) for name, value in arguments.items() if value is not None}


def swept_text(name: str, values: Any, called: str | None = None) -> str:
    """The value or the values of a key of a scene file in a sweep, as --set has them; called: the key where it is refused.

    @raise BadInput: there is none.
    """
    values, key, is_attitude = plain(values), _BY_NAME.get(name), name == "drop.attitude"
    name = called or name
    if not is_list(values):
        return number_text(values) if is_attitude and is_number(values) else text_of(name, key, values)
    parts = [plain(part) for part in values]
    if not parts:
        raise BadInput(f"{name} {shown(values)}: must have at least one value")
    if key is not None and key.kind == "list":
        if all(map(is_number, parts)):
            return text_of(name, key, parts)
        if not is_attitude:
            raise BadArgument(f"{name} {shown(values)}: must be one list of numbers, which no sweep varies; call sweep() for each")
        vectors = [text_of(name, key, part).split("x") for part in parts]
        return ",".join(f"[{','.join(vector)}]" for vector in vectors)
    if any(map(is_list, parts)):
        raise BadArgument(f"{name} {shown(values)}: must be a value or one list of values, not a table of them")
    texts = [text_of(name, key, part) for part in parts]
    return f"{texts[0]}:{texts[0]}:1" if len(texts) == 1 and is_number(parts[0]) else ",".join(texts)


def key_of(name: str) -> str:
    """The key of scene files that an argument stands for, or the key itself."""
    return KEYS[name].key if name in KEYS else name


def set_texts(values: Mapping[str, Swept] | None, changes: Mapping[str, Any]) -> list[str]:
    """KEY=VALUES for --set, of values by the keys of scene files and of arguments by their names.  @raise BadArgument: a key of both."""
    keys = {key_of(name): name for name in values or {}}
    sets = [f"{key}={swept_text(key, (values or {})[name], name)}" for key, name in keys.items()]
    for name, value in changes.items():
        key = KEYS[name].key
        if value is not None and key in keys:
            raise BadArgument(f"{name} {shown(value)}: {key} is given, too")
        sets += [] if value is None else [f"{key}={swept_text(key, value, name)}"]
    return sets


def colons(name: str, numbers: str | Iterable[float] | None, meanings: tuple[str, ...]) -> str | None:
    """Numbers as the program has those of one thing: (500, 300) is 500:300.  @raise BadArgument: they are not so many."""
    if numbers is None or isinstance(numbers, str):
        return numbers
    several = [*numbers]
    if len(several) != len(meanings) or not all(map(is_number, map(plain, several))):
        raise BadArgument(f"{name} {shown(numbers)}: must be ({', '.join(meanings)})")
    return ":".join(map(number_text, several))


def frequencies_text(frequencies: str | Iterable[float] | None) -> str | None:
    """LOW:HIGH:COUNT."""
    return colons("frequencies", frequencies, ("low", "high", "count"))


def part_text(part: Part | None) -> str | None:
    """One part, as --part has it."""
    return colons("part", part, ("Hz", "g"))


def part_texts(parts: Parts | None) -> list[str]:
    """Each as --part has it, those of a dict behind the name of their probe."""
    if isinstance(parts, Mapping):
        return [f"{name}:{text}" for name, some in parts.items() for text in part_texts(some)]
    if parts is None or isinstance(parts, str) or all(is_number(plain(one)) for one in parts):
        return [text for text in [part_text(parts)] if text is not None]  # type: ignore[arg-type]
    return [text for one in parts for text in part_texts(one)]  # type: ignore[arg-type]


def probe_texts(probe: str | Iterable[str] | Probes | None) -> list[str]:
    """Points of a body, each as NAME:X,Y,Z."""
    if isinstance(probe, Mapping):
        return [f"{name}:{text_of('probe', None, place).replace('x', ',')}" for name, place in probe.items()]
    return [probe] if isinstance(probe, str) else list(probe or [])


# What an annotation of a function of clatter allows, and how that is called.
_TYPES: dict[str, tuple[Callable[[Any], bool], str]] = {
    "None": (lambda value: value is None, "None"),
    "bool": (lambda value: isinstance(value, bool), "True or False"),
    "int": (lambda value: isinstance(value, Integral) and not isinstance(value, bool), "a whole number"),
    "float": (is_number, "a number"),
    "str": (lambda value: isinstance(value, str), "a text"),
    "Path": (lambda value: isinstance(value, (str, os.PathLike)), "the path of a file"),
    "Scene": (lambda value: isinstance(value, (str, os.PathLike, Mapping)), "a scene (a file, the name of a case, a dict)"),
    "Progress": (callable, "a function of (done, of)"),
    "Iterable[str]": (lambda value: is_list(value) and all(isinstance(part, str) for part in value), "a list of texts"),
    "Iterable[Path]": (lambda value: is_list(value) and all(isinstance(part, (str, os.PathLike)) for part in value), "a list of paths"),
    "Parts": (lambda value: isinstance(value, str) or isinstance(value, Mapping) or is_list(value) and all(
        isinstance(plain(one), str) or is_number(plain(one)) or is_list(one) for one in value),
              "(Hz, g), a text, a list of these, or a dict of them by the names of probes"),
    "Part": (lambda value: isinstance(value, str) or is_list(value) and all(map(is_number, map(plain, value))), "(Hz, g) or a text"),
    "Scenes": (lambda value: is_list(value) and all(isinstance(one, (str, os.PathLike)) for one in value) and any(True for _ in value),
               "a list of files and names of cases"),
    "Over": (lambda value: isinstance(value, Mapping) and all(isinstance(key, str) for key in value), "a dict of ranges by the keys of scenes"),
    **{kind: (lambda value: isinstance(value, str), "a text") for kind in ("Model", "Axis", "ShockRows", "SweepRows")},
    "Mapping[str, Swept]": (lambda value: isinstance(value, Mapping) and all(isinstance(key, str) for key in value),
                            "a dict of values by the keys of scenes"),
    "Probes": (lambda value: isinstance(value, Mapping), "a dict of places by the names of probes"),
    "Iterable[float]": (lambda value: is_list(value) and all(map(is_number, map(plain, value))), "a list of numbers"),
    "Mapping[str, Array]": (lambda value: isinstance(value, Mapping), "a dict of arrays by the names of a result's"),
}


def _checked_value(name: str, value: Any, annotation: str) -> Any:
    value = plain(value)
    if is_list(value) and not hasattr(value, "__len__"):  # to be read once alone
        value = list(value)
    types = [_TYPES[part] for part in annotation.split(" | ")]
    if isinstance(value, float) and value.is_integer() and _TYPES["int"] in types and _TYPES["float"] not in types:
        value = int(value)
    if not any(allows(value) for allows, _ in types):
        words = [words for _, words in types if words != "None"]
        raise BadArgument(f"{name} {shown(value)}: must be {' or '.join(words)}")
    return value


_SYMBOLS = {"e": "restitution", "mu": "friction", "g": "gravity", "m": "mass", "L": "length", "theta": "angle", "v": "speed", "h": "height",
            "omega": "spin", "k": "stiffness"}


_MOST_OWNERS = 3


def _suggested_argument(unknown: str, value: Any, names: list[str], function: str) -> str:
    """What is said of an argument that a function does not have: which others have it, else of those that have the name as a word
    the one that takes such a value, else what is spelled alike."""
    if unknown in _SYMBOLS and _SYMBOLS[unknown] in names:
        return f"; did you mean {_SYMBOLS[unknown]}?"
    longer = [name for name in names if unknown in name.split("_")]
    fitting = [name for name in longer if name in KEYS and _clatter.suggestion(str(value), KEYS[name].names)]
    owners = sorted((other for other, arguments in ARGUMENTS_OF.items() if unknown in arguments), key=lambda one: "scene" not in ARGUMENTS_OF[one])
    if owners and not fitting:
        return f"; it belongs to {', '.join(f'{one}()' for one in owners[:_MOST_OWNERS])}{' and others' if len(owners) > _MOST_OWNERS else ''}"
    return _clatter.suggestion(unknown, fitting or longer or names) or f"; help(clatter.{function}) lists them"


_OPTIONS = _clatter.command_options()
_COMMAND_OF = {"compare_against": "compare"}  # where a function has not its command's name


def _takes(function: str, key: Key, annotation: str) -> bool:
    """Whether a function takes a key of scenes: its command has the flag, or the key has none and stands in the scene; a sweep, a
    map and a figure set any."""
    if annotation == "DiscreteKey" and not key.is_discrete:
        return False
    sets_any = annotation == "SweptKey" and function != "report"
    return sets_any or not key.flag or key.flag in _OPTIONS.get(_COMMAND_OF.get(function, function), [key.flag])


def checked(function: Callable[_Arguments, _Returned]) -> Callable[_Arguments, _Returned]:
    """The function, which refuses arguments of unknown names and wrong types on one line.

    Where it takes **changes, these are keys of scenes, those that the command of its name takes (of the discrete model, where the
    annotation is DiscreteKey), and its signature and documentation list them.
    """
    own = dict(inspect.signature(function).parameters)
    changes = own.pop("changes", None)
    keys = [key for key in KEYS.values() if changes is not None and key.argument not in own
            and _takes(function.__name__, key, changes.annotation)]
    positional = [name for name, one in own.items() if one.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD]
    names = [*own, *(key.argument for key in keys)]
    types = {name: one.annotation for name, one in own.items() if set(str(one.annotation).split(" | ")) <= _TYPES.keys()}
    known = frozenset(names)
    ARGUMENTS_OF[function.__name__] = known

    @functools.wraps(function)
    def call(*arguments: Any, **named: Any) -> Any:
        if not named.keys() <= known:
            unknown = next(name for name in named if name not in known)
            raise BadArgument(f"{unknown}: unknown argument of {function.__name__}()"
                              + _suggested_argument(unknown, named[unknown], names, function.__name__))
        given = [_checked_value(name, value, types[name]) if name in types else value for name, value in zip(positional, arguments)]
        for name in named.keys() & types.keys():
            named[name] = _checked_value(name, named[name], types[name])
        return function(*[*given, *arguments[len(given):]], **named)

    if changes is not None:
        parameters = [one for name, one in inspect.signature(function, eval_str=True).parameters.items() if name != "changes"]
        returned = inspect.signature(function, eval_str=True).return_annotation
        call.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
            [*parameters, *(key.parameter() for key in keys)], return_annotation=returned)
        lines = [f"    {key.argument}{f' [{key.unit}]' if key.unit else ''}: {key.meaning}; {key.requirement()}" for key in keys]
        call.__doc__ = "\n".join([inspect.cleandoc(function.__doc__ or ""), "", "Keys of the scene:", *lines])
    return call


# What **changes stand for: keys of scenes, in the second case those that the discrete model knows.
AnyKey = Value | None
DiscreteKey = Value | None
SweptKey = Swept | None  # values of keys, one or many
