"""A test that goes through the rows of a table: all that fail are named, not the first alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import pytest

Row = Callable[..., AbstractContextManager[None]]
"""What a row is looked at in, given what names it."""


@contextmanager
def every_row() -> Iterator[Row]:
    """The errors of all rows are raised at the end, each with the name of its row.

    >>> with every_row() as row:
    ...     for text in ("a", "b", "c"):
    ...         with row(text):
    ...             assert text == "b"
    Traceback (most recent call last):
    ExceptionGroup: 2 rows fail: a; c (2 sub-exceptions)
    """
    failed: dict[str, BaseException] = {}

    @contextmanager
    def row(*names: object) -> Iterator[None]:
        try:
            yield
        except (Exception, pytest.fail.Exception) as error:
            name = ", ".join(map(str, names))
            error.add_note(name)
            failed[name] = error

    try:
        yield row
    except Exception as error:
        failed["what is outside the rows"] = error
    if failed:
        counted = "1 row fails" if len(failed) == 1 else f"{len(failed)} rows fail"
        raise BaseExceptionGroup(f"{counted}: {'; '.join(failed)}", [*failed.values()])
