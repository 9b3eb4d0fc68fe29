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
    """A system of any kind, opened.

    Parameters
    ----------
    system
        An L-system, a map system or a cellwork system.
    title
        What it is called in the catalogue.
    changes
        First values of its constants, or of its forces.
    without
        Those of them that have no slider, and stay as they are; what is no constant or force of this system is passed over.
    unfold
        The symbols that are unfolded in the stage diagram of an L-system, as for `stages`, as far as that is possible.

    Raises
    ------
    LSystemError
        A value makes no sense.
    """
    if isinstance(system, CellSystem):
        return OpenedCells(system, title, changes, without)
    return OpenedSystem(system, title, changes, without, unfold)
