"""How much a command does, where that is neither its argument nor a plain multiple of the turtle's own quantity."""

from __future__ import annotations

import math

from lsys_kit.notation.model.arithmetic import Value


def times(argument: str, value: float) -> float:
    """How many times its quantity a command is about, given what its argument is; what is not positive counts as nothing.

    >>> times("times", 3), times("inverse", 4), times("root", 4), times("inverse root", 4), times("inverse", -1)
    (3, 0.25, 2.0, 0.5, 0.0)
    """
    if argument == "times":
        return value
    root = math.sqrt(max(value, 0.0)) if argument.endswith("root") else max(value, 0.0)
    return 1 / root if argument.startswith("inverse") and root else root


def half_turn(angle: Value) -> tuple[float, float]:
    """How Fractint turns round: by 180 degrees, or to the right by the greatest multiple of the angle that is less; as a factor
    of the angle, and degrees.

    >>> half_turn(60), half_turn(72)
    ((0.0, 180.0), (-2.0, 0.0))
    """
    turns = 180 / angle if angle else 0
    return (0.0, 180.0) if turns == math.floor(turns) else (-float(math.floor(turns)), 0.0)
