"""What pages of the course ask the kit: books and models for their panels, replies to answers, exercises without end.

Each is answered from what the question says, and nothing else is kept. A question is JSON, and so is its answer; what was
typed is read by the kit's readers, and never run. On pages of a class a worker process answers (`live/answers.py`), on pages
that hold the kit Python in the browser, which has no arrays.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import TypeAlias

from lsys_kit.budget import limits
from lsys_kit.classroom.exercises.check import checked
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.choices import letters, listing
from lsys_kit.classroom.exercises.practice.practice import practice
from lsys_kit.classroom.exercises.practice.schedule import kept_name, level_after, practised
from lsys_kit.classroom.exercises.progress import Try
from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.panel.explorer import Explorer
from lsys_kit.classroom.panel.opened.kinds import opened
from lsys_kit.errors import LSystemError
from lsys_kit.files import Entries
from lsys_kit.notation.read import CELL_READERS, read
from lsys_kit.translation import gettext

Kinds: TypeAlias = Mapping[str, Callable[[Mapping[str, object]], Data]]
"""What answers questions of each kind."""
BUDGET: Mapping[str, float] = {"modules": 100_000, "bytes": 2**27, "seconds": 15.0, "text": 20_000, "rules": 200}
"""The limits of an answer in a browser, whose Python takes several times as long."""
SEEN = ("step", "angle", "around", "above", "seed", "mark", "settings")
"""What is chosen in a panel."""
_NUMBERS = ("step", "angle", "around", "above", "seed")


def answered(asked: str) -> str:
    """What is answered to a question of a page that holds the kit, both as JSON.

    >>> answered('{"kind": "check", "id": "1.1", "answer": "bl ar bl ar ar"}').startswith('{"said": "Correct"')
    True
    """
    return json.dumps(answer(json.loads(asked), KINDS, BUDGET))


def answer(asked: Entries, kinds: Kinds, budget: Mapping[str, float]) -> Data:
    """What is answered to a question; a mistake in a model is an answer too.

    >>> panel = {"notation": "abop", "text": "axiom: a\\na -> ab\\nb -> a"}
    >>> answer({"kind": "rules", "panel": panel, "text": "axiom: a\\na -> b = c"}, KINDS, BUDGET)["mistake"]["line"]
    2
    """
    try:
        with limits(**budget):
            return kinds[asked["kind"]](asked)
    except LSystemError as mistake:
        return {"mistake": {"message": mistake.message, "hint": mistake.hint or ""}}
    except ModuleNotFoundError as absent:
        name = str(absent.name).partition(".")[0]
        said = gettext("This needs {name}, which Python in this page does not have", name=name)
        return {"mistake": {"message": said, "hint": gettext("Open the lesson in JupyterLab: lsys-kit lab.")}, "needs": name}
    except (KeyError, TypeError, ValueError, AttributeError):  # of a question that no page of the kit asks
        return {"mistake": {"message": "This question cannot be understood", "hint": ""}}


def _panel(asked: Entries) -> Data:
    """What a panel asks; where its model or what is chosen has changed, that is told, too."""
    given = asked["panel"]
    text, notation = str(given["text"]), str(given["notation"])
    system = CELL_READERS[notation](text) if notation in CELL_READERS else read(text, notation)
    chosen = {name: given[name] for name in _NUMBERS if isinstance(given.get(name), int | float)}
    settings = {str(name): str(value) for name, value in dict(given.get("settings", {})).items()}
    without = frozenset(map(str, given.get("without", ())))
    what = opened(system, str(given.get("title", ""))[:100], settings, without, given.get("unfold") or False)
    panel = Explorer(
        what, None, chosen.get("angle"), int(chosen.get("seed", 0)), without, given.get("unfold") or False, given.get("show")
    )
    try:
        return _told(panel, asked, chosen)
    finally:
        panel.close()


def _told(panel: Explorer, asked: Entries, chosen: Entries) -> Data:
    panel.step = max(0, min(int(chosen.get("step", panel.step)), panel.model["book"]["steps"]))
    panel.around, panel.above = (int(chosen.get(name, getattr(panel, name))) for name in ("around", "above"))
    panel.mark = str(asked["panel"].get("mark", ""))
    if asked["kind"] == "open":
        return _state(panel)
    reply = panel.answer(asked)
    return {**reply, **_state(panel)} if "opened" in reply else reply


def _state(panel: Explorer) -> Data:
    """The model of a panel, and what is chosen in it."""
    return {
        "model": panel.model,
        "values": {name: getattr(panel, name) for name in SEEN},
        "system": {"notation": panel.system.notation, "text": str(panel.system)},
    }


def _check(asked: Mapping[str, object]) -> Data:
    """The verdict on an answer to an exercise of the course."""
    return _verdict(exercise_of(str(asked["id"])), asked)


def _verdict(exercise: Exercise, asked: Entries) -> Data:
    """The verdict on an answer, with the hints up to one, or with the solution."""
    verdict = checked(exercise, str(asked.get("answer", "")), 0, asked.get("solution") is True, "")
    hinted = asked.get("hint", 0) if verdict.said in ("Almost", "Not yet") and type(asked.get("hint")) is int else 0
    most = len(exercise.hints)
    hints = [
        reply("check.hint", number=at, most=most, hint=hint) for at, hint in enumerate(exercise.hints[: max(0, hinted)], 1)
    ]
    message = "\n".join([verdict.message, *hints])
    return {"said": verdict.said, "message": message, "picture": verdict.picture, "described": verdict.described}


def _practice(asked: Entries) -> Data:
    """An exercise made at random, at a level that follows the tries so far: names of exercises, and whether each was right."""
    topic, level, seed = _practised(asked)
    tries = [Try(str(name), solved is True) for name, solved in asked.get("tries", ())][-MOST_TRIES:]
    found = level_after(practised(tries), topic, level)
    exercise = practice(topic, found.level, seed).exercise
    return {
        "level": found.level,
        "note": reply(f"practice.{found.why}", level=found.level, title=exercise.title) if found.why else "",
        "name": kept_name(topic, found.level, seed),
        "title": exercise.title,
        "question": exercise.question.strip() + ("" if exercise.options else listing(exercise)),
        "options": [
            {"letter": letter, "text": each.text} for letter, each in zip(letters(exercise), exercise.options, strict=True)
        ],
        "kind": exercise.kind,
        "template": exercise.template,
        "hints": len(exercise.hints),
    }


def _practice_check(asked: Mapping[str, object]) -> Data:
    """The verdict on an answer to such an exercise."""
    return _verdict(practice(*_practised(asked)).exercise, asked)


def _practised(asked: Mapping[str, object]) -> tuple[str, int, int]:
    level, seed = asked["level"], asked["seed"]
    if type(level) is not int or type(seed) is not int or not 0 <= seed < MOST_SEED:
        raise ValueError
    return str(asked["topic"]), level, seed


MOST_TRIES, MOST_SEED = 50, 10**6
"""So many tries at most say which level comes next; exercises made at random are numbered up to here."""


KINDS: Kinds = {
    **dict.fromkeys(("open", "book", "rules", "variants", "keep"), _panel),
    "check": _check,
    "practice": _practice,
    "practice check": _practice_check,
}
