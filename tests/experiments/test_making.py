"""Who makes runs may lose some, or break: what is finished is kept, what failed is named, the rest goes on."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from typing import Any

import pytest

from lsys_kit import Table, derive, ensemble, sweep, system
from lsys_kit.derivation.derive import Derivation
from lsys_kit.experiments import making

PLANT = system("K7")
BAD = frozenset((17, 40))
_BAD_WORDS = frozenset(str(derive(PLANT, 4, seed=seed)[-1]) for seed in BAD)


def deadly(derivation: Derivation) -> int:
    """A measure that kills its process for some seeds; no test runs it here with those."""
    if str(derivation[-1]) in _BAD_WORDS:
        os.kill(os.getpid(), signal.SIGKILL)
    return len(derivation[-1])


def good(many: int) -> Table:
    """What comes of all other seeds."""
    return ensemble(PLANT, [seed for seed in range(many) if seed not in BAD], {"deadly": "modules"}, steps=4)


@pytest.fixture(autouse=True)
def handed_out_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """All runs but the first are handed out, however fast the machine is."""
    monkeypatch.setattr(making, "FIRST_SECONDS", 0.0)
    monkeypatch.setattr(making, "FIRST_RUNS", 1)
    monkeypatch.setattr(making, "WORTH_SECONDS", 0.0)


def expect_two_are_named(found: Table, many: int, fault: str) -> None:
    """Two seeds are left out and named, and all others are as they should be."""
    assert found.rows == good(many).rows
    lost = f"The process that made the run was lost ({fault})"
    assert found.left_out == tuple((seed, lost) for seed in sorted(BAD))
    assert found.remarks == (f"2 of {many} runs are left out:", *(f"seed = {seed}: {lost}." for seed in sorted(BAD)))


class TestProcesses:
    @pytest.mark.slow
    def test_a_run_that_kills_its_process_is_named_and_the_others_are_made(self) -> None:
        with ProcessPoolExecutor(2) as executor:
            expect_two_are_named(ensemble(PLANT, 120, deadly, steps=4, executor=executor), 120, "BrokenProcessPool")

    @pytest.mark.slow
    def test_a_measure_that_cannot_be_sent_is_said_to_be_none(self) -> None:
        with ProcessPoolExecutor(2) as executor:
            found = ensemble(PLANT, 60, lambda derivation: len(derivation[-1]), steps=4, executor=executor)
        assert 0 < len(found) < 60
        assert found.remarks[0].startswith("The executor broke (")
        assert "pickle" in found.remarks[0]

    def test_an_executor_that_was_shut_down_is_told(self) -> None:
        executor = ThreadPoolExecutor(1)
        executor.shutdown()
        found = ensemble(PLANT, 20, steps=4, executor=executor)
        assert 0 < len(found) < 20
        said = "The executor broke (RuntimeError: cannot schedule new futures after shutdown)"
        assert found.remarks == (f"{said}: {len(found)} of 20 runs are finished.",)

    def test_a_batch_counts_together_what_is_made_alone_else(self) -> None:
        experiment = making.Experiment(PLANT, (2, 3), ["F", "modules"], making.Limits())
        runs: dict[int, making.Run] = {number: {"seed": 7 * number} for number in range(40)}
        measures = making.measures_of(experiment.measure, PLANT)
        assert making.batch(experiment, runs) == {
            number: making.outcome_of(experiment, measures, run) for number, run in runs.items()
        }

    def test_a_batch_that_takes_too_long_comes_back_with_what_it_has(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(making, "BATCH_SECONDS", -1.0)
        experiment = making.Experiment(PLANT, (3,), "F", making.Limits())
        assert len(making.batch(experiment, {0: {"seed": 0}, 1: {"seed": 1}})) == 1
        with ThreadPoolExecutor(2) as executor:
            assert ensemble(PLANT, 30, "F", steps=3, executor=executor).rows == ensemble(PLANT, 30, "F", steps=3).rows


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """What does not come back is missed at once."""
    for name, seconds in (("LOOK", 0.02), ("MISSED", 0.2), ("SILENCE", 0.5)):
        monkeypatch.setattr(making, name, seconds)


@pytest.mark.usefixtures("impatient")
class TestSilence:
    """Results may go down with the process that has made them, and no executor says so."""

    def test_a_result_that_does_not_come_back_is_made_again(self) -> None:
        executor = Forgets(lambda seeds, before: 17 in seeds and before == 0, fails=40)
        assert ensemble(PLANT, 120, steps=4, executor=executor) == ensemble(PLANT, 120, steps=4)

    @pytest.mark.slow
    def test_it_is_missed_where_nothing_else_was_lost_too(self) -> None:
        executor = Forgets(lambda seeds, before: 17 in seeds and before == 0)
        assert ensemble(PLANT, 120, steps=4, executor=executor) == ensemble(PLANT, 120, steps=4)

    @pytest.mark.slow
    def test_a_run_that_never_comes_back_is_named_and_the_others_are_made(self) -> None:
        found = ensemble(PLANT, 120, steps=4, executor=Forgets(lambda seeds, _: 17 in seeds))
        assert found.rows == tuple(row for row in ensemble(PLANT, 120, steps=4).rows if row[0] != 17)
        assert found.left_out == ((17, "The process that made the run was lost (TimeoutError: it did not come back)"),)

    @pytest.mark.slow
    def test_a_long_run_is_waited_for(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(making, "SILENCE", 0.0)
        monkeypatch.setattr(making, "MOST_LATE", 1e9)
        executor = Forgets(lambda *_: False, looks=5)
        assert ensemble(PLANT, 4, steps=4, executor=executor) == ensemble(PLANT, 4, steps=4)
        assert executor.given == 3

    @pytest.mark.slow
    def test_an_executor_that_answers_no_question_is_given_up(self) -> None:
        found = ensemble(PLANT, 120, steps=4, executor=Forgets(lambda seeds, before: 17 in seeds or not seeds, fails=40))
        assert 100 < len(found) < 120
        assert found.remarks[-1] == f"The executor does not answer any more: {len(found)} of 120 runs are finished."


class Forgets(Executor):
    """Two threads, of which some work never comes back: what is said to, given its seeds and how often that was so before. The
    first work with another seed fails; all waits until it was looked so often whether the executor answers."""

    def __init__(self, forgets: Callable[[list[int], int], bool], fails: int | None = None, looks: int = 0) -> None:
        self._threads, self._forgets, self._fails, self._looks = ThreadPoolExecutor(4), forgets, fails, looks
        self._forgotten, self.given, self._looked = 0, 0, threading.Semaphore(0)

    def submit(self, work: Any, *given: Any) -> Future[Any]:  # type: ignore[override]
        seeds = [run["seed"] for run in given[1].values()] if work is making.batch else []
        self.given += bool(seeds)
        if self._forgets(seeds, self._forgotten):
            self._forgotten += 1
            return Future()
        if self._fails in seeds:
            self._fails = None
            return self._threads.submit(int, "lost")
        if not seeds:
            self._looked.release()
        return self._threads.submit(self._made, self._looks if seeds else 0, work, given)

    def _made(self, looks: int, work: Any, given: Any) -> Any:
        for _ in range(looks):
            self._looked.acquire()
        return work(*given)


SLOW_MACHINE = {
    "distributed.scheduler.allowed-failures": 1,
    "distributed.comm.timeouts.connect": "120s",
    "distributed.deploy.lost-worker-timeout": "120s",
}
"""A local cluster forgets a worker that takes longer to begin anew, and at last has none."""


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[], tuple[Any, Any]]]:
    """Starts clusters of two workers, whose scheduler takes a run for bad when two of them have died of it."""
    dask = pytest.importorskip("dask")
    distributed = pytest.importorskip("dask.distributed")
    opened: list[Any] = []

    def start() -> tuple[Any, Any]:
        folder = tmp_path_factory.mktemp("workers")
        choices = {"dashboard_address": None, "local_directory": folder, "host": "127.0.0.1"}
        opened.append(distributed.LocalCluster(n_workers=2, threads_per_worker=1, **choices))
        opened.append(distributed.Client(opened[-1]))
        return opened[-2], opened[-1]

    with dask.config.set(SLOW_MACHINE):
        yield start
        for each in reversed(opened):
            each.close()


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
class TestClusters:
    def test_a_run_that_kills_every_worker_is_named_and_the_others_are_made(self, cluster: Any) -> None:
        _, client = cluster()
        expect_two_are_named(ensemble(PLANT, 120, deadly, steps=4, executor=client.get_executor()), 120, "KilledWorker")

    def test_a_cluster_that_is_closed_half_way_leaves_what_is_finished(self, cluster: Any) -> None:
        running, client = cluster()
        executor = ClosesTheCluster(client.get_executor(), running, client)
        found = ensemble(PLANT, 2_000, steps=5, executor=executor)
        executor.closing.join()
        assert 0 < len(found) < 2_000
        assert found.remarks[-1].startswith("The executor broke (")
        assert found.remarks[-1].endswith(f"{len(found):,} of 2,000 runs are finished.")
        assert found.rows == tuple(row for row in ensemble(PLANT, found["seed"], steps=5).rows)

    def test_a_cluster_makes_the_same_table_even_if_a_worker_is_killed(self, cluster: Any) -> None:
        _, client = cluster()
        alone = sweep(PLANT, {"seed": range(400)}, ["F", "height"], steps=5)
        executor = client.get_executor()
        assert sweep(PLANT, {"seed": range(400)}, ["F", "height"], steps=5, executor=executor) == alone
        victim = KillsAWorker(executor, min(client.run(os.getpid).values()))
        assert sweep(PLANT, {"seed": range(400)}, ["F", "height"], steps=5, executor=victim) == alone
        assert victim.killed
        executor.shutdown()


class KillsAWorker(Executor):
    """The executor of a cluster, one of whose workers is killed as soon as a piece of work has come back."""

    def __init__(self, executor: Any, process: int) -> None:
        self._executor, self._process, self.killed = executor, process, False

    def submit(self, *given: Any, **named: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = self._executor.submit(*given, **named)
        future.add_done_callback(self._kill)
        return future

    def _kill(self, _: Future[Any]) -> None:
        if not self.killed:
            self.killed = True
            os.kill(self._process, signal.SIGKILL)


class ClosesTheCluster(Executor):
    """The executor of a cluster that somebody closes as soon as a piece of work has come back."""

    def __init__(self, executor: Any, *opened: Any) -> None:
        self._executor, self._opened, self._once = executor, opened, threading.Lock()
        self.closing = threading.Thread(target=self._close)

    def submit(self, *given: Any, **named: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = self._executor.submit(*given, **named)
        future.add_done_callback(lambda _: self._once.acquire(blocking=False) and self.closing.start())
        return future

    def _close(self) -> None:
        for each in self._opened:
            each.close()
