"""The kit's own notation, after The Algorithmic Beauty of Plants, and its mathematical form; the grammar is `abop.lark`.

Articles print systems as `p_1 : a_r → a_l b_r`, as `{ar -> al br, al -> bl ar}`, as `s < a > → a s,`. What only labels a
production or parts it from the next is no part of it: it is cut off before the grammar reads the rest.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from lark import Transformer
from lark.visitors import merge_transformers

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.model.system import LSystem, flat, joined
from lsys_kit.notation.syntax.actions import Expressions, Statements
from lsys_kit.notation.syntax.builder import Draft, assembled
from lsys_kit.notation.syntax.diagnostics import QUESTIONS, without_colon
from lsys_kit.notation.syntax.dialect import Notation
from lsys_kit.notation.syntax.failure import outside
from lsys_kit.notation.syntax.formatting import first_lacking, sections, settings
from lsys_kit.notation.syntax.predecessor_diagnostics import forgotten_colon
from lsys_kit.notation.syntax.segmentation import apart, with_letters_apart
from lsys_kit.notation.syntax.statements import ARROW, statements, without_comments

# What the mathematical form looks like: labels, sets of productions, and what cannot stand behind a label.
_LABEL = re.compile(r"([pP]_?(?:\d+|\{\d+\}))[ \t]*:[ \t]*")
_LABELLED = re.compile(rf"^[ \t]*{_LABEL.pattern}", re.MULTILINE)
_SET = re.compile(r"(?:P[ \t]*=[ \t]*)?\{(?=\s*[A-Za-z\\(])")
_IN_A_SET = re.compile(rf"^[ \t]*{_SET.pattern}", re.MULTILINE)
_COMPARED = re.compile(r"[<>=!]=|&&|\|\||[≤≥≠∧∨]|\\[lgn]eq?\b")
_TWO_NAMES = re.compile(r"\s*(?!not\b)[A-Za-z_]\w*\s+(?!and\b|or\b)[A-Za-z_]")
_SYMBOL = re.compile(r"[A-Za-z_]\w*|[-+&^\\/|\[\]{}$!'#~;.%@ε]|@(?:T[a-z]|[A-Za-z])|\?[A-Z]", re.ASCII)
"""What a symbol may be."""
_PARTED = re.compile(r"[()\[\]{},]")


def printed(text: str) -> Iterator[tuple[int, int]]:
    """The offsets of the statements, without what labels them and parts them from each other in print.

    >>> text = "p_1: a -> b,\\nP = {b -> a, c -> b}"
    >>> [text[start:end] for start, end in printed(text)]
    ['a -> b', 'b -> a', 'c -> b']
    """
    plain = without_comments(text)
    used = frozenset(re.findall(r"\b\w++(?!\s*:)", plain)) if _LABELLED.search(plain) else frozenset()
    for start, end in _members(plain, text):
        label = _LABEL.match(plain, start, end)
        if label and _labels(plain[label.end():end], label[1] in used):
            start = label.end()
        if plain[end - 1] == ",":
            rule = plain[start:end - 1].rstrip()
            arrow = ARROW.search(rule)
            end = start + len(rule) if arrow and arrow.end() < len(rule) else end
        yield start, end


def _labels(rest: str, used: bool) -> bool:
    """Whether a name with a colon behind it labels a production: then it stands for no module that has a condition."""
    arrow = ARROW.search(rest)
    head = rest[:arrow.start()] if arrow else ""
    bare = outside(head)
    if ":" in bare or _TWO_NAMES.match(bare):
        return True
    if head.strip() in ("", "*") or _COMPARED.search(head) or re.search(r"\([^()]*[<>]", head):
        return False
    sides = re.split("[<>]", bare)
    numbers = any(re.search(r"(?<![\w.])[\d.]", side) for side in sides)
    return len(sides) == 1 or not (numbers or (used and all(map(str.strip, sides))))


def _members(plain: str, source: str) -> Iterator[tuple[int, int]]:
    """The offsets of the statements, those of a set of productions one after another."""
    opened, first, depth = None, 0, 0
    for start, end in statements(source):
        if opened is None:
            opened = _SET.match(plain, start)
            first, depth = start, 0
        if opened is None:
            yield start, end
            continue
        depth += plain.count("{", start, end) - plain.count("}", start, end)
        if depth <= 0:
            closed = plain[end - 1] == "}" and ARROW.search(plain, first, end)
            yield from _parted(plain, opened.end(), end - 1) if closed else [(first, end)]
            opened = None
    if opened is not None:
        raise ModelSyntaxError('This "{" is never closed', source, opened.end() - 1, opened.end(),
                               'Every "{" needs a "}" behind it.')


def _parted(plain: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """The offsets of what stands between commas, as far as these are not in brackets."""
    depth = 0
    for match in (*_PARTED.finditer(plain, start, end), None):
        if match is None or (match[0] == "," and depth == 0):
            member = plain[start:match.start() if match else end]
            if member.strip():
                yield start + len(member) - len(member.lstrip()), start + len(member.rstrip())
            start += len(member) + 1
        else:
            depth += (match[0] in "([{") - (match[0] in ")]}")


def _records() -> Transformer[Any, Any]:
    return merge_transformers(Statements(), expressions=Expressions())  # type: ignore[no-untyped-call,no-any-return]


def _settle(draft: Draft) -> None:
    """Take in what the mathematical form says otherwise than the kit: an axiom beside a set, the angle δ, the length d."""
    plain = without_comments(draft.source)
    for kind, record, at in draft.more:
        if kind == "axiom" and not _IN_A_SET.search(plain):
            raise without_colon(draft.source, at[0], draft.source[at[0]:at[0] + 5], draft.source[at[0] + 5:at[1]])
        draft.add(kind, record, at)
    length = next((constant for constant in draft.constants if constant.name == "d"), None)
    if length and re.search(r"(δ|\\delta)\s*=", plain) and len(re.findall(r"\bd\b", plain)) == 1:
        draft.constants.remove(length)
        draft.add("length", length.value, length.at or (0, 0))
        draft.notes.append('"d" is read as the length of a segment.')


def _made(draft: Draft) -> set[str]:
    """The symbols that can occur in words."""
    productions = [rule.successor for rules in draft.sections.values() for rule in rules]
    words = (draft.axiom or (), *productions, *(rule.successor for rule in draft.meta))
    return {module.symbol for word in words for module in flat(word)}


def _finish(draft: Draft) -> LSystem:
    """The system with letters that were written together parted, and a note that says so."""
    _settle(draft)
    forgotten_colon(draft.sections["productions"], _made(draft), draft.source)
    return with_letters_apart(assembled(draft))


def _write(system: LSystem) -> str:
    while mistaken := apart(system)[1]:
        system = replace(system, alphabet=(*system.alphabet, *mistaken))
    look = [] if system.cells == LSystem.cells else [f"cells: {system.cells}"]
    return "\n".join([*map(str, system.constants), *settings(system), *look, f"axiom: {joined(map(str, system.axiom))}",
                      *sections(system, str)])


def _lacking(system: LSystem) -> str | None:
    """What the notation cannot write: round branches, and symbols such as digits or a comma."""
    strange = (module.symbol for module in system.modules if not _SYMBOL.fullmatch(module.symbol))
    found = next(strange, None)
    return first_lacking(system, "round brackets as branches") or (None if found is None else f'symbol "{found}"')


ABOP = Notation(
    name="abop", statements=printed, records=_records, finish=_finish, questions=QUESTIONS, module=str, joined=joined,
    write=_write, lacking=_lacking, likely=lambda text: 1)
