"""Deriving by the book: the definition of an L-system, read literally (ABOP, sections 1.7, 1.8, 1.10 and 3.2).

For each module of the word the first production that matches is looked for; all matches are replaced at once. A production that
replaces several modules takes those behind its place with it, and these are passed over (Prusinkiewicz 1986). Nothing is
remembered, counted or shared, contexts are found by walking along the word, and every number that is not drawn by chance is
a `Fraction`: slow, and short enough to be believed. Only `Chance` is the engine's own: it is the definition of chance.
"""

import math
import operator as op
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

from lsys_kit.derivation.core.chance import Chance
from lsys_kit.notation.model.expressions import Apply, Expression, Name
from lsys_kit.notation.model.modules import CLOSING, END, OPENING, Item, Module, Pattern, Repeat
from lsys_kit.notation.model.system import LSystem, Production

PlainModule = tuple[str, tuple[float | Fraction, ...]]
OPERATIONS = {
    "+": op.add,
    "-": op.sub,
    "*": op.mul,
    "/": op.truediv,
    "^": op.pow,
    "-x": op.neg,
    "abs": abs,
    "min": min,
    "max": max,
    "floor": math.floor,
    "ceil": math.ceil,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": math.log,
    "==": op.eq,
    "!=": op.ne,
    "<": op.lt,
    "<=": op.le,
    ">": op.gt,
    ">=": op.ge,
    "!": op.not_,
    "&&": all,
    "||": any,
}


def value(expression: Expression, names: dict, chance: Chance | None = None) -> bool | float | Fraction:
    """What an expression comes to: a truth, a `Fraction`, or a double where chance or a root led out of the rationals."""
    if not isinstance(expression, Apply):
        return names[expression.name] if isinstance(expression, Name) else Fraction(expression.value)
    function = OPERATIONS.get(expression.operator) or getattr(chance, expression.operator)
    operands = (value(operand, names, chance) for operand in expression.operands)
    result = function(operands) if function in (all, any) else function(*operands)  # && and || look no further than they must
    return result if isinstance(result, bool | float) else Fraction(result)


def row(modules: Iterator[Module], opening: frozenset = OPENING, closing: frozenset = CLOSING, ends: bool = True) -> Iterator:
    """The modules along a branch, its side branches as lists; it ends with the branch, or goes on to what carries it."""
    for module in modules:
        if module.symbol not in closing:
            yield list(row(modules, opening, closing)) if module.symbol in opening else module
        elif ends:
            return


def seen(system: LSystem, modules: Iterable[Module], flat: bool = False) -> Iterator[Module]:
    """The modules that contexts do not pass over; flat, without brackets."""
    brackets = set() if flat else {*OPENING, *CLOSING}
    return (
        module
        for module in modules
        if module.symbol in brackets
        or (
            module.symbol not in {*OPENING, *CLOSING, *system.ignored}
            and (not system.considered or module.symbol in system.considered)
        )
    )


def follow(pattern: Sequence, neighbours: Iterator, names: dict, following: bool = False) -> Iterator[dict]:
    """
    The names with the values of a pattern's parameters, if neighbours are as it says, the nearest first; else nothing.

    A branch that is named is any of those behind a module, or the following one.
    """
    wanted, near = (pattern[0], next(neighbours, Module(END))) if pattern else (None, None)
    if near is None:
        yield names
    elif isinstance(near, list):  # a side branch, which is passed over unless the pattern means it
        inside = list(follow(wanted, iter(near), names, following)) if isinstance(wanted, list) else []
        if inside:
            yield from follow(pattern[1:], neighbours, inside[0], following)
        elif not (isinstance(wanted, list) and following):
            yield from follow(pattern, neighbours, names, following)
    elif isinstance(wanted, Pattern) and (wanted.symbol, len(wanted.arguments)) == (near.symbol, len(near.arguments)):
        names = {a.name: v for a, v in zip(wanted.arguments, near.arguments, strict=True) if isinstance(a, Name)} | names
        if [value(a, names) for a in wanted.arguments] == list(near.arguments):
            yield from follow(pattern[1:], neighbours, names, following)


def made(items: Iterable[Item], names: dict, chance: Chance | None = None) -> Iterator[Module]:
    """A successor with its arguments evaluated from left to right, its repetitions written out."""
    for item in items:
        if isinstance(item, Repeat):
            for index in range(int(value(item.count, names, chance))):
                yield from made(item.body, {**names, item.index: Fraction(index)}, chance)
        else:
            yield Module(item.symbol, tuple([value(argument, names, chance) for argument in item.arguments]))


def replaced(system: LSystem, word: list[Module], at: int, known: dict, chance: Chance, depth: int = 0) -> tuple:
    """The production (deeper, the decomposition rule) for the module at a position, and what the module becomes in the end."""
    matching = [
        (rule, names)
        for rule in (system.decomposition if depth else system.productions)
        if "%" not in [module.symbol for module in word[at : at + len(rule.predecessors)]]
        for own in follow(rule.predecessors, iter(word[at:]), known)
        for left in follow(rule.left[::-1], row(seen(system, reversed(word[:at])), CLOSING, OPENING, ends=False), own)
        for names in follow(
            list(row(iter(rule.right))),
            row(seen(system, word[at + len(rule.predecessors) :], system.branches == "flat")),
            left,
            system.branches == "next",
        )
        if rule.condition is None or value(rule.condition, names)
    ]
    if depth and (not matching or depth - 1 == system.decomposition_depth):
        return None, [word[at]]
    if matching and matching[0][0].probability is not None:
        weights = [value(rule.probability, names) if rule.probability else 0 for rule, names in matching]
        matching = matching[chance.table(*weights) :]  # the first is the one that is drawn
    rule, names = matching[0] if matching else (None, known)
    parts = list(made(rule.successor, names, chance)) if rule else [word[at]]
    return rule, [smaller for part in parts for smaller in replaced(system, [part], 0, known, chance, depth + 1)[1]]


def shortened(system: LSystem, word: list[Module], known: dict) -> list[Module]:
    """The word after meta-rules, the leftmost first, until none applies."""
    for at, rule in ((at, rule) for at in range(len(word)) for rule in system.meta):
        for names in follow(rule.predecessors, iter(word[at:]), known):
            if rule.condition is None or value(rule.condition, names):
                return shortened(
                    system, [*word[:at], *made(rule.successor, names), *word[at + len(rule.predecessors) :]], known
                )
    return word


def words(system: LSystem, steps: int, seed: int = 0) -> tuple[list[list[PlainModule]], set[Production]]:
    """The words of steps 0 to `steps`, and the productions that were applied on the way."""
    known, applied = {}, set()
    for constant in system.constants:
        known[constant.name] = value(constant.value, known)
    found = [list(made(system.axiom, known))]
    for number in range(steps):
        after, taken, cut = [], 0, 0  # how many modules are replaced already; within what a % cuts off, how many brackets deep
        for at, module in enumerate(found[-1]):
            cut = cut + (module.symbol in OPENING) - (module.symbol in CLOSING) if cut else int(module.symbol == "%")
            if not cut and at >= taken:
                rule, parts = replaced(system, found[-1], at, known, Chance(seed, number, at))
                applied.add(rule)
                after += parts
                taken = at + len(rule.predecessors if rule else [module])
        found.append(shortened(system, after, known))
    return [[(module.symbol, module.arguments) for module in word] for word in found], applied - {None}
