"""Variants: slightly changed copies of a system, from which the most beautiful can be taken on, as a breeder does.

The changes are small: another angle, a number a little greater, a branch that is copied, left out or turned the other way. What
a variant may be is decided as for any model: it is written, read back, and derived within a limit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from typing import TypeAlias, TypeVar

from lsys_kit.budget import Task, check_budget, current, limits
from lsys_kit.derivation.core.chance import Chance
from lsys_kit.errors import LSystemError, ModelValueError, require, shown
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Number
from lsys_kit.notation.model.modules import CLOSING, OPENING, Item, Pattern, Repeat
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.worlds.derive import derive

_T = TypeVar("_T")
MOST_MODULES = 20_000
"""A variant that grows larger than this is passed over."""
TRIES = 60
"""So many changes are tried for each variant that is asked for."""
_OTHER_WAY = {"+": "-", "-": "+", "&": "^", "^": "&", "\\": "/", "/": "\\"}
_SHARES = (Fraction(4, 5), Fraction(9, 10), Fraction(11, 10), Fraction(6, 5))


def variants(system: LSystem, number: int = 9, *, seed: int = 0) -> tuple[LSystem, ...]:
    """Some slightly changed copies of a system, no two of them the same.

    Parameters
    ----------
    system
        Any L-system.
    number
        How many, from 1 to 100.
    seed
        The seed of the changes: the same seed gives the same variants.

    Returns
    -------
    tuple of LSystem
        As many as asked for, or fewer where a small system has no more.

    Raises
    ------
    ModelValueError
        The number or the seed is not possible.

    Examples
    --------
    >>> plant = read("angle: 25\\nsteps: 3\\naxiom: F\\nF -> F[+F]F[-F]F")
    >>> for variant in variants(plant, 3, seed=1):
    ...     print(variant.productions[0])
    F -> [+F]F[-F]F
    F -> F F[-F]F
    F -> F[+F]F F[-F]F
    """
    require(system, LSystem, "A system")
    if isinstance(seed, bool) or not isinstance(seed, int):
        raise ModelValueError(f"The seed must be a whole number, not {shown(seed)}")
    if isinstance(number, bool) or not isinstance(number, int) or not 1 <= number <= 100:
        raise ModelValueError(f"The number of variants must be a whole number from 1 to 100, not {shown(number)}")
    chance, found = Chance(seed, 0, 0), list[LSystem]()
    with Task("The variants were not all found"):
        for _ in range(number * TRIES):
            check_budget()
            changed = _changed(system, chance)
            if changed is not None and changed not in (system, *found) and (viable := _read_back(changed)):
                found.append(viable)
                if len(found) == number:
                    break
    return tuple(found)


def _changed(system: LSystem, chance: Chance) -> LSystem | None:
    """A copy with one change; None where the change that was drawn is not possible."""
    if chance.unit() < 0.2:
        return replace(system, angle=normalised(round(Fraction(system.angle) * _one_of(chance, _SHARES), 1)))
    if not system.productions:
        return None
    place = _one_of(chance, range(len(system.productions)))
    production = system.productions[place]
    successor = _one_of(chance, _CHANGES)(production.successor, chance)
    if successor is None:
        return None
    productions = [*system.productions]
    productions[place] = replace(production, successor=successor)
    with suppress(LSystemError):
        return replace(system, productions=tuple(productions))
    return None


def _one_of(chance: Chance, choices: Sequence[_T]) -> _T:
    return choices[int(chance.unit() * len(choices))]


def _read_back(system: LSystem) -> LSystem | None:
    """The system as it is written, if its derivation stays within the limit and does not die."""
    try:
        written = read(str(system), system.notation)
        with limits(modules=min(MOST_MODULES, current().modules)):
            word = derive(written, system.steps if system.steps is not None else 5)[-1]
    except LSystemError:
        return None
    return written if len(word) > 1 else None


# --- changes of a successor -------------------------------------------------------------------------------------------

Successor: TypeAlias = tuple[Item, ...]


def _parts(items: Successor) -> list[tuple[int, int]]:
    """Where its letters outside of branches and its whole branches stand: from and to."""
    parts, opened = list[tuple[int, int]](), list[int]()
    for place, item in enumerate(items):
        symbol = item.symbol if isinstance(item, Pattern) else ""
        if symbol in OPENING:
            opened.append(place)
        elif symbol in CLOSING:
            if opened and not opened[1:]:
                parts.append((opened[0], place + 1))
            del opened[-1:]
        elif not opened and symbol[:1].isalpha():
            parts.append((place, place + 1))
    return parts


def _copied(items: Successor, chance: Chance) -> Successor | None:
    """A module or a branch stands there twice, the second time elsewhere."""
    parts = _parts(items)
    if not parts:
        return None
    start, stop = _one_of(chance, parts)
    at = _one_of(chance, [end for _, end in parts])
    return (*items[:at], *items[start:stop], *items[at:])


def _left_out(items: Successor, chance: Chance) -> Successor | None:
    parts = [(start, stop) for start, stop in _parts(items) if stop - start < len(items)]
    if not parts:
        return None
    start, stop = _one_of(chance, parts)
    return (*items[:start], *items[stop:])


def _other_way(items: Successor, chance: Chance) -> Successor | None:
    turns = [place for place, item in enumerate(items) if isinstance(item, Pattern) and item.symbol in _OTHER_WAY]
    if not turns:
        return None
    place = _one_of(chance, turns)
    turn = items[place]
    assert isinstance(turn, Pattern)
    return (*items[:place], replace(turn, symbol=_OTHER_WAY[turn.symbol]), *items[place + 1 :])


def _branched(items: Successor, chance: Chance) -> Successor | None:
    """A module stands on a branch of its own."""
    places = [place for place, item in enumerate(items) if isinstance(item, Pattern) and item.symbol[0].isalpha()]
    if not places:
        return None
    place, turn = _one_of(chance, places), Pattern(_one_of(chance, "+-"))
    return (*items[:place], Pattern("["), turn, items[place], Pattern("]"), *items[place + 1 :])


def _other_number(items: Successor, chance: Chance) -> Successor | None:
    numbers = [number for item in items for number in _numbers_in(item) if number.value]
    if not numbers:
        return None
    chosen = _one_of(chance, numbers)
    other = Number(_near(chosen.value, chance))
    return tuple(_with_number(item, chosen, other) for item in items)


def _near(value: Value, chance: Chance) -> Value:
    if isinstance(value, int):
        return max(1, value + _one_of(chance, (-1, 1)))
    return normalised(Fraction(f"{float(value * _one_of(chance, _SHARES)):.3g}"))


def _numbers_in(part: Item | Expression) -> Iterator[Number]:
    match part:
        case Number():
            yield part
        case Apply():
            inside: Sequence[Item | Expression] = part.operands
        case Pattern():
            inside = part.arguments
        case Repeat():
            inside = part.body
        case _:
            return
    if not isinstance(part, Number):
        for each in inside:
            yield from _numbers_in(each)


def _with_number(item: Item, old: Number, new: Number) -> Item:
    """The same with another number in place of one, which is known by its identity."""

    def put(expression: Expression) -> Expression:
        if expression is old:
            return new
        if isinstance(expression, Apply):
            return replace(expression, operands=tuple(map(put, expression.operands)))
        return expression

    if isinstance(item, Repeat):
        return replace(item, body=tuple(_with_number(each, old, new) for each in item.body))
    return replace(item, arguments=tuple(map(put, item.arguments)))


_CHANGES: tuple[Callable[[Successor, Chance], Successor | None], ...] = (
    _copied,
    _left_out,
    _other_way,
    _branched,
    _other_number,
    _other_number,
)
