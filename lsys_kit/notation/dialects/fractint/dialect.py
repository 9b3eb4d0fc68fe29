"""Fractint's L-systems, the notation of the best-known collections of the web; the grammar is `grammar.lark`.

What Fractint's documentation leaves open is read as the program reads it: case does not matter, and letters are shown as
capitals; a second rule for a symbol goes on where the first ends; a second axiom or angle replaces the first; the point of an
angle and what stands behind it say nothing. A name, braces and one line for each statement are not asked for where they cannot
be missed: a system may stand there without its name and its braces, and blanks in a word say nothing.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from itertools import chain, islice
from pathlib import Path

from lark import Token, Transformer, v_args

from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.dialects.fractint.systems import entries_in, selected_entry, statement_lines, system_entries, uncommented
from lsys_kit.notation.dialects.fractint.writer import (
    LEAST,
    LONGEST,
    MOST,
    NAME,
    RESERVED,
    merged_pair,
    missing_feature,
    module_text,
    system_text,
    translated,
)
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern, flat
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.syntax.actions import Statement
from lsys_kit.notation.syntax.builder import Draft, build_system
from lsys_kit.notation.syntax.dialect import Dialect
from lsys_kit.notation.syntax.wording import Spelling

_COMMAND = re.compile(r"(.)([QI]*+)(.*)", re.IGNORECASE)


@v_args(inline=True)
class Records(Transformer[Token, object]):
    """What `grammar.lark` names: letters are capitals, whatever was typed."""

    def symbol(self, token: Token) -> Pattern:
        return Pattern(token.upper(), at=_at(token))

    def command(self, token: Token) -> Pattern:
        [(sign, inverse_or_root, digits)] = _COMMAND.findall(token)
        return Pattern((sign + inverse_or_root).upper(), (_number(token, digits),) if digits else (), _at(token))

    def word(self, *modules: Pattern) -> tuple[Pattern, ...]:
        return modules

    def angle(self, _: Token, count: Token) -> Statement:
        """Fractint passes over what stands behind the point."""
        whole = count.split(".")[0]
        if len(whole) > len(str(MOST)) or not LEAST <= int(whole) <= MOST:
            raise problem("parts of a turn", _at(count), parts=whole[:10], least=LEAST, most=MOST)
        return "deferred", ("angle", Number(normalised(Fraction(360, int(whole))), _at(count)))

    def radians(self, keyword: Token, turn: Token) -> Statement:
        name = "angle" if keyword[0] in "tT" else "heading"
        degrees = 0 if name == "heading" and not turn.strip("0.") else _degrees(turn)
        return "deferred", (name, Number(degrees, _at(turn)))

    def steps(self, _: Token, count: Token) -> tuple[str, Number]:
        return "steps", Number(int(count), _at(count))

    def axiom(self, _: Token, word: tuple[Pattern, ...]) -> Statement:
        return "deferred", ("axiom", word)

    def production(self, predecessor: Token, word: tuple[Pattern, ...]) -> Statement:
        symbol = predecessor[0].upper()
        start = predecessor.start_pos or 0
        at = start, start + 1
        if "=" not in predecessor and re.match("--?>", "".join(module.symbol for module in word[:3])):
            raise problem("arrow in rule", word[0].at, symbol=predecessor[0])
        if symbol in RESERVED:
            raise problem("command rewritten", at, symbol=predecessor[0])
        return "deferred", ("rule", Production((Pattern(symbol, at=at),), word))

    def erasing(self, predecessor: Token) -> Statement:
        if "=" not in predecessor:
            raise problem("no successor", _at(predecessor), symbol=predecessor[0])
        return self.production(predecessor, ())


def _at(token: Token) -> tuple[int, int]:
    return token.start_pos or 0, token.end_pos or 0


_FACTOR = re.compile(r"(?:([*/])[ \t]*+)?(pi|[\d.]++)", re.IGNORECASE)
_MOST_FACTORS, _FINEST = 8, 10**LONGEST


def _degrees(turn: Token) -> Value:
    """A turn in radians, as degrees: exactly where it has a π, else to a billionth of a degree."""
    factors = _FACTOR.findall(turn)
    value, powers = Fraction(180), -1
    for sign, written in factors:
        is_pi = written[0] in "pP"
        factor = Fraction(1) if is_pi else Fraction(f"0{written.rstrip('.')}") if len(written) <= LONGEST else Fraction(0)
        if not factor or len(factors) > _MOST_FACTORS:
            raise problem("turn in radians", _at(turn))
        value = value / factor if sign == "/" else value * factor
        powers += is_pi * (-1 if sign == "/" else 1)
    degrees = Fraction(value if not powers else str(round(float(value) * math.pi**powers, 9)))
    if not 0 < degrees <= 360 or degrees.denominator > _FINEST:
        raise problem("turn in radians", _at(turn))
    return normalised(degrees)


def _number(token: Token, digits: str) -> Number:
    if not re.fullmatch(r"\d++\.?\d*+|\.\d++", digits) or len(digits) > LONGEST:
        raise problem("number of command", _at(token))
    return Number(normalised(Fraction(f"0{digits}" if digits[0] == "." else digits.rstrip("."))), _at(token))


_SAID = re.compile(r"angle(?:\s*=)?\s*\d++(?!\.\d)|axiom(?:\s*=\s*|\s+)[^\s:=]", re.IGNORECASE)
"""A line that gives an angle or an axiom, without a colon."""
_OTHER = re.compile(
    r"(?![^\s=]\s*=(?!\s*\{)|axiom|angle|(?:theta|alpha)\s*+(?:=\s*+)?(?:pi\b|[0-6]?\.\d|\d{1,3}\b)).*?(?:->|→|⟶|::=|:\s|\\rightarrow|\w{3}\s*=)|axiom\s*=\s*AXIOM"
    r"|\S[ ](?-i:[a-z]{4,})[ ]|\w++\s*+=\s*+\"",
    re.IGNORECASE,
)
"""A line that no system of Fractint's has."""
_IN_DEGREES = re.compile(
    r"^[ \t]*angle(?:(?:\s*=)?\s*(?:\d++\.0*[1-9]|5[1-9]|[6-9]\d|\d{3})|\s*=\s*(?:1[3-9]|[2-5]\d))",
    re.IGNORECASE | re.MULTILINE,
)
"""An angle in degrees, and no number of parts: Fractint takes fifty at most, and asks for no sign before it."""
SAMPLED_SYSTEMS = 50
"""So many systems of a file show in which notation it is."""


def _finish(draft: Draft) -> LSystem:
    """The system: of several angles or axioms the last counts, and the rules for a symbol are one."""
    said = {kind: (record, at) for kind, record, at in draft.deferred if kind != "rule"}
    for kind in said:
        if sum(kind == other for other, *_ in draft.deferred) > 1:
            draft.notes.append(f"The {kind} is given more than once: the last one is used.")
    if "axiom" in said:
        draft.axiom = said["axiom"][0]
    _check(draft, {*said})
    draft.settings |= {"angle": said["angle"][0], "heading": said["heading"][0] if "heading" in said else Number(0)}
    _note_angle(draft, said["angle"])
    _note_digits(draft)
    draft.sections["productions"] = _joined(draft)
    return build_system(draft)


def _note_angle(draft: Draft, said: tuple[Number, tuple[int, int]]) -> None:
    """Say what an angle in radians comes to, and what any means where only the reader says that a text is one of Fractint's:
    it has no braces."""
    angle, (start, end) = said
    if draft.source[start] not in "tT" and draft.source[start:end].partition(".")[2].strip("0"):
        draft.notes.append(
            f'Fractint passes over what stands behind the point: "{draft.source[start:end]}" is {360 / angle.value}.'
        )
    if draft.source[start] in "tT":
        draft.notes.append(f'"theta" is in radians: + and - turn by {float(angle.value):.6g} degrees.')
    elif "{" not in uncommented(draft.source):
        parts = Fraction(360) / Fraction(angle.value)
        draft.notes.append(
            f'"Angle {parts}" is a turn of {float(angle.value):.4g} degrees: 360 divided by {parts}. '
            f'For {parts} degrees write "angle: {parts}" and "axiom: ...", and each rule with "->".'
        )


def _note_digits(draft: Draft) -> None:
    """Say which digits are passed over: elsewhere they count, or number colours."""
    rules = [record for kind, record, _ in draft.deferred if kind == "rule"]
    words = chain(draft.axiom or (), *(rule.successor for rule in rules))
    heads = {rule.predecessor.symbol for rule in rules}
    if digits := sorted({each.symbol for each in flat(words) if each.symbol.isdigit()} - heads):
        draft.notes.append(
            f"Fractint passes over digits but behind @, C, <, >, \\ and /: {', '.join(digits)}. "
            'What is repeated is written out, as in "++".'
        )


def _check(draft: Draft, said: set[str]) -> None:
    for kind in ("axiom", "angle"):
        if kind not in said:
            end = max((at[1] for _, _, at in draft.deferred), default=len(draft.source.rstrip()))
            raise problem(f"no {kind}", (end, end))


def _joined(draft: Draft) -> list[Production]:
    """One rule for each symbol, the words of its rules one behind another."""
    rules: dict[str, list[tuple[Production, tuple[int, int]]]] = {}
    for kind, rule, at in draft.deferred:
        if kind == "rule":
            rules.setdefault(rule.predecessor.symbol, []).append((rule, at))
    return [_one(draft, parts) for parts in rules.values()]


def _one(draft: Draft, parts: list[tuple[Production, tuple[int, int]]]) -> Production:
    successor = tuple(chain.from_iterable(rule.successor for rule, _ in parts))
    if pair := merged_pair(flat(successor)):
        raise problem("symbol in number", pair[1].at or parts[0][1], symbol=pair[1].symbol, command=module_text(pair[0]))
    return Production(parts[0][0].predecessors, successor, at=parts[0][1] if len(parts) == 1 else None)


def _likely(text: str) -> int:
    """Ten for each line of the first systems that gives an angle or an axiom as only Fractint does; nothing where other lines
    cannot stand there."""
    if not _SAID.search(text):
        return 0
    plain = uncommented(text)
    sample = system_entries(islice(entries_in(plain), SAMPLED_SYSTEMS))
    if not sample and _IN_DEGREES.search(plain):
        return 0
    bodies = [plain[entry.opened + 1 : entry.stop] for entry in sample] or [plain]
    said = [line.strip() for body in bodies for line in body.splitlines()]
    return 0 if any(map(_OTHER.match, said)) else 10 * sum(map(bool, map(_SAID.match, said)))


FRACTINT = Dialect(
    name=NAME,
    statements=statement_lines,
    transformer=Records,
    finish=_finish,
    diagnostics=("colon", "angle", "axiom", "arrow", "beginning", "in_a_word"),
    module=module_text,
    joined="".join,
    write=system_text,
    lacks=(
        "conditions",
        "contexts",
        "predecessors of several modules",
        "probabilities",
        "repetition",
        "constants",
        "decomposition rules",
        "meta-rules",
        "interpretation rules",
        "ignored symbols",
        "field",
    ),
    missing_feature=missing_feature,
    likely=_likely,
    turtle=NAME,
    entry=selected_entry,
    starts=("statement", "word"),
    translated=translated,
    spelling=Spelling(Path(__file__).parent),
    bare=str,
)
