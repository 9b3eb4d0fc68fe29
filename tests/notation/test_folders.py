"""A model's folder: what stands beside it is used, what stands outside is never opened."""

from __future__ import annotations

import zipfile
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

from lsys_kit.commands import named_system
from lsys_kit.derivation.derive import derive
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError, ModelSyntaxError, ModelValueError
from lsys_kit.notation import folders
from lsys_kit.notation.dialects.cpfg.view_files import CLOSE, MOST_PIECES, _curve
from lsys_kit.notation.folders import opened_folder
from lsys_kit.notation.read import read

LEAF = """0 2 0 1 0 0
CONTACT POINT  X: 0 Y: 0 Z: 0
END POINT  X: 0 Y: 2 Z: 0
HEADING  X: 0 Y: 1 Z: 0
UP  X: 0 Y: 0 Z: 1
SIZE: 2
patch
0 0 0  0 0 0  0 0 0  0 0 0
0 1 0  1 1 0  1 1 0  2 1 0
0 1 0  1 1 0  1 1 0  2 1 0
0 2 0  0 2 0  0 2 0  0 2 0
"""
EVEN = "range: 0.0 1.0\npoints: 4\n0 0\n0.333333 0.333333\n0.666667 0.666667\n1 1\n"
"""A function that gives back what it is given."""
STEEP = "fver 1 1\nname: steep\nsamples: 100\nflip: off\npoints: 5\n0 0 1\n0.2 0 1\n0.5 0 2\n0.5 1 2\n1 1 1\n"
PLANT = """#include "sizes.h"
#define STEPS 4
Lsystem: 1
derivation length: STEPS
Axiom: A(0)
A(t) --> F(LONG*func(1,t/4))[+~l(func(2,t))]A(t+1)
endlsystem
"""
OBJECT = {
    "plant.l": PLANT,
    "panel.l": "panel name: plant\n",
    "plant.v": "angle factor: 16 // 22.5 degrees\n/* scale factor: 1 */\n"
    "z buffer: on\nlight: V: 1 0 0\nlight: V: 0 1 0\nfunction: even.func 100\n"
    "function: steep.func 100\nsurface: l leaf.s 2 8 4\n",
    "even.func": EVEN,
    "steep.func": STEEP,
    "leaf.s": LEAF,
    "sizes.h": "#define LONG 2\n",
    "plant.map": "colours",
    "plant.a": "last frame: 20",
    "specifications": "plant.l\nplant.v\nmodel:\n\tgenerate:\n\t\tcpfg -m plant.map plant.l plant.v\n",
}


@pytest.fixture
def made(tmp_path: Path):
    """What makes a folder of some files."""

    def make(files: dict[str, str], name: str = "object") -> Path:
        folder = tmp_path / name
        folder.mkdir()
        for each, text in files.items():
            (folder / each).write_text(text, encoding="utf-8")
        return folder

    return make


def test_view_surfaces_functions_and_what_is_included_are_used(made) -> None:
    system = read(made(OBJECT))
    assert (system.angle, system.steps, [shape.name for shape in system.surfaces]) == (Fraction(45, 2), 4, ["l"])
    assert system.surfaces[0].patches[0][12] == (2, 0, 0)  # as large as the view says
    lengths = [float(module.arguments[0]) for module in derive(system, 4)[-1] if module.symbol == "F"]
    assert lengths == pytest.approx([0, 0.5, 1, 1.5])
    assert system.notes == (
        'Read as cpfg, from "plant.l" and "plant.v".',
        'Not used of "plant.v": z buffer, light.',
        'Colours are those of the kit, not those of "plant.map".',
        'How a model is animated is not read: "plant.a".',
        "func(1, ...) is a curve, here of one straight piece.",
        "func(2, ...) is a curve, here of 16 straight pieces.",
    )
    assert read(str(system)) == system


def test_an_archive_a_folder_and_the_model_itself_are_one(made, tmp_path: Path) -> None:
    folder = made(OBJECT)
    with zipfile.ZipFile(tmp_path / "object.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("__MACOSX/object/plant.l", "no model")
        archive.writestr("object/", "")
        for name, text in OBJECT.items():
            archive.writestr(f"object/{name}", text)
    system = read(folder)
    assert read(tmp_path / "object.zip") == read(folder / "plant.l") == read(folder, "cpfg", "plant") == system


def test_functions_of_a_set_have_names(made) -> None:
    files = {
        "a.l": "#define FIRST 1\nLsystem: 1\n/* angle: 10 */\n"
        "Axiom: A(func(FIRST,0.25),func(even,func(1,0.5)),func(9,1))\nA(x,y,z) --> B",
        "a.v": "angle factor: 4\nfunction set: all.fset\n",
        "all.fset": f"funcgalleryver 1 1\nitems: 1\nfver 1 1\nname: even\n{EVEN}",
    }
    with pytest.raises(LSystemError, match=r"The kit has no func"):
        read(made(files))
    files["a.l"] = files["a.l"].replace(",func(9,1)", ",func(even,9)-func(even,-9)")
    system = read(made(files, "other"))
    assert system.angle == 10  # what the model itself says counts
    assert [float(value) for value in derive(system, 0)[0][0].arguments] == pytest.approx([0.25, 0.5, 1])


def test_a_curve_of_straight_pieces_is_near_the_curve() -> None:
    """And a spline of four points is a Bezier curve."""
    assert [*_curve(EVEN, "")] == [(0, 0), (1, 1)]
    assert _curve("0 3\n0.3 3\n0.6 3\n1 3", "") == [(0, 3), (1, 3)]
    curve = _curve("0 0\n0.333333333 1\n0.666666667 1\n1 0", "")
    assert len(curve) <= MOST_PIECES + 1
    for x in (index / 100 for index in range(101)):
        (left, below), (right, above) = next(pair for pair in pairwise(curve) if pair[0][0] <= x <= pair[1][0])
        assert below + (above - below) * (x - left) / (right - left) == pytest.approx(3 * x * (1 - x), abs=2 * CLOSE)


@pytest.mark.parametrize(
    "text",
    [
        "0 0\n0.5 1\n1 0",
        "0 0\n0.6 0\n0.4 0\n1 0",
        "0.1 0\n0.3 0\n0.6 0\n1 0",
        "0 0\n0.3 0\n0.6 0\n0.9 0",
        "flip: on\n0 0\n0.3 0\n0.6 0\n1 0",
    ],
)
def test_what_is_no_function_is_named(made, text: str) -> None:
    with pytest.raises(ModelFileError, match=r'"even\.func" is no function that the kit can read'):
        read(made({**OBJECT, "even.func": text}))


@pytest.mark.parametrize(
    ("files", "note"),
    [
        ({"a.l": "Lsystem: 1\nAxiom: F+", "b.v": "angle factor: 6", "c.v": "angle factor: 8"}, "There are several views"),
        ({"a.l": "Lsystem: 1\nAxiom: F+", "a.v": "angle factor: 6", "c.v": "angle factor: 8"}, 'from "a.l" and "a.v"'),
        ({"a.l": "Lsystem: 1\nAxiom: F+", "c.v": "angle factor: 8"}, 'from "a.l" and "c.v"'),
        ({"a.l": "Lsystem: 1\nAxiom: F+"}, "cpfg keeps the angle"),
        (
            {"a.l": "Lsystem: 1\nAxiom: F~x", "a.v": "surface: x x.s 1\nsurface: y\nfunction: z.func"},
            '"x.s" is not in the folder',
        ),
    ],
)
def test_ties_and_what_is_missing_are_told(made, files: dict[str, str], note: str) -> None:
    system = read(made(files))
    assert any(note in each for each in system.notes)
    assert system.angle == (90 if "several" in note or "cpfg" in note or "x.s" in note else 60 if '"a.v"' in note else 45)


def test_a_folder_may_have_several_models(made) -> None:
    folder = made({"a.l": "axiom: A", "b.l": "axiom: B", "c.l": "nothing"})
    with pytest.raises(ModelValueError, match="There are 2 models") as caught:
        read(folder)
    assert "a.l, b.l" in (caught.value.hint or "")
    assert [str(read(folder, name=name).axiom[0]) for name in ("b", "b.l", "a")] == ["B", "B", "A"]
    collection = made({"all.l": "Koch { Angle 6\nAxiom F }\nLine { Angle 4\nAxiom FF }"}, "fractint")
    assert len(read(collection, name="Line").axiom) == len(read(collection / "all.l", name="Line").axiom) == 2


def test_a_mistake_is_shown_in_the_model_as_it_is(made) -> None:
    with pytest.raises(ModelSyntaxError) as caught:
        read(made({**OBJECT, "plant.l": PLANT.replace("A(t+1)", "A(t+1")}))
    assert (caught.value.line, caught.value.source) == (6, PLANT.replace("A(t+1)", "A(t+1"))
    for call in ("func(1,ran(3))", "func(1,nran(0,1)*2)"):
        with pytest.raises(ModelValueError, match="cannot be random") as random:
            read(made({**OBJECT, "plant.l": PLANT.replace("func(2,t)", call)}, call[:9]))
        assert random.value.line == 6


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("plant.v", "angle factor: none", "This angle factor is no positive number"),
        ("plant.v", "angle factor: 0", "This angle factor is no positive number"),
        ("plant.v", "angle factor:", "This angle factor is no positive number"),
        ("leaf.s", "SIZE: 0", '"leaf.s" is no surface'),
        ("sizes.h", '#include "sizes.h"\n', "includes itself"),
        ("plant.l", "Lsystem: 1\nAxiom: func(1", "is never closed"),
        ("plant.l", "Lsystem: 1\nAxiom: A(func(1))", "The kit has no func"),
    ],
)
def test_a_mistake_in_a_file_is_named(made, name: str, text: str, said: str) -> None:
    with pytest.raises(LSystemError, match=said):
        read(made({**OBJECT, name: text}))


def test_a_macro_that_is_called_as_a_setting_stays_where_it_is_used(made) -> None:
    system = read(made({**OBJECT, "plant.l": PLANT.replace("STEPS", "steps_").replace("#define LONG", "#define LONG")}))
    assert [constant.name for constant in system.constants] == ["LONG", "steps_"]
    assert [constant.name for constant in read(made(OBJECT, "other")).constants] == ["LONG"]


def zipped(path: Path, files: dict[str, str], link: str = "") -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            member = zipfile.ZipInfo(name)
            member.compress_type = zipfile.ZIP_DEFLATED
            if name == link:
                member.external_attr = 0o120777 << 16
            archive.writestr(member, text)
    return path


@pytest.mark.parametrize("name", ["../plant.l", "/plant.l", "a/../../plant.l", "C:plant.l", "..\\plant.l"])
def test_a_name_that_leads_out_of_an_archive_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ModelFileError, match="has a file outside of it"):
        read(zipped(tmp_path / "bad.zip", {"plant.l": "axiom: F", name: "axiom: F"}))


def test_links_are_passed_over(made, tmp_path: Path) -> None:
    folder = made({"a.l": '#include "secret.h"\nLsystem: 1\nAxiom: F'})
    (tmp_path / "secret.h").write_text("#define secret 1", encoding="utf-8")
    (folder / "secret.h").symlink_to(tmp_path / "secret.h")
    (folder / "inner").mkdir()
    with pytest.raises(ModelSyntaxError, match=r'"secret\.h" is not part of this text'):
        read(folder)
    archive = zipped(tmp_path / "a.zip", {"a.l": "axiom: F", "b.l": "/etc/passwd"}, link="b.l")
    assert str(read(archive).axiom[0]) == "F"


def test_what_is_too_large_is_refused(tmp_path: Path, made, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ModelLimitError, match=r"longer than 1,000,000 characters"):
        read(zipped(tmp_path / "bomb.zip", {"plant.l": "axiom: F\n" + " " * 50_000_000}))
    monkeypatch.setattr(folders, "MOST_FILES", 2)
    folder = made({"a.l": "axiom: F", "b": "", "c": ""})
    for many in (folder, zipped(tmp_path / "many.zip", {"a.l": "axiom: F", "b": "", "c": ""})):
        with pytest.raises(ModelLimitError, match="more than 2 files"):
            read(many)
    assert str(read(folder / "a.l").axiom[0]) == "F"  # a file alone is read wherever it is
    monkeypatch.setattr(folders, "MOST_BYTES", 10)
    with pytest.raises(ModelLimitError, match="larger than 10 bytes"):
        read(tmp_path / "many.zip")


def test_what_is_no_folder_and_no_archive_is_named(tmp_path: Path, made) -> None:
    with pytest.raises(ModelFileError, match="No such file"):
        read(tmp_path / "none.l")
    with pytest.raises(ModelFileError, match='There is no model in "empty"'):
        read(made({"a.txt": "axiom: F"}, "empty"))
    whole = zipped(tmp_path / "whole.zip", {"plant.l": "axiom: F" * 500})
    content = bytearray(whole.read_bytes())
    content[60:70] = bytes(10)
    (tmp_path / "broken.zip").write_bytes(content)
    with pytest.raises(ModelFileError, match=r'"plant\.l" cannot be read'):
        read(tmp_path / "broken.zip")
    content = bytearray(whole.read_bytes())
    at = content.rindex(b"PK\x01\x02")
    content[at : at + 4] = b"PK\x01\x09"
    (tmp_path / "torn.zip").write_bytes(content)
    with pytest.raises(ModelFileError, match="is no complete archive"):
        read(tmp_path / "torn.zip")
    with zipfile.ZipFile(tmp_path / "packed.zip", "w", zipfile.ZIP_BZIP2) as archive:
        archive.writestr("plant.l", "axiom: F")
    with pytest.raises(ModelFileError, match="packed in an unusual way"):
        read(tmp_path / "packed.zip")


@pytest.mark.parametrize("text", ["objects/lily", "lily.l", "C:\\models\\lily.zip", "../lily.l"])
def test_a_text_never_opens_a_file(text: str) -> None:
    with pytest.raises(ModelValueError, match="the name of a file or a folder, and a text never opens one") as caught:
        read(text)
    assert "read(Path(" in (caught.value.hint or "")


def test_the_files_of_a_folder_are_known_by_their_endings(made) -> None:
    assert opened_folder(made(OBJECT)).named(".func") == ["even.func", "steep.func"]


def test_the_shell_reads_a_folder_and_an_archive(made, tmp_path: Path) -> None:
    folder = made(OBJECT)
    with zipfile.ZipFile(tmp_path / "object.ZIP", "w") as archive:
        for name, text in OBJECT.items():
            archive.writestr(name, text)
    assert named_system(str(folder), None, None) == named_system(str(tmp_path / "object.ZIP"), None, None) == read(folder)


def test_curves_of_curves_do_not_grow_without_end(made) -> None:
    value = "t"
    for _ in range(8):
        value = f"func(2,{value})"
    with pytest.raises(ModelLimitError, match="With its curve this value is longer than 2,000 characters") as caught:
        read(made({**OBJECT, "plant.l": PLANT.replace("func(2,t)", value)}))
    assert caught.value.line == 6
