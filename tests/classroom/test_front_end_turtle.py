"""The turtle in the browser draws what the turtle of the kit draws: the same shapes at the same points, for every angle."""

from __future__ import annotations

import functools
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Error

from lsys_kit import derive, read
from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.errors import ModelValueError
from lsys_kit.geometry.drawing import coloured
from lsys_kit.geometry.turtle.commands import COMMANDS, DrawingMode, Effect, drawing_mode
from lsys_kit.geometry.turtle.plane import PLANE_HANDLERS, place_path, trace
from lsys_kit.geometry.turtle.space import SPACE_HANDLERS, trace_in_space
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.draw import state_colours
from lsys_kit.pictures.rendering.frames import in_units
from lsys_kit.pictures.rendering.looks import numbered_colours
from tests.classroom.front_end import TURTLE, answers, book_of
from tests.shared_constants import CONSTANTS, script

MOST_MODULES, LAST_STEP = 5_000, 6
ANGLES = (17.3, 90.0, -144.5)
SHAPES = """
const plain = (value) => ArrayBuffer.isView(value) || Array.isArray(value) ? Array.from(value) : value;
const taken = (group) => Object.fromEntries(Object.entries(group).map(([name, value]) => [name, plain(value)]));
return given.map(({ book, angles }) => book.words.map((word, step) => {
  const opened = bookOf(book);
  return angles.map((angle) => {
    const { x, y, z, strokes, faces, rounds, labels, palette, typical } = placed(traced(opened, step), angle);
    const points = [x, y, z ?? []].map(plain);
    return { points, strokes: taken(strokes), faces: taken(faces), rounds: taken(rounds), labels: taken(labels),
      palette, typical };
  });
}));
"""


@pytest.fixture(scope="module")
def page(browser):
    return browser.new_page()


def scene_by_kit(word, angle):
    """The scene that the kit makes of a word, with the widths of its strokes in units."""
    made_by = word.states.system
    flat = drawing_mode(made_by) is DrawingMode.PLANE
    scene = place_path(trace(word), angle, float(made_by.heading)) if flat else trace_in_space(word, angle)
    return in_units([coloured(scene, made_by)], made_by)[0]


PATCH = (
    "@PS(1)"
    + "".join(f"[+({20 * row})f&({15 * column})f(2)@PC(1,{row},{column})]" for row in range(4) for column in range(4))
    + "@PD(1,2,3)F"
)


def test_natural_colours(page):
    trees = (
        "&F[&F[&(30)F]]F",
        "F!(4)F!(1)F[+!(0)F]",
        "!(0)F[+F]",
        "F[+F;(3)F]",
        "F[' ~L]' F ' @O(2)",
        "F ; F ;(30) F",
        "@Gs[]@Gc",
        "!(2)@GsF+F!(1)@Gc(3)&F[+F@GsF^F@Ge]^F@Ge",
        "@R(1,2,0)F@R(0,0,-1,1,0,0)[+F]&F",
        PATCH,
        "&" + "~P[f+~L(0.1)]" * 76,
    )
    expect_drawn(page, [[derive(read(f"colours: natural\naxiom: {tree}"), 0)[0]] for tree in trees], [25.0])


def expect_drawn(page, derivations, angles):
    """The browser draws the words of some derivations as the kit does, for each angle."""
    given = [{"book": book_of(words), "angles": angles} for words in derivations]
    for words, steps in zip(derivations, answers(page, SHAPES, given, *TURTLE), strict=True):
        for word, shown in zip(words, steps, strict=True):
            for angle, shapes in zip(angles, shown, strict=True):
                expect_same(shapes, scene_by_kit(word, angle), word, words[-1])


def expect_same(shapes, scene, word, last):
    points = np.array([axis for axis in shapes["points"] if axis]).T
    strokes, faces, rounds = shapes["strokes"], shapes["faces"], shapes["rounds"]
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    close = functools.partial(pytest.approx, rel=1e-9, abs=1e-9 * max(1.0, *map(np.ptp, scene.corners), np.abs(points).max()))
    ends = np.concatenate([points[strokes["from"]], points[strokes["to"]]], axis=1)
    assert ends == close(segments.ends)
    assert points[faces["corners"]].reshape(-1) == close(polygons.points.reshape(-1))
    assert points[rounds["centres"]].reshape(-1) == close(discs.centres.reshape(-1))
    assert points[shapes["labels"]["points"]].reshape(-1) == close(scene.labels.points.reshape(-1))
    assert tuple(shapes["labels"]["texts"]) == scene.labels.texts
    assert strokes["widths"] == pytest.approx(np.broadcast_to(segments.widths, len(segments)), rel=1e-9)
    assert rounds["radii"] == pytest.approx(discs.radii, rel=1e-9)
    assert (strokes["orders"], faces["starts"], rounds["kinds"]) == (
        segments.orders.tolist(),
        polygons.starts.tolist(),
        discs.kinds.tolist(),
    )
    for found, kept in ((strokes, segments), (faces, polygons), (rounds, discs)):
        assert found["states"] == kept.states.tolist() == [word.codes[place] for place in found["positions"]]
        names, numbers = numbered_colours(kept.states, kept.colours, state_colours(last))
        assert shapes["palette"] == names
        assert found["colours"] == np.broadcast_to(numbers, len(kept)).tolist()


def expect_refused(page, word, sentence):
    with pytest.raises(ModelValueError, match=sentence):
        scene_by_kit(word, 90)
    with pytest.raises(Error, match=sentence):
        answers(page, SHAPES, [{"book": book_of([word]), "angles": [90]}], *TURTLE)


TURTLES = [id for id in systems() if drawing_mode(system(id)) is not DrawingMode.FILAMENT]


@pytest.mark.parametrize("id", TURTLES)
def test_every_drawing_of_the_catalogue(page, id):
    words = list(derive(system(id), LAST_STEP, seed=1))
    expect_drawn(page, [[word for word in words if len(word) <= MOST_MODULES]], [float(system(id).angle), *ANGLES])


VALUES = st.sampled_from([-2, -0.5, 0, 0.25, 0.5, 1, 2, 3, 7.3, 30, 45, 90, 120, 180])


GENTLE = st.sampled_from([-0.5, 0, 0.25, 0.5])
"""Values of tropisms: a strong pull turns the heading by many radians at each step, which multiplies rounding errors."""


def modules(dialect, *, flat):
    """Modules of any command of a dialect, in the plane or not, with any number of values; and symbols that are none."""
    known = [
        symbol
        for symbol, commands in COMMANDS[dialect].items()
        if not (flat and any(Effect.LEAVES_PLANE in command.effects for command in commands))
    ]
    symbols = st.sampled_from([*known, *["[", "]", "F"] * 6, *(["~"] * 4 if "~" in known else ()), "K", "rosette", "X"])
    return symbols.flatmap(
        lambda symbol: st.builds(
            lambda numbers: Pattern(symbol, tuple(map(Number, numbers))), values_from(GENTLE if symbol == "@Ts" else VALUES)
        )
    )


def values_from(numbers):
    """None, one, or up to five of some numbers; one more often than others."""
    return st.one_of(st.just(()), st.tuples(numbers), st.tuples(numbers), st.lists(numbers, max_size=5).map(tuple))


def words(dialect, *, flat=False):
    """Words of a dialect's commands."""
    made = st.builds(
        lambda axiom, angle, heading, widths, colours: LSystem(
            tuple(axiom), (), angle=angle, heading=heading, widths=widths, turtle=dialect, colours=colours
        ),
        st.lists(modules(dialect, flat=flat), min_size=3, max_size=40),
        st.sampled_from([22.5, 60, 90, 97]),
        st.sampled_from([90, 0, -30]),
        st.sampled_from(["", "pixels", "units"]),
        st.sampled_from(["symbols", "natural"]),
    )
    return made.map(lambda made: derive(made, 0)[0])


SELDOM = {
    "abop": [
        "; F , F",
        "{ f f } F",
        "{ f f f } F",
        "{ f { f + f + f } f + f } F",
        "{ f ] f [ + f } F",
        "] F ] ] + F",
        "F ;(2.5) F ;(3.5) F ,(-7) F ;(0.5) F ; F , F",
        "F(-2) + F",
        "~ L F ~ X F ~ K(2)",
        "!(0) F !(-3) F #(30) F #(1.5) F # F",
        "#(1) F + F",
        "#(0.9) F + F",
        "#(370) F + F F",
        "@Ts(0.2) F & F + F @Ts(2,0.25,1,0,0) F F F [ @Ts(0.5) F ] F @Ts(1,2,3) F F @Ts F & F",
        "@Ts(1,0.5,1,1,1,9) F & F F",
        "@M(1,2) F @M(3) F @M F",
        "F /(180) + F /(-180) + F /(540) + F",
        "F /(180) + F /(-180) + F /(540) + F /(90) F",
        "&(90) F $ F @v F",
        "F" + " &(7) F +" * 1100,
        "@D(2) F !(3) F [ @Di(2) + F @O @c(2) ~ L ] F @o @Dd(4) F(2) @D F @D(-1) F + F",
        "@D(3) &(20) ! @Gs F @Di(2) + F @Ge(4) ~ L",
        "F @B !(3) @B(2) + @D(2) @B(-2,1) @B(0) @B(1,0) F",
        "&(30) F @B(2,1) + !(2) @B ^ @B(-3,1)" + " ~ L" * 151,
        "@L(0) F + F @L(2.5,-1) [ F @L ] @L(1000000)",
        "&(30) F @L(7) F",
    ],
    "grogra": [
        "Dl(3) F F",
        "Dl(3) [ F ] F F",
        "Dl(3) Dl(5) Ll(2) F F",
        "F @(0.5) RH F",
        "@(0.5) F",
        "RV F RL(90) RV(2) F RG F RL RG F RG F",
        "V(2) RV F V+(1) RV F Vl*(3) RV F RV F",
        "P(1) F P F P(-3) F P(17) F",
        "D*(3) F D F D+(20) F",
        "RL(180) RV(3) F RV(0.5) F",
    ],
    "fractint": [
        "C(255) F <(1) F >(2) F <(-1) F >(-1) F <(0) F C(0) F C(-1) F C(2.5) F",
        "@Q(2) F @IQ(3) F @I(0) F @(0) F",
        "\\(30) D ! \\(12) D F [ + D ] /(5) M + D",
        "F | F + | F ! | F",
        "F ! + F ! - F [ ! + F ] + F",
        "F [ @(0) F ] [ F ] F @(0) F [ F ] F",
    ],
    "plant-string": ["I ( I [ I L ) F ] A B L", "( ( ( I", "L F L"],
}
"""Rows of modules by which something happens that is seldom met by chance."""


def module_in(text):
    """A module as it is written in such a row."""
    symbol, values = re.fullmatch(r"(.+?)(?:\(([-\d.,]+)\))?", text).groups()
    return Pattern(symbol, tuple(Number(float(value)) for value in (values or "").split(",") if value))


@pytest.mark.parametrize(("dialect", "row"), [(dialect, row) for dialect, rows in SELDOM.items() for row in rows])
def test_what_happens_seldom(page, dialect, row):
    word = derive(LSystem(tuple(map(module_in, row.split())), (), angle=72, turtle=dialect), 0)[0]
    expect_drawn(page, [[word]], [72.0, *ANGLES])


@pytest.mark.slow
@pytest.mark.parametrize("flat", [False, True], ids=["space", "plane"])
@pytest.mark.parametrize("dialect", COMMANDS)
@settings(max_examples=10)
@given(data=st.data())
def test_words_of_all_commands(page, dialect, flat, data):
    found = data.draw(st.lists(words(dialect, flat=flat), min_size=8, max_size=8))
    expect_drawn(page, [[word] for word in found], [60.0, *ANGLES])


@pytest.mark.parametrize(
    ("setting", "times", "what"), [("L", "L*", "step"), ("D", "D*", "width"), ("V", "V*", "strength"), ("@D", "@Di", "scale")]
)
def test_what_grows_too_large_is_refused_in_the_same_words(page, setting, times, what):
    row = (Pattern(setting, (Number(10),)), *[Pattern(times, (Number(1000),))] * 17, Pattern("RV"), Pattern("F"))
    expect_refused(
        page,
        derive(LSystem(row, (), turtle="abop" if what == "scale" else "grogra"), 0)[0],
        rf"The turtle's {what} grows too large to draw: 1e\+52",
    )


def test_fifteen_thousand_strokes_are_placed_at_once(page):
    """A typical time and not the greatest, since other programs may need the processor; a hundred times what it takes."""
    for branch in ("-", "&"):
        plant = derive(read(f"angle: 25.7\naxiom: F\nF -> F[+F]F[{branch}F]F"), 6)[-1]
        strokes, milliseconds = answers(
            page,
            """
            const path = traced(bookOf(given), 0), times = [];
            for (let angle = 0; angle < 31; angle++) {
              const start = performance.now();
              placed(path, angle);
              times.push(performance.now() - start);
            }
            return [path.strokes.n, times.sort((a, b) => a - b)[15]];""",
            book_of([plant]),
            *TURTLE,
        )
        assert strokes == 5**6
        assert milliseconds < 100


def test_a_stroke_knows_its_module(page):
    word = derive(read("axiom: F[+F]{-f+f+f}@o(1)\nF -> F[+F]F"), 1)[-1]
    found = answers(
        page,
        """
        const { strokes, faces, rounds } = placed(traced(bookOf(given), 0), 90);
        return [strokes, faces, rounds].map(({ positions }) => Array.from(positions));""",
        book_of([word]),
        *TURTLE,
    )
    assert [[str(word[place]) for place in places] for places in found] == [["F"] * 6, ["{"], ["@o(1)"]]
    assert found[0] == [place for place, module in enumerate(word) if module.symbol == "F"]


def test_the_paths_of_few_large_words_are_kept(page):
    """Of six words of 131,072 strokes each those four that were asked for last, but of small words all."""

    def kept(steps):
        words = list(derive(read("axiom: F\nF -> FF"), steps))
        return answers(
            page,
            """
            const book = bookOf({ ...given, words: Array(6).fill(given.words.at(-1)) });
            for (const step of [0, 1, 2, 3, 4, 5, 3]) traced(book, step);
            return [...openedTurtle(book).paths.keys()];""",
            book_of(words[-1:]),
            *TURTLE,
        )

    assert kept(3) == [0, 1, 2, 4, 5, 3]
    assert kept(17) == [2, 4, 5, 3]


FRACTINT = {
    "draw by second heading",
    "move by second heading",
    "turn second heading",
    "mirror turns",
    "set palette colour",
    "turn by mirrored angle",
}


@pytest.mark.parametrize(("made", "handlers"), [("planeActions", PLANE_HANDLERS), ("spaceActions", SPACE_HANDLERS)])
def test_the_turtle_of_the_panel_knows_the_actions_of_the_kit(page, made, handlers):
    """That of Fractint never leaves the plane."""
    known = answers(page, f"return Object.keys({made}());", None, *TURTLE)
    missing = {*handlers} - {*known}
    assert missing == (FRACTINT if made == "spaceActions" else set())


def test_an_action_that_the_panel_does_not_know_is_named(page):
    book = book_of([derive(read("axiom: F"), 0)[0]])
    book["turtle"]["calls"][0][0][0] = "fly"
    with pytest.raises(Error, match='The turtle of the panel does not know how to "fly"'):
        answers(page, SHAPES, [{"book": book, "angles": [90]}], *TURTLE)


def test_the_constants_of_the_scripts_are_those_of_the_kit():
    """If not: python -m tests.shared_constants."""
    assert CONSTANTS.read_text(encoding="utf-8") == script()
