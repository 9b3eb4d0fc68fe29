"""How a dialect spells what messages quote: its arrow, its declarations, its expressions, and the wordings that are its own."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

from lsys_kit.errors import ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Module, Pattern, joined
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.syntax.text.statements import ARROW

_BEFORE_ARROW, _NO_ARROW = rf"(?=.*(?:{ARROW.pattern}))", rf"(?!.*(?:{ARROW.pattern}))"
CORRECTIONS: Sequence[tuple[str, str, str]] = (
    (r"={3,}", "This is not a comparison", 'To compare two values, type "==".'),
    (rf"=>{_BEFORE_ARROW}", "This is not a comparison", 'For "at least", type ">=".'),
    (rf"=<{_BEFORE_ARROW}", "This is not a comparison", 'For "at most", type "<=".'),
    (r"<>|=/=|~=", "This is not a comparison", 'For "not equal", type "!=".'),
    (rf"(?:::=|:=|=>|⇒|↦|[–—−~]>|-[ \t]+>){_NO_ARROW}", "This is not an arrow", 'An arrow is typed "{arrow}", in one piece.'),
    (r"\band\b|(?<!&)&(?!&)", "This does not join conditions", 'For "and", type "&&".'),
    (r"\bor\b|(?<!\|)\|(?!\|)", "This does not join conditions", 'For "or", type "||".'),
    (r"\bnot\s+", "This is not an operator", 'For "not", type "!", as in "!(t < 5)".'),
    (r"[‐‑‒–—―]+", "This dash is not a minus sign", 'A minus sign is typed "-".'),
    (r"\*\*", "This is not an operator", 'A power is typed "t^2".'),
    (r"\d,\d", "A number is typed with a point", 'Type "1.4", not "1,4".'),
    (r"\d\.(?![\d.])", "This number is not complete", 'Type "1" or "1.0".'),
    (r"\*/", "This comment was never opened", 'A comment begins with "/*".'),
    (r";", 'This ";" does not separate values', 'Values are separated by ",", as in "A(1, 2)".'),
    (r"°", "This sign is not needed", "Angles are in degrees."),
    (r"[\"“”„«»]", "Quotation marks are not needed here", "Words are typed without quotation marks."),
)
"""Spellings of other languages in the kit's own notation."""

ModelError: TypeAlias = ModelSyntaxError | ModelNameError | ModelValueError
"""What a mistake in the text of a model is."""


@dataclass(frozen=True)
class Wording:
    """What a problem is called in a dialect; names in braces are those of the problem's subject and of the dialect's spelling.

    Attributes
    ----------
    message
        What is wrong, one sentence without its full stop; a whole sentence where the problem is only worth a note.
    hint
        What to try, unless the problem suggests a name.
    error
        The class of the error.
    """

    message: str
    hint: str | None = None
    error: type[ModelError] = ModelSyntaxError


@dataclass(frozen=True, kw_only=True, eq=False)
class Spelling:
    """How a dialect spells what messages quote; by default as the kit's own notation does.

    Attributes
    ----------
    arrow, axiom, constant, part, random, nothing
        The arrow; examples of an axiom, of a constant, of a constant that holds a part of an expression, of a random number;
        how an empty successor is written.
    rule, rule_example, interpretation, depth
        What a rule is called, and an example; what the rules are called that say how modules are drawn, and how a text says how
        often they are applied.
    comment, contexts, name_rule, apart, repetition, after_arrow
        Hints: how comments, contexts and names are written, what separates rules, how repetitions are written, and what "<" and
        ">" mean after the arrow.
    arrows, relations, comment_marks, first_module
        Patterns: of all arrows that can be read, of comparisons, of comments in other languages, of the beginning of a rule.
    readable, outside
        The characters beyond ASCII that can be read; the tokens that cannot occur inside parentheses.
    corrections
        Spellings of other languages: a pattern, what to say of it, what to type instead.
    expression, module, joined
        The text of an expression, of a module, and of several modules.
    wordings
        The problems that this dialect words in its own way.
    """

    arrow: str = "->"
    axiom: str = "axiom: A"
    constant: str = "dt = 0.5"
    part: str = "c = ..."
    random: str = "A -> F(uniform(1, 2))"
    nothing: str = '"ε" or "*"'
    rule: str = "production"
    rule_example: str = 'A production reads "A -> B": what is replaced, an arrow, what replaces it.'
    interpretation: str = "interpretation"
    depth: str = "depth:"
    comment: str = 'A comment is written between "/*" and "*/".'
    contexts: str = 'A left context ends with "<", a right context begins with ">", as in "A < B > C -> D".'
    name_rule: str = "Names are made of the letters A to Z, digits and _."
    apart: str = "Write one production per line."
    repetition: str = 'A repetition reads "repeat(3) <F>", or, with a name that counts from 0, "repeat(3, i) <F(i)>".'
    after_arrow: str = (
        'A context is written before the arrow; after it "<" and ">" go with "repeat(3)". '
        'For rolls type "\\" and "/"; for longer steps, give F a length: A(x) -> F(x) A(x*2).'
    )
    arrows: re.Pattern[str] = ARROW
    relations: str = r"(?:[<>]=?|[=!]=|[≤≥≠])"
    comment_marks: str = "#define|#|//|%"
    first_module: str = r"\s*([A-Za-z_]\w*|\S)?"
    outside: frozenset[str] = frozenset(":")
    readable: frozenset[str] = frozenset("→⟶εωδ∨∧¬≤≥≠−·×")
    corrections: Sequence[tuple[str, str, str]] = CORRECTIONS
    expression: Callable[[Expression], str] = str
    module: Callable[[Module | Pattern], str] = str
    joined: Callable[[Iterable[str]], str] = joined
    wordings: Mapping[str, Wording] = field(default_factory=dict)

    def shown(self, value: object) -> str:
        """A part of a problem's subject, as a message quotes it."""
        if isinstance(value, Number | Name | Apply):
            return self.expression(value)
        if isinstance(value, Pattern):
            return self.module(value)
        if isinstance(value, Production):
            return self.left_side(value)
        return f"{value:,}" if isinstance(value, int) else str(value)

    def left_side(self, rule: Production) -> str:
        """A production's strict predecessor with its contexts."""
        left, own, right = (self.joined(map(self.module, modules)) for modules in (rule.left, rule.predecessors, rule.right))
        return f"{left} < " * bool(left) + own + f" > {right}" * bool(right)


KIT_SPELLING = Spelling()
"""The kit's own notation."""


def spelling_in(folder: Path) -> Spelling:
    """The spelling of a dialect whose words and problems stand in the file `mistakes.toml` of its folder."""
    tables = tomllib.loads((folder / "mistakes.toml").read_text(encoding="utf-8"))
    kinds: Mapping[str, type[ModelError]] = {"syntax": ModelSyntaxError, "value": ModelValueError}
    wordings = {
        code: Wording(row["says"], row.get("hint"), kinds[row.get("kind", "syntax")])
        for code, row in tables["problems"].items()
    }
    return Spelling(**tables["words"], readable=frozenset(tables["patterns"]["READABLE"]), wordings=wordings)
