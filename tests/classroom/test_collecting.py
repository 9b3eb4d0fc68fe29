"""Marks of a class: answers are data, one bad notebook costs no other its marks, and nothing outside the folder is read."""

from __future__ import annotations

import csv
import json
import multiprocessing
import os
import re
import socket
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import lsys_kit
from lsys_kit import check, score
from lsys_kit.__main__ import main
from lsys_kit.classroom import child_processes
from lsys_kit.classroom.exercises import collecting
from lsys_kit.classroom.exercises.collecting import COMPUTED, answers_in, collect, marks_table, scores_in
from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.handed_in import handed_in
from lsys_kit.errors import ModelFileError

RIGHT = exercise_of("1.1").solution


def notebook(*sources: object) -> str:
    cells = [
        {"cell_type": "code", "id": f"c{at}", "metadata": {}, "outputs": [], "execution_count": None, "source": source}
        for at, source in enumerate(sources)
    ]
    return json.dumps({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5})


def answered(answer: object, exercise: str = "1.1") -> str:
    return notebook("from lsys_kit import check", f'answer = {answer!r}\ncheck("{exercise}", answer)')


# What is an answer


@pytest.mark.parametrize(
    ("sources", "found"),
    [
        (['answer = "a"\ncheck("1.1", answer)'], {"1.1": "a"}),
        (['check("1.1", 21)'], {"1.1": 21}),
        (["check('1.1', -2.5);"], {"1.1": -2.5}),
        (['answer = ["a", "b"]\ncheck("1.1", answer, hint=1)'], {"1.1": ["a", "b"]}),
        (['answer = (1, (2, -3))\ncheck("1.1", answer)'], {"1.1": [1, [2, -3]]}),
        (['answer = """\na\nb"""\ncheck("1.1", answer)'], {"1.1": "\na\nb"}),
        (['answer = "a"', 'check("1.1", answer)'], {"1.1": "a"}),
        (['mine: str = "a"', 'reply = check(exercise="1.1", answer=mine)\nreply'], {"1.1": "a"}),
        (['answer = "a"\ncheck("1.1", answer)', 'answer = "b"\ncheck("1.1", answer)'], {"1.1": "b"}),
        (['%%time\n!ls\nanswer = "a"\nprint(lsys_kit.check("1.1", answer))'], {"1.1": "a"}),
        ([["answer = 1\n", 'check("1.1", answer)']], {"1.1": 1}),
        (['answer = 42/2\ncheck("1.1", answer)'], {"1.1": "42 / 2"}),
        (['check("1.1", Fraction(1, 3))'], {"1.1": "(1) / (3)"}),
        (['check("1.1", read("axiom: a"))'], {"1.1": "axiom: a"}),
        (['answer = ...\ncheck("1.1", answer)'], {"1.1": ...}),
        (['check("1.1")'], {"1.1": ...}),
        (['check("1.1", unknown)'], {"1.1": COMPUTED}),
        (['answer = __import__("os").getcwd()\ncheck("1.1", answer)'], {"1.1": COMPUTED}),
        (['check("1.1", f"{open(0)}")'], {"1.1": COMPUTED}),
        (['check("1.1", [1, print()])'], {"1.1": COMPUTED}),
        (['check("1.1", b"a")'], {"1.1": COMPUTED}),
        (['a = [1]\nb = [a, a]\ncheck("1.1", b)'], {"1.1": COMPUTED}),
        (['# check("1.1", "a")'], {}),
        (["check(1.1, 'a')"], {}),
        (["check()"], {}),
        (["while True: check"], {}),
        ([None, 5, [1]], {}),
    ],
)
def test_an_answer_is_what_is_written(sources, found):
    assert answers_in(notebook(*sources)).found == found


def test_an_answer_without_its_check_is_found_and_said():
    cells = [
        {"cell_type": "code", "id": f"exercise-1-{number}-answer", "source": source}
        for number, source in enumerate(
            [f"answer = {RIGHT!r}", "answer = ...", 'answer = 1\ncheck("1.3", 2)', "answer = 3", "answer = (("], 1
        )
    ]
    answers = answers_in(
        json.dumps(
            {
                "cells": [
                    *cells,
                    {"cell_type": "code", "source": 'check("1.4", answer)'},
                    {"cell_type": "code", "source": "answer = 5"},
                ]
            }
        )
    )
    assert answers.found == {"1.1": RIGHT, "1.3": 2, "1.4": 3}
    assert answers.problems == [
        "1.5: code cell 5 is no Python, line 1",
        '1.1: the line check("1.1", answer) is missing; it was checked all the same',
        "code cell 7 has an answer and no line check(...), so that nobody knows to which exercise",
    ]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (notebook().encode("utf-16"), "It is written in UTF-16, not in UTF-8"),
        (json.dumps({"worksheets": [{"cells": []}], "nbformat": 3}).encode(), "It is a notebook of version 3 of the format"),
        (b"\x89PNG", "It is no notebook"),
        (b"", "It is no notebook"),
    ],
)
def test_what_is_no_notebook_of_today_is_named(content, said, tmp_path):
    path = tmp_path / "ann.ipynb"
    path.write_bytes(content)
    [problem] = scores_in((path, None))["problems"]
    assert problem.startswith(said)


@pytest.mark.slow
def test_every_file_that_was_handed_in_has_a_row_or_is_named(tmp_path):
    for name in ("ann.ipynb", "bea.zip", "cem.py", "dora/1.ipynb", "dora/photo.docx", "emil/all.zip"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(answered(RIGHT))

    def unread(name: str) -> str:
        return f'It was not read: "{name}" does not end in .ipynb'

    assert {marks.student: marks.remarks for marks in collect(tmp_path)} == {
        "ann": (),
        "bea.zip": (unread("bea.zip"),),
        "cem.py": (unread("cem.py"),),
        "dora": (unread("photo.docx"),),
        "emil": (unread("all.zip"), "There are no files whose names end in .ipynb in this folder"),
    }


@pytest.mark.parametrize(
    "source",
    [
        "answer = (((",
        "answer = " + "(" * 9_000,
        "answer = " + "-" * 15_000 + "1",
        "answer = 'a\0b'",
        "answer = 9" + "9" * 9_000,
        "check(" * 3_000,
        "x=" * 20_001,
        "answer = 08",
    ],
)
def test_a_cell_that_cannot_be_read_costs_no_other_cell(source):
    answers = answers_in(notebook(source, 'check("1.1", "a")'))
    assert answers.found == {"1.1": "a"}
    assert len(answers.problems) == 1
    assert "code cell 1" in answers.problems[0]


@pytest.mark.parametrize(
    "text",
    ["", "{", "[1]", "3", "null", '{"cells": 5}', "[" * 100_000, '{"cells":' * 50_000, json.dumps({"cells": [{}] * 2_001})],
    ids=range(9),
)
def test_what_is_no_notebook_is_said(text):
    with pytest.raises(ModelFileError):
        answers_in(text)


# A class


BOMBS = {
    "right": answered(RIGHT),
    "almost": answered("al al br"),
    "cut off": answered(RIGHT)[:-9],
    "list": "[1]",
    "deep": "[" * 100_000,
    "endless": notebook("while True: pass", f'check("1.1", {RIGHT!r})'),
    "large": " " * 20_000_001,
    "empty": "",
    "malicious": notebook(
        'import os\nos.system("touch {0}")\nanswer = open("{0}", "w")\ncheck("1.1", answer)',
        'check("1.2", exec("open({0!r}, \'w\')"))',
    ),
    "words that grow": answered("F" * 4_999),
    "nested": answered("(" * 4_999),
    "powers": answered("9^9^9^9^9", "1.2"),
    "unknown": answered("a", "no.1"),
}


@pytest.mark.slow
def test_a_class_is_marked_and_nothing_of_it_is_run(tmp_path, capsys):
    folder, victim, table = tmp_path / "in", tmp_path / "victim", tmp_path / "marks.csv"
    folder.mkdir()
    for name, text in BOMBS.items():
        (folder / f"{name}.ipynb").write_text(text.replace("{0}", str(victim)), encoding="utf-8")
    before = sorted(tmp_path.rglob("*"))
    assert main(["collect", str(folder), "-o", str(table)]) == 0
    assert sorted(tmp_path.rglob("*")) == sorted([*before, table])
    rows = {row["student"]: row for row in csv.DictReader(table.read_text("utf-8").splitlines())}
    assert rows.keys() == BOMBS.keys()
    assert (rows["right"]["1.1"], rows["almost"]["score"], rows["endless"]["score"]) == ("1.0", "0.0", "1.0")
    assert [name for name, row in rows.items() if float(row["score"]) > 0] == ["endless", "right"]
    assert [name for name, row in rows.items() if not row["remarks"]] == ["endless", "right"]
    assert "one step too early" in rows["almost"]["remarks"]
    assert "computed" in rows["malicious"]["remarks"]
    assert "no exercise" in rows["unknown"]["remarks"]
    assert f"{len(BOMBS)} students" in capsys.readouterr().out
    assert main(["collect", str(folder), "-o", str(table)]) == 2
    assert "already exists" in capsys.readouterr().err


@pytest.mark.slow
def test_a_student_may_hand_in_a_folder(tmp_path):
    for name, text in {
        "ann/1.ipynb": answered("al"),
        "ann/later/2.ipynb": answered(RIGHT),
        "ann/3.ipynb": answered("34", "1.2"),
        "bob.ipynb": answered(RIGHT),
        "ann/.ipynb_checkpoints/1.ipynb": answered("b", "1.3"),
        "cleo/text.txt": "hello",
        "notes.txt": "not handed in",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    marks = {each.student: each for each in collect(tmp_path)}
    assert [*marks] == ["ann", "bob", "cleo", "notes.txt"]
    assert marks["ann"].scores["1.1"] == marks["bob"].scores["1.1"] == 1
    assert marks["ann"].scores.keys() == {"1.1", "1.2"}
    assert marks["bob"].remarks == ()
    assert "no files" in marks["cleo"].remarks[-1]


@pytest.mark.slow
@pytest.mark.parametrize("forked", [True, False])
def test_exercises_of_ones_own_are_known(forked, tmp_path, monkeypatch):
    if not forked:
        monkeypatch.setattr(child_processes, "_CONTEXT", multiprocessing.get_context("spawn"))
        monkeypatch.setattr(child_processes, "_RUN", 25)
    own = tmp_path / "questions"
    own.mkdir()
    text = (Path(__file__).parent / "questions" / "kinds.toml").read_text("utf-8")
    (own / "kinds.toml").write_text(re.sub(r'(?m)^id = "', 'id = "of-my-own.', text), encoding="utf-8")
    id = re.search(r'id = "(of-my-own[^"]*)"', (own / "kinds.toml").read_text("utf-8"))[1]
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "ann.ipynb").write_text(answered("abaab", id), encoding="utf-8")
    (tmp_path / "in" / "bob.ipynb").write_text(answered(RIGHT), encoding="utf-8")
    assert main(["collect", str(tmp_path / "in"), "-o", str(tmp_path / "marks.csv"), "--exercises", str(own)]) == 0
    rows = [*csv.DictReader((tmp_path / "marks.csv").read_text("utf-8").splitlines())]
    assert 0 <= float(rows[0][id]) < 1
    assert rows[1]["1.1"] == "1.0"


@pytest.mark.slow
def test_where_exercises_are_not_known_it_is_said_what_to_name(tmp_path, capsys):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "ann.ipynb").write_text(answered("a", "ferns.1"))
    assert main(["collect", str(tmp_path / "in"), "-o", str(tmp_path / "marks.csv")]) == 0
    assert "exercises of 1 answer are not known. Name where they are: --course" in capsys.readouterr().err
    (tmp_path / "in" / "ann.ipynb").write_text(answered(RIGHT))
    assert main(["collect", str(tmp_path / "in"), "-o", str(tmp_path / "other.csv")]) == 0
    assert not capsys.readouterr().err


def test_a_folder_without_notebooks_is_said(tmp_path, capsys):
    for folder in (str(tmp_path), str(tmp_path / "missing"), "a\0b"):
        assert main(["collect", folder, "-o", str(tmp_path / "marks.csv")]) == 2
        assert capsys.readouterr().err.startswith("lsys-kit: ")
    assert [*tmp_path.iterdir()] == []


def test_answers_that_take_all_the_time_cost_those_behind_them(tmp_path, monkeypatch):
    path = tmp_path / "a.ipynb"
    path.write_text(answered(RIGHT), encoding="utf-8")
    monkeypatch.setattr(collecting, "SECONDS", -1_000)
    assert "took all the time" in scores_in((path, None))["problems"][0]


def test_a_fault_of_the_kit_costs_one_answer_alone(tmp_path, monkeypatch):
    path = tmp_path / "a.ipynb"
    path.write_text(notebook(f'check("1.1", {RIGHT!r})', 'check("1.2", 33)'), encoding="utf-8")
    usual = collecting.checked
    monkeypatch.setattr(collecting, "checked", lambda asked, *rest: usual(asked, *rest) if asked.id == "1.1" else 1 / 0)
    found = scores_in((path, None))
    assert found["scores"] == {"1.1": 1.0, "1.2": 0.0}
    assert "ZeroDivisionError" in found["replies"]["1.2"]


def test_marks_are_no_checks_of_the_teachers_own(tmp_path):
    path = tmp_path / "a.ipynb"
    path.write_text(answered(RIGHT, "1.1"), encoding="utf-8")
    check("1.1", "al al br")
    assert scores_in((path, None))["scores"] == {"1.1": 1.0}
    assert score("1.1") == 0


# Spreadsheets


@pytest.mark.parametrize(
    "name",
    [
        "=1+1",
        "+1",
        "-1",
        "@SUM(A1)",
        "\t=1",
        "\r=1",
        "=cmd|' /C calc'!A0",
        " =1",
        "＝1",
        "a;=1",
        '"=1',
        '",=1',
        "a\n=1",
        "\u200b=1",
    ],
)
def test_no_cell_is_a_formula(name):
    table = marks_table([collecting.Marks(name, {}, (name, name))])
    for separator in ",;":
        for row in csv.reader(table.splitlines(), delimiter=separator):
            assert not [cell for cell in row if cell.strip("\ufeff \t\r\n\u200b")[:1] in tuple("=+-@＝")]


# Forty names

CURIOUS = [
    "..\\up",
    "..%2fup",
    "%2e%2e",
    "...",
    "-rf",
    "--help",
    "C:\\x",
    "C:x",
    "CON",
    "aux",
    "~root",
    "$(touch victim)",
    "`touch victim`",
    "| touch victim",
    "; touch victim",
    "& touch victim",
    "a\nb",
    "a\r\nb",
    "a\tb",
    "a\x1b[2Jb",
    "a\u202eb",
    "\ud800",
    "\udcff",
    "x" * 240,
    "=cmd|' ",
    "+1",
    "@x",
    "'",
    '"',
    "a,b",
    "<script>alert(1)",
    "%s%n{0}",
    "∕etc∕passwd",
    " ",
    "*",
    "?",
    "a;=1",
]
"""Names of notebooks, without their endings."""


def _links(folder: Path, outside: Path) -> dict[str, Callable[[Path], object]]:
    """What may stand in a folder in place of a notebook."""
    return {
        "link.ipynb": lambda path: path.symlink_to(outside / "secret.ipynb"),
        "far.ipynb": lambda path: path.symlink_to("../../../../../../../../etc/passwd"),
        "up.ipynb": lambda path: path.symlink_to(Path("..") / outside.name / "secret.ipynb"),
        "zero.ipynb": lambda path: path.symlink_to("/dev/zero"),
        "stdin.ipynb": lambda path: path.symlink_to("/dev/stdin"),
        "loop.ipynb": lambda path: path.symlink_to("loop.ipynb"),
        "gone.ipynb": lambda path: path.symlink_to(outside / "no such file"),
        "folder of others": lambda path: path.symlink_to(outside, target_is_directory=True),
        "round": lambda path: path.symlink_to(folder, target_is_directory=True),
        "pipe.ipynb": os.mkfifo,
        "socket.ipynb": _socket,
        "folder.ipynb": Path.mkdir,
        "deeper": lambda path: (path.mkdir(), (path / "out.ipynb").symlink_to(outside / "secret.ipynb")),
    }


def _socket(path: Path) -> None:
    """A socket; the path of one is short, so that it is made in the folder itself."""
    before = os.getcwd()
    os.chdir(path.parent)
    try:
        with socket.socket(socket.AF_UNIX) as made:
            made.bind(path.name)
    finally:
        os.chdir(before)


@pytest.fixture
def hostile(tmp_path: Path) -> tuple[Path, Path, int]:
    """A folder of things with curious names, one beside it, and how many of these could be made here."""
    folder, outside, made = tmp_path / "class", tmp_path / "outside", 0
    folder.mkdir()
    outside.mkdir()
    (outside / "secret.ipynb").write_text(answered(RIGHT), encoding="utf-8")
    for name in CURIOUS:
        try:
            (folder / f"{name}.ipynb").write_text(answered("al al br"), encoding="utf-8")
            made += 1
        except (OSError, ValueError):  # a name that this file system does not know
            assert not name.isascii() or os.name == "nt" or name == "\ud800"
    for name, make in _links(folder, outside).items():
        make(folder / name)
        made += 1
    return folder, outside, made


WATCHED = """
import os, sys
from lsys_kit.__main__ import main

folder, outside, table, log = sys.argv[1:]
noted = os.open(log, os.O_WRONLY)

def look(event, arguments):
    if event not in ("open", "os.listdir", "os.scandir", "os.chmod", "os.remove", "os.rename", "os.link", "os.mkdir"):
        return
    path = arguments[0]
    if not isinstance(path, (str, bytes, os.PathLike)):
        return
    path = os.path.abspath(os.fsdecode(path))
    inside = path == folder or path.startswith(folder + os.sep)
    followed = event == "open" and inside and os.path.islink(path) and not arguments[2] & os.O_NOFOLLOW
    changed = inside and event not in ("open", "os.listdir", "os.scandir")
    if followed or changed or path.startswith((outside, "/dev/zero", "/dev/stdin", "/etc/passwd")):
        os.write(noted, f"{event} {path!r}\\n".encode("utf-8", "replace"))

sys.addaudithook(look)
open(outside + "/noticed", "a").close()
sys.exit(main(["collect", folder, "-o", table]))
"""
"""A program that collects a class, and notes whatever it and its children open that is none of their business."""


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="there are no such names and pipes")
def test_forty_hostile_names_leave_everything_outside_untouched_and_unread(hostile, tmp_path):
    folder, outside, made = hostile
    assert made >= 40
    table, log = tmp_path / "marks.csv", tmp_path / "log"
    os.mkfifo(log)  # to which children may write, who may write no files
    reading = os.open(log, os.O_RDONLY | os.O_NONBLOCK)
    before = {path: (path.lstat().st_mtime_ns, path.lstat().st_size) for path in tmp_path.rglob("*") if path != log}
    done = subprocess.run(
        [sys.executable, "-c", WATCHED, str(folder), str(outside), str(table), str(log)],
        env={**os.environ, "PYTHONPATH": str(Path(lsys_kit.__file__).parent.parent)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=600,
        stdin=subprocess.DEVNULL,
    )
    assert done.returncode == 0, done.stderr
    (outside / "noticed").unlink()
    assert os.read(reading, 100_000).decode().splitlines() == [f"open '{outside}/noticed'"]  # the watch is known to work
    os.close(reading)
    after = {path: (path.lstat().st_mtime_ns, path.lstat().st_size) for path in tmp_path.rglob("*") if path not in (log, table)}
    assert {path: facts for path, facts in after.items() if path != outside} == {
        path: facts for path, facts in before.items() if path != outside
    }
    rows = [*csv.DictReader(table.read_text("utf-8").splitlines())]
    made -= sum(path.name.startswith(".") for path in folder.iterdir())  # files that systems make for themselves
    assert len(rows) == made
    assert {row["score"] for row in rows} == {"0.0"}
    assert sum("one step too early" in row["remarks"] for row in rows) == made - len(_links(folder, outside))
    assert all(row["remarks"] for row in rows)


@pytest.mark.skipif(os.name == "nt", reason="there are no such names and pipes")
def test_what_is_no_plain_file_is_named(hostile):
    folder, outside, _ = hostile
    problems = {each.name: each.problem for each in handed_in(folder, ".ipynb") if each.problem}
    assert problems.keys() == {*_links(folder, outside), "deeper/out.ipynb"} - {"deeper"}
    others = {name for name, problem in problems.items() if "link" not in problem}
    assert others == {"pipe.ipynb", "socket.ipynb", "folder.ipynb"}
