"""Labels that the turtle writes, `@L`, in every format."""

from __future__ import annotations

import re
import struct
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from lsys_kit import animate, derive, draw, limits, read
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.pictures.formats.lettering import advance
from lsys_kit.pictures.rendering.frames import LABEL, LABEL_GAP, frame_around, label_width
from lsys_kit.pictures.rendering.view import project

TREE = read("angle: 30\naxiom: A(1)\nA(t) -> F @L(t,t/2) [+A(t+1)] [-A(t+1)]")
UNLABELLED = read("angle: 30\naxiom: A(1)\nA(t) -> F [+A(t+1)] [-A(t+1)]")
SAID = ["1, 0.5", "2, 1", "2, 1"]


def texts(svg: str) -> list[str]:
    return re.findall("<text [^>]*>([^<]*)</text>", svg)


def test_they_say_the_values_of_their_arguments_where_the_turtle_is() -> None:
    labels = scene_of(derive(read("axiom: @L(7) F @L(0.25,-1) F @L @L(2)"), 0)).labels
    assert labels.texts == ("7", "0.25, -1", "2")
    assert labels.points.tolist() == pytest.approx(np.array([[0, 0], [0, 1], [0, 2]]))


def test_they_move_and_change_nothing_else() -> None:
    ours, plain = (scene_of(derive(system, 3)) for system in (TREE, UNLABELLED))
    assert ours.segments.ends == pytest.approx(plain.segments.ends)
    assert str(ours).replace("7 labels, ", "") == str(plain)


def test_a_picture_has_them_as_text() -> None:
    picture = draw(TREE, 2)
    assert texts(picture.svg) == SAID
    with limits(segments=1):
        assert texts(draw(TREE, 2).svg) == SAID, "over pixels, too"
    assert texts(draw(TREE, steps=[1, 2]).svg) == [*SAID[:1], "step 1", *SAID, "step 2"]


@pytest.mark.parametrize("text", ["F @L(123456)", "@L(123456)", "+(90) F @L(1) |(0) @L(5)", "&F @L(99)"])
def test_they_have_room(text: str) -> None:
    [scene] = project([scene_of(derive(read(f"axiom: {text}"), 0))])
    frame = frame_around([scene])
    for x, said in zip(frame.points(scene.labels.points)[:, 0] / frame.parts, scene.labels.texts, strict=True):
        assert x + LABEL_GAP + advance(said, LABEL) < x + label_width(said) - LABEL_GAP + 1e-9 <= frame.width


def pixels(picture: object) -> np.ndarray:
    return np.asarray(picture.image().convert("L"), float)  # type: ignore[attr-defined]


@pytest.mark.parametrize("background", ["light", "dark", "none"])
def test_pixels_show_them(background: str) -> None:
    with_, without = (pixels(draw(system, 2, background=background)) for system in (TREE, UNLABELLED))
    wide, high = min(with_.shape[1], without.shape[1]), min(with_.shape[0], without.shape[0])
    assert (np.abs(with_[:high, :wide] - without[:high, :wide]) > 100).sum() > 20


def test_films_show_them() -> None:
    ours, plain = (animate(system, 2).images[-1] for system in (TREE, UNLABELLED))
    both = [np.asarray(image.convert("L"), float)[:, : min(ours.width, plain.width)] for image in (ours, plain)]
    assert (np.abs(both[0] - both[1]) > 100).sum() > 20


def test_figures_show_them() -> None:
    ax = Figure().add_subplot()
    draw(TREE, 2).plot_into(ax)
    assert [text.get_text() for text in ax.texts] == SAID
    assert ax.texts[0].get_position() == pytest.approx((0, 1), abs=0.2)


def test_meshes_have_none(tmp_path: Path) -> None:
    for name, system in (("ours", TREE), ("plain", UNLABELLED)):
        draw(system, 2).save(tmp_path / f"{name}.glb")
    ours, plain = ((tmp_path / f"{name}.glb").read_bytes() for name in ("ours", "plain"))
    assert struct.unpack("<4sII", ours[:12]) == struct.unpack("<4sII", plain[:12])
