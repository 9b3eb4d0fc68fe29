"""The Algorithmic Beauty of Plants (1990), its listings as they are printed: read, derived and drawn."""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import draw, system, systems
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read
from lsys_kit.notation.syntax.text.transcription import _transcript, transcribe
from lsys_kit.notation.write import write

LISTINGS = {
    path.stem: path.read_text(encoding="utf-8")
    for path in sorted((Path(__file__).parent.parent / "listings" / "abop").glob("*.txt"))
}
"""The figures of the book, by number."""

# The same systems in the kit's own notation, typed by hand.
PLANTS = {
    "1.24a": "steps: 5\nangle: 25.7\naxiom: F\nF -> F[+F]F[-F]F",
    "1.24b": "steps: 5\nangle: 20\naxiom: F\nF -> F[+F]F[-F][F]",
    "1.24c": "steps: 4\nangle: 22.5\naxiom: F\nF -> F F -[- F + F + F]+[+ F - F - F]",
    "1.24d": "steps: 7\nangle: 20\naxiom: X\nX -> F[+X]F[-X]+X\nF -> F F",
    "1.24e": "steps: 7\nangle: 25.7\naxiom: X\nX -> F[+X][-X]F X\nF -> F F",
    "1.24f": "steps: 5\nangle: 22.5\naxiom: X\nX -> F-[[X]+X]+F[+F X]-X\nF -> F F",
    "1.25": "steps: 7\nangle: 22.5\naxiom: A\nA -> [&F L!A]/////'[&F L!A]///////'[&F L!A]\nF -> S /////F\nS -> F L\n"
    "L -> ['''^^{-f+f+f-|-f+f+f}]",
    "1.26": "steps: 5\nangle: 18\naxiom: plant\n"
    "plant -> internode + [plant + flower] - - // [- - leaf] internode [+ + leaf] - [plant flower] + + plant flower\n"
    "internode -> F seg [//&& leaf] [//^^ leaf] F seg\nseg -> seg F seg\nleaf -> ['{+f-f f-f+|+f-f f-f}]\n"
    "flower -> [&&& pedicel '/ wedge //// wedge //// wedge //// wedge //// wedge]\npedicel -> F F\n"
    "wedge -> ['^F][{&&&&-f+f|-f+f}]",
    "1.27": "steps: 5\nangle: 30\naxiom: F\nF -> F[+F]F[-F]F : 0.33\nF -> F[+F]F : 0.33\nF -> F[-F]F : 0.34",
    "1.31a": "alphabet: 0 1\n"
    "steps: 30\nangle: 22.5\nignore: + - F\naxiom: F 1 F 1 F 1\n0 < 0 > 0 -> 0\n0 < 0 > 1 -> 1[+F 1 F 1]\n"
    "0 < 1 > 0 -> 1\n0 < 1 > 1 -> 1\n"
    "1 < 0 > 0 -> 0\n1 < 0 > 1 -> 1 F 1\n1 < 1 > 0 -> 0\n1 < 1 > 1 -> 0\n+ -> -\n- -> +",
    "2.6": "steps: 10\nr1 = 0.9\nr2 = 0.6\na0 = 45\na2 = 45\nd = 137.5\nwr = 0.707\naxiom: A(1,10)\n"
    "A(l,w) -> !(w)F(l)[&(a0)B(l*r2,w*wr)]/(d)A(l*r1,w*wr)\nB(l,w) -> !(w)F(l)[-(a2)$C(l*r2,w*wr)]C(l*r1,w*wr)\n"
    "C(l,w) -> !(w)F(l)[+(a2)$B(l*r2,w*wr)]B(l*r1,w*wr)",
    "2.7": "steps: 10\nr1 = 0.9\nr2 = 0.7\na1 = 10\na2 = 60\nwr = 0.707\naxiom: A(1,10)\n"
    "A(l,w) -> !(w)F(l)[&(a1)B(l*r1,w*wr)]/(180)[&(a2)B(l*r2,w*wr)]\n"
    "B(l,w) -> !(w)F(l)[+(a1)$B(l*r1,w*wr)][-(a2)$B(l*r2,w*wr)]",
    "2.8": "steps: 6\nd1 = 94.74\nd2 = 132.63\na = 18.95\nlr = 1.109\nvr = 1.732\naxiom: !(1)F(200)/(45)A\n"
    "A -> !(vr)F(50)[&(a)F(50)A]/(d1)[&(a)F(50)A]/(d2)[&(a)F(50)A]\nF(l) -> F(l*lr)\n!(w) -> !(w*vr)",
}
PLANTS["1.27-numbers-above"] = PLANTS["1.27"]


@pytest.mark.parametrize("figure", LISTINGS)
def test_a_listing_is_read_as_it_is_printed(figure: str) -> None:
    assert read(LISTINGS[figure]) == read(PLANTS[figure])


@pytest.mark.parametrize("figure", LISTINGS)
def test_a_printed_plant_is_derived_and_drawn(figure: str) -> None:
    steps = min(read(LISTINGS[figure]).steps or 0, 4)
    words = derive(read(LISTINGS[figure]), steps)
    assert str(words[-1]) == str(derive(read(PLANTS[figure]), steps)[-1])
    assert len(draw(words).scene.segments) > 0


@pytest.mark.parametrize("figure", LISTINGS)
def test_a_printed_listing_can_be_written_again(figure: str) -> None:
    found = read(LISTINGS[figure])
    assert read(write(found)) == found


@pytest.mark.parametrize("id", systems())
def test_what_the_kit_writes_is_no_print(id: str) -> None:
    """What is in the kit's own notation already is read as it stands."""
    text = write(system(id), "abop") if system(id).turtle == "abop" else "axiom: A"
    assert transcribe(text).text == text


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("n=5, δ=25.7°\nF\nF→F[+F", 3, 4),
        ("n=5, δ=25.7°\nF\nF→F[+F]F[−F]]F", 3, 13),
        ("ω : A\np1 : A .5→ B(\np2 : A .5→ C", 2, 14),
        ("ω : A(0)\np1 : A(t) : u=1 → B", 2, 13),
    ],
)
def test_a_mistake_in_print_is_shown_where_it_was_typed(text: str, line: int, column: int) -> None:
    with pytest.raises(LSystemError) as caught:
        read(text)
    assert (caught.value.source, caught.value.line, caught.value.column) == (text, line, column)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Startwort: A\n- A -> B\n- B -> A B", "axiom: A\nA -> B\nB -> A B"),
        ("Startwort a\na -> b a", "axiom: a\na -> b a"),
        ("axiom: A\nA –> B", "axiom: A\nA -> B"),
        ("axiom: 0\n0 -> 0 1\n1 -> 0", "alphabet: 0 1\naxiom: 0\n0 -> 0 1\n1 -> 0"),
        ("axiom: A\nA .5-> B\nA .5-> C", "axiom: A\nA -> B : 0.5\nA -> C : 0.5"),
        ("ω : A(0)\np1 : A(t) : t=0 → A(1)", "axiom: A(0)\nA(t) : t == 0 -> A(1)"),
        ("\\omega: \\bar{A}\np_1: \\quad \\bar{A} \\rightarrow \\bar{A} B", "axiom: A_bar\nA_bar -> A_bar B"),
        (
            "Startwort **ABAB**,\nRegeln **A** \\rightarrow **B** [- **A**] [+ **A**] **B** und **B** \\rightarrow **A**",
            "axiom: A B A B\nA -> B[-A][+A]B\nB -> A",
        ),  # Kurth, a text on the page on L-systems with brackets
        ("$a \\rightarrow F [+ b] a,$\n\n$b \\rightarrow F b$\n\nStartwort a", "axiom: a\na -> F[+b]a\nb -> F b"),
        (r"\omega: F, \quad p_1: F \rightarrow F[+F]F", "axiom: F\nF -> F[+F]F"),
        (
            "\\begin{array}{lll}\n\\omega & : & A(1,10) \\\\\np_1 & : & A(l,w) \\rightarrow F(l)[+A(l,w)] \\\\[2pt]\n"
            "\\end{array}",
            "axiom: A(1,10)\nA(l,w) -> F(l)[+A(l,w)]",
        ),
        ("\\[ \\omega: A \\]\n\\[ A \\rightarrow A B \\tag{7} \\]", "axiom: A\nA -> A B"),
        ("rules = 3\naxiom: A(rules)\nA(x) -> B(x)", "rules = 3\naxiom: A(rules)\nA(x) -> B(x)"),
        ("Example 2\nL-system 4\naxiom: F\nF -> F+F", "axiom: F\nF -> F+F"),
        ("```\nn=3, δ=60°\nF\nF → F+F\n```", "steps: 3\nangle: 60\naxiom: F\nF -> F+F"),
        ("F\nF -> F[+F]F", "axiom: F\nF -> F[+F]F"),
        ("ω : A B\np1 : A < B → A\n#ignore: + -", "ignore: + -\naxiom: A B\nA < B -> A"),
        ("1. axiom: A\n2. A -> A B\n3. B -> A", "axiom: A\nA -> A B\nB -> A"),
        ("• axiom: F\n• F → F+F", "axiom: F\nF -> F+F"),
        ("- axiom: F\n- F -> F+F", "axiom: F\nF -> F+F"),
        ("- A < B -> C\naxiom: - A B", "axiom: - A B\n- A < B -> C"),
        ("axiom: a\n       r\na -> a b\n r    l r", "axiom: a_r\na_r -> a_l b_r"),
        ("$\\omega: X$\n$X \\to F[+X]$\n$F \\mapsto FF$", "axiom: X\nX -> F[+X]\nF -> F F"),
        ("axiom: A\nA -> F[&F\\]B$", "axiom: A\nA -> F [& F \\ ] B $"),  # rolls, no macro
    ],
)
def test_other_prints_are_read_as_they_are_meant(text: str, expected: str) -> None:
    assert read(text) == read(expected)


MITCHISON = r"""$\omega = \vec{L}$
$$\vec{S} \longrightarrow \vec{L} \quad \overleftarrow{S} \longrightarrow \overleftarrow{L} \quad
 \vec{L} \longrightarrow \overleftarrow{L}\vec{S} \quad
 \overleftarrow{L} \longrightarrow \overleftarrow{S}\vec{L} \quad (1)$$"""
"""L-system 1 of Prusinkiewicz's introduction (equation 1), set by LaTeX."""
STAGES = r"""\omega : \vec{L}
$$\begin{array}{ccccc}
 \vec{S} \longrightarrow \vec{L} & \vec{L} \longrightarrow \vec{A} & \vec{A} \longrightarrow \vec{B} &
 \vec{B} \longrightarrow \vec{C} & \vec{C} \longrightarrow \overleftarrow{L}\vec{S} \\
 \overleftarrow{S} \longrightarrow \overleftarrow{L} & \overleftarrow{L} \longrightarrow \overleftarrow{A} &
 \overleftarrow{A} \longrightarrow \overleftarrow{B} & \overleftarrow{B} \longrightarrow \overleftarrow{C} &
 \overleftarrow{C} \longrightarrow \overleftarrow{S}\vec{L}
 \end{array} \quad (2)$$"""
"""L-system 2 (equation 2), its misprint in the last rule of each row corrected."""
PARAMETERS = r"""\omega : \vec{M}(2)
$$\begin{aligned} \vec{M}(s) : s < 5 &\longrightarrow \vec{M}(s+1) \\ \vec{M}(s) : s == 5 &\longrightarrow
 \overleftarrow{M}(2) \vec{M}(1) \\ \overleftarrow{M}(s) : s < 5 &\longrightarrow \overleftarrow{M}(s+1) \\
 \overleftarrow{M}(s) : s == 5 &\longrightarrow \overleftarrow{M}(1) \overrightarrow{M}(2) \end{aligned} \quad (3)$$"""
"""L-system 3 (equation 3), with its errata."""


@pytest.mark.parametrize(("text", "id"), [(MITCHISON, "P1"), (STAGES, "P2"), (PARAMETERS, "P3")], ids=["P1", "P2", "P3"])
def test_an_equation_is_read_as_it_is_typeset(text: str, id: str) -> None:
    """The kit has a life span of L-system 3 as a constant."""
    known = "\n".join(map(str, system(id).productions))
    assert read(text).productions == read(f"axiom: A\n{known.replace('lifeTime', '5')}").productions


OUTPUT = """Axiom: a
      r

Rules: < a > -> a b
      r      l r
      < a > -> b a
      l      l r
      < b > -> a
      r      r
      < b > -> a
      l      l
"""
"""The table of rules of Jacob's notebook, as Mathematica prints it: subscripts on the line below."""


def test_subscripts_may_stand_on_the_line_below() -> None:
    catenula = read("axiom: ar\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> al")
    assert read(OUTPUT).productions == catenula.productions
    parameters = read("Axiom: A [1]\n l\nRules: < A [2] > -> A [1]B [1]\n l l r\n < A [i_ /; i < 2] > -> A [1 + i]\n l l")
    assert str(derive(parameters, 2)[-1]) == "Al[1] Br[1]"


@pytest.mark.parametrize(
    ("lines", "steps", "word"),
    [
        ("Example 2\nNumber of productions: 3\nI -> I[A]A(I)A\nA -> A[I[L]IF]B\nB -> A(B)B", 1, "I[A]A(I)A"),
        (
            "Example 3\nHere is another, a more symmetric plant:\nNumber of productions: 2\n"
            "I -> I[I](I)AF\nA -> A[I[L](L)IF]BF",
            1,
            "I[I](I)AF",
        ),
    ],
)
def test_headings_and_sentences_over_a_plant_string_are_passed_over(lines: str, steps: int, word: str) -> None:
    """The applet's lesson, examples 2 and 3."""
    plant = read(lines)
    assert str(derive(plant, steps)[-1]) == word
    assert f'"{lines.splitlines()[0]}" is passed over.' in plant.notes


@pytest.mark.parametrize("text", ["A -\nA -> B", "A\nB"])
def test_not_every_first_line_is_an_axiom(text: str) -> None:
    with pytest.raises(LSystemError):
        read(text)


@pytest.mark.parametrize("text", ["axiom: A\nA -> 2 B", "axiom: A 1\nA -> B", "axiom: A\n1 < A -> B"])
def test_a_digit_that_nothing_rewrites_is_no_symbol(text: str) -> None:
    with pytest.raises(LSystemError, match="A number is not a module"):
        read(text)


def test_what_was_understood_is_said() -> None:
    assert read("F\nF -> F[+F]F").notes == ('"F" is read as the axiom.',)
    assert set(read(LISTINGS["1.31a"]).notes) >= {'"n" is read as the number of steps.', "The digits 0, 1 are read as symbols."}
    assert read(LISTINGS["2.6"]).constants[0].value.value == Fraction(9, 10)


@given(st.one_of(st.text("AB01 .<>:*=→∗δωp\n-,;#n()[]’∧", max_size=60), st.deferred(lambda: TYPESET)))
def test_every_place_of_a_transcript_is_one_of_the_source(text: str) -> None:
    try:
        found = transcribe(text)
    except LSystemError:
        return
    places = [found.origin(offset) for offset in range(len(found.text) + 1)]
    assert all(0 <= place <= len(text) for place in places)
    assert places == sorted(places) or "0" in text or "1" in text


@pytest.mark.slow
@pytest.mark.parametrize(
    "part",
    [
        "p1 : ",
        "n=5, ",
        "δ=",
        "∗ ",
        "’",
        "∧ ",
        ".5→ ",
        "A .5",
        "  ",
        "\n ",
        "* <",
        "- ",
        "\\bar{A}",
        "0 ",
        "= ",
        "\\quad ",
        "& ",
        "\\\\ ",
        "$",
        "**",
        "**A",
        "\\begin{array} ",
        "\\quad A -> B ",
        "\n r l",
        "A -> B\n r l\n",
        "Here is ",
        " und A -> B",
        "\\[ ",
        "- A ",
        "(1) ",
        "\\bar{",
    ],
)
def test_long_texts_are_transcribed_in_linear_time(part: str) -> None:
    text = part * (500_000 // len(part))
    with suppress(LSystemError):
        transcribe(text)


def test_edges_of_several_kinds_are_drawn() -> None:
    """Figure 1.10a, the dragon curve: F_l and F_r are both drawn as F."""
    dragon = read("n=10, δ=90°\nF_l\nF_l → F_l+F_r+\nF_r → -F_l-F_r")
    assert "Drawn as F: F_l, F_r." in dragon.notes
    assert len(draw(dragon, 5).scene.segments) == 32
    assert read(write(dragon)) == dragon
    assert not read("axiom: F_l\nF_l -> F_l F_l\ninterpretation:\nF_l -> f").notes


SIGNS = st.one_of(
    st.sampled_from("ABp01 .<>:*=->,;#()[]\n\\_{}$&ε→ωδ°’–∧•"),
    st.sampled_from(
        [
            "\nExample 2\n",
            "\nHere is a plant:\n",
            "Rules",
            "Regeln ",
            " und ",
            "**",
            "\n```",
            "\\quad",
            "\\vec{A}",
            "$$",
            " -> ",
            "\\begin{array}",
            "\\\\",
            "\\end{array}",
            "\n1. ",
            "\n(2) ",
            "\n r l\n",
            "Startwort ",
        ]
    ),
)


TYPESET = st.lists(SIGNS, max_size=40).map("".join)


@given(TYPESET)
def test_what_shows_no_sign_of_print_at_first_sight_has_none(text: str) -> None:
    try:
        found = _transcript(text)
    except LSystemError:
        return
    assert transcribe(text).text == found.text


@pytest.mark.parametrize(
    ("rules", "meant"),
    [
        ("F -> F[+F]F (0.4)\nF -> FF  (0.6)", "F -> F[+F]F : 0.4\nF -> F F : 0.6"),
        ("F (1/4) -> F[+F]F\nF (3/4) -> F F", "F -> F[+F]F : 1/4\nF -> F F : 3/4"),
        ("F -> F[+F]F (0.4)\nF -> F F (0.5)", None),  # together they are not 1
        ("F -> F[+F]F (0.4)\nF -> F F", None),
        ("F -> F(2) [+F] F (0.4)\nF -> F F (0.6)", None),  # F has values
        ("F -> F[+F]F(0.4)\nF -> F F(0.6)", None),  # nothing is set apart
    ],
)
def test_numbers_in_brackets_set_apart_are_probabilities_where_together_they_are_one(rules: str, meant: str | None) -> None:
    found = read(f"axiom: F\n{rules}").productions
    assert found == read(f"axiom: F\n{meant}").productions if meant else all(rule.probability is None for rule in found)
