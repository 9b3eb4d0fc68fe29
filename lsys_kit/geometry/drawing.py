"""The scene of a word: a filament, or what a turtle draws, assembled from instances where that pays, else module by module.

The strokes of a plant, that is of a system that branches, have natural colours, from bark to leaves, and widths by the pipe
model, as far as neither the model nor whoever draws says otherwise. Colours follow widths: what is thin is young.
"""

from __future__ import annotations

from dataclasses import replace

from lsys_kit.arrays import np
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.pipe_model import pipe_widths, tips_borne
from lsys_kit.geometry.scene import OWN, Floats, Integers, Scene, Segments, Stroke
from lsys_kit.geometry.turtle.commands import (
    BLOSSOM,
    COMMANDS,
    RAMP_END,
    RAMP_START,
    STROKES,
    DrawingMode,
    Effect,
    commands_of,
    drawing_mode,
    initial_colour,
    instructions,
    is_leaf,
)
from lsys_kit.geometry.turtle.instancing import draw_instanced
from lsys_kit.geometry.turtle.plane import place_path, strokes_in_plane, trace
from lsys_kit.geometry.turtle.space import strokes_in_space, trace_in_space, turtle_after
from lsys_kit.geometry.turtle.surfaces import surfaces_of
from lsys_kit.geometry.turtle.unfolding import WordBetween
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.system import LSystem


def is_plant(system: LSystem) -> bool:
    """Whether the drawing of a system branches.

    >>> from lsys_kit import read
    >>> is_plant(read("axiom: F[+F]")), is_plant(read("axiom: F+F"))
    (True, False)
    """
    branches = any(Effect.OPENS in command.effects for command, _ in commands_of(system))
    return branches and drawing_mode(system) is not DrawingMode.FILAMENT


def has_natural_colours(system: LSystem) -> bool:
    """Whether strokes have natural colours, if they have no others: as the system says, else if it is a plant.

    A plant of several kinds of modules that are interpreted as strokes has theirs, which say what is what, unless its organs
    are surfaces: then strokes are stems. Veins of leaves are none.

    >>> from lsys_kit import read
    >>> organs = "axiom: I[I]\\nI -> I[L]\\ninterpretation:\\nI -> F\\nL -> F"
    >>> [has_natural_colours(read(text)) for text in ("axiom: F[+F]", "axiom: F+F", "colours: natural\\naxiom: F", organs)]
    [True, False, True, False]
    >>> has_natural_colours(read(f"{organs} ~leaf"))
    True
    """
    if system.colours:
        return system.colours == "natural"
    return is_plant(system) and not is_leaf(system) and (bool(surfaces_of(system)) or not _shows_kinds(system))


def _shows_kinds(system: LSystem) -> bool:
    """Whether modules of several kinds are interpreted as strokes."""
    drawing = {
        symbol for symbol, commands in COMMANDS[system.turtle].items() if any(each.action in STROKES for each in commands)
    }
    images = [(rule.predecessor.symbol, {module.symbol for module in flat(rule.successor)}) for rule in system.interpretation]
    interpreted: set[str] = set()
    while more := {symbol for symbol, image in images if image & (drawing | interpreted)} - interpreted:
        interpreted |= more
    return len(interpreted) > 1


def has_pipe_widths(system: LSystem, widths: str = "") -> bool:
    """Whether the widths of strokes are those of the pipe model: where it is a plant that sets none, or whoever draws says so.

    >>> from lsys_kit import read
    >>> [has_pipe_widths(read(text)) for text in ("axiom: F[+F]", "axiom: !(2)F[+F]", "axiom: F+F")]
    [True, False, False]
    """
    if widths:
        return widths == PIPES
    return is_plant(system) and not any(command.action.endswith("width") for command, _ in commands_of(system))


PIPES = "pipes"
"""The word for widths by the pipe model."""


def coloured(scene: Scene, system: LSystem, colours: str = "", widths: str = "") -> Scene:
    """A scene of a system, with widths by the pipe model, where it has these; and in which strokes without a chosen colour have
    natural ones if those of the system have.

    Whoever draws can choose "natural" colours, and "pipes" as widths.

    Where its turtle steps through colours, the farthest step of its polygons, which are leaves, is the last colour of the ramp,
    and what is beyond that is a blossom; where it has none, the last colour is that of the farthest step.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> tree = read("axiom: F[&F[&F]F]F")
    >>> coloured(trace_in_space(derive(tree, 0)[0]), tree).segments.colours.tolist()
    [16, 19, 23, 23, 23]
    """
    if tips := has_pipe_widths(system, widths):
        borne = tips_borne(scene.segments)
        given = pipe_widths(borne, np.ptp(scene.corners, axis=0))
        scene = replace(scene, segments=replace(scene.segments, widths=given))
    if initial_colour(system) == RAMP_START:
        return _stretched(scene)
    if not (colours == "natural" or has_natural_colours(system)):
        return scene
    return _in_natural_colours(scene, _youth_by_tips(borne) if tips else _youth(scene.segments))


def _stretched(scene: Scene) -> Scene:
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    leaf, *others = (int(each.colours.max(initial=RAMP_START)) for each in (polygons, segments, discs))
    most = leaf if leaf > RAMP_START else max(others)
    stretch = (RAMP_END - RAMP_START) / max(min(RAMP_END, most) - RAMP_START, 1)
    return replace(
        scene,
        segments=replace(segments, colours=_along_ramp(segments.colours, stretch)),
        polygons=replace(polygons, colours=_along_ramp(polygons.colours, stretch)),
        discs=replace(discs, colours=_along_ramp(discs.colours, stretch)),
    )


def _along_ramp(colours: Integers, stretch: float) -> Integers:
    there = (colours >= RAMP_START) & (colours <= RAMP_END)
    places = RAMP_START + np.floor((colours - RAMP_START) * stretch + 0.5).astype(np.int64)
    return np.where(there, np.where(places > RAMP_END, BLOSSOM, places), colours)


def _in_natural_colours(scene: Scene, youth: Floats) -> Scene:
    segments = scene.segments
    numbers = RAMP_START + np.floor((RAMP_END - RAMP_START) * youth + 0.5).astype(np.int64)
    return replace(scene, segments=replace(segments, colours=np.where(segments.colours == OWN, numbers, segments.colours)))


def _youth(segments: Segments) -> Floats:
    """How young strokes are, from 0 to 1: the thinner or the farther from the stem."""
    deepest, widest = int(segments.orders.max(initial=0)), float(segments.widths.max(initial=OWN))
    by_order = segments.orders / deepest if deepest else np.ones(len(segments))
    if widest <= 0:
        return by_order
    return np.where(segments.widths == OWN, by_order, 1 - np.sqrt(np.clip(segments.widths / widest, 0, 1)))


def _youth_by_tips(tips: Integers) -> Floats:
    """The same by the tips that they bear, each counting the less, the more there are."""
    most = int(tips.max(initial=1))
    return 1 - np.log(tips) / (np.log(most) or 1.0)


ANGLE_HINT = "An angle is in degrees, as in angle=25.7."
"""What to write where an angle is no number."""


def scene_of(what: Derivation | Word | WordBetween, angle: float | None = None, colours: str = "", widths: str = "") -> Scene:
    """The scene of a word, or of the last word of a derivation.

    what
        A word, perhaps one between two steps; or a derivation, whose last word is often not even built.
    angle
        The turning angle in degrees; by default the system's.
    colours
        Whether strokes without a chosen colour have "natural" ones; by default as the system says.
    widths
        Whether widths are those of the pipe model, "pipes"; by default as the system says.

    >>> from lsys_kit import derive, read
    >>> plant = derive(read("angle: 25.7\\naxiom: F\\nF -> F[+F]F[-F]F"), 7)
    >>> print(scene_of(plant))
    78,125 segments, width 732.47, height 2187
    >>> print(scene_of(plant[2], 90))
    25 segments, width 6, height 9
    """
    return coloured(_scene_of(what, angle), what.states.system, colours, widths)


def turning_angle(given: object, system: LSystem) -> float:
    """The turning angle that a person wants for a system, in degrees; by default the system's.

    >>> from lsys_kit import read
    >>> turning_angle(None, read("angle: 60\\naxiom: F")), turning_angle("51/2", read("axiom: F"))
    (60.0, 25.5)
    """
    return float(system.angle) if given is None else real_from(given, "angle", ANGLE_HINT)


def _scene_of(what: Derivation | Word | WordBetween, angle: float | None) -> Scene:
    system = what.states.system
    turn = float(system.angle) if angle is None else angle
    mode = drawing_mode(system)
    if mode is not DrawingMode.FILAMENT and isinstance(what, Derivation):
        scene = draw_instanced(what, what.steps, turn)
        if scene is not None:
            return scene
    word = what[-1] if isinstance(what, Derivation) else what
    match mode:
        case DrawingMode.FILAMENT:
            assert isinstance(word, Word)
            return filament(word)
        case DrawingMode.PLANE:
            return place_path(trace(word), turn, float(system.heading))
        case DrawingMode.SPACE:
            return trace_in_space(word, turn)


def drawn_strokes(word: Word) -> list[Stroke]:
    """The strokes of a word, one after another, as no arrays are needed for few; none of a filament.

    >>> from lsys_kit import derive, read
    >>> [drawn_strokes(derive(read(text), 0)[0]) for text in ("heading: 0\\naxiom: FfF", "axiom: F/F", "axiom: a")]
    [[(0.0, 0.0, 1.0, 0.0), (2.0, 0.0, 3.0, 0.0)], [(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.0, 0.0, 2.0)], []]
    """
    system = word.states.system
    match drawing_mode(system):
        case DrawingMode.FILAMENT:
            return []
        case DrawingMode.PLANE:
            return strokes_in_plane(word, float(system.angle), float(system.heading))
        case DrawingMode.SPACE:
            return strokes_in_space(turtle_after(word, float(system.angle)))


def number_of_strokes(derivation: Derivation, step: int) -> int:
    """How many strokes a turtle draws at a step, but for those along generalised cylinders; none of a filament.

    >>> from lsys_kit import derive, read
    >>> number_of_strokes(derive(read("axiom: F\\nF -> F[+F]F"), 9), 9)
    19683
    """
    system, counts = derivation.states.system, derivation.counts(step)
    if drawing_mode(system) is DrawingMode.FILAMENT:
        return 0
    found = instructions(interpretations(derivation.states, [*counts]), system.turtle, system.angle)
    return sum(many * sum(each.action in STROKES for each in found[state]) for state, many in counts.items())
