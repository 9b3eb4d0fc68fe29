"""Limits: nothing that a person types may exhaust the machine.

Like `errors`, this is above all rooms, because every room has something to limit. Limits are set for a block of code:

>>> with limits(modules=1000):
...     current().modules
1000
>>> current().modules
5000000
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace

from lsys_kit.errors import ModelNameError, ModelValueError


@dataclass(frozen=True)
class Limits:
    """The limits in force, each with its unit."""

    modules: int = 5_000_000
    """modules of one word"""
    bytes: int = 512 * 2**20
    """bytes of one word's array"""
    seconds: float = 10.0
    """seconds for deriving"""
    states: int = 1_000
    """states of a stage diagram or growth matrix"""
    text: int = 1_000_000
    """characters of a model"""
    line: int = 50_000
    """characters of a line of a model, or of a word that is read"""
    rules: int = 1_000
    """productions of a model"""
    parameters: int = 16
    """parameters of a module"""
    name: int = 64
    """characters of a name"""
    expression: int = 2_000
    """characters of an expression"""
    depth: int = 50
    """nested operations of an expression"""
    bits: int = 4_096
    """bits of an exact number while it is computed"""
    exponent: int = 1_000
    """absolute value of an exact exponent"""
    repetitions: int = 100_000
    """how often a part of a successor is repeated, or decomposed, where the model says how often"""
    decomposition: int = 100
    """decompositions of what a decomposition made, where the model does not say how often"""
    interpretation: int = 500_000
    """modules that one module is drawn as"""
    brackets: int = 10_000
    """nested brackets of a word"""
    segments: int = 20_000
    """segments of an SVG picture; beyond, a picture of pixels"""
    triangles: int = 10_000_000
    """triangles of a mesh"""


DEFAULT = Limits()
"""The limits where none are set."""
_current: ContextVar[Limits] = ContextVar("limits", default=DEFAULT)


def current() -> Limits:
    """The limits in force here."""
    return _current.get()


@contextmanager
def limits(**changes: float) -> Iterator[Limits]:
    """Set limits for a `with` block.

    Parameters
    ----------
    **changes
        New values for any fields of `Limits`: `modules`, `bytes` and `seconds` above all.

    Raises
    ------
    ModelNameError
        A keyword is not a limit.
    ModelValueError
        A limit is not a positive number.
    """
    for name, value in changes.items():
        if name not in Limits.__dataclass_fields__:
            known = ", ".join(Limits.__dataclass_fields__)
            raise ModelNameError(f'There is no limit called "{name}"', hint=f"Limits are: {known}.")
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0:
            raise ModelValueError(f'The limit "{name}" must be a positive number, not {value!r}')
    token = _current.set(replace(current(), **changes))  # type: ignore[arg-type]
    try:
        yield current()
    finally:
        _current.reset(token)
