"""The systems behind drawings: found from strokes in any order and direction, moved, turned and enlarged.

Systems are those of The Algorithmic Beauty of Plants (figures 1.6 to 1.9 and 1.24), with the angles of its captions, and of the
catalogue.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from lsys_kit import ModelLimitError, ModelValueError, derive, draw, infer, limits, read, system
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.inference import infer as infer_module
from lsys_kit.geometry.inference.infer import DrawingFits
from lsys_kit.geometry.inference.strokes import angle_between, read_drawings
from lsys_kit.geometry.sameness import normalised, same_strokes
from lsys_kit.geometry.scene import Floats
from lsys_kit.notation.model.system import LSystem

TO = 1e-9
PLANTS = {
    "1.24a": "angle: 25.7\naxiom: F\nF -> F[+F]F[-F]F",
    "1.24b": "angle: 20\naxiom: F\nF -> F[+F]F[-F][F]",
    "1.24c": "angle: 22.5\naxiom: F\nF -> FF-[-F+F+F]+[+F-F-F]",
    "1.24d": "angle: 20\naxiom: X\nX -> F[+X]F[-X]+X\nF -> FF",
    "1.24e": "angle: 25.7\naxiom: X\nX -> F[+X][-X]FX\nF -> FF",
    "1.24f": "angle: 22.5\naxiom: X\nX -> F-[[X]+X]+F[+FX]-X\nF -> FF",
    "one branch": "angle: 30\naxiom: F\nF -> F[+F]F",
    "the other": "angle: 30\naxiom: F\nF -> F[-F]F",
    "three stems": "angle: 35\naxiom: F[+F]F\nF -> F[+F]F",
    "a bush": "angle: 36\naxiom: X\nX -> F[+X][X]-X",
}
CURVES = {
    "T2": "angle: 60\naxiom: F--F--F\nF -> F+F--F+F",
    "K3": "angle: 60\naxiom: F\nF -> F-F++F-F",
    "1.6": "axiom: F-F-F-F\nF -> F-F+F+FF-F-F+F",
    "1.7b": "axiom: -F\nF -> F+F-F-F+F",
    "1.9d": "axiom: F-F-F-F\nF -> FF-F--F-F",
    "1.9e": "axiom: F-F-F-F\nF -> F-FF--F-F",
    "1.9f": "axiom: F-F-F-F\nF -> F-F+F-F-F",
    "Levy": "angle: 45\naxiom: F\nF -> +F--F+",
    "a line": "axiom: F\nF -> FF",
}
LARGE = {
    "1.9a": "axiom: F-F-F-F\nF -> FF-F-F-F-F-F+F",
    "1.9b": "axiom: F-F-F-F\nF -> FF-F-F-F-FF",
    "1.9c": "axiom: F-F-F-F\nF -> FF-F+F-F-FF",
}


def strokes_of(model: LSystem, step: int) -> Floats:
    return scene_of(derive(model, step)).segments.ends


def disarranged(strokes: Floats, chance: random.Random) -> list[list[float]]:
    """Strokes in another order, some of them begun at the other end, moved, turned and enlarged."""
    turn, size, right, up = chance.uniform(0, 6), chance.uniform(0.1, 10), chance.uniform(-9, 9), chance.uniform(-9, 9)
    by = size * np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    moved = (strokes @ np.kron(np.eye(2), by) + [right, up, right, up]).tolist()
    rows = [[u, v, x, y] if chance.random() < 0.5 else [x, y, u, v] for x, y, u, v in moved]
    chance.shuffle(rows)
    return rows


def draws_alike(mine: LSystem, wanted: LSystem, steps: int) -> bool:
    return all(
        same_strokes(*(normalised(strokes_of(each, step).tolist()) for each in (mine, wanted)), TO) for step in range(steps + 1)
    )


def found_again(rules: str, steps: int = 3) -> DrawingFits:
    """What is found from the drawings of a system; each draws them, and the next."""
    wanted, chance = read(rules), random.Random(rules)
    fits = infer([disarranged(strokes_of(wanted, step), chance) for step in range(steps + 1)])
    assert isinstance(fits, DrawingFits)
    assert fits, str(fits)
    assert all(draws_alike(fit, wanted, steps + 1) for fit in fits)
    return fits


@pytest.mark.slow
@pytest.mark.parametrize("name", [*PLANTS, *CURVES])
def test_a_system_is_found_from_its_strokes(name: str) -> None:
    found_again({**PLANTS, **CURVES}[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", LARGE)
def test_curves_whose_strokes_lie_on_one_another_are_found_too(name: str) -> None:
    found_again(LARGE[name])


TWO_SYMBOLS = {
    "1.10b, arrowhead": ("angle: 60\naxiom: F_r\nF_l -> F_r+F_l+F_r\nF_r -> F_l-F_r-F_l", 3, 12),
    "1.11a, Gosper": (
        "angle: 60\naxiom: F_l\nF_l -> F_l+F_r++F_r-F_l--F_l F_l-F_r+\nF_r -> -F_l+F_r F_r++F_r+F_l--F_l-F_r",
        3,
        2,
    ),
    "dragon of X and Y": ("axiom: F X\nX -> X+Y F+\nY -> -F X-Y", 4, 8),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", TWO_SYMBOLS)
def test_curves_of_two_symbols_that_draw_are_found(name: str) -> None:
    rules, steps, systems = TWO_SYMBOLS[name]
    fits = found_again(rules, steps)
    assert len(fits) == systems
    assert all({"F_l", "F_r"} == {rule.predecessor.symbol for rule in fit.productions} for fit in fits)


@pytest.mark.slow
def test_the_dragon_curve_is_found_from_five_pictures_and_not_from_four() -> None:
    rules = "axiom: F_l\nF_l -> F_l+F_r+\nF_r -> -F_l-F_r"
    pictures = [disarranged(strokes_of(read(rules), step), random.Random(step)) for step in range(5)]
    assert str(infer(pictures[:4])).splitlines()[0] == "16 systems draw these 4 pictures; they part at step 4:"
    fits = infer(pictures)
    assert str(fits).splitlines()[0] == "8 systems draw these 5 pictures; as far as was looked, later pictures are the same:"
    assert ["F_l -> F_l+F_r+", "F_r -> -F_l-F_r"] in [[str(rule) for rule in fit.productions] for fit in fits]
    assert all(draws_alike(fit, read(rules), 5) for fit in fits)


def test_two_symbols_that_draw_need_four_pictures() -> None:
    rules, *_ = TWO_SYMBOLS["1.10b, arrowhead"]
    fits = infer([strokes_of(read(rules), step) for step in range(3)])
    assert str(fits).endswith("Rules for F_l and F_r are looked for from 4 pictures on.")


def test_three_symbols_that_draw_are_not_found() -> None:
    rules = "angle: 60\naxiom: F_a\nF_a -> F_b+F_c+F_a\nF_b -> F_a-F_c-F_c\nF_c -> F_c F_a+F_b"
    homomorphism = "\ninterpretation:\nF_a -> F\nF_b -> F\nF_c -> F"
    fits = infer([strokes_of(read(rules + homomorphism), step) for step in range(4)])
    assert str(fits).endswith("Their strokes do not stand where a rule for F, or rules for F_l and F_r, would put them.")


@pytest.mark.parametrize("name", ["1.24a", "1.24b", "one branch", "the other"])
def test_a_plant_is_found_as_it_is_printed(name: str) -> None:
    [fit] = found_again(PLANTS[name])
    wanted = read(PLANTS[name])
    assert (fit.axiom, fit.angle) == (wanted.axiom, wanted.angle)
    assert str(fit.productions[0]).replace(" ", "") == str(wanted.productions[0]).replace(" ", "")


def test_pictures_and_scenes_are_drawings() -> None:
    plant = system("K5")
    fits = infer([draw(plant, step) for step in range(3)])
    assert [*fits] == [*infer([scene_of(derive(plant, step)) for step in range(3)])]
    assert str(fits) == "\n".join(["One system draws these 3 pictures:", "  angle: 25.7", "  axiom: F", "  F -> F[+F]F[-F]F"])


def test_an_angle_of_which_others_are_multiples_may_be_none_of_them() -> None:
    """Here of strokes that lie 45, 60 and 75 degrees apart."""
    assert angle_between(read_drawings([strokes_of(read("angle: 15\naxiom: F ++++ F +++ F"), 0)])) == 15


def test_an_angle_can_be_told() -> None:
    pictures = [strokes_of(read("angle: 90\naxiom: F\nF -> F[+F]F"), step) for step in range(3)]
    assert [str(fit).splitlines()[0] for fit in infer(pictures, angle=45)] == ["angle: 45"]
    assert not infer(pictures, angle=60)


def test_strokes_measured_with_small_errors_will_do() -> None:
    chance = np.random.default_rng(1)
    pictures = [strokes_of(read(PLANTS["one branch"]), step) for step in range(4)]
    assert infer([each + chance.normal(0, 1e-4, each.shape) for each in pictures], angle=30)


def test_systems_that_part_later_are_told_so() -> None:
    fits = infer([[(0, 0, 0, 1)], [(0, 0, 0, 1), (0, 1, 1, 1)]])
    assert str(fits).splitlines()[0] == f"{len(fits)} systems draw these 2 pictures; they part at step 2:"
    later = infer([strokes_of(read(CURVES["T2"]), step) for step in range(4)])
    assert "as far as was looked, later pictures are the same:" in str(later)


def test_many_systems_are_not_all_shown() -> None:
    pictures = [strokes_of(read("angle: 10\naxiom: F\nF -> F+F"), step) for step in range(2)]
    fits = infer(pictures)
    assert str(fits).splitlines()[-1] == f" and {len(fits) - 20} more"


ONE, TWO = [(0, 0, 0, 1)], [(0, 0, 0, 1), (0, 1, 1, 1)]


@pytest.mark.parametrize(
    ("pictures", "why"),
    [
        ([ONE, TWO, TWO], "They have 1, 2, 2 strokes: a rule that replaces each stroke by so many others multiplies them"),
        ([ONE, [(0, 0, 0, 1), (5, 5, 5, 6)]], "The strokes of step 1 do not hang together."),
        ([[], ONE], "Where the first picture is empty, the next two are needed"),
        ([[], ONE, [*TWO, (9, 9, 9, 10)]], "Their strokes do not stand where a rule"),
        ([ONE, TWO, [*TWO, (1, 1, 1, 2), (5, 5, 5, 6)]], "Their strokes do not stand where a rule"),
    ],
)
def test_a_refusal_says_why(pictures: Sequence[Any], why: str) -> None:
    fits = infer(pictures)
    assert not fits
    assert str(fits).startswith(f"No system was found that draws these {len(pictures)} pictures. {why}")


@pytest.mark.parametrize(
    ("pictures", "choices", "message"),
    [
        ([ONE], {}, "Rules are found from two pictures at least; there is one"),
        ([ONE, [(0, 0, 0, 1), (0, 1, 0, 4)]], {}, "The strokes of step 1 differ in length"),
        ([ONE, [(0, 0, 0, 0)]], {}, "The strokes of step 1 differ in length"),
        ([ONE, [(0, 0, 1)]], {}, "The drawing of step 1 must be a picture in the plane"),
        ([ONE, "F+F"], {}, "The drawing of step 1 must be a picture in the plane"),
        ([ONE, [(0, 0, 0, float("nan"))]], {}, "The drawing of step 1 must be a picture in the plane"),
        ([ONE, TWO], {"context": (1, 0)}, "Erasing and contexts are for words, and these are pictures"),
        ([ONE, TWO], {"erasing": True}, "Erasing and contexts are for words, and these are pictures"),
        ([ONE, TWO], {"angle": 0}, "The angle is from 1 to 180 degrees, not 0"),
        ([ONE, TWO], {"angle": "1/0"}, '"1/0" has no value'),
        (["a", "ab"], {"angle": 90}, "An angle is for pictures, and these are words"),
    ],
)
def test_what_cannot_be_used_is_said(pictures: Sequence[Any], choices: dict[str, Any], message: str) -> None:
    with pytest.raises(ModelValueError) as refused:
        infer(pictures, **choices)
    assert refused.value.message.startswith(message)


def test_what_is_too_much_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ModelLimitError, match="The drawings up to step 0 have more than 20,000 strokes"):
        infer([np.tile([0.0, 0, 0, 1], (20_001, 1)), ONE])
    monkeypatch.setattr(infer_module, "MOST_FITS", 3)
    with pytest.raises(ModelLimitError, match="More than 3 systems draw these 2 pictures") as refused:
        infer([ONE, TWO])
    assert len(refused.value.partial) == 4  # type: ignore[arg-type]


def test_a_search_that_takes_too_long_keeps_what_it_found() -> None:
    pictures = [strokes_of(read(LARGE["1.9c"]), step) for step in range(3)]
    with limits(seconds=0.2), pytest.raises(ModelLimitError) as refused:
        infer(pictures)
    assert isinstance(refused.value.partial, DrawingFits)
