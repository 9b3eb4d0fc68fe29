"""A panel knows the cell that has made it, and which of its panels it is."""

from __future__ import annotations

from typing import Any

import pytest

from lsys_kit import compare, explore
from lsys_kit.classroom.panel.standing import standing


class Shell:
    """What runs cells, as Jupyter's kernel does: of each run it knows the message that asked for it."""

    def __init__(self) -> None:
        self.asked: dict[str, Any] = {}

    def get_parent(self) -> dict[str, Any]:
        return self.asked


@pytest.fixture
def shell(monkeypatch: pytest.MonkeyPatch) -> Shell:
    found = Shell()
    monkeypatch.setattr("IPython.core.getipython.get_ipython", lambda: found)
    return found


def runs(shell: Shell, cell: str, number: int) -> None:
    shell.asked = {"header": {"msg_id": f"run {number}"}, "metadata": {"cellId": cell}}


def test_panels_of_a_cell_are_told_from_each_other_and_known_again(shell: Shell) -> None:
    runs(shell, "first", 1)
    assert [explore("J4", 2).model["standing"] for _ in range(2)] == ["first 1", "first 2"]
    runs(shell, "second", 2)
    assert explore("J4", 2).model["standing"] == "second 1"
    runs(shell, "first", 3)
    both = compare("J4", {}, {"lifeTimeA": 2})
    assert [both.left.model["standing"], both.right.model["standing"]] == ["first 1", "first 2"]


@pytest.mark.parametrize("asked", [{}, {"header": {"msg_id": "1"}, "metadata": {}}])
def test_where_cells_have_no_ids_a_panel_stands_nowhere(shell: Shell, asked: dict[str, Any]) -> None:
    shell.asked = asked
    assert standing() == ""


def test_a_panel_knows_the_rules_with_which_it_was_opened() -> None:
    panel = explore("J4", 2)
    first = panel.model["book"]["text"]
    panel.answer({"kind": "rules", "text": "axiom: a\na -> a b\nb -> a"})
    assert panel.model["book"]["text"] != first == panel.model["first"]
