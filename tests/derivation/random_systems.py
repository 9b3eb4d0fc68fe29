"""Random systems for laws: symbols of one letter and of several, parameters, conditions, constants, brackets, erasing.

Nearly everything that is drawn can happen: parameters start near the numbers that conditions ask for, and change by one.
`systems` are context-free; `systems_with` have the other kinds of rules, one kind or several at once.
"""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from itertools import chain

from hypothesis import strategies as st

from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Item, Pattern, Repeat
from lsys_kit.notation.model.system import ANY_BRANCH, BRANCHES, Constant, LSystem, MetaRule, Production

SYMBOLS = ("A", "B", "al", "u_1")
"""Symbols that productions rewrite; each has as many parameters as `ARITY` says."""
ARITY = {"A": 1, "B": 0, "al": 2, "u_1": 1}
INERT = ("F", "+", "-")
CONSTANTS = ("k", "lifeTime")
RELATIONS = ("==", "!=", "<", "<=", ">", ">=")

numbers: st.SearchStrategy[Value] = st.one_of(
    st.integers(0, 3), st.sampled_from((Fraction(1, 2), Fraction(7, 10), Fraction(-1), Fraction(1, 4)))
).map(normalised)


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
    right = st.integers(0, 3).map(Number) | expressions(names, 1)
    return Apply(draw(st.sampled_from(RELATIONS)), (left, draw(right)))


@st.composite
def modules(draw: st.DrawFn, names: tuple[str, ...], aged: bool = True) -> Pattern:
    """A module of any symbol; often a parameter grows by one, as ages do."""
    symbol = draw(st.sampled_from((*SYMBOLS, *SYMBOLS, *INERT)))
    arity = ARITY.get(symbol, 0)
    if arity and draw(st.integers(0, 15)) == 0:
        arity -= 1  # no production rewrites it
    older = st.sampled_from(names).map(lambda name: Apply("+", (Name(name), Number(1)))) if names and aged else st.nothing()
    return Pattern(symbol, tuple(draw(st.lists(older | expressions(names) | older, min_size=arity, max_size=arity))))


@st.composite
def successors(draw: st.DrawFn, names: tuple[str, ...], least: int = 0) -> tuple[Pattern, ...]:
    """Up to three modules, perhaps some of them on a branch."""
    word = draw(st.lists(modules(names), min_size=least, max_size=3))
    if word and draw(st.booleans()):
        start, end = sorted((draw(st.integers(0, len(word))), draw(st.integers(0, len(word)))))
        word[start:end] = [Pattern("["), *word[start:end], Pattern("]")]
    return tuple(word)


@st.composite
def productions(draw: st.DrawFn, constants: tuple[str, ...]) -> Production:
    symbol = draw(st.sampled_from((*SYMBOLS, "A", "al")))
    formal: list[Expression] = []
    for name in ("t", "x")[: ARITY[symbol]]:
        asked = st.one_of(st.integers(0, 2).map(Number), *([st.sampled_from(constants).map(Name)] if constants else []))
        formal.append(draw(asked) if draw(st.integers(0, 3)) == 0 else Name(name))
    parameters = tuple(e.name for e in formal if isinstance(e, Name) and e.name not in constants)
    names = (*parameters, *constants)
    condition = draw(conditions(names)) if parameters and draw(st.integers(0, 3)) else None
    return Production((Pattern(symbol, tuple(formal)),), draw(successors(names)), condition)


@st.composite
def instances(draw: st.DrawFn, formal: Pattern, constants: tuple[str, ...] = ()) -> Pattern:
    """A module as a pattern says: its parameters have some values, what it asks for is there."""
    return Pattern(
        formal.symbol,
        tuple(
            Number(draw(numbers)) if isinstance(argument, Name) and argument.name not in constants else argument
            for argument in formal.arguments
        ),
    )


@st.composite
def systems(draw: st.DrawFn) -> LSystem:
    """A context-free parametric system."""
    names = CONSTANTS[: draw(st.integers(0, 2))]
    constants = []
    for index, name in enumerate(names):
        constants.append(Constant(name, draw(st.one_of(numbers.map(Number), expressions(names[:index], 1)))))
    rules = draw(st.lists(productions(names), min_size=2, max_size=7))
    if draw(st.integers(0, 3)):
        rules.sort(key=lambda rule: rule.condition is None)  # as in good models, where what always applies stands last
    axiom = [draw(instances(rule.predecessor, names)) for rule in rules[:2]]
    return LSystem(
        (*axiom, *draw(successors(names))),
        tuple(rules),
        tuple(constants),
        alphabet=tuple(symbol for symbol in SYMBOLS if len(symbol) > 1),
    )


CONTEXT, CHANCE, DECOMPOSITION, CUT, REPETITION, META, SEVERAL = KINDS = (
    "context",
    "chance",
    "decomposition",
    "cut",
    "repetition",
    "meta",
    "several",
)
ARITIES = {"A": 0, "B": 0, "S": 1, "F": 0, "+": 0, "f": 1, "%": 0, "D": 1, "E": 0}
LIVELY = ("A", "B", "S")
WEIGHTS: tuple[Expression, ...] = (*map(Number, (1, 2, Fraction(1, 2), Fraction(33, 100))), Apply("/", (Number(1), Number(3))))
OPEN, CLOSE = Pattern("["), Pattern("]")


@st.composite
def arguments(draw: st.DrawFn, names: tuple[str, ...], kinds: Collection[str]) -> Expression:
    """What stands in a module: an age that grows, a small number, perhaps one drawn by chance."""
    if CHANCE in kinds and draw(st.integers(0, 2)) == 0:
        return draw(
            st.sampled_from(
                (
                    Apply("uniform", (Number(0), Number(3))),
                    Apply("normal", (Number(1), Number(Fraction(1, 2)))),
                    Apply("binomial", (Number(3), Number(Fraction(1, 2)))),
                    Apply("poisson", (Number(1),)),
                    Apply("table", (Number(1), Number(2), Number(1))),
                    Apply("+", (Apply("uniform", (Number(0), Number(1))), Apply("uniform", (Number(-1), Number(1))))),
                )
            )
        )
    if names and draw(st.integers(0, 2)):
        name = Name(draw(st.sampled_from(names)))
        return draw(st.sampled_from((name, Apply("+", (name, Number(1))), Apply("-", (name, Number(1))))))
    return Number(draw(st.integers(0, 3)))


@st.composite
def lively(draw: st.DrawFn, names: tuple[str, ...], kinds: Collection[str], more: tuple[str, ...] = ()) -> Pattern:
    rare = tuple(
        symbol
        for kind, symbol in ((CUT, "%"), (DECOMPOSITION, "D"), (DECOMPOSITION, "E"), (META, "f"), (META, "f"))
        if kind in kinds
    )
    symbol = draw(st.sampled_from((*LIVELY, *LIVELY, "F", "+", *rare, *more)))
    return Pattern(symbol, tuple(draw(arguments(names, kinds)) for _ in range(ARITIES[symbol])))


@st.composite
def items(draw: st.DrawFn, names: tuple[str, ...], kinds: Collection[str], least: int = 0, most: int = 2) -> tuple[Item, ...]:
    """A part of a word, perhaps with a branch in it, perhaps with a part written several times."""
    word: list[Item] = list(draw(st.lists(lively(names, kinds), min_size=least, max_size=most)))
    if word and CUT in kinds and draw(st.booleans()):
        word.insert(draw(st.integers(0, len(word))), Pattern("%"))
    if word and draw(st.integers(0, 2)) == 0:
        start, end = sorted((draw(st.integers(0, len(word))), draw(st.integers(0, len(word)))))
        word[start:end] = [OPEN, *word[start:end], CLOSE]
    if REPETITION in kinds and draw(st.booleans()):
        word.insert(draw(st.sampled_from((0, len(word)))), draw(repeats(names, kinds)))
    return tuple(word)


@st.composite
def repeats(draw: st.DrawFn, names: tuple[str, ...], kinds: Collection[str], depth: int = 1) -> Repeat:
    count: Expression = Number(draw(st.integers(0, 2)))
    if names and draw(st.booleans()):
        whole = Apply("floor", (Name(draw(st.sampled_from(names))),))
        count = Apply("min", (Apply("max", (whole, Number(0))), Number(2)))
    index = draw(st.sampled_from(("", "i" if depth else "j")))
    known = (*names, index) if index else names
    body: list[Item] = [draw(lively(known, kinds, ("S",)))]
    if depth and draw(st.integers(0, 3)) == 0:
        body.append(draw(repeats(known, kinds, 0)))
    return Repeat(count, tuple(body) if draw(st.booleans()) else (OPEN, *body, CLOSE), index)


@st.composite
def patterns(draw: st.DrawFn, names: str, branches: bool) -> tuple[Pattern, ...]:
    """Up to two neighbours, of which values may be asked for; to the right some of them may stand on branches."""
    word = []
    named = branches and draw(st.integers(0, 2)) == 0
    for name in names[: draw(st.sampled_from((1, 1, 2)))]:
        symbol = draw(st.sampled_from((*LIVELY, *LIVELY, "F", "+")))
        asked = Number(draw(st.integers(0, 2))) if not named and draw(st.integers(0, 7)) == 0 else Name(name)
        word.append(Pattern(symbol, (asked,) * ARITIES[symbol]))
    if named:
        ways = [[OPEN, word[0], CLOSE, *word[1:]], [OPEN, *word, CLOSE]]
        if len(word) == 2:
            ways += [
                [word[0], OPEN, word[1], CLOSE],
                [OPEN, word[0], CLOSE, OPEN, word[1], CLOSE],
                [OPEN, word[0], OPEN, word[1], CLOSE, CLOSE],
            ]
        word = draw(st.sampled_from(ways))
    return tuple(word)


@st.composite
def rules(draw: st.DrawFn, kinds: Collection[str]) -> list[Production]:
    """A rule, or two between which chance decides."""
    symbol = draw(st.sampled_from(("S", *LIVELY, "S", "+")))
    asked = Number(draw(st.integers(0, 2))) if draw(st.integers(0, 7)) == 0 else Name("x")
    more = draw(others(kinds)) if SEVERAL in kinds and draw(st.integers(0, 3)) else ()
    own = (Pattern(symbol, (asked,) * ARITIES[symbol]), *more)
    sides = draw(st.sampled_from(("left", "right", "right", "both", ""))) if CONTEXT in kinds else ""
    left = draw(patterns("lm", branches=False)) if sides in ("left", "both") else ()
    right = draw(patterns("rs", branches=True)) if sides in ("right", "both") else ()
    names = tuple(a.name for module in (*left, *own, *right) for a in module.arguments if isinstance(a, Name))
    condition = draw(conditions(names, 0)) if names and draw(st.integers(0, 7)) else None
    chancy = CHANCE in kinds and draw(st.integers(0, 3))
    successors = items(names, kinds, least=draw(st.sampled_from((0, 1, 1, 1))))
    return [
        Production(own, draw(successors), condition, left, right, probability)
        for probability in (draw(st.lists(st.sampled_from(WEIGHTS), min_size=1, max_size=2)) if chancy else (None,))
    ]


@st.composite
def others(draw: st.DrawFn, kinds: Collection[str]) -> tuple[Pattern, ...]:
    """One or two modules that are replaced together with one before them; values may be asked for."""
    found = []
    for name in "yz"[: draw(st.sampled_from((1, 1, 2)))]:
        symbol = draw(st.sampled_from((*LIVELY, *LIVELY, "F", "%" if CUT in kinds else "+")))
        asked = Number(draw(st.integers(0, 2))) if draw(st.integers(0, 7)) == 0 else Name(name)
        found.append(Pattern(symbol, (asked,) * ARITIES[symbol]))
    return tuple(found)


@st.composite
def apices(draw: st.DrawFn, kinds: Collection[str]) -> Production:
    """A rule for an apex that ages and grows where no other rule has a say."""
    older = Pattern("S", (Apply("+", (Name("x"), Number(1))),))
    return Production((Pattern("S", (Name("x"),)),), (*draw(items(("x",), kinds, most=1)), older))


@st.composite
def decompositions(draw: st.DrawFn, kinds: Collection[str]) -> Production:
    """A rule for D(n), which makes D of less than n where n is 1 or more, or for E, which makes neither."""
    plain = tuple(kind for kind in kinds if kind not in (DECOMPOSITION, CUT))
    probability = draw(st.sampled_from(WEIGHTS)) if CHANCE in kinds and draw(st.booleans()) else None
    if draw(st.integers(0, 2)) == 0:
        return Production((Pattern("E"),), draw(items((), plain, least=1)), probability=probability)
    less = draw(st.sampled_from((Apply("-", (Name("n"), Number(1))), Apply("/", (Name("n"), Number(2))))))
    rest = draw(items(("n",), plain, most=1))
    successor = (Pattern("D", (less,)), *rest, *draw(st.sampled_from(((), (Pattern("E"),)))))
    bound = Number(draw(st.sampled_from((1, 1, 2))))
    return Production(
        (Pattern("D", (Name("n"),)),),
        successor[:: draw(st.sampled_from((1, 1, -1))) if not rest else 1],
        Apply(">=", (Name("n"), bound)),
        probability=probability,
    )


@st.composite
def metas(draw: st.DrawFn, kinds: Collection[str]) -> MetaRule:
    """A rule that joins two modules, or removes them, or makes of them what cuts off a branch."""
    if draw(st.booleans()):
        moves = Pattern("f", (Name("x"),)), Pattern("f", (Name("y"),))
        made = draw(st.sampled_from(((Pattern("f", (Apply("+", (Name("x"), Name("y"))),)),), ())))
        return MetaRule(moves, made, draw(conditions(("x", "y"), 0)) if draw(st.booleans()) else None)
    pair = tuple(Pattern(draw(st.sampled_from("ABF"))) for _ in range(2))
    made = draw(st.sampled_from(("", "A", "F", *("%" if CUT in kinds else ""))))
    return MetaRule(pair, tuple(map(Pattern, made)))


@st.composite
def systems_with(draw: st.DrawFn, *kinds: str) -> LSystem:
    """A system with some kinds of rules; with none named, with any mixture of them."""
    if not kinds:
        without = draw(st.lists(st.sampled_from(KINDS), max_size=2))
        kinds = tuple(kind for kind in KINDS if kind not in without)
    rewriting = list(chain(*draw(st.lists(rules(kinds), min_size=3, max_size=6))))
    if draw(st.integers(0, 3)):
        rewriting.sort(key=lambda rule: not (rule.condition or len(rule.parameters) > 1))  # what always applies stands last
    if draw(st.integers(0, 3)):
        rewriting.append(draw(apices(kinds)))
    meta = tuple(draw(st.lists(metas(kinds), min_size=1, max_size=3))) if META in kinds else ()
    plain = tuple(kind for kind in kinds if kind not in (CHANCE, REPETITION, CUT))
    decomposed = (Pattern("D", (Number(draw(st.integers(1, 3))),)), Pattern("E")) if DECOMPOSITION in kinds else ()
    found = [m for rule in rewriting[:4] for m in rule.parameters]
    found += [m for rule in meta for m in rule.predecessors]
    axiom = [*draw(items((), plain, most=4)), *decomposed, *(draw(instances(module)) for module in found)]
    ignored = draw(st.sampled_from(((), ("+",), ("+", "F")))) if CONTEXT in kinds else ()
    return LSystem(
        tuple(axiom),
        tuple(rewriting),  # type: ignore[arg-type]
        decomposition=tuple(draw(st.lists(decompositions(kinds), min_size=1, max_size=3))) if DECOMPOSITION in kinds else (),
        meta=meta,
        ignored=ignored,
        considered=draw(st.sampled_from(((), (), LIVELY))) if CONTEXT in kinds and not ignored else (),
        branches=draw(st.sampled_from(BRANCHES)) if CONTEXT in kinds else ANY_BRANCH,
    )
