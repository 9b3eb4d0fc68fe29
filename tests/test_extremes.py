"""Values at the end of what numbers can hold: what is asked for, or an error that explains itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import sympy

from lsys_kit import ModelLimitError, ModelValueError, check, draw, limits, read
from tests.endings import MESHES


@pytest.mark.parametrize(
    "text",
    [
        "axiom: F+F\nangle: 1e308\nF -> F+F",
        "axiom: F(1e39)+F(1e39)",
        "axiom: F(1e-300)+F(1e-300)",
        "axiom: +(1e49)F-(1e49)F",
        "axiom: F&F\nangle: 1e308",
        "axiom: F(1e49)&(30)F(1)",
        "axiom: A\nA -> A\ndepth: 1000\ninterpretation:\nA -> A F",
        "axiom: @o(1e39)F(1e39)",
    ],
)
@pytest.mark.filterwarnings("error")
def test_a_picture_has_finite_numbers_in_every_format(text: str, tmp_path: Path) -> None:
    picture = draw(read(text), 2)
    assert "nan" not in picture.svg
    assert "inf" not in picture.svg
    assert picture.png.startswith(b"\x89PNG")
    assert "nan" not in repr(picture)


@pytest.mark.parametrize("text", ["axiom: F(1e49)&(30)F(1)", "axiom: F(1e39)"])
@pytest.mark.parametrize("ending", MESHES)
def test_a_mesh_that_its_format_cannot_hold_is_refused(text: str, ending: str, tmp_path: Path) -> None:
    with pytest.raises(ModelValueError, match="too large for a mesh"):
        draw(read(text), 0).save(tmp_path / f"a{ending}")


ANSWERS = {
    "long": 10**5000,
    "negative": -(10**5000),
    "symbol": sympy.Symbol("x"),
    "sum": sympy.Symbol("x") + 1,
    "large": 1e308,
    "infinite": float("inf"),
    "text": "9" * 900,
}


@pytest.mark.parametrize("answer", ANSWERS.values(), ids=ANSWERS.keys())
def test_any_number_may_be_an_answer(answer: object) -> None:
    assert check("1.2", answer) < 1


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "axiom: a\na -> a\ninterpretation:\na -> repeat(100000,i)<repeat(100000,j)<F>>",
        "axiom: a\na -> a\ndepth: 100\ninterpretation:\na -> a a",
    ],
)
@pytest.mark.parametrize("act", [lambda system: draw(system, 1)])
def test_what_is_drawn_of_a_module_is_bounded(text: str, act: Callable[..., object]) -> None:
    with pytest.raises(ModelLimitError, match="a is drawn as more than 500,000 modules"):
        act(read(text))
    with limits(interpretation=10), pytest.raises(ModelLimitError, match="more than 10 modules"):
        act(read(text))
