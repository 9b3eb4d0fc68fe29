"""What repeats, grows or nests without end: models, one for each part of a model that can; words, texts and values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import count, repeat
from math import cos, inf, sin
from typing import Any

import numpy as np
import sympy

from lsys_kit import cellwork_system

CORNERS = " ".join(f"({place % 100 / 100:g}, {place / 3000:.3f})" for place in range(3_000))
"""The corners of a surface: many, and not convex."""
BOMBS: Mapping[str, str] = {
    "empty repetition": "axiom: A\nA -> repeat(1000,h)<repeat(1000,i)<repeat(1000,j)<repeat(1000,k)<repeat(0,l)<A>>>>>",
    "production": "axiom: A\nA -> repeat(100000,i)<repeat(100000,j)<A>>",
    "growing": "axiom: F\nF -> FFFFFFFFFF",
    "growing slowly": "axiom: F\nF -> F F",
    "ageing": "axiom: A(0)\nA(t) -> A(t+1) B(t)\nB(t) -> B(t+1)",
    "many states": "axiom: A(1,1)\nA(x,y) -> A(x+y,y) A(x,x+y)",
    "many real values": "axiom: A(1)\nA(x) -> A(sin(x)) A(sqrt(x+1))",
    "closure": "axiom: A(0)\nA(n) : n<900 -> A(n+1) repeat(100000,i)<repeat(40,j)<B>>",
    "many rules": "axiom: A(0)\nA(n) : n<900 -> A(n+1) B(n) B(n) B(n+1)\nB(n) : n>0 -> B(n-1) B(n-1)",
    "decomposition": "axiom: a(0)\ndecomposition:\na(n) : n<60 -> a(n+1) a(n+1)",
    "wide decomposition": "axiom: a\na -> a a\ndecomposition:\na -> repeat(5000,i)<b>\nb -> repeat(5000,i)<c>\n"
    "c -> repeat(5000,i)<d>",
    "interpretation": "axiom: a\na -> a a\ninterpretation:\na -> repeat(100000,i)<repeat(100000,j)<F>>",
    "nested interpretation": "axiom: a\na -> a\ndepth: 100\ninterpretation:\na -> a a",
    "interpretations": "axiom: A(0)\nA(n) -> A(n+1) B(n)\nB(n) -> B(n+1/7)\ninterpretation:\nB(n) -> repeat(100000,i)<F>",
    "cells": "axiom: a\na -> a a\ninterpretation:\na -> repeat(100000,i)<repeat(100000,j)<R(1,1)>>",
    "many cells": "axiom: a\na -> a a a\ninterpretation:\na -> R(1,1)",
    "lives": "axiom: a(0)\na(1/1000) -> a(0) a(0)",
    "lives in steps": "dt = 1\naxiom: a(0)\na(t) -> a(t+dt)\ndecomposition:\na(t) : t >= 1 -> a(t-1) a(t-1)",
    "meta": "axiom: f(1)\nf(x) -> f(x) f(x) g f(x) f(x)\nmeta: f(x) f(y) -> f(x+y)",
    "condition": "axiom: A(1)\nA(x) : (x+1)^20 > (x+2)^19 -> A(x+1/7) A(x+1/11)\nA(x) -> A(x+1/13) A(x+1/17)",
    "probability": "axiom: A(1)\nA(x) -> A(x+1/7) A(x+1/11) : (x+1)^20 / (x+2)^19\nA(x) -> A(x+1/13) A(x) : 1",
    "chance": "axiom: A\nA -> B(binomial(100000,1/2)) A A A",
    "branching at random": "axiom: A\nA -> A[A]A : 2\nA -> A A : 1",
    "constants": "c = 1\nd = c + 1\naxiom: A(c)\nA(x) -> A((x+c)*d) A(x*d) A(x-c)",
    "polynomials": "dt = 1\nc = 2\naxiom: A(dt,c)\nA(x,y) -> A((x+dt)*(y+c),(x+c)*(y+dt)) A(y,x)",
    "fractions": "dt = 1\nc = 2\naxiom: A(dt)\nA(x) -> A((x+dt)/(x+c)+x) A(x/(dt+c))",
    "roots": "dt = 1\naxiom: A(dt)\nA(x) -> A(sqrt(x+dt)+sin(x)) A(x^x)",
    "context": "axiom: A(0) A(1)\nA(x) < A(y) -> A(x+y) A(y+1) A(x)",
    "long context": "axiom: A A\nA A A A A A < A > A A A A A A -> A B A\nB -> A A",
    "branches": "axiom: A\nA -> [A][A][A]\nA < A > [A][A] -> A",
    "predecessors": "axiom: A A\nA A -> A A A A",
    "cuts": "axiom: A\nA -> A A [A % A]",
    "turtle": "axiom: A ?P(0,0)\nA -> [+F A][-F A] ?P(0,0)",
    "long strokes": "axiom: A\nA -> repeat(60000,i)<F|>",
    "few long strokes": "axiom: A\nA -> F|AA",
    "broad strokes": "axiom: A\nA -> !(90)F(1)A+(20)!(1)F(100)",
    "many widths": "axiom: A(1)\nA(x) -> !(x)F(1)+(20)A(x+1)A(x+2)",
    "polygons": "axiom: A\nA -> {.repeat(1000,i)<+(1)F.>}AA",
    "many polygons": "axiom: A\nA -> {.F.+(20)F.}AA",
    "nested polygons": "axiom: A\nA -> {.F.A.+F.}A",
    "surfaces": "axiom: A\nA -> ~L A +(7) A",
    "discs": "axiom: A\nA -> @O(2)F@o(3)AA",
    "nested brackets": "axiom: A\nA -> [A]F[A]",
    "space": "axiom: A\nA -> &(20)F[/(30)A][^(10)A]A",
    "tropism": "axiom: A\nA -> &(20)F$[/(30)A]A",
    "macros": "\n".join(
        [
            *(f"#define {new} {' '.join(old * 10)}" for old, new in zip("Fabcdefg", "abcdefgh", strict=True)),
            "Axiom: h",
            "F --> F",
        ]
    ),
    "jagged surface": f"axiom: A\nA -> ~L +(7) A A\nsurface L: {CORNERS}",
    "jagged surface in space": f"axiom: A\nA -> ~L &(7) A A\nsurface L: {CORNERS}",
    "jagged polygon": "axiom: A\nA -> {.repeat(3000,i)<+(90*i)F(1+i).>} &(7) A A",
    "many conditions": "axiom: A(1)\n" + "\n".join(f"A(x) : x > {k} && x*x > {k} -> A(x+1) B(x)" for k in range(900)),
    "a thousand rules": "axiom: A0\n" + "\n".join(f"A{k} -> A{k + 1} A{k // 2}" for k in range(990)),
    "long successor": f"axiom: A\nA -> {'A[+A]' * 8_000}",
    "long axiom": f"axiom: {'A[+A]' * 8_000}\nA -> A A",
    "long names": "axiom: N0\n".replace("N", "N" * 60)
    + "\n".join(f"N{k} -> N{k + 1} N0".replace("N", "N" * 60) for k in range(300)),
    "deep brackets": f"axiom: A\nA -> {'[' * 5_000}A{']' * 5_000}A",
    "deep repetition": f"axiom: A\nA -> {''.join(f'repeat(9,i{k})<' for k in range(40))}A{'>' * 40}",
    "deep expression": f"axiom: A(1)\nA(x) -> A({'(x+' * 45}1{')' * 45}) A(x+1)",
    "many parameters": f"axiom: A({','.join(['1'] * 16)})\n"
    + "A({0}) -> A({1}) A({0})".format(
        ",".join(f"x{k}" for k in range(16)), ",".join(f"x{k}+x{(k + 1) % 16}" for k in range(16))
    ),
    "huge numbers": "axiom: A(9)\nA(x) -> A(x*x) A(x+1) repeat(x,i)<B(x^i)>",
    "many constants": "\n".join(
        [*(f"c{k} = {k % 10} in 0 .. 9 by 1" for k in range(300)), "axiom: A(c1)", "A(x) -> A(x+c2) A(x*c3)"]
    ),
}
"""L-systems."""

MAPS: Mapping[str, str] = {
    "divisions": "map: A>A>A>A>\nA> -> A>[-A>]A>[+A<]A>[-A>]A>",
    "walls": "map: ABAB\nA -> ABA\nB -> BAB",
    "long walls": f"map: ABAB\nA -> {'AB' * 4_000}A\nB -> A",
    "markers": f"map: A>B>A>B>\nA> -> {'A>[+C>][-D>]' * 800}A>\nB> -> B>[+A>][-A<]A>",
    "dividing cells": "map: ABAB\nA -> B[-A][+A]B\nB -> A",
    "many corners": f"map: {'AB' * 8_000}\nA -> B[-A][+A]B\nB -> A",
    "resting map": "map: ABAB\nA -> A\nB -> B",
}
"""Map systems."""

CELLWORKS: Mapping[str, str] = {
    "growing cells": str(cellwork_system("K33")),
    "many walls": str(cellwork_system("K33")).replace("steps: 4", "steps: 1000000"),
    "growing edges": str(cellwork_system("K33")).replace("Q: * -> P", "Q: * -> P Q P").replace("R: * -> Q", "R: * -> Q R Q"),
}
"""Cellwork systems."""

WORDS: Mapping[str, Callable[[], Any]] = {
    "endless words": lambda: repeat("ab"),
    "endless letters": lambda: ["ab", (f"a{number}" for number in count())],
    "a range of words": lambda: range(10**12),
    "a range as a word": lambda: [range(10**12)] * 2,
    "many words": lambda: ["a"] * 10**6,
    "long words": lambda: ["a" * 10**6, "ab" * 10**6],
    "long different words": lambda: [" ".join(f"s{place * place % 977}" for place in range(30_000))] * 3,
    "ignored symbols": lambda: [f"a{'+' * 24_000}b"] * 3,
    "lines of ignored symbols": lambda: [f"{'a+' * 12_000}b{'+-' * step}" for step in range(4)],
    "words of long names": lambda: [" ".join(f"{'x' * 900}{place % 7}" for place in range(9_000))] * 3,
    "long numbers": lambda: [f"a({'9' * 100_000})", f"a({'8' * 100_000}) b"],
    "words in brackets": lambda: ["[" * 40_000 + "a" + "]" * 40_000] * 2,
    "unclear words": lambda: ["abcdefgh", "a" * 3_000, "a" * 9_000],
    "branched words": lambda: ["F" + "[+F]" * 9_000, "F" + "[+F]" * 19_000],
    "endless strokes": lambda: repeat([(0, 0, 0, 1)]),
    "many strokes": lambda: [[(x, y, x, y + 1) for x in range(99)] for y in range(99)],
    "strokes everywhere": lambda: [[(0, 0, cos(angle), sin(angle)) for angle in range(1, 2_000 * step)] for step in (1, 2)],
}
"""What rules are looked for in."""

TEXTS: Mapping[str, str] = {
    "letters": "a" * 999_000,
    "lines of letters": f"{'a' * 40_000}\n" * 24,
    "blanks": " " * 999_000,
    "empty lines": "\n" * 999_000,
    "digits": "9" * 49_000,
    "axiom of digits": f"axiom: A({'9' * 1_900})\nA(x) -> A(x*x)",
    "many digits": "9 " * 24_000,
    "opened": "(" * 49_000,
    "opened branches": "axiom: " + "[" * 49_000,
    "closed": ")" * 49_000,
    "quotes": '"' * 49_000,
    "arrows": "-> " * 16_000,
    "commas": "," * 49_000,
    "braces": "{" * 49_000,
    "comments": "/*" * 400_000,
    "signs": "+-" * 24_000,
    "statements": "A -> B\n" * 140_000,
    "axioms": "axiom: A\n" * 100_000,
    "empty macros": "#define A B\n" * 80_000,
    "constants alone": "\n".join(f"c{number} = {number}" for number in range(60_000)),
    "axiom of powers": "axiom: A(" + "9^" * 900 + "9)",
    "factorials": f"axiom: A({'factorial(' * 40}9{')' * 40})",
    "exponents": "axiom: A(1e999999999999)",
    "names": f"axiom: {'n' * 40_000}",
    "markup": "<a>" * 300_000,
    "braces and brackets": "{[(" * 16_000,
    "rows": "1 2 3\n" * 160_000,
    "points": "0 0 0 0 0 1 0 1 0 0 1 1\n" * 40_000,
    "map of walls": f"map: {'AB' * 24_000}\n{'A -> AB' * 9}",
    "far text": "\U000f0000" * 400_000,
    "link": "#lsys=" + "a" * 900_000,
    "broken link": "#lsys=" + "aS0zKBwA" * 90_000,
    "surrogates": "\ud800" * 400_000,
}
"""Texts of about the size that is read, and of a line."""

VALUES: Mapping[str, Callable[[], Any]] = {
    "a billion": lambda: 10**9,
    "five thousand digits": lambda: 10**5_000,
    "a negative one": lambda: -(10**5_000),
    "a fraction": lambda: Fraction(10**5_000 + 1, 7),
    "greatest double": lambda: 1.7e308,
    "least double": lambda: 5e-324,
    "infinity": lambda: inf,
    "a million digits": lambda: "9" * 10**6,
    "an exponent": lambda: "1e999999999",
    "nested powers": lambda: "9^9^9^9^9",
    "ten million letters": lambda: "a" * 10**7,
    "a range": lambda: range(10**12),
    "without end": lambda: count(),
    "the same": lambda: repeat("a"),
    "a long list": lambda: [0] * 10**7,
    "a list of lists": lambda: [[0] * 1_000] * 1_000,
    "nested lists": lambda: nested(50_000),
    "bytes": lambda: b"a" * 10**7,
    "a mapping": lambda: {f"a{number}": number for number in range(10**6)},
    "two billions": lambda: (10**9, 10**9),
    "a set": lambda: {*range(10**6)},
    "an array": lambda: np.zeros((10**4, 10**3)),
    "a mapping of ranges": lambda: {"c": range(10**12)},
    "a mapping without end": lambda: {"c": count()},
    "a mapping of digits": lambda: {"c": "9" * 10**6},
    "an expression": lambda: sympy.Symbol("x") ** 10**9,
}
"""Values of any argument: made anew each time, since some are used up."""


def nested(depth: int) -> list[Any]:
    """Lists within lists."""
    found: list[Any] = []
    for _ in range(depth):
        found = [found]
    return found
