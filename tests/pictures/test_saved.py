"""Saved files are what they say: shapes, of the size that is meant, whoever opens them."""

from __future__ import annotations

import io
import warnings
import xml.etree.ElementTree as ET

import pytest
from PIL import Image

from lsys_kit import ModelNameError, ModelValueError, draw, growth, limits, read, stages, system
from lsys_kit.pictures.style.colour_values import colour_from

PLANT = read("angle: 25\naxiom: X\nX -> F+[[X]-X]-F[-FX]+X\nF -> FF")
SVG = "{http://www.w3.org/2000/svg}"


@pytest.mark.slow
@pytest.mark.parametrize("ending", [".svg", ".pdf"])
def test_a_file_of_many_strokes_holds_shapes_or_says_that_it_does_not(tmp_path, ending):
    picture = draw(PLANT, 5)
    with warnings.catch_warnings(), limits(segments=100):
        warnings.simplefilter("error")
        picture.save(tmp_path / f"a{ending}")
    assert b"<image" not in (tmp_path / f"a{ending}").read_bytes()
    assert b"/Subtype /Image" not in (tmp_path / f"a{ending}").read_bytes()
    with limits(figure=1_000), pytest.warns(UserWarning, match=rf"The {ending} file holds pixels, .* more than 1,000 shapes"):
        picture.save(tmp_path / f"b{ending}")


@pytest.mark.slow
def test_a_warning_names_the_line_that_saves(tmp_path):
    with limits(figure=10), pytest.warns(UserWarning, match="holds pixels") as found:
        draw(PLANT, 3).save(tmp_path / "a.svg")
    assert found[0].filename == __file__


@pytest.mark.parametrize("make", [lambda: draw(PLANT, 4), lambda: draw(system("J4"), 6), lambda: draw(stages(system("P2")))])
def test_an_svg_file_has_its_size_in_every_program(tmp_path, make):
    """What CairoSVG makes of a style, if it is there, is another height."""
    make().save(tmp_path / "a.svg")
    root = ET.parse(tmp_path / "a.svg").getroot()
    assert root.tag == f"{SVG}svg"
    assert "style" not in root.attrib
    width, height = int(root.get("width")), int(root.get("height"))
    _, _, across, down = map(int, root.get("viewBox").split())
    assert across / down == pytest.approx(width / height, rel=1e-6)
    other = pytest.importorskip("cairosvg")
    assert Image.open(io.BytesIO(other.svg2png(url=str(tmp_path / "a.svg")))).size == (width, height)


@pytest.mark.parametrize(
    ("given", "colour"),
    [("k", "#000000"), ("tab:green", "#2ca02c"), ((0, 0, 0), "#000000"), ([1, 0.5, 0], "#ff8000"), (" SeaGreen ", "#2e8b57")],
)
def test_colours_of_matplotlib_are_colours(given, colour):
    assert colour_from(given) == colour
    assert colour in draw(PLANT, 2, colours={"F": given}).svg


@pytest.mark.parametrize("given", ["none", (2, 0, 0), (0, 0), 5, (0, 0, 0, 0.5), "x", None, ["a"], "#12345678", {}])
def test_what_is_no_colour_is_refused(given):
    with pytest.raises(ModelValueError, match="is no colour"):
        colour_from(given)


def test_habits_of_matplotlib_lead_to_the_right_function():
    with pytest.raises(ModelNameError, match=r"figure\(what, ax, n=4\)"):
        draw(PLANT, 3, ax=None)
    with pytest.raises(ModelValueError, match=r"plot\(growth\(system\)\)"):
        draw(growth(system("J1")))


@pytest.mark.parametrize("word", ["F", "F" * 40, "F+F+F+F", "F(9)+F+F(9)+F", "F[+F]F[-F]F"])
def test_a_picture_has_an_area(word):
    found = draw(read(f"angle: 90\nlength: 30\naxiom: {word}"), 0).drawing()
    assert 160 <= found.width <= 600
    assert found.height <= 640
    assert found.width in (160, 600) or found.height == 640 or found.width * found.height > 200_000
