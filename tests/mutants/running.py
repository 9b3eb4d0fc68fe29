"""The tests that come to each change, and whether one of them fails while it is on."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, field
from functools import _lru_cache_wrapper, partial
from itertools import chain, groupby
from pathlib import Path

import pytest

from tests.mutants.changes import ROOT, Change
from tests.mutants.forks import forked, in_parallel
from tests.mutants.schemata import Switches

MOST_SECONDS = 60.0
"""As long as the tests of one change may take, measured without it."""
SECONDS_OF_OTHERS = 0.3
"""What a slow test, or one in a browser, is taken to need."""
SECONDS_OF_A_ROOM = 3600.0
CHOSEN = "not slow or slow or browser"
"""All tests, with as few examples of a law as a quick run tries."""


@dataclass(frozen=True)
class Outcome:
    """What came of a change: whether it is caught, by what, and how many quick tests come to it."""

    caught: bool
    by: str
    tests: int


@dataclass
class Runner:
    """What pytest does when it has collected all tests: it runs them for each change, and says what came of it."""

    switches: Switches
    chosen: Sequence[Change]
    jobs: int
    tell: Callable[[Change, Outcome], None]
    log: Callable[[str], None]
    _failed: bool = False
    _items: list[pytest.Item] = field(default_factory=list)
    _quick: list[pytest.Item] = field(default_factory=list)
    _seconds: dict[str, float] = field(default_factory=dict)
    _tests: dict[Change, list[pytest.Item]] = field(default_factory=dict)
    _imported: set[Change] = field(default_factory=set)

    @pytest.hookimpl(trylast=True)
    def pytest_configure(self) -> None:
        """Every run tries the same examples of a law, and remembers none."""
        from hypothesis import settings

        settings.register_profile("mutants", settings(), derandomize=True, database=None)
        settings.load_profile("mutants")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note a failure."""
        self._failed = self._failed or report.failed

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Run the quick tests once, and those that come to each change with it."""
        self._items = [each for each in session.items if each.path.suffix == ".py"]
        self._quick = [each for each in self._items if not any(map(each.get_closest_marker, ("slow", "browser")))]
        self._imported = self.switches.reached & set(self.chosen)
        _forget()
        self._find_out()
        for number, outcome in in_parallel(self._outcome, range(len(self.chosen)), self.jobs):
            self.tell(self.chosen[number], Outcome(*outcome))
        return True

    def _find_out(self) -> None:
        """Which quick tests come to which change, and how long they take."""
        by_file = [list(group) for _, group in groupby(self._quick, lambda item: item.path)]
        parts = [list(chain.from_iterable(by_file[start :: self.jobs])) for start in range(self.jobs)]
        numbers = {change: number for number, change in enumerate(self.chosen)}
        self._tests = {change: [] for change in self.chosen}
        begun = time.monotonic()
        found: dict[str, tuple[float, list[int]]] = {}
        for _, each in in_parallel(
            lambda part: forked(lambda: self._seen(parts[part], numbers), SECONDS_OF_A_ROOM), range(self.jobs), self.jobs
        ):
            found |= each
        self.log(f"{len(found)} quick tests pass, in {time.monotonic() - begun:.0f} s")
        for item in self._quick:
            self._seconds[item.nodeid], reached = found.get(item.nodeid, (0.0, []))
            for number in reached:
                self._tests[self.chosen[number]].append(item)

    def _seen(self, items: Sequence[pytest.Item], numbers: dict[Change, int]) -> dict[str, tuple[float, list[int]]]:
        """The seconds of each test that passes, and the numbers of the changes to which it comes."""
        found = {}
        for item, following in zip(items, [*items, None][1:], strict=True):
            self.switches.forget()
            begun = time.monotonic()
            if self._passes(item, following):
                found[item.nodeid] = time.monotonic() - begun, sorted(numbers[each] for each in self.switches.reached)
        return found

    def _passes(self, item: pytest.Item, following: pytest.Item | None) -> bool:
        self._failed = False
        item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
        return not self._failed

    def _outcome(self, number: int) -> tuple[bool, str, int]:
        """What the tests say of a change, but for those that fail without it as well."""
        change = self.chosen[number]
        items, quick = self._tests_for(change), len(self._tests[change])
        browser = change.file.endswith(".js")
        slow = "" if quick or browser else " (slow)"
        seconds = 60 + 8 * sum(self._cost(item) for item in items)
        while (failed := forked(lambda: self._first_failure(items, change), seconds, browser)) is not None:
            if failed == -1:
                alone = change in self._imported and fails_alone(change)
                return alone, "the tests of its room, in a process of its own" if alone else "", quick
            last = items[failed]
            if forked(partial(self._first_failure, [last], None), seconds, browser) == -1:
                return True, last.nodeid + slow, quick
            del items[failed]
        ends = forked(lambda: self._first_failure(items, None), seconds, browser) is not None
        return (True, "it runs away", quick) if ends else (False, "the tests do not end without it either", quick)

    def _first_failure(self, items: Sequence[pytest.Item], change: Change | None) -> int:
        """The number of the first test that fails, or -1."""
        if change:
            self.switches.turn_on(change)
        return next(
            (
                number
                for number, (item, following) in enumerate(zip(items, [*items, None][1:], strict=True))
                if not self._passes(item, following)
            ),
            -1,
        )

    def _cost(self, item: pytest.Item) -> float:
        return self._seconds.get(item.nodeid, SECONDS_OF_OTHERS)

    def _tests_for(self, change: Change) -> list[pytest.Item]:
        """The tests that are run for a change, those first that are likely to fail soon."""
        if change.file.endswith(".js"):
            items: Iterable[pytest.Item] = sorted(_in_pages(self._items), key=lambda item: _rank(item, Path(change.file).stem))
        elif self._tests[change]:
            items = sorted(self._tests[change], key=lambda item: (not _near(item, change), self._cost(item)))
        else:
            items = [item for item in self._items if item.get_closest_marker("slow") and _near(item, change)]
        chosen: list[pytest.Item] = []
        seconds = 0.0
        for item in items:
            seconds += self._cost(item)
            if seconds > MOST_SECONDS and chosen:
                break
            chosen.append(item)
        return chosen


def _forget() -> None:
    """Empty the caches, which may hold what was made without a change while the tests were collected."""
    modules = [module for name, module in [*sys.modules.items()] if name.startswith("lsys_kit")]
    for value in chain.from_iterable(vars(module).values() for module in modules):
        if isinstance(value, _lru_cache_wrapper):
            value.cache_clear()


def fails_alone(change: Change) -> bool:
    """Whether a quick test of its room fails while a change is on from the beginning, and none without it."""
    room = Path(change.file).parts[1]
    tests = ["-q", "-x", "--thorough", "-m", "not slow and not browser", f"tests/{room}", f"lsys_kit/{room}"]
    with tempfile.TemporaryDirectory() as folder:
        (file := Path(folder, "on.json")).write_text(json.dumps({"mutants": [asdict(change)]}), "utf-8")
        passes = [
            subprocess.run([sys.executable, "-m", module, *of_it, *tests], cwd=ROOT, capture_output=True).returncode == 0
            for module, *of_it in (("tests.mutants.alone", file), ("pytest",))
        ]
    return passes == [False, True]


def _near(item: pytest.Item, change: Change) -> bool:
    """Whether a test is one of the room of a change."""
    place, room = item.path.relative_to(ROOT), Path(change.file).parts[1]
    return place.parts[:2] == ("tests", room) or str(place) == change.file


def _in_pages(items: Iterable[pytest.Item]) -> list[pytest.Item]:
    """Tests that open scripts in a browser, without Jupyter."""
    return [
        item
        for item in items
        if item.path.parent == ROOT / "tests" / "classroom"
        and item.get_closest_marker("browser")
        and "lab" not in getattr(item, "fixturenames", ())
    ]


def _rank(item: pytest.Item, script: str) -> tuple[bool, bool, str]:
    """First the files that name a script, or import a list that does, then the panel."""
    names = [each for each in vars(getattr(item, "module", item)).values() if isinstance(each, tuple)]
    named = f'"{script}"' in item.path.read_text("utf-8") or any(script in each for each in names)
    return not named, "panel" not in item.path.stem, item.path.name
