"""Plots on any paper, with numbers along logarithmic axes, and in somebody's own figure."""

from __future__ import annotations

from itertools import pairwise
from math import isnan

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from lsys_kit import derive, ensemble, figure, growth, plot, read, stages, sweep, system
from lsys_kit.pictures.plots.chart import Axis, Curve, CurveChart, Plot, RowsChart, spread
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


@given(st.lists(st.floats(0, 300), max_size=6), st.integers(0, 30))
def test_names_of_curves_stand_above_the_axis_apart_and_in_the_order_of_their_curves(ends, distance):
    places = spread(ends, distance, 0)
    order = sorted(range(len(ends)), key=ends.__getitem__)
    assert all(place >= 0 for place in places)
    assert all(places[b] - places[a] >= distance - 1e-9 for a, b in pairwise(order))


@pytest.mark.parametrize(
    ("rules", "names"),
    [
        ("axiom: A B\nA -> A A\nB -> B B", "A = B"),
        ("axiom: A B C\nA -> A A\nB -> B B", "A = B, C = 1"),
        ("axiom: A\nA -> A B\nB -> B B", "A = 1, B"),
        ("axiom: A B B\nA -> A A\nB -> B B", "A, B"),
        ("axiom: S\nS -> A B B\nB -> B B", "S, A, B"),
    ],
)
def test_curves_that_are_equal_are_drawn_once_and_named_together(rules, names):
    shown = plot(read(rules), 6)
    assert f"({names}) of modules" in repr(shown)
    ax = figure(shown)
    assert len(ax.lines) == names.count(",") + 1


def test_curves_that_differ_by_less_than_a_line_is_wide_are_one_and_others_are_not():
    steps = range(5)
    top = Curve(tuple((n, 100.0) for n in steps), "#000000", "T")
    for apart, lines in ((0.5, 1), (5, 2)):
        pair = [(n, n + 20, n + 20 + apart) for n in steps]
        low, high = (
            Curve(tuple((n, row[place]) for n, *row in pair), "#000000", f"${name}$") for place, name in enumerate("KL")
        )
        shown = Plot(CurveChart((top, low, high), Axis("n"), Axis("x")))
        assert repr(shown).startswith(f"{lines + 1} curves (T, {'K, L' if lines == 2 else 'K ≈ L'}) of x")
        assert len(figure(shown).lines) == lines + 1


def test_names_of_systems_that_are_equal_stand_with_a_comma():
    doubling = read("axiom: A\nA -> A A")
    assert "1 curve (this, that) of" in repr(plot({"this": doubling, "that": doubling}, 4))


@pytest.mark.parametrize(
    ("rule", "n", "steep"), [("A A A A", 2, True), ("A A A A", 1, False), ("A A A", 6, False), ("A A A A A", 4, True)]
)
def test_what_grows_fourfold_at_each_of_some_steps_is_on_a_logarithmic_scale_unless_it_is_refused(rule, n, steep):
    model = read(f"axiom: A\nA -> {rule}")
    assert ("logarithmic" in repr(plot(model, n))) == ("logarithmic" in plot(model, n).svg) == steep
    assert "logarithmic" not in repr(plot(model, n, log=False))
    assert "logarithmic" in repr(plot(model, n, log=True))


def test_what_is_negative_stands_on_no_logarithmic_scale_by_itself():
    model = read("axiom: A\nA -> A A A A A")
    assert "logarithmic" in repr(plot(model, 3, lambda run: 5 ** len(run)))
    assert "logarithmic" not in repr(plot(model, 3, lambda run: 5 ** len(run) if len(run) > 1 else -1))


def test_where_a_count_is_0_a_logarithmic_line_is_broken():
    ax = figure(plot(system("ABOP-1.19"), 2))
    assert [[isnan(y) for y in line.get_ydata()] for line in ax.lines] == [[False, True, False], *4 * [[True, False, False]]]


ROWS = {
    "one step": (lambda: plot(read("axiom: A\nA -> B B"), 1), ["1", "0", "0", "2", "0 to 1", "0 to 2"]),
    "no step": (lambda: plot(read("axiom: A A"), 0), ["2", "always 2"]),
    "constants": (lambda: plot(read("axiom: A B B\nA -> A"), 2), ["1", "1", "1", "2", "2", "2", "always 1", "always 2"]),
    "up and down": (lambda: plot(read("axiom: A B C\nA -> a\na -> A\nB -> b\nb -> B"), 5, ["A", "a", "B"]), ["0 to 1"] * 3),
}


@pytest.mark.parametrize("name", ROWS)
def test_what_curves_hardly_show_stands_in_rows_with_its_numbers(name):
    make, texts = ROWS[name]
    shown = make()
    assert isinstance(shown.chart, RowsChart)
    for text in texts:
        assert shown.svg.count(f">{text}<") >= texts.count(text)
    ax = figure(shown)
    assert len(ax.patches) == sum(len(curve.points) for curve in shown.chart.curves)
    assert all(label.get_text().endswith(tuple(texts)) and " " in label.get_text() for label in ax.get_yticklabels())
    assert "row" in repr(shown)


def test_many_steps_are_one_shape_and_a_scale_that_is_asked_for_has_curves():
    model = read("axiom: A B B")
    assert plot(model, 500).svg.count("<path") < 20
    assert isinstance(plot(model, 3, log=False).chart, CurveChart)
    assert isinstance(plot({"a": derive(model, 3), "b": derive(model, 2)}).chart, RowsChart)
