"""The command line: what may be typed after `lsys-kit`.

A mistake in a command or a model is one message on the standard error stream, and the exit status 2.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import NoReturn

from lsys_kit import commands
from lsys_kit.errors import LSystemError, printable

BAD_INPUT, INTERRUPTED, BROKEN_PIPE = 2, 130, 141
"""Exit statuses: a mistake in the input; interrupted; the reader of the output has gone (the last two as in shells)."""
MOST_STEPS = 10**9
"""The greatest number of steps."""


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
    return _carried_out(sys.argv[1:] if arguments is None else arguments, lambda command: None)


def run() -> int:
    """Carry out the command line of this process, which has hard limits of its own; return its exit status."""
    return _carried_out(sys.argv[1:], commands.set_hard_limits)


def _carried_out(arguments: Sequence[str], prepare: Callable[[str], None]) -> int:
    """Carry out a command line, after something that prepares for its command; return its exit status."""
    try:
        options = _argument_parser().parse_args(list(_spread(arguments)))
        prepare(options.command)
        options.action(options)
        sys.stdout.flush()
    except LSystemError as mistake:
        return _refused(str(mistake))
    except MemoryError:
        return _refused("The command needs more memory than there is for it. Take fewer steps.")
    except commands.UsedUp:
        return _refused(f"The command was not finished in {commands.most_seconds()} seconds. Take fewer steps.")
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    return 0


def _refused(message: str) -> int:
    print(f"lsys-kit: {message}", file=sys.stderr)
    return BAD_INPUT


class _Parser(argparse.ArgumentParser):
    """argparse with an error message of one line that points to the help."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"lsys-kit: {''.join(map(printable, message))}. See {self.prog} --help.\n")


def _argument_parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="lsys-kit", description="A teaching kit on Lindenmayer systems.", allow_abbrev=False)
    all_commands = parser.add_subparsers(required=True, metavar="COMMAND", dest="command")

    def command(
        name: str, action: Callable[[argparse.Namespace], None], text: str, example: str | None = None
    ) -> argparse.ArgumentParser:
        added = all_commands.add_parser(name, help=text, description=text, epilog=example, allow_abbrev=False)
        added.set_defaults(action=action)
        return added

    command("list", commands.list_systems, "List the systems of the catalogue.")
    derive = command("derive", commands.print_words, "Print the words of steps 0 to N, one per line.")
    _add_system(derive, steps_needed=True)
    derive.add_argument("--counts", action="store_true", help="print the number of modules of each step instead")
    derive.add_argument("--json", action="store_true", help="print one JSON document")
    draw = command(
        "draw",
        commands.draw_word,
        "Draw the word of step N, or a filament with the steps before it.",
        "Example: lsys-kit draw K5 -n 4 -o plant.gif",
    )
    _add_system(draw, steps_needed=False, several_steps=True)
    draw.add_argument("--angle", metavar="DEGREES", help="the angle by which + and - turn")
    draw.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="FILE",
        help="a picture (.svg, .png, .pdf), a mesh (.glb, .obj) or a film of the steps (.gif, .apng, .mp4)",
    )
    draw.add_argument("--seeds", type=_numbers, default=(), metavar="S,S,...", help="draw plants of several seeds side by side")
    draw.add_argument(
        "--view",
        type=_numbers,
        metavar="AROUND,ABOVE",
        help="the side from which a plant in space is seen, in degrees (default: 30,15)",
    )
    _add_looks(draw)
    draw.add_argument("--size", type=_numbers, metavar="WIDTH[,HEIGHT]", help="the size of a picture or film in pixels")
    draw.add_argument("--turntable", action="store_true", help="let the film show a plant in space from all sides")
    _add_film(draw)
    stages = command("stages", commands.draw_stages, "Draw the stage diagram, with the tokens of the word of step N.")
    _add_system(stages, steps_needed=False)
    _add_unfold(stages)
    _add_looks(stages)
    stages.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="FILE",
        help="a picture (.svg, .png, .pdf), a film of the tokens (.gif, .apng, .mp4), or a net for Petri-net tools (.pnml)",
    )
    _add_film(stages)
    stages.add_argument(
        "--durations", action="store_true", help="let a transition take a module's life span instead of one step"
    )
    convert = command(
        "convert",
        commands.convert,
        "Print a model in another notation.",
        "Example: lsys-kit convert K5 --to plant-string -o plant.txt",
    )
    _add_conversion(convert)
    link = command(
        "link",
        commands.print_link,
        "Print a model with its settings as an address, which the other commands read.",
        "Example: lsys-kit link J4 -n 9 --base https://example.org/j4.html --qr j4.svg",
    )
    _add_link(link)
    page = command(
        "page",
        commands.write_page,
        "Write a page with sliders, which needs neither Python nor a network.",
        "Example: lsys-kit page J4 -n 9 -o j4.html",
    )
    _add_model(page)
    page.add_argument("-n", "--steps", type=_step_count, metavar="N", help="the step that is seen first")
    page.add_argument("--angle", metavar="DEGREES", help="the angle by which + and - turn at first")
    _add_unfold(page)
    page.add_argument("-o", "--output", required=True, metavar="FILE", help="an .html file")
    site = command(
        "site",
        commands.write_site,
        "Write the course as pages whose panels move, which need neither Python nor a network.",
        "Example: lsys-kit site -o course",
    )
    site.add_argument("-o", "--output", required=True, metavar="FOLDER", help="the folder for the pages")
    lab = command("lab", commands.open_lab, "Copy the course into a folder of your own and open it in JupyterLab.")
    lab.add_argument("folder", nargs="?", metavar="FOLDER", help="default: lsys_kit_course in the current folder")
    _add_class(
        command(
            "collect",
            commands.collect_marks,
            "Write the marks of a class: check the answers in its notebooks, which are read and never run.",
            "Example: lsys-kit collect handed_in -o marks.csv",
        ),
        command(
            "wall",
            commands.write_wall,
            "Write a page with everybody's plants, from files with links or models.",
            "Example: lsys-kit wall plants -o wall.html",
        ),
    )
    _add_exercises(command("exercises", lambda _: None, "Check a folder of exercises, or write their notebooks or pages."))
    return parser


def _add_class(collect: argparse.ArgumentParser, wall: argparse.ArgumentParser) -> None:
    collect.add_argument("folder", metavar="FOLDER", help="notebooks, one for each student, or a folder for each student")
    collect.add_argument("-o", "--output", required=True, metavar="FILE", help="a new file of comma-separated values (.csv)")
    collect.add_argument("--exercises", metavar="FOLDER", help="a folder with exercises of your own, which are known as well")
    wall.add_argument("folder", metavar="FOLDER", help="model files, or texts of links, one a line, perhaps after a name")
    wall.add_argument("-o", "--output", required=True, metavar="FILE", help="an .html file")
    wall.add_argument("--title", metavar="TEXT", help="the heading of the page (default: the name of the folder)")


def _add_exercises(parser: argparse.ArgumentParser) -> None:
    parts = parser.add_subparsers(required=True, metavar="WHAT", dest="what")
    text = "Say what is wrong with the exercises in a folder: in which file and line, and what to try."
    check = parts.add_parser("check", help=text, description=text, allow_abbrev=False)
    check.add_argument("folder", nargs="?", metavar="FOLDER", help="a folder of .toml files (default: those of the kit)")
    check.set_defaults(action=commands.check_exercises)
    text = "Write a notebook for each file of exercises in a folder."
    write = parts.add_parser("notebooks", help=text, description=text, allow_abbrev=False)
    write.add_argument("folder", metavar="FOLDER", help="a folder of .toml files")
    write.add_argument("-o", "--output", required=True, metavar="FOLDER", help="the folder for the notebooks")
    write.set_defaults(action=commands.write_exercises)
    text = "Write exercises as a package for a learning platform (SCORM 1.2), with pages that need no Python."
    example = "Example: lsys-kit exercises scorm 1 -o lesson_1.zip"
    package = parts.add_parser("scorm", help=text, description=text, epilog=example, allow_abbrev=False)
    package.add_argument("what_exercises", metavar="LESSON", help="a lesson of the kit, such as 1, or a folder of .toml files")
    package.add_argument("-o", "--output", required=True, metavar="FILE", help="a .zip file")
    package.set_defaults(action=commands.write_package)


def _add_film(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--seconds", help="how long a film shows each step (default: 0.6; on a turntable 0.1)")
    parser.add_argument("--dpi", help="the dots per inch of a .png picture (default: 96)")


def _add_unfold(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--unfold",
        nargs="?",
        type=_symbols,
        const=True,
        default=False,
        metavar="A,B",
        help="show each of many stages, and do not group them by symbol; or each of those of some symbols only",
    )


def _add_system(parser: argparse.ArgumentParser, steps_needed: bool, several_steps: bool = False) -> None:
    _add_model(parser)
    kind, more = (_step_counts, "; several, as in 4,6,8, are drawn side by side") if several_steps else (_step_count, "")
    parser.add_argument("-n", "--steps", type=kind, required=steps_needed, metavar="N", help=f"the number of steps{more}")
    parser.add_argument(
        "--arithmetic", choices=["exact", "float"], default="exact", help="float uses doubles, as other programs do"
    )


def _add_looks(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--labels", action=argparse.BooleanOptionalAction, help="whether names and steps are written")
    parser.add_argument(
        "--colours", type=_colours, metavar="KIND", help="natural, symbols, or colours of symbols, as in A=seagreen,B=#cc79a7"
    )
    parser.add_argument("--widths", metavar="KIND", help="order, constant, or a factor of the widths of strokes")
    parser.add_argument("--turtle", action=argparse.BooleanOptionalAction, help="whether an arrow marks the turtle's start")
    parser.add_argument("--legend", action=argparse.BooleanOptionalAction, help="whether a legend stands below")
    parser.add_argument("--background", metavar="COLOUR", help="light, dark, none or a colour (default: light)")


def _add_model(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "system",
        metavar="SYSTEM",
        help="an id or name in the catalogue, such as P4; a file; a link of a model; or - for standard input",
    )
    parser.add_argument(
        "--set",
        type=_constant_setting,
        action="append",
        default=[],
        metavar="NAME=VALUE",
        dest="settings",
        help="set a constant, as in dt=14/10",
    )
    parser.add_argument(
        "--notation",
        metavar="NAME",
        help="the notation of the file; for a system of the catalogue, the notation of the printed words",
    )
    parser.add_argument("--name", metavar="NAME", help="which system, if the file holds several with names")
    parser.add_argument(
        "--seed",
        type=_seed,
        metavar="S",
        help="the seed of the random numbers, a whole number (default: the model's own, else 0)",
    )


def _add_conversion(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("system", metavar="FILE", help="a model, - for standard input, or an id or name in the catalogue")
    parser.add_argument("--to", required=True, metavar="NOTATION", help="the notation to be printed")
    parser.add_argument("--from", dest="notation", metavar="NOTATION", help="the notation of FILE (default: it is recognised)")
    parser.add_argument("--name", metavar="NAME", help="which system, if the file holds several with names")
    parser.add_argument("--no-interpretation", action="store_true", help="leave out the rules that say how it is drawn")
    parser.add_argument("-o", "--output", metavar="FILE", help="write into this file, which must not exist yet")


def _add_link(parser: argparse.ArgumentParser) -> None:
    _add_model(parser)
    parser.add_argument("-n", "--steps", type=_step_count, metavar="N", help="the step that is to be seen")
    parser.add_argument("--angle", metavar="DEGREES", help="the angle by which + and - turn")
    parser.add_argument(
        "--base", default="", metavar="ADDRESS", help="where a browser finds the page of this model that lsys-kit page makes"
    )
    parser.add_argument("--qr", metavar="FILE", help="write the address as a QR code too (.svg, .png)")


def _spread(arguments: Sequence[str]) -> Iterator[str]:
    """`--set a=1 b=2` as `--set a=1 --set b=2`, so that other arguments may follow.

    >>> list(_spread(["derive", "--set", "a=1", "b=2", "P4"]))
    ['derive', '--set', 'a=1', '--set', 'b=2', 'P4']
    """
    setting = False
    for before, argument in zip(["", *arguments], arguments, strict=False):
        setting = before == "--set" or (setting and "=" in argument and not argument.startswith("-"))
        yield from ["--set", argument] if setting and before != "--set" else [argument]


def _step_count(text: str) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < 20 and int(text) <= MOST_STEPS):
        raise argparse.ArgumentTypeError(f'the number of steps must be a whole number, 0 or greater, not "{text[:40]}"')
    return int(text)


def _step_counts(text: str) -> int | list[int]:
    """One number of steps, or several with commas between them."""
    found = [_step_count(each) for each in text.split(",")]
    return found if len(found) > 1 else found[0]


def _numbers(text: str) -> list[int]:
    try:
        return [int(each[:20]) for each in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f'whole numbers with commas between them are needed, not "{text[:40]}"') from None


def _symbols(text: str) -> list[str]:
    return text.split(",")


def _colours(text: str) -> str | dict[str, str]:
    """A kind of colours, or those of some symbols.

    >>> _colours("natural"), _colours("A=navy,B=#cc79a7")
    ('natural', {'A': 'navy', 'B': '#cc79a7'})
    """
    return dict(_constant_setting(each) for each in text.split(",")) if "=" in text else text


def _constant_setting(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (equals and name.strip() and value.strip()):
        raise argparse.ArgumentTypeError(f'"{text[:40]}" is not NAME=VALUE, as in dt=14/10')
    return name.strip(), value.strip()


def _seed(text: str) -> int:
    if re.fullmatch(r"-?[0-9]{1,19}", text):
        return int(text)
    raise argparse.ArgumentTypeError(f'the seed must be a whole number, not "{text[:40]}"')


if __name__ == "__main__":
    sys.exit(run())
