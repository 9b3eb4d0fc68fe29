"""Systems on pages, in programs and in files of other programs: whatever the wording, the same system is read.

Every plain system of the catalogue is written in each format with random names, order, arrows, blanks and typography, and reads
back as the same system.
"""

from __future__ import annotations

import contextlib
import json
import random
import re
from dataclasses import replace
from xml.sax.saxutils import escape, quoteattr

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.formats.found import tables
from lsys_kit.notation.formats.literals import systems_in_literals
from lsys_kit.notation.formats.reading import FORMATS, LONGEST, read_as, read_found, what_is_missing
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.notation.syntax.text.typography import keyboard_signs
from tests.timing import spent

KOCH = read("angle: 60\naxiom: F++F++F\nF -> F-F++F-F")
PLANT = read("angle: 25\naxiom: X\nX -> F+[[X]-X]-F[-F X]+X\nF -> F F")


def is_plain(model: LSystem) -> bool:
    """Whether a system has single letters, without values, contexts, conditions and chance, and nothing else."""
    plain = LSystem(model.axiom, model.productions, angle=model.angle, turtle=model.turtle)
    symbols = [module for rule in model.productions for module in (*rule.predecessors, *flat(rule.successor))]
    return (
        model.turtle == "abop"
        and plain.productions == model.productions
        and not (
            model.constants or model.interpretation or model.decomposition or model.meta or model.ignored or model.considered
        )
        and all(re.fullmatch(r"[A-Za-z+\-&^/\\|\[\]]", each.symbol) and not each.arguments for each in (*symbols, *model.axiom))
        and all(
            len(rule.predecessors) == 1
            and rule.predecessor.symbol.isalpha()
            and rule.successor
            and not (rule.left or rule.right or rule.condition or rule.probability)
            and len([*flat(rule.successor)]) == len(rule.successor)
            for rule in model.productions
        )
        and bool(model.productions)
    )


PLAIN = sorted(id for id in systems() if is_plain(system(id)))
"""The systems of the catalogue that a list of variables and rules can hold."""
NO_HEADINGS = frozenset(("base", "root", "init", "homomorphism"))
"""Names with other meanings on a line of their own: under "homomorphism" are rules of interpretation."""


def word(modules) -> str:
    return "".join(module.symbol for module in modules)


def same(found: LSystem, meant: LSystem) -> bool:
    """Whether words, rules and the angle are the same."""
    return (found.axiom, found.productions, found.angle) == (meant.axiom, meant.productions, meant.angle)


@st.composite
def listed(draw: st.DrawFn, meant: LSystem) -> str:
    """A list of a system, as some page might have it."""
    names = tables()["names"]

    def name(kind: str) -> str:
        written = draw(st.sampled_from([each for each in names[kind] if len(each) > 3 and each not in NO_HEADINGS]))
        return draw(st.sampled_from([written, written.capitalize(), written.upper()]))

    gap = draw(st.sampled_from(["", " ", "  "]))
    sign = draw(st.sampled_from([":", " :", " = ", ": ", "："]))
    arrow = draw(st.sampled_from(["→", "->", "-->", "=>", "⟶", "↦", "&rarr;", " \\to ", "–>"]))
    angle = str(float(meant.angle))
    rules = [f"{rule.predecessor.symbol}{gap}{arrow}{gap}{word(rule.successor)}" for rule in meant.productions]
    layout = draw(st.sampled_from(["parentheses", "lines", "bullets", "semicolons"]))
    rule = name("rules")
    if layout == "parentheses":
        shown = f"{rule}{sign}{', '.join(f'({each})' for each in rules)}"
    elif layout == "semicolons":
        shown = f"{rule}{sign}{'; '.join(rules)}"
    elif layout == "bullets":
        shown = f"{rule}:\n" + "\n".join(f"• {each}" for each in rules)
    else:
        shown = f"{rule}:\n" + "\n".join(f"   {each}" for each in rules)
    unit = draw(st.sampled_from(["", "°", " degrees", "º", "˚", "◦", " deg"]))
    written = angle.replace(".", ",") if draw(st.booleans()) and unit else angle
    parts = draw(
        st.permutations([f"{name('axiom')}{sign}{gap}{word(meant.axiom)}", shown, f"{name('angle')}{sign}{written}{unit}"])
    )
    around = draw(st.sampled_from(["", "Here is a curve that somebody found.\n\n", "Example 3\n\n"]))
    text = around + "\n".join(parts) + draw(st.sampled_from(["", "\n\nDraw it four times, and look at it again."]))
    if draw(st.booleans()):
        text = re.sub(r"(?<=[A-Za-z\]\[+→;])-(?![->])", "−", text)
    return text.replace("\n", "\r\n") if draw(st.booleans()) else text


@st.composite
def plain_systems(draw: st.DrawFn) -> LSystem:
    """A system of single letters with turns and branches."""
    letters = draw(st.lists(st.sampled_from("FXYABG"), min_size=1, max_size=3, unique=True))

    def some_word() -> str:
        parts = st.sampled_from([*letters, "F", "+F", "-F", "--", "[+F]", "[-X]", "+", f"[{letters[0]}]{letters[-1]}"])
        return "".join(draw(st.lists(parts, min_size=1, max_size=6)))

    first = draw(st.sampled_from(letters)) + draw(st.sampled_from(["", "+F", "--F", "[+X]F"]))
    rules = "".join(f"{letter} -> {' '.join(letter + some_word())}\n" for letter in letters)
    return read(
        f"angle: {draw(st.sampled_from(['60', '22.5', '25.7', '90', '36']))}\naxiom: {' '.join(first)}\n{rules}", "abop"
    )


@pytest.mark.parametrize("id", PLAIN)
@given(data=st.data())
def test_a_system_is_read_from_any_list_of_it(id: str, data: st.DataObject) -> None:
    meant = system(id)
    text = data.draw(listed(meant))
    assert same(read(text), meant), text


@st.composite
def as_data(draw: st.DrawFn, meant: LSystem) -> str:
    """The literals of a system in some language."""
    quote = draw(st.sampled_from(['"', "'"]))

    def text(said: str) -> str:
        return quote + said.replace("\\", "\\\\") + quote

    pairs = [(rule.predecessor.symbol, word(rule.successor)) for rule in meant.productions]
    axiom, angle = word(meant.axiom), float(meant.angle)
    kind = draw(st.sampled_from(["json", "pairs", "objects", "arrows", "assignments", "calls"]))
    first, second = draw(st.sampled_from([("from", "to"), ("predecessor", "successor"), ("before", "after"), ("lhs", "rhs")]))
    dictionary = "{" + ", ".join(f"{text(a)}: {text(b)}" for a, b in pairs) + "}"
    if kind == "json":
        shown = json.dumps({"axiom": axiom, "rules": dict(pairs), "angle": angle}, indent=draw(st.sampled_from([None, 1, 4])))
        return (
            shown if len(dict(pairs)) == len(pairs) else f'{{"axiom": {text(axiom)}, "angle": {angle}, "rules": {dictionary}}}'
        )
    if kind == "pairs":
        return f"axiom = {text(axiom)}\nangle = {angle}\nrules = [{', '.join(f'({text(a)}, {text(b)})' for a, b in pairs)}]"
    if kind == "objects":
        objects = ",\n".join(f"{{{first}: {text(a)}, {second}: {text(b)}}}" for a, b in pairs)
        return f"let axiom = {text(axiom)};\nlet rules = [{objects}];\nconst angle = {angle};"
    if kind == "arrows":
        return f"axiom {text(axiom)}\n" + "\n".join(f"rule {text(a)} => {text(b)}" for a, b in pairs) + f"\nangle {angle}"
    if kind == "assignments":
        return f"angle = {angle}; start = {text(axiom)}; " + "; ".join(f"rules[{text(a)}] = {text(b)}" for a, b in pairs)
    return f"LSystem(axiom={text(axiom)}, rules={dictionary}, angle={angle}, n=4)"


@pytest.mark.parametrize("id", PLAIN)
@given(data=st.data())
def test_a_system_is_read_from_literals_of_any_language(id: str, data: st.DataObject) -> None:
    meant = system(id)
    text = data.draw(as_data(meant))
    assert same(read_as(FORMATS["data"], text), meant), text


@given(data=st.data(), meant=plain_systems())
def test_any_system_is_read_from_any_list_of_it(data: st.DataObject, meant: LSystem) -> None:
    text = data.draw(listed(meant))
    assert same(read(text), meant), text


@given(data=st.data(), meant=plain_systems())
def test_any_system_is_read_from_literals_of_any_language(data: st.DataObject, meant: LSystem) -> None:
    text = data.draw(as_data(meant))
    assert same(read(text), meant), text


@st.composite
def on_a_page(draw: st.DrawFn, meant: LSystem) -> str:
    """A listing as the book prints it, with what stands around it on its page."""
    gap = draw(st.sampled_from(["", " ", "  ", "\u2009"]))
    degrees = draw(st.sampled_from(["°", "◦", "º", "˚", " degrees"]))
    omega = draw(st.sampled_from(["ω :", "ω:", "ω  :"]))
    label = draw(st.sampled_from(["p{} :", "p{}:", "p_{} :", "p_{}: "]))
    arrow = draw(st.sampled_from(["→", "->", "⟶", " → "]))
    number = draw(st.sampled_from(["", "    (1.2)"]))
    rules = [
        f"{label.format(place)}{gap}{rule.predecessor.symbol} {arrow} {word(rule.successor)}"
        for place, rule in enumerate(meant.productions, 1)
    ]
    above = draw(
        st.sampled_from(["", "The following system makes the curve of the figure.\n\n", "12\n\nIt is drawn like this.\n"])
    )
    below = draw(
        st.sampled_from(
            ["", "\n\nFigure 1.7: A curve that somebody drew\n", "\nThe turtle draws it from left to right.\n\n13\n"]
        )
    )
    setting = f"n{gap}={gap}4,{gap}δ{gap}={gap}{float(meant.angle):g}{degrees}"
    text = f"{above}{setting}\n{omega} {word(meant.axiom)}\n" + "\n".join(rules) + f"{number}{below}"
    if draw(st.booleans()):
        text = re.sub(r"(?<=[A-Za-z\]\[+])-(?!>)", "−", text)
    return text.replace("∧", "^")


@st.composite
def as_l_py(draw: st.DrawFn, meant: LSystem) -> str:
    """A model of L-Py."""
    arrow, gap = draw(st.sampled_from(["-->", "->"])), draw(st.sampled_from(["", " ", "\t"]))
    comment = draw(st.sampled_from(["", "  # it grows"]))
    rules = [f"{rule.predecessor.symbol}{gap} {arrow} {gap}{word(rule.successor)}{comment}" for rule in meant.productions]
    head = draw(st.sampled_from(["", "# a model\n", "r = 0.5\n\n"]))
    length = draw(st.sampled_from(["", "derivation length: 4\n"]))
    end = draw(st.sampled_from(["", "endlsystem\n", "endlsystem\n###### INITIALISATION ######\n__lpy_code_version__ = 1.1\n"]))
    return f"{head}Axiom:{gap} {word(meant.axiom)}\n{length}\nproduction:\n\n" + "\n".join(rules) + f"\n{end}"


@st.composite
def as_lparser(draw: st.DrawFn, meant: LSystem) -> str:
    """A file of LParser, whose rolls are other signs."""
    comment = draw(st.sampled_from(["", "  # so it is", "\t# 1"]))
    blank = draw(st.sampled_from(["", "#\n", "\n"]))
    gap = draw(st.sampled_from(["", " "]))

    def spelt(modules) -> str:
        return word(modules).translate({ord("\\"): "<", ord("/"): ">"})

    rules = [f"{rule.predecessor.symbol}{gap}={gap}{spelt(rule.successor)}{comment}" for rule in meant.productions]
    end = draw(st.sampled_from(["", "@\n", "@\nThe rest is not read: F=FF\n"]))
    numbers = f"4{comment}\n{float(meant.angle):g}\n20\n"
    return f"# a file\n{numbers}{blank}{spelt(meant.axiom)}\n" + "\n".join(rules) + f"\n{end}"


@st.composite
def as_markup(draw: st.DrawFn, meant: LSystem) -> str:
    """A system in XML."""
    head, tail = draw(st.sampled_from([("from", "to"), ("predecessor", "successor"), ("lhs", "rhs"), ("left", "right")]))
    pairs = [(rule.predecessor.symbol, word(rule.successor)) for rule in meant.productions]
    axiom, angle = escape(word(meant.axiom)), f"{float(meant.angle):g}"
    gap = draw(st.sampled_from(["", "\n", "\n  "]))
    if draw(st.booleans()):
        rules = gap.join(f"<rule {head}={quoteattr(a)} {tail}={quoteattr(b)}/>" for a, b in pairs)
    else:
        rules = gap.join(f"<rule><{head}>{escape(a)}</{head}>{gap}<{tail}>{escape(b)}</{tail}></rule>" for a, b in pairs)
    turned = draw(
        st.sampled_from([f"<angle>{angle}</angle>", f"<parameter><name>angle</name><value>{angle}</value></parameter>"])
    )
    inside = draw(st.permutations([f"<axiom>{axiom}</axiom>", rules, turned]))
    start = draw(st.sampled_from(["", '<?xml version="1.0" encoding="UTF-8"?>\n', "<!-- a curve -->"]))
    root = draw(st.sampled_from(["system", "structure", "lsystem"]))
    return f"{start}<{root}>{gap}{gap.join(inside)}{gap}</{root}>"


WRITTEN = {"page": on_a_page, "l-py": as_l_py, "lparser": as_lparser, "xml": as_markup}
"""Formats, and who writes them."""


def is_held(meant: LSystem, name: str) -> bool:
    """Whether a format can hold a system: letters of LParser mean something, and turns of L-Py are 60 degrees."""
    letters = {module.symbol for rule in meant.productions for module in (*rule.predecessors, *flat(rule.successor))}
    return letters.isdisjoint("ctZz") if name == "lparser" else meant.angle == 60 if name == "l-py" else True


@pytest.mark.parametrize("name", WRITTEN)
@pytest.mark.parametrize("id", PLAIN)
@given(data=st.data())
def test_a_system_of_the_catalogue_is_read_from_every_format(id: str, name: str, data: st.DataObject) -> None:
    meant = system(id) if is_held(system(id), name) else KOCH
    text = data.draw(WRITTEN[name](meant))
    assert same(read(text), meant), text


@pytest.mark.parametrize("name", WRITTEN)
@given(data=st.data(), meant=plain_systems())
def test_any_system_is_read_from_every_format(name: str, data: st.DataObject, meant: LSystem) -> None:
    meant = meant if is_held(meant, name) else replace(meant, angle=60)
    text = data.draw(WRITTEN[name](meant))
    assert same(read(text), meant), text


@pytest.mark.parametrize("rules", ["rules: F->F-F++F-F", "rules:\n   F->F-F++F-F", "Rules: (F → F-F++F-F)"])
@pytest.mark.parametrize("last", ["angle:60", "Angle: 60", "angle: 60°"])
def test_rules_under_a_heading_with_turns_are_no_definitions(rules: str, last: str) -> None:
    for text in (f"axiom:F++F++F\n{rules}\n{last}", f"{last}\nAxiom: F++F++F\n{rules}"):
        assert same(read(text), KOCH), text


def test_some_systems_of_the_catalogue_are_plain() -> None:
    assert len(PLAIN) >= 2


@pytest.mark.parametrize(
    "text",
    [
        "variables : F\nconstants : + −\nstart  : F++F++F\nrules  : (F → F−F++F−F)\nangle  : 60°",
        "60°: angle\nAxiom = F++F++F\nF => F-F++F-F\nTurn: pi/3",
        "<b>Axiom:</b> F++F++F<br>F &rarr; F&minus;F++F&minus;F<br>&delta; = 60&deg;",
        "**Axiom:** $F++F++F$\n**Rule:** $F \\to F-F++F-F$\n**Angle:** $60^\\circ$",
        '{"axiom": "F++F++F", "rules": {"F": "F-F++F-F"}, "angle": 60}',
        "rules = {'F': 'F-F++F-F'}\naxiom = 'F++F++F'\nangle = 60  # degrees",
        '<?xml version="1.0"?><plant angle="60"><axiom>F++F++F</axiom><rule pre="F" post="F-F++F-F"/></plant>',
        "# koch\n4\n60\n10\nF++F++F\nF=F-F++F-F\n@",
        "Axiom: F++F++F\nproduction:\nF --> F-F++F-F\nendlsystem",
        "Premise  F++F++F\nRule 1   F=F-F++F-F\nAngle  60",
        "| Axiom | Rules | Angle |\n|---|---|---|\n| F++F++F | F=F-F++F-F | 60 |",
        "start with F++F++F, replace every F by F-F++F-F and turn by 60 degrees",
    ],
)
def test_what_each_format_has_is_the_same_system(text: str) -> None:
    assert same(read(text), KOCH)


@pytest.mark.parametrize(
    ("text", "notes"),
    [
        ("rule: F → F[+F]F", ('No axiom is given: it is "F", what the one rule rewrites.',)),
        (
            "start : F\nrules : (F → F+F)",
            ("Read as a list of variables and rules, as encyclopaedias have it; no angle is given: it is 90.",),
        ),
        ("start : F\nF → F+F\nangle: 60\nturn: 45", ("Two angles are given: 60 is used, not 45.",)),
        ("start : F\nstart : X\nF → F+F", ('The axiom is given more than once: "F" is used, not "X".',)),
        ("Axiom = a\nF => aF\na =>", ("a is erased: nothing stands behind its arrow.",)),
        ("Axiom: F\nF => FF\n@", ('"@" is left out: it is not surely a part of the rule above it.',)),
        ('rules = {"F": "F+F"}', ('No axiom is given: it is "F", what the one rule rewrites.',)),
        ("Initiator: F\nGenerator: F+F--F+F", ("The generator replaces F.",)),
        ("Axiom: A\nproduction:\nA --> A,A", ('"," without a value, the colour before, is left out.',)),
        (
            "It is drawn with n = 4.\nω : F\np1 : F → F+F\n\nFF\nFigure 1: A line\n",
            (
                '"FF" is left out: it is not surely a part of the rule above it.',
                "The number of steps, 4, is that of the text around.",
            ),
        ),
        ("Axiom: A oder B\nA => AB\nB => A", ('Behind the axiom, "oder B" is left out.',)),
        ("n=5..7, δ=20-30°\nω : X\nX → F[+X]-X", ('"5..7" is read as 5.', '"20-30°" is read as 20.')),
        ("Start: F\nF => F+F\nOrder 5+", ('"5+" is read as 5.',)),
        (
            "Start: F\nF => F+F\nAngle: 60deg (or 90deg)\nn = 5 à 7",
            ('"60deg (or 90deg)" is read as 60.', '"5 à 7" is read as 5.'),
        ),
        (
            '{"axiom": "F", "rules": {"F": "F+F"}, "angle": "20-30", "n": "5 to 7"}',
            ('"20-30" is read as 20.', '"5 to 7" is read as 5.'),
        ),
        ("Start: X\nX => F@.7[+X]-@IQ2X", ("@.7 is read as @Di(0.7): as in Fractint, lengths are multiplied by the number.",)),
        (
            "angle: 1.5707963\nstart : F\nF => F+F",
            (
                "Read as a list of variables and rules, as encyclopaedias have it; "
                "angle 1.5708 in degrees; were it in radians, it would be 90.",
            ),
        ),
    ],
)
def test_what_is_assumed_is_said(text: str, notes: tuple[str, ...]) -> None:
    assert set(notes) <= set(read(text).notes)


@pytest.mark.parametrize(
    ("text", "message", "at"),
    [
        ("Start: X\nRules:\nX → F[+X]\nF  FF\n", "An arrow is missing", (4, 2)),
        ("start : X\nrules : ( → F[+X]), (F → FF)", "Nothing stands before this arrow", (2, 11)),
        ("Start: F\nF → F+F\nAngle: sixty", 'The angle "sixty" is no number', (3, 8)),
        ('axiom = "X"\nrules = {"X": "F[+X"}', 'This "[" is never closed', (2, 17)),
        ('{"axiom": "F", "rules": {"F": "F+F}}', "This quotation mark is never closed", None),
        ("6\n35\nFA\nA=[&FA]A\n@", "A number is missing above the axiom of this file of LParser", (3, 1)),
        ("6\n35\n9\nFA\nA=F:A\n@", "LParser's \":\" makes all later turns smaller, which the kit's turtle does not", (5, 4)),
        ("k = k + 1\naxiom: A(k)", 'The constant "k" cannot be calculated from itself', (1, 1)),
        ("4\n20\n8\nF\n@", "An arrow is missing here", (1, 2)),
        ("start = F(1\nF = FF", 'This "(" is never closed', (1, 10)),
        ("Start: F\nF => FF\nX == F[+X]\nX => F", "I cannot read this line", (3, 1)),
        ("rule: + → -", "There is no axiom", (1, 12)),
        ("ω : F(\np1 : F → F+F   (1.2)\nFigure 1: A line\n", "A value is missing here", (1, 7)),
        ('<?xml version="1.0"?><axiom>é</axim>', "This is no complete XML: mismatched tag", (1, 32)),
        ('<?xml version="1.0"?>' + "<a>" * 200 + "<axiom>F", "These elements are too deep", None),
        ("import math\nAxiom: A\nproduction:\nA --> F\n", "This model of L-Py has Python in it", (1, 1)),
        (
            '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><axiom>&b;</axiom>',
            "A document type cannot be read here",
            (1, 22),
        ),
        ('<?xml version="1.0"?><axiom>F', "This is no complete XML: no element found", None),
    ],
)
def test_a_slip_is_shown_where_it_was_pasted(text: str, message: str, at: tuple[int, int] | None) -> None:
    with pytest.raises(LSystemError) as found:
        read(text)
    assert found.value.message == message
    assert at is None or (found.value.line, found.value.column) == at
    assert found.value.hint


def test_all_rules_that_a_program_chooses_among_are_found() -> None:
    program = "def rule(c):\n  if c == 'F': return 'F+F'\n  elif c == 'X': return 'XF'\n"
    [found] = systems_in_literals(program)
    assert [(rule.head.text, rule.tail[0].text) for rule in found.rules] == [("F", "F+F"), ("X", "XF")]


def test_a_program_is_not_run_and_what_its_literals_say_is_offered() -> None:
    program = 'axiom = "F"\nrules = {"F": "F+F"}\nfor step in range(5):\n    print(axiom)\n'
    with pytest.raises(ModelSyntaxError, match="This is a program") as found:
        read(program)
    assert "axiom: F | F -> F+F" in str(found.value.hint)
    assert found.value.line == 3


def test_of_several_systems_one_is_chosen_by_its_name() -> None:
    page = "Crystal\n\naxiom = F+F\nF -> FF+F\nangle = 90\n\nKoch\n\naxiom = F++F++F\nF -> F-F++F-F\nangle = 60\n"
    with pytest.raises(ModelValueError, match="There are 2 systems in this text") as found:
        read(page)
    assert "The systems are Crystal, Koch." in str(found.value.hint)
    assert same(read(page, name="Koch"), KOCH)
    with pytest.raises(ModelNameError, match='no system called "Hilbert"'):
        read(page, name="Hilbert")


def test_two_columns_of_a_page_are_two_systems() -> None:
    page = (
        "Two curves side by side:\n\nn=4, δ=90◦            n=3, δ=60◦\nF−F−F−F               F++F++F\n"
        "F → FF−F              F → F−F++F−F\n"
    )
    with pytest.raises(ModelValueError, match="There are 2 systems"):
        read(page)
    assert same(read(page, name="2"), KOCH)


def test_what_a_page_says_of_letters_is_drawn() -> None:
    text = 'start : A\nrules : (A → B−A−B), (B → A+B+A)\nangle : 60°\n\nHere, A and B both mean "draw forward".'
    assert [str(rule) for rule in read(text).interpretation] == ["A -> F", "B -> F"]


READ = {
    "a subscript in braces": ('axiom = "a"; rules = {"a": "a b_{r}"}', "axiom: a\na -> a b_r"),
    "numbers of characters in place of characters": (
        r'axiom = "\u0046"; rules = {"F": "F\x2bF"}; angle = 60',
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "a comment that never ends": ('axiom = "F"; rules = {"F": "FF"} /* and so on', "axiom: F\nF -> F F"),
    "a constant in a program": (
        'axiom = "F(1)"; var_b = 0.5; rules = {"F(x)": "F(x*b)"}',
        "b = 0.5\naxiom: F(1)\nF(x) -> F(x * b)",
    ),
    "a and b as symbols": ('axiom = "a"; rules = {"a": "ab", "b": "a"}', "axiom: a\na -> a b\nb -> a"),
    "a and b as names": ('axiom = "X"; rules = [{a: "X", b: "XY"}, {a: "Y", b: "X"}]', "axiom: X\nX -> X Y\nY -> X"),
    "a rule among ways": ('axiom = "F"; way = {"from": "here", "to": "there"}; rules = {"F": "FF"}', "axiom: F\nF -> F F"),
    "weights": ('axiom = "F"; rules = {"F": [("FF", 2), (3, "F")]}', "axiom: F\nF -> F F : 0.4\nF -> F : 0.6"),
    "named weights": (
        'axiom = "F"; rules = {"F": [{"successor": "FF", "probability": 0.4}, {"successor": "F", "probability": 0.6}]}',
        "axiom: F\nF -> F F : 0.4\nF -> F : 0.6",
    ),
    "a list of successors": (
        'axiom = "F"; rules = {"F": {"successors": ["FF", "F"]}}',
        "axiom: F\nF -> F F : 0.5\nF -> F : 0.5",
    ),
    "rules with colons in one line": ("Start: F\nRules: {F: F+G, G: GG}", "axiom: F\nF -> F+G\nG -> G G"),
    "a dictionary of rules": ('axiom = A\nrules = {"A": "AB", "B": "A"}', "axiom: A\nA -> A B\nB -> A"),
    "a homomorphism": ("h(a) = ab\nh(b) = a\naxiom: a", "axiom: a\na -> a b\nb -> a"),
    "an axiom with blanks": ("axiom F + F\nF => FF", "axiom: F + F\nF -> F F"),
    "an axiom below its name": ("Axiom:\nF++F\nRules:\nF => F-F", "axiom: F++F\nF -> F-F"),
    "quotients above arrows": (
        "Here it is: start = F\n1/3\nF → F[+F]\n2/3\nF → F[-F]",
        "axiom: F\nF -> F[+F] : 1/3\nF -> F[-F] : 2/3",
    ),
    "an initiator and a generator": (
        "Initiator: F++F++F\nGenerator: F-F++F-F\nAngle: 60",
        "angle: 60\naxiom: F++F++F\nF -> F-F++F-F",
    ),
    "what is replaced on a line of its own": (
        "Axiom = F\nPredecessor = F\nSuccessor = F+F\nAngle = 60",
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "a constant of Houdini": (
        "Premise: F(b)\nRule 1: F(x)=F(x*b)+F\nVariable b: 0.5\n",
        "b = 0.5\naxiom: F(b)\nF(x) -> F(x * b)+F",
    ),
    "probabilities in brackets": (
        "Axiom: F\nF (0.3) => F+F\nF (0.7) => F-F\nX => F",
        "axiom: F\nF -> F+F : 0.3\nF -> F-F : 0.7\nX -> F",
    ),
    "one value in brackets": ("Start: F(0.3)\nF (0.3) => F+F\nX => F", "axiom: F(0.3)\nF(0.3) -> F+F\nX -> F"),
    "nothing, in a word": ("Start: X\nX -> nothing\nF -> F+X", "axiom: X\nX -> ε\nF -> F+X"),
    "nothing, in a list": ("Start: X\nX => empty, F => F+X", "axiom: X\nX -> ε\nF -> F+X"),
    "dollars": ("Start: $F$\nRule: F => F+F", "axiom: F\nF -> F+F"),
    "symbols that a context passes over": (
        "Start: A B\nIgnore: +-F\nRules:\nA < B => A\nA => B",
        "ignore: + - F\naxiom: A B\nA < B -> A\nA -> B",
    ),
    "rules of TikZ on one line": (
        "\\pgfdeclarelindenmayersystem{Cantor}{\\symbol{f}{\\pgflsystemmoveforward}\\rule{F -> FfF}\\rule{f -> fff}}\n"
        "\\draw [lindenmayer system={Cantor, axiom=F, order=3}];",
        "axiom: F\nF -> F f F\nf -> f f f",
    ),
    "contexts of L-Py": (
        "Axiom: AB\nproduction:\n* < A > B --> AB\nA < B > * --> A\n",
        "angle: 60\naxiom: A B\nA > B -> A B\nA < B -> A",
    ),
    "sections, modules and constants of L-Py": (
        "r = 0.5\nextern(q = 3)\nderivation length: n - 1\nn = 4\nAxiom: A(q)\nmodule A(x): scale = 1\nmodule Leaf(a), Bud\n"
        "ignore: +/\nproduction:\n\n# the growth\nA(x) --> F(x)[+A(x*r)]Leaf(n),(2),\ndecomposition:\nmaximum depth: 3\n"
        "Leaf(a) --> Bud\n",
        "r = 0.5\nq = 3\nn = 4\nalphabet: Bud Leaf\nangle: 60\nsteps: 3\ndecomposition depth: 3\nignore: + /\naxiom: A(q)\n"
        "A(x) -> F(x)[+A(x * r)]Leaf(n);(2)\ndecomposition:\nLeaf(a) -> Bud",
    ),
    "a parameter in L-Py's own part": (
        "Axiom: A(s)\nproduction:\nA(x) --> F(x)A(x/2)\nendlsystem\n###### INITIALISATION ######\n"
        "def __initialiseContext__(context):\n\tscalars = [('s', 'Float', 3.5, 0.0, 10.0, 2)]\n",
        "s = 3.5\nangle: 60\naxiom: A(s)\nA(x) -> F(x)A(x/2)",
    ),
    "a table of HTML": (
        "<table><tr><th>Axiom</th><td>F++F</td></tr><tr><th>Rule</th><td>F &rarr; F-F</td></tr><tr><th>Angle</th>"
        "<td>60&deg;</td></tr></table>",
        "angle: 60\naxiom: F++F\nF -> F-F",
    ),
    "prompts": (
        "In [1]: axiom = 'F'\n\nIn [2]: rules = {'F': 'F+F'}\n   ...: angle = 60\nOut[2]: {'F': 'G'}\n",
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "formulas as text and as LaTeX": (
        "Axiom: F++F {\\displaystyle F++F}\nRule: F → F - F {\\displaystyle F\\rightarrow F-F}\n"
        "Angle: 60 ∘ {\\displaystyle 60^{\\circ }}",
        "angle: 60\naxiom: F++F\nF -> F-F",
    ),
    "cells between semicolons": ("axiom;angle;rules\nF;60;F=F+F", "angle: 60\naxiom: F\nF -> F+F"),
    "blocks": ("set [axiom v] to [X]\nset [rule X v] to [F+X]\nset [rule F v] to [FF]", "axiom: X\nX -> F+X\nF -> F F"),
    "sentences in French": (
        "On part de l'axiome F. On remplace chaque F par F+F et on tourne de 60°.",
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "a sentence in German": ("Startwort F++F, jedes F wird durch F-F ersetzt, Winkel 60°", "angle: 60\naxiom: F++F\nF -> F-F"),
    "what symbols mean": (
        "F = draw forward, + = turn left 60°, - = turn right 60°\nAxiom F\nF → F+F",
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "rules with names of their parts": (
        "axiom: X\nrules:\n  - from: X\n    to: F+X\n  - from: F\n    to: FF",
        "axiom: X\nX -> F+X\nF -> F F",
    ),
    "the number of an equation": ("n=4, δ=60°\nω : F\np1 : F → F+F    (1.2)", "steps: 4\nangle: 60\naxiom: F\nF -> F+F"),
    "a value behind blanks": (
        "angle: 60\nω : F(1)\np1 : F(x) → F(x)+F    (1.2)",
        "angle: 60\naxiom: F(1)\nF(x) -> F(x)+F(1.2)",
    ),
    "numbers of footnotes": ("Axiom: F[1]\nRules: F → F+F[2][3]", "axiom: F\nF -> F+F"),
    "branches with digits": ("Axiom: F[1]\nRules: F → F+F[2], 1 → 2", "axiom: F[1]\nalphabet: 1 2\nF -> F+F[2]\n1 -> 2"),
    "a δ that was taken for a digit": ("n = 4, 6 = 25°\nw : F\np : F --+ F+F", "steps: 4\nangle: 25\naxiom: F\nF -> F+F"),
    "steps of L-Py that nothing says": (
        "derivation length: n\nAxiom: A\nproduction:\nA --> AB",
        "angle: 60\naxiom: A\nA -> A B",
    ),
    "texts one behind another": (
        'axiom = "F" + "X"\nrules = {"F": "F" "+F", "X": "F" + "X"}',
        "axiom: F X\nF -> F+F\nX -> F X",
    ),
    "successors and their weights": (
        'axiom = "A"\nrules = {"A": {"AB": 0.25, "BA": 0.75}}',
        "axiom: A\nA -> A B : 0.25\nA -> B A : 0.75",
    ),
    "what symbols are drawn as": (
        '{"axiom": "F", "rules": {"F": "F+F"}, "commands": {"+": "left", "F": "go"}}',
        "axiom: F\nF -> F+F",
    ),
    "a list in YAML": ('axiom: X\nrules:\n  - "X -> F+X"\n  - "F -> FF"', "axiom: X\nX -> F+X\nF -> F F"),
    "right sides of JFLAP": (
        "<structure><type>lsystem</type><axiom>X</axiom><production><left>X</left><right>g + X</right><right>g % X</right>"
        "</production></structure>",
        "axiom: X\nX -> g-X : 0.5\nX -> g|X : 0.5\ninterpretation:\ng -> F",
    ),
    "productions of JFLAP for the same symbol": (
        "<structure><type>lsystem</type><axiom>X</axiom><production><left>X</left><right>X Y</right></production>"
        "<production><left>X</left><right>Y X</right></production></structure>",
        "axiom: X\nX -> X Y : 0.5\nX -> Y X : 0.5",
    ),
    "fonts of LaTeX": (
        "\\textbf{Axiom:} \\texttt{F}\\\\ \\emph{Rule}: {\\tt F} $\\to$ {\\tt F[+F]F}\\\\ \\textbf{Angle:} $25^\\circ$",
        "angle: 25\naxiom: F\nF -> F[+F]F",
    ),
    "verbatim in LaTeX": ("Axiom: \\verb|X|, rules: \\verb|X -> F[+X]|, \\verb!F -> FF!", "axiom: X\nX -> F[+X]\nF -> F F"),
    "subscripts of a page": (
        "<p>axiom: A<sub>1</sub>; rules: A<sub>1</sub> &rarr; A<sub>1</sub>B<sub>2</sub>, B<sub>2</sub> &rarr; A<sub>1</sub>",
        "axiom: A1\nalphabet: A1 B2\nA1 -> A1 B2\nB2 -> A1",
    ),
    "a symbol with a subscript that nothing replaces": (
        "Axiom: A₁; Rules: A₁ → A₁B₂",
        "axiom: A1\nalphabet: A1 B2\nA1 -> A1 B2",
    ),
    "brackets that turn": (
        "axiom: 0\nrules: (1 → 11), (0 → 1[0]0)\n[: push position and angle, turn left 45 degrees\n"
        "]: pop position and angle, turn right 45 degrees",
        "alphabet: 0 1\nangle: 45\naxiom: 0\n1 -> 1 1\n0 -> 1[+0]-0",
    ),
    "contexts of one letter, which are no tags": (
        '{"axiom": "ABC", "productions": {"A<B>C": "D", "B": "BB"}}',
        "axiom: A B C\nA < B > C -> D\nB -> B B",
    ),
    "letters that turn": (
        "Axiom: F\nRegel: F → FLFRRFLF\nF: vorwärts, L: 60° nach links drehen, R: 60° nach rechts drehen",
        "angle: 60\naxiom: F\nF -> F L F R R F L F\ninterpretation:\nL -> +\nR -> -",
    ),
    "what is passed over on a page": (
        "Figure 1: signals\nω : B A A\nignore: +-\np1 : B < A → B\n",
        "ignore: + -\naxiom: B A A\nB < A -> B",
    ),
    "a sentence behind a rule": ("A → B; B → AB; starting from A", "axiom: A\nA -> B\nB -> A B"),
    "contexts in parts of their own": (
        '{"axiom": "AB", "rules": [{"left": "A", "symbol": "B", "right": "", "successor": "C"}]}',
        "axiom: A B\nA < B -> C",
    ),
    "conditions in parts of their own": (
        '{"axiom": "A(1)", "rules": [{"predecessor": "A(x)", "condition": "x<3", "successor": "A(x+1)"},'
        ' {"predecessor": "A(x)", "condition": "x>=3", "successor": "B"}]}',
        "axiom: A(1)\nA(x) : x < 3 -> A(x + 1)\nA(x) : x >= 3 -> B",
    ),
    "what contexts pass over, as data": (
        '{"axiom": "AB", "ignore": "+-", "rules": {"A": "AB"}}',
        "ignore: + -\naxiom: A B\nA -> A B",
    ),
    "what rules are drawn as, as data": (
        '{"axiom": "A", "rules": {"A": "AB", "B": "A"}, "draw": {"A": "F", "B": "+F"}}',
        "axiom: A\nA -> A B\nB -> A\ninterpretation:\nA -> F\nB -> +F",
    ),
    "a homomorphism below the rules": (
        "axiom: A\nrules: A → AB, B → A\nhomomorphism: A → F, B → +F",
        "axiom: A\nA -> A B\nB -> A\ninterpretation:\nA -> F\nB -> +F",
    ),
    "signs in braces": (
        "$\\omega: F$, $p_1: F \\to F{+}F{-}{-}F-{}-F$, $\\delta=60^{\\circ}$",
        "angle: 60\naxiom: F\nF -> F+F--F--F",
    ),
    "sets of one symbol": ("V = {F}, S = {+, −}, ω = F++F\nP = {F → F−F}", "axiom: F++F\nF -> F-F"),
    "an angle in degrees, in Fractint's words": ("Axiom = F\nAngle = 25.7\nF = FF+F", "angle: 25.7\naxiom: F\nF -> F F+F"),
    "a rule with a word for its arrow": ("Axiom = F\nF becomes F[+F]F\nAngle = 25", "angle: 25\naxiom: F\nF -> F[+F]F"),
    "a set with something said behind it": (
        "axiom: A; rules: {A → ABA, B → BBB}  (Cantor set)",
        "axiom: A\nA -> A B A\nB -> B B B",
    ),
    "a list of one symbol": ("SubstitutionSystem[{a -> {a, b}, b -> {a}}, {a}, 4]", "axiom: a\na -> a b\nb -> a"),
    "factors of lengths": (
        "Start: X\nX => F@.7[+X]@Q2X@IQ2X@QI2X@I2X",
        "axiom: X\nX -> F @Di(0.7)[+X] @Di(sqrt(2)) X @Di(1/sqrt(2)) X @Di(sqrt(1/2)) X @Di(1/2) X",
    ),
    "a setting without its colon": ("Axiom b[+a]a\nIgnore +-F\nb < a -> b", "ignore: + - F\naxiom: b[+a]a\nb < a -> b"),
    "a table with its arrow in the first column": (
        "| A → | `−AF` |\n| F → | `F F` |\n\nAxiom: A",
        "axiom: A\nA -> -A F\nF -> F F",
    ),
    "a table with its arrow in the second column": ("| Axiom | A |\n| A | → AB |\n| B | → A |", "axiom: A\nA -> A B\nB -> A"),
    "a table with a column of arrows": (
        "| predecessor | → | successor |\n|:-:|:-:|:-:|\n| A | → | AF|F |\n\naxiom A",
        "axiom: A\nA -> A F|F",
    ),
    "chances in percent": ("axiom F\nF -> F[+F]F 50%\nF -> FF 50%", "axiom: F\nF -> F[+F]F : 0.5\nF -> F F : 0.5"),
    "Markdown, with names in bold": (
        "### Dragon\n\n- **Axiom**: `FX`\n- **Rules**:\n  - `X` → `X+YF+`\n  - `Y` → `-FX-Y`\n- **Angle**: 60°",
        "angle: 60\naxiom: F X\nX -> X+Y F+\nY -> -F X-Y",
    ),
    "Markdown, with items of a list": (
        "- Axiom: `FX`\n- Rules:\n  - `X` → `X+YF+`\n  - `Y` → `-FX-Y`",
        "axiom: F X\nX -> X+Y F+\nY -> -F X-Y",
    ),
    "Markdown, with rules in a row": (
        "**Axiom:** `FX`\n**Rules:** `X -> X+YF+`, `Y -> -FX-Y`\n**Angle:** `60`",
        "angle: 60\naxiom: F X\nX -> X+Y F+\nY -> -F X-Y",
    ),
    "Markdown, with underscores": ("__Axiom__: F\n__Rules__: F -> FF", "axiom: F\nF -> F F"),
    "chances in percent behind a symbol": (
        "axiom: F\nF (33%) -> F[+F]F\nF (67%) -> FF\nangle: 25.7",
        "angle: 25.7\naxiom: F\nF -> F[+F]F : 0.33\nF -> F F : 0.67",
    ),
    "chances in percent behind an arrow": (
        "Axiom: X\nX → (70%) F[+X]\nX → (30%) F[-X]",
        "axiom: X\nX -> F[+X] : 0.7\nX -> F[-X] : 0.3",
    ),
    "chances with their name, in brackets": (
        "Axiom: F\nF → F[+F]F (p = 1/3)\nF → F[−F]F (p = 2/3)",
        "axiom: F\nF -> F[+F]F : 1/3\nF -> F[-F]F : 2/3",
    ),
    "an angle as a part of pi": ("axiom: F\nF -> F-F++F-F\nangle: pi/3", "angle: 60\naxiom: F\nF -> F-F++F-F"),
    "an angle that Fractint does not take": (
        "angle = 60\naxiom = X\nX = F[+X]X\nF = FF",
        "angle: 60\naxiom: X\nX -> F[+X]X\nF -> F F",
    ),
    "chances in words": (
        "axiom: F\nF -> F[+F]F with probability 1/3\nF -> FF, prob = 2/3",
        "axiom: F\nF -> F[+F]F : 1/3\nF -> F F : 2/3",
    ),
    "chances before rules": ("axiom: F\n0.3 F => F[+F]F\n0.7 F => FF", "axiom: F\nF -> F[+F]F : 0.3\nF -> F F : 0.7"),
    "chances within arrows": ("axiom: F\nF -(0.3)-> F[+F]F\nF -(0.7)-> F F", "axiom: F\nF -> F[+F]F : 0.3\nF -> F F : 0.7"),
    "chances within other arrows": (
        "Start: F\nF -(0.3)-> F[+F]F\nF -(0.7)-> FF",
        "axiom: F\nF -> F[+F]F : 0.3\nF -> F F : 0.7",
    ),
    "a table of a symbol's names": ("| axiom | F |\n|---|---|\n| F | F+F |\n| angle | 90 |", "angle: 90\naxiom: F\nF -> F+F"),
    "a constant called as a setting": (
        "angle = 30\nAxiom: F\nproduction:\nF --> F+(angle)F\nendlsystem",
        "angle_ = 30\nangle: 60\naxiom: F\nF -> F+(angle_)F",
    ),
    "arrows of two signs": ("δ=60◦\nω : F\np1 : F −→ FfF\np2 : f –→ ff", "angle: 60\naxiom: F\nF -> F f F\nf -> f f"),
    "arrows below what they replace": (
        "ω : F\np1 : F .5\n−→ F[+F]\np2 : F .5\n→ F\n1.7. Stochastic systems 29",
        "axiom: F\nF -> F[+F] : 0.5\nF -> F : 0.5",
    ),
    "an arrow below a condition": (
        "δ = 30◦\nω : A(1)\np1 : A(x) : x ≤ 3\n→ F(x)A(x + 1)",
        "angle: 30\naxiom: A(1)\nA(x) : x <= 3 -> F(x)A(x+1)",
    ),
    "a production for a turn, below another": ("ω : F-\np1 : F → F-\np2 : - → +", "axiom: F-\nF -> F-\n- -> +"),
    "the only production of a page": ("The curve is\nω : F\np : F −→ F + F\nwith δ = 60◦.", "angle: 60\naxiom: F\nF -> F+F"),
    "the number of an equation behind values": (
        "ω : A(1)\np1 : A(x) : x ≤ 3 → F(x)A(x + 1) (1.7)\n44 Chapter 1. Modeling",
        "axiom: A(1)\nA(x) : x <= 3 -> F(x)A(x+1)",
    ),
    "constants with a blank behind the sign": (
        "# define r 0.5\nω : F(1)\np1 : F(x) → F(x ∗ r) (2.1)\nFigure 2.1: It shrinks",
        "r = 0.5\naxiom: F(1)\nF(x) -> F(x*r)",
    ),
    "any neighbours and chances": (
        "ω : X\np1 : ∗ < X > ∗ .5 → F[+X]\np2 : ∗ < X > ∗ .5 → F[−X]",
        "axiom: X\nX -> F[+X] : 0.5\nX -> F[-X] : 0.5",
    ),
    "tables of TOML": (
        '[plant]\naxiom = "F"\n[plant.rules]\nF = "FG"\nG = "GG"\n[plant.drawing]\nangle = 60',
        "angle: 60\naxiom: F\nF -> F G\nG -> G G",
    ),
    "rules that are tables": (
        'axiom = "F"\n[[rule]]\nfrom = "F"\nto = "FF"\nweight = 3\n[[rule]]\nfrom = "F"\nto = "F"\nweight = 1',
        "axiom: F\nF -> F F : 0.75\nF -> F : 0.25",
    ),
    "letters that draw, in a list": (
        'axiom = "A"; draw = ["A", "B", "F"]; rules = {"A": "A+B", "B": "F"}',
        "axiom: A\nA -> A+B\nB -> F\ninterpretation:\nA -> F\nB -> F",
    ),
    "how letters are drawn": (
        'axiom = "A"; draw = {"A": "F"}; rules = {"A": "A+B"}',
        "axiom: A\nA -> A+B\ninterpretation:\nA -> F",
    ),
    "a list of styles of drawing": ('axiom = "A"; draw = ["thin", "red"]; rules = {"A": "AF"}', "axiom: A\nA -> A F"),
    "what draws, without a value": ('rules = {"A": "AF"}; axiom = "A"; draw =', "axiom: A\nA -> A F"),
    "pairs with a word": ('val axiom = "FX"\nval rules = mapOf(\'X\' to "X+F")', "axiom: F X\nX -> X+F"),
    "texts one below another": (
        'axiom = "X"\nrules = {\n "X": "F[+X]"\n      "F[-X]",\n "F": "FF",\n}',
        "axiom: X\nX -> F[+X]F[-X]\nF -> F F",
    ),
    "quoted mail": ("Anna wrote:\n> Axiom: F\n> F=F[+F]F\n> angle 20\nCool!", "angle: 20\naxiom: F\nF -> F[+F]F"),
    "a talk": ("[14:02] <anna> axiom: F\n[14:03] <anna> F => FF+F\n[14:03] <bob> fine", "axiom: F\nF -> F F+F"),
    "the source of an encyclopaedia": (
        ":'''start''' : F\n:'''rules''' : (F → F+F)\n:'''angle''' : 60°",
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "fractions that are one sign": (
        "start F\n⅓: F => F[+F]\n⅔: F => FF\nangle: 22½°",
        "angle: 22.5\naxiom: F\nF -> F[+F] : 1/3\nF -> F F : 2/3",
    ),
    "probabilities called p": (
        "start: A\n1. A -> F[+A]  (p = 0.7)\n2. A -> FA  (p = 0.3)",
        "axiom: A\nA -> F[+A] : 0.7\nA -> F A : 0.3",
    ),
    "shares": ("axiom F\nF => F[+F]  weight 3\nF => F, weight: 1", "axiom: F\nF -> F[+F] : 3\nF -> F : 1"),
    "quotation marks of French": ("axiome : « F »\nrègle de réécriture : « F » → « F+F »", "axiom: F\nF -> F+F"),
    "the head of a letter": (
        "From: M. Keller <keller@schule.example>\nTo: Klasse 12\n\nAxiom: X\nRegel: X => F[+X]X",
        "axiom: X\nX -> F[+X]X",
    ),
    "a program in PHP": ("<?php\n$axiom = 'F';\n$rules = ['F' => 'F-F'];", "axiom: F\nF -> F-F"),
    "a quotation mark that is a command": (
        'Premise: FA\nRule 1: A = "!"[B]\nRule 2: B = &FA',
        "axiom: F A\nA -> @Di(0.9)!@Di(0.9)[B]\nB -> &F A",
    ),
    "a tree of Minetest": (
        'tree = {axiom = "TA", rules_a = "[+FG]A", angle = 30}',
        "angle: 30\naxiom: T A\nA -> [-F G]A\ninterpretation:\nG -> f\nT -> F",
    ),
    "words between a letter and its commands": (
        "axiom: A\nA => BA\nB => A\nDabei bedeuten A und B „vorwärts zeichnen“.",
        "axiom: A\nA -> B A\nB -> A\ninterpretation:\nA -> F\nB -> F",
    ),
    "letters that move, in French": (
        "axiome : A\nA => AB\nB => BB\nA signifie « dessiner en avançant », B signifie « avancer sans dessiner ».",
        "axiom: A\nA -> A B\nB -> B B\ninterpretation:\nA -> F\nB -> f",
    ),
    "marks of direction and separators of lines": (
        "\u200eAxiom: F\u2028\ufeffRule: F \u200e→ F+F\vAngle: 60°\f",
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "functions that set the parts": (
        'new Builder().axiom("F").rule("F", "F+F").setAngle(60).build();',
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "a function that is told nothing": ('axiom = "F"; rules = {"F": "FF"}; x = angle()', "axiom: F\nF -> F F"),
    "hashes of Perl": ("my $axiom = 'F';\nmy %rules = ( F => 'F+F' );\nmy $angle = 60;", "angle: 60\naxiom: F\nF -> F+F"),
    "rules with letters": ("Start: A\nRule A: AB\nRule B: A", "axiom: A\nA -> A B\nB -> A"),
    "a whole turn in parts": ("Start: F\nF => F+F\nangle: 360° / 8", "angle: 45\naxiom: F\nF -> F+F"),
    "another language": ("axióma: F\nszabályok: F → F+F\nszög: 60°", "angle: 60\naxiom: F\nF -> F+F"),
    "a whole text that was quoted": (
        "> Axiom: F(1)\n> production:\n> F(x) --> F(x)F(x)\n> endlsystem",
        "angle: 60\naxiom: F(1)\nF(x) -> F(x)F(x)",
    ),
    "an indented text": (
        "    Axiom: F(1)\n    production:\n    F(x) --> F(x)F(x)\n    endlsystem",
        "angle: 60\naxiom: F(1)\nF(x) -> F(x)F(x)",
    ),
    "a table with the ends of lines of Windows": (
        "| Name | Value |\r\n|:---|---:|\r\n| Symbols | F, + |\r\n| Axiom | F+F |\r\n| Rule | F -> F-F |\r\n| Angle | 60 |\r\n",
        "angle: 60\naxiom: F+F\nF -> F-F",
    ),
    "conditions before arrows of print": (
        "Start: A(1)\nA(x) : x < 3 → A(x+1)\nA(x) : x >= 3 → B",
        "axiom: A(1)\nA(x) : x < 3 -> A(x+1)\nA(x) : x >= 3 -> B",
    ),
    "small words behind a rule": ("start: F\nF → F+F y la planta crece", "axiom: F\nF -> F+F"),
    "a triple, whose rules have a name": ("Let G = ({A}, A, P) with P = {A → [A]A}.", "axiom: A\nA -> [A]A"),
    "a rule without a probability": ("start: F\nF → FF 25%\nF → F+F", "axiom: F\nF -> F F : 0.25\nF -> F+F : 0.75"),
    "a successor with any name": ('{"axiom": "F", "rules": {"F": [{"p": 1, "w": "F+F"}]}}', "axiom: F\nF -> F+F : 1"),
    "a rule of XML with an attribute": (
        '<l axiom="F" angle="60"><rule symbol="F">F+F</rule></l>',
        "angle: 60\naxiom: F\nF -> F+F",
    ),
    "a file of LParser with a title": ("Bush\n5\n30\n9\nF ; the axiom\nF=F+F\n@", "angle: 30\nsteps: 5\naxiom: F\nF -> F+F"),
    "sentences in Dutch": ("Het axioma is F en de regel is F → F+F. De hoek is 25 graden.", "angle: 25\naxiom: F\nF -> F+F"),
    "a number of steps in a sentence": ("start: F\nF → F+F\nI like it after 4 steps.", "steps: 4\naxiom: F\nF -> F+F"),
    "an axiom and an angle in a sentence": (
        "Das Startsymbol „A“ hat die Regel\n (1)  A → F[+A]A\nDer Drehwinkel beträgt 30 Grad.",
        "angle: 30\naxiom: A\nA -> F[+A]A",
    ),
}
"""Texts, and the systems that they mean."""


@pytest.mark.parametrize(("text", "meant"), READ.values(), ids=READ)
def test_a_text_is_the_system_that_it_means(text: str, meant: str) -> None:
    found, wanted = read(text), read(meant)
    assert (str(found), found.steps) == (str(wanted), wanted.steps)


PLAIN_WAYS = {
    "semicolons at the ends of lines": ("axiom: %s;\n%s;\nangle: %g;", "{} -> {}", ";\n"),
    "commas at the ends of lines": ("axiom: %s,\n%s,\nangle: %g", "{} -> {}", ",\n"),
    "quotation marks": ("Axiom: '%s'\n%s\nAngle: %g", "'{}' -> '{}'", "\n"),
    "pictographs": ("🌱 Axiom: %s\n%s\n📐 Angle: %g°", "🌿 {} → {}", "\n"),
    "assignments": ("axiom ← %s\n%s\nangle ← %g°", "{} ← {}", "\n"),
    "roman numbers": ("(i) Start: %s\n%s\n(x) Angle: %g", "(iv) {} → {}", "\n"),
    "a set": ("Axiome : ω = %s\nRègles : P = {%s}\nAngle : δ = %g°", "{} → {}", ", "),
    "the word rule": ("Start: %s\n%s\nAngle: %g", "rule {} {}", "\n"),
    "an angle for an arrow": ("Axiom: %s\nRules:\n%s\nAngle = %g", "{} > {}", "\n"),
    "members in their order": ('["one", "%s", {%s}, %g, 1]', '"{}": "{}"', ", "),
    "one line": ("One: %s; %s; %g", "{}={}", "; "),
    "a derivation below": ("Axiom: %s\n%s\nAngle: %g\nDerivation: A ⇒ AB ⇒ ABA", "{} → {}", "\n"),
}
"""Ways to write a system: all of it, with its axiom, its rules and its angle; a rule; and what is between two rules."""


@pytest.mark.parametrize(("whole", "rule", "between"), PLAIN_WAYS.values(), ids=PLAIN_WAYS)
def test_a_system_of_the_catalogue_is_read_whatever_is_around_its_words(whole: str, rule: str, between: str) -> None:
    for meant in (KOCH, PLANT, *(each for each in map(system, PLAIN) if "\\" not in str(each))):
        rules = between.join(rule.format(each.predecessor.symbol, word(each.successor)) for each in meant.productions)
        found = read(whole % (word(meant.axiom), rules, float(meant.angle)))
        assert same(found, meant), found.notes


def test_a_constant_of_a_sentence_is_one_where_a_value_has_its_name() -> None:
    text = "Axiom: A(1), rule: A(s) → F(s)[+A(s/R)], {}, angle: 85°"
    assert same(read(text.format("where R = 1.5")), read("R = 1.5\nangle: 85\naxiom: A(1)\nA(s) -> F(s)[+A(s/R)]"))
    assert read(text.format("R = 1.5, S = 2")).constants == read("R = 1.5\naxiom: A").constants


@pytest.mark.parametrize("condition", ["{s > 1}", "if s > 1", "when s > 1", ": s > 1"])
def test_a_condition_is_one_however_it_is_set_apart(condition: str) -> None:
    assert same(read(f"Start: A(3)\nA(s) {condition} → F(s)A(s-1)"), read("axiom: A(3)\nA(s) : s > 1 -> F(s)A(s-1)"))


def test_the_end_of_a_line_of_windows_is_not_shown() -> None:
    with pytest.raises(ModelSyntaxError) as found:
        read("Axiom: F\r\nF ->\r\n")
    assert "?" not in str(found.value)


def test_a_condition_before_its_rule_is_refused_and_not_dropped() -> None:
    with pytest.raises(ModelSyntaxError, match="before the condition") as found:
        read("Start: A(3)\nif s > 1: A(s) → F(s)A(s-1)")
    assert (found.value.line, found.value.column) == (2, 4)


@pytest.mark.parametrize("second", ["and B with A", ", B by A", "and every B with A"])
def test_a_sentence_that_replaces_two_symbols_has_two_rules(second: str) -> None:
    assert same(read(f"Replace A with AB {second}. Start with A."), read("axiom: A\nA -> A B\nB -> A"))
    with pytest.raises(LSystemError):
        read(f"Start with A {second}.")


def test_a_soft_hyphen_is_a_minus_only_where_a_text_has_none() -> None:
    assert keyboard_signs("F→F[\u00adF] plants to be ma\u00adny\u00ad").text == "F→F[-F] plants to be many"
    assert keyboard_signs("F→F\u00ad[-F]").text == "F→F[-F]"


def test_a_parameter_called_n_is_no_number_of_steps() -> None:
    printed = "n=300\nω : A(0)\np1 : A(n) : * → F(n)A(n+1)"
    assert (read(printed).steps, read(printed).constants) == (300, ())
    assert read("n=300\nω : A(0)\np1 : A(k) : * → F(n)A(k+1)").steps is None


def test_an_angle_alone_below_a_printed_rule_is_the_angle_unless_one_is_given() -> None:
    assert read("ω : F\np1 : F → F+F\n22.5°").angle == read("angle: 22.5\naxiom: F").angle
    assert read("δ = 60°\nω : F\np1 : F → F+F\n22.5°").angle == 60


def test_digits_that_fractint_passes_over_are_told() -> None:
    assert any("passes over digits" in note for note in read("A { Angle 6\nAxiom F\nF=F2+F\n}").notes)
    assert not any("digits" in note for note in read("A { Angle 6\nAxiom F2\nF=C2F\n2=F\n}").notes)


@pytest.mark.parametrize("page", ["F; F=F+F; 60; 4; 5", "F; 60; 4", "A1; F=F+F; F+F; 60", "F; F=F+F" + "; 60" * 50])
def test_a_line_with_other_members_is_no_list(page: str) -> None:
    with contextlib.suppress(LSystemError):
        assert "is read as the axiom" not in " ".join(read(page).notes)


@pytest.mark.parametrize("name", ["A", "b"])
@pytest.mark.parametrize(
    "page",
    [
        'all = [{"name": "A", "axiom": "A", "rules": {"A": "AA"}}, {"name": "b", "axiom": "b", "rules": {"b": "bb"}}]',
        "a) Start: A\nA => AA\n\nb) Start: b\nb => bb\n",
        '[A]\naxiom = "A"\n[A.rules]\nA = "AA"\n[b]\naxiom = "b"\n[b.rules]\nb = "bb"\n',
        'all = {"A": ("A", {"A": "A+A"}, 60), "b": ("b", {"b": "b+b"}, 4, 90), "c": ("b", {"b": "b"}, 1, 2, 3)}',
    ],
)
def test_each_of_several_systems_has_its_name(page: str, name: str) -> None:
    assert word(read(page, name=name).axiom) == name


def test_the_letter_of_a_caption_is_nearer_than_a_heading() -> None:
    with pytest.raises(ModelValueError) as found:
        read("Plants 25\na\nStart: F\nF => FF\n\nb\nStart: F\nF => F+F\n")
    assert "The systems are a, b." in str(found.value.hint)


def test_signs_of_other_turtles_are_those_of_the_kit() -> None:
    leaf = read("axiom = a\nF -> >F<\na -> F[+x]\nx -> a\nangle = 45\nlength factor = 1.36")
    assert str(leaf.productions[0]) == "F -> @Di(1.36) F @Dd(1.36)" or "@Di(1.36)" in str(leaf.productions[0])
    assert "/(94)" in str(read("5\n20\n9\nA\nA=F>(94)A\n@").productions[0])


def test_typography_is_one_for_one_or_known() -> None:
    assert keyboard_signs("angle： 25.7◦, oﬃce").text == "angle: 25.7°, office"
    assert keyboard_signs("F−F &minus; “G” Fₗ p₁").text == 'F-F - "G" F_l p1'
    assert keyboard_signs("axiom: F").text == "axiom: F"
    assert keyboard_signs("⅓ 2½ ½ « F » 2⅓").text == '1/3 2.5 1/2 "F" 21/3'
    assert keyboard_signs("F −→ G\nF\n→ G\nHome\n→ G").text == "F  → G\nF → G\nHome\n→ G"


@pytest.mark.parametrize("name", FORMATS)
def test_a_format_is_asked_for_by_its_name(name: str) -> None:
    with pytest.raises(LSystemError):
        read("", name)


def test_a_list_that_has_no_axiom_is_refused_where_a_list_was_asked_for() -> None:
    with pytest.raises(LSystemError, match="There is no axiom"):
        read("X → F[+X]F\nF → FF\nangle 20°", "list")


@pytest.mark.parametrize("rules", ['{"rules": {"F": "F+F", "G": "GG"}}', 'rules = {"F": "F+F",\n "G": "GG"}'])
def test_no_axiom_is_assumed_where_another_format_finds_more_rules(rules: str) -> None:
    with pytest.raises(LSystemError, match="which the kit does not read"):
        read(rules)


def test_a_longer_text_is_not_searched() -> None:
    assert what_is_missing("Axiom: F\nRules:" + " " * LONGEST) is None
    assert read_found("start : F\nrules : (F → FF)\n" + " " * LONGEST) is None


TOKENS = (
    *(
        "axiom",
        "start",
        "rules",
        "rule 1",
        "angle",
        "n",
        "=",
        ":",
        "->",
        "→",
        "=>",
        "F",
        "X",
        "A(t)",
        "A(t):t<5",
        "[+F]",
        "(",
        ")",
        "[",
        "]",
    ),
    *(
        "{",
        "}",
        '"',
        "'",
        '"F"',
        '"FF"',
        ",",
        ";",
        "\n",
        "  ",
        "    ",
        "25°",
        "25,7",
        "50%",
        "(1/3)",
        ".5",
        "<",
        ">",
        "&rarr;",
        "<b>",
        "<br>",
    ),
    *(
        "**",
        "`",
        "```",
        "$",
        "\\to",
        "\\omega",
        "#",
        "//",
        "/*",
        "*/",
        "%",
        "production:",
        "module A",
        "Axiom: A",
        "A --> F",
        "produce",
        "@",
    ),
    *(
        "7",
        "22.5",
        "A=F[+A]F",
        '<?xml version="1.0"?>',
        "<a>",
        '<rule from="F" to="FF"/>',
        "</a>",
        "<!DOCTYPE x>",
        "Premise",
        "ω : F",
        "p1 : F → FF",
    ),
    *(
        "Figure 1: x",
        "turn 90°",
        "rules = {",
        '"F": "FF"',
        ":>",
        "rule(1).before='F'",
        "rule(1).after='FF'",
        "length factor = 1.3",
        ">F<",
        "~(5)",
    ),
    *("ﬁ", "é", "\u200b", "\x00", "\ud800", "1e999", "|"),
)


def test_an_empty_text_among_rules_is_none() -> None:
    assert str(read("axiom = 'F'; rules = ['', 'F -> F+F']").productions[0]) == "F -> F+F"


@given(st.randoms(use_true_random=False))
def test_any_text_is_read_or_refused_by_every_format(chance: random.Random) -> None:
    text = "".join(chance.choice(TOKENS) + chance.choice(("", " ", "\n")) for _ in range(chance.randint(1, 40)))
    for form in FORMATS.values():
        try:
            assert read_as(form, text).axiom is not None
        except LSystemError:
            continue


@pytest.mark.slow
@pytest.mark.parametrize(
    "token",
    [
        *TOKENS,
        "\t",
        " ",
        "- ",
        "F → F\n",
        "(A → AB), ",
        "'F':",
        "x:y ",
        "{aaa",
        "<!--",
        "replace every F with ",
        "1a",
        '\\"',
        "\\'",
    ],
)
def test_no_text_takes_longer_than_its_length(token: str) -> None:
    """Twice the text takes some twice the time; where that were its square, this would be minutes."""
    text = ("axiom F start " + token * LONGEST)[:LONGEST]
    with spent() as taken, contextlib.suppress(LSystemError):
        read_found(text)
    assert taken.seconds < 30


DRAGON = read("angle: 90\naxiom: F X\nX -> X + Y F +\nY -> - F X - Y")


@pytest.mark.parametrize(
    "sentence",
    [
        "It can be specified with initial string FX, string rewriting rules X->X+YF+, Y->-FX-Y, and angle 90 degrees.",
        "The curve has the initial string FX, the string rewriting rules X→X+YF+ and Y→-FX-Y, and angle 90°.",
        'An L-system with initial string "FX", string rewriting rules "X"->"X+YF+", "Y"->"-FX-Y", and angle 90 degrees.',
    ],
)
def test_a_sentence_has_all_the_parts_that_it_names(sentence: str) -> None:
    found = read(sentence)
    assert same(found, DRAGON)
    assert not any("No axiom" in note or "no angle" in note for note in found.notes)


def test_items_of_latex_have_an_axiom_and_an_angle_with_their_letters() -> None:
    items = (r"\item Axiom: $\omega = F++F++F$", r"\item Production: $F \rightarrow F-F++F-F$", r"\item $\delta = 60^\circ$")
    assert same(read("\n".join((r"\begin{itemize}", *items, r"\end{itemize}"))), KOCH)


@pytest.mark.parametrize(
    "text",
    [
        "Axiom: F++F++F.\nF → F-F++F-F.\nAngle: 60.",
        "angle: 60\naxiom: F++F++F\nF → F-F++F-F.",
        "Start: F++F++F\nRule: F -> F-F++F-F.\nAngle: 60°.",
    ],
)
def test_a_full_stop_at_the_end_of_a_line_is_left_out_and_this_is_said(text: str) -> None:
    found = read(text)
    assert same(found, KOCH)
    assert any("full stop" in note for note in found.notes)


def test_the_points_of_a_polygon_are_no_full_stops() -> None:
    found = read("axiom: F\nF → {.+F.-F.}.")
    assert word(flat(found.productions[0].successor)).endswith("}.")


def test_a_rule_goes_on_below_where_its_symbols_are_those_of_the_system() -> None:
    found = read("n=4, δ=22.5◦\nF\nF→FF-[-F+F+F]+\n[+F-F-F]\n25")
    assert word(flat(found.productions[0].successor)) == "FF-[-F+F+F]+[+F-F-F]"
    assert any(note.startswith('"25" is left out') for note in found.notes)


@pytest.mark.parametrize(("first", "second", "said"), [("0.6", "0.4", "as probabilities."), ("0.6", "0.7", "are 1.3, not 1.")])
def test_a_number_in_brackets_apart_before_an_arrow_is_a_probability(first: str, second: str, said: str) -> None:
    found = read(f"Axiom: F\nF ({first}) → F[+F]F\nF ({second}) → F[-F]F\nAngle: 25°")
    assert [str(rule.probability) for rule in found.productions] == [first, second]
    assert any(note.endswith(said) for note in found.notes)


def test_a_value_before_an_arrow_stays_one_where_the_symbol_has_values() -> None:
    found = read("axiom: F(0.5)\nF (0.5) -> F(1)")
    assert found.productions[0].probability is None


@pytest.mark.parametrize("word", ["initiator", "Axiome", "Startwort"])
def test_no_note_says_that_no_axiom_is_given_where_the_text_speaks_of_one(word: str) -> None:
    with pytest.raises(ModelSyntaxError, match="I cannot read this axiom"):
        read(f"Take as its {word} any closed polygon that you like\nRule: F => F+F--F+F")


def test_no_note_says_that_no_angle_is_given_where_the_text_speaks_of_one() -> None:
    found = read("Start: F\nRule: F => F+F\nWe choose the angle by eye, as always.")
    assert "the angle cannot be read: it is 90" in found.notes[0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Variables: F\nAxiom: F\nRules:\nAngle: 60°", "There is no rule in this text"),
        ("X → F[+X]F\nF → FF\nangle 20°", "There is no axiom"),
        ("Home → Fractals → L-systems\nPosted by Anna", "There is no L-system in this text"),
        ("S → aSb | ε", "This is a grammar of a formal language, and no L-system"),
        ("x = 9^9^9^9\naxiom: A", '"9^9^9^9" has no value'),
    ],
)
def test_a_text_without_a_system_is_refused_by_what_it_lacks(text: str, message: str) -> None:
    with pytest.raises(LSystemError) as found:
        read(text)
    assert found.value.message.startswith(message)
    assert found.value.hint or message.startswith('"')


def test_a_rule_that_is_not_read_is_told() -> None:
    found = read("Start: F\nRule: F => F+G\nLater we also try what Anna found, where G -> G+F holds.")
    assert [rule.predecessor.symbol for rule in found.productions] == ["F"]
    assert '"G -> G+F" is not read: it stands in a sentence.' in found.notes


def test_a_table_of_symbols_and_what_replaces_them_has_rules() -> None:
    table = "| Symbol | Replacement |\n|---|---|\n| X | F+[[X]-X]-F[-FX]+X |\n| F | FF |\n\nAxiom: X, angle: 25°"
    assert same(read(table), PLANT)


CALCULATED = (
    'f"F{x}"',
    '"F" * 2',
    '"F" if x else "G"',
    '() => "F"',
    "t => f(t)",
    "lambda t: t",
    "next_word",
    '"F".replace("F", "G")',
    "None",
    "re.sub('x', 'y', 'F')",
    "''.join(['F', '+', 'F'])",
    "-> { 'F' }",
    '["F", pick()]',
    '"F%sF" % turn',
    '"F" + turn',
    'turn + "F"',
    'turn(3) + "F"',
    '"F#{turn}F"',
    '"F${turn}F"',
    '"F\\(turn)F"',
    'paste0("F", turn)',
)
"""What stands in programs in place of a word, and is none."""


@pytest.mark.parametrize("value", CALCULATED)
@pytest.mark.parametrize("id", PLAIN[::7])
def test_a_word_that_a_program_calculates_is_never_passed_over(id: str, value: str) -> None:
    """One after another, each word of a system is taken away."""
    meant = system(id)
    rules = [(rule.predecessor.symbol, json.dumps("".join(map(str, rule.successor)))) for rule in meant.productions]
    for index, (head, _) in enumerate(rules) if len(rules) > 1 else ():
        said = ", ".join(f'"{symbol}": {value if at == index else word}' for at, (symbol, word) in enumerate(rules))
        with pytest.raises(LSystemError) as caught:
            read(f'axiom = "{word(meant.axiom)}"\nrules = {{{said}}}')
        assert caught.value.message in (f"The word for {head} is calculated here", "This is a program")


@pytest.mark.parametrize(
    "sentence",
    [
        "(+ turns right, - turns left)",
        '"-" means turn left 90°, and "+" means turn right 90°.',
        "+ : rotate clockwise\n- : rotate counter-clockwise",
        "+ bedeutet Drehung nach rechts",
        "+ signifie « tourner à droite de 90° »",
        '- significa "girar a la izquierda", + significa "girar a la derecha"',
    ],
)
def test_turns_have_the_sense_that_the_text_gives_them(sentence: str) -> None:
    said = read(f"Axiom: F\nRules: F → F+F-G\nangle: 90\n{sentence}")
    assert str(said) == str(read("axiom: F\nF -> F-F+G\nangle: 90"))
    assert "In this text + turns right and - left: they are exchanged here." in said.notes


@pytest.mark.parametrize(
    "sentence", ["+ means turn left 90°, - means turn right 90°.", "A turn right is made by F", "Turn right + 90°"]
)
def test_turns_stay_where_no_sentence_says_otherwise(sentence: str) -> None:
    assert str(read(f"Axiom: F\nRules: F → F+F-G\nangle: 90\n{sentence}")) == str(read("axiom: F\nF -> F+F-G\nangle: 90"))


@pytest.mark.parametrize(
    ("text", "note"),
    [
        (
            "Angle: 22\nAxiom: F\nRules: F=C0FF-[C1-F]",
            "The digits 0, 1 are read as symbols, which draw nothing. A value is typed in brackets: C(0).",
        ),
        (
            "start: F; rule: F => F2F",
            "The digit 2 is read as a symbol, which draws nothing. A value is typed in brackets: C(2).",
        ),
        (
            "axiom: A\nA -> A B...",
            'The "." after the production for A is read as a command of the turtle; a line needs no sign at its end.',
        ),
        ("Start: F\nF => F+F\nstarting angle: 45", '"starting angle" (45) is not taken over.'),
        ('{"axiom": "F", "startAngle": 45, "rules": {"F": "F+F"}}', '"startAngle" (45) is not taken over.'),
        ("Premise: A\nRule 1: A=T[&FA]FA", "Houdini's T, which bends a branch by gravity, does nothing here."),
        ('{axiom = "fA", rules_a = "fA"}', "Minetest's f, which places leaves, only moves here."),
        ('{axiom = "A", rules_a = "FA"}', "The rule that is named after a is that of A."),
        ("ω : F\np1 : F(i) → F(i)[+F(i)]\n[edit]", '"[edit]" is left out: it is not surely a part of the rule above it.'),
        (
            "ω : F\np1 : F → F[+F]F\nLetter to the editor",
            '"Letter to the editor" is left out: it is not surely a part of the rule above it.',
        ),
        ("Start: F\nF => F+F grows fast\nangle: 60", 'Behind the rule of F, "grows fast" is left out.'),
        (
            "Start: F\nF => F+F (60%)\nF => F-F (60%)",
            "The probabilities of F are together 1.2, not 1: they are taken as shares.",
        ),
        ("K {\n Angle 25.7\n Axiom F\n F=F+F\n}", 'Fractint passes over what stands behind the point: "Angle 25.7" is 25.'),
        (
            "axiom: F\nF -> F[+F] | F[-F]",
            '"|" turns the turtle around. For a choice write a rule for each successor: A -> B : 0.5, A -> C : 0.5.',
        ),
    ],
)
def test_what_is_not_as_the_text_may_mean_it_is_said(text: str, note: str) -> None:
    assert note in read(text).notes


@pytest.mark.parametrize(
    "text",
    ["Start: F\nF => F+F\nangle jitter: 0", "variables: 0 1\nStart: 0\n1 => 11\n0 => 1[0]0", "axiom: F\nF -> F + F | F - F"],
)
def test_nothing_is_said_of_what_changes_nothing(text: str) -> None:
    assert not [note for note in read(text).notes if "taken over" in note or "digits" in note or "|" in note]


def test_a_command_of_latex_that_is_not_known_is_no_word() -> None:
    with pytest.raises(ModelSyntaxError, match="I do not know this command of LaTeX"):
        read("Axiom: F, Rule: F \\to F\\mycommand F, angle $60^\\circ$")


def test_contexts_in_the_word_that_is_made_are_refused_by_name() -> None:
    with pytest.raises(ModelSyntaxError, match="L-Py's contexts with << are not in the kit"):
        read("Axiom: B A\nproduction:\nB << A --> B\nendlsystem")


@pytest.mark.parametrize("word", ['f"F{x}F"', '"F" * 2', '"F%sF" % "+"', '"F" + turn'])
def test_a_word_that_a_program_calculates_is_refused_where_it_is_the_only_one(word: str) -> None:
    with pytest.raises(ModelSyntaxError, match="The word for F is calculated here"):
        read(f'axiom = "F"\nrules = {{"F": {word}}}')


def test_an_axiom_that_a_program_calculates_is_refused() -> None:
    with pytest.raises(ModelSyntaxError, match="The word for axiom is calculated here"):
        read('axiom = "F" + turn\nrules = {"F": "FF"}')


def test_a_loop_over_the_axiom_is_no_axiom() -> None:
    with pytest.raises(ModelSyntaxError, match="This is a program") as found:
        read('for c in axiom: print(c)\naxiom = "F"\nrules = {"F": "FF"}')
    assert "axiom: F | F -> F F" in str(found.value.hint)


def test_a_function_among_rules_is_refused() -> None:
    with pytest.raises(ModelSyntaxError, match="The word for A is calculated here"):
        systems_in_literals('axiom = "A"; rules = [["B", "A"], ["A", () => "AB"]]')


def test_what_is_no_rule_among_rules_is_passed_over() -> None:
    for rules in ('[["F", "FF", [1]]]', '{"F": {"FF": [1], "F+F": "x"}}'):
        assert not [each.rules for each in systems_in_literals(f'{{"axiom": "F", "rules": {rules}}}') if each.rules]


def test_a_letter_that_turns_both_ways_does_not_turn() -> None:
    found = read("axiom: B\nrules: (B → BF), (F → FF)\nB means turn left\nB means turn right")
    assert not found.interpretation
