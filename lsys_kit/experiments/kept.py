"""What is finished of an ensemble or a sweep, in a file that is written as it comes, so that the same call goes on from there.

The file is a table as spreadsheets read it (RFC 4180): a row for each run and step. Its last column is empty and called after
the kit and what was asked: the system, the measures and the constants that do not vary. Exact numbers are written as decimals
or quotients, doubles with an exponent, so that each is read as it was. A row that was cut off lacks its last comma, and is made
again. Parquet would not do: such a file ends with a table of its contents, without which nothing of a killed program is read.
"""

from __future__ import annotations

import csv
import io
import os
import re
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from types import CodeType
from typing import Any

from lsys_kit.budget import check_bytes
from lsys_kit.errors import ModelFileError, ModelValueError, quotable
from lsys_kit.experiments.making import Experiment, Rows
from lsys_kit.experiments.measures import Measure, measures_of
from lsys_kit.experiments.table import Row
from lsys_kit.files import KIT_MARK, append_line, create_file, file_errors, path_from
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text

SECONDS = 1.0
"""What is finished is written to the file no later than this."""
_AS_CSV = "They are kept as CSV: let the name end in .csv. Other forms are made of the table afterwards, by to_pandas()."
_EXACT = re.compile(r"-?\d{1,4000}(\.\d{1,4000}|/\d{1,4000})?")
_DOUBLE = re.compile(r"-?\d{1,400}(\.\d{1,400})?e[-+]?\d{1,4}|-?inf|nan")


class Kept:
    """The finished runs of a file, if there is one."""

    def __init__(self, path: Path | None, head: Sequence[str], keys: int, steps: Sequence[int]) -> None:
        self.broken = ""
        """Why the file is not kept any more, as a remark says it."""
        self._path, self._head, self._keys, self._steps = path, _line(head), keys, steps
        self._known: dict[tuple[object, ...], Row] = {}
        self._waiting: list[str] = []
        self._written = time.monotonic()
        if path is not None:
            self._read(path, len(head))

    def _read(self, path: Path, columns: int) -> None:
        """Know what is in the file; one that is not there yet is made."""
        name = quotable(path.name)
        if path.suffix.lower() != ".csv":
            raise ModelFileError(f'Runs cannot be kept in "{name}"', hint=_AS_CSV)
        with file_errors(f'Runs cannot be kept in "{name}"'):
            if not os.path.lexists(path):
                return create_file(path, f"{self._head}\n".encode())
            check_bytes(path.stat().st_size, lambda: f'"{name}" was not read')
            lines = path.read_bytes().decode("utf-8-sig", "replace").split("\n")[:-1]
        if not lines or lines[0].strip() != self._head:
            raise ModelFileError(
                f'"{name}" holds something else than these runs',
                hint="Its model, measures or constants are others: choose another name, or delete it first.",
            )
        for row in csv.reader(lines[1:]):
            values = [*map(_number, row[:-1])]
            if len(row) == columns and None not in values:
                self._known[tuple(values[: self._keys + 1])] = tuple(values[self._keys :])
        return None

    def rows(self, setting: tuple[object, ...]) -> Rows | None:
        """What a run with some settings came to, if all its steps are known."""
        found = [self._known.get((*setting, step)) for step in self._steps] if self._known else []
        return tuple(row for row in found if row is not None) if found and None not in found else None

    def keep(self, setting: tuple[object, ...], rows: Rows) -> None:
        """Keep what a run came to."""
        if self._path is None:
            return
        self._waiting += [_line([*map(_text, (*setting, *row)), ""]) for row in rows]
        if time.monotonic() - self._written >= SECONDS:
            self.write()

    def write(self) -> None:
        """Write what is waiting to the file; if that cannot be done, the runs go on."""
        if self._path is None or not self._waiting or self.broken:
            return
        try:
            append_line(self._path, "\n".join(self._waiting), self._head)
        except OSError as fault:
            self.broken = f'"{quotable(self._path.name)}" does not have all of these runs: {fault.strerror or fault}.'
        self._waiting.clear()
        self._written = time.monotonic()


@contextmanager
def kept(
    file: object, experiment: Experiment, columns: Sequence[str], keys: int, choices: Mapping[str, object]
) -> Iterator[Kept]:
    """What is finished of an experiment, in a file or nowhere; all is written at the end, whatever happens."""
    path = None if file is None else path_from(file)
    found = Kept(path, (*columns, _mark(experiment, choices) if path else ""), keys, experiment.steps)
    try:
        yield found
    finally:
        found.write()


def _mark(experiment: Experiment, choices: Mapping[str, object]) -> str:
    """By which a file knows the runs that it holds: their model, what is measured, and with which choices."""
    try:
        chosen = sorted((name, str(value)) for name, value in choices.items())
    except ValueError:  # Python writes no number of more digits than 4,300
        raise ModelValueError("Runs with so long a number cannot be kept in a file") from None
    measured = [*map(_definition, measures_of(experiment.measure, experiment.system))]
    asked = (experiment.system.notation, str(experiment.system), chosen)
    return f"{KIT_MARK.decode()} {sha256(repr((asked, measured)).encode()).hexdigest()[:12]}"


def _definition(measure: Measure) -> object:
    """What a measure does, as far as that can be written: its name, and of a person's own function the code."""
    *_, asked = getattr(measure.value, "args", ()) or (measure.value,)
    if isinstance(asked, frozenset):
        return measure.name, sorted(asked)
    code, held = getattr(asked, "__code__", None), getattr(asked, "__closure__", None) or ()
    values = getattr(asked, "__defaults__", None), [cell.cell_contents for cell in held]
    return measure.name, code and _code(code), repr(values)


def _code(code: CodeType) -> object:
    """The instructions of a function, wherever it stands."""
    constants = (_code(each) if isinstance(each, CodeType) else repr(each) for each in code.co_consts)
    return code.co_code, code.co_names, tuple(constants)


def _line(cells: Sequence[str]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="").writerow(cells)
    return text.getvalue()


def _text(value: Any) -> str:
    """A number as it stands in the file.

    >>> _text(3), _text(Fraction(7, 10)), _text(Fraction(1, 3)), _text(0.7), _text(1e-9)
    ('3', '0.7', '1/3', '0.7e0', '1e-09')
    """
    if isinstance(value, int | Fraction):
        return number_text(normalised(Fraction(value)))
    text = repr(float(value))
    return text if text[-1] in "nf" or "e" in text else f"{text}e0"


def _number(text: str) -> Value | None:
    """A number of the file, or None.

    >>> _number("0.7"), _number("0.7e0"), _number("1/3"), _number("four"), _number("1/0")
    (Fraction(7, 10), 0.7, Fraction(1, 3), None, None)
    """
    if _DOUBLE.fullmatch(text):
        return float(text)
    if not _EXACT.fullmatch(text) or (text.partition("/")[2] and not int(text.partition("/")[2])):
        return None
    return normalised(Fraction(text))
