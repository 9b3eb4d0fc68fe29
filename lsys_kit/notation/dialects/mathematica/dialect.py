"""Mathematica's notation, after Jacob: definitions of an axiom, of rules and of an L-system; its grammar is
`grammar.lark`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsys_kit.notation.dialects.mathematica.actions import transformer
from lsys_kit.notation.dialects.mathematica.builder import finish
from lsys_kit.notation.dialects.mathematica.diagnostics import DIAGNOSTICS
from lsys_kit.notation.dialects.mathematica.expressions import KNOWN
from lsys_kit.notation.dialects.mathematica.spelling import SPELLING
from lsys_kit.notation.dialects.mathematica.statements import statements, without_nested_comments
from lsys_kit.notation.dialects.mathematica.writer import module_text, system_text
from lsys_kit.notation.model.expressions import Apply, Name
from lsys_kit.notation.model.operators import OPERATORS
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.formatting import first_missing
from lsys_kit.notation.syntax.text.subscripts import LINE_OF_SUBSCRIPTS, subscripts
from lsys_kit.notation.syntax.text.transcript import Transcript, as_typed, edited

_MARKS = re.compile(
    r"\b(?:LRule|LRULES|AXIOM|LSystem|run\w*System)\s*\[|\w_\s*/;|^[^\S\n]*+Rules\s*+:", re.IGNORECASE | re.MULTILINE
)
"""What is found in texts of this notation, and in no others."""
_SETTING_NAMES = frozenset(("angle", "heading", "length", "seed", "steps", "turtle", "skippattern"))
"""What a definition sets, so that no constant can have that name."""


def _lacking(system: LSystem) -> str | None:
    return first_missing(
        system,
        "predecessors of several modules",
        "probabilities",
        "repetition",
        "decomposition rules",
        "interpretation rules",
        "meta-rules",
        "right contexts that name the next branch",
        "right contexts that pass over brackets",
        "field",
    ) or next(_own_lacks(system), None)


def _own_lacks(system: LSystem) -> Iterator[str]:
    """What only this notation lacks."""
    if any(module.symbol == "ε" for rule in system.rules for module in rule.right):
        yield "branch ends in contexts"
    if system.considered:
        yield "considered symbols"
    if system.depth != 1 or system.decomposition_depth is not None:
        yield "depth"
    names, functions = _names_and_functions(system)
    taken = {constant.name for constant in system.constants if constant.name.lower() in _SETTING_NAMES} | {"Degree"}
    yield from (f'other meaning of the name "{name}"' for name in sorted(names & taken))
    yield from (f'name like "{name}"' for name in sorted(names) if name.endswith("_"))
    yield from (f"function {name}" for name in sorted(functions - KNOWN))


def _names_and_functions(system: LSystem) -> tuple[set[str], set[str]]:
    """The names and the functions of a system."""
    names, functions = {constant.name for constant in system.constants}, set[str]()
    parts = [
        *(part for constant in system.constants for part in (constant.value, *(constant.range or ()))),
        *(rule.condition for rule in system.rules),
        *(argument for module in system.modules for argument in module.arguments),
    ]
    while parts:
        part = parts.pop()
        if isinstance(part, Name):
            names.add(part.name)
        elif isinstance(part, Apply):
            parts.extend(part.operands)
            functions |= {part.operator} if OPERATORS[part.operator].precedence is None else set()
    return names, functions


def _transcribe(source: str) -> Transcript:
    """A text with each subscript of printed output behind its letter."""
    if not LINE_OF_SUBSCRIPTS.search(source):
        return as_typed(source)
    return edited(source, subscripts(without_nested_comments(source), "", "[]"))


MATHEMATICA = Dialect(
    name="mathematica",
    statements=statements,
    transformer=transformer,
    finish=finish,
    diagnostics=DIAGNOSTICS,
    module=module_text,
    joined=" ".join,
    write=system_text,
    missing_feature=_lacking,
    likely=lambda text: 3 * len(_MARKS.findall(text)),
    spelling=SPELLING,
    transcribe=_transcribe,
)
