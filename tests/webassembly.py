"""What the public functions answer: the same in every Python, in a browser's as well."""

from __future__ import annotations

import hashlib
import json
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

import lsys_kit as kit

TEXTS = {
    "koch": "F\nF -> F[+F]F[-F]F\nangle: 25.7",
    "signal": "B A A A\nB < A -> B\nB -> A",
    "shoot": "A(1)\nA(x) : x < 5 -> F(x) [+ A(x+1)] A(x+2)\nF(x) -> F(2*x)\nangle: 30",
    "chance": "F\nF -> F[+F]F : 1/2\nF -> F F : 1/2",
}


def file(save: Callable[[Path], object], ending: str) -> str:
    """What a function writes: for a drawing of lines its digest, and for other files how they begin."""
    with tempfile.TemporaryDirectory() as folder:
        save(path := Path(folder, f"plant.{ending}"))
        made = path.read_bytes()
    return hashlib.sha256(made).hexdigest() if ending == "svg" else made[:4].hex()


def answers() -> Mapping[str, object]:
    """What is answered, act by act."""
    systems = {name: kit.read(text) for name, text in TEXTS.items()}
    plant = systems["koch"]
    return {
        "words": [str(kit.derive(each, 4)) for each in systems.values()],
        "written": [kit.write(each) for each in systems.values()],
        "files": {end: file(kit.draw(plant, 3).save, end) for end in ("svg", "png", "pdf")},
        "meshes": file(kit.draw(plant, 2).save, "glb"),
        "page": file(lambda path: kit.explore(plant).save(path), "html"),
        "growth": str(kit.growth(plant)),
        "inferred": str(kit.infer(["A", "AB", "ABA"])),
        "stages": kit.pnml(kit.stages(kit.system("P4"))),
        "variants": [kit.write(each) for each in kit.variants(plant, 3)],
        "link": kit.link(plant),
    }


if __name__ == "__main__":
    print(json.dumps(answers()))
