"""What is said where more systems fit than can be listed: how many they are, what all of them have, and what is left open."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lsys_kit.derivation.inference.fits import Fits
from lsys_kit.derivation.inference.problem import Problem, Table, counted_tables, table_of, tables
from lsys_kit.derivation.inference.productions import productions_of
from lsys_kit.derivation.inference.word_equations.counting import Count
from lsys_kit.derivation.inference.word_equations.search import GivenUp
from lsys_kit.errors import ModelLimitError

MOST_TRIED_FOR_ONE = 100
"""So many successors are tried to see whether any system fits."""
MOST_TRIED_TO_COUNT = 8_000
"""So many successors are tried to count those that fit."""
MOST_NAMED = 20
"""So many productions and letters are named."""


def one_soon_found(problem: Problem) -> bool:
    """Whether some system fits, as far as is soon found."""
    try:
        return next(tables(problem, MOST_TRIED_FOR_ONE), None) is not None
    except GivenUp:
        return False


def soon_counted(problem: Problem, trials: int) -> Count | None:
    """How many systems fit; None where so many trials do not suffice."""
    try:
        return counted_tables(problem, trials)
    except (GivenUp, ModelLimitError):
        return None


def too_many(problem: Problem, listed: Fits, found: Sequence[Table]) -> ModelLimitError:
    """The error where more systems fit than are listed."""
    count, most = soon_counted(problem, MOST_TRIED_TO_COUNT), len(listed)
    if count is None:
        said, all_of_them, left = f"More than {most:,} systems fit", "All that were found", [*_differing(found)]
        certain = {letter: word for letter, word in found[0].items() if str(letter) not in left}
    else:
        said, all_of_them = f"{count.solutions:,} systems fit", "All"
        certain = table_of(problem, count.certain)
        left = [f"{problem.letters[letter]} ({ways} ways)" for letter, ways in count.ways.items()]
    rules = [str(production) for production in productions_of(certain)]
    has = f" {all_of_them} have {_some(rules)}." if rules else ""
    hint = f"{_what_to_try(problem)}{has} They differ in what becomes of {_some(left)}."
    return ModelLimitError(
        f"{said} these {len(listed.words)} words",
        limit=most,
        needed=count.solutions if count else None,
        partial=listed,
        hint=hint,
    )


def _what_to_try(problem: Problem) -> str:
    """More steps tell more, but not where each brings modules with new values."""
    if any(letter.module.arguments and (letter.left or letter.right) for letter in problem.letters):
        return (
            "With contexts, a module with other values, or other neighbours, is another letter: laws of values are looked "
            "for without contexts only."
        )
    return "Give more steps."


def _differing(found: Sequence[Table]) -> Iterator[str]:
    """The letters that become different words."""
    return (str(letter) for letter, word in found[0].items() if any(other[letter] != word for other in found))


def _some(texts: Sequence[str]) -> str:
    """Texts in a row; of very many only the first, and how many more there are."""
    return ", ".join(texts[:MOST_NAMED]) + (f" and {len(texts) - MOST_NAMED} more" if len(texts) > MOST_NAMED else "")
