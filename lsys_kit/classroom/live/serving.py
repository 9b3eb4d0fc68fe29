"""`lsys-kit class`: the server, until it is interrupted; and forgetting."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from urllib.parse import urlsplit

from lsys_kit.classroom.live.events import FILE, Events
from lsys_kit.errors import LSystemError, ModelFileError, ModelNameError, ModelValueError, quotable, require
from lsys_kit.pictures.qr_codes import qr_code

FOLDER = "lsys_kit_class"
"""Where what classes say is kept, if nothing else is asked for."""
NAME = "Class"
"""What a class is called that has no other name."""
LONGEST_NAME, MOST_CLASSES = 60, 50
_DARK = {(False, False): " ", (True, False): "▀", (False, True): "▄", (True, True): "█"}


def missing_library(absent: str) -> LSystemError:
    """The error that a library is not there which a class needs."""
    return LSystemError(f"A class needs the library {absent}", hint="Install it with: pip install 'lsys-kit[class]'")


def mistake_told(fault: LSystemError) -> dict[str, object]:
    """An error of the kit, as a server tells the kernel that has started it."""
    return {"mistake": fault.message, "hint": fault.hint, "of_file": isinstance(fault, ModelFileError)}


def serve(
    folder: str,
    names: Sequence[str] | None = None,
    port: int = 8765,
    public: str | None = None,
    course: bool = True,
    source: Path | None = None,
) -> None:
    """Open some classes, and keep them open until this process is interrupted.

    folder
        Where what they say is kept, and the pages of the course.
    names
        What the classes are called.
    port
        Where the server listens; 0 lets the system choose.
    public
        The address that a proxy with TLS has for the server; by default the server is for the local network.
    course
        Whether the class has the pages of the course.
    source
        The folder of the course, by default that of the kit.
    """
    try:
        import tornado  # noqa: F401
    except ImportError:
        raise missing_library("tornado") from None
    from lsys_kit.classroom.live.course_pages import CoursePages
    from lsys_kit.classroom.live.server import ClassServer

    wanted = checked_names(names)
    if public is not None:
        _check_address(public)

    async def run() -> None:
        server = ClassServer(folder, wanted, CoursePages(folder, source, _print) if course else None)
        try:
            server.listen(port, address=public, behind_a_proxy=public is not None, host="127.0.0.1" if public else "")
            print(
                welcome(
                    [
                        (room.entry.name, code, server.join_address(code), server.board_address(code))
                        for code, room in server.classes.items()
                    ]
                ),
                flush=True,
            )
            await _interrupted()
        finally:
            await server.close()

    with suppress(KeyboardInterrupt):
        asyncio.run(run())


def _print(text: str) -> None:
    print(text, flush=True)


async def _interrupted() -> None:
    """Wait for the end: an interrupt, or what a system sends to its services."""
    end, loop = asyncio.Event(), asyncio.get_running_loop()
    for each in (signal.SIGINT, signal.SIGTERM):
        with suppress(NotImplementedError, ValueError):  # Windows interrupts the loop itself
            loop.add_signal_handler(each, end.set)
    await end.wait()


def welcome(classes: Sequence[tuple[str, str, str, str]]) -> str:
    """What is printed: of each class its name, its code and address for phones, and the address of its board.

    >>> print(welcome([("10b", "ABCD", "http://10.0.0.2:8765/ABCD/", "http://10.0.0.2:8765/board/x/")]).splitlines()[0])
    10b: join with the code ABCD at http://10.0.0.2:8765/ABCD/
    """
    lines = []
    for name, code, join, board in classes:
        lines += [f"{name}: join with the code {code} at {join}", *_code(join), f"The board, for you alone: {board}", ""]
    return "\n".join([*lines, "Ctrl+C ends the class; the same command opens it again where it was."])


def _code(address: str) -> list[str]:
    """A QR code of half blocks, for a terminal; nothing where the library is missing."""
    try:
        rows = [[False] * 2 + [*row] + [False] * 2 for row in qr_code(address).rows]
    except LSystemError:
        return []
    blank = [False] * len(rows[0])
    rows = [blank, blank, *rows, blank, blank, *([blank] if len(rows) % 2 else [])]
    return [
        "".join(_DARK[not up, not down] for up, down in zip(*pair, strict=True))
        for pair in zip(rows[::2], rows[1::2], strict=True)
    ]


def checked_names(names: Sequence[str] | None) -> list[str]:
    """The names of classes, each once.

    Raises
    ------
    ModelValueError
        A name is empty or long, or has characters that cannot be seen, or there are too many.
    """
    found = list(dict.fromkeys(name.strip() for name in names or [NAME]))
    for name in found:
        if not name or len(name) > LONGEST_NAME or not name.isprintable():
            raise ModelValueError(
                f'A class cannot be called "{quotable(name)}"', hint=f"A name has 1 to {LONGEST_NAME} visible characters."
            )
    if len(found) > MOST_CLASSES:
        raise ModelValueError(f"There are {len(found)} classes; a server has at most {MOST_CLASSES}")
    return found


def _check_address(public: str) -> None:
    require(public, str, "An address")
    parts = urlsplit(public)
    if (
        parts.scheme != "https"
        or not parts.netloc
        or not public.isprintable()
        or parts.query
        or parts.fragment
        or parts.path.strip("/")
    ):
        raise ModelValueError(
            f'"{quotable(public)}" is no address for --public',
            hint="It is that of a proxy with TLS, as in https://class.example.org.",
        )


def forget(folder: str, names: Sequence[str] | None = None) -> str:
    """Delete what classes have said, and the classes; what was done, in words.

    Raises
    ------
    ModelFileError, ModelNameError
        There is nothing in the folder, or no class of a name.
    """
    if not (Path(folder) / FILE).is_file():
        raise ModelFileError(f'No class is kept in "{quotable(folder)}"')
    events = Events(folder)
    try:
        known = {each.name: each.code for each in events.classes()}
        wanted = [name.strip() for name in names] if names else [*known]
        for name in wanted:
            if name not in known:
                listed = ", ".join(known) or "none"
                raise ModelNameError(
                    f'There is no class "{quotable(name)}" in "{quotable(folder)}"', hint=f"Its classes are: {listed}."
                )
        many = sum(events.forget(known[name]) for name in wanted)
    finally:
        events.close()
    return f"{len(wanted)} class{'es' * (len(wanted) != 1)} and {many:,} entries are forgotten."
