"""What a system looks like at a step, for given constants; each is computed once.

The part of the explorer without widgets: it turns settings into a word, a net with its tokens, and a picture.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from lsys_kit.cache import Cache
from lsys_kit.classroom.panel.books.net import Unfolding, net_of
from lsys_kit.derivation.core.words import Word, abridged
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.natural_colours import coloured
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.commands.mode import DrawingMode, drawing_mode
from lsys_kit.geometry.turtle.plane import Path, place_path, trace
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.draw import MOST_ROWS, filament_picture, state_colours
from lsys_kit.pictures.filaments.folding import FilamentRow
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.rendering.frames import in_units
from lsys_kit.pictures.rendering.view import project_smoothly
from lsys_kit.pictures.style.labels import place_text
from lsys_kit.worlds.derive import derive

DERIVATION_BYTES, SHAPE_BYTES = 16 * 2**20, 100
"""About what a derivation and a shape take in memory."""
SHARE = 1 / 8
"""The part of the limit of bytes up to which each kind of result is kept."""


@dataclass(frozen=True)
class StepView:
    """What is shown for one step.

    Attributes
    ----------
    step, word
        The step and its word.
    net, tokens
        The stage diagram, and how many modules lie in each place.
    marked
        The states that are marked in the word and in the drawing.
    scene
        What is drawn, in the plane or in space.
    picture
        The drawing; of a scene in space as it is seen from one side.
    """

    step: int
    word: Word
    net: Stages
    tokens: tuple[int, ...]
    marked: frozenset[int]
    scene: Scene
    picture: Picture

    @property
    def modules(self) -> str:
        """How many modules the word has, in words."""
        return f"{len(self.word):,} module{'s' * (len(self.word) != 1)}"

    @property
    def svg(self) -> str:
        """The drawing as SVG text."""
        return self.picture.svg

    def __str__(self) -> str:
        """The view in words."""
        places = [
            f"{place_text(place, self.net.system)}: {count:,}"
            for place, count in zip(self.net.places, self.tokens, strict=True)
            if place.symbol[0].isalpha()
        ]
        return f"Step {self.step}: {self.modules}. {abridged(self.word, 160)}. Stages {', '.join(places)}. {self.scene}."


class ViewModel:
    """A system under changing constants: its derivations, nets, scenes and paths, each computed once.

    Parameters
    ----------
    system
        Any L-system.
    seed
        The seed of the random numbers.
    unfold
        The symbols that are unfolded in the stage diagram, as for `stages`.

    Examples
    --------
    >>> from lsys_kit.classroom.catalogue import system
    >>> print(ViewModel(system("J4")).sight(3, {"lifeTimeB": 5}))
    Step 3: 2 modules. Al(1)Br(1). Stages A(1): 1, A(2): 0, A(3): 0, B(1): 1, B(2): 0, B(3): 0, B(4): 0, B(5): 0. \
2 cells, width 3, height 1.
    """

    def __init__(self, system: LSystem, seed: int | None = None, unfold: Unfolding = False) -> None:
        self.system, self.seed, self.mode, self._unfold = system, seed, drawing_mode(system), unfold
        self._known = Cache[tuple[object, ...], tuple[Derivation, Stages]](lambda _: DERIVATION_BYTES, SHARE)
        self._rows = Cache[tuple[tuple[Value, ...], int], FilamentRow](lambda row: row.scene.size * SHAPE_BYTES, SHARE)
        self._paths = Cache[tuple[tuple[Value, ...], int], Path](lambda path: len(path.turns) * SHAPE_BYTES, SHARE)
        self._scenes = Cache[tuple[tuple[Value, ...], int, float], Scene](lambda scene: scene.size * SHAPE_BYTES, SHARE)

    def known(self, constants: Mapping[str, object]) -> tuple[Derivation, Stages]:
        """The derivation and the net for given constants."""
        key = tuple(constants.items())
        given: dict[str, Any] = dict(constants)
        return self._known.found(
            key, lambda: (derive(self.system, 0, seed=self.seed, **given), net_of(self.system, given, self._unfold))
        )

    def sight(
        self,
        step: int,
        constants: Mapping[str, object],
        angle: float | None = None,
        place: int = -1,
        around: float = 0.0,
        above: float = 0.0,
    ) -> StepView:
        """What there is to see at a step.

        Parameters
        ----------
        step
            The step.
        constants
            New values for declared constants.
        angle
            Degrees by which the turtle turns; by default the system's.
        place
            The stage that is marked; -1 for none.
        around, above
            From where a scene in space is seen, as `project` counts.

        Raises
        ------
        LSystemError
            The step is too large, or a value cannot be computed.
        """
        derivation, net = self.known(constants)
        derivation = derivation.to(step)
        word = derivation[step]
        marked = frozenset(s for s, module in enumerate(word.states.modules) if net.place_of(module) == place)
        turn = float(self.system.angle) if angle is None else angle
        path = self._path(derivation, step) if self.mode is DrawingMode.PLANE else None
        if self.mode is DrawingMode.FILAMENT:
            rows = self._sequence(derivation, step)
            scene = rows[-1].scene
            picture = filament_picture(derivation, rows, step, marked)
        else:
            scene = (
                coloured(place_path(path, turn, float(self.system.heading)), self.system)
                if path is not None
                else self._scene(derivation, turn)
            )
            [scene] = in_units([scene], self.system)
            [seen] = project_smoothly([scene], (around, above))
            picture = Picture(
                (FilamentRow(step, seen),), state_colours(derivation), None, marked, scene if scene.dimension == 3 else None
            )
        return StepView(step, word, net, net.tokens(word), marked, scene, picture)

    def _sequence(self, derivation: Derivation, last: int) -> tuple[FilamentRow, ...]:
        """The rows of a filament's steps, each made once."""
        constants = derivation.states.constants
        steps = range(max(0, last + 1 - MOST_ROWS), last + 1)
        return tuple(self._rows.found((constants, step), partial(_row, derivation, step)) for step in steps)

    def _path(self, derivation: Derivation, step: int) -> Path:
        key = derivation.states.constants, step
        return self._paths.found(key, lambda: trace(derivation[step]))

    def _scene(self, derivation: Derivation, angle: float) -> Scene:
        """The scene in space of a derivation's last word."""
        key = derivation.states.constants, derivation.steps, angle
        return self._scenes.found(key, lambda: scene_of(derivation, angle))


def _row(derivation: Derivation, step: int) -> FilamentRow:
    return FilamentRow(step, filament(derivation[step]))
