"""No model exhausts the machine, whatever is asked of it: each part that can repeat, grow or nest, by each public function."""

from __future__ import annotations

import subprocess
import sys

import pytest


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the memory of a process is limited as on Linux")
def test_what_has_no_end_is_refused_in_time_and_within_its_memory() -> None:
    command = [sys.executable, "-m", "tests.fuzzing.bombs", "0.05", "200"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    assert "was not reached in 0.05 seconds" in run.stdout
    assert "MemoryError" not in run.stdout


def test_calls_at_random_are_answered_or_refused() -> None:
    from tests.fuzzing.public import run

    assert run(calls=60, seed=1) is None
