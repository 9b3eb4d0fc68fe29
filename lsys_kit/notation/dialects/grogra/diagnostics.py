"""What a parser stumbled over in GROGRA's notation, in the words of the person who typed it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.syntax.diagnostics import SPELT
from lsys_kit.notation.syntax.dialect import Question
from lsys_kit.notation.syntax.failure import Stumble, outside, possible, printed, quoted, unclosed

ARROW = re.compile(r"##?|-->|->|→|⟶|\\(?:long)?rightarrow")
RULE = 'A rule reads "a # F a": what is replaced, "#", what replaces it.'
COMMA = 'Rules are parted by commas: "a # F b, b # F a".'
_COMMENT = 'A comment stands between "/*" and "*/".'
_SIDES = 'A left context ends with "<", a right context begins with ">", as in "s < a > b # c".'
_IN_FRONT = 'It stands in front, in parentheses: "(t < 6) k(t) # k(t+1)".'
_REPEAT = 'What is repeated reads "&(3) < F a >"; where ABOP turns by "&", type "RL(60)".'
_NUMBER = 'Numbers are glued to a turtle command, as in "F100", or stand in parentheses behind a symbol, as in "a(2)".'
_DIRECTIVES = {
    "axiom": "a", "angle": "60", "length": "100", "const": "k 3", "var": "x uniform 0 360", "set": "turtle abop"}
"""What begins with a backslash, and an example of what stands behind it."""
_ALSO = {"start": "axiom", "startwort": "axiom", "winkel": "angle", "delta": "angle", "constant": "const", "variable": "var"}
_A_VALUE = frozenset(("NUMBER", "LPAR"))
_ITS_OWN = (
    (r"=>(?=[^\n,]*\))", "This is no comparison", '"At least" is typed ">=".'),
    (r"=<(?=[^\n,]*\))", "This is no comparison", '"At most" is typed "<=".'),
    (r":=|::=|=>|⇒|↦|[–—−~]>|-[ \t]+>|<-+>?", "This is no arrow", 'An arrow is typed "#" or "->", in one piece.'),
)
"""What is spelt otherwise, where the kit's own notation says it with other examples."""


def _comment(stumble: Stumble) -> ModelSyntaxError | None:
    """What begins as no rule does: a comment of another notation, or an arrow."""
    statement = stumble.text[stumble.start:stumble.end]
    if statement.startswith("//"):
        return stumble.error("This is no rule", _COMMENT, stumble.start, 2)
    if statement.startswith("#define"):
        return stumble.error("This is no rule", 'A constant is declared as in "\\const k 3,".', stumble.start, 7)
    arrow = ARROW.match(statement)
    if arrow is None:
        return None
    return stumble.error(f"Nothing stands before the {quoted(arrow[0])}", f"{RULE} {_COMMENT}" if arrow[0] == "#" else RULE,
                         stumble.start, len(arrow[0]))


def _comma(stumble: Stumble) -> ModelSyntaxError | None:
    """Two statements, without a comma between them; a number with a comma in it."""
    if re.match(r"\d+$", stumble.text[stumble.start:stumble.end]) and re.search(r"\d,$", stumble.text[:stumble.start]):
        return stumble.error("A number is typed with a point", 'Type "0.5", not "0,5".', stumble.start - 1, 1)
    line = stumble.text.rfind("\n", stumble.start, stumble.at) + 1
    begins = line + len(stumble.text[line:stumble.end]) - len(stumble.text[line:stumble.end].lstrip())
    first = ARROW.search(stumble.before)
    if line <= stumble.start or unclosed(stumble.text[stumble.start:begins]) is not None:
        return None
    new = begins == stumble.at and ("$END" in stumble.accepted or stumble.found.startswith("\\"))
    later = stumble.before.startswith("\\") or (first is not None and first.end() < line - stumble.start)
    if not (new or (later and ARROW.match(stumble.found))):
        return None
    end = stumble.start + len(stumble.text[stumble.start:begins].rstrip())
    if stumble.text[end - 1] == ";":
        return stumble.error('This ";" parts no rules', COMMA, end - 1, 1)
    return stumble.error('A "," is missing here', COMMA, end, 1)


def _directive(stumble: Stumble) -> ModelSyntaxError | None:
    """A line that begins with a backslash, or as a setting of another notation."""
    word = re.match(r"\\([A-Za-z]+)", stumble.text[stumble.start:stumble.end])
    foreign = re.match(r"([A-Za-z]+)[ \t]*:", stumble.text[stumble.start:stumble.end])
    if not word:
        meant = _meant(foreign[1]) if foreign and stumble.found == ":" else None
        rest = stumble.after[1:].strip()
        return stumble.error("This is how another notation sets something", f'Type "\\{meant} {printed(rest)},".',
                             stumble.start, len(foreign[0])) if meant and foreign else None
    name, meant = word[1], _meant(word[1])
    if name not in _DIRECTIVES:
        hint = f'Did you mean "\\{meant}"?' if meant else f"Possible are: {', '.join(chr(92) + n for n in _DIRECTIVES)}."
        return stumble.error(f'I do not know "\\{name}"', hint, stumble.start, len(word[0]))
    if stumble.found.startswith("=") and stumble.before.split()[0] == "\\const":
        return stumble.error('No "=" is needed here', f'Type "{stumble.before} {printed(stumble.after[1:].strip())},".')
    if "TRADITION" in stumble.accepted:
        return stumble.error(f"There is no turtle called {quoted(stumble.found)}",
                             "Turtles are: abop, grogra, plant-string, fractint.")
    behind = stumble.text[stumble.start + len(word[0]):stumble.at].strip()
    if stumble.found or (behind and name not in ("const", "var")):
        return None
    return stumble.error(f'Something is missing behind "\\{name}"', f'It reads as in "\\{name} {_DIRECTIVES[name]},".',
                         stumble.start, len(word[0]))


def _meant(word: str) -> str | None:
    """The directive that was probably meant."""
    name = word.lower()
    return _ALSO.get(name) or next(iter(get_close_matches(name, _DIRECTIVES, 1, 0.6)), None)


def _parentheses(stumble: Stumble) -> ModelSyntaxError | None:
    found, opened = stumble.found, unclosed(stumble.text[stumble.start:stumble.at])
    if found.startswith(")") and stumble.before.endswith("("):
        return stumble.error("Nothing stands in these parentheses", "Write a value there, or leave the parentheses out.",
                             stumble.start + len(stumble.before) - 1, stumble.at + 2 - stumble.start - len(stumble.before))
    if found.startswith(")") and opened is None:
        return stumble.error('This ")" closes nothing', 'Every ")" needs a "(" before it.')
    ended = not found or found in ("?", "<", ">") or ARROW.match(found) or stumble.accepted == {"RPAR"}
    if opened is not None and ended and not stumble.accepted >= _A_VALUE:
        return stumble.error('This "(" is never closed', 'Every "(" needs a ")" behind it.', stumble.start + opened, 1)
    return None


def _arrows(stumble: Stumble) -> ModelSyntaxError | None:
    if not ARROW.match(stumble.found):
        return None
    if ARROW.search(stumble.before) and ARROW.search(stumble.before[-2:]):
        return stumble.error(f"A second {quoted(stumble.found)} stands here",
                             'One "#" is enough; "##" says how a symbol is drawn.')
    if ARROW.search(stumble.before):
        return stumble.error(f"A second {quoted(stumble.found)} stands in this rule", COMMA)
    return None


def _predecessor(stumble: Stumble) -> ModelSyntaxError | None:
    """No symbol to replace, or more than one; a second context."""
    found, before = stumble.found, stumble.before
    if ARROW.search(before) or before.startswith("\\"):
        return None
    if found in ("<", ">") and found in outside(before) and not {"RELATION", "RPAR"} & stumble.accepted:
        return stumble.error(f'A second "{found}" stands here', _SIDES)
    if ARROW.match(found) and before.endswith("<"):
        return stumble.error("The symbol to replace is missing", _SIDES)
    if ARROW.match(found) and before.startswith("(") and not outside(before).strip():
        return stumble.error("The symbol to replace is missing", 'It stands behind its condition: "(t < 6) k(t) # k(t+1)".')
    if ARROW.match(found) and "LESSTHAN" in stumble.accepted:
        return stumble.error("Only one symbol can be replaced", _SIDES, _behind_first(stumble), 1)
    if re.match(r"[A-Za-z]", found) and "ARROW" in stumble.accepted and ARROW.search(stumble.after):
        return stumble.error("Only one symbol can be replaced", _SIDES)
    return None


def _behind_first(stumble: Stumble) -> int:
    """The offset of what follows the first symbol of a rule."""
    text = stumble.text[stumble.start:stumble.end]
    head = re.match(r"(\([^()]*\)\s*)?([A-Za-z_]\w*'*|\S)?", text)
    rest = outside(text)[head.end() if head else 0:]
    return stumble.end - len(rest.lstrip())


def _repetition(stumble: Stumble) -> ModelSyntaxError | None:
    """A "<" or ">" of what is repeated, where it is missing or has no place."""
    arrow, found = ARROW.search(stumble.before), stumble.found
    if arrow and stumble.before.endswith("&"):
        return stumble.error('A number is missing behind "&"', _REPEAT)
    if arrow and stumble.accepted == {"LESSTHAN"}:
        return stumble.error('A "<" is missing here', _REPEAT)
    if found == "&":
        return stumble.error('"&" repeats a part of what stands behind the "#"', _REPEAT)
    if arrow is None or "RELATION" in stumble.accepted:
        return None
    if found == ">" and stumble.before.endswith("<"):
        return stumble.error("Nothing is repeated here", _REPEAT)
    opened = unclosed(outside(stumble.before[arrow.end():]), "<>")
    if "MORETHAN" in stumble.accepted and opened is not None and (not found or found == "?" or ARROW.match(found)):
        return stumble.error('This "<" is never closed', _REPEAT, stumble.start + arrow.end() + opened, 1)
    if found in ("<", ">") and stumble.accepted != {"RPAR"}:
        return stumble.error(f"I did not expect {quoted(found)} here",
                             'Contexts stand before the "#"; behind it "<" and ">" go with "&(3)".')
    return None


def _elsewhere(stumble: Stumble) -> ModelSyntaxError | None:
    """A condition or a probability as in other notations."""
    arrow = ARROW.search(stumble.before)
    if stumble.found == ":" and arrow:
        return stumble.error('A probability is written with "?"', f'Type "?{printed(stumble.after[1:].strip())}".')
    if stumble.found == ":":
        return stumble.error("A condition stands here", _IN_FRONT)
    inside = unclosed(stumble.before) is not None
    compared = re.search(r"[<>]$", stumble.before) and stumble.found[:1].isdigit()
    if not arrow and not inside and "RELATION" not in stumble.accepted and (
            compared or re.match(r"[<>!=]?=|[≤≥≠]|\\[lgn]e", stumble.found)):
        return stumble.error("A condition without parentheses stands here", _IN_FRONT, stumble.start,
                             max(1, len(stumble.before)))
    if stumble.before.endswith("?") and stumble.accepted >= _A_VALUE:
        return stumble.error('A probability is missing behind "?"', 'Type it as in "?0.5", at the end of the rule.')
    return None


def _spelt_otherwise(stumble: Stumble) -> ModelSyntaxError | None:
    first = max(stumble.start, stumble.at - 4)
    for pattern, message, hint in (*_ITS_OWN, *SPELT):
        for match in re.compile(pattern).finditer(stumble.text, first, min(stumble.end, stumble.at + 200)):
            if match.start() <= stumble.at <= match.end() and not ARROW.match(stumble.found):
                return stumble.error(message, hint, match.start(), len(match.group()))
    return None


def _unreadable(stumble: Stumble) -> ModelSyntaxError | None:
    if stumble.found.isascii() or stumble.found[0] in "→⟶ε−∨∧¬≤≥≠·×":
        return None
    return stumble.error(f"I cannot read the character {named(stumble.found[0])}",
                         "Symbols are made of the letters A to Z, digits, _ and '.", length=1)


def _missing_arrow(stumble: Stumble) -> ModelSyntaxError | None:
    if ARROW.search(stumble.before) or ARROW.search(stumble.after) or stumble.before.startswith("\\") \
            or not {"ARROW", "LESSTHAN"} & stumble.accepted:
        return None
    return stumble.error("An arrow is missing here", RULE, _behind_first(stumble))


def _comparison(stumble: Stumble) -> ModelSyntaxError | None:
    relation = r"(?:[<>!=]?=|[<>≤≥≠]|\\[lgn]eq?)"
    chain = re.search(rf"([\w.]+)\s*({relation})\s*([\w.]+)$", stumble.before[-200:])
    if not chain or not re.match(relation, stumble.found) or unclosed(stumble.before) is None:
        return None
    right = re.match(r"\s*([\w.]+)", stumble.after[len(stumble.found):])
    twice = f"{chain[1]} {chain[2]} {chain[3]} && {chain[3]} {stumble.found} {right[1] if right else '...'}"
    return stumble.error("A second comparison stands here", f'Compare twice, as in "{twice}".')


def _value(stumble: Stumble) -> ModelSyntaxError | None:
    """A value too few, an operator too few, or a number that belongs to nothing."""
    if stumble.accepted >= _A_VALUE and "IDENTIFIER" not in stumble.accepted:
        return stumble.error("A value is missing here", 'Possible here: a number, a name or "(".')
    inside = unclosed(stumble.before) is not None
    if inside and re.search(r"[\w)]$", stumble.before) and re.match(r"[\w(.]", stumble.found):
        return stumble.error(f"An operator is missing before {quoted(stumble.found)}", 'To multiply, type "*", as in "2*t".')
    if stumble.found[:1].isdigit() and "IDENTIFIER" in stumble.accepted:
        return stumble.error("A number stands alone", _NUMBER)
    return None


def _macro(stumble: Stumble) -> ModelSyntaxError | None:
    word = re.match(r"\\[A-Za-z]+", stumble.after)
    return stumble.error(f'I do not know "{word[0]}"', possible(stumble.accepted), length=len(word[0])) if word else None


QUESTIONS: Sequence[Question] = (
    _comment, _comma, _directive, _comparison, _predecessor, _repetition, _spelt_otherwise, _elsewhere, _parentheses, _arrows,
    _unreadable, _missing_arrow, _value, _macro)
"""What is asked about a slip in GROGRA's notation, the most telling first."""
