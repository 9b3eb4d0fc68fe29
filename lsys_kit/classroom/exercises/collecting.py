"""The marks of a class, from the notebooks that its students have handed in: parsed as data, and never run.

Of the cells only what somebody has written down is taken: the text, number or list in `answer = ...`, or in `check("1.1", ...)`
itself. Cells are read from the first to the last; where an exercise is checked several times, the last counts, as in a notebook
that is run. Where the line with `check` is missing, the id of the cell says to which exercise its answer belongs. What would
have to be computed is no answer here, except for sums and fractions of numbers, which are taken as they are written.

Each notebook is read and checked in a child process with limits of time and memory: one that is endless, huge, broken or
malicious costs its own row of the table alone. What the answers are compared with is computed once, before the first child
begins.
"""

from __future__ import annotations

import ast
import codecs
import csv
import io
import json
import re
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

from lsys_kit.budget import limits
from lsys_kit.classroom.child_processes import Failed, in_child_processes
from lsys_kit.classroom.exercises.check import checked
from lsys_kit.classroom.exercises.declarations import questions_folder
from lsys_kit.classroom.exercises.judging import wrong_answers
from lsys_kit.classroom.exercises.registry import exercise_of, exercises
from lsys_kit.classroom.handed_in import HandedIn, content_of, handed_in
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.notation.read import read_word
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.pictures.style.labels import visible

# Answers in a notebook


MOST_CHARACTERS, MOST_CELLS = 20_000, 2_000
"""The greatest length of a cell, and the greatest number of cells."""
COMPUTED = object()
"""In place of an answer that would have to be computed."""
_TEXTS_IN = ("read", "Decimal")
"""Functions of which a text that is their only argument is the answer."""
_ANSWER_CELL, _CHECK = re.compile(r"exercise-(.{1,60})-([^-]{1,20})-answer"), re.compile(r"""check\(\s*["']([^"']{1,99})["']""")
"""The id of a cell for an answer, and the line that checks it; both name the exercise."""


@dataclass
class Answers:
    """The answers of a notebook by exercise, `COMPUTED` where they would have to be run; and what was not read."""

    found: dict[str, object] = field(default_factory=dict)
    problems: list[str] = field(default_factory=list)


def answers_in(notebook: str) -> Answers:
    """The answers in the text of a notebook.

    Raises
    ------
    ModelFileError
        It is no notebook.

    Examples
    --------
    >>> cell = {"cell_type": "code", "source": ['answer = "al br"\\n', 'check("1.1", answer)']}
    >>> answers_in(json.dumps({"cells": [cell]})).found
    {'1.1': 'al br'}
    """
    answers, names, unchecked = Answers(), dict[str, object](), list[tuple[str, str, object]]()
    for number, (exercise, source) in enumerate(_code_cells(notebook), 1):
        if "check" not in source and "=" not in source:
            continue
        where = f"{exercise}: " * bool(exercise) + f"code cell {number}"
        try:
            statements = ast.parse(_python(source)).body if len(source) <= MOST_CHARACTERS else None
        except (SyntaxError, ValueError, RecursionError, MemoryError) as fault:
            line = f", line {fault.lineno}" if isinstance(fault, SyntaxError) and fault.lineno else ""
            answers.problems.append(f"{where} is no Python{line}")
            continue
        if statements is None:
            answers.problems.append(f"{where} has more than {MOST_CHARACTERS:,} characters")
            continue
        found = {id: answer for statement in statements for id, answer in _checked(statement, names)}
        answers.found.update(found)
        if found:  # which may be what a cell before has written
            unchecked = [each for each in unchecked if each[0] not in ("", *found)]
        elif any(map(_is_answer, statements)) and names["answer"] is not ...:
            unchecked.append((exercise, where, names["answer"]))
    for exercise, where, answer in unchecked:
        if exercise and exercise not in answers.found:
            answers.found[exercise] = answer
            answers.problems.append(f'{exercise}: the line check("{exercise}", answer) is missing; it was checked all the same')
        elif not exercise:
            answers.problems.append(f"{where} has an answer and no line check(...), so that nobody knows to which exercise")
    return answers


def _is_answer(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Assign) and [ast.unparse(target) for target in statement.targets] == ["answer"]


def _code_cells(notebook: str) -> Iterator[tuple[str, str]]:
    """The texts of the code cells, each with its exercise, as far as it is known."""
    try:
        content = json.loads(notebook)
    except (ValueError, RecursionError):
        raise ModelFileError("It is no notebook, or was cut off") from None
    cells = content.get("cells") if isinstance(content, dict) else None
    if isinstance(content, dict) and "worksheets" in content:
        raise ModelFileError("It is a notebook of version 3 of the format: open it in Jupyter, and save it again")
    if not isinstance(cells, list):
        raise ModelFileError("It is no notebook: it has no cells")
    if len(cells) > MOST_CELLS:
        raise ModelFileError(f"It has more than {MOST_CELLS:,} cells")
    for cell in cells:
        if isinstance(cell, dict) and cell.get("cell_type") == "code":
            source = cell.get("source", "")
            text = source if isinstance(source, str) else "".join(map(str, source)) if isinstance(source, list) else ""
            yield _exercise_in(cell.get("id"), text), text


def _exercise_in(id: object, source: str) -> str:
    """The exercise to which a cell belongs, by its id or by what it checks; "" where neither says so."""
    if isinstance(id, str) and (cell := _ANSWER_CELL.fullmatch(id)):
        return f"{cell[1]}.{cell[2]}"
    checked = _CHECK.search(source[:MOST_CHARACTERS])
    return checked[1].strip() if checked else ""


def _python(source: str) -> str:
    return "\n".join("" if line.startswith(("%", "!", "?")) else line for line in source.split("\n"))


def _checked(statement: ast.stmt, names: dict[str, object]) -> Iterator[tuple[str, object]]:
    """The answers that a statement checks; what it assigns to a name is kept."""
    match statement:
        case (
            ast.Assign(targets=[ast.Name(id=name)], value=value)
            | ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as value)
        ):
            names[name] = written(value, names)
    if isinstance(statement, ast.Expr | ast.Assign):
        for node in ast.walk(statement):
            match node:
                case ast.Call(func=ast.Name(id="check") | ast.Attribute(attr="check"), args=given, keywords=options):
                    arguments = dict(zip(("exercise", "answer"), given, strict=False))
                    arguments |= {option.arg: option.value for option in options if option.arg in ("exercise", "answer")}
                    yield from _one_check(arguments, names)


def _one_check(arguments: Mapping[str, ast.expr], names: Mapping[str, object]) -> Iterator[tuple[str, object]]:
    match arguments.get("exercise"):
        case ast.Constant(value=str(exercise)):
            given = arguments.get("answer")
            yield exercise.strip(), ... if given is None else written(given, names)


def written(value: ast.expr, names: Mapping[str, object]) -> object:
    """What is written in an expression: a text, a number, a list of them; `COMPUTED` for all else.

    >>> written(ast.parse("[1, -2, 'a']", mode="eval").body, {}), written(ast.parse("42/2", mode="eval").body, {})
    ([1, -2, 'a'], '42 / 2')
    """
    match value:
        case ast.Constant(value=plain) if plain is ... or isinstance(plain, str | int | float | None):
            return plain
        case ast.Name(id=name):
            return names.get(name, COMPUTED)
        case ast.List(elts=parts) | ast.Tuple(elts=parts):
            found = [written(part, {}) for part in parts]  # without names, lists of lists of lists could not be kept small
            return COMPUTED if any(part is COMPUTED for part in found) else found
        case ast.Call(func=ast.Name(id=name), args=[ast.Constant(value=str(text))], keywords=[]) if name in _TEXTS_IN:
            return text
        case ast.Call(func=ast.Name(id="Fraction"), args=[above, below], keywords=[]) if _is_sum(above) and _is_sum(below):
            return f"({ast.unparse(above)}) / ({ast.unparse(below)})"
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() | float() as number)):
            return -number
    return ast.unparse(value) if _is_sum(value) else COMPUTED


def _is_sum(value: ast.expr) -> bool:
    """Whether numbers alone are added, subtracted, multiplied or divided."""
    match value:
        case ast.Constant(value=int() | float()):
            return True
        case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=part):
            return _is_sum(part)
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub() | ast.Mult() | ast.Div() | ast.Pow(), right=right):
            return _is_sum(left) and _is_sum(right)
    return False


# Marks


ENDING = ".ipynb"
MOST_BYTES = 20_000_000
"""The greatest size of a notebook."""
SECONDS = 20
"""So many seconds of processor time the answers of one notebook may take together."""
MOST_REMARKS, LONGEST_REMARK = 20, 250
"""So many remarks are made on one student, each of so many characters."""
UNKNOWN = "there is no exercise"
"""So a remark begins on an answer to an exercise that is not known."""
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
        own = str(questions_folder(own))
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
    problems += [f'{UNKNOWN} "{quotable(id)}"' for id in answers.found if id not in known]
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
