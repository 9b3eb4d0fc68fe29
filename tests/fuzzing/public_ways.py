"""All public ways into the kit: what a person can call, ask of a result, type into a shell, read, write, or send from a
browser."""

from __future__ import annotations

import argparse
import inspect
import pkgutil
import re
import sys
from collections.abc import Iterator
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path
from typing import Any, get_args, get_origin

import traitlets

import lsys_kit as kit
from lsys_kit.__main__ import _argument_parser
from lsys_kit.errors import LSystemError
from lsys_kit.notation.registry import DIALECTS

PARTS = (
    "lsys_kit.notation.model.",
    "lsys_kit.derivation.core.states",
    "lsys_kit.derivation.core.rules",
    "lsys_kit.derivation.tissues.edges",
    "lsys_kit.classroom.catalogue",
    "lsys_kit.budget",
)
"""Rooms whose records results are made of: nobody asks these for work, but systems."""
SYSTEMS = ("LSystem", "MapSystem", "CellworkSystem")
HINT = re.compile(r"\.\w+")


def public_ways() -> set[str]:
    """The names of all."""
    return {
        *functions(),
        *commands(),
        *formats(),
        *answers(),
        *(f"{result}.{name}" for result in results() for name in (*members(result), "__repr__")),
    }


def functions() -> Iterator[str]:
    """The public functions."""
    return (name for name in kit.__all__ if not isinstance(getattr(kit, name), type))


def commands() -> Iterator[str]:
    """The commands of the shell."""
    actions = _argument_parser()._actions
    return (f"lsys-kit {name}" for each in actions if isinstance(each, argparse._SubParsersAction) for name in each.choices)


def formats() -> Iterator[str]:
    """The notations, and the endings of the names of pictures and films, as a refusal lists them."""
    yield from (f"{way}: {name}" for way in ("read", "write") for name in DIALECTS)
    plant = kit.read("axiom: F")
    for picture in (kit.draw(plant, 1), kit.draw(kit.stages(plant)), kit.animate(plant, 1)):
        try:
            picture.save(Path("a.unknown"))
        except LSystemError as error:
            yield from (f"save: {ending}" for ending in HINT.findall((error.hint or "").partition(". ")[0]))


def answers() -> Iterator[str]:
    """What a browser may set: the traits of widgets that are kept alike on both sides; and that a panel answers."""
    from lsys_kit.classroom.lessons.predict import Prompt

    for name, found in {**results(), "Prompt": Prompt}.items():
        if issubclass(found, traitlets.HasTraits):
            own = (each for each in found.class_traits(sync=True) if not each.startswith("_"))
            yield from (
                f"{name}.{each}"
                for each in own
                if any(each in vars(base) for base in found.__mro__ if base.__module__.startswith("lsys_kit"))
            )
    yield "Explorer.answers"


@cache
def results() -> dict[str, type]:
    """The classes of what public functions return, and of what these offer in turn, by name."""
    found: dict[str, type] = {}
    todo = [returned for name in functions() for returned in _returned(getattr(kit, name))] + [kit.Table]
    while todo:
        one = todo.pop()
        if one.__name__ not in found and (one.__name__ in SYSTEMS or not one.__module__.startswith(PARTS)):
            found[one.__name__] = one
            todo += [each for _, member in _public(one) for each in _returned(member)]
            todo += [
                each for base in getattr(one, "__orig_bases__", ()) if _is_ours(get_origin(base)) for each in get_args(base)
            ]
    return found


def _is_ours(found: Any) -> bool:
    return isinstance(found, type) and found.__module__.startswith("lsys_kit")


def members(result: str) -> list[str]:
    """What a result offers of its own: properties and methods."""
    return [name for name, _ in _public(results()[result])]


def _public(found: type) -> Iterator[tuple[str, Any]]:
    """The properties and methods of a class that are the kit's own, each with its function."""
    for name, member in inspect.getmembers_static(found):
        function = (
            member.fget
            if isinstance(member, property)
            else member.func
            if isinstance(member, cached_property)
            else inspect.unwrap(member)
            if inspect.isfunction(member)
            else None
        )
        public = not name.startswith("_") or name in ("__getitem__", "__iter__")
        if function is not None and public and function.__module__.startswith("lsys_kit"):
            yield name, function


def _returned(function: Any) -> Iterator[type]:
    """The classes of the kit that stand in what a function says that it returns."""
    todo = [str(inspect.signature(function).return_annotation)]
    while todo:
        for name in re.findall(r"[A-Z]\w*", todo.pop()):
            found = getattr(sys.modules[function.__module__], name, None) or _classes().get(name)
            todo += [found] if isinstance(found, str) else []  # another name of several classes
            yield from (
                each for each in (found, *get_args(found)) if isinstance(each, type) and each.__module__.startswith("lsys_kit")
            )


@cache
def _classes() -> dict[str, type]:
    """All classes of the kit by name, for those that are named for type checkers alone."""
    modules = [
        import_module(each.name)
        for each in pkgutil.walk_packages(kit.__path__, "lsys_kit.")
        if not each.name.endswith("__main__")
    ]
    return {
        name: found
        for module in modules
        for name, found in vars(module).items()
        if isinstance(found, type) and found.__module__ == module.__name__
    }
