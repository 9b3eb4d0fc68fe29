"""Pictures: what is said about them, what is in them, where they can be kept."""

import io
import re
import xml.etree.ElementTree as ET

import pytest
from PIL import Image

from lsys_kit import (
    LSystemError,
    ModelFileError,
    ModelNameError,
    ModelValueError,
    derive,
    draw,
    figure,
    limits,
    lineage,
    read,
    stages,
    system,
)
from lsys_kit.pictures.style.palette import colours
from tests.endings import FLAT, SAID_OF_DRAWINGS, beginnings

SVG = "{http://www.w3.org/2000/svg}"


def parsed(picture):
    return ET.fromstring(picture.svg)


def test_a_filament_is_drawn_as_its_developmental_sequence():
    picture = draw(system("J1"), 6)
    assert str(picture) == "steps 0 to 6; the last: 21 cells, width 34, height 1"
    assert len(parsed(picture).findall(f".//{SVG}ellipse")) == 1 + 2 + 3 + 5 + 8 + 13 + 21


def test_a_single_word_is_drawn_alone():
    assert str(draw(derive(system("J1"), 6)[-1])) == "21 cells, width 34, height 1"


def test_a_turtle_draws_the_last_word():
    assert str(draw(system("T2"), 3)) == "192 segments, width 27, height 31.18"


@pytest.mark.parametrize("angle", ["angle", "1e400", 10**400, [], "x"])
def test_an_angle_is_a_number_that_is_known(angle):
    with pytest.raises(LSystemError):
        draw(system("K5"), 2, angle=angle)


def test_commands_that_mean_nothing_are_named_once():
    said = "2 segments, width 0, height 2; passed over, without a meaning here: RH &"
    picture = draw(derive(read("turtle: plant-string\naxiom: I RH & I RH"), 0))
    assert str(picture) == said


def test_the_angle_may_be_given_as_a_person_writes_it():
    assert str(draw(system("K5"), 2, angle="0")) == str(draw(system("K5"), 2, angle=0.0)) == "25 segments, width 0, height 9"


def test_a_picture_is_described_and_the_same_every_time():
    picture, again = draw(system("K5"), 3), draw(system("K5"), 3)
    root = parsed(picture)
    assert root.get("role") == "img"
    assert root.get("aria-label") == str(picture)
    assert picture.svg == again.svg
    assert picture.png == again.png


def test_one_colour_is_one_symbol():
    palette = colours(system("L1"))
    assert len({palette[symbol] for symbol in "IAB"}) == 3
    assert palette["I"] in draw(system("L1"), 2).svg


def test_marked_cells_differ_by_more_than_colour():
    derivation = derive(system("J1"), 3)
    plain, marked = draw(derivation), draw(derivation, marked={0})
    assert marked.svg.count('stroke-width="32"') == sum(code == 0 for word in derivation for code in word.numbers())
    assert 'stroke-width="32"' not in plain.svg


def test_marked_strokes_lie_on_a_broad_band():
    derivation = derive(system("L1"), 2)
    assert 'class="marked"' in draw(derivation, marked={0}).svg


def test_too_many_strokes_become_a_picture_of_pixels():
    with limits(segments=100):
        svg = draw(system("K5"), 3).svg
    assert "data:image/png;base64," in svg
    ET.fromstring(svg)


@pytest.mark.parametrize("id", ["J4", "K5"])
def test_a_png_shows_something_on_white(id):
    image = Image.open(io.BytesIO(draw(system(id), 4).png)).convert("RGB")
    assert image.getpixel((0, 0)) == (255, 255, 255)
    assert len(image.getcolors(100_000)) > 3


@pytest.mark.parametrize(("ending", "head"), beginnings(*FLAT))
@pytest.mark.parametrize("id", ["J1", "K5"])
def test_a_picture_can_be_kept(tmp_path, id, ending, head):
    draw(system(id), 3).save(tmp_path / f"out{ending}")
    assert (tmp_path / f"out{ending}").read_bytes().startswith(head)


def test_a_picture_cannot_be_kept_in_another_format(tmp_path):
    with pytest.raises(ModelFileError, match=re.escape(f"end in {SAID_OF_DRAWINGS}. Films")):
        draw(system("J1"), 1).save(tmp_path / "out.gif")


def test_a_folder_that_is_not_there_is_named(tmp_path):
    with pytest.raises(ModelFileError, match="cannot be written"):
        draw(system("J1"), 1).save(tmp_path / "nowhere" / "out.svg")


def test_a_drawing_goes_into_a_teachers_own_figure():
    from matplotlib.figure import Figure

    ax = Figure().add_subplot()
    assert figure(system("K5"), ax, n=3) is ax
    assert sum(len(shapes.get_paths()) for shapes in ax.collections) == 125
    cells = figure(system("J1"), n=2).collections  # of paper, a mark, arrows row by row, and cells
    assert sum(len(shapes.get_paths()) for shapes in cells) == 1 + 1 + 3 + (1 + 2 + 3)


@pytest.mark.parametrize("what", ["J1", None, 3])
@pytest.mark.parametrize("choices", [{}, {"colours": {"F": "red"}}, {"labels": 3}], ids=str)
def test_only_systems_derivations_and_words_are_drawn(what, choices):
    with pytest.raises(ModelValueError, match="can be drawn"):
        draw(what, **choices)


def test_the_name_of_a_system_is_no_system_and_its_system_is_offered():
    with pytest.raises(ModelValueError, match=r"draw\(system\('J1'\)\)"):
        draw("J1")


@pytest.mark.parametrize("made", [stages, lineage])
def test_the_steps_of_what_is_made_already_are_not_chosen(made):
    what = made(system("J1"))
    with pytest.raises(ModelValueError, match="are chosen when it is made"):
        draw(what, 3)


def test_steps_belong_to_a_system():
    with pytest.raises(ModelValueError, match="when a system is derived"):
        draw(derive(system("J1"), 2), 3)


def test_a_bundle_has_the_picture_and_its_words():
    bundle = draw(system("J1"), 2)._repr_mimebundle_()
    assert set(bundle) == {"image/svg+xml", "text/html", "text/plain"}


def test_names_of_a_model_never_become_markup():
    picture = draw(read("axiom: a\ninterpretation:\na -> L(1,1)"), 0)
    assert "<script" not in picture.svg


@pytest.mark.parametrize(
    ("what", "hint"),
    [
        (system("K5"), "marked, cells, field, view, steps, seeds, size, colours, widths, turtle, legend, light, background."),
        (system("J4"), "Constants of the system are: lifeTimeA, lifeTimeB."),
        (stages(system("P2")), "Options are: tokens, positions, size, labels, colours, background."),
        (lineage(system("P6"), 2), "Options are: intervals, size, labels, colours, legend, background."),
    ],
)
def test_an_option_that_there_is_not_is_named(what, hint):
    with pytest.raises(ModelNameError) as caught:
        draw(what, material="wood")
    assert caught.value.message == 'There is no option "material" here'
    assert caught.value.hint.endswith(hint)
