"""Checks of the text: what is declared stands in it, links and references lead somewhere, words are explained."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from urllib.parse import unquote

from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.told import plain
from lsys_kit.classroom.authoring.written import FUNCTIONS, Cell, Written, python_tree
from lsys_kit.classroom.course import course_files
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.translation import gettext, languages

_LINK = re.compile(r"(!?)\[([^\[\]\n]{0,500}+)\]\(\s*+<?([^)\[\s>]{1,500}+)>?[^)\[\n]{0,200}+\)")
_IMAGE = re.compile(r"<img\b(?![^<>]{0,1000}\balt\s*+=\s*+[\"'][^\"'])[^<>]{0,1000}>", re.IGNORECASE)
_ELSEWHERE = re.compile(r"[a-z][a-z+.-]*:", re.IGNORECASE)
_HEADING = re.compile(r"^#{1,6} ++(.*)$", re.MULTILINE)
_BOLD = re.compile(r"\*\*([a-z][a-z-]{1,40}(?: [a-z-]{1,40})?)\*\*(?!\*)")
_NAMED = re.compile(r"(?:\b(?:called|call|calls|named)(?: \w+){0,4}|, the|\(the) $")
"""What stands before a word in bold that is explained there."""
_DETAILS = re.compile(r"<(/?)details\b", re.IGNORECASE)
_UNFINISHED = re.compile(r"\b(?:TODO|FIXME|TBD|XXX|[Ll]orem ipsum)\b")
_REFERRED = re.compile(r"\b(panel|table|curve|picture|drawing|panels|tables|curves)s? (?:of|in) section (\d{1,3})\b(?! of )")
_SECTION = re.compile(r"(?<!\*[,:] )\b[Ss]ections? (\d{1,3})\b(?! of )")
"""A section of the lesson; behind a title in italics it is one of another text."""
_HOLDS = {
    "panel": re.compile(r"\b(?:explore|compare)\("),
    "table": re.compile(r"^\|[ :|-]{3,}$|\bworksheet\(|\btable\b|summary\(|continuity\(|\bcounts?\b", re.MULTILINE),
    "curve": re.compile(r"\bplot\(|ensemble\(|\bcounts\b|\bgrowth|explore\(|vote\("),
    "picture": re.compile(r"!\[|<img|<svg|\w\("),
    "drawing": re.compile(r"!\[|<img|<svg|\w\("),
}
_TEMPLATE = "**Advice.**"
MOST_LINKS = 1_000
"""So many links of a cell are looked at, and so many pictures."""
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
    text = plain(" ".join(cell.source for cell in written.cells if not cell.is_code))
    said = {"title": [lesson.title], "question": [lesson.question]}
    if written.language in languages():
        said["number of minutes"] = [written.said(lambda: gettext("{number} minutes", number=lesson.minutes))]
    said |= {"objective": [*lesson.objectives], "summary": [lesson.summary]}
    for what, texts in said.items():
        for each in texts:
            if plain(each) not in text:
                at = written.declared_line("minutes" if what == "number of minutes" else each[:40])
                yield finding(at, "missing_text", what=what, text=each[:80], file=written.declared_at)


def link_findings(written: Written) -> Iterator[Finding]:
    """Of links and pictures: whether they are there, and have a text."""
    headings = {heading_anchor(each) for cell in written.cells if not cell.is_code for each in _HEADING.findall(cell.source)}
    for cell in written.cells:
        if cell.is_code:
            continue
        text = without_code(cell.source)
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


def without_code(text: str) -> str:
    """A text with blanks in place of what stands in it as code."""
    return re.sub(r"`[^`\n]*`", lambda found: " " * len(found[0]), text)


def heading_anchor(heading: str) -> str:
    """By what a link leads to a heading of its page."""
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
    return target in names or (written.course.is_kits and target in course_files())


def markup_findings(written: Written) -> Iterator[Finding]:
    """Of what is folded and never ends, so that the next part is swallowed; and of what is unfinished."""
    for cell in written.cells:
        if cell.is_code:
            continue
        text = without_code(cell.source)
        if asked := _asked_in(cell):
            yield finding(written.at(cell), "code_as_text", function=asked)
        opened, open_at = 0, 0
        for found in islice(_DETAILS.finditer(text), MOST_LINKS):
            opened, open_at = opened + (-1 if found[1] else 1), found.start()
            if opened < 0:
                break
        if opened:
            where = written.at(cell, cell.source[:open_at].count("\n") + 1)
            yield finding(
                where,
                "details",
                what="<details>" if opened > 0 else "</details>",
                other="</details>" if opened > 0 else "<details>",
            )
        if unfinished := _UNFINISHED.search(text):
            yield finding(written.at(cell, cell.line_of(unfinished[0])), "unfinished", word=unfinished[0])


def _asked_in(cell: Cell) -> str:
    """A function of lessons that a text calls, if the text is nothing but Python."""
    begins = cell.source.lstrip().startswith(("from lsys_kit", *(f"{each}(" for each in FUNCTIONS)))
    tree = python_tree(cell.source) if begins else None
    nodes = ast.walk(tree) if isinstance(tree, ast.Module) else ()
    called = [each.func.id for each in nodes if isinstance(each, ast.Call) and isinstance(each.func, ast.Name)]
    return next((each for each in called if each in FUNCTIONS), "")


def section_findings(written: Written) -> Iterator[Finding]:
    """Of references: that there is the section, and that it has the panel, the table, the curve of which a text speaks."""
    sections = {each.number: each for each in written.sections if each.number is not None}
    if not sections:
        return
    for cell in written.cells:
        for found in () if cell.is_code else _SECTION.finditer(cell.source):
            if int(found[1]) not in sections:
                most = f"The sections have numbers up to {max(sections)}."
                yield finding(written.at(cell, cell.line_of(found[0])), "no_section", number=found[1], hint=most)
        for what, text in () if cell.is_code else _REFERRED.findall(cell.source):
            kind, number = what.removesuffix("s"), int(text)
            section = sections.get(number)
            if section and not _HOLDS[kind].search("\n".join([section.text, *(each.source for each in section.code)])):
                others = [
                    str(each.number)
                    for each in sections.values()
                    if _HOLDS[kind].search("\n".join(one.source for one in each.code))
                ]
                hint = f"Such a one is in: {', '.join(others)}." if others else ""
                yield finding(
                    written.at(cell, cell.line_of(f"section {text}")), "no_such_part", what=kind, number=number, hint=hint
                )


def term_findings(written: Written) -> Iterator[Finding]:
    """Words in bold are explained where they stand so first; before that they may not be used."""
    texts = [cell for cell in written.cells if not cell.is_code]
    explained: dict[str, Cell] = {}
    for cell in texts:
        for found in _BOLD.finditer(cell.seen):
            if found[1].replace(" ", "_").removesuffix("s") in GLOSSARY or _NAMED.search(cell.seen[: found.start()][-40:]):
                explained.setdefault(found[1], cell)
    for term, later in explained.items():
        pattern = re.compile(rf"\b{re.escape(term)}s?\b", re.IGNORECASE)
        for cell in texts[1:]:  # the first announces what will be learnt
            if cell.number >= later.number:
                break
            if used := pattern.search(cell.prose):
                yield finding(written.at(cell, cell.line_of(used[0])), "term", term=term, later=later.number)
                break
