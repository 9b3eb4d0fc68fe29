"""What the kit says of slips in GROGRA's notation, word for word: each message is a small lesson."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.read import read

COMMA = 'Rules are separated by commas: "a # F b, b # F a".'
RULE = 'A rule reads "a # F a": what is replaced, "#", what replaces it.'
COMMENT = 'A comment is written between "/*" and "*/".'
SIDES = 'A left context ends with "<", a right context begins with ">", as in "s < a > b # c".'
IN_FRONT = 'It is written in front, in parentheses: "(t < 6) k(t) # k(t+1)".'
REPEAT = 'A repetition reads "&(3) < F a >"; for the turn that ABOP writes as "&", type "RL(60)".'
BEHIND = 'Contexts come before the "#"; after it "<" and ">" go with "&(3)".'
NUMBER = 'Numbers are glued to a turtle command, as in "F100", or written in parentheses after a symbol, as in "a(2)".'
NAMES = (
    'A parameter is named in front, as in "a(t) # a(t+1)"; a constant or a variable on a line such as "\\const k 3," or '
    '"\\var x uniform 0 360,".'
)
KINDS = "Kinds of variables are: uniform, normal, binomial, poisson, distribution, table, index, function."
LETTERS = "Symbols are made of the letters A to Z, digits, _ and '."
A_VALUE = 'Possible here: a number, a name or "(".'
EVERY = 'Every "(" needs a ")" after it.'

COMMAS = [
    ("* # F a\na # F", 'A "," is missing here', 1, 8, COMMA),
    ("* # F a /* so */\n\na # F", 'A "," is missing here', 1, 8, COMMA),
    ("* # F a,\nxs # xs D+2\n(t < 6) k(t) # k(t+1)", 'A "," is missing here', 2, 12, COMMA),
    ("s2 # xs F D\n(t < 6) k(t) # k(t+1)", 'A "," is missing here', 1, 12, COMMA),
    ("\\angle 60\n* # F", 'A "," is missing here', 1, 10, COMMA),
    ("\\axiom a\na # F b", 'A "," is missing here', 1, 9, COMMA),
    ("\\var x uniform 0 360\n\\var y uniform 0 1", 'A "," is missing here', 1, 21, COMMA),
    ("a # b;\nc # d", 'This ";" does not separate rules', 1, 6, COMMA),
    ("a # b ?0,5", "A number is typed with a point", 1, 9, 'Type "0.5", not "0,5".'),
    ("a # b # c", "This is a second arrow in one rule", 1, 7, COMMA),
]
ARROWS = [
    ("a F a", "An arrow is missing here", 1, 3, RULE),
    ("a(t) F a", "An arrow is missing here", 1, 6, RULE),
    ("(t < 5) a(t) F", "An arrow is missing here", 1, 14, RULE),
    ("a, b # c", "An arrow is missing here", 1, 2, RULE),
    ("a # # b", 'This is a second "#"', 1, 5, 'One "#" is enough; "##" says how a symbol is drawn.'),
    ("a ### b", 'This is a second "#"', 1, 5, 'One "#" is enough; "##" says how a symbol is drawn.'),
    ("a => b", "This is not an arrow", 1, 3, 'An arrow is typed "#" or "->", in one piece.'),
    ("a := b", "This is not an arrow", 1, 3, 'An arrow is typed "#" or "->", in one piece.'),
    ("a - > b", "This is not an arrow", 1, 3, 'An arrow is typed "#" or "->", in one piece.'),
    ("# F a", 'There is nothing before the "#"', 1, 1, f"{RULE} {COMMENT}"),
    ("// F\na # b", "This is not a rule", 1, 1, COMMENT),
    ("#define k 3\na # b", "This is not a rule", 1, 1, 'A constant is declared as in "\\const dt 0.5,".'),
    ("-> F a", 'There is nothing before the "->"', 1, 1, RULE),
    ("a b # c", "Only one symbol can be replaced", 1, 3, SIDES),
    ("s < a b # c", "Only one symbol can be replaced", 1, 7, SIDES),
    ("s < # a", "The symbol to replace is missing", 1, 5, SIDES),
    ("(t < 5) # a", "The symbol to replace is missing", 1, 9, 'It is written after its condition: "(t < 6) k(t) # k(t+1)".'),
    ("s < t < a # b", 'This is a second "<"', 1, 7, SIDES),
    ("a > b > c # d", 'This is a second ">"', 1, 7, SIDES),
]
REPETITIONS = [
    ("a # &(3) < F [b], b # c", 'This "<" is never closed', 1, 10, REPEAT),
    ("a # &(3) F a", 'A "<" is missing here', 1, 10, REPEAT),
    ("a # &(60) L(0)", 'A "<" is missing here', 1, 11, REPEAT),
    ("a # & F b", 'A "<" is missing here', 1, 9, REPEAT),
    ("a # F &", 'A number is missing after "&"', 1, 8, REPEAT),
    ("& # a", '"&" repeats a part of what follows the "#"', 1, 1, REPEAT),
    ("a # &(3) < >", "Nothing is repeated here", 1, 12, REPEAT),
    ("a # b > c", 'I did not expect ">" here', 1, 7, BEHIND),
    ("a # < b", 'I did not expect "<" here', 1, 5, BEHIND),
]
CONDITIONS = [
    ("t < 6 k(t) # k(t+1)", "This condition has no parentheses", 1, 1, IN_FRONT),
    ("t = 6 k(t) # %", "This condition has no parentheses", 1, 1, IN_FRONT),
    ("k(t) : t < 6 # k(t+1)", "A condition is not possible here", 1, 6, IN_FRONT),
    ("a -> b : 0.5", 'A probability is written with "?"', 1, 8, 'Type "?0.5".'),
    ("a # b ?", 'A probability is missing after "?"', 1, 8, 'Type it as in "?0.5", at the end of the rule.'),
    ("(1 < t < 6) k(t) # b", "This is a second comparison", 1, 8, 'Compare twice, as in "1 < t && t < 6".'),
    ("(t < 6 and t > 2) k(t) # b", "This does not join conditions", 1, 8, 'For "and", type "&&".'),
    ("(t => 6) k(t) # b", "This is not a comparison", 1, 4, 'For "at least", type ">=".'),
    ("(t =< 6) k(t) # b", "This is not a comparison", 1, 4, 'For "at most", type "<=".'),
]
PARENTHESES = [
    ("a(t # b", 'This "(" is never closed', 1, 2, EVERY),
    ("a(t) # b(t, a(t) # c", 'This "(" is never closed', 1, 9, EVERY),
    ("a(t) # b(t+1)), c # d", 'This ")" closes nothing', 1, 14, 'Every ")" needs a "(" before it.'),
    ("k(t) # k()", "There is nothing in these parentheses", 1, 9, "Write a value there, or leave the parentheses out."),
    ("a # [ b, c # d", 'This "[" is never closed', 1, 5, 'Every branch ends with "]".'),
    ("a # b ], c # d", 'This "]" closes nothing', 1, 7, 'Every branch begins with "[".'),
    ("/* a # b", "This comment is never closed", 1, 1, 'A comment ends with "*/".'),
    ("a # b */", "This comment was never opened", 1, 7, 'A comment begins with "/*".'),
]
WORDS = [
    ("\u0430 # F", 'I cannot read the character "а" (CYRILLIC SMALL LETTER A)', 1, 1, LETTERS),
    ("a # F \u0430", 'I cannot read the character "а" (CYRILLIC SMALL LETTER A)', 1, 7, LETTERS),
    ("a # RU4\u0435", 'I cannot read the character "е" (CYRILLIC SMALL LETTER IE)', 1, 8, LETTERS),
    ("* # F 100 a", "A number is not a module", 1, 7, NUMBER),
    ("* # RU 45", "A number is not a module", 1, 8, NUMBER),
    ("k(t) # k(2t)", 'An operator is missing before "t"', 1, 11, 'To multiply, type "*", as in "2*t".'),
    ("k(t) # k(t+)", "A value is missing here", 1, 12, A_VALUE),
    ("a(t) # b(t**2)", "This is not an operator", 1, 11, 'A power is typed "t^2".'),
    ('a # "b"', "Quotation marks are not needed here", 1, 5, "Words are typed without quotation marks."),
    ("a # \\vec{b}", 'I do not know "\\vec"', 1, 5, "Possible here: a symbol or the end of the line."),
    (
        "a # b(uniform(0, 1))",
        "A random number is declared on a line of its own",
        1,
        7,
        'Type "\\var x uniform ...," there, and "x" here.',
    ),
    ("s < a ## b", "A rule of the interpretation cannot have a context", 1, 1, "It is applied to one module at a time."),
]
LINES = [
    ("\\angel 60, a # b", 'I do not know "\\angel"', 1, 1, 'Did you mean "\\angle"?'),
    ("\\foo 3, a # b", 'I do not know "\\foo"', 1, 1, "Possible are: \\axiom, \\angle, \\length, \\const, \\var, \\set."),
    ("\\angle, a # b", 'Something is missing after "\\angle"', 1, 1, 'It reads as in "\\angle 60,".'),
    ("\\var x, a # b", 'Something is missing after "\\var"', 1, 1, 'It reads as in "\\var x uniform 0 360,".'),
    (
        "\\set turtle abob, a # b",
        'There is no turtle called "abob"',
        1,
        13,
        "Turtles are: abop, grogra, plant-string, fractint.",
    ),
    ("\\const k = 3, a # b", 'This "=" is not needed', 1, 10, 'Type "\\const k 3,".'),
    ("angle: 60, a # b", "This setting is written as in another notation", 1, 1, 'Type "\\angle 60,".'),
    ("start: a, a # b", "This setting is written as in another notation", 1, 1, 'Type "\\axiom a,".'),
    ("\\length 100 50, a # b", 'I did not expect "50" here', 1, 13, "Possible here: the end of the line."),
    ("\\axiom a, \\axiom b, a # b", "This is a second axiom", 1, 11, "A system has one axiom."),
    ("\\angle 60, \\angle 30, a # b", "The angle is set a second time", 1, 12, "Keep one of the two lines."),
    (
        "\\var x uniform 0, a # RU(x)",
        'A variable of the kind "uniform" takes 2 values, not 1',
        1,
        8,
        'Type "\\var x uniform 0 360,".',
    ),
    (
        "\\var x distribution, a # RU(x)",
        'A variable of the kind "distribution" takes 1 or more values, not 0',
        1,
        8,
        'Type "\\var x distribution 0.2 0.3 0.5,".',
    ),
    ("\\var i index 0 1, a # b", 'A variable of the kind "index" takes up to 1 value, not 2', 1, 8, 'Type "\\var i index 0,".'),
    ("\\var f function 2 1, a # b(f(1, 2))", "f(...) takes one value, not 2", 1, 28, None),
    ("\\var f function 2 1, a # b(f)", '"f" is a function, and its values are missing', 1, 28, 'It is called as in "f(1)".'),
    ("\\angle 30", "There is no axiom and no rule", 1, 10, 'Give the first word, as in "\\axiom a,".'),
]
UNKNOWN = [
    ("\\var x uniforn 0 360, a # RU(x)", 'There is no kind of variable called "uniforn"', 1, 8, 'Did you mean "uniform"?'),
    ("\\var x whatever 0 360, a # RU(x)", 'There is no kind of variable called "whatever"', 1, 8, KINDS),
    ("\\var x negbinomial 1 2, a # RU(x)", 'A variable of the kind "negbinomial" is not possible here', 1, 8, KINDS),
    ("\\var x length, a # RU(x)", 'A variable of the kind "length" is not possible here', 1, 8, KINDS),
    ("\\var x0 uniform 0 360, a # RU(xo)", 'I do not know the name "xo"', 1, 31, 'Did you mean "x0"?'),
    ("\\const lifeTime 3, a(t) # a(lifetime)", 'I do not know the name "lifetime"', 1, 29, 'Did you mean "lifeTime"?'),
    ("a(t) # a(s)", 'I do not know the name "s"', 1, 10, NAMES),
    ("\\const k m, a # b", 'I do not know the name "m"', 1, 10, NAMES),
    ("\\var x uniform 0 m, a # b", 'I do not know the name "m"', 1, 18, NAMES),
    ("\\angle k, a # b", 'The name "k" cannot be used here', 1, 8, "The angle is set to a number."),
    ("a # b(f(1))", 'I do not know the function "f"', 1, 7, 'Declare it, as in "\\var f function 2 1,".'),
    ("a # b(sqr(2))", 'I do not know the function "sqr"', 1, 7, 'Did you mean "sqrt"?'),
    (
        "\\var i index, a # b(i)",
        '"i" counts repetitions, and nothing is repeated here',
        1,
        21,
        'It is used in what is repeated, as in "&(3) < a(i) >".',
    ),
    (
        "\\var i index 1, a # &3 < b(i) >",
        '"i" counts repetitions, and nothing is repeated here',
        1,
        28,
        'It is used in what is repeated, as in "&(3) < a(i) >" with 1 more around it.',
    ),
    ("\\const n 3, \\var n uniform 0 1, a # b", 'The name "n" is declared twice', 1, 20, "Keep one of the two lines."),
    ("\\const angle 60, a # b", '"angle" is a setting, not a constant', 1, 1, 'Type "\\angle 60,".'),
    ("a(t, t) # b", 'The parameter "t" is named twice', 1, 6, "Give each parameter a name of its own."),
]
SENSELESS = [
    ("\\axiom a 8-1, a # b", '"8-1" runs backwards', 1, 10, 'Steps are counted upwards, as in "1-8".'),
    (
        "\\var x uniform 0 1, (x < 0.5) a # b",
        '"x" draws a new number at every use, which is not possible here',
        1,
        22,
        'Random variables belong after the "#" of a rule, as in "a # F(x)".',
    ),
    (
        "\\var x uniform 0 1, \\axiom a(x), a(t) # b",
        '"x" draws a new number at every use, which is not possible here',
        1,
        30,
        'Random variables belong after the "#" of a rule, as in "a # F(x)".',
    ),
    (
        "\\var f function x 1, a # b",
        'The values of the function "f" must be whole numbers, 0 or more',
        1,
        8,
        'Type "\\var f function 2 1,".',
    ),
    (
        "(t) k(t) # b",
        '"t" is a number, but something true or false is needed here',
        1,
        2,
        'Compare it with something, as in "t > 0".',
    ),
    (
        "a(t) # b ?(t<5)",
        'A probability follows the "?", but "t < 5" is true or false',
        1,
        12,
        'A condition is written in front: "(t < 6) k(t) # k(t+1)".',
    ),
    (
        "a ## b ?0.5",
        "A rule of the interpretation cannot have a probability",
        1,
        9,
        "A word is always drawn in the same way; chance belongs in the productions.",
    ),
    ("a # b ?(1/0)", '"1/0" has no value: division by zero', 1, 9, None),
    ("a # &2.5 < b >", '"2.5" is not a number of repetitions', 1, 6, "It must be a whole number from 0 to 100,000."),
]
UNREADABLE = [*COMMAS, *ARROWS, *REPETITIONS, *CONDITIONS, *PARENTHESES, *WORDS, *LINES]
ROWS = [
    *((ModelSyntaxError, row) for row in UNREADABLE),
    *((ModelNameError, row) for row in UNKNOWN),
    *((ModelValueError, row) for row in SENSELESS),
]


def slip(text: str) -> LSystemError:
    with pytest.raises(LSystemError) as caught:
        read(text, "grogra")
    return caught.value


@pytest.mark.parametrize(("kind", "row"), ROWS)
def test_a_slip_is_explained(kind: type[LSystemError], row: Sequence[object]) -> None:
    text, *expected = row
    error = slip(str(text))
    assert [error.message, error.line, error.column, error.hint] == expected
    assert type(error) is kind


@pytest.mark.parametrize("row", [row for _, row in ROWS])
def test_the_caret_stands_under_the_place(row: Sequence[object]) -> None:
    said = str(slip(str(row[0]))).split("\n")
    assert said[-2].strip() == str(row[0]).split("\n")[int(str(row[2])) - 1].rstrip()
    assert said[-1].index("^") == int(str(row[3])) + 1


@pytest.mark.parametrize("text", ["(t = 6 && t == 6) k(t) # %", "a # b,", "a # b,,\n\n,c # d", "(t=1) a(t) # b, * # a(1)"])
def test_what_looks_like_a_slip_and_is_none_is_read(text: str) -> None:
    assert read(text, "grogra").productions
