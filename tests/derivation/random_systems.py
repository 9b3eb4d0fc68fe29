"""Random systems for laws: symbols of one letter and of several, parameters, conditions, constants, brackets, erasing.

Nearly everything that is drawn can happen: parameters start near the numbers that conditions ask for, and change by one.
"""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from lsys_kit.notation.arithmetic import Value, tidy
from lsys_kit.notation.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model import Constant, LSystem, Module, Production

SYMBOLS = ("A", "B", "al", "u_1")
"""Symbols that productions rewrite; each has as many parameters as `ARITY` says."""
ARITY = {"A": 1, "B": 0, "al": 2, "u_1": 1}
INERT = ("F", "+", "-")
CONSTANTS = ("k", "lifeTime")
RELATIONS = ("==", "!=", "<", "<=", ">", ">=")

numbers: st.SearchStrategy[Value] = st.one_of(
    st.integers(0, 3), st.sampled_from((Fraction(1, 2), Fraction(7, 10), Fraction(-1), Fraction(1, 4)))).map(tidy)


@st.composite
def expressions(draw: st.DrawFn, names: tuple[str, ...], depth: int = 2) -> Expression:
    """A number that stays small: sums and differences, products with small numbers."""
    deep = ("sum", "sum", "scaled", "choice", "unary") if depth else ()
    kind = draw(st.sampled_from(("name", "name", "number", *deep)))
    if kind == "name" and names:
        return Name(draw(st.sampled_from(names)))
    if kind == "sum":
        operands = draw(expressions(names, depth - 1)), draw(expressions(names, depth - 1))
        return Apply(draw(st.sampled_from("+-")), operands)
    if kind == "scaled":
        scale = Number(draw(st.sampled_from((1, 2, Fraction(1, 2)))))
        return Apply(draw(st.sampled_from("*/")), (draw(expressions(names, depth - 1)), scale))
    if kind == "choice":
        return Apply(draw(st.sampled_from(("min", "max"))), (draw(expressions(names, depth - 1)), Number(draw(numbers))))
    if kind == "unary":
        operand = draw(expressions(names, depth - 1))
        operator = draw(st.sampled_from(("abs", "floor", "ceil", "-x")))
        return Number(-operand.value) if operator == "-x" and isinstance(operand, Number) else Apply(operator, (operand,))
    return Number(draw(numbers))


@st.composite
def conditions(draw: st.DrawFn, names: tuple[str, ...], depth: int = 1) -> Expression:
    kind = draw(st.sampled_from(("relation", "relation", "relation", "both", "not") if depth else ("relation",)))
    if kind == "both":
        return Apply(draw(st.sampled_from(("&&", "||"))), (draw(conditions(names, 0)), draw(conditions(names, 0))))
    if kind == "not":
        return Apply("!", (draw(conditions(names, 0)),))
    left = Name(draw(st.sampled_from(names))) if names else Number(draw(numbers))
    return Apply(draw(st.sampled_from(RELATIONS)), (left, draw(expressions(names, 1))))


@st.composite
def modules(draw: st.DrawFn, names: tuple[str, ...], aged: bool = True) -> Module:
    """A module of any symbol; often a parameter grows by one, as ages do."""
    symbol = draw(st.sampled_from((*SYMBOLS, *SYMBOLS, *INERT)))
    arity = ARITY.get(symbol, 0)
    if arity and draw(st.integers(0, 15)) == 0:
        arity -= 1  # no production rewrites it
    older = st.sampled_from(names).map(lambda name: Apply("+", (Name(name), Number(1)))) if names and aged else st.nothing()
    return Module(symbol, tuple(draw(st.lists(older | expressions(names) | older, min_size=arity, max_size=arity))))


@st.composite
def successors(draw: st.DrawFn, names: tuple[str, ...], least: int = 0) -> tuple[Module, ...]:
    """Up to three modules, perhaps some of them on a branch."""
    word = draw(st.lists(modules(names), min_size=least, max_size=3))
    if word and draw(st.booleans()):
        start, end = sorted((draw(st.integers(0, len(word))), draw(st.integers(0, len(word)))))
        word[start:end] = [Module("["), *word[start:end], Module("]")]
    return tuple(word)


@st.composite
def productions(draw: st.DrawFn, constants: tuple[str, ...]) -> Production:
    symbol = draw(st.sampled_from((*SYMBOLS, "A", "al")))
    formal: list[Expression] = []
    for name in ("t", "x")[:ARITY[symbol]]:
        asked = st.one_of(numbers.map(Number), *([st.sampled_from(constants).map(Name)] if constants else []))
        formal.append(draw(asked) if draw(st.integers(0, 4)) == 0 else Name(name))
    parameters = tuple(e.name for e in formal if isinstance(e, Name) and e.name not in constants)
    names = (*parameters, *constants)
    condition = draw(conditions(names)) if parameters and draw(st.integers(0, 3)) else None
    return Production(Module(symbol, tuple(formal)), draw(successors(names)), condition)


@st.composite
def systems(draw: st.DrawFn) -> LSystem:
    """A context-free parametric system."""
    names = CONSTANTS[:draw(st.integers(0, 2))]
    constants = []
    for index, name in enumerate(names):
        constants.append(Constant(name, draw(st.one_of(numbers.map(Number), expressions(names[:index], 1)))))
    rules = draw(st.lists(productions(names), min_size=2, max_size=7))
    if draw(st.integers(0, 3)):
        rules.sort(key=lambda rule: rule.condition is None)  # as in good models, where what always applies stands last
    started = dict.fromkeys(rule.predecessor.symbol for rule in rules[:2])
    axiom = [Module(symbol, tuple(Number(draw(numbers)) for _ in range(ARITY[symbol]))) for symbol in started]
    return LSystem((*axiom, *draw(successors(names))), tuple(rules), tuple(constants),
                   alphabet=tuple(symbol for symbol in SYMBOLS if len(symbol) > 1))
