"""What others have made is worked on in child processes: what goes wrong there costs its own piece alone."""

from __future__ import annotations

import os
import signal
import sys

import pytest

from lsys_kit.classroom import child_processes
from lsys_kit.classroom.child_processes import CRASHED, TOO_LONG, TOO_MUCH, Failed, in_child_processes

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the limits are those of Linux")


def worked(what: object) -> object:
    """What a piece says."""
    match what:
        case "crash":
            os.kill(os.getpid(), signal.SIGKILL)
        case "leave":
            os._exit(0)
        case "endless":
            while True:
                pass
        case "wait":
            signal.pause()
        case "memory":
            return len(bytearray(2**36))
        case "raise":
            raise KeyError("text of a <student>")
        case "print":
            os.write(1, b"\x1b[2J")
            os.write(2, b"to the screen")
            return os.read(0, 10) == b""
        case "write":
            with open(os.environ["LSYS_TEST_FILE"], "w", encoding="utf-8") as file:
                file.write("a" * 100_000)
        case "result":
            return object()
    return [what]


def found(*pieces: object, together: int = 1, seconds: int = 60) -> list[object]:
    return in_child_processes(worked, pieces, seconds, together=together)


@pytest.mark.slow
@pytest.mark.parametrize("together", [1, 3])
@pytest.mark.parametrize(
    ("piece", "comes"),
    [
        ("crash", Failed(CRASHED)),
        ("leave", Failed(CRASHED)),
        ("memory", Failed(TOO_MUCH)),
        ("raise", Failed("It cannot be worked on (KeyError)")),
        ("print", True),
        ("result", Failed(CRASHED)),
    ],
)
def test_a_piece_that_goes_wrong_costs_no_other(piece, comes, together, capfd):
    assert found(1, piece, 2, 3, together=together) == [[1], comes, [2], [3]]
    assert capfd.readouterr() == ("", "")


@pytest.mark.slow
@pytest.mark.parametrize("together", [1, 3])
def test_an_endless_piece_costs_no_other(together):
    assert found("endless", 1, 2, together=together, seconds=1) == [Failed(TOO_LONG), [1], [2]]


@pytest.mark.slow
def test_a_piece_that_waits_costs_no_other(monkeypatch):
    monkeypatch.setattr(child_processes, "PATIENCE", 0.5)
    assert found("wait", "wait", seconds=2) == [Failed(TOO_LONG)] * 2


def test_a_child_writes_no_files(tmp_path, monkeypatch):
    monkeypatch.setenv("LSYS_TEST_FILE", str(tmp_path / "made"))
    assert isinstance(found("write")[0], Failed)
    assert (tmp_path / "made").stat().st_size == 0


def test_no_piece_is_nothing_to_do():
    assert found() == []


def test_a_child_begins_with_what_was_loaded_here():
    assert in_child_processes(_seen, ["a"], 60) == [None]
    _KNOWN["a"] = "computed before"
    assert in_child_processes(_seen, ["a"], 60) == ["computed before"]


_KNOWN: dict[str, str] = {}


def _seen(key: str) -> str | None:
    return _KNOWN.get(key)
