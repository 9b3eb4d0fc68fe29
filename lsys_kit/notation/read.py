"""Text to records: a system, a word or an expression, read in one of the notations.

A text is cut into statements, each is parsed by the grammar of its notation, and the records are checked. The grammars are
in `dialects`, one for each notation; they share `expressions.lark` in `syntax`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path, PurePath
from typing import TypeAlias

from lsys_kit.budget import current
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelValueError, quotable, require
from lsys_kit.notation.analysis.checks import check_expression, check_word, value_of
from lsys_kit.notation.dialects.abop.dialect import ABOP
from lsys_kit.notation.dialects.cellwork.dialect import CELLWORK, read_cellwork
from lsys_kit.notation.dialects.cpfg.dialect import CPFG
from lsys_kit.notation.dialects.cpfg.view_files import commands, read_object
from lsys_kit.notation.dialects.fractint.dialect import FRACTINT
from lsys_kit.notation.dialects.map.dialect import MAP, read_map
from lsys_kit.notation.folders import Folder, opened_folder
from lsys_kit.notation.foreign import foreign_format, unreadable_format
from lsys_kit.notation.formats.l_py import is_l_py
from lsys_kit.notation.formats.reading import FORMATS, read_as, read_found, what_is_missing
from lsys_kit.notation.fragments import is_link, unpacked
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.cells import CellworkSystem, MapSystem
from lsys_kit.notation.model.expressions import Expression
from lsys_kit.notation.model.modules import Module, flat
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.registry import DIALECTS, dialect_named, recognise
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.parser import parse
from lsys_kit.notation.syntax.segmentation import check_digits, segment_word
from lsys_kit.notation.syntax.systems import system_in
from lsys_kit.notation.syntax.text.statements import ARROW, check_text
from lsys_kit.notation.syntax.text.typography import TAG, keyboard_signs
from lsys_kit.notation.syntax.wording import reporting

AnySystem: TypeAlias = LSystem | MapSystem | CellworkSystem
"""A system of any kind."""
CELL_READERS: Mapping[str, Callable[[str], MapSystem | CellworkSystem]] = {MAP.name: read_map, CELLWORK.name: read_cellwork}
"""What reads systems of cells, by their notations."""
_MAP = re.compile(rf"(?:map|sphere)[ \t]*:(?!.*(?:{ARROW.pattern}))", re.IGNORECASE)
_CELLWORK = re.compile(r"cellwork[ \t]*:", re.IGNORECASE)
"""How their texts begin."""


def read(text: str | PurePath, notation: str | None = None, name: str | None = None) -> LSystem:
    """Read a system.

    Parameters
    ----------
    text
        The model: constants, axiom, productions, one a line. `/* ... */` is a comment. Or a link with a model in it. Or, as a
        `Path`, its file, its folder, or a .zip of that: of a model of cpfg the view, the surfaces and the functions beside it
        are read, too. A text never opens a file.
    notation
        Its name, or that of a format: "list", "page", "data", "xml", "l-py", "lparser". By default the notation whose features
        the text shows most, or, where its reader fails, the first format that finds an axiom and rules in it. Unless it is the
        kit's own, the first note of the system names it, and says what was assumed.
    name
        Which system, where a text holds several with names, as files of Fractint's do; or which model of a folder.

    Raises
    ------
    ModelSyntaxError, ModelNameError, ModelValueError
        The text makes no sense; the error gives the place and a hint, perhaps that another notation fits, or that the text is
        in the format of another program. Or it holds several systems, and none is named.
    ModelFileError
        A file cannot be read.
    ModelLimitError
        The text is too long.

    Examples
    --------
    >>> system = read('''
    ...     axiom: ar
    ...     ar -> al br
    ...     al -> bl ar
    ...     br -> ar
    ...     bl -> al''')
    >>> print(system.productions[0])
    ar -> al br
    >>> read("Axiom: I\\nI -> I[A]A(I)A").notes
    ('Read as plant-string.',)
    >>> read("start : F\\nrules : (F → F+F)\\nangle : 60°").notes
    ('Read as a list of variables and rules, as encyclopaedias have it; angle 60.',)
    >>> print(read("Koch { Angle 6; ...\\nAxiom F\\nF=F+F--F+F }  Line { Angle 4\\nAxiom F }", name="Line"))
    Line {
      Angle 4
      Axiom F
      }
    """
    if isinstance(text, PurePath):
        return _read_path(Path(text), notation, name)
    check_text(text)
    if is_link(text):
        return _read_link(text, notation, name)
    text = text.strip(
        "\ufeff\u200b\u200e\u200f"
    )  # the byte order mark, with which some editors begin a file, and marks of direction
    if "\r" in text and "\n" not in text:
        text = text.replace("\r", "\n")  # lines as they ended on the first Macintosh
    if kind := cells_notation(text):
        start, hint = len(text) - len(text.lstrip()), f"{kind.capitalize()}s are read by read_{kind}(text)."
        raise ModelValueError(f"This is a {kind} system, not an L-system", text, start, None, hint)
    require(notation, (str, type(None)), "The name of a notation")
    if notation is not None and notation in FORMATS:
        return read_as(FORMATS[notation], text, name)
    if notation:
        return _read_as_named(dialect_named(notation), text, name)
    if is_l_py(text):
        return read_as(FORMATS["l-py"], text, name)
    chosen = recognise(text)
    system = _read_or_claimed(chosen, text, name, _others(chosen, text))
    return (
        system
        if chosen is ABOP or system.notation != chosen.name
        else replace(system, notes=(f"Read as {chosen.name}.", *system.notes))
    )


_MODEL = re.compile(r"^[ \t]*axiom\b", re.MULTILINE | re.IGNORECASE)
_PATH = re.compile(r"(?!.*[ ]/[ ])[\w.~: -]*+[/\\][^\n<>=|]*+|[\w -]++\.(?:l|ls|lpy|txt|zip|json|jff|frm)")
"""What looks like the path of a file."""
_LONGEST_PATH = 300


def _read_path(path: Path, notation: str | None, name: str | None) -> LSystem:
    """The system of a file, of a folder or of an archive; a model of cpfg with what is beside it."""
    folder = opened_folder(path)
    model, entry = (path.name, name) if path.is_file() and path.name in folder.files else _model_in(folder, name)
    text = folder.text(model)
    if notation == CPFG.name or (notation is None and recognise(text) is CPFG):
        return read_object(folder, model)
    return read(text, notation, entry)


def _model_in(folder: Folder, name: str | None) -> tuple[str, str | None]:
    """The model of a folder, and the name of a system that is still to be looked for in it."""
    models = [word for words in commands(folder) for word in words if word.endswith(".l")]
    models = [*dict.fromkeys(models)] or [each for each in folder.named(".l") if _MODEL.search(folder.text(each))]
    chosen = next((model for model in models if name in (model, model.removesuffix(".l"))), None)
    if chosen or len(models) == 1:
        return chosen or models[0], None if chosen else name
    if not models:
        raise ModelFileError(
            f'There is no model in "{quotable(folder.title)}"',
            hint="A folder has its model in a file whose name ends in .l; any other file can be given by its own path.",
        )
    raise ModelValueError(
        f'There are {len(models)} models in "{quotable(folder.title)}"',
        hint=f"Choose one: read(path, name={models[0]!r}). They are {', '.join(map(quotable, models))}.",
    )


def _read_link(link: str, notation: str | None, name: str | None) -> LSystem:
    """The system of a link, which names its notation itself."""
    content = unpacked(link)
    if (kind := content.notation) in CELL_READERS:
        hint = f"{kind.capitalize()}s are read by read_{kind}(link)."
        raise ModelValueError(f"This is the link of a {kind} system, not of an L-system", hint=hint)
    if name is not None or notation not in (None, content.notation):
        raise ModelValueError(
            f"This link has one system, in the notation {content.notation}",
            hint="Leave out the notation and the name: read(link).",
        )
    return system_in(dialect_named(content.notation), content.text)


def cells_notation(text: str) -> str | None:
    """The notation of systems of cells in which a text is written, as its beginning shows, or a link; None for any other.

    >>> cells_notation("map: ABAB\\nA -> B"), cells_notation("cellwork: 1(0,0,0)"), cells_notation("axiom: A")
    ('map', 'cellwork', None)
    """
    if is_link(text):
        return name if (name := unpacked(text).notation) in CELL_READERS else None
    start = text.removeprefix("\ufeff").lstrip()
    return MAP.name if _MAP.match(start) else CELLWORK.name if _CELLWORK.match(start) else None


def read_any(text: str) -> AnySystem:
    """The system of a text or a link, of the kind that its beginning shows.

    >>> read_any("map: ABAB").axiom == read_any("axiom: A").axiom
    False
    """
    kind = cells_notation(text)
    return CELL_READERS[kind](text) if kind else read(text)


def _others(chosen: Dialect, text: str) -> Iterator[Dialect]:
    """The other notations that a text may be in, if it is short enough to be read again."""
    if len(text) <= current().expression:
        yield from (notation for notation in DIALECTS.values() if notation is not chosen and notation.likely(text) > 0)


def _reads(notation: Dialect, text: str, name: str | None) -> bool:
    try:
        system_in(notation, text, name)
    except LSystemError:
        return False
    return True


def _read_as_named(notation: Dialect, text: str, name: str | None) -> LSystem:
    """Read a system in the notation that somebody named; what it has against a text is said, whatever else that may be."""
    try:
        return system_in(notation, text, name)
    except LSystemError as error:
        if foreign := foreign_format(text):
            error.with_hint(f"{error.hint or ''} Perhaps {foreign.message[0].lower()}{foreign.message[1:]}.".strip())
        raise


def _read_or_claimed(chosen: Dialect, text: str, name: str | None, others: Iterable[Dialect]) -> LSystem:
    """Read a system in a notation; what cannot be read may be in another, or in the format of another program."""
    try:
        return system_in(chosen, text, name)
    except LSystemError as error:
        other = next((other.name for other in others if _reads(other, text, name)), None)
        if other is None:
            if isinstance(error, ModelLimitError):
                raise foreign_format(text) or error from None
            plain = keyboard_signs(text).text  # as one would type it
            if plain != text and not TAG.search(text):
                for notation in dict.fromkeys((chosen, recognise(plain))):
                    if _reads(notation, plain, name):
                        return system_in(notation, plain, name)
            several = chosen is FRACTINT and isinstance(error, ModelValueError)
            if unreadable := (error if several else unreadable_format(text)):
                raise unreadable from None
            found = read_found(text, name)
            if found is None and len(text) < _LONGEST_PATH and _PATH.fullmatch(text.strip()):
                raise ModelValueError(
                    "This is the name of a file or a folder, and a text never opens one",
                    hint=f'Give it as a path: from pathlib import Path, and then read(Path("{quotable(text.strip())}")).',
                ) from None
            if found is None:
                raise foreign_format(text) or what_is_missing(text) or error from None
            return found
        error.with_hint(f'{error.hint or ""} As {other} it can be read: read(text, "{other}").'.strip())
        raise


def read_word(text: str, notation: str = "abop", system: LSystem | None = None) -> tuple[Module, ...]:
    """Read a word whose arguments are numbers; with a system, letters written together are divided as in its rules.

    >>> [str(module) for module in read_word("A(1/2)[B]")]
    ['A(0.5)', '[', 'B', ']']
    """
    if not text.strip() or text.strip() in ("ε", "*"):
        return ()
    dialect = dialect_named(notation)
    word = parse(dialect, "word", text, 0, len(text))
    with reporting(text, dialect.spelling):
        check_word(word, ())
        if system is not None and notation == "abop":
            word = segment_word(word, system)
        if notation == "abop":
            check_digits(flat(word), system.alphabet if system else ())
        return tuple(Module(part.symbol, tuple(map(value_of, part.arguments)), part.at) for part in flat(word))


def read_expression(text: str) -> Expression:
    """Read an expression; its names are not checked.

    >>> print(read_expression("2*(t+1)"))
    2 * (t + 1)
    """
    expression: Expression = parse(ABOP, "expression", text, 0, len(text))
    return expression


def checked_expression(text: str, names: Collection[str], wanted: str = "number") -> Expression:
    """Read an expression that uses some names and is a "number" or a "truth".

    >>> print(checked_expression("t < 5", ["t"], "truth"))
    t < 5
    """
    expression = read_expression(text)
    with reporting(text):
        check_expression(expression, names, wanted)
    return expression


def read_number(text: str) -> Value:
    """Read a number, exactly; it may be written as a calculation.

    >>> read_number("14/10")
    Fraction(7, 5)
    """
    expression = checked_expression(text, ())
    with reporting(text):
        return value_of(expression)
