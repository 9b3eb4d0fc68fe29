"""How fast words are drawn, as strokes a second: put together from pieces, and module by module where all modules differ.

Goals: 50,000,000 in the plane for step 9 of a plant, 10,000,000 in space, 100,000 where every module is different; a picture
of a million strokes in 0.2 s, of one in space in 1 s, a PDF of 78,000 in 1 s, and the SVG text of a thousand in 1 ms. In sun
and sky, at 1200 x 1200 pixels: 78,000 strokes in 2 s, a million triangles in 6 s, with less than 1 GB. They are printed by
`pytest tests/benchmarks/test_drawing.py --benchmark-only -s`.
"""

from __future__ import annotations

import io
import time

import pytest

from lsys_kit import derive, draw, figure, limits, read
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.pictures.formats.raster import encoded, turtle_picture
from lsys_kit.pictures.formats.svg import element
from lsys_kit.pictures.rendering.frames import frame_of
from lsys_kit.pictures.rendering.scene_shapes import scene_shapes
from lsys_kit.pictures.rendering.view import project

PLANT = read("angle: 25.7\naxiom: F\nF -> F[+F]F[-F]F")
IN_SPACE = read("angle: 25.7\naxiom: F\nF -> F[+F]/(90)F[-F]F")

BUSH = read("""
angle: 22.5
axiom: A
A -> [& F L ! A] / / / / / ' [& F L ! A] / / / / / / / ' [& F L ! A]
F -> S / / / / / F
S -> F L
L -> [' ' ' ^ ^ { - f + f + f - | - f + f + f }]""")
LEAFY = read("angle: 30\naxiom: A\nA -> F[&A ~L]/(120)[&A ~L]/(120)[&A ~L]~L/(70)~L/(70)~L/(70)~L/(70)~L")
ALL_DIFFERENT = read("axiom: F(1)\nF(x) -> F(.37*x+.1) [+(x) F(.59*x+.2)]")


def told(benchmark, strokes, goal):
    """Strokes a second, beside the goal."""
    if benchmark.stats:
        print(f"\n{strokes:,} strokes: {strokes / benchmark.stats.stats.min:.2g} a second (goal {goal:.0e})")


@pytest.mark.parametrize(("model", "steps", "goal"), [(PLANT, 9, 5e7), (IN_SPACE, 8, 1e7)], ids=["plane", "space"])
def test_a_plant_put_together_from_pieces(benchmark, model, steps, goal):
    derivation = derive(model, steps)
    scene = benchmark(lambda: scene_of(derivation))
    assert len(scene.segments) == 5**steps
    told(benchmark, len(scene.segments), goal)


def test_module_by_module_in_space(benchmark):
    """The bush of The Algorithmic Beauty of Plants, figure 1.25."""
    word = derive(BUSH, 6, arithmetic="float")[-1]
    scene = benchmark(lambda: trace_in_space(word))
    assert scene.dimension == 3


def test_every_module_is_different(benchmark):
    word = derive(ALL_DIFFERENT, 15, arithmetic="float")[-1]
    scene = benchmark(lambda: scene_of(word))
    assert len(scene.segments) == 2**15
    told(benchmark, len(scene.segments), 1e5)


def test_a_million_strokes_as_a_picture(benchmark):
    derivation = derive(PLANT, 9)
    scene, colours = scene_of(derivation), draw(derivation.to(3)).colour_of
    png = benchmark(lambda: encoded(turtle_picture(scene, colours)))
    assert png.startswith(b"\x89PNG")
    told(benchmark, len(scene.segments), 5e6)


@pytest.mark.slow
@pytest.mark.parametrize(("model", "steps", "goal"), [(IN_SPACE, 7, 2.0), (LEAFY, 9, 6.0)], ids=["strokes", "triangles"])
def test_a_plant_in_sun_and_sky(benchmark, model, steps, goal):
    """As an image, without its PNG."""
    derivation = derive(model, steps)
    with limits(seconds=100, bytes=2**30):
        image = benchmark.pedantic(lambda: draw(derivation, light=True, size=(1200, 1200)).image(), rounds=1)
        assert image.size == (1200, 1200)
        if benchmark.stats:
            mesh = draw(derivation).mesh
            print(f"\n{len(mesh.triangles):,} triangles: {benchmark.stats.stats.min:.2g} s (goal {goal:g} s)")


def test_a_plant_in_space_from_far_to_near_as_a_picture(benchmark):
    derivation = derive(IN_SPACE, 8)
    scene, colours = scene_of(derivation), draw(derivation.to(3)).colour_of
    png = benchmark(lambda: encoded(turtle_picture(*project([scene]), colours)))
    assert png.startswith(b"\x89PNG")
    told(benchmark, len(scene.segments), 1e6)


def test_a_page_of_many_strokes(benchmark):
    """Beside the same as matplotlib writes it."""
    picture = draw(PLANT, 7)
    page = benchmark(lambda: type(picture).pdf.func(picture))
    assert page.startswith(b"%PDF")
    told(benchmark, len(picture.scene.segments), 7.8e4)
    if benchmark.stats:
        start = time.perf_counter()
        figure(picture).get_figure().savefig(io.BytesIO(), format="pdf")
        print(f"{(time.perf_counter() - start) / benchmark.stats.stats.min:.0f} times as fast as by matplotlib")


def test_a_thousand_strokes_as_text(benchmark):
    picture = draw(PLANT, 5)
    frame = frame_of(picture.scene.box)
    svg = benchmark(lambda: "".join(map(element, scene_shapes(picture.scene, frame, picture.colour_of))))
    assert "<path" in svg
    told(benchmark, len(picture.scene.segments), 1e6)
