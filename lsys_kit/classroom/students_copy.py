"""A lesson as a student gets it: nothing that it will show is there yet, and it says how a cell is run.

The lessons that come with the kit keep what they show, for people who read them without running them.
"""

from __future__ import annotations

import json
from typing import Any

HOW_TO_RUN = """\
**How to work with this page.** Click into a grey box, a *cell*, and press **Shift + Enter**: the cell is run, and what it shows
appears below it. Run the cells one after another, from the top. To change something, type in the cell and run it again. If
nothing helps, choose *Kernel* and then *Restart Kernel* in the menu, and begin at the top."""
"""The text that a student's copy has after its title."""
HOW_TO_RUN_ID = "how-to-run-a-cell"


def students_copy(content: bytes) -> bytes:
    """A notebook without what its cells show, and with a text on how they are run; anything else as it is.

    >>> cells = [{"cell_type": "markdown", "source": ["# Title"]},
    ...          {"cell_type": "code", "source": ["1 + 1"], "outputs": [{}], "execution_count": 1}]
    >>> copy = json.loads(students_copy(json.dumps({"cells": cells}).encode()))
    >>> [cell.get("outputs") for cell in copy["cells"]], copy["cells"][1]["id"]
    ([None, None, []], 'how-to-run-a-cell')
    """
    try:
        notebook = json.loads(content)
        notebook["cells"] = [_unrun(cell) for cell in notebook["cells"]]
        notebook["cells"].insert(1, _text_cell())
    except (ValueError, TypeError, KeyError, AttributeError):
        return content
    return (json.dumps(notebook, indent=1, ensure_ascii=False, sort_keys=True) + "\n").encode()


def _unrun(cell: dict[str, Any]) -> dict[str, Any]:
    return {**cell, "outputs": [], "execution_count": None} if cell["cell_type"] == "code" else cell


def _text_cell() -> dict[str, Any]:
    return {"cell_type": "markdown", "id": HOW_TO_RUN_ID, "metadata": {}, "source": HOW_TO_RUN.splitlines(keepends=True)}
