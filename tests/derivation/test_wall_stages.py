"""The stage diagram of the walls of a map."""

from __future__ import annotations

import pytest

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
