"""Lessons run in a real kernel, several at a time, so that their pages know what their panels, votes and tables hold."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from threading import Event
from typing import Any

from lsys_kit.classroom.site import showing
from lsys_kit.classroom.site.markdown import missing
from lsys_kit.errors import LSystemError

SECONDS = 300
"""How long a cell may take."""
_FIRST = f"from {showing.__name__} import show_for_pages\nshow_for_pages({{!r}})"
"""The cell that is run before those of a lesson, with its name."""


def run_all(paths: Mapping[str, Path]) -> Iterator[tuple[str, Any]]:
    """The notebooks of some files, run, in the order in which they are finished.

    Parameters
    ----------
    paths
        The files by their names in the course.

    Raises
    ------
    LSystemError
        A cell fails, or what runs notebooks is not installed.
    """
    stopped = Event()
    with ThreadPoolExecutor(max_workers=min(8, os.cpu_count() or 1)) as pool:
        tasks = {pool.submit(run, name, path, stopped): name for name, path in paths.items()}
        try:
            for task in as_completed(tasks):
                yield tasks[task], task.result()
        finally:  # what is running ends with its cell, so that no kernel is left behind
            stopped.set()
            pool.shutdown(cancel_futures=True)


def run(name: str, path: Path, stopped: Event | None = None) -> Any:
    """The notebook of a file, run in a kernel of its own, in which the kit's widgets are shown as parts of a page."""
    nbclient, nbformat = _libraries()
    notebook = nbformat.read(path, as_version=4)
    notebook.cells.insert(0, nbformat.v4.new_code_cell(_FIRST.format(path.stem)))

    def unless_stopped(**_: Any) -> None:
        if stopped is not None and stopped.is_set():
            raise KeyboardInterrupt

    client = nbclient.NotebookClient(
        notebook,
        timeout=SECONDS,
        kernel_name="python3",
        store_widget_state=False,
        extra_arguments=["--log-level=ERROR"],
        on_cell_start=unless_stopped,
        resources={"metadata": {"path": str(path.parent)}},
    )
    environment = {**os.environ, "TQDM_DISABLE": "1"}
    try:
        try:
            client.execute(env=environment)
        except nbclient.exceptions.DeadKernelError:
            raise
        except RuntimeError:  # the kernel did not start: another program took one of its ports before it could
            client.execute(env=environment)
    except nbclient.exceptions.CellExecutionError as failed:
        raise LSystemError(
            f"A cell of {name} fails: {failed.ename}: {failed.evalue}",
            hint="Run the lesson in JupyterLab to see which: lsys-kit lab.",
        ) from None
    del notebook.cells[0]
    return notebook


def read_notebook(path: Path) -> Any:
    """The notebook of a file as it is stored."""
    return _libraries()[1].read(path, as_version=4)


def _libraries() -> tuple[Any, Any]:
    try:
        import ipykernel  # noqa: F401
        import nbclient
        import nbformat
    except ImportError as absent:
        raise missing(absent.name or "nbclient") from None
    return nbclient, nbformat
