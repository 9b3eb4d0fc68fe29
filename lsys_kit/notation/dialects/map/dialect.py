"""Text to a map L-system. The grammar is `grammar.lark`.

Map systems do not rewrite strings: what reads as a branch in an L-system, `A -> B[-A][+A]B`, is here a wall that becomes two
walls, with a marker on either side. A text alone does not say which of the two is meant, so maps have a reader of their own.
As the kit writes them, they begin with `map:`, and `read` refers such texts to this reader.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from lark import Token, Transformer, v_args

from lsys_kit.budget import current
from lsys_kit.errors import LSystemError, ModelLimitError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.analysis.cell_checks import check_map, unused_parts
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.fragments import is_link, unpacked
from lsys_kit.notation.model.cells import Edge, EdgeProduction, MapSystem, Marker, SuccessorPart
from lsys_kit.notation.syntax.common_diagnostics import foreign_comment, second_arrow, unreadable_character
from lsys_kit.notation.syntax.dialect import Diagnostic, Grammar
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, quoted, unclosed_bracket
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.spelling import spelling_in
from lsys_kit.notation.syntax.text.printed import printed_statements
from lsys_kit.notation.syntax.text.statements import ARROW, bounded, check_text, without_comments
from lsys_kit.notation.syntax.text.transcript import edited
from lsys_kit.notation.syntax.text.typesetting import typesetting
from lsys_kit.notation.syntax.wording import notes, reporting

_LEFTWARD = re.compile("\\\\overleftarrow|.\u20d6")
SPELLING = spelling_in(Path(__file__).parent)


def read_map(text: str) -> MapSystem:
    """Read a map L-system.

    Parameters
    ----------
    text
        The walls of the first cell, clockwise, or of a sphere, and productions, one a line, in ASCII, as print has them, or
        as LaTeX sets them.
        `/* ... */` is a comment. Or a link with a map system in it.

    Raises
    ------
    ModelSyntaxError, ModelValueError
        The text makes no sense; the error has the place and a hint.
    ModelLimitError
        The text is too long.

    Examples
    --------
    >>> divided = read_map("ω : ABAB, p_1 : A → B[-A][+A]B, p_2 : B → A".replace(", ", "\\n"))
    >>> print(divided)
    map: ABAB
    A -> B[-A][+A]B
    B -> A
    >>> read_map(str(divided)) == divided
    True

    References
    ----------
    Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants, section 7.1.2.
    """
    check_text(text)
    if is_link(text):
        content = unpacked(text)
        if content.notation != MAP.name:
            raise ModelValueError(
                "This is the link of an L-system, not of a map system", hint="L-systems are read by read(link)."
            )
        text = content.text
    transcript = edited(text, typesetting(without_comments(text)))
    try:
        with reporting(transcript.text, MAP.spelling):
            system = _system(transcript.text)
            check_map(system)
    except LSystemError as error:
        raise transcript.relocated(error) from None
    return replace(system, notes=notes(unused_parts(system), MAP.spelling))


def _system(text: str) -> MapSystem:
    settings: dict[str, Any] = {}
    productions: list[EdgeProduction] = []
    for start, end in bounded(printed_statements(text), text):
        kind, record = parse(MAP, "statement", text, start, end)
        if kind == "production":
            productions.append(record)
        elif kind in settings:
            raise problem("second cell" if kind == "first" else "setting twice", (start, end), keyword=kind)
        else:
            settings[kind] = record
        if len(productions) > current().rules:
            raise ModelLimitError(
                f"The model has more than {current().rules:,} productions", limit=current().rules, source=text, start=start
            )
    if "first" not in settings:
        raise problem("no first cell", (len(text), len(text)))
    sphere, axiom = settings["first"]
    return MapSystem(axiom, tuple(productions), settings.get("steps"), sphere, text)


@v_args(inline=True)
class _MapStatements(Transformer[Any, Any]):
    """What `grammar.lark` names."""

    def edge(self, label: Token, *points: Token) -> Edge:
        at = label.start_pos or 0, (points or (label,))[-1].end_pos or 0
        arrow = "<" if _LEFTWARD.match(label) else "" if label.type == "LABEL" else ">"
        name = re.sub(r"^\\[a-z]+|\W", "", label)
        if len(name) > current().name:
            raise problem("name too long", at, most=current().name)
        return Edge(name, str(points[0]) if points else arrow, at)

    def marker(self, side: Token, edge: Edge) -> Marker:
        return Marker(side.replace("−", "-"), edge, (side.start_pos or 0, edge.at[1] if edge.at else 0))

    def production(self, predecessor: Edge, _: Token, *successor: SuccessorPart) -> tuple[str, EdgeProduction]:
        return "production", EdgeProduction(predecessor, successor, predecessor.at)

    def first(self, keyword: Token, *edges: Edge) -> tuple[str, tuple[bool, tuple[Edge, ...]]]:
        return "first", (keyword.lower().startswith("sphere"), edges)

    def steps(self, _: Token, number: Token) -> tuple[str, int]:
        if len(number) > 9:
            raise problem("number too large", (number.start_pos or 0, number.end_pos or 0))
        return "steps", int(number)


# What may be wrong where the parser fails

_MARKER = 'A marker reads "[-A]" or "[+A]": the side of the wall, the letter of a wall to come.'
_FIRST_HINT = 'Give the walls of the first cell, one after another, clockwise, as in "map: ABAB".'
_MISSPELT_ARROWS = re.compile(r"::=|:=|=>|⇒|↦|[–—−~]>|-[ \t]+>|=")
_SETTING = re.compile(r"([A-Za-z]{2,})[ \t]*:")
_FIRST_CELL = re.compile(r"(map|sphere|axiom|omega|ω)\b", re.IGNORECASE)
_FOREIGN_SIGNS: Mapping[str, tuple[str, str]] = {
    "(": ("A wall has no values", "Walls are letters, perhaps with a digit and an arrow: A, A1, A>."),
    ")": ("A wall has no values", "Walls are letters, perhaps with a digit and an arrow: A, A1, A>."),
    ":": ("A wall has no condition", SPELLING.rule_example),
    ";": ('A ";" is not needed here', "Write one production per line."),
    ",": ('A "," is not needed here', "Walls are written side by side, with or without blanks between them."),
    "ε": ("A wall cannot be erased", "A map is propagating: every wall becomes one wall or several."),
    "*": ("A wall cannot be erased", "A map is propagating: every wall becomes one wall or several."),
    "_": ("A letter has no subscript here", "Write the number after the letter, as in A1."),
    "+": ('This "+" is outside of a marker', _MARKER),
    "-": ('This "-" is outside of a marker', _MARKER),
    "[": ("A marker inside a marker is not possible", _MARKER),
}
"""Signs that other systems have and maps have not: what to say of them, what to write."""


def _foreign_setting(failure: ParseFailure) -> ModelSyntaxError | None:
    """A word with a colon, which maps do not have; or the first cell without its colon, or without walls."""
    statement = failure.statement
    setting, axiom = _SETTING.match(statement), _FIRST_CELL.match(statement)
    if axiom and not ARROW.search(statement):
        return _first_cell(failure, axiom[1], statement[axiom.end() :].strip())
    if setting and setting[1].lower() == "steps":
        return failure.error('After "steps:" a whole number is needed', 'Type "steps: 4".', failure.start, 5)
    if setting and not ARROW.search(statement):
        return failure.error(
            f'A map system has no "{setting[1]}:"', 'It has "map:", "steps:" and productions.', failure.start, len(setting[1])
        )
    return None


def _first_cell(failure: ParseFailure, word: str, rest: str) -> ModelSyntaxError | None:
    """The first cell without its colon, or without walls."""
    walls = rest.lstrip(":= \t")
    if not walls:
        return failure.error("The first cell has no walls", _FIRST_HINT, failure.start, len(word))
    if rest[0] != ":" and (rest[0] != "=" or word.isascii()):
        return failure.error(f'A ":" is missing after "{word}"', f'Type "map: {excerpt(walls)}".', failure.start, len(word))
    return None


def _brackets(failure: ParseFailure) -> ModelSyntaxError | None:
    """Markers: their brackets, their side, their letter."""
    opened = unclosed_bracket(failure.before, "[]")
    if failure.found == "]" and opened is None:
        return failure.error('This "]" closes nothing', _MARKER)
    if "ARROW" in failure.accepted or not ARROW.search(failure.text, failure.start, failure.end):
        return (
            failure.error("A marker is not possible here", "Markers come after the arrow of a production.")
            if failure.found == "["
            else None
        )
    if opened is None:
        return None
    at = failure.start + opened
    if not failure.found or ("RSQB" in failure.accepted and ARROW.match(failure.found)):
        return failure.error('This "[" is never closed', _MARKER, at, 1)
    if failure.accepted == {"SIDE"} and failure.found != "[":
        return failure.error(
            "This marker does not say on which side it is", "Left of the wall is +, right is -, seen in its direction."
        )
    if failure.found == "]" and "LABEL" in failure.accepted:
        return failure.error("This marker has no letter", _MARKER)
    if failure.found in ("+", "-", "−") and "LABEL" in failure.accepted:
        return failure.error("A marker is on one side", 'For both sides write two: "[-A][+A]".')
    if "RSQB" in failure.accepted and failure.found.isalnum():
        return failure.error("A marker has one letter", 'Write a marker for each: "[-A][-B]".')
    return None


def _arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow that is missing, misspelt, or with nothing before or after it."""
    arrow = ARROW.search(failure.text, failure.start, failure.end)
    if ARROW.match(failure.found) and "ARROW" not in failure.accepted:
        return failure.error(
            "An arrow is not possible here" if failure.before else "There is nothing before the arrow", SPELLING.rule_example
        )
    if not failure.found and arrow and arrow.end() - failure.start >= len(failure.before):
        return failure.error(
            "There is nothing after the arrow",
            "Walls are never erased: write what this one becomes.",
            arrow.start(),
            len(arrow.group()),
        )
    if arrow is None and "ARROW" in failure.accepted:
        spelt = _MISSPELT_ARROWS.match(failure.text, failure.at, failure.end)
        if spelt:
            return failure.error("This is not an arrow", 'An arrow is typed "->", in one piece.', length=len(spelt.group()))
        return failure.error("An arrow is missing here", SPELLING.rule_example)
    return None


def _walls(failure: ParseFailure) -> ModelSyntaxError | None:
    """Something beside a wall."""
    if failure.found in ("<", ">"):
        message = "This is a second {}" if re.search(r"\w[<>]$", failure.before) else "There is no wall before this {}"
        return failure.error(
            message.format(quoted(failure.found)), "A wall points one way, and its arrow comes after its letter: A> or A<."
        )
    if "ARROW" in failure.accepted and failure.found[:1].isalpha() and failure.found.isascii():
        return failure.error("Only one wall can be replaced", "Maps have no contexts. Write a production for each wall.")
    if failure.found[:1].isdigit():
        return failure.error("A number is not a wall", "Walls are letters, perhaps with a digit after them: A, A1.")
    return failure.error(*_FOREIGN_SIGNS[failure.found]) if failure.found in _FOREIGN_SIGNS else None


DIAGNOSTICS: Sequence[Diagnostic] = (
    foreign_comment,
    _foreign_setting,
    _brackets,
    second_arrow,
    _arrow,
    _walls,
    unreadable_character,
)
"""The diagnostics of a map system, the most specific first."""

MAP = Grammar(name="map", transformer=_MapStatements, diagnostics=DIAGNOSTICS, starts=("statement",), spelling=SPELLING)
