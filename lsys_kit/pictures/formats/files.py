"""Files: a picture is saved in the format given by the extension of the file name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

from lsys_kit.errors import ModelFileError, quotable

Encoders: TypeAlias = Mapping[str, Callable[[], bytes]]
"""For each extension a function that encodes the picture."""


def save_as(path: Path, formats: Encoders, hint: str = "") -> None:
    """Write a file in the format given by its extension; an existing file is replaced.

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
        The name ends in something else, or the file cannot be written.
    """
    if path.suffix.lower() not in formats:
        raise ModelFileError(f'This picture cannot be written to "{quotable(path.name)}"',
                             hint=f"Let the name end in {_listed(formats)}. {hint}".rstrip())
    _write_bytes(path, formats[path.suffix.lower()]())


def save_beside(path: Path, content: bytes) -> None:
    """Write an accompanying file; an existing file with a different first line is not replaced.

    Raises
    ------
    ModelFileError
        A file of another origin exists already, or the file cannot be written.
    """
    first = content.partition(b"\n")[0]
    try:
        with path.open("rb") as there:
            foreign = there.read(len(first)) != first
    except (OSError, ValueError):
        foreign = False
    if foreign:
        raise ModelFileError(f'"{quotable(str(path))}" is there already, and was not made by the kit',
                             hint="It would have to be replaced: take another name.")
    _write_bytes(path, content)


def _write_bytes(path: Path, content: bytes) -> None:
    try:
        path.write_bytes(content)
    except (OSError, ValueError) as fault:
        reason = getattr(fault, "strerror", None) or fault
        raise ModelFileError(f'"{quotable(str(path))}" cannot be written: {reason}') from None


def _listed(endings: Iterable[str]) -> str:
    """The extensions, in a sentence.

    >>> _listed([".svg", ".png", ".pdf"])
    '.svg, .png or .pdf'
    """
    *most, last = endings
    return f"{', '.join(most)} or {last}" if most else last
