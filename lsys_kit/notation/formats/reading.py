"""A text in a format that is no notation of the kit, read: which format it is in, and the system that it gives.

Each format finds passages in a text; what it finds is written in the kit's notation and read as such. The formats are asked in
their order, from the one that is surest of its texts to the list of a page; the first that finds an axiom and rules is taken.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache

from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError, quotable
from lsys_kit.notation.dialects.abop.dialect import ABOP
from lsys_kit.notation.foreign import foreign_format
from lsys_kit.notation.formats.found import Found, completed, tables, transcript_of, undrawn_digits
from lsys_kit.notation.formats.l_py import systems_in_l_py
from lsys_kit.notation.formats.layout import is_markdown, page_text
from lsys_kit.notation.formats.lines import has_unread_words, is_other, is_prose, systems_in_lines
from lsys_kit.notation.formats.literals import systems_in_literals
from lsys_kit.notation.formats.lparser import systems_in_lparser
from lsys_kit.notation.formats.markup import systems_in_markup
from lsys_kit.notation.formats.pages import listings_on_a_page
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.syntax.systems import system_in
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, as_typed, edited
from lsys_kit.notation.syntax.text.typography import keyboard_signs


@dataclass(frozen=True, kw_only=True)
class Format:
    """A format in which systems stand on pages, in programs and files.

    Attributes
    ----------
    name
        Its name in `read(text, name)`.
    title
        What it is called in a sentence: "Read as a list of variables and rules, as encyclopaedias have it."
    prepared
        A text as its systems are looked for in it.
    systems
        The systems in such a text.
    """

    name: str
    title: str
    prepared: Callable[[str], Transcript]
    systems: Callable[[Transcript], Sequence[Found]]


def _without_marks(source: str) -> Transcript:
    """A text as it would be typed, without the marks of a page."""
    return page_text(keyboard_signs(source))


_PROMPTS = re.compile(
    r"^[ \t]*(?:In[ ]?\[\d*\]:?=?|>>>|>(?=[ ])|\.\.\.(?=[ ])|\.\.\.:)[ \t]?|^[ \t]*Out[ ]?\[\d*\][:=].*$", re.MULTILINE
)
"""What an interactive session shows before what is typed, and its answers."""


def _without_prompts(source: str) -> Transcript:
    before = keyboard_signs(source)
    prompts = [Edit(*match.span(), "") for match in _PROMPTS.finditer(before.text)]
    return edited(before, prompts) if prompts else before


_PREMISE = re.compile(r"^[ \t]*+premise[ \t]*+[:=]?+[ \t]*+[^\s\"':=]", re.MULTILINE | re.IGNORECASE)
"""Houdini's axiom: in its words a quotation mark is a command."""
DATA = Format(
    name="data",
    title="data, as in JSON or in the literals of a program",
    prepared=_without_prompts,
    systems=lambda before: [] if is_markdown(before.text) or _PREMISE.search(before.text) else systems_in_literals(before.text),
)
PAGE = Format(
    name="page",
    title="a listing on a page of a book, without what is around it",
    prepared=_without_marks,
    systems=lambda before: listings_on_a_page(before.text),
)
LIST = Format(
    name="list",
    title="a list of variables and rules, as encyclopaedias have it",
    prepared=_without_marks,
    systems=lambda before: systems_in_lines(before.text, before.source),
)
FORMATS: Mapping[str, Format] = {
    each.name: each
    for each in (
        Format(name="xml", title="XML", prepared=as_typed, systems=lambda before: systems_in_markup(before.text)),
        Format(
            name="l-py", title="a model of L-Py", prepared=keyboard_signs, systems=lambda before: systems_in_l_py(before.text)
        ),
        Format(
            name="lparser",
            title="a file of LParser",
            prepared=keyboard_signs,
            systems=lambda before: systems_in_lparser(before.text),
        ),
        DATA,
        PAGE,
        LIST,
    )
}
"""The formats that are read besides the kit's notations, in the order in which they are asked."""

LONGEST = 100_000
"""In longer texts no systems are looked for."""
_CODE = re.compile(
    r"^[ \t]*(?:(?:def|class|for|while|elif|function|async|#macro|#while)\b[^\n]*[({:]"
    r"|if\b[ \t]*[(\w][^\n]*[{:\[]|to-report[ ]\w)"
    r"|\bfunction\b[ \t]*\w*\(|\)[ \t]*=>[ \t]*\{|^[ \t]*(?:void|int|String|float)[ \t]+\w+\([^()\n]*\)[ \t]*\{",
    re.MULTILINE,
)
"""What only programs have."""


_BARE_RULE = re.compile(r"^[^\n\"'/#;%*]*?(?<!\w)[A-Za-z][ \t]*+(?:->|→)[ \t]*+[A-Za-z+\-\[]", re.MULTILINE)
"""A rule whose words are in no quotation marks."""


def read_found(text: str, name: str | None = None) -> LSystem | None:
    """The system of a text in the first format that finds one in it; None where none does.

    Raises
    ------
    ModelSyntaxError, ModelNameError, ModelValueError
        What was found makes no sense, or there are several systems, and none is named; or it stands in a program.
    """
    if len(text) > LONGEST:
        return None
    failed: LSystemError | None = None
    rules = 0
    for form in FORMATS.values():
        before, systems = _found(form, text)
        most = max((len(found.rules) for found in systems), default=0)
        quoted = form is DATA and len(systems) == 1 and (systems[0].assumed or _BARE_RULE.search(before.text))
        if quoted and len(others := _found(LIST, text)[1]) == 1 and len(others[0].rules) > most and others[0].axiom:
            continue  # some words alone are in quotation marks
        if any(found.complete and not (found.assumed and most < rules) for found in systems):
            try:
                return _refusing_code(form, before, _system(form, before, _chosen(systems, text, name)))
            except LSystemError as error:
                if form is not PAGE:
                    program = foreign_format(text) if form is LIST and _CODE.search(before.text) else None
                    raise program or failed or error from None
                failed = error  # what is no listing of the book may be a list
        rules = max(rules, most)  # of which the first is no axiom
    if failed:
        raise failed
    return None


def what_is_missing(text: str) -> LSystemError | None:
    r"""What a text lacks in which no format finds a whole system: rules, an axiom, or everything; None where that is not known.

    >>> what_is_missing("Variables: F\nAxiom: F\nRules:\nAngle: 60°").message
    'There is no rule in this text'
    """
    if len(text) > LONGEST:
        return None
    before, systems = _found(LIST, text)
    if (
        len(systems) == 1
        and systems[0].axiom
        and not systems[0].rules
        and (_names_of("rules").search(before.text) or _UNREAD_RULE.search(before.text))
        and not has_unread_words(before.text)
    ):
        where = before.origin(systems[0].axiom[0].at)
        return ModelSyntaxError(
            "There is no rule in this text",
            text,
            where,
            None,
            'A rule reads "F -> F+F": what is replaced, an arrow, what replaces it.',
        )
    if len(systems) == 1 and systems[0].rules and not systems[0].axiom and not _names_of("axiom").search(before.text):
        hint = 'Give the first word on a line of its own, as in "axiom: A".'
        return ModelSyntaxError("There is no axiom", text, len(text), None, hint)
    nothing = is_prose(before.text) or (is_other(before.text) and not _names_of("axiom").search(before.text))
    return _nothing() if nothing else None


def _nothing() -> ModelValueError:
    return ModelValueError("There is no L-system in this text", hint='An L-system reads "axiom: F", and below "F -> F+F".')


@cache
def _names_of(kind: str) -> re.Pattern[str]:
    """The words by which a text speaks of a part, but those that are in any text."""
    words = [re.escape(word) for word in tables()["names"][kind] if len(word) > 4 and word not in _IN_ANY_TEXT]
    return re.compile(rf"(?<!\w)(?:{'|'.join(words)})(?!\w)", re.IGNORECASE)


_UNREAD_RULE = re.compile(r"^[ \t]*(?:rule|regel)[ \t]*[:=][ \t]*+(?=\S)", re.MULTILINE | re.IGNORECASE)
"""What is called a rule, and is none."""
_IN_ANY_TEXT = frozenset(("start", "initial", "sentence", "rotation", "degrees", "alpha"))
_DEGREES = re.compile(r"(?<![\w.])\d{1,3}(?:[.,]\d+)?[ ]?(?:°|degrees|deg\b)")


def read_as(form: Format, text: str, name: str | None = None) -> LSystem:
    """The system of a text in a format that somebody named.

    Raises
    ------
    ModelSyntaxError, ModelNameError, ModelValueError
        There is none, or it makes no sense.
    """
    before, systems = _found(form, text)
    return _refusing_code(form, before, _system(form, before, _chosen(systems, text, name)))


def _found(form: Format, text: str) -> tuple[Transcript, Sequence[Found]]:
    """A text as a format looks at it, and the systems that it finds there."""
    before = form.prepared(text)
    try:
        return before, [completed(found) for found in form.systems(before)]
    except LSystemError as error:
        raise before.relocated(error) from None


def _system(form: Format, before: Transcript, found: Found) -> LSystem:
    """The system of what was found."""
    transcript = transcript_of(found, before)
    spoken = _names_of("axiom").search(before.text) if found.assumed else None
    if spoken:
        raise ModelSyntaxError(
            "I cannot read this axiom",
            before.source,
            before.origin(spoken.start()),
            None,
            'Write it on a line of its own, as in "axiom: F".',
        )
    try:
        system = system_in(ABOP, transcript.text)
    except LSystemError as error:
        raise transcript.relocated(error) from None
    notes = system.notes if found.listing else (*_undrawn(found, system), *filter(_is_news, system.notes))
    return replace(system, notes=(f"Read as {form.title}{_said(found, system, before.text)}.", *transcript.notes, *notes))


_DRAWING = ("F", "G", "@", "~", "{")
"""How symbols begin that may draw."""


def _undrawn(found: Found, system: LSystem) -> Iterator[str]:
    """Notes on digits that are symbols, and on a system that turns and draws nothing."""
    if digits := undrawn_digits(found):
        yield digits
    if _turns(system) and not any(module.symbol.startswith(_DRAWING) for module in system.modules):
        symbol = found.rules[0].head.text[:1]
        yield f'Nothing in it draws a line: F does. Below "interpretation:", "{symbol} -> F" draws {symbol}.'


def _turns(system: LSystem) -> bool:
    """Whether something turns by the angle of the system."""
    return any(module.symbol in ("+", "-", "&", "^", "\\", "/") and not module.arguments for module in system.modules)


def _is_news(note: str) -> bool:
    """Whether a note of the kit's reader says what somebody would not expect who typed single symbols."""
    return " is read as " not in note and not note.startswith("The digits")


def _said(found: Found, system: LSystem, text: str) -> str:
    """What was found of the angle, if something turns by it."""
    if found.listing and re.search(r"angle|δ|delta", found.listing.text):
        return ""
    if found.angle and 0 < found.angle[0] < 4 and found.angle[0].denominator > 10:  # degrees, or perhaps radians
        return (
            f"; angle {float(found.angle[0]):g} in degrees; were it in radians, it would be {math.degrees(found.angle[0]):.5g}"
        )
    if found.angle:
        return f"; angle {float(found.angle[0]):g}"
    spoken = _names_of("angle").search(text) or _DEGREES.search(text)
    return "" if not _turns(system) else "; the angle cannot be read: it is 90" if spoken else "; no angle is given: it is 90"


def _refusing_code(form: Format, before: Transcript, system: LSystem) -> LSystem:
    """A system that stands in no program; what a program says of one is offered."""
    code = _CODE.search(before.text) if form is DATA else None
    if code is None:
        return system
    where = before.origin(code.start() + len(code[0]) - len(code[0].lstrip()))
    hint = f"Nothing that is given to the kit is run. What its literals say can be read: {' | '.join(str(system).splitlines())}"
    raise ModelSyntaxError("This is a program", before.source, where, None, hint)


def _chosen(systems: Sequence[Found], text: str, name: str | None) -> Found:
    """The system of a name, or the only one."""
    if not systems:
        raise _nothing()
    names = [each.name or str(number) for number, each in enumerate(systems, 1)]
    listed = ", ".join(map(quotable, names))
    if name is not None:
        found = next((each for each, other in zip(systems, names, strict=True) if other.lower() == name.lower()), None)
        if found is None and name != names[0]:
            raise ModelNameError(
                f'There is no system called "{quotable(name)}" in this text', hint=f"The systems are {listed}."
            )
        return found or systems[0]
    if len(systems) > 1:
        second = systems[1].axiom
        choose = (
            f'Choose one by its name: read(text, name="{quotable(names[0])}"), or --name in a shell. The systems are {listed}.'
        )
        raise ModelValueError(
            f"There are {len(systems)} systems in this text", text, second[0].at if second else None, None, choose
        )
    return systems[0]
