"""What a system looks like at a step, for given constants: computed once and kept.

The part of the explorer that knows no widgets: it turns settings into a word, a net with its tokens, and a picture.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from lsys_kit.derivation.derive import Derivation, derive
from lsys_kit.derivation.interpret import is_filament
from lsys_kit.derivation.stages import Stages, stages
from lsys_kit.derivation.words import Word, shortened
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.turtle import Path, placed, traced
from lsys_kit.notation.arithmetic import Value
from lsys_kit.notation.model import LSystem
from lsys_kit.pictures.draw import MOST_ROWS, Picture, state_colours
from lsys_kit.pictures.labels import place_text
from lsys_kit.pictures.svg import Row


@dataclass(frozen=True)
class Sight:
    """What there is to see at one step.

    Attributes
    ----------
    step, word
        The step and its word.
    net, tokens
        The stage diagram, and how many modules lie in each place.
    marked
        The states that are marked in the word and in the drawing.
    picture
        The drawing.
    path
        The turtle's path; None for a filament.
    """

    step: int
    word: Word
    net: Stages
    tokens: tuple[int, ...]
    marked: frozenset[int]
    picture: Picture
    path: Path | None

    @property
    def modules(self) -> str:
        """How many modules the word has, in words."""
        return f"{len(self.word):,} module{'s' * (len(self.word) != 1)}"

    def __str__(self) -> str:
        """The sight in words."""
        places = [f"{place_text(place, self.net.system)}: {count:,}"
                  for place, count in zip(self.net.places, self.tokens, strict=True) if place.symbol[0].isalpha()]
        return (f"Step {self.step}: {self.modules}. {shortened(self.word, 160)}. Stages {', '.join(places)}. "
                f"{self.picture.scene}.")


class Study:
    """A system under changing constants: its derivations, nets, scenes and paths, each computed once.

    Parameters
    ----------
    system
        Any L-system.
    seed
        Where chance begins.

    Examples
    --------
    >>> from lsys_kit.classroom.catalogue import system
    >>> print(Study(system("J4")).sight(3, {"lifeTimeB": 5}))
    Step 3: 2 modules. Al(1)Br(1). Stages A(1): 1, A(2): 0, A(3): 0, B(1): 1, B(2): 0, B(3): 0, B(4): 0, B(5): 0. \
2 cells, width 3, height 1.
    """

    def __init__(self, system: LSystem, seed: int | None = None) -> None:
        self.system, self.seed, self.is_filament = system, seed, is_filament(system)
        self._known: dict[tuple[object, ...], tuple[Derivation, Stages]] = {}
        self._rows: dict[tuple[tuple[Value, ...], int], Row] = {}
        self._paths: dict[tuple[tuple[Value, ...], int], Path] = {}

    def known(self, constants: Mapping[str, object]) -> tuple[Derivation, Stages]:
        """The derivation and the net for given constants."""
        key = tuple(constants.items())
        if key not in self._known:
            given: dict[str, Any] = dict(constants)
            self._known[key] = derive(self.system, 0, seed=self.seed, **given), stages(self.system, **given)
        return self._known[key]

    def sight(self, step: int, constants: Mapping[str, object], angle: float | None = None, place: int = -1) -> Sight:
        """What there is to see at a step.

        Parameters
        ----------
        step
            The step.
        constants
            New values for declared constants.
        angle
            Degrees by which `+` and `-` turn; by default the system's.
        place
            The stage that is marked; -1 for none.

        Raises
        ------
        LSystemError
            The step is too large, or a value cannot be computed.
        """
        derivation, net = self.known(constants)
        derivation = derivation.to(step)
        word = derivation[step]
        marked = frozenset(s for s, module in enumerate(word.states.modules) if net.place_of(module) == place)
        if self.is_filament:
            picture, path = Picture(self._sequence(derivation, step), state_colours(derivation), step, marked), None
        else:
            path = self._path(derivation, step)
            scene = placed(path, float(self.system.angle) if angle is None else angle, float(self.system.heading))
            picture = Picture((Row(step, scene),), state_colours(derivation), None, marked)
        return Sight(step, word, net, net.tokens(word), marked, picture, path)

    def _sequence(self, derivation: Derivation, last: int) -> tuple[Row, ...]:
        """The rows of a filament's steps, each made once."""
        constants = derivation.states.constants
        steps = range(max(0, last + 1 - MOST_ROWS), last + 1)
        for step in steps:
            if (constants, step) not in self._rows:
                self._rows[constants, step] = Row(step, filament(derivation[step]))
        return tuple(self._rows[constants, step] for step in steps)

    def _path(self, derivation: Derivation, step: int) -> Path:
        key = derivation.states.constants, step
        if key not in self._paths:
            self._paths[key] = traced(derivation[step])
        return self._paths[key]
