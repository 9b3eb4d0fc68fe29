"""The course in a JupyterLab that runs in a browser: JupyterLite with Pyodide, as static files for a web server.

JupyterLite's own builder puts it together. The kit is loaded by the first cell that imports it, with all that it needs, by way
of a lock file of Pyodide that knows the wheels beside it.
"""

from __future__ import annotations

import gzip
import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import Any

from packaging.utils import canonicalize_name

from lsys_kit.classroom.course import MANIFEST, copy_course
from lsys_kit.classroom.lite.wheels import Wheel, lock_with, wheels
from lsys_kit.classroom.places import course_of
from lsys_kit.classroom.site.python import OWN_COURSE, files_in
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.files import KIT_MARK, file_errors, made_by_the_kit, replace_file, toml_tables
from lsys_kit.translation import language

HOME = "pyodide"
"""The folder of the site with Pyodide, the lock file and the wheels."""
LOCK = "pyodide-lock.json"
MADE = "lsys-kit.json"
"""The file that names all that was written, by which the kit knows its own."""
INDEX = "lab/index.html"
KERNEL = "@jupyterlite/pyodide-kernel-extension"
EXTENSIONS: Mapping[str, str] = {
    "jupyterlab-widgets": "@jupyter-widgets/jupyterlab-manager",
    "anywidget": "anywidget",
    "jupyterlite-pyodide-kernel": KERNEL,
}
"""The extensions of JupyterLab that the course needs, by the packages that bring them."""
_ADDRESS = "https://cdn.jsdelivr.net/pyodide/v{version}/full/"
"""Where Pyodide and its packages come from, if they do not lie beside the course."""
_OFF = ("archive", "report", "serve", "workspaces", "jupyterlite-pyodide-kernel-lock", "jupyterlite-pyodide-kernel-pyodide")
"""Parts of JupyterLite's builder that have nothing to do here."""
_NEEDED = ("ipython", "jedi", "micropip")
"""Packages that the kernel itself loads."""


@dataclass(frozen=True)
class Lite:
    """What was written: the way to the first lesson, and the packages that come from the network when a cell needs them."""

    first: str
    fetched: tuple[str, ...]


def build_lite(folder: str | Path, source: Path | None = None, pyodide: Path | None = None) -> Lite:
    """Write the course with JupyterLite into a folder, in place of an older one that the kit has written there.

    The course is by default what came with the kit, and Pyodide is fetched from the network when a notebook is opened; with a
    folder of it, it lies beside the course, with those of its packages that are in that folder.

    Raises
    ------
    LSystemError
        JupyterLite is not installed, or cannot be built; or a package of Pyodide is too old.
    ModelFileError
        Something that the kit did not make is in the folder, or it cannot be written; or Pyodide is not in its folder.
    """
    folder = Path(folder)
    manager, old = _builder(), _written_before(folder)
    with file_errors(_cannot(folder)):
        folder.mkdir(parents=True, exist_ok=True)
    beside = _pyodide_in(pyodide) if pyodide else {}
    lock = json.loads(beside.get(LOCK) or gzip.decompress((files(__package__) / f"{LOCK}.gz").read_bytes()))
    address = _ADDRESS.format(version=toml_tables("lsys_kit.classroom.site", "pyodide.toml")["version"])
    made = wheels(lock, source)
    beside |= {each.file: each.content for each in made}
    beside[LOCK] = lock_with(lock, made, address, frozenset(beside))
    with TemporaryDirectory() as work:
        out = _built(manager, Path(work), source)
        _configure(out / "jupyter-lite.json", f"./{HOME}/" if pyodide else address, lock, source)
        contents = {path.relative_to(out).as_posix(): path.read_bytes() for path in sorted(out.rglob("*")) if path.is_file()}
    contents |= {f"{HOME}/{name}": content for name, content in beside.items()}
    _check_room(folder, [*contents], old)
    with file_errors(_cannot(folder)):
        _replace(folder, contents, old)
    first = next(name for name in contents if name.startswith("files/notebooks/") and name.endswith(".ipynb"))
    return Lite(f"{INDEX}?path={first.removeprefix('files/')}", tuple(sorted(_not_beside(lock, made, frozenset(beside)))))


def _cannot(folder: Path) -> str:
    return f'The course cannot be written to "{quotable(str(folder))}"'


def _builder() -> Any:
    try:
        import jupyter_server  # noqa: F401
        from jupyterlite_core.manager import LiteManager

        distribution("jupyterlite-pyodide-kernel")
    except (ImportError, PackageNotFoundError):
        raise LSystemError("JupyterLite is not installed", hint="Install it with: pip install 'lsys-kit[lite]'") from None
    return LiteManager


# The folder


def _written_before(folder: Path) -> tuple[str, ...]:
    """The files of an older course in a folder, by their names there."""
    mark = folder / MADE
    with file_errors(f'"{quotable(str(folder))}" cannot be read'):
        found = json.loads(mark.read_bytes()) if made_by_the_kit(mark) else {}
    names = found.get("files", ()) if isinstance(found, dict) else ()
    paths = [PurePosixPath(each) for each in names if isinstance(each, str)]
    return tuple(str(each) for each in paths if not each.is_absolute() and ".." not in each.parts)


def _check_room(folder: Path, names: list[str], old: tuple[str, ...]) -> None:
    """See that nothing is replaced that the kit did not write."""
    for name in [*names, MADE]:
        if name not in old and os.path.lexists(folder / name) and not (name == MADE and made_by_the_kit(folder / name)):
            raise ModelFileError(
                f'"{quotable(str(folder / name))}" is there already, and was not made by the kit',
                hint="It would be lost: choose another folder, or delete it first.",
            )


def _replace(folder: Path, contents: Mapping[str, bytes], old: tuple[str, ...]) -> None:
    """Write files in place of older ones, of which those go that are no longer wanted."""
    mark = {"made by": KIT_MARK.decode(), "files": sorted({*contents, *old})}
    replace_file(folder / MADE, json.dumps(mark, indent=1).encode())  # first: what is written next is known as the kit's
    for name, content in contents.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        replace_file(folder / name, content)
    for name in {*old} - contents.keys():
        (folder / name).unlink(missing_ok=True)
    replace_file(folder / MADE, json.dumps({**mark, "files": sorted(contents)}, indent=1).encode())


# JupyterLite


def _built(manager: Any, work: Path, source: Path | None) -> Path:
    """JupyterLite with the course in it, in a folder."""
    course = work / "course"
    copy_course(course, source)
    (course / MANIFEST).unlink()
    made = manager(
        lite_dir=work,
        output_dir=work / "out",
        cache_dir=work / "cache",
        contents=(str(course),),
        apps=("lab",),
        federated_extensions=[str(_extension(*each)) for each in EXTENSIONS.items()],
        ignore_sys_prefix=("federated_extensions",),
        disable_addons=_OFF,
        no_libarchive=True,
        no_sourcemaps=True,
        no_unused_shared_packages=True,
    )
    made._doit_config = {"dep_file": str(work / "tasks.json"), "backend": "json", "reporter": "zero", "verbosity": 0}
    made.initialize()
    if made.doit_run("post_build"):
        raise LSystemError("JupyterLite could not be built", hint="Install it again: pip install 'lsys-kit[lite]'")
    return work / "out"


def _extension(package: str, name: str) -> Path:
    """The folder of an extension that an installed package has brought."""
    end = f"labextensions/{name}/package.json"
    for file in distribution(package).files or ():
        if file.as_posix().endswith(end):
            return Path(str(file.locate())).resolve().parent
    raise LSystemError(f"The package {package} has no extension of JupyterLab", hint="Install it again.")


def _configure(path: Path, address: str, lock: Mapping[str, Any], source: Path | None) -> None:
    """Say in JupyterLite's configuration what the course is called, where Pyodide is, and which lock file it reads."""
    config = json.loads(path.read_text("utf-8"))
    data = config["jupyter-config-data"]
    data["appName"] = course_of(source).title
    python = ".".join(lock["info"]["python"].split(".")[:2])
    own = {"LSYS_KIT_COURSE": f"/lib/python{python}/site-packages/{OWN_COURSE}"} if source else {}
    options = {"lockFileURL": f"./{HOME}/{LOCK}", "env": {"HOME": "/home/pyodide", "LSYS_KIT_LANGUAGE": language(), **own}}
    plugins = data.setdefault("litePluginSettings", {}).setdefault(f"{KERNEL}:kernel", {})
    plugins |= {"pyodideUrl": f"{address}pyodide.mjs", "loadPyodideOptions": options}
    path.write_text(json.dumps(config, indent=1), "utf-8")


# Pyodide


def _pyodide_in(folder: Path) -> dict[str, bytes]:
    """Pyodide in a folder, and those of its packages that are there, too."""
    found = files_in(folder)
    with file_errors(f'"{quotable(str(folder))}" cannot be read'):
        names = {each["file_name"] for each in json.loads(found[LOCK])["packages"].values()}
        return found | {name: (folder / name).read_bytes() for name in names if (folder / name).is_file()}


def _not_beside(lock: Mapping[str, Any], made: tuple[Wheel, ...], beside: frozenset[str]) -> Iterator[str]:
    """The packages that the course needs, and that do not lie beside it."""
    own = {each.name for each in made}
    todo, seen = [*_NEEDED, *(name for each in made for name in each.depends if name not in own)], set[str]()
    while todo:
        name = canonicalize_name(todo.pop())
        if name not in seen and name not in own:
            seen.add(name)
            package = lock["packages"][name]
            todo += package["depends"]
            if package["file_name"] not in beside:
                yield name
