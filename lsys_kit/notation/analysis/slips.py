"""What the text of a model says and its author hardly meant: comments that are read as modules, decimals with a comma."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import groupby, islice, pairwise

from lsys_kit.notation.analysis.problems import Problem
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Item, Pattern, flat, joined
from lsys_kit.notation.model.system import LSystem, Production

_ALONE, _DOUBLED = frozenset("#%;"), frozenset("/-#%;")
"""How comments begin elsewhere: with one sign, or with two."""
_PROSE = re.compile(r"[A-Za-z]{3,}")
"""A word of a sentence, rather than a symbol."""
_SENTENCE = _DOUBLED | frozenset(".!',")
"""Signs that stand in sentences, too."""
_ONE_VALUE = frozenset("Ffg+-&^\\/!#;',")
"""Symbols that take one value in the commands of most turtles."""
_ANGLES = frozenset(("delta", "theta", "angle", "angle_increment", "turn"))
"""What the angle of the turns is called elsewhere."""
_DECIMAL_COMMA = re.compile(r"\(\s*(\d+)\s*,\s*(\d+)\s*\)$")


def slips(system: LSystem) -> Iterator[Problem]:
    """What is probably not meant, wherever it stands.

    >>> from lsys_kit.notation.read import read
    >>> [problem.code for problem in slips(read("axiom: A\\nA -> F(0,5) A # it grows"))]
    ['comment as modules', 'decimal comma']
    """
    yield from _comments(system)
    yield from _decimal_commas(system)
    yield from _unused_constants(system)


def _unused_constants(system: LSystem) -> Iterator[Problem]:
    """The constants whose names stand nowhere else in the text; files beside a model of cpfg may use its macros."""
    constants = system.constants if system.notation not in ("cpfg", "mathematica") else ()
    words = Counter(re.findall(r"\w+", system.source)) if constants else Counter()
    for constant in constants:
        if words[constant.name] == 1:
            angle = constant.name.lower() in _ANGLES and "angle" not in system.source
            yield Problem(
                "angle used nowhere" if angle else "constant used nowhere",
                constant.at,
                {"name": constant.name, "value": constant.value},
            )


def _comments(system: LSystem) -> Iterator[Problem]:
    """The ends of successors that read like a comment: a sign that begins one elsewhere, and words that occur nowhere else."""
    comments = [(rule, _comment(rule.successor, system.source)) for rule in system.rules]
    if not any(comment for _, comment in comments):
        return
    said = (module.symbol for rule, comment in comments for module in islice(flat(rule.successor), _before(rule, comment)))
    known = {
        *said,
        *(module.symbol for rule in system.rules for module in rule.predecessors),
        *(module.symbol for module in system.axiom),
    }
    for rule, comment in comments:
        words = [module.symbol for module in comment if module.symbol.isalnum() and module.symbol not in known]
        if any(map(_PROSE.fullmatch, words)) and words[0] == next(m.symbol for m in comment if m.symbol.isalnum()):
            yield Problem("comment as modules", rule.at, {"said": joined(map(str, comment)), "rule": rule})


def _before(rule: Production, comment: Sequence[Pattern]) -> int:
    """How many modules of a successor stand before its comment."""
    return sum(1 for _ in flat(rule.successor)) - len(comment)


def _comment(successor: Sequence[Item], source: str) -> Sequence[Pattern]:
    """The end of a successor, from a sign that begins a comment elsewhere: in one piece, or after a blank and before a word."""
    first = next((at for at in range(len(successor), 0, -1) if not _in_sentence(successor[at - 1])), 0)
    end = [item for item in successor[first:] if isinstance(item, Pattern)]
    runs = [(sign, [at for at, _ in run]) for sign, run in groupby(enumerate(end), lambda pair: pair[1].symbol)]
    for (sign, places), (following, _) in pairwise(runs):
        start = (end[places[0]].at or (0, 0))[0]
        alone = sign in _ALONE and source[start - 1 : start].isspace()
        if (alone or (sign in _DOUBLED and len(places) > 1)) and following.isalnum():
            return end[places[0] :]
    return ()


def _in_sentence(item: Item) -> bool:
    """Whether a module may be a word or a sign of a sentence."""
    return isinstance(item, Pattern) and not item.arguments and (item.symbol.isalnum() or item.symbol in _SENTENCE)


def _decimal_commas(system: LSystem) -> Iterator[Problem]:
    """Two whole numbers as values of what has one value elsewhere: probably one number, with a point."""
    whole = [module for module in system.modules if len(module.arguments) == 2 and all(map(_is_whole, module.arguments))]
    if not whole:
        return
    single = {module.symbol for module in system.modules if len(module.arguments) == 1} | _ONE_VALUE
    pairs = {module.symbol for rule in system.rules for module in rule.parameters if len(module.arguments) == 2}
    for module in dict.fromkeys(whole):
        if module.symbol in single - pairs:
            start, end = module.at or (0, 0)
            typed = _DECIMAL_COMMA.search(system.source[start : end + 1]) or _DECIMAL_COMMA.search(str(module))
            meant = f"{module.symbol}({typed[1]}.{typed[2]})" if typed else None
            yield Problem("decimal comma", module.at, {"module": module}, meant)


def _is_whole(argument: object) -> bool:
    return isinstance(argument, Number) and isinstance(argument.value, int) and argument.value >= 0
