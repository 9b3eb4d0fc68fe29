"""A page without a kernel: the panel of a system with the books of its settings, one HTML file with no address outside it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.panel.document import Program, deflated_text, document
from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import Entries, path_from, save_file
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.pictures.style.themes import DARK, LIGHT

STYLE = f"""
.lsys-page {{
  margin: 0 auto; padding: 8px 12px 24px; max-width: 1500px; background: {LIGHT.paper}; color: {LIGHT.ink};
  font: 15px/1.5 system-ui, sans-serif;
}}
.lsys-page h1 {{ font-size: 20px; font-weight: 600; margin: 4px 0 8px; overflow-wrap: anywhere; }}
@media (prefers-color-scheme: dark) {{ .lsys-page {{ background: {DARK.paper}; color: {DARK.ink}; }} }}
"""
_CELLS, _STROKES, _TISSUES = frozenset(("filament",)), frozenset(("turtle", "painter", "projection")), frozenset(("tissue",))
_SUNLIGHT = frozenset(("sunlight", "shaders"))
_MAPS = frozenset(("map", "relaxation", "relaxing", "tension"))
_NOT_NEEDED = {
    "filament": _STROKES | _MAPS | _TISSUES | _SUNLIGHT,
    "plane": _CELLS | _MAPS | _TISSUES | {"turtle_space", "depths"} | _SUNLIGHT,
    "space": _CELLS | _MAPS | _TISSUES,
    "map": _CELLS | _TISSUES | {"turtle", "depths"} | _SUNLIGHT,
    "tissue": _CELLS | _MAPS | {"turtle"} | _SUNLIGHT,
}
"""The scripts that draw other systems than that of a page, by the way in which it is drawn."""
_OF_EDITORS = frozenset(("undoing", "resuming"))
"""The scripts of rules that can be changed, as those of a page cannot."""
_MOTIONS = frozenset(("walk", "unfolding", "sample"))
"""The views that have scripts of their own, which are called so."""
_CHOSEN = {"letters": "letters", "sentence": "sentence", "gallery": "chance", "chance": "thrown"}
"""What else has a script of its own, and the entry of a panel's model that asks for it. No page has variants, which would ask
for the gallery, too."""


def page(title: str, data: Entries, description: str, language: str = "en") -> str:
    """One HTML file that shows a panel.

    Parameters
    ----------
    title, description
        The heading of the page, and what is to be seen first, in words: for readers without scripts, and for search.
    data
        What the page has to know of the panel.
    language
        The language of the title and the description, as in "en" or "de-AT".

    Examples
    --------
    >>> from lsys_kit import explore, read
    >>> text = page("Algae", explore(read("axiom: a\\na -> ab\\nb -> a")).page_data(), "The word a.")
    >>> text.startswith("<!doctype html>"), text.count("<script"), "://" in text.partition("<script>")[0]
    (True, 2, False)
    """
    body = f"""<main id="lsys-here">
<h1>{escaped(title)}</h1>
<noscript><p>Without JavaScript the panel cannot be moved. It shows: {escaped(description)}</p></noscript>
</main>
"""
    model = data.get("model", {})
    unused = not_needed(data["mode"]) | unasked([model]) | _OF_EDITORS
    script = f'"use strict";\n{compact("page", unused)}\nopenPage();\n'
    return document(title, body, STYLE, description, Program(script, style("panel"), data), language)


def not_needed(*modes: str) -> frozenset[str]:
    """The scripts that are not called on a page of panels that draw in these ways.

    >>> sorted(not_needed("plane", "filament"))
    ['map', 'relaxation', 'relaxing', 'shaders', 'sunlight', 'tension', 'tissue']
    """
    return frozenset.intersection(*(_NOT_NEEDED[mode] for mode in modes))


def unasked(models: Sequence[Entries]) -> frozenset[str]:
    """The scripts of what no panel of a page asks for.

    >>> sorted(unasked([{"letters": ["a"]}, {"show": ["drawing"]}]))
    ['chance', 'gallery', 'motion', 'sample', 'sentence', 'unfolding', 'walk']
    """
    shown = {view for model in models for view in model.get("show") or ()} & _MOTIONS
    wanted = {
        *shown,
        *{"motion" for _ in shown},
        *(each for each, key in _CHOSEN.items() for model in models if model.get(key)),
    }
    return frozenset({"motion", *_CHOSEN, *_MOTIONS} - wanted)


def save_page(path: str | Path, text: str) -> None:
    """Write a page to an .html file, unless something that the kit did not make is there already."""
    path = path_from(path)
    if path.suffix.lower() != ".html":
        raise ModelFileError(f'A page cannot be written to "{quotable(path.name)}"', hint="Let the name end in .html.")
    save_file(path, text.encode())


def shared(books: Sequence[Mapping[str, object]]) -> dict[str, object]:
    """Books with what they have in common written once: for each entry its different values, and for each book their numbers.

    >>> shared([{"a": [1], "b": 2}, {"a": [1], "b": 3, "c": 4}])
    {'names': ['a', 'b', 'c'], 'parts': [[[1]], [2, 3], [4]], 'rows': [[0, 0, -1], [0, 1, 0]]}
    """
    names = [*dict.fromkeys(name for each in books for name in each)]
    parts: list[dict[str, int]] = [{} for _ in names]
    rows = [
        [
            parts[number].setdefault(json.dumps(each[name]), len(parts[number])) if name in each else -1
            for number, name in enumerate(names)
        ]
        for each in books
    ]
    return {"names": names, "parts": [[*map(json.loads, part)] for part in parts], "rows": rows}


def deflated(content: object) -> str:
    """Anything as JSON, deflated, as `deflated_text` has it."""
    return deflated_text(json.dumps(content, separators=(",", ":")))
