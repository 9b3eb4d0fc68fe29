"""The lines of a cpfg text that are for the preprocessor of C: `#define`, `#undef`, `#if` and what belongs to it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from functools import cache

from lsys_kit.budget import counted, current
from lsys_kit.errors import LSystemError, ModelSyntaxError
from lsys_kit.notation.analysis.checks import check_expression, value_of
from lsys_kit.notation.analysis.problems import ProblemFound
from lsys_kit.notation.dialects.cpfg.macros import Macro, Macros, Parse, arrays_in, macro_of
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import expression_type, names_in
from lsys_kit.notation.syntax.text.statements import ARROW, without_comments
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, as_typed, edited

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
