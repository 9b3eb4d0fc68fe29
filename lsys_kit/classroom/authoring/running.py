"""Checks by running: each cell of a lesson in a real kernel."""

from __future__ import annotations

from collections.abc import Iterator

from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.written import Written
from lsys_kit.classroom.site import showing
from lsys_kit.classroom.site.build import found_in, run_through


def running_findings(written: Written) -> Iterator[Finding]:
    """Cells that fail."""
    path = written.place.notebooks / f"{written.name}.ipynb"
    notebook = run_through(path)
    for cell, ran in zip(written.cells, notebook.cells, strict=True):
        if cell.is_code and not cell.may_fail:
            outputs = ran.get("outputs", ())
            failed = [f"{each.ename}: {each.evalue}" for each in outputs if each.output_type == "error"]
            for fault in [*failed, *map(str, found_in([ran], showing.FAULT))]:
                yield finding(written.at(cell), "fails", fault=" ".join(fault.split())[:300])
