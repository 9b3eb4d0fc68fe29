"""What a class tells, as rows of one table: all that was acknowledged is in it, and what is shown of a class is a view of it.

The table is an SQLite file in WAL mode, and a row is on the disk before anybody hears that it was kept (synchronous = FULL). A
row has the number of its phone's message, so that a message that is sent again is counted once; what counts is the order of
these numbers and of the rows, never a clock. Of a phone nothing is kept but a random number.

Several programs may have the same table: each reads what the others have written, in the order of the rows.
"""

from __future__ import annotations

import json
import secrets
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from lsys_kit.errors import LSystemError, ModelFileError, quotable

FILE = "class.sqlite3"
"""What the table is called in the folder of a class."""
TEACHER = ""
"""What stands for a phone in the rows of the teacher."""
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
"""Join codes have no I and no O, which look like digits."""
SECONDS = 5.0
"""So long one program waits for another that writes into the same file."""
_VERSION = 1
_MARK = 0x4C535953
"""By which a file of the kit is known (PRAGMA application_id): "LSYS"."""
_TABLES = (
    "CREATE TABLE class (code TEXT PRIMARY KEY, name TEXT NOT NULL, secret TEXT NOT NULL)",
    """CREATE TABLE event (
  number INTEGER PRIMARY KEY, code TEXT NOT NULL, phone TEXT NOT NULL, sent INTEGER NOT NULL, kind TEXT NOT NULL,
  about TEXT NOT NULL, round INTEGER NOT NULL, value TEXT NOT NULL, UNIQUE (code, phone, sent)
)""",
    f"PRAGMA application_id = {_MARK}",
    f"PRAGMA user_version = {_VERSION}",
)
_EVENTS = "SELECT number, code, phone, sent, kind, about, round, value FROM event"


class Event(NamedTuple):
    """Something that a phone or the teacher has said to a class.

    code, phone, sent
        The join code of the class; the phone's random number, or `TEACHER`; the number of the message among that phone's.
    kind, about, round
        What it is, such as "vote"; about which question; the first vote or the second, or the step of a game.
    value
        What was said: anything that JSON can hold.
    """

    code: str
    phone: str
    sent: int
    kind: str
    about: str
    round: int
    value: Any


class ClassEntry(NamedTuple):
    """A class: its join code, its name, and the secret that opens its board."""

    code: str
    name: str
    secret: str


class NotKept(LSystemError):
    """The table cannot be written to, as when the disk is full."""


class Events:
    """The table of a folder; it is made if there is none.

    Raises
    ------
    ModelFileError
        The folder cannot be written to, or what stands there is no table of the kit.
    """

    def __init__(self, folder: str | Path) -> None:
        self.path = Path(folder) / FILE
        self._seen = 0
        name = quotable(str(self.path))
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._table = sqlite3.connect(self.path, timeout=SECONDS, isolation_level=None, check_same_thread=False)
            self._begin(name)
        except (sqlite3.Error, OSError) as fault:
            raise ModelFileError(f'"{name}" cannot be used for a class: {fault}', hint="Choose another --folder.") from None

    def _begin(self, name: str) -> None:
        self._table.execute("PRAGMA journal_mode = WAL")
        self._table.execute("PRAGMA synchronous = FULL")
        with self._together():  # of several programs that begin at once, one makes the table
            mark, version, there = (
                self._table.execute(asked).fetchone()[0]
                for asked in ("PRAGMA application_id", "PRAGMA user_version", "SELECT count(*) FROM sqlite_master")
            )
            for each in () if there else _TABLES:
                self._table.execute(each)
        if there and (mark, version) != (_MARK, _VERSION):
            raise ModelFileError(f'"{name}" is not a table of this version of the kit', hint="Choose another --folder.")

    def classes(self) -> list[ClassEntry]:
        """The classes, in the order in which they were begun."""
        return [ClassEntry(*row) for row in self._table.execute("SELECT code, name, secret FROM class ORDER BY rowid")]

    def named(self, name: str) -> ClassEntry:
        """The class of a name, begun now if there is none."""
        with self._written():
            known = self.classes()
            found = next((each for each in known if each.name == name), None)
            if found is None:
                taken = {each.code for each in known}
                code = next(code for code in _codes() if code not in taken)
                found = ClassEntry(code, name, secrets.token_urlsafe(16))
                self._table.execute("INSERT INTO class VALUES (?, ?, ?)", found)
        return found

    def keep(self, events: Sequence[Event]) -> list[bool]:
        """Keep some events, all or none of them; for each whether it is new, and has not been sent before.

        Raises
        ------
        NotKept
            They cannot be written, and none of them is kept.
        """
        rows = [(*each[:6], json.dumps(each.value, ensure_ascii=False, separators=(",", ":"))) for each in events]
        asked = "INSERT OR IGNORE INTO event (code, phone, sent, kind, about, round, value) VALUES (?, ?, ?, ?, ?, ?, ?)"
        with self._written():
            return [self._table.execute(asked, row).rowcount == 1 for row in rows]

    def of(self, code: str) -> Iterator[Event]:
        """The events of a class, in the order in which they were kept."""
        for row in self._table.execute(f"{_EVENTS} WHERE code = ? ORDER BY number", (code,)):
            yield _event(row)

    def news(self) -> list[Event]:
        """The events of all classes that this has not told of before, in their order, whatever program has kept them."""
        last = self._table.execute("SELECT coalesce(max(number), 0) FROM event").fetchone()[0]
        rows = self._table.execute(f"{_EVENTS} WHERE number > ? ORDER BY number", (min(self._seen, last),)).fetchall()
        self._seen = rows[-1][0] if rows else last
        return [*map(_event, rows)]

    def forget(self, code: str) -> int:
        """Delete all that a class has said, and the class; how many rows there were. Nothing of them is left in the file."""
        self._table.execute("PRAGMA secure_delete = ON")
        with self._written():
            many = self._table.execute("DELETE FROM event WHERE code = ?", (code,)).rowcount
            self._table.execute("DELETE FROM class WHERE code = ?", (code,))
        self._table.execute("VACUUM")
        self._table.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        return many

    def close(self) -> None:
        self._table.close()

    @contextmanager
    def _together(self) -> Iterator[None]:
        """A `with` block whose changes are all made, or none."""
        try:
            self._table.execute("BEGIN IMMEDIATE")
            yield
            self._table.execute("COMMIT")
        finally:
            if self._table.in_transaction:
                self._table.execute("ROLLBACK")

    @contextmanager
    def _written(self) -> Iterator[None]:
        """The same; a fault of the table becomes an error of the kit."""
        try:
            with self._together():
                yield
        except sqlite3.Error as fault:
            hint = "Make room on the disk; phones send again what was not kept."
            raise NotKept(f"Nothing can be kept: {fault}", hint=hint) from None


def _event(row: Sequence[Any]) -> Event:
    return Event._make((*row[1:-1], json.loads(row[-1])))


def _codes() -> Iterator[str]:
    while True:
        yield "".join(secrets.choice(LETTERS) for _ in range(4))
