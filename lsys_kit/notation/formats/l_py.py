"""Models of L-Py in which nothing is Python (F. Boudon et al., Frontiers in Plant Science 3:76, 2012).

Read are the axiom, the derivation length, rules with arrows in their sections, what contexts pass over, declared modules, and
constants that are set to numbers. Whatever else stands there is Python, and is named, line by line: it is not run. Turns are
60 degrees where nothing is said, as in L-Py.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.formats.found import Found, Passage, Rule, tables
from lsys_kit.notation.syntax.text.transcript import edited
from lsys_kit.notation.syntax.text.typography import without_margin

_SIGN = re.compile(
    r"^(?:production|interpretation|homomorphism|decomposition)[ \t]*+:?[ \t]*+$|^module[ \t]+[A-Za-z]"
    r"|^#{4,}[ ]INIT|^__lpy|\bn?produce\b"
    r"|^(?:import|from)[ \t]+[A-Za-z.]+|^def[ \t]+\w+\(|^extern\(",
    re.MULTILINE,
)
_AXIOM = re.compile(r"^[ \t]*(?:Axiom[ \t]*:|production[ \t]*:[ \t]*$)", re.MULTILINE)
_OTHERS = re.compile(r"^[ \t]*(?:[Ll]system[ \t]*:|#include\b)|^(?![ \t]*n?produce\b)[^\n]*;[ \t]*$|==>|/\*", re.MULTILINE)
_END = re.compile(r"^#{4,}[ ]*INITIALISATION[^\n]*|^endlsystem[^\n]*", re.MULTILINE)
_SECTION = re.compile(
    r"(production|interpretation|homomorphism|decomposition|group\s+\d+|endgroup)[ \t]*+:?(?:[ \t]*+maximum depth[^\n]*)?"
)
_SECTIONS = {
    "production": "",
    "homomorphism": "interpretation",
    "interpretation": "interpretation",
    "decomposition": "decomposition",
}
_RULE = re.compile(r"(?>(?P<head>[^\n]*?)-{1,3}>)(?P<tail>[^\n]*+)")
_NEW_CONTEXT = re.compile(r"<<|>>")
_PYTHON_VALUES = re.compile(r"\([^():]*(?:\*|(?<![=<>!])=(?!=))[^():]*\)")
"""Values that have defaults, or any number of values: A(x, w=2), A(*args)."""
_SETTINGS = re.compile(r"(?<![\w.])(angle|steps|heading|alphabet|axiom)(?![\w:])")
"""What a constant of the kit cannot be called."""
_CONSTANT = re.compile(r"(?P<name>[A-Za-z_]\w*)[ \t]*=[ \t]*(?P<value>[-+]?[\d.][\d.eE]*(?:[ \t]*[-+*/][ \t]*[\d.]+)*)")
_EXTERN = re.compile(r"extern\((?P<name>\w+)[ \t]*=[ \t]*(?P<value>[-\d.]+)\)")
_SCALAR = re.compile(
    r"\([ ]*['\"](?P<name>[A-Za-z_]\w*)['\"][ ]*,[ ]*['\"](?:Integer|Float|Bool)['\"][ ]*,[ ]*(?P<value>-?[\d.]+)"
)
_DEPTH = re.compile(r"maximum[ \t]+depth[ \t]*:[ \t]*(\d+)")


def is_l_py(text: str) -> bool:
    """Whether a text is a model of L-Py, which cpfg's reader might take for its own.

    >>> is_l_py("Axiom: A\\nproduction:\\nA --> A A"), is_l_py("Axiom: A\\nA --> A A")
    (True, False)
    """
    if "xiom" not in text:
        return False
    text = text.replace("\r\n", "\n")
    text = edited(text, without_margin(text)).text
    return bool(_AXIOM.search(text) and _SIGN.search(text)) and not _OTHERS.search(text)


def systems_in_l_py(text: str) -> list[Found]:
    """The system of a model of L-Py.

    >>> [found] = systems_in_l_py("r = 0.5 # ratio\\nAxiom: A(1)\\nproduction:\\nA(x) --> F(x)[+A(x*r)]")
    >>> [line.text for line in found.lines], found.rules[0].head.text, found.angle[0]
    (['r = 0.5'], 'A(x)', Fraction(60, 1))
    """
    if not is_l_py(text):
        return []
    found = Found(signs=tables()["signs"]["l-py"]["signs"])
    end = _END.search(text)
    python: list[tuple[int, int]] = []
    names: set[str] = set()
    lengths: list[tuple[re.Match[str], Passage]] = []
    section = ""
    for line in _lines(text[: end.start()] if end else text):
        said = line.text
        if re.match(r"Axiom[ \t]*:", said):
            found.axiom = (line.part(said.index(":") + 1),)
        elif match := re.fullmatch(r"derivation[ \t]+length[ \t]*:[ \t]*(\w+)(?:[ \t]*([-+])[ \t]*(\d{1,9}))?", said):
            lengths.append((match, line))
        elif match := re.fullmatch(r"(ignore|consider)[ \t]*:(.*)", said):
            found.lines.append(Passage(f"{match[1]}: {' '.join(match[2].replace('/', ' / '))}", line.at, False))
        elif match := _SECTION.fullmatch(said):
            section = _SECTIONS.get(match[1], section)
        elif match := _DEPTH.fullmatch(said):
            found.lines.append(
                Passage(
                    "depth: " * (section == "interpretation")
                    + "decomposition depth: " * (section == "decomposition")
                    + match[1],
                    line.at,
                    False,
                )
            )
        elif match := re.fullmatch(r"module[ \t]++([^:\n]*+)(?::.*)?", said):
            names |= {name for name in re.findall(r"[A-Za-z_]\w*", re.sub(r"\([^()]*\)", "", match[1])) if len(name) > 1}
        elif (match := _RULE.fullmatch(said)) and (new := _NEW_CONTEXT.search(match["head"].split(":")[0])):
            hint = "They look at the word that is being made. Contexts before < and behind > look at the word that is replaced."
            raise ModelSyntaxError(
                f"L-Py's contexts with {new[0]} are not in the kit", text, line.at, line.at + len(said), hint
            )
        elif (match := _RULE.fullmatch(said)) and match["head"].strip() and not _PYTHON_VALUES.search(match["head"]):
            tail = line.part(match.start("tail"))
            tail = tail._replace(text="") if tail.text == "*" else tail
            found.rules.append(Rule(line.part(0, match.end("head")), (tail,), None, section))
        elif match := _CONSTANT.fullmatch(said) or _EXTERN.fullmatch(said):
            found.lines.append(Passage(f"{match['name']} = {match['value']}", line.at, False))
        elif said:
            python.append((line.at, len(said)))
    for match in _SCALAR.finditer(text, end.start() if end else len(text)):
        found.lines.append(Passage(f"{match['name']} = {match['value']}", match.start(), False))
    _check_python(python, text)
    found.names = frozenset(
        names
        | _names_in(found)
        | {name for rule in found.rules for name in re.findall(r"(?<![\w(,])[A-Z][a-z]\w+", rule.head.text.split(":")[0])}
    )
    for match, line in lengths:
        _take_length(found, match, line)
    _rename_constants(found)
    found.angle = Fraction(60), Passage("", found.axiom[0].at if found.axiom else 0)
    words = "".join(part.text for part in (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail)))
    if re.search(r"[-+&^/\\](?!\()", words):
        found.notes.append("L-Py turns by 60 degrees where no angle is written.")
    if re.search(r",(?!\()", re.sub(r"\([^()]*\)", "()", words)):
        found.notes.append('"," without a value, the colour before, is left out.')
    return [found]


def _rename_constants(found: Found) -> None:
    """Constants that are called as settings of the kit get another name."""
    called = {match[1] for line in found.lines if " = " in line.text and (match := _SETTINGS.match(line.text))}

    def renamed(passage: Passage) -> Passage:
        text = _SETTINGS.sub(lambda match: match[1] + "_" * (match[1] in called), passage.text)
        return passage if text == passage.text else Passage(text, passage.at, False)

    if called:
        found.lines = [renamed(line) for line in found.lines]
        found.axiom = tuple(map(renamed, found.axiom)) if found.axiom else None
        found.rules = [replace(rule, head=renamed(rule.head), tail=tuple(map(renamed, rule.tail))) for rule in found.rules]
        found.notes += [f'"{name}" is a setting of the kit: the constant is called {name}_ here.' for name in sorted(called)]


def _names_in(found: Found) -> set[str]:
    """Names of several letters that nothing declares, where one is replaced."""
    heads = " ".join(rule.head.text.split(":")[0] for rule in found.rules)
    words = " ".join(part.text for part in (*(found.axiom or ()), *(part for rule in found.rules for part in rule.tail)))
    return (
        {*re.findall(r"(?<!\w)[A-Z][a-z]{2,}\w*", re.sub(r"\([^()]*\)", "", words))}
        if re.search(r"(?<!\w)[A-Z][a-z]{2,}", heads)
        else set()
    )


def _lines(text: str) -> Iterator[Passage]:
    """The lines without their comments."""
    for match in re.finditer(r"[^\n]+", text):
        comment = re.search(r"(?:^|[ \t])#.*", match[0])
        passage = Passage(match[0][: comment.start()] if comment else match[0], match.start())
        yield passage.part(0)


def _check_python(lines: list[tuple[int, int]], text: str) -> None:
    """Refuse what is Python, line by line."""
    if lines:
        numbers = [text.count("\n", 0, at) + 1 for at, _ in lines]
        which = (
            f"Lines {', '.join(map(str, numbers[:-1]))} and {numbers[-1]} are" if len(numbers) > 1 else f"Line {numbers[0]} is"
        )
        write = "Write a rule with its condition before the arrow, A(t) : t < 5 --> F(1)A(t+1), and a constant as n = 5."
        hint = f"{which} Python, which is not run. {write}"
        raise ModelSyntaxError("This model of L-Py has Python in it", text, lines[0][0], lines[0][0] + lines[0][1], hint)


def _take_length(found: Found, said: re.Match[str], line: Passage) -> None:
    """The number of steps, which may be a constant, and some more or less."""
    values = dict(each.text.split(" = ") for each in found.lines if " = " in each.text)
    value = values.get(said[1], said[1])
    if re.fullmatch(r"\d{1,9}", value):
        found.steps = max(0, int(value) + int(f"{said[2] or '+'}{said[3] or 0}")), line._replace(exact=False)
