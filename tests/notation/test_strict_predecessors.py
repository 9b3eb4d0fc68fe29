"""Strict predecessors of several modules, in the notations that have them and in those that have not."""

from __future__ import annotations

import re

import pytest

from lsys_kit.classroom.magic import shown
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.read import read
from lsys_kit.notation.write import write

SUM = "axiom: A(1)B(2)\nA(x)B(y) : x > y -> C(x + y)"


def heads(text: str, notation: str | None = None) -> list[list[str]]:
    """The left context, the strict predecessor and the right context of each production."""
    return [
        ["".join(map(str, part)) for part in (rule.left, rule.predecessors, rule.right)]
        for rule in read(text, notation).productions
    ]


@pytest.mark.parametrize(
    ("rule", "parts"),
    [
        ("A B -> C", ["", "AB", ""]),
        ("A(x) B(y) : x > y -> C(x+y)", ["", "A(x)B(y)", ""]),
        ("F+F -> G", ["", "F+F", ""]),
        ("A B > C -> D", ["", "AB", "C"]),
        ("A < B C > D -> E", ["A", "BC", "D"]),
        ("A B < C D > [E] F -> ε", ["AB", "CD", "[E]F"]),
        ("A B -> C : 1/2", ["", "AB", ""]),
        ("p_1: A B → C", ["", "AB", ""]),
        ("\\vec{A} A -> C", ["", "A_rA", ""]),
        ("A B \\xrightarrow{0.5} C", ["", "AB", ""]),
        (" < A B > -> C", ["", "AB", ""]),
        ("A_{l} A_{r} -> C", ["", "A_lA_r", ""]),
        ("A(3) B(x) -> C(x)", ["", "A(3)B(x)", ""]),
    ],
)
def test_what_is_replaced_in_the_kits_notation(rule: str, parts: list[str]) -> None:
    assert heads(f"axiom: A\n{rule}", "abop") == [parts]


@pytest.mark.parametrize(
    ("rule", "parts"),
    [
        ("AB --> C", ["", "AB", ""]),
        ("Fl --> Fl+rF+", ["", "Fl", ""]),
        ("A(x)B(y) : x > y --> C(x+y)", ["", "A(x)B(y)", ""]),
        ("A < BC > D --> E", ["A", "BC", "D"]),
        ("* < BC > * --> *", ["", "BC", ""]),
        ("AB > [C]D --> E", ["", "AB", "[Cε]D"]),
        ("AB : {y = 1;} 1 --> C(y)", ["", "AB", ""]),
        ("+F --> F+ : 2", ["", "+F", ""]),
        ("A(x)BC --> D", ["", "A(x)BC", ""]),
    ],
)
def test_what_is_replaced_in_a_cpfg_text(rule: str, parts: list[str]) -> None:
    assert heads(f"Axiom: A\n{rule}", "cpfg") == [parts]


def test_a_note_says_how_it_is_understood() -> None:
    told = (
        "The strict predecessor of production {}, for {}, has {} modules, which are replaced together{}. "
        'A neighbour that stays is a context, before "<" or after ">".'
    )
    assert read("axiom: A B\nA B -> C").notes == (told.format(1, "A B", 2, ""),)
    two, three = "; so are those of another production", "; so are those of 2 other productions"
    text = "axiom: A B C\nA -> B\nC < A B C > A -> C\nA C -> A"
    assert read(text).notes == (
        "Production 2, for C < A B C > A, is never applied: production 1 comes before it and matches every A.",
        "Production 3, for A C, is never applied: production 1 comes before it and matches every A.",
        told.format(2, "C < A B C > A", 3, two),
    )
    assert told.format(1, "AB", 2, three) in read("Axiom: AB\nAB --> A\nAA --> B\nBB --> AA", "cpfg").notes


@pytest.mark.parametrize(
    ("rules", "note"),
    [
        ("A B C -> A", "The production A B C can never match: no module C occurs."),
        ("A a -> B", 'The production A a can never match: no module a occurs. Did you mean "A"?'),
        ("B A -> A\nB -> A", None),
        ("A B -> A : 1\nA -> A : 1", None),
    ],
)
def test_what_can_never_happen_is_told(rules: str, note: str | None) -> None:
    others = [told for told in read(f"axiom: A B\n{rules}").notes if not told.startswith("The strict predecessor")]
    assert others == ([note] if note else [])


def test_a_module_that_is_replaced_with_others_is_no_module_with_other_values() -> None:
    assert all("No production matches" not in note for note in read("axiom: A B(1) B\nA B(x) -> B\nB -> A").notes)


def test_names_stay_whole_in_what_is_replaced() -> None:
    system = read("axiom: ab c\na c -> b\nb -> ab\nab c -> ac")
    assert [rule.predecessors[0].symbol for rule in system.productions] == ["a", "b", "ab"]
    assert read("axiom: FG\nF G -> GF\nG -> F").axiom == (Pattern("F"), Pattern("G"))


@pytest.mark.parametrize(
    "text", [SUM, "axiom: F+F\nF+F -> G", "axiom: A\nS < A B > [C]D -> E : 1/2", "axiom: A\nal br -> al\\ vec"]
)
def test_it_is_written_as_it_is_read(text: str) -> None:
    assert write(read(text)).splitlines() == text.splitlines()


@pytest.mark.parametrize("notation", ["fractint", "grogra", "mathematica", "plant-string"])
def test_a_notation_without_it_says_so(notation: str) -> None:
    with pytest.raises(LSystemError, match="has no predecessors of several modules"):
        write(read("Axiom: AB\nAB -> BA", "cpfg"), notation)


def test_it_is_printed_as_in_a_book() -> None:
    printed = re.sub(r"<[^>]*>", "", shown(read("axiom: A B\nX < A B > Y -> C"))["text/html"])
    assert "X &lt; A&thinsp;B &gt; Y⟶C" in printed.replace("\n", "")
