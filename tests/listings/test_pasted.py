"""A hundred texts as people paste them, typed from memory of real pages by others than the author of the readers.

Each says what it is: the system that is meant, in the kit's notation, or how it is refused, and where.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read

TEXTS = json.loads((Path(__file__).parent / "pasted" / "texts.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("row", TEXTS, ids=[f"{number:03}" for number in range(1, len(TEXTS) + 1)])
def test_a_text_as_somebody_pasted_it_is_read_as_it_is_meant_or_refused_where_it_is_wrong(row: dict[str, Any]) -> None:
    if "refused" in row:
        with pytest.raises(LSystemError) as found:
            read(row["text"])
        assert (found.value.message, found.value.line) == (row["refused"], row["line"])
        assert found.value.hint
    else:
        assert read(row["text"]) == read(row["reads"], row["notation"])


HUNDRED, SIXTY, THIRD, FOURTH, FIFTH, SIXTH = (
    json.loads((Path(__file__).parent / "pasted" / name).read_text(encoding="utf-8"))
    for name in (
        "typed.json",
        "typed_later.json",
        "typed_third.json",
        "typed_fourth.json",
        "typed_fifth.json",
        "typed_sixth.json",
    )
)
TYPED = [*HUNDRED, *SIXTY, *THIRD, *FOURTH, *FIFTH, *SIXTH]
"""Another hundred, then sixty, then 87, then 282, then 245, then 250, by people who had not seen the readers and said before
what each means: its axiom, rules and angle; of some of the last, too, as what symbols are drawn.

An outcome is "equal", "noted", where the kit's own note tells what it reads otherwise, or "refused" with a message and a hint.
"""


COPIES = [row for row in (*HUNDRED, *SIXTY, *THIRD, *FOURTH[::4]) if row["outcome"] == "equal"]
"""Those that are copied in other ways, too."""


def plain(text: object) -> str:
    """A text without its blanks."""
    return "".join(str(text).split())


def is_changed(rule: str) -> bool:
    """Whether a rule replaces something by another thing: that a symbol stays is said by some programs."""
    head, _, tail = rule.partition("->")
    return head != tail


def outcome(row: dict[str, Any]) -> str:
    """What came of a text, by what its author said; "wrong" where that is something else, and nobody is told."""
    try:
        found = read(row["text"])
    except LSystemError as error:
        said = (error.message, error.line, error.hint)
        return "refused" if said == tuple(row.get(part) for part in ("message", "line", "hint")) and error.hint else "wrong"
    if row["outcome"] == "refused":
        return "wrong"
    rules = sorted({*filter(is_changed, map(plain, found.productions))})
    meant = sorted(filter(is_changed, (plain(rule if rule.split("->")[1] else f"{rule}ε") for rule in row["rules"])))
    angle = row["angle"] is None or abs(float(found.angle) - row["angle"]) < 0.001
    same = (plain("".join(map(str, found.axiom))), rules, angle) == (plain(row["axiom"]), meant, True)
    same = same and ("drawn" not in row or {*map(plain, found.interpretation)} == {*row["drawn"]})
    return "wrong" if not same else "noted" if row.get("note", "") in found.notes else "equal"


@pytest.mark.parametrize("row", TYPED, ids=[f"{number:03}" for number in range(1, len(TYPED) + 1)])
def test_a_text_means_what_its_author_said_beforehand(row: dict[str, Any]) -> None:
    assert outcome(row) == row["outcome"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("texts", "equal", "noted", "refused"),
    [
        (HUNDRED, 77, 4, 19),
        (SIXTY, 42, 3, 15),
        (THIRD, 72, 10, 5),
        (FOURTH, 199, 9, 74),
        (FIFTH, 208, 11, 26),
        (SIXTH, 208, 19, 23),
    ],
    ids=["a hundred", "sixty", "the third", "the fourth", "the fifth", "the sixth"],
)
def test_few_texts_are_wrong_and_those_that_can_be_read_are_read(
    texts: list[dict[str, Any]], equal: int, noted: int, refused: int
) -> None:
    counts = Counter(map(outcome, texts))
    assert sum(counts.values()) == equal + noted + refused == len(texts)
    assert (counts["equal"], counts["noted"], counts["refused"]) == (equal, noted, refused)


COPIED: dict[str, Callable[[str], str]] = {
    "blanks that do not break": lambda text: text.replace(" ", "\u00a0"),
    "the ends of lines of Windows": lambda text: text.replace("\n", "\r\n"),
    "blanks at the ends of lines": lambda text: text.replace("\n", "  \n"),
    "a margin": lambda text: re.sub("^", "    ", text, flags=re.MULTILINE),
    "marks of direction": lambda text: f"\u200e{text}\u200f",
    "blanks without a width": lambda text: text.replace("F", "F\u200b"),
    "arrows of two signs": lambda text: re.sub(r"(?<=[\w)])[ ]?→", " −→", text),
}
"""How programs change a text that is copied."""


@pytest.mark.slow
@pytest.mark.parametrize("change", COPIED.values(), ids=COPIED)
def test_how_a_text_was_copied_changes_nothing(change: Callable[[str], str]) -> None:
    for row in COPIES:
        found, meant = read(change(row["text"])), read(row["text"])
        assert (found.axiom, found.productions, found.angle) == (meant.axiom, meant.productions, meant.angle), row["kind"]


ASIDES = ("25", "- 12 -", "[3]", "(1.2)", "/ b", "b", "c)", "X", "II", "p. 25", "Fig. 3", "—", "*", "KOCH")
"""What stands alone on a line of a page, and is no part of a rule."""
_RULE_ALONE = re.compile(r"[^\"'\n]*(?:→|->|=>|⟶)[^\"'\n]*")


@pytest.mark.parametrize("aside", ASIDES)
@pytest.mark.slow
def test_what_stands_alone_below_a_rule_is_never_taken_into_it_unsaid(aside: str) -> None:
    tried = 0
    for row in COPIES:
        lines = row["text"].split("\n")
        below = [index + 1 for index, line in enumerate(lines) if _RULE_ALONE.fullmatch(line)]
        meant = read(row["text"])
        for at in {*below[:1], *below[-1:]}:
            tried += 1
            try:
                found = read("\n".join([*lines[:at], aside, *lines[at:]]))
            except LSystemError:
                continue
            same = (found.axiom, found.productions, found.angle) == (meant.axiom, meant.productions, meant.angle)
            told = (aside, lines[at].strip() or aside) if at < len(lines) else (aside,)  # or what goes on below it is left out
            assert same or any(each in note for note in found.notes for each in told), (row["kind"], found.notes)
    assert tried > 50
