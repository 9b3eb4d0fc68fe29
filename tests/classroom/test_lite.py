"""The course in a JupyterLab that runs in a browser: what is written, what comes from elsewhere, and what is never replaced."""

from __future__ import annotations

import base64
import csv
import gzip
import hashlib
import io
import json
import subprocess
import sys
import zipfile
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement

import lsys_kit as kit
import lsys_kit.__main__ as shell
from lsys_kit.classroom.authoring.new import write_lesson
from lsys_kit.classroom.course import course_files, is_lesson, students_copy
from lsys_kit.classroom.lite import wheels as wheels_module
from lsys_kit.classroom.lite.build import EXTENSIONS, HOME, KERNEL, LOCK, MADE, build_lite
from lsys_kit.classroom.lite.wheels import KIT, Wheel, distribution, wheels
from lsys_kit.classroom.places import VARIABLE
from tests.pyodide import TOLD, integrity, pyodide_folder

STORED = gzip.decompress((files("lsys_kit.classroom.lite") / f"{LOCK}.gz").read_bytes())


@pytest.fixture(scope="module")
def lock() -> Any:
    return json.loads(STORED)


@pytest.fixture(scope="module")
def made(lock: Any) -> tuple[Wheel, ...]:
    return wheels(lock)


@pytest.mark.slow
def test_the_stored_lock_file_is_that_of_the_pinned_pyodide(pytestconfig: pytest.Config) -> None:
    assert integrity(STORED) == TOLD["files"][LOCK]["integrity"]
    assert (pyodide_folder(pytestconfig) / LOCK).read_bytes() == STORED


@pytest.mark.slow
def test_pyodide_or_a_wheel_has_all_that_the_kit_needs_new_enough(lock: Any, made: tuple[Wheel, ...]) -> None:
    there = {name: each["version"] for name, each in lock["packages"].items()} | {each.name: each.version for each in made}
    needed = [each for each in map(Requirement, distribution(KIT).requires or ()) if each.marker is None]
    assert len(needed) > 10
    for each in needed:
        assert each.specifier.contains(there[each.name]), each
    assert {each.name for each in made} >= {KIT, "lark", "anywidget", "ipywidgets", "psygnal"}
    assert not {"numpy", "scipy", "sympy", "matplotlib"} & {each.name for each in made}


def test_a_pyodide_whose_packages_are_too_old_is_refused(lock: Any) -> None:
    old = {**lock["packages"], "numpy": {**lock["packages"]["numpy"], "version": "1.20.0"}}
    with pytest.raises(kit.LSystemError, match=r"This Pyodide has numpy 1\.20\.0, and numpy>=1\.26 is needed"):
        wheels({**lock, "packages": old})


@pytest.mark.slow
def test_a_wheel_is_whole_and_the_same_every_time(lock: Any, made: tuple[Wheel, ...]) -> None:
    assert [each.content for each in wheels(lock)] == [each.content for each in made]
    for each in made:
        with zipfile.ZipFile(io.BytesIO(each.content)) as packed:
            names = packed.namelist()
            [record] = [name for name in names if name.endswith(".dist-info/RECORD")]
            rows = {row[0]: row[1] for row in csv.reader(packed.read(record).decode().splitlines())}
            assert {*rows} == {*names}
            for name in {*names} - {record}:
                digest = base64.urlsafe_b64encode(hashlib.sha256(packed.read(name)).digest()).decode().rstrip("=")
                assert rows[name] == f"sha256={digest}"
        assert not [name for name in names if name.endswith((".so", ".pyd", ".pyc"))]
        assert {f"{name}/__init__.py" for name in each.imports} <= {*names} or {f"{name}.py" for name in each.imports} <= {
            *names
        }


@pytest.mark.slow
def test_the_wheels_run_where_nothing_else_of_the_kind_is_installed(made: tuple[Wheel, ...], tmp_path: Path) -> None:
    """Also those of packages that are compiled for this machine."""
    for each in made:
        zipfile.ZipFile(io.BytesIO(each.content)).extractall(tmp_path)
    names = [name for each in made for name in each.imports]
    listed = ", ".join(names)
    told = f"import {listed}; print(*(each.__file__ for each in ({listed})), sep='\\n'); lsys_kit.explore('J1')"
    done = subprocess.run(
        [sys.executable, "-c", told], cwd=tmp_path, env={"PYTHONPATH": str(tmp_path)}, capture_output=True, text=True
    )
    assert done.stderr == ""
    assert all(line.startswith(str(tmp_path)) for line in done.stdout.splitlines())


def test_where_jupyterlite_is_not_installed_it_is_said_how_to_get_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "jupyterlite_core.manager", None)
    with pytest.raises(kit.LSystemError, match="JupyterLite is not installed") as refused:
        build_lite(tmp_path / "lite")
    assert "lsys-kit[lite]" in str(refused.value.hint)
    assert not (tmp_path / "lite").exists()


def config(folder: Path) -> Any:
    return json.loads((folder / "jupyter-lite.json").read_bytes())["jupyter-config-data"]


@pytest.mark.slow
def test_the_course_is_written_again_and_nothing_else_is_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "lite"
    assert shell.main(["lite", "-o", str(folder)]) == 0
    said = capsys.readouterr().out
    assert "lab/index.html?path=notebooks/00_five_characters_one_plant.ipynb" in said
    assert "come from cdn.jsdelivr.net" in said
    assert "numpy" in said
    for name, path in course_files().items():
        content = path.read_bytes()
        expected = students_copy(content) if is_lesson(name) else content
        assert json.loads((folder / "files" / name).read_bytes()) == json.loads(expected)
    listed = json.loads((folder / "api/contents/notebooks/all.json").read_bytes())["content"]
    assert {f"notebooks/{each['name']}" for each in listed} >= {
        name for name in course_files() if name.startswith("notebooks/0")
    }
    data = config(folder)
    assert {each["name"] for each in data["federated_extensions"]} == {*EXTENSIONS.values()}
    plugin = data["litePluginSettings"][f"{KERNEL}:kernel"]
    address = f"https://cdn.jsdelivr.net/pyodide/v{TOLD['version']}/full/"
    assert plugin["pyodideUrl"] == f"{address}pyodide.mjs"
    lock = json.loads((folder / HOME / LOCK).read_bytes())["packages"]
    assert lock["numpy"]["file_name"].startswith(f"{address}numpy-")
    for each in (lock[KIT], lock["lark"]):
        assert hashlib.sha256((folder / HOME / each["file_name"]).read_bytes()).hexdigest() == each["sha256"]

    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file() and path.name != "all.json"}  # has dates
    (folder / "mine.txt").write_text("mine")
    (folder / "files" / "old.ipynb").write_text("old")
    mark = json.loads((folder / MADE).read_bytes())
    (folder / MADE).write_text(json.dumps({**mark, "files": [*mark["files"], "files/old.ipynb", "../outside", "/etc/passwd"]}))
    build_lite(folder)
    assert {path: path.read_bytes() for path in before} == before
    assert (folder / "mine.txt").read_text() == "mine"
    assert not (folder / "files" / "old.ipynb").exists()


@pytest.mark.slow
def test_a_course_of_ones_own_has_its_exercises_with_it_and_pyodide_lies_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = write_lesson("ferns", tmp_path / "ferns")
    monkeypatch.setenv(VARIABLE, str(course))
    pyodide = tmp_path / "pyodide"
    pyodide.mkdir()
    for name in TOLD["files"]:
        (pyodide / name).write_bytes(STORED if name == LOCK else name.encode())
    micropip = json.loads(STORED)["packages"]["micropip"]["file_name"]
    (pyodide / micropip).write_bytes(b"a wheel")
    made = build_lite(tmp_path / "lite", course, pyodide)
    assert made.first == "lab/index.html?path=notebooks/ferns.ipynb"
    assert "numpy" in made.fetched
    assert "micropip" not in made.fetched
    home = tmp_path / "lite" / HOME
    assert {each.name for each in home.iterdir()} >= {*TOLD["files"], micropip}
    plugin = config(tmp_path / "lite")["litePluginSettings"][f"{KERNEL}:kernel"]
    assert plugin["pyodideUrl"] == f"./{HOME}/pyodide.mjs"
    own = plugin["loadPyodideOptions"]["env"][VARIABLE]
    with zipfile.ZipFile(next(home.glob("lsys_kit-*.whl"))) as packed:
        names = packed.namelist()
    assert own == "/lib/python3.14/site-packages/own_course"
    assert [name for name in names if name.startswith("own_course/") and "ferns" in name]
    (tmp_path / "lite" / MADE).unlink()
    with pytest.raises(kit.ModelFileError, match="not made by the kit"):
        build_lite(tmp_path / "lite", course, pyodide)


def test_the_compiled_twin_of_a_module_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not wheels_module._is_wanted("psygnal/_signal.cpython-311-x86_64-linux-gnu.so")
    assert wheels_module._is_wanted("psygnal/_signal.py")
