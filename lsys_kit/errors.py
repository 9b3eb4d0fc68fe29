"""What went wrong, where it went wrong, and what to try.

Every mistake in a model, an answer or a command is reported by one of the classes below. Their text is
written for the person who made the mistake: it names the place (line and column, counted from 1), shows the line with a
caret under the place, and suggests what to try. Faults of the kit itself are never wrapped in these classes.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Collection, Iterable
from itertools import islice
from numbers import Integral
from reprlib import Repr
from typing import Self

_LINE = 80
"""The most characters of a name or a value in a message."""

FARTHEST = 10**18
"""The greatest number of a step, or of anything that is counted."""
PLACE = "line {line}, column {column}"
"""Where a mistake is, in a text."""
_translated: list[Callable[..., str]] = [str.format]
"""What writes that in the language that is chosen; languages are below this room, and say so themselves."""
_retold: list[Callable[[str], str]] = [str]
"""What says a whole message, or a hint, in that language."""
_LONGEST = 20_000
"""The most characters of a message."""


def speak_by(translated: Callable[..., str], retold: Callable[[str], str]) -> None:
    """Write places by a function that translates texts, messages by one that finds out first what text they are of."""
    _translated[:], _retold[:] = [translated], [retold]


class LSystemError(Exception):
    """A mistake in a model, an answer or a command, explained to the person who made it.

    Parameters
    ----------
    message
        What is wrong, one sentence without its full stop.
    source
        The text that has the mistake, if there is one.
    start, end
        The offsets in `source` between which the mistake is.
    hint
        What to try, whole sentences.

    Attributes
    ----------
    line, column, end
        The place, counted from 1; `end` is the column after the mistake. None where no text is at fault.
    span
        The offsets in `source` between which the mistake is, on one line; None where no text is at fault.

    Examples
    --------
    >>> print(LSystemError('A single "=" cannot be used here', "t = 1", 2, 3, 'To compare two values, type "==".'))
    A single "=" cannot be used here (line 1, column 3). To compare two values, type "==".
      t = 1
        ^
    """

    def __init__(
        self, message: str, source: str | None = None, start: int | None = None, end: int | None = None, hint: str | None = None
    ) -> None:
        self.message = _printable_text(_retold[0](message))
        self.hint = None if hint is None else _printable_text(_retold[0](hint))
        self._locate(source, start, end)
        super().__init__(self._text())

    def _locate(self, source: str | None, start: int | None, end: int | None) -> None:
        self.source = source
        self.line: int | None = None
        self.column: int | None = None
        self.end: int | None = None
        self.span: tuple[int, int] | None = None
        if source is not None and start is not None:
            start = min(start, len(source))
            line_start = source.rfind("\n", 0, start) + 1
            line_end = source.find("\n", start)
            line_end = len(source) if line_end < 0 else line_end
            self.line = source.count("\n", 0, start) + 1
            self.column = start - line_start + 1
            self.end = max(min(line_end, end or start + 1) - line_start + 1, self.column + 1)
            self.span = start, line_start + self.end - 1

    def moved(self, source: str, start: int, end: int) -> Self:
        """The same error at another place, perhaps in another text."""
        self._locate(source, start, end)
        self.args = (self._text(),)
        return self

    def with_hint(self, hint: str) -> Self:
        """The same error with another hint."""
        self.hint = _printable_text(_retold[0](hint))
        self.args = (self._text(),)
        return self

    def _text(self) -> str:
        where = f" ({_translated[0](PLACE, line=self.line, column=self.column)})" if self.line else ""
        text = (
            f"{self.message}{where}" + "." * (where != "" or self.message[-1:] != "?") + (f" {self.hint}" if self.hint else "")
        )
        return text + self._quotation()

    def _quotation(self) -> str:
        """The line at fault with a caret under the place; a window of it where the line is long."""
        if self.source is None or self.line is None or self.column is None or self.end is None:
            return ""
        line = self.source.split("\n")[self.line - 1].removesuffix("\r")
        first = max(0, self.column - 60)
        shown = "".join(map(printable, line[first : first + 100])).rstrip()
        carets = "^" * max(1, min(self.end - self.column, len(shown) - (self.column - 1 - first)))
        return f"\n  {shown}\n  {' ' * (self.column - 1 - first)}{carets}"

    def _render_traceback_(self) -> list[str]:
        """What a notebook shows: the message alone, for a mistake in a model is not a fault of a program."""
        return [f"{type(self).__name__}: {self}"]


class ModelSyntaxError(LSystemError):
    """The text cannot be read in its notation."""


class ModelNameError(LSystemError):
    """A name is unknown: no parameter, constant, function, system or option has it."""


class ModelValueError(LSystemError):
    """A value is not possible: a number where a truth is needed, a division by zero.

    Attributes
    ----------
    partial
        What was finished before: the derivation of the steps before the one that fails, or None.
    """

    partial: object = None


class ModelLimitError(LSystemError):
    """Something would grow past a limit (see `limits`).

    Attributes
    ----------
    limit, needed
        The limit and what would have been needed, in the unit that the message names.
    partial
        What was finished before: the derivation of the steps that fit, or None.
    """

    def __init__(
        self,
        message: str,
        *,
        limit: float,
        needed: float | None = None,
        partial: object = None,
        hint: str | None = None,
        source: str | None = None,
        start: int | None = None,
        end: int | None = None,
    ) -> None:
        self.limit, self.needed, self.partial = limit, needed, partial
        super().__init__(message, source, start, end, hint)


class ModelFileError(LSystemError):
    """A file does not exist, cannot be read, or may not be written."""


def require(value: object, kind: type | tuple[type, ...], what: str) -> None:
    """Refuse a value of another type than a function is for; `what` says what it is for.

    >>> require("F+F", int, "A number of steps")
    Traceback (most recent call last):
    lsys_kit.errors.ModelValueError: A number of steps is needed, not str.
    """
    if not isinstance(value, kind):
        raise ModelValueError(f"{what} is needed, not {type(value).__name__}")


def last_reached(refused: int) -> str:
    """How far one comes where a step is refused, as a sentence; nothing can be said of step 0.

    >>> last_reached(3)
    'Step 2 is the last that can be reached.'
    """
    return f"Step {refused - 1} is the last that can be reached." if refused else ""


def whole_number(given: object, what: str) -> int:
    """A whole number from 0 on, of any type that counts; anything else is refused.

    >>> whole_number(-1, "The step")
    Traceback (most recent call last):
    lsys_kit.errors.ModelValueError: The step must be a whole number from 0 on, not -1.
    """
    if isinstance(given, bool) or not isinstance(given, Integral) or int(given) < 0:
        raise ModelValueError(f"{what} must be a whole number from 0 on, not {shown(given)}")
    if int(given) > FARTHEST:
        raise ModelValueError(f"{what} must be at most {FARTHEST:,}, not {shown(given)}")
    return int(given)


def every(values: Iterable[object], kind: type | tuple[type, ...], what: str) -> None:
    """Refuse what is no collection of values of a type, and a value of another type among them.

    >>> every([1, "a"], int, "A whole number")
    Traceback (most recent call last):
    lsys_kit.errors.ModelValueError: A whole number is needed, not str.
    """
    require(values, Collection, "A list")
    for value in values:
        require(value, kind, what)


def printable(character: str) -> str:
    """The character, or a blank or question mark for one that is invisible or reverses the text.

    >>> printable("a"), printable("\\u202e"), printable("\\t")
    ('a', '?', ' ')
    """
    if character == "\t":
        return " "
    return character if character.isprintable() else "?"


def _printable_text(text: str) -> str:
    """A text with its lines, without characters that are invisible or reverse it, and cut off where it is far too long."""
    text = text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."
    return "\n".join("".join(map(printable, line)) for line in text.split("\n"))


def quotable(name: str) -> str:
    """A name as a message quotes it: no longer than a line, and all of it printable.

    >>> quotable("plant.svg"), quotable("a\\nb")
    ('plant.svg', 'a?b')
    """
    return "".join(map(printable, name if len(name) <= _LINE else f"{name[:_LINE]}..."))


class _Beginning(Repr):
    """As much of a representation as fills a line: what is left out is never written, and nothing is put in order."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 3
        self.maxlist = self.maxtuple = self.maxset = self.maxfrozenset = self.maxdeque = self.maxarray = _LINE // 2

    def repr_str(self, value: str | bytes, _: int) -> str:
        return repr(value[: _LINE + 1])

    repr_bytes = repr_str

    def repr_dict(self, value: dict[object, object], level: int) -> str:
        some = islice(value.items(), _LINE // 4) if level else ()
        return f"{{{', '.join(f'{self.repr1(key, level - 1)}: {self.repr1(each, level - 1)}' for key, each in some)}}}"

    def repr_int(self, value: int, _: int) -> str:
        return repr(value)

    def repr_instance(self, value: object, _: int) -> str:
        return repr(value)


def shown(value: object) -> str:
    """Any value as a message shows it: no longer than a line.

    >>> shown("a"), shown(10**10_000), len(shown([0] * 10**6))
    ("'a'", 'a very large int', 83)
    """
    try:
        return quotable(_Beginning().repr(value))
    except ValueError:  # Python refuses to write numbers of thousands of digits
        return f"a very large {type(value).__name__}"
    except Exception:  # what others have made may raise anything when it is written
        return f"a value of type {type(value).__name__}"


def named(character: str) -> str:
    """A character as a message quotes it: itself where it is visible, with its Unicode name where it may mislead.

    >>> named("x"), named("\\u0445"), named("\\u202e")
    ('"x"', '"х" (CYRILLIC SMALL LETTER HA)', 'RIGHT-TO-LEFT OVERRIDE')
    """
    name = unicodedata.name(character, f"U+{ord(character):04X}")
    if not character.isprintable():
        return name
    return f'"{character}"' if character.isascii() else f'"{character}" ({name})'
