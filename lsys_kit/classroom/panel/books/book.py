"""The book of a system: all that a browser needs to show its steps, for one setting of the constants, as JSON.

The table of states is small, so it is sent once and the browser turns the pages. Where a state alone decides what becomes of
it, the book holds the successors and the browser makes the words; where chance alone has a say besides, it holds what each
state may become, and the browser throws the dice (`choices`); where neighbours or questions to the turtle have a say, it holds
the words of the steps as numbers, and where their modules come from. It says how each state is drawn, and holds the stage
diagram with its layout. There is no arithmetic of models in the browser, and no grammar: it expands tables and moves
points.

All text in it is plain text, never markup: whoever shows it makes text nodes of it. What would not show is a question mark, but
for the text of the model, which can be edited.
"""

from __future__ import annotations

import base64
import json
import math
import sys
from array import array
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import accumulate, pairwise
from typing import Any, TypeAlias

from lsys_kit.budget import Task, counted, current, limits
from lsys_kit.classroom.panel.books.choices import Choice, choices_of
from lsys_kit.classroom.panel.books.net import Unfolding, net_entry, net_of
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.panel.labels import noun_of
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.letters import conditions_text, decisions_of, numbered
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.engines.engine import code_type
from lsys_kit.derivation.growth.growth import greatest_root, growth
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.files import file_stem
from lsys_kit.geometry.drawing import PIPES, has_natural_colours, has_pipe_widths
from lsys_kit.geometry.filament import shapes_of
from lsys_kit.geometry.turtle.commands import (
    DrawingMode,
    Instruction,
    drawing_mode,
    initial_colour,
    initial_step,
    initial_width,
    instructions,
    unknown_commands,
)
from lsys_kit.geometry.turtle.plane import PLANE_HANDLERS
from lsys_kit.geometry.turtle.space import SPACE_HANDLERS
from lsys_kit.geometry.turtle.surfaces import Surface, passed_over, surfaces_by_symbol
from lsys_kit.geometry.turtle.turtle import label_text
from lsys_kit.notation.model.arithmetic import Formula, formulas_in, number_of, number_text, rounded
from lsys_kit.notation.model.formulas import formula_text, values_element
from lsys_kit.notation.model.modules import Module, flat
from lsys_kit.notation.model.system import USUAL_STEPS, LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.notation.registry import dialect_named
from lsys_kit.notation.write import as_written
from lsys_kit.pictures.filaments import time_text
from lsys_kit.pictures.style.labels import label_parts, shared_formulas, steering_of, values_text, visible
from lsys_kit.pictures.style.palette import CHOSEN, colours
from lsys_kit.worlds.derive import derive

MOST_MODULES, MOST_BYTES = 250_000, 1_900_000
"""A book holds no step of more modules, since nobody could see more of them; and no more than about so many bytes."""
STATE_BYTES, HISTORY_BYTES, FORMULA_BYTES = 60, 6, 120
"""About what a state takes in it beside its text, a module of a word with what it becomes, and a term of a formula."""
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
    letters: Collection[str] = (),
) -> Data:
    """The book of a system for new values of its constants, ready to be written as JSON; it holds a step at least, if that can
    be reached. Symbols are unfolded in the stage diagram as in `stages`. With letters for constants it holds formulas, too.

    Its entries are lists, dictionaries, texts and numbers. `end` says why there are no more steps, if something is in the way;
    otherwise the last step is twice the number that the system asks for, and 10 at least.

    >>> from lsys_kit.notation.read import read
    >>> made = book(read("axiom: a\\na -> ab\\nb -> a"))
    >>> made["steps"], made["axiom"], made["successors"], [text for *_, text in made["states"]]
    (10, [0], [[0, 1], [0]], ['a', 'b'])
    """
    given: Data = dict(settings or {})
    with Task("The book was not finished"):
        derivation, end, decided = _derived(system, given, seed, least, letters)
        states = numbered(derivation.states)
        choices = {} if letters else choices_of(states, len(derivation) - 1)
        try:
            pages = _pages(derivation, states, end, choices)
        except LSystemError:  # what comes at another seed may have no picture
            choices = {}
            pages = _pages(derivation, states, end, choices)
        net, diagram = net_entry(lambda: net_of(system, given, unfold))
        symbols, rows = _labels(states, pages.numbers, net)
        return {
            "title": visible(title),
            "text": system.source,
            "notation": system.notation,
            "notes": [*map(visible, system.notes)],
            "noun": _noun(system, pages),
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
            **(
                _thrown(pages, choices, (system.seed or 0) if seed is None else seed)
                if choices
                else _table(states, pages.numbers)
                if states.traits.d0l
                else _history(derivation, pages)
            ),
            "net": diagram,
            **drawing_entries(states, [*pages.numbers], pages.drawn, pages.last),
            "growth": growth_entry(system, given),
            **(_formulas(derivation.states, pages, diagram, rows, decided, letters) if letters else {}),
        }


def _noun(system: LSystem, pages: _Pages) -> str:
    """What one module of the words is called: a cell where it is drawn as one."""
    is_filament = drawing_mode(system) is DrawingMode.FILAMENT
    return "cell" if is_filament and all(len(row) == 1 and not row[0][0] for row in pages.drawn) else noun_of(system)


Row: TypeAlias = list[Any]
"""A row of what JSON can say."""


@dataclass
class _Pages:
    """What a book holds: its last step, why there is no later one, the numbers of states in it, and how each is drawn."""

    last: int = -1
    end: str = ""
    numbers: dict[int, int] = field(default_factory=dict)
    drawn: list[Row] = field(default_factory=list)


def _derived(
    system: LSystem, given: Data, seed: int | None, least: int, letters: Collection[str]
) -> tuple[Derivation, str, list[int]]:
    """The derivation as far as a book may hold it, and why it ends earlier than it should, "" where it does not; and for each
    step how much numbers have decided about letters.
    """
    asked = first_step(system)
    most, seconds = min(MOST_MODULES, current().modules), current().seconds
    with limits(modules=most):
        derivation = derive(system, 0, seed=seed, letters=letters, **given)
        decided = [len(decisions_of(derivation.states))]
        try:
            for step in range(1, max(2 * asked, FEWEST_STEPS, least) + 1):
                with limits(seconds=seconds * (TIME_FOR_LATER if step > max(asked, least) else TIME_FOR_ASKED)):
                    derivation = derivation.to(step)
                    decided.append(len(decisions_of(derivation.states)))
        except LSystemError as error:
            return derivation, sentence(error), decided
    return derivation, "", decided


def sentence(error: LSystemError) -> str:
    """Why there is no further step; how limits are set does not help whoever moves a slider."""
    return f"{error.message}." if isinstance(error, ModelLimitError) else f"{error.message}. {error.hint or ''}".rstrip()


def _pages(derivation: Derivation, states: States, end: str, choices: Mapping[int, Choice]) -> _Pages:
    """The steps whose states can be drawn and that fit into a book; with all states that chance may make."""
    mode = drawing_mode(states.system)
    pages, size = _Pages(end=end), 0
    for step, length in enumerate(derivation.lengths):
        new = sorted({*derivation.counts(step), *choices}.difference(pages.numbers))
        try:
            drawn = drawn_rows(states, new, mode)
        except LSystemError as error:
            if not step:
                raise
            pages.end = sentence(error)
            break
        size += _size(states, new, drawn) + FORMULA_BYTES * sum(
            map(_terms, (derivation.states.modules[state] for state in new))
        )
        size += 0 if states.traits.d0l or choices else HISTORY_BYTES * length
        if step and size > MOST_BYTES:
            pages.end = f"The panel ends at step {step - 1}: step {step} has too many more modules, or too many different ones."
            break
        pages.numbers.update(zip(new, range(len(pages.numbers), len(pages.numbers) + len(new)), strict=True))
        pages.drawn += drawn
        pages.last = step
    return pages


def _terms(module: Module) -> int:
    """How many terms the formulas among a module's values have."""
    return sum(max(1, len(value.expression.args)) for value in formulas_in(module.arguments))


def _size(states: States, new: Sequence[int], drawn: Sequence[object]) -> int:
    return len(json.dumps(drawn)) + sum(STATE_BYTES + 2 * len(str(states.modules[state])) for state in new)


def _labels(states: States, numbers: Iterable[int], net: Stages | None) -> tuple[list[list[object]], list[list[object]]]:
    """The symbols, each with its label, colour and whether it only steers the turtle; and the states, each with its symbol, its
    values, its place in the diagram, and its text."""
    system, notation = states.system, dialect_named(states.system.notation)
    palette, steering = colours(system), steering_of(system)
    symbols: dict[str, int] = {}
    rows: list[list[object]] = []
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


def _formulas(
    states: States, pages: _Pages, diagram: Data, rows: Sequence[Row], decided: Sequence[int], letters: Collection[str]
) -> Data:
    """For each state whose values have letters its values as mathematics, and as a text, its text, and what its formulas are in
    numbers; for each step under which conditions the formulas hold, or that there is none. Stages in the diagram are named by
    formulas, too.
    """
    notation, found = dialect_named(states.system.notation), list[object]()
    for state, drawn in counted(zip(pages.numbers, pages.drawn, strict=True), 1):
        module = states.modules[state]
        values = values_element(module.arguments)
        if values is None:
            found.append(0)
            continue
        element, text = values
        bare = notation.module(Module(module.symbol))
        said = [f"{formula_text(each)} = {number_text(rounded(each.number))}" for each in formulas_in(module.arguments)]
        length = "length " if isinstance(module.arguments[0], Formula) and _is_stroke(drawn, module) else ""
        found.append([element, visible(text), visible(bare + text), visible(f"{length}{', '.join(said)}")])
    of_places: dict[int, list[Module]] = {}
    for state, row in zip(pages.numbers, rows, strict=True):
        of_places.setdefault(row[2], []).append(states.modules[state])
    for place in diagram["places"]:
        if place["values"] and (shared := shared_formulas(of_places.get(place["place"], ()))):
            place["formula"] = values_text(Module("", shared))
    all_decided = decisions_of(states)
    none = "" if any(found) else f"no value contains {' or '.join(letters)}"
    held = [conditions_text(states, all_decided[:many]) for many in decided[: pages.last + 1]]
    said = [text and text[0].lower() + text[1:-1] for text in held]
    return {"formulas": found, "conditions": ["; ".join(filter(None, (none, text))) for text in said]}


def _is_stroke(drawn: Row, module: Module) -> bool:
    """Whether a module is a stroke of the turtle whose length is its first value."""
    return (
        len(drawn) == 1
        and drawn[0][0] == "draw"
        and bool(drawn[0][3])
        and drawn[0][3][0] == _plain(float(number_of(module.arguments[0])))
    )


def _has_chance(states: States) -> bool:
    return states.traits.stochastic or states.traits.random or any(rule.probability for rule in states.system.decomposition)


def _table(states: States, numbers: Mapping[int, int]) -> Data:
    """The successors of states that alone decide them, and the productions that are applied; nothing of states of the last step
    that lead out of the book."""
    rows = {state: row for state in numbers if (row := states.successors.get(state)) is not None and numbers.keys() >= {*row}}
    return {
        "successors": [[numbers[s] for s in rows[state]] if state in rows else [] for state in numbers],
        "applied": [-1 if state not in rows or (made := states.production(state)) is None else made for state in numbers],
    }


def _thrown(pages: _Pages, choices: Mapping[int, Choice], seed: int) -> Data:
    """What each state may become, 0 for those of the last step, and the seed."""
    rows: list[object] = [0] * len(pages.numbers)
    for state, (ends, total, productions, successors) in choices.items():
        if all(after in pages.numbers for row in successors for after in row):
            made = [[pages.numbers[after] for after in row] for row in successors]
            rows[pages.numbers[state]] = [[*ends], total, [*productions], made]
    return {"choices": rows, "seed": str(seed), "most": MOST_MODULES}


def _history(derivation: Derivation, pages: _Pages) -> Data:
    """The words of all steps; for each module but those of the last step how many modules it becomes and by which production,
    and where productions replace several modules together, how many."""
    words = [[*map(pages.numbers.__getitem__, derivation[step].numbers())] for step in range(pages.last + 1)]
    found: dict[str, list[dict[str, str]]] = {"words": [*map(packed, words)], "daughters": [], "made": [], "together": []}
    for step, word in enumerate(words[:-1]):
        origins = derivation.origins(step + 1)
        daughters = [0] * len(word)
        for parent in origins.parents:  # in ascending order
            daughters[parent] += 1
        made = [
            origins.productions[end - 1] if many else None for end, many in zip(accumulate(daughters), daughters, strict=True)
        ]
        found["daughters"].append(packed(daughters))
        found["made"].append(packed([-1 if production is None else production for production in made]))
        if origins.sizes:
            found["together"].append(packed(origins.sizes))
    return dict(found)


def packed(given: Iterable[int]) -> dict[str, str]:
    """Whole numbers as text: the letters of their type, and their bytes in base 64, the lowest first.

    >>> packed([1, 2, 300]), packed([-1, 2])["type"]
    ({'type': 'u2', 'data': 'AQACACwB'}, 'i2')
    """
    numbers = [*given]
    distinct = {*numbers, 0}
    least, most = min(distinct), max(distinct)
    code = code_type(most + 1)
    if least < 0:  # twice as many bytes as without a sign
        code = max("hiq"["BHI".index(code)], code_type(-2 * least).lower(), key="bhiq".index)
    found = array(code, bytes(numbers) if code == "B" else numbers)
    kind = f"{'i' if least < 0 else 'u'}{found.itemsize}"
    if sys.byteorder == "big":
        found.byteswap()
    return {"type": kind, "data": base64.b64encode(found).decode()}


BY_ANGLE = frozenset(("turn", "turn by mirrored angle", "turn back", "pitch", "roll"))
"""The actions whose quantity is the angle."""
GREATEST = 1e300
"""Stands for what is infinite, which JSON has no number for: a turtle that bends by so much points straight down."""
_TILDE = -1
"""The number of a module that is in no word: beside it, the symbols of surfaces are commands."""


def drawn_rows(states: States, numbers: Sequence[int], mode: DrawingMode) -> list[list[object]]:
    """For each of some states what is drawn.

    In a filament its cells and walls as in `shapes_of`; for a turtle its calls, each an action, a factor and an addend, the
    values of its module or 0, for a label what it says, and a surface or 0.

    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: F(2)+A"))
    >>> drawn_rows(states, states.axiom, DrawingMode.PLANE)
    [[['draw', 0, 2, [2], 0]], [['turn', 1, 0, 0, 0]], []]
    """
    if mode is DrawingMode.FILAMENT:
        return [
            [[None if math.isnan(number) else _plain(number) for number in shape] for shape in shapes]
            for shapes in shapes_of(states, numbers).values()
        ]
    system, drawn = states.system, interpretations(states, numbers)
    if any(module.symbol == "~" for module in system.modules):
        drawn = {**drawn, _TILDE: (Module("~"),)}
    handlers = PLANE_HANDLERS if mode is DrawingMode.PLANE else SPACE_HANDLERS
    calls = instructions(drawn, system.turtle, system.angle)
    known = surfaces_by_symbol(system)
    return [[_call(each, known) for each in calls[state] if each.action in handlers] for state in numbers]


def _call(instruction: Instruction, known: Mapping[str, Surface]) -> list[object]:
    action, factor, addend, values, symbol, surface = instruction
    if action == "draw expected surface":
        surface = symbol if symbol in known else ""
    said = [label_text(values)] if action == "draw label" and values else [*map(_plain, values)]
    return [action, _plain(factor), _plain(addend), said or 0, surface or 0]


def _plain(number: float) -> float:
    number = max(-GREATEST, min(GREATEST, number))
    return int(number) if abs(number) < GREATEST and number == int(number) else number


def drawing_entries(states: States, numbers: Sequence[int], drawn: list[list[object]], last: int) -> Data:
    """The entries of a book that say how it is drawn, given its states, what each is drawn as, and its last step."""
    system, mode = states.system, drawing_mode(states.system)
    if mode is DrawingMode.FILAMENT:
        step = age_model(states).step
        return {
            "mode": "filament",
            "cells": drawn,
            "look": system.cells,
            "time": None if step is None else float(step),
            "times": [] if step is None else [time_text(step * number) for number in range(last + 1)],
            "unknown": [],
            "said": "",
        }
    unknown = (*unknown_commands(interpretations(states, numbers), system), *_not_surfaces(system))
    return {
        "mode": mode.name.lower(),
        "turtle": _turtle(system, drawn),
        "unknown": [*map(visible, unknown)],
        "said": "; ".join(filter(None, (_chosen_look(system), passed_over(unknown)))),
    }


def _chosen_look(system: LSystem) -> str:
    """In words how strokes look where the system does not say so; "colours: symbols" in its text changes that."""
    return "natural colours" if has_natural_colours(system) and not system.colours else ""


def _turtle(system: LSystem, calls: list[Row]) -> Data:
    dialect = TURTLE_DIALECTS[system.turtle]
    named = {surface for row in calls for *_, surface in row if surface}
    return {
        "side": dialect.left,
        "length": initial_step(system),
        "width": initial_width(system),
        "colour": initial_colour(system),
        "natural": has_natural_colours(system),
        "heading": float(system.heading),
        "angle": float(system.angle),
        "widths": unit_of_widths(system),
        "calls": calls,
        "surfaces": {name: faces_in(surfaces_by_symbol(system)[name], drawing_mode(system)) for name in sorted(named)},
        "colours": [*CHOSEN],
        "uses angle": any(action in BY_ANGLE and factor for row in calls for action, factor, *_ in row),
    }


def unit_of_widths(system: LSystem) -> str:
    """The unit of the widths of strokes: "pipes", "pixels", or "units" of lengths; "auto" as far as those are in proportion."""
    if has_pipe_widths(system):
        return PIPES
    return system.widths or ("auto" if TURTLE_DIALECTS[system.turtle].pixels else "units")


def faces_in(surface: Surface, mode: DrawingMode) -> dict[str, list[object]]:
    """The faces of a surface in a book, none where it is flat, and its outlines."""
    curved = mode is DrawingMode.SPACE and bool(surface.facets.normals)
    return {
        "faces": [[*map(list, face)] for face in surface.facets.faces if curved],
        "outlines": [[*map(list, face)] for face in surface.facets.outlines],
    }


def _not_surfaces(system: LSystem) -> Iterable[str]:
    """What stands behind a tilde and is no surface, with its tilde."""
    known = surfaces_by_symbol(system)
    words = [tuple(flat(word)) for word in (system.axiom, *(rule.successor for rule in system.rules))]
    return dict.fromkeys(
        f"~{behind.symbol}"
        for word in words
        for before, behind in pairwise(word)
        if before.symbol == "~" and behind.symbol not in known
    )


MOST_STATES = 40
"""Of systems with more states the rate takes too long."""
GREATEST_ROOT = 1_000
"""Of greater roots only decimals are given."""
NEAR = 1e-6
"""A number that is nearer to a whole number than this may be one; whether it is, is then computed exactly."""


def growth_entry(system: LSystem, constants: Mapping[str, object]) -> dict[str, str] | None:
    """The growth rate as a book holds it, or None.

    >>> from lsys_kit.notation.read import read
    >>> growth_entry(read("axiom: a\\na -> ab\\nb -> a"), {})
    {'rate': '(1 + √5)/2 ≈ 1.618'}
    """
    if traits_of(system).d0l:
        with suppress(LSystemError), limits(states=MOST_STATES):
            return {"rate": rate_text(growth(system, **constants).recurrence)}
    return None


def rate_text(rule: Sequence[int]) -> str:
    """The greatest root of the polynomial of a recurrence: exactly where it is whole or the root of a quadratic equation.

    >>> rate_text((4, -4)), rate_text((0, 2)), rate_text((1, 0, 1))
    ('2', '√2 ≈ 1.4142', '≈ 1.4656')
    """
    if not any(rule):
        return "0"
    polynomial, root = [1, *(-c for c in rule)], greatest_root(rule, exact=False)
    if abs(root - round(root)) < math.sqrt(NEAR) and not any(_remainder(polynomial, [1, -round(root)])):
        return str(round(root))
    decimals = f"≈ {root:.5g}"
    reach = math.ceil(2 * root) if root < GREATEST_ROOT else 0
    for p in range(-reach, reach + 1):
        q = round(root * (root - p))
        if abs(root * (root - p) - q) < NEAR * root and not any(_remainder(polynomial, [1, -p, -q])):
            return f"{_quadratic_root(p, p * p + 4 * q)} {decimals}"
    return decimals


def _remainder(polynomial: Sequence[int], divisor: Sequence[int]) -> list[int]:
    left = [*polynomial]
    for at in range(len(left) - len(divisor) + 1):
        for k, c in enumerate(divisor[1:], 1):
            left[at + k] -= left[at] * c
    return left[max(0, len(left) - len(divisor) + 1) :]


def _quadratic_root(p: int, discriminant: int) -> str:
    """(p + √discriminant)/2, in lowest terms.

    >>> _quadratic_root(2, 12), _quadratic_root(1, 5), _quadratic_root(0, 8), _quadratic_root(0, 12)
    ('1 + √3', '(1 + √5)/2', '√2', '√3')
    """
    square = next(k for k in range(math.isqrt(discriminant), 0, -1) if discriminant % (k * k) == 0)
    inner, whole = discriminant // (square * square), p % 2 == 0 and square % 2 == 0
    p, square = (p // 2, square // 2) if whole else (p, square)
    text = f"{p} + " * (p != 0) + f"{square}" * (square != 1) + f"√{inner}"
    return text if whole else f"({text})/2"
