"""A lesson as it is written: its declaration, the cells of its notebook, and what they call."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.lesson import Lesson, declared_in
from lsys_kit.classroom.places import Course, Place, key_of
from lsys_kit.classroom.site.build import read_notebook
from lsys_kit.translation import ENGLISH, languages, spoken

_FOLDED = re.compile(r"<details>.*?(?:</details>|\Z)", re.DOTALL)
_HEADING = re.compile(r"^## ++(?:(\d{1,3})\b)?.*$", re.MULTILINE)
_EMPHASIS = re.compile(r"\*{1,3}+(?=[^\s*])|(?<=[^\s*])\*{1,3}+|^ *+[*-] ", re.MULTILINE)
BLOT = "¤"
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

    @property
    def plain(self) -> str:
        """The same with what is folded, its emphasis taken away and code blotted out; as long as the source."""
        if self.is_code:
            return ""
        return without_marks(self.source)

    def line_of(self, part: str) -> int:
        """The line in which a part of it begins."""
        return self.source[: max(self.source.find(part), 0)].count("\n") + 1


def without_marks(text: str) -> str:
    """A text of the same length in which emphasis is blanks and code is blotted out.

    >>> without_marks("*q* = `a` 2")
    ' q  = ¤¤¤ 2'
    """
    blotted = _CODE.sub(lambda found: re.sub(r"[^\n]", BLOT, found[0]), text)
    return _EMPHASIS.sub(lambda found: " " * len(found[0]), blotted)


_NUMBERS = re.compile(r"(?<![\w.,])\d{1,3}(?>(?:,\d{3})+)(?![\d.])|(?<![\w.,])\d++(?:[./]\d++)?")
_SMALL = (
    "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen"
)
_TENS = "nineteen twenty thirty forty fifty sixty seventy eighty ninety hundred"
_WORDS = {word: number for number, word in enumerate(re.split(" ", _SMALL))}
_WORDS |= {word: 10 * number if number > 1 else 19 for number, word in enumerate(re.split(" ", _TENS), 1)}


def numbers_in(text: str) -> dict[str, Fraction]:
    """The numbers of a text, in digits or in words, by what is written.

    >>> {text: str(number) for text, number in numbers_in("step 8 has four; 3,125 or 1/2").items()}
    {'8': '8', '3,125': '3125', '1/2': '1/2', 'four': '4'}
    """
    digits = {each: number_of(each.replace(",", "")) for each in _NUMBERS.findall(text)}
    spelled = [each.split("-") for each in re.findall(r"[a-z]++(?:-[a-z]++)?", text.casefold())]
    words = {"-".join(each): Fraction(sum(_WORDS[part] for part in each)) for each in spelled if {*each} <= _WORDS.keys()}
    return {text: number for text, number in digits.items() if number is not None} | words


@dataclass(frozen=True)
class Section:
    """A section of a notebook: its number, if its heading has one, its texts with their cells, and its cells of code."""

    number: int | None
    texts: list[tuple[Cell, str]]
    code: list[Cell]

    @property
    def text(self) -> str:
        """All of its texts."""
        return "\n\n".join(text for _, text in self.texts)


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
    def language(self) -> str:
        """The code of the language in which it is written."""
        return self.lesson.language if self.lesson else ENGLISH

    def said(self, text: Callable[[], str]) -> str:
        """A text of the kit in its language; in English where the kit has it not."""
        with spoken(self.language if self.language in languages() else ENGLISH):
            return text()

    @property
    def declared_at(self) -> str:
        """The file of its declaration."""
        return f"{self.name}.toml"

    def declared_line(self, part: str) -> str:
        """The line of the declaration in which a text stands first."""
        found = self.declared_text.find(part)
        return self.declared_at + (f", line {self.declared_text[:found].count(chr(10)) + 1}" if part and found >= 0 else "")

    @cached_property
    def declared_text(self) -> str:
        """The file of its declaration, or nothing."""
        path = self.place.declared / f"{self.name}.toml"
        return path.read_text("utf-8", errors="replace") if path.is_file() else ""

    @cached_property
    def teacher(self) -> str:
        """The page for the teacher, or nothing."""
        path = self.place.notebooks / "teacher" / f"{self.name}.md"
        return path.read_text("utf-8", errors="replace") if path.is_file() else ""

    def teacher_at(self, part: str = "") -> str:
        """The page for the teacher, and the line in which a text stands first."""
        found = self.teacher.find(part) if part else -1
        return f"teacher/{self.name}.md" + (f", line {self.teacher[:found].count(chr(10)) + 1}" if found >= 0 else "")

    def teacher_part(self, title: str) -> str:
        """What stands below a heading of the teacher's page."""
        return f"\n{self.teacher}".partition(f"\n## {title}\n")[2].partition("\n## ")[0]

    @cached_property
    def sections(self) -> tuple[Section, ...]:
        """What stands before the first heading, and the sections."""
        found = [Section(None, [], [])]
        for cell in self.cells:
            if cell.is_code:
                found[-1].code.append(cell)
                continue
            start = 0
            for heading in _HEADING.finditer(cell.source):
                if cell.source[start : heading.start()].strip():
                    found[-1].texts.append((cell, cell.source[start : heading.start()]))
                start = heading.start()
                found.append(Section(int(heading[1]) if heading[1] else None, [], []))
            found[-1].texts.append((cell, cell.source[start:]))
        return tuple(found)

    @cached_property
    def no_python(self) -> tuple[tuple[Cell, SyntaxError], ...]:
        """The cells that are no Python."""
        return tuple((cell, fault) for cell, fault in self._parsed if isinstance(fault, SyntaxError))

    @cached_property
    def calls(self) -> tuple[Call, ...]:
        """The calls of functions of lessons, in their order."""
        return tuple(call for cell, tree in self.trees for call in _calls(cell, tree))

    @cached_property
    def _parsed(self) -> tuple[tuple[Cell, ast.Module | SyntaxError], ...]:
        return tuple(
            (cell, python_tree(cell.source)) for cell in self.cells if cell.is_code and not cell.source.startswith("%%")
        )

    @property
    def trees(self) -> Iterator[tuple[Cell, ast.Module]]:
        """The cells that are Python, parsed."""
        return ((cell, tree) for cell, tree in self._parsed if isinstance(tree, ast.Module))

    def question_of(self, call: Call) -> str | None:
        """What a call of `predict` asks, if that is a text, or a name that was given to one."""
        given = call.node.args[0] if call.node.args else None
        return self._named.get(given.id) if isinstance(given, ast.Name) else call.text(0)

    @cached_property
    def _named(self) -> dict[str, str]:
        return {
            target.id: node.value.value.strip()
            for _, tree in self.trees
            for node in ast.walk(tree)
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
            for target in node.targets
            if isinstance(target, ast.Name)
        }


def _cell(number: int, cell: Any) -> Cell:
    metadata = cell.metadata
    folded = bool(metadata.get("jupyter", {}).get("source_hidden"))
    return Cell(number, cell.cell_type == "code", cell.source, folded, "raises-exception" in metadata.get("tags", ()))


def python_tree(source: str) -> ast.Module | SyntaxError:
    """A cell of Python, parsed, lines for IPython left out; or why it is no Python."""
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
