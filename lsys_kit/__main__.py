"""The kit from a shell: `lsys-kit list`, `derive`, `draw`, `stages` and `lab`.

Whatever is wrong with a command or a model is one message on the standard error stream, and the exit status 2.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NoReturn

from lsys_kit.budget import current
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelNameError, printable

if TYPE_CHECKING:
    from lsys_kit.derivation.derive import Derivation
    from lsys_kit.notation.model import LSystem

BAD_INPUT, INTERRUPTED, NOBODY_READS = 2, 130, 141
"""Exit statuses: a mistake in the input; as shells say of a program that was interrupted, or whose reader has gone."""
STEPS = 5
"""How many steps are drawn where neither the command nor the system says."""
MOST_STEPS, MOST_NEIGHBOURS = 10**9, 1_000
"""The greatest number of steps that is understood; how many files beside a missing one are looked at for a likely name."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command line.

    Returns
    -------
    int
        The exit status.

    Examples
    --------
    >>> main(["derive", "J1", "-n", "2"])
    ar
    al br
    bl ar ar
    0
    """
    try:
        options = _parser().parse_args(list(_spread(sys.argv[1:] if arguments is None else arguments)))
        options.action(options)
        sys.stdout.flush()
    except LSystemError as mistake:
        print(f"lsys-kit: {mistake}", file=sys.stderr)
        return BAD_INPUT
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return NOBODY_READS
    return 0


class _Parser(argparse.ArgumentParser):
    """argparse with one line to say what is wrong, and a pointer to the help."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"lsys-kit: {message}. See {self.prog} --help.\n")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="lsys-kit", description="A teaching kit on Lindenmayer systems.", allow_abbrev=False)
    commands = parser.add_subparsers(required=True, metavar="COMMAND", dest="command")

    def command(name: str, action: Callable[[argparse.Namespace], None], text: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text, allow_abbrev=False)
        added.set_defaults(action=action)
        return added

    command("list", _list, "List the systems of the catalogue.")
    derive = command("derive", _derive, "Print the words of steps 0 to N, one a line.")
    _add_system(derive, steps_needed=True)
    derive.add_argument("--counts", action="store_true", help="print the number of modules instead, however large")
    derive.add_argument("--json", action="store_true", help="print one JSON document")
    draw = command("draw", _draw, "Draw the word of step N; a filament with the steps before it.")
    _add_system(draw, steps_needed=False)
    draw.add_argument("--angle", metavar="DEGREES", help="by how much + and - turn")
    draw.add_argument("-o", "--output", required=True, metavar="FILE", help="ends in .svg, .png or .pdf")
    stages = command("stages", _stages, "Draw the stage diagram, with the tokens of the word of step N.")
    _add_system(stages, steps_needed=False)
    stages.add_argument("-o", "--output", required=True, metavar="FILE", help="ends in .svg")
    lab = command("lab", _lab, "Copy the course into a folder of yours, and open it in JupyterLab.")
    lab.add_argument("folder", nargs="?", metavar="FOLDER", help="by default lsys_kit_course, here")
    return parser


def _add_system(parser: argparse.ArgumentParser, steps_needed: bool) -> None:
    """The options that say which system, and up to which step."""
    parser.add_argument("system", metavar="SYSTEM", help="an id such as P4, a file, or - for standard input")
    parser.add_argument("-n", "--steps", type=_whole, required=steps_needed, metavar="N", help="how many steps")
    parser.add_argument("--set", type=_setting, action="append", default=[], metavar="NAME=VALUE", dest="settings",
                        help="give a constant another value, as in dt=14/10")
    parser.add_argument("--notation", metavar="NAME",
                        help="the notation of the file, or in which the words of a system of the catalogue are printed")
    parser.add_argument("--arithmetic", choices=["exact", "float"], default="exact",
                        help="float computes in doubles, as other programs do")
    parser.add_argument("--seed", type=_seed, metavar="S", help="where chance begins: a whole number, by default the model's own, else 0")


def _spread(arguments: Sequence[str]) -> Iterator[str]:
    """`--set a=1 b=2` as `--set a=1 --set b=2`, so that what has no = in it may follow.

    >>> list(_spread(["derive", "--set", "a=1", "b=2", "P4"]))
    ['derive', '--set', 'a=1', '--set', 'b=2', 'P4']
    """
    setting = False
    for before, argument in zip(["", *arguments], arguments, strict=False):
        setting = before == "--set" or (setting and "=" in argument and not argument.startswith("-"))
        yield from ["--set", argument] if setting and before != "--set" else [argument]


def _whole(text: str) -> int:
    """A whole number from 0 on."""
    if not (text.isascii() and text.isdigit() and len(text) < 20 and int(text) <= MOST_STEPS):
        raise argparse.ArgumentTypeError(f'the number of steps is a whole number from 0 on, not "{text[:40]}"')
    return int(text)


def _setting(text: str) -> tuple[str, str]:
    """The name and the value of a constant."""
    name, equals, value = text.partition("=")
    if not (equals and name.strip() and value.strip()):
        raise argparse.ArgumentTypeError(f'"{text[:40]}" is not NAME=VALUE, as in dt=14/10')
    return name.strip(), value.strip()


def _seed(text: str) -> int:
    """A whole number."""
    if re.fullmatch(r"-?[0-9]{1,19}", text):
        return int(text)
    raise argparse.ArgumentTypeError(f'the seed is a whole number, not "{text[:40]}"')


def _list(_: argparse.Namespace) -> None:
    from lsys_kit import systems

    print(repr(systems()))


def _derive(options: argparse.Namespace) -> None:
    steps = _counted(options) if options.counts else _derived(options)
    if options.json:
        rows = [json.dumps(step, ensure_ascii=False) for step in steps]
        print("[\n" + ",\n".join(rows) + "\n]")
    else:
        for step in steps:
            print(step["modules" if options.counts else "word"])


def _counted(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    """Each step with its number of modules; a word is built only where neighbours or chance have a say."""
    from lsys_kit.derivation.derive import lengths
    from lsys_kit.derivation.states import States

    sys.set_int_max_str_digits(0)
    system = _system(options)
    counts = lengths(system, options.steps, arithmetic=options.arithmetic) if States(system).settled else \
        _words(system, options).lengths
    for step, modules in enumerate(counts):
        yield {"step": step, "modules": modules}


def _derived(options: argparse.Namespace) -> Iterator[dict[str, object]]:
    """Each step with its number of modules, and its word."""
    for step, word in enumerate(_words(_system(options), options)):
        yield {"step": step, "modules": len(word), "word": str(word)}


def _words(system: LSystem, options: argparse.Namespace) -> Derivation:
    """The derivation; where a step would be too large, the error says what can be typed instead."""
    from lsys_kit.derivation.derive import Derivation, derive

    try:
        steps = next(steps for steps in (options.steps, system.steps, STEPS) if steps is not None)
        return derive(system, steps, seed=options.seed, arithmetic=options.arithmetic)
    except ModelLimitError as mistake:
        if not isinstance(mistake.partial, Derivation):
            raise
        counting = "; derive --counts counts the modules of any step" if mistake.partial.states.settled else ""
        hint = f"Take -n {mistake.partial.steps} or less{counting}."
        raise ModelLimitError(mistake.message, limit=mistake.limit, needed=mistake.needed, hint=hint) from None


def _draw(options: argparse.Namespace) -> None:
    from lsys_kit.pictures.draw import draw

    picture = draw(_words(_system(options), options), angle=options.angle)
    picture.save(options.output)
    print(picture)


def _stages(options: argparse.Namespace) -> None:
    from lsys_kit.derivation.stages import stages
    from lsys_kit.pictures.draw import draw

    system = _system(options)
    word = None if options.steps is None else _words(system, options)[-1]
    picture = draw(stages(system), tokens=word)
    picture.save(options.output)
    print(picture)


def _lab(options: argparse.Namespace) -> None:
    from lsys_kit.classroom.course import FOLDER, copy_course, told

    folder = Path(options.folder or FOLDER)
    copied = copy_course(folder)
    print(told(folder, copied), flush=True)
    if importlib.util.find_spec("jupyterlab") is None:
        raise LSystemError("JupyterLab is not installed", hint="Install it with: pip install 'lsys-kit[lab]'")
    from jupyterlab.labapp import LabApp

    # In a container everybody is root; the server answers this machine alone, and asks for its token.
    LabApp.launch_instance(["--ServerApp.allow_root=True", f"--ServerApp.root_dir={folder.resolve()}",
                            f"--LabApp.default_url=/lab/tree/{copied[0].name}"])


def _system(options: argparse.Namespace) -> LSystem:
    """The system that the command line names, with its constants set."""
    from lsys_kit.derivation.rules import constants_of, number_from
    from lsys_kit.notation.expressions import Number

    system, values = _found(options.system, options.notation), dict(options.settings)
    constants_of(system, values)
    return replace(system, constants=tuple(
        replace(constant, value=Number(number_from(values[constant.name]))) if constant.name in values else constant
        for constant in system.constants))


def _found(name: str, notation: str | None) -> LSystem:
    """The system of the catalogue that has this name, else the one in the file."""
    from lsys_kit.classroom.catalogue import system
    from lsys_kit.notation.read import read
    from lsys_kit.notation.write import write

    if name == "-":
        return read(_text(sys.stdin.buffer, "the standard input"), notation)
    try:
        found = system(name)
    except ModelNameError:
        return read(_file(name), notation)
    if notation is not None:
        write(found, notation)  # says what the notation lacks
        return replace(found, notation=notation)
    return found


def _file(name: str) -> str:
    """The text of a model file."""
    try:
        with Path(name).open("rb") as file:
            return _text(file, f'"{_shown(name)}"')
    except FileNotFoundError:
        raise ModelFileError(f'There is no file "{_shown(name)}", and no system of the catalogue is called so',
                             hint=_likely(name)) from None
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{_shown(name)}" cannot be read: {getattr(fault, "strerror", None) or fault}') from None


def _text(file: BinaryIO, name: str) -> str:
    """What a file says, at most a little more than a model may have."""
    content = file.read(4 * current().text + 1)
    try:
        return content.decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError as fault:
        raise ModelFileError(f"{name[0].upper()}{name[1:]} is not text in UTF-8: its byte {fault.start + 1} is none") from None


def _likely(name: str) -> str:
    """What was probably meant: a file beside it, a system of the catalogue."""
    from lsys_kit.classroom.catalogue import systems
    from lsys_kit.notation.checks import suggestion

    folder = Path(name).parent
    beside = [str(path) for path in islice(folder.iterdir(), MOST_NEIGHBOURS)] if folder.is_dir() else []
    return suggestion(name, [*beside, *systems()]) or f"Catalogue ids are {', '.join(systems())}."


def _shown(name: str) -> str:
    """A name as a message quotes it."""
    return "".join(map(printable, name if len(name) <= 80 else f"{name[:80]}..."))


if __name__ == "__main__":
    sys.exit(main())
