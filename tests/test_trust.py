"""Nothing that a person types is run as code, in a model, a box, an answer or a file."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest

import lsys_kit
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read, read_expression, read_number, read_word

PACKAGE = Path(lsys_kit.__file__).parent
RUN_CODE = frozenset(("eval", "exec", "compile", "__import__", "sympify", "parse_expr", "lambdify", "allow_pickle"))
"""What the linter does not see where it is a method, a builtin or a keyword; `re.compile` is another thing."""


def names_used(tree: ast.AST) -> set[str]:
    """The functions called and the keywords given in a syntax tree."""
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and ast.unparse(node.func) != "re.compile"]
    keywords = {keyword.arg or "" for call in calls for keyword in call.keywords}
    return keywords | {ast.unparse(call.func).split(".")[-1] for call in calls}


@pytest.mark.slow
def test_no_file_of_the_package_runs_text() -> None:
    """The linter bans modules and functions that are made for that (`banned-api` in pyproject.toml)."""
    used = {path: names_used(ast.parse(path.read_text(encoding="utf-8"))) & RUN_CODE for path in PACKAGE.rglob("*.py")}
    assert {path: names for path, names in used.items() if names} == {}


def linted(text: str, file: str) -> list[int]:
    """The lines of a text that the linter refuses in a file, for what they import or call."""
    command = [
        sys.executable,
        "-m",
        "ruff",
        "check",
        "--select",
        "TID251,S",
        "--output-format",
        "json",
        "--stdin-filename",
        file,
    ]
    done = subprocess.run([*command, "-"], input=text, capture_output=True, text=True, check=False, cwd=PACKAGE.parent)
    return sorted({found["location"]["row"] for found in json.loads(done.stdout)})


def test_the_linter_sees_what_runs_text() -> None:
    lines = [
        "import sympy, re, os",
        "eval('1')",
        "sympy.sympify(text)",
        "from sympy import lambdify",
        "import pickle",
        "from pickle import loads",
        "os.popen('ls')",
        "re.compile('x')",
        "sympy.Symbol('x').evalf()",
    ]
    assert linted("\n".join(lines), "lsys_kit/any.py") == [2, 3, 4, 5, 6, 7]


def test_the_linter_sees_a_clock_on_the_wall_in_a_test() -> None:
    """No law depends on how fast the machine is, nor on what else the process does."""
    text = "import time\nfrom time import perf_counter as p, thread_time as q\ntime.monotonic()\np()\nq()\ntime.process_time()"
    assert linted(text, "tests/derivation/test_any.py") == [2, 3, 6]
    assert linted(text, "tests/browser/test_any.py") == []


@pytest.mark.parametrize("line", ["x = compile(a, b, c)", "np.load(f, allow_pickle=True)", "__import__('os')", "f(x).exec(y)"])
def test_the_scan_sees(line: str) -> None:
    assert names_used(ast.parse(line)) & RUN_CODE


def test_the_scan_knows_what_is_harmless() -> None:
    assert not names_used(ast.parse("re.compile('x'); f.evaluate(); x.evalf()")) & RUN_CODE


HOSTILE = [
    "__import__('os').system('touch {0}')",
    "().__class__.__base__.__subclasses__()",
    "open('{0}','w')",
    "exec(\"open('{0}','w')\")",
    "eval('1')",
    "lambda: 0",
    "[x for x in (1,)]",
    "f'{{1}}'",
    "`touch {0}`",
    "$(touch {0})",
    "os.system('x')",
    "getattr(1,'real')",
    "__class__",
    "t.__class__",
    "t.real",
    "Symbol('x')",
    "S('__import__')",
    "Function('f')(1)",
    "sqrt.__globals__",
    "{{'a': 1}}",
    "@x",
    "1; import os",
    "1 if True else 2",
    "not None",
    "True",
    "None",
    "print(1)",
    "globals()",
    "breakpoint()",
    "exit()",
    "\\x41",
    "a := 1",
]


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_is_text(text: str, tmp_path: Path) -> None:
    """It is refused, or a name like any other; in no case does anything happen."""
    target = tmp_path / "made"
    text = text.format(target)
    for attempt in (
        lambda: read_expression(text),
        lambda: read_number(text),
        lambda: read_word(text),
        lambda: str(derive(read(f"axiom: A(1)\nA(t) -> A({text})"), 2)[-1]),
        lambda: str(derive(read(f"axiom: A(1)\nA(t) : {text} -> B"), 2)[-1]),
        lambda: str(derive(read(f"c = {text}\naxiom: A(c)"), 2)[-1]),
        lambda: str(derive(read(f"axiom: {text}\n{text} -> {text}"), 2)[-1]),
        lambda: derive(read("c = 1\naxiom: A(c)"), 2, c=text),
        lambda: derive(read("c = 1\naxiom: A(c)"), 2, **{text: 1}),
    ):
        try:
            attempt()
        except LSystemError as error:
            said = str(error)
            assert "Traceback" not in said
    assert not target.exists()
