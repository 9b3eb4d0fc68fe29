"""`infer`: all systems that fit a sequence of words.

Which successors of its letters turn each word into the next is a system of equations between words, whose solutions are
searched for exhaustively. This is the inference of L-systems: I. McQuillan, J. Bernard and P. Prusinkiewicz, Algorithms for
inferring context-sensitive L-systems, 2018; J. Bernard and I. McQuillan, A fast and reliable hybrid approach for inferring
L-systems, 2018.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import islice

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.inference.fits import Fits, Refusal, Wider
from lsys_kit.derivation.inference.problem import (
    Conditions,
    Problem,
    Row,
    Table,
    counted_tables,
    problem_of,
    read_words,
    table_of,
    tables,
    well_nested,
)
from lsys_kit.derivation.inference.productions import general_productions, productions_of, system_of
from lsys_kit.derivation.inference.refusals import contradiction, doubtful_words, slips
from lsys_kit.derivation.inference.word_equations import Count, GivenUp
from lsys_kit.errors import ModelLimitError, ModelValueError, require, shown, whole_number

MOST_TRIED_FOR_ONE = 100
"""So many successors are tried to see whether any system fits."""
MOST_TRIED_TO_COUNT = 8_000
"""So many successors are tried to count those that fit."""
MOST_NAMED = 20
"""So many productions and letters are named."""
_OTHER_LETTERS = (
    "With contexts, a module with other values, or other neighbours, is another letter: laws of values are looked "
    "for without contexts only."
)
"""Why more steps tell nothing where each brings modules with new values."""


def one_soon_found(problem: Problem) -> bool:
    """Whether some system fits, as far as is soon found."""
    with suppress(GivenUp):
        return next(tables(problem, MOST_TRIED_FOR_ONE), None) is not None
    return False


def soon_counted(problem: Problem, trials: int) -> Count | None:
    """How many systems fit; None where so many trials do not suffice."""
    with suppress(GivenUp, ModelLimitError):
        return counted_tables(problem, trials)
    return None


def too_many(problem: Problem, listed: Fits, found: Sequence[Table]) -> ModelLimitError:
    """The error where more systems fit than are listed."""
    count, most = soon_counted(problem, MOST_TRIED_TO_COUNT), len(listed)
    if count is None:
        said, all_of_them = f"More than {most:,} systems fit", "All that were found"
        left = [str(letter) for letter, word in found[0].items() if any(other[letter] != word for other in found)]
        certain = {letter: word for letter, word in found[0].items() if str(letter) not in left}
    else:
        said, all_of_them = f"{count.solutions:,} systems fit", "All"
        certain = table_of(problem, count.certain)
        left = [f"{problem.letters[letter]} ({ways} ways)" for letter, ways in count.ways.items()]
    rules = [str(production) for production in productions_of(certain)]
    has = f" {all_of_them} have {_some(rules)}." if rules else ""
    parametric = any(letter.module.arguments and (letter.left or letter.right) for letter in problem.letters)
    hint = f"{_OTHER_LETTERS if parametric else 'Give more steps.'}{has} They differ in what becomes of {_some(left)}."
    return ModelLimitError(
        f"{said} these {len(listed.words)} words",
        limit=most,
        needed=count.solutions if count else None,
        partial=listed,
        hint=hint,
    )


def _some(texts: Sequence[str]) -> str:
    """Texts in a row; of very many only the first, and how many more there are."""
    return ", ".join(texts[:MOST_NAMED]) + (f" and {len(texts) - MOST_NAMED} more" if len(texts) > MOST_NAMED else "")


MOST_FITS = 1_000
"""So many systems are listed; more are refused."""
MOST_SUCCESSORS_TRIED = 4_000
"""So many successors are tried to count the systems with contexts where none fits without."""
MOST_TRIED_WITH_SLIPS = 100
"""So many, where a slip is the more likely reason."""
CONTEXTS = ((1, 0), (0, 1), (1, 1), (2, 0), (0, 2), (2, 1), (1, 2), (2, 2))
"""The contexts that are tried where no system fits, the smallest first."""


def infer(
    words: Iterable[object], constants: Iterable[str] = ("+", "-"), erasing: bool = False, context: tuple[int, int] = (0, 0)
) -> Fits:
    """All deterministic systems that fit a sequence of words: each of them derives every word from the one before.

    The arguments, what is returned and the errors are those of the public function, which finds the rules of pictures, too.

    >>> infer(["a", "ab", "aba"])
    One system fits these 3 words:
      a -> a b
      b -> a
    """
    found: list[Table] = []
    with Task(lambda: f"The search for systems was not finished, with {len(found)} found,"):
        asked = conditions_of(constants, erasing, context)
        rows = read_words(words)
        for step, row in enumerate(rows if asked.context != (0, 0) else ()):  # contexts follow branches
            if not well_nested(row):
                raise ModelValueError(
                    f"The word of step {step} has a bracket without its partner, so that it has no contexts",
                    hint="Look for systems without contexts, or mend the word.",
                )
        try:
            problem = problem_of(rows, asked)
            found += islice(tables(problem), MOST_FITS + 1)
        except ModelLimitError as error:
            error.partial = _fits(rows, found, asked)
            raise
        if len(found) > MOST_FITS:
            raise too_many(problem, _fits(rows, found[:MOST_FITS], asked), found)
        if found:
            return _fits(rows, found, asked)
        try:
            return Fits(rows, (), asked, _refusal(rows, asked))
        except ModelLimitError:  # that none fits is known all the same
            return Fits(rows, (), asked, Refusal(None))


def conditions_of(constants: object, erasing: object, context: object) -> Conditions:
    """What is looked for, where the arguments say that."""
    if not isinstance(constants, Iterable):
        raise ModelValueError(
            f"The constants must be symbols in a row, not {type(constants).__name__}",
            hint='Give their symbols, as in constants=("+", "-").',
        )
    symbols = set[str]()
    for symbol in counted(constants):
        require(symbol, str, "A symbol as a constant")
        symbols.add(symbol)
    require(erasing, bool, 'True or False for "erasing"')
    if not isinstance(context, Sequence) or isinstance(context, str) or len(context) != 2:
        raise ModelValueError(
            f"The context must be two whole numbers, not {shown(context)}",
            hint="Say how many neighbours to the left and to the right, as in context=(1, 0).",
        )
    left, right = (whole_number(size, "Each size of the context") for size in context)
    return Conditions(frozenset(symbols), bool(erasing), (left, right))


def _fits(rows: tuple[Row, ...], found: Sequence[Table], conditions: Conditions) -> Fits:
    """The systems for tables; where modules have parameters, those with the fewest productions."""
    rules = [tuple(productions_of(table)) for table in found]
    if conditions.context == (0, 0) and any(module.arguments for row in rows for module in row):
        rules = [tuple(general_productions(table)) for table in found]
        fewest = min(map(len, rules), default=0)
        rules = [each for each in rules if len(each) == fewest]
    return Fits(rows, tuple(system_of(rows[0], each, conditions) for each in rules), conditions)


def _refusal(rows: tuple[Row, ...], conditions: Conditions) -> Refusal:
    where = contradiction(rows, conditions)
    if where is None or conditions.context != (0, 0):
        return Refusal(where, wider=next(_wider(rows, conditions, MOST_SUCCESSORS_TRIED), None))
    wrong = tuple(slips(rows, where, conditions))
    doubtful = () if wrong else tuple(doubtful_words(rows, where, conditions))
    trials = MOST_TRIED_WITH_SLIPS if wrong else MOST_SUCCESSORS_TRIED
    return Refusal(where, wrong, doubtful, next(_wider(rows, conditions, trials), None))


def _wider(rows: tuple[Row, ...], conditions: Conditions, trials: int) -> Iterator[Wider]:
    nested = all(map(well_nested, rows))
    for erasing in dict.fromkeys((conditions.erasing, True)):
        alone = ((0, 0),) * (erasing is not conditions.erasing)
        for context in (*alone, *CONTEXTS * nested):
            if context[0] >= conditions.context[0] and context[1] >= conditions.context[1]:
                wider = replace(conditions, erasing=erasing, context=context)
                problem = problem_of(rows, wider)
                if one_soon_found(problem):
                    count = soon_counted(problem, trials)
                    yield Wider(wider, count.solutions, len(problem.letters), len(count.ways)) if count else Wider(wider, None)
