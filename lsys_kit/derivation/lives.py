"""Lives: the stretches into which the ages at which modules begin part the lives of a timed system's modules.

Where a long cell begins at the age at which a short one has become as long, as in seed 002, the life of a short cell has two
stretches: a module that has reached the second is a long cell. So every module lies in just one stretch, whatever its age.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

from lsys_kit.derivation.fates import Fate
from lsys_kit.derivation.rules import kind_of
from lsys_kit.derivation.timed import Timed
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.arithmetic import Value, number_text
from lsys_kit.notation.model import Module

_Kind: TypeAlias = tuple[str, tuple[object, ...]]
"""A symbol with all values but the age."""
_Age: TypeAlias = tuple[Value, ...]
"""An age; nothing for a module without parameters."""


@dataclass(frozen=True)
class Lives:
    """The stretches of all lives.

    Attributes
    ----------
    modules
        For each stretch its module at its first age.
    fates
        For each stretch what it becomes, and after how long: the next stretch, or the daughters.
    """

    modules: tuple[Module, ...]
    fates: tuple[tuple[Fate, ...], ...]
    _first: Mapping[_Kind, tuple[int, Sequence[_Age]]]

    def stretch(self, module: Module) -> int | None:
        """The number of the stretch in which a module is at its age."""
        kind, age = _parted(module)
        if kind not in self._first:
            return None
        number, ages = self._first[kind]
        return number + max(0, bisect_right(ages, age) - 1)


def lives(growing: Timed, limit: int) -> Lives:
    """The stretches of a timed system's lives.

    Raises
    ------
    ModelLimitError
        They are more than `limit`.
    ModelValueError
        An age is not known, or a module begins older than it divides.

    Examples
    --------
    >>> from lsys_kit.derivation.timed import timed
    >>> from lsys_kit.notation.read import read
    >>> found = lives(timed(read("axiom: M(0)\\nM(1) -> M(0) M(1/5)")), 9)
    >>> for module, (fate,) in zip(found.modules, found.fates):
    ...     print(module, fate.span, *(found.modules[state] for state in fate.successor))
    M(0) 1/5 M(0.2)
    M(0.2) 4/5 M(0) M(0.2)
    """
    try:
        return _stretched(growing, _first_ages(growing, limit))
    except TypeError:
        raise ModelValueError("How long a module lives depends on a constant that is not known",
                              hint="Choose a value for it: timed(system, name=value).") from None


def _parted(module: Module) -> tuple[_Kind, _Age]:
    return (module.symbol, module.arguments[1:]), module.arguments[:1]  # type: ignore[return-value]


def _first_ages(growing: Timed, limit: int) -> dict[_Kind, set[_Age]]:
    """For each kind of module the ages at which some begin."""
    found: dict[_Kind, set[_Age]] = {}
    todo = [growing.states.modules[state] for state in growing.states.axiom][::-1]
    while todo:
        module = todo.pop()
        kind, age = _parted(module)
        if age in found.setdefault(kind, set()):
            continue
        found[kind].add(age)
        if sum(map(len, found.values())) > limit:
            raise ModelLimitError(f"Modules begin at more than {limit} different ages", limit=limit,
                                  hint="Let daughters begin at ages that do not depend on their mother's.")
        end = growing.at_end(module)
        todo += growing.daughters(end)[::-1] if end is not None else []
    return found


def _stretched(growing: Timed, first: Mapping[_Kind, set[_Age]]) -> Lives:
    ages: dict[_Kind, tuple[int, list[_Age]]] = {}
    modules: list[Module] = []
    for (symbol, rest), begun in first.items():
        mortal = growing.at_end(Module(symbol, (*min(begun), *rest))) is not None  # type: ignore[arg-type]
        ages[symbol, rest] = len(modules), sorted(begun)[:None if mortal else 1]
        modules += [Module(symbol, (*age, *rest)) for age in ages[symbol, rest][1]]  # type: ignore[arg-type]
    found = Lives(tuple(modules), (), ages)
    fates: list[tuple[Fate, ...]] = []
    for number, row in ages.values():
        fates += [(Fate(None, (i,), 1, after[0] - age[0]),) for i, (age, after) in enumerate(pairwise(row), number + 1)]
        fates.append(_end(growing, found, modules[len(fates)]))
    return Lives(found.modules, tuple(fates), ages)


def _end(growing: Timed, found: Lives, module: Module) -> tuple[Fate, ...]:
    """What becomes of a module in its last stretch."""
    end = growing.at_end(module)
    if end is None:
        return ()
    span: Value = end.arguments[0] - module.arguments[0]  # type: ignore[operator]
    if span < 0:
        raise ModelValueError(f"{module} begins older than it divides, at the age {number_text(end.arguments[0])}")  # type: ignore[arg-type]
    daughters = (found.stretch(daughter) for daughter in growing.daughters(end))
    return (Fate(growing.states.rules[kind_of(module)][0].number, tuple(d for d in daughters if d is not None), 1, span),)
