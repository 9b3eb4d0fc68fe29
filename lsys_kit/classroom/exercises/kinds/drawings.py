"""Drawings as answers: a system or a word, judged by what it draws, up to position, turn and size."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from lsys_kit.budget import check_budget
from lsys_kit.classroom.exercises.asked import asked_system, written
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.forms import form_of
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.kinds.systems import typed_rule, unused
from lsys_kit.classroom.exercises.kinds.walks import walks_beside
from lsys_kit.classroom.exercises.kinds.words import read_modules, unnamed_word
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import read_typed, without_comments
from lsys_kit.derivation.derive import Derivation
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.drawing import drawn_strokes, number_of_strokes
from lsys_kit.geometry.sameness import normalised, same_strokes
from lsys_kit.geometry.scene import Stroke
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read
from lsys_kit.worlds.derive import derive

# Stroke by stroke, in the order in which they are drawn


NEAR = 1e-4
"""How far a stroke may be beside another, where the first stroke is 1 long."""


def strokes_that_fit(mine: Sequence[Stroke], wanted: Sequence[Stroke]) -> int:
    """How many of the first strokes of a drawing lie on another one, if its first stroke lies on that one's first.

    Strokes that follow one another straight on count as one line.

    >>> bent, straight = [(0.0, 0, 0, 1), (0, 1, 1, 1)], [(0.0, 0, 0, 1), (0, 1, 0, 2), (0, 2, 1, 2)]
    >>> strokes_that_fit(bent, straight), strokes_that_fit(straight, straight), strokes_that_fit(straight[:1], bent[:0])
    (1, 3, 0)
    """
    if not mine or not wanted:
        return 0
    own, other = _from_the_first(mine), _from_the_first(wanted)
    for number, stroke in enumerate(own):
        check_budget()
        if not _lies_on(stroke, other):
            return number
    return len(own)


def _from_the_first(strokes: Sequence[Stroke]) -> list[tuple[complex, complex]]:
    """Strokes as they stand to the first: it leads from 0 to 1."""
    x, y, u, v = strokes[0]
    start, unit = complex(x, y), complex(u - x, v - y) or 1
    return [((complex(x, y) - start) / unit, (complex(u, v) - start) / unit) for x, y, u, v in strokes]


def _lies_on(stroke: tuple[complex, complex], others: Sequence[tuple[complex, complex]]) -> bool:
    start, end = stroke
    length = abs(end - start)
    if length < NEAR:
        return True
    ahead = (end - start).conjugate() / length
    seen = ((ahead * (one - start), ahead * (other - start)) for one, other in others)
    spans = (sorted((one.real, other.real)) for one, other in seen if abs(one.imag) < NEAR and abs(other.imag) < NEAR)
    reached = 0.0
    for low, high in sorted(spans):
        if low > reached + NEAR:
            break
        reached = max(reached, high)
    return reached >= length - NEAR


# What is drawn


_SYSTEM = re.compile(r"->|=|(?:axiom|omega|ω|angle)\s*:|→|#", re.IGNORECASE)
MOST_STROKES = 5_000
"""The most strokes of a drawing that is compared."""
MOST_FOLLOWED = 500
"""The most strokes of a drawing that is followed stroke by stroke."""


@dataclass(frozen=True)
class Drawn:
    """What was drawn, and from what."""

    derivation: Derivation

    @cached_property
    def strokes(self) -> list[Stroke]:
        """The strokes, in the plane those on one line that touch joined, about their centre and of size 1."""
        return normalised(joined_strokes(self.ends) if self.in_plane else self.ends)

    @cached_property
    def ends(self) -> list[Stroke]:
        """The strokes as they are drawn, in order."""
        many, ends = number_of_strokes(self.derivation, self.derivation.steps), list[Stroke]()
        if many <= MOST_STROKES:
            ends = drawn_strokes(self.derivation[-1])
        if (many := max(many, len(ends))) > MOST_STROKES:  # there may be more along cylinders
            raise ModelValueError(reply("drawing.too_many_strokes", number=f"{many:,}", most=f"{MOST_STROKES:,}"))
        return ends

    @property
    def in_plane(self) -> bool:
        return drawing_mode(self.derivation.states.system) is not DrawingMode.SPACE


def drawn(exercise: Exercise, system: LSystem) -> Drawn:
    """What a system draws at the step that is asked for."""
    return Drawn(derive(system, exercise.steps))


def joined_strokes(strokes: Sequence[Stroke]) -> list[Stroke]:
    """Strokes on one straight line that touch or overlap, as one.

    >>> joined_strokes([(0.0, 0, 0, 1), (0, 1, 0, 2), (0, 5, 0, 4)])
    [(0.0, 0.0, 0.0, 2.0), (0.0, 4.0, 0.0, 5.0)]
    """
    rows: dict[tuple[float, ...], list[tuple[float, float]]] = {}
    size = max(max((abs(at) for stroke in strokes for at in stroke), default=0.0), 1e-300)
    for x, y, u, v in ((at / size for at in stroke) for stroke in strokes):
        length = math.hypot(u - x, v - y)
        if length > 1e-9:
            across, up = _direction((u - x) / length, (v - y) / length)
            key = (round(across, 6) + 0.0, round(up, 6) + 0.0, round(x * up - y * across, 6) + 0.0)
            one, other = x * across + y * up, u * across + v * up
            rows.setdefault(key, []).append((min(one, other), max(one, other)))
    found = (_ends(key, low, high) for key, spans in sorted(rows.items()) for low, high in _merged(sorted(spans)))
    return [tuple(at * size for at in stroke) for stroke in found]


def _direction(across: float, up: float) -> tuple[float, float]:
    return (-across, -up) if up < -1e-7 or (abs(up) <= 1e-7 and across < 0) else (across, up)


def _merged(spans: list[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    low, high = spans[0]
    for start, end in spans[1:]:
        if start > high + 1e-6:
            yield low, high
            low, high = start, end
        high = max(high, end)
    yield low, high


def _ends(key: tuple[float, ...], low: float, high: float) -> list[float]:
    across, up, beside = key
    return [low * across + beside * up, low * up - beside * across, high * across + beside * up, high * up - beside * across]


def _read(exercise: Exercise, answer: object) -> Drawn:
    if isinstance(answer, Derivation):
        return Drawn(answer)
    if isinstance(answer, LSystem):
        return drawn(exercise, answer)
    if isinstance(answer, str) and (not exercise.system or _is_a_system(without_comments(answer, exercise.system))):
        return read_typed(answer, lambda text: drawn(exercise, read(text)), exercise.solution)
    system = asked_system(exercise)
    return Drawn(written(system, read_modules(system, answer, drawn=True)))


def _is_a_system(text: str) -> bool:
    return bool(_SYSTEM.search(unnamed_word(text)))


def _same(exercise: Exercise, mine: Drawn, wanted: Drawn) -> bool:
    return same_strokes(mine.strokes, wanted.strokes, turned=not exercise.drawn) and _unused(mine) is None


def _unused(mine: Drawn) -> Production | None:
    """A production that was typed, and before which another always applies."""
    system = mine.derivation.states.system
    return unused(system) if len(mine.derivation) > 1 and system.source else None


def _alike(exercise: Exercise, mine: Drawn, other: Drawn) -> bool:
    """Whether an answer is a wrong one that is understood, in its form: the same may be drawn by mistake of another kind."""
    own, theirs = mine.derivation, other.derivation
    if len(own) == 1 or len(theirs) == 1:
        return tuple(own[-1]) == tuple(theirs[-1]) and own.states.system.angle == theirs.states.system.angle
    return form_of(own.states.system, drawn=True) == form_of(theirs.states.system, drawn=True)


def _difference(exercise: Exercise, mine: Drawn, wanted: Drawn) -> Difference:
    own, other = len(mine.strokes), len(wanted.strokes)
    never = _unused(mine)
    if not own:
        return Difference(reply("drawing.nothing"), explains=len(mine.derivation) == 1)
    if never is not None and same_strokes(mine.strokes, wanted.strokes, turned=not exercise.drawn):
        said = reply("system.never_used") + typed_rule(never, mine.derivation.states.system)
        return Difference(said, 1, True, explains=True)
    if exercise.drawn and same_strokes(mine.strokes, wanted.strokes):
        return Difference(reply("drawing.turned"), 1, True, explains=True)
    likeness = min(own, other) / max(own, other) / 2 if own != other else 0.6
    if _are_followed(mine, wanted):
        return Difference(_stroke_by_stroke(mine, wanted), likeness, at_a_case=True)
    return Difference(reply("drawing.beside_the_picture"), likeness)


def _are_followed(mine: Drawn, wanted: Drawn) -> bool:
    """Whether two drawings are compared stroke by stroke."""
    return mine.in_plane and wanted.in_plane and max(len(mine.ends), len(wanted.ends)) <= MOST_FOLLOWED


def _first_difference(mine: Drawn, wanted: Drawn) -> tuple[int, list[Stroke]]:
    """How many of the first strokes of a drawing are right, and the right ones, mirrored where that fits better."""
    other: list[Stroke] = [(-x, y, -u, v) for x, y, u, v in wanted.ends]
    rights = [wanted.ends]
    if same_strokes(normalised(joined_strokes(other)), wanted.strokes):
        rights.append(other)  # the picture is its own mirror image
    return max(((strokes_that_fit(mine.ends, each), each) for each in rights), key=lambda each: each[0])


def _stroke_by_stroke(mine: Drawn, wanted: Drawn) -> str:
    """Where a drawing first leaves the right one, if both begin with the same stroke."""
    fitting, right = _first_difference(mine, wanted)
    if fitting < len(mine.ends):
        where = "drawing.wrong_from_the_start" if fitting < 2 else "drawing.wrong_stroke"
        return reply(where, fitting=fitting, number=fitting + 1)
    missing = strokes_that_fit(right, mine.ends) < len(right)
    return reply("drawing.missing_strokes" if missing else "drawing.other_strokes")


def _walks(_: Exercise, mine: Drawn, wanted: Drawn) -> str:
    """The turtle of an answer beside the right one, each as far as its first stroke that the other has not drawn.

    Where the answer is a word, each stroke is a letter of it: then no stroke is shown but those that were typed.
    """
    if not mine.ends or not wanted.ends or not _are_followed(mine, wanted):
        return ""
    fitting, right = _first_difference(mine, wanted)
    own, wanted_rows = _from_the_first(mine.ends), _from_the_first(right)
    if fitting == len(own) and not strokes_that_fit(right, mine.ends) < len(right):
        return ""  # they differ in nothing that a walk shows
    is_word = len(wanted.derivation) == 1
    missing = next((number for number, each in enumerate(wanted_rows) if not _lies_on(each, own[:fitting])), None)
    x, y, u, v = mine.ends[0]
    ahead = complex(u - x, v - y) / (math.hypot(u - x, v - y) or 1)
    seen, right_seen = ([(ahead * start, ahead * end) for start, end in rows] for rows in (own, wanted_rows))
    return walks_beside(seen, fitting, None if is_word else right_seen, missing)


def _honest(_: Exercise, mine: Drawn, wanted: Drawn) -> bool:
    """More than one stroke, or half as many letters as the solution has: they may be small, or lack their brackets."""
    own, right = (sum(module.symbol.isalpha() for module in each.derivation[-1]) for each in (mine, wanted))
    return len(mine.strokes) > 1 or 2 * own >= right


DRAWING = AnswerKind(_read, _difference, _same, _honest, alike=_alike, picture=_walks)
