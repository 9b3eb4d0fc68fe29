"""How fast words are drawn.

Goal: at least 100,000 modules a second in space where each module is followed by itself.
"""

from __future__ import annotations

import pytest

from lsys_kit import derive, read
from lsys_kit.geometry.space import followed

BUSH = read("""
angle: 22.5
axiom: A
A -> [& F L ! A] / / / / / ' [& F L ! A] / / / / / / / ' [& F L ! A]
F -> S / / / / / F
S -> F L
L -> [' ' ' ^ ^ { - f + f + f - | - f + f + f }]""")
ALL_DIFFERENT = read("axiom: A(1)\nA(x) -> F(x) [+(x) A(.9*x+.2)] [&(2*x) A(.7*x+.31)]")


@pytest.mark.parametrize(("model", "steps"), [(BUSH, 6), (ALL_DIFFERENT, 11)], ids=["bush", "all modules different"])
def test_module_by_module_in_space(benchmark, model, steps):
    """The bush of The Algorithmic Beauty of Plants, figure 1.25, and a word in which hardly a module occurs twice."""
    word = derive(model, steps, arithmetic="float")[-1]
    scene = benchmark(lambda: followed(word))
    assert scene.dimension == 3
    assert len(scene.segments) > 1_000
    if benchmark.stats:
        benchmark.extra_info["modules a second"] = len(word) / benchmark.stats.stats.median
