"""Which settings of its sliders a page holds: each setting has a book, and there is room for so many.

First come the settings in which one slider alone has left its first value. Where there are too many of them, a slider keeps
fewer of its values, evenly spread, with both ends and whatever is asked for. Then come all settings of several sliders
together, as far as there is room: of those that are asked for together, and then of those with the fewest values.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise, product
from math import prod

from lsys_kit.notation.model.arithmetic import Value, number_text

SEED = ""
"""The seed among the names of sliders: no constant has this name."""
ROW, MOST_ROWS = 9, 4
"""The seeds that are shown beside one another, and how many such rows a page holds at most."""
STRIDES = (2, 5, 10, 20, 50, 100, 200, 500, 1_000, 10**9)
"""Where a page has no room for all values of a slider, it holds every second, every fifth, ..."""
SHARE = 2 / 3
"""The part of the room that the values of single sliders may take."""


@dataclass(frozen=True)
class Choice:
    """What a page may hold of a slider: all of its values, fewer of them, and at last the fewest; and its first value."""

    first: Value
    choices: tuple[tuple[Value, ...], ...]


@dataclass(frozen=True)
class Held:
    """The settings that a page holds: for each slider that moves, its first value and all that it has on the page; and the
    sliders all of whose combinations are there. Each of the others moves while the rest stands at first values.
    """

    first: Mapping[str, Value] = field(default_factory=dict)
    values: Mapping[str, tuple[Value, ...]] = field(default_factory=dict)
    together: tuple[str, ...] = ()

    @property
    def alone(self) -> tuple[str, ...]:
        """The sliders that move one at a time."""
        return tuple(name for name in self.values if name not in self.together)


def constant_choice(values: Sequence[Value], first: Value, asked: Collection[Value] = ()) -> Choice:
    """What a page may hold of the slider of a constant.

    >>> constant_choice(range(1, 9), 3, (7,)).choices
    ((1, 2, 3, 4, 5, 6, 7, 8), (1, 2, 3, 4, 6, 7, 8), (1, 3, 5, 7, 8), (1, 3, 7, 8))
    """
    kept = {values[0], values[-1], first, *asked}
    choices = [tuple(sorted({*values, *kept}))]
    for stride in STRIDES:
        fewer = tuple(sorted({*_every(stride, values), *kept}))
        if len(fewer) < len(choices[-1]):
            choices.append(fewer)
    return Choice(first, tuple(choices))


def _every(stride: int, values: Sequence[Value]) -> Iterator[Value]:
    """Every so many of evenly spaced values: the roundest, where the values are multiples of their distance."""
    numbers = [Fraction(value) for value in values]
    apart = max((after - before for before, after in pairwise(numbers)), default=Fraction(1))
    origin = 0 if numbers[0] % apart == 0 else numbers[0]
    return (value for value, number in zip(values, numbers, strict=True) if (number - origin) % (stride * apart) == 0)


def seed_choice(seed: int, asked: Collection[int] = ()) -> Choice:
    """What a page may hold of the seed: some rows, beginning with the one in which it stands.

    >>> [len(seeds) for seeds in seed_choice(12).choices], seed_choice(12).choices[-1]
    ([36, 27, 18, 9], (9, 10, 11, 12, 13, 14, 15, 16, 17))
    """
    begin = seed // ROW * ROW
    return Choice(seed, tuple(tuple(sorted({*range(begin, begin + ROW * rows), *asked})) for rows in range(MOST_ROWS, 0, -1)))


def fewest(choices: Mapping[str, Choice], most: float) -> Held:
    """The fewest values of each slider, one slider at a time; none of a slider for which there is no room."""
    values: dict[str, tuple[Value, ...]] = {}
    for name, choice in choices.items():
        if _many({**values, name: choice.choices[-1]}) <= most:
            values[name] = choice.choices[-1]
    return Held({name: choices[name].first for name in values}, values)


def planned(choices: Mapping[str, Choice], together: Sequence[str], most: float) -> Held:
    """The settings for which a page has room, of some sliders together if that is asked for; the fewest values of each slider
    are held in any case.

    >>> found = planned({name: constant_choice(range(6), 3) for name in "abc"}, (), 50)
    >>> found.together, found.alone, len([*settings(found)])
    (('a', 'b'), ('c',), 41)
    """
    values = _thinned(choices, together, SHARE * most)
    group = tuple(together)
    for name in sorted(values, key=lambda name: len(values[name])):
        if name not in group and _many(values, (*group, name)) <= most:
            group += (name,)
    first = {name: choices[name].first for name in values}
    return Held(first, values, tuple(name for name in values if name in group) if len(group) > 1 else ())


def settings(held: Held) -> Iterator[dict[str, Value]]:
    """The settings that a page holds, in the order of its books.

    >>> [*settings(Held({"a": 1, "b": 5}, {"a": (1, 2), "b": (4, 5)}))]
    [{'a': 1, 'b': 5}, {'a': 2, 'b': 5}, {'a': 1, 'b': 4}]
    """
    for chosen in product(*(held.values[name] for name in held.together)):
        yield {**held.first, **dict(zip(held.together, chosen, strict=True))}
    for name in held.alone:
        yield from ({**held.first, name: value} for value in held.values[name] if value != held.first[name])


def _thinned(choices: Mapping[str, Choice], together: Sequence[str], most: float) -> dict[str, tuple[Value, ...]]:
    """The values of the sliders: first fewer seeds, and then of the longest sliders fewer and fewer until there is room."""
    left = {name: [*choice.choices] for name, choice in choices.items()}
    while _many({name: each[0] for name, each in left.items()}, together) > most:
        coarser = [name for name, each in left.items() if len(each) > 1]
        if not coarser:
            break
        left[max(coarser, key=lambda name: (name == SEED, len(left[name][0])))].pop(0)
    return {name: each[0] for name, each in left.items()}


def _many(values: Mapping[str, Sequence[Value]], together: Collection[str] = ()) -> int:
    alone = (len(each) - 1 for name, each in values.items() if name not in together)
    return prod(len(values[name]) for name in together) + sum(alone)


def held_text(fixed: Mapping[str, Value], held: Held, all_values: Mapping[str, Sequence[Value]]) -> str:
    """What a page says of its sliders: what does not move, and how the others move, given the values that they have with a
    kernel.

    >>> found = Held({"a": 1, "b": 5, SEED: 0}, {"a": (1, 2), "b": (4, 5), SEED: tuple(range(9))})
    >>> held_text({"k": 2}, found, {"a": range(1, 1001), "b": (4, 5)})
    'Fixed on this page: k = 2. It holds 2 of the 1,000 values of a and the seeds 0 to 8. a, b and seed move one at a time: \
    the other sliders then go back to their first values.'
    """
    fewer = [
        f"{len(each):,} of the {len(all_values[name]):,} values of {name}"
        for name, each in held.values.items()
        if name != SEED and len(each) < len(all_values[name])
    ]
    seeds = _seeds_text(held.values[SEED]) if SEED in held.values else ()
    holds = [f"{'It' if fixed else 'This page'} holds {_listed([*fewer, *seeds])}."] if fewer or seeds else []
    return " ".join((*fixed_text(fixed, "Fixed on this page"), *holds, *_alone_text(held)))


def _seeds_text(seeds: Sequence[Value]) -> Iterator[str]:
    whole = len(seeds) == int(seeds[-1]) - int(seeds[0]) + 1
    yield f"the seeds {number_text(seeds[0])} to {number_text(seeds[-1])}" if whole else f"{len(seeds)} seeds"


def fixed_text(fixed: Mapping[str, Value], said: str = "Fixed") -> Iterator[str]:
    """What does not move, if there is anything.

    >>> [*fixed_text({"t": 1, "k": 2})], [*fixed_text({})]
    (['Fixed: t = 1, k = 2.'], [])
    """
    values = [f"{slider_name(name)} = {number_text(value)}" for name, value in fixed.items()]
    if values:
        yield f"{said}: {', '.join(values)}."


def _alone_text(held: Held) -> Iterator[str]:
    names = [slider_name(name) for name in held.alone]
    if names and len(held.values) > 1:
        moves = f"{_listed(names)} move one at a time" if len(names) > 1 else f"{names[0]} moves alone"
        yield f"{moves}: the other sliders then go back to their first values."


def slider_name(name: str) -> str:
    """What a slider is called."""
    return "seed" if name == SEED else name


def _listed(texts: Sequence[str]) -> str:
    return " and ".join((", ".join(texts[:-1]), texts[-1])) if len(texts) > 1 else texts[0]
