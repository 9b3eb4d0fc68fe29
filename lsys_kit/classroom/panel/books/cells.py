"""What the books of maps and of cellworks share: how many steps they hold, and where a production stands in its text."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate

from lsys_kit.notation.model.cellworks import CellworkProduction
from lsys_kit.notation.model.maps import EdgeProduction


def last_held(sizes: Iterable[int], asked: int, most: int, called: str) -> tuple[int, str]:
    """The last step that a book holds, and why it ends there: "" if there are no further steps.

    Parameters
    ----------
    sizes
        The number of walls of each step.
    asked
        The step that must be held, if there is one.
    most
        Later steps are held while all together have no more walls than this.
    called
        What later steps are called.

    Examples
    --------
    >>> last_held([4, 7, 12, 24], 1, 20, "maps")[0], last_held([4, 7, 12, 24], 3, 20, "maps")
    (1, (3, ''))
    """
    sums = [*accumulate(sizes)]
    last = min(max([asked, *(step for step, sum in enumerate(sums) if sum <= most)]), len(sums) - 1)
    if last == len(sums) - 1:
        return last, ""
    return last, (
        f"The panel ends at step {last}: later {called} take long to come to rest. "
        f"The rules may ask for more: steps: {last + 1}"
    )


def span(rule: EdgeProduction | CellworkProduction) -> list[int] | None:
    """Between which offsets of its text a production stands."""
    last = rule.successor[-1].at
    return [rule.at[0], last[1]] if rule.at and last else None
