"""Run every notebook of the course and store what it shows, so that the stored file is the same from whatever machine.

    python -m tests.notebooks.rebuild [NOTEBOOK ...]

What differs from run to run and tells a reader nothing is taken out: timings, who ran it, numbers of widgets drawn by lot,
the paths in a traceback. What a picture's bytes say beyond its pixels is left as it was stored.
"""

from __future__ import annotations

import base64
import io
import json
import os
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbformat import NotebookNode

from lsys_kit.classroom.course import COURSE_PARTS

ROOT = Path(__file__).resolve().parent.parent.parent
SECONDS = 300
"""For each cell."""
WIDGET = "application/vnd.jupyter.widget-view+json"
PICTURE = "image/png"
METADATA = {
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
CELL_METADATA = ("deletable", "editable", "jupyter", "nbgrader", "tags")
"""What a cell's metadata may say; the rest is how somebody's screen looked."""


def notebooks() -> list[Path]:
    """All notebooks of the course."""
    return sorted(path for folder in COURSE_PARTS for path in (ROOT / folder).glob("*.ipynb"))


def rebuilt(path: Path) -> str:
    """The text of a notebook, run again where it stands."""
    stored = nbformat.read(path, as_version=4)
    run = nbformat.from_dict(json.loads(json.dumps(stored)))
    os.environ["TQDM_DISABLE"] = "1"  # a progress bar says how busy the machine was
    NotebookClient(
        run,
        timeout=SECONDS,
        kernel_name="python3",
        store_widget_state=False,
        record_timing=False,
        resources={"metadata": {"path": str(path.parent)}},
    ).execute()
    return normalised(run, stored)


def normalised(run: NotebookNode, stored: NotebookNode | None = None) -> str:
    """The text of a notebook that was run: equal for equal content.

    Parameters
    ----------
    run
        The notebook; it is changed.
    stored
        As it was before, from which pictures with the same pixels are kept.
    """
    run.metadata = nbformat.from_dict(METADATA)
    run.nbformat, run.nbformat_minor = 4, 5
    pictures = dict(_pictures(stored)) if stored else {}
    for cell in run.cells:
        cell.metadata = nbformat.from_dict({name: cell.metadata[name] for name in CELL_METADATA if name in cell.metadata})
    for number, cell in enumerate((cell for cell in run.cells if _was_run(cell)), 1):
        _count(cell, number)
        cell.outputs = [_normal(output) for output in _merged(cell.outputs)]
    for place, output in _pictures_of(run):
        if place in pictures and same_pixels(pictures[place], output.data[PICTURE]):
            output.data[PICTURE] = pictures[place]
    nbformat.validate(run)
    return _renamed(nbformat.writes(run, version=4)) + "\n"


def same_pixels(one: str, other: str) -> bool:
    """Whether two pictures, PNG in base64, show the same."""
    return one == other or _pixels(one) == _pixels(other)


def _was_run(cell: NotebookNode) -> bool:
    return bool(cell.cell_type == "code" and cell.execution_count is not None)


def _count(cell: NotebookNode, number: int) -> None:
    """Number a cell, and its result with it."""
    cell.execution_count = number
    for output in cell.outputs:
        if output.output_type == "execute_result":
            output.execution_count = number


def _merged(outputs: list[NotebookNode]) -> Iterator[NotebookNode]:
    """The outputs, with the pieces of a stream in which it happened to arrive put together."""
    before = None
    for output in outputs:
        if before is not None and output.output_type == before.output_type == "stream" and output.name == before.name:
            before.text += output.text
        else:
            before = output
            yield output


def _normal(output: NotebookNode) -> NotebookNode:
    """An output without metadata; of an error only what it says."""
    if "metadata" in output:
        output.metadata = nbformat.from_dict({})
    if output.output_type == "error":
        output.traceback = [f"{output.ename}: {output.evalue}"]
    return output


def _renamed(text: str) -> str:
    """The notebook with its widgets' ids numbered in the order in which they appear."""
    found = dict.fromkeys(re.findall(r'"model_id": "([0-9a-f]{32})"', text))
    for number, known in enumerate(found, 1):
        text = text.replace(known, f"{number:032x}")
    return text


def _pictures_of(notebook: NotebookNode) -> Iterator[tuple[tuple[str, int], NotebookNode]]:
    """The outputs that are pictures, each with its cell's id and its number there."""
    for cell in notebook.cells:
        shown = (output for output in cell.get("outputs", []) if PICTURE in output.get("data", {}))
        for number, output in enumerate(shown):
            yield (cell.id, number), output


def _pictures(notebook: NotebookNode) -> Mapping[tuple[str, int], str]:
    return {place: output.data[PICTURE] for place, output in _pictures_of(notebook)}


def _pixels(picture: str) -> tuple[tuple[int, int], bytes]:
    from PIL import Image

    with Image.open(io.BytesIO(base64.b64decode(picture))) as image:
        return image.size, image.convert("RGBA").tobytes()


def main(paths: list[str]) -> None:
    """Rebuild the notebooks that are named, else all; say which changed."""
    for path in map(Path, paths) if paths else notebooks():
        before, after = path.read_text("utf-8"), rebuilt(path)
        path.write_text(after, "utf-8", newline="\n")
        print(f"{path}: {'as before' if before == after else 'changed'}")


if __name__ == "__main__":
    main(sys.argv[1:])
