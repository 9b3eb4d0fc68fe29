"""Practice exercises about continuous time: slices of time, and lengths that grow without a jump."""

from __future__ import annotations

from fractions import Fraction
from math import ceil
from random import Random
from typing import NamedTuple

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.practice.drafts import Topic, number_exercise
from lsys_kit.translation import gettext


def _decimal(value: Fraction | int) -> str:
    """A value with few decimals, as one writes it."""
    return f"{float(value):g}"


# Slices


class _Division(NamedTuple):
    """A cell that divides within a slice of time: how long it lives, with which age daughters begin, how long a slice is, and
    in which one the cell divides."""

    life: int
    newborn: Fraction
    slice: Fraction
    slices: int


def _slices(chance: Random, level: int) -> Exercise | None:
    slice_ = Fraction(chance.choice([3, 4, 6, 7, 8, 9, 11, 12, 13, 14]), 10)
    life = 1 if level == 1 else chance.choice([1, 2, 3])
    newborn = Fraction(chance.randint(1, 4), 10) if level > 1 else Fraction(0)
    division = _Division(life, newborn, slice_, ceil(life / slice_))
    left = division.slices * slice_ - life
    if left + newborn >= life or not left or (level > 1 and division.slices < 2):
        return None
    begins = (
        gettext("begins its life with age {newborn}", newborn=_decimal(newborn))
        if newborn
        else gettext("begins its life with age 0")
    )
    question = gettext(
        "A cell divides at the very moment at which it is {life} old. Each of its daughters {begins}. Time "
        "passes in slices of {slice}; the first cell begins with age 0. ",
        life=life,
        begins=begins,
        slice=_decimal(slice_),
    )
    hints = (
        gettext("In which slice does the cell reach the age at which it divides?"),
        gettext("When it divides, a part of the slice is still to come."),
        gettext("In that part the daughters grow older, too."),
    )
    return (_age_of_daughters if level < 3 else _division_of_daughters)(division, question, hints)


def _age_of_daughters(division: _Division, question: str, hints: tuple[str, ...]) -> Exercise | None:
    """How old daughters are at the end of the slice in which their mother divides."""
    life, newborn, slice_, slices = division
    passed = slices * slice_
    return number_exercise(
        question + gettext("How old are its daughters at the end of the slice in which it divides?"),
        passed - life + newborn,
        [
            *(
                [(newborn, gettext("So old they are when they begin. What is left of the slice makes them older."))]
                if newborn
                else [(slice_, gettext("They have not lived through the whole slice, only through what was left of it."))]
            ),
            (passed, gettext("So old the mother would be. What is left of the slice after the division is less.")),
            (
                slice_ + newborn if newborn else life - (slices - 1) * slice_,
                gettext("Only what is left of the slice after the division counts."),
            ),
        ],
        gettext(
            "After {slices} slices {passed} have passed: {late} since the division",
            slices=slices,
            passed=_decimal(passed),
            late=_decimal(passed - life),
        )
        + (gettext(", and {newborn} from the start.", newborn=_decimal(newborn)) if newborn else "."),
        hints,
    )


def _division_of_daughters(division: _Division, question: str, hints: tuple[str, ...]) -> Exercise | None:
    """In which slice daughters divide in their turn."""
    life, newborn, slice_, slices = division
    total, each = ceil((2 * life - newborn) / slice_), ceil((life - newborn) / slice_)
    return number_exercise(
        question + gettext("In which slice do the daughters divide in their turn?"),
        total,
        [
            (slices, gettext("In this one the first cell divides.")),
            (slices + each, gettext("The daughters begin within a slice: they are older at its end than when they began.")),
            (each, gettext("Count from the beginning of the first cell.")),
        ],
        gettext(
            "The daughters divide when {passed} have passed, which is in slice {total}.",
            passed=_decimal(2 * life - newborn),
            total=total,
        ),
        hints,
    )


# Lengths


def _lengths(chance: Random, level: int) -> Exercise | None:
    return (_shares, _other_daughter, _filament)[level - 1](chance)


def _shares(chance: Random) -> Exercise | None:
    short, long = sorted(chance.sample(range(1, 8), 2))
    length = (short + long) * chance.randint(2, 15)
    return number_exercise(
        gettext(
            "A cell is {length} long when it divides. Its daughters are {short} to {long} in length, and nothing jumps: "
            "together they are as long as it was. How long is the shorter daughter?",
            length=length,
            short=short,
            long=long,
        ),
        length * Fraction(short, short + long),
        [
            (Fraction(length, 2), gettext("These would be two halves.")),
            (length * Fraction(short, long), gettext("That is its share of the other daughter. Both together are the whole.")),
            (length * Fraction(long, short + long), gettext("So long is the other daughter.")),
        ],
        gettext("It has {short} of {parts} equal parts of {length}.", short=short, parts=short + long, length=length),
        (
            gettext("Into how many equal parts is the mother divided?"),
            gettext("How many of these parts does the shorter daughter have?"),
            gettext("Check that both daughters together are as long as their mother."),
        ),
    )


def _other_daughter(chance: Random) -> Exercise | None:
    base, life = chance.choice([2, 3, 4, 5]), chance.randint(2, 6)
    age = chance.randint(0, life - 1)
    mother, daughter = base**life, base**age
    return number_exercise(
        gettext(
            "A cell of age t is {base}^t long. It divides at age {life}; the one daughter begins with age {age}. How "
            "long must the other daughter be, so that the filament does not jump in length?",
            base=base,
            life=life,
            age=age,
        ),
        mother - daughter,
        [
            (base ** (life - age), gettext("Ages are subtracted in a quotient of lengths; the lengths of daughters add.")),
            (base * life - base * age, gettext("The base is raised to the age, not multiplied by it.")),
            (mother, gettext("So long is the mother. What does the other daughter leave of it?")),
        ],
        gettext(
            "The mother is {base}^{life} = {mother} long, the one daughter {base}^{age} = {daughter}.",
            base=base,
            life=life,
            mother=mother,
            age=age,
            daughter=daughter,
        ),
        (
            gettext("How long is the mother when she divides?"),
            gettext("How long is the one daughter at her beginning?"),
            gettext("The lengths of both daughters together are that of their mother."),
        ),
    )


def _filament(chance: Random) -> Exercise | None:
    factor, units, first, cells = chance.randint(2, 4), chance.randint(2, 4), chance.randint(2, 9), chance.randint(3, 12)
    return number_exercise(
        gettext(
            "A cell {first} long grows exponentially, in every hour to {factor} times its length, and so do all its "
            "daughters. Divisions change no length. After {units} hours there are {cells} cells. How long is the "
            "filament then?",
            first=first,
            factor=factor,
            units=units,
            cells=cells,
        ),
        first * factor**units,
        [
            (first * factor * units, gettext("It grows in every hour from what there is then: that multiplies.")),
            (first * cells, gettext("Cells are not all as long as the first one was.")),
            (
                first * factor**units * cells,
                gettext("The daughters share the length of their mother; they do not have it each."),
            ),
        ],
        gettext("The number of cells does not matter: {first} * {factor}^{units}.", first=first, factor=factor, units=units),
        (
            gettext("What does a division change in the length of the filament?"),
            gettext("How long is it after one hour?"),
            gettext("In every hour all of it grows by the same factor."),
        ),
    )


OF_TIME = {"slices": Topic("Slices of time", 11, _slices), "lengths": Topic("Without a jump", 12, _lengths)}
"""In the order of the lessons."""
