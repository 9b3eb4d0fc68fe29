"""Models that repeat, grow or nest without end, one for each part of a model that can, and the public functions that meet them.

    python -m tests.fuzzing.bombs 1 100              all of them, with a limit of one second and 100 MB
    python -m tests.fuzzing.bombs 1 100 chance       one of them

Each call must end within its limits: with a result, or with an error of the kit. So must what the result does later on.
"""

from __future__ import annotations

import resource
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

SLACK = 5
"""So many seconds of the processor a call may take beyond its limit: operations on whole arrays are not divided."""
BOMBS: Mapping[str, str] = {
    "empty repetition": "axiom: A\nA -> repeat(1000,h)<repeat(1000,i)<repeat(1000,j)<repeat(1000,k)<repeat(0,l)<A>>>>>",
    "production": "axiom: A\nA -> repeat(100000,i)<repeat(100000,j)<A>>",
    "growing": "axiom: F\nF -> FFFFFFFFFF",
    "ageing": "axiom: A(0)\nA(t) -> A(t+1) B(t)\nB(t) -> B(t+1)",
    "closure": "axiom: A(0)\nA(n) : n<900 -> A(n+1) repeat(100000,i)<repeat(40,j)<B>>",
    "many rules": "axiom: A(0)\nA(n) : n<900 -> A(n+1) B(n) B(n) B(n+1)\nB(n) : n>0 -> B(n-1) B(n-1)",
    "decomposition": "axiom: a(0)\ndecomposition:\na(n) : n<60 -> a(n+1) a(n+1)",
    "wide decomposition": "axiom: a\na -> a a\ndecomposition:\na -> repeat(5000,i)<b>\nb -> repeat(5000,i)<c>\n"
                          "c -> repeat(5000,i)<d>",
    "interpretation": "axiom: a\na -> a a\ninterpretation:\na -> repeat(100000,i)<repeat(100000,j)<F>>",
    "nested interpretation": "axiom: a\na -> a\ndepth: 100\ninterpretation:\na -> a a",
    "interpretations": "axiom: A(0)\nA(n) -> A(n+1) B(n)\nB(n) -> B(n+1/7)\ninterpretation:\nB(n) -> repeat(400000,i)<F>",
    "cells": "axiom: a\na -> a a\ninterpretation:\na -> repeat(100000,i)<repeat(100000,j)<R(1,1)>>",
    "many cells": "axiom: a\na -> a a a\ninterpretation:\na -> R(1,1)",
    "meta": "axiom: f(1)\nf(x) -> f(x) f(x) f(x)\nmeta: f(x) f(y) -> f(x+y) g\ng f(x) -> f(x) f(1) g",
    "condition": "axiom: A(1)\nA(x) : binomial(100000,1/2)+binomial(100000,1/2)+binomial(100000,1/2) > x -> A(x) A(x)",
    "probability": "axiom: A(1)\nA(x) -> A(x+1) A(x) : binomial(100000,1/2)+1\nA(x) -> A(x) : poisson(500)+1",
    "chance": "axiom: A\nA -> B(binomial(100000,1/2)) A A A",
    "constants": "c = 1\nd = c + 1\naxiom: A(c)\nA(x) -> A((x+c)^30) A(x*d)",
    "context": "axiom: A(0) A(1)\nA(x) < A(y) -> A(x+y) A(y+1) A(x)",
    "branches": "axiom: A\nA -> [A][A][A]\nA < A > [A][A] -> A",
    "turtle": "axiom: A ?P(0,0)\nA -> [+F A][-F A] ?P(0,0)",
    "long strokes": "axiom: A\nA -> repeat(60000,i)<F|>",
    "broad strokes": "axiom: A\nA -> !(90)F(1)A+(20)!(1)F(100)",
    "polygons": "axiom: A\nA -> {.repeat(1000,i)<+(1)F.>}AA",
    "discs": "axiom: A\nA -> @O(2)F@o(3)AA",
    "nested brackets": "axiom: A\nA -> [A]F[A]",
    "space": "axiom: A\nA -> &(20)F[/(30)A][^(10)A]A",
}
"""For each part of a model that can repeat, grow or nest a model that does so without end."""

MAPS: Mapping[str, str] = {
    "map": "map: A>A>A>A>\nA> -> A>[-A>]A>[+A<]A>[-A>]A>",
}
"""The same for maps."""


def acts(folder: Path) -> Mapping[str, Callable[[Any], object]]:
    """What is done to a system, by public functions and by what their results offer."""
    from lsys_kit import (
        animate,
        check,
        continuity,
        derive,
        draw,
        explain,
        explore,
        figure,
        growth,
        lineage,
        pnml,
        stages,
        timed,
        write,
    )

    def saved(ending: str) -> Callable[[Any], object]:
        return lambda system: draw(system, 12).save(folder / f"picture{ending}")

    return {
        "derive": lambda system: derive(system, 25)[-1],
        "all words": lambda system: [str(word) for word in derive(system, 8)],
        "many steps": lambda system: derive(system, 100_000).lengths,
        "column": lambda system: repr(derive(system, 9)),
        "origins": lambda system: derive(system, 9).ancestors(9),
        "arithmetic": lambda system: derive(system, 12, arithmetic="float")[-1],
        "explain": lambda system: explain(derive(system, 7), 7),
        "draw": lambda system: draw(system, 12).svg,
        "png": saved(".png"), "pdf": saved(".pdf"), "glb": saved(".glb"), "obj": saved(".obj"),
        "figure": lambda system: figure(system, n=6),
        "animate": lambda system: animate(system, 9).gif,
        "growth": lambda system: growth(system),
        "lengths": lambda system: growth(system).lengths(10**6),
        "closed form": lambda system: growth(system).closed_form,
        "frequencies": lambda system: (growth(system).frequencies, growth(system).rate),
        "characteristic": lambda system: growth(system).characteristic,
        "stages": lambda system: draw(stages(system)).svg,
        "expected": lambda system: stages(system).expected(30_000),
        "pnml": lambda system: pnml(stages(system)),
        "timed": lambda system: timed(system).word(30),
        "lineage": lambda system: draw(lineage(system, 9)).svg,
        "continuity": lambda system: continuity(system, {}),
        "explore": lambda system: explore(system, 9).text,
        "check": lambda system: check("2.1", str(system)),
        "write": lambda system: write(system, "cpfg"),
    }


def report(seconds: float, megabytes: int, *only: str) -> list[str]:
    """Run what there is; what did not keep to its limits, one line for each call."""
    from lsys_kit import LSystemError, ModelLimitError, limits, read

    found, refused = [], set[str]()
    with tempfile.TemporaryDirectory() as folder:
        table = acts(Path(folder))
        for name, text in BOMBS.items():
            for act, do in table.items():
                if only and not {name, act} & {*only}:
                    continue
                started = time.process_time()
                _room(megabytes + 300)
                try:
                    with limits(seconds=seconds, bytes=megabytes * 2**20):
                        do(read(text))
                    outcome = "done"
                except ModelLimitError as error:
                    outcome = error.message
                    refused.add(name)
                except LSystemError as error:
                    outcome = f"{type(error).__name__}: {error.message}"
                except BaseException as error:
                    outcome = f"{type(error).__name__}: {error}"
                    found.append(f"{name}, {act}: {outcome}")
                _room(100_000)
                spent = time.process_time() - started
                if spent > seconds + SLACK:
                    found.append(f"{name}, {act}: {spent:.1f} seconds; {outcome}")
                print(f"{name:22} {act:15} {spent:5.2f} {outcome[:110]}", flush=True)
    return found


def _room(megabytes: int) -> None:
    """From here on so much memory more may be used than now."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + megabytes * 2**20, resource.RLIM_INFINITY))


if __name__ == "__main__":
    wrong = report(float(sys.argv[1]), int(sys.argv[2]), *sys.argv[3:])
    for line in wrong:
        print(line, file=sys.stderr)
    sys.exit(bool(wrong))
