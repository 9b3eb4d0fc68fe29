"""A file of Fractint's cut up: into its systems, and a system into its lines.

    Koch1 { ; a comment
      Angle 6
      Axiom F--F--F
      F=F+F--F+F
      }

What stands outside of the braces says nothing, nor does what stands behind a ";". An entry that is called "comment" is no
system, nor is one without a name, unless all are without.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from heapq import merge
from itertools import chain, islice
from typing import NamedTuple

from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError, quotable
from lsys_kit.notation.analysis.checks import suggestion

_COMMENT = re.compile(r";[^\r\n]*")
_KEPT = re.compile(r"^[ \t]*(;[ \t]*steps:[ \t]*\d{1,300})[ \t]*\r?$", re.MULTILINE)
"""A comment in which a text keeps what Fractint asks for: `; steps: 4`, alone on its line."""
_LINE = re.compile(r"[^\r\n\f\x1a]+")
_NAME = re.compile(r"[^\s(\ufeff]+")
_BLANKS = " \t\v\u00a0\ufeff"
MOST_ENTRIES = 10_000
"""So many systems a file may have."""
NAMES_LISTED = 60
"""So many names are listed where one is to be chosen."""


class FileEntry(NamedTuple):
    """One system of a file: its name and where that stands, the offsets of its brace and the next, and if that closes it."""

    name: str
    at: int
    opened: int
    stop: int
    closed: bool


def uncommented(text: str) -> str:
    """The text with its comments blanked, every other character in its place.

    >>> uncommented("F=FF ; twice")
    'F=FF        '
    """
    return _COMMENT.sub(lambda comment: " " * len(comment[0]), text)


def entries(text: str) -> list[FileEntry]:
    """The systems of a file, in their order.

    >>> [entry.name for entry in entries("Koch { Angle 6 } comment { ... } Dragon (old) {")]
    ['Koch', 'Dragon']
    """
    found = [*islice(entries_in(uncommented(text)), MOST_ENTRIES + 1)]
    if len(found) > MOST_ENTRIES:
        raise ModelLimitError(
            f"This text has more than {MOST_ENTRIES:,} systems", limit=MOST_ENTRIES, source=text, start=found[-1].at
        )
    return system_entries(found)


def system_entries(found: Iterable[FileEntry]) -> list[FileEntry]:
    """Those entries that are systems."""
    systems = [entry for entry in found if entry.name.lower() != "comment"]
    return [entry for entry in systems if entry.name] or systems


def entries_in(plain: str) -> Iterator[FileEntry]:
    """What begins with a brace, in a text without comments; where a brace opens before one is closed, another entry begins."""
    braces = chain((match.start() for match in re.finditer(r"[{}]", plain)), (len(plain),))
    before, at = -1, next(braces)
    for after in braces:
        if plain[at] == "{" and plain[max(0, at - 20) : at].rstrip(_BLANKS)[-1:] not in ("=", ":"):  # V = {A, B} is a set
            yield FileEntry(*_name(plain, before + 1, at), at, after, plain[after : after + 1] == "}")
        before, at = at, after


def _name(plain: str, start: int, end: int) -> tuple[str, int]:
    """The name before a brace, and its offset: it stands on the same line, or on one above."""
    lines = [line for line in _LINE.finditer(plain, start, end) if line[0].strip(_BLANKS)]
    name = _NAME.search(plain, lines[-1].start(), end) if lines else None
    return (name[0], name.start()) if name else ("", end)


def selected_entry(text: str, name: str | None) -> str:
    """The text with one of its systems in it, and every other character but the ends of lines blanked.

    Raises
    ------
    ModelValueError
        There are several systems, and none is named.
    ModelNameError
        None has the name.

    Examples
    --------
    >>> selected_entry("A { Angle 4 } B { Angle 5 }", "b")
    '              B { Angle 5 }'
    """
    found = entries(text)
    if name is not None:
        entry = _named(found, name)
    elif len(found) == 1:
        entry = found[0]
    elif "{" in uncommented(text):
        raise _which(found, text)
    else:
        return text
    end = entry.stop + 1 if entry.closed else entry.opened + 1
    return _blank(text[: entry.at]) + text[entry.at : end] + _blank(text[end:])


def _blank(text: str) -> str:
    return re.sub(r"[^\r\n]", " ", text)


def _named(found: Sequence[FileEntry], name: str) -> FileEntry:
    """The first system with a name; where none is spelt so, case does not matter."""
    alike = [entry for entry in found if entry.name.lower() == name.lower()]
    if not alike:
        names = _names(found)
        hint = suggestion(name, names) or (_listed(names) if names else "The systems of this text have no names.")
        raise ModelNameError(f'There is no system called "{quotable(name)}" in this text', hint=hint)
    return next((entry for entry in alike if entry.name == name), alike[0])


def _which(found: Sequence[FileEntry], text: str) -> LSystemError:
    if not found:
        return ModelSyntaxError(
            "There is no system in this text",
            text,
            uncommented(text).index("{"),
            None,
            'A system reads "Koch { ... }", with the angle, the axiom and the rules in the braces.',
        )
    names, second = _names(found), found[1]
    choose = (
        f'Choose one by its name: read(text, name="{quotable(names[0])}"), or --name in a shell. {_listed(names)}'
        if names
        else 'Give each a name before its "{", as in "Koch {".'
    )
    return ModelValueError(
        f"There are {len(found):,} systems in this text", text, second.at, second.at + max(1, len(second.name)), choose
    )


def _names(found: Sequence[FileEntry]) -> list[str]:
    return [*dict.fromkeys(entry.name for entry in found if entry.name)]


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - NAMES_LISTED:,} more" if len(names) > NAMES_LISTED else ""
    return f"The systems are {', '.join(map(quotable, names[:NAMES_LISTED]))}{more}."


def statement_lines(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of the lines of the one system in a text, without braces, comments and blanks around, but for the comments
    that say something.

    >>> text = "Koch { Angle 6 ; sixths\\n Axiom F }"
    >>> [text[start:end] for start, end in statement_lines(text)]
    ['Angle 6', 'Axiom F']
    """
    found = entries(text)
    if found and not found[0].closed:
        raise ModelSyntaxError(
            'This "{" is never closed', text, found[0].opened, None, 'A system ends with "}", before the next one begins.'
        )
    first, last = (found[0].opened + 1, found[0].stop) if found else (0, len(text))
    said = ((line.start(), line[0], line[0].strip(_BLANKS)) for line in _LINE.finditer(uncommented(text), first, last))
    lines = ((start + line.index(part), start + line.index(part) + len(part)) for start, line, part in said if part)
    yield from merge(lines, (kept.span(1) for kept in _KEPT.finditer(text, first, last)))
