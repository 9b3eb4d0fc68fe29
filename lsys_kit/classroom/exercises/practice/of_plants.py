"""Practice exercises about plants as they grow: strokes, signals, looking, and cutting."""

from __future__ import annotations

from random import Random

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.practice.drafts import (
    OF_BRANCHES,
    OF_ORDER,
    OF_OVERLAPS,
    OF_PICTURES,
    OF_SILENT_LETTERS,
    Topic,
    number_exercise,
    quoted_lines,
    system_text,
)
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.translation import gettext, ngettext

# Strokes


def _strokes(chance: Random, level: int) -> Exercise | None:
    stem = ["F"] * chance.randint(1, 2)
    for _ in range(chance.randint(1, 2)):
        stem += ["[", chance.choice("+-"), "F" if level < 3 else chance.choice("FX"), "]", *["F"] * chance.randint(0, 1)]
    rules = {"F": stem} if level < 3 else {"X": [*stem, "X"], "F": ["F", "F"]}
    axiom = {1: "F", 2: chance.choice(["F F", "F [ + F ] F", "F + F + F"]), 3: "X"}[level]
    system, steps = system_text(axiom, rules), 2 + chance.randint(0, 1)
    found = growth(system_of(system)).counts_of("F", steps)[steps]
    if not 6 < found < 700:
        return None
    return Exercise(
        "",
        "",
        "number",
        gettext(
            "F draws a stroke. How many strokes has the plant of step {steps}?{listing}",
            steps=steps,
            listing=quoted_lines(system),
        ),
        str(found),
        gettext("Strokes at each step: ") + ", ".join(map(str, growth(system_of(system)).counts_of("F", steps))),
        (
            gettext("How many strokes does one stroke become?"),
            gettext("The strokes in brackets count, too, and are replaced in the next step."),
            gettext("Count the strokes of the next step from those of the one before, kind by kind."),
        ),
        system=system,
        asks="count F",
        steps=steps,
        unit="strokes",
        expects=("one step too few",),
        unlikely=(
            *OF_OVERLAPS,
            *OF_ORDER,
            *OF_PICTURES,
            *OF_SILENT_LETTERS,
            *OF_BRANCHES,
            "one production a step",
            "sequential",
            "leftmost only",
            "old word kept",
            "Fibonacci by reflex",
        ),
    )


# Signals


def _flowering(chance: Random, level: int) -> Exercise | None:
    every, through = chance.randint(3, 6), chance.randint(1, 2 + (level > 1))
    starts = every * chance.randint(2, 4 + level) + chance.randint(1, every - 1)
    passed = next((passed for passed in range(60) if (starts + passed * through) // every <= passed), 0)
    day, there = starts + passed * through, starts // every
    if not passed or through >= every:
        return None
    asked = gettext("How many internodes has the axis then?") if level > 2 else gettext("On which day is that?")
    question = gettext(
        "The axis of a plant is without an internode on day 0 and completes one every {every} days. On day "
        "{starts} a signal sets out from the ground. It passes an internode in {through}. When there is no "
        "further internode above it, it is at the apex, which becomes a flower. {asked}",
        every=every,
        starts=starts,
        through=_days(through),
        asked=asked,
    )
    explanation = gettext(
        "On day {starts} there are {there} internodes, but while the signal rises more are made: behind "
        "{passed} internodes, on day {day}, the axis has no more of them.",
        starts=starts,
        there=there,
        passed=passed,
        day=day,
    )
    hints = (
        gettext("How many internodes are there when the signal sets out?"),
        gettext("While it passes them, the axis grows on."),
        gettext("Write down day by day how many internodes there are, and how many the signal has passed."),
    )
    if level > 2:
        return number_exercise(question, passed, _wrong_internodes(there, day, passed), explanation, hints, "internodes")
    return number_exercise(question, day, _wrong_days(starts, there, through, day), explanation, hints)


def _wrong_internodes(there: int, day: int, passed: int) -> list[tuple[int, str]]:
    return [
        (there, gettext("So many there were when the signal set out; while it rises, the axis grows.")),
        (day, gettext("That is the day on which the signal arrives.")),
        (passed + 1, gettext("There is no further internode yet: the signal is at the apex before it is made.")),
    ]


def _wrong_days(starts: int, there: int, through: int, day: int) -> list[tuple[int, str]]:
    return [
        (
            starts + there * through,
            gettext(
                "So long it takes through the internodes of the day on which it sets out. Meanwhile others are made above them."
            ),
        ),
        (day - starts, gettext("So many days the signal is on its way. On which day did it set out?")),
        (starts + through, gettext("It passes more than one internode.")),
    ]


def _days(number: int) -> str:
    return ngettext("one day", "{number} days", number)


# Looking


def _looking(chance: Random, level: int) -> Exercise | None:
    shrinks, steps = (level > 1) * chance.randint(1, 2), chance.randint(4, 5) + 3 * (level == 1)
    first = chance.randint(3, 7) if level == 1 else chance.randint(9, 13)
    lengths = [first - shrinks * step for step in range(steps)]
    limit = chance.randint(first + 1, sum(lengths) - 1)
    looks_first = level < 3 or chance.random() < 0.5
    height, other = _height(lengths, limit, looks_first), _height(lengths, limit, not looks_first)
    shorter = (
        gettext("each one {shrinks} shorter than the one before", shrinks=shrinks) if shrinks else gettext("all equally long")
    )
    looks = (
        gettext("Before it makes one it looks how high it is: if it is at height {limit} or above, it stops.", limit=limit)
        if looks_first
        else gettext("Before it makes one it looks how high it would be then: if that is above {limit}, it stops.", limit=limit)
    )
    return number_exercise(
        gettext(
            "A bud on the ground makes an internode straight upwards in every step, the first one {first} long, "
            "{shorter}. {looks} How high is the bud after {steps} steps?",
            first=first,
            shorter=shorter,
            looks=looks,
            steps=steps,
        ),
        height,
        [
            (sum(lengths), gettext("So high it would be if it did not look.")),
            (limit, gettext("It is not as if an internode were cut off at the limit: it is made as a whole, or not at all.")),
            (other, gettext("When does it look: where it is, or where it would be?")),
        ],
        "Its heights: " + ", ".join(map(str, _heights(lengths, limit, looks_first))) + ".",
        (
            gettext("Write its height before each step."),
            gettext("In each step ask first, then add."),
            gettext("Compare with the limit what the rule speaks of: the height that is, or that will be."),
        ),
    )


def _heights(lengths: list[int], limit: int, looks_first: bool) -> list[int]:
    """The heights of a bud that looks where it is, or where it would be."""
    heights = [0]
    for length in lengths:
        grows = heights[-1] < limit if looks_first else heights[-1] + length <= limit
        heights.append(heights[-1] + length * grows)
    return heights


def _height(lengths: list[int], limit: int, looks_first: bool) -> int:
    return _heights(lengths, limit, looks_first)[-1]


# Cutting


def _hedge(chance: Random, level: int) -> Exercise | None:
    height, lost, buds = chance.randint(5, 9), chance.randint(2, 4), 2 + (level > 1) * chance.randint(0, 1)
    steps = chance.randint(height + lost, height + 5 * lost)
    cuts = sum(1 for step in range(1, steps + 1) if step >= height and (step - height) % lost == 0)
    start = chance.randint(2, 4) if level > 2 else 1
    of = ngettext("one shoot", "{number} shoots", start)
    return number_exercise(
        gettext(
            "A hedge begins with {of}, and each shoot becomes one internode longer in every step. As soon as a shoot has "
            "{height} internodes above the ground it is cut, in the same step: it loses the last {lost}, and below the "
            "cut {buds} buds become shoots, which grow on from there. How many shoots are there after {steps} steps?",
            of=of,
            height=height,
            lost=lost,
            buds=buds,
            steps=steps,
        ),
        start * buds**cuts,
        [
            (start + (buds - 1) * cuts * start, gettext("Each of the new shoots is cut in its turn: that multiplies.")),
            (start * buds ** (steps // height), gettext("After a cut a shoot does not begin at the ground again.")),
            (start * buds ** (cuts - 1), gettext("So many there were before the last cut. In which step is the first one?")),
        ],
        gettext(
            "The first cut is in step {height}, the next ones every {lost} steps: {cuts} cuts, each of which makes "
            "{buds} shoots of one.",
            height=height,
            lost=lost,
            cuts=cuts,
            buds=buds,
        ),
        (
            gettext("In which step is the first cut?"),
            gettext("How long does it take from a cut to the next?"),
            gettext("At each cut all shoots are of the same height, and each becomes several."),
        ),
        "shoots",
    )


# Walls


def _walls(chance: Random, level: int) -> Exercise | None:
    sides, steps = chance.randint(3, 12), level + chance.randint(1, 2)
    neighbours = chance.choice([0, 0, 1]) if level > 1 else 0
    cells, walls = 1 + neighbours, sides + neighbours * (sides - 1)
    begin = (
        gettext("two cells with {sides} walls each, of which they share one", sides=sides)
        if neighbours
        else gettext("one cell with {sides} walls", sides=sides)
    )
    wanted = walls + 3 * cells * (2**steps - 1)
    made = cells * (2**steps - 1)
    return number_exercise(
        gettext(
            "A tissue begins as {begin}. In every step each cell is divided by a new wall. Both ends of a new wall stand "
            "within walls that were there before, each at a place of its own, and cut these in two. How many walls are "
            "there after step {steps}?",
            begin=begin,
            steps=steps,
        ),
        wanted,
        [
            (
                walls + made,
                gettext("So many there are if the new walls alone are counted. But each of their ends cuts a wall in two."),
            ),
            (walls + 3 * cells * steps, gettext("In the next step there are twice as many cells, and all of them divide.")),
            (walls * 2**steps, gettext("Not all walls are cut in two: each new wall cuts two of them.")),
        ],
        gettext(
            "A division adds three walls: the new one, and one more for each of its two ends. There are {made} divisions "
            "up to step {steps}, and {walls} + 3 * {made} = {wanted}.",
            made=made,
            steps=steps,
            walls=walls,
            wanted=wanted,
        ),
        (
            gettext("How many cells divide in the first step, how many in the next?"),
            gettext("What does one division add to the number of walls?"),
            gettext("A wall that is cut becomes two: count that for both ends of the new wall."),
        ),
        "walls",
    )


OF_PLANTS = {
    "strokes": Topic("The strokes of a plant", 0, _strokes),
    "flowering": Topic("A signal on its way", 10, _flowering),
    "looking": Topic("A bud that looks", 14, _looking),
    "hedge": Topic("Cut again and again", 15, _hedge),
    "walls": Topic("The walls of a tissue", 16, _walls),
}
"""In the order of the lessons."""
