"""Checks of the text: what is declared stands in it, links lead somewhere, and nothing is told before it is asked."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from urllib.parse import unquote

from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.written import Cell, Written
from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.notation.analysis.checks import suggestion

_LINK = re.compile(r"(!?)\[([^\[\]\n]{0,500}+)\]\(\s*+<?([^)\[\s>]{1,500}+)>?[^)\[\n]{0,200}+\)")
_IMAGE = re.compile(r"<img\b(?![^<>]{0,1000}\balt\s*+=\s*+[\"'][^\"'])[^<>]{0,1000}>", re.IGNORECASE)
_ELSEWHERE = re.compile(r"[a-z][a-z+.-]*:", re.IGNORECASE)
_HEADING = re.compile(r"^#{1,6} ++(.*)$", re.MULTILINE)
_BOLD = re.compile(r"\*\*([a-z][a-z-]{1,40}(?: [a-z-]{1,40})?)\*\*(?!\*)")
_TEMPLATE = "**Advice.**"
MOST_LINKS = 1_000
"""So many links of a cell are looked at, and so many pictures."""
LEAST_DIGITS, LEAST_LETTERS = 3, 12
"""Answers of so many characters are looked for on the page; shorter ones stand there anyhow."""
GLOSSARY = frozenset(
    {
        "alphabet",
        "apex",
        "axiom",
        "bracket",
        "branch",
        "context",
        "derivation",
        "filament",
        "growth_function",
        "growth_matrix",
        "heterocyst",
        "homomorphism",
        "internode",
        "interpretation",
        "module",
        "parameter",
        "parametric",
        "petri_net",
        "place",
        "polarity",
        "production",
        "stage_diagram",
        "stochastic",
        "successor",
        "predecessor",
        "symbol",
        "token",
        "transition",
        "turtle",
        "parallel_rewriting",
        "sequential_rewriting",
    }
)
"""Words of the field that a lesson has to explain, if it is the one that explains them."""


def head_findings(written: Written) -> Iterator[Finding]:
    """Of what is declared: whether it is on the page; and whether advice of the template is there still."""
    for cell in written.cells:
        if not cell.is_code and _TEMPLATE in cell.source:
            yield finding(written.at(cell, cell.line_of(_TEMPLATE)), "template")
    lesson = written.lesson
    if lesson is None:
        return
    text = _plain(" ".join(cell.source for cell in written.cells if not cell.is_code))
    said = {"title": [lesson.title], "question": [lesson.question], "number of minutes": [f"{lesson.minutes} minutes"]}
    said |= {"objective": [*lesson.objectives], "summary": [lesson.summary]}
    for what, texts in said.items():
        for each in texts:
            if _plain(each) not in text:
                at = written.declared_line(each[:40])
                yield finding(at, "missing_text", what=what, text=each[:80], file=written.declared_at)


def _plain(text: str) -> str:
    return " ".join(re.sub(r"[*`_]", "", text).casefold().split())


def link_findings(written: Written) -> Iterator[Finding]:
    """Of links and pictures: whether they are there, and have a text."""
    headings = {_anchor(each) for cell in written.cells if not cell.is_code for each in _HEADING.findall(cell.source)}
    for cell in written.cells:
        if cell.is_code:
            continue
        text = re.sub(r"`[^`\n]*`", lambda found: " " * len(found[0]), cell.source)
        for found in islice(_LINK.finditer(text), MOST_LINKS):
            where, address = written.at(cell, text[: found.start()].count("\n") + 1), found[3]
            if found[1] and not found[2].strip():
                yield finding(where, "no_alt")
            if _ELSEWHERE.match(address):
                continue
            file, _, place = address.partition("#")
            if found[1]:
                if not _is_there(written, file):
                    yield finding(where, "no_picture", address=address)
            elif file and not _is_there(written, file):
                names = [path.name for path in written.place.notebooks.glob("*.ipynb")]
                hint = suggestion(Path(file).name[:60], names) or ""
                yield finding(where, "link", address=address[:80], hint=hint)
            elif not file and unquote(place) not in headings:
                yield finding(where, "heading", address=unquote(place)[:80], hint=suggestion(place[:60], headings) or "")
        for image in islice(_IMAGE.finditer(cell.source), MOST_LINKS):
            yield finding(written.at(cell, cell.source[: image.start()].count("\n") + 1), "no_alt")


def _anchor(heading: str) -> str:
    return re.sub(r"[*`]|<[^<>]{0,200}>", "", heading.strip().rstrip("#")).strip().replace(" ", "-")


def _is_there(written: Written, file: str) -> bool:
    """Whether a file is there, in the folder or in the course that is handed out."""
    folder = written.place.notebooks
    path = (folder / unquote(file)).resolve()
    if path.is_file() and path.is_relative_to(written.place.root.resolve()):
        return True
    names = {f"notebooks/{name}.ipynb" for _, name in written.course.lessons}
    names |= {f"exercises/{path.stem}.ipynb" for place in written.course.places for path in place.questions.glob("*.toml")}
    root = written.place.root.resolve()
    target = path.relative_to(root).as_posix() if path.is_relative_to(root) else ""
    return target in names or (written.place.is_kits and target in course_files())


def order_findings(written: Written) -> Iterator[Finding]:
    """Of the order: answers that stand before their questions, and words that are used before they are explained."""
    asked: dict[str, Cell] = {}
    for call in written.calls:
        question = written.question_of(call) if call.function == "predict" else None
        if question:
            asked.setdefault(question, call.cell)
    first = next((call.cell for call in written.calls if call.function == "vote"), None)
    lesson = written.lesson
    for each in lesson.predictions if lesson else ():
        if each.question in asked:
            for answer in dict.fromkeys([each.answer, *each.right]):
                yield from _told(written, answer, asked[each.question], each.question)
    if lesson and lesson.vote and first:
        reply = _plain(next(option.reply for option in lesson.vote.options if option.right))
        for cell in written.cells[: first.number]:
            if len(reply) > 20 and reply in _plain(cell.seen):
                yield finding(written.at(cell), "told_vote")
    yield from _terms(written)


def _told(written: Written, answer: str, asked: Cell, question: str) -> Iterator[Finding]:
    """An answer that stands in a text not far before its question, and not in the question itself."""
    wanted = _plain(prose_text(answer))
    number = number_of(wanted)
    if len(wanted) < (LEAST_LETTERS if number is None else LEAST_DIGITS):
        return
    if wanted in _plain(prose_text(question)):
        return
    pattern = re.compile(rf"(?<![\w.,]){re.escape(wanted)}(?![\w]|[.,]\d)")
    for cell in written.cells[1 : asked.number - 1]:  # the first announces what will be learnt
        if not cell.is_code and pattern.search(_plain(cell.seen)):
            yield finding(written.at(cell), "told", answer=answer[:60])
            return


def _terms(written: Written) -> Iterator[Finding]:
    """Words in bold are explained where they stand so first; before that they may not be used."""
    texts = [cell for cell in written.cells if not cell.is_code]
    explained: dict[str, Cell] = {}
    for cell in texts:
        for term in _BOLD.findall(cell.seen):
            if term.replace(" ", "_").removesuffix("s") in GLOSSARY:
                explained.setdefault(term, cell)
    for term, later in explained.items():
        pattern = re.compile(rf"\b{re.escape(term)}s?\b", re.IGNORECASE)
        for cell in texts[1:]:  # the first announces what will be learnt
            if cell.number >= later.number:
                break
            if found := pattern.search(cell.prose):
                yield finding(written.at(cell, cell.line_of(found[0])), "term", term=term, later=later.number)
                break
