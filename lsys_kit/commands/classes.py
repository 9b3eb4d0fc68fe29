"""The commands for a class: marks of what its students hand in, and a page with their plants."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import create_file


def collect_marks(options: argparse.Namespace) -> None:
    """Write the marks of a class as a table."""
    from lsys_kit.classroom.exercises.collecting import collect, marks_table

    if os.path.lexists(options.output):
        raise _exists(options.output)
    marks = collect(options.folder, options.exercises)
    try:
        create_file(Path(options.output), marks_table(marks).encode())
    except FileExistsError:
        raise _exists(options.output) from None
    except (OSError, ValueError) as fault:
        raise ModelFileError(
            f'"{quotable(options.output)}" cannot be written: {getattr(fault, "strerror", None) or fault}'
        ) from None
    unread = sum(not each.scores for each in marks)
    print(
        f"{len(marks)} students in {quotable(options.output)}, {unread} without an answer. A check is no examination: the "
        "answers come with the kit."
    )


def write_wall(options: argparse.Namespace) -> None:
    """Write a page with the plants of a class."""
    from lsys_kit.classroom.panel.page import save_page
    from lsys_kit.classroom.wall import wall, wall_page

    tiles = wall(options.folder)
    save_page(options.output, wall_page(options.title or Path(options.folder).resolve().name, tiles))
    missing = sum(bool(tile.mistake) for tile in tiles)
    print(f"{len(tiles)} plants, {missing} of which cannot be drawn. Open {quotable(options.output)} in a browser.")


def _exists(name: str) -> ModelFileError:
    return ModelFileError(f'"{quotable(name)}" already exists', hint="Files are never overwritten: choose another name.")
