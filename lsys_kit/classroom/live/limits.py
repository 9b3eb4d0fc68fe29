"""How much, how often and how long: what phones are let do to a server of classes."""

from __future__ import annotations

import time

MOST_MESSAGE, MOST_ASKED = 16_000, 64_000
"""So many bytes at most a message of a phone has, and a question to the kit."""
MOST_PHONES = 2_000
"""So many phones take part in a class."""
PATIENCE = 15.0
"""Who has not read, or not said all, for so many seconds is dropped; the page of a phone comes back by itself."""


class Rate:
    """How often something may be done: so many times at once, and so many times a second in the long run."""

    def __init__(self, burst: float, second: float) -> None:
        self._burst, self._second = burst, second
        self._left, self._seen = burst, time.monotonic()

    def allows(self) -> bool:
        """Whether it may be done once more now."""
        now = time.monotonic()
        self._left = min(self._burst, self._left + (now - self._seen) * self._second)
        self._seen = now
        if self._left < 1:
            return False
        self._left -= 1
        return True

    @property
    def is_full(self) -> bool:
        """Whether it is as if nothing had been done for long."""
        return self._left + (time.monotonic() - self._seen) * self._second >= self._burst


class Rates:
    """The rates of many, by their names; those that have done nothing for long are forgotten."""

    def __init__(self, burst: float, second: float) -> None:
        self._limits, self._of = (burst, second), dict[str, Rate]()

    def allow(self, name: str) -> bool:
        """Whether one of them may do it once more now."""
        if len(self._of) > MOST_PHONES:
            self._of = {each: rate for each, rate in self._of.items() if not rate.is_full}
        return self._of.setdefault(name, Rate(*self._limits)).allows()
