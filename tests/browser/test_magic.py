"""`%%lsystem` in a real JupyterLab: a system that is shown, and a mistake underlined where it stands."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, expect

LOAD = "from lsys_kit import *\n%load_ext lsys_kit"
TREE = """%%lsystem tree
age = 3 in 1 .. 6
angle: 25.7
axiom: $[+A(0)]$[-A(0)]
A(t) : t < age && t != 7 -> F [+ $ A(t+1)] [- $ A(t+1)] : 2/3
A(t) : t < age && t != 7 -> F A(t^2 + 1) : 1/3
F < A(t) > F -> ε
interpretation:
A(t) -> F(1/2)"""
PAREN = "%%lsystem koch\nangle: 60\naxiom: F--F--F\nF -> F+F--F+[F\nG -> F"
EQUALS = "%%lsystem alga\naxiom: a(1)\na(t) : t = 1 -> b a(t)\nb -> a(0)"


@pytest.fixture
def notebook(open_notebook, write_notebook):
    """Runs cells behind the one that loads the kit."""

    def run(*cells: str, **context: object):
        opened = open_notebook(write_notebook("magic.ipynb", LOAD, *cells), **context)
        opened.run_all()
        assert opened.cell_errors() == []
        assert opened.console == []
        return opened

    return run


def underline(box: Locator) -> dict[str, str]:
    """How the wrong stretch of a mistake looks in the browser."""
    return box.locator("u").evaluate(
        "element => ({line: getComputedStyle(element).textDecorationLine,"
        " style: getComputedStyle(element).textDecorationStyle, text: element.textContent})"
    )


def test_a_pasted_system_is_shown_as_in_a_book(notebook):
    opened = notebook(TREE, "tree", "derive(tree, 1)")
    for cell in (2, 3):
        box = opened.output(cell).locator(".lsys-system")
        expect(box).to_contain_text("is an L-system in the notation abop.")
        expect(box.locator("tr", has_text=re.compile("^p1"))).to_contain_text("t < age ∧ t ≠ 7")
        expect(box.locator(".lsys-word").first).to_have_text("$[+A(0)]$[-A(0)]")
    expect(opened.output(2)).to_contain_text("tree is an L-system")
    expect(opened.output(4)).to_contain_text("1 $[+F")
    opened.output(2)
    opened.shot("magic-system")


def test_a_dollar_sign_turns_the_turtle_and_begins_no_formula(notebook):
    opened = notebook(TREE, "%%lsystem\naxiom: $ [+ $ A]\nA = $ B $", "from IPython.display import HTML\nHTML('$x$')")
    expect(opened.output(4).locator("mjx-container")).to_be_visible()  # by now the others would be formulas too
    expect(opened.output(2).locator("mjx-container")).to_have_count(0)
    expect(opened.output(3).locator("mjx-container")).to_have_count(0)
    expect(opened.output(2)).to_contain_text("$\u2009[\u2009+\u2009A")


def test_a_mistake_is_underlined_in_place(notebook):
    opened = notebook(PAREN, EQUALS, "%%lsystem lambda\naxiom: A")
    box = opened.output(2).get_by_role("alert")
    expect(box).to_contain_text("is never closed (line 4, column 13)")
    expect(box).to_contain_text('There is no system "koch" yet.')
    assert underline(box) == {"line": "underline", "style": "wavy", "text": "["}
    assert underline(opened.output(3).get_by_role("alert"))["text"] == "="
    assert underline(opened.output(4).get_by_role("alert"))["text"] == "lambda"
    opened.output(2)
    opened.shot("magic-mistake")


def test_the_numbers_of_the_lines_are_those_of_the_editor(notebook):
    opened = notebook(PAREN)
    row = opened.output(2).get_by_role("alert").locator("pre").inner_text().split("\n")[3]
    assert row.split(maxsplit=1) == ["4", opened.cell(2).locator(".cm-line").nth(3).inner_text()]


def test_on_a_narrow_screen_a_system_stays_within_the_page(notebook):
    opened = notebook(TREE, EQUALS, viewport={"width": 620, "height": 1000})
    for cell in (2, 3):
        sides = opened.output(cell).locator(".lsys-system, .lsys-mistake").bounding_box()
        assert sides["x"] + sides["width"] <= 620
    opened.shot("magic-narrow")
