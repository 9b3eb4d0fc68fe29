"""What a canvas in the browser is sent: every stroke and shape of the scene, with its place, look and colour."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive, read, system
from lsys_kit.classroom.panel.canvas import packed
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.scene import CIRCLE
from lsys_kit.geometry.turtle.mode import in_plane
from lsys_kit.geometry.turtle.plane import place_path, trace
from lsys_kit.pictures.display_list import shape_colours
from lsys_kit.pictures.draw import state_colours

PLANE = st.text("Ff+-[]|{}.", min_size=1, max_size=40)
SPACE = st.text("Ff+-&^/[]$!;{}.", min_size=1, max_size=40)
SHAPES = "@o(2)@c(1)F[+(20)#(3)F;(4){-f+f+f}]!(1/2)F[~L(2)][@O(3)f]F"


def balanced(letters):
    """The letters without what closes nothing, and what is open closed."""
    text, pairs = [], {"]": "[", "}": "{"}
    waiting = []
    for letter in letters:
        if letter in pairs and (not waiting or waiting[-1] != pairs[letter]):
            continue
        if letter in pairs:
            waiting.pop()
        elif letter in "[{":
            if letter == "{" and "{" in waiting:
                continue
            waiting.append(letter)
        text.append(letter)
    return "".join([*text, *("]" if one == "[" else "}" for one in reversed(waiting))])


def word_of(text):
    return derive(read(f"angle: 25\naxiom: {text}"), 0)[0]


def sent(word, angle=25.0):
    """The scene of a word, and what the canvas gets of it, unpacked as the canvas does it."""
    flat = in_plane(word.states.system)
    path = trace(word) if flat else None
    scene = place_path(path, angle) if flat else scene_of(word, angle)
    traits = packed(scene, path, state_colours(word))
    return scene, traits, unpacked(traits["shapes"], angle if flat else None)


def unpacked(data, angle):
    numbers, reals = np.frombuffer(data, "<i4"), np.frombuffer(data, "<f4")
    s, f, c, r, n = numbers[:5].tolist()
    sizes = [("from", s), ("to", s), ("looks", s), ("widths", s), ("starts", f and f + 1), ("fills", f), ("corners", c),
             ("centres", r), ("rings", r), ("radii", r), ("first", n), ("second", n), ("third", n),
             ("parents", n if angle else 0)]
    found, at = {}, 5
    for name, size in sizes:
        kind = reals if name in ("widths", "radii", "first", "second", "third") else numbers
        found[name] = kind[at:at + size]
        at += size
    assert at == len(numbers)
    solid = np.stack([found[name] for name in ("first", "second", "third")], axis=1)
    return {**found, "points": walked(found, angle) if angle else solid}


def walked(found, angle):
    """The points of a path as flat.js finds them, for a turtle that looks upwards at first."""
    points = [(0.0, 0.0)]
    for turns, offset, length, parent in zip(*(found[name].tolist() for name in ("first", "second", "third", "parents")),
                                             strict=True):
        x, y = points[parent + 1]
        way = math.radians(turns * angle + offset + 90)
        points.append((x + length * math.cos(way), y + length * math.sin(way)))
    return np.array(points)


def agree(word):
    scene, traits, found = sent(word)
    points = found["points"]
    strokes = np.concatenate([points[found["from"]], points[found["to"]]], axis=1)
    assert strokes == pytest.approx(scene.segments.ends, abs=1e-3)
    assert found["widths"] == pytest.approx(np.broadcast_to(scene.segments.widths, len(scene.segments)))
    assert points[found["corners"]] == pytest.approx(scene.polygons.points, abs=1e-3)
    assert len(scene.polygons) == 0 or found["starts"].tolist() == scene.polygons.starts.tolist()
    assert points[found["centres"]] == pytest.approx(scene.discs.centres, abs=1e-3)
    assert found["radii"] == pytest.approx(scene.discs.radii)
    for looks, shapes in (("fills", scene.polygons), ("rings", scene.discs), ("looks", scene.segments)):
        assert [traits["colours"][look >> 4] for look in found[looks].tolist()] == \
            shape_colours(shapes, state_colours(word))
    assert ((found["looks"] >> 2) & 3).tolist() == np.minimum(scene.segments.orders, 3).tolist()
    assert (found["rings"] & 1).tolist() == (scene.discs.kinds == CIRCLE).tolist()


@given(PLANE.map(balanced))
def test_a_canvas_in_the_plane_gets_all_that_is_drawn(text):
    agree(word_of(text or "F"))


@given(SPACE.map(balanced))
def test_a_canvas_in_space_gets_all_that_is_drawn(text):
    agree(word_of(f"{text}&F"))


@pytest.mark.parametrize("text", [SHAPES, f"{SHAPES}&(30){SHAPES}"], ids=["plane", "space"])
def test_widths_colours_leaves_and_discs_are_sent(text):
    scene, *_ = sent(word_of(text))
    assert min(len(scene.polygons), len(scene.discs)) >= 2
    assert len(set(scene.segments.widths.tolist())) >= 3
    agree(word_of(text))


@pytest.mark.parametrize("id", ["K8", "K12", "K19", "L2", "L4", "T2"])
def test_plants_of_the_catalogue_are_sent_whole(id):
    plant = system(id)
    agree_at = derive(plant, min(plant.steps or 3, 4), seed=1)[-1]
    if float(plant.heading) == 90:
        agree(agree_at)


def test_marked_modules_are_marked_in_every_shape():
    word = word_of("F&[{F+F+F}]@o(1)G")
    scene = scene_of(word)
    states = {state for state, module in enumerate(word.states.modules) if module.symbol in ("F", "{", "@o")}
    found = unpacked(packed(scene, None, state_colours(word), states)["shapes"], None)
    assert (found["looks"] & 2).tolist() == [2, 2, 2, 2, 0]
    assert (found["rings"] & 2).tolist() == [2]


def test_nothing_to_draw_is_sent_too():
    for text in ("A", "A&"):
        scene, traits, found = sent(word_of(text))
        assert len(scene.segments) == len(found["from"]) == 0
        assert traits["typical"] == 1
