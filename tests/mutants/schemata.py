"""Changes that are compiled into the code, or read into a script, and done while they are on."""

from __future__ import annotations

import ast
import builtins
import copy
import functools
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from tests.mutants.changes import ROOT, Change, changed, changes, expressions

_SWITCH = "__is_on__"
_LRU_CACHE = functools.lru_cache


class Switches:
    """Which change is on, and which ones the code has come to.

    Parameters
    ----------
    chosen
        The changes: those in Python are compiled into what is imported from now on.
    """

    def __init__(self, chosen: Iterable[Change]) -> None:
        self.on: Change | None = None
        self.reached: set[Change] = set()
        self._of_file: defaultdict[Path, list[Change]] = defaultdict(list)
        for change in chosen:
            self._of_file[ROOT / change.file].append(change)
        self._numbered = [change for each in self._of_file.values() for change in each]
        self._holding: set[Any] = set()
        setattr(builtins, _SWITCH, self._is_on)
        functools.lru_cache = self._watched_cache
        sys.meta_path.insert(0, _Finder(self._changed))

    def _is_on(self, number: int) -> bool:
        change = self._numbered[number]
        self.reached.add(change)
        return change == self.on

    def _changed(self, path: Path) -> CodeType | None:
        """The code of a file with its changes, if it has any."""
        if path not in self._of_file:
            return None
        sites, tree = changes(path.relative_to(ROOT).as_posix()), ast.parse(path.read_text("utf-8"))
        every = list(expressions(tree))
        wanted: defaultdict[int, list[tuple[int, int]]] = defaultdict(list)
        for change in self._of_file[path]:
            wanted[id(every[sites[change].at][1])].append((sites[change].end, self._numbered.index(change)))
        conditions = {id(node) for _, node, condition in every if condition}
        _Schemata(wanted, conditions).visit(tree)
        return compile(ast.fix_missing_locations(tree), str(path), "exec", dont_inherit=True)

    def _watched_cache(self, maxsize: Any = 128, typed: bool = False) -> Any:
        """`functools.lru_cache`, but for functions of the kit, which are known when they have come to a change."""
        if callable(maxsize):
            return self._watched_cache()(maxsize)
        made = _LRU_CACHE(maxsize, typed)
        return lambda function: self._watched(function, made) if function.__module__.startswith("lsys_kit") else made(function)

    def _watched(self, function: Callable[..., Any], made: Callable[..., Any]) -> Any:
        @functools.wraps(function)
        def seen(*given: Any, **named: Any) -> Any:
            before, self.reached = self.reached, set()
            try:
                return function(*given, **named)
            finally:
                if self.reached:
                    self._holding.add(cached)
                self.reached |= before

        cached = made(seen)
        return cached

    def forget(self) -> None:
        """Empty the caches of what was made with any change, and begin to note anew which ones the code comes to."""
        for cached in self._holding:
            cached.cache_clear()
        self._holding.clear()
        self.reached = set()

    def turn_on(self, change: Change) -> None:
        """Do a change; of a script, in all that is read from now on."""
        self.on = change
        if change.file.endswith(".js"):
            _change_script(change)


class _Schemata(ast.NodeTransformer):
    """Puts both forms of an expression into a program, and a switch between them."""

    def __init__(self, wanted: Mapping[int, Sequence[tuple[int, int]]], conditions: set[int]) -> None:
        self._wanted, self._conditions = wanted, conditions

    def visit(self, node: ast.AST) -> ast.AST:
        seen, condition = self._wanted.get(id(node), ()), id(node) in self._conditions
        made = self.generic_visit(node)
        if not isinstance(made, ast.expr):
            return made
        others = changed(made, condition)
        for which, number in seen:
            switch = ast.Call(ast.Name(_SWITCH, ast.Load()), [ast.Constant(number)], [])
            made = ast.copy_location(ast.IfExp(switch, copy.deepcopy(others[which]), made), node)
        return made


class _Finder(MetaPathFinder):
    """Finds the files that are changed before others do."""

    def __init__(self, changed_code: Callable[[Path], CodeType | None]) -> None:
        self._changed = changed_code

    def find_spec(self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None) -> ModuleSpec | None:
        spec = PathFinder.find_spec(name, path, target) if name.startswith("lsys_kit.") else None
        code = self._changed(Path(spec.origin)) if spec and spec.origin else None
        if spec and spec.origin and code:
            spec.loader = _Loader(name, spec.origin, code)
            return spec
        return None


class _Loader(SourceFileLoader):
    """Loads code that is compiled already."""

    def __init__(self, name: str, path: str, code: CodeType) -> None:
        super().__init__(name, path)
        self._code = code

    def get_code(self, fullname: str) -> CodeType:
        return self._code


def _change_script(change: Change) -> None:
    site, read, script = changes(change.file)[change], Path.read_text, ROOT / change.file

    def changed_text(path: Path, *arguments: object, **options: object) -> str:
        text: str = read(path, *arguments, **options)  # type: ignore[arg-type]
        return f"{text[: site.at]}{site.text}{text[site.end :]}" if path == script else text

    Path.read_text = changed_text  # type: ignore[assignment,method-assign]
