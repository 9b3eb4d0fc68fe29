"""Checks of what texts claim, as far as it can be worked out: calculations, words of steps, tables of words."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import islice, pairwise, product

from lsys_kit.budget import limits
from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.panels import panels_of
from lsys_kit.classroom.authoring.told import nearly
from lsys_kit.classroom.authoring.written import BLOT, Cell, Section, Written, without_marks
from lsys_kit.classroom.catalogue import catalogued
from lsys_kit.classroom.exercises.check import BUDGET
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem, read_any, read_number

_RUN = re.compile(r"[\d(), .+−·×*/^=≈-]++")
_BREAK = re.compile(r"[,.] |[,.]$")
_SIGN = re.compile("([=≈])")
_POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
_RAISED = re.compile(r"([⁰¹²³⁴⁵⁶⁷⁸⁹]+)|<sup>([−-]?\d{1,4})</sup>|((?<=\d),? (?:is )?about (?=\d))")
_SPELLED = str.maketrans({"−": "-", "·": "*", "×": "*"})
_NOT_BEFORE = re.compile(rf"(?:[\w)\]{BLOT}^_√/+−·×*<>|!:=≈-]|\b(?:[^\W\d_]|ln|log|sin|cos|tan|exp|root) *| [/+−·×*<>=≈-] *)$")
_NOT_BEHIND = re.compile(rf" ?(?:[{BLOT}^_√%([/+−·×*!=≈…-]|[^\W\d_]\b)|[\w'²³]|\.\.")
_STEP_IS = re.compile(
    r"[Ss]tep (\d{1,2})(?: of `(\w{1,8})`)? (?:is|will be|was|reads|becomes)(?: the word)?:? `([^`\n]{1,400})`"
)
_STEP_BARE = re.compile(r"\b[Ss]tep (\d{1,2}) is ([^.\n`]{1,300})\.(?:\s|$)")
_COUNT = re.compile(r"\b[Ss]tep (\d{1,3})(?: of `(\w{1,8})`)? (?:there are|has|have) (\d[\d,]{2,30})\b(?!\.\d)")
_NOUN = r"(?:`[^`\n]{1,20}`|[^\W\d_]{1,20}(?: [^\W\d_]{1,20}){0,2})"
_SUM = re.compile(
    rf"\b(?:[Tt]ogether|[Ii]n all),? (\d[\d,]{{0,12}}) {_NOUN} and (\d[\d,]{{0,12}}) {_NOUN},? "
    r"(?:which|that) (?:are|is|makes?) (\d[\d,]{0,12})\b(?!%|\.\d)"
)
_LEFT, _RIGHT = r"([^\s`()>:]{1,8})", r"([^`()\n:]{0,80})"
_RULE = re.compile(f"`{_LEFT} -> {_RIGHT}`")
_RULES_SAID = (
    re.compile(
        r"`([A-Z]{1,2}\d{1,3}[a-z]?)`"
        r"(?: has (?:the|one|only one)|,? whose(?: only)?| there is (?:only )?one| is [^.`\n]{0,60}, with the)"
        rf" (?:rule|production)(?: is|,)? {_RULE.pattern}"
    ),
    re.compile(rf"()\b(?:The|[Tt]he only) (?:rule|production) is {_RULE.pattern}"),
    re.compile(rf"()\b(?:[Ee]very|[Ee]ach) `{_LEFT}` is replaced by `{_RIGHT}`"),
    re.compile(rf"() is replaced by `[^`\n]{{1,80}}`,? and (?:every|each) `{_LEFT}` by `{_RIGHT}`"),
)
"""A text that says the rule of a system, which is named or stands in the same section."""
_RULE_LINE = re.compile(r"^([^\s()<>:]{1,8}) -> ([^():\n]*+)$", re.MULTILINE)
_ROW = re.compile(r"^\| *(\d{1,3}) *\| *`([^`|\n]{1,300})` *\|", re.MULTILINE)
_LETTERS = re.compile(r"[^\W\d]++")
_HEADER = re.compile(r"^\| *step *\| *word *\|", re.MULTILINE | re.IGNORECASE)
_DECIMALS = re.compile(r"\.(\d{1,30})$|(?:,|(?<![1-9])0,)(\d{1,2}|\d{4,30})$|(?<!\d)0,(\d{3})$")
MOST_CHARACTERS, MOST_CHOICES = 120, 64
"""Longer calculations are not looked at, nor more choices of rules."""


def calculation_findings(written: Written) -> Iterator[Finding]:
    """Of calculations in texts: that both sides are the same, up to rounding."""
    for cell in written.cells:
        for left, sign, right, value, at in wrong_calculations(cell.plain):
            line = cell.source[:at].count("\n") + 1
            yield finding(written.at(cell, line), "calculation", left=left, sign=sign, right=right, value=value)
    for left, sign, right, value, at in wrong_calculations(without_marks(written.teacher)):
        where = f"teacher/{written.name}.md, line {written.teacher[:at].count(chr(10)) + 1}"
        yield finding(where, "calculation", left=left, sign=sign, right=right, value=value)


def wrong_calculations(text: str) -> Iterator[tuple[str, str, str, str, int]]:
    """The calculations in a text that are wrong: both sides, the sign between them, what comes out, and the place.

    >>> [found[:4] for found in wrong_calculations("units: 13 · 2 + 8 · 1 = 36, and 2/3 ≈ 0.67")]
    [('13 · 2 + 8 · 1', '=', '36', '34')]
    """
    for line in re.finditer(r"[^\n]++", text):
        spelled = _RAISED.sub(_written_out, line[0])
        for run in _RUN.finditer(spelled):
            if "=" in run[0] or "≈" in run[0]:
                begin = 0
                for end in (*(found.start() for found in _BREAK.finditer(run[0])), len(run[0])):
                    part, at = run[0][begin:end], run.start() + begin
                    last = run.start() + end
                    before, behind = "" if begin else spelled[max(0, at - 12) : at], spelled[last : last + 3]
                    if not begin and not before.strip():  # a calculation may go on from the line above
                        before = re.sub(r"[^+−·×*/^=≈-]", "", text[max(0, line.start() - 9) : line.start()].rstrip()[-1:])
                    yield from ((*found, line.start()) for found in _wrong_in(part, before, behind))
                    begin = end + 1


def _written_out(found: re.Match[str]) -> str:
    """A power in signs, or "about" as one."""
    return f"^{found[1].translate(_POWERS)}" if found[1] else f"^({found[2]})" if found[2] else " ≈ "


def _wrong_in(part: str, before: str, behind: str) -> Iterator[tuple[str, str, str, str]]:
    sides = _SIGN.split(part)
    if len(sides) < 3 or len(part) > MOST_CHARACTERS:
        return
    texts = [side.strip() for side in sides[::2]]
    blank = sides[0][:1] == " "
    if _NOT_BEFORE.search(before + " " * blank):
        texts[0] = ""
    if _NOT_BEHIND.match(sides[-1][len(sides[-1].rstrip()) :] + behind):
        texts[-1] = ""
    for (left, right), sign in zip(pairwise(texts), sides[1::2], strict=True):
        if left and right and not (_is_number(left) and _is_number(right)):
            values = [(_value(left, marks), _value(right, marks)) for marks in ((",", ""), (".,", ""))]
            if all(a is None or b is None or not _same(left, a, right, b, sign) for a, b in values) and None not in values[0]:
                a, b = values[0]
                yield left, sign, right, _short(b if _is_number(left) else a)


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[−-]?[\d.,]+", text) is not None


def _value(side: str, marks: tuple[str, str]) -> Fraction | float | None:
    """What a side comes to, with a comma or a point between thousands."""
    if marks[0] == ",":
        plain = re.sub(r"(?<=\d),(?=\d{3}(?!\d))", "", side)
    else:
        plain = re.sub(r"(?<=\d)\.(?=\d{3}(?!\d))", "", side).replace(",", ".")
    if plain[:1] in "+*·×/^" or plain[:2] in ("- ", "− ") or re.search(r"\d [\d(]|\) ?[\d(]", plain):
        return None
    try:
        with limits(**BUDGET):
            value = read_number(plain.translate(_SPELLED))
    except (LSystemError, ArithmeticError):
        return None
    return value if isinstance(value, float) else Fraction(value)


def _same(left: str, a: Fraction | float, right: str, b: Fraction | float, sign: str) -> bool:
    rounded = left if _is_number(left) else right if _is_number(right) else ""
    point = _DECIMALS.search(rounded)
    places = len(point[point.lastindex or 0]) if point else 0
    zeros = len(rounded) - len(rounded.rstrip("0")) if sign == "≈" and not places else 0
    near = 0.0 if sign == "=" and not places else 0.51 * 10.0 ** (zeros - places)
    if not near and isinstance(a, Fraction) and isinstance(b, Fraction):
        return a == b
    return abs(float(a) - float(b)) <= max(near, 1e-9 * abs(float(a)))


def _short(value: Fraction | float | None) -> str:
    if isinstance(value, Fraction) and value.denominator in (1, 2, 4, 5, 8, 10):
        return number_text(value.numerator if value.denominator == 1 else value)
    return f"{float(value or 0):.6g}"


def word_findings(written: Written) -> Iterator[Finding]:
    """Of words: that those of a step are the system's, and that each row of a table follows from the row before it."""
    for section in written.sections:
        for cell, text in section.texts:
            for found in _STEP_IS.finditer(text):
                if said := _other_word(written, cell, int(found[1]), found[2], found[3]):
                    at = cell.line_of(found[0])
                    yield finding(written.at(cell, at), "word", step=found[1], word=found[3][:60], found=said[:60])
            yield from _counts_said(written, cell, text)
            yield from _rules_said(written, section, cell, text)
            yield from _rows(written, section, cell, text)


def _other_word(written: Written, cell: Cell, step: int, id: str | None, word: str) -> str:
    """What the word of a step is, if no system that is shown so far makes the one that is said."""
    if "…" in word or "..." in word:
        return ""
    wanted, found = bare(word), ""
    shown = [each.system for each in panels_of(written) if isinstance(each.system, LSystem)]
    before = [each.system for each in panels_of(written) if each.cell.number <= cell.number + 1 and each.system in shown]
    for system in reversed([each for each in (before or shown) if isinstance(each, LSystem)]):
        try:
            with limits(**BUDGET):
                made, later = map(str, derive(system, step + 1)[-2:])
        except LSystemError:
            return ""
        if bare(made) == wanted or is_random(system) or system.constants:
            return ""
        if not found and {*_LETTERS.findall(word)} <= {*_LETTERS.findall(f"{made} {later}")}:
            found = made
    return found


def other_words(rules: str, text: str) -> Iterator[tuple[int, str, str]]:
    """Of words of steps in a text without marks those that are another arrangement of what the rules make: both, and the step.

    >>> [*other_words("axiom: a\\na -> a b", "Step 1 is b a. Step 2 is a b b.")]
    [(1, 'b a', 'a b')]
    """
    for found in _STEP_BARE.finditer(text):
        with suppress(LSystemError), limits(**BUDGET):
            system = read_any(rules)
            if isinstance(system, LSystem) and not is_random(system):
                made = str(derive(system, int(found[1]))[-1])
                if made and bare(found[2]) != bare(made) and {*bare(found[2])} <= {*bare(rules)} - {*"->:"}:
                    yield int(found[1]), found[2], made


def _counts_said(written: Written, cell: Cell, text: str) -> Iterator[Finding]:
    """Counts of a step that are nearly those of a system, and sums in words that come to something else."""
    for found in _COUNT.finditer(text):
        if (made := _count_made(written, int(found[1]), found[2], int(found[3].replace(",", "")))) is not None:
            where = written.at(cell, cell.line_of(found[0]))
            yield finding(where, "count", step=found[1], given=found[3], found=f"{made:,}")
    for found in _SUM.finditer(text):
        one, two, both = (int(each.replace(",", "")) for each in found.groups())
        if one + two != both:
            said = {"left": f"{found[1]} + {found[2]}", "sign": "=", "right": found[3], "value": one + two}
            yield finding(written.at(cell, cell.line_of(found[0])), "calculation", **said)


def _count_made(written: Written, step: int, id: str | None, given: int) -> int | None:
    """A count of a step of a system that is shown, or named, where what is said is nearly that, and no count at all."""
    near = None
    for system in [_named(id)] if id else [each.system for each in panels_of(written)]:
        if isinstance(system, LSystem) and not system.constants:
            with suppress(LSystemError), limits(**BUDGET):
                counts = growth(system).counts(step)
                for count in (*counts, sum(counts)):
                    if count == given:
                        return None
                    near = count if nearly(str(given), str(count)) else near
    return near


def _named(id: str) -> AnySystem | None:
    """A system of the catalogue."""
    with suppress(LSystemError):
        return catalogued(id)
    return None


def _rules_said(written: Written, section: Section, cell: Cell, text: str) -> Iterator[Finding]:
    """Rules that a text says of a system, and that are other ones of the same symbol there."""
    for found in (each for pattern in _RULES_SAID for each in pattern.finditer(text)):
        shown = [each.system for each in panels_of(written) if each.cell in section.code]
        systems = [_named(found[1])] if found[1] else shown
        there = {(left, bare(right)): right for system in systems for left, right in _rules_of(system)}
        right = next((each for (left, _), each in there.items() if left == found[2]), "")
        if right and (found[2], bare(found[3])) not in there:
            said = {"rule": f"{found[2]} -> {found[3]}", "right": f"{found[2]} -> {right}"}
            yield finding(written.at(cell, cell.line_of(found[0])), "rule_said", **said)


def _rules_of(system: AnySystem | None) -> list[tuple[str, str]]:
    """The rules of a system without numbers and contexts: their left and right sides."""
    return _RULE_LINE.findall(str(system)) if isinstance(system, LSystem) else []


def is_random(system: LSystem) -> bool:
    """Whether rules of a system are chosen by chance."""
    return any(rule.probability is not None for rule in system.rules)


def bare(word: str) -> str:
    """A word without blanks and the lines before its indices."""
    return re.sub(r"[\s_]", "", word)


def _rows(written: Written, section: Section, cell: Cell, text: str) -> Iterator[Finding]:
    """Rows of a table of words that do not follow from the rows before them by rules of the section."""
    header = _HEADER.search(text)
    if not header:
        return
    rules: dict[str, list[str]] = {}
    for found in _RULE.finditer(section.text):
        rules.setdefault(found[1], []).append(found[2])
    for each in panels_of(written):
        if each.cell in section.code and isinstance(each.system, LSystem) and not is_random(each.system):
            for left, right in _rules_of(each.system):
                rules.setdefault(left, []).append(right)
    if not rules:
        return
    table = text[header.start() :].partition("\n\n")[0]
    rows = [(int(found[1]), found[2], found[0]) for found in _ROW.finditer(table)]
    pairs = [(old, new) for old, new in pairwise(rows) if new[0] == old[0] + 1]
    wrong = [(old, new) for old, new in pairs if bare(new[1]) not in _next(old[1], rules)]
    for old, new in wrong:
        if 2 * len(wrong) <= len(pairs) or old[1] in rules:
            at = cell.line_of(new[2])
            yield finding(written.at(cell, at), "row", step=new[0], word=new[1][:60], before=old[1][:60])


def _next(old: str, rules: Mapping[str, Sequence[str]]) -> set[str]:
    """The words that follow from a word, when each symbol has one of its rules, without blanks."""
    spaced = " " in old or old in rules
    symbols = old.split() if spaced else [*old]
    known = list(dict.fromkeys(each for each in symbols if each in rules))
    choices = islice(product(*(dict.fromkeys(rules[each]) for each in known)), MOST_CHOICES)
    becomes = (dict(zip(known, choice, strict=True)) for choice in choices)
    return {bare("".join(each.get(symbol, symbol) for symbol in symbols)) for each in becomes}
