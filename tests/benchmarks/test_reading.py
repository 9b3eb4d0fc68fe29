"""How fast texts are read, in every notation: the expressions of the catalogue, and texts of a million characters.

Goals: an expression in under 0.3 ms; a text of a million characters is read or refused in under 2 s. With `--benchmark-only` a
table of the figures is printed; without it each text is read once, and is a tenth as long.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import pytest

from lsys_kit import system, systems
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.expressions import Expression, is_random
from lsys_kit.notation.model.modules import Pattern, flat
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS, recognise
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.systems import lacking
from lsys_kit.notation.write import write
from tests.plants import plant

MOST_MS, MOST_SECONDS = 0.3, 2.0
MILLION = 1_000_000
MOST = 49_000
"""How many characters are read in every notation, even where they are one statement."""
WITH_EXPRESSIONS = [name for name in DIALECTS if name not in ("plant-string", "fractint")]
RULE = {
    "abop": "A(t) : t < {} && t > 2 -> B(t+1)[+C(2*t)]F(t^2) A(t)\n",
    "plant-string": "A -> I[A]A(I)AFFI[L](L)IFA[A]B(B)\n",
    "cpfg": "A(t) : t < {} && t > 2 --> B(t+1)[+C(2*t)]F(t^2)A(t)\n",
    "grogra": "(t<{} && t>2) A(t) # B(t+1) [+ C(2*t)] F(t^2) A(t),\n",
    "mathematica": "LRule[LEFT[], PRED[A[t_ /; t < {} && t > 2]], RIGHT[], SUCC[B[t+1], C[2*t], F[t^2], A[t]]],\n",
    "fractint": "A=F[+A]\\30D@.5!F<1F|[-A]C{}F\n",
}
"""A production of each notation, with a place for a number."""
BEGUN = {
    "abop": "axiom: A\n",
    "plant-string": "Axiom: A\n",
    "cpfg": "Axiom: A\n",
    "grogra": "\\axiom A,\n",
    "fractint": "Plant {\nAngle 8\nAxiom A\n",
    "mathematica": "axiom = AXIOM[A];\nlrules = LRULES[\n",
}
ENDED = {"mathematica": "LRule[LEFT[], PRED[A], RIGHT[], SUCC[B]]];\nlsystem = LSystem[axiom, lrules];", "fractint": "}"}
ARROW = {"cpfg": " --> ", "grogra": " # ", "mathematica": " -> ", "fractint": "="}


def model(notation: str, rules: int, wide: int = 0) -> str:
    """A model with so many productions, whose successors end in so many modules more."""
    end = {"grogra": ",\n", "mathematica": "]],\n"}.get(notation, "\n")
    more = ", A[t]" if notation == "mathematica" else " A" if notation in ("plant-string", "fractint") else " A(t)"
    rule = RULE[notation].removesuffix(end) + more * wide + end
    return BEGUN[notation] + "".join(rule.format(number) for number in range(rules)) + ENDED.get(notation, "")


def most_rules(notation: str) -> int:
    """How many productions a model may have."""
    return min(990, MOST // len(RULE[notation].format(100)))


def long_texts(notation: str, characters: int) -> dict[str, str]:
    """Texts of so many characters: models, what looks like one, and what is none."""
    arrow = ARROW.get(notation, " -> ")
    opening, closing = ("(*", "*)") if notation == "mathematica" else ("/*", "*/")
    texts = {
        "the most that is read": model(notation, most_rules(notation)) + "\n" * characters,
        "the longest line": BEGUN[notation] + f"A{arrow}{'+-' * 20_000}\n" + ENDED.get(notation, "") + "\n" * characters,
        "many rules": model(notation, characters // len(RULE[notation])),
        "a thousand long rules": model(notation, 990, 180),
        "long lines": BEGUN[notation] + f"A{arrow}{'A ' * 20_000}\n" * 24,
        "signs": BEGUN[notation] + f"A{arrow}{'+-' * 20_000}\n" * 24,
        "blanks": model(notation, 100) + "\n" * characters,
        "a comment": model(notation, 100) + opening + "x " * (characters // 2 - characters // 50) + closing,
        "open comments": model(notation, 100) + (opening + " x ") * (characters // 5),
        "open brackets": BEGUN[notation] + "[" * characters,
        "one word": "F" * characters,
        "short lines": "A\n" * (characters // 2),
        "comparisons": "A" + " < A" * (characters // 4),
        "labels": "p_1 : A\n" * (characters // 8),
        "sets": "P = {A, \n" * (characters // 9),
        "wide blanks": ("A" + " " * 999) * (characters // 1_000) + "!",
    }
    return {name: text[:characters] for name, text in texts.items()}


def expressions(model: LSystem) -> Iterator[Expression]:
    """All expressions of a system's rules."""
    for rule in model.rules:
        modules = (*rule.parameters, *flat(rule.successor))
        found = (*(argument for module in modules for argument in module.arguments), rule.condition, rule.probability)
        yield from (expression for expression in found if isinstance(expression, Expression))


class Table:
    """The figures, a line each, printed when all is measured."""

    def __init__(self) -> None:
        self.lines = [("notation", "text", "median", "slowest", "goal")]

    def __str__(self) -> str:
        widths = [max(map(len, column)) for column in zip(*self.lines, strict=True)]
        return "\n".join("  ".join(map(str.ljust, line, widths)).rstrip() for line in self.lines)


@pytest.fixture(scope="module")
def table(request: pytest.FixtureRequest) -> Iterator[Table]:
    found = Table()
    yield found
    if request.config.option.benchmark_only:
        with request.config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
            print(f"\n\n{found}")


@pytest.mark.parametrize("notation", WITH_EXPRESSIONS)
def test_the_expressions_of_the_catalogue(benchmark, table: Table, notation: str) -> None:
    """Each expression of each system, spelt in the notation, at its best: another process may come in between. What a system is
    drawn as is left out, which few notations have.

    GROGRA declares random numbers on lines of their own.
    """
    chosen = DIALECTS[notation]
    spelt = {
        chosen.module(Pattern("a", (expression,)))[2:-1]
        for bare in (replace(system(id), interpretation=()) for id in systems())
        if not lacking(chosen, bare)
        for expression in expressions(bare)
        if notation != "grogra" or not is_random(expression)
    }
    taken = dict.fromkeys(spelt, float("inf"))
    parse(chosen, "expression", "1", 0, 1)  # the first makes the parser

    def read_all() -> None:
        for text in [*spelt] * 5:
            started = time.perf_counter()
            parse(chosen, "expression", text, 0, len(text))
            taken[text] = min(taken[text], time.perf_counter() - started)

    benchmark.pedantic(read_all, rounds=5, warmup_rounds=1)
    milliseconds = sorted(1_000 * seconds for seconds in taken.values())
    assert len(milliseconds) > 10
    table.lines.append(
        (
            notation,
            f"{len(spelt)} expressions",
            f"{statistics.median(milliseconds):.3f} ms",
            f"{milliseconds[-1]:.3f} ms",
            f"{MOST_MS} ms",
        )
    )


@pytest.mark.parametrize("notation", DIALECTS)
def test_a_million_characters(benchmark, table: Table, notation: str) -> None:
    """Each text is recognised, then read in the notation or refused with an explanation."""
    texts, taken = long_texts(notation, MILLION // 10 if benchmark.disabled else MILLION), dict[str, float]()
    read(model(notation, 1), notation)  # the first makes the parser

    def read_all() -> None:
        for name, text in texts.items():
            started = time.perf_counter()
            recognise(text)
            with suppress(LSystemError):
                read(text, notation)
            taken[name] = time.perf_counter() - started

    benchmark.pedantic(read_all, rounds=1)
    slowest = max(taken, key=lambda name: taken[name])
    table.lines.append(
        (
            notation,
            f"a million characters: {slowest}",
            f"{statistics.median(taken.values()):.2f} s",
            f"{taken[slowest]:.2f} s",
            f"{MOST_SECONDS:g} s",
        )
    )


@pytest.mark.parametrize("notation", DIALECTS)
def test_a_model_of_the_catalogue(benchmark, table: Table, notation: str) -> None:
    """A plant and a parametric filament where the notation can express it: from text to system."""
    texts = [write(each, notation) for each in (plant(notation), system("P4")) if not lacking(DIALECTS[notation], each)]
    assert benchmark(lambda: [read(text, notation) for text in texts])


@pytest.mark.parametrize("notation", DIALECTS)
def test_the_largest_model_that_is_read(notation: str) -> None:
    """The productions of the long texts are what they are taken for; Fractint makes one of all that are for one symbol."""
    found = read(long_texts(notation, MILLION)["the most that is read"], notation).productions
    assert len(found) == (1 if notation == "fractint" else most_rules(notation) + (notation == "mathematica"))
