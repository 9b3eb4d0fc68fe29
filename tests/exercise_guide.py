"""The list of misconceptions in `.github/EXERCISES.md`, made from the table of misconceptions.

    python -m tests.exercise_guide

A test compares the guide with this list.
"""

from __future__ import annotations

from pathlib import Path

from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS, Misconception

GUIDE = Path(__file__).parent.parent / ".github" / "EXERCISES.md"
BEGIN, END = "<!-- made by: python -m tests.exercise_guide -->\n", "<!-- end of what is made -->"


def with_table(text: str) -> str:
    """The guide with the list of today."""
    before, rest = text.split(BEGIN)
    return f"{before}{BEGIN}{_table()}{END}{rest.split(END)[1]}"


def _table() -> str:
    rows = [f"| {each.name} | {_applies(each)} | {each.do} | {each.but} |" for each in MISCONCEPTIONS.values()]
    return "\n".join(["| name | applies to | That is what comes out if you ... | how it is |", "|---|---|---|---|", *rows, ""])


def _applies(misconception: Misconception) -> str:
    notes = ["; a number only where it is expected"] if misconception.faint else []
    notes += ["; nearly right"] if misconception.near else []
    return misconception.applies + "".join(notes)


if __name__ == "__main__":
    GUIDE.write_text(with_table(GUIDE.read_text(encoding="utf-8")), encoding="utf-8")
