"""What the expressions of `grammar.lark` name, as records: functions, angles in degrees, random numbers."""

from __future__ import annotations

from typing import Any

from lark import Token, v_args

from lsys_kit.errors import ModelNameError, ModelSyntaxError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.dialects.mathematica.expressions import (
    ANGLES,
    DISTRIBUTIONS,
    FUNCTIONS,
    INSTEAD,
    INVERSES,
    TESTS,
    spelling_hint,
)
from lsys_kit.notation.model.expressions import Expression, Number
from lsys_kit.notation.syntax.actions import ActionError, Expressions, check_arity, place_of


@v_args(inline=True)
class MathematicaExpressions(Expressions):
    """What expressions name in Mathematica alone."""

    def number(self, token: Token) -> Number:
        return super().number(token.update(value=token.replace("*^", "e")))

    def call(self, name: Token, *operands: Expression) -> Expression:
        if name in TESTS:
            return self._test(name, operands)
        if name not in FUNCTIONS:
            raise ActionError(
                ModelNameError,
                f'I do not know the function "{name}"',
                place_of(name),
                INSTEAD.get(name)
                or spelling_hint(name)
                or f"Functions are: {', '.join(sorted((*FUNCTIONS, *TESTS, *ANGLES)))}.",
            )
        return self._of(name, FUNCTIONS[name], operands)

    def _test(self, name: Token, operands: tuple[Expression, ...]) -> Expression:
        check_arity(name, "abs", operands)
        modulo, relation, value = TESTS[name]
        at = place_of(name, *operands)
        tested = self._applied(modulo, (*operands, Number(2)), at) if modulo else operands[0]
        return self._applied(relation, (tested, Number(value)), at)

    def _of(self, name: Token, operator: str, operands: tuple[Expression, ...]) -> Expression:
        check_arity(name, operator, operands)
        return self._applied(operator, operands, place_of(name, *operands))

    def chain(self, left: Expression, relation: Token, right: Expression, *rest: Any) -> Expression:
        whole = self.binary(left, relation, right)
        for sign, further in zip(rest[::2], rest[1::2], strict=True):
            whole = self._applied("&&", (whole, self.binary(right, sign, further)), place_of(whole, further))
            right = further
        return whole

    def degrees(self, name: Token, angle: Expression, *sign: Token) -> Expression:
        times, degree = (*sign, None)[0], sign[-1]
        if len(sign) == 2 and times not in ("*", "·", "×"):
            raise ActionError(
                ModelSyntaxError, "An angle is so many times Degree", place_of(times, degree), f'Type "{name}[x Degree]".'
            )
        return self._of(name, ANGLES[name], (angle,))

    def radians(self, name: Token, angle: Expression) -> Expression:
        raise ActionError(
            ModelSyntaxError,
            f"{name}[...] without Degree takes an angle in radians",
            place_of(name, angle),
            f'Angles are in degrees here: type "{name}[x Degree]".',
        )

    def inverse(self, name: Token, value: Expression, over: Token, degree: Token) -> Expression:
        if over != "/":
            raise ActionError(
                ModelSyntaxError,
                f"{name}[...] is an angle in radians",
                place_of(name, degree),
                f'Angles are in degrees here: type "{name}[x]/Degree".',
            )
        return self._of(name, INVERSES[name], (value,))

    def uniform(self, name: Token, *ends: Expression) -> Expression:
        return self._applied("uniform", ends, place_of(name, *ends))

    def drawn(self, _: Token, distribution: Token, *operands: Expression) -> Expression:
        if distribution not in DISTRIBUTIONS:
            raise ActionError(
                ModelNameError,
                f'I do not know the distribution "{distribution}"',
                place_of(distribution),
                suggestion(distribution, DISTRIBUTIONS) or f"Distributions are: {', '.join(DISTRIBUTIONS)}.",
            )
        return self._of(distribution, DISTRIBUTIONS[distribution], operands)

    def numbers(self, *values: Expression) -> tuple[Expression, ...]:
        return values

    def table(self, name: Token, weights: tuple[Expression, ...], _: Token, values: tuple[Expression, ...]) -> Expression:
        if [value.value if isinstance(value, Number) else None for value in values] != list(range(len(weights))):
            raise ActionError(
                ModelSyntaxError,
                "The weights are those of 0, 1, 2, ...",
                place_of(*values),
                'Type as many numbers as weights, as in "RandomChoice[{1, 2, 1} -> {0, 1, 2}]".',
            )
        return self._of(name, "table", weights)
