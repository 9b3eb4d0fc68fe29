"""What lessons ask: declarations that are checked, votes that are kept, predictions before answers, tables to fill."""

from __future__ import annotations

import copy
import tomllib
from fractions import Fraction
from itertools import count
from typing import Any

import matplotlib.pyplot as plt
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ipywidgets import HTML, HTMLMath, IntSlider

from lsys_kit import (
    ModelFileError,
    ModelNameError,
    ModelValueError,
    derive,
    draw,
    explore,
    map_system,
    predict,
    system,
    vote,
    worksheet,
)
from lsys_kit.budget import in_task
from lsys_kit.classroom.lessons import kept
from lsys_kit.classroom.lessons.entries import is_right, number_of
from lsys_kit.classroom.lessons.lesson import Blank, Option, Table, Vote, lesson, lesson_from, names, table
from lsys_kit.classroom.lessons.vote import Ballot, VoteBox, _ballot
from lsys_kit.classroom.lessons.widget import html, media, prose_html, prose_text
from lsys_kit.classroom.lessons.worksheet import Worksheet, marked, summary
from lsys_kit.classroom.places import kit_place

ONE = "01_all_at_once"


@pytest.fixture(autouse=True)
def nothing_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing was typed before."""
    for name in ("_known", "_not_written"):
        monkeypatch.setattr(kept, name, {})
    monkeypatch.setattr(kept, "_read", [])
    _ballot.cache_clear()


DECLARED = tomllib.loads((kit_place().declared / f"{ONE}.toml").read_text("utf-8"))


def changed(*path: Any, to: object) -> dict[str, Any]:
    """The declaration of lesson 1 with one entry changed; `...` takes it out."""
    found: Any = copy.deepcopy(DECLARED)
    place = found
    for step in path[:-1]:
        place = place[step]
    if to is ...:
        del place[path[-1]]
    else:
        place[path[-1]] = to
    return found


# --- declarations -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", names())
def test_every_lesson_can_be_read(name):
    assert lesson(name[:2]).name == name
    assert sum(option.right for option in lesson(name[:2]).vote.options) == 1


@pytest.mark.parametrize(
    ("path", "to", "says"),
    [
        (("title",), ..., 'The lesson 01_all_at_once has no "title"'),
        (("titel",), "x", 'The lesson 01_all_at_once has an unknown entry "titel"'),
        (("number",), 2, '"number" must be 1, as in its name, not 2'),
        (("minutes",), "50", '"minutes" must be a whole number'),
        (("minutes",), True, '"minutes" must be a whole number'),
        (("track",), ["F", "X"], '"track" has letters of F, C, O, not X'),
        (("objectives",), "all", '"objectives" must be a list of texts'),
        (("objectives",), ["a", " "], '"objectives", entry 2 must be a text'),
        (("vote",), [], '"vote" must be a table of entries'),
        (("vote", "question"), 0.5, None),
        (("vote", "options"), {}, '"options" must be a list'),
        (("vote", "options"), DECLARED["vote"]["options"][:1], "there must be 2 to 6 options"),
        (("vote", "options", 0, "right"), True, "one option must have right = true"),
        (("vote", "options", 2, "right"), "yes", 'vote, option 3, "right" must be true or false'),
        (("vote", "options", 1, "reply"), ..., 'vote, option 2 has no "reply"'),
        (("vote", "picture"), {"step": 3}, 'a picture needs the id of its "system"'),
        (("vote", "picture"), {"system": "K5", "rules": "axiom: F"}, 'or its "rules"'),
        (("vote", "picture"), {"system": "K5", "colour": "red"}, 'a picture has no "colour"'),
        (("vote", "picture"), {"system": "K17b", "constants": 4}, 'picture, "constants" must be a table of entries'),
        (("tables",), {}, '"tables" must be a list'),
        (("tables",), DECLARED["tables"] * 2, "two tables have the same id"),
        (("tables", 0, "id"), "Steps!", '"id" must have small letters, digits and hyphens only'),
        (("tables", 0, "rows"), [["0", "1", "1"]], "table 1 has no cell to fill"),
        (("tables", 0, "rows", 1), [1, 2], "row 2 must have 3 cells"),
        (("tables", 0, "rows", 1, 0), {"right": "1"}, "row 2: the first cell names the row"),
        (("tables", 0, "rows", 1, 1), {"rihgt": "1"}, 'column 2 has an unknown entry "rihgt"'),
        (("tables", 0, "rows", 1, 1), {"right": []}, '"right" is empty'),
        (("tables", 0, "rows", 1, 1), {"right": "1", "within": "near"}, '"within" must be a number'),
        (("tables", 0, "rows", 1, 1), {"right": "1", "within": -1}, '"within" must be a number from 0 on'),
        (("tables", 0, "rows", 1, 1), {"right": "1", "slips": [{"answer": "2"}]}, 'column 2, slip 1 has no "says"'),
        (("tables", 0, "of"), [{}], 'table 1: "of" must have an entry for each of the 3 columns'),
        (("tables", 0, "of"), [{}, {"ask": "length"}, {}], 'of 2 has an unknown entry "ask"'),
        (("predictions",), [{"question": "Why?"}], 'prediction 1 has no "answer"'),
        (("predictions",), [{"question": "Why?", "answer": "3", "later": "yes"}], '"later" must be true or false'),
        (("settings",), [["dt"]], "settings 1 must be a table of entries"),
        (("settings",), [{"dt": "near"}], 'settings 1, "dt" must be a number'),
        (("tables", 0, "rows", 1, 1), True, "column 2 must be a text"),
    ],
)
def test_a_mistake_in_a_declaration_is_named_with_its_place(path, to, says):
    if says is None:
        assert lesson_from(ONE, changed(*path, to=to)).vote.question == "0.5"
        return
    with pytest.raises(ModelFileError) as mistake:
        lesson_from(ONE, changed(*path, to=to))
    assert says in str(mistake.value)
    assert ONE in str(mistake.value)


def test_a_lesson_has_the_name_of_a_file():
    with pytest.raises(ModelFileError, match="must be called by small letters"):
        lesson_from("1_All", DECLARED)


@pytest.mark.parametrize("number", ["01", "1", 1, " 01 "])
def test_a_lesson_is_known_by_its_number(number):
    assert lesson(number).name == ONE


@pytest.mark.parametrize(
    ("number", "error", "says"),
    [
        ("77", ModelNameError, "There is no lesson"),
        (-1, ModelNameError, "There is no lesson"),
        pytest.param(10**5000, ModelNameError, "There is no lesson", id="large"),
        (True, ModelValueError, "must be a text"),
        (1.0, ModelValueError, "must be a text"),
        (None, ModelValueError, "must be a text"),
    ],
)
def test_there_are_no_other_lessons(number, error, says):
    for word in (vote, lambda number: worksheet(number, "counts")):
        with pytest.raises(error, match=says):
            word(number)


def test_there_are_no_other_tables():
    with pytest.raises(ModelNameError, match='Lesson 1 has no table "count"') as mistake:
        worksheet("01", "count")
    assert 'Did you mean "counts"?' in str(mistake.value)
    with pytest.raises(ModelValueError, match="The id of a table must be a text"):
        table("01", 1)


# --- what is right ----------------------------------------------------------------------------------------------------


@given(
    st.fractions(-(10**9), 10**9, max_denominator=10**9),
    st.sampled_from([str, lambda number: f" {number.numerator} / {number.denominator} "]),
)
def test_a_fraction_is_right_however_it_is_spaced(number, spelt):
    assert is_right(spelt(number), [str(number)])
    assert not is_right(spelt(number + 1), [str(number)])


@given(st.integers(-(10**9), 10**9), st.integers(0, 4))
def test_a_decimal_is_a_number_with_any_zeros_behind(number, zeros):
    assert number_of(f"{number}.{'0' * (zeros + 1)}") == number
    assert is_right(f"{number:,}", [str(number)])
    assert is_right(str(number).replace("-", "−"), [str(number)])


@pytest.mark.slow
@given(st.text(max_size=30))
def test_whatever_is_typed_is_right_or_not(entry):
    assert is_right(entry, ["21", "al br"]) in (True, False)
    assert is_right(entry, [entry]) or not entry


@pytest.mark.parametrize(
    ("entry", "right", "within", "expected"),
    [
        ("AB a", ["ab A"], "0", True),
        ("abb", ["ab"], "0", False),
        ("1,618", ["1.618"], "0", True),
        ("1,618", ["1618"], "0", True),
        ("16,18", ["1618"], "0", False),
        ("1/0", ["1"], "0", False),
        ("50 %", ["1/2"], "0", True),
        ("yes", ["no", "yes"], "0", True),
        ("1.6", ["1.618"], "0.02", True),
        ("1.59", ["1.618"], "0.02", False),
        ("9" * 300, ["9" * 300], "0", False),
        ("", ["0"], "0", False),
    ],
)
def test_answers_are_compared_as_a_teacher_would(entry, right, within, expected):
    assert is_right(entry, right, within) is expected


def test_a_percentage_is_a_hundredth():
    assert number_of("12.5 %") == Fraction(1, 8)


# --- votes ------------------------------------------------------------------------------------------------------------

OPTIONS = (
    Option("one", "No, not one.", right=False),
    Option("`two`", "Yes.", right=True),
    Option("three", "No."),
    Option("four", "No, less."),
)


@pytest.fixture
def both() -> tuple[VoteBox, VoteBox]:
    """The two votes of one question."""
    ballot, asked = Ballot(), Vote("How many?", OPTIONS)
    return VoteBox(asked, ballot, False), VoteBox(asked, ballot, True)


def test_the_first_vote_is_kept_and_says_nothing_of_what_is_right(both):
    first, _ = both
    said = []
    for number in range(4):
        first.chosen = number
        said.append(first.said["text"].replace("ABCD"[number], "X"))
        assert set(first.said) == {"text"}
    assert len(set(said)) == 1


def test_the_second_vote_shows_the_first_and_says_nothing_before_it_is_cast(both):
    first, again = both
    assert again.said == {"before": "You did not vote the first time."}
    first.chosen = 3
    assert again.said == {"before": "Your first vote was D."}


@pytest.mark.parametrize(
    ("before", "after", "verdict", "changed"),
    [
        (0, 1, "Right", "You have changed your vote from A to B."),
        (1, 1, "Right", "You voted the same way the first time."),
        (1, 0, "Not right", "You have changed your vote from B to A. You were right the first time."),
        (-1, 2, "Not right", ""),
        (2, 3, "Not right", "You have changed your vote from C to D."),
    ],
)
def test_the_second_vote_is_answered(both, before, after, verdict, changed):
    first, again = both
    first.chosen = before
    again.chosen = after
    assert (again.said["verdict"], again.said["text"], again.said["changed"]) == (verdict, OPTIONS[after].reply, changed)
    assert first.chosen == before


def test_what_the_browser_gets_does_not_tell_the_right_option(both):
    for box in both:
        sent = repr([value for name, value in box.get_state().items() if not name.startswith("_")])
        assert not any(option.reply in sent for option in OPTIONS)
        assert "right" not in sent


def test_a_vote_is_kept_as_long_as_the_kernel_lives():
    vote("01").chosen = 3
    assert vote("01").chosen == 3
    assert vote("01", again=True).said == {"before": "Your first vote was D."}
    vote("01").chosen = -1


def test_a_closed_vote_hears_of_no_more_votes(both):
    first, again = both
    again.close()
    first.chosen = 2
    assert again.said == {"before": "You did not vote the first time."}


def test_only_true_and_false_say_whether_a_vote_is_the_second():
    with pytest.raises(ModelValueError, match="True or False"):
        vote("01", again=1)


@pytest.mark.parametrize(
    "picture",
    [
        {"system": "K5", "step": 3},
        {"system": "K28"},
        {"system": "K33", "step": 1},
        {"rules": "axiom: F\nF -> F+F", "step": 2, "angle": 60},
        {"system": "P5", "step": 2, "constants": {"dt": "1.4"}},
    ],
)
def test_a_vote_may_have_a_picture_with_its_text(picture):
    box = VoteBox(Vote("Which?", OPTIONS, picture), Ballot(), False)
    assert box.asked["picture"].startswith("data:image/svg+xml;base64,")
    assert repr(box).splitlines()[1] == f"[{box.asked['described']}]"
    assert "<img alt=" in box._repr_mimebundle_()["text/html"]


def test_a_stored_vote_shows_the_question_and_all_options(both):
    for box in both:
        bundle = box._repr_mimebundle_()
        assert bundle["text/plain"] == "How many?\n  A  one\n  B  two\n  C  three\n  D  four"
        assert bundle["text/html"].count("<li>") == 4
        assert "application/vnd.jupyter.widget-view+json" in bundle


# --- predictions ------------------------------------------------------------------------------------------------------


class Own:
    """What somebody else's class may show."""

    def _repr_html_(self) -> str:
        return "<script>alert(1)</script>"

    def _repr_latex_(self) -> str:
        return "$x^2$"

    def __repr__(self) -> str:
        return "<own>"


NUMBERS = count()


def revealed(what: object, typed: str = "21") -> Any:
    """The widget that appears after a prediction."""
    asked = predict(f"How many? ({next(NUMBERS)})", what)
    assert len(asked.children) == 1
    asked.prompt.typed = typed
    assert len(asked.children) == 1
    asked.prompt.revealed = True
    return asked.children[1]


def test_a_widget_is_revealed_as_it_is():
    for what in (explore("J1", 3), IntSlider(3)):
        assert revealed(what) is what


def test_pictures_and_words_are_revealed_as_a_notebook_shows_them():
    assert revealed(draw(system("K5"), 2)).value.startswith('<img alt="25 segments')
    assert "2 bl ar ar" in revealed(derive(system("J1"), 2)).value
    assert revealed(draw(map_system("K28"), 2)).value.startswith("<img alt=")
    assert revealed("a < b\nc", "").value.count("\n") == 1
    assert "a &lt; b" in revealed("a < b").value


def test_markup_is_taken_from_the_kit_alone():
    assert "text/html" not in media(Own())
    shown = revealed(Own())
    assert isinstance(shown, HTMLMath)
    assert shown.value == "<div>$x^2$</div>"
    del Own._repr_latex_
    shown = revealed(Own())
    assert isinstance(shown, HTML)
    assert "&lt;own&gt;" in shown.value
    assert "script" not in shown.value


@pytest.mark.parametrize("module", ["elsewhere", "lsys_kit.elsewhere"])
def test_what_the_kit_shows_has_budgets_of_its_own(module):
    """A page holds many books, each a task; what others show is one task, and supervised."""

    class Shown:
        def __repr__(self):
            return f"in a task: {in_task()}"

    Shown.__module__ = module
    assert media(Shown())["text/plain"] == f"in a task: {module == 'elsewhere'}"


def test_a_picture_of_another_kind_is_an_image_with_its_text():
    assert html({"image/png": "iVBO\n", "text/plain": "<a>"}).startswith('<img alt="&lt;a&gt;" ')
    assert "base64,iVBO" in html({"image/png": "iVBO\n", "text/plain": "<a>"})
    assert "data:image/svg+xml;base64," in html({"image/svg+xml": "<svg/>", "text/plain": "a"})


@pytest.mark.slow
def test_a_figure_is_not_seen_before_the_prediction():
    figure, _ = plt.subplots()
    predict("How long?", figure)
    assert plt.get_fignums() == []


def test_a_stored_prediction_shows_the_question_and_the_answer():
    bundle = predict("How long is `al`?", draw(system("J1"), 3))._repr_mimebundle_()
    assert bundle["text/plain"] == "How long is al?\nsteps 0 to 3; the last: 5 cells, width 8, height 1"
    assert "<p>How long is <code>al</code>?</p></div><img alt=" in bundle["text/html"]
    panel = predict("How long?", explore("J1", 3))._repr_mimebundle_()
    assert panel["text/plain"].startswith("How long?\nStep 3: 5 cells.")
    assert "image/png" in panel
    assert "text/html" not in panel


def test_what_was_typed_is_cut_off_and_never_answers():
    asked = predict("How many?", "the answer")
    asked.prompt.typed = "x" * 5_000
    assert len(asked.prompt.typed) == 1_000
    assert "the answer" not in repr(asked.prompt.get_state())


@pytest.mark.parametrize("question", ["", "  ", 3, None])
def test_a_question_is_a_text(question):
    with pytest.raises(ModelValueError, match="A question must be a text"):
        predict(question, "21")


def test_closing_a_prediction_closes_what_it_shows():
    panel = explore("J1", 2)
    asked = predict("How many?", panel)
    asked.close()
    assert panel.comm is None


# --- tables to fill ---------------------------------------------------------------------------------------------------

SHEET = Table(
    "t",
    "A `title`",
    ("step", "cells", "word"),
    (("0", "1", "a"), ("1", Blank(("2",)), Blank(("ab", "a b"))), ("2", Blank(("1.5",), "0.1"), "aba")),
)


def check(sheet: Worksheet, *entries: str) -> dict[str, Any]:
    sheet.asked = {"number": sheet.asked.get("number", 0) + 1, "entries": list(entries)}
    return dict(sheet.result)


def test_every_cell_is_right_not_yet_or_missing():
    sheet = Worksheet(SHEET)
    assert check(sheet, "2", "ba", " ")["marks"] == ["right", "not yet", "not filled in yet"]
    assert sheet.result["text"] == "1 of 3 cells is right, 1 is not filled in yet. Look again at step 1, word."
    assert check(sheet, "2", "AB", "1.45")["text"] == "All cells are right."
    assert check(sheet)["marks"] == ["not filled in yet"] * 3
    assert check(sheet, "2", "", "")["text"] == "1 of 3 cells is right, 2 are not filled in yet."


def test_a_table_of_one_cell_is_spoken_of_as_one():
    one = Table("t", "t", ("a", "b"), (("1", Blank(("2",))),))
    assert summary(one, marked(one, ["2"])) == "The cell is right."
    assert summary(one, marked(one, ["3"]), [0]) == "0 of 1 cell is right. Look again at a 1, b."


def test_no_answer_is_sent_before_or_after_a_check():
    sheet = Worksheet(Table("t", "t", ("a", "b"), (("1", Blank(("secret",))),)))
    check(sheet, "wrong")
    assert "secret" not in repr(sheet.get_state())


@pytest.mark.parametrize("asked", [{}, {"entries": []}, {"entries": [None, 3, "x" * 10**6, "too", "many"]}])
def test_whatever_a_browser_sends_is_checked(asked):
    sheet = Worksheet(SHEET)
    sheet.asked = {"number": 1, **asked}
    assert len(sheet.result["marks"]) == 3
    assert max(map(len, sheet.entries)) < 1_000


def test_a_stored_table_shows_what_is_given_and_what_is_asked():
    bundle = Worksheet(SHEET)._repr_mimebundle_()
    assert (
        bundle["text/plain"]
        == """\
A title
  step  cells  word
  0     1      a
  1     ____   ____
  2     ____   aba"""
    )
    assert bundle["text/html"].count("<td>") == 9
    assert "<caption>A <code>title</code></caption>" in bundle["text/html"]


def test_a_table_may_stand_beside_what_it_is_filled_in_from() -> None:
    panel = explore("K17b", 24, sliders="v", show="drawing")
    both = worksheet("10", "speeds", panel)
    assert both.children == (panel, both.sheet)
    bundle = both._repr_mimebundle_()
    assert bundle["application/vnd.jupyter.widget-view+json"]["model_id"] == both.model_id
    assert bundle["text/html"].startswith("<img ")
    assert "at the top of the stem" in bundle["text/html"]
    assert repr(both) == bundle["text/plain"] == f"{panel!r}\n{both.sheet!r}"
    both.close()
    assert panel.comm is both.sheet.comm is None
    with pytest.raises(ModelValueError, match=r"A panel of explore or compare is needed, not Worksheet\."):
        worksheet("10", "speeds", worksheet("10", "speeds"))


@given(st.text(alphabet="ab`*<&", max_size=12))
def test_prose_has_no_markup_but_its_own(text):
    assert prose_html(text).count("<") == prose_html(text).count(">")
    assert set(prose_text(text)) <= set(text)
