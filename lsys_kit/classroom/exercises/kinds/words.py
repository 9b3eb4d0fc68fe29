"""Words as answers: one word, or several in order."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress

from lsys_kit.classroom.exercises.asked import Derived, asked_steps, asked_system, right_history
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference, first_difference, one_apart
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import (
    ARROW,
    keyboard_text,
    text_answer,
    unlabelled,
    unquoted,
    without_commas,
    without_comments,
)
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError
from lsys_kit.notation.analysis.checks import span, suggestion
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.notation.read import read_word
from lsys_kit.notation.registry import DIALECTS

Modules = tuple[Module, ...]
_MISTAKABLE = {"+": "-", "-": "+", "[": "(", "]": ")", "(": "[", ")": "]", "F": "f", "f": "F"}
"""Symbols that are taken for one another: where one occurs the other is an answer, if a wrong one."""
_ONE_BRACKET = frozenset("[](){}")
"""What is no word."""
_TURTLE = "Ff+-[]|"
_BRACES = re.compile(r"^\s*[{\[]([^{}\[\]]*,[^{}\[\]]*)[}\]]\s*$", re.DOTALL)
"""A word written as a list, whose brackets are no branches."""
_TUPLE = re.compile(r"^\s*\(([^()]*,[^()]*)\)\s*$", re.DOTALL)
_LABEL = re.compile(
    r"^\s*(?:\d{1,3}\s*:\s|(?:it|that|es|das)(?:['’]s|\s+is|\s+ist)\s+|(?:(?:the|my|das|die|mein|meine)\s+)?"
    r"(?:word|step|stage|answer|result|axiom|wort|schritt|stufe|antwort|ergebnis)\b[\w\s()]*(?:(?:is|ist|lautet)\b|[:=])\s*)",
    re.IGNORECASE,
)
_OUTER = re.compile(r"^\s*[\[{(]([^\[\]{}()]*)[\]})]\s*$", re.DOTALL)
"""Words within one pair of brackets."""
_VALUES, _DECIMAL_COMMA = re.compile(r"\([^()]*+\)"), re.compile(r"(?<![\d.,])(\d++),(?=\d++(?![\d.,]))")
"""A number with a decimal comma, where the question has no module with two."""
_NAME = re.compile(r"[A-Za-z]\w*+")


def system_of_words(exercise: Exercise) -> LSystem:
    """The system whose symbols an answer may use: that of the question, or one of the letters that it names."""
    if exercise.system:
        return asked_system(exercise)
    return LSystem(tuple(map(Pattern, exercise.symbols or sorted({*re.findall(r"\w", exercise.solution)}))), ())


def read_modules(system: LSystem, answer: object, drawn: bool = False) -> Modules:
    """A word of a system, as it was typed or made by the kit; one that is drawn may hold any command of the turtle.

    >>> from lsys_kit.notation.read import read
    >>> fibonacci = read("axiom: a\\na -> ab\\nb -> a")
    >>> read_modules(fibonacci, "a, b, a") == read_modules(fibonacci, ["a", "b", "a"]) == read_modules(fibonacci, "aba")
    True
    """
    if isinstance(answer, Word):
        return tuple(answer)
    if isinstance(answer, list | tuple) and all(isinstance(part, str | Module) for part in answer):
        answer = " ".join(map(str, answer))
    typed = text_answer(answer, reply("word.what"), '"al br"')
    text = _unlabelled(system, typed)
    if text in _ONE_BRACKET:
        raise ModelValueError(reply("word.one_character", text=text))
    bare = _BRACES.sub(lambda found: found[1], text)
    bare = bare if system.notation == "plant-string" else _TUPLE.sub(r"\1", bare)
    plain = bare if system.notation == "plant-string" else without_commas(bare)
    try:
        return _of_the_system(system, plain, read_word(plain, system.notation, system), drawn)
    except LSystemError as mistake:
        for notation in DIALECTS:
            with suppress(LSystemError):
                word = read_word(plain, notation, system)
                if all(module.symbol in plain for module in word):  # some take small letters for capital ones
                    return _of_the_system(system, plain, word, drawn)
        raise _as_typed(mistake, typed, plain) from None


def _as_typed(mistake: LSystemError, typed: str, read: str) -> LSystemError:
    """A mistake in a word, shown in what was typed, where every character of the word has its place there."""
    start = typed.find(read[:1])
    span, shown = mistake.span, typed[start : start + len(read)]
    is_alike = len(shown) == len(read) and all(a == b or not b.strip() or a == "," for a, b in zip(shown, read, strict=True))
    return mistake.moved(typed, start + span[0], start + span[1]) if span and read and is_alike else mistake


def unnamed_word(text: str) -> str:
    """A word without what it is called in front of it.

    >>> unnamed_word("step 4: bl ar"), unnamed_word("The word is F[+F]F"), unnamed_word("it is bl ar"), unnamed_word("F(1) f")
    ('bl ar', 'F[+F]F', 'bl ar', 'F(1) f')
    """
    return _LABEL.sub("", text)


def _unlabelled(system: LSystem, text: str) -> str:
    """A word without what people write around it or between its symbols, and the system does not know.

    >>> from lsys_kit.notation.read import read
    >>> filament = read("axiom: ar\\nar -> al br")
    >>> [_unlabelled(filament, text) for text in ("step 2: al br", "['al', 'br']", "al-br.", "a_l b_r")]
    ['al br', '[al, br]', 'al br', 'al br']
    """
    known = symbols(system)
    signs = "".join(known)
    text = unnamed_word(unquoted(keyboard_text(without_comments(text, signs))))
    for mark in "'\"`":
        text = text if mark in signs else text.replace(mark, "")
    if not {"+", "-"} & set(known):
        text = re.sub(r"(?<=[A-Za-z])-(?=[A-Za-z])", " ", text)
    text = text if "." in signs else re.sub(r"\.\s*$", "", text)
    has_decimals = re.search(r"\d\.\d", system.source or "")
    if has_decimals and system.notation != "plant-string" and all(len(m.arguments) < 2 for m in system.modules):
        text = _VALUES.sub(lambda found: _DECIMAL_COMMA.sub(r"\1.", found[0]), text)
    return _NAME.sub(lambda found: plain if (plain := found[0].replace("_", "")) in known else found[0], text)


def _of_the_system(system: LSystem, text: str, word: Modules, drawn: bool) -> Modules:
    known = symbols(system)
    allowed = {*known, *(_MISTAKABLE[symbol] for symbol in known if symbol in _MISTAKABLE)}
    if drawn and system.notation != "plant-string":
        allowed |= {*_TURTLE}
    for module in word:
        if module.symbol not in allowed:
            hint = suggestion(module.symbol, known) or reply("word.symbols", symbols=", ".join(known))
            said = reply("word.unknown", symbol=module.symbol)
            raise ModelNameError(said, text, *_place_of(module, text), hint)
    return word


def _place_of(module: Module, text: str) -> tuple[int | None, int | None]:
    """Where the symbol of a module stands, which may be read from several letters without blanks between them.

    >>> _place_of(Module("g", at=(0, 3)), "FgF"), _place_of(Module("bx", at=(3, 5)), "al bx")
    ((1, 2), (3, 5))
    """
    start, end = span(module)
    at = -1 if start is None else text.find(module.symbol, start, end)
    return (start, end) if at < 0 or len(module.symbol) > 1 else (at, at + 1)


def _read_word(exercise: Exercise, answer: object) -> Modules:
    if (
        isinstance(answer, str)
        and exercise.system
        and len(steps := re.split(ARROW, answer)) in (exercise.steps, exercise.steps + 1)
    ):
        answer = steps[-1] if len(steps) > 1 else answer  # of a derivation, its last word
    return read_modules(system_of_words(exercise), answer)


def _word_difference(exercise: Exercise, word: Modules, solution: Modules) -> Difference:
    at = first_difference(word, solution)
    earlier = _step_of(exercise, word)
    if earlier is not None:
        return Difference(reply("word.of_step", step=earlier), explains=True)
    said = _erased(exercise, word, solution, at)
    if not said:
        said = (
            reply("word.too_many", right=at)
            if at == len(solution)
            else f"{_parting(word, at)} {_mother(exercise, at)}".rstrip()
        )
    return Difference(said, at / max(len(solution), len(word), 1), one_apart(word, solution), at_a_place=True)


def _step_of(exercise: Exercise, word: Modules) -> int | None:
    """The step before the last whose word an answer is."""
    if not exercise.system:
        return None
    words = right_history(exercise).words
    return next((step for step in range(exercise.steps - 1) if tuple(words[step]) == word), None)


def _erased(exercise: Exercise, word: Modules, solution: Modules, at: int) -> str:
    """What is said where a module of the step before, which should vanish, is there still."""
    if not exercise.system or not exercise.steps or at >= len(word):
        return ""
    words = right_history(exercise).words
    assert isinstance(words, Derived)
    parents, before = words.derivation.origins(exercise.steps).parents, words[exercise.steps - 1]
    first = parents[at - 1] + 1 if at else 0
    last = parents[at] if at < len(solution) else len(before)
    for place in range(first, last):
        if before[place] == word[at] and word[at + 1 : at + 2] == solution[at : at + 1]:
            return reply("word.erased", right=at, at=at + 1, module=word[at], place=place + 1, step=exercise.steps - 1)
    return ""


def _parting(word: Modules, at: int) -> str:
    if at >= len(word):
        return reply("word.ends", right=at, at=at + 1)
    return reply("word.differs" if at else "word.first", right=at, at=at + 1, module=word[at])


def _mother(exercise: Exercise, at: int) -> str:
    if not exercise.system or not exercise.steps:
        return ""
    words = right_history(exercise).words
    assert isinstance(words, Derived)
    origins = words.derivation.origins(exercise.steps)
    parent, before = origins.parents[at], words[exercise.steps - 1]
    size = origins.sizes[parent] if origins.sizes else 1
    where = {"modules": before[parent : parent + size], "at": parent + 1, "last": parent + size, "step": exercise.steps - 1}
    return reply("word.mother" if size == 1 else "word.mothers", **where)


def _honest_word(exercise: Exercise, word: Modules, solution: Modules) -> bool:
    """Half as many modules and values, or a beginning; branches need not be there, and the axiom is none."""
    axiom = asked_system(exercise).axiom if exercise.system and exercise.steps else ()
    begins = _size(word) > 1 and word == solution[: len(word)]
    is_enough = 2 * len(word) >= len(solution) or 2 * _size(word) >= _size(solution)
    return (begins or is_enough) and tuple(map(str, word)) != tuple(map(str, axiom))


def _size(word: Modules) -> int:
    return sum(max(len(module.arguments), 1) for module in word if module.symbol[:1].isalnum())


WORD = AnswerKind(_read_word, _word_difference, honest=_honest_word)


# Several words


def _read_words(exercise: Exercise, answer: object) -> tuple[Modules, ...]:
    system = system_of_words(exercise)
    return tuple(read_modules(system, part) for part in _separate(system, answer))


def _separate(system: LSystem, answer: object) -> Iterator[object]:
    if isinstance(answer, Derivation | list | tuple):
        yield from answer
        return
    text = _OUTER.sub(r"\1", unquoted(re.sub(ARROW, ",", text_answer(answer, reply("words.what"), '"a, ab, aba"'))))
    by_blanks = all(len(symbol) == 1 and symbol.isalpha() for symbol in symbols(system))
    separator = next((mark for mark in ("\n", ";", "|", ",", " ") if mark in text and (mark != " " or by_blanks)), "\n")
    for part in text.split(separator):
        if part.strip(" ,"):
            yield unlabelled(re.sub(r"^\s*\d+\s*[:.]?\s+", "", part)).strip(" ,")


def _words_difference(exercise: Exercise, words: Sequence[Modules], solution: Sequence[Modules]) -> Difference:
    at = first_difference(words, solution)
    likeness, where = at / len(solution), _where(exercise, at)
    if len(words) == len(solution):
        inside = reply("words.position", at=first_difference(words[at], solution[at]) + 1)
        return Difference(f"{where} {inside}", likeness, at == len(solution) - 1 > 1)
    count = reply("words.count", number=len(words), asked=len(solution))
    if at < min(len(words), len(solution)):
        return Difference(f"{count} {where}", likeness)
    one_off = len(solution) > 3 and abs(len(words) - len(solution)) == 1
    return Difference(f"{count} {reply('table.agree')}", likeness, one_off)


def _where(exercise: Exercise, at: int) -> str:
    if not exercise.system or at >= len(asked_steps(exercise)):
        return reply("words.differs", at=at + 1)
    return reply("words.differs_at_step", at=at + 1, step=asked_steps(exercise)[at])


def _words_right(_: Exercise, own: Sequence[Modules], solution: Sequence[Modules]) -> tuple[int, int]:
    return first_difference(own, solution), max(len(own), len(solution))


def _honest_words(_: Exercise, own: Sequence[Modules], solution: Sequence[Modules]) -> bool:
    return 2 * len(own) >= len(solution) or any(word in solution for word in own)


WORDS = AnswerKind(_read_words, _words_difference, honest=_honest_words, parts_right=_words_right)
