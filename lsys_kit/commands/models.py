"""The commands about a model: its words, pictures, notations and pages."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lsys_kit.budget import Task, check_bytes, counted, current, limits, processor_time
from lsys_kit.commands.named_systems import named_system, system_or_cells, system_with_constants
from lsys_kit.errors import ModelFileError, ModelLimitError, ModelNameError, ModelValueError, quotable
from lsys_kit.files import create_file, file_stem

if TYPE_CHECKING:
    from lsys_kit.derivation.derive import Derivation
    from lsys_kit.notation.model.system import LSystem
    from lsys_kit.pictures.draw import AnyPicture
    from lsys_kit.pictures.films import Film

_BASE = 'Give one with --base: where the page of this model stands that "lsys-kit page" makes.'
BITS_A_DIGIT = 3
"""A digit says at least so many bits of a number."""


def list_systems(_: argparse.Namespace) -> None:
    """Print the catalogue: ids, names and titles, under the works from which the systems come."""
    from lsys_kit import book_systems, cellwork_systems, map_systems, systems

    print(f"{systems()!r}\n{book_systems()!r}\n\nMap systems\n{map_systems()!r}\n\nCellwork systems\n{cellwork_systems()!r}")


def print_words(options: argparse.Namespace) -> None:
    """Print the words of the steps, or their numbers of modules."""
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
    """Each step with its number of modules, and its word."""
    for step, word in enumerate(_derivation(system_with_constants(options), options)):
        yield {"step": step, "modules": len(word), "word": str(word)}


def _derivation(system: LSystem, options: argparse.Namespace) -> Derivation:
    """The derivation; if a step is too large, the error says what can be typed instead."""
    from lsys_kit.derivation.derive import Derivation
    from lsys_kit.notation.model.system import USUAL_STEPS
    from lsys_kit.worlds.derive import derive

    try:
        steps = next(steps for steps in (options.steps, system.steps, USUAL_STEPS) if steps is not None)
        return derive(system, steps, seed=options.seed, arithmetic=options.arithmetic)
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

    film = _film(options)
    if cells := cell_system(options.system):
        shown: AnyPicture | Film = (
            animate(cells, options.steps, **film, **_seen(options)) if film else draw(cells, options.steps, **_seen(options))
        )
    elif options.seeds or isinstance(options.steps, list):
        shown = draw(
            system_with_constants(options),
            seed=options.seed,
            arithmetic=options.arithmetic,
            angle=options.angle,
            seeds=options.seeds,
            **_steps(options),
            **_seen(options),
        )
    else:
        words = _derivation(system_with_constants(options), options)
        shown = (
            animate(words, angle=options.angle, **film, **_seen(options))
            if film
            else draw(words, angle=options.angle, **_seen(options))
        )
    _save(shown, options)


def _film(options: argparse.Namespace) -> dict[str, Any]:
    """How a film is shown; nothing, if no film is wanted."""
    from lsys_kit.pictures.formats.notebook import FILMS

    turntable = getattr(options, "turntable", False)
    if Path(options.output).suffix.lower() not in FILMS and not turntable:
        return {}
    if options.dpi is not None:
        raise ModelValueError("A film has no dots per inch", hint="Choose its size in pixels: --size 1200.")
    return {"seconds": options.seconds} | ({"turntable": True} if turntable else {})


def _save(shown: AnyPicture | Film, options: argparse.Namespace) -> None:
    """Write a picture, with so many dots per inch, or a film; and print what it shows."""
    shown.save(options.output, **({} if options.dpi is None else {"dpi": options.dpi}))
    print(shown)


def _seen(options: argparse.Namespace) -> dict[str, Any]:
    """The side from which something is seen, the size of the picture and how it looks, as far as they are given."""
    size = options.size[0] if options.size and len(options.size) == 1 else options.size
    given = {"view": options.view, "size": size, **_looks(options)}
    return {name: value for name, value in given.items() if value is not None}


def _looks(options: argparse.Namespace) -> dict[str, Any]:
    """How a picture looks, as `draw` takes it; None for what is not given."""
    from lsys_kit.pictures.options import OPTIONS

    return {name: getattr(options, name) for name in OPTIONS}


def _steps(options: argparse.Namespace) -> dict[str, Any]:
    """The steps that are drawn, as `draw` takes them."""
    return {"steps": options.steps} if isinstance(options.steps, list) else {"n": options.steps}


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


def convert(options: argparse.Namespace) -> None:
    """Print a system in another notation, or write it into a new file; the notes of its reader go to the error stream."""
    from lsys_kit.notation.write import write

    system = named_system(options.system, options.notation, options.name)
    text = write(system, options.to, interpretation=not options.no_interpretation)
    if options.output is not None:
        _keep(f"{text}\n", options.output)
    for note in system.notes:
        print(f"lsys-kit: note: {note}", file=sys.stderr)
    print(text if options.output is None else f"Written to {quotable(options.output)} in the notation {options.to}.")


def print_link(options: argparse.Namespace) -> None:
    """Print the address of a model with its settings, and perhaps write it as a QR code."""
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
    from lsys_kit.classroom.panel.explore import check_unfolded
    from lsys_kit.classroom.panel.opened.kinds import opened
    from lsys_kit.classroom.panel.opened.opened import Viewing
    from lsys_kit.classroom.panel.page import page, save_page

    system, (id, title) = system_or_cells(options), _titles(options.system)
    check_unfolded(system, options.unfold, dict(options.settings))
    what = opened(system, id, dict(options.settings), unfold=options.unfold)
    seed = options.seed or getattr(system, "seed", None) or 0
    first = what.steps if options.steps is None else options.steps
    chosen, begun = Viewing(first, what.first, seed, what.turned(options.angle), *what.side), processor_time()
    reached = min(first, what.book(what.first, seed, first)["steps"])
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
    """The id of a system of the catalogue, if it is one, and what its page is called."""
    from lsys_kit.classroom.catalogue import entry
    from lsys_kit.notation.fragments import is_link

    try:
        known = entry(name)
    except ModelNameError:
        return "", "" if name == "-" or is_link(name) else Path(name).stem
    return known.id, f"{known.id}: {known.title}"


def _keep(text: str, name: str) -> None:
    """Write a text into a new file."""
    try:
        create_file(Path(name), text.encode())
    except FileExistsError:
        raise ModelFileError(
            f'"{quotable(str(Path(name)))}" already exists', hint="Files are never overwritten: choose another name."
        ) from None
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{quotable(name)}" cannot be written: {getattr(fault, "strerror", None) or fault}') from None
