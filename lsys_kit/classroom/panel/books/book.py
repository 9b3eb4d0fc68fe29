"""The book of a system: all that a browser needs to show its steps, for one setting of the constants, as JSON.

The table of states is small, so it is sent once and the browser turns the pages. Where a state alone decides what becomes of
it, the book holds the successors and the browser makes the words; where neighbours, chance or questions to the turtle have a
say, it holds the words of the steps as numbers, and where their modules come from. It says how each state is drawn, and holds
the stage diagram with its layout. There is no arithmetic of models in the browser, and no grammar: it expands tables and moves
points.

All text in it is plain text, never markup: whoever shows it makes text nodes of it. What would not show is a question mark, but
for the text of the model, which can be edited.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from lsys_kit.budget import Task, current, limits
from lsys_kit.classroom.panel.books.drawing import drawing_entries, drawn_rows
from lsys_kit.classroom.panel.books.growth_rate import growth_entry
from lsys_kit.classroom.panel.books.net import Unfolding, net_entry, net_of
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.files import file_stem
from lsys_kit.geometry.turtle.commands import drawing_mode
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.system import USUAL_STEPS, LSystem
from lsys_kit.notation.registry import dialect_named
from lsys_kit.notation.write import as_written
from lsys_kit.pictures.nets.parts import steering_of
from lsys_kit.pictures.style.labels import label_parts, values_text, visible
from lsys_kit.pictures.style.palette import colours
from lsys_kit.worlds.derive import derive

MOST_MODULES, MOST_BYTES = 250_000, 1_900_000
"""A book holds no step of more modules, since nobody could see more of them; and no more than about so many bytes."""
STATE_BYTES, HISTORY_BYTES = 60, 6
"""About what a state takes in it beside its text, and a module of a word with what it becomes."""
FEWEST_STEPS = 10
"""The last step of a book at least, where it can be reached."""
TIME_FOR_ASKED, TIME_FOR_LATER = 0.6, 0.2
"""The parts of the limit of time after which the steps that are asked for, and those beyond, are given up."""


def first_step(system: LSystem) -> int:
    """The step that is shown first of a system: its own, or a usual one.

    >>> from lsys_kit.notation.read import read
    >>> first_step(read("steps: 3\\naxiom: F")), first_step(read("axiom: F"))
    (3, 5)
    """
    return USUAL_STEPS if system.steps is None else system.steps


def book(
    system: LSystem,
    settings: Mapping[str, object] | None = None,
    seed: int | None = None,
    *,
    title: str = "",
    least: int = 0,
    unfold: Unfolding = False,
) -> dict[str, Any]:
    """The book of a system, ready to be written as JSON.

    Parameters
    ----------
    system
        Any L-system.
    settings
        New values for declared constants.
    seed
        The seed of the random numbers; by default the system's.
    title
        What the system is called.
    least
        A step that the book shall hold, if it can be reached.
    unfold
        The symbols that are unfolded in the stage diagram, as for `stages`.

    Returns
    -------
    dict
        Its entries are lists, dictionaries, texts and numbers. `end` says why there are no more steps, if something is in the
        way; otherwise the last step is twice the number that the system asks for, and 10 at least.

    Raises
    ------
    LSystemError
        Not even the axiom can be derived or drawn.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> made = book(read("axiom: a\\na -> ab\\nb -> a"))
    >>> made["steps"], made["axiom"], made["successors"], [text for *_, text in made["states"]]
    (10, [0], [[0, 1], [0]], ['a', 'b'])
    """
    given: dict[str, Any] = dict(settings or {})
    with Task("The book was not finished"):
        derivation, end = _derived(system, given, seed, least)
        pages = _pages(derivation, end)
        net, diagram = net_entry(lambda: net_of(system, given, unfold))
        symbols, rows = _labels(derivation.states, pages.numbers, net)
        states = derivation.states
        return {
            "title": visible(title),
            "text": system.source,
            "notation": system.notation,
            "notes": [*map(visible, system.notes)],
            "noun": "module",
            "settings": {c.name: number_text(value) for c, value in zip(system.constants, states.constants, strict=True)},
            "chance": _has_chance(states),
            "symbols": symbols,
            "states": rows,
            "productions": [
                {"text": visible(as_written(system, rule)), "at": list(rule.at) if rule.at else None}
                for rule in system.productions
            ],
            "file": file_stem(title, "L-system", system.source or repr(system)),
            "steps": pages.last,
            "end": pages.end,
            "axiom": [pages.numbers[state] for state in states.axiom],
            **(_table(states, pages.numbers) if states.traits.d0l else _history(derivation, pages)),
            "net": diagram,
            **drawing_entries(states, [*pages.numbers], pages.drawn, pages.last),
            "growth": growth_entry(system, given),
        }


@dataclass
class _Pages:
    """What a book holds: its last step, why there is no later one, the numbers of states in it, and how each is drawn."""

    last: int = -1
    end: str = ""
    numbers: dict[int, int] = field(default_factory=dict)
    drawn: list[list[Any]] = field(default_factory=list)


def _derived(system: LSystem, given: dict[str, Any], seed: int | None, least: int) -> tuple[Derivation, str]:
    """The derivation as far as a book may hold it, and why it ends earlier than it should; "" where it does not."""
    asked = first_step(system)
    most, seconds = min(MOST_MODULES, current().modules), current().seconds
    with limits(modules=most):
        derivation = derive(system, 0, seed=seed, **given)
        try:
            for step in range(1, max(2 * asked, FEWEST_STEPS, least) + 1):
                with limits(seconds=seconds * (TIME_FOR_LATER if step > max(asked, least) else TIME_FOR_ASKED)):
                    derivation = derivation.to(step)
        except LSystemError as error:
            return derivation, sentence(error)
    return derivation, ""


def sentence(error: LSystemError) -> str:
    """Why there is no further step; how limits are set does not help whoever moves a slider."""
    return f"{error.message}." if isinstance(error, ModelLimitError) else f"{error.message}. {error.hint or ''}".rstrip()


def _pages(derivation: Derivation, end: str) -> _Pages:
    """The steps whose states can be drawn and that fit into a book."""
    states, mode = derivation.states, drawing_mode(derivation.states.system)
    pages, size = _Pages(end=end), 0
    for step, length in enumerate(derivation.lengths):
        new = sorted(set(_occurring(derivation, step)).difference(pages.numbers))
        try:
            drawn = drawn_rows(states, new, mode)
        except LSystemError as error:
            if not step:
                raise
            pages.end = sentence(error)
            break
        size += _size(states, new, drawn) + (0 if states.traits.d0l else HISTORY_BYTES * length)
        if step and size > MOST_BYTES:
            pages.end = f"The panel ends at step {step - 1}: step {step} has too many more modules, or too many different ones."
            break
        pages.numbers.update(zip(new, range(len(pages.numbers), len(pages.numbers) + len(new)), strict=True))
        pages.drawn += drawn
        pages.last = step
    return pages


def _occurring(derivation: Derivation, step: int) -> Iterable[int]:
    """The states of a step's word."""
    return derivation.counts(step)


def _size(states: States, new: Sequence[int], drawn: Sequence[object]) -> int:
    """About how many bytes some states take in a book."""
    return len(json.dumps(drawn)) + sum(STATE_BYTES + 2 * len(str(states.modules[state])) for state in new)


def _labels(states: States, numbers: Iterable[int], net: Stages | None) -> tuple[list[list[Any]], list[list[Any]]]:
    """The symbols, each with its label, colour and whether it only steers the turtle; and the states, each with its symbol, its
    values, its place in the diagram, and its text."""
    system, notation = states.system, dialect_named(states.system.notation)
    palette, steering = colours(system), steering_of(system)
    symbols: dict[str, int] = {}
    rows: list[list[Any]] = []
    for state in numbers:
        module = states.modules[state]
        place = None if net is None else net.place_of(module)
        rows.append(
            [
                symbols.setdefault(module.symbol, len(symbols)),
                values_text(module),
                -1 if place is None else place,
                visible(notation.module(module)),
            ]
        )
    return [
        [*map(visible, label_parts(symbol, system)), palette.get(symbol, ""), int(symbol in steering)] for symbol in symbols
    ], rows


def _has_chance(states: States) -> bool:
    """Whether the seed makes a difference."""
    return states.traits.stochastic or states.traits.random or any(rule.probability for rule in states.system.decomposition)


def _table(states: States, numbers: Mapping[int, int]) -> dict[str, Any]:
    """The successors of states that alone decide them, and the productions that are applied; nothing of states of the last step
    that lead out of the book."""
    rows = {state: row for state in numbers if (row := states.successors.get(state)) is not None and numbers.keys() >= {*row}}
    return {
        "successors": [[numbers[s] for s in rows[state]] if state in rows else [] for state in numbers],
        "applied": [-1 if state not in rows or (made := states.production(state)) is None else made for state in numbers],
    }


def _history(derivation: Derivation, pages: _Pages) -> dict[str, Any]:
    """The words of all steps; for each module but those of the last step how many modules it becomes and by which production,
    and where productions replace several modules together, how many."""
    lookup = np.zeros(max(pages.numbers, default=0) + 1, np.int64)
    lookup[[*pages.numbers]] = [*pages.numbers.values()]
    words = [lookup[np.asarray(derivation[step].codes, np.int64)] for step in range(pages.last + 1)]
    found: dict[str, list[dict[str, str]]] = {"words": [*map(packed, words)], "daughters": [], "made": [], "together": []}
    for step, word in enumerate(words[:-1]):
        origins = derivation.origins(step + 1)
        made = np.full(len(word), -1)
        made[origins.parents] = [-1 if number is None else number for number in origins.productions]
        found["daughters"].append(packed(np.bincount(np.asarray(origins.parents, np.int64), minlength=len(word))))
        found["made"].append(packed(made))
        if origins.sizes:
            found["together"].append(packed(np.asarray(origins.sizes)))
    return dict(found)


def packed(numbers: np.ndarray[Any, Any]) -> dict[str, str]:
    """Whole numbers as text: the letters of their type, and their bytes in base 64, the lowest first.

    >>> packed(np.array([1, 2, 300]))
    {'type': 'u2', 'data': 'AQACACwB'}
    """
    least, most = int(numbers.min(initial=0)), int(numbers.max(initial=0))
    kind = np.promote_types(np.min_scalar_type(least), np.min_scalar_type(most)).newbyteorder("<")
    return {"type": f"{kind.kind}{kind.itemsize}", "data": base64.b64encode(numbers.astype(kind).tobytes()).decode()}
