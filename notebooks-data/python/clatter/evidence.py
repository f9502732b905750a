# SPDX-License-Identifier: GPL-3.0-or-later
"""What judges the models and the programs of others: measured drops, certified problems, the map of extremes, figures."""

from __future__ import annotations

import os
from collections.abc import Iterable

from clatter import _clatter
from clatter.arguments import AnyKey, Path, Progress, checked, texts_of
from clatter.errors import BadInput
from clatter.findings import Measured, Problem, Scored, Table
from clatter.results import Verification
from clatter.scenes import called, scene_text
from clatter.words import shown

_MOST_SECONDS = 3600.0


def _measured(action: str, tracks: Path, options: dict[str, Path | float | None]) -> Measured:
    texts = {name: os.fspath(value) if isinstance(value, os.PathLike) else value for name, value in options.items()}
    return Measured(called(_clatter.measured, action, os.fspath(tracks), texts_of(texts)))


@checked
def measured_fit(
    tracks: Path,
    *,
    body: Path | None = None,
    seed: int | None = None,
    share: float | None = None,
    fit_on: str | None = None,
    fit_from: Path | None = None,
) -> Measured:
    """Restitution and friction of three impact laws, fitted to tracked drops; a row for each law.

    tracks: poses, frame by frame (CSV), or "square-drops" or "cube-tosses", which come with clatter.
    body: what was tracked, a TOML file or one of those names (the file of the same name that ends in .toml).
    seed (1), share (0.5): of the drops that are drawn to fit on; or fit_on: these, as in "1,3,10-20"; or fit_from:
    another file, all of which is fitted on.  Raises BadInput.
    """
    options: dict[str, Path | float | None] = {"body": body, "seed": seed, "share": share, "fit_on": fit_on, "fit_from": fit_from}
    return _measured("fit", tracks, options)


@checked
def measured_predict(
    tracks: Path,
    *,
    body: Path | None = None,
    seed: int | None = None,
    share: float | None = None,
    fit_on: str | None = None,
    fit_from: Path | None = None,
) -> Measured:
    """The motion after the first impact of each drop that nothing was fitted to; arguments as for measured_fit()."""
    options: dict[str, Path | float | None] = {"body": body, "seed": seed, "share": share, "fit_on": fit_on, "fit_from": fit_from}
    return _measured("predict", tracks, options)


@checked
def measured_score(
    tracks: Path,
    *,
    body: Path | None = None,
    seed: int | None = None,
    share: float | None = None,
    fit_on: str | None = None,
    fit_from: Path | None = None,
) -> Measured:
    """How well the fitted laws predict drops that nothing was fitted to; arguments as for measured_fit().

    >>> next(row.value for row in clatter.measured_score("square-drops") if row.quantity == "as fitted") < 10
    True
    """
    options: dict[str, Path | float | None] = {"body": body, "seed": seed, "share": share, "fit_on": fit_on, "fit_from": fit_from}
    return _measured("score", tracks, options)


@checked
def benchmark_list() -> Table:
    """The problems with certified answers, a row each."""
    return Table(called(_clatter.benchmark_list))


@checked
def benchmark_show(problem: str) -> Problem:
    """The statement of a problem: data, starts, what is asked, tolerances, certified answer.

    >>> clatter.benchmark_show("rod-10").starts[0].position
    array([0.        , 0.        , 0.08682409])
    """
    return Problem(called(_clatter.benchmark_show, problem))


@checked
def benchmark_truth(problem: str, law: str | None = None) -> Table:
    """The certified answer, a row for each impact.  law: "newton", "poisson" or "stronge", then "routh" or "moreau"."""
    return Table(called(_clatter.benchmark_truth, problem, law))


@checked
def benchmark_score(
    files: Path | Iterable[Path],
    *,
    problem: str | None = None,
    columns: str | None = None,
    require: str | float | None = None,
    progress: Progress | None = None,
) -> Scored:
    """Scores the motions or lists of impacts of other programs, in files that `clatter benchmark score` reads.

    problem: in place of the files' lines "# problem: ID".  columns: "NAME=COLUMN,...", what the files call theirs.
    require: "exact", "sharp", "good", "coarse" or a largest error, for is_met.  progress(done, of): of the files.
    """
    options = texts_of({"problem": problem, "columns": columns, "require": require})
    return Scored(*called(_clatter.benchmark_score, listed(files), options, progress))


def listed(files: Path | Iterable[Path]) -> list[str]:
    """Paths of one file or several."""
    names = [files] if isinstance(files, (str, os.PathLike)) else files
    return [os.fspath(name) for name in names]


@checked
def extremes(
    only: str | Iterable[str] = (),
    *,
    quick: bool = False,
    seed: int = 1,
    seconds: float = 1.0,
    progress: Progress | None = None,
) -> Table:
    """The map of what holds, to the ends of every quantity: a row for each cell.

    only: quantities such as ["angle", "speed"]; quick: without the long runs; seed: of the random scenes; seconds: that a
    cell may take.  progress(done, of): of the cells.  A minute or more for all.
    """
    names = [only] if isinstance(only, str) else list(only)
    if quick and names:
        raise BadInput("quick: excludes only; give one of them, not both")
    if not 0 < seconds <= _MOST_SECONDS:
        raise BadInput(f"seconds {shown(seconds)}: must be greater than 0, at most {_MOST_SECONDS:g}")
    if not 0 <= seed < 2**31:
        raise BadInput(f"seed {shown(seed)}: must be a whole number from 0 to {2**31 - 1}")
    return Table(called(_clatter.extremes, names, quick, seed, float(seconds), progress))


def _numbers(given: float | Iterable[float] | None) -> list[float]:
    """One or several."""
    return [] if given is None else [given] if isinstance(given, (int, float)) else list(given)


@checked
def figure(
    number: int,
    *,
    angles: float | Iterable[float] | None = None,
    gravity_numbers: float | Iterable[float] | None = None,
    **changes: AnyKey,
) -> Table:
    """The data of a figure of the paper, 7 to 12, 14 to 17, 19 to 24, or of one like it with other numbers.

    angles [°]: of the rods of figure 8.  gravity_numbers: one to three G = g L/v_n², of figures 7 and 9 to 12.  The drops of
    figures 14 to 24 take the keys of scenes, but for what the figure itself varies.
    Raises BadInput for a number that the figure does not have.

    >>> clatter.figure(7)["theta"][:3]
    array([0.  , 0.25, 0.5 ])
    >>> clatter.figure(21, angle=20, impacts=2)["Fn"].max()
    """
    texts = scene_text(None, changes).changes
    return Table(called(_clatter.figure, number, _numbers(angles), _numbers(gravity_numbers), texts))


@checked
def verify(only: str | Iterable[str] | None = None, *, quick: bool = False, progress: Progress | None = None) -> Verification:
    """Every claim of the paper, its errata, figures and exact results, each against an independent oracle.

    only: ids such as ["C1", "E2"]; quick: without the checks that take long.  progress(done, of): of the checks.  Some
    minutes for all.
    """
    ids = [only] if isinstance(only, str) else list(only or [])
    return Verification(called(_clatter.verify, quick, ids, progress))
