"""What the grammar of Fractint's L-systems names, as records."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any

from lark import Token, Transformer, v_args

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.model.arithmetic import normalised
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.syntax.actions import ActionError

RESERVED = frozenset("+-/\\@|!C<>[]")
"""The commands that no rule may rewrite; `F`, `G`, `D` and `M` may be rewritten."""
_COMMAND = re.compile(r"(.)([QI]*+)(.*)", re.IGNORECASE)
LONGEST = 100
"""So many digits a number may have."""
LEAST, MOST = 1, 360
"""The parts that a full turn may have."""


@v_args(inline=True)
class Records(Transformer[Any, Any]):
    """What `grammar.lark` names: letters are capitals, whatever was typed."""

    def symbol(self, token: Token) -> Pattern:
        return Pattern(token.upper(), at=_at(token))

    def command(self, token: Token) -> Pattern:
        sign, inverse_or_root, digits = _COMMAND.fullmatch(token).groups()  # type: ignore[union-attr]
        return Pattern((sign + inverse_or_root).upper(), (_number(token, digits),) if digits else (), _at(token))

    def word(self, *modules: Pattern) -> tuple[Pattern, ...]:
        return modules

    def angle(self, _: Token, count: Token) -> tuple[str, Any]:
        """Fractint passes over what stands behind the point."""
        whole = count.split(".")[0]
        if len(whole) > len(str(MOST)) or not LEAST <= int(whole) <= MOST:
            raise ActionError(
                ModelSyntaxError,
                f"A full turn cannot have {whole[:10]} parts here",
                _at(count),
                f'"Angle n" makes + and - turn by 360/n degrees, with n from {LEAST} to {MOST}.',
            )
        return "deferred", ("angle", Number(normalised(Fraction(360, int(whole))), _at(count)))

    def steps(self, _: Token, count: Token) -> tuple[str, Number]:
        return "steps", Number(int(count), _at(count))

    def axiom(self, _: Token, word: tuple[Pattern, ...]) -> tuple[str, Any]:
        return "deferred", ("axiom", word)

    def production(self, predecessor: Token, word: tuple[Pattern, ...]) -> tuple[str, Any]:
        symbol = predecessor[0].upper()
        at = predecessor.start_pos, (predecessor.start_pos or 0) + 1
        if "=" not in predecessor and re.match("--?>", "".join(module.symbol for module in word[:3])):
            raise ActionError(ModelSyntaxError, "Fractint has no arrows", word[0].at, f'Type "{predecessor[0]}=...".')
        if symbol in RESERVED:
            raise ActionError(
                ModelSyntaxError,
                f'"{predecessor[0]}" is a command, which a rule cannot rewrite',
                at,  # type: ignore[arg-type]
                "Choose another letter for the predecessor.",
            )
        return "deferred", ("rule", Production((Pattern(symbol, at=at),), word))  # type: ignore[arg-type]

    def erasing(self, predecessor: Token) -> tuple[str, Any]:
        if "=" not in predecessor:
            raise ActionError(
                ModelSyntaxError,
                "This rule has no successor",
                _at(predecessor),
                f'To erase {predecessor[0]}, write "{predecessor[0]}=".',
            )
        return self.production(predecessor, ())


def _at(token: Token) -> tuple[int, int]:
    return token.start_pos, token.end_pos  # type: ignore[return-value]


def _number(token: Token, digits: str) -> Number:
    if not re.fullmatch(r"\d++\.?\d*+|\.\d++", digits) or len(digits) > LONGEST:
        raise ActionError(
            ModelSyntaxError,
            "A command cannot take this number",
            _at(token),
            'A command takes digits with at most one point, as in "@.5" or "\\30".',
        )
    return Number(normalised(Fraction(f"0{digits}" if digits[0] == "." else digits.rstrip("."))), _at(token))
