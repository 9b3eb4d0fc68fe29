"""Mutants are changes of what a program does, and nothing happens while they are off."""

from __future__ import annotations

import pytest

from tests.mutants.__main__ import drawn
from tests.mutants.changes import in_python, in_script


def news(text: str) -> list[str]:
    return [new for _, _, new, _ in in_python(f"def work(given):\n    {text}")]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("return a < b <= c", ["a <= b <= c", "a < b < c"]),
        ("return a is not b", ["a is b"]),
        ("return a and b", ["a or b"]),
        ("return not a", ["a"]),
        ("return a + 1", ["a - 1", "2"]),
        ("return True", ["False"]),
        ("if a: pass", ["not a"]),
        ("return [b for b in c if b]", ["not b"]),
        ("while a in b: pass", ["a not in b"]),
    ],
)
def test_what_a_function_does_is_changed(text: str, expected: list[str]) -> None:
    assert news(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "return 'a' + b",
        '"""Text 1."""',
        "raise ValueError(1)",
        "a: tuple[1]",
        "match a:\n        case 1: pass",
        "return f'{a + 1}'",
    ],
)
def test_what_is_said_is_left_alone(text: str) -> None:
    assert news(text) == []


def test_what_a_module_makes_when_it_is_imported_is_left_alone() -> None:
    assert list(in_python("LIMIT = 1\n\n@cache(2)\ndef work(a=3):\n    pass\n\nclass Work:\n    most = 4")) == []


def test_in_scripts_comments_texts_and_patterns_are_left_alone() -> None:
    text = """function work(a) { // a + 1
  if (a.every((b) => b)) return a.replace(/x - 1/g, "y < 2") + `${a} > 3`;
}"""
    assert [(where, new) for where, _, new, _ in in_script(text)] == [
        ("work", """if (!(a.every((b) => b))) return a.replace(/x - 1/g, "y < 2") + `${a} > 3`;"""),
        ("work", """if (a.every((b) => b)) return a.replace(/x - 1/g, "y < 2") - `${a} > 3`;"""),
    ]


@pytest.mark.slow
def test_a_seed_draws_the_same_mutants_again() -> None:
    assert list(drawn(0, 15)) == list(drawn(0, 15)) != list(drawn(1, 15))
    assert len(drawn(0, 15)) == 15
