"""What cpfg, the program of the Virtual Laboratory, derives from its own models: counts at every step, and words.

The models of `cases/cpfg.json` are read as they are, in cpfg's notation.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Iterator
from math import isclose
from pathlib import Path
from typing import Any

import pytest

from lsys_kit.budget import limits
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.derive import derive
from lsys_kit.notation.read import read
from lsys_kit.notation.write import write
from tests.derivation import reference
from tests.plugin import AN_HOUR

CASES = {case["name"]: case for case in json.loads((Path(__file__).parent / "cases" / "cpfg.json").read_text(encoding="utf-8"))}


@pytest.fixture(autouse=True)
def _time_enough() -> Iterator[None]:
    """Words are compared here, however busy the machine is."""
    with limits(seconds=AN_HOUR):
        yield


def printed(word: Iterable[tuple[str, tuple[Any, ...]]]) -> str:
    """A word as cpfg prints it: numbers with six digits."""
    return "".join(symbol + (f"({','.join(f'{float(v):g}' for v in values)})" if values else "") for symbol, values in word)


KIT = {name: read(case["source"]) for name, case in CASES.items()}
NUMBER = re.compile(r"(?<=[(,])-?\d[\d.e+-]*")
IN_SINGLES = {"anabaena_heterocysts_t_gt_0": "float", "timed_leaf_decomposition": "exact"}
"""Models in which cpfg's single precision shows, and the kit's arithmetic for them: 4 + 20 * 0.1 is less than 6 in singles and
doubles, so that cells divide a step late; and the sixth digit of a product may be another."""


def words(name: str) -> Iterator[list[reference.PlainModule]]:
    """The kit's words of all steps."""
    steps = len(CASES[name]["steps"]) - 1
    for word in derive(KIT[name], steps, arithmetic=IN_SINGLES.get(name, "exact")):
        yield [(module.symbol, module.arguments) for module in word]


def defined(name: str) -> Iterator[list[reference.PlainModule]]:
    """The words of all steps after the definition."""
    return iter(reference.words(KIT[name], len(CASES[name]["steps"]) - 1)[0])


def same_but_for_precision(word: str, expected: str) -> bool:
    """Whether two words have the same modules, with arguments that agree in five digits."""
    numbers = zip(map(float, NUMBER.findall(word)), map(float, NUMBER.findall(expected)), strict=True)
    return NUMBER.sub("", word) == NUMBER.sub("", expected) and all(isclose(a, b, rel_tol=2e-5) for a, b in numbers)


@pytest.mark.parametrize("name", CASES)
def test_a_model_of_cpfg_is_read_and_written_as_it_is(name: str) -> None:
    system = KIT[name]
    assert system == read(CASES[name]["source"], "cpfg")
    assert all("in a file of the view" in note for note in read(CASES[name]["source"], "cpfg").notes)
    assert system.steps == len(CASES[name]["steps"]) - 1
    assert read(write(system)) == system


@pytest.mark.parametrize("name", CASES)
def test_the_kit_counts_what_cpfg_counts(name: str) -> None:
    """cpfg counts the characters of a symbol: `@o` is two."""
    counts = [sum(len(symbol) for symbol, _ in word) for word in words(name)]
    assert counts == [step["modules"] for step in CASES[name]["steps"]]


@pytest.mark.parametrize("name", sorted(CASES.keys() - IN_SINGLES.keys()))
def test_the_kit_derives_the_words_of_cpfg(name: str) -> None:
    for word, step in zip(words(name), CASES[name]["steps"], strict=True):
        assert printed(word) == step.get("string", printed(word)), step["n"]
        assert hashlib.sha256(printed(word).encode()).hexdigest() == step["sha256"], step["n"]


@pytest.mark.slow
@pytest.mark.parametrize("name", IN_SINGLES)
def test_the_kit_derives_the_words_of_cpfg_up_to_single_precision(name: str) -> None:
    for word, step in zip(words(name), CASES[name]["steps"], strict=True):
        assert same_but_for_precision(printed(word), step.get("string", printed(word))), step["n"]


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(CASES.keys() - IN_SINGLES.keys() - {"hogeweg_hesper_b"}))
def test_the_definition_gives_the_words_of_cpfg(name: str) -> None:
    for word, step in zip(defined(name), CASES[name]["steps"], strict=True):
        assert hashlib.sha256(printed(word).encode()).hexdigest() == step["sha256"], step["n"]


def test_exact_ages_divide_a_step_earlier_than_those_of_cpfg() -> None:
    """4 + 20 * 0.1 is 6: the cell divides at step 20, and cpfg's at step 21."""
    system = KIT["anabaena_heterocysts_t_gt_0"]
    exact, doubles = ([len(word) for word in derive(system, 22, arithmetic=kind)] for kind in ("exact", "float"))
    assert exact.index(6) + 1 == doubles.index(6) == 22


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if "steps_after_homomorphism" in case])
def test_what_is_drawn_is_what_cpfg_draws(name: str) -> None:
    for step in CASES[name]["steps_after_homomorphism"]:
        derivation = derive(KIT[name], step["n"])
        numbers = list(derivation[-1].numbers())
        drawn = interpretations(derivation.states, numbers)
        text = printed((m.symbol, m.arguments) for number in numbers for m in drawn[number])
        assert text == step.get("string", text)
        assert sum(len(drawn[number]) for number in numbers) == step["modules"]
