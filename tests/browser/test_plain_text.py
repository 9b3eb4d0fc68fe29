"""In a real JupyterLab: what a person has typed is text, and neither a formula nor a part of the page."""

from __future__ import annotations

from playwright.sync_api import expect

LOAD = "from lsys_kit import *\n%load_ext lsys_kit"
CELLS = (
    "from IPython.display import HTML\nHTML('<p>$x$</p>')",  # once this is a formula, the others would be formulas too
    "check('1.1', r'$\\frac{1}{0}$ cost $5 and $6')",
    "check('1.1', '<img src=x onerror=alert(1)> $x$')",
    "from lsys_kit.classroom.exercises.verdict import Verdict\nVerdict('Not yet', 'cost $5 and $x$')",
    "%%lsystem\naxiom: $ A $ B $\nA -> $ A $",
    "%%lsystem\naxiom: $A$ <script>alert(1)</script>",
    "explore(read('dollars = 1 in 1 .. 5\\naxiom: $ A(dollars) $ B $\\nA(t) -> $ A(t + dollars) $'))",
    "explore(read('axiom: A(0)\\nA(t) -> $ A(1/t) $'), 0)",
    "draw(stages(read('axiom: $ A $\\nA -> $ A $ B')))",
)


def test_nothing_typed_becomes_a_formula_or_runs(open_notebook, write_notebook):
    opened = open_notebook(write_notebook("plain.ipynb", LOAD, *CELLS))
    asked = []
    opened.page.on("dialog", lambda dialog: (asked.append(dialog.message), dialog.dismiss()))
    opened.run_all()
    assert opened.cell_errors() == []
    expect(opened.output(2).locator("mjx-container")).to_be_visible()
    for cell in range(3, 3 + len(CELLS) - 1):
        output = opened.output(cell)
        expect(output.locator("mjx-container")).to_have_count(0)
        expect(output.locator("script, iframe, img[onerror]")).to_have_count(0)
        opened.shot(f"plain-{cell}")
    expect(opened.output(3)).to_contain_text(r"$\frac{1}{0}$ cost $5 and $6")
    expect(opened.output(9).locator(".lsys-status")).to_contain_text("division by zero")
    assert asked == []
