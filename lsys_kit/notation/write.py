"""Records to text: a whole system, laid out in its notation.

`read(write(system)) == system` for every system that the notation can express.
"""

from __future__ import annotations

from collections.abc import Iterator

from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.arithmetic import number_text
from lsys_kit.notation.model import LSystem, Module, Repeat, flat, joined

NOTATIONS = ("abop", "plant-string")
"""The notations that can be read and written."""


def write(system: LSystem, notation: str | None = None) -> str:
    """The text of a system.

    Parameters
    ----------
    system
        Any L-system.
    notation
        One of `NOTATIONS`; by default the one in which the system was read.

    Raises
    ------
    ModelNameError
        There is no such notation.
    ModelValueError
        The notation lacks something that the system needs; the message names it.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> print(write(read("axiom: A(0)  \\nA(t): t<5 --> A(t+1) [B]")))
    axiom: A(0)
    A(t) : t < 5 -> A(t + 1)[B]
    """
    notation = known(notation or system.notation)
    lacking = _lacking(system, notation)
    if lacking:
        raise ModelValueError(f"The notation {notation} has no {lacking}, which this system needs")
    axiom = "Axiom: " if notation == "plant-string" else "axiom: "
    return "\n".join([*_head(system), axiom + joined_in(notation, system.axiom), *_productions(system, notation)])


def known(notation: str) -> str:
    """The notation itself, if there is such a one."""
    if notation not in NOTATIONS:
        raise ModelNameError(f'There is no notation called "{notation}"', hint=f"Notations are: {', '.join(NOTATIONS)}.")
    return notation


def joined_in(notation: str, modules: tuple[Module, ...]) -> str:
    """A word in a notation.

    >>> joined_in("plant-string", (Module("I"), Module("("), Module("A"), Module(")")))
    'I(A)'
    """
    texts = [str(module) for module in modules]
    return "".join(texts) if notation == "plant-string" else joined(texts)


def _head(system: LSystem) -> Iterator[str]:
    yield from map(str, system.constants)
    if system.alphabet:
        yield "alphabet: " + " ".join(system.alphabet)
    if system.angle != 90:
        yield f"angle: {number_text(system.angle)}"
    if system.heading != 90:
        yield f"heading: {number_text(system.heading)}"
    if system.steps is not None:
        yield f"steps: {system.steps}"
    if system.depth != 1:
        yield f"depth: {system.depth}"
    for keyword, symbols in (("ignore", system.ignored), ("consider", system.considered)):
        if symbols:
            yield f"{keyword}: {' '.join(symbols)}"


def _productions(system: LSystem, notation: str) -> Iterator[str]:
    for production in system.productions:
        yield (f"{production.predecessor} -> {joined_in(notation, tuple(flat(production.successor))) or 'ε'}"
               if notation == "plant-string" else str(production))
    yield from map(str, system.meta)
    for keyword, rules in (("decomposition", system.decomposition), ("interpretation", system.interpretation)):
        if rules:
            yield f"{keyword}:"
            yield from map(str, rules)


def _lacking(system: LSystem, notation: str) -> str | None:
    """The first thing that a system has and a notation lacks, in words."""
    rules = system.rules
    modules = [*system.axiom, *(m for rule in rules for m in rule.modules)]
    if notation == "abop":
        round_branches = any(module.symbol in "()" for module in modules)
        return "round brackets as branches" if round_branches else None
    if any(module.arguments for module in modules):
        return "parameters"
    if any(len(module.symbol) > 1 for module in modules):
        return "symbols of several letters"
    parts = {
        "conditions": any(rule.condition is not None for rule in rules),
        "contexts": any(rule.left or rule.right for rule in rules),
        "probabilities": any(rule.probability is not None for rule in rules),
        "repetition": any(isinstance(item, Repeat) for rule in rules for item in rule.successor),
        "constants": bool(system.constants), "decomposition rules": bool(system.decomposition), "meta-rules": bool(system.meta),
        "interpretation rules": bool(system.interpretation), "starting direction": system.heading != 90,
        "ignored symbols": bool(system.ignored or system.considered),
    }
    return next((name for name, there in parts.items() if there), None)
