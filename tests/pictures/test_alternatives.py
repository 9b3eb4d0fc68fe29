"""Every picture that a notebook shows has a text alternative."""

from __future__ import annotations

import re
from html import escape

import pytest

from lsys_kit import cellwork_system, draw, draw_hierarchy, lineage, map_system, qr_code, stages, system

PICTURES = {
    "a filament": lambda: draw(system("J1"), 2), "a plant": lambda: draw(system("K5"), 2),
    "a stage diagram": lambda: draw(stages(system("J4"))), "a lineage": lambda: draw(lineage(system("P6"), 2)),
    "a map": lambda: draw(map_system("K28"), 1), "a map on a sphere": lambda: draw(map_system("K34"), 1),
    "a cellwork": lambda: draw(cellwork_system("K33"), 1), "the hierarchy": draw_hierarchy, "a code": lambda: qr_code("text"),
}


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_in_a_notebook_says_what_it_shows(name):
    picture = PICTURES[name]()
    bundle = picture._repr_mimebundle_()
    assert set(bundle) == {"text/html", "image/svg+xml", "text/plain"}
    assert re.match(r'<img alt="([^"]*)"', bundle["text/html"])[1] == escape(repr(picture)) != ""
