"""Plots on any paper, with numbers along logarithmic axes, and in somebody's own figure."""

from __future__ import annotations

import pytest
from matplotlib.figure import Figure

from lsys_kit import ensemble, figure, growth, plot, read, stages, sweep, system
from lsys_kit.pictures.style.colour_values import contrast
from lsys_kit.pictures.style.themes import DARK, LIGHT

DARK_PLOTS = {
    "curves": lambda: plot(system("J1"), 8, background="dark"),
    "shares": lambda: plot(growth(system("P3")), background="dark"),
    "stages": lambda: plot(stages(system("P2")), 20, background="dark"),
    "histogram": lambda: ensemble(system("K7"), 30, "F", steps=3).plot(background="dark"),
    "grid": lambda: sweep(system("J4"), {"lifeTimeA": (1, 2), "lifeTimeB": (1, 2)}, "rate").plot(background="dark"),
}


@pytest.mark.parametrize("kind", DARK_PLOTS)
def test_on_dark_paper_nothing_is_left_of_light_paper(kind):
    svg = DARK_PLOTS[kind]().svg.lower()
    assert DARK.paper.lower() in svg
    assert not [colour for colour in (LIGHT.paper, LIGHT.ink, LIGHT.quiet) if colour.lower() in svg]


def test_without_paper_there_is_none():
    svg = plot(system("J1"), 8, background="none").svg.lower()
    assert LIGHT.paper.lower() not in svg


@pytest.mark.parametrize(
    ("rules", "n"), [("A -> A A", 1), ("A -> A A", 3), ("A -> A A", 9), ("A -> A A", 20), ("A -> A", 5), ("A -> AAAAAAA", 7)]
)
def test_a_logarithmic_axis_has_numbers(rules, n):
    ax = figure(plot(read(f"axiom: A\n{rules}"), n, log=True))
    low, high = ax.get_ylim()
    ticks = [tick for tick in ax.get_yticks() if low <= tick <= high]
    assert (2 if rules != "A -> A" else 1) <= len(ticks) <= 11
    assert all(tick == int(tick) for tick in ticks), "modules are counted"


def test_in_a_figure_title_labels_and_letters_are_its_own():
    left, right = Figure(figsize=(8, 4)).subplots(1, 2)
    left.set_title("mine")
    before = left.yaxis.get_ticklabels()[0].get_fontsize()
    figure(plot(system("J1"), 8), left)
    figure(plot(growth(system("P3"))), right)
    assert (left.get_title(), left.get_ylabel(), right.get_xlabel()) == ("mine", "modules", "share in the long run")
    assert left.yaxis.get_ticklabels()[0].get_fontsize() == before
    assert len(left.get_legend_handles_labels()[1]) == 2
    left.figure.draw_without_rendering()
    inside, around = left.get_legend().get_window_extent(), left.get_window_extent()
    assert around.x0 <= inside.x0
    assert inside.x1 <= around.x1
    assert around.y0 <= inside.y0
    assert inside.y1 <= around.y1


def test_numbers_in_a_grid_can_be_read_on_any_paper():
    from matplotlib.colors import to_hex

    for background, theme in (("light", LIGHT), ("dark", DARK)):
        ax = figure(
            sweep(system("J4"), {"lifeTimeA": range(1, 7), "lifeTimeB": range(1, 7)}, "rate").plot(background=background)
        )
        fills = [to_hex(patch.get_facecolor()) for patch in ax.patches]
        for fill, text in zip(fills, ax.texts, strict=False):
            assert contrast(fill, to_hex(text.get_color())) >= 3.5, theme.paper
