"""The books of cellworks and of maps on a sphere hold the cells that are derived, and what the panel says of them is so."""

from __future__ import annotations

import json
from collections import Counter
from itertools import pairwise

import pytest

from lsys_kit import (
    ModelNameError,
    ModelSyntaxError,
    ModelValueError,
    cellwork_system,
    compare,
    derive,
    explore,
    limits,
    link,
    linked,
    map_system,
    read,
    read_cellwork,
    read_map,
)
from lsys_kit.__main__ import main
from lsys_kit.classroom.panel.books.cells import size_text
from lsys_kit.notation.model.cells import Edge
from tests.classroom.panel_page import answered
from tests.classroom.test_map_book import whole

pytestmark = pytest.mark.slow

K33, K34 = cellwork_system("K33"), map_system("K34")
TISSUES = {"K33": K33, "K34": K34}
SKEW = str(K33).replace("steps: 4\n", "steps: 2\n").replace("[PQ: PR|P|PR, PQ]", "[PQ: PR|P|PR, PR]")
"""K33 with markers whose edges go around a cell, and name two new walls."""


def edges_of(found):
    return [Edge(edge.label, ">" * edge.directed) for edge in getattr(found, "edges", None) or found.walls]


@pytest.mark.parametrize("id", TISSUES)
def test_a_book_holds_the_cells_that_are_derived_with_mothers_and_tokens(id):
    book = explore(id).model["book"]
    steps = derive(TISSUES[id], book["steps"])
    for step, found in enumerate(steps):
        assert len(whole(book["words"][step])) == len(found.cells)
        assert book["sizes"][step] == size_text(found)
        counts = Counter(map(str, edges_of(found)))
        assert book["tokens"][step] == [counts[text] for *_, place, text in book["states"] if place >= 0]
    for (before, after), many in zip(pairwise(steps), map(whole, book["daughters"]), strict=True):
        assert [mother for mother in range(len(before.cells)) for _ in range(many[mother])] == [*after.mothers]


@pytest.mark.parametrize(("id", "euler"), [("K33", 1), ("K34", 2)])
def test_eulers_number_is_the_same_at_every_step(id, euler):
    sizes = explore(id).model["book"]["sizes"]
    assert len(sizes) > 4
    assert all(text.endswith(f"= {euler}") for text in sizes)
    assert explore("K33", 2).text.startswith(
        "Step 2: 18 vertices, 33 edges, 20 walls, 4 cells; 18 \u2212 33 + 20 \u2212 4 = 1. QR QR"
    )
    assert explore("K34", 1).text.startswith("Step 1: 10 vertices, 16 walls, 8 cells; 10 \u2212 16 + 8 = 2. L>ex<L< | ")


def test_cells_are_written_as_the_cycles_of_edges_around_their_walls():
    book = explore("K33", 0).model["book"]
    assert book["states"][whole(book["words"][0])[0]][3] == ("PQ: PQPQ, PQ: PQPQ, PR: PRPR, PR: PRPR, QR: QRQR, QR: QRQR")
    sphere = explore("K34", 1).model["book"]
    assert [sphere["states"][state][3] for state in whole(sphere["words"][1])] == str(derive(K34, 1)[1]).split(" | ")
    arrows = read_cellwork(
        "cellwork: 1(0,0,0) 2(1,0,0) 3(0,1,0) 4(0,0,1)\nwall W: 1 A> 2 B 3 B\nwall V: 1 A> 2 B 4 B\n"
        "wall W: 1 B 3 B 4 B\nwall W: 2 B 3 B 4 B"
    )
    book = explore(arrows, 0).model["book"]
    assert book["states"][whole(book["words"][0])[0]][3] == "W: A<BB, V: A>BB, W: BBB, W: BBB"


def test_a_step_whose_new_edges_name_two_walls_ends_the_panel_and_says_why():
    panel = explore(SKEW)
    book = panel.model["book"]
    assert (book["steps"], panel.step) == (0, 0)
    assert book["end"].startswith("Step 1: cell 0 has new edges in a cycle, but they do not lie in one new wall")
    with pytest.raises(ModelValueError, match="The panel shows steps 0 to 0, not 1"):
        panel.step = 1


def test_rules_by_which_no_cell_is_divided_are_told_of():
    halves = str(K33).replace("steps: 4", "steps: 1").replace("[PR: QR|Q|QR, PQ] ", "")
    assert explore(halves).model["book"]["said"] == "no cell is divided at any step: new edges never go once around one"
    assert explore("K33", 1).model["book"]["said"] == ""


def test_the_panel_holds_no_more_steps_than_come_to_rest_soon():
    assert "The panel ends at step 6: later steps take long to come to rest" in explore("K33").model["book"]["end"]
    assert explore("K33", 7).model["book"]["steps"] == 7
    with limits(modules=100):
        assert explore("K33").model["book"]["steps"] == 4


@pytest.mark.parametrize(
    ("choices", "kind", "message"),
    [
        ({"angle": 30}, ModelValueError, "A cellwork has no angle"),
        ({"tension": 1}, ModelNameError, 'A cellwork has no "tension"'),
        ({"pressure": 100}, ModelValueError, '"pressure" must lie'),
        ({"step": -1}, ModelValueError, "The step"),
    ],
)
def test_settings_that_make_no_sense_are_refused(choices, kind, message):
    with pytest.raises(kind, match=message):
        explore("K33", **choices)


def test_forces_are_sliders_and_traits():
    panel = explore("K33", 1, pressure=4)
    before = panel.sight.svg
    assert (panel.pressure, panel.settings["rest"], panel.around, panel.above) == (4, "1", 30, 25)
    panel.pressure = 10
    assert panel.sight.svg != before
    assert explore("K34", 0).settings == {"stiffness": "1", "rest": "0", "pressure": "0.5", "damping": "1"}


@pytest.mark.parametrize("id", TISSUES)
def test_a_panel_is_found_again_by_its_link_and_by_its_text(id):
    panel = explore(id, 1)
    panel.pressure = 1
    again = explore(panel.link)
    assert (again.system, again.step, again.pressure) == (TISSUES[id], 1, 1)
    assert linked(link(TISSUES[id], {"step": 1})).settings == {"step": 1}
    assert explore(str(TISSUES[id]), 1).sight.svg == explore(id, 1).sight.svg


def test_the_link_of_a_cellwork_is_read_as_one_alone():
    assert read_cellwork(link(K33)) == K33
    with pytest.raises(ModelValueError, match="This is the link of a cellwork system, not of an L-system"):
        read(link(K33))
    with pytest.raises(ModelValueError, match="not of a map system"):
        read_map(link(K33))
    with pytest.raises(ModelValueError, match="This is the link of another system, not of a cellwork system"):
        read_cellwork(link(K34))
    with pytest.raises(ModelSyntaxError):
        read_cellwork("#lsys=aBroken")


@pytest.mark.parametrize("id", TISSUES)
def test_a_stored_notebook_shows_one_picture(id):
    panel = explore(id, 2)
    bundle = panel._repr_mimebundle_()
    assert bundle["image/svg+xml"] == panel.sight.svg
    assert panel.sight.svg.count("<svg") == 1
    assert bundle["text/plain"].startswith("Step 2: ")
    turned = explore(id, 2)
    turned.around = 100
    assert turned.sight.svg != panel.sight.svg


@pytest.mark.parametrize(
    ("choices", "said"),
    [
        ({"field": 1}, "The explorer takes no field of Python"),
        ({"pressure": 2}, '"pressure" stands beside what is compared, and belongs to one side of it'),
    ],
)
def test_what_belongs_to_one_side_is_refused_beside_both(choices, said):
    with pytest.raises(ModelValueError, match=f"^{said}"):
        compare("K33", {}, {"pressure": 2}, **choices)


def test_two_cellworks_are_compared():
    both = compare("K33", {}, {"pressure": 2}, step=2)
    assert (both.left.step, both.right.pressure) == (2, 2)
    assert compare("K33", K34, step=1).text.count("Step 1: ") == 2


def test_rules_that_are_typed_open_another_cellwork_or_say_what_is_wrong():
    panel = explore("K33", 2)
    assert answered(panel, {"kind": "rules", "text": str(K33).replace("P: * -> R", "P: PQ -> R")})["opened"]
    assert panel.system != K33
    mistake = answered(panel, {"kind": "rules", "text": str(K33).replace("wall QR: 2 Q 3 R 7 Q 6 R\n", "")})["mistake"]
    assert "The first cell is not closed" in mistake["message"]
    for text in ("sphere: D>D>D>D>", str(K33), "axiom: F", str(K33), "map: AAA"):
        assert answered(panel, {"kind": "rules", "text": text})["opened"]


@pytest.mark.parametrize("id", TISSUES)
def test_the_shell_writes_pages_and_links(id, tmp_path, capsys):
    assert main(["page", id, "-n", "1", "-o", str(tmp_path / "page.html")]) == 0
    assert "Fixed on this page: stiffness = 1" in capsys.readouterr().out
    assert main(["link", id, "-n", "2"]) == 0
    assert linked(capsys.readouterr().out.strip()).system == TISSUES[id]
    assert json.dumps(explore(id).model)
