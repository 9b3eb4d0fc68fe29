"""Pictures without paper: what lies between shapes, and in part at their edges, is transparent."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.style.colour_values import BLACK, WHITE
from lsys_kit.pictures.style.themes import drawn_on, theme

if TYPE_CHECKING:
    from PIL.Image import Image


def on_ground(render: Callable[[], Image]) -> Image:
    """An image as it is rendered in the theme in force, transparent if there is no paper.

    What is seen in front of white is brighter than in front of black by as much as shines through.
    """
    if not theme().transparent:
        return render()
    from PIL import Image

    white, black = (_on(ground, render) for ground in (WHITE, BLACK))
    cover = 255 - np.clip((white - black).max(axis=2), 0, 255)
    colours = np.where(cover[..., None] > 0, np.clip(black * 255 / np.maximum(cover, 1)[..., None], 0, 255), 255)
    return Image.fromarray(np.dstack([colours, cover]).round().astype(np.uint8), "RGBA")


def _on(ground: str, render: Callable[[], Image]) -> Floats:
    """The pixels of an image in front of a colour."""
    with drawn_on(replace(theme(), ground=ground)):
        return np.asarray(render().convert("RGB"), np.float64)
