"""Every row of the tables of mistakes has a text that shows it, and no row asks for what nothing knows."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from functools import partial
from types import ModuleType
from typing import Any

import pytest

from lsys_kit.errors import LSystemError
from lsys_kit.notation.dialects.cellwork.dialect import CELLWORK
from lsys_kit.notation.dialects.map.dialect import MAP
from lsys_kit.notation.read import CELL_READERS, read
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.syntax import diagnostics
from lsys_kit.notation.syntax.dialect import Grammar
from lsys_kit.notation.syntax.wording import KIT_SPELLING
from tests.notation import (
    test_cellworks,
    test_cpfg_diagnostics,
    test_diagnostics,
    test_diagnostics_of_rules,
    test_fractint,
    test_grogra_diagnostics,
    test_maps,
    test_mathematica_diagnostics,
    test_surfaces,
)

Said = tuple[str, str | None]
GRAMMARS: Mapping[str, Grammar] = {**DIALECTS, MAP.name: MAP, CELLWORK.name: CELLWORK}
SPELLINGS = {"every": KIT_SPELLING, **{f"own {name}": grammar.spelling for name, grammar in GRAMMARS.items()}}
KEYS = {
    *diagnostics._TOKENS,
    *diagnostics._STRETCHES,
    *diagnostics._SAID,
    *("near", "arrow", "open", "shut", "unclosed", "closed", "keyword", "likeness", "known", "cases"),
}
MODULES = {
    "abop": (test_diagnostics, test_diagnostics_of_rules, test_surfaces),
    "plant-string": (test_diagnostics,),
    "cpfg": (test_cpfg_diagnostics,),
    "grogra": (test_grogra_diagnostics,),
    "fractint": (test_fractint,),
    "mathematica": (test_mathematica_diagnostics,),
    "map": (test_maps,),
    "cellwork": (test_cellworks,),
}
"""Where texts with mistakes stand, by notation."""
OTHERS = {
    "fractint": [
        "Axio F",
        "Angle 6\nAxiom F\nF=F%",
        "AB=F",
        "F->",
        "Angle: 6",
        "Axiom: F",
        "Angle 6 x",
        "Angle 6 Axiom F",
        "Axiom",
        "Angle",
        "}",
        "Angle 6\nAxiom F\nF=F=F",
        "F",
        "Angle 6\nAxiom F\nF=Fé",
    ],
    "abop": [
        "ignore: 12",
        "axiom: A\nA > B ε -> C",
        "V = {A B}\nω : A",
        "surface leaf: leaf.s\naxiom: A",
        "surface (0,0)\naxiom: A",
        "surface leaf: (0, 0) b (1, 1)\naxiom: A",
        "surface leaf: (0, 0), (1, 1)\naxiom: A",
        "branches: all\naxiom: A",
        "colours: red\naxiom: A",
        "cells: squares\naxiom: A",
        "widths: inches\naxiom: A",
        "axiom: repeat(3) <F>",
        "axiom: A\nA((1,2)) -> B",
        "branches:\naxiom: A",
        "cells:\naxiom: A",
        "colours:\naxiom: A",
        "turtle:\naxiom: A",
        "widths:\naxiom: A",
        "axiom: A\nA = ",
        "surface leaf:\naxiom: A",
        "axiom: A\nA → B\\vec{C",
        "axiom: A\nε > A -> B",
        "axiom: A\nA(t) : 1 < t < -> B",
        "surface leaf: (0, 0, 0, 0)\naxiom: A",
        "axiom: A\nA = B[",
    ],
    "plant-string": ["Axiom: I\nI < A -> A"],
    "map": ["ω 2ABAB", "A -> B[-A -> B"],
    "cellwork": [
        "steps: x",
        "cellwork: x",
        "angle: 3",
        "wall PQ 1",
        "A: * -> ]",
        "A: * -> A [W",
        "A: * -> A [W W",
        "A: * ->",
        "A: -> B",
        "A: * B",
        "A",
        "A B",
    ],
    "cpfg": [
        "#define x 1 ? 2",
        "#define a ,1\nAxiom: A",
        '#include "\nAxiom: A',
        "#include\nAxiom: A",
        "#include a.h\nAxiom: A",
        "ring lsystem\nAxiom: A",
    ],
}
"""Texts with mistakes that are seldom seen."""


def texts(module: ModuleType) -> Iterator[str]:
    """The texts in the tables of a module."""
    for table in vars(module).values():
        if isinstance(table, list):
            yield from (row[0] for row in table if isinstance(row, tuple) and isinstance(row[0], str))


def rows_in(rows: Iterable[Mapping[str, Any]], above: Mapping[str, Any]) -> Iterator[tuple[Mapping[str, Any], Said | None]]:
    """Rows and their cases; with what those say that have no cases."""
    for row in rows:
        whole = {**above, **row}
        cases = row.get("cases")
        yield row, (whole["says"], whole.get("hint")) if cases is None else None
        if isinstance(cases, list):
            yield from rows_in(cases, {key: whole[key] for key in ("says", "hint") if key in whole})


ROWS = [
    (name, table, row, said)
    for name, spelling in SPELLINGS.items()
    for table, rows in spelling.tables.get("mistakes", {}).items()
    for row, said in rows_in(rows, {})
]


@pytest.mark.slow
def test_every_row_has_a_text_that_shows_it(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: set[Said] = set()
    error = diagnostics._error

    def noted(row: Mapping[str, Any], *others: Any) -> Any:
        shown.add((row["says"], row.get("hint")))
        return error(row, *others)

    monkeypatch.setattr(diagnostics, "_error", noted)
    for notation, modules in MODULES.items():
        for text in (*OTHERS.get(notation, ()), *(text for module in modules for text in texts(module))):
            with suppress(LSystemError):
                CELL_READERS.get(notation, partial(read, notation=notation))(text)
    assert {(name, table, said) for name, table, _, said in ROWS if said and said not in shown} == set()


def test_a_row_asks_for_nothing_that_is_not_known() -> None:
    assert {(name, table, key) for name, table, row, _ in ROWS for key in row if key not in KEYS} == set()


@pytest.mark.parametrize("name", GRAMMARS)
def test_every_table_is_looked_up(name: str) -> None:
    dialect = GRAMMARS[name]
    own = dialect.spelling.tables.get("mistakes", {})
    named = {each for each in dialect.diagnostics if isinstance(each, str)}
    handed = {row["cases"] for _, _, row, _ in ROWS if isinstance(row.get("cases"), str)}
    assert own.keys() <= named | handed
    assert named <= own.keys() | KIT_SPELLING.tables["mistakes"].keys()
