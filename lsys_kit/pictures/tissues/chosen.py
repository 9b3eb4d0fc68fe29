"""What a person chooses of the cells of maps and cellworks: how many steps are shown, and the forces that shape them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeVar, cast

from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.tissues.development import AnyDevelopment, develop
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.geometry.tissues.relaxation import DEFAULT_FORCES, SPACE_FORCES, SPHERE_FORCES, Forces
from lsys_kit.notation.model.cells import CellSystem

STEPS = {"map": 4, "cellwork": 3}
"""The default numbers of steps, by the notation."""
USUAL = {"map": DEFAULT_FORCES, "map on a sphere": SPHERE_FORCES, "cellwork": SPACE_FORCES}
"""The usual forces, by the kind of system."""
RANGES = {"stiffness": (0.01, 100), "rest": (0, 10), "pressure": (0.001, 10), "damping": (0.1, 10)}
"""The least and the greatest value of each force."""
NOUNS = (("vertex", "vertices"), ("edge", "edges"), ("wall", "walls"), ("cell", "cells"))
D = TypeVar("D", bound=AnyDevelopment)


def steps_of(system: CellSystem) -> int:
    """The step that is shown, if none is asked for."""
    return STEPS[system.notation] if system.steps is None else system.steps


def developed(what: CellSystem | D, n: int | None) -> D:
    """A development as it is; that of a system up to a step, by default its own."""
    if isinstance(what, CellSystem):
        return cast(D, develop(what, steps_of(what) if n is None else n))
    if n is not None:
        kind = what.system.notation
        raise ModelValueError(f"Steps are chosen when a {kind} system is derived, not when its development is drawn")
    return what


def forces_of(choices: Mapping[str, object], kind: str = "map") -> Forces:
    """The chosen forces of a kind of system; the others as usual.

    >>> forces_of({"pressure": "1/5"})
    Forces(stiffness=1.0, rest=0.1, pressure=0.2, damping=1.0)
    """
    values: dict[str, float] = {}
    for name, choice in choices.items():
        if name not in RANGES:
            raise ModelNameError(f'A {kind} has no "{name}"', hint=f"Its forces are {', '.join(RANGES)}.")
        least, most = RANGES[name]
        values[name] = real_from(choice, name, f"It lies between {least} and {most}.")
        if not least <= values[name] <= most:
            raise ModelValueError(f'"{name}" must lie between {least} and {most}, not be {values[name]:g}')
    return replace(USUAL[kind], **values)


def counts_text(counts: Sequence[int]) -> str:
    """How many vertices, edges, walls and cells there are, in words; a map has walls for edges.

    >>> counts_text((4, 4, 1))
    '4 vertices, 4 walls, 1 cell'
    """
    nouns = NOUNS if len(counts) == len(NOUNS) else (NOUNS[0], *NOUNS[2:])
    return ", ".join(f"{count:,} {names[count != 1]}" for count, names in zip(counts, nouns, strict=True))
