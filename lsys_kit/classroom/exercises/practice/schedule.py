"""Which exercise comes next: the level follows the answers, and what was missed comes again after more and more others.

Topics lie in boxes (S. Leitner, So lernt man lernen, 1972): one that was missed lies in the first, and goes one box further
each time that it is solved at once. The record of tries says what was practised, so that it goes on where it ended.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from lsys_kit.classroom.exercises.progress import PRACTICE, Try

LEVELS = 3
"""How many levels there are."""
STREAK = 2
"""After so many right answers at once it goes up, after so many wrong ones down."""
INTERVALS = (2, 4, 8)
"""For each box how many other exercises lie between; a topic that leaves the last one is known."""
_KEPT = re.compile(rf"{PRACTICE}(.+) ([1-9]) (\d{{1,18}})")


@dataclass
class Practised:
    """An exercise that was practised, and whether each try was right."""

    topic: str
    level: int
    seed: int
    tries: list[bool] = field(default_factory=list)

    @property
    def at_once(self) -> bool:
        """Whether the first answer was right."""
        return self.tries[0]


@dataclass(frozen=True)
class Next:
    """What comes next: at which level of which topic, and why, as the name of a text; empty where all stays as it is."""

    topic: str
    level: int
    why: str = ""


def kept_name(topic: str, level: int, seed: int) -> str:
    """The name of an exercise in the record.

    >>> kept_name("life spans", 2, 17)
    'practice: life spans 2 17'
    """
    return f"{PRACTICE}{topic} {level} {seed}"


def practised(tries: Sequence[Try]) -> list[Practised]:
    """What was practised, in order.

    >>> [(each.topic, each.at_once) for each in practised([Try("practice: derive 1 5", True), Try("1.1", True)])]
    [('derive', True)]
    """
    found: dict[str, Practised] = {}
    for each in tries:
        if kept := _KEPT.fullmatch(each.exercise):
            name = each.exercise
            found.setdefault(name, Practised(kept[1], int(kept[2]), int(kept[3]))).tries.append(each.solved)
    return list(found.values())


def level_after(done: Sequence[Practised], topic: str, level: int) -> Next:
    """The level of a topic after what was practised.

    >>> level_after([Practised("derive", 1, 1, [True]), Practised("derive", 1, 2, [True])], "derive", 1)
    Next(topic='derive', level=2, why='up')
    >>> level_after([Practised("derive", 2, 1, [False, False])], "derive", 2)
    Next(topic='derive', level=1, why='down')
    """
    own = [each for each in done if each.topic == topic]
    same = next((at for at in range(len(own)) if own[-1 - at].level != level), len(own))
    tail = own[len(own) - same :]
    last = [right for each in tail for right in each.tries][-STREAK:]
    if len(tail) >= STREAK and all(each.at_once for each in tail[-STREAK:]) and level < LEVELS:
        return Next(topic, level + 1, "up")
    if len(last) == STREAK and not any(last) and level > 1:
        return Next(topic, level - 1, "down")
    return Next(topic, level)


def due(done: Sequence[Practised], but: str) -> str | None:
    """The topic that is to come again now, of several one in the first box before others; None where there is none.

    >>> missed = [Practised("chance", 1, 0, [False, True]), *(Practised("derive", 1, seed, [True]) for seed in range(2))]
    >>> due(missed, "derive"), due(missed[:2], "derive")
    ('chance', None)
    """
    boxes: dict[str, int] = {}
    last: dict[str, int] = {}
    for number, each in enumerate(done):
        last[each.topic] = number
        if not each.at_once:
            boxes[each.topic] = 0
        elif each.topic in boxes:
            boxes[each.topic] += 1
            if boxes[each.topic] == len(INTERVALS):
                del boxes[each.topic]
    waiting = [topic for topic, box in boxes.items() if topic != but and len(done) - 1 - last[topic] >= INTERVALS[box]]
    return min(waiting, key=lambda topic: (boxes[topic], last[topic]), default=None)


def last_level(done: Sequence[Practised], topic: str) -> int:
    """The level at which a topic was practised last."""
    return next((each.level for each in reversed(done) if each.topic == topic), 1)


def new_seed(done: Sequence[Practised], topic: str, level: int, seed: int) -> int:
    """The first seed from one on that was not practised."""
    known = {each.seed for each in done if (each.topic, each.level) == (topic, level)}
    while seed in known:
        seed += 1
    return seed
