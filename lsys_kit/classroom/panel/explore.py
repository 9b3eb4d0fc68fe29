"""Open a panel: of a system, of one in the catalogue, of a text, or of a link."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import Any

from lsys_kit.classroom.catalogue import cell_system, entry
from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.classroom.link import ANGLE, SEED, STEP, linked, settings_given
from lsys_kit.classroom.panel.books.net import Unfolding
from lsys_kit.classroom.panel.explorer import VIEWS, Explorer
from lsys_kit.classroom.panel.opened.kinds import opened
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.errors import ModelNameError, ModelValueError, require, shown
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.fragments import is_link
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem, read_any

_ID = re.compile(r"[\w-]+(\.[\w-]+)?")


def explore(
    what: AnySystem | str,
    step: int | None = None,
    *,
    angle: object = None,
    seed: int = 0,
    sliders: str | Collection[str] | None = None,
    unfold: Unfolding = False,
    show: str | Collection[str] | None = None,
    **constants: object,
) -> Explorer:
    """Show a system with its sliders: rules, word, stage diagram and drawing of one step, side by side.

    Parameters
    ----------
    what
        An L-system, a map system or a cellwork system, the id or name of one in the catalogue, the text of a model, or a link.
    step
        The step shown first; by default the system's own.
    angle
        Degrees by which the turtle turns at first.
    seed
        The seed of the random numbers.
    sliders
        What has a slider besides the step: names of constants or forces, `angle`, `seed`. All else stays as it is, and the
        panel says which constants do. By default everything has one.
    unfold
        A symbol, or several, whose stages the diagram shows one by one, or True for all, as for `stages`.
    show
        The views that are open at first, one or a list of `rules`, `word`, `stages`, `drawing`, `counts`, `seeds` and
        `variants`; by default the word, the stages and the drawing. The others are a click away.
    **constants
        First values of declared constants; of a map or cellwork system those of its forces: `stiffness`, `rest`, `pressure`,
        `damping`.

    Raises
    ------
    ModelValueError
        A first value lies outside its slider's range.
    ModelNameError
        There is no slider or view of that name, or no symbol that is to be unfolded.
    ModelSyntaxError
        The text makes no sense.

    Examples
    --------
    >>> panel = explore("J4", 3)
    >>> panel.step = 9
    >>> print(panel.text)
    Step 9: 9 modules. Al(1)Br(1)Bl(2)Ar(2)Al(3)Bl(1)Ar(1)Bl(2)Ar(2). Stages A(1): 2, A(2): 2, A(3): 1, B(1): 2, B(2): 2. \
9 cells, width 14, height 1.
    >>> explore("P6", 4, dt=1, sliders="dt").settings
    {'dt': '1'}
    """
    if "field" in constants:
        raise ModelValueError(
            "The explorer takes no field of Python: its pages and links hold the text of the model alone",
            hint='Name a field in the text, as in "field: light", or draw or animate with field=...',
        )
    title = ""
    if isinstance(what, str) and _ID.fullmatch(what.strip()):
        title = entry(what.strip()).id
        what = cell_system(title) or catalogued(title)
    if isinstance(what, str) and is_link(what):
        there = linked(what)
        given: dict[str, Any] = {**there.settings, **settings_given(step, angle, seed), **constants}
        what, step, angle, seed = there.system, given.pop(STEP, None), given.pop(ANGLE, None), given.pop(SEED, 0)
        constants = given
    system = read_any(what) if isinstance(what, str) else what
    if not isinstance(system, AnySystem):
        raise ModelValueError(f"Only a system, its id or name, or its text can be explored, not {type(what).__name__}")
    check_unfolded(system, unfold, constants)
    unfold = unfold if isinstance(unfold, bool | str) else [*unfold]
    found = opened(system, title, constants, unfold=unfold)
    offered = (*found.values, "angle", "seed")
    without = frozenset() if sliders is None else frozenset(offered) - chosen_names(sliders, "slider", offered)
    chosen = opened(system, title, constants, without, unfold) if without else found
    return Explorer(chosen, step, angle, seed, without, unfold, None if show is None else chosen_names(show, "view", VIEWS))


def check_unfolded(system: AnySystem, unfold: Unfolding, constants: dict[str, Any]) -> None:
    """The stage diagram of a system can be unfolded as somebody asks for.

    Raises
    ------
    LSystemError
        It cannot, or there is no such symbol.
    """
    if unfold is False:
        return
    if not isinstance(system, LSystem):
        raise ModelValueError("Only the stages of an L-system can be unfolded", hint="Those of maps are their walls.")
    stages(system, unfold=unfold, **constants)


def chosen_names(names: str | Collection[str], what: str, offered: Collection[str]) -> frozenset[str]:
    """The sliders or views that somebody asks for, by their names."""
    asked = (names,) if isinstance(names, str) else names
    require(asked, Collection, f"A name or a list of names of {what}s")
    for name in asked:
        require(name, str, f"The name of a {what}")
        if name not in offered:
            raise ModelNameError(
                f"There is no {what} {shown(name)}", hint=suggestion(name, offered) or f"The {what}s are: {', '.join(offered)}."
            )
    return frozenset(asked)
