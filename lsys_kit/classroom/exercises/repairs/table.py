"""The search for a repair: the smallest change that makes a wrong answer right, by the judge that marks answers."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress

from lsys_kit.budget import current, limits, processor_time
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS
from lsys_kit.classroom.exercises.repairs.of_drawings import of_drawings
from lsys_kit.classroom.exercises.repairs.of_expressions import of_expressions
from lsys_kit.classroom.exercises.repairs.of_maps import of_maps
from lsys_kit.classroom.exercises.repairs.of_nets import of_nets
from lsys_kit.classroom.exercises.repairs.of_systems import of_systems
from lsys_kit.classroom.exercises.repairs.repair import Repair, Repairs
from lsys_kit.errors import LSystemError

REPAIRS: Mapping[str, Repairs] = {
    "drawing": of_drawings,
    "expression": of_expressions,
    "map": of_maps,
    "net": of_nets,
    "system": of_systems,
}
"""For kinds of answers their repairs, the smallest first; of other kinds the first difference says as much."""
SECONDS = 0.3
"""So long a repair is looked for."""
MOST_MODULES = 5_000
"""The longest word of a changed answer."""


def repaired(exercise: Exercise, own: object, solution: object) -> Repair | None:
    """The first of its changes that makes an answer right; None where none does, or none was found in time.

    >>> fibonacci = Exercise("1", "", "system", "", "axiom: a\\na -> a b\\nb -> a", "", (), steps=6)
    >>> own, solution = (ANSWER_KINDS["system"].read(fibonacci, text) for text in ("axiom: a\\na -> a b", fibonacci.solution))
    >>> repaired(fibonacci, own, solution).said()
    'One production is missing: what becomes of b?'
    """
    repairs = REPAIRS.get(exercise.kind)
    if repairs is None:
        return None
    same, until = ANSWER_KINDS[exercise.kind].same, processor_time() + SECONDS
    tried = repairs(exercise, own, solution)
    with limits(modules=min(MOST_MODULES, current().modules)):
        while processor_time() < until:
            each = next(tried, None)
            if each is None:
                return None
            with suppress(LSystemError, ArithmeticError, LookupError, ValueError):  # a change may make no answer at all
                if same(exercise, each.answer(), solution):
                    return each
    return None
