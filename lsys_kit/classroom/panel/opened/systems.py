"""An L-system in the panel."""

from __future__ import annotations

import base64
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property, lru_cache
from typing import Any

from lsys_kit.budget import processor_time
from lsys_kit.classroom.link import ANGLE, SEED, STEP, link
from lsys_kit.classroom.panel.books.book import book, first_step
from lsys_kit.classroom.panel.books.net import Unfolding
from lsys_kit.classroom.panel.composite import composite_png
from lsys_kit.classroom.panel.controls import slider_ranges, slider_values
from lsys_kit.classroom.panel.opened.opened import Viewing
from lsys_kit.classroom.panel.page import Made, page_data
from lsys_kit.classroom.panel.view_model import StepView, ViewModel
from lsys_kit.classroom.variants import variants
from lsys_kit.derivation.core.rules import constants_of
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.geometry.drawing import turning_angle
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem, cells_notation, read, read_any
from lsys_kit.pictures.rendering.view import FROM_THE_RIGHT, FRONT, lies_flat
from lsys_kit.pictures.style.labels import place_text


class OpenedSystem:
    """An L-system that the panel shows, with the sliders of its constants.

    Raises
    ------
    LSystemError
        A constant is unknown, or its value lies outside of its slider's range.
    """

    hint, kind = "", "L-system"

    def __init__(
        self,
        system: LSystem,
        title: str = "",
        changes: Mapping[str, object] | None = None,
        without: Collection[str] = (),
        unfold: Unfolding = False,
    ) -> None:
        self.system, self.title, self._without, self._unfold = system, title, without, unfold
        ranges = slider_ranges(system, changes or {})
        moving = {name: span for name, span in ranges.items() if name not in without}
        self.first: Mapping[str, Value] = {name: span.value for name, span in moving.items()}
        self.values: Mapping[str, Sequence[Value]] = {name: slider_values(span) for name, span in moving.items()}
        self.fixed: Mapping[str, Value] = {name: span.value for name, span in ranges.items() if name in without}
        self.declared: Mapping[str, Value] = dict(
            zip((each.name for each in system.constants), constants_of(system, {}), strict=True)
        )
        self.given: Mapping[str, Any] = {
            **{name: value for name, value in (changes or {}).items() if name not in ranges},
            **self.fixed,
        }
        self._made: Made | None = None
        self._views = lru_cache(maxsize=4)(lambda seed: ViewModel(system, seed, unfold))

    @property
    def steps(self) -> int:
        return first_step(self.system)

    @cached_property
    def side(self) -> tuple[int, int]:
        """The front, where the first step that is shown lies in the plane of the picture."""
        if drawing_mode(self.system) is not DrawingMode.SPACE:
            return FRONT
        try:
            scene = self._views(self.system.seed or 0).sight(self.steps, {**self.given, **self.first}).scene
        except LSystemError:
            return FROM_THE_RIGHT
        return FRONT if lies_flat(scene) else FROM_THE_RIGHT

    @property
    def angle(self) -> float:
        return min(180.0, max(0.0, round(float(self.system.angle), 1)))

    def turned(self, angle: object) -> float:
        turn = turning_angle(angle, self.system)
        if not 0 <= turn <= 180:
            raise ModelValueError(f"angle = {number_text(turn)} lies outside its slider's range", hint="It goes from 0 to 180.")
        return turn

    def book(self, values: Mapping[str, Value], seed: int, least: int) -> dict[str, Any]:
        settings, began = {**self.given, **values}, processor_time()
        made = book(self.system, settings, seed, title=self.title, least=least, unfold=self._unfold)
        self._made = Made(settings, seed, least, made, processor_time() - began)
        return made

    def sight(self, chosen: Viewing) -> StepView:
        constants, view = {**self.given, **chosen.values}, self._views(chosen.seed)
        net = view.known(constants)[1]
        names = [place_text(place, net.system) for place in net.places]
        place = names.index(chosen.mark) if chosen.mark in names else -1
        return view.sight(chosen.step, constants, chosen.angle, place, chosen.around, chosen.above)

    def still(self, chosen: Viewing) -> Mapping[str, str]:
        return {"image/png": base64.b64encode(composite_png(self.sight(chosen))).decode()}

    def page_data(self, chosen: Viewing, asked: Sequence[Mapping[str, object]] = ()) -> dict[str, Any]:
        return page_data(
            self.system,
            {**self.given, **chosen.values},
            chosen.seed,
            title=self.title,
            step=chosen.step,
            angle=chosen.angle,
            around=chosen.around,
            above=chosen.above,
            asked=asked,
            without=self._without,
            unfold=self._unfold,
            made=self._made,
        )

    def link(self, chosen: Viewing) -> str:
        turn = {} if chosen.angle == round(float(self.system.angle), 1) else {ANGLE: chosen.angle}
        seed = {SEED: chosen.seed} if chosen.seed else {}
        return link(self.system, {STEP: chosen.step, **turn, **seed, **self.given, **chosen.values})

    def read(self, text: str) -> AnySystem:
        """The text in the notation of the system before it, or in the one that it shows."""
        if cells_notation(text):
            return read_any(text)
        try:
            return read(text, self.system.notation)
        except LSystemError as error:
            try:
                return read(text)
            except LSystemError:
                raise error from None

    def variants(self, many: int) -> Sequence[LSystem]:
        return variants(self.system, many)
