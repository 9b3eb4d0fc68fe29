"""Who hears that a cell asks a question of a lesson: a class that was opened in the same notebook asks all of its phones."""

from __future__ import annotations

from collections.abc import Callable

LISTENERS: list[Callable[[str, str, int], None]] = []
"""Each is told the kind of a question, "vote" or "prediction"; the number of the lesson, or what is to be predicted; and which
of two votes it is."""


def announce(kind: str, about: str, round: int = 1) -> None:
    """Say that a cell asks a question."""
    for listener in LISTENERS:
        listener(kind, about, round)
