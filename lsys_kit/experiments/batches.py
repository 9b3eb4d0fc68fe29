"""Runs in batches: here, or on any executor of `concurrent.futures`, such as a pool of processes or `Client.get_executor()` of
dask.distributed.

To hand a piece of work to another process takes milliseconds, as long as a small run. So a batch holds as many runs as take
about a quarter of a second; how long one takes is learnt from the first ones, which are made here. What comes out depends on
the runs alone, never on who makes them or when.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, as_completed
from dataclasses import asdict, dataclass
from math import ceil
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.budget import Limits, Task, limits
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.experiments.measures import Asked, Measure, measures_of
from lsys_kit.notation.model.system import LSystem
from lsys_kit.worlds.derive import derive

FIRST_SECONDS, BATCH_SECONDS = 0.05, 0.25
"""For how long runs are made here before the others are handed out, and about how long a batch takes."""
FEWEST_BATCHES = 16
"""There are at least so many batches, if there are as many runs, so that no processor waits long for the last one."""

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


@dataclass(frozen=True)
class Experiment:
    """What is done in each run.

    Attributes
    ----------
    system
        The system that is derived.
    steps
        The steps that are measured, in ascending order.
    measure
        What is measured, as a person gives it.
    limits
        The limits of each run.
    """

    system: LSystem
    steps: tuple[int, ...]
    measure: Asked
    limits: Limits


Run: TypeAlias = Mapping[str, object]
"""The seed and the constants of a run, as `derive` takes them."""


def outcome_of(experiment: Experiment, measures: Sequence[Measure], run: Run) -> Outcome:
    """Make a run."""
    choices: dict[str, Any] = {**run}
    with limits(**asdict(experiment.limits)), Task("The run was not finished"):
        try:
            whole = derive(experiment.system, experiment.steps[-1], **choices)
            parts = [whole.to(step) for step in experiment.steps]
            return tuple((part.steps, *(measure.value(part) for measure in measures)) for part in parts)
        except ModelLimitError as error:
            return Failure(error.message, error.limit)
        except ModelValueError as error:
            return Failure(error.message)


def batch(experiment: Experiment, runs: Sequence[Run]) -> list[Outcome]:
    """Make some runs, one after another."""
    measures = measures_of(experiment.measure, experiment.system)
    return [outcome_of(experiment, measures, run) for run in runs]


def outcomes(
    experiment: Experiment, runs: Sequence[Run], executor: Executor | None
) -> Generator[tuple[int, Outcome], None, None]:
    """The runs' outcomes, each with its place, in the order in which they are finished.

    When it is closed, whatever has not begun is called off.
    """
    measures, start = measures_of(experiment.measure, experiment.system), time.perf_counter()
    for place, run in enumerate(runs):
        yield place, outcome_of(experiment, measures, run)
        passed = time.perf_counter() - start
        if executor is not None and passed > FIRST_SECONDS:
            yield from _handed_out(experiment, runs, place + 1, passed / (place + 1), executor.submit)
            return


def _handed_out(
    experiment: Experiment, runs: Sequence[Run], first: int, seconds: float, submit: Callable[..., Future[list[Outcome]]]
) -> Iterator[tuple[int, Outcome]]:
    """The outcomes of all runs from one on, by an executor."""
    size = batch_size(len(runs) - first, seconds)
    futures: dict[Future[list[Outcome]], int] = {}
    try:
        for place in range(first, len(runs), size):
            futures[submit(batch, experiment, runs[place : place + size])] = place
        for future in as_completed(futures):
            yield from enumerate(future.result(), futures[future])
    finally:
        for each in futures:
            each.cancel()


def batch_size(runs: int, seconds: float) -> int:
    """How many runs a batch holds, given how many there are and how long one takes.

    >>> batch_size(400, 0.0026), batch_size(100_000, 0.0026), batch_size(400, 1.0)
    (25, 97, 1)
    """
    return max(1, min(ceil(BATCH_SECONDS / max(seconds, 1e-6)), ceil(runs / FEWEST_BATCHES)))
