# SPDX-License-Identifier: GPL-3.0-or-later
"""What the functions of clatter return."""

from __future__ import annotations

import copy
import copyreg
import functools
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, Generic, Protocol, SupportsIndex, TypeVar, overload

from clatter import _clatter
from clatter.arguments import checked
from clatter.arrays import Array
from clatter.errors import BadInput
from clatter.fields import Accuracy, Check, Cost, Impact, SimulatedImpact, Tail
from clatter.records import History, Record, Values, absent, as_array, as_record, column_of, flat, value_of
from clatter.words import in_python, paragraphs_in_python

Row = TypeVar("Row", bound=Values)
OneImpact = TypeVar("OneImpact", bound=Impact)
_FORMATS = ("table", "csv", "json", "markdown", "latex")
_MOST_ROWS_SHOWN = 60
_ROWS_AT_AN_END = 10


def _ends(rows: list[str], left_out: str) -> list[str]:
    """The first and last of many rows, all of few; left_out: what stands between, with the number of rows."""
    if len(rows) <= _MOST_ROWS_SHOWN:
        return rows
    return [*rows[:_ROWS_AT_AN_END], left_out.format(f"… {len(rows)} rows"), *rows[-_ROWS_AT_AN_END:]]


def shown_text(text: str, count: int, others: int = 0) -> str:
    """A table for a terminal: the ends of each block, whose `count` rows begin below a rule, and all that is said below it; others:
    rows of a second table, which has a block of its own."""
    lines: list[str] = []
    for block in text.rstrip("\n").split("\n\n"):
        head, rule, rows = re.fullmatch(r"(?s)(?:(.*?\n)( *─+\n))?(.*)", block).groups()  # type: ignore[union-attr]
        body = rows.split("\n")
        here = others if len(body) == others else count
        lines.append((head or "") + (rule or "") + ("\n".join([*_ends(body[:here], "  {}"), *body[here:]]) if rule else rows))
    return "\n\n".join(lines)


def shown_html(html: str) -> str:
    """A table for a notebook: its ends."""
    def ends(body: re.Match[str]) -> str:
        return "\n".join(["<tbody>", *_ends(body[1].split("\n"), '<tr><td colspan="99">{}</td></tr>'), "</tbody>"])
    return re.sub(r"(?s)<tbody>\n(.*?)\n</tbody>", ends, html)


class Report(Protocol):
    """What a run came to, as the compiled part has it or as it was kept."""

    def data(self) -> dict[str, Any]: ...
    def rows(self) -> list[dict[str, Any]]: ...
    def columns(self) -> dict[str, list[Any]]: ...
    def length(self) -> int: ...
    def column(self, name: str) -> list[Any] | None: ...
    def row(self, index: int) -> dict[str, Any]: ...
    def object(self, list: str, index: int) -> dict[str, Any]: ...
    def text(self, format: str, ascii: bool) -> str: ...
    def html(self) -> str: ...


class KeptReport:
    """What a pickled report said: all of it, without the run."""

    def __init__(self, data: dict[str, Any], rows: list[dict[str, Any]], columns: dict[str, list[Any]],
                 texts: Mapping[tuple[str, bool], str], html: str) -> None:
        self._data, self._rows, self._columns, self._texts, self._html = data, rows, columns, texts, html

    def data(self) -> dict[str, Any]:
        return copy.deepcopy(self._data)

    def rows(self) -> list[dict[str, Any]]:
        return copy.deepcopy(self._rows)

    def columns(self) -> dict[str, list[Any]]:
        return copy.deepcopy(self._columns)

    def length(self) -> int:
        return len(next(iter(self._columns.values()), []))

    def column(self, name: str) -> list[Any] | None:
        return copy.deepcopy(self._columns.get(name))

    def row(self, index: int) -> dict[str, Any]:
        return {name: values[index] for name, values in self._columns.items()}

    def object(self, list: str, index: int) -> dict[str, Any]:
        return copy.deepcopy((self._data[list] if list else self._rows)[index])

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
    return KeptReport, (report.data(), report.rows(), report.columns(), texts, report.html())


copyreg.pickle(_clatter.Report, _keep)


def _without_gaps(column: list[Any]) -> list[Any]:
    """NaN in place of None, where the others are numbers."""
    kinds = {type(value) for value in column}
    return [float("nan") if value is None else value for value in column] if type(None) in kinds and kinds <= {float, int, type(None)} else column


def _shown_rows(text: str, count: int, some: range) -> str:
    """A table for a terminal with some of its `count` rows, without what is said below; "": it has other rows."""
    lines: list[str] = []
    for block in text.rstrip("\n").split("\n\n"):
        found = re.fullmatch(r"(?s)(.*?\n *─+\n)(.*)", block)
        rows = found[2].split("\n") if found else []
        if found and len(rows) >= count:
            lines.append(found[1] + "\n".join(_ends([rows[i] for i in some], "  {}")))
    return "\n\n".join(lines)


class RowList(list[Row]):
    """Some rows of a table: a list of records that gives its columns as the table does, rows["impulse_normal"], and shows itself."""

    _of: tuple[Result[Any], range] | None = None  # which rows of which result

    def _from(self, result: Result[Any], some: range) -> RowList[Row]:
        self._of = (result, some)
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (list(self),)

    @property
    def columns(self) -> list[str]:
        """Their names."""
        return list(dict.fromkeys(name for row in self for name in row))

    def column(self, name: str) -> Array:
        """One value of each row, vectors as rows; NaN where there is none."""
        values = [row[name] for row in self]
        return as_array([value.tolist() if getattr(value, "ndim", 0) == 1 else value for value in values])

    @overload
    def __getitem__(self, index: SupportsIndex) -> Row: ...
    @overload
    def __getitem__(self, index: slice) -> RowList[Row]: ...
    @overload
    def __getitem__(self, index: str) -> Array: ...
    def __getitem__(self, index: SupportsIndex | slice | str) -> Row | RowList[Row] | Array:
        """A row, some of them, or a column by its name."""
        if isinstance(index, str):
            return self.column(index)
        if not isinstance(index, slice):
            return super().__getitem__(index)
        rows: RowList[Row] = RowList(super().__getitem__(index))
        return rows._from(self._of[0], self._of[1][index]) if self._of and len(self._of[1]) == len(self) else rows

    def __repr__(self) -> str:
        if self._of and len(self._of[1]) == len(self) > 0:
            result, some = self._of
            if table := _shown_rows(result.to_text(), len(result), some):
                return paragraphs_in_python(table)
        return _first_rows([dict(row.items()) for row in self], "rows")


def _first_rows(rows: list[dict[str, Any]], what: str) -> str:
    """A line for each column, with the first rows."""
    most, names = 5, dict.fromkeys(name for row in rows for name in row)
    def text(value: Any) -> str:
        return "?" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)
    lines = [f"{name:<28}" + "".join(f"{text(row.get(name)):>13}" for row in rows[:most]) for name in names]
    return "\n".join([*lines, *([f"… {len(rows)} {what}"] if len(rows) > most else [])])


class Result(Generic[Row]):
    """A result is the program's table: it shows itself as that, len(x) are its rows, x[0], x[-1], x[1:3] and a loop give them,
    x["impulse_normal"] is a column as an array, and pandas.DataFrame(x) the whole.

    Results can be pickled and copied; those of the same content are equal.
    """

    _row_class: type[Values] = Record
    _rows_in = ""  # where the JSON has the rows by a name of their own

    def __init__(self, report: Report) -> None:
        self._report = report

    @functools.cached_property
    def _data(self) -> dict[str, Any]:
        """The program's JSON, made when it is first asked for."""
        return self._report.data()

    def _values(self, name: str, cells: list[Any]) -> list[Any]:
        """Of some cells of a column, where they are others than in CSV."""
        return cells

    @functools.cached_property
    def _columns(self) -> dict[str, list[Any]]:
        return {name: self._values(name, cells[:len(self)]) for name, cells in self._report.columns().items()}

    def _objects(self) -> list[dict[str, Any]]:
        """The rows as JSON has them, vectors as lists."""
        objects: list[dict[str, Any]] = self._data.get(self._rows_in, []) if self._rows_in else self._report.rows()
        return objects

    @functools.cached_property
    def rows(self) -> RowList[Row]:
        """A record for each, whose keys are the columns."""
        names, objects = list(self._columns), self._objects()
        rows = zip(objects, zip(*map(_without_gaps, self._columns.values())))
        every: RowList[Row] = RowList(self._row_class(one, dict(zip(names, row))) for one, row in rows)  # type: ignore[misc]
        return every._from(self, range(len(every)))

    @property
    def columns(self) -> list[str]:
        """Their names, in the order of the table (its CSV)."""
        return list(self._columns)

    def column(self, name: str) -> Array:
        """One value of each row, vectors as rows; NaN where there is none.  NAME_error is its error, NAME_z a vector's part."""
        cells = self._report.column(name)
        return column_of(self._objects(), name) if cells is None else as_array(self._values(name, cells[:len(self)]))

    @functools.cached_property
    def _length(self) -> int:
        return self._report.length()

    @functools.cached_property
    def _has_gaps(self) -> dict[str, bool]:
        """Whether a column without a number in a row has NaN there, of columns that were asked for."""
        return {}

    def _row(self, index: int) -> Row:
        """One record, for much less than all of them."""
        if "rows" in vars(self) or not -len(self) <= index < len(self):
            return self.rows[index]
        place = index % len(self)
        cells = {name: self._values(name, [value])[0] for name, value in self._report.row(place).items()}
        for name in [name for name, value in cells.items() if value is None]:
            if name not in self._has_gaps:
                self._has_gaps[name] = None not in _without_gaps(self._values(name, (self._report.column(name) or [])[:len(self)]))
            if self._has_gaps[name]:
                cells[name] = float("nan")
        return self._row_class(self._report.object(self._rows_in, place), cells)  # type: ignore[return-value]

    def __len__(self) -> int:
        return self._length

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    @overload
    def __getitem__(self, index: int) -> Row: ...
    @overload
    def __getitem__(self, index: slice) -> RowList[Row]: ...
    @overload
    def __getitem__(self, index: str) -> Array: ...
    def __getitem__(self, index: int | slice | str) -> Row | RowList[Row] | Array:
        """A row, some of them, or a column by its name."""
        if isinstance(index, str):
            return self.column(index)
        if isinstance(index, slice):
            return self.rows[index]
        if hasattr(index, "__len__"):
            raise TypeError("rows are taken by a number, a slice or a column's name; pandas.DataFrame(x)[mask] takes a mask")
        return self._row(index)

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

        The law and the speed that follow from it are in to_dict()["scene"].  @raise AttributeError: it is not of one scene.
        """
        if not isinstance(self._data.get("scene"), dict):
            raise AttributeError("these rows are not of one scene; to_dict() tells what there is")
        return given_again(self._data["scene"])

    @property
    def message(self) -> str:
        """How it ended, in words.  @raise AttributeError: nothing is to be said of it."""
        if "message" not in self._data:
            raise AttributeError("no message here; printed, the result says what came out")
        return in_python(str(self._data["message"]))

    def __dir__(self) -> list[str]:
        """What there is to be had, without a message where nothing is to be said."""
        return [name for name in super().__dir__() if name != "message" or name in self._data]

    if not TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            """What the JSON has by that name; what a property that has nothing to give says of it, or of any other name the nearest
            one."""
            known = getattr(type(self), name, None)
            if isinstance(known, property):
                return known.fget(self)
            if not name.startswith("_") and name in self._data:
                return as_record(self._data[name])
            if name in self._columns:
                raise AttributeError(f"{name} is a column, an array of it is x[{name!r}]; x is this result")
            raise AttributeError(name if name.startswith("_") else absent(name, [*(one for one in dir(self) if not one.startswith("_")), *self._columns]))

    def to_dict(self) -> dict[str, Any]:
        """The program's JSON as dicts and lists."""
        return self._report.data()

    @checked
    def to_text(self, format: str = "table", *, ascii: bool = False) -> str:
        """What the program prints with --format `format`: table, csv, json, markdown or latex."""
        return self._report.text(format, ascii)

    def __repr__(self) -> str:
        text = shown_text(self.to_text(), self._report.length(), len(self._data.get("states") or []))
        return paragraphs_in_python(text)

    def _repr_html_(self) -> str:
        return shown_html(self._report.html())


def given_again(scene: Mapping[str, Any]) -> dict[str, Any]:
    """Without what is computed: the laws of a ground, and the speed of a fall from a height."""
    kept = {name: dict(table) if isinstance(table, dict) else table for name, table in scene.items() if name != "discrete_law"}
    kept.get("ground", {}).pop("reduced_modulus", None)  # of a floor by name
    drop = kept.get("drop", {})
    if any(drop.get(name) is not None for name in ("height", "clearance", "topple")):
        drop.pop("speed", None)
    return kept


class States:
    """Where a body is at some times, a row each: position, attitude, velocity, angular_velocity, energy ..."""

    def __init__(self, rows: list[dict[str, Any]]) -> None:
        self._rows = rows

    @property
    def columns(self) -> list[str]:
        """Their names, vectors by their parts."""
        return list(dict.fromkeys(name for row in self._rows for name in flat(row)))

    @property
    def rows(self) -> list[Record]:
        """A record for each time."""
        return [Record(row, flat(row)) for row in self._rows]

    def to_dict(self) -> list[dict[str, Any]]:
        """The program's JSON of each time."""
        return copy.deepcopy(self._rows)

    def __repr__(self) -> str:
        """A line for each column, with the first times."""
        return _first_rows([flat(row) for row in self._rows], "times")

    if not TYPE_CHECKING:
        def __getattr__(self, name: str) -> Any:
            if name.startswith("_"):
                raise AttributeError(name)
            try:
                return self.column(name)
            except KeyError:
                raise AttributeError(absent(name, self.columns)) from None

    def column(self, name: str) -> Array:
        """One value of each time, vectors as rows; NaN where the model does not say.  NAME_error is its error, NAME_z a vector's part."""
        return column_of(self._rows, name)

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Record]:
        return iter(self.rows)

    @overload
    def __getitem__(self, index: int) -> Record: ...
    @overload
    def __getitem__(self, index: slice) -> States: ...
    @overload
    def __getitem__(self, index: str) -> Array: ...
    def __getitem__(self, index: int | slice | str) -> Record | States | Array:
        """The state at a time, some of them, or a column by its name."""
        if isinstance(index, str):
            return self.column(index)
        return States(self._rows[index]) if isinstance(index, slice) else Record(self._rows[index], flat(self._rows[index]))


class Run(Result[OneImpact]):
    """A sequence of impacts: len(run), run[0], for impact in run."""

    _row_class = Impact
    _rows_in = "impacts"

    @functools.cached_property
    def _length(self) -> int:
        """Without the table's last row, where that is the sum of the impacts that follow."""
        count = self._report.length()
        return count - (count > 0 and self._report.row(count - 1)["n"] == "tail")

    @property
    def impacts(self) -> list[OneImpact]:
        """A record for each."""
        return self.rows

    @property
    def outcome(self) -> str:
        """no-further-impact, impact-limit, at-rest, sustained-contact, evaluation-limit ..."""
        return str(self._data["outcome"])

    @property
    def warnings(self) -> list[str]:
        """What the model says beside its numbers; but for depths in springs and facets a call warns of it, too."""
        return [in_python(words) for words in self._data.get("warnings", [])]

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
    def rest(self) -> Record | None:
        """Of a body that comes to rest: corners of the face on which it must, and by when; None: it is not known."""
        return Record(self._data["rest"]) if self._data.get("rest") else None

    @property
    def end_motion(self) -> Record | None:
        """How the body slides, spins or rolls after its last impact; None: it does not, or it is not known."""
        return Record(self._data["end_motion"]) if self._data.get("end_motion") else None

    @property
    def shortfall(self) -> str | None:
        """Why there are fewer impacts or known digits than asked for; None: there are not."""
        reason = self._data["shortfall"]
        return None if reason is None else in_python(str(reason))

    @property
    def near_miss(self) -> Record | None:
        """How high the next corner passed over the ground, when and which; None: it is not known."""
        return Record(self._data["near_miss"]) if self._data.get("near_miss") else None

    @property
    def contacts(self) -> list[Record]:
        """Corners that stayed on the ground while the body turned, each with begin, end and loss."""
        return [Record(one) for one in self._data.get("contacts") or []]

    @property
    def outcomes(self) -> list[Record]:
        """What small tilts make of a landing on several corners at once, of the impact that has them, each with its share of the
        tilts."""
        return [Record(one) for impact in self._data["impacts"] for one in impact.get("outcomes") or []]

    @property
    def energy_losses(self) -> Record | None:
        """How much of the energy impacts at points, edges and faces, hops and contacts took [J]; None: the model does not say."""
        return Record(self._data["energy_losses"]) if self._data.get("energy_losses") else None

    @property
    def cost(self) -> Cost:
        """force_evaluations, root_evaluations."""
        return Cost(self._data["cost"])

    @property
    def accuracy(self) -> Accuracy:
        """Relative error asked and achieved."""
        return Accuracy(self._data["accuracy"])

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
        is_simulated = issubclass(self._row_class, SimulatedImpact)
        again: Result[Any] = simulate(self.scene, at=asked) if is_simulated else sequence(self.scene, at=asked)
        told = {row["time"]: row for row in again.to_dict()["states"]}
        return States([told[time] for time in wanted])


class Sequence(Run[Impact]):
    """An impact sequence of the discrete model."""

    @property
    def tail(self) -> Tail | None:
        """The infinitely many impacts that follow the last one, summed up; None if there are none."""
        return Tail(self._data["tail"]) if "tail" in self._data else None


class Simulation(Run[SimulatedImpact]):
    """A run of the continuous model."""

    _row_class = SimulatedImpact

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


class Sweep(Result[Record]):
    """A scene for each value of one quantity: a row for each impact, `runs` holds a record for each value, `values` these."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.quantity = next(iter(self._data["scene"]["sweep"]))
        self.runs = [Record(run) for run in self._data["runs"]]
        self.values = as_array([run[self.quantity] for run in self._data["runs"]])

    def column(self, name: str, impact: int = 1) -> Array:
        """A value of impact number `impact` of each run; NaN where a run has no such impact.  sweep[name] is of every row."""
        rows = [run["impacts"] for run in self._data["runs"]]
        return as_array([value_of(row[impact - 1], name) if len(row) >= impact else None for row in rows])

    def __getitem__(self, index: Any) -> Any:
        return super().column(index) if isinstance(index, str) else self.rows[index]


class Comparison(Result[Record]):
    """Both models over one scene: a row for each quantity of each impact.

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

    def column(self, name: str, number: str | None = None) -> Array:
        """One number of each impact: column("impulse_normal", "deviation"); NaN where it was not compared or is not known.
        Of one name the table's column."""
        if number is None:
            return super().column(name)
        numbers = [impact["numbers"] for impact in self._data["impacts"]]
        quantities = dict.fromkeys(key for of in numbers for key in of)
        names = dict.fromkeys(key for of in numbers for one in of.values() for key in one)
        for known, asked in ((quantities, name), (names, number)):
            if numbers and asked not in known:
                raise KeyError(absent(asked, known))
        return as_array([of.get(name, {}).get(number) for of in numbers])


class ComparisonSweep(Result[Record]):
    """A comparison for each value of one quantity: the rows of each, and `runs` holds a record for each."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.quantity = next(iter(self._data["scene"]["sweep"]))
        self.runs = [Record(run) for run in self._data["runs"]]
        self.values = as_array([run[self.quantity] for run in self._data["runs"]])

    @property
    def agrees(self) -> bool:
        """All of them agree."""
        return bool(self._data["agrees"])


class Verification(Result[Check]):
    """Checks with their verdicts; `checks` holds a record for each: id, claim, answer, number, tolerance, verdict ..."""

    _row_class = Check
    _rows_in = "checks"

    @property
    def checks(self) -> list[Check]:
        """The rows."""
        return self.rows

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

    def __getitem__(self, index: Any) -> Any:
        """A check by its id, verification["C1"], or as in any result."""
        return named_row(self, "id", index)


def named_row(result: Result[Any], column: str, index: Any) -> Any:
    """The row that has this in the column, or what any result gives for an index."""
    if isinstance(index, str) and index not in result.columns:
        for row in result.rows:
            if row[column] == index:
                return row
        raise KeyError(absent(index, [*(str(row[column]) for row in result.rows), *result.columns]))
    return Result.__getitem__(result, index)
