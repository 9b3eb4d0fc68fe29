"""Two panels side by side with one step slider: two systems, or two settings of one."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

import traitlets
from ipywidgets import widget_serialization

from lsys_kit.classroom.panel.bundle import bundled, style
from lsys_kit.classroom.panel.explorer import Explorer, chosen_names, explore
from lsys_kit.classroom.widget import KitWidget
from lsys_kit.errors import ModelValueError, quotable
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem

_COMMON = {"what": "The system", "step": "The step", "sliders": "The choice of sliders", "show": "The choice of views"}
"""What a side cannot have of its own, though `explore` takes it."""


def compare(
    what: LSystem | MapSystem | CellworkSystem | str,
    *others: LSystem | MapSystem | CellworkSystem | str | Mapping[str, object],
    step: int | None = None,
    sliders: str | Collection[str] | None = None,
    show: str | Collection[str] | None = None,
    shared: str | Collection[str] = (),
    **choices: object,
) -> Comparison:
    """Show two systems, or one under two settings of its constants, side by side with one step slider.

    Where the words differ is marked, and said in words below.

    Parameters
    ----------
    what
        A system, as for `explore`.
    *others
        Another system; or two settings of this one, each a dictionary of constants. A single dictionary is compared with the
        system as it is.
    step
        The step shown first; by default that of the first system.
    sliders
        What has a slider on both sides, as for `explore`; by default everything has one.
    show
        The views that are open on both sides at first, as for `explore`; by default the word and the drawing.
    shared
        The constants, one or a list, that one slider moves on both sides; at first they are what they are on the left.
    **choices
        None: constants, angle and seed of a side stand in its dictionary.

    Raises
    ------
    ModelValueError
        It is not clear what is compared with what, or a choice is none of a side's.
    ModelNameError
        One of the two has no slider or view of that name.

    Examples
    --------
    >>> both = compare("J4", {}, {"lifeTimeA": 2, "lifeTimeB": 3}, step=9)
    >>> both.left.settings, both.right.settings
    ({'lifeTimeA': '3', 'lifeTimeB': '2'}, {'lifeTimeA': '2', 'lifeTimeB': '3'})
    >>> both.left.step = 4
    >>> both.right.step
    4
    """
    for name in choices:
        if name == "field":
            explore(what, field=choices[name])  # says why a panel has none
        raise ModelValueError(
            f'"{quotable(name)}" stands beside what is compared, and belongs to one side of it',
            hint=f'Each side has settings of its own: compare("J4", {{}}, {{"{quotable(name)}": ...}}).',
        )
    match others:
        case (Mapping() as first, Mapping() as second):
            sides = (what, first), (what, second)
        case (Mapping() as second,):
            sides = (what, {}), (what, second)
        case (LSystem() | MapSystem() | CellworkSystem() | str() as other,):
            sides = (what, {}), (other, {})
        case _:
            raise ModelValueError(
                "Two systems are compared, or one system under two settings",
                hint='For example compare("P2", "P3"), or compare("J4", {}, {"lifeTimeA": 2}).',
            )
    left = explore(sides[0][0], step, sliders=sliders, show=show, **_named(sides[0][1]))
    right = explore(sides[1][0], left.step, sliders=sliders, show=show, **_named(sides[1][1]))
    return Comparison(left, right, chosen_names(shared, "slider", [name for name in left.settings if name in right.settings]))


def _named(settings: Mapping[str, object]) -> dict[str, Any]:
    for name in settings:
        if not isinstance(name, str):
            raise ModelValueError(f"Constants have names, not {name!r}", hint='A setting is for example {"lifeTimeA": 2}.')
        if name in _COMMON:
            raise ModelValueError(
                f"{_COMMON[name]} is no setting of one side",
                hint='It stands beside the two, as in compare("J4", {}, {"lifeTimeA": 2}, step=9).',
            )
    return dict(settings)


class Comparison(KitWidget):
    """The two panels that `compare` shows.

    Attributes
    ----------
    left, right
        The panels, as `explore` makes them; their steps are the same.
    shared
        The names of the constants that are the same on both sides.
    """

    _esm = bundled("comparison")
    _css = style()
    left = traitlets.Instance(Explorer).tag(sync=True, **widget_serialization)
    right = traitlets.Instance(Explorer).tag(sync=True, **widget_serialization)

    shared = traitlets.List(traitlets.Unicode()).tag(sync=True)

    def __init__(self, left: Explorer, right: Explorer, shared: Collection[str] = ()) -> None:
        super().__init__(left=left, right=right, shared=sorted(shared))
        traitlets.link((left, "step"), (right, "step"))
        if shared:
            traitlets.dlink((left, "settings"), (right, "settings"), self._shared_of)
            traitlets.dlink((right, "settings"), (left, "settings"), self._shared_of)

    def _shared_of(self, settings: Mapping[str, str]) -> dict[str, str]:
        return {name: settings[name] for name in self.shared if name in settings}

    @property
    def text(self) -> str:
        """What both panels show, in words."""
        return f"{self.left.text}\n{self.right.text}"

    def page_data(self, asked: Sequence[Mapping[str, object]] = ()) -> dict[str, Any]:
        """What a page without a kernel has to know of both panels, and of the settings that are asked for."""
        return {"left": self.left.page_data(asked), "right": self.right.page_data(asked), "shared": self.shared}

    def _stored(self) -> dict[str, Any]:
        """The words of both, and the picture of the left one."""
        return {"text/plain": self.text, **self.left.still}

    def close(self) -> None:
        """Close both panels, and what the browser keeps of them."""
        for each in (self.left, self.right):
            each.close()
        super().close()

    def __repr__(self) -> str:
        return self.text
