"""What the kit answers where numpy, scipy and matplotlib are not installed, as in a browser's Python before they are fetched.

Run as a program, it answers lines of JSON: what is asked, and the arguments.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

MISSING = "numpy", "scipy", "matplotlib"
if __name__ == "__main__":
    sys.modules.update(dict.fromkeys(MISSING))  # type: ignore[arg-type]

import lsys_kit as kit  # noqa: E402
from lsys_kit.budget import limits  # noqa: E402
from lsys_kit.classroom.panel.books.book import book  # noqa: E402
from lsys_kit.errors import LSystemError  # noqa: E402
from lsys_kit.notation.model.system import LSystem  # noqa: E402


def said(act: Callable[[], object]) -> object:
    """What an act answers, or what the error says, or which library it needs."""
    try:
        with limits(seconds=60):
            return json.loads(json.dumps(act()))
    except LSystemError as error:
        return [type(error).__name__, str(error)]
    except ModuleNotFoundError as error:
        if str(error.name).partition(".")[0] not in MISSING:
            raise
        return {"needs": error.name}


def derived(system: LSystem, steps: int) -> object:
    found = kit.derive(system, steps, seed=3)
    counts = [[sorted(found.counts(step).items()), sorted(found[step].counts().items())] for step in range(steps + 1)]
    return [[*map(str, found)], found.lengths, [*map(str, found.states.modules)], counts, found.notes, repr(found)]


def origins(system: LSystem, steps: int) -> object:
    return repr([kit.derive(system, steps, seed=3).origins(step) for step in range(1, steps + 1)])


def of_text(text: str, steps: int) -> Mapping[str, object]:
    """What is told of a model."""
    system = kit.read(text)
    return {
        "words": said(lambda: derived(system, steps)),
        "origins": said(lambda: origins(system, steps)),
        "net": said(lambda: kit.pnml(kit.stages(system))),
        "growth": said(lambda: str(kit.growth(system))),
        "link": said(lambda: kit.link(system)),
        "book": said(lambda: book(system)),
    }


def of_letters(text: str, symbol: str, letter: str) -> list[object]:
    """The words of a model with a letter in place of a number, and what is said of a total with it."""
    system, letters = kit.read(text), {letter: letter}
    total = partial(kit.total, system, symbol, **letters)
    return [
        said(lambda: [*map(str, kit.derive(system, 4, **letters))]),
        said(lambda: [str(total().formula), str(total().limit), repr(total())]),
        said(lambda: str(total().derivative(letter))),
        said(lambda: repr(kit.closing_angles(kit.system("T2"), 2))),
    ]


def of_words(text: str, steps: int) -> object:
    """The words of a model, and where their modules come from."""
    system = kit.read(text)
    return said(lambda: [derived(system, steps), origins(system, steps)])


def of_answers(exercise: str, answers: list[str]) -> list[object]:
    """What is replied to answers."""
    return [said(lambda answer=answer: [float(v := kit.check(exercise, answer)), str(v)]) for answer in answers]


ACTS: Mapping[str, Callable[..., Any]] = {"text": of_text, "words": of_words, "letters": of_letters, "answers": of_answers}

if __name__ == "__main__":
    for line in sys.stdin:
        act, *arguments = json.loads(line)
        print(json.dumps(ACTS[act](*arguments)), flush=True)
