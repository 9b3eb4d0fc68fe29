"""`%%lsystem NAME`: a cell whose text is a model, which is read and shown typeset; a mistake is underlined where it stands.

Nothing in such a cell is run as code: its text goes to the kit's grammars only, and `{...}` and `$...` in its first line are
not expanded, as they are by other magics.

A system is typeset as in a book: its notation and notes in words, its rules as mathematics, its first words. Rules of every
notation look alike here, as in The Algorithmic Beauty of Plants: contexts before and after the strict predecessor, the
probability over the arrow. All text is escaped: nothing that a model says can become markup.
"""

from __future__ import annotations

import builtins
import re
import unicodedata
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from itertools import islice
from keyword import iskeyword
from typing import TYPE_CHECKING, Any

import lsys_kit
from lsys_kit.budget import current, limits
from lsys_kit.classroom.exercises.verdict import PLAIN_TEXT
from lsys_kit.classroom.panel.word_view import word_html
from lsys_kit.derivation.core.letters import conditions_text, letters_from
from lsys_kit.derivation.core.words import Word, abridged
from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelSyntaxError
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Item, Module, Pattern, Repeat
from lsys_kit.notation.model.operators import OPERATORS
from lsys_kit.notation.model.system import Constant, LSystem, MetaRule, Production
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS, dialect_named
from lsys_kit.notation.syntax.failure import excerpt
from lsys_kit.notation.syntax.formatting import settings
from lsys_kit.pictures.style.labels import escaped, html_label
from lsys_kit.pictures.style.palette import BLUE, INK, MARK, PAPER, QUIET, VERMILION
from lsys_kit.worlds.derive import derive

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

AROUND, WIDTH = 8, 100
"""How many lines before and after a mistake are shown, and how many characters of each."""


def load(shell: Any) -> None:
    """Make `%%lsystem` known to a notebook, and let it show every system in that way."""
    from IPython.core.magic import no_var_expand

    def lsystem(line: str, cell: str) -> None:
        """Define an L-system from the text in the cell, and show it.

        `%%lsystem NAME` gives it a name, `%%lsystem NAME NOTATION` also gives its notation, and `%%lsystem` alone
        only shows it; with `--letter q` its first words have formulas, in which the constant q is a letter:

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
        name, notation = _name_and_notation(_LETTER.sub(lambda match: " " * len(match.group()), head), shell)
        system = read(f"\n{cell.rstrip()}", notation or None)  # the first line of the cell counts, as in its editor
        letters = letters_from(system, _LETTER.findall(head))
    except LSystemError as mistake:
        return underlined(mistake, f"{head}\n{cell.rstrip()}", _standing(name, shell))
    notes = _shadowed(name, shell)
    if name:
        shell.push({name: system})
    return shown(system, name, notes, letters)


_LETTER = re.compile(r"(?<=\s)--letter[\s=]++(\S++)")


def _name_and_notation(head: str, shell: InteractiveShell) -> tuple[str, str]:
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


def _unfit(name: str, shell: InteractiveShell) -> tuple[str, str] | None:
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


def _shadowed(name: str, shell: InteractiveShell) -> list[str]:
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


def _standing(name: str, shell: InteractiveShell) -> str:
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


# A system, typeset

FIRST_STEPS, FIRST_MODULES = 4, 80
"""How many words are shown after the axiom, and how many modules they may have."""
MOST_DERIVED = 10_000
"""Larger words are not derived, so that a system is shown at once."""
MOST_RULES, MOST_MODULES = 60, 200
"""How many rules of a section, and how many modules of a word, are typeset."""
_MATHEMATICAL_SIGNS: Mapping[str, str] = {
    "<=": "≤",
    ">=": "≥",
    "!=": "≠",
    "==": "=",
    "&&": "∧",
    "||": "∨",
    "!": "¬",
    "*": "·",
    "-": "−",
    "-x": "−",
}
_RULE_SECTIONS = (
    ("productions", "p", "productions"),
    ("meta", "m", "what shortens a word (meta-rules)"),
    ("decomposition", "d", "what a module consists of (decomposition)"),
    ("interpretation", "i", "what a module is drawn as (interpretation)"),
)
_QUIET = f'style="color:{QUIET}"'
_ASIDE = f"color:{QUIET};font:14px sans-serif"
_CELL = "text-align:left;vertical-align:baseline;padding:1px 10px 1px 0;border:none;max-width:none"


def shown(system: LSystem, name: str = "", notes: Iterable[str] = (), letters: Collection[str] = ()) -> dict[str, str]:
    """A system as a notebook shows it, with formulas in its first words where constants are letters.

    >>> from lsys_kit import read
    >>> print(shown(read("axiom: F\\nF -> F[+F]"), "twig")["text/plain"])
    twig is an L-system in the notation abop.
      axiom: F
      F -> F[+F]
    step 0: F
    step 1: F[+F]
    step 2: F[+F][+F[+F]]
    step 3: F[+F][+F[+F]][+F[+F][+F[+F]]]
    step 4: F[+F][+F[+F]][+F[+F][+F[+F]]][+F[+F][+F[+F]][+F[+F][+F[+F]]]]
    """
    said = [*notes, *system.notes]
    words, stop = first_words(system, letters)
    if words and (held := conditions_text(words[-1].states)):
        said.append(held)
    if stop:
        said.append(stop)
    return {"text/html": _box(system, name, said, words), "text/plain": _plain_text(system, name, said, words)}


def first_words(system: LSystem, letters: Collection[str] = ()) -> tuple[list[Word], str]:
    """The words of the first steps while they are short; and the reason where a step cannot be derived.

    >>> from lsys_kit import read
    >>> first_words(read("axiom: A(0)\\nA(t) -> A(1/t)"))[1]
    'Step 1 cannot be derived. A(0) under production 1, A(t) -> A(1/t), has no value: division by zero.'
    """
    words: list[Word] = []
    most = min(MOST_DERIVED, current().modules)
    try:
        with limits(modules=most, seconds=min(1, current().seconds)):
            derivation = derive(system, 0, letters=letters)
            for step in range(FIRST_STEPS + 1):
                derivation = derivation.to(step)
                if step and derivation.lengths[-1] > FIRST_MODULES:
                    break
                words.append(derivation[-1])
    except ModelLimitError as error:
        return words, "" if error.limit == most else f"{error.message}."
    except LSystemError as error:
        return words, f"Step {len(words)} cannot be derived. {error.message}."
    return words, ""


def _plain_text(system: LSystem, name: str, notes: Iterable[str], words: Iterable[Word]) -> str:
    rules = (f"  {line}" for line in str(system).splitlines())
    steps = (f"step {step}: {abridged(word, 400)}" for step, word in enumerate(words))
    return "\n".join([f"{name or 'This'} is an L-system in the notation {system.notation}.", *notes, *rules, *steps])


def _box(system: LSystem, name: str, notes: Iterable[str], words: Iterable[Word]) -> str:
    called = f"<b>{escaped(name)}</b>" if name else "This"
    set_so = " &nbsp;·&nbsp; ".join(map(escaped, settings(system, dialect_named(system.notation).turtle)))
    steps = "".join(_table_row((f"<span {_QUIET}>{step}</span>", word_html(word))) for step, word in enumerate(words))
    return boxed(
        "lsys-system",
        "group",
        BLUE,
        f"<div>{called} is an L-system in the notation {escaped(system.notation)}.</div>"
        + "".join(f"<div>{escaped(note)}</div>" for note in notes)
        + _table(_rule_rows(system), "font-family:Georgia,serif;font-size:16px;line-height:1.5")
        + (f"<div {_QUIET}>{set_so}</div>" if set_so else "")
        + f"<div {_QUIET}>first words</div>{_table([steps])}",
    )


def boxed(name: str, role: str, colour: str, content: str) -> str:
    """A box with a coloured edge; dollar signs in it are turtle commands, not formulas.

    >>> "mathjax_ignore" in boxed("lsys-system", "group", BLUE, "$A$")
    True
    """
    return (
        f'<div class="{name} {PLAIN_TEXT}" role="{role}" style="border-left:6px solid {colour};background:{PAPER};'
        f'color:{INK};padding:6px 12px;font:14px/1.5 sans-serif;overflow-x:auto">{content}</div>'
    )


def _table(rows: Iterable[str], look: str = "") -> str:
    style = f"border-collapse:collapse;table-layout:auto;margin:4px 0;color:{INK};{look}"
    return f'<table style="{style}"><tbody>{"".join(rows)}</tbody></table>'


def _table_row(cells: Iterable[str], wide: int = 0) -> str:
    """A row of a table; its last cell may span several columns."""
    *most, last = cells
    span = f' colspan="{wide}"' if wide else ""
    inner = "".join(f'<td style="{_CELL};white-space:nowrap">{cell}</td>' for cell in most)
    return f'<tr style="background:{PAPER}">{inner}<td{span} style="{_CELL};white-space:normal">{last}</td></tr>'


def _rule_rows(system: LSystem) -> Iterator[str]:
    for constant in system.constants[:MOST_RULES]:
        yield _table_row(("", _constant_html(constant, system)), wide=3)
    yield _table_row(("<i>ω</i>", _word(system.axiom, system)), wide=3)
    for field, letter, heading in _RULE_SECTIONS:
        rules = getattr(system, field)
        if rules and field != "productions":
            yield _table_row((f'<span style="{_ASIDE}">{heading}</span>',), wide=4)
        for number, rule in enumerate(rules[:MOST_RULES], 1):
            label = f'<i>{letter}</i><sub style="line-height:0">{number}</sub>'
            yield _table_row((label, _before_arrow(rule, system), _arrow_html(rule, system), _word(rule.successor, system)))
        if len(rules) > MOST_RULES:
            yield _table_row(("", f"… {len(rules) - MOST_RULES:,} more"), wide=3)


def _constant_html(constant: Constant, system: LSystem) -> str:
    text = f"{formula(Name(constant.name), system)} = {formula(constant.value, system)}"
    if constant.range is None:
        return text
    first, last, by = (formula(end, system) for end in constant.range)
    return f'{text} <span style="{_ASIDE}">from {first} to {last} by {by}</span>'


def _before_arrow(rule: Production | MetaRule, system: LSystem) -> str:
    if isinstance(rule, MetaRule):
        text = _word(rule.predecessors, system)
    else:
        left = f"{_word(rule.left, system)} &lt; " if rule.left else ""
        right = f" &gt; {_word(rule.right, system)}" if rule.right else ""
        text = f"{left}{_word(rule.predecessors, system)}{right}"
    return f"{text} : {formula(rule.condition, system)}" if rule.condition is not None else text


def _arrow_html(rule: Production | MetaRule, system: LSystem) -> str:
    if isinstance(rule, MetaRule) or rule.probability is None:
        return "⟶"
    return (
        '<span style="display:inline-block;text-align:center;line-height:1"><span style="font-size:75%">'
        f"{formula(rule.probability, system)}</span><br>⟶</span>"
    )


def _word(items: tuple[Item, ...], system: LSystem) -> str:
    html = "&thinsp;".join(_item(item, system) for item in islice(items, MOST_MODULES))
    return html + (f" … {len(items) - MOST_MODULES:,} more" if len(items) > MOST_MODULES else "") or "ε"


def _item(item: Item, system: LSystem) -> str:
    """A module, or a repeated part in parentheses with its count."""
    if isinstance(item, Pattern):
        values = ", ".join(formula(a, system) for a in item.arguments)
        return html_label(Module(item.symbol), system) + (f"({values})" if values else "")
    return _repeated(item, system)


def _repeated(repeat: Repeat, system: LSystem) -> str:
    """A repeated part as mathematics writes a power, or a product over an index."""
    body = f"({_word(repeat.body, system)})"
    if not repeat.index:
        return f"{body}<sup>{formula(repeat.count, system)}</sup>"
    last = Number(repeat.count.value - 1) if isinstance(repeat.count, Number) else Apply("-", (repeat.count, Number(1)))
    return f"{body}<sub>{formula(Name(repeat.index), system)} = 0 … {formula(last, system)}</sub>"


def formula(expression: Expression, system: LSystem) -> str:
    """An expression as mathematics, in HTML: names italic, exponents raised, the signs of mathematics.

    >>> from lsys_kit.notation.read import read, read_expression
    >>> formula(read_expression("2*(x+1)^n >= -y"), read("axiom: A"))
    '2 · (<i>x</i> + 1)<sup><i>n</i></sup> ≥ −<i>y</i>'
    """

    def part(operand: Expression, tightly: int) -> str:
        return f"({formula(operand, system)})" if _binding(operand) < tightly else formula(operand, system)

    if isinstance(expression, Number):
        return number_text(expression.value).replace("-", "−")
    if isinstance(expression, Name):
        return html_label(Module(expression.name), system)
    return _operation_html(expression, part)


def _operation_html(expression: Apply, part: Callable[[Expression, int], str]) -> str:
    """An operator with its operands, each in parentheses where it binds less tightly."""
    operator, operands = OPERATORS[expression.operator], expression.operands
    sign = escaped(_MATHEMATICAL_SIGNS.get(expression.operator, expression.operator))
    if operator.precedence is None:
        return f"{sign}({', '.join(part(operand, 0) for operand in operands)})"
    if len(operands) == 1:
        return sign + part(operands[0], 7 if expression.operator == "!" else operator.precedence)
    if expression.operator == "^":
        return f"{part(operands[0], 8)}<sup>{part(operands[1], 0)}</sup>"
    return part(operands[0], operator.precedence) + operator.spelling(sign) + part(operands[1], operator.precedence + 1)


def _binding(expression: Expression) -> int:
    """How tightly an expression binds; what needs no parentheses binds most tightly."""
    if isinstance(expression, Number):
        text = number_text(expression.value)
        return 5 if "/" in text else 6 if text.startswith("-") else 9
    precedence = OPERATORS[expression.operator].precedence if isinstance(expression, Apply) else None
    return 9 if precedence is None else precedence
