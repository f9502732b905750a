# SPDX-License-Identifier: GPL-3.0-or-later
"""What the functions of clatter return."""

from __future__ import annotations

import copy
import copyreg
import functools
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Protocol, overload

from clatter import _clatter
from clatter.arguments import checked
from clatter.arrays import Array
from clatter.errors import BadInput
from clatter.records import History, Impact, Record, absent, as_array, column_of, value_of

_FORMATS = ("table", "csv", "json", "markdown", "latex")


class Report(Protocol):
    """What a run came to, as the compiled part has it or as it was kept."""

    def data(self) -> dict[str, Any]: ...
    def rows(self) -> list[dict[str, Any]]: ...
    def text(self, format: str, ascii: bool) -> str: ...
    def html(self) -> str: ...


class KeptReport:
    """What a pickled report said: all of it, without the run."""

    def __init__(self, data: dict[str, Any], rows: list[dict[str, Any]], texts: Mapping[tuple[str, bool], str], html: str) -> None:
        self._data, self._rows, self._texts, self._html = data, rows, texts, html

    def data(self) -> dict[str, Any]:
        return copy.deepcopy(self._data)

    def rows(self) -> list[dict[str, Any]]:
        return copy.deepcopy(self._rows)

    def text(self, format: str, ascii: bool) -> str:
        if format not in _FORMATS:
            raise BadInput(f"format '{format}': must be one of {', '.join(_FORMATS)}")
        return self._texts.get((format, ascii), self._texts[format, False])

    def html(self) -> str:
        return self._html


def _keep(report: _clatter.Report) -> tuple[Any, tuple[Any, ...]]:
    texts = {(form, False): report.text(form, False) for form in _FORMATS}
    plain = {(form, True): report.text(form, True) for form in _FORMATS}
    texts |= {(form, ascii): text for (form, ascii), text in plain.items() if text != texts[form, False]}
    return KeptReport, (report.data(), report.rows(), texts, report.html())


copyreg.pickle(_clatter.Report, _keep)


class Result:
    """A result that shows itself as the program's table: as text, and in a notebook as HTML.

    Results can be pickled and copied; those of the same content are equal.
    """

    def __init__(self, report: Report) -> None:
        self._report = report

    @functools.cached_property
    def _data(self) -> dict[str, Any]:
        """The program's JSON, made when it is first asked for."""
        return self._report.data()

    def _beside(self) -> tuple[Any, ...]:
        """What it was made from beside the report."""
        return ()

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._report, *self._beside())

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, Result) and type(other) is type(self) and self._data == other._data
                and self._beside() == other._beside())

    @property
    def scene(self) -> dict[str, Any]:
        """Everything that was asked for, defaults included, under the names of scene files: a scene to be given again.

        The law and the speed that follow from it are in to_dict()["scene"].
        """
        return given_again(self._data["scene"])

    @property
    def message(self) -> str:
        """How it ended, in words."""
        return str(self._data["message"])

    def to_dict(self) -> dict[str, Any]:
        """The program's JSON as dicts and lists."""
        return self._report.data()

    @checked
    def to_text(self, format: str = "table", *, ascii: bool = False) -> str:
        """What the program prints with --format `format`: table, csv, json, markdown or latex."""
        return self._report.text(format, ascii)

    def __repr__(self) -> str:
        return self.to_text().rstrip("\n")

    def _repr_html_(self) -> str:
        return self._report.html()


def given_again(scene: Mapping[str, Any]) -> dict[str, Any]:
    """Without what is computed: the law of a ground, and the speed of a fall from a height."""
    kept = {name: dict(table) if isinstance(table, dict) else table for name, table in scene.items() if name != "discrete_law"}
    drop = kept.get("drop", {})
    if any(drop.get(name) is not None for name in ("height", "clearance", "topple")):
        drop.pop("speed", None)
    return kept


class States:
    """Where a body is at some times, a row each: position, attitude, velocity, angular_velocity, energy ..."""

    def __init__(self, rows: list[dict[str, Any]]) -> None:
        self._rows = rows

    def column(self, name: str) -> Array:
        """One value of each time, vectors as rows; NaN where the model does not say.  NAME_error is its error, NAME_z a vector's part."""
        return column_of(self._rows, name)

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Record]:
        return (Record(row) for row in self._rows)

    def __getitem__(self, index: str) -> Array:
        return self.column(index)


class Run(Result):
    """A sequence of impacts: len(run), run[0], for impact in run."""

    @functools.cached_property
    def impacts(self) -> list[Impact]:
        """A record for each."""
        return [Impact(impact) for impact in self._data["impacts"]]

    @property
    def outcome(self) -> str:
        """no-further-impact, impact-limit, at-rest, sustained-contact, evaluation-limit ..."""
        return str(self._data["outcome"])

    @property
    def total_normal_impulse(self) -> float:
        """[N·s]"""
        return float(self._data["total_normal_impulse"])

    @property
    def total_normal_impulse_error(self) -> float | None:
        """Bound or estimate of its error [N·s]; None if one of the impacts cannot be predicted."""
        error = self._data["total_normal_impulse_error"]
        return None if error is None else float(error)

    @property
    def predictable(self) -> bool:
        """Whether each impact is: rounding has not decided what happens."""
        return bool(self._data["predictable"])

    @property
    def shortfall(self) -> str | None:
        """Why there are fewer impacts or known digits than asked for: the program's exit status 3; None: there are not."""
        reason = self._data["shortfall"]
        return None if reason is None else str(reason)

    @property
    def cost(self) -> Record:
        """force_evaluations, root_evaluations."""
        return Record(self._data["cost"])

    @property
    def accuracy(self) -> Record:
        """Relative error asked and achieved."""
        return Record(self._data["accuracy"])

    def column(self, name: str) -> Array:
        """One value of each impact, vectors as rows; NaN where there is none.  NAME_error is its error, NAME_z a vector's part."""
        return column_of(self._data["impacts"], name)

    @property
    def states(self) -> States:
        """At the times of run.at and run.rate."""
        return States(self._data.get("states", []))

    def at(self, times: float | Iterable[float]) -> States:
        """Where the body is at these times since the first impact, in their order: the same run again.

        >>> clatter.sequence(angle=10).at([0.2, 0.1]).column("position_z")
        """
        from clatter.calls import sequence, simulate  # noqa: PLC0415: that module needs this one

        wanted = [float(times)] if isinstance(times, (int, float)) else [float(time) for time in times]
        asked = sorted(set(wanted))
        again: Result = simulate(self.scene, at=asked) if isinstance(self, Simulation) else sequence(self.scene, at=asked)
        told = {row["time"]: row for row in again.to_dict()["states"]}
        return States([told[time] for time in wanted])

    def __len__(self) -> int:
        return len(self.impacts)

    def __iter__(self) -> Iterator[Impact]:
        return iter(self.impacts)

    @overload
    def __getitem__(self, index: int) -> Impact: ...
    @overload
    def __getitem__(self, index: slice) -> list[Impact]: ...
    @overload
    def __getitem__(self, index: str) -> Array: ...
    def __getitem__(self, index: int | slice | str) -> Impact | list[Impact] | Array:
        """An impact, some of them, or a column by its name: run["impulse_normal"]."""
        return self.column(index) if isinstance(index, str) else self.impacts[index]


class Sequence(Run):
    """An impact sequence of the discrete model."""

    @property
    def tail(self) -> Record | None:
        """The infinitely many impacts that follow the last one, summed up; None if there are none."""
        return Record(self._data["tail"]) if "tail" in self._data else None


class Simulation(Run):
    """A run of the continuous model."""

    def __init__(self, report: Report, history: History | None) -> None:
        super().__init__(report)
        self._history = history

    def _beside(self) -> tuple[Any, ...]:
        return (self._history,)

    @property
    def history(self) -> History:
        """@raise AttributeError: the run was not asked for one."""
        if self._history is None:
            raise AttributeError("no history was kept; call simulate(..., history=True)")
        return self._history

    @property
    def method(self) -> str:
        """That was used: rkf45, tvd-rk3 ..."""
        return str(self._data["method"])

    @property
    def energy_start(self) -> float:
        """At the first touch [J]."""
        return float(self._data["energy_start"])


class Sweep(Result):
    """A scene for each value of one quantity."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.quantity = next(iter(self._data["scene"]["sweep"]))
        self.runs = [Record(run) for run in self._data["runs"]]
        self.values = as_array([run[self.quantity] for run in self._data["runs"]])

    def __len__(self) -> int:
        return len(self.runs)

    def column(self, name: str, impact: int = 1) -> Array:
        """A value of impact number `impact` of each run; NaN where a run has no such impact."""
        rows = [run["impacts"] for run in self._data["runs"]]
        return as_array([value_of(row[impact - 1], name) if len(row) >= impact else None for row in rows])


class Comparison(Result):
    """Both models over one scene.

    impacts: records with n, comparable, predictable, reason, discrete_end, continuous_end, contact_time, limit_is_discrete and
    numbers: by quantity (start, contact_angle_deg, impulse_normal ...) discrete, continuous, deviation and the error of
    each (discrete_error ...; NaN in a column: not known), predicted, limit, limit_error, allowance.  In the plane there are also
    impulse_tangential, velocity_normal, velocity_tangential and angular_velocity.  In space the quantities are start,
    contact_angle_deg, impulse_x, velocity_after_x, angular_velocity_after_x ... with _y and _z, the ends are corners, and
    explanation says why an impact has no limit within its bar.
    """

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.impacts = [Record(impact) for impact in self._data["impacts"]]

    @property
    def agrees(self) -> bool:
        """Whether the limit of ever stiffer ground is the discrete value, wherever there is one."""
        return bool(self._data["agrees"])

    def __len__(self) -> int:
        return len(self.impacts)

    def column(self, quantity: str, name: str) -> Array:
        """One number of each impact: column("impulse_normal", "deviation"); NaN where it was not compared or is not known."""
        numbers = [impact["numbers"] for impact in self._data["impacts"]]
        quantities = dict.fromkeys(key for of in numbers for key in of)
        names = dict.fromkeys(key for of in numbers for number in of.values() for key in number)
        for known, asked in ((quantities, quantity), (names, name)):
            if numbers and asked not in known:
                raise KeyError(absent(asked, known))
        return as_array([of.get(quantity, {}).get(name) for of in numbers])


class ComparisonSweep(Result):
    """A comparison for each value of one quantity; `runs` holds a record for each."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.quantity = next(iter(self._data["scene"]["sweep"]))
        self.runs = [Record(run) for run in self._data["runs"]]
        self.values = as_array([run[self.quantity] for run in self._data["runs"]])

    @property
    def agrees(self) -> bool:
        """All of them agree."""
        return bool(self._data["agrees"])

    def __len__(self) -> int:
        return len(self.runs)


class Verification(Result):
    """Checks with their verdicts; `checks` holds a record for each: id, claim, answer, number, tolerance, verdict ..."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.checks = [Record(check) for check in self._data["checks"]]

    @property
    def scene(self) -> dict[str, Any]:
        """@raise AttributeError: each check has a scene of its own."""
        raise AttributeError("a verification has no scene; each check's command tells its own")

    @property
    def passed(self) -> int:
        """Number of checks that passed."""
        return int(self._data["passed"])

    @property
    def failed(self) -> int:
        """Number of checks that failed."""
        return int(self._data["failed"])

    def __len__(self) -> int:
        return len(self.checks)

    def __getitem__(self, name: str) -> Record:
        """A check by its id: verification["C1"]."""
        for check in self.checks:
            if check["id"] == name:
                return check
        raise KeyError(name)
