"""How a dialect spells what messages quote, and how it words the problems of a model.

Both stand in files `mistakes.toml`: the kit's own in this folder, and one for each dialect, which says what it has otherwise.
They are read when something is to be said.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TypeAlias

from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.files import Entries
from lsys_kit.notation.analysis.problems import Problem, ProblemFound
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Module, Pattern, joined
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS, quoted_dialects
from lsys_kit.translation import gettext

ModelError: TypeAlias = ModelSyntaxError | ModelNameError | ModelValueError
"""What a mistake in the text of a model is."""
_KINDS: Mapping[str, type[ModelError]] = {"syntax": ModelSyntaxError, "name": ModelNameError, "value": ModelValueError}
_NOTHING: Entries = MappingProxyType({})


@dataclass(frozen=True)
class Wording:
    """What a problem is called in a dialect; names in braces are those of the problem's subject and of the dialect's words.

    Attributes
    ----------
    message
        What is wrong, one sentence without its full stop; a whole sentence where the problem is only worth a note.
    hint
        What to try, unless the problem suggests a name.
    error
        The class of the error.
    """

    message: str
    hint: str | None = None
    error: type[ModelError] = ModelSyntaxError


class Spelling:
    """How a dialect spells what messages quote; where it says nothing, as the kit's own notation does.

    Parameters
    ----------
    folder
        Where its file `mistakes.toml` is; None where it has none.
    expression, module, joined
        The text of an expression, of a module, and of several modules.
    words, patterns, wordings
        What is not in the file: words that hints are made of, patterns by the names that stand for them in other patterns, and
        the problems that it words in its own way.
    """

    def __init__(
        self,
        folder: Path | None = None,
        *,
        expression: Callable[[Expression], str] = str,
        module: Callable[[Module | Pattern], str] = str,
        joined: Callable[[Iterable[str]], str] = joined,
        words: Mapping[str, str] = _NOTHING,
        patterns: Mapping[str, str] = _NOTHING,
        wordings: Mapping[str, Wording] = _NOTHING,
    ) -> None:
        self.expression, self.module, self.joined = expression, module, joined
        self._folder, self._words, self._patterns, self._wordings = folder, words, patterns, wordings

    @cached_property
    def tables(self) -> Entries:
        """What its own file says."""
        return tomllib.loads((self._folder / "mistakes.toml").read_text(encoding="utf-8")) if self._folder else {}

    @cached_property
    def words(self) -> Mapping[str, str]:
        """The words that hints are made of, by their names."""
        turtles = {"turtles": quoted_dialects("and"), "turtle_names": ", ".join(TURTLE_DIALECTS)}
        return {**KIT_SPELLING.tables["words"], **turtles, **self.tables.get("words", {}), **self._words}

    @cached_property
    def patterns(self) -> Mapping[str, str]:
        """The patterns that others are made of, by their names."""
        return {**KIT_SPELLING.tables["patterns"], **self.tables.get("patterns", {}), **self._patterns}

    @cached_property
    def wordings(self) -> Mapping[str, Wording]:
        """The problems that it words itself."""
        written = self.tables.get("problems", {}).items()
        found = {code: Wording(row["says"], row.get("hint"), _KINDS[row.get("kind", "syntax")]) for code, row in written}
        return {**found, **self._wordings}

    def wording(self, problem: Problem) -> Wording:
        """What a problem is called."""
        return self.wordings.get(problem.code) or KIT_SPELLING.wordings[problem.code]

    def shown(self, value: object) -> str:
        """A part of a problem's subject, as a message quotes it."""
        if isinstance(value, Number | Name | Apply):
            return self.expression(value)
        if isinstance(value, Pattern):
            return self.module(value)
        if isinstance(value, Production):
            return self.left_side(value)
        return f"{value:,}" if isinstance(value, int) else str(value)

    def left_side(self, rule: Production) -> str:
        """A production's strict predecessor with its contexts."""
        left, own, right = (self.joined(map(self.module, modules)) for modules in (rule.left, rule.predecessors, rule.right))
        return f"{left} < " * bool(left) + own + f" > {right}" * bool(right)


KIT_SPELLING = Spelling(Path(__file__).parent)
"""The kit's own notation."""


def worded(problem: Problem, spelling: Spelling) -> tuple[str, str | None]:
    """The message and the hint for a problem, as a dialect words them.

    >>> worded(Problem("unknown name", subject={"name": "dT", "known": '"dt"'}, suggestion="dt"), KIT_SPELLING)
    ('I do not know the name "dT"', 'Did you mean "dt"?')
    """
    wording = spelling.wording(problem)
    words = {**translated(spelling.words), **{name: spelling.shown(value) for name, value in problem.subject.items()}}
    hint = gettext(wording.hint or "").format(**words)
    if problem.suggestion:
        hint = gettext('Did you mean "{name}"?', name=problem.suggestion)
    return gettext(wording.message).format(**words), hint or None


def translated(words: Mapping[str, str]) -> Mapping[str, str]:
    """The words of messages, in the chosen language."""
    return {name: gettext(word) for name, word in words.items()}


def error_of(problem: Problem, source: str, spelling: Spelling) -> LSystemError:
    """A problem of a text as an error with its place."""
    message, hint = worded(problem, spelling)
    start, end = problem.place or (None, None)
    return spelling.wording(problem).error(message, source, start, end, hint)


@contextmanager
def reporting(source: str, spelling: Spelling = KIT_SPELLING) -> Iterator[None]:
    """Turn a problem that is found in the block into an error, in a dialect's words."""
    try:
        yield
    except ProblemFound as error:
        raise error_of(error.problem, source, spelling) from None


def notes(problems: Iterable[Problem], spelling: Spelling) -> tuple[str, ...]:
    """Problems that are only worth a note, in a dialect's words."""
    return tuple(
        message + (f" {hint}" if problem.suggestion else "")
        for problem in problems
        for message, hint in (worded(problem, spelling),)
    )
