# SPDX-License-Identifier: GPL-3.0-or-later
"""Shock, ground, report, atlas and map: the program's commands, with arguments by the names of their flags."""

from __future__ import annotations

import os
import re
import tempfile
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path as FilePath
from typing import Any, TypeVar

from clatter import _clatter
from clatter.arguments import (KEYS, AnyKey, Axis, Model, Over, Parts, Path, Probes, Scene, Scenes, ShockRows, Swept, SweptKey, checked,
                               frequencies_text, is_list, is_number, key_of, part_texts, plain, probe_texts, set_texts, swept_text,
                               text_of, texts_of)
from clatter.arrays import Array, numpy_for
from clatter.errors import BadArgument, BadInput, NotComputed
from clatter.findings import Atlas, Ranking, Table
from clatter.results import Report
from clatter.scenes import called, cases, scene_text, toml_lines, warn
from clatter.words import shown


OneTable = TypeVar("OneTable", bound=Table)


def _file_of(scene: Scene, changes: Mapping[str, Any], folder: str) -> str:
    """A scene file or case as it is; what is no text, or has keys without a flag, as a file in the folder."""
    if isinstance(scene, Mapping):
        table: dict[str, Any] = {name: value for name, value in scene.items() if name != "file"}
    elif not changes:
        return os.fspath(scene)
    else:
        name, text, _ = scene_text(scene, {})
        table = tomllib.loads(text if text is not None else FilePath(name).read_text(encoding="utf-8"))
    lines = toml_lines(table)
    for key, value in changes.items():
        lines = [line for line in lines if not line.startswith(f"{key} = ")] + toml_lines({key: value})
    path = os.path.join(folder, "scene.toml")
    FilePath(path).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def _word(name: str, value: Any, command: str) -> str:
    """The value of a flag; of a report, which takes several, those of each case."""
    key = KEYS[name]
    if command == "report" and key.kind in ("number", "whole", "name"):
        return swept_text(key.key, value, name)
    if key.kind == "truth" and not isinstance(plain(value), bool):
        raise BadArgument(f"{name} {shown(value)}: must be {key.requirement()}")
    text = text_of(name, key, value)
    return text.replace("x", ",") if key.kind == "list" and name != "size" else text


def _run(command: str, scene: Scene | Scenes | float | None, changes: Mapping[str, Any], options: Mapping[str, Any],
         words: Iterable[str] = (), **others: Any) -> Report | None:
    """The command with its options and what else is typed for it, which messages show as the others that were given."""
    words = [*words, *_options(options)]
    given = {name: value for name, value in changes.items() if value is not None}
    if isinstance(scene, (int, float)):
        if "angle" in given:
            raise BadInput(f"angle {shown(given['angle'])}: given twice")
        given, scene = {"angle": scene, **given}, None
    without_flag = {}
    for name, value in given.items():
        key = KEYS[name]
        text = _word(name, value, command)
        is_off = key.flag.startswith("--no-")
        if not key.flag or key.kind == "truth" and plain(value) == is_off:
            if key.kind != "truth" or not key.flag or scene is not None:  # else it is the default
                without_flag[key.key] = value
        elif key.kind != "truth":
            words.append(f"{key.flag}={text}")
        else:
            words.append(key.flag)
    with tempfile.TemporaryDirectory() as folder:
        if is_list(scene):
            if without_flag:
                raise BadArgument(f"{next(iter(without_flag))}: must stand in each of several scenes")
            words += [os.fspath(one) for one in scene]  # type: ignore[union-attr]
        elif scene is not None or without_flag:
            words.append(_file_of({} if scene is None else scene, without_flag, folder))  # type: ignore[arg-type]
        try:
            report, said = called(_clatter.run_command, command, words, given={**others, **options, **given})
        except BadInput as error:
            raise BadInput(re.sub(re.escape(folder) + r"/scene\.toml(:\d+:\d+)?: ", "", str(error))) from None
    if said and report is not None and command != "report" and not report.rows():
        raise NotComputed("; ".join(said))
    for reason in said:
        if not reason.startswith(f"{options.get('output')}: "):  # what a page that was written has come to
            warn(reason, 4)
    return report


def _options(given: Mapping[str, Any]) -> list[str]:
    """The options of a command that were given."""
    texts = texts_of({name: value for name, value in given.items() if not isinstance(value, bool)}
                     | ({"frequencies": frequencies_text(given["frequencies"])} if "frequencies" in given else {}))
    truths = [f"--{name.replace('_', '-')}" for name, value in given.items() if value is True]
    return truths + [f"--{name.replace('_', '-')}={text}" for name, text in texts.items()]


def _without_sensitivity(sensitivity: bool) -> dict[str, bool]:
    return {} if sensitivity else {"no_sensitivity": True}


def _at_points(probe: str | Iterable[str] | Probes | None, part: Parts | None) -> list[str]:
    return [*(f"--probe={text}" for text in probe_texts(probe)), *(f"--part={text}" for text in part_texts(part))]


def _table(report: Report | None, kind: type[OneTable] = Table) -> OneTable:  # type: ignore[assignment]
    assert report is not None
    return kind(report)


@checked
def shock(
    scene: Scene | float | None = None,
    *,
    probe: str | Iterable[str] | Probes | None = None,
    model: Model | None = None,
    axis: Axis | None = None,
    quality: str | float | None = None,
    frequencies: str | Iterable[float] | None = None,
    first: int | None = None,
    severity: float | None = None,
    part: Parts | None = None,
    sensitivity: bool = True,
    rows: ShockRows | None = None,
    rate: float | None = None,
    measured: Path | None = None,
    column: str | None = None,
    unit: str | None = None,
    against: Path | None = None,
    **changes: AnyKey,
) -> Table:
    """What the impacts of a drop do to points of the body: peaks, changes of velocity, response spectra, damage boundary.

    scene and keys as for simulate().  probe: {"camera": (x, y, z)} in m from the geometric centre, or texts NAME:X,Y,Z.
    model: "discrete" or "continuous".  rows: "impact" (what they are without), "spectrum" or "pulse"; to_dict() has all.  rate [Hz]:
    rows are the history.  part: what the part at a probe bears, (500, 300) or "500:300", Hz and g, "300g" or "40g:11ms"; several of
    these, or {"camera": (500, 300)}, those of each probe.
    frequencies: (low, high, count) of the spectra [Hz].
    sensitivity: how peaks follow the ground's numbers, by four more runs.  first: so many impacts are the first ones.
    measured: accelerations of a logger (CSV) in place of a drop; its column and unit; against: a scene beside it.
    Raises BadInput, OutsideModel, NotComputed; warns of a run that ended early.

    >>> clatter.shock("phone-damped", probe={"camera": (0.048, 0.016, 0.0095)}, impacts=1)["peak"]
    """
    options = {"model": model, "axis": axis, "quality": quality, "frequencies": frequencies, "first": first,
               "severity": severity, **_without_sensitivity(sensitivity), "rows": rows, "rate": rate,
               "measured": measured and os.fspath(measured), "column": column, "unit": unit,
               "against": against and os.fspath(against)}
    return _table(_run("shock", scene, changes, options, _at_points(probe, part), probe=probe, part=part))


@checked
def ground(
    scene: Scene | float | None = None,
    *,
    measured_e: float | None = None,
    contact_time: float | None = None,
    peak_force: float | None = None,
    indentation: float | None = None,
    modulus: float | None = None,
    poisson: float | None = None,
    footprint: float | None = None,
    thickness: float | None = None,
    floor: str | None = None,
    **changes: AnyKey,
) -> Table:
    """k_G and c_G of the ground from two measurements of a drop (measured_e, contact_time, peak_force, indentation), or from
    its material: modulus and poisson with a footprint or the thickness of a layer, or a floor by name.

    scene and keys as for simulate().  Raises BadInput, NotComputed.

    >>> clatter.ground(body="box", size=(0.15, 0.075, 0.008), mass=0.18, orientation=19, clearance=1, floor="concrete")
    """
    options = {"measured_e": measured_e, "contact_time": contact_time, "peak_force": peak_force, "indentation": indentation,
               "modulus": modulus, "poisson": poisson, "footprint": footprint, "thickness": thickness, "floor": floor}
    return _table(_run("ground", scene, changes, options))


@checked
def report(
    scene: Scene | Scenes | float | None = None,
    *,
    output: Path | None = None,
    probe: str | Iterable[str] | Probes | None = None,
    model: Model | None = None,
    axis: Axis | None = None,
    quality: str | float | None = None,
    frequencies: str | Iterable[float] | None = None,
    first: int | None = None,
    severity: float | None = None,
    part: Parts | None = None,
    sensitivity: bool = True,
    drops: int | None = None,
    scatter: float | None = None,
    rank_by: str | None = None,
    **changes: SweptKey,
) -> Ranking | Any:
    """The worst of all attitudes of a drop, and what it does: as a Ranking, or, with output, as the page FILE.html, whose path is
    returned then.

    Arguments as for shock(); drops and scatter [°]: of the random attitudes; rank_by: a column of sweep()'s rows.
    scene: also a list of files and names of cases.  A number or name of the scene may be several, floor_restitution=[0.3, 0.5],
    floor=("concrete", "wood"): each scene with each of these is a case and a row, the worst first.
    Raises BadInput, OutsideModel, NotComputed; warns of a run that ended early.
    """
    options = {"model": model, "axis": axis, "quality": quality, "frequencies": frequencies, "first": first,
               "severity": severity, **_without_sensitivity(sensitivity), "drops": drops, "scatter": scatter,
               "rank_by": rank_by, "output": output and os.fspath(output), "format": None if output else "json"}
    made = _run("report", scene, changes, options, _at_points(probe, part), probe=probe, part=part)
    return Ranking(made) if made is not None else FilePath(os.fspath(output or ""))


@checked
def atlas(scene: Scene | None = None, *, plane: bool = False, **changes: AnyKey) -> Atlas:
    """Clattering close to flat, in closed form.

    scene: "rod", "box", "cube", "square", "rectangle", "triangle", "phone", or a scene as for sequence().  plane: of a box
    or mesh, tilts in the plane y = 0 alone.

    >>> clatter.atlas("rod")
    """
    name = scene if isinstance(scene, str) and scene not in cases() and not os.path.exists(scene) else None
    return _table(_run("atlas", None if name else scene, changes, {"plane": plane}, [name] if name else []), Atlas)


@checked
def map(
    scene: Scene | None = None,
    over: Over | None = None,
    values: Mapping[str, Swept] | None = None,
    *,
    quantity: str = "impacts",
    size: Iterable[float] = (80, 60),
    samples: int | None = None,
    seed: int | None = None,
    **changes: SweptKey,
) -> Array:
    """A quantity over two keys of a scene, as an array, upward and across; NaN where rounding leaves a number open or there is
    none, inf for infinitely many impacts.

    quantity="outcome" gives texts: "ends", where so many impacts are all; "goes on", where more follow than are looked at;
    "infinite", where infinitely many follow in a finite time; "stays", where an end stays on the ground; "open", where
    rounding or a fold does not tell; "refused", "outside-model", "not-computed", where there is no drop.

    over: two keys with their ranges, {"angle": (0, 60), "restitution": "0.1:1:log"}, by the names that sequence() takes or
    by those of scene files ("drop.angle_deg"), across and upward; each number is that of the middle of its part of the range.
    values: of other keys, as for sweep(), with
    samples ranges, too, or as arguments by the names that sequence() takes.  quantity: "impacts", "ratio" (of the second impulse to
    the first), "total", "loss" ..., with samples "NAME=CLASS", the share of that class; then the first axis is share, least and most
    (Wilson's).  size: across and upward; a body's size is values={"body.size": ...}.  Up to 100 impacts are followed, or as many as
    impacts says.
    Raises BadInput; warns of pixels that could not be computed.

    >>> clatter.map(over={"drop.angle_deg": (1, 60), "impact.restitution": (0.2, 0.9)}, body="rod", gravity=9.81, quantity="ratio")
    """
    numpy = numpy_for("map()")
    sets = set_texts(values, changes)
    sides = [int(side) if side == side // 1 else 0 for side in size]
    if len(sides) != 2 or min(sides) < 1:
        raise BadArgument(f"size {shown(size)}: must be the map's width and height in pixels, as (80, 60); that of a body is "
                          'values={"body.size": ...}')
    if len(over or {}) != 2:
        raise BadArgument(f"over{'' if over is None else ' ' + shown(over)}: must be two keys with their ranges, across and upward, "
                          'as {"angle": (0, 60), "restitution": (0.2, 0.9)}')
    words = [f"--quantity={quantity}", f"--size={sides[0]}x{sides[1]}"]
    for name, bounds in (over or {}).items():
        pair = bounds if isinstance(bounds, str) else [text_of(name, None, bound) for bound in bounds] if is_list(bounds) else []
        if len(pair) != 2 and not isinstance(bounds, str):
            raise BadArgument(f"over {name} {shown(bounds)}: must be (low, high), or a text as \"0.1:1:log\"")
        words.append(f"--over={key_of(name)}={pair if isinstance(pair, str) else ':'.join(pair)}")
    words += [f"--set={text}" for text in sets]
    with tempfile.TemporaryDirectory() as folder:  # the array is a file's
        path = os.path.join(folder, "map.npy")
        _run("map", scene, {}, {"samples": samples, "seed": seed}, [*words, f"--output={path}"], quantity=quantity, **(values or {}), **changes)
        if not os.path.exists(path):
            raise BadArgument("map: was interrupted")
        array: Array = numpy.load(path)
    return array.astype(str) if array.dtype.kind == "S" else array
