"""The names of the panel's views and controls, and how they are used, in the chosen language.

What the panel says of a model stays in English, like the kit's errors: the line with its size, what becomes of a module,
mistakes. So no sentence is in two languages. So do the controls that only maps have: relaxation, forces, the signs of walls.
"""

from __future__ import annotations

from lsys_kit.translation import gettext

LABELS = (
    "rules",
    "word",
    "stages",
    "drawing",
    "how many",
    "nine seeds",
    "nine variants",
    "views",
    "show or hide: {title}",
    "{title} on the whole screen",
    "class",
    "larger, for a projector",
    "{name}, slider",
    "step",
    "the step of the derivation",
    "angle",
    "degrees by which the turtle turns",
    "around",
    "the side from which it is seen: 0 is the front, 90 the right",
    "above",
    "the height from which it is seen: 0 is the side, 90 the top",
    "mark",
    "the stage that is marked in all views",
    "no stage",
    "size",
    "one scale for all steps, or each step as large as it fits",
    "fit each step",
    "one scale",
    "seed",
    "the seed of the random numbers",
    "another seed, at random",
    "reset",
    "back to the first settings",
    "play",
    "pause",
    "one step back",
    "one step on",
    "to step 0",
    "speed",
    "how long each step is shown",
    "slow",
    "normal",
    "fast",
    "loop",
    "take along",
    "take along:",
    "take along: {text}",
    "to be copied",
    "keep the drawing as a PNG picture",
    "page",
    "link",
    "code",
    "the line of Python that makes this panel as it stands",
    "copied",
    "copy it from here:",
    "kept as {name}",
    "rules of the model",
    "back to the first rules",
    "put back the rules with which the panel was opened",
    "+, − or, after a click, the wheel zooms; arrows move it, Home puts it back.",
    "Drag or arrow keys turn it. +, − or, after a click, the wheel zooms; Shift and arrows move it, Home puts it back.",
    "Point at a part or click it to trace it; N and P go to the next and previous one.",
    "Point at a wall or click it to trace it; N and P go to the next and previous one.",
    "Point at a cell or click it to trace it; N and P go to the next and previous one.",
)
"""What the scripts of the panel show by themselves."""


def translated_labels() -> dict[str, dict[str, str]]:
    """What a panel must know to show them: nothing in English.

    >>> translated_labels()
    {}
    """
    words = {label: gettext(label) for label in LABELS if gettext(label) != label}
    return {"words": words} if words else {}
