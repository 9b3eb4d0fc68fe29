"""Links: a model with its settings as an address, to be sent, or shown as a QR code; and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

from lsys_kit.derivation.core.letters import letters_from
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.derivation.derive import Choices
from lsys_kit.errors import ModelNameError, ModelSyntaxError, ModelValueError, require, shown
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.fragments import LinkContent, is_link, packed, unpacked
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, number_text
from lsys_kit.notation.model.cells import CellSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import CELL_READERS, AnySystem, read
from lsys_kit.notation.write import write
from lsys_kit.pictures.tissues.chosen import RANGES

STEP, ANGLE, SEED, LETTERS = "step", "angle", "seed", "letters"
"""The settings that are no constants."""
Setting: TypeAlias = Value | tuple[str, ...]
"""A number, or the names of letters."""
_WHOLE = {STEP: "a whole number from 0 on", SEED: "a whole number"}


@dataclass(frozen=True)
class Linked:
    """What a link leads to.

    Attributes
    ----------
    system
        The L-system, map system or cellwork system.
    settings
        Exact values by name: perhaps `step`, `angle` and `seed`, and constants of the system; and perhaps `letters`, the names
        of constants that are letters. They are what `explore` takes.
    """

    system: AnySystem
    settings: Mapping[str, Setting]

    def __repr__(self) -> str:
        return "\n".join((repr(self.system), *(f"{name} = {_text(value)}" for name, value in self.settings.items())))

    def _repr_mimebundle_(self, **options: object) -> dict[str, object]:
        from lsys_kit import explore  # imported late: panels make links

        settings: Choices = self.settings
        return explore(self.system, **settings)._repr_mimebundle_(**options)


def link(system: AnySystem, settings: Mapping[str, object] | None = None, base: str = "", *, step: int | None = None) -> str:
    """An address with a model in it, which `read` reads; nothing of it is kept anywhere else.

    Parameters
    ----------
    system
        An L-system, a map system or a cellwork system.
    settings
        What is to be seen of it: `step`, `angle`, `seed`, and values of declared constants, or of the forces of a map or a
        cellwork; `letters`, the names of constants that are letters.
    base
        The address of a page that shows models; without one, the link can be read by the kit alone.
    step
        The step that is to be seen, as in `settings`; by default the number of steps that the system sets.

    Raises
    ------
    ModelNameError
        The system has no constant of that name.
    ModelValueError
        A value is no number, or the system cannot be written.
    ModelLimitError
        The link would be too long.

    Examples
    --------
    >>> from lsys_kit import system
    >>> there = link(system("T2"), {"step": 4}, "https://example.org/panel.html")
    >>> there.partition("=")[0], len(there) < 150, read(there) == system("T2"), dict(linked(there).settings)
    ('https://example.org/panel.html#lsys', True, True, {'step': 4})
    """
    require(system, (LSystem, CellSystem), "A system")
    require(base, str, "The address of a page")
    require(settings, (Mapping, type(None)), "A mapping of settings")
    wanted = {**(settings or {}), **({} if step is None else {STEP: step})}
    given = {name: _text(value) for name, value in _values(system, wanted).items()}
    _values(system, given)  # which raises an error if a number is too long to be read again
    notation, text = system.notation, write(system) if isinstance(system, LSystem) else _cells_text(system)
    address = base.partition("#")[0] + packed(LinkContent(notation, given, text))
    if not base.isprintable() or not is_link(address):
        raise ModelValueError(
            "The address of a page has no blanks in it, and all of it is visible", hint='A blank is written "%20" there.'
        )
    return address


def linked(link: str) -> Linked:
    """The system and the settings of a link.

    Raises
    ------
    ModelSyntaxError
        The text is no link, or a broken one.
    LSystemError
        Its model cannot be read, or its settings are not those of the model.

    Examples
    --------
    >>> linked("https://example.org/")
    Traceback (most recent call last):
    lsys_kit.errors.ModelSyntaxError: This text is no link: it has no model behind "#lsys=" (line 1, column 1). \
Links are made by link(system).
      https://example.org/
      ^^^^^^^^^^^^^^^^^^^^
    """
    require(link, str, "The text of a link")
    if not is_link(link):
        raise ModelSyntaxError(
            'This text is no link: it has no model behind "#lsys="', link, 0, len(link), "Links are made by link(system)."
        )
    content = unpacked(link)
    system = CELL_READERS.get(content.notation, read)(link)
    return Linked(system, MappingProxyType(_values(system, content.settings)))


def settings_given(step: object, angle: object, seed: object) -> dict[str, object]:
    """The settings that somebody has given, which are not left to a link.

    >>> settings_given(3, None, 0)
    {'step': 3}
    """
    usual = isinstance(seed, int) and seed == 0
    return {name: value for name, value in ((STEP, step), (ANGLE, angle), (SEED, None if usual else seed)) if value is not None}


def _values(system: AnySystem, settings: Mapping[str, object]) -> dict[str, Setting]:
    """The exact values of settings, if the system has them."""
    constants = [constant.name for constant in system.constants] if isinstance(system, LSystem) else [*RANGES]
    for name in settings:
        if name not in (STEP, ANGLE, SEED, *([LETTERS] if isinstance(system, LSystem) else []), *constants):
            listed = f"Its constants are: {', '.join(constants)}." if constants else "It has none."
            raise ModelNameError(f'The system declares no constant "{name}"', hint=suggestion(name, constants) or listed)
    return {
        name: letters_from(system, [*filter(None, given.split(","))] if isinstance(given, str) else given)  # type: ignore[arg-type]
        if name == LETTERS and isinstance(system, LSystem)
        else _value(name, given)
        for name, given in settings.items()
    }


def _text(value: Setting) -> str:
    return ",".join(value) if isinstance(value, tuple) else number_text(value)


def _value(name: str, given: object) -> Value:
    value = number_from(given, name)
    if is_symbolic(value):
        raise ModelValueError(f'"{name}" must be a number that is known, not {shown(given)}')
    if name in _WHOLE and not (isinstance(value, int) and (name == SEED or value >= 0)):
        raise ModelValueError(f'"{name}" must be {_WHOLE[name]}, not {shown(given)}')
    return value


def _cells_text(system: CellSystem) -> str:
    """The text of a map system or a cellwork system, if it reads back."""
    text = str(system)
    if CELL_READERS[system.notation](text) != system:
        raise ModelValueError(f"This {system.notation} system cannot be written so that it reads back")
    return text
