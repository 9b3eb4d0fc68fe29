"""Lineages as pictures: lines in continuous time, over the cells of the last word."""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from lsys_kit import ModelFileError, ModelLimitError, ModelValueError, derive, draw, figure, lineage, read, system, timed
from lsys_kit.pictures.lineages import LineagePicture, tree_of
from lsys_kit.pictures.style.labels import steering_of
from lsys_kit.pictures.style.palette import colour_of

SVG = "{http://www.w3.org/2000/svg}"
ANABAENA = timed(read("axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)"))
P5_LATE = lineage(system("P5"), 3, dt="1.4")
P6 = lineage(system("P6"), 3, dt="1.4")


def texts(picture: LineagePicture) -> list[str]:
    return ["".join(text.itertext()) for text in ET.fromstring(picture.svg).iter(f"{SVG}text")]


def paths(picture: LineagePicture, **wanted: str) -> list[str]:
    found = ET.fromstring(picture.svg).iter(f"{SVG}path")
    return [
        path.get("d", "") for path in found if all(path.get(name.replace("_", "-")) == value for name, value in wanted.items())
    ]


@pytest.mark.parametrize(("id", "steps"), [("P1", 5), ("P6", 6), ("J4", 9), ("K27", 9), ("P9", 6), ("P8", 6)])
def test_each_line_ends_over_its_cell(id: str, steps: int) -> None:
    tree = tree_of(lineage(system(id), steps))
    assert [cell.state for cell in tree.row] == list(tree.lineage.words[-1])
    assert all(tree.x[cell.state] == cell.x for cell in tree.row)
    edges = [(cell.x - cell.length, cell.x + cell.length) for cell in tree.row]
    assert all(right == pytest.approx(left) for (_, right), (left, _) in pairwise(edges))


def test_a_mother_stands_over_her_daughters() -> None:
    tree = tree_of(P6)
    for cell in range(len(P6.cells)):
        if daughters := P6.daughters(cell):
            assert tree.x[daughters[0]] < tree.x[cell] < tree.x[daughters[-1]]


def test_time_runs_down_evenly() -> None:
    tree = tree_of(P6)
    one = tree.y(Fraction(1)) - tree.y(0)
    assert [tree.y(time) - tree.y(0) for time in P6.divisions] == pytest.approx([float(time) * one for time in P6.divisions])


@pytest.mark.parametrize("given", [P6, lineage(system("P1"), 4), lineage(ANABAENA, 4)])
def test_every_daughter_has_a_corner_at_her_mothers_division(given: object) -> None:
    picture = draw(given)  # type: ignore[call-overload]
    corners = [path for path in paths(picture) if re.match(r"M\d+ \d+H\d+Q", path)]
    assert len(corners) == sum(cell.mother is not None for cell in picture.lineage.cells)


def test_the_axis_has_the_times_of_the_steps() -> None:
    assert texts(draw(P6))[:5] == ["t", "0", "1.4", "2.8", "4.2"]
    assert texts(draw(lineage(system("P1"), 2)))[:4] == ["step", "0", "1", "2"]
    assert texts(draw(lineage(ANABAENA, "5/2")))[:4] == ["t", "0", "1", "2"]
    assert len([text for text in texts(draw(lineage(system("J4"), 40, lifeTimeA=6, lifeTimeB=6))) if text.isdigit()]) <= 15


def test_short_and_long_cells_have_the_colour_of_their_symbol_and_are_told_apart_by_dashes() -> None:
    picture = draw(P6)
    assert {"M(0)", "M(0.2)", "within a step"} <= set(texts(picture))
    dashes = {
        path.get("stroke-dasharray")
        for path in ET.fromstring(picture.svg).iter(f"{SVG}path")
        if path.get("stroke") == colour_of("M", P6.states.system)
    }
    assert dashes == {None, "80 45"}


def test_a_legend_stands_only_where_there_is_something_to_tell() -> None:
    assert "within a step" not in texts(draw(lineage(system("P1"), 4)))
    assert "within a step" in texts(draw(lineage(system("K27"), 4)))
    assert "should have divided" not in texts(draw(P6))
    assert not {"M", "M(0)"} & set(texts(draw(lineage(system("P8"), 4))))


def test_where_a_cell_divides_late_a_broad_band_begins() -> None:
    picture = draw(P5_LATE)
    assert "should have divided" in texts(picture)
    assert len(paths(picture, stroke_width="90")) == 1 + sum(cell.due is not None for cell in P5_LATE.cells)
    assert not paths(draw(P6), stroke_width="90")


def test_lines_within_a_step_are_thin() -> None:
    """Seed 002, figure 6: thick where the production moves a cell on, thin where decomposition makes it."""
    assert paths(draw(P6), stroke_width="11", stroke="#28A964")
    assert not paths(draw(lineage(system("P1"), 4)), stroke_width="11")
    assert not paths(draw(lineage(ANABAENA, 4)), stroke_width="11")


def test_intervals_are_marked_with_their_lengths() -> None:
    """Seed 002, figure 5: sample intervals 0.7 and 1.4."""
    tree = lineage(system("P5"), 6)
    marked = draw(tree, intervals=[("1.4", "2.1"), ("1.4", "2.8")])
    assert [text for text in texts(marked) if text in ("0.7", "1.4")] == ["0.7", "1.4", "0.7", "1.4"]
    with pytest.raises(ModelValueError, match="from 4 to 5"):
        draw(tree, intervals=[(4, 5)])
    for wrong in (None, [None], [(1, 2, 3)], ["1.4"]):
        with pytest.raises(ModelValueError, match="pair of times"):
            draw(tree, intervals=wrong)


def test_where_there_is_no_filament_the_modules_stand_below() -> None:
    assert texts(draw(lineage(ANABAENA, "5/2")))[4:7] == ["bl(0.5)", "ar(0.5)", "ar(0.5)"]


def test_a_picture_of_a_lineage_is_described_kept_and_the_same_every_time(tmp_path: Path) -> None:
    picture = draw(P6)
    assert ET.fromstring(picture.svg).get("aria-label") == f"Lineage of {P6}"
    assert repr(picture) == "lineage of 17 cells at time 4.2, after 16 divisions"
    assert picture.svg == draw(lineage(system("P6"), 3, dt="1.4")).svg
    assert set(picture._repr_mimebundle_()) == {"image/svg+xml", "text/html", "text/plain"}
    picture.save(tmp_path / "tree.svg")
    assert (tmp_path / "tree.svg").read_text(encoding="utf-8").startswith(f"{picture.svg}\n")
    with pytest.raises(ModelFileError):
        picture.save(tmp_path / "tree.gif")


def test_a_lineage_goes_into_a_figure() -> None:
    assert "within a step" in {text.get_text() for text in figure(P6).texts}


def test_a_word_too_large_for_a_picture_is_refused() -> None:
    with pytest.raises(ModelLimitError, match="610 cells are too many"):
        draw(lineage(system("P1"), 13))


@pytest.mark.parametrize("id", ["J3", "K5", "K7", "K19", "L1", "K16"])
def test_a_lineage_of_anything_can_be_drawn(id: str) -> None:
    ET.fromstring(draw(lineage(system(id), 2)).svg)


def test_a_lineage_of_no_step_is_one_cell() -> None:
    ET.fromstring(draw(lineage(system("P6"), 0)).svg)


def test_cells_of_one_symbol_with_more_and_fewer_values_are_of_one_kind_where_kinds_are_many() -> None:
    seen = draw(lineage(read("axiom: A(0)\nA(t) -> A(t+1) G(t) G(t, t)"), 9))
    assert "A" in texts(seen)
    assert "G" in texts(seen)


@pytest.mark.parametrize("id", ["K11", "K20", "K21", "L3"])
def test_what_only_steers_the_turtle_has_no_line(id: str) -> None:
    tree = tree_of(lineage(derive(system(id), 2)))
    shown = {tree.lineage.cells[cell].at_birth.symbol for cell in tree.x}
    steering = steering_of(system(id)) - {rule.predecessor.symbol for rule in system(id).productions}
    assert shown == {cell.at_birth.symbol for cell in tree.lineage.cells} - steering
    assert any(module.symbol in steering for module in tree.lineage.last)


def test_the_axiom_of_grogra_is_a_mother() -> None:
    tree = lineage(system("K3"), 3)
    assert [str(cell.at_birth) for cell in tree.cells if cell.mother is None] == ["*"]


@pytest.mark.slow
@pytest.mark.parametrize("id", ["J6", "K14", "K15", "K17a", "ABOP-3-mycelis"])
def test_no_two_kinds_look_the_same_and_the_legend_is_not_cut(id: str) -> None:
    picture = draw(lineage(system(id)))
    kinds = tree_of(picture.lineage).kinds
    assert len({(kind.colour, kind.dash) for kind in kinds}) == len(kinds)
    image = picture.image()
    white = image.crop((image.width - 4, 0, image.width, image.height)).convert("L").getextrema()
    assert white == (255, 255)


@pytest.mark.parametrize(("id", "steps", "shown"), [("K5", 4, 3), ("K17a", 24, 17), ("K24b", 60, 28), ("ABOP-2.6b", 8, 5)])
def test_where_lines_would_be_too_dense_the_first_steps_are_shown(id: str, steps: int, shown: int) -> None:
    """The tree is that of the lineage of so many steps, and one step more would be too dense."""
    part, *wholes = (draw(lineage(derive(system(id), many))) for many in (steps, shown, shown + 1))
    assert [paths(part), texts(part)[0], texts(part)[1]] == [paths(wholes[0]), "step", f"steps 0 to {shown} of {steps}"]
    assert [str(each).partition("; steps")[2] for each in (part, *wholes)] == [
        f" 0 to {shown} of {steps}",
        "",
        f" 0 to {shown} of {shown + 1}",
    ]


def test_a_lineage_in_which_intervals_are_marked_is_shown_as_a_whole() -> None:
    assert "steps" not in str(draw(lineage(system("K17a"), 24), intervals=[(20, 24)]))


def test_where_lines_are_dense_sisters_share_one_and_what_never_divides_is_pale() -> None:
    dense, sparse = (tree_of(lineage(system("K19"), steps)) for steps in (12, 2))
    symbols = {number: dense.lineage.cells[cell].at_birth.symbol for cell, number in dense.kind_of.items()}
    assert {symbols[number] for number in dense.pale} == {"F", "L", "K"}
    assert sparse.pale == ()
    assert len(sparse.x) == len(sparse.lineage.cells)
    sisters = [dense.lineage.daughters(cell) for cell in dense.x if dense.lineage.cells[cell].at_birth.symbol == "I"]
    assert {sum(daughter in dense.x for daughter in daughters) for daughters in sisters if daughters} == {2}  # of F F I
