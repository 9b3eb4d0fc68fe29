"""Checks of what a lesson asks: votes, tables and predictions, and whether its minutes can hold them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

from lsys_kit.budget import limits
from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.written import Call, Written
from lsys_kit.classroom.catalogue import entry
from lsys_kit.classroom.exercises.asked import answer_by, right_history
from lsys_kit.classroom.exercises.check import BUDGET
from lsys_kit.classroom.lessons.entries import is_right
from lsys_kit.classroom.lessons.lesson import LETTERS, Blank, Lesson, Table
from lsys_kit.classroom.lessons.slips import exercise_of, row_name
from lsys_kit.classroom.lessons.vote import drawn
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.classroom.places import kit_place
from lsys_kit.errors import LSystemError, ModelNameError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import number_text

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
    if others and own[0].cell.number > min(others):
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
    page = written.place.notebooks / "teacher" / f"{written.name}.md"
    if not page.is_file():
        yield finding(written.declared_at, "no_teacher", name=written.name)
    elif f"**{LETTERS[right]}**" not in page.read_text("utf-8", errors="replace"):
        yield finding(f"teacher/{page.name}", "teacher_answer", letter=LETTERS[right])


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
        yield from _on_the_teachers_page(written, table)
        for row in range(len(table.rows)):
            for column in range(1, len(table.columns)):
                yield from _cell(where, table, row, column)


def _on_the_teachers_page(written: Written, table: Table) -> Iterator[Finding]:
    page = written.place.notebooks / "teacher" / f"{written.name}.md"
    if page.is_file():
        text = " ".join(page.read_text("utf-8", errors="replace").split())
        wanted = [table.title, *(blank.right[0] for _, _, blank in table.blanks)]
        if missing := next((each for each in wanted if " ".join(each.split()) not in text), None):
            yield finding(f"teacher/{page.name}", "teacher_table", id=table.id, missing=missing[:60])


def _cell(where: str, table: Table, row: int, column: int) -> Iterator[Finding]:
    cell = table.rows[row][column]
    given, within = (cell.right, cell.within) if isinstance(cell, Blank) else ((cell,), "0")
    said = {"table": table.id, "row": row_name(table, row), "column": prose_text(table.columns[column])}
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
    for question in declared - asked:
        yield finding(written.declared_line(question[:40]), "prediction_never", question=question[:80])


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
    page = written.place.notebooks / "teacher" / f"{written.name}.md"
    if page.is_file():
        part = page.read_text("utf-8", errors="replace").partition("\n## Minutes\n")[2].partition("\n## ")[0]
        plan = re.search(r"\b\d{1,4} minutes?: ([^.]{0,600}+)\.", part)
        parts = [int(each) for each in re.findall(r"(?<![\w.])(\d+)(?=,|$|;| *\()", " ".join(plan[1].split()))] if plan else []
        if parts and sum(parts) != lesson.minutes:
            yield finding(f"teacher/{page.name}", "teacher_minutes", sum=sum(parts), minutes=lesson.minutes)
