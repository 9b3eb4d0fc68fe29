"""What the parser stumbled over, in the words of the person who typed it.

A parser knows which token it did not expect; a student wants to know what is missing. `explained` looks at the statement
and the place, and says the likeliest of a short list of slips.
"""

from __future__ import annotations

import re

from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from lsys_kit.errors import ModelSyntaxError, named

ARROW = re.compile(r"-->|->|→|⟶")
_WORDS = {
    "ARROW": "an arrow", "NAME": "a name", "SYMBOL": "a symbol", "NUMBER": "a number", "LPAR": '"("', "RPAR": '")"',
    "COMMA": '","', "COLON": '":"', "RELATION": "a comparison", "$END": "the end of the line", "RANGE": '".."',
}


def explained(slip: UnexpectedInput, source: str, start: int, end: int) -> ModelSyntaxError:
    """The slip in the statement between two offsets, as an error with its place and a hint."""
    at, found = _found(slip, end)
    expected = set(getattr(slip, "expected", None) or getattr(slip, "allowed", None) or ())
    statement = source[start:end]
    before = source[start:at].rstrip()
    open_bracket = _unclosed(source, start, end)
    if found and not found[0].isascii():
        return ModelSyntaxError(f"I cannot read the character {named(found[0])}", source, at, at + 1,
                                "Names are made of the letters A to Z, digits and _.")
    if found.startswith("="):
        return ModelSyntaxError('A single "=" cannot be used here', source, at, at + 1, 'To compare two values, type "==".')
    if open_bracket is not None and (not found or found.startswith(("-", "→"))):
        return ModelSyntaxError('This "(" is never closed', source, open_bracket, open_bracket + 1)
    if found.startswith(")") and "RPAR" not in expected and _unopened(source[start:at]):
        return ModelSyntaxError('This ")" closes nothing', source, at, at + 1)
    if ARROW.search(before) and ARROW.match(found):
        return ModelSyntaxError("A second arrow stands in this production", source, at, at + len(found),
                                "Write one production a line.")
    if not found and re.search(rf"({ARROW.pattern})$", before):
        predecessor = ARROW.split(statement)[0].split(":")[0].strip()
        return ModelSyntaxError("Nothing stands behind the arrow", source, max(start, at - 2), at,
                                f'To erase {predecessor}, write "ε" or "*" there.')
    if "ARROW" in expected and not ARROW.search(statement):
        return ModelSyntaxError("An arrow is missing here", source, at, at + max(1, len(found)),
                                'A production reads "A -> B": what is replaced, an arrow, what replaces it.')
    what = f"I did not expect {named(found[0]) if len(found) == 1 else repr(found).replace(chr(39), chr(34))} here" if found \
        else "The line ends too early"
    return ModelSyntaxError(what, source, at, at + max(1, len(found)), _hint(expected))


def _found(slip: UnexpectedInput, end: int) -> tuple[int, str]:
    """The offset of the slip and the text there; no text at the end of the statement."""
    if isinstance(slip, UnexpectedToken) and slip.token.type != "$END":
        return slip.token.start_pos or 0, str(slip.token)
    if isinstance(slip, UnexpectedCharacters):
        return slip.pos_in_stream or 0, slip.char
    return end, ""


def _unclosed(source: str, start: int, end: int) -> int | None:
    """The offset of the last "(" that is not closed."""
    opened: list[int] = []
    for offset in range(start, end):
        if source[offset] == "(":
            opened.append(offset)
        elif source[offset] == ")" and opened:
            opened.pop()
    return opened[-1] if opened else None


def _unopened(text: str) -> bool:
    return text.count("(") <= text.count(")")


def _hint(expected: set[str]) -> str | None:
    words = sorted({_WORDS[name] for name in expected if name in _WORDS})
    if not words or len(words) > 4:
        return None
    return "Possible here: " + " or ".join((", ".join(words[:-1]), words[-1]) if len(words) > 1 else words) + "."
