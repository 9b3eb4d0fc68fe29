r"""Typographic signs as they are typed, for all notations, before anything is read.

Books, pages and word processors have many signs for one: full-width letters, thin spaces, rings for degrees, ligatures, soft
hyphens. What can only mean one thing becomes that, character by character; errors are shown in the text that was pasted.

    >>> keyboard_signs("angle： 25.7◦, oﬃce").text
    'angle: 25.7°, office'
"""

from __future__ import annotations

import html
import re
import unicodedata
from itertools import takewhile

from lsys_kit.notation.syntax.text.statements import LABEL
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, edited

_ALIKE = {
    **{code: chr(code - 0xFEE0) for code in range(0xFF01, 0xFF5F)},  # full-width signs
    **dict.fromkeys(map(ord, "◦∘º˚⁰"), "°"),
    **dict.fromkeys(map(ord, "\v\f\x85\u2028\u2029"), "\n"),
    **dict.fromkeys(
        map(ord, "\u00a0\u1680\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200a\u202f\u205f\u3000"), " "
    ),
}
"""Signs that mean the same in every notation, one for one."""
_NO_MORE = re.compile(
    "[\u00ad\u200b-\u200f\u202a-\u202e\u2060\u2066-\u2069\ufe0e\ufe0f\ufeff]"
    "|[\ufb00-\ufb06]|[¼-¾⅐-⅞]|(?<=«)[ \u00a0\u2009\u202f]|[ \u00a0\u2009\u202f](?=»)"
)
"""What is seen and not typed, ligatures, fractions that are one sign, and the blanks within the quotation marks of French."""
_MARGIN = re.compile(r"^(?>(?:[ \t>]|(?://|[#;%])(?=[ \t]))*)(?=\S)", re.MULTILINE)
"""What stands before a line: blanks, a sign for each time that it was quoted in an answer to a letter, that of a comment."""
_END_OF_LINE = re.compile(r"(?<![ \t])[ \t]++$", re.MULTILINE)
_CONTINUED = re.compile(r"(?<!\\)\\[ ]?\n[ \t]*+(?=[^\n:=<>→\\]++(?:\\[ ]?)?(?:\n|\Z))")
"""Where a line goes on below, as in programs."""
_DECIMALS = {"¼": ".25", "½": ".5", "¾": ".75"}
"""Such fractions behind a digit."""
_LONG_DASH = re.compile(r"(?<=[\w)*])[ \t]*+[-−–—]{1,2}(?=→)")
"""What lengthens an arrow."""
_ARROW_BELOW = re.compile(r"\n[ \t>]*+(?:[-−–—]{1,2})?(?=→)")
_HEAD_ALONE = re.compile(
    rf"[ \t*>]*+(?:(?:{LABEL}|[pP])[ \t]*+:[^\n→]{{1,100}}"
    r"|[A-Za-z](?:_?\w)?(?:\([^()\n]{0,60}\))?[ \t]*+(?:\(?(?:\d?\.\d++|\d{1,3}[ ]?%)\)?)?[ \t]*+)"
)
"""What is replaced, alone on its line, with its probability."""
_SIGNS = str.maketrans(
    {**_ALIKE, **dict(zip(map(ord, "−–—‒‐‑﹣∗＊⁎’‘ʼ′ˈ“”„‟«»″ˆ∧⋀∕⁄∼˜"), '-------***\'\'\'\'\'"""""""^^^//~~', strict=True))}
)
"""The same, and signs that the notations read each in its own way: minus signs, quotation marks, wedges."""
_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_LETTERS_BELOW = re.compile("[ₐₑₒₓₕₖₗₘₙₚₛₜᵢᵣᵤᵥⱼ]")
"""Subscripts that are letters: F with an l below it is the symbol F_l."""
_ENTITY = re.compile(r"&(?:#\d{1,7}|#[xX][0-9a-fA-F]{1,6}|[A-Za-z]{2,8});")
TAG = re.compile(
    r"<(/?)(b|i|u|tt|td|tr|th|table|tbody|p|br|sub|sup|em|strong|code|pre|div|span|html|head|body|img|font|h[1-6]|li|ul|ol|dl|dt|dd|a|center|hr|math|nowiki|var|kbd|samp|small|big)"
    r"\b[^<>]{0,500}>",
    re.IGNORECASE,
)
_ENDS = frozenset(("br", "p", "tr", "div", "li", "dt", "h1", "h2", "h3", "h4", "h5", "h6", "hr", "pre", "table"))
"""Tags that end a line."""
_BEHIND = {"dt": ": ", "td": "\t", "th": "\t"}
"""What stands behind a term, and behind a cell."""


def keyboard_signs(source: str) -> Transcript:
    """A page's text as one would type it: also minus signs, quotation marks and subscripts, and no tags and entities.

    >>> keyboard_signs("F&minus;F &rarr; “G”<br>").text
    'F-F → "G"\\n'
    """
    text = long_arrows(source.translate(_SIGNS).translate(_SUBSCRIPTS).replace("\r", " "))
    minus = {match.start() for match in _HYPHEN.finditer(source)} if not _MINUS.search(text) else set()
    edits = [Edit(*each.span(), "-") if each.start() in minus else _plain(each) for each in _NO_MORE.finditer(source)]
    edits += without_margin(text)
    edits += [Edit(*match.span(), "") for pattern in (_END_OF_LINE, _CONTINUED) for match in pattern.finditer(text)]
    if not source.isascii():
        edits += [Edit(*match.span(), f"_{unicodedata.normalize('NFKC', match[0])}") for match in _LETTERS_BELOW.finditer(text)]
    if "&" in source:
        edits += [Edit(*match.span(), html.unescape(match[0]).translate(_SIGNS)) for match in _ENTITY.finditer(text)]
    if "<" in source:
        edits += [Edit(*match.span(), _tag(text, match)) for match in TAG.finditer(text) if not _is_context(text, match)]
    return edited(source, edits, typed=text)


def without_margin(text: str) -> list[Edit]:
    r"""The edits that take off what stands before every line: blanks, or signs of what is quoted.

    >>> without_margin("> A\n>  B")
    [Edit(start=0, end=2, text=''), Edit(start=4, end=6, text='')]
    """
    lines = [*_MARGIN.finditer(text)]
    same = (len({*signs}) == 1 for signs in zip(*(line[0] for line in lines), strict=False))
    size = sum(takewhile(bool, same))
    return [Edit(line.start(), line.start() + size, "") for line in lines] if size else []


def long_arrows(text: str) -> str:
    r"""A text as long as before, with one sign for an arrow that print makes of two, and behind what it replaces.

    >>> long_arrows("p1 : F −→ FF\np2 : f .5\n−→ ff")
    'p1 : F  → FF\np2 : f .5  → ff'
    """
    if "→" not in text:
        return text
    text = _ARROW_BELOW.sub(lambda match: " " * len(match[0]) if _HEAD_ALONE.fullmatch(_line_before(match)) else match[0], text)
    return _LONG_DASH.sub(lambda match: " " * len(match[0]), text)


def _line_before(match: re.Match[str]) -> str:
    return match.string[match.string.rfind("\n", 0, match.start()) + 1 : match.start()]


def _is_context(text: str, tag: re.Match[str]) -> bool:
    """Whether a tag of one letter is a symbol between its contexts, a<b>c."""
    alone = len(tag[0]) == 3 and text[: tag.start()][-1:].isalnum()
    return alone and re.search(f"</{tag[2]}\\b", text, re.IGNORECASE) is None


def _tag(text: str, tag: re.Match[str]) -> str:
    """What is written for a tag: the end of a line, or a sign; within a table of Markdown a semicolon."""
    if tag[1] and (sign := _BEHIND.get(tag[2].lower())):
        return sign
    if tag[2].lower() not in _ENDS:
        return ""
    return " ; " if text.rfind("|", max(0, tag.start() - 200), tag.start()) > text.rfind("\n", 0, tag.start()) else "\n"


_MINUS, _HYPHEN = re.compile(r"-(?![->])"), re.compile("(?<![a-zß-ÿ])\u00ad(?!\\s|\\Z)")
"""A minus sign, and what has no other meaning where a text has none: fonts have the sign that parts a word for it."""


def _plain(match: re.Match[str]) -> Edit:
    sign, after_digit = match[0], match.string[match.start() - 1 : match.start()].isdigit()
    plain = _DECIMALS[sign] if after_digit and sign in _DECIMALS else unicodedata.normalize("NFKC", sign).translate(_SIGNS)
    return Edit(*match.span(), plain if plain.isascii() and plain.strip() else "")
