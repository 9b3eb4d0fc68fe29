"""Models that repeat, grow or nest without end, and the public functions that meet them: each call must end within its limits,
with a result or with an error of the kit, and of every model some call must be refused.

    python -m tests.fuzzing.bombs 1 100                       all of them, with a limit of one second and 100 MB
    python -m tests.fuzzing.bombs 1 100 chance "longest word" some of them, and what some rows of calls do to all
"""

from __future__ import annotations

import resource
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from tests.fuzzing.acts import Calls, acts, map_acts
from tests.fuzzing.models import BOMBS, MAPS

SLACK = 2
"""So many seconds of the processor a call may take beyond its limit: operations on whole arrays are not divided, and a second
of a processor that others share does less."""
ROOM = 300
"""So many megabytes it may take beyond its limit."""


def rows(folder: Path) -> Iterator[tuple[str, str, Calls]]:
    """Each model with each row of calls: their names, and the calls with that which reads the model before them."""
    from lsys_kit import read, read_map

    kinds: tuple[tuple[Mapping[str, str], Callable[[str], Any], Mapping[str, Calls]], ...] = (
        (BOMBS, read, acts(folder)), (MAPS, read_map, map_acts(folder)))
    for models, reader, table in kinds:
        for name, text in models.items():
            for act, calls in table.items():
                yield name, act, (lambda _, reader=reader, text=text: reader(text), *calls)


def warm_up(folder: Path) -> None:
    """Import what the calls need, which takes its time once."""
    from lsys_kit import LSystemError, limits, read, read_map

    for system, table in ((read("axiom: F\nF -> F+F"), acts(folder)), (read("axiom: a(0)\na(1) -> a(0) a(0)"), acts(folder)),
                          (read_map("map: ABAB\nA -> B[-A][+A]B\nB -> A"), map_acts(folder))):
        for calls in table.values():
            found: Any = system
            with suppress(LSystemError), limits(seconds=0.1, modules=1_000):
                for call in calls:
                    found = call(found)


def done(call: Callable[[Any], Any], given: Any, seconds: float, megabytes: int) -> tuple[Any, BaseException | None, float]:
    """What a call makes of what it is given within its limits, or the error that it raises; and how long the processor took."""
    from lsys_kit import limits

    started, found, failed = time.process_time(), None, None
    _room(megabytes + ROOM)
    try:
        with limits(seconds=seconds, bytes=megabytes * 2**20):
            found = call(given)
    except BaseException as error:
        failed = error
    _room(100_000)
    return found, failed, time.process_time() - started


def report(seconds: float, megabytes: int, *only: str) -> list[str]:
    """Make all calls; what did not keep to its limits, one line for each, and which models were never refused."""
    from lsys_kit import ModelLimitError

    found, refused, met = [], set[str](), set[str]()
    with tempfile.TemporaryDirectory() as folder:
        warm_up(Path(folder))
        for name, act, calls in rows(Path(folder)):
            if not only or {name, act} & {*only}:
                failed, spent = followed(calls, seconds, megabytes)
                met.add(name)
                refused |= {name} if isinstance(failed, ModelLimitError) else set()
                outcome = f"{type(failed).__name__}: {failed}" if failed else "done"
                found += [f"{name}, {act}: {wrong}" for wrong in broken(failed, spent, seconds)]
                print(f"{name:22} {act:20} {spent:5.2f} {outcome[:110]!r}", flush=True)
    asked = met & {*only} if only else met
    return [*found, *(f"{name} is never refused" for name in sorted(asked - refused))]


def followed(calls: Calls, seconds: float, megabytes: int) -> tuple[BaseException | None, float]:
    """Make some calls, each with what the one before has made: the error that ended them, and the time of the longest."""
    given, longest = None, 0.0
    for call in calls:
        given, failed, spent = done(call, given, seconds, megabytes)
        longest = max(longest, spent)
        if failed:
            return failed, longest
    return None, longest


def broken(failed: BaseException | None, spent: float, seconds: float) -> Iterator[str]:
    """What a call did that it must not do."""
    from lsys_kit import LSystemError

    if spent > seconds + SLACK:
        yield f"{spent:.1f} seconds"
    if not isinstance(failed, LSystemError | None):
        yield f"{type(failed).__name__}: {failed}"


def _room(megabytes: int) -> None:
    """From here on so much memory more may be used than now."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + megabytes * 2**20, resource.RLIM_INFINITY))


if __name__ == "__main__":
    wrong = report(float(sys.argv[1]), int(sys.argv[2]), *sys.argv[3:])
    for line in wrong:
        print(line, file=sys.stderr)
    sys.exit(bool(wrong))
