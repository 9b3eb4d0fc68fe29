"""Text to a map L-system. The grammar is `grammar.lark`.

Map systems do not rewrite strings: what reads as a branch in an L-system, `A -> B[-A][+A]B`, is here a wall that becomes two
walls, with a marker on either side. A text alone does not say which of the two is meant, so maps have a reader of their own.
As the kit writes them, they begin with `map:`, and `read` refers such texts to this reader.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from lark import Token, Transformer, v_args

from lsys_kit.budget import current
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.notation.analysis.cell_checks import check_map, unused_parts
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.fragments import is_link, unpacked
from lsys_kit.notation.model.cells import Edge, EdgeProduction, MapSystem, Marker, SuccessorPart
from lsys_kit.notation.syntax.builder import Settings
from lsys_kit.notation.syntax.dialect import Grammar
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.text.printed import printed_statements
from lsys_kit.notation.syntax.text.statements import bounded, check_text, without_comments
from lsys_kit.notation.syntax.text.transcript import edited
from lsys_kit.notation.syntax.text.typesetting import typesetting
from lsys_kit.notation.syntax.wording import Spelling, notes, reporting

_LEFTWARD = re.compile("\\\\overleftarrow|.\u20d6")


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
    settings: Settings = {}
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
class _MapStatements(Transformer[Token, object]):
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


MAP = Grammar(
    name="map",
    transformer=_MapStatements,
    diagnostics=("foreign_comment", "setting", "brackets", "second_arrow", "own_arrow", "walls", "unreadable_character"),
    starts=("statement",),
    spelling=Spelling(Path(__file__).parent),
)
