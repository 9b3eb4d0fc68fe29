"""What the panel can show: a system that was opened, with its sliders, its books, and what is to be seen of it at a step."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem


@dataclass(frozen=True)
class Viewing:
    """What is chosen in a panel: a step; the values of the sliders and the seed; the angle, the side from which a plant is
    seen, and the label of the stage that is marked, empty for none."""

    step: int
    values: Mapping[str, Value]
    seed: int
    angle: float
    around: int = 0
    above: int = 0
    mark: str = ""
    letters: tuple[str, ...] = ()


class Sight(Protocol):
    """What there is to see at a step; `str` of it says so in words."""

    def told(self, show: Collection[str]) -> str:
        """The same in words, for those who see some views."""
        ...

    @property
    def svg(self) -> str:
        """Its picture as SVG text."""
        ...

    @property
    def picture(self) -> Any:
        """Its picture."""
        ...


class Opened(Protocol):
    """A system that the panel shows.

    Attributes
    ----------
    system, title
        The system, and what it is called in the catalogue; empty where it is not in it.
    first, values
        For each slider its first value, and all its values.
    fixed
        The values of those constants or forces that could have a slider, and have none.
    declared
        The values of all constants as the text declares them, or the usual forces.
    given
        The values of what has no slider, where they were given instead of those declared, or could have one.
    hint
        What the sliders are, for a tip; empty for constants.
    kind
        What its page is called, if it is not in the catalogue.
    """

    system: Any
    title: str
    first: Mapping[str, Value]
    values: Mapping[str, Sequence[Value]]
    fixed: Mapping[str, Value]
    declared: Mapping[str, Value]
    given: Mapping[str, Value]
    hint: str
    kind: str

    @property
    def side(self) -> tuple[int, int]:
        """From which side it is seen first, if it is in space: degrees around and above."""
        ...

    @property
    def steps(self) -> int:
        """The step that is shown first, if none is asked for."""
        ...

    @property
    def angle(self) -> float:
        """The angle of the turtle's turns as its slider has it."""
        ...

    def turned(self, angle: object) -> float:
        """The angle of the turtle's turns, or the system's own if none is given."""
        ...

    @property
    def lettered(self) -> Sequence[str]:
        """The constants that can be letters."""
        ...

    def book(self, values: Mapping[str, Value], seed: int, least: int, letters: Collection[str] = ()) -> Data:
        """The book for some values of the sliders, which holds a step if it can be reached; with some constants as letters."""
        ...

    def sight(self, chosen: Viewing) -> Sight:
        """What there is to see."""
        ...

    def still(self, chosen: Viewing, show: Collection[str] = ...) -> Mapping[str, str]:
        """A picture of it for a page without a kernel, by the type of the data: in base 64, or SVG text; of an L-system with
        those of its word, stages and drawing that are to be shown."""
        ...

    def page_data(self, chosen: Viewing, asked: Sequence[Mapping[str, object]] = ()) -> Data:
        """What a page that shows it without a kernel has to know. Settings that are asked for are there before others, where a
        page cannot hold all of them."""
        ...

    def link(self, chosen: Viewing) -> str:
        """An address with the system and what is chosen in it."""
        ...

    def read(self, text: str) -> AnySystem:
        """Read a text that was typed in place of the system's own."""
        ...

    def variants(self, many: int) -> Sequence[LSystem]:
        """So many systems that differ from this one a little; none, where it has no variants."""
        ...
