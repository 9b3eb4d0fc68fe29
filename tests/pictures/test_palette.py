"""Colours can be told apart by people with any kind of colour vision, and be seen on paper, light and dark.

Colour-blindness is simulated as by G. M. Machado, M. M. Oliveira and L. A. F. Fernandes ("A Physiologically-based Model for
Simulation of Color Vision Deficiency", IEEE TVCG 15 (6), 2009), without any of one kind of cones. The difference of two colours
is their distance in Oklab (B. Ottosson, 2020), times 100, in which a just noticeable difference is about 2; contrast is that of
WCAG 2.2.
"""

from __future__ import annotations

import re
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

import lsys_kit.classroom.panel
from lsys_kit import stages, system
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START
from lsys_kit.pictures.nets.parts import parts_of, steering_of
from lsys_kit.pictures.style.palette import (
    CHOSEN,
    INK,
    LABELLED,
    MARK_EDGE,
    PALEST,
    PAPER,
    QUIET,
    RAMP,
    SERIES,
    STRONGEST,
    cell_fill,
    tinted,
)

VISION = {
    "all cones": np.eye(3),
    "protanopia": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                            [-0.003882, -0.048116, 1.051998]]),
    "deuteranopia": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                              [-0.011820, 0.042940, 0.968881]]),
    "tritanopia": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
                            [0.004733, 0.691367, 0.303900]]),
}
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
CONES = np.array([[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566],
                  [0.0883024619, 0.2817188376, 0.6299787005]])
OKLAB = np.array([[0.2104542553, 0.7936177850, -0.0040720468], [1.9779984951, -2.4285922050, 0.4505937099],
                  [0.0259040371, 0.7827717662, -0.8086757660]])
STYLE = (Path(lsys_kit.classroom.panel.__file__).parent / "scripts" / "colours.css").read_text(encoding="utf-8")
(DARK_PAPER, DARK_INK), *_ = re.findall(r"--lsys-paper: (#1\w{5}); --lsys-ink: (#\w{6})", STYLE)
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


@pytest.mark.parametrize("colour", [*SERIES, QUIET, MARK_EDGE])
def test_thin_lines_are_seen_on_paper(colour):
    assert contrast(colour, PAPER) >= 3


@pytest.mark.parametrize("vision", VISION)
def test_lines_of_any_two_symbols_can_be_told_apart(vision):
    assert least_difference(SERIES, vision) >= (11 if vision == "all cones" else 7)


@FILLS
@pytest.mark.parametrize("vision", VISION)
@pytest.mark.parametrize("paper", [PAPER, DARK_PAPER])
def test_fills_of_any_two_symbols_can_be_told_apart(paper, vision, strength):
    assert least_difference([mixed(colour, paper, strength) for colour in SERIES], vision) >= 3.2


def test_a_ramp_gets_lighter_and_its_lines_are_seen():
    lightness = [grey(colour) for colour in RAMP]
    assert min(np.diff(lightness)) >= 1
    assert min(contrast(colour, PAPER) for colour in RAMP) >= 3
    assert CHOSEN[RAMP_START:RAMP_END + 1] == RAMP


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


@pytest.mark.parametrize("id", ["J1", "J4", "P1", "P5", "K12", "K19"])
def test_the_circles_of_a_stage_diagram_are_filled_so_that_they_can_be_told_apart(id):
    net = stages(system(id))
    strengths = [part.strength for part in parts_of(net, False, steering_of(net.system)).places]
    assert PALEST <= min(strengths) <= max(strengths) <= LABELLED
