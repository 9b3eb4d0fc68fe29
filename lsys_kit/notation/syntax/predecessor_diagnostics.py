"""What a parser stumbled over before the arrow of a production: contexts, the module to replace, a condition without ":"."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.model.expressions import Name
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.syntax.failure import ParseFailure, blank_parentheses
from lsys_kit.notation.syntax.statements import ARROW

PRODUCTION = 'A production reads "A -> B": what is replaced, an arrow, what replaces it.'
_NOT_IN_STRINGS = {"(": "values", ":": "conditions", "<": "contexts", ">": "contexts"}
_OPERATORS = frozenset(("TIMES", "SIGN", "POWER"))
_SIDES = 'A left context ends with "<", a right context begins with ">", as in "A < B > C -> D".'
_CONDITION = re.compile(r"(if|when)\b|(\w+)\s*(<=|>=|==|!=|[<>=≤≥≠]|\\[lgn]eq?)\s*(\w+|\S?)")
_COLON = 'A ":" is missing before the condition', 'A condition stands between ":" and the arrow, as in "A(t) : t < 5 -> B".'


def diagnose_predecessor(failure: ParseFailure) -> ModelSyntaxError | None:
    """What is wrong where the module to replace, its contexts and the colon are expected."""
    arrow = ARROW.search(failure.text, failure.start, failure.end)
    if arrow is None:
        return _missing_arrow(failure)
    head = failure.text[failure.start:arrow.start()]
    if head.rstrip().endswith("<") and ":" not in head:
        return failure.error("The module to replace is missing", _SIDES, arrow.start(), len(arrow.group()))
    if failure.at > arrow.start() or (":" in failure.before and not head.startswith("meta")):
        return None
    if failure.accepted == {"ARROW"} and failure.found in _NOT_IN_STRINGS:
        return failure.error(f"A plant string has no {_NOT_IN_STRINGS[failure.found]}", PRODUCTION)
    if failure.found == "ε":
        return failure.error('This "ε" ends no branch', 'It stands before the "]" of a branch in a right context, as in '
                             '"A > [B ε]C -> D".')
    return _condition(failure, head) or _context(failure) or _several(failure, head)


def _missing_arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    if not {"ARROW", "LESSTHAN"} & failure.accepted or failure.found.startswith("="):
        return None
    garbled = re.compile(r"\.{2,}|[•…⋯]+").search(failure.text, failure.start, failure.end)
    if garbled:
        return failure.error("This is no arrow", 'An arrow is typed "->", in one piece.', garbled.start(), len(garbled.group()))
    at = _behind_first(failure) if failure.accepted == {"LESSTHAN"} else failure.at
    return failure.error("An arrow is missing here", PRODUCTION, at)


def _behind_first(failure: ParseFailure) -> int:
    """The offset of what follows the first module of a statement."""
    text = failure.text[failure.start:failure.end]
    symbol = re.match(r"\s*([A-Za-z_]\w*|\S)?", text)
    rest = blank_parentheses(text)[symbol.end() if symbol else 0:]
    return failure.end - len(rest.lstrip())


def _condition(failure: ParseFailure, head: str) -> ModelSyntaxError | None:
    """A condition before which no ":" stands: what is compared is a parameter, or compared with a number."""
    second = _behind_first(failure)
    found = _CONDITION.match(failure.text, second, failure.start + len(head))
    if not found or head.startswith("meta") or not {"COLON", "LESSTHAN", "NAME"} & failure.accepted:
        return None
    parameters = re.findall(r"\w+", failure.text[failure.start:second])[1:]
    if found[1] or found[3] not in "<>" or {found[2], found[4]} & {*parameters} or found[4][:1].isdigit():
        return failure.error(*_COLON, second)
    return None


def missing_colon(productions: Iterable[Production], symbols: Collection[str], source: str) -> None:
    """What reads as a left context must not be a condition without its colon, as in "A(t) t < T -> B".

    There a parameter stands as if it were a module, and no module has its name.
    """
    for production in productions:
        before = [*production.left, production.predecessor]
        parameters = {argument.name for module in before for argument in module.arguments if isinstance(argument, Name)}
        compared = {module.symbol for module in before if not module.arguments} & parameters
        if production.left and compared - {*symbols}:
            first = next(index for index, module in enumerate(before) if module.arguments)
            raise ModelSyntaxError(_COLON[0], source, *span(before[min(first + 1, len(before) - 1)]), _COLON[1])


def _context(failure: ParseFailure) -> ModelSyntaxError | None:
    """A "<" or ">" where none can stand."""
    found, before = failure.found, failure.before
    if found not in ("<", ">") or "RELATION" in failure.accepted:
        return None
    if before.startswith("meta"):
        return failure.error("A meta-rule has no contexts", 'It says what stands for a row of modules, as in '
                             '"meta: f(x) f(y) -> f(x+y)".')
    if before.endswith("<"):
        return failure.error("The module to replace is missing", _SIDES)
    if found in before:
        side = 'left context: "A B < C -> D"' if found == "<" else 'right context: "A > B C -> D"'
        return failure.error(f'A second "{found}" stands here', f"A production has one {side}.")
    if ">" in before:
        return failure.error("A left context stands here", 'It stands before the module that is replaced: "C < A > B -> D".')
    return None


def _several(failure: ParseFailure, head: str) -> ModelSyntaxError | None:
    """More than one module to replace."""
    hint = _SIDES if "<" in head or ">" in head else 'Write a production for each: "A -> ...", then "B -> ...".'
    if "LESSTHAN" in failure.accepted and "ARROW" not in failure.accepted and (
            failure.found in (":", ">") or ARROW.match(failure.found)):
        return failure.error("Only one module can be replaced", hint, _behind_first(failure), 1)
    if "ARROW" in failure.accepted and not _OPERATORS & failure.accepted and failure.found[:1].isalpha():
        return failure.error("Only one module can be replaced", hint)
    return None
