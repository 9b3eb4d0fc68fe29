"""Files are written whole or not at all, and nothing is lost that the kit did not make itself."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from lsys_kit import animate, draw, lineage, map_system, stages, system
from lsys_kit.errors import ModelFileError
from lsys_kit.files import create_file, file_stem, made_by_the_kit, replace_file, save_file
from tests.endings import DRAWINGS, FILMS, NETS

SAVED: dict[str, Callable[[Path], None]] = {
    **{ending: lambda path: draw(system("K5"), 2).save(path) for ending in DRAWINGS},
    **{f".film{ending}": lambda path: animate(system("K5"), 2).save(path) for ending in (*FILMS, ".png")},
    **{f".net{ending}": lambda path: draw(stages(system("P2"))).save(path) for ending in NETS},
    ".map.svg": lambda path: draw(map_system("K28"), 2).save(path),
    ".lineage.svg": lambda path: draw(lineage(system("P6"), 2)).save(path),
}
"""Everything that can be saved, by the name of its file."""


@pytest.mark.slow
@pytest.mark.parametrize("name", SAVED)
def test_what_the_kit_has_saved_may_be_saved_again(name: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{name}"
    SAVED[name](path)
    first = path.read_bytes()
    SAVED[name](path)
    assert made_by_the_kit(path)
    assert path.read_bytes() == first


@pytest.mark.slow
@pytest.mark.parametrize("name", SAVED)
@pytest.mark.parametrize("strange", ["file", "empty", "folder", "link", "dead link"])
def test_what_somebody_else_made_is_not_replaced(name: str, strange: str, tmp_path: Path) -> None:
    path, elsewhere = tmp_path / f"a{name}", tmp_path / "elsewhere"
    if strange == "folder":
        path.mkdir()
    elif strange == "link":
        SAVED[name](tmp_path / f"own{name}")
        path.symlink_to(tmp_path / f"own{name}")
    elif strange == "dead link":
        path.symlink_to(elsewhere)
    else:
        path.write_text("mine" if strange == "file" else "")
    before = sorted(file.name for file in tmp_path.iterdir() if file.suffix != ".mtl")
    with pytest.raises(ModelFileError, match="was not made by the kit"):
        SAVED[name](path)
    assert sorted(file.name for file in tmp_path.iterdir() if file.suffix != ".mtl") == before
    assert not elsewhere.exists()
    assert strange != "file" or path.read_text() == "mine"


def in_a_small_space(code: str, folder: Path) -> str:
    """What a program prints that may write no file of more than 500 bytes, as on a disk that is full."""
    limited = f"import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (500, 500))\n{code}"
    done = subprocess.run(
        [sys.executable, "-c", limited],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parent.parent)},
        check=False,
    )
    return done.stdout + done.stderr


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit on the size of files")
def test_a_full_disk_leaves_the_old_picture(tmp_path: Path) -> None:
    draw(system("K5"), 1).save(tmp_path / "plant.svg")
    before = (tmp_path / "plant.svg").read_bytes()
    said = in_a_small_space("from lsys_kit import draw, system\ndraw(system('K5'), 4).save('plant.svg')", tmp_path)
    assert '"plant.svg" cannot be written: File too large' in said
    assert (tmp_path / "plant.svg").read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["plant.svg"]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit on the size of files")
def test_a_full_disk_leaves_no_half_model_and_no_half_course(tmp_path: Path) -> None:
    convert_k12 = "from lsys_kit.__main__ import main\nprint(main(['convert', 'K12', '--to', 'grogra', '-o', 'K12.txt']))"
    copy = "from lsys_kit.classroom.course import copy_course\ncopy_course('course')"
    assert '"K12.txt" cannot be written' in in_a_small_space(convert_k12, tmp_path)
    assert "The course cannot be copied" in in_a_small_space(copy, tmp_path)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []


def test_a_new_file_replaces_nothing(tmp_path: Path) -> None:
    create_file(tmp_path / "a", b"first")
    with pytest.raises(FileExistsError):
        create_file(tmp_path / "a", b"second")
    assert (tmp_path / "a").read_bytes() == b"first"
    assert len(list(tmp_path.iterdir())) == 1


def test_a_link_is_replaced_and_not_followed(tmp_path: Path) -> None:
    (tmp_path / "other").write_bytes(b"other")
    (tmp_path / "link").symlink_to(tmp_path / "other")
    replace_file(tmp_path / "link", b"new")
    assert (tmp_path / "other").read_bytes() == b"other"
    assert not (tmp_path / "link").is_symlink()


def test_what_kind_of_file_it_may_be_stays(tmp_path: Path) -> None:
    save_file(tmp_path / "a.svg", b"<!-- lsys-kit -->1")
    (tmp_path / "a.svg").chmod(0o640)
    save_file(tmp_path / "a.svg", b"<!-- lsys-kit -->2")
    assert (tmp_path / "a.svg").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize(
    ("title", "stem"),
    [
        ("J4: Anabaena", "J4 Anabaena"),
        ("../../etc/passwd", "etc passwd"),
        ("a\x00b\u202ec", "a b c"),
        ("x" * 99, "x" * 60),
        ("", "plant-0000"),
        ("...", "plant-0000"),
        ("CON|*?", "CON"),
        ("Šárka", "Šárka"),
        ("\ud800", "plant-0000"),
    ],
)
def test_a_title_is_the_name_of_a_file_as_far_as_that_can_have_its_characters(title: str, stem: str) -> None:
    assert file_stem(title, "plant", "") == stem
