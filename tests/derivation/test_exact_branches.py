"""Right contexts that name a branch and may say that it ends there, as cpfg's do: its `A > [B]` is `A > [B ε]` here."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.derivation.derive import derive
from lsys_kit.notation.analysis.lint import warnings
from lsys_kit.notation.model.modules import END, Pattern
from lsys_kit.notation.model.system import BRANCHES, LSystem, Production, symbols
from lsys_kit.notation.read import read
from lsys_kit.notation.write import write
from tests.derivation import reference
from tests.derivation.random_systems import systems_with


def matches(right: str, word: str, ignored: str = "", branches: str = "any") -> bool:
    """Whether the first module of a word has a right context; `.` stands for the end of a branch."""
    context = tuple(Pattern(END if letter == "." else letter) for letter in right)
    rule = Production((Pattern("A"),), (Pattern("X"),), right=context)
    system = LSystem(read(f"axiom: {word}").axiom, (rule,), ignored=tuple(ignored), branches=branches)
    return derive(system, 1)[-1][0].symbol == "X"


@pytest.mark.parametrize(
    ("right", "word", "expected"),
    [("[B]C", "A[B D]C", True), ("[B.]C", "A[B D]C", False), ("[B.]C", "A[B]C", True), ("[B D.]C", "A[B D]C", True)],
)
def test_a_branch_may_go_on_unless_its_end_is_named(right: str, word: str, expected: bool) -> None:
    assert matches(right.replace(" ", ""), word) is expected


def test_a_signal_leaves_a_branch_only_when_nothing_else_is_on_it() -> None:
    assert matches("[J.]", "A[J]")
    assert not matches("[J.]", "A[J F]")
    assert matches("[J]", "A[J F]")


def test_a_branch_that_does_not_end_is_passed_for_one_that_does() -> None:
    assert matches("[B.]C", "A[B D][B]C")
    assert not matches("[B.]C", "A[B D][B B]C")


def test_side_branches_and_ignored_symbols_do_not_go_on_with_a_branch() -> None:
    assert matches("[B.]", "A[B[D]]")
    assert matches("[B.]", "A[B+]", ignored="+")
    assert not matches("[B.]", "A[B+]")
    assert not matches("[B.]", "A[B[D]E]")


@pytest.mark.parametrize(
    ("right", "word", "expected"),
    [
        ("[B]", "A[B]", "any next"),
        ("[D]", "A[B][D]", "any"),
        ("[B][D]", "A[B][D]", "any next"),
        ("[D]C", "A[D]C", "any next"),
        ("[B]", "A[B][D]C", "any next"),
        ("[B]C", "A[B][D]C", "any next"),
        ("[B][D]", "A[B][C][D]", "any"),
        ("[B.]", "A[B C][B]", "any"),
        ("C[D]", "A[B]C[D]", "any next"),
        ("C[D]", "A C[B][D]", "any"),
        ("[B[D]]", "A[B[C][D]]", "any"),
        ("[B]", "A+[B]", "any next"),
        ("C", "A[B]C", "any next"),
        ("B", "A[B]C", "flat"),
        ("B C", "A[B]C", "flat"),
        ("D", "A[[D]]", "flat"),
        ("", "A", "any next flat"),
        ("C", "A[]+C", "any next flat"),
        ("B D", "A[B[D]]", "flat"),
    ],
)
def test_a_named_branch_is_any_of_those_there_or_the_next(right: str, word: str, expected: str) -> None:
    """And where the word is read flat, no branch is named."""
    found = [branches for branches in BRANCHES if matches(right.replace(" ", ""), word, "+", branches)]
    assert found == expected.split()


def test_a_flat_right_context_goes_on_beyond_the_end_of_its_branch() -> None:
    """And a left context follows the branches in any case."""
    system = read("branches: flat\naxiom: [A]B C\nA > B -> D\nA < B -> E\nB < C -> F")
    assert str(derive(system, 1)[-1]) == "[D]B F"


@given(systems_with("context"))
def test_which_branch_is_named_is_said_only_where_it_matters(system: LSystem) -> None:
    """Where no branch is named, a system is the same as one in which any could be."""
    for branches in BRANCHES:
        changed = replace(system, branches=branches)
        named = any(module.symbol == "[" for rule in system.productions for module in rule.right)
        assert (changed.branches == branches) == (
            branches == "any" or named or (branches == "flat" and any(rule.right for rule in system.productions))
        )
        assert read(write(changed)) == changed


def test_the_ends_of_branches_on_branches_are_named_too() -> None:
    assert matches("[B[C.].]", "A[B[C]]")
    assert not matches("[B[C.].]", "A[B[C D]]")
    assert not matches("[B[C.].]", "A[B[C]D]")
    assert matches("[B[C.]]", "A[B[C]D]")


def test_an_empty_branch_is_one_that_ends_at_once() -> None:
    assert matches("[.]C", "A[]C")
    assert not matches("[.]C", "A[B]C")
    assert matches("[]C", "A[B]C")


def test_the_end_of_a_branch_is_no_module() -> None:
    rule = Production((Pattern("A"),), (), right=tuple(map(Pattern, ("[", "B", END, "]"))))
    system = LSystem(read("axiom: A[B]").axiom, (rule,))
    assert END not in symbols(system)
    assert warnings(system) == []


def with_ends(word: tuple[Pattern, ...], ends: Iterator[bool], end: str) -> tuple[Pattern, ...]:
    """A word with something more at the ends of some of its branches."""
    found: list[Pattern] = []
    for module in word:
        if module.symbol == "]" and next(ends):
            found.append(Pattern(end))
        found.append(module)
    return tuple(found)


@pytest.mark.slow
@given(systems_with("context"), st.integers(0, 2**16))
def test_branches_with_and_without_their_ends_match_as_defined(system: LSystem, chosen: int) -> None:
    ends = (bool(chosen >> place & 1) for place in itertools.cycle(range(16)))
    rules = tuple(replace(rule, right=with_ends(rule.right, ends, END)) for rule in system.productions)
    axiom = (*system.axiom, *with_ends(system.axiom, ends, "F"))
    system = replace(system, axiom=axiom, productions=rules)
    for word, expected in zip(derive(system, 3), reference.words(system, 3)[0], strict=True):
        assert [(module.symbol, module.arguments) for module in word] == expected
