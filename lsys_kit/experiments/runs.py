"""Ensembles and sweeps: a system derived again and again, with other seeds or constants, and what is measured each time.

What comes out depends on the runs alone, never on who makes them or when (see `making`); what was finished before may stand in
a file (see `kept`).
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing, suppress
from dataclasses import replace
from itertools import islice, product
from math import prod
from pathlib import Path
from typing import Any

from lsys_kit.budget import check_bytes, current, limits
from lsys_kit.derivation.core.rules import constants_of, number_from
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError, require, shown, whole_number
from lsys_kit.experiments.kept import kept
from lsys_kit.experiments.making import ExecutorError, Experiment, Failure, Outcome, Run, outcomes
from lsys_kit.experiments.measures import Asked, Measure, measures_of
from lsys_kit.experiments.table import Table, value_text
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import function_of
from lsys_kit.notation.model.system import USUAL_STEPS, LSystem

BYTES_A_VALUE = 128
"""About what a value takes in a table, with what is needed to find it."""
MOST_STAGES = 1_000
"""The most stages of a system whose exact mean is found."""
MOST_FAILURES_TOLD = 3
"""Of so many runs that failed a remark says why."""
PROGRESS_DELAY = 1.0
"""What is finished sooner, in seconds, shows no progress bar."""


def ensemble(
    system: LSystem,
    seeds: int | Iterable[int],
    measure: Asked = "modules",
    *,
    steps: int | Iterable[int] | None = None,
    executor: Executor | None = None,
    file: str | Path | None = None,
    progress: bool = True,
    **choices: object,
) -> Table:
    """Derive a system once for each of many seeds, and measure what comes out.

    Parameters
    ----------
    system
        An L-system with chance.
    seeds
        How many runs, with the seeds 0, 1, 2, ...; or the seeds themselves.
    measure
        What is measured, or a list of that: "modules" or "length", the length of the word; "cells" of a filament; "strokes",
        "height" and "width" of the drawing; "rate", the growth per step in the long run; a symbol, whose modules are counted
        (of a cell with two polarities its letter); or a function of a derivation, which looks at its last word. A dictionary
        gives them names of their own.
    steps
        The step at which is measured, or several; by default the system's last step.
    executor
        Who makes the runs: any executor of `concurrent.futures`, or that of a cluster, `Client.get_executor()` of
        dask.distributed. By default this process does. What comes out is the same. On two free processors, two processes pay
        from half a second of work on, as 500 runs of K7 to step 5; a cluster of two workers from about a second.
    file
        The name of a file, which ends in .csv, that keeps what is finished as it comes. If the same is asked again, after a
        crash or with more seeds, values or steps, only what is missing there is made. Other forms are made of the table
        afterwards, as Parquet by `to_pandas().to_parquet(...)`.
    progress
        Whether a progress bar is shown if it takes more than a second.
    **choices
        `arithmetic` and new values of constants, as for `derive`.

    Returns
    -------
    Table
        A row for each run and step. If it is interrupted, as with Ctrl-C, or the executor breaks, what is finished until then.
        Runs that pass a limit, or whose process is lost each time, are left out (`Table.left_out`). Remarks below the table say
        so. Each run has the whole of the limits (see `limits`).

    Raises
    ------
    ModelNameError
        A measure or a constant is unknown.
    ModelValueError, ModelLimitError
        No run could be finished, or there are too many of them.
    ModelFileError
        The file cannot be written, or holds something else.

    Examples
    --------
    >>> from lsys_kit import read
    >>> plant = read("axiom: F\\nF -> F[+F]F : 1/2\\nF -> F[-F]F[+F]F : 1/2")
    >>> ensemble(plant, 3, "F", steps=2)
    seed  step   F
       0     2  13
       1     2  25
       2     2  19
    3 rows
    """
    require(system, LSystem, "An L-system")
    named = [{"seed": seed} for seed in seeds_from(seeds)]
    table = _table(system, ["seed"], named, measure, steps, executor, file, progress, choices)
    return replace(table, exact=_exact_means(system, steps_from(system, steps), measures_of(measure, system), choices))


def _exact_means(
    system: LSystem, steps: Sequence[int], measures: Sequence[Measure], choices: Mapping[str, object]
) -> Mapping[tuple[str, object], float]:
    """The exact means of what follows from how often each symbol occurs, at a single step; nothing where they are not known."""
    found = {each.name: value for each in measures if (value := each.of_counts())}
    if len(steps) > 1 or not found:
        return {}
    constants: dict[str, Any] = {name: value for name, value in choices.items() if name != "arithmetic"}
    with suppress(LSystemError), limits(states=MOST_STAGES):
        net = stages(system, **constants)
        counts: dict[str, Value] = {}
        for place, number in zip(net.places, net.expected(steps[0]), strict=True):
            counts[place.symbol] = counts.get(place.symbol, 0) + number
        return {(name, steps[0]): float(value(counts)) for name, value in found.items()}
    return {}


def sweep(
    system: LSystem,
    over: str | Sequence[str] | Mapping[str, Iterable[object]],
    measure: Asked = "modules",
    *,
    steps: int | Iterable[int] | None = None,
    executor: Executor | None = None,
    file: str | Path | None = None,
    progress: bool = True,
    **choices: object,
) -> Table:
    """Derive a system with each combination of some values of its constants, and measure what comes out.

    Parameters
    ----------
    system
        An L-system with constants.
    over
        For each constant that varies its values: `{"p": [0.1, 0.2]}`; "seed" varies, too, if it is named. Or the names of
        constants alone, which then take all the values of the range that the model declares (`p = 0.1 in 0 .. 1 by 0.1`).
    measure, steps, executor, file, progress, **choices
        As for `ensemble`.

    Returns
    -------
    Table
        A row for each combination and step; see `ensemble`.

    Raises
    ------
    ModelNameError
        A measure or a constant is unknown.
    ModelValueError, ModelLimitError
        A constant has no declared range, no run could be finished, or there are too many.

    Examples
    --------
    >>> from lsys_kit import read
    >>> alga = read("d = 2 in 1 .. 3\\naxiom: A(1)\\nA(t) : t < d -> A(t+1)\\nA(t) -> A(1) A(1)")
    >>> sweep(alga, "d", "rate")
    d  step     rate
    1     5        2
    2     5  1.41421
    3     5  1.25992
    3 rows
    """
    require(system, LSystem, "An L-system")
    values = _swept(system, over)
    _check_room(prod(map(len, values.values())))
    named = [dict(zip(values, chosen, strict=True)) for chosen in product(*values.values())]
    return _table(system, [*values], named, measure, steps, executor, file, progress, choices)


def _table(
    system: LSystem,
    keys: Sequence[str],
    runs: Sequence[Run],
    measure: Asked,
    steps: object,
    executor: Executor | None,
    file: str | Path | None,
    progress: bool,
    choices: Mapping[str, object],
) -> Table:
    require(progress, bool, 'True or False for "progress"')
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise ModelValueError(f"An executor of concurrent.futures is needed, not {shown(executor)}")
    check_names(system, keys, choices)
    columns = (*keys, "step", *(each.name for each in measures_of(measure, system)))
    for name in columns:
        if columns.count(name) > 1:
            raise ModelNameError(f'Two columns are called "{name}"', hint='Give the measure another name: {"size": ...}.')
    if not runs:
        raise ModelValueError("There is nothing to run", hint="Give at least one seed, or a value for each constant.")
    experiment = Experiment(system, steps_from(system, steps), measure, current())
    _check_room(len(runs) * len(experiment.steps) * len(columns))
    settings = [tuple(run[key] for key in keys) for run in runs]
    with kept(file, experiment, columns, len(keys), choices) as known:
        before = ((place, known.rows(setting)) for place, setting in enumerate(settings))
        found: dict[int, Outcome] = {place: rows for place, rows in before if rows}
        missing = {place: {**choices, **run} for place, run in enumerate(runs) if place not in found}
        stopped = ""
        with closing(outcomes(experiment, missing, executor)) as finished, _bar(len(missing), progress) as bar:
            try:
                for place, outcome in finished:
                    found[place] = outcome
                    if not isinstance(outcome, Failure):
                        known.keep(settings[place], outcome)
                    bar.update()
            except KeyboardInterrupt:
                stopped = "Stopped"
            except ExecutorError as fault:
                stopped = str(fault)
    rows: list[tuple[object, ...]] = []
    failures = []
    for place, outcome in sorted(found.items()):
        if isinstance(outcome, Failure):
            failures.append((settings[place], outcome))
        else:
            rows += [(*settings[place], *row) for row in outcome]
    if failures and not rows:
        raise failures[0][1].error()
    remarks = [f"{len(failures):,} of {len(runs):,} runs are left out:"] if failures else []
    for setting, failure in failures[:MOST_FAILURES_TOLD]:
        named = ", ".join(f"{key} = {value_text(value)}" for key, value in zip(keys, setting, strict=True))
        remarks.append(f"{named}: {failure.message}.")
    if stopped:
        remarks.append(f"{stopped}: {len(found):,} of {len(runs):,} runs are finished.")
    if known.broken:
        remarks.append(known.broken)
    left_out = tuple((*setting, failure.message) for setting, failure in failures)
    return Table(columns, tuple(rows), len(keys) + 1, tuple(remarks), left_out)


def _bar(runs: int, shown: bool) -> Any:
    from tqdm.auto import tqdm

    hidden = not shown or os.environ.get("TQDM_DISABLE", "0") not in ("", "0")  # tqdm's bar in notebooks does not look there
    return tqdm(total=runs, unit="run", leave=False, delay=PROGRESS_DELAY, disable=hidden)


def check_names(system: LSystem, keys: Sequence[str], choices: Mapping[str, object]) -> None:
    """Whatever is varied or chosen is a constant of the system, or something that `derive` takes."""
    constants = [constant.name for constant in system.constants]
    for name in (*keys, *choices):
        if name not in (*constants, "seed", "arithmetic"):
            known = f"Constants of the system are: {', '.join(constants)}." if constants else "It declares no constants."
            raise ModelNameError(f"The system has no constant {shown(name)}", hint=suggestion(name, constants) or known)
    for name in keys:
        if name in choices:
            raise ModelNameError(f'"{name}" is varied, and given a value as well')


def _check_room(values: int) -> None:
    check_bytes(values * BYTES_A_VALUE, lambda: "The table was not made")


def seeds_from(seeds: object) -> Sequence[int]:
    if isinstance(seeds, bool) or not isinstance(seeds, Iterable):
        many = whole_number(seeds, "The number of seeds")
        _check_room(many)
        return range(many)
    return [_seed(seed) for seed in _all_of(seeds)]


def _seed(given: object) -> int:
    if isinstance(given, str) or isinstance(number := number_from(given, "seed"), bool) or not isinstance(number, int):
        raise ModelValueError(f"A seed is a whole number, not {shown(given)}")
    return number


def _all_of(values: Iterable[object]) -> list[object]:
    most = current().bytes // BYTES_A_VALUE
    found = list(islice(iter(values), most + 1))
    _check_room(len(found))
    return found


def steps_from(system: LSystem, steps: object) -> tuple[int, ...]:
    if steps is None:
        return (USUAL_STEPS if system.steps is None else system.steps,)
    if isinstance(steps, str) or not isinstance(steps, Iterable):
        return (whole_number(steps, "The step"),)
    found = sorted({whole_number(step, "The step") for step in _all_of(steps)})
    if not found:
        raise ModelValueError("At least one step is needed")
    return tuple(found)


def _swept(system: LSystem, over: object) -> dict[str, list[Value]]:
    """For each name that varies its values, as exact numbers."""
    if not isinstance(over, Iterable):
        raise ModelValueError(f'Constants to vary are needed, as in {{"p": [1, 2]}}, not {shown(over)}')
    found = {}
    for name in [over] if isinstance(over, str) else over:
        require(name, str, "The name of a constant")
        found[name] = _values(name, over[name]) if isinstance(over, Mapping) else declared_values(system, name)
    return found


def _values(name: str, values: object) -> list[Value]:
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise ModelValueError(f'The values of "{name}" are needed, as in {{"{name}": [1, 2]}}, not {shown(values)}')
    return [_seed(value) if name == "seed" else number_from(value, name) for value in _all_of(values)]


def declared_values(system: LSystem, name: str) -> list[Value]:
    """The values of the range that a model declares for a constant.

    >>> from lsys_kit import read
    >>> [str(value) for value in declared_values(read("p = 1 in 0 .. 1 by 0.5\\naxiom: A"), "p")]
    ['0', '1/2', '1']
    """
    check_names(system, [name], {})
    order = {constant.name: place for place, constant in enumerate(system.constants)}
    span = next((constant.range for constant in system.constants if constant.name == name), None)
    if span is None:
        raise ModelValueError(
            f'The model declares no range for "{name}"',
            hint=f'Give its values, over={{"{name}": [1, 2, 3]}}, or write "in 1 .. 3" behind it.',
        )
    values = tuple(constants_of(system, {}))
    low, high, step = (function_of(part, order)(values) for part in span)
    many = int((high - low) // step) + 1 if step > 0 and high >= low else 1
    _check_room(many)
    return [normalised(low + place * step) for place in range(many)]
