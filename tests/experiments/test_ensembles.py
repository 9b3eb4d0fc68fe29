"""Ensembles and sweeps: tidy tables, the same whoever makes the runs, with what is finished kept."""

from __future__ import annotations

from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from fractions import Fraction
from itertools import count, product
from typing import Any

import pytest

from lsys_kit import (
    LSystemError,
    ModelLimitError,
    ModelNameError,
    ModelValueError,
    Table,
    derive,
    ensemble,
    growth,
    limits,
    read,
    stages,
    sweep,
    system,
)
from lsys_kit.derivation.derive import Derivation
from lsys_kit.experiments import making
from lsys_kit.geometry.drawing import scene_of

ALGA = read("d = 2 in 1 .. 3\nrate = 1/2\naxiom: A(1)\nA(t) : t < d -> A(t+1)\nA(t) -> A(1) A(1)")
PLANT = system("K7")
MODEL = "axiom: F\nF -> F[+F]F : 1/2\nF -> F : 1/2"


@pytest.fixture
def handed_out_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """All runs but the first are handed out, however fast the machine is."""
    monkeypatch.setattr(making, "FIRST_SECONDS", 0.0)
    monkeypatch.setattr(making, "FIRST_RUNS", 1)
    monkeypatch.setattr(making, "WORTH_SECONDS", 0.0)


def twigs(derivation: Derivation) -> int:
    """A measure of a person's own."""
    return str(derivation[-1]).count("[")


class TestLaws:
    def test_a_run_is_what_its_seed_gives(self) -> None:
        table = ensemble(PLANT, [3, 1, 4], ["modules", "F"], steps=[0, 2])
        assert table.columns == ("seed", "step", "modules", "F")
        assert table.rows == tuple(
            (seed, step, len(word), word.counts()["F"])
            for seed, step in product((3, 1, 4), (0, 2))
            for word in [derive(PLANT, step, seed=seed)[-1]]
        )

    @pytest.mark.slow
    def test_the_mean_number_of_strokes_is_that_of_the_model(self) -> None:
        """Kurth: E[F] is multiplied by 11/3 a step."""
        assert sum(ensemble(PLANT, 400, "F", steps=3)["F"]) / 400 == pytest.approx((11 / 3) ** 3, rel=0.03)

    @pytest.mark.slow
    def test_more_than_half_of_the_trees_die_out(self) -> None:
        """Kurth's tree whose branches may die: 1.3 buds of one bud on average."""
        assert ensemble(system("K8"), 300, "*", steps=9)["*"].count(0) == 157

    def test_swapped_life_spans_grow_at_the_same_rate(self) -> None:
        table = sweep(system("J4"), {"lifeTimeA": [2, 3], "lifeTimeB": [2, 3]}, "rate")
        (rates,) = (dict(zip(zip(table["lifeTimeA"], table["lifeTimeB"], strict=True), table["rate"], strict=True)),)
        assert rates[2, 3] == pytest.approx(rates[3, 2])
        assert rates[3, 2] == pytest.approx(growth(system("J4")).rate) == pytest.approx(1.3247, abs=1e-4)

    def test_every_combination_has_a_row(self) -> None:
        table = sweep(ALGA, {"d": [1, 3], "seed": [0, 5]}, "A", steps=range(3))
        assert [row[:3] for row in table.rows] == list(product((1, 3), (0, 5), range(3)))
        assert all(row[3] == 2 ** (row[2] // row[0]) for row in table.rows)

    def test_values_are_exact(self) -> None:
        table = sweep(system("P5"), {"dt": [0.7, "14/10", Fraction(1, 3)]}, "modules", steps=4)
        assert table["dt"] == (Fraction(7, 10), Fraction(7, 5), Fraction(1, 3))
        assert table.where(dt="0.7")["modules"] == (7,)  # with doubles it would be 5

    def test_a_declared_range_is_swept(self) -> None:
        assert sweep(ALGA, "d")["d"] == sweep(ALGA, ["d"])["d"] == (1, 2, 3)


class TestMeasures:
    def test_of_a_drawing(self) -> None:
        table = ensemble(PLANT, 2, ["strokes", "width", "height", "cells"], steps=3)
        for seed, _, strokes, width, height, cells in table.rows:
            scene = scene_of(derive(PLANT, 3, seed=seed))
            assert (strokes, width, height, cells) == (len(scene.segments), scene.width, scene.height, 0)

    def test_the_length_of_a_word_is_the_number_of_its_modules(self) -> None:
        table = sweep(system("J4"), {"lifeTimeA": [3]}, ["length", "modules", "cells"], steps=9)
        assert table.rows == ((3, 9, 9, 9, 9),)

    def test_a_letter_counts_both_polarities(self) -> None:
        [(_, _, both, right)] = sweep(system("J4"), {"lifeTimeA": [3]}, ["A", "Ar"], steps=10).rows
        counts = derive(system("J4"), 10)[-1].counts()
        assert (both, right) == (counts["Al"] + counts["Ar"], counts["Ar"])

    def test_a_function_is_asked_about_each_step(self) -> None:
        table = ensemble(read(MODEL), 2, {"twigs": twigs, "strokes drawn": "strokes"}, steps=(1, 3))
        assert table.measures == ("twigs", "strokes drawn")
        assert all(2 * row[2] + 1 == row[3] for row in table.rows)

    @pytest.mark.parametrize(
        ("measure", "said"),
        [
            ("hieght", 'Did you mean "height"'),
            ("Q", "Measures are: modules"),
            ([], "Nothing is measured"),
            (7, "A measure is a name"),
            ({"a": 7}, "must be a name or a function"),
            ({1: "F"}, "name of a measure is a text"),
            (["F", "F"], 'called "F"'),
            ({"seed": "F"}, 'called "seed"'),
            (lambda _: "many", "must give a number"),
            (lambda _: 1 / 0, "ZeroDivisionError"),
        ],
    )
    def test_a_wrong_measure_is_explained(self, measure: Any, said: str) -> None:
        with pytest.raises(LSystemError, match=said):
            ensemble(PLANT, 2, measure, steps=1)


class TestRefusals:
    @pytest.mark.parametrize(
        ("over", "said"),
        [
            ({"dd": [1]}, 'Did you mean "d"'),
            ("rate", "declares no range"),
            ({"d": 3}, 'values of "d" are needed'),
            ({"d": "12"}, 'values of "d" are needed'),
            ({"d": ["x"]}, "x"),
            (3, "Constants to vary"),
            ([3], "name of a constant"),
            ({"d": []}, "nothing to run"),
            ({"seed": ["1"]}, "whole number"),
            ({"d": count()}, "would take"),
        ],
    )
    def test_a_wrong_sweep_is_explained(self, over: Any, said: str) -> None:
        with limits(bytes=10_000), pytest.raises(LSystemError, match=said):
            sweep(ALGA, over)

    @pytest.mark.parametrize(
        ("given", "said"),
        [
            ({"seeds": -1}, "number of seeds"),
            ({"seeds": "12"}, "whole number"),
            ({"seeds": 0}, "nothing to run"),
            ({"seeds": 10**9}, "would take"),
            ({"seeds": count()}, "would take"),
            ({"seeds": [0.5]}, "whole number"),
            ({"steps": -1}, "The step"),
            ({"steps": []}, "one step"),
            ({"steps": "5"}, "whole number"),
            ({"seed": 3}, "is varied"),
            ({"executor": 2}, "concurrent.futures"),
            ({"progress": 1}, "True or False"),
            ({"q": 1}, "no constant 'q'"),
        ],
    )
    def test_a_wrong_ensemble_is_explained(self, given: dict[str, Any], said: str) -> None:
        with limits(bytes=100_000), pytest.raises(LSystemError, match=said):
            ensemble(PLANT, **{"seeds": 2, **given})

    def test_a_value_that_is_swept_cannot_be_given_as_well(self) -> None:
        with pytest.raises(ModelNameError, match="is varied"):
            sweep(ALGA, {"d": [1]}, d=2)

    def test_only_systems_are_run(self) -> None:
        with pytest.raises(ModelValueError, match="L-system is needed"):
            ensemble("K7", 3)  # type: ignore[arg-type]


@pytest.mark.usefixtures("handed_out_at_once")
class TestWhatIsFinished:
    def test_runs_that_pass_a_limit_are_left_out_and_named(self) -> None:
        with limits(modules=100):
            table = ensemble(PLANT, 20, "F", steps=3)
        lengths = {seed: len(derive(PLANT, 3, seed=seed)[-1]) for seed in range(20)}
        assert table["seed"] == tuple(seed for seed, length in lengths.items() if length <= 100)
        left_out = 20 - len(table)
        assert 0 < left_out < 20
        assert table.remarks[0] == f"{left_out} of 20 runs are left out:"
        assert "the limit is 100" in table.remarks[1]
        assert table.remarks[1] in repr(table)
        assert table.remarks[1] in table._repr_html_()

    def test_if_no_run_is_finished_the_error_says_why(self) -> None:
        with limits(modules=2), pytest.raises(ModelLimitError, match="more than 2 modules"):
            ensemble(PLANT, 3, steps=3)
        with pytest.raises(ModelValueError, match=r"zero"):
            sweep(read("p = 1\naxiom: A(1)\nA(x) -> A(x/p)"), {"p": [0]}, steps=1)

    def test_an_interrupt_keeps_what_is_finished(self) -> None:
        def interrupted(derivation: Derivation) -> int:
            if derivation[-1] == derive(PLANT, 2, seed=5)[-1]:
                raise KeyboardInterrupt
            return len(derivation[-1])

        table = ensemble(PLANT, [1, 2, 0, 5, 6, 7], interrupted, steps=2)
        assert table["seed"] == (1, 2, 0)
        assert table.remarks == ("Stopped: 3 of 6 runs are finished.",)

    def test_an_interrupt_calls_off_what_has_not_begun(self) -> None:
        executor = Interrupted()
        table = ensemble(PLANT, 64, twigs, steps=5, executor=executor)
        assert 0 < len(table) < 64
        assert "Stopped" in table.remarks[0]
        assert all(future.cancelled() for future in executor.futures[1:])

    def test_a_broken_executor_keeps_what_is_finished(self) -> None:
        table = ensemble(PLANT, 64, twigs, steps=5, executor=Broken())
        assert 0 < len(table) < 64
        assert "The executor broke (BrokenExecutor)" in repr(table)


class Interrupted(Executor):
    """An executor whose first piece of work is interrupted, while the others wait."""

    def __init__(self) -> None:
        self.futures: list[Future[Any]] = []

    def submit(self, *_: Any, **__: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = Future()
        if not self.futures:
            future.set_exception(KeyboardInterrupt())
        self.futures.append(future)
        return future


class Broken(Executor):
    """An executor that breaks at once."""

    def submit(self, *_: Any, **__: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = Future()
        future.set_exception(BrokenExecutor())
        return future


@pytest.mark.usefixtures("handed_out_at_once")
class TestWhoeverMakesTheRuns:
    def test_a_batch_takes_about_a_quarter_of_a_second(self) -> None:
        assert making.batch_size(100_000, 0.0026) * 0.0026 == pytest.approx(making.BATCH_SECONDS, rel=0.02)
        assert making.batch_size(3, 0.0) == 1

    def test_threads_make_the_same_table(self) -> None:
        with ThreadPoolExecutor(3) as executor:
            assert ensemble(PLANT, 60, ["F", twigs], steps=(3, 5), executor=executor) == ensemble(
                PLANT, 60, ["F", twigs], steps=(3, 5)
            )

    @pytest.mark.slow
    def test_processes_make_the_same_table(self) -> None:
        alone = ensemble(PLANT, 200, ["F", "height", twigs], steps=5)
        with ProcessPoolExecutor(2) as executor:
            assert ensemble(PLANT, 200, ["F", "height", twigs], steps=5, executor=executor) == alone

    @pytest.mark.slow
    def test_limits_hold_in_other_processes_too(self) -> None:
        with ProcessPoolExecutor(2) as executor:
            ensemble(PLANT, 100, "F", steps=4, executor=executor)  # its processes begin without the limit
            with limits(modules=700):
                one, other = ensemble(PLANT, 100, "F", steps=4), ensemble(PLANT, 100, "F", steps=4, executor=executor)
        assert one == other
        assert one.remarks


class TestTables:
    TABLE = Table(("seed", "p", "step", "F"), ((0, Fraction(1, 2), 3, 9), (1, Fraction(1, 2), 3, 25), (0, 1, 3, 1.25)), 3)

    def test_a_table_is_shown_as_text_and_as_html(self) -> None:
        assert repr(self.TABLE).splitlines()[0] == "seed    p  step     F"
        html = self.TABLE._repr_html_()
        assert html.count("<tr>") == 4
        assert '<th scope="col">step</th>' in html
        assert "3 rows" in html

    def test_a_long_table_is_cut_short(self) -> None:
        table = Table(("seed", "step", "F"), tuple((seed, 1, seed) for seed in range(1_234)), 2)
        assert len(repr(table).splitlines()) == 13
        assert repr(table).splitlines()[-1] == "1,234 rows"

    def test_names_are_no_markup(self) -> None:
        assert "<b>" not in Table(("seed", "<b>"), ((0, 1),), 1)._repr_html_()

    def test_rows_are_chosen_by_value(self) -> None:
        assert self.TABLE.where(p=0.5, seed=1)["F"] == (25,)
        with pytest.raises(ModelNameError, match='Did you mean "seed"'):
            self.TABLE.where(sed=1)

    def test_a_summary_describes_the_distribution_over_seeds(self) -> None:
        summary = self.TABLE.summary()
        assert summary.columns == ("p", "step", "runs", "mean", "sd", "least", "median", "greatest")
        assert summary.rows[0] == (Fraction(1, 2), 3, 2, 17, pytest.approx(128**0.5), 9, 17, 25)
        with pytest.raises(ModelNameError, match="was varied, not measured"):
            self.TABLE.summary("p")

    @pytest.mark.slow
    def test_views_of_other_libraries(self) -> None:
        frame = pytest.importorskip("pandas") and self.TABLE.to_pandas()
        assert frame["p"].tolist() == [0.5, 0.5, 1.0]
        pytest.importorskip("xarray")
        found = self.TABLE.to_xarray()
        assert float(found["F"].sel(seed=1, p=0.5, step=3)) == 25

    def test_a_library_that_is_missing_is_named(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setitem(__import__("sys").modules, "pandas", None)
        with pytest.raises(ModelValueError, match=r"pandas is not installed\. Install it"):
            self.TABLE.to_pandas()


@pytest.mark.parametrize(("id", "measure", "steps"), [("K7", "F", 4), ("K8", "*", 6), ("K7", "modules", 3)])
def test_the_exact_mean_is_that_of_the_stages_and_the_runs_are_near_it(id, measure, steps):
    found, net = ensemble(system(id), 300, measure, steps=steps), stages(system(id))
    counts = net.expected(steps)
    expected = sum(n for place, n in zip(net.places, counts, strict=True) if measure in (place.symbol, "modules"))
    assert found.exact == {(measure, steps): pytest.approx(float(expected))}
    deviation = found.summary()["sd"][0] / 300**0.5
    assert abs(found.summary()["mean"][0] - float(expected)) < 4 * deviation
    assert f"exactly {float(f'{float(expected):.4g}'):g}" in repr(found.plot()).replace(",", "")
    assert "19 times in 20" in found.plot().text


def test_no_exact_mean_is_told_where_it_is_not_known():
    assert ensemble(system("K7"), 3, "height", steps=2).exact == {}
    assert ensemble(system("K7"), 3, "F", steps=[1, 2]).exact == {}
    asks = read("axiom: F F\nF < F -> F[+F] : 1/2\nF < F -> F : 1/2")
    assert ensemble(asks, 3, "F", steps=2).exact == {}
    few = ensemble(system("K7"), 9, "F", steps=2).plot()
    assert "19 times" not in few.text
    assert "exactly" in few.text
