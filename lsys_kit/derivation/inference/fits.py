"""The systems that fit a sequence of words, and what can be said of them in words."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import overload

from lsys_kit.budget import Task, check_budget
from lsys_kit.derivation.derive import Derivation, derive
from lsys_kit.derivation.inference.problem import Conditions, Row
from lsys_kit.derivation.inference.refusals import Contradiction, Slip
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.system import LSystem, Production

MOST_SHOWN = 20
"""So many systems are shown, and so many letters named."""
MOST_SLIPS_SHOWN = 6
"""So many slips are shown."""
MOST_COMPARED, STEPS_AHEAD, MODULES_AHEAD = 100, 10, 100_000
"""So many systems, steps, and words of so many modules, are looked at to see where systems part."""


@dataclass(frozen=True)
class Wider:
    """Wider conditions under which systems fit: how many do (None where they were not counted), how many letters there are,
    each with its neighbours, and how many of them become different words in these systems."""

    conditions: Conditions
    systems: int | None
    letters: int = 0
    left_open: int = 0

    def __str__(self) -> str:
        count = (
            "many systems fit"
            if self.systems is None
            else "one system fits"
            if self.systems == 1
            else f"{self.systems:,} systems fit"
        )
        contexts = self.conditions.context != (0, 0)
        choices = [f"context={self.conditions.context}"] * contexts + ["erasing=True"] * self.conditions.erasing
        said = f"With {', '.join(choices)} {count}"
        if not self.left_open:
            return f"{said}."
        apart = ", told apart by their neighbours," if contexts else ""
        return f"{said}: of {self.letters} letters{apart} {self.left_open} can become different words."


@dataclass(frozen=True)
class Refusal:
    """Why no system fits: the first step that cannot come from the one before, if it was found; single letters that may be
    wrong, missing or too many, and neighbours that may have changed places; where there are none, the steps whose words alone
    contradict the others; and contexts with which some system fits."""

    contradiction: Contradiction | None
    slips: tuple[Slip, ...] = ()
    doubtful: tuple[int, ...] = ()
    wider: Wider | None = None

    def __str__(self) -> str:
        slips = [str(slip) for slip in self.slips[:MOST_SLIPS_SHOWN]]
        found = [str(self.contradiction)] if self.contradiction else []
        if slips:
            more = len(self.slips) - len(slips)
            slips += [f"one of {more} other changes were made" if more > 1 else "one other change were made"] if more else []
            found.append(f"A system without contexts would fit if {', or if '.join(slips)}.")
        if self.doubtful:
            steps = " or ".join(map(str, self.doubtful))
            found.append(f"A system without contexts would fit if the word of step {steps} were another.")
        if self.wider:
            found.append(str(self.wider))
        return " ".join(found)


class SystemsFound(Sequence[LSystem]):
    """Systems in a sequence that prints as an explanation."""

    systems: tuple[LSystem, ...]

    def __len__(self) -> int:
        return len(self.systems)

    @overload
    def __getitem__(self, index: int) -> LSystem: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[LSystem]: ...
    def __getitem__(self, index: int | slice) -> LSystem | Sequence[LSystem]:
        return self.systems[index]

    @abstractmethod
    def lines(self) -> Iterator[str]:
        """The explanation, line by line."""

    def __repr__(self) -> str:
        with Task("The explanation was not finished"):
            return "\n".join(self.lines())


@dataclass(frozen=True, repr=False)
class Fits(SystemsFound):
    """All systems that fit a sequence of words: a sequence of systems, which prints as an explanation.

    Attributes
    ----------
    words
        The words of steps 0, 1, 2, ...
    systems
        The systems: each derives the words exactly.
    conditions
        What systems were looked for.
    refusal
        Why there is none; None where there is one.
    """

    words: tuple[Row, ...]
    systems: tuple[LSystem, ...]
    conditions: Conditions
    refusal: Refusal | None = None

    def lines(self) -> Iterator[str]:
        """The explanation, line by line."""
        yield str(explanation(self))


@dataclass(frozen=True)
class Explanation:
    """What is said of the systems that fit: how many do, or why none does; the productions that all of them have, and the other
    ones of each of the first systems; how many are not shown; the first step at which they have different words, if it was
    found; and what the words leave open."""

    heading: str
    common: tuple[Production, ...] = ()
    own: tuple[tuple[Production, ...], ...] = ()
    more: int = 0
    parting: int | None = None
    notes: tuple[str, ...] = ()

    def __str__(self) -> str:
        if not self.common and not self.own:
            return self.heading
        lines = [f"{self.heading}:"]
        if self.common:
            lines += [*([" all have"] if self.own else []), *_lines(self.common, "  ")]
        for number, productions in enumerate(self.own, 1):
            lines += [f" {number}.", *_lines(productions, "  ")]
        return "\n".join([*lines, *([f" and {self.more} more"] if self.more > 0 else []), *self.notes])


def explanation(fits: Fits) -> Explanation:
    """What is said of the systems that fit.

    >>> from lsys_kit.derivation.inference.infer import infer
    >>> explained = explanation(infer(["a", "bc", "caa"]))
    >>> explained.heading, explained.parting
    ('2 systems fit these 3 words; they part at step 3', 3)
    """
    if fits.refusal is not None:
        return Explanation(f"No system fits these {len(fits.words)} words. {fits.refusal}".strip())
    common = tuple(rule for rule in fits[0].productions if all(rule in system.productions for system in fits))
    if len(fits) == 1:
        return Explanation(f"One system fits these {len(fits.words)} words", common, notes=tuple(_unknown(fits)))
    step = parting_step(fits[:MOST_COMPARED], len(fits.words))
    later = (
        "as far as was looked, later words are the same"
        if step is None
        else f"they part {'at' if step == len(fits.words) or len(fits) <= MOST_COMPARED else 'by'} step {step}"
    )
    own = tuple(tuple(rule for rule in system.productions if rule not in common) for system in fits[:MOST_SHOWN])
    return Explanation(
        f"{len(fits)} systems fit these {len(fits.words)} words; {later}",
        common,
        own,
        max(0, len(fits) - MOST_SHOWN),
        step,
        tuple(_unknown(fits)),
    )


def _lines(productions: Sequence[Production], margin: str) -> Iterator[str]:
    return (f"{margin}{production}" for production in productions)


def _unknown(fits: Fits) -> Iterator[str]:
    """What the words leave open: what becomes of letters of the last word alone, and where a threshold lies exactly."""
    if any(rule.condition is not None for system in fits for rule in system.productions):
        yield "The number that a condition compares with could lie anywhere between the values that occur on its two sides."
    before = {module.symbol for word in fits.words[:-1] for module in word} | fits.conditions.unchanged
    unknown = [*dict.fromkeys(module.symbol for module in fits.words[-1] if module.symbol not in before)]
    if unknown:
        more = f" and {len(unknown) - MOST_SHOWN} more" if len(unknown) > MOST_SHOWN else ""
        yield f"Nothing is known of what becomes of {', '.join(unknown[:MOST_SHOWN])}{more}: only the last word has it."


def parting_step(fits: Sequence[LSystem], start: int) -> int | None:
    """The first step from `start` on at which some systems have different words; None where there is none as far as is looked.

    >>> from lsys_kit import read
    >>> parting_step([read("axiom: a\\na -> a b"), read("axiom: a\\na -> a b\\nb -> a")], 1)
    2
    """
    first, found = derive(fits[0], 0), None
    for system in fits[1:]:
        other, step = derive(system, 0), start
        most = start + STEPS_AHEAD if found is None else found - 1
        while step <= most and _small(first, step) and _small(other, step):
            check_budget()
            if first.to(step)[step] != other.to(step)[step]:
                found = step
                break
            step += 1
    return found


def _small(derivation: Derivation, step: int) -> bool:
    try:
        return derivation.to(step).lengths[step] <= MODULES_AHEAD
    except ModelLimitError:
        return False
