"""What a parser stumbled over before the arrow of a production: contexts, the module to replace, a condition without ":"."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.model.expressions import Name
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.syntax.failure import Stumble, outside
from lsys_kit.notation.syntax.statements import ARROW

PRODUCTION = 'A production reads "A -> B": what is replaced, an arrow, what replaces it.'
_NOT_IN_STRINGS = {"(": "values", ":": "conditions", "<": "contexts", ">": "contexts"}
_OPERATORS = frozenset(("TIMES", "SIGN", "POWER"))
_SIDES = 'A left context ends with "<", a right context begins with ">", as in "A < B > C -> D".'
_CONDITION = re.compile(r"(if|when)\b|(\w+)\s*(<=|>=|==|!=|[<>=≤≥≠]|\\[lgn]eq?)\s*(\w+|\S?)")
_COLON = 'A ":" is missing before the condition', 'A condition stands between ":" and the arrow, as in "A(t) : t < 5 -> B".'


def before_arrow(stumble: Stumble) -> ModelSyntaxError | None:
    """What is wrong where the module to replace, its contexts and the colon are expected."""
    arrow = ARROW.search(stumble.text, stumble.start, stumble.end)
    if arrow is None:
        return _missing_arrow(stumble)
    head = stumble.text[stumble.start:arrow.start()]
    if head.rstrip().endswith("<") and ":" not in head:
        return stumble.error("The module to replace is missing", _SIDES, arrow.start(), len(arrow.group()))
    if stumble.at > arrow.start() or (":" in stumble.before and not head.startswith("meta")):
        return None
    if stumble.accepted == {"ARROW"} and stumble.found in _NOT_IN_STRINGS:
        return stumble.error(f"A plant string has no {_NOT_IN_STRINGS[stumble.found]}", PRODUCTION)
    if stumble.found == "ε":
        return stumble.error('This "ε" ends no branch', 'It stands before the "]" of a branch in a right context, as in '
                             '"A > [B ε]C -> D".')
    return _condition(stumble, head) or _context(stumble) or _several(stumble, head)


def _missing_arrow(stumble: Stumble) -> ModelSyntaxError | None:
    if not {"ARROW", "LESSTHAN"} & stumble.accepted or stumble.found.startswith("="):
        return None
    garbled = re.compile(r"\.{2,}|[•…⋯]+").search(stumble.text, stumble.start, stumble.end)
    if garbled:
        return stumble.error("This is no arrow", 'An arrow is typed "->", in one piece.', garbled.start(), len(garbled.group()))
    at = _behind_first(stumble) if stumble.accepted == {"LESSTHAN"} else stumble.at
    return stumble.error("An arrow is missing here", PRODUCTION, at)


def _behind_first(stumble: Stumble) -> int:
    """The offset of what follows the first module of a statement."""
    text = stumble.text[stumble.start:stumble.end]
    symbol = re.match(r"\s*([A-Za-z_]\w*|\S)?", text)
    rest = outside(text)[symbol.end() if symbol else 0:]
    return stumble.end - len(rest.lstrip())


def _condition(stumble: Stumble, head: str) -> ModelSyntaxError | None:
    """A condition before which no ":" stands: what is compared is a parameter, or compared with a number."""
    second = _behind_first(stumble)
    found = _CONDITION.match(stumble.text, second, stumble.start + len(head))
    if not found or head.startswith("meta") or not {"COLON", "LESSTHAN", "NAME"} & stumble.accepted:
        return None
    parameters = re.findall(r"\w+", stumble.text[stumble.start:second])[1:]
    if found[1] or found[3] not in "<>" or {found[2], found[4]} & {*parameters} or found[4][:1].isdigit():
        return stumble.error(*_COLON, second)
    return None


def forgotten_colon(productions: Iterable[Production], symbols: Collection[str], source: str) -> None:
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


def _context(stumble: Stumble) -> ModelSyntaxError | None:
    """A "<" or ">" where none can stand."""
    found, before = stumble.found, stumble.before
    if found not in ("<", ">") or "RELATION" in stumble.accepted:
        return None
    if before.startswith("meta"):
        return stumble.error("A meta-rule has no contexts", 'It says what stands for a row of modules, as in '
                             '"meta: f(x) f(y) -> f(x+y)".')
    if before.endswith("<"):
        return stumble.error("The module to replace is missing", _SIDES)
    if found in before:
        side = 'left context: "A B < C -> D"' if found == "<" else 'right context: "A > B C -> D"'
        return stumble.error(f'A second "{found}" stands here', f"A production has one {side}.")
    if ">" in before:
        return stumble.error("A left context stands here", 'It stands before the module that is replaced: "C < A > B -> D".')
    return None


def _several(stumble: Stumble, head: str) -> ModelSyntaxError | None:
    """More than one module to replace."""
    hint = _SIDES if "<" in head or ">" in head else 'Write a production for each: "A -> ...", then "B -> ...".'
    if "LESSTHAN" in stumble.accepted and "ARROW" not in stumble.accepted and (
            stumble.found in (":", ">") or ARROW.match(stumble.found)):
        return stumble.error("Only one module can be replaced", hint, _behind_first(stumble), 1)
    if "ARROW" in stumble.accepted and not _OPERATORS & stumble.accepted and stumble.found[:1].isalpha():
        return stumble.error("Only one module can be replaced", hint)
    return None
