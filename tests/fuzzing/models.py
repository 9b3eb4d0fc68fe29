"""Models that repeat, grow or nest without end, one for each part of a model that can."""

from __future__ import annotations

from collections.abc import Mapping

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
    "macros": "\n".join([*(f"#define {new} {' '.join(old * 10)}" for old, new in zip("Fabcdefg", "abcdefgh", strict=True)),
                         "Axiom: h", "F --> F"]),
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
