"""The scripts of the panel, joined into one text: a widget and a page without a kernel each take a single module.

The scripts are modules of JavaScript that import one another by name. Joined, each is a function of its own that returns what
the module exports, so that their other names do not meet.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from graphlib import TopologicalSorter
from importlib.resources import files
from importlib.resources.abc import Traversable
from string import Template
from typing import Any, TypeAlias

from lsys_kit.pictures.style.themes import DARK, DARK_LINES, LIGHT, Theme
from lsys_kit.translation import ENGLISH, gettext, language

Data: TypeAlias = dict[str, Any]
"""What scripts are given, as JSON has it."""
_IMPORT = re.compile(r'^import \{([^{}]*)\} from "(?:[./\w]*/)?(\w+)\.js";\n', re.MULTILINE)
_CONSTANT = re.compile(r"^export const (\w+) = [^\n{(]*;\n", re.MULTILINE)
_FUNCTION = re.compile(r"export (?:async )?function (\w+)")
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function|const|class) (\w+))", re.MULTILINE)
_WIDGET = re.compile(r"^export default .*\n", re.MULTILINE)
"""By which a script is a widget of Jupyter."""
_IMPORTED = re.compile(r'@import "(\w+)\.css";')
_TEXT = re.compile(r'"([^"\n]*)"|\'([^\'\n]+)\'')


@cache
def bundled(name: str, without: frozenset[str] = frozenset(), also: frozenset[str] = frozenset()) -> str:
    """A script after all scripts that it needs, without some of which nothing will be called; its own names are those of the
    text, and so are others that are asked for.

    >>> bundled("widget").count("import ")
    0
    >>> len(bundled("widget", frozenset({"turtle"}))) < len(bundled("widget"))
    True
    """
    needed: dict[str, set[str]] = {}
    todo = [name]
    while todo:
        script = todo.pop()
        if script not in needed:
            needed[script] = set() if script in without else {other for _, other in _IMPORT.findall(source(script))}
            todo += needed[script]
    order = TopologicalSorter({script: sorted(needed[script]) for script in sorted(needed)}).static_order()
    named = {
        each for script in needed.keys() - without for names, _ in _IMPORT.findall(source(script)) for each in names.split(",")
    }
    imported = also.union(map(str.strip, named))
    return "\n".join(
        _plain(source(script)) if script == name else _enclosed(script, script in without, imported) for script in order
    )


def _plain(text: str) -> str:
    return _EXPORT.sub("", _IMPORT.sub("", text))


def _enclosed(name: str, left_out: bool, imported: frozenset[str]) -> str:
    """A script as a function that returns what others import of it, without functions and constants that no script asks for;
    none of it where it is left out."""
    whole = source(name)
    text = _CONSTANT.sub(lambda found: found[0] if _is_asked_for(found[1], whole, imported) else "", _called(whole, imported))
    exported = f"{{ {', '.join(each for each in _EXPORT.findall(text) if each in imported)} }}"
    if left_out:
        return f"const {exported} = {{}};\n"
    return f"const {exported} = (() => {{\n{_WIDGET.sub('', _plain(text))}return {exported};\n}})();\n"


def _is_asked_for(name: str, text: str, imported: frozenset[str]) -> bool:
    """Whether another script imports what one exports, or it calls it itself."""
    return name in imported or len(re.findall(rf"\b{name}\b", text)) > 1


def _called(text: str, imported: frozenset[str]) -> str:
    """A script without the functions that nobody calls, each of which ends with a brace in a line of its own."""
    kept, left_out = [], False
    for line in text.splitlines(keepends=True):
        head = _FUNCTION.match(line)
        left_out = left_out or (head is not None and not _is_asked_for(head[1], text, imported))
        kept += [] if left_out else [line]
        left_out = left_out and line != "}\n"
    return "".join(kept)


@cache
def compact(name: str, without: frozenset[str] = frozenset()) -> str:
    """As `bundled`, without comments, indentation, and the blanks that part nothing.

    >>> len(compact("widget")) < 0.85 * len(bundled("widget"))
    True
    """
    return "\n".join(filter(None, map(tightened, bundled(name, without).split("\n"))))


_IN_PATTERN = r"(?:\\.?|\[(?>(?:\\.?|[^]\\])*)\]?|[^/\\\[])"
_LITERAL = re.compile(
    r"""("(?>(?:\\.?|[^"\\])*)"?|'(?>(?:\\.?|[^'\\])*)'?|`(?>(?:\\.?|[^`\\])*)`?"""
    rf"""|(?:(?<=[\[({{}},;=:?!&|])|(?<=\breturn)) *+/(?!\*)(?>{_IN_PATTERN}+)/?)""",
    re.DOTALL,
)
"""A text, a template or a regular expression in a line of JavaScript; to the end of the line, where it is not closed in it."""
_NESTED = re.compile(r"`[^`]*\$\{[^}`]*`")
"""How a template begins that has another one in it."""
_COMMENT, _TYPES = re.compile(r"(?:^| )//"), re.compile(r"/\*\*.*\*/")
_BLANKS = re.compile(r"(?<![\w$+-]) +| +(?![\w$+-])|(?<=[+-]) +(?![+-])|(?<![+-]) +(?=[+-])")
"""Blanks but for those between words, and between two signs, which would be one."""


def tightened(line: str) -> str:
    """A line of JavaScript without a comment at its end, and without blanks that part nothing; in texts all stays as it is.

    >>> tightened('  if (a + +b > 2) return "a // b"; // a reason')
    'if(a+ +b>2)return"a // b";'
    """
    line, kept = line.strip(" \t"), ""
    if _TYPES.fullmatch(line):
        return ""
    if _NESTED.search(line):
        return line
    for number, part in enumerate(_LITERAL.split(line)):
        code, *comment = [part] if number % 2 else _COMMENT.split(part, maxsplit=1)
        kept += code if number % 2 else _BLANKS.sub("", code)
        if comment:
            break
    return kept


@cache
def source(name: str) -> str:
    """A script as it was written."""
    return _scripts()[name].read_text(encoding="utf-8")


@cache
def _scripts() -> Mapping[str, Traversable]:
    home = files(__package__) / "scripts"
    folders = [home, *(place for place in home.iterdir() if place.is_dir())]
    return {
        place.name.removesuffix(".js"): place for folder in folders for place in folder.iterdir() if place.name.endswith(".js")
    }


def translated_words(*names: str) -> dict[str, str]:
    """The texts in some scripts that another language has other words for.

    >>> translated_words("panel")
    {}
    """
    if language() == ENGLISH:
        return {}
    return {text: gettext(text) for text in _texts(names) if gettext(text) != text}


@cache
def _texts(names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(one or other for name in names for one, other in _TEXT.findall(compact(name))))


@cache
def style(name: str = "panels") -> str:
    """The style of a sheet, by default that of panels in notebooks and beside each other, after the colours that all share,
    which are those of the themes of pictures; without comments, line breaks and blanks that say nothing.

    >>> "\\n" in style(), "/*" in style(), "@import" in style(), len(style()) > len(style("panel"))
    (False, False, False, True)
    """
    colours = Template(_sheet("colours")).substitute(light=_variables(LIGHT), dark=_variables(DARK))
    sheet = colours + _IMPORTED.sub(lambda found: _sheet(found[1]), _sheet(name))
    plain = re.sub(r"\s+", " ", re.sub(r"(?s)/\*.*?(?:\*/|\Z)", "", sheet))
    return re.sub(r" ?([{};>]) ?|([:,]) ", r"\1\2", plain).replace(";}", "}")


def _sheet(name: str) -> str:
    return (files(__package__) / "scripts" / f"{name}.css").read_text(encoding="utf-8")


def _variables(theme: Theme) -> str:
    """The colours of a theme as variables of a style; on dark paper also those of lines, behind the ones that they replace."""
    lines = " ".join(f"{colour} {seen}" for colour, seen in DARK_LINES.items()) if theme.dark else "none"
    named = {
        "paper": theme.paper,
        "ink": theme.ink,
        "quiet": theme.quiet,
        "mark": theme.mark,
        "mark-edge": theme.mark_edge,
        "lines": f'"{lines}"',
    }
    return " ".join(f"--lsys-{name}: {value.lower()};" for name, value in named.items())
