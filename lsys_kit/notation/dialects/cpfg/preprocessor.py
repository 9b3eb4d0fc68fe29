"""What the preprocessor of C makes of a cpfg text before cpfg reads it: macros put in place, conditions, comments.

A macro that is a number stays a line of the text, so that it becomes a constant, with a slider. Any other is put in place: a
part of a word, an expression of parameters, a macro with parameters. Nothing is executed; what grows too long is refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from typing import Any

from lsys_kit.budget import counted, current
from lsys_kit.errors import LSystemError, ModelLimitError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.analysis.checks import check_expression, value_of
from lsys_kit.notation.analysis.problems import ProblemFound
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import expression_type, is_random, names_in
from lsys_kit.notation.syntax.text.statements import ARROW, without_comments
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, as_typed, edited

Parse = Callable[[str, str], Any]
"""Parses a text as an "expression" or as a "word"."""
_NAME = re.compile(r"(?<!\w)[A-Za-z_]\w*")
_OBJECT = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)(?!\()", re.MULTILINE)
_LIKE_A_NUMBER = re.compile(r"-?[\d.(=]|[A-Za-z_]\w*+[ \t]*+[(*/+%^-]")
_RANDOM = re.compile(r"\b(?:n|b|bi)?ran\s*\(")
_OPENED, _INDEXED, _SIGNS = re.compile(r"\s*\("), re.compile(r"\s*\["), re.compile(r"[()\[\]{},]")
_ARRAY = re.compile(r"\b([A-Za-z_]\w*+)\s*+(?:\[[^\[\]{}]*+\]\s*+)?\[([^\[\]{}]*+)\]\s*+=\s*+\{([^{}]*+)\}")
_TWO = re.compile(r"\]\s*+\[")
_CHANGED = re.compile(r"\b([A-Za-z_]\w*+)\s*+(?:\[[^\[\]=]*+\]\s*+){1,2}=(?![={]|\s*\{)")
_SIZE = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)[ \t]+(\d{1,4})[ \t]*$", re.MULTILINE)
_LINE_COMMENT = re.compile(r"//[^\n]*")
_DIGITS = re.compile(r"[\d.,\s]+")
_PARAMETERS = re.compile(r"\(\s*+((?>(?:[A-Za-z_]\w*+\s*+(?:,\s*+)?)*))\)")


@dataclass(frozen=True)
class Macro:
    """A name and the text that is put in its place.

    Attributes
    ----------
    body
        The text.
    parameters
        Its parameters, where it is written with values in parentheses.
    elements
        The elements of an array that nothing changes; there is no other text.
    columns
        How many elements a row has, where the array has rows; 0 where it has none.
    """

    body: str
    parameters: tuple[str, ...] | None = None
    elements: tuple[str, ...] = ()
    columns: int = 0


class Macros:
    """The macros that are in force at some place of a text.

    Parameters
    ----------
    text
        The text, with its comments blanked.
    parse
        What reads an expression or a word.

    Examples
    --------
    >>> macros = Macros("A(BOX, twice(x))", lambda rule, text: None)
    >>> macros.table |= {"BOX": Macro("[+F]"), "twice": Macro("(2*t)", ("t",))}
    >>> [edit.text for edit in macros.edits(0, 16)]
    ['[+F]', '(2*x)']
    """

    def __init__(self, text: str, parse: Parse) -> None:
        self.text, self._parse = text, parse
        self.table: dict[str, Macro] = {}
        self.put: dict[str, None] = {}
        self._numbers = frozenset(_OBJECT.findall(text))
        self._spent = 0

    def is_text(self, body: str) -> bool:
        """Whether a macro is put in place: what can be read as a number is not, nor what was probably meant as one."""
        try:
            expression = self._parse("expression", body)
        except LSystemError:
            return self._is_word(body)
        names = names_in(expression)
        return is_random(expression) or bool(names - self._numbers) or not names.isdisjoint(self.table)

    def _is_word(self, body: str) -> bool:
        try:
            self._parse("word", body)
        except LSystemError:
            return _LIKE_A_NUMBER.match(body) is None
        return _DIGITS.fullmatch(body) is None

    def edits(self, start: int, end: int) -> Iterator[Edit]:
        """What is put in the places of the macros between two offsets."""
        at = start
        for found in _NAME.finditer(self.text, start, end) if self.table else ():
            call = self._call(self.text, found, frozenset(), found.start()) if found.start() >= at else None
            if call is not None:
                made, at = call
                yield Edit(found.start(), at, made)

    def expanded(self, text: str, at: int, hidden: frozenset[str] = frozenset()) -> str:
        """A text with its macros put in place; a macro is not put in place within itself."""
        if len(hidden) > current().depth:
            raise ModelSyntaxError(f"Macros are nested more than {current().depth} deep", self.text, at)
        parts: list[str] = []
        last = 0
        for found in _NAME.finditer(text):
            call = self._call(text, found, hidden, at) if found.start() >= last else None
            if call is not None:
                parts += (text[last : found.start()], call[0])
                last = call[1]
        return "".join((*parts, text[last:]))

    def _call(self, text: str, found: re.Match[str], hidden: frozenset[str], at: int) -> tuple[str, int] | None:
        """What is put in place of a name, and where what it stands for ends; None where the name is no macro's."""
        name, end = found.group(), found.end()
        macro = None if name in hidden else self.table.get(name)
        if macro is None:
            return None
        body = macro.body
        if macro.elements:
            opened = _INDEXED.match(text, end)
            if opened is None:
                return None
            given, end = self._values(text, opened.end(), at)
            elements = macro.elements
            if macro.columns:
                second = _INDEXED.match(text, end)
                if second is None:
                    return None
                column, end = self._values(text, second.end(), at)
                inner = self.expanded(",".join(column), at, hidden)
                rows = range(0, len(elements), macro.columns)
                elements = tuple(self._element(elements[row : row + macro.columns], inner, at) for row in rows)
            body = self._element(elements, self.expanded(",".join(given), at, hidden), at)
        elif macro.parameters is not None:
            opened = _OPENED.match(text, end)
            if opened is None:
                return None
            given, end = self._values(text, opened.end(), at)
            body = self._with_values(name, macro, [self.expanded(value, at, hidden) for value in given], at)
        self.put[name] = None
        self._spend(len(body) + 1, at)
        return self.expanded(body, at, hidden | {name}), end

    def _with_values(self, name: str, macro: Macro, values: list[str], at: int) -> str:
        parameters = macro.parameters or ()
        if len(values) != len(parameters) and (parameters or values != [""]):
            raise ModelSyntaxError(
                f"The macro {name}({','.join(parameters)}) is given {len(values)} "
                f"value{'s' * (len(values) != 1)}, not {len(parameters)}",
                self.text,
                at,
                at + len(name),
            )
        known = dict(zip(parameters, values, strict=False))
        self._spend(sum(len(known.get(found, "")) for found in _NAME.findall(macro.body)), at)
        return _NAME.sub(lambda found: known.get(found.group(), found.group()), macro.body)

    def _element(self, elements: tuple[str, ...], index: str, at: int) -> str:
        """What chooses an element; below the first and beyond the last it is the nearest, as in cpfg, which warns of that."""
        if _RANDOM.search(index):
            raise ModelValueError(
                "The index of an array cannot be random here",
                self.text,
                at,
                at + 1,
                'Make it the parameter of a module, as in "A --> B(ran(3))", and use that in the next step.',
            )
        if index.strip().isdecimal():
            return elements[min(int(index), len(elements) - 1)]
        self._spend(len(index) * len(elements), at)
        return _chosen(elements, 0, index)

    def _values(self, text: str, start: int, at: int) -> tuple[list[str], int]:
        """The values in the brackets behind a macro, and where they end."""
        depth, begun, values = 0, start, list[str]()
        for sign in _SIGNS.finditer(text, start, start + current().expression):
            if sign.group() == "," and not depth:
                values.append(text[begun : sign.start()].strip())
                begun = sign.end()
            elif sign.group() in ")]" and not depth:
                return [*values, text[begun : sign.start()].strip()], sign.end()
            else:
                depth += (sign.group() in "([{") - (sign.group() in ")]}")
        raise ModelSyntaxError("The values of this macro never end", self.text, at, at + 1, 'Every "(" needs a ")" after it.')

    def _spend(self, characters: int, at: int) -> None:
        self._spent += characters
        if self._spent > current().text:
            raise ModelLimitError(
                f"Macros make the text longer than {current().text:,} characters",
                limit=current().text,
                source=self.text,
                start=at,
            )


def _chosen(elements: tuple[str, ...], first: int, index: str) -> str:
    """The choice of one of some elements, the first of which has a number, by halves."""
    if len(elements) == 1:
        return f"({elements[0]})"
    half = len(elements) // 2
    left, right = _chosen(elements[:half], first, index), _chosen(elements[half:], first + half, index)
    return f"(({index}) < {first + half} ? {left} : {right})"


def arrays_in(text: str, plain: str) -> dict[str, Macro] | None:
    """The arrays that a definition makes, if all have their elements and nothing in a text changes them.

    >>> found = arrays_in("array a[3] = {1, 2, 3}, b[1][2]={4, 5};", "A(a[2])")
    >>> [(name, array.elements, array.columns) for name, array in found.items()]
    [('a', ('1', '2', '3'), 0), ('b', ('4', '5'), 2)]
    """
    text, sizes = _LINE_COMMENT.sub("", text), dict(_SIZE.findall(plain))
    found = {}
    for each in _ARRAY.finditer(text):
        elements = tuple(value.strip() for value in each[3].split(","))
        size = sizes.get(each[2].strip(), each[2].strip())
        columns = (int(size) if size.isdecimal() else -1) if _TWO.search(each[0]) else 0
        if columns < 0 or (columns and len(elements) % columns):
            return None
        found[each[1]] = Macro("", None, elements, columns)
    rest = re.sub(r"\barray\b|[\s,;]", "", _ARRAY.sub("", text))
    changed = any(name in found for name in _CHANGED.findall(plain))
    return None if rest or changed or not all(all(macro.elements) for macro in found.values()) else found


def macro_of(name: str, rest: str, known: Collection[str]) -> Macro | None:
    """The macro with parameters, or without text, that a definition makes; None where it has a text of its own to judge.

    >>> twice = macro_of("twice", "(t) (2*t)", ())
    >>> twice.body, twice.parameters, macro_of("DEBUG", "", ["DEBUG"]).parameters, macro_of("dt", " 0.5", ())
    ('(2*t)', ('t',), None, None)
    """
    parameters = _PARAMETERS.match(rest)
    if parameters:
        return Macro(rest[parameters.end() :].strip(), tuple(_NAME.findall(parameters[1])))
    return Macro("") if not rest.strip() and name in known else None


_DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(define|undef|ifdef|ifndef|if|elif|else|endif)\b[ \t]*")
_ANY_DIRECTIVE = re.compile(r"^[ \t]*#[ \t]*(?:define|undef|if|ifdef|ifndef|elif|else|endif)\b", re.MULTILINE)
_PROSE = re.compile(r"(?<=[ \t])//[ \t]*(?:[A-Za-z]{1,2}[ \t]+)?[A-Za-z]?[a-z]{2,}(?![\w(\[\]+&^])[^\n]*")
"""A comment as C++ has it: behind a blank, and with a word after it that is no row of symbols."""
_ARRAYS = re.compile(r"^[ \t]*define[ \t]*:\s*\{((?:[^{}]|\{[^{}]*\})*)\}", re.MULTILINE | re.IGNORECASE)
_FOR_THE_PREPROCESSOR = (("#", _ANY_DIRECTIVE), ("//", _PROSE), ("{", _ARRAYS))
"""What only it understands, each with a sign that is quickly found."""
_WORD_BEFORE = re.compile(rf"{ARROW.pattern}|axiom[ \t]*:", re.IGNORECASE)
_LINE = re.compile(r"(?:[^\n\\]++|\\(?!\n)|\\\n)+")
_ASKED = re.compile(r"\b(?:ifdef|ifndef|defined)\W+(\w+)")
_DEFINED = re.compile(r"\bdefined\b\s*(?:\(\s*(\w+)\s*\)|(\w+))")


def preprocessed(source: str, parse: Parse) -> Transcript:
    """A text as cpfg reads it, but for the macros that are numbers.

    Parameters
    ----------
    source
        A cpfg text.
    parse
        What reads an "expression" or a "word".
    """
    if not any(mark in source and sign.search(source) for mark, sign in _FOR_THE_PREPROCESSOR):
        return as_typed(source)
    return _Preprocessor(without_comments(source), parse).transcript(source)


class _Preprocessor:
    """What is left out of a text with its comments blanked, and what is put in."""

    def __init__(self, text: str, parse: Parse) -> None:
        self.text, self.parse, self.macros = text, cache(parse), Macros(text, parse)
        self.values: dict[str, Value] = {}
        self.asked = frozenset(_ASKED.findall(text))
        self.open: list[tuple[int, bool, bool]] = []
        """For each condition around a line: where it begins, whether its lines are read now, whether some were or are."""
        self.left_out: list[int] = []
        self._counted, self._number = 0, 1
        self.notes: list[str] = []

    @property
    def reading(self) -> bool:
        return all(now for _, now, _ in self.open)

    def transcript(self, source: str) -> Transcript:
        arrays = _ARRAYS.search(self.text)
        made = arrays_in(arrays[1], self.text) if arrays else None
        if arrays and made is not None:
            self.macros.table |= made
            self.text = self.text[: arrays.start()] + re.sub(r"[^\n]", " ", arrays.group()) + self.text[arrays.end() :]
            self.macros.text = self.text
        first = [Edit(*arrays.span(), "")] if arrays and made is not None else []
        edits = first + [edit for line in counted(_LINE.finditer(self.text)) for edit in self._line(line)]
        if self.open:
            raise self._error('This condition has no "#endif"', self.open[-1][0], "Every #if ends with one.")
        if self.macros.put:
            self.notes.append(f"Put in place, as the preprocessor of C does: {', '.join(self.macros.put)}.")
        if self.left_out:
            shown = [*map(str, self.left_out[:8]), *["..."] * (len(self.left_out) > 8)]
            self.notes.append(f"Left out, because of the conditions around: line{'s' * (len(shown) > 1)} {', '.join(shown)}.")
        return edited(source, edits, self.notes) if edits else as_typed(source)

    def _line(self, line: re.Match[str]) -> Iterator[Edit]:
        directive = _DIRECTIVE.match(line.group())
        start, end = line.span()
        if directive is None:
            yield from self._read(start, end) if self.reading else self._omitted(start, end)
        elif directive[1] in ("define", "undef"):
            at = start + directive.end()
            yield from getattr(self, f"_{directive[1]}")(start, at, end) if self.reading else [Edit(start, end, "")]
        else:
            self._condition(directive[1], _joined(line.group()[directive.end() :]).strip(), start)
            yield Edit(start, end, "")

    def _omitted(self, start: int, end: int) -> Iterator[Edit]:
        if self.text[start:end].strip():
            self._number += self.text.count("\n", self._counted, start)
            self._counted = start
            self.left_out.append(self._number)
        yield Edit(start, end, "")

    def _read(self, start: int, end: int) -> Iterator[Edit]:
        prose = _PROSE.search(self.text, start, end)
        if prose and _WORD_BEFORE.search(self.text, start, prose.start()):
            self.notes.append(f'"{prose.group().strip()}" is read as a comment; two rolls have no blank before them.')
        if prose:
            yield Edit(*prose.span(), "")
        yield from self.macros.edits(start, prose.start() if prose else end)

    def _undef(self, start: int, at: int, end: int) -> Iterator[Edit]:
        name = _joined(self.text[at:end]).strip()
        self.macros.table.pop(name, None)
        self.values.pop(name, None)
        yield Edit(start, end, "")

    def _define(self, start: int, at: int, end: int) -> Iterator[Edit]:
        named = re.compile(r"[A-Za-z_]\w*").match(self.text, at, end)
        if named is None:
            return
        name, rest = named.group(), _joined(self.text[named.end() : end])
        macro = macro_of(name, rest, self.asked)
        if macro is None and rest.strip() and self.macros.is_text(rest.strip()):
            macro = Macro(rest.strip())
        if macro is not None:
            self.macros.table[name] = macro
            yield Edit(start, end, "")
            return
        self.macros.table.pop(name, None)
        self._value(name, rest.strip())
        if "\\\n" in self.text[at:end]:
            yield Edit(start, end, f"#define {name} {' '.join(rest.split())}")

    def _value(self, name: str, body: str) -> None:
        """Note the value of a macro that is a number, for conditions; what has none is reported when the line is read."""
        with suppress(LSystemError, ProblemFound):
            expression = self.parse("expression", body)
            if names_in(expression) <= self.values.keys():
                self.values[name] = value_of(expression, self.values)

    def _condition(self, keyword: str, asked: str, at: int) -> None:
        if keyword in ("if", "ifdef", "ifndef"):
            holds = self.reading and self._holds(keyword, asked, at)
            self.open.append((at, holds, holds or not self.reading))
            if len(self.open) > current().depth:
                raise self._error(
                    f"Conditions are nested more than {current().depth} deep", at, "Keep the lines that are meant."
                )
            return
        if not self.open:
            raise self._error(f'This "#{keyword}" belongs to no condition', at, 'A condition begins with "#if".')
        begun, _, done = self.open.pop()
        if keyword != "endif":
            holds = not done and (keyword == "else" or self._holds("if", asked, at))
            self.open.append((begun, holds, done or holds))

    def _holds(self, keyword: str, asked: str, at: int) -> bool:
        """Whether a condition holds; a name that is no macro is 0, as in C."""
        if keyword != "if":
            return self._is_defined(asked.split()[0] if asked else "") == (keyword == "ifdef")
        plain = _DEFINED.sub(lambda found: str(int(self._is_defined(found[1] or found[2]))), asked)
        try:
            expression = self.parse("expression", self.macros.expanded(plain, at))
            known = {name: self.values.get(name, 0) for name in names_in(expression)}
            check_expression(expression, known, expression_type(expression))
            return bool(value_of(expression, known))
        except (LSystemError, ProblemFound):
            raise self._error(
                "This condition has no value", at, 'It is made of numbers, macros that are numbers, and "defined".'
            ) from None

    def _is_defined(self, name: str) -> bool:
        return name in self.macros.table or name in self.values

    def _error(self, message: str, at: int, hint: str) -> ModelSyntaxError:
        end = self.text.find("\n", at)
        return ModelSyntaxError(message, self.text, at, end if end >= 0 else len(self.text), hint)


def _joined(line: str) -> str:
    """A line for the preprocessor, which may go on below, without a comment at its end."""
    return re.sub(r"\\\n", "  ", line).split("//")[0]
