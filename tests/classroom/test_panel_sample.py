"""The sample of the panel, and what is exact of it; and one rule after another, with the tokens that run along their arcs."""

from __future__ import annotations

import re
from collections import Counter
from fractions import Fraction
from itertools import product

import pytest
from playwright.sync_api import expect

from lsys_kit import derive, ensemble, explore, read
from lsys_kit.classroom.catalogue import system
from lsys_kit.classroom.panel.books.book import book
from tests.classroom.front_end import answers

PLANT = "axiom: F\nF -> F[+F]F[-F]F : 1\nF -> F[+F]F : 1\nF -> F[-F]F : 1"
FAMILY = "p = 0.65 in 0 .. 1 by 0.05\naxiom: T\nT -> F [+ T] - T : p\nT -> X : 1-p"
SAMPLE = "[data-view=sample]"
EXACT = """
const counted = (state) => given.book.symbols[given.book.states[state][0]][0] === given.letter;
return [exactMean(given.book, counted, given.steps), exactShares(given.book, counted, given.steps)];
"""
DICE = """
const book = openBook(given.book);
return [given.seeds.map((seed) => openBook({ ...given.book, seed }).length(given.step)), firstThrow(book)];
"""
LINES = """
const book = oneAfterAnother(openBook(given.book)), all = Array.from({ length: book.steps + 1 }, (_, step) => step);
const told = (step) => Array.from(book.word(step), (state) => book.label(state).text).join(" ");
return { words: all.map(told), held: book.data.held };
"""


@pytest.fixture(scope="module")
def page(browser):
    return browser.new_page()


def made_in(page, code, given, *names):
    return answers(page, code, given, "numbers", "stops", "controls", "chance", "book", *names)


def exactly(page, text, letter, steps):
    return made_in(page, EXACT, {"book": book(read(text), least=steps), "letter": letter, "steps": steps})


def family(p, steps):
    """How likely each number of living tips is, as fractions."""
    shares = {1: Fraction(1)}
    for _ in range(steps):
        after = Counter[int]()
        for tips, share in shares.items():
            for forks in product((True, False), repeat=tips):
                after[2 * sum(forks)] += share * p ** sum(forks) * (1 - p) ** (tips - sum(forks))
        shares = after
    return shares


def test_the_exact_distribution_is_that_of_all_ways_in_which_the_dice_may_fall(page):
    mean, shares = exactly(page, FAMILY, "T", 3)
    wanted = family(Fraction(13, 20), 3)
    assert shares == pytest.approx([float(wanted.get(many, 0)) for many in range(len(shares))], abs=1e-12)
    assert mean == pytest.approx(1.3**3)


def test_the_exact_mean_is_the_power_of_the_mean_matrix(page):
    mean, shares = exactly(page, PLANT, "F", 5)
    assert mean == pytest.approx((11 / 3) ** 5)
    assert sum(shares) == pytest.approx(1)
    assert sum(many * share for many, share in enumerate(shares)) == pytest.approx(mean)
    assert [many for many, share in enumerate(shares) if share][:: len(shares)] == [3**5]
    assert len(shares) == 5**5 + 1


def test_a_distribution_with_too_many_numbers_is_not_computed(page):
    mean, shares = exactly(page, PLANT, "F", 8)
    assert mean == pytest.approx((11 / 3) ** 8)
    assert shares is None


def test_a_sample_throws_what_an_ensemble_throws(page):
    found, first = made_in(page, DICE, {"book": book(read(PLANT), seed=3, least=5), "seeds": [*range(30)], "step": 5})
    assert found == [*ensemble(read(PLANT), 30, steps=5)["modules"]]
    assert first == derive(read(PLANT), 1, seed=3).origins(1).productions[0]


def test_one_rule_after_another_makes_the_monster(page):
    found = made_in(page, LINES, {"book": book(read("axiom: a\na -> ab\nb -> a"))}, "sequential")
    assert found["words"][:7] == ["a", "a b", "a a", "a b a b", "a a a a", " ".join("ab" * 4), " ".join("a" * 8)]
    assert found["held"][:3] == ["", "after line 1 of step 1: a -> ab", "after line 2 of step 1: b -> a"]


def test_a_program_ends_where_a_state_is_met_of_which_the_book_says_nothing(page):
    found = made_in(page, LINES, {"book": book(read("axiom: A(0) B\nA(t) -> A(t+1)\nB -> C\nC -> B"))}, "sequential")
    assert found["words"][:4] == ["A(0) B", "A(1) B", "A(1) C", "A(1) B"]


def said(panel):
    return panel.at(f"{SAMPLE} .lsys-caption[role=status]")


def press(panel, name):
    panel.at(SAMPLE).get_by_role("button", name=name, exact=True).click()


@pytest.mark.browser
def test_plants_are_counted_one_by_one_and_their_mean_settles(explored):
    panel = explored(PLANT, 4, show=["drawing", "sample"])
    strokes = ensemble(read(PLANT), 21, "F", steps=4)["F"]
    press(panel, "one more")
    expect(said(panel)).to_contain_text(f"Plants at step 4: 1. Number of F: on average {strokes[0]}")
    press(panel, "ten more")
    press(panel, "ten more")
    mean = f"{sum(strokes) / 21:.4g}"
    expect(said(panel)).to_contain_text(f"21. Number of F: on average {mean}, from {min(strokes)} to {max(strokes)}.")
    bars = panel.at(f"{SAMPLE} svg.lsys-counts rect[fill='var(--lsys-accent)']")
    assert bars.count() > 2
    press(panel, "exact")
    expect(said(panel)).to_contain_text("Exactly: 180.8 on average.")
    press(panel, "first throw")
    expect(panel.at(SAMPLE).get_by_text(re.compile(r"F -> F\[\+F\]F\[-F\]F : 1, \d+ times: on average"))).to_be_visible()
    expect(bars).to_have_count(0)
    panel.at(SAMPLE).get_by_role("button", name="seed 19").click()
    expect(panel.page.get_by_label("seed", exact=True)).to_have_value("19")
    expect(said(panel)).to_contain_text("Plants at step 4: 21.")
    press(panel, "clear")
    expect(said(panel)).to_contain_text("No plant has been thrown yet. How many F will it have at step 4?")


@pytest.mark.browser
def test_it_goes_on_until_somebody_stops_it_and_a_slider_throws_the_same_plants_again(explored):
    panel = explored(FAMILY, 5, show=["drawing", "sample"])
    press(panel, "until I stop")
    expect(said(panel)).to_contain_text(re.compile(r"Plants at step 5: [5-9]\."))
    press(panel, "stop")
    many = int(re.search(r"step 5: (\d+)", said(panel).inner_text())[1])
    panel.at(SAMPLE).get_by_label("count").select_option(label="T")
    panel.control("step").press("ArrowRight")
    tips = ensemble(read(FAMILY), many, "T", steps=6)["T"]
    expect(said(panel)).to_contain_text(f"Plants at step 6: {many}. Number of T: on average {round(sum(tips) / many, 3):.4g}")


@pytest.mark.browser
def test_what_is_counted_stays_the_same_where_a_symbol_has_another_number(explored):
    """At p = 0.4 the only tip of the tree with seed 6 dies, so that its symbols occur in another order."""
    panel = explored(FAMILY, 5, seed=6, show=["drawing", "sample"])
    numbers = [book(read(FAMILY), {"p": p}, 6, least=5)["symbols"] for p in (0.65, 0.4)]
    assert [row[0] for row in numbers[0]] != [row[0] for row in numbers[1]]
    panel.at(SAMPLE).get_by_label("count").select_option(label="F")
    press(panel, "exact")
    for key in ("ArrowLeft", "ArrowLeft", "ArrowLeft", "ArrowLeft", "ArrowLeft"):
        panel.control("p").press(key)
    expect(said(panel)).to_contain_text("How many F will it have at step 5? Exactly: 1.345 on average.")


@pytest.mark.browser
def test_where_neighbours_have_a_say_the_kernel_throws(explored):
    panel = explored(f"{PLANT}\nZ < Z -> Z", 2, show=["drawing", "sample"])
    press(panel, "one more")
    expect(said(panel)).to_contain_text("Plants at step 2: 1.")
    expect(panel.at(SAMPLE).get_by_role("button", name="exact")).to_be_hidden()


def test_systems_without_chance_have_no_sample() -> None:
    assert not explore("K5", 2).model["chance"]


@pytest.mark.browser
def test_lines_of_a_program_are_steps_until_all_is_at_once_again(explored):
    panel = explored("axiom: a\na -> ab\nb -> a", 1, show=["word", "drawing", "unfolding"])
    order = panel.page.get_by_role("button", name="one rule after another")
    order.click()
    line = panel.at("[data-view=unfolding] .lsys-caption[role=status]")
    expect(line).to_have_text("0 of 100 of line 1 of step 1: a -> ab.")
    panel.control("step").press("ArrowRight")
    panel.control("step").press("ArrowRight")
    expect(panel.at(".lsys-status")).to_contain_text("after line 2 of step 1: b -> a")
    expect(order).to_have_attribute("aria-pressed", "true")
    order.click()
    expect(order).to_have_attribute("aria-pressed", "false")
    expect(line).to_have_text("0 of 100 on the way from step 1 to step 2.")


@pytest.mark.browser
def test_tokens_run_to_the_bar_and_from_there_along_their_arcs(explored):
    panel = explored("J4", 9, show=["word", "stages", "drawing", "unfolding"])
    lying, running = panel.at("[data-place] .lsys-tokens circle"), panel.at(".lsys-running > g")
    expect(running).to_have_count(0)
    for _ in range(8):
        panel.control("unfolding").press("ArrowRight")
    stages = derive(system("J4"), 9)[9]
    expect(running).to_have_count(len({re.sub(r"[lr]", "", str(module)) for module in stages}))
    expect(lying.first).to_be_hidden()
    panel.control("unfolding").press("Home")
    expect(running).to_have_count(0)
    expect(lying.first).to_be_visible()
