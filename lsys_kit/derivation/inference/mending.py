"""Words that are not wholly known, and the fewest edits that make some system fit.

Of a word all may be known, or nothing, or nothing of some stretches; or it is known up to a few edits: a letter is another,
missing or too many, or two neighbours have changed places. In each case the word is one of a regular language, and only what
the words around it allow is written out, letter by letter (string correction: V. I. Levenshtein 1966; R. A. Wagner and M. J.
Fischer 1974). So a wrong letter, a missing step, a step too many and an unknown word are one question. Words with errors are
also those of R. Nakano, Emergent induction of L-system grammar from a string with deletion-type transmutation, 2014.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import islice
from typing import Protocol, TypeAlias

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.problem import FIRST_CHARACTER, GAP, Conditions, Letter, Row, Table, text_of
from lsys_kit.derivation.inference.word_equations import (
    Bounds,
    Equation,
    GivenUp,
    Trials,
    all_put_in,
    deduced,
    first_bounds,
    merged,
    possible_lengths,
    put_in,
    solutions,
)
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.translation import gettext

MOST_READ, MOST_READ_FOR_ONE, A_LOOK = 3_000_000, 200_000, 25
"""So many letters are read at most until edits are out of reach, and so many for one place where they may be; a look at a word
takes as long as reading so many."""
AN_ITEM = 17
"""To look at an item of an equation takes as long as reading so many letters."""
MOST_EDITS = 2
"""So many edits are looked for; beyond, a word is another one."""
MOST_MENDINGS = 200
"""So many ways to mend words are found at most."""


# What is known of a word


class Partly(Protocol):
    """A word that is not wholly known, read letter by letter: what is still possible is its state, None where nothing is."""

    def start(self) -> State: ...
    def after(self, state: State, letter: str) -> State | None: ...
    def next_of(self, state: State, alphabet: Iterable[str]) -> frozenset[str]:
        """The letters that can come next."""
        ...

    def may_end(self, state: State) -> bool: ...


State: TypeAlias = "tuple[tuple[int, int], ...]"
"""Places in a text, each with the number of edits up to it; a place below 0 is between two letters that changed places."""


@dataclass(frozen=True)
class Stretches:
    """A word with stretches of which nothing is known.

    >>> word = Stretches("a?b", "?")
    >>> [is_one_of("".join(each), word) for each in ("ab", "aaab", "ba")]
    [True, True, False]
    """

    text: str
    gap: str

    def start(self) -> State:
        return self._closed([0])

    def after(self, state: State, letter: str) -> State | None:
        here = [place for place, _ in state if place < len(self.text)]
        stays = [place for place in here if self.text[place] == self.gap]
        return self._closed([*stays, *(place + 1 for place in here if self.text[place] == letter != self.gap)]) or None

    def next_of(self, state: State, alphabet: Iterable[str]) -> frozenset[str]:
        return frozenset(letter for letter in alphabet if self.after(state, letter) is not None)

    def may_end(self, state: State) -> bool:
        return (len(self.text), 0) in state

    def _closed(self, places: Iterable[int]) -> State:
        found = set[int]()
        for place in places:
            found.add(place)
            while place < len(self.text) and self.text[place] == self.gap:
                place += 1
                found.add(place)
        return tuple((place, 0) for place in sorted(found))


@dataclass(frozen=True)
class Near:
    """A word that is known up to so many edits.

    >>> word = Near("abc", 1)
    >>> [is_one_of(each, word) for each in ("abc", "adc", "ac", "abbc", "bac", "cab")]
    [True, True, True, True, True, False]
    """

    text: str
    most: int
    _kept: dict[tuple[State, str], State | None] = field(default_factory=dict, compare=False, repr=False)
    """What is behind letters: a word that is tried begins as one that was tried before."""

    def start(self) -> State:
        return self._closed({0: 0})

    def after(self, state: State, letter: str) -> State | None:
        key = state, letter
        if key not in self._kept:
            self._kept[key] = self._after(state, letter)
        return self._kept[key]

    def next_of(self, state: State, alphabet: Iterable[str]) -> frozenset[str]:
        if any(place >= 0 and edits < self.most for place, edits in state):
            return frozenset(alphabet)
        here = (self.text[place : place + 1] if place >= 0 else self.text[-place - 1] for place, _ in state)
        return frozenset(here) & frozenset(alphabet)

    def _after(self, state: State, letter: str) -> State | None:
        found: dict[int, int] = {}
        for place, edits in state:
            if place < 0:  # the second of two letters that changed places
                if self.text[-place - 1] == letter:
                    self._keep(found, 1 - place, edits)
                continue
            self._keep(found, place, edits + 1)
            if place < len(self.text):
                self._keep(found, place + 1, edits + (self.text[place] != letter))
            if place + 1 < len(self.text) and self.text[place + 1] == letter:
                self._keep(found, -place - 1, edits + 1)
        return self._closed(found) or None

    def may_end(self, state: State) -> bool:
        return any(place == len(self.text) for place, _ in state)

    def _keep(self, found: dict[int, int], place: int, edits: int) -> None:
        if edits <= self.most:
            found[place] = min(edits, found.get(place, edits))

    def _closed(self, found: dict[int, int]) -> State:
        for place in sorted(place for place in found if place >= 0):
            edits = found[place]
            for further in range(1, min(self.most - edits, len(self.text) - place) + 1):
                self._keep(found, place + further, edits + further)
        return tuple(sorted(found.items()))


def is_one_of(word: str, partly: Partly) -> bool:
    """Whether a word is one of those that are possible."""
    state = _read(word, partly)
    return state is not None and partly.may_end(state)


def _read(word: str, partly: Partly) -> State | None:
    """The state behind a word; what it has in common with a known text need not be read."""
    state: State | None = partly.start()
    same = 0
    if isinstance(partly, Near):
        same = max(0, _same(word, partly.text) - 2 * partly.most - 1)
        if same:
            state = tuple(
                (same + at, abs(at)) for at in range(-min(same, partly.most), partly.most + 1) if same + at <= len(partly.text)
            )
    elif isinstance(partly, Stretches) and partly.text == partly.gap:
        return state
    for letter in word[same:]:
        if state is None:
            return None
        state = partly.after(state, letter)
    return state


def _same(one: str, other: str) -> int:
    """How many letters two words have in common at the front."""
    if one == other[: len(one)]:
        return len(one)
    return next((at for at, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))


# Words with all their steps


Given: TypeAlias = "str | Partly"
"""A word, known or not."""
BEGINNING = chr(FIRST_CHARACTER - 1)
"""A letter that becomes the axiom, where that is not known."""


@dataclass(frozen=True)
class _Chain:
    """A known word, those after it that are not known, and the next known one, if there is one; and the step of the first."""

    step: int
    first: str
    between: tuple[Partly, ...]
    last: str | None


@dataclass(frozen=True)
class _Stop:
    """Where the words of a chain can be followed no further: at a letter of which it is not known what it becomes; with the
    letters that can come next, None where all can for ever, and whether a known word says which."""

    letter: str
    allowed: frozenset[str] | None
    sure: bool


@dataclass
class Effort:
    """How many more letters a search may read."""

    left: int = MOST_READ
    missed: bool = False
    """Whether something was left out."""

    def read(self, letters: int) -> None:
        check_budget()
        self.left -= letters
        if self.left < 0:
            raise GivenUp


@dataclass(frozen=True)
class Texts:
    """Words as texts with a character for each module."""

    modules: tuple[Module, ...]
    words: tuple[str, ...]
    conditions: Conditions

    @property
    def gap(self) -> str:
        """The character of an unknown stretch."""
        return chr(FIRST_CHARACTER + self.modules.index(GAP)) if GAP in self.modules else ""

    @property
    def given(self) -> list[Given]:
        """What is known of each word."""
        return [Stretches(word, self.gap) if self.gap and self.gap in word else word for word in self.words]

    @cached_property
    def alphabet(self) -> tuple[str, ...]:
        return tuple(chr(FIRST_CHARACTER + number) for number, module in enumerate(self.modules) if module != GAP)

    @cached_property
    def unchanged(self) -> dict[str, str]:
        """The constants, each of which becomes itself."""
        own = zip(self.modules, range(FIRST_CHARACTER, FIRST_CHARACTER + len(self.modules)), strict=True)
        return {chr(code): chr(code) for module, code in own if module.symbol in self.conditions.unchanged}

    def row(self, text: str) -> Row:
        return tuple(self.modules[ord(letter) - FIRST_CHARACTER] for letter in text)


def texts_of(words: Sequence[Row], conditions: Conditions) -> Texts:
    """Words as texts.

    >>> from lsys_kit.derivation.inference.problem import read_words
    >>> [len(word) for word in texts_of(read_words(["a", "ab"]), Conditions()).words]
    [1, 2]
    """
    modules = tuple(dict.fromkeys(module for word in words for module in word))
    codes = {module: chr(FIRST_CHARACTER + number) for number, module in enumerate(modules)}
    return Texts(modules, tuple("".join(codes[module] for module in word) for word in words), conditions)


@dataclass(frozen=True)
class Filled:
    """What letters become, and the words of all steps."""

    successors: dict[str, str]
    words: tuple[str, ...]


def completed(texts: Texts, given: Sequence[Given], effort: Effort) -> Iterator[Filled]:
    """All systems that fit words which are not all known, with the words; `GivenUp` where the search is out of reach."""
    chains, equations = _parts(given)
    some = [put_in(Equation(tuple(_items(texts, one)), other), {}) for one, other in equations]
    effort.read(sum(len(one) + len(other) for one, other in equations))
    if None in some:
        return
    left = tuple(dict.fromkeys(each for each in some if each and each.items))
    longest = max((len(each) for each in given if isinstance(each, str)), default=0) + MOST_EDITS
    longest = max(longest, *(len(word) + MOST_EDITS for word in texts.words))
    bounds = first_bounds([*left, Equation((), "".join(texts.alphabet))], len(texts.modules), texts.conditions.erasing)
    bounds.greatest[:] = longest
    search = _Search(texts, tuple(chains), longest, effort)
    for successors, words in search.completed(left, bounds, texts.unchanged):
        yield Filled(successors, _put_together(given, chains, words))


def _parts(given: Sequence[Given]) -> tuple[list[_Chain], list[tuple[str, str]]]:
    """The chains of words that are not all known, and the pairs of neighbouring words that are."""
    chains, pairs = [], []
    before, step, between = BEGINNING, -1, list[Partly]()
    for at, word in enumerate(given):
        if not isinstance(word, str):
            between.append(word)
            continue
        if between:
            chains.append(_Chain(step, before, tuple(between), word))
        elif step >= 0:
            pairs.append((before, word))
        before, step, between = word, at, []
    if between:
        chains.append(_Chain(step, before, tuple(between), None))
    return chains, pairs


def _put_together(given: Sequence[Given], chains: Sequence[_Chain], words: Sequence[Sequence[str]]) -> tuple[str, ...]:
    found = {chain.step + at: word for chain, own in zip(chains, words, strict=True) for at, word in enumerate(own, 1)}
    return tuple(word if isinstance(word, str) else found[at] for at, word in enumerate(given))


def _items(texts: Texts, word: str) -> list[int | str]:
    unchanged = texts.unchanged
    return merged(letter if letter in unchanged else ord(letter) - FIRST_CHARACTER for letter in word)


@dataclass(frozen=True)
class _Search:
    """A search for what letters become, such that the words of chains can be followed to their ends."""

    texts: Texts
    chains: tuple[_Chain, ...]
    longest: int
    effort: Effort

    def completed(
        self, equations: tuple[Equation, ...], bounds: Bounds, fixed: dict[str, str]
    ) -> Iterator[tuple[dict[str, str], list[list[str]]]]:
        """All that letters may become, with the words of the chains."""
        trials = Trials(items=self.effort.left / AN_ITEM)
        try:
            known = deduced(equations, bounds, trials)
        finally:
            self.effort.left = int(trials.items * AN_ITEM)
        if known is None:
            return
        fixed = fixed | {chr(FIRST_CHARACTER + number): word for number, word in known.successors.items()}
        stops = list[_Stop]()
        words = list[list[str]]()
        for chain in self.chains:
            followed = self._followed(chain, fixed, None)
            if followed is None:
                return
            words.append(followed[0])
            stops += followed[1]
        if not stops:
            for rest in solutions(known.equations, known.bounds, Trials(self.effort.left)):
                yield fixed | {chr(FIRST_CHARACTER + number): word for number, word in rest.items()}, words
            return
        useful = [stop for stop in stops if stop.allowed is not None]
        if not useful:  # nothing later says what the last stretch is
            raise GivenUp
        letter = min(useful, key=lambda stop: not stop.sure).letter
        number = ord(letter) - FIRST_CHARACTER
        for word in self._successors(letter, fixed):
            self.effort.read(A_LOOK)
            if number < 0:
                yield from self.completed(known.equations, known.bounds, fixed | {letter: word})
            elif len(word) in possible_lengths(number, word, known.bounds):
                rest_of = all_put_in(known.equations, {number: word})
                if rest_of is not None:
                    yield from self.completed(rest_of, known.bounds, fixed | {letter: word})

    def _successors(self, letter: str, fixed: dict[str, str]) -> Iterator[str]:
        """The words that a letter may become, as far as the words that it is in can be followed; the shortest first."""
        begun = deque([""])
        while begun:
            text = begun.popleft()
            followed = [self._followed(chain, fixed, (letter, text)) for chain in self.chains]
            if None in followed:
                continue
            if text or self.texts.conditions.erasing or letter == BEGINNING:
                yield text
            stops = [stop for each in followed if each for stop in each[1] if stop.letter == letter]
            allowed = [stop.allowed for stop in stops if stop.allowed is not None]
            if allowed and len(text) < self.longest:
                begun += [text + each for each in sorted(frozenset.intersection(*allowed))]

    def _followed(
        self, chain: _Chain, fixed: dict[str, str], begun: tuple[str, str] | None
    ) -> tuple[list[str], list[_Stop]] | None:
        """The words of a chain as far as they are known, and where they stop; None where they contradict what is given."""
        word, whole, words, stops = chain.first, True, list[str](), list[_Stop]()
        levels: list[Given] = [*chain.between, *([] if chain.last is None else [chain.last])]
        for at, level in enumerate(levels):
            read = next((place for place, letter in enumerate(word) if letter not in fixed), len(word))
            letter = word[read : read + 1]
            part = begun[1] if begun and letter == begun[0] else ""
            made = "".join(map(fixed.__getitem__, word[:read])) + part
            whole = whole and not letter
            self.effort.read(len(made) + A_LOOK)
            allowed: frozenset[str] | None
            if isinstance(level, str):
                least = 0 if self.texts.conditions.erasing else len(word) - read - bool(part)
                if not level.startswith(made) or (whole and level != made) or len(made) + least > len(level):
                    return None
                allowed = frozenset(level[len(made) : len(made) + 1])
            else:
                state = _read(made, level)
                if state is None or (whole and not level.may_end(state)) or len(made) > self.longest:
                    return None
                endless = at == len(levels) - 1 and isinstance(level, Stretches)
                allowed = None if endless or not letter else level.next_of(state, self.texts.alphabet)
            if letter:
                stops.append(_Stop(letter, allowed, isinstance(level, str)))
            words.append(made)
            word = made
        return words, stops


# Edits


@dataclass(frozen=True)
class Slip:
    """Some letters of a word, the first at a place counted from 1, and those in whose place some system fits: one, none where a
    letter is missing or too many, or two."""

    step: int
    place: int
    found: Row
    instead: Row

    def __str__(self) -> str:
        said: dict[str, object] = {"place": self.place, "step": self.step, "found": text_of(self.found)}
        said |= {"before": self.place - 1, "next": self.place + 1, "letter": text_of(self.instead)}
        if not self.found:
            if self.place == 1:
                return gettext("{letter} stood at the beginning of step {step}", **said)
            return gettext("{letter} stood behind letter {before} of step {step}", **said)
        if not self.instead:
            return gettext("letter {place} of step {step}, {found}, were left out", **said)
        if len(self.found) > 1:
            return gettext("letters {place} and {next} of step {step}, {found}, changed places", **said)
        return gettext("letter {place} of step {step}, {found}, were {letter}", **said)


@dataclass(frozen=True)
class OtherWord:
    """A word of a step in whose place some system fits with another; None where the step is one too many, and `missing` where
    the word of that step stands nowhere, so that those from there on are those of one step later."""

    step: int
    instead: Row | None
    missing: bool = False

    def __str__(self) -> str:
        if self.instead is None:
            return gettext("the word of step {step} were left out", step=self.step)
        word = text_of(self.instead)
        if self.missing:
            return gettext(
                "there were a step more between steps {before} and {step}, {word}",
                before=self.step - 1,
                step=self.step,
                word=word,
            )
        return gettext("the word of step {step} were {word}", step=self.step, word=word)


Edit: TypeAlias = "Slip | OtherWord"


@dataclass(frozen=True, repr=False)
class Mending:
    """What is changed in words so that some system fits.

    Attributes
    ----------
    edits
        The changes.
    words
        The words of all steps then.
    systems
        Systems that fit them.
    """

    edits: tuple[Edit, ...]
    words: tuple[Row, ...]
    systems: tuple[LSystem, ...] = ()

    def __str__(self) -> str:
        return gettext(" and ").join(map(str, self.edits))

    __repr__ = __str__


def edits_between(step: int, given: str, wanted: str, texts: Texts) -> tuple[Slip, ...]:
    """The fewest changes of letters that turn a word into another, which is near it.

    >>> from lsys_kit.derivation.inference.problem import read_words
    >>> texts = texts_of(read_words(["abac", "aacd"]), Conditions())
    >>> [str(slip) for slip in edits_between(0, texts.words[0], texts.words[1], texts)]
    ['letter 2 of step 0, b, were left out', 'd stood behind letter 4 of step 0']
    """
    found = next(found for most in range(MOST_EDITS + 1) if (found := _changes(given, wanted, 0, most)) is not None)
    return tuple(Slip(step, place + 1, texts.row(old), texts.row(new)) for place, old, new in found)


def _changes(given: str, wanted: str, at: int, most: int) -> list[tuple[int, str, str]] | None:
    """At most so many changes that turn a word into another, each with its place; None where there are none."""
    same = _same(given, wanted)
    given, wanted, at = given[same:], wanted[same:], at + same
    if not given and not wanted:
        return []
    if not most or abs(len(given) - len(wanted)) > most:
        return None
    ways = [(given[:1], wanted[:1])] if given and wanted else []
    ways += [(given[:2], wanted[:2])] if given[:2] == wanted[1::-1] and len(given) > 1 else []
    ways += [(given[:1], "")] if given else []
    ways += [("", wanted[:1])] if wanted else []
    for old, new in ways:
        rest = _changes(given[len(old) :], wanted[len(new) :], at + len(old), most - 1)
        if rest is not None:
            return [(at, old, new), *rest]
    return None


Tried: TypeAlias = "Callable[[Effort], Iterator[Mending]]"
"""What may be wrong at one place."""


def mendings(words: Sequence[Row], step: int, conditions: Conditions, effort: Effort) -> list[Mending]:
    """The ways to mend words with the fewest edits, where the words up to a step contradict one another: a letter, or a step,
    or two letters, or a whole word.

    >>> from lsys_kit.derivation.inference.problem import read_words
    >>> words = read_words(["a", "ab", "aba", "abbab"])
    >>> [str(mending) for mending in mendings(words, 3, Conditions(), Effort())]
    ['letter 3 of step 3, b, were a']
    """
    texts = texts_of(words, conditions)
    suspects = [at for at in range(min(step, len(words) - 1), -1, -1) if GAP not in words[at]]
    for tried in (_one_edit, _one_step, _two_edits, _other_words):
        with suppress(GivenUp):
            found = {mending.words: mending for mending in islice(_found(tried(texts, suspects), effort), MOST_MENDINGS)}
            if found:
                return [*found.values()]
    return []


def _found(tried: Iterable[Tried], effort: Effort) -> Iterator[Mending]:
    """What is found at all places; at each of them a search may take its share of the effort."""
    for each in tried:
        share = min(effort.left, MOST_READ_FOR_ONE)
        own = Effort(share)
        try:
            yield from each(own)
        except GivenUp:
            effort.missed = True
        effort.read(share - own.left)


def _one_edit(texts: Texts, suspects: Sequence[int]) -> Iterator[Tried]:
    words = texts.words
    yield from (partial(_mended, texts, {at: Near(words[at], 1)}) for at in suspects)


_ANYTHING = Stretches("?", "?")
LEAST_STEPS = 4
"""Of fewer steps none is taken for one too many: what is left would fit too easily."""


def _one_step(texts: Texts, suspects: Sequence[int]) -> Iterator[Tried]:
    last = len(texts.words) - 1
    for at in suspects if last > 1 else ():
        yield from [partial(_with_a_step_more, texts, at)] if at else []
        yield from [partial(_with_a_step_less, texts, at)] if 0 < at < last and last >= LEAST_STEPS else []


def _with_a_step_more(texts: Texts, at: int, effort: Effort) -> Iterator[Mending]:
    for filled in completed(texts, [*texts.given[:at], _ANYTHING, *texts.given[at:]], effort):
        yield Mending((OtherWord(at, texts.row(filled.words[at]), True),), tuple(map(texts.row, filled.words)))


def _with_a_step_less(texts: Texts, at: int, effort: Effort) -> Iterator[Mending]:
    fewer = [*texts.given[:at], *texts.given[at + 1 :]]
    for filled in islice(completed(texts, fewer, effort), 1):
        yield Mending((OtherWord(at, None),), tuple(map(texts.row, filled.words)))


def _two_edits(texts: Texts, suspects: Sequence[int]) -> Iterator[Tried]:
    words = texts.words
    yield from (partial(_mended, texts, {at: Near(words[at], 2)}) for at in suspects)
    known = [at for at, word in enumerate(texts.given) if isinstance(word, str)]
    pairs = ((one, other) for one in suspects for other in known if other > one)
    yield from (partial(_mended, texts, {at: Near(words[at], 1) for at in pair}) for pair in pairs)


def _other_words(texts: Texts, suspects: Sequence[int]) -> Iterator[Tried]:
    yield from (partial(_with_another_word, texts, at) for at in suspects if len(texts.words) > 2)


def _with_another_word(texts: Texts, at: int, effort: Effort) -> Iterator[Mending]:
    for filled in completed(texts, _with(texts, {at: _ANYTHING}), effort):
        yield Mending((OtherWord(at, texts.row(filled.words[at])),), tuple(map(texts.row, filled.words)))


def _mended(texts: Texts, partly: dict[int, Near], effort: Effort) -> Iterator[Mending]:
    for filled in completed(texts, _with(texts, partly), effort):
        each = [edits_between(at, texts.words[at], filled.words[at], texts) for at in sorted(partly)]
        yield Mending(tuple(edit for edits in each for edit in edits), tuple(map(texts.row, filled.words)))


def _with(texts: Texts, partly: Mapping[int, Partly]) -> list[Given]:
    return [partly.get(at, word) for at, word in enumerate(texts.given)]


# Unknown words


def filled_words(words: Sequence[Row], conditions: Conditions, effort: Effort) -> Iterator[tuple[Table, tuple[Row, ...]]]:
    """The systems that fit words with unknown stretches, as tables, each with the words of all steps."""
    texts = texts_of(words, conditions)
    given = texts.given
    while given and isinstance(last := given[-1], Stretches) and last.text == texts.gap:  # of it nothing is known, nor asked
        given.pop()
    for filled in completed(texts, given, effort):
        seen = {letter for word in filled.words[: len(given) - 1] for letter in word} - texts.unchanged.keys()
        table = {
            Letter((), module): texts.row(filled.successors[letter])
            for module, letter in zip(
                texts.modules, map(chr, range(FIRST_CHARACTER, FIRST_CHARACTER + len(texts.modules))), strict=True
            )
            if letter in seen
        }
        yield table, tuple(map(texts.row, filled.words))
