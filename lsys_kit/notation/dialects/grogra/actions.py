"""Records of what GROGRA's grammar names; a text cut into statements."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from lark import Token, Transformer, v_args
from lark.visitors import merge_transformers

from lsys_kit.errors import ModelSyntaxError, ModelValueError
from lsys_kit.notation.dialects.grogra.variables import Variable
from lsys_kit.notation.model.expressions import OPERATORS, Expression, Name
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Constant, Production
from lsys_kit.notation.syntax.actions import ActionError, Expressions, Statements
from lsys_kit.notation.syntax.text.statements import without_comments

RELATIONS = {"=": "==", "\\leq": "<=", "\\le": "<=", "\\geq": ">=", "\\ge": ">=", "\\neq": "!=", "\\ne": "!="}
"""How GROGRA or Kurth's slides spell comparisons."""
_GLUED = re.compile(r"([^\d.-]+)(-?)([\d.]+)")
_SEPARATORS = re.compile(r"[()]|,[,\s]*|^[ \t]*Startwort[ \t]+[A-Za-z*](?![^\n]*(?:#|->|→|\\rightarrow))", re.MULTILINE)
BLANKS = "\ufeff \t\r\n\u00a0"
"""Characters between statements that mean nothing."""


def statements(text: str) -> Iterator[tuple[int, int]]:
    r"""The offsets of the statements, which are separated by commas outside of parentheses.

    >>> text = "* # F a(1, 2),\n\na(x, y) # F,"
    >>> [text[start:end] for start, end in statements(text)]
    ['* # F a(1, 2)', 'a(x, y) # F']
    """
    source, text = text, without_comments(text)
    if (closed := text.find("*/")) >= 0:
        raise ModelSyntaxError("This comment was never opened", source, closed, closed + 2, 'A comment begins with "/*".')
    depth = start = 0
    for part in _SEPARATORS.finditer(text):
        if part.group() in "()":
            depth = max(0, depth + (1 if part.group() == "(" else -1))
        elif depth == 0 or part.group()[0] != ",":
            yield from _stripped(text, start, part.start())
            start, depth = part.end() if part.group()[0] == "," else part.start(), 0
    yield from _stripped(text, start, len(text))


def _stripped(text: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """The offsets without the blanks around; nothing where there is nothing else."""
    stretch = text[start:end]
    if stretch.strip(BLANKS):
        yield start + len(stretch) - len(stretch.lstrip(BLANKS)), start + len(stretch.rstrip(BLANKS))


@v_args(inline=True)
class _GrograExpressions(Expressions):
    """GROGRA's comparisons, and functions that the text declares."""

    def binary(self, left: Expression, sign: Token, right: Expression) -> Expression:
        return super().binary(left, sign.update(value=RELATIONS.get(sign, str(sign))), right)

    def call(self, name: Token, *operands: Expression) -> Expression:
        operator = OPERATORS.get(name)
        at = name.start_pos or 0, name.end_pos or 0
        if operator is not None and operator.random:
            raise ActionError(
                ModelSyntaxError,
                "A random number is declared on a line of its own",
                at,
                f'Type "\\var x {name} ...," there, and "x" here.',
            )
        if operator is not None and operator.precedence is None and name != "sensed":
            return super().call(name, *operands)
        return self._applied("sensed", (Name(str(name), at), *operands), at)  # the text's own; its name is looked up later


@v_args(inline=True)
class _GrograStatements(_GrograExpressions, Statements):
    """What `grammar.lark` names."""

    def glued(self, token: Token) -> Pattern:
        """A command with its number: in `L*0.6` the symbol is `L*`."""
        symbol, sign, number = (_subtoken(token, *match) for match in _command_parts(token))
        value = self.number(number)
        return self.module(symbol, self.unary(sign, value) if sign else value)

    def axiom(self, _: Token, word: tuple[Pattern, ...], *steps: Token) -> tuple[str, Any]:
        ends = [int(end) for end in steps[0].split("-")] if steps else []
        if ends and ends[0] > ends[-1]:
            raise ActionError(
                ModelValueError,
                f'"{steps[0]}" runs backwards',
                (steps[0].start_pos or 0, steps[0].end_pos or 0),
                'Steps are counted upwards, as in "1-8".',
            )
        return "deferred", ("axiom", (word, ends[-1] if ends else None))

    def setting(self, keyword: Token, value: Expression) -> tuple[str, Any]:
        return "deferred", ("setting", (keyword.split()[-1].lstrip("\\"), value))

    def turtle(self, _: Token, tradition: Token) -> tuple[str, Any]:
        return "deferred", ("setting", ("turtle", str(tradition)))

    def look(self, token: Token) -> tuple[str, Any]:
        return "deferred", ("setting", super().look(token))

    def unused(self, token: Token) -> tuple[str, Any]:
        return "deferred", ("note", f'"{" ".join(token.split())}" has no meaning here.')

    def constant(self, name: Token, *rest: Any) -> tuple[str, Constant]:
        return super().constant(*rest)  # the first token is "\\const"

    def variable(self, _: Token, name: Token, kind: Token, *values: Expression) -> tuple[str, Any]:
        self.name(name)
        return "deferred", ("variable", Variable(str(name), str(kind), values, (kind.start_pos or 0, kind.end_pos or 0)))

    def production(self, *parts: Any) -> tuple[str, Any]:
        return "production", _production_of(parts)

    def interpretation(self, *parts: Any) -> tuple[str, Any]:
        return "deferred", ("interpretation", _production_of(parts))


def _command_parts(token: Token) -> list[tuple[str, int]]:
    """The symbol, the sign and the number of a command, each with its offset in it."""
    match = _GLUED.fullmatch(token)
    return [(match[i], match.start(i)) for i in (1, 2, 3)] if match else []


def _subtoken(token: Token, text: str, offset: int) -> Token:
    start = (token.start_pos or 0) + offset
    return Token(token.type, text, start_pos=start, end_pos=start + len(text))


def _production_of(parts: tuple[Any, ...]) -> Production:
    """A rule, whose successor may be nothing at all."""
    predecessor = next(part for part in parts if isinstance(part, Pattern))
    named = {part[0]: part[1] for part in parts if isinstance(part, tuple) and part and isinstance(part[0], str)}
    successor = next((part for part in parts if isinstance(part, tuple) and not (part and isinstance(part[0], str))), ())
    return Production((predecessor,), successor, **named)


def transformer() -> Transformer[Any, Any]:
    """What makes the records."""
    return merge_transformers(_GrograStatements(), expressions=_GrograExpressions())  # type: ignore[no-untyped-call,no-any-return]
