"""lsys_kit: a teaching kit on Lindenmayer systems.

Type rules, and see them as a word, as a stage diagram and as a drawing:

>>> from lsys_kit import derive, system
>>> derive(system("J1"), 3)
0 ar
1 al br
2 bl ar ar
3 al al br al br

Every public name is listed in `__all__`. Each is loaded when it is first used, so that `import lsys_kit` is fast.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lsys_kit.budget import limits
    from lsys_kit.classroom.catalogue import (
        book_systems,
        cellwork_system,
        cellwork_systems,
        map_system,
        map_systems,
        system,
        systems,
    )
    from lsys_kit.classroom.exercises.check import check
    from lsys_kit.classroom.exercises.declared.registry import exercises
    from lsys_kit.classroom.exercises.practice.practice import practice
    from lsys_kit.classroom.exercises.progress.progress import progress
    from lsys_kit.classroom.exercises.progress.scores import score
    from lsys_kit.classroom.lessons.predict import predict
    from lsys_kit.classroom.lessons.rule_finder import rule_finder
    from lsys_kit.classroom.lessons.vote import vote
    from lsys_kit.classroom.lessons.worksheet import worksheet
    from lsys_kit.classroom.link import link, linked
    from lsys_kit.classroom.panel.explorer import compare, explore
    from lsys_kit.classroom.variants import variants
    from lsys_kit.derivation.explain import explain
    from lsys_kit.derivation.growth.growth import growth
    from lsys_kit.derivation.petri.pnml import pnml
    from lsys_kit.derivation.petri.stages import stages
    from lsys_kit.derivation.timed.continuity import continuity
    from lsys_kit.derivation.timed.lineage import lineage
    from lsys_kit.derivation.timed.timed import timed
    from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError
    from lsys_kit.experiments.plot import plot
    from lsys_kit.experiments.runs import ensemble, sweep
    from lsys_kit.experiments.table import Table
    from lsys_kit.geometry.inference.infer import infer
    from lsys_kit.notation.dialects.cellwork.dialect import read_cellwork
    from lsys_kit.notation.dialects.cpfg.surface_files import with_surface
    from lsys_kit.notation.dialects.map.dialect import read_map
    from lsys_kit.notation.read import read
    from lsys_kit.notation.write import write
    from lsys_kit.pictures.draw import draw, figure
    from lsys_kit.pictures.films import animate
    from lsys_kit.pictures.hierarchy import draw_hierarchy
    from lsys_kit.pictures.qr_codes import qr_code
    from lsys_kit.translation import language
    from lsys_kit.worlds.derive import derive

_HOMES = {
    "LSystemError": "errors",
    "ModelFileError": "errors",
    "ModelLimitError": "errors",
    "ModelNameError": "errors",
    "ModelSyntaxError": "errors",
    "ModelValueError": "errors",
    "animate": "pictures.films",
    "book_systems": "classroom.catalogue",
    "cellwork_system": "classroom.catalogue",
    "cellwork_systems": "classroom.catalogue",
    "check": "classroom.exercises.check",
    "compare": "classroom.panel.explorer",
    "continuity": "derivation.timed.continuity",
    "derive": "worlds.derive",
    "draw": "pictures.draw",
    "draw_hierarchy": "pictures.hierarchy",
    "Table": "experiments.table",
    "ensemble": "experiments.runs",
    "plot": "experiments.plot",
    "sweep": "experiments.runs",
    "exercises": "classroom.exercises.declared.registry",
    "explain": "derivation.explain",
    "explore": "classroom.panel.explorer",
    "figure": "pictures.draw",
    "growth": "derivation.growth.growth",
    "infer": "geometry.inference.infer",
    "language": "translation",
    "limits": "budget",
    "link": "classroom.link",
    "linked": "classroom.link",
    "lineage": "derivation.timed.lineage",
    "map_system": "classroom.catalogue",
    "map_systems": "classroom.catalogue",
    "pnml": "derivation.petri.pnml",
    "practice": "classroom.exercises.practice.practice",
    "predict": "classroom.lessons.predict",
    "progress": "classroom.exercises.progress.progress",
    "qr_code": "pictures.qr_codes",
    "read": "notation.read",
    "read_cellwork": "notation.dialects.cellwork.dialect",
    "read_map": "notation.dialects.map.dialect",
    "rule_finder": "classroom.lessons.rule_finder",
    "score": "classroom.exercises.progress.scores",
    "stages": "derivation.petri.stages",
    "system": "classroom.catalogue",
    "systems": "classroom.catalogue",
    "timed": "derivation.timed.timed",
    "variants": "classroom.variants",
    "vote": "classroom.lessons.vote",
    "worksheet": "classroom.lessons.worksheet",
    "with_surface": "notation.dialects.cpfg.surface_files",
    "write": "notation.write",
}

__all__ = [
    "LSystemError",
    "ModelFileError",
    "ModelLimitError",
    "ModelNameError",
    "ModelSyntaxError",
    "ModelValueError",
    "Table",
    "animate",
    "book_systems",
    "cellwork_system",
    "cellwork_systems",
    "check",
    "compare",
    "continuity",
    "derive",
    "draw",
    "draw_hierarchy",
    "ensemble",
    "exercises",
    "explain",
    "explore",
    "figure",
    "growth",
    "infer",
    "language",
    "limits",
    "lineage",
    "link",
    "linked",
    "map_system",
    "map_systems",
    "plot",
    "pnml",
    "practice",
    "predict",
    "progress",
    "qr_code",
    "read",
    "read_cellwork",
    "read_map",
    "rule_finder",
    "score",
    "stages",
    "sweep",
    "system",
    "systems",
    "timed",
    "variants",
    "vote",
    "with_surface",
    "worksheet",
    "write",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"lsys_kit.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return __all__


def load_ipython_extension(shell: Any) -> None:
    """Called by `%load_ext lsys_kit` in a notebook, whose cells may then begin with `%%lsystem NAME` and hold a model."""
    from lsys_kit.classroom.magic import load

    load(shell)
