"""A notebook on a code host shows what it would show if it were run now: rebuilding it changes no byte."""

from __future__ import annotations

import base64
import io
import json
from difflib import unified_diff
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from tests.notebooks.rebuild import ROOT, WIDGET, normalised, notebooks, rebuilt, same_pixels


def png(colour: str, **texts: str) -> str:
    """A small picture in base64, with some texts that nobody sees."""
    info, file = PngInfo(), io.BytesIO()
    for name, text in texts.items():
        info.add_text(name, text)
    Image.new("RGB", (3, 2), colour).save(file, "PNG", pnginfo=info)
    return base64.b64encode(file.getvalue()).decode()


def noted(widget: str, picture: str, count: int, minute: str) -> nbformat.NotebookNode:
    """A notebook as somebody's machine leaves it."""
    view = {"model_id": widget, "version_major": 2, "version_minor": 0}
    outputs = [
        new_output("stream", name="stdout", text="one\n"),
        new_output("stream", name="stdout", text="two\n"),
        new_output(
            "execute_result",
            {"text/plain": "a picture", PNG: picture, WIDGET: view},
            execution_count=count,
            metadata={"needs_background": "light"},
        ),
        new_output("error", ename="ModelSyntaxError", evalue="An arrow is missing", traceback=[f"/home/{widget}/x.py", "..."]),
    ]
    cell = new_code_cell(
        "draw()",
        execution_count=count,
        outputs=outputs,
        id="drawing",
        metadata={"execution": {"iopub.status.busy": minute}, "scrolled": True, "tags": ["raises-exception"]},
    )
    title, empty = new_markdown_cell("# Title", id="title", metadata={"collapsed": minute}), new_code_cell("", id="empty")
    metadata = {"language_info": {"name": "python", "version": minute}, "widgets": {"state": {widget: minute}}}
    return new_notebook(cells=[title, empty, cell], metadata=metadata)


PNG = "image/png"
HERE = ("0123456789abcdef" * 2, png("red", Software="one"), 7, "08:15")
THERE = ("fedcba9876543210" * 2, png("red", Software="another"), 31, "23:59")


def cells(text: str) -> dict[str, Any]:
    return {cell["id"]: cell for cell in json.loads(text)["cells"]}


def test_the_same_notebook_from_two_machines_is_the_same_file():
    stored = noted(*HERE)
    assert normalised(noted(*THERE), stored) == normalised(noted(*HERE))


def test_what_is_normal_stays_as_it_is():
    once = normalised(noted(*HERE))
    assert normalised(nbformat.reads(once, 4)) == once


def test_what_a_reader_sees_is_kept():
    cell = cells(normalised(noted(*HERE)))["drawing"]
    stream, result, error = cell["outputs"]
    assert "".join(stream["text"]) == "one\ntwo\n"
    assert result["data"]["text/plain"] == ["a picture"]
    assert result["data"][WIDGET]["model_id"] == f"{1:032x}"
    assert error["traceback"] == ["ModelSyntaxError: An arrow is missing"]
    assert cell["metadata"] == {"tags": ["raises-exception"]}
    assert (cell["execution_count"], result["execution_count"]) == (1, 1)


def test_a_picture_with_other_pixels_is_stored_anew():
    stored, changed = noted(*HERE), (HERE[0], png("blue"), *HERE[2:])
    picture = cells(normalised(noted(*changed), stored))["drawing"]["outputs"][1]["data"][PNG]
    assert same_pixels("".join(picture), png("blue"))
    assert not same_pixels(png("blue"), png("red"))


def test_a_cell_with_another_id_takes_no_picture():
    stored = noted(*HERE)
    stored.cells[2].id = "another"
    assert "".join(cells(normalised(noted(*THERE), stored))["drawing"]["outputs"][1]["data"][PNG]).strip() == THERE[1]


@pytest.mark.slow
@pytest.mark.usefixtures("kernels")
def test_a_notebook_is_run_where_it_stands(tmp_path: Path):
    (tmp_path / "note.txt").write_text("from beside")
    notebook = new_notebook(cells=[new_code_cell("print(open('note.txt').read())\n1 + 1", id="sum")])
    (tmp_path / "small.ipynb").write_text(nbformat.writes(notebook))
    text = rebuilt(tmp_path / "small.ipynb")
    stream, result = cells(text)["sum"]["outputs"]
    assert stream["text"] == ["from beside\n"]
    assert result["data"] == {"text/plain": ["2"]}
    (tmp_path / "small.ipynb").write_text(text)
    assert rebuilt(tmp_path / "small.ipynb") == text


def test_there_are_lessons_exercises_and_references():
    assert {path.parent.name for path in notebooks()} == {"notebooks", "exercises", "reference"}


@pytest.mark.slow
@pytest.mark.usefixtures("kernels")
@pytest.mark.parametrize("path", notebooks()[::4], ids=lambda path: str(path.relative_to(ROOT)))  # nbval runs each
def test_rebuilding_changes_no_byte(path: Path):
    before, after = path.read_bytes().decode(), rebuilt(path)
    changes = unified_diff(before.split("\n"), after.split("\n"), "stored", "rebuilt", n=1, lineterm="")
    assert before == after, "\n".join(line[:120] for line in changes)
