"""Limits: nothing that a person types may run away with the machine."""

from __future__ import annotations

import cProfile
import importlib
import signal
import socket
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from contextvars import copy_context
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from lsys_kit import budget
from lsys_kit.budget import Limits, Task, check_budget, counted, current, limits
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError
from lsys_kit.supervision import supervised
from tests.supervisors import is_timer_on, let_timer_look


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


def refused(work: Callable[[], object], **changes: float) -> None:
    """See that some work is refused that another library does."""
    failed = "It was not found"
    with limits(**{"seconds": 0.05, **changes}), pytest.raises(ModelLimitError, match=failed), Task(failed), supervised():
        work()


def endless() -> None:
    while True:
        try:
            abs(-1)
        except Exception:  # as a library may do
            continue


@pytest.mark.usefixtures("way")
def test_what_knows_of_no_budget_is_supervised() -> None:
    before = sys.getprofile()
    refused(endless)
    assert sys.getprofile() is before
    assert not is_timer_on()


def test_other_threads_are_supervised_too() -> None:
    with ThreadPoolExecutor(1) as pool:
        pool.submit(refused, endless).result()


@pytest.mark.usefixtures("way")
def test_what_holds_more_and_more_is_supervised() -> None:
    refused(lambda: [(abs(each),) for each in iter(int, 1)], seconds=60, bytes=10**7)


@pytest.mark.usefixtures("way")
def test_many_short_blocks_within_one_do_not_keep_it_from_being_supervised() -> None:
    def short_ones() -> None:
        for _ in range(10**6):
            with supervised():
                abs(-1)

    refused(short_ones)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there is no timer here")
def test_a_signal_that_comes_while_the_budget_is_looked_at_does_not_end_the_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    def objects() -> int:
        signal.raise_signal(signal.SIGVTALRM)
        return 0

    def long_one() -> None:
        end = budget.processor_time() + 5
        while budget.processor_time() < end:
            abs(-1)

    monkeypatch.setattr(budget, "_objects", objects)
    refused(long_one, seconds=0.5)


@pytest.mark.usefixtures("way")
def test_a_module_that_is_being_imported_is_there_afterwards(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One that was given up half-way could never be used."""
    (tmp_path / "late_module.py").write_text(
        "import time\nbegan = time.thread_time()\nwhile time.thread_time() < began + 0.3: abs(-1)\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "late_module", raising=False)
    refused(lambda: [importlib.import_module("late_module"), endless()])
    assert "late_module" in sys.modules


@pytest.mark.usefixtures("way")
def test_what_is_used_up_at_the_end_of_a_block_is_no_strange_error() -> None:
    """The last call of a block is that which leaves it."""
    for calls in range(600):
        with limits(seconds=1e-9), suppress(ModelLimitError), Task(), supervised():
            for _ in range(calls):
                abs(-1)
            let_timer_look()


def test_a_timer_that_is_somebody_elses_is_left_alone() -> None:
    """The budget is looked at all the same."""
    heard: list[int] = []
    before = signal.signal(signal.SIGVTALRM, lambda number, _: heard.append(number))
    try:
        refused(endless)
        assert heard == []
        signal.raise_signal(signal.SIGVTALRM)
        assert len(heard) == 1
    finally:
        signal.signal(signal.SIGVTALRM, before)


def test_a_loop_of_events_that_is_told_of_signals_is_left_alone() -> None:
    """As asyncio's, which reads what it is told when it is its turn: until then its queue could be full."""
    told, wake = socket.socketpair()
    with told, wake:
        told.setblocking(False)
        wake.setblocking(False)
        signal.set_wakeup_fd(wake.fileno())
        try:
            refused(endless)
        finally:
            assert signal.set_wakeup_fd(-1) == wake.fileno()
        with pytest.raises(BlockingIOError):
            told.recv(1)


def test_a_timer_that_comes_late_does_no_harm() -> None:
    refused(endless)
    let_timer_look()
    assert not is_timer_on()


def test_a_call_is_refused_and_nothing_between_two_calls() -> None:
    """A signal is handled anywhere, as between the end of a `try` and its `finally`."""
    reached: list[str] = []

    def work() -> None:
        let_timer_look()
        number = 1 + 1
        reached[:] = "ab"
        abs(number)
        reached[:] = "abc"

    refused(work, seconds=1e-9)
    assert reached == [*"ab"]


@pytest.mark.slow
@pytest.mark.usefixtures("way")
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


def test_a_profiler_goes_on_behind_what_is_supervised(way: str) -> None:
    """As `%prun` in a notebook; by a timer it is not even interrupted."""

    def within() -> None:
        pass

    def behind() -> None:
        pass

    with cProfile.Profile() as profiler:
        with Task("It was not found"), supervised():
            within()
        behind()
    seen = [entry.code for entry in profiler.getstats()]
    assert behind.__code__ in seen
    assert (within.__code__ in seen) is (way == "timer")
    assert sys.getprofile() is None


@pytest.mark.usefixtures("way")
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

    def unlucky() -> None:
        Wrong()
        Finalized()
        try:
            for _ in range(10**7):
                abs(-1)
        finally:
            put_in_order.extend(map(str, range(100)))

    hooks = sys.getprofile(), sys.gettrace()
    refused(unlucky)
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
