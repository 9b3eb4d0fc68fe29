"""The catalogue: the systems of the seeds by their ids, each a TOML file that explains itself; those of L-systems stand in the
folder `systems`, those of map systems in `maps`.

A file holds the rules in their own notation, where they were printed, what is wrong with the print, and the words that
must come out. A file is read when its system is first asked for.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from types import MappingProxyType
from typing import Any

from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read

SYSTEMS, MAPS = "systems", "maps"
"""The folders."""


@dataclass(frozen=True)
class Entry:
    """What the catalogue knows about a system.

    Attributes
    ----------
    id, title
        What it is called.
    seed, source
        The seed document, and where in it the system stands.
    status
        "seed" where the rules stand in the seed, "seed, corrected" where the print had to be corrected; "found" where the seed
        has only a picture and the source names where the rules were found, "memory" where they are known from the literature
        and were not read again, "reconstruction" where they were made for this kit.
    notation, rules
        The rules, as text in a notation.
    errata
        What is wrong in the print, a sentence each.
    notes
        What else a reader should know, a sentence each.
    words
        Some steps and their words, or maps, as far as chance has no part in them.
    lengths
        The number of modules, or walls, at steps 0, 1, 2, ..., as far as they were checked and chance has no part in them.
    same_as
        The id of the system that this one repeats, or None.
    """

    id: str
    title: str
    seed: str
    source: str
    status: str
    notation: str
    rules: str
    errata: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    words: Mapping[int, str] = field(default_factory=dict, hash=False)
    lengths: tuple[int, ...] = ()
    same_as: str | None = None


class Catalogue(tuple[str, ...]):
    """The ids of the systems, shown as a list with titles."""

    __slots__ = ()

    def __repr__(self) -> str:
        width = max(map(len, self), default=0)
        return "\n".join(f"{e.id:<{width}}  seed {e.seed}  {e.title}" for e in map(entry, self))


def system(id: str) -> LSystem:
    """The system with an id, whatever its case.

    Parameters
    ----------
    id
        One of `systems()`.

    Raises
    ------
    ModelNameError
        No system has that id.
    ModelValueError
        It is that of a map system.

    Examples
    --------
    >>> print(system("j1").productions[0])
    ar -> al br
    """
    return _system(_known(id, SYSTEMS))


def map_system(id: str) -> MapSystem:
    """The map system with an id, whatever its case.

    Parameters
    ----------
    id
        One of `map_systems()`.

    Raises
    ------
    ModelNameError
        No map system has that id.
    ModelValueError
        It is that of an L-system.

    Examples
    --------
    >>> print(map_system("k28").productions[0])
    A -> B[-A][+A]B
    """
    return _map_system(_known(id, MAPS))


def systems() -> Catalogue:
    """All systems of the catalogue, in the order of the seeds.

    >>> "P4" in systems()
    True
    >>> print(repr(systems()).splitlines()[0])
    J1    seed 000  Anabaena catenula: long and short cells with a polarity
    """
    return _catalogue(SYSTEMS)


def map_systems() -> Catalogue:
    """All map systems of the catalogue, in the order of the seeds.

    >>> print(repr(map_systems()).splitlines()[0])
    K28  seed 003  A map whose cells divide crosswise
    """
    return _catalogue(MAPS)


def _catalogue(folder: str) -> Catalogue:
    return Catalogue(sorted(_ids(folder).values(), key=lambda id: (entry(id).seed, _natural(id))))


def entry(id: str) -> Entry:
    """What the catalogue knows about a system, be it an L-system or a map system.

    Raises
    ------
    ModelNameError
        No system has that id.

    Examples
    --------
    >>> entry("P4").words[1]
    'M(2,-1)M(1,1)'
    """
    return _entry(_known(id, MAPS if _is_in(id, MAPS) else SYSTEMS))


def _is_in(id: str, folder: str) -> bool:
    return isinstance(id, str) and id.strip().upper() in _ids(folder)


def _known(id: str, folder: str) -> str:
    """The id as the catalogue writes it."""
    if not isinstance(id, str):
        raise ModelValueError(f"A system is asked for by its id, a text such as \"P4\", not by {type(id).__name__}")
    if _is_in(id, folder):
        return _ids(folder)[id.strip().upper()]
    for other, kind, function in ((MAPS, "a map system, and no L-system", "map_system"),
                                  (SYSTEMS, "an L-system, and no map system", "system")):
        if _is_in(id, other):
            raise ModelValueError(f"{id.strip().upper()} is {kind}", hint=f'{function}("{id.strip().upper()}") gives it.')
    ids, shown = _ids(folder).values(), id if len(id) <= 20 else f"{id[:20]}..."
    hint = suggestion(id[:20].upper(), ids) or f"Systems are: {', '.join(sorted(ids, key=_natural))}."
    raise ModelNameError(f'The catalogue has no system "{shown}"', hint=hint)


@cache
def _ids(folder: str) -> Mapping[str, str]:
    """The ids, by their capital letters; known from the names of the files alone."""
    names = (file.name.removesuffix(".toml") for file in _folder(folder).iterdir() if file.name.endswith(".toml"))
    return {name.upper(): name for name in names}


def _folder(folder: str) -> Traversable:
    return files(__package__) / folder


@cache
def _entry(id: str) -> Entry:
    folder = MAPS if _is_in(id, MAPS) else SYSTEMS
    fields: dict[str, Any] = tomllib.loads((_folder(folder) / f"{id}.toml").read_text(encoding="utf-8"))
    for name in ("errata", "notes", "lengths"):
        fields[name] = tuple(fields.get(name, ()))
    words = {int(step): word for step, word in fields.pop("words", {}).items()}
    return Entry(**fields, words=MappingProxyType(words))


@cache
def _system(id: str) -> LSystem:
    found = _entry(id)
    return read(found.rules, found.notation)


@cache
def _map_system(id: str) -> MapSystem:
    return read_map(_entry(id).rules)


def _natural(id: str) -> tuple[str, int, str]:
    """Sorts P2 before P10, and P9 before P9w."""
    letters, digits, rest = re.fullmatch(r"(\D*)(\d*)(\D*)", id).groups()  # type: ignore[union-attr]
    return letters, int(digits or 0), rest
