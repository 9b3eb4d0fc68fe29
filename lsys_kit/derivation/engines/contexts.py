"""A step by cases: all modules of a word at once.

Where rules name no more than one neighbour on each side and leave nothing but the choice of a rule to chance, a module's case
is three states. The cases that occur are looked up once each, and the new word is gathered from what they become. Cases are
worked out by the stepwise engine, on words of up to three modules. Long words are arrays of cases; in short ones, which are
quicker so, and where there are no arrays, cases are looked up one by one, and worked out in the same order.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.arrays import arrays_pay, np
from lsys_kit.budget import counted
from lsys_kit.derivation.core.chance import few_units, stretches, units
from lsys_kit.derivation.core.matching import NO_NEIGHBOUR
from lsys_kit.derivation.core.rules import Rule, Values
from lsys_kit.derivation.core.states import Match, States
from lsys_kit.derivation.core.words import Codes, listed
from lsys_kit.derivation.engines.engine import ByteTable, Origins, code_type, compact, repeated
from lsys_kit.derivation.engines.stepwise import Replacement, Stepper
from lsys_kit.notation.model.modules import CLOSING, OPENING

if TYPE_CHECKING:
    from numpy.typing import NDArray

IntegerArray: TypeAlias = "NDArray[np.integer]"
Sides: TypeAlias = tuple[IntegerArray, IntegerArray]
ORDINARY, OPENS, CLOSES, PASSED, SKIPPED = range(5)
"""The role of a module in contexts: `PASSED` is ignored but has contexts of its own, `SKIPPED` is ignored and has none."""
Chosen: TypeAlias = "list[int] | IntegerArray"
"""For each module of a word the number of what it becomes."""
LARGEST_TABLE, FEW_REPLACEMENTS = 2**22, 12
"""The largest table of cases that is indexed directly; up to so many different replacements are counted one after another."""
FEW_MODULES = 64
"""In words up to this length, cases are looked up one by one."""


class Replacements:
    """What modules may become, numbered, and how words are assembled from it."""

    def __init__(self, states: States) -> None:
        self.states = states
        self.replacements: list[Replacement] = []
        self._numbers: dict[Replacement, int] = {}
        self._bytes = ByteTable(states)

    def number(self, replacement: Replacement) -> int:
        """The number of a replacement, a new one where it has not been met."""
        found = self._numbers.get(replacement)
        if found is None:
            found = len(self.replacements)
            self.states.keep(replacement.states)
            self.replacements.append(replacement)
            self._numbers[replacement] = found  # last, so that an interrupt leaves no number without its replacement
        return found

    def sizes(self) -> IntegerArray:
        return np.array([len(replacement.states) for replacement in self.replacements], dtype=np.int64)

    def size(self, chosen: Chosen) -> int:
        if isinstance(chosen, list):
            return sum(len(self.replacements[number].states) for number in chosen)
        sizes = [len(replacement.states) for replacement in self.replacements]
        others = [(number, size) for number, size in enumerate(sizes) if size != 1]
        if len(others) > FEW_REPLACEMENTS:
            return int(np.dot(np.bincount(chosen, minlength=len(sizes)), sizes))
        return len(chosen) + sum(int(np.count_nonzero(chosen == number)) * (size - 1) for number, size in others)

    def replaced(self, chosen: Chosen) -> Codes:
        """The replacements of some numbers, one after another."""
        if isinstance(chosen, list):
            return compact([state for number in chosen for state in self.replacements[number].states], len(self.states))
        if chosen.dtype == np.uint8 and all(
            self._bytes.add(number, replacement.states) for number, replacement in enumerate(self.replacements)
        ):
            return self._bytes.replaced(chosen.tobytes())
        sizes = self.sizes()
        lengths = sizes[chosen]
        places = np.repeat((np.cumsum(sizes) - sizes)[chosen] - np.cumsum(lengths) + lengths, lengths)
        places += np.arange(len(places))
        everything = [state for replacement in self.replacements for state in replacement.states]
        gathered: IntegerArray = np.array(everything, dtype=code_type(len(self.states)))[places]
        return gathered

    def origins(self, chosen: Chosen) -> Origins:
        """Where the modules come from that replace those of a word."""
        sizes = [len(replacement.states) for replacement in self.replacements]
        if isinstance(chosen, list):
            sizes = [sizes[number] for number in chosen]
            parents, made = repeated(range(len(chosen)), sizes), repeated(chosen, sizes)
        else:
            times = np.array(sizes)[chosen]
            parents, made = np.repeat(np.arange(len(chosen)), times).tolist(), np.repeat(chosen, times).tolist()
        productions = [replacement.production for replacement in self.replacements]
        return Origins(parents, [productions[number] for number in made])


@dataclass(frozen=True)
class RuleChoice:
    """A case in which chance decides between several rules.

    state
        The module.
    rules
        The rules, each with the values of the parameters that it names.
    marks
        Where in the line from 0 to `total` the stretch of each rule ends.
    total
        The sum of all weights.
    """

    state: int
    rules: Sequence[Match]
    marks: Sequence[float]
    total: float

    def drawn(self, units: NDArray[np.float64]) -> IntegerArray:
        """For each random number from 0 up to 1 the index of the rule that it chooses."""
        return np.searchsorted(self.marks, units * self.total, side="right")


class ContextEngine:
    """The steps of one system under one seed, all modules of a word at once.

    >>> from lsys_kit import read
    >>> from lsys_kit.derivation.core.states import States
    >>> stepper = Stepper(States(read("axiom: b a a\\nb < a -> b")), 0)
    >>> arrays = ContextEngine(stepper)
    >>> arrays.outcomes.replaced(arrays.chosen(stepper.states.axiom, 0))
    [0, 0, 1]
    """

    def __init__(self, stepper: Stepper) -> None:
        self.stepper, self.outcomes = stepper, Replacements(stepper.states)
        self._roles: list[tuple[int, int]] = []
        self._numbers: dict[tuple[int, int, int], int] = {}
        self._choices: list[RuleChoice] = []
        self._table: IntegerArray | None = None

    def chosen(self, codes: Codes, step: int) -> Chosen:
        """For each module of a word the number of the replacement that it gets."""
        size = len(self.stepper.states)
        if self.stepper.in_context:
            for state in range(len(self._roles), size):
                self._meet(state)
        if arrays_pay(len(codes), FEW_MODULES):
            return self._at_once(np.asarray(codes, dtype=code_type(size)), size, step)
        return self._one_by_one(listed(codes), size, step)

    def _one_by_one(self, codes: Sequence[int], size: int, step: int) -> list[int]:
        """The numbers of the replacements, without arrays; `size` is the number of states."""
        around = self.stepper.old(codes).around
        cases = [(NO_NEIGHBOUR, code, NO_NEIGHBOUR) for code in codes]
        if around:
            named = [*codes, NO_NEIGHBOUR]  # the last one is that of no neighbour
            cases = [
                (named[left], code, named[right]) for left, code, right in zip(around.before, codes, around.after, strict=True)
            ]
        new = {*cases}.difference(self._numbers)
        for case in counted(sorted(new, key=lambda case: (case[0] % (size + 1), case[2] % (size + 1), case[1])), 1):
            self._number(case)
        numbers = [self._numbers[case] - 1 for case in cases]
        of_choices: dict[int, list[int]] = {}
        for position, number in enumerate(numbers):
            if number < 0:
                of_choices.setdefault(-number - 2, []).append(position)
        for index, positions in sorted(of_choices.items()):
            choice = self._choices[index]
            units = few_units(self.stepper.seed, step, positions)
            drawn = [bisect_right(choice.marks, unit * choice.total) for unit in units]
            outcomes = {rule: self._outcome(choice, rule) for rule in sorted({*drawn})}
            for position, rule in zip(positions, drawn, strict=True):
                numbers[position] = outcomes[rule]
        return numbers

    def _at_once(self, codes: IntegerArray, size: int, step: int) -> IntegerArray:
        """The same by arrays."""
        if not self.stepper.in_context:
            return self._drawn(self._cases(codes, size, lambda key: (NO_NEIGHBOUR, key, NO_NEIGHBOUR)), None, step)
        roles = np.zeros(len(codes), dtype=np.uint8)
        if any(role for role, _ in self._roles):
            roles = np.array([role for role, _ in self._roles], dtype=np.uint8).take(codes)
        where = np.flatnonzero(roles != SKIPPED)
        if len(where) == len(codes):
            return self._drawn(self._in_context(codes, roles, size), None, step)
        found = self._drawn(self._in_context(codes.take(where), roles.take(where), size), where, step)
        fixed = [outcome for _, outcome in self._roles]
        chosen = np.array(fixed, dtype=code_type(len(self.outcomes.replacements))).take(codes)
        chosen[where] = found
        return chosen

    def _meet(self, state: int) -> None:
        """Note the role of a new state; for one that is ignored and has no contexts itself, also what becomes of it."""
        states = self.stepper.states
        symbol = states.modules[state].symbol
        role, fixed = ORDINARY, 0
        if symbol in OPENING or symbol in CLOSING:
            role = OPENS if symbol in OPENING else CLOSES
        elif symbol in self.stepper.passing.ignored:
            role = PASSED
            if states.is_d0l(state):
                role, fixed = SKIPPED, self.outcomes.number(Replacement(states.successor(state), states.production(state)))
        self._roles.append((role, fixed))

    def _in_context(self, codes: IntegerArray, roles: IntegerArray, size: int) -> IntegerArray:
        """The numbers of the cases of a row of modules, each with its neighbours; `size` stands for none."""
        left, right = context_neighbours(codes.astype(code_type(size + 1)), roles, size, self.stepper.passing.flat)
        kind = np.min_scalar_type(size * (size + 1) ** 2)
        keys = left.astype(kind) * kind.type(size + 1) + right.astype(kind, copy=False)
        keys = keys * kind.type(size) + codes.astype(kind, copy=False)

        def case(key: int) -> tuple[int, int, int]:
            rest, code = divmod(key, size)
            before, after = divmod(rest, size + 1)
            return before if before < size else NO_NEIGHBOUR, code, after if after < size else NO_NEIGHBOUR

        return self._cases(keys, size * (size + 1) ** 2, case)

    def _cases(self, keys: IntegerArray, bound: int, case: Callable[[int], tuple[int, int, int]]) -> IntegerArray:
        """For each module, whose case is given by a key below a bound, the number of what becomes of it, from 1 on.

        Where chance decides it is below zero. Each case is worked out when its key is first met.
        """
        if bound > LARGEST_TABLE:
            distinct, which = np.unique(keys, return_inverse=True)
            return np.array([self._number(case(key)) for key in counted(distinct.tolist(), 1)])[which]
        if self._table is None or len(self._table) != bound:
            self._table = np.zeros(bound, dtype=np.int32)  # 0 for a case that has not been met
        if not (found := self._table.take(keys)).all():
            there = np.zeros(bound, dtype=bool)
            there[keys] = True
            for key in counted(np.flatnonzero(there & (self._table == 0)).tolist(), 1):
                self._table[key] = self._number(case(key))
            found = self._table.take(keys)
        return found

    def _number(self, case: tuple[int, int, int]) -> int:
        """The number of what becomes of a module in a case; where chance decides, that of the choice, below zero."""
        if case not in self._numbers:
            found = self._found(*case)
            if isinstance(found, RuleChoice):
                self._choices.append(found)
            self._numbers[case] = -len(self._choices) if isinstance(found, RuleChoice) else self.outcomes.number(found) + 1
        return self._numbers[case]

    def _found(self, left: int, code: int, right: int) -> Replacement | RuleChoice:
        """What becomes of a module between two others, tried on a word of just these."""
        states = self.stepper.states
        if states.is_d0l(code):
            return Replacement(states.successor(code), states.production(code))
        word = [state for state in (left, code, right) if state != NO_NEIGHBOUR]
        matched = self.stepper.matched(self.stepper.old(word), int(left != NO_NEIGHBOUR))
        if not matched:
            return Replacement(states.decompose(states.modules[code]), None)
        states.choose_rule(matched, None)  # refuses weights that are none
        likely = [match for match in matched if match[0].probability]
        if len(likely) < 2:
            return self._applied(code, *matched[0])
        marks, total = stretches([states.weight(*match) for match in likely])
        return RuleChoice(code, likely, marks, total)

    def _outcome(self, choice: RuleChoice, rule: int) -> int:
        """The number of what a rule of a choice makes, computed when it is drawn: one that never is may have no value."""
        return self.outcomes.number(self._applied(choice.state, *choice.rules[rule]))

    def _applied(self, code: int, rule: Rule, values: Values) -> Replacement:
        states = self.stepper.states
        return Replacement(states.replacement(rule, states.modules[code], values), rule.number)

    def _drawn(self, numbers: IntegerArray, where: IntegerArray | None, step: int) -> IntegerArray:
        """For each module the number of its replacement, after chance; `where` it stands, if not at its own place."""
        drawn = [
            self._choose(choice, np.flatnonzero(numbers == -number), where, step)
            for number, choice in enumerate(self._choices, 1)
        ]
        result: IntegerArray = (numbers - 1).astype(code_type(len(self.outcomes.replacements)))
        for ours, outcomes in drawn:
            result[ours] = outcomes
        return result

    def _choose(self, choice: RuleChoice, ours: IntegerArray, where: IntegerArray | None, step: int) -> Sides:
        """Where the modules of a choice stand, and the numbers of what they become."""
        rules = choice.drawn(units(self.stepper.seed, step, ours if where is None else where[ours]))
        outcomes = np.zeros(len(choice.rules), dtype=np.int64)
        for rule in np.flatnonzero(np.bincount(rules, minlength=len(outcomes))).tolist():
            outcomes[rule] = self._outcome(choice, rule)
        return ours, outcomes[rules]


def context_neighbours(codes: IntegerArray, roles: IntegerArray, none: int, flat: bool = False) -> Sides:
    """The neighbours of each module of a word in the sense of contexts, to its left and to its right.

    codes
        The word's states, of a type that holds `none` too.
    roles
        For each module `ORDINARY`, `OPENS`, `CLOSES` or `PASSED`.
    none
        What stands for a missing neighbour. The neighbours of brackets mean nothing.
    flat
        Whether those to the right are found as if there were no brackets.

    >>> word, roles = np.array([10, 1, 11, 2, 1, 12, 2, 13]), np.array([0, 1, 0, 2, 1, 0, 2, 0])  # A[B][C]D
    >>> left, right = context_neighbours(word, roles, 99)
    >>> left[[0, 2, 5, 7]].tolist(), right[[0, 2, 5, 7]].tolist()
    ([99, 10, 10, 10], [13, 99, 99, 99])
    """
    if flat:
        passed = np.where(roles == ORDINARY, ORDINARY, PASSED)
        return context_neighbours(codes, roles, none)[0], context_neighbours(codes, passed, none)[1]
    size = len(codes)
    behind = ahead = np.append(codes, codes.dtype.type(none))  # the neighbour found at each place, coming from the right
    hanging = np.flatnonzero(roles)
    if len(hanging):
        back, forth = _looked_at(roles, hanging, size)
        ahead = behind.copy()
        behind[hanging], ahead[hanging] = behind[back], ahead[forth]
    return np.roll(behind, 1)[:size], ahead[1:]


def _looked_at(roles: IntegerArray, hanging: IntegerArray, size: int) -> tuple[IntegerArray, IntegerArray]:
    """For brackets and ignored modules where the neighbour stands that is found there, coming from the right and from the left.

    From outside, a branch is passed; from inside, its beginning leads to the parent, and its end to no neighbour.
    """
    role, last = roles[hanging], len(hanging)
    closing, opening = _pairs(role)
    before, after = np.arange(last), np.arange(last + 1)  # where the search goes on; `last` ends it
    before[closing], after[opening], after[closing] = opening, closing, last
    near = np.flatnonzero(np.diff(hanging) == 1)  # those directly followed by another
    for pointers, step, there in ((before, -1, near + 1), (after, 1, near)):
        another = np.zeros(last + 1, dtype=bool)
        another[there] = True
        left = np.flatnonzero(another[pointers])
        while len(left):
            pointers[left] = pointers[pointers[left] + step]
            left = left[another[pointers[left]]]
    return hanging[before] - 1, np.append(hanging, size - 1)[after[:last]] + 1


def _pairs(role: IntegerArray) -> tuple[IntegerArray, IntegerArray]:
    """The ranks of closing brackets and of the brackets that open them: on one level of nesting they alternate."""
    brackets = np.flatnonzero(role != PASSED)
    opens = role[brackets] == OPENS
    level = np.cumsum(np.where(opens, 1, -1), dtype=np.int32) + ~opens
    order = brackets[np.argsort(level.astype(code_type(int(level.max(initial=0)) + 1)), kind="stable")]
    return order[1::2], order[::2]
