"""What a class has handed in: the files in a folder, found and read without following links or opening pipes and devices."""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import file_errors

DEPTH, MOST_FILES = 8, 10_000
"""So deep folders are looked into, and so many files are taken at most."""
_OTHER = "It was not read:"
"""So begins the problem of a file whose name has another ending."""
_PASSED_OVER = ("__MACOSX",)
"""Folders that systems put into archives, beside those whose names begin with a dot."""


@dataclass(frozen=True)
class HandedIn:
    """A file that somebody has handed in.

    student
        The name of the folder in which it stands, or its own name without its ending.
    name
        Its path in the folder of the class.
    path
        Where it is.
    problem
        Why it cannot be read, a sentence without its full stop; empty if it may be.
    """

    student: str
    name: str
    path: Path
    problem: str = ""


def handed_in(folder: str | Path, ending: str = "") -> list[HandedIn]:
    """The files in a folder, in the order of their names; those with another ending are listed with that as their problem.

    A folder in it belongs to one student, with all that is in it; one without files of this ending is listed with that as its
    problem, as are links, which are never followed. Names that begin with a dot are passed over.
    """
    folder = Path(folder)
    with file_errors(f'"{quotable(str(folder))}" cannot be read'):
        found = list(islice((each for entry in _entries(folder) for each in _of_student(entry, ending)), MOST_FILES + 1))
    if all(each.problem.startswith(_OTHER) for each in found):
        kind = f"whose names end in {ending} " if ending else ""
        raise ModelFileError(f'There are no files {kind}in "{quotable(str(folder))}"')
    if len(found) > MOST_FILES:
        raise ModelFileError(f'There are more than {MOST_FILES:,} files in "{quotable(str(folder))}"')
    return found


def content_of(path: Path, most: int) -> bytes:
    """The bytes of a plain file.

    Raises
    ------
    ModelFileError
        It cannot be read, is a link or no plain file, or has more than so many bytes.
    """
    careful = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    with file_errors("It cannot be read"), os.fdopen(os.open(path, os.O_RDONLY | careful), "rb") as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise ModelFileError("It is no plain file")
        content = file.read(most + 1)
    if len(content) > most:
        raise ModelFileError(f"It has more than {most:,} bytes")
    return content


def _of_student(entry: os.DirEntry[str], ending: str) -> Iterator[HandedIn]:
    path = Path(entry.path)
    if entry.is_dir(follow_symlinks=False):
        yield from _in_folder(path, ending)
    else:
        problem = _problem(entry, ending)
        yield HandedIn(entry.name if problem.startswith(_OTHER) else path.stem, entry.name, path, problem)


def _in_folder(path: Path, ending: str) -> Iterator[HandedIn]:
    try:
        inside = list(_files(path))
    except OSError as fault:
        yield HandedIn(path.name, path.name, path, f"Its folder cannot be read: {fault.strerror}")
        return
    for each in inside:
        yield HandedIn(path.name, os.path.relpath(each.path, path.parent), Path(each.path), _problem(each, ending))
    if not any(_ends(each.name, ending) for each in inside):
        kind = f"whose names end in {ending} " if ending else ""
        yield HandedIn(path.name, path.name, path, f"There are no files {kind}in this folder")


def _files(folder: Path, depth: int = DEPTH) -> Iterator[os.DirEntry[str]]:
    for entry in _entries(folder):
        if entry.is_dir(follow_symlinks=False):
            yield from _files(Path(entry.path), depth - 1) if depth > 1 else ()
        else:
            yield entry


def _entries(folder: Path) -> list[os.DirEntry[str]]:
    """What stands in a folder, numbers in names in their order."""
    with os.scandir(folder) as entries:
        seen = [
            entry
            for entry in islice(entries, MOST_FILES + 1)
            if not entry.name.startswith(".") and entry.name not in _PASSED_OVER
        ]
    return sorted(seen, key=lambda entry: _in_order(entry.name))


def _in_order(name: str) -> list[tuple[int, str]]:
    """A key by which names are sorted as people sort them.

    >>> sorted(["b", "a10", "a9"], key=_in_order)
    ['a9', 'a10', 'b']
    """
    return [
        (int(part) if part.isascii() and part.isdigit() and len(part) < 20 else -1, part.casefold())
        for part in re.split(r"([0-9]+)", name)
    ]


def _ends(name: str, ending: str) -> bool:
    return name.lower().endswith(ending)


def _problem(entry: os.DirEntry[str], ending: str) -> str:
    if entry.is_symlink():
        return "It is a link, and links are not followed"
    if not _ends(entry.name, ending):
        return f'{_OTHER} "{quotable(entry.name)}" does not end in {ending}'
    return "" if entry.is_file(follow_symlinks=False) else "It is no plain file"
