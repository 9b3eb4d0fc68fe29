"""The turtle in space: laws first, then the seeds' figures."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, ModelValueError, derive, limits, read, system
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.scene import CIRCLE, DISC, OWN, SPHERE
from lsys_kit.geometry.turtle.commands import in_plane, initial_colour
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.geometry.turtle.space import RENORMALISATION_INTERVAL, SPACE_HANDLERS, SpaceTurtle, operand, trace_in_space
from lsys_kit.geometry.turtle.surfaces import surfaces
from lsys_kit.geometry.turtle.turtle import run_turtle
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production

LISTINGS = Path(__file__).parents[1] / "listings"


def word_of(modules, turtle="abop", **settings):
    axiom = tuple(Pattern(symbol, tuple(map(Number, values))) for symbol, *values in modules)
    return derive(LSystem(axiom, (), turtle=turtle, **settings), 0)[0]


def drawn(text, **settings):
    """The scene of modules that are parted by blanks, such as `F(2)` or `RU(45)`."""
    modules = []
    for part in text.split():
        symbol, _, values = part.partition("(") if part != "(" else (part, "", "")
        modules.append((symbol, *(float(value) for value in values.rstrip(")").split(",") if value)))
    return trace_in_space(word_of(modules, **settings))


def frame_after(text, **settings):
    """Heading, left and up after some commands, as three strokes show them."""
    turns = ("+(90)", "^(90)") if settings.get("turtle", "abop") == "abop" else ("RU(90)", "RL(-90)")
    ends = drawn(f"{text} [ F(1) ] [ {turns[0]} F(1) ] [ {turns[1]} F(1) ]", **settings).segments.ends[-3:]
    return ends[:, 3:] - ends[:, :3]


degrees = st.integers(-720, 720).map(lambda tenths: tenths / 4)
lengths = st.integers(0, 40).map(lambda tenths: tenths / 10)


def command(symbols, values=None):
    return st.tuples(st.sampled_from(symbols), *([] if values is None else [values]))


WIDTHS = {
    "abop": command("#!;,'")
    | command("#!", lengths)
    | command(";,'", st.integers(0, 9))
    | command(("@D", "@Di", "@Dd"), st.integers(0, 30).map(lambda tenths: tenths / 10)),
    "grogra": command(("D", "P", "L"))
    | command(("D", "D+", "D*", "L", "L+", "Ll", "Dl", "F+"), lengths)
    | command(("L*", "Ll*", "Dl*", "F*"), st.integers(0, 15).map(lambda tenths: tenths / 10))
    | command("P", st.integers(0, 15))
    | command("N")
    | command(("@",), st.integers(0, 4).map(lambda part: part / 4)),
    "plant-string": st.nothing(),
    "fractint": command("C<>", st.integers(0, 300))
    | command("<>C")
    | command(("@", "@I", "@Q", "@IQ"), st.integers(1, 30).map(lambda tenths: tenths / 10)),
}
STROKES = {
    "abop": command("FfGg+-") | command("Ff", lengths) | command("+-", degrees) | command("|"),
    "grogra": command(("F", "f", "+", "-", "RU")) | command("Ff", lengths) | command(("RU",), degrees),
    "plant-string": command("IAB+-"),
    "fractint": command("FGDM+-|!") | command("\\/", degrees),
}
SHAPES = {
    "abop": command("{.}")
    | command(("@o", "@c", "@O"), lengths)
    | command(("@o", "@c", "@B"))
    | st.tuples(st.just("@B"), lengths, lengths)
    | st.just(("/", 180))
    | st.just(("\\", -540))
    | st.tuples(st.just("@L"), lengths),
    "grogra": st.just(("RH", 180)),
    "plant-string": command("LF"),
    "fractint": st.nothing(),
}
TURNS = {
    "abop": command("&^\\/") | command("&^\\/", degrees),
    "grogra": command(("RL", "RH")) | command(("RL", "RH"), degrees),
    "plant-string": st.nothing(),
    "fractint": st.nothing(),
}
TRADITIONS = list(STROKES)


def branched(commands, brackets=(("[", "]"),)):
    """Words of some commands, with branches in them."""
    return st.recursive(
        st.lists(commands, max_size=8),
        lambda inner: st.lists(
            st.one_of(inner, *(inner.map(lambda word, pair=pair: [(pair[0],), *word, (pair[1],)]) for pair in brackets)),
            max_size=4,
        ).map(lambda parts: [module for part in parts for module in part]),
        max_leaves=12,
    )


def pairs(tradition):
    return (("[", "]"), ("(", ")")) if tradition == "plant-string" else (("[", "]"),)


flat_words = st.sampled_from(TRADITIONS).flatmap(
    lambda tradition: st.tuples(
        st.just(tradition), branched(STROKES[tradition] | WIDTHS[tradition] | SHAPES[tradition], pairs(tradition))
    )
)
free_words = st.sampled_from(TRADITIONS).flatmap(
    lambda tradition: st.tuples(
        st.just(tradition),
        branched(STROKES[tradition] | WIDTHS[tradition] | TURNS[tradition] | SHAPES[tradition], pairs(tradition)),
    )
)


def extent(scene):
    least, greatest = scene.corners
    return max(1.0, float(np.abs(least).max()), float(np.abs(greatest).max()))


def same(one, other, at_most=1e-9):
    """Whether two scenes in space have the same shapes in the same places."""
    near = at_most * extent(one)
    return (
        len(one.segments) == len(other.segments)
        and len(one.polygons) == len(other.polygons)
        and np.allclose(one.segments.ends, other.segments.ends, rtol=0, atol=near)
        and np.allclose(one.segments.widths, other.segments.widths, rtol=1e-12)
        and (one.segments.colours == other.segments.colours).all()
        and np.allclose(one.polygons.points, other.polygons.points, rtol=0, atol=near)
        and np.allclose(one.discs.centres, other.discs.centres, rtol=0, atol=near)
    )


@given(flat_words, degrees, degrees)
def test_the_turtles_in_the_plane_and_in_space_agree(found, angle, heading):
    tradition, modules = found
    word = word_of(modules, tradition, angle=angle, heading=heading)
    assert in_plane(word.states.system)
    flat, whole = place_path(trace(word), angle, heading), trace_in_space(word)
    near, plane = 1e-9 * extent(whole), [0, 2]
    assert np.abs(whole.segments.ends[:, [1, 4]]).max(initial=0) <= near
    assert np.allclose(flat.segments.ends, whole.segments.ends[:, [0, 2, 3, 5]], rtol=0, atol=near)
    assert np.allclose(flat.polygons.points, whole.polygons.points[:, plane], rtol=0, atol=near)
    assert np.allclose(flat.discs.centres, whole.discs.centres[:, plane], rtol=0, atol=near)
    assert np.allclose(flat.labels.points, whole.labels.points[:, plane], rtol=0, atol=near)
    assert flat.labels.texts == whole.labels.texts
    assert (flat.labels.states == whole.labels.states).all()
    for kind, details in (
        ("segments", "orders states widths colours"),
        ("polygons", "starts states colours"),
        ("discs", "radii kinds states colours"),
    ):
        for detail in details.split():
            assert (getattr(getattr(flat, kind), detail) == getattr(getattr(whole, kind), detail)).all()
    assert flat.unknown == whole.unknown


@pytest.mark.slow
@given(free_words, degrees, st.data())
def test_a_branch_brings_the_turtle_back(found, angle, data):
    tradition, modules = found
    plain = [module for module in modules if module[0] not in "{.}"]
    branch = [("[",), *data.draw(branched(STROKES[tradition] | WIDTHS[tradition] | TURNS[tradition])), ("]",)]
    at = data.draw(st.integers(0, len(plain)))
    words = [word_of(word, tradition, angle=angle) for word in (plain, [*plain[:at], *branch, *plain[at:]])]
    assume(len({initial_colour(word.states.system) for word in words}) == 1)  # steps need another start
    start, without, whole = map(trace_in_space, (word_of(plain[:at], tradition, angle=angle), *words))
    before, added = len(start.segments), len(whole.segments) - len(without.segments)
    for part in ("ends", "widths", "colours", "orders"):
        rows = np.delete(getattr(whole.segments, part), range(before, before + added), axis=0)
        assert np.allclose(rows, getattr(without.segments, part), rtol=0, atol=1e-9 * extent(whole))


@given(free_words, degrees, degrees)
def test_turning_the_start_turns_the_picture(found, angle, heading):
    tradition, modules = found
    straight, turned = (trace_in_space(word_of(modules, tradition, angle=angle, heading=start)) for start in (90, heading))
    cos, sin = math.cos(math.radians(heading - 90)), math.sin(math.radians(heading - 90))
    rotation = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    near = 1e-9 * extent(straight)
    assert np.allclose(straight.segments.points @ rotation, turned.segments.points, rtol=0, atol=near)
    assert np.allclose(straight.polygons.points @ rotation, turned.polygons.points, rtol=0, atol=near)


ONCE_ROUND = {
    "abop": [[(symbol, 360)] for symbol in "+-&^/\\"] + [[("|",), ("|",)]],
    "grogra": [[(symbol, 360)] for symbol in ("RU", "RL", "RH")],
    "plant-string": [[("+",)] * 5],
    "fractint": [[("+",)] * 5, [("\\", 360)], [("!",), ("!",)]],
}


@given(free_words, st.data())
def test_once_round_changes_nothing(found, data):
    tradition, modules = found
    at = data.draw(st.integers(0, len(modules)))
    round_ = data.draw(st.sampled_from(ONCE_ROUND[tradition]))
    words = [word_of(word, tradition, angle=72) for word in (modules, [*modules[:at], *round_, *modules[at:]])]
    assume(("@B",) not in {module[:1] for module in modules} or len({in_plane(word.states.system) for word in words}) == 1)
    assert same(*map(trace_in_space, words))  # a box is a rectangle where nothing leaves the plane


@given(branched(STROKES["grogra"] | TURNS["grogra"]), st.sampled_from(("RU", "RL", "RH")), degrees, st.data())
def test_a_turn_and_its_opposite_change_nothing(modules, symbol, angle, data):
    at = data.draw(st.integers(0, len(modules)))
    there_and_back = [*modules[:at], (symbol, angle), (symbol, -angle), *modules[at:]]
    assert same(*(trace_in_space(word_of(word, "grogra")) for word in (modules, there_and_back)))


@given(branched(STROKES["abop"] | TURNS["abop"]), st.sampled_from(("+-", "&^", "\\/")), degrees)
def test_the_commands_of_abop_come_in_opposite_pairs(modules, pair, angle):
    there_and_back = [(pair[0], angle), (pair[1], angle), *modules]
    assert same(*(trace_in_space(word_of(word)) for word in (modules, there_and_back)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("tradition", "symbols"), [("abop", "+-&^\\/|$[]F"), ("grogra", ("+", "-", "RU", "RL", "RH", "RV", "$", "[", "]", "F"))]
)
def test_a_frame_stays_orthonormal_in_a_million_commands(tradition, symbols):
    chance = np.random.default_rng(7)
    axes = [["+"], ["^"]] if tradition == "abop" else [["RU"], ["RL"]]
    modules = [(symbol,) for symbol in symbols]
    modules += [("+" if tradition == "abop" else "RU", 90), ("^" if tradition == "abop" else "RL", 90)]
    states = word_of(modules, tradition, angle=math.degrees(0.7)).states
    numbered = {str(module): number for number, module in enumerate(states.modules)}
    axis = [numbered["F"]], [numbered[f"{axes[0][0]}(90)"], numbered["F"]], [numbered[f"{axes[1][0]}(90)"], numbered["F"]]
    shown = [number for way in axis for number in (numbered["["], *way, numbered["]"])]
    codes = [*chance.integers(0, len(symbols), 1_000_000).tolist(), *shown]
    ends = trace_in_space(Word(states, codes)).segments.ends[-3:]
    frame = (ends[:, 3:] - ends[:, :3]) / (1 if tradition == "abop" else 100)
    assert np.abs(frame @ frame.T - np.eye(3)).max() < 1e-9


@pytest.mark.parametrize("symbol", ["+", "&", "/"])
def test_a_frame_that_is_not_orthonormal_is_made_so_after_so_many_rotations(symbol):
    turtle = SpaceTurtle(((1e-3, 0.0, 1.0), (-1.0, 2e-3, 0.0), (0.0, -1.0, 5e-4), 0), 1.0)
    word = word_of([(symbol, 1)] * (RENORMALISATION_INTERVAL + 1))
    run_turtle(turtle, word, SPACE_HANDLERS, lambda instruction: operand(instruction, 90))
    frame = np.array(turtle.orientation[:3])
    assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(frame) == pytest.approx(1)


def test_abops_turtle_starts_with_its_left_to_the_left_and_its_back_to_the_viewer():
    assert frame_after("").tolist() == [[0, 0, 1], [-1, 0, 0], [0, -1, 0]]


def test_grogras_turtle_starts_with_its_left_to_the_right_and_shows_its_other_side():
    assert frame_after("", turtle="grogra").tolist() == [[0, 0, 1], [1, 0, 0], [0, 1, 0]]


@given(degrees)
def test_abops_commands_turn_as_their_names_say(angle):
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    head, left, up = frame_after("")
    assert np.allclose(frame_after(f"+({angle})")[0], cos * head + sin * left), "+ turns left"
    assert np.allclose(frame_after(f"&({angle})")[0], cos * head - sin * up), "& pitches down"
    assert np.allclose(frame_after(f"\\({angle})")[2], cos * up + sin * left), "\\ rolls left"


@given(degrees)
def test_grogras_rotations_are_right_handed(angle):
    """The columns of each matrix are the new left, up and head in terms of the old (systems of seed 003)."""
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    matrices = {
        "RU": [[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]],
        "RL": [[1, 0, 0], [0, cos, -sin], [0, sin, cos]],
        "RH": [[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]],
    }
    for symbol, matrix in matrices.items():
        head, left, up = frame_after(f"{symbol}({angle})", turtle="grogra")
        assert np.allclose(np.column_stack([left, up, head]), matrix)


def test_rotations_follow_one_another_in_the_turtles_own_axes():
    assert frame_after("+(90) &(90)")[0] == pytest.approx([0, 1, 0])
    assert frame_after("&(90) +(90)")[0] == pytest.approx([-1, 0, 0])


@given(st.integers(1, 179), degrees, st.sampled_from(("abop", "grogra")))
def test_a_level_turtle_has_its_left_level_and_its_up_upwards(tilt, roll, tradition):
    away, over = ("&", "/") if tradition == "abop" else ("RL", "RH")
    before = frame_after(f"{over}({roll}) {away}({tilt}) {over}({2 * roll + 1})", turtle=tradition)
    head, left, up = frame_after(f"{over}({roll}) {away}({tilt}) {over}({2 * roll + 1}) $", turtle=tradition)
    assert head == pytest.approx(before[0])
    assert left[2] == pytest.approx(0, abs=1e-9)
    assert up[2] > 0
    assert np.cross(head, left) == pytest.approx(up)


def test_a_vertical_turtle_cannot_be_levelled():
    assert frame_after("/(30) $").tolist() == frame_after("/(30)").tolist()


def tilt_after(text):
    """How many degrees GROGRA's turtle looks away from the vertical."""
    return math.degrees(math.acos(frame_after(text, turtle="grogra")[0][2]))


@pytest.mark.parametrize(("strength", "tilt"), [(0, 60), (0.2, 70.893), (0.5, 90), (1, 120)])
def test_rv_bends_down_by_its_strength(strength, tilt):
    assert tilt_after(f"RU(60) RV({strength})") == pytest.approx(tilt, abs=1e-3)
    assert tilt_after(f"RH(20) RL(60) V({strength}) RV") == pytest.approx(tilt, abs=1e-3)


@given(st.integers(1, 179), st.integers(-30, 30), degrees)
def test_rv_makes_the_head_that_of_head_less_strength_times_vertical(tilt, tenths, roll):
    text = f"RH({roll}) RL({tilt})"
    head = frame_after(text, turtle="grogra")[0]
    wanted = head - (0, 0, tenths / 10)
    bent = frame_after(f"{text} RV({tenths / 10})", turtle="grogra")
    assert bent[0] * np.linalg.norm(wanted) == pytest.approx(wanted, abs=1e-9)
    assert bent @ bent.T == pytest.approx(np.eye(3), abs=1e-9)


def test_rv_leaves_a_vertical_head_or_turns_it_round():
    assert tilt_after("RV(0.9)") == 0
    assert tilt_after("RV(1.1)") == 180
    assert tilt_after("RU(180) RV(3)") == 180


def test_rg_looks_straight_down():
    assert tilt_after("RH(40) RL(70) RG") == pytest.approx(180, abs=1e-6)


@pytest.mark.parametrize("elasticity", [0.05, 0.22, -0.1])
def test_a_tropism_bends_by_e_times_the_sine(elasticity):
    """ABOP, page 58: after each stroke by e |H x T|, here towards gravity."""
    ends = drawn(f"@Ts({elasticity}) +(60) F F F").segments.ends
    ways = ends[:, 3:] - ends[:, :3]
    tilts = np.arctan2(-ways[:, 0], ways[:, 2])
    assert np.diff(tilts) == pytest.approx(elasticity * np.sin(tilts[:-1]))


def test_a_tropism_is_written_as_in_cpfg_and_may_have_a_direction():
    assert same(drawn("@Ts(0.2) &(50) F F"), drawn("@Ts(1,0.2) &(50) F F"))
    upwards = drawn("@Ts(1,0.2,0,1,0) +(60) F F F F F F F F F F").segments.ends
    assert upwards[-1, 5] - upwards[-1, 2] > math.cos(math.radians(20))
    sideways = drawn("@Ts(1,0.3,1,0,0) F F").segments.ends[1]
    assert sideways[3] == pytest.approx(math.sin(0.3)), "x is to the right"


def test_a_tropism_ends_with_its_branch_and_by_0():
    scene = drawn("[ @Ts(0.5) +(90) F F ] +(90) F F @Ts(0.5) F @Ts(0) F F")
    ways = scene.segments.ends[:, 3:] - scene.segments.ends[:, :3]
    assert ways[2:5].tolist() == [[-1, 0, 0]] * 3
    assert ways[5] == pytest.approx(ways[6])


def test_a_jump_is_to_a_point_as_cpfg_counts_it():
    assert drawn("@M(1,2,3) F").segments.ends.tolist() == [[1, -3, 2, 1, -3, 3]]


def test_grogras_at_goes_back_on_the_last_stroke():
    ends = both(
        word_of(
            [("F", 10), ("[",), ("@", 0.5), ("RU", 90), ("F", 1), ("@", 0), ("F", 2), ("]",), ("f", 4), ("@",), ("F", 3)],
            "grogra",
        )
    )
    assert ends == pytest.approx(np.array([[0, 0, 0, 10], [0, 5, 1, 5], [0, 5, 2, 5], [0, 10, 0, 13]]))


def test_grogras_lengths():
    scene = drawn("F F(20) F+(5) F*(2) L(10) F L+(5) F L*(2) F Ll(7) Ll+(1) F F L F [ L(1) F ] F", turtle="grogra")
    made = np.linalg.norm(scene.segments.ends[:, 3:] - scene.segments.ends[:, :3], axis=1)
    assert made == pytest.approx([100, 20, 105, 200, 10, 15, 30, 8, 30, 100, 1, 100])
    assert drawn("F L F", turtle="grogra", length=30).height == pytest.approx(60)


def test_grogras_widths_and_colours():
    segments = drawn("F D+(3) F D(2) F D*(1.5) F Dl(9) F F D F P(4) F P F", turtle="grogra").segments
    assert segments.widths == pytest.approx([0.1, 3.1, 2, 3, 9, 3, 0.1, 0.1, 0.1])
    assert segments.colours.tolist() == [14] * 7 + [4, 14], "yellow is the first colour of GROGRA"
    assert drawn("F D(2) F", turtle="grogra").segments.colours.tolist() == [OWN] * 2


def test_abops_widths_and_colours():
    segments = drawn("F !(2) F ! F # F [ #(5) ;(3) F ] F ' F ; F , F ,(7) F").segments
    assert segments.widths == pytest.approx([2.4, 2, 1.4, 2, 5, *[2] * 5])
    assert segments.colours.tolist() == [16, 16, 16, 16, 3, 16, 17, 18, 17, 7]


def test_colours_step_along_a_ramp_and_stay_at_its_ends():
    assert drawn("F ' F " + "' " * 20 + "F ' F , F").segments.colours.tolist() == [16, 17, 23, 23, 22]
    assert drawn(", F , F").segments.colours.tolist() == [16, 16]
    assert drawn(";(14) ' F ' F ;(0) , F").segments.colours.tolist() == [15, 15, 0]
    assert drawn("F ;(5) F").segments.colours.tolist() == [OWN, 5]


def test_a_polygon_has_a_corner_at_the_end_of_each_f_and_none_at_that_of_g():
    (polygon,) = drawn("F { . f + F + G(3) | G(3) | . }", angle=90).polygons
    assert polygon[:, [0, 2]].tolist() == [[0, 1], [0, 2], [-1, 2], [-1, 2]]


def test_what_is_no_polygon_is_not_drawn():
    assert len(drawn("{ F F } } F { . + F").polygons) == 0


def test_a_nested_polygon_keeps_the_corners_of_the_outer_one():
    inner, outer = drawn("{ f { f + f + f } f - f }").polygons
    assert inner[:, [0, 2]].tolist() == [[0, 2], [-1, 2], [-1, 1]]
    assert outer[:, [0, 2]].tolist() == [[0, 1], [-1, 0], [-2, 0]]


def test_brackets_do_not_end_a_polygon():
    """ABOP, section 5.2: the edges of a cordate leaf, with a triangle between neighbouring ones."""
    leaf = read("angle: 15\naxiom: [A][B]\nA -> [+A{.].C.}\nB -> [-B{.].C.}\nC -> G C")
    scene = trace_in_space(derive(leaf, 6)[-1])
    assert len(scene.polygons) == 2 * 6, "one on each side at each step"
    assert all(len(polygon) == 3 for polygon in scene.polygons)
    assert all((polygon[1] == 0).all() for polygon in scene.polygons), "all meet at the base"


def test_circles_discs_and_spheres_are_as_wide_as_their_number_or_a_stroke():
    discs = drawn("F @o(2) F @c f @O(1) #(3) @o ;(2) @c(-4)").discs
    assert discs.kinds.tolist() == [CIRCLE, DISC, SPHERE, CIRCLE, DISC]
    assert discs.radii == pytest.approx([1, 0.05, 0.5, 1.5, 2])
    assert discs.centres[:, 2].tolist() == [1, 2, 3, 3, 3]
    assert discs.colours.tolist() == [OWN] * 4 + [2]


def test_a_roll_by_half_a_turn_stays_in_the_plane_and_any_other_leaves_it():
    assert in_plane(read("axiom: F[+F]/(180)F\nF -> F\\(-540)F"))
    assert not in_plane(read("axiom: F[+F]/F"))
    assert not in_plane(read("axiom: F\nF(t) -> F/(t)F"))


@pytest.mark.parametrize("symbol", ["&", "^", "$", "@v", "@Ts", "@M"])
def test_a_command_that_leads_out_of_the_plane_is_seen_in_rules_and_interpretations(symbol):
    apex = Pattern("A")
    growing, leading = Production((apex,), (Pattern("F"), apex)), Production((apex,), (Pattern(symbol), apex))
    assert in_plane(LSystem((apex,), (growing,)))
    assert not in_plane(LSystem((apex,), (leading,)))
    assert not in_plane(LSystem((apex,), (growing,), interpretation=(leading,)))


def test_what_a_sign_means_in_one_tradition_does_not_count_in_another():
    assert in_plane(read("turtle: grogra\naxiom: F / F & F"))
    assert not in_plane(read("axiom: F / F & F"))


def test_too_many_open_brackets_are_an_error():
    with limits(brackets=10), pytest.raises(ModelLimitError, match="More than 10 brackets"):
        drawn("[ " * 20 + "F")
    with limits(brackets=10), pytest.raises(ModelLimitError, match="More than 10 brackets"):
        drawn("{ " * 20 + "F")


def test_a_step_that_grows_out_of_reach_is_an_error():
    with pytest.raises(ModelValueError, match="The turtle's step grows too large to draw"):
        drawn("L*(1e20) " * 4 + "F", turtle="grogra")


def test_a_word_without_strokes_is_an_empty_scene_in_space():
    assert str(drawn("+ - X")) == "nothing to draw, width 0, height 0, depth 0"


def test_interpretation_rules_are_drawn_and_strokes_know_their_module():
    word = derive(read("axiom: A(2) F\ninterpretation:\nA(t) -> F(t) & F"), 0)[0]
    assert trace_in_space(word).segments.states.tolist() == [0, 0, 1]


def test_another_angle_may_be_asked_for():
    word = derive(read("angle: 30\naxiom: &F"), 0)[0]
    assert trace_in_space(word).segments.ends[0, 4] == pytest.approx(0.5)
    assert trace_in_space(word, 90).segments.ends[0, 4] == pytest.approx(1)


def listing(name, steps):
    """A step of a listing of seed 003, as printed."""
    return derive(read((LISTINGS / f"003-{name}.grogra.txt").read_text(encoding="utf-8"), "grogra"), steps)[-1]


def both(word):
    """The strokes in the plane as the turtle in space draws them, after a look at what that in the plane draws."""
    scene, found = place_path(trace(word), float(word.states.system.angle)), trace_in_space(word)
    assert in_plane(word.states.system)
    ends = found.segments.ends[:, [0, 2, 3, 5]]
    assert np.allclose(scene.segments.ends, ends, rtol=0, atol=1e-9 * extent(found))
    return ends


@pytest.mark.parametrize("step", range(1, 7))
def test_kochs_curve_of_k3_is_bent_upwards(step):
    ends = both(listing("koch", step))
    assert len(ends) == 4 ** (step - 1)
    assert ends[0, :2].tolist() == [0, 0]
    assert ends[-1, 2:] == pytest.approx([100 * 0.9999 ** (step - 1), 0], abs=1e-9)
    if step > 1:
        assert ends[:, 3].max() == pytest.approx(100 / math.sqrt(12) * 0.9999, rel=1e-3)
        assert ends[:, 3].min() >= -1e-9


def test_kochs_curve_after_six_steps_has_the_measures_of_kurths_picture():
    ends = both(listing("koch", 6))
    assert ends[-1, 2] == pytest.approx(99.95, abs=5e-3)
    assert ends[:, 3].max() == pytest.approx(28.85, abs=5e-3)


@pytest.mark.parametrize("step", range(1, 7))
def test_sierpinskis_triangle_of_k4_has_the_same_corners_at_each_step_and_closes(step):
    ends = both(listing("sierpinski", step))
    assert len(ends) == 2 * 3**step
    corners = ends.reshape(-1, 2)
    assert ends[-1, 2:] == pytest.approx([0, 0], abs=1e-9)
    assert corners.min(axis=0) == pytest.approx([0, 0], abs=1e-9)
    assert corners.max(axis=0) == pytest.approx([200, 100 * math.sqrt(3)])
    assert corners[corners[:, 1].argmax()] == pytest.approx([100, 100 * math.sqrt(3)])


def test_the_branches_of_k6_stand_on_both_sides_in_turn_and_each_is_half_as_long():
    ends = both(listing("alternate-branches", 24))
    stem, branches = ends[::2], ends[1::2]
    assert stem[:, 3].max() == pytest.approx(200, abs=1e-4)
    assert branches[:4, 2].tolist() == pytest.approx([50, -25, 12.5, -6.25])
    assert branches[:4, 3].tolist() == pytest.approx([100, 150, 175, 187.5])


def test_the_branches_of_k2_stand_to_the_right():
    ends = both(listing("branch", 3))
    branches = ends[ends[:, 2] > ends[:, 0] + 1]
    assert len(branches) == 3
    assert branches[0, 2:] - branches[0, :2] == pytest.approx([100 / math.sqrt(2)] * 2)


def test_the_pseudo_plant_of_k5_is_three_times_as_high_at_each_step():
    for step in range(5):
        ends = both(listing("pseudo-plant", step))
        assert len(ends) == 5**step
        assert ends[-1, 2:] == pytest.approx([0, 100 * 3**step])


def test_the_branches_of_k11_are_longer_towards_the_tip():
    ends = both(listing("acrotony", 3))
    branches = [math.hypot(*(end[2:] - end[:2])) for end in ends if abs(end[2] - end[0]) > 1]
    assert branches == pytest.approx([100, 200, 300, 400, 500])


def test_many_meristems_of_k12_make_a_tree_with_the_measures_of_its_rules():
    scene = trace_in_space(listing("meristems", 15))
    assert scene.corners[1][2] == pytest.approx(1400)
    assert scene.segments.widths.max() == pytest.approx(0.1 + 13 * 3)
    assert scene.dimension == 3
    assert scene.unknown == ()


def test_the_dichotomy_of_k20_doubles():
    assert [len(both(listing("dichotomy", step))) for step in range(1, 6)] == [1, 3, 7, 15, 31]


@pytest.mark.parametrize("step", range(5))
def test_kochs_snowflake_closes(step):
    ends = trace_in_space(derive(system("T2"), step)[-1]).segments.ends
    assert len(ends) == 3 * 4**step
    assert ends[-1, 3:] == pytest.approx([0, 0, 0], abs=1e-9)


@pytest.mark.parametrize("step", range(1, 13))
def test_the_dragon_ends_where_its_halves_say(step):
    """Its ends are sqrt(2) times as far apart at each step, and each time 45 degrees further round (ABOP, figure 1.10)."""
    dragon = read("angle: 90\nheading: 0\naxiom: F\nF -> F+G\nG -> F-G\ninterpretation:\nG -> F")
    x, _, z = trace_in_space(derive(dragon, step)[-1]).segments.ends[-1, 3:]
    assert complex(x, z) == pytest.approx((1 + 1j) ** step)


def test_the_plant_string_of_l1_branches_to_both_sides():
    scene = trace_in_space(derive(system("L1"), 1)[-1])  # I[A]I(I)
    ends = scene.segments.ends[:, [0, 2, 3, 5]]
    made = np.hypot(*(ends[:, 2:] - ends[:, :2]).T)
    assert made == pytest.approx([1, 2 / 3, 1, 1])
    assert ends[1, 2] < 0 < ends[3, 2]
    assert scene.segments.orders.tolist() == [0, 1, 0, 1]


def test_lychnis_stands_in_space_with_leaves_and_flowers():
    """ABOP, page 84: pairs of leaves, each at right angles to the one before."""
    lychnis = system("K19")
    assert not in_plane(lychnis)
    scene = trace_in_space(derive(lychnis, 5)[-1])
    least, greatest = scene.corners
    assert greatest[1] - least[1] > 1
    leaf, flower = (len(surfaces()[name].facets.faces) for name in ("leaf", "flower"))
    assert len(scene.polygons) == 2 * leaf + flower, "two leaves and a flower of age 4; those on the branch are of age 0"
    assert scene.unknown == ()


@settings(max_examples=20)
@given(free_words)
def test_the_states_of_a_word_say_what_was_drawn(found):
    word = word_of(found[1], found[0])
    symbols = {word.states.modules[state].symbol for state in trace_in_space(word).segments.states}
    assert symbols <= {"F", "G", "F+", "F*", "I", "A", "B", "D"}
