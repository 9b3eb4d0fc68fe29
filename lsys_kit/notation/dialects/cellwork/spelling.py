"""The problems of cellworks in words, and how messages spell what they quote of a cellwork."""

from __future__ import annotations

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.syntax.wording import Spelling, Wording

MARKER = (
    'A marker reads "[PQ: PR|P|PR, PQ]": the wall that is divided, its daughters on both sides of the new edge, the new wall.'
)
RULE_EXAMPLE = 'A production reads "P: * -> R [PQ: PR|P|PR, PQ] R": an edge, walls, an arrow, edges with markers between.'
SPELLING = Spelling(
    words={"rule_example": RULE_EXAMPLE, "name_rule": "Edges are letters from A to Z, walls names of such letters."},
    patterns={"READABLE": "[→⟶]"},
    wordings={
        "number too large": Wording("This number is too large"),
        "no first cell": Wording("There is no first cell", 'Give its corners, as in "cellwork: 1(0,0,0) 2(1,0,0) ...".'),
        "corner twice": Wording("The corner {corner} is given twice", "Give each corner a number of its own.", ModelValueError),
        "unknown corner": Wording(
            "The wall {wall} has a corner {corner}, which is not given", 'Give it a place behind "cellwork:".', ModelValueError
        ),
        "wall without inside": Wording(
            "This wall has only {corners} corners", "A wall has three corners or more.", ModelValueError
        ),
        "corner twice in wall": Wording(
            "The wall {wall} comes to corner {corner} twice",
            "Its corners are met once each on the way around it.",
            ModelValueError,
        ),
        "first cell not closed": Wording(
            "The first cell is not closed: the edge {edge} belongs to {count}",
            "Each edge of a closed cell belongs to two of its walls.",
            ModelValueError,
        ),
        "edge of two kinds": Wording(
            "The edge {edge} is {one} in one wall and {other} in another",
            "Give it the same letter and direction in both.",
            ModelValueError,
        ),
        "first cell in parts": Wording(
            "The walls of the first cell are no single closed surface: vertices less edges and walls are {euler}, not 2",
            "A cell is one piece without holes, and each corner belongs to it.",
            ModelValueError,
        ),
        "setting twice": Wording('"{keyword}:" is set a second time', "Keep one of the two lines."),
        "edge against its direction": Wording(
            "A production is written in the direction of its edge",
            'Write "{turned}: ...": what becomes of the edge, from its beginning to its end.',
            ModelValueError,
        ),
        "second production of edge": Wording(
            "This is a second production for {edge} in the same walls",
            "The first one would always be applied.",
            ModelValueError,
        ),
        "second production of wall": Wording(
            "This is a second production for the wall {wall}", "A wall that is not divided becomes one wall.", ModelValueError
        ),
        "edge erased": Wording(
            "Nothing is left of the edge {edge}", "Edges are never erased: write the letter of an edge too.", ModelValueError
        ),
        "marker at end": Wording(
            "This marker is at the end of the edge",
            "Markers belong between two edges, where there is a new vertex.",
            ModelValueError,
        ),
        "neutral edge not symmetric": Wording(
            "The neutral edge {edge} would become something else from its other end",
            'Read backwards, this is "{backwards}", and an edge without an arrow has no beginning. '
            'Make both the same, or give the edge an arrow: "{edge}>: ...".',
            ModelValueError,
        ),
        "edge never occurs": Wording("The production {production} is never used: no edge {edge} occurs."),
        "wall never occurs": Wording("The marker {marker} divides no wall: no wall {wall} occurs."),
        "marker without partner": Wording("Markers {marker} divide no wall: they need markers {partner}, and there are none."),
    },
)
"""Edges and walls in place of modules."""
