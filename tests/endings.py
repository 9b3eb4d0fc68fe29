"""The endings of files to which pictures are written, as the kit has them, for all tests that go through them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lsys_kit import draw, map_system, read, stages
from lsys_kit.pictures.formats.notebook import FILMS as _FILMS
from lsys_kit.pictures.formats.notebook import listed


def endings_of(picture: Any) -> tuple[str, ...]:
    """The endings of the files to which a picture can be written."""
    return (*picture._encoders(Path("a.svg"), None)[0],)


FLAT = endings_of(draw(map_system("K28"), 0))
"""Those of all pictures."""
DRAWINGS, NETS = endings_of(draw(read("axiom: F"), 0)), endings_of(draw(stages(read("axiom: F"))))
"""Those of what a turtle has drawn, and of a stage diagram."""
MESHES = tuple(ending for ending in DRAWINGS if ending not in FLAT)
FILMS = _FILMS
BEGINNINGS: Mapping[str, bytes] = {
    ".svg": b"<svg",
    ".png": b"\x89PNG",
    ".pdf": b"%PDF",
    ".glb": b"glTF",
    ".obj": b"# A drawing",
    ".gif": b"GIF89a",
    ".apng": b"\x89PNG",
}
"""How the bytes of files begin; those of a film in .mp4 and of a net in .pnml do not say what they are so soon."""
SAID_OF_FLAT, SAID_OF_DRAWINGS, SAID_OF_FILMS = map(listed, (FLAT, DRAWINGS, FILMS))
"""The same in a sentence, as messages have them."""


def beginnings(*endings: str) -> list[tuple[str, bytes]]:
    """Endings, each with how the bytes of such a file begin."""
    return [(ending, BEGINNINGS[ending]) for ending in endings]
