"""Choices as answers: one of some options, one symbol of a word, one line of a program."""

from __future__ import annotations

import re
from collections.abc import Mapping
from numbers import Integral
from string import ascii_uppercase

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import WORDS, keyboard_text, kind_of, quoted, text_answer, unquoted, with_digits
from lsys_kit.errors import ModelNameError, ModelValueError

# One of some options


def letters(exercise: Exercise) -> str:
    """The letters of the options of a choice."""
    return ascii_uppercase[: len(exercise.options)]


def listing(exercise: Exercise) -> str:
    """What stands below a question, in Markdown: the options of a choice, or the numbered lines of a program.

    >>> listing(Exercise("1", "", "line", "", "2", "", (), text="a\\nb")).splitlines()[2:]
    ['     1  a', '     2  b']
    """
    if exercise.options:
        options = zip(letters(exercise), exercise.options, strict=True)
        return "\n\n" + "\n".join(f"- **{letter}** {option.text}" for letter, option in options)
    if exercise.kind == "line":
        lines = exercise.text.strip("\n").splitlines()
        return "\n\n" + "\n".join(f"    {number:2}  {line}" for number, line in enumerate(lines, 1))
    return ""


_AROUND = r"[\s.,;:!?()\[\]{}\"'`*]*+"
"""What may stand around a letter."""
_LED_IN = (
    r"(?:(?:i\s+(?:think|guess|say|choose|take|believe)|ich\s+(?:denke|glaube|meine|nehme|wähle)|definitely|clearly|sicher|klar)\s++"
    r"(?:that\s++)?)?(?:(?:it|that|es|das)(?:\s+is|['’]s|\s+ist)\s++)?(?:the\s++|die\s++)?(?:(?:right|correct|my)\s++)?"
    r"(?:option|answer|choice|solution|letter|antwort|möglichkeit|lösung|buchstabe)?\s*+(?:(?:is|ist|would\s+be|must\s+be|wäre)\b)?"
)
"""What may stand before a letter."""
_LETTER = re.compile(
    rf"^{_LED_IN}"
    rf"{_AROUND}([a-z])(?:\s+(?:is|ist)\s+(?:the\s+|die\s+)?(?:right|correct|richtig\w*|true)(?:\s+(?:one|answer|option|antwort))?)?{_AROUND}$",
    re.IGNORECASE,
)
_LETTER_AND_TEXT = re.compile(r"^\W*([A-Za-z])\s*[:.)\]-]+\s+(\S.*)$", re.DOTALL)
_NAMED = rf"^\W*+{_LED_IN}\s*+"
_LETTER_AND_REASON = re.compile(
    rf"{_NAMED}([A-Za-z])\s*(?:,|;|-|–|\bbecause\b|\bsince\b|\bas\b|\bweil\b|\bda\b)\s*(?:[^\W\d_]{{2,}}|(?-i:[a-z])\s+(?!and\b|or\b|und\b|oder\b)[^\W\d_]{{2,}}).*$",
    re.DOTALL | re.IGNORECASE,
)
"""A letter, and why."""
_CONTRARY = re.compile(rf"{_NAMED}[A-Za-z]\W+(?:but|except|however|only|aber|außer|nur|sondern)\b", re.IGNORECASE)
"""A letter, and in what it is not so."""
_LETTER_AND_WORDS = re.compile(r"^\W*([A-Za-z])\s*(?:[:)\]]|\.(?=\s)|\((?=\d*+\s*+[^\W\d_]{2}))\s*(\S.*)$", re.DOTALL)
_WORDS_AND_LETTER = re.compile(r"(?=.*?[^\W\d_]{2})([^:]*+(?::[^:]*+)*?):\s*+([A-Z])\W*+\Z", re.DOTALL)
"""A letter with words of one's own behind it, or in front of it."""
_LETTER_BEFORE = re.compile(r"^\W*([A-Z])([\s,;]\s*)(\S.*)$", re.DOTALL)
"""A letter with words or figures behind it, without a sign between them, or a comma."""
_FIRST = re.compile(rf"{_NAMED}([A-Z])(?!\w)", re.IGNORECASE)
_CLAUSES = re.compile(r"[,;.]\s+")
_CORRECTED = re.compile(
    r"(?:(?:no|wait|sorry|rather|actually|better|nein|doch|eher|lieber|besser)\b\s*+){0,3}"
    rf"{_LED_IN}\s*+([A-Z])\W*",
    re.IGNORECASE,
)
"""The first letter, and a last clause that is one, as in "A, no wait, D"."""
_PLACE = re.compile(
    r"^\W*(?:(?:the|die|der|das)\s++)?([^\W\d_]++|\d(?:st|nd|rd|th))(?:\s++(?:one|option|answer|choice|antwort|möglichkeit))?\W*$",
    re.IGNORECASE,
)
"""The place of an option, as in "the third one"."""
_YES_OR_NO = re.compile(rf"^\W*(yes|no|ja|nein)\b\W*([a-z]){_AROUND}$", re.IGNORECASE)
"""A letter behind the first word of its option, as in "no, D"."""
_NOUN_AND_LETTER = re.compile(rf"^\W*([^\W\d_]{{3,}})\s+([a-z]){_AROUND}$", re.IGNORECASE)
_ANSWER_IS = re.compile(r"^(?:answer|antwort)\s*=\s*", re.IGNORECASE)
_SEVERAL = re.compile(r"[,;/&+]|\b(?:and|or|but|then|und|oder|aber|dann)\b", re.IGNORECASE)
_SEVERAL_LETTERS = re.compile(r"(?<!\w)[A-Z](?!\w)")
"""Letters of several options, as in "B or D"."""
_OF_THESE = re.compile(r"\b(?:which|these)\s+([^\W\d_]+)", re.IGNORECASE)
"""What the options are, as in "which of these systems"."""
_LAST = ("last", "letzte", "letzter", "letztes")
_EXCLUDING = frozenset(WORDS["excluding"].split())
_DENYING = frozenset(WORDS["denying"].split())
_FILLING = frozenset(WORDS["filling"].split())
MOST_WORDS = 3
"""So many words has an answer that names an option of one word."""
_SHORTEST_PART = 3
"""So many characters of an option's text at least stand for it, if they are a figure or no other option has them."""


def _plain(text: str) -> str:
    """A text by its words and signs alone: without blanks beside signs, quotation marks, capital letters."""
    text = re.sub(r"[`*\"']", "", keyboard_text(text))
    text = with_digits(re.sub(r"(?<=[a-z]{2})-(?=[a-z]{2})", " ", " ".join(text.split())), ordinals=False)
    return re.sub(r" ?([^\w\s]) ?", r"\1", text).strip(".,;:!? ").casefold()


def _words(plain: str) -> list[str]:
    return re.findall(r"\d+[.,/]\d+|\w+", plain)


def _read_choice(exercise: Exercise, answer: object) -> str:
    if isinstance(answer, list | tuple) and all(isinstance(each, str) for each in answer):
        if len(answer) != 1:
            raise ModelValueError(reply("choice.one_needed", number=len(answer)))
        answer = answer[0]
    known = letters(exercise)
    texts = {letter: _plain(option.text) for option, letter in zip(exercise.options, known, strict=True)}
    if isinstance(answer, int) and not isinstance(answer, bool) and any(str(answer) in _words(own) for own in texts.values()):
        answer = str(answer)
    text = _ANSWER_IS.sub("", " ".join(text_answer(answer, reply("choice.what"), '"A"').split()))
    text = re.sub(r"^<([^<>]*)>$", r"\1", text)
    named, both = _LETTER.match(text), _LETTER_AND_TEXT.match(text)
    meant = [letter for letter, own in texts.items() if own == _plain(text)] or [
        letter for letter, own in texts.items() if _without_joints(own) == _without_joints(_plain(text))
    ]
    first, last = _FIRST.match(text), _CORRECTED.fullmatch(_CLAUSES.split(text.rstrip(" .,;"))[-1])
    if not meant and first and last and len({first[1].upper(), last[1].upper()} & {*known}) > 1:
        raise ModelValueError(reply("choice.one_needed", number=2))
    named_letter = named[1].upper() if named else _letter_behind(exercise, texts, text)
    if named_letter and named_letter in known and not meant:
        meant = [named_letter]
    if both and both[1].upper() in known and not meant:
        meant = [letter for letter in _with_part(texts, _plain(both[2])) if letter == both[1].upper()]
    reason = _LETTER_AND_REASON.match(text)
    if reason and reason[1].upper() in known and not meant and not _CONTRARY.match(text):
        meant = [reason[1].upper()]
    of_part = _with_real_part(texts, _plain(text))
    meant = meant or (of_part if len(of_part) > 1 or _says_enough(exercise, of_part, texts, _plain(text)) else [])
    named_ones = _named_in(texts, text)
    if not meant and len({texts[letter].partition(":")[0] for letter in named_ones}) > 1:
        raise ModelValueError(reply("choice.one_needed", number=len(named_ones)))
    meant = meant or named_ones or _with_own_words(texts, text) or _by_place(known, text)
    meant = meant or [letter for letter, own in texts.items() if own == _plain(text.partition(":")[0])]
    meant = meant or _with_the_same_words(texts, _plain(text)) or _before_words(exercise, texts, text)
    if len(meant) > 1:
        several = reply("choice.several", text=quoted(text))
        raise ModelNameError(several, hint=reply("choice.choose", options=", ".join(meant)))
    parts = _SEVERAL.split(text)
    given = {*_SEVERAL_LETTERS.findall(text)} & {*known} if len(parts) > 1 else set()
    given |= {letter for letter, own in texts.items() for part in parts if _plain(part) in (own, letter.casefold())}
    if not meant and len(given) > 1:
        raise ModelValueError(reply("choice.one_needed", number=len(given)))
    if len(meant) != 1:
        raise ModelNameError(
            reply("choice.none_of_these", text=quoted(text)), hint=reply("choice.choose", options=", ".join(known))
        )
    return meant[0]


def _letter_behind(exercise: Exercise, texts: Mapping[str, str], text: str) -> str:
    """A letter behind what the question calls its options, or behind the first word of its own option; or nothing."""
    both, noun = _YES_OR_NO.match(text), _NOUN_AND_LETTER.match(text)
    if both:
        return both[2].upper() if texts.get(both[2].upper(), "").startswith(both[1].lower()) else ""
    called = {word.lower().removesuffix("s") for word in _OF_THESE.findall(exercise.question)}
    if noun and noun[1].lower() in _words(texts.get(noun[2].upper(), ""))[:2]:
        return noun[2].upper()
    return noun[2].upper() if noun and noun[1].lower().removesuffix("s") in called else ""


def _without_joints(text: str) -> str:
    """A plain text without what stands between its parts: commas, "with", "and".

    >>> _without_joints(_plain("`a -> bb` with `b -> ab`")) == _without_joints(_plain("a -> bb, b -> ab"))
    True
    """
    parts = re.split(r"[,;]|(?<!\w)(?:with|and|mit|und)(?!\w)", text)
    return ",".join(part.strip(" .:") for part in parts if part.strip(" .:"))


def _by_place(known: str, text: str) -> list[str]:
    """The option that is named by its place.

    >>> [_by_place("ABC", text) for text in ("the second one", "die letzte", "the fourth", "first cell")]
    [['B'], ['C'], [], []]
    """
    found = _PLACE.match(text)
    if not found:
        return []
    if found[1].lower() in _LAST:
        return [known[-1]]
    number = with_digits(found[1])
    return [*known[int(number) - 1 : int(number)]] if number != found[1] and number.isdigit() else []


def _with_part(texts: Mapping[str, str], part: str) -> list[str]:
    """The options whose texts contain a part; none where no text has it as whole words."""
    before, after = (r"(?<!\w)" if part[:1].isalnum() else ""), (r"(?!\w)" if part[-1:].isalnum() else "")
    whole = [letter for letter, text in texts.items() if re.search(before + re.escape(part) + after, text)]
    if part.isdigit() or not whole or (len(whole) > 1 and len(part) == 2 and part.isalpha()):
        return whole
    return [letter for letter, text in texts.items() if part in text] if len(part) >= _SHORTEST_PART else []


FEWEST_WORDS = 4
"""So many words of the right option stand for it, if they neither begin it nor are half of it: fewer may be there by chance."""


def _says_enough(exercise: Exercise, found: list[str], texts: Mapping[str, str], part: str) -> bool:
    """Whether a part of an option may stand for it; of a wrong one less is enough, as nothing is given away."""
    own = texts[found[0]] if found else ""
    begins = own == part or (own.startswith(part) and not own[len(part)].isalnum())
    is_right = found == [exercise.solution.strip().upper()]
    words, fewest = re.findall(r"\w+", part), min(FEWEST_WORDS, len(own.split()) / 2)
    return not is_right or begins or len(words) >= fewest or len(own.split()) <= MOST_WORDS


_CLAUSE_END = re.compile(r"[.,:;]")


def _with_real_part(texts: Mapping[str, str], part: str) -> list[str]:
    """The options whose texts contain a part that may tell them apart: two telling words, the beginning, or a whole text.

    >>> _with_real_part({"A": "each cell has both ages", "B": "1 cell"}, "ages")
    []
    """
    found = _with_part(texts, part)
    telling = [word for word in re.findall(r"\w+", part) if word not in _FILLING | _EXCLUDING]
    signs = re.findall(r"[^\w\s]", part)
    is_whole = any(part in (texts[letter], *_CLAUSE_END.split(texts[letter])[:1]) for letter in found)
    is_short = any(len(texts[letter].split()) <= MOST_WORDS for letter in found)
    is_long = len(telling) + len(signs) > 1 or len(re.findall(r"\w+", part)) >= FEWEST_WORDS
    is_real = is_whole or (is_short and not part.isdigit()) or is_long
    return found if is_real or len(found) > 1 else []


def _with_own_words(texts: Mapping[str, str], text: str) -> list[str]:
    """The option whose letter stands before a colon or parenthesis and words of one's own, or behind words and a colon.

    >>> _with_own_words({"A": "top", "B": "down"}, "B: it is lower"), _with_own_words({"A": "top", "B": "down"}, "A: down")
    (['B'], ['A', 'B'])
    """
    before, behind = _LETTER_AND_WORDS.match(text), _WORDS_AND_LETTER.match(text)
    named = [(each[1], each[2]) for each in (before,) if each] + [(each[2], each[1]) for each in (behind,) if each]
    letters = [letter.upper() for letter, _ in named if letter.upper() in texts]
    if len(letters) != 1 or len(named) != 1:
        return []
    words = named[0][1]
    others = _with_real_part(texts, _plain(words))
    excludes = set(re.findall(r"\w+", words.lower())) <= _EXCLUDING | _FILLING
    if excludes:
        return []
    return sorted({*letters, *others})


def _with_the_same_words(texts: Mapping[str, str], plain: str) -> list[str]:
    """The option that has the words and figures of an answer in their order, where no other has; words that fill do not count.

    >>> _with_the_same_words({"A": "at (0,1),looking up", "B": "at (0,-1),looking up"}, "(0,1) looking up")
    ['A']
    """
    own, others = _telling(plain), {letter: _telling(text) for letter, text in texts.items()}
    found = [letter for letter, words in others.items() if own and words == own]
    return found if len(found) == 1 else []


def _telling(plain: str) -> list[str]:
    return [word for word in re.findall(r"-?\d+|[^\W\d_]+|[^\w\s.,:;()]", plain) if word not in _FILLING]


def _before_words(exercise: Exercise, texts: Mapping[str, str], text: str) -> list[str]:
    """The option whose letter stands before words or a figure of one's own, and the one other option that has these.

    Not where another option is named or where the words deny; an A, which may be an article, and a letter that is a symbol of
    the question, only before words of its option.
    """
    found = _LETTER_BEFORE.match(text)
    if not found or found[1] not in texts or not re.search(r"[^\W\d_]{2}|\d", found[3]):
        return []
    letter, words = found[1], {*_words(_plain(found[3]))}
    excludes = words & _EXCLUDING and words <= _EXCLUDING | _FILLING
    if words & _DENYING or excludes or {*_SEVERAL_LETTERS.findall(found[3])} & {*texts}:
        return []
    if letter == "A" or re.search(rf"(?<!\w){letter}(?!\w)", exercise.question):
        return [letter] if words - _FILLING <= {*_words(texts[letter])} else []
    others = _with_real_part(texts, _plain(found[3]))
    return sorted({letter, *(others if len(others) == 1 else [])})


def _named_in(texts: Mapping[str, str], text: str) -> list[str]:
    """The options that a short answer names: those of one word, or that begin with one and a colon."""
    words = _words(_plain(text))
    if len(words) > MOST_WORDS or (_EXCLUDING | {"and", "und"}) & set(words):
        return []
    return [letter for letter, own in texts.items() if own.partition(":")[0] in words]


def _choice_difference(exercise: Exercise, own: str, _: str) -> Difference:
    says = exercise.options[letters(exercise).index(own)].says
    return Difference(says or exercise.otherwise or reply("choice.not_right", answer=own))


CHOICE = AnswerKind(_read_choice, _choice_difference)


# One symbol


def _units(text: str) -> list[str]:
    return text.split() if " " in text.strip() else [*text.strip()]


def _read_symbol(exercise: Exercise, answer: object) -> tuple[str, int]:
    """The symbol, and its position from 1; 0 where the symbol alone was given and does not stand there once."""
    units = _units(exercise.text)
    given = str(answer) if isinstance(answer, int) and not isinstance(answer, bool) else answer
    text = text_answer(given, reply("symbol.what"), '"["').strip().strip("\"'`")
    text = re.sub(r"^(position|symbol|no\.?|number)\s+", "", text, flags=re.IGNORECASE)
    if text.isascii() and text.isdigit() and text not in units:
        if not units or not 1 <= int(text[:9]) <= len(units):
            raise ModelValueError(reply("symbol.positions", last=len(units)) if units else reply("symbol.not_a_number"))
        return units[int(text) - 1], int(text)
    if units and text not in units and exercise.symbols and text not in exercise.symbols:
        raise ModelNameError(reply("symbol.unknown", symbol=quoted(text)))
    if not text or len(text.split()) > 1 or (len(text) > 1 and all(len(unit) == 1 for unit in units)):
        raise ModelValueError(reply("symbol.one_needed"))
    return text, units.index(text) + 1 if units.count(text) == 1 else 0


def _same_symbol(_: Exercise, own: tuple[str, int], wanted: tuple[str, int]) -> bool:
    return own[0] == wanted[0] and (own[1] == wanted[1] or not wanted[1])


def _symbol_difference(exercise: Exercise, own: tuple[str, int], wanted: tuple[str, int]) -> Difference:
    if own[0] == wanted[0] and not own[1]:
        return Difference(reply("symbol.several_times"), 1, True)
    place = reply("symbol.at", position=own[1], symbol=own[0]) if own[1] else ""
    return Difference(f"{place} {exercise.otherwise or reply('symbol.not_asked_for', answer=own[0])}".strip())


SYMBOL = AnswerKind(_read_symbol, _symbol_difference, _same_symbol)


# One line


_LINE_NUMBER = re.compile(
    r"^\W*(?:(?:it|is|the|in|line|number|no|nr|l|es|ist|die|zeile|nummer)\b\W*|l)*(\d{1,8})(?:\W+(?:line|zeile))?(?:\W*$|\s*\([^()]*\)\W*$|\s*[:,;]\s*[^\W\d].*$|\s*:\s*[^\w\s].*$)",
    re.IGNORECASE | re.DOTALL,
)


_LINE_AND_WORDS = re.compile(
    r"^\W*(?:in\s++|(?:it|es)\s+(?:is|ist)\s++)?(?:line|zeile)\s*+(\d{1,3})\s*+:|[,;:]\s*+(?:in\s++)?(?:line|zeile)\s*+(\d{1,3})\W*$",
    re.IGNORECASE,
)
"""One line with words or signs behind it, or in front of it."""
_WRONG_LINE = re.compile(
    r"(?:^\W*+|[,;.]\s*+|\b(?:and|but|so|und|aber)\s++)(?:(?:the|die)\s++)?(?:line|zeile)?\s*+(\d{1,3})\s++(?:line\s++|zeile\s++)?(?:is|ist)\s++"
    r"(?:wrong|false|incorrect|not\s+right|the\s+(?:wrong\s+(?:1|line)|mistake|misprint)|falsch|nicht\s+richtig)\W*$",
    re.IGNORECASE,
)
"""A line that is told to be wrong."""
_SEVERAL_LINES = re.compile(
    r"(?:lines?|zeilen?|both|beide|between|zwischen)?\s*+\d++"
    r"(?>(?:\s*+(?:[,;/&+-]|and|or|to|und|oder|bis)\s*+(?:lines?|zeilen?)?\s*+\d++)+)",
    re.IGNORECASE,
)
_LAST_LINE = re.compile(
    rf"^\W*(?:(?:it|is|in|the|es|ist|die)\b\W*)*(?:{'|'.join(_LAST)})(?:\W+(?:line|one|zeile))?\W*$", re.IGNORECASE
)


def _unspaced(text: str) -> str:
    return re.sub(r"\s+", "", keyboard_text(text)).replace("→", "->")


def _one_line_of(text: str) -> re.Match[str] | None:
    """The one line that is named in words that do not deny it.

    >>> [found and (found[1] or found[2]) for found in map(_one_line_of, ("line 4: 7", "i < 3, line 5", "not 3, line 5"))]
    ['4', '5', None]
    """
    found = _LINE_AND_WORDS.search(text)
    several = len(re.findall(r"\b(?:lines?|zeilen?)\b", text, re.IGNORECASE)) > 1
    return None if several or (_DENYING | _EXCLUDING) & {*_words(text.casefold())} else found


def _read_line(exercise: Exercise, answer: object) -> int:
    lines = exercise.text.strip("\n").splitlines()
    if isinstance(answer, str):
        typed = unquoted(answer)
        same = [number for number, line in enumerate(lines, 1) if _unspaced(line) == _unspaced(typed)]
        if len(same) == 1:
            return same[0]
        text = with_digits(keyboard_text(typed))
        number = _LINE_NUMBER.match(text) or _WRONG_LINE.search(text) or _one_line_of(text)
        if _LAST_LINE.match(typed):
            return len(lines)
        if _SEVERAL_LINES.fullmatch(text):
            raise ModelValueError(reply("line.one_needed"), hint=reply("line.choose", last=len(lines)))
        if not number:
            raise ModelValueError(reply("line.what_is_none", text=quoted(typed)), hint=reply("line.choose", last=len(lines)))
        answer = int(next(filter(None, number.groups())))
    if isinstance(answer, bool) or not isinstance(answer, Integral):
        raise ModelValueError(reply("line.needed", kind=kind_of(answer)))
    found = int(answer)
    if not 1 <= found <= len(lines):
        raise ModelValueError(reply("line.lines", last=len(lines)))
    return found


def _line_difference(exercise: Exercise, own: int, _: int) -> Difference:
    return Difference(f"{reply('line.not_this', number=own)} {exercise.otherwise}".strip())


LINE = AnswerKind(_read_line, _line_difference)
