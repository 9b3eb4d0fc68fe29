"""Diagnostics of what comes before the arrow of a production: contexts, the module to replace, a condition without ":"."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.analysis.problems import Problem, problem
from lsys_kit.notation.model.expressions import Name
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.syntax.common_diagnostics import after_first
from lsys_kit.notation.syntax.failure import ParseFailure
from lsys_kit.notation.syntax.text.statements import ARROW
from lsys_kit.notation.syntax.wording import worded

_NOT_IN_STRINGS = {"(": "values", ":": "conditions", "<": "contexts", ">": "contexts"}
_OPERATORS = frozenset(("TIMES", "SIGN", "POWER"))
_GARBLED_ARROW = re.compile(r"\.{2,}|[•…⋯]+|(?<![-–—−~])[-–—−~]*-[ \t]++>|[–—−~]>")
_CONDITION = re.compile(r"(if|when)\b|(\w+)\s*(<=|>=|==|!=|[<>=≤≥≠]|\\[lgn]eq?)\s*(\w+|\S?)")


def diagnose_predecessor(failure: ParseFailure) -> ModelSyntaxError | None:
    """What is wrong where the module to replace, its contexts or the colon is expected."""
    arrow = ARROW.search(failure.text, failure.start, failure.end)
    if arrow is None:
        return _missing_arrow(failure)
    head = failure.text[failure.start : arrow.start()]
    if head.rstrip().endswith("<") and ":" not in head:
        return failure.error("The module to replace is missing", failure.spelling.contexts, arrow.start(), len(arrow.group()))
    if failure.at > arrow.start() or (":" in failure.before and not head.startswith("meta")):
        return None
    if failure.accepted == {"ARROW"} and failure.found in _NOT_IN_STRINGS:
        return failure.error(f"A plant string has no {_NOT_IN_STRINGS[failure.found]}", failure.spelling.rule_example)
    if failure.found == "ε":
        return failure.error(
            'This "ε" does not end a branch',
            'It is written before the "]" of a branch in a right context, as in "A > [B ε]C -> D".',
        )
    return _condition(failure, head) or _context(failure) or _several(failure)


def _missing_arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    if not {"ARROW", "LESSTHAN"} & failure.accepted or failure.found.startswith("="):
        return None
    garbled = _GARBLED_ARROW.search(failure.text, failure.start, failure.end)
    if garbled:
        return failure.error(
            "This is not an arrow",
            f'An arrow is typed "{failure.spelling.arrow}", in one piece.',
            garbled.start(),
            len(garbled.group()),
        )
    at = after_first(failure) if "LESSTHAN" in failure.accepted else failure.at
    return failure.error("An arrow is missing here", failure.spelling.rule_example, at)


def _condition(failure: ParseFailure, head: str) -> ModelSyntaxError | None:
    """A condition without its ":": a comparison of a parameter, or with a number."""
    second = after_first(failure)
    found = _CONDITION.match(failure.text, second, failure.start + len(head))
    if not found or head.startswith("meta") or not {"COLON", "LESSTHAN", "NAME"} & failure.accepted:
        return None
    parameters = re.findall(r"\w+", failure.text[failure.start : second])[1:]
    if found[1] or found[3] not in "<>" or {found[2], found[4]} & {*parameters} or found[4][:1].isdigit():
        return failure.error(*worded(Problem("condition without colon"), failure.spelling), second)
    return None


def missing_colon(productions: Iterable[Production], symbols: Collection[str]) -> None:
    """What is replaced and its left context must not be a condition without its colon, as in "A(t) t < T -> B".

    It is one where a parameter is used as if it were a module, and no module has its name.
    """
    for production in productions:
        before = [*production.left, *production.predecessors]
        compared = [*before, *production.right[:1]]
        parameters = {argument.name for module in before for argument in module.arguments if isinstance(argument, Name)}
        strange = parameters.intersection(module.symbol for module in compared if not module.arguments).difference(symbols)
        if strange and len(before) > 1 and (production.left or production.right):
            first = next(index for index, module in enumerate(before) if module.arguments)
            raise problem("condition without colon", before[min(first + 1, len(before) - 1)].at)


def _context(failure: ParseFailure) -> ModelSyntaxError | None:
    """A "<" or ">" that is not possible."""
    found, before, arrow = failure.found, failure.before, failure.spelling.arrow
    if found not in ("<", ">") or "RELATION" in failure.accepted:
        return None
    if before.startswith("meta"):
        return failure.error(
            "A meta-rule has no contexts", 'It says what replaces a row of modules, as in "meta: f(x) f(y) -> f(x+y)".'
        )
    if before.endswith("<"):
        return failure.error("The module to replace is missing", failure.spelling.contexts)
    if found in before:
        side, example = ("left", "A B < C") if found == "<" else ("right", "A > B C")
        return failure.error(f'This is a second "{found}"', f'A production has one {side} context: "{example} {arrow} D".')
    if ">" in before:
        return failure.error(
            "A left context is not possible here", f'It comes before the module that is replaced: "C < A > B {arrow} D".'
        )
    return None


def _several(failure: ParseFailure) -> ModelSyntaxError | None:
    """More than one module to replace, in a plant string."""
    if "ARROW" in failure.accepted and not _OPERATORS & failure.accepted and failure.found[:1].isalpha():
        arrow = failure.spelling.arrow
        return failure.error(
            "Only one module can be replaced", f'Write a production for each: "A {arrow} ...", then "B {arrow} ...".'
        )
    return None
