"""What may be wrong in the declaration of a surface, where the parser fails."""

from __future__ import annotations

import re

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.failure import ParseFailure, quoted, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import ARROW

_DECLARATION = re.compile(r"surface\b(?P<named>[ \t]+[A-Za-z_]\w*[ \t]*:)?", re.IGNORECASE)
_FILE = re.compile(r"(?<![\w./\\-])[\w./\\-]+\.s\b")
_POINT = 'A point is "(ahead, left)" or "(ahead, left, up)".'


def surface_declaration(failure: ParseFailure) -> ModelSyntaxError | None:
    """A surface without a name, with something else than points, or with the name of a file."""
    found = _DECLARATION.match(failure.statement)
    if not found or ARROW.search(failure.statement):
        return None
    if not found["named"]:
        return failure.error(
            "A surface needs a name and a colon",
            'It reads "surface leaf: (0, 0) (1, 0.2) (1, -0.2)".',
            failure.start,
            len(found[0]),
        )
    file = _FILE.search(failure.statement, found.end())
    if file:
        return failure.error(
            "A model opens no files",
            "Read the file yourself: with_surface(system, name, text).",
            failure.start + file.start(),
            len(file[0]),
        )
    read = failure.at - failure.start
    opened = unclosed_bracket(failure.statement[:read])
    if opened is not None:
        return failure.error("This is no point of a surface", _POINT, failure.start + opened, read - opened)
    if not failure.found:
        return failure.error(f"There is nothing after {quoted(failure.before)}", _POINT, failure.start, len(failure.before))
    hint = (
        "Points are separated by blanks."
        if failure.found == ","
        else f'{_POINT} A surface is a polygon, or patches that each begin with "patch".'
    )
    return failure.error(f"I did not expect {quoted(failure.found)} here", hint)
