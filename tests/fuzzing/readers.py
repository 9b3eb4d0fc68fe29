"""Whatever a text holds, a reader reads it or explains what is wrong: texts made by a fuzzer that sees which code they reach.

    python -m tests.fuzzing.readers 8000             eight thousand texts for each notation, the same every time
    python -m tests.fuzzing.readers 500000 grogra    half a million for one
    SEED=7 python -m tests.fuzzing.readers 50000     other texts

They are counted, not timed, so that a quick machine and a slow one try the same.

The fuzzer begins with the listings of the seeds and the systems of the catalogue. What is read is written again, must read back
as the same system, and is derived for two steps. Only the kit's own errors may come of it, within a second; anything else ends
the run with the text that did it.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

LONGEST = 400
"""The longest text that is tried; longer ones have tests of their own."""
SLOWEST = 10
"""Seconds after which a text is taken to hang."""
LISTINGS = Path(__file__).parent.parent / "listings"


def seeds(notation: str, folder: Path) -> None:
    """Write what the fuzzer begins with: listings, and the catalogue's systems."""
    from lsys_kit import ModelValueError, system, systems, write
    from tests.plants import plant

    texts = [path.read_text() for path in sorted(LISTINGS.glob(f"*.{notation}.txt"))] + [write(plant(notation), notation)]
    for id in systems():
        with contextlib.suppress(ModelValueError):
            texts.append(write(system(id), notation))
    for number, text in enumerate(texts):
        (folder / f"seed{number}").write_text(text)


def fuzz(notation: str, folder: str, texts: int) -> None:
    """Fuzz one reader; this never returns."""
    import atheris

    with atheris.instrument_imports(include=["lsys_kit.notation"]):
        from lsys_kit import LSystemError, derive, limits, read, write

    def one(data: bytes) -> None:
        text = data.decode(errors="replace")
        try:
            with limits(modules=2_000, seconds=1.0):
                found = read(text, notation)
                assert read(write(found), notation) == found, write(found)
                derive(found, 2)[-1]
        except LSystemError as error:
            str(error)

    atheris.Setup(
        [
            sys.argv[0],
            folder,
            f"-max_len={LONGEST}",
            f"-runs={texts}",
            f"-timeout={SLOWEST}",
            f"-seed={os.environ.get('SEED', '1')}",
            f"-artifact_prefix={folder}/",
        ],
        one,
    )
    atheris.Fuzz()


def main(texts: int, *notations: str) -> int:
    """Fuzz the readers one after another, each in a process of its own; 0 if all is well."""
    from lsys_kit.notation.registry import DIALECTS

    for notation in notations or tuple(DIALECTS):
        with tempfile.TemporaryDirectory() as folder:
            seeds(notation, Path(folder))
            run = subprocess.run(
                [sys.executable, "-m", "tests.fuzzing.readers", "--fuzz", notation, folder, str(texts)],
                capture_output=True,
                text=True,
                check=False,
                env={**os.environ, "PYTHONHASHSEED": "0"},
            )
            told = [line for line in run.stderr.splitlines() if "DONE" in line or "stat::" in line]
            print(notation, *told[-1:], sep=": ", flush=True)
            if run.returncode:
                print(run.stderr[-6_000:], run.stdout[-2_000:], file=sys.stderr)
                for found in (*Path(folder).glob("crash-*"), *Path(folder).glob("timeout-*")):
                    print(f"{found.name}: {found.read_bytes()!r}", file=sys.stderr)
                return 1
    return 0


if __name__ == "__main__":
    if sys.argv[1] == "--fuzz":
        fuzz(sys.argv[2], sys.argv[3], int(sys.argv[4]))
    sys.exit(main(int(sys.argv[1]), *sys.argv[2:]))
