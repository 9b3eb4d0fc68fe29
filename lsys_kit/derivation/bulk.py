"""A step of a long word, all modules at once.

Where rules look at no more than one neighbour on each side and leave nothing but the choice of a rule to chance, a module's
case is three states. The cases that occur are looked up once each, and the new word is gathered from what they become.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from lsys_kit.derivation.chance import units
from lsys_kit.derivation.matching import NOBODY
from lsys_kit.derivation.states import CUT
from lsys_kit.derivation.stepping import Replacement, Stepper
from lsys_kit.notation.model import CLOSING, OPENING

Integers: TypeAlias = np.ndarray[Any, np.dtype[Any]]
ORDINARY, OPENS, CLOSES, PASSED = range(4)
TABLE = 2**22
"""The largest table of cases that is looked up directly."""


def possible(stepper: Stepper) -> bool:
    """Whether a system's words can be stepped in bulk."""
    rules = [rule for found in stepper.states.rules.values() for rule in found]
    near = all(len(rule.left) <= 1 and len(rule.right) <= 1 and all(isinstance(item[0], str) for item in rule.right)
               for rule in rules)
    symbols = {module.symbol for rule in stepper.states.system.rules for module in rule.modules}
    cuts = CUT in symbols or any(module.symbol == CUT for module in stepper.states.system.axiom)
    return near and stepper.states.parts_settled and not cuts and not any(rule.random for rule in rules)


class Fates:
    """What modules may become, numbered, and laid out for gathering."""

    def __init__(self) -> None:
        self.replacements: list[Replacement] = []
        self._numbers: dict[Replacement, int] = {}
        self._laid_out: tuple[Integers, Integers, Integers] | None = None

    def number(self, replacement: Replacement) -> int:
        """The number of a replacement, a new one where it has not been met."""
        found = self._numbers.get(replacement)
        if found is None:
            found = self._numbers[replacement] = len(self.replacements)
            self.replacements.append(replacement)
            self._laid_out = None
        return found

    def laid_out(self) -> tuple[Integers, Integers, Integers]:
        """All states of all replacements one after another, where each begins, and how many it has."""
        if self._laid_out is None:
            sizes = np.array([len(replacement.states) for replacement in self.replacements], dtype=np.int64)
            everything = np.array([state for replacement in self.replacements for state in replacement.states], dtype=np.int64)
            self._laid_out = everything, np.cumsum(sizes) - sizes, sizes
        return self._laid_out

    def size(self, chosen: Integers) -> int:
        """How many modules the replacements of some numbers have together."""
        return int(self.laid_out()[2][chosen].sum())

    def gathered(self, chosen: Integers, kind: np.dtype[Any]) -> Integers:
        """The replacements of some numbers, one after another."""
        everything, starts, sizes = self.laid_out()
        everything = everything.astype(kind)
        lengths = sizes[chosen]
        if len(chosen) and lengths.min() == 1 == lengths.max():
            return everything[np.minimum(starts, len(everything) - 1)][chosen]
        ends = np.cumsum(lengths)
        steps = np.ones(int(ends[-1]) if len(ends) else 0, dtype=np.int64)
        there = lengths > 0
        begins = (ends - lengths)[there]
        first = starts[chosen][there]
        steps[begins] = first - np.append(0, (first + lengths[there])[:-1] - 1)
        return everything[np.cumsum(steps)]


class Bulk:
    """The bulk steps of one system under one seed.

    Examples
    --------
    >>> from lsys_kit.derivation.states import States
    >>> from lsys_kit.notation.read import read
    >>> stepper = Stepper(States(read("axiom: b a a\\nb < a -> b")), 0)
    >>> bulk = Bulk(stepper)
    >>> bulk.fates.gathered(bulk.chosen(np.array(stepper.states.axiom), 0), np.dtype(np.uint8)).tolist()
    [0, 0, 1]
    """

    def __init__(self, stepper: Stepper) -> None:
        self.stepper, self.fates = stepper, Fates()
        self._fixed: list[int] = []
        self._outcomes_of: dict[tuple[int, int, int], tuple[list[int], list[float]]] = {}

    def chosen(self, codes: Integers, step: int) -> Integers:
        """For each module of a word the number of the replacement that it gets."""
        states = self.stepper.states
        size = len(states)
        self._fixed += [self._settled(state) for state in range(len(self._fixed), size)]
        chosen = np.array(self._fixed[:size])[codes]
        where = np.flatnonzero(chosen < 0)
        if len(where):
            left, right = self._neighbours(codes, where, size)
            key = (left.astype(np.int64) * (size + 1) + right) * size + codes[where]
            cases, which = _distinct(key, size * (size + 1) ** 2)
            chosen[where] = self._drawn(cases, which, where, step, size)
        return chosen

    def _settled(self, state: int) -> int:
        """The number of what a settled state becomes; -1 for one that is not settled."""
        states = self.stepper.states
        if not states.is_settled(state):
            return -1
        return self.fates.number(Replacement(states.successor(state), states.production(state)))

    def _neighbours(self, codes: Integers, where: Integers, size: int) -> tuple[Integers, Integers]:
        """The states to the left and right of some modules; `size`, which is no state's number, stands for nobody."""
        if not self.stepper.in_context:
            nobody = np.full(len(where), size, dtype=np.int64)
            return nobody, nobody
        roles = np.array([self._role(module.symbol) for module in self.stepper.states.modules[:size]], dtype=np.uint8)
        before, after = beside(roles[codes], where)
        padded = np.append(codes.astype(np.int32), size)
        return padded[before], padded[after]

    def _role(self, symbol: str) -> int:
        if symbol in OPENING or symbol in CLOSING:
            return OPENS if symbol in OPENING else CLOSES
        return PASSED if symbol in self.stepper.passed else ORDINARY

    def _drawn(self, cases: Integers, which: Integers, where: Integers, step: int, size: int) -> Integers:
        """For each module, whose case is known, the number of its replacement."""
        outcomes = []
        for key in cases.tolist():
            rest, code = divmod(key, size)
            left, right = divmod(rest, size + 1)
            outcomes.append(self._outcomes(left if left < size else NOBODY, code, right if right < size else NOBODY))
        result = np.array([fates[0] for fates, _ in outcomes])[which]
        for number, (fates, weights) in enumerate(outcomes):
            if len(fates) > 1:
                ours, marks = np.flatnonzero(which == number), np.cumsum(weights)
                lots = units(self.stepper.seed, step, where[ours]) * marks[-1]
                drawn = np.searchsorted(marks, lots, side="right").clip(max=len(fates) - 1)
                result[ours] = np.array(fates)[drawn]
        return result

    def _outcomes(self, left: int, code: int, right: int) -> tuple[list[int], list[float]]:
        """The replacements that are possible for a module between two others, with their weights."""
        case = left, code, right
        if case not in self._outcomes_of:
            self._outcomes_of[case] = self._found(*case)
        return self._outcomes_of[case]

    def _found(self, left: int, code: int, right: int) -> tuple[list[int], list[float]]:
        """The same, tried on a word of just these modules."""
        states = self.stepper.states
        word = [state for state in (left, code, right) if state != NOBODY]
        matched = self.stepper.matched(self.stepper.old(word), int(left != NOBODY))
        if not matched:
            return [self.fates.number(Replacement(states.parts(states.modules[code]), None))], [1.0]
        states.drawn(matched, None)  # refuses weights that are none
        weights = [float(rule.probability(values + states.constants)) for rule, values in matched if rule.probability]
        made = [Replacement(states.replaced(rule, states.modules[code], values), rule.number)
                for rule, values in (matched if weights else matched[:1])]
        return [self.fates.number(replacement) for replacement in made], weights or [1.0]


def _distinct(keys: Integers, bound: int) -> tuple[Integers, Integers]:
    """The distinct keys, and for each key its place among them."""
    if bound > TABLE:
        cases, which = np.unique(keys, return_inverse=True)
        return cases, which
    there = np.zeros(bound, dtype=bool)
    there[keys] = True
    cases = np.flatnonzero(there)
    places = np.zeros(bound, dtype=np.int32)
    places[cases] = np.arange(len(cases))
    return cases, places[keys]


def beside(roles: Integers, asked: Integers) -> tuple[Integers, Integers]:
    """The positions of some modules' neighbours in the sense of contexts, to the left and to the right, or -1.

    Parameters
    ----------
    roles
        For each position of a word `ORDINARY`, `OPENS`, `CLOSES` or `PASSED`.
    asked
        The positions whose neighbours are wanted; no brackets among them.

    Examples
    --------
    >>> before, after = beside(np.array([0, 1, 0, 2, 1, 0, 2, 0]), np.array([0, 2, 5, 7]))  # A[B][C]D
    >>> before.tolist(), after.tolist()
    ([-1, 0, 0, 0], [7, -1, -1, -1])
    """
    if not roles.any():  # all are ordinary
        return asked - 1, np.where(asked < len(roles) - 1, asked + 1, NOBODY)
    wanted = roles != PASSED
    wanted[asked] = True
    kept = np.flatnonzero(wanted)
    role, mine = roles[kept], np.cumsum(wanted)[asked] - 1
    branched = ((role == OPENS) | (role == CLOSES)).any()
    before, after = _in_branches(role, mine) if branched else _in_a_row(role == ORDINARY, mine)
    padded = np.append(kept, NOBODY)
    return padded[before], padded[after]


def _in_a_row(marks: Integers, mine: Integers) -> tuple[Integers, Integers]:
    """The places of the last mark before and of the next behind some places, or -1."""
    size = len(marks)
    places = np.arange(size)
    last = np.maximum.accumulate(np.where(marks, places, NOBODY))
    following = np.minimum.accumulate(np.where(marks, places, size)[::-1])[::-1]
    before, after = np.append(NOBODY, last)[mine], np.append(following, size)[mine + 1]
    return before, np.where(after < size, after, NOBODY)


def _in_branches(role: Integers, mine: Integers) -> tuple[Integers, Integers]:
    """The same across brackets: modules are sorted by branch level, where those of one branch stand together."""
    size = len(role)
    opens, closes = role == OPENS, role == CLOSES
    level = np.cumsum(opens.astype(np.int32) - closes.astype(np.int32)) + closes
    level -= level.min()
    order = np.argsort(level.astype(np.min_scalar_type(int(level.max()))), kind="stable")
    place = np.empty(size, dtype=np.int64)
    place[order] = np.arange(size)
    sorted_role, sorted_level = role[order], level[order]
    here = place[mine]
    last, following = _in_a_row(sorted_role != PASSED, here)
    parents = _before_brackets(role, order, sorted_role)
    behind = np.where((last >= 0) & (sorted_level[last] == sorted_level[here]), order[last], NOBODY)
    before = np.where((behind >= 0) & opens[behind], parents[behind], behind)
    ahead = np.where((following >= 0) & (sorted_level[following] == sorted_level[here]), order[following], NOBODY)
    after = np.where((ahead >= 0) & (role[ahead] == ORDINARY), ahead, NOBODY)
    return before, after


def _before_brackets(role: Integers, order: Integers, sorted_role: Integers) -> Integers:
    """For each opening bracket the place of the module that stands before it, other branches passed; -1 for none."""
    size = len(role)
    last_open = np.maximum.accumulate(np.where(sorted_role == OPENS, np.arange(size), NOBODY))
    partner = np.full(size + 1, NOBODY)
    closing = np.flatnonzero(sorted_role == CLOSES)
    partner[order[closing]] = np.where(last_open[closing] >= 0, order[last_open[closing]], NOBODY)
    brackets = np.flatnonzero(role == OPENS)
    previous, _ = _in_a_row(role != PASSED, brackets)
    link = np.full(size + 1, NOBODY)
    link[brackets] = np.where(np.append(role, ORDINARY)[previous] == CLOSES, partner[previous], previous)
    is_open = np.append(role == OPENS, False)
    while True:
        hanging = brackets[is_open[link[brackets]]]
        if not len(hanging):
            return link
        link[hanging] = link[link[hanging]]
