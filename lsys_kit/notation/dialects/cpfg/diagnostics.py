"""Diagnostics of a cpfg text."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from difflib import get_close_matches

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.diagnostics import DIAGNOSTICS as SHARED_DIAGNOSTICS
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, quoted, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import ARROW

_CONSTANTS = 'Constants are declared with "#define", as in "#define n 3".'
_OWN_BLOCK = "Compute what a rule needs in its own block, with assignments and if."

MISSING_FEATURES: Sequence[tuple[str, str, str]] = (
    (r"define[ \t]*:", "arrays that change, or have no values from the start", "Write their values where they are used."),
    (r"ring[ \t]+lsystem", "words whose ends are joined", "Without this line a word has two ends."),
)
"""Features of cpfg that the kit lacks: how a statement begins, what it is, and what to do instead."""
_BEHIND_A_NAME = {"[": "arrays", "{": "loops"}
"""What a statement in a block is, by the character that follows its first name."""

CPFG_KEYWORDS: Mapping[str, str] = {
    "Axiom": "A",
    "Lsystem": "1",
    "derivation length": "9",
    "maximum depth": "2",
    "seed": "3",
    "ignore": "+-",
    "consider": "AB",
    "angle": "30",
    "heading": "90",
    "length": "1",
    "decomposition": "",
    "homomorphism": "",
    "endlsystem": "",
}
"""The keywords, each with an example of what follows its colon."""
_SYNONYMS = {
    "steps": "derivation length",
    "derivation": "derivation length",
    "depth": "maximum depth",
    "start": "Axiom",
    "initiator": "Axiom",
    "interpretations": "homomorphism",
    "end lsystem": "endlsystem",
}
"""Other words for a keyword."""
_MACRO = re.compile(r"#[ \t]*define\b[ \t]*(\w+)?[ \t]*")


def _feature(failure: ParseFailure) -> ModelSyntaxError | None:
    """A feature of cpfg that the kit lacks."""
    statement = failure.statement
    for pattern, what, instead in MISSING_FEATURES:
        if found := re.match(pattern, statement, re.IGNORECASE):
            return failure.error(f"The kit has no {what}", instead, failure.start, found.end())
    arrow = statement.find("-o>")
    if arrow >= 0:
        return failure.error("The kit has no rules for objects", 'A production reads "A --> B".', failure.start + arrow, 3)
    return None


def _included(failure: ParseFailure) -> ModelSyntaxError | None:
    """A file that is to be included, of which a text knows no more than the name."""
    found = re.match(r"#[ \t]*include\b[ \t]*([<\"]?)([^<>\"\n]*)", failure.statement)
    if found is None:
        return None
    name = found[2].strip() or "that is to be included"
    return failure.error(
        f"The file {quoted(name) if found[1] else name} is not part of this text",
        "Put what it says in place of this line.",
        failure.start,
        found.end(),
    )


def _label(failure: ParseFailure) -> ModelSyntaxError | None:
    """A text among the values of a module, as in cpfg's labels."""
    label = re.match(r'"[^"\n]*"?', failure.found) if "SYMBOL" not in failure.accepted else None
    if label is None or unclosed_bracket(failure.before, "()") is None:
        return None
    return failure.error(
        "The kit has no texts among values", "Leave the label out, or write a number.", failure.at, len(label.group())
    )


def _in_a_block(failure: ParseFailure) -> ModelSyntaxError | None:
    """A statement that is neither an assignment nor a choice, or an element of an array."""
    loop = re.search(r"[{;}]\s*(while|do)\b", failure.statement)
    if loop:
        return failure.error("The kit has no loops", _OWN_BLOCK, failure.start + loop.start(1), len(loop[1]))
    name, what = re.search(r"\b\w++$", failure.before), _BEHIND_A_NAME.get(failure.found[:1])
    element = what == "arrays" and "TIMES" in failure.accepted and unclosed_bracket(failure.statement) is None
    behind = failure.accepted == {"EQUAL", "LPAR"} or element
    if name is None or what is None or not behind:
        return None
    return failure.error(f"The kit has no {what}", _OWN_BLOCK, failure.start + name.start(), len(name[0]))


def _end_of_block(failure: ParseFailure) -> ModelSyntaxError | None:
    """An assignment without its ";", or a block without its "}"."""
    opened = unclosed_bracket(failure.before, "{}")
    if opened is None or "SYMBOL" in failure.accepted:
        return None
    if "SEMICOLON" in failure.accepted and re.match(r"\}|[A-Za-z_]", failure.found):
        return failure.error('A ";" is missing here', 'Every assignment ends with one, as in "{x = t + 1;}".')
    if not failure.found or ARROW.match(failure.found):
        return failure.error(
            'This "{" is never closed', 'Every block ends with "}", as in "{x = t + 1;}".', failure.start + opened, 1
        )
    return None


def _macro_definition(failure: ParseFailure) -> ModelSyntaxError | None:
    """A constant without a name or a value, or with a value that is not a number."""
    statement = failure.statement
    defined = _MACRO.match(statement)
    if not defined:
        return None
    value, at = statement[defined.end() :], failure.start + defined.end()
    if not defined[1]:
        return failure.error("A name is missing here", _CONSTANTS, at)
    if not value:
        return failure.error(
            f'The macro "{defined[1]}" has no value', f'Give it a number: "#define {defined[1]} 1".', failure.start
        )
    if value[0] == "=":
        return failure.error('This "=" is not needed', f'Type "#define {defined[1]} {excerpt(value[1:].strip())}".', at, 1)
    if re.match(r"-?[\d.(]|[A-Za-z_]\w*[ \t]*[(*/+%^-]", value):
        shared = next(filter(None, (diagnostic(failure) for diagnostic in SHARED_DIAGNOSTICS[1:])), None)
        return shared or failure.error(
            f"I did not expect {quoted(failure.found)} here" if failure.found else "The line ends too early", _CONSTANTS
        )
    return failure.error(
        f'The macro "{defined[1]}" is not a number',
        f'Write {excerpt(value)} itself wherever "{defined[1]}" is used.',
        at,
        len(value),
    )


def _keyword(failure: ParseFailure) -> ModelSyntaxError | None:
    """A keyword that is misspelt, or without its colon or its value."""
    statement = failure.statement
    word = re.match(r"([A-Za-z]{3,}(?:[ \t]+[A-Za-z]{3,})?)[ \t]*(:?)[ \t]*", statement)
    if not word or ARROW.search(statement) or re.match(r"(start|end)[ \t]*+(each)?[ \t]*+:\s*+\{", statement, re.IGNORECASE):
        return None
    name, rest = " ".join(word[1].lower().split()), excerpt(statement[word.end() :].strip())
    keyword = _SYNONYMS.get(name) or _similar_keyword(name)
    if keyword is None:
        return None
    at, length, known, example = failure.start, len(word[1]), name == keyword.lower(), CPFG_KEYWORDS[keyword]
    if known and word[2]:
        reads = f'It reads "{keyword}: {example}".'
        return None if rest else failure.error(f'There is nothing after "{word[1]}:"', reads, at, length)
    if word[2] or not (rest or known):
        return failure.error(f'I do not know "{word[1]}{word[2]}"', f'Did you mean "{keyword}{word[2]}"?', at, length)
    return failure.error(f'A ":" is missing after "{word[1]}"', f'Type "{keyword}: {rest or example}".', at, length)


def _similar_keyword(name: str) -> str | None:
    """The keyword that a name resembles."""
    close = get_close_matches(name, [keyword.lower() for keyword in CPFG_KEYWORDS], 1, 0.75)
    return next((keyword for keyword in CPFG_KEYWORDS if keyword.lower() in close), None)


DIAGNOSTICS: Sequence[Diagnostic] = (
    _feature,
    _included,
    _label,
    _in_a_block,
    _end_of_block,
    _macro_definition,
    _keyword,
    *SHARED_DIAGNOSTICS,
)
"""The diagnostics of a cpfg text, the most specific first."""
