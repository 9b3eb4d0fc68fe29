"""Faults between any two lines of the kit: some work is begun, and where it comes to a chosen line, an error is raised."""

from __future__ import annotations

import ast
import errno
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
from itertools import count
from pathlib import Path
from types import FrameType, MappingProxyType
from typing import Any, TypeAlias

import lsys_kit

PACKAGE = Path(lsys_kit.__file__).parent
Line: TypeAlias = tuple[str, int]
"""A file and the number of a line in it."""
Work: TypeAlias = Callable[[], object]

FAULTS: Mapping[str, Callable[[], BaseException]] = MappingProxyType(
    {
        "interrupt": KeyboardInterrupt,
        "no memory": MemoryError,
        "full disk": lambda: OSError(errno.ENOSPC, "No space left on device"),
    }
)


def lines_of(work: Work, rooms: Sequence[str]) -> list[Line]:
    """The lines of some folders and files of the package, in the order in which some work comes to them."""
    found: list[Line] = []
    with _watched(rooms, lambda frame: found.append((frame.f_code.co_filename, frame.f_lineno))):
        work()
    return found


def bytecodes_of(work: Work, rooms: Sequence[str]) -> dict[object, int]:
    """The bytecodes of some folders and files of the package that some work comes to, with the moments of the first time."""
    first: dict[object, int] = {}
    moments = count()
    with _watched(rooms, lambda frame: first.setdefault((frame.f_code, frame.f_lasti), next(moments)), "opcode"):
        work()
    return first


def break_off(
    work: Work, rooms: Sequence[str], moment: int, fault: Callable[[], BaseException], before: str = "line"
) -> BaseException | None:
    """Do some work, and raise an error before the line, or the "opcode", that it comes to at a moment, counted from 0. What has
    come out of it."""
    left = moment

    def strike(_: FrameType) -> None:
        nonlocal left
        left -= 1
        if left == -1:
            raise fault()

    try:
        with _watched(rooms, strike, before):
            work()
    except (KeyboardInterrupt, Exception) as error:
        assert left < 0, "the work fails by itself"
        return error
    return None


def moments_of(lines: Sequence[Line], most: int) -> list[int]:
    """Moments at lines, each reached first, somewhere between, or last: at all lines of functions that keep something, and at
    up to so many others."""
    reached: dict[Line, list[int]] = {}
    for moment, line in enumerate(lines):
        reached.setdefault(line, []).append(moment)
    keeping = [line for line in reached if line[1] in _keeping_lines(line[0])]
    others = [line for line in reached if line[1] not in _keeping_lines(line[0])]
    chosen = keeping + others[:: -(-len(others) // most) or 1]
    return sorted({found[number % 3 * (len(found) - 1) // 2] for number, found in enumerate(map(reached.__getitem__, chosen))})


@cache
def _keeping_lines(file: str) -> frozenset[int]:
    """The lines of the functions in a file that change an attribute of their object, or something that it holds."""
    nodes = ast.walk(ast.parse(Path(file).read_text(encoding="utf-8")))
    functions = [node for node in nodes if isinstance(node, ast.FunctionDef)]
    return frozenset(
        line
        for function in functions
        if function.name != "__init__" and any(map(_keeps, ast.walk(function)))
        for line in range(function.lineno, (function.end_lineno or 0) + 1)
    )


def _keeps(node: ast.AST) -> bool:
    if isinstance(node, ast.Attribute | ast.Subscript) and isinstance(node.ctx, ast.Store):
        return ast.unparse(node).startswith("self")
    return (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and ast.unparse(node.func).startswith("self")
        and node.func.attr in ("append", "add", "setdefault", "extend", "update")
    )


def forget(rooms: Sequence[str]) -> None:
    """Empty what functions of some folders and files of the package remember."""
    for name, module in [*sys.modules.items()]:
        if name.startswith("lsys_kit.") and _within(module.__file__ or "", rooms):
            for found in vars(module).values():
                if getattr(found, "__module__", None) == name and hasattr(found, "cache_clear"):
                    found.cache_clear()


def _within(file: str, rooms: Sequence[str]) -> bool:
    return file.startswith(tuple(str(PACKAGE / room) for room in rooms))


@contextmanager
def _watched(rooms: Sequence[str], at_moment: Callable[[FrameType], object], before: str = "line") -> Iterator[None]:
    """Call a function before each line, or before each "opcode", of some folders and files of the package."""
    tracer = sys.gettrace()
    known: dict[str, bool] = {}

    def in_frame(frame: FrameType, event: str, _: Any) -> Any:
        if event == before:
            at_moment(frame)
        return in_frame

    def called(frame: FrameType, event: str, _: Any) -> Any:
        file = frame.f_code.co_filename
        if file not in known:
            known[file] = _within(file, rooms)
        frame.f_trace_opcodes = known[file] and before == "opcode"
        return in_frame if known[file] else None

    sys.settrace(called)
    try:
        yield
    finally:
        sys.settrace(tracer)
