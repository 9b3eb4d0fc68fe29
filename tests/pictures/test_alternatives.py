"""Every picture that a notebook shows has a text alternative."""

from __future__ import annotations

import re
from html import escape

import pytest

from lsys_kit import cellwork_system, draw, draw_hierarchy, ensemble, lineage, map_system, plot, qr_code, stages, sweep, system

SPANS = {"lifeTimeA": [2, 3], "lifeTimeB": [2, 3]}
PICTURES = {
    "a filament": lambda: draw(system("J1"), 2),
    "a plant": lambda: draw(system("K5"), 2),
    "a stage diagram": lambda: draw(stages(system("J4"))),
    "a lineage": lambda: draw(lineage(system("P6"), 2)),
    "a map": lambda: draw(map_system("K28"), 1),
    "a map on a sphere": lambda: draw(map_system("K34"), 1),
    "a plot": lambda: plot(system("J1"), 5),
    "a distribution": lambda: ensemble(system("K7"), 5, steps=2).plot(),
    "frequencies": lambda: plot(stages(system("P2")), 9),
    "a grid": lambda: sweep(system("J4"), SPANS, steps=5).plot(),
    "a cellwork": lambda: draw(cellwork_system("K33"), 1),
    "the hierarchy": draw_hierarchy,
    "a code": lambda: qr_code("text"),
}


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_in_a_notebook_says_what_it_shows(name):
    picture = PICTURES[name]()
    bundle = picture._repr_mimebundle_()
    assert set(bundle) == {"text/html", "image/svg+xml", "text/plain"}
    assert re.match(r'<img alt="([^"]*)"', bundle["text/html"])[1] == escape(repr(picture)) != ""
