"""What is found in a lesson: where it is, what is wrong, and what to try."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files

_FINDINGS: Mapping[str, Mapping[str, Sequence[str]]] = tomllib.loads((files(__package__) / "findings.toml").read_text("utf-8"))


@dataclass(frozen=True)
class Finding:
    """A mistake, which keeps something from working, or a piece of advice.

    >>> print(Finding("ferns.ipynb, cell 3", "The vote does not come again", advice=True))
    ferns.ipynb, cell 3: advice: The vote does not come again.
    """

    where: str
    what: str
    hint: str = ""
    advice: bool = False

    def __str__(self) -> str:
        what = self.what if self.what.endswith((".", "?", "!")) else f"{self.what}."
        return f"{self.where}: {'advice: ' * self.advice}{what} {self.hint}".rstrip()


def finding(where: str, name: str, /, **values: object) -> Finding:
    """What `findings.toml` says of something."""
    kind = next(kind for kind, said in _FINDINGS.items() if name in said)
    what, hint = (text.format(**{"hint": "", **values}) for text in _FINDINGS[kind][name])
    return Finding(where, what, hint, kind == "advice")
