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
        lengths = sizes[chosen]
        if len(chosen) and lengths.min() == 1 == lengths.max():
            return everything.astype(kind)[np.minimum(starts, len(everything) - 1)][chosen]
        ends = np.cumsum(lengths)
        places = np.repeat(starts[chosen] - ends + lengths, lengths)
        places += np.arange(len(places))
        gathered: Integers = everything.astype(kind)[places]
        return gathered


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
        self._numbers: dict[tuple[int, int, int], int] = {}
        self._outcomes: list[tuple[list[int], list[float]]] = []
        self._table: Integers = np.zeros(0, dtype=np.int64)

    def chosen(self, codes: Integers, step: int) -> Integers:
        """For each module of a word the number of the replacement that it gets."""
        states = self.stepper.states
        size = len(states)
        self._fixed += [self._settled(state) for state in range(len(self._fixed), size)]
        chosen = np.array(self._fixed[:size])[codes]
        where = np.flatnonzero(chosen < 0)
        if len(where):
            left, right = self._neighbours(codes, where, size)
            chosen[where] = self._drawn(self._cases(left, codes[where], right, size), where, step)
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
        before, after = beside(roles[codes], where) if roles.any() else (where - 1, where + 1)
        padded = np.append(codes.astype(np.int64), size)
        return padded[before], padded[after]

    def _role(self, symbol: str) -> int:
        if symbol in OPENING or symbol in CLOSING:
            return OPENS if symbol in OPENING else CLOSES
        return PASSED if symbol in self.stepper.passed else ORDINARY

    def _cases(self, left: Integers, codes: Integers, right: Integers, size: int) -> Integers:
        """For some modules between others the numbers of their cases."""
        keys = (left * (size + 1) + right) * size + codes
        bound = size * (size + 1) ** 2
        if bound > TABLE:
            distinct, which = np.unique(keys, return_inverse=True)
            return np.array([self._case(key, size) for key in distinct.tolist()])[which]
        if len(self._table) != bound:
            self._table = np.zeros(bound, dtype=np.int64)  # 0 for a case that has not been met
        if not (found := self._table[keys]).all():
            there = np.zeros(bound, dtype=bool)
            there[keys] = True
            for key in np.flatnonzero(there & (self._table == 0)).tolist():
                self._table[key] = self._case(key, size) + 1
            found = self._table[keys]
        numbers: Integers = found - 1
        return numbers

    def _case(self, key: int, size: int) -> int:
        """The number of a case; what comes of it is found when it is met first."""
        rest, code = divmod(key, size)
        left, right = divmod(rest, size + 1)
        case = left if left < size else NOBODY, code, right if right < size else NOBODY
        if case not in self._numbers:
            self._outcomes.append(self._found(*case))
            self._numbers[case] = len(self._outcomes) - 1
        return self._numbers[case]

    def _drawn(self, cases: Integers, where: Integers, step: int) -> Integers:
        """For each module, whose case is known, the number of its replacement."""
        result = np.array([fates[0] for fates, _ in self._outcomes])[cases]
        for number, (fates, weights) in enumerate(self._outcomes):
            if len(fates) > 1:
                ours, marks = np.flatnonzero(cases == number), np.cumsum(weights)
                lots = units(self.stepper.seed, step, where[ours]) * marks[-1]
                drawn = np.searchsorted(marks, lots, side="right").clip(max=len(fates) - 1)
                result[ours] = np.array(fates)[drawn]
        return result

    def _found(self, left: int, code: int, right: int) -> tuple[list[int], list[float]]:
        """The same, tried on a word of just these modules: the possible replacements, and their weights."""
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
    open_ = np.zeros(len(roles), dtype=bool)
    open_[asked] = True
    kept = np.flatnonzero(open_ | (roles != PASSED))
    mine, role = np.flatnonzero(open_[kept]), roles[kept]
    behind, ahead = _pointers(role)
    padded = np.append(kept, NOBODY)
    return padded[behind[mine - 1]], padded[ahead[mine + 1]]


def _pointers(role: Integers) -> tuple[Integers, Integers]:
    """For each place whom one meets who looks there from the right, and from the left; the last place is nobody's."""
    size = len(role)
    behind, ahead = np.arange(size + 1), np.arange(size + 1)
    passed, brackets = np.flatnonzero(role == PASSED), np.flatnonzero((role == OPENS) | (role == CLOSES))
    opening, closing = _pairs(role, brackets)
    behind[passed], ahead[passed] = passed - 1, passed + 1
    behind[opening], behind[closing] = opening - 1, opening - 1
    ahead[opening], ahead[closing] = closing + 1, size
    passing = np.append(role != ORDINARY, False)
    for pointers in (behind, ahead):
        hanging = np.concatenate((passed, brackets))
        while len(hanging := hanging[passing[pointers[hanging]]]):
            pointers[hanging] = pointers[pointers[hanging]]
    return behind, ahead


def _pairs(role: Integers, brackets: Integers) -> tuple[Integers, Integers]:
    """The places of brackets that open, and of those that close them: on one level they take turns."""
    opens = role[brackets] == OPENS
    level = np.cumsum(np.where(opens, 1, -1)) + ~opens
    order = brackets[np.argsort(level.astype(np.min_scalar_type(int(level.max(initial=0)))), kind="stable")]
    return order[::2], order[1::2]
