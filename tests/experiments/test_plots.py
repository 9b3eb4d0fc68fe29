"""Plots show what was counted, and say it in a line; the golden ones were looked at.

After a change that is meant, they are written anew by `pytest tests/experiments --renew-pictures`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from matplotlib.figure import Figure

from lsys_kit import (
    LSystemError,
    Table,
    derive,
    ensemble,
    figure,
    growth,
    limits,
    map_system,
    plot,
    read,
    stages,
    sweep,
    system,
    timed,
)
from lsys_kit.pictures.plots.chart import Axis, CurveChart, GridChart, HistogramChart, Plot, ShareChart, class_edges, spread
from tests.endings import FLAT, beginnings
from tests.pictures.test_seed_figures import alike

GOLDEN = Path(__file__).parent / "golden"
WALK = system("K26")
SPANS = {"lifeTimeA": range(1, 7), "lifeTimeB": range(1, 7)}
PLOTS: Mapping[str, Callable[[], Plot]] = {
    "counts": lambda: plot(system("J1"), 12),
    "counts-log": lambda: plot(system("J4"), 20, log=True),
    "distribution": lambda: ensemble(system("K7"), 400, "F", steps=5).plot(),
    "extinction": lambda: ensemble(system("K8"), 300, "*", steps=9).plot(),
    "runs": lambda: ensemble(system("K8"), 60, "*", steps=range(10)).plot(),
    "phases": lambda: sweep(system("J4"), SPANS, "rate").plot(),
    "meta-rule": lambda: plot({"with the meta-rule": derive(WALK, 20, short=1), "without it": derive(WALK, 20, short=0)}),
    "continuity": lambda: plot({f"a = {a}": timed(system("P7"), a=a) for a in ("2.1673", 2, "2.4")}, 3),
    "stages": lambda: plot(stages(system("P2")), 20),
    "frequencies": lambda: plot(growth(system("P3"))),
    "map": lambda: plot(map_system("K28"), 6),
}
"""The plots that lessons show."""
ALGA = read("d = 2 in 1 .. 3\nk = 1\naxiom: A(1)\nA(t) : t < d -> A(t+1)\nA(t) -> A(1) A(1)")


def points(shown: Plot) -> list[tuple[tuple[float, float], ...]]:
    """The points of each curve."""
    assert isinstance(shown.chart, CurveChart)
    return [curve.points for curve in shown.chart.curves]


class TestGoldenPlots:
    @pytest.mark.slow
    @pytest.mark.parametrize("name", PLOTS)
    def test_a_plot_is_drawn_as_it_was(self, name: str, request: pytest.FixtureRequest) -> None:
        path, svg = GOLDEN / f"{name}.svg", PLOTS[name]().svg
        if request.config.getoption("--renew-pictures"):
            path.write_text(f"{svg}\n", encoding="utf-8")
        ElementTree.fromstring(svg)
        assert alike(svg, path.read_text(encoding="utf-8").rstrip("\n")), f"{path.name} looks different now"

    def test_every_golden_plot_belongs_to_one(self) -> None:
        assert {path.stem for path in GOLDEN.glob("*.svg")} == PLOTS.keys()

    def test_places_are_whole_tenths_of_a_pixel(self) -> None:
        paths = re.findall(r' d="([^"]*)"', PLOTS["counts"]().svg)
        assert paths
        assert not any("." in path for path in paths)


class TestCurves:
    def test_counts_are_those_of_the_words(self) -> None:
        shown = plot(system("J1"), 12)
        words = derive(system("J1"), 12)
        for curve, letter in zip(points(shown), "ab", strict=True):
            assert curve == tuple(
                (step, sum(n for symbol, n in word.counts().items() if symbol[0] == letter)) for step, word in enumerate(words)
            )
        assert repr(shown) == "2 curves (a, b) of modules, step n from 0 to 12, largest 233"

    def test_a_word_with_the_meta_rule_stays_short(self) -> None:
        with_rule, without = points(PLOTS["meta-rule"]())
        assert with_rule[-1] == (20, 3)
        assert without == tuple((step, 2 + step) for step in range(21))

    @pytest.mark.slow
    def test_with_the_right_base_the_length_of_a_filament_never_jumps(self) -> None:
        """P. Prusinkiewicz, Introduction to Modeling with L-systems, section 8: it is a^t."""
        right, small, large = points(PLOTS["continuity"]())
        assert all(length == pytest.approx(2.1673**time, rel=1e-4) for time, length in right)
        for wrong, sign in ((small, 1), (large, -1)):
            jumps = [after[1] - before[1] - 0.02 for before, after in pairwise(wrong)]
            assert max(sign * jump for jump in jumps) > 0.1

    def test_a_measure_is_plotted_over_the_steps(self) -> None:
        [widths] = points(plot(system("P8"), 4, "width"))
        assert [round(width, 2) for _, width in widths] == pytest.approx([1.7185**step for step in range(5)], abs=0.02)

    def test_many_kinds_of_modules_are_counted_together(self) -> None:
        many = read("axiom: A B C D E F G\nA -> A B")
        assert repr(plot(many, 2)) == "1 curve of modules, step n from 0 to 2, largest 9"

    def test_over_seeds_and_steps_the_mean_is_drawn_over_the_runs(self) -> None:
        table = ensemble(system("K8"), 20, "*", steps=range(4))
        *runs, mean = points(table.plot())
        assert len(runs) == 20
        for step in range(4):
            assert mean[step][1] == pytest.approx(sum(run[step][1] for run in runs) / 20)

    def test_a_constant_and_the_steps_give_a_curve_for_each_value(self) -> None:
        shown = sweep(ALGA, "d", "A", steps=range(5)).plot()
        assert repr(shown) == "3 curves (d = 1, d = 2, d = 3) of number of A, step n from 0 to 4, largest 16"
        assert points(sweep(ALGA, "d", "A", steps=4).plot()) == [((1, 16), (2, 4), (3, 2))]

    def test_a_map_has_its_cells_and_walls(self) -> None:
        walls, cells = points(plot(map_system("K28"), 3))
        assert [count for _, count in cells] == [1, 2, 4, 8]
        assert walls[0] == (0, 4)

    def test_labels_keep_their_distance(self) -> None:
        places = spread([5.0, 5.0, 5.0, 100.0], 18)
        assert min(b - a for a, b in pairwise(places)) == 18
        assert sum(places[:3]) == 15


class TestOtherCharts:
    def test_each_run_stands_in_one_bar(self) -> None:
        edges = class_edges([0.0, 0.1, 0.30000000000000004, 2.0])
        assert edges[0] <= 0
        assert edges[-1] > 2
        assert len(class_edges([7.0])) == 2
        assert len(class_edges(range(1_000))) <= 26

    def test_the_distribution_says_its_mean(self) -> None:
        shown = Table(("seed", "step", "F"), tuple((seed, 1, value) for seed, value in enumerate((3, 3, 9))), 2).plot()
        assert isinstance(shown.chart, HistogramChart)
        assert repr(shown) == "3 runs, number of F: least 3, mean 5, greatest 9"
        assert ">mean 5<" in shown.svg

    def test_swapped_life_spans_have_the_same_colour(self) -> None:
        grid = PLOTS["phases"]().chart
        assert isinstance(grid, GridChart)
        assert len(grid.values) == 36
        assert all(grid.values[a, b] == pytest.approx(grid.values[b, a]) for a, b in grid.values)

    @pytest.mark.slow
    def test_numbers_leave_a_grid_that_is_too_fine(self) -> None:
        rows = tuple((a, b, 5, a * b) for a in range(40) for b in range(30))
        svg = Table(("a", "b", "step", "F"), rows, 3).plot().svg
        assert svg.count("<text") < 80

    def test_seeds_are_averaged_in_a_grid(self) -> None:
        rows = tuple((a, b, seed, 5, 10 * a + seed) for a in range(2) for b in range(2) for seed in range(3))
        grid = Table(("a", "b", "seed", "step", "F"), rows, 4).plot().chart
        assert isinstance(grid, GridChart)
        assert grid.values == {(a, b): 10 * a + 1 for a in range(2) for b in range(2)}

    def test_stages_are_shown_with_their_share_of_all_modules(self) -> None:
        word = derive(system("P2"), 20)[-1]
        net = stages(system("P2"))
        chart = plot(net, 20).chart
        assert isinstance(chart, ShareChart)
        assert [share.share for share in chart.shares] == pytest.approx([n / len(word) for n in net.tokens(word)])

    def test_frequencies_in_the_long_run_are_those_of_the_growth(self) -> None:
        found = growth(system("P3"))
        chart = plot(found).chart
        assert isinstance(chart, ShareChart)
        assert tuple(share.share for share in chart.shares) == pytest.approx(found.frequencies)


class TestRefusals:
    @pytest.mark.parametrize(
        ("ask", "said"),
        [
            (lambda: plot("J1"), "can be plotted, not str"),
            (lambda: plot({}), "nothing to plot"),
            (lambda: plot({str(n): ALGA for n in range(9)}), "cannot be told apart"),
            (lambda: plot({"a": ALGA, "b": ALGA}, 3, ["A", "modules"]), "one thing is measured"),
            (lambda: plot({"a": ALGA, "b": timed(system("P7"))}, 3), "do not stand along one axis"),
            (lambda: plot(derive(ALGA, 3), 4), "chosen already"),
            (lambda: plot(timed(system("P7")), 3, dt=1), "when it is made"),
            (lambda: plot(timed(system("P7")), -1), "above 0"),
            (lambda: plot(timed(system("P7")), "n"), "above 0"),
            (lambda: plot(ALGA, 10**6), "at most 5,000 steps"),
            (lambda: plot(ALGA, 2, lambda _: 10**400), "too great to plot"),
            (lambda: plot(ALGA, 3, log=1), "True or False"),
            (lambda: plot(stages(ALGA), 3, "A"), "nothing else is measured"),
            (lambda: plot(growth(ALGA), 3), 'no choice "n"'),
            (lambda: plot(stages(ALGA), d=3), 'no choice "d"'),
            (lambda: plot(growth(read("axiom: A\nA -> B B\nB -> A"))), "do not settle"),
            (lambda: plot(stages(read("axiom: A\nA -> *")), 3), "no module at step 3"),
            (lambda: plot(map_system("K28"), 2, "cells"), "nothing else is measured"),
            (lambda: plot(map_system("K28"), 2, d=1), "no constants"),
            (lambda: ensemble(ALGA, 1).plot(), "Only one setting"),
            (lambda: ensemble(ALGA, 2).plot("seed"), "varied, not measured"),
            (lambda: plot(ensemble(ALGA, 2), 3), 'no choice "n"'),
            (lambda: sweep(ALGA, {"d": [1, 2], "k": [1, 2]}, steps=[1, 2]).plot(), r"table\.where\(step = 1\)"),
            (lambda: sweep(ALGA, {"d": range(1, 20)}, steps=range(3)).plot(), "cannot be told apart"),
            (lambda: figure(plot(ALGA, 2), n=3), "chosen when it is made"),
        ],
    )
    def test_what_cannot_be_plotted_is_explained(self, ask: Callable[[], Any], said: str) -> None:
        with limits(seconds=60), pytest.raises(LSystemError, match=said):
            ask()


class TestFormats:
    def test_files(self, tmp_path: Path) -> None:
        shown = plot(system("J1"), 6)
        for ending, beginning in beginnings(*FLAT):
            shown.save(tmp_path / f"plot{ending}")
            shown.save(tmp_path / f"plot{ending}")  # what the kit has made it replaces
            assert (tmp_path / f"plot{ending}").read_bytes().startswith(beginning)

    def test_a_plot_goes_into_a_figure(self) -> None:
        left, right = Figure().subplots(1, 2)
        assert figure(plot(system("J1"), 6), left) is left
        assert len(left.lines) == 2
        assert figure(plot(system("J1"), 6)).figure is not right.figure

    @pytest.mark.parametrize("name", ["<b>", "$x_", "a\nb", "x" * 500, "\ud800", "$"])
    def test_a_name_is_no_markup_and_no_formula(self, name: str) -> None:
        shown = plot({name: ALGA, "b": ALGA}, 2)
        ElementTree.fromstring(shown.svg)
        assert "<b>" not in shown.svg
        assert shown.png.startswith(b"\x89PNG")

    def test_a_logarithmic_axis_leaves_zeros_out(self) -> None:
        shown = plot(system("J1"), 8, log=True)
        assert min(y for curve in points(shown) for _, y in curve) == 0
        assert isinstance(shown.chart, CurveChart)
        assert shown.chart.up == Axis("modules", True, True)
        ElementTree.fromstring(shown.svg)


@pytest.mark.slow
@pytest.mark.parametrize("a", [2, 3])
@pytest.mark.parametrize("end", ["2", "1.999", "2.1"])
def test_a_curve_over_time_jumps_upright_at_each_division_by_the_whole_jump(a, end):
    """Before it the mother is a long, and after it the daughters are 1 and a^0.2 long; the second division is at 1.8."""
    points = plot(timed(system("P7"), a=a), end).chart.curves[0].points
    for time, others in ((1, 0), (1.8, a**0.8)):
        assert [y for x, y in points if x == time] == pytest.approx([others + a, others + 1 + a**0.2])
    assert [x for x, _ in points] == sorted(x for x, _ in points)


@pytest.mark.parametrize(("end", "largest"), [(2, 3 + 3**0.2 + 3**0.4), (1, 3)])
def test_the_largest_value_of_a_curve_over_time_is_that_just_before_a_division(end, largest):
    assert repr(plot({"a = 3": timed(system("P7"), a=3)}, end)).endswith(f"largest {largest:.6g}")
