"""The files of exercises: read, with every mistake in them found and placed; one bad file stops no other.

The kit's own files are in the folder `questions`; a teacher's have the same form.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import Any

from lsys_kit.budget import Task, counted
from lsys_kit.classroom.exercises.asked import ASKED_OF_KIND, MORE_ASKED, is_asked_in_full
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson, Option, Slip
from lsys_kit.classroom.exercises.kinds.table import ANSWER_KINDS
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.notation.analysis.checks import suggestion

MOST_STEPS = 10_000
"""The last step that a question may ask for."""
_TABLE_LINE = re.compile(r"^\s*\[\[\s*exercise(?:\.(slips|options))?\s*\]\]")


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
        at, inside, counts, first = -1, "", {"slips": -1, "options": -1}, 1
        for line_number, line in enumerate(self.text.splitlines(), 1):
            found = _TABLE_LINE.match(line)
            if found:
                inside = found[1] or ""
                if inside:
                    counts[inside] += 1
                else:
                    at, counts = at + 1, {"slips": -1, "options": -1}
                if at == exercise and inside == part and (not part or counts[part] == number):
                    first = line_number
            elif (
                at == exercise
                and inside == part
                and (not part or counts[part] == number)
                and key
                and re.match(rf"\s*{re.escape(key)}\s*=", line)
            ):
                return line_number
        return first


def _is_text(value: object) -> bool:
    return isinstance(value, str)


def _is_texts(value: object) -> bool:
    return isinstance(value, list) and all(map(_is_text, value))


def _is_count(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def _is_step(value: object) -> bool:
    return isinstance(value, int) and _is_count(value) and value <= MOST_STEPS


def _is_number(value: object) -> bool:
    with suppress(LSystemError):
        return isinstance(value, int | float | str) and not isinstance(value, bool) and number_from(value) is not None
    return False


def _is_values(value: object) -> bool:
    return isinstance(value, dict) and all(map(_is_number, value.values()))


KEYS: Mapping[str, tuple[Callable[[object], bool], str]] = {
    **dict.fromkeys(
        (
            "id",
            "title",
            "kind",
            "question",
            "solution",
            "explanation",
            "otherwise",
            "template",
            "system",
            "asks",
            "text",
            "unit",
            "given",
            "names",
        ),
        (_is_text, 'a text, as "..."'),
    ),
    **dict.fromkeys(("hints", "expects", "unlikely", "symbols", "probes"), (_is_texts, 'a list of texts, as ["...", "..."]')),
    "objective": (_is_count, "a whole number"),
    "steps": (_is_step, f"a whole number up to {MOST_STEPS:,}"),
    "at": (
        lambda value: isinstance(value, list) and all(map(_is_step, value)),
        f"a list of whole numbers up to {MOST_STEPS:,}",
    ),
    "tolerance": (_is_number, "a number"),
    "drawn": (lambda value: isinstance(value, bool), "true or false"),
    "constants": (_is_values, "a table, as { name = 1 }"),
    "settings": (lambda value: isinstance(value, list) and all(map(_is_values, value)), "a list of tables, as [{ name = 1 }]"),
    "values": (
        lambda value: (
            isinstance(value, dict)
            and all(isinstance(given, list) and given and all(map(_is_number, given)) for given in value.values())
        ),
        "a table, as { s = [1, 2, 3] }",
    ),
    "slips": (lambda value: isinstance(value, list), "tables [[exercise.slips]]"),
    "options": (lambda value: isinstance(value, list), "tables [[exercise.options]]"),
}
"""For each key of an exercise what it may be."""
_REQUIRED = tuple(part.name for part in fields(Exercise) if part.default is MISSING and part.default_factory is MISSING)
_NAMED: Mapping[str, Sequence[str]] = {"kind": tuple(ANSWER_KINDS), "names": ("new", "any", "fixed")}
"""Keys whose values are names."""


def lesson_problems(source: Source, declared: Mapping[str, Any]) -> Iterator[Problem]:
    """What is wrong with the top of a file."""
    for key, fits, what in (
        ("title", _is_text, "a text"),
        ("objectives", _is_texts, "a list of texts"),
        ("introduction", _is_text, "a text"),
        ("summary", _is_text, "a text"),
    ):
        if not fits(declared.get(key)):
            yield Problem(
                source.file, 1, "", f'The file needs "{key}", {what}', "It stands at the top, before the first exercise."
            )
    for key in declared.keys() - {"title", "objectives", "introduction", "summary", "exercise"}:
        yield Problem(
            source.file,
            1,
            "",
            f'There is no key "{quotable(key)}" at the top',
            suggestion(key, ["title", "objectives", "introduction", "summary", "exercise"]) or "",
        )
    if not isinstance(declared.get("exercise"), list):
        yield Problem(source.file, 1, "", "There are no exercises", "Each begins with a line [[exercise]].")


def exercise_problems(source: Source, number: int, declared: object) -> Iterator[Problem]:
    """What keeps an exercise from being read."""
    if not isinstance(declared, dict):
        yield Problem(source.file, 1, "", "An exercise is a table", "Begin it with a line [[exercise]].")
        return
    name = str(declared.get("id", f"number {number + 1}"))

    def problem(key: str, what: str, hint: str | None = "", part: str = "", at: int = 0) -> Problem:
        return Problem(source.file, source.line_of(number, key, part, at), name, what, hint or "")

    for key in _REQUIRED:
        if key not in declared:
            yield problem(key, f'"{key}" is missing', f"Write {key} = ...")
    for key, value in declared.items():
        if key not in KEYS:
            yield problem(key, f'There is no key "{quotable(key)}"', suggestion(key, KEYS))
        elif not KEYS[key][0](value):
            yield problem(key, f'"{key}" must be {KEYS[key][1]}')
        elif key in _NAMED and value not in _NAMED[key]:
            yield problem(
                key,
                f'There is no {key} "{quotable(value)}"',
                suggestion(value, _NAMED[key]) or f"Choose: {', '.join(_NAMED[key])}.",
            )
        elif key in ("expects", "unlikely"):
            for unknown in (each for each in value if each not in MISCONCEPTIONS):
                yield problem(key, f'There is no misconception "{quotable(unknown)}"', suggestion(unknown, MISCONCEPTIONS))
    yield from _part_problems(problem, declared, "slips", Slip, ("answer",))
    yield from _part_problems(problem, declared, "options", Option, ("text",))
    yield from _asked_problems(problem, declared)


def _asked_problems(problem: Callable[..., Problem], declared: Mapping[str, Any]) -> Iterator[Problem]:
    kind, asks = str(declared.get("kind")), str(declared.get("asks", ""))
    asked = ASKED_OF_KIND.get(kind, ())
    if "asks" in declared and (asks.partition(" ")[0] not in asked or not is_asked_in_full(asks)):
        forms = (f'"{MORE_ASKED[each][1]}"' if each in MORE_ASKED else each for each in asked)
        yield problem("asks", f'This kind cannot ask "{quotable(asks)}"', f"It can ask: {', '.join(forms) or 'nothing'}.")
    if "asks" in declared and "system" not in declared:
        yield problem("asks", '"asks" needs a "system"')
    if "at" in declared and kind not in ("table", "words"):
        yield problem("at", f'The kind "{quotable(kind)}" has no "at"', "Write steps = ..., the step that is asked for.")


def _part_problems(
    problem: Callable[..., Problem], declared: Mapping[str, Any], part: str, record: type, needed: Sequence[str]
) -> Iterator[Problem]:
    known = [each.name for each in fields(record)]
    parts = declared.get(part, ())
    for at, each in enumerate(parts if isinstance(parts, list) else ()):
        if not isinstance(each, dict):
            yield problem("", f'"{part}" must be tables', f"Write [[exercise.{part}]].", "", 0)
            continue
        for key in needed:
            if key not in each:
                yield problem(key, f'"{key}" is missing', f"Write {key} = ...", part, at)
        for key, value in each.items():
            if key not in known:
                yield problem(key, f'There is no key "{quotable(key)}" here', suggestion(key, known), part, at)
            elif not (isinstance(value, bool) if key == "near" else _is_text(value)):
                yield problem(key, f'"{key}" must be {"true or false" if key == "near" else "a text"}', "", part, at)
            elif key == "misconception" and value not in MISCONCEPTIONS:
                yield problem(
                    key, f'There is no misconception "{quotable(value)}"', suggestion(value, MISCONCEPTIONS), part, at
                )
        if part == "slips" and not (each.get("says") or each.get("misconception")):
            yield problem("answer", "A slip needs a reply", 'Write says = "...", or misconception = "...".', part, at)


def read_exercise(declared: Mapping[str, Any]) -> Exercise:
    """The exercise that is declared, without mistakes."""
    changes: dict[str, Any] = {
        key: tuple(declared[key]) for key in ("hints", "expects", "unlikely", "symbols", "probes", "at") if key in declared
    }
    changes["slips"] = tuple(Slip(**slip) for slip in declared.get("slips", ()))
    changes["options"] = tuple(Option(**option) for option in declared.get("options", ()))
    changes["values"] = {name: tuple(map(number_from, given)) for name, given in declared.get("values", {}).items()}
    changes["constants"] = _numbers(declared.get("constants", {}))
    changes["settings"] = tuple(map(_numbers, declared.get("settings", ())))
    changes["tolerance"] = number_from(declared.get("tolerance", 0))
    return Exercise(**{**declared, **changes})


def _numbers(values: Mapping[str, object]) -> dict[str, Any]:
    return {name: number_from(value) for name, value in values.items()}


QUESTIONS = Path(__file__).parent / "questions"
"""The kit's own files."""


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


def questions_in(folder: Path) -> Questions:
    """The exercises in a folder, with all mistakes in its files.

    Raises
    ------
    ModelFileError
        There is no such folder, or no file of exercises in it.
    """
    try:
        files = sorted(path for path in folder.iterdir() if path.suffix == ".toml")
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{quotable(str(folder))}" cannot be read: {getattr(fault, "strerror", None) or fault}') from None
    if not files:
        raise ModelFileError(f'There are no files of exercises in "{quotable(str(folder))}"', hint="Their names end in .toml.")
    lessons, problems, sources = [], [], []
    for path in files:
        with Task("The exercises were not read"):
            lesson, exercises, source, wrong = _file(path)
        lessons += [lesson] if lesson else []
        sources.append((source, exercises))
        problems += wrong
    found = Questions(tuple(lessons), tuple(problems), tuple(sources))
    return Questions(found.lessons, (*found.problems, *_duplicates(found)), found.sources)


def _duplicates(found: Questions) -> Iterator[Problem]:
    first: dict[str, tuple[str, int]] = {}
    for source, number, exercise in found.exercises:
        line = source.line_of(number, "id")
        if exercise.id in first:
            file, before = first[exercise.id]
            yield Problem(
                source.file,
                line,
                exercise.id,
                f'The id "{exercise.id}" stands in {file}, line {before} too',
                "Give one of them another.",
            )
        else:
            first[exercise.id] = source.file, line


def _file(path: Path) -> tuple[Lesson | None, tuple[tuple[int, Exercise], ...], Source, list[Problem]]:
    try:
        source = Source(path.name, path.read_text(encoding="utf-8"))
        declared = tomllib.loads(source.text)
    except tomllib.TOMLDecodeError as fault:
        line = re.search(r"line (\d+)", str(fault))
        return (
            None,
            (),
            source,
            [
                Problem(
                    path.name,
                    int(line[1]) if line else 1,
                    "",
                    quotable(str(fault)),
                    "Is a quotation mark or a bracket missing?",
                )
            ],
        )
    except (OSError, UnicodeDecodeError) as fault:
        return None, (), Source(path.name, ""), [Problem(path.name, 1, "", f"It cannot be read: {fault}", "Save it as UTF-8.")]
    problems = [*counted(lesson_problems(source, declared), 1)]
    exercises: list[tuple[int, Exercise]] = []
    for number, each in enumerate(declared.get("exercise", ()) if isinstance(declared.get("exercise", ()), list) else ()):
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
