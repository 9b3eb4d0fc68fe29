"""Checks of panels: whether their sliders reach what texts and tables ask for, without running a cell."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import gcd
from operator import ne

from lsys_kit.budget import limits
from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.written import Cell, Section, Written
from lsys_kit.classroom.catalogue import catalogued
from lsys_kit.classroom.exercises.check import BUDGET
from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.rows import set_by
from lsys_kit.classroom.panel.opened.kinds import opened
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.read import AnySystem, read_any

_NUMBER = r"(-?\d+(?:[./]\d+)?)"
_NAME = r"(?:the |its )?(?:sliders? )?(?:of )?(?:the )?(?:[*`]{1,3}(\w+)[*`]{1,3}|(step|angle))"
_MOVE = r"\b(?:[Mm]ove|[Pp]ut|[Dd]rag|[Tt]urn|[Pp]ush|[Ss]lide)"
_ASKED = (
    re.compile(rf"\b[Ss]et {_NAME}(?: slider)?[^.?!\n*`\d]{{0,30}} ?(?:to|=) {_NUMBER}\b(?! *%)"),
    re.compile(rf"{_MOVE} {_NAME}(?: slider)?(?: slowly| back)?(?:[, ]*from {_NUMBER})?(?: up)? to {_NUMBER}\b(?! *%)"),
    re.compile(rf"{_MOVE} (?:only |just )?{_NAME}(?= (?:and|on)\b|[,.:])"),
)
_SPAN = re.compile(r"`([^`\n]{1,200})`")
_RULE = re.compile(r"(?<![^\s`\"'])[^\s`\"']{1,12} -> [^`\n\"'\\]{0,200}[^`\n\"'\\\s]")
_IDS = re.compile(r"[A-Z]{1,2}\d{1,3}[a-z]?")
FEWEST_LISTED = 3
"""So many rules in a text are those of a system."""
_OTHERS = frozenset({"step", "angle", "seed", "around", "above", "command", "unfolding"})
"""Sliders of panels that belong to no constant."""


@dataclass(frozen=True)
class Panel:
    """A system that a cell shows, and what its sliders offer, by their names; the cells whose text is not read have None."""

    cell: Cell
    system: AnySystem | None
    offered: Mapping[str, Sequence[Value]]
    is_panel: bool


@lru_cache(maxsize=32)
def panels_of(written: Written) -> tuple[Panel, ...]:
    """What the cells show of systems, in their order, as far as it stands in them."""
    return (*_panels(written),)


def _panels(written: Written) -> Iterator[Panel]:
    names: dict[str, AnySystem] = {}
    for cell, tree in written.trees:
        names |= {
            target.id: system
            for node in ast.walk(tree)
            if isinstance(node, ast.Assign) and (system := _system(node.value, names)) is not None
            for target in node.targets
            if isinstance(target, ast.Name)
        }
        for node in ast.walk(tree):
            if not isinstance(node, ast.Call):
                continue
            function = node.func.id if isinstance(node.func, ast.Name) else ""
            if function in ("explore", "compare", "derive", "draw", "animate", "read", "system"):
                for given in node.args[: 2 if function == "compare" else 1]:
                    found = _system(node if function in ("read", "system") else given, names)
                    if found is not None or (function == "explore"):
                        yield Panel(cell, found, _offered(found, node), function in ("explore", "compare"))


def _system(node: ast.expr, names: Mapping[str, AnySystem]) -> AnySystem | None:
    """The system that an expression is, if that stands in it."""
    if isinstance(node, ast.Name):
        return names.get(node.id)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("read", "system") and node.args:
        return _system(node.args[0], names)
    if not (isinstance(node, ast.Constant) and isinstance(node.value, str)):
        return None
    try:
        with limits(**BUDGET):
            text = node.value.strip()
            return catalogued(text) if _IDS.fullmatch(text) else read_any(node.value)
    except LSystemError:
        return None


def _offered(system: AnySystem | None, node: ast.Call) -> Mapping[str, Sequence[Value]]:
    if system is None:
        return {}
    given = {each.arg: each.value for each in node.keywords if each.arg}
    try:
        with limits(**BUDGET):
            declared = opened(system).values
            changes = {name: _numeral(given[name]) for name in declared if name in given}
            offered = opened(system, "", {name: value for name, value in changes.items() if value is not None}).values
    except LSystemError:
        return {}
    chosen = (
        [each.value for each in ast.walk(given["sliders"]) if isinstance(each, ast.Constant)]
        if "sliders" in given
        else [*offered]
    )
    return {name: offered[name] for name in offered if name in chosen}


def _numeral(node: ast.expr) -> int | float | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, int | float) else None


def rule_findings(written: Written) -> Iterator[Finding]:
    """Of rules: one in a cell of code that no text has, and that is but for one sign what the texts say of its letters."""
    texts = [cell for cell in written.cells if not cell.is_code]
    said = {rule: None for cell in texts for span in _SPAN.findall(cell.source) for rule in _RULE.findall(span)}
    everywhere = "\n".join([*(cell.source for cell in texts), written.declared_text])
    in_code = {rule: cell for cell in reversed(written.cells) if cell.is_code for rule in _RULE.findall(cell.source)}
    replaced = {rule.partition("->")[0] for rule in in_code}
    for rule, cell in in_code.items():
        near = [each for each in said if _one_sign(each, rule) and each.partition("->")[0] in replaced]
        if near and rule not in everywhere:
            yield finding(written.at(cell, cell.line_of(rule)), "rule", rule=rule[:80], said=near[0][:80])
    for cell in texts:
        listed = {rule for span in _SPAN.findall(cell.source) for rule in _RULE.findall(span)}
        for code in written.cells if len(listed) >= FEWEST_LISTED else ():
            there = {*_RULE.findall(code.source)} if code.is_code else set()
            other = [(one, two) for one in listed - there for two in there - listed if _one_sign(one, two)]
            if len(listed - there) == len(other) == 1 and other[0][0] not in in_code:
                rule, said = other[0]
                yield finding(
                    written.at(cell, cell.line_of(rule)), "listed", rule=rule[:80], said=said[:80], number=code.number
                )


def _one_sign(one: str, two: str) -> bool:
    return len(one) == len(two) and sum(map(ne, one, two)) == 1


def slider_findings(written: Written) -> Iterator[Finding]:
    """Of sliders: those that are to be moved where no panel lets them."""
    shown = [each for each in panels_of(written) if each.is_panel]
    names = {name for each in shown for name in each.offered}
    for section in written.sections:
        there = {cell.number for cell in section.code}
        near = [each for each in shown if each.cell.number in there]
        for cell, name, values, part in _moves(section):
            where = written.at(cell, cell.line_of(part))
            if name in names:
                yield from _unreached([each for each in near if name in each.offered] or shown, name, values, where)
            elif name in ("step", "angle"):
                yield from _beyond(near or shown, name, values, where)
            elif name not in _OTHERS and shown and all(each.system for each in shown):
                known = f"Sliders are: {', '.join(sorted({*names, 'step', 'angle'}))}."
                yield finding(where, "no_slider", name=name, hint=suggestion(name, {*names, *_OTHERS}) or known)
    together: dict[tuple[str, str], list[Fraction]] = {}
    for name, number, where in _declared(written, names):
        together.setdefault((name, where), []).append(number)
    for (name, where), values in together.items():
        yield from _unreached(shown, name, values, where)


def _moves(section: Section) -> Iterator[tuple[Cell, str, list[Fraction], str]]:
    """What texts ask of sliders: the cell, the slider, its values, and the words of it."""
    for cell, text in section.texts:
        for pattern in _ASKED:
            for found in pattern.finditer(text):
                values = [number for each in found.groups()[2:] if each and (number := number_of(each)) is not None]
                yield cell, found[1] or found[2], values, found[0]


def _declared(written: Written, names: set[str]) -> Iterator[tuple[str, Fraction, str]]:
    """The values that tables and settings ask for, each with its slider and its place."""
    for table in written.lesson.tables if written.lesson else ():
        for row in range(len(table.rows)):
            for name, value in set_by(table, row, names).items():
                yield name, Fraction(str(value)), written.declared_line(f'id = "{table.id}"')
    for together in written.lesson.settings if written.lesson else ():
        for name, text in together.items():
            if name in names:
                yield name, number_of(text) or Fraction(0), written.declared_line("settings")


def _unreached(panels: Sequence[Panel], name: str, values: Sequence[Fraction], where: str) -> Iterator[Finding]:
    """A slider of a constant that offers some values in none of the panels."""
    offered = [[Fraction(number) for number in each.offered[name]] for each in panels if name in each.offered]
    missing = sorted({value for value in values if offered and not any(value in each for each in offered)})
    if missing:
        there = offered[0]
        low, high = min(*there, *missing), max(*there, *missing)
        step = _common([each - low for each in (*there, *missing) if each > low])
        near = min(there, key=lambda each: abs(each - missing[0]))
        said = {"low": there[0], "high": there[-1], "near": near, "from_": low, "to": high, "by": step}
        texts = {key: number_text(normalised(each)) for key, each in said.items()}
        value = " and ".join(number_text(normalised(each)) for each in missing)
        yield finding(where, "unreached", name=name, value=value, **texts)


def _common(numbers: Sequence[Fraction]) -> Fraction:
    """The greatest number of which all are multiples.

    >>> _common([Fraction(9, 10), Fraction(3, 2)])
    Fraction(3, 10)
    """
    found = Fraction(0)
    for each in numbers:
        below = found.denominator * each.denominator
        found = Fraction(gcd(int(found * below), int(each * below)), below)
    return found


def _beyond(panels: Sequence[Panel], name: str, values: Sequence[Fraction], where: str) -> Iterator[Finding]:
    """A step that no panel shows, or an angle that none has."""
    known = [each.system for each in panels if each.system is not None]
    if len(known) < len(panels) or not known:
        return
    for value in values:
        if name == "angle" and not 0 <= value <= 180:
            yield finding(where, "angle_beyond", value=number_text(normalised(value)))
        elif name == "step" and not any(_has_step(each, int(value)) for each in known):
            yield finding(where, "step_beyond", value=number_text(normalised(value)))


def _has_step(system: AnySystem, step: int) -> bool:
    try:
        with limits(**BUDGET):
            derive(system, step)
    except ModelLimitError:
        return False
    except LSystemError:  # it needs more than its words
        return True
    return True
