"""Lists of named parts and rules, as encyclopaedias, home pages, lessons and the windows of programs have them.

The parts of a text are put together to systems; what sentences around them say is taken in, or told.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import groupby, pairwise

from lsys_kit.errors import ModelSyntaxError, quotable
from lsys_kit.notation.formats.found import (
    CONDITION,
    Found,
    Passage,
    Rule,
    angle_of,
    chance_of,
    first_taken,
    not_taken,
    program_of,
    symbols_in,
    tables,
    unquoted,
)
from lsys_kit.notation.formats.parts import (
    AFTER,
    ALIAS,
    ANY_ARROW,
    ARROW,
    BEFORE,
    BLANKS,
    COMMENT,
    DERIVATION,
    NOTHING,
    Part,
    end_of_value,
    is_word,
    parts_in,
    parts_in_line,
    without_comment,
)
from lsys_kit.notation.syntax.text.statements import is_unfinished, pending, surely_goes_on
from lsys_kit.notation.syntax.text.transcription import FULL_STOPS, left_out

OWN_FRAME = re.compile(
    r"^[ \t]*(?:[Ll]system[ \t]*:[ \t]*\w|\\(?:axiom|var|const|angle)\b[^{]|\*[ \t]*\#[ \t]*\w"
    r"|(?:[Dd]efine|Start|StartEach|End|EndEach)[ \t]*:[ \t]*\{)",
    re.MULTILINE,
)
"""What frames a text in cpfg's notation or GROGRA's: their readers say what is wrong with it."""
_OWN_STATEMENT = re.compile(
    r"^[ \t]*(?:surface\b[^\n]*[:(]|(?:decomposition|interpretation|homomorphism)[ \t]*+:?[ \t]*+$"
    r"|(?:field|meta|consider|branches|decomposition depth|maximum depth)[ \t]*:"
    r"|(?:cells|widths|colou?rs|turtle)[ \t]*:[ \t]*(?:ellip|rect|pix|unit|nat|symb|abop|grog|plant|fract)"
    r"|\#[ \t]*(?:def|inc|und|if|end)\w*\b|[^\s{}=:\\]+[ \t]*(?:\([^()\n]*\)[ \t]*)?\{[ \t]*(?:;[^\n]*)?$)",
    re.MULTILINE,
)
"""Statements of the kit's notations: their readers say what is wrong with a text that has one."""
_OWN_ARROW = re.compile(r"-->|->|→|⟶|::=")
_SENTENCE = re.compile(r"(?<![A-Za-zÀ-ÿА-я])[A-Za-zÀ-ÿА-я]{3,}+[ ,&]++[A-Za-zà-ÿА-я]{3}")
_RADIANS = re.compile(r"pi\b|π|\brad")
_REFERENCE = re.compile(r"\s*(?:\[\d{1,3}\]|\(\d{1,3}\)|\d{2,4}|[-–][ ]?\d{1,4}[ ]?[-–]|/[ ]?[a-z])\s*")
"""The number of a page, of a footnote, a caption's letter, alone on a line."""
_WITH_CHANCE = re.compile(r"(\w)[ \t]*(\((?:0?\.\d+|\d{1,3}(?:\.\d+)?[ \t]?%|\d{1,3}/[1-9]\d{0,2})\))")
"""What is replaced, with its probability in brackets."""
_MARKED = re.compile(
    r"&(?:\w{2,8}|#\d{1,6});|^[ \t]*+(?:[☀-➓🌀-🫿]|\([ivx]{1,4}\)[ \t])|\\-\\?>"
    r"|<(?:b|br|p|tt|td)\b[^<>\n]{0,99}>|\*\*|`|\\begin\{|\\displaystyle|\\(?:text|math)tt\b|\\verb\b"
    r"|\{\\tt\b|^[ \t]*+set[ ]\[|^[ ]*+(?:axiom|start|angle)\t"
    r"|^[ \t]*+\|?[ \t]*+:?-{3,}+:?[ \t]*+\||^[ \t]*+\|[ ][^|\n]++(?<=[ ])\|[ ][^\n]*\|[ \t]*+$",
    re.IGNORECASE | re.MULTILINE,
)


def _is_on_a_page(text: str, items: Sequence[Part], source: str) -> bool:
    """Whether a text has what none in the kit's notation has: other names and signs, several parts on a line, prose."""
    if OWN_FRAME.search(text) or _OWN_STATEMENT.search(text):
        return False
    lines = [item.line for item in items if item.kind not in ("", "blank")]
    kinds = [item.kind for item in items if item.kind != "blank"]
    several = len(lines) > len({*lines}) or kinds == ["rule"]
    return several or _MARKED.search(source) is not None or any(_is_foreign(item, text) for item in items)


def _is_foreign(item: Part, text: str) -> bool:
    """Whether a part is none of the kit's notation."""
    if item.kind and COMMENT.search(text, item.start, item.end):
        return True
    if item.kind in ("", "above"):
        others = (_SENTENCE.search, _REFERENCE.fullmatch, DERIVATION.search)
        return any(other(text, item.start, item.end) for other in others)
    if item.kind == "rule" and item.match:
        labelled = item.match["label"] and not re.match(r"[pP]_?\d", item.match["label"])
        return _OWN_ARROW.fullmatch(item.match["arrow"]) is None or bool(
            labelled
            or item.match["first"]
            or item.match["within"]
            or _WITH_CHANCE.fullmatch(item.match["head"])
            or CONDITION.search(item.match["head"].replace(":", " "))
            or unquoted(value := item.value(text)) != value
            or AFTER.search(text, item.start, item.end)
            or BEFORE.match(text[item.start : item.end])
        )
    if item.kind in ("axiom", "angle", "steps") and item.match:
        said = text[item.start : item.end]
        named = item.match["name"].lower() not in (item.kind, "ω", "δ") or item.match["sep"] != ":"
        return named or (said.endswith(".") and item.kind != "steps") or bool(item.kind == "angle" and _RADIANS.search(said))
    return item.kind not in ("blank", "ignore", "more", "value")


def systems_in_lines(text: str, source: str = "") -> list[Found]:
    """The systems that a text lists, each of which has an axiom or rules; the source is the text with the marks of its page.

    >>> [found] = systems_in_lines("start : X\\nrules : (X → F[+X]), (F → FF)\\nangle : 25°")
    >>> found.axiom[0].text, [(rule.head.text, rule.tail[0].text) for rule in found.rules], found.angle[0]
    ('X', [('X', 'F[+X]'), ('F', 'FF')], Fraction(25, 1))
    """
    items = parts_in(text)
    if not _is_on_a_page(text, items, source):
        return []
    heads = [item.match["head"].strip("\"' ") for item in items if item.kind == "rule" and item.match]
    letters = frozenset(sign for head in heads if len(head) <= 2 or head.islower() for sign in head)
    names = frozenset(head for head in heads if len(head) > 1 and head.isidentifier()) | _with_subscripts(source)
    items = _with_plain_axioms(text, items, letters)
    _check_arrows(text, items)
    _check_left_out(text, items)
    systems = [replace(_system(text, group), names=names) for group in _groups(items)]
    for word in (
        word for each in systems for word in (*(each.axiom or ()), *(part for rule in each.rules for part in rule.tail))
    ):
        if command := re.search(r"\\[a-z]{3,}", word.text):
            hint = "Put what it stands for in its place."
            at = word.at + command.start() * word.exact
            raise ModelSyntaxError("I do not know this command of LaTeX", text, at, at + len(command[0]), hint)
    systems = [_without_references(_without_function(each)) for each in systems if each.axiom or each.rules] or [Found()]
    starts = ((text.rfind("\n", 0, item.start) + 1 if item.kind in ("angle", "rules") else item.start, item) for item in items)
    prose = [
        Passage(text[at : item.end], at) for at, item in starts if item.kind in ("", "axiom", "rule", "rules", "angle", "other")
    ]
    systems = [*{(_all_of(system.axiom), *map(_shown, system.rules)): system for system in reversed(systems)}.values()][::-1]
    lost = _lost_rules(text, items)
    for system in systems:
        system.notes += lost if system.rules else ()
        system.notes += _told_names(system)
    for system in systems if len(systems) == 1 else ():
        _take_said(system, prose)
        _take_prose(system, prose)
        _take_turns(system, text)
        _take_scales(system, text)
        _take_chance(system, text)
    return [system for system in systems if system.axiom or system.rules]


_SUBSCRIPT = re.compile(r"(?<![A-Za-z])([A-Za-z])(?:<sub>(\w{1,3})</sub>|([₀-₉]{1,3}))")
_PLAIN = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")


def _with_subscripts(source: str) -> frozenset[str]:
    """The symbols that a page writes with a subscript, as they are typed."""
    return frozenset(f"{match[1]}{match[2] or match[3].translate(_PLAIN)}" for match in _SUBSCRIPT.finditer(source))


_FOOTNOTE = re.compile(r"(?:\[\d{1,3}\]){1,5}$")


def _without_references(found: Found) -> Found:
    """The same without the numbers of footnotes behind words, F+F[1], where no digit is a symbol otherwise."""
    words = [*(found.axiom or ()), *(part for rule in found.rules for part in (rule.head, *rule.tail))]
    marks = [mark[0] for word in words if (mark := _FOOTNOTE.search(word.text))]
    rest = "".join(re.sub(r"\([^()]*\)", "", _FOOTNOTE.sub("", word.text)) for word in words)
    if not marks or any(map(str.isdigit, rest)):
        return found

    def bare(words: tuple[Passage, ...]) -> tuple[Passage, ...]:
        return tuple(word.part(0, len(_FOOTNOTE.sub("", word.text))) for word in words)

    rules = [replace(rule, tail=bare(rule.tail)) for rule in found.rules]
    note = f"Behind words, {' and '.join(dict.fromkeys(marks))} are left out: numbers of footnotes."
    return replace(found, axiom=bare(found.axiom) if found.axiom else None, rules=rules, notes=[*found.notes, note])


def _told_names(found: Found) -> list[str]:
    """A note on the first word in which a name of several letters stands beside other letters: they might be single symbols."""
    for word in (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail)):
        symbols = [(start, end) for start, end, values in symbols_in(word.text, found.names) if not values]
        pieces = [word.text[start:end] for start, end in symbols]
        if any(
            left[1] == right[0] and max(left[1] - left[0], right[1] - right[0]) > 1
            for left, right in pairwise(symbols)
            if word.text[left[0]].isalnum() and word.text[right[0]].isalnum()
        ):
            return [f'What stands before an arrow is one symbol: "{word.text}" is read as {" ".join(pieces)}.']
    return []


def _all_of(word: Sequence[Passage] | None) -> str:
    return "".join("".join(part.text for part in word or ()).split())


def _shown(rule: Rule) -> str:
    """A rule without its blanks: a page may show a system twice."""
    return f"{_all_of((rule.head,))}->{_all_of(rule.tail)} : {rule.probability}"


_FUNCTION = re.compile(r"([a-z])\s*\(\s*(\w)\s*\)")


def _without_function(found: Found) -> Found:
    """Rules of a homomorphism, h(a) = ab and h(b) = a: what it is called says nothing."""
    heads = [_FUNCTION.fullmatch(rule.head.text) for rule in found.rules]
    tails = "".join(part.text for rule in found.rules for part in rule.tail) + "".join(part.text for part in found.axiom or ())
    if len({head[1] for head in heads if head}) == 1 and all(heads) and heads[0] and heads[0][1] not in tails:
        rules = [
            replace(
                rule,
                head=rule.head.part(*head.span(2)),
                tail=tuple(part.part(0, len(part.text.rstrip(" .,;"))) for part in rule.tail),
            )
            for rule, head in zip(found.rules, heads, strict=True)
            if head
        ]
        return replace(found, rules=rules, names=frozenset())
    return found


_SAY = {name: "|".join(map(re.escape, words)) for name, words in tables()["said"].items()}
"""The words of sentences, each kind as a pattern."""
_BEGIN = "".join({word[0] for word in tables()["said"]["means"]})
_MEANS = rf"(?:[:=][ ]?|(?=[{_BEGIN}])(?:{_SAY['means']})[ ])"
_DEGREES = r"[ ]?(?:°|deg|gra[du])"
_SAID_ANGLE = re.compile(
    rf"(?:{_SAY['turning']}|angle|winkel|旋转|回転)"
    rf"[^.\n\d]{{0,40}}+(?>(?:\d++(?![.,]?\d|{_DEGREES})[^.\n\d]{{1,40}}+)?)(\d{{1,3}}(?:[.,]\d+)?){_DEGREES}"
    rf"|(?:{_SAY['turning']})\w{{0,12}}+[ ](?:{_SAY['left']}|{_SAY['right']})[ ]"
    r"(?:by[ ])?(\d{1,3}+(?:[.,]\d+)?)(?=[ ]?(?:$|[,;.)]))"
    r"|\((\d{1,3}(?:\.\d+)?)[ ]?(?:°|deg)\w*\)|(?<![\d.])(\d{1,3}(?:[.,]\d+)?)°[ ](?:to the |nach |turn)",
    re.IGNORECASE,
)
_SAID_STEPS = re.compile(
    rf"(?<![\w.,=+-])(\d{{1,3}})[ ](?:{'|'.join(word for word in tables()['names']['steps'] if len(word) > 4)})\b",
    re.IGNORECASE,
)
_BETWEEN = rf",[ ]?|[ ](?:{_SAY['and']})[ ]"
_SYMBOLS = rf"[A-Za-z0-9](?>(?:(?:{_BETWEEN})[A-Za-z0-9])*)"
_ANDS = (words for _, words in groupby(sorted(tables()["said"]["and"], key=len), len))
_GAPS = (",", ",[ ]", *(f"[ ](?:{'|'.join(words)})[ ]" for words in _ANDS))
_FIRST = "".join(rf"(?<!(?<![\w\"'])(?<!(?:draw|move)[ ])[A-Za-z0-9]{gap})" for gap in _GAPS)
"""Behind nothing that is one of the symbols of a list, from which the list has been tried."""
_DRAWING = rf"[ ]++(?:(?:{_SAY['both']})[ ])?[\"']?(?:(?P<draw>{_SAY['draw']})|{_SAY['move']})\b"
_SAID_DRAWS = (
    re.compile(
        rf"(?<![\w\"'])(?:[\"']|{_FIRST})(?P<symbols>{_SYMBOLS})[\"']?"
        rf"[ ]?(?:(?:(?:{_SAY['both']})[ ])?(?:{_SAY['means']})|[:=-]){_DRAWING}",
        re.IGNORECASE,
    ),
    re.compile(
        rf"(?<![\w\"'])(?:[\"']|{_FIRST})(?P<symbols>{_SYMBOLS})[\"']?"
        rf"[ ](?P<draw>{_SAY['does']})\b(?![ ](?:{_SAY['nothing']})\b)",
        re.IGNORECASE,
    ),
    re.compile(rf"\b(?:{_SAY['means']})[ ][\"']?(?P<symbols>{_SYMBOLS})[\"']?{_DRAWING}", re.IGNORECASE),
)
"""Symbols before the verb, before what they do, or behind the verb."""


_SYMBOL_OF_TIKZ = re.compile(r"\\symbol\{(\w)\}\{\\pgflsystem(draw|move)forward")
_W = r"[\"'`]?([A-Za-z0-9+\-\[\]|&^/!]{1,80})[\"'`]?(?=[\s,.;)]|$)"
_SAID_AXIOM = re.compile(
    rf"(?:(?:start|begin)(?:s|n?ing)?[ ](?:with|from)"
    rf"|(?:axiome?|initial string|start[ ]?word|start(?:wort|symbol|zeichen|string)|axioma)[ ](?:is|of|being|ist)?)"
    rf"[ ]?(?:the[ ])?(?:axiom[ ]|word[ ]|string[ ]|(?:axiom|word|string):[ ]|an?[ ]\w+,[ ])?{_W}",
    re.IGNORECASE,
)
_SAID_RULE = re.compile(
    rf"replac(?:e|ing)[ ](?:(?:every|each|all|any)[ ])?[\"'`]?([A-Za-z0-9])[\"'`]?s?"
    rf"[ ](?:with|by)[ ](?:the[ ](?:word|string)[ ])?{_W}"
    rf"|(?:,|\band)[ ](?:(?:every|each)[ ])?[\"'`]?([A-Za-z0-9])[\"'`]?[ ](?:with|by)[ ]{_W}"
    rf"|(?:every|each|jedes|chaque|cada|ogni)[ ][\"'`]?([A-Za-z0-9])[\"'`]?"
    rf"[ ](?:becomes|is[ ]replaced[ ](?:by|with)|wird[ ]durch|par|por|con)[ ]{_W}",
    re.IGNORECASE,
)


def _take_said(found: Found, prose: Sequence[Passage]) -> None:
    """An axiom and rules that stand in sentences, where no list has any."""
    for each in prose if not found.rules else ():
        for match in _SAID_RULE.finditer(each.text):
            first = next(index for index in (1, 3, 5) if match[index])
            if (first == 3 and not found.rules) or any(
                rule.head.at == each.part(*match.span(first)).at for rule in found.rules
            ):
                continue
            found.rules.append(Rule(each.part(*match.span(first)), (each.part(*match.span(first + 1)),)))
    heads = {rule.head.text for rule in found.rules}
    axioms = [
        each.part(*match.span(1))
        for each in prose
        for match in _SAID_AXIOM.finditer(each.text)
        if is_word(match[1]) and not heads.isdisjoint(match[1])
    ]
    if found.axiom is None and found.rules and len({axiom.text for axiom in axioms}) == 1:
        found.axiom = (axioms[0],)
        found.notes.append(f'The axiom is that of the text: "{axioms[0].text}".')


def _take_prose(found: Found, prose: Sequence[Passage]) -> None:
    """What sentences around the list say: an angle, and which letters draw."""
    said = [match for each in prose for match in _SAID_ANGLE.finditer(each.text)]
    angles = {angle: match for match in said if (angle := angle_of(match[match.lastindex or 1])) is not None}
    if found.angle is None and len(angles) == 1:
        [(angle, match)] = angles.items()
        found.angle = angle, Passage(match[0], prose[0].at, False)
        found.notes.append(f'The angle is that of the text: "{match[0]}".')
    steps = {match[1] for each in prose for match in _SAID_STEPS.finditer(each.text)}
    if found.steps is None and len(steps - {"0"}) == 1:
        [number] = steps - {"0"}
        found.steps = int(number), Passage("", prose[0].at, False)
        found.notes.append(f"The number of steps, {number}, is that of the text.")
    used = {
        symbol for rule in found.rules for symbol in re.findall(r"\w", "".join(part.text for part in (rule.head, *rule.tail)))
    }
    for match in (match for each in prose for pattern in _SAID_DRAWS for match in pattern.finditer(each.text)):
        command = "F" if match["draw"] else "f"
        for symbol in re.split(_BETWEEN, match["symbols"]):
            if symbol in used and symbol not in (command, "F") and symbol != "G" * (command == "F"):
                found.drawn[symbol] = command
    found.drawn |= {
        match[1]: "F" if match[2] == "draw" else "f"
        for each in prose
        for match in _SYMBOL_OF_TIKZ.finditer(each.text)
        if match[1] not in "Ff"
    }
    if (
        found.drawn and not used & {"F", "G"} and "F" not in found.drawn.values()
    ):  # where nothing else draws, whoever moves does
        found.drawn = dict.fromkeys(found.drawn, "F")
    if found.drawn:
        drawn = ", ".join(f"{symbol} is drawn as {command}" for symbol, command in sorted(found.drawn.items()))
        found.notes.append(f"As the text says, {drawn}.")


_SAID_CHANCE = re.compile(rf"(?<!\w)(?:{_SAY['random']})(?!\w)", re.IGNORECASE)


def _take_chance(found: Found, text: str) -> None:
    """Rules for the same symbol without probabilities, of which one is taken at random, as the text says: all alike."""
    said = _SAID_CHANCE.search(text)
    heads = [rule.head.text for rule in found.rules]
    if said and all(rule.probability is None for rule in found.rules):
        found.rules = [
            replace(rule, probability=Fraction(1, n)) if (n := heads.count(rule.head.text)) > 1 else rule
            for rule in found.rules
        ]
        found.notes += [
            f'"{said[0]}": each rule of {head} is read as equally probable.'
            for head in sorted({*heads})
            if heads.count(head) > 1
        ]


_SAID_TURN = re.compile(
    r"(?:^|(?<=[\s\"'`(]))(?P<sign>[+\-]|(?-i:[B-HJ-Z])(?!\w)|[a-z](?=[\"'`)]?[ ]?" + _MEANS + "))"
    rf"[\"'`)]?[ ]?{_MEANS}?"
    r"[^.,;\n+\-\[\]]{0,60}?"
    rf"\b(?:(?P<left>{_SAY['left']})|(?P<right>{_SAY['right']}))\b",
    re.IGNORECASE | re.MULTILINE,
)


_SAID_BRACKET = re.compile(
    rf"(?:^|(?<=[\s\"'`(]))\[[\"'`)]?[ ]?{_MEANS}?[^.;\n+\-\[\]]{{0,60}}?"
    rf"\b(?:{_SAY['left']}|(?P<right>{_SAY['right']}))\b",
    re.IGNORECASE | re.MULTILINE,
)
_TURNING = re.compile(_SAY["turning"], re.IGNORECASE)


_SIGN_BEFORE = re.compile(r"([+\-])[\"'`)]?[ ]?(?:and|und|or|oder|,|/)[ ]?[\"'`(]?$")
"""A sign that the same sentence names before, as in "+ and - turn to the left or to the right": it turns the first way."""


def _turning(pattern: re.Pattern[str], text: str) -> Iterator[re.Match[str]]:
    """Where a text speaks of turns."""
    return (each for each in pattern.finditer(text) if _TURNING.search(text[each.start() : each.end() + 12].split("\n")[0]))


def _take_turns(found: Found, text: str) -> None:
    """What sentences say of the sense of + and -, and of brackets that turn, too."""
    said = set()
    for match in _turning(_SAID_TURN, text):
        before = _SIGN_BEFORE.search(text, max(0, match.start() - 12), match.start())
        said.add((before[1] if before else match["sign"], match["left"] is None))
    plus, minus = (said & {(sign, False), (sign, True)} for sign in "+-")
    if plus | minus and plus <= {("+", True)} and minus <= {("-", False)}:
        found.signs = {**found.signs, "+": "-", "-": "+"}
        found.notes.append("In this text + turns right and - left: they are exchanged here.")
    used = "".join(part.text for part in (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail)))
    letters = [(sign, right) for sign, right in sorted(said) if sign.isalpha() and sign in used and sign not in found.drawn]
    for sign, right in letters:
        if (sign, not right) not in said:
            found.drawn[sign] = "-" if right else "+"
            found.notes.append(f"As the text says, {sign} turns {'right' if right else 'left'}.")
    opened = {match["right"] is not None for match in _turning(_SAID_BRACKET, text)}
    if len(opened) == 1:
        there, back = "-+" if opened == {True} else "+-"
        found.signs = {**found.signs, "[": f"[{there}", "]": f"]{back}"}
        found.notes.append(f'As the text says, brackets turn, too: "[" is read as [{there} and "]" as ]{back}.')


_SAID_SCALE = re.compile(
    rf"(?:^|(?<=[\s\"'`(]))(?P<sign>[<>])[\"'`)]?[ ]?{_MEANS}"
    r"(?:the[ ])?(?:line[ ]|step[ ])?(?:scal|multipl|shorten|shrink|length|size)[a-z]*+[^\n\d<>]{0,40}?(?P<factor>\d?\.\d+|\d)",
    re.IGNORECASE | re.MULTILINE,
)


def _take_scales(found: Found, text: str) -> None:
    """What sentences say of < and > as factors of lengths."""
    for match in _SAID_SCALE.finditer(text):
        made = f"@Di({float(match['factor']):g})"
        found.signs = {**found.signs, match["sign"]: made}
        found.notes.append(f"As the text says, {match['sign']} is read as {made}: lengths are multiplied by the number.")


def _indent(text: str, item: Part) -> int:
    """How many blanks stand before the line of a part."""
    line = text[text.rfind("\n", 0, item.start) + 1 :]
    return len(line) - len(line.lstrip(" \t"))


def _with_plain_axioms(text: str, items: Sequence[Part], letters: frozenset[str]) -> list[Part]:
    """The parts, with a word alone above a rule for an axiom, if no axiom has a name; lines that go on with a rule in it."""
    found: list[Part] = []
    named = any(item.kind == "axiom" for item in items)
    filled = [item for item in items if item.kind != "blank"]
    known = letters.union(*(text[item.start : item.end] for item in filled if item.kind in ("rule", "axiom")))
    rule, margin, headed = "", 0, bool(filled) and filled[0].kind in ("angle", "steps")
    for index, item in enumerate(filled):
        following = filled[index + 1] if index + 1 < len(filled) else None
        word = item.kind == "" and is_word(text[item.start : item.end], letters)
        if word and found and found[-1].kind == "axiom" and not found[-1].value(text).text and found[-1].match:
            found[-1] = replace(found[-1], start=item.start, end=item.end)
            continue
        if word and following and following.kind == "rule" and _ABOVE.fullmatch(text, item.start, item.end):
            found.append(replace(item, kind="above"))
            continue
        if (
            word
            and found
            and found[-1].kind in ("rule", "rules")
            and (missing := _NO_ARROW.fullmatch(text, item.start, item.end))
        ):
            raise ModelSyntaxError(
                "An arrow is missing", text, missing.start(2), None, f'A rule reads "{missing[1]} -> {missing[3].strip()}".'
            )
        line = text[item.start : item.end]
        follows = word and bool(found) and (found[-1].kind in ("rule", "more", "aside") or is_unfinished(rule))
        near = bool(found) and (item.line == found[-1].line + 1 or is_unfinished(rule))
        known_word = follows and any(map(str.isalnum, line)) and {*"".join(line.split())} <= known
        deeper = known_word and near and _indent(text, item) > margin
        again = known_word and headed and is_unfinished(rule) and len(line.strip()) == 1
        if follows and near and not _REFERENCE.fullmatch(line) and (surely_goes_on(line, rule, known) or deeper or again):
            goes_on = named or deeper or again or not following or following.kind != "rule" or len(line.strip()) > 1
        else:
            goes_on = False
        margin = _indent(text, item) if item.kind == "rule" else margin
        rule = line if item.kind == "rule" else pending(rule + line) if goes_on else rule if item.kind == "" else ""
        if goes_on:
            found.append(replace(item, kind="more"))
        elif (
            word
            and not named
            and following
            and following.kind == "rule"
            and re.search(r"[A-Za-z]|" + "|".join(map(re.escape, letters or "A")), text[item.start : item.end])
        ):
            found.append(replace(item, kind="axiom"))
        else:
            below = word and [each.kind for each in found[-2:]] in (["rule", ""], ["more", ""]) and len(line.strip()) > 1
            found.append(replace(item, kind="aside") if (follows or below) and line.strip("{}()[] \t") else item)
    return found


_ABOVE = re.compile(r"\s*(0?\.\d+|1|[1-9]/[1-9])\s*")
"""A probability over an arrow."""
_NO_ARROW = re.compile(r"\s*+([A-Za-z])([ ]{2,}+|\t)\s*+(\S++)\s*+")
"""A rule that lost its arrow."""
_LOST = re.compile(rf"[(:,;{{][ \t]*({ARROW})[ \t]*[^\s)]")
"""An arrow that has nothing to its left."""


def _check_arrows(text: str, items: Sequence[Part]) -> None:
    """Refuse a rule whose left side was lost."""
    for item in items:
        if item.kind in ("rules", "rule"):
            line = text.rfind("\n", 0, item.start) + 1
            lost = _LOST.search(text, line, item.end)
            if lost and not any(
                other.match and other.kind == "rule" and other.match.start("arrow") <= lost.start(1) < other.match.end("arrow")
                for other in items
            ):
                raise ModelSyntaxError(
                    "Nothing stands before this arrow",
                    text,
                    *lost.span(1),
                    "A rule begins with the symbol that is replaced: F -> F+F.",
                )


_ANY_RULE = re.compile(rf"(?<![\w\])>])[\"']?[A-Za-z0-9][\"']?{BLANKS}{ARROW}{BLANKS}[\"']?[A-Za-z0-9+\-\[\]^&/|]+")
"""A rule, wherever it stands."""


def _lost_rules(text: str, items: Sequence[Part]) -> list[str]:
    """The notes on rules that stand in a text, and are no parts of a system."""
    rules = [(item.match.start("head"), item.end) for item in items if item.kind == "rule" and item.match]
    read = {re.sub(r"[^\w+\-\[\]]|->", "", text[start:end]) for start, end in rules}
    notes = []
    for match in _ANY_RULE.finditer(text):
        inside = any(start <= match.end() - 1 < end or start == match.start() for start, end in rules)
        word = is_word(re.split(ARROW, match[0])[-1].strip("\"' "))
        if word and not inside and re.sub(r"[^\w+\-\[\]]|->", "", match[0]) not in read:
            notes.append(f'"{match[0]}" is not read: it stands in a sentence.')
    return notes


_WRITTEN = re.compile(
    rf"[A-Za-z\d][ \t]*(?:{ARROW}|[-=:>~]{{1,3}})[ \t]*[A-Za-z\d\-^/\\|]*+[\[\](+&][A-Za-z\d+\-\[\]&^/\\|()\d. :*,]*+"
)
"""What one takes for a rule."""


_CONDITION_BEFORE = re.compile(r"[ \t]*+(?:(?:if|when|for)[ ])?([A-Za-z]\w*+[ ]?(?:[<>]=?|==)[ ]?[\w.]++)[ ]?:[ \t]*\Z")


def _check_left_out(text: str, items: Sequence[Part]) -> None:
    """Refuse a line among the parts that looks like a rule and is none."""
    parts = [index for index, item in enumerate(items) if item.kind == "rule"]
    for match in (items[index].match for index in parts):
        if match and (condition := _CONDITION_BEFORE.match(text, text.rfind("\n", 0, match.start()) + 1, match.start())):
            hint = 'A condition is written between ":" and the arrow, as in "A(t) : t < 5 -> B".'
            raise ModelSyntaxError('A ":" is missing before the condition', text, *condition.span(1), hint)
    for item in items[parts[0] : parts[-1] + 2] if parts else items:
        line = text[item.start : item.end].strip()
        if item.kind == "" and _WRITTEN.fullmatch(line) and not re.search(r"[a-z]{3}", line):
            raise ModelSyntaxError(
                "I cannot read this line", text, item.start, item.end, "A rule reads F -> F+F: a symbol, an arrow, a word."
            )


def has_unread_words(text: str) -> bool:
    r"""Whether a line with an arrow is no rule, or a word stands alone on a line.

    >>> has_unread_words("Axiom: F\nRules:"), has_unread_words("Axiom: F\nF F+F")
    (False, True)
    """
    lines = (text[item.start : item.end] for item in parts_in(text) if item.kind == "")
    return ANY_ARROW.search(text) is not None or any(is_word(line) for line in lines)


def is_prose(text: str) -> bool:
    r"""Whether a text has sentences, or a path through pages, and nothing of a system.

    >>> is_prose("Home → Fractals → L-systems\nPosted by Anna on Monday"), is_prose("axiom: F"), is_prose("Leaf -> Leaf Leaf")
    (True, False, False)
    """
    items = parts_in(text)
    return bool(_SENTENCE.search(text) or _PATH.search(text)) and all(
        item.kind in ("", "blank") or _PATH.match(text, text.rfind("\n", 0, item.start) + 1) for item in items
    )


def is_other(text: str) -> bool:
    r"""Whether no line of a text has an arrow, and what stands there is neither words of symbols nor a list of values.

    >>> is_other("1. e4 e5 2. Nf3 Nc6"), is_other("F+F"), is_other("dt = 0.5"), is_other("A -> B")
    (True, False, False, False)
    """
    if ANY_ARROW.search(text) or OWN_FRAME.search(text) or _OWN_STATEMENT.search(text):
        return False
    lines = [line for line in text.splitlines() if line.strip() and ("," in line or not is_word(line))]
    return bool(lines) and (any(map(_SENTENCE.search, lines)) or not any(map(_NAMED.match, lines)))


_NAMED = re.compile(r"[ \t]*+\w[\w ]*+(?:\([^()]*+\))?[ \t]*+[:=]")
_PLACE, _STEP = r"[A-Z]\w*+(?>(?:[ -]\w++)*)", rf"[ ]?(?:{ARROW}|>|»)[ ]?"
_PATH = re.compile(rf"^[ \t]*+{_PLACE}(?:{_STEP}{_PLACE}){{2,9}}$", re.MULTILINE)
"""Where a page is, as its head says: Home → Fractals → L-systems."""


def _groups(items: Sequence[Part]) -> Iterator[Sequence[Part]]:
    """The parts of each system: another one begins with another axiom, or with the settings above it."""
    cuts = [0]
    for first, second in pairwise(index for index, item in enumerate(items) if item.kind == "axiom"):
        rules = [index for index in range(first, second) if items[index].kind in ("rule", "more")]
        if rules and any(item.kind in ("rule", "rules", "tail") for item in items[second:]):
            said = {item.kind for item in items[cuts[-1] : rules[-1]]} & {"angle", "steps", "other"}
            cuts.append(
                next((index for index in range(rules[-1] + 1, second) if items[index].kind in (said | {"", "aside"})), second)
            )
    yield from (items[start:end] for start, end in pairwise((*cuts, len(items))))


def _system(text: str, items: Sequence[Part]) -> Found:
    """The system of its parts."""
    found = Found()
    start = text.rfind("\n", 0, items[0].start) + 1 if items else 0
    if label := re.match(r"\s*\(?([a-z])\)", text[start : start + 8]):
        found.name = label[1]
    heads = {sign for item in items if item.kind == "rule" and item.match for sign in item.match["head"]}
    above: str | None = None
    head: Passage | None = None
    absent: Mapping[str, str] = {}
    section = ""
    for item in items:
        value = item.value(text)
        if item.kind == "rules" and item.match:
            drawn = item.match["name"].lower() == "homomorphism" and bool(found.rules)
            section = "interpretation" if drawn else ""
        if item.kind == "above":
            above = value.text
        if item.kind == "aside" and found.rules:
            found.notes.append(left_out(value.text))
        elif item.kind in ("", "aside"):
            line = value.text.strip(" #*=_:;{(")
            if found.axiom is None and 0 < len(line) <= 60 and (not found.name or re.fullmatch(r"\(?[a-z]\)?", line)):
                found.name = line  # a caption's letter is nearer than a heading
        elif item.kind == "axiom" and value.text:
            _add_axiom(found, value, item)
        elif item.kind == "rule":
            rule = _rule(text, item)
            rule, behind = _without_words(rule, heads)
            found.notes += behind
            if text[item.start : item.end].endswith(".") and not rule.tail[0].text.endswith("."):
                found.notes.append(FULL_STOPS)
            if _BETWEEN_WORDS.search(rule.tail[0].text):
                found.notes.append('"|" turns around: two successors are two rules, each with its probability.')
            if not rule.tail[0].text:
                found.notes.append(f"{rule.head.text} is erased: nothing stands behind its arrow.")
            found.rules.append(replace(rule, probability=chance_of(above) if above else rule.probability, section=section))
            above = None
        elif item.kind == "rules" and item.match and item.match["name"].lower() == "generator" and is_word(value.text):
            found.rules.append(Rule(Passage("F", value.at, False), (value,)))
            found.notes.append("The generator replaces F.")
        elif item.kind == "head":
            head = unquoted(value)
        elif item.kind == "tail" and head:
            found.rules.append(Rule(head, (unquoted(value),)))
            head = None
        elif item.kind == "more" and found.rules:
            last = found.rules[-1]
            found.rules[-1] = replace(last, tail=(*last.tail, value))
        elif item.kind in ("angle", "steps"):
            _add_setting(found, item.kind, value, text)
        elif item.kind == "ignore" and not NOTHING.fullmatch(value.text):
            found.ignored = value
        elif item.kind == "draws":
            found.drawn |= dict.fromkeys({*re.findall(r"\w", value.text.replace("and", ""))} - {"F"}, "F")
        elif item.kind == "unread" and item.match and not re.match(r"0(?![.\d])|no\b|false\b|$", value.text, re.IGNORECASE):
            found.notes.append(not_taken(item.match["name"], value.text))
        elif item.kind == "scale" and (scale := angle_of(value.text)):
            found.signs = {**found.signs, ">": f"@Di({float(scale):g})", "<": f"@Dd({float(scale):g})"}
        elif item.kind == "constant" and item.match and (number := angle_of(without_comment(value.text))) is not None:
            found.lines.append(Passage(f"{item.match['name'][-1]} = {float(number):g}", value.at, False))
        if item.match and item.kind not in ("rule", "") and (program := program_of(item.match["name"])):
            found.signs = {**program["signs"], **found.signs}
            absent = program.get("absent", {})
    used = "".join(re.findall(r"\([^()]*\)", "".join(part.text for rule in found.rules for part in (rule.head, *rule.tail))))
    for match, at in ((item.match, item.start) for item in items if item.kind == "value" and item.match):
        if re.search(rf"\b{match['name']}\b", used):
            found.lines.append(Passage(f"{match['name']} = {match['number']}", at, False))
    found.rules = _with_chances(found.rules)
    _give_rest(found)
    found.notes += _told_sums(found.rules)
    symbols = "".join(part.text for part in (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail)))
    heads = {rule.head.text[:1] for rule in found.rules}
    found.notes += [note for signs, note in absent.items() if any(sign in symbols and sign not in heads for sign in signs)]
    return found


def _told_sums(rules: Sequence[Rule]) -> Iterator[str]:
    """A note on each symbol whose probabilities have another sum than one."""
    for head in dict.fromkeys(rule.head.text for rule in rules):
        chances = [rule.probability for rule in rules if rule.head.text == head and rule.probability is not None]
        if chances and abs((together := sum(chances, Fraction(0))) - 1) > Fraction(1, 50):
            yield f"The probabilities of {head} are together {float(together):g}, not 1: they are taken as shares."


def _give_rest(found: Found) -> None:
    """Give the one rule of a symbol that has no probability what those of the others leave of one."""
    for head in dict.fromkeys(rule.head.text for rule in found.rules):
        chances = [rule.probability for rule in found.rules if rule.head.text == head]
        rest = 1 - sum((each for each in chances if each is not None), Fraction(0))
        if len(chances) > 1 and chances.count(None) == 1 and rest > 0:
            index = next(i for i, rule in enumerate(found.rules) if rule.head.text == head and rule.probability is None)
            found.rules[index] = replace(found.rules[index], probability=rest)
            found.notes.append(f"The rule of {head} without a probability has what the others leave: {float(rest):g}.")


def _with_chances(rules: list[Rule]) -> list[Rule]:
    """Rules with probabilities in brackets behind what they replace, F (50%) -> FF, if they sum to one."""
    heads = [_WITH_CHANCE.fullmatch(rule.head.text) for rule in rules]
    for symbol in {head[1] for head in heads if head}:
        chances = [chance_of(head[2]) or Fraction(0) for head in heads if head and head[1] == symbol]
        if len(chances) > 1 and abs(sum(chances, Fraction(-1))) < Fraction(1, 50):
            rules = [
                replace(rule, head=rule.head.part(0, 1), probability=chance_of(head[2])) if head and head[1] == symbol else rule
                for rule, head in zip(rules, heads, strict=True)
            ]
    return rules


def _add_axiom(found: Found, value: Passage, item: Part) -> None:
    alias = ALIAS.match(value.text)
    said = value.part(alias.end() if alias else 0)
    passage = unquoted(Passage(without_comment(said.text), said.at).part(0))
    if not is_word(passage.text) and (word := re.match(r"(\S+?)(?:[,;.]?\s+[a-z]{2,}\b|\.\s+[A-Z])", passage.text)):
        found.notes.append(f'Behind the axiom, "{quotable(passage.text[word.end(1) :].strip()[:40])}" is left out.')
        passage = passage.part(0, word.end(1))
    passage = passage.part(0, end_of_value(passage.text, 0, len(passage.text)))
    if passage.text.endswith(".") and len(passage.text) > 1 and "{" not in passage.text:
        passage = passage.part(0, len(passage.text) - 1)
    if re.fullmatch(r"\([^()]*\)", passage.text):
        passage = passage.part(1, len(passage.text) - 1)
        found.notes.append("The brackets around the axiom are left out.")
    if found.axiom is not None:
        if found.axiom[0].text.split() != passage.text.split():
            found.notes.append(f'The axiom is given more than once: "{found.axiom[0].text}" is used, not "{passage.text}".')
        return
    if item.match is None:
        found.notes.append(f'"{passage.text}" is read as the axiom.')
    found.axiom = (passage,)


def _add_setting(found: Found, kind: str, value: Passage, text: str) -> None:
    said = without_comment(ALIAS.sub("", value.text))
    if kind == "steps":
        if found.steps is None and (number := re.match(r"\d{1,6}", said)):
            found.steps = int(number[0]), value
            found.notes += first_taken(value.text)
        return
    if not said.strip():
        return  # what it is stands behind another name of it: "Winkel:  δ = 25°"
    angle = angle_of(said)
    if angle is None:
        shown = value.text[:40]
        hint = 'Write it in degrees, as in "angle: 60".'
        raise ModelSyntaxError(f'The angle "{shown}" is no number', text, value.at, value.at + max(1, len(value.text)), hint)
    if found.angle is None:
        found.angle = angle, value
        found.notes += first_taken(value.text)
    elif found.angle[0] != angle:
        found.notes.append(f"Two angles are given: {float(found.angle[0]):g} is used, not {float(angle):g}.")


_WORDS = re.compile(r"(?<=\S)\s+(?=([a-zà-ÿ]{4,})(?![\w(\[]))")
"""Where words of a language begin behind a successor."""


def _without_words(rule: Rule, heads: Collection[str]) -> tuple[Rule, list[str]]:
    """A rule without the words behind its successor, and the note on them."""
    [tail] = rule.tail
    behind = next((words for words in _WORDS.finditer(tail.text) if not {*words[1]} <= {*heads}), None)
    if behind is None:
        return rule, []
    said = tail.text[behind.end() :]
    tail = tail.part(0, len(tail.text[: behind.start()].rstrip(";, ")))
    while " " in tail.text and (last := tail.text.rpartition(" ")[2].lower()) in _SMALL_WORDS and last not in heads:
        tail = tail.part(0, len(tail.text.rpartition(" ")[0].rstrip(" .")))
    note = f'Behind the rule of {rule.head.text}, "{quotable(said[:40])}" is left out.'
    return replace(rule, tail=(tail,)), [note]


_SMALL_WORDS = frozenset((*tables()["said"]["and"], *tables()["said"]["lead"]))
"""The first words of what stands behind a successor."""


_BETWEEN_WORDS = re.compile(r"\S\S[ ]+\|[ ]+(?=\S)|(?<!\S)\S[ ]+\|[ ]+(?=\S{2})")
"""A bar that may part two successors, as in a grammar: with blanks around it, where other symbols have none."""
_BEHIND = re.compile(r"[;,][ ]+(?=[a-z]{3,}[ ]+[a-z]{3,}[ ])")
"""Where a sentence begins behind a successor."""


def _rule(text: str, item: Part) -> Rule:
    """The rule of a part."""
    assert item.match is not None
    said = without_comment(text[item.start : item.end])
    after = AFTER.search(said)
    chance = next((chance for name in ("first", "over", "within") if (chance := item.match[name])), None)
    if after:
        chance = chance or next(filter(None, after.groups()), None)
        said = said[: after.start()]
    said, first = _BEHIND.split(said)[0], BEFORE.match(said)
    chance = chance or (first and (first["bracketed"] or first["percents"]))
    tail = Passage(said, item.start).part(first.end() if first else 0)
    tail = unquoted(tail.part(0, end_of_value(tail.text, 0, len(tail.text))))
    if tail.text.endswith(".") and len(tail.text) > 1 and "{" not in tail.text:
        tail = tail.part(0, len(tail.text) - 1)
    if NOTHING.fullmatch(tail.text):
        tail = tail._replace(text="")
    head = Passage(item.match["head"], item.match.start("head")).part(0)
    return Rule(unquoted(head), (tail,), chance_of(chance))


def rules_in_line(passage: Passage) -> list[Rule]:
    """The rules of one line of text, as in "A=B-A-B;B=A+B+A" or "F => FF".

    >>> [(rule.head.text, rule.tail[0].text) for rule in rules_in_line(Passage("A=AB;B=A", 0))]
    [('A', 'AB'), ('B', 'A')]
    """
    items = [item for item in parts_in_line(passage.text, 0, len(passage.text), 0, True) if item.kind == "rule"]
    return [_moved(_rule(passage.text, item), passage) for item in items]


def _moved(rule: Rule, passage: Passage) -> Rule:
    """A rule of a passage, at its place in the whole text."""
    head, *tail = (
        part._replace(at=passage.at + part.at * passage.exact, exact=passage.exact) for part in (rule.head, *rule.tail)
    )
    return Rule(head, tuple(tail), rule.probability)
