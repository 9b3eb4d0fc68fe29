"""The turtle interpreter: a word is compiled for a turtle, state by state, and carried out."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

from lsys_kit.budget import counted
from lsys_kit.derivation.core.interpretation import interpretations, modules_between_checks
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.turtle.commands.instructions import Instruction, instructions, unknown_commands
from lsys_kit.geometry.turtle.handlers import Handler, draw_surface, expect_surface
from lsys_kit.geometry.turtle.turtle import Turtle

MOST_CURVED = 150
"""Where more surfaces are drawn, each is drawn by its outlines: one sees little of its curvature."""


def run_turtle(
    turtle: Turtle,
    word: Word,
    handlers: Mapping[str, Handler],
    prepare: Callable[[Instruction], Any] = lambda instruction: instruction,
) -> None:
    """Interpret a word by a turtle; actions without a handler are skipped.

    Parameters
    ----------
    turtle
        The turtle, at its start.
    word
        The word.
    handlers
        The handlers of this turtle, by action.
    prepare
        The operand of an instruction: computed once for each state, not for each module.

    Raises
    ------
    ModelLimitError
        More brackets are open at once than the limit allows.
    ModelValueError
        A value is too large to draw, or symbolic.
    """
    with _without_garbage_collection():
        compiled = compile_word(word, handlers, prepare)
        turtle.unknown = dict.fromkeys(compiled.unknown)
        turtle.flat = turtle.in_plane or _surfaces_in(word, compiled) > MOST_CURVED
        for state in counted(word.numbers(), modules_between_checks(compiled.calls.values())):
            turtle.state = state
            for handler, operand in compiled.calls[state]:
                handler(turtle, operand)
        if turtle.expects_surface:
            turtle.unknown["~"] = None


def _surfaces_in(word: Word, compiled: CompiledWord) -> int:
    """How many surfaces a word draws."""
    drawing = {
        state: many
        for state, calls in compiled.calls.items()
        if (many := sum(handler in (expect_surface, draw_surface) for handler, _ in calls))
    }
    return sum(drawing.get(state, 0) for state in word.numbers()) if drawing else 0


@contextmanager
def _without_garbage_collection() -> Iterator[None]:
    """Without this, a word of mostly distinct modules spends half of its time in searches for cycles among its instructions."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


class CompiledWord(NamedTuple):
    """A word compiled for a turtle.

    Attributes
    ----------
    calls
        For each state the handlers to be called, each with its operand.
    unknown
        The symbols that look like commands and are none.
    """

    calls: dict[int, list[tuple[Handler, Any]]]
    unknown: tuple[str, ...]


def compile_word(word: Word, handlers: Mapping[str, Handler], prepare: Callable[[Instruction], Any]) -> CompiledWord:
    """Compile a word for a turtle with some handlers."""
    system, drawn = word.states.system, interpretations(word.states, word.numbers())
    calls = {
        state: [(handlers[instruction.action], prepare(instruction)) for instruction in found if instruction.action in handlers]
        for state, found in counted(instructions(drawn, system.turtle, system.angle).items())
    }
    return CompiledWord(calls, unknown_commands(drawn, system))
