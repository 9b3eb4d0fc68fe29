"""An interrupt before any bytecode of what opens, looks at and closes a budget, and of what makes and answers a panel.

Line by line would not do: an interrupt may fall between the bytecode that sets something and the one that sees to it that it is
put back. What is raised is kept, as a notebook keeps the last error, and with it all frames.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Collection, Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

import pytest

from lsys_kit import compare, explore, predict, read
from lsys_kit.budget import Limits, Task, check_budget, counted, current, in_task, limits
from lsys_kit.classroom.panel.explorer import Explorer
from lsys_kit.errors import ModelLimitError
from lsys_kit.supervision import supervised
from tests.faults.injection import Work, break_off, bytecodes_of
from tests.supervisors import is_timer_on, let_timer_look

BUDGETS = ("budget.py", "supervision.py")
PANELS = ("classroom/panel/explorer.py", "classroom/lessons/predict.py", "classroom/widget.py")
ALGAE = "axiom: a\na -> ab\nb -> a"
ASKED: Mapping[str, Mapping[str, object]] = MappingProxyType(
    {
        "a book": {"kind": "book", "constants": {}, "seed": 1},
        "other rules": {"kind": "rules", "text": "axiom: b\na -> ab\nb -> a"},
        "rules with a mistake": {"kind": "rules", "text": "a ->> b ("},
        "a link": {"kind": "keep", "what": "link"},
        "a page": {"kind": "keep", "what": "page"},
        "a drawing": {"kind": "keep", "what": "svg"},
        "variants": {"kind": "variants"},
    }
)


def hooks() -> object:
    return sys.getprofile(), sys.gettrace(), sys.unraisablehook


def interrupted_everywhere(
    work: Work, rooms: tuple[str, ...], then: Callable[[], object] = lambda: None, tried: Collection[object] = ()
) -> Collection[object]:
    """Interrupt some work before each of its bytecodes but the tried ones, and each time see that nothing is left behind.
    The bytecodes."""
    work()
    bytecodes, before = bytecodes_of(work, rooms), hooks()
    for moment in [moment for bytecode, moment in bytecodes.items() if bytecode not in tried]:
        error = break_off(work, rooms, moment, KeyboardInterrupt, "opcode")
        assert isinstance(error, KeyboardInterrupt), f"it is swallowed at {moment}"
        assert not in_task(), f"a task stays open at {moment}"
        assert current() == Limits(), f"limits stay set at {moment}"
        assert hooks() == before, f"a hook stays at {moment}"
        let_timer_look()
        assert not is_timer_on(), f"the timer goes on at {moment}"
        then()
    return bytecodes.keys()


def budgeted_work() -> None:
    """Whatever can be done with a budget: it is shared, taken up again, looked at, used up and supervised."""
    again = Task("again")
    with limits(seconds=5, modules=7):
        with Task("outer"):
            check_budget()
            with Task(), again, again:
                list(counted(range(3), 1))
            with supervised():
                [abs(-1) for _ in range(600)]
                with supervised():
                    let_timer_look()
        with again, supervised():
            check_budget()
    with pytest.raises(ModelLimitError), limits(seconds=1e-9), Task("late"), supervised():
        [
            let_timer_look() if number == 0 else hooks() for number in range(3_000)
        ]  # of Python: a refusal within a finalizer is repeated at the next call of such a one
    with pytest.raises(ModelLimitError), limits(bytes=1), Task("large"):
        [(each, check_budget()) for each in map(bytes, range(9))]  # holds more and more, whatever other threads set free


@pytest.fixture
def no_pauses(way: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The budget is looked at whenever it is asked for, and by a timer at the moments that are tried alone."""
    monkeypatch.setattr("lsys_kit.budget.SECONDS_BETWEEN_LOOKS", 0)
    monkeypatch.setattr("lsys_kit.supervision.SECONDS_BETWEEN_LOOKS", 10**6)


@pytest.mark.slow
@pytest.mark.usefixtures("no_pauses")
def test_a_budget_ends_with_its_frame_whatever_interrupts_it() -> None:
    assert len(interrupted_everywhere(budgeted_work, BUDGETS, budgeted_work)) > 500


@pytest.mark.usefixtures("no_pauses")
def test_a_budget_ends_with_its_block_where_the_frame_goes_on() -> None:
    """As in a loop of a cell, which tries again."""
    left = [
        (in_task(), current())
        for moment in [*bytecodes_of(budgeted_work, BUDGETS).values()][::7]
        if break_off(budgeted_work, BUDGETS, moment, KeyboardInterrupt, "opcode")
    ]
    assert {*left} == {(False, Limits())}


@pytest.fixture
def unraised(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """What is printed, and not raised, since it happens in a finalizer."""
    found: list[object] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda error: found.append(error.exc_value))
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    "make",
    [
        partial(explore, read(ALGAE), 2),
        lambda: compare(read(ALGAE), read(ALGAE), step=1),
        partial(predict, "How many cells has step 6?", "21 cells"),
    ],
)
def test_a_widget_that_was_interrupted_while_it_was_made_is_gone(make: Callable[[], Any], unraised: list[object]) -> None:
    assert len(interrupted_everywhere(lambda: make().close(), PANELS)) > 20
    gc.collect()
    assert unraised == []


def answered(panel: Explorer, asked: str) -> object:
    """What a panel says when it is asked, and what it then shows."""
    said: list[object] = []
    panel.send = said.append
    panel._answer(panel, {"number": 1, **ASKED[asked]}, None)
    return said, panel.text, panel.model, panel.settings, panel.link


@pytest.mark.slow
def test_a_panel_that_was_interrupted_answers_the_next_time(unraised: list[object]) -> None:
    """What it says is then the same, and what it shows."""
    tried: set[object] = set()
    for asked in ASKED:
        panel, expected = explore(read(ALGAE), 2), answered(explore(read(ALGAE), 2), asked)

        def again(panel: Explorer = panel, asked: str = asked, expected: object = expected) -> None:
            assert answered(panel, asked) == expected

        tried |= interrupted_everywhere(lambda: answered(panel, asked), PANELS, again, tried)  # noqa: B023 - called at once
    assert len(tried) > 500
    assert unraised == []
