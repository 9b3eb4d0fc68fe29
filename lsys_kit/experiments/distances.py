"""Distances: how far apart the modules of one kind stand in a word, as the heterocysts of a filament do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

from lsys_kit.budget import counted
from lsys_kit.derivation.core.words import Word
from lsys_kit.errors import ModelNameError, ModelValueError, require
from lsys_kit.experiments.measures import symbols_named
from lsys_kit.experiments.runs import check_names, seeds_from, steps_from
from lsys_kit.experiments.table import PAIR, SEED, STEP, Table
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.modules import CLOSING, OPENING
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.worlds.derive import derive


def distances(
    system: LSystem, symbol: str, seeds: int | Iterable[int] = 1, *, steps: int | Iterable[int] | None = None, **choices: object
) -> Table:
    """How far apart the modules with a symbol stand in the words of a system.

    Parameters
    ----------
    system
        An L-system without branches.
    symbol
        The symbol; of a cell with two polarities its letter.
    seeds
        How many runs, with the seeds 0, 1, 2, ...; or the seeds themselves.
    steps
        The step, or several; by default the system's last step.
    **choices
        `arithmetic` and new values of constants, as for `derive`.

    Returns
    -------
    Table
        A row for each pair of such modules with none between them, numbered from left to right. The distance is 1 where they
        are neighbours, and one more than the number of modules between them in general. `plot()` shows how the distances are
        spread, `summary()` their mean.

    Raises
    ------
    ModelNameError
        A symbol or a constant is unknown.
    ModelValueError
        A word has branches, or no word has two such modules.

    Examples
    --------
    >>> from lsys_kit import read
    >>> alga = read("axiom: a\\na -> a b\\nb -> a")
    >>> print(derive(alga, 4)[-1])
    a b a a b a b a
    >>> distances(alga, "b", steps=4)["distance"]
    (3, 2)
    """
    require(system, LSystem, "An L-system")
    require(symbol, str, "A symbol")
    wanted = symbols_named(symbol, system)
    if not wanted:
        raise ModelNameError(f'No module is called "{symbol}"', hint=suggestion(symbol, symbols(system)))
    check_names(system, [SEED], choices)
    rows = tuple(
        (seed, step, pair, distance)
        for seed in seeds_from(seeds)
        for step, word in _words(system, steps_from(system, steps), seed, choices)
        for pair, distance in enumerate(_between(word, wanted), 1)
    )
    if not rows:
        raise ModelValueError(f'Nowhere are there two modules "{symbol}" in a word', hint="Take more steps, or more seeds.")
    return Table((SEED, STEP, PAIR, "distance"), rows, 3)


def _words(system: LSystem, steps: tuple[int, ...], seed: int, choices: dict[str, Any]) -> Iterator[tuple[int, Word]]:
    words = derive(system, max(steps), seed=seed, **choices)
    yield from ((step, words[step]) for step in steps)


def _between(word: Word, wanted: frozenset[str]) -> Iterator[int]:
    """The distances of neighbouring modules with one of some symbols."""
    places = []
    for place, module in enumerate(counted(word)):
        if module.symbol in OPENING | CLOSING:
            raise ModelValueError("A word with branches has no distances along it")
        if module.symbol in wanted:
            places.append(place)
    return (right - left for left, right in pairwise(places))
