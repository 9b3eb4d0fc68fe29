"""Records of what the grammars name: a method for each name.

The parser calls these methods while it reads, so that no tree is built in between.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from fractions import Fraction
from sys import float_info
from typing import Any, TypeAlias

from lark import Token, Transformer, v_args
from lark.visitors import merge_transformers

from lsys_kit.budget import current
from lsys_kit.notation.analysis.checks import PointList, SurfaceText, closest
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.arithmetic import PLAIN, literal_text, normalised
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name, Number, TextSpan
from lsys_kit.notation.model.modules import Pattern, Repeat
from lsys_kit.notation.model.system import Constant, MetaRule, Production
from lsys_kit.translation import gettext

_SPELLINGS = {
    "∨": "||",
    "∧": "&&",
    "¬": "!",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "−": "-",
    "·": "*",
    "×": "*",
    "\\leq": "<=",
    "\\geq": ">=",
    "\\neq": "!=",
    "\\le": "<=",
    "\\ge": ">=",
    "\\ne": "!=",
}
Part: TypeAlias = Any
"""What the parser hands to an action: a token, or the record of a part."""
Statement: TypeAlias = tuple[str, Part]
"""What a statement says: its kind and its record."""
_LEFT = "\u20d6"
"""An arrow to the left, over the letter before it."""
_LONGEST_NUMBER = 1_000
"""So many characters a number may have."""

_OTHER_NAMES = {"δ": "angle", "colors": "colours"}
"""Other names of settings."""


def place_of(*parts: Part) -> tuple[int, int]:
    """The offsets from the first to the last of some tokens or records."""
    first, last = parts[0], parts[-1]
    start: int = first.start_pos or 0 if isinstance(first, Token) else first.at[0]
    end: int = last.end_pos or 0 if isinstance(last, Token) else last.at[1]
    return start, end


def check_name(token: Token) -> None:
    if len(token) > current().name:
        raise problem("name too long", place_of(token), most=current().name)


def _surface_name(keyword: Token) -> str:
    name = keyword[:-1].split()[1]
    if len(name) > current().name:
        raise problem("name too long", place_of(keyword), most=current().name)
    return name


def _named(keyword: Token) -> str:
    """The name of a setting."""
    name = "_".join(keyword.rstrip(": \t").lower().split())
    return _OTHER_NAMES.get(name, name)


def _symbol(token: Token) -> str:
    """A symbol as the kit spells it: with an arrow over it in print, the letter and where the arrow points, L_r or L_l."""
    check_name(token)
    if token.type != "PRINTED":
        return _SPELLINGS.get(token, str(token))
    letters = re.sub(r"^\\[a-z]+|\W", "", token)
    if token[0] != "\\" and token[-1] == "}":
        return letters
    return letters + ("_l" if token[-1] == _LEFT or token.startswith("\\overleft") else "_r")


def _number(token: Token) -> Number:
    """A literal number, unless it is too long, as it was typed or as it will be written."""
    value = normalised(Fraction(str(token))) if _is_short(token) else None
    if value is None or ((len(token) > PLAIN or "e" in token.lower()) and not _is_short(literal_text(value))):
        raise problem("number too long", place_of(token))
    if value > float_info.max:
        raise problem("number too large", place_of(token))
    return Number(value, place_of(token))


def _is_short(number: str) -> bool:
    """Whether a number has neither too many digits nor too large an exponent."""
    exponent = re.search(r"[eE][+-]?(\d+)$", number)
    small = exponent is None or (len(exponent[1]) <= 5 and int(exponent[1]) <= current().exponent)
    return small and len(number) <= _LONGEST_NUMBER


def check_arity(name: Token, operator: str, operands: Sequence[Expression]) -> None:
    """A function gets as many values as it takes."""
    least, most = OPERATORS[operator].arity
    if not least <= len(operands) <= most:
        wanted = least if least == most else gettext("{least} or more", least=least)
        raise problem("number of arguments", place_of(name), name=name, wanted=values_text(wanted), given=len(operands))


def values_text(number: int | str) -> str:
    """So many values, in words."""
    return gettext("one value") if number == 1 else gettext("{number} values", number=number)


def _is_named(part: object) -> bool:
    return isinstance(part, tuple) and len(part) == 2 and isinstance(part[0], str)


@v_args(inline=True)
class Expressions(Transformer[Token, object]):
    """What `expressions.lark` names."""

    def number(self, token: Token) -> Number:
        return _number(token)

    def name(self, token: Token) -> Name:
        check_name(token)
        return Name(str(token), place_of(token))

    def unary(self, sign: Token, operand: Expression) -> Expression:
        operator = _SPELLINGS.get(sign, str(sign))
        if operator == "+":
            return operand
        if operator == "-" and isinstance(operand, Number):
            return Number(-operand.value, place_of(sign, operand))
        return self._applied("-x" if operator == "-" else operator, (operand,), place_of(sign, operand))

    def binary(self, left: Expression, sign: Token, right: Expression) -> Expression:
        return self._applied(_SPELLINGS.get(sign, str(sign)), (left, right), place_of(left, right))

    def call(self, name: Token, *operands: Expression) -> Expression:
        operator = OPERATORS.get(name)
        functions = [known for known, entry in OPERATORS.items() if entry.precedence is None]
        if operator is None or name not in functions:
            raise problem(
                "unknown function", place_of(name), closest(name, functions, 0.7), name=name, known=", ".join(sorted(functions))
            )
        check_arity(name, str(name), operands)
        return self._applied(str(name), operands, place_of(name, operands[-1]))

    def _applied(self, operator: str, operands: tuple[Expression, ...], at: TextSpan) -> Apply:
        applied = Apply(operator, operands, at)
        if applied.depth > current().depth:
            raise problem("expression too deep", at, most=current().depth)
        if at and at[1] - at[0] > current().expression:
            raise problem("expression too long", at, most=current().expression)
        return applied


@v_args(inline=True)
class Statements(Transformer[Token, object]):
    """What the grammars of the notations name."""

    def module(self, symbol: Token, *arguments: Part) -> Pattern:
        at = place_of(symbol, *arguments)
        if symbol.type == "TIMED":
            symbol, arguments = arguments[0], arguments[1:]
        return Pattern(_symbol(symbol), arguments, at)

    def word(self, *modules: Pattern) -> tuple[Pattern, ...]:
        return modules

    def successor(self, word: tuple[Pattern, ...]) -> tuple[Pattern, ...]:
        return word

    def erased(self, _: Token) -> tuple[Pattern, ...]:
        return ()

    def predecessor(self, *modules: Pattern) -> tuple[str, tuple[Pattern, ...]]:
        return "predecessors", modules

    def left(self, *modules: tuple[Pattern, ...]) -> tuple[str, tuple[Pattern, ...]]:
        return "left", modules[0] if modules else ()

    def right(self, *modules: tuple[Pattern, ...]) -> tuple[str, tuple[Pattern, ...]]:
        return "right", modules[0] if modules else ()

    def probability(self, expression: Expression) -> tuple[str, Expression]:
        return "probability", expression

    def condition(self, expression: Expression) -> tuple[str, Expression]:
        return "condition", expression

    def always(self) -> tuple[str, None]:
        return "condition", None

    def repeat(self, keyword: Token, count: Expression, *rest: Part) -> Repeat:
        repeat = Repeat(count, rest[-1], str(rest[0]) if isinstance(rest[0], Token) else "", place_of(keyword, rest[-1][-1]))
        if repeat.depth > current().depth:
            raise problem("repetitions too deep", place_of(keyword), most=current().depth)
        return repeat

    def production(self, *parts: Part) -> tuple[str, Production]:
        successor = next(part for part in parts if isinstance(part, tuple) and not _is_named(part))
        return "production", Production(successor=successor, **dict(part for part in parts if _is_named(part)))

    def meta(self, _: Token, predecessors: tuple[Pattern, ...], *parts: Part) -> tuple[str, MetaRule]:
        successor = next(part for part in parts if isinstance(part, tuple) and not _is_named(part))
        return "meta", MetaRule(predecessors, successor, **dict(part for part in parts if _is_named(part)))

    def symbols(self, keyword: Token, *names: Token) -> tuple[str, tuple[str, ...]]:
        bracket = next((name for name in names if name in "[]"), None)
        if bracket is not None:
            raise problem("bracket in list", place_of(bracket))
        return keyword.rstrip(": \t").lower(), tuple(dict.fromkeys(map(_symbol, names)))

    def axiom(self, _: Token, word: tuple[Pattern, ...]) -> tuple[str, tuple[Pattern, ...]]:
        return "axiom", word

    def plain_axiom(self, _: Token, word: tuple[Pattern, ...]) -> Statement:
        return "deferred", ("axiom", word)

    def delta(self, _: Token, value: Expression, *sign: Token) -> Statement:
        return "deferred", ("angle", value)

    def vocabulary(self, _: Token, *letters: Token) -> tuple[str, tuple[str, ...]]:
        """Only names of several letters could be taken for a row of symbols."""
        return "alphabet", tuple(letter for letter in map(_symbol, letters) if letter[0].isalpha() and len(letter) > 1)

    def constant(self, name: Token, value: Expression, *rest: Expression | Token) -> tuple[str, Constant]:
        ends = [part for part in rest if not isinstance(part, Token)]
        step = ends[2] if len(ends) == 3 else Number(1)
        check_name(name)
        return "constant", Constant(str(name), value, (ends[0], ends[1], step) if ends else None)

    def setting(self, keyword: Token, value: Part) -> tuple[str, Expression]:
        return _named(keyword), _number(value) if isinstance(value, Token) else value

    def field(self, _: Token, name: Token, *arguments: Expression) -> tuple[str, Pattern]:
        return "field", Pattern(str(name), arguments, place_of(name, *arguments))

    def chosen(self, keyword: Token, word: Token) -> tuple[str, str]:
        return _named(keyword), str(word)

    def look(self, token: Token) -> tuple[str, str]:
        """How a system looks, in a single token: a keyword and a word."""
        name, said = re.findall("[a-z]+", token)[-2:]
        return name, said

    def polygon(self, keyword: Token, *points: Pattern) -> tuple[str, SurfaceText]:
        at = place_of(keyword)
        return "surface", SurfaceText(_surface_name(keyword), (PointList(points, at),), False, at)

    def patches(self, keyword: Token, *patches: PointList) -> tuple[str, SurfaceText]:
        return "surface", SurfaceText(_surface_name(keyword), patches, True, place_of(keyword))

    def patch(self, keyword: Token, *points: Pattern) -> PointList:
        return PointList(points, place_of(keyword))

    def point(self, *coordinates: Expression) -> Pattern:
        return Pattern("point", coordinates, place_of(*coordinates))

    def alphabet(self, _: Token, *names: Token) -> tuple[str, tuple[str, ...]]:
        return "alphabet", tuple(map(str, names))

    def section(self, keyword: Token) -> tuple[str, str]:
        return "section", keyword.rstrip(": \t").lower()

    def heading(self, _: Token) -> Statement:
        return "deferred", ("heading", None)

    def how_many(self, _: Token, number: Token) -> Statement:
        return "deferred", ("how many", _number(number))

    def stage(self, _: Token, word: tuple[Pattern, ...]) -> Statement:
        return "deferred", ("stage", word)


def transformer(
    statements: type[Transformer[Token, object]], expressions: type[Expressions] = Expressions
) -> Callable[[], Transformer[Token, object]]:
    """What makes the records of a grammar that imports `expressions.lark`."""

    def made() -> Transformer[Token, object]:
        return merge_transformers(statements(), expressions=expressions())  # type: ignore[no-untyped-call,no-any-return]

    return made
