# SPDX-License-Identifier: GPL-3.0-or-later
"""What explanations, plans, studies of cost, sweeps, regimes, measurements and scores return."""

from typing import Any

from clatter.arguments import KEYS
from clatter.arrays import Array
from clatter.fields import Answer, Choice, Rung, Step
from clatter.records import Record, absent, as_array
from clatter.results import Report, Result, given_again, named_row


class Explanation(Result[Record]):
    """How an impact came about: a row for each equation.  `steps` holds records with title, text and equations, each of these
    a record with name, symbolic, numeric, tex, words, value, error and unit."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.steps = [Step(step) for step in self._data["steps"]]

    @property
    def impact(self) -> int:
        """Its number, from 1."""
        return int(self._data["impact"])

    def __getitem__(self, index: Any) -> Any:
        """The values of the step of this title by their names, explanation["Eq. 8"]["P_n"], or as in any result."""
        if isinstance(index, str) and index not in self.columns:
            for step in self.steps:
                if step["title"] == index:
                    return {equation["name"]: equation["value"] for equation in step["equations"]}
            raise KeyError(absent(index, [*(step["title"] for step in self.steps), *self.columns]))
        return super().__getitem__(index)


class Plan(Result[Rung]):
    """The models that could run a scene: `rungs` holds a record for each with its error and cost, `choice` the chosen
    one with its command."""

    _row_class = Rung
    _rows_in = "rungs"

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.choice = Choice(self._data["choice"])

    @property
    def rungs(self) -> list[Rung]:
        """The rows."""
        return self.rows

    def __getitem__(self, index: Any) -> Any:
        """The entry of a model, plan["discrete"], or as in any result."""
        return named_row(self, "model", index)


class Tradeoff(Result[Record]):
    """What accuracy costs: `points` holds a record for each model and setting with seconds, evaluations and error."""

    _rows_in = "points"

    @property
    def points(self) -> list[Record]:
        """The rows."""
        return self.rows

    @property
    def front(self) -> list[Record]:
        """The points that nothing beats in both cost and error."""
        return [point for point in self.points if point["front"]]


class Table(Result[Record]):
    """Rows of CSV; `rows` holds a record for each."""


class Atlas(Table):
    """Clattering close to flat: a row for each range of tilts.  What is of each impact of a row, as order, approaches and impulses,
    is a list."""

    def _values(self, name: str, cells: list[Any]) -> list[Any]:
        return [_listed(value) for value in cells] if name in ("order", "approaches", "impulses") else cells


def _listed(text: Any) -> Any:
    """The numbers, or words, of a text."""
    if not isinstance(text, str):
        return text
    try:
        return [int(one) if one.isdigit() else float(one) for one in text.split()]
    except ValueError:
        return text.split()


class Gradient(Table):
    """Derivatives of the state after each impact: a row for each impact and each number of the drop, `parameter`, that has
    them.  Errors are in the column error_estimate."""

    @property
    def refused(self) -> list[Record]:
        """Numbers of the drop that have no derivative: parameter, from_impact, reason."""
        return [Record(one) for one in self._data["refused"]]

    def of(self, parameter: str) -> list[Record]:
        """The rows of one number of the drop, one for each impact: gradient.of("angle")[0].velocity_after_z."""
        return [row for row in self.rows if row["parameter"] == parameter]


class Measured(Table):
    """What tracked drops say of impact laws."""

    @property
    def data(self) -> Record:
        """The tracks: file, drops, frames, torn ..."""
        return Record(self._data["data"])

    @property
    def calibration(self) -> Record:
        """What was found out of the tracking itself: turn, inertia_factor ..."""
        return Record(self._data["calibration"])


class Problem(Table):
    """A problem of the benchmark; the rows are its certified answer."""

    @property
    def starts(self) -> list[Record]:
        """Where the drop begins, in each of its phases: position, velocity, phi, omega, first_touch ..."""
        return [Record(start) for start in self._data["starts"]]


class Scored(Table):
    """Others' answers: a row for each file.  is_met: whether all do what was required."""

    def __init__(self, report: Report, is_met: bool) -> None:
        super().__init__(report)
        self.is_met = is_met

    def _beside(self) -> tuple[Any, ...]:
        return (self.is_met,)


class Summary(Table):
    """What many scenes are together: a row for each number, with count, least, p1, p5, p25, p50, p75, p95, p99, largest and the
    commands of the extremes; summary["energy_loss"] is that of a number, summary["p50"] a column."""

    @property
    def texts(self) -> dict[str, dict[str, int]]:
        """How often each text occurs, by the column: outcome ..."""
        return {name: dict(counts) for name, counts in self._data.get("texts", {}).items()}

    @property
    def attitudes(self) -> list[Record]:
        """The largest of each number at each listed attitude, the worst first; empty without a list."""
        return [Record(one) for one in self._data.get("attitudes", [])]

    def __getitem__(self, index: Any) -> Any:
        """A number's row, a column, or as in any result."""
        return named_row(self, "quantity", index)


class Ranking(Table):
    """The worst of all attitudes of a drop: a row for each face, edge and corner by its worst drop, as `clatter report --format csv`
    has them; of a body without such attitudes, or with drops=0, a row for each impact.  `message` says it in a sentence, to_dict() has
    all that was found."""

    @property
    def answer(self) -> Answer:
        """The worst blow: probe, attitude, impact, its numbers, ranked_by, largest, drops, notes ..."""
        return Answer(self._data["answer"])


_WHOLE = {"index", "impacts", "n", "hardest", "touches", *(key.key for key in KEYS.values() if key.kind == "whole")}


class Rows(Table):
    """Rows of a sweep or of regimes; `rows` holds a record for each.  Of rows of impacts n is None, in arrays NaN, in one that sums
    up all further impacts."""

    def _values(self, name: str, cells: list[Any]) -> list[Any]:
        def whole(value: Any) -> Any:
            return None if value == "tail" else int(value) if isinstance(value, float) else value
        return [whole(value) for value in cells] if name in _WHOLE or name.endswith("_impact") else cells

    def column(self, name: str) -> Array:
        """One value of each row, vectors as rows; NaN where there is none.  @raise KeyError: with how a sweep gets more columns."""
        parts = [f"{name}_{part}" for part in ("x", "y", "z", "q0", "q1", "q2", "q3") if f"{name}_{part}" in self._columns]
        if parts and name not in self._columns:
            return as_array([list(row) for row in zip(*(self._columns[part] for part in parts))])
        try:
            return super().column(name)
        except KeyError as error:
            if name in KEYS and KEYS[name].key in self._columns:
                raise KeyError(f"no '{name}' here; did you mean {KEYS[name].key}?") from None
            if "index" not in self._columns or "n" in self._columns:
                raise
            raise KeyError(f"{error.args[0]}; sweep(columns='impulse_normal_2') gives a number of impact 2, "
                           "rows='impact' a row for each impact") from None

    @property
    def scene(self) -> dict[str, Any]:
        """Everything that the first scene was computed with.  @raise AttributeError: regimes are of no scene."""
        if "scene" not in self._data:
            raise AttributeError("the rod's regimes have no scene; to_dict()['parameters'] tells them")
        return given_again(self._data["scene"])
