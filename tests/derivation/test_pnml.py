"""PNML: the nets as a Petri-net tool reads them, and fires them with its own semantics."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections import Counter
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import ModelValueError, derive, draw, pnml, read, stages, system, systems, timed
from lsys_kit.derivation.petri.pnml import played_otherwise
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from tests.derivation.random_systems import systems as random_systems
from tests.derivation.test_laws import ends

NAMESPACE = {"p": "http://www.pnml.org/version-2009/grammar/pnml"}
STEPS = {"K5": 8, "T2": 5, "L1": 6}
"""How many steps of those that grow fast are fired; the others ten. The tool takes some five microseconds for each token."""
HOSTILE = (
    "<script>alert(1)</script>",
    "a&b",
    "&amp;",
    "\"'",
    "]]>",
    "<![CDATA[x]]>",
    "<!-- x -->",
    "\x01",
    "\x1b[0m",
    "a\nb",
    "a\rb",
    "\t",
    "\ud800",
    "\uffff",
    "é",
    "\u202e",
    "$5 and $6",
    "?>",
    " ",
)


def imported(text: str) -> tuple[Any, Counter[Any]]:
    """The net and the marking that pm4py reads."""
    from pm4py.objects.petri_net.importer import importer

    return importer.deserialize(text)[:2]


def fired_by_pm4py(net: Any, marking: Counter[Any]) -> Counter[Any]:
    """One step of the system: each transition fired, one at a time, as often as its place had tokens at the beginning."""
    from pm4py.objects.petri_net import semantics

    for transition in net.transitions:
        (feed,) = transition.in_arcs
        assert feed.weight == 1
    times = {transition: marking[next(iter(transition.in_arcs)).source] for transition in net.transitions}
    for transition, count in times.items():
        for _ in range(count):
            marking = semantics.execute(transition, net, marking)  # None where it is not enabled
    return marking


def counts(net: Stages, marking: Counter[Any]) -> tuple[int, ...]:
    """A marking's tokens in the order of the net's places."""
    by_name = {place.name: count for place, count in marking.items()}
    return tuple(by_name.get(f"p{number}", 0) for number in range(len(net.places)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["P2", "J1", "J4", "J5", "K5", "T2", "L1", "P9w", "K20"])
def test_a_petri_net_tool_fires_the_steps_that_the_kit_derives(name: str) -> None:
    net = stages(system(name))
    known, marking = imported(pnml(net))
    tokens = net.start
    for _ in range(STEPS.get(name, 10)):
        assert counts(net, marking) == tokens
        tokens, marking = net.fired(tokens), fired_by_pm4py(known, marking)
    assert counts(net, marking) == tokens == net.tokens(derive(system(name), STEPS.get(name, 10))[-1])


@pytest.mark.slow
@settings(max_examples=25, deadline=None)
@given(random_systems().filter(ends))
def test_any_net_is_read_back_as_it_is(model: LSystem) -> None:
    net = stages(model)
    known, marking = imported(pnml(net))
    assert counts(net, marking) == net.start
    assert counts(net, fired_by_pm4py(known, marking)) == net.fired(net.start)
    assert len(known.arcs) == len(net.transitions) + len(net.arcs)


def only_texts(root: ET.Element, path: str) -> list[str]:
    return [element.text or "" for element in root.iterfind(path, NAMESPACE)]


@pytest.mark.parametrize("name", systems())
def test_every_net_of_the_catalogue_is_a_place_transition_net(name: str) -> None:
    net = stages(system(name))
    root = ET.fromstring(pnml(net))
    whole = root.find("p:net", NAMESPACE)
    assert root.tag == f"{{{NAMESPACE['p']}}}pnml"
    assert whole is not None
    assert whole.attrib["type"] == "http://www.pnml.org/version-2009/grammar/ptnet"
    ids = [element.attrib["id"] for element in root.iter() if "id" in element.attrib]
    assert len(ids) == len(set(ids)) == 2 + len(net.places) + 2 * len(net.transitions) + len(net.arcs)
    for arc in root.iterfind(".//p:arc", NAMESPACE):
        assert {arc.attrib["source"][0], arc.attrib["target"][0]} == {"p", "t"}
        assert {arc.attrib["source"], arc.attrib["target"]} <= set(ids)
    assert all(int(text) > 1 for text in only_texts(root, ".//p:inscription/p:text"))
    assert sum(map(int, only_texts(root, ".//p:initialMarking/p:text"))) == sum(net.start) == len(derive(system(name), 0)[0])


def played(net: Stages, tokens: tuple[int, ...]) -> tuple[int, ...]:
    """A step as programs for Petri nets have it: all tokens of a place go through each transition behind it."""
    after = Counter({place: count for place, count in enumerate(tokens) if all(t.place != place for t in net.transitions)})
    for arc in net.arcs:
        after[arc.place] += arc.copies * tokens[net.transitions[arc.transition].place]
    return tuple(after[place] for place in range(len(tokens)))


@pytest.mark.parametrize("name", systems())
def test_what_other_programs_do_not_know_of_a_net_is_said_and_nothing_else(name: str) -> None:
    """Where nothing is said of a net, they play as the system grows; where there are contexts, they do not."""
    net, words = stages(system(name)), derive(system(name), 6)
    tokens = [net.start]
    for _ in range(6):
        tokens.append(played(net, tokens[-1]))
    alike = not net.grouped and tokens == [net.tokens(word) for word in words]
    said = played_otherwise(net)
    assert alike or said.startswith("Programs for Petri nets play this net otherwise than the system grows: they know no ")
    assert bool(said) == any(
        (*net.besides, *(t.condition or t.chance is not None for t in net.transitions), *(arc.factor for arc in net.arcs))
    )


@pytest.mark.parametrize("name", ["K7", "K8"])
def test_probabilities_are_told_to_whoever_knows_them(name: str) -> None:
    root = ET.fromstring(pnml(stages(system(name))))
    likely = only_texts(root, ".//p:transition/p:toolspecific/p:probability")
    assert sum(map(Fraction, likely)) == 1
    assert all(element.attrib["tool"] == "lsys-kit" for element in root.iterfind(".//p:toolspecific", NAMESPACE))


def test_durations_and_conditions_are_told() -> None:
    root = ET.fromstring(pnml(stages(timed(read("axiom: M(0)\nM(1) -> M(0) M(1/5)")))))
    assert only_texts(root, ".//p:toolspecific/p:duration") == ["0.2", "0.8"]
    root = ET.fromstring(pnml(stages(system("P8"))))
    assert only_texts(root, ".//p:toolspecific/p:duration") == ["0", "0"]
    assert only_texts(root, ".//p:toolspecific/p:condition") == ["x >= x_div && p == LEFT", "x >= x_div && p == RIGHT"]
    root = ET.fromstring(pnml(stages(system("K26"))))
    assert only_texts(root, ".//p:toolspecific/p:besides") == ["meta: f(x,y)f(u,v) : short == 1 -> f(x + u,y + v)"]


@pytest.mark.slow
@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_name_is_text(name: str) -> None:
    hostile = LSystem((Pattern(name),), (Production((Pattern(name),), (Pattern(name), *[Pattern(f"{name}2")] * 2)),))
    text = pnml(stages(hostile))
    root = ET.fromstring(text.encode())
    tags = {element.tag.rpartition("}")[2] for element in root.iter()}
    assert tags == {"pnml", "net", "name", "text", "page", "place", "transition", "arc", "initialMarking", "inscription"}
    known, marking = imported(text)
    read_back = {place.name: place.properties["place_name_tag"] for place in known.places}
    expected = shown(name)
    assert read_back == {"p0": expected, "p1": f"{expected}2"} or not name.strip()
    assert [transition.label for transition in known.transitions] == [f"{expected} -> {expected} + 2 {expected}2"]
    assert counts(stages(hostile), fired_by_pm4py(known, marking)) == (1, 2)


def shown(name: str) -> str:
    """A name as PNML has it: control characters are pictures, what is no character is U+FFFD."""
    return "".join(chr(0x2400 + ord(c)) if ord(c) < 32 else "\ufffd" if c in "\ud800\uffff" else c for c in name)


@pytest.mark.slow
def test_tokens_of_any_word_can_be_the_first_marking() -> None:
    net = stages(system("J4"))
    _, marking = imported(pnml(net, net.tokens(derive(system("J4"), 9)[-1])))
    assert counts(net, marking) == net.tokens(derive(system("J4"), 9)[-1])
    with pytest.raises(ModelValueError, match="5 places; 2 numbers"):
        pnml(net, (1, 2))


@given(st.integers(0, 12))
def test_the_same_net_gives_the_same_bytes(step: int) -> None:
    net = stages(system("J5"))
    tokens = net.tokens(derive(system("J5"), step)[-1])
    assert pnml(net, tokens) == pnml(stages(system("J5")), tokens)


def test_a_saved_net_has_the_places_of_its_picture(tmp_path: Path) -> None:
    picture = draw(stages(system("J4")))
    picture.save(tmp_path / "net.pnml")
    nodes = {node.get("id"): node.find("p:graphics/p:position", NAMESPACE) for node in ET.parse(tmp_path / "net.pnml").iter()}
    place, transition = nodes["p0"], nodes["t0"]
    circle = next(ET.fromstring(picture.svg).iter("{http://www.w3.org/2000/svg}circle"))
    assert place is not None
    assert transition is not None
    assert place.attrib == {"x": circle.get("cx"), "y": circle.get("cy")}
    assert float(transition.attrib["x"]) > float(place.attrib["x"])


@pytest.mark.parametrize("name", ["J4", "K12", "ABOP-1.26"])
def test_a_saved_net_is_that_of_its_picture(name: str, tmp_path: Path) -> None:
    """Brackets and turns, which the picture leaves out, are no places, and all that is there stands somewhere."""
    picture = draw(stages(system(name)))
    picture.save(tmp_path / "net.pnml")
    page = ET.parse(tmp_path / "net.pnml").getroot()
    places, transitions, arcs = (page.findall(f".//p:{tag}", NAMESPACE) for tag in ("place", "transition", "arc"))
    assert len(places) == picture.svg.count('class="stage"')
    assert len(transitions) == picture.svg.count('class="transition"')
    assert len(arcs) == picture.svg.count('class="arc"') + len(transitions)
    assert all(node.find("p:graphics/p:position", NAMESPACE) is not None for node in (*places, *transitions))
