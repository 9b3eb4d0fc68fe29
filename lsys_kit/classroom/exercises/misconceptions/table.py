"""The misconceptions, with what their functions yield."""

from __future__ import annotations

from collections.abc import Mapping

from lsys_kit.classroom.exercises.misconceptions import of_solutions, of_steps, of_systems  # noqa: F401 (their functions)
from lsys_kit.classroom.exercises.misconceptions.misconception import DECLARED, YIELDS
from lsys_kit.classroom.exercises.misconceptions.misconception import Misconception as Misconception

MISCONCEPTIONS: Mapping[str, Misconception] = {
    name: Misconception(name, yields=tuple(YIELDS[name]), **said) for name, said in DECLARED.items()
}
"""The misconceptions, by their names, in the order in which they are looked for."""
