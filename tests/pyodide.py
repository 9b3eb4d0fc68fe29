"""Pyodide of npm, as the kit's pages take it from the network: fetched once, and known by the hashes of its files."""

from __future__ import annotations

import base64
import hashlib
import shutil
import subprocess
import tarfile
import tempfile
from pathlib import Path

import pytest
from filelock import FileLock

from lsys_kit.files import toml_tables

TOLD = toml_tables("lsys_kit.classroom.site", "pyodide.toml")


def pyodide_folder(config: pytest.Config) -> Path:
    """A folder with Pyodide; the test is skipped where it can be fetched from nowhere."""
    cache = getattr(config, "cache", None)
    home = Path(cache.mkdir("pyodide") if cache else tempfile.gettempdir())
    with FileLock(home / "lock"):
        if not is_whole(home / "package"):
            fetch(home)
        if not is_whole(home / "package"):
            pytest.skip("npm cannot fetch Pyodide")
    return home / "package"


def fetch(home: Path) -> None:
    npm, archive = shutil.which("npm"), f"pyodide-{TOLD['version']}.tgz"
    if npm is None:
        return
    subprocess.run([npm, "pack", f"pyodide@{TOLD['version']}"], cwd=home, capture_output=True, timeout=300, check=False)
    if (home / archive).exists():
        (home / "package").mkdir(exist_ok=True)
        with tarfile.open(home / archive) as packed:
            for name in TOLD["files"]:
                if content := packed.extractfile(f"package/{name}"):
                    (home / "package" / name).write_bytes(content.read())


def is_whole(folder: Path) -> bool:
    """Whether each file is there, with the hash that pages name."""
    return all(
        (folder / name).is_file() and integrity((folder / name).read_bytes()) == told["integrity"]
        for name, told in TOLD["files"].items()
    )


def integrity(content: bytes) -> str:
    return f"sha384-{base64.b64encode(hashlib.sha384(content).digest()).decode()}"
