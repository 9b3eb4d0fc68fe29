"""The chart of a table: which one depends on what varied.

Over the seeds alone it is a histogram; over the steps or one constant a curve; over two constants a grid; over a constant and
the steps a curve for each value. Where the seeds vary besides, curves and grids show means, a curve also the single runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from statistics import fmean
from typing import Any

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.pictures.plots.bars import HistogramChart
from lsys_kit.pictures.plots.chart import Axis, Chart, finite, name_label
from lsys_kit.pictures.plots.curves import Curve, CurveChart
from lsys_kit.pictures.plots.grid import GridChart
from lsys_kit.pictures.plots.lettering import literal
from lsys_kit.pictures.style.palette import BLUE, SERIES

MOST_CURVES, MOST_RUNS = 8, 200
"""The most curves that can be told apart; the most single runs that are drawn behind a mean."""
SEED, STEP = "seed", "step"
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


Rows = Sequence[tuple[dict[str, Any], float]]
"""For each row its settings and the measured value."""


def chart_of(keys: Sequence[str], rows: Sequence[tuple[Any, ...]], column: str, values: Sequence[Any], log: bool) -> Chart:
    """The chart of a measured column.

    Parameters
    ----------
    keys
        What varied and has more than one value.
    rows
        The values of these, for each run and step.
    column, values
        What was measured, and its values.
    log
        Whether curves have a logarithmic scale.

    Raises
    ------
    ModelValueError
        Too much varied at once, or nothing.
    """
    found = [
        (dict(zip(keys, row, strict=True)), value)
        for row, value in zip(rows, finite(values, f'The column "{column}"'), strict=True)
    ]
    up = Axis(measured_label(column), all(isinstance(value, int) for value in values), log)
    over = [key for key in keys if key != SEED]
    if not keys:
        raise ModelValueError(
            "Only one setting was run, and a plot compares several", hint="Take more seeds, steps or values of a constant."
        )
    if not over:
        return HistogramChart(tuple(value for _, value in found), up._replace(log=False))
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
    if any(SEED in setting for setting, _ in rows):
        seeds = [*dict.fromkeys(setting[SEED] for setting, _ in rows)]
        runs = [Curve(_points(rows, name, SEED, seed), BLUE, quiet=True) for seed in seeds[:MOST_RUNS]]
        return CurveChart((*runs, Curve(_means(rows, name), BLUE, "mean")), across, up)
    return CurveChart((Curve(_means(rows, name), BLUE),), across, up)


def _families(rows: Rows, name: str, up: Axis) -> Chart:
    """A curve over the steps for each value of a variable."""
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


def _points(rows: Rows, name: str, key: str, value: object) -> tuple[tuple[float, float], ...]:
    return tuple(sorted((float(setting[name]), number) for setting, number in rows if setting[key] == value))


def _means(rows: Rows, name: str) -> tuple[tuple[float, float], ...]:
    """For each value of a variable the mean of what was measured."""
    groups: dict[float, list[float]] = {}
    for setting, value in rows:
        groups.setdefault(float(setting[name]), []).append(value)
    return tuple((x, fmean(groups[x])) for x in sorted(groups))
