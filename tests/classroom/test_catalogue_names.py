"""A system of the catalogue is asked for by its id or by its name, and listed under the work from which it comes."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest

from lsys_kit import (
    ModelNameError,
    ModelValueError,
    book_systems,
    cellwork_systems,
    explore,
    map_system,
    map_systems,
    system,
    systems,
)
from lsys_kit.classroom.catalogue import WORKS, cell_system, entry


def test_the_list_names_every_system_under_the_work_it_comes_from():
    lines = repr(systems()).splitlines()
    assert [line for line in lines if line[0] != " "] == [work for key, work in WORKS.items() if key != "ABOP"]
    assert [line.split()[:2] for line in lines if line[0] == " "] == [[id, entry(id).name] for id in systems()]
    row = "  P4    anabaena-stage-and-polarity     Anabaena with stage and polarity as parameters (L-system 4)"
    assert lines.index(WORKS["Prusinkiewicz"]) < lines.index(row) < lines.index(WORKS["Kurth"])


ENTRIES = [*systems(), *book_systems(), *map_systems()]
RESERVED = {"con", "prn", "aux", "nul", *(f"{device}{number}" for device in ("com", "lpt") for number in range(10))}
"""What Windows takes for a device, whatever its ending."""


def test_every_entry_has_a_name_of_its_own_that_is_no_id():
    names = [entry(id).name for id in ENTRIES]
    assert len(set(names)) == len(ENTRIES)
    assert not set(names) & {id.lower() for id in ENTRIES}


@pytest.mark.parametrize("id", ENTRIES)
def test_a_name_may_be_the_name_of_a_file_on_any_machine(id):
    assert re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", entry(id).name)
    assert len(entry(id).name) <= 40
    assert entry(id).name not in RESERVED


@pytest.mark.parametrize("id", ENTRIES)
def test_a_name_is_accepted_wherever_an_id_is(id):
    name = entry(id).name
    ask = map_system if id in map_systems() else system
    assert ask(name) is ask(f" {name.upper()} ") is ask(id)
    assert entry(name) is entry(id)
    assert cell_system(name) == cell_system(id)
    assert (cell_system(id) is not None) == (id in map_systems() or id in cellwork_systems())


def test_a_panel_may_be_asked_for_by_name():
    assert explore("anabaena-life-spans", 3).system is system("J4")


@pytest.mark.slow
def test_an_id_is_found_without_reading_the_whole_catalogue():
    code = (
        "from lsys_kit.classroom import catalogue as c; c.system('j4'); before = c._entry.cache_info().currsize; "
        "c.system('koch-curve'); print(before, c._entry.cache_info().currsize)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=300)
    assert done.stdout.split() == ["1", str(len(systems()))]


def test_an_id_is_found_whatever_its_case():
    assert system("p4") is system(" P4 ")


@pytest.mark.parametrize(
    ("id", "hint"),
    [
        ("P44", 'Did you mean "P4"?'),
        ("?", "Systems are: J1, J2, J3,"),
        ("K17", 'Did you mean "K17'),
        ("../systems/J1", "Systems are"),
        ("x" * 9999, "Systems are"),
        ("anabena-life-span", 'Did you mean "anabaena-life-spans"?'),
        ("PSEUDOPLANT", 'Did you mean "pseudo-plant"?'),
    ],
)
def test_an_unknown_id_is_answered_with_a_suggestion(id, hint):
    with pytest.raises(ModelNameError) as caught:
        system(id)
    assert hint in str(caught.value)
    assert len(str(caught.value)) < 300


def test_an_id_is_a_text():
    with pytest.raises(ModelValueError, match="The id or name of a system must be a text"):
        system(4)
