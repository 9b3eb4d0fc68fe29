"""Answers in a notebook, read as data: it is parsed, and nothing of it is run.

Of the cells only what somebody has written down is taken: the text, number or list in `answer = ...`, or in `check("1.1", ...)`
itself. Cells are read from the first to the last; where an exercise is checked several times, the last counts, as in a
notebook that is run. Where the line with `check` is missing, the id of the cell says to which exercise its answer belongs.
What would have to be computed is no answer here, except for sums and fractions of numbers, which are taken as they are written.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from lsys_kit.errors import ModelFileError

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
    """Whether a statement is `answer = ...`."""
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
            yield _exercise_of(cell.get("id"), text), text


def _exercise_of(id: object, source: str) -> str:
    """The exercise to which a cell belongs, by its id or by what it checks; "" where neither says so."""
    if isinstance(id, str) and (cell := _ANSWER_CELL.fullmatch(id)):
        return f"{cell[1]}.{cell[2]}"
    checked = _CHECK.search(source[:MOST_CHARACTERS])
    return checked[1].strip() if checked else ""


def _python(source: str) -> str:
    """A cell without the lines that Jupyter alone understands."""
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
