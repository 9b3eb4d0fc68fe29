"""What the kit says of the slips in Mathematica's notation, word for word: each message is a small lesson."""

from __future__ import annotations

import re

import pytest

from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read

RULE = 'A rule reads "LRule[LEFT[a], PRED[b], RIGHT[], SUCC[b, c]]"; "LEFT[]" and "RIGHT[]" match anything.'
QUOTES = 'Symbols that are not names need quotation marks, as in \'F, "[", "+", F, "]"\'.'
PRINTED_RULE = (
    'A printed rule reads "a < b > c -> d": left context, what is replaced, right context, an arrow, what replaces it.'
)
EVERY = "Every bracket needs one that closes it."
LETTERS = "Names are made of the letters A to Z, digits and _."
FIRST = 'Give the first word, as in "axiom = AXIOM[A];".'
A_VALUE = 'Possible here: a number, a name or "(".'
TIMES = 'To multiply, type "*", as in "2*t".'
LISTS = 'Rules belong in "LRULES[...]", the axiom in "AXIOM[...]"; what was printed can be left out.'
UNKNOWN = 'A parameter is named with "_" in a pattern, as in "PRED[A[t_]]"; a constant is defined, as in "dt = 0.5;".'
AXIOM = "AXIOM[a[1], b];\n"
"""What stands before a slip that has an axiom."""

BRACKETS = [
    ("axiom = AXIOM[aR;\nlrules = LRULES[];", 'This "[" is never closed', 1, 14, EVERY),
    (AXIOM + "lrules = LRULES[LRule[LEFT[], PRED[a], RIGHT[], SUCC[b]];\nx = 1;", 'This "[" is never closed', 2, 16, EVERY),
    (AXIOM + "LRule[LEFT[], PRED[a[i_ /; i < 3], RIGHT[], SUCC[a[i]]]", 'This "[" is never closed', 2, 19, EVERY),
    (AXIOM + "LRule[LEFT[a[i_], PRED[b], RIGHT[], SUCC[b]]", 'This "[" is never closed', 2, 11, EVERY),
    (
        AXIOM + "LRULES[LRule[LEFT[], PRED[a], RIGHT[], SUCC[b]]]]",
        'This "]" closes nothing',
        2,
        49,
        "Every bracket needs one before it that it closes.",
    ),
    ("AXIOM[a[1}]", '"[" is not closed by "}"', 1, 10, 'Type "]".'),
    ("axiom = AXIOM(aR);", "These brackets are round", 1, 14, 'In Mathematica they are square: "AXIOM[...]".'),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a(i)]]",
        "These brackets are round",
        2,
        43,
        'In Mathematica they are square: "a[...]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Sqrt(i)]]]",
        "These brackets are round",
        2,
        48,
        'In Mathematica they are square: "Sqrt[...]".',
    ),
    ("axiom = AXIOM[];", "There is nothing in these brackets", 1, 14, "Write the first word there: one module or more."),
    (
        AXIOM + "LRule[LEFT[], PRED[], RIGHT[], SUCC[a[i]]]",
        "There is nothing in these brackets",
        2,
        19,
        "Name the module to replace there.",
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[]]]",
        "There is nothing in these brackets",
        2,
        43,
        "Write a value there, or leave the brackets out.",
    ),
    (
        AXIOM + 'LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[F, "[", F]]',
        'This "[" is never closed',
        2,
        45,
        'Every branch ends with "]".',
    ),
    (
        AXIOM + 'LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC["]"]]',
        'This "]" closes nothing',
        2,
        42,
        'Every branch begins with "[".',
    ),
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i],]]", 'There is nothing after this ","', 2, 46, "Leave it out."),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i], , b]]",
        'There is nothing before this ","',
        2,
        48,
        "Leave it out.",
    ),
    (AXIOM + 'skipPattern = {"["}', "A bracket is not possible here", 2, 16, "Contexts follow the branches in any case."),
    ("Axiom: a\nRules: a -> b[1", 'This "[" is never closed', 2, 14, EVERY),
]
"""Brackets, and what stands in them."""

PARTS = [
    (AXIOM + "SUCC[a]", "SUCC[...] is outside of an LRule", 2, 1, RULE),
    (AXIOM + "PRED[a] -> SUCC[b]", "PRED[...] is outside of an LRule", 2, 1, RULE),
    (AXIOM + "LRULES[LEFT[], PRED[a], RIGHT[], SUCC[a]]", "LEFT[...] is outside of an LRule", 2, 8, RULE),
    (AXIOM + "LRule[LEFT[], RIGHT[], SUCC[a]]", "PRED[...] is missing in this LRule", 2, 15, RULE),
    (AXIOM + "LRule[PRED[a], SUCC[a]]", "LEFT[...] is missing in this LRule", 2, 7, RULE),
    (AXIOM + "LRule[LEFT[], PRED[a], SUCC[a]]", "RIGHT[...] is missing in this LRule", 2, 24, RULE),
    (AXIOM + "LRule[LEFT[], PRED[a], RIGHT[]]", "SUCC[...] is missing in this LRule", 2, 31, RULE),
    (AXIOM + "LRule[LEFT[], PRED[a] RIGHT[], SUCC[a]]", 'A "," is missing before RIGHT', 2, 23, RULE),
    (AXIOM + "LRule[a -> b]", "LEFT[...] is missing in this LRule", 2, 7, RULE),
    (AXIOM + "LRULES[a -> b]", "An arrow is not possible in brackets", 2, 10, RULE),
    (
        AXIOM + "LRule[LEFT[], PRED[a, b], RIGHT[], SUCC[a[i]]]",
        "Only one module can be replaced",
        2,
        21,
        'Its neighbours belong in "LEFT[]" or "RIGHT[]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i] b]]",
        'A "," is missing before "b"',
        2,
        47,
        "Modules and parts are separated by commas.",
    ),
    (
        AXIOM + "LRULES[LRule[LEFT[], PRED[a], RIGHT[], SUCC[a]] LRule[LEFT[], PRED[b], RIGHT[], SUCC[]]]",
        'A "," is missing before "LRule"',
        2,
        49,
        "Modules and parts are separated by commas.",
    ),
    (AXIOM + "rules = {a -> b};", "A list is not possible here", 2, 9, LISTS),
    (
        AXIOM + "rules = LRULES[];\nLSystem[rules, axiom]",
        'No axiom has the name "rules"',
        3,
        9,
        'An L-system reads "lsystem = LSystem[axiom, lrules];": its axiom, then its rules.',
    ),
    (AXIOM + "LSystem[axiom]", "The rules are missing", 2, 14, 'An L-system reads "LSystem[axiom, lrules]".'),
    (
        "axiom = AXIOM[a[1], b];\nLSystem[axiom, LRULES[grow]]",
        'No rule has the name "grow"',
        2,
        23,
        'A rule is defined before its name is used in LRULES: "grow = LRule[LEFT[], PRED[A], RIGHT[], SUCC[A, A]];".',
    ),
    (
        "axiom = AXIOM[a[1], b];\ns = LSystem[axiom, LRULES[]];\nrunKLSystem[system, 4]",
        'No system has the name "system"',
        3,
        13,
        'A system is run after it is defined: "lsystem = LSystem[axiom, lrules];".',
    ),
    (
        "axiom = AXIOM[a[1], b];\nlsystem = LSystem[axiom, LRULES[]];\nrunKLSystem[lsystm, 4]",
        'No system has the name "lsystm"',
        3,
        13,
        'Did you mean "lsystem"?',
    ),
    (AXIOM + "runKLSystem[lsystem]", "The number of steps is missing", 2, 20, 'A run reads "runKLSystem[lsystem, 6];".'),
    (AXIOM + "runKLSystem[lsystem, 5/2]", '"2.5" is not a number of steps', 2, 22, "Steps are counted from 0: 0, 1, 2, ..."),
]
"""The parts of a rule, of a system, of a run."""

DEFINITIONS = [
    ("axiom = aR;", '"aR" is not a number', 1, 9, FIRST),
    ("axiom: AXIOM[a];", 'A definition has one "="', 1, 8, 'Type "axiom = AXIOM[a];".'),
    ("axiom AXIOM[a];", 'A definition has one "="', 1, 7, 'Type "axiom = AXIOM[a];".'),
    ("AXOIM[a];", 'I do not know "AXOIM[...]"', 1, 1, 'Did you mean "AXIOM"?'),
    ("axiom = AXOIM[a[1]];", 'I do not know "AXOIM[...]"', 1, 9, 'Did you mean "AXIOM"?'),
    ("w == 11;", 'A definition has one "="', 1, 3, 'Type "w = 11;".'),
    (AXIOM + "w = 2 k;", 'An operator is missing before "k"', 2, 7, TIMES),
    (AXIOM + "w = 1,4;", "A number is typed with a point", 2, 5, 'Type "1.4", not "1,4".'),
    (AXIOM + "w =", "A value is missing here", 2, 4, A_VALUE),
    (AXIOM + "steps: 4", 'A definition has one "="', 2, 6, 'Type "runKLSystem[lsystem, 4];".'),
    (AXIOM + "angle = 30 Degree", "Degree is not needed here", 2, 12, 'Angles are in degrees; only "Sin[x Degree]" says so.'),
    (AXIOM + "turtle = grogra", "Quotation marks are missing here", 2, 10, 'Type "grogra" with a quotation mark on each side.'),
    (
        AXIOM + 'turtle = "logo"',
        'I do not know the turtle commands of "logo"',
        2,
        10,
        'Turtle commands are those of "abop", "grogra", "plant-string" or "fractint".',
    ),
    (AXIOM + "skipPattern = F", "Braces are missing here", 2, 15, 'Type "{F}".'),
    (AXIOM + "skipPattern = {F +}", 'The symbol "+" has no quotation marks', 2, 18, QUOTES),
    (
        AXIOM + "k = m;\nm = k + 1",
        'The constant "k" is defined in terms of itself',
        2,
        1,
        "Give it a value that can be computed without it.",
    ),
    (AXIOM + "k = 1/0", '"1/0" has no value: division by zero', 2, 5, None),
    (
        "w = 20; (* 2 .. 15 by 1 *)\nAXIOM[a[1], b];\n",
        '"w" is 20, which is not in its range 2 .. 15',
        1,
        5,
        "Choose a value in the range, or a wider range.",
    ),
    (
        "w = 3; (* 15 .. 2 by 1 *)\nAXIOM[a[1], b];\n",
        'The range of "w" is upside down',
        1,
        11,
        'Write the smaller end first, as in "(* 2 .. 15 by 1 *)".',
    ),
    (
        "w = 3; (* 2 .. 15 by 0 *)\nAXIOM[a[1], b];\n",
        'The step of "w" must be greater than 0',
        1,
        22,
        'It says how far one move of the slider goes, as in "(* 1 .. 6 by 0.1 *)".',
    ),
    ("(* a comment\nAXIOM[a[1], b];\n", "This comment is never closed", 1, 1, 'A comment ends with "*)".'),
    ("w = 3; *)\nAXIOM[a[1], b];\n", "This comment was never opened", 1, 8, 'A comment begins with "(*".'),
    ("(* (* (* (* *) *) *) *)", "Comments are nested more than 3 deep", 1, 10, None),
    ("axiom = 5", '"axiom" is not a constant', 1, 1, FIRST),
    ("lrules = LRULES[]", "There is no axiom", 1, 18, FIRST),
    ("", "There is no axiom", 1, 1, FIRST),
    (AXIOM + "k_ = 3", 'A constant has a name without "_" at its end', 2, 1, 'Type "k".'),
    (AXIOM + "foo[a]", 'I do not know "foo[...]"', 2, 1, "What prints or draws can be left out; a rule has an arrow."),
    (AXIOM + "k = Power[2, 3]", 'I do not know "Power[...]"', 2, 5, 'A power is typed "t^2".'),
    (AXIOM + "x = nothing", '"nothing" is not a number', 2, 5, 'A constant is a number, as in "x = 3;".'),
]
"""Definitions, comments and sliders."""

NAMES = [
    ("AXIOM[$a]", 'A name has no "$"', 1, 7, LETTERS),
    ("AXIOM[α]", 'I cannot read the character "α" (GREEK SMALL LETTER ALPHA)', 1, 7, LETTERS),
    ("AXIOM[\\[Alpha]]", 'I cannot read "\\[Alpha]"', 1, 7, 'Spell the letter: "alpha".'),
    ("AXIOM[\u0430]", 'I cannot read the character "\u0430" (CYRILLIC SMALL LETTER A)', 1, 7, LETTERS),
    ("AXIOM[F, +, F]", 'The symbol "+" has no quotation marks', 1, 10, QUOTES),
    ("AXIOM[F, [, F, ]]", 'The symbol "[" has no quotation marks', 1, 10, QUOTES),
    ("AXIOM[F+F]", 'The symbol "+" has no quotation marks', 1, 8, QUOTES),
    (
        'AXIOM["F+F"]',
        "There is more than one symbol between these quotation marks",
        1,
        7,
        "Separate symbols by commas, as in 'F, \"+\", F'.",
    ),
    (
        'AXIOM[F, "+]',
        "This quotation mark is never closed",
        1,
        10,
        'Symbols that are not names need quotation marks, as in \'F, "[", "+", F, "]"\'. A "\\" is typed "\\\\".',
    ),
    (
        "AXIOM[F[+F]]",
        'I do not know the name "F"',
        1,
        10,
        'Brackets around values are those of a module; a branch is typed \'F, "[", "+", F, "]"\'.',
    ),
    (AXIOM + "LRule[LEFT[], PRED[x_], RIGHT[], SUCC[a[i]]]", 'A symbol has a name without "_" at its end', 2, 20, 'Type "x".'),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i]], RIGHT[], SUCC[a[i]]]",
        'No constant has the name "i"',
        2,
        22,
        'A parameter is named with "_" after it: "i_".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i /; i < 3]], RIGHT[], SUCC[a[i]]]",
        'A parameter is named with "_" after it',
        2,
        22,
        'Type "i_ /; ...".',
    ),
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i_]]]", 'I do not know the name "i_"', 2, 44, 'Did you mean "i"?'),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i + 1]], RIGHT[], SUCC[a[i]]]",
        'No constant has the name "i"',
        2,
        22,
        'A parameter is named with "_" after it: "i_".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_Integer]], RIGHT[], SUCC[a[i]]]",
        'No constant has the name "i_Integer"',
        2,
        22,
        'A parameter is named with "_" after it: "i_".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i__]], RIGHT[], SUCC[a[i]]]",
        '"i__" matches a row of values',
        2,
        22,
        'A parameter matches one: type "i_".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_?NumberQ]], RIGHT[], SUCC[a[i]]]",
        'I did not expect "?" after a parameter',
        2,
        24,
        'A condition follows "/;", as in "i_ /; i < 5".',
    ),
    (
        AXIOM + "LRule[LEFT[a[i_]], PRED[a[i_]], RIGHT[], SUCC[a[i]]]",
        'The parameter "i" is named twice',
        2,
        27,
        "Give each parameter a name of its own.",
    ),
    (
        "i = 3;\nAXIOM[a[1], b];\nLRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i]]]",
        '"i" is already a constant',
        3,
        22,
        'Give the parameter another name; or type "i" to match the constant\'s value.',
    ),
    (
        "lifeTime = 3;\nAXIOM[a[1], b];\nLRule[LEFT[], PRED[a[lifetime]], RIGHT[], SUCC[a[i]]]",
        'No constant has the name "lifetime"',
        3,
        22,
        'Did you mean "lifeTime"?',
    ),
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[j]]]", 'I do not know the name "j"', 2, 44, 'Known here: "i".'),
    (AXIOM + "LRule[LEFT[], PRED[b], RIGHT[], SUCC[a[j]]]", 'I do not know the name "j"', 2, 40, UNKNOWN),
    (
        AXIOM + "LRule[LEFT[], PRED[a[Degree_]], RIGHT[], SUCC[a[i]]]",
        'A parameter cannot be called "Degree"',
        2,
        22,
        "It says that an angle is in degrees.",
    ),
]
"""Symbols, parameters and constants."""

CONDITIONS = [
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_; i < 3]], RIGHT[], SUCC[a[i]]]",
        'I did not expect ";" after a parameter',
        2,
        24,
        'A condition follows "/;", as in "i_ /; i < 5".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ : i < 3]], RIGHT[], SUCC[a[i]]]",
        'I did not expect ":" after a parameter',
        2,
        25,
        'A condition follows "/;", as in "i_ /; i < 5".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i_ /; i < 3]]]",
        "A condition is not possible here",
        2,
        47,
        "Conditions follow the patterns in LEFT, PRED and RIGHT.",
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i] /; i < 3]]",
        "A condition is not possible here",
        2,
        47,
        "Conditions follow the patterns in LEFT, PRED and RIGHT.",
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i = 1]], RIGHT[], SUCC[a[i]]]",
        'A single "=" cannot be used here',
        2,
        30,
        'To compare two values, type "==".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i === 1]], RIGHT[], SUCC[a[i]]]",
        "This is not a comparison",
        2,
        30,
        'To compare two values, type "==".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i =< 1]], RIGHT[], SUCC[a[i]]]",
        "This is not a comparison",
        2,
        30,
        'For "at most", type "<=".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i => 1]], RIGHT[], SUCC[a[i]]]",
        "This is not a comparison",
        2,
        30,
        'For "at least", type ">=".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i <> 1]], RIGHT[], SUCC[a[i]]]",
        "This is not a comparison",
        2,
        30,
        'For "not equal", type "!=".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i > 1 and i < 3]], RIGHT[], SUCC[a[i]]]",
        "This does not join conditions",
        2,
        34,
        'For "and", type "&&".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i > 1 or i < 0]], RIGHT[], SUCC[a[i]]]",
        "This does not join conditions",
        2,
        34,
        'For "or", type "||".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; not i > 1]], RIGHT[], SUCC[a[i]]]",
        "This is not an operator",
        2,
        28,
        'For "not", type "!", as in "!(t < 5)".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i]], RIGHT[], SUCC[a[i]]]",
        '"i" is a number, but something true or false is needed here',
        2,
        28,
        'Compare it with something, as in "i > 0".',
    ),
    (AXIOM + "LRule[LEFT[], PRED[a[i_ /; i <]], RIGHT[], SUCC[a[i]]]", "A value is missing here", 2, 31, A_VALUE),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; Sqrt[i]]], RIGHT[], SUCC[a[i]]]",
        '"Sqrt[i]" is a number, but something true or false is needed here',
        2,
        28,
        'Compare it with something, as in "Sqrt[i] > 0".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_ /; i < RandomReal[{0, 1}]]], RIGHT[], SUCC[a[i]]]",
        '"RandomReal[{0, 1}]" draws a new number at every use, which is not possible here',
        2,
        32,
        'Random numbers belong in SUCC, as in "SUCC[F[RandomReal[{1, 2}]]]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i > 1]]]",
        '"i > 1" is true or false, but a number is needed here',
        2,
        44,
        None,
    ),
]
"""Conditions."""

VALUES = [
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[2 i]]]", 'An operator is missing before "i"', 2, 46, TIMES),
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[2(i + 1)]]]", 'An operator is missing before "("', 2, 45, TIMES),
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i**2]]]", "This is not an operator", 2, 45, 'A power is typed "t^2".'),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i++]]]",
        "This is not an operator",
        2,
        45,
        'One more is typed "t + 1".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[sqrt[i]]]]",
        'I do not know the function "sqrt"',
        2,
        44,
        'Did you mean "Sqrt"?',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Sqr[i]]]]",
        'I do not know the function "Sqr"',
        2,
        44,
        'Did you mean "Sqrt"?',
    ),
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Sqrt[i, 2]]]]", "Sqrt[...] takes one value, not 2", 2, 44, None),
    (AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Max[i]]]]", "Max[...] takes 2 or more values, not 1", 2, 44, None),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Sin[i]]]]",
        "Sin[...] without Degree takes an angle in radians",
        2,
        44,
        'Angles are in degrees here: type "Sin[x Degree]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Sin[i + 1 Degree]]]]",
        "Degree belongs to the whole angle",
        2,
        54,
        'Put parentheses around a sum: "Sin[(x + y) Degree]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Sin[i/Degree]]]]",
        "An angle is so many times Degree",
        2,
        49,
        'Type "Sin[x Degree]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[ArcSin[i]]]]",
        "ArcSin[...] is an angle in radians",
        2,
        44,
        'Angles are in degrees here: type "ArcSin[x]/Degree".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[ArcSin[i]*Degree]]]",
        "ArcSin[...] is an angle in radians",
        2,
        44,
        'Angles are in degrees here: type "ArcSin[x]/Degree".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[Random[]]]]",
        "The range of a random number is missing",
        2,
        51,
        'It reads "RandomReal[{0, 1}]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[RandomInteger[{1, 6}]]]]",
        'I do not know the function "RandomInteger"',
        2,
        58,
        'A whole number from 1 to 6 is "Floor[RandomReal[{1, 7}]]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[RandomVariate[Normal[0, 1]]]]]",
        'I do not know the distribution "Normal"',
        2,
        58,
        "Distributions are: NormalDistribution, BinomialDistribution, PoissonDistribution.",
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[RandomChoice[{1, 2} -> {1, 2}]]]]",
        "The weights are those of 0, 1, 2, ...",
        2,
        68,
        'Type as many numbers as weights, as in "RandomChoice[{1, 2, 1} -> {0, 1, 2}]".',
    ),
    (
        AXIOM + "LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[gamma[i]]]]",
        'I do not know the function "gamma"',
        2,
        44,
        "Functions are: Abs, Ceiling, Cos, EvenQ, Exp, Floor, If, Log, Max, Min, Mod, Negative, NonNegative, NonPositive, "
        "OddQ, Positive, Sin, Sqrt, Tan.",
    ),
]
"""Values and functions."""

PRINTED = [
    ("Axiom: a[1]b\nRules: a[i_ /; i < 3] < b > c", "An arrow is missing here", 2, 30, PRINTED_RULE),
    ("Axiom: a\nRules: a < b > c -> d -> e", "This is a second arrow in one rule", 2, 23, "Write one rule per line."),
    ("Axiom: a\nRules: -> b", "The module to replace is missing", 2, 8, PRINTED_RULE),
    ("Axiom: a\nRules: a < -> b", "The module to replace is missing", 2, 12, PRINTED_RULE),
    ("Axiom: a\nRules: a b -> c", "Only one module can be replaced", 2, 12, 'Neighbours are contexts, as in "a < b > c -> d".'),
    (
        "Axiom: a\nRules: a[i_] /; i < 3 -> b",
        "In a printed rule a condition belongs in the brackets",
        2,
        14,
        'Type "a[i_ /; i < 3] -> b".',
    ),
    ("Axiom: a, b", 'A "," is not needed here', 1, 9, "In a printed word modules are written side by side."),
    ("Axiom: a + b", 'The symbol "+" has no quotation marks', 1, 10, QUOTES),
    ("Axiom: a\nRules: a < b < c -> d", 'This is a second "<"', 2, 14, PRINTED_RULE),
    ("Axiom: a\nRules: a --> b", "This is not an arrow", 2, 10, 'An arrow is typed "->".'),
    (
        "Axiom: a\nRules: a -> b : 0.5",
        "This notation has no probabilities",
        2,
        15,
        "Probabilities can be written in the notation abop.",
    ),
    ("Axiom: a\na b", "An arrow is missing here", 2, 4, PRINTED_RULE),
    ("{a, a b, b a a}", "A list is not possible here", 1, 1, LISTS),
    ("Axiom:", 'There is nothing after "Axiom:"', 1, 7, 'Write the first word there, as in "Axiom: a[1]b".'),
]
"""Printed systems."""


EVERY_SLIP = [*BRACKETS, *PARTS, *DEFINITIONS, *NAMES, *CONDITIONS, *VALUES, *PRINTED]


@pytest.mark.parametrize(("text", "message", "line", "column", "hint"), EVERY_SLIP)
def test_a_slip_is_explained(text: str, message: str, line: int, column: int, hint: str | None) -> None:
    with pytest.raises(LSystemError) as caught:
        read(text, "mathematica")
    error = caught.value
    assert (error.message, error.line, error.column, error.hint or None) == (message, line, column, hint)


def test_every_slip_is_another() -> None:
    assert len({text for text, *_ in EVERY_SLIP}) == len(EVERY_SLIP) >= 100


def test_no_slip_is_only_unexpected() -> None:
    assert not [message for _, message, *_ in EVERY_SLIP if re.match("I did not expect .* here|The line ends", message)]
