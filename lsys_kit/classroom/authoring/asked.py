"""Checks of what a lesson asks: votes, tables and predictions, and whether its minutes can hold them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

from lsys_kit.budget import limits
from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.written import Call, Written, numbers_in
from lsys_kit.classroom.catalogue import catalogued, entry
from lsys_kit.classroom.exercises.asked import answer_by, right_history
from lsys_kit.classroom.exercises.check import BUDGET
from lsys_kit.classroom.lessons.entries import is_right, number_of, readings
from lsys_kit.classroom.lessons.lesson import Blank, Lesson, Table
from lsys_kit.classroom.lessons.rows import step_of
from lsys_kit.classroom.lessons.slips import exercise_of, row_name
from lsys_kit.classroom.lessons.vote import drawn
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.classroom.panel.controls import slider_ranges
from lsys_kit.classroom.places import kit_place
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelNameError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import normalised, number_text
from lsys_kit.notation.model.system import LSystem

LONGER = 1.75
"""An option that is so many times as long as each other one is seen to be the right one."""
WORDS_A_MINUTE, A_CELL, A_QUESTION, SLACK = 150, 0.35, 1.5, 1.3
"""How fast a text is read, how many minutes a cell to fill and a question take at least, and what may be done at home."""


def vote_findings(written: Written) -> Iterator[Finding]:
    """Of votes: those that are asked, and the one that is declared."""
    votes = [call for call in written.calls if call.function == "vote" and not call.has("options") and len(call.node.args) < 2]
    places = (*written.course.places, kit_place())
    keys = {_key(name) for place in places for name in place.names()}
    own = [call for call in votes if _key(call.text(0)) == written.key]
    for call in votes:
        asked = call.text(0)
        if asked is None or call in own:
            continue
        if _key(asked) in keys:
            yield finding(written.at(call.cell, call.line), "other_vote", key=asked)
        elif not call.has("again"):
            hint = suggestion(asked[:60], [written.key]) or f'This one is "{written.key}".'
            yield finding(written.at(call.cell, call.line), "no_vote", key=asked[:60], hint=hint)
    if written.lesson is None or written.lesson.vote is None:
        return
    if not own:
        yield finding(written.declared_line("[vote]"), "vote_never", key=written.key)
    else:
        yield from _order(written, own)
    yield from _options(written, written.lesson)


def _key(name: str | None) -> str:
    """The key of a lesson as it is asked for."""
    text = (name or "").strip()
    return text.zfill(2) if text.isdecimal() else text[:2] if re.match(r"\d\d_", text) else text


def _order(written: Written, own: list[Call]) -> Iterator[Finding]:
    others = [call.cell.number for call in written.calls if call.function in ("predict", "worksheet")]
    if all(call.has("again") for call in own):
        yield finding(written.at(own[0].cell, own[0].line), "vote_first", key=written.key)
    elif others and own[0].cell.number > min(others):
        yield finding(written.at(own[0].cell, own[0].line), "vote_order")
    if not any(call.has("again") for call in own):
        yield finding(written.at(own[0].cell, own[0].line), "vote_once", key=written.key)


def _options(written: Written, lesson: Lesson) -> Iterator[Finding]:
    assert lesson.vote is not None
    where, options = written.declared_line("[vote]"), lesson.vote.options
    texts = [" ".join(prose_text(each.text).casefold().split()) for each in options]
    if len({*texts}) < len(texts):
        yield finding(where, "same_options")
    right = next(at for at, each in enumerate(options) if each.right)
    others = [len(text) for at, text in enumerate(texts) if at != right]
    at = written.declared_line(options[right].text[:40])
    if len(texts[right]) > LONGER * max(others) + 5:
        yield finding(at, "longest")
    elif LONGER * len(texts[right]) + 5 < min(others):
        yield finding(at, "shortest")
    try:
        with limits(**BUDGET):
            drawn(lesson.vote.picture)
    except LSystemError as fault:
        yield finding(written.declared_line("picture"), "picture", fault=fault.message, hint=fault.hint or "")


def table_findings(written: Written) -> Iterator[Finding]:
    """Of tables: those that are shown, and whether the numbers in those that are declared are right."""
    shown = set()
    for call in written.calls:
        key, id = call.text(0), call.text(1)
        if call.function != "worksheet" or key is None or id is None:
            continue
        if _key(key) != written.key:
            hint = suggestion(key[:60], [written.key]) or f'This lesson is "{written.key}".'
            yield finding(written.at(call.cell, call.line), "no_table", key=key[:60], id=id[:60], hint=hint)
            continue
        known = [each.id for each in written.lesson.tables] if written.lesson else []
        shown.add(id)
        if id not in known:
            hint = suggestion(id[:60], known) or f"Its tables are: {', '.join(known) or 'none'}."
            yield finding(written.at(call.cell, call.line), "no_table", key=key, id=id[:60], hint=hint)
    for table in written.lesson.tables if written.lesson else ():
        where = written.declared_line(f'id = "{table.id}"')
        if table.id not in shown:
            yield finding(where, "table_never", id=table.id, key=written.key)
        yield from _unrounded(written, table)
        yield from _counted(written, table)
        for row in range(len(table.rows)):
            for column in range(1, len(table.columns)):
                yield from _cell(where, table, row, column)


def _cell(where: str, table: Table, row: int, column: int) -> Iterator[Finding]:
    cell = table.rows[row][column]
    given, within = (cell.right, cell.within) if isinstance(cell, Blank) else ((cell,), "0")
    said = {"table": table.id, "row": row_name(table, row), "column": prose_text(table.columns[column])}
    if isinstance(cell, Blank) and (meant := _meant(table, row, column)):
        yield finding(where, "no_number", **said, given=given[0], meant=meant)
    for slip in cell.slips if isinstance(cell, Blank) else ():
        for answer in slip.answer:
            if is_right(answer, given, within):
                yield finding(where, "slip_right", **said, answer=answer)
    try:
        with limits(**BUDGET):
            asked = exercise_of(table, row, column)
            found = None if asked is None else answer_by(asked, right_history(asked))
    except LSystemError as fault:
        yield finding(where, "table_system", **said, fault=fault.message, hint=fault.hint or "")
        return
    if isinstance(found, (int, Fraction, float)) and not is_right(number_text(found), given, within):
        yield finding(where, "table", **said, given=given[0], found=number_text(found))


def _meant(table: Table, row: int, column: int) -> str:
    """The numbers that may be meant by a right answer that is read as a text, as with a comma, in a column of numbers."""
    cells = [cell.right if isinstance(cell, Blank) else (cell,) for cell in (each[column] for each in table.rows)]
    are_numbers = [any(number_of(each) is not None for each in cell) for cell in cells]
    given = cells[row][0]
    if are_numbers[row] or sum(are_numbers) != len(cells) - 1 or " " in given:
        return ""
    return " or ".join(number_text(normalised(each)) for each in readings(given))


def _unrounded(written: Written, table: Table) -> Iterator[Finding]:
    """Decimals that have to be met exactly, where others of their column need not."""
    for column in range(1, len(table.columns)):
        cells = [(row, each[column]) for row, each in enumerate(table.rows)]
        blanks = [(row, cell) for row, cell in cells if isinstance(cell, Blank)]
        near = {_places(cell): cell.within for _, cell in blanks if number_of(cell.within)}
        for row, cell in blanks:
            if near and not number_of(cell.within) and _places(cell) >= max(1, min(near)):
                said = {"table": table.id, "row": row_name(table, row), "column": prose_text(table.columns[column])}
                yield finding(
                    written.declared_line(f'id = "{table.id}"'),
                    "no_within",
                    **said,
                    given=cell.right[0],
                    near=next(iter(near.values())),
                )


def _places(cell: Blank) -> int:
    """How many decimals the first of the right answers has."""
    return len(cell.right[0].partition(".")[2]) if number_of(cell.right[0]) is not None else 0


def _counted(written: Written, table: Table) -> Iterator[Finding]:
    """Cells that count a symbol of a system that the title names: as in "living tips `*` of `K8`", or as a column is called."""
    named = re.findall(r"`([^`\s]{1,8})`", table.title)
    ids = [each for each in named if re.fullmatch(r"[A-Z]{1,2}\d{1,3}[a-z]?", each)]
    symbols = [each for each in named if each not in ids]
    if len(ids) != 1 or len(symbols) > 1:
        return
    for row, column, blank in table.blanks:
        if column == 0 or number_of(blank.right[0]) is None or (table.of and table.of[column].asks):
            continue
        title = prose_text(table.columns[column])
        seed = number_of(str(table.rows[row][0])) if table.columns[0] == "seed" else None
        found = _many(ids[0], (*symbols, title)[0], step_of(table, row, column), None if seed is None else int(seed))
        if found is not None and not is_right(str(found), blank.right, blank.within):
            said = {"table": table.id, "row": row_name(table, row), "column": title}
            yield finding(written.declared_line(f'id = "{table.id}"'), "table", **said, given=blank.right[0], found=str(found))


def _many(id: str, symbol: str, step: int | None, seed: int | None) -> int | None:
    """How many of a symbol, with any index, a step of a system of the catalogue has; None where it depends on constants."""
    try:
        with limits(**BUDGET):
            system = catalogued(id)
            if step is None or not isinstance(system, LSystem) or slider_ranges(system, {}):
                return None
            words = [[str(each.symbol).partition("_")[0] for each in word] for word in derive(system, step, seed=seed)]
    except LSystemError:
        return None
    return words[-1].count(symbol) if any(symbol in word for word in words) else None


def prediction_findings(written: Written) -> Iterator[Finding]:
    """Of predictions: that what is asked and what is declared are the same, and that no code gives an answer away."""
    declared = {each.question for each in written.lesson.predictions} if written.lesson else set()
    asked = set()
    for call in written.calls:
        question = written.question_of(call) if call.function == "predict" else None
        if call.function != "predict" or question is None:
            continue
        asked.add(question)
        if written.lesson and question not in declared:
            yield finding(written.at(call.cell, call.line), "prediction_undeclared", question=question[:80])
        if call.text(1) is not None and not call.cell.folded:
            yield finding(written.at(call.cell, call.line), "unfolded")
    for each in written.lesson.predictions if written.lesson else ():
        for right in each.right:
            if said := _other_number(right, f"{each.answer} {each.question}"):
                at = written.declared_line(each.question[:40])
                yield finding(at, "accepted_number", right=right[:60], number=said, answer=each.answer[:60])
                break
    for question in declared - asked:
        yield finding(written.declared_line(question[:40]), "prediction_never", question=question[:80])


def _other_number(right: str, answer: str) -> str:
    """A number of what is accepted that is none of an answer's, not even rounded or as a percentage."""
    known = numbers_in(answer)
    if re.search(r"[\^(]", right):
        return ""
    for text, number in numbers_in(right).items():
        places = len(text.partition(".")[2])
        near = Fraction(51, 100) / 10**places if places else Fraction(0)
        if number and not any(abs(number - each * by) <= near for each in known.values() for by in (1, 100, Fraction(1, 100))):
            return text
    return ""


def plan_findings(written: Written) -> Iterator[Finding]:
    """Of the plan: whether the minutes can hold what is asked, and the systems that are named."""
    lesson = written.lesson
    if lesson is None:
        yield finding(f"{written.name}.ipynb", "undeclared", file=written.declared_at)
        return
    for id in lesson.systems:
        try:
            entry(id)
        except ModelNameError as fault:
            yield finding(written.declared_line("systems"), "system", id=id, hint=fault.hint or "")
    words = sum(len(cell.prose.split()) for cell in written.cells)
    cells = sum(len(table.blanks) for table in lesson.tables)
    questions = sum(call.function in ("predict", "vote", "ask") for call in written.calls)
    estimate = round((words / WORDS_A_MINUTE + A_CELL * cells + A_QUESTION * questions) / SLACK)
    if estimate > lesson.minutes:
        counts = {"words": words, "cells": cells, "questions": questions}
        yield finding(written.declared_line("minutes"), "too_much", estimate=estimate, minutes=lesson.minutes, **counts)
