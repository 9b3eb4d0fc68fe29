"""A system as a text in a notation: read, and written so that it reads back.

A notation can express a system if, and only if, what it writes reads back as the same system; so every text is read before it
is given away. What a notation lacks as a whole is named before: a feature (`Dialect.lacks`), or a symbol.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace

from lsys_kit.budget import Task
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.notation.analysis.lint import check_decomposition, warnings
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import END, Pattern, joined
from lsys_kit.notation.model.system import LOOK, LSystem
from lsys_kit.notation.syntax.builder import Draft
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.formatting import first_missing
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.text.statements import bounded
from lsys_kit.notation.syntax.text.transcript import Transcript
from lsys_kit.notation.syntax.wording import notes, reporting

_LONGEST = 60
"""So many characters of what cannot be written are quoted."""


def system_in(notation: Dialect, text: str, name: str | None = None) -> LSystem:
    """The system that a text in a notation describes; with a name, the one of several."""
    with Task("The model was not read"):
        transcript = notation.transcribe(notation.entry(text, name))
        system = _built(notation, transcript)
        return replace(system, notes=(*transcript.notes, *system.notes, *notes(warnings(system), notation.spelling)))


def text_in(notation: Dialect, system: LSystem) -> str:
    """The text of a system in a notation; what reads back is the system, or what the notation translates it to.

    Raises
    ------
    ModelValueError
        The notation lacks something that the system needs.
    ModelLimitError
        The text is longer than what is read.
    """
    with Task("The model was not written"):
        missing = lacking(notation, system)
        if missing:
            without = (
                f'They are left out by write(system, "{notation.name}", interpretation=False), '
                "and in a shell by --no-interpretation."
            )
            raise ModelValueError(
                f"The notation {notation.name} has no {missing}, which this system needs",
                hint=without if missing == "interpretation rules" else None,
            )
        system = notation.translated(system)
        text = notation.write(system)
        lost = _lost(notation, system, text)
        if lost:
            raise ModelValueError(f"The notation {notation.name} has no way to write {lost}, which this system needs")
        return text


def lacking(notation: Dialect, system: LSystem) -> str | None:
    """The first thing that a system has and a notation lacks, in words: a feature or a symbol."""
    system = notation.translated(system)
    missing = first_missing(system, *notation.lacks) or notation.missing_feature(system)
    return missing or next(_strange_symbols(notation, system), None)


def _built(notation: Dialect, transcript: Transcript) -> LSystem:
    """The system of a text that is written as its notation's grammar has it."""
    text = transcript.text
    draft = Draft(text, notation.name, notation.turtle)
    try:
        with reporting(text, notation.spelling):
            for start, end in bounded(notation.statements(text), text):
                kind, record = parse(notation, "statement", text, start, end)
                draft.add(kind, record, (start, end))
            system = notation.finish(draft)
            check_decomposition(system)
    except LSystemError as error:
        raise transcript.relocated(error) from None
    return system


def _strange_symbols(notation: Dialect, system: LSystem) -> Iterator[str]:
    """The symbols of a system, with the number of their values, whose text is not read as that symbol."""
    ends = {id(module) for rule in system.rules for module in rule.right if module.symbol == END}
    listed = (Pattern(symbol) for symbol in (*system.ignored, *system.considered))
    modules = (module for module in (*system.modules, *listed) if id(module) not in ends)
    for symbol, count in dict.fromkeys((module.symbol, len(module.arguments)) for module in modules):
        if not _reads_back(notation, Pattern(symbol, (Number(1),) * count)):
            values = "a value" if count == 1 else f"{count} values"
            yield f'symbol "{symbol}"' + f" with {values}" * _reads_back(notation, Pattern(symbol))


def _reads_back(notation: Dialect, module: Pattern) -> bool:
    text = notation.module(module)
    try:
        return bool(parse(notation, "word", text, 0, len(text)) == (module,))
    except ModelLimitError:
        raise
    except LSystemError:
        return False


def _lost(notation: Dialect, system: LSystem, text: str) -> str | None:
    """The first part of a system that does not read back from its text; None where all of it does."""
    try:
        back = _built(notation, notation.transcribe(notation.entry(text, None)))
    except ModelLimitError:
        raise
    except LSystemError as error:
        return _quoted(text.split("\n")[error.line - 1]) if error.line else "a part of it"
    compared = (
        (part.name, getattr(system, part.name), getattr(back, part.name))
        for part in fields(system)
        if part.compare or part.name in LOOK
    )
    return next((_different(*parts) for parts in compared if parts[1] != parts[2]), None)


def _different(name: str, wanted: object, found: object) -> str:
    """What differs between an attribute of a system and the same as it reads back."""
    if not isinstance(wanted, tuple):
        return _quoted(f"{name.replace('_', ' ')}: {wanted}")
    others = found if isinstance(found, tuple) else ()
    if name == "axiom":
        return _quoted(f"axiom: {joined(map(str, wanted))}")
    part = next((one for number, one in enumerate(wanted) if others[number : number + 1] != (one,)), None)
    return f"the {name} without {_quoted(str(others[-1]))}" if part is None else _quoted(str(part))


def _quoted(text: str) -> str:
    return f'"{text.strip()[:_LONGEST]}{"..." if len(text.strip()) > _LONGEST else ""}"'
