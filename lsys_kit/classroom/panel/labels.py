"""The names of the panel's views and controls, and how they are used, in the chosen language; and what it calls a module.

What the panel says of a model stays in English, like the kit's errors: the line with its size, what becomes of a module,
mistakes. So no sentence is in two languages. So do the controls that only maps have: relaxation, forces, the signs of walls.
"""

from __future__ import annotations

from itertools import chain

from lsys_kit.classroom.panel.bundle import translated_words
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.system import LSystem


def translated_labels() -> dict[str, dict[str, str]]:
    """What a panel must know to show them: nothing in English.

    >>> translated_labels()
    {}
    """
    words = translated_words("panel")
    return {"words": words} if words else {}


def noun_of(system: LSystem) -> str:
    """What one module of the words of a system is called: a letter or character where it is no more than that.

    >>> from lsys_kit.notation.read import read
    >>> [noun_of(read(text)) for text in ("axiom: a\\na -> a b", "axiom: F\\nF -> F+F", "axiom: A(1)")]
    ['letter', 'character', 'module']
    """
    made = chain.from_iterable(flat(rule.successor) for rule in (*system.productions, *system.decomposition))
    modules = [*system.axiom, *made]
    if any(module.arguments or len(module.symbol) > 1 for module in modules):
        return "module"
    return "letter" if all(module.symbol.isalpha() for module in modules) else "character"
