"""Each command of the shell with each place that may be wrong: one message or a result, and nothing of the user's is lost."""

from __future__ import annotations

import gzip
import os
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

import lsys_kit.__main__ as shell
from lsys_kit.classroom.exercises.declarations import QUESTIONS
from lsys_kit.files import toml_tables

HUGE = 6 * 2**30
"""Bytes of a file that no memory has room for; on the disk it has none of them."""


def written(place: Path, content: bytes = b"mine") -> Path:
    place.write_bytes(content)
    return place


def huge(place: Path) -> Path:
    with place.open("wb") as file:
        file.truncate(HUGE)
    return place


def with_one(make: Callable[[Path], object], name: str) -> Callable[[Path], Path]:
    """A folder with one thing in it."""

    def folder(place: Path) -> Path:
        place.mkdir()
        make(place / name)
        return place

    return folder


def with_many(name: str) -> Callable[[Path], Path]:
    def folder(place: Path) -> Path:
        place.mkdir()
        first = written(place / name.format(0), b"")
        for number in range(1, 10_002):
            os.link(first, place / name.format(number))
        return place

    return folder


def linked_to(target: str) -> Callable[[Path], Path]:
    def link(place: Path) -> Path:
        place.symlink_to(place if target == "itself" else place.with_name(target))
        return place

    return link


def made_folder(place: Path) -> Path:
    place.mkdir()
    return place


ANY: Mapping[str, Callable[[Path], Path | str]] = {
    "nothing": lambda place: place,
    "nothing in a folder that is not there": lambda place: place / "no" / "where",
    "an empty file": lambda place: written(place, b""),
    "a file of the user's": written,
    "what is in a file": lambda place: written(place) / "a",
    "an empty folder": made_folder,
    "a link to nothing": linked_to("gone"),
    "a link to itself": linked_to("itself"),
    "a name that is too long": lambda place: place.with_name("x" * 5_000),
    "a name that cannot be": lambda place: f"{place}\0",
    "what nobody may write": lambda place: "/proc/nothing",
    "no name": lambda place: "",
}
FILES = {**ANY, "a file without end": huge, "what is no text": lambda place: written(place, bytes(range(256)))}
FOLDERS = {
    **ANY,
    **{
        f"a folder with {what} {ending}": with_one(make, f"a{ending}")
        for ending in (".toml", ".ipynb", ".txt")
        for what, make in {
            "an empty": lambda place: written(place, b""),
            "an endless": huge,
            "a waiting": os.mkfifo,
            "a folder": Path.mkdir,
            "a binary": lambda place: written(place, bytes(range(256))),
            "a link to nothing": linked_to("gone"),
        }.items()
    },
    **{f"a folder with too many {ending}": with_many("{}" + ending) for ending in (".toml", ".ipynb", ".txt")},
}
READ, WRITTEN = "READ", "WRITTEN"
COMMANDS: Mapping[str, tuple[Mapping[str, Callable[[Path], Path | str]], str]] = {
    "derive": (FILES, f"{READ} -n 1"),
    "draw": (FILES, f"{READ} -n 1 -o {WRITTEN}.svg"),
    "stages": (FILES, f"{READ} -n 1 -o {WRITTEN}.svg"),
    "convert": (FILES, f"{READ} --to abop -o {WRITTEN}"),
    "link": (FILES, f"{READ} --base https://example.org --qr {WRITTEN}.svg"),
    "infer": (FILES, READ),
    "page": (FILES, f"{READ} -o {WRITTEN}.html"),
    "site": (ANY, f"-o {WRITTEN}"),
    "lite": (ANY, f"--pyodide {READ} -o {WRITTEN}"),
    "lab": (ANY, WRITTEN),
    "class": (FOLDERS, f"report {READ}"),
    "collect": (FOLDERS, f"{READ} -o {WRITTEN}.csv"),
    "wall": (FOLDERS, f"{READ} -o {WRITTEN}.html"),
    "exercises check": (FOLDERS, READ),
    "exercises notebooks": (FOLDERS, f"{READ} -o {WRITTEN}"),
    "exercises scorm": (FOLDERS, f"{READ} -o {WRITTEN}.zip"),
    "lesson new": (ANY, f"ferns -o {WRITTEN}"),
    "lesson check": (FOLDERS, f"{READ} --no-run"),
    "lesson translate": (FOLDERS, f"{READ} --language de"),
    "lesson unpack": (FILES, f"{READ} -o {WRITTEN}"),
}
"""What each command reads, and how it is typed."""
FINE = {
    "lite": "pyodide",
    "collect": "handed_in",
    "wall": "plants",
    "exercises notebooks": str(QUESTIONS),
    "exercises scorm": "1",
}
"""What is there to be read where it is the place to be written that is wrong."""


def test_every_command_is_tried() -> None:
    declared = tomllib.loads((Path(shell.__file__).parent / "commands.toml").read_text("utf-8"))["commands"]
    names = {f"{name} {part}".strip() for name, each in declared.items() for part in each.get("commands", [""])}
    assert names - {"list"} == set(COMMANDS)


def cases() -> Iterator[Any]:
    for command, (readable, typed) in COMMANDS.items():
        for role, places in ((READ, readable), (WRITTEN, ANY)):
            if role in typed:
                for name in places:
                    slow = [pytest.mark.slow] if "too many" in name or name == "no name" else []
                    yield pytest.param(command, role, name, id=f"{command}, {role}: {name}", marks=slow)


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A course without a page, no laboratory, and what is fine to be read."""
    monkeypatch.setattr("lsys_kit.classroom.site.build.course_files", lambda source: {})
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("lsys_kit.classroom.lite.build._builder", lambda: None)
    monkeypatch.setattr("lsys_kit.classroom.lite.build._built", lambda _, work, __: small_lab(work / "out"))
    pyodide = made_folder(tmp_path / "pyodide")
    for each in toml_tables("lsys_kit.classroom.site", "pyodide.toml")["files"]:
        written(pyodide / each, LOCK if each.endswith(".json") else b"")
    with_one(lambda place: written(place, b"axiom: F"), "ann.txt")(tmp_path / "plants")
    with_one(lambda place: written(place, b'{"cells": []}'), "ann.ipynb")(tmp_path / "handed_in")


LOCK = gzip.decompress((files("lsys_kit.classroom.lite") / "pyodide-lock.json.gz").read_bytes())


def small_lab(folder: Path) -> Path:
    """What a JupyterLab in a browser is to those who do not open it."""
    (folder / "files" / "notebooks").mkdir(parents=True)
    written(folder / "files" / "notebooks" / "a.ipynb")
    written(folder / "jupyter-lite.json", b'{"jupyter-config-data": {}}')
    return folder


def bystanders(folder: Path) -> dict[str, bytes]:
    """The files of the user, but for endless ones."""
    return {
        str(each): each.read_bytes()
        for each in folder.rglob("*")
        if each.is_file() and not each.is_symlink() and 0 < each.stat().st_size < 1_000_000
    }


@pytest.mark.slow
@pytest.mark.parametrize(("command", "role", "name"), [*cases()])
def test_a_wrong_place_is_one_message_and_loses_nothing(
    command: str, role: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    readable, typed = COMMANDS[command]
    place = str((readable if role == READ else ANY)[name](tmp_path / "place"))
    if role == WRITTEN and name == "a file of the user's":  # with the ending that the command wants
        for ending in (".svg", ".html", ".csv", ".zip"):
            written(tmp_path / f"place{ending}")
    before = bystanders(tmp_path)
    given = {READ: FINE.get(command, "K5"), WRITTEN: "out", role: place}
    arguments = [next((part.replace(key, given[key]) for key in given if key in part), part) for part in typed.split()]
    status = shell.BAD_INPUT
    with suppress(SystemExit):
        status = shell.main([*command.split(), *arguments])
    said = capsys.readouterr()
    assert status in (0, shell.BAD_INPUT)
    assert "Traceback" not in said.err
    if status:
        told = said.err.splitlines()[-1] if command == "lab" else said.err
        assert told.startswith("lsys-kit: ")
        assert len(told) < 12_000
    after = bystanders(tmp_path)
    assert {path: after.get(path) for path in before} == before
