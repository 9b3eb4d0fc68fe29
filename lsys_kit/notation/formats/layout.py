"""A page's text without its layout: the marks of Markdown and LaTeX, its columns and its tables."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lsys_kit.notation.formats.found import Passage, tables, unquoted
from lsys_kit.notation.formats.parts import ANY_ARROW, ARROW, fields, is_word
from lsys_kit.notation.syntax.text.transcript import Edit, Transcript, assembled, edited

_LATEX = re.compile(r"\\(?:begin|end|omega|delta|rightarrow|mapsto|to|theta|circ|text|quad)\b")
_MACROS = {
    "omega": "ω", "delta": "δ", "theta": "θ", "quad": "  ", "qquad": "  ", "circ": "°", "ldots": "", "left": "", "right": "",
    "item": "", "centering": "", "hfill": "  ",
    "to": "→", "rightarrow": "→", "Rightarrow": "→", "longmapsto": "→",
    "longrightarrow": "→", "gets": "←", "leftarrow": "←",
    "mapsto": "→", "varepsilon": "ε", "epsilon": "ε", "lbrace": "{", "rbrace": "}",
}  # fmt: skip
_MACRO = re.compile(
    r"\\(?:begin|end)\{[^{}\n]*\}(?:\{[^{}\n]*\})?|\^?\{?\\circ\}?"
    r"|\\text\{([^{}\n]*)\}|\\([A-Za-z]+)(?![A-Za-z])|\\([#{}%&$_])|\\[;,:! ]|\\\\|(?<!\\)&|\$+|\\[\[\]()]"
)
_BRACES = re.compile(r"\\[A-Za-z]++\{?|\{([+\-]?)\}")
"""What keeps LaTeX from making a dash of two signs, or binary operators of them: -{}-, {+}."""
_FONT = re.compile(
    r"\\(?:text(?:tt|bf|it|rm|sf|sc|sl|normal)|math(?:tt|bf|it|rm|sf|cal)|emph|underline|mbox|boldsymbol)\{(?P<braced>[^{}\n]*)\}"
    r"|\{\\(?:tt|bf|it|rm|sf|sc|em|ttfamily|bfseries|itshape)[ ](?P<switched>[^{}\n]*)\}"
    r"|\\verb\*?(?P<sign>[^\w\s*])(?P<verbatim>[^\n]*?)(?P=sign)"
)
"""What LaTeX sets in a font of its own."""
_DISPLAYED = re.compile(
    r"\{\\displaystyle[ ]*+(?P<shown>(?>(?:[^{}\n]|\{[^{}\n]*\})*))\}(?>(?:\{\\displaystyle[ ]*+(?P=shown)\})*)(?>(?P=shown)?)"
)
"""What an encyclopaedia gives of a formula besides its picture: its LaTeX, perhaps more than once, and the same as text."""
_SET = re.compile(
    r"^[ \t]*set[ ]\[(?:(?P<rule>rule)[ ](?P<head>\S)|(?P<name>[^\[\]\n]{1,30}))[ ]v\][ ]to[ ][\[(](?P<value>.*)[\])][ \t]*$",
    re.MULTILINE,
)
"""A block of Scratch that sets a variable."""
_BROKEN_ARROW = re.compile(r"^[ \t]*p_?\d*[ \t]*:[ \t]*\w[ \t]+(?P<arrow>-{1,2}[+*~])[ \t]", re.MULTILINE)
_BROKEN_DELTA = re.compile(r"(?<=,[ ])[68](?=[ ]?=[ ]?\d{1,3}(?:\.\d+)?[ ]?°)")
"""What the recognition of characters makes of an arrow, and of a δ."""
_MARKS = re.compile(
    r"^[ \t]*```.*$|\*\*|`|\b__(?=\w)|(?<=\w)__(?!\w)|^(?=[^\n|]*\|)[ \t|:-]++$"
    r"|^#+[ ](?![ ]*+(?:define|ignore|include)\b)|^(?:[ ]?>){1,4}[ ](?![:=])"
    r"|^\[?\d{1,2}:\d{2}(?::\d{2})?\]?[ ]<[^<>\n]{1,30}>[ ]|^[:;*#]{1,4}[ ]?(?=''')",
    re.MULTILINE,
)
_ASSIGNED = re.compile(r"^[ \t]*+\w++[ \t]*+(←)", re.MULTILINE)
"""An assignment, as algorithms are printed."""
_MARKDOWN = re.compile(
    r"^(?:[ \t]*+(?:[-*+•]|\d{1,2}[.)])[ \t]++(?:[^`\n]*`){2}"
    r"|[ \t]*+(?:[-*+•][ \t]++)?(?:\*\*|__)[A-Za-z][^*_=(\n]{0,40}(?:\*\*|__))",
    re.MULTILINE,
)
"""A line of Markdown: an item of a list with something set as code, or one that begins in bold."""
_RULE_OF_TIKZ = re.compile(r"\\rule\{([^{}\n]*)\}")
_STRONG = re.compile(r"'''([\w -]{1,60})'''")
_DOLLARS = re.compile(r"\$(?=[^\s$])([^$\n]*[^\s$\\])\$(?!\w)")


_ESCAPED_TURN, _BARE_TURN = re.compile(r"\\[-+]"), re.compile(r"(?<!\\)(?:\+|-(?![->]))|/|&")
_ESCAPE = re.compile(r"\\(?=[-+\[\]*_|<>])")
"""What Markdown has before signs that are no marks; where none is without it, it is no roll."""


def page_text(before: Transcript) -> Transcript:
    r"""A page's text without the marks of Markdown and LaTeX, and with its tables as lists.

    >>> from lsys_kit.notation.syntax.text.transcript import as_typed
    >>> page_text(as_typed("**Rule:** $F \\to FF$")).text
    'Rule: F → FF'
    """
    text = before.text
    if _ESCAPED_TURN.search(text) and not _BARE_TURN.search(text):
        before = edited(before, (Edit(match.start(), match.end(), "") for match in _ESCAPE.finditer(text)))
        text = before.text
    keyed = _KEYED.search(text) is not None
    edits = [
        Edit(*match.span(), "" if _is_shown(text, match.start(), match["shown"]) else match["shown"])
        for match in _DISPLAYED.finditer(text)
    ]
    edits += [Edit(*match.span(), _as_set(match)) for match in _SET.finditer(text)]
    notes = []
    for match in _BROKEN_ARROW.finditer(text):
        edits.append(Edit(*match.span("arrow"), "→"))
        notes.append(f'"{match["arrow"]}" is read as an arrow.')
    for match in _BROKEN_DELTA.finditer(text):
        edits.append(Edit(*match.span(), "δ"))
        notes.append(f'"{match[0]}" is read as δ, the angle.')
    if edits:
        before = edited(before, edits, notes)
        text = before.text
    if "\\" in text and (braces := [Edit(*match.span(), match[1]) for match in _BRACES.finditer(text) if match[1] is not None]):
        before = edited(before, braces)
        text = before.text
    fonts = [(match, match.span(name)) for match in _FONT.finditer(text) if (name := match.lastgroup)]
    if fonts:
        ends = [(Edit(match.start(), start, ""), Edit(end, match.end(), "")) for match, (start, end) in fonts]
        before = edited(before, (edit for pair in ends for edit in pair))
        text = before.text
    if fonts or _LATEX.search(text):
        before = edited(before, (Edit(*match.span(), _macro(match)) for match in _MACRO.finditer(text)))
    edits = [Edit(*match.span(), "") for match in _MARKS.finditer(before.text)]
    edits += [Edit(*match.span(1), ":=") for match in _ASSIGNED.finditer(before.text)]
    edits += [Edit(*match.span(), match[1]) for match in _STRONG.finditer(before.text)]
    edits += [Edit(*match.span(), f"\n{match[1]}\n") for match in _RULE_OF_TIKZ.finditer(before.text)]
    for match in _DOLLARS.finditer(before.text):
        edits += [Edit(match.start(), match.start() + 1, ""), Edit(match.end() - 1, match.end(), "")]
    return _as_lines(without_columns(_without_tables(edited(before, edits) if edits else before, keyed)))


_NUMBER, _RULE, _NAME = (
    re.compile(rf"[ ]*+{each}") for each in (r"\d++(?:\.\d++)?[ ]*+°?[ ]*+", rf"\w[ ]*+(?:{ARROW}|=)", r"\w[\w ]*+:[ ]")
)
_MOST_FIELDS = 40
_IN_ORDER = ("start", "angle", "steps"), ("axiom", "angle", "number of steps")
"""What a word and numbers are, without names: as it is typed, and as it is said."""


def _as_lines(before: Transcript) -> Transcript:
    """A text that is one line of a word, rules and numbers with semicolons between them, as a list of named parts."""
    text = before.text.rstrip("; \n")
    if "\n" in text or not 1 < text.count(";") < _MOST_FIELDS:
        return before
    name = _NAME.match(text)
    parts = [Passage(each[0], each.start()) for each in re.finditer(r"[^;]+", text)]
    fields = [each.part(name.end() if name and not each.at else 0) for each in parts]
    numbers = [each for each in fields if _NUMBER.fullmatch(each.text)]
    rules = [each for each in fields if _RULE.match(each.text)]
    words = [each for each in fields if each not in (*numbers, *rules)]
    if len(words) != 1 or not is_word(words[0].text) or len(numbers) > 2:
        return before
    called = dict(zip((*words, *numbers), zip(*_IN_ORDER, strict=True), strict=False))
    typed = ((each, f"{called[each][0]}: " if each in called else "") for each in fields)
    pieces = (
        (Edit(each.at, each.at, name), each.piece(0, len(each.text), each.text), Edit(each.at, each.at, "\n"))
        for each, name in typed
    )
    notes = [f'"{each.text}" is read as the {kind}.' for each, (_, kind) in called.items()]
    return assembled(before, [edit for three in pieces for edit in three], notes)


def is_markdown(text: str) -> bool:
    """Whether a text is written in Markdown, and its single backquotes are no quotation marks of a program.

    >>> is_markdown("- Rule: `F` -> `FF`"), is_markdown("axiom = `F`")
    (True, False)
    """
    return "```" not in text and "/*" not in text and _MARKDOWN.search(text) is not None


_NO_SIGN = re.compile(r"\\[a-z]+|[^\w+\-\[\]]")


def _is_shown(text: str, end: int, shown: str) -> bool:
    """Whether a formula stands before its LaTeX, as text."""
    sign = _NO_SIGN.sub("", shown)
    return bool(sign) and _NO_SIGN.sub("", text[max(text.rfind("\n", 0, end) + 1, end - 4 * len(shown) - 9) : end]).endswith(
        sign
    )


def _as_set(match: re.Match[str]) -> str:
    """What a block sets, as a line of a list."""
    return f"{match['head']} → {match['value']}" if match["rule"] else f"{match['name']}: {match['value']}"


def _macro(match: re.Match[str]) -> str:
    if match[0].startswith(("\\begin", "\\end")):
        return "\n"
    if "circ" in match[0]:
        return "°"
    if match[1] is not None or match[3]:
        return match[1] or match[3] or ""
    return (
        _MACROS.get(match[2] or "", match[0])
        if match[2]
        else "\n"
        if match[0] == "\\\\"
        else ""
        if match[0] in ("&", "\\!") or "$" in match[0]
        else " "
    )


_COLUMNS = re.compile(r"(?>(?P<left>[ \t]*+\S.*?)(?<! )(?P<gap>[ ]{4,}+)(?=\S))(?P<right>[^\n]*+)")


def without_columns(before: Transcript) -> Transcript:
    """A text in which what a page has in two columns stands one below the other.

    >>> from lsys_kit.notation.syntax.text.transcript import as_typed
    >>> without_columns(as_typed("n=1, δ=9°     n=2, δ=8°\\nF → FF        F → F-F")).text
    'n=1, δ=9°\\nF → FF\\nn=2, δ=8°\\nF → F-F\\n'
    """
    lines = [*re.finditer(r"[^\n]*\n?", before.text)]
    split = [_COLUMNS.fullmatch(before.text, line.start(), line.start() + len(line[0].rstrip())) for line in lines]
    two = [index for index, match in enumerate(split) if match and _is_part(match["left"]) and _is_part(match["right"])]
    if len(two) < 2:
        return before
    pieces: list[Edit] = []
    index = 0
    while index < len(lines):
        right: list[Edit] = []
        while (
            (match := split[index])
            and abs(match.start("right") - lines[index].start() - (at := right_of(split, lines, two))) <= 12
            and at >= 0
        ):
            pieces += (
                Edit(match.start("left"), match.end("left"), match["left"]),
                Edit(match.end("left"), match.end("left"), "\n"),
            )
            right += (
                Edit(match.start("right"), match.end("right"), match["right"].rstrip()),
                Edit(match.end("right"), match.end("right"), "\n"),
            )
            index += 1
        pieces += (*right, Edit(*lines[index].span(), lines[index][0]))  # the last line is empty, and in no columns
        index += 1
    return assembled(before, pieces)


def right_of(split: Sequence[re.Match[str] | None], lines: Sequence[re.Match[str]], two: Sequence[int]) -> int:
    """Where the right column begins."""
    found = sorted(match.start("right") - lines[index].start() for index in two if (match := split[index]))
    return found[len(found) // 2]


def _is_part(text: str) -> bool:
    """Whether a text is a rule or a setting, as it stands in a listing."""
    return re.match(rf"[ \t]*(?:[a-z]\)[ \t]+)?(?:\S{{1,12}}[ \t]*{ARROW}[ \t]*\S|(?:n|δ)[ \t]*=)", text) is not None


_CELL, _QUOTED_CELLS = (
    re.compile(r"[^|\t\n]+"),
    {",": re.compile(r"\"[^\"\n]*\"|[^,\n]+"), ";": re.compile(r"\"[^\"\n]*\"|[^;\n]+")},
)


_ROW = re.compile(r"[ \t]*+\|(?P<cells>[ \t][^\n]*[ \t])\|[ \t]*+\n?")
_IN_ROW = re.compile(r"(?:[^|\n]|(?<![ \t])\||\|(?![ \t]))+")
"""A row of a table, and its cells: a border has blanks around it, which a turn has not."""
_KEYED = re.compile(
    r"^[ \t]*+\|?[ \t]*+(?:axiom|start|angle)[ \t]*+\|[^\n]*+\n[ \t]*+\|?[ \t]*+:?-{3}", re.MULTILINE | re.IGNORECASE
)
"""A table of two columns whose head is the axiom already: names and values, symbols and what replaces them."""


def _without_tables(before: Transcript, keyed: bool) -> Transcript:
    """The same, with each row of a table of systems as a list: the heading of a column before each of its cells."""
    names = tables()["names"]
    heading = ["", "→"] if keyed else []
    pieces: list[Edit] = []
    kinds = fields()[1]
    for match in re.finditer(r"[^\n]*\n?", before.text):
        cells = [Passage(cell[0], cell.start()).part(0) for cell in _CELL.finditer(before.text, *match.span())]
        comma = max(_QUOTED_CELLS, key=match[0].count)
        if len(cells) == 1 and match[0].count(comma) > 1:
            cells = [
                unquoted(Passage(cell[0], cell.start()).part(0))
                for cell in _QUOTED_CELLS[comma].finditer(before.text, *match.span())
            ]
        named = [kinds.get(re.sub(r"[ _-]|\d", "", cell.text.lower()), "") for cell in cells]
        low = [cell.text.lower() for cell in cells if len(cell.text) > 2]
        if len(low) == len(cells) == 2 and low[0] in names["predecessor"] and low[1] in (*names["successor"], *names["rules"]):
            heading = ["", "→"]
        elif heading == ["", "→"] and len(cells) == 2 and not (named[0] and len(cells[0].text) > 2):
            (at, left), (to, right) = ((cell.at, cell.text) for cell in cells)
            pieces += (
                Edit(at, at + len(left), left),
                Edit(to, to, " → "),
                Edit(to, to + len(right), right),
                Edit(to, to, "\n"),
            )
            continue
        elif len({"axiom", "rules"} & {kind for kind, cell in zip(named, cells, strict=True) if len(cell.text) > 2}) == 2:
            heading = [cell.text for cell in cells]
        elif (
            len(cells) == 2
            and named[0] in ("axiom", "angle", "steps")
            and ":" not in match[0]
            and re.search(r"[|\t]", match[0])
        ):
            pieces += (
                Edit(cells[0].at, cells[0].at + len(cells[0].text), cells[0].text),
                Edit(cells[1].at, cells[1].at, ": "),
                Edit(cells[1].at, cells[1].at + len(cells[1].text), cells[1].text),
                Edit(cells[1].at, cells[1].at, "\n"),
            )
            continue
        elif heading and len(cells) == len(heading):
            for name, cell in zip(heading, cells, strict=True):
                at = cell.at
                pieces += (Edit(at, at, f"{name}: "), Edit(at, at + len(cell.text), cell.text), Edit(at, at, "\n"))
            continue
        elif (row := _ROW.fullmatch(before.text, *match.span())) and ANY_ARROW.search(row["cells"]):
            if low and low[0] in names["predecessor"]:
                continue  # the head of a table whose rows are rules
            for part in _IN_ROW.finditer(before.text, *row.span("cells")):
                pieces += (Edit(*part.span(), part[0]), Edit(part.end(), part.end(), "  "))
            pieces.append(Edit(match.end(), match.end(), "\n"))
            continue
        pieces.append(Edit(*match.span(), match[0]))
    return assembled(before, pieces)
