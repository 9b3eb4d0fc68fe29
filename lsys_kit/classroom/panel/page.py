"""A page without a kernel: the panel of a system with the books of its settings, one HTML file with no address outside it.

The data stand in the page as JSON in which no markup can begin; the scripts that run are named by their hashes in the page's
Content Security Policy, which forbids everything else: other scripts, connections, frames and forms.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
import time
import zlib
from collections.abc import Mapping, Sequence
from itertools import product
from math import prod
from pathlib import Path
from typing import Any

from lsys_kit.budget import current
from lsys_kit.classroom.panel.books.book import book, first_step
from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.panel.controls import slider, slider_ranges, slider_values
from lsys_kit.derivation.core.rules import number_from, real_from
from lsys_kit.errors import LSystemError, ModelFileError, ModelValueError, quotable, shown
from lsys_kit.files import KIT_MARK, save_file
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.write import write
from lsys_kit.pictures.style.labels import escaped

MOST_BOOKS, MOST_CHARACTERS = 2_000, 4_000_000
"""A page holds no more books, and no more than about so many characters of them before they are deflated; nor more than can be
made in the time of one task."""
STYLE = """
.lsys-page {
  margin: 0 auto; padding: 8px 12px 24px; max-width: 1500px; background: #fff; color: #22303c;
  font: 15px/1.5 system-ui, sans-serif;
}
.lsys-page h1 { font-size: 20px; font-weight: 600; margin: 4px 0 8px; overflow-wrap: anywhere; }
@media (prefers-color-scheme: dark) { .lsys-page { background: #161b20; color: #e8edf2; } }
"""
_FIRST = """
"use strict";
const packed = JSON.parse(document.getElementById("lsys-data").textContent);
const texts = ["style", "script"].map((name) => {
  const bytes = Uint8Array.from(atob(packed[name]), (sign) => sign.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
});
Promise.all(texts).then(([style, script]) => {
  const policy = window.trustedTypes?.createPolicy("lsys", { createScript: (text) => text });
  const [looks, element] = ["style", "script"].map((name) => document.createElement(name));
  looks.textContent = style;
  element.text = policy ? policy.createScript(script) : script;
  document.head.append(looks, element);
});
"""
"""The script that inflates the others and the style. A policy that names both by their hashes lets no other run."""
_CELLS, _STROKES, _TISSUES = frozenset(("filament",)), frozenset(("turtle", "painter")), frozenset(("tissue",))
_MAPS = frozenset(("map", "relaxation", "relaxing", "tension"))
_NOT_NEEDED = {"filament": _STROKES | _MAPS | _TISSUES, "plane": _CELLS | _MAPS | _TISSUES, "space": _CELLS | _MAPS | _TISSUES,
               "map": _CELLS | _TISSUES | {"turtle"}, "tissue": _CELLS | _MAPS | {"turtle"}}
"""The scripts that draw other systems than that of a page, by the way in which it is drawn."""
_LANGUAGE = re.compile(r"[A-Za-z]{2,3}(-[A-Za-z0-9]{2,8})*")


def page(title: str, data: Mapping[str, Any], description: str, language: str = "en") -> str:
    """One HTML file that shows a panel.

    Parameters
    ----------
    title
        The heading of the page.
    data
        What `page_data` makes.
    description
        What is to be seen first, in words: for readers without scripts, and for search.
    language
        The language of the title and the description, as in "en" or "de-AT".

    Raises
    ------
    ModelValueError
        There is no language of that form.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> text = page("Algae", page_data(read("axiom: a\\na -> ab\\nb -> a")), "The word a.")
    >>> text.startswith("<!doctype html>"), text.count("<script"), "://" in text.partition("<script>")[0]
    (True, 2, False)
    """
    if not isinstance(language, str) or not _LANGUAGE.fullmatch(language):
        raise ModelValueError(f'A language is named as in "en" or "de-AT", not {shown(language)}')
    script = f'"use strict";\n{compact("page", _NOT_NEEDED[data["mode"]])}\nopenPage();\n'
    policy = (f"default-src 'none'; script-src {_hashed(_FIRST)} {_hashed(script)}; style-src 'unsafe-inline'; "
              "img-src data: blob:; base-uri 'none'; form-action 'none'; "
              "require-trusted-types-for 'script'; trusted-types lsys")
    packed = {**data, "script": deflated_text(script), "style": deflated_text(style())}
    content = json.dumps(packed, separators=(",", ":")).replace("<", "\\u003c")
    return f"""<!doctype html>
<html lang="{language}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="generator" content="{KIT_MARK.decode()}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="referrer" content="no-referrer">
<meta name="description" content="{escaped(description)}">
<link rel="icon" href="data:,">
<title>{escaped(title)}</title>
<style>{STYLE}</style>
</head>
<body class="lsys-page">
<h1>{escaped(title)}</h1>
<main id="lsys-here"></main>
<noscript><p>Without JavaScript the panel cannot be moved. It shows: {escaped(description)}</p></noscript>
<script type="application/json" id="lsys-data">{content}</script>
<script>{_FIRST}</script>
</body>
</html>
"""


def page_data(system: LSystem, changes: Mapping[str, object] | None = None, seed: int = 0, *, title: str = "",
              step: int | None = None, angle: object = None, around: int = 0, above: int = 0) -> dict[str, Any]:
    """What a page says of a system: its sliders, and the books of all their settings.

    Parameters
    ----------
    system
        Any L-system.
    changes
        First values of declared constants.
    seed
        The seed of the random numbers.
    title
        The id of the system, if it is one of the catalogue.
    step, angle, around, above
        What is shown first: the step, by default the system's own; the degrees by which the turtle turns; the side from which a
        plant in space is seen.

    Raises
    ------
    LSystemError
        A value lies outside its slider's range, or the first book cannot be made.
    """
    given = {name: number_from(value, name) for name, value in (changes or {}).items()}
    ranges = slider_ranges(system, given)
    values = {name: slider_values(span) for name, span in ranges.items()}
    start = {**{name: value for name, value in given.items() if name not in ranges},
             **{name: span.value for name, span in ranges.items()}}
    wanted = first_step(system) if step is None else step
    began = time.thread_time()
    first = book(system, start, seed, title=title, least=wanted)
    live = live_constants(values, _room(len(json.dumps(first)), time.thread_time() - began))
    fixed = {name: number_text(value) for name, value in start.items() if name not in live}
    books = [_book(system, {**start, **dict(zip(live, chosen, strict=True))}, seed, title, wanted)
             for chosen in product(*(values[name] for name in live))]
    turn = real_from(angle, "angle") if angle is not None else float(system.angle)
    model = {"constants": [slider(name, values[name], ranges[name].value) for name in live],
             "chance": False, "fixed": kept_text(fixed, seed if first["chance"] else None), "step": min(wanted, first["steps"]),
             "angle": round(turn, 1), "around": around, "above": above, "seed": seed}
    own = {"notation": system.notation, "text": write(system), "angle": round(float(system.angle), 1)}
    return {"model": model, "mode": first["mode"], "system": own, "fixed": fixed, "books": deflated(shared(books))}


def save_page(path: str | Path, text: str) -> None:
    """Write a page to an .html file.

    Raises
    ------
    ModelFileError
        The name ends in something else, a file that the kit did not make is there already, or the file cannot be written.
    """
    if Path(path).suffix.lower() != ".html":
        raise ModelFileError(f'A page cannot be written to "{quotable(Path(path).name)}"', hint="Let the name end in .html.")
    save_file(Path(path), text.encode())


def live_constants(values: Mapping[str, Sequence[Value]], most: int) -> list[str]:
    """The constants that can be moved on a page with room for so many books: in their order, while there is room.

    >>> live_constants({"a": range(6), "b": range(1000), "c": range(6)}, 800)
    ['a', 'c']
    """
    live: list[str] = []
    for name in values:
        if prod(len(values[each]) for each in (*live, name)) <= most:
            live.append(name)
    return live


def _room(size: int, seconds: float) -> int:
    """How many books of about so many characters, each made in about so many seconds, a page has room for."""
    return int(min(MOST_BOOKS, MOST_CHARACTERS / size, current().seconds / max(seconds, 1e-3)))


def shared(books: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Books with what they have in common written once: for each entry its different values, and for each book their numbers.

    >>> shared([{"a": [1], "b": 2}, {"a": [1], "b": 3, "c": 4}])
    {'names': ['a', 'b', 'c'], 'parts': [[[1]], [2, 3], [4]], 'rows': [[0, 0, -1], [0, 1, 0]]}
    """
    names = [*dict.fromkeys(name for each in books for name in each)]
    parts: list[dict[str, int]] = [{} for _ in names]
    rows = [[parts[number].setdefault(json.dumps(each[name]), len(parts[number])) if name in each else -1
             for number, name in enumerate(names)] for each in books]
    return {"names": names, "parts": [[*map(json.loads, part)] for part in parts], "rows": rows}


def deflated(content: object) -> str:
    """Anything as JSON, deflated (RFC 1950), in base 64."""
    return deflated_text(json.dumps(content, separators=(",", ":")))


def deflated_text(text: str) -> str:
    """A text, deflated (RFC 1950), in base 64."""
    return base64.b64encode(zlib.compress(text.encode(), 9)).decode()


def _hashed(script: str) -> str:
    """How a Content Security Policy names a script that may run."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"


def _book(system: LSystem, settings: Mapping[str, object], seed: int, title: str, least: int) -> dict[str, Any]:
    """The book of some settings, or why there is none."""
    try:
        return book(system, settings, seed, title=title, least=least)
    except LSystemError as error:
        return {"mistake": {"message": error.message, "hint": error.hint or ""}}


def kept_text(fixed: Mapping[str, str], seed: int | None) -> str:
    """What a page says of what cannot be moved on it."""
    kept = [*(f"{name} = {text}" for name, text in fixed.items()), *([] if seed is None else [f"seed = {seed}"])]
    return f"Fixed on this page: {', '.join(kept)}." if kept else ""
