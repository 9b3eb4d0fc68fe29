"""The constants that the scripts of the panel share with the kit, written from the kit's own.

    python -m tests.shared_constants   # renews lsys_kit/classroom/panel/scripts/drawing/constants.js

What each of them is stands where the kit has it; a test finds what is not renewed.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path

import numpy as np

import lsys_kit.classroom.panel

CONSTANTS = Path(lsys_kit.classroom.panel.__file__).parent / "scripts" / "drawing" / "constants.js"
SHARED: Mapping[str, Mapping[str, str]] = {
    "geometry.scene": {"OWN_LOOK": "OWN", "HOLLOW": "CIRCLE", "DISC": "DISC", "BALL": "SPHERE"},
    "geometry.turtle.commands": {
        "BLOSSOM": "BLOSSOM",
        "LARGEST_VALUE": "LARGEST",
        "RAMP_START": "RAMP_START",
        "RAMP_END": "RAMP_END",
        "SHAPE_WIDTH": "WIDTH",
    },
    "geometry.turtle.space": {
        "TANGENT": "TANGENT",
        "MOST_PARTS": "MOST_PARTS",
        "RENORMALISED_AFTER": "RENORMALISATION_INTERVAL",
        "NEGLIGIBLE": "_NEGLIGIBLE",
    },
    "geometry.turtle.turtle": {
        "FRACTINT_COLOURS": "PALETTE_SIZE",
        "FRACTINT_WHITE": "WHITE",
        "LAST_COLOUR": "LAST_COLOUR",
        "MOST_CURVED": "MOST_CURVED",
    },
    "geometry.pipe_model": {"EXPONENT": "EXPONENT", "SLENDER": "SLENDER", "TRUNK": "TRUNK"},
    "geometry.turtle.plane": {"LARGEST_EXACT": "LARGEST_EXACT"},
    "geometry.turtle.surfaces": {"PATCH_FACES": "PATCH_FACES"},
    "geometry.tissues.relaxation": {
        "TIME_STEP": "TIME_STEP",
        "SHORTEST_TIME_STEP": "SHORTEST_TIME_STEP",
        "AT_REST": "AT_REST",
        "MOST_ITERATIONS": "MOST_ITERATIONS",
        "FARTHEST": "FARTHEST",
        "LEAST_AREA": "LEAST_ROOM",
        "LEAST_LENGTH": "LEAST_LENGTH",
    },
    "notation.fragments": {"LINK_MARK": "MARK", "LINK_VERSION": "VERSION", "CHECK_BYTES": "CHECK_BYTES"},
    "pictures.draw": {"MOST_ROWS": "MOST_ROWS"},
    "pictures.filaments": {
        "ROW_HEAD": "HEAD",
        "ROW_STEPS": "STEPS",
        "ROW_TIMES": "TIMES",
        "ROW_AGES": "AGES",
        "TALLEST_ROW": "TALLEST",
        "LOWEST_ROW": "NEAREST",
        "FILLED_ROW": "FILLED",
        "LEGIBLE_ROW": "LEGIBLE",
        "MARKED_CELL": "MARKED",
    },
    "pictures.rendering.frames": {
        "LARGEST_SCALE": "LARGEST_SCALE",
        "BROADEST_PART": "MOST_OF_A_PICTURE",
        "BROAD": "BROAD",
        "FINE": "FINE",
        "STOUT": "STOUT",
        "PICTURE_WIDTH": "WIDTH",
        "PICTURE_HEIGHT": "HEIGHT",
        "TALLEST": "TALLEST",
        "PICTURE_MARGIN": "MARGIN",
        "LABEL_GAP": "LABEL_GAP",
    },
    "pictures.rendering.looks": {
        "ORDER_WIDTHS": "STROKES",
        "LEAST_WIDTHS": "LEAST",
        "SLIMMEST": "THINNEST",
        "BROADEST": "BROADEST",
        "USUAL_STROKE": "USUAL_LENGTH",
        "FINEST": "FINEST",
        "STURDY": "STURDY",
        "BOLDEST": "BOLDEST",
    },
    "pictures.rendering.display_list": {
        "TONED": "TONED",
        "LIT": "LIT",
        "DARK": "DARK",
        "RIM": "RIM",
        "FILLED": "FILLED",
        "LEAST_CASING": "LEAST_CASING",
        "CASING": "CASING",
        "BROADEST_CASING": "BROADEST_CASING",
    },
    "pictures.rendering.view": {
        "DEPTH_LEVELS": "LEVELS",
        "DISTANCE": "DISTANCE",
        "MOST_CYLINDERS": "MOST_CYLINDERS",
        "EDGE_ON": "EDGE_ON",
    },
    "pictures.style.lighting": {
        "TO_LIGHT": "LIGHT",
        "AMBIENT": "AMBIENT",
        "STEPS": "STEPS",
        "OWN": "OWN",
        "BRIGHT": "BRIGHT",
        "DIM": "DIM",
        "EDGE": "EDGE",
        "LIGHTEST": "LIGHTEST",
        "DARKEST": "DARKEST",
        "HAZE": "HAZE",
        "HIGHLIGHT": "HIGHLIGHT",
        "REACH": "REACH",
        "SPHERE": "SPHERE",
    },
    "pictures.rendering.light": {
        "SUN": "SUN",
        "SUNLIT": "SUNLIT",
        "THINNEST_TUBE": "THINNEST",
        "VARIED": "VARIED",
        "FAR_SHADOW": "REACH",
        "SOFT": "SOFT",
        "SUN_RADIUS": "SUN_RADIUS",
        "BLURS": "BLURS",
        "NEAR_GROUND": "NEAR_GROUND",
        "HIDING": "HIDING",
        "DIM_MAP": "DIM_MAP",
        "DIM_BLUR": "DIM_BLUR",
        "RING_PARTS": "RINGS",
        "SPOKES": "SPOKES",
        "HIDDEN_WITHIN": "HIDDEN_WITHIN",
        "DARKEST_SKY": "DARKEST",
        "SUNLIGHT": "SUNLIGHT",
        "SKYLIGHT": "SKYLIGHT",
        "BOUNCED": "BOUNCED",
        "SHADOW": "SHADOW",
        "POOL": "POOL",
        "TINT": "TINT",
        "PICTURE_EDGE": "EDGE",
        "BROAD_EDGE": "BROAD_EDGE",
        "THROUGH": "THROUGH",
        "LEAF": "LEAF",
        "GLOSS": "GLOSS",
        "GLOSSY": "GLOSSY",
    },
    "geometry.meshes.tubes": {"SHARPEST": "SHARPEST"},
    "pictures.style.palette": {"SIGN_COLOUR": "GREEN", "PALEST": "PALEST", "STRONGEST": "STRONGEST", "OLDEST": "OLDEST"},
    "pictures.style.themes": {"CONTRAST": "LINE", "FINER": "FINER"},
    "pictures.rendering.scene_shapes": {"FACE_EDGE": "AREAS", "RING": "ROUNDS", "SMALLEST_RADIUS": "SMALLEST"},
    "classroom.lessons.lesson": {"LETTERS": "LETTERS"},
    "classroom.lessons.entries": {"LONGEST_ENTRY": "MOST_CHARACTERS"},
    "classroom.panel.word_view": {"MOST_MODULES_SHOWN": "MOST_MODULES_SHOWN"},
}
"""For each module of the kit the names of its constants there, by their names in the scripts."""


def script() -> str:
    """The script with the constants of today."""
    lines = (
        f"export const {name} = {_written(getattr(import_module(f'lsys_kit.{module}'), own))};"
        for module, names in SHARED.items()
        for name, own in names.items()
    )
    return "\n".join(("// What the scripts and the kit agree on. Made by: python -m tests.shared_constants", "", *lines, ""))


def _written(value: object) -> str:
    plain = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
    return json.dumps(int(plain) if isinstance(plain, float) and plain.is_integer() and abs(plain) < 2**53 else plain)


if __name__ == "__main__":
    CONSTANTS.write_text(script(), encoding="utf-8")
