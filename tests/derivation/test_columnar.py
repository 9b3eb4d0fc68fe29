"""Words as columns are the words of the module-by-module engine, to the last bit, in doubles and exact."""

from __future__ import annotations

import pickle
import tracemalloc
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, limits, read, system
from lsys_kit import systems as catalogue
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import Derivation, serves
from lsys_kit.derivation.engines import columnar, counting, kept, stepping
from lsys_kit.derivation.engines import together as together_module
from lsys_kit.derivation.engines.columnar import ColumnarSteps, ColumnWord
from lsys_kit.derivation.engines.columns import Rows, column_function, column_of, values_of
from lsys_kit.derivation.engines.stepping import SteppingEngine
from lsys_kit.derivation.engines.stepwise import Stepper
from lsys_kit.derivation.engines.together import counts_together
from lsys_kit.notation.model.expressions import Apply, Name, Number, function_of
from lsys_kit.notation.model.modules import END, Pattern
from lsys_kit.notation.model.system import LSystem, Production
from tests.derivation.random_systems import CHANCE, CONTEXT, DECOMPOSITION, REPETITION, systems, systems_with

SPREADING = read("axiom: A(1)\nA(x) -> A(.37*x+.1) A(.59*x+.2)")
MIXED = read("""
c = 3
axiom: A(1,2) B [C(3)]
A(x,y) : x < y && y > c -> A(x*y/7, y-x) B C(x)
A(x,y) -> A(y,x) A(x+1/3, y*1.1)
C(3) -> C(4) C(3.5)
C(x) : !(x <= 3) || x == 0 -> C(abs(x/1.3)) D
B -> ε
D -> B D""")
ROUNDED = read("axiom: A(1)\nA(x) : floor(x) != 2 -> A(-x*1.7) A(ceil(x/3)+0.5)\nA(x) -> A(x-1)A(floor(x/2-3))")
LONG = read("axiom: A(1)\nA(x) -> A(123456789/1000*x+1) A(x/987654321)")
DENOMINATORS = read("axiom: A(1)\nA(x) : x < 1000 -> A(x/3+1) A(x/7-2)")
TREE = read("axiom: A(1)\nA(s) -> F(s*uniform(.8,1)) [+(30)A(s*uniform(.5,.9))] [-(30)A(s*uniform(.5,.9))]")
DIFFUSION = read(
    "d = 1/10\naxiom: C(1) C(0) C(1/2) C(0) C(0) C(3) C(1/7) C(0)\n"
    "C(x) < C(y) > C(z) -> C(y + d*(x+z-2*y))\nC(y) > C(z) -> C(y + d*(z-y))\nC(x) < C(y) -> C(y + d*(x-y))"
)
CHANCY = read("""
axiom: A(1) A(2) B A(3) C(5)
A(x) : x > 2 -> A(x/2) B : 2
A(x) -> A(x+uniform(0,1)) : x
A(x) -> B A(x*1.5) : 1/3
B -> B C(table(1,2,3)) : 1
B -> ε : 1
C(x) : x >= 3 -> C(x-1) C(if(x > 4, normal(x,1), x))
C(x) -> C(poisson(x)) C(binomial(3,1/2)) C(if(x == 0, uniform(0,1), 1/(x*x)))""")


def drawn(low: int | str, high: int | str) -> Apply:
    """A random number in a condition or a weight, where no notation writes one."""
    return Apply("uniform", tuple(Name(each) if isinstance(each, str) else Number(each) for each in (low, high)))


HALF, X = Number(Fraction(1, 2)), Name("x")
A_OF_X, B_OF_X = Pattern("A", (X,)), Pattern("B", (X,))
HEADS = Apply("<", (drawn(0, 1), HALF))
TOSSED = LSystem(
    axiom=tuple(Pattern("A", (Number(n),)) for n in range(9)),
    productions=(
        Production((A_OF_X,), (B_OF_X, A_OF_X), Apply("&&", (Apply(">", (X, Number(2))), HEADS))),
        Production((A_OF_X,), (Pattern("A", (drawn("x", 9),)),), Apply("||", (Apply(">", (X, Number(5))), HEADS))),
        Production((A_OF_X,), (Pattern("A", (drawn(0, "x"),)),), Apply(">", (X, Number(1))), probability=drawn(0, 1)),
        Production((A_OF_X,), (B_OF_X, B_OF_X), HEADS, probability=HALF),
        Production((A_OF_X,), (Pattern("A", (Apply("+", (X, drawn(0, 3))),)),), X),
        Production((B_OF_X,), (Pattern("B", (Apply("+", (drawn(0, 1), drawn(0, 1))),)),), HEADS),
    ),
)
SIGNALS = read("""
ignore: + -
k = 2
axiom: S(1) F(0) [+ F(1) F(2)] - F(3) [F(4) [- F(5)] F(6)] F(k)
S(x) < F(y) > F(z) : y < 40 -> F(x+y/3) F(z/2)
F(x) S(w) < F(y) -> F(x*w)
F(x) F(w) < F(y) > F(k) -> S(y)
F(y) > F(z) -> F(y/3) [+ S(y+1)]
S(x) -> S(max(x, 1/2, 0.1*x)) F(min(x, 2))
F(3) -> F(3.5)""")
REPEATED = read("""
axiom: A(3) B(2)
A(n) : n > 0 -> repeat(n,i) <F(i/n)> A(n-1) repeat(2,i) <[repeat(i,j) <B(i+j*0.1)> B(uniform(i,n))]>
B(x) -> repeat(floor(x)) <B(x/2)> F(x)
F(x) -> F(x*1.1)""")
PARTS = read("""
axiom: A(3) D(2)
A(x) -> A(x*0.9) D(floor(x)) E
decomposition:
D(n) : n > 0 -> F(n/7) D(n-1) F(n)
D(n) -> ε
E -> [G(1)]""")
ROOTS = read(
    "axiom: A(2) A(5)\nA(x) : x^2 < 90 && !(x == 3) -> A(x^2/3) A(sqrt(x+1)) A(sin(30*x)) A(mod(x,2)) B(-abs(x))\n"
    "A(x) -> A(x/8)"
)
NUMBERS = LSystem(
    axiom=tuple(Pattern("A", (Number(n),)) for n in (2, 1, 0)),
    productions=(
        Production((A_OF_X,), (A_OF_X, Pattern("A", (Apply("-", (X, Number(1))),))), X),
        Production((A_OF_X,), (B_OF_X,), Apply("||", (Apply("sqrt", (X,)), Apply("==", (X, Number(0)))))),
    ),
)
LAST = LSystem(
    axiom=tuple(Pattern("A", (Number(n),)) for n in range(5)),
    productions=(Production((A_OF_X,), (A_OF_X, A_OF_X), right=(Pattern(END),)),),
)
SYSTEMS = {
    "spreading": SPREADING,
    "mixed": MIXED,
    "rounded": ROUNDED,
    "long": LONG,
    "denominators": DENOMINATORS,
    "tree": TREE,
    "diffusion": DIFFUSION,
    "chancy": CHANCY,
    "tossed": TOSSED,
    "signals": SIGNALS,
    "repeated": REPEATED,
    "parts": PARTS,
    "roots": ROOTS,
    "last": LAST,
    "numbers": NUMBERS,
}
STEPS = {"chancy": 6, "signals": 7, "repeated": 4, "diffusion": 50, "roots": 4}
ARITHMETICS = pytest.mark.parametrize("arithmetic", ["exact", "float"])


@contextmanager
def columns(wanted: bool) -> Iterator[None]:
    """Words are columns from the first step on, or never."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (counting, stepping):
            patch.setattr(module, "many_new", lambda new, size: wanted)
        yield


def typed(derivation: Derivation) -> list[list[tuple[object, ...]]]:
    """The modules of all words, with the types of their values."""
    return [[(m.symbol, m.arguments, *map(type, m.arguments)) for m in word] for word in derivation]


def told(derivation: Derivation) -> list[object]:
    """All that a derivation tells of its steps."""
    origins = [derivation.origins(step) for step in range(1, len(derivation))]
    return [typed(derivation), [str(word) for word in derivation], origins, derivation.lengths, derivation.notes]


def one_by_one(system: LSystem, steps: int, arithmetic: str, seed: int = 0) -> Derivation:
    """A derivation module by module."""
    return Derivation(SteppingEngine(Stepper(States(system, None, arithmetic), seed), None)).to(steps)


def in_columns(system: LSystem, steps: int, arithmetic: str, seed: int = 0) -> Derivation:
    """A derivation in columns from the first step on."""
    with columns(True):
        return derive(system, steps, arithmetic=arithmetic, seed=seed)


def check_equal(system: LSystem, steps: int, arithmetic: str, seed: int = 0) -> None:
    def outcome(made: object) -> object:
        try:
            with limits(modules=3_000), columns(True):
                return told(made(system, steps, arithmetic, seed))
        except ModelLimitError as error:  # one engine knows the whole size, another how large the word is so far
            return error.partial and error.partial.steps
        except LSystemError as error:
            return str(error)

    assert outcome(in_columns) == outcome(one_by_one)


@ARITHMETICS
@pytest.mark.parametrize("name", SYSTEMS)
def test_columns_give_the_words_that_go_module_by_module(name: str, arithmetic: str) -> None:
    for seed in range(2):
        check_equal(SYSTEMS[name], STEPS.get(name, 8), arithmetic, seed)


@ARITHMETICS
@pytest.mark.parametrize("name", SYSTEMS)
def test_these_systems_are_derived_in_columns(name: str, arithmetic: str) -> None:
    assert any(isinstance(word, ColumnWord) for word in in_columns(SYSTEMS[name], 3, arithmetic))


@pytest.mark.slow
@ARITHMETICS
@settings(suppress_health_check=list(HealthCheck), max_examples=60)
@given(system=systems())
def test_columns_give_the_words_of_the_table_for_any_system(arithmetic: str, system: LSystem) -> None:
    check_equal(system, 4, arithmetic)


@pytest.mark.slow
@pytest.mark.parametrize(
    "kinds", [(CONTEXT,), (CHANCE,), (CONTEXT, CHANCE), (CONTEXT, CHANCE, REPETITION), (DECOMPOSITION, CONTEXT, REPETITION)]
)
@settings(suppress_health_check=list(HealthCheck), max_examples=60)
@given(data=st.data(), seed=st.integers(0, 99), arithmetic=st.sampled_from(("exact", "float")))
def test_columns_give_the_words_for_systems_with_all_kinds_of_rules(
    kinds: tuple[str, ...], data: st.DataObject, seed: int, arithmetic: str
) -> None:
    served = systems_with(*kinds).filter(lambda system: serves(ColumnarSteps, States(system).traits))
    check_equal(data.draw(served), 4, arithmetic, seed)


@pytest.mark.slow
def test_columns_give_the_words_of_the_catalogue() -> None:
    served = 0
    for each in catalogue():
        found = system(each)
        if isinstance(found, LSystem) and serves(ColumnarSteps, States(found).traits):
            served += 1
            with limits(modules=2_000):
                check_equal(found, 4, "exact")
                check_equal(found, 4, "float")
    assert served > 40


@pytest.mark.parametrize("name", [name for name in SYSTEMS if name != "last"])
def test_long_words_are_computed_in_blocks(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setattr(columnar, "BLOCK_ROWS", 3)
    monkeypatch.setattr(columnar, "ROWS_AT_A_TIME", 4)
    check_equal(SYSTEMS[name], STEPS.get(name, 5), "exact", 4)


ODD = r"""
A(x) -> A(if(x > 2, sqrt(x), x)*2) A(0.1+if(x > 2, x, sqrt(2))) A(-if(x > 2, 1/x, sqrt(2)))

A(x) : if(x > 2, x, sqrt(x)) > 2 || 1.1 == x -> A(max(x, sqrt(2), 3)) A(min(1, sqrt(x)+0.1)) A(abs(if(x > 1, 1, sqrt(2))))

A(x) -> A(uniform(if(x > 2, 1, sqrt(2)), x)) A(uniform(x, 3)) A(if(x > 1, uniform(0,x), 2)) A(if(x > 1, 2, uniform(0,x)))

A(x) -> A(table(x, 1, 2.5)) A(table(sqrt(2), 1)) A(1/table(0, 1, 1)) A(if(x < 0, 1/0, x+sqrt(3)))

A(x) -> A(x*uniform(0,3)) A(x+1)
B(x) : x == 1/3 || 1/3 == x -> B(1)

A(x) : x > 7/5 -> A(x/1.5)
A(x) : 13/10 >= x && x != 1/3 -> A(x + sqrt(x))
A(x) : 4/3 < x && x <= 4/3 -> A(1)
A(x) -> A(x+1.1*sqrt(2))

A(x) : x*sqrt(2)/sqrt(2) >= 0.3 && 0.7 <= x*sqrt(2) && x != 0.1*sqrt(1) -> A(x/3*sqrt(1)) A(x/4) A(x/(-3))

A(x) : x*sqrt(2) == 0.1 || 0.1 != x*sqrt(3) && x*sqrt(4) < 0.1+x/3 -> A(x)
A(x) : x+sqrt(4) > x -> A(x+sqrt(3)/7) A(x-1/3)

A(x) : x < 100 -> A(x*x*x/7+1/3) A(ceil(x/7)) A(-x/11) A(floor(x*sqrt(2)))
A(x) -> A(x/1000000007)

A(x) -> A(min(if(x > 2, 1, sqrt(2)), if(x > 3, 2, sqrt(3)))) A(if(x > 2, 123456789012345678901234567890, x)) A(x+1/3)

A(x) -> A(mod(x, 3)) A(x^2/9) A(exp(-x)) A(sin(x*30)) A(rem(x, 2))

A(x) -> A(x/3+1/99999999977) A(if(x > 1, x/99999999977, x/3))

A(x) -> repeat(if(x > 2, sqrt(4), 1)) <A(x/3)> repeat(x-floor(x)+1/1) <B(x)>

A(x) : x < 99 -> repeat(if(x > 2, sqrt(4), 1)) <A(x/3)> repeat(if(x > 2, sqrt(9), sqrt(1))) <B(x)>

A(x) -> repeat(floor(x),i) <A(i/3) B(uniform(0,i+1))> A(x)

A(x) -> A(x) B(x)
B(x) -> ε

A(x) -> ε
B(x) -> ε

A(x) -> repeat(x/2) <A(x)>

A(x) -> repeat(2-x) <A(x)> A(x+1)

A(x) -> repeat(99999) <repeat(99999) <A(x)>>

A(x) -> A(x-1) B(log(x-2))

A(x) -> A(x/2) : x-2
A(x) -> A(x+1) : x-2

A(x) -> A(x/2) : x
A(x) -> A(x+1) : 2-x

A(x) -> A(x/2) : 0
A(x) -> A(x+1) : 0

A(x) -> A(table(x-3, 3-x)) A(x-1)

A(x) -> A(table(0, 0))

A(x) -> A(if(x > 1.6, 1e200*sqrt(x), 1)*if(x > 1.6, 1e200, 1))

A(x) : x > 1.6 -> B(x/7)
B(x) -> A(x+1.1)

A(x) -> A(normal(x, 3-x)) A(x+1)

A(x) -> A(x/3) D(x)
decomposition:
D(x) : x > -1 -> D(x+1) E

A(x) -> A(x/3) A(x/2) A(x/5) D(x)
decomposition:
D(x) -> E(x) E(x) E(x) E(x) E(x) E(x) E(x) E(x) E(x) E(x) E(x) E(x)

A(x) : 2 > 1 && x > 1 -> A(x/1.1) A(2+1)
A(x) : 1 > 2 -> A(1)

A(2) -> A(3) A(9/4)
A(x) -> A(2) A(x/2)

A(x) : log(x-2) > 0 -> A(x/2)
"""
ODD_RULES = ODD.strip().split("\n\n")


@ARITHMETICS
@pytest.mark.parametrize("rules", ODD_RULES, ids=range(len(ODD_RULES)))
def test_odd_rules_give_the_words_that_go_module_by_module(rules: str, arithmetic: str) -> None:
    check_equal(read(f"axiom: A(3) A(1.5) B(1) A(2) B(1/3)\n{rules}"), 5, arithmetic, 7)


def test_what_is_not_for_columns_stays_with_the_states() -> None:
    many = "\n".join(f"A(x) : x == {n} -> A(x+1/7) A(x/2)" for n in range(70))
    for text in (many, "A(x) < B(y) -> B(y)\nA(x) -> A(x/3) %", "meta: A(x) A(y) -> A(x+y)\nA(x) -> A(x/3) B(x)"):
        assert not isinstance(in_columns(read(f"axiom: A(1) B(2)\n{text}"), 5, "exact")[-1], ColumnWord)
    with limits(bits=100):
        assert not isinstance(in_columns(TREE, 5, "exact")[-1], ColumnWord)


def test_brackets_that_are_rewritten_stay_with_the_states() -> None:
    bracket = Production((Pattern("["),), (Pattern("["), Pattern("A", (Number(1),))))
    found = LSystem((Pattern("["), Pattern("A", (Number(1),)), Pattern("]")), (bracket,))
    assert str(in_columns(found, 2, "exact")[-1]) == "[A(1)A(1)A(1)]"


def test_a_depth_of_decomposition_holds_in_columns() -> None:
    check_equal(replace(PARTS, decomposition_depth=1), 5, "exact")
    check_equal(replace(PARTS, decomposition_depth=0), 5, "float")


def test_a_word_in_columns_is_a_row_of_modules() -> None:
    word, other = in_columns(TREE, 4, "exact")[-1], one_by_one(TREE, 4, "exact")[-1]
    assert isinstance(word, ColumnWord)
    assert (word[5], word[-1], [*word[3:9]]) == (other[5], other[-1], [*other[3:9]])
    assert str(word[2:7]) == str(other[2:7])
    assert word == other
    assert word.counts() == other.counts()
    assert repr(word) == repr(other)
    assert in_columns(PARTS, 1, "exact")[-1].counts() == one_by_one(PARTS, 1, "exact")[-1].counts()
    with pytest.raises(IndexError):
        word[len(word)]


@pytest.mark.parametrize("found", [TREE, SPREADING], ids=["stepping", "counting"])
def test_a_derivation_in_columns_can_be_copied(found: LSystem) -> None:
    derivation = in_columns(found, 5, "exact")
    with columns(True):
        copied = pickle.loads(pickle.dumps(derivation))
        assert isinstance(copied[-1], ColumnWord)
        assert told(copied.to(6)) == told(derivation.to(6))


def test_columns_go_back_to_states_when_modules_are_alike() -> None:
    found = read("axiom: " + " ".join(f"A({n})" for n in range(99)) + "\nA(x) > A(y) -> A(0)\nA(x) -> A(x+1)")
    words = derive(found, 130)
    assert isinstance(words[1], ColumnWord)
    assert not isinstance(words[130], ColumnWord)
    assert words[130].counts() == {"A": 99}
    assert typed(words) == typed(one_by_one(found, 130, "exact"))


@pytest.mark.parametrize("found", [DIFFUSION, SPREADING], ids=["stepping", "counting"])
def test_words_that_are_not_kept_are_made_again(monkeypatch: pytest.MonkeyPatch, found: LSystem) -> None:
    monkeypatch.setattr(kept, "SHARE", 10**7)
    derivation = in_columns(found, 9, "float")
    held = [step.word is not None for step in getattr(derivation._engine, "_steps" if found is DIFFUSION else "_late")]
    assert False in held
    with columns(True):
        assert told(derivation) == told(one_by_one(found, 9, "float"))
        assert [str(derivation[step]) for step in (3, 9, 3, 4)] == [
            str(one_by_one(found, 9, "float")[step]) for step in (3, 9, 3, 4)
        ]


@ARITHMETICS
@pytest.mark.parametrize("name", SYSTEMS)
def test_runs_side_by_side_are_counted_as_alone(name: str, arithmetic: str) -> None:
    found, steps = SYSTEMS[name], [0, 2, 3]
    seeds = [0, 1, 5, -3, 2**70, 1]
    alone = [one_by_one(found, 3, arithmetic, seed) for seed in seeds]
    together = [*counts_together(States(found, None, arithmetic), seeds, steps)]
    expected = [[Counter(run[step].counts()) for step in steps] for run in alone]
    assert [[+Counter(counts) for counts in run or ()] for run in together] == expected


def test_runs_side_by_side_end_where_their_words_do() -> None:
    """Contexts do not look into the word of another run."""
    rules = "A(x) < B(y) -> C\nB(x) < A(y) -> C\nA(x) < A(y) -> D\nA(x) > A(y) -> E : 1\nA(x) > A(y) -> ε : 1"
    for axiom in ("A(1) [B(2)] A(1)", "A(1)", "B(1) A(1) A(2)"):
        found = read(f"axiom: {axiom}\n{rules}")
        runs = counts_together(States(found), range(9), [1, 2])
        alone = [[+Counter(derive(found, step, seed=seed)[-1].counts()) for step in (1, 2)] for seed in range(9)]
        assert [[+Counter(counts) for counts in run or ()] for run in runs] == alone


def test_runs_that_are_large_together_are_taken_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    seeds = range(9)
    whole = [*counts_together(States(TREE), seeds, [1, 6])]
    monkeypatch.setattr(together_module, "MODULES_TOGETHER", 1_100)
    assert [*counts_together(States(TREE), seeds, [1, 6])] == whole
    monkeypatch.setattr(together_module, "MODULES_TOGETHER", 100)
    assert [*counts_together(States(TREE), seeds, [1, 6])] == [None] * 9


NUMBERS_OF_ALL_LENGTHS = st.one_of(
    st.integers(-(2**63), 2**63), st.fractions(max_denominator=9), st.fractions(), st.integers(-(2**140), 2**140)
)


@example([(0, 0)], 2**63)
@given(st.lists(st.tuples(NUMBERS_OF_ALL_LENGTHS, NUMBERS_OF_ALL_LENGTHS), min_size=1, max_size=5), NUMBERS_OF_ALL_LENGTHS)
def test_exact_columns_compute_as_fractions_do(pairs: list[tuple[Fraction, Fraction]], other: Fraction) -> None:
    """Whatever is short and long on either side, and whether one denominator is that of all."""
    first, second = (column_of([pair[side] for pair in pairs]) for side in (0, 1))
    rows = Rows({"x": first, "y": second}, len(pairs))
    for text in ("+", "-", "*", "/", "<", "<=", "==", "!=", ">", ">=", "min", "max"):
        for right, values in ((Name("y"), [y for _, y in pairs]), (Number(other), [other] * len(pairs))):
            expression = Apply(text, (Name("x"), right))
            one = function_of(Apply(text, (Name("x"), Name("y"))), {"x": 0, "y": 1})
            if text == "/" and 0 in values:
                continue
            found = rows.computed(column_function(expression, {}, "exact"))
            expected = [one((x, y)) for (x, _), y in zip(pairs, values, strict=True)]
            assert [*values_of(found, len(pairs))] == expected


SPREADING_OUT = "C(x) < C(y) > C(z) -> C(y + 0.1*(x+z-2*y))"


def test_long_derivations_take_little_memory() -> None:
    """Five hundred steps of two thousand cells: 9 MB, if all were kept, of which a quarter of 16 MB is kept."""
    found = read(f"axiom: {' '.join(f'C({n * n % 1999})' for n in range(2_000))}\n{SPREADING_OUT}")
    with limits(bytes=2**24, seconds=100):
        tracemalloc.start()
        derivation = derive(found, 500, arithmetic="float")
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    assert peak < 2**24
    assert derivation.lengths == [2_000] * 501
    assert sum(step.word.bytes for step in derivation._engine._steps if step.word) < 2**22


def test_columns_come_in_where_few_new_states_come_for_long() -> None:
    """Each of the first steps adds a sixth to the states of a word that has no more modules than before."""
    found = read(f"axiom: {' '.join(f'C({n % 17})' for n in range(300))}\n{SPREADING_OUT}")
    derivation = derive(found, 150, arithmetic="float")
    assert isinstance(derivation[150], ColumnWord)
    assert len(derivation.states) < 2_000
    assert str(derivation[150]) == str(one_by_one(found, 150, "float")[150])


def test_exact_diffusion_keeps_its_mass() -> None:
    words = in_columns(DIFFUSION, 30, "exact")
    assert isinstance(words[30], ColumnWord)
    masses = [sum(module.arguments[0] for module in word) for word in words]
    assert {*masses[:17]} == {Fraction(65, 14)}
    assert all(abs(mass - Fraction(65, 14)) < 1e-12 for mass in masses)


def test_diffusion_in_doubles_keeps_its_mass_but_for_rounding() -> None:
    for word in in_columns(DIFFUSION, 200, "float"):
        assert abs(sum(module.arguments[0] for module in word) - 65 / 14) < 1e-12


@ARITHMETICS
def test_the_symbols_of_others_do_not_matter_to_what_a_module_draws(arithmetic: str) -> None:
    rules = "A(x) -> A(x*uniform(0,1)) : 1\nA(x) -> A(normal(x,1)) : 1\nB(x) -> B(uniform(0,x)) : 1\nC -> C"
    first = in_columns(read(f"axiom: {'A(1) B(2) ' * 40}\n{rules}"), 1, arithmetic)[1]
    other = in_columns(read(f"axiom: {'A(1) C ' * 40}\n{rules}"), 1, arithmetic)[1]
    assert [*first][::2] == [*other][::2]


@ARITHMETICS
def test_many_different_modules_are_no_burden(arithmetic: str) -> None:
    derivation = derive(SPREADING, 16, arithmetic=arithmetic)
    assert derivation.lengths[-1] == len(derivation[-1]) == 2**16
    assert isinstance(derivation[-1], ColumnWord)
    assert len(derivation.states) < 2_000
    assert derivation.origins(3).parents == [0, 0, 1, 1, 2, 2, 3, 3]
    assert derivation.origins(16).parents[-3:] == [2**15 - 2, 2**15 - 1, 2**15 - 1]
    assert len(derivation.states) < 2_000


@pytest.mark.slow
@ARITHMETICS
@pytest.mark.parametrize("successor", ["F(.37*x+.1) [+(x) F(.59*x+.2)]", "F(.37*x+.1) [+ F(.59*x+.2)] [- F(.7*x+.3)]"])
def test_brackets_and_turns_among_different_modules_are_no_burden(successor: str, arithmetic: str) -> None:
    """At most three of eight modules are new at a step; the others are brackets, or turns that stay."""
    system = read(f"axiom: F(1)\nF(x) -> {successor}")
    derivation = derive(system, 9, arithmetic=arithmetic)
    assert isinstance(derivation[-1], ColumnWord)
    assert len(derivation.states) < 1_000
    with columns(False):
        assert str(derivation[-1]) == str(derive(system, 9, arithmetic=arithmetic)[-1])


def test_what_outgrows_exact_numbers_becomes_doubles() -> None:
    """After so many steps the denominators have more than 128 bits, and each value becomes a double by itself."""
    found = read("axiom: " + " ".join(f"A({n}/7)" for n in range(60)) + "\nA(x) -> A(.37*x+.1)")
    derivation = in_columns(found, 22, "exact")
    assert all(isinstance(derivation[step], ColumnWord) for step in range(1, 23))
    assert derivation.notes == one_by_one(found, 22, "exact").notes != ()
    assert typed(derivation) == typed(one_by_one(found, 22, "exact"))


@ARITHMETICS
@pytest.mark.parametrize(
    "rule",
    [
        "A(x) -> A(x-1) A(1/(x-1))",
        "A(x) -> A(x-1) B(1/(1/x))",
        "A(x) : 1/x > 2 -> B A(x)",
        "A(x) : x == 0 || 1/x < 9 -> A(x-1)",
        "A(x) : 2 > 1/0 -> B",
        "A(x) -> B(2/0) A(x-1)",
    ],
)
def test_a_division_by_zero_names_its_module(rule: str, arithmetic: str) -> None:
    """Where it stands deep in an expression, too, or in a condition."""
    check_equal(read(f"axiom: A(9)\n{rule}\nA(x) -> A(x-1)"), 12, arithmetic)


def test_a_value_that_is_none_names_its_module() -> None:
    with columns(True), pytest.raises(ModelValueError, match=r"A\(1\) under production 1"):
        derive(read("axiom: A(9)\nA(x) -> A(x-1) A(1/(x-1))"), 9, arithmetic="float")


@pytest.mark.parametrize("rule", ["A(x) -> A(1e200*x) A(1/x)", "A(x) -> A(1/(x*1e200*x)) A(x+1)", "A(x) -> A(sqrt(x-3)) A(x)"])
def test_numbers_past_doubles_are_refused_as_in_the_table(rule: str) -> None:
    check_equal(read(f"axiom: A(1e199)\n{rule}"), 4, "float")


def test_columns_are_refused_by_their_size() -> None:
    with limits(modules=100_000), pytest.raises(ModelLimitError, match="Step 17 would have 131,072 modules") as error:
        derive(SPREADING, 20, arithmetic="float")
    assert error.value.partial.steps == 16
    with limits(bytes=2_000_000), pytest.raises(ModelLimitError, match="bytes"):
        derive(SPREADING, 20, arithmetic="float")


def test_modules_that_come_back_stay_with_the_table() -> None:
    """Sixty different modules in the axiom, and hardly a new one from then on: they are counted."""
    system = read("axiom: " + " ".join(f"A({n})" for n in range(60)) + "\nA(x) : x > 0 -> A(x-1) A(x-1)")
    assert not isinstance(derive(system, 8)[-1], ColumnWord)


def test_a_word_shows_its_numbers_as_doubles_and_the_first_module_of_each_kind() -> None:
    word = derive(read("axiom: A(1/3) B A(1/18446744073709551629) A(7) C(2,5) C(3,4)"), 0)[0]
    columns = ColumnarSteps(word.states).word(word)
    places = np.array([0, 2, 3, 4, 5])
    assert columns.floats(0, places).tolist() == [1 / 3, 1 / 18446744073709551629, 7, 2, 3]
    assert columns.floats(1, places[3:]).tolist() == [5, 4]
    shown = " ".join(str(word.states.modules[state]) for state in columns.examples())
    assert shown == "A(1/3) B A(1/3) A(1/3) C(2,5) C(2,5)"
    doubles = derive(read("axiom: A(0.5) A(2)"), 0, arithmetic="float")[0]
    assert ColumnarSteps(doubles.states).word(doubles).floats(0, np.array([1, 0])).tolist() == [2, 0.5]


def test_a_copy_knows_where_modules_come_from() -> None:
    found = derive(read("axiom: a b b\na < b -> a b\nb -> b"), 3)
    assert isinstance(found._engine, SteppingEngine)
    again = pickle.loads(pickle.dumps(found))
    assert [again.origins(step) for step in (1, 2, 3)] == [found.origins(step) for step in (1, 2, 3)]
