"""What other programs get: meshes with their colours, pages, films; each read back by somebody else's reader."""

import io
import json
import struct
import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
import trimesh
from PIL import Image, ImageSequence

from lsys_kit import (
    ModelFileError,
    ModelLimitError,
    ModelValueError,
    animate,
    derive,
    draw,
    figure,
    limits,
    lineage,
    read,
    stages,
    system,
    timed,
)
from lsys_kit.__main__ import main
from lsys_kit.geometry.meshes.mesh import mesh_of
from lsys_kit.pictures.formats.mesh_files import channels
from lsys_kit.pictures.style.palette import CHOSEN, colours
from tests.endings import DRAWINGS, FILMS, MESHES, SAID_OF_DRAWINGS, SAID_OF_FILMS, beginnings
from tests.timing import spent

BUSH = read("""angle: 22.5
axiom: !(0.4)A
A -> [&!FL!A]/(114)[&!FL!A]/(114)[&!FL!A]@O(0.3)
L -> ;(6)[^(60){-f+f+f-|-f+f+f}]
F -> S /(114) F
S -> F L""")
LINE = read("colours: symbols\nangle: 90\naxiom: F(2)[+;(4)F(3)]")


def kept(what, path):
    what.save(path)
    return trimesh.load(path, force="scene")


def painted(path):
    """The colours in a .glb file, as linear light."""
    content = path.read_bytes()
    tree = json.loads(content[20 : 20 + struct.unpack("<I", content[12:16])[0]])
    return {tuple(material["pbrMetallicRoughness"]["baseColorFactor"]) for material in tree["materials"]}


def light(colour):
    """How much light a colour of sRGB stands for."""
    return [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in channels(colour)]


def rgb(colour):
    return tuple(round(255 * value) for value in channels(colour))


# --- meshes -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ending", MESHES)
def test_another_program_reads_every_vertex_and_triangle(tmp_path, ending):
    picture = draw(BUSH, 4)
    parts = kept(picture, tmp_path / f"bush{ending}").geometry.values()
    assert sum(len(part.faces) for part in parts) == len(picture.mesh.triangles)
    count = (
        sum(len(part.vertices) for part in parts) if ending == ".glb" else (tmp_path / "bush.obj").read_text().count("\nv ")
    )  # trimesh joins vertices of an .obj file
    assert count == len(picture.mesh.vertices)


@pytest.mark.parametrize("ending", MESHES)
def test_a_kept_mesh_is_as_large_as_the_scene_and_stands_upright(tmp_path, ending):
    picture = draw(BUSH, 4)
    (left, front, bottom), (right, back, top) = (mine.tolist() for mine in picture.mesh.corners)
    for mine, its in zip((picture.mesh.corners[0], picture.mesh.corners[1]), picture.solid.corners, strict=True):
        assert mine == pytest.approx(its, abs=0.2)  # half a stem's width
    bounds = kept(picture, tmp_path / f"bush{ending}").bounds
    assert bounds.ravel() == pytest.approx([left, bottom, -back, right, top, -front], rel=1e-5)


def test_a_glb_has_the_colours_of_the_drawing(tmp_path):
    loaded = kept(draw(LINE, 0), tmp_path / "line.glb")
    assert painted(tmp_path / "line.glb") == {
        (*(round(value, 6) for value in light(colour)), 1.0) for colour in (colours(LINE)["F"], CHOSEN[4])
    }
    assert {part.visual.material.name for part in loaded.geometry.values()} == {colours(LINE)["F"], CHOSEN[4]}


def test_an_obj_has_the_colours_of_the_drawing_beside_it(tmp_path):
    draw(LINE, 0).save(tmp_path / "my line.obj")
    text = (tmp_path / "my line.obj").read_text()
    assert "mtllib my_line.mtl\n" in text
    lines = (tmp_path / "my_line.mtl").read_text().splitlines()
    kinds = {tuple(round(255 * float(value)) for value in line.split()[1:]) for line in lines if line.startswith("Kd ")}
    assert kinds == {rgb(colours(LINE)["F"]), rgb(CHOSEN[4])}
    assert {line.split()[1] for line in text.splitlines() if line.startswith("usemtl")} == {
        line.split()[1] for line in lines if line.startswith("newmtl")
    }


def test_the_sides_of_a_kept_mesh_are_where_its_normals_say(tmp_path):
    for part in kept(draw(BUSH, 4), tmp_path / "bush.glb").geometry.values():
        along = np.einsum("ij,ij->i", part.face_normals, part.vertex_normals[part.faces].mean(axis=1))
        assert (along > -0.01).mean() > 0.99


def test_a_stroke_kept_is_closed(tmp_path):
    assert kept(draw(read("axiom: F&(90)"), 0), tmp_path / "f.glb").to_geometry().is_watertight


def test_a_glb_is_laid_out_as_its_standard_says():
    """glTF 2.0, section 4.4: a head of 12 bytes, then chunks of whole words; 3.6.2.4: numbers lie at whole words."""
    from lsys_kit.pictures.formats.mesh_files import glb

    picture = draw(BUSH, 3)
    content = glb(picture.mesh, picture.colour_of)
    assert struct.unpack("<4sII", content[:12]) == (b"glTF", 2, len(content))
    length, kind = struct.unpack("<I4s", content[12:20])
    tree, rest = json.loads(content[20 : 20 + length]), content[20 + length :]
    assert (length % 4, kind, rest[4:8]) == (0, b"JSON", b"BIN\0")
    assert struct.unpack("<I", rest[:4])[0] == len(rest) - 8 == tree["buffers"][0]["byteLength"]
    assert all(view["byteOffset"] % 4 == 0 for view in tree["bufferViews"])
    assert {accessor["count"] > 0 for accessor in tree["accessors"]} == {True}


def test_where_nothing_is_drawn_the_files_are_empty_but_sound(tmp_path):
    picture = draw(read("axiom: A"), 0)
    picture.save(tmp_path / "a.glb")
    picture.save(tmp_path / "a.obj")
    assert struct.unpack("<4sII", (tmp_path / "a.glb").read_bytes()[:12])[2] == (tmp_path / "a.glb").stat().st_size
    assert b"\nv " not in (tmp_path / "a.obj").read_bytes()


def test_a_filament_is_kept_as_a_row_of_round_cells(tmp_path):
    bounds = kept(draw(system("J1"), 5), tmp_path / "filament.glb").bounds
    assert bounds.ravel() == pytest.approx([0, -0.5, -0.5, 21, 0.5, 0.5], abs=1e-5)


def test_meshes_are_the_same_every_time(tmp_path):
    for name in ("one", "two"):
        for ending in MESHES:
            draw(BUSH, 3).save(tmp_path / f"{name}{ending}")
    assert (tmp_path / "one.glb").read_bytes() == (tmp_path / "two.glb").read_bytes()
    assert (tmp_path / "one.mtl").read_bytes() == (tmp_path / "two.mtl").read_bytes()
    assert (tmp_path / "one.obj").read_bytes().replace(b"one", b"two") == (tmp_path / "two.obj").read_bytes()


def test_a_strangers_file_beside_an_obj_is_not_replaced(tmp_path):
    (tmp_path / "plant.mtl").write_text("newmtl mine\n")
    with pytest.raises(ModelFileError, match="was not made by the kit"):
        draw(BUSH, 1).save(tmp_path / "plant.obj")
    assert (tmp_path / "plant.mtl").read_text() == "newmtl mine\n"
    assert not (tmp_path / "plant.obj").exists()
    draw(BUSH, 1).save(tmp_path / "bush.obj")
    draw(LINE, 0).save(tmp_path / "bush.obj")
    assert "colour_" in (tmp_path / "bush.mtl").read_text()


@pytest.mark.slow
def test_a_hundred_thousand_strokes_are_kept_in_seconds(tmp_path):
    picture = draw(read("angle: 22.5\naxiom: F(1)\nF(x) -> !(0.1*x) F(x/2)[&F(x/2)][/(140)&F(x/2)]F(x/2)"), 8)
    with spent() as taken:
        picture.save(tmp_path / "large.glb")
    assert taken.seconds < 10
    assert len(mesh_of(picture.solid).triangles) > 650_000


# --- pages ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("id", ["J1", "K5", "K14"])
def test_a_page_is_the_same_every_time(tmp_path, id):
    for name in ("a", "b"):
        draw(system(id), 3).save(tmp_path / f"{name}.pdf")
    page = (tmp_path / "a.pdf").read_bytes()
    assert page.startswith(b"%PDF-1.")
    assert page.rstrip().endswith(b"%%EOF")
    assert page == (tmp_path / "b.pdf").read_bytes()
    assert b"CreationDate" not in page


def test_a_page_says_what_it_shows(tmp_path):
    draw(system("T2"), 3).save(tmp_path / "koch.pdf")
    assert b"/Title (192 segments, width 27, height 31.18)" in (tmp_path / "koch.pdf").read_bytes()


# --- films ------------------------------------------------------------------------------------------------------------


def frames(content):
    return [frame.convert("RGB").copy() for frame in ImageSequence.Iterator(Image.open(io.BytesIO(content)))]


@pytest.mark.slow
@pytest.mark.parametrize("form", ["gif", "apng"])
@pytest.mark.parametrize("id", ["T2", "J1", "K14"])
def test_a_film_has_a_picture_for_each_step(id, form):
    film = animate(system(id), 4)
    shown = frames(getattr(film, form))
    assert len(shown) == len(film.images) == 5
    assert {frame.size for frame in shown} == {film.images[0].size}


def test_an_apng_has_exact_colours():
    film = animate(system("T2"), 3)
    assert [frame.tobytes() for frame in frames(film.apng)] == [image.tobytes() for image in film.images]


def test_what_has_been_drawn_stays_where_it_is():
    """One frame for all steps: a stem that grows covers itself."""
    film = animate(read("axiom: F\nF -> FF"), 4)
    inked = [np.array(image.convert("L")) < 200 for image in film.images]
    heights = [int(np.flatnonzero(ink.any(axis=1)).size) for ink in inked]
    for before, after in pairwise(heights):
        assert after == pytest.approx(2 * before, abs=4)
    assert (inked[-2] & ~inked[-1]).sum() < 10


def test_the_rows_of_a_filament_appear_one_after_another():
    images = [np.array(image.convert("L"))[:, 60:] < 230 for image in animate(system("J1"), 5).images]  # without the mark
    for before, after in pairwise(images):
        assert (before & ~after).sum() < 100  # at edges over the mark
        assert after.sum() > before.sum() + 300


def test_the_last_step_is_held():
    gif = Image.open(io.BytesIO(animate(system("T2"), 3, seconds="0.25").gif))
    assert [frame.info["duration"] for frame in ImageSequence.Iterator(gif)] == [250, 250, 250, 1000]
    assert gif.info["loop"] == 0


@pytest.mark.parametrize("text", ["axiom: A\nA -> B\nB -> A F", "axiom: F\nF -> F", "axiom: F\nF -> F[+F]"])
def test_a_film_lasts_as_long_as_its_steps_where_nothing_changes_too(text):
    film = Image.open(io.BytesIO(animate(read(text), 5, seconds="0.5").gif))
    times = [frame.info["duration"] for frame in ImageSequence.Iterator(film)]
    assert sum(times) == 5 * 500 + 2000
    assert times[-1] >= 2000


@pytest.mark.slow
def test_a_gif_of_many_colours_looks_like_its_pictures():
    film = animate(BUSH, 5)
    for shown, image in zip(frames(film.gif), film.images, strict=True):
        assert np.abs(np.array(shown, int) - np.array(image)).mean() < 1


@pytest.mark.slow
def test_a_film_is_the_same_every_time():
    one, two = animate(system("K5"), 3), animate(system("K5"), 3)
    assert (one.gif, one.apng) == (two.gif, two.apng)


@pytest.mark.slow
def test_a_film_of_a_derivation_is_that_of_its_system():
    assert animate(derive(system("T2"), 3)).gif == animate(system("T2"), 3).gif


@pytest.mark.slow
def test_a_film_takes_what_a_drawing_takes():
    assert animate(system("T2"), 3, angle=50).gif != animate(system("T2"), 3).gif
    assert str(animate(system("J4"), 6, lifeTimeA=2)) != str(animate(system("J4"), 6))


@pytest.mark.parametrize(
    ("what", "choices", "said"),
    [
        ("K5", {}, "can be animated, not str"),
        (derive(system("K5"), 1)[1], {}, "can be animated, not Word"),
        (system("K5"), {"n": 2, "seconds": 0}, "0.02 to 60 seconds, not for 0"),
        (system("K5"), {"n": 2, "seconds": 61}, "0.02 to 60"),
        (derive(system("K5"), 1), {"n": 2}, "when a system is derived"),
    ],
    ids=str,
)
def test_what_makes_no_film_is_said(what, choices, said):
    with pytest.raises(ModelValueError, match=said):
        animate(what, **choices)


def test_a_film_has_an_end():
    with pytest.raises(ModelLimitError, match="1,001 pictures is too long; it can have 300"):
        animate(read("axiom: F\nF -> F"), 1000)


def test_a_notebook_shows_a_film():
    bundle = animate(system("T2"), 2)._repr_mimebundle_()
    assert bundle["text/plain"] == "steps 0 to 2; the last: 48 segments, width 9, height 10.39"
    assert bundle["image/gif"].startswith("R0lGOD")


# --- from the shell ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("ending", "head"), beginnings(*DRAWINGS, *(each for each in FILMS if each != ".mp4")))
@pytest.mark.parametrize("id", ["K5", "J1", "K14"])
def test_the_shell_writes_each_format(tmp_path, capsys, id, ending, head):
    assert main(["draw", id, "-n", "2", "-o", str(tmp_path / f"out{ending}")]) == 0
    assert (tmp_path / f"out{ending}").read_bytes().startswith(head)
    assert capsys.readouterr().out.startswith("steps 0 to 2" if ending in FILMS or id == "J1" else str(draw(system(id), 2)))


def test_the_shell_chooses_the_pace_of_a_film(tmp_path, capsys):
    assert main(["draw", "T2", "-n", "2", "--seconds", "1/4", "-o", str(tmp_path / "out.gif")]) == 0
    assert Image.open(tmp_path / "out.gif").info["duration"] == 250


def test_the_shell_names_the_formats(tmp_path, capsys):
    assert main(["draw", "K5", "-n", "2", "-o", str(tmp_path / "out.stl")]) == 2
    assert f"{SAID_OF_DRAWINGS}. Films end in {SAID_OF_FILMS}" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["", ".", "..", "out", ".obj", "a\0b.svg", "x" * 300 + ".glb", "nowhere/out.obj"])
@pytest.mark.parametrize("what", [draw(LINE, 0), animate(LINE, 0), draw(stages(system("J1")))], ids=["drawing", "film", "net"])
def test_a_name_that_is_none_is_an_error_of_the_kit(tmp_path, what, name):
    with pytest.raises(ModelFileError):
        what.save(tmp_path / name if name and name[0] != "." else name)


# --- into figures of one's own ----------------------------------------------------------------------------------------


def test_a_system_gives_its_picture():
    assert system("T2").picture(3).svg == draw(system("T2"), 3).svg
    assert str(system("J4").picture(6, lifeTimeA=2)) == str(draw(system("J4"), 6, lifeTimeA=2))


@pytest.mark.slow
def test_two_drawings_stand_in_a_teachers_plot():
    from matplotlib.figure import Figure

    sheet = Figure(figsize=(8, 4))
    left, right = sheet.subplots(1, 2)
    figure(system("K5"), left, n=3)
    figure(draw(BUSH, 4), ax=right)
    right.set_title("A bush", parse_math=False)
    buffer = io.BytesIO()
    sheet.savefig(buffer, format="png")
    pixels = np.array(Image.open(buffer).convert("L")) < 240
    half = pixels.shape[1] // 2
    assert pixels[:, :half].any()
    assert pixels[:, half:].any()
    assert right.get_title() == "A bush"


def test_strokes_are_as_thick_as_their_place_in_the_figure_is_large():
    from matplotlib.figure import Figure

    small, large = (Figure(figsize=size).add_subplot() for size in ((3, 2), (12, 8)))
    figure(draw(BUSH, 3), small)
    figure(draw(BUSH, 3), large)
    thick = [max(float(max(strokes.get_linewidths())) for strokes in ax.collections) for ax in (small, large)]
    assert thick[1] > 3 * thick[0]


def test_a_drawing_needs_axes_in_the_plane():
    from matplotlib.figure import Figure

    with pytest.raises(ModelValueError, match="axes in the plane"):
        figure(draw(BUSH, 2), Figure().add_subplot(projection="3d"))


def test_what_a_picture_shows_is_not_chosen_for_its_figure():
    with pytest.raises(ModelValueError, match="is chosen when it is drawn"):
        figure(draw(BUSH, 1), n=2)


@pytest.mark.slow
def test_no_window_and_no_pyplot_is_opened_by_an_export(tmp_path):
    code = (
        "import sys; from lsys_kit import *; p = draw(system('K14'), 2)\n"
        "for ending in ('pdf', 'png', 'glb', 'obj', 'svg'): p.save(sys.argv[1] + '/a.' + ending)\n"
        "animate(system('K14'), 2).save(sys.argv[1] + '/a.gif'); print('matplotlib.pyplot' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout == "False\n"


@pytest.mark.parametrize("ending", MESHES)
def test_a_mesh_is_written_within_the_limit_of_bytes(tmp_path, ending):
    with limits(bytes=2_400), pytest.raises(ModelLimitError, match="The file was not written: it would take"):
        draw(read("axiom: &F")).save(tmp_path / f"stroke{ending}")
    draw(read("axiom: &F")).save(tmp_path / f"stroke{ending}")


def test_what_a_picture_or_a_file_is_made_of_is_given_up_in_time(tmp_path):
    tree, plant = draw(lineage(read("axiom: a\na -> a\ndepth: 100\ninterpretation:\na -> a a"), 2)), draw(BUSH, 3)
    with limits(seconds=0.01), pytest.raises(ModelLimitError, match=r"The picture was not drawn in 0\.01 seconds"):
        assert tree.svg
    with limits(seconds=1e-9), pytest.raises(ModelLimitError, match="in 1e-09 seconds"):
        plant.save(tmp_path / "plant.obj")


@pytest.mark.parametrize("function", [draw, animate])
def test_a_timed_system_has_no_picture_of_its_own_and_what_has_one_is_named(function):
    growing = timed(system("K27"))
    with pytest.raises(ModelValueError) as refused:
        function(growing, 4)
    name = function.__name__
    assert f"{name}(lineage(timed(system), 4))" in refused.value.hint
    assert "draw(timed(system).word(4))" in refused.value.hint
    assert repr(function(lineage(growing, 4))) == "lineage of 5 cells at time 4, after 4 divisions"
    assert repr(draw(growing.word(4))).startswith("5 cells")
    assert repr(animate([draw(growing.word(time)) for time in range(4)])).startswith("4 pictures")
    with pytest.raises(ModelValueError, match="For example"):
        function("K5")
