"""Where in a notebook a panel stands, so that a browser knows it again when its cell is run once more."""

from __future__ import annotations

import sys

from lsys_kit.files import Entries

_made: dict[str, int] = {}
"""The run of a cell that has made panels last, and how many."""


def standing() -> str:
    """The id of the cell that is run, and which of its panels the next one is; nothing where cells have no ids.

    Examples
    --------
    >>> standing()
    ''
    """
    if "IPython" not in sys.modules:
        return ""
    from IPython.core.getipython import get_ipython

    asked: Entries = getattr(get_ipython(), "get_parent", dict)()
    cell = asked.get("metadata", {}).get("cellId")
    if not cell:
        return ""
    run = asked["header"]["msg_id"]
    before = _made.get(run, 0)
    _made.clear()
    _made[run] = before + 1
    return f"{cell} {before + 1}"
