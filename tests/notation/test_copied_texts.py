"""Systems as other programs and pages print them: what is read otherwise is noted, and a refusal says what to type."""

from __future__ import annotations

import pytest

from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read

REFUSED = [
    ("axiom: F\nF -> >F<F", 'I did not expect ">" here', 'For rolls type "\\" and "/"'),
    ("axiom: X\nX -> F[<+X]", 'I did not expect "<" here', "give F a length: A(x) -> F(x) A(x*2)"),
    ("axiom: F\nF -> 3+F", "A number is not a module", 'for three turns type "+++"'),
    ("axiom: 1F\nF -> 2F[+F]", "A number is not a module", 'for the colour 2, ";(2)"'),
    ("axiom: A\nA -> B\nB ->", "There is nothing after the arrow", 'To erase B, write "ε" or "*"'),
]
"""Texts, what is said of them, and what to type instead."""


@pytest.mark.parametrize(("text", "message", "hint"), REFUSED)
def test_what_other_programs_take_is_refused_with_what_to_type(text: str, message: str, hint: str) -> None:
    with pytest.raises(LSystemError) as found:
        read(text)
    assert found.value.message == message
    assert hint in (found.value.hint or "")


@pytest.mark.parametrize(
    "text",
    [
        "angle: 60\naxiom: F\nF -> F \\ F / F",
        "axiom: A(1)\nA(x) -> F(x) A(x*2)",
        "axiom: F\nF -> +++F;(2)F",
        "alphabet: 2\naxiom: F\nF -> 2 F",
        "axiom: A\nA -> B\nB -> *",
        "axiom: A\nA -> F[+A]F A",
    ],
)
def test_what_is_advised_is_read_without_a_note(text: str) -> None:
    assert read(text).notes == ()


@pytest.mark.parametrize("text", ["axiom F\nF=F[+F]F\nangle 30", "Angle 30\nAxiom F\nF=F+F"])
def test_where_fractint_is_only_guessed_its_angle_is_told_in_degrees(text: str) -> None:
    assert read(text).angle == 12
    told = '"Angle 30" is a turn of 12 degrees: 360 divided by 30. For 30 degrees write "angle: 30"'
    assert any(note.startswith(told) for note in read(text).notes)
    assert read("Tree {\nAngle 30\nAxiom F\nF=F+F\n}").notes == ("Read as fractint.",)


@pytest.mark.parametrize("text", ["axiom=F\nF=F[+F]F\nangle=30", "angle = 30\naxiom = VF\nV = [+F]V\nF = FF"])
def test_an_angle_behind_an_equals_sign_is_in_degrees(text: str) -> None:
    """As home pages have it; a number of parts has braces around it, or no such sign before it."""
    assert read(text).angle == 30
    assert read(f"Tree {{\n{text}\n}}").angle == 12


@pytest.mark.parametrize(
    ("text", "typed"), [("axiom: F\nF -> F3+f2", {"F3": "F(3)", "f2": "f(2)"}), ("axiom: F\nF -> C0F[+F]F", {"C0F": "C(0)"})]
)
def test_a_name_with_a_number_in_it_is_noted(text: str, typed: dict[str, str]) -> None:
    assert [note for note in read(text).notes if "draws nothing" in note] == [
        f'"{name}" is read as one symbol, which draws nothing. {name[0]} with a value is typed {value}; what is repeated is '
        'written out, as in "+++".'
        for name, value in typed.items()
    ]
    name = next(iter(typed))
    for declared in (f"axiom: F\nF -> {name}\n{name} -> F", f"alphabet: {name}\naxiom: F\nF -> {name}"):
        assert not any("draws nothing" in note for note in read(declared).notes)


@pytest.mark.parametrize(
    "text",
    [
        "axiom = F++F++F\nF -> F-F++F-F\nangle = 60",
        "Axiom = F++F++F\nF -> F-F++F-F\nAngle = 60°",
        "axiom: F++F++F\nF -> F-F++F-F\nangle: 60 degrees",
        "angle = 60 deg\naxiom = F++F++F\nF -> F-F++F-F",
    ],
)
def test_settings_may_have_the_sign_of_constants_and_angles_their_unit(text: str) -> None:
    assert read(text) == read("angle: 60\naxiom: F++F++F\nF -> F-F++F-F")


def test_apostrophes_around_a_word_are_no_quotation_marks() -> None:
    note = "The two ' around {} are read as commands of the turtle, not as quotation marks: words are typed without any."
    assert read("axiom = 'F'\nF -> F[+F]").notes == (note.format("F"),)
    assert read("axiom: F\nF -> 'F+F'").notes == (note.format("F+F"),)
    for meant in ("axiom: F\nF -> 'F", "axiom: F\nF -> 'F'F'", "axiom: F\nF -> ''"):
        assert read(meant).notes == ()


def test_a_constant_that_is_used_nowhere_is_noted() -> None:
    assert read("k = 2\naxiom: F\nF -> F[+F]").notes == ('The constant "k" is used nowhere.',)
    assert read("delta = 22.5\naxiom: F\nF -> F[+F]").notes == (
        'The constant "delta" is used nowhere. For the angle of the turns type "angle: 22.5".',
    )
    assert read("k = 2\nm = k\nangle: 9\naxiom: F\nF -> F(m)").notes == ()


ANGLE_OF_CPFG = (
    "cpfg keeps the angle by which + turns in a file of the view. It is 90 degrees here; for 22.5 put the line "
    '"/* angle: 22.5 */" above the axiom.'
)


def test_what_cpfg_keeps_in_another_file_is_told() -> None:
    plant = "Lsystem: 1\nAxiom: F\nF --> F[+F]F\nendlsystem"
    assert read(plant).notes == ("Read as cpfg.", ANGLE_OF_CPFG)
    for told in (plant.replace("Axiom", "/* angle: 22.5 */\nAxiom"), plant.replace("+", "+(30)")):
        assert read(told).notes == ("Read as cpfg.",)


def test_productions_of_cpfg_may_have_labels() -> None:
    """As those of its first versions have; the labels do not make a text one of the book's."""
    labelled = "#define T 7\nLsystem: 1\nAxiom: a(1)\np1: a(t) : t<T --> F(1)a(t+1)\np2: a(t) : t==T --> F(2)\nendlsystem"
    assert read(labelled) == read(labelled.replace("p1: ", "").replace("p2: ", ""))
    assert read(labelled).notation == "cpfg"
