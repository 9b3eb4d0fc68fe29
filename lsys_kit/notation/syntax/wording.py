"""Problems put into words: a table for the kit's own notation, from which a dialect's `Spelling` may differ."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError
from lsys_kit.notation.analysis.problems import Problem, ProblemFound
from lsys_kit.notation.syntax.spelling import KIT_SPELLING, Spelling, Wording

_ONE_AT_A_TIME = "It is applied to one module at a time."
_TEN_308 = "Numbers go up to about 10^308."

WORDINGS: Mapping[str, Wording] = {
    # names and expressions
    "unknown name": Wording('I do not know the name "{name}"', "Known here: {known}.", ModelNameError),
    "name among none": Wording(
        'I do not know the name "{name}"',
        'A parameter is named before the arrow, as in "A(t) {arrow} A(t+1)"; a constant on a line before, as in "{constant}".',
        ModelNameError,
    ),
    "unknown function": Wording('I do not know the function "{name}"', "Functions are: {known}.", ModelNameError),
    "unknown field": Wording('I do not know the field "{name}"', "Fields are: {known}.", ModelNameError),
    "number of arguments": Wording("{name}(...) takes {wanted}, not {given}"),
    "random number": Wording(
        '"{expression}" draws a new number at every use, which is not possible here',
        'Random numbers belong after the arrow of a production, as in "{random}".',
        ModelValueError,
    ),
    "number for truth": Wording(
        '"{expression}" is a number, but something true or false is needed here',
        'Compare it with something, as in "{expression} > 0".',
        ModelValueError,
    ),
    "truth for number": Wording('"{expression}" is true or false, but a number is needed here', error=ModelValueError),
    "no value": Wording('"{expression}" has no value: {reason}', error=ModelValueError),
    "division by zero": Wording('"{expression}" has no value: {reason}', error=ModelValueError),
    "name too long": Wording("This name has more than {most} letters"),
    "number too long": Wording("This number is too long", _TEN_308),
    "number too large": Wording("This number is too large", _TEN_308),
    "expression too deep": Wording(
        "This expression is nested more than {most} deep", 'Give a part of it a name, on a line such as "{part}".'
    ),
    "expression too long": Wording("This expression has more than {most} characters"),
    # constants and settings
    "constant twice": Wording('The constant "{name}" is declared twice', "Keep one of the two lines.", ModelNameError),
    "setting as constant": Wording('"{name}" is a setting, not a constant', 'Type "{keyword}: {value}".', ModelNameError),
    "constant of itself": Wording(
        'The constant "{name}" cannot be calculated from itself',
        'A production reads "{name} {arrow} ...", with an arrow in place of "=".',
        ModelNameError,
    ),
    "name as constant": Wording(
        'I do not know the name "{name}"', 'A production reads "{constant} {arrow} {name}".', ModelNameError
    ),
    "range upside down": Wording(
        'The range of "{name}" is upside down', 'Write the smaller end first: "in {high} .. {low}".', ModelValueError
    ),
    "step of range": Wording(
        'The step of "{name}" must be greater than 0',
        'It says how far one move of the slider goes, as in "by 0.1".',
        ModelValueError,
    ),
    "value outside range": Wording(
        '"{name}" is {value}, which is not in its range {low} .. {high}',
        "Choose a value in the range, or a wider range.",
        ModelValueError,
    ),
    "setting twice": Wording('"{keyword}:" is set a second time', "Keep one of the two lines."),
    "ignore and consider": Wording(
        'Both "ignore:" and "consider:" are set', "List the symbols that contexts pass over, or the others, not both."
    ),
    "bracket in list": Wording("A bracket is not possible here", "Contexts follow the branches in any case."),
    "constant in setting": Wording(
        'The constant "{name}" cannot be used here', '"{keyword}:" is set to a number.', ModelNameError
    ),
    "surface twice": Wording('The surface "{name}" is declared twice', "Keep one of the two.", ModelNameError),
    "number of corners": Wording(
        "A polygon has at least three corners", 'A corner is written as "(ahead, left)" or "(ahead, left, up)".'
    ),
    "number of control points": Wording("A patch has 16 control points, not {count}", "They are four rows of four points."),
    "name in surface": Wording(
        'The name "{name}" cannot be used here', "The coordinates of a surface are numbers.", ModelNameError
    ),
    "point too far": Wording(
        "This point is too far away", "A surface is about 1 long, and drawn with the size behind its name.", ModelValueError
    ),
    "number of steps": Wording(
        '"{expression}" is not a number of steps', "Steps are counted from 0: 0, 1, 2, ...", ModelValueError
    ),
    "number of rounds": Wording(
        '"{expression}" is not a number of rounds', "Rounds are counted from 0: 0, 1, 2, ...", ModelValueError
    ),
    "seed": Wording('"{expression}" is not a seed', "A seed is a whole number.", ModelValueError),
    # words and rules
    "no axiom": Wording("There is no axiom", 'Give the first word on a line of its own, as in "{axiom}".'),
    "second axiom": Wording("This is a second axiom", "A system has one axiom."),
    "number in word": Wording(
        "A number is not a module",
        'Values are written in parentheses after a symbol, as in "A(2)"; for three turns type "+++", for '
        'the colour 2, ";(2)". Where a digit is a symbol, "alphabet: 2" says so.',
    ),
    "too many parameters": Wording('"{symbol}" has more than {most} parameters'),
    "too many brackets": Wording("More than {most} brackets are open at once"),
    "bracket closes nothing": Wording('This "{bracket}" closes nothing', 'Every branch begins with "{other}".'),
    "bracket never closed": Wording('This "{bracket}" is never closed', 'Every branch ends with "{other}".'),
    "bracket before arrow": Wording(
        "A bracket is not possible here", "A right context may name branches; a left context passes over them."
    ),
    "bracket replaced": Wording(
        "A bracket is not possible here",
        'What is replaced has no branches; a right context may name them, as in "A > [B]C {arrow} D".',
    ),
    "parameter twice": Wording(
        'The parameter "{name}" is named twice', "Give each parameter a name of its own.", ModelNameError
    ),
    "calculated parameter": Wording(
        'Before the arrow a parameter is a name alone, not "{expression}"',
        'Write "{name}" there, and the calculation after the arrow.',
        ModelNameError,
    ),
    "condition without colon": Wording(
        'A ":" is missing before the condition',
        'A condition is written between ":" and the arrow, as in "A(t) : t < 5 {arrow} B".',
    ),
    "context in decomposition": Wording("A rule of the decomposition cannot have a context", _ONE_AT_A_TIME),
    "context in interpretation": Wording("A rule of the {interpretation} cannot have a context", _ONE_AT_A_TIME),
    "several modules in decomposition": Wording("A rule of the decomposition replaces one module", _ONE_AT_A_TIME),
    "several modules in interpretation": Wording("A rule of the {interpretation} replaces one module", _ONE_AT_A_TIME),
    "probability in interpretation": Wording(
        "A rule of the {interpretation} cannot have a probability",
        "A word is always drawn in the same way; chance belongs in the productions.",
        ModelValueError,
    ),
    "truth as probability": Wording(
        'A probability follows the successor, but "{expression}" is true or false',
        'A condition is written before the arrow, as in "A(t) : t < 5 {arrow} B".',
        ModelValueError,
    ),
    "negative probability": Wording("A probability cannot be negative", error=ModelValueError),
    "index taken": Wording(
        'The name "{name}" is already used', "Give the index of the repetition a name of its own.", ModelNameError
    ),
    "number of repetitions": Wording(
        '"{expression}" is not a number of repetitions', "It must be a whole number from 0 to {most}.", ModelValueError
    ),
    "repetitions too deep": Wording("Repetitions are nested more than {most} deep"),
    "meta-rule not shorter": Wording(
        "A meta-rule must make the word shorter", "Write fewer modules after the arrow than before it."
    ),
    # what a model never does, or never stops doing
    "never matches": Wording("The production {rule} can never match: no module {missing} occurs."),
    "production never applied": Wording(
        "Production {number}, for {rule}, is never applied: production {first} comes before it and matches every {module}."
    ),
    "decomposition rule never applied": Wording(
        "Decomposition rule {number}, for {rule}, is never applied: decomposition rule {first} comes before it and matches "
        "every {module}."
    ),
    "several replaced": Wording(
        "The strict predecessor of production {number}, for {rule}, has {count} modules, which are "
        'replaced together{others}. A neighbour that stays is a context, before "<" or after ">".'
    ),
    "no probability": Wording(
        "Production {number}, for {rule}, has no probability: it is applied only where none of those that have one matches."
    ),
    "other number of values": Wording("No production matches {symbol} with {count} values: that for {symbol} has {others}."),
    "final sign": Wording(
        'The "{sign}" after the production for {rule} is read as a command of the turtle; a line needs no sign at its end.'
    ),
    "constant used nowhere": Wording('The constant "{name}" is used nowhere.'),
    "angle used nowhere": Wording('The constant "{name}" is used nowhere. For the angle of the turns type "angle: {value}".'),
    "in quotation marks": Wording(
        "The two ' around {word} are read as commands of the turtle, not as quotation marks: words are typed without any."
    ),
    "context passed over": Wording("The production {rule} can never match: contexts pass over {symbol}."),
    "comment as modules": Wording(
        'The "{said}" after the production for {rule} is read as modules, not as a comment, which is '
        'written between "/*" and "*/".'
    ),
    "decimal comma": Wording("{module} has two values: a decimal is written with a point."),
    "only in time": Wording(
        "No step changes the axiom: productions such as that for {rule} wait for an age, and no step makes "
        "a module older. Time passes in timed(system).word(t), and in steps with a(t) -> a(t+dt)."
    ),
    "unanswered query": Wording(
        'Nothing in the model answers {symbol}: name a field, as in "field: light", or derive with field=...'
    ),
    "drawn no further": Wording(
        "{made} stays as it is in what {rule} is drawn as, though it has a rule too: {interpretation} "
        'rules are applied {often}. To apply them to what they make, type "{depth} {needed}".'
    ),
    "drawn as itself": Wording("{symbol} is drawn as itself again ({cycle}): the depth ends that after {often} times."),
    "endless decomposition": Wording("Rule {symbol} decomposes into itself: {cycle}", "It can never finish.", ModelValueError),
}
"""The problems of L-systems, as the kit's own notation words them."""


def worded(problem: Problem, spelling: Spelling) -> tuple[str, str | None]:
    """The message and the hint for a problem, as a dialect words them.

    >>> worded(Problem("unknown name", subject={"name": "dT", "known": '"dt"'}, suggestion="dt"), KIT_SPELLING)
    ('I do not know the name "dT"', 'Did you mean "dt"?')
    """
    wording = spelling.wordings.get(problem.code) or WORDINGS[problem.code]
    words = {**vars(spelling), **{name: spelling.shown(value) for name, value in problem.subject.items()}}
    hint = f'Did you mean "{problem.suggestion}"?' if problem.suggestion else wording.hint and wording.hint.format(**words)
    return wording.message.format(**words), hint


def error_of(problem: Problem, source: str, spelling: Spelling) -> LSystemError:
    """A problem of a text as an error with its place."""
    wording = spelling.wordings.get(problem.code) or WORDINGS[problem.code]
    message, hint = worded(problem, spelling)
    start, end = problem.place or (None, None)
    return wording.error(message, source, start, end, hint)


@contextmanager
def reporting(source: str, spelling: Spelling = KIT_SPELLING) -> Iterator[None]:
    """Turn a problem that is found in the block into an error, in a dialect's words."""
    try:
        yield
    except ProblemFound as error:
        raise error_of(error.problem, source, spelling) from None


def notes(problems: Iterator[Problem] | list[Problem], spelling: Spelling) -> tuple[str, ...]:
    """Problems that are only worth a note, in a dialect's words."""
    return tuple(
        message + (f" {hint}" if problem.suggestion else "")
        for problem in problems
        for message, hint in (worded(problem, spelling),)
    )
