"""Checks of what a page gives away, and of what it says otherwise after a question than its declared answer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.written import Call, Cell, Written, numbers_in
from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.lesson import Asked, Table
from lsys_kit.classroom.lessons.widget import prose_text

RUN = 6
"""So many words in a row are the same by no chance."""
LEAST_DIGITS, LEAST_LETTERS = 3, 12
"""Answers of so many characters are looked for on the page; shorter ones stand there anyhow, unless they have their noun."""
_WORD = re.compile(r"[^\W_]+(?:[.,'^_][^\W_]+)*")
_OF = re.compile(r"(?<![\w.,])(\d[\d,]{0,12}) of (?:the )?(\d[\d,]{0,12}) [^\W\d_]++")

_FIRST = re.compile(
    r"</summary>\s{1,10}(?:There are |It has |All |Never |Only )?"
    r"(\d[\d,]{0,12}(?=[:;,] |\.\n)|[A-Za-z]{2,10}(?:-[a-z]{2,10})?(?=[.:;,]\s))"
)


def plain(text: str) -> str:
    """A text without marks, capitals and more than one blank in a row."""
    return " ".join(re.sub(r"[*`_]", "", text).casefold().split())


def words(text: str) -> list[str]:
    """The words and numbers of a text."""
    return _WORD.findall(plain(text))


def runs(text: str) -> set[tuple[str, ...]]:
    """All runs of so many words."""
    found = words(text)
    return {tuple(found[at : at + RUN]) for at in range(len(found) - RUN + 1)}


def told_findings(written: Written) -> Iterator[Finding]:
    """Of answers that stand on the page before their question, or open below it."""
    asked = questions(written)
    lesson = written.lesson
    for each in lesson.predictions if lesson else ():
        if each.question in asked:
            answers = dict.fromkeys([each.answer, *each.right])
            yield from next(filter(None, ([*_told(written, answer, asked[each.question], each)] for answer in answers)), [])
    yield from _told_vote(written)
    yield from _open(written)


def questions(written: Written) -> dict[str, Cell]:
    """The cells in which predictions are asked, by their questions."""
    asked: dict[str, Cell] = {}
    for call in written.calls:
        question = written.question_of(call) if call.function == "predict" else None
        if question:
            asked.setdefault(question, call.cell)
    return asked


def _told(written: Written, answer: str, asked: Cell, each: Asked) -> Iterator[Finding]:
    """An answer that stands in a text before its question, and not in the question itself."""
    wanted = plain(prose_text(answer))
    number = number_of(wanted)
    if wanted in plain(prose_text(each.question)):
        return
    behind = ""
    if len(wanted) < (LEAST_LETTERS if number is None else LEAST_DIGITS):
        if number is None or len(wanted) < LEAST_DIGITS - 1:
            return
        later = " ".join(plain(cell.source) for cell in written.cells[asked.number :]) + plain(written.teacher_part("Answers"))
        nouns = set(re.findall(rf"(?<![\w.,]){re.escape(wanted)} ([^\W\d_]{{3,}})", later))
        behind = rf" (?:{'|'.join(map(re.escape, sorted(nouns)))})" if nouns else "(?!)"
    pattern = re.compile(rf"(?<![\w.,]){re.escape(wanted)}{behind}(?![\w]|[.,]\d)")
    for cell in written.cells[1 : asked.number - 1]:  # the first announces what will be learnt
        if not cell.is_code and pattern.search(plain(cell.seen)):
            yield finding(written.at(cell), "told", answer=answer[:60])
            return


def _told_vote(written: Written) -> Iterator[Finding]:
    """The right option of the vote, or its reply, of which words in a row stand on the page before the vote."""
    lesson, first = written.lesson, next((call.cell for call in written.calls if call.function == "vote"), None)
    if not (lesson and lesson.vote and first):
        return
    right = next(option for option in lesson.vote.options if option.right)
    wrong = [f"{each.text} | {each.reply}" for each in lesson.vote.options if not each.right]
    known = set[tuple[str, ...]]().union(*map(runs, [*wrong, lesson.vote.question, lesson.question]))
    for what, text in (("told_vote", right.reply), ("told_option", right.text)):
        for cell in written.cells[1 : first.number]:
            if not cell.is_code and (runs(text) - known) & runs(cell.seen):
                yield finding(written.at(cell), what)
                break


def _open(written: Written) -> Iterator[Finding]:
    """Answers that are not folded below a question: words in a row are those of the teacher's answers."""
    answers = runs(written.teacher_part("Answers"))
    for cell in () if not answers else written.cells[1:]:
        paragraphs = [each for each in cell.seen.split("\n\n") if each.strip()]
        asks = False
        for each in paragraphs:
            if asks and each[0] != "|" and runs(each) & answers:
                yield finding(written.at(cell, cell.line_of(each)), "open_answer")
                break
            asks = asks or each.rstrip("*_ \n").endswith("?")


def contradiction_findings(written: Written) -> Iterator[Finding]:
    """Of texts behind a question: that their numbers are those of the declared answer or table."""
    lesson = written.lesson
    if lesson is None:
        return
    predicted = {each.question: each for each in lesson.predictions}
    tables = {each.id: each for each in lesson.tables}
    elsewhere = {cell.number: {*numbers_in(cell.source).values()} for cell in written.cells}
    for call in written.calls:
        texts = [*_behind(written, call)]
        each = predicted.get(written.question_of(call) or "") if call.function == "predict" else None
        table = tables.get(call.text(1) or "") if call.function == "worksheet" else None
        if each:
            others = [*_otherwise(written, each.answer, texts, elsewhere)] or [*_other_count(written, each, texts)]
            yield from others or _other_first(written, each, texts)
        if table:
            answers = " ; ".join(prose_text(blank.right[0]) for _, _, blank in table.blanks)
            yield from _otherwise(written, answers, texts, {**elsewhere, 0: {*numbers_in(written.declared_text).values()}})
            yield from _of_otherwise(written, table, texts)


def _behind(written: Written, call: Call) -> Iterator[Cell]:
    """The texts behind a call, up to what is asked next."""
    asking = {each.cell.number for each in written.calls if each.function in ("predict", "worksheet", "vote", "ask")}
    for cell in written.cells[call.cell.number :]:
        if cell.number in asking:
            return
        if not cell.is_code:
            yield cell


def _otherwise(
    written: Written, answer: str, texts: Sequence[Cell], elsewhere: Mapping[int, set[Fraction]]
) -> Iterator[Finding]:
    """A number nearly that of an answer, behind its question, where the answer is not said."""
    for given, right in others_nearly("\n".join(cell.source for cell in texts), answer):
        cell = next(cell for cell in texts if given in cell.source)
        known = set[Fraction]().union(*(found for at, found in elsewhere.items() if at != cell.number))
        if not {*numbers_in(given).values()} <= known:
            yield finding(written.at(cell, cell.line_of(given)), "otherwise", given=given, right=right)


def others_nearly(text: str, answer: str) -> list[tuple[str, str]]:
    """The numbers of a text that are nearly those of an answer which it does not say, with those.

    >>> others_nearly("So 1/2.618 = 0.328.", "0.382"), others_nearly("There are 15 and 125 strokes.", "125")
    ([('0.328', '0.382')], [])
    """
    said = numbers_in(text)
    missing = [
        each if each[0].isdecimal() else str(number)
        for each, number in numbers_in(answer).items()
        if number not in said.values()
    ]
    return [(given, right) for right in missing for given in said if nearly(given, right)]


def nearly(text: str, right: str) -> bool:
    """Whether a number is another one but for a digit of three or more, or for two digits that are exchanged.

    >>> nearly("135", "125"), nearly("24", "42"), nearly("76", "79"), nearly("0.328", "0.382")
    (True, True, False, True)
    """
    a, b = text.replace(",", ""), right.replace(",", "")
    if len(a) != len(b) or a == b:
        return False
    other = [at for at, (one, two) in enumerate(zip(a, b, strict=True)) if one != two]
    exchanged = len(other) == 2 and other[1] - other[0] == 1 and a[other[0]] + a[other[1]] == b[other[1]] + b[other[0]]
    return exchanged or (len(other) == 1 and sum(each.isdecimal() for each in a) >= 3)


def _other_count(written: Written, each: Asked, texts: Sequence[Cell]) -> Iterator[Finding]:
    """ "There are 9 cells" behind "How many cells?", where the answer, 8, is not said at all."""
    nouns = "|".join(map(re.escape, re.findall(r"how many (?:\w+ )?([^\W\d_]{3,}s)\b", each.question.casefold())))
    answers, asked = numbers_in(each.answer), numbers_in(each.question)
    said = "\n".join(cell.source for cell in texts)
    if not nouns or not answers or {*answers.values()} & {*numbers_in(said).values()}:
        return
    for cell in texts:
        for found in re.finditer(rf"(?<![\w.,])(\d[\d,]{{0,12}}) (?:{nouns})\b", cell.source):
            if number_of(found[1].replace(",", "")) not in asked.values():
                yield finding(written.at(cell, cell.line_of(found[0])), "otherwise", given=found[0], right=each.answer[:60])
                return


def _other_first(written: Written, each: Asked, texts: Sequence[Cell]) -> Iterator[Finding]:
    """A fold behind a question that begins with one number, "Ten.", where the answer is another one, which no text says."""
    answers, asked = numbers_in(each.answer), numbers_in(each.question)
    if len(answers) != 1 or {*answers.values()} & {*numbers_in("\n".join(cell.source for cell in texts)).values()}:
        return
    for cell in texts:
        for found in _FIRST.finditer(cell.source):
            first = numbers_in(found[1])
            if len(first) == 1 and not {*first.values()} & {*asked.values()}:
                yield finding(written.at(cell, cell.line_of(found[0])), "otherwise", given=found[1], right=each.answer[:60])
                return


def _of_otherwise(written: Written, table: Table, texts: Sequence[Cell]) -> Iterator[Finding]:
    """ "76 of 100 trees" behind a table of 100 trees in which no cell is 76."""
    cells = [prose_text(cell if isinstance(cell, str) else " ".join(cell.right)) for row in table.rows for cell in row]
    known, totals = numbers_in(" ; ".join(cells)), numbers_in(prose_text(" ; ".join([table.title, *table.columns])))
    for cell in texts:
        for found in _OF.finditer(cell.source):
            part, whole = (number_of(each.replace(",", "")) for each in found.groups())
            if whole in totals.values() and part not in known.values():
                yield finding(written.at(cell, cell.line_of(found[0])), "of_otherwise", given=found[0].strip(), id=table.id)
