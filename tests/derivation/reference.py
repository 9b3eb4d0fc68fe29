"""Deriving by the book: the definition of an L-system, read literally (ABOP, sections 1.7, 1.8, 1.10 and 3.2).

For each module of the word the first production that matches is looked for; all matches are replaced at once. Nothing is
remembered, counted or shared, contexts are found by walking along the word, and every number that is not drawn by chance is
a `Fraction`: slow, and short enough to be believed. Only `Chance` is the engine's own: it is the definition of chance.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any, TypeAlias

from lsys_kit.derivation.chance import Chance, chosen
from lsys_kit.notation.expressions import Name, Number
from lsys_kit.notation.model import END, Item, LSystem, Module, Production, Repeat

Names: TypeAlias = Mapping[str, Any]
PlainModule: TypeAlias = tuple[str, tuple[Any, ...]]
PlainWord: TypeAlias = list[PlainModule]

OPERATIONS: Mapping[str, Any] = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "^": operator.pow, "-x": operator.neg,
    "==": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge,
    "!": operator.not_,
    "abs": abs, "floor": math.floor, "ceil": math.ceil, "min": min, "max": max,
    "sqrt": math.sqrt, "exp": math.exp, "log": math.log,
}
RANDOM = ("uniform", "normal", "binomial", "poisson", "table")
OPENING, CLOSING = "[(", "])"
DEEPEST = 100


def value(expression: Any, names: Names, chance: Chance | None = None) -> Any:
    """What an expression comes to: a truth, a `Fraction`, or a double where chance or a root led out of the rationals."""
    if isinstance(expression, Number):
        return Fraction(expression.value)
    if isinstance(expression, Name):
        return names[expression.name]
    if expression.operator in ("&&", "||"):  # as in C, the second is looked at only where it matters
        left, right = expression.operands
        first = value(left, names)
        return value(right, names) if first == (expression.operator == "&&") else first
    operands = [value(operand, names, chance) for operand in expression.operands]
    drawn = expression.operator in RANDOM
    result = (getattr(chance, expression.operator) if drawn else OPERATIONS[expression.operator])(*operands)
    return result if isinstance(result, bool | float) else Fraction(result)


def constants(system: LSystem) -> Names:
    found: dict[str, Any] = {}
    for constant in system.constants:
        found[constant.name] = value(constant.value, found)
    return found


# Contexts

def passed(system: LSystem, symbol: str) -> bool:
    """Whether contexts pass over a symbol."""
    return symbol in system.ignored or (bool(system.considered) and symbol not in system.considered)


def end_of_branch(word: PlainWord, at: int, way: int = 1) -> int:
    """Where the branch ends whose bracket stands at a position; backward, where it begins."""
    depth = 0
    while True:
        symbol = word[at][0]
        depth += (symbol in OPENING) - (symbol in CLOSING)
        if depth == 0:
            return at
        at += way


def to_the_left(system: LSystem, word: PlainWord, at: int) -> Iterator[PlainModule]:
    """The modules to the left of a position along its branch and the branches that carry it, the nearest first."""
    at -= 1
    while at >= 0:
        if word[at][0] in CLOSING:
            at = end_of_branch(word, at, -1)
        elif word[at][0] not in OPENING and not passed(system, word[at][0]):
            yield word[at]
        at -= 1


def binds(system: LSystem, formal: Module, module: PlainModule, names: dict[str, Any]) -> bool:
    """Whether a module is as a pattern says; its parameters' values go into `names`."""
    symbol, values = module
    if symbol != formal.symbol or len(values) != len(formal.arguments):
        return False
    known = {constant.name for constant in system.constants}
    for argument, given in zip(formal.arguments, values, strict=True):
        if isinstance(argument, Name) and argument.name not in known:
            names[argument.name] = given
        elif value(argument, names) != given:
            return False
    return True


def left_matches(system: LSystem, pattern: Sequence[Module], word: PlainWord, at: int, names: dict[str, Any]) -> bool:
    beside = to_the_left(system, word, at)
    return all((near := next(beside, None)) is not None and binds(system, formal, near, names)
               for formal in reversed(pattern))


def right_matches(system: LSystem, pattern: Sequence[Module], word: PlainWord, at: int, names: dict[str, Any]) -> bool:
    """Whether the modules from a position on, up to the end of its branch, begin as the pattern says."""
    if not pattern:
        return True
    if at == len(word) or word[at][0] in CLOSING:
        return pattern[0].symbol == END and right_matches(system, pattern[1:], word, at, names)
    if word[at][0] in OPENING:
        behind = end_of_branch(word, at) + 1
        if pattern[0].symbol == word[at][0]:
            close = end_of_branch([(module.symbol, ()) for module in pattern], 0)
            if right_matches(system, pattern[1:close], word, at + 1, names):
                return right_matches(system, pattern[close + 1:], word, behind, names)
        return right_matches(system, pattern, word, behind, names)  # a branch that the pattern does not mean
    if passed(system, word[at][0]):
        return right_matches(system, pattern, word, at + 1, names)
    return (pattern[0].symbol not in OPENING and binds(system, pattern[0], word[at], names)
            and right_matches(system, pattern[1:], word, at + 1, names))


# Rules

def names_for(system: LSystem, rule: Production, word: PlainWord, at: int, known: Names) -> Names | None:
    """The parameters' values where the rule matches the module at a position of the word, else None."""
    names = dict(known)
    matches = (binds(system, rule.predecessor, word[at], names)
               and left_matches(system, rule.left, word, at, names)
               and right_matches(system, rule.right, word, at + 1, names)
               and (rule.condition is None or value(rule.condition, names)))
    return names if matches else None


def made(items: Iterable[Item], names: Names, chance: Chance | None = None) -> PlainWord:
    """A successor with its arguments evaluated from left to right, its repetitions written out."""
    word: PlainWord = []
    for item in items:
        if isinstance(item, Repeat):
            for index in range(int(value(item.count, names, chance))):
                word += made(item.body, {**names, item.index: Fraction(index)}, chance)
        else:
            word.append((item.symbol, tuple([value(argument, names, chance) for argument in item.arguments])))
    return word


def successor(system: LSystem, rules: Sequence[Production], word: PlainWord, at: int, known: Names,
              chance: Chance) -> tuple[int, PlainWord] | None:
    """Which rule is applied to the module at a position, and what it makes; None where no rule matches."""
    matching = [(number, names) for number, rule in enumerate(rules)
                if (names := names_for(system, rule, word, at, known)) is not None]
    if not matching:
        return None
    number, names = matching[0]
    if rules[number].probability is not None:
        drawn = [(n, names) for n, names in matching if rules[n].probability is not None]
        number, names = drawn[chosen([value(rules[n].probability, names) for n, names in drawn], chance.unit())]
    return number, made(rules[number].successor, names, chance)


def decomposed(system: LSystem, word: PlainWord, known: Names, chance: Chance, depth: int = 0) -> PlainWord:
    """What becomes of modules by the decomposition rules, depth first, until none applies or the depth is reached."""
    after: PlainWord = []
    if depth == system.decomposition_depth:
        return word
    for module in word:
        found = successor(system, system.decomposition, [module], 0, known, chance)
        if found is not None and depth == DEEPEST:
            raise RecursionError(module)
        after += [module] if found is None else decomposed(system, found[1], known, chance, depth + 1)
    return after


def kept(word: PlainWord) -> list[int]:
    """The positions of the modules that no cut removes."""
    positions, at = [], 0
    while at < len(word):
        if word[at][0] == "%":
            while at < len(word) and word[at][0] not in CLOSING:
                at = end_of_branch(word, at) + 1
            continue
        positions.append(at)
        at += 1
    return positions


def shortened(system: LSystem, word: PlainWord, known: Names) -> PlainWord:
    """The word after meta-rules, the leftmost first, until none applies."""
    for at in range(len(word)):
        for rule in system.meta:
            names, end = dict(known), at + len(rule.predecessors)
            row = zip(rule.predecessors, word[at:end], strict=False)
            if (end <= len(word) and all(binds(system, formal, module, names) for formal, module in row)
                    and (rule.condition is None or value(rule.condition, names))):
                return shortened(system, [*word[:at], *made(rule.successor, names), *word[end:]], known)
    return word


def step(system: LSystem, word: PlainWord, known: Names, seed: int, number: int) -> tuple[PlainWord, set[int]]:
    """The next word, and the numbers of the productions that were applied."""
    after: PlainWord = []
    applied: set[int] = set()
    for at in kept(word):
        chance = Chance(seed, number, at)
        found = successor(system, system.productions, word, at, known, chance)
        applied |= {found[0]} if found else set()
        after += decomposed(system, found[1] if found else [word[at]], known, chance)
    return shortened(system, after, known), applied


def words(system: LSystem, steps: int, seed: int = 0) -> tuple[list[PlainWord], set[int]]:
    """The words of steps 0 to `steps`, and the productions that were applied on the way."""
    known = constants(system)
    found, applied = [made(system.axiom, known)], set[int]()
    for number in range(steps):
        word, new = step(system, found[-1], known, seed, number)
        found.append(word)
        applied |= new
    return found, applied
