"""The explorer in the kernel: what the panel shows, keeps and says."""

import base64
import io
import math
import sys

import pytest
from PIL import Image

from lsys_kit import LSystemError, ModelValueError, derive, draw, explore, limits, read, system
from lsys_kit.classroom.panel import view_model as study
from lsys_kit.classroom.panel.canvas import widget_classes
from lsys_kit.classroom.panel.word_view import MOST_MODULES_SHOWN, word_html
from lsys_kit.derivation.core.states import States
from lsys_kit.geometry.turtle.mode import DrawingMode

GROWING = "axiom: A(0)\nA(t) : t < 3 -> A(t+1)[B]\nA(t) -> A(t/(t-3))"


def shown(panel):
    return panel._word.value, panel._diagram.svg, panel._drawing.value


def test_commands_that_mean_nothing_are_named_below_the_sliders():
    panel = explore(read("turtle: plant-string\naxiom: I RH & I"))
    assert panel._status.value.endswith("passed over, without a meaning here: RH &amp;</span>")


def test_the_three_views_show_the_same_step():
    panel = explore("J4", 5)
    panel.step.value = 9
    assert panel.text.startswith("Step 9: 9 modules. Al(1)Br(1)Bl(2)Ar(2)")
    assert "tokens 2, 2, 1, 2, 2" in panel._diagram.svg
    assert "9 cells" in panel._drawing.value
    assert "<b>9 modules</b>" in panel._status.value


def test_a_life_span_changes_all_three():
    panel = explore("J4", 9)
    before = shown(panel)
    panel.constants["lifeTimeB"].slider.value = 5
    assert all(new != old for new, old in zip(shown(panel), before, strict=True))
    assert str(panel.sight.word) == str(derive(system("J4"), 9, lifeTimeB=5)[-1])


def test_a_step_is_computed_once(monkeypatch):
    panel = explore("J4", 8)
    panel.step.value = 9
    calls = []
    monkeypatch.setattr(States, "matching_rule", lambda *_: calls.append(1))
    monkeypatch.setattr(study, "filament", lambda *_: calls.append(1))
    panel.step.value = 8
    panel.step.value = 9
    assert not calls


def test_the_browsers_angle_never_comes_back(monkeypatch):
    panel = explore("K5", 3)
    monkeypatch.setattr(panel, "_show_step", lambda _: pytest.fail("the kernel was asked"))
    panel.angle.value = 40


def test_a_plant_in_space_is_drawn_in_space():
    panel = explore("K19", 12)
    assert panel.sight.scene.dimension == 3
    assert "depth" in panel.text
    assert str(panel.sight.picture) == str(draw(system("K19"), 12))
    assert "Turn it with the arrow keys" in panel._drawing.description


def test_the_side_that_is_seen_never_comes_back(monkeypatch):
    panel = explore("K19", 5)
    monkeypatch.setattr(panel, "_show_step", lambda _: pytest.fail("the kernel was asked"))
    panel.around.value, panel.above.value = 40, -20
    assert panel._view_model.mode is DrawingMode.SPACE


def test_the_angle_of_a_plant_in_space_is_the_kernels():
    panel = explore(read("axiom: F[&F]"), 0)
    before, panel.angle.value = panel._drawing.shapes, 30
    assert panel._drawing.shapes != before
    assert panel.sight.scene.height == pytest.approx(1 + math.cos(math.radians(30)))


@pytest.mark.parametrize(("id", "names"), [
    ("J1", ["step"]), ("K5", ["step", "angle"]), ("K19", ["step", "angle", "around", "above"])])
def test_only_what_can_be_turned_has_sliders_for_it(id, names):
    panel = explore(id, 1)
    assert [each.box.description for each in panel._controls()] == [*names, *panel.constants]


def test_reset_shows_the_whole_plant_from_the_front_again():
    panel = explore("K19", 5)
    panel.around.value, panel.above.value = 40, -20
    panel._reset.click()
    assert (panel.around.value, panel.above.value, panel._drawing.returns) == (0, 0, 1)


def test_a_step_past_the_limit_says_so_and_keeps_the_pictures():
    panel = explore("K5", 4)
    before = panel._word.value, panel._drawing.shapes, panel.text
    panel.step.value = 9
    assert "Step 7 would have 195,311 modules; the limit is 100,000" in panel._message.value
    assert (panel._word.value, panel._drawing.shapes, panel.text) == before
    panel.step.value = 3
    assert panel._message.value == ""


def test_a_lower_limit_is_kept():
    panel = explore("K5", 1)
    with limits(modules=50):
        panel.step.value = 3
    assert "the limit is 50" in panel._message.value


def test_a_value_that_cannot_be_computed_is_named():
    panel = explore(read(GROWING), 3)
    panel.step.value = 4
    assert "division by zero" in panel._message.value
    assert panel.text.startswith("Step 3")


def test_reset_goes_back_to_the_first_settings():
    panel = explore("J4", 7)
    first = panel.text
    panel.step.value, panel._mark.value = 3, 1
    panel.constants["lifeTimeA"].slider.value = 6
    panel._reset.click()
    assert panel.text == first
    assert panel._mark.value == -1


def test_choosing_a_stage_marks_its_cells_in_word_and_drawing():
    panel = explore("J1", 4)
    panel._diagram.chosen = 0
    assert panel._mark.value == 0
    assert panel._word.value.count("font-weight:bold") == 5
    assert panel._drawing.value.count('stroke-width="32"') == 1 + 1 + 2 + 3 + 5
    panel._mark.value = -1
    assert panel._diagram.chosen == -1
    assert "font-weight:bold" not in panel._word.value


def test_a_chosen_stage_that_is_gone_is_let_go():
    panel = explore("J4", 8)
    panel._mark.value = 4
    panel.constants["lifeTimeA"].slider.value = 1
    panel.constants["lifeTimeB"].slider.value = 1
    assert panel._mark.value == -1


@pytest.mark.parametrize(("choices", "message"), [
    ({"lifeTimeA": 100}, "lifeTimeA = 100 lies outside its slider's range. It goes from 1 to 6"),
    ({"angle": 200}, "angle = 200 lies outside"),
    ({"step": -1}, "whole number from 0 on"),
    ({"lifetimeA": 3}, 'Did you mean "lifeTimeA"')])
def test_first_settings_that_make_no_sense_are_errors(choices, message):
    with pytest.raises(LSystemError) as error:
        explore("J4", **choices)
    assert message in str(error.value)


def test_a_stored_notebook_shows_a_picture_and_words():
    bundle = explore("J4", 9)._repr_mimebundle_()
    assert bundle["text/plain"].startswith("Step 9: 9 modules.")
    assert Image.open(io.BytesIO(base64.b64decode(bundle["image/png"]))).size[0] == 600
    assert "application/vnd.jupyter.widget-view+json" in bundle


def test_a_stored_notebook_shows_the_plant_as_it_is_turned():
    panel = explore("K19", 12)
    front = panel._repr_mimebundle_()["image/png"]
    panel.around.value = 90
    side = panel._repr_mimebundle_()["image/png"]
    panel.around.value = 0
    assert side != front == panel._repr_mimebundle_()["image/png"]


@pytest.fixture
def without_anywidget(monkeypatch):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    widget_classes.cache_clear()
    yield
    widget_classes.cache_clear()


def test_without_anywidget_the_drawing_is_svg(without_anywidget):
    panel = explore("K5", 2)
    assert panel._drawing.value.startswith("<svg")
    before = panel._drawing.value
    panel.angle.value = 60
    assert panel._drawing.value != before
    panel._mark.value = 0
    assert 'class="marked"' in panel._drawing.value
    assert "is marked" in panel._diagram.value


@pytest.mark.parametrize("slider", ["around", "above"])
def test_without_anywidget_a_plant_is_turned_by_sliders(without_anywidget, slider):
    panel = explore("K19", 12)
    front = panel._drawing.value
    getattr(panel, slider).value = 45
    assert panel._drawing.value.startswith("<svg")
    assert panel._drawing.value != front
    panel._reset.click()
    assert panel._drawing.value == front


def test_a_long_word_is_shortened_in_the_middle_with_its_length():
    html = word_html(derive(system("K5"), 4)[-1])
    assert 'aria-label="Word of 1,561 modules"' in html
    assert f"{1561 - MOST_MODULES_SHOWN:,} more" in html


def test_a_system_of_ones_own_is_explored_too():
    panel = explore(read("dt = 1/2\naxiom: A(0)\nA(t) -> A(t+dt)"), 4)
    panel.constants["dt"].slider.value = 0.7000000000000001
    assert str(panel.sight.word) == "A(2.8)"


@pytest.mark.slow
def test_sequential_play_stops_at_the_end():
    import asyncio

    async def play():
        panel = explore("J1", 3)
        panel.step.max = 4
        panel._play.click()
        assert panel._play.description == "pause"
        await asyncio.wait_for(panel._playing, 10)
        return panel

    panel = asyncio.run(play())
    assert panel.step.value == 4
    assert panel._play.description == "play"


def test_only_systems_are_explored():
    with pytest.raises(ModelValueError, match="explored"):
        explore(3)
