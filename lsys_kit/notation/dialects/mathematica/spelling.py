"""How messages spell what they quote of a text in Mathematica's notation."""

from __future__ import annotations

import re

from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.dialects.mathematica.expressions import expression_text
from lsys_kit.notation.dialects.mathematica.writer import module_text
from lsys_kit.notation.syntax.spelling import Spelling, Wording

_AXIOM_HINT = 'Give the first word, as in "axiom = AXIOM[A];".'
_UNKNOWN_NAME = 'I do not know the name "{name}"'

SPELLING = Spelling(
    axiom="axiom = AXIOM[A];",
    constant="dt = 0.5;",
    part="c = ...;",
    random="SUCC[F[RandomReal[{1, 2}]]]",
    rule="rule",
    comment='A comment is written between "(*" and "*)".',
    expression=expression_text,
    module=module_text,
    joined=" ".join,
    readable=frozenset("→"),
    apart="Write one rule per line.",
    arrows=re.compile("->|→"),
    corrections=(
        (r"=!=|<>", "This is not a comparison", 'For "not equal", type "!=".'),
        (r"={3,}", "This is not a comparison", 'To compare two values, type "==".'),
        (r"=>", "This is not a comparison", 'For "at least", type ">=".'),
        (r"=<", "This is not a comparison", 'For "at most", type "<=".'),
        (r"(?<!&)&(?!&)|\band\b", "This does not join conditions", 'For "and", type "&&".'),
        (r"(?<!\|)\|(?!\|)|\bor\b", "This does not join conditions", 'For "or", type "||".'),
        (r"\bnot\s+", "This is not an operator", 'For "not", type "!", as in "!(t < 5)".'),
        (r"\d,\d", "A number is typed with a point", 'Type "1.4", not "1,4".'),
        (r"\*\*", "This is not an operator", 'A power is typed "t^2".'),
        (r"\+\+", "This is not an operator", 'One more is typed "t + 1".'),
    ),
    wordings={
        "no axiom": Wording("There is no axiom", _AXIOM_HINT),
        "setting as constant": Wording('"{name}" is not a constant', _AXIOM_HINT, ModelNameError),
        "word as axiom": Wording('"{name}" is not a number', _AXIOM_HINT, ModelNameError),
        "name as constant": Wording(
            '"{name}" is not a number', 'A constant is a number, as in "{constant} = 3;".', ModelNameError
        ),
        "name among none": Wording(
            _UNKNOWN_NAME,
            'A parameter is named with "_" in a pattern, as in "PRED[A[t_]]"; a constant is defined, as in "{constant}".',
            ModelNameError,
        ),
        "symbol as value": Wording(
            _UNKNOWN_NAME,
            'Brackets around values are those of a module; a branch is typed \'F, "[", "+", F, "]"\'.',
            ModelNameError,
        ),
        "number of arguments": Wording("{name}[...] takes {wanted}, not {given}"),
        "random number": Wording(
            '"{expression}" draws a new number at every use, which is not possible here',
            'Random numbers belong in SUCC, as in "{random}".',
            ModelValueError,
        ),
        "range upside down": Wording(
            'The range of "{name}" is upside down',
            'Write the smaller end first, as in "(* {high} .. {low} by {step} *)".',
            ModelValueError,
        ),
        "step of range": Wording(
            'The step of "{name}" must be greater than 0',
            'It says how far one move of the slider goes, as in "(* 1 .. 6 by 0.1 *)".',
            ModelValueError,
        ),
    },
)
"""Mathematica's brackets, functions and comments."""
