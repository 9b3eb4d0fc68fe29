"""The explorer: a system's word, stage diagram and drawing side by side, with sliders made from the model.

Nothing is computed twice: words, scenes and the texts of panels are kept for every step and every setting of the constants.
The angle never comes back to the kernel: the browser turns the drawing by itself.
"""

from __future__ import annotations

import asyncio
import base64
from collections.abc import Collection
from contextlib import AbstractContextManager
from html import escape
from typing import Any

import ipywidgets as widgets
import numpy as np

from lsys_kit.budget import current, limits
from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.classroom.controls import Control, Span, control, spans
from lsys_kit.classroom.study import Study
from lsys_kit.classroom.views import packed, widget_classes, word_html
from lsys_kit.derivation.rules import number_from
from lsys_kit.derivation.stages import Stages
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.geometry.turtle import Path
from lsys_kit.notation.arithmetic import number_text
from lsys_kit.notation.model import LSystem
from lsys_kit.pictures.draw import Picture
from lsys_kit.pictures.labels import place_text
from lsys_kit.pictures.nets import drawn_stages
from lsys_kit.pictures.palette import INK, QUIET, VERMILION

MOST_MODULES = 100_000
"""Words larger than this are refused by the panel: nobody sees more, and a slider must answer at once."""
SECONDS_A_STEP = 0.6
"""How long the play button shows each step."""


def explore(what: LSystem | str, step: int | None = None, *, angle: object = None, seed: int = 0,
            **constants: object) -> Explorer:
    """Show a system with its sliders: word, stage diagram and drawing of one step, side by side.

    Parameters
    ----------
    what
        A system, or the id of one in the catalogue.
    step
        The step that is shown first; by default the one that the system asks for.
    angle
        Degrees by which `+` and `-` turn at first.
    seed
        Where chance begins.
    **constants
        First values of declared constants.

    Raises
    ------
    ModelValueError
        A first value lies outside its slider's range.

    Examples
    --------
    >>> panel = explore("J4", 3)
    >>> panel.step.value = 9
    >>> print(panel.text)
    Step 9: 9 modules. Al(1)Br(1)Bl(2)Ar(2)Al(3)Bl(1)Ar(1)Bl(2)Ar(2). Stages A(1): 2, A(2): 2, A(3): 1, B(1): 2, B(2): 2. \
9 cells, width 14, height 1.
    """
    system = catalogued(what) if isinstance(what, str) else what
    if not isinstance(system, LSystem):
        raise ModelValueError(f"Only a system, or the id of one, can be explored, not {type(what).__name__}")
    return Explorer(Study(system, seed), step, angle, constants)


class Explorer(widgets.VBox):  # type: ignore[misc]
    """The panel that `explore` shows.

    Attributes
    ----------
    step, angle
        The sliders of the step and, for a turtle, of the angle.
    constants
        For each constant its control.
    sight
        What it shows: word, net, tokens, picture.
    """

    def __init__(self, study: Study, step: int | None, angle: object, changes: dict[str, object]) -> None:
        self.system, self._study = study.system, study
        system = study.system
        self._fixed = {name: value for name, value in changes.items() if name not in spans(system, changes)}
        self.constants = {name: control(name, span) for name, span in spans(system, changes).items()}
        self._make_controls(step, angle)
        self._make_views()
        self._playing: asyncio.Task[None] | None = None
        self._start = self._readings()
        super().__init__([self._top(), self._message, self._panels(), self._bottom()],
                         layout=widgets.Layout(width="100%", padding="6px"))
        self.add_class("lsys-explorer")
        with self._limited():
            self._show_step(self.step.value)
        self._listen()

    # -- what there is ------------------------------------------------------------------------------------------------

    def _make_controls(self, step: int | None, angle: object) -> None:
        asked = self.system.steps if self.system.steps is not None else 5
        first = asked if step is None else step
        most = max(2 * asked, 10, first)
        if isinstance(first, bool) or not isinstance(first, int) or first < 0:
            raise ModelValueError(f"The step must be a whole number from 0 on, not {step!r}")
        self._step = control("step", Span(first, 0, most, 1))
        self.step = self._step.slider
        turn = float(number_from(angle, "angle") if angle is not None else self.system.angle)
        if not 0 <= turn <= 180:
            raise ModelValueError(f"angle = {number_text(turn)} lies outside its slider's range", hint="It goes from 0 to 180.")
        self._angle = control("angle", Span(number_from(turn), 0, 180, number_from("0.1")))
        self.angle = self._angle.slider
        self._play = widgets.Button(description="play", tooltip="show one step after another", layout=_button())
        self._reset = widgets.Button(description="reset", tooltip="back to the first settings", layout=_button())
        self._mark = widgets.Dropdown(options=[("no stage", -1)], value=-1, description="mark",
                                      style={"description_width": "initial"}, layout=widgets.Layout(width="170px"))

    def _make_views(self) -> None:
        self.turns_itself = widget_classes() is not None and not self._study.is_filament
        self._word, self._message, self._status = widgets.HTML(), widgets.HTML(), widgets.HTML()
        kinds = widget_classes()
        self._diagram = kinds[1]() if kinds else widgets.HTML()
        self._drawing = kinds[0](heading=float(self.system.heading), angle=self.angle.value) \
            if kinds and self.turns_itself else widgets.HTML()

    def _top(self) -> widgets.Widget:
        return widgets.HBox([self._step.row(), self._play, self._reset, self._status], layout=_wrapping("center"))

    def _panels(self) -> widgets.Widget:
        panels = [self._panel("word", self._word, 3), self._panel("stages", self._diagram, 4),
                  self._panel("drawing", self._drawing, 5)]
        return widgets.HBox(panels, layout=_wrapping())

    def _panel(self, name: str, view: widgets.Widget, share: int) -> widgets.Widget:
        heading = widgets.HTML(f'<div style="color:{QUIET};font:12px sans-serif;letter-spacing:.06em">{name}</div>')
        view.layout.width = "100%"
        return widgets.VBox([heading, view], layout=widgets.Layout(flex=f"{share} 1 240px", min_width="0", margin="4px 8px"))

    def _bottom(self) -> widgets.Widget:
        rows = [each.row() for each in self.constants.values()]
        if not self._study.is_filament:
            rows.insert(0, self._angle.row())
        return widgets.HBox([*rows, self._mark], layout=_wrapping())

    # -- what happens -------------------------------------------------------------------------------------------------

    def _listen(self) -> None:
        for each in (self._step, *self.constants.values()):
            each.slider.observe(self._show, "value")
            each.linked(in_browser=False)
        self._mark.observe(self._show, "value")
        self._angle.linked(in_browser=True)
        if self.turns_itself:
            widgets.jslink((self.angle, "value"), (self._drawing, "angle"))
        else:
            self.angle.observe(self._show, "value")
        if widget_classes():
            widgets.link((self._diagram, "chosen"), (self._mark, "value"))
        self._play.on_click(self._toggle_play)
        self._reset.on_click(self._back)

    def _controls(self) -> list[Control]:
        return [self._step, self._angle, *self.constants.values()]

    def _readings(self) -> list[float]:
        return [each.slider.value for each in self._controls()]

    def _back(self, _: object = None) -> None:
        self._stop()
        self._mark.value = -1
        for each, reading in zip(self._controls(), self._start, strict=True):
            each.slider.value = reading

    def _toggle_play(self, _: object = None) -> None:
        if self._playing:
            self._stop()
            return
        if self.step.value == self.step.max:
            self.step.value = 0
        self._play.description = "pause"
        self._playing = asyncio.get_running_loop().create_task(self._run())

    def _stop(self) -> None:
        if self._playing:
            self._playing.cancel()
        self._playing, self._play.description = None, "play"

    async def _run(self) -> None:
        while self.step.value < self.step.max:
            await asyncio.sleep(SECONDS_A_STEP)
            self.step.value += 1
            if self._message.value:
                break
        self._playing, self._play.description = None, "play"

    def _show(self, _: object = None) -> None:
        """Show the step that the sliders ask for; where it cannot be had, say why and keep the pictures."""
        try:
            with self._limited():
                self._show_step(self.step.value)
            self._message.value = ""
        except LSystemError as error:
            said = escape(f"{error.message}. {error.hint or ''}")
            self._message.value = (f'<div role="alert" style="color:{INK};border-left:5px solid {VERMILION};'
                                   f'padding:4px 10px;font:14px sans-serif">&#9888; {said}</div>')

    def _limited(self) -> AbstractContextManager[object]:
        return limits(modules=min(MOST_MODULES, current().modules))

    def _show_step(self, step: int) -> None:
        constants = {**self._fixed, **{name: each.value for name, each in self.constants.items()}}
        self._offer_stages(self._study.known(constants)[1])
        sight = self._study.sight(step, constants, self.angle.value, self._mark.value)
        if sight.path is not None and self.turns_itself:
            self._send_path(sight.path, sight.picture, sight.marked)
        else:
            self._drawing.value = sight.picture.svg
        self._word.value = word_html(sight.word, sight.marked)
        diagram = drawn_stages(sight.net, sight.tokens, marked=self._mark.value if self._mark.value >= 0 else None)
        if widget_classes():
            self._diagram.svg = diagram
        else:
            self._diagram.value = diagram
        states = sum(count > 0 for count in sight.tokens)
        said = f"step {step}: <b>{sight.modules}</b>, {states} state{'s' * (states != 1)}; {sight.picture.scene}"
        self._status.value = f'<span role="status" style="font:14px sans-serif;color:{INK}">{said}</span>'
        self.sight = sight

    def _offer_stages(self, net: Stages) -> None:
        """The stages that can be chosen are the net's, which change with the constants."""
        options = [("no stage", -1), *((place_text(place, net.system), number) for number, place in enumerate(net.places))]
        if [*self._mark.options] != options:
            chosen = self._mark.value if self._mark.value < len(net.places) else -1
            with self._mark.hold_trait_notifications():
                self._mark.options = options
                self._mark.value = chosen

    def _send_path(self, path: Path, picture: Picture, marked: Collection[int]) -> None:
        """Send a path to the browser, once."""
        data, used = packed(path, picture.colour_of, marked)
        with self._drawing.hold_sync():
            self._drawing.colours = used
            self._drawing.typical = float(np.median(path.lengths)) if len(path) else 1.0
            self._drawing.description = f"Drawing of step {picture.rows[-1].step}: {len(picture.scene.segments):,} segments"
            self._drawing.path = data

    # -- what is kept -------------------------------------------------------------------------------------------------

    @property
    def text(self) -> str:
        """What the panel shows, in words."""
        return str(self.sight)

    def _repr_mimebundle_(self, **options: object) -> dict[str, Any]:
        """The live panel, and for a page without a kernel its picture and its words."""
        bundle = super()._repr_mimebundle_(**options)
        data: dict[str, Any] = dict(bundle[0] if isinstance(bundle, tuple) else bundle or {})
        data["text/plain"] = self.text
        data["image/png"] = base64.b64encode(self.sight.picture.png).decode()
        return data

    def __repr__(self) -> str:
        return self.text


def _wrapping(align: str = "flex-start") -> widgets.Layout:
    return widgets.Layout(flex_flow="row wrap", align_items=align, width="100%")


def _button() -> widgets.Layout:
    return widgets.Layout(width="70px")
