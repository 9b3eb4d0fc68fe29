"""The texts of a lesson, one after another, and the lesson again with others in their place.

A walk goes through a notebook, a declaration or a page and asks `turn` of each text, and of its kind, what is to stand there.
Paragraphs, points of lists, cells of tables and headings are texts, each without its line breaks. Code is none, but for what
the questions of a lesson say in it; neither are ids, addresses, formulas.
"""

from __future__ import annotations

import ast
import json
import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import TypeAlias

from lsys_kit.classroom.authoring.written import python_tree

Turn: TypeAlias = Callable[[str, str], str]
"""What stands in the place of a text of a kind; most texts have none, which is empty."""

_FIXED = re.compile(
    r"^ {4}.*$|`[^`\n]*`|\$[^$\n]+\$|(?<=\])\([^()\s]*(?:\([^()\s]*\)[^()\s]*)*\)|\{\{[^{}]*\}\}|\{\w+\}|</?\w[^<>]*>",
    re.MULTILINE,
)
"""What a translation has as it is: code, formulas, addresses, names in braces, tags."""
_LETTER = re.compile(r"[^\W\d_]")
_FIGURE = re.compile(r"\d[\d.,]*+")


def fixed_parts(text: str) -> Counter[str]:
    """What a translation of a text must have as it is, and how often.

    >>> sorted(fixed_parts("Let `a` be $x$: [lesson 1](01.ipynb)"))
    ['$x$', '(01.ipynb)', '`a`']
    """
    return Counter(_FIXED.findall(text))


def figures(text: str) -> Counter[str]:
    """The numbers in digits that a text has beside those parts, without the marks in them, which differ between languages.

    >>> sorted(figures("`2` of 3,125, and 1.3"))
    ['13', '3125']
    """
    return Counter(re.sub("[.,]", "", found) for found in _FIGURE.findall(_FIXED.sub(" ", text)))


def has_words(text: str) -> bool:
    """Whether there is something to translate.

    >>> has_words("`F -> F`"), has_words("an `F`")
    (False, True)
    """
    return _LETTER.search(_FIXED.sub("", text)) is not None


def _turned(text: str, kind: str, turn: Turn) -> str:
    return turn(text, kind) if has_words(text) else text


# Texts as on a page

_QUOTE = re.compile(r"(?: {0,3}> ?)*")
_MARK = re.compile(r"\s*(?:#{1,6} +|(?:[-*+]|\d{1,9}[.)]) +)?")
_NEW = re.compile(r"\s*(?:#{1,6} |[-*+] |\d{1,9}[.)] |\||<|```|$)")
_SUMMARY = re.compile(r"(?<=<summary>)[^<>]*+(?=</summary>)")
_RULED = re.compile(r"[\s|:-]+")
_BAR = re.compile(r"(?<!\\)\|")
_BROKEN = re.compile(r"(?:  |\\)$")
HEADING, TABLE, ANSWER = "heading", "table", "answer"
"""Kinds of texts that a translator has to know: the names of sections; words in a table; what may be typed."""


def retext(text: str, turn: Turn) -> str:
    """A text of a page with others in place of its texts.

    >>> print(retext("## Why?\\n\\n- It grows\\n  in *steps*.\\n\\n> `F -> F`", lambda text, kind: f"({text})"))
    ## (Why?)
    <BLANKLINE>
    - (It grows in *steps*.)
    <BLANKLINE>
    > `F -> F`
    """
    lines = text.split("\n")
    return "\n".join(_pages(lines, turn))


def _pages(lines: list[str], turn: Turn) -> Iterator[str]:
    at = 0
    while at < len(lines):
        line, end = lines[at], at + 1
        quote = _prefix(_QUOTE, line)
        rest = line[len(quote) :]
        if rest.lstrip().startswith("```"):
            while end < len(lines) and not lines[end][len(quote) :].lstrip().startswith("```"):
                end += 1
            end = min(end + 1, len(lines))
            yield from lines[at:end]
        elif rest.lstrip().startswith("|"):
            yield quote + _row(rest, turn)
        elif _SUMMARY.search(rest):
            yield quote + _SUMMARY.sub(lambda found: _turned(found[0], "", turn), rest)
        elif not rest.strip() or (rest.lstrip().startswith("<") and not has_words(rest)):
            yield line
        else:
            while end < len(lines) and not _NEW.match(lines[end].removeprefix(quote)) and _prefix(_QUOTE, lines[end]) == quote:
                end += 1
            yield from _paragraph([each.removeprefix(quote) for each in lines[at:end]], quote, turn)
        at = end


def _prefix(pattern: re.Pattern[str], text: str) -> str:
    found = pattern.match(text)
    return found[0] if found else ""


def _paragraph(lines: list[str], quote: str, turn: Turn) -> Iterator[str]:
    mark = _prefix(_MARK, lines[0])
    lines = [lines[0][len(mark) :], *lines[1:]]
    *before, last = lines
    joined = "".join(_BROKEN.sub("", each).strip() + ("\n" if _BROKEN.search(each) else " ") for each in before) + last.strip()
    if not has_words(joined):
        yield from (quote + (mark if not at else "") + each for at, each in enumerate(lines))
        return
    indent = re.sub(r"\S", " ", mark)
    yield quote + mark + f"  \n{quote}{indent}".join(_turned(joined, HEADING if "#" in mark else "", turn).split("\n"))


def _row(row: str, turn: Turn) -> str:
    if _RULED.fullmatch(row):
        return row
    cells = _BAR.split(row)
    return "|".join(each.replace(each.strip(), _turned(each.strip(), TABLE, turn)) if each.strip() else each for each in cells)


# Texts in a declaration

Kinds: TypeAlias = "Mapping[str, str | Kinds]"
"""The entries that are texts, with their kinds."""
_SLIPS: Kinds = {"answer": ANSWER, "says": ""}
_CELLS: Kinds = {"": TABLE, "right": ANSWER, "slips": _SLIPS}
LESSON: Kinds = {
    **dict.fromkeys(("title", "question", "objectives", "summary", "misconceptions"), ""),
    "vote": {"question": "", "options": {"text": "", "reply": ""}},
    "tables": {"title": "", "columns": TABLE, "rows": _CELLS},
    "predictions": {"question": "", "answer": "", "right": ANSWER},
}
_EXERCISE = dict.fromkeys(("title", "question", "explanation", "hints", "otherwise", "unit"), "")
EXERCISES: Kinds = {
    **dict.fromkeys(("title", "objectives", "introduction", "summary"), ""),
    "exercise": {**_EXERCISE, "slips": {"says": ""}, "options": {"text": "", "says": ""}},
}


def redeclared(text: str, kinds: Kinds, turn: Turn, **more: str) -> str:
    """A declaration with others in place of its texts, and with more entries at its beginning.

    >>> redeclared('title = "Ferns"\\nminutes = 45', LESSON, lambda text, kind: text.upper())
    'title = "FERNS"\\nminutes = 45'
    """
    import tomlkit

    document = tomlkit.parse(text)
    _redeclare(document, kinds, turn, tomlkit.string)
    return "".join(f"{key} = {json.dumps(value)}\n" for key, value in more.items()) + tomlkit.dumps(document)


def _redeclare(
    entries: dict[str, object] | list[object], kinds: str | Kinds, turn: Turn, string: Callable[..., object]
) -> None:
    places: Iterator[tuple[object, object]] = iter([*enumerate(entries)] if isinstance(entries, list) else [*entries.items()])
    for place, value in places:
        of = kinds if isinstance(entries, list) or isinstance(kinds, str) else kinds.get(str(place))
        kind = of.get("") if isinstance(of, Mapping) else of
        if isinstance(value, dict | list):
            if of is not None:
                _redeclare(value, of, turn, string)
        elif isinstance(value, str) and isinstance(kind, str):
            old = value.strip("\n")
            if (new := _turned(old, kind, turn)) != old:
                entries[place] = string(new, multiline="\n" in value)  # type: ignore[index, call-overload]


# Texts in code

SAID: Mapping[str, tuple[str, ...]] = {
    "ask": ("question",),
    "predict": ("question", "what"),
    "vote": ("question", "options", "right", "", "replies"),
    "worksheet": ("", "", "", "columns", "rows", "title"),
}
"""Functions of lessons, and which of their arguments may be texts, in their order."""


def recode(source: str, turn: Turn) -> str:
    """A cell of code with others in place of what its questions say; all else is as it was.

    >>> recode('predict("How many?", draw("K5", 3))', lambda text, kind: "Wie viele?")
    'predict("Wie viele?", draw("K5", 3))'
    """
    lines = source.split("\n")
    texts = [] if source.startswith("%%") else [*_said(python_tree(source))]
    for node in sorted(texts, key=lambda node: (node.lineno, node.col_offset), reverse=True):
        old, end = str(node.value).strip(), node.end_lineno or node.lineno
        if (new := turn(old, "")) != old:
            first, last = lines[node.lineno - 1].encode(), lines[end - 1].encode()
            changed = first[: node.col_offset] + json.dumps(new, ensure_ascii=False).encode() + last[node.end_col_offset :]
            lines[node.lineno - 1 : end] = [changed.decode()]
    return "\n".join(lines)


def _said(tree: ast.Module | SyntaxError) -> Iterator[ast.Constant]:
    """The sentences that questions say: in their arguments, or in a name that is given to them."""
    if isinstance(tree, SyntaxError):
        return
    asked = set[str]()
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in SAID:
            names = SAID[node.func.id]
            given = [*zip(names, node.args, strict=False), *((each.arg, each.value) for each in node.keywords)]
            for value in (value for name, value in given if name in names and name):
                asked |= {value.id} if isinstance(value, ast.Name) else set()
                yield from _sentences(value)
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and any(isinstance(each, ast.Name) and each.id in asked for each in node.targets):
            yield from _sentences(node.value)


def _sentences(value: ast.expr) -> Iterator[ast.Constant]:
    """A text of more than one word, or those of a list; but nothing within a call."""
    if isinstance(value, ast.Constant) and isinstance(value.value, str):
        yield from [value] if " " in value.value.strip() and has_words(value.value) else []
    elif isinstance(value, ast.List | ast.Tuple):
        for each in value.elts:
            yield from _sentences(each)
