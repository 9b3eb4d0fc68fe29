"""Files: a picture is kept in the format that the file's name ends in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

from lsys_kit.errors import ModelFileError, quotable

Encoders: TypeAlias = Mapping[str, Callable[[], bytes]]
"""For each ending the bytes of such a file, made when they are needed."""


def save_as(path: Path, forms: Encoders, hint: str = "") -> None:
    """Write a file in the form that its name ends in; where one is there already, it is replaced.

    Parameters
    ----------
    path
        Where.
    forms
        The endings that it may have.
    hint
        What else to say where it has none of them.

    Raises
    ------
    ModelFileError
        The name ends in something else, or the file cannot be written.
    """
    if path.suffix.lower() not in forms:
        raise ModelFileError(f'This picture cannot be written to "{quotable(path.name)}"',
                             hint=f"Let the name end in {_listed(forms)}. {hint}".rstrip())
    _write(path, forms[path.suffix.lower()]())


def save_beside(path: Path, content: bytes) -> None:
    """Write a file that belongs to another one; a stranger's, whose first line is another, is not replaced.

    Raises
    ------
    ModelFileError
        A stranger's file is there already, or the file cannot be written.
    """
    first = content.partition(b"\n")[0]
    try:
        with path.open("rb") as there:
            strange = there.read(len(first)) != first
    except (OSError, ValueError):
        strange = False
    if strange:
        raise ModelFileError(f'"{quotable(str(path))}" is there already, and was not made by the kit',
                             hint="It would have to be replaced: take another name.")
    _write(path, content)


def _write(path: Path, content: bytes) -> None:
    try:
        path.write_bytes(content)
    except (OSError, ValueError) as fault:
        reason = getattr(fault, "strerror", None) or fault
        raise ModelFileError(f'"{quotable(str(path))}" cannot be written: {reason}') from None


def _listed(endings: Iterable[str]) -> str:
    """The endings in words.

    >>> _listed([".svg", ".png", ".pdf"])
    '.svg, .png or .pdf'
    """
    *most, last = endings
    return f"{', '.join(most)} or {last}" if most else last
