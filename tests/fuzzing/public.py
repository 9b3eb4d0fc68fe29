"""Whatever the public functions are given, they answer or explain what is wrong: calls made at random.

    python -m tests.fuzzing.public 8000              eight thousand calls, the same every time
    SEED=7 python -m tests.fuzzing.public 50000      other calls

Systems are those of the catalogue, and small ones with extreme numbers. Each is given to any of the public functions, with
arguments that fit, that are extreme, or that are of another type. Only the kit's own errors may come of it, or a `TypeError`
where Python itself says that an argument is missing or unknown; anything else ends the run with the call that did it.
"""

from __future__ import annotations

import contextlib
import os
import random
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import sympy

from lsys_kit.errors import shown
from tests.endings import BEGINNINGS

SECONDS = 0.5
"""The limit of a call, in seconds of the processor."""
SLOWEST = 1.0
"""A call may take so many seconds longer."""
PARTS = (
    "A -> A A",
    "A(t) -> A(t+1) B",
    "A(t) : t > 3 -> B",
    "B < A -> B",
    "A > B -> [A]",
    "A -> B : 1/3",
    "A -> A : 0.5",
    "A(t) -> A(2*t)[+F(t)]",
    "B -> F[-A]A",
    "decomposition:",
    "interpretation:",
    "meta:",
    "A -> F",
    "B(x) -> F(x)R(1,1)",
    "A -> R(2,1)",
    "B -> L(1,2,3)",
    "A(x) -> F(x)",
    "ignore: + -",
    "depth: 1000",
    "angle: 1e308",
    "heading: -1e9",
    "seed: 5",
    "steps: 3",
    "c = 1e300",
    "c = 1/3",
    "d = c*c",
    "A -> repeat(3,i)<A(i)>",
    "A(x) -> A(x/0)",
    "A(x) -> A(log(x))",
    "A(x) -> A(x^x)",
    "A -> %",
    "A -> {.F.+F.}",
    "F(x) -> F(x*1e30)",
    "A(1) -> A(0)B(0)",
    "B(2) -> A(0)",
    "A(t) -> A(t+c)",
    "A ?P(0,0)",
    "A(t) : t>=1 -> B(t-1)",
    "a f(x) f(y) -> f(x+y)",
    "A(x) -> A(x-1)B(x)",
    "A -> ",
    "A -> B(normal(0,1))",
    "A -> @O(1e40)!(1e-40)F(1e40)",
    "A -> ~L;(3)F",
    "surface L: (0, 0) (1, 0) (1, 1)",
    "surface k: (0, 0) (1, 1, 1) (1, 0)",
)
"""Lines of models, put together at random."""
AXIOMS = (
    "A",
    "A(1)",
    "A(0)B(0)",
    "A B A",
    "A(1/3)B(2)[A(1)]",
    "F+F",
    "A(1e308)",
    "A(-1)",
    "f(1)f(2)A",
    "A(0) ?P(0,0)",
    "[[[A]]]",
    "]A[",
)
EXTREME: tuple[object, ...] = (
    0,
    1,
    -1,
    2,
    3,
    7,
    1e308,
    -1e308,
    1e-308,
    float("nan"),
    float("inf"),
    10**50,
    10**5000,
    -(10**5000),
    -(10**400),
    Fraction(1, 3),
    Fraction(10**400, 7),
    True,
    None,
    "",
    "a",
    "1/3",
    "1e400",
    "9" * 900,
    "x",
    "A",
    "\ud800",
    "a\x00b",
    b"x",
    (),
    [],
    {},
    object(),
    ...,
    int,
    np.int64(3),
    np.float64(0.5),
    np.array([1, 2]),
    np.nan,
    complex(1, 2),
    sympy.Symbol("x"),
    sympy.pi,
    sympy.oo,
    sympy.Rational(1, 3),
    sympy.nan,
    sympy.zoo,
    sympy.Symbol("x") < 1,
    sympy.Matrix([sympy.Symbol("x")]),
    range(3),
    {1, 2},
    "1.1",
    "J4",
    "P4",
    "2.1",
    "pdf",
    "ellipses",
    "float",
    "abop",
    "cpfg",
    "mathematica",
    [(0, 1)],
    [(1, "a")],
    -0.0,
)
"""Values for any argument."""
NAMES = (
    "steps",
    "n",
    "seed",
    "arithmetic",
    "angle",
    "marked",
    "cells",
    "tokens",
    "positions",
    "intervals",
    "iterations",
    "stiffness",
    "pressure",
    "view",
    "cell",
    "generation",
    "explode",
    "polarity",
    "durations",
    "seconds",
    "hint",
    "solution",
    "ax",
    "c",
    "d",
    "dt",
    "lifeTimeA",
    "measure",
    "executor",
    "file",
    "progress",
    "log",
    "over",
    "notation",
    "name",
    "x",
    "settings",
    "base",
)
"""Names of arguments, and of constants."""


def system_text(chance: random.Random) -> str:
    """A small system: an axiom and some lines."""
    lines, axiom = chance.choices(PARTS, k=chance.randint(0, 6)), f"axiom: {chance.choice(AXIOMS)}"
    return "\n".join([axiom, *lines] if chance.random() < 0.7 else [*lines, axiom])


@cache
def catalogue() -> tuple[Any, ...]:
    """All systems of the catalogue."""
    from lsys_kit import book_systems, cellwork_system, cellwork_systems, map_system, map_systems, system, systems

    flat = (*systems(), *book_systems())
    return (*map(system, flat), *map(map_system, map_systems()), *map(cellwork_system, cellwork_systems()))


def some_system(chance: random.Random) -> Any:
    """A system that can be read."""
    from lsys_kit import LSystemError, read

    if chance.random() < 0.3:
        return chance.choice(catalogue())
    while True:
        with contextlib.suppress(LSystemError):
            return read(system_text(chance))


def some_thing(chance: random.Random, folder: Path) -> Any:
    """What a public function may be given first: a system, or something made of it."""
    import lsys_kit as kit

    steps = chance.choice((0, 1, 2, 3, 5, 9))
    makers: tuple[Callable[[Any], Any], ...] = (
        lambda system: system,
        lambda system: system,
        lambda system: kit.derive(system, steps),
        lambda system: kit.derive(system, steps)[-1],
        lambda system: kit.stages(system),
        lambda system: kit.timed(system),
        lambda system: kit.lineage(system, steps),
        lambda system: kit.draw(system, steps),
        lambda system: kit.growth(system),
        lambda system: kit.total(system, getattr(system.axiom[0], "symbol", "F"), chance.choice((0, 1, 2))),
        lambda system: kit.write(system),
        lambda system: system_text(chance),
        lambda system: chance.choice(EXTREME),
        lambda system: kit.link(system),
        lambda system: kit.lineage(kit.timed(system), steps),
        lambda system: kit.stages(kit.timed(system)),
    )
    return chance.choice(makers)(some_system(chance))


FUNCTIONS = (
    "animate",
    "book_systems",
    "cellwork_system",
    "check",
    "closing_angles",
    "compare",
    "continuity",
    "derive",
    "distances",
    "draw",
    "draw_hierarchy",
    "ensemble",
    "exercises",
    "explain",
    "explore",
    "figure",
    "growth",
    "life_spans",
    "lineage",
    "link",
    "linked",
    "map_system",
    "map_systems",
    "plot",
    "pnml",
    "practice",
    "predict",
    "progress",
    "qr_code",
    "read",
    "read_cellwork",
    "read_map",
    "rule_finder",
    "score",
    "stages",
    "sweep",
    "system",
    "systems",
    "timed",
    "total",
    "variants",
    "vote",
    "with_surface",
    "worksheet",
    "write",
)
"""The public functions; `limits` is about each of them."""


def one_call(chance: random.Random, folder: Path, told: list[str]) -> None:
    """Call a public function, and use what comes of it; `told` gets what is called."""
    import lsys_kit as kit

    told[:] = ["the first argument"]
    first = some_thing(chance, folder)
    name = chance.choice(FUNCTIONS)
    others = [chance.choice((*range(12), *EXTREME)) for _ in range(chance.choice((0, 0, 1, 1, 2)))]
    named = {key: chance.choice(EXTREME) for key in chance.sample(NAMES, chance.choice((0, 0, 0, 1, 1, 2)))}
    model = getattr(first, "source", "") or getattr(getattr(getattr(first, "states", None), "system", None), "source", "")
    told[:] = [f"{name}({shown(first)}, *{shown(others)}, **{shown(named)})", str(model)]
    try:
        result = getattr(kit, name)(first, *others, **named)
    except TypeError as error:
        if wrong_call(error):
            return
        raise
    use(result, chance, folder, told)


def wrong_call(error: TypeError) -> bool:
    """Whether Python itself says that a call has wrong arguments: nothing of the function has run."""
    text = str(error)
    return any(
        said in text
        for said in (
            "unexpected keyword argument",
            "multiple values for",
            "required positional argument",
            "positional arguments but",
            "positional argument but",
            "required keyword-only",
        )
    )


METHODS = (
    "word",
    "length",
    "counts",
    "lengths",
    "counts_of",
    "recurrence_of",
    "expected",
    "tokens",
    "origins",
    "ancestors",
    "column",
    "sight",
    "to",
    "save",
    "coded",
    "summary",
    "where",
    "plot",
)
ATTRIBUTES = (
    "svg",
    "png",
    "mesh",
    "text",
    "gif",
    "lengths",
    "notes",
    "matrix",
    "recurrence",
    "characteristic",
    "polynomial",
    "generating_function",
    "closed_form",
    "rate",
    "frequencies",
    "counts",
    "divisions",
    "places",
)
"""What results offer."""


def use(result: Any, chance: random.Random, folder: Path, told: list[str]) -> None:
    """Look at a result in some ways: as a notebook shows it, its attributes, its methods, its saved files."""
    from lsys_kit import LSystemError

    told.append(f"shown: {type(result).__name__}")
    str(result), repr(result)
    for attribute in ATTRIBUTES:
        if chance.random() < 0.5 and hasattr(type(result), attribute):
            told.append(f".{attribute}")
            getattr(result, attribute)
    own = type(result).__module__.startswith("lsys_kit")  # matplotlib's axes have methods of the same names
    for method in METHODS if own else ():
        if chance.random() < 0.3 and callable(getattr(type(result), method, None)):
            value = chance.choice((*range(6), *EXTREME))
            if method == "save":
                value = folder / f"file{chance.choice((*BEGINNINGS, '.pnml', '.x', ''))}"
            told.append(f".{method}({shown(value)})")
            odd = method == "counts_of" or not isinstance(value, int | Path)  # it has a second argument
            with contextlib.suppress(LSystemError, *[TypeError] * odd):  # whatever one refuses, the next is tried
                getattr(result, method)(value)


def run(calls: int, seed: int) -> str | None:
    """Call so many times at random; the first call that did something else, or None."""
    from lsys_kit import LSystemError, limits

    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as folder:
        for number in range(calls):
            chance, told, started = random.Random(f"{seed} {number}"), list[str](), time.process_time()
            try:
                with limits(seconds=SECONDS, modules=20_000, bytes=2**27):
                    one_call(chance, Path(folder), told)
            except LSystemError as error:
                str(error)
            except Exception:
                return "\n".join([f"call {number} of seed {seed}", *told, traceback.format_exc()[-3000:]])
            if time.process_time() - started > 8 * SECONDS + SLOWEST:
                return "\n".join([f"call {number} of seed {seed} took {time.process_time() - started:.1f} seconds", *told])
    return None


if __name__ == "__main__":
    wrong = run(int(sys.argv[1]), int(os.environ.get("SEED", "1")))
    if wrong:
        print(wrong, file=sys.stderr)
    sys.exit(bool(wrong))
