"""A system as a page of a book shows it: its rules as mathematics, its notes in words, its first words."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from html.parser import HTMLParser

import pytest

from lsys_kit import derive, limits, read, system, systems
from lsys_kit.classroom.magic import FIRST_MODULES, FIRST_STEPS, MOST_RULES, first_words, formula, shown
from lsys_kit.notation.read import read_expression
from lsys_kit.notation.registry import DIALECTS
from tests.plants import plant
from tests.timing import spent

FORMULAS = frozenset(("math", "mrow", "mi", "mn", "mo", "msup", "msub", "mfrac", "msqrt", "mroot"))
TAGS = FORMULAS | {"div", "b", "i", "u", "span", "pre", "table", "tbody", "tr", "td", "sub", "sup", "br"}
ATTRIBUTES = frozenset(("style", "class", "role", "aria-hidden", "aria-label", "tabindex", "colspan", "stretchy"))


class Page(HTMLParser):
    """The elements of a piece of HTML, which must be among those that the kit writes, and must close."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag in TAGS
        assert {name for name, _ in attrs} <= ATTRIBUTES
        assert not any("url(" in (value or "") for _, value in attrs)
        if tag != "br":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_comment(self, data: str) -> None:
        raise AssertionError(data)


def harmless(text: str) -> str:
    """The HTML itself, if it consists of the kit's own elements."""
    Page(text)
    return text


def rows(text: str) -> Iterator[list[str]]:
    """The cells of each row, without their markup."""
    for row in re.findall(r"<tr.*?</tr>", text):
        yield [html.unescape(re.sub(r"<[^>]+>", "", cell)).replace("\u2009", "") for cell in re.findall(r"<td.*?</td>", row)]


def page(text: str) -> str:
    return shown(read(text))["text/html"]


# --- every system -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("id", systems())
def test_every_system_of_the_catalogue_is_shown_with_all_its_rules(id):
    every = system(id)
    bundle = shown(every, id)
    numbers = [row[0] for row in rows(harmless(bundle["text/html"]))]
    for letter, rules in (("p", every.productions), ("d", every.decomposition), ("i", every.interpretation), ("m", every.meta)):
        assert [number for number in numbers if re.fullmatch(rf"{letter}\d+", number)] == [
            f"{letter}{number}" for number in range(1, len(rules) + 1)
        ]
    assert all(note in bundle["text/plain"] for note in every.notes)
    assert all(f"  {line}\n" in f"{bundle['text/plain']}\n" for line in str(every).splitlines())


@pytest.mark.parametrize("id", systems())
def test_the_first_words_are_those_of_the_derivation(id):
    words, stop = first_words(system(id))
    assert stop == ""
    assert list(map(tuple, words)) == list(map(tuple, derive(system(id), len(words) - 1)))
    assert len(words) == FIRST_STEPS + 1 or len(derive(system(id), len(words))[-1]) > FIRST_MODULES


@pytest.mark.parametrize("notation", DIALECTS)
def test_the_notation_is_named(notation):
    from dataclasses import replace

    said = shown(replace(plant(notation), notation=notation), "plant")
    assert f"<b>plant</b> is an L-system in the notation {notation}." in said["text/html"]
    assert said["text/plain"].startswith(f"plant is an L-system in the notation {notation}.\n")


def test_the_turtle_is_told_where_it_is_not_the_notations_own():
    strange, own = read("turtle: abop\nAxiom: I", "plant-string"), read("Axiom: I", "plant-string")
    assert "turtle: abop" in shown(strange)["text/html"]
    assert "turtle:" not in shown(own)["text/html"]


# --- rules as mathematics ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "row"),
    [
        ("A -> B", ["p1", "A", "⟶", "B"]),
        ("A -> ε", ["p1", "A", "⟶", "ε"]),
        ("A(t) : t <= 2*3 -> A(t+1)[B]", ["p1", "A(t) : t ≤ 2 · 3", "⟶", "A(t + 1)[B]"]),
        ("A(t) < B > [C]D : t != 1 && !(t == 2) -> E", ["p1", "A(t) < B > [C]D : t ≠ 1 ∧ ¬(t = 2)", "⟶", "E"]),
        ("A -> B : 1/3", ["p1", "A", "1/3⟶", "B"]),
        ("A(n) -> repeat(n, i) <B(i)> C", ["p1", "A(n)", "⟶", "(B(i))i = 0 … n − 1C"]),
        ("A(n) -> repeat(3, i) <B(i)>", ["p1", "A(n)", "⟶", "(B(i))i = 0 … 2"]),
        ("A(n) -> repeat(n) <F> C", ["p1", "A(n)", "⟶", "(F)nC"]),
        ("meta: f(x) f(y) : x > y -> f(x-y)", ["m1", "f(x)f(y) : x > y", "⟶", "f(x − y)"]),
    ],
)
def test_a_rule_is_set_as_in_the_books(text, row):
    assert row in list(rows(harmless(page(f"axiom: A(1) A B f(1)\n{text}"))))


def test_an_axiom_a_constant_and_settings_are_told():
    text = harmless(page("dt = 1/2 in 0.1 .. 2 by 0.1\nangle: 25.7\nsteps: 3\naxiom: A(dt, -1)[b_r]"))
    assert list(rows(text))[:2] == [["", "dt = 1/2 from 0.1 to 2 by 0.1"], ["ω", "A(dt, −1)[br]"]]
    assert "<i>b</i><sub" in text
    assert "angle: 25.7 &nbsp;·&nbsp; steps: 3" in text


@pytest.mark.parametrize(
    ("text", "mathematics"),
    [
        ("a + b * c", "a + b · c"),
        ("(a + b) * c", "(a + b) · c"),
        ("a - (b - c)", "a − (b − c)"),
        ("a - b - c", "a − b − c"),
        ("a/(b*c)", "a/(b · c)"),
        ("-a^2", "−a<sup>2</sup>"),
        ("(-a)^2", "(−a)<sup>2</sup>"),
        ("(-2)^2", "(−2)<sup>2</sup>"),
        ("a^(b+1)", "a<sup>b + 1</sup>"),
        ("a^b^c", "a<sup>b<sup>c</sup></sup>"),
        ("(a^b)^c", "(a<sup>b</sup>)<sup>c</sup>"),
        ("1/3*a", "1/3 · a"),
        ("max(a, -b, 1)", "max(a, −b, 1)"),
        ("!(a < b || c >= 1)", "¬(a &lt; b ∨ c ≥ 1)"),
        ("if(a < b, 1, c)", "if(a &lt; b, 1, c)"),
        ("x12", 'x<sub style="line-height:0">12</sub>'),
    ],
)
def test_parentheses_stand_where_mathematics_needs_them(text, mathematics):
    assert re.sub("</?i>", "", formula(read_expression(text), read("axiom: A"))) == mathematics


# --- words and limits -------------------------------------------------------------------------------------------------


def test_a_step_that_has_no_value_is_told_and_those_before_it_are_shown():
    said = shown(read("axiom: A(2)\nA(t) -> A(t-1)B(1/(t-1))"))
    assert "Step 2 cannot be derived. A(1)" in said["text/plain"]
    assert "division by zero" in harmless(said["text/html"])
    assert said["text/plain"].endswith("step 0: A(2)\nstep 1: A(1)B(1)")


def test_long_words_are_not_among_the_first():
    words, stop = first_words(read("axiom: F\nF -> " + "F " * 40))
    assert ([len(word) for word in words], stop) == ([1, 40], "")


@pytest.mark.slow
def test_what_is_large_is_shown_in_part_and_soon():
    text = "axiom: " + "A " * 20_000 + "\nA -> A A\n" + "".join(f"B{n} -> " + "C " * 300 + "\n" for n in range(100))
    large = read(text)
    with spent() as taken:
        bundle = shown(large)
    assert taken.seconds < 6
    assert len(bundle["text/html"]) < 2_000_000
    assert len([row for row in rows(bundle["text/html"]) if re.fullmatch(r"p\d+", row[0])]) == MOST_RULES
    assert f"… {101 - MOST_RULES:,} more" in bundle["text/html"]
    assert "… 19,800 more" in harmless(bundle["text/html"])


@pytest.mark.parametrize(
    "rules", ["A(x) -> repeat(99999) <F(uniform(0, 1))>", "A(x) -> repeat(50000) <F(uniform(0, 1))>\nF(x) < F(y) -> A(x)"]
)
def test_a_large_step_is_not_waited_for(rules):
    with spent() as taken:
        words, stop = first_words(read("axiom: " + "A(0) " * 40 + f"\n{rules}"))
    assert taken.seconds < 5
    assert (len(words), stop) == (1, "")


def test_the_limits_in_force_are_kept():
    with limits(modules=3):
        assert len(first_words(read("axiom: A\nA -> A A"))[0]) == 2


def test_a_decomposition_without_end_is_told():
    words, stop = first_words(read("axiom: A(9)\ndecomposition:\nA(x) : x > 0 -> A(x-0.001)"))
    assert len(words) == 1
    assert "is decomposed more than 100 times" in stop
