"""The kinds of systems that the panel can show."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from lsys_kit.classroom.panel.books.net import Unfolding
from lsys_kit.classroom.panel.opened.cells import OpenedCells
from lsys_kit.classroom.panel.opened.opened import Opened
from lsys_kit.classroom.panel.opened.systems import OpenedSystem
from lsys_kit.notation.model.cells import CellSystem
from lsys_kit.notation.read import AnySystem


def opened(
    system: AnySystem,
    title: str = "",
    changes: Mapping[str, object] | None = None,
    without: Collection[str] = (),
    unfold: Unfolding = False,
) -> Opened:
    """A system of any kind, opened, with what it is called in the catalogue, first values of its constants or forces, and
    those of them that have no slider; what is none of this system is passed over. Its stage diagram is unfolded as far as that
    is possible.
    """
    if isinstance(system, CellSystem):
        return OpenedCells(system, title, changes, without)
    return OpenedSystem(system, title, changes, without, unfold)
