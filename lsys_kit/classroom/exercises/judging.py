"""Judging: from an answer to a verdict. Right; or what a misconception yields; or different, and where first."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache, reduce
from typing import Any, TypeAlias

from lsys_kit.budget import PACE, limits
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.kinds.kind import Difference
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS, solution_of
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS, Misconception
from lsys_kit.classroom.exercises.repairs.repair import Repair
from lsys_kit.classroom.exercises.repairs.table import repaired
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.errors import LSystemError
from lsys_kit.translation import gettext

MOST_ASKED = 3
"""So many misconceptions at most are asked about."""
MOST_RIGHT = 0.6
"""An answer of which so much is right may be a slip of the pen."""
MOST_SECONDS = 8 * PACE
"""So long misconceptions are looked for in an exercise, once: enough for all but worlds slow to derive."""
MOST_ANSWERS = 60
"""So many answers of one misconception are tried."""


@dataclass(frozen=True)
class WrongAnswer:
    """A wrong answer that is understood.

    Attributes
    ----------
    answer
        As an answer to the exercise is read.
    misconception
        That which yields it, or None.
    says
        The exercise's own reply, or empty.
    near
        Whether it is nearly right.
    """

    answer: Any
    misconception: Misconception | None = None
    says: str = ""
    near: bool = False


@lru_cache(maxsize=512)
def wrong_answers(exercise: Exercise) -> tuple[WrongAnswer, ...]:
    """The wrong answers to an exercise that are understood: those that it declares, then those that misconceptions yield.

    >>> fibonacci = "axiom: a\\na -> ab\\nb -> a"
    >>> exercise = Exercise("1", "", "word", "", "abaab", "", (), system=fibonacci, steps=3)
    >>> list(dict.fromkeys(wrong.misconception.name for wrong in wrong_answers(exercise)))[:3]
    ['sequential', 'one production a step', 'leftmost only']
    """
    return (*_declared(exercise), *_computed(exercise))


def _declared(exercise: Exercise) -> Iterator[WrongAnswer]:
    kind = ANSWER_KINDS[exercise.kind]
    for slip in exercise.slips:
        with suppress(LSystemError), limits(modules=20_000, seconds=2 * PACE):  # one that cannot be read is found by lint
            known = MISCONCEPTIONS.get(slip.misconception)
            yield WrongAnswer(kind.read(exercise, slip.answer), known, slip.says, slip.near or bool(known and known.near))
    for letter, option in zip(letters(exercise), exercise.options, strict=True):
        if option.says or option.misconception:
            yield WrongAnswer(letter, MISCONCEPTIONS.get(option.misconception), option.says)


def _computed(exercise: Exercise) -> Iterator[WrongAnswer]:
    for misconception, answer, right in _yielded(exercise):
        if not right:
            yield WrongAnswer(answer, misconception, near=misconception.near)


def right_by_mistake(exercise: Exercise) -> tuple[str, ...]:
    """The misconceptions that are looked for in an exercise and yield the right answer: it does not uncover them.

    >>> squares = Exercise("1", "", "number", "", "4", "", (), system="axiom: a\\na -> aa", asks="length", steps=2)
    >>> right_by_mistake(squares)[:3]
    ('sequential', 'one production a step', 'branches kept')
    """
    return tuple(dict.fromkeys(misconception.name for misconception, _, right in _yielded(exercise) if right))


def is_right_by_mistake(exercise: Exercise) -> bool:
    """Whether some misconception yields the right answer; no others are looked at then."""
    return any(right for _, _, right in _yielded(exercise))


Yielded: TypeAlias = tuple[Misconception, object, bool]
"""A misconception, an answer that it yields, and whether that is right."""


class _Yields:
    """What misconceptions yield, one after another; each is computed when it is first asked for, and kept."""

    def __init__(self, exercise: Exercise) -> None:
        self._exercise = exercise
        self._begin()

    def _begin(self) -> None:
        self._found, self._rest = list[Yielded](), _each_yielded(self._exercise)

    def __iter__(self) -> Iterator[Yielded]:
        yield from self._found
        while (each := self._next()) is not None:
            yield each

    def _next(self) -> Yielded | None:
        """The next one; where an interrupt comes, or a library is missing, all are computed anew when they are asked for."""
        try:
            found = next(self._rest, None)
        except BaseException:
            self._begin()
            raise
        if found is not None:
            self._found.append(found)
        return found


@lru_cache(maxsize=512)
def _yielded(exercise: Exercise) -> _Yields:
    return _Yields(exercise)


def _each_yielded(exercise: Exercise) -> Iterator[Yielded]:
    solution, started = solution_of(exercise), _clocks()
    for misconception in MISCONCEPTIONS.values():
        if _is_looked_for(exercise, misconception) and not _is_long_since(started):
            yield from _yielded_by(exercise, misconception, solution)


def _clocks() -> tuple[float, float]:
    return time.perf_counter(), time.process_time()


def _is_long_since(started: tuple[float, float]) -> bool:
    """Whether misconceptions have been looked for long enough; the clock of the processor is slow to read, and never ahead."""
    return time.perf_counter() - started[0] > MOST_SECONDS and time.process_time() - started[1] > MOST_SECONDS


def _yielded_by(exercise: Exercise, misconception: Misconception, solution: object) -> list[Yielded]:
    kind = ANSWER_KINDS[exercise.kind]
    found: list[Yielded] = []
    with suppress(LSystemError, ArithmeticError), limits(modules=20_000, seconds=3 * PACE, states=200):
        for answer in misconception.answers(exercise):
            if answer is not None and not any(_alike(exercise, answer, other) for _, other, _ in found):
                right = kind.same(exercise, answer, solution) or _alike(exercise, answer, solution)
                found.append((misconception, answer, right))
                if len(found) >= MOST_ANSWERS:
                    break
    return found


def _is_looked_for(exercise: Exercise, misconception: Misconception) -> bool:
    on_request = misconception.on_request or (misconception.faint and exercise.kind == "number")
    return misconception.name not in exercise.unlikely and (not on_request or misconception.name in exercise.expects)


def _alike(exercise: Exercise, own: object, other: object) -> bool:
    return (ANSWER_KINDS[exercise.kind].alike or ANSWER_KINDS[exercise.kind].same)(exercise, own, other)


def judged(exercise: Exercise, answer: object) -> tuple[Verdict, bool]:
    """The verdict on an answer, and whether it was a try, after which hints and the solution may be shown.

    Raises
    ------
    LSystemError
        The answer cannot be read, or is too large.
    """
    kind, solution = ANSWER_KINDS[exercise.kind], solution_of(exercise)
    own = kind.read(exercise, answer)
    if _is_right(exercise, own):
        return Verdict("Correct", kind.praise(exercise, own, solution)), True
    fitting = [wrong for wrong in wrong_answers(exercise) if _alike(exercise, own, wrong.answer)]
    found = kind.difference(exercise, own, solution)
    if found.explains:  # as well as a last resort would
        fitting = [wrong for wrong in fitting if wrong.says or not (wrong.misconception and wrong.misconception.last_resort)]
    repair = _repair(exercise, own, fitting, found)
    near = found.near or bool(repair and repair.near) or (bool(fitting) and all(wrong.near for wrong in fitting))
    said, mark = _parts_right(exercise, own, solution)
    explained = _explained(fitting, found, _is_worked(exercise, answer)) if fitting else ""
    changed = _said_of(repair, found) if repair or not fitting else ""
    message = " ".join(filter(None, (said, explained, changed)))
    tried = bool(fitting or repair) or kind.honest(exercise, own, solution)
    return Verdict("Almost" if near else "Not yet", message, mark, kind.picture(exercise, own, solution)), tried


def is_right(exercise: Exercise, answer: object) -> bool:
    """Whether an answer is right; no reply is looked for.

    >>> four = Exercise("1", "", "number", "", "4", "", ())
    >>> is_right(four, "2 + 2"), is_right(four, 5)
    (True, False)
    """
    return _is_right(exercise, ANSWER_KINDS[exercise.kind].read(exercise, answer))


def _is_right(exercise: Exercise, own: object) -> bool:
    kind = ANSWER_KINDS[exercise.kind]
    same = kind.same(exercise, own, solution_of(exercise))
    return same or any(kind.same(exercise, own, kind.read(exercise, each)) for each in exercise.also)


def _repair(exercise: Exercise, own: object, fitting: Sequence[WrongAnswer], found: Difference) -> Repair | None:
    """The repair of which a reply speaks: where nothing else explains the answer, and of a system also where its mistake is."""
    if found.explains or any(wrong.says for wrong in fitting) or (fitting and exercise.kind != "system"):
        return None
    repair = repaired(exercise, own, solution_of(exercise))
    return None if fitting and repair and repair.changes > 1 else repair


def _said_of(repair: Repair | None, found: Difference) -> str:
    """What is to be changed, and, if that does not say it, where the answer differs first."""
    if repair is None:
        return found.message
    return repair.said() if not (repair.case and found.at_a_case) else f"{repair.said()} {found.message}"


def shown_by(exercise: Exercise, wrong: object) -> str:
    """What a wrong answer shows, where misconceptions yield it; nothing where none does.

    >>> exercise = Exercise("1", "", "number", "", "5", "", (), system="axiom: a\\na -> ab\\nb -> a", steps=3, asks="length")
    >>> shown_by(exercise, 3), shown_by(exercise, 77)
    ('Did you replace one module in each step, or stop one step too early, or call the axiom step 1?', '')
    """
    fitting = [each for each in wrong_answers(exercise) if _alike(exercise, wrong, each.answer)]
    return _explained(fitting, Difference("")) if fitting else ""


def _parts_right(exercise: Exercise, own: object, solution: object) -> tuple[str, float]:
    """Which parts of a wrong answer are right, in words, and the mark for them: nothing where none is."""
    kind = ANSWER_KINDS[exercise.kind]
    right, all = kind.parts_right(exercise, own, solution) if kind.parts_right else (0, 0)
    return (reply(f"{exercise.kind}.parts", right=right, all=all), right / all) if right else ("", 0)


_PRODUCT = re.compile(r"[\d)]\s*[*^·×]\s*[\d(]")


def _is_worked(exercise: Exercise, answer: object) -> bool:
    """Whether a number is written as a product: then it may have come about otherwise than by the misconception it fits."""
    return exercise.kind == "number" and isinstance(answer, str) and bool(_PRODUCT.search(answer))


def _explained(fitting: Sequence[WrongAnswer], found: Difference, worked: bool = False) -> str:
    """What is said of an answer that one or several misconceptions yield: one is named, several are asked about.

    Where most of the answer is right, it may be a slip of the pen: then one is asked about too, and its place is shown.
    """
    own = next((wrong for wrong in fitting if wrong.says), None)
    several = {wrong.misconception.name: wrong.misconception for wrong in fitting if wrong.misconception}
    others = {name: each for name, each in several.items() if not each.last_resort} or several
    if own is not None:
        others.pop(own.misconception.name if own.misconception else "", None)
        asked = reply("reply.or_did_you", do=_any_of(list(others.values()))) if others else ""
        return f"{own.says.strip()} {asked}".rstrip()
    if found.explains:
        return f"{found.message} {reply('reply.or_did_you', do=_any_of(list(others.values())))}"
    if len(others) == 1:
        only = next(iter(others.values()))
        if found.likeness >= MOST_RIGHT and found.at_a_place and not only.near:
            return f"{_asked([only])} {found.message}"
        if worked:
            return f"{_asked([only])} {gettext(only.but)}".strip()
        return reply("reply.comes_out", do=gettext(only.do), but=gettext(only.but))
    return _asked(list(others.values()))


def _asked(several: Sequence[Misconception]) -> str:
    return reply("reply.did_you", do=_any_of(several))


def _any_of(several: Sequence[Misconception]) -> str:
    return reduce(
        lambda one, other: reply("reply.or", one=one, other=other),
        (gettext(misconception.do) for misconception in several[:MOST_ASKED]),
    )
