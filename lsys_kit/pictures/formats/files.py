"""Files: a picture is kept in the format that the file's name ends in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import save_file

Encoders: TypeAlias = Mapping[str, Callable[[], bytes]]
"""For each ending the bytes of such a file, made when they are needed."""


def save_as(path: Path, forms: Encoders, hint: str = "") -> None:
    """Write a file in the form that its name ends in; one that the kit has made before is replaced, no other.

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
        The name ends in something else, a file that the kit did not make is there already, or the file cannot be written.
    """
    if path.suffix.lower() not in forms:
        raise ModelFileError(f'This picture cannot be written to "{quotable(path.name)}"',
                             hint=f"Let the name end in {_listed(forms)}. {hint}".rstrip())
    save_file(path, forms[path.suffix.lower()]())


def _listed(endings: Iterable[str]) -> str:
    """The endings in words.

    >>> _listed([".svg", ".png", ".pdf"])
    '.svg, .png or .pdf'
    """
    *most, last = endings
    return f"{', '.join(most)} or {last}" if most else last
