"""Pictures of maps on a sphere: what is in front is seen, what lies behind is not."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from lsys_kit import ModelFileError, ModelNameError, ModelValueError, derive, draw, map_system, read_map
from tests.endings import FLAT, SAID_OF_FLAT, beginnings

SVG = "{http://www.w3.org/2000/svg}"
K34 = map_system("K34")
EIGHT = read_map("sphere: D>D>D>D>D>D>D>D>")


def areas(svg: str) -> list[float]:
    """The area of each cell in a picture, as a share of its sphere."""
    root, found = ET.fromstring(svg), []
    radius = float(root.findall(f"{SVG}circle")[0].get("r", ""))
    for cell in (path for path in root.findall(f"{SVG}path") if path.get("fill") != "none"):
        outlines = []
        for outline in cell.get("d", "").split("Z")[:-1]:
            points = [tuple(map(int, pair.split())) for pair in outline[1:].split("L")]
            outlines.append(abs(sum(a * d - b * c for (a, b), (c, d) in zip(points, points[1:] + points[:1], strict=True))) / 2)
        found.append(abs(outlines[0] - sum(outlines[1:])) / (3.14159265 * radius**2))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("around", [0, 20, 45, 100, 311])
@pytest.mark.parametrize("above", [-90, -60, 0, 25, 80, 90])
def test_the_cells_in_front_cover_the_sphere(around: int, above: int) -> None:
    for what in (derive(EIGHT, 0), derive(K34, 0), derive(read_map(str(K34).replace("steps: 4\n", "")), 1)):
        last = draw(what, view=(around + 0.1, above))
        spheres = len(last.maps)
        assert sum(areas(last.svg)) == pytest.approx(spheres, rel=0.01)


@pytest.mark.slow
def test_a_picture_says_what_it_shows() -> None:
    picture = draw(K34, 2)
    assert str(picture) == "steps 0 to 2; the last: 26 vertices, 40 walls, 16 cells"
    assert f'aria-label="{picture}; cells of one colour have the same walls around them"' in picture.svg
    assert str(draw(K34)).startswith("steps 0 to 4")
    assert [found.text for found in ET.fromstring(picture.svg).findall(f"{SVG}text")] == ["0", "1", "2"]
    assert picture._repr_mimebundle_()["image/svg+xml"] == picture.svg == draw(derive(K34, 2)).svg


def test_a_sphere_can_be_turned() -> None:
    assert draw(K34, 1, view=(110, 25)).svg != draw(K34, 1).svg
    assert draw(K34, 1, view=(380, 25)).svg == draw(K34, 1).svg
    assert len(areas(draw(K34, 0, view=(10, 90)).svg)) == 4
    assert len(areas(draw(EIGHT, 0, view=(10, 0)).svg)) == 5


@pytest.mark.parametrize(
    ("choices", "kind", "message"),
    [
        ({"angle": 30}, ModelNameError, 'A map on a sphere has no "angle"'),
        ({"rest": -1}, ModelValueError, '"rest" must lie'),
        ({"iterations": [3]}, ModelNameError, 'A map on a sphere has no "iterations"'),
    ],
)
def test_choices_are_checked(choices: dict[str, object], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=message):
        draw(K34, 1, **choices)
    with pytest.raises(ModelValueError, match="Steps are chosen when a map system is derived"):
        draw(derive(K34, 1), 3)


@pytest.mark.slow
def test_a_sphere_is_kept_in_every_format(tmp_path: Path) -> None:
    for _ in range(2):  # a picture of the kit's own may be replaced
        for ending, first in beginnings(*FLAT):
            draw(K34, 1).save(tmp_path / f"sphere{ending}")
            assert (tmp_path / f"sphere{ending}").read_bytes().startswith(first)
    with pytest.raises(ModelFileError, match=re.escape(f"Let the name end in {SAID_OF_FLAT}")):
        draw(K34, 1).save(tmp_path / "sphere.glb")
