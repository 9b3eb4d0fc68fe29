"""The two ways in which other libraries are supervised: by a timer, as in the main thread, and by a hook, as in any other."""

from __future__ import annotations

import signal

import pytest


@pytest.fixture(params=["timer", "hook"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """How blocks are supervised in a test."""
    if request.param == "hook":
        monkeypatch.setattr("lsys_kit.supervision._has_timer", lambda: False)
    elif not hasattr(signal, "setitimer"):
        pytest.skip("there is no timer of the processor's time")
    return str(request.param)


def let_timer_look() -> None:
    """Do what happens at the end of an interval, if there is a timer."""
    if hasattr(signal, "setitimer") and signal.getsignal(signal.SIGVTALRM) is not signal.SIG_DFL:
        signal.raise_signal(signal.SIGVTALRM)


def is_timer_on() -> bool:
    """Whether there is a timer, and an interval that will come to its end."""
    return hasattr(signal, "setitimer") and any(signal.getitimer(signal.ITIMER_VIRTUAL))
