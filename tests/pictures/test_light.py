"""Sun and sky: what is nearest is seen, shadows lie away from the sun, and the same thing looks the same every time."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from lsys_kit import animate, cellwork_system, derive, draw, figure, limits, read, stages, system
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.pictures.rendering.frames import frame_around
from lsys_kit.pictures.rendering.light import (
    LATTICES,
    NONE,
    LitScene,
    Sheet,
    Sun,
    leaves,
    lit_pixels,
    nearest,
    offsets_of,
    openness,
    rendered,
    seen_smoothly,
    surfaces_of,
)

POST = "axiom: !(0.3)F(5)"
BUSH = "angle: 30\naxiom: A\nA -> F[&A~L]/(120)[&A~L]/(120)[&A~L]"
SIDE = 64


def lit(text: str, steps: int = 0, view: Any = None, sun: Sun | None = None, leafy: bool = True) -> LitScene:
    [found] = seen_smoothly([scene_of(derive(read(text), steps))], view, sun or Sun(), leafy=leafy)
    assert isinstance(found, LitScene)
    return found


def pixels(scene: LitScene, enlarged: float = 0.5) -> NDArray[np.int64]:
    return lit_pixels(scene, {}, frame_around([scene]), enlarged).astype(np.int64)


def some_triangles(seed: int, many: int = 40) -> tuple[NDArray[Any], NDArray[Any]]:
    """Triangles that cross, touch and lie in one another."""
    draws = np.random.default_rng(seed)
    points = draws.uniform(-8, SIDE + 8, (many, 3, 3))
    points[:, :, 2] = draws.uniform(0.5, 2, (many, 3))
    points[many // 2 :: 3] = points[: len(points[many // 2 :: 3])]  # some twice
    return points.reshape(-1, 3).astype(np.float32), np.arange(3 * many, dtype=np.uint32).reshape(-1, 3)


# --- the z-buffer ---


@given(st.integers(0, 2**32 - 1))
def test_what_is_seen_does_not_depend_on_the_order_of_triangles(seed: int) -> None:
    points, triangles = some_triangles(seed)
    order = np.random.default_rng(seed + 1).permutation(len(triangles))
    both, shape, columns = np.ones(len(triangles), bool), (SIDE, SIDE), offsets_of(4)
    one = nearest(points, triangles, shape, columns, both)
    other = nearest(points, triangles[order], shape, columns, both)
    assert (one.nearness == other.nearness).all()
    hit = one.triangles != NONE
    assert (hit == (other.triangles != NONE)).all()
    seen = [points[each] for each in (triangles[one.triangles[hit]], triangles[order][other.triangles[hit]])]
    assert (seen[0] == seen[1]).all()


@given(st.integers(0, 2**32 - 1))
def test_the_nearest_of_all_planes_is_seen(seed: int) -> None:
    """As computed one by one at each sample, with barycentric coordinates."""
    points, triangles = some_triangles(seed, 12)
    seen = nearest(points, triangles, (SIDE, SIDE), offsets_of(1), np.ones(len(triangles), bool))
    x, y = np.meshgrid(np.arange(SIDE) + 0.5, np.arange(SIDE) + 0.5)
    best = np.zeros((SIDE, SIDE))
    for a, b, c in points[triangles].astype(np.float64):
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        one = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        two = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        inside = (one > 1e-9) & (two > 1e-9) & (one + two < 1 - 1e-9)
        best = np.where(inside, np.maximum(best, a[2] + one * (b[2] - a[2]) + two * (c[2] - a[2])), best)
    assert (np.abs(seen.nearness - best) > 1e-4).mean() < 1e-3  # but for edges through the middle of a pixel


@pytest.mark.parametrize("first", [0, 1])
def test_a_nearer_triangle_hides_a_farther_one(first: int) -> None:
    points = np.array([[0, 0, 1], [9, 0, 1], [0, 9, 1], [0, 0, 2], [9, 0, 2], [0, 9, 2]], np.float32)
    triangles = np.array([[0, 1, 2], [3, 4, 5]], np.uint32)[[first, 1 - first]]
    seen = nearest(points, triangles, (9, 9), offsets_of(1), np.ones(2, bool))
    assert {*np.unique(seen.triangles)} == {NONE, 1 - first}


@given(st.integers(0, 2**32 - 1), st.sampled_from([*LATTICES]))
@example(2_353_421, 4)  # a sliver along which samples lie, that covers fewer of them than its area says
def test_the_samples_covered_are_those_within(seed: int, samples: int) -> None:
    corners = np.random.default_rng(seed).uniform(0, 200, (3, 2)) * (1, samples)
    points, shape = np.column_stack([corners, np.ones(3)]).astype(np.float32), (200 * samples, 200)
    seen = nearest(points, np.array([[0, 1, 2]], np.uint32), shape, offsets_of(samples), np.ones(1, bool))
    y = np.arange(shape[0])[:, None] + 0.5
    x = np.arange(shape[1]) + offsets_of(samples).astype(np.float64)[np.arange(shape[0]) % samples][:, None]
    plane = points[:, :2].astype(np.float64)
    ways = [plane[k] - plane[k - 1] for k in range(3)]
    asides = [((x - plane[k][0]) * ways[k][1] - (y - plane[k][1]) * ways[k][0]) / np.hypot(*ways[k]) for k in range(3)]
    within = np.all([aside > 0 for aside in asides], axis=0) | np.all([aside < 0 for aside in asides], axis=0)
    clear = np.min(np.abs(asides), axis=0) > 1e-6  # of the edges
    assert ((seen.nearness > 0) == within)[clear].all()


@given(st.integers(0, 2**32 - 1))
def test_triangles_with_a_common_edge_leave_no_gap_and_share_no_sample(seed: int) -> None:
    """A square, cut into a fan around a point of it, is covered exactly once."""
    draws = np.random.default_rng(seed)
    rim = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
    points = np.array([(*each, 1) for each in rim] + [(*draws.uniform(1, SIDE - 1, 2), 1)], np.float32)
    fan = np.array([(k, (k + 1) % 4, 4) for k in range(4)], np.uint32)
    seen = [nearest(points, fan[[k]], (SIDE, SIDE), offsets_of(4), np.ones(1, bool)).nearness > 0 for k in range(4)]
    assert (np.sum(seen, axis=0) == 1).all()


@given(st.integers(0, 2**32 - 1))
def test_only_sheets_are_seen_from_behind(seed: int) -> None:
    points, triangles = some_triangles(seed, 3)
    back, front = (
        nearest(points, some, (SIDE, SIDE), offsets_of(1), np.zeros(3, bool)).nearness
        for some in (triangles, triangles[:, ::-1])
    )
    both = nearest(points, triangles, (SIDE, SIDE), offsets_of(1), np.ones(3, bool)).nearness
    assert (np.maximum(back, front) == both).all()


# --- light ---


@pytest.mark.slow
def test_the_same_scene_has_the_same_bytes() -> None:
    assert (pixels(lit(BUSH, 3)) == pixels(lit(BUSH, 3))).all()
    assert draw(read(BUSH), 2, light=True).png == draw(read(BUSH), 2, light=True).png


@pytest.mark.slow
def test_a_picture_does_not_depend_on_the_order_of_its_triangles() -> None:
    scene = lit(BUSH, 3)
    frame = frame_around([scene])
    sheet = Sheet(frame, 0.5, round(frame.width / 2), round(frame.height / 2))
    found = surfaces_of(scene, {}, sheet)
    order = np.random.default_rng(1).permutation(len(found.triangles))
    assert (rendered(scene, found, sheet) == rendered(scene, found._replace(triangles=found.triangles[order]), sheet)).all()


@pytest.mark.slow
def test_a_sphere_is_symmetric_about_the_sun_and_darker_away_from_it() -> None:
    """Left and right, if it stands behind the viewer; and from side to side, if it stands there."""
    ahead = pixels(lit("axiom: &f(0)@O(1)", view=(0, 0), sun=Sun(0, 45)), 1.0)
    difference = np.abs(ahead - ahead[:, ::-1])
    assert difference.mean() < 0.5
    aside = pixels(lit("axiom: &f(0)@O(1)", view=(0, 0), sun=Sun(90, 5)), 1.0)
    row = aside[aside.shape[0] // 3, :, 1]
    sphere = np.flatnonzero(aside[aside.shape[0] // 3, :, 2] < 200)
    parts = [float(part.mean()) for part in np.array_split(row[sphere[2:-2]], 3)]
    assert parts == sorted(parts)
    assert parts[-1] > 1.4 * parts[0]


@pytest.mark.slow
@pytest.mark.parametrize("around", range(0, 360, 40))
def test_a_shadow_lies_away_from_the_sun(around: int) -> None:
    """As seen from above: right of the picture is the right side, below is the front."""
    scene = lit(POST, view=(0, 90), sun=Sun(around, 45))
    frame = frame_around([scene])
    found = lit_pixels(scene, {}, frame).astype(np.int64)
    dark = 255 - found.max(axis=2)
    dark[found.min(axis=2) < 90] = 0  # the post
    foot = (np.array([0.0, 0.0]) - (frame.left, -frame.top)) * frame.scale + 12
    across, down = ((dark.sum(axis=axis) * np.arange(dark.shape[1 - axis])).sum() / dark.sum() for axis in (0, 1))
    away = float(across - foot[0]), float(down - foot[1])
    sunwards = math.sin(math.radians(around)), math.cos(math.radians(around))
    assert np.dot(away, sunwards) < -0.95 * math.hypot(*away)


def test_a_shadow_is_as_long_as_the_sun_is_low() -> None:
    one, other = (float(np.ptp(lit("axiom: !(0.01)F(5)", view=(0, 90), sun=Sun(90, above)).box[::2])) for above in (45, 65))
    assert one / other == pytest.approx(math.tan(math.radians(65)), rel=0.02)


def test_what_stands_in_the_shadow_is_darker() -> None:
    """A sphere, and the same below another, with the sun above."""
    alone, under = (
        pixels(lit(f"axiom: f@O(1)f(3)[{more}]", view=(0, 0), sun=Sun(0, 90))) for more in ("+(90)f(2)@O(1)", "@O(1)")
    )
    lowest = [found[found.shape[0] * 7 // 10 :] for found in (alone, under)]
    bright = [float(np.quantile(each[each[:, :, 2] < each[:, :, 1] - 20][:, 1], 0.8)) for each in lowest]
    assert bright[0] > 1.3 * bright[1]


@pytest.mark.slow
def test_leaves_let_light_through() -> None:
    """Seen from below, with the sun above."""
    leaf = "axiom: f(4)[&(90)f(-2){.f(4).+(90)f(4).+(90)f(4).}]"
    through, opaque = (pixels(lit(leaf, view=(0, -40), sun=Sun(0, 80), leafy=leafy)) for leafy in (True, False))
    green = opaque[:, :, 1] - opaque[:, :, 2] > 20
    assert green.mean() > 0.05
    assert through[green].mean() > 1.15 * opaque[green].mean()


def test_hollows_are_darker_than_what_stands_out() -> None:
    row = np.full(101, -1.0, np.float32)
    row[40:61] = -2.0  # a ditch
    depth = np.tile(row, (50, 1))
    found = openness(depth, 10.0, 100.0)
    assert found[25, 50] < found[25, 10] == 1
    assert (openness(np.full((50, 50), 3, np.float32), 10.0, 100.0) == 1).all()


def test_the_ground_fades_into_the_paper() -> None:
    found = np.asarray(draw(read(BUSH), 3, light=True).image())
    rim = np.concatenate([found[0], found[-1], found[:, 0], found[:, -1]])
    assert (rim == 255).all()
    assert ((found < 250).all(axis=2) & (np.ptp(found.astype(int), axis=2) < 40)).mean() > 0.01  # a shadow


def test_a_leaf_is_what_hangs_together() -> None:
    scene = lit("axiom: F[&(60)~L][^(60)~L][+(60){.f.+(90)f.+(90)f.}]")
    single, *_, one, other = sorted(np.unique(leaves(scene.solid.polygons), return_counts=True)[1].tolist())
    assert (single, one) == (1, other)  # there are stalks, too
    assert one > 100


@pytest.mark.slow
def test_leaves_vary_by_the_seed() -> None:
    one, again, other = (draw(read(BUSH), 2, light=True, seed=seed).png for seed in (1, 1, 2))
    assert one == again != other


# --- pictures ---

BACKGROUNDS = "light", "dark", "none", "#335577"


@pytest.mark.slow
@pytest.mark.parametrize("background", BACKGROUNDS)
def test_a_lit_picture_lies_on_any_paper(background: str) -> None:
    image = draw(read(BUSH), 2, light=True, background=background).image()
    corner = image.getpixel((0, 0))
    assert corner == {"light": (255, 255, 255), "dark": (0x16, 0x1B, 0x20), "none": (255, 255, 255, 0)}.get(
        background, (51, 85, 119)
    )


@pytest.mark.slow
def test_other_formats_hold_the_picture_and_say_so(tmp_path: Path) -> None:
    picture = draw(read(BUSH), 2, light=True)
    assert "as an image of pixels" in repr(picture)
    assert "<image" in picture.svg
    assert "as an image of pixels" in picture.svg
    for ending in ("svg", "pdf", "png", "glb"):
        picture.save(tmp_path / f"bush.{ending}")
    assert b"/Image" in (tmp_path / "bush.pdf").read_bytes()
    assert figure(picture).images


@pytest.mark.slow
def test_a_notebook_shows_pixels_and_turns_no_light_into_dark() -> None:
    for picture in (draw(read(BUSH), 1, light=True), draw(read(BUSH), steps=[0, 1], light=True)):
        shown = picture._repr_mimebundle_()
        assert shown.keys() == {"text/html", "image/png", "text/plain"}
        assert "lsys-picture" not in shown["text/html"]
        assert f'width="{picture.image().width}"' in shown["text/html"]


@pytest.mark.parametrize(("axiom", "darkened"), [("F[&F]@o", True), ("F[&F]@O", False)])
def test_a_dark_notebook_turns_no_light_on_spheres_into_dark(axiom: str, darkened: bool) -> None:
    shown = draw(read(f"axiom: {axiom}"), 0)._repr_mimebundle_()
    assert ("lsys-picture" in shown["text/html"]) == darkened


@pytest.mark.slow
def test_the_picture_has_the_size_that_was_chosen() -> None:
    assert draw(read(BUSH), 2, light=True, size=300).image().width == 300
    assert draw(read(BUSH), 2, light=True, size=(300, 200)).image().size == (300, 200)
    assert draw(read(BUSH), 2, light=True, legend=True, size=500).image().width == 500


def test_a_drawing_in_the_plane_stands_upright() -> None:
    picture = draw(read("angle: 25\naxiom: F\nF -> F[+F]F[-F]F"), 2, light=True)
    assert picture.solid is not None
    assert picture.solid.dimension == 3
    assert np.asarray(picture.image()).min() < 200


@pytest.mark.slow
def test_drawings_side_by_side_are_lit_too() -> None:
    plain, lit_ones = (draw(read(BUSH), steps=[1, 2], **chosen) for chosen in ({}, {"light": True}))
    assert plain.png != lit_ones.png
    assert draw(read(BUSH), steps=[1, 2], light=True, background="none").image().mode == "RGBA"


@pytest.mark.slow
def test_a_cellwork_is_lit() -> None:
    picture = draw(cellwork_system("K33"), 2, light=True)
    assert "sunlight" in repr(picture)
    assert picture.image().size[0] > 100


@pytest.mark.slow
def test_films_are_lit_and_on_a_turntable_the_sun_stays() -> None:
    film = animate(read(BUSH), 2, light=True)
    assert len({image.size for image in film.images}) == 1
    turned = animate(read("axiom: F(2)@O(0.5)[&(90)F(2)]"), 0, light=True, turntable=True)
    assert len(turned.images) == 36
    shaded = [np.asarray(image.convert("L")).mean() for image in turned.images]
    assert np.std(shaded) < 4


@pytest.mark.parametrize("light", [0, 1, "sun", (1,), (1, 2, 3), (0, 0), (0, 95), ("a", 45), (0, math.nan), {}])
def test_what_is_no_light_is_named(light: Any) -> None:
    with pytest.raises(LSystemError, match=r"light|sun"):
        draw(read(BUSH), 1, light=light)


def test_what_has_no_surfaces_has_no_light() -> None:
    for what in (system("J4"), stages(system("J4"))):
        with pytest.raises(ModelValueError, match='"light" means nothing'):
            draw(what, light=True)
    assert draw(read(BUSH), 1, light=False).png == draw(read(BUSH), 1).png


def test_nothing_to_draw_is_paper() -> None:
    assert np.unique(np.asarray(draw(read("axiom: A"), 0, light=True).image())).tolist() == [255]


def test_a_picture_that_is_too_large_is_refused() -> None:
    with pytest.raises(ModelLimitError):
        draw(read(BUSH), 1, light=True, size=20_000).image()
    with limits(seconds=0.05), pytest.raises(ModelLimitError):
        draw(read(BUSH), 5, light=True, size=1200).image()


@pytest.mark.slow
def test_a_png_holds_what_the_image_shows() -> None:
    picture = draw(read(BUSH), 2, light=True)
    with Image.open(io.BytesIO(picture.png)) as stored:
        assert (np.asarray(stored) == np.asarray(picture.image())).all()
