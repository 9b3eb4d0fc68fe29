"""Tables: what runs have come to, a row for each run and step, as data are kept tidily (Wickham, Tidy Data, 2014).

Which chart a table has depends on what varied: over the seeds alone, or over the pairs of a word, it is a histogram; over the
steps or one constant a curve; over two constants a grid; over a constant and the steps a curve for each value. Where the seeds
vary besides, curves and grids show means, a curve also the single runs.
"""

from __future__ import annotations

import statistics
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import groupby, islice
from statistics import fmean
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeAlias

from lsys_kit.budget import Task
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import ModelNameError, ModelValueError, require, shown
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.pictures.plots.chart import Axis, Chart, Curve, CurveChart, GridChart, HistogramChart, Plot, finite, name_label
from lsys_kit.pictures.plots.lettering import literal
from lsys_kit.pictures.style.labels import escaped, visible
from lsys_kit.pictures.style.palette import BLUE, SERIES
from lsys_kit.pictures.style.themes import LIGHT, theme_from

if TYPE_CHECKING:
    import pandas
    import xarray


MOST_CURVES, MOST_RUNS = 8, 200
"""The most curves that can be told apart; the most single runs that are drawn behind a mean."""
SEED, STEP, PAIR = "seed", "step", "pair"
REPEATED = {SEED, PAIR}
"""What is no axis: of its values only how they are spread is asked."""
LABELS = {
    "modules": "modules",
    "length": "length of the word",
    "cells": "cells",
    "strokes": "strokes",
    "height": "height",
    "width": "width",
    "rate": "growth per step",
    STEP: "step $n$",
    SEED: SEED,
}
"""What stands along an axis for columns with a name of the kit's."""


def column_label(name: str) -> str:
    """The label of a column.

    >>> column_label("rate"), column_label("lifeTimeA")
    ('growth per step', '$\\\\mathit{lifeTimeA}$')
    """
    return LABELS.get(name) or name_label(name)


def measured_label(name: str) -> str:
    """The label of what was measured: of a symbol that its modules were counted.

    >>> measured_label("height"), measured_label("F")
    ('height', 'number of $\\\\mathit{F}$')
    """
    return LABELS.get(name) or (f"number of {name_label(name)}" if len(name) <= 2 else literal(name))


Row: TypeAlias = tuple[Any, ...]
"""Values of a table: numbers, most of them."""
Rows = Sequence[tuple[dict[str, Value], float]]
"""For each row its settings and the measured value."""


def chart_of(table: Table, column: str, log: bool) -> Chart:
    """The chart of a measured column, refused where too much varied at once, or nothing."""
    keys, values = table.varied, table[column]
    places = {key: table.columns.index(key) for key in keys}
    settings = [{key: row[place] for key, place in places.items()} for row in table.rows]
    found = list(zip(settings, finite(values, f'The column "{column}"'), strict=True))
    up = Axis(measured_label(column), all(isinstance(value, int) for value in values), log)
    over = [key for key in keys if key not in REPEATED]
    if not keys:
        raise ModelValueError(
            "Only one setting was run, and a plot compares several", hint="Take more seeds, steps or values of a constant."
        )
    if not over:
        counted, step = ("pairs", None) if PAIR in keys else ("runs", table[STEP][0])
        return HistogramChart(
            tuple(value for _, value in found), up._replace(log=False), counted, table.exact.get((column, step))
        )
    if len(over) == 1:
        return _one_variable(found, over[0], up)
    if len(over) == 2 and STEP in over:
        return _families(found, next(key for key in over if key != STEP), up)
    if len(over) == 2:
        return _grid(found, over, up)
    chosen = ", ".join(f"{key} = {found[0][0][key]}" for key in over[2:])
    raise ModelValueError(
        f"{' and '.join((', '.join(over[:-1]), over[-1]))} vary together, and a plot shows two of them",
        hint=f"Choose the others, as in table.where({chosen}).plot().",
    )


def _one_variable(rows: Rows, name: str, up: Axis) -> Chart:
    """A curve over a variable; over seeds besides the mean, with the runs behind it."""
    across = Axis(column_label(name), all(isinstance(setting[name], int) for setting, _ in rows))
    if not any(SEED in setting for setting, _ in rows):
        return CurveChart((Curve(_means(rows, name), BLUE),), across, up)
    runs: dict[object, list[tuple[float, float]]] = {}
    for setting, value in rows:
        runs.setdefault(setting[SEED], []).append((float(setting[name]), value))
    quiet = (Curve(tuple(sorted(points)), BLUE, quiet=True) for points in islice(runs.values(), MOST_RUNS))
    return CurveChart((*quiet, Curve(_means(rows, name), BLUE, "mean")), across, up)


def _families(rows: Rows, name: str, up: Axis) -> Chart:
    kinds = sorted({setting[name] for setting, _ in rows})
    if len(kinds) > MOST_CURVES:
        raise ModelValueError(
            f"{name} has {len(kinds)} values, and more than {MOST_CURVES} curves cannot be told apart",
            hint="Choose some values, or one step: table.where(step=...).plot().",
        )
    curves = tuple(
        Curve(
            _means([row for row in rows if row[0][name] == kind], STEP),
            SERIES[place % len(SERIES)],
            f"{column_label(name)} = {number_text(kind)}",
        )
        for place, kind in enumerate(kinds)
    )
    return CurveChart(curves, Axis(column_label(STEP), True), up)


def _grid(rows: Rows, names: Sequence[str], up: Axis) -> Chart:
    columns, lines = (sorted({setting[name] for setting, _ in rows}) for name in names)
    cells: dict[tuple[int, int], list[float]] = {}
    places = [{value: place for place, value in enumerate(values)} for values in (columns, lines)]
    for setting, value in rows:
        cells.setdefault((places[0][setting[names[0]]], places[1][setting[names[1]]]), []).append(value)
    across, upwards = map(column_label, names)
    means = {place: fmean(values) for place, values in cells.items()}
    return GridChart(across, upwards, tuple(map(number_text, columns)), tuple(map(number_text, lines)), means, up.label)


def _means(rows: Rows, name: str) -> tuple[tuple[float, float], ...]:
    groups: dict[float, list[float]] = {}
    for setting, value in rows:
        groups.setdefault(float(setting[name]), []).append(value)
    return tuple((x, fmean(groups[x])) for x in sorted(groups))


MOST_SHOWN = 10
"""How many rows of a long table are shown: its first ones and its last ones."""
SUMMARY = ("mean", "sd", "least", "median", "greatest")
"""The columns of a summary, behind the number of values."""


@dataclass(frozen=True)
class Table:
    """A table: what varied, what was measured, and a row for each run and step.

    Attributes
    ----------
    columns
        The names of the columns: first what varied, such as a seed, a constant or the step, then what was measured.
    rows
        The values, exact where the model computes exactly.
    keys
        How many of the columns say what varied.
    remarks
        What there is to say of runs that are not in the table.
    left_out
        For each run that could not be finished the values of what varied, without the step, and why.
    exact
        For measured columns and steps the exact mean over all that chance may do, where the kit knows it.

    Examples
    --------
    >>> table = Table(("seed", "step", "F"), ((0, 2, 9), (1, 2, 25)), 2)
    >>> table
    seed  step   F
       0     2   9
       1     2  25
    2 rows
    >>> table["F"], table.where(seed=1).rows
    ((9, 25), ((1, 2, 25),))
    """

    columns: tuple[str, ...]
    rows: tuple[Row, ...]
    keys: int
    remarks: tuple[str, ...] = field(default=())
    left_out: tuple[Row, ...] = field(default=())
    exact: Mapping[tuple[str, object], float] = field(default_factory=dict, compare=False, repr=False)

    @property
    def measures(self) -> tuple[str, ...]:
        """The columns that were measured."""
        return self.columns[self.keys :]

    @property
    def varied(self) -> tuple[str, ...]:
        """What varied and has more than one value here."""
        return tuple(name for name in self.columns[: self.keys] if len(set(self[name])) > 1)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, column: str) -> Row:
        """The values of a column."""
        place = self._place(column)
        return tuple(row[place] for row in self.rows)

    def _place(self, column: object) -> int:
        if isinstance(column, str) and column in self.columns:
            return self.columns.index(column)
        raise ModelNameError(
            f"There is no column {shown(column)}",
            hint=suggestion(column, self.columns) or f"Columns are: {', '.join(self.columns)}.",
        )

    def where(self, **values: object) -> Table:
        """The rows in which some columns have given values.

        >>> Table(("p", "F"), ((Fraction(1, 2), 3), (1, 5)), 1).where(p=0.5)["F"]
        (3,)
        """
        wanted = {self._place(name): number_from(value, name) for name, value in values.items()}
        chosen = (row for row in self.rows if all(row[place] == value for place, value in wanted.items()))
        return replace(self, rows=tuple(chosen))

    def summary(self, column: str | None = None) -> Table:
        """The distribution of a measured column over the seeds: how many runs (or pairs, see `distances`), their mean and
        standard deviation, the least, the median and the greatest value; a row for each setting of all that varied besides.

        Parameters
        ----------
        column
            What was measured; by default the first of that.

        Examples
        --------
        >>> table = Table(("seed", "step", "F"), ((0, 2, 9), (1, 2, 25), (2, 2, 20)), 2)
        >>> table.summary("F")
        step  runs  mean       sd  least  median  greatest
           2     3    18  8.18535      9      20        25
        1 row
        """
        place = self._place(self.measured(column))
        settings = [index for index in range(self.keys) if self.columns[index] not in REPEATED]

        def setting(row: Row) -> Row:
            return tuple(row[index] for index in settings)

        groups = groupby(sorted(self.rows, key=setting), key=setting)
        rows = tuple((*given, *_described([row[place] for row in group])) for given, group in groups)
        counted = "pairs" if PAIR in self.columns[: self.keys] else "runs"
        return Table((*(self.columns[index] for index in settings), counted, *SUMMARY), rows, len(settings))

    def measured(self, column: object = None) -> str:
        """The name of a measured column; by default the first one."""
        if column is None:
            return self.measures[0]
        if self._place(column) < self.keys:
            raise ModelNameError(f'"{column}" was varied, not measured', hint=f"Measured were: {', '.join(self.measures)}.")
        return str(column)

    def plot(self, column: str | None = None, log: bool = False, background: object = None) -> Plot:
        """A plot of a measured column: over seeds its distribution, over steps or one constant a curve, over two constants a
        grid of colours and numbers.

        Parameters
        ----------
        column
            What was measured; by default the first of that.
        log
            Whether curves have a logarithmic scale, on which equal factors are equal distances.
        background
            "light" or "dark" paper, "none", or a colour.

        Raises
        ------
        ModelValueError
            More than two constants vary, or nothing does.

        Examples
        --------
        >>> Table(("d", "step", "cells"), ((1, 5, 32), (2, 5, 4), (3, 5, 2)), 2).plot()
        1 curve of cells, d from 1 to 3, largest 32
        """
        require(log, bool, 'True or False for "log"')
        name = self.measured(column)
        with Task("The plot was not made"):
            return Plot(chart_of(self, name, log), theme=LIGHT if background is None else theme_from(background))

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a data frame of pandas, which has to be installed; fractions become doubles."""
        frames = _library("pandas")
        return frames.DataFrame({name: list(map(_plain, self[name])) for name in self.columns})

    def to_xarray(self) -> xarray.Dataset:
        """What was measured as arrays over what varied, for xarray, which has to be installed with pandas; fractions become
        doubles."""
        _library("xarray")
        frame = self.to_pandas()
        found: xarray.Dataset = frame.set_index(list(self.columns[: self.keys])).to_xarray()
        return found

    def __repr__(self) -> str:
        lines = [tuple(map(visible, self.columns)), *self._shown_rows()]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        table = ["  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True)) for line in lines]
        return "\n".join([*table, self._count, *self.remarks])

    def _repr_html_(self) -> str:
        head = "".join(f'<th scope="col">{escaped(name)}</th>' for name in self.columns)
        body = "".join(f"<tr>{''.join(f'<td>{escaped(text)}</td>' for text in row)}</tr>" for row in self._shown_rows())
        notes = "".join(f"<p>{escaped(remark)}</p>" for remark in self.remarks)
        caption = f'<caption style="caption-side:bottom">{self._count}</caption>'
        return f"<table>{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{notes}"

    @property
    def _count(self) -> str:
        return f"{len(self):,} row{'s' * (len(self) != 1)}"

    def _shown_rows(self) -> Iterator[tuple[str, ...]]:
        """The texts of the rows; of a long table the middle is left out."""
        half = MOST_SHOWN // 2
        for number, row in enumerate(self.rows):
            if len(self) <= MOST_SHOWN or not half <= number < len(self) - half:
                yield tuple(map(value_text, row))
            elif number == half:
                yield ("...",) * len(self.columns)


def value_text(value: Any) -> str:
    """A value of a table as it is shown: doubles with six digits.

    >>> value_text(Fraction(7, 10)), value_text(2 / 3), value_text(12)
    ('0.7', '0.666667', '12')
    """
    return f"{value:.6g}" if isinstance(value, float) else number_text(value)


def _plain(value: object) -> object:
    return float(value) if isinstance(value, Fraction) else value


def _described(values: Sequence[Any]) -> Row:
    spread = statistics.stdev(map(float, values)) if len(values) > 1 else 0.0
    mean = statistics.fmean(values)
    return len(values), mean, spread, min(values), statistics.median(values), max(values)


def _library(name: str) -> ModuleType:
    from importlib import import_module

    try:
        return import_module(name)
    except ImportError:
        raise ModelValueError(f"{name} is not installed", hint=f"Install it: pip install {name}.") from None
