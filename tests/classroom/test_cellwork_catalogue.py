"""The cellwork systems of the catalogue, with the numbers of walls and cells that come out."""

from __future__ import annotations

from pathlib import Path

import pytest

from lsys_kit import (
    ModelNameError,
    ModelValueError,
    cellwork_system,
    cellwork_systems,
    derive,
    map_system,
    map_systems,
    read_cellwork,
    system,
    systems,
)
from lsys_kit.__main__ import main
from lsys_kit.classroom.catalogue import cell_system, entry


@pytest.mark.parametrize("id", cellwork_systems())
def test_an_entry_explains_itself_and_its_cellworks_come_out(id: str) -> None:
    found, own = entry(id), cellwork_system(id)
    assert (found.id, found.work, found.notation, found.status) == (id, "Kurth", "cellwork", "reconstruction")
    assert all(sentence.endswith(".") for sentence in found.errata + found.notes)
    assert own.notes == ()
    assert read_cellwork(str(own)) == own
    cellworks = derive(own, len(found.lengths) - 1)
    assert [walls for _, _, walls, _ in cellworks.counts] == list(found.lengths)
    for step, cells in found.words.items():
        assert str(cellworks[step]) == cells


def test_each_kind_of_system_is_asked_for_by_its_own_name() -> None:
    assert cellwork_systems() == ("K33",)
    assert not {*cellwork_systems()} & {*systems(), *map_systems()}
    assert cellwork_system(" cuboid-cellwork ") == cellwork_system("K33")
    assert cell_system("k33") == cellwork_system("K33") != cell_system("K28")
    for ask in (system, map_system):
        with pytest.raises(ModelValueError, match=r'K33 is a cellwork system, not .* returned by cellwork_system\("K33"\)'):
            ask("K33")
    with pytest.raises(ModelValueError, match="K28 is a map system, not a cellwork system"):
        cellwork_system("K28")
    with pytest.raises(ModelNameError, match=r"Systems are: K33"):
        cellwork_system("?")


def test_a_cellwork_is_listed_and_drawn_by_the_shell(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["list"]) == 0
    assert "Cellwork systems\nW. Kurth, L-Systeme (lecture slides)\n  K33  cuboid-cellwork" in capsys.readouterr().out
    assert main(["draw", "K33", "-n", "2", "-o", str(tmp_path / "cells.glb")]) == 0
    assert "step 2; 18 vertices, 33 edges, 20 walls, 4 cells" in capsys.readouterr().out
    assert main(["derive", "K33", "-n", "2"]) == 2
    assert "K33 is a cellwork system" in capsys.readouterr().err
