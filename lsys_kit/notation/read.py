"""Text to records: a system, a word or an expression, read in one of the notations.

A text is cut into statements, each is parsed by the grammar of its notation, and the records are checked. The grammars stand
beside this file, one for each notation, and `expressions.lark`, which they share.
"""

from __future__ import annotations

from dataclasses import replace

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.abop import ABOP
from lsys_kit.notation.arithmetic import Value
from lsys_kit.notation.checks import check_expression, check_word, value_of
from lsys_kit.notation.draft import Draft
from lsys_kit.notation.expressions import Expression
from lsys_kit.notation.foresight import check_decomposition, idle
from lsys_kit.notation.glued import unglued
from lsys_kit.notation.model import LSystem, Module, flat
from lsys_kit.notation.parsing import parse
from lsys_kit.notation.registry import notation_called, recognised


def read(text: str, notation: str | None = None) -> LSystem:
    """Read a system.

    Parameters
    ----------
    text
        The model: constants, axiom, productions, one a line. `/* ... */` is a comment.
    notation
        Its name; by default the notation of which the text shows most marks.

    Raises
    ------
    ModelSyntaxError, ModelNameError, ModelValueError
        The text makes no sense; the error has the place and a hint.
    ModelLimitError
        The text is too long.

    Examples
    --------
    >>> system = read('''
    ...     axiom: ar
    ...     ar -> al br
    ...     al -> bl ar
    ...     br -> ar
    ...     bl -> al''')
    >>> print(system.productions[0])
    ar -> al br
    """
    if not isinstance(text, str):
        raise ModelValueError(f"A model is read from text, not from {type(text).__name__}")
    if len(text) > current().text:
        raise ModelLimitError(f"The text has {len(text):,} characters; the limit is {current().text:,}",
                              limit=current().text, needed=len(text))
    chosen = notation_called(notation) if notation else recognised(text)
    draft = Draft(text, chosen.name, chosen.turtle)
    for number, (start, end) in enumerate(chosen.statements(text)):
        if number >= 2 * current().rules:
            raise ModelLimitError(f"The model has more than {2 * current().rules:,} lines that say something",
                                  limit=2 * current().rules, source=text, start=start)
        kind, record = parse(chosen, "statement", text, start, end)
        draft.add(kind, record, (start, end))
    system = chosen.finish(draft)
    check_decomposition(system)
    return replace(system, notes=(*system.notes, *idle(system)))


def read_word(text: str, notation: str = "abop", system: LSystem | None = None) -> tuple[Module, ...]:
    """Read a word whose arguments are numbers; with a system, letters written together are parted as in its rules.

    >>> [str(module) for module in read_word("A(1/2)[B]")]
    ['A(0.5)', '[', 'B', ']']
    """
    if not text.strip() or text.strip() in ("ε", "*"):
        return ()
    word = parse(notation_called(notation), "word", text, 0, len(text))
    check_word(word, (), text)
    if system is not None and notation == "abop":
        word, _ = unglued(word, system)
    return tuple(replace(module, arguments=tuple(value_of(a, text) for a in module.arguments if isinstance(a, Expression)))
                 for module in flat(word))


def read_expression(text: str) -> Expression:
    """Read an expression; its names are checked by whoever knows them.

    >>> print(read_expression("2*(t+1)"))
    2 * (t + 1)
    """
    return parse(ABOP, "expression", text, 0, len(text))  # type: ignore[no-any-return]


def read_number(text: str) -> Value:
    """Read a number, exactly; it may be written as a calculation.

    >>> read_number("14/10")
    Fraction(7, 5)
    """
    expression = read_expression(text)
    check_expression(expression, (), text)
    return value_of(expression, text)
