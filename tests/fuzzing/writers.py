"""What is read is written in every notation and reads back, or the writer says what the notation lacks.

    python -m tests.fuzzing.writers 600              ten minutes of the processor's time
    SEED=7 python -m tests.fuzzing.writers 60        other systems and other texts

Half of what is tried are random systems with every symbol that any reader takes, the other half systems of the catalogue and
listings, spoilt in a few places. What a text means in its own notation can always be written in it.
"""

from __future__ import annotations

import os
import sys
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path
from random import Random

from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.errors import LSystemError, ModelValueError
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.write import write
from tests.notation.foreign_systems import Systems, mutated

LISTINGS = Path(__file__).parent.parent / "listings"


def models() -> list[tuple[str, str]]:
    """Short texts, each with its notation."""
    found = [(path.suffixes[0][1:], path.read_text()) for path in sorted(LISTINGS.glob("*.*.txt"))]
    for notation in DIALECTS:
        for id in systems():
            with suppress(ModelValueError):
                found.append((notation, write(system(id), notation)))
    return [(notation, text) for notation, text in found if len(text) < 900]


def check(found: LSystem, seen: Counter[str]) -> None:
    """Write a system in every notation and read it again."""
    for notation in DIALECTS:
        try:
            text = write(found, notation)
        except ModelValueError:
            seen[f"not in {notation}"] += 1
            continue
        assert read(text, notation) == found, text
        assert write(read(text, notation)) == text
        seen[f"in {notation}"] += 1


def main(seconds: float, seed: int) -> None:
    random, texts, seen = Random(seed), models(), Counter[str]()
    while time.process_time() < seconds:
        check(Systems(random).system(), seen)
        for _ in range(10):  # most of them cannot be read
            (notation, text), (_, other) = random.choice(texts), random.choice(texts)
            spoilt = mutated(random, text, other)
            seen["texts"] += 1
            try:
                found = read(spoilt, notation)
            except LSystemError:
                continue
            write(found, notation)
            check(found, seen)
    print(*(f"{name}: {count:,}" for name, count in sorted(seen.items())), sep="\n")


if __name__ == "__main__":
    main(float(sys.argv[1]), int(os.environ.get("SEED", "1")))
