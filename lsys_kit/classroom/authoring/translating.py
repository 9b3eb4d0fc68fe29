"""Translations of lessons: their texts as a file for translators (PO), and the lesson in another language from that.

`translations/de/ferns.po` in the folder of a lesson is for a translator, who has editors for such files (Poedit, Weblate). When
the lesson has changed, the file is renewed: what stayed is kept, and what changed is marked as fuzzy, with its old text beside
it. The lesson in the other language is a folder of the same form beside the file. A text that is not translated yet, is fuzzy,
or has lost a formula, stands there as it was.
"""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.prose import heading_anchor
from lsys_kit.classroom.authoring.texts import (
    ANSWER,
    EXERCISES,
    HEADING,
    LESSON,
    Turn,
    figures,
    fixed_parts,
    recode,
    redeclared,
    retext,
)
from lsys_kit.classroom.course import put_files
from lsys_kit.classroom.exercises.notebooks import exercise_notebook
from lsys_kit.classroom.exercises.registry import lessons
from lsys_kit.classroom.handed_in import content_of
from lsys_kit.classroom.places import (
    COURSE_FILE,
    LANGUAGE,
    TRANSLATIONS,
    Place,
    course_of,
    declaration,
    key_of,
    text_of,
    translation_place,
)
from lsys_kit.classroom.site.build import MOST_BYTES, read_notebook
from lsys_kit.errors import LSystemError, ModelFileError, ModelNameError, ModelValueError, quotable
from lsys_kit.files import Json, file_errors, replace_file
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.translation import ENGLISH, languages, spoken

if TYPE_CHECKING:
    from babel.messages.catalog import Catalog, Message

_HEAD = "# The texts of a lesson. Code, formulas, addresses and names in braces stay as they are."
WIDTH = 100
"""So long are the lines of a file for translators."""
FEW_WORDS = 3
"""A text of fewer words is translated for each of its kinds, a longer one but once."""
Key = tuple[str, str]
"""A text, and perhaps its kind."""


@dataclass(frozen=True)
class Translated:
    """A file for translators: how many texts it has, how many are translated, and what is wrong with some."""

    path: Path
    texts: int
    done: int
    findings: list[Finding] = field(default_factory=list)


def translate(folder: Path | None, language: str, only: Sequence[str] = ()) -> list[Translated]:
    """Write or renew the files for translators of the lessons in a folder, and the lessons in the other language.

    folder
        The folder of a lesson or of a course, by default the kit's.
    language
        The code of the language, such as "de".
    only
        Lessons by their numbers or names; by default those that have such a file, or else all.

    Raises
    ------
    ModelValueError
        That is no code of a language.
    ModelNameError
        There is no such lesson.
    ModelFileError
        A file cannot be read or written.
    """
    _check_language(language)
    course = course_of(folder, ENGLISH)
    own = [place for place in course.places if place.names() and (course.is_kits or not place.is_kits)]
    known = {key_of(name): (place, name) for place in own for name in place.names()}
    wanted = [each.zfill(2) if each.isdecimal() else key_of(each) for each in only]
    if unknown := next((each for each in wanted if each not in known), None):
        hint = suggestion(unknown[:60], known) or f"Lessons are: {', '.join(known)}."
        raise ModelNameError(f'There is no lesson "{quotable(unknown)}"', hint=hint)
    found = list[Translated]()
    for place in own:
        found += _of_place(place, language, [name for key, (owner, name) in known.items() if owner == place and key in wanted])
    if not course.is_kits and (course.root / COURSE_FILE).is_file():
        found.append(_of_course(course.root, language))
    return found


def _check_language(language: str) -> None:
    _library()
    from babel import Locale, UnknownLocaleError

    try:
        fits = LANGUAGE.fullmatch(language) and language != ENGLISH and Locale.parse(language)
    except (UnknownLocaleError, ValueError):
        fits = None
    if not fits:
        raise ModelValueError(f'"{quotable(language)}" is no code of another language', hint="Such as de for German.")


def _of_place(place: Place, language: str, wanted: list[str]) -> Iterator[Translated]:
    target = translation_place(place, language)
    begun = [name for name in place.names() if (target.root / f"{name}.po").is_file()]
    contents = dict[str, bytes]()
    for name in place.names():
        if name in (wanted or begun or place.names()):
            source = Source(place, name)
            catalogue = renewed(target.root / f"{name}.po", source.messages(), language)
            told = _written(target.root / f"{name}.po", catalogue)
            yield told
            contents |= source.files(translation(catalogue), language, translated=told.done > 0)
        elif name in begun:
            source = Source(place, name)
            known = translation(renewed(target.root / f"{name}.po", source.messages(), language))
            contents |= source.files(known, language, translated=bool(known))
        elif not place.is_kits:
            contents |= Source(place, name).files({}, language, translated=False)
    if not place.is_kits:
        pictures = [path for path in sorted((place.notebooks / "pictures").glob("*")) if path.is_file()]
        contents |= {f"notebooks/pictures/{path.name}": content_of(path, MOST_BYTES) for path in pictures}
    _put(target.root, contents, place.is_kits)


def _put(folder: Path, contents: Mapping[str, bytes], is_kits: bool) -> None:
    """Write files; what somebody has changed in them is kept, but not in the kit, where nobody should."""
    with file_errors(f'The translation cannot be written to "{quotable(str(folder))}"'):
        if not is_kits:
            put_files(folder, contents)
            return
        for name, content in contents.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            replace_file(folder / name, content)


def _of_course(root: Path, language: str) -> Translated:
    """The title of a course, and what is said of it."""
    said = {key: str(value) for key, value in declaration(root / COURSE_FILE).items() if key in ("title", "description")}
    path = root / TRANSLATIONS / language / "course.po"
    catalogue = renewed(path, {(value, ""): [COURSE_FILE] for value in said.values()}, language)
    told, known = _written(path, catalogue), translation(catalogue)
    lines = (f"{key} = {json.dumps(known.get((value, ''), value), ensure_ascii=False)}\n" for key, value in said.items())
    _put(path.parent, {COURSE_FILE: "".join(lines).encode()}, is_kits=False)
    return told


# The texts of a lesson


class Source:
    """A lesson, as it is translated: its notebook, declaration, page for the teacher and exercises; those of the kit's
    exercises are translated with the kit's own texts."""

    def __init__(self, place: Place, name: str) -> None:
        self.place, self.name = place, name
        path = place.notebooks / f"{name}.ipynb"
        self._notebook = read_notebook(path) if path.is_file() else None
        self._declared = self._text(place.declared / f"{name}.toml")
        self._teacher = self._text(place.notebooks / "teacher" / f"{name}.md")
        self._exercises = "" if place.is_kits else self._text(place.questions / f"{name}.toml")

    @staticmethod
    def _text(path: Path) -> str:
        if path.suffix == ".toml" and path.is_file():
            declaration(path)  # which says in words what is no TOML
        return text_of(path) if path.is_file() else ""

    def messages(self) -> dict[Key, list[str]]:
        """Its texts in their order, each with the places in which it stands."""
        found = dict[Key, list[str]]()
        for cell in self._notebook.cells if self._notebook else ():
            turn = _collecting(found, f"notebooks/{self.name}.ipynb, cell {cell.get('id', '')}")
            _turned_cell(cell.cell_type, cell.source, turn)
        retext(self._teacher, _collecting(found, f"notebooks/teacher/{self.name}.md"))
        redeclared(self._declared, LESSON, _collecting(found, f"notebooks/{self.name}.toml"))
        redeclared(self._exercises, EXERCISES, _collecting(found, f"exercises/{self.name}.toml"))
        return found

    def files(self, known: Mapping[Key, str], language: str, translated: bool) -> dict[str, bytes]:
        """Its files in another language."""
        turn, more = _turning(known), {"language": language} if translated else {}
        found = dict[str, str]()
        if self._notebook:
            found[f"notebooks/{self.name}.ipynb"] = self._in(turn, language if translated else "")
        if self._declared:
            found[f"notebooks/{self.name}.toml"] = redeclared(self._declared, LESSON, turn, **more)
        if self._teacher:
            found[f"notebooks/teacher/{self.name}.md"] = retext(self._teacher, turn)
        if self._exercises:
            found[f"exercises/{self.name}.toml"] = redeclared(self._exercises, EXERCISES, turn)
        if self.place.is_kits and language in languages():
            with spoken(language):
                exercises = [each for each in lessons() if each.name == self.name and each.exercises]
                found |= {f"exercises/{self.name}.ipynb": exercise_notebook(each) for each in exercises}
        return {name: text.encode() for name, text in found.items()}

    def _in(self, turn: Turn, language: str) -> str:
        """Its notebook in another language, which its first cell of code chooses; links to headings lead to the new ones."""
        assert self._notebook is not None
        cells, anchors = list[dict[str, Json]](), dict[str, str]()

        def turned(text: str, kind: str) -> str:
            new = turn(text, kind)
            if kind == HEADING:
                anchors[heading_anchor(text)] = heading_anchor(new)
            return new

        for cell in self._notebook.cells:
            if cell.cell_type == "code" and language in languages() and not any(each["id"] == "language" for each in cells):
                cells.append(_code("language", f'from lsys_kit import language\n\nlanguage("{language}");', {}))
            source = _turned_cell(cell.cell_type, cell.source, turned)
            if cell.cell_type == "code":
                cells.append(_code(cell.id, source, cell.metadata))
            else:
                cells.append({"cell_type": cell.cell_type, "id": cell.id, "metadata": cell.metadata, "source": source})
        for cell in cells:
            text = str(cell["source"])
            if cell["cell_type"] == "markdown":
                text = _HERE.sub(lambda found: f"](#{anchors.get(found[1], found[1])})", text)
            cell["source"] = [*text.splitlines(keepends=True)]
        return _json({**self._notebook, "cells": cells})


_HERE = re.compile(r"\]\(#([^()\s]*)\)")


def _code(id: str, source: str, metadata: Json) -> dict[str, Json]:
    return {"cell_type": "code", "id": id, "metadata": metadata, "source": source, "outputs": [], "execution_count": None}


def _json(content: object) -> str:
    return json.dumps(content, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def _turned_cell(kind: str, source: str, turn: Turn) -> str:
    return recode(source, turn) if kind == "code" else retext(source, turn) if kind == "markdown" else source


def _key(text: str, kind: str) -> Key:
    return text, kind if kind == ANSWER or len(text.split()) < FEW_WORDS else ""


def _collecting(found: dict[Key, list[str]], place: str) -> Turn:
    def turn(text: str, kind: str) -> str:
        places = found.setdefault(_key(text, kind), [])
        places += [] if place in places else [place]
        return text

    return turn


def _turning(known: Mapping[Key, str]) -> Turn:
    return lambda text, kind: known.get(_key(text, kind), text)


# The file for translators


def renewed(path: Path, messages: Mapping[Key, list[str]], language: str) -> Catalog:
    """The catalogue of a file with the texts of today: what is translated stays, what changed is fuzzy, what is gone is kept at
    its end."""
    catalog, pofile = _library()
    template: Catalog = catalog.Catalog(locale=language, project="lesson", header_comment=_HEAD, charset="utf-8", fuzzy=False)
    for (text, kind), places in messages.items():
        template.add(text, auto_comments=places, context=kind or None)
    found = template
    if path.is_file():
        with file_errors(f'"{quotable(str(path))}" cannot be read'):
            content = io.BytesIO(content_of(path, MOST_BYTES))
        try:
            found = pofile.read_po(content, locale=language, abort_invalid=True)
        except (pofile.PoFileError, ValueError) as fault:
            raise ModelFileError(f'"{quotable(str(path))}" is no file for translators: {quotable(str(fault))}') from None
        if not len(found) and content.getvalue().strip():
            raise ModelFileError(f'There are no texts for translators in "{quotable(str(path))}"')
        before = {(each.id, each.context): _previous(each, pofile.denormalize) for each in found}
        found.update(template, update_creation_date=False)
        for each in found:
            each.previous_id = each.previous_id or before.get((each.id, each.context), []) if each.fuzzy else []
    for each in found:
        each.flags -= {"python-format", "python-brace-format"}  # which "30 % of" looks like
    return found


def _previous(message: Message, denormalize: Callable[[str], str]) -> list[str]:
    """The text of which something is the translation, if it is fuzzy: Babel reads it as a comment, and it is one no more."""
    said = "\n".join(each.removeprefix("|").strip() for each in message.user_comments if each.startswith("|"))
    message.user_comments = [each for each in message.user_comments if not each.startswith("|")]
    return [denormalize(found)] if (found := said.partition("msgid ")[2]) else []


def translation(catalogue: Catalog) -> dict[Key, str]:
    """What a catalogue has for each text; nothing for those that are not translated, are fuzzy, or have lost a formula."""
    return {
        (str(each.id), each.context or ""): str(each.string).strip()
        for each in catalogue
        if each.id and _is_done(each) and not _lost(each)
    }


def _is_done(message: Message) -> bool:
    return isinstance(message.string, str) and bool(message.string.strip()) and not message.fuzzy


def _lost(message: Message) -> str:
    """What a translation has otherwise than its text and must have as it is: what is missing, or else what was put in."""
    old, new = fixed_parts(str(message.id)), fixed_parts(str(message.string))
    missing, more = [*(old - new)], [*(new - old)]
    if missing:
        return f"{', '.join(missing)} is missing"
    if more:
        return f"{', '.join(more)} is not in the text"
    numbers, others = figures(str(message.id)), figures(str(message.string))  # one may be written as a word
    missing, more = [*(numbers - others)], [*(others - numbers)]
    return f"{', '.join(missing)} has become {', '.join(more)}" if missing and more else ""


def _written(path: Path, catalogue: Catalog) -> Translated:
    """Write a catalogue into its file, and say what is to be done in it."""
    _, pofile = _library()
    file = io.BytesIO()
    pofile.write_po(file, catalogue, width=WIDTH, include_previous=True)
    with file_errors(f'The translation cannot be written to "{quotable(str(path))}"'):
        path.parent.mkdir(parents=True, exist_ok=True)
        replace_file(path, file.getvalue())
    messages = [each for each in catalogue if each.id]
    where = {(each.id, each.context): each.lineno for each in pofile.read_po(io.BytesIO(file.getvalue())) if each.id}
    broken = [
        finding(f"{path.name}, line {where[each.id, each.context]}", "translation", lost=lost[:200], text=str(each.id)[:80])
        for each in messages
        if _is_done(each) and (lost := _lost(each))
    ]
    return Translated(path, len(messages), sum(map(_is_done, messages)) - len(broken), broken)


def _library() -> tuple[ModuleType, ModuleType]:
    try:
        import tomlkit  # noqa: F401
        from babel.messages import catalog, pofile
    except ImportError:
        hint = "Install them with: pip install 'lsys-kit[translate]'"
        raise LSystemError("Babel and TOML Kit are not installed", hint=hint) from None
    return catalog, pofile
