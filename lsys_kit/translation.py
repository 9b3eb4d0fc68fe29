"""Texts in other languages, by gettext: the English text is the id of its translation, and stands where there is none.

A language is a folder `locale/LANGUAGE/LC_MESSAGES` with a catalogue `lsys_kit.po`, and the same compiled, `lsys_kit.mo`.
`python -m tests.messages` renews them all from the texts of the kit; `python -m tests.messages fr` begins another language.
The language is chosen by `language`, or by the environment variable LSYS_KIT_LANGUAGE, and never taken from the system, so that
what is displayed is the same on every machine.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from gettext import GNUTranslations, NullTranslations
from pathlib import Path

from lsys_kit.errors import ModelNameError, quotable, shown, speak_by

LOCALE = Path(__file__).parent / "locale"
ENGLISH = "en"
VARIABLE = "LSYS_KIT_LANGUAGE"

_chosen: list[str] = []


def language(name: str | None = None) -> str:
    """The language in which exercises are asked and answers are replied to; with a name, choose it.

    The names of the views and controls of panels that are made from then on, and the pages for learning platforms, are in it,
    too, and what is said of mistakes in systems and in commands, of the steps that `explain` explains, and of the systems that
    `infer` finds. The line with the size of a system in a panel stays in English.

    Parameters
    ----------
    name
        Its code: "en" for English, which is chosen at the beginning, or "de" for German. A code with a country, as "de_AT",
        is taken for its language. A text without a translation is shown in English.

    Returns
    -------
    str
        The code of the language that is chosen now.

    Raises
    ------
    ModelNameError
        There is no translation into this language.

    Examples
    --------
    >>> from lsys_kit import check
    >>> language("de")
    'de'
    >>> check("1.1", "bl ar bl ar ar")
    Richtig.
    >>> language("en")
    'en'
    """
    if name is not None:
        _chosen[:] = [_known(name)]
    if not _chosen:
        _chosen[:] = [ENGLISH]  # in which it is said that the variable names no language
        try:
            _chosen[:] = [_known(os.environ.get(VARIABLE) or ENGLISH)]
        except ModelNameError:
            _chosen.clear()
            raise
    return _chosen[0]


def languages() -> tuple[str, ...]:
    """The codes of the languages that there are."""
    return ENGLISH, *sorted(path.parent.parent.name for path in LOCALE.glob("*/LC_MESSAGES/lsys_kit.mo"))


def _known(name: object) -> str:
    code = code_of(name) if isinstance(name, str) else None
    if code is not None and code in languages():
        return code
    wanted = f'"{quotable(name)}"' if isinstance(name, str) else shown(name)
    hint = f"Languages are: {', '.join(languages())}. They are chosen by language(...) or the environment variable {VARIABLE}."
    raise ModelNameError(f"There is no language {wanted}", hint=hint)


def code_of(name: str) -> str:
    """The code of a language, without that of a country.

    >>> code_of("de-AT")
    'de'
    """
    return name.strip().replace("-", "_").partition("_")[0].lower()


@contextmanager
def spoken(name: str) -> Iterator[None]:
    """A `with` block in which a language is chosen."""
    before = [*_chosen]
    try:
        language(name)
        yield
    finally:
        _chosen[:] = before


@cache
def _catalogue(code: str) -> NullTranslations:
    if code == ENGLISH:
        return NullTranslations()
    with (LOCALE / code / "LC_MESSAGES" / "lsys_kit.mo").open("rb") as file:
        return GNUTranslations(file)


def gettext(message: str, /, **values: object) -> str:
    """A text in the chosen language, with values in the place of its names in braces; without values as it is. A value between
    quotation marks is what was typed, or a name, and stands as it is; others that are numbers are written as the language does.

    >>> gettext("You have {number} words", number=3)
    'You have 3 words'
    """
    found = _catalogue(language()).gettext(message) if message else message
    return found.format(**_written(message, values)) if values else found


def ngettext(singular: str, plural: str, number: int, /, **values: object) -> str:
    """A text whose form depends on a number, which it has by the name `number`.

    >>> ngettext("{number} place", "{number} places", 1), ngettext("{number} place", "{number} places", 2)
    ('1 place', '2 places')
    """
    return _catalogue(language()).ngettext(singular, plural, number).format(number=number, **_written(plural, values))


NUMBER = "1,234.5"
"""How a number is written: its translation shows the signs between thousands and before decimals."""
_NUMBER = re.compile(r"-?\d[\d,]*(?:\.\d+)?(?:e[+-]?\d+)?(?= [^\W\d]|$)")


_QUOTED = re.compile(r"\"\{(\w+)\}")
"""What was typed, and stands between quotation marks."""


def number_text(text: str) -> str:
    """A number in the chosen language, perhaps with a unit behind it; any other text as it is.

    >>> number_text("1,234.5 cm"), number_text("A(0.5)")
    ('1,234.5 cm', 'A(0.5)')
    """
    signs = gettext(NUMBER)
    if signs == NUMBER or not (found := _NUMBER.match(text)):
        return text
    return found[0].translate(str.maketrans(",.", signs[1] + signs[-2])) + text[found.end() :]


def _written(text: str, values: Mapping[str, object]) -> dict[str, object]:
    """Values of a text as they are written in the chosen language."""
    quoted = _QUOTED.findall(text)
    return {
        name: number_text(value) if isinstance(value, str) and name not in quoted else value for name, value in values.items()
    }


# What errors say


FORMS = LOCALE / "errors.json"
"""What errors say, with names in braces for the values: `python -m tests.messages` finds it where they are raised."""
_PLACEHOLDER = re.compile(r"\{(\w+)\}")


@cache
def _forms() -> tuple[tuple[str, str], ...]:
    """Each form with the longest of its texts; those with the most text of their own first, which say most of a message."""
    found = [(form, _PLACEHOLDER.split(form)[::2]) for form in json.loads(FORMS.read_text("utf-8"))]
    found.sort(key=lambda each: -sum(map(len, each[1])))
    return tuple((_unescaped(max(texts, key=len)), form) for form, texts in found)


@cache
def _fixed() -> Mapping[str, str]:
    """The forms without values, by what they say."""
    return {_unescaped(form): form for _, form in _forms() if not _PLACEHOLDER.search(form)}


def _unescaped(text: str) -> str:
    return text.replace("{{", "{").replace("}}", "}")


@cache
def _parts(form: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The texts of a form, and the names of the values between them."""
    parts = _PLACEHOLDER.split(form)
    return tuple(map(_unescaped, parts[::2])), tuple(parts[1::2])


def _values(form: str, said: str) -> dict[str, str]:
    """The values in a message of a form, each as short as can be; none where the message is of another form.

    >>> _values('"{name}" has no field {field}', '"a b" has no field c'), _values("{a} and {b}", "a or b")
    ({'name': 'a b', 'field': 'c'}, {})
    """
    (first, *middle), names = _parts(form)
    if not names or not (said.startswith(first) and said.endswith(middle[-1])):
        return {}
    found, at = [], len(first)
    for text in middle[:-1]:
        place = said.find(text, at)
        if place < 0:
            return {}
        found.append(said[at:place])
        at = place + len(text)
    end = len(said) - len(middle[-1])
    return dict(zip(names, [*found, said[at:end]], strict=True)) if at <= end else {}


MOST_RETOLD = 2_000
"""The most characters of a message of which it is found out which one it is."""


def retold(said: str) -> str:
    """What an error says, in the chosen language: it is found out of which form it is, and that is translated.

    So a place that raises an error writes its text, and need not know of languages.

    >>> retold('There is no arithmetic called "real"')
    'There is no arithmetic called "real"'
    """
    return said if language() == ENGLISH or len(said) > MOST_RETOLD else _retold(said)


def _retold(said: str) -> str:
    if form := _fixed().get(said):
        return _unescaped(gettext(form))
    if " " not in said:
        return said
    for longest, form in _forms():
        if longest in said and (values := _values(form, said)):
            typed = _QUOTED.findall(form)
            return gettext(form, **{name: value if name in typed else _retold(value) for name, value in values.items()})
    for end in (":", "."):
        head, there, rest = said.partition(f"{end} ")
        mark = end * (end == ".")
        if there and (told := _retold(head + mark)) != head + mark:
            return f"{told.removesuffix(mark)}{there}{_retold(rest)}"
    return said


speak_by(gettext, retold)
