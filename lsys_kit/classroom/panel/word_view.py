"""Words as HTML, for the explorer's panels."""

from __future__ import annotations

from collections.abc import Collection
from functools import lru_cache

from lsys_kit.derivation.core.words import Word
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.style.labels import html_label
from lsys_kit.pictures.style.palette import INK, MARK, MARK_EDGE, QUIET, colours, tinted

MOST_MODULES_SHOWN = 240
"""How many modules of a word are shown; of a longer one the beginning and the end."""


def word_html(word: Word, marked: Collection[int] = ()) -> str:
    """A word as HTML: each module on the tint of its symbol, marked ones underlined in bold, a long word without its middle.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.notation.read import read
    >>> ">r</sub>" in word_html(derive(read("axiom: a_r"), 0)[0])
    True
    """
    system, numbers = word.states.system, word.numbers()
    chips = {
        state: _chip(word.states.modules[state], system, state in marked)
        for state in {*numbers[:MOST_MODULES_SHOWN], *numbers[-MOST_MODULES_SHOWN:]}
    }
    if len(numbers) <= MOST_MODULES_SHOWN:
        shown = "".join(chips[state] for state in numbers)
    else:
        half = MOST_MODULES_SHOWN // 2
        gap = f'<span style="color:{QUIET};padding:0 .6em">&hellip; {len(numbers) - 2 * half:,} more &hellip;</span>'
        shown = "".join(chips[s] for s in numbers[:half]) + gap + "".join(chips[s] for s in numbers[-half:])
    return (
        f'<div class="lsys-word" tabindex="0" aria-label="Word of {len(word):,} modules" '
        f'style="font:15px/1.9 Georgia,serif;color:{INK};background:#fff;padding:4px;max-height:380px;overflow-y:auto;'
        f'overflow-wrap:anywhere">{shown or "the empty word"}</div>'
    )


@lru_cache(maxsize=4096)
def _chip(module: Module, system: LSystem, marked: bool) -> str:
    colour = colours(system).get(module.symbol)
    if colour is None:
        return f'<span style="color:{QUIET}">{html_label(module, system)}</span>'
    look = (
        f"background:{MARK};border-bottom:3px solid {MARK_EDGE};font-weight:bold"
        if marked
        else f"background:{tinted(colour, 0.22)};border-bottom:2px solid {colour}"
    )
    shape = "border-radius:3px;padding:0 2px;margin:0 1px;display:inline-block;line-height:1.35"
    return f'<span style="{look};{shape}">{html_label(module, system)}</span>'
