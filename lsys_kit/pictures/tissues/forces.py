"""Forces that shape maps and cellworks, as a person chooses them."""

from __future__ import annotations

from dataclasses import replace

from lsys_kit.derivation.core.rules import real_from
from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.geometry.tissues.relaxation import DEFAULT_FORCES, Forces

RANGES = {"stiffness": (0.01, 100), "rest": (0, 10), "pressure": (0.001, 10), "damping": (0.1, 10)}
"""The least and the greatest value of each force."""


def forces_of(choices: dict[str, object], usual: Forces = DEFAULT_FORCES, what: str = "map") -> Forces:
    """The chosen forces; the others as usual.

    >>> forces_of({"pressure": "1/5"})
    Forces(stiffness=1.0, rest=0.1, pressure=0.2, damping=1.0)
    """
    values: dict[str, float] = {}
    for name, choice in choices.items():
        if name not in RANGES:
            raise ModelNameError(f'A {what} has no "{name}"', hint=f"Its forces are {', '.join(RANGES)}.")
        least, most = RANGES[name]
        values[name] = real_from(choice, name, f"It lies between {least} and {most}.")
        if not least <= values[name] <= most:
            raise ModelValueError(f'"{name}" must lie between {least} and {most}, not be {values[name]:g}')
    return replace(usual, **values)
