"""A system written in Mathematica's notation: constants and settings, the axiom, the rules, and a run."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator

from lsys_kit.notation.dialects.mathematica.actions import condition_of
from lsys_kit.notation.dialects.mathematica.expressions import expression_text
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.expressions import Apply, Expression, Name, names_in
from lsys_kit.notation.model.modules import Module, Pattern, flat
from lsys_kit.notation.model.system import LOOK, Constant, LSystem, Production
from lsys_kit.notation.syntax.formatting import OWN_NOTATION, unusual

_PLAIN_NAME = re.compile(r"(?!(?:axiom|lrules?|lsystem|left|pred|right|succ|null)$)[a-z]\w*(?<!_)", re.IGNORECASE | re.ASCII)
"""A symbol that needs no quotation marks."""


def symbol_text(symbol: str) -> str:
    """A symbol, in quotation marks unless it is a name.

    >>> symbol_text("aR"), symbol_text("+")
    ('aR', '"+"')
    """
    return symbol if _PLAIN_NAME.fullmatch(symbol) else '"' + re.sub(r'(["\\])', r"\\\1", symbol) + '"'


def module_text(module: Module | Pattern) -> str:
    """A module of a word.

    >>> module_text(Module("a", (1, 2)))
    'a[1, 2]'
    """
    return _with_arguments(module, map(_argument_text, module.arguments))


def _with_arguments(module: Module | Pattern, texts: Iterable[str]) -> str:
    return symbol_text(module.symbol) + (f"[{', '.join(texts)}]" if module.arguments else "")


def _argument_text(argument: Expression | Value) -> str:
    return expression_text(argument) if isinstance(argument, Expression) else number_text(argument)


def system_text(system: LSystem) -> str:
    """The text of a system that lacks nothing in this notation."""
    taken = {constant.name for constant in system.constants}
    lrules, lsystem, growth = (_free_name(name, taken) for name in ("lrules", "lsystem", "growth"))
    lines = [
        *map(_constant, system.constants),
        *_settings(system),
        f"axiom = AXIOM[{_word_text(system.axiom)}];",
        _lrules_text(system, lrules, taken),
        f"{lsystem} = LSystem[axiom, {lrules}];",
    ]
    if system.ignored:
        lines.append(f"skipPattern = {{{', '.join(map(symbol_text, system.ignored))}}};")
    if system.steps is not None:
        lines.append(f"{growth} = runKLSystem[{lsystem}, {system.steps}];")
    return "\n".join(lines)


def _free_name(name: str, taken: Collection[str]) -> str:
    """A name, or one like it that is not taken."""
    return name if name not in taken else _free_name(f"{name}1", taken)


def _constant(constant: Constant) -> str:
    text = f"{constant.name} = {expression_text(constant.value)};"
    if constant.range is None:
        return text
    low, high, step = map(expression_text, constant.range)
    return f"{text} (* {low} .. {high} by {step} *)"


def _settings(system: LSystem) -> Iterator[str]:
    if system.turtle != OWN_NOTATION:
        yield f'turtle = "{system.turtle}";'
    yield from (f"{name} = {text};" for name, text in unusual(system, "angle", "heading", "length", "seed"))
    yield from (f'{name} = "{said}";' for name, said in unusual(system, *LOOK))


def _word_text(modules: Iterable[Pattern]) -> str:
    return ", ".join(map(module_text, modules))


def _lrules_text(system: LSystem, name: str, taken: Collection[str]) -> str:
    rules = ",\n    ".join(_rule(production, taken) for production in system.productions)
    return f"{name} =\n  LRULES[\n    {rules}\n  ];" if rules else f"{name} = LRULES[];"


def _rule(production: Production, constants: Collection[str]) -> str:
    conditions = _conditions(production, constants)
    patterns = [_pattern(module, constants, conditions.get(index)) for index, module in enumerate(production.parameters)]
    own = len(production.left)
    return (
        f"LRule[LEFT[{', '.join(patterns[:own])}], PRED[{patterns[own]}], RIGHT[{', '.join(patterns[own + 1 :])}], "
        f"SUCC[{_word_text(flat(production.successor))}]]"
    )


def _pattern(module: Pattern, constants: Collection[str], condition: Expression | None) -> str:
    """A pattern with its condition: inside, where it is about the only parameter, else after it."""
    parameters = _parameters(module, constants)
    texts = [
        f"{argument}_" if isinstance(argument, Name) and argument.name in parameters else _argument_text(argument)
        for argument in module.arguments
    ]
    if condition is None:
        return _with_arguments(module, texts)
    if len(parameters) == len(texts) == 1 and names_in(condition) <= {*parameters, *constants}:
        return _with_arguments(module, [f"{texts[0]} /; {expression_text(condition)}"])
    return f"{_with_arguments(module, texts)} /; {expression_text(condition)}"


def _parameters(module: Pattern, constants: Collection[str]) -> list[str]:
    return [argument.name for argument in module.arguments if isinstance(argument, Name) and argument.name not in constants]


def _conditions(production: Production, constants: Collection[str]) -> dict[int, Expression]:
    """The parts of a production's condition by the module with which they are written, so that reading joins them again: each
    with the last module on the side of its parameters, or with the predecessor."""
    if production.condition is None:
        return {}
    own, found = len(production.left), dict[int, list[Expression]]()
    owners = {name: index for index, module in enumerate(production.parameters) for name in _parameters(module, constants)}
    for part in _conjuncts(production.condition):
        places = {owners[name] for name in names_in(part) if name in owners}
        together = bool(places) and len({(place > own) - (place < own) for place in places}) == 1
        found.setdefault(max(places) if together else own, []).append(part)
    parted = {index: condition for index in sorted(found) if (condition := condition_of(found[index]))}
    return parted if condition_of(parted.values()) == production.condition else {own: production.condition}


def _conjuncts(condition: Expression) -> tuple[Expression, ...]:
    if isinstance(condition, Apply) and condition.operator == "&&":
        return *_conjuncts(condition.operands[0]), condition.operands[1]
    return (condition,)
