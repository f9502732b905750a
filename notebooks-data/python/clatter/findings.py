# SPDX-License-Identifier: GPL-3.0-or-later
"""What explanations, plans, studies of cost, sweeps, regimes, measurements and scores return."""

from collections.abc import Iterator
from typing import Any, overload

from clatter.arrays import Array
from clatter.records import Record, column_of
from clatter.results import Report, Result, given_again


class Explanation(Result):
    """How an impact came about; `steps` holds records with title, text and equations, each of these a record with name,
    symbolic, numeric, tex, words, value, error and unit."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.steps = [Record({**step, "equations": [Record(e) for e in step["equations"]]}) for step in self._data["steps"]]

    @property
    def impact(self) -> int:
        """Its number, from 1."""
        return int(self._data["impact"])

    def __len__(self) -> int:
        return len(self.steps)

    def __getitem__(self, title: str) -> dict[str, float | None]:
        """The values of the step of this title by their names."""
        for step in self.steps:
            if step["title"] == title:
                return {e["name"]: e["value"] for e in step["equations"]}
        raise KeyError(title)


class Plan(Result):
    """The models that could run a scene: `rungs` holds a record for each with its error and cost, `choice` the chosen
    one with its command."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.rungs = [Record(rung) for rung in self._data["rungs"]]
        self.choice = Record(self._data["choice"])

    def __len__(self) -> int:
        return len(self.rungs)

    def __getitem__(self, model: str) -> Record:
        """The entry of a model: plan["discrete"]."""
        for rung in self.rungs:
            if rung["model"] == model:
                return rung
        raise KeyError(model)


class Tradeoff(Result):
    """What accuracy costs: `points` holds a record for each model and setting with seconds, evaluations and error."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self.points = [Record(point) for point in self._data["points"]]

    @property
    def front(self) -> list[Record]:
        """The points that nothing beats in both cost and error."""
        return [point for point in self.points if point["front"]]

    def column(self, name: str) -> Array:
        """One value of each point; NaN where there is none."""
        return column_of(self._data["points"], name)

    def __len__(self) -> int:
        return len(self.points)


class Table(Result):
    """Rows of CSV; `rows` holds a record for each."""

    def __init__(self, report: Report) -> None:
        super().__init__(report)
        self._rows = report.rows()
        self.rows = [Record(row) for row in self._rows]

    @property
    def scene(self) -> dict[str, Any]:
        """Everything that was computed with.  @raise AttributeError: the rows are not of one scene."""
        if "scene" not in self._data:
            raise AttributeError("these rows are not of one scene; to_dict() tells what there is")
        return given_again(self._data["scene"])

    def column(self, name: str) -> Array:
        """One value of each row, vectors as rows; NaN where there is none.  NAME_error is its error, NAME_z a vector's part."""
        return column_of(self._rows, name)

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Record]:
        return iter(self.rows)

    @overload
    def __getitem__(self, index: int) -> Record: ...
    @overload
    def __getitem__(self, index: str) -> Array: ...
    def __getitem__(self, index: int | str) -> Record | Array:
        """The record of a row, or a column by its name."""
        return self.column(index) if isinstance(index, str) else self.rows[index]


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


class Rows(Table):
    """Rows of a sweep or of regimes; `rows` holds a record for each."""

    @property
    def scene(self) -> dict[str, Any]:
        """Everything that the first scene was computed with.  @raise AttributeError: regimes are of no scene."""
        if "scene" not in self._data:
            raise AttributeError("the rod's regimes have no scene; to_dict()['parameters'] tells them")
        return given_again(self._data["scene"])
