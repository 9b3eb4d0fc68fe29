"""Which words are drawn: the last of a derivation, or those of some steps and seeds, each with a caption."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.errors import ModelLimitError, ModelValueError, shown, whole_number
from lsys_kit.notation.model.system import USUAL_STEPS, LSystem
from lsys_kit.worlds.derive import derive

MOST = 36
"""The greatest number of words in a picture."""


class ChosenWord(NamedTuple):
    """A word, or a derivation whose last word is drawn; its step and its seed; and what stands below it, if it is not alone."""

    word: Derivation | Word
    step: int
    seed: int | None = None
    caption: str = ""


def numbers_from(value: object, name: str) -> tuple[int, ...]:
    """Some whole numbers from what a person gives.

    >>> numbers_from([4, 6, 8], "steps")
    (4, 6, 8)

    Raises
    ------
    ModelValueError
        They are no whole numbers, or too many.
    """
    if not isinstance(value, Sequence) or isinstance(value, str):
        raise ModelValueError(f'"{name}" takes a list of whole numbers, not {shown(value)}')
    if len(value) > MOST:
        raise ModelLimitError(f"A picture shows {MOST} drawings at most, not {len(value):,}", limit=MOST, needed=len(value))
    return tuple(whole_number(each, f'A number of "{name}"') for each in value)


def chosen_words(
    what: LSystem | Derivation | Word, n: int | None, steps: Sequence[int], seeds: Sequence[int], choices: Mapping[str, Any]
) -> list[ChosenWord]:
    """The words that are drawn.

    Parameters
    ----------
    what, n
        As for `draw`.
    steps, seeds
        Each of these steps is drawn for each of these seeds; by default the last step, and one seed.
    choices
        As for `derive`.

    Raises
    ------
    ModelValueError
        The steps or seeds of a derivation or a word are fixed already.
    ModelLimitError
        There are too many.
    """
    if len(steps) * len(seeds) > MOST:
        needed = len(steps) * len(seeds)
        raise ModelLimitError(f"A picture shows {MOST} drawings at most, not {needed:,}", limit=MOST, needed=needed)
    if seeds and (not isinstance(what, LSystem) or choices.get("seed") is not None):
        raise ModelValueError("Seeds are chosen when a system is derived", hint="Give either seed=1 or seeds=[1, 2, 3].")
    if steps and (isinstance(what, Word) or n is not None):
        raise ModelValueError("Steps are chosen by n or by steps, and a word has none", hint="Give steps=[4, 6, 8] alone.")
    choices = {name: value for name, value in choices.items() if value is not None}
    last = max(steps) if steps and isinstance(what, LSystem) else n
    own = choices.pop("seed", None)
    rows = [(seed, derivation_of(what, last, seed=own if seed is None else seed, **choices)) for seed in seeds or (None,)]
    return [_chosen(word, step, seed) for seed, word in rows for step in steps or (None,)]


def _chosen(word: Derivation | Word, step: int | None, seed: int | None) -> ChosenWord:
    """A word with its caption."""
    if step is not None:
        assert isinstance(word, Derivation)
        if step > word.steps:
            raise ModelValueError(f"Step {step} has not been derived", hint=f"The last step is {word.steps}.")
        word = word.to(step)
    number = word.steps if isinstance(word, Derivation) else 0
    names = [f"seed {seed}"] * (seed is not None) + [f"step {step}"] * (step is not None)
    return ChosenWord(word, number, seed, ", ".join(names))


def derivation_of(what: LSystem | Derivation | Word, n: int | None, **choices: Any) -> Derivation | Word:
    """The derivation of a system; a derivation or word unchanged, because its steps are fixed already."""
    if isinstance(what, LSystem):
        return derive(what, n if n is not None else what.steps if what.steps is not None else USUAL_STEPS, **choices)
    if n is not None or choices.keys() - {"seed", "arithmetic"}:
        raise ModelValueError("Steps and constants are chosen when a system is derived, not when a word is drawn")
    return what
