"""Fractint's turtle: two directions, a hand that may be reversed, a step that is multiplied, colours by number."""

from __future__ import annotations

import cmath
import math
from itertools import chain

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, draw, read
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.scene import OWN, Scene
from lsys_kit.geometry.turtle.instancing import draw_instanced
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import trace_in_space


def scene(text: str, parts: int) -> Scene:
    """What a turtle draws that follows a word, where a full turn has so many parts."""
    word = derive(read(f"Angle {parts}\nAxiom {text}", "fractint"), 0)[0]
    return place_path(trace(word), 360 / parts, 0)


COMMANDS = [
    "F",
    "G",
    "D",
    "M",
    "+",
    "-",
    "|",
    "!",
    "A",
    ("\\", 30),
    ("\\", 12.5),
    ("/", 90),
    ("@", 0.5),
    ("@I", 0.5),
    ("@Q", 2),
    ("@IQ", 2),
    ("@QI", 3),
    ("C", 9),
    ("<", 250),
    (">", 3),
]


def plain_turtle(word, parts):
    """The program's turtle, read literally: parts of a turn for one direction, degrees for the other; its y grows downwards."""
    at, angle, real, size, reverse, colour, stack, strokes = 0j, 0, 0.0, 1.0, 1, 15, [], []
    for symbol, x in word:
        if symbol in "FGDM":
            degrees = 360 * angle / parts if symbol in "FG" else real
            to = at + size * cmath.exp(1j * math.radians(degrees))
            if symbol in "FD":
                strokes.append((at.real, -at.imag, to.real, -to.imag, colour))
            at = to
        elif symbol in "+-":
            angle = (angle + (reverse if symbol == "-" else -reverse)) % parts
        elif symbol == "|":
            angle = (angle + parts // 2) % parts
        elif symbol in "\\/":
            real += reverse * x if symbol == "/" else -reverse * x
        elif symbol == "!":
            reverse = -reverse
        elif symbol[0] == "@":
            root = math.sqrt(x) if "Q" in symbol else x
            size *= 1 / root if "I" in symbol else root
        elif symbol == "C":
            colour = x % 256
        elif symbol in "<>":
            colour = (colour + (x if symbol == "<" else -x)) % 256 or (1 if symbol == "<" else 255)
        elif symbol == "[":
            stack.append((at, angle, real, size, reverse, colour))
        elif symbol == "]":
            at, angle, real, size, reverse, colour = stack.pop()
    return np.array(strokes).reshape(-1, 5)


modules = st.sampled_from([command if isinstance(command, tuple) else (command, None) for command in COMMANDS])
flat = st.lists(modules, max_size=12)
branched = st.recursive(
    flat,
    lambda inner: st.lists(st.one_of(inner, inner.map(lambda word: [("[", None), *word, ("]", None)])), max_size=4).map(
        lambda words: [*chain(*words)]
    ),
    max_leaves=10,
)


@given(branched, st.integers(3, 50))
def test_the_turtle_draws_as_fractint(word, parts):
    text = "".join(symbol + ("" if x is None else str(x)) for symbol, x in word)
    found, expected = scene(f"A{text}", parts).segments, plain_turtle(word, parts)
    assert np.allclose(found.ends, expected[:, :4], atol=1e-9 * (1 + np.abs(expected).max(initial=0)))
    assert np.where(found.colours == OWN, 15, found.colours).tolist() == expected[:, 4].tolist()


@given(branched, st.integers(3, 50))
def test_the_turtle_in_space_draws_the_same(word, parts):
    text = "".join(symbol + ("" if x is None else str(x)) for symbol, x in word)
    whole = trace_in_space(derive(read(f"Angle {parts}\nAxiom A{text}", "fractint"), 0)[0])
    ends = scene(f"A{text}", parts).segments.ends
    assert np.allclose(whole.segments.ends[:, [0, 2, 3, 5]], ends, atol=1e-9 * (1 + np.abs(ends).max(initial=0)))
    assert np.allclose(whole.segments.ends[:, [1, 4]], 0, atol=1e-9 * (1 + np.abs(ends).max(initial=0)))


@pytest.mark.parametrize(
    ("text", "steps", "at_once"),
    [
        ("Angle 5\nAxiom FA\nA=[+F!A]@.8|F<1[-A]", 9, True),
        ("Angle 34\nAxiom FX\nF=\nX=----F!X!++++++++F!X!----", 9, True),
        ("Angle 4\nAxiom F(A)F\nA=F(A)+A\nF=", 9, True),
        ("Angle 4\nAxiom D\nD=\\42!D!/84!D!\\42", 9, False),
        ("Angle 8\nAxiom X\nX=F+D[X]\\30-X", 9, False),
    ],
)
def test_what_is_drawn_at_once_is_what_a_turtle_draws(text, steps, at_once):
    derivation = derive(read(text, "fractint"), steps)
    pieces = draw_instanced(derivation, steps, float(derivation.states.system.angle))
    assert (pieces is not None) == at_once
    walked = place_path(trace(derivation[-1]), float(derivation.states.system.angle), 0)
    assert np.allclose(scene_of(derivation, None).segments.ends, walked.segments.ends, atol=1e-9 * 3**steps)


def test_a_bare_command_has_the_number_0():
    assert scene("F\\F/FC<F@F", 4).segments.ends.tolist()[-1] == [4, 0, 4, 0]


def test_a_turn_round_is_no_half_turn_where_the_angle_does_not_allow_it():
    assert np.allclose(scene("F|F", 6).segments.ends[1], [1, 0, 0, 0])
    assert np.allclose(scene("F|F", 5).segments.ends[1], scene("F--F", 5).segments.ends[1])
    assert np.allclose(scene("F!|F", 5).segments.ends[1], scene("F--F", 5).segments.ends[1])


def test_any_character_may_be_a_symbol_and_none_is_told_to_be_unknown():
    assert scene('F"=?'.replace("=", ",") + "~(A.4)#&^", 4).unknown == ()


def test_the_koch_curve_lies_as_in_fractint():
    assert repr(draw(read("Angle 6\nAxiom F--F--F\nF=F+F--F+F"), 3)) == "192 segments, width 27, height 31.18"
