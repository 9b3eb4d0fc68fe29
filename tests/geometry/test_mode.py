"""How a system is drawn."""

from __future__ import annotations

import pytest

from lsys_kit import derive, read
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode


@pytest.mark.parametrize(
    ("text", "mode"),
    [
        ("axiom: F[+F]F", DrawingMode.PLANE),
        ("axiom: F[&F]F", DrawingMode.SPACE),
        ("axiom: a\ninterpretation:\na -> R(2,1)", DrawingMode.FILAMENT),
        ("axiom: a & a\ninterpretation:\na -> R(2,1)", DrawingMode.FILAMENT),
    ],
)
def test_a_system_is_a_filament_or_in_the_plane_or_in_space(text: str, mode: DrawingMode) -> None:
    assert drawing_mode(read(text)) is mode


def test_the_scene_of_a_filament_is_its_cells() -> None:
    derivation = derive(read("axiom: a\na -> a a\ninterpretation:\na -> R(2,1)"), 12)
    assert len(scene_of(derivation).cells) == len(filament(derivation[-1]).cells) == 4096
