"""The map systems of the catalogue are those of Kurth's slides, with the numbers of cells and walls that come out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lsys_kit import ModelNameError, ModelValueError, derive, draw, map_system, map_systems, read_map, system, systems
from lsys_kit.__main__ import main
from lsys_kit.classroom.catalogue import entry
from lsys_kit.derivation.tissues.maps import cell_words
from lsys_kit.geometry.tissues.layout import FIRST_WALL, polygon, tissue
from lsys_kit.geometry.tissues.relaxation import DEFAULT_FORCES, areas, force

COUNTS = {
    "K28": [(4, 4, 1), (6, 7, 2), (9, 12, 4)],
    "K29": [(4, 4, 1), (8, 9, 2), (14, 17, 4)],
    "K30": [(4, 4, 1), (6, 7, 2), (8, 10, 3)],
    "K31": [(4, 4, 1)],
    "K32": [(3, 3, 1), (5, 6, 2), (7, 9, 3)],
    "K34": [(2, 4, 4), (10, 16, 8), (26, 40, 16)],
}


def test_the_rows_of_the_table_are_all_there() -> None:
    assert " ".join(map_systems()) == " ".join(COUNTS)
    assert not set(map_systems()) & set(systems())
    assert repr(map_systems()).splitlines()[2] == "  K29  map-offset-walls         A map whose new walls are offset by a wall x"


@pytest.mark.parametrize("id", COUNTS)
def test_the_maps_of_the_table_come_out(id: str) -> None:
    maps = derive(map_system(id), len(entry(id).lengths) - 1)
    assert maps.counts[:3] == COUNTS[id]
    assert [walls for _, walls, _ in maps.counts] == list(entry(id).lengths)
    for step, cells in entry(id).words.items():
        assert str(maps[step]) == cells


@pytest.mark.parametrize("id", COUNTS)
def test_an_entry_explains_itself(id: str) -> None:
    found = entry(id)
    assert (found.id, found.work, found.notation) == (id, "Kurth", "map")
    assert found.status == {"K31": "found", "K32": "reconstruction", "K34": "reconstruction"}.get(id, "as printed")
    assert all(sentence.endswith(".") for sentence in found.errata + found.notes)
    assert map_system(id).notes == ()
    assert read_map(str(map_system(id))) == map_system(id)


@pytest.mark.slow
@pytest.mark.parametrize("id", COUNTS)
def test_a_first_look_shows_some_steps(id: str) -> None:
    picture = draw(map_system(id))
    assert len(picture.maps) == 1 if id == "K31" else 4 <= len(picture.maps) - 1 <= 8
    assert picture.svg.startswith("<svg")


def test_the_apical_cell_of_the_gametophyte_is_a_triangle_that_leans_left_and_right_in_turn() -> None:
    maps = derive(map_system("K32"), 12)
    assert [cells for _, _, cells in maps.counts] == [1, 2, 3, 4, 5, 7, 10, 13, 16, 19, 22, 25, 28]
    for step, found in enumerate(maps):
        triangles = ["".join(map(str, word)) for word in cell_words(found) if len(word) == 3]
        assert triangles == [["F>n>L<"] if step == 0 else ["N<f>r0>"] if step % 2 else ["F>n>R0<"]][0]


def test_the_gametophyte_consists_of_27_kinds_of_cells() -> None:
    maps = derive(map_system("K32"), 14)
    assert len({word for found in maps for word in cell_words(found)}) == 27
    assert len({word for found in maps[:9] for word in cell_words(found)}) == 27
    assert "but for grey ones" in draw(map_system("K32"), 6).svg


def test_a_square_cell_comes_to_rest_where_springs_and_pressure_balance() -> None:
    """k (s - l0) = P0 / (2 s) with k = 1, l0 = P0 = 0.1."""
    side = (0.1 + 0.21**0.5) / 2
    assert (round(side, 4), round(side**2, 4)) == (0.2791, 0.0779)
    net = tissue(derive(map_system("K31"), 0)[0])
    square = polygon(4) * (side / FIRST_WALL)
    assert areas(square, net) == pytest.approx([side**2], abs=1e-12)
    assert np.abs(force(square, net, areas(square, net), DEFAULT_FORCES)).max() < 1e-15
    [rest] = draw(map_system("K31")).places
    assert np.ptp(rest, axis=0) == pytest.approx([side, side], abs=1e-9)
    assert areas(rest, net) == pytest.approx([side**2], abs=1e-9)
    widths = [scene.width for scene in draw(map_system("K31"), iterations=[0, 2_000], pressure=1).scenes]
    assert widths == pytest.approx([FIRST_WALL, (0.1 + 2.01**0.5) / 2], abs=1e-3)


def test_the_directed_map_divides_nothing_when_listed_the_other_way_around() -> None:
    backwards = "map: D<C<B<A<" + str(map_system("K30")).removeprefix("map: A>B>C>D>")
    assert [cells for _, _, cells in derive(read_map(backwards), 5).counts] == [1] * 6


def test_each_kind_of_system_is_asked_for_by_its_own_name() -> None:
    assert map_system(" k28 ") is map_system("K28")
    with pytest.raises(ModelValueError, match=r'K28 is a map system, not an L-system. It is returned by map_system\("K28"\)'):
        system("k28")
    with pytest.raises(ModelValueError, match=r'P4 is an L-system, not a map system. It is returned by system\("P4"\)'):
        map_system("P4")
    with pytest.raises(ModelNameError, match=r'no system "K300". Did you mean "K30"'):
        map_system("K300")
    with pytest.raises(ModelNameError, match=r'no system "\?". Systems are: K28, K29, K30, K31, K32, K34'):
        map_system("?")
    with pytest.raises(ModelValueError, match="The id or name of a system must be a text"):
        map_system(4)  # type: ignore[arg-type]


def test_where_a_map_cannot_be_shown_it_is_said(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "cells.txt").write_text(str(map_system("K28")))
    for name, said in (
        ("K28", 'K28 is a map system, not an L-system. It is returned by map_system("K28").'),
        (
            str(tmp_path / "cells.txt"),
            "This is a map system, not an L-system (line 1, column 1). Maps are read by read_map(text).",
        ),
    ):
        assert main(["derive", name, "-n", "2"]) == 2
        assert said in capsys.readouterr().err
