"""Whether the engine is as fast, and as sparing, as it sets out to be: one benchmark for each goal, and a table of them all.

With `--benchmark-only` the sizes are those of the goals; without it each work is done once, on a small word. The floor is
numpy's copy of the word's bytes, timed between the rounds. The figures of cpfg and L-Py were given with the goals and are not
measured here: final modules a second, or modules visited where that is said.
"""

from __future__ import annotations

import itertools
import random
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
import pytest

from lsys_kit import ModelLimitError, derive, ensemble, growth, limits, read, system
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import lengths
from lsys_kit.derivation.engines.columnar import ColumnWord
from lsys_kit.notation.model.system import LSystem
from tests.benchmarks.test_engine import FIBONACCI, PLANT, TEN_RULES

P4, CHANCE = system("P4"), system("K7")
SIGNAL = read("axiom: b X\nb < a -> b\nX -> repeat(99999) <a>")
SHORT_SIGNAL = read("axiom: b X\nb < a -> b\nX -> repeat(1999) <a>")
HOGEWEG_HESPER = read("""
ignore: + - F
axiom: F i F i F i
o < o > o -> i
o < o > i -> i [- F i F i]
o < i > o -> i
o < i > i -> i
i < o > o -> o
i < o > i -> i F i
i < i > o -> i
i < i > i -> o
+ -> -
- -> +""")
ALL_DIFFERENT = read("axiom: A(1)\nA(x) -> A(.37*x+.1) A(.59*x+.2)")
RANDOM_TREE = read("axiom: A(1)\nA(s) -> F(s*uniform(.8,1)) [+A(s*uniform(.5,.9))] [-A(s*uniform(.5,.9))]")
DIFFUSION = "C(x) < C(y) > C(z) -> C(y + 0.1*(x+z-2*y))"
SHOOT = read("axiom: A(1)\nA(n) -> I(1+n/97,0) A(n+1)\nI(l,t) -> I(l*1.013,t+0.1)")
TENFOLD = read("axiom: F\nF -> FFFFFFFFFF")


@dataclass(frozen=True)
class Goal:
    """What a work is to reach: at least so many modules a second, or at most so much of another unit."""

    work: str
    limit: float
    unit: str = "modules a second"
    cpfg: float | None = None
    lpy: float | None = None

    def met(self, value: float) -> bool:
        return value >= self.limit if self.unit == "modules a second" else value <= self.limit


class Score:
    """The table: a line for each goal, printed when all is measured."""

    def __init__(self) -> None:
        self.lines = [("work", "kit", "goal", "", "times the copy", "cpfg", "L-Py")]

    def add(self, benchmark, goal: Goal, value: float, ratio: float | None = None) -> None:
        """A goal, what was measured, and how many times the floor that took."""
        figures = [f"{number:.2g}" if number else "-" for number in (ratio, goal.cpfg, goal.lpy)]
        met = "met" if goal.met(value) else "not met"
        self.lines.append((goal.work, f"{value:.3g} {goal.unit}", f"{goal.limit:g}", met, *figures))
        benchmark.extra_info |= {"goal": goal.limit, "value": value, "met": goal.met(value), "times the floor": ratio}

    def __str__(self) -> str:
        widths = [max(map(len, column)) for column in zip(*self.lines, strict=True)]
        return "\n".join("  ".join(map(str.ljust, line, widths)).rstrip() for line in self.lines)


@pytest.fixture(scope="module")
def score(request) -> Iterator[Score]:
    found = Score()
    yield found
    if request.config.option.benchmark_only:
        with request.config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
            print(f"\n\n{found}")


@pytest.fixture(autouse=True)
def room() -> Iterator[None]:
    with limits(modules=10**9, bytes=2**32, seconds=100):
        yield


def seconds_of(benchmark, work: Callable[[], object], between: Callable[[], object] = lambda: None, rounds: int = 9) -> float:
    """The median time of a work; something else is done between its rounds."""
    taken = []

    def timed():
        started = time.perf_counter()
        found = work()
        taken.append(time.perf_counter() - started)
        return found

    benchmark.pedantic(timed, setup=between, rounds=rounds, warmup_rounds=2)
    return statistics.median(taken[2:] or taken)


def array_of(word: Word) -> np.ndarray:
    """What a copy of the word copies at least."""
    if not isinstance(word, ColumnWord):
        return np.asarray(word.codes)
    return np.stack([parameter.numbers for parameter in word.parameters])


def compare(benchmark, score: Score, goal: Goal, work: Callable[[], Word], visits: int | None = None) -> None:
    """Time a derivation, and the copy of its word between the rounds."""
    word = work()
    array, copying = array_of(word), []

    def copy():
        started = time.perf_counter()
        array.copy()
        copying.append(time.perf_counter() - started)

    seconds = seconds_of(benchmark, work, copy)
    ratio = seconds / statistics.median(copying)
    score.add(benchmark, goal, (visits or len(word)) / seconds if goal.unit == "modules a second" else ratio, ratio)


def test_fibonacci(benchmark, score):
    """165,580,141 modules."""
    steps = 20 if benchmark.disabled else 39
    goal = Goal(f"Fibonacci, step {steps}", 2.5, "times the copy", 2.7e7, 1.7e6)
    compare(benchmark, score, goal, lambda: derive(FIBONACCI, steps)[-1])


def test_p4_with_exact_parameters(benchmark, score):
    wanted = 10_000 if benchmark.disabled else 11_000_000
    steps = next(step for step, length in enumerate(lengths(P4, 200)) if length >= wanted)
    goal = Goal(f"P4, exact, step {steps}", 1e9, cpfg=2.4e6, lpy=1.3e5)
    compare(benchmark, score, goal, lambda: derive(P4, steps)[-1])


def test_a_plant(benchmark, score):
    """24,414,061 modules."""
    steps = 5 if benchmark.disabled else 10
    goal = Goal(f"plant F -> F[+F]F[-F]F, step {steps}", 2e9, cpfg=1.8e8, lpy=1.7e7)
    compare(benchmark, score, goal, lambda: derive(PLANT, steps)[-1])


def test_a_signal_along_a_filament(benchmark, score):
    """The filament is made by the first step, which is not measured: what is known of a derivation is not computed again."""
    found, steps = (SHORT_SIGNAL, 5) if benchmark.disabled else (SIGNAL, 50)
    fresh = iter([derive(found, 1) for _ in range(14)])
    word = next(fresh).to(steps + 1)[-1]
    assert [module.symbol for module in word[: steps + 2]] == ["b"] * (steps + 1) + ["a"]
    goal = Goal(f"b < a -> b, {steps} steps (visits)", 8e7, cpfg=4e7, lpy=3.9e6)
    compare(benchmark, score, goal, lambda: next(fresh).to(steps + 1)[-1], visits=steps * len(word))


def test_signals_across_branches(benchmark, score):
    """Hogeweg and Hesper's system b: 1,087,735 modules."""
    steps = 26 if benchmark.disabled else 42
    goal = Goal(f"Hogeweg-Hesper b, step {steps}", 1.5e7, cpfg=7.1e6, lpy=7.0e5)
    compare(benchmark, score, goal, lambda: derive(HOGEWEG_HESPER, steps)[-1])


def test_a_plant_by_chance(benchmark, score):
    """Four plants one after another, because chance makes some larger than others."""
    steps = 4 if benchmark.disabled else 9
    plants = [derive(CHANCE, steps, seed=seed)[-1] for seed in range(4)]
    copying = statistics.median(copy_seconds(plants) for _ in range(9))
    seconds = seconds_of(benchmark, lambda: [derive(CHANCE, steps, seed=seed)[-1] for seed in range(4)])
    goal = Goal(f"plant by chance (K7), step {steps}", 5e7, lpy=5e6)
    score.add(benchmark, goal, sum(map(len, plants)) / seconds, seconds / copying)


def copy_seconds(words: list[Word]) -> float:
    arrays = [np.asarray(word.codes) for word in words]
    started = time.perf_counter()
    for array in arrays:
        array.copy()
    return time.perf_counter() - started


def test_modules_that_are_all_different(benchmark, score):
    """2^20 of them, in doubles."""
    steps = 10 if benchmark.disabled else 20
    goal = Goal(f"A(x) -> A(.37x+.1) A(.59x+.2), step {steps}", 1e8)
    compare(benchmark, score, goal, lambda: derive(ALL_DIFFERENT, steps, arithmetic="float")[-1])


def test_modules_that_are_all_different_and_exact(benchmark, score):
    """4,096 of them, with denominators of 24 digits."""
    steps = 8 if benchmark.disabled else 12
    goal = Goal(f"the same, exact, step {steps}", 5e5)
    compare(benchmark, score, goal, lambda: derive(ALL_DIFFERENT, steps)[-1])


@pytest.mark.parametrize("arithmetic", ["exact", "float"])
def test_a_tree_of_random_lengths(benchmark, score, arithmetic):
    """1,048,569 modules; a quarter of them are lengths that occur once."""
    steps = 7 if benchmark.disabled else 17
    goal = Goal(f"tree of random lengths, {arithmetic}, step {steps}", 1e7, cpfg=3.3e7)
    compare(benchmark, score, goal, lambda: derive(RANDOM_TREE, steps, arithmetic=arithmetic)[-1])


@pytest.mark.parametrize(("cells", "steps"), [(1_000, 200), (1_000, 2_000), (100_000, 100)])
def test_a_substance_that_spreads(benchmark, score, cells, steps):
    """Cells with a concentration each, none of which comes or goes; modules visited."""
    cells, steps = (60, 20) if benchmark.disabled else (cells, steps)
    chances = random.Random(1)
    row = " ".join(f"C({chances.random():.3f})" for _ in range(min(cells, 500)))
    found = read(f"axiom: X\nX -> repeat({max(1, cells // 500)}) <{row}>\n{DIFFUSION}")
    fresh = iter([derive(found, 1, arithmetic="float") for _ in range(14)])
    goal = Goal(f"diffusion, {cells:,} cells, {steps:,} steps (visits)", 1e7, cpfg=1.4e7)
    compare(benchmark, score, goal, lambda: next(fresh).to(steps + 1)[-1], visits=steps * cells)


def test_an_aged_shoot_is_not_much_slower_exact_than_in_doubles(benchmark, score):
    """80,000 internodes visited, no two of which are alike; exact values become doubles in their twelfth step."""
    steps = 40 if benchmark.disabled else 400
    derive(SHOOT, steps, arithmetic="float")
    in_doubles = statistics.median(seconds_to_derive(SHOOT, steps, "float") for _ in range(5))
    seconds = seconds_of(benchmark, lambda: derive(SHOOT, steps)[-1])
    score.add(benchmark, Goal(f"shoot of {steps} internodes, exact", 5, "times its doubles"), seconds / in_doubles)


def seconds_to_derive(found: LSystem, steps: int, arithmetic: str) -> float:
    started = time.perf_counter()
    derive(found, steps, arithmetic=arithmetic)
    return time.perf_counter() - started


def test_a_thousand_plants_by_chance(benchmark, score):
    """Plants of K7, each with its own seed, of which only the strokes are counted."""
    plants = 20 if benchmark.disabled else 1_000
    seconds = seconds_of(benchmark, lambda: ensemble(CHANCE, plants, "F", steps=5, progress=False))
    score.add(benchmark, Goal(f"{plants:,} plants of K7 counted, step 5", 1, "s"), seconds)


@pytest.mark.parametrize(("modules", "milliseconds"), [(100, 0.2), (1_000, 0.6), (3_000, 1)])
def test_all_steps_up_to_a_word_of(benchmark, score, modules, milliseconds):
    steps = next(step for step, length in enumerate(lengths(P4, 200)) if length >= modules)
    seconds = seconds_of(benchmark, lambda: list(derive(P4, steps)), rounds=200)
    score.add(benchmark, Goal(f"P4, all steps to {modules:,} modules", milliseconds, "ms"), 1_000 * seconds)


@pytest.mark.parametrize(("name", "found", "steps"), [("Fibonacci", FIBONACCI, 30), ("P4", P4, 90)])
def test_bytes_of_a_module(benchmark, score, name, found, steps):
    """A word takes what its states' numbers take; `limits` counts as much."""
    word = benchmark.pedantic(lambda: derive(found, steps)[-1])
    score.add(benchmark, Goal(f"{name}, memory", 6, "bytes a module"), word.codes.nbytes / len(word))


def test_reading_ten_rules(benchmark, score):
    """A model is read and its first step derived."""
    numbers = itertools.count()

    def work():
        return derive(read(f"{TEN_RULES}/* {next(numbers)} */\n"), 1)

    score.add(benchmark, Goal("ten rules read and ready", 5, "ms"), 1_000 * seconds_of(benchmark, work, rounds=50))


def test_changing_a_constant(benchmark, score):
    """A slider of a life span: nothing is parsed again."""
    found, values = read(TEN_RULES), itertools.cycle([2, 3])
    seconds = seconds_of(benchmark, lambda: derive(found, 1, lifeTimeA=next(values)), rounds=50)
    score.add(benchmark, Goal("another constant for ten rules", 1, "ms"), 1_000 * seconds)


def test_counting_fibonacci(benchmark, score):
    """A whole number of 2,090 digits, without a word."""
    steps = 100 if benchmark.disabled else 10_000
    seconds = seconds_of(benchmark, lambda: growth(FIBONACCI).length(steps))
    score.add(benchmark, Goal(f"Fibonacci counted, step {steps:,}", 9, "ms"), 1_000 * seconds)


def test_refusing_what_is_too_large(benchmark, score):
    """F -> FFFFFFFFFF at step 20: 10^20 modules."""

    def work():
        with suppress(ModelLimitError):
            derive(TENFOLD, 20)
            pytest.fail("a hundred trillion modules were promised")

    score.add(benchmark, Goal("a word too large refused", 10, "ms"), 1_000 * seconds_of(benchmark, work, rounds=50))
