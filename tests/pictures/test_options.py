"""Options: how pictures look is chosen in one way for all kinds, formats, and from the shell; what means nothing is refused."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from PIL import Image

from lsys_kit import (
    ModelNameError,
    ModelValueError,
    animate,
    cellwork_system,
    derive,
    draw,
    figure,
    lineage,
    map_system,
    read,
    stages,
    system,
)
from lsys_kit.__main__ import main
from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START
from lsys_kit.pictures.options import KINDS, OPTIONS
from lsys_kit.pictures.style.palette import RAMP, SERIES, colours
from lsys_kit.pictures.style.themes import DARK, DARK_LINES, LIGHT

PLANT = read("angle: 30\naxiom: A\nA -> F[+B]A\nB -> F B RX")
TREE = read("axiom: F[&F[&F]]")
CELLS = "A B C"
ROW = read(f"axiom: {CELLS}\ninterpretation:\nA -> R(2,2)\nB -> R(2,2)\nC -> R(2,2)")
DRAWN = {
    "the drawing of a turtle": lambda **choices: draw(PLANT, 3, **choices),
    "drawings side by side": lambda **choices: draw(PLANT, steps=[1, 3], **choices),
    "a filament": lambda **choices: draw(system("J4"), 6, **choices),
    "a stage diagram": lambda **choices: draw(stages(system("J4")), **choices),
    "a lineage": lambda **choices: draw(lineage(system("P6"), 2), **choices),
    "a map": lambda **choices: draw(map_system("K28"), 1, **choices),
    "a map on a sphere": lambda **choices: draw(map_system("K34"), 1, **choices),
    "a cellwork": lambda **choices: draw(cellwork_system("K33"), 1, **choices),
}
VALUES = {
    "labels": False,
    "colours": "symbols",
    "widths": 2,
    "turtle": True,
    "legend": True,
    "light": True,
    "background": "dark",
}

PLANTS = "the drawing of a turtle", "drawings side by side"

every_kind = pytest.mark.parametrize("kind", DRAWN)


def test_all_kinds_are_tried():
    assert DRAWN.keys() == KINDS.keys()


def pixels(picture):
    return np.asarray(Image.open(io.BytesIO(picture.png)).convert("RGBA"), int)


def painted(svg):
    return {colour.lower() for colour in re.findall(r'(?:fill|stroke)="(#\w{6})"', svg)}


# --- what can be chosen for what ----------------------------------------------------------------------------------------------


@every_kind
@pytest.mark.parametrize("name", OPTIONS)
def test_an_option_changes_the_picture_or_is_refused(kind, name):
    if name in KINDS[kind]:
        value = kind != "a lineage" if name == "legend" else VALUES[name]
        if name == "colours" and kind in PLANTS:
            value = "natural"  # as they are anyway
        usual, chosen = DRAWN[kind](), DRAWN[kind](**{name: value})
        ET.fromstring(chosen.svg)
        assert (chosen.svg == usual.svg) == (name == "colours")
    else:
        with pytest.raises(ModelValueError, match=f'"{name}" means nothing for {kind}. What can be chosen is'):
            DRAWN[kind](**{name: VALUES[name]})


@pytest.mark.parametrize(
    ("choices", "message"),
    [
        ({"labels": "yes"}, 'True or False for "labels"'),
        ({"legend": 1}, 'True or False for "legend"'),
        ({"background": "drak"}, 'Did you mean "dark"'),
        ({"background": "no such colour"}, 'Give "light", "dark", "none"'),
        ({"background": 3}, "3 is no colour"),
        ({"colours": "natural"}, "Only strokes of a turtle have natural colours"),
        ({"colours": "red"}, 'are "natural", "symbols" or colours of symbols'),
        ({"colours": {"A": "gren"}}, 'Did you mean "green"'),
        ({"colours": {"A": "#12"}}, "is no colour"),
    ],
)
def test_a_value_that_makes_no_sense_is_told(choices, message):
    with pytest.raises(ModelValueError, match=message):
        draw(system("J4"), 2, **choices)


@pytest.mark.parametrize("widths", [0, -1, 1000, "broad", None, [], "nan"])
def test_widths_are_a_kind_or_a_factor(widths):
    if widths is None:
        assert draw(PLANT, 2, widths=None).svg == draw(PLANT, 2).svg
    else:
        with pytest.raises(ModelValueError, match="widths"):
            draw(PLANT, 2, widths=widths)


def test_a_symbol_that_there_is_not_is_named():
    with pytest.raises(ModelNameError, match=r'There is no symbol "Z".*Symbols are: A, '):
        draw(system("J4"), 2, colours={"Z": "red"})
    with pytest.raises(ModelNameError, match=r"There is no symbol \(1, 2\) here"):
        draw(system("J4"), 2, colours={(1, 2): "red"})


# --- colours ------------------------------------------------------------------------------------------------------------------


def test_a_chosen_colour_is_the_same_in_all_pictures_and_no_other_changes():
    model = system("J4")
    for what in (derive(model, 6), stages(model), lineage(model, 6)):
        usual, chosen = draw(what), draw(what, colours={"A": "#123456"})
        assert "#123456" in painted(chosen.svg)
        assert colours(model)["Br"].lower() in painted(chosen.svg)
        assert "#123456" not in painted(usual.svg)
    assert colours(model)["Ar"] in SERIES


def test_a_chosen_colour_stays_on_any_paper():
    for background in ("light", "dark"):
        assert "#ffff00" in painted(draw(PLANT, 2, colours={"F": "yellow"}, background=background).svg)


def test_plants_have_natural_colours_if_nobody_says_otherwise():
    assert draw(TREE, 0).scene.segments.colours.tolist() == [RAMP_START, 19, RAMP_END]
    assert {*draw(TREE, 0, colours="symbols").scene.segments.colours.tolist()} == {OWN}
    bark = RAMP[0].lower()
    assert bark in painted(draw(PLANT, 3).svg)
    assert bark not in painted(draw(PLANT, 3, colours="symbols").svg)


def test_symbols_can_take_the_place_of_the_colours_that_a_model_chooses():
    model = read("axiom: F ;(2) F")
    assert len(painted(draw(model, 0).svg)) == 1 + len(painted(draw(model, 0, colours="symbols").svg))
    assert "#ff0000" in painted(draw(model, 0, colours={"F": "red"}).svg)


# --- backgrounds --------------------------------------------------------------------------------------------------------------


@every_kind
def test_on_dark_paper_nothing_is_left_of_light_paper(kind):
    svg = DRAWN[kind](background="dark").svg
    assert {DARK.ground.lower()} <= painted(svg)
    assert not {LIGHT.paper.lower(), LIGHT.ink.lower(), LIGHT.quiet.lower()} & painted(svg)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["the drawing of a turtle", "drawings side by side", "a filament", "a stage diagram"])
def test_svg_png_and_figures_have_the_same_paper(kind):
    picture = DRAWN[kind](background="dark")
    assert tuple(pixels(picture)[0, 0]) == (*bytes.fromhex(DARK.paper[1:]), 255)
    if kind in ("the drawing of a turtle", "a filament"):
        from matplotlib.colors import to_hex

        sheet = figure(picture).get_figure()
        assert to_hex(sheet.get_facecolor()) == DARK.paper.lower()


def test_lines_on_dark_paper_are_those_of_the_theme_in_every_format():
    picture, seen = draw(PLANT, 3, background="dark", colours="symbols"), DARK_LINES[colours(PLANT)["F"]]
    assert seen.lower() in painted(picture.svg)
    assert (pixels(picture)[..., :3] == [*bytes.fromhex(seen[1:])]).all(axis=2).any()
    from matplotlib.colors import to_hex

    assert {to_hex(edge) for edge in figure(picture).collections[0].get_edgecolor()} == {seen.lower()}


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind", ["the drawing of a turtle", "drawings side by side", "a filament", "a stage diagram", "a cellwork"]
)
def test_without_paper_the_page_shines_through(kind):
    picture, opaque = DRAWN[kind](background="none"), DRAWN[kind]()
    found = pixels(picture)
    assert found[0, 0, 3] == 0
    assert found[..., 3].max() == 255
    cover = found[..., 3:] / 255
    assert (
        np.abs(found[..., :3] * cover + 255 * (1 - cover) - pixels(opaque)[..., :3]).max() < 12
    )  # small multiples are scaled, and wood is dark
    assert LIGHT.ground.lower() not in painted(picture.svg.split("</title>")[1][:200])


def test_a_colour_may_be_the_background():
    assert "#f5f5dc" in painted(draw(PLANT, 2, background="beige").svg)
    assert tuple(pixels(draw(PLANT, 2, background="#000"))[0, 0]) == (0, 0, 0, 255)


# --- widths -------------------------------------------------------------------------------------------------------------------


def stroke_widths(**choices):
    model = read("axiom: F !(0.4) F [+ F]")
    return {int(width) for width in re.findall(r'stroke-width="(\d+)"', draw(model, 0, **choices).svg)}


def test_strokes_are_broader_by_a_factor():
    assert {2 * width for width in stroke_widths()} == stroke_widths(widths=2) != stroke_widths()


def depths(**choices):
    """How thick three strokes are in a mesh, one above the other: of the stem, of a branch, and with a width of its own."""
    picture = draw(read("axiom: F(9) f [ F(9) ] f(20) !(0.4) F(9)"), 0, **choices)
    across, along = picture.mesh.vertices[:, 1], picture.mesh.vertices[:, 2]
    return [float(np.ptp(across[(along >= foot) & (along < foot + 10)])) for foot in (0, 10, 30)]


def test_the_tubes_of_a_mesh_have_the_widths_that_are_chosen():
    trunk, branch, given = depths()
    assert depths(widths=2) == pytest.approx([2 * trunk, 2 * branch, 2 * given], rel=1e-5)
    assert depths(widths=1) == pytest.approx(depths())
    assert depths(widths="order") == pytest.approx([trunk, branch, trunk], rel=1e-5)
    assert depths(widths="constant") == pytest.approx([branch] * 3, rel=1e-5)
    whole, constant = (draw(system("K5"), 2, widths=widths).mesh for widths in ("order", "constant"))
    assert len(constant.vertices) == len(whole.vertices), "stems of one width are whole tubes, too"


def test_strokes_have_the_widths_of_their_orders_or_a_constant_one():
    assert stroke_widths(widths="order") == {24, 17}
    assert len(stroke_widths(widths="constant")) == 1 < len(stroke_widths())


# --- labels and legends -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["drawings side by side", "a stage diagram"])
def test_without_labels_there_is_no_text(kind):
    assert "</text>" in DRAWN[kind]().svg
    assert not re.findall(r"[\w(]</t(?:ext|span)>", DRAWN[kind](labels=False).svg)


def test_a_filament_without_labels_has_no_steps():
    assert ">step<" in DRAWN["a filament"]().svg
    assert "</text>" not in DRAWN["a filament"](labels=False).svg


def test_more_than_two_kinds_of_cells_have_letters():
    letters = re.compile(r'stroke="#\w+">(\w)</text>')
    assert letters.findall(draw(ROW, 0).svg) == CELLS.split()
    assert letters.findall(draw(ROW, 0, labels=False).svg) == []
    assert letters.findall(draw(system("J4"), 3).svg) == []
    assert {*letters.findall(draw(system("J4"), 3, labels=True).svg)} == {"A", "B"}


def test_a_legend_names_each_colour_and_what_was_passed_over():
    model = read("turtle: plant-string\naxiom: I RH & I +")
    legend = draw(model, 0, legend=True).svg.split('class="legend"')[1]
    assert colours(model)["I"] in legend
    assert ">I<" in legend
    assert "passed over, without a meaning here: RH &amp;" in legend
    assert ">+<" not in legend


@pytest.mark.slow
def test_a_legend_stands_below_in_svg_and_png():
    for make in (DRAWN["the drawing of a turtle"], DRAWN["a filament"], DRAWN["drawings side by side"]):
        usual, more = pixels(make()), pixels(make(legend=True))
        assert more.shape[0] > usual.shape[0]
        assert pixels(make(legend=True, size=(500, 700))).shape[:2] == (700, 500)
        height = int(re.search(r'height="(\d+)"', make(legend=True).svg)[1])
        assert height > int(re.search(r'height="(\d+)"', make().svg)[1])


def test_the_axes_know_what_colours_stand_for():
    ax = figure(draw(PLANT, 3, legend=True, colours="symbols"))
    assert ax.get_legend_handles_labels()[1] == ["F"]
    assert ax.get_xlim() == pytest.approx(figure(draw(PLANT, 3, colours="symbols")).get_xlim())


def test_the_legend_of_a_figure_is_that_of_matplotlib():
    assert [text.get_text() for text in figure(draw(PLANT, 3, legend=True, colours="symbols")).get_legend().get_texts()] == [
        "F"
    ]


# --- films and the shell ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("what", [PLANT, system("J4")])
def test_a_film_has_the_looks_of_a_picture(what):
    usual, chosen = (animate(what, 3, **choices) for choices in ({}, {"background": "dark", "legend": True}))
    assert {image.convert("RGB").getpixel((0, 0)) for image in chosen.images} == {(*bytes.fromhex(DARK.paper[1:]),)}
    assert chosen.images[0].height > usual.images[0].height


def test_a_film_needs_a_background():
    with pytest.raises(ModelValueError, match="A film has a background"):
        animate(PLANT, 2, background="none")


def test_the_shell_knows_the_same_options(tmp_path):
    looks = ["--colours", "A=navy,B=#cc79a7", "--legend", "--no-labels", "--background", "dark"]
    main(["draw", "J4", "-n", "5", *looks, "-o", str(tmp_path / "j4.svg")])
    chosen = {"A": "navy", "B": "#cc79a7"}
    expected = draw(derive(system("J4"), 5), colours=chosen, legend=True, labels=False, background="dark")
    assert (tmp_path / "j4.svg").read_text().count(expected.svg[200:]) == 1
    main(["draw", "K5", "-n", "3", "--widths", "order", "--colours", "natural", "-o", str(tmp_path / "k5.svg")])
    assert RAMP[0] in (tmp_path / "k5.svg").read_text()
    main(["draw", "K5", "-n", "1", "--turtle", "-o", str(tmp_path / "k5.svg")])
    assert (tmp_path / "k5.svg").read_text().count("<polygon") == 1
    main(["stages", "J4", "--background", "none", "-o", str(tmp_path / "net.svg")])
    assert draw(stages(system("J4")), background="none").svg[200:] in (tmp_path / "net.svg").read_text()


@pytest.mark.parametrize(
    ("rules", "corners"),
    [
        ("axiom: F(10)", [[0, 0], [-0.48, -1.2], [0.48, -1.2]]),
        ("heading: 0\naxiom: F(10)", [[0, 0], [-1.2, 0.48], [-1.2, -0.48]]),
        ("turtle: grogra\naxiom: F(10)", [[0, 0], [0.48, -1.2], [-0.48, -1.2]]),
    ],
)
def test_an_arrow_points_where_the_turtle_looks_at_its_start(rules: str, corners: list[list[float]]) -> None:
    picture = draw(read(rules), 0, turtle=True)
    assert np.allclose(picture.scene.polygons.points, corners)
    assert len(draw(read(rules), 0).scene.polygons) == 0


@pytest.mark.parametrize("axiom", ["F(10) /(90) &(60) F", "{ . f . -(120) f . }", "@PS(1) F", "[+F] L", ""])
def test_the_arrow_stands_beside_whatever_is_drawn(axiom: str) -> None:
    plant = read(f"axiom: {axiom} A")
    with_arrow, without = draw(plant, 0, turtle=True), draw(plant, 0)
    assert len(with_arrow.scene.polygons) == len(without.scene.polygons) + 1
    assert with_arrow.svg != without.svg
    assert with_arrow.mesh


def test_whether_the_start_is_marked_is_true_or_false() -> None:
    with pytest.raises(ModelValueError, match="True or False"):
        draw(PLANT, 1, turtle="yes")
