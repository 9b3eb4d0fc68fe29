"""The files of exercises: every mistake is placed and explained, none stops other exercises, and a teacher's folder works."""

import re

import pytest

from lsys_kit import ModelFileError, check, exercises
from lsys_kit.__main__ import main
from lsys_kit.classroom.exercises import registry
from lsys_kit.classroom.exercises.declarations import KEYS, QUESTIONS, questions_in
from lsys_kit.classroom.exercises.lint import problems_in
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from tests.exercise_guide import GUIDE, with_table

GOOD = """\
title = "My lesson"
objectives = ["count"]
introduction = "I."
summary = "S."

[[exercise]]
id = "mine.1"
title = "Count"
kind = "number"
objective = 1
question = "How many?"
system = "axiom: a\\na -> ab\\nb -> a"
asks = "length"
steps = 6
solution = "21"
explanation = "Because."
hints = ["h1", "h2", "h3"]
expects = ["sequential"]

[[exercise.slips]]
answer = "99"
says = "Not that many."
"""


@pytest.fixture(autouse=True)
def no_other_folder(monkeypatch):
    """What a test adds is gone after it."""
    monkeypatch.setattr(registry, "_added", {})


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "good.toml").write_text(GOOD, encoding="utf-8")
    return tmp_path


def test_a_good_file_has_no_problems(folder):
    assert problems_in(folder) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("was", "becomes", "line", "says"),
    [
        ('kind = "number"', 'kind = "nummer"', 9, 'There is no kind "nummer". Did you mean "number"?'),
        ("steps = 6", 'steps = "6"', 14, '"steps" must be a whole number'),
        ("steps = 6", "step = 6", 14, 'There is no key "step". Did you mean "steps"?'),
        ('asks = "length"', 'asks = "matrix"', 13, 'This kind cannot ask "matrix". It can ask: length'),
        (
            'asks = "length"',
            'asks = "first step without s"',
            13,
            'This kind cannot ask "first step without s". It can ask: length, "count a", strokes, "first step past 1000".',
        ),
        ('asks = "length"', 'asks = "first"', 13, 'This kind cannot ask "first"'),
        ('asks = "length"', 'asks = "count"', 13, 'This kind cannot ask "count"'),
        ('asks = "length"', 'asks = "length 3"', 13, 'This kind cannot ask "length 3"'),
        ("steps = 6", "at = [6]", 14, 'The kind "number" has no "at". Write steps = ...'),
        ("steps = 6", "steps = 10001", 14, '"steps" must be a whole number up to 10,000'),
        ("steps = 6", "steps = 0", 15, "The system gives another answer: 1."),
        ('a -> ab\\nb -> a"', 'a -> aaaaaa"\nconstants = { a = "1/0" }', 13, '"constants" must be a table'),
        (
            'a -> ab\\nb -> a"\nasks = "length"\nsteps = 6',
            'a -> aaaaaa"\nasks = "length"\nsteps = 9999',
            15,
            "The system gives another answer: a number too long to write down",
        ),
        ('solution = "21"', 'solution = "21"\ntolerance = "s"', 16, '"tolerance" must be a number'),
        ('solution = "21"', 'solution = "21"\npicture = "axiom: F("', 16, '"picture" cannot be read'),
        ('solution = "21"', 'solution = "22"', 15, "The system gives another answer: 21"),
        ('solution = "21"', 'solution = "many"', 15, '"solution" cannot be read'),
        ('solution = "21"\n', "", 6, '"solution" is missing'),
        ('"h1", "h2", "h3"', '"h1", "h2"', 17, "There are 2 hints"),
        ('"h1", "h2", "h3"', '"h1", "it is 21", "h3"', 17, "A hint contains the solution"),
        (
            'expects = ["sequential"]',
            'expects = ["seqential"]',
            18,
            'There is no misconception "seqential". Did you mean "sequential"?',
        ),
        ('expects = ["sequential"]', 'expects = ["rows and columns"]', 18, '"rows and columns" yields no wrong answer here'),
        ('answer = "99"', 'answer = "21"', 21, "The slip is right"),
        ('answer = "99"', 'answer = "((("', 21, "The slip cannot be read"),
        ('answer = "99"', 'answer = "64"', 21, 'Write misconception = "'),
        ('answer = "99"', 'anser = "99"', 21, 'There is no key "anser" here. Did you mean "answer"?'),
        ('says = "Not that many."', "", 21, "A slip needs a reply"),
        ("objective = 1", "objective = 3", 10, "There is no objective 3"),
        ('title = "My lesson"\n', "", 1, 'The file needs "title"'),
        ('id = "mine.1"', 'id = "1.1"', 7, "The kit has an exercise with this id"),
        ('system = "axiom: a\\na -> ab\\nb -> a"', 'system = "XX99"', 12, 'The catalogue has no system "XX99"'),
        ('title = "Count"', 'title = "Count', 8, "Is a quotation mark or a bracket missing?"),
    ],
)
def test_a_mistake_is_told_with_file_line_and_what_to_try(folder, was, becomes, line, says):
    assert was in GOOD
    (folder / "good.toml").write_text(GOOD.replace(was, becomes), encoding="utf-8")
    found = [str(problem) for problem in problems_in(folder)]
    assert any(says in problem and f"good.toml, line {line}" in problem for problem in found), found


def test_names_that_a_net_must_have_are_places_of_its_solution(folder):
    text = GOOD[: GOOD.index("[[exercise.slips]]")]
    for was, becomes in (
        ('"number"', '"net"'),
        ('system = "axiom: a\\na -> ab\\nb -> a"\nasks = "length"\nsteps = 6\n', 'symbols = ["S", "M"]\n'),
        ('"21"', '"S -> L\\nL -> L + S"'),
        ('["sequential"]', '["one daughter"]'),
    ):
        assert was in text
        text = text.replace(was, becomes)
    (folder / "good.toml").write_text(text, encoding="utf-8")
    assert "The solution has no place with one of these names" in str(problems_in(folder))
    (folder / "good.toml").write_text(text.replace('"M"]', '"L"]'), encoding="utf-8")
    assert problems_in(folder) == []


@pytest.mark.parametrize(
    ("successor", "solution", "said"),
    [("ab", "abaab", []), ("a[b]", "a[b][a][a[b]]", ['"word reversed" yields no wrong answer here'])],
)
def test_a_word_with_brackets_is_not_read_backwards(folder, successor, solution, said):
    text = GOOD[: GOOD.index("[[exercise.slips]]")]
    for was, becomes in (
        ('"number"', '"word"'),
        ('asks = "length"\nsteps = 6', "steps = 3"),
        ('["sequential"]', '["word reversed"]'),
        ("a -> ab", f"a -> {successor}"),
        ('"21"', f'"{solution}"'),
    ):
        assert was in text
        text = text.replace(was, becomes)
    (folder / "good.toml").write_text(text, encoding="utf-8")
    assert [problem.what for problem in problems_in(folder)] == said


@pytest.mark.parametrize(
    ("solution", "said"),
    [
        ("21", '"21" is a number, and a whole production is needed'),
        ("s < 5", '"s < 5" is a condition, and a whole production is needed'),
        ("a b", "An arrow is missing here"),
    ],
)
def test_a_solution_that_is_part_of_a_production_is_told(folder, solution, said):
    text = GOOD[: GOOD.index("[[exercise.slips]]")]
    for was, becomes in (
        ('"number"', '"system"'),
        ('system = "axiom: a\\na -> ab\\nb -> a"\nasks = "length"\n', ""),
        ('"21"', f'"{solution}"'),
    ):
        assert was in text
        text = text.replace(was, becomes)
    (folder / "good.toml").write_text(text, encoding="utf-8")
    (problem,) = problems_in(folder)
    assert problem.what == f'"solution" cannot be read: {said}'


def test_a_duplicate_id_is_an_error_that_names_both_places(folder):
    (folder / "other.toml").write_text(GOOD.replace("mine.1", "mine.1"), encoding="utf-8")
    assert [str(problem) for problem in problems_in(folder)] == [
        'other.toml, line 7, exercise mine.1: The id "mine.1" stands in good.toml, line 7 too. Give one of them another.'
    ]


def test_a_bad_file_stops_no_other_exercise(folder):
    (folder / "bad.toml").write_text("title = [", encoding="utf-8")
    (folder / "worse.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(ModelFileError, match=r"bad\.toml, line 1"):
        exercises(folder)
    assert check("mine.1", 21) == check(exercises()[0].id, exercises()[0].solution) == 1
    assert {problem.file for problem in problems_in(folder)} == {"bad.toml", "worse.toml"}


def test_an_exercise_with_a_mistake_stops_no_other_in_its_file(folder):
    second = GOOD[GOOD.index("[[exercise]]") :].replace("mine.1", "mine.2").replace("steps = 6", 'steps = "six"')
    (folder / "good.toml").write_text(f"{GOOD}\n{second}", encoding="utf-8")
    with pytest.raises(ModelFileError, match=r"mine\.2"):
        exercises(folder)
    assert check("mine.1", 21) == 1
    with pytest.raises(ModelFileError, match=r'Exercise "mine\.2" cannot be used.*"steps" must be a whole number'):
        check("mine.2", 21)


def test_an_unreadable_slip_is_reported_to_the_teacher_and_not_to_the_student(folder):
    (folder / "good.toml").write_text(GOOD.replace('answer = "99"', 'answer = "((("'), encoding="utf-8")
    exercises(folder)
    assert check("mine.1", 98).said == "Not yet"


def test_a_folder_of_ones_own_works_like_the_kits(folder):
    assert [exercise.id for exercise in exercises(folder)] == ["mine.1"]
    assert repr(exercises(folder)) == "mine.1   Count"
    assert check("mine.1", "21") == 1
    assert check("mine.1", 99).message == "Not that many."
    (folder / "good.toml").write_text(GOOD.replace("Not that many.", "Fewer."), encoding="utf-8")
    exercises(folder)
    assert check("mine.1", 99).message == "Fewer."


@pytest.mark.parametrize("where", ["no such folder", "empty"])
def test_a_folder_without_exercises_is_refused(tmp_path, where):
    (tmp_path / "empty").mkdir()
    with pytest.raises(ModelFileError):
        exercises(tmp_path / where)


def test_the_command_lists_all_mistakes(folder, capsys):
    assert main(["exercises", "check", str(folder)]) == 0
    assert capsys.readouterr().out == "No mistakes.\n"
    (folder / "good.toml").write_text(GOOD.replace("steps = 6", "step = 6").replace('"h3"', '"h3", "h4"'), encoding="utf-8")
    assert main(["exercises", "check", str(folder)]) == 2
    out, error = capsys.readouterr()
    assert out.count("good.toml, line ") == error.count("mistake") + out.count("\n") - 1
    assert "mistake" in error


def test_the_command_writes_notebooks_that_add_the_folder(folder, tmp_path, capsys):
    (tmp_path / "made").mkdir()
    assert main(["exercises", "notebooks", str(folder), "-o", str(tmp_path / "made")]) == 0
    text = (tmp_path / "made" / "good.ipynb").read_text(encoding="utf-8")
    assert "exercises(" in text
    assert 'check(\\"mine.1\\", answer)' in text


# The guide


def test_the_guide_lists_every_misconception():
    assert GUIDE.read_text(encoding="utf-8") == with_table(GUIDE.read_text(encoding="utf-8"))


EXAMPLES = re.findall(r"```toml\n(kind = .*?)```", GUIDE.read_text(encoding="utf-8"), re.DOTALL)
TOP = 'title = "t"\nobjectives = ["o"]\nintroduction = "i"\nsummary = "s"\n[[exercise]]\n'
COMMON = 'id = "g.1"\ntitle = "t"\nquestion = "?"\nexplanation = "e"\nhints = ["x", "y", "z"]\nobjective = 1\n'
ODD = (
    '""',
    '"s"',
    '"first"',
    '"count "',
    '"lengths 3"',
    '"\\u0000"',
    '"((("',
    '"1/0"',
    "-1",
    "0",
    "1.5",
    "inf",
    "nan",
    "10000",
    "99999999999999999999999",
    "[]",
    "[1]",
    "[-1]",
    '["s"]',
    "[[]]",
    "{}",
    "{ a = 1 }",
    '{ a = "1/0" }',
    '{ a = ["x"] }',
    "[{}]",
    '[{ a = "x" }]',
    "true",
    "1979-05-27",
    '"J1"',
    '"axiom: a"',
)


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES)
def test_the_examples_of_the_guide_are_read(tmp_path, example):
    (tmp_path / "guide.toml").write_text(TOP + COMMON + example, encoding="utf-8")
    assert [str(problem) for problem in problems_in(tmp_path)] == []


def test_the_guide_has_an_example_of_each_form():
    assert len(EXAMPLES) == 10


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES)
def test_no_value_of_any_key_stops_the_check(tmp_path, example):
    head, *tables = (COMMON + example).split("[[", 1)
    for key in KEYS:
        others = "".join(line for line in head.splitlines(keepends=True) if not line.startswith(f"{key} ="))
        for value in ODD:
            rest = "".join(f"[[{each}" for each in tables if not each.startswith(f"exercise.{key}"))
            (tmp_path / "odd.toml").write_text(f"{TOP}{key} = {value}\n{others}{rest}", encoding="utf-8")
            assert all(problem.file == "odd.toml" and problem.line for problem in problems_in(tmp_path)), (key, value)


def test_every_misconception_is_a_clause_and_a_sentence():
    for misconception in MISCONCEPTIONS.values():
        assert misconception.do[0].islower() or misconception.do[0] in "+<="
        assert misconception.do[-1] not in ".?"
        assert misconception.but[-1] in ".?"
        assert misconception.applies


def test_the_kits_files_can_be_read():
    assert questions_in(QUESTIONS).problems == ()
