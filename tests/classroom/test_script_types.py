"""The scripts of the panel have types: those that can be told from them, and what JSDoc says."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

CONFIGURATION = Path(__file__).parent.parent / "scripts.tsconfig.json"
TSC = shutil.which("tsc")


@pytest.mark.slow
@pytest.mark.skipif(TSC is None, reason="TypeScript is not installed: npm install -g typescript")
def test_the_types_of_the_scripts_fit() -> None:
    done = subprocess.run([str(TSC), "-p", str(CONFIGURATION)], capture_output=True, text=True, timeout=300)
    assert done.stdout == ""
