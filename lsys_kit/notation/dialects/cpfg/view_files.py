"""What cpfg keeps beside a model, in the files of its folder: view, surfaces, functions, and what is included.

The command in the file `specifications` names the model and its view, `cpfg -m plant.map plant.l plant.v`; where there is
none, the view is called as the model is, or is the only one. Of a view the angle, the surfaces and the functions are used; the
rest says how a window looks. Included files, and functions in place of `func(1, x)`, are put into the model's text.

A function is a curve with control points from x = 0 to x = 1, a cubic B-spline that begins and ends in the first and the last
of them (with four points, as the editor begins, a Bezier curve on which x is even). Here it is made of straight pieces, as many
as it takes to stay within `CLOSE` of its height.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from pathlib import PurePosixPath

from lsys_kit.budget import Task, counted, current
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelSyntaxError, ModelValueError, quotable
from lsys_kit.notation.analysis.checks import SETTINGS
from lsys_kit.notation.dialects.cpfg.dialect import CPFG
from lsys_kit.notation.dialects.cpfg.surface_files import with_surface
from lsys_kit.notation.dialects.cpfg.variables import used_expressions
from lsys_kit.notation.folders import Folder
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import names_in
from lsys_kit.notation.model.surfaces import SurfaceShape
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.syntax.systems import system_in
from lsys_kit.notation.syntax.text.statements import without_comments
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, as_typed, edited

CLOSE = 1 / 400
"""How far straight pieces may be from a curve, as a part of its height."""
MOST_POINTS, MOST_PIECES = 1_000, 16
"""So many control points a curve has at most, and so many straight pieces it is made of."""
_SAMPLES = 400
_COMMAND = re.compile(r"^[ \t]*(?:lc|cpfg)\b(.*)$", re.MULTILINE)
_SETTING = re.compile(r"^[ \t]*+(?P<name>[a-z][a-z \t]*+):[ \t]*+(?P<value>[^\n]*+)", re.MULTILINE | re.IGNORECASE)
_PROSE = re.compile(r"//[^\n]*")
_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*[<\"]([^<>\"\n]+)[>\"][^\n]*$", re.MULTILINE)
_CALL = re.compile(r"\bfunc\s*\(")
_MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)[ \t]+(\d{1,4})[ \t]*$", re.MULTILINE)
_RANDOM = re.compile(r"\b(?:n|b|bi)?ran\s*\(")
_NUMBER = r"-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d{1,2})?"
_POINT = re.compile(rf"^[ \t]*({_NUMBER})[ \t]+({_NUMBER})(?:[ \t]+([1-9]))?[ \t\r]*$", re.MULTILINE)
_NAME_OF_FUNCTION = re.compile(r"^name:[ \t]*(\w+)", re.MULTILINE)

Curve = Sequence[tuple[float, float]]
"""The ends of straight pieces, from left to right."""


@dataclass
class View:
    """What a view file says that is used: the angle, surfaces with their files and sizes, and functions by number and name."""

    angle: Value | None = None
    surfaces: list[tuple[str, str, float]] = field(default_factory=list)
    functions: dict[str, Curve] = field(default_factory=dict)
    unused: list[str] = field(default_factory=list)


def commands(folder: Folder) -> list[list[str]]:
    """The files that the commands of a folder's `specifications` name, command by command."""
    said = folder.text("specifications") if "specifications" in folder.files else ""
    return [[word for word in match[1].split() if word in folder.files] for match in _COMMAND.finditer(said)]


def read_object(folder: Folder, model: str) -> LSystem:
    """The system of a model's text and what stands beside it."""
    with Task("The model was not read"):
        return _read_object(folder, model)


def _read_object(folder: Folder, model: str) -> LSystem:
    view_name, notes = _view_name(folder, model)
    view = _view(folder, view_name) if view_name else View()
    text = _with_functions(_with_included(as_typed(folder.text(model)), folder), view.functions)
    try:
        system = system_in(CPFG, text.text)
    except LSystemError as error:
        raise text.relocated(error) from None
    told = [note for note in system.notes if not (view.angle and note.startswith("cpfg keeps the angle"))]
    system = replace(system, angle=view.angle) if view.angle and not re.search(r"/\*[ \t]*angle:", text.text) else system
    for symbol, name, size in counted(view.surfaces):
        if name in folder.files:
            system = _with_surface(system, symbol, folder, name, size)
        else:
            notes.append(f'The surface "~{symbol}" is missing: "{name}" is not in the folder.')
    if view_name and view.unused:
        notes.append(f'Not used of "{view_name}": {", ".join(view.unused)}.')
    maps = [*folder.named(".map"), *folder.named(".mat")]
    if maps:
        notes.append(f"Colours are those of the kit, not those of {' and '.join(map(_quoted, maps))}.")
    if films := folder.named(".a"):
        notes.append(f"How a model is animated is not read: {', '.join(map(_quoted, films))}.")
    used = " and ".join(map(_quoted, filter(None, (model, view_name))))
    system = replace(system, notes=(f"Read as cpfg, from {used}.", *notes, *text.notes, *told))
    return _in_own_notation(system) if system.surfaces else system


def _in_own_notation(system: LSystem) -> LSystem:
    """A system that prints itself in the kit's own notation, since cpfg's texts hold no surfaces.

    A macro that only said how many steps there are, and is called so, is no constant: the kit has a setting for it.
    """
    used = {name for rule in system.rules for expression in used_expressions(rule) for name in names_in(expression)}
    used |= {name for module in system.axiom for value in module.arguments for name in names_in(value)}
    used |= {name for constant in system.constants for name in names_in(constant.value)}
    kept = tuple(each for each in system.constants if each.name in used or each.name.lower() not in SETTINGS)
    return replace(system, notation="abop", constants=kept)


def _quoted(name: str) -> str:
    return f'"{quotable(name)}"'


def _view_name(folder: Folder, model: str) -> tuple[str, list[str]]:
    """The view of a model; where several may be meant, none, and a note."""
    named = [word for words in commands(folder) if model in words for word in words if word.endswith(".v")]
    same = PurePosixPath(model).with_suffix(".v").name
    views = [*dict.fromkeys(named)] or [name for name in folder.named(".v") if name == same] or folder.named(".v")
    if len(views) > 1:
        told = f"There are several views, and none is used: {', '.join(map(_quoted, views))}. Name that of this model {same}."
        return "", [told]
    return (views[0] if views else ""), []


def _view(folder: Folder, name: str) -> View:
    """What a view file says."""
    text = _PROSE.sub("", without_comments(folder.text(name)))
    found = View()
    numbered = 0
    curve_in = cache(lambda name: _curve(folder.text(name), name))
    for match in counted(_SETTING.finditer(text)):
        keyword, words = " ".join(match["name"].lower().split()), match["value"].split()
        if keyword == "angle factor":
            found.angle = _turn(text, match)
        elif keyword == "surface" and len(words) > 1:
            size = float(words[2]) if len(words) > 2 and re.fullmatch(_NUMBER, words[2]) else 1.0
            found.surfaces.append((words[0], words[1], size))
        elif keyword == "function" and words and words[0] in folder.files:
            numbered += 1
            found.functions[str(numbered)] = curve_in(words[0])
        elif keyword == "function set" and words and words[0] in folder.files:
            for part in counted(re.split(r"^fver\b[^\n]*$", folder.text(words[0]), flags=re.MULTILINE)[1:]):
                numbered += 1
                curve, called = _curve(part, words[0]), _NAME_OF_FUNCTION.search(part)
                found.functions |= dict.fromkeys((str(numbered), called[1] if called else ""), curve)
        elif keyword not in found.unused:
            found.unused.append(keyword)
    return found


def _turn(text: str, match: re.Match[str]) -> Value:
    """The angle of which a full turn has so many."""
    value = match["value"].strip()
    if not re.fullmatch(r"\d{1,6}(?:\.\d{1,6})?", value) or not float(value):
        start, end = match.span("value")
        hint = 'It says how many turns make a full one, as in "angle factor: 16".'
        raise ModelSyntaxError("This angle factor is no positive number", text, start, max(end, start + 1), hint)
    return normalised(360 / Fraction(value))


def _with_surface(system: LSystem, symbol: str, folder: Folder, name: str, size: float) -> LSystem:
    """A system with a surface out of its file, as large as the view says."""
    try:
        found = with_surface(system, symbol, folder.text(name))
    except LSystemError as error:
        raise ModelFileError(f"{_quoted(name)} is no surface: {error.message}", hint=error.hint) from None
    *others, shape = found.surfaces
    patches = tuple(tuple((size * a, size * b, size * c) for a, b, c in patch) for patch in shape.patches)
    return replace(found, surfaces=(*others, SurfaceShape(symbol, patches=patches)))


def _with_included(text: Transcript, folder: Folder, deep: int = 0) -> Transcript:
    """A text with the files that it includes, as far as they are in its folder."""
    edits = [
        Edit(*match.span(), folder.text(match[1]))
        for match in _INCLUDE.finditer(without_comments(text.text))
        if match[1] in folder.files
    ]
    if not edits:
        return text
    if deep > current().depth or len(text.text) + sum(len(edit.text) for edit in edits) > current().text:
        raise ModelValueError("What this model includes is too long, or includes itself")
    return _with_included(edited(text, edits), folder, deep + 1)


def _with_functions(before: Transcript, functions: Mapping[str, Curve]) -> Transcript:
    """A text with straight pieces in place of each `func(1, x)`; the innermost first."""
    numbers = dict(_MACRO.findall(before.text))
    while True:
        edits, used = [], dict[str, None]()
        for start, end, number, value in _calls(before.text):
            curve = functions.get(number) or functions.get(numbers.get(number, ""))
            if curve is None or _CALL.search(value):
                continue
            if _RANDOM.search(value):
                hint = 'Make it the parameter of a module, as in "A --> B(ran(1))", and use that in the next step.'
                raise ModelValueError(
                    "The value of this function cannot be random here", before.source, before.origin(start), None, hint
                )
            made = _pieces(curve, value)
            if len(made) > current().expression:
                message = f"With its curve this value is longer than {current().expression:,} characters"
                raise ModelLimitError(
                    message, limit=current().expression, needed=len(made), source=before.source, start=before.origin(start)
                )
            edits.append(Edit(start, end, made))
            used[f"func({number}, ...) is a curve, here of {_counted(len(curve) - 1)}."] = None
        if not edits:
            return before
        before = edited(before, edits, [*used])


def _counted(pieces: int) -> str:
    return "one straight piece" if pieces == 1 else f"{pieces} straight pieces"


def _calls(text: str) -> Iterator[tuple[int, int, str, str]]:
    """Where functions are called: from where to where, which, and of what."""
    for call in counted(_CALL.finditer(text)):
        depth, comma = 0, 0
        for sign in re.finditer(r"[(),\n]", text[call.end() : call.end() + current().expression]):
            at = call.end() + sign.start()
            if sign[0] == "," and not depth and not comma:
                comma = at
            elif sign[0] == ")" and not depth:
                if comma:
                    yield call.start(), at + 1, text[call.end() : comma].strip(), text[comma + 1 : at].strip()
                break
            depth += (sign[0] == "(") - (sign[0] == ")")


def _pieces(curve: Curve, value: str) -> str:
    """A curve of straight pieces as a choice among them, by halves; beyond its ends it stays as it is there."""
    lines = [_line(*left, *right, value) for left, right in pairwise(curve)]
    below, above = f"{curve[0][1]:.6g}", f"{curve[-1][1]:.6g}"
    inner = _chosen([x for x, _ in curve[1:-1]], lines, value)
    return f"(({value}) < 0 ? {below} : (({value}) > 1 ? {above} : {inner}))"


def _chosen(ends: Sequence[float], lines: Sequence[str], value: str) -> str:
    if len(lines) == 1:
        return lines[0]
    half = len(lines) // 2
    left, right = _chosen(ends[: half - 1], lines[:half], value), _chosen(ends[half:], lines[half:], value)
    return f"(({value}) < {ends[half - 1]:.6g} ? {left} : {right})"


def _line(x: float, y: float, right: float, above: float, value: str) -> str:
    slope = f"{(above - y) / (right - x):.6g}"
    run = f"(({value}) - {x:.6g})" if x else f"({value})"
    rise = run if slope == "1" else f"({slope})*{run}"
    return f"({y:.6g})" if slope == "0" else f"({y:.6g} + {rise})" if y else f"({rise})"


def _curve(text: str, name: str) -> Curve:
    """A function out of its file, as straight pieces."""
    points = [(float(x), float(y)) for x, y, times in _POINT.findall(text) for _ in range(int(times or 1))]
    rising = all(left[0] <= right[0] for left, right in pairwise(points))
    if (
        not 4 <= len(points) <= MOST_POINTS
        or not rising
        or points[0][0] != 0
        or points[-1][0] != 1
        or re.search(r"^flip:[ \t]*on", text, re.MULTILINE)
    ):
        hint = "It has at least four points from x = 0 to x = 1, each on a line, and is not flipped."
        raise ModelFileError(f"{_quoted(name)} is no function that the kit can read", hint=hint)
    return _straightened([_on_spline(points, index / _SAMPLES) for index in range(_SAMPLES + 1)])


def _on_spline(points: Curve, u: float) -> tuple[float, float]:
    """A point on the cubic B-spline of some control points, by the algorithm of de Boor."""
    spans = len(points) - 3
    span = min(int(u * spans), spans - 1)
    knots = [0.0] * 3 + [index / spans for index in range(spans + 1)] + [1.0] * 3
    d = [points[span + index] for index in range(4)]
    for level in range(1, 4):
        for index in range(3, level - 1, -1):
            left, right = knots[span + index], knots[span + index + 4 - level]
            part = (u - left) / (right - left)
            (x, y), (a, b) = d[index - 1], d[index]
            d[index] = (1 - part) * x + part * a, (1 - part) * y + part * b
    return d[3]


def _straightened(curve: Curve) -> Curve:
    """Some points of a curve, between which it is nearly straight: the farthest from the straight pieces is added each time."""
    curve = [*_rising(curve)]
    height = max(y for _, y in curve) - min(y for _, y in curve)
    kept = [0, len(curve) - 1]
    while len(kept) <= MOST_PIECES:
        far, index = max(_distances(curve, kept))
        if far <= CLOSE * height + 1e-9:
            break
        kept = sorted([*kept, index])
    return [curve[index] for index in kept]


def _rising(curve: Curve) -> Iterator[tuple[float, float]]:
    """The first point of a curve, and of the others those that have none right above or below them later."""
    yield curve[0]
    for point, after in zip(curve[1:], (*curve[2:], (2.0, 0.0)), strict=True):
        if after[0] > point[0] + 1e-6 and point[0] > 1e-6:
            yield point


def _distances(curve: Curve, kept: Sequence[int]) -> Iterator[tuple[float, int]]:
    """How far each point is above or below the straight pieces between those that are kept."""
    for first, last in pairwise(kept):
        (x, y), (right, above) = curve[first], curve[last]
        for index in range(first, last + 1):
            yield abs(curve[index][1] - y - (above - y) * (curve[index][0] - x) / (right - x)), index
