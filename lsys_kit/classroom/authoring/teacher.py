"""Checks of the teacher's page: that it has the answers, the tables and the minutes of the lesson."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.told import nearly
from lsys_kit.classroom.authoring.written import Written, numbers_in
from lsys_kit.classroom.lessons.entries import is_right, number_of
from lsys_kit.classroom.lessons.lesson import LETTERS, Blank, Table
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.translation import gettext

_TIME = re.compile(r"minutes|minuten|min\.?|time|zeit|duration|dauer", re.IGNORECASE)
_OF_TIME = re.compile(r"(\d{1,4})(?: ?(?:minutes?|minuten|min\.?|'))?")
_TOTAL = re.compile(r"(?:in )?(?:total|sum|all|together)|insgesamt|zusammen|summe", re.IGNORECASE)


def teacher_findings(written: Written) -> Iterator[Finding]:
    """Of the page: whether there is one, and whether it says what the lesson does."""
    lesson = written.lesson
    if lesson is None:
        return
    if not written.teacher:
        if lesson.vote:
            yield finding(written.declared_at, "no_teacher", name=written.name)
        return
    right = next((LETTERS[at] for at, each in enumerate(lesson.vote.options) if each.right), "") if lesson.vote else ""
    if right and f"**{right}**" not in written.teacher:
        vote = re.search(r"^.*\bvote: .*$", written.teacher, re.MULTILINE | re.IGNORECASE)
        yield finding(written.teacher_at(vote[0] if vote else "## Answers"), "teacher_answer", letter=right)
    for table in lesson.tables:
        yield from _table(written, table)
    yield from _counts(written, lesson.tables)
    minutes = _minutes(written.teacher_part(written.said(lambda: gettext("Minutes"))))
    if minutes and sum(minutes) != lesson.minutes:
        yield finding(written.teacher_at("## Minutes"), "teacher_minutes", sum=sum(minutes), minutes=lesson.minutes)


def _counts(written: Written, tables: Iterable[Table]) -> Iterator[Finding]:
    """ "18 cells" among the answers, where a column of cells has no 18, nor any other place of the lesson."""
    known = {*numbers_in(written.declared_text).values()}.union(
        *({*numbers_in(cell.source).values()} for cell in written.cells)
    )
    for table in tables:
        for column, title in enumerate(table.columns):
            noun = prose_text(title).split()[0]
            right = [_plain(row[column]) for row in table.rows]
            for found in re.finditer(
                rf"(?<![\w.,])(\d[\d,]{{1,12}}) {re.escape(noun)}\b",
                written.teacher_part(written.said(lambda: gettext("Answers"))),
            ):
                number = number_of(found[1].replace(",", ""))
                near = next((each for each in right if number_of(each) and _beside(found[1], each)), None)
                if column and near and number is not None and number not in known:
                    yield finding(written.teacher_at(found[0]), "teacher_count", given=found[0], id=table.id, near=near)


def _beside(given: str, right: str) -> bool:
    """Whether a number is the next one, or another one but for a digit."""
    one, two = number_of(given.replace(",", "")), number_of(right)
    return nearly(given, right) or (one is not None and two is not None and abs(one - two) == 1)


def _minutes(part: str) -> list[int]:
    """The minutes of the parts of a lesson, as a sentence or a table gives them."""
    plan = re.search(r"\b\d{1,4} minutes?: ([^.]{0,600}+)\.", part)
    if plan:
        return [int(each) for each in re.findall(r"(?<![\w.])(\d+)(?=,|$|;| *\()", " ".join(plan[1].split()))]
    title, *rows = _rows(part) or [[]]
    column = next((at for at, each in enumerate(title) if _TIME.fullmatch(each)), None)
    cells = [
        cells[column]
        for cells in rows
        if column is not None and len(cells) == len(title) and not any(map(_TOTAL.fullmatch, cells))
    ]
    found = [_OF_TIME.fullmatch(cell) for cell in cells if cell.strip("-: ")]
    return [int(each[1]) for each in found if each] if all(found) else []


def _rows(text: str) -> list[list[str]]:
    """The rows of the first table of a text."""
    lines = [line.strip() for line in text.partition("\n|")[2].partition("\n\n")[0].splitlines()]
    return [[each.strip(" *") for each in line.strip("|").split("|")] for line in lines]


def _table(written: Written, table: Table) -> Iterator[Finding]:
    """What the page has otherwise than a table: its title, a row that it has under that title, or else an answer."""
    text = " ".join(written.teacher.split())
    title = " ".join(table.title.split())
    _, found, below = written.teacher.rpartition(f"**{table.title}**")
    printed = below.strip().partition("\n\n")[0] if found else ""
    rows = [[each.strip() for each in line.strip().strip("|").split("|")] for line in printed.splitlines() if line[:1] == "|"]
    wanted = [title, *(" ".join(blank.right[0].split()) for _, _, blank in table.blanks)]
    if missing := next((each for each in wanted if each not in text), None):
        yield finding(written.teacher_at(table.title), "teacher_table", id=table.id, missing=missing[:60])
        return
    for row in table.rows:
        same = [cells for cells in rows if cells[0] and _plain(cells[0]) == _plain(row[0]) and len(cells) == len(row)]
        if len(same) != 1:
            continue
        for column, cell, stands in zip(table.columns, row, same[0], strict=True):
            right, within = (cell.right, cell.within) if isinstance(cell, Blank) else ((cell,), "0")
            if number_of(stands) is not None and number_of(right[0]) is not None and not is_right(stands, right, within):
                said = {
                    "id": table.id,
                    "row": _plain(row[0]),
                    "column": prose_text(column),
                    "given": stands[:60],
                    "right": right[0],
                }
                yield finding(_at(written, printed, same[0]), "teacher_row", **said)


def _plain(cell: str | Blank) -> str:
    return prose_text(cell.right[0] if isinstance(cell, Blank) else cell).strip()


def _at(written: Written, printed: str, cells: list[str]) -> str:
    line = next(each for each in printed.splitlines() if [part.strip() for part in each.strip().strip("|").split("|")] == cells)
    start = written.teacher.find(printed)
    number = written.teacher[: written.teacher.find(line, start)].count("\n") + 1
    return f"teacher/{written.name}.md, line {number}"
