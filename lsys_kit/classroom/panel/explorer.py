"""The explorer: a system's rules, word, stage diagram and drawing side by side, with sliders made from the model; or two
of them with one step slider.

The kernel sends a book of the system for a setting of its constants, and the browser turns its pages: neither a step, an
angle, a point of view, a mark nor a trace asks the kernel (see `book`). What the browser shows, the kernel knows as soon as the
sliders have come to rest, so that other widgets can be linked to the panel."""

from __future__ import annotations

import base64
import re
from collections.abc import Collection, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import traitlets

from lsys_kit.budget import Task, current, limits
from lsys_kit.classroom.catalogue import catalogued, entry
from lsys_kit.classroom.link import ANGLE, LETTERS, SEED, STEP, linked, settings_given
from lsys_kit.classroom.panel.books.book import MOST_MODULES
from lsys_kit.classroom.panel.books.net import Unfolding
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.panel.controls import nearest, plain_number, slider
from lsys_kit.classroom.panel.held import fixed_text
from lsys_kit.classroom.panel.labels import translated_labels
from lsys_kit.classroom.panel.opened.kinds import opened
from lsys_kit.classroom.panel.opened.opened import Opened, Sight, Viewing
from lsys_kit.classroom.panel.page import page, save_page
from lsys_kit.classroom.panel.sentence import check_sentence, sentence_parts, sentence_text
from lsys_kit.classroom.panel.standing import standing
from lsys_kit.classroom.panel.view_model import STILL, StepView, both_png
from lsys_kit.classroom.panel.widget_scripts import ScriptedWidget
from lsys_kit.classroom.widget import widget_serialization
from lsys_kit.derivation.core.letters import letters_from
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError, every, quotable, require, shown, whole_number
from lsys_kit.files import Entries
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.fragments import is_link
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.cells import CellSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import AnySystem, read_any

_BROKEN_OFF = LSystemError("The kernel was interrupted before this was finished", hint="Try it again.")

_MOVED = {"sync": True, "echo_update": False}
"""What a hand moves: an echo of where it was would take it back from where it is by now."""
VIEWS = ("rules", "word", "stages", "drawing", "walk", "unfolding", "sample", "counts", "seeds", "variants")
"""The views of a panel, from left to right."""


class Explorer(ScriptedWidget):
    """The panel that `explore` shows. What it shows can be read, set, observed and linked to other widgets.

    Attributes
    ----------
    step, angle, seed
        The step, the angle of the turtle's turns in degrees, and the seed of the random numbers.
    around, above
        The side from which a plant or cells in space are seen, in degrees: 0 around is the front, 90 the right; 0 above is the
        side, 90 the top.
    mark
        The label of the stage that is marked, as "A(2)"; empty for none.
    letters
        The constants that are letters: formulas stand in place of the numbers that are made of them.
    settings
        The values of the constants, or of the forces of a map, that have a slider, as texts; each is also an attribute of its
        own name, a number.
    """

    _script_name = "widget"
    model = traitlets.Dict().tag(sync=True)
    step = traitlets.Int().tag(**_MOVED)
    angle = traitlets.Float().tag(**_MOVED)
    around = traitlets.Int().tag(**_MOVED)
    above = traitlets.Int().tag(**_MOVED)
    mark = traitlets.Unicode().tag(**_MOVED)
    seed = traitlets.Int().tag(**_MOVED)
    settings = traitlets.Dict().tag(**_MOVED)
    letters = traitlets.List(traitlets.Unicode()).tag(**_MOVED)

    def __init__(
        self,
        opened: Opened,
        step: int | None,
        angle: object,
        seed: int,
        without: Collection[str] = (),
        unfold: Unfolding = False,
        show: Collection[str] | None = None,
        letters: Collection[str] = (),
        sentence: str = "",
    ) -> None:
        check_sentence(sentence, opened)
        first = opened.steps if step is None else whole_number(step, "The step")
        turn = opened.turned(angle)
        if isinstance(seed, bool) or not isinstance(seed, int):
            raise ModelValueError(f"The seed must be a whole number, not {shown(seed)}")
        self._ready, self._opened, self._given, self._without, self._unfold = False, opened, opened, frozenset(without), unfold
        self._show = None if show is None else [view for view in VIEWS if view in show]
        self._asked, self._sentence = None if step is None else first, sentence
        self._standing = standing()
        super().__init__(
            step=first,
            angle=round(turn, 1),
            seed=seed,
            settings=_texts(opened.first),
            letters=[*letters],
            around=opened.side[0],
            above=opened.side[1],
        )
        try:
            self._begin(first, step is None)
        except BaseException:
            self.close()
            raise

    def _begin(self, first: int, may_be_less: bool) -> None:
        """Show a step, or one before it where that may be, and from now on answer."""
        with self._limited(), Task("The step was not shown"):
            self.model = self._model_of(self._opened, first, self._opened.first)
        if may_be_less:
            self.step = self.model["step"]
        self._check_step(self.step)
        self._offer_constants()
        self.observe(self._tell_constants, "settings")
        self._ready = True
        self.on_msg(self._answer)

    # -- what Python sees -----------------------------------------------------------------------------------------------

    @property
    def system(self) -> AnySystem:
        """The system that is shown: the one that was given, or the one that was typed."""
        system: AnySystem = self._opened.system
        return system

    @property
    def sight(self) -> Sight:
        """What the panel shows: word, net, tokens, picture."""
        with self._limited(), Task("The step was not shown"):
            return self._opened.sight(self._chosen)

    @property
    def _chosen(self) -> Viewing:
        values, letters = self._values(self.settings), tuple(self.letters)
        return Viewing(self.step, values, self.seed, self.angle, self.around, self.above, self.mark, letters)

    @property
    def text(self) -> str:
        """What the panel shows, in words."""
        return self._told(STILL)

    def _told(self, usual: Collection[str]) -> str:
        """What it shows in words, with some views where none were asked for."""
        sight = self.sight
        said = sight.told(usual if self._show is None else self._show)
        if not self._sentence:
            return said
        counts = sight.word.counts() if isinstance(sight, StepView) else {}
        return f"{sentence_text(self._sentence, self._opened, self._chosen, counts)} {said}"

    @property
    def still(self) -> Mapping[str, str]:
        """What the panel shows as a picture, by the type of the data, in base 64 or as text."""
        with self._limited(), Task("The picture was not made"):
            return self._opened.still(self._chosen, STILL if self._show is None else self._show)

    def _still_png(self, usual: Collection[str]) -> bytes:
        """That picture, with some views where none were asked for, in pixels."""
        with self._limited(), Task("The picture was not made"):
            found = self._opened.still(self._chosen, usual if self._show is None else self._show)
            return base64.b64decode(found["image/png"]) if "image/png" in found else self.sight.picture.png

    @property
    def link(self) -> str:
        """An address with the model and its settings in it, which `explore` and `read` understand."""
        return self._opened.link(self._chosen)

    def save(self, path: str | Path) -> None:
        """Write the panel as it stands to an .html file, a page that works without a kernel and without a network.

        Its sliders of constants and of the seed move as far as the page has room for the books of their values, and it says how
        far; under other forces the cells of a map come to rest in the browser.

        Raises
        ------
        ModelFileError
            The name ends in something else, or the file cannot be written.
        """
        save_page(path, self._page())

    def page_data(self, asked: Sequence[Mapping[str, object]] = ()) -> Data:
        """What a page without a kernel has to know of the panel as it stands, and of the settings that are asked for."""
        every(asked, Mapping, "A dictionary of values of sliders")
        with self._limited():  # each book is a task of its own
            data = self._opened.page_data(self._chosen, asked)
        return {**data, "model": {**data["model"], "show": self._show, **self._sentence_parts(self._opened)}}

    def _sentence_parts(self, what: Opened) -> Data:
        return {"sentence": sentence_parts(self._sentence, what, self._chosen)} if self._sentence else {}

    def _page(self) -> str:
        return page(self._opened.title or self._opened.kind, self.page_data(), self.text)

    @traitlets.validate("step")
    def _possible_step(self, proposal: traitlets.Bunch) -> int:
        step: int = proposal["value"]
        self._check_step(step)
        return step

    def _check_step(self, step: int) -> None:
        last, end = (self.model["book"][entry] for entry in ("steps", "end")) if self.model else (step, "")
        if not 0 <= step <= last:
            raise ModelValueError(f"The panel shows steps 0 to {last}, not {shown(step)}", hint=end or None)

    @traitlets.validate("letters")
    def _possible_letters(self, proposal: traitlets.Bunch) -> list[str]:
        offered = self._opened.lettered
        return [name for name in offered if name in chosen_names(proposal["value"], "letter", offered)]

    @traitlets.validate("settings")
    def _possible_settings(self, proposal: traitlets.Bunch) -> dict[str, str]:
        given = {**self.settings, **proposal["value"]} if self._ready else proposal["value"]
        return {
            name: number_text(nearest(self._opened.values[name], name, text))
            for name, text in given.items()
            if name in self._opened.values
        }

    # -- what happens ---------------------------------------------------------------------------------------------------

    def _model_of(self, what: Opened, first: int, values: Mapping[str, Value]) -> Data:
        """What the browser needs of a system: its sliders, and its book for some values of them."""
        sliders = [slider(name, what.values[name], value, what.hint) for name, value in what.first.items()]
        letters = [name for name in self.letters if name in what.lettered]
        made = what.book(values, self.seed, first, letters)
        return {
            "book": made,
            "asked": {"constants": _texts(values), "seed": self.seed, "letters": letters},
            "letters": letters,
            "lettered": [name for name in what.first if name in what.lettered],
            "constants": sliders,
            "chance": made["chance"] and "seed" not in self._without,
            "fixed": "".join(fixed_text(what.fixed)),
            "without": sorted(self._without),
            "unfold": self._unfold,
            "show": self._show,
            "first": self.model["first"] if self.model else made["text"],
            "standing": self._standing,
            "step": min(first, made["steps"]),
            "angle": self.angle,
            "around": self.around,
            "above": self.above,
            "seed": self.seed,
            **self._sentence_parts(what),
            **translated_labels(),
        }

    def _offer_constants(self) -> None:
        offered = {name: self._trait_of(name, value) for name, value in self._opened.first.items() if not hasattr(self, name)}
        if offered:
            self.add_traits(**offered)  # all at once: this makes a class anew
            self.observe(self._set_constant, [*offered])

    def _trait_of(self, name: str, value: Value) -> object:
        whole = all(isinstance(part, int) for part in self._opened.values[name])
        kind: Any = traitlets.Int if whole else traitlets.Float
        return kind(plain_number(value))

    def _set_constant(self, change: traitlets.Bunch) -> None:
        self.settings = {**self.settings, change["name"]: change["new"]}

    def _tell_constants(self, _: object) -> None:
        for name, text in self.settings.items():
            if name in self._opened.values and self.has_trait(name) and name not in type(self).class_trait_names(sync=True):
                setattr(self, name, plain_number(nearest(self._opened.values[name], name, text)))

    def _values(self, settings: Mapping[str, object]) -> dict[str, Value]:
        return {
            name: nearest(values, name, settings.get(name, self._opened.first[name]))
            for name, values in self._opened.values.items()
        }

    def _limited(self) -> AbstractContextManager[object]:
        return limits(modules=min(MOST_MODULES, current().modules))

    def _answer(self, _: object, content: Mapping[str, object], buffers: object) -> None:
        """Answer what the browser asks, by its number."""
        reply: Data = {"mistake": _mistake(_BROKEN_OFF)}
        try:
            reply = self.answer(content)
        finally:  # the browser waits for an answer, also where the kernel is interrupted
            self.send({"number": content["number"], **reply})

    def answer(self, content: Mapping[str, object]) -> Data:
        """What is answered to a question of the panel's script; a mistake is an answer too."""
        kinds = {"book": self._book_for, "rules": self._model_for, "variants": self._variants, "keep": self._kept}
        require(content, Mapping, "A question of the panel")
        kind = kinds.get(str(content.get("kind")))
        if kind is None:
            raise ModelValueError("This question cannot be understood")
        try:
            with self._limited(), Task("It was not finished"):
                return kind(content)
        except LSystemError as error:
            return {"mistake": _mistake(error)}

    def _book_for(self, content: Entries) -> Data:
        offered = self._opened.lettered
        letters = chosen_names(content.get("letters") or (), "letter", offered)
        made = self._opened.book(
            self._values(content["constants"]), int(content["seed"]), self.model["step"], sorted(letters, key=offered.index)
        )
        return {"book": made}

    def _model_for(self, content: Entries) -> Data:
        """Show the system of a text that was typed.

        The step and the angle stay where they can, and so does each constant that is declared as it was, or was not declared.
        """
        old = self._opened
        system = old.read(content["text"])
        title = self._given.title if system == self._given.system else ""
        new = opened(system, title, without=self._without, unfold=self._unfold)
        alike = {name for name, value in new.declared.items() if value == old.declared.get(name, value)}
        given = {name: value for name, value in old.given.items() if name in alike}
        if given:
            new = opened(system, title, given, self._without, self._unfold)
        standing = {name: text for name, text in content.get("constants", {}).items() if name in alike}
        values = {name: nearest(new.values[name], name, standing.get(name, value)) for name, value in new.first.items()}
        first = new.steps if self._asked is None else self._asked
        found = {**self._model_of(new, first, values), "angle": new.angle}
        with self.hold_sync():
            self._opened, self.model = new, found
            self.settings, self.letters = _texts(values), found["letters"]
            self.step = min(self.step, found["book"]["steps"])
            if new.angle != old.angle:
                self.angle = new.angle
        self._offer_constants()
        return {"opened": True}

    def _variants(self, _: Mapping[str, object]) -> Data:
        return {
            "variants": [
                {"text": str(variant), "book": opened(variant).book({}, self.seed, 0)} for variant in self._opened.variants(9)
            ]
        }

    def _kept(self, content: Mapping[str, object]) -> Data:
        """What is taken along: the drawing as SVG, or a link to the panel as it stands, or the panel as a page."""
        if content["what"] == "link":
            return {"text": self.link}
        if content["what"] == "page":
            return {"name": f"{self.model['book']['file']}.html", "type": "text/html", "text": self._page()}
        return {"name": f"{self.model['book']['file']}.svg", "type": "image/svg+xml", "text": self.sight.svg}

    # -- what is kept ---------------------------------------------------------------------------------------------------

    def _stored(self) -> Data:
        return {"text/plain": f"{self.text} Run this cell to play.", **self.still}

    def __repr__(self) -> str:
        return self.text


def _texts(values: Mapping[str, Value]) -> dict[str, str]:
    return {name: number_text(value) for name, value in values.items()}


def _mistake(error: LSystemError) -> Data:
    """An error as the browser needs it: what is wrong, what to try, and between which offsets of the text it stands."""
    start, end = error.span or (None, None)
    return {"message": error.message, "hint": error.hint or "", "line": error.line, "start": start, "end": end}


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
    letters: str | Collection[str] = (),
    sentence: str = "",
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
        The views that are open at first, one or a list of `rules`, `word`, `stages`, `drawing`, `walk`, `unfolding`, `sample`,
        `counts`, `seeds` and `variants`; by default the word, the stages and the drawing. The rules are a click away, and the
        others stand with the tools behind a button. In the walk the turtle obeys the word command by command; in the unfolding
        every module becomes its successor in place; in the sample the plants of many seeds are counted one by one. A page has
        these three where they are open.
    letters
        Constants, one or a list, that are letters at first: in place of the numbers that are made of them stand formulas, and
        the drawing goes on with the numbers. Each constant with a slider has a switch for that.
    sentence
        What stands above the views, with numbers in it: `{{step}}`, `{{angle}}` and `{{lifeTimeA}}`, a constant, are dragged,
        typed or set by keys where they stand; `{{F}}`, a symbol, is counted, as are all `{{modules}}`, which may be called
        `{{letters}}`, `{{characters}}` or `{{cells}}`.
    **constants
        First values of declared constants; of a map or cellwork system those of its forces: `stiffness`, `rest`, `pressure`,
        `damping`.

    Raises
    ------
    ModelValueError
        A first value lies outside its slider's range.
    ModelNameError
        There is no slider, view or constant of that name, no symbol that is to be unfolded, or no number for a sentence.
    ModelSyntaxError
        The text makes no sense.

    Examples
    --------
    >>> panel = explore("J4", 3)
    >>> panel.step = 9
    >>> print(panel.text)
    Step 9: 9 cells. Al(1)Br(1)Bl(2)Ar(2)Al(3)Bl(1)Ar(1)Bl(2)Ar(2). Stages A(1): 2, A(2): 2, A(3): 1, B(1): 2, B(2): 2. \
Width 14, height 1.
    >>> explore("P6", 4, dt=1, sliders="dt").settings
    {'dt': '1'}
    >>> explore("K5", 2, sentence="After {{step}} steps there are {{F}} strokes.").text[:36]
    'After 2 steps there are 25 strokes. '
    """
    if "field" in constants:
        raise ModelValueError(
            "The explorer takes no field of Python: its pages and links hold the text of the model alone",
            hint='Name a field in the text, as in "field: light", or draw or animate with field=...',
        )
    system, title, settings = _system_from(what)
    if settings:
        given: Data = {**settings, **settings_given(step, angle, seed), **constants}
        step, angle, seed, constants = given.pop(STEP, None), given.pop(ANGLE, None), given.pop(SEED, 0), given
        there = given.pop(LETTERS, ())
        letters = letters or there
    check_unfolded(system, unfold, constants)
    unfold = unfold if isinstance(unfold, bool | str) else [*unfold]
    found = opened(system, title, constants, unfold=unfold)
    offered = (*found.values, "angle", "seed")
    without = frozenset() if sliders is None else frozenset(offered) - chosen_names(sliders, "slider", offered)
    chosen = opened(system, title, constants, without, unfold) if without else found
    named = letters_from(system, letters) if isinstance(system, LSystem) else chosen_names(letters, "letter", ())
    views = None if show is None else chosen_names(show, "view", VIEWS)
    return Explorer(chosen, step, angle, seed, without, unfold, views, named, sentence)


def _system_from(what: AnySystem | str) -> tuple[AnySystem, str, Mapping[str, object]]:
    """A system that somebody gives, or names, or writes; its title, if it has one, and the settings of a link."""
    if isinstance(what, str) and _ID.fullmatch(what.strip()):
        title = entry(what.strip()).id
        return catalogued(title), title, {}
    if isinstance(what, str) and is_link(what):
        there = linked(what)
        return there.system, "", there.settings
    system = read_any(what) if isinstance(what, str) else what
    if not isinstance(system, AnySystem):
        raise ModelValueError(f"Only a system, its id or name, or its text can be explored, not {type(what).__name__}")
    return system, "", {}


def check_unfolded(system: AnySystem, unfold: Unfolding, constants: Data) -> None:
    """The stage diagram of a system can be unfolded as somebody asks for."""
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
                f"There is no {what} {shown(name)}",
                hint=suggestion(name, offered) or (f"The {what}s are: {', '.join(offered)}." if offered else None),
            )
    return frozenset(asked)


_COMMON = {"what": "The system", "step": "The step", "sliders": "The choice of sliders", "show": "The choice of views"}
"""What a side cannot have of its own, though `explore` takes it."""


def compare(
    what: AnySystem | str,
    *others: AnySystem | str | Mapping[str, object],
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
        case (LSystem() | CellSystem() | str() as other,):
            sides = (what, {}), (other, {})
        case _:
            given: Sequence[object] = others
            number = next((each for each in given if type(each) is int), None)
            usual = 'For example compare("P2", "P3"), or compare("J4", {}, {"lifeTimeA": 2}).'
            raise ModelValueError(
                "Two systems are compared, or one system under two settings",
                hint=usual if number is None else f"Name the step: step={shown(number)}.",
            )
    left = explore(sides[0][0], step, sliders=sliders, show=show, **_named(sides[0][1]))
    right = explore(sides[1][0], left.step, sliders=sliders, show=show, **_named(sides[1][1]))
    return Comparison(left, right, chosen_names(shared, "slider", [name for name in left.settings if name in right.settings]))


def _named(settings: Mapping[str, object]) -> Data:
    for name in settings:
        if not isinstance(name, str):
            raise ModelValueError(f"Constants have names, not {name!r}", hint='A setting is for example {"lifeTimeA": 2}.')
        if name in _COMMON:
            raise ModelValueError(
                f"{_COMMON[name]} is no setting of one side",
                hint='It stands beside the two, as in compare("J4", {}, {"lifeTimeA": 2}, step=9).',
            )
    return dict(settings)


COMPARED = ("word", "drawing")
"""The views that are open on both sides at first."""


class Comparison(ScriptedWidget):
    """The two panels that `compare` shows.

    Attributes
    ----------
    left, right
        The panels, as `explore` makes them; their steps are the same.
    shared
        The names of the constants that are the same on both sides.
    """

    _script_name = "comparison"
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
        return "\n".join(each._told(COMPARED) for each in (self.left, self.right))

    def page_data(self, asked: Sequence[Mapping[str, object]] = ()) -> Data:
        """What a page without a kernel has to know of both panels, and of the settings that are asked for."""
        return {"left": self.left.page_data(asked), "right": self.right.page_data(asked), "shared": self.shared}

    def _stored(self) -> Data:
        picture = both_png(*(each._still_png(COMPARED) for each in (self.left, self.right)))
        return {"text/plain": self.text, "image/png": base64.b64encode(picture).decode()}

    def close(self) -> None:
        """Close both panels, and what the browser keeps of them."""
        for each in (self.left, self.right):
            each.close()
        super().close()

    def __repr__(self) -> str:
        return self.text
