"""The pages of the course for the phones of a class, which are made once, by a process of their own, while the class is open.

Each can be opened when it is made. What is made in that process keeps no phone waiting: it lets the server go first.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from hashlib import sha256
from importlib.resources import files
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Thread

from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.live.pages import Page
from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.site.build import build_site
from lsys_kit.classroom.site.pages import CLASS
from lsys_kit.errors import LSystemError
from lsys_kit.files import KIT_MARK, file_errors, replace_file
from lsys_kit.translation import gettext, language

PAGES, MADE = "pages", ".made.json"
"""The folder of the pages in that of a class, and the file in it that says of which kit they are."""
NICER = 10
"""By so much the priority of the process that makes pages is lower."""
A_LITTLE, ENDING = 0.2, 5.0
"""Whoever waits looks after so many seconds whether all is being closed; so long the process has to end."""
_CONTEXT = multiprocessing.get_context("spawn")


class CoursePages:
    """The pages of a course: those that are there, and how many there will be.

    Parameters
    ----------
    folder
        The folder of the class, in which they are kept.
    source
        The folder of the course, by default that of the kit.
    say
        What hears, in words, that pages are made.

    Attributes
    ----------
    pages
        Those that are there, by their names.
    many
        How many there will be; 0 where that is not known, or none has to be made.
    is_coming
        Whether those that are not there yet may still come.
    fault
        Why they cannot be made; empty where they can.
    """

    def __init__(self, folder: str | Path, source: Path | None = None, say: Callable[[str], object] = lambda _: None) -> None:
        self.pages: dict[str, Page] = {}
        self.many, self.is_coming, self.fault = 0, True, ""
        self._place, self._source, self._say = Path(folder) / PAGES, source, say
        self._closed = False
        self._thread: Thread | None = None

    @property
    def progress(self) -> dict[str, int] | None:
        """How many are made, and how many there will be; nothing where none is being made."""
        return {"made": len(self.pages), "many": self.many} if self.is_coming and self.many else None

    def begin(self, changed: Callable[[], object]) -> None:
        """Begin to bring them, in a thread, which calls `changed` when another is there."""
        self._thread = Thread(target=self._bring, args=(changed,), daemon=True)
        self._thread.start()

    def _bring(self, changed: Callable[[], object]) -> None:
        try:
            if is_made(self._place, self._source):
                for path in sorted(self._place.rglob("*.html")):
                    if not path.is_symlink():
                        self._take(path)
            else:
                self._say("The pages of the course are made, once. Phones can join meanwhile.")
                self._make(changed)
        except (LSystemError, OSError) as fault:
            self._fail(getattr(fault, "message", str(fault)))
        self.is_coming = False
        changed()

    def _take(self, path: Path) -> None:
        self.pages[path.relative_to(self._place).as_posix()] = Page(path.read_bytes())

    def _fail(self, why: str) -> None:
        self.fault = f"{gettext('The pages of the course cannot be made:')} {why}"
        self._say(self.fault)

    def _make(self, changed: Callable[[], object]) -> None:
        """Have them made by a process, and take each when it is there; all are marked when the last is."""
        ours, theirs = _CONTEXT.Pipe()
        process = _CONTEXT.Process(target=_make, args=(theirs, self._place, self._source), daemon=True)
        process.start()
        theirs.close()
        try:
            while not self._closed:
                if ours.poll(A_LITTLE):
                    self._hear(json.loads(ours.recv_bytes()))
                    changed()
        except (EOFError, OSError):
            if not self.fault and not is_made(self._place, self._source):
                self._fail(gettext("The process that makes them has ended."))
        finally:
            ours.close()
            process.join(ENDING)
            process.kill()
            process.join()

    def _hear(self, told: dict[str, object]) -> None:
        if "mistake" in told:
            self._fail(str(told["mistake"]))
        else:
            self.many = int(str(told["many"]))
            self._take(Path(str(told["page"])))

    def close(self) -> None:
        """Make no more of them."""
        self._closed = True
        if self._thread is not None:
            self._thread.join(2 * ENDING)


def version(source: Path | None = None) -> str:
    """By what pages are known as those of this kit: its course, its scripts and its language."""
    parts = [path.read_bytes() for path in course_files(source).values()]
    package = files("lsys_kit")
    parts += [compact("class_page").encode(), style("course").encode(), style("class_page").encode(), language().encode()]
    parts += [(package / "classroom" / "site" / "pages.py").read_bytes()]
    return sha256(b"\0".join(parts)).hexdigest()


def is_made(place: Path, source: Path | None = None) -> bool:
    """Whether all pages of a course are in a folder, as this kit makes them."""
    with suppress(OSError, ValueError, KeyError, TypeError):
        return bool(json.loads((place / MADE).read_bytes())[KIT_MARK.decode()] == version(source))
    return False


def mark_made(place: Path, source: Path | None = None) -> None:
    """Write down that all pages of a course are in a folder."""
    with file_errors(f'"{place}" cannot be written'):
        replace_file(place / MADE, json.dumps({KIT_MARK.decode(): version(source)}).encode())


# In the process that makes them


def _make(pipe: Connection, place: Path, source: Path | None) -> None:
    """Make the pages, and tell of each; whoever waits for them may end this at any time, or be gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of a terminal, or of a cell: the server ends it
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # kernels are ended, too
    Thread(target=_end_with, args=(pipe,), daemon=True).start()
    if hasattr(os, "nice"):
        os.nice(NICER)

    def tell(told: dict[str, object]) -> None:
        with suppress(OSError):
            pipe.send_bytes(json.dumps(told).encode())

    try:
        build_site(place, source, live=CLASS, heard=lambda page, many: tell({"page": str(page), "many": many}))
        mark_made(place, source)
    except LSystemError as fault:
        tell({"mistake": f"{fault.message}. {fault.hint or ''}".strip()})
    except KeyboardInterrupt:
        pass


def _end_with(pipe: Connection) -> None:
    """End this process when the other end of a pipe is closed, by whatever; a cell that runs on is not waited for long."""
    with suppress(EOFError, OSError):
        pipe.recv_bytes()
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(ENDING)
    os._exit(1)
