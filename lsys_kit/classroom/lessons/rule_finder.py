"""Find the rules: the words of an organism, one step more at a time, and beside them all systems that fit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile

import traitlets

from lsys_kit.budget import Task
from lsys_kit.classroom.lessons.widget import LessonWidget, table_html
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.inference.infer import MOST_FITS, Explanation, conditions_of, explanation, infer
from lsys_kit.derivation.inference.mending import MOST_READ
from lsys_kit.derivation.inference.problem import Row, read_words
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.modules import joined
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import gettext

MOST_CHARACTERS = 400
"""Longer words and productions are cut off here."""


def rule_finder(
    words: Iterable[object], constants: Iterable[str] = ("+", "-"), erasing: bool = False, context: tuple[int, int] = (0, 0)
) -> RuleFinder:
    """The words of an organism up to a step that can be chosen, and beside them all systems that fit.

    A slider goes from step 1 to the last. Where several systems fit, it is shown what each of them says of the step at which
    they part.

    Parameters
    ----------
    words
        The words of steps 0, 1, 2, ...: what `derive` gives, or a list of words, as for `infer`; None is one that is not known.
    constants, erasing, context
        What systems are looked for, as for `infer`.

    Raises
    ------
    ModelLimitError
        The search takes too long.
    ModelValueError
        The words or another argument cannot be used.

    Examples
    --------
    >>> rule_finder(["a", "bc", "caa"])
    step 0: a
    step 1: b c
      One system fits these 2 words:
        a -> b c
      Nothing is known of what becomes of b, c: only the last word has it.
    step 2: c a a
      2 systems fit these 3 words; they part at step 3:
       all have
        a -> b c
       1.
        b -> c
        c -> a a
       2.
        b -> c a
        c -> a
    """
    with Task("The rules were not found"):
        kept = conditions_of(constants, erasing, context).constants
        rows = read_words(words)
        return RuleFinder(rows, [*_all_found(rows, kept, erasing, context)])


@dataclass(frozen=True)
class Found:
    """What the words up to a step tell: how many systems fit, as a text; what is said of them; and where they part, the word
    of each one that is shown, in parts.
    """

    count: str
    said: Explanation
    next_words: tuple[list[str], ...] = ()


class RuleFinder(LessonWidget):
    """The words and the systems that `rule_finder` shows.

    Attributes
    ----------
    step
        The step up to which the words are shown, from 1 on.
    """

    _script_name = "finding"
    found = traitlets.Dict().tag(sync=True)
    step = traitlets.Int(1).tag(sync=True)

    def __init__(self, rows: Sequence[Row], steps: Sequence[Found]) -> None:
        self._words, self._steps = [_cut(joined(map(str, row)) or "ε") for row in rows], steps
        super().__init__(found={"words": self._words, "steps": [_data(each) for each in steps]})

    @traitlets.validate("step")
    def _within(self, proposal: traitlets.Bunch) -> int:
        return max(1, min(len(self._steps), int(proposal["value"])))

    @property
    def page_data(self) -> Data:
        """What a page without a kernel has to know: what is found at every step."""
        return dict(self.found)

    def _stored(self) -> Data:
        rows = ((str(step), f"<code>{escaped(word)}</code>", self._fits_html(step)) for step, word in enumerate(self._words))
        return {"text/html": table_html(("step", "word", "systems that fit"), rows), "text/plain": repr(self)}

    def _fits_html(self, step: int) -> str:
        if not step:
            return ""
        found = self._steps[step - 1]
        own = "".join(f"<li>{_rules_html(each)}</li>" for each in found.said.own)
        return f"<b>{found.count}</b><br>{_rules_html(found.said.common)}" + (f"<ol>{own}</ol>" if own else "")

    def __repr__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        for step, word in enumerate(self._words):
            yield f"step {step}: {word}"
            if step:
                yield from (f"  {line}" for line in str(self._steps[step - 1].said).splitlines())


def _all_found(rows: Sequence[Row], constants: Iterable[str], erasing: bool, context: tuple[int, int]) -> Iterator[Found]:
    """What the words up to each step tell, from step 1 on; where no system fits some words, none fits more of them, and all of
    them together tell what may have to be mended."""
    none = 0
    for step in range(1, len(rows)):
        if none and step < len(rows) - 1:
            said = gettext(
                "No system fits these {number} words, since none fits those up to step {step}.", number=step + 1, step=none
            )
            yield Found("0", Explanation(said))
            continue
        yield (found := _found(rows[: step + 1], constants, erasing, context))
        none = step if found.count == "0" else 0


def _found(rows: Sequence[Row], constants: Iterable[str], erasing: bool, context: tuple[int, int]) -> Found:
    try:
        fits = infer(rows, constants, erasing, context)
    except ModelLimitError as error:
        if error.limit == MOST_READ:
            return Found("?", Explanation(str(error)))
        if error.limit != MOST_FITS:
            raise
        return Found(f"{error.needed:,}" if error.needed else f"more than {MOST_FITS:,}", Explanation(str(error)))
    said = explanation(fits)
    return Found(str(len(fits)), said, tuple(_words_at(fits[: len(said.own)], said.parting)))


def _words_at(systems: Sequence[LSystem], step: int | None) -> Iterator[list[str]]:
    if step is not None:
        yield from (str(derive(system, step)[step]).split(" ") for system in systems)


def _data(found: Found) -> Data:
    same = sum(1 for _ in takewhile(lambda column: len({*column}) == 1, zip(*found.next_words, strict=False)))
    words = [[" ".join([*word[:same], ""]), _cut(" ".join(word[same:]))] for word in found.next_words]
    return {
        "count": found.count,
        "heading": found.said.heading,
        "common": _texts(found.said.common),
        "systems": [_texts(each) for each in found.said.own],
        "more": found.said.more,
        "parting": found.said.parting,
        "words": words,
        "notes": [*found.said.notes],
    }


def _rules_html(productions: Iterable[object]) -> str:
    return "<br>".join(f"<code>{escaped(rule)}</code>" for rule in _texts(productions))


def _texts(productions: Iterable[object]) -> list[str]:
    return [_cut(str(production)) for production in productions]


def _cut(text: str) -> str:
    return text if len(text) <= MOST_CHARACTERS else f"{text[:MOST_CHARACTERS]} ..."
