"""Plant strings (the applet's lesson): symbols of one letter, both kinds of brackets as branches; see `grammar.lark`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.model.modules import Pattern, flat
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.syntax.actions import Statements
from lsys_kit.notation.syntax.builder import Draft, build_system
from lsys_kit.notation.syntax.diagnostics import DIAGNOSTICS
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.formatting import settings
from lsys_kit.notation.syntax.text.statements import blank_parentheses, statements, without_comments
from lsys_kit.notation.syntax.text.typesetting import HEADING, SENTENCE, without_headings
from lsys_kit.notation.syntax.wording import Spelling

NAME = "plant-string"
_WORD = r"[A-Za-z\[\]()+\-\s]*+"
_LINE = re.compile(
    rf"""\s*+(?:
      axiom\s*[:=](?P<axiom>{_WORD})
    | (?P<rule>[A-Za-z]\s*(?:->|→)(?:{_WORD}|\s*[ε*]\s*))
    | (?:angle|length|steps|seed|number\s+of\s+productions)\s*:\s*-?[\d.]+(?:e[+-]?\d+|/\d+)?\s*
    | (?:turtle|cells|widths|colours)\s*:\s*[a-z-]+\s*
    | productions\s*:\s*
    | {HEADING}
    | (?-i:{SENTENCE})
    | stage\s+\d+\s+string\s*:{_WORD})""",
    re.IGNORECASE | re.VERBOSE,
)
"""A line of a plant string."""
_MARKS = tuple(
    (re.compile(pattern, re.IGNORECASE), weight)
    for pattern, weight in ((r"number\s+of\s+productions", 2), (r"stage\s+\d+\s+string", 2), (r"turtle\s*:\s*abop", 2))
)
"""How lines begin that other notations hardly have, and how much each says."""


def _finish(draft: Draft) -> LSystem:
    """The system; where a text counts its productions, as those of the lesson's applet do, the axiom is always I."""
    if draft.axiom is None and any(kind == "how many" for kind, _, _ in draft.deferred):
        draft.axiom = (Pattern("I"),)
        draft.notes.append("No axiom is given: it is I.")
    return build_system(draft)


def _lines(system: LSystem) -> Iterator[str]:
    yield from settings(system, NAME)
    yield f"Axiom: {PLANT_STRING.word(system.axiom)}"
    for production in system.productions:
        yield f"{production.predecessor} -> {PLANT_STRING.word(flat(production.successor)) or 'ε'}"


def _likely(text: str) -> int:
    """How likely a text is a plant string: 0 where a line is not possible in one."""
    try:
        lines = [line.strip() for line in without_comments(text).splitlines() if line.strip()]
    except ModelSyntaxError:
        return 0
    matches = [match for match in map(_LINE.fullmatch, lines) if match]
    if len(matches) < len(lines):
        return 0
    marks = sum(weight for mark, weight in _MARKS if any(map(mark.match, lines)))
    return marks + _branches(match["axiom"] or match["rule"] or "" for match in matches)


def _branches(words: Iterable[str]) -> int:
    """2 where round brackets hold symbols that also occur outside of them; 1 where they hold other capitals, perhaps values."""
    texts = [*words]
    if not any(re.search(r"\([A-Za-z\[(]", text) for text in texts):
        return 0
    every, shown = (set(filter(str.isalpha, "".join(some))) for some in (texts, map(blank_parentheses, texts)))
    return 2 if every == shown else int("".join(every - shown).isupper())


PLANT_STRING = Dialect(
    name=NAME,
    statements=statements,
    transformer=Statements,
    finish=_finish,
    diagnostics=("other_notation", *DIAGNOSTICS),
    module=str,
    joined="".join,
    write=lambda system: "\n".join(_lines(system)),
    lacks=(
        "parameters",
        "symbols of several letters",
        "conditions",
        "contexts",
        "predecessors of several modules",
        "probabilities",
        "repetition",
        "constants",
        "decomposition rules",
        "meta-rules",
        "interpretation rules",
        "starting direction",
        "ignored symbols",
        "field",
    ),
    likely=_likely,
    turtle=NAME,
    starts=("statement", "word"),
    transcribe=without_headings,
    spelling=Spelling(Path(__file__).parent),
)
