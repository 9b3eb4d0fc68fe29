"""The book of a map system holds the maps that are derived, at the points where they are drawn, and what becomes of walls."""

from __future__ import annotations

import base64
import json
from collections import Counter
from itertools import pairwise

import numpy as np
import pytest

from lsys_kit import (
    LSystemError,
    ModelNameError,
    ModelValueError,
    derive,
    explore,
    limits,
    map_system,
    map_systems,
    read_map,
    system,
)
from lsys_kit.classroom.panel.books.at_rest import cells_at_rest
from lsys_kit.classroom.panel.books.cells import cell_book
from lsys_kit.derivation.petri.walls import kind_of, wall_stages
from lsys_kit.geometry.tissues.layout import place_maps
from lsys_kit.geometry.tissues.relaxation import Forces
from lsys_kit.notation.model.cells import Edge
from tests.classroom.panel_page import answered

DIVIDED = "map: ABAB\nsteps: 2\nA -> B[-A][+A]B\nB -> A"

FLAT = [id for id in map_systems() if not map_system(id).sphere]
"""The map systems of the catalogue that lie in the plane."""


def whole(entry):
    """The numbers of an entry."""
    return np.frombuffer(base64.b64decode(entry["data"]), np.dtype(f"<{entry['type']}")).tolist()


def book_of(id, forces=None):
    return cell_book(cells_at_rest(map_system(id), forces or Forces()), {}, id)


def kinds(found):
    return [Edge(wall.label, ">" if wall.directed else "") for wall in found.walls]


@pytest.mark.slow
@pytest.mark.parametrize("id", FLAT)
def test_a_book_holds_the_walls_points_and_cells_that_are_derived(id):
    book = book_of(id)
    maps = derive(map_system(id), book["steps"])
    assert book["steps"] > map_system(id).steps
    pages = zip(book["words"], book["maps"], book["counts"], strict=True)
    for found, points, (word, page, counts) in zip(maps, place_maps(maps), pages, strict=True):
        assert [book["states"][state][3] for state in whole(word)] == [*map(str, kinds(found))]
        assert [*zip(*[iter(whole(page["ends"]))] * 2, strict=True)] == [(wall.start, wall.end) for wall in found.walls]
        assert np.allclose(np.array(page["points"]).reshape(-1, 2), points, atol=1e-5)
        starts, corners = whole(page["starts"]), whole(page["corners"])
        assert [corners[a:b] for a, b in pairwise(starts)] == [found.corners(cell) for cell in found.cells]
        assert tuple(counts) == found.counts


@pytest.mark.slow
@pytest.mark.parametrize("id", FLAT)
def test_daughters_lie_on_their_mother_and_walls_without_one_divide_cells(id):
    book = book_of(id)
    maps = derive(map_system(id), book["steps"])
    for step, (before, after) in enumerate(pairwise(maps)):
        mothers = [mother for mother, many in enumerate(whole(book["daughters"][step])) for _ in range(many)]
        made = [rule if rule >= 0 else None for rule in whole(book["made"][step])]
        for wall, mother in zip(after.walls, mothers, strict=False):
            ends = {before.walls[mother].start, before.walls[mother].end}
            for point in (wall.start, wall.end):
                assert point in ends or set(after.vertices[point].between) == ends
        for wall, rule in zip(kinds(before), made, strict=True):
            assert rule is None or map_system(id).productions[rule].predecessor == wall
        assert len(after.walls) - len(mothers) == len(after.cells) - len(before.cells)


@pytest.mark.parametrize("id", FLAT)
def test_tokens_move_as_the_stage_diagram_says_but_for_walls_that_divide_cells(id):
    made = map_system(id)
    net = wall_stages(made)
    numbers = {place.symbol: number for number, place in enumerate(net.places)}
    maps = derive(made, 4)
    divided = 0
    for before, after in pairwise(maps):
        counts = Counter(numbers[wall.label] for wall in before.walls)
        moved = Counter({place: count for place, count in counts.items() if place not in {t.place for t in net.transitions}})
        for arc in net.arcs:
            if not arc.factor:
                moved[arc.place] += arc.copies * counts[net.transitions[arc.transition].place]
        new = Counter(numbers[wall.label] for wall in after.walls)
        assert not moved - new
        assert new - moved == Counter(numbers[wall.label] for wall in after.walls[sum(moved.values()) :])
        assert {net.places[place].symbol for place in new - moved} <= {marker.edge.label for marker in made.markers}
        divided += (new - moved).total()
    assert divided == maps[-1].counts[2] - 1


def test_a_production_is_lit_from_its_first_letter_to_its_last():
    book, text = book_of("K30"), map_system("K30").source
    assert [text[slice(*each["at"])] for each in book["productions"]] == [
        "A> -> D>[-A>]B>",
        "B> -> B>",
        "C> -> B>[-A<]B>",
        "D> -> C>",
    ]


def test_walls_with_and_without_a_direction_are_different_states():
    made = read_map("map: A>BA<B\nA> -> B[-A]B\nA -> B")
    book = cell_book(cells_at_rest(made, Forces()), {})
    assert [text for *_, text in book["states"]] == ["A>", "B", "A"]
    assert [place["name"] for place in sorted(book["net"]["places"], key=lambda each: each["place"])] == ["A>", "B", "A"]
    assert kind_of(made.axiom[2]) == made.productions[0].predecessor


@pytest.mark.slow
def test_more_steps_than_can_come_to_rest_end_the_book_with_the_reason():
    made = read_map(DIVIDED.replace("steps: 2", "steps: 30"))
    with limits(seconds=1):
        found = cells_at_rest(made, Forces())
    assert 2 < found.last < 30
    assert "did not come to rest in 0.6 seconds" in found.end


def test_a_map_of_too_many_walls_ends_the_book_with_the_reason():
    with limits(modules=30):
        found = cells_at_rest(map_system("K28"), Forces())
    assert (found.last, found.end.split(";")[0]) == (3, "Step 4 would have 32 walls or more")


@pytest.mark.slow
def test_markers_that_never_match_are_told_in_the_panel():
    made = read_map("map: A<D<C<B<\nsteps: 3\nA> -> D>[-A>]B>\nC> -> B>[-A<]B>\nD> -> C>")
    book = cell_book(cells_at_rest(made, Forces()), {})
    assert book["said"].startswith("Markers of A never match up to step ")
    assert book_of("K30")["said"] == ""


@pytest.mark.slow
def test_a_book_says_where_relaxation_ends():
    book = cell_book(cells_at_rest(map_system("K29"), Forces(rest=1, pressure=0.01, damping=10)), {})
    assert [(page["iterations"], page["settled"]) for page in book["maps"][1:3]] == [(20_000, False)] * 2
    assert book["forces"] == {"stiffness": 1.0, "rest": 1, "pressure": 0.01, "damping": 10}
    assert all(page["settled"] for page in book_of("K29")["maps"])


@pytest.mark.slow
def test_no_label_is_left_out_because_a_turtle_knows_it():
    places = {place["letter"] for place in book_of("K32")["net"]["places"]}
    assert {"F", "f", "L", "n"} <= places


@pytest.mark.slow
def test_a_diagram_of_very_many_walls_is_a_sentence():
    axiom = "".join(f"A{number}" for number in range(70))
    book = cell_book(cells_at_rest(read_map(f"map: {axiom}"), Forces()), {})
    assert book["net"]["description"].startswith("There is no stage diagram: It would have 70 walls")
    assert {place for _, _, place, _ in book["states"]} == {-1}


@pytest.mark.slow
def test_books_are_small():
    assert all(len(json.dumps(book_of(id))) < 50_000 for id in FLAT)


@pytest.mark.slow
def test_forces_are_the_sliders_of_a_map():
    panel = explore("map-offset-walls", 3, pressure="3/10")
    assert [each["name"] for each in panel.model["constants"]] == ["stiffness", "rest", "pressure", "damping"]
    assert panel.settings == {"stiffness": "1", "rest": "0.1", "pressure": "0.3", "damping": "1"}
    before = panel.sight.picture.places[0]
    panel.pressure = 1
    assert np.ptp(panel.sight.picture.places[0]) > 1.2 * np.ptp(before)
    assert panel.text.startswith("Step 3: 26 vertices, 33 walls, 8 cells. ")


@pytest.mark.slow
def test_the_picture_that_is_kept_is_that_of_the_step():
    panel = explore("K28", 2)
    [points] = panel.sight.picture.places
    assert np.array_equal(points, [*place_maps(derive(map_system("K28"), 2))][2])
    kept = answered(panel, {"kind": "keep", "what": "svg"})
    assert kept["name"] == "K28.svg"
    assert kept["text"].count("<polygon") == 4
    assert panel._repr_mimebundle_()["image/svg+xml"] == kept["text"]


@pytest.mark.slow
def test_a_link_keeps_the_forces():
    panel = explore("K30", 5, pressure=0.5)
    again = explore(panel.link)
    assert (again.system, again.step, again.settings) == (map_system("K30"), 5, panel.settings)


@pytest.mark.slow
def test_a_map_is_explored_by_its_text_and_its_own_steps_are_shown_first():
    panel = explore(DIVIDED)
    assert (panel.system, panel.step) == (read_map(DIVIDED), 2)


@pytest.mark.parametrize(
    ("choices", "error", "message"),
    [
        ({"angle": 30}, ModelValueError, "A map has no angle"),
        ({"turgor": 3}, ModelNameError, 'A map has no "turgor"'),
        ({"pressure": 11}, ModelValueError, "must lie between 0.001 and 10"),
        ({"step": -1}, ModelValueError, "whole number"),
    ],
)
def test_settings_that_a_map_has_not_are_errors(choices, error, message):
    with pytest.raises(error, match=message):
        explore("K28", **choices)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("broken", "told"),
    [
        (DIVIDED.replace("]B", "B"), "is never closed"),
        (DIVIDED.replace("map:", "mp:"), "map"),
        (DIVIDED.replace("map: ABAB\n", ""), "There is no first cell"),
        (DIVIDED.replace("[-A][+A]", "[-A]"), "not|backwards"),
    ],
)
def test_broken_rules_of_a_map_stay_a_map_and_say_what_is_wrong(broken, told):
    panel = explore(DIVIDED, 1)
    with pytest.raises(LSystemError) as error:
        read_map(broken)
    assert answered(panel, {"kind": "rules", "text": broken})["mistake"]["message"] == error.value.message
    assert panel.system == read_map(DIVIDED)


def test_rules_typed_in_the_editor_may_be_of_the_other_kind():
    panel = explore("J1", 4)
    assert answered(panel, {"kind": "rules", "text": DIVIDED})["state"]["model"]["book"]["mode"] == "map"
    assert panel.system == read_map(DIVIDED)
    assert answered(panel, {"kind": "rules", "text": "axiom: F\nF -> F+F"})["state"]["model"]["book"]["mode"] == "plane"
    assert answered(panel, {"kind": "variants"})["variants"]


@pytest.mark.slow
def test_a_link_of_a_map_may_be_put_in_place_of_rules():
    panel = explore("J1", 4)
    answered(panel, {"kind": "rules", "text": explore(DIVIDED).link})
    assert panel.model["book"]["counts"][1] == (6, 7, 2)
    assert "mistake" in answered(panel, {"kind": "rules", "text": "map: AB"})


def test_a_map_has_no_variants():
    assert answered(explore("K28", 0), {"kind": "variants"})["variants"] == []


def test_an_l_system_is_still_an_l_system():
    assert explore("J1", 2).system == system("J1")
