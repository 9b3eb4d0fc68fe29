"""All notations, by name, and which of them a text is written in."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from lsys_kit.errors import ModelNameError, require
from lsys_kit.notation.dialects.abop.dialect import ABOP
from lsys_kit.notation.dialects.cpfg.dialect import CPFG
from lsys_kit.notation.dialects.fractint.dialect import FRACTINT
from lsys_kit.notation.dialects.grogra.dialect import GROGRA
from lsys_kit.notation.dialects.mathematica.dialect import MATHEMATICA
from lsys_kit.notation.dialects.plant_string.dialect import PLANT_STRING
from lsys_kit.notation.model.system import WRITERS
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.systems import text_in

DIALECTS: Mapping[str, Dialect] = {
    notation.name: notation for notation in (ABOP, PLANT_STRING, GROGRA, CPFG, MATHEMATICA, FRACTINT)
}
"""The notations that can be read and written."""
WRITERS.update({notation.name: partial(text_in, notation) for notation in DIALECTS.values()})


def dialect_named(name: str) -> Dialect:
    """The notation with a name.

    Raises
    ------
    ModelNameError
        There is no such notation.
    """
    require(name, str, "The name of a notation")
    if name == "map":
        hint = "A text that begins with the walls of a cell is read by read_map(text)."
        raise ModelNameError("Maps are no L-systems", hint=hint)
    if name == "cellwork":
        raise ModelNameError("Cellworks are no L-systems", hint="Cellworks are read by read_cellwork(text).")
    if name not in DIALECTS:
        raise ModelNameError(f'There is no notation called "{name}"', hint=f"Notations are: {', '.join(DIALECTS)}.")
    return DIALECTS[name]


def recognise(text: str) -> Dialect:
    """The notation whose features a text shows most; the kit's own where it shows none.

    >>> recognise("axiom: A").name
    'abop'
    """
    lines = "\n".join(line for line in text.split("\n") if line.strip())  # a pattern may look again at each blank
    return max(DIALECTS.values(), key=lambda notation: notation.likely(lines))
