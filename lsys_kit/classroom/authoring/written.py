"""A lesson as it is written: its declaration, the cells of its notebook, and what they call."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from lsys_kit.classroom.lessons.lesson import Lesson, declared_in
from lsys_kit.classroom.places import Course, Place, key_of
from lsys_kit.classroom.site.build import read_notebook

_FOLDED = re.compile(r"<details>.*?(?:</details>|\Z)", re.DOTALL)
_CODE = re.compile(r"```.*?(?:```|\Z)|`[^`\n]*`", re.DOTALL)


@dataclass(frozen=True)
class Cell:
    """A cell, its number from 1 on, and whether its code is folded or its failing meant."""

    number: int
    is_code: bool
    source: str
    folded: bool = False
    may_fail: bool = False

    @property
    def seen(self) -> str:
        """What stands in a text before anything is opened."""
        return "" if self.is_code else _FOLDED.sub("", self.source)

    @property
    def prose(self) -> str:
        """The same without code."""
        return _CODE.sub(" ", self.seen)

    def line_of(self, part: str) -> int:
        """The line in which a part of it begins."""
        return self.source[: max(self.source.find(part), 0)].count("\n") + 1


@dataclass(frozen=True)
class Call:
    """A call of a function of lessons in a cell."""

    cell: Cell
    line: int
    function: str
    node: ast.Call

    def text(self, number: int) -> str | None:
        """An argument that is a text."""
        given = self.node.args[number] if number < len(self.node.args) else None
        return given.value.strip() if isinstance(given, ast.Constant) and isinstance(given.value, str) else None

    def has(self, name: str) -> bool:
        """Whether an argument of this name is given."""
        return any(each.arg == name for each in self.node.keywords)


FUNCTIONS = ("vote", "predict", "worksheet", "explore", "compare", "ask")


class Written:
    """A lesson of a course.

    Attributes
    ----------
    course, place, name, key
        Where it is, and what it is called.
    lesson
        What is declared of it, or None.
    cells
        The cells of its notebook.
    """

    def __init__(self, course: Course, place: Place, name: str) -> None:
        self.course, self.place, self.name, self.key = course, place, name, key_of(name)
        self.lesson: Lesson | None = declared_in(place, name)
        self.notebook = read_notebook(place.notebooks / f"{name}.ipynb")
        self.cells = tuple(map(_cell, range(1, len(self.notebook.cells) + 1), self.notebook.cells))

    def at(self, cell: Cell, line: int = 0) -> str:
        """Where a cell is, and a line in it."""
        return f"{self.name}.ipynb, cell {cell.number}" + f", line {line}" * bool(line)

    @property
    def declared_at(self) -> str:
        """The file of its declaration."""
        return f"{self.name}.toml"

    def declared_line(self, part: str) -> str:
        """The line of the declaration in which a text stands first."""
        text = (self.place.declared / f"{self.name}.toml").read_text("utf-8", errors="replace")
        found = text.find(part)
        return self.declared_at + (f", line {text[:found].count(chr(10)) + 1}" if part and found >= 0 else "")

    @cached_property
    def no_python(self) -> tuple[tuple[Cell, SyntaxError], ...]:
        """The cells that are no Python."""
        return tuple((cell, fault) for cell, fault in self._parsed if isinstance(fault, SyntaxError))

    @cached_property
    def calls(self) -> tuple[Call, ...]:
        """The calls of functions of lessons, in their order."""
        return tuple(call for cell, tree in self._parsed if isinstance(tree, ast.Module) for call in _calls(cell, tree))

    @cached_property
    def _parsed(self) -> tuple[tuple[Cell, ast.Module | SyntaxError], ...]:
        return tuple((cell, _tree(cell.source)) for cell in self.cells if cell.is_code and not cell.source.startswith("%%"))

    def question_of(self, call: Call) -> str | None:
        """What a call of `predict` asks, if that is a text, or a name that was given to one."""
        given = call.node.args[0] if call.node.args else None
        return self._named.get(given.id) if isinstance(given, ast.Name) else call.text(0)

    @cached_property
    def _named(self) -> dict[str, str]:
        trees = [tree for _, tree in self._parsed if isinstance(tree, ast.Module)]
        return {
            target.id: node.value.value.strip()
            for tree in trees
            for node in ast.walk(tree)
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
            for target in node.targets
            if isinstance(target, ast.Name)
        }


def _cell(number: int, cell: Any) -> Cell:
    metadata = cell.metadata
    folded = bool(metadata.get("jupyter", {}).get("source_hidden"))
    return Cell(number, cell.cell_type == "code", cell.source, folded, "raises-exception" in metadata.get("tags", ()))


def _tree(source: str) -> ast.Module | SyntaxError:
    plain = "\n".join("" if line.lstrip().startswith(("%", "!")) else line for line in source.split("\n"))
    try:
        return ast.parse(plain)
    except SyntaxError as fault:
        return fault
    except (ValueError, RecursionError, MemoryError) as fault:
        return SyntaxError(str(fault))


def _calls(cell: Cell, tree: ast.Module) -> Iterator[Call]:
    found = [node for node in ast.walk(tree) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)]
    for node in sorted(found, key=lambda node: (node.lineno, node.col_offset)):
        if isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
            yield Call(cell, node.lineno, node.func.id, node)
