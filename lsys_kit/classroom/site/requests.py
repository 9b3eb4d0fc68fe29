"""What a lesson asks for and its page cannot do, found by the words in which it is asked (requests.toml)."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from html import unescape

from lsys_kit.classroom.lessons.widget import prose_html
from lsys_kit.files import toml_tables
from lsys_kit.translation import gettext

_TAG = re.compile(r"<[^<>]*>")


def notes(live: bool = False) -> Callable[[str], str]:
    """What is said after the blocks of a cell, each given as HTML: once for each kind of request that the page cannot fulfil,
    perhaps a live one. What is folded away asks for nothing.

    >>> after = notes()
    >>> after("<p>Press <em>rules</em>, change a character, and watch.</p>")
    '<p class="cannot" data-cannot="rules">The rules on this page stay as they are. They can be changed in Jupyter: \
<code>lsys-kit lab</code>.</p>\\n'
    >>> after("<p>Press <em>rules</em> again.</p>"), after("<p>Move the slider.</p>")
    ('', '')
    """
    said, folded = {kind for kind, (_, _, lives) in _kinds().items() if live and lives}, False

    def after(block: str) -> str:
        nonlocal folded
        folded = (folded or "<details>" in block) and "</details>" not in block
        if folded:
            return ""
        text = " ".join(unescape(_TAG.sub("", block)).split())
        found = [
            kind for kind, (asks, _, _) in _kinds().items() if kind not in said and any(each.search(text) for each in asks)
        ]
        said.update(found)
        return "".join(
            f'<p class="cannot" data-cannot="{kind}">{prose_html(gettext(_kinds()[kind][1]))}</p>\n' for kind in found
        )

    return after


@cache
def _kinds() -> dict[str, tuple[tuple[re.Pattern[str], ...], str, bool]]:
    """For each kind of requests the patterns of one, what a page says, and whether live pages fulfil it."""
    declared = toml_tables(__package__, "requests.toml")
    return {kind: (tuple(map(re.compile, each["asks"])), each["says"], each["live"]) for kind, each in declared.items()}
