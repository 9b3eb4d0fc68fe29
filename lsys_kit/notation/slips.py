"""What the parser stumbled over, in the words of the person who typed it.

A parser knows which token it did not expect; a student wants to know what is missing. `explained` asks a list of questions
about the place, the most telling first; the first that knows an answer gives the error. What is merely spelt as elsewhere
(`=>`, `and`, `**`) stands in a table.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches

from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from lsys_kit.errors import ModelSyntaxError, named, printable
from lsys_kit.notation.statements import ARROW, without_comments

KEYWORDS = ("axiom", "angle", "heading", "steps", "alphabet", "productions", "interpretation")
_ALSO = {"start": "axiom", "initiator": "axiom", "word": "axiom", "w": "axiom", "delta": "angle", "rules": "productions"}
"""What other programs and books say for a keyword."""
_READ = frozenset("→⟶εωδ∨∧¬≤≥≠−·×")
"""The characters beyond ASCII that the grammars know."""
_OPERATORS, _A_VALUE = frozenset(("TIMES", "SIGN", "POWER")), frozenset(("NUMBER", "LPAR"))
_WORDS = {
    "ARROW": "an arrow", "NAME": "a name", "SYMBOL": "a symbol", "NUMBER": "a number", "LPAR": '"("', "RPAR": '")"',
    "COMMA": '","', "COLON": '":"', "RELATION": "a comparison", "$END": "the end of the line", "RANGE": '".."', "IN": '"in"',
}
_NOT_IN_STRINGS = {"(": "values", ":": "conditions"}
_AN_ARROW, _PRODUCTION = "This is no arrow", 'A production reads "A -> B": what is replaced, an arrow, what replaces it.'
_BEFORE_ARROW, _NO_ARROW = rf"(?=.*(?:{ARROW.pattern}))", rf"(?!.*(?:{ARROW.pattern}))"

SPELT: Sequence[tuple[str, str, str]] = (
    (r"={3,}", "This is no comparison", 'To compare two values, type "==".'),
    (rf"=>{_BEFORE_ARROW}", "This is no comparison", '"At least" is typed ">=".'),
    (rf"=<{_BEFORE_ARROW}", "This is no comparison", '"At most" is typed "<=".'),
    (r"<>|=/=|~=", "This is no comparison", '"Not equal" is typed "!=".'),
    (rf"(?:::=|:=|=>|⇒|↦|[–—−~]>|-[ \t]+>){_NO_ARROW}", _AN_ARROW, 'An arrow is typed "->", in one piece.'),
    (r"\band\b|&", "This joins no conditions", '"And" is typed "&&".'),
    (r"\bor\b|\|", "This joins no conditions", '"Or" is typed "||".'),
    (r"\bnot\s+", "This denies no condition", '"Not" is typed "!", as in "!(t < 5)".'),
    (r"\*\*", "This is no operator", 'A power is typed "t^2".'),
    (r"\d,\d", "A number is typed with a point", 'Type "1.4", not "1,4".'),
    (r"\d\.(?![\d.])", "This number is not finished", 'Type "1" or "1.0".'),
    (r"\*/", "This comment was never opened", 'A comment begins with "/*".'),
    (r";", 'This ";" parts no values', 'Values are parted by ",", as in "A(1, 2)".'),
    (r"°", "This sign is not needed", "Angles are in degrees."),
    (r"[\"“”„«»]", "A quotation mark stands here", "Words are typed without quotation marks."),
)
"""What is spelt as elsewhere: a pattern, what to say of it, what to type here."""


@dataclass(frozen=True)
class Stumble:
    """Where the parser could not go on, in the statement between two offsets.

    Attributes
    ----------
    text, source
        The text without its comments, and as it was typed.
    at, found
        The offset, and the text there: none at the end of the statement.
    accepted
        The kinds of tokens with which it could have gone on.
    """

    text: str
    source: str
    start: int
    end: int
    at: int
    found: str
    accepted: frozenset[str]

    @property
    def before(self) -> str:
        """The statement up to the place."""
        return self.text[self.start:self.at].rstrip()

    @property
    def after(self) -> str:
        """The statement from the place on."""
        return self.text[self.at:self.end]

    def error(self, message: str, hint: str | None = None, at: int | None = None,
              length: int | None = None) -> ModelSyntaxError:
        """What is wrong, at the place or at another offset."""
        at = self.at if at is None else at
        return ModelSyntaxError(message, self.source, at, at + (length or max(1, len(self.found))), hint)


def explained(slip: UnexpectedInput, source: str, start: int, end: int) -> ModelSyntaxError:
    """The slip in the statement between two offsets, as an error with its place and a hint."""
    at, found = _found(slip, source, start, end)
    parser = getattr(slip, "interactive_parser", None)
    stumble = Stumble(without_comments(source), source, start, end, at, found, frozenset(parser.accepts() if parser else ()))
    answers = (question(stumble) for question in _QUESTIONS)
    return next(answer for answer in answers if answer is not None)


def _found(slip: UnexpectedInput, source: str, start: int, end: int) -> tuple[int, str]:
    """The offset of the slip and the text there; an arrow is found whole, wherever in it the parser stumbled."""
    if isinstance(slip, UnexpectedToken) and slip.token.type != "$END":
        at, found = slip.token.start_pos or 0, str(slip.token)
    elif isinstance(slip, UnexpectedCharacters):
        at, found = slip.pos_in_stream or 0, slip.char
    else:
        return end, ""
    for arrow in ARROW.finditer(source, max(start, at - 2), min(end, at + 3)):
        if arrow.start() <= at < arrow.end():
            return arrow.start(), arrow.group()
    return at, found


def _spelt_otherwise(stumble: Stumble) -> ModelSyntaxError | None:
    first = max(stumble.start, stumble.at - 4)
    for pattern, message, hint in SPELT:
        for match in re.compile(pattern).finditer(stumble.text, first, min(stumble.end, stumble.at + 200)):
            if match.start() <= stumble.at <= match.end() and not ARROW.match(stumble.found):
                return stumble.error(message, hint, match.start(), len(match.group()))
    return None


def _unreadable(stumble: Stumble) -> ModelSyntaxError | None:
    if stumble.found.isascii() or stumble.found[0] in _READ:
        return None
    return stumble.error(f"I cannot read the character {named(stumble.found[0])}",
                         "Names are made of the letters A to Z, digits and _.", length=1)


def _comment(stumble: Stumble) -> ModelSyntaxError | None:
    statement = stumble.text[stumble.start:stumble.end]
    if not statement.startswith(("#", "//", "%")) or ARROW.search(stumble.before):
        return None
    if statement.startswith("#define"):
        return stumble.error("This is no production", 'A constant is declared with "=", as in "dt = 0.5".', stumble.start, 7)
    return stumble.error("This is no production", 'A comment stands between "/*" and "*/".', stumble.start, 1)


def _parentheses(stumble: Stumble) -> ModelSyntaxError | None:
    found, opened = stumble.found, _unclosed(stumble.text[stumble.start:stumble.at])
    if opened is not None and (not found or found == ":" or ARROW.match(found)) and not stumble.accepted >= _A_VALUE:
        return stumble.error('This "(" is never closed', 'Every "(" needs a ")" behind it.', stumble.start + opened, 1)
    if found.startswith(")") and opened is None:
        branch = stumble.before.count("[") > stumble.before.count("]")
        return stumble.error('This ")" closes nothing', 'A branch that begins with "[" ends with "]".' if branch else
                             'Every ")" needs a "(" before it.')
    if found.startswith(")") and stumble.before.endswith("("):
        return stumble.error("Nothing stands in these parentheses", "Write a value there, or leave the parentheses out.",
                             stumble.start + len(stumble.before) - 1, stumble.at + 2 - stumble.start - len(stumble.before))
    return None


def _arrows(stumble: Stumble) -> ModelSyntaxError | None:
    first = ARROW.search(stumble.before)
    if ARROW.match(stumble.found):
        if first:
            return stumble.error("A second arrow stands in this production", "Write one production a line.")
        if not stumble.text[stumble.text.rfind("\n", 0, stumble.at) + 1:stumble.at].strip():
            return stumble.error("Nothing stands before the arrow", _PRODUCTION)
        if stumble.before.endswith(":"):
            return stumble.error("There is no condition before the arrow", 'Write one, as in "t < 5", or leave the ":" out.')
    if not stumble.found and first and first.end() == len(stumble.before):
        predecessor = _printed(stumble.before[:first.start()].split(":")[0].strip())
        return stumble.error("Nothing stands behind the arrow", f'To erase {predecessor}, write "ε" or "*" there.',
                             stumble.start + first.start(), len(first.group()))
    return None


def _keyword(stumble: Stumble) -> ModelSyntaxError | None:
    statement = stumble.text[stumble.start:stumble.end]
    word = re.match(r"([A-Za-z_]+)([ \t]*:(?!=)(?!.*[<>=]))?", statement)
    if not word or ARROW.search(statement):
        return None
    name, rest = word[1].lower(), statement[word.end():].strip()
    meant = name if name in KEYWORDS else _ALSO.get(name) or next(iter(get_close_matches(name, KEYWORDS, 1, 0.75)), None)
    said: tuple[str, str | None] | None = None
    if word[2] and meant and meant != name:
        said = f'I do not know "{word[1]}:"', f'Did you mean "{meant}:"?'
    elif word[2] and not rest:
        said = f'Nothing stands behind "{word[1]}:"', _possible(stumble.accepted)
    elif word[2] and not meant and rest[0].isdigit():
        said = f'I do not know "{word[1]}:"', f'A constant is declared with "=", as in "{word[1]} = {_printed(rest)}".'
    elif not word[2] and meant == name and rest[:1] not in ("(", "="):
        said = f'A ":" is missing behind "{word[1]}"', f'Type "{name}: {_printed(rest)}".'
    return stumble.error(*said, stumble.start, len(word[1])) if said else None


def _predecessor(stumble: Stumble) -> ModelSyntaxError | None:
    """What stands between the module to replace and the arrow."""
    if not {"ARROW", "COLON"} & stumble.accepted or not ARROW.search(stumble.after) or ARROW.search(stumble.before):
        return None
    if stumble.accepted == {"ARROW"} and stumble.found in _NOT_IN_STRINGS and ":" not in stumble.before:
        return stumble.error(f"A plant string has no {_NOT_IN_STRINGS[stumble.found]}", _PRODUCTION)
    if "COLON" in stumble.accepted and re.match(r"if\b|when\b|\w+\s*[<>=!]=?", stumble.after):
        return stumble.error('A ":" is missing before the condition', 'A condition stands between ":" and the arrow, as in '
                             '"A(t) : t < 5 -> B".')
    if stumble.found in ("<", ">") and "RELATION" not in stumble.accepted and ":" not in stumble.before:
        return stumble.error("A context stands here", "Before the arrow stands one module, and perhaps a condition.")
    if not _OPERATORS & stumble.accepted and ":" not in stumble.before and stumble.found[:1].isalpha():
        return stumble.error("Only one module can be replaced", 'Write a production for each: "A -> ...", then "B -> ...".')
    return None


def _equals(stumble: Stumble) -> ModelSyntaxError | None:
    if not stumble.found.startswith("="):
        return None
    if "ARROW" in stumble.accepted and not ARROW.search(stumble.after):
        return stumble.error(_AN_ARROW, _PRODUCTION)
    return stumble.error('A single "=" cannot be used here', 'To compare two values, type "==".')


def _comparison(stumble: Stumble) -> ModelSyntaxError | None:
    relation = r"([<>]=?|[=!]=|[≤≥≠])"
    chain = re.search(rf"([\w.]+)\s*{relation}\s*([\w.]+)$", stumble.before[-200:])
    if not chain or not re.match(relation, stumble.found):
        return None
    right = re.match(r"\s*([\w.]+)", stumble.after[len(stumble.found):])
    twice = f"{chain[1]} {chain[2]} {chain[3]} && {chain[3]} {stumble.found} {right[1] if right else '...'}"
    return stumble.error("A second comparison stands here", f'Compare twice, as in "{twice}".')


def _value(stumble: Stumble) -> ModelSyntaxError | None:
    """A value too few, or an operator too few."""
    if stumble.accepted >= _A_VALUE:
        return stumble.error("A value is missing here", 'Possible here: a number, a name or "(".')
    inside = _unclosed(stumble.before) is not None and "SYMBOL" not in stumble.accepted
    if inside and re.search(r"[\w)]$", stumble.before) and re.match(r"[\w(.]", stumble.found):
        return stumble.error(f"An operator is missing before {_quoted(stumble.found)}", 'To multiply, type "*", as in "2*t".')
    return None


def _constant(stumble: Stumble) -> ModelSyntaxError | None:
    constant = re.match(r"([A-Za-z_]\w*)\s*=(?!=)\s*([A-Za-z_]\w*$)?", stumble.before)
    if not constant or ARROW.search(stumble.text, stumble.start, stumble.end) or "RANGE" in stumble.accepted:
        return None
    production = f'; a production, "{constant[1]} -> {constant[2]}"' if constant[2] else ""
    return stumble.error(f"I did not expect {_quoted(stumble.found)} here",
                         f'A constant reads "dt = 0.5", or "dt = 0.5 in 0.1 .. 2 by 0.1"{production}.')


def _in_a_word(stumble: Stumble) -> ModelSyntaxError | None:
    """What stands in a word, but is no module."""
    empty = stumble.found if stumble.found in ("ε", "*") else stumble.before[-1:]
    if empty in ("ε", "*") and ARROW.search(stumble.before):
        return stumble.error(f"Nothing else may stand beside {_quoted(empty)}", "It says that the successor is empty.")
    if stumble.found == ":" and ARROW.search(stumble.before):
        return stumble.error('This ":" stands behind the arrow', 'A condition stands before it, as in "A(t) : t < 5 -> B".')
    if not {"SYMBOL", "NAME"} & stumble.accepted or stumble.accepted >= _A_VALUE:
        return None
    if stumble.found[:1].isdigit():
        hint = 'Values stand in parentheses behind a symbol, as in "A(2)".' if "NAME" in stumble.accepted \
            else 'A plant string has no values: "(" and ")" are branches.'
        return stumble.error("A number stands alone in a word", hint)
    if stumble.found.startswith(","):
        return stumble.error('A "," is not needed here', "Modules and names stand side by side, with blanks between them.")
    return None


def _missing_arrow(stumble: Stumble) -> ModelSyntaxError | None:
    missing = "ARROW" in stumble.accepted and not ARROW.search(stumble.text, stumble.start, stumble.end)
    return stumble.error("An arrow is missing here", _PRODUCTION) if missing else None


def _anything_else(stumble: Stumble) -> ModelSyntaxError:
    what = f"I did not expect {_quoted(stumble.found)} here" if stumble.found else "The line ends too early"
    return stumble.error(what, _possible(stumble.accepted))


_QUESTIONS: Sequence[Callable[[Stumble], ModelSyntaxError | None]] = (
    _comment, _keyword, _parentheses, _arrows, _spelt_otherwise, _unreadable, _comparison, _predecessor, _in_a_word,
    _equals, _value, _constant, _missing_arrow, _anything_else)


def _unclosed(text: str) -> int | None:
    """The offset of the last "(" that is not closed."""
    opened: list[int] = []
    for match in re.finditer(r"[()]", text):
        if match.group() == "(":
            opened.append(match.start())
        else:
            opened[-1:] = []
    return opened[-1] if opened else None


def _quoted(found: str) -> str:
    return named(found) if len(found) == 1 else f'"{found}"' if len(found) <= 40 else f'"{found[:40]}..."'


def _printed(text: str) -> str:
    """The beginning of a text, as a hint quotes it."""
    return "".join(map(printable, text[:20]))


def _possible(accepted: frozenset[str]) -> str | None:
    words = sorted({_WORDS[name] for name in accepted if name in _WORDS})
    if not words or len(words) > 4:
        return None
    return "Possible here: " + " or ".join((", ".join(words[:-1]), words[-1]) if len(words) > 1 else words) + "."
