"""The guide for contributors says what is the case."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from lsys_kit.classroom.catalogue import SYSTEMS
from tests.house import BEGIN, END, GUIDE, ROOT, house, layers, with_house

TEXT = GUIDE.read_text("utf-8")


def test_the_list_is_the_one_that_the_contracts_make() -> None:
    """If not: python -m tests.house."""
    assert TEXT.count(BEGIN) == TEXT.count(END) == 1
    assert with_house(TEXT) == TEXT


@pytest.mark.parametrize("room", sorted(layers()))
def test_each_room_of_the_list_is_a_folder_whose_layers_stand_there(room: str) -> None:
    folder = ROOT / "lsys_kit" / room.replace(".", "/")
    for layer in layers()[room]:
        for name in re.split(r" [|:] ", layer):
            assert (folder / name).is_dir() or (folder / f"{name}.py").is_file()
            assert name in house()


def test_every_path_that_the_guide_names_is_there() -> None:
    paths = re.findall(r"`((?:lsys_kit|tests|notebooks|exercises|\.github|\.ci)/[\w./-]+)`", TEXT)
    assert len(paths) > 15
    assert [path for path in paths if not (ROOT / path).exists()] == []


def test_every_folder_of_tests_is_run_by_its_own_name() -> None:
    rooms = {path.name for path in (ROOT / "tests").iterdir() if path.is_dir() and path.name != "__pycache__"}
    assert [room for room in sorted(rooms) if f"`tests/{room}`" not in TEXT] == []


def test_the_catalogue_is_where_the_guide_says() -> None:
    assert (ROOT / "lsys_kit" / "classroom" / Path(SYSTEMS)).is_dir()
    assert f"`lsys_kit/classroom/{SYSTEMS}`" in TEXT
