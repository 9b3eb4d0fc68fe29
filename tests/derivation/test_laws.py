"""Laws of parallel rewriting, on random systems: they hold whatever the system, or the engine is wrong."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import lsys_kit.derivation.engines.engine as expansion
from lsys_kit.budget import limits
from lsys_kit.derivation.core.chance import Chance
from lsys_kit.derivation.core.states import States, closure
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation, derive, lengths
from lsys_kit.derivation.engines.stepping import SteppingEngine
from lsys_kit.derivation.engines.stepwise import Stepper
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.expressions import Number, is_random
from lsys_kit.notation.model.modules import Module, Pattern, Repeat, flat
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read, read_word
from lsys_kit.notation.write import write
from tests.derivation import reference
from tests.derivation.random_systems import (
    CHANCE,
    CONTEXT,
    CUT,
    DECOMPOSITION,
    KINDS,
    META,
    REPETITION,
    SEVERAL,
    SYMBOLS,
    systems,
    systems_with,
)

STEPS = 4


def plain(word: Iterable[Pattern]) -> list[reference.PlainModule]:
    return [(module.symbol, module.arguments) for module in word]  # type: ignore[misc]


def modules(word: Iterable[Pattern]) -> list[Pattern]:
    return list(word)


def exact(derivation: Derivation) -> Derivation:
    """The derivation, where no value outgrew what is kept exactly."""
    assume(derivation.states.inexact is None)
    return derivation


def from_word(system: LSystem, word: Iterable[Module]) -> LSystem:
    """The system with a word as its axiom."""
    return replace(system, axiom=tuple(Pattern(m.symbol, tuple(map(Number, m.arguments))) for m in word))


@given(systems())
def test_the_engine_follows_the_definition(system: LSystem) -> None:
    assert [plain(word) for word in exact(derive(system, STEPS))] == reference.words(system, STEPS)[0]


@pytest.mark.slow
def test_the_random_systems_are_not_idle() -> None:
    seen: Counter[str] = Counter()

    @settings(derandomize=True, max_examples=300, database=None)
    @given(systems())
    def look(system: LSystem) -> None:
        words, applied = reference.words(system, STEPS)
        seen.update(
            {
                "all": 1,
                "condition": any(rule.condition is not None for rule in applied),
                "failed condition": len(applied) < len(set(system.productions)),
                "erasing": any(not rule.successor for rule in applied),
                "value asked for": any(not hasattr(a, "name") for rule in applied for a in rule.predecessor.arguments),
                "branch": any(symbol == "[" for symbol, _ in words[-1]),
                "growth": len(words[-1]) > len(words[0]),
                "ages": any(values for _, values in words[-1]),
            }
        )

    look()
    for what in seen:
        assert seen[what] >= (0.15 if what == "value asked for" else 0.3) * seen["all"], (what, seen)


@given(systems(), st.integers(0, 6))
def test_the_last_word_is_the_same_without_those_between(system: LSystem, steps: int) -> None:
    with limits(modules=5_000):
        try:
            stepwise = list(derive(system, steps))
        except ModelLimitError as refused:
            stepwise = list(refused.partial)  # type: ignore[call-overload]
        assert modules(derive(system, len(stepwise) - 1)[-1]) == modules(stepwise[-1])


@pytest.mark.slow
@pytest.mark.parametrize(("plain_up_to", "piece"), [(0, 1), (0, 3), (5, 64), (10**6, 2)])
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40)
@given(system=systems())
def test_the_way_a_word_is_built_does_not_show(system: LSystem, plain_up_to: int, piece: int) -> None:
    expected = [plain(word) for word in exact(derive(system, STEPS))]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(expansion, "MOST_LISTED", plain_up_to)
        patch.setattr(expansion, "PIECE", piece)
        assert [plain(word) for word in reversed(derive(system, STEPS))] == expected[::-1]
        assert [plain(word) for word in derive(system, STEPS)] == expected


@given(systems(), systems())
def test_parts_of_a_word_derive_on_their_own(system: LSystem, other: LSystem) -> None:
    """P(uv) = P(u) P(v)."""
    second = tuple(module for module in other.axiom if not reference_names(module) - {c.name for c in system.constants})
    ends = [derive(replace(system, axiom=axiom), STEPS)[-1] for axiom in (system.axiom + second, system.axiom, second)]
    assert modules(ends[0]) == modules(ends[1]) + modules(ends[2])


def reference_names(module: Pattern) -> set[str]:
    from lsys_kit.notation.model.expressions import names_in

    return {name for argument in module.arguments for name in names_in(argument)}  # type: ignore[arg-type]


@given(systems())
def test_without_productions_nothing_changes(system: LSystem) -> None:
    derivation = derive(replace(system, productions=()), STEPS)
    assert all(word == derivation[0] for word in derivation)


@given(systems(), st.integers(0, 3), st.integers(0, 3))
def test_a_derivation_goes_on_from_any_word(system: LSystem, first: int, second: int) -> None:
    between = exact(derive(system, first))[-1]
    assert derive(from_word(system, between), second)[-1] == derive(system, first + second)[-1]


@given(systems())
def test_lengths_are_known_without_words(system: LSystem) -> None:
    derivation = derive(system, STEPS)
    assert derivation.lengths == [len(word) for word in derivation] == list(lengths(system, STEPS))
    for step, word in enumerate(derivation):
        assert {s: n for s, n in derivation.counts(step).items() if n} == dict(Counter(word.numbers()))


def ends(system: LSystem) -> bool:
    """Whether the states of a system end soon."""
    return closure(States(system), 12) is not None


@pytest.mark.slow
@settings(max_examples=40, suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow])
@given(systems().filter(ends), st.integers(0, 6))
def test_counts_are_the_axioms_times_a_power_of_the_growth_matrix(system: LSystem, step: int) -> None:
    import sympy

    found = growth(system)
    start = sympy.Matrix([found.counts(0)])
    counts = tuple(start * found.matrix**step)
    assert counts == found.counts(step)
    word = derive(system, step)[-1]
    assert [list(word).count(state) for state in found.states] == list(counts)
    assert found.lengths(step)[step] == len(word)


@settings(suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow])
@given(systems().filter(ends))
def test_all_tokens_move_at_once(system: LSystem) -> None:
    net = stages(system)
    for before, after in pairwise(derive(system, STEPS)):
        assert net.tokens(after) == net.fired(net.tokens(before))


def rewritten(
    system: LSystem, change: Callable[[tuple[Pattern, ...]], tuple[Pattern, ...]], predecessor: Callable[[Pattern], Pattern]
) -> LSystem:
    """The system with every word in it changed."""
    rules = tuple(
        Production((predecessor(rule.predecessor),), change(rule.successor), rule.condition) for rule in system.productions
    )
    return replace(system, axiom=change(system.axiom), productions=rules, alphabet=())


def renamed(names: Mapping[str, str]) -> Callable[[Pattern], Pattern]:
    return lambda module: replace(module, symbol=names.get(module.symbol, module.symbol))


@given(systems(), st.permutations(("B", "C", "wall", "a_r")))
def test_renaming_commutes_with_deriving(system: LSystem, new: list[str]) -> None:
    rename = renamed(dict(zip(SYMBOLS, new, strict=True)))
    other = rewritten(system, lambda word: tuple(map(rename, word)), rename)
    assert [modules(w) for w in derive(other, STEPS)] == [list(map(rename, w)) for w in derive(system, STEPS)]


def mirrored(word: Iterable[Pattern]) -> tuple[Pattern, ...]:
    turn = renamed({"[": "]", "]": "[", "+": "-", "-": "+"})
    return tuple(turn(module) for module in reversed(tuple(word)))


@given(systems())
def test_mirroring_commutes_with_deriving(system: LSystem) -> None:
    other = rewritten(system, mirrored, lambda module: module)
    assert [tuple(w) for w in derive(other, STEPS)] == [mirrored(w) for w in derive(system, STEPS)]


@given(systems())
def test_what_was_written_reads_back(system: LSystem) -> None:
    assert read(write(system)) == system
    assert write(read(write(system))) == write(system)


@given(systems(), st.integers(0, STEPS))
def test_a_word_reads_back(system: LSystem, steps: int) -> None:
    word = exact(derive(system, steps))[-1]
    assert read_word(str(word), system=system) == tuple(word)
    assert read_word(str(word)) == tuple(word)


@given(systems(), st.integers(0, 40), st.integers(0, 40))
def test_a_part_of_a_word_is_a_word(system: LSystem, start: int, end: int) -> None:
    word = derive(system, STEPS)[-1]
    part = word[start:end]
    assert isinstance(part, Word)
    assert modules(part) == modules(word)[start:end]
    assert word[:start] == derive(system, STEPS)[-1][:start]


# Systems with contexts, chance, decomposition, cuts, repetitions and meta-rules

MIXED = [
    *((kind,) for kind in KINDS),
    (CONTEXT, CHANCE),
    (CONTEXT, CUT),
    (SEVERAL, CONTEXT),
    (SEVERAL, CHANCE),
    (SEVERAL, CUT),
    (),
]
"""Kinds of rules that are tested alone and together; `()` is any mixture."""
seeds = st.integers(-3, 2**40)


def defined(system: LSystem, seed: int = 0) -> list[reference.PlainWord]:
    """The words after the definition, where they stay small."""
    with limits(modules=10**6):
        found = reference.words(system, STEPS, seed)[0]
    assume(max(map(len, found)) <= 1_000)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("kinds", MIXED)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(data=st.data(), seed=seeds)
def test_the_engine_follows_the_definition_of_every_kind(kinds: tuple[str, ...], data: st.DataObject, seed: int) -> None:
    system = data.draw(systems_with(*kinds))
    expected = defined(system, seed)
    assert [plain(word) for word in exact(derive(system, STEPS, seed=seed))] == expected


@pytest.mark.slow
@pytest.mark.parametrize("kinds", MIXED)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow], max_examples=40)
@given(data=st.data(), seed=seeds)
def test_words_by_arrays_are_those_of_one_by_one(kinds: tuple[str, ...], data: st.DataObject, seed: int) -> None:
    """The stepwise engine serves every system: it gives the definition's words, and those of whatever engine is chosen."""
    system = data.draw(systems_with(*kinds))
    expected = defined(system, seed)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(expansion, "MOST_LISTED", 3)
        one_by_one = Derivation(SteppingEngine(Stepper(States(system), seed), None)).to(STEPS)
        assert [plain(word) for word in exact(one_by_one)] == expected
        chosen = derive(system, STEPS, seed=seed)
        assert list(chosen) == list(one_by_one)
        assert [chosen.origins(step) for step in range(1, STEPS + 1)] == [
            one_by_one.origins(step) for step in range(1, STEPS + 1)
        ]


@pytest.mark.slow
@pytest.mark.parametrize("kinds", MIXED)
def test_the_random_systems_of_every_kind_are_not_idle(kinds: tuple[str, ...]) -> None:
    seen: Counter[str] = Counter()

    @settings(derandomize=True, max_examples=200, database=None, suppress_health_check=list(HealthCheck))
    @given(systems_with(*kinds))
    def look(system: LSystem) -> None:
        words, applied = reference.words(system, STEPS)
        made = [argument for rule in applied for module in flat(rule.successor) for argument in module.arguments]

        def differs(other: LSystem, seed: int = 0) -> bool:
            return words != reference.words(other, STEPS, seed)[0]

        seen.update(
            {
                "all": 1,
                "condition": any(rule.condition is not None for rule in applied),
                CONTEXT: any(rule.left or rule.right for rule in applied),
                "named branch": any(module.symbol == "[" for rule in applied for module in rule.right),
                CHANCE: any(rule.probability is not None for rule in applied) and differs(system, 1),
                "random value": any(map(is_random, made)),
                CUT: any(before[0] == "%" and after[0] != "]" for word in words[:-1] for before, after in pairwise(word)),
                REPETITION: any(isinstance(item, Repeat) for rule in applied for item in rule.successor),
                DECOMPOSITION: bool(system.decomposition) and differs(replace(system, decomposition=())),
                META: bool(system.meta) and differs(replace(system, meta=())),
                SEVERAL: any(len(rule.predecessors) > 1 for rule in applied),
                "three together": any(len(rule.predecessors) > 2 for rule in applied),
                "several between neighbours": any(len(rule.predecessors) > 1 and (rule.left or rule.right) for rule in applied),
                "several with a condition": any(len(rule.predecessors) > 1 and rule.condition is not None for rule in applied),
            }
        )

    look()
    for what in ("condition", *(kinds or KINDS)):
        assert seen[what] >= 0.3 * seen["all"], (what, seen)
    rates = {
        (CONTEXT, "named branch"): 0.1,
        (CHANCE, "random value"): 0.15,
        (SEVERAL, "three together"): 0.05,
        (SEVERAL, "several with a condition"): 0.2,
    }
    for (kind, what), rate in rates.items():
        assert kind not in (kinds or KINDS) or seen[what] >= rate * seen["all"], (what, seen)
    assert not {CONTEXT, SEVERAL} <= {*(kinds or KINDS)} or seen["several between neighbours"] >= 0.15 * seen["all"], seen


@given(systems_with(CONTEXT))
def test_an_empty_context_is_none(system: LSystem) -> None:
    for rule in system.productions:
        condition = f": {rule.condition}" if rule.condition is not None else ""
        bare = replace(rule, left=(), right=(), condition=None, successor=(Pattern("B"),))
        assert read(f"axiom: A\n < {rule.predecessor} > -> B").productions == (bare,)
        if not set(condition) & set("lmrs"):
            text = f"axiom: A\n < {rule.predecessor} > {condition} -> B"
            assert read(text).productions == (replace(bare, condition=rule.condition),)


@given(st.integers(-322, 308), st.sampled_from(("", "A < ")), st.integers(0, 9))
def test_only_the_ratios_of_weights_decide(power: int, context: str, seed: int) -> None:
    """At both ends of what doubles can hold, too."""

    def system(weight: str, other: str) -> LSystem:
        return read(f"axiom: A A A A\n{context}A -> A A : {weight}\n{context}A -> A B : {other}\n{context}A -> B : 0")

    extreme, usual = system(f"1e{power}", f"1.5e{power}"), system("1", "1.5")
    assert str(derive(extreme, STEPS, seed=seed)[-1]) == str(derive(usual, STEPS, seed=seed)[-1])
    assert str(stages(extreme)) == str(stages(usual))


@given(systems_with(CONTEXT), st.sampled_from((1, 0.25, 7)), seeds)
def test_what_has_no_rival_happens_whatever_its_probability(system: LSystem, probability: float, seed: int) -> None:
    first = {rule.predecessor.symbol: rule for rule in reversed(system.productions)}
    certain = replace(system, productions=tuple(first.values()))
    chancy = tuple(replace(rule, probability=Number(probability)) for rule in first.values())
    defined(certain)
    assert list(map(modules, derive(replace(certain, productions=chancy), STEPS, seed=seed))) == list(
        map(modules, derive(certain, STEPS))
    )


@given(systems_with(), systems())
def test_interpretation_never_changes_a_word(system: LSystem, other: LSystem) -> None:
    defined(system)
    drawn = replace(
        system,
        interpretation=tuple(
            Production((Pattern(symbol),), (Pattern("F"), Pattern("%"), Pattern("B"))) for symbol in ("A", "B", "F", "+", "E")
        ),
    )
    assert list(map(modules, derive(drawn, STEPS))) == list(map(modules, derive(system, STEPS)))


@given(systems_with(DECOMPOSITION), seeds)
def test_a_decomposed_word_cannot_be_decomposed(system: LSystem, seed: int) -> None:
    defined(system, seed)
    for module in {module for word in list(derive(system, STEPS, seed=seed))[1:] for module in word}:
        assert reference.replaced(system, [module], 0, {}, Chance(0, 0, 0), depth=1) == (None, [module])


@given(systems_with(META))
def test_a_shortened_word_cannot_be_shortened(system: LSystem) -> None:
    defined(system)
    for word in map(modules, list(derive(system, STEPS))[1:]):
        assert reference.shortened(system, word, {}) == word


@pytest.mark.slow
@given(systems(), systems())
def test_what_stands_behind_a_cut_makes_no_difference(system: LSystem, other: LSystem) -> None:
    known = {constant.name for constant in system.constants}
    behind = tuple(module for module in other.axiom if not reference_names(module) - known)
    cut = derive(replace(system, axiom=(*system.axiom, Pattern("%"), *behind)), STEPS)
    assert list(map(modules, cut))[1:] == list(map(modules, derive(system, STEPS)))[1:]


@pytest.mark.slow
@pytest.mark.parametrize("kinds", [(CONTEXT,), (CHANCE,), ()])
@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(data=st.data(), seed=seeds, steps=st.permutations(range(STEPS + 1)))
def test_the_same_seed_gives_the_same_word_in_whatever_order(
    kinds: tuple[str, ...], data: st.DataObject, seed: int, steps: list[int]
) -> None:
    system = data.draw(systems_with(*kinds))
    defined(system, seed)
    one_by_one = list(map(modules, derive(system, STEPS, seed=seed)))
    asked = derive(system, STEPS, seed=seed)
    assert {step: modules(asked[step]) for step in steps} == dict(enumerate(one_by_one))
    for step in steps:
        assert modules(derive(system, step, seed=seed)[-1]) == one_by_one[step]


CHANCY = """axiom: A(1) S
A(x) -> A(x + uniform(0, 1)) [ B ] : 0.5
A(x) -> B A(normal(x, 2)) : 0.5
S < A(x) > B -> A(poisson(2)) A(x)
B -> [ + S ] B : 1/3
B -> - B : 2/3"""


def test_seeds_make_a_difference() -> None:
    assert len({str(derive(read(CHANCY), 6, seed=seed)[-1]) for seed in range(10)}) == 10


@pytest.mark.slow
def test_words_do_not_depend_on_the_hashes_of_a_process() -> None:
    program = f"from lsys_kit import derive, read; print([str(w) for w in derive(read({CHANCY!r}), 8, seed=3)])"
    printed = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONHASHSEED": number},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for number in ("0", "1", "2")
    }
    assert len(printed) == 1


@given(systems_with())
def test_what_was_written_of_any_kind_reads_back(system: LSystem) -> None:
    assert read(write(system)) == system
