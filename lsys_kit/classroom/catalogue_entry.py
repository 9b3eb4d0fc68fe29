"""What the catalogue says of a system, and the works from which its systems come."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

WORKS = MappingProxyType(
    {
        "Jacob": "C. Jacob, Modeling Growth with L-Systems & Mathematica",
        "textbook": "Lindenmayer Systems (textbook)",
        "Prusinkiewicz": "P. Prusinkiewicz, Introduction to Modeling with L-systems",
        "Kurth": "W. Kurth, L-Systeme (lecture slides)",
        "applet lesson": "Lesson 2 - String Rewriting (lesson of a plant applet)",
        "ABOP": "P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants",
    }
)
"""The works from which the systems come, in the order in which the catalogue lists them."""


@dataclass(frozen=True)
class Entry:
    """What the catalogue knows about a system.

    Attributes
    ----------
    id, name, title
        What it is called: "J4", "anabaena-life-spans", and a line of text.
    work, source
        A key of `WORKS`, and where in that work the system stands.
    status
        "as printed" where the rules stand in the work, "corrected" where the print had to be corrected; "found" where the work
        has only a picture and the source names where the rules were found, "memory" where they are known from the literature
        and were not read again, "reconstruction" where they were made for this kit.
    notation, rules
        The rules, as text in a notation.
    errata
        What is wrong in print, a sentence each.
    notes
        What else a reader should know, a sentence each.
    words
        The words, maps or cellworks of some steps, where chance has no part in them.
    lengths
        The number of modules, or walls, at steps 0, 1, 2, ..., as far as they were checked, where chance has no part in them.
    same_as
        The id of the system that this one repeats, or None.
    """

    id: str
    name: str
    title: str
    work: str
    source: str
    status: str
    notation: str
    rules: str
    errata: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    words: Mapping[int, str] = field(default_factory=dict, hash=False)
    lengths: tuple[int, ...] = ()
    same_as: str | None = None
