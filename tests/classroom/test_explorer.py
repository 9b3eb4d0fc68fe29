"""The explorer in the kernel: what the panel knows, keeps, says and answers."""

import base64
import io
import json
import math

import pytest
from ipywidgets import FloatSlider, IntSlider, link
from PIL import Image

from lsys_kit import LSystemError, ModelNameError, ModelValueError, compare, derive, explore, limits, linked, read, system
from lsys_kit.classroom.panel.document import inflated_text
from lsys_kit.classroom.panel.word_view import MOST_MODULES_SHOWN, word_html

GROWING = "axiom: A(0)\nA(t) : t < 3 -> A(t+1)[B]\nA(t) -> A(t/(t-3))"
AGEING = "axiom: A(0)\nA(t) : t < 3 -> A(t+1)[B(t)]\nB(t) : t > 0 -> B(t+1)"
WEIGHTED = "axiom: A\nA -> A B : 1/2\nA -> B A : 1/2"


def answer(panel, monkeypatch, **content):
    """What the kernel answers to a question of the browser."""
    replies = []
    monkeypatch.setattr(panel, "send", replies.append)
    panel._answer(panel, {"number": 7, **content}, [])
    [reply] = replies
    assert reply["number"] == 7
    return reply


def book_for(panel, monkeypatch, seed=0, **constants):
    return answer(panel, monkeypatch, kind="book", constants=constants, seed=seed)


def test_the_three_views_show_the_same_step():
    panel = explore("J4", 5)
    panel.step = 9
    assert panel.text.startswith("Step 9: 9 cells. Al(1)Br(1)Bl(2)Ar(2)")
    assert panel.sight.tokens == panel.sight.net.tokens(derive(system("J4"), 9)[-1])
    assert str(panel.sight.picture).startswith("steps 0 to 9")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("what", "step", "show", "said"),
    [
        ("J4", 9, None, "Step 9: 9 cells. Al(1)Br(1)"),
        ("K5", 1, "word", "Step 1: 5 strokes, 11 characters. F[+F]F[-F]F. Width 0.87, height 3."),
        ("K5", 1, None, "Step 1: 5 strokes, 11 characters. F[+F]F[-F]F. Stages F: 5. Width 0.87, height 3."),
        ("K19", 12, "drawing", "Step 12: 102 strokes, 199 modules. "),
        ("axiom: A\nA -> AB", 3, "word", "Step 3: 4 letters. A B B B. Nothing to draw."),
        (
            "axiom: a\na -> ab\nb -> a\ninterpretation:\na -> R(2,1) R(1,1)\nb -> R(1,1)",
            2,
            "word",
            "Step 2: 5 cells, 3 letters. ",
        ),
        ("K28", 2, None, "Step 2: 9 vertices, 12 walls, 4 cells. "),
    ],
)
def test_a_panel_tells_its_step_in_the_words_of_its_system(what, step, show, said):
    assert explore(what, step, show=show).text.startswith(said)


def test_a_long_word_is_told_once_how_long_it_is():
    text = explore("K5", 4).text
    assert text.startswith("Step 4: 625 strokes, 1,561 characters. F[+F]F")
    assert " ... " in text
    assert "modules" not in text


def test_symbols_are_unfolded_in_the_diagram_as_long_as_they_can_be(monkeypatch):
    panel = explore(AGEING, 2, unfold="A")
    names = ["A(0)", "A(1)", "A(2)", "A(3)", "[", "B", "]"]
    assert panel.model["book"]["net"]["names"] == names
    assert panel.sight.tokens == (0, 0, 1, 0, 2, 2, 2)
    assert [each["net"]["names"] for each in books_of(panel)] == [names]
    for rules, found in (
        (AGEING.replace("[B(t)]", ""), ["A(0)", "A(1)", "A(2)", "A(3)"]),
        ("axiom: F\nF -> F F", ["F"]),
        (AGEING, names),
    ):
        assert answer(panel, monkeypatch, kind="rules", text=rules) == {"number": 7, "opened": True}
        assert panel.model["book"]["net"]["names"] == found
        assert len(panel.sight.tokens) == len(found)


def books_of(panel):
    """The books of the page of a panel."""
    kept = json.loads(inflated_text(panel.page_data()["books"]))
    return [
        {name: kept["parts"][column][number] for column, (name, number) in enumerate(zip(kept["names"], row, strict=True))}
        for row in kept["rows"]
    ]


def test_what_cannot_be_unfolded_is_said_before_the_panel_opens():
    with pytest.raises(ModelNameError, match='no symbol "C" here'):
        explore(AGEING, unfold=["A", "C"])
    with pytest.raises(ModelValueError, match="Only the stages of an L-system"):
        explore("K28", unfold=True)


def test_a_life_span_is_an_attribute_that_changes_what_is_shown():
    panel = explore("J4", 9)
    panel.lifeTimeB = 5
    assert panel.settings == {"lifeTimeA": "3", "lifeTimeB": "5"}
    assert str(panel.sight.word) == str(derive(system("J4"), 9, lifeTimeB=5)[-1])


def test_the_panel_can_be_linked_to_other_widgets():
    panel, step, life, turn = explore("J4", 9), IntSlider(), IntSlider(), FloatSlider(max=180)
    link((panel, "step"), (step, "value"))
    link((panel, "lifeTimeA"), (life, "value"))
    link((panel, "angle"), (turn, "value"))
    step.value, life.value, turn.value = 4, 5, 33.3
    assert (panel.step, panel.settings["lifeTimeA"], panel.angle) == (4, "5", 33.3)
    panel.settings = {"lifeTimeA": "2"}
    assert life.value == 2
    assert panel.settings == {"lifeTimeA": "2", "lifeTimeB": "2"}


def test_a_value_between_those_of_a_slider_is_the_nearest():
    panel = explore(read("dt = 1/2\naxiom: A(0)\nA(t) -> A(t+dt)"), 4)
    panel.dt = 0.7000000000000001
    assert panel.settings == {"dt": "0.7"}
    assert str(panel.sight.word) == "A(2.8)"
    panel.dt = 99
    assert (panel.dt, panel.settings) == (1, {"dt": "1"})


def test_only_what_is_named_has_a_slider():
    panel = explore("P6", 4, dt=1, t_l="0.3", sliders="dt")
    assert panel.settings == {"dt": "1"}
    assert [each["name"] for each in panel.model["constants"]] == ["dt"]
    assert panel.model["fixed"] == "Fixed: t_div = 1, t_s = 0, t_l = 0.3, a = 2.1673."
    assert str(panel.sight.word) == str(derive(system("P6"), 4, dt=1, t_l="0.3")[-1])
    assert not hasattr(panel, "t_l")


def test_what_has_no_slider_has_none_on_a_page_and_stands_in_the_link():
    panel = explore("K26", 3, turn=40, sliders=[])
    data = panel.page_data()
    assert (data["model"]["constants"], data["model"]["chance"], data["model"]["seeds"]) == ([], False, [])
    assert data["model"]["fixed"] == "Fixed on this page: turn = 40, short = 0, seed = 0."
    assert linked(panel.link).settings["turn"] == 40


@pytest.mark.slow
def test_a_force_without_a_slider_goes_on_acting():
    free, held = explore("K28", 2, pressure=1), explore("K28", 2, pressure=1, sliders=["rest"])
    assert [*held.settings] == ["rest"]
    assert held.model["book"]["maps"] == free.model["book"]["maps"]
    assert held.page_data()["fixed"] == {"stiffness": "1", "pressure": "1", "damping": "1"}


def test_what_has_no_slider_gets_none_when_rules_are_typed(monkeypatch):
    panel = explore("J4", 3, sliders="lifeTimeA")
    text = "more = 2 in 1 .. 3\n" + str(panel.system).replace("lifeTimeB = 2", "lifeTimeB = 4")
    assert answer(panel, monkeypatch, kind="rules", text=text)["opened"]
    assert {*panel.settings} == {"lifeTimeA", "more"}
    assert panel.model["fixed"] == "Fixed: lifeTimeB = 4."


@pytest.mark.slow
def test_sliders_of_both_sides_are_chosen_at_once():
    both = compare("P5", "P6", step=4, sliders=["dt"])
    assert [*both.left.settings] == [*both.right.settings] == ["dt"]


@pytest.mark.slow
def test_a_slider_of_both_sides_moves_both():
    both = compare("J4", "J5", step=4, sliders=["lifeTimeA", "lifeTimeB"], shared="lifeTimeA")
    both.left.settings = {"lifeTimeA": "4"}
    assert both.right.settings["lifeTimeA"] == "4"
    both.right.settings = {"lifeTimeA": "5", "lifeTimeB": both.right.settings["lifeTimeB"]}
    assert both.left.settings["lifeTimeA"] == "5"
    assert both.page_data()["shared"] == ["lifeTimeA"]
    with pytest.raises(ModelNameError, match="There is no slider 'dt'"):
        compare("J4", "J5", shared=["dt"])


def test_a_panel_opens_with_the_views_that_are_asked_for():
    panel = explore("J4", 3, show=["drawing", "rules"])
    assert panel.model["show"] == panel.page_data()["model"]["show"] == ["rules", "drawing"]
    assert explore("J4", show="word").model["show"] == ["word"]
    assert explore("J4").model["show"] is None
    with pytest.raises(ModelNameError, match=r"There is no view 'net'\. The views are: rules, word, stages"):
        explore("J4", show="net")


def test_what_is_given_without_a_slider_stays_when_rules_are_typed(monkeypatch):
    panel = explore("J4", 3, lifeTimeB=4, sliders="lifeTimeA")
    assert answer(panel, monkeypatch, kind="rules", text=str(panel.system).replace("axiom: Al(1)", "axiom: Br(1)"))["opened"]
    assert panel.model["fixed"] == "Fixed: lifeTimeB = 4."


def test_what_was_moved_stays_where_it_is_declared_as_before_wherever_it_began(monkeypatch):
    panel = explore("J4", 3, lifeTimeA=5)
    typed = str(panel.system).replace("axiom: Al(1)", "axiom: Br(1)")
    assert answer(panel, monkeypatch, kind="rules", text=typed, constants={"lifeTimeA": "4", "lifeTimeB": "2"})["opened"]
    assert panel.settings == {"lifeTimeA": "4", "lifeTimeB": "2"}
    anew = typed.replace("lifeTimeA = 3", "lifeTimeA = 2")
    assert answer(panel, monkeypatch, kind="rules", text=anew, constants=panel.settings)["opened"]
    assert panel.settings == {"lifeTimeA": "2", "lifeTimeB": "2"}


@pytest.mark.parametrize("side", [{"step": 3}, {"sliders": "dt"}, {"what": "J5"}, {"show": "word"}])
def test_what_both_sides_share_is_no_setting_of_one(side):
    with pytest.raises(ModelValueError, match=r"is no setting of one side. It stands beside the two"):
        compare("J4", side, {})


def test_a_link_may_hold_a_constant_that_is_called_like_a_choice():
    panel = explore("sliders = 3 in 1 .. 5\nwhat = 2 in 1 .. 3\nfield = 1 in 0 .. 2\naxiom: F(sliders)F(what)F(field)", 0)
    panel.settings = {"sliders": 4}
    assert explore(panel.link).settings == {"sliders": "4", "what": "2", "field": "1"}


@pytest.mark.parametrize("sliders", ["lifetimeA", ["lifeTimeA", "dt"]])
def test_there_are_no_other_sliders(sliders):
    with pytest.raises(ModelNameError, match="There is no slider"):
        explore("J4", 3, sliders=sliders)


@pytest.mark.parametrize(
    ("sliders", "said"),
    [(3, "A name or a list of names of sliders is needed, not int"), ([3], "The name of a slider is needed, not int")],
)
def test_names_of_sliders_are_texts(sliders, said):
    with pytest.raises(ModelValueError, match=said):
        explore("J4", 3, sliders=sliders)


def test_a_plant_in_space_is_seen_from_a_side():
    panel = explore("K19", 12)
    front = str(panel.sight.picture.scene)
    panel.around = 40
    assert panel.sight.scene.dimension == 3
    assert str(panel.sight.picture.scene) != front


def test_the_angle_is_that_of_the_picture():
    panel = explore(read("axiom: F[&F]"), 0)
    panel.angle = 30
    assert panel.sight.scene.height == pytest.approx(1 + math.cos(math.radians(30)))


def test_a_step_beyond_the_last_says_why_there_are_no_more():
    panel = explore("K5", 4)
    last = panel.model["book"]["steps"]
    with pytest.raises(ModelValueError, match=f"The panel shows steps 0 to {last}, not 9.*limit is 250,000"):
        panel.step = 9
    assert panel.step == 4


def test_a_first_step_past_the_limit_is_refused():
    with pytest.raises(ModelValueError, match=r"steps 0 to 7, not 8.*976,561 modules; the limit is 250,000"):
        explore("K5", 8)


def test_a_lower_limit_is_kept(monkeypatch):
    with limits(modules=50):
        panel = explore("K5", 1)
    assert panel.model["book"]["steps"] == 1
    assert "the limit is 50" in panel.model["book"]["end"]


def test_a_step_that_cannot_be_computed_ends_the_book_with_the_reason():
    panel = explore(read(GROWING), 3)
    assert panel.model["book"]["steps"] == 3
    assert "division by zero" in panel.model["book"]["end"]


def test_the_browser_gets_the_book_of_the_settings_it_asks_for(monkeypatch):
    panel = explore("J4", 9)
    reply = book_for(panel, monkeypatch, lifeTimeA="4", lifeTimeB="1")
    assert reply["book"]["settings"] == {"lifeTimeA": "4", "lifeTimeB": "1"}
    assert panel.settings == {"lifeTimeA": "3", "lifeTimeB": "2"}  # only asked for, not chosen yet


def test_what_cannot_be_computed_for_some_settings_is_answered_with_the_reason(monkeypatch):
    panel = explore(read("c = 2 in 0 .. 4\naxiom: A(6/c)\nA(t) -> A(t+1)"), 3)
    assert "division by zero" in book_for(panel, monkeypatch, c="0")["mistake"]["message"]


def test_a_book_ends_before_a_step_that_cannot_be_computed(monkeypatch):
    panel = explore(read("c = 2 in 0 .. 4\naxiom: A(1)\nA(t) : t/c < 9 -> A(t+1)"), 3)
    found = book_for(panel, monkeypatch, c="0")["book"]
    assert found["steps"] == 0
    assert "division by zero" in found["end"]


def test_another_seed_is_another_book(monkeypatch):
    panel = explore(read(f"{WEIGHTED}\nZ < Z -> Z"), 6)
    assert panel.model["chance"]
    one, two, again = (book_for(panel, monkeypatch, seed)["book"]["words"] for seed in (1, 2, 1))
    assert one == again != two


@pytest.mark.parametrize(
    ("text", "told", "place"),
    [
        ("axiom: A\nA -> A(t", "is never closed", (15, 16)),
        ("axiom: A\nA -> B >", 'I did not expect ">" here', (16, 17)),
        ("axiom: A\nA(t) -> B(u)", 'I do not know the name "u"', (19, 20)),
    ],
)
def test_a_mistake_in_the_rules_is_answered_with_its_place(monkeypatch, text, told, place):
    panel = explore("J1", 4)
    reply = answer(panel, monkeypatch, kind="rules", text=text)["mistake"]
    assert told in reply["message"]
    assert (reply["start"], reply["end"]) == place
    assert panel.system == system("J1")


def test_new_rules_are_a_new_model_with_its_own_sliders(monkeypatch):
    panel = explore("J4", 4)
    text = "c = 2 in 1 .. 5\naxiom: A(1)\nA(t) : t < c -> A(t+1)\nA(t) -> A(1)A(1)"
    assert answer(panel, monkeypatch, kind="rules", text=text)["opened"]
    assert [each["name"] for each in panel.model["constants"]] == ["c"]
    assert panel.model["book"]["title"] == ""
    assert (panel.settings, panel.c) == ({"c": "2"}, 2)
    panel.c = 4
    assert str(panel.sight.word) == str(derive(panel.system, 4, c=4)[-1])
    assert str(panel.system.axiom[0]) == "A(1)"


def test_rules_may_be_typed_in_another_notation(monkeypatch):
    panel = explore("J1", 4)
    text = "#define n 3\nLsystem: 1\nAxiom: F\nF --> F[+F]F\nendlsystem"
    assert answer(panel, monkeypatch, kind="rules", text=text)["opened"]


@pytest.mark.parametrize(
    ("choices", "message"),
    [
        ({"lifeTimeA": 100}, "lifeTimeA = 100 lies outside its slider's range. It goes from 1 to 6"),
        ({"angle": 200}, "angle = 200 lies outside"),
        ({"step": -1}, "whole number from 0 on"),
        ({"seed": "pdf"}, "The seed must be a whole number, not 'pdf'"),
        ({"lifetimeA": 3}, 'Did you mean "lifeTimeA"'),
    ],
)
def test_first_settings_that_make_no_sense_are_errors(choices, message):
    with pytest.raises(LSystemError) as error:
        explore("J4", **choices)
    assert message in str(error.value)


def test_a_text_is_explored_too():
    assert str(explore("axiom: A\nA -> A B", 3).sight.word) == "A B B B"


def test_a_stored_notebook_shows_a_picture_and_words():
    bundle = explore("J4", 9)._repr_mimebundle_()
    assert bundle["text/plain"].startswith("Step 9: 9 cells.")
    assert Image.open(io.BytesIO(base64.b64decode(bundle["image/png"]))).size[0] >= 600
    assert "application/vnd.jupyter.widget-view+json" in bundle


@pytest.mark.slow
def test_a_stored_notebook_shows_the_plant_as_it_is_turned():
    panel = explore("K19", 12)
    front = panel._repr_mimebundle_()["image/png"]
    panel.around = 90
    side = panel._repr_mimebundle_()["image/png"]
    panel.around = 30
    assert side != front == panel._repr_mimebundle_()["image/png"]


def test_a_long_word_is_shortened_in_the_middle_with_its_length():
    html = word_html(derive(system("K5"), 4)[-1])
    assert 'aria-label="Word of 1,561 modules"' in html
    assert f"{1561 - MOST_MODULES_SHOWN:,} more" in html


def test_only_systems_are_explored():
    with pytest.raises(ModelValueError, match="explored"):
        explore(3)


@pytest.mark.parametrize("id", ["L0", "L1", "L2", "L3", "L4"])
def test_the_panel_of_a_plant_string_goes_as_far_as_the_applet(id):
    """The applet shows stages up to 7."""
    assert explore(id).model["book"]["steps"] >= 7
