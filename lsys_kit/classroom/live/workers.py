"""Worker processes that answer for a class, under hard limits: what strangers type never runs in the server's own process.

Each phone has one question answered at a time, and phones take turns, so that nobody's bomb keeps others waiting. A worker that
takes longer than most gets less of the processor from then on; one that takes too long or too much is ended, and another takes
its place.
"""

from __future__ import annotations

import asyncio
import json
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from hashlib import sha256
from multiprocessing.connection import Connection
from queue import Empty, Queue
from threading import Lock
from typing import Any, NamedTuple

from lsys_kit.cache import Cache
from lsys_kit.classroom.child_processes import limit_memory, limit_seconds
from lsys_kit.errors import LSystemError

QUICK, PROCESSOR = 0.4, 4
"""After so many seconds of the processor a worker lets others go first, and after so many it is ended."""
LONGEST = 15.0
"""So many seconds by the clock on the wall an answer may take, on a machine that is busy."""
NICER = 10
"""By so much the priority of what takes long is lowered."""
STARTING = 60.0
"""So many seconds a worker may take to begin, on a busy machine."""
A_LITTLE = 0.2
"""Whoever waits looks after so many seconds whether all is being closed."""
MOST_BYTES = 20_000_000
"""So many bytes an answer has at most."""
MOST_WAITING, MOST_IN_ALL = 4, 400
"""So many questions of a phone may wait, and of all phones."""
KEPT = 1 / 8
"""This part of the limit of bytes has room for answers that may be asked for again."""
TOO_LONG = {"message": "It takes too long, and was stopped", "hint": "Take fewer steps, or a smaller model."}
_CONTEXT: Any = multiprocessing.get_context("spawn" if sys.platform == "win32" else "forkserver")


class Busy(LSystemError):
    """A phone, or all of them, ask more than can be answered."""


class _Job(NamedTuple):
    asked: bytes
    done: asyncio.Future[bytes]


class _Worker:
    """A process that answers one question after another."""

    def __init__(self) -> None:
        ours, theirs = _CONTEXT.Pipe()
        self.connection: Connection = ours
        self.process = _CONTEXT.Process(target=_work, args=(theirs,), daemon=True)
        self.process.start()
        self._ending = Lock()
        theirs.close()

    def is_ready(self, wanted: Callable[[], bool]) -> bool:
        """Whether it has begun; that is not waited for when it is wanted no more."""
        end = time.monotonic() + STARTING
        with suppress(EOFError, OSError):
            while wanted() and time.monotonic() < end:
                if self.connection.poll(A_LITTLE):
                    return self.connection.recv_bytes() == b"ready"
        return False

    def end(self) -> None:
        """End it, once: its starter and whoever closes all workers may both ask for that."""
        with self._ending:
            if not self.connection.closed:
                self.process.kill()
                self.process.join(5)
                self.connection.close()


class Workers:
    """Some worker processes, and the questions that wait for them.

    many
        How many workers there are; by default two more than there are processors.
    """

    def __init__(self, many: int | None = None) -> None:
        self._many = many or (os.cpu_count() or 1) + 2
        self._ready: Queue[_Worker] = Queue()
        self._all: set[_Worker] = set()
        self._waiting: dict[str, deque[_Job]] = {}
        self._turns: deque[str] = deque()
        self._asked: dict[bytes, asyncio.Future[bytes]] = {}
        self._known: Cache[bytes, bytes] = Cache(len, KEPT)
        self._free, self._closed = self._many, False
        self._threads = ThreadPoolExecutor(self._many)
        self._starters = ThreadPoolExecutor(self._many)
        if sys.platform != "win32":
            _CONTEXT.set_forkserver_preload(["lsys_kit.classroom.live.ready"])
        for _ in range(self._many):
            self._starters.submit(self._start)

    async def ask(self, phone: str, asked: Mapping[str, object]) -> bytes:
        """The answer to a question of a phone, as JSON; the same question of several is answered once.

        Raises
        ------
        Busy
            Too many questions wait already.
        """
        packed = json.dumps(asked, sort_keys=True, separators=(",", ":")).encode()
        key = sha256(packed).digest()
        known = self._known.get(key)
        if known is not None:
            return known
        if key not in self._asked:
            if len(self._waiting.get(phone, ())) >= MOST_WAITING or len(self._asked) >= MOST_IN_ALL:
                raise Busy("Too much is asked at once", hint="Try it again in a moment.")
            waiting = self._waiting.setdefault(phone, deque())
            job = _Job(packed, asyncio.get_running_loop().create_future())
            self._asked[key] = job.done
            job.done.add_done_callback(lambda _: self._asked.pop(key, None))
            waiting.append(job)
            if len(waiting) == 1:
                self._turns.append(phone)
            self._begin()
        answer = await asyncio.shield(self._asked[key])
        if answer != _TOO_LONG:
            self._known.put(key, answer)
        return answer

    def _begin(self) -> None:
        """Let the phones whose turn it is have their answers, as many as there are workers."""
        while self._free and self._turns:
            phone = self._turns.popleft()
            self._free -= 1
            asyncio.get_running_loop().create_task(self._answer(phone))

    async def _answer(self, phone: str) -> None:
        job = self._waiting[phone][0]
        answer = await asyncio.get_running_loop().run_in_executor(self._threads, self._answered, job.asked)
        if not job.done.done():
            job.done.set_result(answer)
        self._free += 1
        waiting = self._waiting[phone]
        waiting.popleft()
        if waiting:
            self._turns.append(phone)
        else:
            del self._waiting[phone]
        self._begin()

    def _answered(self, asked: bytes) -> bytes:
        """The answer of a worker; this waits in a thread."""
        end = time.monotonic() + STARTING
        while True:
            with suppress(Empty):
                worker = self._ready.get(timeout=A_LITTLE)
                break
            if self._closed or time.monotonic() > end:
                return _TOO_LONG
        try:
            worker.connection.send_bytes(asked)
            answer = worker.connection.recv_bytes(MOST_BYTES) if worker.connection.poll(LONGEST) else b""
        except (EOFError, OSError):
            answer = b""
        if answer[:1] == _QUICKLY:
            self._ready.put(worker)
        else:
            self._replace(worker)  # of one that has let others go first the priority cannot be raised again
        return answer[1:] or _TOO_LONG

    def _replace(self, worker: _Worker) -> None:
        self._all.discard(worker)
        with suppress(RuntimeError):  # all is being closed
            self._starters.submit(self._start)
        worker.end()

    def _start(self) -> None:
        if self._closed:
            return
        worker = _Worker()
        self._all.add(worker)
        if worker.is_ready(lambda: not self._closed) and not self._closed:
            self._ready.put(worker)
        else:
            self._all.discard(worker)
            worker.end()

    def close(self) -> None:
        """End all workers."""
        self._closed = True
        for worker in [*self._all]:
            worker.end()
        self._starters.shutdown(wait=False, cancel_futures=True)
        self._threads.shutdown(wait=False, cancel_futures=True)


_TOO_LONG = json.dumps({"mistake": TOO_LONG}).encode()
_QUICKLY, _SLOWLY = b"+", b"-"
"""What stands before an answer, by how much of the processor it took."""


# In a worker


def _work(questions: Connection) -> None:
    """Answer one question after another, until nobody asks any more."""
    from lsys_kit.classroom.live import ready
    from lsys_kit.classroom.live.answers import answer

    assert ready
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of the terminal: the server ends its workers
    patience = _Patience()
    limit_memory()
    with suppress(EOFError, OSError):
        questions.send_bytes(b"ready")
        while True:
            asked = questions.recv_bytes()
            limit_seconds(PROCESSOR)
            patience.begin()
            try:
                reply: object = answer(json.loads(asked))
            except MemoryError:
                reply = {"mistake": {"message": "It takes too much memory", "hint": "Take fewer steps."}}
            patience.end()
            packed = json.dumps(reply, separators=(",", ":")).encode()
            questions.send_bytes((_SLOWLY if patience.lost else _QUICKLY) + packed)


class _Patience:
    """Lowers the priority of this process when an answer takes long, where the platform can."""

    def __init__(self) -> None:
        self.lost = False
        if hasattr(signal, "SIGPROF"):
            signal.signal(signal.SIGPROF, self._lose)

    def begin(self) -> None:
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_PROF, QUICK)

    def end(self) -> None:
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_PROF, 0)

    def _lose(self, _: int, __: object) -> None:
        self.lost = True
        os.nice(NICER)
