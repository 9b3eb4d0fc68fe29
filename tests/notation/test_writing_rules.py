"""What is written reads back as the same system, for every kind of rule."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Item, Pattern, Repeat
from lsys_kit.notation.model.system import BRANCHES, LSystem, MetaRule, Production
from lsys_kit.notation.read import read
from lsys_kit.notation.write import write
from tests.derivation.random_systems import conditions, expressions

RULES = """ignore: + -
axiom: A(5)B
b < a -> b
A(t) < B > C : t < 5 -> B(t + 1)[+A(0)]
B C < S > G[H]M -> x
F -> F[+F]F : 1/3
F -> F(normal(0, 0.5)) : if(1 < 2, 0.5, 1)
a(n) -> repeat(n,i) <F[RU(50)lat(i)]repeat(2) <G>>a(n)
meta: f(x)f(y) : x > 0 -> f(x + y)
decomposition:
M(t) : t > 1 -> M(t - 1)
interpretation:
k -> F"""
SYMBOLS = ("A", "B", "al", "F", "+", "-", "&", "%", "!", ".")
ALPHABET = ("al",)
COUNTS = {"A": 1, "al": 2, "F": 1, "+": 1}
RANDOM = {"uniform": 2, "normal": 2, "binomial": 2, "poisson": 1, "table": 3, "sin": 1, "mod": 2}


def test_every_kind_of_rule_prints_as_it_was_laid_out() -> None:
    assert str(read(RULES)) == RULES
    assert read(str(read(RULES))) == read(RULES)


@st.composite
def drawn(draw: st.DrawFn, names: tuple[str, ...]) -> Expression:
    """A number that may be random."""
    plain = draw(expressions(names, 1))
    if draw(st.booleans()):
        return plain
    function = draw(st.sampled_from(sorted(RANDOM)))
    operands = tuple(draw(expressions(names, 1)) for _ in range(RANDOM[function]))
    return Apply("+", (plain, Apply(function, operands))) if draw(st.booleans()) else Apply(function, operands)


@st.composite
def words(draw: st.DrawFn, names: tuple[str, ...], most: int = 3, chance: bool = True, deep: int = 2) -> tuple[Item, ...]:
    """Modules, some of them on a branch, some of them repeated."""
    word: list[Item] = []
    for _ in range(draw(st.integers(0, most))):
        symbol = draw(st.sampled_from(SYMBOLS))
        value = drawn(names) if chance else expressions(names, 1)
        word.append(Pattern(symbol, tuple(draw(value) for _ in range(COUNTS.get(symbol, 0)))))
    if chance and deep and draw(st.integers(0, 2)) == 0:
        index = draw(st.sampled_from(("", f"i{deep}")))
        inner = draw(words((*names, index) if index else names, most, chance, deep - 1)) or (Pattern("B"),)
        word.append(Repeat(draw(drawn(names) if names else st.integers(0, 5).map(Number)), inner, index))
    if word and draw(st.integers(0, 2)) == 0:
        word[0 : len(word) // 2] = [Pattern("["), *word[0 : len(word) // 2], Pattern("]")]
    return tuple(word)


def counted(items: tuple[Item, ...]) -> bool:
    """Whether no repetition has a count that is written out and impossible."""
    repeats = [item for item in items if isinstance(item, Repeat)]
    written = [item.count.value for item in repeats if isinstance(item.count, Number)]
    return all(value in range(100) for value in written) and all(counted(item.body) for item in repeats)


@st.composite
def rows(draw: st.DrawFn, prefix: str, least: int, most: int) -> tuple[Pattern, ...]:
    """Modules that name parameters, each name its own."""
    row = []
    for place in range(draw(st.integers(least, most))):
        symbol = draw(st.sampled_from(SYMBOLS))
        free = [Name(f"{prefix}{place}{number}") for number in range(COUNTS.get(symbol, 0))]
        row.append(Pattern(symbol, tuple(draw(st.sampled_from((name, name, Number(Fraction(1, 2))))) for name in free)))
    return tuple(row)


def names_of(modules: tuple[Pattern, ...]) -> tuple[str, ...]:
    return tuple(argument.name for module in modules for argument in module.arguments if isinstance(argument, Name))


@st.composite
def rules(draw: st.DrawFn, section: str) -> Production:
    left = draw(rows("l", 0, 2)) if section == "productions" else ()
    (own,) = draw(rows("t", 1, 1))
    right = draw(rows("r", 0, 2)) if section == "productions" else ()
    if right and draw(st.booleans()):
        right = (Pattern("["), *right[:1], Pattern("]"), *right[1:])
    names = names_of((*left, own, *right))
    ends = section == "decomposition"  # without a condition it might lead to itself
    condition = draw(conditions(names)) if ends or draw(st.booleans()) else None
    positive = st.sampled_from((Number(1), Apply("/", (Number(1), Number(3))), Number(Fraction(33, 100))))
    probability = draw(positive) if section != "interpretation" and draw(st.booleans()) else None
    successor = draw(words(names, chance=section != "interpretation").filter(counted))
    return Production((own,), successor, condition, left, right, probability)


@st.composite
def meta_rules(draw: st.DrawFn) -> MetaRule:
    row = draw(rows("m", 2, 3))
    names = names_of(row)
    successor = draw(words(names, 1, chance=False).filter(lambda word: len(word) < len(row)))
    return MetaRule(row, successor, draw(conditions(names)) if draw(st.booleans()) else None)


@st.composite
def systems(draw: st.DrawFn) -> LSystem:
    passed = tuple(draw(st.lists(st.sampled_from(SYMBOLS), unique=True, max_size=3)))
    considers = draw(st.booleans())
    return LSystem(
        draw(words((), chance=False).filter(bool)),
        tuple(draw(st.lists(rules("productions"), max_size=4))),
        interpretation=tuple(draw(st.lists(rules("interpretation"), max_size=1))),
        decomposition=tuple(draw(st.lists(rules("decomposition"), max_size=2))),
        meta=tuple(draw(st.lists(meta_rules(), max_size=2))),
        depth=draw(st.integers(1, 3)),
        alphabet=ALPHABET,
        ignored=() if considers else passed,
        considered=passed if considers else (),
        branches=draw(st.sampled_from(BRANCHES)),
    )


SEEN: Counter[str] = Counter()


@pytest.mark.slow
@settings(max_examples=150)
@given(systems())
def test_what_is_written_is_read_again(system: LSystem) -> None:
    assert read(write(system)) == system
    every = (*system.productions, *system.decomposition)
    SEEN.update(
        {
            "systems": 1,
            "context": any(rule.left or rule.right for rule in every),
            "probability": any(rule.probability is not None for rule in every),
            "repeat": any(isinstance(item, Repeat) for rule in every for item in rule.successor),
            "random": any(name in write(system) for name in ("uniform", "normal", "binomial", "poisson", "table")),
            "meta": bool(system.meta),
            "decomposition": bool(system.decomposition),
            "ignored": bool(system.ignored or system.considered),
        }
    )


def test_the_systems_written_had_everything() -> None:
    if SEEN["systems"]:
        assert {kind for kind, count in SEEN.items() if count < SEEN["systems"] / 10} == set()


@pytest.mark.parametrize(
    ("text", "lacking"),
    [
        ("axiom: A\nA < B -> C", "contexts"),
        ("axiom: A\nA -> B : 0.5", "probabilities"),
        ("ignore: B\naxiom: A", "ignored symbols"),
        ("axiom: A\nA -> repeat(2) <B>", "repetition"),
        ("axiom: A\ndecomposition:\nA -> B", "decomposition rules"),
        ("axiom: A\nmeta: A A -> A", "meta-rules"),
    ],
)
def test_what_a_plant_string_lacks_is_named(text: str, lacking: str) -> None:
    with pytest.raises(ModelValueError, match=f"The notation plant-string has no {lacking}, which this system needs"):
        write(read(text), "plant-string")
