"""The pages of the site: a lesson, its exercises, the gallery, a reference, and the course with all of them."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import PurePosixPath
from posixpath import relpath
from types import SimpleNamespace
from typing import Any
from urllib.parse import quote

from lsys_kit.classroom.course import is_lesson
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.lessons.lesson import TRACKS, Lesson
from lsys_kit.classroom.lessons.widget import escaped_lines, html, prose_html, prose_text
from lsys_kit.classroom.panel.bundle import Data, compact, style, translated_words
from lsys_kit.classroom.panel.document import Program, deflated_text, document
from lsys_kit.classroom.panel.page import not_needed
from lsys_kit.classroom.site.markdown import Links, address_on_site, markdown_html, mathml
from lsys_kit.classroom.site.showing import PART
from lsys_kit.pictures.style.labels import escaped

INDEX = "index.html"
COURSE = "L-systems: a course"
"""The title of the first page."""
_KEPT = """<p class="note">The cells of this page have been run, and its panels move; nothing has to be installed. To change
rules and code, open the lesson in Jupyter: <code>lsys-kit lab</code>. Votes and tables are checked on the page itself: what is
right stands in it, and is no secret.</p>
"""
_ALL_KEPT = """<p class="note">These pages need neither Python nor a network. Their panels move, and votes, predictions and
tables are answered on the page. To change rules and code, and to work on the exercises, type <code>lsys-kit lab</code>: it
opens the course in Jupyter.</p>
"""
_HOW = """<div class="note"><p><strong>How to answer.</strong> Type <code>lsys-kit lab</code>, and open <code>{name}</code> in
JupyterLab. There is a cell below each question for the answer, which is checked when the cell is run, with hints after a
try.</p></div>
"""


_PANELS = frozenset({"panel", "compare"})
"""The scripts that only a page with panels calls, and those that they call."""


@dataclass(frozen=True)
class Entry:
    """A notebook on the site: its file, relative to the course, its title as a text, and what is declared of it if it is a
    lesson.
    """

    name: str
    title: str
    lesson: Lesson | None = None

    @property
    def page(self) -> str:
        """The file of its page, relative to the site."""
        return f"{self.name.removesuffix('.ipynb')}.html"

    @property
    def folder(self) -> str:
        """Its folder in the course."""
        return str(PurePosixPath(self.name).parent)


def notebook_page(entry: Entry, cells: Sequence[Any], entries: Sequence[Entry], live: bool = False) -> str:
    """The page of a notebook; cells of exercises are shown without the code that checks answers. On a live page, which comes
    from the server of a class, exercises can be answered."""
    links, parts, [head, *rest] = (
        partial(address_on_site, entry.name, {each.name for each in entries}),
        Parts(),
        _seen(entry, cells, live),
    )
    begin = cells_html([head], links, parts) + ("" if live else _note(entry)) + cells_html(rest, links, parts)
    row = _neighbours(entry, entries)
    body = (
        f'<a class="skip" href="#main">Skip to the text</a>\n<header>{_above(entry)}</header>\n'
        f'<main id="main">\n{begin}</main>\n<footer><nav aria-label="other pages">{row}</nav></footer>\n'
    )
    described = prose_text(entry.lesson.question) if entry.lesson else entry.title
    return document(entry.title, body, style("course"), described, _program(parts, live))


def index_page(entries: Sequence[Entry], live: bool = False) -> str:
    """The first page: the lessons with their questions, and what belongs to them."""
    lessons = [each for each in entries if is_lesson(each.name)]
    others = [each for each in entries if each.folder != "exercises" and each not in lessons]
    rows = "".join(_lesson_row(each, entries) for each in lessons)
    references = "".join(f'<li><a href="{escaped(each.page)}">{escaped(each.title)}</a></li>\n' for each in others)
    tracks = ", ".join(f'<span class="track">{letter}</span> {text}' for letter, text in TRACKS.items())
    body = f"""<a class="skip" href="#main">Skip to the lessons</a>
<main id="main" class="index">
<h1>{COURSE}</h1>
<p class="lead">Short rules can grow a plant. These lessons show how, from a row of cells to a hedge in the light: predict,
look, move a slider, change a rule.</p>
{"" if live else _ALL_KEPT}
<h2 id="lessons">Lessons</h2>
<p class="quiet">Each lesson belongs to a way through the course: {tracks}.</p>
<ol class="lessons">
{rows}</ol>
<h2 id="reference">To look at, and to look things up</h2>
<ul>
{references}</ul>
</main>
"""
    return document(COURSE, body, style("course"), "Lessons on L-systems with panels to move")


def _lesson_row(entry: Entry, entries: Sequence[Entry]) -> str:
    exercises = next((each for each in entries if each.name == f"exercises/{PurePosixPath(entry.name).name}"), None)
    told = entry.lesson
    facts = (
        [f"{told.minutes} minutes", *(f'<span class="track" title="{TRACKS[each]}">{each}</span>' for each in told.track)]
        if told
        else []
    )
    also = [f'<a href="{escaped(exercises.page)}">exercises</a>'] if exercises else []
    asked = f"<p>{prose_html(told.question)}</p>" if told else ""
    number = f"<span>{told.number}</span> " if told else ""
    return (
        f'<li><h3>{number}<a href="{escaped(entry.page)}">{escaped(entry.title)}</a></h3>{asked}'
        f'<p class="quiet">{" · ".join([*facts, *also])}</p></li>\n'
    )


def _seen(entry: Entry, cells: Sequence[Any], live: bool) -> list[Any]:
    if live and entry.folder == "exercises":
        cells = [_Answer(found[1]) if (found := _ANSWER.fullmatch(getattr(each, "id", ""))) else each for each in cells]
    return [each for each in cells if not (entry.folder == "exercises" and _checks(each))]


_ANSWER = re.compile(r"exercise-([\w-]+)-answer")
"""The id of the cell in which an exercise is answered."""


class _Answer(SimpleNamespace):
    """The place in which an exercise is answered on a live page."""

    cell_type, source = "answer", "answer"

    def __init__(self, id: str) -> None:
        super().__init__(exercise=id.replace("-", "."), outputs=[])


def _answer_html(cell: Any, parts: Parts) -> str:
    found = exercise_of(cell.exercise)
    options = [*letters(found)] if found.kind == "choice" else []
    data = {
        "id": found.id,
        "kind": found.kind,
        "title": found.title,
        "template": found.template,
        "hints": len(found.hints),
        "options": options,
    }
    return _part_html({"kind": "exercise", "data": data}, "", parts)


def _checks(cell: Any) -> bool:
    """Whether a cell of exercises asks for an answer, gets ready for that, or is there for marks alone."""
    if cell.cell_type != "code":
        return bool(getattr(cell, "id", "") == "marks")
    return any(called in cell.source for called in ("check", "progress(", "score(")) or not cell.source.strip()


def _note(entry: Entry) -> str:
    if entry.folder == "exercises":
        return _HOW.format(name=escaped(entry.name))
    return _KEPT if is_lesson(entry.name) else ""


def _above(entry: Entry) -> str:
    home = relpath(INDEX, entry.folder)
    return f'<nav aria-label="the course"><a href="{home}">{COURSE}</a></nav>'


def _neighbours(entry: Entry, entries: Sequence[Entry]) -> str:
    return "\n".join(
        f'<a class="{kind}" href="{escaped(relpath(other.page, entry.folder))}"><span>{label}</span> {escaped(other.title)}</a>'
        for kind, label, other in _others(entry, entries)
    )


def _others(entry: Entry, entries: Sequence[Entry]) -> Iterator[tuple[str, str, Entry]]:
    alike = [each for each in entries if each.folder == entry.folder and is_lesson(each.name) == is_lesson(entry.name)]
    place = alike.index(entry)
    pair, label = {"notebooks": ("exercises", "Exercises"), "exercises": ("notebooks", "Lesson")}.get(entry.folder, ("", ""))
    yield from (("before", "Before", each) for each in alike[:place][-1:])
    yield from (("also", label, each) for each in entries if each.name == f"{pair}/{PurePosixPath(entry.name).name}")
    yield from (("after", "Next", each) for each in alike[place + 1 :][:1])


def _program(parts: Parts, live: bool) -> Program | None:
    if not parts and not live:
        return None
    if live:  # rules can be edited: a panel may draw anything
        script = f'"use strict";\n{compact("class_page")}\nopenClassPage();\n'
    else:
        modes = {*_modes(parts)}
        script = f'"use strict";\n{compact("course", not_needed(*modes) if modes else _PANELS)}\nopenCoursePage();\n'
    words = {"words": translated_words("class_page", "panel", "filling", "voting")} if live else {}
    looks = style() + style("lessons") + (style("class_page") if live else "")
    return Program(script, looks, {**_with_books_once(parts), **words}, live)


def _modes(data: Any) -> Iterator[str]:
    if isinstance(data, list):
        for each in data:
            yield from _modes(each)
    elif isinstance(data, dict):
        yield from [data["mode"]] if "mode" in data else (mode for each in data.values() for mode in _modes(each))


def _with_books_once(parts: Parts) -> Data:
    """The data of a page: panels of the same books have them in common, each names theirs by a number."""
    books: dict[str, int] = {}

    def numbered(data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        return {
            name: books.setdefault(value, len(books)) if name == "books" else numbered(value) for name, value in data.items()
        }

    found = [numbered(part) for part in parts]
    return {"parts": found, "books": [*books]}


Parts = list[Data]
"""What the script of a page has to know of each of its panels, votes, predictions, tables and pictures, in their order."""
QUESTIONS = ("vote", "prediction", "worksheet", "beside")
"""Kinds of parts whose code would give away what they ask, and is folded."""
_PICTURE = re.compile(r'src="data:image/svg\+xml;base64,([A-Za-z0-9+/=]{4000,})"')
"""A picture that is worth being kept apart, and how large it is."""
_SIZE = re.compile(r'<svg(?: (?!width)[\w:]+="[^"]*")*( width="[^"]*" height="[^"]*")')


def cells_html(cells: list[Any], links: Links, parts: Parts) -> str:
    """Cells of a notebook as HTML; what the script of the page has to know is added to `parts`."""
    return "".join(
        _CELLS[cell.cell_type](cell, links, parts) for cell in cells if cell.cell_type in _CELLS and cell.source.strip()
    )


_CELLS: Mapping[str, Callable[[Any, Links, Parts], str]] = {
    "markdown": lambda cell, links, _: markdown_html(cell.source, links),
    "code": lambda cell, _, parts: _code_html(cell, parts),
    "answer": lambda cell, _, parts: _answer_html(cell, parts),
}


def _code_html(cell: Any, parts: Parts) -> str:
    """A code cell: its code, and below it what it shows; where it asks something, its code is folded and comes last."""
    shown = "".join(output_html(output, parts) for output in cell.outputs)
    code = f'<pre class="code"><code>{escaped_lines(cell.source.strip())}</code></pre>\n'
    asks = any(output.get("data", {}).get(PART, {}).get("kind") in QUESTIONS for output in cell.outputs)
    if asks:
        return f'{shown}<details class="folded"><summary>Code of this cell</summary>\n{code}</details>\n'
    return code + shown


def output_html(output: Mapping[str, Any], parts: Parts) -> str:
    """What a cell has put out, as HTML.

    >>> output_html({"output_type": "stream", "text": "a < b\\n"}, [])
    '<div class="output" tabindex="0"><pre>a &lt; b</pre></div>\\n'
    """
    if output["output_type"] == "stream":
        return _block(_lines(output["text"]))
    if output["output_type"] == "error":
        return _block(_lines(f"{output['ename']}: {output['evalue']}"))
    return data_html(output["data"], parts)


def data_html(data: Mapping[str, Any], parts: Parts) -> str:
    """What is shown of an object, by media types, as HTML.

    >>> data_html({"text/latex": "$x$", "text/plain": "x"}, [])
    '<div class="output" tabindex="0"><math display="block"><mrow><mi>x</mi></mrow></math></div>\\n'
    """
    if PART in data:
        return _part_html(data[PART], data["text/plain"], parts)
    if "text/latex" in data and "text/html" not in data:
        return _block(mathml(data["text/latex"], "block"))
    return _block(_PICTURE.sub(lambda found: _kept_picture(found[1], parts), html(data)))


def _kept_picture(packed: str, parts: Parts) -> str:
    """The place of a picture: an empty one of its size, which the script of the page fills before it comes into view."""
    drawing = base64.b64decode(packed).decode()
    size = _SIZE.search(drawing)
    empty = f'<svg xmlns="http://www.w3.org/2000/svg"{size[1] if size else ""}/>'
    number = len(parts)
    parts.append({"kind": "picture", "data": {"drawing": deflated_text(drawing)}})
    return f'data-part="{number}" src="data:image/svg+xml,{quote(empty)}"'


def _part_html(part: Mapping[str, Any], words: str, parts: Parts) -> str:
    kind, number = part["kind"], len(parts)
    parts.append({"kind": kind, "data": part["data"]})
    inside = _prediction_html(part, parts) if kind == "prediction" else _lines(words)
    return f'<div class="part part-{kind}" data-part="{number}">{inside}</div>\n'


def _prediction_html(part: Mapping[str, Any], parts: Parts) -> str:
    answer = data_html(part["answer"], parts)
    question = prose_html(part["data"]["question"])
    return f"<details><summary>{question}</summary>\n<div data-answer>\n{answer}</div>\n</details>"


def _lines(text: str) -> str:
    return f"<pre>{escaped_lines(text.rstrip())}</pre>"


def _block(inside: str) -> str:
    return f'<div class="output" tabindex="0">{inside}</div>\n'


def headings(cells: list[Any]) -> Iterator[str]:
    """The headings of a notebook, from the greatest on, each as it is written."""
    for cell in cells:
        if cell.cell_type == "markdown":
            yield from (line for line in cell.source.splitlines() if line.startswith("#"))


def title_of(cells: list[Any], name: str) -> str:
    """The title of a notebook: its first heading."""
    first = next((line for line in headings(cells) if line.startswith("# ")), f"# {name}")
    return escaped(first[2:].strip()).replace("`", "").replace("*", "")
