"""The files of exercises: what each key may be, and every mistake found and placed; one bad file stops no other.

The kit's own files are in the folder `questions`; a teacher's have the same form. What a key may be follows from the type of
its field.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.budget import Task, counted
from lsys_kit.classroom.exercises.asked import ASKED_OF_KIND, MORE_ASKED, is_asked_in_full
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson, Option, Slip
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.files import file_errors
from lsys_kit.notation.analysis.checks import suggestion

QUESTIONS = Path(__file__).parent / "questions"
MOST_STEPS = 10_000
"""The last step that a question may ask for."""
_TABLE_LINE = re.compile(r"^\s*\[\[\s*exercise(?:\.(slips|options))?\s*\]\]")
MakeProblem: TypeAlias = Callable[..., "Problem"]


@dataclass(frozen=True)
class Problem:
    """A mistake in a file of exercises: where it is, what is wrong, and what to try.

    >>> print(Problem("01.toml", 12, "1.2", "There is no kind 'wort'", "Did you mean 'word'?"))
    01.toml, line 12, exercise 1.2: There is no kind 'wort'. Did you mean 'word'?
    """

    file: str
    line: int
    exercise: str
    what: str
    hint: str = ""

    def __str__(self) -> str:
        where = f", exercise {self.exercise}" if self.exercise else ""
        return f"{self.file}, line {self.line}{where}: {self.what}. {self.hint}".rstrip()


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
        counts, first, here = {"": -1}, 1, False
        for line_number, line in enumerate(self.text.splitlines(), 1):
            if found := _TABLE_LINE.match(line):
                inside = found[1] or ""
                counts = {**(counts if inside else {}), inside: counts.get(inside, -1) + 1}
                here = inside == part and counts[""] == exercise and (not part or counts[part] == number)
                first = line_number if here else first
            elif here and key and re.match(rf"\s*{re.escape(key)}\s*=", line):
                return line_number
        return first

    def at_top(self, what: str, hint: str | None = None) -> Problem:
        """A mistake that is in no exercise."""
        return Problem(self.file, 1, "", what, hint or "")

    def of(self, number: int, id: str) -> MakeProblem:
        """What makes mistakes of an exercise, given a key, what is wrong, what to try, and perhaps which slip or option."""

        def problem(key: str, what: str, hint: str | None = None, part: str = "", at: int = 0) -> Problem:
            return Problem(self.file, self.line_of(number, key, part, at), id, what, hint or "")

        return problem


# What each key may be


def _is_step(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= MOST_STEPS


def _is_number(value: object) -> bool:
    with suppress(LSystemError):
        return isinstance(value, int | float | str) and not isinstance(value, bool) and number_from(value) is not None
    return False


def _list_of(fits: Callable[[Any], bool]) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, list) and all(map(fits, value))


def _table_of(fits: Callable[[Any], bool]) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, dict) and all(map(fits, value.values()))


class Form(NamedTuple):
    """What a key may be: a test, in words, and how it is read."""

    fits: Callable[[Any], bool]
    what: str
    read: Callable[[Any], Any] = lambda value: value


def _numbers(values: Mapping[str, object]) -> dict[str, Any]:
    return {name: number_from(value) for name, value in values.items()}


_FORMS: Mapping[str, Form] = {
    "str": Form(lambda value: isinstance(value, str), 'a text, as "..."'),
    "tuple[str, ...]": Form(_list_of(lambda value: isinstance(value, str)), 'a list of texts, as ["...", "..."]', tuple),
    "int": Form(_is_step, f"a whole number up to {MOST_STEPS:,}"),
    "tuple[int, ...]": Form(_list_of(_is_step), f"a list of whole numbers up to {MOST_STEPS:,}", tuple),
    "Value": Form(_is_number, "a number", number_from),
    "bool": Form(lambda value: isinstance(value, bool), "true or false"),
    "Mapping[str, Value]": Form(_table_of(_is_number), "a table, as { name = 1 }", _numbers),
    "tuple[Mapping[str, Value], ...]": Form(
        _list_of(_table_of(_is_number)), "a list of tables, as [{ name = 1 }]", lambda value: tuple(map(_numbers, value))
    ),
    "Mapping[str, Sequence[Value]]": Form(
        _table_of(lambda given: bool(given) and _list_of(_is_number)(given)),
        "a table, as { s = [1, 2, 3] }",
        lambda value: {name: tuple(map(number_from, given)) for name, given in value.items()},
    ),
    "tuple[Slip, ...]": Form(
        lambda value: isinstance(value, list), "tables [[exercise.slips]]", lambda value: tuple(Slip(**each) for each in value)
    ),
    "tuple[Option, ...]": Form(
        lambda value: isinstance(value, list),
        "tables [[exercise.options]]",
        lambda value: tuple(Option(**each) for each in value),
    ),
}
"""What a key may be, by the type of its field."""


def _forms(record: Any) -> dict[str, Form]:
    return {part.name: _FORMS[str(part.type)] for part in fields(record) if part.type in _FORMS}


KEYS: Mapping[str, Form] = {
    **_forms(Exercise),
    "objective": Form(lambda value: isinstance(value, int) and not isinstance(value, bool) and value >= 0, "a whole number"),
}
_TOP = {key: form for key, form in _forms(Lesson).items() if key != "name"}
_NAMED: Mapping[str, tuple[str, ...]] = {"kind": tuple(ANSWER_KINDS), "names": ("new", "any", "fixed")}
_OF_MISCONCEPTIONS = ("expects", "unlikely", "misconception")


def lesson_problems(source: Source, declared: Mapping[str, Any]) -> Iterator[Problem]:
    """What is wrong with the top of a file."""
    for key, form in _TOP.items():
        if not form.fits(declared.get(key)):
            what = f'The file needs "{key}", {form.what.partition(", as")[0]}'
            yield source.at_top(what, "It stands at the top, before the first exercise.")
    known = [*_TOP, "exercise"]
    for key in declared.keys() - known:
        yield source.at_top(f'There is no key "{quotable(key)}" at the top', suggestion(key, known))
    if not isinstance(declared.get("exercise"), list):
        yield source.at_top("There are no exercises", "Each begins with a line [[exercise]].")


def exercise_problems(source: Source, number: int, declared: object) -> Iterator[Problem]:
    """What keeps an exercise from being read."""
    if not isinstance(declared, dict):
        yield source.at_top("An exercise is a table", "Begin it with a line [[exercise]].")
        return
    problem = source.of(number, str(declared.get("id", f"number {number + 1}")))
    for wrong in _record_problems(Exercise, KEYS, declared):
        yield problem(*wrong)
    for part, record in (("slips", Slip), ("options", Option)):
        parts = declared.get(part, ())
        for at, each in enumerate(parts if isinstance(parts, list) else ()):
            if not isinstance(each, dict):
                yield problem("", f'"{part}" must be tables', f"Write [[exercise.{part}]].")
                continue
            for wrong in _record_problems(record, _forms(record), each, " here"):
                yield problem(*wrong, part, at)
            if part == "slips" and not (each.get("says") or each.get("misconception")):
                yield problem("answer", "A slip needs a reply", 'Write says = "...", or misconception = "...".', part, at)
    yield from _asked_problems(problem, declared)


def _record_problems(
    record: Any, forms: Mapping[str, Form], declared: Mapping[str, Any], here: str = ""
) -> Iterator[tuple[str, str, str | None]]:
    """What is wrong with the keys of an exercise, a slip or an option: the key, what, and what to try."""
    for part in fields(record):
        if part.default is MISSING and part.default_factory is MISSING and part.name not in declared:
            yield part.name, f'"{part.name}" is missing', f"Write {part.name} = ..."
    for key, value in declared.items():
        if key not in forms:
            yield key, f'There is no key "{quotable(key)}"{here}', suggestion(key, forms)
        elif not forms[key].fits(value):
            what = forms[key].what
            yield key, f'"{key}" must be {what.partition(", as")[0] if here else what}', None
        elif key in _NAMED and value not in _NAMED[key]:
            hint = suggestion(value, _NAMED[key]) or f"Choose: {', '.join(_NAMED[key])}."
            yield key, f'There is no {key} "{quotable(value)}"', hint
        elif key in _OF_MISCONCEPTIONS:
            for unknown in (each for each in ([value] if isinstance(value, str) else value) if each not in MISCONCEPTIONS):
                yield key, f'There is no misconception "{quotable(unknown)}"', suggestion(unknown, MISCONCEPTIONS)


def _asked_problems(problem: MakeProblem, declared: Mapping[str, Any]) -> Iterator[Problem]:
    kind, asks = str(declared.get("kind")), str(declared.get("asks", ""))
    asked = ASKED_OF_KIND.get(kind, ())
    if "asks" in declared and (asks.partition(" ")[0] not in asked or not is_asked_in_full(asks)):
        forms = (f'"{MORE_ASKED[each][1]}"' if each in MORE_ASKED else each for each in asked)
        yield problem("asks", f'This kind cannot ask "{quotable(asks)}"', f"It can ask: {', '.join(forms) or 'nothing'}.")
    if "asks" in declared and "system" not in declared:
        yield problem("asks", '"asks" needs a "system"')
    if "at" in declared and kind not in ("table", "words"):
        yield problem("at", f'The kind "{quotable(kind)}" has no "at"', "Write steps = ..., the step that is asked for.")


# Files


@dataclass(frozen=True)
class Questions:
    """What a folder of exercises holds: its files, each with the lesson and the numbers of the exercises that can be read; and
    what is wrong."""

    files: tuple[tuple[Source, Lesson | None, tuple[int, ...]], ...]
    problems: tuple[Problem, ...]

    @property
    def lessons(self) -> tuple[Lesson, ...]:
        """The lessons that can be read."""
        return tuple(lesson for _, lesson, _ in self.files if lesson)

    @property
    def exercises(self) -> Iterator[tuple[Source, int, Exercise]]:
        """Each exercise with its file and its number there."""
        for source, lesson, numbers in self.files:
            yield from ((source, *each) for each in zip(numbers, lesson.exercises if lesson else (), strict=True))


def questions_in(folder: Path) -> Questions:
    """The exercises in a folder, with all mistakes in its files."""
    with file_errors(f'"{quotable(str(folder))}" cannot be read'):
        paths = sorted(path for path in folder.iterdir() if path.suffix == ".toml")
    if not paths:
        raise ModelFileError(f'There are no files of exercises in "{quotable(str(folder))}"', hint="Their names end in .toml.")
    files, problems = [], list[Problem]()
    for path in paths:
        with Task("The exercises were not read"):
            files.append(_file(path, problems))
    found = Questions(tuple(files), ())
    return Questions(found.files, (*problems, *_duplicates(found)))


def _duplicates(found: Questions) -> Iterator[Problem]:
    first: dict[str, tuple[str, int]] = {}
    for source, number, exercise in found.exercises:
        here = source.file, source.line_of(number, "id")
        file, line = first.setdefault(exercise.id, here)
        if (file, line) != here:
            what = f'The id "{exercise.id}" stands in {file}, line {line} too'
            yield source.of(number, exercise.id)("id", what, "Give one of them another.")


def _file(path: Path, problems: list[Problem]) -> tuple[Source, Lesson | None, tuple[int, ...]]:
    """What is in a file, and the mistakes in it."""
    source = Source(path.name, "")
    try:
        source = Source(path.name, path.read_text(encoding="utf-8"))
        declared = tomllib.loads(source.text)
    except tomllib.TOMLDecodeError as fault:
        line = re.search(r"line (\d+)", str(fault))
        hint = "Is a quotation mark or a bracket missing?"
        problems.append(Problem(path.name, int(line[1]) if line else 1, "", quotable(str(fault)), hint))
        return source, None, ()
    except (OSError, UnicodeDecodeError) as fault:
        problems.append(source.at_top(f"It cannot be read: {fault}", "Save it as UTF-8."))
        return source, None, ()
    problems += counted(lesson_problems(source, declared), 1)
    exercises: dict[int, Exercise] = {}
    given = declared.get("exercise")
    for number, each in enumerate(given if isinstance(given, list) else ()):
        found = [*counted(exercise_problems(source, number, each), 1)]
        problems += found
        if not found:
            exercises[number] = Exercise(**{key: KEYS[key].read(value) for key, value in each.items()})
    top = {key: form.read(declared[key]) for key, form in _TOP.items() if form.fits(declared.get(key))}
    usual = {"title": path.stem, "objectives": (), "introduction": "", "summary": ""}
    return source, Lesson(path.stem, **usual | top, exercises=tuple(exercises.values())), tuple(exercises)
