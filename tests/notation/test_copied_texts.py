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
    ("axiom: A\nA -> B\nB =", 'There is nothing after the "="', 'to erase B, type "B -> *"'),
    ("axiom: A\nA -> B\nB ->", "There is nothing after the arrow", 'To erase B, write "ε" or "*"'),
    ("axiom: A\nA=F[+A]FA", "This is not an arrow", 'Type "A -> F[+A]FA".'),
    ("axiom: F\nF = F+G-", "This is not an arrow", 'Type "F -> F+G-".'),
    ("axiom: F\nF=F+F", 'The constant "F" cannot be calculated from itself', 'A production reads "F -> ..."'),
]
"""Texts, what is said of them, and what to type instead."""


@pytest.mark.parametrize(("text", "message", "hint"), REFUSED)
def test_what_other_programs_take_is_refused_with_what_to_type(text: str, message: str, hint: str) -> None:
    with pytest.raises(LSystemError) as found:
        read(text)
    assert found.value.message == message
    assert hint in (found.value.hint or "")


@pytest.mark.parametrize("text", [
    "angle: 60\naxiom: F\nF -> F \\ F / F", "axiom: A(1)\nA(x) -> F(x) A(x*2)", "axiom: F\nF -> +++F;(2)F",
    "alphabet: 2\naxiom: F\nF -> 2 F", "axiom: A\nA -> B\nB -> *", "axiom: A\nA -> F[+A]F A"])
def test_what_is_advised_is_read_without_a_note(text: str) -> None:
    assert read(text).notes == ()


@pytest.mark.parametrize("text", ["axiom=F\nF=F[+F]F\nangle=30", "Angle 30\nAxiom F\nF=F+F"])
def test_where_fractint_is_only_guessed_its_angle_is_told_in_degrees(text: str) -> None:
    assert read(text).angle == 12
    told = '"Angle 30" is a turn of 12 degrees: 360 divided by 30. For 30 degrees write "angle: 30"'
    assert any(note.startswith(told) for note in read(text).notes)
    assert read("Tree {\nAngle 30\nAxiom F\nF=F+F\n}").notes == ("Read as fractint.",)


def test_a_segment_with_a_number_behind_it_is_noted() -> None:
    assert [note for note in read("axiom: F\nF -> F3+f2").notes if "draws nothing" in note] == [
        f'"{name}" is read as one symbol, which draws nothing; {name[0]} with a value is typed {name[0]}({name[1:]}), and a '
        f"turn that is repeated is written out, as in {name[0]}+++." for name in ("F3", "f2")]
    for declared in ("axiom: F\nF -> F3\nF3 -> F", "alphabet: F3\naxiom: F\nF -> F3"):
        assert not any("draws nothing" in note for note in read(declared).notes)


def test_a_model_of_l_py_is_told_what_to_leave_out_and_what_to_keep() -> None:
    model = "Axiom: A\nproduction:\nA --> ABA\nB --> BBB\nhomomorphism:\nA --> F\nB --> f\nendlsystem\n"
    with pytest.raises(LSystemError) as found:
        read(f"{model}###### INITIALISATION ######\n\n__lpy_code_version__ = 1.1\n")
    assert 'Leave out all from "INITIALISATION" on, where that word stands' in (found.value.hint or "")
    assert "a constant, also one that is set behind that word, as #define" in (found.value.hint or "")
    assert len(read(model, "cpfg").productions) == 2
