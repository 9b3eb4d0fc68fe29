"""What the kit says of the slips that students make, word for word: each message is a small lesson."""

from __future__ import annotations

import re
from collections.abc import Sequence

import pytest

from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.read import read

NO_NAMES = 'A parameter is named before the arrow, as in "A(t) -> A(t+1)"; a constant on a line before, as in "dt = 0.5".'
PRODUCTION = 'A production reads "A -> B": what is replaced, an arrow, what replaces it.'
A_VALUE = 'Possible here: a number, a name or "(".'
KEEP_OUT = "Step 0 is the last that can be reached. A condition before the arrow can keep such values out."

UNREADABLE = [
    ("axiom: A(0)\nA(t) : t = 1 -> B", 'A single "=" cannot be used here', 2, 10, 'To compare two values, type "==".'),
    ("axiom: A\nA B C", "An arrow is missing here", 2, 3, PRODUCTION),
    ("axiom: A(0)\nA(t : t < 1 -> B", 'This "(" is never closed', 2, 2, 'Every "(" needs a ")" after it.'),
    ("axiom: A(0)\nA(t) -> B(t", 'This "(" is never closed', 2, 10, 'Every "(" needs a ")" after it.'),
    ("axiom: A(0)\nA(t) -> B(t))", 'This ")" closes nothing', 2, 13, 'Every ")" needs a "(" before it.'),
    ("axiom: A(0)\nA(t) -> B(t+1", 'This "(" is never closed', 2, 10, 'Every "(" needs a ")" after it.'),
    ("axiom: A(0)\nA(t) -> B((t+1)", 'This "(" is never closed', 2, 10, 'Every "(" needs a ")" after it.'),
    ("axiom: A\nA -> [B", 'This "[" is never closed', 2, 6, 'Every branch ends with "]".'),
    ("axiom: A\nA -> B]", 'This "]" closes nothing', 2, 7, 'Every branch begins with "[".'),
    ("axiom: A\nA ->", "There is nothing after the arrow", 2, 3, 'To erase A, write "ε" or "*" there.'),
    ("axiom: A(0)\nA(t) -> A(sqrt(t, 2))", "sqrt(...) takes one value, not 2", 2, 11, None),
    ("axiom: A(0)\nA(t) -> A(max(t))", "max(...) takes 2 or more values, not 1", 2, 11, None),
    (
        "axiom: A(0)\nA(t) -> A(sqrt())",
        "There is nothing in these parentheses",
        2,
        15,
        "Write a value there, or leave the parentheses out.",
    ),
    (
        "axiom: A\n\u0410 -> B",
        'I cannot read the character "А" (CYRILLIC CAPITAL LETTER A)',
        2,
        1,
        "Names are made of the letters A to Z, digits and _.",
    ),
    (
        "axiom: A\nA\u202e -> B",
        "I cannot read the character RIGHT-TO-LEFT OVERRIDE",
        2,
        2,
        "Names are made of the letters A to Z, digits and _.",
    ),
    ("axiom: A\nA -> B -> C", "This is a second arrow in one production", 2, 8, "Write one production per line."),
    ("axiom: A\nA - > B", "This is not an arrow", 2, 3, 'An arrow is typed "->", in one piece.'),
    ("axiom: A\nA => B", "This is not an arrow", 2, 3, 'An arrow is typed "->", in one piece.'),
    (
        "axiom: A\nA = B C",
        'I did not expect "C" here',
        2,
        7,
        'A constant reads "dt = 0.5", or "dt = 0.5 in 0.1 .. 2 by 0.1"; a production, "A -> B".',
    ),
    ("axiom: A\nA := B", "This is not an arrow", 2, 3, 'An arrow is typed "->", in one piece.'),
    ("axiom: A\nA > B", "An arrow is missing here", 2, 6, PRODUCTION),
    ("axiom: A\nA - B", "An arrow is missing here", 2, 3, PRODUCTION),
    ("axiom: A\nA : B", "An arrow is missing here", 2, 6, PRODUCTION),
    ("axiom: A(0)\nA(t) = A(t+1)", "This is not an arrow", 2, 6, PRODUCTION),
    ("axiom: A(0)\nA(t) : 1 < t < 3 -> B", "This is a second comparison", 2, 14, 'Compare twice, as in "1 < t && t < 3".'),
    ("A -> B", "There is no axiom", 1, 7, 'Give the first word on a line of its own, as in "axiom: A".'),
    ("", "There is no axiom", 1, 1, 'Give the first word on a line of its own, as in "axiom: A".'),
    ("axiom: A\naxiom: B\nA -> B", "This is a second axiom", 2, 1, "A system has one axiom."),
    ("axiom A\nA -> B", 'A ":" is missing after "axiom"', 1, 1, 'Type "axiom: A".'),
    ("axiom:\nA -> B", 'There is nothing after "axiom:"', 1, 1, "Possible here: a name or a symbol."),
    ("axioma: A\nA -> B", 'I do not know "axioma:"', 1, 1, 'Did you mean "axiom:"?'),
    ("start: A\nA -> B", 'I do not know "start:"', 1, 1, 'Did you mean "axiom:"?'),
    ("dt = 3 in 1 .. \naxiom: A", "A value is missing here", 1, 15, A_VALUE),
    ("dt = 3 in 1 - 6\naxiom: A", "The line ends too early", 1, 16, 'Possible here: "..".'),
    ("dt = 3 in 1 to 6\naxiom: A", 'I did not expect "to" here', 1, 13, 'Possible here: "..".'),
    ("dt = 3 in 1 ... 6\naxiom: A", "A value is missing here", 1, 15, A_VALUE),
    ("dt = 3 in 1..6 by\naxiom: A", "A value is missing here", 1, 18, A_VALUE),
    (
        "dt = 3 in 1..6 step 2\naxiom: A",
        'I did not expect "step" here',
        1,
        16,
        'A constant reads "dt = 0.5", or "dt = 0.5 in 0.1 .. 2 by 0.1".',
    ),
    ("dt: 3\naxiom: A", 'I do not know "dt:"', 1, 1, 'A constant is declared with "=", as in "dt = 3".'),
    ("#define dt 3\naxiom: A", "This is not a production", 1, 1, 'A constant is declared as in "dt = 0.5".'),
    ("dt = \naxiom: A", "A value is missing here", 1, 5, A_VALUE),
    ("axiom: A(1e999999999)", "This number is too long", 1, 10, "Numbers go up to about 10^308."),
    ("axiom: A\n/* A -> B", "This comment is never closed", 2, 1, 'A comment ends with "*/".'),
    ("axiom: A\nA -> B */", "This comment was never opened", 2, 8, 'A comment begins with "/*".'),
    ("axiom: A\n# comment\nA -> B", "This is not a production", 2, 1, 'A comment is written between "/*" and "*/".'),
    ("axiom: A\nA -> B; C -> D", "This is a second arrow in one production", 2, 11, "Write one production per line."),
    ("axiom: A, B\nA -> B", 'A "," is not needed here', 1, 9, "Modules and names are separated by blanks."),
    ("axiom: A\nA(t+1 -> B", 'This "(" is never closed', 2, 2, 'Every "(" needs a ")" after it.'),
    ("axiom: A\nA() -> B", "There is nothing in these parentheses", 2, 2, "Write a value there, or leave the parentheses out."),
    ("axiom: A(1;2)\nA(x;y) -> B", 'This ";" does not separate values', 1, 11, 'Values are separated by ",", as in "A(1, 2)".'),
    ("axiom: A(1 2)", 'An operator is missing before "2"', 1, 12, 'To multiply, type "*", as in "2*t".'),
    ("axiom: A(0)\nA(t) : t < -> B", "A value is missing here", 2, 12, A_VALUE),
    (
        "axiom: A(0)\nA(t) : -> B",
        "There is no condition before the arrow",
        2,
        8,
        'Write one, as in "t < 5", or leave the ":" out.',
    ),
    (
        "axiom: A(0)\nA(t) t < 5 -> B",
        'A ":" is missing before the condition',
        2,
        6,
        'A condition is written between ":" and the arrow, as in "A(t) : t < 5 -> B".',
    ),
    ("axiom: A(0)\nA(t) : t < 5 and t > 2 -> B", "This does not join conditions", 2, 14, 'For "and", type "&&".'),
    ("axiom: A(0)\nA(t) : t < 5 & t > 2 -> B", "This does not join conditions", 2, 14, 'For "and", type "&&".'),
    ("axiom: A(0)\nA(t) : not t < 5 -> B", "This is not an operator", 2, 8, 'For "not", type "!", as in "!(t < 5)".'),
    ("axiom: A(0)\nA(t) : t =< 5 -> B", "This is not a comparison", 2, 10, 'For "at most", type "<=".'),
    ("axiom: A(0)\nA(t) : t => 5 -> B", "This is not a comparison", 2, 10, 'For "at least", type ">=".'),
    ("axiom: A(0)\nA(t) : t <> 5 -> B", "This is not a comparison", 2, 10, 'For "not equal", type "!=".'),
    ("axiom: A(0)\nA(t) : t === 5 -> B", "This is not a comparison", 2, 10, 'To compare two values, type "==".'),
    ("axiom: A(0)\nA(t) -> A(2t)", 'An operator is missing before "t"', 2, 12, 'To multiply, type "*", as in "2*t".'),
    ("axiom: A(0)\nA(t) -> A(t**2)", "This is not an operator", 2, 12, 'A power is typed "t^2".'),
    ("axiom: A(0)\nA(t) -> A(t%2)", 'I did not expect "%" here', 2, 12, 'Possible here: "(", ")" or ",".'),
    ("axiom: A(1.)\n", "This number is not complete", 1, 10, 'Type "1" or "1.0".'),
    ('axiom: "A"', "Quotation marks are not needed here", 1, 8, "Words are typed without quotation marks."),
    (
        "axiom: 2",
        "A number is not a module",
        1,
        8,
        'Values are written in parentheses after a symbol, as in "A(2)"; for three turns type '
        '"+++", for the colour 2, ";(2)". Where a digit is a symbol, "alphabet: 2" says so.',
    ),
    ("axiom: A\n-> B", "There is nothing before the arrow", 2, 1, PRODUCTION),
    ("axiom: A\n(A) -> B", 'I did not expect "(" here', 2, 1, "Possible here: a name or a symbol."),
    (
        "axiom: A\nA -> B : 0.5 : 0.5",
        'This ":" comes after the arrow',
        2,
        14,
        'A condition comes before it, as in "A(t) : t < 5 -> B".',
    ),
    ("axiom: A [ B", 'This "[" is never closed', 1, 10, 'Every branch ends with "]".'),
    ("axiom: A\nA ⇒ B", "This is not an arrow", 2, 3, 'An arrow is typed "->", in one piece.'),
    ("angle 60\naxiom: A", 'A ":" is missing after "angle"', 1, 1, 'Type "angle: 60".'),
    ("axiom: F = F\nF -> F", 'A single "=" cannot be used here', 1, 10, 'To compare two values, type "==".'),
    ("angle: \naxiom: A", 'There is nothing after "angle:"', 1, 1, 'Possible here: "(", a name or a number.'),
    ("axiom: +(60°)", "This sign is not needed", 1, 12, "Angles are in degrees."),
    ("alphabet:\naxiom: A", 'There is nothing after "alphabet:"', 1, 1, "Possible here: a name."),
    ("alphabet: a,b\naxiom: A", 'A "," is not needed here', 1, 12, "Modules and names are separated by blanks."),
    ("produktions:\naxiom: A\nA -> B", 'I do not know "produktions:"', 1, 1, 'Did you mean "productions:"?'),
    ("axiom: A\nA(1)(2) -> B", 'I did not expect "(" here', 2, 5, 'Possible here: ":", a name, a symbol or an arrow.'),
    ("axiom: A\0B", "I did not expect U+0000 here", 1, 9, 'Possible here: "(", a name, a symbol or the end of the line.'),
    ("axiom: A\ud800B", "I cannot read the character U+D800", 1, 9, "Names are made of the letters A to Z, digits and _."),
    (
        "axiom: Ä",
        'I cannot read the character "Ä" (LATIN CAPITAL LETTER A WITH DIAERESIS)',
        1,
        8,
        "Names are made of the letters A to Z, digits and _.",
    ),
    (
        "axiom: A\nA -> ε B",
        'Nothing else is possible beside "ε" (GREEK SMALL LETTER EPSILON)',
        2,
        8,
        "It says that the successor is empty.",
    ),
    ("axiom: A\nA -> B *", 'Nothing else is possible beside "*"', 2, 8, "It says that the successor is empty."),
    ("angle: 60\nangle: 90\naxiom: A", '"angle:" is set a second time', 2, 1, "Keep one of the two lines."),
    ("axiom: A\nA -> B\nA -> “C”", "Quotation marks are not needed here", 3, 6, "Words are typed without quotation marks."),
    ("axiom: A(1e400)", "This number is too large", 1, 10, "Numbers go up to about 10^308."),
    ("axiom: A\nA(t) : t < 5\n  -> A(t + 1", 'This "(" is never closed', 3, 7, 'Every "(" needs a ")" after it.'),
    ("axiom: A\n  A -> B\n  B -> ", "There is nothing after the arrow", 3, 5, 'To erase B, write "ε" or "*" there.'),
    ("axiom: A(1/3, 2)\nA(x, y) : x < 1 | y < 1 -> B", "This does not join conditions", 2, 17, 'For "or", type "||".'),
    ("axiom: A\nA -> [B)", 'This ")" closes nothing', 2, 8, 'A branch that begins with "[" ends with "]".'),
    ("axiom: A(0)\nA(t) : t ≤ 5 ≤ 7 -> B", "This is a second comparison", 2, 14, 'Compare twice, as in "t ≤ 5 && 5 ≤ 7".'),
    ("axiom: A\nA ->-> B", "This is a second arrow in one production", 2, 5, "Write one production per line."),
    ("axiom: A(0)\nA(t) : t != -> B", "A value is missing here", 2, 13, A_VALUE),
    ("axiom: A(0)\nA(t) ->\n", "There is nothing after the arrow", 2, 6, 'To erase A(t), write "ε" or "*" there.'),
    ("axiom: A(0)\nA(t) : (t < 5 -> B", 'This "(" is never closed', 2, 8, 'Every "(" needs a ")" after it.'),
    ("axiom: A(0)\nA(t) : t < 5) -> B", 'This ")" closes nothing', 2, 13, 'Every ")" needs a "(" before it.'),
    ("axiom: A(0)\nA(t) :: t < 5 -> B", "A value is missing here", 2, 7, A_VALUE),
    ("axiom: A\n/* ( */ A -> B -> C", "This is a second arrow in one production", 2, 16, "Write one production per line."),
    ("axiom: A\nA /* \u202e */ ->", "There is nothing after the arrow", 2, 11, 'To erase A, write "ε" or "*" there.'),
    ("axiom: A\nA(t) : t < 1, t > 3 -> B", 'I did not expect "," here', 2, 13, "Possible here: an arrow."),
    ("dt 3\naxiom: A", "An arrow is missing here", 1, 4, PRODUCTION),
    ("axiom: A(2^0.5^)", "A value is missing here", 1, 16, A_VALUE),
    ("axiom: A(floor())", "There is nothing in these parentheses", 1, 15, "Write a value there, or leave the parentheses out."),
]
"""A model, what is said of it, the line and the column, and the hint."""
UNKNOWN = [
    ("axiom: A(0)\nA(t) : tt < 5 -> A(t+1)", 'I do not know the name "tt"', 2, 8, 'Did you mean "t"?'),
    ("axiom: A(0)\nA(time) : tme < 5 -> A(time+1)", 'I do not know the name "tme"', 2, 11, 'Did you mean "time"?'),
    (
        "lifeTimeA = 3\naxiom: A(0)\nA(t) : t < lifetimeA -> A(t+1)",
        'I do not know the name "lifetimeA"',
        3,
        12,
        'Did you mean "lifeTimeA"?',
    ),
    ("axiom: A\nA -> A(t)", 'I do not know the name "t"', 2, 8, NO_NAMES),
    ("axiom: A(0)\nA(t) -> A(sqr(t))", 'I do not know the function "sqr"', 2, 11, 'Did you mean "sqrt"?'),
    ("axiom: A(0)\nA(t) -> A(tanh(t))", 'I do not know the function "tanh"', 2, 11, 'Did you mean "tan"?'),
    (
        "axiom: A(0)\nA(t) -> A(gamma(t))",
        'I do not know the function "gamma"',
        2,
        11,
        "Functions are: abs, acos, asin, atan, binomial, ceil, cos, exp, floor, if, log, max, min, mod, normal, poisson, rem, "
        "sensed, sin, sqrt, table, tan, uniform.",
    ),
    ("axiom: A\nA = B", 'I do not know the name "B"', 2, 5, 'A production reads "A -> B".'),
    ("dt = 1\ndt = 2\naxiom: A", 'The constant "dt" is declared twice', 2, 1, "Keep one of the two lines."),
    ("dt = x\naxiom: A", 'I do not know the name "x"', 1, 6, 'A production reads "dt -> x".'),
    ("axiom: A(1, 2)\nA(x, x) -> B", 'The parameter "x" is named twice', 2, 6, "Give each parameter a name of its own."),
    (
        "axiom: A\nA(t+1) -> B",
        'Before the arrow a parameter is a name alone, not "t + 1"',
        2,
        3,
        'Write "t" there, and the calculation after the arrow.',
    ),
    ("angle: x\naxiom: A", 'I do not know the name "x"', 1, 8, NO_NAMES),
    ("axiom: A(t)\n", 'I do not know the name "t"', 1, 10, NO_NAMES),
    ("dt = 2\nangle: dt\naxiom: A", 'The constant "dt" cannot be used here', 2, 8, '"angle:" is set to a number.'),
]
"""Names that stand for nothing."""
SENSELESS = [
    (
        "axiom: A(0)\nA(t) : t -> B",
        '"t" is a number, but something true or false is needed here',
        2,
        8,
        'Compare it with something, as in "t > 0".',
    ),
    ("axiom: A(0)\nA(t) -> B(t < 1)", '"t < 1" is true or false, but a number is needed here', 2, 11, None),
    (
        "axiom: A(0)\nA(t) : t && 1 -> B",
        '"t" is a number, but something true or false is needed here',
        2,
        8,
        'Compare it with something, as in "t > 0".',
    ),
    (
        "dt = 9 in 1 .. 6\naxiom: A",
        '"dt" is 9, which is not in its range 1 .. 6',
        1,
        6,
        "Choose a value in the range, or a wider range.",
    ),
    ("dt = 3 in 6 .. 1\naxiom: A", 'The range of "dt" is upside down', 1, 11, 'Write the smaller end first: "in 1 .. 6".'),
    (
        "dt = 3 in 1 .. 6 by 0\naxiom: A",
        'The step of "dt" must be greater than 0',
        1,
        21,
        'It says how far one move of the slider goes, as in "by 0.1".',
    ),
    ("dt = 1/0\naxiom: A", '"1/0" has no value: division by zero', 1, 6, None),
    ("x = 9^9^9^9\naxiom: A", '"9^9^9^9" has no value: the result is too large', 1, 5, None),
    ("steps: 2.5\naxiom: A", '"2.5" is not a number of steps', 1, 8, "Steps are counted from 0: 0, 1, 2, ..."),
    ("heading: 1/0\naxiom: A", '"1/0" has no value: division by zero', 1, 10, None),
]
"""Values that cannot be what the model makes of them."""
WITHOUT_VALUE = [
    ("axiom: A(9^9^9^9)", "The axiom has no value: the result is too large", 1, 8, None),
    (
        "axiom: A(0)\nA(t) -> A(9^9^9^9)",
        "A(0) under production 1, A(t) -> A(9^9^9^9), has no value: the result is too large",
        2,
        1,
        KEEP_OUT,
    ),
    ("axiom: A(0)\nA(t) -> A(1/t)", "A(0) under production 1, A(t) -> A(1/t), has no value: division by zero", 2, 1, KEEP_OUT),
    (
        "axiom: A(0)\nA(t) -> A(log(t-1))",
        "A(0) under production 1, A(t) -> A(log(t-1)), has no value: log(-1) is not a number",
        2,
        1,
        KEEP_OUT,
    ),
    (
        "axiom: A(0)\nA(t) -> A(sqrt(t-1))",
        "A(0) under production 1, A(t) -> A(sqrt(t-1)), has no value: sqrt(-1) is not a number",
        2,
        1,
        KEEP_OUT,
    ),
    (
        "axiom: A(0)\nA(t) -> A((t-1)^0.5)",
        "A(0) under production 1, A(t) -> A((t-1)^0.5), has no value: (-1)^(0.5) is not a number",
        2,
        1,
        KEEP_OUT,
    ),
    (
        "axiom: A(0)\nA(t) -> A(0^(t-1))",
        "A(0) under production 1, A(t) -> A(0^(t-1)), has no value: division by zero",
        2,
        1,
        KEEP_OUT,
    ),
    (
        "axiom: A(0)\nA(t) -> A(0.5^0.5^(t-5000))",
        "A(0) under production 1, A(t) -> A(0.5^0.5^(t-5000)), has no value: the result is too large",
        2,
        1,
        KEEP_OUT,
    ),
    (
        "axiom: A(0)\nA(t) -> A(exp(t+1000))",
        "A(0) under production 1, A(t) -> A(exp(t+1000)), has no value: the result is too large",
        2,
        1,
        KEEP_OUT,
    ),
]
"""Values that cannot be computed: the module and the production are named."""
PLANT_STRINGS = [
    ("Axiom: I\nI -> I[A", 'This "[" is never closed', 2, 7, 'Every branch ends with "]".'),
    ("Axiom: I\nI -> I(A]", 'This "]" closes nothing', 2, 9, 'Every branch begins with "[".'),
    ("Axiom: I\nI -> I)A", 'This ")" closes nothing', 2, 7, 'Every branch begins with "(".'),
    ("Axiom: I\nI(1) -> A", "A plant string has no values", 2, 2, PRODUCTION),
    ("Axiom: I\nI -> I 2", "A number is not a module", 2, 8, 'A plant string has no values: "(" and ")" are branches.'),
    ("Axiom: I\nI -> I(A 2)A", "A number is not a module", 2, 10, 'A plant string has no values: "(" and ")" are branches.'),
    ("Axiom: I\nI -> I)(A 2", "A number is not a module", 2, 11, 'A plant string has no values: "(" and ")" are branches.'),
    ("Axiom: I\nIA -> I", "Only one module can be replaced", 2, 2, 'Write a production for each: "A -> ...", then "B -> ...".'),
    ("Axiom: I\nI -> A -> I", "This is a second arrow in one production", 2, 8, "Write one production per line."),
    ("Axiom: I\nI ->", "There is nothing after the arrow", 2, 3, 'To erase I, write "ε" or "*" there.'),
    ("I -> A", "There is no axiom", 1, 7, 'Give the first word on a line of its own, as in "axiom: A".'),
    ("Axiom I\nI -> A", 'A ":" is missing after "Axiom"', 1, 1, 'Type "axiom: I".'),
    ("Axiom: I\nI = A", "This is not an arrow", 2, 3, PRODUCTION),
    (
        "Axiom: I\nI -> \u0406",
        'I cannot read the character "І" (CYRILLIC CAPITAL LETTER BYELORUSSIAN-UKRAINIAN I)',
        2,
        6,
        "Names are made of the letters A to Z, digits and _.",
    ),
    ("Axiom: I\nI -> I*A", 'Nothing else is possible beside "*"', 2, 7, "It says that the successor is empty."),
    ("Axiom: I\nangle: x", 'I did not expect "x" here', 2, 8, "Possible here: a number."),
    ("Axiom: I\nangle: 45\nangle: 60", '"angle:" is set a second time', 3, 1, "Keep one of the two lines."),
    ("Axiom: I\nAxiom: A", "This is a second axiom", 2, 1, "A system has one axiom."),
    ("Axiom: I\nsteps: 1.5", '"1.5" is not a number of steps', 2, 8, "Steps are counted from 0: 0, 1, 2, ..."),
    ("Axiom: I\nI => A", "This is not an arrow", 2, 3, 'An arrow is typed "->", in one piece.'),
    ("Axiom: I\nI : t < 1 -> A", "A plant string has no conditions", 2, 3, PRODUCTION),
    ("Axiom: I\nI -> I_A", 'I did not expect "_" here', 2, 7, "Possible here: a symbol or the end of the line."),
    ("Axiom: I\nI -> A,B", 'A "," is not needed here', 2, 7, "Modules and names are separated by blanks."),
    ("Axiom: I\nNumber of productions: x", 'I did not expect "x" here', 2, 24, "Possible here: a number."),
    (
        "Axiom: I\nNumber of productions 3",
        'A ":" is missing after "Number of productions"',
        2,
        1,
        'Type "number of productions: 3".',
    ),
    ("Axiom: I\nStage 1 string:", "The line ends too early", 2, 16, "Possible here: a symbol."),
    ("Axiom: I\nStage 1 string I", 'A ":" is missing after "Stage 1 string"', 2, 1, 'Type "stage 1 string: I".'),
    (
        "Axiom: I\nturtle: logo",
        'I do not know the turtle "logo"',
        2,
        9,
        'Turtles are "abop", "grogra", "plant-string" and "fractint".',
    ),
    ("Axiom: I\ndepth: 2", 'A plant string has no "depth:"', 2, 1, "Its settings are angle, length, seed, steps and turtle."),
    ("Axiom: I\nignore: A", 'A plant string has no "ignore:"', 2, 1, "Its settings are angle, length, seed, steps and turtle."),
    ("Axiom: I\nI -> A : 0.5", "A plant string has no probabilities", 2, 8, PRODUCTION),
    ("Axiom: I\nI -> A(t+1)", "A number is not a module", 2, 10, 'A plant string has no values: "(" and ")" are branches.'),
    ("Axiom: I\nAl -> A", "Only one module can be replaced", 2, 2, 'Write a production for each: "A -> ...", then "B -> ...".'),
    ("Axiom: I\nI -> \u2014A", "This dash is not a minus sign", 2, 6, 'A minus sign is typed "-".'),
    ("Axiom: I\nseed: 1.5", '"1.5" is not a seed', 2, 7, "A seed is a whole number."),
]
"""The same in plant strings."""


KINDS = [
    (ModelSyntaxError, UNREADABLE),
    (ModelNameError, UNKNOWN),
    (ModelValueError, SENSELESS),
    (ModelValueError, WITHOUT_VALUE),
]


def slip(text: str, notation: str = "abop") -> LSystemError:
    """The error that a model ends in, while it is read or derived."""
    with pytest.raises(LSystemError) as caught:
        derive(read(text, notation), 3)
    return caught.value


@pytest.mark.parametrize(("kind", "row"), [(kind, row) for kind, rows in KINDS for row in rows])
def test_a_slip_is_explained(kind: type[LSystemError], row: Sequence[object]) -> None:
    text, *expected = row
    error = slip(str(text))
    assert [error.message, error.line, error.column, error.hint] == expected
    assert type(error) is kind


@pytest.mark.parametrize("row", PLANT_STRINGS)
def test_a_slip_in_a_plant_string_is_explained(row: Sequence[object]) -> None:
    text, *expected = row
    error = slip(str(text), "plant-string")
    assert [error.message, error.line, error.column, error.hint] == expected


@pytest.mark.parametrize("row", [row for _, rows in KINDS for row in rows if row[0].isascii() and row[0].isprintable()])
def test_the_caret_stands_under_the_place(row: Sequence[object]) -> None:
    said = str(slip(str(row[0]))).split("\n")
    assert said[-2] == "  " + str(row[0]).split("\n")[int(str(row[2])) - 1].rstrip()
    assert said[-1].index("^") == int(str(row[3])) + 1


def test_a_long_line_is_quoted_around_the_place() -> None:
    said = str(slip("axiom: " + "A " * 500 + ", B")).split("\n")
    assert len(said[-2]) < 110
    assert said[-2][said[-1].index("^")] == ","


def test_a_message_names_what_cannot_be_printed() -> None:
    for text in ("axiom: A\u202eB", "axiom: A\ud800", "axiom: A\x07", "A /* \u202e */ ->", "axiom \u202e"):
        assert all(part.isprintable() for part in str(slip(text)).split("\n"))


@pytest.mark.parametrize("notation", ["lpfg", "ABOP", "", "plant"])
def test_an_unknown_notation_is_named(notation: str) -> None:
    if not notation:
        assert str(read("axiom: A", notation)) == "axiom: A"
        return
    with pytest.raises(ModelNameError, match=f'There is no notation called "{notation}"\\. Notations are: abop, plant-string'):
        read("axiom: A", notation)


def test_a_model_is_text() -> None:
    with pytest.raises(ModelValueError, match="A model is read from text, not from int"):
        read(5)  # type: ignore[arg-type]


PARENTHESES = [
    ("abop", "axiom: A(1)\nA(l) : l > 2 -> F(l/2) [/(15) A(l*2) F(3)] A(0.5)"),
    ("abop", "axiom: A(1)\nA(x) < B(y) > C(z) -> repeat(3, i)<F(i*(x+1)) [+(60) B(max(x, y))]> C(z)"),
    ("cpfg", "Axiom: A(1)\nA(l) : l > 2 --> F(l/2)[/(15)A(l*2)F(3)]A(0.5)"),
    ("grogra", "\\axiom a(1),\na(n) # F(n) [RU(50) a(n+1)] F(2*(n+1)) a(0)"),
]
"""Rules with many parentheses, each with something behind it."""


@pytest.mark.parametrize(("notation", "text"), PARENTHESES)
def test_whichever_parenthesis_is_forgotten_it_is_what_is_missing(notation: str, text: str) -> None:
    read(text, notation)
    for place in (place for place, sign in enumerate(text) if sign == ")"):
        with pytest.raises(LSystemError) as found:
            read(text[:place] + text[place + 1 :], notation)
        assert re.match('This "[(<[]" is never closed|I do not know the function', found.value.message), str(found.value)


@pytest.mark.parametrize("text", ["axiom: A((1,2))", "axiom: A(1, (x+1,2), 3)", "axiom: A(1)\nA((x,y)) -> A(x)"])
def test_a_pair_of_values_in_the_place_of_one_is_told_what_to_type(text: str) -> None:
    assert slip(text).message == "There are several values in the place of one"
    assert slip(text).hint == 'Each has a place of its own: type "A(1, 2)", not "A((1, 2))".'


def test_a_left_context_behind_a_right_one_is_told_where_it_belongs() -> None:
    assert slip("axiom: A\nA > B < C -> D").message == "A left context is not possible here"


def test_a_line_that_begins_with_a_right_context_is_told_what_is_possible() -> None:
    assert str(slip("axiom: A\n> A -> B")).startswith('I did not expect ">" here (line 2, column 1). Possible here: a name')
