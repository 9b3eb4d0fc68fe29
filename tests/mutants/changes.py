"""What may be changed in a file of Python or JavaScript, and what it is changed to."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

ROOT = Path(__file__).parent.parent.parent


@dataclass(frozen=True)
class Change:
    """What stands in a function of a file, and what is to stand there instead."""

    file: str
    where: str
    """The function in which it is."""
    old: str
    new: str
    nth: int
    """How many changes of this kind come before it in the function."""


@dataclass(frozen=True)
class Site:
    """Where a change is: the characters of a script, or an expression among those of a file and one of its changes."""

    line: int
    at: int
    end: int
    text: str = ""


_OTHER: Mapping[type[ast.AST], type[ast.AST]] = MappingProxyType(
    {
        ast.Eq: ast.NotEq,
        ast.NotEq: ast.Eq,
        ast.Lt: ast.LtE,
        ast.LtE: ast.Lt,
        ast.Gt: ast.GtE,
        ast.GtE: ast.Gt,
        ast.Is: ast.IsNot,
        ast.IsNot: ast.Is,
        ast.In: ast.NotIn,
        ast.NotIn: ast.In,
        ast.Add: ast.Sub,
        ast.Sub: ast.Add,
        ast.Mult: ast.Div,
        ast.Div: ast.Mult,
        ast.FloorDiv: ast.Mult,
        ast.Mod: ast.Mult,
        ast.Pow: ast.Mult,
        ast.BitOr: ast.BitAnd,
        ast.BitAnd: ast.BitOr,
        ast.And: ast.Or,
        ast.Or: ast.And,
    }
)


@cache
def changes(file: str) -> dict[Change, Site]:
    """Every change of a file, in order."""
    text = (ROOT / file).read_text("utf-8")
    seen: Counter[tuple[str, str, str]] = Counter()
    found = {}
    for where, old, new, site in (in_python if file.endswith(".py") else in_script)(text):
        found[Change(file, where, old, new, seen[where, old, new])] = site
        seen[where, old, new] += 1
    return found


def in_python(text: str) -> Iterator[tuple[str, str, str, Site]]:
    """Of each change of a text: in which function it is, what it makes of what, and where."""
    for at, (where, node, condition) in enumerate(expressions(ast.parse(text))):
        for which, new in enumerate(changed(node, condition)):
            yield where, ast.unparse(node), ast.unparse(new), Site(node.lineno, at, which)


def expressions(tree: ast.AST, where: str = "") -> Iterator[tuple[str, ast.expr, bool]]:
    """The expressions in the bodies of functions: in which function, and whether one is a condition. Left out are types,
    decorators, defaults, patterns, what is said of a mistake, and what a module makes while it is imported."""
    conditions = _conditions(tree)
    for node in _inside(tree):
        name = f"{where}.{node.name}".lstrip(".") if isinstance(node, _NAMED) else where
        if isinstance(node, ast.expr) and where:
            yield where, node, any(node is each for each in conditions)
        if isinstance(node, _NAMED) or where:
            yield from expressions(node, name)


_NAMED = (ast.FunctionDef, ast.ClassDef)
_LEFT_OUT = (ast.Raise, ast.pattern, ast.JoinedStr)


def _inside(tree: ast.AST) -> list[ast.AST]:
    """What stands directly in a part of a program, as far as it may be changed."""
    inside: list[ast.AST]
    match tree:
        case ast.ClassDef(body=body):
            inside = [each for each in body if isinstance(each, _NAMED)]
        case ast.FunctionDef(body=body):
            inside = list(body)
        case ast.AnnAssign(value=value):
            inside = [value] if value else []
        case _:
            inside = list(ast.iter_child_nodes(tree))
    return [each for each in inside if not isinstance(each, _LEFT_OUT)]


def _conditions(node: ast.AST) -> list[ast.expr]:
    match node:
        case ast.If(test=test) | ast.IfExp(test=test) | ast.While(test=test) | ast.Assert(test=test):
            return [test]
        case ast.comprehension(ifs=ifs):
            return ifs
    return []


def changed(node: ast.expr, condition: bool) -> list[ast.expr]:
    """What may stand instead of an expression."""
    match node:
        case ast.Compare(left, operators, right):
            return [
                ast.Compare(left, [*operators[:at], _other(each), *operators[at + 1 :]], right)
                for at, each in enumerate(operators)
            ]
        case ast.BinOp(left, operator, right) if type(operator) in _OTHER and not any(map(_is_text, (left, right))):
            return [ast.BinOp(left, _other(operator), right)]
        case ast.BoolOp(operator, values):
            return [ast.BoolOp(_other(operator), values)]
        case ast.UnaryOp(ast.Not(), operand):
            return [operand]
        case ast.Constant(bool(value)):
            return [ast.Constant(not value)]
        case ast.Constant(int(value) | float(value)):
            return [ast.Constant(value + 1)]
    return [ast.UnaryOp(ast.Not(), node)] if condition else []


def _other(operator: ast.AST) -> Any:
    return _OTHER[type(operator)]()


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


_WORDS_OF_A_SCRIPT = re.compile(
    r"//[^\n]*|/\*.*?\*/|`(?:\\.|[^`\\])*`|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'"
    r"|(?<=[(,=:?!&|\[] )/(?![/*])(?:\\.|\[[^\]\n]*\]|[^/\\\n])+/\w*|(?<=[(,\[])/(?![/*])(?:\\.|\[[^\]\n]*\]|[^/\\\n])+/\w*",
    re.DOTALL,
)
"""Comments, texts and patterns."""
_IN_A_SCRIPT = re.compile(
    r"(?<= )(?:[!=]==|[<>]=?|[-+*/]|&&|\|\|)(?= )|(?<![\w.$#])\d+(?:\.\d+)?(?![\w.])|\bif (?P<condition>\()"
)
_OTHER_IN_A_SCRIPT = MappingProxyType(
    {
        "===": "!==",
        "!==": "===",
        "<": "<=",
        "<=": "<",
        ">": ">=",
        ">=": ">",
        "+": "-",
        "-": "+",
        "*": "/",
        "/": "*",
        "&&": "||",
        "||": "&&",
    }
)
_FUNCTION = re.compile(r"^ *(?:export )?(?:async )?(?:function\*? |const |(?=\w+\(.*\{$))(\w+)", re.MULTILINE)


def in_script(text: str) -> Iterator[tuple[str, str, str, Site]]:
    """The same of a script: the whole line before and after."""
    code = _WORDS_OF_A_SCRIPT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    functions = [(each.start(), each[1]) for each in _FUNCTION.finditer(code)]
    for found in _IN_A_SCRIPT.finditer(code):
        at, end = found.span()
        if found["condition"]:
            end = _closing(code, at + 3) + 1
            new = f"if (!{text[at + 3 : end]})"
        else:
            new = _OTHER_IN_A_SCRIPT.get(found[0]) or str(float(found[0]) + 1).removesuffix(".0")
        begin, stop = text.rfind("\n", 0, at) + 1, text.find("\n", end)
        where = max((each for each in functions if each[0] < at), default=(0, ""))[1]
        old = text[begin:stop].strip()
        yield where, old, f"{text[begin:at]}{new}{text[end:stop]}".strip(), Site(text.count("\n", 0, at) + 1, at, end, new)


def _closing(code: str, at: int) -> int:
    """The bracket that closes the one at a place."""
    depth = 0
    for index, letter in enumerate(code[at:], at):
        depth += (letter == "(") - (letter == ")")
        if not depth:
            return index
    raise ValueError(f"No bracket closes the one at {at}.")
