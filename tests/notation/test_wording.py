"""Problems are records; each dialect words them, and quotes its own spelling."""

import ast
import re
from pathlib import Path

import pytest

import lsys_kit.notation
from lsys_kit.errors import LSystemError
from lsys_kit.notation.analysis.problems import Problem
from lsys_kit.notation.dialects.cellwork.dialect import CELLWORK
from lsys_kit.notation.dialects.map.dialect import MAP
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.syntax.wording import KIT_SPELLING, Wording, worded

ROOM = Path(lsys_kit.notation.__file__).parent
WORDINGS = KIT_SPELLING.wordings
DIALECT_WORDINGS = {
    code: wording
    for spelling in (MAP.spelling, CELLWORK.spelling, *(dialect.spelling for dialect in DIALECTS.values()))
    for code, wording in spelling.wordings.items()
}
NAMED = {
    "context in {}": ("decomposition", "interpretation"),
    "several modules in {}": ("decomposition", "interpretation"),
    "number of {}": ("steps", "rounds"),
    "no {}": ("axiom", "angle"),
    "{} never applied": ("production", "decomposition rule"),
}
"""The codes that are put together from two parts."""


def codes(path: Path) -> set[str]:
    """The codes of the problems that a file makes."""
    calls = (node for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call))
    firsts = [node.args[0] for node in calls if getattr(node.func, "id", "") in ("problem", "Problem") and node.args]
    texts = [
        part.value if isinstance(part, ast.Constant) else None
        for first in firsts
        for part in ([first.body, first.orelse] if isinstance(first, ast.IfExp) else [first])
    ]
    patterns = [
        "".join(p.value if isinstance(p, ast.Constant) else "{}" for p in first.values)
        for first in firsts
        if isinstance(first, ast.JoinedStr)
    ]
    return {text for text in texts if text} | {pattern.format(name) for pattern in patterns for name in NAMED[pattern]}


def test_every_problem_has_a_wording_and_every_wording_a_problem() -> None:
    found = set().union(*map(codes, ROOM.rglob("*.py"))) | {"symbol as value"}
    assert found == WORDINGS.keys() | DIALECT_WORDINGS.keys()


@pytest.mark.parametrize("code", sorted(WORDINGS))
def test_a_wording_ends_as_its_part_of_a_message_does(code: str) -> None:
    """A message is a sentence without its full stop, a hint or a note has one."""
    wording: Wording = WORDINGS[code]
    note = code.endswith(
        (
            "never matches",
            "never applied",
            "final sign",
            "no probability",
            "number of values",
            "query",
            "several replaced",
            "passed over",
            "as modules",
            "as angle",
            "decimal comma",
            "only in time",
            "no further",
            "drawn as itself",
            "in quotation marks",
            "used nowhere",
        )
    )
    assert wording.message.endswith(".") == note
    assert wording.hint is None or wording.hint.endswith(".")


def test_a_suggestion_takes_the_place_of_the_hint() -> None:
    spelling = DIALECTS["cpfg"].spelling
    unknown = {"name": "dt", "known": '"st"'}
    assert worded(Problem("unknown name", subject=unknown, suggestion="st"), spelling)[1] == 'Did you mean "st"?'
    assert worded(Problem("unknown name", subject=unknown), spelling)[1] == 'Known here: "st".'


@pytest.mark.parametrize(
    ("notation", "text", "message"),
    [
        ("abop", "axiom: A\nA -> B(min(1, 2) == 1)", '"min(1, 2) == 1" is true or false, but a number is needed here'),
        ("grogra", "\\axiom a,\na # b(min(1, 2) = 1)", '"min(1, 2) = 1" is true or false, but a number is needed here'),
        (
            "mathematica",
            "AXIOM[a]; LRule[LEFT[], PRED[a], RIGHT[], SUCC[b[Min[1, 2] == 1]]]",
            '"Min[1, 2] == 1" is true or false, but a number is needed here',
        ),
        ("cpfg", "Axiom: A\nA(x) --> B((x > 0 ? 2 : 1) / 0 * t)", 'I do not know the name "t"'),
        ("cpfg", "#define w (1 > 0 ? 2 : 1) / 0\nAxiom: A", '"(1 > 0 ? 2 : 1)/0" has no value: division by zero'),
    ],
)
def test_an_expression_is_quoted_as_its_dialect_spells_it(notation: str, text: str, message: str) -> None:
    with pytest.raises(LSystemError, match=re.escape(message)):
        read(text, notation)


@pytest.mark.parametrize(
    ("notation", "text", "note"),
    [
        ("abop", "axiom: A\nA(x) -> B", "The production A(x) can never match: no module A with 1 parameter occurs."),
        ("cpfg", "Axiom: A\nB < A(x) --> B", "The production B < A(x) can never match: no module A with 1 parameter occurs."),
        (
            "mathematica",
            "AXIOM[a]; LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[b]]",
            "The production a[i] can never match: no module a with 1 parameter occurs.",
        ),
    ],
)
def test_a_note_quotes_modules_as_their_dialect_writes_them(notation: str, text: str, note: str) -> None:
    assert note in read(text, notation).notes


@pytest.mark.parametrize(
    ("notation", "text", "hint"),
    [
        ("abop", "axiom: A\nA -> B(t)", 'as in "A(t) -> A(t+1)"; a constant on a line before, as in "dt = 0.5".'),
        ("cpfg", "Axiom: A\nA --> B(t)", 'as in "A(t) --> A(t+1)"; a constant on a line before, as in "#define dt 0.5".'),
        ("cpfg", "A --> B", 'Give the first word on a line of its own, as in "Axiom: A".'),
        ("mathematica", "LRule[LEFT[], PRED[a], RIGHT[], SUCC[b]]", 'Give the first word, as in "axiom = AXIOM[A];".'),
        ("grogra", "\\const angle 3,\n\\axiom a,\na # b", 'Type "\\angle 3,".'),
    ],
)
def test_a_hint_shows_the_arrow_and_the_declarations_of_its_dialect(notation: str, text: str, hint: str) -> None:
    with pytest.raises(LSystemError) as error:
        read(text, notation)
    assert hint in (error.value.hint or "")
