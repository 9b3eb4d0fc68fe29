"""No model exhausts the machine, whatever is asked of it: each part that can repeat, grow or nest, by each public function."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.fuzzing.acts import acts, map_acts
from tests.fuzzing.models import BOMBS, MAPS

SHARES = 4
"""The models are tried in so many processes."""
MODELS = [*BOMBS, *MAPS]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="the memory of a process is limited as on Linux")
@pytest.mark.parametrize("share", range(SHARES))
def test_what_has_no_end_is_refused_in_time_and_within_its_memory(share: int) -> None:
    command = [sys.executable, "-m", "tests.fuzzing.bombs", "0.02", "200", *MODELS[share::SHARES]]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    assert "in 0.02 seconds" in run.stdout


def test_no_two_models_and_no_model_and_row_of_calls_have_one_name() -> None:
    names = [*MODELS, *{*acts(Path()), *map_acts(Path())}]
    assert len({*names}) == len(names)


def test_calls_at_random_are_answered_or_refused() -> None:
    from tests.fuzzing.public import run

    assert run(calls=60, seed=1) is None
