"""The problems of maps in words, and how messages spell what they quote of a map."""

from __future__ import annotations

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.syntax.wording import Spelling, Wording

RULE_EXAMPLE = 'A production reads "A -> B[-A][+A]B": a wall, an arrow, the walls that it becomes, with markers between.'
SPELLING = Spelling(
    words={"rule_example": RULE_EXAMPLE, "name_rule": "Walls are letters from A to Z."},
    patterns={"READABLE": "[→⟶ω−]"},
    wordings={
        "number too large": Wording("This number is too large"),
        "no first cell": Wording("There is no first cell", 'Give its walls, one after another, clockwise, as in "map: ABAB".'),
        "second cell": Wording("This is a second first cell", "A map begins with one cell."),
        "cell without inside": Wording(
            "The first cell has only {walls}", 'A cell has three walls or more, as in "map: AAA".', ModelValueError
        ),
        "undivided sphere": Wording(
            "The sphere has only {walls} from pole to pole",
            'Two walls or more divide it into cells, as in "sphere: D>D>D>D>".',
            ModelValueError,
        ),
        "wall against its direction": Wording(
            "A production is written in the direction of its wall",
            'Write "{turned} -> ...": what becomes of the wall, from its beginning to its end.',
            ModelValueError,
        ),
        "second production of wall": Wording(
            "This is a second production for {wall}",
            "A wall has at most one production. With an arrow and without, walls are different ones.",
            ModelValueError,
        ),
        "wall erased": Wording(
            "Nothing is left of the wall {wall}", "Walls are never erased: write the letter of a wall too.", ModelValueError
        ),
        "marker at end": Wording(
            "This marker is at the end of the wall",
            'Markers belong between two parts of a wall, as in "A -> B[-A]B".',
            ModelValueError,
        ),
        "neutral wall not symmetric": Wording(
            "The neutral wall {wall} would become something else from its other end",
            'Read backwards, where left is right, this is "{backwards}", and a wall without an arrow has no beginning. '
            'Make both the same, or give the wall an arrow: "{wall}> -> ...".',
            ModelValueError,
        ),
        "wall never occurs": Wording("The production {production} is never used: no wall {wall} occurs."),
        "marker without partner": Wording(
            "Markers of {wall} divide no cell: they need markers of {partner}, and there are none."
        ),
    },
)
"""Walls in place of modules."""
