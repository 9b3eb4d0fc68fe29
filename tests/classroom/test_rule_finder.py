"""Find the rules: the words of an alga, one step more at a time, and all systems that fit."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from lsys_kit import ModelLimitError, ModelValueError, derive, infer, limits, rule_finder, system
from lsys_kit.classroom.site.pages import Entry, notebook_page
from tests.classroom.test_site import LESSON, ran_prediction

ALGA = ["A", "Bd", "cAA", "BBdBd", "cAcAAcAA"]
"""J1 under other names."""


def counts(words: object, **conditions: object) -> list[str]:
    return [step["count"] for step in rule_finder(words, **conditions).found["steps"]]


def test_a_new_letter_raises_the_number_of_systems_and_a_later_word_settles_it() -> None:
    assert counts(ALGA) == counts(derive(system("J1"), 4)) == ["1", "2", "2", "1"]


@pytest.mark.slow
@pytest.mark.parametrize("id", ["J1", "J3", "P3", "K5"])
def test_each_step_lists_what_fits_the_words_up_to_it(id: str) -> None:
    words = derive(system(id), 4)
    for step, said in enumerate(rule_finder(words).found["steps"], 1):
        fits = infer([words[each] for each in range(step + 1)])
        assert said["count"] == str(len(fits))
        rules = [{*said["common"], *own} for own in said["systems"] or [[]]]
        assert rules == [{str(rule) for rule in fit.productions} for fit in fits[:20]]


def test_where_systems_part_the_words_of_each_are_shown_from_the_first_difference_on() -> None:
    third = rule_finder(ALGA).found["steps"][2]
    assert third["parting"] == 4
    assert third["words"] == [["c ", "c A A c A A"], ["c ", "A c A A c A A"]]


def test_it_is_stored_with_all_its_steps() -> None:
    stored = rule_finder(ALGA)._repr_mimebundle_()
    assert stored["text/plain"].endswith(
        "\nstep 4: c A c A A c A A\n  One system fits these 5 words:\n    A -> B d\n    B -> c A\n    d -> A\n    c -> B"
    )
    assert stored["text/html"].count("<tr>") == len(ALGA) + 1
    assert "<b>2</b><br><code>A -&gt; B d</code><ol><li><code>B -&gt; c</code>" in stored["text/html"]


def test_words_that_nothing_fits_say_why() -> None:
    steps = rule_finder(["a", "ab", "abb", "abba", "abbbb", "abbbbb"]).found["steps"]
    assert [step["count"] for step in steps] == ["1", "1", "0", "0", "0"]
    assert steps[2]["heading"].startswith("No system fits these 4 words. Step 3 cannot come from step 2")
    assert steps[3]["heading"] == "No system fits these 5 words, since none fits those up to step 3."
    assert "A system without contexts would fit if letter 4 of step 3, a, were b." in steps[4]["heading"]
    assert steps[4]["common"] == ["a -> a b"]
    assert counts(derive(system("J2"), 3), context=(1, 1))[-1] == "1"


def test_a_word_that_is_not_known_is_filled_in() -> None:
    finder = rule_finder(["a", None, "aba", "abaab"])
    assert finder.found["words"][1] == "?"
    assert counts(["a", None, "aba", "abaab"])[-1] == "1"
    assert finder.found["steps"][-1]["notes"] == ["The word of step 1 is a b."]


@pytest.mark.slow
def test_more_than_a_thousand_systems_are_not_listed() -> None:
    (step,) = rule_finder(["abcde", "ab" * 14]).found["steps"]
    assert (step["count"], step["systems"]) == ("17,550", [])
    assert step["heading"].startswith("17,550 systems fit these 2 words. Give more steps.")


def test_a_search_that_takes_too_long_is_refused() -> None:
    with limits(seconds=1e-6), pytest.raises(ModelLimitError):
        rule_finder(derive(system("J1"), 12))


def test_long_words_are_cut_off() -> None:
    word = rule_finder(["a", "b" * 500]).found["words"][1]
    assert word == f"{'b ' * 200} ..."


@pytest.mark.parametrize("words", [["a"], "ab", 5, [3, 4]])
def test_words_are_needed(words: object) -> None:
    with pytest.raises(ModelValueError):
        rule_finder(words)


@pytest.mark.parametrize(("asked", "shown"), [(0, 1), (3, 3), (99, 4)])
def test_a_step_is_one_of_those_that_are_there(asked: int, shown: int) -> None:
    finder = rule_finder(ALGA)
    finder.step = asked
    assert finder.step == shown


def opened(browser: Browser, path: Path, **choices: object) -> Page:
    """A page without a kernel that shows the rules, as what answers a question."""
    entry = Entry(LESSON, "Rules")
    path.write_text(notebook_page(entry, [ran_prediction("How many fit?", rule_finder(ALGA))], [entry]), "utf-8")
    page = browser.new_context(**choices).new_page()
    page.goto(path.as_uri())
    return page


@pytest.mark.parametrize(("width", "scheme"), [(1440, "light"), (400, "dark")])
def test_a_key_shows_one_step_more(browser: Browser, tmp_path: Path, pytestconfig: pytest.Config, width, scheme) -> None:
    page = opened(browser, tmp_path / "rules.html", viewport={"width": width, "height": 900}, color_scheme=scheme)
    page.get_by_role("button", name="I have no idea").click()
    rules, slider = page.get_by_role("region", name="rules that fit"), page.get_by_role("slider", name="Step")
    expect(rules.get_by_role("status")).to_have_text("One system fits these 2 words:")
    expect(rules.get_by_role("rowheader")).to_have_text(["0", "1"])
    slider.press("ArrowRight")
    slider.press("ArrowRight")
    expect(slider).to_have_attribute("aria-valuetext", "step 3 of 4")
    expect(rules.get_by_role("status")).to_have_text("2 systems fit these 4 words; they part at step 4:")
    expect(rules.get_by_text("B B d B d")).to_be_visible()
    expect(rules.get_by_role("listitem")).to_contain_text(["Its step 4: c c A A c A A", "Its step 4: c A c A A c A A"])
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    if folder := pytestconfig.getoption("screenshots"):
        page.screenshot(path=Path(folder) / f"rules-{width}.png", full_page=True)
    slider.press("End")
    expect(rules.get_by_role("status")).to_have_text("One system fits these 5 words:")
    expect(rules.get_by_role("listitem")).to_have_count(0)
    page.context.close()
