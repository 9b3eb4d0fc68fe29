"""The tests themselves: no law depends on how fast the machine is."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit.budget import Limits, current
from tests.plugin import AN_HOUR

ROOT = Path(__file__).parent.parent


@given(st.none())
def test_a_law_has_an_hour(nothing: None) -> None:
    assert (nothing, current().seconds) == (None, AN_HOUR)


FILLED_IN = {"Chance", "Definitions", "Draft", "Effort", "Entry", "Found", "Group", "Trials", "View", "_Shares"}
FILLED_IN |= {"KeptStep", "Parameter", "Structure"}
"""Classes of data that are filled in while a text is read, random numbers are drawn, systems are searched for or words kept."""


@pytest.mark.slow
def test_records_are_frozen() -> None:
    files = [path for room in ("notation", "derivation") for path in sorted((ROOT / "lsys_kit" / room).rglob("*.py"))]
    classes = [
        node
        for path in files
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef)
    ]
    records = {
        node.name: ast.unparse(made)
        for node in classes
        for made in node.decorator_list
        if ast.unparse(made).startswith("dataclass")
    }
    assert {name for name, made in records.items() if "frozen=True" not in made} == FILLED_IN
    assert len(records) > 70


def test_whatever_is_no_law_has_the_limits_of_a_user() -> None:
    assert current() == Limits()


def test_a_law_has_no_deadline() -> None:
    assert settings().deadline is None


def test_what_needs_a_browser_is_marked(request: pytest.FixtureRequest) -> None:
    for item in request.session.items:
        if item.path.parent.name == "browser" and isinstance(item, pytest.Function):
            assert item.get_closest_marker("browser")
        if item.path.parent.name == "benchmarks":
            assert item.get_closest_marker("slow")
