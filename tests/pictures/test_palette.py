"""Colours can be told apart by people with any kind of colour vision, and be seen on paper, light and dark.

Colour-blindness is simulated as by G. M. Machado, M. M. Oliveira and L. A. F. Fernandes ("A Physiologically-based Model for
Simulation of Color Vision Deficiency", IEEE TVCG 15 (6), 2009), without any of one kind of cones. The difference of two colours
is their distance in Oklab (B. Ottosson, 2020), times 100, in which a just noticeable difference is about 2; contrast is that of
WCAG 2.2.
"""

from __future__ import annotations

import re
from contextlib import suppress
from itertools import combinations

import numpy as np
import pytest

from lsys_kit import LSystemError, book_systems, derive, draw, lineage, plot, stages, system, systems
from lsys_kit.classroom.panel.bundle import style
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START
from lsys_kit.pictures.legends import MOST_WITHOUT_LETTERS
from lsys_kit.pictures.lineages import DASHES, tree_of
from lsys_kit.pictures.nets.parts import parts_of
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.style.labels import polar_symbols, steering_of
from lsys_kit.pictures.style.palette import (
    CHOSEN,
    INK,
    LABELLED,
    NATURAL,
    PALEST,
    PAPER,
    RAMP,
    SERIES,
    STRONGEST,
    cell_fill,
    tinted,
)
from lsys_kit.pictures.style.themes import DARK, DARK_LINES, GROUNDS, LIGHT, drawn_on, line, theme_from
from lsys_kit.pictures.tissues.maps import FILLS as KINDS

VISION = {
    "all cones": np.eye(3),
    "protanopia": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
    "deuteranopia": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritanopia": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]),
}
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
CONES = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
OKLAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
DARK_PAPER, DARK_INK = DARK.paper, DARK.ink
FILLS = pytest.mark.parametrize("strength", [PALEST, LABELLED, STRONGEST])


def linear(colour):
    channels = np.frombuffer(bytes.fromhex(colour[1:]), np.uint8) / 255
    return np.where(channels <= 0.04045, channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4)


def contrast(one, other):
    less, more = sorted(float(linear(colour) @ LUMINANCE) for colour in (one, other))
    return (more + 0.05) / (less + 0.05)


def lab(colour, vision="all cones"):
    return 100 * OKLAB @ np.cbrt(CONES @ np.clip(VISION[vision] @ linear(colour), 0, 1))


def grey(colour):
    """The lightness of a colour where there is no colour."""
    return 100 * float(np.cbrt(linear(colour) @ LUMINANCE))


def least_difference(colours, vision="all cones"):
    return min(float(np.linalg.norm(lab(one, vision) - lab(other, vision))) for one, other in combinations(colours, 2))


def mixed(colour, paper, strength):
    pairs = zip(bytes.fromhex(colour[1:]), bytes.fromhex(paper[1:]), strict=True)
    return "#" + "".join(f"{round(there + strength * (here - there)):02x}" for here, there in pairs)


def test_black_and_white_differ_as_the_standards_say():
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert least_difference(["#000000", "#ffffff"]) == pytest.approx(100, abs=1e-3)
    assert least_difference(["#ff0000", "#00a000"], "deuteranopia") < least_difference(["#ff0000", "#00a000"]) / 2


def lines_on(theme, colours=SERIES):
    with drawn_on(theme):
        return [line(colour) for colour in colours]


THEMES = pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
EVERY_PAPER = pytest.mark.parametrize("theme", [*GROUNDS.values(), *map(theme_from, ("beige", "navy", "#777", "black"))])


@EVERY_PAPER
@pytest.mark.parametrize("colour", [*SERIES, *RAMP, *CHOSEN, "#808080"])
def test_lines_are_seen_on_every_paper(theme, colour):
    assert contrast(*lines_on(theme, [colour]), theme.paper) >= 3


@EVERY_PAPER
def test_text_is_legible_on_every_paper(theme):
    assert contrast(theme.ink, theme.paper) >= 4.5
    assert contrast(theme.quiet, theme.paper) >= 4.5


@THEMES
def test_what_is_marked_is_seen_and_legible(theme):
    assert contrast(theme.mark_edge, theme.paper) >= 3
    assert contrast(theme.ink, theme.mark) >= 4.5
    assert contrast(theme.quiet, theme.mark) >= 4.5


def test_lines_on_light_paper_have_the_colours_of_symbols():
    assert lines_on(LIGHT) == [*SERIES]


@THEMES
@pytest.mark.parametrize("vision", VISION)
def test_lines_of_any_two_symbols_can_be_told_apart(theme, vision):
    least = {LIGHT: {"all cones": 11.5}, DARK: {"all cones": 13}}[theme].get(vision, 7.3 if theme == LIGHT else 9.5)
    assert least_difference(lines_on(theme), vision) >= least


@THEMES
def test_what_two_lines_differ_too_little_in_grey_differs_in_dashes_or_has_a_letter(theme):
    greys = [grey(colour) for colour in lines_on(theme)]
    close = [pair for pair in combinations(range(len(SERIES)), 2) if abs(greys[pair[0]] - greys[pair[1]]) < 2]
    assert close == ([(0, 3)] if theme == LIGHT else [])
    assert all(DASHES[one % len(DASHES)] != DASHES[other % len(DASHES)] for one, other in close)
    assert all(max(pair) >= MOST_WITHOUT_LETTERS for pair in close)


@pytest.mark.parametrize("vision", VISION)
@pytest.mark.parametrize("paper", [PAPER, DARK_PAPER])
def test_kinds_of_cells_in_a_map_can_be_told_apart(paper, vision):
    assert least_difference([mixed(colour, paper, strength) for colour, strength in KINDS], vision) >= 2.8


def test_the_panel_has_the_same_themes():
    for theme in (LIGHT, DARK):
        assert f"--lsys-paper:{theme.paper.lower()};--lsys-ink:{theme.ink.lower()};--lsys-quiet" in style()
    assert all(f"{colour} {seen}".lower() in style() for colour, seen in DARK_LINES.items())


@FILLS
@pytest.mark.parametrize("vision", VISION)
@pytest.mark.parametrize("paper", [PAPER, DARK_PAPER])
def test_fills_of_any_two_symbols_can_be_told_apart(paper, vision, strength):
    assert least_difference([mixed(colour, paper, strength) for colour in SERIES], vision) >= 3.2


@THEMES
def test_a_ramp_gets_lighter_and_its_lines_are_seen(theme):
    ramp = lines_on(theme, RAMP)
    assert min(np.diff([grey(colour) for colour in ramp])) >= 1
    assert min(contrast(colour, theme.paper) for colour in ramp) >= 3
    assert CHOSEN[RAMP_START : RAMP_END + 1] == RAMP


@THEMES
@pytest.mark.parametrize("vision", VISION)
def test_bark_and_leaves_of_natural_plants_can_be_told_apart(theme, vision):
    bark, *_, leaf = lines_on(theme, RAMP)
    assert least_difference([bark, leaf, *lines_on(theme, [NATURAL["petal"], NATURAL["fruit"]])], vision) >= 6


@FILLS
def test_three_symbols_differ_in_grey_too(strength):
    greys = sorted(grey(tinted(colour, strength)) for colour in SERIES[:3])
    assert min(np.diff(greys)) >= 2


@pytest.mark.parametrize("colour", SERIES)
@pytest.mark.parametrize("strength", [PALEST, LABELLED])
def test_labels_are_legible_on_fills(colour, strength):
    assert contrast(INK, tinted(colour, strength)) >= 4.5
    assert contrast(DARK_INK, mixed(colour, DARK_PAPER, strength)) >= 4.5


@pytest.mark.parametrize("colour", SERIES)
def test_a_cell_that_gets_older_gets_darker(colour):
    greys = [grey(cell_fill(colour, age)) for age in (0, 0.25, 0.5, 0.75, 1)]
    assert greys == sorted(greys, reverse=True)


@pytest.mark.slow
@pytest.mark.parametrize("id", ["J1", "J4", "P1", "P5", "K12", "K19"])
def test_the_circles_of_a_stage_diagram_are_filled_so_that_they_can_be_told_apart(id):
    net = stages(system(id))
    strengths = [part.strength for part in parts_of(net, False, steering_of(net.system)).places]
    assert PALEST <= min(strengths) <= max(strengths) <= LABELLED


@pytest.mark.slow
@pytest.mark.parametrize("id", [*systems(), *book_systems()])
def test_a_symbol_has_one_colour_in_drawing_net_plot_and_lineage(id: str) -> None:
    derivation = derive(system(id), min(system(id).steps or 3, 3))
    made_by, picture, net = derivation.states.system, draw(derivation), stages(system(id))
    assert isinstance(picture, Picture)
    found = [(net.places[part.place].symbol, part.colour) for part in parts_of(net, False, steering_of(made_by)).places]
    found += [(module.symbol, picture.colour_of[state]) for state, module in enumerate(derivation.states.modules)]
    labels = [(re.findall(r"mathit\{(\w+)\}", curve.label), curve.colour) for curve in plot(derivation).chart.curves]
    found += [(names[0], colour) for names, colour in labels if names]
    with suppress(LSystemError):  # cells may be too many, or have several mothers
        tree = tree_of(lineage(derivation))
        found += [(tree.lineage.cells[cell].at_birth.symbol, tree.kinds[kind].colour) for cell, kind in tree.kind_of.items()]
    letters: dict[str, set[str]] = {}
    for symbol, colour in found:
        if symbol[0].isalnum():
            letters.setdefault(polar_symbols(made_by).get(symbol, (symbol, ""))[0], set()).add(colour)
    assert {letter: colours for letter, colours in letters.items() if len(colours) > 1} == {}
