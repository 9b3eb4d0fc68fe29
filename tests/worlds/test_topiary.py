"""Topiary: query modules tell an apex where it is, and what is outside is cut off (Prusinkiewicz, James and Mech, 1994)."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import pairwise
from math import cos, hypot, isclose, radians, sin
from pathlib import Path

import pytest

from lsys_kit import derive, draw, explain, explore, growth, read, stages, system, write
from lsys_kit.__main__ import main
from lsys_kit.derivation.derive import derive as words_alone
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.scene import CIRCLE, DISC
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem

OUTSIDE = "x < -2.6 || x > 2.6 || y < 0 || y > 5.2"
BOX = "[;(5)^(90)f(1)&(90)+(90)F(2.6)[F(0.05)]-(90)F(5.2)[F(0.05)]-(90)F(5.2)[F(0.05)]-F(5.2)[F(0.05)]-F(2.6)]"
LABORATORY = f"""Lsystem: 1
derivation length: 30
consider: JFDA?P
Axiom: {BOX}X
X --> ;(1)!(0.08)F(1)A?P(0,0,0)
F(n) > A?P(x,y,z) : {OUTSIDE} --> JF(0.02)%
F(n) < A > ?P(x,y,z) : {OUTSIDE} --> *
A --> /(180)DF(1)A
D > J --> [+(32)/(180)F(1)A?P(0,0,0)]
F(n) > J --> JF(n)
F(n) > [J=] --> JF(n)
J --> *
endlsystem"""
"""The Virtual Laboratory's model; its production for F(n)A, two modules at once, is two productions here."""
WORDS = (Path(__file__).parent / "topiary.cpfg.txt").read_text(encoding="utf-8").splitlines()
"""What cpfg derives of it, step by step, without the box."""
NUMBER = re.compile(r"(?<=[(,])-?\d[\d.e+-]*")


def printed(word: Iterable[Module]) -> str:
    """A word as cpfg prints it: numbers with six digits."""
    return "".join(
        module.symbol + (f"({','.join(f'{float(v):g}' for v in module.arguments)})" if module.arguments else "")
        for module in word
    )


def shown(word: Iterable[Module]) -> str:
    """A word as the table of systems prints it: without its box, without what is cut off, and without values."""
    text = "".join(f"{module.symbol}" for module in word if module.symbol != "B")
    return re.sub(r"%\?P", "", text)


def apices(word: Iterable[Module]) -> int:
    return sum(module.symbol == "A" for module in word)


def test_the_model_of_the_virtual_laboratory_gives_the_words_of_cpfg() -> None:
    for word, expected in zip(derive(read(LABORATORY, "cpfg"), 30), WORDS, strict=True):
        text = printed(word).removeprefix(BOX)
        assert NUMBER.sub("", text) == NUMBER.sub("", expected)
        numbers = zip(map(float, NUMBER.findall(text)), map(float, NUMBER.findall(expected)), strict=True)
        assert all(isclose(a, b, rel_tol=1e-5, abs_tol=1e-8) for a, b in numbers)


def test_the_topiary_of_the_table_of_systems() -> None:
    words = [shown(word) for word in derive(system("K24"), 7)]
    assert words == [
        "FA?P",
        "F@oF/A?P",
        "F@oF/@oF/A?P",
        "F@oF/@oF/@oF/A?P",
        "F@oF/@oF/@oF/@oF/A?P",
        "F@oF/@oF/@oF/@oF/T",
        "F@oF/@oF/@oF/@oS/",
        "F@oF/@oF/@oF/[+FA?P]/",
    ]


@pytest.mark.slow
@pytest.mark.parametrize(("id", "size", "steps"), [("K24", 2, 20), ("K24", 4, 68), ("K24", 3, 40), ("K25", 4, 130)])
def test_what_grows_out_of_the_box_is_cut_off(id: str, size: int, steps: int) -> None:
    """In the end everything is inside, and no bud is left that a signal could wake."""
    choices = {"wakes": 1} if id == "K25" else {}
    derivation = derive(system(id), steps + 10, L=size, **choices)
    assert derivation[-1] == derivation[steps]
    assert derivation[-1].counts().keys() <= {"B", "F", "[", "]", "+", "/"}
    scene = scene_of(derive(bare(system(id)), steps, L=size, **choices)[-1])
    (left, *_), (right, *_) = scene.corners
    assert -size / 2 - 1e-9 <= left
    assert right <= size / 2 + 1e-9
    assert scene.height <= size + 1e-9
    assert len(scene.segments) > size


def bare(plant: LSystem) -> LSystem:
    """A plant without the outline that it is cut to, and without leaves."""
    return read(write(plant).split("interpretation:")[0].replace("axiom: B", "axiom:"))


SOLIDS = {
    1: lambda x, y, z: max(abs(x), abs(z), abs(y - 4)) - 4,
    2: lambda x, y, z: hypot(x, y - 4, z) - 4,
    3: lambda x, y, z: max(hypot(x, z) - (8 - y) / 2, -y),
    4: lambda x, y, z: max(hypot(x - 1.6 * sin(radians(90 * y)), z - 1.6 * cos(radians(90 * y))) - 2, abs(y - 4) - 4),
}
"""How far outside a solid that is 8 high a place is; negative inside."""


@pytest.mark.slow
@pytest.mark.parametrize("solid", SOLIDS)
def test_every_shoot_begins_inside_the_solid(solid: int) -> None:
    ends = scene_of(derive(bare(system("K25")), 100, solid=solid, wakes=4)[-1]).segments.ends
    assert len(ends) > 25
    assert max(SOLIDS[solid](x, z, -y) for x, y, z in ends[:, :3]) < 1e-6


@pytest.mark.slow
def test_more_buds_live_at_once_where_a_signal_wakes_more() -> None:
    living = [max(map(apices, derive(system("K25"), 60, wakes=wakes))) for wakes in (1, 2, 4)]
    assert living[0] == 1
    assert living == sorted(set(living))


@pytest.mark.slow
def test_a_plant_of_800_steps_is_more_than_wires() -> None:
    picture = draw(system("K25"), 70, L=10)
    assert len(picture.scene.segments) > 241, "of 800 steps where one bud lives at a time"
    leaves = len(picture.scene.polygons) / 2  # two halves each
    assert leaves > 200


def test_a_signal_goes_on_until_it_has_woken_so_many_buds() -> None:
    before = read(
        "consider: F @o S\naxiom: @o F @o F @o F S(2)\nF > S(n) -> S(n) F\n@o > S(n) : n > 1 -> S(n-1) b\n"
        "@o > S(n) -> b\nS(n) -> ε"
    )
    assert str(derive(before, 6)[-1]) == "@o F b F b F"


@pytest.mark.slow
def test_the_fir_tree_is_cut_to_its_outline() -> None:
    fir = derive(system("K24b"), 90)
    asked = [module.arguments[0] for word in fir for module in word if module.symbol == "?E"]
    assert min(asked) < 0 < max(asked)
    rows = scene_of(derive(bare(system("K24b")), 90)[-1]).segments.ends
    assert len(rows) > 100
    assert max(abs(rows[:, 0])) < 5, "every shoot begins inside"


def test_another_outline_in_the_text_cuts_another_shape() -> None:
    text = system("K24b").source
    first = text.index("polygon(")
    house = text[first : text.index(")", first) + 1]
    box = read(text.replace(house, "polygon(-2,0, 2,0, 2,4, -2,4)").replace("axiom: B", "axiom:"))
    words = [shown(word).replace("%?E", "").replace("?E", "?P") for word in derive(box, 5)]
    assert words == [shown(word) for word in derive(system("K24"), 5)]


def test_one_apex_grows_at_a_time() -> None:
    words = derive(system("K24"), 60)
    assert all(apices(word) + word.counts().get("T", 0) + word.counts().get("S", 0) <= 1 for word in words)
    heights = [module.arguments[1] for word in words[:6] for module in word if module.symbol == "?P"]
    assert heights == [0, 1, 2, 3, 4, 5]


def test_a_word_shows_the_last_answer_and_the_sight_the_next() -> None:
    derivation = derive(system("K24"), 8)
    for step, (word, after) in enumerate(pairwise(derivation)):
        sight = derivation.sight(step)
        assert sight
        assert [module.symbol for module in sight.word] == [module.symbol for module in word]
        answered = [module for module in sight.word if module.symbol == "?P"]
        assert answered == [m for m in after if m.symbol == "?P" and m.arguments != (0, 0)] or "%" in map(str, word)


def test_the_explanation_names_the_place() -> None:
    fate = next(fate for fate in explain(derive(system("K24"), 5), 5) if fate.module.symbol == "A")
    assert fate.production.startswith("production 1, A > ?P(x,y)")
    growing = next(fate for fate in explain(derive(system("K24"), 4), 4) if fate.module.symbol == "A")
    assert growing.refused[0].endswith("is false where L = 4, x = 0, y = 4")


def test_the_same_plant_in_cpfgs_notation() -> None:
    other = read(write(system("K24"), "cpfg"), "cpfg")
    assert list(map(printed, derive(other, 30))) == list(map(printed, derive(system("K24"), 30)))


def test_words_alone_leave_query_modules_as_they_are() -> None:
    assert str(words_alone(system("K24"), 6)[-1]).endswith("A?P(0,0)")


def test_a_system_that_asks_has_no_growth_matrix() -> None:
    apex = read("axiom: ?P(0,0) A\nA -> F A")
    assert derive(apex, 3).lengths == [2, 3, 4, 5]
    with pytest.raises(Exception, match="context-free systems"):
        growth(apex)
    assert "?P" in repr(stages(system("K24"))) or stages(system("K24")).grouped


def test_a_query_module_may_have_productions_of_its_own() -> None:
    counting = read("axiom: F ?P(0,0)\n?P(x,y) : y < 4 -> F ?P(0,0)\n?P(x,y) -> K(y)")
    assert str(derive(counting, 5)[-1]) == "F F F F K(4)"


@pytest.mark.slow
def test_the_shell_and_the_explorer_look_around(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["derive", "K24", "-n", "6"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "B F@o F/(180)@o F/(180)@o F/(180)@o S/(180)"
    assert main(["derive", "K24", "-n", "6", "--set", "L=3"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "B F@o F/(180)@o F/(180)[+F A?P(0,0)]/(180)"
    panel = explore("K24")
    panel.step = 6
    assert panel.sight.word.counts()["S"] == 1
    assert str(draw(system("K24"), 6)) == "4 segments, 1 polygon, 5 discs, width 4, height 4.2"


LEGEND = "small open circle is a sleeping bud, a cross is a cut, and a large filled circle is a signal"


@pytest.mark.parametrize("where", ["15_hedges_and_movement.ipynb", "teacher/15_hedges_and_movement.md"])
def test_the_legend_of_the_lesson_is_what_is_drawn(where: str) -> None:
    """Of K24 step 4 has buds alone, step 5 a cut at its end, and step 6 a signal."""
    assert LEGEND in (Path(__file__).parents[2] / "notebooks" / where).read_text("utf-8")
    words = derive(system("K24"), 6)
    buds, cut, signal = (scene_of(word) for word in words[4:7])
    assert set(zip(buds.discs.kinds, buds.discs.radii, strict=True)) == {(CIRCLE, 0.125)}
    first, second = cut.segments.ends[-2:]
    assert (first[:2] + first[2:]) == pytest.approx(second[:2] + second[2:]), "two strokes with the same middle"
    assert (first[2:] - first[:2]) @ (second[2:] - second[:2]) == pytest.approx(0)
    assert [(kind, radius) for kind, radius in zip(signal.discs.kinds, signal.discs.radii, strict=True) if radius > 0.125] == [
        (DISC, 0.2)
    ]
