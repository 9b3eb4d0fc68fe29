"""A symbol has one colour in all views of its system: word, filament, lineage, stage diagram and drawing."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, draw, lineage, read, stages, system
from lsys_kit.classroom.panel.word_view import word_html
from lsys_kit.pictures.draw import state_colours
from lsys_kit.pictures.formats.svg import svg as written
from lsys_kit.pictures.lineages import tree_of
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.style.labels import html_label
from lsys_kit.pictures.style.palette import SERIES, colour_of, colours

FILAMENTS = ("J1", "J4", "P1", "P2", "P3", "P4", "P5", "P6", "K27")
PLANTS = ("K2", "K5", "K7", "K19", "L1", "L4")
NAMES = st.lists(st.sampled_from(["A", "B", "Xl", "Xr", "a_1", "F", "0", "1"]), min_size=1, max_size=4, unique=True)


def in_the_word(word):
    """For each symbol the colours below its modules in the panel."""
    found = {}
    for module in {word.states.modules[state] for state in word.numbers()}:
        label = re.escape(html_label(module, word.states.system))
        for colour in re.findall(rf"border-bottom:2px solid (#\w+);[^>]*>{label}</span>", word_html(word)):
            found.setdefault(module.symbol, set()).add(colour)
    return found


def in_the_diagram(model):
    """For each symbol the colours of the circles of its stages."""
    net, found = stages(model), {}
    svg = written(drawn_stages(net))
    for number, place in enumerate(net.places):
        for circle in re.findall(rf'data-place="{number}".*?<circle [^>]*stroke="(#\w+)"', svg, re.DOTALL):
            found.setdefault(place.symbol, set()).add(circle)
    return found


@pytest.mark.parametrize("id", [*FILAMENTS, *PLANTS])
def test_a_symbol_has_the_same_colour_in_word_diagram_and_drawing(id):
    model = system(id)
    word = derive(model, 4, seed=1)[-1]
    drawn = {}
    for state, colour in state_colours(word).items():
        drawn.setdefault(word.states.modules[state].symbol, set()).add(colour)
    assert all(len(found) == 1 for found in drawn.values())
    shown = in_the_word(word)
    assert shown
    assert {symbol: drawn[symbol] for symbol in shown} == shown
    if not model.productions[0].probability:
        diagram = {symbol: found for symbol, found in in_the_diagram(model).items() if symbol in colours(model)}
        assert {symbol: drawn.get(symbol, found) for symbol, found in diagram.items()} == diagram


@pytest.mark.parametrize("id", FILAMENTS)
def test_a_lineage_has_the_colours_of_the_filament(id):
    tree = lineage(system(id), 5)
    filament, laid_out = state_colours(tree.last), tree_of(tree)
    for number, cell in enumerate(tree.cells):
        assert laid_out.kinds[laid_out.kind_of[number]].colour == colour_of(cell.at_birth.symbol, system(id))
    for number, state in zip(tree.words[-1], tree.last.numbers(), strict=True):
        assert laid_out.colours[number] == filament[state]


@pytest.mark.parametrize("id", FILAMENTS)
def test_kinds_of_cells_that_share_a_colour_have_other_dashes(id):
    kinds = tree_of(lineage(system(id), 5)).kinds
    assert len({(kind.colour, kind.dash) for kind in kinds}) == len(kinds)


def test_m_is_green_in_the_filament_and_in_the_lineage():
    model = system("P5")
    for svg in (draw(model, 4).svg, draw(lineage(model, 4)).svg):
        assert {colour for colour in SERIES if colour in svg} == {colours(model)["M"]}


@given(NAMES)
def test_symbols_have_colours_of_their_own_and_polarities_share_theirs(names):
    found = colours(read(f"alphabet: {' '.join(names)}\naxiom: {' '.join(names)}"))
    bases = {name[:-1] if {"Xl", "Xr"} <= {*names} and name in ("Xl", "Xr") else name for name in names}
    assert len(set(found.values())) == len(bases)
