"""Records to text: a whole system, laid out in a notation; or a part of it, as it was written.

`read(write(system)) == system`, or `write` says what the notation lacks.
"""

from __future__ import annotations

from dataclasses import replace

from lsys_kit.errors import require
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.registry import dialect_named
from lsys_kit.notation.syntax.systems import text_in


def write(system: LSystem, notation: str | None = None, *, interpretation: bool = True) -> str:
    """The text of a system, which reads back as the same system.

    Fractint's turtle is another than the kit's: for it a system that has only `F f + - | [ ]` and letters is translated, and
    what reads back draws the same.

    Parameters
    ----------
    system
        Any L-system.
    notation
        A notation that `read` reads; by default the one in which the system was read.
    interpretation
        Whether its interpretation rules are written; without them the words are the same, and are drawn as they are.

    Raises
    ------
    ModelNameError
        There is no such notation.
    ModelValueError
        The notation lacks something that the system needs; the message names it.
    ModelLimitError
        The text is longer than what is read.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> print(write(read("axiom: A(0)  \\nA(t): t<5 --> A(t+1) [B]")))
    axiom: A(0)
    A(t) : t < 5 -> A(t + 1)[B]
    """
    require(system, LSystem, "An L-system")
    require(interpretation, bool, 'True or False for "interpretation"')
    written = system if interpretation else replace(system, interpretation=(), depth=1)
    return text_in(dialect_named(system.notation if notation is None else notation), written)


def as_written(system: LSystem, part: object) -> str:
    """A production, condition or pattern of a system as in its text; in the kit's own notation where there is no text.

    >>> from lsys_kit.notation.read import read
    >>> system = read("* # F a,\\n(t<6)  k(t) # k(t+1)", "grogra")
    >>> as_written(system, system.productions[1]), as_written(LSystem((), ()), system.productions[1])
    ('(t<6) k(t) # k(t+1)', 'k(t) : t < 6 -> k(t + 1)')
    """
    start, end = span(part)
    if not system.source or not end:
        return str(part)
    written = " ".join(system.source[start:end].split())
    return written + ")" * (written.count("(") - written.count(")"))  # the place of a call ends with its last value
