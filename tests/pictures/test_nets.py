"""Stage diagrams: the rows read as the paper's, tokens are the word's counts, and no line crosses a circle."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from itertools import combinations, product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, ModelValueError, derive, draw, limits, read, stages, system, systems, timed
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.pictures.formats.svg import svg
from lsys_kit.pictures.nets import diagram, parts
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.nets.layout import Layout, crossings
from lsys_kit.pictures.nets.parts import clearest_layout, parts_of, short, width_of
from lsys_kit.pictures.nets.rows import rows_of, shown_places
from lsys_kit.pictures.style.labels import steering_of
from lsys_kit.pictures.style.palette import MARK

NAMED = ("J1", "J4", "J5", "P1", "P2", "P3", "P4", "P5", "T2", "K2", "K5", "L1")
CASES = [(name, {}) for name in systems()] + [("P5", {"dt": "1.4"}), ("P5", {"dt": "0.35"}), ("P5", {"dt": "0.1"})]
GROWN = """axiom: A(1,2)
A(x,y) : x > 3*y && y < 17 || x + y == 12345 -> A(x+1,y) B(y) [ A(1,2) ] B(2)
A(x,y) -> B(x) A(x*2,y)
B(z) : z < 4 -> B(z+1)
B(z) -> B(1) B(2) C
C -> D
D -> C B(1) A(1,1)"""
HOSTILE = ('x" onload="alert(1)', "<script>alert(1)</script>", "a&b", "]]>", "'--><img src=x>")
SVG = "{http://www.w3.org/2000/svg}"


def svg_of(net: Stages, **options: object) -> ET.Element:
    return ET.fromstring(svg(drawn_stages(net, (1,) * len(net.places), **options)))


def sampled(path: str) -> list[tuple[float, float]]:
    """Points along a path of straight lines and quadratic curves, less than half a pixel apart on what is curved."""
    points: list[tuple[float, float]] = []
    for command, text in re.findall(r"([MLQ])([^MLQ]*)", path):
        numbers = [float(n) for n in text.split()]
        if command == "M":
            points.append((numbers[0], numbers[1]))
            continue
        (x, y), end = points[-1], (numbers[-2], numbers[-1])
        bend = (numbers[0], numbers[1]) if command == "Q" else ((x + end[0]) / 2, (y + end[1]) / 2)
        pieces = max(40, int(abs(end[0] - x) + abs(end[1] - y)) * 2)
        for t in (i / pieces for i in range(1, pieces + 1)):
            points.append(
                tuple(
                    (1 - t) ** 2 * a + 2 * t * (1 - t) * b + t * t * c  # type: ignore[arg-type]
                    for a, b, c in zip((x, y), bend, end, strict=True)
                )
            )
    return points


def text_box(text: ET.Element) -> tuple[float, float, float, float]:
    """About the space that a text takes: left, top, right, bottom."""
    x, y, size = (float(text.attrib[key]) for key in ("x", "y", "font-size"))
    told = text.findtext(f"{SVG}title") or ""
    width = width_of("".join(text.itertext()).removeprefix(told), size)  # the title stands first, and is not seen
    left = x - width / 2 if text.get("text-anchor") == "middle" else x
    return left, y - 0.72 * size, left + width, y + 0.2 * size


def meets(box: tuple[float, float, float, float], points: list[tuple[float, float]]) -> bool:
    return any(box[0] < x < box[2] and box[1] < y < box[3] for x, y in points)


def collisions(net: Stages, notes: bool = True, **options: object) -> list[str]:
    """Every place where a line of a net's picture runs through a circle, a bar or a text that it has no business with."""
    root = svg_of(net, **options)
    circles = {int(g.attrib["data-place"]): g.find(f"{SVG}circle") for g in root.iter(f"{SVG}g") if g.get("class") == "stage"}
    bars = [g for g in root.iter(f"{SVG}g") if g.get("class") == "transition"]
    texts = [text_box(t) for t in root.iter(f"{SVG}text") if t.get("class") not in ("token", "note")]
    lines = {f"arc {p.attrib['data-arc']}": sampled(p.attrib["d"]) for p in root.iter(f"{SVG}path") if p.get("class") == "arc"}
    lines |= {f"feed {i}": sampled(g.find(f"{SVG}path").attrib["d"]) for i, g in enumerate(bars)}  # type: ignore[union-attr]
    found = []
    for name, points in lines.items():
        for place, circle in circles.items():
            x, y, r = (float(circle.attrib[key]) for key in ("cx", "cy", "r"))  # type: ignore[union-attr]
            inside = any((a - x) ** 2 + (b - y) ** 2 < (r - 0.2) ** 2 for a, b in points)
            found += [f"{name} runs through circle {place}"] * inside
        for number, bar in enumerate(bars):
            x, y, w, h = (float(bar.find(f"{SVG}rect").attrib[k]) for k in ("x", "y", "width", "height"))  # type: ignore[union-attr]
            end = points[0] if name.startswith("arc") else points[-1]
            own = meets((x - 0.1, y, x + w + 0.1, y + h), [end])
            inner = [p for p in points if abs(p[0] - end[0]) > w] if own else points
            found += [f"{name} runs through bar {number}"] * meets((x, y, x + w, y + h), inner)
        found += [f"{name} runs through the text at {box[:2]}" for box in texts if meets(box, points)]
    if notes:
        own_notes = [text_box(t) for t in root.iter(f"{SVG}text") if t.get("class") == "note"]
        crossed = [box for box in own_notes if sum(meets(box, points) for points in lines.values()) > 1]
        found += [f"the note at {box[:2]} is crossed" for box in crossed]
    return found


@pytest.mark.slow
@pytest.mark.parametrize("positions", [False, True])
@pytest.mark.parametrize(("name", "constants"), CASES)
def test_no_line_crosses_a_circle_a_bar_or_a_label(name: str, constants: dict[str, str], positions: bool) -> None:
    assert collisions(stages(system(name), **constants), positions=positions) == []


@pytest.mark.slow
@pytest.mark.parametrize("polarity", [False, True])
def test_no_line_crosses_a_circle_whatever_the_life_spans(polarity: bool) -> None:
    for a, b in product((1, 2, 5, 10), repeat=2):
        assert collisions(stages(system("J4"), polarity=polarity, **spans(a, b))) == []


def spans(a: int, b: int) -> dict[str, int]:
    names = [constant.name for constant in system("J4").constants]
    return dict(zip(names, (a, b), strict=True))


def test_conditions_stand_beside_the_bars_of_a_grouped_net() -> None:
    net = stages(read(GROWN))
    assert net.grouped
    assert collisions(net) == []
    texts = ["".join(t.itertext()) for t in svg_of(net).iter(f"{SVG}text") if t.get("class") == "terms"]
    assert len(texts) == 2
    assert texts[1].endswith("z < 4")


@st.composite
def systems_of_symbols(draw: st.DrawFn) -> str:
    names = st.sampled_from(("a", "Bud", "Internode", "Heterocyst_long"))
    symbols = [f"{draw(names)}{chr(97 + i)}" for i in range(draw(st.integers(1, 14)))]
    words = st.lists(st.sampled_from(symbols), min_size=1, max_size=4).map(" ".join)
    return "\n".join([f"axiom: {' '.join(symbols)}", *(f"{s} -> {draw(words)}" for s in symbols if draw(st.booleans()))])


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(systems_of_symbols())
def test_no_line_of_any_net_crosses_a_circle_a_bar_or_a_label(text: str) -> None:
    assert collisions(stages(read(text)), notes=False) == []


@pytest.mark.parametrize("name", ["T2", "K5"])
def test_a_loop_is_wide_enough_for_its_note(name: str) -> None:
    root = svg_of(stages(system(name)), positions=True)
    note = next(text_box(t) for t in root.iter(f"{SVG}text") if t.get("class") == "note")
    loop = [x for p in root.iter(f"{SVG}path") if p.get("class") == "arc" for x, _ in sampled(p.attrib["d"])]
    assert min(loop) + 8 < note[0]
    assert note[2] < max(loop) - 8


@pytest.mark.parametrize("name", ["J2", "K8"])
def test_arcs_of_two_bars_of_one_place_do_not_cross_where_they_need_not(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found: list[Layout] = []
    monkeypatch.setattr(parts, "clearest_layout", lambda *given: found.append(clearest_layout(*given)) or found[-1])
    net = stages(system(name))
    parts_of(net, False, steering_of(net.system))
    assert [crossings(layout) for layout in found] == [0]


def test_the_row_of_l_system_2_reads_as_in_the_paper() -> None:
    net = stages(system("P2"))
    labels = [g.find(f"{SVG}text") for g in svg_of(net).iter(f"{SVG}g") if g.get("class") == "stage"]
    assert ["".join(text.itertext()) for text in labels] == list("SLABC")  # type: ignore[union-attr]
    assert len({text.attrib["y"] for text in labels}) == 1  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("J1", ["b a"]),
        ("P1", ["S L"]),
        ("P4", ["M(1) M(2) M(3) M(4) M(5)"]),
        ("J4", ["A(1) A(2) A(3)", "B(1) B(2)"]),
        ("K2", ["a b F"]),
        ("L1", ["I A B"]),
        ("T2", ["F"]),
    ],
)
def test_rows_of_stages(name: str, wanted: list[str]) -> None:
    net = stages(system(name))
    steering = steering_of(net.system)
    rows = rows_of(net, shown_places(net, steering))
    names = {part.place: part.name for part in parts.parts_of(net, False, steering).places}
    assert [" ".join(names[place] for place in row) for row in rows] == wanted


def test_long_rows_are_wrapped_evenly() -> None:
    net = stages(system("P5"))
    assert [len(row) for row in rows_of(net, shown_places(net, steering_of(net.system)))] == [5, 5]


@pytest.mark.parametrize("name", NAMED)
def test_tokens_are_the_counts_of_the_word(name: str) -> None:
    net = stages(system(name))
    for word in derive(system(name), 5):
        tokens = net.tokens(word)
        for stage in ET.fromstring(svg(drawn_stages(net, tokens))).iter(f"{SVG}g"):
            if stage.get("class") == "stage":
                dots = [c for c in stage.iter(f"{SVG}circle") if c.get("class") == "token"]
                numbers = [t.text for t in stage.iter(f"{SVG}text") if t.get("class") == "token"]
                count = tokens[int(stage.attrib["data-place"])]
                assert (len(dots), numbers) == ((count, []) if count < 5 else (0, [short(count)]))


@pytest.mark.parametrize(("name", "notes"), [("T2", ["4"]), ("K5", ["5"]), ("L1", ["3"]), ("P2", [])])
def test_the_number_of_copies_stands_at_the_arc(name: str, notes: list[str]) -> None:
    assert [t.text for t in svg_of(stages(system(name))).iter(f"{SVG}text") if t.get("class") == "note"] == notes


def test_positions_in_the_successor_on_request() -> None:
    texts = svg_of(stages(system("K2")), positions=True).iter(f"{SVG}text")
    assert sorted(t.text or "" for t in texts if t.get("class") == "note") == ["1st", "1st", "2nd", "4th", "6th"]
    assert "1, 3, 6, 8" in svg(drawn_stages(stages(system("T2")), positions=True))


def test_what_only_steers_the_turtle_is_no_stage() -> None:
    assert 'aria-label="Stage diagram: 3 stages a, b, F"' in svg(drawn_stages(stages(system("K2"))))
    assert "Stage diagram: 6 stages" in svg(drawn_stages(stages(system("K2")), steering=()))


def test_a_rewritten_turn_is_a_stage() -> None:
    assert "2 stages +, F" in svg(drawn_stages(stages(read("axiom: +\n+ -> F+\nF -> F"))))


def test_the_description_says_in_words_what_is_seen() -> None:
    picture = svg(drawn_stages(stages(system("P2")), (1, 0, 1, 2, 0), marked=(0,)))
    assert 'aria-label="Stage diagram: 5 stages S, L, A, B, C; tokens 0, 1, 0, 1, 2; L is marked"' in picture
    assert 'role="img"' in picture


def test_a_marked_stage_is_not_told_by_colour_alone() -> None:
    net = stages(system("P2"))
    plain, marked = svg(drawn_stages(net)), svg(drawn_stages(net, marked=(3,)))
    assert MARK not in plain
    assert marked.count(MARK) == 1
    assert marked.count("<circle") == plain.count("<circle") + 2


def test_values_that_are_not_known_stand_at_their_stages() -> None:
    net = stages(read("c = 1\naxiom: a(c)\na(x) -> a(x) b(c+1)\nb(x) -> b(x)"), c="c")
    assert repr(draw(net)) == "Stage diagram: 2 stages a(c), b(c + 1)"


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names_are_escaped(name: str) -> None:
    from lsys_kit.notation.model.modules import Pattern
    from lsys_kit.notation.model.system import LSystem, Production

    hostile = LSystem((Pattern(name),), (Production((Pattern(name),), (Pattern(name), Pattern(name + "2"))),))
    root = svg_of(stages(hostile), positions=True, marked=(0,))
    tags = {element.tag.removeprefix(SVG) for element in root.iter()}
    assert tags <= {"svg", "g", "rect", "circle", "path", "text", "tspan", "title"}
    assert not any(key.startswith("on") for element in root.iter() for key in element.attrib)
    assert name in root.attrib["aria-label"]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMED)
def test_the_same_net_gives_the_same_bytes(name: str) -> None:
    net = stages(system(name))
    first = svg(drawn_stages(net, (2,) * len(net.places)))
    diagram._diagram.cache_clear()
    parts.parts_of.cache_clear()
    assert svg(drawn_stages(stages(system(name)), (2,) * len(net.places))) == first
    assert not re.search(r"\d\.\d\d", re.sub(r"<text.*?</text>|aria-label=\"[^\"]*\"|<title>.*?</title>", "", first))


def test_everything_lies_inside_the_picture() -> None:
    for name in NAMED:
        root = svg_of(stages(system(name)), positions=True)
        width, height = float(root.attrib["width"]), float(root.attrib["height"])
        for path in root.iter(f"{SVG}path"):
            numbers = [float(n) for n in re.findall(r"-?\d+\.\d", path.attrib["d"])]
            assert min(numbers) > 0
            assert max(numbers[::2]) < width
            assert max(numbers[1::2]) < height
        assert all(text_box(t)[0] > 0 and text_box(t)[2] < width and text_box(t)[3] < height for t in root.iter(f"{SVG}text"))


def test_moving_tokens_lays_nothing_out_again(monkeypatch: pytest.MonkeyPatch) -> None:
    net = stages(system("J4"))
    svg(drawn_stages(net, (1, 0, 0, 0, 0)))
    monkeypatch.setattr(parts, "layout_in_rows", None)
    assert svg(drawn_stages(net, (0, 1, 0, 0, 0))) != svg(drawn_stages(net, (1, 0, 0, 0, 0)))


def test_tokens_that_do_not_fit_the_net() -> None:
    with pytest.raises(ModelValueError, match="5 places; 2 numbers"):
        svg(drawn_stages(stages(system("P2")), (1, 2)))


def test_a_system_without_stages_is_an_empty_picture() -> None:
    assert "Stage diagram: 0 stages" in svg(drawn_stages(stages(read("axiom: +")), (1,)))


@pytest.mark.slow
@pytest.mark.parametrize("positions", [False, True])
@pytest.mark.parametrize("name", systems())
def test_no_text_covers_another(name: str, positions: bool) -> None:
    boxes = [text_box(t) for t in svg_of(stages(system(name)), positions=positions).iter(f"{SVG}text")]
    assert [(a, b) for a, b in combinations(boxes, 2) if a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]] == []


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("K7", ["chance 1/3"] * 3),
        ("K8", ["chance 0.65", "chance 0.35"]),
        ("K19", ["A(7)", "t < 7", "t > 0"]),
        ("P8", ["at once, x ≥ x_div and p = LEFT", "at once, x ≥ x_div and p = RIGHT"]),
    ],
)
def test_a_bar_tells_on_which_terms_it_fires(name: str, wanted: list[str]) -> None:
    texts = [t for t in svg_of(stages(system(name))).iter(f"{SVG}text") if t.get("class") == "terms"]
    assert [t.findtext(f"{SVG}title") for t in texts] == wanted


def test_durations_stand_at_the_bars_of_a_timed_net() -> None:
    net = stages(timed(read("axiom: M(0)\nM(1) -> M(0) M(1/5)")))
    assert collisions(net) == []
    assert [t.findtext(f"{SVG}title") for t in svg_of(net).iter(f"{SVG}text") if t.get("class") == "terms"] == [
        "after 0.2",
        "after 0.8",
    ]


def test_what_no_bar_shows_is_written_below() -> None:
    root = svg_of(stages(system("K26")))
    below = [t for t in root.iter(f"{SVG}text") if t.get("class") == "footnote"]
    assert ["".join(t.itertext()) for t in below] == ["besides: meta: f(x,y)f(u,v) : short = 1 -> f(x + u,y + v)"]
    assert "; besides: meta: f(x,y)f(u,v) : short = 1 -> f(x + u,y + v); tokens" in root.attrib["aria-label"]
    assert text_box(below[0])[2] < float(root.attrib["width"])


def test_a_number_that_depends_on_a_value_stands_at_its_arc() -> None:
    net = stages(read("axiom: A(0)\nA(t) -> repeat(t) <F F> repeat(t-1) <G> A(t+1)"))
    assert [t.text for t in svg_of(net).iter(f"{SVG}text") if t.get("class") == "note"] == ["2 t", "(t - 1)"]


def test_a_stage_diagram_is_kept_as_png_in_any_size(tmp_path: Path) -> None:
    from PIL import Image

    net = stages(system("J4"))
    for size, wanted in ((None, None), (900, 900), ((500, 300), 500)):
        path = tmp_path / f"{wanted}.png"
        draw(net, tokens=derive(system("J4"), 6)[-1], size=size).save(path)
        image = Image.open(path)
        assert image.width == (wanted or float(svg_of(net).attrib["width"]))
        assert len(image.getcolors(image.width * image.height)) > 50
    with limits(bytes=10_000), pytest.raises(ModelLimitError, match="not drawn"):
        _ = draw(net).png
