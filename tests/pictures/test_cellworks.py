"""Pictures of cellworks: shaded walls, lit cells, and the formats in which they are kept."""

from __future__ import annotations

import io
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from lsys_kit import ModelLimitError, ModelNameError, ModelValueError, cellwork_system, derive, draw, limits
from lsys_kit.geometry.scene import Polygons
from lsys_kit.pictures.rendering.view import axes
from lsys_kit.pictures.style.lighting import LIGHT, brightness
from lsys_kit.pictures.tissues.cellworks import CellworkPicture
from tests.endings import DRAWINGS

K33 = cellwork_system("K33")


def fills(picture: CellworkPicture) -> list[str]:
    return re.findall(r'<polygon[^>]*fill="([^"]*)"', picture.svg)


@pytest.mark.slow
def test_a_picture_says_how_much_there_is() -> None:
    said = "step 2; 18 vertices, 33 edges, 20 walls, 4 cells; {}walls of one colour have the same label"
    assert str(draw(K33, 2)) == said.format("cells pulled apart; ")
    assert str(draw(K33, 2, explode=0)) == said.format("")
    assert str(draw(derive(K33, 0))) == "step 0; 8 vertices, 12 edges, 6 walls, 1 cell; walls of one colour have the same label"
    assert "walls of 1 of them, and the edges of the others" in str(draw(K33, 2, cell=1))
    assert str(draw(K33)).startswith("step 4")
    assert f'aria-label="{draw(K33, 1)}"' in draw(K33, 1).svg


def test_the_walls_of_a_cube_are_lighter_toward_the_light() -> None:
    assert len(fills(draw(K33, 0))) == 6
    assert len(set(fills(draw(K33, 0)))) >= 5
    for side in ((0, 25), (30, 25), (200, 40), (90, -30)):
        picture = draw(K33, 0, view=side)
        normals = np.array([np.cross(*(wall[1:3] - wall[0])) for wall in picture.solid.polygons])
        seen = normals / np.linalg.norm(normals, axis=1)[:, None] @ np.column_stack(axes(*np.radians(side)))
        front = np.flatnonzero(np.abs(seen[:, 2]) > 0.1)
        cosines = (seen * np.sign(seen[:, 2:])) @ LIGHT
        assert np.corrcoef(np.clip(cosines, 0, 1)[front], brightness(picture.scene.normals)[front])[0, 1] > 0.99


@pytest.mark.slow
def test_a_full_turn_changes_nothing_and_half_a_turn_does() -> None:
    assert draw(K33, 2, view=(390, 25)).svg == draw(K33, 2, view=(30, 25)).svg
    assert draw(K33, 2, view=(120, 25)).svg != draw(K33, 2).svg
    front = draw(K33, 0, view=(0, 0)).scene
    assert front.width == pytest.approx(front.height)
    assert 2 < front.width < 2.5  # the wall in front is magnified


@pytest.mark.slow
def test_one_cell_or_one_generation_is_lit() -> None:
    assert len(fills(draw(K33, 4, cell=3))) == 6
    assert "<path" in draw(K33, 4, cell=3).svg
    assert fills(draw(K33, 3, generation=3)) == fills(draw(K33, 3))
    with pytest.raises(ModelValueError, match=r"There is no cell 8. The cells of step 3 are 0 to 7"):
        draw(K33, 3, cell=8)
    with pytest.raises(ModelValueError, match=r"There is no cell of generation 1. .*at step 3 there are: 3"):
        draw(K33, 3, generation=1)


@pytest.mark.slow
def test_cells_pulled_apart_have_all_their_walls_and_keep_their_shapes() -> None:
    whole, pulled = draw(K33, 4, explode=0), draw(K33, 4)
    assert (len(whole.solid.polygons), len(pulled.solid.polygons)) == (40, 16 * 6)
    assert "cells pulled apart" in str(pulled)
    assert "apart" not in str(whole) + str(draw(K33, 0)) + str(draw(K33, 4, cell=3)), "one cell alone stays where it is"
    middles = [np.unique(np.round(draw(K33, 4, cell=3, explode=apart).solid.polygons.points, 6), axis=0) for apart in (0, 0.5)]
    assert middles[0] == pytest.approx(middles[1])  # alone it is its own middle
    meshes = [trimesh.Trimesh(each.solid.polygons.points, _fans(each.solid.polygons)) for each in (whole, pulled)]
    assert meshes[0].volume == pytest.approx(meshes[1].volume, rel=1e-6)


def _fans(polygons: Polygons) -> list[tuple[int, int, int]]:
    pairs = pairwise(polygons.starts.tolist())
    return [(first, each, each + 1) for first, last in pairs for each in range(first + 1, last - 1)]


@pytest.mark.parametrize(
    ("choices", "kind", "message"),
    [
        ({"angle": 30}, ModelNameError, 'A cellwork has no "angle". Its forces are stiffness, rest, pressure, damping'),
        ({"pressure": -1}, ModelValueError, '"pressure" must lie between'),
        ({"view": ("x", 0)}, ModelValueError, '"view" must be a number, not .x.. \\(30, 15\\) is from'),
        ({"cell": "x"}, ModelValueError, "The number of a cell must be a whole number"),
        ({"explode": -1}, ModelValueError, '"explode" is a number from 0 to 10, not -1'),
        ({"generation": -1}, ModelValueError, "The number of a generation must be a whole number"),
    ],
)
def test_choices_are_checked(choices: dict[str, object], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=message):
        draw(K33, 1, **choices)


def test_more_pressure_makes_larger_cells() -> None:
    assert draw(K33, 1, pressure=10).scene.width > 1.02 * draw(K33, 1).scene.width


def test_steps_are_chosen_when_a_system_is_derived() -> None:
    with pytest.raises(ModelValueError, match="Steps are chosen when a cellwork system is derived"):
        draw(derive(K33, 2), 3)
    with limits(figure=10), pytest.raises(ModelLimitError, match="The picture would have 18 walls and edges; the limit is 10"):
        draw(K33, 0)


def test_a_cellwork_is_kept_in_every_format(tmp_path: Path) -> None:
    picture = draw(K33, 3, explode=0)
    for ending in DRAWINGS:
        picture.save(tmp_path / f"cells{ending}")
        assert (tmp_path / f"cells{ending}").stat().st_size > 400
    assert Image.open(io.BytesIO(picture.png)).size[0] > 100
    mesh = trimesh.load(tmp_path / "cells.glb", force="mesh")
    assert len(mesh.faces) == 2 * 24
    mesh.merge_vertices(merge_norm=True, merge_tex=True)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(8 * 15.8546, rel=1e-3)
