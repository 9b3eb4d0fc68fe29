"""An L-system in the panel, and on a page without a kernel, which holds the books of the settings for which it has room."""

from __future__ import annotations

import base64
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache
from typing import NamedTuple

from lsys_kit.budget import current, processor_time
from lsys_kit.classroom.link import ANGLE, LETTERS, SEED, STEP, link
from lsys_kit.classroom.panel import held
from lsys_kit.classroom.panel.books.book import book, first_step
from lsys_kit.classroom.panel.books.net import Unfolding
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.panel.controls import slider, slider_ranges, slider_values
from lsys_kit.classroom.panel.labels import translated_labels
from lsys_kit.classroom.panel.opened.opened import Viewing
from lsys_kit.classroom.panel.page import deflated, shared
from lsys_kit.classroom.panel.view_model import STILL, StepView, ViewModel, composite_png
from lsys_kit.classroom.variants import variants
from lsys_kit.derivation.core.rules import constants_of, number_from
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.geometry.drawing import turning_angle
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.geometry.turtle.space import spans_in_space, turtle_after
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem, cells_notation, read, read_any
from lsys_kit.notation.write import write
from lsys_kit.pictures.rendering.view import FROM_THE_RIGHT, FRONT, is_flat
from lsys_kit.pictures.style.labels import place_text

MOST_BOOKS, MOST_CHARACTERS = 2_000, 400_000
"""A page holds no more books, and no more than about so many characters of them, deflated; nor more than can be made in the
time of one task."""
MOST_FOR_FEWEST = 1_100_000
"""It may have so many characters if the sliders could not move otherwise."""


class Made(NamedTuple):
    """A book with the settings of which it is, the seed among them, its letters, the step that it should hold, and the seconds
    it took."""

    settings: Mapping[str, Value]
    letters: tuple[str, ...]
    least: int
    book: Data
    seconds: float


class OpenedSystem:
    """An L-system that the panel shows, with the sliders of its constants."""

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
        self.given: Mapping[str, Value] = {
            **{name: number_from(value, name) for name, value in (changes or {}).items() if name not in ranges},
            **self.fixed,
        }
        self.last: Made | None = None
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
            derivation = self._views(self.system.seed or 0).known({**self.given, **self.first})[0].to(self.steps)
            turtle = turtle_after(derivation[self.steps], float(self.system.angle))
        except LSystemError:
            return FROM_THE_RIGHT
        return FRONT if is_flat(spans_in_space(turtle)) else FROM_THE_RIGHT

    @property
    def angle(self) -> float:
        return min(180.0, max(0.0, round(float(self.system.angle), 1)))

    def turned(self, angle: object) -> float:
        turn = turning_angle(angle, self.system)
        if not 0 <= turn <= 180:
            raise ModelValueError(f"angle = {number_text(turn)} lies outside its slider's range", hint="It goes from 0 to 180.")
        return turn

    @property
    def lettered(self) -> Sequence[str]:
        return () if traits_of(self.system).sensitive else (*self.declared,)

    def book(self, values: Mapping[str, Value], seed: int, least: int, letters: Collection[str] = ()) -> Data:
        settings, began = {**self.given, **values}, processor_time()
        made = book(self.system, settings, seed, title=self.title, least=least, unfold=self._unfold, letters=letters)
        self.last = Made({**settings, held.SEED: seed}, tuple(letters), least, made, processor_time() - began)
        return made

    def sight(self, chosen: Viewing) -> StepView:
        constants, view = {**self.given, **chosen.values}, self._views(chosen.seed)
        net = view.known(constants)[1]
        names = [place_text(place, net.system) for place in net.places]
        place = names.index(chosen.mark) if chosen.mark in names else -1
        return view.sight(chosen.step, constants, chosen.angle, place, chosen.around, chosen.above, chosen.letters)

    def still(self, chosen: Viewing, show: Collection[str] = STILL) -> Mapping[str, str]:
        return {"image/png": base64.b64encode(composite_png(self.sight(chosen), show)).decode()}

    def page_data(self, chosen: Viewing, asked: Sequence[Mapping[str, object]] = ()) -> Data:
        start: dict[str, Value] = {**self.given, **chosen.values}
        start.update({name: start.pop(name) for name in self.declared if name in self.values or name in self.fixed})
        start[held.SEED] = chosen.seed
        shelf = _Shelf(self, start, chosen.step, chosen.letters)
        first = shelf.first()
        seeds, thrown = first["chance"] and "seed" not in self._without, "choices" in first
        sown = chosen.seed if seeds and not thrown else None
        kept = _held(shelf, self.values, sown, asked)
        fixed = {
            name: value
            for name, value in start.items()
            if name not in kept.values and (name != held.SEED or (first["chance"] and not (seeds and thrown)))
        }
        model = {
            "constants": [slider(name, kept.values[name], start[name]) for name in self.values if name in kept.values],
            "chance": seeds and (thrown or held.SEED in kept.values),
            **({"thrown": True} if thrown else {}),
            "seeds": [*map(number_text, kept.values.get(held.SEED, ()))],
            "together": kept.together,
            "fixed": held.held_text(fixed, kept, self.values),
            "without": sorted(self._without),
            "unfold": self._unfold,
            **({"letters": [*chosen.letters], "lettered": [*chosen.letters], "joint": True} if chosen.letters else {}),
            "step": min(chosen.step, first["steps"]),
            "angle": round(chosen.angle, 1),
            "around": chosen.around,
            "above": chosen.above,
            "seed": chosen.seed,
            **translated_labels(),
        }
        system = self.system
        return {
            "model": model,
            "mode": first["mode"],
            "system": {"notation": system.notation, "text": write(system), "angle": round(float(system.angle), 1)},
            "fixed": {name: number_text(value) for name, value in fixed.items() if name != held.SEED},
            "books": deflated(shared([shelf.book(each) for each in held.settings(kept)])),
        }

    def link(self, chosen: Viewing) -> str:
        turn = {} if chosen.angle == round(float(self.system.angle), 1) else {ANGLE: chosen.angle}
        seed = {SEED: chosen.seed} if chosen.seed else {}
        letters = {LETTERS: chosen.letters} if chosen.letters else {}
        return link(self.system, {STEP: chosen.step, **turn, **seed, **letters, **self.given, **chosen.values})

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


def _held(
    shelf: _Shelf, values: Mapping[str, Sequence[Value]], seed: int | None, asked: Sequence[Mapping[str, object]]
) -> held.Held:
    """The settings for which a page has room: what a book takes is seen from those with the fewest values of each slider."""
    rows = [*_asked_settings(values, seed, asked)]
    choices = {
        name: held.constant_choice(each, shelf.start[name], {row[name] for row in rows if name in row})
        for name, each in values.items()
    }
    if seed is not None:
        choices[held.SEED] = held.seed_choice(seed, {int(row[held.SEED]) for row in rows if held.SEED in row})
    few = held.fewest(choices, shelf.room([{}], MOST_FOR_FEWEST))
    most = shelf.room([*held.settings(few)], MOST_CHARACTERS)
    away = [[name for name in row if name in few.values and row[name] != choices[name].first] for row in rows]
    together = [*dict.fromkeys(name for names in away if len(names) > 1 for name in names)]
    return held.planned({name: choices[name] for name in few.values}, together, most)


def _asked_settings(
    values: Mapping[str, Sequence[Value]], seed: int | None, asked: Sequence[Mapping[str, object]]
) -> Iterator[dict[str, Value]]:
    """What is asked for of the sliders of a system: whatever lies between their ends, and whole seeds."""
    for row in asked:
        given = {name: number_from(value, name) for name, value in row.items()}
        found = {
            name: value for name, value in given.items() if name in values and values[name][0] <= value <= values[name][-1]
        }
        if seed is not None and "seed" not in values and isinstance(given.get("seed"), int):
            found[held.SEED] = given["seed"]
        if found:
            yield found


class _Shelf:
    """The books of a system for a page, each made once, and how many of them it has room for."""

    def __init__(self, system: OpenedSystem, start: Mapping[str, Value], least: int, letters: tuple[str, ...]) -> None:
        self.start, self._system, self._least, self._made = start, system, least, dict[tuple[Value, ...], Made]()
        self._letters, last = letters, system.last
        if last and last.settings == start and last.letters == letters and least <= max(last.least, last.book["steps"]):
            self._made[tuple(start.values())] = last

    def first(self) -> Data:
        """The book of the first settings, or the error that there is none."""
        return self._kept(self.start)

    def book(self, chosen: Mapping[str, Value]) -> Data:
        """The book of some settings, or why there is none."""
        try:
            return self._kept({**self.start, **chosen})
        except LSystemError as error:
            return {"mistake": {"message": error.message, "hint": error.hint or ""}}

    def room(self, sample: Sequence[Mapping[str, Value]], characters: int) -> float:
        """How many books a page has room for that are like those of some settings."""
        size, many = len(deflated(shared([self.book(each) for each in sample]))), len(sample)
        seconds = sum(made.seconds for made in self._made.values()) / max(1, len(self._made))
        return min(MOST_BOOKS, many * characters / size, current().seconds / max(seconds, 1e-3))

    def _kept(self, chosen: Mapping[str, Value]) -> Data:
        key = tuple(chosen.values())
        if key not in self._made:
            constants = {name: value for name, value in chosen.items() if name != held.SEED}
            self._system.book(constants, int(chosen[held.SEED]), self._least, self._letters)
            assert self._system.last
            self._made[key] = self._system.last
        return self._made[key].book
