"""Files: a picture is saved in the format given by the extension of the file name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

from lsys_kit.budget import Task
from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import save_file

Encoders: TypeAlias = Mapping[str, Callable[[], bytes]]
"""For each extension a function that encodes the picture."""
FILMS = (".gif", ".apng", ".mp4")
"""The extensions of films."""


def save_as(path: Path, formats: Encoders, hint: str = "") -> None:
    """Write a file in the format given by its extension; a file that the kit has made before is replaced, no other.

    Parameters
    ----------
    path
        The path of the file.
    formats
        The formats, by extension.
    hint
        An addition to the error message if the extension is unknown.

    Raises
    ------
    ModelFileError
        The name ends in something else, a file that the kit did not make is there already, or the file cannot be written.
    """
    if path.suffix.lower() not in formats:
        raise ModelFileError(
            f'This picture cannot be written to "{quotable(path.name)}"',
            hint=f"Let the name end in {listed(formats)}. {hint}".rstrip(),
        )
    with Task("The file was not written"):
        content = formats[path.suffix.lower()]()
    save_file(path, content)


def listed(endings: Iterable[str]) -> str:
    """The extensions, in a sentence.

    >>> listed([".svg", ".png", ".pdf"])
    '.svg, .png or .pdf'
    """
    *most, last = endings
    return f"{', '.join(most)} or {last}" if most else last
