"""What errors say, found in the places where they are raised.

The first argument and the hint of each call of a class of errors are texts with values in them: constants, f-strings, what is
chosen by a condition, what a name of the function or the module stands for, what another function returns. A function that
hands a parameter of its own on to an error is called with such a text, too. Each text becomes a form, with the names of its
values in braces.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

FIRST_ERROR = "LSystemError"
LEAST_LETTERS = 5
"""So many letters of its own has a form with values: one with fewer would be found in other texts."""
MOST_FORMS = 64
"""So many forms one text may have, by its conditions; of more the parts are taken alone."""
_CALLED = {"shown", "quotable", "named", "str", "len", "repr", "sorted", "min", "max", "next", "iter", "number_text"}
"""Functions whose value has the name of what they are given."""
_TRANSLATING = {"gettext", "ngettext", "reply"}
"""Functions whose texts are translated already."""
_STRIPPED = {"strip", "rstrip", "lstrip", "removesuffix", "removeprefix"}


@dataclass(frozen=True)
class Value:
    """A value in a text, by its name."""

    name: str


Part = str | Value
Form = tuple[Part, ...]


@dataclass
class _Function:
    """A function, with the module that it is in, the parameters that reach an error, and the texts that are given for these."""

    node: ast.FunctionDef
    module: _Module
    reaching: set[str] = field(default_factory=set)

    @property
    def parameters(self) -> list[str]:
        arguments = self.node.args
        return [each.arg for each in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]

    @property
    def is_method(self) -> bool:
        return self.parameters[:1] in (["self"], ["cls"])


@dataclass
class _Module:
    path: Path
    tree: ast.Module
    constants: dict[str, ast.expr] = field(default_factory=dict)
    owners: dict[int, list[ast.FunctionDef]] = field(default_factory=dict)
    """For each call the functions that it stands in, the innermost last."""


def forms_of_errors(package: Path) -> Iterator[tuple[str, Path]]:
    """The form of each text that an error of a package may say, and the file that it stands in.

    >>> [*forms_of_errors(Path(__file__).parent / "no_such_folder")]
    []
    """
    modules = [_module(path) for path in sorted(package.rglob("*.py"))]
    errors = _errors(modules)
    functions: dict[str, list[_Function]] = {}
    for module in modules:
        for node in ast.walk(module.tree):
            if isinstance(node, ast.FunctionDef):
                functions.setdefault(node.name, []).append(_Function(node, module))
    found: dict[tuple[str, Path], None] = {}
    while True:
        before = sum(len(each.reaching) for several in functions.values() for each in several)
        for module in modules:
            for form in _Said(module, errors, functions).forms():
                if has_words(form):
                    found[form_text(form), module.path] = None
        if before == sum(len(each.reaching) for several in functions.values() for each in several):
            yield from found
            return


def has_words(form: Form) -> bool:
    """Whether a form has words of its own, and not the values alone; a single small word is a name, which is not translated."""
    if len(form) == 1 and isinstance(form[0], str):
        return bool(re.match(r"[A-Z][a-z]+$|.*\s", form[0]))
    return sum(len(re.findall(r"[^\W\d_]", part)) for part in form if isinstance(part, str)) >= LEAST_LETTERS


def form_text(form: Form) -> str:
    """A form as a text with the names of its values in braces, each name once."""
    names: dict[str, int] = {}
    text = ""
    for part in form:
        if isinstance(part, str):
            text += part.replace("{", "{{").replace("}", "}}")
        else:
            names[part.name] = names.get(part.name, 0) + 1
            text += f"{{{part.name}{names[part.name] if names[part.name] > 1 else ''}}}"
    return text


def _module(path: Path) -> _Module:
    module = _Module(path, ast.parse(path.read_text(encoding="utf-8")))
    for node in module.tree.body:
        if isinstance(node, ast.Assign):
            module.constants |= {target.id: node.value for target in node.targets if isinstance(target, ast.Name)}
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value is not None:
            module.constants[node.target.id] = node.value

    def mark(node: ast.AST, owners: list[ast.FunctionDef]) -> None:
        if isinstance(node, ast.FunctionDef):
            owners = [*owners, node]
        if isinstance(node, ast.Call):
            module.owners[id(node)] = owners
        for child in ast.iter_child_nodes(node):
            mark(child, owners)

    mark(module.tree, [])
    return module


def _errors(modules: Sequence[_Module]) -> set[str]:
    """The names of the classes of errors."""
    found = {FIRST_ERROR}
    classes = [node for module in modules for node in ast.walk(module.tree) if isinstance(node, ast.ClassDef)]
    while (
        more := {each.name for each in classes if any(isinstance(base, ast.Name) and base.id in found for base in each.bases)}
        - found
    ):
        found |= more
    return found


@dataclass
class _Said:
    """What is said in one module."""

    module: _Module
    errors: set[str]
    functions: Mapping[str, list[_Function]]

    def forms(self) -> Iterator[Form]:
        for call in _inside(self.module.tree, ast.Call):
            for given in self._texts_given(call):
                yield from _Reading(self, self.module.owners[id(call)]).forms(given)

    def _texts_given(self, call: ast.Call) -> Iterator[ast.expr]:
        """The arguments of a call that reach an error."""
        name = getattr(call.func, "id", "") or getattr(call.func, "attr", "")
        if name in self.errors:
            yield from call.args[:1]
            yield from (keyword.value for keyword in call.keywords if keyword.arg in ("message", "hint"))
            yield from call.args[4:5] if name != "ModelLimitError" else ()
        elif name in ("with_hint", "Task"):
            yield from call.args[:1]
        for function in self.called(name, call):
            places = function.parameters[function.is_method :]
            for parameter, given in [
                *zip(places, call.args, strict=False),
                *((each.arg, each.value) for each in call.keywords if each.arg),
            ]:
                if parameter in function.reaching:
                    yield given

    def called(self, name: str, call: ast.Call) -> list[_Function]:
        """The functions that a name may stand for: those of the module, or those that have it alone."""
        if name in _TRANSLATING:
            return []
        several = self.functions.get(name, []) if isinstance(call.func, ast.Name) else []
        several = several or [each for each in self.functions.get(name, []) if each.is_method and each.module is self.module]
        return [each for each in several if each.module is self.module] or several

    def reach(self, owners: Sequence[ast.FunctionDef], parameter: str) -> None:
        """Note that what is given for a parameter of the function that is called reaches an error."""
        for owner in reversed(owners):
            for function in self.functions[owner.name]:
                if function.node is owner and parameter in function.parameters:
                    function.reaching.add(parameter)
                    return


@dataclass
class _Reading:
    """The forms of an expression within some functions."""

    said: _Said
    owners: Sequence[ast.FunctionDef]
    seen: frozenset[str] = frozenset()
    more: list[Form] = field(default_factory=list)

    def forms(self, expression: ast.expr) -> Iterator[Form]:
        found = [*dict.fromkeys(self._forms(expression))]
        yield from map(_joined, [*found, *self.more])

    def _forms(self, expression: ast.expr) -> list[Form]:
        match expression:
            case ast.Constant(value=str(text)):
                return [(text,)]
            case ast.JoinedStr(values=values):
                return self._row([self._part(each) for each in values])
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return self._row([self._forms(left), self._forms(right)])
            case ast.BinOp(left=ast.Constant(value=str(text)), op=ast.Mult()):
                return [("",), (text,)]
            case ast.IfExp(body=one, orelse=other):
                return [*self._forms(one), *self._forms(other)]
            case ast.BoolOp(op=ast.Or(), values=values):
                return [form for each in values for form in self._forms(each)]
            case ast.Lambda(body=body):
                return self._forms(body)
            case ast.Call(func=ast.Attribute(value=value, attr=attr)) if attr in _STRIPPED:
                return self._forms(value)
            case ast.Call(func=ast.Name(id=name), args=[]) if self._assigned(name):
                return self._of_name(name)
            case ast.Call(func=ast.Name(id=name), args=[]) if any(name in _names_of(owner) for owner in self.owners):
                self.said.reach(self.owners, name)
            case ast.Call(func=ast.Name(id=name)) if name not in self.seen:
                for function in self.said.called(name, expression):
                    self._follow(function)
            case ast.Name(id=name):
                return self._of_name(name)
            case ast.Subscript(value=ast.Name(id=name)):
                table = self.said.module.constants.get(name)
                if isinstance(table, ast.Dict):
                    self.more += [form for each in table.values for form in self._forms(each) if has_words(form)]
        return [(Value(_name(expression)),)]

    def _follow(self, function: _Function) -> None:
        """Take the texts that a function returns for further forms."""
        there = _Said(function.module, self.said.errors, self.said.functions)
        inner = _Reading(there, [function.node], self.seen | {function.node.name}, self.more)
        for node in _inside(function.node, ast.Return):
            if node.value is not None:
                self.more += [form for form in map(_joined, inner._forms(node.value)) if has_words(form)]

    def _of_name(self, name: str) -> list[Form]:
        if name in self.seen:
            return [(Value(_plain(name)),)]
        assigned = self._assigned(name)
        inner = _Reading(self.said, self.owners, self.seen | {name}, self.more)
        found = [form for each in assigned for form in inner._forms(each)]
        if any(isinstance(part, str) for form in found for part in form):
            return found
        self.said.reach(self.owners, name)
        return [(Value(_plain(name)),)]

    def _assigned(self, name: str) -> list[ast.expr]:
        """What a name stands for: in the function, else in the module."""
        for owner in reversed(self.owners):
            found = [value for node in _inside(owner, _Assigning) for value in _values_of(node, name)]
            if found:
                return found
            if name in _names_of(owner):
                return []
        constant = self.said.module.constants.get(name)
        return [] if constant is None else [constant]

    def _part(self, value: ast.expr) -> list[Form]:
        if not isinstance(value, ast.FormattedValue):
            return self._forms(value)
        return [(Value(_name(value.value)),)] if value.format_spec else self._forms(value.value)

    def _row(self, parts: Sequence[Sequence[Form]]) -> list[Form]:
        """One of each part behind one another; where there are too many ways, a part with many stands for itself."""
        number = 1
        kept: list[Sequence[Form]] = []
        for several in parts:
            number *= max(1, len(several))
            if number > MOST_FORMS:
                number //= len(several)
                self.more += several
                several = [(Value("part"),)]
            kept.append(several)
        return [tuple(part for form in row for part in form) for row in product(*kept)]


def _joined(form: Form) -> Form:
    """A form with neighbouring texts joined, and neighbouring values taken for one."""
    found: list[Part] = []
    for part in form:
        if part == "":
            continue
        if found and isinstance(part, str) and isinstance(found[-1], str):
            found[-1] += part
        elif not (found and isinstance(part, Value) and isinstance(found[-1], Value)):
            found.append(part)
    if found and isinstance(found[0], str):
        found[0] = found[0].lstrip()
    if found and isinstance(found[-1], str):
        found[-1] = found[-1].rstrip()
    return tuple(found)


_Assigning = ast.Assign | ast.AnnAssign | ast.NamedExpr | ast.For


def _values_of(node: ast.AST, name: str) -> Iterator[ast.expr]:
    match node:
        case ast.Assign(targets=targets, value=value):
            for target in targets:
                yield from _matched(target, value, name)
        case ast.AnnAssign(target=ast.Name(id=own), value=value) if own == name and value is not None:
            yield value
        case ast.NamedExpr(target=ast.Name(id=own), value=value) if own == name:
            yield value
        case ast.For(target=target, iter=ast.Tuple(elts=rows) | ast.List(elts=rows)):
            for row in rows:
                yield from _matched(target, row, name)


def _matched(target: ast.expr, value: ast.expr, name: str) -> Iterator[ast.expr]:
    match target:
        case ast.Name(id=own) if own == name:
            yield value
        case ast.Tuple(elts=targets):
            values = [value]
            if isinstance(value, ast.IfExp):
                values = [value.body, value.orelse]
            for each in values:
                if isinstance(each, ast.Tuple) and len(each.elts) == len(targets):
                    for one, other in zip(targets, each.elts, strict=True):
                        yield from _matched(one, other, name)


@cache
def _inside(tree: ast.AST, kind: Any) -> tuple[Any, ...]:
    """The nodes of a kind in a tree."""
    return tuple(node for node in ast.walk(tree) if isinstance(node, kind))


@cache
def _names_of(owner: ast.FunctionDef) -> set[str]:
    arguments = owner.args
    return {each.arg for each in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)}


def _name(expression: ast.expr) -> str:
    """What a value is called, by the expression that it is of."""
    match expression:
        case ast.Name(id=name):
            return _plain(name)
        case ast.Attribute(attr="__name__", value=ast.Call(func=ast.Name(id="type"))):
            return "kind"
        case ast.Attribute(attr=name) if not name.startswith("__"):
            return _plain(name)
        case ast.Attribute(value=value):
            return _name(value)
        case ast.Call(func=ast.Name(id=name), args=[first, *_]) if name in _CALLED:
            return _name(first)
        case ast.Call(func=ast.Attribute(attr="join"), args=[first, *_]):
            return _name(first)
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return _plain(name)
        case ast.Subscript(value=value) | ast.Starred(value=value) | ast.FormattedValue(value=value):
            return _name(value)
        case ast.BoolOp(values=[first, *_]):
            return _name(first)
        case ast.BinOp(left=first):
            return _name(first)
        case ast.IfExp(body=first):
            return _name(first)
        case ast.GeneratorExp(elt=first) | ast.ListComp(elt=first):
            return _name(first)
    return "value"


def _plain(name: str) -> str:
    return name.strip("_").lower()
