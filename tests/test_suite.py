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


WALL_CLOCKS = frozenset(("time", "monotonic", "perf_counter", "sleep", "now"))
"""Functions of `time` and `datetime` whose results depend on what else the machine does."""
WAITING = ("browser", "benchmarks", "fuzzing")
"""What waits for a browser, or measures on purpose."""


def clocks_read(tree: ast.AST) -> list[int]:
    """The lines at which a program reads a clock on the wall, or waits."""
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module == "time"]
    imported = {alias.asname or alias.name for node in imports for alias in node.names if alias.name in WALL_CLOCKS}
    return [
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and (
            (isinstance(node.func, ast.Name) and node.func.id in imported)
            or (
                isinstance(node.func, ast.Attribute)
                and node.func.attr in WALL_CLOCKS
                and ast.unparse(node.func.value) in ("time", "datetime", "datetime.datetime", "asyncio")
            )
        )
    ]


@pytest.mark.parametrize(
    "path",
    [path for path in sorted((ROOT / "tests").rglob("test_*.py")) if path.parent.name not in WAITING],
    ids=lambda path: str(path.relative_to(ROOT / "tests")),
)
def test_no_test_looks_at_the_clock_on_the_wall(path: Path) -> None:
    assert clocks_read(ast.parse(path.read_text(encoding="utf-8"))) == []


def test_a_clock_on_the_wall_is_seen() -> None:
    text = "import time\nfrom time import perf_counter as p, process_time as q\ntime.monotonic()\np()\nq()\ntime.process_time()"
    assert clocks_read(ast.parse(text)) == [3, 4]


FILLED_IN = {"Chance", "Definitions", "Draft", "Effort", "_Shares"}
"""Classes of data that are filled in while a text is read, random numbers are drawn or systems are searched for."""


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
        if item.path.parent.name == "browser":
            assert item.get_closest_marker("browser")
        if item.path.parent.name == "benchmarks":
            assert item.get_closest_marker("slow")
