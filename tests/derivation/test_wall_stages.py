"""The stage diagram of the walls of a map."""

from __future__ import annotations

import pytest

from lsys_kit import cellwork_system, read_cellwork
from lsys_kit.derivation.petri.walls import wall_stages
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.dialects.map.dialect import read_map


@pytest.mark.parametrize(("limit", "what"), [("MOST_PLACES", "walls"), ("MOST_ARCS", "arrows")])
def test_a_diagram_that_would_not_be_legible_is_refused(monkeypatch: pytest.MonkeyPatch, limit: str, what: str) -> None:
    system = read_map("map: ABAB\nA -> B[-A][+A]B\nB -> A")
    assert len(wall_stages(system).places) == 2
    monkeypatch.setattr(f"lsys_kit.derivation.petri.walls.{limit}", 1)
    with pytest.raises(ModelLimitError, match=f"{what}, and with more than 1 it is not legible"):
        wall_stages(system)


def test_edges_of_a_cellwork_have_stages_too() -> None:
    box = cellwork_system("K33")
    net = wall_stages(box)
    assert str(net) == ("P -> 2 R + [PQ: P] P + [PR: Q] Q\nQ -> P\nR -> Q\nbesides: two markers [ ] that match make an edge")
    assert (net.start, [place.symbol for place in net.places]) == ((4, 4, 4), ["P", "Q", "R"])
    some = wall_stages(read_cellwork(str(box).replace("Q: * -> P", "Q: PQ QR -> P")))
    assert [transition.condition for transition in some.transitions] == ["", "in PQ QR", ""]
    assert [*map(str, box.axiom)] == [*"PQPQPQPQRRRR"]
