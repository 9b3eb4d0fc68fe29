"""Whatever is given for an argument of a public function, it is used or refused in words: what cannot be compared, too."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import cache, partial
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
import sympy
from matplotlib.figure import Figure
from traitlets import TraitError

import lsys_kit
from lsys_kit import (
    LSystemError,
    ModelValueError,
    cellwork_system,
    derive,
    ensemble,
    lineage,
    link,
    map_system,
    read,
    stages,
    timed,
)
from lsys_kit.derivation.derive import Derivation
from tests.fuzzing.public_ways import members, results
from tests.rows import every_row


class Incomparable:
    """What raises an error when it is compared or asked whether it is true."""

    def _refuse(self, *_: object) -> Any:
        raise ZeroDivisionError

    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = __bool__ = _refuse


ODD: Mapping[str, object] = {
    "array": np.array([1, 2]),
    "array of texts": np.array(["exact", "float"]),
    "empty array": np.array([]),
    "table": np.array([[1.0, 2.0], [3.0, 4.0]]),
    "symbol": sympy.Symbol("x"),
    "relation": sympy.Symbol("x") < 1,
    "matrix": sympy.Matrix([sympy.Symbol("x")]),
    "matrix symbol": sympy.MatrixSymbol("x", 2, 2),
    "undefined": sympy.nan,
    "complex infinity": sympy.zoo,
    "nan": float("nan"),
    "infinity": float("inf"),
    "object": object(),
    "incomparable": Incomparable(),
    "set": {1},
    "function": len,
    "class": int,
    "bytes": b"1",
    "surrogate": "\ud800",
    "text": "dark",
    "below zero": -1,
    "beyond": 10**5000,
    "nothing": None,
    "numbers by numbers": {1: 2},
}
"""Values that hardly anything can be done with."""
_FOLDER = TemporaryDirectory()
GROWING = read("c = 1\naxiom: a\na -> a b(c)\nb(x) -> b(x)")
SURFACE = "\n".join(
    (
        "CONTACT POINT  X: 0 Y: 0 Z: 0",
        "HEADING  X: 0 Y: 1 Z: 0",
        "UP  X: 0 Y: 0 Z: 1",
        "SIZE: 1",
        *["0 0 0 0 0 1 0 1 0 0 1 1"] * 4,
    )
)
AGEING = read("c = 1\naxiom: a(0)\na(1) -> a(0) b(0)\nb(1) -> a(0)")
FITTING: Mapping[str, Callable[[], tuple[object, ...]]] = {
    "animate": lambda: (GROWING, 1),
    "book_systems": tuple,
    "check": lambda: ("1.1", "al"),
    "continuity": lambda: (AGEING, {"a": "1", "b": "1"}),
    "derive": lambda: (GROWING, 1),
    "exercises": tuple,
    "practice": lambda: ("derive", 1, 1),
    "score": lambda: ("1.1",),
    "draw": lambda: (GROWING, 1),
    "draw_hierarchy": lambda: ("dark",),
    "cellwork_system": lambda: ("K33",),
    "compare": lambda: (GROWING, GROWING),
    "link": lambda: (GROWING, {"step": 1}),
    "linked": lambda: (link(GROWING),),
    "qr_code": lambda: ("text",),
    "variants": lambda: (GROWING, 2),
    "cellwork_systems": tuple,
    "read_cellwork": lambda: (str(cellwork_system("K33")),),
    "link a cellwork": lambda: (cellwork_system("K33"), {"step": 1}),
    "draw a cellwork": lambda: (cellwork_system("K33"), 1),
    "derive a cellwork": lambda: (cellwork_system("K33"), 1),
    "explain": lambda: (derive(GROWING, 1), 1),
    "infer": lambda: (["a", "ab", "aba"], ("+",), False, (0, 0)),
    "rule_finder": lambda: (["a", "ab", "aba"], ("+",), False, (0, 0)),
    "language": lambda: ("en",),
    "infer from drawings": lambda: ([[(0, 0, 0, 1)], [(0, 0, 0, 1), (0, 1, 1, 1)]],),
    "explore": lambda: (GROWING, 1),
    "figure": lambda: (GROWING, Figure().subplots()),
    "growth": lambda: (GROWING,),
    "total": lambda: (GROWING, "b", 1),
    "limits": tuple,
    "life_spans": lambda: (AGEING,),
    "closing_angles": lambda: (GROWING, 1),
    "lineage": lambda: (GROWING, 1),
    "map_system": lambda: ("K30",),
    "map_systems": tuple,
    "progress": lambda: (1,),
    "pnml": lambda: (stages(GROWING), None),
    "open_class": lambda: ("10b", _FOLDER.name, 0, False),
    "predict": lambda: ("How many?", "21"),
    "read": lambda: ("axiom: a", "abop", "x"),
    "read_map": lambda: ("map: A>A>",),
    "ask": lambda: ("How many has step 3?", GROWING, "b", 3),
    "vote": lambda: ("Which?", ["a", "b"], "A", None, ["no", "yes"], False),
    "worksheet": lambda: ("01", "counts"),
    "worksheet beside a panel": lambda: ("01", "counts", lsys_kit.explore(GROWING, 1)),
    "stages": lambda: (GROWING,),
    "system": lambda: ("J1",),
    "systems": tuple,
    "timed": lambda: (AGEING,),
    "ensemble": lambda: (GROWING, 2, "b"),
    "sweep": lambda: (GROWING, {"c": [1, 2]}, "b"),
    "distances": lambda: (GROWING, "b", 2),
    "plot": lambda: (GROWING, 2, "b"),
    "plot over time": lambda: (timed(AGEING), 2, "modules"),
    "plot a table": lambda: (ensemble(GROWING, 2),),
    "plot stages": lambda: (stages(GROWING), 2),
    "plot maps": lambda: (map_system("K30"), 1),
    "with_surface": lambda: (GROWING, "L", SURFACE),
    "write": lambda: (GROWING, "abop"),
    "draw a stage diagram": lambda: (stages(GROWING),),
    "draw a lineage": lambda: (lineage(GROWING, 1),),
    "draw a map": lambda: (map_system("K30"), 1),
    "draw in space": lambda: (read("axiom: F&F"), 1),
    "lineage in time": lambda: (timed(AGEING), 1),
    "stages in time": lambda: (timed(AGEING),),
    "derive a map": lambda: (map_system("K30"), 1),
}
"""For each public function arguments that it takes."""
CHOICES: Mapping[str, tuple[str, ...]] = {
    "derive": ("seed", "arithmetic", "c"),
    "draw": ("angle", "seed", "arithmetic", "marked", "cells", "c", "steps", "seeds", "size"),
    "ensemble": ("arithmetic", "c"),
    "sweep": ("arithmetic", "seed"),
    "distances": ("arithmetic", "c"),
    "plot": ("seed", "arithmetic", "c"),
    "figure": ("n", "angle", "seed", "arithmetic", "marked", "cells", "c"),
    "limits": ("modules", "bytes", "seconds"),
    "draw a stage diagram": ("tokens", "positions"),
    "draw a lineage": ("intervals",),
    "draw in space": ("angle", "marked", "view", "light"),
    "draw a cellwork": ("view", "cell", "generation", "explode", "pressure", "light"),
    "draw a map": ("iterations", "stiffness", "rest", "pressure", "damping"),
}
"""The arguments that a function takes beside those of its signature; `c` is a constant."""
NO_QUESTIONS = {"close", "end", "hear", "save", "__getitem__"}
"""Methods that are no law of this kind: files have one of their own, and an index is refused as Python's lists refuse it."""
MADE_IN_OTHER_WAYS: tuple[Callable[[], object], ...] = (
    lambda: lsys_kit.draw(GROWING, steps=[0, 1]),
    lambda: lsys_kit.draw(map_system("K30"), 1, phases=True),
    lambda: lsys_kit.animate(read("axiom: F"), 1),
    lambda: lsys_kit.infer([["a", "ab", "abb"], ["a", "b", "b"], ["a", "ab", "bb"]], stochastic=True),
    lambda: lsys_kit.infer(["a", "ab", "aba", "abaab", "abaabaxa"]).mended[0],
    lambda: lsys_kit.total(read("q = 1/2\naxiom: A(1)\nA(x) -> F(x) A(q*x)"), "F", q="q").solve("q", 2, n=3),
    lambda: derive(map_system("K30"), 1)[1],
    lambda: derive(cellwork_system("K33"), 1)[1],
)


def called(name: str, argument: str, odd: object) -> object:
    """What comes of a call with an odd value for one argument."""
    function, fitting = getattr(lsys_kit, name.split()[0]), FITTING[name]()
    given = dict(zip(inspect.signature(function).parameters, fitting, strict=False))
    positional = [odd if key == argument else value for key, value in given.items()]
    return looked_at(function(*positional, **({} if argument in given else {argument: odd})))


def looked_at(result: Any) -> object:
    """A result, as a notebook shows it."""
    return [repr(result), getattr(result, "svg", ""), getattr(result, "text", "")]


def arguments(name: str) -> list[str]:
    """The arguments of a public function."""
    parameters = inspect.signature(getattr(lsys_kit, name.split()[0])).parameters.values()
    named = [each.name for each in parameters if each.kind is not inspect.Parameter.VAR_KEYWORD]
    other = name.split()[0] in ("continuity", "infer", "rule_finder")
    constants = ["c"] if any(each.name == "constants" for each in parameters) and not other else []
    return [*dict.fromkeys([*named, *CHOICES.get(name, ()), *constants])]


def test_every_public_function_is_tried() -> None:
    errors = {name for name in lsys_kit.__all__ if isinstance(getattr(lsys_kit, name), type)}
    assert {*lsys_kit.__all__} - errors <= FITTING.keys()


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that is named by an odd value is made there."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("name", FITTING)
@pytest.mark.filterwarnings("ignore")
def test_an_odd_argument_is_used_or_refused(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with every_row() as row:
        for argument, odd in product(arguments(name), ODD):
            (tmp_path / f"{argument}, {odd}").mkdir()
            monkeypatch.chdir(tmp_path / f"{argument}, {odd}")
            with row(argument, odd), suppress(LSystemError):
                called(name, argument, ODD[odd])


@pytest.mark.parametrize("odd", ODD.values(), ids=ODD)
@pytest.mark.parametrize("name", ["step", "angle", "seed"])
def test_an_odd_setting_beside_a_link_is_used_or_refused(name: str, odd: object) -> None:
    with suppress(LSystemError):
        lsys_kit.explore(link(GROWING), **{name: odd})  # type: ignore[arg-type]


def test_a_step_of_many_digits_has_no_explanation() -> None:
    with pytest.raises(ModelValueError):
        lsys_kit.explain(derive(GROWING, 1), 10**5000)


def test_a_system_without_lives_is_continuous_or_refused() -> None:
    with suppress(LSystemError):
        lsys_kit.continuity(read("axiom: A B A"), {})


@pytest.mark.parametrize(
    "step", [-1, 4, 10**30, 10**5000, -(10**5000)], ids=["before", "beyond", "far", "very far", "far back"]
)
@pytest.mark.parametrize("ask", [Derivation.counts, Derivation.origins, Derivation.ancestors, Derivation.sight])
def test_a_step_that_a_derivation_lacks_is_refused(ask: Callable[..., object], step: int) -> None:
    with pytest.raises(ModelValueError, match=r"step"):
        ask(derive(GROWING, 3), step)


@cache
def found_results() -> dict[str, Any]:
    """One of each class of what public functions return, and of what these offer in turn."""
    makers = [partial(lambda name: getattr(lsys_kit, name.split()[0])(*FITTING[name]()), name) for name in FITTING]
    found: dict[str, Any] = {}
    todo: list[Callable[[], Any]] = [*makers, *MADE_IN_OTHER_WAYS]
    while todo:
        with suppress(LSystemError):
            one = todo.pop(0)()
            kind = type(one).__name__
            if kind in results() and kind not in found:
                found[kind] = one
                todo += [partial(asked, one, name, 1) for name in members(kind)]
            elif isinstance(one, tuple):
                todo += [partial(one.__getitem__, 0)] if one else []
    return found


def asked(result: Any, name: str, *given: object) -> Any:
    """A property of a result, or what a method of it answers if its arguments are these, or 1."""
    if name in NO_QUESTIONS or not inspect.isfunction(inspect.getattr_static(type(result), name)):
        return None if name in NO_QUESTIONS else getattr(result, name)
    needed = [
        each
        for each in inspect.signature(getattr(result, name)).parameters.values()
        if each.default is each.empty and each.kind is not each.VAR_KEYWORD
    ]
    return getattr(result, name)(*[*given, 1, 1][: len(needed)])


def questions() -> Iterator[tuple[str, str, str]]:
    """The arguments of all methods of results."""
    for kind, result in found_results().items():
        for name in members(kind):
            if name not in NO_QUESTIONS and inspect.isfunction(inspect.getattr_static(type(result), name)):
                yield from ((kind, name, each) for each in inspect.signature(getattr(result, name)).parameters)


@pytest.mark.slow
def test_every_result_is_asked() -> None:
    assert results().keys() - found_results().keys() <= {"Observation", "Sight"}, "those are what others are told by"


@pytest.mark.slow
@pytest.mark.parametrize("odd", ODD.values(), ids=ODD)
@pytest.mark.filterwarnings("ignore")
def test_an_odd_question_is_answered_or_refused(odd: object) -> None:
    with every_row() as row:
        for kind, name, argument in questions():
            with row(f"{kind}.{name}", argument), suppress(LSystemError, TraitError):
                ask_oddly(kind, name, argument, odd)


def ask_oddly(kind: str, name: str, argument: str, odd: object) -> None:
    """Call a method of a result with an odd value for one argument."""
    method = getattr(found_results()[kind], name)
    parameters = inspect.signature(method).parameters.values()
    given = [
        odd if each.name == argument else 1
        for each in parameters
        if each.kind in (each.POSITIONAL_OR_KEYWORD, each.VAR_POSITIONAL)
        and (each.default is each.empty or each.name == argument)
    ]
    named = {
        {each.VAR_KEYWORD: "c"}.get(each.kind, each.name): odd
        for each in parameters
        if each.name == argument and each.kind in (each.KEYWORD_ONLY, each.VAR_KEYWORD)
    }
    answer = method(*given, **named)
    next(answer, None) if inspect.isgenerator(answer) else looked_at(answer)
