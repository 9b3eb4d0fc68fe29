"""Checks of what a text says of other things: words twice, headings, lessons that there are, sections of the teacher's page,
turns, counts and words of steps as the systems of the lesson make them."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import lru_cache
from itertools import combinations

from lsys_kit.budget import limits
from lsys_kit.classroom.authoring.computed import bare, is_random
from lsys_kit.classroom.authoring.finding import Finding, finding
from lsys_kit.classroom.authoring.panels import Panel, panels_of
from lsys_kit.classroom.authoring.written import Cell, Written, numbers_in
from lsys_kit.classroom.catalogue import cellwork_systems, map_systems, systems
from lsys_kit.classroom.exercises.check import BUDGET
from lsys_kit.classroom.lessons.lesson import LETTERS
from lsys_kit.classroom.places import kit_place
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem, read_any

_TWICE = re.compile(r"(?<![\w'’-])([^\W\d_]{2,20}+) ++\1(?![\w'’-])", re.IGNORECASE)
_MEANT_TWICE = frozenset(["that", "had", "die", "der", "das", "sie", "ihr"])
_HEADING = re.compile(r"^(#{1,6}) ++(.*)$", re.MULTILINE)
_LESSON = re.compile(r"\blessons? (\d{1,3})\b")
_GIVES_AWAY = re.compile(
    r"\b(?:right|correct)(?: answer| one| option)? (?:is|was|would be) \**([A-F])\b"
    r"|\b([A-F])\** (?:is|was) (?:the )?(?:right|correct)\b"
)
_PART = re.compile(
    r"\b(predictions?|tables?|(?:first |second )?votes?) in (?:the )?sections? ((?:\d{1,2}(?:, and |, | and )?){1,20})"
)
_ASKS = {"prediction": "predict", "table": "worksheet", "vote": "vote"}
_TURNS = re.compile(r"`[+-]`[^.\n`]{0,60}\bturns?\b[^.\n]{0,40}? (\d{1,3}(?:\.\d)?) degrees")
_HAS = re.compile(
    r"\b[Ss]tep (\d{1,2}) has (\d[\d,]{0,9}|[a-z]{3,9}) (?:cells|symbols|letters|modules|buds|tips|strokes|pieces)\b"
)
_ID = re.compile(r"`(([A-Z]{1,2})\d{1,3}[a-z]?)`")
_HOW_MANY = re.compile(
    r"[Hh]ow many (?:[^\W\d_]{1,20} ){0,4}?(?:has|have) (?:the word of )?steps? (\d{1,2}(?:(?:, and |, | and )\d{1,2}){0,20})\?"
)
_OLD_WORD, _NEW_WORD = (re.compile(rf"\b{which} `([^`\n]{{1,200}})`") for which in ("the word", "(?:new|next) word is"))
_SPAN_RULE = re.compile(r"`([^`\n]{1,80} -> [^`\n]{1,120})`")
_ROW = re.compile(r"^\| *(\d{1,3}) *\| *`([^`|\n]{1,300})` *\|", re.MULTILINE)
MOST_TYPES, FEWEST_ROWS = 8, 4
"""Sums of the counts of so many symbols are looked at; so many rows of words are the words of a system."""


def wording_findings(written: Written) -> Iterator[Finding]:
    """Of words that stand twice, of headings that leave out a level, and of lessons that there are not."""
    kits, before = {int(name[:2]) for name in kit_place().names()}, 1
    for cell in written.cells:
        for found in _TWICE.finditer(re.sub("\n", " ", cell.plain)):
            if found[1].casefold() not in _MEANT_TWICE:
                yield finding(written.at(cell, cell.source[: found.start()].count("\n") + 1), "twice", word=found[0])
        for heading in () if cell.is_code else _HEADING.finditer(cell.source):
            if len(heading[1]) > before + 1:
                at = written.at(cell, cell.line_of(heading[0]))
                yield finding(at, "level", heading=heading[2][:60], level=len(heading[1]), before=before)
            before = len(heading[1])
        for found in _LESSON.finditer(cell.plain):
            if int(found[1]) not in kits:
                yield finding(written.at(cell, cell.line_of(found[0])), "no_lesson", number=found[1], most=max(kits))
    yield from _no_systems(written)


def _no_systems(written: Written) -> Iterator[Finding]:
    """Of what is named as the systems of the catalogue are, and is nothing else in this lesson: that it is one of them."""
    known = {*systems(), *map_systems(), *cellwork_systems()}
    families = {re.split(r"\d", each)[0] for each in known}
    everything = "\n".join(cell.source for cell in written.cells)
    for cell in () if written.lesson is None else written.cells:
        for found in () if cell.is_code else _ID.finditer(cell.source):
            elsewhere = re.search(rf"(?<!`)\b{found[1]}\b|\b{found[1]}\b(?!`)", everything)
            if found[1] not in known and found[2] in families and not elsewhere:
                hint = suggestion(found[1], known) or ""
                yield finding(written.at(cell, cell.line_of(found[0])), "no_system", id=found[1], hint=hint)


def reply_findings(written: Written) -> Iterator[Finding]:
    """Of replies to wrong options: that they do not say which one is right."""
    vote = written.lesson.vote if written.lesson else None
    right = next((LETTERS[at] for at, each in enumerate(vote.options) if each.right), "") if vote else ""
    for at, each in enumerate(vote.options if vote else ()):
        if not each.right and any(right in found.groups() for found in _GIVES_AWAY.finditer(each.reply)):
            yield finding(written.declared_line(each.reply[:40]), "gives_away", letter=LETTERS[at], right=right)


def place_findings(written: Written) -> Iterator[Finding]:
    """Of the sections in which the teacher's page says that something is asked."""
    numbered = {cell.number: section.number for section in written.sections for cell in section.code}
    for found in _PART.finditer(re.sub("\n", " ", written.teacher)):
        what = found[1].split()[-1].removesuffix("s")
        there = {numbered.get(call.cell.number) for call in written.calls if call.function == _ASKS[what]}
        there |= {each.number for each in written.sections if what == "table" and "\n|--" in each.text}
        for number in re.findall(r"\d+", found[2]):
            if int(number) not in there:
                where = written.teacher_at(found[0][:15])
                yield finding(where, "no_such_call", what=what, number=number)


def system_findings(written: Written) -> Iterator[Finding]:
    """Of turns, counts and words of steps: that a system of the lesson, or of the section, makes them."""
    angles = {each.system.angle for each in panels_of(written) if isinstance(each.system, LSystem)}
    for section in written.sections:
        here = [each for each in panels_of(written) if each.cell in section.code]
        for cell, text in section.texts:
            for found in _TURNS.finditer(re.sub("\n", " ", text)):
                if angles and float(found[1]) not in map(float, angles):
                    known = ", ".join(f"{float(each):g}" for each in sorted(angles))
                    yield finding(written.at(cell, cell.line_of(f"{found[1]} degrees")), "turn", given=found[1], known=known)
            yield from _has(written, cell, text, here)
            yield from _table_of(written, cell, text, here)
            for found in _NEW_WORD.finditer(text):
                before = section.text[: section.text.find(found[0])]
                old = [*_OLD_WORD.finditer(text[: found.start()])]
                made = _one_step(before, old[-1][1]) if old else ""
                if made and bare(made) != bare(found[1]):
                    at = written.at(cell, cell.line_of(found[0]))
                    yield finding(at, "new_word", word=found[1][:60], old=old[-1][1][:60], found=made[:60])


def counted_findings(written: Written) -> Iterator[Finding]:
    """Of predictions of how many there are in some steps: that symbols of a system that is shown then are so many."""
    declared = {each.question: each for each in written.lesson.predictions} if written.lesson else {}
    for call in written.calls:
        each = declared.get(written.question_of(call) or "") if call.function == "predict" else None
        asked = _HOW_MANY.search(each.question) if each else None
        changed = {node.arg for node in ast.walk(call.node) if isinstance(node, ast.keyword)}
        shown = [panel.system for panel in panels_of(written) if panel.cell == call.cell]
        if each is None or asked is None or any(isinstance(one, LSystem) and {*one.constants} & changed for one in shown):
            continue
        steps, given = [int(step) for step in re.findall(r"\d+", asked[1])], [*numbers_in(each.answer).values()]
        known = {
            int(found[1]): int(number) for found in _HAS.finditer(each.question) for number in numbers_in(found[2]).values()
        }
        said = known | {step: int(number) for step, number in zip(steps, given, strict=False)}
        if shown and len(steps) == len(given) and not any(_fits(system, said) for system in shown):
            made = f"{_length(shown[0], steps[-1])} symbols in all"
            yield finding(
                written.declared_line(each.question[:40]), "count", step=steps[-1], given=each.answer[:60], found=made
            )


def _one_step(text: str, word: str) -> str:
    """What becomes of a word in one step by the rules in a text, if they are all that is needed."""
    rules = dict.fromkeys(_SPAN_RULE.findall(text))
    with suppress(LSystemError), limits(**BUDGET):
        system = read_any("\n".join([f"axiom: {word}", *rules]))
        if rules and isinstance(system, LSystem) and not system.constants and not is_random(system):
            return str(derive(system, 1)[-1])
    return ""


def _has(written: Written, cell: Cell, text: str, here: Sequence[Panel]) -> Iterator[Finding]:
    """ "Step 10 has 12 cells" where no sum of symbols in that step of a system of the section is 12."""
    for found in _HAS.finditer(re.sub("\n", " ", text)):
        given = next(iter(numbers_in(found[2]).values()), None)
        step = int(found[1])
        if given is not None and here and not any(_fits(each.system, {step: int(given)}) for each in here):
            at = written.at(cell, cell.line_of(f"{found[2]} "))
            made = f"{max(_length(each.system, step) for each in here)} symbols in all"
            yield finding(at, "count", step=found[1], given=found[0].split(" has ")[1], found=made)


def _fits(system: AnySystem | None, said: Mapping[int, int]) -> bool:
    """Whether some of the symbols of a system are so many in those steps, or that is not known."""
    counts = {step: _counts(system, step) for step in said}
    types = dict.fromkeys(each for found in counts.values() for each in found)
    if not all(counts.values()) or len(types) > MOST_TYPES:
        return True
    chosen = (some for many in range(len(types) + 1) for some in combinations(types, many))
    return any(all(sum(counts[step].get(each, 0) for each in some) == many for step, many in said.items()) for some in chosen)


def _length(system: AnySystem | None, step: int) -> int:
    return sum(_counts(system, step).values())


@lru_cache(maxsize=64)
def _counts(system: AnySystem | None, step: int) -> Mapping[str, int]:
    """How many there are of each symbol of a step, without their indices; nothing where that is not known."""
    with suppress(LSystemError), limits(**BUDGET):
        if isinstance(system, LSystem) and not is_random(system):
            return Counter(re.sub(r"_.*", "", str(each.symbol)) for each in derive(system, step)[-1])
    return {}


def _table_of(written: Written, cell: Cell, text: str, here: Sequence[Panel]) -> Iterator[Finding]:
    """Rows of a table of words that are not those of a system of the section, whose words most of the others are."""
    rows = [(int(found[1]), found[2]) for found in _ROW.finditer(text) if "…" not in found[2] and "..." not in found[2]]
    if len(rows) < FEWEST_ROWS:
        return
    for system in {each.system: None for each in here if isinstance(each.system, LSystem) and not is_random(each.system)}:
        made: list[str] = []
        with suppress(LSystemError), limits(**BUDGET):
            made = [str(each) for each in derive(system, max(step for step, _ in rows))]
        wrong = [(step, word) for step, word in rows if made and bare(word) != bare(made[step])]
        for step, word in wrong if len(rows) - len(wrong) > 2 * len(wrong) else ():
            at = written.at(cell, cell.line_of(f"`{word}`"))
            yield finding(at, "word", step=step, word=word[:60], found=made[step][:60])
