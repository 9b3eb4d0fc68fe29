"""What may be typed into the cells of a table, what a wrong entry shows, and that nothing typed is lost."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import language, predict, vote, worksheet
from lsys_kit.classroom.course import MANIFEST
from lsys_kit.classroom.exercises.asked import answer_by, right_history
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.lessons import kept
from lsys_kit.classroom.lessons.entries import is_number_asked, is_right, number_of, readings
from lsys_kit.classroom.lessons.kept import FILE, HEAD, answered, keep
from lsys_kit.classroom.lessons.lesson import Blank, Table, declared, lesson, names, table
from lsys_kit.classroom.lessons.predicted import outcome, predictions_of
from lsys_kit.classroom.lessons.slips import exercise_of, slips_of
from lsys_kit.classroom.lessons.vote import _ballot
from lsys_kit.classroom.lessons.worksheet import checked, marked

every_table = pytest.mark.parametrize(
    ("number", "id"), [(name[:2], each.id) for name in names() for each in declared(name).tables]
)


def begin_anew() -> None:
    """As after the kernel was restarted."""
    for each in (kept._known, kept._not_written, kept._read):
        each.clear()
    _ballot.cache_clear()


@pytest.fixture(autouse=True)
def nothing_answered() -> None:
    begin_anew()


# --- what is typed -----------------------------------------------------------------------------------------------------------


@given(st.integers(0, 10**12), st.sampled_from([",", ".", "'"]))
def test_thousands_are_parted_by_commas_points_or_marks(number: int, sign: str) -> None:
    assert is_right(f"{number:,}".replace(",", sign), [str(number)])


@given(st.fractions(-1000, 1000, max_denominator=1000))
def test_a_quotient_a_decimal_and_a_percentage_are_one_number(number: Fraction) -> None:
    assert is_right(f"{number.numerator}/{number.denominator}", [str(number)])
    hundredths = Fraction(round(number * 100), 100)
    assert is_right(f"{float(hundredths):.2f}".replace(".", ","), [str(hundredths)])
    assert is_right(f"{round(number * 100)} %", [str(hundredths)])


@pytest.mark.parametrize(
    ("entry", "right"),
    [
        ("2.500", "2500"),
        ("2,500", "2500"),
        ("2'500", "2500"),
        ("2 500", "2500"),
        ("2.5", "5/2"),
        ("2,5", "5/2"),
        ("5/2", "2.5"),
        (".9", "0.9"),
        ("½", "0.5"),
        ("20%", "20"),
        ("20 %", "0.2"),
        ("5^4", "625"),
        ("5·5·5", "125"),
        ("N = 13", "13"),
        ("≈ 13", "13"),
        ("about 13", "13"),
        ("13 cells", "13"),
        ("13 Cells", "13"),
        ("72°", "72"),
        ("y", "yes"),
        ("N", "no"),
        ("nein", "no"),
        ("l", "left"),
        ("rechts", "right"),
    ],
)
def test_an_entry_is_right_in_any_usual_form(entry: str, right: str) -> None:
    assert is_right(entry, [right], nouns=["cell", "°"])


@pytest.mark.parametrize("entry", ["", "abc", "1½", "5 walls", "5 or 6", "1/0", "--2", "1e3", "2.5.1", "x" * 300, "5^" * 40])
def test_whatever_is_no_number_is_told_from_a_wrong_one(entry: str) -> None:
    assert readings(entry, ["cell"]) == ()


def test_a_wrong_number_no_number_and_nothing_are_three_things() -> None:
    assert marked(table("01", "counts"), ["3", "abc", " ", "4"])[:4] == ["not yet", "no number", "not filled in yet", "right"]
    said = checked(table("01", "counts"), ["2", "abc"])
    assert said["notes"] == [
        "step 1, rule after rule: That cannot be read as a number. Write it in digits, such as 21, 0.5 or 3/4."
    ]
    said = checked(table("04", "angles"), ["90", "perhaps"])
    assert said["notes"] == ['angle 45, closed at step 0? (yes or no): Answer "yes" or "no".']


# --- what an entry shows -----------------------------------------------------------------------------------------------------


@pytest.mark.slow
@every_table
def test_what_a_column_counts_of_a_system_is_what_the_system_gives(number: str, id: str) -> None:
    found = table(number, id)
    for row, cells in enumerate(found.rows):
        for column, cell in enumerate(cells):
            exercise = exercise_of(found, row, column)
            if exercise is not None:
                right = cell.right if isinstance(cell, Blank) else [cell]
                assert is_right(str(answer_by(exercise, right_history(exercise))), right), (row, column)


@pytest.mark.slow
@every_table
def test_no_slip_is_right_and_each_says_something(number: str, id: str) -> None:
    found = table(number, id)
    for place, (_, _, blank) in enumerate(found.blanks):
        slips = slips_of(found, place)
        others = [each for each in slips if each.says != reply("number.close")]  # of what is near, and not near enough
        assert not any(is_right(each.answer, blank.right, blank.within) for each in others)
        assert all(each.says[-1:] in ".?" and not re.search(r"{\w+}", each.says) for each in slips)
        if is_number_asked(blank.right) and number_of(blank.right[0]):
            assert slips


@pytest.mark.parametrize(
    ("where", "cell", "entry", "says"),
    [
        (("01", "counts"), 4, "8", "apply one production after another"),
        (("01", "counts"), 4, "3", "stop one step too early"),
        (("02", "counts"), 9, "21", "go one step too far"),
        (("00", "dye"), 8, "775", "add up the numbers of all steps"),
        (("00", "dye"), 8, "500", "count only what the last step has added"),
        (("00", "dye"), 6, "625", 'in the column "all strokes"'),
        (("03", "price"), 0, "22285", "belongs to [B], the row below"),
        (("04", "state"), 0, "0", "belongs to "),
        (("04", "state"), 5, "0", "opposite direction"),
        (("04", "angles"), 0, "45", "each of them is a turn"),
        (("05", "ratio"), 2, "150", "in per cent of a long one"),
        (("12", "jump"), 0, "1.3", "The age is the power"),
        (("05", "ratio"), 0, "1", "belongs to L, the row above"),
        (("02", "rates"), 0, "1.625", "is close"),
        (("02", "rates"), 0, "1.6", "rounded too far"),
        (("18", "fit"), 0, "14.706", "the decimal point"),
        (("06", "rules"), 1, "99", "off by one"),
    ],
)
def test_a_known_slip_is_named(where: tuple[str, str], cell: int, entry: str, says: str) -> None:
    entries = [""] * len(table(*where).blanks)
    entries[cell] = entry
    assert says in checked(table(*where), entries)["notes"][0]


def test_one_note_is_said_of_all_cells_that_it_is_true_of() -> None:
    found = checked(table("02", "strokes"), ["1", "1", "5", "11", "25", "61"])
    assert len(found["notes"]) == 1
    assert found["notes"][0].startswith("step 1, letters F, which are strokes; step 1, characters; step 2, ")
    assert "stop one step too early" in found["notes"][0]


def test_of_an_entry_that_nothing_explains_nothing_is_said_but_its_place() -> None:
    found = checked(table("01", "counts"), ["2", "2", "77"])
    assert found["notes"] == []
    assert found["text"].endswith("Look again at step 2, all at once.")


def test_replies_are_in_the_language_that_is_chosen() -> None:
    try:
        language("de")
        assert "Schritt" in checked(table("01", "counts"), ["", "", "", "", "8"])["notes"][0]
    finally:
        language("en")


# --- what is kept ------------------------------------------------------------------------------------------------------------


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the course, in whose folder of notebooks Python runs."""
    (tmp_path / MANIFEST).write_text("{}")
    (tmp_path / "notebooks").mkdir()
    monkeypatch.chdir(tmp_path / "notebooks")
    return tmp_path


def filled(*entries: str, check: bool = True) -> Any:
    """A table of which some cells are filled, as the browser tells it."""
    sheet = worksheet("01", "counts")
    sheet.typed = [*entries, *[""] * (8 - len(entries))]
    if check:
        sheet.asked = {"number": sheet.result.get("number", 0) + 1, "entries": sheet.typed}
    return sheet


def test_a_table_is_as_it_was_when_its_cell_is_run_again() -> None:
    filled("2", "3")
    filled("2", "3", "5", check=False)
    again = worksheet("01", "counts")
    assert again.typed[:4] == ["2", "3", "5", ""]
    assert again.result["marks"][:3] == ["right", "not yet", "not filled in yet"]


def test_the_first_entry_of_a_cell_stays_beside_the_right_one() -> None:
    filled("3")
    assert filled("2", "2").result["first"][:3] == ["3", "2", ""]
    assert worksheet("01", "counts").result["first"][0] == "3"


@pytest.mark.usefixtures("course")
def test_nothing_typed_is_lost_when_the_kernel_is_restarted() -> None:
    filled("2", "3")
    vote("01").chosen = 3
    asked = predict("Step 6 has 13 long cells and 8 short ones. How long is the filament?", "34")
    asked.prompt.typed, asked.prompt.revealed = "21", True
    begin_anew()
    assert worksheet("01", "counts").typed[:3] == ["2", "3", ""]
    assert vote("01").chosen == 3
    again = predict("Step 6 has 13 long cells and 8 short ones. How long is the filament?", "34")
    assert (again.prompt.typed, again.prompt.revealed, len(again.children)) == ("21", True, 2)


@pytest.mark.usefixtures("course")
def test_a_prediction_that_was_not_shown_yet_is_kept_and_counts_for_nothing() -> None:
    question = "Step 6 has 13 long cells and 8 short ones. How long is the filament?"
    predict(question, "34").prompt.typed = "2"
    begin_anew()
    again = predict(question, "34")
    assert (again.prompt.typed, again.prompt.revealed, len(again.children)) == ("2", False, 1)
    assert predictions_of(lesson("01")) == []


@pytest.mark.usefixtures("course")
def test_what_is_taken_back_is_gone() -> None:
    sheet = filled("2", "3")
    sheet.typed, sheet.asked = [""] * 8, {}
    assert sheet.result == {}
    vote("01").chosen = 3
    vote("01").chosen = -1
    asked = predict("How many?", "34")
    asked.prompt.typed, asked.prompt.revealed = "21", True
    asked.prompt.typed, asked.prompt.revealed = "", False
    assert len(asked.children) == 1
    begin_anew()
    assert worksheet("01", "counts").typed == [""] * 8
    assert worksheet("01", "counts").result == {}
    assert vote("01").chosen == -1
    assert not predict("How many?", "34").prompt.revealed


def test_a_file_is_read_as_far_as_it_can_be_understood(course: Path) -> None:
    keep("How many?", ["21"])
    lines = ["{", "[1]", '{"question": 3, "answers": []}', '{"question": "a", "answers": [3]}', "\x00", "[" * 10_000]
    with (course / FILE).open("a") as file:
        file.write("\n".join([*lines, json.dumps({"question": "Why?", "answers": ["x" * 1_500] * 300})]))
    begin_anew()
    assert answered("How many?") == ("21",)
    assert answered("a") == ()
    assert (len(answered("Why?")), len(answered("Why?")[0])) == (200, 1_000)
    keep("How many?", ["22"])
    begin_anew()
    assert answered("How many?") == ("22",)


def test_a_file_of_somebody_elses_stays_as_it_is(course: Path) -> None:
    (course / FILE).write_text("mine\n")
    keep("How many?", ["21"])
    assert answered("How many?") == ("21",)
    assert (course / FILE).read_text() == "mine\n"


def test_a_long_file_is_made_short_and_holds_what_was_answered_last(course: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept, "MOST_BYTES", 2_000)
    for number in range(100):
        keep("How many?", [str(number)])
        keep(f"And {number % 3}?", [str(number)])
    begin_anew()
    assert (course / FILE).stat().st_size <= 2_000
    assert (course / FILE).read_text().startswith(HEAD)
    assert (answered("How many?"), answered("And 2?")) == (("99",), ("98",))


def test_a_file_that_was_deleted_is_begun_anew(course: Path) -> None:
    keep("How many?", ["21"])
    assert answered("How many?") == ("21",)
    (course / FILE).unlink()
    assert answered("How many?") == ()
    keep("How many?", ["22"])
    assert answered("How many?") == ("22",)


# --- predictions beside what came out -------------------------------------------------------------------------------------


def test_a_prediction_stands_beside_what_came_out() -> None:
    asked = predict("Step 6 has 13 long cells and 8 short ones. How long is the filament?", "...")
    assert asked.prompt.outcome == {}
    asked.prompt.typed, asked.prompt.revealed = "21 units", True
    assert asked.prompt.outcome == {"answer": "34", "right": False}
    assert outcome("Step 6 has 13 long cells and 8 short ones. How long is the filament?", " 34 ")["right"]
    assert outcome("Is this asked anywhere?", "34") == {}


def test_predictions_come_back_at_the_second_vote_and_some_answers_only_there() -> None:
    question = "At which step does the word stop changing, and what is it then?"
    again = vote("09", again=True)
    assert "predicted" not in again.said
    asked = predict(question, "...")
    asked.prompt.typed, asked.prompt.revealed = "8", True
    assert asked.prompt.outcome == {}
    (said,) = again.said["predicted"]
    assert said == {"question": question, "typed": "8", "answer": "at step 15: `c d d d d d d d d`", "right": False}
    assert predictions_of(lesson("09")) == [said]
    assert "predicted" not in vote("09").said
    again.close()


def test_a_question_of_ones_own_may_be_asked_of_several_things() -> None:
    first = predict("How many?", "21")
    first.prompt.typed, first.prompt.revealed = "20", True
    assert predict("How many?", "21").prompt.typed == "20"
    assert not predict("How many?", "34").prompt.revealed


def test_what_is_declared_of_a_column_fits_the_table() -> None:
    two = Table("t", "t", ("step", "b"), (("1", Blank(("2",))),))
    assert exercise_of(two, 0, 1) is None
