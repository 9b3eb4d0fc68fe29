"""Records to text: a whole system, laid out in a notation.

`read(write(system)) == system` for every system that the notation can express.
"""

from __future__ import annotations

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model import LSystem
from lsys_kit.notation.registry import notation_called


def write(system: LSystem, notation: str | None = None) -> str:
    """The text of a system.

    Parameters
    ----------
    system
        Any L-system.
    notation
        A notation that `read` reads; by default the one in which the system was read.

    Raises
    ------
    ModelNameError
        There is no such notation.
    ModelValueError
        The notation lacks something that the system needs; the message names it.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> print(write(read("axiom: A(0)  \\nA(t): t<5 --> A(t+1) [B]")))
    axiom: A(0)
    A(t) : t < 5 -> A(t + 1)[B]
    """
    chosen = notation_called(notation or system.notation)
    lacking = chosen.lacking(system)
    if lacking:
        raise ModelValueError(f"The notation {chosen.name} has no {lacking}, which this system needs")
    return chosen.write(system)
