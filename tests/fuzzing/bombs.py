"""Every public way with every bomb of its kind, each in a process of its own, measured there: it must end within its limits of
time and memory, with a result or with an error of the kit.

    nice python -m tests.fuzzing.bombs                     all of it, within the limits that the kit has by default
    python -m tests.fuzzing.bombs 1 100                    within one second and 100 MB
    python -m tests.fuzzing.bombs 1 100 chance "derive"    some bombs, and what some rows of calls do to all
    python -m tests.fuzzing.bombs --rows 150 --seed 7      some rows, drawn at random

Each row is written out with what it took, and at the end what broke its limits.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import random
import resource
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from tests.fuzzing.acts import GROUPS, SMALL, Calls

BEYOND, SECONDS_BEYOND, MEGABYTES_BEYOND = 1.2, 1.0, 150
"""A call may take its limit so many times, and so much more: operations on whole arrays are not divided, and a second of a
processor that others share does less."""
MERCY = 60
"""A call that takes so many seconds beyond its limit is ended."""

EXHAUSTED = "ended by", "MemoryError", "RecursionError", "OverflowError"
"""What no limit has stopped says so; whether other errors are the kit's own is asked elsewhere, of any argument."""


class Row(NamedTuple):
    """A bomb and what is done with it."""

    bomb: str
    way: str
    calls: Calls


class Outcome(NamedTuple):
    """What came of a row: the seconds of the processor of its longest call, the megabytes that it took, and the error."""

    seconds: float
    megabytes: float
    error: str


def table(folder: Path) -> Iterator[Row]:
    """All rows."""
    for bombs, taken, acts in GROUPS:
        ways = acts(folder)
        for bomb, made in bombs.items():
            yield from (Row(bomb, way, (lambda _, taken=taken, made=made: taken(made), *calls)) for way, calls in ways.items())


def warm_up(folder: Path) -> None:
    """Import what the calls need, which takes its time once."""
    from lsys_kit import limits, read, read_cellwork, read_map

    small: dict[Callable[[Any], Any], Any] = {
        read: SMALL,
        read_map: "map: ABAB\nA -> B[-A][+A]B\nB -> A",
        read_cellwork: "cellwork: 1(0,0,0)",
        str: "a",
    }
    for _, taken, acts in GROUPS:
        for calls in acts(folder).values() if taken in small else ():
            found: Any = None
            with suppress(Exception), limits(seconds=0.1, modules=1_000):
                found = taken(small[taken])
                for call in calls:
                    found = call(found)


def outcome(calls: Calls, seconds: float, megabytes: int) -> Outcome:
    """Make some calls in a child process, each with what the one before has made."""
    heard, said = os.pipe()
    before = int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()
    child = os.fork()
    if not child:
        os.close(heard)
        _child(calls, seconds, megabytes, said)
    os.close(said)
    with open(heard) as pipe:
        told = pipe.read()
    _, status, used = os.wait4(child, 0)
    taken = max(0.0, used.ru_maxrss / 1024 - before / 2**20)
    if not told:
        return Outcome(used.ru_utime + used.ru_stime, taken, f"ended by {signal.Signals(os.WTERMSIG(status)).name}")
    longest, error = json.loads(told)
    return Outcome(longest, taken, error)


def _child(calls: Calls, seconds: float, megabytes: int, said: int) -> None:
    """What the child process does, to its end."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    most = pages * resource.getpagesize() + (4 * megabytes + 1_000) * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CPU, (int(2 * len(calls) * seconds) + MERCY,) * 2)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    try:
        os.write(said, json.dumps(_followed(calls, seconds, megabytes)).encode())
    finally:
        os._exit(0)


def _followed(calls: Calls, seconds: float, megabytes: int) -> tuple[float, str]:
    """Make the calls: the time of the longest, and the error that ended them."""
    from lsys_kit import limits

    given, longest = None, 0.0
    for call in calls:
        started = time.process_time()
        try:
            with limits(seconds=seconds, bytes=megabytes * 2**20):
                given = call(given)
        except BaseException as error:
            return max(longest, time.process_time() - started), f"{type(error).__name__}: {str(error)[:200]}"
        longest = max(longest, time.process_time() - started)
    return longest, ""


def broken(found: Outcome, seconds: float, megabytes: int) -> Iterator[str]:
    """What a row did that it must not do."""
    if found.seconds > BEYOND * seconds + SECONDS_BEYOND:
        yield f"{found.seconds:.1f} seconds"
    if found.megabytes > BEYOND * megabytes + MEGABYTES_BEYOND:
        yield f"{found.megabytes:.0f} MB"
    if found.error.startswith(EXHAUSTED):
        yield found.error


def report(rows: Iterable[Row], seconds: float, megabytes: int) -> list[str]:
    """Make the calls of some rows; what did not keep to its limits, a line for each."""
    wrong = []
    for row in rows:
        found = outcome(row.calls, seconds, megabytes)
        said = f"{row.way} | {row.bomb}: {found.seconds:.2f} seconds, {found.megabytes:.0f} MB, {found.error[:110]!r}"
        print(said, flush=True)
        wrong += [f"{said} BROKEN: {what}" for what in broken(found, seconds, megabytes)]
    return wrong


def main(seconds: float, megabytes: int, only: Iterable[str], most: int | None, seed: int) -> list[str]:
    """So many rows at most, drawn with a seed; those with one of some names, if any are given."""
    with tempfile.TemporaryDirectory() as folder:
        asked = (row for row in table(Path(folder)) if not only or {row.bomb, row.way, row.way.partition(":")[0]} & {*only})
        rows = [*asked]
        random.Random(seed).shuffle(rows)
        warm_up(Path(folder))
        gc.freeze()
        return report(rows[:most], seconds, megabytes)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("seconds", nargs="?", type=float, default=10)
    parser.add_argument("megabytes", nargs="?", type=int, default=512)
    parser.add_argument("only", nargs="*")
    parser.add_argument("--rows", type=int)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    wrong = main(given.seconds, given.megabytes, given.only, given.rows, given.seed)
    for line in wrong:
        print(line, file=sys.stderr)
    sys.exit(bool(wrong))
