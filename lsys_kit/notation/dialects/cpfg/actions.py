"""What cpfg's grammar names, as records."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache

from lark import Token, v_args

from lsys_kit.budget import current
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.dialects.cpfg.expressions import as_number, as_truth, resolve_call, simplified, wanted
from lsys_kit.notation.dialects.cpfg.variables import SEED, Assignment, Block, Choice, Instruction
from lsys_kit.notation.model.expressions import Apply, Expression, Number, TextSpan
from lsys_kit.notation.model.modules import END, Pattern
from lsys_kit.notation.model.system import Constant
from lsys_kit.notation.syntax.actions import Expressions, Part, Statement, Statements, place_of

_SPELLINGS = {"<>": "!=", "%": "rem"}
"""Operators, and how the kit spells them."""
SYMBOL_PATTERN = re.compile(r"@T[a-z]|@G[sce]|@P[SCD]|@D[id]|@[A-Za-z#!]|\?[A-Z]|[A-Za-z0-9_+\-−&^\\/|\[\]{}$!'#~;,.%]")
"""A symbol: a character, or "@" or "?" with a letter."""
SILENT = frozenset(("printf", "fprintf", "fflush", "fclose", "stop", "play", "Display"))
"""Functions that change nothing in a model when they are called for their own sake."""
_SECTION_NAMES = {"production": "productions", "homomorphism": "interpretation"}
"""Sections, and what the kit calls them."""


def _expression_span(first: Expression, last: Expression | None = None) -> tuple[int, int]:
    """The offsets from the first to the last of some expressions."""
    return (first.at or (0, 0))[0], ((last or first).at or (0, 0))[1]


@cache
def _bare_module(symbol: str) -> Pattern:
    return Pattern("-" if symbol == "−" else symbol)


def _flattened(parts: Iterable[object]) -> Iterator[Part]:
    for part in parts:
        if isinstance(part, tuple):
            yield from part
        else:
            yield part


def _as_block(part: Block | Instruction) -> Block:
    """The block after "if" or "else", with braces or without."""
    return part if isinstance(part, tuple) else (part,)


def _is_block(part: object) -> bool:
    """Whether a part of a production is a block with its place."""
    return isinstance(part, tuple) and part[:1] in (("before",), ("after",))


@v_args(inline=True)
class _CpfgExpressions(Expressions):
    """C's truths are numbers, and its numbers truths."""

    def binary(self, left: Expression, sign: Token, right: Expression) -> Expression:
        return super().binary(left, sign.update(value=_SPELLINGS.get(sign, str(sign))), right)

    def either(self, condition: Expression, then: Expression, otherwise: Expression) -> Expression:
        return self._applied("if", (condition, then, otherwise), _expression_span(condition, otherwise))

    def call(self, name: Token, *operands: Expression) -> Expression:
        at = name.start_pos or 0, _expression_span(operands[-1])[1]
        made = resolve_call(str(name), operands, at)
        return self._applied(made.operator, made.operands, at)

    def _applied(self, operator: str, operands: tuple[Expression, ...], at: TextSpan) -> Apply:
        return simplified(super()._applied(operator, wanted(operator, operands), at))


@v_args(inline=True)
class CpfgStatements(_CpfgExpressions, Statements):
    """What `grammar.lark` names."""

    def module(self, symbol: Token, *arguments: Expression) -> Pattern:
        return super().module(symbol, *map(as_number, arguments))

    def row(self, token: Token) -> tuple[Pattern, ...]:
        """Symbols without values; brackets know their places, in case one is not closed."""
        found: list[Pattern] = []
        at = token.start_pos or 0
        for piece in re.split(r"([\[\]])", token):
            bracket = piece in ("[", "]")
            found += [Pattern(piece, at=(at, at + 1))] if bracket else map(_bare_module, SYMBOL_PATTERN.findall(piece))
            at += len(piece)
        return tuple(found)

    def word(self, *parts: Pattern | tuple[Pattern, ...]) -> tuple[Pattern, ...]:
        return tuple(_flattened(parts))

    def predecessor(self, *parts: Pattern | tuple[Pattern, ...]) -> tuple[str, tuple[Pattern, ...]]:
        return super().predecessor(*_flattened(parts))

    def constant(self, name: Token, value: Expression, *rest: Expression | Token) -> tuple[str, Constant]:
        return super().constant(name, as_number(value), *rest)

    def setting(self, keyword: Token, value: Expression) -> tuple[str, Expression]:
        return super().setting(keyword, as_number(value))

    def count(self, keyword: Token, value: Expression) -> Statement:
        return "deferred", ("count", (" ".join(keyword.rstrip(": \t").lower().split()), as_number(value)))

    def view_surface(self, token: Token) -> Statement:
        """A line of a view file: a symbol, a file, and how large it is."""
        words = token.split(":", 1)[1].split()
        if len(words) < 2:
            raise problem("surface without file", place_of(token))
        return "deferred", ("view surface", (words[0], words[1]))

    def mark(self, *_: Token) -> Statement:
        return "deferred", ("mark", None)

    def section(self, keyword: Token) -> Statement:
        name = keyword.split()[0].rstrip(":").lower()
        return "deferred", ("section", _SECTION_NAMES.get(name, name))

    def symbols(self, keyword: Token, *names: Token) -> Statement:
        """Brackets are symbols like others; one without the other is refused."""
        others = [name for name in names if name not in "[]"]
        both = {"[", "]"} <= set(names) and (others or keyword.lower().startswith("ignore"))
        kind, symbols = super().symbols(keyword, *(others if both else names))
        return "deferred", ("passed", (kind, symbols, len(others) < len(names)))

    def condition(self, expression: Expression) -> Statement:
        """A number other than 0 is a condition that always holds."""
        always = isinstance(expression, Number) and expression.value != 0
        return "condition", None if always else as_truth(expression)

    def pattern(self, *parts: Pattern | Token | tuple[Pattern, ...]) -> tuple[Pattern, ...]:
        """A right context, in which a branch ends at its bracket unless "=" is written there."""
        found: list[Pattern] = []
        modules = tuple(_flattened(parts))
        for index, module in enumerate(modules):
            if isinstance(module, Token):
                if index + 1 == len(modules) or str(modules[index + 1]) != "]":
                    raise problem("misplaced equals", place_of(module))
                continue
            if module.symbol == "]" and not isinstance(modules[index - 1], Token):
                found.append(Pattern(END))
            found.append(module)
        return tuple(found)

    def before(self, block: Block) -> tuple[str, Block]:
        return "before", block

    def after(self, block: Block) -> tuple[str, Block]:
        return "after", block

    def block(self, *instructions: Part) -> Block:
        return tuple(instruction for instruction in instructions if instruction != ())

    def phase(self, keyword: Token, *instructions: Instruction | tuple[()]) -> Statement:
        return "deferred", ("phase", ("".join(keyword.rstrip(": \t").lower().split()), self.block(*instructions)))

    def procedure(self, name: Token, *values: Expression | Token) -> Assignment | tuple[()]:
        """A call for its own sake: what only prints or plays is left out, and what starts chance anew is an assignment."""
        if name == SEED and len(values) == 1 and not isinstance(values[0], Token):
            return Assignment(self.name(name), as_number(values[0]))
        if name in SILENT:
            return ()
        raise problem("unknown procedure", place_of(name), name=name)

    def assignment(self, name: Token, _: Token, value: Expression) -> Assignment:
        return Assignment(self.name(name), as_number(value))

    def choice(self, condition: Expression, then: Block | Instruction, otherwise: Block | Instruction = ()) -> Choice:
        choice = Choice(as_truth(condition), _as_block(then), _as_block(otherwise))
        if choice.depth > current().depth:
            raise problem("choices too deep", _expression_span(condition), most=current().depth)
        return choice

    def production(self, *parts: Part) -> Statement:
        blocks = dict(filter(_is_block, parts))
        _, production = super().production(*(part for part in parts if not _is_block(part)))
        return "deferred", ("rule", (production, blocks.get("before", ()), blocks.get("after", ())))
