"""A plant that a notation can express: the catalogue's, or one of its own."""

from __future__ import annotations

from lsys_kit import read, system
from lsys_kit.notation.model.system import LSystem

BUSH = "Bush {\n  Angle 14\n  Axiom F\n  F=F[+F]F[-F]F\n  }"


def plant(notation: str) -> LSystem:
    """A system for a notation: Fractint turns by whole parts of a full turn only, and its turtle is its own."""
    return read(BUSH, notation) if notation == "fractint" else system("K5")
