"""A listing on a page of The Algorithmic Beauty of Plants, which the kit's notation reads when what is around it is left out.

A copied page has sentences, captions, numbers of pages and equations around its listing. A line is a part of the listing if it
has an arrow, names the axiom or a constant, is a word above a production, a number over an arrow, or goes on with a production.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsys_kit.notation.formats.found import Found
from lsys_kit.notation.formats.lines import OWN_FRAME
from lsys_kit.notation.formats.parts import ARROW, is_word
from lsys_kit.notation.syntax.text.statements import LABEL, is_unfinished, pending
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, as_typed, edited
from lsys_kit.notation.syntax.text.transcription import left_out as note_on

_LISTING = re.compile(rf"^[ \t]*(?:{LABEL}[ \t]*:|[ωw][ \t]*:|p[ \t]*:|#[ \t]*(?:define|ignore))", re.MULTILINE)
"""What such listings have, and others hardly."""
_STATEMENT = re.compile(
    rf".*{ARROW}|[ \t]*(?:#[ \t]*(?:define|ignore|include|consider)\b|(?:ignore|consider)\b(?=[ \t]*:|[^a-z]*$)"
    r"|[ωw][ \t]*:|n[ \t]*=|δ[ \t]*=)",
    re.MULTILINE,
)
_NUMBERED = re.compile(r"(?:(?<![ \t])[ \t]{2,}+|(?<=\))[ \t])(\(\d+(?:\.\d+)*[a-z]?\))[ \t]*$")
_ABOVE = re.compile(r"[ \t]*(?:0?\.\d+|1)[ \t]*")
_OTHER = re.compile(r"[ \t]*(?:Figure|Fig\.|Table|Section|Chapter)\b", re.IGNORECASE)
_ANGLE = re.compile(r"(?:angle|δ)[^.\n]{0,40}?(?<![\d.])(\d{1,3}(?:\.\d+)?)[ ]?(?:°|deg)", re.IGNORECASE)
_STEPS = re.compile(r"(?<![\w.])n[ ]?=[ ]?(\d{1,4})(?!\d|\.\d)")
_NAME = re.compile(rf"(?:{LABEL}[ \t]*:[ \t]*|^[ \t]*)([a-z]\w+)", re.MULTILINE)
_ARROW = re.compile(ARROW)
_BARE_LABEL = re.compile(rf"[ \t]*+[pP][ \t]*+:(?=[ \t]*+[^\s:<>=]{{1,20}}[ \t]*+(?:0?\.\d++[ \t]*+)?{ARROW})")
"""The label of the only production."""


def listings_on_a_page(text: str) -> list[Found]:
    """The one listing on a page.

    >>> [found] = listings_on_a_page("Here is one:\\nω : F\\np1 : F → FF   (1.2)\\nFigure 1: A line")
    >>> found.listing.text.split("\\n")
    ['', 'ω : F', 'p1 : F → FF   ', '']
    """
    if not _LISTING.search(text) or OWN_FRAME.search(text):
        return []
    edits: list[Edit] = []
    lines = [*re.finditer(r"[^\n]+|(?<=\n)(?=\n)", text)]
    letters = frozenset("".join(_names(text)))
    before, rule = False, ""
    left_out, notes = [], []
    for index, line in enumerate(lines):
        said = line[0]
        above = next((each[0] for each in lines[index + 1 :] if each[0].strip()), "")
        part = bool(_STATEMENT.match(said)) and not _OTHER.match(said) and not _is_sentence(said)
        if not part and said.strip():
            word = is_word(said, letters) and not _OTHER.match(said)
            part = (word and (before or (is_unfinished(rule) and len(said.strip()) > 3))) or (
                bool(re.search(ARROW, above))
                and (word or bool(_ABOVE.fullmatch(said)))
                and not _LISTING.match(said)
                and len(said.strip()) > 1
            )
        if part and (label := _BARE_LABEL.match(said)):
            edits.append(Edit(line.start(), line.start() + label.end(), ""))
        if part and (number := _NUMBERED.search(said)):
            edits.append(Edit(line.start() + number.start(1), line.start() + number.end(1), ""))
        if not part and said.strip():
            edits.append(Edit(*line.span(), ""))
            left_out.append(said)
            if rule and is_word(said, letters):
                notes.append(note_on(said))
        if part:
            rule = said if re.search(ARROW, said) else pending(rule + said) if rule else ""
        before = part if said.strip() else False
    if not left_out and not edits:
        return []
    listing = edited(as_typed(text), edits, notes)
    prose = "\n".join(left_out)
    return [Found(listing=_with_settings(listing, prose))]


def _is_sentence(line: str) -> bool:
    """Whether a line is prose, though it has an arrow or an equals sign."""
    return len(re.findall(r"(?<![\w#])[A-Za-z]{3,}(?=[ ,.]|$)", re.sub(r"/\*.*", "", line.split(":")[-1]))) > 6


def _with_settings(listing: Transcript, prose: str) -> Transcript:
    """A listing with the angle and the number of steps that stand in sentences around it, where it has none itself."""
    settings, notes = "", []
    if not re.search(r"δ|angle", listing.text) and len(angles := {match[1] for match in _ANGLE.finditer(prose)}) == 1:
        [angle] = angles
        settings += f"angle: {angle}\n"
        notes.append(f"The angle {angle} is that of the text around.")
    if not re.search(r"(?<!\w)n[ ]?=", listing.text) and len(steps := {match[1] for match in _STEPS.finditer(prose)}) == 1:
        [number] = steps
        settings += f"steps: {number}\n"
        notes.append(f"The number of steps, {number}, is that of the text around.")
    return edited(listing, [Edit(0, 0, settings)] if settings else [], notes)


def _names(text: str) -> Iterator[str]:
    """The names of several letters that begin a line or follow a label, with an arrow behind them in their line."""
    at = 0
    while match := _NAME.search(text, at):
        end = text.find("\n", match.end())
        end = len(text) if end < 0 else end
        arrow = _ARROW.search(text, match.end(), end)
        if arrow:
            yield match[1]
        at = arrow.end() if arrow else end
