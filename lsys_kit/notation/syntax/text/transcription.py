"""Listings as books print them, transcribed into the kit's own notation, character by character.

The Algorithmic Beauty of Plants prints a system with its number of steps and its angle on one line, the axiom without a name,
labels before productions, probabilities over arrows, digits as symbols, and typographic signs. Whatever is printed otherwise
than the kit writes it becomes a list of edits. The transcript remembers where in the source each of its characters comes
from, so that an error is shown in the text that was typed.

Greek letters become names: the book has constants such as α and δ, the kit has names of the letters A to Z. Three of them mean
something else: ω before the axiom, δ before the angle, ε for nothing.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from typing import NamedTuple

from lsys_kit.budget import current
from lsys_kit.notation.syntax.text.statements import (
    ARROW,
    LABEL,
    OMEGA,
    blank_parentheses,
    pending,
    surely_goes_on,
    without_comments,
)
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, as_typed, edited
from lsys_kit.notation.syntax.text.typesetting import (
    HEADING,
    LINE_OF_SUBSCRIPTS,
    MACRO,
    RULES,
    SENTENCE,
    headings,
    subscripts,
    typesetting,
)
from lsys_kit.notation.syntax.text.typography import long_arrows

GREEK = re.compile(r"[Α-ΡΣ-Ωα-δζ-ωϑϕϱµ]|\\(?:[Aa]lpha|[Bb]eta|[Gg]amma|[Dd]elta|theta|lambda|mu|phi|psi|rho|sigma|tau|omega)\b")
"""A letter, or its macro in LaTeX."""
_SETTING = re.compile(
    rf"(?:^|[,;])[ \t]*+(?:(?P<axiom>{OMEGA})[ \t]*+(?:[:=]|{ARROW.pattern})"
    r"|(?P<angle>δ|\\delta)[ \t]*+[:=](?:[ \t]*+(?P<value>\d[\d.]*+))?)"
)
"""Where a letter has its own meaning: before the axiom or the angle, at the beginning of a line or after a comma."""


def name_of(letter: str) -> str:
    r"""The name of a Greek letter.

    >>> name_of("α"), name_of("Δ"), name_of(r"\beta")
    ('alpha', 'Delta', 'beta')
    """
    if letter[0] == "\\":
        return letter[1:]
    name = unicodedata.name(unicodedata.normalize("NFKC", letter)).split()[-1].lower().replace("lamda", "lambda")
    return name.capitalize() if letter.isupper() else name


def named_letters(text: str, start: int, latex: bool) -> Iterator[tuple[str, Edit]]:
    """The Greek letters of a line that begins at an offset, each with the edit that puts its name in place.

    >>> [edit.text for _, edit in named_letters("αβ -> F(α_1)", 0, False)]
    ['alpha ', 'beta', 'alpha']
    """
    settings = {match.start("axiom" if match["axiom"] else "angle") for match in _SETTING.finditer(text)}
    for match in GREEK.finditer(text):
        letter = match.group()
        if match.start() in settings or (letter[0] == "\\" and not latex):  # a backslash is a roll, before a name
            continue
        before, after = text[match.start() - 1 : match.start()], text[match.end() : match.end() + 1]
        apart = " " * bool(re.match(r"[A-Za-z]", before)), " " * (after.isalpha() and after != "ε")
        yield letter, Edit(start + match.start(), start + match.end(), f"{apart[0]}{name_of(letter)}{apart[1]}")


def angle_as_constant(text: str, start: int) -> Edit | None:
    """Where a line sets the angle δ, the edit that declares a constant of the same value before it."""
    setting = next((match for match in _SETTING.finditer(text) if match["value"]), None)
    if setting is None:
        return None
    at = start + setting.start("angle")
    return Edit(at, at, f"delta = {setting['value']}\n")


_ARROW = ARROW.pattern
_SIGNS = str.maketrans("’‘′ʼ∗⁎–ˆ∕⁄∼˜", "''''**-^//~~")
"""Typographic signs, and what is typed for them."""
_WEDGES = str.maketrans("∧⋀", "^^")
"""Before an arrow a wedge joins two conditions; behind it, it is a turn."""
_LABEL = re.compile(rf"[ \t]*+{LABEL}[ \t]*+:")
_OMEGA = re.compile(rf"[ \t]*+{OMEGA}[ \t]*+(?:[:=]|({_ARROW}))")
"""The axiom; some lists on the web put an arrow behind its name."""
_LABELLED = re.compile(rf"^(?:{_LABEL.pattern}|{_OMEGA.pattern})", re.MULTILINE)
_DELTA = re.compile(r"(?:δ|\\delta)[ \t]*+=")
_ASSIGNED = r"(?:[A-Za-z]\w*|δ|\\delta)[ \t]*+=[ \t]*+[\d.]+[ \t]*+(?:°|\^?\{?\\circ\}?)?"
_ASSIGNMENTS = re.compile(rf"[ \t]*+{_ASSIGNED}(?:[ \t]*+[,;][ \t]*+{_ASSIGNED})*[ \t]*+[,;.]?[ \t]*+$")
_SETTING_NAME = r"(?i:axiom|angle|heading|steps|alphabet)"
_SETTINGS = re.compile(rf"(?:^|[,;])[ \t]*+{_SETTING_NAME}[ \t]*+(=)(?!=)")
"""Settings with the sign of a constant, as many pages on the web have them."""
_DEGREES = re.compile(r"[ \t]*+(?i:angle|heading)[ \t]*+[:=][ \t]*+[\d./]++([ \t]*+(?:°|degrees?\b|deg\b))[ \t]*+$")
_ANGLE_ALONE = re.compile(r"[ \t]*+(\d{1,3}(?:\.\d++)?)[ ]?(?:°|degrees|deg)[.]?[ \t]*+")
_ANGLE_SAID = re.compile(r"angle|δ|delta", re.IGNORECASE)
_STEPS = re.compile(r"\bn[ \t]*+=")
_DELTA_IN_LETTERS, _DELTA_WORD = re.compile(r"(?<!\\)\bdelta[ \t]*+="), re.compile(r"\bdelta\b")
_N, _PARAMETER_N = re.compile(r"\bn\b"), re.compile(r"[(,][ \t]*+n[ \t]*+[,)]")
_NAMED = re.compile(r"[ \t]*+\\?[A-Za-z_ωδ][\w ]*+(?>(?:\([^()]*+\))?)[ \t]*+[:=]|[ \t]*+#")
_DEFINED = re.compile(r"([ \t]*+#[ \t]*+define[ \t]++)(\w+)([ \t]++)\S")
_NEIGHBOURS = re.compile(r"[ \t]*+(#[ \t]*+)(?:ignore|consider)\b", re.IGNORECASE)
_DIRECTIVE = re.compile(rf"{_DEFINED.pattern}|(?i:{_NEIGHBOURS.pattern})|[ \t]*+#[ \t]*+include\b")
_START = re.compile(r"[ \t]*+((?i:Start(?:wort|word)|Start (?:word|symbol))\b[ \t]*+:?)")
_NAMED_AXIOM = re.compile(rf"[ \t]*+(?i:axiom)\b|{_START.pattern}|{_OMEGA.pattern}")
_PROBABILITY = re.compile(rf"(?<![ \t])[ \t]++(?:-{{1,2}}\()?+(\d*\.\d+)(?:\)(?=-)|[ \t]*+)(?={_ARROW})")
_AFTER_COLON = re.compile(rf":[ \t]*+(0?\.\d++)[ \t]*+(?={_ARROW})")
"""A probability before the arrow, behind a colon: a number alone is no condition."""
_ABOVE = re.compile(r"[ \t]*+(\d*\.\d+|1)[ \t]*+$")
_REFERENCE = re.compile(r"[\[(]\d++[\])]|\d++|[-–][ ]?\d++[ ]?[-–]|/[ ]?[a-z]|\([a-z]\)")
"""The number of a page or a note, or a caption's letter: on an indented line, anything else goes on with a production."""
_SENTENCE = re.compile(SENTENCE)
_NUMBERED = re.compile(r"(?<![ \t])[ \t]{2,}+(?P<number>\(\d+(?:\.\d+)?[a-z]?\))[ \t]*+$")
"""The number of an equation, at the end of a line."""
_ASIDE = re.compile(r"[\W_]*+(?:\w{1,12}(?:\.\d+)?[\W_]*+)?")
"""A line with one name or number, whatever signs are around it."""
_CHANCE = re.compile(
    rf"(?:^|:)[ \t]*+(?P<symbol>[A-Za-z])[ \t]++"
    rf"(?P<value>\([ \t]*+(?P<number>\d?\.\d++|\d{{1,2}}/[1-9]\d?)[ \t]*+\))[ \t]*+(?={_ARROW})"
)
"""A probability in brackets, set apart from the symbol."""
_CHANCE_BEHIND = re.compile(r"\((?P<number>0?\.\d++)\)[ \t]*+$")
"""What may be a probability in brackets, behind a word."""
FULL_STOPS = "The full stop at the end of a line is left out."
_ANY = re.compile(rf"(?P<left>\*)[ \t]*+(?=<)|(?<=>)[ \t]*+(?P<right>\*)(?=[ \t]*+(?>(?:\d*\.\d++[ \t]*+)?)(?:{_ARROW}|:))")
_EQUALS = re.compile(r"(?<![<>=!:])=(?!=)")
_DIGIT_RULE = re.compile(rf"(?:[^<>:]*+<)?[ \t]*+\d[ \t]*+(?:>[^<>:]*?)?(?:{_ARROW}|:)")
_ROW = re.compile(r"[ \t]*+(?:axiom|ignore|consider)\b", re.IGNORECASE)
_ALPHABET = re.compile(r"[ \t]*+alphabet\b.*\d\b", re.IGNORECASE)
_DIGIT = re.compile(r"(?<![.\d])\d(?![.\d])")

_WORD = re.compile(r"(?!\s*+(?:start|begin|init|root|word)\w*+[^\S\n]|.*\\[a-z]{3})[^:=<>#\n]*+(?<!-)", re.IGNORECASE)
"""A line that may be an axiom without its name, and is no name of an axiom without its colon."""

_EMPTY = re.compile(rf"(?:{_ARROW})[ \t]*+(?P<sign>[λΛ∅])[ \t]*+$", re.MULTILINE)
"""The empty word, as it is written in formal languages."""
_BLANK_LINES = re.compile(r"\n\n\n+")
_TYPOGRAPHIC = re.compile(f"[{''.join(map(chr, {**_SIGNS, **_WEDGES}))}Α-Ωα-δζ-ωϑϕϱµ°•∅]")
_SIGNS_OF_PRINT = (
    re.compile(r"\\[a-z]{4}"),
    re.compile(r"\*(?:\*|[ \t]*+<)"),
    re.compile(r"\$[,.;]?+[ \t]*+(?:\n|\Z)"),
    re.compile(rf"\n[ \t]*+(?:{HEADING})(?:\n|\Z)", re.IGNORECASE),
    re.compile(rf"\n[ \t]*+{SENTENCE}(?:\n|\Z)"),
    re.compile(rf"\n[ \t]*+(?:{RULES}|```)", re.IGNORECASE),
    LINE_OF_SUBSCRIPTS,
    re.compile(rf"\A\s*+[^:=<>#\n]++\n[^\n]*(?:{_ARROW})"),
    re.compile(r">[ \t]*+\*"),
    re.compile(r"=[ \t]*+[\d.]++[ \t]*+[,;]"),
    re.compile(rf"[./]\d++[ \t]*+\)?+[ \t]*+(?:{_ARROW})"),
    re.compile(r"\.\d++\)[ \t]*+(?:\n|\Z)"),
    re.compile(r"[.;,][ \t]*+(?:\n|\Z)"),
    re.compile(r"→(?<=[-−–—]→)"),
    re.compile(r"\n[ \t]*+→"),
    re.compile(rf"\n[ \t]*+{_SETTING_NAME}[ \t]*+(?:=(?!=)|:[^\n]*deg)"),
    re.compile(r"\n(?!\n)[ \t]*+(?:[pP]_?+[\d{]|[Ss][Tt][Aa][Rr][Tt]|[#.\d]|[-*][ \t]|\(\d|[^:<\n]*+<[ \t]*+\d)"),
)
"""A text with none of these and nothing typographic is written as the kit writes it, and is not looked at line by line.
Each begins with one character, which is quickly found."""


def transcribe(source: str) -> Transcript:
    """A listing in print as the kit's own notation has it; any other text as it is.

    >>> print(transcribe("ω : F\\np1 : F .5→ F[+F]\\np2 : F .5→ F").text)
    ω : F
    p1 : F→ F[+F] : .5
    p2 : F→ F : .5
    """
    lines = _BLANK_LINES.sub("\n\n", f"\n{source}")  # a pattern may look again at each of them
    typographic = not source.isascii() and _TYPOGRAPHIC.search(source)
    printed = typographic or any(sign.search(lines) for sign in _SIGNS_OF_PRINT)
    return _transcript(source) if printed else as_typed(source)


def _transcript(source: str) -> Transcript:
    """The same, however a text looks at first sight."""
    notes: list[str] = []
    plain = without_comments(source)
    lines = edited(source, [*headings(plain, notes), *typesetting(plain), *subscripts(plain, "_")], notes)
    typed = long_arrows(_with_typed_signs(lines.text))
    listing = _Listing(without_comments(typed))
    edits = [*listing.ends(), *listing.settings(), *listing.rules(), *listing.letters(), *listing.digits()]
    return edited(lines, edits, listing.notes, typed)


def _with_typed_signs(source: str) -> str:
    """A text with the signs of a keyboard in place of typographic ones, every other character in its place.

    >>> _with_typed_signs("A(t) : t > 1 ∧ t < 5 → ’∧F")
    "A(t) : t > 1 ∧ t < 5 → '^F"
    """
    if source.isascii():
        return source
    lines = []
    for line in source.translate(_SIGNS).split("\n"):
        behind = max((arrow.end() for arrow in ARROW.finditer(line)), default=0)
        lines.append(line[:behind] + line[behind:].translate(_WEDGES))
    return "\n".join(lines)


def left_out(line: str) -> str:
    """The note on a line that is left out below a production.

    >>> left_out(" [3] ")
    '"[3]" is left out: it is not surely a part of the rule above it.'
    """
    return f'"{line.strip()}" is left out: it is not surely a part of the rule above it.'


_WORDS = re.compile(r"\[?[A-Za-z]++(?>(?:[ \t|]++[A-Za-z]++)*)\]?[.,:;!?]?")


def _is_prose(line: str, known: frozenset[str]) -> bool:
    """Whether a line has words alone, perhaps in brackets, and one of them has letters that no production has.

    >>> _is_prose("Copy this code", frozenset("ABF")), _is_prose("FAB BA", frozenset("ABF"))
    (True, False)
    """
    words = re.findall(r"[A-Za-z]{3,}", line)
    return _WORDS.fullmatch(line) is not None and any(not {*word} <= known for word in words)


class _Line(NamedTuple):
    start: int
    text: str
    arrow: re.Match[str] | None

    @property
    def end(self) -> int:
        return self.start + len(self.text.rstrip())


def _names_n(line: _Line) -> bool:
    """Whether a line with an n sets it, or has it as a parameter of its own."""
    set_here = _STEPS.search(line.text) is not None and line.arrow is None
    return set_here or (line.arrow is not None and _PARAMETER_N.search(line.text, 0, line.arrow.start()) is not None)


class _Listing:
    """The lines of a text without its comments, and the edits that its printed form asks for."""

    def __init__(self, plain: str) -> None:
        self.plain = plain
        longest = current().line  # longer ones will be refused
        self.lines = [
            _Line(match.start(), line, None if _OMEGA.match(line) else ARROW.search(line))
            for match in re.finditer(r"[^\n]+", plain)
            if len(line := match.group()) <= longest and not line.isspace()
        ]
        self.labelled = any(_LABEL.match(line.text) or _OMEGA.match(line.text) for line in self.lines)
        self.printed = self.labelled or bool(_DELTA.search(plain))
        self.first = next((index for index, line in enumerate(self.lines) if line.arrow), len(self.lines))
        self.counted = self.printed and all(map(_names_n, (line for line in self.lines if _N.search(line.text))))
        self.asides = {*self._asides()} if self.printed else set()
        self.notes: list[str] = []

    def _asides(self) -> Iterator[int]:
        """The lines with a number of a page, a caption's letter or a reference, which are no part of a production."""
        words = " ".join(line.text[line.arrow.end() :] for line in self.lines if line.arrow)
        heads = " ".join(line.text[: line.arrow.start()].split(":")[-1] for line in self.lines if line.arrow)
        known = frozenset(re.findall(r"[^\W\d_]", words)) | frozenset(heads)
        rule, indent = "", 0
        for index, line in enumerate(self.lines):
            above = index + 1 < len(self.lines) and self.lines[index + 1].arrow and _ABOVE.match(line.text)
            if line.arrow:
                rule = line.text
                indent = len(rule) - len(rule.lstrip())
            elif rule and not above and not _NAMED.match(line.text):
                aside = _REFERENCE if len(line.text) - len(line.text.lstrip()) > indent else _ASIDE
                said = line.text.strip()
                other = aside.fullmatch(said) or _SENTENCE.fullmatch(said)
                if not _is_prose(said, known) and (surely_goes_on(line.text, rule, known) or not other):
                    rule = pending(rule + line.text)
                else:
                    yield index

    def ends(self) -> Iterator[Edit]:
        """The same sign at the ends of all lines, perhaps but the last: it separates statements, and is no command."""
        for sign in ",;":
            ending = [line.end for line in self.lines if line.text.rstrip().endswith(sign)]
            if len(ending) > 1 and all(line.end in ending for line in self.lines[:-1]):
                self.notes.append(f'The "{sign}" at the ends of lines is left out.')
                yield from (Edit(end - 1, end, "") for end in ending)

    def settings(self) -> Iterator[Edit]:
        """Numbers on one line, constants and inclusions as cpfg has them, and an axiom that is not called so."""
        printed = any(arrow in self.plain for arrow in "→⟶")
        for line in self.lines:
            if not line.arrow:
                for setting in _SETTINGS.finditer(line.text):
                    yield Edit(line.start + setting.start(1), line.start + setting.end(1), ":")
                if degrees := _DEGREES.match(line.text):
                    yield Edit(line.start + degrees.start(1), line.start + degrees.end(1), "")
            if _ASSIGNMENTS.match(line.text):
                yield from self._assignments(line)
            elif self.labelled and _DIRECTIVE.match(line.text):
                yield from self._directive(line)
            elif start := _START.match(line.text):
                yield Edit(line.start + start.start(1), line.start + start.end(), "axiom:")
            elif (omega := _OMEGA.match(line.text)) and omega[1]:
                yield Edit(line.start + omega.start(1), line.start + omega.end(1), ":")
            if _NAMED_AXIOM.match(line.text) and (self.plain[line.end - 1] == "," or (printed and self._is_stop(line.end - 1))):
                yield Edit(line.end - 1, line.end, "")
        yield from self._axiom()

    def _directive(self, line: _Line) -> Iterator[Edit]:
        """A constant, a list of symbols or an inclusion as cpfg has them."""
        if defined := _DEFINED.match(line.text):
            yield Edit(line.start + defined.start(1), line.start + defined.end(1), "")
            yield Edit(line.start + defined.start(3), line.start + defined.end(3), " = ")
        elif neighbours := _NEIGHBOURS.match(line.text):
            yield Edit(line.start + neighbours.start(1), line.start + neighbours.end(1), "")
            if line.text[neighbours.end() :].lstrip()[:1] != ":":
                yield Edit(line.start + neighbours.end(), line.start + neighbours.end(), ":")
        else:
            self.notes.append(f'"{line.text.strip()}" is passed over.')
            yield Edit(line.start, line.end, "")

    def _assignments(self, line: _Line) -> Iterator[Edit]:
        for match in re.finditer(r"[,;]|\.(?=[ \t]*$)", line.text):
            yield Edit(line.start + match.start(), line.start + match.end(), "\n" if line.text[match.end() :].strip() else "")
        angle = _DELTA_IN_LETTERS.search(line.text)
        if angle and self.printed and sum(1 for _ in islice(_DELTA_WORD.finditer(self.plain), 2)) == 1:
            self.notes.append('"delta" is read as the angle.')
            yield Edit(line.start + angle.start(), line.start + angle.end(), "angle:")
        steps = _STEPS.search(line.text)
        if steps and self.counted:
            self.notes.append('"n" is read as the number of steps.')
            yield Edit(line.start + steps.start(), line.start + steps.end(), "steps:")

    def _axiom(self) -> Iterator[Edit]:
        """Under a line with the angle a word stands alone, before the first production."""
        before = [*islice((line for line in self.lines if not (_ASSIGNMENTS.match(line.text) or _NAMED.match(line.text))), 2)]
        named = any(_NAMED_AXIOM.match(line.text) for line in self.lines)
        if not named and len(before) > 1 and not before[0].arrow and before[1].arrow and self._is_word(before[0]):
            first = before[0]
            self.notes.append(f'"{first.text.strip()}" is read as the axiom.')
            yield Edit(first.start, first.start, "axiom: ")

    def _is_word(self, line: _Line) -> bool:
        return self.printed or bool(_WORD.fullmatch(line.text.rstrip()))

    def letters(self) -> Iterator[Edit]:
        """Greek letters as names; δ is a constant, too, where it is used and not only set."""
        empty = {match.start("sign") for match in _EMPTY.finditer(self.plain)}
        if len(empty) == len(re.findall("[λΛ∅]", self.plain)):  # else it is a symbol
            yield from (Edit(at, at + 1, "ε") for at in empty)
            self.notes += [f"{sign} is read as ε, the empty word." for sign in sorted({self.plain[at] for at in empty})]
        else:
            empty = set()
        if not GREEK.search(self.plain):
            return
        latex = bool(MACRO.search(self.plain))
        named = [pair for line in self.lines for pair in named_letters(line.text, line.start, latex)]
        found = [pair for pair in named if pair[1].start not in empty]
        yield from (edit for _, edit in found)
        if any(edit.text.strip() == "delta" for _, edit in found):
            yield from filter(None, (angle_as_constant(line.text, line.start) for line in self.lines))
        if found:
            read = dict.fromkeys(f"{letter} as {name_of(letter)}" for letter, _ in found)
            self.notes.append(f"Greek letters are read as names: {', '.join(read)}.")

    def rules(self) -> Iterator[Edit]:
        """Productions: lines that go on, what stands over the arrow, stars for any neighbour, and "="."""
        above: str | None = None
        chances: dict[str, list[Fraction]] = {}
        yield from self._chances_behind()
        for index, line in enumerate(self.lines):
            arrow = line.arrow
            if index in self.asides and (angle := _ANGLE_ALONE.fullmatch(line.text)) and not _ANGLE_SAID.search(self.plain):
                self.notes.append(f'"{line.text.strip()}" is read as the angle.')
                yield Edit(line.start, line.start + angle.start(1), "angle: ")
                yield Edit(line.start + angle.end(1), line.start + len(line.text), "")
                continue
            if index in self.asides:
                self.notes.append(left_out(line.text))
                yield Edit(line.start, line.end, "")
                continue
            if arrow is None:
                number = _ABOVE.match(line.text)
                following = self.lines[index + 1] if index + 1 < len(self.lines) else None
                if number and following and following.arrow:
                    above = number[1]
                    yield Edit(line.start, line.end, "")
                elif self._goes_on(index):  # on one line, since "C : .5" alone on its line would begin a production
                    yield Edit(self.lines[index - 1].end, line.start, " ")
                continue
            yield from self._head(line, line.text[: arrow.start()])
            condition = ":" in self._bare(line)[: arrow.start()]  # which may end with a number, too
            over = _AFTER_COLON.search(line.text) or (None if condition else _PROBABILITY.search(line.text))
            if (chance := _CHANCE.match(line.text)) and not self._has_values(chance["symbol"]):
                yield Edit(line.start + chance.start("value"), line.start + chance.end("value"), "")
                above = chance["number"]
                chances.setdefault(chance["symbol"], []).append(Fraction(above))
            if over:
                yield Edit(line.start + over.start(), line.start + over.end(), "")
            if over or above:
                end = self._end(index)
                yield Edit(end, end, f" : {over[1] if over else above}")
            above = None
            if (
                (self.labelled or arrow[0] in "→⟶")
                and (number := _NUMBERED.search(line.text))
                and not self._has_values(line.text[: number.start()][-1])
            ):
                self.notes.append(f'"{number["number"]}" is read as the number of an equation.')
                yield Edit(line.start + number.start("number"), line.start + number.end("number"), "")
            end = self._end(index)
            if arrow[0] in "→⟶" and self._is_stop(end - 1):
                yield Edit(end - 1, end, "")
        for symbol, each in chances.items():
            whole = "" if sum(each) == 1 else f"; together they are {float(sum(each)):g}, not 1"
            self.notes.append(f"The numbers before the arrows of {symbol} are read as probabilities{whole}.")

    def _is_stop(self, at: int) -> bool:
        """Whether a full stop ends a line at an offset, and no vertex of a polygon; which is said once."""
        stop = self.plain[at] == "." and "{" not in self.plain
        if stop and FULL_STOPS not in self.notes:
            self.notes.append(FULL_STOPS)
        return stop

    def _chances_behind(self) -> Iterator[Edit]:
        """Probabilities in brackets, set apart behind the words of all rules for a symbol, if together they are 1."""
        found: dict[str, list[tuple[_Line, re.Match[str] | None]]] = {}
        for line in self.lines:
            if line.arrow:
                found.setdefault(line.text[: line.arrow.start()].strip(), []).append((line, _CHANCE_BEHIND.search(line.text)))
        for head, rules in found.items():
            chances = [match for line, match in rules if match and self._is_apart(line.text[: match.start()])]
            together = sum((Fraction(match["number"]) for match in chances), Fraction(0))
            if len(chances) == len(rules) > 1 and abs(together - 1) < Fraction(1, 50):
                self.notes.append(f"The numbers behind the words of {head} are read as probabilities.")
                for (line, _), match in zip(rules, chances, strict=True):
                    yield Edit(line.start + match.start(), line.end, f": {match['number']}")

    def _is_apart(self, before: str) -> bool:
        """Whether brackets behind a text are set apart, and hold no value of its last symbol."""
        return before[-1:] in (" ", "\t") and not self._has_values(before.rstrip()[-1])

    def _has_values(self, symbol: str) -> bool:
        """Whether a symbol has values somewhere but in brackets set apart before an arrow."""
        return any(f"{symbol}(" in line.text for line in self.lines)

    def _head(self, line: _Line, head: str) -> Iterator[Edit]:
        for match in _ANY.finditer(line.text, 0, len(head) + 2):
            side = match.lastgroup or "left"
            yield Edit(line.start + match.start(side), line.start + match.end(side), "")
        colon = blank_parentheses(head).rfind(":")
        if self.labelled and colon >= 0:
            for match in _EQUALS.finditer(head, colon):
                self.notes.append('"=" is read as "==" in conditions.')
                yield Edit(line.start + match.start(), line.start + match.end(), "==")

    def _goes_on(self, index: int) -> bool:
        """Whether a line of a printed listing goes on with the production above."""
        line = self.lines[index]
        return (
            self.printed
            and index > self.first
            and index not in self.asides
            and not _NAMED.match(line.text)
            and not _ABOVE.match(line.text)
        )

    def _end(self, index: int) -> int:
        """Where a production ends that begins on a line."""
        while index + 1 < len(self.lines) and not self.lines[index + 1].arrow and self._goes_on(index + 1):
            index += 1
        return self.lines[index].end

    def digits(self) -> Iterator[Edit]:
        """Digits as symbols, where a production rewrites one: set apart from what they are glued to."""
        heads = [line for line in self.lines if line.arrow]
        declared = any(_ALPHABET.match(line.text) for line in self.lines)
        if declared or not any(_DIGIT_RULE.match(self._bare(line)) for line in heads):
            return
        found: dict[str, None] = {}
        for line in self.lines:
            bare = self._bare(line)
            if not (ARROW.search(bare) or _OMEGA.match(bare) or _ROW.match(bare)):
                continue
            if label := _LABEL.match(line.text):  # before digits it might be taken for a module with a condition
                yield Edit(line.start, line.start + label.end(), "")
            for match in _DIGIT.finditer(bare):
                found[match.group()] = None
                at = line.start + match.start()
                yield Edit(at, at + 1, f" {match.group()} ")
        self.notes.append(f"The digits {', '.join(sorted(found))} are read as symbols.")
        yield Edit(0, 0, f"alphabet: {' '.join(sorted(found))}\n")

    def _bare(self, line: _Line) -> str:
        """A line without its label, its values and what stands over its arrow, every other character in its place."""
        label = _LABEL.match(line.text)
        text = " " * label.end() + line.text[label.end() :] if label else line.text
        return _PROBABILITY.sub(lambda match: " " * len(match.group()), blank_parentheses(text))


def likely(text: str) -> int:
    """How likely a text is a listing as The Algorithmic Beauty of Plants prints it: labels and an ω are no other notation's."""
    return 1 + 100 * bool(_LABELLED.search(text))
