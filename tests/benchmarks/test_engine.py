"""How fast the engine is: at lesson size, where a slider waits for it, and far beyond.

Goals: a step of lesson size in well under a millisecond, the import of the kit in a quarter of a second.
"""

from __future__ import annotations

import subprocess
import sys

import pytest

from lsys_kit import derive, growth, read, stages, system

FIBONACCI = read("axiom: a\na -> ab\nb -> a")
PLANT = read("angle: 25.7\naxiom: F\nF -> F[+F]F[-F]F")
CELLS = read(
    "dt = 0.7\naxiom: A(0)\nA(t) : t+dt < 1 -> A(t+dt)\nA(t) -> B(t+dt-1) A(t+dt-0.8)\n"
    "B(t) : t+dt < 1 -> B(t+dt)\nB(t) -> A(t+dt-1)"
)
EVERY_MODULE_NEW = read("axiom: A(1)\nA(x) -> A(2*x) A(2*x+1)")
TEN_RULES = """
lifeTimeA = 3 in 1 .. 6
lifeTimeB = 2 in 1 .. 6
axiom: Al(1)
Al(lifeTimeA) -> Al(1) Br(1)
Ar(lifeTimeA) -> Bl(1) Ar(1)
Bl(lifeTimeB) -> Al(1) Br(1)
Br(lifeTimeB) -> Bl(1) Ar(1)
Al(i) : i < lifeTimeA -> Al(i+1)
Ar(i) : i < lifeTimeA -> Ar(i+1)
Bl(i) : i < lifeTimeB -> Bl(i+1)
Br(i) : i < lifeTimeB -> Br(i+1)
C(t) : t*2 + 1 >= 7 && t != 5 -> [+(30)F(t/3)C(t-1)][-(30)F(t/3)C(t-2)]
D -> ε
"""


def test_all_words_of_p4(benchmark):
    """The filament of Prusinkiewicz, L-system 4, up to 31 cells."""
    found = system("P4")
    assert len(benchmark(lambda: list(derive(found, 20)))[-1]) == 31


def test_the_last_word_of_p4(benchmark):
    """The same, with millions of cells."""
    found = system("P4")
    assert len(benchmark(lambda: derive(found, 97)[-1])) > 4_000_000


def test_derive_fibonacci_30(benchmark):
    """2,178,309 modules."""
    assert len(benchmark(lambda: derive(FIBONACCI, 30)[-1])) == 2_178_309


def test_derive_a_plant_8(benchmark):
    """390,625 segments, 976,561 modules."""
    assert len(benchmark(lambda: derive(PLANT, 8)[-1])) == 976_561


@pytest.mark.parametrize("modules", [100, 1_000, 3_000])
def test_all_steps_up_to_a_word_of(benchmark, modules):
    """What a slider of steps shows, from the first to the last."""
    steps = next(step for step, length in enumerate(derive(CELLS, 22).lengths) if length >= modules)
    assert len(benchmark(lambda: list(derive(CELLS, steps)))) == steps + 1


def test_derive_where_every_module_is_new(benchmark):
    """65,535 states, each worked out once."""
    assert len(benchmark(lambda: derive(EVERY_MODULE_NEW, 15)[-1])) == 32_768


@pytest.mark.parametrize("text", [TEN_RULES, "axiom: a\na -> ab\nb -> a"], ids=["ten rules", "two rules"])
def test_read(benchmark, text):
    """A model is read again at each key that is typed."""
    assert benchmark(lambda: read(text)).productions


@pytest.mark.parametrize("of", [stages, growth])
def test_the_net_and_the_growth_of_p4(benchmark, of):
    found = system("P4")
    assert benchmark(lambda: of(found))


@pytest.mark.parametrize("module", ["lsys_kit", "lsys_kit.derivation.derive"])
def test_import(benchmark, module):
    """A fresh Python that imports the kit, without the time that Python itself takes to start."""
    code = f"import time; t = time.perf_counter(); import {module}; print(time.perf_counter() - t)"

    def imported():
        return float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)

    imported()
    benchmark.extra_info["seconds"] = min(imported() for _ in range(5))
    assert benchmark.pedantic(imported, rounds=5) < 10


def test_numpy_sympy_and_matplotlib_are_loaded_when_they_are_used():
    code = "import sys, lsys_kit; lsys_kit.derive(lsys_kit.system('P4'), 5)[-1]; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "lsys_kit" in loaded
    assert "numpy" not in loaded
    assert not {"sympy", "matplotlib", "ipywidgets", "anywidget", "IPython"} & set(loaded)
