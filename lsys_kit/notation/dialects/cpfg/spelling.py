"""How messages spell what they quote of a cpfg text."""

from __future__ import annotations

from lsys_kit.errors import ModelValueError
from lsys_kit.notation.dialects.cpfg.expressions import expression_text
from lsys_kit.notation.dialects.cpfg.writer import joined_word, module_text
from lsys_kit.notation.syntax.spelling import Spelling, Wording

SPELLING = Spelling(
    arrow="-->",
    axiom="Axiom: A",
    constant="#define dt 0.5",
    part="#define c ...",
    random="A --> F(ran(2))",
    nothing='"*"',
    rule_example='A production reads "A --> B": what is replaced, an arrow, what replaces it.',
    interpretation="homomorphism",
    depth="maximum depth:",
    contexts='A left context ends with "<", a right context begins with ">", as in "A < B > C --> D".',
    expression=expression_text,
    module=module_text,
    joined=joined_word,
    wordings={
        "bracket in list": Wording(
            "One bracket is listed here without the other", "Right contexts pass over both brackets or over none."
        ),
        "division by zero": Wording(
            '"{expression}" has no value: {reason}',
            "cpfg warns of it and divides by 1; a remainder by 0 ends cpfg.",
            ModelValueError,
        ),
    },
)
"""cpfg's arrow, its macros, its expressions."""
