"""How messages spell what they quote of a text in GROGRA's notation."""

from __future__ import annotations

import re

from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.dialects.grogra.writer import STYLE, joined_word, module_text
from lsys_kit.notation.model.expressions import Expression, styled_text
from lsys_kit.notation.syntax.spelling import CORRECTIONS, Spelling, Wording

RULE_ARROW = re.compile(r"##?|-->|->|→|⟶|\\(?:long)?rightarrow")
"""The arrows of GROGRA and of its slides."""


def expression_text(expression: Expression) -> str:
    """An expression, with "=" for equality."""
    return styled_text(expression, STYLE)


SPELLING = Spelling(
    arrow="#",
    axiom="\\axiom a,",
    constant="\\const dt 0.5,",
    part="\\const c ...,",
    rule="rule",
    rule_example='A rule reads "a # F a": what is replaced, "#", what replaces it.',
    contexts='A left context ends with "<", a right context begins with ">", as in "s < a > b # c".',
    name_rule="Symbols are made of the letters A to Z, digits, _ and '.",
    apart='Rules are separated by commas: "a # F b, b # F a".',
    repetition='A repetition reads "&(3) < F a >"; for the turn that ABOP writes as "&", type "RL(60)".',
    after_arrow='Contexts come before the "#"; after it "<" and ">" go with "&(3)".',
    depth="\\set depth",
    relations=r"(?:[<>!=]?=|[<>≤≥≠]|\\[lgn]eq?)",
    comment_marks="#define|//",
    outside=frozenset("?<>"),
    first_module=r"(\([^()]*\)\s*)?([A-Za-z_]\w*'*|\S)?",
    corrections=(
        (r"=>(?=[^\n,]*\))", "This is not a comparison", 'For "at least", type ">=".'),
        (r"=<(?=[^\n,]*\))", "This is not a comparison", 'For "at most", type "<=".'),
        (r":=|::=|=>|⇒|↦|[–—−~]>|-[ \t]+>|<-+>?", "This is not an arrow", 'An arrow is typed "#" or "->", in one piece.'),
        *CORRECTIONS,
    ),
    arrows=RULE_ARROW,
    readable=frozenset("→⟶ε−∨∧¬≤≥≠·×"),
    expression=expression_text,
    module=module_text,
    joined=joined_word,
    wordings={
        "setting as constant": Wording('"{name}" is a setting, not a constant', 'Type "\\{keyword} {value},".', ModelNameError),
        "truth as probability": Wording(
            'A probability follows the "?", but "{expression}" is true or false',
            'A condition is written in front: "(t < 6) k(t) # k(t+1)".',
            ModelValueError,
        ),
    },
)
"""GROGRA's arrow, its declarations, its comparisons."""
