"""The command line: what may be typed after `lsys-kit`; `commands.toml` lists it.

A mistake in a command or a model is one message on the standard error stream, and the exit status 2.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NoReturn

from lsys_kit import commands
from lsys_kit.errors import LSystemError, printable, quotable
from lsys_kit.files import toml_tables

BAD_INPUT, INTERRUPTED, BROKEN_PIPE = 2, 130, 141
"""Exit statuses: a mistake in the input; interrupted; the reader of the output has gone (the last two as in shells)."""
MOST_STEPS = 10**9


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out one command line.

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
    except OSError as fault:  # a disk that is full, a folder without rights, a stick that was pulled out
        name = f'"{quotable(str(fault.filename))}": ' if fault.filename else ""
        return _refused(f"{name}{fault.strerror or fault}.")
    return 0


def _refused(message: str) -> int:
    print(f"lsys-kit: {message}", file=sys.stderr)
    return BAD_INPUT


class _Parser(argparse.ArgumentParser):
    """argparse with an error message of one line that points to the help."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"lsys-kit: {''.join(map(printable, message))}. See {self.prog} --help.\n")


def _argument_parser() -> argparse.ArgumentParser:
    declared = toml_tables("lsys_kit", "commands.toml")
    parser = _Parser(prog="lsys-kit", description="A teaching kit on Lindenmayer systems.", allow_abbrev=False)
    _add_commands(
        parser.add_subparsers(required=True, metavar="COMMAND", dest="command"), declared["commands"], declared["shared"]
    )
    return parser


def _add_commands(all_commands: Any, declared: Mapping[str, Any], shared: Mapping[str, Any]) -> None:
    for name, command in declared.items():
        text, example = command["help"], f"Example: {command['example']}" if "example" in command else None
        added = all_commands.add_parser(name, help=text, description=text, epilog=example, allow_abbrev=False)
        for each in command.get("options", ()):
            for option in shared[each] if isinstance(each, str) else [each]:
                read = {
                    key: _READERS.get(value, value) if key in ("action", "type") else value for key, value in option.items()
                }
                added.add_argument(*read.pop("flags").split(), **read)
        if "action" in command:
            added.set_defaults(action=getattr(commands, command["action"]))
        else:
            _add_commands(added.add_subparsers(required=True, metavar="WHAT", dest="what"), command["commands"], shared)


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


def _port(text: str) -> int:
    if re.fullmatch(r"[0-9]{1,5}", text) and int(text) < 65_536:
        return int(text)
    raise argparse.ArgumentTypeError(f'the port must be a whole number from 0 to 65535, not "{text[:40]}"')


_READERS: Mapping[str, Any] = {
    "steps": _step_count,
    "several steps": _step_counts,
    "numbers": _numbers,
    "symbols": lambda text: text.split(","),
    "colours": _colours,
    "constant": _constant_setting,
    "seed": _seed,
    "port": _port,
    "yes or no": argparse.BooleanOptionalAction,
}
"""What reads the values of options, by the types in `commands.toml`."""

if __name__ == "__main__":
    sys.exit(run())
