"""What the kit says of slips in contexts, probabilities, repetitions, and the rules that follow a step: word for word."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.read import read
from tests.notation.test_diagnostics import NO_NAMES, PRODUCTION

BEHIND_AN_ARROW = (
    'A context is written before the arrow; after it "<" and ">" go with "repeat(3)". For rolls type "\\" and '
    '"/"; for longer steps, give F a length: A(x) -> F(x) A(x*2).'
)
SIDES = 'A left context ends with "<", a right context begins with ">", as in "A < B > C -> D".'
REPEAT = 'A repetition reads "repeat(3) <F>", or, with a name that counts from 0, "repeat(3, i) <F(i)>".'
CONDITION = 'A condition is written between ":" and the arrow, as in "A(t) : t < 5 -> B".'
RANDOM = 'Random numbers belong after the arrow of a production, as in "A -> F(uniform(1, 2))".'
BRACKETS = "A right context may name branches; a left context passes over them."
BRANCHES = 'What is replaced has no branches; a right context may name them, as in "A > [B]C -> D".'

UNREADABLE = [
    ("axiom: A\nA < > C -> D", "The module to replace is missing", 2, 5, SIDES),
    ("axiom: A\nA < -> C", "The module to replace is missing", 2, 5, SIDES),
    ("axiom: A\nA < B < C -> D", 'This is a second "<"', 2, 7, 'A production has one left context: "A B < C -> D".'),
    ("axiom: A\nA > B > C -> D", 'This is a second ">"', 2, 7, 'A production has one right context: "A > B C -> D".'),
    (
        "axiom: A\nA > B < C -> D",
        "A left context is not possible here",
        2,
        7,
        'It comes before the module that is replaced: "C < A > B -> D".',
    ),
    ("axiom: A\nA [B] -> C", "A bracket is not possible here", 2, 3, BRANCHES),
    ("axiom: A\nA > B [ -> C", 'This "[" is never closed', 2, 7, 'Every branch ends with "]".'),
    ("axiom: A\nA B < ] C -> D", "A bracket is not possible here", 2, 7, BRANCHES),
    (
        "axiom: A\nA -> B\ndecomposition:\nA B -> C",
        "A rule of the decomposition replaces one module",
        4,
        1,
        "It is applied to one module at a time.",
    ),
    (
        "axiom: A\nA -> B\ninterpretation:\nA B -> C",
        "A rule of the interpretation replaces one module",
        4,
        1,
        "It is applied to one module at a time.",
    ),
    ("axiom: A\nA B C", "An arrow is missing here", 2, 3, PRODUCTION),
    ("axiom: A\nA B ~> C", "This is not an arrow", 2, 5, 'An arrow is typed "->", in one piece.'),
    ("axiom: A\nA(t) t > 5 -> B", 'A ":" is missing before the condition', 2, 6, CONDITION),
    ("axiom: A\nA(t) if t < 5 -> B", 'A ":" is missing before the condition', 2, 6, CONDITION),
    (
        "axiom: A\nA < B : -> C",
        "There is no condition before the arrow",
        2,
        9,
        'Write one, as in "t < 5", or leave the ":" out.',
    ),
    ("axiom: A\nA [B] < C -> D", "A bracket is not possible here", 2, 3, BRACKETS),
    ("axiom: A\n[ < B -> C", "A bracket is not possible here", 2, 1, BRACKETS),
    ("axiom: A\nA < B > C[D -> E", 'This "[" is never closed', 2, 10, 'Every branch ends with "]".'),
    ("axiom: A\nA -> repeat(3) F", 'A "<" is missing here', 2, 16, REPEAT),
    ("axiom: A\nA -> repeat(3) <F", 'This "<" is never closed', 2, 16, REPEAT),
    ("axiom: A\nA -> repeat(3, i) <F(if(i < 3, 1, 2)) : 0.5", 'This "<" is never closed', 2, 19, REPEAT),
    ("axiom: A\nA -> repeat(3, i <F>", 'This "(" is never closed', 2, 12, 'Every "(" needs a ")" after it.'),
    ("axiom: A\nA -> repeat(3, 4) <F>", "The name of the index is missing here", 2, 16, REPEAT),
    ("axiom: A\nA -> repeat(3, ) <F>", "The name of the index is missing here", 2, 16, REPEAT),
    (
        "axiom: A\nA -> repeat() <F>",
        "There is nothing in these parentheses",
        2,
        12,
        "Write a value there, or leave the parentheses out.",
    ),
    ("axiom: A\nA -> repeat(3) <>", "Nothing is repeated here", 2, 17, REPEAT),
    (
        "axiom: A\nA -> repeat(3) <F+F->",
        'This "->" is read as an arrow',
        2,
        20,
        'Where a repetition ends, type "- >", with a blank between them.',
    ),
    (
        "axiom: A\nA -> repeat(3) <F -> B",
        'This "->" is read as an arrow',
        2,
        19,
        'Where a repetition ends, type "- >", with a blank between them.',
    ),
    ("axiom: A\nA -> repeat(3) <[F> ]", 'This "[" is never closed', 2, 17, 'Every branch ends with "]".'),
    ("axiom: A\nA -> B > C", 'I did not expect ">" here', 2, 8, BEHIND_AN_ARROW),
    ("axiom: A\nA -> B < C", 'I did not expect "<" here', 2, 8, BEHIND_AN_ARROW),
    ("axiom: A\nignore:", 'There is nothing after "ignore:"', 2, 1, "Possible here: a name or a symbol."),
    ("axiom: A\nignore: A,B", 'A "," is not needed here', 2, 10, "Modules and names are separated by blanks."),
    ("axiom: A\nignore: A [", "A bracket is not possible here", 2, 11, "Contexts follow the branches in any case."),
    ("axiom: A\nignore: B\nignore: C", '"ignore:" is set a second time', 3, 1, "Keep one of the two lines."),
    (
        "axiom: A\nignore: B\nconsider: C",
        'Both "ignore:" and "consider:" are set',
        3,
        1,
        "List the symbols that contexts pass over, or the others, not both.",
    ),
    (
        "axiom: A\nconsider: B\nignore: C",
        'Both "ignore:" and "consider:" are set',
        3,
        1,
        "List the symbols that contexts pass over, or the others, not both.",
    ),
    ("axiom: A\nignor: A", 'I do not know "ignor:"', 2, 1, 'Did you mean "ignore:"?'),
    (
        "axiom: A\nmeta: f < g -> h",
        "A meta-rule has no contexts",
        2,
        9,
        'It says what replaces a row of modules, as in "meta: f(x) f(y) -> f(x+y)".',
    ),
    ("axiom: A\nmeta: f g", "An arrow is missing here", 2, 10, PRODUCTION),
    ("axiom: A\nmeta: f f ->", "There is nothing after the arrow", 2, 11, 'To erase f f, write "ε" or "*" there.'),
    ("axiom: A\nA < B(t) > C : t > 1 ->", "There is nothing after the arrow", 2, 22, 'To erase B(t), write "ε" or "*" there.'),
    (
        "axiom: A\nmeta: f -> g",
        "A meta-rule must make the word shorter",
        2,
        1,
        "Write fewer modules after the arrow than before it.",
    ),
    (
        "axiom: A F\nmeta: F F ->AF",
        "A meta-rule must make the word shorter",
        2,
        1,
        "Write fewer modules after the arrow than before it.",
    ),
    (
        "axiom: A\nmeta: f g -> repeat(1) <h>",
        "A meta-rule must make the word shorter",
        2,
        1,
        "Write fewer modules after the arrow than before it.",
    ),
    (
        "axiom: A\ndecomposition:\nA < B -> C",
        "A rule of the decomposition cannot have a context",
        3,
        1,
        "It is applied to one module at a time.",
    ),
    (
        "axiom: A\ninterpretation:\nA > B -> C",
        "A rule of the interpretation cannot have a context",
        3,
        1,
        "It is applied to one module at a time.",
    ),
]
"""A model, what is said of it, the line and the column, and the hint."""
UNKNOWN = [
    ("axiom: A\nA < B > C(t) : u < 5 -> D", 'I do not know the name "u"', 2, 16, 'Known here: "t".'),
    ("axiom: A\nA(s) < B > C(t) -> D(r)", 'I do not know the name "r"', 2, 22, 'Known here: "s", "t".'),
    ("axiom: A\nA(t) < B(t) -> C", 'The parameter "t" is named twice', 2, 10, "Give each parameter a name of its own."),
    (
        "axiom: A\nA(t+1) < B -> C",
        'Before the arrow a parameter is a name alone, not "t + 1"',
        2,
        3,
        'Write "t" there, and the calculation after the arrow.',
    ),
    ("axiom: A\nmeta: f(x) f(x) -> f(x)", 'The parameter "x" is named twice', 2, 14, "Give each parameter a name of its own."),
    ("axiom: A\nmeta: f(x) f(y) -> f(z)", 'I do not know the name "z"', 2, 22, 'Known here: "x", "y".'),
    ("axiom: A\nA -> B : p", 'I do not know the name "p"', 2, 10, NO_NAMES),
    (
        "axiom: A\nA(i) -> repeat(i, i) <F>",
        'The name "i" is already used',
        2,
        9,
        "Give the index of the repetition a name of its own.",
    ),
    (
        "axiom: A\nA -> repeat(2, i) <repeat(2, i) <F>>",
        'The name "i" is already used',
        2,
        20,
        "Give the index of the repetition a name of its own.",
    ),
    ("axiom: A\nA -> repeat(2, i) <F> G(i)", 'I do not know the name "i"', 2, 25, NO_NAMES),
    ("axiom: A\nA -> repeat(n) <F>", 'I do not know the name "n"', 2, 13, NO_NAMES),
    ("axiom: A\ndepth: n", 'I do not know the name "n"', 2, 8, NO_NAMES),
]
"""Names that stand for nothing, or for two things."""
SENSELESS = [
    (
        "axiom: A\nA -> B : 1 < 2",
        'A probability follows the successor, but "1 < 2" is true or false',
        2,
        10,
        'A condition is written before the arrow, as in "A(t) : t < 5 -> B".',
    ),
    ("axiom: A\nA -> B : -1", "A probability cannot be negative", 2, 10, None),
    (
        "axiom: A\nA : 1 -> B : 0.5",
        '"1" is a number, but something true or false is needed here',
        2,
        5,
        'Compare it with something, as in "1 > 0".',
    ),
    (
        "axiom: A\nA -> repeat(-1) <F>",
        '"-1" is not a number of repetitions',
        2,
        13,
        "It must be a whole number from 0 to 100,000.",
    ),
    (
        "axiom: A\nA -> repeat(1.5) <F>",
        '"1.5" is not a number of repetitions',
        2,
        13,
        "It must be a whole number from 0 to 100,000.",
    ),
    (
        "axiom: A\nA -> repeat(100001) <F>",
        '"100001" is not a number of repetitions',
        2,
        13,
        "It must be a whole number from 0 to 100,000.",
    ),
    ("axiom: A\nA -> repeat(1 < 2) <F>", '"1 < 2" is true or false, but a number is needed here', 2, 13, None),
    ("axiom: A\ndepth: 1.5", '"1.5" is not a number of rounds', 2, 8, "Rounds are counted from 0: 0, 1, 2, ..."),
    (
        "axiom: A\ninterpretation:\nA -> B : 0.5",
        "A rule of the interpretation cannot have a probability",
        3,
        10,
        "A word is always drawn in the same way; chance belongs in the productions.",
    ),
    (
        "axiom: A\ninterpretation:\nA -> B(uniform(1, 2))",
        '"uniform(1, 2)" draws a new number at every use, which is not possible here',
        3,
        8,
        RANDOM,
    ),
    (
        "axiom: A\nA : uniform(0, 1) < 0.5 -> B",
        '"uniform(0, 1)" draws a new number at every use, which is not possible here',
        2,
        5,
        RANDOM,
    ),
    (
        "axiom: A\nA -> B : uniform(0, 1)",
        '"uniform(0, 1)" draws a new number at every use, which is not possible here',
        2,
        10,
        RANDOM,
    ),
    ("axiom: A\nk = normal(0, 1)", '"normal(0, 1)" draws a new number at every use, which is not possible here', 2, 5, RANDOM),
    (
        "axiom: A\nangle: uniform(80, 100)",
        '"uniform(80, 100)" draws a new number at every use, which is not possible here',
        2,
        8,
        RANDOM,
    ),
    ("axiom: A\nA(poisson(1)) -> B", '"poisson(1)" draws a new number at every use, which is not possible here', 2, 3, RANDOM),
    (
        "axiom: A\nA < B > C(table(1)) -> D",
        '"table(1)" draws a new number at every use, which is not possible here',
        2,
        11,
        RANDOM,
    ),
    (
        "axiom: A\nmeta: f f -> f(uniform(1, 2))",
        '"uniform(1, 2)" draws a new number at every use, which is not possible here',
        2,
        16,
        RANDOM,
    ),
    (
        "axiom: A\nA -> B(if(1, 2, 3))",
        '"1" is a number, but something true or false is needed here',
        2,
        11,
        'Compare it with something, as in "1 > 0".',
    ),
    ("axiom: A\nA -> B(if(1 < 2, 2 < 3, 3))", '"2 < 3" is true or false, but a number is needed here', 2, 18, None),
    ("axiom: A\ndecomposition:\nA -> B\nB -> C A", "Rule A decomposes into itself: A -> B -> A", 3, 1, "It can never finish."),
    ("axiom: A\ndecomposition:\nA(t) -> A(t)", "Rule A decomposes into itself: A -> A", 3, 1, "It can never finish."),
]
"""Values that cannot be what the model makes of them."""
KINDS = [(ModelSyntaxError, UNREADABLE), (ModelNameError, UNKNOWN), (ModelValueError, SENSELESS)]


def slip(text: str, notation: str = "abop") -> LSystemError:
    """The error that a model ends in, while it is read."""
    with pytest.raises(LSystemError) as caught:
        read(text, notation)
    return caught.value


@pytest.mark.parametrize(("kind", "row"), [(kind, row) for kind, rows in KINDS for row in rows])
def test_a_slip_is_explained(kind: type[LSystemError], row: Sequence[object]) -> None:
    text, *expected = row
    error = slip(str(text))
    assert [error.message, error.line, error.column, error.hint] == expected
    assert type(error) is kind


@pytest.mark.parametrize(
    ("rule", "lacking"),
    [("A < B -> C", "contexts"), ("A > B -> C", "contexts"), ("A(1) -> B", "values"), ("A : B -> C", "conditions")],
)
def test_what_a_plant_string_has_not_is_named(rule: str, lacking: str) -> None:
    assert slip(f"Axiom: A\n{rule}", "plant-string").message == f"A plant string has no {lacking}"


def test_nothing_is_repeated_or_drawn_in_an_axiom() -> None:
    assert slip("axiom: repeat(3) <F>").message == "Nothing is repeated in an axiom"
    message = slip("axiom: A(uniform(1, 2))").message
    assert message == '"uniform(1, 2)" draws a new number at every use, which is not possible here'


def test_deep_repetitions_are_refused() -> None:
    assert read("axiom: A\nA -> " + "repeat(1) <" * 50 + "F" + ">" * 50)
    assert slip("axiom: A\nA -> " + "repeat(1) <" * 51 + "F" + ">" * 51).message == "Repetitions are nested more than 50 deep"
    assert slip("axiom: A\nA -> " + "repeat(1) <" * 4_000 + "F" + ">" * 4_000).hint is None


def test_a_long_ring_of_decomposition_is_told_in_short() -> None:
    ring = "\n".join(f"A{i} -> A{(i + 1) % 20}" for i in range(20))
    assert (
        slip(f"axiom: A0\ndecomposition:\n{ring}").message
        == "Rule A0 decomposes into itself: A0 -> A1 -> A2 -> A3 -> ... -> A18 -> A19 -> A0"
    )
