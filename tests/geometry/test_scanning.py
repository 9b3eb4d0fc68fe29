"""Long words are drawn by scans along their branches as they are drawn module by module."""

from __future__ import annotations

import re
from dataclasses import fields
from fractions import Fraction
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, ModelValueError, book_systems, derive, limits, read, system, systems
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.columnar import ColumnarSteps, ColumnWord
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle import scanning, turtle
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode, in_plane
from lsys_kit.geometry.turtle.plane import PLANE_HANDLERS, PlaneTurtle, place_path, trace
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem

ALWAYS, NEVER = -1, 10**9
COMMANDS = {
    "abop": "F F(2) f f(0.5) G g + - +(33) -(7.5) | [ ] [ ] ! !(3) # #(2) ; ;(18) ' , { } . ~ L @o @c(3) @O(2) @D(2) @D "
    "@Di(0.5) @B(3,2) @L(1) A",
    "grogra": "F F(2) F*(2) f + - +(33) RU(10) [ ] [ ] L(2) L+(1) L*(0.5) L D(3) D+(1) D*(2) D P(4) P V(2) A",
    "fractint": "F F G + - | ! [ ] [ ]",
}
IN_SPACE = {"abop": " & ^(20) / \\(70) & ^ /(90)", "grogra": " RL(20) RH(70) RL(-90) RH(45)"}


def drawn(word: Word, least: int) -> tuple[Scene, int]:
    """A word as it is drawn by scans from some length on, and how often it was."""
    times = []

    def interpreted(*given: object) -> bool:
        times.append(scanning.interpreted(*given))  # type: ignore[arg-type]
        return times[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(turtle, "interpreted", interpreted)
        patch.setattr(turtle, "arrays_pay", lambda size, _: size > least)
        patch.setattr(scanning, "LEAST_OF_AN_ORDER", 0)
        patch.setattr(scanning, "LEAST_OF_A_SHAPE", 0)
        given = word.states.system
        if drawing_mode(given) is DrawingMode.PLANE:
            return place_path(trace(word), float(given.angle), float(given.heading)), sum(times)
        return trace_in_space(word), sum(times)


def agree(word: Word) -> None:
    """A word is drawn by scans, and as it is drawn module by module, to a billionth of its extent."""
    (one, scanned), (other, _) = (drawn(word, least) for least in (ALWAYS, NEVER))
    assert scanned == 1
    extent = max(1.0, np.abs(np.array(other.corners)).max(initial=0))
    for ours, theirs in (
        (getattr(scene, name) for scene in (one, other)) for name in ("segments", "polygons", "discs", "labels")
    ):
        for field in fields(ours):
            found, expected = getattr(ours, field.name), getattr(theirs, field.name)
            if field.name == "states":  # of a word in columns the first module of a kind stands for all
                found, expected = ([word.states.modules[each].symbol for each in states] for states in (found, expected))
            if isinstance(expected, tuple | list):
                assert found == expected
            else:
                assert (found.shape, found.dtype) == (expected.shape, expected.dtype)
                assert np.abs(found - expected).max(initial=0) <= 1e-9 * max(extent, np.abs(expected).max(initial=0)), (
                    field.name
                )
    assert one.unknown == other.unknown


def word_of(text: str, dialect: str = "abop") -> Word:
    """A word of commands, separated by blanks, whose brackets may be open."""
    found = (re.fullmatch(r"([^(]+|\()(?:\((.*)\))?", each) for each in text.split())
    axiom = [Pattern(each[1], tuple(map(_number, (each[2] or "").split(",") if each[2] else ()))) for each in found if each]
    return derive(LSystem(tuple(axiom), (), angle=Fraction("25.7"), turtle=dialect), 0)[0]


def in_columns(word: Word) -> ColumnWord:
    """The same word in columns."""
    return ColumnarSteps(word.states).word(word)


def _number(text: str) -> Number:
    return Number(int(text) if text.lstrip("-").isdigit() else float(text) if "e" in text else Fraction(text))


@given(st.sampled_from([*COMMANDS]), st.booleans(), st.integers(1, 400), st.integers(0, 10**6))
def test_any_commands(dialect: str, space: bool, size: int, seed: int) -> None:
    """With brackets and polygons that nothing closes, and such as close nothing; in pieces of any number."""
    chosen = Random(seed).choices((COMMANDS[dialect] + IN_SPACE.get(dialect, "") * space).split(), k=size)
    word = word_of(f"F {' '.join(chosen)}", dialect)
    if drawn(word, ALWAYS)[1]:
        agree(word)
        agree(in_columns(word))


def test_words_in_columns() -> None:
    """With exact values, long ones and doubles of their own, which shapes and labels show."""
    text = "F(1/3) [ +(7/2) F(1/18446744073709551629) @c(5/3) ] !(2) F(0.1) [ -(12) F(3) @L(7) ; F(5/7) ] F*(3) @B(2,1) @B(3,2)"
    word = word_of(text)
    assert isinstance(in_columns(word), ColumnWord)
    agree(in_columns(word))
    agree(in_columns(word_of("F F(2) L*(1/2) [ RU(30) F D*(3) F(7) ] RU(11) F L*(5) F", "grogra")))
    with pytest.raises(ModelValueError, match="cannot be drawn: a value is too large to draw"):
        drawn(in_columns(word_of("F(1) [ F(2) ] F(1e60)")), ALWAYS)


@pytest.mark.parametrize(("dialect", "space"), [(name, space) for name in COMMANDS for space in (False, True)])
def test_a_long_word(dialect: str, space: bool) -> None:
    commands = (COMMANDS[dialect] + IN_SPACE.get(dialect, "") * space).split()
    word = word_of(f"F {' '.join(Random(7).choices(commands, k=3_000))}", dialect)
    assert in_plane(word.states.system) is not (space and dialect in IN_SPACE)
    agree(word)


def test_steps_through_colours() -> None:
    """As far as the ramp goes."""
    agree(word_of("F ' F ' F [ ' ' ' ' ' ' ' F , F ] F , F , , F ' F ;(20) F ; [ , , , , , , F ; F ] F"))


def test_a_mirrored_roll_changes_sides() -> None:
    agree(word_of(r"F + F [ /(180) + F - F ] + F \(180) [ + F /(540) + F ] + F /(360) + F"))


def test_a_surface_is_drawn_where_it_is_expected() -> None:
    agree(derive(read("axiom: F ~ L F [ + ~ F L ] ~ ~ A F L ~\nA -> A"), 0)[0])


@pytest.mark.slow
@pytest.mark.parametrize("name", [*systems(), *book_systems()])
def test_the_systems_of_the_catalogue(name: str) -> None:
    given = system(name)
    if drawing_mode(given) is DrawingMode.FILAMENT:
        pytest.skip("it is drawn as cells in a row")
    for steps in (1, 3):
        word = derive(given, steps)[-1]
        if drawn(word, ALWAYS)[1]:
            agree(word)


@pytest.mark.parametrize(
    "text", ["F $ F", "@Ts(0.1) F F", "F @M(1,2,3) F", "@Gs F @Gc F @Ge", "!(-1) F", "@D(-2) F", ";(3) F ; F", "A"]
)
def test_what_asks_for_more_goes_module_by_module(text: str) -> None:
    word = derive(read(f"axiom: {text}"), 0)[0]
    assert drawn(word, ALWAYS)[1] == 0
    assert drawn(word, ALWAYS)[0].unknown == drawn(word, NEVER)[0].unknown


@pytest.mark.parametrize("rule", ["A -> F [ + A ]", "A -> F A @o @o"])
def test_deep_nesting_and_many_shapes_go_module_by_module(rule: str) -> None:
    word = derive(read(f"axiom: A\n{rule}"), 40)[-1]
    assert not scanning.interpreted(PlaneTurtle(1, 1.0), word, PLANE_HANDLERS, lambda each: each)


def test_limits_are_kept() -> None:
    word = derive(read("axiom: [[[[[F]]]]]"), 0)[0]
    with limits(brackets=4), pytest.raises(ModelLimitError, match="More than 4 brackets are open at once"):
        drawn(word, ALWAYS)
    with limits(bytes=1_000), pytest.raises(ModelLimitError, match="The word was not drawn: it would take 5,500 bytes"):
        drawn(word, ALWAYS)


def test_a_value_that_cannot_be_drawn_is_named() -> None:
    word = derive(read("axiom: F(1e60)"), 0)[0]
    with pytest.raises(ModelValueError, match="cannot be drawn: a value is too large to draw"):
        drawn(word, ALWAYS)
    grows = derive(read("axiom: #(1e49) #(1e49) @Di(1e30) @Di(1e30) F"), 0)[0]
    with pytest.raises(ModelValueError, match="The turtle's scale grows too large to draw: 1e"):
        drawn(grows, ALWAYS)


@pytest.mark.slow
def test_a_long_word_is_drawn_by_scans() -> None:
    word = derive(read("angle: 25.7\naxiom: F\nF -> F[+F]F[-F]F : 0.5\nF -> F[+F]F : 0.5"), 8, seed=3)[-1]
    assert len(word) > scanning.LEAST
    (one, scanned), (other, _) = drawn(word, scanning.LEAST), drawn(word, NEVER)
    assert scanned == 1
    assert np.abs(one.segments.ends - other.segments.ends).max() < 1e-9 * other.height
