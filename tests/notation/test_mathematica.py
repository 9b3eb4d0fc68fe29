"""Mathematica's notation, after seed 000: its listings run, and what is written in it reads back as the same system."""

from __future__ import annotations

import re
import tomllib
from fractions import Fraction
from pathlib import Path

import pytest

from lsys_kit.derivation.derive import derive
from lsys_kit.errors import ModelNameError
from lsys_kit.notation.dialects.mathematica.dialect import MATHEMATICA
from lsys_kit.notation.dialects.mathematica.expressions import KNOWN
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import recognise
from lsys_kit.notation.write import write

LISTINGS = Path(__file__).parents[1] / "listings"
TABLE = {listing["file"]: listing for listing in tomllib.loads((LISTINGS / "listings.toml").read_text("utf-8"))["listing"]}
SYSTEMS = [file for file, listing in TABLE.items() if listing["notation"] == "mathematica" and listing["kind"] == "system"]
PASSED_OVER = "Ignored, because the kit prints and draws by itself: "


def printed(file: str) -> str:
    return (LISTINGS / file).read_text("utf-8")


def corrected(file: str) -> str:
    """A listing without its errata."""
    text = printed(file)
    for correction in TABLE[file]["corrections"]:
        assert text.count(correction["printed"]) == 1
        text = text.replace(correction["printed"], correction["corrected"])
    return text


def spelt(word: object) -> str:
    """A word as the catalogue and the listings both spell it: without brackets and blanks, in small letters."""
    return re.sub(r"[\[\] ]", "", str(word)).lower()


def rules(*bodies: str, axiom: str = "a[1], b") -> str:
    return f"axiom = AXIOM[{axiom}];\nlrules = LRULES[{', '.join(f'LRule[{body}]' for body in bodies)}];"


def rule(body: str) -> Production:
    """The production of an LRule."""
    (production,) = read(f"w = 11;\n{rules(body)}").productions
    return production


# The listings of seed 000 ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("file", SYSTEMS)
def test_a_corrected_listing_derives_its_words(file: str) -> None:
    system, listing = read(corrected(file)), TABLE[file]
    derivation = derive(system, max([step for step, _ in listing["expected"]] + [len(listing.get("counts", "1")) - 1]))
    assert [spelt(derivation[step]) for step, _ in listing["expected"]] == [spelt(word) for _, word in listing["expected"]]
    counts = listing.get("counts", [])
    assert [len(word) for word in derivation][: len(counts)] == counts


@pytest.mark.parametrize("file", SYSTEMS)
def test_a_listing_is_recognised_as_printed_and_as_corrected(file: str) -> None:
    for text in (printed(file), corrected(file)):
        system = read(text)
        assert (system.notation, system.notes[0]) == ("mathematica", "Read as mathematica.")
        assert read(str(system)) == system


@pytest.mark.parametrize("file", [file for file in TABLE if TABLE[file]["notation"] != "mathematica"])
def test_a_listing_in_another_notation_is_not_recognised(file: str) -> None:
    assert recognise(printed(file)) is not MATHEMATICA


def test_as_printed_the_hormone_passes_one_cell_less() -> None:
    """J2: the axiom has lost an a, so that all cells are c two steps after they should be d."""
    system = read(printed("000-ILSystem1.mathematica.txt"))
    words = [spelt(word) for word in derive(system, 13)]
    assert (words[0], words[7], words[13]) == ("baaaaaad", "cccccccd", "cddddddd")


def test_as_printed_the_layer_sticks_at_its_width() -> None:
    """J3: the third rule waits for an a[15], which never comes."""
    words = [spelt(word) for word in derive(read(printed("000-ILSystem2.mathematica.txt")), 30)]
    assert words[10] == "".join(f"a{i}" for i in range(1, 12)) + "b"
    assert set(words[10:]) == {words[10]}


def test_as_printed_figure_3_is_figure_2() -> None:
    """J5: the life times that are set are not those that the rules read; a note says that nothing uses them."""
    two, three = (read(printed(f"000-figure-{number}.mathematica.txt")) for number in (2, 3))
    assert [str(word) for word in derive(two, 15)] == [str(word) for word in derive(three, 15)]
    assert 'The constant "devTimeA" is used nowhere.' in three.notes
    assert derive(read(corrected("000-figure-3.mathematica.txt")), 9)[-1] != derive(two, 9)[-1]


@pytest.mark.parametrize(
    ("file", "steps"),
    [
        ("000-anabaena", 6),
        ("000-ILSystem1", 15),
        ("000-ILSystem2", 30),
        ("000-ILSystem3", 9),
        ("000-figure-2", 10),
        ("000-figure-3", 15),
    ],
)
def test_a_run_says_how_many_steps(file: str, steps: int) -> None:
    assert read(printed(f"{file}.mathematica.txt")).steps == steps


@pytest.mark.parametrize(
    ("file", "note"),
    [
        ("000-anabaena", "The comma after the last LRule is ignored."),
        ("000-ILSystem1", '"baaaaaad" is read as b a a a a a a d.'),
        ("000-ILSystem2", PASSED_OVER + "ColumnForm."),
        ("000-ILSystem3", PASSED_OVER + "postProcessingFunction, ColumnForm."),
        ("000-figure-3", '"ILSYSTEM3" is read as "ILSystem3".'),
        ("000-figure-3", PASSED_OVER + "postProcessingFunction, CellLayerPlot."),
    ],
)
def test_what_is_forgiven_or_passed_over_is_told(file: str, note: str) -> None:
    assert note in read(printed(f"{file}.mathematica.txt")).notes


def test_the_form_of_a_rule_is_a_rule() -> None:
    system = read(f"AXIOM[l, p, r];\n{printed('000-rule-form.mathematica.txt')}")
    assert [str(word) for word in derive(system, 1)] == ["l p r", "l s r"]


def test_definitions_that_draw_are_passed_over() -> None:
    """Seed 000, String interpretation: formats, functions, upvalues, and what is done with them."""
    text = """<< kLSystems.ma
        Format[AXIOM[x___]] := SequenceForm[x]
        interpret[{x_,y_,l_}, aL ] :=
          {x+2,y,Append[l,ArrowedCircle[{x+1, y}, {1,.5}, Direction -> Left]]};
        disksAndCircles = Map[interpret,anabaenaGrowth];
        maxX = Max[Cases[disksAndCircles,Circle[x___], Infinity] /. Circle[{x_,_},_] :> x];
        aL/: CellCircle[aL, {{x_,y_},g_List}] :=

          {{x+2,y}, Append[g,ArrowedDisk[{x+1,y},{1,0.5}, Direction -> Left]]}
        CellLayerGraphics[anabaenaGrowth] // Short
        Show[% // Last // Last, AspectRatio -> Automatic];
        """
    system = read(printed("000-anabaena.mathematica.txt").replace("skipPattern", text + "skipPattern"))
    assert system == read(printed("000-anabaena.mathematica.txt"))
    assert system.notes[-1] == (
        PASSED_OVER + "kLSystems, Format, interpret, disksAndCircles, maxX, CellCircle, CellLayerGraphics, Show."
    )


# What a text says -----------------------------------------------------------------------------------------------------


def test_a_printed_rule_is_an_lrule() -> None:
    text = """w = 11;
        axiom = AXIOM[a[1], b];
        lrules = LRULES[
          LRule[LEFT[a[i_ /; i < w]], PRED[b], RIGHT[], SUCC[a[1 + i], b]],
          LRule[LEFT[], PRED[a[i_ /; i > 1]], RIGHT[c], SUCC[c]],
          LRule[LEFT[a[15]], PRED[b], RIGHT[], SUCC[c]],
          LRule[LEFT[c], PRED[b], RIGHT[], SUCC[]],
          LRule[LEFT[a[i_ /; i > 1]], PRED[c], RIGHT[], SUCC[]],
          LRule[LEFT[a[1]], PRED[c], RIGHT[], SUCC[b]]];
        run[LSystem[axiom, lrules], 30]"""
    assert read(text) == read(printed("000-ILSystem2.mathematica.txt"))


@pytest.mark.parametrize("arrow", ["->", "→"])
def test_a_printed_rule_has_an_arrow(arrow: str) -> None:
    assert read(f"Axiom: ab\nRules: a < b > {arrow} ba\na {arrow}").productions == (
        Production((Pattern("b"),), (Pattern("b"), Pattern("a")), left=(Pattern("a"),)),
        Production((Pattern("a"),), ()),
    )


def test_a_name_of_several_letters_stays_whole_between_commas() -> None:
    assert [
        len(read(text).axiom)
        for text in ("axiom = AXIOM[ab]; LRule[LEFT[], PRED[a], RIGHT[], SUCC[b]]", "Axiom: ab\nRules: a -> b")
    ] == [1, 2]


def test_the_rules_may_stand_before_the_axiom() -> None:
    assert read("Rules: a -> b\nAxiom: a") == read("Axiom: a\nRules: a -> b")


def test_patterns_have_conditions_of_their_own() -> None:
    production = rule("LEFT[a[i_ /; i > 1]], PRED[M[t_, p_] /; t < w && p == 1], RIGHT[b[j_], c /; j != 0], SUCC[]")
    assert str(production) == "a(i) < M(t,p) > b(j)c : i > 1 && t < w && p == 1 && j != 0 -> ε"


def test_a_condition_may_stand_behind_any_parameter() -> None:
    assert rule("LEFT[], PRED[M[t_ /; t < w, p_ /; p == t]], RIGHT[], SUCC[b]") == rule(
        "LEFT[], PRED[M[t_, p_] /; t < w && p == t], RIGHT[], SUCC[b]"
    )


def test_a_value_is_asked_for_by_its_name() -> None:
    assert rule("LEFT[], PRED[a[w]], RIGHT[], SUCC[b]").predecessor == Pattern("a", (Name("w"),))
    assert rule("LEFT[], PRED[a[w + 1]], RIGHT[], SUCC[b]").predecessor == Pattern("a", (Apply("+", (Name("w"), Number(1))),))


def test_an_underscore_alone_stands_for_any_value() -> None:
    system = read(rules("LEFT[a[_]], PRED[M[_, t_]], RIGHT[], SUCC[M[t, t]]"))
    assert [str(module) for module in system.productions[0].parameters] == ["a(_1)", "M(_2,t)"]
    assert read(str(system)) == system


def test_a_comparison_may_go_on() -> None:
    assert rule("LEFT[], PRED[a[i_ /; 1 < i <= w != 5]], RIGHT[], SUCC[]") == rule(
        "LEFT[], PRED[a[i_ /; 1 < i && i <= w && w != 5]], RIGHT[], SUCC[]"
    )


def test_symbols_that_are_no_names_stand_in_quotation_marks() -> None:
    assert rule(r'LEFT[], PRED["+"[i_]], RIGHT["[", b, "]"], SUCC[F, "[", "+"[i], "\\", "L*"[0.5], "]"]') == Production(
        (Pattern("+", (Name("i"),)),),
        (
            *map(Pattern, ("F", "[")),
            Pattern("+", (Name("i"),)),
            Pattern("\\"),
            Pattern("L*", (Number(Fraction(1, 2)),)),
            Pattern("]"),
        ),
        right=tuple(map(Pattern, "[b]")),
    )


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("Sqrt[i]", "sqrt(i)"),
        ("Abs[i]", "abs(i)"),
        ("Floor[i]", "floor(i)"),
        ("Ceiling[i]", "ceil(i)"),
        ("Exp[i]", "exp(i)"),
        ("Log[i]", "log(i)"),
        ("Min[i, 1, 2]", "min(i, 1, 2)"),
        ("Max[i, 1]", "max(i, 1)"),
        ("Mod[i, 3]", "mod(i, 3)"),
        ("If[i > 1 || !(i == 0), 2, 3]", "if(i > 1 || !(i == 0), 2, 3)"),
        ("i^2", "i^2"),
        ("1.5*^-1 + 2. + .5", "0.15 + 2 + 0.5"),
        ("Sin[i Degree]", "sin(i)"),
        ("Cos[(i + 1)*Degree]", "cos(i + 1)"),
        ("Tan[2*i Degree]", "tan(2 * i)"),
        ("Sin[30°]", "sin(30)"),
        ("ArcSin[i]/Degree + 1", "asin(i) + 1"),
        ("2*(ArcTan[i]/Degree)", "2 * atan(i)"),
        ("ArcCos[i]/Degree*2", "acos(i) * 2"),
        ("Random[Real, {0, i}]", "uniform(0, i)"),
        ("RandomReal[{1, 2}]", "uniform(1, 2)"),
        ("Random[Real,{1,2}]", "uniform(1, 2)"),
        ("RandomVariate[NormalDistribution[i, 1]]", "normal(i, 1)"),
        ("RandomVariate[BinomialDistribution[4, 0.5]]", "binomial(4, 0.5)"),
        ("RandomVariate[PoissonDistribution[i]]", "poisson(i)"),
        ("RandomChoice[{1, i} -> {0, 1}]", "table(1, i)"),
    ],
)
def test_functions_are_those_of_mathematica(text: str, same: str) -> None:
    system = read(rules(f"LEFT[], PRED[a[i_]], RIGHT[], SUCC[a[{text}]]"))
    assert system.productions == read(f"axiom: a(1)\na(i) -> a({same})").productions
    assert read(str(system)) == system


def test_every_function_that_is_written_is_read() -> None:
    counts = {"if": 3, "min": 2, "max": 2, "mod": 2, "uniform": 2, "normal": 2, "binomial": 2, "table": 2}
    for function in KNOWN:
        operands: tuple[Expression, ...] = (Number(1),) * counts.get(function, 1)
        if function == "if":
            operands = (Apply("<", (Number(1), Number(2))), *operands[1:])
        system = LSystem((Pattern("a"),), (Production((Pattern("a"),), (Pattern("b", (Apply(function, operands),)),)),))
        assert read(write(system, "mathematica")) == system, function


def test_comments_may_stand_in_comments() -> None:
    text = 'w = 11 (* of (* the layer (* of cells *) *); *); axiom (* first *) = AXIOM[a, "+" (* + *)] (* "*)'
    assert read(text, "mathematica").axiom == (Pattern("a"), Pattern("+"))


def test_a_range_stands_in_a_comment() -> None:
    text = "w = 11; (* 2 .. 15 by 1/2 *)\nv = 1; (* from 1 .. 6 by hand *)\naxiom = AXIOM[a];"
    constants = read(text, "mathematica").constants
    assert [str(constant) for constant in constants] == ["w = 11 in 2 .. 15 by 1/2", "v = 1"]


def test_a_definition_goes_on_where_it_cannot_end() -> None:
    text = "w =\n\n 3 +\n 4\naxiom\n := AXIOM[\n a[w]\n]\nRules: a[i_]\n -> b"
    assert read(text, "mathematica") == read("w = 3 + 4\naxiom: a(w)\na(i) -> b")


def test_definitions_may_stand_in_any_order() -> None:
    text = (
        "run[s, n];\ns = LSystem[start, grow];\ngrow := LRULES[first, LRule[LEFT[], PRED[b], RIGHT[], SUCC[a[w]]]];\n"
        "first = LRule[LEFT[], PRED[a[w]], RIGHT[], SUCC[b]];\nstart := AXIOM[a[w]];\nw = v + 1;\nn = 2*w;\nv = 1;"
    )
    system = read(text, "mathematica")
    assert [constant.name for constant in system.constants] == ["v", "w", "n"]
    assert (system.steps, [str(word) for word in derive(system, 3)]) == (4, ["a[2]", "b", "a[2]", "b"])


def test_the_last_definition_of_a_name_counts() -> None:
    system = read(f"w = 1;\nk := w;\n{rules('LEFT[], PRED[b], RIGHT[], SUCC[a[k]]', axiom='b')}\nw = 2;", "mathematica")
    assert str(derive(system, 1)[-1]) == "a[2]"
    assert system.notes == ('"w" is defined more than once: the last definition counts.',)


TWO = "s = LSystem[AXIOM[a], LRULES[]];\nt = LSystem[AXIOM[b], LRULES[]];\n"


@pytest.mark.parametrize(
    ("runs", "axiom", "note"),
    [
        ("", "b", "Several systems are defined and none is run: the last is read."),
        ("run[s, 3];", "a", "Several systems are defined: the last that is run is read."),
        ("run[t, 3];\nrunKLSYSTEM[s, 3]", "a", "Several systems are defined: the last that is run is read."),
        ("RunKLSystem[LSystem[AXIOM[c], LRULES[]], 3]", "c", "Several systems are defined: the last that is run is read."),
    ],
)
def test_of_several_systems_the_last_that_is_run_is_read(runs: str, axiom: str, note: str) -> None:
    system = read(TWO + runs, "mathematica")
    assert (str(system.axiom[0]), system.notes) == (axiom, (note,))


@pytest.mark.parametrize(
    ("text", "note"),
    [
        ("axiom = AXIOM[a]; run[lsystem, 3]", '"lsystem" is not defined: what the text defines is run.'),
        ("AXIOM[a]; LRule[LEFT[], PRED[a], RIGHT[], SUCC[]]; LRULES[]", "A rule outside of LRULES is not used."),
        ("axiom = AXIOM[a]; axiom", None),
        ("axiom = AXIOM[a]; growth", PASSED_OVER + "growth."),
        ("w = 3; axiom = AXIOM[a]", 'The constant "w" is used nowhere.'),
    ],
)
def test_notes_tell_what_is_odd(text: str, note: str | None) -> None:
    assert read(text, "mathematica").notes == ((note,) if note else ())


def test_what_contexts_pass_over() -> None:
    text = rules("LEFT[a[i_]], PRED[b], RIGHT[], SUCC[c]", axiom='a[1], F, "+", b')
    patterns = {'{F, "+"}': ("F", "+"), "{Null}": (), "{}": (), '{"Null"}': ("Null",), "{F}": ("F",)}
    for pattern, ignored in patterns.items():
        assert read(f"{text}\nskipPattern = {pattern};").ignored == ignored
    assert [str(derive(read(f"{text}\nskipPattern = {pattern};"), 1)[-1]) for pattern in ("{F}", '{F, "+"}')] == [
        'a[1] F "+" b',
        'a[1] F "+" c',
    ]


@pytest.mark.parametrize(
    ("test", "condition"),
    [
        ("EvenQ[n]", "mod(n, 2) == 0"),
        ("OddQ[n + 1]", "mod(n + 1, 2) == 1"),
        ("Positive[n]", "n > 0"),
        ("Negative[n]", "n < 0"),
        ("NonNegative[n]", "n >= 0"),
        ("NonPositive[n] && EvenQ[n]", "n <= 0 && mod(n, 2) == 0"),
    ],
)
def test_a_test_of_a_number_is_a_condition(test: str, condition: str) -> None:
    found = read(f"Axiom: a[4]\nRules: a[n_ /; {test}] -> a[n/2]b", "mathematica")
    assert str(found.productions[0].condition) == condition
    assert read(write(found, "mathematica"), "mathematica").productions == found.productions


def test_tests_that_the_kit_lacks_are_told_what_to_type() -> None:
    for test, instead in (("IntegerQ[n]", "Floor[x] == x"), ("Divisible[n, 3]", "Mod[n, 3] == 0")):
        with pytest.raises(ModelNameError, match=re.escape(instead)):
            read(f"Axiom: a[4]\nRules: a[n_ /; {test}] -> a[n/2]b", "mathematica")
