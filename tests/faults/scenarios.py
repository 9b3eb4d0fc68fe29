"""What is broken off: how an object is made, and some work with it.

The same work with the same object must then give what it gives with a new one: a user goes on after Ctrl-C.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from lsys_kit import derive, draw, explore, growth, lineage, read, stages, system, timed
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.growth.growth import Growth
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.notation.model.system import LSystem


@dataclass(frozen=True)
class Scenario:
    """Some work with an object, which may be broken off at any line of some rooms.

    Attributes
    ----------
    make
        Makes the object.
    work
        The work, and what is then seen of the object.
    rooms
        The folders and files of the package in whose lines a fault is raised.
    """

    make: Callable[[], Any]
    work: Callable[[Any], object]
    rooms: tuple[str, ...]


def everything(derivation: Derivation, steps: int) -> object:
    """All that can be said of a derivation; its states by their modules, since they may be numbered in another order."""
    found = derivation.to(steps)
    modules = found.states.modules
    return (
        [str(word) for word in found],
        found.lengths,
        found.notes,
        [{modules[state]: count for state, count in found.counts(step).items()} for step in range(len(found))],
        [found.origins(step) for step in range(1, len(found))],
        [len(word.codes) for word in found],
        found.states.inexact,
        [str(word) for word in pickle.loads(pickle.dumps(found))],
    )


def derivation(
    model: str | LSystem, steps: int, seed: int = 1, rooms: tuple[str, ...] = ("derivation/",), **choices: object
) -> Scenario:
    """A derivation that is broken off while it is derived and looked at from all sides."""
    what = read(model) if isinstance(model, str) else model
    return Scenario(lambda: derive(what, 0, seed=seed, **choices), lambda start: everything(start, steps), rooms)


def answers(make: Callable[[], Any], ask: Callable[[Any], object], *rooms: str) -> Scenario:
    """An object that answers questions, and remembers what it knows."""
    return Scenario(make, ask, rooms)


def growing(found: Growth) -> object:
    return found.lengths(5), found.length(30), found.counts(40), found.recurrence, found.frequencies, repr(found)


def ageing(found: Timed) -> object:
    return [str(found.word(time)) for time in (0, Fraction(1, 2), 3, Fraction(9, 2))]


def panel(asked: Any) -> object:
    """What a panel shows when its sliders have been moved."""
    asked.step = 0
    asked.step = 3
    asked.settings = dict.fromkeys(asked.settings, 99)
    asked.mark = asked.model["book"]["net"]["names"][0]
    other = asked._book_for({"constants": asked.settings, "seed": 1})
    return asked.text, asked.settings, asked.model, other, asked.sight.picture.svg


SCENARIOS: Mapping[str, Scenario] = {
    "counting": derivation("axiom: A\nA -> A[+B]A\nB -> ε", 5),
    "new modules, in columns": derivation("axiom: A(1)\nA(x) -> A(2*x) A(2*x+1)", 8),
    "columns and the table": derivation("axiom: A(1) B\nA(x) : x < 90 -> A(2*x) A(2*x+1/3)\nA(x) -> A(1/(x-90))", 8),
    "doubles": derivation("axiom: A(1)\nA(x) -> A(2*x) A(x/3)", 7, arithmetic="float"),
    "outgrown": derivation("axiom: F(0)\nF(x) -> F(x^2 + 0.1)", 9),
    "decomposed": derivation("axiom: A(3)\nA(n) -> A(n+1) B(n)\ndecomposition:\nB(n) : n > 0 -> B(n-1) C", 4),
    "in context": derivation(
        "ignore: + -\naxiom: A + [B] A(1) - B A\nA < B -> A\nB > A(x) -> B + A\nA(x) -> A(x+1)[B]\nB < A > B -> B A\n+ -> + +",
        4,
    ),
    "chosen by chance": derivation("axiom: A B\nA -> A[B]A : 1/3\nA -> B : 2/3\nB < A -> A A : 1\nB -> A : 1\nB -> B A : 2", 6),
    "drawn by chance": derivation(
        "axiom: A(1) B\nA(x) -> A(uniform(0, 1)) B\nB < A(x) -> A(x) A(normal(x, 1))\nB -> B : 1\nB -> B B : 1", 5
    ),
    "two neighbours": derivation("axiom: A B C A B C\nA B < C -> C A\nA < B > C A -> A B\nA > [B] C -> A[B]C", 5),
    "cut and shortened": derivation("axiom: f(1) f(2) A\nA -> A f(1) f(2)[A % B]\nmeta: f(x) f(y) -> f(x+y)", 5),
    "shortened in context": derivation("axiom: f(1) f(2) A\nf(x) < A -> A f(1) f(2)[A]\nmeta: f(x) f(y) -> f(x+y)", 5),
    "with an unknown": derivation("k = 1\naxiom: A(k)\nA(x) -> A(x+k) B", 5, k="k"),
    "growth": answers(
        lambda: growth(read("k = 2\naxiom: A(0)\nA(t) : t < k -> A(t+1)\nA(t) -> A(0) B\nB -> B A(1)")), growing, "derivation/"
    ),
    "timed": answers(lambda: timed(read("axiom: a(0)\na(1) -> a(0) b(0)\nb(2) -> a(1/2)")), ageing, "derivation/"),
    "lineage": answers(lambda: derive(system("P6"), 0), lambda found: repr(lineage(found.to(4)).cells), "derivation/"),
    "stage diagram": answers(
        lambda: stages(system("J4")),
        lambda net: (str(net), net.places, [net.tokens(word) for word in derive(system("J4"), 5)]),
        "derivation/",
    ),
    "panel of cells": answers(lambda: explore("J4", 3), panel, "classroom/panel"),
    "panel of a plant": answers(lambda: explore("K5", 1), panel, "classroom/panel", "geometry/"),
    "panel in space": answers(lambda: explore("K19", 1), panel, "classroom/panel/view_model.py"),
    "picture": answers(
        lambda: draw(system("K5"), 2), lambda found: (found.svg, found.png, str(found)), "pictures/", "geometry/"
    ),
    "mesh": answers(lambda: draw(system("K19"), 3), lambda found: (repr(found.mesh), found.svg), "pictures/", "geometry/"),
    "topiary": derivation(read("axiom: F A ?P(0,0)\nA > ?P(x,y) : y < 3 -> F A"), 3, rooms=("worlds/", "derivation/")),
}
