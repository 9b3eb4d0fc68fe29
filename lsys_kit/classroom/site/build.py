"""The course as static pages: one HTML file for each notebook and a first page, with no address outside them.

Lessons are run in real kernels, several at a time, so that their pages know what their panels, votes and tables hold.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from threading import Event
from types import ModuleType
from typing import TYPE_CHECKING, Any

from tqdm import tqdm

from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.handed_in import content_of
from lsys_kit.classroom.lessons.lesson import declared_in
from lsys_kit.classroom.places import course_of
from lsys_kit.classroom.site import showing
from lsys_kit.classroom.site.app import FILES as APP_FILES
from lsys_kit.classroom.site.app import app_files
from lsys_kit.classroom.site.contents import index_page
from lsys_kit.classroom.site.markdown import missing
from lsys_kit.classroom.site.pages import INDEX, LAB, Answering, Entry, notebook_page, title_of
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.files import file_errors, made_by_the_kit, save_file
from lsys_kit.translation import ENGLISH

if TYPE_CHECKING:
    from nbformat import NotebookNode


def build_site(
    folder: str | Path,
    source: Path | None = None,
    live: Answering | None = None,
    heard: Callable[[Path, int], object] = lambda page, many: None,
) -> tuple[Path, ...]:
    """Write the course into a folder as pages that need neither Python nor a network, and return them, the first one first.

    The folder is made if necessary. Pages of an older site in it are replaced, and nothing else; what the kit did not make is
    an error, as is a cell that fails. The course is by default what came with the kit. Live pages have
    somebody who answers. `heard` hears of each page that is written, and how many there will be.
    """
    folder = Path(folder)
    every, course = course_files(source), course_of(source)
    files = {name: path for name, path in every.items() if name.endswith(".ipynb")}
    stored = {name: read_notebook(path) for name, path in files.items()}
    told = {f"notebooks/{name}.ipynb": declared_in(place, name) for place, name in course.lessons}
    drawn = {name: path for name, path in every.items() if name.startswith("notebooks/pictures/")}
    command = LAB if course.is_kits else f"{LAB} --course {course.root.resolve().name}"
    command += "" if course.language == ENGLISH else f" --language {course.language}"
    spoken = {each.name: each.language for each in told.values() if each}
    entries = [
        Entry(
            name,
            title_of(stored[name].cells, name),
            told.get(name),
            course.title,
            command,
            drawn if name in told else {},
            spoken.get(Path(name).stem, ENGLISH),
        )
        for name in files
    ]
    places = {INDEX: folder / INDEX, **{each.name: folder / each.page for each in entries}}
    beside = {folder / name: content for name, content in (live.files if live else {}).items()}
    missing_files = {path: content for path, content in beside.items() if not _is_there(path, content)}
    _make_room(folder, [*places.values(), *missing_files, *(folder / name for name in (APP_FILES if beside else ()))])
    known, pictures, contents = {each.name: each for each in entries}, dict[str, str](), dict[str, bytes]()
    for name, notebook in _run(files, stored):
        contents[known[name].page] = notebook_page(known[name], notebook.cells, entries, live).encode()
        save_file(places[name], contents[known[name].page])
        heard(places[name], len(places))
        pictures.update((name, each) for each in found_in(notebook.cells, showing.SMALL))
    for path, content in missing_files.items():
        save_file(path, content)
    contents[INDEX] = index_page(entries, pictures, live, course.lead, course.is_kits).encode()
    save_file(places[INDEX], contents[INDEX])
    for name, content in app_files(course.title, live, contents).items() if live and beside else ():
        save_file(folder / name, content)
    heard(places[INDEX], len(places))
    return tuple(places.values())


def _run(files: Mapping[str, Path], stored: Mapping[str, object]) -> Iterator[tuple[str, Any]]:
    """The notebooks: exercises as they are stored, all others run; how many are done is shown."""
    exercises = {name for name in files if name.startswith("exercises/")}
    with tqdm(total=len(files), desc="pages", unit="page") as bar:
        for name in exercises:
            yield name, stored[name]
            bar.update()
        for name, notebook in run_all({name: path for name, path in files.items() if name not in exercises}):
            yield name, notebook
            bar.update()


def _is_there(path: Path, content: bytes) -> bool:
    """Whether a file is there as it would be written: those that are copied carry no mark of the kit."""
    return path.is_file() and not path.is_symlink() and path.read_bytes() == content


def _make_room(folder: Path, places: Iterable[Path]) -> None:
    """Make the folders of the pages, and see before anything is run that no page would replace what the kit did not make."""
    for place in places:
        with file_errors(f'The site cannot be written to "{quotable(str(folder))}"'):
            place.parent.mkdir(parents=True, exist_ok=True)
        if os.path.lexists(place) and not made_by_the_kit(place):
            raise ModelFileError(
                f'"{quotable(str(place))}" is there already, and was not made by the kit',
                hint="It would be lost: choose another folder, or delete it first.",
            )


_RUN_IT = "Run the lesson in JupyterLab to see which: lsys-kit lab."
SECONDS = 300
"""How long a cell may take."""
_FIRST = f"from {showing.__name__} import show_for_pages\nshow_for_pages({{!r}})"
"""The cell that is run before those of a lesson, with its name."""


def run_all(paths: Mapping[str, Path]) -> Iterator[tuple[str, object]]:
    """The notebooks of some files, by their names in the course, run, in the order in which they are finished."""
    stopped = Event()
    with ThreadPoolExecutor(max_workers=min(8, os.cpu_count() or 1)) as pool:
        tasks = {pool.submit(run, name, path, stopped): name for name, path in paths.items()}
        try:
            for task in as_completed(tasks):
                yield tasks[task], task.result()
        finally:  # what is running ends with its cell, so that no kernel is left behind
            stopped.set()
            pool.shutdown(cancel_futures=True)


def run(name: str, path: Path, stopped: Event | None = None) -> NotebookNode:
    """The notebook of a file, run in a kernel of its own, in which the kit's widgets are shown as parts of a page."""
    nbclient, _ = _libraries()
    try:
        notebook = run_through(path, stopped, until_failed=True)
    except nbclient.exceptions.CellExecutionError as failed:
        raise LSystemError(f"A cell of {name} fails: {failed.ename}: {failed.evalue}".rstrip("."), hint=_RUN_IT) from None
    for cell in notebook.cells:
        _check_shown(name, cell)
    return notebook


def run_through(path: Path, stopped: Event | None = None, until_failed: bool = False) -> NotebookNode:
    """The notebook of a file, run as for a page; cells behind one that fails are run, too, unless that is not wanted."""
    nbclient, nbformat = _libraries()
    notebook = read_notebook(path)
    notebook.cells.insert(0, nbformat.v4.new_code_cell(_FIRST.format(path.stem)))

    def unless_stopped(**_: object) -> None:
        if stopped is not None and stopped.is_set():
            raise KeyboardInterrupt

    client = nbclient.NotebookClient(
        notebook,
        timeout=SECONDS,
        allow_errors=not until_failed,
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
    except nbclient.exceptions.CellTimeoutError:
        raise LSystemError(f"A cell of {path.name} takes more than {SECONDS} seconds", hint=_RUN_IT) from None
    except nbclient.exceptions.DeadKernelError:
        raise LSystemError(f"The kernel of {path.name} has died", hint=_RUN_IT) from None
    del notebook.cells[0]
    return notebook


def _check_shown(name: str, cell: NotebookNode) -> None:
    """See that all that a cell shows is there: what fails only when it is shown does not stop a notebook."""
    outputs = cell.get("outputs", ())
    failed = [f"{each.ename}: {each.evalue}" for each in outputs if each.output_type == "error"]
    for fault in [*found_in([cell], showing.FAULT), *failed]:
        if "raises-exception" not in cell.metadata.get("tags", ()):
            shown = cell.source.strip().splitlines()[-1]
            raise LSystemError(f"A page of {name} cannot have what {quotable(shown)} shows: {fault}".rstrip("."), hint=_RUN_IT)


def found_in(cells: Sequence[NotebookNode], kind: str) -> Iterator[Any]:
    """What cells show of a media type, also within something else."""
    todo = [each.get("data", {}) for cell in reversed(cells) for each in reversed(cell.get("outputs", ()))]
    while todo:
        data = todo.pop()
        if kind in data:
            yield data[kind]
        todo += [each for each in data.values() if isinstance(each, dict)]


def read_notebook(path: Path) -> NotebookNode:
    """The notebook of a file as it is stored.

    Raises
    ------
    ModelFileError
        It is no notebook.
    """
    nbformat = _libraries()[1]
    try:
        notebook: NotebookNode = nbformat.reads(content_of(path, MOST_BYTES).decode(), as_version=4)
    except ModelFileError as fault:
        raise ModelFileError(f'"{quotable(str(path))}": {fault.message}') from None
    except Exception as fault:  # nbformat and jsonschema raise errors of their own
        reason = quotable(str(fault).splitlines()[0][:200]) if str(fault) else type(fault).__name__
        raise ModelFileError(
            f'"{quotable(str(path))}" is no notebook: {reason}', hint="Open it in Jupyter, and save it again."
        ) from None
    return notebook


MOST_BYTES = 50_000_000
"""The greatest size of a notebook."""


def _libraries() -> tuple[ModuleType, ModuleType]:
    try:
        import ipykernel  # noqa: F401
        import nbclient
        import nbformat
    except ImportError as absent:
        raise missing(absent.name or "nbclient") from None
    return nbclient, nbformat
