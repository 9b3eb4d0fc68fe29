"""What is done to a model, by public functions and by what their results offer: each a row of calls, of which each is handed
what the one before has made."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import lsys_kit as kit

Calls: TypeAlias = tuple[Callable[[Any], Any], ...]
LAST, SVG = lambda found: found[-1], lambda found: found.svg


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


def acts(folder: Path) -> Mapping[str, Calls]:
    """What is done to an L-system."""
    return {
        "derive": (lambda system: kit.derive(system, 25), LAST, str),
        "all words": (lambda system: kit.derive(system, 8), lambda found: [str(word) for word in found]),
        "many steps": (lambda system: kit.derive(system, 100_000), lambda found: found.lengths),
        "column": (lambda system: kit.derive(system, 9), repr),
        "origins": (lambda system: kit.derive(system, 9), lambda found: found.ancestors(9)),
        "arithmetic": (lambda system: kit.derive(system, 12, arithmetic="float"), LAST, str),
        "symbols": (lambda system: kit.derive(system, 12, **symbols(system)), LAST, str),
        "explain": (lambda system: kit.derive(system, 7), lambda found: kit.explain(found, 7), repr),
        "draw": (lambda system: kit.draw(system, 12), SVG),
        **{name: (lambda system: kit.draw(system, 12), saved(folder / f"picture.{name}"))
           for name in ("png", "pdf", "glb", "obj")},
        "figure": (lambda system: kit.figure(system, n=6),),
        "animate": (lambda system: kit.animate(system, 9), lambda film: film.gif),
        "growth": (kit.growth, repr),
        "infer": (lambda system: kit.infer(kit.derive(system, 4)), repr),
        "rule finder": (lambda system: kit.rule_finder(kit.derive(system, 4)), repr),
        "infer from drawings": (lambda system: kit.infer([kit.draw(system, step) for step in range(4)]), repr),
        "infer contexts": (lambda system: kit.infer(kit.derive(system, 4), context=(1, 1), erasing=True), repr),
        "growth of symbols": (lambda system: kit.growth(system, **symbols(system)), repr),
        "lengths": (kit.growth, lambda found: found.lengths(10**6)),
        "late counts": (kit.growth, lambda found: found.counts(10**6)),
        "closed form": (kit.growth, lambda found: found.closed_form),
        "frequencies": (kit.growth, lambda found: (found.frequencies, found.rate)),
        "characteristic": (kit.growth, lambda found: found.characteristic),
        "stages": (kit.stages, kit.draw, SVG),
        "stages of symbols": (lambda system: kit.stages(system, **symbols(system)), kit.draw, SVG),
        "expected": (kit.stages, lambda net: net.expected(30_000)),
        "pnml": (kit.stages, kit.pnml),
        "timed": (kit.timed, lambda found: found.word(30), str),
        "timed stages": (kit.timed, kit.stages, kit.draw, SVG),
        "lineage": (lambda system: kit.lineage(system, 9), kit.draw, SVG),
        "lineage of symbols": (lambda system: kit.lineage(system, 6, **symbols(system)), kit.draw, SVG),
        "timed lineage": (kit.timed, lambda found: kit.lineage(found, 8), kit.draw, SVG),
        "continuity": (lambda system: kit.continuity(system, {}), repr),
        "explore": (lambda system: kit.explore(system, 9), lambda panel: panel.text),
        "check": (lambda system: kit.check(next(each.id for each in kit.exercises() if each.kind == "system"), str(system)),),
        "write": (lambda system: kit.write(system, "cpfg"),),
        "longest word": (longest, LAST, str),
        "longest drawn": (longest, kit.draw, SVG),
        "longest saved": (longest, kit.draw, saved(folder / "long.png")),
        "longest in space": (longest, kit.draw, saved(folder / "long.glb")),
        "longest as text": (longest, kit.draw, saved(folder / "long.obj")),
        "longest filmed": (longest, kit.animate, lambda film: film.gif),
        "longest explained": (longest, lambda found: kit.explain(found, found.steps), repr),
        "longest traced": (longest, kit.lineage, repr),
    }


def map_acts(folder: Path) -> Mapping[str, Calls]:
    """What is done to a map system."""
    return {
        "derive": (lambda system: kit.derive(system, 25), LAST, str),
        "many steps": (lambda system: kit.derive(system, 10**6), repr),
        "longest": (longest, repr),
        "longest map": (longest, LAST, str),
        "longest drawn": (longest, kit.draw, SVG),
        "counts": (longest, lambda found: found.counts),
        "draw": (lambda system: kit.draw(system, 9), SVG),
        "little damping": (lambda system: kit.draw(system, 6, damping=0.1, stiffness=100), SVG),
        "relaxation": (lambda system: kit.draw(system, 5, iterations=[0, 10, 10**9]), SVG),
        "save": (lambda system: kit.draw(system, 5), saved(folder / "map.svg")),
        "written": (str, kit.read_map),
    }
