"""What the lessons' texts ask a reader to do, sentence by sentence; `requests.toml` says of each how it is done."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import nbformat

from tests.notebooks.rebuild import ROOT

VERBS = (
    "add|change|choose|click|copy|delete|do the same|drag|exchange|fill in|get|go back|leave out|let|make|move|open|play|press|"
    "put|remove|replace|run|select|set|swap|switch|take away|touch|try|type|use|vote|write"
)
"""What a reader does with a panel, a table, a question or a cell of code."""
BEFORE = r"and|then|now|first|also|better|you can|you may|panel|panel above|for the table|of section \d+"
ASKED = re.compile(rf"(?:^|[,:;(–]\s|\b(?:{BEFORE})\s)(?:{VERBS})\b", re.IGNORECASE)
"""A verb where an imperative stands: at the beginning of a sentence or of a part of it, or after the place where it is done."""
MARKUP = re.compile(r"</?\w+[^>]*>|[*>#]|^\s*(?:-|\d\.)\s", re.MULTILINE)
LABEL = re.compile(
    r"^(?:Look|Open|Predict first|Optional|Observe|Change it|Write them|Run and draw|Try (?:this|these), too)[.:,]\s+"
)
"""What stands in bold before some sentences."""
IN_CODE = re.compile(r"`[^`\n]*`")


@dataclass(frozen=True)
class Request:
    """A sentence of a lesson that asks for something, and the number of its cell."""

    lesson: str
    cell: int
    says: str


def lessons() -> list[Path]:
    return sorted((ROOT / "notebooks").glob("[0-9][0-9]_*.ipynb"))


def requests() -> Iterator[Request]:
    """All sentences of the lessons' texts that ask for something."""
    for path in lessons():
        for number, cell in enumerate(nbformat.read(path, as_version=4).cells):
            if number and cell.cell_type == "markdown":
                yield from (Request(path.stem[:2], number, said) for said in sentences(cell.source) if asks(said))


def asks(sentence: str) -> bool:
    """Whether a sentence asks a reader to do something.

    >>> asks("Move the step, and fill in the table."), asks("Now press Check."), asks("A set of words is a language.")
    (True, True, False)
    """
    return ASKED.search(IN_CODE.sub("x", LABEL.sub("", sentence))) is not None


def sentences(text: str) -> Iterator[str]:
    """The sentences of a text in Markdown, without its marks; headings and tables are none.

    >>> [*sentences("## A title\\n\\n**Look.** Move *step*\\nto 4. Then `a.b`.\\n\\n- Press it.")]
    ['Look. Move step to 4.', 'Then `a.b`.', 'Press it.']
    """
    for block in re.split(r"\n\s*\n|\n(?=\s*(?:-|\d\.)\s)", text):
        lines = "\n".join(line for line in block.splitlines() if not re.match(r"\s*(?:#|\||\*\*Contents|```)", line))
        plain = " ".join(
            MARKUP.sub("", IN_CODE.sub(lambda code: code.group().replace("*", "\0").replace(">", "\1"), lines)).split()
        )
        plain = plain.replace("\0", "*").replace("\1", ">")
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", plain)
        yield from (
            each for each in re.split(r"(?:(?<=[.?!])|(?<=[.?!]\)))\s+(?=[\"'(`A-Z*])(?<!Look\. )(?<!too\. )", plain) if each
        )
