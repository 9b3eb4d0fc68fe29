"""A system as a cpfg text, and what cpfg lacks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import chain

from lsys_kit.notation.dialects.cpfg.expressions import expression_text, missing_function
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression
from lsys_kit.notation.model.modules import END, Module, Pattern, flat
from lsys_kit.notation.model.system import FLAT, LOOK, Constant, LSystem, Production
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.notation.syntax.formatting import first_missing, unusual

_RANGE_END = re.compile(r"-?\d+(\.\d+)?(/\d+)?")


def module_text(module: Module | Pattern) -> str:
    """A module in cpfg's notation.

    >>> module_text(Module("M", (2, -1)))
    'M(2,-1)'
    """
    if not module.arguments:
        return module.symbol
    texts = (expression_text(a) if isinstance(a, Expression) else number_text(a) for a in module.arguments)
    return f"{module.symbol}({','.join(texts)})"


def joined_word(texts: Iterable[str]) -> str:
    """The texts of modules as one word: a blank only where "@T" and the like would make a symbol with the letter after it.

    >>> joined_word(["F", "@T", "s", "[", "+", "F", "]"])
    'F@T s[+F]'
    """
    return re.sub(r"(@T(?=\0[a-z])|@G(?=\0[sce])|@P(?=\0[SCD]))", r"\1 ", "\0".join(texts)).replace("\0", "")


def system_text(system: LSystem) -> str:
    """The text of a system that lacks nothing in cpfg."""
    return "\n".join(_lines(system))


def _lines(system: LSystem) -> Iterator[str]:
    yield from map(_macro_line, system.constants)
    yield "Lsystem: 1"
    for name, text in unusual(system, "seed", "steps"):
        yield f"{name.replace('steps', 'derivation length')}: {text}"
    yield from _passed(system)
    yield from (f"/* {name}: {text} */" for name, text in unusual(system, "angle", "heading", "length", *LOOK))
    yield f"Axiom: {joined_word(map(module_text, system.axiom))}"
    yield from map(_rule, system.productions)
    yield from _section("decomposition", system.decomposition, system.decomposition_depth)
    yield from _section("homomorphism", system.interpretation, None if system.depth == 1 else system.depth)
    yield "endlsystem"


def _passed(system: LSystem) -> Iterator[str]:
    """What contexts pass over; right contexts pass over brackets too where they are ignored, or not considered."""
    if system.considered:
        yield f"consider: {joined_word(system.considered)}{'' if system.branches == FLAT else '[]'}"
    elif system.ignored or system.branches == FLAT:
        yield f"ignore: {joined_word(system.ignored)}{'[]' if system.branches == FLAT else ''}"


def _section(keyword: str, rules: Iterable[Production], depth: int | None) -> Iterator[str]:
    if rules or depth is not None:
        yield keyword
    if depth is not None:
        yield f"maximum depth: {depth}"
    yield from map(_rule, rules)


def _macro_line(constant: Constant) -> str:
    """A constant, in parentheses where its parts could bind to the neighbours of its name."""
    value = expression_text(constant.value)
    apart = isinstance(constant.value, Apply) and OPERATORS[constant.value.operator].precedence is not None
    span = " /* {} .. {} by {} */".format(*constant.range) if constant.range else ""
    return f"#define {constant.name} {f'({value})' if apart else value}{span}"


def _rule(rule: Production) -> str:
    left = f"{joined_word(map(module_text, rule.left))} < " if rule.left else ""
    own = joined_word(map(module_text, rule.predecessors))
    right = f" > {joined_word(_right_context(rule.right))}" if rule.right else ""
    condition = f" : {expression_text(rule.condition)}" if rule.condition is not None else ""
    probability = f" : {expression_text(rule.probability)}" if rule.probability is not None else ""
    successor = joined_word(map(module_text, flat(rule.successor))) or "*"
    return f"{re.sub('^//', '/ /', left)}{own}{right}{condition} --> {successor}{probability}"


def _right_context(modules: Iterable[Pattern]) -> Iterator[str]:
    """A right context, with "=" for the rest of each branch whose end it does not name."""
    before = ""
    for module in modules:
        if module.symbol == "]" and before != END:
            yield "="
        if module.symbol != END:
            yield module_text(module)
        before = module.symbol


def missing_feature(system: LSystem) -> str | None:
    """The first thing that a system has and cpfg lacks, in words."""
    if system.turtle != "abop":
        return f"turtle commands of {TURTLE_DIALECTS[system.turtle].title}"
    found = chain(
        (
            first_missing(
                system, "round brackets as branches", "repetition", "meta-rules", "right contexts that name any branch", "field"
            ),
        ),
        map(missing_function, _expressions(system)),
        map(_lacking_range, system.constants),
    )
    return next(filter(None, found), None)


def _expressions(system: LSystem) -> Iterator[Expression]:
    yield from (constant.value for constant in system.constants)
    yield from (argument for module in system.modules for argument in module.arguments)
    for rule in system.rules:
        yield from (expression for expression in (rule.condition, rule.probability) if expression is not None)


def _lacking_range(constant: Constant) -> str | None:
    numbers = all(_RANGE_END.fullmatch(str(end)) for end in constant.range or ())
    return None if numbers else "ends of sliders that are calculated"
