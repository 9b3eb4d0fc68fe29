"""Who makes the runs: this process, or any executor of `concurrent.futures`, such as a pool of processes or that of a cluster.

To hand a piece of work to another process takes milliseconds, as long as a small run. So a batch holds as many runs as take
about a quarter of a second, which is learnt from the first ones, made here; one that takes much longer comes back with what it
has made, and the rest is handed out anew. What comes out depends on the runs alone, never on who makes them or when.

A run may kill the process that makes it, by taking all its memory, say, and with it whatever else was there. So what is lost is
made again, run by run; and what is lost once more alone, with nothing beside it. Only of a run that is lost alone it is said
that it failed. A result that goes down with its process may never be heard of again: what does not come back from an executor
that answers other questions is lost, too.
"""

from __future__ import annotations

import asyncio
import os
import time
from collections import deque
from collections.abc import Generator, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future, ProcessPoolExecutor, wait
from contextlib import suppress
from dataclasses import asdict
from math import ceil
from typing import NamedTuple, TypeAlias

from lsys_kit.arrays import arrays_pay
from lsys_kit.budget import Limits, Task, limits
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import Choices, serves
from lsys_kit.derivation.engines.columnar import ColumnarSteps
from lsys_kit.derivation.engines.together import counts_together
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError, quotable
from lsys_kit.experiments.measures import Asked, Measure, measures_of
from lsys_kit.notation.model.system import LSystem
from lsys_kit.worlds.derive import derive

FIRST_SECONDS, FIRST_RUNS, BATCH_SECONDS = 0.05, 3, 0.25
"""For how long, and how many, runs (or bunches of them) are made here before others are handed out; the length of a batch."""
WORTH_SECONDS = 0.15
"""What takes no longer than this is made here: to hand it out would take as long."""
FEWEST_BATCHES = 16
"""There are at least so many batches, if there are as many runs, so that no processor waits long for the last one."""
MOST_BATCHES = 1_024
"""The most batches that are handed out at a time."""
FUTILE = 8
"""An executor is given up after so many runs were lost when it has never finished one."""
LOOK, MISSED, SILENCE = 5.0, 15.0, 120.0
"""Seconds without a result after which it is looked whether the executor takes work; after which one that does has lost what it
was given, if it has lost something before; and after which it has in any case, or is given up if it takes none and has lost
something."""
FEW_RUNS, RUNS_TOGETHER = 8, 256
"""More runs than the first are counted side by side, if they differ in their seeds alone; so many at a time."""
GROWTH = 8
"""Each bunch of them that is made here is so many times as large as the one before: soon it is known how long they take."""
MOST_LATE = 20
"""What takes no longer than so many runs is not taken for lost."""


Rows: TypeAlias = tuple[tuple[object, ...], ...]
"""What a run comes to: for each step the step and its measured values."""


class Failure(NamedTuple):
    """Why a run could not be finished."""

    message: str
    limit: float | None = None

    def error(self) -> ModelLimitError | ModelValueError:
        """The error to raise."""
        return ModelValueError(self.message) if self.limit is None else ModelLimitError(self.message, limit=self.limit)


Outcome: TypeAlias = Rows | Failure


class Experiment(NamedTuple):
    """What is done in each run: the system that is derived, the steps that are measured, in ascending order, what is measured,
    as a person gives it, and the limits."""

    system: LSystem
    steps: tuple[int, ...]
    measure: Asked
    limits: Limits


Run: TypeAlias = Choices
"""The seed and the constants of a run, as `derive` takes them."""


class ExecutorError(Exception):
    """An executor that makes no more runs, and why, as a remark says it."""


def outcome_of(experiment: Experiment, measures: Sequence[Measure], run: Run) -> Outcome:
    """Make a run."""

    with limits(**asdict(experiment.limits)), Task("The run was not finished"):
        try:
            whole = derive(experiment.system, experiment.steps[-1], **run)
            parts = [whole.to(step) for step in experiment.steps]
            return tuple((part.steps, *(measure.value(part) for measure in measures)) for part in parts)
        except (ModelLimitError, ModelValueError) as error:
            return Failure(error.message, getattr(error, "limit", None))
        except MemoryError:
            return Failure("There was not enough memory")


Outcomes: TypeAlias = Generator[tuple[int, Outcome], None, None]


def batch(experiment: Experiment, runs: Mapping[int, Run], _: int = 0) -> dict[int, Outcome]:
    """Make some runs: at least one, and no more once they have taken twice as long as a batch should.

    A number of its own makes a batch another than the one before, for a cluster does not try again what it has seen fail.
    """
    end, made = time.perf_counter() + 2 * BATCH_SECONDS, dict[int, Outcome]()
    for bunch in _bunches(experiment, runs, RUNS_TOGETHER):
        made.update(bunch)
        if made and time.perf_counter() > end:
            break
    return made


def outcomes(experiment: Experiment, runs: Mapping[int, Run], executor: Executor | None) -> Outcomes:
    """The runs' outcomes, each with its number, in the order in which they are finished.

    When it is closed, whatever has not begun is called off.

    Raises
    ------
    ExecutorError
        The executor makes no more runs.
    """
    left, spent, taken = dict(runs), 0.0, list[float]()
    start = time.perf_counter()
    for bunch in _bunches(experiment, runs, FEW_RUNS):
        took = time.perf_counter() - start
        spent += took
        taken += [took / len(bunch)] if bunch else []
        for number, _ in bunch:
            del left[number]
        yield from bunch
        if executor is not None and _well_timed(spent, taken):
            seconds = min(taken)
            if seconds * len(left) > WORTH_SECONDS:
                yield from _Workers(experiment, runs, executor).outcomes([*left], seconds)
                return
        start = time.perf_counter()


def _bunches(experiment: Experiment, runs: Mapping[int, Run], size: int) -> Iterator[list[tuple[int, Outcome]]]:
    """The outcomes of runs that are made here: of those that can be counted together, so many at first; then one by one.

    They are counted together if they differ in their seeds alone, and it is enough to count symbols.
    """
    measures, left = measures_of(experiment.measure, experiment.system), dict(runs)
    of_counts = [of for measure in measures if (of := measure.of_counts())]
    for numbers in _alike(runs, size) if len(of_counts) == len(measures) else ():
        bunch = list[tuple[int, Outcome]]()
        for number, found in zip(numbers, _counts(experiment, [runs[each] for each in numbers]), strict=True):
            if found is not None:
                rows = zip(experiment.steps, found, strict=True)
                bunch.append((number, tuple((step, *(of(each) for of in of_counts)) for step, each in rows)))
                del left[number]
        yield bunch
    for number, run in left.items():
        yield [(number, outcome_of(experiment, measures, run))]


def _counts(experiment: Experiment, runs: Sequence[Run]) -> Sequence[Sequence[Mapping[str, int]] | None]:
    """For each of some runs how often each symbol occurs at the steps; None, where that is found by the run alone."""
    choices = {name: value for name, value in runs[0].items() if name not in ("seed", "arithmetic")}
    with suppress(ModelLimitError, ModelValueError), limits(**asdict(experiment.limits)), Task("The run was not finished"):
        states = States(experiment.system, choices, runs[0].get("arithmetic", "exact"))
        if serves(ColumnarSteps, states.traits):
            return [*counts_together(states, [run["seed"] for run in runs], experiment.steps)]
    return [None] * len(runs)


def _alike(runs: Mapping[int, Run], size: int) -> Iterator[list[int]]:
    """The numbers of runs that differ in their seeds alone, some at a time; of fewer it is known sooner what comes out."""
    groups: dict[object, list[int]] = {}
    for number, run in runs.items():
        if type(run.get("seed")) is int and not {"field", "letters"} & run.keys():
            with suppress(TypeError):  # of what cannot be compared each run is made alone
                alike = frozenset((name, type(value), value) for name, value in run.items() if name != "seed")
                groups.setdefault(alike, []).append(number)
    for numbers in groups.values():
        first = 0
        while first < len(numbers) and arrays_pay(len(numbers), FEW_RUNS):
            yield numbers[first : first + size]
            first, size = first + size, min(GROWTH * size, RUNS_TOGETHER)


def _well_timed(spent: float, taken: Sequence[float]) -> bool:
    """Whether some runs show how long one takes; the first takes longer than others."""
    return bool(taken) and spent > FIRST_SECONDS and (len(taken) >= FIRST_RUNS or spent > BATCH_SECONDS)


def batch_size(runs: int, seconds: float) -> int:
    """How many runs a batch holds, given how many there are and how long one takes.

    >>> batch_size(400, 0.0026), batch_size(100_000, 0.0026), batch_size(400, 1.0)
    (25, 97, 1)
    """
    return max(1, min(ceil(BATCH_SECONDS / max(seconds, 1e-6)), ceil(runs / FEWEST_BATCHES)))


class _Workers:
    """An executor at work on runs, which have numbers."""

    def __init__(self, experiment: Experiment, runs: Mapping[int, Run], executor: Executor) -> None:
        self._experiment, self._runs, self._executor, self._own = experiment, runs, executor, False
        self._handed, self._finished, self._seconds = 0, False, 0.0
        """how many batches were handed out; whether one has come back; about how long a run takes"""

    def outcomes(self, numbers: Sequence[int], seconds: float) -> Outcomes:
        """The outcomes of some runs, of which one takes about so long."""
        self._seconds, size = seconds, batch_size(len(numbers), seconds)
        try:
            lost = yield from self._round([numbers[at : at + size] for at in range(0, len(numbers), size)], MOST_BATCHES)
            if lost:
                self._look(lost[-1][1])
                lost = yield from self._round([[each] for batch, _ in lost for each in batch], os.cpu_count() or 1)
            for [number], _ in lost:
                for _, fault in (yield from self._round([[number]], 1)):
                    self._look(fault)
                    yield number, Failure(_lost(fault))
        finally:
            if self._own:
                self._executor.shutdown(wait=False, cancel_futures=True)

    def _round(self, batches: Sequence[Sequence[int]], most: int) -> Generator[tuple[int, Outcome], None, _Lost]:
        """Hand out batches, at most so many at a time; what is lost is given back, with what was the matter."""
        waiting, at_work = deque(batches), dict[Future[dict[int, Outcome]], Sequence[int]]()
        lost: _Lost = []
        heard = time.monotonic()
        try:
            while waiting or at_work:
                while waiting and len(at_work) < most:
                    try:
                        at_work[self._submitted(waiting[0])] = waiting[0]
                    except Exception as fault:  # whatever an executor may raise
                        lost.append((waiting[0], fault))
                    waiting.popleft()
                done = wait(at_work, LOOK, FIRST_COMPLETED).done
                if done or not at_work:
                    heard = time.monotonic()
                elif self._look():
                    patience = MISSED if lost and most > 1 else SILENCE
                    if time.monotonic() - heard > max(patience, MOST_LATE * self._seconds):
                        lost += [(numbers, TimeoutError("it did not come back")) for numbers in at_work.values()]
                        _called_off(at_work)
                elif time.monotonic() - heard > SILENCE and (lost or most < MOST_BATCHES):
                    raise ExecutorError("The executor does not answer any more")
                for future in done:
                    numbers = at_work.pop(future)
                    try:
                        made = future.result()
                    except LSystemError:
                        raise
                    except (Exception, asyncio.CancelledError) as fault:
                        lost.append((numbers, fault))
                    else:
                        self._finished = True
                        yield from made.items()
                        if len(made) < len(numbers):
                            waiting.append([number for number in numbers if number not in made])
                if most < MOST_BATCHES and len(lost) >= FUTILE and not self._finished:
                    raise ExecutorError(_broken(lost[-1][1]))
        finally:
            _called_off(at_work)
        return lost

    def _submitted(self, numbers: Sequence[int]) -> Future[dict[int, Outcome]]:
        self._handed += 1
        runs = {number: self._runs[number] for number in numbers}
        try:
            return self._executor.submit(batch, self._experiment, runs, self._handed)
        except BrokenExecutor:
            if not self._renewed():
                raise
            return self._executor.submit(batch, self._experiment, runs, self._handed)

    def _renewed(self) -> bool:
        """Whether another pool of processes goes on for one that broke; other executors mend themselves, or cannot be."""
        if type(self._executor) is not ProcessPoolExecutor:
            return False
        was = vars(self._executor)
        if self._own:
            self._executor.shutdown(wait=False)
        self._executor = ProcessPoolExecutor(was["_max_workers"], was["_mp_context"], was["_initializer"], was["_initargs"])
        self._own = True
        return True

    def _look(self, lost: BaseException | None = None) -> bool:
        """Whether the executor answers: one that was closed refuses work, or calls it off at once, and makes no more runs."""
        self._handed += 1
        try:
            asked = self._executor.submit(alive, self._handed)
            fault = asked.exception(LOOK)
        except TimeoutError:  # it is at work, or its workers begin anew
            asked.cancel()
            return False
        except (Exception, asyncio.CancelledError) as refused:
            fault = refused
        if fault is not None and not (isinstance(fault, BrokenExecutor) and self._renewed()):
            raise ExecutorError(_broken(lost or fault)) from None
        return fault is None


def _called_off(at_work: dict[Future[dict[int, Outcome]], Sequence[int]]) -> None:
    for each in at_work:
        each.cancel()
    at_work.clear()


def alive(_: int) -> int:
    """What an executor is asked to see that it lives; a number makes it another question than the one before."""
    return os.getpid()


_Lost: TypeAlias = list[tuple[Sequence[int], BaseException]]


def _lost(fault: BaseException) -> str:
    return f"The process that made the run was lost ({_said(fault)})"


def _broken(fault: BaseException) -> str:
    return f"The executor broke ({_said(fault)})"


def _said(fault: BaseException) -> str:
    """What is the matter: of a process that is gone its kind alone, for it has nothing to tell."""
    kind, text = type(fault).__name__, " ".join(str(fault).split())
    gone = isinstance(fault, BrokenExecutor | CancelledError) or kind == "KilledWorker"
    return kind if gone or not text else quotable(f"{kind}: {text}")
