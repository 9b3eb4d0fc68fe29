"""The kinds of systems that the panel can show."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from lsys_kit.classroom.panel.books.net import Unfolding
from lsys_kit.classroom.panel.opened.maps import OpenedMap
from lsys_kit.classroom.panel.opened.opened import Opened
from lsys_kit.classroom.panel.opened.systems import OpenedSystem
from lsys_kit.classroom.panel.opened.tissues import OpenedTissue
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem


def opened(
    system: LSystem | MapSystem | CellworkSystem,
    title: str = "",
    changes: Mapping[str, object] | None = None,
    without: Collection[str] = (),
    unfold: Unfolding = False,
) -> Opened:
    """A system of any kind, opened, with what it is called in the catalogue, first values of its constants or forces, and
    those of them that have no slider; what is none of this system is passed over. Its stage diagram is unfolded as far as that
    is possible.
    """
    if isinstance(system, CellworkSystem) or (isinstance(system, MapSystem) and system.sphere):
        return OpenedTissue(system, title, changes, without)
    if isinstance(system, MapSystem):
        return OpenedMap(system, title, changes, without)
    return OpenedSystem(system, title, changes, without, unfold)
