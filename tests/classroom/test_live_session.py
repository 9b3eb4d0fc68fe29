"""A class is a fold of what was said: kept once, in order, and seen alike by boards, reports and servers that start again."""

from __future__ import annotations

import csv
import io
import re
import sqlite3
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelFileError, ModelNameError, language
from lsys_kit.__main__ import main
from lsys_kit.classroom.lessons.lesson import lesson
from lsys_kit.classroom.live import serving
from lsys_kit.classroom.live.events import FILE, LETTERS, TEACHER, ClassEntry, Event, Events, NotKept
from lsys_kit.classroom.live.game import GAMES, cells_of, game_data, game_of, made_by, outcome
from lsys_kit.classroom.live.questions import asked_of, named, predictions, question, questions, right_option, value_of
from lsys_kit.classroom.live.report import report_page, report_table, write_reports
from lsys_kit.classroom.live.session import CLOSED, GAME, VOTE, Asked, Session, changes
from tests.test_hostile_names import HOSTILE


def vote(phone: str, sent: int, value: int, round: int = 1, about: str = "01") -> Event:
    return Event("ABCD", phone, sent, VOTE, about, round, value)


def teacher(sent: int, kind: str, value: object, about: str = "", round: int = 1) -> Event:
    return Event("ABCD", TEACHER, sent, kind, about, round, value)


opened = {"kind": VOTE, "about": "01", "round": 1, "seats": []}
votes = st.lists(st.builds(vote, st.sampled_from("pqr"), st.integers(1, 9), st.integers(0, 3), st.sampled_from([1, 2])))


# What is kept


@given(votes)
def test_what_is_sent_again_counts_once_and_the_last_message_of_a_phone_counts(said: list[Event]) -> None:
    first = {(each.phone, each.sent): each for each in reversed(said)}
    known: set[tuple[str, int]] = set()
    session = Session()
    for each in said:
        if (each.phone, each.sent) not in known:
            session.take(each)
        known.add((each.phone, each.sent))
    for round in (1, 2):
        for phone in "pqr":
            own = [each for each in first.values() if each.phone == phone and each.round == round]
            last = max(own, key=lambda each: each.sent).value if own else None
            assert session.values(Asked(VOTE, "01", round)).get(phone) == last


def test_a_table_that_is_opened_again_holds_what_was_kept(tmp_path: Path) -> None:
    events = Events(tmp_path)
    entry = events.named("10b")
    assert len(entry.code) == 4
    assert set(entry.code) <= set(LETTERS)
    own = [each._replace(code=entry.code) for each in (vote("p", 1, 2), vote("p", 1, 3), vote("q", 1, 0))]
    assert events.keep(own[:1]) == [True]
    assert events.keep(own) == [False, False, True]
    events.close()
    again = Events(tmp_path)
    assert again.named("10b") == entry
    assert [each.value for each in again.of(entry.code)] == [2, 0]
    assert again.forget(entry.code) == 2
    assert again.classes() == []
    again.close()


def test_of_what_is_forgotten_nothing_is_left_in_the_file(tmp_path: Path) -> None:
    events = Events(tmp_path)
    code = events.named("10b").code
    events.keep([Event(code, "f" * 32, 1, "prediction", "01:1", 1, "a very rare word")])
    events.forget(code)
    events.close()
    content = b"".join(path.read_bytes() for path in tmp_path.iterdir())
    assert b"a very rare word" not in content
    assert b"f" * 32 not in content


def test_what_cannot_be_written_is_an_error_and_nothing_is_kept(tmp_path: Path) -> None:
    """A disk that is full: no page of the file more than it has."""
    events = Events(tmp_path)
    code = events.named("10b").code
    pages = events._table.execute("PRAGMA page_count").fetchone()[0]
    events._table.execute(f"PRAGMA max_page_count = {pages}")
    large = [Event(code, "p", number, "plant", "", 1, "x" * 100_000) for number in range(1, 9)]
    with pytest.raises(NotKept, match="full"):
        events.keep(large)
    assert [*events.of(code)] == []
    events._table.execute("PRAGMA max_page_count = 1000000")
    assert events.keep(large) == [True] * 8
    events.close()


def test_another_file_is_not_taken_for_a_table(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / FILE).write_text("no table, but a text of somebody")
    with pytest.raises(ModelFileError):
        Events(tmp_path / "a")
    assert (tmp_path / "a" / FILE).read_text().startswith("no table")
    (tmp_path / "b").mkdir()
    table = sqlite3.connect(tmp_path / "b" / FILE)
    table.execute("CREATE TABLE own (x)")
    table.close()
    with pytest.raises(ModelFileError, match="not a table of this version"):
        Events(tmp_path / "b")


# Questions and votes


@pytest.mark.slow
def test_every_question_of_the_course_can_be_opened_and_says_what_it_asks() -> None:
    assert {each.kind for each in questions().values()} == {"vote", "prediction", "table", "exercise"}
    for kind, about in questions():
        session = Session([teacher(1, "open", {"kind": kind, "about": about, "round": 1, "seats": []})])
        session.take(teacher(2, "show", [kind, about, 1]))
        assert session.board(0)["current"]["shown"]
        asked = asked_of(question(kind, about))
        assert asked["question"]
        told = session.phone("p")["current"]  # before anything is drawn
        assert kind == "table" or told["question"] == asked["question"]
        assert told.get("options") == asked.get("options")


def test_a_page_of_a_lesson_names_its_questions_by_what_they_say() -> None:
    for name in ("01_all_at_once", "12_growing_without_a_jump"):
        for place, text in enumerate(predictions(name), 1):
            assert named("prediction", name[:2], text).about == f"{name[:2]}:{place}"
    with pytest.raises(ModelNameError):
        named("prediction", "01", "Something else?")


@pytest.mark.parametrize("value", [4, -1, "0", None, True, 1.0, [0]], ids=repr)
def test_only_the_number_of_an_option_is_a_vote(value: object) -> None:
    with pytest.raises(LSystemError):
        value_of(question(VOTE, "01"), value)


@given(
    st.dictionaries(st.sampled_from("abcdefgh"), st.integers(0, 3)),
    st.dictionaries(st.sampled_from("abcdefgh"), st.integers(0, 3)),
    st.integers(0, 3),
)
def test_the_gain_is_the_part_of_the_wrong_that_became_right(first: dict[str, int], second: dict[str, int], right: int) -> None:
    found, both = changes(first, second, right), first.keys() & second.keys()
    assert found["both"] == len(both)
    wrong = [phone for phone in both if first[phone] != right]
    assert found["better"] == sum(second[phone] == right for phone in wrong)
    assert found["worse"] == sum(first[phone] == right != second[phone] for phone in both)
    if wrong:
        assert found["gain"] == pytest.approx((found["better"] - found["worse"]) / len(wrong))
    else:
        assert found["gain"] is None


def test_bars_are_hidden_until_they_are_shown_and_the_right_one_is_seen_after_the_second_vote() -> None:
    session = Session([teacher(1, "open", opened), vote("p", 1, 0), vote("q", 1, 2)])
    assert "bars" not in session.board(2)["current"]
    assert session.board(2)["current"]["answered"] == 2
    session.take(teacher(2, "show", [VOTE, "01", 1]))
    assert session.board(2)["current"]["bars"] == [1, 0, 1, 0]
    assert "right" not in session.board(2)["current"]
    session.take(teacher(3, "open", {**opened, "round": 2}))
    session.take(vote("p", 2, 2, round=2))
    assert "reply" not in session.phone("p")["current"]
    session.take(teacher(4, "show", [VOTE, "01", 2]))
    seen = session.board(2)["current"]
    assert (seen["right"], seen["before"], seen["bars"]) == (right_option("01"), [1, 0, 1, 0], [0, 0, 1, 0])
    assert session.phone("p")["current"]["right"] == 2


def test_a_question_that_is_closed_takes_no_answer_and_can_be_opened_again() -> None:
    session = Session([teacher(1, "open", opened), teacher(2, "close", [VOTE, "01", 1])])
    asked = Asked(VOTE, "01", 1)
    assert session.refusal(asked)
    assert session.status[asked] == CLOSED
    session.take(teacher(3, "open", opened))
    assert session.refusal(asked) is None
    assert session.refusal(Asked(VOTE, "02", 1)) is None


# Be the cell


@pytest.mark.parametrize("what", GAMES)
def test_who_chooses_what_is_right_makes_the_right_word(what: str) -> None:
    for turn in game_of(what).turns:
        found = outcome(turn, [cell.right for cell in turn.cells])
        assert found["parts"] is None
        assert found["word"] == found["rightWord"] == " ".join(turn.word)
        assert all(len(cell.choices) > 1 and len({*cell.choices}) == len(cell.choices) for cell in turn.cells)


@given(st.integers(1, 40), st.integers(1, 60))
def test_no_cell_is_without_a_phone_where_there_are_enough_and_each_phone_has_one(phones: int, cells: int) -> None:
    own = [cells_of(seat, phones, cells) for seat in range(phones)]
    assert all(own)
    assert {each for some in own for each in some} == set(range(min(cells, 4 * phones)))


def test_a_step_of_the_class_is_compared_with_other_ways_of_working() -> None:
    turn = game_of("axiom: a b\na -> ab\nb -> a").turns[0]
    one_by_one = outcome(turn, [turn.cells[0].right, turn.cells[1].right])
    assert one_by_one["others"] == [{"way": "one rule after another", "word": "a a a"}]
    late = game_of("K16").turns[0]
    assert outcome(late, [None] * len(late.cells))["others"] == [{"way": "asking the neighbour too late", "word": "a a a a"}]
    assert outcome(late, [None] * len(late.cells))["unplayed"] == 5


def test_most_decide_for_a_cell_that_several_are() -> None:
    turn = game_of("J1").turns[0]
    assert made_by(turn, {0: {1: 2, 0: 3}}) == [0]
    assert made_by(turn, {0: {1: 2, 2: 2}}) == [1]
    assert made_by(turn, {}) == [None]


def test_phones_keep_their_cells_while_a_step_lasts_whoever_comes_or_goes() -> None:
    session = Session([teacher(1, "begin", {"game": game_data(game_of("K16")), "seats": ["p", "q"]}, about="1")])
    places = lambda phone: [each["place"] for each in session.phone(phone)["current"]["cells"]]  # noqa: E731
    before = places("p"), places("q")
    assert before == ([0, 2, 4], [1, 3])
    assert len(places("late")) == 1
    assert (places("p"), places("q")) == before
    session.take(Event("ABCD", "p", 1, GAME, "1", 1, {"0": 2}))
    session.take(Event("ABCD", "p", 2, GAME, "1", 1, {"2": 0}))
    assert session.chosen(Asked(GAME, "1", 1)) == {0: {2: 1}, 2: {0: 1}}


@pytest.mark.parametrize("value", [{"99": 0}, {"0": 9}, {"0": "a"}, {}, [], {"x": 0}, {"-1": 0}, {"0": True}], ids=repr)
def test_only_a_choice_of_a_cell_that_is_there_counts(value: object) -> None:
    session = Session([teacher(1, "begin", {"game": game_data(game_of("K16")), "seats": []}, about="1")])
    with pytest.raises(LSystemError):
        session.game_value(Asked(GAME, "1", 1), value)


@pytest.mark.parametrize(
    "text", ["axiom: ", "a b c", "axiom: " + "a" * 61 + "\na -> aa"], ids=["no cell", "no model", "too many"]
)
def test_a_model_that_no_class_can_be_is_refused(text: str) -> None:
    with pytest.raises(LSystemError):
        game_of(text)


# Reports


@pytest.fixture
def german() -> Iterator[None]:
    language("de")
    yield
    language("en")


def a_class() -> Session:
    said = [vote(f"{number}", 1, number % 4) for number in range(8)] + [vote(f"{number}", 2, 2, round=2) for number in range(8)]
    hostile = [Event("ABCD", f"{number}", 3, "prediction", "01:1", 1, text[:100]) for number, text in enumerate(HOSTILE)]
    table = [Event("ABCD", "1", 4, "table", "01:counts", 1, ["2", "3"])]
    wrong = [Event("ABCD", "1", 5, "exercise", "1.1", 1, {"said": "Almost", "message": "=cmd()"})]
    return Session([*said, *hostile, *table, *wrong])


def test_no_cell_of_a_report_is_a_formula_and_every_answer_is_in_it() -> None:
    rows = [*csv.reader(io.StringIO(report_table(a_class())))]
    assert all(len(row) == len(rows[0]) - 1 for row in rows[1:])
    assert not any(
        text.lstrip()[:1] in ("=", "+", "@", "\t") or (text[:1] == "-" and text != "-") for row in rows[1:] for text in row
    )
    votes = [row for row in rows if row[1] == "vote" and row[2] == "2"]
    assert [(row[3], row[4], row[5]) for row in votes] == [
        ("A", "0", "no"),
        ("B", "0", "no"),
        ("C", "8", "yes"),
        ("D", "0", "no"),
    ]


def test_the_page_of_a_report_shows_gains_and_only_text() -> None:
    page = report_page(ClassEntry("ABCD", "<b>10b</b>", "s"), a_class())
    assert "6 changed from wrong to right" in page
    assert "Normalised gain: 1.00." in page
    assert "<script" not in page
    assert "<b>10b" not in page


@pytest.mark.parametrize(
    ("right", "advice"),
    [
        (1, "10 % were right at first, which is few"),
        (5, "50 % were right at first: worth"),
        (8, "80 % were right at first, which"),
    ],
)
def test_a_report_says_what_a_first_vote_is_worth(right: int, advice: str) -> None:
    first = [vote(f"{number}", 1, right_option("01") if number < right else 0) for number in range(10)]
    assert advice in report_page(ClassEntry("ABCD", "10b", "s"), Session(first))


def test_a_report_in_german_is_german_and_its_table_has_the_same_columns(german: None) -> None:
    page, table = report_page(ClassEntry("ABCD", "10b", "s"), a_class()), report_table(a_class())
    assert '<html lang="de">' in page
    for text in (
        "Ihre Nummern sind zufällig",
        "sind 6 von falsch zu richtig gewechselt",
        "Normierter Zuwachs: 1,00.",
        "25 % lagen zuerst richtig",
        "<td>1 von 1</td>",
        "Fast richtig. =cmd()",
        "<h2>Vorhersagen</h2>",
    ):
        assert text in page
    left = re.findall(r">([^<>]*\b(?:of|the|were|changed|votes?|right|question|answer)\b[^<>]*)<", page.partition("<body")[2])
    assert {*left} <= {f"Lektion 1: {lesson('01').title}"} | {text for text in left if text in str(HOSTILE)}
    assert table.startswith("question,kind,round,answer,number,right,of,")


def test_the_shell_writes_reports_and_forgets(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = str(tmp_path / "own")
    assert main(["class", "report", folder]) == 2
    events = Events(folder)
    code = events.named("10b").code
    events.keep([each._replace(code=code) for each in (vote("p", 1, 2), vote("q", 1, 0))])
    events.close()
    assert main(["class", "report", folder]) == 0
    assert main(["class", "report", folder]) == 0, "its own reports are replaced"
    assert {path.suffix for path in Path(folder).glob("report-*")} == {".html", ".csv"}
    assert main(["class", "--folder", folder, "--forget", "--name", "other"]) == 2
    assert main(["class", "--folder", folder, "--forget"]) == 0
    assert "1 class and 2 entries are forgotten." in capsys.readouterr().out
    assert write_reports(folder) == []


@pytest.mark.parametrize("file", ["notebooks/ferns.ipynb", "course.toml"])
def test_a_class_is_not_kept_among_lessons(
    file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "notebooks").mkdir()
    (tmp_path / file).write_text("{}")
    assert main(["class", str(tmp_path)]) == 2
    assert f"lsys-kit class --course {tmp_path}" in capsys.readouterr().err
    kept: list[object] = []
    monkeypatch.setattr(serving, "serve", lambda folder, *_: kept.append(folder))
    assert main(["class", str(tmp_path / "10b")]) == 0
    assert kept == [str(tmp_path / "10b")]


@pytest.mark.parametrize(
    "given",
    [
        ["--port", "x"],
        ["--port", "70000"],
        ["--name", ""],
        ["--name", "a" * 99],
        ["--public", "http://x"],
        ["--public", "x"],
        ["what"],
        ["report", "what"],
    ],
    ids=str,
)
def test_what_the_shell_cannot_serve_is_refused_in_words(
    given: list[str], capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    try:
        status = main(["class", "--no-course", "--folder", str(tmp_path / "x"), *given])
    except SystemExit as end:
        status = end.code
    assert status == 2
    assert capsys.readouterr().err.startswith("lsys-kit")
