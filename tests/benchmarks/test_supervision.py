"""How much longer another library takes while it is supervised: in the main thread at most a tenth."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext

import sympy
from sympy.core.cache import clear_cache

from lsys_kit.budget import Task
from lsys_kit.supervision import supervised
from tests.timing import spent

MOST = 1.1
TIMES = 20


def seconds(block: Callable[[], AbstractContextManager[None]]) -> float:
    """How long the processor takes for a sum of fractions with three letters, in a block."""
    clear_cache()
    x, y, z = sympy.symbols("x y z")
    with Task(), spent() as time, block():
        sympy.factor(sympy.together(sum(1 / (x + k * y) + z**k for k in range(7))))
    return time.seconds


def test_what_is_supervised_takes_no_longer() -> None:
    """The shortest of several times, since whatever else the machine does makes some of them longer."""
    seconds(nullcontext)
    pairs = [(seconds(supervised), seconds(nullcontext)) for _ in range(TIMES)]
    watched, alone = (min(times) for times in zip(*pairs, strict=True))
    print(f"supervised {1000 * watched:.0f} ms, alone {1000 * alone:.0f} ms")
    assert watched < MOST * alone
