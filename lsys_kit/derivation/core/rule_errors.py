"""Errors in the application of a production, with the module and the production."""

from __future__ import annotations

from collections.abc import Sequence

from lsys_kit.derivation.core.rules import Rule
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, reason_of
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.registry import dialect_named
from lsys_kit.notation.syntax.wording import Wording
from lsys_kit.notation.write import as_written

AXIOM = Module("axiom")
"""The module from which the axiom is made as a successor."""
UNKNOWN = "it depends on an unknown constant"
"""Why a value that depends on a constant without a value cannot be computed."""


def rule_error(system: LSystem, module: Module | Pattern, rule: Rule, fault: Exception) -> LSystemError:
    """A value that cannot be computed."""
    dialect = dialect_named(system.notation)
    shown, production = dialect.module(module), as_written(system, rule.production)
    what = "The axiom" if module is AXIOM else f"{shown} under production {rule.number + 1}, {production},"
    hint = None if module is AXIOM else "A condition before the arrow can keep such values out."
    if rule.looks:
        hint = "Where there is no such shoot, an answer is infinite." if isinstance(fault, OverflowError) else None
    if isinstance(fault, ZeroDivisionError):
        hint = " ".join(filter(None, (hint, dialect.spelling.wordings.get("division by zero", Wording("")).hint))) or None
    start, end = rule.production.at or (None, None)
    return ModelValueError(f"{what} has no value: {reason_of(fault)}", system.source or None, start, end, hint)


def undecided_condition(system: LSystem, constants: Sequence[Value], module: Module, rule: Rule) -> LSystemError:
    """A condition that depends on an unknown constant."""
    names = sorted({str(name) for value in constants for name in getattr(value, "free_symbols", ())})
    said = (
        f"Whether production {rule.number + 1}, {as_written(system, rule.production)}, applies to "
        f"{dialect_named(system.notation).module(module)} cannot be decided"
    )
    start, end = rule.production.at or (None, None)
    return ModelValueError(
        said, system.source or None, start, end, f"It depends on {', '.join(names)}: choose a value for {names[0]}."
    )
