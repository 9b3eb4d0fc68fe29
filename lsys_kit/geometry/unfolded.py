"""The scenes between two steps: where strokes are is drawn by the turtle, and how they look goes from one step to the other.

How broad a stroke is, and its natural colour, follow from the whole plant; so they go from those of the mother's stroke to its
own. Natural colours go through the shades of the ramp, and others change in the middle. The panel does the same
(`drawing/unfolded.js`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from lsys_kit.arrays import np
from lsys_kit.derivation.derive import Derivation
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.scene import Floats, Integers, Scene, Segments
from lsys_kit.geometry.turtle.commands import RAMP_END, RAMP_START
from lsys_kit.geometry.turtle.unfolding import WordBetween, word_at_rest, words_between


def scenes_between(
    derivation: Derivation, step: int, angle: float | None = None, colours: str = "", widths: str = ""
) -> Callable[[float], Scene]:
    """The scenes between a step of a derivation and the next, as a function of the part of the way; the rest as for `scene_of`.

    >>> from lsys_kit import derive, read
    >>> between = scenes_between(derive(read("axiom: !(1) F\\n!(w) -> !(w+2)"), 1), 0)
    >>> [between(part).segments.widths.tolist() for part in (0.0, 0.25, 1.0)]
    [[1.0], [1.5], [3.0]]
    """

    def drawn(word: WordBetween) -> Scene:
        return scene_of(word.by_place(), angle, colours, widths)

    words, ends = words_between(derivation, step), tuple(word_at_rest(derivation, each) for each in (step, step + 1))
    begun, done = (_End.of(word, drawn(word)) for word in ends)

    def between(part: float) -> Scene:
        word = words(part)
        scene, looks = drawn(word), np.array([word.looks[number] for number in word.sequence], np.int64)
        segments = _looks_between(scene.segments, looks, (begun, done), (word.mothers, word.later), part)
        polygons = replace(scene.polygons, states=looks[scene.polygons.states])
        discs, labels = scene.discs, replace(scene.labels, states=looks[scene.labels.states])
        discs = replace(discs, states=looks[discs.states])
        return replace(scene, segments=segments, polygons=polygons, discs=discs, labels=labels)

    return between


@dataclass(frozen=True)
class _End:
    """How the strokes of a step look, and for each of its modules which are its first and its last; -1 where it has none."""

    widths: Floats
    colours: Integers
    states: Integers
    first: Integers
    last: Integers

    @staticmethod
    def of(word: WordBetween, scene: Scene) -> _End:
        segments, many = scene.segments, len(word.sequence)
        first, last = np.full((2, many + 1), -1)
        first[segments.states[::-1]] = np.arange(len(segments))[::-1]
        last[segments.states] = np.arange(len(segments))
        widths = np.broadcast_to(segments.widths, len(segments))
        colours = np.broadcast_to(segments.colours, len(segments))
        return _End(widths, colours, np.array(word.looks, np.int64)[segments.states], first, last)

    def strokes(self, places: Integers, nth: Integers) -> Integers:
        """The stroke of each of some modules with a number, or its last; -1 where it has none."""
        found: Integers = np.where(self.first[places] < 0, -1, np.minimum(self.first[places] + nth, self.last[places]))
        return found


def _looks_between(
    segments: Segments, looks: Integers, ends: tuple[_End, _End], places: tuple[Sequence[int], Sequence[int]], part: float
) -> Segments:
    """Strokes whose states are places in a word between, with the looks that they have there."""
    if not len(segments):
        return segments
    own = segments.states
    begins = np.append(True, own[1:] != own[:-1])
    nth = np.arange(len(own)) - np.maximum.accumulate(np.where(begins, np.arange(len(own)), 0))
    pair = [end.strokes(np.array(each, np.int64)[own], nth) for end, each in zip(ends, places, strict=True)]
    sides = [(np.where(at < 0, 1 - number, number), np.where(at < 0, pair[1 - number], at)) for number, at in enumerate(pair)]
    known = np.maximum(*pair) >= 0  # what one step lacks looks as in the other

    def look(name: str) -> list[Floats]:
        rows = np.concatenate([getattr(end, name) for end in ends])
        return [rows[np.where(known, at + side * len(ends[0].states), 0)] for side, at in sides]

    (wide, wider), (one, other), states = look("widths"), look("colours"), look("states")
    widths, colours = (np.broadcast_to(each, len(own)) for each in (segments.widths, segments.colours))
    in_ramp = np.minimum(one, other) >= RAMP_START
    in_ramp &= np.maximum(one, other) <= RAMP_END
    near = 0 if part < 0.5 else 1
    shades = np.where(in_ramp, np.floor(one + part * (other - one) + 0.5).astype(np.int64), (one, other)[near])
    return replace(
        segments,
        states=np.where(known, states[near], looks[own]),
        widths=np.where(known & (np.minimum(wide, wider) >= 0), wide + part * (wider - wide), widths),
        colours=np.where(known, shades, colours),
    )
