"""Work in forks of this process: what it changes is gone afterwards."""

from __future__ import annotations

import json
import multiprocessing
import os
import resource
import signal
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Any, TypeVar

_T = TypeVar("_T")
MOST_BYTES = 12 * 2**30
"""As much memory as a fork may address."""


def forked(work: Callable[[], Any], seconds: float, browser: bool = False) -> Any:
    """What some work answers in a fork, silently; None if it does not answer in time or ends the process."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as answer:
        child = os.fork()
        if child == 0:
            with suppress(BaseException):
                os.setsid()
                _be_silent()
                if not browser:  # which reserves more than there is
                    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
                json.dump(work(), answer)
                answer.flush()
            os._exit(0)
        _end(child, seconds)
        answer.seek(0)
        text = answer.read()
    with suppress(json.JSONDecodeError):
        return json.loads(text)
    return None


def _be_silent() -> None:
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nothing, stream)


def _end(child: int, seconds: float) -> None:
    """Wait for a process, as long as it may take, and end what it has started."""
    end = time.monotonic() + seconds
    try:
        while os.waitpid(child, os.WNOHANG) == (0, 0) and time.monotonic() < end:
            time.sleep(0.01)
    finally:
        with suppress(ProcessLookupError):
            os.killpg(child, signal.SIGKILL)
        with suppress(ChildProcessError):
            os.waitpid(child, 0)


def in_parallel(work: Callable[[int], _T], tasks: Sequence[int], jobs: int) -> Iterator[tuple[int, _T]]:
    """What some work answers to each task, by several forks of this process, as it comes."""
    todo: Any = multiprocessing.get_context("fork").SimpleQueue()
    done: Any = multiprocessing.get_context("fork").SimpleQueue()

    def labour() -> None:
        while (task := todo.get()) is not None:
            done.put((task, work(task)))

    labourers = [multiprocessing.get_context("fork").Process(target=labour) for _ in range(jobs)]
    for each in labourers:
        each.start()
    for task in [*tasks, *[None] * jobs]:
        todo.put(task)
    for _ in tasks:
        yield done.get()
    for each in labourers:
        each.join()
