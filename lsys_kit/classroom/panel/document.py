"""An HTML file with no address outside it: its style, its data and its scripts are in it, and nothing else runs.

The data stand in the page as JSON in which no markup can begin; the scripts that run are named by their hashes in the page's
Content Security Policy, which forbids everything else: other scripts, connections, frames and forms.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
import zlib
from collections.abc import Mapping
from dataclasses import dataclass

from lsys_kit.classroom.panel.bundle import compact
from lsys_kit.errors import ModelValueError, shown
from lsys_kit.files import KIT_MARK
from lsys_kit.pictures.style.labels import escaped

_NO_MARKUP = bytes.maketrans(b"<", b".")
"""Of the digits of RFC 1924 the one with which markup could begin, and what stands for it."""
MANIFEST, ICON = "manifest.json", "icon-192.png"
"""The files of a site that say how it is installed as an app (W3C, Web Application Manifest), and show it."""
_LANGUAGE = re.compile(r"[A-Za-z]{2,3}(-[A-Za-z0-9]{2,8})*")


@dataclass(frozen=True)
class Program:
    """What runs in a page: a script, the style of what it makes, and the data that it reads; whether it may ask the server
    from which it came, and show its pictures; and the way to the folder of its site, if its workers may work for it, and the
    page is one of the app that is described there (`MANIFEST`)."""

    script: str
    style: str
    data: Mapping[str, object]
    asks: bool = False
    home: str | None = None


def document(title: str, body: str, style: str, description: str, program: Program | None = None, language: str = "en") -> str:
    """One HTML file, with a title for the window, a body that holds nothing from outside and needs no script, a description for
    search, a program, without which nothing runs in it, and its language, as in "en" or "de-AT".

    >>> document("Algae", "<main><h1>Algae</h1></main>", "", "Two cells").count("<script")
    0
    """
    if not isinstance(language, str) or not _LANGUAGE.fullmatch(language):
        raise ModelValueError(f'A language is named as in "en" or "de-AT", not {shown(language)}')
    return f"""<!doctype html>
<html lang="{language}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{_policy(program)}">
<meta name="generator" content="{KIT_MARK.decode()}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="referrer" content="no-referrer">
<meta name="description" content="{escaped(description)}">
<link rel="icon" href="data:,">
{_app(program)}<title>{escaped(title)}</title>
<style>{style}</style>
</head>
<body class="lsys-page">
{body}{_scripts(program) if program else ""}</body>
</html>
"""


def _app(program: Program | None) -> str:
    if program is None or program.home is None:
        return ""
    return f'<link rel="manifest" href="{program.home}{MANIFEST}">\n<link rel="apple-touch-icon" href="{program.home}{ICON}">\n'


def deflated_text(text: str) -> str:
    """A text, deflated (RFC 1950), in digits to the base 85, which take less room than those to the base 64.

    >>> inflated_text(deflated_text("axiom: F"))
    'axiom: F'
    """
    return base64.b85encode(zlib.compress(text.encode(), 9)).translate(_NO_MARKUP).decode()


def inflated_text(packed: str) -> str:
    """The text that was deflated."""
    return zlib.decompress(base64.b85decode(packed.replace(".", "<"))).decode()


def _first() -> str:
    """The script that is run first, in a block of its own: the other one has some of its names."""
    return f'"use strict";\n{{\n{compact("first")}}}\n'


def _policy(program: Program | None) -> str:
    runs = f"script-src {_hashed(_first())} {_hashed(program.script)}; " if program else ""
    own, also = ("connect-src 'self'; ", "'self' ") if program and program.asks else ("", "")
    worker, policies = "", "lsys"
    if program and program.home is not None:
        worker, also, policies = "worker-src 'self'; manifest-src 'self'; ", "'self' ", "lsys lsys-worker"
    return (
        f"default-src 'none'; {runs}{own}{worker}style-src 'unsafe-inline'; img-src {also}data: blob:; base-uri 'none'; "
        f"form-action 'none'; require-trusted-types-for 'script'; trusted-types {policies}"
    )


def _scripts(program: Program) -> str:
    packed = {**program.data, "script": deflated_text(program.script), "style": deflated_text(program.style)}
    content = json.dumps(packed, separators=(",", ":")).replace("<", "\\u003c")
    return f'<script type="application/json" id="lsys-data">{content}</script>\n<script>{_first()}</script>\n'


def _hashed(script: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"
