"""The pages of a class: the one on which a code is typed, that of a phone, and the board for the projector."""

from __future__ import annotations

import base64
from gzip import compress
from hashlib import sha256

from lsys_kit.classroom.live.events import ClassEntry
from lsys_kit.classroom.live.game import GAMES
from lsys_kit.classroom.live.session import plan
from lsys_kit.classroom.panel.bundle import compact, style, translated_words
from lsys_kit.classroom.panel.document import Program, document
from lsys_kit.errors import LSystemError
from lsys_kit.pictures.qr_codes import qr_code
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import gettext, language


class Page:
    """A page in memory, as it is sent, and by what a browser knows it again."""

    def __init__(self, content: bytes) -> None:
        self.packed, self.plain = compress(content, 6), content
        self.tag = f'"{sha256(content).hexdigest()[:32]}"'


def door_page() -> str:
    """The page on which the code of a class is typed."""
    body = f"""<main class="door"><h1>{escaped(gettext("Join the class"))}</h1>
<form id="door"><label for="code">{escaped(gettext("The four letters on the board"))}</label>
<input id="code" name="code" type="text" maxlength="4" size="4" autocomplete="off" autocapitalize="characters"
spellcheck="false" required>
<button type="submit">{escaped(gettext("Join"))}</button></form><p id="said" role="status"></p></main>
"""
    return _document(gettext("Join the class"), body, "door", {})


def phone_page(entry: ClassEntry, course: bool) -> str:
    """The page of a phone in a class."""
    body = f"""<header class="phone-head"><h1>{escaped(entry.name)}</h1><p id="link" role="status"></p></header>
<main id="here" class="phone"></main>
"""
    return _document(entry.name, body, "phone", {"code": entry.code, "course": course})


def waiting_page(entry: ClassEntry) -> str:
    """What stands in the place of a page of the course that is being made; it goes on to that page by itself."""
    title, back = gettext("This page is being made."), gettext("The class")
    said = gettext("It opens by itself as soon as it is there.")
    body = f"""<main class="door"><h1>{escaped(title)}</h1>
<p>{escaped(said)}</p>
<p id="progress" role="status"></p>
<p><a class="go" href="/{entry.code}/">{escaped(back)}</a></p></main>
"""
    return _document(title, body, "waiting", {})


def board_page(entry: ClassEntry, address: str) -> str:
    """The board of a class."""
    body = f"""<header class="board-head"><h1>{escaped(entry.name)}</h1><p id="present" role="status"></p></header>
<main id="here" class="board"></main>
<footer id="tools" class="board-tools"></footer>
"""
    return _document(entry.name, body, "board", board_data(entry, address), style("board"))


def board_data(entry: ClassEntry, address: str) -> dict[str, object]:
    """What a board has to know of a class."""
    return {"address": address, "code": entry.code, "plan": plan(), "games": list(GAMES), "picture": picture_of(address)}


def picture_of(address: str) -> str:
    """The QR code of an address as the source of a picture; empty where the library is missing."""
    try:
        drawn = qr_code(address).svg
    except LSystemError:
        return ""
    return f"data:image/svg+xml;base64,{base64.b64encode(drawn.encode()).decode()}"


def problem_page(status: int) -> str:
    """What is shown where a page cannot be had."""
    said = {
        404: gettext("There is no such page."),
        **dict.fromkeys((429, 503), gettext("Too many have asked at once. Wait a moment, and try again.")),
    }.get(status, gettext("This cannot be done."))
    join = f'<p><a href="/">{escaped(gettext("Join the class"))}</a></p>'
    return _document(said, f'<main class="door"><h1>{escaped(said)}</h1>{join}</main>\n')


def _document(title: str, body: str, script: str = "", data: dict[str, object] | None = None, more: str = "") -> str:
    opening = f"open{script.capitalize()}();"
    words = {"words": translated_words(script, "panel", "filling", "predicting", "voting")} if script else {}
    program = (
        Program(f'"use strict";\n{compact(script)}\n{opening}\n', "", {**(data or {}), **words}, asks=True) if script else None
    )
    return document(title, body, style("live") + more, title, program, language())
