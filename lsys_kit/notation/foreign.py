r"""Formats of other programs, which the kit does not read: what gives each away, what the kit lacks, and what to try.

A text is asked whose it is only where its reader has failed, so that no text in one of the kit's notations is ever called
foreign. One format is asked for before: some models of L-Py are letter for letter what cpfg's reader would take for its own,
and are known by the line `production:`, which L-Py needs and cpfg has not. A sign counts at the beginning of any line, outside
of `/* comments */`; the name of a file proves nothing.

Sources: F. Boudon et al., "L-Py: an L-system simulation framework for modeling plant architecture development based on
a dynamic language", Frontiers in Plant Science 3:76 (2012); R. Karwowski, P. Prusinkiewicz, "Design and implementation of the
L+C modeling language", ENTCS 86 (2003); O. Kniemeyer, "Design and implementation of a graph grammar based language for
functional-structural plant modelling" (2008), on XL; S. Rodger, T. Finley, "JFLAP: an interactive formal languages and
automata package" (2006), chapter 10; the documentation of Racket's package lindenmayer, of PGF (section 55, Lindenmayer
systems), Houdini (the node L-System) and Lowclouds' L-system Explorer; L. Lapré, lparser.txt (1994, 2006); the manual of cpfg
for its other files.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import PurePath

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.text.statements import without_comments

_BLANKS = r"[ \t]*+"


@dataclass(frozen=True, eq=False)
class ForeignFormat:
    """A format that the kit knows and does not read.

    Attributes
    ----------
    name
        Whose it is, as in "This is a model of L-Py".
    signs
        What only texts in this format have: one of these patterns at the beginning of a line, after blanks. A blank in a
        pattern stands for any number of blanks, and for none.
    lacks
        What such texts hold and the kit lacks, as in "The kit has no Python code".
    advice
        What to try, a sentence.
    suffixes
        How names of such files often end.
    beside
        What the text must be like as a whole, if a sign is not enough.
    early
        What a text holds that is asked before it is read, lest it be taken for another; "" where that cannot be.
    """

    name: str
    signs: Sequence[str]
    lacks: str
    advice: str
    suffixes: Sequence[str] = ()
    beside: str = ""
    early: str = ""

    @cached_property
    def _patterns(self) -> tuple[re.Pattern[str], re.Pattern[str]]:
        signs = f"^ (?:{'|'.join(self.signs)})".replace(" ", _BLANKS)
        return re.compile(signs, re.MULTILINE | re.IGNORECASE), re.compile(self.beside.replace(" ", _BLANKS), re.MULTILINE)

    def sign_in(self, text: str) -> re.Match[str] | None:
        """What gives this format away in a text."""
        signs, beside = self._patterns
        return signs.search(text) if beside.match(text) else None


_VALUES = r"\([^()\n]*\)"
_CODE = "Write the axiom and the rules alone, with conditions and values as formulas: A(t) : t < 5 -> B(t+1)."
_PAGE = "Copy the text of the model out of it, without its tags."
_MODULES = r"(?:turtle|math|random|re|sys|os|json|numpy|matplotlib[\w.]*|tkinter|pygame|bpy|openalea[\w.]*|lsys_kit)"


_NUMBER = r"\d+(?:\.\d*)? (?:#[^\n]*)?\n(?: (?:#[^\n]*)?\n)*+"


def _with_line(pattern: str) -> str:
    """A pattern for texts in which a line begins so."""
    return rf"(?=(?s:.*?)^ {pattern})"


def _without_line(pattern: str) -> str:
    """A pattern for texts in which no line begins so."""
    return rf"(?!(?s:.*?)^ {pattern})"


_TURTLE_OF_LPARSER = "The kit's turtle has no random turns (~), and no step and angle that others would multiply (' \" ; :)"
_FROM_LPARSER = (
    'Write "steps:", "angle:" and "axiom:" before its numbers and its axiom, a rule as A -> F[+A]A, and \\ and / for < and >.'
)
_FROM_HOUDINI = 'Put "axiom:" before the first word, "angle:" before the angle in degrees, and write a rule as A -> F[+A]A.'
_XL = ForeignFormat(
    "a model in XL, the language of GroIMP",
    [
        r"import\b (?:static\b )?de\.grogra\b",
        rf"module\b \w+ (?:{_VALUES})? (?:extends\b|==>)",
        rf"(?:public|protected|private)\b void\b \w+ {_VALUES} \[? $",
        r"Axiom ==>[^\n]*",
        r"[^\n]*?==>>",
    ],
    "The kit has no modules that are classes of Java, and no arrow ==>",
    "The notation of GROGRA, from which XL comes, is read: * # A(1), and A(x) # F(x) RU30 A(x*0.8), for instance.",
    [".rgg"],
)
_L_PY = ForeignFormat(
    "a model of L-Py",
    [
        r"#{4,} INITIALISATION\b",
        r"__\w+__ =",
        r"(?:[^\s:][^:\n]*+: )?n?produce\b(?![^\n]*; (?:/[/*][^\n]*)?$)",
        rf"module\b \w+ (?:{_VALUES})? (?:[:#][^;\n]*)?$",
        r"extern \(",
        r"context \( \)\.",
        rf"def\b \w+ {_VALUES} :",
        r"from\b [\w.]+ import\b [\w*]",
        r"import\b \w",
    ],
    "The kit has no Python code",
    'Leave out all from "INITIALISATION" on, where that word stands; write a rule with its condition before the arrow, '
    "A(t) : t < 5 --> F(1)A(t+1), and a constant, also one that is set behind that word, as #define n 5.",
    [".lpy"],
    _with_line("(?:Axiom :|production : $)") + _without_line("[Ll]system :"),
)

FORMATS: Sequence[ForeignFormat] = (
    ForeignFormat(
        "a model in Racket's language lindenmayer",
        [r"#lang\b lindenmayer\b"],
        "The kit has no programs in Racket, and no headings such as ## axiom ##",
        'Put "axiom:" before the axiom, "steps:" in place of "n =", the other variables as constants above; keep the rules.',
        [".rkt"],
    ),
    ForeignFormat("a program in Racket", [r"#lang\b \w"], "Nothing that is given to the kit is run", _CODE),
    ForeignFormat(
        "an L-system of JFLAP",
        [r"[^\n]*?<type> lsystem </type>"],
        "The kit has no tags",
        "Open it in JFLAP, and copy its axiom and its rules: axiom: X, and a line X -> F + X for each rule, with F for its g.",
        [".jff"],
    ),
    ForeignFormat(
        "an automaton or a grammar of JFLAP, and no L-system",
        [r"[^\n]*?<type> (?:fa|pda|turing|grammar|re|mealy|moore|[a-z-]+ pumping lemma) </type>"],
        "The kit has L-systems alone",
        "In an L-system all symbols are rewritten at once: A -> A B.",
    ),
    replace(_XL, signs=[rf"(?:public|protected|private)\b void\b \w+ {_VALUES} \{{ $"], beside="(?=(?s:.*?)==>)"),
    _XL,
    ForeignFormat(
        "a model of lpfg, in the language L+C",
        [
            r'# include [<"]lpfgall\b',
            r"module\b \w+ (?:\([^()\n;]*\))? ;",
            r"derivation\b length :[^;/\n]*;",
            r"(?:\{ )?n?produce\b[^\n]*; (?:/[/*][^\n]*|\})?$",
        ],
        "The kit has no code in C++",
        "Write a module, its condition and its successor as one rule: A(x) : x < 5 -> F(1) A(x+1).",
    ),
    _L_PY,
    replace(
        _L_PY,
        signs=["production : $"],
        early="production",
        beside=_with_line("Axiom :") + _without_line("[Ll]system :") + "(?!(?s:.*?)[^-]->)",
        lacks="Its turtle begins otherwise than that of cpfg, which has such rules, too",
        advice='Without Python and comments behind #, read(text, "cpfg") reads it (--notation cpfg in a shell): add '
        '"angle: 60", which L-Py takes where nothing else is said.',
    ),
    ForeignFormat(
        "a model of LParser",
        [r"\d+(?:\.\d*)? (?:#[^\n]*)?$"],
        _TURTLE_OF_LPARSER,
        _FROM_LPARSER,
        [".ls"],
        rf"(?: (?:#[^\n]*)?\n)*+(?: {_NUMBER}){{3}} (?![^\n]*->|axiom\b)[^\s\d]",
    ),
    ForeignFormat(
        "a model of LParser",
        [r"recursion\b \d+ (?:#[^\n]*)?$"],
        _TURTLE_OF_LPARSER,
        _FROM_LPARSER,
        [".ls"],
        _with_line(r"axiom\b [^:=\s][^:=\n]*$") + _with_line(r"(?:rule\b \S =|angle\b \d)"),
    ),
    ForeignFormat(
        "a model of the L-system Explorer by Lowclouds",
        [r"(?:delta|stemsize|step|view) =", r"p\d+ :[^\n]*?->"],
        "The kit has no formulas of JavaScript, and no L-systems within others",
        'Put "angle:" in place of "delta =" and "steps:" in place of "derivation length:", and leave "stemsize" out.',
        [".ls"],
        _with_line("axiom :") + _with_line(r"(?:derivation\b length :|stemsize =)"),
    ),
    ForeignFormat(
        "a file that goes with a model of cpfg, and says how it is seen or animated",
        [
            r"(?:angle|scale)\b factor :",
            r"initial\b (?:colou?r|line\b width) :",
            r"swap\b interval :",
            r"(?:front|back)\b distance :",
            r"(?:first|last)\b frame :",
            r"line\b style :",
        ],
        "It has no axiom and no rules",
        "The model is in the file beside it whose name ends in .l.",
        beside=_without_line("[Aa]xiom :"),
    ),
    ForeignFormat(
        "an L-system of PGF, for TikZ",
        [r"[^\n]*?\\pgfdeclarelindenmayersystem\b", r"[^\n]*?\blindenmayer\b system ="],
        "The kit has no drawing options of TikZ",
        'Put the axiom behind "axiom:", and each rule, without \\rule{ }, on a line of its own: F -> F-F++F-F.',
    ),
    ForeignFormat(
        "an L-system of Houdini",
        [r"premise (?:[:=] |\b)(?!->)[^\s:=]", r"rule \d+ [:=]? [^\s=:][^\n=]*= \S"],
        "The kit has no premise, and no rules with =",
        _FROM_HOUDINI,
    ),
    ForeignFormat(
        "an L-system of Houdini, or of another program that has no word before the axiom",
        [r"[^\s:=]+ $"],
        "The first word has no name here, and rules have no =",
        _FROM_HOUDINI,
        beside=r"\s*+(?!axiom\b|angle\b)[^\s:=]++ \n\s*+(?:angle (?:[:=] )?[\d.]++\s*+"
        r"|(?!angle\b)[^\s=(](?:\([^\s()=]*+\))?+ (?::[^\n=]++)?+=(?!=)[^\n]*+\s*+)++\Z",
    ),
    ForeignFormat(
        "a Jupyter notebook",
        [r'(?:\{ )?"(?:cells|nbformat)" :'],
        "It is no model itself",
        "Open it in JupyterLab, and copy the model out of its cell.",
        [".ipynb"],
    ),
    ForeignFormat(
        "a picture as SVG",
        [r"(?:<\?xml[^>\n]*> )?<svg\b"],
        "The kit draws such pictures, and does not read them",
        "Give it the model that was drawn.",
        [".svg"],
    ),
    ForeignFormat(
        "a page as HTML",
        [r"<!doctype\b html\b", r"</?(?:html|head|body|div|script|table|p|pre)\b[^>\n]*>"],
        "The kit has no tags",
        _PAGE,
        [".html", ".htm"],
    ),
    ForeignFormat("XML", [r"<\?xml\b"], "The kit has no tags", _PAGE, [".xml"]),
    ForeignFormat(
        "a document as RTF", [r"\{\\rtf\d"], "The kit reads plain text", "Save it as plain text, in UTF-8.", [".rtf"]
    ),
    ForeignFormat(
        "a program, as in JavaScript, Processing, Java or C++",
        [
            r"(?:export\b )?(?:const|let|var)\b \w+ =",
            rf"(?:async\b )?function\b[^(\n]*{_VALUES} \{{",
            rf"(?:(?:public|private|static|final|const)\b )*(?:String|int|float|double|void)\b \w+ (?:=|;|{_VALUES} \{{)",
            r"(?:public\b class\b \w|class\b \w+ extends\b)[^\n{]*\{",
            r"using\b namespace\b",
        ],
        "Nothing that is given to the kit is run",
        _CODE,
        [".js", ".java", ".pde", ".cpp"],
    ),
    ForeignFormat(
        "a program in Python",
        [
            rf"def\b \w+ {_VALUES}[^\n:]*:",
            r"from\b [\w.]+ import\b [\w*]",
            rf"import\b {_MODULES} (?:,|as\b|$)",
            r"class\b \w+[^\n{:]*: $",
            r"""\w+ = (?:\[ ["']|\{ ["'][^"'\n]*["'] :|dict\()""",
            r"#![^\n]*?python",
            r"(?:try|else) : $",
            r"for\b \w+ in\b[^\n]*?: $",
        ],
        "Nothing that is given to the kit is run",
        _CODE,
        [".py"],
    ),
    ForeignFormat(
        "data as YAML",
        [r"""rules : \n -? ["']?\S["']? : ["']?[^\s<>=:]+["']? $"""],
        "The kit has no colon within a rule",
        "Write axiom: F, and a line F -> F+F for each rule.",
        [".yaml", ".yml"],
    ),
    ForeignFormat(
        "data as JSON, or a dictionary",
        [r"""[{,\[]? "\w[\w ]*" : ["\[{\d]""", r"""\{? '[^'\n]+' : ['\[{\d]"""],
        "The kit has no quotation marks, and no colon within a rule",
        "Write axiom: F, and a line F -> F+F for each rule.",
        [".json"],
    ),
    ForeignFormat(
        "a text as Markdown",
        ["```"],
        "There is more in it than a system",
        "Give what stands between the fences alone.",
        [".md"],
    ),
)
"""The formats; a text is in the first one whose sign it has."""
GLANCE = 50_000
"""So many characters of a text are looked at."""


def foreign_format(text: str) -> ModelSyntaxError | None:
    """The error that says whose format a text is in that no reader of the kit could read; None where that is not known.

    >>> print(foreign_format("#lang lindenmayer racket\\n## axiom ##\\nF").message)
    This is a model in Racket's language lindenmayer, which the kit does not read
    """
    return _claim(FORMATS, text)


def mistakable_format(text: str) -> ModelSyntaxError | None:
    """The same for a text that a reader of the kit may take for its own.

    >>> mistakable_format("Axiom: A\\nA --> A B") is None
    True
    """
    early = [row for row in FORMATS if row.early and row.early in text]
    return _claim(FORMATS, text) if _claim(early, text) else None


def name_hint(name: str) -> str | None:
    """A hint at the format in which files with such a name often are.

    >>> name_hint("tree.jff")
    'The name ends in ".jff": perhaps the file is an L-system of JFLAP, which the kit does not read.'
    """
    suffix = PurePath(name).suffix.lower()
    found = next((row for row in FORMATS if suffix in row.suffixes), None)
    return f'The name ends in "{suffix}": perhaps the file is {found.name}, which the kit does not read.' if found else None


def _claim(formats: Sequence[ForeignFormat], text: str) -> ModelSyntaxError | None:
    """The error at the first sign of the first format that has one in a text."""
    plain = _without_comments(text[:GLANCE].replace("\r\n", " \n")) if formats else ""
    for row in formats:
        sign = row.sign_in(plain)
        if sign:
            start = sign.end() - len(sign[0].lstrip())
            return ModelSyntaxError(
                f"This is {row.name}, which the kit does not read", text, start, sign.end(), f"{row.lacks}. {row.advice}"
            )
    return None


def _without_comments(text: str) -> str:
    """A text with its comments blanked, if it has such comments."""
    try:
        return without_comments(text)
    except ModelSyntaxError:
        return text
