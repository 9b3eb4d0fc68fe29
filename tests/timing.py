"""How long something takes that must not take long, told so that no other test and no busy machine has a part in it."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from lsys_kit.budget import processor_time


@dataclass
class Spent:
    """What a block took."""

    seconds: float = 0.0


@contextmanager
def spent() -> Iterator[Spent]:
    """The processor's time that this thread spends in a block, without a collection of what other tests have left.

    >>> with spent() as time:
    ...     number = 2**1000
    >>> time.seconds < 1
    True
    """
    taken, started = Spent(), processor_time()
    gc.disable()
    try:
        yield taken
    finally:
        taken.seconds = processor_time() - started
        gc.enable()
