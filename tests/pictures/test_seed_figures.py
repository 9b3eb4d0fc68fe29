"""Each figure of the seeds that shows a drawing, a filament or a lineage is drawn as it was when somebody last looked at it.

The pictures are in the folder `golden`. After a change that is meant, they are written anew by
`pytest tests/pictures/test_seed_figures.py --renew-pictures`: look at each one before it is committed. Where a seed shows a
step of many thousand strokes, an earlier step stands here.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from xml.etree import ElementTree

import pytest

from lsys_kit import cellwork_system, draw, draw_hierarchy, lineage, map_system, stages, system
from tests.pictures.command_figures import bend, roll, stroke

GOLDEN = Path(__file__).parent / "golden"
PART = re.compile(r"#[0-9A-Fa-f]{6}|-?\d+(?:\.\d+)?(?:e-?\d+)?|[^-#\d]+|.", re.DOTALL)
"""A picture's text is made of colours, numbers and words."""
CLOSE = {True: 1.0, False: 0.011}
"""Places are whole numbers, tenths of a pixel: another processor may round the last one otherwise; so it is with decimals."""

WHITE_AND_GREY = {"al": "white", "bl": "white", "ar": "grey", "br": "grey"}
FIGURES: Mapping[str, tuple[str, Callable[[], str]]] = {
    "000-figure-1": (
        "Simulated cell layer growth: arrows pointing left (white) and right (grey)",
        lambda: draw(system("J1"), 6, colours=WHITE_AND_GREY).svg,
    ),
    "000-figure-2": ("Algae growth with two classes of cells a (big) and b (small)", lambda: draw(system("J4"), 10).svg),
    "000-figure-3": ("Algae growth with lifetimes 2 and 5 for cells a and b", lambda: draw(system("J5"), 15, legend=True).svg),
    "000-figure-4": ("Example of an artificial flower", lambda: draw(system("J6"), 12).svg),
    **{f"001-koch-{n}": (f"Koch snowflake, step {n}", lambda n=n: draw(system("T2"), n).svg) for n in range(4)},
    "001-stochastic": ("A stochastic L-system", lambda: draw(system("T3"), seed=1).svg),
    "001-figure-5.2": ("Power of 0L-systems and (k,l)-systems", lambda: draw_hierarchy().svg),
    "002-figure-1": ("Developmental sequence of an Anabaena filament (L-system 1)", lambda: draw(system("P1"), 6).svg),
    "002-figure-2": ("Petri net representation of L-system 2", lambda: draw(stages(system("P2"))).svg),
    "002-figure-3-left": ("Improved developmental sequence (L-system 2)", lambda: draw(system("P2"), 16, legend=True).svg),
    "002-figure-3-right": ("The corresponding sequence of L-system 3", lambda: draw(system("P3"), 16).svg),
    "002-figure-4-left": ("L-system 5, time step 0.7", lambda: draw(system("P5"), 6).svg),
    "002-figure-4-right": (
        "L-system 5, time step 1.4: cells that should have divided",
        lambda: draw(system("P5"), 3, dt="1.4").svg,
    ),
    "002-figure-5": (
        "Development considered in continuous time",
        lambda: draw(lineage(system("P5"), 6), intervals=[("1.4", "2.1"), ("1.4", "2.8")]).svg,
    ),
    "002-figure-6": ("L-system 6: a step, then decomposition", lambda: draw(lineage(system("P6"), 3, dt="1.4")).svg),
    "002-figure-8": ("Explicitly represented cell walls", lambda: draw(system("P9w"), 5).svg),
    "003-effect-of-F": ("The effect of F, where the current step is λ", lambda: draw(stroke(), steps=[0, 1, 2]).svg),
    "003-effect-of-RH": ("The effect of RH", lambda: draw(roll(), steps=[0, 1], view=(25, 20)).svg),
    "003-effect-of-RV": ("The effect of RV on the direction ahead", lambda: draw(bend(), steps=[0, 1]).svg),
    "003-branch": ("a -> F [RU45 b] a, b -> F b", lambda: draw(system("K2"), 4).svg),
    "003-koch": ("Koch curve: the output after 6 steps", lambda: draw(system("K3"), 6).svg),
    "003-sierpinski": ("Sierpinski triangle", lambda: draw(system("K4"), 5).svg),
    "003-pseudo-plant": ("Pseudo-plant (there after 7 steps)", lambda: draw(system("K5"), 5).svg),
    "003-alternate": ("Alternate branches that get shorter", lambda: draw(system("K6"), 7).svg),
    "003-stochastic": ("A nondeterministic L-system", lambda: draw(system("K7"), 4, seeds=[1, 2, 3, 4, 5]).svg),
    "003-dying": ("Branching where branches may die", lambda: draw(system("K8"), 9).svg),
    "003-random-flight": ("Random flight in the plane", lambda: draw(system("K9"), 60).svg),
    "003-acrotony": ("The length of a branch depends on its position", lambda: draw(system("K11"), 3).svg),
    "003-meristems": ("Many kinds of meristems: the result after 15 steps", lambda: draw(system("K12"), 15).svg),
    "003-spruce": ("Spruce", lambda: draw(system("K13"), 5).svg),
    "003-mint": ("Mint", lambda: draw(system("K14"), 16).svg),
    "003-beech": ("Beech twigs, drawn by interpretation rules", lambda: draw(system("K15"), 3).svg),
    "003-acropetal": ("An inflorescence that flowers upward", lambda: draw(system("K17a"), 22).svg),
    "003-basipetal": ("An inflorescence that flowers downward", lambda: draw(system("K17b"), 28).svg),
    "003-two-signals": ("An inflorescence with two signals", lambda: draw(system("K18"), 50).svg),
    "003-lychnis": ("Lychnis coronaria", lambda: draw(system("K19"), 15).svg),
    "003-dichotomy": ("Dichotomous branching that does not look around", lambda: draw(system("K20"), 8).svg),
    "003-sensitive-dichotomy": ("Dichotomous branching that keeps its distance", lambda: draw(system("K21"), 8).svg),
    "003-overshading": ("Overshading in two dimensions", lambda: draw(system("K22")).svg),
    "003-toppled": (
        "Overshading: the tree topples when all its branches are dead",
        lambda: draw(system("K22"), 23, apart=400).svg,
    ),
    "003-light": ("Trees that compete for light", lambda: draw(system("K23"), 15).svg),
    "003-stand": ("A stand of nine trees", lambda: draw(system("K23"), 13, trees=9).svg),
    "003-pruning": (
        "Pruning in two dimensions: dormant buds, and a signal that wakes the next one",
        lambda: draw(system("K24"), steps=[4, 5, 6, 7, 8, 9, 10, 11]).svg,
    ),
    "003-outline": ("Pruning to another outline", lambda: draw(system("K24b")).svg),
    "003-topiary": ("Pruning in three dimensions", lambda: draw(system("K25"), steps=[9, 10, 12, 20, 30, 70]).svg),
    **{
        f"003-topiary-{solid}": (
            "Pruning in three dimensions, to another solid",
            lambda n=n, number=number: draw(system("K25"), n, solid=number, L=8 if number < 3 else 14).svg,
        )
        for number, (solid, n) in enumerate({"sphere": 70, "cone": 100, "spiral": 110}.items(), 2)
    },
    **{
        f"003-movement-{name}": (f"An organism that moves: {name}", lambda short=short: draw(system("K26"), short=short).svg)
        for short, name in enumerate(("path", "short-word"))
    },
    "003-timed": ("Timed Anabaena", lambda: draw(lineage(system("K27"), 12)).svg),
    **{
        f"003-map-{n}": (f"Map L-system {n}", lambda n=n: draw(map_system(f"K{27 + n}"), 3, labels=n == 1).svg)
        for n in (1, 2, 3)
    },
    "003-forces": (
        "On the way to rest: some iterations",
        lambda: draw(map_system("K29"), 3, iterations=[0, 20, 80], labels=False).svg,
    ),
    "003-microsorium": ("Gametophyte of Microsorium linguaeforme", lambda: draw(map_system("K32"), 9, labels=False).svg),
    "003-patella": ("Embryo of the snail Patella vulgata", lambda: draw(map_system("K34"), 3).svg),
    **{f"003-cellwork-{n}": (f"Cellwork L-system, step {n}", lambda n=n: draw(cellwork_system("K33"), n).svg) for n in (1, 4)},
    "003-cellwork-cell": ("One cell of a cellwork", lambda: draw(cellwork_system("K33"), 4, cell=3).svg),
    **{f"004-{id}": (f"Plant string {id}", lambda id=id: draw(system(id)).svg) for id in ("L0", "L1", "L2", "L3", "L4")},
}
"""Each figure's name, what its seed says it shows, and how it is drawn."""


def alike(mine: str, golden: str) -> bool:
    """Whether two texts are the same but for the last digits of their numbers."""
    parts, others = PART.findall(mine), PART.findall(golden)
    return len(parts) == len(others) and all(map(close, parts, others))


def close(part: str, other: str) -> bool:
    """Whether two parts of a text are the same, or numbers next to one another."""
    if part == other or not (part[-1].isdigit() and other[-1].isdigit()) or "#" in part + other:
        return part == other
    return abs(float(part) - float(other)) <= CLOSE["." not in part + other]


def test_every_golden_picture_belongs_to_a_figure() -> None:
    assert {path.stem for path in GOLDEN.glob("*.svg")} == FIGURES.keys()


@pytest.mark.slow
@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_is_drawn_as_it_was(name: str, request: pytest.FixtureRequest) -> None:
    caption, drawn = FIGURES[name]
    path, svg = GOLDEN / f"{name}.svg", drawn()
    if request.config.getoption("--renew-pictures"):
        path.write_text(f"{svg}\n", encoding="utf-8")
    ElementTree.fromstring(svg)
    assert alike(svg, path.read_text(encoding="utf-8").rstrip("\n")), f"{caption}: {path.name} looks different now"


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: draw(system("T2"), 2, angle=61).svg,
        lambda: draw(system("T2"), 1).svg,
        lambda: draw(system("K3"), 3).svg,
        lambda: draw(system("T2"), 2).svg.replace("#28A964", "#28A965"),
        lambda: draw(system("T2"), 2).svg.replace("1804", "1806"),
    ],
    ids=["another angle", "another step", "another system", "another colour", "another place"],
)
def test_a_wrong_picture_is_found(wrong: Callable[[], str]) -> None:
    golden = (GOLDEN / "001-koch-2.svg").read_text(encoding="utf-8").rstrip("\n")
    assert alike(draw(system("T2"), 2).svg, golden)
    assert not alike(wrong(), golden)
