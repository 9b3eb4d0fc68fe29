"""Fractint's L-systems: read as its documentation says, on words first, then on texts."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError, derive, read, write
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read_word
from tests.timing import spent

CLASSICAL = {
    "Snowflake": ("Angle 6\nAxiom F--F--F\nF=F+F--F+F", [3, 12, 48, 192]),
    "Dragon": ("Angle 4\nAxiom FX\nX=X+YF+\nY=-FX-Y", [1, 2, 4, 8]),
    "Hilbert": ("Angle 4\nAxiom X\nX=-YF+XFX+FY-\nY=+XF-YFY-FX+", [0, 3, 15, 63]),
    "Cesaro": ("Angle 34\nAxiom FX\nF=\nX=----F!X!++++++++F!X!----", [1, 2, 4, 8]),
    "Penrose": (
        "Angle 10\nAxiom [X]++[X]++[X]++[X]++[X]\nW=YF++ZF----XF[-YF----WF]++\nX=+YF--ZF[---WF--XF]+\n"
        "Y=-WF++XF[+++YF++ZF]-\nZ=--YF++++WF[+ZF++++XF]--XF\nF=",
        [0, 20, 90, 400],
    ),
    "Spiral": ("Angle 4\nAxiom D\nD=D\\30D/12.5D@IQ.5", [1, 3, 9, 27]),
}
"""Systems of the field, and how many strokes their first words have."""


# --- an oracle: the documentation's rewriting, read literally ---------------------------------------------------------------


def parts(word: str) -> list[str]:
    """The characters of a word, those of a command and its number together."""
    return re.findall(r"[\\/<>@C][IQ]*[0-9.]*|.", word)


def words_of(text: str, steps: int) -> list[list[str]]:
    """The words of a system whose lines are plain: every character that has a rule is replaced."""
    lines = [line.split(";")[0].strip().upper() for line in text.splitlines()]
    rules: dict[str, list[str]] = {}
    for line in lines:
        if line[1:2] == "=":
            rules.setdefault(line[0], []).extend(parts(line[2:]))
    found = [parts(next(line.split()[1] for line in lines if line.startswith("AXIOM ")))]
    for _ in range(steps):
        found.append([new for part in found[-1] for new in rules.get(part, [part])])
    return found


def spelt(word: list[str]) -> list[tuple[str, Fraction | None]]:
    """The modules of a word, whose numbers may be spelt in several ways."""
    found = [re.fullmatch(r"([\\/<>@C][IQ]*)([0-9.]*)|.", part) for part in word]
    return [
        (match[1] or match[0], Fraction(f"0{match[2]}0" if "." in match[2] else match[2]) if match[2] else None)
        for match in found
        if match
    ]


def modules(word: Word) -> list[tuple[str, object]]:
    return [(module.symbol, *module.arguments, None)[:2] for module in word]


@pytest.mark.parametrize("name", CLASSICAL)
def test_the_words_are_those_of_the_documentation(name: str) -> None:
    text, strokes = CLASSICAL[name]
    derived = derive(read(f"{name} {{\n{text}\n}}"), 3)
    assert [modules(word) for word in derived] == [spelt(word) for word in words_of(text, 3)]
    assert [sum(module.symbol in "FD" for module in word) for word in derived] == strokes


symbol = st.sampled_from("ABFGDMXYZ0.\"',?~:")
command = st.sampled_from(["+", "-", "|", "!", "\\30", "/2.5", "@.5", "@IQ3", "@Q2", "C12", "<1", ">", "C"])
word = st.recursive(
    st.lists(st.one_of(symbol, command), max_size=6).map("".join),
    lambda inner: st.lists(st.one_of(inner, inner.map(lambda text: f"[{text}]")), max_size=3).map("".join),
    max_leaves=6,
)


def apart(text: str) -> str:
    """A word in which no digit or point follows a command."""
    return re.sub(r"(?<=[\\/<>@C])(?=[0.])|(?<=[\d.])(?=[0.])", "A", text)


rules = st.lists(st.tuples(st.sampled_from("ABFGDMXYZ"), word.map(apart)), max_size=5)
systems = st.tuples(word.map(apart).filter(bool), rules)


@given(systems, st.integers(3, 50))
def test_any_words_are_those_of_the_documentation(found: tuple[str, list[tuple[str, str]]], angle: int) -> None:
    axiom, rules = found
    text = "\n".join([f"Angle {angle}", f"Axiom A{axiom}", *(f"{head}=A{body}" for head, body in rules)])
    system = read(text, "fractint")
    assert system.angle == Fraction(360, angle)
    expected = words_of(text, 2)
    if len(expected[-1]) < 2_000:
        assert [modules(word) for word in derive(system, 2)] == [spelt(word) for word in expected]


@given(systems, st.integers(1, 360))
def test_what_is_written_reads_back(found: tuple[str, list[tuple[str, str]]], angle: int) -> None:
    axiom, rules = found
    text = "\n".join([f"Angle {angle}", f"Axiom A{axiom}", *(f"{head}=A{body}" for head, body in rules)])
    system = read(text, "fractint")
    written = write(system)
    assert read(written) == system
    assert write(read(written)) == written


# --- texts ------------------------------------------------------------------------------------------------------------------

KOCH = read("Koch { Angle 6\nAxiom F--F--F\nF=F+F--F+F }")


@pytest.mark.parametrize(
    "text",
    [
        "Koch{\nAngle 6\nAxiom F--F--F\nF=F+F--F+F\n}",
        "Angle 6\nAxiom F--F--F\nF=F+F--F+F",
        "Koch (x=1) ; {\n  ; }\n{\nANGLE=6;\nAXIOM f--f--f ; the triangle\n\tf = f+f--f+f\t; }\n  } ; the end",
        "Koch {\r\n  angle 6\r\n  axiom=f--f--f\r\n  f F+F--F+F\r\n  }\r\n\x1a",
        "\ufeffKoch { Angle 6\fAxiom F--F--F\fF=F+F--F+F}",
        "Koch {\nF=F+F-\naxiom F--F--F\nangle 6\nf=-F+F\n}",
        "Koch {\nAxiom F\nAngle 4\nAxiom F--F--F\nAngle 6\nF=F+F--F+F\n}",
        "From: a friend\nLook:\n\ncomment {\n  What -> follows\n}\nKoch {\nangle 6.9\naxiom f - - F - - f\n"
        "f=f + f--f+f\n}\nBye",
        "{ a word before }\nKoch { ; }\nAngle 6\nAxiom F--F--F\nF=F+F--F+F\n}",
        "Koch {\rAngle 6\rAxiom F--F--F\rF=F+F--F+F\r}",
        "Koch\n{\nAngle6\nAxiomF--F--F\nF=F+F--F+F\n}",
    ],
)
def test_the_same_system_in_many_spellings(text: str) -> None:
    assert read(text) == KOCH
    assert read(text, "fractint") == KOCH


def test_the_turtle_starts_to_the_right_and_is_fractints() -> None:
    assert (KOCH.heading, KOCH.turtle, KOCH.notation) == (0, "fractint", "fractint")
    assert "Read as fractint." in KOCH.notes


def test_case_does_not_matter() -> None:
    assert read("Angle 6\nAxiom fX@iq2c3\nx=f") == read("ANGLE 6\naxiom Fx@IQ2C3\nX=F")


def test_rules_for_one_symbol_are_joined_wherever_they_stand() -> None:
    found = read("Angle 4\nX=F+\nAxiom X\nF=\nX=[F]\nX=")
    assert [str(rule) for rule in found.productions] == ["X -> F+[F]", "F -> ε"]


def test_what_replaces_an_axiom_or_an_angle_is_told() -> None:
    found = read("Angle 4\nAxiom X\nAxiom F\nAngle 8")
    assert [str(module) for module in found.axiom] == ["F"]
    assert found.angle == 45
    assert {
        "The axiom is given more than once: the last one is used.",
        "The angle is given more than once: the last one is used.",
    } <= set(found.notes)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("@.5", Module("@", (Fraction(1, 2),))),
        ("@iq3", Module("@IQ", (3,))),
        ("@QI3", Module("@QI", (3,))),
        ("@I.618", Module("@I", (Fraction("0.618"),))),
        ("\\90", Module("\\", (90,))),
        ("/5.", Module("/", (5,))),
        ("c015", Module("C", (15,))),
        ("<", Module("<")),
        ("@", Module("@")),
        ("4", Module("4")),
        (".", Module(".")),
        ('"', Module('"')),
    ],
)
def test_a_command_takes_the_digits_behind_it(text: str, expected: Module) -> None:
    assert read_word(text, "fractint") == (expected,)


@pytest.mark.parametrize("count", [1, 7, 34, 50, 360])
def test_angles_are_exact(count: int) -> None:
    assert read(f"Whole {{\nAngle {count}\nAxiom F\n}}").angle * count == 360


def test_the_name_of_a_system_is_kept_where_it_is_written_again() -> None:
    assert write(read("Dragon&med { Angle 4\nAxiom F }")).startswith("Dragon&med {\n")
    assert write(LSystem((Pattern("F"),), (), turtle="fractint", heading=0), "fractint").startswith("LSystem {\n")


def test_long_rules_are_parted_so_that_fractint_can_read_them() -> None:
    long = replace(KOCH, productions=(Production((Pattern("F"),), (Pattern("F"), Pattern("\\", (Number(30),))) * 500),))
    assert max(map(len, write(long).splitlines())) < 160
    assert read(write(long)) == long


# --- several systems --------------------------------------------------------------------------------------------------------

MANY = (
    "; two of them\nKoch1 {\n  Angle 6\n  Axiom F\n  F=F+F\n  }\nkoch2 { Angle 4\n  Axiom G\n  }\n"
    "Torn {\n  Angle 5\nOdd {\n  Axiom\n  }"
)


@pytest.mark.parametrize(("name", "axiom"), [("Koch1", "F"), ("KOCH1", "F"), ("koch2", "G"), ("Koch2", "G")])
def test_one_of_several_systems_is_read_by_its_name(name: str, axiom: str) -> None:
    for notation in (None, "fractint"):
        assert [str(module) for module in read(MANY, notation, name=name).axiom] == [axiom]


def test_which_of_several_systems_is_meant_must_be_said() -> None:
    with pytest.raises(ModelValueError, match="There are 4 systems in this text") as found:
        read(MANY)
    assert (
        found.value.hint
        == 'Choose one by its name: read(text, name="Koch1"), or --name in a shell. The systems are Koch1, koch2, Torn, Odd.'
    )
    assert found.value.line == 7


def test_a_name_that_no_system_has_is_explained() -> None:
    with pytest.raises(ModelNameError, match='There is no system called "Koch3" in this text'):
        read(MANY, name="Koch3")
    with pytest.raises(ModelValueError, match="holds a single system, without a name"):
        read("axiom: A", name="Koch3")


def test_a_slip_in_one_system_is_none_in_another_and_is_found_where_it_stands() -> None:
    with pytest.raises(ModelSyntaxError, match=r'This "\{" is never closed') as torn:
        read(MANY, name="Torn")
    assert torn.value.line == 10
    with pytest.raises(ModelSyntaxError, match="The axiom is missing") as odd:
        read(MANY, name="Odd")
    assert odd.value.line == 13


# --- slips ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "message", "line", "column"),
    [
        ("Angle 6", "There is no axiom", 1, 8),
        ("A {\nAxiom F\n}", "There is no angle", 2, 8),
        ("A {}", "There is no axiom", 1, 5),
        ("A {\nAngle 6\nAxiom F", 'This "{" is never closed', 1, 3),
        ("Angle 6\nAxiom F\n}", 'This "}" closes nothing', 3, 1),
        ("comment { }", "There is no system in this text", 1, 9),
        ("Angle 0\nAxiom F", "A full turn cannot have 0 parts here", 1, 7),
        ("Angle 999999\nAxiom F", "A full turn cannot have 999999 parts here", 1, 7),
        ("Angle\nAxiom F", "The number of parts of a full turn is missing", 1, 6),
        ("Angle six\nAxiom F", "The number of parts of a full turn is missing", 1, 7),
        ("Angle 6 7\nAxiom F", 'I did not expect "7" after the angle', 1, 9),
        ("Angle 6 Axiom F", 'I did not expect "Axiom " after the angle', 1, 9),
        ("Angle: 6\nAxiom F", 'Fractint needs no ":" here', 1, 6),
        ("Angle 6\nAxiom: F", 'Fractint needs no ":" here', 2, 6),
        ("Angle 6\nAxiom", "The axiom is missing", 2, 6),
        ("Angle 6\nAxiom F\nF", "This rule has no successor", 3, 1),
        ("Angle 6\nAxiom F\nF -> F+F", "Fractint has no arrows", 3, 3),
        ("Angle 6\nAxiom F\nFF=F", "A rule rewrites one character", 3, 1),
        ("Angle 6\nAxiom F\nF=F G=G", 'This is a second "="', 3, 6),
        ("Angle 6\nAxiom F\nFF+F", "This line makes no sense in Fractint", 3, 1),
        ("Angle 6\nAxiom F\n+=F", '"+" is a command, which a rule cannot rewrite', 3, 1),
        ("Angle 6\nAxiom F\nc=f+f", '"c" is a command, which a rule cannot rewrite', 3, 1),
        ("Angle 6\nAxiom F\nF=[F", 'This "[" is never closed', 3, 3),
        ("Angle 6\nAxiom F]", 'This "]" closes nothing', 2, 8),
        ("Angle 6\nAxiom F@1.2.3F", "A command cannot take this number", 2, 8),
        ("Angle 6\nAxiom F@.F", "A command cannot take this number", 2, 8),
        ("Angle 6\nAxiom Fλ", '"λ" (GREEK SMALL LETTER LAMDA) cannot be a symbol', 2, 8),
        ("Angle 6\nAxiom F%F", '"%" cannot be a symbol here', 2, 8),
        ("Angle 6\nAxiom F\nF=F<\nF=5", '"5" would be read as part of "<" in the rule before', 4, 3),
    ],
)
def test_every_slip_is_a_clear_error(text: str, message: str, line: int, column: int) -> None:
    with pytest.raises(LSystemError) as found:
        read(text, "fractint")
    assert (found.value.message, found.value.line, found.value.column) == (message, line, column)
    assert found.value.hint


@pytest.mark.parametrize(
    ("text", "lack"),
    [
        ("axiom: F&F", 'module "&"'),
        ("axiom: F(2)", 'module "F(2)"'),
        ("axiom: F\nF -> G", 'module "G"'),
        ("axiom: F\n+ -> F", 'rule for the command "+"'),
        ("turtle: grogra\naxiom: F", "turtle commands of GROGRA"),
        ("angle: 25.7\naxiom: F", "angle of 25.7 with a heading of 90 degrees"),
        ("angle: 20\nheading: 1\naxiom: F", "angle of 20 with a heading of 1 degrees"),
        ("axiom: " + " ".join(f"{letter} {letter.lower()}" for letter in "ABCDEHIJKLM"), "more letters than 21"),
        ("turtle: fractint\naxiom: F", "starting direction of 90 degrees"),
        ("turtle: fractint\nheading: 0\nangle: 25.7\naxiom: F", "angle of 25.7 degrees"),
        ("turtle: fractint\nheading: 0\nseed: 3\naxiom: F", "seed"),
        ("turtle: fractint\nheading: 0\naxiom: F(2)", 'module "F(2)"'),
        ("turtle: fractint\nheading: 0\naxiom: f", 'module "f"'),
        ("turtle: fractint\nheading: 0\naxiom: A(1)\nA(t) : t < 3 -> A(t+1)", "conditions"),
        ("turtle: fractint\nheading: 0\naxiom: F\n+ -> F", 'rule for the command "+"'),
        ("turtle: fractint\nheading: 0\naxiom: F\nF -> F : 1/2\nF -> F F : 1/2", "probabilities"),
        ("turtle: fractint\nheading: 0\naxiom: /(1/3)F", 'module "/(1/3)"'),
    ],
)
def test_what_fractint_lacks_is_said(text: str, lack: str) -> None:
    with pytest.raises(ModelValueError, match=re.escape(f"The notation fractint has no {lack}, which this system needs")):
        write(read(text), "fractint")


TRANSLATED = (
    "angle: 60\nheading: 0\naxiom: F--F\nF -> F+F",
    "angle: 90\naxiom: F f F\nF -> F+F\nf -> f f",
    "angle: 20\naxiom: F[+F]-F",
    "angle: 72\nheading: -45\naxiom: F|+F",
    "angle: 120\naxiom: F|-F",
    "angle: 72\nheading: 0\naxiom: F|+F",
    "angle: -45\naxiom: F+F[|F]-F\nsteps: 2",
    "angle: 750\naxiom: F+F",
    "angle: 0\naxiom: F+F-F",
    "axiom: F a A + C c d\na -> A\nA -> F+\nd -> F F\nC -> -F",
)


@pytest.mark.parametrize("text", TRANSLATED)
def test_a_system_with_the_kits_commands_is_translated_and_draws_the_same(text: str) -> None:
    system = read(text)
    there = read(write(system, "fractint"), "fractint")
    assert (there.turtle, there.steps, len(there.productions)) == ("fractint", system.steps, len(system.productions))
    for step in range(4):
        one, other = (scene_of(derive(each, step)[step]).segments.ends for each in (system, there))
        assert one.shape == other.shape
        assert np.allclose(one, other)


def test_each_letter_of_a_translation_is_a_capital_of_its_own() -> None:
    system = read("axiom: a A d D z Z F\na -> A\nd -> D")
    assert write(system, "fractint").splitlines()[2:] == ["  Axiom +XAWYVZF", "  X=A", "  W=Y", "  }"]


def test_a_comment_says_how_many_steps() -> None:
    assert read("Koch { ; old\r\n; steps: 4 \r\nAngle 6\r\nAxiom F ; steps: 3\r\n}").steps == 4
    assert read("A {\n;steps: 2\nAngle 6\nAxiom F\n}\nB {\nAngle 6\nAxiom F\n}", name="B").steps is None


def test_a_system_of_fractints_can_be_written_in_the_kits_own_notation() -> None:
    assert read(write(KOCH, "abop")) == KOCH
    assert read("turtle: fractint\nheading: 0\nangle: 60\naxiom: F--F--F\nF -> F+F--F+F") == KOCH


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "Angle 6\nAxiom " + "F" * 10**6,
        "A {\nAngle 6\nAxiom F\n}\n" * 43_000,
        "{" * 10**6,
        "}" * 10**6,
        "A" * 10**6,
        ";" * 10**6,
        "Angle 6\nAxiom F\n" + "F=F\n" * 240_000,
        "A {\n" * 250_000,
        "Angle 6\n" * 120_000,
        "\n" * 999_000,
        "A { }" * 200_000,
        "Angle 6\nAxiom F" + " " * 999_000,
        "A" + " " * 999_000 + "{",
        "Angle 6\nAxiom @" + "1" * 999_000,
        "=" * 10**6,
    ],
    ids=range(15),
)
def test_a_million_characters_take_less_than_two_seconds(text: str) -> None:
    with spent() as taken, suppress(LSystemError):
        read(text[: 10**6])
    assert taken.seconds < 2 * 3  # two seconds on a machine of one's own


@pytest.mark.parametrize(
    ("theta", "degrees"),
    [
        ("1.5707963267948966192313216916398", 90),
        ("0.19634954084936207740391521145497", Fraction(45, 4)),
        ("pi/6", 30),
        ("= 2*PI / 7.", Fraction(360, 7)),
        ("360/16*pi/180", Fraction(45, 2)),
        (".5", Fraction("28.647889757")),
    ],
)
def test_a_later_program_turns_by_radians(theta: str, degrees: Fraction) -> None:
    text = f"Flower {{\n  theta {theta}\n  alpha pi/2\n  axiom F\n  F=F[+F][-F]\n}}"
    system = read(text, "fractint")
    assert (system.angle, system.heading) == (degrees, 90)
    assert f'"theta" is in radians: + and - turn by {float(degrees):.6g} degrees.' in system.notes
    assert read(text.replace("  alpha pi/2\n", ""), "fractint").heading == 0


@pytest.mark.parametrize("theta", ["0", "60", "1/0", "9" * 200, "1" + "*1" * 20, "pi/" + "7" * 90 + "/" + "7" * 90])
def test_what_is_no_turn_in_radians_is_refused(theta: str) -> None:
    with pytest.raises(ModelSyntaxError, match="This is no turn in radians") as caught:
        read(f"Flower {{\n  theta {theta}\n  axiom F\n  F=F+F\n}}", "fractint")
    assert (caught.value.line, caught.value.column) == (2, 9)
