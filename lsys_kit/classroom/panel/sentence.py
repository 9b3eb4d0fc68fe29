"""A sentence above a panel with numbers in it: those that can be moved where they stand, and those that follow."""

from __future__ import annotations

import re
from collections.abc import Mapping

from lsys_kit.classroom.link import ANGLE, STEP
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.panel.opened.opened import Opened, Viewing
from lsys_kit.errors import ModelNameError, quotable, require
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.pictures.style.labels import label_parts, visible

_NUMBER = re.compile(r"\{\{([^{}]*)\}\}")
_ALL = ("modules", "letters", "characters", "cells")
"""The names of the length of the word."""


def check_sentence(text: str, opened: Opened) -> None:
    """Each name in a sentence is that of the step, the angle, a constant, or of what can be counted."""
    require(text, str, "A sentence")
    offered = _offered(opened)
    for name in _names(text):
        if name not in offered:
            hint = suggestion(name, offered) or f"Such names are: {', '.join(offered)}."
            raise ModelNameError(f'The sentence asks for "{quotable(name)}", of which there is no number', hint=hint)


def _names(text: str) -> list[str]:
    return [name.strip() for name in _NUMBER.findall(text)]


def _offered(opened: Opened) -> list[str]:
    counts = (*symbols(opened.system), *_ALL) if isinstance(opened.system, LSystem) else ()
    return [STEP, ANGLE, *opened.values, *opened.fixed, *(name for name in counts if name not in opened.values)]


def sentence_parts(text: str, opened: Opened, chosen: Viewing) -> list[str | Data]:
    """The texts of a sentence and, between them, its numbers, as the panel's script needs them."""
    texts, values = _NUMBER.split(text)[::2], {**opened.fixed, **chosen.values}
    parts: list[str | Data] = [texts[0]]
    for name, after in zip(_names(text), texts[1:], strict=True):
        if name in (STEP, ANGLE) or name in values:
            value = number_text(values[name]) if name in values else ""
            parts.append({"name": name, "value": value})
        elif isinstance(opened.system, LSystem) and name not in _ALL:
            parts.append({"symbol": [*map(visible, label_parts(name, opened.system))]})
        else:
            parts.append({"all": True})
        parts.append(after)
    return parts


def sentence_text(text: str, opened: Opened, chosen: Viewing, counts: Mapping[str, int]) -> str:
    """The sentence with its numbers, as it is read where nothing can be moved."""
    values: Mapping[str, str] = {
        STEP: str(chosen.step),
        ANGLE: f"{chosen.angle:g}",
        **{name: number_text(value) for name, value in {**opened.fixed, **chosen.values}.items()},
    }

    def number(found: re.Match[str]) -> str:
        name = found[1].strip()
        if name in values:
            return values[name]
        return f"{sum(counts.values()) if name in _ALL else counts.get(name, 0):,}"

    return _NUMBER.sub(number, text)
