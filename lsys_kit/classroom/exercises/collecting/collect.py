"""The marks of a class, from the notebooks that its students have handed in.

Answers are taken from notebooks as data, and each notebook is read and checked in a child process with limits of time and
memory: one that is endless, huge, broken or malicious costs its own row of the table alone. What the answers are compared with
is computed once, before the first child begins.
"""

from __future__ import annotations

import codecs
import csv
import io
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

from lsys_kit.budget import limits
from lsys_kit.classroom.child_processes import Failed, in_child_processes
from lsys_kit.classroom.exercises.check import checked
from lsys_kit.classroom.exercises.collecting.submissions import COMPUTED, answers_in
from lsys_kit.classroom.exercises.judging import wrong_answers
from lsys_kit.classroom.exercises.registry import exercise_of, exercises
from lsys_kit.classroom.handed_in import HandedIn, content_of, handed_in
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.notation.read import read_word
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.pictures.style.labels import visible

ENDING = ".ipynb"
MOST_BYTES = 20_000_000
"""The greatest size of a notebook."""
SECONDS = 20
"""So many seconds of processor time the answers of one notebook may take together."""
MOST_REMARKS, LONGEST_REMARK = 20, 250
"""So many remarks are made on one student, each of so many characters."""
_FORMULA_SIGNS = tuple("=+-@＝＋－＠")
"""With these characters cells begin that a spreadsheet takes for formulas (OWASP, "CSV Injection")."""


@dataclass(frozen=True)
class Marks:
    """What one student has reached.

    Attributes
    ----------
    student
        The name of the notebook, or of the folder with several.
    scores
        From 0 to 1, by exercise; those that were not answered are missing.
    remarks
        The replies to what is not right, and what could not be read.
    """

    student: str
    scores: Mapping[str, float] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()


def collect(folder: str | Path, own: str | None = None) -> list[Marks]:
    """The marks of all who have handed in notebooks.

    Parameters
    ----------
    folder
        Notebooks, one for each student, or folders, one for each student, with notebooks in them.
    own
        A folder with exercises of one's own, which are known beside those of the kit.

    Raises
    ------
    ModelFileError
        There is no such folder, there are no notebooks in it, or there are mistakes in the exercises of one's own.
    """
    files = handed_in(folder, ENDING)
    if own is not None:
        exercises(own)
    _prepare()
    readable = [each for each in files if not each.problem]
    results = in_child_processes(scores_in, [(each.path, own) for each in readable], SECONDS, "checked")
    found = dict(zip(readable, results, strict=True))
    return [_marks(list(own), found) for _, own in groupby(files, key=lambda each: Path(each.name).parts[0])]


def _prepare() -> None:
    """Work out what answers are compared with, and load what reads them: children then find it done.

    Of an exercise with mistakes its check says so.
    """
    for notation in DIALECTS:
        with suppress(LSystemError):
            read_word("A", notation)
    for exercise in exercises():
        with suppress(LSystemError):
            wrong_answers(exercise)
            checked(exercise, exercise.solution, 0, False, "")


def _marks(files: Sequence[HandedIn], results: Mapping[HandedIn, object]) -> Marks:
    """The marks of one student: where an exercise stands in several notebooks, the better score counts."""
    scores: dict[str, float] = {}
    remarks: dict[str, list[str]] = {}
    for file in files:
        match results.get(file, Failed(file.problem)):
            case {"scores": dict(found), "replies": dict(replies), "problems": list(problems)}:
                better = {id: score for id, score in found.items() if score > scores.get(id, -1)}
                scores |= better
                remarks |= {id: [f"{id}: {replies[id]}"] if id in replies else [] for id in better}
                remarks[file.name] = [*map(str, problems)]
            case Failed(reason):
                remarks[file.name] = [reason]
    return Marks(files[0].student, scores, tuple(remark for each in remarks.values() for remark in each))


# In a child process


def scores_in(handed: tuple[Path, str | None]) -> dict[str, object]:
    """The scores of the answers in a notebook, with the replies to those that are not right.

    With it comes the folder of further exercises, of which a child that was not forked knows nothing.
    """
    path, own = handed
    scores, replies, problems = dict[str, float](), dict[str, str](), list[str]()
    try:
        answers = answers_in(_text_of(content_of(path, MOST_BYTES)))
    except ModelFileError as mistake:
        return {"scores": scores, "replies": replies, "problems": [mistake.message]}
    known = {exercise.id for exercise in exercises()}
    if own is not None and answers.found.keys() - known:
        exercises(own)
        known = {exercise.id for exercise in exercises()}
    problems += answers.problems
    problems += [f'there is no exercise "{quotable(id)}"' for id in answers.found if id not in known]
    end = time.process_time() + SECONDS - 5
    for id, answer in answers.found.items():
        if id in known and answer is COMPUTED:
            problems.append(f"{id}: the answer would have to be computed, and nothing is run here")
        elif id in known and time.process_time() > end:
            problems.append(f"{id}: the answers before it took all the time")
        elif id in known:
            _check(id, answer, scores, replies)
    return {"scores": scores, "replies": replies, "problems": problems}


def _text_of(content: bytes) -> str:
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        raise ModelFileError("It is written in UTF-16, not in UTF-8: open it in Jupyter, and save it again")
    return content.decode("utf-8-sig", errors="replace")


def _check(id: str, answer: object, scores: dict[str, float], replies: dict[str, str]) -> None:
    """Note the score of an answer, and the first line of the reply if it is not right; nothing is kept for the teacher."""
    try:
        with limits(bytes=2**28):
            verdict = checked(exercise_of(id), answer, 0, False, "")
    except LSystemError as mistake:
        scores[id], replies[id] = 0.0, mistake.message
    except Exception as fault:  # even a fault of the kit itself must not cost the other answers
        scores[id], replies[id] = 0.0, f"It could not be checked ({type(fault).__name__})"
    else:
        if verdict.said != "Not answered yet":
            scores[id] = round(float(verdict), 4)
        if verdict.said not in ("Correct", "Not answered yet"):
            replies[id] = f"{verdict.said}. {verdict.message}".splitlines()[0].strip()


# The table


def marks_table(marks: Sequence[Marks]) -> str:
    """Marks as comma-separated values (RFC 4180): a row for each student, a column for each exercise, their sum, remarks.

    >>> print(marks_table([Marks("ann", {"1.1": 1.0, "1.2": 0.4}), Marks("=1+1", remarks=("it is no notebook",))]), end="")
    student,1.1,1.2,score,remarks
    ann,1.0,0.4,1.4,
    '=1+1,,,0.0,it is no notebook
    """
    columns = _columns(marks)
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["student", *map(cell, columns), "score", "remarks"])
    for each in marks:
        scores, total = (each.scores.get(id, "") for id in columns), round(float(sum(each.scores.values())), 4)
        rows.writerow([cell(quotable(each.student)), *scores, total, cell(" / ".join(_first(each.remarks)))])
    return text.getvalue()


def _columns(marks: Sequence[Marks]) -> list[str]:
    """The exercises that somebody has answered, in their order."""
    answered = {id for each in marks for id in each.scores}
    order = {exercise.id: number for number, exercise in enumerate(exercises())}
    return sorted(answered, key=lambda id: order.get(id, len(order)))


def _first(remarks: Sequence[str]) -> Iterator[str]:
    """As many remarks as a cell has room for, each no longer than a line or two."""
    yield from (remark[:LONGEST_REMARK] for remark in remarks[:MOST_REMARKS])
    if len(remarks) > MOST_REMARKS:
        yield f"and {len(remarks) - MOST_REMARKS} more"


def cell(text: str) -> str:
    """A text as no spreadsheet takes it for a formula, all of it printable, and without semicolons, at which some cut cells.

    >>> cell("=1+1"), cell("a-b"), cell("a\\n=1"), cell("a;=1"), cell(" @x")
    ("'=1+1", 'a-b', 'a?=1', 'a,=1', "' @x")
    """
    shown = visible(text).replace(";", ",")
    return f"'{shown}" if shown.lstrip()[:1] in _FORMULA_SIGNS else shown
