"""Small words need no arrays: where numpy, scipy and matplotlib are missing, the kit answers the same, and loads none."""

from __future__ import annotations

import json
import random
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import lsys_kit as kit
from lsys_kit.classroom.exercises.registry import kit_questions
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.write import write
from tests.derivation.random_systems import CHANCE, CONTEXT, systems, systems_with
from tests.without_arrays import MISSING, of_answers, of_letters, of_text, of_words

LONG = (
    "axiom: F\nF -> F[+F]F",
    "axiom: A(1)\nA(x) : x < 3 -> A(x+1) B A(x/2)\nA(x) -> A(0.3*x) A(0.9*x)",
    "axiom: F\nF -> F[+F] : 1/2\nF -> F F : 1/2",
    "ignore: + -\naxiom: F A F\nF < A -> A F\nF < F > A -> F[+A F]F\nA < F -> F A",
)
DRAWN = [each.id for _, _, each in kit_questions().exercises if each.kind == "drawing"]
ANSWERS = Path(__file__).parent / "classroom" / "data"
Ask = Callable[..., Any]


@pytest.fixture(scope="module")
def asked() -> Iterator[Ask]:
    """Asks a process in which the libraries are missing."""
    command = [sys.executable, "-m", "tests.without_arrays"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin
        assert process.stdout

        def ask(*question: object) -> Any:
            process.stdin.write(json.dumps(question) + "\n")
            process.stdin.flush()
            return json.loads(process.stdout.readline())

        yield ask
        process.stdin.close()


def needs(found: object) -> str:
    return str(found.get("needs", "")) if isinstance(found, dict) else ""


def compare(asked: Ask, text: str, steps: int) -> dict[str, str]:
    """What cannot be told without the libraries, and why; the rest must be the same."""
    there, here = asked("text", text, steps), of_text(text, steps)
    missing = {name: needs(found) for name, found in there.items() if needs(found)}
    for name in there.keys() - missing.keys():
        assert there[name] == here[name], name
    return missing


@pytest.mark.slow
@pytest.mark.parametrize("id", [*kit.systems(), *kit.book_systems()])
def test_the_catalogue_is_the_same_without_arrays(asked: Ask, id: str) -> None:
    system = kit.system(id)
    missing = compare(asked, write(system), min(system.steps or 3, 3))
    assert not missing or traits_of(system).sensitive


@pytest.mark.slow
@settings(suppress_health_check=[*HealthCheck])
@given(st.one_of(systems(), systems_with(), systems_with(CONTEXT, CHANCE)))
def test_random_systems_are_the_same_without_arrays(asked: Ask, system: LSystem) -> None:
    assert not compare(asked, write(system), 4)


@pytest.mark.slow
@pytest.mark.parametrize("text", LONG)
def test_words_of_some_thousand_modules_are_the_same_without_arrays(asked: Ask, text: str) -> None:
    assert asked("words", text, 12) == of_words(text, 12)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "symbol", "letter"),
    [
        ("q = 1/2\naxiom: A(1)\nA(x) -> F(x) A(q*x)", "F", "q"),
        ("r = 2\naxiom: A(1)\nA(x) -> F(x) [A(x/r)] A(x/r^2)", "F", "r"),
        ("axiom: A(1)\np = 1/3\nA(x) -> A(x) A(p*x)", "A", "p"),
    ],
)
def test_letters_and_totals_need_no_arrays(asked: Ask, text: str, symbol: str, letter: str) -> None:
    there = asked("letters", text, symbol, letter)
    assert not any(map(needs, there))
    assert there == of_letters(text, symbol, letter)


def replied_alike(asked: Ask, exercise: str, answers: list[str]) -> None:
    for answer, there, here in zip(answers, asked("answers", exercise, answers), of_answers(exercise, answers), strict=True):
        assert there == here, answer


@pytest.mark.slow
def test_answers_are_replied_to_alike_without_arrays(asked: Ask) -> None:
    tried = [each for _, _, each in kit_questions().exercises]
    assert len(tried) > 60
    for each in tried:
        replied_alike(asked, each.id, [str(each.solution), "A(1) B", "axiom: A\nA -> A B"])


@pytest.mark.slow
@pytest.mark.parametrize("exercise", DRAWN)
def test_drawings_are_replied_to_alike_without_arrays(asked: Ask, exercise: str) -> None:
    """Answers of students, and words at random."""
    files = (tomllib.loads((ANSWERS / f"{name}_answers.toml").read_text("utf-8")) for name in ("right", "wrong"))
    kept = [each for file in files for each in given_in(file.get(exercise, [])) if isinstance(each, str)]
    chance = random.Random(exercise)
    replied_alike(asked, exercise, [*kept, *(drawn_at_random(chance) for _ in range(60))])


def given_in(answers: Any) -> Iterator[object]:
    for each in answers.values() if isinstance(answers, dict) else answers:
        yield from each if isinstance(each, list) and isinstance(answers, dict) else [each]


def drawn_at_random(chance: random.Random) -> str:
    """A word with branches, or a system of such."""
    word = partial(word_at_random, chance, 2)
    if chance.random() < 0.5:
        return f"F{word()}"
    return f"angle: {chance.choice((25, 45, 60, 90))}\naxiom: F{chance.choice(('', 'X', '+F'))}\nF -> {word()}\nX -> {word()}"


def word_at_random(chance: random.Random, depth: int) -> str:
    return "".join(
        f"[{word_at_random(chance, depth - 1)}]" if depth and chance.random() < 0.2 else chance.choice("FFX+-")
        for _ in range(chance.randint(1, 7))
    )


@pytest.mark.slow
def test_the_first_word_loads_no_arrays() -> None:
    text = "B A A A\nB < A -> B\nB -> A F[+A] : 1/2\nB -> A : 1/2"
    program = f"""
import sys, lsys_kit
found = lsys_kit.derive(lsys_kit.read({text!r}), 5)
print(found, lsys_kit.stages(lsys_kit.system("J1")), lsys_kit.check("1.1", "x"))
print(*sorted({{*{MISSING!r}}} & sys.modules.keys()), file=sys.stderr)
"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert run.stdout
    assert not run.stderr.strip()
