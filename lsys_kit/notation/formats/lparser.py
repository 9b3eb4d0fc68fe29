"""Files of LParser (L. Lapré, 1994): three numbers, an axiom and rules, each on a line of its own.

Recursion, angle and thickness come first, perhaps below a title; what stands behind "#" or ";" says nothing; "@" ends the
file. Its signs are a table of `fields.toml`.
"""

from __future__ import annotations

import re
from fractions import Fraction

from lsys_kit.errors import ModelSyntaxError, quotable
from lsys_kit.notation.formats.found import Found, Passage, Rule, symbols_in, tables

_RULE = re.compile(r"[^\s=]{1,12}[ \t]*=(?!=)")
_IS_PART = re.compile(rf"{_RULE.pattern}|axiom\b|.*->", re.IGNORECASE)
"""What is no title."""
_NUMBER = re.compile(r"\d+(?:\.\d*)?")
_COMMENT = re.compile(r"#[^\n]*|(?:^|(?<=[ \t]));[ \t=-][^\n]*", re.MULTILINE)
"""What says nothing: a semicolon alone makes turns greater."""


def systems_in_lparser(text: str) -> list[Found]:
    """The system of a file of LParser.

    >>> [found] = systems_in_lparser("# a bush\\n6\\n22.5 # angle\\n30\\nA\\nA=F[+A]>A\\n@")
    >>> found.steps[0], float(found.angle[0]), found.axiom[0].text, found.rules[0].tail[0].text
    (6, 22.5, 'A', 'F[+A]>A')
    """
    lines = [Passage(line[0], line.start()).part(0) for line in re.finditer(r"[^\n]+", _COMMENT.sub(_blank, text))]
    lines = [line for line in lines if line.text]
    above = next((index for index, line in enumerate(lines) if _NUMBER.fullmatch(line.text)), 0)
    title, lines = lines[:above], lines[above:]
    numbers = [line for line in lines[:3] if _NUMBER.fullmatch(line.text)]
    rest = lines[len(numbers) :]
    if len(numbers) < 2 or numbers != lines[: len(numbers)] or not rest:
        return []
    end = next((index for index, line in enumerate(rest) if line.text.startswith("@")), len(rest))
    rest = rest[:end]
    if (
        (title and (len(numbers) < 3 or any(_IS_PART.match(line.text) for line in title)))
        or len(rest) < 2
        or not all(_RULE.match(line.text) for line in rest[1:])
        or rest[0].text.lower().startswith("axiom")
    ):
        return []
    if len(numbers) < 3:
        hint = "Three lines with numbers stand above the axiom: the recursion, the angle and the thickness."
        raise ModelSyntaxError(
            "A number is missing above the axiom of this file of LParser",
            text,
            rest[0].at,
            rest[0].at + len(rest[0].text),
            hint,
        )
    signs = tables()["signs"]["lparser"]
    found = Found(axiom=(rest[0],), signs=signs["signs"], name=title[0].text if title else "")
    found.notes += [f'"{quotable(line.text)}" is left out: it stands above the first number.' for line in title]
    found.steps = int(numbers[0].text.split(".")[0][:6]), numbers[0]
    found.angle = Fraction(numbers[1].text.rstrip(".")), numbers[1]
    for line in rest[1:]:
        head = line.text.partition("=")[0]
        found.rules.append(Rule(line.part(0, len(head)), (line.part(len(head) + 1),)))
    words = [rest[0], *(part for rule in found.rules for part in rule.tail)]
    _check(words, signs["lacks"], text)
    heads = {rule.head.text for rule in found.rules}
    used = {word.text[a:b] for word in words for a, b, values in symbols_in(word.text) if not values}
    found.drawn = {symbol: command for symbol, command in signs["drawn"].items() if symbol in used - heads}
    if used & {"t", "!", "?"} - heads:
        found.notes.append("Widths are 0.7 or 10/7 times as great wherever they change, and gravity (t) is left out.")
    return [found]


def _blank(match: re.Match[str]) -> str:
    return " " * len(match[0])


def _check(words: list[Passage], lacks: dict[str, str], text: str) -> None:
    """Refuse a sign that the kit's turtle has not."""
    for word in words:
        for start, end, values in symbols_in(word.text):
            if not values and (does := lacks.get(word.text[start:end])):
                at = word.at + start
                raise ModelSyntaxError(
                    f"LParser's \"{text[at]}\" {does}, which the kit's turtle does not",
                    text,
                    at,
                    at + 1,
                    "Write each turn with its angle: +(30).",
                )
