"""lsys_kit: a teaching kit on Lindenmayer systems.

Type rules, and see them as a word, as a stage diagram and as a drawing:

>>> from lsys_kit import derive, system
>>> derive(system("J1"), 3)
0 ar
1 al br
2 bl ar ar
3 al al br al br

Every public name is listed in `__all__`, and stands with its home in `__init__.pyi`. Each is loaded when it is first used, so
that `import lsys_kit` is fast.
"""

from __future__ import annotations

import re
from importlib import import_module
from os.path import dirname, join

with open(join(dirname(__file__), "__init__.pyi"), encoding="utf-8") as _stub:
    _HOMES = {name: home for home, name in re.findall(r"^from (lsys_kit\S+) import (\w+) as", _stub.read(), re.MULTILINE)}

__all__ = sorted(_HOMES)


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return __all__


def load_ipython_extension(shell: object) -> None:
    """Called by `%load_ext lsys_kit` in a notebook, whose cells may then begin with `%%lsystem NAME` and hold a model."""
    import_module("lsys_kit.classroom.magic").load(shell)
