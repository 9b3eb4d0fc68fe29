"""Nothing that a person types is run as code, in a model, a box, an answer or a file."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import lsys_kit
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read, read_expression, read_number, read_word

PACKAGE = Path(lsys_kit.__file__).parent
RUN_CODE = frozenset(
    (
        "eval",
        "exec",
        "compile",
        "__import__",
        "literal_eval",
        "sympify",
        "S",
        "parse_expr",
        "parse_latex",
        "parse_mathematica",
        "lambdify",
        "lambdastr",
        "autowrap",
        "ufuncify",
        "pickle",
        "allow_pickle",
        "read_pickle",
        "marshal",
        "shelve",
        "dill",
        "cloudpickle",
        "joblib",
        "runpy",
        "code",
        "codeop",
        "os.system",
        "os.popen",
        "subprocess",
        "yaml",
    )
)
"""Functions that run a text, and modules made for that; `re.compile` is another thing."""
HARMLESS = frozenset(("re.compile",))


def names_used(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """The functions called, keywords given and modules imported in a syntax tree, each with its line."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            called = ast.unparse(node.func)
            yield called, node.lineno
            if called not in HARMLESS:
                yield called.split(".")[-1], node.lineno
            yield from ((keyword.arg or "", node.lineno) for keyword in node.keywords)
        elif isinstance(node, ast.Import):
            yield from ((alias.name.split(".")[0], node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield (node.module or "").split(".")[0], node.lineno
            yield from ((alias.name, node.lineno) for alias in node.names)


@pytest.mark.parametrize("path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_no_file_of_the_package_runs_text(path: Path) -> None:
    found = [(name, line) for name, line in names_used(ast.parse(path.read_text(encoding="utf-8"))) if name in RUN_CODE]
    assert found == []


@pytest.mark.parametrize(
    "line",
    [
        "eval('1')",
        "sympy.sympify(text)",
        "from sympy import lambdify",
        "import pickle",
        "x = compile(a, b, c)",
        "sp.parse_expr(s)",
        "np.load(f, allow_pickle=True)",
        "from pickle import loads",
        "__import__('os')",
        "os.popen('ls')",
        "f(x).exec(y)",
    ],
)
def test_the_scan_sees(line: str) -> None:
    assert {name for name, _ in names_used(ast.parse(line))} & RUN_CODE


def test_the_scan_knows_what_is_harmless() -> None:
    assert not {name for name, _ in names_used(ast.parse("re.compile('x'); f.evaluate(); x.evalf()"))} & RUN_CODE


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
