"""The catalogues of translated texts, renewed from the texts of the kit.

    python -m tests.messages          # renews lsys_kit/locale/lsys_kit.pot, and each language's .po and .mo
    python -m tests.messages fr       # begins another language, or renews this one alone

A translator fills in the `msgstr` of a .po file, with an editor of one's choice, and runs it again. What is translated: the
constant texts that stand in calls of `gettext` and `ngettext`, and of `worded` in scripts, those of the tables of
misconceptions, kinds of answers and topics, what readers say of mistakes, what errors say where they are raised, and what a
student reads in the files of exercises. A test finds what is missing.
"""

from __future__ import annotations

import ast
import io
import json
import re
import string
import sys
import tomllib
from collections.abc import Iterator
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

from babel.messages.catalog import Catalog, Message
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from lsys_kit.classroom.exercises.declarations import QUESTIONS, questions_in
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.classroom.exercises.practice.drafts import TOPICS
from lsys_kit.classroom.exercises.practice.makers import DIRECTIONS, TYPES
from lsys_kit.classroom.exercises.progress import SIGNS
from lsys_kit.classroom.exercises.registry import texts
from lsys_kit.classroom.exercises.replies import REPLIES
from lsys_kit.classroom.exercises.typed import KINDS_OF_VALUES
from lsys_kit.classroom.exercises.verdict import SIGNS_AND_COLOURS
from lsys_kit.classroom.lessons.lesson import TRACKS
from lsys_kit.classroom.scorm.page import ASKED, DIFFERENT
from lsys_kit.classroom.site.requests import __package__ as site
from lsys_kit.errors import PLACE
from lsys_kit.files import toml_tables
from lsys_kit.notation.syntax.failure import TOKEN_NAMES
from lsys_kit.translation import FORMS, LOCALE, NUMBER
from tests.errors_raised import forms_of_errors

PACKAGE = LOCALE.parent
TEMPLATE = LOCALE / "lsys_kit.pot"
_UNDATED = datetime(2000, 1, 1, tzinfo=UTC)
"""Catalogues have no date, so that they change with their texts alone."""
_CHANGING = re.compile(
    rb'"(Generated-By|(POT-Creation|PO-Revision)-Date|Report-Msgid-Bugs-To|Last-Translator|Language-Team):.*\n'
)
"""Lines of a catalogue's head that say nothing of its texts."""


SCRIPTS = PACKAGE / "classroom" / "panel" / "scripts"
_WORDED = re.compile(r"""\bworded\(\s*(?:"([^"]+)"|'([^']+)')""")
TABLES_OF_SCRIPTS = (
    "vote",
    "prediction",
    "table to fill",
    "Right",
    "Not right",
    "right",
    "not yet",
    "no number",
    "not filled in yet",
    "slow",
    "normal",
    "fast",
    "+, − or, after a click, the wheel zooms; arrows move it, Home puts it back.",
    "Drag or arrow keys turn it. +, − or, after a click, the wheel zooms; Shift and arrows move it, Home puts it back.",
    "Point at a part or click it to trace it; N and P go to the next and previous one.",
    "Point at a wall or click it to trace it; N and P go to the next and previous one.",
    "Point at a cell or click it to trace it; N and P go to the next and previous one.",
    "Two fingers bring it nearer.",
    "A finger turns it.",
    "Tap a part to trace it.",
    "Tap a wall to trace it.",
    "Tap a cell to trace it.",
    "Correct",
    "Almost",
    "Not yet",
    "Not readable yet",
    "Not answered yet",
    "The learning platform knows: score {score} of 100, completed.",
    "The learning platform knows: score {score} of 100, incomplete.",
    "The learning platform did not take the score.",
    "The learning platform cannot be read, so that nothing is written there.",
    "No learning platform is there: nobody is told.",
    'The question has no symbol "{symbol}". The symbols are: {symbols}.',
)
"""What scripts show in the language that is chosen, and have in tables."""


def in_scripts() -> list[str]:
    """What else they show so: the texts in calls of `worded`."""
    scripts = (path.read_text(encoding="utf-8") for path in sorted(SCRIPTS.rglob("*.js")))
    return [*dict.fromkeys(one or other for script in scripts for one, other in _WORDED.findall(script))]


def messages() -> Iterator[tuple[str | tuple[str, str], str]]:
    """Each text that is translated, or the two forms of one with a number, and where it stands."""
    for path in sorted(PACKAGE.rglob("*.py")):
        for message in _in_calls(ast.parse(path.read_text(encoding="utf-8"))):
            yield message, path.relative_to(PACKAGE.parent).as_posix()
    for name, text in _in_tables():
        yield text, f"{name} (table)"
    for form, path in said_by_errors():
        yield form, path.relative_to(PACKAGE.parent).as_posix()
    for lesson in questions_in(QUESTIONS).lessons:
        for text in texts(lesson):
            if text:
                yield text, f"lsys_kit/classroom/exercises/questions/{lesson.name}.toml"


def _in_calls(module: ast.Module) -> Iterator[str | tuple[str, str]]:
    constants = {
        target.id: node.value
        for node in module.body
        if isinstance(node, ast.Assign)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    for node in ast.walk(module):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("gettext", "ngettext"):
            count = 1 if node.func.id == "gettext" else 2
            given = [constants.get(each.id, each) if isinstance(each, ast.Name) else each for each in node.args[:count]]
            found = [each.value for each in given if isinstance(each, ast.Constant)]
            if len(found) == count:
                yield found[0] if count == 1 else (found[0], found[1])


def _in_tables() -> Iterator[tuple[str, str | tuple[str, str]]]:
    yield from (("verdict", word) for word in SIGNS_AND_COLOURS)
    yield from (("misconceptions", text) for each in MISCONCEPTIONS.values() for text in (each.do, each.but) if text)
    yield from (("scripts", text) for text in (*TABLES_OF_SCRIPTS, *in_scripts()))
    yield from (("pages of learning platforms", text) for text in (*ASKED.values(), DIFFERENT))
    yield from (("progress", state) for state in SIGNS)
    yield from (("readers", text) for text in (*TOKEN_NAMES.values(), *map(str, KINDS_OF_VALUES.values()), *_of_readers()))
    yield from (
        ("site", text) for text in (*TRACKS.values(), *(each["says"] for each in toml_tables(site, "requests.toml").values()))
    )
    yield from (("numbers and places", text) for text in (NUMBER, PLACE))
    yield from (("practice", text) for text in (*TYPES, *DIRECTIONS.values(), *_texts_in(TOPICS)))
    yield from (("replies", _one_text(text)) for place in REPLIES.values() for text in place.values())


def _one_text(text: str | list[str]) -> str | tuple[str, str]:
    return text if isinstance(text, str) else (text[0], text[1])


def _of_readers() -> Iterator[str]:
    """What readers say of mistakes, and the words of which that is made."""
    for path in sorted((PACKAGE / "notation").rglob("mistakes.toml")):
        tables = tomllib.loads(path.read_text("utf-8"))
        yield from _said_in({name: tables.get(name, {}) for name in ("problems", "mistakes")})
        yield from tables.get("words", {}).values()


def _said_in(rows: object) -> Iterator[str]:
    if isinstance(rows, list):
        yield from (text for each in rows for text in _said_in(each))
    elif isinstance(rows, dict):
        for key, value in rows.items():
            if key in ("says", "hint") and isinstance(value, str):
                yield from [value] if value else []
            else:
                yield from _said_in(value)


def _texts_in(said: object) -> Iterator[str]:
    """The texts for people in what the exercises of all topics say."""
    if isinstance(said, str):
        yield said
    elif isinstance(said, list):
        yield from (text for each in said for text in _texts_in(each))
    elif isinstance(said, dict):
        for key, value in said.items():
            yield from () if key in ("kind", "asks", "expects", "unlikely") else _texts_in(value)


@cache
def said_by_errors() -> tuple[tuple[str, Path], ...]:
    """The forms of all that the kit's errors say, and their files."""
    return tuple(forms_of_errors(PACKAGE))


def forms_text() -> str:
    """The forms of what errors say, as their file has them."""
    return json.dumps(sorted({form for form, _ in said_by_errors()}), ensure_ascii=False, indent=0) + "\n"


@cache
def template() -> Catalog:
    """All texts, each once, with the files that it stands in."""
    catalogue = Catalog(
        project="lsys_kit",
        header_comment="# The texts of lsys_kit. Made by: python -m tests.messages",
        creation_date=_UNDATED,
        revision_date=_UNDATED,
        charset="utf-8",
    )
    for message, place in messages():
        catalogue.add(message, auto_comments=[place])
    return catalogue


def renewed(code: str) -> Catalog:
    """The catalogue of a language with the texts of today; what is translated stays, what is gone goes."""
    path = po_file(code)
    found = Catalog(locale=code)
    if path.exists():
        with path.open("rb") as file:
            found = read_po(file, locale=code)
    catalogue = Catalog(
        locale=code,
        project="lsys_kit",
        header_comment="# The texts of lsys_kit, translated.",
        creation_date=_UNDATED,
        revision_date=_UNDATED,
        charset="utf-8",
        fuzzy=False,
    )
    for message in template():
        if message.id:
            known = found.get(message.id if isinstance(message.id, str) else message.id[0])
            catalogue.add(message.id, known.string if known else None, auto_comments=message.auto_comments)
    return catalogue


def po_file(code: str) -> Path:
    """The catalogue that a translator edits."""
    return LOCALE / code / "LC_MESSAGES" / "lsys_kit.po"


def po_text(catalogue: Catalog) -> bytes:
    """A catalogue as its file has it."""
    file = io.BytesIO()
    write_po(file, catalogue, width=120)
    return _CHANGING.sub(b"", file.getvalue())


def mo_bytes(catalogue: Catalog) -> bytes:
    """A catalogue compiled."""
    file = io.BytesIO()
    write_mo(file, catalogue)
    return file.getvalue()


def is_translated(message: Message) -> bool:
    """Whether a text has its translation, in all of its forms."""
    return bool(message.string) and all((message.string,) if isinstance(message.string, str) else message.string)


def placeholders(text: str) -> list[str]:
    """The names in braces in a text, in alphabetical order.

    >>> placeholders("{number} of {most}")
    ['most', 'number']
    """
    return sorted(name for _, name, _, _ in string.Formatter().parse(text) if name is not None)


def codes() -> list[str]:
    """The languages there are."""
    return sorted(path.name for path in LOCALE.iterdir() if path.is_dir())


def _write(path: Path, content: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


if __name__ == "__main__":
    FORMS.write_text(forms_text(), encoding="utf-8")
    _write(TEMPLATE, po_text(template()))
    for code in sys.argv[1:] or codes():
        catalogue = renewed(code)
        _write(po_file(code), po_text(catalogue))
        _write(po_file(code).with_suffix(".mo"), mo_bytes(catalogue))
        missing = sum(not is_translated(each) for each in catalogue if each.id)
        print(f"{code}: {len(catalogue)} texts, {missing} not translated")
