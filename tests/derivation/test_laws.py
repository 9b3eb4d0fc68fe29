"""Laws of parallel rewriting, on random systems: they hold whatever the system, or the engine is wrong."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import lsys_kit.derivation.derive as engine
import lsys_kit.derivation.expand as expansion
from lsys_kit.budget import limits
from lsys_kit.derivation.derive import Derivation, derive, lengths
from lsys_kit.derivation.growth import growth
from lsys_kit.derivation.stages import stages
from lsys_kit.derivation.words import Word
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.expressions import Number
from lsys_kit.notation.model import LSystem, Module, Production
from lsys_kit.notation.read import read, read_word
from lsys_kit.notation.write import write
from tests.derivation import reference
from tests.derivation.random_systems import SYMBOLS, systems

STEPS = 4


def plain(word: Iterable[Module]) -> list[reference.PlainModule]:
    return [(module.symbol, module.arguments) for module in word]  # type: ignore[misc]


def modules(word: Iterable[Module]) -> list[Module]:
    return list(word)


def exact(derivation: Derivation) -> Derivation:
    """The derivation, where no value outgrew what is kept exactly."""
    assume(derivation.states.inexact is None)
    return derivation


def from_word(system: LSystem, word: Iterable[Module]) -> LSystem:
    """The system with a word as its axiom."""
    return replace(system, axiom=tuple(replace(m, arguments=tuple(map(Number,
    m.arguments))) for m in word))  # type: ignore[arg-type]


@given(systems())
def test_the_engine_follows_the_definition(system: LSystem) -> None:
    assert [plain(word) for word in exact(derive(system, STEPS))] == reference.words(system, STEPS)[0]


def test_the_random_systems_are_not_idle() -> None:
    seen: Counter[str] = Counter()

    @settings(derandomize=True, max_examples=300, database=None)
    @given(systems())
    def look(system: LSystem) -> None:
        words, applied = reference.words(system, STEPS)
        rules = [system.productions[number] for number in applied]
        seen.update({
            "all": 1,
            "condition": any(rule.condition is not None for rule in rules),
            "failed condition": len(applied) < len(system.productions),
            "erasing": any(not rule.successor for rule in rules),
            "value asked for": any(not hasattr(a, "name") for rule in rules for a in rule.predecessor.arguments),
            "branch": any(symbol == "[" for symbol, _ in words[-1]),
            "growth": len(words[-1]) > len(words[0]),
            "ages": any(values for _, values in words[-1]),
        })

    look()
    rare = {"value asked for": 0.1, "erasing": 0.15}
    for what in seen:
        assert seen[what] >= rare.get(what, 0.3) * seen["all"], (what, seen)


@given(systems(), st.integers(0, 6))
def test_the_last_word_is_the_same_without_those_between(system: LSystem, steps: int) -> None:
    with limits(modules=5_000):
        try:
            stepwise = list(derive(system, steps))
        except ModelLimitError as refused:
            stepwise = list(refused.partial)  # type: ignore[call-overload]
        assert modules(derive(system, len(stepwise) - 1)[-1]) == modules(stepwise[-1])


@pytest.mark.parametrize(("plain_up_to", "piece"), [(0, 1), (0, 3), (5, 64), (10**6, 2)])
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40)
@given(system=systems())
def test_the_way_a_word_is_built_does_not_show(system: LSystem, plain_up_to: int, piece: int) -> None:
    expected = [plain(word) for word in exact(derive(system, STEPS))]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(engine, "PLAIN", plain_up_to)
        patch.setattr(expansion, "PIECE", piece)
        assert [plain(word) for word in reversed(derive(system, STEPS))] == expected[::-1]
        assert [plain(word) for word in derive(system, STEPS)] == expected


@given(systems(), systems())
def test_parts_of_a_word_derive_on_their_own(system: LSystem, other: LSystem) -> None:
    """P(uv) = P(u) P(v)."""
    second = tuple(module for module in other.axiom if not reference_names(module) - {c.name for c in system.constants})
    ends = [derive(replace(system, axiom=axiom), STEPS)[-1] for axiom in (system.axiom + second, system.axiom, second)]
    assert modules(ends[0]) == modules(ends[1]) + modules(ends[2])


def reference_names(module: Module) -> set[str]:
    from lsys_kit.notation.expressions import names_in

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
    with limits(states=12):
        try:
            growth(system)
        except ModelLimitError:
            return False
    return True


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


def rewritten(system: LSystem, change: Callable[[tuple[Module, ...]], tuple[Module, ...]],
              predecessor: Callable[[Module], Module]) -> LSystem:
    """The system with every word in it changed."""
    rules = tuple(Production(predecessor(rule.predecessor), change(rule.successor), rule.condition)
                  for rule in system.productions)
    return replace(system, axiom=change(system.axiom), productions=rules, alphabet=())


def renamed(names: Mapping[str, str]) -> Callable[[Module], Module]:
    return lambda module: replace(module, symbol=names.get(module.symbol, module.symbol))


@given(systems(), st.permutations(("B", "C", "wall", "a_r")))
def test_renaming_commutes_with_deriving(system: LSystem, new: list[str]) -> None:
    rename = renamed(dict(zip(SYMBOLS, new, strict=True)))
    other = rewritten(system, lambda word: tuple(map(rename, word)), rename)
    assert [modules(w) for w in derive(other, STEPS)] == [list(map(rename, w)) for w in derive(system, STEPS)]


def mirrored(word: Iterable[Module]) -> tuple[Module, ...]:
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
