"""Be the cell: the class is the filament. Each phone is a cell, or some cells, and chooses what becomes of it; when all cells
have, their daughters in a row are the word that the class has made, and beside it stands the right one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass

from lsys_kit.budget import limits
from lsys_kit.classroom.catalogue import entry, system
from lsys_kit.classroom.exercises.asked import beginning_with
from lsys_kit.classroom.exercises.misconceptions.of_steps import context_in_new_word, sequential, words_by
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.explain import ModuleOutcome, explain
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import dialect_named
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.write import as_written
from lsys_kit.translation import gettext

GAMES = ("J1", "P2", "J4", "K16")
"""The systems of the catalogue that are offered: with a polarity, with stages, with life spans, with a signal."""
STEPS, MOST_CELLS, MOST_CHOICES = 12, 60, 4
"""A game is played so many steps at most, and no further than to a word of so many cells; a cell chooses among so many."""
CELLS_A_PHONE = 4
"""A phone is no more cells than this; the kit plays those that nobody is."""
VANISHES = "ε"
SEQUENTIALLY, TOO_LATE = "sequentially", "too late"
"""Other ways of making a step."""


@dataclass(frozen=True)
class Cell:
    """A cell of a word in the game.

    text
        The cell, as it is written.
    choices
        What it may become, as texts; one of them is right.
    right
        The number of that one.
    """

    text: str
    choices: tuple[str, ...]
    right: int


@dataclass(frozen=True)
class Turn:
    """A step of a game: the cells of the old word, the new word, and the words of those who work in another way."""

    cells: tuple[Cell, ...]
    word: tuple[str, ...]
    others: tuple[tuple[str, tuple[str, ...]], ...]


@dataclass(frozen=True)
class Game:
    """A game: what it is played with, its rules as they are written, and its steps."""

    title: str
    rules: str
    turns: tuple[Turn, ...]


def game_of(what: str) -> Game:
    """The game with a system of the catalogue, or with the text of a model.

    Raises
    ------
    LSystemError
        The text cannot be read, or the filament dies, or does not change.

    Examples
    --------
    >>> turn = game_of("J1").turns[1]
    >>> [(cell.text, cell.choices[cell.right]) for cell in turn.cells], turn.word
    ([('al', 'bl ar'), ('br', 'ar')], ('bl', 'ar', 'ar'))
    """
    played = system(what) if what in GAMES else read(what)
    if not isinstance(played, LSystem):
        raise ModelValueError("A game is played with an L-system")
    with limits(modules=10_000, seconds=5):
        turns = tuple(_turns(played))
    if not turns:
        raise ModelValueError("No step of this system can be played", hint=f"A word has 1 to {MOST_CELLS} cells.")
    title = f"{what}: {entry(what).title}" if what in GAMES else "A system of your own"
    rules = "\n".join(as_written(played, production) for production in played.productions)
    return Game(title, rules, turns)


def game_data(game: Game) -> Data:
    """A game as JSON has it.

    >>> game_from(game_data(game_of("K16"))) == game_of("K16")
    True
    """
    return asdict(game)


def game_from(data: Data) -> Game:
    """The game that was written so."""
    turns = (
        Turn(
            tuple(Cell(each["text"], tuple(each["choices"]), each["right"]) for each in turn["cells"]),
            tuple(turn["word"]),
            tuple((way, tuple(word)) for way, word in turn["others"]),
        )
        for turn in data["turns"]
    )
    return Game(data["title"], data["rules"], tuple(turns))


def _turns(played: LSystem) -> Iterator[Turn]:
    derivation, reached = derive(played, 0), 0
    for step in range(1, STEPS + 1):
        try:
            derivation = derive(played, step)
        except LSystemError:
            break
        if not 0 < len(derivation[step - 1]) <= MOST_CELLS:
            break
        reached = step
    told = [explain(derivation, step) for step in range(1, reached + 1)]
    write = dialect_named(played.notation)
    offered = _offered(told, write)
    for step, outcomes in enumerate(told, 1):
        cells = tuple(_cell(each, offered, write) for each in outcomes if not each.others)
        if len(cells) != len(derivation[step - 1]):
            return  # several cells become something together: nobody can be one of them
        yield Turn(cells, _texts(derivation[step], write), tuple(_other_ways(played, derivation[step - 1], write)))


def _texts(word: Sequence[Module], write: Dialect) -> tuple[str, ...]:
    return tuple(write.module(each) for each in word)


def _made(successor: Sequence[Module], write: Dialect) -> str:
    return " ".join(_texts(successor, write)) or VANISHES


def _offered(told: Sequence[Sequence[ModuleOutcome]], write: Dialect) -> list[tuple[str, str]]:
    """What becomes of any cell in the game: each text once, with the symbol of the cell that becomes it."""
    found: dict[str, str] = {}
    for outcomes in told:
        for each in outcomes:
            found.setdefault(_made(each.successor, write), each.module.symbol)
    return [*found.items()]


def _cell(outcome: ModuleOutcome, offered: Sequence[tuple[str, str]], write: Dialect) -> Cell:
    """A cell with its choices: what is right, that it stays, and what becomes of others; those most alike first."""
    own, right = write.module(outcome.module), _made(outcome.successor, write)
    others = sorted(offered, key=lambda each: (each[1] != outcome.module.symbol, " " not in each[0]))
    wanted = list(dict.fromkeys([right, own, *(text for text, _ in others)]))[:MOST_CHOICES]
    choices = tuple(sorted(wanted, key=lambda text: (text == own, text == VANISHES, text)))
    return Cell(own, choices, choices.index(right))


def _other_ways(played: LSystem, before: Sequence[Module], write: Dialect) -> Iterator[tuple[str, tuple[str, ...]]]:
    """What others make of the right word before: one rule after another, or with neighbours that have changed already."""
    beginning, states = beginning_with(played, before), States(played)
    if states.traits.d0l:
        yield SEQUENTIALLY, _texts([*words_by(sequential, beginning, 1)][-1], write)
    elif states.traits.context:
        yield TOO_LATE, _texts([*context_in_new_word(beginning, 1)][-1], write)


def _said(way: str) -> str:
    """What the board calls another way of working."""
    return {SEQUENTIALLY: gettext("one rule after another"), TOO_LATE: gettext("asking the neighbour too late")}[way]


# Who is which cell


def cells_of(seat: int, seats: int, many: int) -> list[int]:
    """The cells of a phone, by its place among those present: every so many-th cell, or one that several are.

    >>> cells_of(1, 3, 7), cells_of(4, 5, 2)
    ([1, 4], [0])
    """
    if seats <= 0:
        return []
    return list(range(seat, many, seats))[:CELLS_A_PHONE] if seat < many else [seat % many]


def made_by(turn: Turn, chosen: Mapping[int, Mapping[int, int]]) -> list[int | None]:
    """What each cell has become, by the number of the choice; what most of its players have chosen, of several the first.

    turn
        The step.
    chosen
        For each cell how often each choice was made.
    """
    return [
        max(sorted(chosen[place]), key=lambda choice: chosen[place][choice]) if chosen.get(place) else None
        for place in range(len(turn.cells))
    ]


def outcome(turn: Turn, made: Sequence[int | None]) -> Data:
    """The word that the class has made beside the right one, cell by cell, and the first place where they part.

    Cells that nobody has played become what is right, and are counted.
    """
    cells: list[Data] = []
    for cell, choice in zip(turn.cells, made, strict=True):
        number = cell.right if choice is None else choice
        cells.append(
            {
                "cell": cell.text,
                "made": cell.choices[number],
                "right": cell.choices[cell.right],
                "fits": number == cell.right,
                "played": choice is not None,
            }
        )
    word = " ".join(each["made"] for each in cells if each["made"] != VANISHES)
    wrong = next((place for place, each in enumerate(cells) if not each["fits"]), None)
    alike = [name for name, other in turn.others if " ".join(other) == word and word != " ".join(turn.word)]
    return {
        "cells": cells,
        "word": word,
        "rightWord": " ".join(turn.word),
        "parts": wrong,
        "unplayed": sum(not each["played"] for each in cells),
        "others": [{"way": _said(name), "word": " ".join(other)} for name, other in turn.others if other != turn.word],
        "like": [_said(name) for name in alike],
    }
