"""`infer`: all systems that fit a sequence of words, or that draw a sequence of pictures.

Words need no turtle: their rules are found in `derivation`, where more is said. What draws needs one, so that the public
function stands here, as `derive` stands above geometry for systems that look around.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, overload

from lsys_kit.budget import Task, check_budget, counted
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.inference import infer as words_alone
from lsys_kit.derivation.inference.infer import MOST_FITS, Fits, StochasticFits, SystemsFound
from lsys_kit.errors import ModelLimitError, ModelValueError, require
from lsys_kit.geometry.drawing import ANGLE_HINT, drawn_strokes, number_of_strokes
from lsys_kit.geometry.inference.edge_rewriting import edge_rules, factor_of
from lsys_kit.geometry.inference.node_rewriting import node_rules
from lsys_kit.geometry.inference.strokes import LEAST_ANGLE, Strokes, Turning, angle_between, is_drawing, read_drawings
from lsys_kit.geometry.inference.two_symbols import PICTURES, may_have_two_symbols, two_symbol_rules
from lsys_kit.geometry.sameness import normalised, same_strokes
from lsys_kit.geometry.scene import Stroke
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.translation import gettext

MOST_SHOWN = 20
"""So many systems are shown, and compared."""
STEPS_AHEAD, STROKES_AHEAD = 3, 20_000
"""So many steps, and drawings of so many strokes, are looked at to see where systems part."""
SAME_TO = 1e-3
"""How far strokes of a drawing may be off, where it has the size 1."""


@dataclass(frozen=True, repr=False)
class DrawingFits(SystemsFound):
    """The systems that draw a sequence of pictures: a sequence of systems, which prints as an explanation.

    Each was drawn and compared. All strokes must be equally long. If the first picture has strokes, F is the only letter, and
    its successor is a word of F, + and - with brackets; systems without brackets are preferred. If there is none, and the
    first of four or more pictures is one stroke, F_l and F_r become words of equally many F_l and F_r, with + and -: so the
    dragon curve, the Sierpinski arrowhead and Gosper's curve are found (ABOP, figures 1.10 and 1.11). If the first picture is
    empty, an apex X becomes a word of X, F, + and -, and F becomes a row of F: so plants such as the last three of ABOP,
    figure 1.24, are found. Other systems, with f, chance or parameters, are not looked for.

    Attributes
    ----------
    drawings
        The strokes of steps 0, 1, 2, ..., in their own length.
    systems
        The systems, those with the shortest productions first.
    refusal
        Why there is none; empty where there is one.
    """

    drawings: tuple[Strokes, ...]
    systems: tuple[LSystem, ...]
    refusal: str = ""

    def lines(self) -> Iterator[str]:
        many = len(self.drawings)
        if not self:
            none = gettext("No system was found that draws these {number} pictures.", number=many)
            yield f"{none} {self.refusal}".strip()
            return
        if len(self) == 1:
            yield gettext("One system draws these {number} pictures:", number=many)
        elif (step := parting_step(self[:MOST_SHOWN], many)) is None:
            yield gettext(
                "{systems} systems draw these {number} pictures; as far as was looked, later pictures are the same:",
                systems=len(self),
                number=many,
            )
        else:
            text = gettext("{systems} systems draw these {number} pictures; they part at step {step}:")
            yield text.format(systems=len(self), number=many, step=step)
        for number, system in enumerate(self[:MOST_SHOWN], 1):
            yield from [f" {number}."] if len(self) > 1 else []
            yield from (f"  {line}" for line in str(system).splitlines())
        if len(self) > MOST_SHOWN:
            yield gettext(" and {more} more", more=len(self) - MOST_SHOWN)


def parting_step(systems: Sequence[LSystem], start: int) -> int | None:
    """The first step from `start` on at which some systems draw different pictures; None where there is none as far as is
    looked.

    >>> from lsys_kit import read
    >>> parting_step([read("angle: 60\\naxiom: F\\nF -> F+F"), read("angle: 60\\naxiom: F\\nF -> F[+F]")], 0)
    2
    """
    for step in range(start, start + STEPS_AHEAD):
        first = drawn(systems[0], step)
        if first is None:
            return None
        for system in systems[1:]:
            other = drawn(system, step)
            if other is None or not same_strokes(other, first, SAME_TO):
                return step
    return None


def drawn(system: LSystem, step: int) -> list[Stroke] | None:
    """What a system draws, about its centre and of size 1; None where it is too large to be looked at."""
    check_budget()
    try:
        derivation = derive(system, step)
        if derivation.lengths[-1] > STROKES_AHEAD * 10:
            return None
        if number_of_strokes(derivation, step) > STROKES_AHEAD:
            return None
        return normalised(drawn_strokes(derivation[step]))
    except ModelLimitError:
        return None


@overload
def infer(
    words: Iterable[str], constants: Iterable[str] = ..., erasing: bool = ..., context: tuple[int, int] = ...
) -> Fits: ...
@overload
def infer(
    words: Iterable[object],
    constants: Iterable[str] = ...,
    erasing: bool = ...,
    context: tuple[int, int] = ...,
    *,
    stochastic: Literal[True],
) -> StochasticFits: ...
@overload
def infer(
    words: Iterable[object],
    constants: Iterable[str] = ...,
    erasing: bool = ...,
    context: tuple[int, int] = ...,
    *,
    angle: object = ...,
) -> Fits | DrawingFits: ...
def infer(
    words: Iterable[object],
    constants: Iterable[str] = ("+", "-"),
    erasing: bool = False,
    context: tuple[int, int] = (0, 0),
    *,
    angle: object = None,
    stochastic: bool = False,
) -> Fits | DrawingFits | StochasticFits:
    """All systems that fit a sequence of words, or that draw a sequence of pictures; or the stochastic system of derivations.

    Parameters
    ----------
    words
        The words of steps 0, 1, 2, ...: what `derive` gives, or a list of words. A word is a text of one-letter symbols, a
        `Word`, or a row of modules or names. Texts with blanks between letters, or numbers in parentheses behind them, are read
        as `derive` prints words. A word that is not known is None, and a stretch of letters that is not known is written as a
        question mark, as in "ab?ba".
        Or the pictures of these steps, in the plane: what `draw` gives, or the strokes of each as rows of four numbers, x and y
        of one end and of the other. Strokes may be in any order, and begin at either end; a picture may be moved, turned and
        enlarged, but not mirrored.
        Or, of a stochastic system, several such lists of words, one for each derivation.
    constants
        The symbols that stay as they are; contexts pass over them. The brackets [ and ] always do.
    erasing
        Whether a letter may become nothing; of words only.
    context
        How many neighbours to the left and to the right a production may look at; of words only.
    angle
        The turning angle of the pictures in degrees; by default that of which all angles between strokes are multiples.
    stochastic
        Whether letters choose among several successors (S0L). Several derivations of one system are needed then.

    Returns
    -------
    Fits
        The systems, in a sequence that prints as an explanation. It is empty where no system fits, and then says why, and has
        in `mended` the fewest changes of the words with which some system fits.
    StochasticFits
        Of several derivations the system whose successors explain all steps in the fewest bits. Its `choices` are the
        productions, with probabilities of maximum likelihood and their standard errors.
    DrawingFits
        For pictures the systems that draw them, in the same form. Which are looked for is said there.

    Raises
    ------
    ModelLimitError
        More than 1,000 systems fit: `needed` is their number, where it was found without listing them; or the search takes too
        long. `partial` has the systems that were found.
    ModelValueError
        The words, the pictures or another argument cannot be used.

    Examples
    --------
    >>> infer(["a", "ab", "aba"])
    One system fits these 3 words:
      a -> a b
      b -> a
    >>> print(infer(["a", "ab", "abb", "abba"]))
    No system fits these 4 words. Step 3 cannot come from step 2: letter 3 of step 2, b, would have to become b, and there is \
a. A system without contexts would fit if letter 4 of step 3, a, were b. With context=(1, 0) one system fits. One system fits \
the mended words:
      a -> a b

    A step is missing, and one word has a stretch that nobody can read:

    >>> infer(["a", None, "aba", "aba?"])
    One system fits these 4 words:
      a -> a b
      b -> a
    The word of step 1 is a b.
    The word of step 3 is a b a a b.

    A plant from its pictures:

    >>> from lsys_kit import derive
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> plant = derive(read("angle: 30\\naxiom: F\\nF -> F[+F]F"), 3)
    >>> infer([scene_of(plant[step]) for step in range(4)])
    One system draws these 4 pictures:
      angle: 30
      axiom: F
      F -> F[+F]F
    """
    with Task("The search for systems was not finished"):
        given = [*counted(words)] if isinstance(words, list | tuple) else words
        require(stochastic, bool, 'True or False for "stochastic"')
        if stochastic:
            if angle is not None or not (isinstance(context, tuple) and context == (0, 0)):
                raise ModelValueError("Angles and contexts are not for stochastic systems", hint="Leave them out.")
            return words_alone.infer_stochastic(given, constants, erasing)
        return _inferred(given, constants, erasing, context, angle)


def _inferred(
    given: Iterable[object], constants: Iterable[str], erasing: bool, context: tuple[int, int], angle: object
) -> Fits | DrawingFits:
    if isinstance(given, list) and any(map(is_drawing, counted(given))):
        if erasing is not False or not (isinstance(context, tuple) and context == (0, 0)):
            raise ModelValueError("Erasing and contexts are for words, and these are pictures", hint="Leave them out.")
        return _of_drawings(read_drawings(given), angle)
    if angle is not None:
        raise ModelValueError("An angle is for pictures, and these are words", hint="Leave it out.")
    return words_alone.infer(given, constants, erasing, context)


def _of_drawings(drawings: tuple[Strokes, ...], angle: object) -> DrawingFits:
    if len(drawings) < 2:
        raise ModelValueError(
            "Rules are found from two pictures at least; there is one",
            hint="Give the pictures of steps 0, 1, 2, ... in a list.",
        )
    refusal = _refusal(drawings)
    if refusal:
        return DrawingFits(drawings, (), refusal)
    turning = Turning(_angle(angle, drawings))
    found: dict[str, LSystem] = {}
    try:
        for text in _candidates(drawings, turning, found):
            if text not in found and draws(system := read(text), drawings):
                found[text] = system
            if len(found) > MOST_FITS:
                raise ModelLimitError(
                    f"More than {MOST_FITS:,} systems draw these {len(drawings)} pictures",
                    limit=MOST_FITS,
                    hint="Give more steps.",
                )
    except ModelLimitError as error:
        error.partial = _sorted(drawings, found)
        raise
    return _sorted(drawings, found)


def _sorted(drawings: tuple[Strokes, ...], found: dict[str, LSystem]) -> DrawingFits:
    systems = tuple(found[text] for text in sorted(found, key=lambda text: (len(text), text)))
    return DrawingFits(drawings, systems, "" if systems else _why_none(drawings))


def _why_none(drawings: tuple[Strokes, ...]) -> str:
    factor = factor_of(drawings)
    if factor is None:
        return gettext("Their strokes do not stand where a rule for an apex X with F would put them.")
    if may_have_two_symbols(drawings, factor):
        return gettext("Their strokes do not stand where a rule for F, or rules for F_l and F_r, would put them.")
    said = gettext("Their strokes do not stand where a rule for F would put them.")
    if len(drawings) >= PICTURES:
        return said
    return f"{said} {gettext('Rules for F_l and F_r are looked for from {number} pictures on.', number=PICTURES)}"


def _angle(given: object, drawings: tuple[Strokes, ...]) -> float:
    if given is None:
        return angle_between(drawings[:3])
    degrees = real_from(given, "angle", ANGLE_HINT)
    if not LEAST_ANGLE <= degrees <= 180:
        raise ModelValueError(f"The angle is from {LEAST_ANGLE:g} to 180 degrees, not {degrees:g}")
    return degrees


def _refusal(drawings: tuple[Strokes, ...]) -> str:
    if not len(drawings[0]):
        if len(drawings) < 3 or not len(drawings[1]):
            return gettext("Where the first picture is empty, the next two are needed, with strokes.")
    elif factor_of(drawings) is None:
        counts = ", ".join(f"{len(each):,}" for each in drawings)
        return gettext(
            "They have {counts} strokes: a rule that replaces each stroke by so many others multiplies them at each step.",
            counts=counts,
        )
    apart = next((step for step, each in enumerate(drawings[:2]) if len(each) and not each.is_connected), None)
    return "" if apart is None else gettext("The strokes of step {step} do not hang together.", step=apart)


def _candidates(drawings: tuple[Strokes, ...], turning: Turning, found: Collection[str]) -> Iterator[str]:
    """Texts of systems that may draw the pictures; those with two symbols that draw where none was found with one."""
    head = f"angle: {turning.degrees:.10g}\naxiom: "
    factor = factor_of(drawings)
    if factor is not None:
        yield from (f"{head}{axiom}\nF -> {word}" for axiom, word in edge_rules(drawings, turning, factor))
        if not found and may_have_two_symbols(drawings, factor):
            yield from (
                f"{head}F_l\nF_l -> {left}\nF_r -> {right}" for left, right in two_symbol_rules(drawings, turning, factor)
            )
        return
    for word, longer in node_rules(drawings, turning):
        yield f"{head}X\nX -> {word}" + (f"\nF -> {'F' * longer}" if longer > 1 else "")


def draws(system: LSystem, drawings: tuple[Strokes, ...]) -> bool:
    """Whether a system draws some pictures, up to position, turn and size.

    >>> draws(read("axiom: F\\nF -> F+F"), read_drawings([[(0, 0, 0, 1)], [(0, 0, 0, 1), (0, 1, 1, 1)]]))
    True
    """
    for step, wanted in enumerate(drawings):
        mine = drawn(system, step)
        if mine is None or not same_strokes(mine, normalised(wanted.coordinates.tolist()), SAME_TO):
            return False
    return True
