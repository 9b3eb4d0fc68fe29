"""The book of a system: small JSON, always the same, plain text, with the diagram of the pictures."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
import zlib
from functools import cache
from itertools import product

import pytest

from lsys_kit import LSystemError, derive, growth, read, stages, system, systems
from lsys_kit.budget import limits
from lsys_kit.classroom.panel.books.book import MOST_MODULES, book, rate_text
from lsys_kit.derivation.core.traits import traits_of
from lsys_kit.derivation.growth.growth import greatest_root
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.turtle.surfaces import passed_over
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.pictures.formats.svg import svg
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.nets.parts import arrowhead
from lsys_kit.pictures.style.labels import visible
from lsys_kit.pictures.style.palette import GREEN, colours
from tests.classroom.test_map_book import whole
from tests.plugin import AN_HOUR
from tests.test_hostile_names import HOSTILE

SETTLED = [name for name in systems() if traits_of(system(name)).d0l]
SVG = "{http://www.w3.org/2000/svg}"
LIFE_SPANS = [{"lifeTimeA": a, "lifeTimeB": b} for a, b in product(range(1, 7), repeat=2)]


@cache
def made_book(name):
    """The book of a system as it is opened; on a busy machine one that ran out of time would end earlier."""
    with limits(seconds=AN_HOUR):
        return book(system(name))


@pytest.mark.slow
@pytest.mark.parametrize("name", systems())
def test_a_book_is_small_json_and_always_the_same(name):
    with limits(seconds=AN_HOUR):
        made, again = made_book(name), book(system(name))
    text = json.dumps(made, allow_nan=False)
    assert json.loads(text) == made
    is_same = text == json.dumps(again)
    assert is_same  # where texts are so long, pytest would look for their differences for half an hour
    assert len(text) < 2_000_000
    assert made["steps"] >= min(system(name).steps or 5, 5)
    assert made["end"] or made["steps"] >= 10


@pytest.mark.slow
def test_the_tables_of_settled_systems_are_a_few_hundred_bytes():
    def size(*books):
        return len(zlib.compress(json.dumps([[each["states"], each["successors"]] for each in books]).encode(), 9))

    sizes = {name: size(made_book(name)) for name in SETTLED}
    assert max(sizes.values()) < 2_000
    assert sorted(sizes.values())[len(sizes) // 2] < 200
    assert size(*(book(system("J4"), constants) for constants in LIFE_SPANS)) < 4_000


def test_a_book_ends_before_a_step_that_is_too_large():
    made = book(read("axiom: F\nF -> F F F F F F F F F F"))
    assert made["steps"] == 5
    assert "Step 6 would have 1,000,000 modules; the limit is 250,000" in made["end"]
    assert MOST_MODULES == 250_000


def test_a_book_ends_before_a_later_step_that_takes_too_long(monkeypatch):
    monkeypatch.setattr("lsys_kit.classroom.panel.books.book.TIME_FOR_LATER", 1e-9)
    made = book(system("K23"))
    assert system("K23").steps <= made["steps"] < 2 * system("K23").steps  # the clock is not looked at for each module
    assert f"Step {made['steps'] + 1} was not reached" in made["end"]


def test_a_book_ends_before_a_step_with_an_error():
    made = book(read("axiom: A(3)\nA(x) -> A(x - 1) B(1/x)"))
    assert made["steps"] == 3
    assert "A(0)" in made["end"]


def test_a_book_ends_before_a_step_that_cannot_be_drawn():
    made = book(read("axiom: A(3)\nA(x) -> A(x - 1)\ninterpretation:\nA(x) -> O(x, 1)"))
    assert made["steps"] == 2
    assert "the length and width of a cell must be greater than 0" in made["end"]
    with pytest.raises(LSystemError, match="greater than 0"):
        book(read("axiom: A(0)\nA(x) -> A(x)\ninterpretation:\nA(x) -> O(x, 1)"))


@pytest.mark.slow
def test_a_book_is_not_much_larger_than_two_megabytes():
    made = book(read("axiom: A(1)\nA(x) -> A(2*x) A(2*x + 1)"), least=16)
    assert 500_000 < len(json.dumps(made)) < 2_500_000
    assert "The panel ends" in made["end"]


def test_a_turn_without_an_angle_of_its_own_asks_for_the_angle():
    asks = {text: book(read(f"axiom: {text}"))["turtle"]["uses angle"] for text in ("F+F", "F+(30)F", "F&F", "F|F", "F[f]F")}
    assert asks == {"F+F": True, "F+(30)F": False, "F&F": True, "F|F": False, "F[f]F": False}


def test_a_step_that_is_asked_for_is_in_the_book():
    assert book(system("J1"), least=17)["steps"] == 17


def test_a_book_holds_the_settings_as_exact_texts():
    assert book(system("P5"), {"dt": "0.7"})["settings"]["dt"] == "0.7"
    assert book(system("J4"), {"lifeTimeB": 5})["settings"] == {"lifeTimeA": "3", "lifeTimeB": "5"}


def test_the_seed_makes_a_difference_where_there_is_chance():
    assert [book(system(name))["chance"] for name in ("J1", "K7")] == [False, True]
    assert len({json.dumps(book(system("K9"), seed=seed)["states"]) for seed in range(3)}) == 3


def test_where_chance_alone_has_a_say_a_book_holds_what_may_come_and_no_words():
    made = book(system("K7"), seed=1)
    ends, total, productions, successors = made["choices"][made["axiom"][0]]
    assert (ends, total, productions) == ([0.33, 0.66], 0.99, [0, 1, 2])
    told = ["".join(made["states"][state][3] for state in row) for row in successors]
    assert told == ["F[+F]F[-F]F", "F[+F]F", "F[-F]F"]
    assert (made["seed"], "words" in made) == ("1", False)
    assert len(json.dumps(made)) < 5_000


@pytest.mark.parametrize(
    "text",
    [
        "axiom: A(1)\nA(x) -> A(2*x) : 1\nA(x) -> A(2*x+1) : 1",  # too many states
        "axiom: A\nA -> A(1/0) : 1\nA -> A A : 1000000",  # what hardly ever comes has no value
        "axiom: A A\nA -> B : 1\nA -> A : 1\nA < B -> A",
        "axiom: A\nA -> A(uniform(0, 1)) : 1\nA -> A : 1",
    ],
)
def test_elsewhere_a_book_holds_the_words_at_its_seed(text):
    found = read(text)
    made = book(found, seed=3, least=12)
    assert "choices" not in made
    assert [len(whole(each)) for each in made["words"]] == derive(found, made["steps"], seed=3).lengths


def test_colours_are_those_of_the_pictures():
    model = system("K2")
    palette = {letter: colour for letter, _, colour, _ in book(model)["symbols"]}
    assert palette == {letter: colours(model).get(letter, "") for letter in palette}
    assert {letter for letter, _, _, steering in book(model)["symbols"] if steering} == {"[", "]", "RU"}
    assert GREEN in palette.values()


def plain_path(path):
    """A path whose numbers have no needless ".0"."""
    return re.sub(r"\.0(?!\d)", "", path)


def numbers_in(path):
    return [float(number) for number in re.findall(r"[\d.]+", path)]


@pytest.mark.slow
@pytest.mark.parametrize("name", systems())
def test_the_diagram_of_a_book_is_that_of_the_picture(name):
    diagram, picture = made_book(name)["net"], svg(drawn_stages(stages(system(name))))
    root = ET.fromstring(picture)
    heads = [arrowhead((bar["x"] - 1.8, bar["y"]), (0.0, bar["y"])) for bar in diagram["bars"]]
    arcs = [arc[part] for arc in diagram["arcs"] for part in ("band", "path", "head")]
    shown = [path.attrib["d"] for path in root.iter(f"{SVG}path")]
    of_bars = shown[len(arcs) :]
    lines = [*arcs, *(bar["line"] for bar in diagram["bars"])]
    assert [plain_path(path) for path in (*shown[: len(arcs)], *of_bars[::2])] == [plain_path(path) for path in lines]
    for head, expected in zip(of_bars[1::2], heads, strict=True):  # of a bar whose place is rounded in the book
        assert re.sub(r"[\d.]+", "", head) == re.sub(r"[\d.]+", "", expected)
        assert numbers_in(head) == pytest.approx(numbers_in(expected), abs=0.11)
    circles = [tuple(float(circle.attrib[key]) for key in ("cx", "cy", "r")) for circle in root.iter(f"{SVG}circle")]
    assert circles == [(place["x"], place["y"], diagram["radius"]) for place in diagram["places"]]
    texts = [text for text in root.iter(f"{SVG}text") if text.get("class") in ("note", "footnote")]
    assert [text.text for text in texts] == [
        *(text for *_, text in diagram["notes"]),
        *(line["text"] for line in diagram["footnotes"]),
    ]
    assert root.attrib["aria-label"] == diagram["description"]
    assert [int(root.attrib[key]) for key in ("width", "height")] == [diagram["width"], diagram["height"]]


def test_where_there_is_no_diagram_the_book_says_why():
    rules = "\n".join(f"X < A_{i} -> {' '.join(f'B_{j}' for j in range(30))}" for i in range(30))
    made = book(read(f"axiom: X {' '.join(f'A_{i}' for i in range(30))}\n{rules}"))
    assert made["net"]["places"] == made["net"]["names"] == []
    assert "900 arcs" in made["net"]["footnotes"][0]["text"]
    assert {place for _, _, place, _ in made["states"]} == {-1}


@pytest.mark.parametrize(
    "text", ["axiom: F ~X RH ~L A", "axiom: A\nA -> F ~ q F", "axiom: A\nA -> F\ninterpretation:\nF -> ~s F RL"]
)
def test_what_the_turtle_passes_over_is_told(text):
    model = read(text)
    made, scene = book(model), scene_of(derive(model, 1), 90)
    assert made["unknown"]
    assert {*scene.unknown} <= {*made["unknown"]}
    assert made["said"] == passed_over(made["unknown"])


@pytest.mark.parametrize(
    ("text", "said"),
    [("axiom: F[+F]", True), ("axiom: F+F", False), ("colours: symbols\naxiom: F[+F]", False), ("axiom: F[+F]RH", True)],
)
def test_a_panel_says_which_colours_were_chosen(text, said):
    made = book(read(text))
    assert ("natural colours" in made["said"]) == said
    assert made["turtle"]["natural"] == said
    assert passed_over(made["unknown"]) in made["said"]


@pytest.mark.parametrize("name", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_names_are_plain_text(name):
    module = Pattern(name)
    hostile = LSystem((module,), (Production((module,), (module, Pattern(name + "2"))),), source=name)
    made = book(hostile, title=name)
    assert made["text"] == name
    assert made["title"] == made["states"][0][3] == visible(name)
    assert all(text.isprintable() for text in texts_in({**made, "text": ""}))
    assert json.loads(json.dumps(made)) == made


def texts_in(entry):
    if isinstance(entry, str):
        return [entry]
    return [
        text
        for part in (entry.values() if isinstance(entry, dict) else entry if isinstance(entry, list) else ())
        for text in texts_in(part)
    ]


# -- the growth rate ------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", SETTLED)
def test_the_growth_rate_is_the_greatest_root(name):
    told = made_book(name)["growth"]
    if told:
        rule = growth(system(name)).recurrence
        assert told["rate"] == rate_text(rule)
        assert float(told["rate"].split("≈")[-1]) == pytest.approx(greatest_root(rule), rel=1e-4)


@pytest.mark.parametrize(
    ("rule", "text"),
    [
        ((1, 1), "(1 + √5)/2 ≈ 1.618"),
        ((2,), "2"),
        ((2, -1), "1"),
        ((0, 2), "√2 ≈ 1.4142"),
        ((0, 0, 2), "≈ 1.2599"),
        ((), "0"),
        ((0, 0), "0"),
        ((3, 1), "(3 + √13)/2 ≈ 3.3028"),
        ((4, -2), "2 + √2 ≈ 3.4142"),
        ((0, 12), "2√3 ≈ 3.4641"),
        ((1, 1, 0, 0), "(1 + √5)/2 ≈ 1.618"),
        ((2, 0, -1), "(1 + √5)/2 ≈ 1.618"),
    ],
)
def test_roots_of_quadratic_equations_are_exact(rule, text):
    assert rate_text(rule) == text
