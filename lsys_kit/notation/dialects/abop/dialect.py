"""The kit's own notation, after The Algorithmic Beauty of Plants, and its mathematical form; the grammar is `grammar.lark`."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.expressions import Name
from lsys_kit.notation.model.modules import Pattern, joined
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.syntax.actions import Statements, transformer
from lsys_kit.notation.syntax.builder import Draft, build_system, check_colons
from lsys_kit.notation.syntax.diagnostics import DIAGNOSTICS
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.failure import excerpt
from lsys_kit.notation.syntax.formatting import sections, settings
from lsys_kit.notation.syntax.segmentation import check_digits, segment_system, segment_with_notes
from lsys_kit.notation.syntax.text.printed import IN_A_SET, printed_statements
from lsys_kit.notation.syntax.text.statements import without_comments
from lsys_kit.notation.syntax.text.transcription import likely, transcribe
from lsys_kit.notation.syntax.wording import Spelling

_EDGE = re.compile(r"F_\w+")


def _resolve_deferred(draft: Draft) -> None:
    """Take in what the mathematical form writes differently: an axiom beside a set, the angle δ, the length d."""
    plain = without_comments(draft.source)
    for kind, record, at in draft.deferred:
        if kind == "axiom" and not IN_A_SET.search(plain):
            word, rest = draft.source[at[0] : at[0] + 5], draft.source[at[0] + 5 : at[1]]
            raise problem("no colon", (at[0], at[0] + 5), word=word, keyword=word.lower(), rest=excerpt(rest.strip()))
        draft.add(kind, record, at)
    length = next((constant for constant in draft.constants if constant.name == "d"), None)
    if length and re.search(r"(δ|\\delta)\s*=", plain) and len(re.findall(r"\bd\b", plain)) == 1:
        draft.constants.remove(length)
        draft.add("length", length.value, length.at or (0, 0))
        draft.notes.append('"d" is read as the length of a segment.')


_ROW = re.compile(r"^([ \t]*+\|[ \t][^\n]*[ \t]\|)[ \t]*+\n[ \t]*+\|[ \t][^\n]*[ \t]\|[ \t]*+$", re.MULTILINE)
"""The first of two rows of a table."""
_BAR = re.compile(r"[^\s|][ ]\|[ ][^\s|]")
"""A bar with blanks around it, as between the alternatives of a grammar."""


def _finish(draft: Draft) -> LSystem:
    """The system with names segmented into letters where they were written together, with a note on each."""
    _resolve_deferred(draft)
    check_colons(draft)
    for rule in draft.sections.get("productions", ()):
        if len(rule.predecessors) > 2 and rule.predecessors[0].symbol == "'" == rule.predecessors[-1].symbol:
            raise problem("quoted symbol", rule.at)
    if table := _ROW.search(draft.source):
        raise problem("row of a table", table.span(1))
    tails = (line.replace("→", "->").partition("->")[2] for line in without_comments(draft.source).splitlines())
    if any(" + " not in tail and " - " not in tail and _BAR.search(tail) for tail in tails):
        draft.notes.append(
            '"|" turns the turtle around. For a choice write a rule for each successor: A -> B : 0.5, A -> C : 0.5.'
        )
    system = _with_edges(segment_with_notes(build_system(draft)))
    check_digits(system.modules, system.alphabet)
    return system


def _with_edges(system: LSystem) -> LSystem:
    """F_l, F_r and the like are kinds of edges: a turtle draws each as F (ABOP, section 1.4.1)."""
    drawn = {rule.predecessor.symbol for rule in system.interpretation}
    edges = {
        (module.symbol, len(module.arguments))
        for module in system.modules
        if _EDGE.fullmatch(module.symbol) and module.symbol not in drawn
    }
    if not edges:
        return system
    names = [tuple(Name(f"x{i}") for i in range(size)) for _, size in sorted(edges)]
    rules = (
        Production((Pattern(symbol, values),), (Pattern("F", values[:1]),))
        for (symbol, _), values in zip(sorted(edges), names, strict=True)
    )
    shown = ", ".join(sorted({symbol for symbol, _ in edges}))
    return replace(system, interpretation=(*system.interpretation, *rules), notes=(*system.notes, f"Drawn as F: {shown}."))


def _write(system: LSystem) -> str:
    symbols = {*(module.symbol for module in system.modules), *system.ignored, *system.considered}
    digits = {symbol for symbol in symbols if symbol.isdigit()}.difference(system.alphabet)
    system = replace(system, alphabet=(*system.alphabet, *sorted(digits)))
    while mistaken := segment_system(system)[1]:
        system = replace(system, alphabet=(*system.alphabet, *mistaken))
    return "\n".join(
        [
            *map(str, system.constants),
            *settings(system),
            *map(str, system.surfaces),
            f"axiom: {joined(map(str, system.axiom))}",
            *sections(system, str),
        ]
    )


ABOP = Dialect(
    name="abop",
    statements=printed_statements,
    transformer=transformer(Statements),
    finish=_finish,
    diagnostics=("surface", *DIAGNOSTICS),
    module=str,
    joined=joined,
    write=_write,
    lacks=("round brackets as branches",),
    likely=likely,
    transcribe=transcribe,
    spelling=Spelling(Path(__file__).parent),
)
