"""Systems in XML: files of JFLAP, of a plant generator, of Inkscape's extension; their elements are read as data.

The parser is the standard library's. What makes XML dangerous is its document type: entities that grow without end, and
files and addresses to be fetched. A text that has one is refused where it begins, so that no entity but those of XML itself is
ever put in place, and nothing is fetched; a further library would do no more.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from typing import NoReturn
from xml.parsers import expat

from lsys_kit.budget import current
from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.formats.found import Found, Rule, tables, take_signs
from lsys_kit.notation.formats.literals import Entry, Group, Term, systems_of
from lsys_kit.notation.syntax.text.typography import TAG


def systems_in_markup(text: str) -> list[Found]:
    """The systems in a text of XML.

    >>> [found] = systems_in_markup('<system angle="60"><axiom>F</axiom><rule from="F" to="F+F"/></system>')
    >>> found.axiom[0].text, found.rules[0].tail[0].text, found.angle[0]
    ('F', 'F+F', Fraction(60, 1))
    """
    start = text.lstrip("\ufeff \t\r\n")
    if (
        not start.startswith("<")
        or start.startswith("<?php")
        or start[:9].lower() == "<!doctype"
        or "axiom" not in text.lower()
        or (not start.startswith("<?xml") and TAG.search(text))
    ):
        return []
    tree = _Tree(text)
    tree.read()
    found = systems_of(tree.whole, text)
    for each in found if "<type>lsystem</type>" in "".join(text.split()) else ():
        words = [*(each.axiom or ()), *(part for rule in each.rules for part in (rule.head, *rule.tail))]
        each.names = frozenset(name for word in words for name in word.text.split() if len(name) > 1 and name.isidentifier())
        each.drawn = {"g": "F"} if any("g" in word.text.split() for word in words) else {}
        each.program = tables()["signs"]["jflap"]
        take_signs(each)
        each.rules = _equally_likely(each.rules)
    return found


_UNSEEN = dict.fromkeys(map(ord, "\u00ad\u200b\u200c\u200d\u200e\u200f\ufeff"))
"""Marks that are not seen, as copied texts have them."""


def _equally_likely(rules: list[Rule]) -> list[Rule]:
    """Of several productions for the same symbol one is taken at random."""
    several = Counter(rule.head.text for rule in rules)
    return [replace(rule, probability=Fraction(1, count)) if (count := several[rule.head.text]) > 1 else rule for rule in rules]


class _Tree:
    """The elements of a text as groups, while it is read."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.whole = Group("", "", 0)
        self.open: list[tuple[str, Group, list[str], list[int]]] = [("", self.whole, [], [])]
        self.parser = expat.ParserCreate()
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.characters
        self.parser.StartDoctypeDeclHandler = self.doctype
        self.parser.EntityDeclHandler = self.doctype

    def read(self) -> None:
        data = self.text.replace("\u00a0", " ").encode("utf-8", "replace")
        self.offsets = None if len(data) == len(self.text) else data
        try:
            self.parser.Parse(data.lstrip(b"\xef\xbb\xbf \t\r\n"), True)
        except expat.ExpatError as error:
            at = self.at()
            raise ModelSyntaxError(
                f"This is no complete XML: {expat.ErrorString(error.code)}", self.text, at, at + 1, "Paste the whole file."
            ) from None

    def at(self) -> int:
        """The offset at which the parser is."""
        skipped = len(self.text) - len(self.text.lstrip("\ufeff \t\r\n"))
        index = max(0, self.parser.CurrentByteIndex)
        if self.offsets is None:
            return min(skipped + index, len(self.text))
        return skipped + len(self.offsets.lstrip(b"\xef\xbb\xbf \t\r\n")[:index].decode("utf-8", "ignore"))

    def doctype(self, *_: object) -> NoReturn:
        at = max(0, self.text.find("<!DOCTYPE"))
        raise ModelSyntaxError(
            "A document type cannot be read here", self.text, at, at + 9, 'Take out what begins with "<!DOCTYPE".'
        )

    def start(self, name: str, attributes: dict[str, str]) -> None:
        if len(self.open) > current().depth:
            raise ModelSyntaxError("These elements are too deep", self.text, self.at(), None, "Give the system alone.")
        at = max(0, self.text.find("<!DOCTYPE"))
        group = Group("", "{", at)
        for key, value in attributes.items():
            group.entries.append(_entry(key, Term("text", value.translate(_UNSEEN), at, at + 1, False)))
        self.open.append((name, group, [], []))

    def characters(self, data: str) -> None:
        _, _, said, places = self.open[-1]
        if data.strip():
            places.append(self.at() + len(data) - len(data.lstrip()))
        said.append(data)

    def end(self, _: str) -> None:
        name, group, said, places = self.open.pop()
        text = "".join(said).translate(_UNSEEN).strip()
        called = {entry.key[0].text: entry for entry in group.entries if isinstance(entry.key[0], Term)}
        before = self.open[-1][1]
        if {"name", "value"} <= {*called} and isinstance(called["name"].terms[0], Term):  # a parameter
            before.entries.append(_entry(called["name"].terms[0].text, called["value"].terms[0]))
        elif "name" in called and text and isinstance(called["name"].terms[0], Term):
            before.entries.append(_entry(called["name"].terms[0].text, self.term(text, places)))
        elif group.entries:
            rule = any(key.lower() in tables()["names"]["predecessor"] for key in called)
            group.entries += [_entry("successor" if rule else name, self.term(text, places))] if text else []
            before.entries.append(_entry(name, group))
        else:
            before.entries.append(_entry(name, self.term(text, places)))

    def term(self, text: str, places: list[int]) -> Term:
        at = places[0] if places else self.at()
        return Term("text", text, at, at + len(text), self.text[at : at + len(text)] == text)


def _entry(key: str, value: Term | Group) -> Entry:
    at = value.at
    end = value.end if isinstance(value, Term) else at
    return Entry([value], [Term("name", key, at, at)], "=", at, end)
