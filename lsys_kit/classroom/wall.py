"""Everybody's plants on one page: what a class has handed in, as links or as model files, drawn side by side.

Each is read and drawn in a child process with limits of time and memory, as many processes at a time as there are processors.
Most take a twentieth of a second. Those that take long are drawn last, and share their time, however many they are.
What cannot be drawn is a tile too, which says why; no text of a model or a name becomes markup, and pictures stand in the page
as images, in which nothing runs.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from math import ceil
from pathlib import Path
from typing import Any

from lsys_kit.budget import current, limits
from lsys_kit.classroom.catalogue import map_system, system
from lsys_kit.classroom.child_processes import Failed, in_child_processes
from lsys_kit.classroom.handed_in import HandedIn, content_of, handed_in
from lsys_kit.classroom.link import ANGLE, SEED, STEP, Linked, linked
from lsys_kit.classroom.panel.document import document
from lsys_kit.derivation.core.rules import with_constants
from lsys_kit.derivation.derive import Choices
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, quotable
from lsys_kit.files import decoded
from lsys_kit.notation.fragments import MARK, is_link
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read_any, read_word
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.write import write
from lsys_kit.pictures.draw import draw
from lsys_kit.pictures.style.labels import escaped

MOST_TILES = 1_000
MOST_CHARACTERS = 50_000_000
"""So many characters of models are taken together."""
BUDGET = {"modules": 300_000, "bytes": 2**27, "segments": 2_000}
"""The limits of a drawing; with more shapes than that it is a picture of pixels."""
QUICK, LONGEST, SHARED = 0.25, 2.0, 8.0
"""So many seconds of processor time each may take, one that takes longer, and all those together."""
TOGETHER = 8
"""So many drawings one child makes: to start it takes as long as to draw one."""
LONGEST_RULES, LONGEST_MISTAKE = 3_000, 600
"""So many characters are shown of a model, and of what is wrong with it."""
_LINK = re.compile(rf"""(?<![^\s,;"'<>|])[^\s,;"'<>|]*?{MARK}[^\s,;"'<>|]*""")
_BEFORE_NAMES = re.compile(r"^(?:[-–*+•=]{1,2}\s|\d+[.)]\s|[\s,;:|\"'<>])*")
"""What may stand before a name in a list: the sign or number of its line, and quotation marks. A name may begin with a sign."""
_BEHIND_NAMES = " \t,;:|\"'<>-–="
STYLE = (Path(__file__).parent / "wall.css").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Given:
    """A model that was handed in: whose it is, its text or link, and why it cannot be read, if so."""

    name: str
    text: str
    problem: str = ""


@dataclass(frozen=True)
class Tile:
    """A plant on the wall.

    name
        Whose it is.
    picture, description, rules
        SVG text, what it shows in words, and its model; empty if it cannot be drawn.
    mistake
        Why it cannot be drawn; empty otherwise.
    """

    name: str
    picture: str = ""
    description: str = ""
    rules: str = ""
    mistake: str = ""


def wall(folder: str | Path) -> list[Tile]:
    """What stands in a folder, drawn: files with a model, or with links, one a line, perhaps with a name before each."""
    given = [each for file in handed_in(folder) for each in models_in(file)]
    if len(given) > MOST_TILES or sum(len(each.text) for each in given) > MOST_CHARACTERS:
        raise ModelFileError(
            f'There is more in "{quotable(str(folder))}" than {MOST_TILES:,} plants, or than {MOST_CHARACTERS:,} characters',
            hint="Make several pages.",
        )
    _prepare()
    texts = list(dict.fromkeys(each.text for each in given if not each.problem))  # what several hand in is drawn once
    drawn = _drawn(texts)
    return [Tile(each.name, mistake=each.problem) if each.problem else _tile(each.name, drawn[each.text]) for each in given]


def _drawn(texts: Sequence[str]) -> dict[str, object]:
    """What comes of each text: those that are soon drawn, and then those that take long, each with an equal share of time."""
    found = dict(zip(texts, _in_children(texts, QUICK, TOGETHER), strict=True))
    slow = [text for text in texts if found[text] == {}]
    share = min(LONGEST, SHARED / max(len(slow), 1))
    if slow and share > QUICK:
        found.update(zip(slow, _in_children(slow, share, 1), strict=True))
    mistake = f"It takes more than {max(share, QUICK):.2g} seconds to draw"
    if share < LONGEST:
        mistake += f"; the {len(slow)} models here that take long have {SHARED:g} seconds together"
    return {text: each or {"mistake": f"{mistake}."} for text, each in found.items()}


def _in_children(texts: Sequence[str], seconds: float, together: int) -> list[object]:
    return in_child_processes(partial(drawn_as, seconds=seconds), texts, ceil(seconds) + 1, "drawn", together)


def _prepare() -> None:
    """Load what reads and draws, which children then find loaded."""
    for notation in DIALECTS:
        with suppress(LSystemError):
            read_word("A", notation)
    for each in (draw(system("K5"), 1), draw(system("J4"), 1), draw(map_system("K28"), 1)):
        assert each.svg


def _tile(name: str, found: Any) -> Tile:
    return Tile(name, mistake=found.reason) if isinstance(found, Failed) else Tile(name, **found)


# What is in a file


def models_in(file: HandedIn) -> Iterator[Given]:
    """The models and links in a file, each with its name."""
    name = quotable(file.student)
    try:
        if file.problem:
            raise ModelFileError(file.problem)
        most = 4 * current().text + 4
        content = content_of(file.path, most)
        if MARK.encode() in content:  # a list of links is read without what is no text in it
            content = content.replace(b"\0", b" ")
        text = decoded(content, "this file", most)
    except ModelFileError as mistake:
        yield Given(name, "", _said(mistake))
        return
    lines = [line for line in text.splitlines() if line.strip()]
    if sum(MARK in line for line in lines) * 2 < len(lines) or (text.count(MARK) == 1 and is_link(text)) or not lines:
        yield Given(name, text)
    else:
        yield from _links_in(lines, name)


def _links_in(lines: Sequence[str], name: str) -> Iterator[Given]:
    """The links in the lines of a list, with the names beside them, or else that of the file and their number."""
    for number, line in enumerate(lines, 1):
        found = _LINK.search(line)
        beside = [line[: found.start()].rstrip(_BEHIND_NAMES), line[found.end() :]] if found else []
        around = " ".join(_BEFORE_NAMES.sub("", each, count=1).rstrip(_BEHIND_NAMES) for each in beside).strip()
        yield Given(
            quotable(around) or (f"{name} {number}" if len(lines) > 1 else name),
            found.group() if found else line,
            "" if found else f"There is no link in this line: {quotable(line)}",
        )


# In a child process


def drawn_as(text: str, seconds: float = LONGEST) -> dict[str, str]:
    """A model drawn, as the fields of a tile; nothing if that takes longer."""
    try:
        with limits(**BUDGET, seconds=seconds):
            model = linked(text.strip()) if is_link(text) else Linked(read_any(text), {})
            picture = draw(_with_constants(model), _steps(model), **_choices(model))
            return {"picture": picture.svg, "description": _described(model, str(picture)), "rules": _rules(model)}
    except LSystemError as mistake:
        too_long = isinstance(mistake, ModelLimitError) and mistake.limit == seconds
        return {} if too_long else {"mistake": _said(mistake)}


def _steps(model: Linked) -> int | None:
    step = model.settings.get(STEP)
    return step if isinstance(step, int) else None


def _with_constants(model: Linked) -> Any:
    if not isinstance(model.system, LSystem):
        return model.system
    names = {constant.name for constant in model.system.constants}
    return with_constants(model.system, {name: value for name, value in model.settings.items() if name in names})


def _choices(model: Linked) -> Choices:
    """What else a link says of a drawing: angle and seed, or the forces of cells."""
    names = (ANGLE, SEED) if isinstance(model.system, LSystem) else tuple(set(model.settings) - {STEP, ANGLE, SEED})
    return {name: model.settings[name] for name in names if name in model.settings}


def _described(model: Linked, picture: str) -> str:
    steps = model.settings.get(STEP, getattr(model.system, "steps", None))
    return picture if steps is None or "step" in picture else f"step {steps}; {picture}"


def _rules(model: Linked) -> str:
    text = write(model.system) if isinstance(model.system, LSystem) else str(model.system)
    return text if len(text) <= LONGEST_RULES else f"{text[:LONGEST_RULES]}\n..."


def _said(mistake: LSystemError) -> str:
    """What is wrong; the hint of a limit is for somebody who can change it."""
    text = f"{mistake.message}." if isinstance(mistake, ModelLimitError) else str(mistake)
    return text if len(text) <= LONGEST_MISTAKE else f"{text[:LONGEST_MISTAKE]}..."


# The page


def wall_page(title: str, tiles: Sequence[Tile]) -> str:
    """One HTML file that shows the tiles.

    >>> page = wall_page("Class 3b", [Tile("Ann", "<svg/>", "a plant", "a -> b"), Tile("<i>", mistake="It is no plain file")])
    >>> "<i>" in page, "script-src" in page, page.count("<figure")
    (False, False, 2)
    """
    missing = sum(bool(tile.mistake) for tile in tiles)
    count = f"{len(tiles) - missing} drawn" + (f", {missing} that cannot be drawn" if missing else "")
    body = f"<header><h1>{escaped(title)}</h1><p>{count}</p></header>\n<main>\n{''.join(map(_figure, tiles))}</main>\n"
    return document(title, body, STYLE, f"Plants of a class: {count}")


def _figure(tile: Tile) -> str:
    name = f"<b>{escaped(tile.name)}</b>"
    if tile.mistake:
        said = "\n".join(map(escaped, tile.mistake.split("\n")))
        return (
            f'<figure class="mistake"><figcaption>{name}<span>cannot be drawn</span></figcaption><pre>{said}</pre></figure>\n'
        )
    source = base64.b64encode(tile.picture.encode()).decode()
    rules = "\n".join(map(escaped, tile.rules.split("\n")))
    return (
        f'<figure><img loading="lazy" alt="{escaped(tile.description)}" src="data:image/svg+xml;base64,{source}">'
        f"<figcaption>{name}<span>{escaped(tile.description.partition(', width')[0])}</span></figcaption>"
        f"<details><summary>Rules</summary><pre>{rules}</pre></details></figure>\n"
    )
