"""The explorer: a system's word, stage diagram and drawing side by side, with sliders made from the model.

Nothing is computed twice: words, scenes and the texts of panels are kept for every step and every setting of the constants.
In the plane the angle, in space the side from which a plant is seen never need the kernel: the browser turns the
drawing by itself.
"""

from __future__ import annotations

import asyncio
import base64
from contextlib import AbstractContextManager
from html import escape
from typing import Any

import ipywidgets as widgets

from lsys_kit.budget import Task, current, limits
from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.classroom.panel.canvas import HOW_TO_TURN, packed, widget_classes
from lsys_kit.classroom.panel.controls import Control, SliderRange, control, slider_ranges
from lsys_kit.classroom.panel.view_model import StepView, ViewModel
from lsys_kit.classroom.panel.word_view import word_html
from lsys_kit.derivation.core.rules import number_from, real_from
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.errors import LSystemError, ModelValueError, whole_number
from lsys_kit.geometry.turtle.mode import DrawingMode
from lsys_kit.geometry.turtle.surfaces import passed_over
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.style.labels import escaped, place_text
from lsys_kit.pictures.style.palette import INK, QUIET, VERMILION

MOST_MODULES = 100_000
"""The panel refuses larger words: nobody could see more, and a slider must respond at once."""
SECONDS_A_STEP = 0.6
"""How long the play button shows each step."""


def explore(what: LSystem | str, step: int | None = None, *, angle: object = None, seed: int = 0,
            **constants: object) -> Explorer:
    """Show a system with its sliders: word, stage diagram and drawing of one step, side by side.

    Parameters
    ----------
    what
        A system, or the id or name of one in the catalogue.
    step
        The step shown first; by default the system's own.
    angle
        Degrees by which the turtle turns at first.
    seed
        The seed of the random numbers.
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
        raise ModelValueError(f"Only a system, or the id or name of one, can be explored, not {type(what).__name__}")
    return Explorer(ViewModel(system, seed), step, angle, constants)


class Explorer(widgets.VBox):  # type: ignore[misc]
    """The panel that `explore` shows.

    Attributes
    ----------
    step, angle
        The sliders of the step and, for a turtle, of the angle.
    around, above
        For a plant in space the sliders of the side from which it is seen, in degrees: 0 around is the front, 90 the right;
        0 above is the side, 90 the top.
    constants
        For each constant its control.
    sight
        What it shows: word, net, tokens, picture.
    """

    def __init__(self, view_model: ViewModel, step: int | None, angle: object, changes: dict[str, object]) -> None:
        self.system, self._view_model = view_model.system, view_model
        system = view_model.system
        self._fixed = {name: value for name, value in changes.items() if name not in slider_ranges(system, changes)}
        self.constants = {name: control(name, span) for name, span in slider_ranges(system, changes).items()}
        self._make_controls(step, angle)
        self._make_views()
        self._playing: asyncio.Task[None] | None = None
        self._start = self._readings()
        super().__init__([self._top(), self._message, self._panels(), self._bottom()],
                         layout=widgets.Layout(width="100%", padding="6px"))
        self.add_class("lsys-explorer")
        with self._limited(), Task("The step was not shown"):
            self._show_step(self.step.value)
        self._listen()

    # -- what there is ------------------------------------------------------------------------------------------------

    def _make_controls(self, step: int | None, angle: object) -> None:
        asked = self.system.steps if self.system.steps is not None else 5
        first = asked if step is None else whole_number(step, "The step")
        most = max(2 * asked, 10, first)
        self._step = control("step", SliderRange(first, 0, most, 1))
        self.step = self._step.slider
        turn = real_from(angle, "angle") if angle is not None else float(self.system.angle)
        if not 0 <= turn <= 180:
            raise ModelValueError(f"angle = {number_text(turn)} lies outside its slider's range", hint="It goes from 0 to 180.")
        self._angle = control("angle", SliderRange(number_from(turn), 0, 180, number_from("0.1")))
        self.angle = self._angle.slider
        self._around, self._above = control("around", SliderRange(0, -180, 180, 1)), \
            control("above", SliderRange(0, -90, 90, 1))
        self.around, self.above = self._around.slider, self._above.slider
        self._play = widgets.Button(description="play", tooltip="show one step after another", layout=_button())
        self._reset = widgets.Button(description="reset", tooltip="back to the first settings", layout=_button())
        self._mark = widgets.Dropdown(options=[("no stage", -1)], value=-1, description="mark",
                                      style={"description_width": "initial"}, layout=widgets.Layout(width="170px"))

    def _make_views(self) -> None:
        self._word, self._message, self._status = widgets.HTML(), widgets.HTML(), widgets.HTML()
        kinds = widget_classes()
        self._diagram = kinds.diagram() if kinds else widgets.HTML()
        self._drawing, self._by_itself = widgets.HTML(), dict[str, Control]()
        if kinds and self._view_model.mode is DrawingMode.SPACE:
            self._drawing, self._by_itself = kinds.space(), {"around": self._around, "above": self._above}
        elif kinds and self._view_model.mode is DrawingMode.PLANE:
            self._drawing = kinds.flat(heading=float(self.system.heading), angle=self.angle.value)
            self._by_itself = {"angle": self._angle}

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
        return widgets.HBox([*(each.row() for each in self._controls()[1:]), self._mark], layout=_wrapping())

    # -- what happens -------------------------------------------------------------------------------------------------

    def _listen(self) -> None:
        for each in self._controls():
            if each not in self._by_itself.values():
                each.slider.observe(self._show, "value")
                each.linked(in_browser=False)
        for trait, each in self._by_itself.items():
            widgets.jslink((each.slider, "value"), (self._drawing, trait))
            each.linked(in_browser=True)
        self._mark.observe(self._show, "value")
        if widget_classes():
            widgets.link((self._diagram, "chosen"), (self._mark, "value"))
        self._play.on_click(self._toggle_play)
        self._reset.on_click(self._back)

    def _controls(self) -> list[Control]:
        turtle = [] if self._view_model.mode is DrawingMode.FILAMENT else [self._angle]
        viewer = [self._around, self._above] if self._view_model.mode is DrawingMode.SPACE else []
        return [self._step, *turtle, *viewer, *self.constants.values()]

    def _readings(self) -> list[float]:
        return [each.slider.value for each in self._controls()]

    def _back(self, _: object = None) -> None:
        self._stop()
        self._mark.value = -1
        for each, reading in zip(self._controls(), self._start, strict=True):
            each.slider.value = reading
        if self._view_model.mode is DrawingMode.SPACE and self._by_itself:
            self._drawing.returns += 1  # the browser may have turned the drawing without telling the kernel

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
        """Show the step that the sliders ask for; where it cannot be shown, say why and keep the pictures."""
        try:
            with self._limited(), Task("The step was not shown"):
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
        self._offer_stages(self._view_model.known(constants)[1])
        sight = self._sight(step, constants)
        self._show_drawing(sight)
        self._word.value = word_html(sight.word, sight.marked)
        diagram = drawn_stages(sight.net, sight.tokens, marked=self._mark.value if self._mark.value >= 0 else None)
        if widget_classes():
            self._diagram.svg = diagram
        else:
            self._diagram.value = diagram
        states = sum(count > 0 for count in sight.tokens)
        said = f"step {step}: <b>{sight.modules}</b>, {states} state{'s' * (states != 1)}; {sight.scene}"
        if sight.scene.unknown:
            said += f"; {escaped(passed_over(sight.scene.unknown))}"
        self._status.value = f'<span role="status" style="font:14px sans-serif;color:{INK}">{said}</span>'
        self.sight, self._chosen = sight, constants

    def _sight(self, step: int, constants: dict[str, Any]) -> StepView:
        return self._view_model.sight(step, constants, self.angle.value, self._mark.value, self.around.value, self.above.value)

    def _offer_stages(self, net: Stages) -> None:
        """The stages that can be chosen are the net's, which change with the constants."""
        options = [("no stage", -1), *((place_text(place, net.system), number) for number, place in enumerate(net.places))]
        if [*self._mark.options] != options:
            chosen = self._mark.value if self._mark.value < len(net.places) else -1
            with self._mark.hold_trait_notifications():
                self._mark.options = options
                self._mark.value = chosen

    def _show_drawing(self, sight: StepView) -> None:
        """Send shapes to a canvas, once; or a picture to a page that has none."""
        if not self._by_itself:
            self._drawing.value = sight.picture.svg
            return
        in_space = self._view_model.mode is DrawingMode.SPACE
        there = f"{sight.scene}. {HOW_TO_TURN}" if in_space else f"{len(sight.scene.segments):,} segments"
        with self._drawing.hold_sync():
            self._drawing.description = f"Drawing of step {sight.step}: {there}"
            for trait, value in packed(sight.scene, sight.path, sight.picture.colour_of, sight.marked).items():
                setattr(self._drawing, trait, value)

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
        data["image/png"] = base64.b64encode(self._sight(self.sight.step, self._chosen).picture.png).decode()
        return data

    def __repr__(self) -> str:
        return self.text


def _wrapping(align: str = "flex-start") -> widgets.Layout:
    return widgets.Layout(flex_flow="row wrap", align_items=align, width="100%")


def _button() -> widgets.Layout:
    return widgets.Layout(width="70px")
