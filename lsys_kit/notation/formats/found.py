"""What was found of an L-system in a text that is in no notation of the kit, and the same as a listing in the kit's own.

A reader of a format finds passages: an axiom, rules, an angle. They are written one below another in the kit's notation, each
character with its place in what was pasted, so that the kit's own reader does the rest, and its errors are shown there.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from typing import Any, NamedTuple

from lsys_kit.errors import quotable
from lsys_kit.files import Entries, toml_tables
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, assembled


@cache
def tables() -> Entries:
    """The words by which the parts of a system are called; `fields.toml` explains its keys."""
    return toml_tables(__package__, "fields.toml")


class Passage(NamedTuple):
    """A part of a text, and the offset at which it stands; of what was written otherwise there, with escapes, its beginning."""

    text: str
    at: int
    exact: bool = True

    def part(self, start: int, end: int | None = None) -> Passage:
        """A part of it, without blanks around."""
        end = len(self.text) if end is None else end
        said = self.text[start:end]
        start += len(said) - len(said.lstrip())
        return Passage(said.strip(), self.at + start if self.exact else self.at, self.exact)

    def piece(self, start: int, end: int, text: str) -> Edit:
        """What is written for its characters from one offset to another."""
        return Edit(self.at + start, self.at + end, text) if self.exact else Edit(self.at, self.at, text)


@dataclass(frozen=True)
class Rule:
    """A production that was found.

    Attributes
    ----------
    head
        Strict predecessor, with contexts and a condition behind a colon.
    tail
        The successor, perhaps in several parts.
    probability
        A number, or None.
    section
        The section in which it stands: "" among the productions, "decomposition" or "interpretation".
    """

    head: Passage
    tail: tuple[Passage, ...]
    probability: Fraction | None = None
    section: str = ""


@dataclass
class Found:
    """The parts of an L-system that were found in a text.

    Attributes
    ----------
    name
        Its name, where the text has one.
    lines
        Statements in the kit's notation, each as it stands: settings, constants.
    signs
        What is written for signs that mean something else than in the kit's notation.
    drawn
        Symbols, and the command as which each is drawn.
    notes
        What was understood.
    assumed
        Whether the axiom is what the one rule rewrites, since none was found.
    listing
        A text in the kit's notation that is all of it, in place of its parts.
    calculated
        What a program makes a word for, instead of giving it.
    joined
        Whether that is made of texts, as in "F" + turn, so that the text is surely a program.
    loose
        Where rules stand that nothing calls rules.
    program
        What `fields.toml` says of the signs of the program whose names the text has.
    """

    name: str = ""
    axiom: tuple[Passage, ...] | None = None
    rules: list[Rule] = field(default_factory=list)
    angle: tuple[Fraction, Passage] | None = None
    steps: tuple[int, Passage] | None = None
    ignored: Passage | None = None
    lines: list[Passage] = field(default_factory=list)
    signs: Mapping[str, str] = field(default_factory=dict)
    drawn: dict[str, str] = field(default_factory=dict)
    names: frozenset[str] = frozenset()
    notes: list[str] = field(default_factory=list)
    listing: Transcript | None = None
    assumed: bool = False
    calculated: Passage | None = None
    joined: bool = False
    loose: set[int] = field(default_factory=set)
    program: Mapping[str, Any] = field(default_factory=dict)

    @property
    def complete(self) -> bool:
        """Whether it has an axiom and a rule."""
        return self.listing is not None or (self.axiom is not None and bool(self.rules))


def program_of(name: str) -> Mapping[str, Any]:
    """What `fields.toml` says of the signs of the program that calls a part by a name; nothing for any other name.

    >>> program_of("Premise")["title"], program_of("axiom")
    ('Houdini', {})
    """
    return next((signs for signs in tables()["signs"].values() if name.lower() in signs["by"]), {})


def take_signs(found: Found) -> None:
    """Read the commands of a program's turtle, and say which are other than the kit's."""
    used = {
        sign for word in (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail)) for sign in word.text
    }
    found.signs = {**found.program.get("signs", {}), **found.signs}
    found.drawn |= {sign: command for sign, command in found.program.get("drawn", {}).items() if sign in used}
    found.notes += [note for signs, note in found.program.get("notes", {}).items() if not used.isdisjoint(signs)]


_ARGUMENTS = re.compile(r"[()]")
_SYMBOL = re.compile(r"[A-Za-z]_\{?[A-Za-z0-9]\}?(?![A-Za-z0-9])|[A-Za-z_]|\d|@[IQ]{0,2}(?:\d+(?:\.\d+)?|\.\d+)|@[A-Za-z]+|\S")
_SCALED = re.compile(r"@([IQ]{0,2})(\d+(?:\.\d+)?|\.\d+)")
"""Fractint's factor of lengths: a number, its inverse (I), its root (Q)."""


def symbols_in(text: str, names: frozenset[str] = frozenset()) -> Iterator[tuple[int, int, bool]]:
    """The offsets of the symbols of a word, and of the values of each, for which the third is true.

    >>> [("F(x)[AB]"[start:end], values) for start, end, values in symbols_in("F(x)[AB]")]
    [('F', False), ('(x)', True), ('[', False), ('A', False), ('B', False), (']', False)]
    """
    longest, at = max(map(len, names), default=0), 0
    while at < len(text):
        if text[at].isspace():
            at += 1
        elif text[at] == "(" and at:
            end = _closed(text, at)
            yield at, end, True
            at = end
        else:
            size = next((size for size in range(longest, 1, -1) if text[at : at + size] in names), 0)
            match = _SYMBOL.match(text, at)
            end = at + size if size else match.end() if match else at + 1
            yield at, end, False
            at = end


def _closed(text: str, start: int) -> int:
    """The offset behind the bracket that closes one."""
    depth = 0
    for match in _ARGUMENTS.finditer(text, start):
        depth += 1 if match[0] == "(" else -1
        if depth == 0:
            return match.end()
    return len(text)


def _word(passage: Passage, found: Found) -> Iterator[Edit]:
    """A word in the kit's spelling: names and digits apart."""
    before = ""
    swallowed = False
    for start, end, values in symbols_in(passage.text, found.names):
        text = passage.text[start:end]
        if values:
            text = "" if swallowed else _numbers(text)
        else:
            inner = (
                passage.text[end + 1 : _closed(passage.text, end) - 1].strip() if passage.text[end : end + 1] == "(" else None
            )
            text, swallowed = _sign(text, inner, found.signs)
        glued = before[-1:].isalnum() or before[-1:] == "_"
        if (text and glued and (text[0].isalnum() or text[0] == "_")) or (before.isdigit() and values):
            yield passage.piece(start, start, " ")
        yield passage.piece(start, end, text)
        before = text or before


def _sign(text: str, values: str | None, signs: Mapping[str, str]) -> tuple[str, bool]:
    """A symbol in the kit's spelling, and whether its values are in it, or left out."""
    if scaled := _SCALED.fullmatch(text):
        factor = _numbers(scaled[2])
        for letter in reversed(scaled[1]):
            factor = f"1/{factor}" if letter == "I" else f"sqrt({factor})"
        return f"@Di({factor})", False
    if re.fullmatch(r"[A-Za-z]_\{\w\}", text):
        return text.replace("{", "").replace("}", ""), False
    made = signs.get(f"{text}(") if values is not None else None
    if made is None:
        return signs.get(text, text), False
    return made.removesuffix(" !").replace("{x}", values or ""), "{x}" in made or made.endswith(" !")


CONDITION = re.compile(r":|\{|(?<=[ \t)])(?:if|when)(?=[ \t])")
"""How the condition of a rule begins."""


def _head(passage: Passage, found: Found) -> Iterator[Edit]:
    """What stands before the arrow: words on both sides of "<" and ">", and a condition as it stands."""
    condition = CONDITION.search(passage.text)
    end = condition.start() if condition else len(passage.text)
    depth, at = 0, 0
    for index, sign in enumerate(passage.text[:end] + "\0"):
        depth += (sign == "(") - (sign == ")")
        if sign == "\0" or (sign in "<>" and depth <= 0):
            side = passage.text[at:index]
            if side.strip() not in ("", "*"):
                yield from _word(passage.part(at, index), found)
            if sign != "\0":
                yield passage.piece(index, index + 1, f" {sign} ")
            at = index + 1
    if condition:
        said = passage.text[condition.end() :].removesuffix("}")
        yield passage.piece(end, len(passage.text), f" :{_condition(said)}")


def _condition(text: str) -> str:
    """A condition in the kit's spelling; a single "=" compares in some programs."""
    text = re.sub(r"(?<![<>=!:])=(?!=)", "==", _numbers(text).replace("≤", "<=").replace("≥", ">="))
    return text.replace(" and ", " && ").replace(" or ", " || ")


def _numbers(text: str) -> str:
    """Expressions with numbers as the kit has them, and not "3." and ".5"; "**" is a power in Python."""
    return re.sub(r"(?<=\d)\.(?![\d.])", ".0", re.sub(r"(?<![\w.])\.(?=\d)", "0.", text)).replace("**", "^")


def _words(passages: Iterable[Passage], found: Found) -> Iterator[Edit]:
    for passage in passages:
        for index, edit in enumerate(_word(passage, found)):
            if index == 0:
                yield Edit(edit.start, edit.start, " ")
            yield edit


def number_text(value: Fraction) -> str:
    """A number, as it is typed: with a point, or as a quotient.

    >>> number_text(Fraction(51, 2)), number_text(Fraction(1, 3))
    ('25.5', '1/3')
    """
    decimal = repr(float(value))
    return str(value) if value.denominator == 1 or "e" in decimal or Fraction(decimal) != value else decimal


def _digits(found: Found) -> list[str]:
    """The digits that are symbols."""
    heads = (Passage(CONDITION.split(rule.head.text)[0], 0) for rule in found.rules)
    words = [*(found.axiom or ()), *heads, *(part for rule in found.rules for part in rule.tail)]
    seen = {word.text[a:b] for word in words for a, b, values in symbols_in(word.text, found.names) if not values}
    return sorted({*filter(str.isdigit, seen), *(symbol for symbol in found.drawn if symbol.isdigit())})


def _named_or_long(found: Found) -> list[str]:
    return sorted(name for name in found.names if len(name) > 1)


_SECTIONS = ("", "decomposition", "interpretation")
"""The sections in their order."""


def listing(found: Found) -> Iterator[Edit]:
    """What was found as a listing in the kit's notation, in pieces with their places in the text that was read."""
    at = found.axiom[0].at if found.axiom else 0
    alphabet = [*_named_or_long(found), *_digits(found)]
    if alphabet:
        yield Edit(at, at, f"alphabet: {' '.join(alphabet)}\n")
    for line in found.lines:
        yield line.piece(0, len(line.text), line.text)
        yield Edit(line.at, line.at, "\n")
    for name, setting in (("angle", found.angle), ("steps", found.steps)):
        if setting:
            value, place = setting
            yield place.piece(0, len(place.text), f"{name}: {number_text(Fraction(value))}")
            yield Edit(place.at, place.at, "\n")
    if found.ignored:
        yield Edit(found.ignored.at, found.ignored.at, "ignore:")
        yield from _words([found.ignored], found)
        yield Edit(found.ignored.at, found.ignored.at, "\n")
    if found.axiom:
        yield Edit(at, at, "axiom:")
        yield from _words(found.axiom, found)
        yield Edit(at, at, "\n")
    section = ""
    for rule in sorted(found.rules, key=lambda rule: _SECTIONS.index(rule.section)):
        if rule.section != section:
            section = rule.section
            yield Edit(rule.head.at, rule.head.at, f"{section}:\n")
        yield from _head(rule.head, found)
        yield Edit(rule.head.at, rule.head.at, " ->")
        tail = [*_words(rule.tail, found)]
        yield from tail if any(edit.text.strip() for edit in tail) else [Edit(rule.head.at, rule.head.at, " ε")]
        if rule.probability is not None:
            yield Edit(rule.head.at, rule.head.at, f" : {number_text(rule.probability)}")
        yield Edit(rule.head.at, rule.head.at, "\n")
    if found.drawn:
        heading = "" if section == "interpretation" else "interpretation:\n"
        yield Edit(at, at, heading + "\n".join(f"{symbol} -> {command}" for symbol, command in sorted(found.drawn.items())))


def transcript_of(found: Found, before: Transcript) -> Transcript:
    """What was found in a text, in the kit's notation."""
    return found.listing or assembled(before, listing(found), [*found.notes, *_scaled(found)])


def _scaled(found: Found) -> Iterator[str]:
    """A note on the first number behind "@"."""
    words = (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail))
    if said := next(filter(None, (_SCALED.search(word.text) for word in words)), None):
        yield f"{said[0]} is read as {_sign(said[0], None, {})[0]}: as in Fractint, lengths are multiplied by the number."


_SEVERAL = re.compile(
    r"(?P<first>\d++(?:[.,]\d++)?)[ ]?(?:°|deg(?:rees?)?\b)?[ ]*\(?(?:(?:-|\.{2,3}|…|~|±|[^\W\d]{1,4})[ ]*\d|\+(?!\d)).*",
    re.DOTALL,
)
"""A range of numbers, or several."""


def first_taken(text: str) -> list[str]:
    """The note on a setting of which only the first number is taken.

    >>> first_taken("5..7"), first_taken("25 degrees")
    (['"5..7" is read as 5.'], [])
    """
    several = _SEVERAL.fullmatch(text.strip())
    return [f'"{quotable(text.strip()[:40])}" is read as {several["first"]}.'] if several else []


def not_taken(name: str, value: str) -> str:
    """The note on a setting that a drawing of the kit has not.

    >>> not_taken("start angle", "45")
    '"start angle" (45) is not taken over.'
    """
    return f'"{quotable(name)}" ({quotable(value)}) is not taken over.'


def undrawn_digits(found: Found) -> str:
    """A note on digits that are symbols, and that nothing replaces or draws: they might be values. "" where there are none."""
    heads = "".join(rule.head.text for rule in found.rules)
    digits = [] if found.listing else [digit for digit in _digits(found) if digit not in heads and digit not in found.drawn]
    if not digits:
        return ""
    one = f"The digit {digits[0]} is read as a symbol, which draws nothing."
    several = f"The digits {', '.join(digits)} are read as symbols, which draw nothing."
    return f"{one if len(digits) == 1 else several} A value is typed in brackets: C({digits[0]})."


def completed(found: Found) -> Found:
    """The same, where one rule stands alone with its first letter as its axiom."""
    if found.listing or found.axiom is not None or len(found.rules) != 1:
        return found
    head = found.rules[0].head
    symbol = next((head.part(start, end) for start, end, values in symbols_in(head.text, found.names) if not values), None)
    again = symbol and (len(symbol.text) == 1 or symbol.text in "".join(part.text for part in found.rules[0].tail))
    if symbol is None or not symbol.text.isalnum() or not again:
        return found
    return replace(
        found,
        assumed=True,
        axiom=(symbol,),
        notes=[*found.notes, f'No axiom is given: it is "{symbol.text}", what the one rule rewrites.'],
    )


def unquoted(passage: Passage) -> Passage:
    """A passage without the quotation marks around it."""
    text = passage.text
    if len(text) > 1 and text[0] == text[-1] and text[0] in "\"'`" and text.count(text[0]) == 2:
        return passage.part(1, len(text) - 1)
    return passage


def chance_of(text: str | None) -> Fraction | None:
    """A probability as it was written, as in "33%", ".4" or "(1/3)".

    >>> chance_of("(20 %)"), chance_of(".5")
    (Fraction(1, 5), Fraction(1, 2))
    """
    if not text:
        return None
    bare = text.strip("() \t").rstrip("%").strip()
    top, _, bottom = bare.partition("/")
    value = (
        Fraction(f"0{top}" if top.startswith(".") else top) / Fraction(bottom or 1)
        if bottom.strip("0") or not bottom
        else Fraction(0)
    )
    return value / 100 if "%" in text else value


_PI = r"(?:[A-Za-z]++\.|M_)?(?:pi|π)"
_N = r"(-?\d++(?:[.,]\d++)?)"
_ANGLES: Sequence[tuple[re.Pattern[str], Callable[..., Fraction]]] = (
    (re.compile(rf"\A(?:[A-Za-z]++\.)?(?:to_?)?(?:radians|deg2rad)\s*\(\s*{_N}\s*\)", re.IGNORECASE), lambda n: n),
    (re.compile(rf"\A{_N}\s*\*\s*+\(?\s*{_PI}\s*/\s*180(?:\.0*)?\s*+\)?", re.IGNORECASE), lambda n: n),
    (re.compile(rf"\A{_PI}\s*/\s*180(?:\.0*)?\s*\*\s*{_N}", re.IGNORECASE), lambda n: n),
    (re.compile(rf"\A{_PI}\s*/\s*{_N}", re.IGNORECASE), lambda n: 180 / n),
    (re.compile(rf"\A{_N}\s*+\*?\s*{_PI}", re.IGNORECASE), lambda n: 180 * n),
    (re.compile(rf"\A{_N}\s*+\*?\s*{_PI}\s*/\s*{_N}", re.IGNORECASE), lambda n, parts: 180 * n / parts),
    (re.compile(r"\A1/(\d++)[ ](?:of an?[ ])?(?:full[ ])?(?:turn|circle|revolution)"), lambda n: 360 / n),
    (re.compile(rf"\A360\.?0*°?\s*/\s*{_N}°?"), lambda n: 360 / n),
)
"""How programs write an angle: as what of which number in degrees."""
_NUMBER = re.compile(r"(-?(?:\d+(?:[.,]\d+)?|\.\d+)(?:/[1-9]\d*)?)\s*\*?\s*(.*)", re.DOTALL)


def angle_of(text: str) -> Fraction | None:
    """An angle in degrees, as somebody wrote it; None for what is no number.

    >>> [angle_of(text) for text in ("25,7°", "pi/3", "radians(25)", "sixty")]
    [Fraction(257, 10), Fraction(60, 1), Fraction(25, 1), None]
    """
    text = text.strip().lstrip("±").rstrip(".;")[:60]
    for pattern, degrees in _ANGLES:
        match = pattern.fullmatch(text)
        if match and all(numbers := [Fraction(each.replace(",", ".")) for each in match.groups()]):
            return degrees(*numbers)
    written = _NUMBER.fullmatch(text)
    if written is None:
        return None
    top, _, bottom = written[1].replace(",", ".").partition("/")
    value = Fraction(top) / Fraction(bottom or 1)
    unit = re.split(r"[\s.,;)(\]]", written[2].lower().lstrip("\\[ "))[0]
    factor = tables()["units"].get(unit, 1 if not unit.isalpha() else None)
    if factor in (None, 1):
        return value if factor else None
    return _half_degrees(top) or Fraction(str(round(float(value) * factor, 6)))


def _half_degrees(radians: str) -> Fraction | None:
    """The angle of whole or half degrees that was written in radians with many decimals, if it is one."""
    decimals = len(radians.partition(".")[2])
    near = Fraction(round(math.degrees(float(radians)) * 2), 2)
    return near if decimals > 2 and round(math.radians(near), decimals) == float(radians) else None
