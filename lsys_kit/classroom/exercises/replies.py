"""What is said to a student, in the chosen language: the texts stand in `replies.toml`, by where they are said."""

from __future__ import annotations

from typing import Any

from lsys_kit.files import toml_tables
from lsys_kit.translation import gettext, ngettext

REPLIES = toml_tables(__package__, "replies.toml")


def reply(name: str, /, **values: Any) -> str:
    """A text, with values in the place of its names in braces; one that has two forms, in that for a number of things.

    >>> reply("line.not_this", number=3), reply("words.count", number=1, asked=3)
    ('It is not line 3.', 'You have 1 word, and 3 are asked for.')
    """
    place, _, part = name.partition(".")
    text = REPLIES[place][part]
    return gettext(text, **values) if isinstance(text, str) else ngettext(text[0], text[1], values.pop("number"), **values)
