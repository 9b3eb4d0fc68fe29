"""Nothing exhausts the machine: every public way has a row in the table, and a share of the table is measured."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from time import process_time

import pytest

from tests.fuzzing.acts import GROUPS, LEFT_OUT
from tests.fuzzing.bombs import broken, outcome
from tests.fuzzing.public_ways import public_ways

linux = pytest.mark.skipif(sys.platform != "linux", reason="a process is measured as on Linux")


def test_every_public_way_has_a_row(tmp_path: Path) -> None:
    rows = {way for _, _, acts in GROUPS for way in acts(tmp_path)}
    tried = rows | {way.partition(":")[0] for way in rows}
    assert public_ways() - tried - LEFT_OUT.keys() == set()
    assert LEFT_OUT.keys() - public_ways() == set(), "what is left out is a public way"
    assert LEFT_OUT.keys() & tried == set(), "and has no row"


def test_no_two_bombs_have_one_name() -> None:
    names = [name for bombs, _, _ in GROUPS for name in bombs]
    assert len({*names}) == len(names)


def _at_work_for_two_seconds(_: object) -> None:
    started = process_time()
    while process_time() < started + 2:
        pass


@pytest.mark.slow
@linux
def test_what_breaks_a_limit_is_found() -> None:
    """What works, allocates and recurses without end is measured as what it is."""
    assert not [*broken(outcome((lambda _: [],), 0.2, 100), 0.2, 100)]
    assert [*broken(outcome((_at_work_for_two_seconds,), 0.2, 100), 0.2, 100)]
    assert [*broken(outcome((lambda _: len(b"a" * 400 * 2**20),), 1, 100), 1, 100)]
    assert [*broken(outcome((lambda _: bytearray(2**40),), 1, 100), 1, 100)]


@linux
@pytest.mark.slow
def test_a_share_of_the_table_keeps_to_its_limits() -> None:
    run = subprocess.run(
        [sys.executable, "-m", "tests.fuzzing.bombs", "--rows", "150", "0.1", "200"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (run.returncode, run.stderr) == (0, "")
    assert "in 0.1 seconds" in run.stdout


@pytest.mark.slow
def test_calls_at_random_are_answered_or_refused() -> None:
    from tests.fuzzing.public import run

    assert run(calls=60, seed=1) is None
