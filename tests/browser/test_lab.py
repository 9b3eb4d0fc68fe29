"""JupyterLab and the browser are there and do what the tests of the lessons rely on."""

from __future__ import annotations

from playwright.sync_api import expect

from lsys_kit.classroom.course import course_files

SLIDER = """import ipywidgets
slider, text = ipywidgets.IntSlider(3, 0, 9), ipywidgets.HTML("3 cells")
slider.observe(lambda change: setattr(text, "value", f"{change.new} cells"), "value")
ipywidgets.VBox([slider, text])"""

BROKEN = """import anywidget
class Broken(anywidget.AnyWidget):
    _esm = "export default { render() { throw new Error('oh') } }"
Broken()"""


def test_the_lab_shows_the_course(lab):
    assert {name for name in course_files() if (lab.folder / name).is_file()} == set(course_files())


def test_a_slider_moves_by_keyboard(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("slider.ipynb", SLIDER))
    notebook.run_all()
    shown = notebook.output(1)
    expect(shown.get_by_text("3 cells")).to_be_visible()
    handle = shown.locator(".noUi-handle")
    handle.focus()
    handle.press("ArrowRight")
    expect(shown.get_by_text("4 cells")).to_be_visible()
    handle.press("ArrowLeft")
    handle.press("ArrowLeft")
    expect(shown.get_by_text("2 cells")).to_be_visible()
    notebook.shot("slider")
    assert notebook.cell_errors() == []
    assert notebook.console == []


def test_an_error_in_a_cell_is_seen_and_a_cell_that_never_ran(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("error.ipynb", "1 / 0"))
    assert notebook.cell_errors() == ["cell 1 did not run"]
    notebook.run_all()
    assert notebook.cell_errors() == ["cell 1: ZeroDivisionError: division by zero"]


def test_an_error_on_purpose_is_none(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("purpose.ipynb", "1 / 0", tags=("raises-exception",)))
    notebook.run_all()
    assert notebook.cell_errors() == []


def test_an_error_in_the_console_is_seen(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("console.ipynb", BROKEN))
    notebook.run_all()
    notebook.page.wait_for_timeout(1000)
    assert any("oh" in text for text in notebook.console)


def test_a_cell_far_below_is_scrolled_into_view(open_notebook, write_notebook):
    notebook = open_notebook(write_notebook("long.ipynb", *(f"print('cell {n}\\n' * 20)" for n in range(1, 30))))
    notebook.run_all()
    assert notebook.cells_showing("cell 29") == [29]
    expect(notebook.output(29).get_by_text("cell 29").last).to_be_visible()
