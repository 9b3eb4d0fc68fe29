"""What lies beside pages that hold the kit: the kit and what it needs as archives, Python for browsers, a worker's script.

Python is Pyodide: CPython for WebAssembly. Its files are copied from a folder, or taken from the network, each by its hash. It
has no numpy, of which small words have no need (`arrays.py`); packages that few answers ask for lie in archives of their own,
and are fetched when an answer asks for them.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
from collections.abc import Iterator, Mapping
from functools import cache
from importlib.metadata import distribution
from pathlib import Path, PurePosixPath

from lsys_kit.classroom.panel.bundle import Data, compact
from lsys_kit.classroom.places import course_of
from lsys_kit.classroom.site.pages import Answering
from lsys_kit.errors import quotable
from lsys_kit.files import KIT_MARK, file_errors, toml_tables
from lsys_kit.translation import ENGLISH, language

HOME = "python"
"""The folder of the site in which all this lies."""
ALWAYS = ("lark", "traitlets")
"""The packages that no answer can do without."""
SOMETIMES: Mapping[str, tuple[str, ...]] = {"sympy": ("sympy", "mpmath"), "networkx": ("networkx",)}
"""Packages that some answers ask for, and what is fetched with each: formulas need sympy, and maps networkx."""
_LEFT_OUT = ("__pycache__", "tests", "benchmarks", "config", "tools")
"""Folders of packages that nothing asks for."""
_NOT_ASKED = ("course", "experiments", *(f"classroom/{each}" for each in ("authoring", "lessons", "lite", "live", "scorm")))
"""Parts of the kit that pages do not ask for."""
_NO_TIME = (1980, 1, 1, 0, 0, 0)
"""The earliest time of a file in an archive: the same kit gives the same archive, byte for byte."""
OWN_COURSE = "own_course"
"""The folder in the archive with what a course of one's own declares."""
PATIENCE = 45
"""So many seconds an answer may take; then Python is ended, and started anew."""


def answering(folder: Path | None = None, source: Path | None = None) -> Answering:
    """Who answers on pages that hold the kit: Python from a folder, by default from the network, with the kit and a course.

    >>> sorted(answering().files)
    ['python/kit.zip', 'python/networkx.zip', 'python/sympy.zip', 'python/worker.js']
    """
    copied, python = _copied(folder) if folder else ({}, _fetched())
    archives = {"kit": archive(_kit_files(source)), **{name: _package_archive(name) for name in SOMETIMES}}
    worker = f"// Made by {KIT_MARK.decode()}.\n{compact('python_worker')}\n".encode()
    files = {f"{HOME}/worker.js": worker, **{f"{HOME}/{name}.zip": content for name, content in archives.items()}}
    data = {
        "worker": _named(f"{HOME}/worker.js", worker),
        "python": python,
        "kit": {"address": _named(f"{HOME}/kit.zip", archives["kit"]), "bytes": len(archives["kit"])},
        "packages": {
            name: {"address": _named(f"{HOME}/{name}.zip", archives[name]), "bytes": len(archives[name])} for name in SOMETIMES
        },
        "variables": _variables(source),
        "patience": PATIENCE,
    }
    return Answering("kit_page", {"python": data}, {**files, **copied})


def _named(address: str, content: bytes) -> str:
    """An address that changes with what is there, so that no browser takes what it has kept of another kit."""
    return f"{address}?{hashlib.sha256(content).hexdigest()[:12]}"


def _variables(source: Path | None) -> dict[str, str]:
    """The environment of Python in a page: the language of the pages, and where a course of one's own lies."""
    own = {"LSYS_KIT_COURSE": f"/kit/{OWN_COURSE}"} if source else {}
    return {"LSYS_KIT_LANGUAGE": language(), **own}


# Python


def _fetched() -> Data:
    """The files of Python that are taken from the network."""
    told = toml_tables(__package__, "pyodide.toml")
    return {"address": told["address"], "files": told["files"]}


def files_in(folder: Path) -> dict[str, bytes]:
    """The files of Python in a folder.

    Raises
    ------
    ModelFileError
        One is missing.
    """
    told = toml_tables(__package__, "pyodide.toml")
    found = {}
    for name in told["files"]:
        with file_errors(f'"{quotable(str(folder))}" has no "{name}" of Pyodide', _how(told["version"])):
            found[name] = (folder / name).read_bytes()
    return found


def _copied(folder: Path) -> tuple[dict[str, bytes], Data]:
    """The files of Python that are copied from a folder, and where they lie."""
    found = files_in(folder)
    own = hashlib.sha256(b"\0".join(found.values())).hexdigest()[:12]
    home = f"{HOME}/pyodide-{own}"
    files = {f"{home}/{name}": content for name, content in found.items()}
    return files, {"address": f"{home}/", "files": {name: {"bytes": len(content)} for name, content in found.items()}}


def _how(version: str) -> str:
    return f"npm pack pyodide@{version} fetches it; unpack that archive, and name its folder: --pyodide package"


# Archives


def archive(files: Mapping[str, bytes]) -> bytes:
    """Files as a zip archive.

    >>> archive({"a.txt": b"a"}) == archive({"a.txt": b"a"})
    True
    """
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for name in sorted(files):
            packed.writestr(zipfile.ZipInfo(name, _NO_TIME), files[name], zipfile.ZIP_DEFLATED, 9)
        packed.comment = KIT_MARK
    return made.getvalue()


@cache
def _package_archive(name: str) -> bytes:
    return archive(_packages(*SOMETIMES[name]))


def _kit_files(source: Path | None) -> dict[str, bytes]:
    """The kit, without what pages do not ask for; what it needs; and what is declared in a course of one's own."""
    root = Path(__file__).resolve().parents[2]
    names = {path.relative_to(root).as_posix(): path for path in root.rglob("*") if path.is_file()}
    kept = {f"{root.name}/{name}": path.read_bytes() for name, path in names.items() if _is_asked_for(name)}
    return {**kept, **_packages(*ALWAYS), **declared_files(source)}


def _is_asked_for(name: str) -> bool:
    """Whether pages need a file of the kit: of translations those into their language, and the texts in scripts for these."""
    if name.startswith("locale/"):
        return name.endswith(".mo") and language() != ENGLISH and name.startswith(f"locale/{language()}/")
    if name.startswith("classroom/panel/scripts/") and language() == ENGLISH:
        return name.endswith("/once.js")
    return not (name.startswith(tuple(f"{each}/" for each in _NOT_ASKED)) or {*PurePosixPath(name).parts} & {*_LEFT_OUT})


def _packages(*names: str) -> dict[str, bytes]:
    """The files of installed packages that are Python alone, with their licences."""
    return {
        str(file): Path(str(file.locate())).read_bytes()
        for name in names
        for file in distribution(name).files or ()
        if not {"..", *_LEFT_OUT} & {*file.parts} and (file.suffix in (".py", ".lark") or "LICENSE" in file.name.upper())
    }


def declared_files(source: Path | None) -> dict[str, bytes]:
    """What a course of one's own declares: its list, its lessons and its exercises."""
    if source is None:
        return {}
    return {f"{OWN_COURSE}/{path.relative_to(source).as_posix()}": path.read_bytes() for path in _declarations(source)}


def _declarations(source: Path) -> Iterator[Path]:
    course = course_of(source)
    yield from source.glob("*.toml")
    for place in course.places:
        if not place.is_kits:
            for folder in (place.root, place.declared, place.questions):
                yield from folder.glob("*.toml")
