"""The tests while one change is on from the beginning: `python -m tests.mutants.alone FILE` with what pytest is asked."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.mutants.__main__ import taken
from tests.mutants.schemata import Switches

if __name__ == "__main__":
    change = next(iter(taken(Path(sys.argv[1]))))
    Switches([change]).turn_on(change)
    sys.exit(pytest.main(sys.argv[2:]))
