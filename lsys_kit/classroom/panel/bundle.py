"""The scripts of the panel, joined into one text: a widget and a page without a kernel each take a single module.

The scripts are modules of JavaScript that import one another by name. Joined, they share one scope; so what they import is
there already, and no two of them may define the same name.
"""

from __future__ import annotations

import re
from functools import cache
from graphlib import TopologicalSorter
from importlib.resources import files

_IMPORT = re.compile(r'^import \{[^}]*\} from "\./(\w+)\.js";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function|const|class) )", re.MULTILINE)


@cache
def bundled(name: str) -> str:
    """A script after all scripts that it needs.

    >>> bundled("widget").count("import ")
    0
    """
    needed: dict[str, set[str]] = {}
    todo = [name]
    while todo:
        script = todo.pop()
        if script not in needed:
            needed[script] = set(_IMPORT.findall(source(script)))
            todo += needed[script]
    order = TopologicalSorter({script: sorted(needed[script]) for script in sorted(needed)}).static_order()
    return "\n".join(_EXPORT.sub("", _IMPORT.sub("", source(script))) for script in order)


@cache
def source(name: str) -> str:
    """A script as it was written."""
    return (files(__package__) / "scripts" / f"{name}.js").read_text(encoding="utf-8")


@cache
def style() -> str:
    """The style of the panel."""
    return (files(__package__) / "scripts" / "panel.css").read_text(encoding="utf-8")
