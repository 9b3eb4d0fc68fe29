"""The folder of a model, or a .zip of one: what stands beside a model's text, by its name.

Nothing outside of the folder is opened: links are passed over, and an archive in which a name leads out of it is refused. Files
are read one by one, each up to the limit of a text; what an archive holds is inflated up to that limit and no further.
"""

from __future__ import annotations

import stat
import zipfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path, PurePosixPath

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, quotable
from lsys_kit.files import archive_content, archive_members, decoded, file_errors

MOST_FILES = 1_000
"""So many files a folder or an archive may have."""
MOST_BYTES = 32 * 2**20
"""So large an archive may be."""


@dataclass(frozen=True)
class Folder:
    """The files of a folder.

    Attributes
    ----------
    title
        What it is called.
    files
        For each name what gives the first bytes of the file, as many as are asked for.
    """

    title: str
    files: Mapping[str, Callable[[int], bytes]]

    def text(self, name: str) -> str:
        """The text of a file, up to a little more than a model may have."""
        most = 4 * current().text + 4
        with file_errors(f'"{quotable(name)}" cannot be read'):
            content = self.files[name](most)
        text = decoded(content, f'"{quotable(name)}"', most)
        if len(text) > current().text:
            raise ModelLimitError(f'"{quotable(name)}" is longer than {current().text:,} characters', limit=current().text)
        return text

    def named(self, suffix: str) -> list[str]:
        """The names with an ending, in alphabetical order.

        >>> Folder("lily", {"lily.v": lambda most: b"", "lily.l": lambda most: b""}).named(".l")
        ['lily.l']
        """
        return sorted(name for name in self.files if PurePosixPath(name).suffix.lower() == suffix)


def opened_folder(path: Path) -> Folder:
    """The folder, or the archive, at a path; around a file of its own the folder in which it stands.

    Raises
    ------
    ModelFileError
        There is none, it cannot be read, or something in an archive would lead out of it.
    ModelLimitError
        It has too many files, or is too large.
    """
    with file_errors(f'"{quotable(str(path))}" cannot be read'):
        if path.is_dir():
            return Folder(path.resolve().name, _files(path))
        path.stat()
        if not zipfile.is_zipfile(path):
            beside = {}
            with suppress(ModelLimitError, PermissionError):
                beside = _files(path.parent)
            return Folder(path.parent.name, {**beside, path.name: partial(_first_bytes, path)})
    return _archive(path)


def _files(path: Path) -> dict[str, Callable[[int], bytes]]:
    entries = [*islice(path.iterdir(), MOST_FILES + 1)]
    if len(entries) > MOST_FILES:
        raise ModelLimitError(f"This folder has more than {MOST_FILES:,} files", limit=MOST_FILES)
    return {entry.name: partial(_first_bytes, entry) for entry in entries if stat.S_ISREG(entry.lstat().st_mode)}


def _first_bytes(path: Path, most: int) -> bytes:
    with path.open("rb") as file:
        return file.read(most)


def _archive(path: Path) -> Folder:
    """The files of an archive, in whichever of its folders they are; of two with a name that of the model's folder."""
    if path.stat().st_size > MOST_BYTES:
        raise ModelLimitError(f"This archive is larger than {MOST_BYTES:,} bytes", limit=MOST_BYTES)
    inside = archive_members(path, MOST_FILES)
    models = sorted({PurePosixPath(each.filename).parent for each in inside if each.filename.lower().endswith(".l")}, key=str)
    home = models[0] if models else PurePosixPath()
    return Folder(
        path.name,
        {
            PurePosixPath(each.filename).name: partial(archive_content, path, each)
            for each in inside
            if PurePosixPath(each.filename).parent == home
        },
    )
