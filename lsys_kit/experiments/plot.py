"""Plots of what a lesson counts and measures: of systems over their steps, of timed systems over time, of stages, of tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import dropwhile, islice, pairwise
from types import NoneType
from typing import Any, NamedTuple

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Choices, Derivation
from lsys_kit.derivation.growth.growth import Growth
from lsys_kit.derivation.petri.net import Place
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.derivation.tissues.development import Development
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError, require, shown, whole_number
from lsys_kit.experiments.measures import Asked, Measurable, Measure, measures_of
from lsys_kit.experiments.table import Table, column_label, measured_label
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value, is_symbolic
from lsys_kit.notation.model.cells import MapSystem
from lsys_kit.notation.model.expressions import Name
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.pictures.plots.chart import Axis, Chart, Curve, CurveChart, Plot, RowsChart, Share, ShareChart, finite, name_label
from lsys_kit.pictures.plots.lettering import literal, mathematics
from lsys_kit.pictures.style.labels import label_parts, place_parts, polar_symbols, steering_of, values_text
from lsys_kit.pictures.style.palette import BLUE, SERIES, colour_of
from lsys_kit.pictures.style.themes import theme_from
from lsys_kit.worlds.derive import derive

MOST_CURVES, DEFAULT_STEPS, MOST_STEPS = 6, 10, 5_000
"""The most kinds of modules that have curves of their own; the steps of a system that does not say how many; the most steps."""
STEEP, MANY_TURNS, MANY_TURNING = 4, 3, 3
"""The factor of every step from which on a scale is logarithmic; so many curves that turn so often are hard to follow."""
MOMENTS = 360
"""At so many moments a timed system is measured, and just before and after so many divisions."""


def plot(
    what: object,
    n: object = None,
    measure: Asked | None = None,
    *,
    log: bool | None = None,
    background: object = None,
    **choices: object,
) -> Plot:
    """Plot what is counted or measured.

    Parameters
    ----------
    what
        A system or a derivation: curves over its steps. A timed system (see `timed`): curves over time. A word: a parameter of
        its modules, as a concentration, along the word. Several of these, in a dictionary with their names: a curve for each.
        The stages of a system (see `stages`), or its `growth`: their frequencies, at a step or in the long run. A table of
        `ensemble`, `sweep` or `distances`: see `Table.plot`. A map system: its cells and walls.
    n
        The number of steps, or the time, to which curves go; the step at which stages are counted.
    measure
        What is measured, one thing or a list, as for `ensemble`; of a table the column; of a word the name that the parameter
        has in the productions. By default how often each kind of module occurs, of several systems the length of their words,
        and of a timed system the width of the drawing, which is the length of a filament.
    log
        Whether the scale is logarithmic, on which equal factors are equal distances. By default it is where all that is
        counted grows at least fourfold at every step; and what curves hardly show (one step, numbers that stay, many that go up
        and down) stands in rows of bars.
    background
        "light" or "dark" paper, "none", or a colour.
    **choices
        For systems `seed`, `arithmetic`, `field` and new values of constants, as for `derive`.

    Returns
    -------
    Plot
        A picture with a line of text; it can be saved as .svg, .png or .pdf.

    Raises
    ------
    ModelNameError
        A measure, a column or a constant is unknown.
    ModelValueError
        It cannot be plotted, or a number is too great.

    Examples
    --------
    >>> from lsys_kit import read
    >>> alga = read("axiom: a\\na -> a b\\nb -> a")
    >>> plot(alga, 12)
    2 curves (a, b) of modules, step n from 0 to 12, largest 233
    >>> plot({"alga": alga, "powers of two": read("axiom: a\\na -> a a")}, 8)
    2 curves (alga, powers of two) of length of the word, step n from 0 to 8, largest 256
    >>> spread = read("axiom: C(0) C(0) C(8) C(0)\\nC(x) < C(c) > C(y) -> C((x+2*c+y)/4)")
    >>> plot(derive(spread, 1)[-1], measure="c")
    1 curve of c, place in the word from 1 to 4, largest 4
    """
    require(log, (bool, NoneType), 'True or False for "log"')
    if background is not None:
        return replace(plot(what, n, measure, log=log, **choices), theme=theme_from(background))
    with Task("The plot was not made"):
        if isinstance(what, Table):
            _refuse(choices, n, "A table has its steps and constants")
            column: Any = measure
            return what.plot(column, bool(log))
        if isinstance(what, Stages | Growth):
            _refuse(choices, None if isinstance(what, Stages) else n, "Its constants are those of the system it was made of")
            if measure is not None or log:
                raise ModelValueError("Of stages the frequencies are shown, and nothing else is measured")
            return Plot(_stage_shares(what, n) if isinstance(what, Stages) else _long_run(what))
        if isinstance(what, MapSystem | Development):
            return Plot(_map_chart(what, n, measure, log, choices))
        return Plot(_curve_chart(what, n, measure, log, choices))


def _refuse(choices: Mapping[str, object], n: object, why: str) -> None:
    if choices or n is not None:
        name = next(iter(choices), "n")
        raise ModelNameError(f'{why}: there is no choice "{name}" here')


def _curve_chart(what: object, n: object, measure: Asked | None, log: bool | None, choices: Choices) -> Chart:
    if isinstance(what, Word):
        what = {"": what}
    if not isinstance(what, Mapping):
        return _chart_of_runs([("", _run(what, n, choices))], measure, log)
    if not what:
        raise ModelValueError("There is nothing to plot", hint='Name what is compared: {"with": ..., "without": ...}.')
    named = [(_name_label(str(name)), each) for name, each in islice(what.items(), MOST_CURVES + 1)]
    if len(named) > MOST_CURVES:
        raise ModelValueError(f"More than {MOST_CURVES} curves cannot be told apart", hint="Plot some of them.")
    if all(isinstance(each, Word) for _, each in named):
        _refuse(choices, n, "A word is at a step, and its constants have their values")
        return _along_words(named, measure, log)
    runs = [(name, _run(each, n, choices)) for name, each in named]
    if len({isinstance(run, Derivation) for _, run in runs}) > 1:
        raise ModelValueError("Steps and time do not stand along one axis", hint="Plot derivations, or timed systems.")
    return _chart_of_runs(runs, measure, log)


class _Course(NamedTuple):
    """A timed system up to a time."""

    system: Timed
    end: Value

    @property
    def states(self) -> States:
        return self.system.states


def _run(what: object, n: object, choices: Choices) -> Derivation | _Course:
    if isinstance(what, Timed):
        _refuse(choices, None, "The constants of a timed system are chosen when it is made")
        end = number_from(5 if n is None else n, "n")
        if is_symbolic(end) or end <= 0:
            raise ModelValueError(f"The time must be a number above 0, not {shown(n)}")
        return _Course(what, end)
    if isinstance(what, Derivation):
        _refuse(choices, n, "The steps and constants of a derivation are chosen already")
        return what
    if not isinstance(what, LSystem):
        raise ModelValueError(
            f"Systems, derivations, words, timed systems, stages, growth and tables can be plotted, not {type(what).__name__}"
        )
    steps = whole_number(n, "The number of steps") if n is not None else DEFAULT_STEPS if what.steps is None else what.steps
    if steps > MOST_STEPS:
        raise ModelLimitError(f"A plot shows at most {MOST_STEPS:,} steps", limit=MOST_STEPS, needed=steps)
    return derive(what, steps, **choices)


def _along_words(words: Sequence[tuple[str, Any]], name: Asked | None, log: bool | None) -> CurveChart:
    """The curves of a parameter along some words."""
    if not isinstance(name, str):
        raise ModelValueError("Along a word one parameter is shown", hint='Name it as the productions do: measure="c".')
    curves = tuple(
        Curve(_along(word, name), BLUE if len(words) == 1 else SERIES[place], label)
        for place, (label, word) in enumerate(words)
    )
    return CurveChart(curves, Axis("place in the word", True), Axis(name_label(name), False, bool(log)))


def _along(word: Word, name: str) -> tuple[tuple[float, float], ...]:
    """The values of a parameter with their places in a word, counted from 1."""
    system = word.states.system
    known = [rule.predecessor for rule in (*system.productions, *system.decomposition, *system.interpretation)]
    where = {each.symbol: each.arguments.index(Name(name)) for each in reversed(known) if Name(name) in each.arguments}
    if not where:
        names = [*dict.fromkeys(str(each) for rule in known for each in rule.arguments if isinstance(each, Name))]
        raise ModelNameError(
            f'No module has a parameter "{name}"',
            hint=suggestion(name, names) or f"Parameters are: {', '.join(names) or 'none'}.",
        )
    found = [
        (place, module.arguments[where[module.symbol]])
        for place, module in enumerate(counted(word), 1)
        if module.symbol in where
    ]
    values = finite([value for _, value in found], f'The parameter "{name}"')
    return tuple((float(place), value) for (place, _), value in zip(found, values, strict=True))


def _chart_of_runs(runs: Sequence[tuple[str, Derivation | _Course]], measure: Asked | None, log: bool | None) -> Chart:
    """The curves of some runs, of which one may be measured in several ways."""
    first, several = runs[0][1], len(runs) > 1
    course = isinstance(first, _Course)
    asked = measure
    if asked is None:
        asked = "width" if isinstance(first, _Course) else "length" if several else _kinds(first)
    curves: list[Curve] = []
    names = []
    for name, run in runs:
        measures = measures_of(asked, run.states.system)
        names = [each.name for each in measures]
        if several and len(names) > 1:
            raise ModelValueError("Of several systems one thing is measured", hint=f'Choose one: measure="{names[0]}".')
        system = run.states.system
        for each, along in zip(names, _points(run, measures), strict=True):
            label = name if several else _measure_label(each, system) if len(names) > 1 else ""
            curves.append(Curve(along, _colour(each, system, len(curves), several), label))
    counts = all(value == int(value) for curve in curves for _, value in curve.points)
    up = measured_label(names[0]) if len(names) == 1 else "modules" if measure is None else "value"
    if names == ["width"] and all(drawing_mode(run.states.system) is DrawingMode.FILAMENT for _, run in runs):
        up = "length of the filament"
    across = Axis("time $t$") if course else Axis(column_label("step"), True)
    if log is None and counts and not course and _needs_rows(curves):
        return RowsChart(tuple(curves), across, Axis(up))
    steep = not course and _is_steep(curves) if log is None else log
    return CurveChart(tuple(curves), across, Axis(up, counts, steep), unbroken=course)


def _is_steep(curves: Sequence[Curve]) -> bool:
    """Whether all together grow so fast that on a linear scale all but the last two steps lie on the axis."""
    sums = Counter[float]()
    for curve in curves:
        sums.update(dict(curve.points))
    seen = [*dropwhile(lambda value: value <= 0, (sums[step] for step in sorted(sums)))]
    hidden = any(value < 0 for curve in curves for _, value in curve.points)
    return len(seen) > 2 and not hidden and all(after >= STEEP * before for before, after in pairwise(seen))


def _needs_rows(curves: Sequence[Curve]) -> bool:
    """Whether curves of counts show little: one step, no change after it, or several that go up and down."""
    values = [[value for _, value in curve.points] for curve in curves]
    if min(min(each) for each in values) < 0:
        return False
    turning = [each for each in values if _turns(each) >= MANY_TURNS]
    return all(len({*each[1:]}) <= 1 for each in values) or len(turning) >= MANY_TURNING


def _turns(values: Sequence[float]) -> int:
    """How often numbers begin to rise or to fall.

    >>> _turns([0, 1, 1, 0, 0, 1])
    2
    """
    rises = [after > before for before, after in pairwise(values) if after != before]
    return sum(before != after for before, after in pairwise(rises))


def _name_label(name: str) -> str:
    """The name of a curve; where it gives a constant its value, the constant is mathematics.

    >>> _name_label("t_s = 0.1"), _name_label("with the meta-rule")
    ('$\\\\mathit{t}_{\\\\mathrm{s}}$ = 0.1', 'with the meta-rule')
    """
    before, equals, value = name.partition(" = ")
    return f"{name_label(before)} = {literal(value)}" if equals and before.isidentifier() else literal(name)


def _points(run: Derivation | _Course, measures: Sequence[Measure]) -> list[tuple[tuple[float, float], ...]]:
    if isinstance(run, Derivation):
        places: list[Value] = [*range(len(run))]
        seen: list[Measurable] = [run.to(step) for step in counted(range(len(run)), 1)]
    else:
        timed, grid = run.system, [run.end * Fraction(place, MOMENTS) for place in range(MOMENTS + 1)]
        words: dict[Value, tuple[Word, ...]] = {place: (timed.word(place),) for place in counted(grid, 1)}
        words |= {moment: timed.around(moment) for moment in counted(islice(timed.divisions(run.end), MOMENTS), 1)}
        places, seen = map(list, zip(*((place, word) for place in sorted(words) for word in words[place]), strict=True))
    found = [finite([each.value(one) for one in counted(seen, 1)], f'The measure "{each.name}"') for each in measures]
    return [tuple(zip(map(float, places), values, strict=True)) for values in found]


def _kinds(run: Derivation) -> list[str]:
    """The kinds of modules that occur and do not only steer the turtle, if their curves can be told apart; else all modules
    together."""
    system, modules = run.states.system, run.states.modules
    met = {modules[state].symbol for step in counted(range(len(run)), 1) for state in run.counts(step)}
    steering = steering_of(system) - {rule.predecessor.symbol for rule in system.productions}
    shown = [symbol for symbol in symbols(system) if symbol in met - steering and symbol[0].isalnum()]
    kinds = [*dict.fromkeys(polar_symbols(system).get(symbol, (symbol, ""))[0] for symbol in shown)]
    return kinds if 1 <= len(kinds) <= MOST_CURVES else ["modules"]


def _measure_label(name: str, system: LSystem) -> str:
    if name in symbols(system) or name[:1].isupper():
        return mathematics(*label_parts(name, system))
    return measured_label(name).removeprefix("number of ")


def _colour(name: str, system: LSystem, place: int, several: bool) -> str:
    """The colour of a symbol for its counts; else the next one."""
    polar = [symbol for symbol, (letter, _) in polar_symbols(system).items() if letter == name]
    if not several and (polar or name in symbols(system)):
        return colour_of(polar[0] if polar else name, system)
    return BLUE if not several and place == 0 else SERIES[place % len(SERIES)]


def _map_chart(
    what: MapSystem | Development, n: Any, measure: object, log: bool | None, choices: Mapping[str, object]
) -> CurveChart:
    _refuse(choices, n if isinstance(what, Development) else None, "A map system has no constants")
    if measure is not None:
        raise ModelValueError("Of a map system cells and walls are counted, and nothing else is measured")
    found = what if isinstance(what, Development) else derive(what, 5 if n is None else n)
    counts = [tuple(map(float, column)) for column in zip(*found.counts, strict=True)]
    kinds = (1, "walls"), (2, "cells")
    curves = tuple(Curve(tuple(enumerate(counts[place])), SERIES[place], label) for place, label in kinds)
    return CurveChart(curves, Axis(column_label("step"), True), Axis("number", True, bool(log)))


def _stage_shares(net: Stages, n: object) -> ShareChart:
    system = net.system
    steps = whole_number(n, "The step") if n is not None else DEFAULT_STEPS if system.steps is None else system.steps
    amounts = finite(net.expected(steps), "A stage")
    labels = [mathematics(*place_parts(place, system)) for place in net.places]
    return _shares(labels, amounts, net.places, system, f"at step {steps:,}", "stages")


def _long_run(found: Growth) -> ShareChart:
    """The share of each state in the long run."""
    shares = found.frequencies
    if shares is None:
        raise ModelValueError(
            "The frequencies do not settle in the long run: they go on swinging, or the word vanishes",
            hint="Look at a step: plot(stages(system), 20).",
        )
    system = found.table.system
    labels = [mathematics(*label_parts(module.symbol, system), values_text(module)) for module in found.states]
    return _shares(labels, shares, found.states, system, "in the long run", "states")


def _shares(
    labels: Sequence[str], amounts: Sequence[float], kinds: Sequence[Place | Module], system: LSystem, when: str, name: str
) -> ShareChart:
    whole, many = sum(amounts), len(kinds)
    if not whole:
        raise ModelValueError(f"There is no module {when}")
    if many > 40:
        raise ModelLimitError(f"A plot shows at most 40 {name}, and here are {many:,}", limit=40, needed=many)
    shares = zip(labels, amounts, kinds, strict=True)
    return ShareChart(
        tuple(Share(label, amount / whole, colour_of(kind.symbol, system)) for label, amount, kind in shares), when, name
    )
