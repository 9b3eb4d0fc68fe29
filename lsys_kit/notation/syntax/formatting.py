"""A system as lines of text: what is set first, the axiom, then rules by sections; what the notations have in common."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction

from lsys_kit.notation.model.arithmetic import literal_text
from lsys_kit.notation.model.modules import OPENING, Repeat
from lsys_kit.notation.model.system import ANY_BRANCH, FLAT, LOOK, NEXT_BRANCH, LSystem

OWN_NOTATION = "abop"
"""The dialect of turtle commands, and of the notation, that is meant where nothing is said."""


_SETTINGS = (
    "angle",
    "heading",
    "length",
    "steps",
    "seed",
    "decomposition_depth",
    "depth",
    "ignored",
    "considered",
    "branches",
    "field",
    *LOOK,
)
_KEYWORDS = {"decomposition_depth": "decomposition depth", "ignored": "ignore", "considered": "consider"}
"""The keywords of settings that have another name in the record."""


def settings(system: LSystem, turtle: str = OWN_NOTATION) -> Iterator[str]:
    """The lines of settings, given the notation's own tradition of turtle commands."""
    yield from (f"{name}: {text}" for name, text in unusual(system, "alphabet"))
    if system.turtle != turtle:
        yield f"turtle: {system.turtle}"
    yield from (f"{_KEYWORDS.get(name, name)}: {text}" for name, text in unusual(system, *_SETTINGS))


def unusual(system: LSystem, *names: str) -> Iterator[tuple[str, str]]:
    """Those of some attributes of a system that are not as usual, with their texts.

    >>> from lsys_kit.notation.read import read
    >>> [*unusual(read("axiom: F\\nangle: 22.5\\ncolours: natural"), "angle", "length", "colours")]
    [('angle', '22.5'), ('colours', 'natural')]
    """
    for name in names:
        value = getattr(system, name)
        if value != getattr(LSystem, name):
            exact = isinstance(value, Fraction | float)
            yield name, literal_text(value) if exact else " ".join(value) if isinstance(value, tuple) else str(value)


def sections(system: LSystem, rule: Callable[[object], str]) -> Iterator[str]:
    """The lines of all rules, each written by a function."""
    yield from map(rule, system.productions)
    yield from map(rule, system.meta)
    for keyword, rules in (("decomposition", system.decomposition), ("interpretation", system.interpretation)):
        if rules:
            yield f"{keyword}:"
            yield from map(rule, rules)


def first_missing(system: LSystem, *names: str) -> str | None:
    """The first of some features that a system has, in words.

    >>> from lsys_kit.notation.read import read
    >>> first_missing(read("axiom: A(1)\\nA(t) : t < 3 -> B"), "contexts", "conditions", "parameters")
    'conditions'
    """
    return next((name for name in names if FEATURES[name](system)), None)


FEATURES: dict[str, Callable[[LSystem], bool]] = {
    "parameters": lambda s: any(m.arguments for m in s.modules),
    "symbols of several letters": lambda s: any(len(m.symbol) > 1 for m in s.modules),
    "round brackets as branches": lambda s: any(m.symbol in "()" for m in s.modules),
    "conditions": lambda s: any(rule.condition is not None for rule in s.rules),
    "contexts": lambda s: any(rule.left or rule.right for rule in s.rules),
    "predecessors of several modules": lambda s: any(len(rule.predecessors) > 1 for rule in s.rules),
    "probabilities": lambda s: any(rule.probability is not None for rule in s.rules),
    "repetition": lambda s: any(isinstance(item, Repeat) for rule in s.rules for item in rule.successor),
    "constants": lambda s: bool(s.constants),
    "decomposition rules": lambda s: bool(s.decomposition),
    "meta-rules": lambda s: bool(s.meta),
    "interpretation rules": lambda s: bool(s.interpretation),
    "field": lambda s: s.field is not None,
    "starting direction": lambda s: s.heading != 90,
    "ignored symbols": lambda s: bool(s.ignored or s.considered),
    "right contexts that name the next branch": lambda s: s.branches == NEXT_BRANCH,
    "right contexts that pass over brackets": lambda s: s.branches == FLAT,
    "right contexts that name any branch": lambda s: (
        s.branches == ANY_BRANCH and any(module.symbol in OPENING for rule in s.productions for module in rule.right)
    ),
}
"""What a system may need, and whether it does."""
