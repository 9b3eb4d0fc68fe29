"""Errors: what went wrong, where, and what to try."""

from __future__ import annotations

import pytest

import lsys_kit.errors as errors
from lsys_kit.errors import LSystemError, ModelLimitError, named, printable


def test_there_is_one_tree_of_errors() -> None:
    kinds = [kind for name, kind in vars(errors).items() if name.endswith("Error")]
    assert len(kinds) == 6
    assert all(issubclass(kind, LSystemError) for kind in kinds)


@pytest.mark.parametrize(
    ("start", "end", "place"),
    [
        (0, None, (1, 1, 2)),
        (3, 5, (1, 4, 6)),
        (6, 8, (1, 7, 8)),
        (7, 9, (2, 1, 3)),
        (7, 99, (2, 1, 7)),
        (13, None, (2, 7, 8)),
        (99, None, (2, 7, 8)),
        (3, 3, (1, 4, 5)),
    ],
)
def test_the_place_is_counted_from_one(start: int, end: int | None, place: tuple[int, int, int]) -> None:
    error = LSystemError("wrong", "A -> B\nB -> A", start, end)
    assert (error.line, error.column, error.end) == place


def test_the_line_is_quoted_with_a_caret() -> None:
    assert str(LSystemError("This is wrong", "A -> B\n\tB -> A", 8, 9, "Do better.")) == (
        "This is wrong (line 2, column 2). Do better.\n   B -> A\n   ^"
    )
    assert str(LSystemError("This is wrong", "A -> B", 2, 4)) == "This is wrong (line 1, column 3).\n  A -> B\n    ^^"


def test_without_a_text_there_is_no_place() -> None:
    for error in (LSystemError("Wrong"), LSystemError("Wrong", "A"), LSystemError("Wrong", None, 3)):
        assert str(error) == "Wrong."
        assert error.line is error.column is error.end is None


def test_a_long_line_is_quoted_in_part() -> None:
    text = "".join(chr(97 + i % 26) for i in range(1_000))
    said = str(LSystemError("Wrong", text, 500, 503)).split("\n")
    assert len(said[1]) == 102
    assert said[2].count("^") == 3
    assert said[1][said[2].index("^")] == text[500]


def test_the_caret_does_not_leave_the_line() -> None:
    said = str(LSystemError("Wrong", "A -> B   ", 5, 9)).split("\n")
    assert said[2] == "       ^"


@pytest.mark.parametrize(
    ("character", "shown", "name"),
    [
        ("a", "a", '"a"'),
        ("\t", " ", "U+0009"),
        ("\u202e", "?", "RIGHT-TO-LEFT OVERRIDE"),
        ("\ud800", "?", "U+D800"),
        ("х", "х", '"х" (CYRILLIC SMALL LETTER HA)'),
        ('"', '"', '"""'),
    ],
)
def test_what_cannot_be_seen_is_named(character: str, shown: str, name: str) -> None:
    assert printable(character) == shown
    assert named(character) == name


def test_a_limit_says_what_it_is_and_what_would_be_needed() -> None:
    error = ModelLimitError("Too large", limit=5, needed=7, partial="kept", hint="Take less.")
    assert (error.limit, error.needed, error.partial, str(error)) == (5, 7, "kept", "Too large. Take less.")


def test_a_notebook_shows_the_message_alone() -> None:
    assert LSystemError("Wrong", hint="Try again.")._render_traceback_() == ["LSystemError: Wrong. Try again."]
