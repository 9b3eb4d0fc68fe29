"""Text to a cellwork L-system. The grammar is `grammar.lark`.

As the kit writes them, cellworks begin with `cellwork:`, and `read` refers such texts to this reader.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from lark import Token, Transformer, v_args

from lsys_kit.budget import current
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.analysis.cell_checks import check_cellwork, unused_parts
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.fragments import is_link, unpacked
from lsys_kit.notation.model.cells import (
    ANY,
    CellworkProduction,
    CellworkSystem,
    Corner,
    Edge,
    EdgeMarker,
    FirstWall,
    WallProduction,
)
from lsys_kit.notation.syntax.actions import Part
from lsys_kit.notation.syntax.dialect import Grammar
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.text.statements import bounded, check_text, statements
from lsys_kit.notation.syntax.wording import Spelling, notes, reporting

LONGEST_NUMBER = 30
"""The greatest number of digits of a corner or of its place."""


def read_cellwork(text: str) -> CellworkSystem:
    """Read a cellwork L-system.

    Parameters
    ----------
    text
        The corners and the walls of the first cell, and productions, one a line. `/* ... */` is a comment.
        Or a link with a cellwork system in it.

    Raises
    ------
    ModelSyntaxError, ModelValueError
        The text makes no sense, or the first cell is not closed; the error has the place and a hint.
    ModelLimitError
        The text is too long.

    Examples
    --------
    >>> tetrahedron = read_cellwork('''
    ... cellwork: 1(0,0,0) 2(1,0,0) 3(0,1,0) 4(0,0,1)
    ... wall W: 1 A 2 A 3 A
    ... wall W: 1 A 2 A 4 A
    ... wall W: 1 A 3 A 4 A
    ... wall W: 2 A 3 A 4 A
    ... A: * -> A [W: W|B|W, W] A''')
    >>> print(tetrahedron.productions[0])
    A: * -> A [W: W|B|W, W] A
    >>> read_cellwork(str(tetrahedron)) == tetrahedron
    True

    References
    ----------
    Fracchia and Prusinkiewicz, Physically-based graphical interpretation of marker cellwork L-systems (1990); The Algorithmic
    Beauty of Plants, section 7.5.
    """
    check_text(text)
    if is_link(text):
        content = unpacked(text)
        if content.notation != CELLWORK.name:
            raise ModelValueError(
                "This is the link of another system, not of a cellwork system",
                hint="L-systems are read by read(link), map systems by read_map(link).",
            )
        text = content.text
    with reporting(text, CELLWORK.spelling):
        system = _system(text)
        check_cellwork(system)
    return replace(system, notes=notes(unused_parts(system), CELLWORK.spelling))


def _system(text: str) -> CellworkSystem:
    made: dict[str, list[Part]] = {kind: [] for kind in ("cellwork", "steps", "wall", "production", "wall_production")}
    for start, end in bounded(statements(text), text):
        kind, record = parse(CELLWORK, "statement", text, start, end)
        if kind in ("cellwork", "steps") and made[kind]:
            raise problem("setting twice", (start, end), keyword=kind)
        made[kind].append(record)
    if not (made["cellwork"] and made["wall"]):
        raise problem("no first cell", (len(text), len(text)))
    return CellworkSystem(
        made["cellwork"][0],
        tuple(made["wall"]),
        tuple(made["production"]),
        tuple(made["wall_production"]),
        next(iter(made["steps"]), None),
        text,
    )


@v_args(inline=True)
class _CellworkStatements(Transformer[Token, object]):
    """What `grammar.lark` names."""

    def edge(self, label: Token, *points: Token) -> Edge:
        return Edge(_name(label), str(points[0]) if points else "", _span(label, *points))

    def marker(self, wall: Token, before: Token, edge: Edge, after: Token, new_wall: Token) -> EdgeMarker:
        return EdgeMarker(_name(wall), edge, (_name(before), _name(after)), _name(new_wall), _span(wall, new_wall))

    def corner(self, name: Token, *places: Token) -> Corner:
        x, y, z = (Fraction(_number(place)) for place in places)
        return Corner(_number(name), (x, y, z), _span(name))

    def first(self, _: Token, *corners: Corner) -> tuple[str, tuple[Corner, ...]]:
        return "cellwork", corners

    def wall(self, _: Token, label: Token, *around: Part) -> tuple[str, FirstWall]:
        return "wall", FirstWall(_name(label), tuple(map(_number, around[::2])), around[1::2], _span(label))

    def wall_production(self, _: Token, label: Token, __: Token, becomes: Token) -> tuple[str, WallProduction]:
        return "wall_production", WallProduction(_name(label), _name(becomes), _span(label))

    def production(self, predecessor: Edge, *parts: Part) -> tuple[str, CellworkProduction]:
        arrow = next(place for place, part in enumerate(parts) if isinstance(part, Token) and part.type == "ARROW")
        walls = tuple(dict.fromkeys(_name(wall) for wall in parts[:arrow] if wall != ANY))
        successor: tuple[Edge | EdgeMarker, ...] = parts[arrow + 1 :]
        return "production", CellworkProduction(predecessor, successor, walls, predecessor.at)

    def steps(self, _: Token, number: Token) -> tuple[str, int]:
        if len(number) > 9:
            raise problem("number too large", _span(number))
        return "steps", int(number)


def _span(*tokens: Token) -> tuple[int, int]:
    return tokens[0].start_pos or 0, tokens[-1].end_pos or 0


def _name(token: Token) -> str:
    """A label that is not too long."""
    if len(token) > current().name:
        raise problem("name too long", _span(token), most=current().name)
    return str(token)


def _number(token: Token) -> str:
    """The digits of a number that is not too long."""
    if len(token) > LONGEST_NUMBER:
        raise problem("number too large", _span(token))
    return str(token)


CELLWORK = Grammar(
    name="cellwork",
    transformer=_CellworkStatements,
    diagnostics=("foreign_comment", "unreadable_character", "setting", "wall", "second_arrow", "own_marker", "production"),
    starts=("statement",),
    spelling=Spelling(Path(__file__).parent),
)
