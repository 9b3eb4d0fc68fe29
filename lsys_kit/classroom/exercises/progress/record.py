"""The record of tries: a line for each in a file beside the course, which a person can read and a spreadsheet opens.

It says when an exercise was tried, and whether it was solved, but nothing of the answer or of how near it was. Nothing is
written where there is no copy of the course, and a record that cannot be written or read stops no check.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from numbers import Number
from pathlib import Path

from lsys_kit.classroom.course import MANIFEST
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.files import append_line

FILE = "progress.csv"
"""The record, in the folder of the course."""
HEAD = "time,exercise,result"
SOLVED, TRIED = "solved", "tried"
MOST_BYTES = 1_000_000
"""A record is not made longer than that: some 30,000 tries."""
_TRIES = ("Correct", "Almost", "Not yet")
"""Verdicts on answers that could be read."""


@dataclass(frozen=True)
class Try:
    """An answer that was checked: to which exercise, and whether it was right."""

    exercise: str
    solved: bool


@dataclass(frozen=True)
class Record:
    """What was tried so far, in order.

    Attributes
    ----------
    tries
        Those in the file, then those that could not be kept there.
    folder
        The copy of the course that the file belongs to, or None.
    problem
        What is wrong with the file, in a sentence, or empty.
    """

    tries: tuple[Try, ...] = ()
    folder: Path | None = None
    problem: str = ""

    def solved(self, exercise: str) -> bool:
        """Whether an exercise was solved."""
        return Try(exercise, True) in self.tries

    def tried(self, exercise: str) -> int:
        """How often an exercise was tried, up to the first right answer.

        >>> Record((Try("1", False), Try("2", True), Try("1", True), Try("1", False))).tried("1")
        2
        """
        own = [each.solved for each in self.tries if each.exercise == exercise]
        return own.index(True) + 1 if True in own else len(own)


_seen: set[tuple[str, str | Number]] = set()
_not_kept: list[Try] = []
_said: set[str] = set()


def keep_try(exercise: str, answer: object, verdict: Verdict) -> str:
    """Keep what was tried, unless the same answer was tried before, or the exercise was solved.

    Returns
    -------
    str
        Why it could not be kept, in a sentence, if that was not said before; else nothing.
    """
    own = Try(" ".join(exercise.split()), verdict.said == "Correct")
    if verdict.said not in _TRIES or _was_seen(own.exercise, answer):
        return ""
    record = record_so_far()
    if record.solved(own.exercise):
        return ""
    problem = _append(record.folder, own) if record.folder else ""
    if problem or not record.folder:
        _not_kept.append(own)
    said_before = problem in _said
    _said.add(problem)
    return "" if said_before else problem


def _was_seen(exercise: str, answer: object) -> bool:
    """Whether the same text or number was an answer to the exercise before."""
    if not isinstance(answer, str | Number):
        return False
    key = exercise, " ".join(answer.split()) if isinstance(answer, str) else answer
    before = key in _seen
    _seen.add(key)
    return before


def record_so_far() -> Record:
    """What was tried so far, in this copy of the course and since Python began."""
    folder = course_folder()
    if folder is None:
        return Record(tuple(_not_kept))
    try:
        kept, left_out = _read(folder / FILE)
    except OSError as fault:
        return Record(tuple(_not_kept), folder, f"{FILE} cannot be read: {fault.strerror or fault}.")
    problem = f"In {FILE} {left_out} line{'s' * (left_out > 1)} cannot be read." if left_out else ""
    return Record((*kept, *_not_kept), folder, problem)


def course_folder() -> Path | None:
    """The copy of the course in which Python runs: the current folder, or one of two above it, with the manifest."""
    with suppress(OSError):
        here = Path.cwd()
        for folder in (here, *here.parents[:2]):
            if (folder / MANIFEST).is_file() and not (folder / MANIFEST).is_symlink():
                return folder
    return None


def _append(folder: Path, own: Try) -> str:
    """Add a line to the record; what is wrong if that fails."""
    path, line = folder / FILE, io.StringIO()
    when = datetime.now().strftime("%Y-%m-%d %H:%M")
    csv.writer(line, lineterminator="").writerow((when, own.exercise, SOLVED if own.solved else TRIED))
    try:
        if path.is_file() and path.stat().st_size > MOST_BYTES:
            return f"This try is not kept: {FILE} is full."
        append_line(path, line.getvalue(), HEAD)
    except (OSError, ValueError) as fault:
        return f"This try is not kept in {FILE}: {getattr(fault, 'strerror', None) or fault}."
    return ""


def _read(path: Path) -> tuple[tuple[Try, ...], int]:
    """The tries in a record, and how many of its lines are none."""
    if path.is_symlink() or (path.exists() and not path.is_file()):
        raise OSError("it is no file")
    if not path.exists():
        return (), 0
    with path.open("rb") as file:
        lines = file.read(2 * MOST_BYTES).decode("utf-8-sig", "replace").splitlines()
    found = list(_tries(line for line in lines if line.strip() and line.strip() != HEAD))
    tries = tuple(each for each in found if each)
    return tries, len(found) - len(tries)


def _tries(lines: Iterable[str]) -> Iterator[Try | None]:
    for line in lines:
        row: list[str] = []
        with suppress(csv.Error):
            row = next(csv.reader([line]), [])
        yield Try(row[1], row[2] == SOLVED) if len(row) == 3 and row[2] in (SOLVED, TRIED) else None
