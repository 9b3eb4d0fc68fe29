"""Greek letters, which the book has for constants and modules, are read as names."""

from __future__ import annotations

import sys

import pytest

from lsys_kit.errors import ModelNameError, ModelSyntaxError
from lsys_kit.notation.read import read
from lsys_kit.notation.syntax.text.transcription import GREEK, name_of
from tests.timing import spent


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("α = 25\naxiom: F(α)\nF(x) -> F(x*α)", "alpha = 25\naxiom: F(alpha)\nF(x) -> F(x * alpha)"),
        ("α_1 = 25\naxiom: F(α_1)", "alpha_1 = 25\naxiom: F(alpha_1)"),
        ("axiom: αβ\nα -> β\nβ -> αβ", "axiom: alpha beta\nalpha -> beta\nbeta -> alpha beta"),
        ("axiom: Aα\nα -> Aα", "axiom: A alpha\nalpha -> A alpha"),
        ("ω : A(1)\np1 : A(λ) : λ > 2 → B(λ)", "axiom: A(1)\nA(lambda) : lambda > 2 -> B(lambda)"),
        ("n=5, δ=25.7°\nF\nF → F[+(δ)F]", "delta = 25.7\nangle: 25.7\nsteps: 5\naxiom: F\nF -> F[+(delta)F]"),
        ("n=5, δ=25.7°\nF\nF → F[+F]", "angle: 25.7\nsteps: 5\naxiom: F\nF -> F[+F]"),
        ("\\omega : \\alpha\np_1 : \\alpha \\rightarrow \\alpha\\beta", "axiom: alpha\nalpha -> alpha beta"),
        ("axiom: A\nA -> ε", "axiom: A\nA -> ε"),
    ],
)
def test_a_greek_letter_is_its_name(text: str, same: str) -> None:
    system = read(text, "abop")
    assert str(system) == same
    assert read(str(system)) == system


def test_what_is_read_is_said() -> None:
    assert read("axiom: A\nA -> αβ").notes == ("Greek letters are read as names: α as alpha, β as beta.",)


def test_a_mistake_is_shown_where_the_letter_stands() -> None:
    with pytest.raises(ModelNameError, match='I do not know the name "beta"') as unknown:
        read("α = 25\naxiom: F(α + β)")
    assert (unknown.value.line, unknown.value.column) == (2, 14)


def test_every_letter_has_a_name_of_its_own() -> None:
    letters = "αβγδζηθικλμνξοπρστυφχψωΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩ"
    assert all(name_of(letter) for letter in map(chr, range(sys.maxunicode)) if GREEK.match(letter))
    assert len({name_of(letter) for letter in letters}) == len(letters)
    assert [name_of(letter) for letter in "λΛϑϕµς"] == ["lambda", "Lambda", "theta", "phi", "mu", "sigma"]


@pytest.mark.slow
def test_many_letters_take_no_longer_than_others() -> None:
    with spent() as taken, pytest.raises(ModelSyntaxError, match="set a second time"):
        read("axiom: A\n" + ",".join(["δ=1"] * 300) + "\n" + "A -> " + "α " * 8_000)
    assert taken.seconds < 4
