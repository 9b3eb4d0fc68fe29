"""The commands of the shell: what each does with its options, and how it finds the system that they name."""

from __future__ import annotations

import argparse
import importlib.util
import json
import sys
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from lsys_kit.budget import current
from lsys_kit.decoding import decoded
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelNameError, ModelValueError, quotable
from lsys_kit.files import create_file

if TYPE_CHECKING:
    from lsys_kit.derivation.derive import Derivation
    from lsys_kit.notation.model.cellworks import CellworkSystem
    from lsys_kit.notation.model.maps import MapSystem
    from lsys_kit.notation.model.system import LSystem
    from lsys_kit.pictures.films import Film
    from lsys_kit.pictures.picture import Picture

STEPS = 5
"""The number of steps drawn by default, if the system has none of its own."""
FILMS = (".gif", ".apng")
"""The suffixes of files with several pictures."""
MOST_NEIGHBOURS = 1_000
"""How many files beside a missing one are searched for a similar name."""


def list_systems(_: argparse.Namespace) -> None:
    """Print the catalogue: ids, names and titles, under the works from which the systems come."""
    from lsys_kit import cellwork_systems, map_systems, systems

    print(f"{systems()!r}\n\nMap systems\n{map_systems()!r}\n\nCellwork systems\n{cellwork_systems()!r}")


def print_words(options: argparse.Namespace) -> None:
    """Print the words of the steps, or their numbers of modules."""
    steps = _counted(options) if options.counts else _derived(options)
    if options.json:
        rows = [json.dumps(step, ensure_ascii=False) for step in steps]
        print("[\n" + ",\n".join(rows) + "\n]")
    else:
        for step in steps:
            print(step["modules" if options.counts else "word"])


def _counted(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    """Each step with its number of modules; words are built only where contexts or chance matter."""
    from lsys_kit.derivation.core.states import States
    from lsys_kit.derivation.derive import lengths

    system = _system_with_constants(options)
    counts = lengths(system, options.steps, arithmetic=options.arithmetic) if States(system).traits.d0l else \
        _derivation(system, options).lengths
    digits = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)  # while they are written
    try:
        for step, modules in enumerate(counts):
            yield {"step": step, "modules": modules}
    finally:
        sys.set_int_max_str_digits(digits)


def _derived(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    """Each step with its number of modules, and its word."""
    for step, word in enumerate(_derivation(_system_with_constants(options), options)):
        yield {"step": step, "modules": len(word), "word": str(word)}


def _derivation(system: LSystem, options: argparse.Namespace) -> Derivation:
    """The derivation; if a step is too large, the error says what can be typed instead."""
    from lsys_kit.derivation.derive import Derivation
    from lsys_kit.worlds.derive import derive

    try:
        steps = next(steps for steps in (options.steps, system.steps, STEPS) if steps is not None)
        return derive(system, steps, seed=options.seed, arithmetic=options.arithmetic)
    except ModelLimitError as mistake:
        if not isinstance(mistake.partial, Derivation):
            raise
        counting = "; derive --counts counts the modules of any step" if mistake.partial.states.traits.d0l else ""
        hint = f"Use -n {mistake.partial.steps} or less{counting}."
        raise ModelLimitError(mistake.message, limit=mistake.limit, needed=mistake.needed, hint=hint) from None


def draw_word(options: argparse.Namespace) -> None:
    """Write a picture of a word, of maps or of a cellwork, or a film of the steps, and print what it shows."""
    from lsys_kit.classroom.catalogue import cellwork_system, is_cellwork_system, is_map_system, map_system
    from lsys_kit.pictures.draw import draw
    from lsys_kit.pictures.films import animate

    if is_map_system(options.system) or is_cellwork_system(options.system):
        cells = map_system(options.system) if is_map_system(options.system) else cellwork_system(options.system)
        picture = draw(cells, options.steps)
        picture.save(options.output)
        print(picture)
        return
    words = _derivation(_system_with_constants(options), options)
    if Path(options.output).suffix.lower() in FILMS:
        shown: Picture | Film = animate(words, angle=options.angle, seconds=options.seconds)
    else:
        shown = draw(words, angle=options.angle)
    shown.save(options.output)
    print(shown)


def draw_stages(options: argparse.Namespace) -> None:
    """Write a picture of the stage diagram, and print what it shows."""
    from lsys_kit.derivation.petri.stages import stages
    from lsys_kit.pictures.draw import draw

    system = _system_with_constants(options)
    word = None if options.steps is None else _derivation(system, options)[-1]
    picture = draw(stages(system, durations=options.durations), tokens=word)
    picture.save(options.output)
    print(picture)


def convert(options: argparse.Namespace) -> None:
    """Print a system in another notation, or write it into a new file; the notes of its reader go to the error stream."""
    from lsys_kit.notation.write import write

    system = _named_system(options.system, options.notation, options.name)
    text = write(system, options.to)
    if options.output is not None:
        _keep(f"{text}\n", options.output)
    for note in system.notes:
        print(f"lsys-kit: note: {note}", file=sys.stderr)
    print(text if options.output is None else f"Written to {quotable(options.output)} in the notation {options.to}.")


def print_link(options: argparse.Namespace) -> None:
    """Print the address of a model with its settings, and perhaps write it as a QR code."""
    from lsys_kit.classroom.link import link
    from lsys_kit.pictures.qr_codes import qr_code

    system = _system_or_cells(options)
    own = {"step": options.steps, "angle": options.angle, "seed": options.seed}
    settings = {name: value for name, value in own.items() if value is not None} | dict(options.settings)
    address = link(system, settings, options.base)
    if options.qr is not None:
        qr_code(address).save(options.qr)
    print(address)


def write_page(options: argparse.Namespace) -> None:
    """Write the panel of a system into an HTML file that needs no kernel, and print what it shows first."""
    from lsys_kit.classroom.panel.opened.kinds import opened
    from lsys_kit.classroom.panel.opened.opened import Viewing
    from lsys_kit.classroom.panel.page import page, save_page

    system, (id, title) = _system_or_cells(options), _titles(options.system)
    what, seed = opened(system, id, dict(options.settings)), options.seed or getattr(system, "seed", None) or 0
    first = what.steps if options.steps is None else options.steps
    chosen = Viewing(first, what.first, seed, what.turned(options.angle), *what.side)
    data = what.page_data(chosen)
    sight = what.sight(replace(chosen, step=data["model"]["step"]))
    save_page(options.output, page(title or what.kind, data, str(sight)))
    print(f"{sight} {data['model']['fixed']}".strip())


def _titles(name: str) -> tuple[str, str]:
    """The id of a system of the catalogue, if it is one, and what its page is called."""
    from lsys_kit.classroom.catalogue import entry
    from lsys_kit.notation.fragments import is_link

    try:
        known = entry(name)
    except ModelNameError:
        return "", "" if name == "-" or is_link(name) else Path(name).stem
    return known.id, f"{known.id}: {known.title}"


def check_exercises(options: argparse.Namespace) -> None:
    """Print what is wrong with the exercises in a folder."""
    from lsys_kit.classroom.exercises.declarations import QUESTIONS
    from lsys_kit.classroom.exercises.lint import problems_in

    problems = problems_in(options.folder or QUESTIONS)
    for problem in problems:
        print(problem)
    if problems:
        raise ModelFileError(f"{len(problems)} mistake{'s' * (len(problems) > 1)} in the exercises",
                             hint="Each line above says where one is and what to try.")
    print("No mistakes.")


def write_exercises(options: argparse.Namespace) -> None:
    """Write the notebooks of the exercises in a folder."""
    from lsys_kit.classroom.exercises.notebooks import write_notebooks

    for path in write_notebooks(options.output, options.folder):
        print(path)


def write_site(options: argparse.Namespace) -> None:
    """Write the course as static pages."""
    from lsys_kit.classroom.site.build import build_site

    pages = build_site(options.output)
    print(f"{len(pages)} pages are written. Open {quotable(str(pages[0]))} in a browser.")


def open_lab(options: argparse.Namespace) -> None:
    """Copy the course and open it in JupyterLab."""
    from lsys_kit.classroom.course import FOLDER, copy_course, copy_report

    folder = Path(options.folder or FOLDER)
    copied = copy_course(folder)
    print(copy_report(folder, copied), flush=True)
    if importlib.util.find_spec("jupyterlab") is None:
        raise LSystemError("JupyterLab is not installed", hint="Install it with: pip install 'lsys-kit[lab]'")
    from jupyterlab.labapp import LabApp

    # In a container everybody is root; the server answers this machine alone, and asks for its token.
    LabApp.launch_instance(["--ServerApp.allow_root=True", f"--ServerApp.root_dir={folder.resolve()}",
                            f"--LabApp.default_url=/lab/tree/{copied[0].name}"])


def _system_with_constants(options: argparse.Namespace) -> LSystem:
    """The system that the command line names, with its constants set."""
    from lsys_kit.derivation.core.rules import constants_of, number_from
    from lsys_kit.notation.model.expressions import Number

    system, values = _named_system(options.system, options.notation, options.name), dict(options.settings)
    constants_of(system, values)
    return replace(system, constants=tuple(
        replace(constant, value=Number(number_from(values[constant.name]))) if constant.name in values else constant
        for constant in system.constants))


def _system_or_cells(options: argparse.Namespace) -> LSystem | MapSystem | CellworkSystem:
    """The system that the command line names, or the map or cellwork system of the catalogue."""
    from lsys_kit.classroom.catalogue import cellwork_system, is_cellwork_system, is_map_system, map_system

    if is_cellwork_system(options.system):
        return cellwork_system(options.system)
    return map_system(options.system) if is_map_system(options.system) else \
        _named_system(options.system, options.notation, options.name)


def _named_system(name: str, notation: str | None, entry: str | None) -> LSystem:
    """The system of a link, or of the catalogue with this id or name; else that in the file of this name, or an entry."""
    from lsys_kit.classroom.catalogue import system
    from lsys_kit.notation.fragments import is_link
    from lsys_kit.notation.read import read
    from lsys_kit.notation.write import write

    if name == "-":
        return read(_decoded(sys.stdin.buffer, "the standard input"), notation, entry)
    if is_link(name):
        return read(name, notation, entry)
    try:
        found = system(name)
    except ModelNameError:
        return _system_in(name, notation, entry)
    if entry is not None:
        raise ModelValueError(f"{name} is one system of the catalogue", hint="Leave out --name.")
    if notation is not None:
        write(found, notation)  # raises an error that says what the notation lacks
        return replace(found, notation=notation)
    return found


def _system_in(name: str, notation: str | None, entry: str | None) -> LSystem:
    """The system in a file; where none can be read, the file's name may hint at another format."""
    from lsys_kit.notation.foreign import name_hint
    from lsys_kit.notation.read import read

    text = _file(name)
    try:
        return read(text, notation, entry)
    except LSystemError as error:
        hint = name_hint(name)
        if hint and "which the kit does not read" not in error.message:
            error.with_hint(f"{error.hint or ''} {hint}".strip())
        raise


def _file(name: str) -> str:
    """The text of a model file."""
    try:
        with Path(name).open("rb") as file:
            return _decoded(file, f'"{quotable(name)}"')
    except FileNotFoundError:
        raise ModelFileError(f'There is no file "{quotable(name)}", and no system of that name in the catalogue',
                             hint=_likely_name(name)) from None
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{quotable(name)}" cannot be read: {getattr(fault, "strerror", None) or fault}') from None


def _keep(text: str, name: str) -> None:
    """Write a text into a new file."""
    try:
        create_file(Path(name), text.encode())
    except FileExistsError:
        raise ModelFileError(f'"{quotable(str(Path(name)))}" already exists',
                             hint="Files are never overwritten: choose another name.") from None
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{quotable(name)}" cannot be written: {getattr(fault, "strerror", None) or fault}') from None


def _decoded(file: BinaryIO, name: str) -> str:
    """The text of a file, up to a little more than a model may have."""
    most = 4 * current().text + 4
    return decoded(file.read(most), name, most)


def _likely_name(name: str) -> str:
    """A hint at what was probably meant: a file in the same folder, or a system of the catalogue."""
    from lsys_kit.classroom.catalogue import likely_system, systems

    folder = Path(name).parent
    beside = [str(path) for path in islice(folder.iterdir(), MOST_NEIGHBOURS)] if folder.is_dir() else []
    return likely_system(name, beside) or f"Catalogue ids are {', '.join(systems())}."
