"""A lesson out of an archive that somebody has sent: data until its cells are run.

Texts, notebooks and pictures alone are taken, under plain names, into a new folder; nothing else in the archive is looked at,
and nothing is run.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path, PurePosixPath

from lsys_kit.classroom.places import MOST_ENTRIES, TRANSLATIONS, course_of
from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import archive_content, archive_members, create_file, file_errors

MOST_FILES, MOST_BYTES, MOST_IN_ALL = 500, 20_000_000, 100_000_000
"""So many files are taken out of an archive, each of so many bytes, and so many bytes in all."""
_PLAIN = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,80}")
_ENDINGS = (".ipynb", ".toml", ".md", ".po", ".png", ".jpg", ".jpeg", ".gif", ".svg")
_WINDOWS = re.compile(r"(?:con|prn|aux|nul|com\d|lpt\d)", re.IGNORECASE)


def unpack(archive: Path, folder: Path | None = None) -> tuple[Path, int, int]:
    """Unpack a lesson or a course into a new folder; return that, and how many cells of code there are in how many notebooks.

    Raises
    ------
    ModelFileError
        It is no archive, it is too large, there is no lesson in it, or the folder is there already.
    """
    root = folder or Path(archive.name.removesuffix(".zip"))
    named = f'"{quotable(str(archive))}"'
    with file_errors(f"{named} cannot be read"):
        if os.path.lexists(root):
            name = str(root)
            raise ModelFileError(f'"{quotable(name)}" already exists', hint="Choose another folder with -o.")
        contents = dict(_contents(archive, named))
    contents = _without_top(contents)
    if not any(name.partition("/")[0] == "notebooks" or "/notebooks/" in name for name in contents):
        raise ModelFileError(f"There is no lesson in {named}", hint="A lesson has a folder notebooks with NAME.ipynb.")
    with file_errors(f'The lesson cannot be written to "{quotable(str(root))}"'):
        for name, content in contents.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            create_file(root / name, content)
    course_of(root)
    cells = [_code_cells(content) for name, content in contents.items() if name.endswith(".ipynb")]
    return root, sum(cells), len(cells)


def _contents(archive: Path, named: str) -> Iterator[tuple[str, bytes]]:
    """The files that are taken, by their names in the archive."""
    total = 0
    wanted = [each for each in archive_members(archive, MOST_ENTRIES) if _is_taken(each.filename)]
    if len(wanted) > MOST_FILES:
        raise ModelFileError(f"There are more than {MOST_FILES:,} files in {named}")
    for each in wanted:
        content = archive_content(archive, each, MOST_BYTES + 1)
        total += len(content)
        if len(content) > MOST_BYTES or total > MOST_IN_ALL:
            raise ModelFileError(f"What is in {named} is too large", hint=f"A file may have {MOST_BYTES:,} bytes.")
        yield each.filename, content


def _is_taken(file: str) -> bool:
    """Whether it has a plain name, and is of a kind that lessons have."""
    *folders, name = file.split("/")
    stem, dot, ending = name.rpartition(".")
    plain = all(_PLAIN.fullmatch(part) and not _WINDOWS.fullmatch(part) for part in (*folders, stem))
    if TRANSLATIONS in folders:  # below a language there is what there is in a lesson
        at = folders.index(TRANSLATIONS)
        del folders[at : at + 2]
    return plain and len(folders) <= 4 and f"{dot}{ending}".lower() in _ENDINGS


def _without_top(contents: dict[str, bytes]) -> dict[str, bytes]:
    """Without the one folder in which all of it stands, perhaps."""
    tops = {PurePosixPath(name).parts[0] for name in contents}
    if len(tops) == 1 and not tops & {"notebooks", "exercises"}:
        return {name.partition("/")[2]: content for name, content in contents.items() if "/" in name}
    return contents


def _code_cells(content: bytes) -> int:
    with suppress(ValueError, AttributeError, TypeError, KeyError, RecursionError):
        return sum(cell["cell_type"] == "code" for cell in json.loads(content)["cells"])
    return 0
