"""How a command finds the system that it names: in the catalogue, in a file, in a link or on the standard input."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from lsys_kit.budget import current
from lsys_kit.decoding import decoded
from lsys_kit.errors import LSystemError, ModelFileError, ModelNameError, ModelValueError, quotable

if TYPE_CHECKING:
    from lsys_kit.notation.model.system import LSystem
    from lsys_kit.notation.read import AnySystem

MOST_NEIGHBOURS = 1_000
"""How many files beside a missing one are searched for a similar name."""


def system_with_constants(options: argparse.Namespace) -> LSystem:
    """The system that the command line names, with its constants set."""
    from lsys_kit.derivation.core.rules import constants_of, number_from
    from lsys_kit.notation.model.expressions import Number

    system, values = named_system(options.system, options.notation, options.name), dict(options.settings)
    constants_of(system, values)
    return replace(
        system,
        constants=tuple(
            replace(constant, value=Number(number_from(values[constant.name]))) if constant.name in values else constant
            for constant in system.constants
        ),
    )


def system_or_cells(options: argparse.Namespace) -> AnySystem:
    """The system that the command line names, or the map or cellwork system of the catalogue."""
    from lsys_kit.classroom.catalogue import cell_system

    return cell_system(options.system) or named_system(options.system, options.notation, options.name)


def named_system(name: str, notation: str | None, entry: str | None) -> LSystem:
    """The system of a link, or of the catalogue with this id or name; else that in the file of this name, or an entry."""
    from lsys_kit.classroom.catalogue import system
    from lsys_kit.notation.fragments import is_link
    from lsys_kit.notation.read import read
    from lsys_kit.notation.write import write

    if name == "-":
        return read(_decoded(sys.stdin.buffer, "the standard input"), notation, entry)
    if is_link(name):
        return read(name, notation, entry)
    try:
        found = system(name)
    except ModelNameError:
        return _system_in(name, notation, entry)
    if entry is not None:
        raise ModelValueError(f"{name} is one system of the catalogue", hint="Leave out --name.")
    if notation is not None:
        write(found, notation)  # raises an error that says what the notation lacks
        return replace(found, notation=notation)
    return found


def _system_in(name: str, notation: str | None, entry: str | None) -> LSystem:
    """The system in a file; where none can be read, the file's name may hint at another format."""
    from lsys_kit.notation.foreign import name_hint
    from lsys_kit.notation.read import read

    text = _file(name)
    try:
        return read(text, notation, entry)
    except LSystemError as error:
        hint = name_hint(name)
        if hint and "which the kit does not read" not in error.message:
            error.with_hint(f"{error.hint or ''} {hint}".strip())
        raise


def _file(name: str) -> str:
    """The text of a model file."""
    try:
        with Path(name).open("rb") as file:
            return _decoded(file, f'"{quotable(name)}"')
    except FileNotFoundError:
        raise ModelFileError(
            f'There is no file "{quotable(name)}", and no system of that name in the catalogue', hint=_likely_name(name)
        ) from None
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{quotable(name)}" cannot be read: {getattr(fault, "strerror", None) or fault}') from None


def _decoded(file: BinaryIO, name: str) -> str:
    """The text of a file, up to a little more than a model may have."""
    most = 4 * current().text + 4
    return decoded(file.read(most), name, most)


def _likely_name(name: str) -> str:
    """A hint at what was probably meant: a file in the same folder, or a system of the catalogue."""
    from lsys_kit.classroom.catalogue import likely_system, systems

    folder = Path(name).parent
    beside = [str(path) for path in islice(folder.iterdir(), MOST_NEIGHBOURS)] if folder.is_dir() else []
    return likely_system(name, beside) or f"Catalogue ids are {', '.join(systems())}."
