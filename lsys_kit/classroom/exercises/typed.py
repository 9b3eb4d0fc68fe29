"""What a person types, in the form that the kit's grammars read: characters, units, numbers, formulas, systems; none is run."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from numbers import Number
from typing import TypeVar

from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError, quotable, shown
from lsys_kit.files import toml_tables
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, normalised, number_text
from lsys_kit.translation import NUMBER, gettext

WORDS = toml_tables(__package__, "typed.toml")
"""Words and signs that people type, in English and German."""
_ASSIGNED = re.compile(r"^\s*+[A-Za-z_]\w*+\s*+(?:\([^()=]*\)\s*+)?=(?!=)\s*")
"""The beginning of `N(12) = 21` or `t = d - s`."""
ARROW = r"(?<![-=])[-=]++>|[→⟶⇒⟹↦]"
"""An arrow, however long."""
_OUTSIDE = re.compile(r"[^()]++\)?")
"""What stands between two parentheses, with the second if it closes one."""
_RAISED = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾ᵃᵇᶜᵈᵉᶠᵍʰⁱʲᵏˡᵐⁿᵒᵖʳˢᵗᵘᵛʷˣʸᶻ]+")
_ROOT_SIGN = re.compile(r"√\s*(?=\()|√\s*(\d+(?:\.\d+)?|[A-Za-z]\w*)")
_SIGNS = str.maketrans(WORDS["signs"])


KINDS_OF_VALUES: Mapping[type, str] = {
    bool: "True or False",
    int: "a whole number",
    float: "a number",
    Fraction: "a number",
    Decimal: "a number",
    str: "a text",
    list: "a list",
    tuple: "a list",
    dict: "a table of names and values",
}
"""What values are called in replies."""


def kind_of(value: object) -> str:
    """What a value is, in the words of a reply.

    >>> kind_of([1, 2]), kind_of(None)
    ('a list', 'NoneType')
    """
    return gettext(KINDS_OF_VALUES.get(type(value), "")) or type(value).__name__


def text_answer(answer: object, what: str, example: str) -> str:
    """An answer that must be a text."""
    if not isinstance(answer, str):
        raise ModelValueError(reply("typed.must_be_text", what=what, example=example, kind=kind_of(answer)))
    return answer


def keyboard_text(text: str) -> str:
    """A text in the characters of a keyboard: signs, raised digits, fractions and letters that have another form there.

    >>> keyboard_text("2·x² ≤ ½"), keyboard_text("2⁶−1"), keyboard_text("√169 + 1½"), keyboard_text("７０９")
    ('2*x^2 <= (1/2)', '2^6-1', 'sqrt(169) + (1+1/2)', '709')
    >>> keyboard_text("(2p)ⁿ"), keyboard_text("5ⁿ⁺¹"), keyboard_text("x⁻ᵖ")
    ('(2p)^n', '5^(n+1)', 'x^(-p)')
    """
    text = _RAISED.sub(_power, text.translate(_SIGNS))
    text = re.sub(r"(?<!\d)(\d+)\s*([¼-¾⅐-⅞])", lambda found: f"({found[1]}+{_fraction(found[2])})", text)
    text = re.sub(r"[¼-¾⅐-⅞]", lambda found: f"({_fraction(found[0])})", text)
    text = _ROOT_SIGN.sub(lambda found: f"sqrt({found[1]})" if found[1] else "sqrt", text)
    return "".join(unicodedata.normalize("NFKC", each) if each not in "…" else each for each in text)


def _power(found: re.Match[str]) -> str:
    exponent = unicodedata.normalize("NFKC", found[0]).replace("−", "-").removeprefix("+")
    return f"^{exponent}" if exponent.isdigit() or len(exponent) == 1 else f"^({exponent})"


def _fraction(sign: str) -> str:
    return unicodedata.normalize("NFKC", sign).replace("⁄", "/")


def unassigned(text: str) -> str:
    """A text without the name that it is assigned to.

    >>> unassigned("N(12) = 21"), unassigned("t == 5")
    ('21', 't == 5')
    """
    return _ASSIGNED.sub("", text, count=1)


def assigned_name(text: str) -> str:
    """The name to which a formula is assigned, or nothing.

    >>> assigned_name("t = d - s"), assigned_name("t == 5")
    ('t', '')
    """
    found = _ASSIGNED.match(text.strip().strip("$"))
    return found[0].partition("=")[0].partition("(")[0].strip() if found else ""


_LABEL = re.compile(r"(?<![\w.)\]])(?:[^\W\d]\w*(?:\s*\([^()]*\)|\s+\d+)?|\d+)\s*(?::|=(?![=>]))\s*")


def unlabelled(text: str) -> str:
    """A row without the names of its parts.

    >>> unlabelled("N(8) = 7, N(9) = 10"), unlabelled("0: 2, 1: 3"), unlabelled("a: 1 2, b: 1 0")
    ('7, 10', '2, 3', '1 2, 1 0')
    """
    return _LABEL.sub("", text)


def without_commas(text: str) -> str:
    """A text with blanks for the commas between its modules, which are outside parentheses.

    >>> without_commas("A(1, 2), b,b")
    'A(1, 2)  b b'
    """
    return _OUTSIDE.sub(lambda found: found[0] if found[0].endswith(")") else found[0].replace(",", " "), text)


def unquoted(text: str) -> str:
    """A text without the quotation marks around it.

    >>> unquoted("`br -> ar`"), unquoted("'a'"), unquoted("don't")
    ('br -> ar', 'a', "don't")
    """
    text = text.strip()
    while len(text) > 1 and text[0] == text[-1] and text[0] in "\"'`":
        text = text[1:-1].strip()
    return text


def quoted(answer: object) -> str:
    """What was typed, as a message quotes it."""
    return quotable(" ".join(answer.split())) if isinstance(answer, str) else shown(answer)


# Units


UNITS: Mapping[str, tuple[str, Value]] = {name: tuple(unit) for names, unit in WORDS["units"].items() for name in names.split()}
"""For each name of a unit what it measures, and how much of the first unit of that it is."""


def converted(number: Value, given: str, wanted: str) -> Value | None:
    """A number in another unit, exactly where the two are in proportion; None where they measure different things.

    >>> converted(2, "dm", "cm"), converted(1, "turn", "degrees"), converted(1, "cm", "degrees")
    (20, 360, None)
    """
    one, other = UNITS.get(given.lower()), UNITS.get(wanted.lower())
    if one is None or other is None or one[0] != other[0]:
        return None
    if one[1] == other[1]:
        return number
    if isinstance(one[1], int) and isinstance(other[1], int):
        return normalised(number * Fraction(one[1], other[1]))
    return float(number) * float(one[1]) / float(other[1])


def names_of(unit: str) -> frozenset[str]:
    """All names of a unit."""
    known = (frozenset(names.split()) for names in WORDS["units"])
    return next((names for names in known if unit.lower() in names), frozenset([unit.lower()]))


def means_the_same(one: str, other: str) -> bool:
    """Whether two nouns stand for the same thing that is counted.

    >>> means_the_same("cells", "letter"), means_the_same("cells", "walls")
    (True, False)
    """
    both = {one.lower().rstrip("s"), other.lower().rstrip("s")}
    return len(both) == 1 or any(both <= {*group.split()} for group in WORDS["same_thing"])


# Numbers in words


_NUMBERS = WORDS["numbers"]
_VALUES = {word: number for number, word in enumerate(_NUMBERS["small"].split())}
_VALUES |= {word: 10 * number for number, word in enumerate(_NUMBERS["tens"].split(), 2)}
_FACTORS: Mapping[str, int] = _NUMBERS["factors"]
_ORDINALS = {word: number for number, word in enumerate(_NUMBERS["ordinals"].split(), 1)}
_PARTS: Mapping[str, int] = _NUMBERS["parts"]
_ANY = "|".join([*_VALUES, *_FACTORS])
_RUN = re.compile(rf"\b(?:{_ANY})(?:(?:[\s-]+(?:and\s+)?)(?:{_ANY}))*\b", re.IGNORECASE)
_HUNDREDS = re.compile(rf"(?<![\w.,])(\d+(?:\.\d+)?)\s+({'|'.join(_FACTORS)})\b", re.IGNORECASE)
_PART = re.compile(rf"\b(\d+|a|ein)\s+({'|'.join(_PARTS)})s?\b", re.IGNORECASE)
_DOZEN = re.compile(rf"\b(\d+|an?|ein)\s+(?:{'|'.join(_NUMBERS['dozens'])})s?\b", re.IGNORECASE)
_ORDINAL = re.compile(rf"\b(?:({'|'.join(_ORDINALS)})|(\d+)(?:st|nd|rd|th))\b", re.IGNORECASE)
_GERMAN = _NUMBERS["german"]
_UNITS = {word: number for number, words in enumerate(_GERMAN["small"]) for word in words.split()}
_TENS = {word: 10 * number for number, words in enumerate(_GERMAN["tens"], 2) for word in words.split()}
_GERMAN_ORDINALS = {
    word + end: number for number, word in enumerate(_GERMAN["ordinals"].split(), 1) for end in ("e", "er", "es", "en", "em")
}
_COMPOUND = re.compile(rf"\b(?:{'|'.join([*_UNITS, *_TENS, 'hundert', 'tausend', 'und'])})+\b", re.IGNORECASE)
_GERMAN_ORDINAL = re.compile(rf"\b(?:{'|'.join(_GERMAN_ORDINALS)})\b", re.IGNORECASE)


def _of_compound(word: str) -> int | None:
    """The value of a German number in one word; None where it is none, as "ein", which is an article.

    >>> _of_compound("einundzwanzig"), _of_compound("zweihundertvierzig"), _of_compound("und"), _of_compound("tausenddrei")
    (21, 240, None, 1003)
    """
    for factor, name in ((1000, "tausend"), (100, "hundert")):
        before, found, after = word.partition(name)
        if found:
            many = 1 if before in ("", "ein") else _of_compound(before)
            rest = _of_compound(after.removeprefix("und")) if after else 0
            return None if many is None or rest is None else factor * many + rest
    before, found, after = word.partition("und")
    if found:
        one, ten = _UNITS.get(before, 0), _TENS.get(after, 0)
        return ten + one if 0 < one < 10 and ten else None
    return None if word == "ein" else _UNITS.get(word, _TENS.get(word))


def with_digits(text: str, ordinals: bool = True) -> str:
    """A text with digits for the numbers that are written as words, those of places with the others or not.

    >>> with_digits("twenty-one cells"), with_digits("seven hundred and nine"), with_digits("three quarters")
    ('21 cells', '709', '3/4')
    >>> with_digits("2, 3 and 5"), with_digits("the third line"), with_digits("19th step"), with_digits("a dozen leaves")
    ('2, 3 and 5', 'the 3 line', '19 step', '12 leaves')
    >>> with_digits("7 hundred"), with_digits("1.5 million"), with_digits("half"), with_digits("one zero")
    ('700', '1500000', '1/2', 'one zero')
    >>> with_digits("einundzwanzig Zellen"), with_digits("drei Viertel"), with_digits("im vierten Schritt")
    ('21 Zellen', '3/4', 'im 4 Schritt')
    """
    text = _HUNDREDS.sub(lambda found: number_text(normalised(Fraction(found[1]) * _FACTORS[found[2].lower()])), text)
    text = _COMPOUND.sub(lambda found: found[0] if (value := _of_compound(found[0].lower())) is None else str(value), text)
    if ordinals:
        text = _GERMAN_ORDINAL.sub(lambda found: str(_GERMAN_ORDINALS[found[0].lower()]), text)
    text = re.sub(r"^\s*(?:half|die\s+hälfte)\s*$", "1/2", text, flags=re.IGNORECASE)
    text = _PART.sub(
        lambda found: f"{found[1] if found[1].isdigit() else 1}/{_PARTS[found[2].lower()]}", _RUN.sub(_digits, text)
    )
    text = _DOZEN.sub(lambda found: str(12 * (int(found[1]) if found[1].isdigit() else 1)), text)
    return _ORDINAL.sub(lambda found: found[2] or str(_ORDINALS[found[1].lower()]), text) if ordinals else text


def _digits(found: re.Match[str]) -> str:
    """The value of a run of words; as it stands where it is none, as "two three"."""
    total = group = 0
    below = 1_000_000_000
    words = re.split(r"[\s-]+", found[0].lower())
    for word in words:
        if word in _FACTORS:
            factor = _FACTORS[word]
            total, group = (total, max(group, 1) * factor) if factor == 100 else (total + max(group, 1) * factor, 0)
            below = factor
        elif word != "and":
            value = _VALUES[word]
            if value >= below or (not value and len(words) > 1):
                return found[0]
            group += value
            below = 10 if value >= 20 and value < 100 else 1
    return str(total + group)


# Formulas


_FRACTION = re.compile(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}")
_ROOT = re.compile(r"\\sqrt\s*\{([^{}]*)\}")
_POWER = re.compile(r"\^\s*\{([^{}]*)\}")
_JOINED = (("and", "&&"), ("or", "||"), ("not", "!"), ("und", "&&"), ("oder", "||"), ("nicht", "!"))
_SPELT = (("plus", "+"), ("minus", "-"), ("times", "*"), ("mal", "*"), ("hoch", "^"), ("durch", "/"))
"""Words for the signs of a formula."""
_BARS = re.compile(r"(?<!\|)\|([^|<>=&!]++)\|(?!\|)")
_COLON, _COLONS = re.compile(r"(?<=[\w)])\s*+:\s*+(?=[\w(])"), re.compile(r":[\s\w.]*+:")
"""A colon for a division, and two between which there is no sign."""
_ROW_WITHOUT_BLANKS = re.compile(r"\d,\d++,|\(\s*+[-+]?\d++,\d++\s*+\)|(?<!\w)[A-Za-z]\w*+\s*+\([^(),]*+,")
"""Numbers or arguments with commas between them, which are no decimal commas."""
_POWER_OF = re.compile(r"\bpow\(([^(),]+),([^(),]+)\)")
_IMPLICIT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)\s*(?=[A-Za-z_(])|(?<=\))\s*(?=[\w(])")
_WORD = re.compile(r"[A-Za-z_]\w*")
MOST_NESTED = 20
"""Fractions within fractions that are read."""


def formula_text(text: str, names: Collection[str] = ()) -> str:
    """A formula as the kit writes it, from simple LaTeX, from Python's powers, without the name that it is assigned to.

    >>> formula_text("t = d - s**2"), formula_text(r"$\\frac{d + 1}{2} \\cdot s$"), formula_text("2s + 2(d - s)")
    ('d - s^2', '((d + 1)/(2)) * s', '2*s + 2*(d - s)')
    >>> formula_text("u n < vm or not m < 2", ["u", "n", "v", "m"]), formula_text("p(1 - p)", ["p"])
    ('u*n < v*m || ! m < 2', 'p*(1 - p)')
    >>> formula_text("(5^n-1):4"), formula_text("1,25*5^n - 0,25"), formula_text("hypot(5,12)")
    ('(5^n-1)/4', '1.25*5^n - 0.25', 'sqrt((5)^2+(12)^2)')
    >>> formula_text("|n - 2| + 1"), formula_text("y < 0 | x > 1")
    ('abs(n - 2) + 1', 'y < 0 || x > 1')
    """
    text = unassigned(keyboard_text(text).strip().strip("$").strip())
    for _ in range(MOST_NESTED):
        before = text
        for pattern, form in ((_FRACTION, r"((\1)/(\2))"), (_ROOT, r"sqrt(\1)"), (_POWER, r"^(\1)")):
            text = pattern.sub(form, text)
        if text == before:
            break
    for latex, plain in WORDS["latex"].items():
        text = text.replace(latex, plain)
    text = re.sub(r"(?<=[\w)])\s*\.\s*\Z", "", text)
    if not _COLONS.search(text):
        text = _COLON.sub("/", text)
    if not _ROW_WITHOUT_BLANKS.search(text):
        text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    for word, sign in _SPELT:
        text = re.sub(rf"(?<=[\w)])\s+{word}\s+(?=[\w(])", f" {sign} ", text, flags=re.IGNORECASE)
    text = _BARS.sub(r"abs(\1)", text)
    text = _POWER_OF.sub(r"((\1)^(\2))", _HYPOTENUSE.sub(r"sqrt((\1)^2+(\2)^2)", text))
    text = with_operators(text.replace("**", "^"), names)
    return _IMPLICIT.sub(lambda found: f"{found[1] or ''}*", _products_of(text, names)).strip()


def with_operators(text: str, names: Collection[str] = ()) -> str:
    """A condition with signs for its words.

    >>> with_operators("s > 5 and not s > 7 | s == 1")
    's > 5 && ! s > 7 || s == 1'
    """
    for word, sign in _JOINED:
        if word not in names:
            text = re.sub(rf"\b{word}\b", sign, text, flags=re.IGNORECASE)
    return re.sub(r"(?<!\|)\|(?!\|)", "||", re.sub(r"(?<!&)&(?!&)", "&&", text))


def _products_of(text: str, names: Collection[str]) -> str:
    """A formula with a sign between names of one letter that stand side by side."""
    if not names or not all(len(name) == 1 for name in names):
        return text
    spread = _WORD.sub(lambda found: "*".join(found[0]) if set(found[0]) <= set(names) else found[0], text)
    letters = "".join(map(re.escape, names))
    spread = re.sub(rf"(?<![A-Za-z_])([{letters}])\s*(?=\()", r"\1*", spread)
    return re.sub(rf"(?<![A-Za-z_])([{letters}]|\d)\s+(?=[{letters}](?!\w))", r"\1*", spread)


# Numbers


_EQUALS = re.compile(r"(?<![<>=!])=(?!=)|≈")
_GROUPED = re.compile(r"[+-]?\d{1,3}([ ']\d{3})+")
_COMMAS = re.compile(r"[+-]?\d{1,3}(,\d{3})+")
_DECIMAL_COMMA = re.compile(r"[+-]?(\d+,\d{1,2}|\d+,\d{4,}|0,\d+)")
_SCIENTIFIC = re.compile(r"(?<!\w)(\d+(?:\.\d+)?)[eE]([+-]?\d{1,3})(?!\w)")
_CONSTANTS: Mapping[str, float] = {"pi": math.pi, "π": math.pi}
_HYPOTENUSE = re.compile(r"\bhypot\(([^(),]+),([^(),]+)\)")
_COMPARISON = re.compile(r"[<>]|==|!=")
_SEVERAL = re.compile(
    rf"\d\s*+(?:and|und|or|oder|to|bis|{ARROW})\s*[-+]?\d|[-+*/]\s*+\d++\s*+=\s*+\d++\s*+[,;]\s*+\d[\d\s+*/-]*+="
)
"""Two numbers, a range, a chain, or two sums."""
_LABELLED = re.compile(
    rf"^\W*(?:(?:at|in|im|bei|after|nach)\s+)?(?:{'|'.join(WORDS['labels'].split())})\s*\d+\s*:\s*", re.IGNORECASE
)
"""What is before the number in "step 3: 64"."""
_REASONED = re.compile(r"(?<=[\d)%°])(?:\s++|\s*+[,;:]\s*+)(?:because|since|weil|denn|da)\b.*+\Z", re.IGNORECASE | re.DOTALL)
"""The reason behind a number."""
_CONCLUDED = re.compile(
    r"\A.*[,;.]\s(?:so|thus|hence|therefore|also|daher|folglich)\s++(?>(?:(?:it|there|es)\s++(?:is|are|sind)\s++)?)(?=[-+]?\d)",
    re.IGNORECASE,
)
"""What stands before a number that follows from it."""
_PLUS_OR_MINUS = re.compile(r"\d\s*+(?:±|\+-|\+/-)\s*+\d")
_SLASHES = re.compile(r"\s*+\d++(?>(?:\s*+/\s*+\d++){2,})\s*+")
"""A row with slashes."""
_FACTORIAL = re.compile(r"(?:(?<![\d.])(?:[3-9]|10)|\))\s*+!")
"""A small number with an exclamation mark, which may be a factorial."""
_RATIO_OF_THREE = re.compile(r"\d\s*+:\s*+\d[\d.]*+\s*+:\s*+\d")
_EQUATION = re.compile(r"(?=[^=]*+=[^=]*+\Z)[^=]*[^\W\d_]\b")
_GLUED = re.compile(r"\d([a-zA-Z])\s*$")
"""A number with one letter directly behind it, which is a product and no unit."""
_BESIDE_A_SIGN = re.compile(r"(?<![^\W_])([A-Za-z])(?![^\W_])\s*+[-+*/^]\s*+[\d(]|[\d)]\s*+[-+*/^]\s*+([A-Za-z])(?![\w(])")
"""A letter that is added or multiplied."""
_SENTENCE = re.compile(
    r"^(?P<before>(?>(?:(?!pi\b)[^\W\d_]++(?>(?:[\s:]|\.(?!(?<=[\s:]\.)\d))+))*))"
    r"(?P<number>(?>(?:.*(?:[^\w\s°%]|[°%](?!$)))?)(?:(?<=[)}])|[\w\s]*?(?:\d|(?<![A-Za-z])pi\b)))\s*"
    r"(?P<after>(?!pi\b)[^\W\d_][^\W\d]*(?:\s[\w\s]*)?|°|%)?$",
    re.DOTALL,
)
"""Words, a number, words: whatever has other signs belongs to the number."""
_REMARK = re.compile(r"(?<=\d)\s+\([^()\d]*\)\s*$")
"""What is said behind a number, as in "19 (nineteen)"."""
_REPLACED = (
    (re.compile(r"\bper\s+cent\b", re.IGNORECASE), "percent"),
    (re.compile(r"\bhalf\s+of\s+(?=\d)", re.IGNORECASE), "1/2*"),
    (re.compile(r"\b(?:no|nr)\.\s*(?=\d)", re.IGNORECASE), ""),
    (re.compile(r"°(?=\s*[-+*/:])"), ""),
    (re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)\s*+(?:%|percent|prozent)\s++(?:of|von)\s++(?=\d)", re.IGNORECASE), r"\1/100*"),
    (re.compile(r"(?<![\w.])(\d+\s*/\s*\d+|\d*\.\d+)\s++(?:of|von)\s++(?=\d)", re.IGNORECASE), r"\1*"),
    (re.compile(r"(?<=\d)\s+(?:out\s+of|of|in|von|aus)\s+(?=\d+\W*$)", re.IGNORECASE), "/"),
    (re.compile(r"^\s*\*\s*(?=[\d.])"), ""),
    (re.compile(r"(?<=[\d)])\s*:\s*(?=[\d(][^:]*\Z)"), "/"),
    (re.compile(r"(?<=\d)(?<!\b0)\s*x\s*(?=\d)"), "*"),
    (re.compile(r"(?<=\d)\s+squared\b", re.IGNORECASE), "^2"),
    (re.compile(r"(?<=\d)\s+cubed\b", re.IGNORECASE), "^3"),
    (re.compile(r"(?<![^\W\d_])phi\b|φ", re.IGNORECASE), "((1+sqrt(5))/2)"),
    (re.compile(r"(?<=\d)\.(?=\s+[^\W\d_]+$)"), ""),
    (re.compile(r"^\s*\[([^\[\],;]*)\]\s*$"), r"\1"),
    (re.compile(r"\bminus\s+(?=[\d.(])", re.IGNORECASE), "-"),
    (re.compile(r"\bplus\s+(?=[\d.(])", re.IGNORECASE), "+"),
    (re.compile(r"(?<=[\d)])\s*\b(?:times|mal)\s+(?=[\d.(])", re.IGNORECASE), "*"),
    (re.compile(r"(?<=[\d)])\s*\b(?:divided\s+by|geteilt\s+durch|durch)\s+(?=[\d.(])", re.IGNORECASE), "/"),
    (re.compile(r"(?<=\d)\s+(?:to\s+the\s+power(?:\s+of)?|hoch)\s+(?=\d)", re.IGNORECASE), "^"),
)


@dataclass(frozen=True)
class TypedNumber:
    """A number, and the words around it.

    Attributes
    ----------
    value
        The number, exactly where it was written exactly.
    before, after
        The words in front of it and behind it; what is behind it may be a unit.
    of_pi
        Whether it was written as a multiple of pi.
    """

    value: Value
    before: tuple[str, ...] = ()
    after: tuple[str, ...] = ()
    of_pi: bool = False


def typed_number(answer: object, decimal_comma: bool = False) -> TypedNumber:
    """A number as a person writes it, with the words around it; `decimal_comma` says what the comma in 1,272 is.

    >>> typed_number("N(12) = 21 cells").value, typed_number("1,000").value, typed_number(Decimal("0.5")).value
    (21, 1000, Fraction(1, 2))
    >>> typed_number("about .5").value, typed_number("No.5 .").value, typed_number("4 to the power of 3").value
    (Fraction(1, 2), 5, 64)
    >>> typed_number("one fifth of 360").value, typed_number("27 of 256").value, typed_number("10, since 8 is too short").value
    (72, Fraction(27, 256), 10)
    >>> typed_number("at step twenty-one"), typed_number("2π/5 rad").after
    (TypedNumber(value=21, before=('at', 'step'), after=(), of_pi=False), ('rad',))
    """
    if isinstance(answer, Decimal) and answer.is_finite():
        return TypedNumber(number_from(Fraction(answer)))
    if not isinstance(answer, str):
        try:
            return TypedNumber(_known(number_from(_evaluated(answer), "answer")))
        except ModelValueError:
            if isinstance(answer, Number):
                raise
            raise ModelValueError(reply("typed.no_number_but", kind=kind_of(answer))) from None
    text = _LABELLED.sub("", with_digits(_REMARK.sub("", unquoted(keyboard_text(answer)).strip("$ "))))
    if _FACTORIAL.search(text) or _RATIO_OF_THREE.search(text) or _PLUS_OR_MINUS.search(text):
        raise ModelValueError(reply("typed.unreadable", answer=quoted(answer)), hint=reply("typed.alone"))
    for pattern, plain in _REPLACED:
        text = pattern.sub(plain, text)
    text = _REASONED.sub("", _CONCLUDED.sub("", text))
    if _SEVERAL.search(text):
        raise ModelValueError(reply("typed.one_needed", answer=quoted(answer)), hint=reply("typed.alone"))
    fault: LSystemError | None = None
    for part in reversed([text] if _COMPARISON.search(text) else _EQUALS.split(text)):
        try:
            return _in_sentence(part.strip(" \t\n!~$").rstrip(" ."), answer, decimal_comma)
        except (ModelSyntaxError, ModelNameError, ModelValueError) as mistake:
            fault = fault or mistake
    if _EQUATION.match(text) and not _COMPARISON.search(text):
        raise ModelValueError(reply("typed.equation", answer=quoted(answer)), hint=reply("typed.alone"))
    raise fault or ModelValueError(reply("typed.number_needed"))


_SINGLE = re.compile(r"(?<![^\W\d_])(?!n\b)[^\W\d_](?!\w)(?!\s*\()")
_SIGN_BESIDE = re.compile(r"[-+*/^]")


def is_unsolved(text: str, known: Collection[str] = ()) -> bool:
    """Whether a text is one equation with a formula of an unknown name of one letter on one of its sides.

    >>> [is_unsolved(text) for text in ("1-p = 1/4", "50 + 50q = 90", "1 = x^-2 + x^-4", "p = 1/4", "N(3) = 8+13")]
    [True, True, True, False, False]
    """
    left, equals, right = text.partition("=")
    if not equals or "=" in right or re.search(r"[<>!]$", left):
        return False
    return any(
        bool({*_SINGLE.findall(side)} - {*known}) and _SIGN_BESIDE.search(side) and not re.search(r"[^\W\d_]{2}", side)
        for side in (left, right)
    )


def _evaluated(answer: object) -> object:
    """A number made with sympy, such as the root of 2, as a double; whole numbers and fractions are read as they are."""
    if getattr(answer, "is_number", False) is True and getattr(answer, "is_Rational", True) is False:
        with suppress(TypeError, ValueError, OverflowError):
            return float(answer)  # type: ignore[arg-type]
    return answer


def _in_sentence(text: str, answer: str, decimal_comma: bool) -> TypedNumber:
    beside = _BESIDE_A_SIGN.search(text)
    if beside:
        raise ModelValueError(
            reply("typed.letter", answer=quoted(answer), letter=beside[1] or beside[2]), hint=reply("typed.its_value")
        )
    found = _SENTENCE.match(text)
    if not found:
        said, hint = ("unreadable", "alone") if any(map(str.isdigit, text)) else ("no_number", "digits")
        raise ModelValueError(reply(f"typed.{said}", answer=quoted(answer)), hint=reply(f"typed.{hint}"))
    number = formula_text(_plain(found["number"].strip(), decimal_comma))
    of_pi = "pi" in number
    if _COMPARISON.search(number):
        raise ModelValueError(reply("typed.condition", answer=quoted(answer)), hint=reply("typed.alone"))
    if any(map(str.isdigit, found["after"] or "")):
        raise ModelValueError(reply("typed.one_needed", answer=quoted(answer)), hint=reply("typed.alone"))
    letter = _GLUED.search(text)
    if letter and letter[1].lower() not in UNITS:
        raise ModelValueError(reply("typed.letter", answer=quoted(answer), letter=letter[1]), hint=reply("typed.its_value"))
    for name, constant in _CONSTANTS.items():
        number = re.sub(rf"\b{name}\b", f"({constant!r})", number)
    value = _value(number, answer)
    before, after = (tuple(re.findall(r"[^\W\d_]+|[°%]", found[part] or "")) for part in ("before", "after"))
    return TypedNumber(value, before, after, of_pi)


def _value(number: str, answer: str) -> Value:
    try:
        return _known(number_from(number, "answer"))
    except (ModelSyntaxError, ModelNameError):
        raise ModelValueError(reply("typed.unreadable", answer=quoted(answer)), hint=reply("typed.alone")) from None


_POINTS = re.compile(r"[+-]?\d{1,3}(\.\d{3})+")
_POINTS_AND_COMMA = re.compile(r"[+-]?\d{1,3}(\.\d{3})+,\d+")


def _plain(text: str, decimal_comma: bool) -> str:
    text = _SCIENTIFIC.sub(r"\1*10^(\2)", text)
    if gettext(NUMBER)[-2] == ",":  # as in 1.234,5
        if _POINTS_AND_COMMA.fullmatch(text) or (_POINTS.fullmatch(text) and not decimal_comma):
            text = text.replace(".", "")
        if text.count(",") == 1 and re.fullmatch(r"[+-]?\d+,\d+", text):
            return text.replace(",", ".")
    if _DECIMAL_COMMA.fullmatch(text) or (decimal_comma and text.count(",") == 1 and _COMMAS.fullmatch(text)):
        return text.replace(",", ".")
    return re.sub(r"[, ']", "", text) if _COMMAS.fullmatch(text) or _GROUPED.fullmatch(text) else text


def _known(number: Value) -> Value:
    if is_symbolic(number):
        raise ModelValueError(reply("typed.no_value", text=quotable(str(number))))
    return number


# Rows

_MATRIX = re.compile(r"\\(?:begin|end)\s*\{[^{}]*\}|\b(?:np\.)?(?:Matrix|matrix|array)\b")
_RANGE = re.compile(r"^[^\W\d]+\s+\d+\s*(?:to|bis|-|\.\.)\s*\d+\s*:\s*")
"""What a row is of, as in "steps 0 to 5:"."""
_BETWEEN = re.compile(rf"\\\\|{ARROW}|\band\b|(?<=\s)/(?=\s)|(?<=\d\s)-(?=\s)")


def parts(answer: object, what: str) -> list[object]:
    """The parts of a row or table, in order: of a text what stands between commas, semicolons, bars, brackets, blanks.

    >>> parts("[[1, 1], [1, 0]]", "Numbers"), parts((1, 2), "Numbers")
    (['1', '1', '1', '0'], [1, 2])
    >>> parts("N(0) = one, N(1) = 2 and N(2) = 3", "Numbers"), parts(21, "Numbers")
    (['1', '2', '3'], [21])
    >>> parts("one two, zero one", "Numbers")
    ['1', '2', '0', '1']
    """
    if isinstance(answer, str):
        if _RATIO_OF_THREE.search(answer) or _SLASHES.fullmatch(answer):
            answer = re.sub("[:/]", ",", answer)
        text = _BETWEEN.sub(",", _MATRIX.sub(" ", _RANGE.sub("", with_digits(unquoted(keyboard_text(answer))))))
        return [with_digits(part) for part in re.split(r"[\s,;|\[\](){}&]+", unlabelled(text)) if part.strip(".")]
    return list(_flat(answer, what))


def _flat(answer: object, what: str, depth: int = 0) -> Iterable[object]:
    if hasattr(answer, "tolist") and callable(answer.tolist):
        answer = answer.tolist()
    if isinstance(answer, Mapping):
        answer = list(answer.values())
    if depth and isinstance(answer, str) and re.search(r"\d[\s,]+\d", answer):
        yield from parts(answer, what)
        return
    if depth > 3 or isinstance(answer, str | bytes) or not isinstance(answer, Iterable):
        if depth == 0 and (not isinstance(answer, Number) or isinstance(answer, bool)):
            raise ModelValueError(reply("typed.parts_needed", what=what, kind=kind_of(answer)))
        yield answer
        return
    for number, part in enumerate(answer):
        if number > 10_000:
            raise ModelValueError(reply("typed.too_many_parts", what=what))
        yield from _flat(part, what, depth + 1)


# Systems


Read = TypeVar("Read")
_ERASED = re.compile(r"(->|→)[ \t]*(?:\"\"|''|\\(?:var)?epsilon\b|\bepsilon\b|λ|∅)[ \t]*$", re.MULTILINE)
_IN_A_WORD = re.compile(r"(->|→)[ \t]*(?:empty|nothing)[ \t]*$", re.MULTILINE | re.IGNORECASE)
_NOTHING = re.compile(r"(->|→)[ \t]*$", re.MULTILINE)
_FULL_STOP = re.compile(r"(?<=[\w\])])[.;,][ \t]*$", re.MULTILINE)
_NEXT_LINE = re.compile(r";[ \t]*(?!\n)|,[ \t]*+(?=[^,;\n]*?(?:->|→))")
_SETTING = re.compile(r"^([ \t]*(?:axiom|angle|heading|length))[ \t]*=", re.MULTILINE | re.IGNORECASE)
_OTHER_ARROW = re.compile(r"(?<![-=<>])=++>|[⟶⇒⟹↦]")
"""An arrow in a line that has no other one: before an arrow => may be meant as >=."""
_ARROW_OR_END = re.compile(r"->|→|$")
_ARGUMENTS = re.compile(r"\([^()\n]*\)")
_PRODUCT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)[ \t]*(?=[A-Za-z(])|(?<=\))[ \t]*(?=[A-Za-z(])")
_COMMA_FOR_COLON = re.compile(
    r"^([ \t]*+[A-Za-z]\w*+[ \t]*+\([^()\n]*+\))[ \t]*+,((?=[^,:()\n]*?(?:[<=]|(?<!-)>))[^,:()\n]*?)(?=->|→)", re.MULTILINE
)
"""A condition behind a comma."""
_COMMENTS = {
    "#": re.compile(r"(?<=[\w)\]])[ \t]++#[ \t][^\n]*+$", re.MULTILINE),
    "/": re.compile(r"(?<=[\w)\]])[ \t]++//[ \t]++[^\W\d_]{2}[^\n]*+$", re.MULTILINE),
}
"""For a sign what is said behind it, where it is no symbol."""
_CALLED = re.compile(
    r"^[ \t]*+(?:(?:the|my|die|meine)[ \t]++)?(?:(?:missing|right|new|correct|fehlende|richtige|neue)[ \t]++)?"
    r"(?:rule|production|line|answer|regel|produktion|zeile|antwort)(?:[ \t]++(?=\d)\d{1,2}(?=[ \t]*+:))?"
    r"(?:[ \t]++(?:is|ist)\b[ \t]*+:?[ \t]*+|[ \t]*+:[ \t]*+|[ \t]++)(?=[^\n]*?(?:->|→))",
    re.IGNORECASE | re.MULTILINE,
)
"""What a production is called in front of it."""
_COMMA_OF_A_SETTING = re.compile(r"^([ \t]*+[A-Za-z]\w*+[ \t]*+[:=][ \t]*+\d++),(?=\d++[ \t]*+°?[ \t]*$)", re.MULTILINE)
_FIRST_WORD = re.compile(r"^\s*+[^\n:=>→]++\n(?=[^\n]*(?:->|→))")


def read_typed(text: str, reader: Callable[[str], Read], known: str = "") -> Read:
    """What a reader makes of a system; where it cannot be read as it stands, in the form that the kit writes.

    `known` is what the question itself says, whose symbols mean themselves.

    >>> from lsys_kit.notation.read import read
    >>> print(read_typed("axiom = F; F => F[+F]F.", read))
    axiom: F
    F -> F[+F]F
    """
    text = _cleaned(text, known)
    try:
        return reader(text)
    except LSystemError as mistake:
        try:
            return reader(_spelt_out(text))
        except LSystemError:
            raise mistake from None


def without_comments(text: str, known: str = "") -> str:
    """A text without what is said behind its lines; `known` is a text in which a sign is a symbol.

    >>> without_comments("br -> ar  # long again"), without_comments("bl ar // the last"), without_comments("F // FF", "F / F")
    ('br -> ar', 'bl ar', 'F // FF')
    """
    for sign, comment in _COMMENTS.items():
        text = text if sign in known else comment.sub("", text)
    return text


def _cleaned(text: str, known: str) -> str:
    """A text without what no notation means: quotation marks around it, what a production is called, full stops, comments.

    >>> _cleaned("the rule B -> C.", ""), _cleaned("angle: 25,7", "")
    ('B -> C', 'angle: 25.7')
    """
    text = without_comments(unquoted(text), known)
    text = _COMMA_OF_A_SETTING.sub(r"\1.", _CALLED.sub("", text))
    text = text.replace(r"\rightarrow", "->").replace(r"\to", "->").replace("−>", "->").replace("–>", "->")
    text = "\n".join(line if re.search("->|→", line) else _OTHER_ARROW.sub("->", line) for line in text.split("\n"))
    text = _ERASED.sub(r"\1 ε", text)
    if not re.search(r"\b(empty|nothing)\b", known):
        text = _IN_A_WORD.sub(r"\1 ε", text)
    return text if _FULL_STOP.search(known) else _FULL_STOP.sub("", text)


def _spelt_out(text: str) -> str:
    """A text as the kit writes it.

    >>> _spelt_out("axiom: M(1), M(x) : x > 1 and x < 3 -> M(2x)")
    'axiom: M(1)\\nM(x) : x > 1 && x < 3 -> M(2*x)'
    >>> _spelt_out("a\\na -> a, b\\nb ->")
    'axiom: a\\na -> a b\\nb -> ε'
    """
    text = re.sub(ARROW, "->", text).replace("°", "").strip()
    text = _SETTING.sub(r"\1:", _NEXT_LINE.sub("\n", _COMMA_FOR_COLON.sub(r"\1 : \2", text)))
    text = without_commas(_NOTHING.sub(r"\1 ε", text))
    text = "\n".join(map(_with_signs, text.split("\n")))
    return f"axiom: {text}" if _begins_with_word(text) else text


def _begins_with_word(text: str) -> bool:
    """Whether the first line is a word: all its letters stand in the productions below.

    >>> _begins_with_word("ab\\na -> ab"), _begins_with_word("a to b\\na -> ab")
    (True, False)
    """
    word, _, rules = text.partition("\n")
    return bool(_FIRST_WORD.match(text)) and {*re.findall(r"[^\W\d_]", word)} <= {*rules}


_SINGLE_EQUALS = re.compile(r"(?<![<>=!])=(?![=<>])")


def _with_signs(line: str) -> str:
    """A line with signs for the words and the products in its arguments and its condition."""
    arrow = _ARROW_OR_END.search(line)
    assert arrow
    before, colon, condition = line[: arrow.start()].partition(":") if arrow[0] else (line, "", "")
    made = _in_arguments(line[arrow.start() :]) if arrow[0] else ""
    return _in_arguments(before) + _signs(colon + _SINGLE_EQUALS.sub("==", condition)) + made


def _in_arguments(text: str) -> str:
    return _ARGUMENTS.sub(lambda found: _signs(found[0]), text)


def _signs(formula: str) -> str:
    return _PRODUCT.sub(lambda found: f"{found[1] or ''}*", with_operators(formula))
