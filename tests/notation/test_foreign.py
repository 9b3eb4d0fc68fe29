"""Texts in formats of other programs are called what they are; those that the kit reads, or nearly, never are."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.errors import LSystemError, ModelSyntaxError
from lsys_kit.notation.foreign import GLANCE, ForeignFormat, foreign_format, formats, name_hint
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.syntax.systems import lacking
from lsys_kit.notation.write import write
from tests.notation.foreign_texts import FOREIGN, MENTIONS
from tests.notation.test_any_text import MODELS
from tests.notation.test_recognised import LISTINGS, SHORT
from tests.rows import every_row
from tests.timing import spent

TESTS = Path(__file__).parents[1]
EXAMPLES = tomllib.loads((TESTS / "notebooks" / "examples.toml").read_text(encoding="utf-8"))["notations"]
TEXTS = [(name, text, line) for name, texts in FOREIGN.items() for text, line in texts]


@cache
def own_texts() -> list[str]:
    """Texts in the kit's notations."""
    return sorted(
        {
            *(
                write(system(id), notation)
                for id in systems()
                for notation in DIALECTS
                if not lacking(DIALECTS[notation], system(id))
            ),
            *(system(id).source for id in systems()),
            *(text for texts in SHORT.values() for text in texts),
            *((TESTS / "listings" / file).read_text(encoding="utf-8") for file, _ in LISTINGS),
            *(example["listing"] for example in EXAMPLES.values()),
            *MODELS,
        }
    )


def claim(text: str, notation: str | None = None) -> ModelSyntaxError:
    """The error of a text in a format of another program."""
    with pytest.raises(ModelSyntaxError) as found:
        read(text, notation)
    return found.value


@pytest.mark.parametrize(("name", "text", "line"), TEXTS)
def test_the_message_says_whose_format_it_is_and_where_that_is_seen(name: str, text: str, line: int) -> None:
    found = claim(text)
    assert found.message == f"This is {name}, which the kit does not read"
    assert found.line == line
    assert (found.column or 0) <= len(text.split("\n")[line - 1])
    assert not text.split("\n")[line - 1][(found.column or 1) - 1].isspace()


@pytest.mark.slow
def test_the_ends_of_lines_change_nothing() -> None:
    told = [claim(text.replace("\n", "\r\n")) for _, text, _ in TEXTS]
    assert [(f"This is {name}, which the kit does not read", line) for name, _, line in TEXTS] == [
        (found.message, found.line) for found in told
    ]


@pytest.mark.slow
@pytest.mark.parametrize("notation", DIALECTS)
def test_where_a_notation_was_asked_for_its_own_reader_says_what_is_wrong_and_the_format_is_a_guess(notation: str) -> None:
    with every_row() as row:
        for name, text, _ in TEXTS:
            with row(repr(text)):
                with pytest.raises(LSystemError) as found:
                    read(text, notation)
                assert "which the kit does not read" not in found.value.message
                assert f"Perhaps this is {name}, which the kit does not read." in str(found.value.hint)


def test_a_message_of_a_reader_that_was_named_ends_with_the_guess() -> None:
    found = claim("#lang lindenmayer racket\n## axiom ##\nF", "abop")
    assert str(found.hint).endswith("Perhaps this is a model in Racket's language lindenmayer, which the kit does not read.")


def test_each_format_has_five_texts() -> None:
    assert {row.name for row in formats()} == set(FOREIGN)
    assert all(len(texts) >= 5 for texts in FOREIGN.values())


@pytest.mark.parametrize("row", formats(), ids=lambda row: row.name)
def test_a_message_says_what_the_kit_lacks_and_what_to_try(row) -> None:
    found = claim(next(text for text, _ in FOREIGN[row.name] if next(each for each in formats() if each.sign_in(text)) is row))
    assert row.name in found.message
    assert found.hint == f"{row.lacks}. {row.advice}"
    assert re.fullmatch(r"[A-Z].*[^.]\. [A-Z].*\.", f"{row.lacks}. {row.advice}")


@pytest.mark.parametrize(
    "text",
    [
        "axiom: A(1)\nA(t) : t < 5 -> B(t+1)",
        "#define n 5\nAxiom: A(0)\nA(t) : t < 5 --> F(1)A(t+1)",
        "axiom: X\nX -> F + X",
        "axiom: A(1)\nA(x) : x < 5 -> F(1) A(x+1)",
        "* # A(1),\nA(x) # F(x) RU30 A(x*0.8)",
        "axiom: F\nF -> F-F++F-F",
        "axiom: A\nA -> F[+A]A",
        "steps: 3\naxiom: F\nF -> F+F",
        "angle: 45\nsteps: 8\naxiom: A\np1: A -> F[+A]A",
        "steps: 5\nangle: 20\naxiom: A\nA -> F[+A]\\/A",
    ],
)
def test_what_is_advised_is_read(text: str) -> None:
    assert read(text).axiom


# --- never the kit's own ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_no_text_in_a_notation_of_the_kit_is_called_foreign() -> None:
    called = {text: foreign_format(text) for text in (*own_texts(), *MENTIONS)}
    assert {text: found for text, found in called.items() if found} == {}


@st.composite
def spoilt(draw: st.DrawFn) -> str:
    """A text of the kit's in which characters or lines were lost, moved, repeated or put in."""
    text = draw(st.sampled_from(own_texts()))
    for _ in range(draw(st.integers(1, 4))):
        parts = text.split("\n") if draw(st.booleans()) else list(text)
        glue = "\n" if len(parts) < len(text) else ""
        start, end = sorted((draw(st.integers(0, len(parts))), draw(st.integers(0, len(parts)))))
        end = min(end, start + draw(st.integers(0, 3)))
        put = draw(st.one_of(st.just([]), st.just(parts[:2]), st.lists(st.characters(max_codepoint=126), max_size=3)))
        text = glue.join((*parts[:start], *put, *parts[end:]))
    return text


@pytest.mark.slow
@given(spoilt())
def test_no_text_with_a_slip_is_called_foreign(text: str) -> None:
    assert foreign_format(text) is None


@pytest.mark.parametrize("text", [text for text in MENTIONS if not text.startswith("From")])
def test_what_only_mentions_another_program_is_read(text: str) -> None:
    assert read(text).axiom


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("derivation length: 5 // n; or so\nAxiom: A\nB", "An arrow is missing"),
        ("# a plant\naxiom: A", "This is not a production"),
        ('axiom: "A"', "Quotation marks are not needed here"),
        ("#defin n 3\nAxiom: A\nA --> B", "This is not a production"),
    ],
)
def test_a_slip_has_the_message_of_its_notation(text: str, message: str) -> None:
    with pytest.raises(LSystemError) as found:
        read(text)
    assert message in found.value.message
    assert "which the kit does not read" not in str(found.value)


# --- names and time ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("a/b/TREE.RGG", "a model in XL"),
        ("x.rkt", "a model in Racket"),
        ("x.ipynb", "a Jupyter notebook"),
        ("x.py", "a program in Python"),
        ("x.l", None),
        ("x.txt", None),
        ("lpy", None),
        ("", None),
    ],
)
def test_the_name_of_a_file_is_a_hint(name: str, told: str | None) -> None:
    assert told in name_hint(name) if told else name_hint(name) is None


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "\n",
        " ",
        "a",
        "Axiom:",
        "production:\n",
        "<",
        "{",
        "import ",
        "#",
        "A = ",
        "__a",
        "x:",
        "'a",
        '"a',
        "Axiom:\n",
        "#lang\n",
        "(",
        "module ",
        "void a(",
        "p1:",
        "\t\n",
        "Axiom: A\nderivation length: 1\n",
        "private ",
        "<type> ",
        "[{",
        "==",
        "# ",
        "1\n",
        "# a\n",
        "1 # a\n",
        "axiom a\n",
        "recursion 3\n",
        "rules:\n",
        "for a in ",
    ],
)
def test_a_glance_is_short(text: str) -> None:
    long = (text * GLANCE)[: 20 * GLANCE]
    with spent() as taken:
        foreign_format(long)
    assert taken.seconds < 0.5 * 3  # half a second on a quick machine


@pytest.mark.parametrize("id", ["K5", "J4", "P7"])
def test_a_text_that_is_read_is_not_searched_for_signs(id: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ForeignFormat, "sign_in", lambda *_: pytest.fail("searched"))
    assert read(system(id).source).productions


def test_a_text_too_long_to_be_read_is_recognised() -> None:
    page = "<!DOCTYPE html>\n" + "<p>A plant</p>\n" * 20_000
    with pytest.raises(LSystemError, match="This is a page as HTML"):
        read(page)
