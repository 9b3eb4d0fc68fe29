"""The explorer: a system's rules, word, stage diagram and drawing side by side, with sliders made from the model.

The kernel sends a book of the system for a setting of its constants, and the browser turns its pages: neither a step, an
angle, a point of view, a mark nor a trace asks the kernel (see `book`). What the browser shows, the kernel knows as soon as the
sliders have come to rest, so that other widgets can be linked to the panel.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from lsys_kit.budget import Task, current, limits
from lsys_kit.classroom.catalogue import entry
from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.classroom.link import ANGLE, SEED, STEP, link, linked
from lsys_kit.classroom.panel.book import MOST_MODULES, book
from lsys_kit.classroom.panel.bundle import bundled, style
from lsys_kit.classroom.panel.composite import composite_png
from lsys_kit.classroom.panel.controls import SliderRange, slider_ranges, slider_values
from lsys_kit.classroom.panel.page import page, page_data, save_page
from lsys_kit.classroom.panel.view_model import StepView, ViewModel
from lsys_kit.classroom.variants import variants
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.errors import LSystemError, ModelValueError, shown, whole_number
from lsys_kit.notation.fragments import is_link
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.pictures.style.labels import place_text

USUAL_STEPS = 5
"""The step that is shown first of a system that names none."""
_ID = re.compile(r"[\w-]+")


def explore(what: LSystem | str, step: int | None = None, *, angle: object = None, seed: int = 0,
            **constants: object) -> Explorer:
    """Show a system with its sliders: rules, word, stage diagram and drawing of one step, side by side.

    Parameters
    ----------
    what
        A system, the id or name of one in the catalogue, the text of a model, or a link.
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
    ModelSyntaxError
        The text makes no sense.

    Examples
    --------
    >>> panel = explore("J4", 3)
    >>> panel.step = 9
    >>> print(panel.text)
    Step 9: 9 modules. Al(1)Br(1)Bl(2)Ar(2)Al(3)Bl(1)Ar(1)Bl(2)Ar(2). Stages A(1): 2, A(2): 2, A(3): 1, B(1): 2, B(2): 2. \
9 cells, width 14, height 1.
    """
    title = ""
    if isinstance(what, str) and _ID.fullmatch(what.strip()):
        title = entry(what.strip()).id
        what = catalogued(title)
    if isinstance(what, str) and is_link(what):
        there = linked(what)
        given: dict[str, Any] = {**there.settings, **_given(step, angle, seed), **constants}
        return explore(there.system, **given)  # type: ignore[arg-type]
    system = read(what) if isinstance(what, str) else what
    if not isinstance(system, LSystem):
        raise ModelValueError(f"Only a system, its id or name, or its text can be explored, not {type(what).__name__}")
    return Explorer(system, title, step, angle, seed, constants)


def _given(step: int | None, angle: object, seed: int) -> dict[str, Any]:
    """The settings that are not left to the link."""
    return {name: value for name, value, usual in ((STEP, step, None), (ANGLE, angle, None), (SEED, seed, 0)) if value != usual}


@dataclass(frozen=True)
class _Opened:
    """A system that the panel shows, with the sliders of its constants."""

    system: LSystem
    title: str
    ranges: Mapping[str, SliderRange]
    values: Mapping[str, tuple[Value, ...]]
    fixed: Mapping[str, object]


class Explorer(anywidget.AnyWidget):  # type: ignore[misc]
    """The panel that `explore` shows. What it shows can be read, set, observed and linked to other widgets.

    Attributes
    ----------
    step, angle, seed
        The step, the angle of the turtle's turns in degrees, and the seed of the random numbers.
    around, above
        The side from which a plant in space is seen, in degrees: 0 around is the front, 90 the right; 0 above is the side, 90
        the top.
    mark
        The label of the stage that is marked, as "A(2)"; empty for none.
    settings
        The values of the constants, as texts; each is also an attribute of its own name, a number.
    """

    _esm = bundled("widget")
    _css = style()
    model = traitlets.Dict().tag(sync=True)
    step = traitlets.Int().tag(sync=True)
    angle = traitlets.Float().tag(sync=True)
    around = traitlets.Int().tag(sync=True)
    above = traitlets.Int().tag(sync=True)
    mark = traitlets.Unicode().tag(sync=True)
    seed = traitlets.Int().tag(sync=True)
    settings = traitlets.Dict().tag(sync=True)

    def __init__(self, system: LSystem, title: str, step: int | None, angle: object, seed: int,
                 changes: Mapping[str, object]) -> None:
        first = _first_step(system) if step is None else whole_number(step, "The step")
        turn = real_from(angle, "angle") if angle is not None else float(system.angle)
        if not 0 <= turn <= 180:
            raise ModelValueError(f"angle = {number_text(turn)} lies outside its slider's range", hint="It goes from 0 to 180.")
        if isinstance(seed, bool) or not isinstance(seed, int):
            raise ModelValueError(f"The seed must be a whole number, not {shown(seed)}")
        self._ready = False
        self._opened = _opened(system, title, changes)
        self._view_model = ViewModel(system, seed)
        settings = {name: number_text(span.value) for name, span in self._opened.ranges.items()}
        super().__init__(step=first, angle=round(turn, 1), seed=seed, settings=settings)
        with self._limited(), Task("The step was not shown"):
            self.model = self._model_of(self._opened, first)
        if step is None:
            self.step = self.model["step"]
        self._check_step(self.step)
        self._offer_constants()
        self._ready = True
        self.on_msg(self._answer)

    # -- what Python sees -----------------------------------------------------------------------------------------------

    @property
    def system(self) -> LSystem:
        """The system that is shown: the one that was given, or the one that was typed."""
        return self._opened.system

    @property
    def sight(self) -> StepView:
        """What the panel shows: word, net, tokens, picture."""
        with self._limited(), Task("The step was not shown"):
            constants = self._constants(self.settings)
            net = self._view_model.known(constants)[1]
            names = [place_text(place, net.system) for place in net.places]
            place = names.index(self.mark) if self.mark in names else -1
            return self._view_model.sight(self.step, constants, self.angle, place, self.around, self.above)

    @property
    def text(self) -> str:
        """What the panel shows, in words."""
        return str(self.sight)

    @property
    def link(self) -> str:
        """An address with the model and its settings in it, which `explore` and `read` understand."""
        turn = {} if self.angle == round(float(self.system.angle), 1) else {ANGLE: self.angle}
        seed = {SEED: self.seed} if self.seed else {}
        return link(self.system, {STEP: self.step, **turn, **seed, **self._constants(self.settings)})

    def save(self, path: str | Path) -> None:
        """Write the panel as it stands to an .html file, a page that works without a kernel and without a network.

        Its sliders move constants as far as the books of all their values have room in the page.

        Raises
        ------
        ModelFileError
            The name ends in something else, or the file cannot be written.
        """
        save_page(path, self._page())

    def _page(self) -> str:
        with self._limited():  # each book is a task of its own
            data = page_data(self.system, self._constants(self.settings), self.seed, title=self._opened.title, step=self.step,
                             angle=self.angle, around=self.around, above=self.above)
            return page(self._opened.title or "An L-system", data, self.text)

    @traitlets.validate("step")
    def _possible_step(self, proposal: Any) -> int:
        step: int = proposal["value"]
        self._check_step(step)
        return step

    def _check_step(self, step: int) -> None:
        last, end = (self.model["book"][entry] for entry in ("steps", "end")) if self.model else (step, "")
        if not 0 <= step <= last:
            raise ModelValueError(f"The panel shows steps 0 to {last}, not {step}", hint=end or None)

    @traitlets.validate("settings")
    def _possible_settings(self, proposal: Any) -> dict[str, str]:
        given = {**self.settings, **proposal["value"]} if self._ready else proposal["value"]
        return {name: number_text(_nearest(self._opened.values[name], name, text)) for name, text in given.items()
                if name in self._opened.values}

    # -- what happens ---------------------------------------------------------------------------------------------------

    def _model_of(self, opened: _Opened, first: int) -> dict[str, Any]:
        """What the browser needs of a system: its sliders and its first book."""
        constants = {name: span.value for name, span in opened.ranges.items()}
        sliders = [{"name": name, "texts": [*map(number_text, opened.values[name])], "hint": f"the constant {name}",
                    "index": opened.values[name].index(opened.ranges[name].value)} for name in opened.ranges]
        made = book(opened.system, {**opened.fixed, **constants}, self.seed, title=opened.title, least=first)
        return {"book": made, "constants": sliders, "chance": made["chance"], "step": min(first, made["steps"]),
                "angle": self.angle, "around": self.around, "above": self.above, "seed": self.seed}

    def _offer_constants(self) -> None:
        """Each constant with a slider is an attribute that can be set and linked."""
        for name, span in self._opened.ranges.items():
            if not hasattr(self, name):
                whole = all(isinstance(part, int) for part in self._opened.values[name])
                kind: Any = traitlets.Int if whole else traitlets.Float
                self.add_traits(**{name: kind(_plain(span.value))})
                self.observe(self._set_constant, name)
        self.observe(self._tell_constants, "settings")

    def _set_constant(self, change: Any) -> None:
        self.settings = {**self.settings, change["name"]: change["new"]}

    def _tell_constants(self, _: object) -> None:
        for name, text in self.settings.items():
            if self.has_trait(name) and name not in type(self).class_trait_names(sync=True):
                setattr(self, name, _plain(_nearest(self._opened.values[name], name, text)))

    def _constants(self, settings: Mapping[str, object]) -> dict[str, Any]:
        opened = self._opened
        return {**opened.fixed, **{name: _nearest(values, name, settings.get(name, opened.ranges[name].value))
                                   for name, values in opened.values.items()}}

    def _limited(self) -> AbstractContextManager[object]:
        return limits(modules=min(MOST_MODULES, current().modules))

    def _answer(self, _: object, content: Mapping[str, Any], buffers: object) -> None:
        """Answer what the browser asks, by its number; a mistake is an answer too."""
        kinds = {"book": self._book_for, "rules": self._model_for, "variants": self._variants, "keep": self._kept}
        reply: dict[str, Any]
        try:
            with self._limited(), Task("It was not finished"):
                reply = kinds[content["kind"]](content)
        except LSystemError as error:
            reply = {"mistake": mistake(error)}
        self.send({"number": content["number"], **reply})

    def _book_for(self, content: Mapping[str, Any]) -> dict[str, Any]:
        opened = self._opened
        return {"book": book(opened.system, self._constants(content["constants"]), int(content["seed"]), title=opened.title,
                             least=self.model["step"])}

    def _model_for(self, content: Mapping[str, Any]) -> dict[str, Any]:
        """The model of a text that was typed."""
        system = _read_typed(content["text"], self.system.notation)
        opened = _opened(system, "" if system != self.system else self._opened.title, {})
        found = {**self._model_of(opened, _first_step(system)), "angle": _shown_angle(system)}
        self._opened, self._view_model = opened, ViewModel(system, self.seed)
        return {"model": found}

    def _variants(self, _: Mapping[str, Any]) -> dict[str, Any]:
        """Nine variants of the system, each with its book."""
        return {"variants": [{"text": str(each), "book": book(each, {}, self.seed)} for each in variants(self.system, 9)]}

    def _kept(self, content: Mapping[str, Any]) -> dict[str, Any]:
        """What is taken along: the drawing as SVG, or a link to the panel as it stands, or the panel as a page."""
        if content["what"] == "link":
            return {"text": self.link}
        if content["what"] == "page":
            return {"name": f"{self._opened.title or 'panel'}.html", "type": "text/html", "text": self._page()}
        return {"name": f"{self._opened.title or 'drawing'}.svg", "type": "image/svg+xml", "text": self.sight.picture.svg}

    # -- what is kept ---------------------------------------------------------------------------------------------------

    def _repr_mimebundle_(self, **options: object) -> dict[str, Any]:
        """The live panel, and for a page without a kernel its picture and its words."""
        bundle = super()._repr_mimebundle_(**options)
        data: dict[str, Any] = dict(bundle[0] if isinstance(bundle, tuple) else bundle or {})
        sight = self.sight
        data["text/plain"] = f"{sight} Run this cell to play."
        data["image/png"] = base64.b64encode(composite_png(sight)).decode()
        return data

    def close(self) -> None:
        """Close the panel, and what the browser keeps of it."""
        self.layout.close()
        super().close()

    def __repr__(self) -> str:
        return self.text


def mistake(error: LSystemError) -> dict[str, Any]:
    """An error as the browser needs it: what is wrong, what to try, and between which offsets of the text it stands."""
    start = end = None
    if error.source is not None and error.line and error.column and error.end:
        line = sum(len(text) + 1 for text in error.source.split("\n")[:error.line - 1])
        start, end = line + error.column - 1, line + error.end - 1
    return {"message": error.message, "hint": error.hint or "", "start": start, "end": end, "line": error.line,
            "column": error.column}


def _shown_angle(system: LSystem) -> float:
    """The angle of a system as its slider has it."""
    return min(180.0, max(0.0, round(float(system.angle), 1)))


def _first_step(system: LSystem) -> int:
    return USUAL_STEPS if system.steps is None else system.steps


def _opened(system: LSystem, title: str, changes: Mapping[str, object]) -> _Opened:
    ranges = slider_ranges(system, changes)
    fixed = {name: value for name, value in changes.items() if name not in ranges}
    return _Opened(system, title, ranges, {name: slider_values(span) for name, span in ranges.items()}, fixed)


def _read_typed(text: str, notation: str) -> LSystem:
    """A text that was typed, in the notation of the system before it, or in the one that it shows."""
    try:
        return read(text, notation)
    except LSystemError as error:
        try:
            return read(text)
        except LSystemError:
            raise error from None


def _nearest(values: tuple[Value, ...], name: str, wanted: object) -> Value:
    """The value of a slider that is nearest to a number, or to the text of one."""
    number = real_from(wanted, name)
    return min(values, key=lambda value: abs(float(value) - number))


def _plain(value: Value) -> int | float:
    return value if isinstance(value, int) else float(value)
