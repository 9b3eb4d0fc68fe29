"""Short texts in formats of other programs, with the line that gives each away."""

from __future__ import annotations

RACKET = "a model in Racket's language lindenmayer"
RACKET_PROGRAM = "a program in Racket"
AUTOMATON = "an automaton or a grammar of JFLAP, and no L-system"
XL = "a model in XL, the language of GroIMP"
LPFG = "a model of lpfg, in the language L+C"
EXPLORER = "a model of the L-system Explorer by Lowclouds"
VIEW = "a file that goes with a model of cpfg, and says how it is seen or animated"
PGF = "an L-system of PGF, for TikZ"
GRAMMAR = "a grammar of a formal language, and no L-system"
NUMBERS = "a table of numbers, as of an iterated function system, and no L-system"
FORMULA = "a formula of Fractint, and no L-system"
CELLULAR = "a rule of a cellular automaton, and no L-system"
NOTEBOOK = "a Jupyter notebook"
SVG = "a picture as SVG"
HTML = "a page as HTML"
XML = "XML"
RTF = "a document as RTF"
PROGRAM = "a program, as in JavaScript, Processing, Java or C++"
PYTHON = "a program in Python"
LISP = "a program in Lisp"
RUST = "a program in Rust, Go or Swift"
GRAPH = "a drawing of a graph, as for Graphviz or Mermaid"
YAML = "data as YAML"
MARKDOWN = "a text as Markdown"
MALSYS = "a model of Malsys"
JSON = "data as JSON, or a dictionary"

FOREIGN: dict[str, list[tuple[str, int]]] = {
    MALSYS: [
        ("lsystem Koch {\n\tset symbols axiom = F;\n\tset iterations = 5;\n\trewrite F to F + F - - F + F;\n}\n", 1),
        ("lsystem Tree extends Plants {\n  set symbols axiom = X;\n  rewrite X to F [ + X ] X;\n  rewrite F to F F;\n}", 1),
        ("\nlsystem Algae {\nset symbols axiom = A;\nrewrite A to A B;\nrewrite B to A;\n}", 2),
        ("/* a curve */\nlsystem Dragon {\n  interpret F as DrawForward(8);\n  rewrite X to X + Y F;\n}", 2),
        ("lsystem Cond(n = 3) {\n  rewrite A(x) where x < n to F(x) A(x + 1);\n  process all with SvgRenderer;\n}", 1),
    ],
    RACKET: [
        ("#lang lindenmayer racket\n\n## axiom ##\nF\n\n## rules ##\nF -> F+F\n\n## variables ##\nn=3\n", 1),
        ("#lang lindenmayer racket\n## axiom ##\nA(1)\n## rules ##\nA(x) : x < 3 -> F(x) A(x+1)\n## variables ##\nn=5\n", 1),
        ("\n\n#lang lindenmayer\n## axiom ##\nTS\n## rules ##\nT → F\nS → [+S]T\n", 3),
        ("#lang  lindenmayer racket\n## axiom ##\nX\n## rules ##\nX -> F-[[X]+X]\n========\n(provide (all-defined-out))\n", 1),
        ("/* a tree */\n#lang lindenmayer racket\n## axiom ##\nF\n", 2),
    ],
    RACKET_PROGRAM: [
        ("#lang racket\n(define (F x) (list x x))\n", 1),
        ("#lang racket/base\n(require graphics/turtles)\n", 1),
        ("#lang typed/racket\n(: axiom String)\n", 1),
        ("\n#lang slideshow\n(circle 10)\n", 2),
        ("#lang scheme\n(define axiom 'F)\n", 1),
    ],
    AUTOMATON: [
        ('<?xml version="1.0"?>\n<structure>\n<type>fa</type>\n<automaton>\n<state id="0"/>\n</automaton>\n</structure>', 3),
        ("<structure><type>grammar</type><production><left>S</left><right>aS</right></production></structure>", 1),
        ("<structure>\n  <type>pda</type>\n</structure>", 2),
        ("<structure>\n  <type>turing</type>\n</structure>", 2),
        ("<structure>\n\t<type>re</type>\n\t<expression>(a+b)*</expression>\n</structure>", 2),
    ],
    GRAMMAR: [
        ("S → aSb | ε\nA → aA | b\n", 1),
        ("The language a^n b^n:\nS -> a S b | ε\n", 2),
        ("S → ε | aS\n", 1),
        ("<expression> ::= <term> | <term> + <expression>\n<term> ::= x\n", 1),
        ("G = ({S}, {a, b}, P, S)\nS → bS | λ\n", 2),
    ],
    FORMULA: [
        ("Square(XAXIS) {\n  z = pixel:\n  z = z*z + pixel\n  |z| <= 4\n}\n", 1),
        ("Cube {; of third order\n  z = 0, c = pixel:\n   z = z*z*z + c\n   |z| < 16\n  }\n", 1),
        ("; two formulas\nA-1 (ORIGIN) {\n  z = p1:\n  z = sin(z)\n  |imag(z)| <= 50.5\n}\n", 2),
        ("Newton3 {\n z = pixel:\n  z = z - (z^3-1)/(3*z^2)\n  |z*z - 1| < 4\n}\n", 1),
        ("\nMoon(XYAXIS) {\n  z=0:\n  z=z^2+c,\n  |z|<=2\n}\n", 2),
    ],
    CELLULAR: [
        ("Rule 90\ncurrent pattern\t111\t110\t101\nnew state for center cell\t0\t1\t0\n", 2),
        ("current pattern 111 110 101 100\nnew state 0 0 0 1\n", 1),
        ("Current state: 111 110\nnew state: 0 1\n", 1),
        ("old state\t000\t001\nnew cell\t1\t0\n", 1),
        ("Sierpinski, again\n current pattern 11 10 01 00\n new state for right cell 0 1 1 0\n", 2),
    ],
    NUMBERS: [
        ("Barnsley fern\nw\ta\tb\tc\td\te\tf\tp\nƒ1\t0\t0\t0\t0.16\t0\t0\t0.01\n", 3),
        ("ƒ3\t0.20\t−0.26\t0.23\t0.22\t0\t1.60\t0.07\n", 1),
        ("fern {\n 0 0 0 .16 0 0 .01\n .85 .04 -.04 .85 0 1.6 .85\n}\n", 2),
        ("a, b, c, d, e, f\n0.5, 0, 0, 0.5, 0, 0\n0.5, 0, 0, 0.5, 0.5, 0\n", 2),
        ("| 0.5 | 0 | 0 | 0.5 | 1 | 0 | 0.33 |\n", 1),
    ],
    XL: [
        ("module A(float len) extends Sphere(0.1);\nprotected void init ()\n[\n\tAxiom ==> A(1);\n]\n", 1),
        ("protected void init() [\n  Axiom ==> F(1) L;\n]\npublic void run() [\n  L ==> F(0.5) [RU(30) L] L;\n]\n", 1),
        ("import de.grogra.rgg.*;\nmodule Bud;\n", 1),
        ("/* trees */\nmodule Tree(super.length) extends F;\npublic void grow()\n[\n  t:Tree ==>> t F(1);\n]\n", 2),
        ("protected void init () {\n  [ Axiom ==> F(1); ]\n}\n", 1),
        ("public void run ()\n[\n  x:F(l), (l > 1) ==> F(l/2) F(l/2);\n]\n", 1),
        ("const float ANGLE = 30;\nmodule Meristem(int order) extends Sphere;\nprivate void grow() {\n}\n", 2),
    ],
    LPFG: [
        ("#include <lpfgall.h>\nderivation length: 7;\nmodule A(float);\nAxiom: A(1);\nA(x) :\n{\n produce A(x+1);\n}\n", 1),
        ("#define N 3\nmodule B(int);\nderivation length: N;\nAxiom: B(0);\n", 2),
        ("derivation length: 20;\nStart: { n = 0; }\nAxiom: SetWidth(1) A();\n", 1),
        ("Axiom: A(1);\nA(x) :\n{\n  if (x < 3) produce F(x) A(x+1);\n}\nmodule A(float);\n", 6),
        ('#include "lpfgall.h"\nconst int n = 5;\nmodule Apex();\n', 1),
        ("module S(struct_data);\nignore: Right Left;\ninterpretation:\nS(d) :\n{\n  nproduce F(d.l);\n}\n", 1),
    ],
    EXPLORER: [
        ("/* a leaf */\nD=0\nR=2\nstemsize=1.5\nderivation length: 8\naxiom: A(0)\nP1: A(d) : d>0 -> A(d-1)\n", 4),
        ("derivation length: 4\ndelta=22.5\naxiom: F\np1: F -> FF-[-F+F+F]\n", 2),
        ("lsystem: 1\nderivation length: 5\naxiom: A\np1: A -> B(a1[1])\np2: B(x) -> *\n", 4),
        ("#define R 1.5\nstemsize=0.1\nderivation length: 12\naxiom: A\nF(s) -> F(s*R)\n", 2),
        ("view = {auto: 'z'}\nderivation length: 4\naxiom: A(1)\nA(t) : t <= 10 -> F(t)^(60)A(t+1)\n", 1),
        ("step=2\nderivation length: 3\naxiom: A\nA -> B{C}\n", 1),
    ],
    VIEW: [
        ("angle factor: 14\nscale factor: 0.8\nprojection: parallel\n", 1),
        ("initial color: 2\nz range: -10 10\n", 1),
        ("swap interval: 5\nfirst frame: 0\nlast frame: 20\n", 1),
        ("/* how it is seen */\nfront distance: -1000\nback distance: 1000\n", 2),
        ("projection: parallel\nline style: polygon\ninitial line width: 3 pixels\n", 2),
    ],
    PGF: [
        ("\\pgfdeclarelindenmayersystem{Koch}{\n  \\rule{F -> F-F++F-F}\n  \\rule{G -> GG}\n}\n", 1),
        ("\\documentclass{article}\n\\begin{document}\n\\tikz \\draw [lindenmayer system={Koch, axiom=F, order=3}];", 3),
        ("\\usetikzlibrary{lindenmayersystems}\n\\pgfdeclarelindenmayersystem{Tree}{\\rule{A -> F[+A]}}\n", 2),
        ("\\begin{tikzpicture}\n\\draw [l-system={rule set={F -> FF, G -> G}}, lindenmayer system={order=2}] l-system;\n", 2),
        ("  \\pgfdeclarelindenmayersystem{Cantor}{\\symbol{f}{\\pgflsystemmoveforward}\\rule{F -> FfF}}\n", 1),
    ],
    NOTEBOOK: [
        ('{\n "cells": [\n  {\n   "cell_type": "code"\n  }\n ]\n}', 2),
        ('{"cells": [], "nbformat": 4}', 1),
        ('{\n "metadata": {},\n "nbformat": 4,\n "nbformat_minor": 5,\n "cells": []\n}', 3),
        ('{\n\t"cells" : []\n}', 2),
        ('{ "cells": [{"source": ["axiom: A\\n", "A -> A B"]}]}', 1),
    ],
    SVG: [
        ('<svg xmlns="http://www.w3.org/2000/svg">\n</svg>', 1),
        ('<?xml version="1.0"?>\n<svg width="3"></svg>', 2),
        ('<?xml version="1.0"?><svg></svg>', 1),
        ("\n\n<svg>", 3),
        ("<!-- a tree -->\n  <svg\n  viewBox='0 0 1 1'/>", 2),
    ],
    HTML: [
        ("<!DOCTYPE html>\n<html><body>axiom: A</body></html>", 1),
        ("<html>\n<pre>axiom: F</pre>\n</html>", 1),
        ("<div class='x'>axiom: F</div>", 1),
        ("<p>axiom: A</p>\n<p>and so on</p>", 1),
        ("<!doctype html>\n<script>let a = 3;</script>", 1),
    ],
    XML: [
        ('<?xml version="1.0"?>\n<lsystem axiom="F"/>', 1),
        ('<?xml version="1.0" encoding="UTF-8"?>\n<pnml></pnml>', 1),
        ("<?xml version='1.1'?>\n<rules><rule>F</rule></rules>", 1),
        ('\n<?xml version="1.0"?>\n<a/>', 2),
        ('<?xml version="1.0"?><inkscape-extension><param name="axiom">F</param></inkscape-extension>', 1),
    ],
    RTF: [
        ("{\\rtf1\\ansi axiom: A\\par A -> AB}", 1),
        ("{\\rtf1 axiom: F}", 1),
        ("{\\rtf1\\mac\n\\f0 axiom: A\\\n}", 1),
        ("\n{\\rtf1\\deff0 A -> B}", 2),
        (" {\\rtf1{\\fonttbl}axiom: A}", 1),
    ],
    PROGRAM: [
        ('const axiom = "F";\nconst rules = make();\n', 1),
        ('var axiom = "A";\nfunction setup() {\n}\n', 1),
        ('String axiom = "F";\nvoid setup() {\n  size(400, 400);\n}\n', 1),
        ("#include <iostream>\nusing namespace std;\nint main() {\n}\n", 2),
        ("public class Tree extends Plant {\n  word = 3;\n}\n", 1),
        ("function draw() {\n  turtle(word);\n}\n", 1),
    ],
    PYTHON: [
        ('import turtle\naxiom = "F"\n', 1),
        ('rules = {"F": "F+F--F+F", "G": "GG"}\n', 1),
        ("def rewrite(word):\n    return word\n", 1),
        ("from lsys_kit import read\nread('axiom: A')\n", 1),
        ("#!/usr/bin/env python3\nprint('F')\n", 1),
        ("try:\n  depth = 5\nexcept ImportError:\n  depth = 3\n", 1),
        ("word = A\nfor step in range(5):\n  word += word\n", 2),
        ('axiom = "A"\nclass Plant:\n    pass\n', 2),
    ],
    YAML: [
        ("title: Koch\nrules:\n  F: F+F\n  G: GG\nangle: 60\n", 2),
        ("rules:\n- A: AB\n- B: A\n", 1),
        ('title: "X"\nrules:\n  "X": "F[+X]"\n  "F": "FF"\n', 2),
        ("name: Koch\nrules:\n    'F': 'F+F--F+F'\n    'G': 'GG'\n", 2),
        ("# the dragon\nangle: 90\nrules:\n  X: X+YF+\n  Y: -FX-Y\n", 3),
    ],
    LISP: [
        ('(defparameter *axiom* "F")\n(defparameter *rules* nil)', 1),
        ("; Koch\n(defun rewrite (word)\n  (mapcan #'rule word))", 2),
        ('(define axiom "F")\n(define (rule c) c)', 1),
        ("(let ((word 'F))\n  (print word))", 1),
        ('(def rules {"F" "F+F"})', 1),
    ],
    RUST: [
        ("fn main() -> Result<(), Error> {\n    println!();\n}", 1),
        ("pub fn rewrite(word: &str) -> String {\n    word.chars()\n}", 1),
        ("package main\n\nfunc rewrite(word string) string {\n\treturn word\n}", 3),
        ("// Koch\nlet mut word = String::new();\nword.push(c);", 2),
        ("func rule(_ c: Character) -> String {\n  return c\n}", 1),
    ],
    GRAPH: [
        ("digraph G { A -> B; B -> C; C -> A; }", 1),
        ("strict digraph {\n  A -> B\n}", 1),
        ("graph LR\n  A --> B\n  A[Start] --> D{Decision}", 1),
        ("%% a flow\nflowchart TD\n  A --> B{x}", 2),
        ("sequenceDiagram\n  Anna->>Bob: Hello", 1),
    ],
    MARKDOWN: [
        ("# Koch\n\n```\naxiom: F\n```\n", 3),
        ("```lsystem\naxiom: A\nF\n```\nIt grows, and grows.", 1),
        ("The bush, drawn below\n```\naxiom: F\n```\n", 2),
        ("```\naxiom: A\n```\n## Next\n", 1),
        ("> A system\n\n  ```\n  axiom: A\n  ```\n", 3),
    ],
    JSON: [
        ('{"axiom": "F", "rules": {}}', 1),
        ('[\n {"angle": 60}\n]', 2),
        ("{\n  'F': 'F+F',\n  'G': 'GG',\n}", 2),
        ('{\n  "name": "Koch"\n}', 2),
        ('"axiom": "F",\n"rules": []', 1),
    ],
}
"""At least five texts in each format, and the line at which each is recognised."""

MENTIONS = [
    "/* from openalea import lpy */\naxiom: A\nA -> A B",
    "/* <!DOCTYPE html> */\naxiom: A\nA -> B C",
    "axiom: import\nimport -> import def",
    "axiom: produce\nproduce -> produce(1)\nproduce(n) -> module",
    "axiom: class\nclass -> def",
    "axiom: A\nA -> print\nprint -> A",
    "delta = 3\nstep = 2\naxiom: A(delta)\nA(x) -> A(x + step)",
    "var = 2\naxiom: A(var)\nA(x) -> F(x)",
    "axiom: premise\npremise -> premise A",
    "Axiom: A\n/*\nproduction:\n*/\nA --> A[+A]B",
    "Lsystem: 1\nderivation length: 3\nproduction:\nAxiom: A\nA --> AB\nendlsystem",
    "Axiom: A\nendlsystem",
    "rules = 3\naxiom: A(rules)\nA(x) -> B(x)",
    "axiom: A\nproductions:\nA -> A B",
    "derivation length: 3\nAxiom: F\nF --> F[+F]F",
    "#define import 3\nAxiom: A(import)\nA(x) --> B(x)",
    'axiom = AXIOM[a[1]];\nskipPattern = {"b", "c"};\nlrules = LRULES[LRule[LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[i+1]]]];',
    "angle: 30\nsteps: 5\nrecursion = 3\naxiom: A(recursion)\nA(x) -> F(x)",
    "alphabet: 1 2 3\naxiom: 1\n1 -> 2\n2 -> 3",
    "From: a friend\nimport it\ncomment {\nclass {\n}\nKoch {\nAngle 6\nAxiom F\nF=F+F\n}",
]
"""Texts of the kit's notations that speak of such things, or look like them."""
