"""What a parser stumbled over in GROGRA's notation, in the words of the person who typed it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.notation.syntax.diagnostics import CORRECTIONS
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure, blank_parentheses, excerpt, expected_hint, quoted, unclosed_bracket

RULE_ARROW = re.compile(r"##?|-->|->|→|⟶|\\(?:long)?rightarrow")
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


def _comment(failure: ParseFailure) -> ModelSyntaxError | None:
    """What begins as no rule does: a comment of another notation, or an arrow."""
    statement = failure.text[failure.start:failure.end]
    if statement.startswith("//"):
        return failure.error("This is no rule", _COMMENT, failure.start, 2)
    if statement.startswith("#define"):
        return failure.error("This is no rule", 'A constant is declared as in "\\const k 3,".', failure.start, 7)
    arrow = RULE_ARROW.match(statement)
    if arrow is None:
        return None
    return failure.error(f"Nothing stands before the {quoted(arrow[0])}", f"{RULE} {_COMMENT}" if arrow[0] == "#" else RULE,
                         failure.start, len(arrow[0]))


def _comma(failure: ParseFailure) -> ModelSyntaxError | None:
    """Two statements, without a comma between them; a number with a comma in it."""
    if re.match(r"\d+$", failure.text[failure.start:failure.end]) and re.search(r"\d,$", failure.text[:failure.start]):
        return failure.error("A number is typed with a point", 'Type "0.5", not "0,5".', failure.start - 1, 1)
    line = failure.text.rfind("\n", failure.start, failure.at) + 1
    begins = line + len(failure.text[line:failure.end]) - len(failure.text[line:failure.end].lstrip())
    first = RULE_ARROW.search(failure.before)
    if line <= failure.start or unclosed_bracket(failure.text[failure.start:begins]) is not None:
        return None
    new = begins == failure.at and ("$END" in failure.accepted or failure.found.startswith("\\"))
    later = failure.before.startswith("\\") or (first is not None and first.end() < line - failure.start)
    if not (new or (later and RULE_ARROW.match(failure.found))):
        return None
    end = failure.start + len(failure.text[failure.start:begins].rstrip())
    if failure.text[end - 1] == ";":
        return failure.error('This ";" parts no rules', COMMA, end - 1, 1)
    return failure.error('A "," is missing here', COMMA, end, 1)


def _directive(failure: ParseFailure) -> ModelSyntaxError | None:
    """A line that begins with a backslash, or as a setting of another notation."""
    word = re.match(r"\\([A-Za-z]+)", failure.text[failure.start:failure.end])
    foreign = re.match(r"([A-Za-z]+)[ \t]*:", failure.text[failure.start:failure.end])
    if not word:
        meant = _meant(foreign[1]) if foreign and failure.found == ":" else None
        rest = failure.after[1:].strip()
        return failure.error("This is how another notation sets something", f'Type "\\{meant} {excerpt(rest)},".',
                             failure.start, len(foreign[0])) if meant and foreign else None
    name, meant = word[1], _meant(word[1])
    if name not in _DIRECTIVES:
        hint = f'Did you mean "\\{meant}"?' if meant else f"Possible are: {', '.join(chr(92) + n for n in _DIRECTIVES)}."
        return failure.error(f'I do not know "\\{name}"', hint, failure.start, len(word[0]))
    if failure.found.startswith("=") and failure.before.split()[0] == "\\const":
        return failure.error('No "=" is needed here', f'Type "{failure.before} {excerpt(failure.after[1:].strip())},".')
    if "TRADITION" in failure.accepted:
        return failure.error(f"There is no turtle called {quoted(failure.found)}",
                             f"Turtles are: {', '.join(TURTLE_DIALECTS)}.")
    behind = failure.text[failure.start + len(word[0]):failure.at].strip()
    if failure.found or (behind and name not in ("const", "var")):
        return None
    return failure.error(f'Something is missing behind "\\{name}"', f'It reads as in "\\{name} {_DIRECTIVES[name]},".',
                         failure.start, len(word[0]))


def _meant(word: str) -> str | None:
    """The directive that was probably meant."""
    name = word.lower()
    return _ALSO.get(name) or next(iter(get_close_matches(name, _DIRECTIVES, 1, 0.6)), None)


def _parentheses(failure: ParseFailure) -> ModelSyntaxError | None:
    found, opened = failure.found, unclosed_bracket(failure.text[failure.start:failure.at])
    if found.startswith(")") and failure.before.endswith("("):
        return failure.error("Nothing stands in these parentheses", "Write a value there, or leave the parentheses out.",
                             failure.start + len(failure.before) - 1, failure.at + 2 - failure.start - len(failure.before))
    if found.startswith(")") and opened is None:
        return failure.error('This ")" closes nothing', 'Every ")" needs a "(" before it.')
    ended = not found or found in ("?", "<", ">") or RULE_ARROW.match(found) or failure.accepted == {"RPAR"}
    if opened is not None and ended and not failure.accepted >= _A_VALUE:
        return failure.error('This "(" is never closed', 'Every "(" needs a ")" behind it.', failure.start + opened, 1)
    return None


def _arrows(failure: ParseFailure) -> ModelSyntaxError | None:
    if not RULE_ARROW.match(failure.found):
        return None
    if RULE_ARROW.search(failure.before) and RULE_ARROW.search(failure.before[-2:]):
        return failure.error(f"A second {quoted(failure.found)} stands here",
                             'One "#" is enough; "##" says how a symbol is drawn.')
    if RULE_ARROW.search(failure.before):
        return failure.error(f"A second {quoted(failure.found)} stands in this rule", COMMA)
    return None


def _predecessor(failure: ParseFailure) -> ModelSyntaxError | None:
    """No symbol to replace, or more than one; a second context."""
    found, before = failure.found, failure.before
    if RULE_ARROW.search(before) or before.startswith("\\"):
        return None
    if found in ("<", ">") and found in blank_parentheses(before) and not {"RELATION", "RPAR"} & failure.accepted:
        return failure.error(f'A second "{found}" stands here', _SIDES)
    if RULE_ARROW.match(found) and before.endswith("<"):
        return failure.error("The symbol to replace is missing", _SIDES)
    if RULE_ARROW.match(found) and before.startswith("(") and not blank_parentheses(before).strip():
        return failure.error("The symbol to replace is missing", 'It stands behind its condition: "(t < 6) k(t) # k(t+1)".')
    if RULE_ARROW.match(found) and "LESSTHAN" in failure.accepted:
        return failure.error("Only one symbol can be replaced", _SIDES, _behind_first(failure), 1)
    if re.match(r"[A-Za-z]", found) and "ARROW" in failure.accepted and RULE_ARROW.search(failure.after):
        return failure.error("Only one symbol can be replaced", _SIDES)
    return None


def _behind_first(failure: ParseFailure) -> int:
    """The offset of what follows the first symbol of a rule."""
    text = failure.text[failure.start:failure.end]
    head = re.match(r"(\([^()]*\)\s*)?([A-Za-z_]\w*'*|\S)?", text)
    rest = blank_parentheses(text)[head.end() if head else 0:]
    return failure.end - len(rest.lstrip())


def _repetition(failure: ParseFailure) -> ModelSyntaxError | None:
    """A "<" or ">" of what is repeated, where it is missing or has no place."""
    arrow, found = RULE_ARROW.search(failure.before), failure.found
    if arrow and failure.before.endswith("&"):
        return failure.error('A number is missing behind "&"', _REPEAT)
    if arrow and failure.accepted == {"LESSTHAN"}:
        return failure.error('A "<" is missing here', _REPEAT)
    if found == "&":
        return failure.error('"&" repeats a part of what stands behind the "#"', _REPEAT)
    if arrow is None or "RELATION" in failure.accepted:
        return None
    if found == ">" and failure.before.endswith("<"):
        return failure.error("Nothing is repeated here", _REPEAT)
    opened = unclosed_bracket(blank_parentheses(failure.before[arrow.end():]), "<>")
    if "MORETHAN" in failure.accepted and opened is not None and (not found or found == "?" or RULE_ARROW.match(found)):
        return failure.error('This "<" is never closed', _REPEAT, failure.start + arrow.end() + opened, 1)
    if found in ("<", ">") and failure.accepted != {"RPAR"}:
        return failure.error(f"I did not expect {quoted(found)} here",
                             'Contexts stand before the "#"; behind it "<" and ">" go with "&(3)".')
    return None


def _elsewhere(failure: ParseFailure) -> ModelSyntaxError | None:
    """A condition or a probability as in other notations."""
    arrow = RULE_ARROW.search(failure.before)
    if failure.found == ":" and arrow:
        return failure.error('A probability is written with "?"', f'Type "?{excerpt(failure.after[1:].strip())}".')
    if failure.found == ":":
        return failure.error("A condition stands here", _IN_FRONT)
    inside = unclosed_bracket(failure.before) is not None
    compared = re.search(r"[<>]$", failure.before) and failure.found[:1].isdigit()
    if not arrow and not inside and "RELATION" not in failure.accepted and (
            compared or re.match(r"[<>!=]?=|[≤≥≠]|\\[lgn]e", failure.found)):
        return failure.error("A condition without parentheses stands here", _IN_FRONT, failure.start,
                             max(1, len(failure.before)))
    if failure.before.endswith("?") and failure.accepted >= _A_VALUE:
        return failure.error('A probability is missing behind "?"', 'Type it as in "?0.5", at the end of the rule.')
    return None


def _spelt_otherwise(failure: ParseFailure) -> ModelSyntaxError | None:
    first = max(failure.start, failure.at - 4)
    for pattern, message, hint in (*_ITS_OWN, *CORRECTIONS):
        for match in re.compile(pattern).finditer(failure.text, first, min(failure.end, failure.at + 200)):
            if match.start() <= failure.at <= match.end() and not RULE_ARROW.match(failure.found):
                return failure.error(message, hint, match.start(), len(match.group()))
    return None


def _unreadable(failure: ParseFailure) -> ModelSyntaxError | None:
    if failure.found.isascii() or failure.found[0] in "→⟶ε−∨∧¬≤≥≠·×":
        return None
    return failure.error(f"I cannot read the character {named(failure.found[0])}",
                         "Symbols are made of the letters A to Z, digits, _ and '.", length=1)


def _missing_arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    if RULE_ARROW.search(failure.before) or RULE_ARROW.search(failure.after) or failure.before.startswith("\\") \
            or not {"ARROW", "LESSTHAN"} & failure.accepted:
        return None
    return failure.error("An arrow is missing here", RULE, _behind_first(failure))


def _comparison(failure: ParseFailure) -> ModelSyntaxError | None:
    relation = r"(?:[<>!=]?=|[<>≤≥≠]|\\[lgn]eq?)"
    chain = re.search(rf"([\w.]+)\s*({relation})\s*([\w.]+)$", failure.before[-200:])
    if not chain or not re.match(relation, failure.found) or unclosed_bracket(failure.before) is None:
        return None
    right = re.match(r"\s*([\w.]+)", failure.after[len(failure.found):])
    twice = f"{chain[1]} {chain[2]} {chain[3]} && {chain[3]} {failure.found} {right[1] if right else '...'}"
    return failure.error("A second comparison stands here", f'Compare twice, as in "{twice}".')


def _value(failure: ParseFailure) -> ModelSyntaxError | None:
    """A value too few, an operator too few, or a number that belongs to nothing."""
    if failure.accepted >= _A_VALUE and "IDENTIFIER" not in failure.accepted:
        return failure.error("A value is missing here", 'Possible here: a number, a name or "(".')
    inside = unclosed_bracket(failure.before) is not None
    if inside and re.search(r"[\w)]$", failure.before) and re.match(r"[\w(.]", failure.found):
        return failure.error(f"An operator is missing before {quoted(failure.found)}", 'To multiply, type "*", as in "2*t".')
    if failure.found[:1].isdigit() and "IDENTIFIER" in failure.accepted:
        return failure.error("A number stands alone", _NUMBER)
    return None


def _macro(failure: ParseFailure) -> ModelSyntaxError | None:
    word = re.match(r"\\[A-Za-z]+", failure.after)
    return failure.error(f'I do not know "{word[0]}"', expected_hint(failure.accepted), length=len(word[0])) if word else None


DIAGNOSTICS: Sequence[Diagnostic] = (
    _comment, _comma, _directive, _comparison, _predecessor, _repetition, _spelt_otherwise, _elsewhere, _parentheses, _arrows,
    _unreadable, _missing_arrow, _value, _macro)
"""What is asked about a slip in GROGRA's notation, the most telling first."""
