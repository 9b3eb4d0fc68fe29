"""Limits: nothing that a person types may run away with the machine."""

from __future__ import annotations

import cProfile
import sys
from collections.abc import Callable
from contextlib import suppress
from contextvars import copy_context
from dataclasses import FrozenInstanceError

import pytest

from lsys_kit.budget import Limits, Task, check_budget, counted, current, limits
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError
from lsys_kit.supervision import supervised


def test_limits_hold_for_a_stretch_of_code() -> None:
    with limits(modules=10, seconds=0.5) as inside:
        assert inside == current()
        assert (inside.modules, inside.seconds, inside.bytes) == (10, 0.5, 512 * 2**20)
        with limits(modules=5):
            assert (current().modules, current().seconds) == (5, 0.5)
        assert current().modules == 10
    assert current() == Limits()


def test_limits_end_with_an_error_too() -> None:
    with pytest.raises(ZeroDivisionError), limits(modules=10):
        raise ZeroDivisionError
    assert current() == Limits()


def test_limits_of_one_context_are_not_those_of_another() -> None:
    other = copy_context()
    with limits(modules=10):
        ask: Callable[[], Limits] = current
        assert other.run(ask).modules == 5_000_000
        assert copy_context().run(ask).modules == 10


def test_an_unknown_limit_is_named() -> None:
    message = r'There is no limit called "module"\. Limits are: modules, bytes, seconds'
    with pytest.raises(ModelNameError, match=message), limits(module=1):
        pass


@pytest.mark.parametrize("value", [0, -1, "5", None, True, float("nan")])
def test_a_limit_is_a_positive_number(value: object) -> None:
    message = 'The limit "modules" must be a positive number, not '
    with pytest.raises(ModelValueError, match=message), limits(modules=value):  # type: ignore[arg-type]
        pass


def test_limits_are_frozen() -> None:
    with pytest.raises(FrozenInstanceError):
        current().modules = 1  # type: ignore[misc]


def test_a_task_within_a_task_has_the_same_budget() -> None:
    def again() -> int:
        with Task("The inner was not finished"):
            return sum(counted(range(100_000)))

    with limits(seconds=0.1), pytest.raises(ModelLimitError, match=r"The inner was not finished in 0\.1 seconds"), Task():
        list(iter(again, 0))


def test_what_passes_between_two_parts_of_a_task_is_not_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr("lsys_kit.budget.processor_time", lambda: now[0])
    monkeypatch.setattr("lsys_kit.budget.SECONDS_BETWEEN_LOOKS", 0)
    work = Task()
    with limits(seconds=10):
        for _ in range(3):
            now[0] += 100
            with work:
                now[0] += 3
                check_budget()
        with work:
            now[0] += 3
            with pytest.raises(ModelLimitError):
                check_budget()


def test_all_objects_of_a_task_count(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lsys_kit.budget.SECONDS_BETWEEN_LOOKS", 0)
    with limits(bytes=10**6), Task("The list was not made"), pytest.raises(ModelLimitError, match="The list was not made"):
        list(counted((number,) for number in range(10**7)))


def test_outside_of_a_task_nothing_is_refused() -> None:
    with limits(seconds=1e-9):
        check_budget()
        assert list(counted(range(5), 1)) == [0, 1, 2, 3, 4]


def test_what_knows_of_no_budget_is_supervised() -> None:
    def endless() -> None:
        while True:
            try:
                abs(-1)
            except Exception:  # as a library may do
                continue

    before = sys.getprofile()
    with limits(seconds=0.05), Task("It was not found"), pytest.raises(ModelLimitError, match="It was not found"), supervised():
        endless()
    assert sys.getprofile() is before


@pytest.mark.slow
def test_what_has_less_time_within_what_is_supervised_can_be_given_up_alone() -> None:
    """As the later steps of a panel that is being shown: its book ends earlier, and is shown."""
    given_up = False
    with limits(seconds=5), Task("It was not shown"), supervised():
        try:
            with limits(seconds=0.05), Task("Step 10 was not reached"):
                for number in counted(range(10**9)):
                    abs(number)
        except ModelLimitError:
            given_up = True
    assert given_up


def test_a_profiler_goes_on_behind_what_is_supervised() -> None:
    """As `%prun` in a notebook."""

    def behind() -> None:
        pass

    with cProfile.Profile() as profiler:
        with Task("It was not found"), supervised():
            abs(-1)
        behind()
    assert behind.__code__ in [entry.code for entry in profiler.getstats()]
    assert sys.getprofile() is None


def test_an_error_that_a_finalizer_swallows_is_raised_again_and_not_printed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The library works on, until it makes more calls than a person waits for; what it leaves is put in order. Its own errors
    are still reported."""
    put_in_order: list[str] = []
    printed: list[type[BaseException]] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda swallowed: printed.append(swallowed.exc_type))
    reported = sys.unraisablehook

    class Wrong:
        def __del__(self) -> None:
            raise ValueError

    class Finalized:
        def __del__(self) -> None:
            while True:
                abs(-1)

    def endless() -> None:
        Wrong()
        Finalized()
        try:
            for _ in range(10**7):
                abs(-1)
        finally:
            put_in_order.extend(map(str, range(100)))

    hooks = sys.getprofile(), sys.gettrace()
    with limits(seconds=0.05), Task("It was not found"), pytest.raises(ModelLimitError, match="It was not found"), supervised():
        endless()
    assert len(put_in_order) == 100
    assert (sys.getprofile(), sys.gettrace()) == hooks
    assert (printed, sys.unraisablehook) == ([ValueError], reported)


def test_what_is_used_up_is_refused_at_every_look() -> None:
    """Whoever swallows one refusal meets the next at once."""
    with limits(seconds=1e-9), Task():
        with suppress(ModelLimitError):
            sum(counted(range(10**9)))
        with pytest.raises(ModelLimitError):
            check_budget()
