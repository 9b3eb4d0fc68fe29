"""The closure of a system: all states that can be reached from the axiom, where each alone decides what becomes of it."""

from __future__ import annotations

from collections.abc import Sequence

from lsys_kit.budget import check_budget
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import ModelValueError


def check_d0l(states: States, what: str) -> None:
    """Refuse a question that has an answer only where every module alone decides what becomes of it."""
    if states.traits.predecessor > 1:
        raise ModelValueError(
            f"{what} is defined for systems that replace each module alone, not several together",
            hint="Derive this system, and look at its words.",
        )
    if not states.traits.d0l:
        raise ModelValueError(
            f"{what} is defined for context-free systems without chance, cuts and meta-rules",
            hint="Derive this system, and look at its words; where chance chooses its "
            "productions, stages(system).expected(n) gives the average counts.",
        )


def closure(states: States, limit: int) -> Sequence[int] | None:
    """All states that are reached from the axiom, in the order of their numbers; None where there are more than `limit`.

    >>> from lsys_kit.notation.read import read
    >>> closure(States(read("axiom: A\\nA -> A B")), 100)
    range(0, 2)
    >>> closure(States(read("axiom: A(0)\\nA(t) -> A(t+1)")), 100) is None
    True
    """
    done = 0
    while done < len(states):
        if len(states) > limit:
            return None
        check_budget()
        states.successor(done)
        done += 1
    return range(done)
