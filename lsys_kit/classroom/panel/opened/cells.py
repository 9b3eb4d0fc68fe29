"""Systems of cells in the panel: their sliders are the forces under which the cells come to rest."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any, Generic, Protocol, TypeVar

from lsys_kit.cache import Cache
from lsys_kit.classroom.link import STEP, link
from lsys_kit.classroom.panel.opened.opened import Sight, Viewing, read_any
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.geometry.tissues.relaxation import Forces
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.tissues.forces import forces_of

SERIES = tuple(map(Fraction, ("1", "1.2", "1.5", "2", "2.5", "3", "4", "5", "6", "8")))
"""Of each power of ten a slider offers these multiples, each about a quarter more than the one before."""


def _decades(*powers: str) -> tuple[Value, ...]:
    """The values of a slider: some powers of ten and what lies between them."""
    parts = [number * Fraction(power) for power in powers[:-1] for number in SERIES]
    return tuple(map(normalised, (*parts, Fraction(powers[-1]))))


VALUES: Mapping[str, tuple[Value, ...]] = MappingProxyType(
    {
        "stiffness": _decades("0.1", "1", "10"),
        "rest": tuple(normalised(Fraction(part, 20)) for part in range(21)),
        "pressure": _decades("0.01", "0.1", "1"),
        "damping": _decades("0.1", "1", "10"),
    }
)
"""The values of the sliders of the forces, where a kind of system has no others."""
SHARE = 1 / 8
"""The part of the limit of bytes up to which cells at rest are kept."""
LONGEST = 160
"""How many characters of the cells are told."""


class AtRest(Protocol):
    """The cells of some steps at rest."""

    @property
    def last(self) -> int:
        """The last step."""
        ...

    @property
    def end(self) -> str:
        """Why there are no more steps; "" if nothing is in the way."""
        ...


Found = TypeVar("Found", bound=AtRest)


@dataclass(frozen=True)
class Kind(Generic[Found]):
    """What the kinds of systems of cells differ in.

    Attributes
    ----------
    called, page, notation
        What a system is called in a message, what its page is called, and the name of its notation.
    sides
        What its cells are bounded by.
    usual, values
        The usual forces, and the values of their sliders.
    view
        The side from which it is seen first.
    reader, first_step
        How it is read, and the step that is shown first.
    at_rest, size
        Its cells at rest under some forces, up to the usual step or to a later one, and what they take in memory, in bytes.
    """

    called: str
    page: str
    notation: str
    sides: str
    usual: Forces
    values: Mapping[str, tuple[Value, ...]]
    view: tuple[int, int]
    reader: Callable[[str], Any]
    first_step: Callable[[Any], int]
    at_rest: Callable[[Any, Forces, int], Found]
    size: Callable[[Found], int]


@dataclass(frozen=True)
class CellSight:
    """What there is to see of cells at a step.

    Attributes
    ----------
    step, size, found, picture
        The step, how many vertices, walls and cells there are, in words, the map or cellwork, and the picture of it.
    """

    step: int
    size: str
    found: object
    picture: Sight

    @property
    def svg(self) -> str:
        return self.picture.svg

    def __str__(self) -> str:
        cells = str(self.found)
        return f"Step {self.step}: {self.size}. {cells if len(cells) <= LONGEST else cells[:LONGEST] + '...'}"


class OpenedCells(Generic[Found]):
    """A system of cells that the panel shows, with the sliders of its forces: what all kinds of them have in common.

    Raises
    ------
    LSystemError
        There is no such force, or it is too small or too great.
    """

    def __init__(
        self, system: Any, title: str, changes: Mapping[str, object] | None, without: Collection[str], of: Kind[Found]
    ) -> None:
        self.system, self.title, self._of = system, title, of
        self.kind, self.side, self.hint = of.page, of.view, f"the force of cells and {of.sides}:"
        forces = forces_of(dict(changes or {}), of.usual, of.called)
        given = {name: exact(getattr(forces, name)) for name in VALUES}
        self.first: Mapping[str, Value] = {name: value for name, value in given.items() if name not in without}
        self.fixed: Mapping[str, Value] = {name: value for name, value in given.items() if name in without}
        self.declared: Mapping[str, Value] = {name: exact(getattr(of.usual, name)) for name in VALUES}
        self.given: Mapping[str, Any] = self.fixed
        self.values: Mapping[str, Sequence[Value]] = {
            name: tuple(sorted({*of.values[name], value})) for name, value in self.first.items()
        }
        self._kept = Cache[tuple[Forces, int], Found](of.size, SHARE)

    @property
    def steps(self) -> int:
        return self._of.first_step(self.system)

    @property
    def angle(self) -> float:
        return 0.0

    def turned(self, angle: object) -> float:
        if angle is not None:
            raise ModelValueError(
                f"A {self._of.called} has no angle", hint=f"Its cells come to rest under the forces of its {self._of.sides}."
            )
        return 0.0

    def link(self, chosen: Viewing) -> str:
        return link(self.system, {STEP: chosen.step, **self.fixed, **chosen.values})

    def at_rest(self, values: Mapping[str, Value], least: int) -> Found:
        """The cells under some forces, up to the usual step or to a later one."""
        forces = Forces(**{name: float(value) for name, value in {**self.fixed, **values}.items()})
        usual = self.steps
        found = self._kept.found((forces, usual), lambda: self._of.at_rest(self.system, forces, 0))
        if found.last >= least:
            return found
        return self._kept.found((forces, least), lambda: self._of.at_rest(self.system, forces, least))

    def shown(self, chosen: Viewing) -> Found:
        """The cells with the step that is chosen.

        Raises
        ------
        ModelValueError
            It is not reached.
        """
        found = self.at_rest(chosen.values, chosen.step)
        if chosen.step > found.last:
            raise ModelValueError(f"The panel shows steps 0 to {found.last}, not {chosen.step}", hint=found.end)
        return found

    def own(self) -> dict[str, Any]:
        """The system, as a page has it."""
        return {"notation": self._of.notation, "text": str(self.system), "angle": 0}

    def read(self, text: str) -> LSystem | MapSystem | CellworkSystem:
        """The text as a system of the same kind; where it makes sense as another only, as that."""
        try:
            found: LSystem | MapSystem | CellworkSystem = self._of.reader(text)
        except LSystemError as error:
            try:
                return read_any(text)
            except LSystemError:
                raise error from None
        return found

    def variants(self, many: int) -> Sequence[LSystem]:
        return ()


def exact(number: float) -> Value:
    """The value that is written with the fewest digits among those nearest to a number.

    >>> exact(0.1), exact(1.0)
    (Fraction(1, 10), 1)
    """
    return normalised(Fraction(repr(number)))
