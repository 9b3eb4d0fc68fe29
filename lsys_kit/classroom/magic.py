"""`%%lsystem NAME`: a cell whose text is a model, which is read and shown; a mistake is underlined where it stands.

Nothing in such a cell is run as code: its text goes to the kit's grammars only, and `{...}` and `$...` in its first line are
not expanded, as they are by other magics.
"""

from __future__ import annotations

import builtins
import re
import unicodedata
from keyword import iskeyword
from typing import Any

import lsys_kit
from lsys_kit.classroom.typeset import boxed, shown
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS, dialect_named
from lsys_kit.notation.syntax.failure import excerpt
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.pictures.style.palette import INK, MARK, PAPER, QUIET, VERMILION

AROUND, WIDTH = 8, 100
"""How many lines before and after a mistake are shown, and how many characters of each."""


def load(shell: Any) -> None:
    """Make `%%lsystem` known to a notebook, and let it show every system in that way."""
    from IPython.core.magic import no_var_expand

    def lsystem(line: str, cell: str) -> None:
        """Define an L-system from the text in the cell, and show it.

        `%%lsystem NAME` gives it a name, `%%lsystem NAME NOTATION` also gives its notation, and `%%lsystem` alone
        only shows it:

            %%lsystem koch
            angle: 60
            axiom: F--F--F
            F -> F+F--F+F
        """
        shell.display_pub.publish(_cell_output(shell, line, cell))

    shell.register_magic_function(no_var_expand(lsystem), "cell")
    shell.display_formatter.mimebundle_formatter.for_type(LSystem, shown)


def _cell_output(shell: Any, line: str, cell: str) -> dict[str, str]:
    """What a cell shows: the system, which is bound to the name, or the mistake in it."""
    head, name = f"%%lsystem {line}", ""
    try:
        name, notation = _name_and_notation(head, shell)
        system = read(f"\n{cell.rstrip()}", notation or None)  # the first line of the cell counts, as in its editor
    except LSystemError as mistake:
        return underlined(mistake, f"{head}\n{cell.rstrip()}", _standing(name, shell))
    notes = _shadowed(name, shell)
    if name:
        shell.push({name: system})
    return shown(system, name, notes)


def _name_and_notation(head: str, shell: Any) -> tuple[str, str]:
    """The name and the notation in the first line of a cell; empty where they are not given."""
    words = [(match.group(), match.span()) for match in re.finditer(r"\S+", head)][1:]
    if len(words) > 2:
        raise ModelSyntaxError(
            "Only a name and a notation may follow %%lsystem",
            head,
            words[2][1][0],
            words[-1][1][1],
            'Write "%%lsystem NAME" or "%%lsystem NAME NOTATION".',
        )
    for word, at in words[:1]:
        wrong = _unfit(word, shell)
        if wrong:
            raise ModelNameError(wrong[0], head, *at, wrong[1])
    for word, at in words[1:]:
        try:
            dialect_named(excerpt(word))
        except ModelNameError as unknown:
            raise ModelNameError(unknown.message, head, *at, suggestion(word[:20], DIALECTS) or unknown.hint) from None
    name, notation = ([word for word, _ in words] + ["", ""])[:2]
    return unicodedata.normalize("NFKC", name), notation  # as Python reads names


def _unfit(name: str, shell: Any) -> tuple[str, str] | None:
    """Why a word cannot be the name of a system, and what to do; or None."""
    quoted, another = f'"{excerpt(name)}"', "Choose another name."
    plain = unicodedata.normalize("NFKC", name)
    if name in DIALECTS:
        return f"{quoted} is a notation, not a name", f'Put a name before it, as in "%%lsystem plant {name}".'
    if not plain.isidentifier() or len(plain) > 64:
        return f"{quoted} cannot be a name", "A name is made of letters, digits and _, and begins with a letter."
    if iskeyword(plain):
        return f"{quoted} is a keyword of Python", another
    if plain in lsys_kit.__all__:
        return f"{quoted} is a name that the kit uses", another
    if plain.startswith("_") or (plain in shell.user_ns_hidden and shell.user_ns_hidden[plain] is shell.user_ns.get(plain)):
        return f"{quoted} is a name that the notebook uses", another
    return None


def _shadowed(name: str, shell: Any) -> list[str]:
    """A note where the name meant something else before."""
    if name in shell.user_ns:
        return (
            []
            if isinstance(shell.user_ns[name], LSystem)
            else [f'"{name}" meant something else in this notebook. From now on it means this system.']
        )
    return (
        [f'"{name}" is also a name of Python\'s. From now on it means this system in this notebook.']
        if hasattr(builtins, name)
        else []
    )


def _standing(name: str, shell: Any) -> str:
    if not name:
        return ""
    if isinstance(shell.user_ns.get(name), LSystem):
        return f'"{name}" is still the system that was read before.'
    return f'There is no system "{name}" yet.'


def underlined(mistake: LSystemError, text: str, after: str = "") -> dict[str, str]:
    """A mistake as a notebook shows it: what is wrong, the text with the wrong stretch underlined, what to try.

    >>> mistake = LSystemError("Here is no arrow", "A B", 2, 3, "Type one.")
    >>> print(underlined(mistake, "A B")["text/plain"])
    Not readable yet. Here is no arrow (line 1, column 3). Type one.
      A B
        ^
    """
    said = str(mistake).partition("\n")[0]
    html = (
        f'<span aria-hidden="true">&#9888;</span> <b>Not readable yet.</b> {escaped(said)}'
        f"{_quoted_lines(mistake, text)}{escaped(after)}"
    )
    return {
        "text/html": boxed("lsys-mistake", "alert", VERMILION, html),
        "text/plain": f"Not readable yet. {mistake}" + (f"\n{after}" if after else ""),
    }


def _quoted_lines(mistake: LSystemError, text: str) -> str:
    if mistake.line is None:
        return "<br>"
    lines = text.split("\n")
    first, last = max(0, mistake.line - 1 - AROUND), min(len(lines), mistake.line + AROUND)
    digits = len(str(last))
    quoted = (
        f'<span style="color:{QUIET};user-select:none">{number + 1:>{digits}}  </span>'
        + (_underlined_line(lines[number], mistake) if number + 1 == mistake.line else escaped(lines[number][:WIDTH]))
        for number in range(first, last)
    )
    return f'<pre style="margin:6px 0;color:{INK};background:{PAPER};overflow-x:auto">' + "\n".join(quoted) + "</pre>"


def _underlined_line(line: str, mistake: LSystemError) -> str:
    """The line of a mistake, with the wrong stretch underlined; of a long line only what is around it."""
    assert mistake.column is not None
    assert mistake.end is not None
    start, end = mistake.column - 1, min(mistake.end - 1, mistake.column - 1 + WIDTH)
    first = max(0, start - WIDTH // 2)
    look = f"background:{MARK};font-weight:bold;text-decoration:underline wavy {VERMILION} 2px;text-underline-offset:3px"
    return (
        escaped(line[first:start])
        + f'<u style="{look}">{escaped(line[start:end]) or "&nbsp;"}</u>'
        + escaped(line[end : first + 2 * WIDTH])
    )
