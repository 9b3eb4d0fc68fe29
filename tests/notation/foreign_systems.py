"""Random systems with every symbol, number and name that any reader takes, and texts that are nearly models.

Everything is drawn from a `Random`: that of hypothesis in a law, one with a seed in a long run (`tests.fuzzing.writers`).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import fields
from fractions import Fraction
from random import Random

from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import END, Item, Pattern, Repeat
from lsys_kit.notation.model.system import Constant, LSystem, MetaRule, Production
from lsys_kit.notation.read import read_expression


def _split(*lines: str) -> list[str]:
    return [part for line in lines for part in line.split()]


LETTERS = [*"ABFfXaIGCQDeElRZ_"]
SIGNS = [*"+-&^\\/|{}$!'#~;.%@*,<>:=\"`?"]
"""Round and square brackets come in pairs."""
NAMED = _split(
    "al B_r F_l F_A _x u1' u1 ul a'' L* L+ Ll* N* a* a+ a- RU RH F0 RU45 x1 e5 n d p1 p_1 AB FF FA P V Degree by in",
    "axiom Axiom AXIOM LEFT lrule null Null Startwort angle Angle steps turtle depth alphabet ignore number stage",
    "productions decomposition interpretation homomorphism endlsystem Lsystem repeat uniform define vec quad omega",
    "abop ellipses meta set var Show Print",
)
"""Names, those among them that mean something in some notation."""
SPECIAL = _split("@o @G @T @Ts @b @I @Q @IQ @bc ?P ?E ?x1 \\I /Q <IQ")
ODD = [*"éß日αδωΩ→⟶−–×·°≤∧’…\u00a0\ufeff\u2028\u20d7\x00\x1c\x7f\U0001d400"]
SYMBOLS: Sequence[Sequence[str]] = (LETTERS, LETTERS, LETTERS, SIGNS, SIGNS, NAMED, SPECIAL, [*"0123456789"], ODD)
PARAMETERS = _split(
    "t x i n d e E5 e5 I N F A a_ _a dt x0 f0 i0 in by pi max sin mod ran nran index length seed turtle steps and",
    "or not else define axiom1 growth lrules lsystem skipPattern Degree Sqrt repeat uniform var",
)
NUMBERS = [*map(Fraction, _split("0 1 2 10 45 360 0.5 0.7 25.7 0.01 0.0009765625"))]
LENGTHS = (1, 5, 12, 20, 41, 99, 100, 101, 200, 300, 308, 400, 900)
"""How many digits a number may have."""
EXPONENTS = ("", "", "e1", "e-20", "e-99", "e-300", "e-500", "e-999", "e300")
CALCULATED, COMPARED = ("+", "-", "*", "/", "^"), ("==", "!=", "<", "<=", ">", ">=")
FUNCTIONS = sorted(name for name, operator in OPERATORS.items() if operator.precedence is None and name != "sensed")
LOOKS = {"cells": ("rectangles", "ellipses"), "widths": ("pixels", "units"), "colours": ("natural", "symbols")}
ANGLES = (60, -45, Fraction(257, 10), Fraction(1, 3), 2**0.5, 1e-7, 10**20, Fraction(1, 7**50), Fraction(1, 10**400))


def record(system: LSystem) -> dict[str, object]:
    """All that a text says of a system: its attributes but for those that say how a text is read, and which text it was."""
    of_reading = "alphabet", "notation", "source", "notes"
    return {part.name: getattr(system, part.name) for part in fields(system) if part.name not in of_reading}


class Systems:
    """Random systems, drawn from a source of random numbers."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.constants: list[str] = []
        self.symbols_of = SYMBOLS[: random.choice((1, 5, len(SYMBOLS)))]  # fewer kinds are possible in more notations

    def chance(self, percent: int) -> bool:
        return self.random.randrange(100) < percent

    def symbol(self) -> str:
        return self.random.choice(self.random.choice(self.symbols_of))

    def number(self) -> Number:
        """A number of any size that can be read."""
        if self.chance(70):
            value = self.random.choice(NUMBERS)
            return Number(value.numerator if value.denominator == 1 else value)
        digits = "".join(self.random.choice("0123456789") for _ in range(self.random.choice(LENGTHS)))
        point = self.random.randrange(len(digits))
        sign, exponent = self.random.choice(("", "-")), self.random.choice(EXPONENTS)
        with suppress(LSystemError):  # too long, or too large
            number = read_expression(f"{sign}{digits[:point] or 0}.{digits[point:]}{exponent}")
            assert isinstance(number, Number)
            return number
        return Number(3)

    def expression(self, names: Sequence[str], chance: bool = False, deep: int = 2) -> Expression:
        if deep == 0 or self.chance(60):
            return Name(self.random.choice(names)) if names and self.chance(60) else self.number()
        if self.chance(60):
            left, right = (self.expression(names, chance, deep - 1) for _ in range(2))
            return Apply(self.random.choice(CALCULATED), (left, right))
        if self.chance(30):
            operand = self.expression(names, chance, deep - 1)
            return Number(-operand.value) if isinstance(operand, Number) else Apply("-x", (operand,))
        operator = self.random.choice(FUNCTIONS)
        operator = "max" if OPERATORS[operator].random and not chance else operator
        least, most = OPERATORS[operator].arity
        wanted = map(OPERATORS[operator].wanted, range(self.random.choice((least, least, min(most, least + 1)))))
        return Apply(
            operator,
            tuple(self.condition(names, 0) if kind == "truth" else self.expression(names, chance, deep - 1) for kind in wanted),
        )

    def condition(self, names: Sequence[str], deep: int = 2) -> Expression:
        if deep == 0 or self.chance(50):
            return Apply(self.random.choice(COMPARED), (self.expression(names, deep=1), self.expression(names, deep=1)))
        if self.chance(20):
            return Apply("!", (self.condition(names, deep - 1),))
        return Apply(self.random.choice(("&&", "||")), (self.condition(names, deep - 1), self.condition(names, deep - 1)))

    def word(self, names: Sequence[str], chance: bool = False, most: int = 6, repeats: int = 1) -> tuple[Item, ...]:
        """Modules, some of them on branches, some of them repeated."""
        found: list[Item] = []
        for _ in range(self.random.randrange(most + 1)):
            kind = self.random.randrange(100)
            if kind < 14:
                opening, closing = "[]" if kind else "()"
                found += (Pattern(opening), *self.word(names, chance, 2, 0), Pattern(closing))
            elif kind < 18 and repeats:
                index = self.random.choice(("", *{"j", "k0", "index"}.difference(names)))
                body = self.word([*names, index] if index else names, chance, 2, repeats - 1) or (Pattern("A"),)
                found.append(Repeat(Number(self.random.randrange(9)), body, index))
            else:
                values = self.random.choice((0, 0, 0, 0, 1, 2)) * (len(self.symbols_of) > 1)
                found.append(Pattern(self.symbol(), tuple(self.expression(names, chance) for _ in range(values))))
        return tuple(found)

    def row(self, pool: list[str], least: int, most: int) -> list[Pattern]:
        """Modules before an arrow, whose parameters are taken from a pool."""
        return [
            Pattern(
                self.symbol(),
                tuple(
                    Name(pool.pop()) if self.chance(80) else self.expression(self.constants, deep=1)
                    for _ in range(self.random.choice((0, 0, 0, 1, 2)))
                ),
            )
            for _ in range(self.random.randint(least, most))
        ]

    def production(self, section: str = "productions") -> Production:
        pool = [name for name in self.random.sample(PARAMETERS, 14) if name not in self.constants]
        around = section == "productions" and self.chance(30)
        several = 1 + (section == "productions" and self.chance(10))
        left, own, right = self.row(pool, 0, 2 * around), self.row(pool, 1, several), self.row(pool, 0, 2 * around)
        parameters = [
            argument.name for module in (*left, *own, *right) for argument in module.arguments if isinstance(argument, Name)
        ]
        names = list(dict.fromkeys((*parameters, *self.constants)))
        if right and self.chance(30):
            ends = [Pattern(END)] * self.chance(50)
            right = [Pattern("["), *right[:1], *ends, Pattern("]"), *right[1:]]
        weight = self.random.choice((Number(1), Number(Fraction(33, 100)), Apply("/", (Number(1), Number(3)))))
        condition = self.condition(names) if self.chance(30) else None
        return Production(
            tuple(own),
            self.word(names, section != "interpretation"),
            condition,
            tuple(left),
            tuple(right),
            weight if section != "interpretation" and self.chance(20) else None,
        )

    def constant(self, name: str) -> Constant:
        if self.chance(70):
            return Constant(name, self.number())
        return Constant(
            name,
            Number(Fraction(1, 2)),
            (Number(-1), self.random.choice((Number(1), Apply("*", (Number(2), Number(3))))), Number(Fraction(1, 10))),
        )

    def symbols(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(self.symbol() for _ in range(self.random.randrange(1, 4))))

    def system(self) -> LSystem:
        """A system; a simple one as often as one with everything."""
        random, rich = self.random, self.chance(50)
        found = [self.constant(name) for name in random.sample(PARAMETERS, random.randrange(3) * rich)]
        self.constants = [constant.name for constant in found]
        settings = {
            "angle": random.choice((90, *ANGLES)),
            "heading": random.choice((90, 0, *ANGLES)),
            "length": random.choice((None, 1, 100, Fraction(1, 3), 5e-300)),
            "steps": random.choice((0, 3, 10**7, 10**30)),
            "seed": random.choice((3, -2, 10**25)),
            "depth": random.choice((0, 2)),
            "decomposition_depth": random.choice((0, 2)),
            "ignored": self.symbols(),
            "turtle": random.choice(("abop", "grogra", "plant-string", "fractint")),
        }
        chosen = {name: value for name, value in settings.items() if self.chance(15)}
        sections = {name: (self.production(name),) for name in ("decomposition", "interpretation") if rich and self.chance(15)}
        if sections.get("decomposition"):
            chosen["decomposition_depth"] = 3  # which may lead to itself
        if "ignored" not in chosen and self.chance(10):
            chosen["considered"] = self.symbols()
        if rich and self.chance(10):
            chosen["meta"] = (MetaRule((Pattern("A"), Pattern(self.symbol())), (Pattern(self.symbol()),)),)
        chosen |= {name: self.random.choice(said) for name, said in LOOKS.items() if self.chance(10)}
        if not rich and self.chance(20):  # as Fractint's systems are
            chosen = {"turtle": "fractint", "heading": 0, "angle": 60}
        axiom = self.word(self.constants, repeats=0) or (Pattern(self.symbol()),)
        return LSystem(
            axiom,
            tuple(self.production() for _ in range(random.randrange(4))),  # type: ignore[arg-type]
            tuple(found),
            **sections,
            **chosen,
        )  # type: ignore[arg-type]


PIECES = (
    *LETTERS,
    *SIGNS,
    *NAMED,
    *SPECIAL,
    *ODD,
    *"0123456789[]()<>\n ",
    "->",
    "-->",
    "//",
    "/* x */",
    "4444444444",
    "1e-400",
    "1e300",
    f"0.{'3' * 400}",
)


def mutated(random: Random, text: str, other: str) -> str:
    """A text in which a few characters were lost, put in, or taken from elsewhere, perhaps from another text."""
    for _ in range(random.choice((1, 1, 1, 2, 3))):
        start = random.randrange(len(text) + 1)
        end = start + random.choice((0, 0, 1, 1, 2, 5))
        source = random.choice((text, other))
        taken = random.randrange(len(source) + 1)
        piece = random.choice(("", source[taken : taken + random.randrange(12)], *[random.choice(PIECES)] * 5))
        text = text[:start] + piece + text[end:]
    return text
