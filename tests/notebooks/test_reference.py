"""The reference notebooks show every turtle command and every notation of the kit, as the tables have them now."""

from __future__ import annotations

from collections.abc import Mapping

import nbformat
import pytest

from lsys_kit import derive, draw, read
from lsys_kit.geometry.turtle.commands import COMMAND_TABLE, COMMANDS
from lsys_kit.notation.registry import DIALECTS
from tests.notebooks.reference import EXAMPLES, FOLDER, built, example_of, symbols_of

SHOWN = [
    (turtle, symbol)
    for row in COMMAND_TABLE
    if row.commands
    for turtle, symbols in symbols_of(row).items()
    for symbol in symbols
]


@pytest.mark.slow
def test_the_notebooks_are_those_that_the_tables_make() -> None:
    """If not: python -m tests.notebooks.reference."""
    stored = {name: nbformat.read(FOLDER / name, as_version=4) for name in built()}
    assert _cells(stored) == _cells(built())


def _cells(notebooks: Mapping[str, nbformat.NotebookNode]) -> dict[str, list[tuple[str, str, str]]]:
    return {name: [(cell.id, cell.cell_type, cell.source) for cell in each.cells] for name, each in notebooks.items()}


def test_every_command_has_one_example_and_no_example_is_left_over() -> None:
    assert set(SHOWN) == {(turtle, symbol) for turtle, found in EXAMPLES["turtles"].items() for symbol in found["words"]}
    assert len(SHOWN) == len(set(SHOWN)) == sum(bool(commands) for found in COMMANDS.values() for commands in found.values())


@pytest.mark.parametrize(("turtle", "symbol"), SHOWN)
def test_an_example_uses_its_command_and_draws_something(turtle: str, symbol: str) -> None:
    notation, text = example_of(turtle, symbol)
    system = read(text, notation)
    assert system.turtle == turtle
    assert symbol in {module.symbol for module in system.axiom}
    assert "segment" in str(draw(system, 0)) or "polygon" in str(draw(system, 0))


@pytest.mark.slow
def test_commands_that_do_different_things_have_different_pictures() -> None:
    does: dict[tuple[str, str], set[str]] = {}
    for row in COMMAND_TABLE:
        for turtle, symbols in symbols_of(row).items() if row.commands else ():
            for symbol in symbols:
                notation, text = example_of(turtle, symbol)
                does.setdefault((turtle, draw(read(text, notation), 0).svg), set()).add(row.words)
    assert [words for words in does.values() if len(words) > 1] == []


@pytest.mark.parametrize("name", DIALECTS)
def test_every_notation_has_an_example_that_is_recognised(name: str) -> None:
    example = EXAMPLES["notations"][name]
    system = read(example["listing"].strip())
    assert system.notation == name
    assert len(derive(system, example["steps"])) == example["steps"] + 1


def test_a_cell_of_a_reference_has_at_most_six_lines() -> None:
    for notebook in built().values():
        assert max(cell.source.count("\n") for cell in notebook.cells if cell.cell_type == "code") < 6
