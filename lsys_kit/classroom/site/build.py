"""The course as static pages: one HTML file for each notebook and a first page, with no address outside them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from tqdm import tqdm

from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.lessons.declared import declared, names
from lsys_kit.classroom.site.cells import title_of
from lsys_kit.classroom.site.pages import INDEX, Entry, index_page, notebook_page
from lsys_kit.classroom.site.running import read_notebook, run_all
from lsys_kit.errors import ModelFileError, quotable
from lsys_kit.files import made_by_the_kit, save_file


def build_site(folder: str | Path, source: Path | None = None) -> tuple[Path, ...]:
    """Write the course into a folder as pages that need neither Python nor a network.

    Parameters
    ----------
    folder
        The folder; it is made if necessary. Pages of an older site in it are replaced, and nothing else.
    source
        Where the course comes from; by default what came with the kit.

    Returns
    -------
    tuple of Path
        The pages, the first one first.

    Raises
    ------
    ModelFileError
        Something that the kit did not make stands where a page belongs, or the folder cannot be written to.
    LSystemError
        A cell of a lesson fails, or a package is missing.
    """
    folder = Path(folder)
    files = {name: path for name, path in course_files(source).items() if name.endswith(".ipynb")}
    stored = {name: read_notebook(path) for name, path in files.items()}
    told = {f"notebooks/{each}.ipynb": declared(each) for each in names()}
    entries = [Entry(name, title_of(stored[name].cells, name), told.get(name)) for name in files]
    places = {INDEX: folder / INDEX, **{each.name: folder / each.page for each in entries}}
    _make_room(folder, places)
    save_file(places[INDEX], index_page(entries).encode())
    known = {each.name: each for each in entries}
    for name, notebook in _run(files, stored):
        save_file(places[name], notebook_page(known[name], notebook.cells, entries).encode())
    return tuple(places.values())


def _run(files: Mapping[str, Path], stored: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """The notebooks: exercises as they are stored, all others run; how many are done is shown."""
    exercises = {name for name in files if name.startswith("exercises/")}
    with tqdm(total=len(files), desc="pages", unit="page") as bar:
        for name in exercises:
            yield name, stored[name]
            bar.update()
        for name, notebook in run_all({name: path for name, path in files.items() if name not in exercises}):
            yield name, notebook
            bar.update()


def _make_room(folder: Path, places: Mapping[str, Path]) -> None:
    """Make the folders of the pages, and see before anything is run that no page would replace what the kit did not make."""
    for place in places.values():
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
        except OSError as fault:
            name = quotable(str(folder))
            raise ModelFileError(f'The site cannot be written to "{name}": {fault.strerror or fault}') from None
        if os.path.lexists(place) and not made_by_the_kit(place):
            raise ModelFileError(
                f'"{quotable(str(place))}" is there already, and was not made by the kit',
                hint="It would be lost: choose another folder, or delete it first.",
            )
