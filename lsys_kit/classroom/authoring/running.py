"""Checks by running: each cell of a lesson in a real kernel, and whether its panels reach what its text asks for."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction

from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.written import Cell, Written
from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.rows import set_by
from lsys_kit.classroom.site import showing
from lsys_kit.classroom.site.build import found_in, run_through
from lsys_kit.files import Entries
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import number_text

_NUMBER = r"(-?\d+(?:[./]\d+)?)"
_SET = (
    re.compile(rf"\b[Ss]et\b[^.?!\n]{{0,40}}?[*`]{{1,3}}(\w+)[*`]{{1,3}} (?:slider )?(?:to|=) {_NUMBER}\b"),
    re.compile(rf"\b(?:[Mm]ove|[Pp]ut) (?:the slider )?[*`]{{1,3}}(\w+)[*`]{{1,3}} to {_NUMBER}\b"),
)


def running_findings(written: Written) -> Iterator[Finding]:
    """Cells that fail, and sliders that do not reach what is asked of them."""
    path = written.place.notebooks / f"{written.name}.ipynb"
    notebook = run_through(path)
    for cell, ran in zip(written.cells, notebook.cells, strict=True):
        if cell.is_code and not cell.may_fail:
            outputs = ran.get("outputs", ())
            failed = [f"{each.ename}: {each.evalue}" for each in outputs if each.output_type == "error"]
            for fault in [*failed, *map(str, found_in([ran], showing.FAULT))]:
                yield finding(written.at(cell), "fails", fault=" ".join(fault.split())[:300])
    yield from _reached(written, [*_panels([data for cell in notebook.cells for data in found_in([cell], showing.PART)])])


def _panels(data: object) -> Iterator[Entries]:
    """The models of panels, wherever they are."""
    if isinstance(data, list):
        for each in data:
            yield from _panels(each)
    elif isinstance(data, dict):
        if "model" in data and isinstance(data["model"], dict) and "constants" in data["model"]:
            yield data["model"]
        else:
            for each in data.values():
                yield from _panels(each)


def _reached(written: Written, models: list[Entries]) -> Iterator[Finding]:
    sliders: dict[str, list[Entries]] = {}
    for model in models:
        for each in model["constants"]:
            sliders.setdefault(each["name"], []).append(each)
    for name, value, where in _wanted(written, sliders):
        offered = [[number_of(text) for text in each["texts"]] for each in sliders.get(name, ())]
        if offered and not any(value in numbers for numbers in offered):
            texts = sliders[name][0]["texts"]
            near = min(texts, key=lambda text: abs((number_of(text) or Fraction(0)) - value))
            said = {"value": number_text(value), "low": texts[0], "high": texts[-1], "near": near}
            yield finding(where, "unreached", name=name, **said)
    if models:
        known = {*sliders, "step", "angle", "seed", "around", "above"}
        for cell, found in _asked(written):
            if found[1] not in known:
                hint = suggestion(found[1], known) or f"Sliders are: {', '.join(sorted({*sliders, 'step', 'angle'}))}."
                yield finding(written.at(cell, cell.line_of(found[0])), "no_slider", name=found[1], hint=hint)


def _asked(written: Written) -> Iterator[tuple[Cell, re.Match[str]]]:
    for cell in written.cells:
        for pattern in () if cell.is_code else _SET:
            yield from ((cell, found) for found in pattern.finditer(cell.source))


def _wanted(written: Written, sliders: Mapping[str, object]) -> Iterator[tuple[str, Fraction, str]]:
    """The values that texts and tables ask for, each with its slider and its place."""
    for cell, found in _asked(written):
        if (number := number_of(found[2])) is not None:
            yield found[1], number, written.at(cell, cell.line_of(found[0]))
    for table in written.lesson.tables if written.lesson else ():
        for row in range(len(table.rows)):
            for name, value in set_by(table, row, sliders).items():
                yield name, Fraction(str(value)), written.declared_line(f'id = "{table.id}"')
    for together in written.lesson.settings if written.lesson else ():
        for name, text in together.items():
            yield name, number_of(text) or Fraction(0), written.declared_line("settings")
