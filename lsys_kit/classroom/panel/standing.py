"""Where in a notebook a panel stands, so that a browser knows it again when its cell is run once more."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

_made = {"run": "", "panels": 0}
"""The run of a cell that has made panels, and how many."""


def standing() -> str:
    """The id of the cell that is run, and which of its panels the next one is; nothing where cells have no ids.

    Examples
    --------
    >>> standing()
    ''
    """
    from IPython.core.getipython import get_ipython

    asked = getattr(get_ipython(), "get_parent", dict)()
    return _numbered(asked.get("metadata", {}).get("cellId", ""), asked.get("header", {}))


def _numbered(cell: str, header: Mapping[str, Any]) -> str:
    if not cell:
        return ""
    if _made["run"] != header["msg_id"]:
        _made.update(run=header["msg_id"], panels=0)
    _made["panels"] += 1
    return f"{cell} {_made['panels']}"
