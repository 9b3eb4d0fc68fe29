"""The names of the panel's views and controls, and how they are used, in the chosen language.

What the panel says of a model stays in English, like the kit's errors: the line with its size, what becomes of a module,
mistakes. So no sentence is in two languages. So do the controls that only maps have: relaxation, forces, the signs of walls.
"""

from __future__ import annotations

from lsys_kit.classroom.panel.bundle import translated_words


def translated_labels() -> dict[str, dict[str, str]]:
    """What a panel must know to show them: nothing in English.

    >>> translated_labels()
    {}
    """
    words = translated_words("panel")
    return {"words": words} if words else {}
