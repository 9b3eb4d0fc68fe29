"""Which notation a text is written in is found out from the text, and told."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS, recognise
from lsys_kit.notation.syntax.systems import lacking
from lsys_kit.notation.write import write
from tests.plants import plant

FOLDER = Path(__file__).parents[1] / "listings"
LISTINGS = [
    (listing["file"], listing["notation"])
    for listing in tomllib.loads((FOLDER / "listings.toml").read_text(encoding="utf-8"))["listing"]
    if listing["notation"] in DIALECTS
]
ALIKE = "003-parameters.grogra.txt"
"""One production that two notations spell alike."""
WRITTEN = [(id, name) for name, notation in DIALECTS.items() for id in systems() if not lacking(notation, system(id))]
SHORT = {
    "abop": [
        "",
        "axiom: A",
        "A -> B",
        "axiom: A\nA -> A B",
        "axiom: F\nF -> F[+F]F[-F]F",
        "axiom: F\nF → F F",
        "axiom: A\nA --> B",
        "F ::= F+F",
        "p1: a -> b",
        "p_1: a_r \\rightarrow a_l b_r,\np_2: a_l \\rightarrow a_r",
        "s < a > \\rightarrow a s,",
        "axiom: A(1)\nA(x) : x > 1 -> A(x-1)",
        "k = 3\naxiom: A(k)\nA(x) -> B(x)",
        "axiom: F\nF -> F(d)",
        "axiom: A # B",
        "axiom: A\nA -> B : 0.5\nA -> C : 0.5",
        "axiom: A\nignore: + -\nB < A -> C",
        "axiom: A\ndecomposition:\nA -> B",
        "Axiom: F\nF -> FF",
        "Axiom = F\nF -> FF",
        "axiom: A\nA -> repeat(3) <F>",
        "axiom: A /* #define */",
    ],
    "plant-string": [
        "I -> I[A]A(I)A",
        "Axiom: I\nI -> I(I)[I]",
        "Axiom = I\nProductions:\nI -> I(A)\nA -> I",
        "Number of productions: 1\nI -> II",
        "Axiom: I\nI -> II\nStage 1 string: II",
        "turtle: abop\nAxiom: F\nF -> FF",
    ],
    "cpfg": [
        "#define a 1\nAxiom: F\nF --> FF",
        "Lsystem: 1\nAxiom: F\nF --> F",
        "Axiom: F\nF --> FF",
        "Axiom: A(1)\nA(x) : x>1 --> A(x-1)B(x)",
        "Axiom: A\nhomomorphism:\nA --> F",
        "derivation length: 3\nAxiom: F\nF --> FF",
    ],
    "grogra": [
        "* # F a,\na # F [ RU45 a ] a",
        "\\angle 60,\n* # F",
        "a # b",
        "* -> F a,\na -> F",
        "a # F ?0.5",
        "\\var x uniform 0 1,\n* # F",
        "(t<6) k(t) # k(t+1)",
        "* → F a, a → RU(30) F a",
        "a -> &(3) < F >",
    ],
    "fractint": [
        "Angle 6\nAxiom F\nF=F+F",
        "Koch {\n  angle 6\n  axiom f\n  f=f+f\n  }",
        "Axiom F",
        "angle=6",
        "A { Angle 8 ; -> eighths\nAxiom F->5\n}",
        "; Dear all -> look:\nThis: is it {\nAngle 4\n}",
        "comment {\n  axiom: A\n  A -> B\n}\nA {\n  Angle 4\n}",
    ],
    "mathematica": [
        "LRule[LEFT[], PRED[a], RIGHT[], SUCC[b]]",
        "AXIOM[a]",
        "Axiom: a\nRules: a -> b",
        "Axiom: a\n\nRules: < a > -> b",
        "axiom = AXIOM[a[1]];\nlrules = LRULES[LRule[LEFT[], PRED[a[i_ /; i < 3]], RIGHT[], SUCC[a[i+1]]]];",
    ],
}
"""A line or three in each notation."""


@pytest.mark.parametrize(("file", "notation"), [row for row in LISTINGS if row[0] != ALIKE])
def test_the_notation_of_a_listing_is_recognised(file: str, notation: str) -> None:
    assert recognise((FOLDER / file).read_text(encoding="utf-8")).name == notation


@pytest.mark.parametrize("notation", [name for name in ("abop", "grogra") if name in DIALECTS])
def test_one_listing_means_the_same_in_two_notations(notation: str) -> None:
    text = (FOLDER / ALIKE).read_text(encoding="utf-8")
    axiom = {"abop": "axiom: a(2, 3)", "grogra": "\\axiom a(2, 3),"}[notation]
    assert [str(rule) for rule in read(f"{axiom}\n{text}", notation).productions] == ["a(x,y) -> F(x^3 + 10)b(2 * y)"]


@pytest.mark.parametrize(("id", "notation"), WRITTEN)
def test_the_notation_in_which_a_system_was_written_is_recognised(id: str, notation: str) -> None:
    text = write(system(id), notation)
    assert recognise(text).name == notation
    assert read(text) == DIALECTS[notation].translated(system(id))


@pytest.mark.parametrize(("notation", "text"), [(name, text) for name in DIALECTS for text in SHORT[name]])
def test_the_notation_of_a_short_text_is_recognised(notation: str, text: str) -> None:
    assert recognise(text).name == notation


@pytest.mark.parametrize("notation", DIALECTS)
def test_what_was_recognised_is_told_once(notation: str) -> None:
    text = write(plant(notation), notation)
    told = [f"Read as {notation}."] if notation != "abop" else []
    assert [note for note in read(text).notes if note.startswith("Read as")] == told
    assert not any(note.startswith("Read as") for note in read(text, notation).notes)


def test_a_mistake_is_that_of_the_recognised_notation() -> None:
    text = "Axiom: I\nI -> I(A]I(I)"
    with pytest.raises(LSystemError) as named:
        read(text, "plant-string")
    with pytest.raises(LSystemError) as found:
        read(text + "\nA -> A(I)A(A)")
    assert found.value.message == named.value.message == 'This "]" closes nothing'
    assert "can be read" not in str(found.value)


def test_a_mistake_may_be_none_in_another_notation() -> None:
    with pytest.raises(LSystemError) as found:
        read("Axiom: I\nI -> I(L)F")
    assert found.value.message == 'I do not know the name "L"'
    assert (found.value.hint or "").endswith('As plant-string it can be read: read(text, "plant-string").')
    assert read("Axiom: I\nI -> I(L)F", "plant-string").productions


@pytest.mark.parametrize("text", ["axiom: A\nA -> A(t)", "axiom: A\nA -> B(t+1)"])
def test_a_slip_of_the_kits_own_notation_is_not_called_another(text: str) -> None:
    with pytest.raises(LSystemError) as found:
        read(text)
    assert "can be read" not in str(found.value)
