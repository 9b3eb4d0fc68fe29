"""Where the parts of a course lie: the kit's own, that of a teacher, that in which a notebook stands.

A course is a folder. What a notebook asks lies beside it under the same name: `notebooks/ferns.toml` beside
`notebooks/ferns.ipynb`, `exercises/ferns.toml` beside `exercises/ferns.ipynb`; the teacher's page is in `notebooks/teacher`. A
folder may have one lesson or many. With a file `course.toml` it is a list of lessons in an order: of its own, of folders in it,
and of the kit, by their numbers. The kit's own course is a place like others; only its declarations and translations lie in the
package.

A translation of its lessons is a folder of the same form within it, `translations/de`; `lsys-kit lesson translate` writes it.

Nothing outside the folder is read, links are not followed, and nothing that is read here is run.
"""

from __future__ import annotations

import errno
import os
import re
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice
from pathlib import Path

from lsys_kit.classroom.handed_in import content_of
from lsys_kit.errors import LSystemError, ModelFileError, quotable, shown
from lsys_kit.files import Entries, decoded, file_errors
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.translation import ENGLISH, LOCALE, gettext

COURSE_FILE = "course.toml"
"""The list of a course, in its folder."""
NAME = re.compile(r"(?:\d\d_)?[a-z][a-z0-9_]{0,59}")
"""What a lesson may be called."""
NO_LESSONS = frozenset({"gallery"})
"""Notebooks beside the lessons that are none."""
VARIABLE = "LSYS_KIT_COURSE"
"""The environment variable that names the chosen course, so that processes that are started here know it, too."""
IN_LANGUAGE = "LSYS_KIT_COURSE_LANGUAGE"
"""That which names the language in which it is opened."""
TRANSLATIONS = "translations"
"""The folder in a course that has one for each language into which lessons are translated."""
LANGUAGE = re.compile(r"[a-z]{2,3}")
"""The code of a language."""
MOST_BYTES, MOST_LESSONS, MOST_ENTRIES = 1_000_000, 200, 10_000
"""The greatest size of a declaration, the most lessons of a course, and so many entries of a folder are looked at."""


@dataclass(frozen=True)
class Place:
    """A folder with lessons, and where in it their parts lie."""

    root: Path
    declared: Path
    questions: Path

    @property
    def notebooks(self) -> Path:
        """The folder of its notebooks."""
        return self.root / "notebooks"

    @property
    def is_kits(self) -> bool:
        """Whether it is that of the kit."""
        return self == kit_place()

    def names(self) -> tuple[str, ...]:
        """The names of its lessons, in the order of the alphabet: those of its notebooks, and of what is declared."""
        found = {*_stems(self.notebooks, ".ipynb"), *_stems(self.declared, ".toml")}
        return tuple(sorted(found - NO_LESSONS))


def kit_place() -> Place:
    """The place of the kit's own course."""
    return _kit_place()


@lru_cache(maxsize=1)
def _kit_place() -> Place:
    package = Path(__file__).resolve().parent.parent
    root = package / "course" if (package / "course").is_dir() else package.parent
    return Place(root, package / "classroom" / "lessons" / "data", package / "classroom" / "exercises" / "questions")


def own_place(root: Path) -> Place:
    """The place of a folder that somebody has written."""
    return Place(root, root / "notebooks", root / "exercises")


def _stems(folder: Path, ending: str) -> list[str]:
    """The names of lessons among the plain files of a folder; none where it cannot be read."""
    with suppress(OSError):
        with os.scandir(folder) as entries:
            found = [each.name for each in islice(entries, MOST_ENTRIES) if each.is_file(follow_symlinks=False)]
        stems = [name.removesuffix(ending) for name in found if name.endswith(ending)]
        return [stem for stem in stems if NAME.fullmatch(stem)]
    return []


def key_of(name: str) -> str:
    """By what a lesson is asked for: its number, if its name begins with one, else its name.

    >>> key_of("01_all_at_once"), key_of("ferns")
    ('01', 'ferns')
    """
    return name[:2] if re.match(r"\d\d_", name) else name


@dataclass(frozen=True)
class Course:
    """A course: its title, a sentence about it, its lessons in their order, each with the place in which it lies, and the
    language in which it is opened."""

    root: Path
    title: str
    lead: str
    lessons: tuple[tuple[Place, str], ...]
    language: str = ENGLISH

    @property
    def places(self) -> tuple[Place, ...]:
        """The places of its lessons, its own first and the kit's last."""
        own = kit_place() if self.is_kits else _translated(own_place(self.root), self.language)
        return tuple(sorted(dict.fromkeys([own, *(place for place, _ in self.lessons)]), key=lambda each: each.is_kits))

    @property
    def is_kits(self) -> bool:
        """Whether it is the kit's own."""
        return self.root == kit_place().root


TITLE = "L-systems: a course"
LEAD = (
    "Short rules can grow a plant. These lessons show how, from a row of cells to a hedge in the light: "
    "predict, look, move a slider, change a rule."
)


def course_of(folder: Path | None = None, language: str | None = None) -> Course:
    """The course in a folder, by default the kit's, in a language, by default that which was chosen with the course: lessons
    that are translated into it, and the others as they are.

    Raises
    ------
    ModelFileError
        There is no such folder, there is no lesson in it, or its list has a mistake.
    """
    language = language or os.environ.get(IN_LANGUAGE) or ENGLISH
    course = _course_of(folder)
    if language == ENGLISH:
        return course
    lessons = tuple((_translated(place, language, name), name) for place, name in course.lessons)
    title, lead = gettext(TITLE), gettext(LEAD)
    if not course.is_kits:
        title, lead = _told(folder or course.root, lessons, language)
    return replace(course, title=title, lead=lead, lessons=lessons, language=language)


def translation_place(place: Place, language: str) -> Place:
    """Where the lessons of a place are in another language."""
    return own_place((LOCALE if place.is_kits else place.root / TRANSLATIONS) / language)


def _translated(place: Place, language: str, name: str = "") -> Place:
    """The place of the translation of a place, if there is one; of the kit's, if it has this lesson."""
    found = translation_place(place, language)
    names = found.names() if language != ENGLISH and LANGUAGE.fullmatch(language) else ()
    if name and names and name not in names and not place.is_kits:
        raise ModelFileError(
            f'The lesson {name} is not among the translations in "{quotable(str(found.root))}"',
            hint=f"lsys-kit lesson translate {quotable(str(place.root))} --language {language} puts it there.",
        )
    return found if names and (not name or name in names) else place


def _course_of(folder: Path | None) -> Course:
    named = quotable(str(folder))
    with file_errors(f'"{named}" cannot be read'):
        if folder is None or resolved(folder) == kit_place().root:
            return Course(kit_place().root, TITLE, LEAD, tuple((kit_place(), name) for name in kit_place().names()))
        if folder.suffix == ".zip":
            raise ModelFileError(f'"{named}" is an archive', hint=f"Unpack it first: lsys-kit lesson unpack {folder.name}")
        next(folder.iterdir(), None)
    declared = _listed(folder)
    lessons = tuple(_lessons(folder, declared))
    if not lessons and not any(_stems(folder / "exercises", ending) for ending in (".toml", ".ipynb")):
        raise ModelFileError(
            f'There are no lessons in "{named}"',
            hint="A lesson is notebooks/NAME.ipynb in it: lsys-kit lesson new NAME writes one.",
        )
    if len({name for _, name in lessons}) < len(lessons):
        raise ModelFileError(f'Two lessons of "{named}" have the same name')
    return Course(folder, *_told(folder, lessons), lessons)


def _told(folder: Path, lessons: tuple[tuple[Place, str], ...], language: str = "") -> tuple[str, str]:
    """The title of a course, and what is said of it: as its list has them, perhaps in a language; else the title of its only
    lesson, or the name of the folder."""
    listed = dict(_listed(folder))
    if LANGUAGE.fullmatch(language):
        listed |= _listed(folder / TRANSLATIONS / language)
    if "title" not in listed and len(lessons) == 1:
        place, name = lessons[0]
        with suppress(LSystemError):
            listed["title"] = declaration(place.declared / f"{name}.toml").get("title")
    title = listed.get("title") or folder.resolve().name.replace("_", " ")
    return " ".join(str(title).split()), " ".join(str(listed.get("description", "")).split())


def resolved(folder: Path) -> Path:
    """The place of a folder behind all links; an `OSError` where these lead in a circle."""
    try:
        return folder.resolve()
    except RuntimeError as loop:  # of links, in Python before 3.13
        raise OSError(errno.ELOOP, str(loop)) from None


def _listed(folder: Path) -> Entries:
    """What the list of a course says; nothing where there is none."""
    path = folder / COURSE_FILE
    if not os.path.lexists(path):
        return {}
    declared = declaration(path)
    for key, value in declared.items():
        if key not in ("title", "description", "lessons"):
            hint = suggestion(key, ("title", "description", "lessons")) or "Entries are: title, description, lessons."
            raise ModelFileError(f'{COURSE_FILE} has an unknown entry "{quotable(key)}"', hint=hint)
        if not isinstance(value, list if key == "lessons" else str):
            raise ModelFileError(
                f'{COURSE_FILE}: "{key}" must be a {"list" if key == "lessons" else "text"}, not {shown(value)}'
            )
    return declared


def _lessons(folder: Path, declared: Entries) -> Iterator[tuple[Place, str]]:
    own = own_place(folder)
    beside = {each: own_place(folder / each) for each in _folders(folder) if each not in ("notebooks", "exercises")}
    for part in (part for place in (own, *beside.values()) for part in (place.notebooks, place.questions)):
        with file_errors(f'"{quotable(str(part))}" cannot be read'):
            if os.path.isdir(part):
                os.scandir(part).close()
    inside = {each: (place, each) for each, place in beside.items() if each in place.names()}
    known = {**inside, **{name: (own, name) for name in own.names()}}
    if "lessons" not in declared:
        yield from (known[name] for name in sorted(known))
        return
    kits = {int(name[:2]): name for name in kit_place().names()}
    for each in declared["lessons"][: MOST_LESSONS + 1]:
        if type(each) is int and each in kits:
            yield kit_place(), kits[each]
        elif isinstance(each, str) and each in known:
            yield known[each]
        elif isinstance(each, str) and each in kits.values():
            yield kit_place(), each
        else:
            hint = (
                suggestion(str(each)[:60], known)
                or f"Lessons here are: {', '.join(known) or 'none'}; those of the kit have numbers."
            )
            raise ModelFileError(f"{COURSE_FILE}: there is no lesson {shown(each)}", hint=hint)


def _folders(folder: Path) -> list[str]:
    with suppress(OSError), os.scandir(folder) as entries:
        found = (each.name for each in islice(entries, MOST_ENTRIES) if each.is_dir(follow_symlinks=False))
        return sorted(name for name in found if NAME.fullmatch(name))
    return []


def declaration(path: Path) -> Entries:
    """What a file of declarations says.

    Raises
    ------
    ModelFileError
        It cannot be read, or is no TOML.
    """
    try:
        return tomllib.loads(text := text_of(path))
    except tomllib.TOMLDecodeError as fault:
        raise ModelFileError(f"{quotable(path.name)}: {quotable(str(fault))}", hint=toml_hint(text, fault)) from None
    except RecursionError:
        raise ModelFileError(f"{quotable(path.name)} is nested too deeply") from None


def toml_hint(text: str, fault: tomllib.TOMLDecodeError) -> str:
    """What to try where a text is no TOML.

    >>> try:
    ...     tomllib.loads("right = True")
    ... except tomllib.TOMLDecodeError as fault:
    ...     toml_hint("right = True", fault)
    'Write true and false in small letters.'
    """
    line = text.split("\n")[line_of(fault) - 1]
    if re.search(r"= {0,9}(?:True|False)\b", line):
        return "Write true and false in small letters."
    if set(line) & set("„“”‚‘’«»"):
        return 'Quotation marks are straight here, as in "Ferns".'
    return "Is a quotation mark or a bracket missing?"


def line_of(fault: tomllib.TOMLDecodeError) -> int:
    """The line in which a text is no TOML; the first one where it is not told, as at the end of a text."""
    found = re.search(r"line (\d+)", str(fault))
    return int(found[1]) if found else 1


def text_of(path: Path) -> str:
    """The text of a file that somebody else may have written."""
    try:
        content = content_of(path, MOST_BYTES)
    except ModelFileError as fault:
        raise ModelFileError(f'"{quotable(path.name)}": {fault.message}') from None
    return decoded(content, f'"{quotable(path.name)}"', MOST_BYTES + 1)


def choose_course(folder: Path | None, language: str = ENGLISH) -> Course:
    """Make a course that of this process, and of those that it starts, in a language: its lessons and exercises are known by
    their names."""
    found = course_of(folder, language)
    os.environ.pop(IN_LANGUAGE, None)
    if language != ENGLISH:
        os.environ[IN_LANGUAGE] = language
    if folder is None:
        os.environ.pop(VARIABLE, None)
    else:
        os.environ[VARIABLE] = str(folder.resolve())
    return found


def course_at_hand() -> Course:
    """The chosen course, or that of the kit."""
    chosen = os.environ.get(VARIABLE)
    return course_of(Path(chosen) if chosen else None)


def places() -> tuple[Place, ...]:
    """Where lessons and exercises are looked for: in the chosen course, around the notebook that runs, at last in the kit."""
    found = list[Place]()
    with suppress(LSystemError, OSError):
        if os.environ.get(VARIABLE) or os.environ.get(IN_LANGUAGE):
            found += course_at_hand().places
    with suppress(OSError):
        here = Path.cwd()
        for root in (here, *here.parents[:2]):
            if _has_lessons(root):
                with suppress(LSystemError):
                    chosen = Path(os.environ.get(VARIABLE, ".")).resolve() == root
                    found += [] if found and chosen else [own_place(root), *course_of(root, ENGLISH).places]
                break
    return tuple(dict.fromkeys([*(each for each in found if not each.is_kits), kit_place()]))


def _has_lessons(root: Path) -> bool:
    return (root / COURSE_FILE).is_file() or any(_stems(root / part, ".toml") for part in ("notebooks", "exercises"))
