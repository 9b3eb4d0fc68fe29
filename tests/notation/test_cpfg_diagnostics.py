"""What the kit says of the slips in cpfg texts, word for word: each message is a small lesson."""

from __future__ import annotations

import pytest

from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.read import read

PRODUCTION = 'A production reads "A --> B": what is replaced, an arrow, what replaces it.'
NO_NAMES = (
    'A parameter is named before the arrow, as in "A(t) --> A(t+1)"; a constant on a line before, as in "#define dt 0.5".'
)
A_VALUE = 'Possible here: a number, a name or "(".'
SIDES = 'A left context ends with "<", a right context begins with ">", as in "A < B > C --> D".'
EVERY = 'Every "(" needs a ")" after it.'
LETTERS = "Names are made of the letters A to Z, digits and _."
CONSTANTS = 'Constants are declared with "#define", as in "#define n 3".'
OWN_BLOCK = "Compute what a rule needs in its own block, with assignments and if."
RANDOM = 'Random numbers belong after the arrow of a production, as in "A --> F(ran(2))".'
REST = 'It is written before a "]", as in "A > [B=]C --> D"; to compare two values, type "==".'

UNREADABLE = [
    ("Axiom: A(0)\nA(t) : t = 1 --> B", 'A single "=" cannot be used here', 2, 10, 'To compare two values, type "==".'),
    ("Axiom: A\nA B", "An arrow is missing here", 2, 3, PRODUCTION),
    (
        "Axiom: A\nA[B] --> C",
        "A bracket is not possible here",
        2,
        2,
        'What is replaced has no branches; a right context may name them, as in "A > [B]C --> D".',
    ),
    ("Axiom: A(0)\nA(t : t<1 --> B", 'This "(" is never closed', 2, 2, EVERY),
    ("Axiom: A(0)\nA(t) --> B(t", 'This "(" is never closed', 2, 11, EVERY),
    ("Axiom: A(0)\nA(t) --> B(t))", 'This ")" closes nothing', 2, 14, 'Every ")" needs a "(" before it.'),
    ("Axiom: A\nA --> [B", 'This "[" is never closed', 2, 7, 'Every branch ends with "]".'),
    ("Axiom: A\nA --> B]", 'This "]" closes nothing', 2, 8, 'Every branch begins with "[".'),
    ("Axiom: A\nA -->", "There is nothing after the arrow", 2, 3, 'To erase A, write "*" there.'),
    ("Axiom: A(0)\nA(t) --> A(sqrt(t,2))", "sqrt(...) takes one value, not 2", 2, 12, None),
    ("Axiom: A(0)\nA(t) : 1<t<3 --> B", "This is a second comparison", 2, 11, 'Compare twice, as in "1 < t && t < 3".'),
    ("Axiom: A\nА --> B", 'I cannot read the character "А" (CYRILLIC CAPITAL LETTER A)', 2, 1, LETTERS),
    ("Axiom: A\nA --> B --> C", "This is a second arrow in one production", 2, 9, "Write one production per line."),
    ("Axiom: A\nA => B", "This is not an arrow", 2, 3, 'An arrow is typed "-->", in one piece.'),
    ("Axiom A\nA --> B", 'A ":" is missing after "Axiom"', 1, 1, 'Type "Axiom: A".'),
    ("Axiom:\nA --> B", 'There is nothing after "Axiom:"', 1, 1, 'It reads "Axiom: A".'),
    ("Axoim: A\nA --> B", 'I do not know "Axoim:"', 1, 1, 'Did you mean "Axiom:"?'),
    ("A --> B", "There is no axiom", 1, 8, 'Give the first word on a line of its own, as in "Axiom: A".'),
    ("", "There is no axiom", 1, 1, 'Give the first word on a line of its own, as in "Axiom: A".'),
    ("Axiom: A\nAxiom: B", "This is a second axiom", 2, 1, "A system has one axiom."),
    ("#define dt = 0.5\nAxiom: A", 'This "=" is not needed', 1, 12, 'Type "#define dt 0.5".'),
    ("#define dt\nAxiom: A", 'The macro "dt" has no value', 1, 1, 'Give it a number: "#define dt 1".'),
    ("#define\nAxiom: A", "A name is missing here", 1, 8, CONSTANTS),
    ("#define f(x) x+1\nAxiom: A(f(1,2))", "The macro f(x) is given 2 values, not 1", 2, 10, None),
    ("#define BOX [+F\nAxiom: A BOX", 'This "[" is never closed', 2, 10, 'Every branch ends with "]".'),
    ("#define a b\n#define b 1\nAxiom: A", 'The macro "b" is defined further down', 1, 11, "Put its line before this one."),
    ("#define a 0,7\nAxiom: A", "A number is typed with a point", 1, 11, 'Type "1.4", not "1,4".'),
    ("#define a (1+2\nAxiom: A", 'This "(" is never closed', 1, 11, EVERY),
    ("#define a 1 2\nAxiom: A", 'I did not expect "2" here', 1, 13, CONSTANTS),
    (
        "Axiom: A\nA --> B\nendlsystem\nB --> C",
        'This comes after "endlsystem"',
        4,
        1,
        'An L-system ends there: put "endlsystem" last, or leave it out.',
    ),
    (
        "Lsystem: 1\nAxiom: A\nLsystem: 2\nAxiom: B",
        "A second L-system begins here",
        3,
        1,
        "The kit has no L-systems inside others.",
    ),
    (
        "Axiom: A\nmaximum depth: 3",
        'This "maximum depth:" is in no section',
        2,
        1,
        'It belongs below "decomposition" or below "homomorphism".',
    ),
    (
        "derivation length: 5\nderivation length: 6\nAxiom: A",
        '"derivation length:" is set a second time',
        2,
        1,
        "Keep one of the two lines.",
    ),
    ("derivation length 5\nAxiom: A", 'A ":" is missing after "derivation length"', 1, 1, 'Type "derivation length: 5".'),
    ("steps: 5\nAxiom: A", 'I do not know "steps:"', 1, 1, 'Did you mean "derivation length:"?'),
    ("Start: {n=1\nAxiom: A", 'A ";" is missing here', 2, 1, 'Every assignment ends with one, as in "{x = t + 1;}".'),
    ("Start: {n=0; while (n<3) {n=n+1;}}\nAxiom: A", "The kit has no loops", 1, 14, OWN_BLOCK),
    ("Start: {a[1]=3;}\nAxiom: A", "The kit has no arrays", 1, 9, OWN_BLOCK),
    ("Start: A\nA --> B", 'I do not know "Start:"', 1, 1, 'Did you mean "Axiom:"?'),
    ("Start: {inblob(1);}\nAxiom: A", "The kit has no inblob(...)", 1, 9, OWN_BLOCK),
    (
        "Define: {array a[3];}\nAxiom: A(a[1])",
        "The kit has no arrays that change, or have no values from the start",
        1,
        1,
        "Write their values where they are used.",
    ),
    (
        "#include <x.h>\nAxiom: A",
        'The file "x.h" is not part of this text',
        1,
        1,
        "Put what it says in place of this line, or read the folder that has it.",
    ),
    ("#ifdef X\nAxiom: A", 'This condition has no "#endif"', 1, 1, "Every #if ends with one."),
    ("Axiom: A\n#endif", 'This "#endif" belongs to no condition', 2, 1, 'A condition begins with "#if".'),
    (
        "#if 1 +\nAxiom: A\n#endif",
        "This condition has no value",
        1,
        1,
        'It is made of numbers, macros that are numbers, and "defined".',
    ),
    (
        "#if ran(1)\nAxiom: A\n#endif",
        "This condition has no value",
        1,
        1,
        'It is made of numbers, macros that are numbers, and "defined".',
    ),
    (
        "#if 1/0\nAxiom: A\n#endif",
        "This condition has no value",
        1,
        1,
        'It is made of numbers, macros that are numbers, and "defined".',
    ),
    ("Axiom: A(1)\nA(t) : {x=t;} --> A(x", 'This "(" is never closed', 2, 20, EVERY),
    (
        "Axiom: A(1)\nA(t) : {x=t} 1 --> A(x)",
        'A ";" is missing here',
        2,
        12,
        'Every assignment ends with one, as in "{x = t + 1;}".',
    ),
    ("Axiom: A(1)\nA(t) : {while (t<3) {t=t+1;}} 1 --> A(t)", "The kit has no loops", 2, 9, OWN_BLOCK),
    ("Axiom: A(1)\nA(t) : {srandom(t);} 1 --> A(t)", "The kit has no srandom(...)", 2, 9, OWN_BLOCK),
    ("Axiom: A(1)\nA(t) : {x[1]=3;} 1 --> A(t)", "The kit has no arrays", 2, 9, OWN_BLOCK),
    ("Axiom: A(1)\nA(t) --> A(x[1])", "The kit has no arrays", 2, 12, OWN_BLOCK),
    (
        "Axiom: A\ndecomposition\nA > B --> C",
        "A rule of the decomposition cannot have a context",
        3,
        1,
        "It is applied to one module at a time.",
    ),
    ("Axiom: A\nA > [B=C]D --> E", 'This "=" is not at the end of a branch', 2, 7, REST),
    ("Axiom: A\nA > [B --> C", 'This "[" is never closed', 2, 5, 'Every branch ends with "]".'),
    ("Axiom: A\nA < B < C --> D", 'This is a second "<"', 2, 7, 'A production has one left context: "A B < C --> D".'),
    (
        "Axiom: A\nignore: +-\nconsider: A",
        'Both "ignore:" and "consider:" are set',
        3,
        1,
        "List the symbols that contexts pass over, or the others, not both.",
    ),
    ("Axiom: A(1)\nA(t) : t>1 and t<3 --> B", "This does not join conditions", 2, 12, 'For "and", type "&&".'),
    (
        "Axiom: A(1)\nA(t) t>1 --> B",
        'A ":" is missing before the condition',
        2,
        6,
        'A condition is written between ":" and the arrow, as in "A(t) : t < 5 --> B".',
    ),
    ("Axiom: A(1)\nA(t) : t>1 && --> B", "A value is missing here", 2, 15, A_VALUE),
    ("/* x\nAxiom: A", "This comment is never closed", 1, 1, 'A comment ends with "*/".'),
    ("Axiom: A\nA --> (3)", 'I did not expect "(3)" here', 2, 7, "Possible here: a symbol."),
    ("Axiom: A(1 2)", 'An operator is missing before "2"', 1, 12, 'To multiply, type "*", as in "2*t".'),
    ("Axiom: A(0)\nA(t) : t>1 : 0.5 --> B", 'I did not expect ":" here', 2, 12, "Possible here: an arrow."),
    (
        "Axiom: A\nAB --> C\nhomomorphism\nAB --> C",
        "A rule of the homomorphism replaces one module",
        4,
        1,
        "It is applied to one module at a time.",
    ),
    ("Axiom: A\nhomomorphsm\nA --> B", 'I do not know "homomorphsm"', 2, 1, 'Did you mean "homomorphism"?'),
    ('Axiom: A\nA --> "B"', "Quotation marks are not needed here", 2, 7, "Words are typed without quotation marks."),
    ("Axiom: A(1)\nA(t) : t<5 ? 1 --> B", 'I did not expect "-->" here', 2, 16, 'Possible here: ":".'),
    ("Axiom: A\nA -o> B", "The kit has no rules for objects", 2, 3, 'A production reads "A --> B".'),
    ("Axiom: A(1)\nA(t) : {x=t;", 'This "{" is never closed', 2, 8, 'Every block ends with "}", as in "{x = t + 1;}".'),
    ("Axiom: A\n--> B", "There is nothing before the arrow", 2, 1, PRODUCTION),
    ("Axiom: A\nA : --> B", "There is no condition before the arrow", 2, 5, 'Write one, as in "t < 5", or leave the ":" out.'),
    ("Axiom: A * B", 'I did not expect "*" here', 1, 10, 'Possible here: "(", a symbol or the end of the line.'),
    ("Axiom: A\nA --> A * B", 'Nothing else is possible beside "*"', 2, 9, "It says that the successor is empty."),
    ("Axiom: A\nA --> B(,)", "A value is missing here", 2, 9, A_VALUE),
    ("Axiom: A\n< A --> B", 'I did not expect "<" here', 2, 1, "Possible here: a symbol."),
    ("Axiom: A\nA < --> B", "The module to replace is missing", 2, 5, SIDES),
    ("Axiom: A\nA --> B : 0.5 C", 'I did not expect "C" here', 2, 15, "Possible here: the end of the line."),
    ("Lsystem:\nAxiom: A", 'There is nothing after "Lsystem:"', 1, 1, 'It reads "Lsystem: 1".'),
    ("Axiom: A\nA > = --> B", 'This "=" is not at the end of a branch', 2, 5, REST),
    ("Axiom: A\nB > [A=] --> C\nA = B", "This is not an arrow", 3, 3, PRODUCTION),
    ("Axiom: A\nA(t) --> B\nA(t) : t - > 3 --> B", "A value is missing here", 3, 12, A_VALUE),
    ("Axiom: A\nA --> A, B : 2 C", 'I did not expect "C" here', 2, 16, "Possible here: the end of the line."),
    ("Axiom: A\nA --> B :", "A value is missing here", 2, 10, A_VALUE),
    ("Axiom: A(1)\nA(t) : (t>1 --> B", 'This "(" is never closed', 2, 8, EVERY),
    ("Axiom: A\nB < A > --> C", 'I did not expect "-->" here', 2, 9, "Possible here: a symbol."),
    ("Axiom: A\nendlsytem", 'I do not know "endlsytem"', 2, 1, 'Did you mean "endlsystem"?'),
    ("Axiom: A\nA --> Б", 'I cannot read the character "Б" (CYRILLIC CAPITAL LETTER BE)', 2, 7, LETTERS),
    ("lsystem\nAxiom: A", 'A ":" is missing after "lsystem"', 1, 1, 'Type "Lsystem: 1".'),
    ("#define PI = 3.14\nAxiom: A", 'This "=" is not needed', 1, 12, 'Type "#define PI 3.14".'),
    ("Axiom: A\nignore:", 'There is nothing after "ignore:"', 2, 1, 'It reads "ignore: +-".'),
    ("Axiom: A\nA --> B(1;2)", 'This ";" does not separate values', 2, 10, 'Values are separated by ",", as in "A(1, 2)".'),
    ("Axiom: A\nA --> B → C", "This is a second arrow in one production", 2, 9, "Write one production per line."),
    (
        "Axiom: A\nignore: [",
        "One bracket is listed here without the other",
        2,
        9,
        "Right contexts pass over both brackets or over none.",
    ),
    ('Axiom: A\nA --> [@o("age")]B', "The kit has no texts among values", 2, 11, "Leave the label out, or write a number."),
    ("Axiom: A(1)\nA(t) : t => 3 --> B", "This is not a comparison", 2, 10, 'For "at least", type ">=".'),
    (
        "Axiom: A(1)\nA(t) : {x=t; y=x} --> A(y)",
        'A ";" is missing here',
        2,
        17,
        'Every assignment ends with one, as in "{x = t + 1;}".',
    ),
]

UNKNOWN = [
    (
        "Axiom: A(0)\nA(t) --> F(curveX(1,t))",
        "The kit has no curveX(...)",
        2,
        12,
        "Its values are in a file of contours, which the kit does not read: write an expression in its place.",
    ),
    (
        "Axiom: A(0)\nA(t) --> F(func(1,t))",
        "The kit has no func(...)",
        2,
        12,
        "Its values are in a file beside the model: read its folder, or write an expression in its place.",
    ),
    ("Axiom: A(0)\nA(t) --> A(sqtr(t))", 'I do not know the function "sqtr"', 2, 12, 'Did you mean "sqrt"?'),
    ("Axiom: A(0)\nA(t) --> A(max(t,1))", 'I do not know the function "max"', 2, 12, 'Type "x > y ? x : y".'),
    ("Axiom: A(0)\nA(t) --> A(T+1)", 'I do not know the name "T"', 2, 12, 'Did you mean "t"?'),
    ("#define a 1\n#define a 2\nAxiom: A", 'The constant "a" is declared twice', 2, 1, "Keep one of the two lines."),
    ("Axiom: A\nderivation length: n", 'I do not know the name "n"', 2, 20, NO_NAMES),
    (
        "#define n 3\nAxiom: A(1)\nA(t) : 1 {n=n+1;} --> A(n)",
        'The constant "n" cannot be changed',
        3,
        11,
        "Give what is computed a name of its own.",
    ),
    (
        "Axiom: A(1)\nA(t) : 1 {if (t>1) {x=1;}} --> A(x)",
        '"x" has a value only where this condition is true',
        2,
        15,
        'Give it one in the other case, too: "else {x = 0;}".',
    ),
    ("Axiom: A(t)\nA(t,t) --> B", 'I do not know the name "t"', 1, 10, NO_NAMES),
    (
        "Axiom: A(1)\nA(t+1) --> B",
        'Before the arrow a parameter is a name alone, not "t + 1"',
        2,
        3,
        'Write "t" there, and the calculation after the arrow.',
    ),
    ("Axiom: A(atan2(1,2))", "The kit has no atan2(...)", 1, 10, None),
    (
        "#define angle 30\nAxiom: A",
        'The name "angle" is taken by a setting',
        1,
        1,
        'Give the macro another name, such as "ANGLE".',
    ),
    ("seed: x\nAxiom: A", 'I do not know the name "x"', 1, 7, NO_NAMES),
]

WITHOUT_VALUE = [
    ("Axiom: A\nderivation length: 2.5", '"2.5" is not a number of steps', 2, 20, "Steps are counted from 0: 0, 1, 2, ..."),
    (
        "Axiom: A(1)\nA(t) : 1 {x=ran(1);} --> A(x) : x",
        'The random number "x" would be drawn anew at each of its uses',
        2,
        11,
        'Make it the parameter of a module, as in "A --> B(ran(1))", and use that in the next step.',
    ),
    (
        "Axiom: A(1)\nA(t) : ran(1)<0.5 --> A(t)",
        '"ran(1)" draws a new number at every use, which is not possible here',
        2,
        8,
        RANDOM,
    ),
    (
        "Axiom: A\nhomomorphism\nA --> F(ran(3))",
        '"ran(3)" draws a new number at every use, which is not possible here',
        3,
        9,
        RANDOM,
    ),
    (
        "Axiom: A\nhomomorphism\nA --> F : 30",
        "A rule of the homomorphism cannot have a probability",
        3,
        11,
        "A word is always drawn in the same way; chance belongs in the productions.",
    ),
    (
        "Axiom: A\nA --> B : t<5",
        'A probability follows the successor, but "t < 5" is true or false',
        2,
        11,
        'A condition is written before the arrow, as in "A(t) : t < 5 --> B".',
    ),
    ("Axiom: A\nA --> A : -1", "A probability cannot be negative", 2, 11, None),
    ("Axiom: A(trunc(ran(3)))", "trunc(...) cannot be of a random number", 1, 10, 'Type "floor" or "ceil".'),
    ("Axiom: A\ndecomposition\nA --> A", "Rule A decomposes into itself: A -> A", 3, 1, "It can never finish."),
]


def slip(text: str) -> LSystemError:
    """The error that a model ends in, while it is read or derived."""
    with pytest.raises(LSystemError) as caught:
        derive(read(text, "cpfg"), 2)
    return caught.value


@pytest.mark.parametrize(
    ("kind", "text", "message", "line", "column", "hint"),
    [
        *((ModelSyntaxError, *row) for row in UNREADABLE),
        *((ModelNameError, *row) for row in UNKNOWN),
        *((ModelValueError, *row) for row in WITHOUT_VALUE),
    ],
)
def test_a_slip_is_explained(
    kind: type[LSystemError], text: str, message: str, line: int, column: int, hint: str | None
) -> None:
    error = slip(text)
    assert (error.message, error.line, error.column, error.hint) == (message, line, column, hint)
    assert type(error) is kind
