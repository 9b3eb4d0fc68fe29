"""The systems that draw a sequence of pictures, and what can be said of them in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lsys_kit.budget import check_budget
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.inference.infer import SystemsFound
from lsys_kit.errors import ModelLimitError
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.inference.strokes import Strokes
from lsys_kit.geometry.sameness import normalised, same_strokes
from lsys_kit.geometry.scene import Floats
from lsys_kit.notation.model.system import LSystem

MOST_SHOWN = 20
"""So many systems are shown, and compared."""
STEPS_AHEAD, STROKES_AHEAD = 3, 20_000
"""So many steps, and drawings of so many strokes, are looked at to see where systems part."""
SAME_TO = 1e-3
"""How far strokes of a drawing may be off, where it has the size 1."""


@dataclass(frozen=True, repr=False)
class DrawingFits(SystemsFound):
    """The systems that draw a sequence of pictures: a sequence of systems, which prints as an explanation.

    Attributes
    ----------
    drawings
        The strokes of steps 0, 1, 2, ..., in their own length.
    systems
        The systems, those with the shortest productions first.
    refusal
        Why there is none; empty where there is one.
    """

    drawings: tuple[Strokes, ...]
    systems: tuple[LSystem, ...]
    refusal: str = ""

    def lines(self) -> Iterator[str]:
        """The explanation, line by line."""
        count = f"these {len(self.drawings)} pictures"
        if not self:
            yield f"No system was found that draws {count}. {self.refusal}".strip()
            return
        if len(self) == 1:
            yield f"One system draws {count}:"
        else:
            step = parting_step(self[:MOST_SHOWN], len(self.drawings))
            yield f"{len(self)} systems draw {count}; " + (
                "as far as was looked, later pictures are the same:" if step is None else f"they part at step {step}:"
            )
        for number, system in enumerate(self[:MOST_SHOWN], 1):
            yield from [f" {number}."] if len(self) > 1 else []
            yield from (f"  {line}" for line in str(system).splitlines())
        if len(self) > MOST_SHOWN:
            yield f" and {len(self) - MOST_SHOWN} more"


def parting_step(systems: Sequence[LSystem], start: int) -> int | None:
    """The first step from `start` on at which some systems draw different pictures; None where there is none as far as is
    looked.

    >>> from lsys_kit.notation.read import read
    >>> parting_step([read("angle: 60\\naxiom: F\\nF -> F+F"), read("angle: 60\\naxiom: F\\nF -> F[+F]")], 0)
    2
    """
    for step in range(start, start + STEPS_AHEAD):
        first = drawn(systems[0], step)
        if first is None:
            return None
        for system in systems[1:]:
            other = drawn(system, step)
            if other is None or not same_strokes(other, first, SAME_TO):
                return step
    return None


def drawn(system: LSystem, step: int) -> Floats | None:
    """What a system draws, about its centre and of size 1; None where it is too large to be looked at."""
    check_budget()
    try:
        derivation = derive(system, step)
        if derivation.lengths[-1] > STROKES_AHEAD * 10:
            return None
        ends = scene_of(derivation).segments.ends
    except ModelLimitError:
        return None
    return normalised(ends) if len(ends) <= STROKES_AHEAD else None
