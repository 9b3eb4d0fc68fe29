"""`infer`: all systems that fit a sequence of words.

Which successors of its letters turn each word into the next is a system of equations between words, whose solutions are
searched for exhaustively. This is the inference of L-systems: I. McQuillan, J. Bernard and P. Prusinkiewicz, Algorithms for
inferring context-sensitive L-systems, 2018; J. Bernard and I. McQuillan, A fast and reliable hybrid approach for inferring
L-systems, 2018.
"""

from __future__ import annotations

from abc import abstractmethod
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import accumulate, islice
from typing import TypeVar, overload

from lsys_kit.budget import Task, check_budget, counted
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation, derive
from lsys_kit.derivation.inference.mending import MOST_READ, Effort, Mending, filled_words, mendings
from lsys_kit.derivation.inference.problem import (
    GAP,
    Conditions,
    Problem,
    Row,
    Table,
    counted_tables,
    problem_of,
    read_words,
    table_of,
    tables,
    text_of,
    well_nested,
)
from lsys_kit.derivation.inference.productions import general_productions, productions_of, row_of, system_of
from lsys_kit.derivation.inference.refusals import Contradiction, contradict, contradiction
from lsys_kit.derivation.inference.stochastic import LONGEST, Choice, choices_of
from lsys_kit.derivation.inference.word_equations import Count, GivenUp, Trials
from lsys_kit.errors import ModelLimitError, ModelValueError, require, shown, whole_number
from lsys_kit.notation.model.expressions import Apply, Expression, Number
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.translation import gettext, ngettext

MOST_SHOWN = 20
"""So many systems are shown, and so many letters and productions named."""
MOST_MENDINGS_SHOWN = 6
"""So many ways to mend words are shown."""
MOST_COMPARED, STEPS_AHEAD, MODULES_AHEAD = 100, 10, 100_000
"""So many systems, steps, and words of so many modules, are looked at to see where systems part."""


@dataclass(frozen=True)
class Wider:
    """Wider conditions under which systems fit: how many do (None where they were not counted), how many letters there are,
    each with its neighbours, and how many of them become different words in these systems."""

    conditions: Conditions
    systems: int | None
    letters: int = 0
    left_open: int = 0

    def __str__(self) -> str:
        contexts = self.conditions.context != (0, 0)
        choices = [f"context={self.conditions.context}"] * contexts + ["erasing=True"] * self.conditions.erasing
        said: dict[str, object] = {"choices": ", ".join(choices), "systems": f"{self.systems or 0:,}"}
        if self.systems is None:
            return gettext("With {choices} many systems fit.", **said)
        if self.systems == 1:
            return gettext("With {choices} one system fits.", **said)
        if not self.left_open:
            return gettext("With {choices} {systems} systems fit.", **said)
        said |= {"letters": self.letters, "open": self.left_open}
        if contexts:
            return gettext(
                "With {choices} {systems} systems fit: of {letters} letters, told apart by their neighbours, {open} can become "
                "different words.",
                **said,
            )
        return gettext("With {choices} {systems} systems fit: of {letters} letters {open} can become different words.", **said)


@dataclass(frozen=True)
class Refusal:
    """Why no system fits: the first step that cannot come from the one before, if it was found; the ways to mend the words with
    the fewest edits, and whether all of them were looked for; and contexts with which some system fits, and whether all of them
    were tried."""

    contradiction: Contradiction | None
    mendings: tuple[Mending, ...] = ()
    wider: Wider | None = None
    out_of_reach: bool = False
    contexts_out_of_reach: bool = False

    def __str__(self) -> str:
        found = [str(self.contradiction)] if self.contradiction else []
        if self.mendings:
            ways = [str(mending) for mending in self.mendings[:MOST_MENDINGS_SHOWN]]
            more = len(self.mendings) - len(ways)
            if more:
                ways.append(ngettext("one other change were made", "one of {number} other changes were made", more))
            found.append(gettext("A system without contexts would fit if {ways}.", ways=gettext(", or if ").join(ways)))
        elif self.out_of_reach:
            found.append(gettext("What would have to be another letter or word is out of reach: too much is possible."))
        if self.wider:
            found.append(str(self.wider))
        elif self.contexts_out_of_reach:
            found.append(gettext("Whether a system with contexts fits is out of reach."))
        return " ".join(found)


class SystemsFound(Sequence[LSystem]):
    """Systems in a sequence that prints as an explanation."""

    systems: tuple[LSystem, ...]

    def __len__(self) -> int:
        return len(self.systems)

    @overload
    def __getitem__(self, index: int) -> LSystem: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[LSystem]: ...
    def __getitem__(self, index: int | slice) -> LSystem | Sequence[LSystem]:
        return self.systems[index]

    @abstractmethod
    def lines(self) -> Iterator[str]:
        """The explanation, line by line."""

    def __repr__(self) -> str:
        with Task("The explanation was not finished"):
            return "\n".join(self.lines())


@dataclass(frozen=True, repr=False)
class Fits(SystemsFound):
    """All systems that fit a sequence of words: a sequence of systems, which prints as an explanation.

    Where no system fits it says why: the first step and letter that contradict those before, and contexts with which some
    system fits. What was not known of words is filled in. Letters that only the last word has are left as they are, since
    nothing is known of them. Where modules have parameters and no contexts are asked for, the systems are those with the
    fewest productions: conditions compare parameters with numbers, and values are affine functions of parameters. With
    contexts no laws are looked for: a module with other values is another letter.

    Attributes
    ----------
    words
        The words of steps 0, 1, 2, ...; what was unknown of them as all systems have it, where they agree.
    systems
        The systems: each derives the words exactly.
    conditions
        What systems were looked for.
    refusal
        Why there is none; None where there is one.
    given
        The words as they were given, where some of them were unknown.
    """

    words: tuple[Row, ...]
    systems: tuple[LSystem, ...]
    conditions: Conditions
    refusal: Refusal | None = None
    given: tuple[Row, ...] = ()

    @property
    def mended(self) -> tuple[Mending, ...]:
        """Where no system fits, the ways to mend the words with the fewest edits: of one or two letters, of a step that is
        missing or one too many, or of a whole word; each has its `edits`, `words`, `systems`.

        >>> from lsys_kit.derivation.inference.infer import infer
        >>> mending = infer(["a", "ab", "aba", "abbab"]).mended[0]
        >>> str(mending), str(mending.systems[0].productions[0])
        ('letter 3 of step 3, b, were a', 'a -> a b')
        """
        return self.refusal.mendings if self.refusal else ()

    def lines(self) -> Iterator[str]:
        """The explanation, line by line."""
        yield str(explanation(self))


@dataclass(frozen=True)
class Explanation:
    """What is said of the systems that fit: how many do, or why none does; the productions that all of them have, and the other
    ones of each of the first systems; how many are not shown; the first step at which they have different words, if it was
    found; and what the words leave open."""

    heading: str
    common: tuple[Production, ...] = ()
    own: tuple[tuple[Production, ...], ...] = ()
    more: int = 0
    parting: int | None = None
    notes: tuple[str, ...] = ()

    def __str__(self) -> str:
        if not self.common and not self.own:
            return self.heading
        lines = [f"{self.heading}:"]
        if self.common:
            lines += [*([gettext(" all have")] if self.own else []), *_lines(self.common, "  ")]
        for number, productions in enumerate(self.own, 1):
            lines += [f" {number}.", *_lines(productions, "  ")]
        return "\n".join([*lines, *([gettext(" and {more} more", more=self.more)] if self.more > 0 else []), *self.notes])


def explanation(fits: Fits) -> Explanation:
    """What is said of the systems that fit.

    >>> from lsys_kit.derivation.inference.infer import infer
    >>> explained = explanation(infer(["a", "bc", "caa"]))
    >>> explained.heading, explained.parting
    ('2 systems fit these 3 words; they part at step 3', 3)
    """
    if fits.refusal is not None:
        return _refused(fits)
    common = tuple(rule for rule in fits[0].productions if all(rule in system.productions for system in fits))
    if len(fits) == 1:
        one = gettext("One system fits these {number} words", number=len(fits.words))
        return Explanation(one, common, notes=tuple(_unknown(fits)))
    step = parting_step(fits[:MOST_COMPARED], len(fits.words))
    later = (
        _alike_so_far(fits)
        if step is None
        else gettext("they part at step {step}", step=step)
        if step == len(fits.words) or len(fits) <= MOST_COMPARED
        else gettext("they part by step {step}", step=step)
    )
    own = tuple(tuple(rule for rule in system.productions if rule not in common) for system in fits[:MOST_SHOWN])
    several = gettext("{systems} systems fit these {number} words", systems=len(fits), number=len(fits.words))
    return Explanation(f"{several}; {later}", common, own, max(0, len(fits) - MOST_SHOWN), step, tuple(_unknown(fits)))


def _alike_so_far(fits: Fits) -> str:
    """That later words are the same up to the step that was looked at, as long as letters that only the last word has stay as
    they are."""
    last, derivation = len(fits.words) - 1, derive(fits[0], 0)
    while last < len(fits.words) + STEPS_AHEAD and _small(derivation, last + 1):
        last += 1
    if last < len(fits.words):
        return gettext("later words are too long to be compared")
    unknown = _only_last(fits)
    if not unknown:
        return gettext("their words are the same up to step {last}", last=last)
    if len(unknown) == 1:
        text = gettext("if {letters} stays as it is, their words are the same up to step {last}")
    else:
        text = gettext("if {letters} stay as they are, their words are the same up to step {last}")
    return text.format(letters=_some(unknown), last=last)


def _refused(fits: Fits) -> Explanation:
    """Why no system fits; where the words can be mended in one way, with what fits them then."""
    said = f"{gettext('No system fits these {number} words.', number=len(fits.words))} {fits.refusal}".strip()
    if len(fits.mended) != 1 or not (systems := fits.mended[0].systems):
        return Explanation(said)
    if len(systems) == 1:
        return Explanation(f"{said} {gettext('One system fits the mended words')}", systems[0].productions)
    two, several = gettext("Two systems fit the mended words."), gettext("Several systems fit the mended words.")
    return Explanation(f"{said} {several if len(systems) > 2 else two}")


def _lines(productions: Sequence[Production], margin: str) -> Iterator[str]:
    return (f"{margin}{production}" for production in productions)


def _unknown(fits: Fits) -> Iterator[str]:
    """What the words leave open: what becomes of letters of the last word alone, and where a threshold lies exactly."""
    if any(rule.condition is not None for system in fits for rule in system.productions):
        yield gettext(
            "The number that a condition compares with could lie anywhere between the values that occur on its two sides."
        )
    for step, given in enumerate(fits.given):
        if GAP in given and GAP not in fits.words[step]:
            yield gettext("The word of step {step} is {word}.", step=step, word=text_of(fits.words[step]))
    if unclear := [str(step) for step, word in enumerate(_words_known(fits)) if GAP in word]:
        yield gettext("The systems have different words of step {steps}.", steps=_some(unclear))
    if unknown := _only_last(fits):
        yield gettext("Nothing is known of what becomes of {letters}: only the last word has it.", letters=_some(unknown))


def _only_last(fits: Fits) -> list[str]:
    """The letters that only the last word has."""
    *words, last = _words_known(fits)
    before = {module.symbol for word in words for module in word} | fits.conditions.unchanged | {GAP.symbol}
    return [*dict.fromkeys(module.symbol for module in last if module.symbol not in before)]


def _words_known(fits: Fits) -> list[Row]:
    """The words up to the last that is not wholly unknown."""
    words = [*fits.words]
    while words[-1] == (GAP,):
        words.pop()
    return words


def parting_step(fits: Sequence[LSystem], start: int) -> int | None:
    """The first step from `start` on at which some systems have different words; None where there is none as far as is looked.

    >>> from lsys_kit import read
    >>> parting_step([read("axiom: a\\na -> a b"), read("axiom: a\\na -> a b\\nb -> a")], 1)
    2
    """
    first, found = derive(fits[0], 0), None
    codes: dict[Module, int] = {}
    words: dict[int, list[int]] = {}
    for system in fits[1:]:
        other, step = derive(system, 0), start
        most = start + STEPS_AHEAD if found is None else found - 1
        while step <= most and _small(first, step) and _small(other, step):
            check_budget()
            if step not in words:
                words[step] = _codes_of(first.to(step)[step], codes)
            if words[step] != _codes_of(other.to(step)[step], codes):
                found = step
                break
            step += 1
    return found


def _codes_of(word: Word, codes: dict[Module, int]) -> list[int]:
    """A word with a number for each module, the same in every system."""
    own = [codes.setdefault(module, len(codes)) for module in word.states.modules]
    return [own[number] for number in word.numbers()]


def _small(derivation: Derivation, step: int) -> bool:
    try:
        return derivation.to(step).lengths[step] <= MODULES_AHEAD
    except ModelLimitError:
        return False


MOST_TRIED_FOR_ONE, MOST_SEEN_FOR_ONE = 100, 40_000
"""So many successors are tried to see whether any system fits, and so many items of equations looked at."""
MOST_TRIED_TO_COUNT, MOST_SEEN_TO_COUNT = 8_000, 600_000
"""So many successors are tried to count those that fit, and so many items of equations looked at."""
MOST_SEEN_WITH_CONTEXTS = 100_000
"""So many items of equations are looked at to find contexts with which some system fits, until that is out of reach; to see a
module between its neighbours takes as long as one of them."""
_OTHER_LETTERS = (
    "With contexts, a module with other values, or other neighbours, is another letter: laws of values are looked "
    "for without contexts only."
)
"""Why more steps tell nothing where each brings modules with new values."""


Result = TypeVar("Result")


def _searched(problem: Problem, search: Callable[[Problem, Trials], Result], most: int, effort: Effort) -> Result | None:
    """What a search finds; None, and something is missed, where so many trials or items do not suffice."""
    trials = Trials(most, effort.left)
    try:
        return search(problem, trials)
    except (GivenUp, ModelLimitError):
        effort.missed = True
        return None
    finally:
        effort.left = int(trials.items)


def _has_one(problem: Problem, trials: Trials) -> bool:
    return next(tables(problem, trials), None) is not None


def soon_counted(problem: Problem, most: int, effort: Effort) -> Count | None:
    """How many systems fit; None where so many trials do not suffice."""
    return _searched(problem, counted_tables, most, effort)


def too_many(problem: Problem, listed: Fits, found: Sequence[Table]) -> ModelLimitError:
    """The error where more systems fit than are listed."""
    count, most = soon_counted(problem, MOST_TRIED_TO_COUNT, Effort(MOST_SEEN_TO_COUNT)), len(listed)
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
    row, more = ", ".join(texts[:MOST_SHOWN]), len(texts) - MOST_SHOWN
    return row + gettext(" and {more} more", more=more) if more > 0 else row


MOST_FITS = 1_000
"""So many systems are listed; more are refused."""
MOST_SUCCESSORS_TRIED = 4_000
"""So many successors are tried to count the systems with contexts where none fits without."""
MOST_TRIED_WITH_MENDINGS, MOST_MODULES_WITH_MENDINGS = 100, 60
"""So many, and only of words with so many modules together, where a few edits are the more likely reason."""
MOST_AT_FIRST = 1_000
"""So many modules have the words together that are looked at first."""
MOST_LOOKS_FOR_LAWS = 6_000
"""So many ways to divide modules into cases are looked at to find laws that hold in mended words."""
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
    >>> print(infer(["FGG", "F-G+F+G-FGGGG"]))
    2 systems fit these 2 words; they part at step 2:
     1.
      F -> F-G+F+G-F G G
     2.
      F -> F-G+F+G-F
      G -> G G
    """
    found: list[Table] = []
    with Task(lambda: f"The search for systems was not finished, with {len(found)} found,"):
        asked = conditions_of(constants, erasing, context)
        rows = read_words(words)
        if any(GAP in row for row in rows):
            return _with_unknown_words(rows, asked)
        for step, row in enumerate(rows if asked.context != (0, 0) else ()):  # contexts follow branches
            if not well_nested(row):
                raise ModelValueError(
                    f"The word of step {step} has a bracket without its partner, so that it has no contexts",
                    hint="Look for systems without contexts, or mend the word.",
                )
        try:
            problem = problem_of(rows, asked)
            if not _soon_refuted(rows, asked):
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


def _soon_refuted(rows: tuple[Row, ...], conditions: Conditions) -> bool:
    """Whether the first words, which are short, contradict one another, so that the long ones need not be looked at."""
    sizes = [*accumulate(map(len, rows))]
    first = rows[: bisect_right(sizes, MOST_AT_FIRST)]
    with suppress(GivenUp):
        return 1 < len(first) < len(rows) and contradict(first, conditions, Trials(items=MOST_SEEN_FOR_ONE))
    return False


def _with_unknown_words(rows: tuple[Row, ...], conditions: Conditions) -> Fits:
    """All systems that fit words of which something is not known."""
    if conditions.context != (0, 0):
        raise ModelValueError(
            "With contexts all words must be known", hint="Leave out the context, or the words from the first unknown one on."
        )
    found: list[tuple[Table, tuple[Row, ...]]] = []
    try:
        found += islice(filled_words(rows, conditions, Effort(MOST_READ // 8)), MOST_FITS + 1)
    except GivenUp:
        raise ModelLimitError(
            f"What is unknown of these {len(rows)} words is out of reach",
            limit=MOST_READ,
            hint="Give more words behind those that are unknown, or more of their letters.",
        ) from None
    if len(found) > MOST_FITS:
        raise ModelLimitError(
            f"More than {MOST_FITS:,} systems fit these {len(rows)} words", limit=MOST_FITS, hint="Give more of the words."
        )
    if not found:
        return Fits(rows, (), conditions, _refusal_with_unknown_words(rows, conditions), rows)
    fits = [_fits(words, [table], conditions).systems for table, words in found]
    kept = dict.fromkeys(system for systems in fits for system in systems)
    filled = [words for _, words in found]
    words = tuple(
        filled[0][step] if step < len(filled[0]) and all(each[step] == filled[0][step] for each in filled) else row
        for step, row in enumerate(rows)
    )
    return Fits(words, tuple(kept), conditions, None, rows)


@dataclass(frozen=True, repr=False)
class StochasticFits(SystemsFound):
    """The stochastic system that several derivations of it suggest: a sequence of one system, or none, which prints as an
    explanation.

    Attributes
    ----------
    derivations
        The words of steps 0, 1, 2, ... of each derivation.
    systems
        The system; none where no stochastic system makes all steps.
    choices
        Its productions, each with its `letter`, its `successor`, its `probability` with the standard `error` of that, and how
        many `times` it was used, `of` so many times that the letter was replaced.
    conditions
        What was looked for.
    """

    derivations: tuple[tuple[Row, ...], ...]
    systems: tuple[LSystem, ...] = ()
    choices: tuple[Choice, ...] = ()
    conditions: Conditions = field(default_factory=Conditions)

    def lines(self) -> Iterator[str]:
        """The explanation, line by line."""
        many = len(self.derivations)
        steps = sum(len(words) - 1 for words in self.derivations)
        these = ngettext("this derivation", "these {number} derivations", many)
        these = f"{these} ({ngettext('{number} step', '{number} steps', steps)})"
        if not self.systems:
            yield gettext(
                "No stochastic system without contexts fits {these}, with successors of up to {longest} modules.",
                these=these,
                longest=LONGEST,
            )
            return
        yield gettext("The stochastic system that fits {these} best:", these=these)
        yield from (f"  {choice}" for choice in self.choices)
        if any(choice.error for choice in self.choices):
            yield gettext("Behind each probability stands its standard error, and how often the production was used.")
        known = {choice.letter for choice in self.choices}
        last = dict.fromkeys(module for words in self.derivations for module in words[-1])
        unknown = [str(module) for module in last if module not in known and module.symbol not in self.conditions.unchanged]
        if unknown:
            yield gettext("Nothing is known of what becomes of {letters}: only last words have it.", letters=_some(unknown))


def _quotient(share: Fraction) -> Expression:
    """A share as a production writes it."""
    return Apply("/", (Number(share.numerator), Number(share.denominator)))


MOST_DERIVATIONS = 1_000
"""So many derivations of a stochastic system are read."""


def infer_stochastic(given: object, constants: Iterable[str] = ("+", "-"), erasing: bool = False) -> StochasticFits:
    """The stochastic system that several derivations of it suggest.

    >>> infer_stochastic([["a", "ab", "abb"], ["a", "b", "b"], ["a", "ab", "bb"]])
    The stochastic system that fits these 3 derivations (6 steps) best:
      a -> a b  (0.6 ± 0.22, 3 of 5)
      a -> b  (0.4 ± 0.22, 2 of 5)
      b -> b  (all 3)
    Behind each probability stands its standard error, and how often the production was used.
    """
    with Task("The search for a stochastic system was not finished"):
        asked = conditions_of(constants, erasing, (0, 0))
        derivations = _derivations(given)
        if not any(row for words in derivations for row in words):
            raise ModelValueError("All these words are empty")
        choices = choices_of(derivations, asked)
        if not choices:
            return StochasticFits(derivations, (), (), asked)
        several = {choice.letter for choice in choices if choice.error}
        productions = [
            Production(
                row_of((choice.letter,)),
                row_of(choice.successor),
                probability=_quotient(choice.probability) if choice.letter in several else None,
            )
            for choice in choices
            if choice.letter in several or choice.successor != (choice.letter,)
        ]
        return StochasticFits(derivations, (system_of(derivations[0][0], productions, asked),), choices, asked)


def _derivations(given: object) -> tuple[tuple[Row, ...], ...]:
    """Several derivations, or one."""
    hint = 'Give each derivation as a list of words: infer([["a", "ab"], ["a", "ba"]], stochastic=True).'
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise ModelValueError(f"Several derivations are needed, not {type(given).__name__}", hint=hint)
    several = [given] if isinstance(given, Derivation) else [*islice(counted(given, 1), MOST_DERIVATIONS + 1)]
    if len(several) > MOST_DERIVATIONS:
        raise ModelLimitError(f"There are more than {MOST_DERIVATIONS:,} derivations", limit=MOST_DERIVATIONS)
    if several and all(isinstance(word, str) for word in several):
        several = [several]
    if not several:
        raise ModelValueError("Several derivations are needed; there are none", hint=hint)
    found = tuple(read_words(words) for words in several)
    if any(GAP in row for words in found for row in words):
        raise ModelValueError(
            "Where letters choose among successors all words must be known", hint="Leave out the unknown ones."
        )
    return found


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


def _fits(
    rows: tuple[Row, ...], found: Sequence[Table], conditions: Conditions, look: Callable[[], None] = check_budget
) -> Fits:
    """The systems for tables; where modules have parameters, those with the fewest, as far as is looked for."""
    rules: list[tuple[Production, ...]] = []
    if conditions.context != (0, 0) or not any(module.arguments for row in rows for module in row):
        rules = [tuple(productions_of(table)) for table in found]
    else:
        with suppress(GivenUp):
            for table in found:
                rules.append(tuple(general_productions(table, look)))
        fewest = min(map(len, rules), default=0)
        rules = [each for each in rules if len(each) == fewest]
    return Fits(rows, tuple(system_of(rows[0], each, conditions) for each in rules), conditions)


def _refusal(rows: tuple[Row, ...], conditions: Conditions) -> Refusal:
    where = contradiction(rows, conditions)
    contexts = Effort(MOST_SEEN_WITH_CONTEXTS)
    if conditions.context != (0, 0):
        return Refusal(where, wider=_wider(rows, conditions, MOST_SUCCESSORS_TRIED, contexts))
    effort = Effort()
    found = mendings(rows, where.step if where else len(rows) - 1, conditions, effort)
    found = [*_with_systems(found[:MOST_MENDINGS_SHOWN], conditions), *found[MOST_MENDINGS_SHOWN:]]
    trials = MOST_TRIED_WITH_MENDINGS if found else MOST_SUCCESSORS_TRIED
    wider = None
    if not found or sum(map(len, rows)) <= MOST_MODULES_WITH_MENDINGS:
        with suppress(ModelLimitError):  # what was found is known all the same
            wider = _wider(rows, conditions, trials, contexts)
    missed = contexts.missed and not found and wider is None
    return Refusal(where, tuple(found), wider, effort.missed and not found, missed)


def _refusal_with_unknown_words(rows: tuple[Row, ...], conditions: Conditions) -> Refusal:
    effort, known = Effort(), [*rows]
    while len(known) > 1 and known[-1] == (GAP,):
        known.pop()
    found = mendings(known, len(known) - 1, conditions, effort)
    return Refusal(None, tuple(_with_systems(found, conditions)), None, effort.missed and not found)


def _with_systems(found: Sequence[Mending], conditions: Conditions) -> Iterator[Mending]:
    """Mendings, each with some of the systems that fit its words."""
    for mending in found:
        some, laws = list[Table](), Effort(MOST_LOOKS_FOR_LAWS // len(found))
        with suppress(GivenUp):
            some += islice(tables(problem_of(mending.words, conditions), Trials(MOST_TRIED_FOR_ONE)), MOST_SHOWN)
        yield replace(mending, systems=_fits(mending.words, some, conditions, partial(laws.read, 1)).systems)


def _wider(rows: tuple[Row, ...], conditions: Conditions, most: int, effort: Effort) -> Wider | None:
    """The first wider conditions under which some system fits; None where there are none, or something is missed."""
    modules, nested = sum(map(len, rows)), all(map(well_nested, rows))
    for erasing in dict.fromkeys((conditions.erasing, True)):
        alone = ((0, 0),) * (erasing is not conditions.erasing)
        for context in (*alone, *CONTEXTS * nested):
            if context[0] >= conditions.context[0] and context[1] >= conditions.context[1]:
                effort.left -= modules
                if effort.left < 0:
                    effort.missed = True
                    return None
                wider = replace(conditions, erasing=erasing, context=context)
                problem = problem_of(rows, wider)
                share = Effort(min(effort.left, MOST_SEEN_FOR_ONE))
                begun = share.left
                if _searched(problem, _has_one, MOST_TRIED_FOR_ONE, share):
                    count = soon_counted(problem, most, effort)
                    return Wider(wider, count.solutions, len(problem.letters), len(count.ways)) if count else Wider(wider, None)
                effort.left -= begun - share.left
                effort.missed |= share.missed
    return None
