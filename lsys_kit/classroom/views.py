"""What the explorer's panels show: a word as HTML, a turtle's path for the browser's canvas, a diagram that can be clicked.

Where anywidget is missing, the canvas and the diagram are plain SVG in an HTML widget, with the same traits.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import lru_cache
from pathlib import Path as File
from typing import Any

import numpy as np

from lsys_kit.derivation.words import Word
from lsys_kit.geometry.turtle import Path
from lsys_kit.notation.model import LSystem, Module
from lsys_kit.pictures.labels import html_label
from lsys_kit.pictures.palette import GREEN, INK, MARK, MARK_EDGE, QUIET, colours, tinted

SHOWN = 240
"""How many modules of a word are shown; of a longer one the beginning and the end."""
_HERE = File(__file__).parent


def word_html(word: Word, marked: Collection[int] = ()) -> str:
    """A word as HTML: each module on the tint of its symbol, marked ones underlined in bold, a long word without its middle.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> ">r</sub>" in word_html(derive(read("axiom: a_r"), 0)[0])
    True
    """
    system, numbers = word.states.system, word.numbers()
    chips = {state: _chip(word.states.modules[state], system, state in marked)
             for state in {*numbers[:SHOWN], *numbers[-SHOWN:]}}
    if len(numbers) <= SHOWN:
        shown = "".join(chips[state] for state in numbers)
    else:
        half = SHOWN // 2
        gap = f'<span style="color:{QUIET};padding:0 .6em">&hellip; {len(numbers) - 2 * half:,} more &hellip;</span>'
        shown = "".join(chips[s] for s in numbers[:half]) + gap + "".join(chips[s] for s in numbers[-half:])
    return (f'<div class="lsys-word" tabindex="0" aria-label="Word of {len(word):,} modules" '
            f'style="font:15px/1.9 Georgia,serif;color:{INK};background:#fff;padding:4px;max-height:380px;overflow-y:auto;'
            f'overflow-wrap:anywhere">{shown or "the empty word"}</div>')


@lru_cache(maxsize=4096)
def _chip(module: Module, system: LSystem, marked: bool) -> str:
    colour = colours(system).get(module.symbol)
    if colour is None:
        return f'<span style="color:{QUIET}">{html_label(module, system)}</span>'
    look = f"background:{MARK};border-bottom:3px solid {MARK_EDGE};font-weight:bold" if marked \
        else f"background:{tinted(colour, 0.22)};border-bottom:2px solid {colour}"
    shape = "border-radius:3px;padding:0 2px;margin:0 1px;display:inline-block;line-height:1.35"
    return f'<span style="{look};{shape}">{html_label(module, system)}</span>'


def packed(path: Path, colour_of: Mapping[int, str], marked: Collection[int]) -> tuple[bytes, list[str]]:
    """A path as the canvas unpacks it, 20 bytes a step, and the colours that its steps count off.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.turtle import traced
    >>> from lsys_kit.notation.read import read
    >>> data, used = packed(traced(derive(read("axiom: F+F"), 0)[0]), {0: "#009E73"}, ())
    >>> len(data), used
    (40, ['#009E73'])
    """
    used = list(dict.fromkeys(colour_of.values())) or [GREEN]
    index = np.zeros(max(colour_of, default=0) + 1, dtype=np.int32)
    for state, colour in colour_of.items():
        index[state] = used.index(colour)
    looks = (index[path.states] * 16 + np.minimum(path.orders, 3) * 4 + np.isin(path.states, list(marked)) * 2 + path.drawn)
    floats = np.concatenate([path.turns, path.offsets, path.lengths]).astype("<f4")
    return floats.tobytes() + np.concatenate([path.parents, looks]).astype("<i4").tobytes(), used


@lru_cache(maxsize=1)
def widget_classes() -> tuple[Any, Any] | None:
    """The classes of the canvas and of the diagram, or None where anywidget is missing."""
    try:
        import anywidget
        import traitlets
    except ImportError:
        return None

    class Canvas(anywidget.AnyWidget):
        """A turtle's path that the browser turns by itself."""

        _esm = _HERE / "canvas.js"
        path = traitlets.Bytes().tag(sync=True)
        angle = traitlets.Float(90.0).tag(sync=True)
        heading = traitlets.Float(90.0).tag(sync=True)
        typical = traitlets.Float(1.0).tag(sync=True)
        colours = traitlets.List(traitlets.Unicode()).tag(sync=True)
        mark = traitlets.Unicode(MARK_EDGE).tag(sync=True)
        description = traitlets.Unicode().tag(sync=True)

    class Diagram(anywidget.AnyWidget):
        """A stage diagram whose stages can be chosen."""

        _esm = _HERE / "diagram.js"
        svg = traitlets.Unicode().tag(sync=True)
        chosen = traitlets.Int(-1).tag(sync=True)

    return Canvas, Diagram
