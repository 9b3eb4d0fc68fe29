"""What the commands of the shell do: about a model, for a class, and about the course.

A command runs in a process of its own with hard limits: what its budget cannot see ends all the same. A command about one model
has time and memory. What works on a folder of them has memory alone: each piece has its own time. The laboratory runs other
programs for as long as they are wanted, and has neither.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import signal
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import groupby, islice
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any, BinaryIO

from lsys_kit.budget import Task, check_bytes, counted, current, limits, processor_time
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelNameError, ModelValueError, quotable
from lsys_kit.files import create_file, decoded, file_errors, file_stem

if TYPE_CHECKING:
    from lsys_kit.classroom.places import Course
    from lsys_kit.derivation.derive import Choices, Derivation
    from lsys_kit.notation.model.system import LSystem
    from lsys_kit.notation.read import AnySystem
    from lsys_kit.pictures.draw import AnyPicture
    from lsys_kit.pictures.films import Film


MOST_NEIGHBOURS = 1_000
"""How many files beside a missing one are searched for a similar name."""


def system_with_constants(options: argparse.Namespace) -> LSystem:
    from lsys_kit.derivation.core.rules import with_constants

    return with_constants(named_system(options.system, options.notation, options.name), dict(options.settings))


def system_or_cells(options: argparse.Namespace) -> AnySystem:
    """The system that the command line names, or the map or cellwork system of the catalogue."""
    from lsys_kit.classroom.catalogue import cell_system

    return cell_system(options.system) or named_system(options.system, options.notation, options.name)


def named_system(name: str, notation: str | None, entry: str | None) -> LSystem:
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

    with file_errors(f'"{quotable(name)}" cannot be read'):
        packed = Path(name).is_dir() or name.lower().endswith(".zip")
    if packed:
        return read(Path(name), notation, entry)
    text = _file(name)
    try:
        return read(text, notation, entry)
    except LSystemError as error:
        hint = name_hint(name)
        if hint and "which the kit does not read" not in error.message:
            error.with_hint(f"{error.hint or ''} {hint}".strip())
        raise


def _file(name: str) -> str:
    with file_errors(f'"{quotable(name)}" cannot be read'):
        try:
            with Path(name).open("rb") as file:
                return _decoded(file, f'"{quotable(name)}"')
        except FileNotFoundError:
            raise ModelFileError(
                f'There is no file "{quotable(name)}", and no system of that name in the catalogue', hint=_likely_name(name)
            ) from None


def _decoded(file: BinaryIO, name: str) -> str:
    """The text of a file, up to a little more than a model may have."""
    most = 4 * current().text + 4
    return decoded(file.read(most), name, most)


def _likely_name(name: str) -> str:
    from lsys_kit.classroom.catalogue import likely_system, systems

    folder = Path(name).parent
    beside = [str(path) for path in islice(folder.iterdir(), MOST_NEIGHBOURS)] if folder.is_dir() else []
    return likely_system(name, beside) or f"Catalogue ids are {', '.join(systems())}."


_BASE = 'Give one with --base: where the page of this model stands that "lsys-kit page" makes.'
BITS_A_DIGIT = 3
"""A digit says at least so many bits of a number."""


def list_systems(_: argparse.Namespace) -> None:
    """Print the catalogue: ids, names and titles, under the works from which the systems come."""
    from lsys_kit import book_systems, cellwork_systems, map_systems, systems

    print(f"{systems()!r}\n{book_systems()!r}\n\nMap systems\n{map_systems()!r}\n\nCellwork systems\n{cellwork_systems()!r}")


def print_words(options: argparse.Namespace) -> None:
    steps = _counted(options) if options.counts else _derived(options)
    with Task("The steps were not all printed"):
        if options.json:
            rows = [*_held(json.dumps(step, ensure_ascii=False) for step in counted(steps))]
            print("[\n" + ",\n".join(rows) + "\n]")
        else:
            for step in counted(steps):
                print(step["modules" if options.counts else "word"])


def _held(rows: Iterable[str]) -> Iterator[str]:
    """The same rows of text, as long as there is room for all of them, and for one text of them."""
    size = 0
    for row in rows:
        size += 2 * len(row)
        check_bytes(size, lambda: "The steps were not all printed")
        yield row


def _counted(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    """Each step with its number of modules; words are built only where contexts or chance matter."""
    from lsys_kit.derivation.core.states import States
    from lsys_kit.derivation.derive import lengths

    system = system_with_constants(options)
    counts = (
        lengths(system, options.steps, arithmetic=options.arithmetic)
        if States(system).traits.d0l
        else _derivation(system, options).lengths
    )
    digits, written = sys.get_int_max_str_digits(), 0
    sys.set_int_max_str_digits(0)  # while they are written
    try:
        for step, modules in enumerate(counts):
            written += modules.bit_length() // BITS_A_DIGIT
            check_bytes(written, lambda: "The steps were not all counted")
            yield {"step": step, "modules": modules}
    finally:
        sys.set_int_max_str_digits(digits)


def _derived(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    from lsys_kit.derivation.core.letters import conditions_text

    derivation = _derivation(system_with_constants(options), options)
    for step, word in enumerate(derivation):
        yield {"step": step, "modules": len(word), "word": str(word)}
    if held := conditions_text(derivation.states):
        print(f"lsys-kit: note: {held}", file=sys.stderr)


def _derivation(system: LSystem, options: argparse.Namespace) -> Derivation:
    """The derivation; if a step is too large, the error says what can be typed instead."""
    from lsys_kit.derivation.derive import Derivation
    from lsys_kit.notation.model.system import USUAL_STEPS
    from lsys_kit.worlds.derive import derive

    try:
        steps = next(steps for steps in (options.steps, system.steps, USUAL_STEPS) if steps is not None)
        letters = getattr(options, "letters", ())
        return derive(system, steps, seed=options.seed, arithmetic=options.arithmetic, letters=letters)
    except ModelLimitError as mistake:
        if not isinstance(mistake.partial, Derivation):
            raise
        counting = "; derive --counts counts the modules of any step" if mistake.partial.states.traits.d0l else ""
        hint = f"Use -n {mistake.partial.steps} or less{counting}."
        raise ModelLimitError(mistake.message, limit=mistake.limit, needed=mistake.needed, hint=hint) from None


def draw_word(options: argparse.Namespace) -> None:
    """Write a picture of a word, of maps or of a cellwork, or a film of the steps, and print what it shows."""
    from lsys_kit.classroom.catalogue import cell_system
    from lsys_kit.pictures.draw import draw
    from lsys_kit.pictures.films import animate

    film, seen = _film(options), _seen(options)
    make: Callable[..., AnyPicture | Film] = partial(animate, **film) if film else draw
    if cells := cell_system(options.system):
        shown = make(cells, options.steps, **seen)
    elif options.seeds or isinstance(options.steps, list):
        steps = {"steps": options.steps} if isinstance(options.steps, list) else {"n": options.steps}
        chosen = {"seed": options.seed, "arithmetic": options.arithmetic, "angle": options.angle, "seeds": options.seeds or ()}
        shown = draw(system_with_constants(options), **chosen, **steps, **seen)
    else:
        shown = make(_derivation(system_with_constants(options), options), angle=options.angle, seed=options.seed, **seen)
    _save(shown, options)


def _film(options: argparse.Namespace) -> Choices:
    from lsys_kit.pictures.formats.notebook import FILMS

    turntable = getattr(options, "turntable", False)
    if Path(options.output).suffix.lower() not in FILMS and not turntable:
        return {}
    if options.dpi is not None:
        raise ModelValueError("A film has no dots per inch", hint="Choose its size in pixels: --size 1200.")
    return {"seconds": options.seconds} | ({"turntable": True} if turntable else {})


def _save(shown: AnyPicture | Film, options: argparse.Namespace) -> None:
    shown.save(options.output, **({} if options.dpi is None else {"dpi": options.dpi}))
    print(shown)


def _seen(options: argparse.Namespace) -> Choices:
    """The side from which something is seen, the size of the picture and how it looks, as far as they are given."""
    size = options.size[0] if options.size and len(options.size) == 1 else options.size
    given = {"view": options.view, "size": size, **_looks(options)}
    return {name: value for name, value in given.items() if value is not None}


def _looks(options: argparse.Namespace) -> Choices:
    from lsys_kit.pictures.options import OPTIONS

    return {name: getattr(options, name) for name in OPTIONS}


def draw_stages(options: argparse.Namespace) -> None:
    """Write a picture of the stage diagram, or a film of its tokens, and print what it shows."""
    from lsys_kit.derivation.petri.pnml import played_otherwise
    from lsys_kit.derivation.petri.stages import stages
    from lsys_kit.pictures.draw import draw
    from lsys_kit.pictures.films import animate

    system = system_with_constants(options)
    net, film = stages(system, durations=options.durations, unfold=options.unfold), _film(options)
    word = None if options.steps is None or film else _derivation(system, options)[-1]
    looks = _looks(options)
    _save(animate(net, options.steps, **film, **looks) if film else draw(net, tokens=word, **looks), options)
    otherwise = played_otherwise(net) if Path(options.output).suffix.lower() == ".pnml" else ""
    if otherwise:
        print(f"lsys-kit: note: {otherwise}", file=sys.stderr)


def print_inferred(options: argparse.Namespace) -> None:
    """Print the systems that fit words, or why none does."""
    from lsys_kit.derivation.inference.infer import infer, infer_stochastic

    if len(options.context) != 2:
        raise ModelValueError("The context is two whole numbers, as in --context 1,0")
    text = _decoded(sys.stdin.buffer, "the standard input") if options.words == "-" else _words_file(options.words)
    lines = [line.strip() for line in text.strip("\n").split("\n")]
    if options.stochastic:
        derivations = [[*group] for filled, group in groupby(lines, bool) if filled]
        print(infer_stochastic(derivations, options.constants, options.erasing))
        return
    words = [line for line in lines if line or options.erasing]
    print(infer(words, options.constants, options.erasing, tuple(options.context)))


def _words_file(name: str) -> str:
    with file_errors(f'"{quotable(name)}" cannot be read'), Path(name).open("rb") as file:
        return _decoded(file, f'"{quotable(name)}"')


def convert(options: argparse.Namespace) -> None:
    from lsys_kit.notation.write import write

    system = named_system(options.system, options.notation, options.name)
    text = write(system, options.to, interpretation=not options.no_interpretation)
    if options.output is not None:
        _write_new(options.output, f"{text}\n")
    for note in system.notes:
        print(f"lsys-kit: note: {note}", file=sys.stderr)
    print(text if options.output is None else f"Written to {quotable(options.output)} in the notation {options.to}.")


def print_link(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.link import link
    from lsys_kit.pictures.qr_codes import qr_code

    system = system_or_cells(options)
    own = {"step": options.steps, "angle": options.angle, "seed": options.seed}
    settings = {name: value for name, value in own.items() if value is not None} | dict(options.settings)
    address = link(system, settings, options.base)
    if options.qr is not None:
        if not options.base:
            raise ModelValueError("A phone cannot open the QR code of a link without the address of a page", hint=_BASE)
        qr_code(address).save(options.qr)
    elif not options.base:
        print(f"lsys-kit: note: The kit alone reads this link, which has no address of a page. {_BASE}", file=sys.stderr)
    print(address)


def write_page(options: argparse.Namespace) -> None:
    """Write the panel of a system into an HTML file that needs no kernel, and print what it shows first."""
    from lsys_kit.classroom.panel.explorer import check_unfolded
    from lsys_kit.classroom.panel.opened.kinds import opened
    from lsys_kit.classroom.panel.opened.opened import Viewing
    from lsys_kit.classroom.panel.page import page, save_page
    from lsys_kit.derivation.core.letters import letters_from
    from lsys_kit.notation.model.system import LSystem

    system, (id, title) = system_or_cells(options), _titles(options.system)
    check_unfolded(system, options.unfold, dict(options.settings))
    what = opened(system, id, dict(options.settings), unfold=options.unfold)
    seed = options.seed or getattr(system, "seed", None) or 0
    first = what.steps if options.steps is None else options.steps
    letters = letters_from(system, options.letters) if isinstance(system, LSystem) else ()
    chosen = Viewing(first, what.first, seed, what.turned(options.angle), *what.side, letters=letters)
    begun = processor_time()
    reached = min(first, what.book(what.first, seed, first, letters)["steps"])
    with _rest_of_the_time(begun):
        sight = what.sight(replace(chosen, step=reached))
    with _rest_of_the_time(begun):
        data = what.page_data(chosen)
    named = {"file": file_stem(title, what.kind, "")} if title else {}
    save_page(options.output, page(title or what.kind, data | named, str(sight)))
    print(f"{sight} {data['model']['fixed']}".strip())


def _rest_of_the_time(begun: float) -> limits:
    """What is left of the seconds that a command may take; a little in any case."""
    seconds = current().seconds
    return limits(seconds=max(seconds - (processor_time() - begun), seconds / 20))


def _titles(name: str) -> tuple[str, str]:
    from lsys_kit.classroom.catalogue import entry
    from lsys_kit.notation.fragments import is_link

    try:
        known = entry(name)
    except ModelNameError:
        return "", "" if name == "-" or is_link(name) else Path(name).stem
    return known.id, f"{known.id}: {known.title}"


def _write_new(name: str, text: str) -> None:
    """Write a text into a file that must not be there yet."""
    with file_errors(f'"{quotable(name)}" cannot be written'):
        try:
            create_file(Path(name), text.encode())
        except FileExistsError:
            raise _exists(str(Path(name))) from None


def collect_marks(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.exercises.collecting import UNKNOWN, collect, marks_table

    if os.path.lexists(options.output):
        raise _exists(options.output)
    _chosen_course(options)
    marks = collect(options.folder, options.exercises)
    _write_new(options.output, marks_table(marks))
    unread = sum(not each.scores for each in marks)
    told = f"{counted_as(len(marks), 'student')} in {quotable(options.output)}, {unread or 'none'} without an answer"
    print(f"{told}. A check is no examination: the answers come with the kit.")
    unknown = sum(remark.startswith(UNKNOWN) for each in marks for remark in each.remarks)
    if unknown:
        told = f"The exercises of {counted_as(unknown, 'answer')} are not known"
        print(f"lsys-kit: note: {told}. Name where they are: --course FOLDER or --exercises FOLDER.", file=sys.stderr)


def write_wall(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.panel.page import save_page
    from lsys_kit.classroom.wall import wall, wall_page

    tiles = wall(options.folder)
    save_page(options.output, wall_page(options.title or Path(options.folder).resolve().name, tiles))
    missing = sum(bool(tile.mistake) for tile in tiles)
    lacking = f", {missing} of which cannot be drawn" if missing else ""
    print(f"{counted_as(len(tiles), 'plant')}{lacking}. Open {quotable(options.output)} in a browser.")


def counted_as(many: int, noun: str) -> str:
    """A number of things.

    >>> counted_as(1, "plant"), counted_as(2, "plant")
    ('1 plant', '2 plants')
    """
    return f"{many} {noun}{'s' * (many != 1)}"


def _exists(name: str) -> ModelFileError:
    return ModelFileError(f'"{quotable(name)}" already exists', hint="Files are never overwritten: choose another name.")


def check_exercises(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.exercises.declarations import QUESTIONS
    from lsys_kit.classroom.exercises.lint import problems_in
    from lsys_kit.classroom.places import COURSE_FILE, course_of

    listed = options.folder is not None and (Path(options.folder) / COURSE_FILE).is_file()
    places = [each for each in course_of(Path(options.folder)).places if not each.is_kits] if listed else []
    folders = [each.questions for each in places if any(each.questions.glob("*.toml"))] or [options.folder or QUESTIONS]
    _tell([problem for each in folders for problem in problems_in(each)], "in the exercises")


def _tell(problems: list[Any], where: str) -> None:
    """Print mistakes and advice; mistakes alone are an error."""
    for problem in problems:
        print(problem)
    mistakes = sum(not problem.advice for problem in problems)
    if mistakes:
        raise ModelFileError(
            f"{counted_as(mistakes, 'mistake')} {where}", hint="Each line above says where something is and what to try."
        )
    advice = len(problems) - mistakes
    print(f"No mistakes; {advice} piece{'s' * (advice > 1)} of advice." if advice else "No mistakes.")


def write_exercises(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.exercises.declarations import questions_folder
    from lsys_kit.classroom.exercises.notebooks import write_notebooks

    print(write_notebooks(options.output, questions_folder(options.folder)))


def write_package(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.scorm import package

    _chosen_course(options)
    for line in package.report(*package.write_package(options.what_exercises, options.output)):
        print(line)


def write_lesson(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.authoring import new

    root = new.write_lesson(options.name, options.output and Path(options.output), options.begin, options.title)
    where = quotable(str(root))
    print(f"The lesson is in {where}. Write it in JupyterLab: jupyter lab {where}")
    print(f"What a careful colleague would say: lsys-kit lesson check {where}")
    print(f"Its pages: lsys-kit site --course {where} -o pages")


def check_lesson(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.authoring.check import findings_in

    folder = None if options.folder is None else Path(options.folder)
    _opened(folder, options.language)
    _tell([*findings_in(folder, options.run)], "in the lesson")


def translate_lesson(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.authoring.translating import translate

    told = translate(Path(options.folder), options.language, options.only)
    for each in told:
        print(f"{quotable(str(each.path))}: {each.done} of {counted_as(each.texts, 'text')} translated.")
    _tell([problem for each in told for problem in each.findings], "in the translation")


def unpack_lesson(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.authoring.unpack import unpack

    root, cells, notebooks = unpack(Path(options.archive), options.output and Path(options.output))
    many = f"{counted_as(cells, 'cell')} of code in {counted_as(notebooks, 'notebook')}"
    print(
        f"The lesson is in {quotable(str(root))}: {many}. Nothing was run: a cell can do all that you can, so read them first."
    )


def write_site(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.site.build import build_site
    from lsys_kit.classroom.site.python import answering

    source, pyodide = _chosen_course(options), options.pyodide and Path(options.pyodide)
    pages = build_site(options.output, source, answering(pyodide, source) if options.live or pyodide else None)
    print(f"{len(pages)} pages are written. Open {quotable(str(pages[0]))} in a browser.")
    if options.live or pyodide:
        print(f"Python starts in them where a web server serves {quotable(options.output)}.")


def write_lite(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.lite.build import build_lite

    source, pyodide = _chosen_course(options), options.pyodide and Path(options.pyodide)
    lite = build_lite(options.output, source, pyodide)
    print(f"JupyterLab is in {quotable(options.output)}. It starts where a web server serves that folder, as this one does:")
    print(f"python -m http.server -d {quotable(options.output)}, and then http://localhost:8000/{lite.first}")
    if lite.fetched:
        print(f"When a notebook needs them, these come from cdn.jsdelivr.net: {', '.join(lite.fetched)}.")


def open_class(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.live import serving
    from lsys_kit.classroom.places import COURSE_FILE, own_place

    is_report = options.what == "report"
    named = [*dict.fromkeys(each for each in (None if is_report else options.what, options.place, options.folder) if each)]
    if len(named) > 1:
        both = quotable(" ".join(named))
        raise ModelFileError(f"A class is kept in one folder, not in {both}", hint="A course is named with --course FOLDER.")
    folder = named[0] if named else serving.FOLDER
    if is_report:
        from lsys_kit.classroom.live.report import write_reports

        for path in write_reports(folder):
            print(path)
    elif options.forget:
        print(serving.forget(folder, options.class_names))
    else:
        if own_place(Path(folder)).names() or (Path(folder) / COURSE_FILE).is_file():
            raise ModelFileError(
                f'"{quotable(folder)}" has lessons, and what a class says is kept elsewhere',
                hint=f"lsys-kit class --course {quotable(folder)} opens a class with them.",
            )
        source = _chosen_course(options)
        serving.serve(folder, options.class_names, options.port, options.public, options.pages, source)


def _chosen_course(options: argparse.Namespace) -> Path | None:
    """The folder of the course that the command line names, whose lessons and exercises are known from now on."""
    from lsys_kit.classroom.exercises.notebooks import renew_exercises

    folder = None if options.course is None else Path(options.course)
    course = _opened(folder, options.language)
    if folder is not None:
        renew_exercises(course)
    return folder


def _opened(folder: Path | None, code: str | None) -> Course:
    """The course in a folder, chosen in a language; it is said once what is translated into that."""
    from lsys_kit.classroom.lessons.lesson import translated_lessons
    from lsys_kit.classroom.places import choose_course
    from lsys_kit.translation import ENGLISH, VARIABLE, code_of, language, languages

    wanted = code_of(code) if code else language()
    course = choose_course(folder, wanted)
    many = translated_lessons(course)
    if code and (wanted in languages() or not many):
        os.environ[VARIABLE] = language(code)
    if wanted != ENGLISH:
        of = counted_as(len(course.lessons), "lesson")
        print(f"In this language ({wanted}): {many} of {of}{'; the others are in English' * (many < len(course.lessons))}.")
    return course


def open_lab(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.course import FOLDER, copy_course, copy_report

    folder = Path(options.folder or FOLDER)
    copied = copy_course(folder, _chosen_course(options))
    print(copy_report("The course is", folder, copied), flush=True)
    if importlib.util.find_spec("jupyterlab") is None:
        raise LSystemError("JupyterLab is not installed", hint="Install it with: pip install 'lsys-kit[lab]'")
    from jupyterlab.labapp import LabApp

    # In a container everybody is root; the server answers this machine alone, and asks for its token.
    LabApp.launch_instance(
        [
            "--ServerApp.allow_root=True",
            f"--ServerApp.root_dir={folder.resolve()}",
            f"--LabApp.default_url=/lab/tree/{next(each.name for each in copied if each.name.endswith('.ipynb'))}",
        ]
    )


SECONDS, BYTES = 12, 8
"""These multiples of the kit's own limits: a command has several tasks, and libraries take memory to begin with."""
MERCY = 30
"""So many seconds of the processor after it was told so a process is ended that goes on."""
LASTING, UNLIMITED = frozenset({"site", "lite", "collect", "wall", "exercises", "lesson"}), frozenset({"lab", "class"})
"""The commands that have as much time as they need, and those that have memory, too."""


class UsedUp(BaseException):
    """The process has had its time; nothing takes this for an error of its own."""


def set_hard_limits(command: str) -> None:
    """Limit the processor time and the memory of this process, where the platform can, for a command.

    Raises
    ------
    UsedUp
        At any time later, from the time on that is the limit.
    """
    try:
        import resource
    except ImportError:  # as on Windows, and in a browser
        return
    if command not in UNLIMITED:
        _lower(resource.RLIMIT_DATA, most_bytes())
    if command not in LASTING | UNLIMITED:
        signal.signal(signal.SIGXCPU, _refuse)
        _lower(resource.RLIMIT_CPU, most_seconds(), MERCY)


def most_seconds() -> int:
    return round(SECONDS * current().seconds)


def most_bytes() -> int:
    return BYTES * current().bytes


def _lower(kind: int, most: int, more: int = 0) -> None:
    """Set a limit, unless a lower one is set already; from `more` beyond it on, there is no mercy."""
    import resource

    soft, hard = (
        new if old == resource.RLIM_INFINITY else min(new, old)
        for new, old in zip((most, most + more), resource.getrlimit(kind), strict=True)
    )
    with suppress(OSError, ValueError):  # a platform may have no such limit
        resource.setrlimit(kind, (soft, hard))


def _refuse(_: int, __: FrameType | None) -> None:
    raise UsedUp
