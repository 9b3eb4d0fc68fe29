"""Widgets that nobody sees: what they hold can be read, set and observed, but there is no notebook that shows it.

Python in a browser has no libraries of widgets. A panel answers there all the same: a page asks it, and shows what it says.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager, nullcontext
from typing import Any

import traitlets


class Widget(traitlets.HasTraits):
    """A widget without a front end, to which nothing is told and from which nothing is heard."""

    comm = None

    def on_msg(self, handler: object) -> None:
        """No message comes."""

    def hold_sync(self) -> AbstractContextManager[None]:
        """Nothing is told meanwhile, nor afterwards."""
        return nullcontext()

    def close(self) -> None:
        """Nothing is open."""


class AnyWidget(Widget):
    """A widget whose script is nowhere loaded."""

    layout = Widget()


widget_serialization: Mapping[str, Any] = {}
"""How widgets name one another to their front ends, of which there are none."""
