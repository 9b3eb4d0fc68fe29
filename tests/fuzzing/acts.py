"""What is done by every public way: a table of rows of calls, of which each is handed what the one before has made.

The name of a row begins with the public way that it tries, as in "derive: many steps": a function, what a result offers
(`Class.name`), a command of the shell, a format that is read or written, or what a browser may send to a widget. The rows are
grouped by what the first call is handed: see `models`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from contextlib import redirect_stderr, redirect_stdout
from functools import partial
from io import StringIO
from pathlib import Path
from typing import Any, TypeAlias

import lsys_kit as kit
from lsys_kit.__main__ import main
from lsys_kit.notation.registry import DIALECTS
from tests.endings import DRAWINGS, FILMS
from tests.fuzzing.models import BOMBS, CELLWORKS, MAPS, TEXTS, VALUES, WORDS
from tests.fuzzing.public_ways import members

Calls: TypeAlias = tuple[Callable[[Any], Any], ...]
LAST, SVG = lambda found: found[-1], lambda found: found.svg
SMALL = "c = 1 in 0 .. 3 by 1\naxiom: a(c)\na(x) -> a(x) b(x)\nb(x) -> a(x)"
"""A system for values that are not."""


def made(bomb: Callable[[], Any]) -> Any:
    """A bomb that is made anew each time."""
    return bomb()


def longest(system: Any) -> Any:
    """The derivation of as many steps as there is room and time for."""
    try:
        return kit.derive(system, 100_000)
    except kit.ModelLimitError as error:
        if error.partial is None:
            raise
        return error.partial


def symbols(system: Any) -> dict[str, object]:
    """Its constants, each left open."""
    return {constant.name: constant.name for constant in system.constants}


def saved(path: Path) -> Callable[[Any], object]:
    """Save a picture."""
    return lambda picture: picture.save(path)


def typed(*arguments: str) -> Callable[[Any], object]:
    """Type a command; what is said is thrown away, as it may be long."""

    def command(_: object) -> None:
        with open("/dev/null", "w") as nowhere, redirect_stdout(nowhere), redirect_stderr(StringIO()) as said:
            status = main(arguments)
        if status:
            raise kit.LSystemError(said.getvalue()[:200])

    return command


def lesson_of(folder: Path, declared: str, text: str) -> None:
    """Write a lesson with a declaration, and with a text that stands in a cell of each kind."""
    place = folder / "course" / "notebooks"
    place.mkdir(parents=True, exist_ok=True)
    (place / "own.toml").write_text(declared, errors="replace")
    more = {"code": {"outputs": [], "execution_count": None}, "markdown": {}}
    cells = [
        {"cell_type": kind, "id": kind, "metadata": {}, "source": text.encode(errors="replace").decode(), **more[kind]}
        for kind in more
    ]
    notebook = {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    (place / "own.ipynb").write_text(json.dumps(notebook))


def asked(**content: object) -> Callable[[Any], object]:
    """Ask a panel as a browser does."""
    return lambda panel: panel._answer(None, {"number": 1, **content}, None)


def put(name: str) -> Callable[[Any], object]:
    """Give a widget a value as a browser does."""

    def give(given: tuple[Any, Any]) -> None:
        try:
            setattr(given[0], name, given[1])
        except (RecursionError, OverflowError) as error:  # JSON has neither such nesting nor such numbers
            raise kit.LSystemError("No message says this") from error

    return give


MAKERS: Mapping[str, Callable[[Any], Any]] = {
    "Film": lambda system: kit.animate(system, 6),
    "Comparison": lambda system: kit.compare(system, system, step=6),
    "Continuity": lambda system: kit.continuity(system, {}),
    "Derivation": lambda system: kit.derive(system, 9),
    "Word": lambda system: longest(system)[-1],
    "Picture": lambda system: kit.draw(longest(system)),
    "NetPicture": lambda system: kit.draw(kit.stages(system)),
    "LineagePicture": lambda system: kit.draw(kit.lineage(system, 6)),
    "Explorer": lambda system: kit.explore(system, 9),
    "SmallMultiples": lambda system: kit.draw(system, steps=[3, 6, 9]),
    "Sight": lambda system: kit.explore(system, 9).sight,
    "Growth": kit.growth,
    "Total": lambda system: kit.total(system, system.axiom[0].symbol, **symbols(system)),
    "Solutions": lambda system: kit.total(system, system.axiom[0].symbol, **symbols(system)).solve("c", 3, 40),
    "Closing": lambda system: kit.closing_angles(system, 3),
    "LifeSpans": kit.life_spans,
    "Stages": kit.stages,
    "Timed": kit.timed,
    "Fits": lambda system: kit.infer(kit.derive(system, 4)),
    "StochasticFits": lambda system: kit.infer([kit.derive(system, 3)] * 2, stochastic=True),
    "Lineage": lambda system: kit.lineage(system, 9),
    "RuleFinder": lambda system: kit.rule_finder(kit.derive(system, 4)),
    "DrawingFits": lambda system: kit.infer([kit.draw(system, step) for step in range(4)]),
    "Table": lambda system: kit.ensemble(system, 3, ["modules", "height"], steps=range(9), progress=False),
    "Plot": lambda system: kit.plot(system, 9),
    "QRCode": lambda system: kit.qr_code(kit.link(system)),
    "LSystem": lambda system: system,
    "Prediction": lambda system: kit.predict("What comes?", kit.draw(system, 6)),
    "Observation": lambda system: kit.derive(system, 6).sight(6),
    "Origins": lambda system: kit.derive(system, 9).origins(9),
    "Column": lambda system: kit.derive(system, 9).column(),
    "Linked": lambda system: kit.linked(kit.link(system)),
    "Explanation": lambda system: kit.explain(kit.derive(system, 7), 7),
    "Drawing": lambda system: longest_drawn(system).drawing(),
    "Scene": lambda system: longest_drawn(system).scene,
    "Mesh": lambda system: longest_drawn(system).mesh,
}
"""How each result is made of an L-system."""
MAP_MAKERS: Mapping[str, Callable[[Any], Any]] = {
    "Development": longest,
    "Map": lambda system: longest(system)[-1],
    "MapPicture": lambda system: kit.draw(system, 5),
    "PhasesPicture": lambda system: kit.draw(system, 5, phases=True),
    "MapSystem": lambda system: system,
}
CELLWORK_MAKERS: Mapping[str, Callable[[Any], Any]] = {
    "CellworkDevelopment": longest,
    "Cellwork": lambda system: longest(system)[-1],
    "CellworkSystem": lambda system: system,
}
"""The same of a map system and of a cellwork system."""
ARGUMENTS: Mapping[str, tuple[Any, ...]] = {
    "to": (100_000,),
    "counts": (10**6,),
    "counts_of": ("A", 10**6),
    "at": (2_000,),
    "values": (200,),
    "derivative": ("c",),
    "solve": ("c", 3, 40),
    "lengths": (10**6,),
    "length": (10**7,),
    "word": (30,),
    "recurrence_of": ("A",),
    "expected": (30_000,),
    "tokens": (10**6,),
    "origins": (9,),
    "ancestors": (9,),
    "sight": (9,),
    "coded": ({"A": "B" * 10**6},),
    "division": (0,),
    "later": (10**6,),
    "place_of": (0,),
    "line": (0,),
    "in_places": ({},),
    "fired": ([0],),
    "daughters": (0,),
    "series": (10**6,),
    "picture": (9,),
}
"""What members of results are called with that need an argument; the others are called with none."""


def longest_drawn(system: Any) -> Any:
    """The drawing of the longest word."""
    return kit.draw(longest(system))


def used(name: str, folder: Path) -> Callable[[Any], object]:
    """Look at a member of a result, and call it where it can be called."""

    def use(result: Any) -> object:
        found = getattr(result, name)
        if name == "save":
            return found(folder / f"saved{'.gif' if hasattr(result, 'gif') else '.png'}")
        if name == "plot_into":
            from matplotlib.figure import Figure

            return found(Figure().subplots())
        return found(*ARGUMENTS.get(name, ())) if callable(found) else found

    return use


def offered(makers: Mapping[str, Callable[[Any], Any]], folder: Path) -> Mapping[str, Calls]:
    """A row for each member of each result, and for the result as it prints."""
    return {
        f"{result}.{name}": (make, used(name, folder), *[list] * (name in ("modules", "rules")))
        for result, make in makers.items()
        for name in members(result)
    } | {f"{result}.__repr__": (make, repr) for result, make in makers.items()}


def acts(folder: Path) -> Mapping[str, Calls]:
    """What is done to an L-system."""
    model = str(folder / "model.txt")

    def kept(system: Any) -> None:
        Path(model).write_text(str(system))

    return {
        **offered(MAKERS, folder),
        "derive": (lambda system: kit.derive(system, 25), LAST, str),
        "derive: all words": (lambda system: kit.derive(system, 8), lambda found: [str(word) for word in found]),
        "derive: many steps": (lambda system: kit.derive(system, 100_000), lambda found: found.lengths),
        "derive: arithmetic": (lambda system: kit.derive(system, 12, arithmetic="float"), LAST, str),
        "derive: symbols": (lambda system: kit.derive(system, 12, **symbols(system)), LAST, str),
        "derive: longest word": (longest, LAST, str),
        "explain": (lambda system: kit.derive(system, 7), lambda found: kit.explain(found, 7), repr),
        "explain: longest": (longest, lambda found: kit.explain(found, found.steps), repr),
        "draw": (lambda system: kit.draw(system, 12), SVG),
        "draw: longest": (longest, kit.draw, SVG),
        "draw: many seeds": (lambda system: kit.draw(system, seeds=range(9), n=6), SVG),
        "draw: large": (lambda system: kit.draw(system, 9, size=(4_000, 4_000)), saved(folder / "large.png")),
        **{f"save: {ending}": (longest_drawn, saved(folder / f"picture{ending}")) for ending in DRAWINGS},
        **{f"save: {ending}": (lambda system: kit.animate(system, 9), saved(folder / f"film{ending}")) for ending in FILMS},
        "save: .pnml": (kit.stages, kit.draw, saved(folder / "net.pnml")),
        "figure": (lambda system: kit.figure(system, n=6),),
        "animate": (lambda system: kit.animate(system, 9), lambda film: film.gif),
        "animate: longest": (longest, kit.animate, lambda film: film.gif),
        "animate: unfolding": (lambda system: kit.animate(system, 6, unfold=True), lambda film: film.gif),
        "animate: turntable": (lambda system: kit.animate(system, 6, turntable=True), lambda film: film.gif),
        "growth": (kit.growth, repr),
        "life_spans": (kit.life_spans, lambda found: found.plot()),
        "closing_angles": (lambda system: kit.closing_angles(system, 9), repr),
        "total": (lambda system: kit.total(system, system.axiom[0].symbol), repr),
        "growth: symbols": (lambda system: kit.growth(system, **symbols(system)), repr),
        "infer": (lambda system: kit.infer(kit.derive(system, 4)), repr),
        "infer: drawings": (lambda system: kit.infer([kit.draw(system, step) for step in range(4)]), repr),
        "infer: contexts": (lambda system: kit.infer(kit.derive(system, 4), context=(1, 1), erasing=True), repr),
        "rule_finder": (lambda system: kit.rule_finder(kit.derive(system, 4)), repr),
        "stages": (kit.stages, kit.draw, SVG),
        "stages: unfolded": (lambda system: kit.stages(system, unfold=True, polarity=True), kit.draw, SVG),
        "stages: symbols": (lambda system: kit.stages(system, **symbols(system)), kit.draw, SVG),
        "pnml": (kit.stages, kit.pnml),
        "timed": (kit.timed, lambda found: found.word(30), str),
        "timed: stages": (kit.timed, kit.stages, kit.draw, SVG),
        "lineage": (lambda system: kit.lineage(system, 9), kit.draw, SVG),
        "lineage: longest": (longest, kit.lineage, repr),
        "lineage: symbols": (lambda system: kit.lineage(system, 6, **symbols(system)), kit.draw, SVG),
        "lineage: in time": (kit.timed, lambda found: kit.lineage(found, 8), kit.draw, SVG),
        "continuity": (lambda system: kit.continuity(system, {}), repr),
        "explore": (lambda system: kit.explore(system, 9), lambda panel: panel.text),
        "compare": (lambda system: kit.compare(system, system, step=9), lambda found: found.text),
        "Explorer.answers: book": (kit.explore, asked(kind="book", constants={}, seed=3)),
        "Explorer.answers: rules": (
            lambda system: (kit.explore(kit.read(SMALL)), str(system)),
            lambda given: asked(kind="rules", text=given[1])(given[0]),
        ),
        "Explorer.answers: variants": (kit.explore, asked(kind="variants")),
        "Explorer.answers: page": (kit.explore, asked(kind="keep", what="page")),
        "Explorer.answers: drawing": (kit.explore, asked(kind="keep", what="drawing")),
        "variants": (lambda system: kit.variants(system, 9),),
        "link": (kit.link, kit.qr_code, SVG),
        "ensemble": (lambda system: kit.ensemble(system, 4, ["modules", "height"], progress=False), repr),
        "distances": (lambda system: kit.distances(system, system.axiom[0].symbol, 4), repr),
        "sweep": (lambda system: kit.sweep(system, [each.name for each in system.constants], progress=False), repr),
        "plot": (lambda system: kit.plot(system, 30), SVG),
        "plot: logarithm": (lambda system: kit.plot(system, 1_000, "A", log=True), SVG),
        "with_surface": (lambda system: kit.with_surface(system, "L", "0 0 0 0 0 1 0 1 0 0 1 1\n" * 4), kit.draw, SVG),
        "check": (lambda system: kit.check("1.3", str(system)),),
        "predict": (lambda system: kit.predict("What comes?", kit.draw(system, 9)),),
        "ask": (lambda system: kit.ask("How many has step 9?", system), repr),
        **{f"write: {name}": (lambda system, name=name: kit.write(system, name),) for name in DIALECTS},
        **{
            f"lsys-kit {line.partition(' ')[0]}: {line}": (
                kept,
                typed(*line.replace("MODEL", model).replace("OUT", str(folder)).split()),
            )
            for line in (
                "derive MODEL -n 12",
                "derive MODEL -n 100000 --counts",
                "derive MODEL -n 30 --json",
                "derive MODEL -n 1000000 --counts --json",
                "draw MODEL -n 9 -o OUT/a.png",
                "draw MODEL -n 9 -o OUT/a.gif",
                "draw MODEL -n 4,6,8 -o OUT/a.svg",
                "draw MODEL -n 9 -o OUT/a.glb",
                "stages MODEL -o OUT/net.pnml",
                "stages MODEL --unfold -o OUT/net.svg",
                "convert MODEL --to cpfg",
                "link MODEL --qr OUT/code.png",
                "page MODEL -o OUT/page.html",
                "wall OUT -o OUT/wall.html",
            )
        },
    }


def map_acts(folder: Path) -> Mapping[str, Calls]:
    """What is done to a map system."""
    return {
        **offered(MAP_MAKERS, folder),
        "derive: map": (lambda system: kit.derive(system, 25), LAST, str),
        "derive: many maps": (lambda system: kit.derive(system, 10**6), repr),
        "derive: longest": (longest, repr),
        "derive: longest map": (longest, LAST, str),
        "draw: longest map": (longest, kit.draw, SVG),
        "draw: map": (lambda system: kit.draw(system, 9), SVG),
        "draw: little damping": (lambda system: kit.draw(system, 6, damping=0.1, stiffness=100), SVG),
        "draw: relaxation": (lambda system: kit.draw(system, 5, iterations=[0, 10, 10**9]), SVG),
        "save: map": (lambda system: kit.draw(system, 5), saved(folder / "map.svg")),
        "animate: map": (lambda system: kit.animate(system, 6), lambda film: film.gif),
        "explore: map": (lambda system: kit.explore(system, 5), lambda panel: panel.text),
        "compare: maps": (lambda system: kit.compare(system, system), lambda found: found.text),
        "plot: map": (lambda system: kit.plot(system, 9), SVG),
        "link: map": (kit.link, kit.linked),
        "read_map": (str, kit.read_map),
    }


def cellwork_acts(folder: Path) -> Mapping[str, Calls]:
    """What is done to a cellwork system."""
    return {
        **offered(CELLWORK_MAKERS, folder),
        "derive: cellwork": (lambda system: kit.derive(system, 25), repr),
        "derive: longest cellwork": (longest, repr),
        "draw: cellwork": (lambda system: kit.draw(system, 9), SVG),
        "animate: cellwork": (lambda system: kit.animate(system, 6), lambda film: film.gif),
        "save: cells": (lambda system: kit.draw(system, 6), saved(folder / "cells.glb")),
        "explore: cellwork": (lambda system: kit.explore(system, 5), lambda panel: panel.text),
        "link: cellwork": (kit.link, kit.linked),
        "read_cellwork": (str, kit.read_cellwork),
    }


def word_acts(_: Path) -> Mapping[str, Calls]:
    """What is done to words and strokes whose rules are looked for."""
    contexts = ((0, 0), (1, 1), (9_000, 9_000))
    return {
        **{f"infer: context {size}": (partial(kit.infer, context=(size, size)), repr) for size, _ in contexts},
        "infer: erasing": (partial(kit.infer, erasing=True), repr),
        "rule_finder: words": (kit.rule_finder, repr),
        "rule_finder: contexts": (partial(kit.rule_finder, context=(1, 1)), repr),
        "RuleFinder.step": (kit.rule_finder, lambda found: setattr(found, "step", 10**9)),
    }


def text_acts(folder: Path) -> Mapping[str, Calls]:
    """What is done to a text."""
    small, path = kit.read(SMALL), folder / "text.txt"

    def kept(text: str) -> None:
        path.write_text(text, errors="replace")

    return {
        "read": (kit.read,),
        **{f"read: {name}": (partial(kit.read, notation=name),) for name in DIALECTS},
        "read_map: text": (kit.read_map,),
        "read_cellwork: text": (kit.read_cellwork,),
        "linked": (kit.linked,),
        "qr_code": (kit.qr_code, SVG),
        "with_surface: text": (lambda text: kit.with_surface(small, "L", text),),
        **{
            f"check: {exercise}": (partial(kit.check, exercise),)
            for exercise in ("0.1", "0.2", "0.3", "1.1", "1.3", "2.1", "5.5", "7.3", "10.5", "16.5", "17.1")
        },
        "Practice.check": (lambda text: kit.practice("derive", 1, 1).check(text),),
        "Explorer.answers: text": (lambda text: asked(kind="rules", text=text)(kit.explore(small)),),
        "Worksheet.asked": (lambda text: (kit.worksheet("01", "counts"), {"number": 1, "entries": [text]}), put("asked")),
        "Prompt.typed": (lambda text: (kit.predict("What comes?", "21").prompt, text), put("typed")),
        "lsys-kit convert: text": (kept, typed("convert", str(path), "--to", "abop")),
        "lsys-kit infer: text": (kept, typed("infer", str(path))),
        "lsys-kit infer: derivations": (kept, typed("infer", str(path), "--stochastic")),
        "lsys-kit wall: text": (kept, typed("wall", str(folder), "-o", str(folder / "wall.html"))),
        "lsys-kit collect": (
            lambda text: (folder / "book.ipynb").write_text(text, errors="replace"),
            typed("collect", str(folder), "-o", str(folder / "marks.csv")),
        ),
        "lsys-kit exercises": (
            lambda text: (folder / "own.toml").write_text(text, errors="replace"),
            typed("exercises", "check", str(folder)),
        ),
        "lsys-kit lesson: a declaration": (
            lambda text: lesson_of(folder, text, "A text."),
            typed("lesson", "check", str(folder / "course"), "--no-run"),
        ),
        "lsys-kit lesson: a notebook": (
            lambda text: lesson_of(folder, 'title = "Own"\nquestion = "?"\nminutes = 5\nobjectives = []\nsummary = "."', text),
            typed("lesson", "check", str(folder / "course"), "--no-run"),
        ),
        "exercises: own": (
            lambda text: (folder / "own.toml").write_text(text, errors="replace"),
            lambda _: kit.exercises(folder),
        ),
    }


NAMED: Mapping[str, tuple[tuple[object, ...], tuple[str, ...]]] = {
    "derive": ((), ("steps", "seed", "arithmetic", "c")),
    "growth": ((), ("c",)),
    "total": (("A",), ("parameter", "axis", "c")),
    "stages": ((), ("polarity", "unfold", "durations", "c")),
    "draw": (
        (),
        (
            "n",
            "angle",
            "size",
            "seeds",
            "steps",
            "marked",
            "cells",
            "view",
            "seed",
            "c",
            "labels",
            "colours",
            "widths",
            "light",
            "background",
        ),
    ),
    "animate": ((), ("n", "seconds", "size", "view")),
    "life_spans": ((), ("c",)),
    "closing_angles": ((), ("n", "c")),
    "lineage": ((), ("n", "seed", "c")),
    "explore": ((), ("step", "angle", "seed", "sliders", "unfold", "c")),
    "plot": ((2,), ("measure", "c", "log")),
    "ensemble": ((2,), ("measure", "steps", "c")),
    "sweep": (({"c": [1, 2]},), ("measure", "steps", "seed")),
    "distances": (("F",), ("seeds", "steps", "c")),
    "variants": ((), ("number", "seed")),
    "link": ((), ("settings", "base")),
    "write": ((), ("notation",)),
    "compare": (({"c": 1},), ("step", "sliders")),
    "with_surface": (("L",), ("text",)),
    "figure": ((), ("n", "angle")),
}
"""For functions of a system other arguments that they need, and those by name that get a value."""
FIRST = (
    "animate",
    "cellwork_system",
    "compare",
    "derive",
    "draw",
    "draw_hierarchy",
    "exercises",
    "explore",
    "figure",
    "growth",
    "infer",
    "language",
    "lineage",
    "link",
    "linked",
    "map_system",
    "plot",
    "pnml",
    "practice",
    "progress",
    "qr_code",
    "read",
    "read_cellwork",
    "read_map",
    "rule_finder",
    "score",
    "stages",
    "system",
    "timed",
    "variants",
    "vote",
    "write",
)
"""Functions whose first argument gets a value."""
ASKED: Mapping[str, tuple[str, ...]] = {
    "Growth": ("counts", "lengths", "length", "recurrence_of"),
    "Stages": ("expected", "tokens", "place_of", "line", "in_places", "fired"),
    "Derivation": ("to", "counts", "origins", "ancestors", "sight", "column", "__getitem__"),
    "Word": ("coded", "__getitem__"),
    "Picture": ("image", "drawing"),
    "Timed": ("word", "later", "division"),
    "Lineage": ("daughters",),
    "Table": ("where", "summary", "plot", "measured", "__getitem__"),
    "LSystem": ("picture",),
    "Continuity": ("solve",),
    "Fits": ("__getitem__",),
    "StochasticFits": ("__getitem__",),
    "Practice": ("check",),
}
"""Members of results that get a value."""


def value_acts(folder: Path) -> Mapping[str, Calls]:
    """What is done with a value of one argument."""
    plant = kit.read(f"angle: 20\nsteps: 3\n{SMALL}\ninterpretation:\na(x) -> F(1)[+F(1)]")
    ageing = kit.read("axiom: a(0)\na(1) -> a(0) b(0)\nb(1) -> a(0)")
    panel = partial(kit.explore, plant)
    makers = {
        **MAKERS,
        "Timed": lambda _: kit.timed(ageing),
        "Continuity": lambda _: kit.continuity(ageing, {}),
        "Word": lambda system: kit.derive(system, 3)[3],
        "Picture": lambda system: kit.draw(system, 3),
        "Lineage": lambda _: kit.lineage(kit.timed(ageing), 3),
        "Practice": lambda _: kit.practice("derive", 1, 1),
    }
    return {
        **{
            f"{name}: {key}": (
                lambda value, name=name, given=given, key=key: getattr(kit, name)(plant, *given, **{key: value}),
                shown,
            )
            for name, (given, keys) in NAMED.items()
            for key in keys
        },
        **{f"{name}: value": (getattr(kit, name), shown) for name in FIRST},
        **{
            f"{result}.{name}: value": (
                lambda value, result=result, name=name: getattr(makers[result](plant), name)(value),
                shown,
            )
            for result, names in ASKED.items()
            for name in names
        },
        "ensemble: seeds": (lambda value: kit.ensemble(plant, value, progress=False), repr),
        "sweep: over": (lambda value: kit.sweep(plant, value, progress=False), repr),
        "infer: constants": (partial(kit.infer, ["a+", "ab+"]), repr),
        "infer: context": (lambda value: kit.infer(["a", "ab"], context=value), repr),
        "infer: angle": (lambda value: kit.infer([[(0, 0, 0, 1)]] * 2, angle=value), repr),
        "rule_finder: constants": (partial(kit.rule_finder, ["a", "ab"]), repr),
        "check: value": (partial(kit.check, "1.1"), repr),
        "check: hint": (partial(kit.check, "1.1", "a"), repr),
        "practice: seed": (partial(kit.practice, "derive", 1), repr),
        "practice: level": (partial(kit.practice, "derive"), repr),
        "predict: question": (lambda value: kit.predict(value, 1), repr),
        "predict: what": (partial(kit.predict, "What?"), repr),
        "vote: again": (lambda value: kit.vote("01", again=value), repr),
        "vote: options": (partial(kit.vote, "Which?"), repr),
        "vote: right": (partial(kit.vote, "Which?", ["a", "b"]), repr),
        "vote: replies": (partial(kit.vote, "Which?", ["a", "b"], "A", None), repr),
        "ask": (lambda value: kit.ask(value, "J1", step=2), repr),
        "ask: system": (partial(kit.ask, "Step 3?"), repr),
        "ask: count": (partial(kit.ask, "Step 3?", "J1"), repr),
        "ask: step": (partial(kit.ask, "How many?", "J1", ""), repr),
        "worksheet: columns": (lambda value: kit.worksheet(columns=value, rows=[[1, {"right": 1}]]), repr),
        "worksheet: rows": (lambda value: kit.worksheet(columns=["step", "a"], rows=value), repr),
        "worksheet: cells": (lambda value: kit.worksheet(columns=["step", "a"], rows=[[1, value]], system="J1"), repr),
        "worksheet": (lambda value: kit.worksheet(value, "counts"),),
        "worksheet: table": (partial(kit.worksheet, "01"), repr),
        "explain: step": (partial(kit.explain, kit.derive(plant, 2)), repr),
        "continuity: lengths": (partial(kit.continuity, ageing), repr),
        "continuity: order": (partial(kit.continuity, ageing, {"a": "1"}), repr),
        "plot: in time": (partial(kit.plot, kit.timed(ageing)), shown),
        "pnml: net": (kit.pnml,),
        "limits": (lambda value: kit.limits(seconds=value).__enter__(),),
        "Growth.counts_of: steps": (partial(kit.growth(plant).counts_of, "a"), shown),
        "Picture.save: dots": (lambda value: kit.draw(plant, 3).save(folder / "dots.png", dpi=value),),
        "Explorer.answers: value": (lambda value: asked(kind="book", constants={"c": value}, seed=1)(panel()),),
        "Explorer.answers: letters": (lambda value: asked(kind="book", constants={}, seed=1, letters=value)(panel()),),
        "Explorer.settings": (lambda value: (panel(), {"c": value}), put("settings")),
        **{
            f"Explorer.{name}": (lambda value: (panel(), value), put(name))
            for name in ("model", "angle", "around", "above", "mark", "seed", "step", "letters")
        },
        **{
            f"Prompt.{name}": (lambda value: (kit.predict("What?", "21").prompt, value), put(name))
            for name in ("question", "revealed", "outcome", "words")
        },
        **{
            f"RuleFinder.{name}": (lambda value: (kit.rule_finder(["a", "ab"]), value), put(name))
            for name in ("found", "words", "step")
        },
        **{
            f"VoteBox.{name}": (lambda value: (kit.vote("01"), value), put(name))
            for name in ("asked", "chosen", "said", "words")
        },
        **{
            f"Worksheet.{name}": (lambda value: (kit.worksheet("01", "counts"), value), put(name))
            for name in ("asked", "result", "sheet", "typed", "words")
        },
        "Worksheet.asked: entries": (lambda value: (kit.worksheet("01", "counts"), {"entries": value}), put("asked")),
    }


def shown(result: Any) -> object:
    """A result as a notebook shows it."""
    return [repr(result), getattr(result, "svg", None)]


def _nothing_grows(*names: str) -> Mapping[str, str]:
    return dict.fromkeys(names, "it is handed nothing that could grow")


LEFT_OUT: Mapping[str, str] = {
    **_nothing_grows(
        "book_systems",
        "cellwork_systems",
        "map_systems",
        "systems",
        "lsys-kit list",
        "ExerciseList.__repr__",
        "lsys-kit site",
        "lsys-kit lite",
        "Place.__repr__",
        "VoteBox.close",
        "VoteBox.page_data",
        "VoteBox.__repr__",
        "Worksheet.close",
        "Worksheet.entries",
        "PanelWithWorksheet.close",
        "PanelWithWorksheet.__repr__",
        "Worksheet.page_data",
        "Worksheet.__repr__",
        "Progress.count",
        "Progress.state",
        "Progress.__repr__",
        "Verdict.__repr__",
        "Verdict.described",
        "Verdict.with_more",
        "Mending.__repr__",
        "Practice.next",
        "Practice.__repr__",
        "Comparison.left",
        "Comparison.right",
        "Comparison.shared",
    ),
    **dict.fromkeys(
        (
            "lsys-kit lab",
            "lsys-kit class",
            "open_class",
            *(f"ClassBoard.{name}" for name in (*members("ClassBoard"), "__repr__", "about", "state", "ended")),
        ),
        "it serves until it is closed",
    ),
    **{f"HierarchyPicture.{name}": "it has one picture alone" for name in (*members("HierarchyPicture"), "__repr__")},
}
"""The public ways that are not tried, and why."""
GROUPS: tuple[tuple[Mapping[str, Any], Callable[[Any], Any], Callable[[Path], Mapping[str, Calls]]], ...] = (
    (BOMBS, kit.read, acts),
    (MAPS, kit.read_map, map_acts),
    (CELLWORKS, kit.read_cellwork, cellwork_acts),
    (WORDS, made, word_acts),
    (TEXTS, str, text_acts),
    (VALUES, made, value_acts),
)
"""Each kind of bombs, how one is taken from the table, and what is done with it."""
