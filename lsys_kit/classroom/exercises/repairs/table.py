"""The search for a repair: the smallest change that makes a wrong answer right, by the judge that marks answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from itertools import islice

from lsys_kit.budget import current, limits, processor_time
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.drawings import Drawn
from lsys_kit.classroom.exercises.kinds.systems import SystemAnswer
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS
from lsys_kit.classroom.exercises.repairs.of_drawings import of_drawings
from lsys_kit.classroom.exercises.repairs.of_expressions import of_expressions
from lsys_kit.classroom.exercises.repairs.of_maps import of_maps
from lsys_kit.classroom.exercises.repairs.of_nets import of_nets
from lsys_kit.classroom.exercises.repairs.of_systems import of_systems
from lsys_kit.classroom.exercises.repairs.repair import Repair, Repairs
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError

REPAIRS: Mapping[str, Repairs] = {
    "drawing": of_drawings,
    "expression": of_expressions,
    "map": of_maps,
    "net": of_nets,
    "system": of_systems,
}
"""For kinds of answers their repairs, the smallest first; of other kinds the first difference says as much."""
MOST_TRIED, MOST_DERIVED = 250, 100_000
"""So many changes are tried, and of long words so few that this many modules are derived: what is said of an answer does not
depend on how fast the machine is."""
SECONDS = 2
"""So long at most, for exercises whose words are slow to derive: several times what so many changes take."""
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
    with limits(modules=min(MOST_MODULES, current().modules)):
        for each in islice(repairs(exercise, own, solution), _most_tried(exercise, solution)):
            with suppress(LSystemError, ArithmeticError, LookupError, ValueError):  # a change may make no answer at all
                if same(exercise, each.answer(), solution):
                    return each
            if processor_time() > until:
                return None
    return None


def _most_tried(exercise: Exercise, solution: object) -> int:
    """How many changes are tried: the longer the words of the solution, the longer each takes."""
    words: Sequence[int] = ()
    with suppress(LSystemError):
        if isinstance(solution, SystemAnswer):
            words = derive(solution.behind, exercise.steps).lengths
        elif isinstance(solution, Drawn):
            words = solution.derivation.lengths
    return min(MOST_TRIED, MOST_DERIVED // max(1, sum(words)))
