"""Whatever is broken off at any line, by an interrupt or for want of memory, goes on as if nothing had happened."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from tests.faults.injection import FAULTS, break_off, forget, lines_of, moments_of
from tests.faults.scenarios import SCENARIOS, Scenario

MOST_MOMENTS = 30
"""So many lines are tried for each kind of work, beside those of functions that keep something."""
FEW_MOMENTS = 8
"""The same where the work takes long."""


def broken_off(scenario: Scenario, faults: Sequence[str], most: int) -> None:
    """Break work off at some lines, with one fault after the other, and go on each time."""
    expected = scenario.work(scenario.make())
    forget(scenario.rooms)
    whole = scenario.make()
    for number, moment in enumerate(moments_of(lines_of(lambda: scenario.work(whole), scenario.rooms), most)):
        forget(scenario.rooms)
        subject, fault = scenario.make(), FAULTS[faults[number % len(faults)]]
        break_off(lambda subject=subject: scenario.work(subject), scenario.rooms, moment, fault)
        assert scenario.work(subject) == expected, moment


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENARIOS)
def test_what_is_broken_off_goes_on(name: str) -> None:
    long = name.startswith(("panel", "picture", "mesh"))
    broken_off(SCENARIOS[name], ("interrupt", "no memory"), FEW_MOMENTS if long else MOST_MOMENTS)
