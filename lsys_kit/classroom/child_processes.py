"""Work on what others have made, in child processes with limits of time and memory.

Where processes can be forked, a child begins with all that has been loaded and computed here, and may have one piece alone;
elsewhere it has a run of pieces. A child that takes too long, takes too much memory or crashes loses the piece it was
at: the others are left to another child. What comes back is JSON.
"""

from __future__ import annotations

import gc
import json
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkContext, SpawnContext
from multiprocessing.process import BaseProcess
from typing import TypeVar

from tqdm import tqdm

MEMORY = 2**30
"""So many bytes a child may take, beyond what it begins with."""
MOST_BYTES = 50_000_000
"""So many bytes at most a result has."""
PATIENCE = 6
"""So many times the seconds of processor time a child may take by the clock on the wall, on a machine that is busy."""
TOO_LONG, TOO_MUCH, CRASHED = "It takes too long", "It takes too much memory", "It ends the process that reads it"
_FORKED = sys.platform not in ("win32", "darwin")  # on macOS forked processes may crash in libraries of the system
_CONTEXT: ForkContext | SpawnContext = multiprocessing.get_context("fork") if _FORKED else multiprocessing.get_context("spawn")
_RUN = 1 if _FORKED else 25
"""So many pieces a child has at least, where there are more: one that begins with nothing must load everything first."""

_P = TypeVar("_P")


@dataclass(frozen=True)
class Failed:
    """What comes of a piece that could not be worked on: the reason, a sentence without its full stop."""

    reason: str


@dataclass
class _Child:
    """A child process at work: its pieces by their numbers, and the time by which the next must be done."""

    process: BaseProcess
    numbers: deque[int]
    deadline: float = field(default=0.0)


def in_child_processes(
    work: Callable[[_P], object], pieces: Sequence[_P], seconds: int, label: str = "", together: int = 1
) -> list[object]:
    """What comes of each piece: what `work` returns, as JSON keeps it, or why it `Failed`.

    work
        A function of a module, whose results JSON can write.
    pieces
        What it is called with, one after another.
    seconds
        How much time of the processor a piece may take.
    label
        What the progress bar says; there is none on a stream that is no terminal.
    together
        So many pieces one child works on, one after another.

    >>> in_child_processes(len, ["four", "five5"], 10), in_child_processes(len, [5], 10)
    ([4, 5], [Failed(reason='It cannot be worked on (TypeError)')])
    """
    results: list[object] = [None] * len(pieces)
    with tqdm(total=len(pieces), desc=label, disable=None, delay=1, leave=False) as bar:
        for number, result in _results(work, pieces, seconds, max(together, _RUN)):
            results[number] = result
            bar.update()
    return results


def _results(work: Callable[[_P], object], pieces: Sequence[_P], seconds: int, together: int) -> Iterator[tuple[int, object]]:
    """The results, as they come, each with its number."""
    waiting, many = deque(range(len(pieces))), _processors()
    with _killed_at_the_end() as at_work:
        while waiting or at_work:
            while waiting and len(at_work) < many:
                _start(work, pieces, _taken(waiting, together), seconds, at_work)
            first = min(child.deadline for child in at_work.values())
            ready = set(wait([*at_work], max(0.0, first - time.monotonic())))
            for connection, child in [*at_work.items()]:
                if connection in ready:
                    yield child.numbers.popleft(), _received(connection, child)
                elif time.monotonic() > child.deadline:
                    child.process.kill()
                    child.process.join()
                    yield child.numbers.popleft(), Failed(TOO_LONG)
                else:
                    continue
                child.deadline = time.monotonic() + PATIENCE * seconds
                if not child.process.is_alive() or not child.numbers:
                    waiting.extendleft(reversed(child.numbers))
                    _end(at_work, connection)


def _taken(waiting: deque[int], many: int) -> deque[int]:
    return deque(waiting.popleft() for _ in range(min(many, len(waiting))))


def _start(
    work: Callable[[_P], object], pieces: Sequence[_P], numbers: deque[int], seconds: int, at_work: dict[Connection, _Child]
) -> None:
    ours, theirs = _CONTEXT.Pipe(duplex=False)
    own = [pieces[number] for number in numbers]
    process = _CONTEXT.Process(target=_work_on, args=(work, own, seconds, theirs), daemon=True)
    at_work[ours] = _Child(process, numbers, time.monotonic() + PATIENCE * seconds)
    process.start()
    theirs.close()


def _received(connection: Connection, child: _Child) -> object:
    try:
        done, result = json.loads(connection.recv_bytes(MOST_BYTES))
    except (EOFError, OSError):
        child.process.kill()
        child.process.join()
        too_long = hasattr(signal, "SIGXCPU") and child.process.exitcode == -signal.SIGXCPU
        return Failed(TOO_LONG if too_long else CRASHED)
    return result if done else Failed(result)


@contextmanager
def _killed_at_the_end() -> Iterator[dict[Connection, _Child]]:
    at_work: dict[Connection, _Child] = {}
    gc.freeze()  # what is here already is no garbage of the children: they need not look through it
    try:
        yield at_work
    finally:
        gc.unfreeze()
        for connection in [*at_work]:
            _end(at_work, connection)


def _end(at_work: dict[Connection, _Child], connection: Connection) -> None:
    child = at_work.pop(connection)
    with suppress(ValueError, AssertionError):  # it was never started
        child.process.kill()
        child.process.join()
    connection.close()


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


# In the child


def _work_on(work: Callable[[_P], object], pieces: Sequence[_P], seconds: int, results: Connection) -> None:
    """Send what comes of each piece; nothing else leaves this process."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):
        os.dup2(nowhere, stream)
    limit_memory()
    for piece in pieces:
        limit_seconds(seconds)
        results.send_bytes(json.dumps(_done(work, piece)).encode())


def _done(work: Callable[[_P], object], piece: _P) -> tuple[bool, object]:
    try:
        return True, work(piece)
    except MemoryError:
        return False, TOO_MUCH
    except Exception as fault:  # even a fault of the kit itself must not stop the others
        return False, f"It cannot be worked on ({type(fault).__name__})"


def limit_memory() -> None:
    """Bound the memory, and write no files, not even of a crash."""
    with suppress(ImportError, OSError, ValueError):  # there is no such module on Windows, and not every limit on macOS
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
        with open("/proc/self/statm", encoding="ascii") as pages:
            taken = int(pages.read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (taken + MEMORY, taken + MEMORY))


def limit_seconds(seconds: int) -> None:
    """Let the system end this process when it has taken so much more time of the processor."""
    with suppress(ImportError):
        import resource

        most = resource.getrlimit(resource.RLIMIT_CPU)[1]
        resource.setrlimit(resource.RLIMIT_CPU, (int(time.process_time()) + seconds + 1, most))
