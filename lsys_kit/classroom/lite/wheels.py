"""What a Pyodide lacks for the kit, as wheels, and the lock file by which it finds them: a cell that imports the kit is enough.

A wheel is made anew from an installed package (Binary Distribution Format, packaging.python.org), without what is compiled for
this machine: packages that have such parts run without them, too.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.metadata import Distribution, distribution
from pathlib import Path, PurePosixPath
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from lsys_kit.classroom.site.python import OWN_COURSE, archive, declared_files
from lsys_kit.errors import LSystemError

KIT = "lsys-kit"
FRONT_ENDS = ("jupyterlab-widgets", "widgetsnbextension")
"""Packages of which nothing is imported: JupyterLab has their scripts as extensions."""
_COMPILED = (".so", ".pyd", ".dylib", ".pyc")
_LEFT_OUT = ("__pycache__", "tests", "test", "direct_url.json", "RECORD", "WHEEL", "INSTALLER", "REQUESTED")
_WHEEL = "Wheel-Version: 1.0\nGenerator: lsys-kit\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


@dataclass(frozen=True)
class Wheel:
    """A package, as a file, with the names of those that it needs."""

    name: str
    version: str
    content: bytes
    imports: tuple[str, ...]
    depends: tuple[str, ...]

    @property
    def file(self) -> str:
        """The name of its file."""
        return f"{self.name.replace('-', '_')}-{self.version}-py3-none-any.whl"


def wheels(lock: Mapping[str, Any], source: Path | None = None) -> tuple[Wheel, ...]:
    """The kit, with what is declared in a course of one's own, and all that it needs and a Pyodide lacks.

    Raises
    ------
    LSystemError
        A package of Pyodide is older than the kit needs it.
    """
    python = lock["info"]["python"].rpartition(".")[0]
    found, todo = dict[str, Wheel](), [KIT]
    while todo:
        name = todo.pop()
        needed = [*_needed(distribution(name), python)]
        _check_versions(needed, lock)
        depends = tuple(canonicalize_name(each.name) for each in needed)
        found[name] = _wheel(name, _files(name, source), depends)
        todo += [each for each in depends if each not in lock["packages"] and each not in found]
    return tuple(found.values())


def _needed(package: Distribution, python: str) -> Iterator[Requirement]:
    """What a package needs in a browser."""
    there = {"sys_platform": "emscripten", "platform_system": "Emscripten", "python_version": python, "extra": ""}
    for each in map(Requirement, package.requires or ()):
        if canonicalize_name(each.name) not in FRONT_ENDS and (each.marker is None or each.marker.evaluate(there)):
            yield each


def _check_versions(needed: list[Requirement], lock: Mapping[str, Any]) -> None:
    for each in needed:
        there = lock["packages"].get(canonicalize_name(each.name))
        if there and not each.specifier.contains(there["version"], prereleases=True):
            raise LSystemError(
                f"This Pyodide has {each.name} {there['version']}, and {each} is needed", hint="Take a newer Pyodide."
            )


def _files(name: str, source: Path | None) -> dict[str, bytes]:
    """The files of a package by their names in a wheel."""
    if name == KIT:
        root = Path(__file__).resolve().parents[2]
        own = {path.relative_to(root.parent).as_posix(): path for path in root.rglob("*") if path.is_file()}
        without = {each: path.read_bytes() for each, path in own.items() if not each.startswith(f"{root.name}/course/")}
        return {**{each: content for each, content in without.items() if _is_wanted(each)}, **declared_files(source)}
    return {
        str(file): Path(str(file.locate())).read_bytes()
        for file in distribution(name).files or ()
        if _is_wanted(str(file)) and not {".dist-info"} & {PurePosixPath(part).suffix for part in file.parts}
    }


def _is_wanted(name: str) -> bool:
    parts = PurePosixPath(name).parts
    return not ({"..", *_LEFT_OUT} & {*parts} or name.endswith(_COMPILED))


def _wheel(name: str, files: Mapping[str, bytes], depends: tuple[str, ...]) -> Wheel:
    package = distribution(name)
    home = f"{name.replace('-', '_')}-{package.version}.dist-info"
    told = {f"{home}/METADATA": (package.read_text("METADATA") or "").encode(), f"{home}/WHEEL": _WHEEL.encode()}
    every = {**files, **told}
    rows = [f"{each},sha256={_digest(content)},{len(content)}" for each, content in every.items()]
    record = "\n".join([*rows, f"{home}/RECORD,,", ""])
    imports = {each.partition("/")[0].removesuffix(".py") for each in files} - {OWN_COURSE}
    content = archive({**every, f"{home}/RECORD": record.encode()})
    return Wheel(name, package.version, content, tuple(sorted(imports)), depends)


def _digest(content: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")


def lock_with(lock: Mapping[str, Any], made: tuple[Wheel, ...], address: str, beside: frozenset[str]) -> bytes:
    """A lock file of Pyodide with wheels that lie beside it; its other packages come from an address, but for those that lie
    beside it, too."""
    packages = {
        name: each if each["file_name"] in beside else {**each, "file_name": f"{address}{each['file_name']}"}
        for name, each in lock["packages"].items()
    }
    packages |= {
        each.name: {
            "name": each.name,
            "version": each.version,
            "file_name": each.file,
            "install_dir": "site",
            "sha256": hashlib.sha256(each.content).hexdigest(),
            "package_type": "package",
            "imports": each.imports,
            "depends": each.depends,
            "unvendored_tests": False,
        }
        for each in made
    }
    return json.dumps({**lock, "packages": packages}, separators=(",", ":")).encode()
