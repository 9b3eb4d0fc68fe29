"""The catalogue: L-systems in the folder `systems`, map systems in `maps`, cellwork systems in `cellworks`, a TOML file each.

Beside them, in the folder `book`, stand the figures of The Algorithmic Beauty of Plants, whose ids are their numbers there.

A file holds the rules in their own notation, where they were printed, what is wrong in print, and the words that must come
out. A system is asked for by its id, which is the name of its file, or by its telling name. A file is read when its system is
first asked for; all files are read when a name, not an id, is first looked up.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from itertools import groupby
from types import MappingProxyType
from typing import Any

from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.dialects.cellwork.dialect import read_cellwork
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.model.cells import CellworkSystem, MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem, read

WORKS = MappingProxyType(
    {
        "Jacob": "C. Jacob, Modeling Growth with L-Systems & Mathematica",
        "textbook": "Lindenmayer Systems (textbook)",
        "Prusinkiewicz": "P. Prusinkiewicz, Introduction to Modeling with L-systems",
        "Kurth": "W. Kurth, L-Systeme (lecture slides)",
        "applet lesson": "Lesson 2 - String Rewriting (lesson of a plant applet)",
        "ABOP": "P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants",
        "kit": "Models of substances in cells (made for this kit)",
    }
)
"""The works from which the systems come, in the order in which the catalogue lists them."""


@dataclass(frozen=True)
class Entry:
    """What the catalogue knows about a system.

    Attributes
    ----------
    id, name, title
        What it is called: "J4", "anabaena-life-spans", and a line of text.
    work, source
        A key of `WORKS`, and where in that work the system stands.
    status
        "as printed" where the rules stand in the work, "corrected" where the print had to be corrected; "found" where the work
        has only a picture and the source names where the rules were found, "memory" where they are known from the literature
        and were not read again, "reconstruction" where they were made for this kit.
    notation, rules
        The rules, as text in a notation.
    errata
        What is wrong in print, a sentence each.
    notes
        What else a reader should know, a sentence each.
    words
        The words, maps or cellworks of some steps, where chance has no part in them.
    lengths
        The number of modules, or walls, at steps 0, 1, 2, ..., as far as they were checked, where chance has no part in them.
    same_as
        The id of the system that this one repeats, or None.
    """

    id: str
    name: str
    title: str
    work: str
    source: str
    status: str
    notation: str
    rules: str
    errata: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    words: Mapping[int, str] = field(default_factory=dict, hash=False)
    lengths: tuple[int, ...] = ()
    same_as: str | None = None


SYSTEMS, BOOK, MAPS, CELLWORKS = "systems", "book", "maps", "cellworks"
_KINDS = {
    SYSTEMS: ("an L-system", "system"),
    BOOK: ("an L-system", "system"),
    MAPS: ("a map system", "map_system"),
    CELLWORKS: ("a cellwork system", "cellwork_system"),
}
"""What each folder holds, and the function that returns it."""
MOST_LISTED = 40
_NAME_PATTERN = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


class Catalogue(tuple[str, ...]):
    """The ids of the systems, shown with names and titles under the works from which they come."""

    __slots__ = ()

    def __repr__(self) -> str:
        entries = [entry(id) for id in self]
        width, wide = (
            max((len(text) for text in texts), default=0) for texts in ((e.id for e in entries), (e.name for e in entries))
        )
        return "\n".join(
            line
            for work, group in groupby(entries, lambda e: e.work)
            for line in (WORKS[work], *(f"  {e.id:<{width}}  {e.name:<{wide}}  {e.title}" for e in group))
        )


def system(id: str) -> LSystem:
    """The L-system with an id or a name, in capitals or not.

    Parameters
    ----------
    id
        One of `systems()` or `book_systems()`, or the name listed beside it.

    Raises
    ------
    ModelNameError
        No system is called that.
    ModelValueError
        A map system or a cellwork system is.

    Examples
    --------
    >>> print(system("j1").productions[0])
    ar -> al br
    >>> system("anabaena-life-spans") == system("J4")
    True
    >>> print(system("ABOP-1.24a").productions[0])
    F -> F[+F]F[-F]F
    """
    found: LSystem = _parsed(_known(id, SYSTEMS, BOOK))
    return found


def map_system(id: str) -> MapSystem:
    """The map system with an id or a name, in capitals or not; errors are those of `system`.

    >>> print(map_system("k28").productions[0])
    A -> B[-A][+A]B
    """
    found: MapSystem = _parsed(_known(id, MAPS))
    return found


def cellwork_system(id: str) -> CellworkSystem:
    """The cellwork system with an id or a name, in capitals or not; errors are those of `system`.

    >>> print(cellwork_system("k33").productions[0])
    P: * -> R [PQ: PR|P|PR, PQ] [PR: QR|Q|QR, PQ] R
    """
    found: CellworkSystem = _parsed(_known(id, CELLWORKS))
    return found


def systems() -> Catalogue:
    """All L-systems of the catalogue, grouped by the works from which they come.

    >>> "P4" in systems()
    True
    >>> print("\\n".join(repr(systems()).splitlines()[:2]))
    C. Jacob, Modeling Growth with L-Systems & Mathematica
      J1   anabaena-polarity                Anabaena catenula: long and short cells with a polarity
    """
    return _catalogue(SYSTEMS)


def book_systems() -> Catalogue:
    """The figures of The Algorithmic Beauty of Plants (1990) of which the catalogue has the L-systems, by their numbers.

    Their rules are read as they are printed; `system` returns each.

    >>> "ABOP-1.24a" in book_systems()
    True
    >>> print("\\n".join(repr(book_systems()).splitlines()[:2]))
    P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants
      ABOP-1.6   quadratic-koch-island     Quadratic Koch island
    """
    return _catalogue(BOOK)


def map_systems() -> Catalogue:
    """All map systems of the catalogue, grouped by the works from which they come.

    >>> print("\\n".join(repr(map_systems()).splitlines()[:2]))
    W. Kurth, L-Systeme (lecture slides)
      K28  map-crosswise-divisions   A map whose cells divide crosswise
    """
    return _catalogue(MAPS)


def cellwork_systems() -> Catalogue:
    """All cellwork systems of the catalogue, grouped by the works from which they come."""
    return _catalogue(CELLWORKS)


def _catalogue(folder: str) -> Catalogue:
    works = list(WORKS)
    return Catalogue(sorted(_ids(folder).values(), key=lambda id: (works.index(_entry(id).work), _natural(id))))


def entry(id: str) -> Entry:
    """What the catalogue knows about a system of any kind, given its id or its name.

    >>> entry("P4").words[1]
    'M(2,-1)M(1,1)'
    >>> entry("anabaena-life-spans").id
    'J4'
    """
    return _entry(_known(id, next((folder for folder in _KINDS if _id_of(id, folder)), SYSTEMS)))


def cell_system(id: str) -> MapSystem | CellworkSystem | None:
    """The map system or the cellwork system with an id or a name; None, if there is none.

    >>> cell_system("K28") == map_system("map-crosswise-divisions"), cell_system("P4")
    (True, None)
    """
    known = next(filter(None, (_id_of(id, folder) for folder in (MAPS, CELLWORKS))), None)
    found: MapSystem | CellworkSystem | None = _parsed(known) if known else None
    return found


def catalogued(id: str) -> AnySystem:
    """The system of an id or of a name in the catalogue, of any kind.

    >>> catalogued("K28").axiom == catalogued("K5").axiom
    False
    """
    return cell_system(id) or system(id)


def likely_system(id: str, others: Iterable[str] = ()) -> str | None:
    """A hint that names the L-system of the catalogue that was probably meant, or another likely spelling.

    >>> likely_system("anabaena-lifespans")
    'Did you mean "anabaena-life-spans"?'
    """
    return _suggestion(id, (SYSTEMS, BOOK), others)


def _known(id: str, *folders: str) -> str:
    """The id as the catalogue writes it, of a system in one of the folders that is asked for by its id or its name."""
    if not isinstance(id, str):
        raise ModelValueError(f'The id or name of a system must be a text such as "P4", not {type(id).__name__}')
    known = next(filter(None, (_id_of(id, folder) for folder in folders)), None)
    if known is not None:
        return known
    for other, (kind, function) in _KINDS.items():
        elsewhere = _id_of(id, other)
        if elsewhere is not None:
            raise ModelValueError(
                f"{elsewhere} is {kind}, not {_KINDS[folders[0]][0]}", hint=f'It is returned by {function}("{elsewhere}").'
            )
    shown = id if len(id) <= 30 else f"{id[:30]}..."
    hint = _suggestion(id, folders) or _listed(sorted(_ids(folders[0]).values(), key=_natural))
    raise ModelNameError(f'The catalogue has no system "{shown}"', hint=hint)


def _listed(ids: Sequence[str]) -> str:
    """A hint with the first ids, no longer than a reader takes in."""
    more = f" and {len(ids) - MOST_LISTED} more, which systems() lists" if len(ids) > MOST_LISTED else ""
    return f"Systems are: {', '.join(ids[:MOST_LISTED])}{more}."


def _id_of(id: str, folder: str) -> str | None:
    spelt = id.strip().lower() if isinstance(id, str) else ""
    return _ids(folder).get(spelt) or (_ids_by_name(folder).get(spelt) if _NAME_PATTERN.fullmatch(spelt) else None)


def _suggestion(id: str, folders: Iterable[str], others: Iterable[str] = ()) -> str | None:
    """A hint that names an id or else a name that is spelt alike; ids are in capitals and names are not."""
    ids = [known for folder in folders for known in _ids(folder).values()]
    names = [name for folder in folders for name in _ids_by_name(folder)]
    return suggestion(id[:40], [*others, *ids]) or suggestion(id[:40].upper(), ids) or suggestion(id[:40].lower(), names)


@cache
def _ids(folder: str) -> Mapping[str, str]:
    """The ids, by their small letters; known from the names of the files alone."""
    names = (file.name.removesuffix(".toml") for file in _folder(folder).iterdir() if file.name.endswith(".toml"))
    return {name.lower(): name for name in names}


@cache
def _ids_by_name(folder: str) -> Mapping[str, str]:
    return {_entry(id).name: id for id in _ids(folder).values()}


def _folder(folder: str) -> Traversable:
    return files(__package__) / folder


@cache
def _entry(id: str) -> Entry:
    folder = next(folder for folder in _KINDS if id.lower() in _ids(folder))
    fields = tomllib.loads((_folder(folder) / f"{id}.toml").read_text(encoding="utf-8"))
    for name in ("errata", "notes", "lengths"):
        fields[name] = tuple(fields.get(name, ()))
    words = {int(step): word for step, word in fields.pop("words", {}).items()}
    return Entry(**fields, words=MappingProxyType(words))


@cache
def _parsed(id: str) -> Any:
    found = _entry(id)
    for folder, reads in ((MAPS, read_map), (CELLWORKS, read_cellwork)):
        if id.lower() in _ids(folder):
            return reads(found.rules)
    return read(found.rules, found.notation)


def _natural(id: str) -> list[str | int]:
    """Sorts P2 before P10, P9 before P9w, and ABOP-1.9a before ABOP-1.24a.

    >>> _natural("P9w")
    ['P', 9, 'w']
    """
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", id)]
