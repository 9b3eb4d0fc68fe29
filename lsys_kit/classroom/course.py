"""A course: lessons, exercises, a gallery and references, copied into a folder that belongs to the user.

What a student has written is never overwritten. A manifest in the folder holds the SHA-256 of each file that was copied: a
file that still matches is untouched, and a newer version of the kit may update it. Any other file is the student's own; a newer
version is put beside it.

Nothing outside the folder is written: names come from the kit alone, and links in the folder are not followed.

The lessons that come with the kit keep what they show, for people who read them without running them. In a student's copy
nothing that a lesson will show is there yet, and it says how a cell is run.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import count
from pathlib import Path, PurePosixPath

from lsys_kit.classroom.places import NAME, NO_LESSONS, Course, course_of, kit_place
from lsys_kit.errors import ModelFileError
from lsys_kit.files import file_errors, replace_file
from lsys_kit.translation import ENGLISH, gettext

COURSE_PARTS = ("notebooks", "exercises", "notebooks/reference")
"""The folders of the course: lessons with the gallery, exercises, and the live references of notations and turtle commands. The
teacher's pages, in `notebooks/teacher`, are not for students and never copied."""
FOLDER = "lsys_kit_course"
MANIFEST = ".lsys_kit_course.json"
MOST_MANIFEST = 1_000_000
"""The greatest size of a manifest that is read; those written here are far smaller."""
_LESSON = re.compile(r"notebooks/((?:\d\d_)?[A-Za-z][A-Za-z0-9_-]*)\.ipynb")
_FILE_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,80}\.(ipynb|md)")
_PICTURE = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,80}\.(png|jpg|jpeg|gif|svg)")


@dataclass(frozen=True)
class Copied:
    """What became of one file of the course.

    name
        The file, relative to the folder of the course.
    what
        "new" (it was not there), "renewed" (an untouched older version was there), "same" (this version was there), "kept" (the
        user's own, and nothing new in the kit) or "beside" (the user's own; the kit's new version is the file `beside`).
    """

    name: str
    what: str
    beside: str = ""


def course_files(source: Path | None = None) -> dict[str, Path]:
    """The files of a course, by default of that which came with the kit, by their names in the course.

    >>> {name.rpartition("/")[0] for name in course_files()} == set(COURSE_PARTS)
    True
    """
    source = source or kit_place().root
    every, course = _all_files(source), course_of(source) if source != kit_place().root else course_of()
    if not course.is_kits:
        beside = {name: path for name, path in every.items() if name.startswith("notebooks/") and not is_lesson(name)}
        every = dict(_own_files(course)) | beside
    elif course.language != ENGLISH:
        every |= dict(_own_files(course))
    if not every:
        raise ModelFileError(
            f"The course is missing from the installation of the kit, {source}", hint="Install lsys-kit again."
        )
    return every


def is_lesson(name: str) -> bool:
    """Whether a file of the course is a lesson.

    >>> is_lesson("notebooks/01_all_at_once.ipynb"), is_lesson("notebooks/gallery.ipynb")
    (True, False)
    """
    found = _LESSON.fullmatch(name)
    return found is not None and found[1] not in NO_LESSONS


def _all_files(source: Path) -> dict[str, Path]:
    """All notebooks and texts of a course."""
    return {
        f"{part}/{path.name}": path
        for part in COURSE_PARTS
        for path in sorted((source / part).glob("*"))
        if _FILE_NAME.fullmatch(path.name) and _is_plain(path)
    }


def _own_files(course: Course) -> Iterator[tuple[str, Path]]:
    """The files of the lessons of a course in their order; what does not come with the kit has its declarations with it."""
    for place, name in course.lessons:
        beside = [(place.notebooks / f"{name}.ipynb", "notebooks")]
        beside += [] if place.is_kits else [(place.declared / f"{name}.toml", "notebooks")]
        yield from ((f"{part}/{path.name}", path) for path, part in beside if _is_plain(path))
    for place in course.places:
        own = place == course.places[0] and not place.is_kits
        wanted = None if own else {name for owner, name in course.lessons if owner == place}
        for path in sorted((place.root / "exercises").glob("*")):
            fits = path.suffix == ".ipynb" or (path.suffix == ".toml" and not place.is_kits)
            if fits and NAME.fullmatch(path.stem) and _is_plain(path) and (wanted is None or path.stem in wanted):
                yield f"exercises/{path.name}", path
        for path in () if place.is_kits else sorted((place.notebooks / "pictures").glob("*")):
            if _PICTURE.fullmatch(path.name) and _is_plain(path):
                yield f"notebooks/pictures/{path.name}", path


def _is_plain(path: Path) -> bool:
    return path.is_file() and not path.is_symlink()


def copy_course(folder: str | Path = FOLDER, source: Path | None = None) -> tuple[Copied, ...]:
    """Copy the course into a folder.

    folder
        The user's folder; it is made if necessary.
    source
        Where the course comes from; by default what came with the kit.
    """
    contents = ((name, _content(name, path)) for name, path in course_files(source).items())
    with file_errors(f"The course cannot be copied to {folder}", hint="Choose another folder: lsys-kit lab FOLDER."):
        return put_files(Path(folder), dict(contents))


def put_files(folder: Path, contents: Mapping[str, bytes]) -> tuple[Copied, ...]:
    """Put files into a folder that belongs to the user, where what was changed since an earlier time is kept.

    Raises
    ------
    OSError
        The folder or a file cannot be written.
    """
    for part in dict.fromkeys(str(parent) for name in contents for parent in reversed(PurePosixPath(name).parents)):
        _made_folder(folder / part)
    manifest = _manifest(folder)
    copied = tuple(_copied(folder, name, content, manifest) for name, content in contents.items())
    replace_file(folder / MANIFEST, json.dumps({"files": manifest}, indent=1, sort_keys=True).encode())
    return copied


def copy_report(what: str, folder: str | Path, copied: tuple[Copied, ...]) -> str:
    """What became of some files, in words.

    >>> print(copy_report("Lessons are", "course", (Copied("notebooks/01.ipynb", "new"), Copied("notebooks/02.ipynb", "kept"))))
    Lessons are in course: 1 file new, 1 file kept as you changed it.
    """
    words = {"new": "new", "renewed": "updated", "same": "unchanged", "kept": "kept as you changed it"}
    numbers = {word: sum(file.what == what for file in copied) for what, word in words.items()}
    parts = [f"{number} file{'s' * (number > 1)} {word}" for word, number in numbers.items() if number]
    news = [f"You have changed {file.name}; its new version is {file.beside}." for file in copied if file.beside]
    return "\n".join([f"{what} in {folder}{': ' * bool(parts)}{', '.join(parts)}.", *news])


def _content(name: str, path: Path) -> bytes:
    """What is copied of a file: a lesson without what it shows, anything else as it is."""
    content = path.read_bytes()
    return students_copy(content) if is_lesson(name) else content


def _made_folder(path: Path) -> None:
    path.mkdir(parents=True, exist_ok=True)
    if path.is_symlink():
        raise ModelFileError(f"{path} is a link, and links are not followed", hint="Rename it, or choose another folder.")


def _manifest(folder: Path) -> dict[str, str]:
    """The hash of each file as it was copied; none where there is no manifest that can be read.

    Without a manifest every file that differs counts as the user's own, to be on the safe side.
    """
    path = folder / MANIFEST
    if path.is_symlink() or not path.is_file() or path.stat().st_size > MOST_MANIFEST:
        return {}
    try:
        files = json.loads(path.read_text("utf-8")).get("files", {})
    except (ValueError, AttributeError, RecursionError):
        return {}
    return {k: v for k, v in files.items() if isinstance(v, str)} if isinstance(files, dict) else {}


def _copied(folder: Path, name: str, content: bytes, manifest: dict[str, str]) -> Copied:
    """Bring one file up to date, and record the version that the user now has."""
    path, version, seen = folder / name, _hash(content), manifest.get(name)
    manifest[name] = version
    if not os.path.lexists(path):
        replace_file(path, content)
        return Copied(name, "new")
    if _has_content(path, version):
        return Copied(name, "same")
    if seen and _has_content(path, seen):
        replace_file(path, content)
        return Copied(name, "renewed")
    if seen == version:
        return Copied(name, "kept")
    beside = _put_beside(folder, name, content, manifest)
    return Copied(name, "beside", beside)


def _put_beside(folder: Path, name: str, content: bytes, manifest: dict[str, str]) -> str:
    """Write the new version under the first name beside the user's file that is free, or whose file the user never changed."""
    for beside in _names_beside(name):
        path = folder / beside
        unchanged = (known for known in (_hash(content), manifest.get(beside)) if known)
        if os.path.lexists(path) and not any(_has_content(path, known) for known in unchanged):
            continue
        manifest[beside] = _hash(content)
        replace_file(path, content)
        return beside
    raise AssertionError("there are infinitely many names")


def _names_beside(name: str) -> Iterator[str]:
    """`01.new.ipynb`, `01.new2.ipynb`, ... for `01.ipynb`."""
    stem, ending = name.rsplit(".", 1)
    yield f"{stem}.new.{ending}"
    yield from (f"{stem}.new{number}.{ending}" for number in count(2))


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _has_content(path: Path, version: str) -> bool:
    """Whether a file, not a link, has exactly that content."""
    return path.is_file() and not path.is_symlink() and _hash(path.read_bytes()) == version


HOW_TO_RUN = """\
**How to work with this page.** Click into a grey box, a *cell*, and press **Shift + Enter**: the cell is run, and what it shows
appears below it. Run the cells one after another, from the top. To change something, type in the cell and run it again. A cell
of which one pale line is seen is folded, as its code would give an answer away: it is run in the same way. If nothing helps,
choose *Kernel* and then *Restart Kernel* in the menu, and begin at the top."""
"""The text that a student's copy has after its title."""
HOW_TO_RUN_ID = "how-to-run-a-cell"


def students_copy(content: bytes) -> bytes:
    """A notebook without what its cells show, and with a text on how they are run; anything else as it is.

    >>> cells = [{"cell_type": "markdown", "source": ["# Title"]},
    ...          {"cell_type": "code", "source": ["1 + 1"], "outputs": [{}], "execution_count": 1}]
    >>> copy = json.loads(students_copy(json.dumps({"cells": cells}).encode()))
    >>> [cell.get("outputs") for cell in copy["cells"]], copy["cells"][1]["id"]
    ([None, None, []], 'how-to-run-a-cell')
    """
    try:
        notebook = json.loads(content)
        notebook["cells"] = [_unrun(cell) for cell in notebook["cells"]]
        notebook["cells"].insert(1, _text_cell())
    except (ValueError, TypeError, KeyError, AttributeError):
        return content
    return (json.dumps(notebook, indent=1, ensure_ascii=False, sort_keys=True) + "\n").encode()


def _unrun(cell: dict[str, object]) -> dict[str, object]:
    return {**cell, "outputs": [], "execution_count": None} if cell["cell_type"] == "code" else cell


def _text_cell() -> dict[str, object]:
    text = gettext(HOW_TO_RUN).splitlines(keepends=True)
    return {"cell_type": "markdown", "id": HOW_TO_RUN_ID, "metadata": {}, "source": text}
