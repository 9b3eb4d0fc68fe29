"""Pyodide of npm, as the kit's pages take it from the network: fetched once, and known by the hashes of its files."""

from __future__ import annotations

import base64
import hashlib
import json
import shutil
import subprocess
import sys
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


def pyodide_with_packages(config: pytest.Config) -> Path:
    """A folder with Pyodide, and those packages of Python alone that a kernel and the kit need; the lock file has the hashes of
    those of PyPI. What is compiled for browsers is to be had from its own server alone."""
    home, core = Path(pyodide_folder(config)).with_name("packages"), pyodide_folder(config)
    with FileLock(home.with_name("lock")):
        lock = json.loads((core / LOCK).read_bytes())
        wanted = [lock["packages"][name] for name in PURE.split()]
        if not (home / LOCK).exists():
            home.mkdir(exist_ok=True)
            given = [f"{each['name']}=={each['version']}" for each in wanted]
            options = ["--no-deps", "--only-binary", ":all:", "--python-version", "3.14"]
            pip = [sys.executable, "-m", "pip", "download", "-q", "-d", str(home), *options]
            subprocess.run([*pip, *given], capture_output=True, timeout=300, check=False)
            for each in wanted:
                if not (home / each["file_name"]).is_file():
                    pytest.skip(f"pip cannot fetch {each['name']} {each['version']}")
                each["sha256"] = hashlib.sha256((home / each["file_name"]).read_bytes()).hexdigest()
            for name in {*TOLD["files"]} - {LOCK}:
                shutil.copy(core / name, home)
            (home / LOCK).write_text(json.dumps(lock))
    return home


LOCK = "pyodide-lock.json"
PURE = """
asttokens decorator executing ipython jedi matplotlib-inline micropip mpmath networkx packaging parso prompt-toolkit pure-eval
pygments setuptools six stack-data sympy tqdm traitlets typing-extensions wcwidth
"""


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
