"""The first page of the site: each lesson with a picture from it, what it asks, and what one can do after it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath

from lsys_kit.classroom.course import is_lesson
from lsys_kit.classroom.lessons.lesson import TRACKS
from lsys_kit.classroom.lessons.widget import prose_html, prose_text
from lsys_kit.classroom.panel.bundle import style, translated_words
from lsys_kit.classroom.panel.document import Program, document
from lsys_kit.classroom.places import LEAD, TITLE
from lsys_kit.classroom.site.app import HERE, kept_offline
from lsys_kit.classroom.site.pages import Answering, Entry, Parts, kept_picture, opening
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import gettext, language

_NOTE = """<p class="note">These pages need neither Python nor a network. Their panels move, and votes, predictions and
tables are answered on the page. To change rules and code, and to work on the exercises, type <code>{command}</code>: it
opens the course in Jupyter.</p>
"""
_REFERENCES = """<h2 id="reference">{heading}</h2>
<ul>
{rows}</ul>
"""


def index_page(
    entries: Sequence[Entry],
    pictures: Mapping[str, str],
    live: Answering | None = None,
    lead: str = LEAD,
    in_tracks: bool = True,
) -> str:
    """The first page: the lessons, some of them with a picture in SVG, and what belongs to them; and whether it is told which
    ways they belong to, which are those through the kit's own course."""
    parts: Parts = []
    lessons = [each for each in entries if is_lesson(each.name)]
    others = [each for each in entries if each.folder != "exercises" and each not in lessons]
    rows = "".join(_row(each, entries, _picture(pictures.get(each.name), parts), in_tracks) for each in lessons)
    references = "".join(f'<li><a href="{escaped(each.page)}">{escaped(each.title)}</a></li>\n' for each in others)
    tracks = ", ".join(f'<span class="track">{letter}</span> {gettext(text)}' for letter, text in TRACKS.items())
    ways = gettext("Each lesson belongs to a way through the course: {tracks}.", tracks=tracks) if in_tracks else ""
    heading = gettext("To look at, and to look things up")
    title = next((each.course for each in entries), TITLE)
    body = f"""<a class="skip" href="#main">{gettext("Skip to the lessons")}</a>
<main id="main" class="index">
<h1>{escaped(title)}</h1>
{f'<p class="lead">{prose_html(lead)}</p>' if lead else ""}
{"" if live or not entries else gettext(_NOTE, command=escaped(entries[0].command))}
<h2 id="lessons">{gettext("Lessons")}</h2>
{f'<p class="quiet">{ways}</p>' if ways else ""}
<p class="quiet" id="done" role="status" hidden></p>
<ol class="lessons">
{rows}</ol>
{_REFERENCES.format(heading=heading, rows=references) if references else ""}</main>
"""
    name, home = ("kit_contents", HERE) if live and live.holds_kit else ("contents", None)
    described, words = gettext("Lessons on L-systems with panels to move"), translated_words(name)
    known = {"parts": parts, **({"words": words} if words else {}), **(kept_offline(live) if live and home else {})}
    program = Program(opening(name), style("kit_page") if home else "", known, home=home)
    return document(title, body, style("course"), described, program, language())


def _picture(drawing: str | None, parts: Parts) -> str:
    return f'<img alt="" {kept_picture(drawing, parts)}>' if drawing else ""


def _row(entry: Entry, entries: Sequence[Entry], picture: str, in_tracks: bool) -> str:
    """A lesson in the list; its picture leads to it, too, for those who point."""
    exercises = next((each for each in entries if each.name == f"exercises/{PurePosixPath(entry.name).name}"), None)
    told, address = entry.lesson, escaped(entry.page)
    tracks = (
        " ".join(f'<span class="track" title="{gettext(TRACKS[each])}">{each}</span>' for each in told.track)
        if told and in_tracks
        else ""
    )
    facts = [gettext("{number} minutes", number=told.minutes), tracks] if told else []
    also = [f'<a href="{escaped(exercises.page)}">{gettext("exercises")}</a>'] if exercises else []
    asked = f"<p>{prose_html(told.question)}</p>" if told else ""
    number = f"<span>{told.number}</span> " if told and told.number is not None else ""
    able = "".join(f"<li>{prose_html(each)}</li>\n" for each in told.objectives) if told else ""
    objectives = f'<div class="able"><p>{gettext("Afterwards you can")}</p>\n<ul>\n{able}</ul></div>' if able else ""
    name, title = escaped(PurePosixPath(entry.name).stem), escaped(prose_text(entry.title))
    return (
        f'<li data-lesson="{name}" data-title="{title}"><a class="picture" href="{address}" tabindex="-1" aria-hidden="true">'
        f'{picture}</a><div><h3>{number}<a href="{address}">{escaped(entry.title)}</a></h3>{asked}'
        f'<p class="quiet facts">{" · ".join(filter(None, [*facts, *also]))}</p></div>{objectives}</li>\n'
    )
