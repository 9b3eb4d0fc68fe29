"""What a stranger installs: a wheel of pure Python that brings the course along, and two commands that work."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from lsys_kit.classroom.course import course_files

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "-w", str(folder), "."],
        cwd=ROOT,
        check=True,
        timeout=300,
    )
    return next(folder.glob("*.whl"))


@pytest.mark.slow
def test_the_wheel_is_pure_python(wheel):
    assert wheel.name.endswith("-py3-none-any.whl")


@pytest.mark.slow
def test_the_wheel_holds_every_file_of_the_package(wheel):
    package = {
        str(path.relative_to(ROOT))
        for ending in ("py", "pyi", "lark", "toml", "js", "mo", "gz")
        for path in (ROOT / "lsys_kit").rglob(f"*.{ending}")
    }
    assert {Path(name).suffix for name in package} == {".py", ".pyi", ".lark", ".toml", ".js", ".mo", ".gz"}
    assert package - set(zipfile.ZipFile(wheel).namelist()) == set()


@pytest.mark.slow
def test_the_wheel_brings_the_course_along(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {f"lsys_kit/course/{name}" for name in course_files()} - names == set()


@pytest.mark.slow
def test_an_installed_wheel_copies_its_own_course(wheel, tmp_path):
    zipfile.ZipFile(wheel).extractall(tmp_path / "site")
    code = (
        "import lsys_kit.classroom.course as c; found = c.course_files(); c.copy_course('mine')\n"
        "print(c.__file__, *found.values(), sep='\\n')"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(tmp_path / "site")},
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    assert all(line.startswith(str(tmp_path / "site")) for line in done.stdout.splitlines())
    copied = {str(path.relative_to(tmp_path / "mine")) for path in (tmp_path / "mine").rglob("*.*") if path.name[0] != "."}
    assert copied == set(course_files())


@pytest.mark.slow
def test_the_wheel_brings_its_licence_along(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    assert "lsys_kit/LICENSE" in names
    assert any(name.endswith(".dist-info/licenses/lsys_kit/LICENSE") for name in names)


def test_every_link_of_the_readme_and_of_the_guides_leads_to_a_file():
    for page in ("README.md", ".github/CONTRIBUTING.md", "tests/benchmarks/README.md"):
        for link in re.findall(r"\]\(([^)#:]+)\)", (ROOT / page).read_text("utf-8")):
            assert ((ROOT / page).parent / link).exists(), f"{page}: {link}"


@pytest.mark.slow
def test_the_lines_of_the_readme_do_something(tmp_path):
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text("utf-8"), re.DOTALL)
    *lines, last = code.strip().splitlines()
    lines.append(f"print({last.partition('#')[0]})")
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(lines)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert done.stdout.startswith("N(t) = N(t - lifeTimeA)")
    assert [path.name for path in tmp_path.iterdir()] == ["j4.html"]


def test_the_readme_has_two_commands_of_one_line():
    commands = re.findall(r"^    (python3 .*)$", (ROOT / "README.md").read_text(), re.MULTILINE)
    assert [command.split("&& ")[-1] for command in commands] == [".venv/bin/lsys-kit lab", ".venv/bin/pytest -n auto"]


def test_only_what_a_stranger_looks_for_is_visible():
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    assert {name.split("/")[0] for name in files if name[0] != "."} == {
        "README.md",
        "exercises",
        "lsys_kit",
        "notebooks",
        "pyproject.toml",
        "tests",
    }
