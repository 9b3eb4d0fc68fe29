"""What was typed into the questions of lessons, kept: it is there again when a cell is run again or the kernel is restarted.

In a copy of the course it stands in a file beside the record of tries, a line of JSON for each change, of which the last one
counts. Whoever deletes the file begins anew. Elsewhere it is kept as long as the kernel lives. A file that cannot be written or
read stops no question, and nothing in it is anything but text.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from datetime import datetime
from pathlib import Path

import traitlets

from lsys_kit.classroom.exercises.progress import course_folder
from lsys_kit.files import append_line, replace_file

FILE = "answers.jsonl"
"""The file, in the folder of the course."""
HEAD = '{"made by": "lsys-kit", "holds": "what was typed into votes, predictions and tables"}'
MOST_BYTES = 2_000_000
"""A file is made shorter before it is longer than that, and a longer one is not read."""
MOST_QUESTION, MOST_ANSWERS, MOST_TYPED = 2_000, 200, 1_000
"""So many characters of a question, so many answers to it, and so many characters of each are kept."""


class Changes(traitlets.HasTraits):
    """How often something was kept, for those who look at it."""

    number = traitlets.Int(0)


CHANGES = Changes()
_known: dict[str, tuple[str, ...]] = {}
_not_written: dict[str, tuple[str, ...]] = {}
_read: list[tuple[Path, int, int]] = []


def answered(question: str) -> tuple[str, ...]:
    """What was answered to a question last; nothing where it was not, or was taken back."""
    _renew()
    return _known.get(question[:MOST_QUESTION], ())


def keep(question: str, answers: Sequence[str]) -> None:
    """Keep the answers to a question, in place of earlier ones; none take them back.

    >>> keep("How many?", ["21"])
    >>> answered("How many?")
    ('21',)
    >>> keep("How many?", [])
    """
    question, typed = question[:MOST_QUESTION], tuple(str(each)[:MOST_TYPED] for each in answers[:MOST_ANSWERS])
    if answered(question) == typed:
        return
    _known[question] = typed
    folder = course_folder()
    if folder is None or not _written(folder / FILE, question, typed):
        _not_written[question] = typed
    CHANGES.number += 1


def _renew() -> None:
    """Read the file, if it was not read as it is now."""
    folder = course_folder()
    if folder is None:
        return
    path, state = folder / FILE, None
    with suppress(OSError):
        found = path.stat()
        state = path, found.st_mtime_ns, found.st_size
    if state is None:
        if _read:  # it was deleted
            _read.clear()
            _known.clear()
            _known.update(_not_written)
    elif [state] != _read:
        _read[:] = [state]
        kept = dict(_in_file(path)) if state[2] <= MOST_BYTES and not path.is_symlink() else {}
        _known.clear()
        _known.update(kept | _not_written)


def _in_file(path: Path) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Each line that can be understood."""
    with suppress(OSError, ValueError):
        for line in path.read_text("utf-8", errors="replace").splitlines():
            with suppress(ValueError, RecursionError):
                found = json.loads(line)
                match found:
                    case {"question": str(question), "answers": list(answers)} if all(
                        isinstance(each, str) for each in answers
                    ):
                        yield question[:MOST_QUESTION], tuple(each[:MOST_TYPED] for each in answers[:MOST_ANSWERS])


def _written(path: Path, question: str, answers: Sequence[str]) -> bool:
    with suppress(OSError, ValueError):
        line = _line(question, answers)
        if path.is_file() and path.stat().st_size + len(line.encode()) > MOST_BYTES:
            latest = (_line(each, typed) for each, typed in _known.items() if typed)
            replace_file(path, "".join(f"{each}\n" for each in (HEAD, *latest)).encode())
        append_line(path, line, HEAD)
        return True
    return False


def _line(question: str, answers: Sequence[str]) -> str:
    said: Mapping[str, object] = {
        "time": datetime.now().strftime("%Y-%m-%d %H:%M"),
        "question": question,
        "answers": [*answers],
    }
    return json.dumps(said, ensure_ascii=True)
