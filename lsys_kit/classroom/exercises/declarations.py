"""The files of exercises: read, with every mistake in them found and placed; one bad file stops no other.

The kit's own files are in the folder `questions`; a teacher's have the same form.
"""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import MISSING, dataclass, fields, replace
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.budget import Task, counted
from lsys_kit.classroom.exercises.asked import ASKED_OF_KIND, MORE_ASKED, is_asked_in_full
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson, Option, Slip
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.classroom.handed_in import content_of
from lsys_kit.classroom.places import line_of, toml_hint
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.files import file_errors, toml_tables
from lsys_kit.notation.analysis.checks import suggestion

# Mistakes and their places


PROBLEMS: Mapping[str, Mapping[str, Sequence[str]]] = toml_tables(__package__, "problems.toml")
"""Each mistake in words, and what to try."""
ADVICE = frozenset(
    {
        "file.untested",
        "exercise.hints",
        "exercise.hint_tells",
        "exercise.no_objective",
        "exercise.no_explanation",
        "exercise.otherwise",
        "exercise.no_misconception",
        "exercise.unit",
        "slips.said_already",
        "slips.yielded",
        "options.no_reply",
    }
)
"""What keeps no exercise from working: it could be better."""
MOST_STEPS = 10_000
"""The last step that a question may ask for."""
_TABLE_LINE = re.compile(r"^\s*\[\[\s*exercise(?:\.(slips|options))?\s*\]\]")


@dataclass(frozen=True)
class Problem:
    """A mistake in a file of exercises, or advice on it: where it is, what is wrong, and what to try.

    >>> print(Problem("01.toml", 12, "1.2", "There is no kind 'wort'", "Did you mean 'word'?"))
    01.toml, line 12, exercise 1.2: There is no kind 'wort'. Did you mean 'word'?
    """

    file: str
    line: int
    exercise: str
    what: str
    hint: str = ""
    advice: bool = False

    def __str__(self) -> str:
        where = f", exercise {self.exercise}" if self.exercise else ""
        said = f"advice: {self.what}" if self.advice else self.what
        return f"{self.file}, line {self.line}{where}: {said}. {self.hint}".rstrip()


@dataclass(frozen=True)
class Source:
    """The text of a file of exercises, in which places are looked up."""

    file: str
    text: str

    def line_of(self, exercise: int, key: str = "", part: str = "", number: int = 0) -> int:
        """The line of a key of an exercise, or of one of its slips or options; all counted from 0.

        >>> Source("a.toml", '[[exercise]]\\nid = "1"\\n[[exercise.slips]]\\nanswer = "2"').line_of(0, "answer", "slips", 0)
        4
        """
        at, inside, first = -1, "", 1
        counts = Counter[str]()
        for line_number, line in enumerate(self.text.splitlines(), 1):
            found = _TABLE_LINE.match(line)
            if found:
                inside = found[1] or ""
                if inside:
                    counts[inside] += 1
                else:
                    at, counts = at + 1, Counter()
            if at == exercise and inside == part and counts[part] == number + bool(part):
                if found:
                    first = line_number
                elif key and re.match(rf"\s*{re.escape(key)}\s*=", line):
                    return line_number
        return first

    def problem(self, name: str, line: int = 1, exercise: str = "", /, **values: object) -> Problem:
        """A mistake that `problems.toml` puts into words."""
        place, _, part = name.partition(".")
        what, hint = PROBLEMS[place][part]
        values["hint"] = values.get("hint") or ""
        return Problem(self.file, line, exercise, what.format(**values), hint.format(**values), name in ADVICE)

    def problem_of(
        self, number: int, exercise: str, key: str, name: str, part: str = "", at: int = 0, /, **values: object
    ) -> Problem:
        """A mistake at a key of an exercise, which has a number in the file."""
        return self.problem(name, self.line_of(number, key, part, at), exercise, **{"key": key, **values})


MakeProblem: TypeAlias = Callable[..., Problem]


# What a key may be


def _is_text(value: object) -> bool:
    return isinstance(value, str)


def _is_count(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def _is_step(value: object) -> bool:
    return isinstance(value, int) and _is_count(value) and value <= MOST_STEPS


def _is_number(value: object) -> bool:
    with suppress(LSystemError):
        return isinstance(value, int | float | str) and not isinstance(value, bool) and number_from(value) is not None
    return False


Fits: TypeAlias = Callable[[object], bool]


def _list_of(fits: Fits) -> Fits:
    return lambda value: isinstance(value, list) and all(map(fits, value))


def _table_of(fits: Fits) -> Fits:
    return lambda value: isinstance(value, dict) and all(map(fits, value.values()))


def _numbers(values: Mapping[str, object]) -> dict[str, object]:
    return {name: number_from(value) for name, value in values.items()}


class Form(NamedTuple):
    """What a key may be, in words, too, and how it is read."""

    fits: Fits
    what: str
    read: Callable[[Any], Any] = lambda value: value


_FORMS: Mapping[str, Form] = {
    "str": Form(_is_text, 'a text, as "..."'),
    "bool": Form(lambda value: isinstance(value, bool), "true or false"),
    "int": Form(_is_step, f"a whole number up to {MOST_STEPS:,}"),
    "Value": Form(_is_number, "a number", number_from),
    "tuple[str, ...]": Form(_list_of(_is_text), 'a list of texts, as ["...", "..."]', tuple),
    "tuple[int, ...]": Form(_list_of(_is_step), f"a list of whole numbers up to {MOST_STEPS:,}", tuple),
    "Mapping[str, Value]": Form(_table_of(_is_number), "a table, as { name = 1 }", _numbers),
    "tuple[Mapping[str, Value], ...]": Form(
        _list_of(_table_of(_is_number)), "a list of tables, as [{ name = 1 }]", lambda values: tuple(map(_numbers, values))
    ),
    "Mapping[str, Sequence[Value]]": Form(
        _table_of(lambda value: bool(value) and _list_of(_is_number)(value)),
        "a table, as { s = [1, 2, 3] }",
        lambda values: {name: tuple(map(number_from, given)) for name, given in values.items()},
    ),
    "tuple[Slip, ...]": Form(
        lambda value: isinstance(value, list), "tables [[exercise.slips]]", lambda slips: tuple(Slip(**each) for each in slips)
    ),
    "tuple[Option, ...]": Form(
        lambda value: isinstance(value, list),
        "tables [[exercise.options]]",
        lambda options: tuple(Option(**each) for each in options),
    ),
}
"""For each type of a key its form."""
KEYS: Mapping[str, Form] = {
    **{key.name: _FORMS[str(key.type)] for key in fields(Exercise)},
    "objective": Form(_is_count, "a whole number"),
}
"""For each key of an exercise what it may be."""
_REQUIRED = tuple(key.name for key in fields(Exercise) if key.default is MISSING and key.default_factory is MISSING)
_NAMED: Mapping[str, Sequence[str]] = {"kind": tuple(ANSWER_KINDS), "names": ("new", "any", "fixed")}
"""Keys whose values are names."""
_TOP: Mapping[str, Form] = {
    "title": Form(_is_text, "a text"),
    "objectives": Form(_list_of(_is_text), "a list of texts"),
    "introduction": Form(_is_text, "a text"),
    "summary": Form(_is_text, "a text"),
}
"""What stands before the exercises."""


# What is wrong with a declaration


def lesson_problems(source: Source, declared: Mapping[str, object]) -> Iterator[Problem]:
    """What is wrong with the top of a file."""
    for key, form in _TOP.items():
        if (key in declared or key == "title") and not form.fits(declared.get(key)):
            yield source.problem("file.top_missing", key=key, what=form.what)
    for key in declared.keys() - {*_TOP, "exercise"}:
        yield source.problem("file.top_unknown", key=quotable(key), hint=suggestion(key, [*_TOP, "exercise"]) or "")
    if not isinstance(declared.get("exercise"), list):
        yield source.problem("file.no_exercises")


def exercise_problems(source: Source, number: int, declared: object) -> Iterator[Problem]:
    """What keeps an exercise from being read."""
    if not isinstance(declared, dict):
        yield source.problem("file.no_table")
        return
    problem = partial(source.problem_of, number, str(declared.get("id", f"number {number + 1}")))
    for key in _REQUIRED:
        if key not in declared:
            yield problem(key, "keys.missing")
    for key, value in declared.items():
        if key not in KEYS:
            yield problem(key, "keys.unknown", key=quotable(key), hint=suggestion(key, KEYS))
        elif not KEYS[key].fits(value):
            yield problem(key, "keys.form", what=KEYS[key].what)
        elif key in _NAMED and value not in _NAMED[key]:
            hint = suggestion(value, _NAMED[key]) or f"Choose: {', '.join(_NAMED[key])}."
            yield problem(key, "keys.unknown_name", name=quotable(value), hint=hint)
        elif key in ("expects", "unlikely"):
            yield from (_unknown(problem, key, each) for each in value if each not in MISCONCEPTIONS)
    yield from _part_problems(problem, declared, "slips", Slip, "answer")
    yield from _part_problems(problem, declared, "options", Option, "text")
    yield from _asked_problems(problem, declared)


def _unknown(problem: MakeProblem, key: str, name: str, *place: object) -> Problem:
    hint = suggestion(name, MISCONCEPTIONS)
    return problem(key, "keys.unknown_misconception", *place, name=quotable(name), hint=hint)


def _asked_problems(problem: MakeProblem, declared: Mapping[str, object]) -> Iterator[Problem]:
    kind, asks = str(declared.get("kind")), str(declared.get("asks", ""))
    asked = ASKED_OF_KIND.get(kind, ())
    if "asks" in declared and (asks.partition(" ")[0] not in asked or not is_asked_in_full(asks)):
        forms = (f'"{MORE_ASKED[each][1]}"' if each in MORE_ASKED else each for each in asked)
        yield problem("asks", "keys.not_asked", asks=quotable(asks), forms=", ".join(forms) or "nothing")
    if "asks" in declared and "system" not in declared:
        yield problem("asks", "keys.asks_what")
    if "at" in declared and kind not in ("table", "words"):
        yield problem("at", "keys.no_at", kind=quotable(kind))


def _part_problems(
    problem: MakeProblem, declared: Mapping[str, object], part: str, record: type, needed: str
) -> Iterator[Problem]:
    known = [each.name for each in fields(record)]
    parts = declared.get(part, ())
    for at, each in enumerate(parts if isinstance(parts, list) else ()):
        if not isinstance(each, dict):
            yield problem("", "keys.tables", key=part)
            continue
        if needed not in each:
            yield problem(needed, "keys.missing", part, at)
        for key, value in each.items():
            fits, what = (isinstance(value, bool), "true or false") if key == "near" else (_is_text(value), "a text")
            if key not in known:
                yield problem(key, "keys.unknown_here", part, at, key=quotable(key), hint=suggestion(key, known))
            elif not fits:
                yield problem(key, "keys.form", part, at, what=what)
            elif key == "misconception" and value not in MISCONCEPTIONS:
                yield _unknown(problem, key, value, part, at)
        if part == "slips" and not (each.get("says") or each.get("misconception")):
            yield problem("answer", "keys.no_reply", part, at)


def read_exercise(declared: Mapping[str, object]) -> Exercise:
    """The exercise that is declared, without mistakes."""
    return Exercise(**{key: KEYS[key].read(value) for key, value in declared.items()})


# Files


QUESTIONS = Path(__file__).parent / "questions"
"""The kit's own files."""
MOST_FILES, MOST_BYTES = 1_000, 1_000_000
"""So many files of exercises are read of a folder, and a file may have so many bytes."""


@dataclass(frozen=True)
class Questions:
    """What a folder of exercises holds: the lessons that can be read, where each exercise stands, and what is wrong."""

    lessons: tuple[Lesson, ...]
    problems: tuple[Problem, ...]
    sources: tuple[tuple[Source, tuple[tuple[int, Exercise], ...]], ...]

    @property
    def exercises(self) -> Iterator[tuple[Source, int, Exercise]]:
        """Each exercise with its file and its number there."""
        for source, found in self.sources:
            yield from ((source, number, exercise) for number, exercise in found)


def questions_folder(folder: str | Path) -> Path:
    """The folder of exercises in the folder of a lesson or a course; any other is itself one of exercises."""
    inside = Path(folder) / "exercises"
    return inside if inside.is_dir() else Path(folder)


def questions_in(folder: Path) -> Questions:
    """The exercises in a folder, with all mistakes in its files.

    Raises
    ------
    ModelFileError
        There is no such folder, or no file of exercises in it.
    """
    with file_errors(f'"{quotable(str(folder))}" cannot be read'):
        found_paths = (path for path in folder.iterdir() if path.suffix == ".toml")
        paths = sorted(islice(found_paths, MOST_FILES + 1))
    if len(paths) > MOST_FILES:
        raise ModelFileError(f'There are more than {MOST_FILES:,} files of exercises in "{quotable(str(folder))}"')
    if not paths:
        raise ModelFileError(f'There are no files of exercises in "{quotable(str(folder))}"', hint="Their names end in .toml.")
    lessons, problems, sources = [], [], []
    for path in paths:
        with Task("The exercises were not read"):
            lesson, exercises, source, wrong = _file(path)
        lessons += [lesson] if lesson else []
        sources.append((source, exercises))
        problems += wrong
    found = Questions(tuple(lessons), tuple(problems), tuple(sources))
    return replace(found, problems=(*problems, *_duplicates(found)))


def _duplicates(found: Questions) -> Iterator[Problem]:
    first: dict[str, str] = {}
    for source, number, exercise in found.exercises:
        where = f"{source.file}, line {source.line_of(number, 'id')}"
        before = first.setdefault(exercise.id, where)
        if before != where:
            yield source.problem_of(number, exercise.id, "id", "keys.twice", id=exercise.id, where=before)


def _file(path: Path) -> tuple[Lesson | None, tuple[tuple[int, Exercise], ...], Source, list[Problem]]:
    source = Source(path.name, "")
    try:
        source = Source(path.name, content_of(path, MOST_BYTES).decode().replace("\r\n", "\n"))
        declared = tomllib.loads(source.text)
    except tomllib.TOMLDecodeError as fault:
        hint = toml_hint(source.text, fault)
        return None, (), source, [source.problem("file.no_toml", line_of(fault), fault=quotable(str(fault)), hint=hint)]
    except ModelFileError as fault:
        return None, (), source, [source.problem("file.unreadable", fault=fault.message)]
    except UnicodeDecodeError as fault:
        return None, (), source, [source.problem("file.no_text", fault=fault)]
    problems = [*counted(lesson_problems(source, declared), 1)]
    exercises: list[tuple[int, Exercise]] = []
    each_declared = declared.get("exercise", ())
    for number, each in enumerate(each_declared if isinstance(each_declared, list) else ()):
        found = [*counted(exercise_problems(source, number, each), 1)]
        problems += found
        if not found:
            exercises.append((number, read_exercise(each)))
    lesson = Lesson(
        path.stem,
        str(declared.get("title", path.stem)),
        tuple(declared.get("objectives", ())),
        str(declared.get("introduction", "")),
        str(declared.get("summary", "")),
        tuple(e for _, e in exercises),
    )
    return lesson, tuple(exercises), source, problems
