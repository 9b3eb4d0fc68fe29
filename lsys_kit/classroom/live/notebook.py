"""`open_class`: a class that is opened in a cell of a notebook, and the board of it below the cell.

The server is a child process (`kernel_board`), so that a long cell keeps no phone waiting. What it tells comes by a pipe, for
which a thread waits here.
"""

from __future__ import annotations

import atexit
import json
import multiprocessing
from collections.abc import Mapping
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Lock, RLock, Thread
from typing import Any
from weakref import WeakSet

import traitlets

from lsys_kit.classroom.lessons.opening import LISTENERS
from lsys_kit.classroom.live.serving import FOLDER, NAME, checked_names, missing_library, mistake_told
from lsys_kit.classroom.panel.bundle import bundled, style, translated_words
from lsys_kit.classroom.places import course_of
from lsys_kit.classroom.widget import KitWidget
from lsys_kit.errors import LSystemError, ModelFileError, ModelValueError, quotable, require, whole_number
from lsys_kit.files import Entries
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import language

A_LITTLE = 0.2
"""Whoever waits for a class looks after so many seconds whether it is still coming."""
ENDING = 15.0
"""So many seconds a class has to end."""
LAST_PORT = 65_535
_CONTEXT = multiprocessing.get_context("spawn")


def open_class(
    name: str = NAME, folder: str | Path = FOLDER, port: int | None = None, course: bool | str | Path = True
) -> ClassBoard:
    """Open a class, as `lsys-kit class` does in a shell, and show its board below the cell.

    Phones join by the QR code or the address. `vote` and `predict` in later cells of the notebook open their questions for the
    whole class. The class ends with the kernel; the same call, in this kernel or in another one, finds it where it was.

    Parameters
    ----------
    name
        What the class is called.
    folder
        Where what the class says is kept, and the pages of the course.
    port
        Where the server listens; by default at 8765, or at another port if that is taken. 0 lets the system choose.
    course
        Whether the phones have the pages of the course; or the folder of a course of your own, as `lsys-kit lesson new` writes
        it. Pages are made the first time, while the class is open: the board says how many are there.

    Returns
    -------
    ClassBoard
        The board. `end()` ends the class.

    Raises
    ------
    ModelValueError
        No class can be called so, or there is no such port.
    ModelFileError
        The folder or the port cannot be used, or there is no course in the folder of a course.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     board = open_class("10b", folder, port=0, course=False)
    ...     board.name, len(board.code), open_class("10b", folder).code == board.code
    ...     board.end()
    ('10b', 4, True)
    """
    require(name, str, "The name of a class")
    require(course, (bool, str, Path), 'True, False or a folder for "course"')
    if not isinstance(course, bool):
        course = str(course_of(Path(course)).root)
    place = _folder(folder)
    if port is not None and not 0 <= (port := whole_number(port, "The port")) <= LAST_PORT:
        raise ModelValueError(f"A port is a number from 0 to {LAST_PORT}")
    [name] = checked_names([name])
    found = _OPEN.get((place, name))
    if found is None or not found.is_open:
        found = _OPEN[place, name] = _Class(place, name, port, course)
    return ClassBoard(found)


def _folder(folder: object) -> str:
    if not isinstance(folder, str | Path):
        require(folder, str, "The folder of a class")
    try:
        return str(Path(str(folder)).resolve())
    except (OSError, ValueError, RuntimeError):
        raise ModelFileError(f'"{quotable(str(folder))}" cannot be used for a class', hint="Choose another folder.") from None


class _Class:
    """A class that was opened in this kernel: the child process that serves it, and its boards in the notebook."""

    def __init__(self, folder: str, name: str, port: int | None, course: bool | str) -> None:
        self._folder = folder
        self._pipe, theirs = _CONTEXT.Pipe()
        self._process = _CONTEXT.Process(target=_serve, args=(theirs, folder, name, port, course, language()))
        self._lock, self._showing, self._boards = Lock(), RLock(), WeakSet[ClassBoard]()
        self.state: dict[str, object] = {}
        self.is_open = True
        self._process.start()
        theirs.close()
        try:
            self.about = self._opened()
        except BaseException:
            self.end()
            raise
        Thread(target=self._listen, daemon=True).start()

    def _opened(self) -> dict[str, object]:
        """What the server says of itself when it has begun."""
        while True:
            while not self._pipe.poll(A_LITTLE):
                if not self._process.is_alive():
                    raise LSystemError("The class could not be opened", hint="Run the cell again.")
            try:
                told = json.loads(self._pipe.recv_bytes())
            except (EOFError, OSError):
                raise LSystemError("The class could not be opened", hint="Run the cell again.") from None
            if "mistake" in told:
                kind = ModelFileError if told["of_file"] else LSystemError
                raise kind(told["mistake"], hint=told["hint"])
            return dict(told["about"])

    def _listen(self) -> None:
        with suppress(EOFError, OSError):
            while True:
                told = json.loads(self._pipe.recv_bytes())
                with self._showing:
                    self.state = told.get("state", self.state)
                    for board in [*self._boards]:
                        board.hear(told)
        with self._showing:
            self.is_open = False
            for board in [*self._boards]:
                board.ended = True

    def show(self, board: ClassBoard) -> None:
        """Let a board hear what the class tells from now on, and show what it has told since the board was begun."""
        with self._showing:
            self._boards.add(board)
            board.state, board.ended = self.state, not self.is_open

    def forget(self, board: ClassBoard) -> None:
        """Let a board hear nothing any more."""
        with self._showing:
            self._boards.discard(board)

    def tell(self, content: Mapping[str, object]) -> None:
        """Tell the server something; one that is gone hears nothing."""
        with self._lock, suppress(OSError):
            self._pipe.send_bytes(json.dumps(content).encode())

    def end(self) -> None:
        """End the server, and wait until it is gone."""
        self.tell({"end": True})
        self._process.join(ENDING)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()
        self.is_open = False


def _serve(*given: Any) -> None:
    """In the child process: serve."""
    pipe: Connection = given[0]
    try:
        import tornado  # noqa: F401
    except ImportError:
        pipe.send_bytes(json.dumps(mistake_told(missing_library("tornado"))).encode())
        return
    from lsys_kit.classroom.live.kernel_board import serve_kernel

    serve_kernel(*given)


_OPEN: dict[tuple[str, str], _Class] = {}
"""The classes that were opened in this kernel, by their folders and names."""


@atexit.register
def _end_all() -> None:
    for each in _OPEN.values():
        if each.is_open:
            each.end()


def _open_for_all(kind: str, about: str, round: int) -> None:
    """Let all classes of this kernel answer a question that a cell asks."""
    for each in _OPEN.values():
        if each.is_open:
            each.tell({"do": "open", "kind": kind, "asked" if kind == "prediction" else "about": about, "round": round})


LISTENERS.append(_open_for_all)


class ClassBoard(KitWidget):
    """The board of a class, as `open_class` shows it.

    Attributes
    ----------
    about, state
        What the board says of the class, and what it shows now.
    ended
        Whether the class has ended.
    """

    _esm = bundled("class_board")
    _css = style("lessons") + style("board")
    about = traitlets.Dict().tag(sync=True)
    state = traitlets.Dict().tag(sync=True)
    ended = traitlets.Bool(False).tag(sync=True)

    def __init__(self, of: _Class) -> None:
        self._class = of
        super().__init__(about={**of.about, "words": translated_words("class_board")}, state=of.state, ended=not of.is_open)
        self.on_msg(self._told)
        of.show(self)

    def _told(self, _: object, content: object, __: object) -> None:
        if isinstance(content, dict):
            self._class.tell(content)

    @property
    def name(self) -> str:
        """What the class is called."""
        return str(self._class.about["name"])

    @property
    def code(self) -> str:
        """The four letters by which phones join."""
        return str(self._class.about["code"])

    @property
    def address(self) -> str:
        """The address at which phones join."""
        return str(self._class.about["address"])

    @property
    def projected(self) -> str:
        """The secret address of the board for the projector."""
        return str(self._class.about["board"])

    def end(self) -> None:
        """End the class; `open_class` opens it again where it was."""
        self._class.end()

    def hear(self, told: Entries) -> None:
        """Show what the class tells."""
        if "state" in told:
            self.state = told["state"]
        else:
            self.send(dict(told))

    def close(self) -> None:
        """Close the board; the class goes on."""
        self._class.forget(self)
        super().close()

    def _stored(self) -> dict[str, object]:
        return {"text/html": f"<p>{escaped(repr(self))}</p>", "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"{self.name}: join with the code {self.code} at {self.address}"
