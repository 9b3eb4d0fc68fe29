"""A system in GROGRA's notation: its words, its lines, and what the notation lacks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lsys_kit.notation.dialects.grogra.declarations import declarations, inexpressible, rule_with_variables
from lsys_kit.notation.dialects.grogra.probabilities import complete_probabilities
from lsys_kit.notation.dialects.grogra.variables import Variable
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import Expression, Name, Number, Style, styled_text
from lsys_kit.notation.model.modules import END, Item, Module, Pattern, Repeat
from lsys_kit.notation.model.system import Constant, LSystem, Production
from lsys_kit.notation.syntax.formatting import first_missing, look

STYLE = Style({"==": "="})
_COMMAND = re.compile(r"R[ULHVG]|[FfLDNPVCHU]l?[+*]?|@")
_PLAIN_NUMBER = re.compile(r"-?\d+(\.\d+)?")
START = (Pattern("*"),)
"""The axiom of a text that names none."""


def module_text(module: Module | Pattern) -> str:
    """A module; a plain number is glued to a built-in command.

    >>> print(module_text(Module("RU", (45,))), module_text(Module("L*", (0.6,))), module_text(Module("a", (1, 2))))
    RU45 L*0.6 a(1, 2)
    """
    texts = [styled_text(a, STYLE) if isinstance(a, Expression) else number_text(a) for a in module.arguments]
    if len(texts) == 1 and _COMMAND.fullmatch(module.symbol) and _PLAIN_NUMBER.fullmatch(texts[0]):
        return module.symbol + texts[0]
    return f"{module.symbol}({', '.join(texts)})" if texts else module.symbol


def expression_text(expression: Expression) -> str:
    """An expression, with "=" for equality."""
    return styled_text(expression, STYLE)


def joined_word(texts: Iterable[str]) -> str:
    """The texts of modules as one word: blanks between them, none inside brackets.

    >>> joined_word(["F", "[", "RU45", "b", "]", "a"])
    'F [RU45 b] a'
    """
    parts: list[str] = []
    for text in texts:
        if parts and parts[-1] != "[" and text != "]":
            parts.append(" ")
        parts.append(text)
    return "".join(parts)


def successor_text(items: Iterable[Item]) -> str:
    """The text of a successor, with what is repeated as `&(n) < ... >`."""
    return joined_word(
        f"&{_count_text(item.count)} < {successor_text(item.body)} >" if isinstance(item, Repeat) else module_text(item)
        for item in items
    )


def _count_text(count: Expression) -> str:
    text = styled_text(count, STYLE)
    return text if text.isdigit() else f"({text})"


def rule_text(rule: Production, arrow: str = "#") -> str:
    """The text of a rule: the condition in front, the probability at the end."""
    condition = "" if rule.condition is None else f"({styled_text(rule.condition, STYLE)})"
    left, right = joined_word(map(module_text, rule.left)), joined_word(map(module_text, rule.right))
    probability = "" if rule.probability is None else f"?{styled_text(rule.probability, STYLE)}"
    parts = (
        condition,
        f"{left} <" if left else "",
        module_text(rule.predecessor),
        f"> {right}" if right else "",
        arrow,
        successor_text(rule.successor),
        probability,
    )
    return " ".join(filter(None, parts))


def system_text(system: LSystem) -> str:
    """The text of a system that lacks nothing in GROGRA's notation."""
    names = declarations(system)
    return ",\n".join(
        [
            *_settings(system),
            *map(_constant, system.constants),
            *map(_variable, names.variables),
            *_axiom(system),
            *(rule_text(rule_with_variables(rule, names)) for rule in system.productions),
            *(rule_text(rule_with_variables(rule, names), "##") for rule in system.interpretation),
        ]
    )


def _settings(system: LSystem) -> Iterator[str]:
    """The lines of settings that differ from the defaults."""
    if system.turtle != "grogra":
        yield f"\\set turtle {system.turtle}"
    for directive, value, usual in (
        ("\\angle", system.angle, 90),
        ("\\set heading", system.heading, 90),
        ("\\length", system.length, None),
        ("\\set seed", system.seed, None),
        ("\\set depth", system.depth, 1),
    ):
        if value is not None and value != usual:
            yield f"{directive} {_value_text(Number(value))}"
    yield from (f"\\set {name} {said}" for name, said in look(system))


def _constant(constant: Constant) -> str:
    ends = [_value_text(part) for part in constant.range or ()]
    span = " in {} .. {} by {}".format(*ends) if ends else ""
    return f"\\const {constant.name} {_value_text(constant.value)}{span}"


def _value_text(value: Expression) -> str:
    """A value on a line of its own: in parentheses, if it is calculated."""
    text = styled_text(value, STYLE)
    return text if isinstance(value, Name) or re.fullmatch(r"-?[\d.]+(e[+-]?\d+)?", text) else f"({text})"


def _axiom(system: LSystem) -> Iterator[str]:
    if system.axiom != START or system.steps is not None or all(r.predecessor != START[0] for r in system.productions):
        steps = "" if system.steps is None else f" {min(1, system.steps)}-{system.steps}"
        yield f"\\axiom {joined_word(map(module_text, system.axiom))}{steps}"


def _variable(variable: Variable) -> str:
    return " ".join(("\\var", variable.name, variable.kind, *map(_value_text, variable.values)))


def missing_feature(system: LSystem) -> str | None:
    """The first thing that a system has and GROGRA's notation lacks, in words."""
    ends = any(module.symbol == END for rule in system.rules for module in rule.right)
    return (
        first_missing(
            system,
            "round brackets as branches",
            "predecessors of several modules",
            "decomposition rules",
            "meta-rules",
            "ignored symbols",
            "right contexts that name the next branch",
            "right contexts that pass over brackets",
            "field",
        )
        or (None if system.decomposition_depth is None else "depth of decomposition")
        or ("branch ends in contexts" if ends else None)
        or (None if system.axiom else "empty axiom")
        or inexpressible(system)
        or (None if complete_probabilities(system)[0] == system.productions else "probabilities with another sum than 1")
    )
