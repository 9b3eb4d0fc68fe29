"""Exercises for a learning platform: a package of SCORM 1.2, a zip file with a page for each lesson and a manifest.

The manifest follows the SCORM Content Aggregation Model 1.2 (ADL 2001, section 2.3); the pages talk to the platform by the API
of the SCORM Run-Time Environment 1.2 (section 3).
"""

from __future__ import annotations

import hashlib
import io
import re
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from xml.etree import ElementTree

from lsys_kit.classroom.exercises.declarations import questions_folder, questions_in
from lsys_kit.classroom.exercises.exercise import Lesson
from lsys_kit.classroom.exercises.registry import all_lessons, exercises, translated_lesson
from lsys_kit.classroom.scorm.page import exercise_page
from lsys_kit.errors import ModelFileError, ModelNameError, ModelValueError, quotable
from lsys_kit.files import KIT_MARK, save_file
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.pictures.style.labels import visible
from lsys_kit.translation import gettext

MANIFEST = "imsmanifest.xml"
CONTENT, ADL = "http://www.imsproject.org/xsd/imscp_rootv1p1p2", "http://www.adlnet.org/xsd/adlcp_rootv1p2"
"""The name spaces of the manifest: IMS Content Packaging 1.1.2, and what ADL adds to it."""
_NO_TIME = (1980, 1, 1, 0, 0, 0)
"""The earliest time of a file in a zip file: the same exercises give the same package, byte for byte."""


def write_package(what: str, path: str | Path) -> tuple[tuple[Lesson, ...], Path]:
    """Write a package of SCORM 1.2: a zip file with the pages of a lesson of the kit, by its number or name, or of a folder of
    files of exercises. The lessons whose pages are in it, and the file, are returned.
    """
    path = Path(path)
    if path.suffix != ".zip":
        raise ModelValueError(f'A package is a .zip file, and "{quotable(path.name)}" is none')
    pages = {lesson: page for lesson in map(translated_lesson, lessons_of(what)) if (page := exercise_page(lesson))}
    if not pages:
        raise ModelFileError(
            "None of these exercises can be checked in a page", hint="Pages check choices, lines, numbers, tables and words."
        )
    save_file(path, package(list(pages), list(pages.values())))
    return tuple(pages), path


def lessons_of(what: str) -> tuple[Lesson, ...]:
    """The lessons in a folder, or a lesson of the kit.

    >>> [lesson.name for lesson in lessons_of("1")]
    ['01_all_at_once']
    """
    if (folder := questions_folder(what)).is_dir():
        exercises(folder)
        return questions_in(folder).lessons
    wanted = what.strip().zfill(2) if what.strip().isdigit() else what.strip()
    found = tuple(lesson for lesson in all_lessons() if wanted in (lesson.name, lesson.name.partition("_")[0]))
    if not found:
        names = [lesson.name for lesson in all_lessons()]
        raise ModelNameError(
            f'"{quotable(what)}" is no folder and no lesson',
            hint=suggestion(what[:100], names) or f"Lessons are: {', '.join(names)}.",
        )
    return found


def package(told: Sequence[Lesson], pages: Sequence[str]) -> bytes:
    """The bytes of a package: the manifest, then the pages."""
    names = page_names(told)
    files = {MANIFEST: manifest(told, names), **dict(zip(names, pages, strict=True))}
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(zipfile.ZipInfo(name, _NO_TIME), text, zipfile.ZIP_DEFLATED)
        archive.comment = KIT_MARK
    return made.getvalue()


def page_names(told: Sequence[Lesson]) -> list[str]:
    """The names of the pages: those of the lessons in plain letters, with numbers before them where two would be alike.

    >>> page_names([Lesson("Bäume/1", "", (), "", "", ())])
    ['B_ume_1.html']
    """
    plain = [re.sub("[^A-Za-z0-9]+", "_", lesson.name)[:60] for lesson in told]
    if len({name.lower() for name in plain}) < len(plain):
        plain = [f"{number}_{name}" for number, name in enumerate(plain, 1)]
    return [f"{name}.html" for name in plain]


def manifest(told: Sequence[Lesson], names: Sequence[str]) -> str:
    """The manifest: an item for each lesson, with its page as the resource that talks to the platform.

    >>> lesson = Lesson("01", "Algae & more", (), "", "", ())
    >>> "<title>Algae &amp; more</title>" in manifest([lesson], ["01.html"])
    True
    """
    ids = " ".join(exercise.id for lesson in told for exercise in lesson.exercises)
    own = hashlib.sha256(f"{ids} {' '.join(lesson.name for lesson in told)}".encode()).hexdigest()[:12]
    root = ElementTree.Element(
        "manifest", {"xmlns": CONTENT, "xmlns:adlcp": ADL, "identifier": f"lsys-kit-exercises-{own}", "version": "1.0"}
    )
    metadata = _added(root, "metadata")
    _added(metadata, "schema", "ADL SCORM")
    _added(metadata, "schemaversion", "1.2")
    organization = _added(_added(root, "organizations", default="lessons"), "organization", identifier="lessons")
    _added(organization, "title", told[0].title if len(told) == 1 else gettext("Exercises on L-systems"))
    resources = _added(root, "resources")
    for number, (lesson, name) in enumerate(zip(told, names, strict=True), 1):
        item = _added(organization, "item", identifier=f"item-{number}", identifierref=f"page-{number}", isvisible="true")
        _added(item, "title", lesson.title)
        resource = _added(
            resources,
            "resource",
            **{"identifier": f"page-{number}", "type": "webcontent", "adlcp:scormtype": "sco", "href": name},
        )
        _added(resource, "file", href=name)
    ElementTree.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ElementTree.tostring(root, "unicode")}\n'


def _added(parent: ElementTree.Element, name: str, text: str = "", **attributes: str) -> ElementTree.Element:
    child = ElementTree.SubElement(parent, name, attributes)
    child.text = visible(text) or None
    return child


def report(told: Sequence[Lesson], path: Path) -> Iterator[str]:
    """What is in a package, in words."""
    yield f"{quotable(str(path))}: {len(told)} page{'s' * (len(told) > 1)}, SCORM 1.2."
    yield "This is practice, not an examination: what is right is in the pages, hidden only lightly."
