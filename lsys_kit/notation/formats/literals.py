"""Data: systems in JSON, TOML and in the literals of programs, as in `axiom = "F"; rules = {"F": "F+F"}`.

Texts, numbers, lists and pairs are recognised as such, whatever language they are in, and nothing is run: a name stands for
itself, and a call for its name with its values. A rule is a pair of texts of which the first is a symbol, or what names its
parts as `fields.toml` has them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from itertools import chain, pairwise

from lsys_kit.budget import current
from lsys_kit.errors import ModelSyntaxError, quotable
from lsys_kit.notation.formats.found import (
    Found,
    Passage,
    Rule,
    angle_of,
    chance_of,
    first_taken,
    not_taken,
    program_of,
    tables,
    take_signs,
)
from lsys_kit.notation.formats.lines import rules_in_line
from lsys_kit.notation.formats.parts import is_word

_TOKEN = re.compile(
    r"""(?P<blank>[ \t\r]+
        |(?://|(?<![\[({/])\#(?![\w\[(])|(?<![\[({/])\#[ ]+|```|;;|--[ ](?=[A-Za-z|])|(?<![^\s;])%(?!\w*[ ]?[%=]))[^\n]*)
    |(?P<end>\n|;)
    |(?P<text>"(?:[^"\\\n]|\\.)*+"|'(?:[^'\\\n]|\\.)*+'|`(?:[^`\\]|\\.){0,2000}`)
    |(?P<number>(?:\d+(?:\.\d+)?|\.\d+)(?:[eE][-+]?\d+)?(?:f(?!\w))?)
    |(?P<name>[^\W\d][\w$]*(?:(?:\.|::|-(?=[A-Za-z]))[^\W\d][\w$]*)*(?:<[A-Za-z_, :]{1,60}>(?=\s*[\w({=]))?)
    |(?P<pair><-(?=[ ])|=>|:>|->|→|↦|:=|:|=(?!=))
    |(?P<open>[\[{(])
    |(?P<close>[\]})])
    |(?P<comma>,)
    |(?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)
_SIGN = re.compile(r"(?P<other>.)", re.DOTALL)
_INSIDE = {sign: re.compile(rf"(?:[^{sign}\\\n]|\\.)*+", re.DOTALL) for sign in "\"'"}
"""What a text may have between its quotation marks."""
_COMMENT = re.compile(r"/\*|\(\*|<!--")
_COMMENT_ENDS = {"/*": "*/", "(*": "*)", "<!--": "-->"}
_LONGEST_COMMENT = 2_000
_ESCAPE = re.compile(r"\\(u[0-9a-fA-F]{4}|x[0-9a-fA-F]{2}|.)")
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r"}
_CLOSING = {"(": ")", "[": "]", "{": "}"}
_SYMBOL = re.compile(
    r"(?:[^\s<>()]{1,12}\s*<\s*)?(?:[A-Za-z](?:_?\w)?|[^\w\s(){}\[\]:,;.<>=]|\d|[A-Z][a-z]{2,15})(?:\([^()]*\)(?:\s*:.{1,80})?)?(?:\s*>\s*[^\s<>()]{1,12})?"
)
"""What may be the first text of a rule."""


@dataclass(frozen=True)
class Term:
    """A text, a number or a name."""

    kind: str
    text: str
    at: int
    end: int
    exact: bool = True

    @property
    def passage(self) -> Passage:
        return Passage(self.text, self.at, self.exact)


@dataclass
class Group:
    """What stands between brackets, with the name before them."""

    head: str
    opened: str
    at: int
    entries: list[Entry] = field(default_factory=list)


@dataclass
class Entry:
    """A member of a group: the terms of its value, and of its key, where it has one."""

    terms: list[Term | Group]
    key: list[Term | Group] = field(default_factory=list)
    sign: str = ""
    start: int = 0
    end: int = 0


_FILLED_IN = re.compile(r"(?<!\w)(?:[rR]?[fF][rR]?|\$@?|@\$)(?=[\"'].*\{)|(?=`.*\$\{)", re.DOTALL)
"""Before a text into which values are put: f"F{x}", $"F{x}", `F${x}`."""


_PLACEHOLDER = re.compile(r"%(?:\(\w+\))?[sdifgr]|[#$]\{\s*\w+(?:[.\[(*/ ][^{}]*)?\}|\\\(")
_PUT_IN = re.compile(r"[ \t]*%")
"""A text with places for values, and what fills them: "F%sF" % turn; in Ruby, Kotlin and Swift they are in it."""


def _text_of(match: re.Match[str], text: str) -> Term:
    """A literal text, its escapes read."""
    said = match[0][1:-1]
    at = match.start() + 1
    if any(_FILLED_IN.match(text, start, match.end()) for start in range(max(0, at - 3), at)) or (
        _PLACEHOLDER.search(said) and (_PUT_IN.match(text, match.end()) or "%" not in said)
    ):
        return Term("calculated", said, at, match.end() - 1)
    if "\\" not in said:
        return Term("text", said, at, match.end() - 1)
    return Term("text", _ESCAPE.sub(_character, said), at, match.end() - 1, False)


def _character(match: re.Match[str]) -> str:
    code = match[1]
    return chr(int(code[1:], 16)) if len(code) > 1 else _ESCAPED.get(code, code)


def _tokens(text: str) -> Iterator[re.Match[str]]:
    """The tokens of a text without blanks and comments."""
    at = 0
    unclosed = dict.fromkeys(_INSIDE, 0)  # up to where such a sign begins no text
    while at < len(text):
        if comment := _COMMENT.match(text, at):
            closing = _COMMENT_ENDS[comment[0]]
            end = text.find(closing, comment.end(), comment.end() + _LONGEST_COMMENT + len(closing))
            if end >= 0:
                at = end + len(closing)
                continue
        sign = text[at]
        begins_none = at < unclosed.get(sign, 0)
        match = _SIGN.match(text, at) if begins_none else _TOKEN.match(text, at)
        assert match is not None
        if match.lastgroup == "other" and sign in _INSIDE and not begins_none:
            inside = _INSIDE[sign].match(text, at + 1)
            assert inside is not None
            unclosed[sign] = inside.end()
        if match.lastgroup != "blank":
            yield match
        at = match.end()


def _parsed(text: str) -> Group:
    """All that stands in a text, as a group; nothing, where brackets are too deep for data."""
    parser = _Parser(text)
    for match in _tokens(text):
        if match.lastgroup == "open" and len(parser.stack) > current().depth:
            return Group("", "", 0)
        parser.take(match)
    while len(parser.stack) > 1:
        parser.close(len(text))
    parser.finish(len(text))
    return parser.stack[0]


class _Parser:
    """The open groups of a text, the entries in which they stand, and the entry that is being read."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.stack = [Group("", "", 0)]
        self.saved: list[Entry] = []
        self.entry = Entry([])

    def take(self, match: re.Match[str]) -> None:
        """Go on by a token."""
        kind, sign, at = match.lastgroup or "", match[0], match.start()
        terms = self.entry.terms
        if sign == "to" and not self.entry.key and len(terms) == 1 and isinstance(terms[0], Term) and terms[0].kind == "text":
            kind = "pair"  # mapOf('F' to "FF"), in Kotlin
        if kind == "open":
            self.open(sign, at)
        elif kind == "close":
            if len(self.stack) > 1 and _CLOSING[self.stack[-1].opened] == sign:
                self.close(at)
                self.entry.end = match.end()
        elif kind in ("comma", "end"):
            if kind == "end" and sign == "\n" and self._is_sentence():
                self.entry = Entry([])
            elif kind == "comma" or sign == ";" or self._ends_with_line(match.end()):
                self.finish(at)
        elif kind == "pair":
            self.pair(match)
        else:
            self.add(_text_of(match, self.text) if kind == "text" else Term(kind, sign, at, match.end()), at)
            self.entry.end = match.end()

    def add(self, term: Term | Group, at: int) -> None:
        if not self.entry.terms and not self.entry.key:
            self.entry.start = at
        self.entry.terms.append(term)

    def finish(self, end: int) -> None:
        """End an entry."""
        if self.entry.terms or self.entry.key:
            self.entry.end = end
            self.stack[-1].entries.append(self.entry)
        self.entry = Entry([])

    def open(self, bracket: str, at: int) -> None:
        """Begin a group, which may have a name right before it."""
        called = _called(self.entry, bracket, self.text)
        group = Group(called.text, bracket, called.at) if called else Group("", bracket, at)
        self.add(group, at)
        self.saved.append(self.entry)
        self.stack.append(group)
        self.entry = Entry([])

    def close(self, end: int) -> None:
        """End a group: the entry goes on in which it stands."""
        self.finish(end)
        self.stack.pop()
        self.entry = self.saved.pop()

    def _is_sentence(self) -> bool:
        """Whether a line was a sentence with a colon at its end."""
        entry = self.entry
        return len(self.stack) == 1 and entry.sign == ":" and not entry.terms and not _kind(_name(entry))

    def _ends_with_line(self, end: int) -> bool:
        within, terms = self.stack[-1].opened, self.entry.terms
        joined = within == "{" and terms and isinstance(terms[-1], Term) and terms[-1].kind == "text" and self.entry.key
        return (
            within in ("", "{")
            and bool(terms)
            and not _goes_on(self.text, end)
            and not (joined and _FURTHER.match(self.text, end))
        )

    def pair(self, match: re.Match[str]) -> None:
        """Take what was read as a key, where what follows is its value."""
        entry, sign = self.entry, match[0]
        if entry.terms and not entry.key:
            entry.key, entry.terms, entry.sign = entry.terms, [], sign
        elif entry.terms and sign == "=" and entry.sign == ":":  # axiom: string = "F"
            entry.terms, entry.sign = [], "="
        elif len(entry.terms) == 1 and sign == ":" and _kind(_name(entry)) == "rules":  # the first rule below "rules:"
            entry.key, entry.terms = entry.terms, []
        elif entry.key and not _kind(_name(entry)) and (sign == "=>" or (sign == "->" and not entry.terms)):
            entry.terms.append(Term("function", sign, match.start(), match.end()))  # A: t => "AB"
        elif len(entry.terms) == 1 and sign in ("=>", "->", "→", ":>"):
            entry.key, entry.terms, entry.sign = entry.terms, [], sign


def _called(entry: Entry, opened: str, text: str) -> Term | None:
    """The name right before a bracket, taken off the entry."""
    last = entry.terms[-1] if entry.terms else None
    if (
        isinstance(last, Term)
        and last.kind == "name"
        and opened != "{"
        and (opened == "(" or (last.text[-1] not in " " and text[last.end : last.end + 1] == "["))
    ):
        entry.terms.pop()
        return last
    return None


_NEXT = re.compile(r"\s{0,200}(?:=|:(?!:)|->|[{)\]}.]|\+)")


_FURTHER = re.compile(r"""\s{0,200}(?:"[^"\\\n]{1,1000}"|'[^'\\\n]{1,1000}')\s{0,200}(?=["'},])""")
"""A text that Python joins with the one before it."""


def _goes_on(text: str, at: int) -> bool:
    """Whether what stands on the next line goes on with an entry."""
    return _NEXT.match(text, at) is not None


@cache
def _kinds() -> dict[str, str]:
    names = tables()["names"]
    return {
        re.sub("[ _-]", "", name): kind
        for kind in ("axiom", "rules", "angle", "steps", "unread")
        for name in names[kind]
        if len(name) > 1 or not name.isascii() or name == "n"
    }


def _kind(name: str) -> str:
    """Which part of a system a name calls, in any spelling: "turnAngle", "ANGLE_DEG", "self.axiom"."""
    last = re.split(r"\.|::", name)[-1]
    return _kinds().get(re.sub(r"[ _-]|(?<!\d)\d++$", "", last).lower(), "")


_RULE_NAME = re.compile(r"(?:[Rr]ules?|RULES?)(?:[_.-](?P<apart>[A-Za-z])|(?<=ule)(?P<joined>[A-Z]))$")


def systems_in_literals(text: str) -> list[Found]:
    """The systems among the literals of a text.

    >>> [found] = systems_in_literals('axiom = "F"; rules = {"F": "F+F"}')
    >>> found.axiom[0].text, [(rule.head.text, rule.tail[0].text) for rule in found.rules]
    ('F', [('F', 'F+F')])
    """
    return systems_of(_with_tables(_parsed(text)), text)


def _with_tables(whole: Group) -> Group:
    """The members of a text, those below a heading of TOML, [rules] or [[plant.rules]], as a group of that name."""
    top = Group(whole.head, whole.opened, whole.at)
    placed, group = {"": top}, top
    for entry in whole.entries:
        if heading := _heading(entry):
            before, _, last = heading.text.rpartition(".")
            group = Group("", "{", heading.at)
            key = Term("name", last, heading.at, heading.end)
            placed.get(before, top).entries.append(Entry([group], [key], "=", heading.at, heading.end))
            placed[heading.text] = group
        else:
            group.entries.append(entry)
    return top


def _heading(entry: Entry) -> Term | None:
    """The name of a table of TOML, which stands alone in brackets."""
    term = entry.terms[0] if len(entry.terms) == 1 and not entry.key else None
    while isinstance(term, Group) and term.opened == "[" and not term.head and len(term.entries) == 1:
        [inner] = term.entries
        term = inner.terms[0] if len(inner.terms) == 1 and not inner.key else None
        if isinstance(term, Term) and term.kind == "name":
            return term
    return None


def systems_of(whole: Group, text: str) -> list[Found]:
    """The systems among the members of a group, which is all that stands in a text."""
    apart = [found for found in _apart(whole, text) if found.axiom and found.rules]
    if len(apart) > 1:
        return apart
    found = Found()
    _gather(whole, found, text, False)
    _finish(found, text)
    _take_choices(found, text)
    if found.rules and not found.axiom:
        if len(ordered := [*_in_order(whole, text)]) > 1:
            return ordered
        for one in ordered:
            found.axiom, found.angle, found.steps = one.axiom, found.angle or one.angle, found.steps or one.steps
            found.notes += one.notes
        if not ordered:
            _take_unnamed_axiom(whole, found)
    if found.rules and not found.angle and (angle := _DEGREES.search(text)):
        found.angle = Fraction(angle[1] or angle[2] or angle[3]), Passage(angle[0], angle.start(), False)
    if found.axiom and not found.rules and text[found.axiom[0].at - 1] not in "\"'`":
        return []  # a line of a list, without quotation marks
    if found.axiom and not found.rules and (unclosed := _UNCLOSED.search(text)):
        raise ModelSyntaxError(
            "This quotation mark is never closed",
            text,
            unclosed.start(1),
            None,
            "Every text ends with the sign with which it begins.",
        )
    return [found] if found.axiom or found.rules else []


def _finish(found: Found, text: str) -> None:
    """Look over what was gathered of a system."""
    _pair_up(found)
    _check(found, text)
    take_signs(found)
    word = "".join(part.text for part in (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail)))
    for index, rule in enumerate(found.rules):
        head, capital = rule.head, rule.head.text.upper()
        if _NAMED_AFTER.fullmatch(text, head.at - 1, head.at + 1) and head.text not in word and capital in word:
            found.rules[index] = replace(rule, head=Passage(capital, head.at, False))
            found.notes.append(f"The rule that is named after {head.text} is that of {capital}.")


_SHORT_NUMBER = re.compile(r"(\d{1,6}(?:\.\d{1,9})?)f?")
_MOST_MEMBERS = 8


def _in_order(group: Group, text: str) -> Iterator[Found]:
    """The systems that are lists of an axiom, rules and numbers: ("F", {"F": "F+F"}, 60, 4)."""
    groups = [(_name(entry), term) for entry in group.entries for term in entry.terms if isinstance(term, Group)]
    for name, term in groups:
        members = [entry.terms[0] for entry in term.entries if len(entry.terms) == 1 and not entry.key]
        found = Found(name=name)
        if len(members) == len(term.entries) <= _MOST_MEMBERS:
            _take_in_order(members, found, text)
        if found.axiom:
            _finish(found, text)
            yield found
        else:
            yield from _in_order(term, text)


def _take_in_order(members: list[Term | Group], found: Found, text: str) -> None:
    """Take in the members of a list, if one is an axiom; of two numbers the greater is the angle."""
    words = [each for each in members if isinstance(each, Term) and each.kind == "text"]
    if not words:
        return
    for each in members:
        if isinstance(each, Group):
            _gather(each, found, text, True)
    heads = {rule.head.text for rule in found.rules}
    axioms = [each for each in words if is_word(each.text) and not heads.isdisjoint(each.text)]
    terms = [(each, match) for each in members if isinstance(each, Term) and (match := _SHORT_NUMBER.fullmatch(each.text))]
    numbers = sorted(((Fraction(match[1]), each.passage) for each, match in terms), key=lambda number: -number[0])
    if len(axioms) != 1 or len(numbers) > 2:
        return
    found.axiom = (axioms[0].passage,)
    found.name = next((each.text for each in words if each not in axioms), found.name)
    found.angle = numbers[0] if numbers else None
    found.steps = (int(numbers[1][0]), numbers[1][1]) if len(numbers) == 2 else None
    found.notes.append(f'"{axioms[0].text}" is read as the axiom.')
    for name, (_, passage) in zip(("angle", "number of steps"), numbers, strict=False):
        found.notes.append(f"{passage.text} is read as the {name}.")


_NAMED_AFTER = re.compile(r"[_.-][a-z]")
"""The end of the name of a rule, rules_a, and what stands before it."""
_CONSTANT = re.compile(r"var(?:iable)?_?([b-d])")
_DEGREES = re.compile(
    r"(?:[Rr]adians|deg2rad)\(\s*(\d+(?:\.\d+)?)\s*\)"
    r"|\b(\d+(?:\.\d+)?)\s*(?:\\\[Degree\]|°|Degree\b)|angle (\d+(?:\.\d+)?) degrees"
)
"""An angle that no name calls so."""
_UNCLOSED = re.compile(r"[:=]\s*(\")[^\"\n]*,?$", re.MULTILINE)


_CHOICE = re.compile(
    r"""(?:==|=|case|when)[ \t]*["'](?P<head>[A-Za-z])["'][ \t]*+\)?[ \t]*+[:{\[]?\s{0,40}+"""
    r"""(?:\w{1,30}+[ \t]*+\+?=|return|report)?[ \t]*+["'](?P<tail>[^"'\n]{1,500})["']"""
)
"""A program that chooses: if c == "F": new = "F+F"."""


def _take_choices(found: Found, text: str) -> None:
    """The rules that a program chooses among, unless others were found than these."""
    chosen = [
        Rule(Passage(match["head"], match.start("head")), (Passage(match["tail"], match.start("tail")),))
        for match in _CHOICE.finditer(text)
    ]
    if all(rule in chosen for rule in found.rules):
        found.rules = chosen


def _take_unnamed_axiom(whole: Group, found: Found) -> None:
    """The only word that is a value of a call, and no part of a rule, is the axiom."""
    parts = {part.at for rule in found.rules for part in (rule.head, *rule.tail)}
    words = [
        word
        for word in _values(whole)
        if word[0].at not in parts and all(is_word(part.text) for part in word) and _has_symbols(word, found)
    ]
    if words and len({"".join(part.text for part in word) for word in words}) == 1:
        found.axiom = words[0]
        found.notes.append(f'"{"".join(part.text for part in words[0])}" is read as the axiom.')


def _has_symbols(word: tuple[Passage, ...], found: Found) -> bool:
    """Whether a word has a letter, or a symbol that is replaced."""
    heads = {rule.head.text for rule in found.rules}
    return any(part.text in heads or re.search("[A-Za-z]", part.text) for part in word)


def _values(group: Group) -> Iterator[tuple[Passage, ...]]:
    """The texts, and the lists of symbols, that are values of calls."""
    for entry in group.entries:
        for term in entry.terms:
            if isinstance(term, Group):
                if group.head and group.opened != "{" and not entry.key and term.opened == "{" and (word := _symbols(term)):
                    yield word
                yield from _values(term)
            elif term.kind == "text" and group.head and not entry.key and len(entry.terms) == 1:
                yield (term.passage,)


def _apart(group: Group, text: str) -> Iterator[Found]:
    """The systems of the groups that have an axiom and rules of their own."""
    for entry in group.entries:
        for term in entry.terms:
            if isinstance(term, Group):
                if any(_kind(_name(inner)) == "axiom" for inner in term.entries):
                    found = Found(name=_title(term) or _name(entry))
                    _gather(term, found, text, False)
                    _finish(found, text)
                    yield found
                else:
                    yield from _apart(term, text)


def _title(group: Group) -> str:
    """What a group says that it is called."""
    names = ("name", "title", "id")
    return next(
        (
            term.text
            for entry in group.entries
            if _name(entry).lower() in names
            for term in entry.terms
            if isinstance(term, Term)
        ),
        "",
    )


_STATEMENTS = frozenset(("for", "if", "elif", "while"))
"""What begins a statement of a program that has a colon at its end."""


def _name(entry: Entry) -> str:
    """The name of an entry: the last name of its key."""
    first = entry.key[0] if entry.key else None
    if isinstance(first, Term) and first.text in _STATEMENTS:
        return ""  # for c in axiom: ...
    for term in reversed(entry.key):
        if isinstance(term, Term) and term.kind in ("name", "text"):
            return term.text
        if isinstance(term, Group) and term.head:
            return term.head
    return ""


_SETS = re.compile(r"(?:.{0,40}[.:])?(?:(?:set|with|add)_?)?((?i:axiom|angle|delta|iterations|generations))")
"""The name of a function that sets a part of a system: setAngle(60), builder.angle(60)."""


def _gather(group: Group, found: Found, text: str, in_rules: bool) -> None:
    """Take in what a group says."""
    if (called := _SETS.fullmatch(group.head)) and len(group.entries) == 1 and not group.entries[0].key:
        _take(replace(group.entries[0], key=[Term("name", called[1], group.at, group.at)], sign="="), found, text, in_rules)
        return
    if group.opened and (rule := _as_rule(group.entries)):
        found.rules += _each_successor(rule, group.entries)
        return
    if in_rules and group.opened and len(group.entries) == 2:  # ["A", () => "AB"]
        (first, second), said = group.entries, _texts(group.entries[0].terms)
        if said and (_is_calculated(second.terms) or (second.sign == "=>" and not first.key)):
            found.calculated = found.calculated or said[0]
            return
    used: set[int] = set()
    for first, second in pairwise(group.entries):  # rule(1).before = "F"; rule(1).after = "FF"
        if not group.opened and len(first.key) > 1 and (rule := _as_rule([first, second])):
            found.rules.append(rule)
            used |= {id(first), id(second)}
    listed = False
    for entry in (entry for entry in group.entries if id(entry) not in used):
        item = bool(entry.terms) and isinstance(entry.terms[0], Term) and entry.terms[0].text == "-"
        listed = item and (listed if not entry.key else _kind(_name(entry)) == "rules")  # items of a list in YAML
        _take(entry, found, text, in_rules or listed)


def _take(entry: Entry, found: Found, text: str, in_rules: bool) -> None:
    """Take in what an entry says."""
    value = entry.terms[-1] if entry.terms else None
    name, keyed = _name(entry), bool(entry.key)
    if not keyed and isinstance(value, Term) and value.kind in ("text", "number") and len(entry.terms) > 1:
        before = entry.terms[-2]  # axiom 'F', set axiom "F", initial string "F"
        further = entry.terms[-3] if len(entry.terms) > 2 else before
        if isinstance(before, Term) and before.kind == "name" and isinstance(further, Term):
            two = further.text + before.text if further is not before else ""
            if _kind(before.text) or _kind(two) or _RULE_NAME.search(before.text):
                name, keyed = before.text if _kind(before.text) or not _kind(two) else two, True
                entry = replace(entry, key=[before], terms=[value])
    kind = _kind(name)
    said = [term for term in entry.terms if isinstance(term, Term) and term.kind == "text"]
    alone = entry.terms[0] if len(entry.terms) == 1 else None
    raw = alone.text if isinstance(alone, Term) else text[_start(entry.terms[0]) : entry.end].strip() if entry.terms else ""
    if (constant := _CONSTANT.fullmatch(name)) and keyed and angle_of(raw) is not None:
        found.lines.append(Passage(f"{constant[1]} = {raw}", entry.start, False))
        return
    rules, within = len(found.rules), in_rules or kind == "rules"
    if keyed and kind != "steps":
        found.program = found.program or program_of(name)
    if keyed and kind == "axiom" and not in_rules and _is_calculated(entry.terms):
        found.calculated, found.joined = found.calculated or Passage(name, entry.start), found.joined or _has_text(entry, text)
    elif keyed and kind == "axiom" and said and not in_rules:
        found.axiom = found.axiom or _texts(entry.terms)
    elif keyed and kind == "axiom" and isinstance(value, Group) and (word := _symbols(value)) and not in_rules:
        found.axiom = found.axiom or word
    elif keyed and kind == "axiom" and not in_rules and entry.sign == ":" and found.axiom is None and is_word(raw):
        found.axiom = (Passage(raw, entry.terms[0].at),)  # YAML needs no quotation marks
    elif keyed and kind == "unread" and not in_rules and angle_of(raw):
        found.notes.append(not_taken(name, raw))
    elif keyed and kind == "angle" and not in_rules and (angle := angle_of(raw.strip("\"'"))) is not None:
        if found.angle is None:
            found.angle = angle, Passage(raw, _start(entry.terms[-1]), False)
        found.notes += first_taken(raw.strip("\"'"))
    elif keyed and kind == "steps" and not in_rules and (steps := re.match(r"\d{1,6}(?=$|\D)", raw.strip("\"'"))):
        found.steps = found.steps or (int(steps[0]), Passage(raw, _start(entry.terms[-1]), False))
        found.notes += first_taken(raw.strip("\"'"))
    elif within and keyed and _is_calculated(entry.terms) and (head := _head(entry, True, name)):
        found.calculated, found.joined = found.calculated or head, found.joined or _has_text(entry, text)
    elif keyed and said and not in_rules and name.lower() in tables()["names"]["ignore"]:
        found.ignored = said[-1].passage
    elif keyed and not in_rules and name.lower() in tables()["names"]["draws"] and (drawn := _letters(entry)):
        found.drawn |= dict.fromkeys(drawn, "F")
    elif not (within and _is_calculated(entry.terms)) and (more := [*_rules_of(entry, within, name)]):
        found.rules += more
        found.loose |= set() if within else {rule.head.at for rule in more}
    else:
        for term in (*entry.key, *entry.terms):
            if isinstance(term, Group):
                _gather(term, found, text, within)
            elif term.kind == "text" and within:
                found.rules += rules_in_line(term.passage)
        head = _head(entry, True, name) if within and keyed and entry.terms else None
        number = isinstance(value, Term) and value.kind == "number" and len(entry.terms) == 1
        if head and len(found.rules) == rules and not number:
            found.calculated = found.calculated or head
    if keyed and name.lower() in _DRAWN:
        found.rules[rules:] = [replace(rule, section="interpretation") for rule in found.rules[rules:]]
        found.loose -= {rule.head.at for rule in found.rules[rules:]}


def _letters(entry: Entry) -> set[str]:
    """The letters, each a text, of a list, or the only one; but F, which draws in any case."""
    value = entry.terms[-1] if entry.terms else None
    members = value.entries if isinstance(value, Group) else [entry]
    words = [part.text for member in members for part in _texts(member.terms)]
    plain = (
        len(words) == len(members)
        and not any(member.key for member in members if member is not entry)
        and all(len(word) == 1 and word.isalpha() for word in words)
    )
    return {*words} - {"F"} if plain else set()


_DRAWN = frozenset(("interpretation", "interpretations", "homomorphism", "draw", "drawing", "render"))
"""What calls rules by which symbols are drawn."""
_CALCULATES = frozenset(("?", "*", "%", "if", "else", "unless", "lambda", "function"))
"""What makes a word that is not the text beside it."""
_SAME_WORD = frozenset(
    ("split", "tostring", "toowned", "into", "chars", "strip", "trim", "tos", "tosym", "freeze", "tochararray", "collect")
)
"""What programs do to a text that is the same word afterwards."""
_OTHER_WORD = frozenset(
    (
        "resub",
        "gsub",
        "sub",
        "replace",
        "stringreplace",
        "join",
        "format",
        "sprintf",
        "repeat",
        "concat",
        "paste",
        "paste0",
        "strcat",
    )
)
"""What makes another of it."""


def _is_calculated(terms: list[Term | Group]) -> bool:
    """Whether a program makes a word of texts, and no literal is one: f"F{x}", "F" * 2, "F" if x else "G", t => "AB"."""
    texts = [index for index, term in enumerate(terms) if isinstance(term, Term) and term.kind == "text"]
    if texts and any(_is_joined(first, second) or _is_joined(second, first) for first, second in pairwise(terms)):
        return True
    return any(
        term.kind in ("calculated", "function") or term.text in _CALCULATES
        if isinstance(term, Term)
        else (name := re.sub("[._]", "", term.head.lower())) in _OTHER_WORD
        or (bool(texts) and texts[0] < index and name not in _SAME_WORD)
        for index, term in enumerate(terms)
    )


_JOINS = frozenset("+&~.$")
"""What joins a text with another, or begins a name."""


def _is_joined(sign: Term | Group, other: Term | Group) -> bool:
    """Whether what a sign joins is no text: "F" + turn."""
    name = re.sub("[._]", "", other.head.lower()) if isinstance(other, Group) else ""
    joins = isinstance(sign, Term) and sign.kind == "other" and sign.text in _JOINS
    return joins and (name not in _SAME_WORD if isinstance(other, Group) else other.kind in ("name", "number"))


def _has_text(entry: Entry, text: str) -> bool:
    """Whether an entry has a text in the quotation marks of programs."""
    texts = (term for term in entry.terms if isinstance(term, Term) and term.kind in ("text", "calculated"))
    return any(text[term.at - 1] in "\"'" for term in texts)


def _texts(terms: list[Term | Group]) -> tuple[Passage, ...]:
    """The texts of a value one behind another: "F[+F]" + "F"."""
    return tuple(term.passage for term in terms if isinstance(term, Term) and term.kind == "text")


_SPOKEN = re.compile(r"[A-Za-z]?[a-z_ ]{2,}")


def _check(found: Found, text: str) -> None:
    """Leave out what says how symbols are drawn, {"+": "left"}; refuse a system of which a program makes a part."""
    heads = {rule.head.text for rule in found.rules}
    named = {rule.head.text for rule in found.rules if rule.head.at not in found.loose}
    found.rules = [
        rule
        for rule in found.rules
        if rule.head.at not in found.loose
        or not _SPOKEN.fullmatch(word := "".join(part.text for part in rule.tail))
        or heads.issuperset(word)
        or (len(set(word)) < 3 and rule.head.text not in named)
    ]
    if found.calculated and (found.rules or (found.joined and not _UNCLOSED.search(text))):
        at = found.calculated.at
        raise ModelSyntaxError(
            f"The word for {quotable(found.calculated.text)} is calculated here",
            text,
            at,
            at + len(found.calculated.text) if found.calculated.exact else None,
            'Nothing that is given to the kit is run. Write the word itself, as in "F+F".',
        )


def _start(term: Term | Group) -> int:
    return term.at - (isinstance(term, Term) and term.kind == "text")


def _as_rule(entries: list[Entry]) -> Rule | None:
    """A rule of the members of a group: two texts, or parts with the names of a rule's."""
    values = [entry.terms for entry in entries if not entry.key and not _is_calculated(entry.terms)]
    words = [_texts(terms) for terms in values[:2]]
    if 2 <= len(values) == len(entries) <= 3 and all(words) and len(values[0]) == 1 and _SYMBOL.fullmatch(words[0][0].text):
        third = values[2][0] if len(values) == 3 else None
        if len(values) == 2 or (isinstance(third, Term) and third.kind in ("text", "number")):
            chance = chance_of(third.text) if isinstance(third, Term) and re.fullmatch(r"[\d.]+", third.text) else None
            return Rule(words[0][0], words[1], chance)
    parts = _parts(entries)
    if "predecessor" in parts and "successor" in parts and parts["predecessor"].terms and parts["successor"].terms:
        head_term, tail_term = parts["predecessor"].terms[-1], parts["successor"].terms[-1]
        head_term = _with_sides(head_term, parts)
        tail_words = (tail_term.passage,) if isinstance(tail_term, Term) else _symbols(tail_term)
        quoted = isinstance(tail_term, Group) or tail_term.kind == "text"
        if isinstance(head_term, Term) and tail_words and quoted and _SYMBOL.fullmatch(head_term.text):
            if _name(parts["predecessor"]) == "a" and re.search(
                "[ab]", head_term.text + "".join(part.text for part in tail_words)
            ):
                return None  # a and b are symbols themselves
            return Rule(head_term.passage, tail_words, _chance(parts.get("probability")))
    return None


def _each_successor(rule: Rule, entries: list[Entry]) -> list[Rule]:
    """A rule for each of several successors with the same name, as elements of XML have them: one is taken at random."""
    name = _name(_parts(entries).get("successor", Entry([])))
    tails = [entry.terms[-1] for entry in entries if name and _name(entry) == name and entry.terms]
    words = [(tail.passage,) if isinstance(tail, Term) else _symbols(tail) for tail in tails]
    return [replace(rule, tail=word, probability=Fraction(1, len(words))) for word in words] if len(words) > 1 else [rule]


def _with_sides(head: Term | Group, parts: dict[str, Entry]) -> Term | Group:
    """A predecessor with its contexts and its condition, which stand in parts of their own."""
    said = {kind: words[-1].text for kind in _SIDES if kind in parts and (words := _texts(parts[kind].terms))}
    if not isinstance(head, Term) or not any(said.values()):
        return head
    left, right, condition = (said.get(kind, "").strip() for kind in _SIDES)
    text = f"{left} < " * bool(left) + head.text + f" > {right}" * bool(right) + f" : {condition}" * bool(condition)
    return replace(head, text=text, exact=False)


_SIDES = "left context", "right context", "condition"
_PARTS = "predecessor", "successor", "probability"
"""The parts of a rule."""


def _parts(entries: list[Entry]) -> dict[str, Entry]:
    """The entries that name parts of a rule; of several with the same part the first."""
    found: dict[str, Entry] = {}
    for entry in entries:
        name = _name(entry) if entry.key and entry.terms else ""
        for kind in _PARTS:
            if (name if len(name) == 1 else name.lower()) in tables()["names"][kind]:
                found.setdefault(kind, entry)
        for kind in _SIDES:
            if name.lower() in tables()["names"][kind]:
                found.setdefault(kind, entry)
    return _contexts_apart(found, entries)


def _contexts_apart(found: dict[str, Entry], entries: list[Entry]) -> dict[str, Entry]:
    """The same, where "left" and "right" are no sides of the arrow, but contexts: beside them stand both sides."""
    sides = {_name(entry).lower(): entry for entry in entries if entry.key}
    others = _parts([entry for entry in entries if _name(entry).lower() not in ("left", "right")]) if "left" in sides else {}
    if not {"predecessor", "successor"} <= {*others}:
        return found
    return others | {f"{side} context": sides[side] for side in ("left", "right") if side in sides}


def _chance(entry: Entry | None) -> Fraction | None:
    term = entry.terms[-1] if entry and entry.terms else None
    return chance_of(term.text) if isinstance(term, Term) and re.fullmatch(r"\d+(?:\.\d+)?%?|\.\d+", term.text) else None


def _symbols(group: Group) -> tuple[Passage, ...]:
    """The word of a list of symbols, as in {"+", R, F}; none where it is another list."""
    terms = [entry.terms[0] for entry in group.entries if not entry.key and len(entry.terms) == 1]
    if (
        len(terms) != len(group.entries)
        or not terms
        or not all(isinstance(term, Term) and len(term.text) == 1 for term in terms)
    ):
        return ()
    return tuple(term.passage for term in terms if isinstance(term, Term))


def _rules_of(entry: Entry, in_rules: bool, name: str) -> Iterator[Rule]:
    """The rules of an entry with a key: its predecessor is the key, or named in it."""
    head = _head(entry, in_rules, name)
    if head is None:
        return
    value = entry.terms[-1] if entry.terms else None
    if texts := _texts(entry.terms):
        yield Rule(head, texts)
    elif (
        isinstance(value, Group)
        and value.opened != "("
        and len(entry.terms) == 1
        and (len(value.entries) > 1 or (value.opened == "{" and entry.sign in ("->", "→", ":>")))
        and (word := _symbols(value))
        and not all(len(part.text) > 1 for part in word)
    ):
        yield Rule(head, word)
    elif isinstance(value, Group):
        yield from _alternatives(head, value)


def _head(entry: Entry, in_rules: bool, name: str) -> Passage | None:
    """The predecessor that a key says."""
    if not entry.key:
        return None
    last = entry.key[-1]
    if isinstance(last, Group):  # rules["F"] = ..., h('F') = ...
        inner = last.entries[0].terms[-1] if len(last.entries) == 1 and last.entries[0].terms else None
        symbol = isinstance(inner, Term) and inner.kind == "text" and _SYMBOL.fullmatch(inner.text)
        return (
            inner.passage
            if symbol
            and isinstance(inner, Term)
            and (_kind(last.head) == "rules" or len(last.head) == 1 or (in_rules and last.opened == "["))
            else None
        )
    if last.kind == "text" and _SYMBOL.fullmatch(last.text) and not _is_field(last.text, in_rules):
        return last.passage
    if last.kind == "name":
        if match := _RULE_NAME.search(last.text):
            return Passage(match[match.lastgroup or 0], last.at + match.start(match.lastgroup or 0))
        if len(last.text) == 1 and (in_rules or entry.sign in ("->", "→", ":>", "=>")):
            return last.passage
    if last.kind in ("other", "number") and (in_rules or entry.sign in ("->", "→")) and len(last.text) == 1:
        return last.passage
    return None


def _is_field(text: str, in_rules: bool) -> bool:
    """Whether a key names something: outside of rules, or a part of one."""
    return len(text) > 1 and (not in_rules or any(text.lower() in tables()["names"][kind] for kind in _PARTS))


def _alternatives(head: Passage, value: Group) -> Iterator[Rule]:
    """The rules of one predecessor with several successors."""
    members = value.entries
    inner = next(
        (
            entry.terms[-1]
            for entry in members
            if _name(entry).lower() in ("successors", "rules", "options", "choices") and entry.terms
        ),
        None,
    )
    if isinstance(inner, Group):
        yield from _alternatives(head, inner)
        return
    parts = _parts(members)
    if "successor" in parts and isinstance(parts["successor"].terms[-1], Term):
        yield Rule(head, (parts["successor"].terms[-1].passage,), _chance(parts.get("probability")))
        return
    texts_named = [made for entry in members if entry.key and (made := _texts(entry.terms))]
    if "probability" in parts and len(texts_named) == 1:  # whatever its name
        yield Rule(head, texts_named[0], _chance(parts["probability"]))
        return
    texts = [entry for entry in members if not entry.key and not _is_calculated(entry.terms)]
    if members and len(texts) == len(members):
        chance = Fraction(1, len(texts)) if len(texts) > 1 else None
        each = [
            [Rule(head, words, chance)] if (words := _texts(entry.terms)) else _pairs(head, entry.terms[-1]) for entry in texts
        ]
        yield from chain.from_iterable(each) if all(each) else ()
    elif not texts_named and all(len(entry.key) == len(entry.terms) == 1 for entry in members):  # {"FF": 0.5, "F+F": 0.5}
        for entry in members:
            word, number = entry.key[0], entry.terms[0]
            if isinstance(word, Term) and isinstance(number, Term) and (word.kind, number.kind) == ("text", "number"):
                yield Rule(head, (word.passage,), chance_of(number.text))


def _pairs(head: Passage, term: Term | Group) -> list[Rule]:
    return [*_pair(head, term)] if isinstance(term, Group) else []


def _pair(head: Passage, group: Group) -> Iterator[Rule]:
    """A successor with its probability, in either order, or with names."""
    terms = [entry.terms[-1] for entry in group.entries if not entry.key and entry.terms]
    word = next((term for term in terms if isinstance(term, Term) and term.kind == "text"), None)
    number = next((term for term in terms if isinstance(term, Term) and term.kind == "number"), None)
    if word and number:
        yield Rule(head, (word.passage,), chance_of(number.text))
    else:
        yield from _alternatives(head, group)


def _pair_up(found: Found) -> None:
    """Weights are probabilities where those of a predecessor have another sum than 1."""
    for head in {rule.head.text for rule in found.rules}:
        weights = [rule.probability for rule in found.rules if rule.head.text == head and rule.probability is not None]
        if weights and sum(weights) > 1:
            total = sum(weights)
            found.rules = [
                replace(rule, probability=rule.probability / total)
                if rule.head.text == head and rule.probability is not None
                else rule
                for rule in found.rules
            ]
