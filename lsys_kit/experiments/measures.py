"""Measures: what is asked of each run, one number a step.

A measure is named, so that a lesson needs no programming: a quantity below, or a symbol, whose modules are then counted. Or it
is a function of a derivation, which looks at its last word.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from numbers import Real
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError, shown
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.pictures.style.labels import polar_symbols

Measurable: TypeAlias = Derivation | Word
"""What is measured: a word, or the last word of a derivation, which often is not even built."""
Asked: TypeAlias = "str | Callable[[Any], object] | Mapping[str, object] | Iterable[object]"
"""A measure as a person gives it, or several, perhaps with names of their own."""


class Measure(NamedTuple):
    """A measure: the name of its column, and the function that finds its value."""

    name: str
    value: Callable[[Measurable], object]

    def of_counts(self) -> Callable[[Mapping[str, Any]], Any] | None:
        """The function that finds its value if it is only known how often each symbol occurs; None, where that is too little.

        >>> from lsys_kit import read
        >>> [each.of_counts()({"F": 3, "A": 1}) for each in measures_of(["modules", "F"], read("axiom: F"))]
        [4, 3]
        """
        if self.value is _modules:
            return lambda counts: sum(counts.values())
        if isinstance(self.value, partial) and self.value.func is count:
            wanted = self.value.args[0]
            return lambda counts: sum(number for symbol, number in counts.items() if symbol in wanted)
        return None


def measures_of(asked: Asked, system: LSystem) -> tuple[Measure, ...]:
    """The measures that a person asks for: names of measures or symbols of the system, or functions; no name stands twice.

    >>> from lsys_kit import read
    >>> [each.name for each in measures_of(["height", "F"], read("axiom: F"))]
    ['height', 'F']
    """
    found = tuple(Measure(name, _function(name, each, system)) for name, each in _named(asked))
    names = [each.name for each in found]
    for name in names:
        if names.count(name) > 1:
            raise ModelNameError(
                f'Two measures are called "{name}"', hint='Give them names of their own: measure={"first": ..., "second": ...}.'
            )
    if not found:
        raise ModelValueError("Nothing is measured", hint=f"Measures are: {', '.join(MEASURES)}, or a symbol to count.")
    return found


def _named(asked: object) -> Iterator[tuple[str, object]]:
    for each in asked if isinstance(asked, list | tuple) else (asked,):
        yield from _with_names(each)


def _with_names(asked: object) -> Iterator[tuple[str, object]]:
    if isinstance(asked, Mapping):
        for name, each in asked.items():
            if not isinstance(name, str):
                raise ModelValueError(f"The name of a measure is a text, not {shown(name)}")
            yield name, each
    elif isinstance(asked, str):
        yield asked, asked
    elif callable(asked):
        name = getattr(asked, "__name__", "")
        yield (name if name.isidentifier() else "measure"), asked
    else:
        raise ModelValueError(f'A measure is a name such as "modules", or a function of a derivation, not {shown(asked)}')


def _function(name: str, asked: object, system: LSystem) -> Callable[[Measurable], object]:
    if callable(asked):
        return partial(_called, name, asked)
    if not isinstance(asked, str):
        raise ModelValueError(f'The measure "{name}" must be a name or a function, not {shown(asked)}')
    if asked in MEASURES:
        return MEASURES[asked]
    counted = symbols_named(asked, system)
    if not counted:
        known = [*MEASURES, *symbols(system)]
        raise ModelNameError(
            f'"{asked}" is neither a measure nor a symbol of the system',
            hint=suggestion(asked, known) or f"Measures are: {', '.join(MEASURES)}, or a symbol to count.",
        )
    return partial(count, counted)


def symbols_named(name: str, system: LSystem) -> frozenset[str]:
    """The symbol with a name, or both polarities of a cell.

    >>> from lsys_kit import read
    >>> sorted(symbols_named("a", read("axiom: ar\\nar -> al b\\nal -> b ar")))
    ['al', 'ar']
    """
    if name in symbols(system):
        return frozenset({name})
    return frozenset(symbol for symbol, (letter, _) in polar_symbols(system).items() if letter == name)


def count(wanted: frozenset[str], what: Measurable) -> int:
    """How many modules have one of some symbols."""
    if isinstance(what, Word):
        return sum(number for symbol, number in what.counts().items() if symbol in wanted)
    modules = what.states.modules
    return sum(number for state, number in what.counts(what.steps).items() if modules[state].symbol in wanted)


def _modules(what: Measurable) -> int:
    return len(what) if isinstance(what, Word) else what.lengths[-1]


def _rate(what: Measurable) -> float:
    system = what.states.system
    return growth(
        system, **{each.name: value for each, value in zip(system.constants, what.states.constants, strict=True)}
    ).rate


MEASURES: Mapping[str, Callable[[Measurable], float]] = {
    "modules": _modules,
    "length": _modules,
    "cells": lambda what: len(scene_of(what).cells),
    "strokes": lambda what: len(scene_of(what).segments),
    "height": lambda what: scene_of(what).height,
    "width": lambda what: scene_of(what).width,
    "rate": _rate,
}
"""The quantities that have names: the number of modules, which is the length of the word; the cells of a filament and the
strokes of the turtle; the extent of the drawing in the units of the model; the growth per step in the long run (see
`growth`)."""


def _called(name: str, function: Callable[[Measurable], object], what: Measurable) -> object:
    try:
        return number(function(what), name)
    except LSystemError:
        raise
    except Exception as fault:
        raise ModelValueError(f'The measure "{name}" failed with {type(fault).__name__}: {fault}') from fault


def number(value: object, name: str) -> object:
    """A measured value as a plain number.

    >>> import numpy as np
    >>> number(np.int64(3), "size")
    3
    """
    plain = value.item() if hasattr(value, "item") and getattr(value, "shape", None) == () else value
    if isinstance(plain, Real):
        return plain
    raise ModelValueError(f'The measure "{name}" must give a number, not {shown(plain)}')
