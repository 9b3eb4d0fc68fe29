"""Writers of files, broken off at any line: the old file is there or the new one, and nothing else."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TypeAlias

import pytest

from lsys_kit import draw, stages, system
from lsys_kit.__main__ import main
from lsys_kit.classroom.course import copy_course
from lsys_kit.files import create_file, save_file
from tests.endings import DRAWINGS
from tests.faults.injection import FAULTS, break_off, lines_of

Write: TypeAlias = Callable[[Path], object]
SMALL, LARGE = draw(system("K5"), 1), draw(system("K5"), 2)


def nothing(_: Path) -> None:
    """There is no old file."""


def older_course(folder: Path, version: int = 1) -> None:
    """A course as the kit brought it before, in which a student has changed a lesson."""
    for name in ("notebooks/01_a.ipynb", "notebooks/02_b.ipynb", "exercises/01_a.ipynb"):
        (folder / "kit" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "kit" / name).write_text(f"version {version}")
    if version == 1:
        copy_course(folder / "mine", folder / "kit")
        (folder / "mine/notebooks/02_b.ipynb").write_text("my own")
        older_course(folder, 2)


WRITERS: dict[str, tuple[Write, Write, tuple[str, ...]]] = {
    "a new file": (nothing, lambda folder: create_file(folder / "a", b"new"), ("files.py",)),
    "a file": (
        lambda folder: save_file(folder / "a", b"lsys-kit old"),
        lambda folder: save_file(folder / "a", b"lsys-kit new"),
        ("files.py",),
    ),
    "a model": (
        nothing,
        lambda folder: main(["convert", "K12", "--to", "grogra", "-o", str(folder / "a.txt")]),
        ("files.py", "commands/models.py"),
    ),
    "the course": (
        older_course,
        lambda folder: copy_course(folder / "mine", folder / "kit"),
        ("files.py", "classroom/course.py"),
    ),
    **{
        ending: (
            lambda folder, ending=ending: SMALL.save(folder / f"a{ending}"),  # type: ignore[misc]
            lambda folder, ending=ending: LARGE.save(folder / f"a{ending}"),  # type: ignore[misc]
            ("files.py", "pictures/formats/notebook.py"),
        )
        for ending in DRAWINGS
    },
    "pnml": (nothing, lambda folder: draw(stages(system("P2"))).save(folder / "a.pnml"), ("files.py",)),
}
"""How the old file is written, how the new one is, and the files of the package at whose lines that is broken off."""


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # an interrupt before a file is closed
@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("name", WRITERS)
def test_a_writer_that_is_broken_off_leaves_the_old_file_or_the_new_one(name: str, fault: str, tmp_path: Path) -> None:
    before, write, rooms = WRITERS[name]
    whole = tmp_path / "whole"
    whole.mkdir()
    before(whole)
    old = contents(whole)
    lines = lines_of(lambda: write(whole), rooms)
    new = contents(whole)
    for moment in range(len(lines)):
        folder = tmp_path / str(moment)
        folder.mkdir()
        before(folder)
        break_off(lambda folder=folder: write(folder), rooms, moment, FAULTS[fault])  # type: ignore[misc]
        found = contents(folder)
        assert old.keys() <= found.keys() <= old.keys() | new.keys(), lines[moment]
        assert all(content in (old.get(file), new.get(file)) for file, content in found.items()), lines[moment]
        with suppress(FileExistsError):
            write(folder)
        assert contents(folder) == new, lines[moment]
