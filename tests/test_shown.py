"""What a notebook shows of what the public functions give: words of the field, never a record's attributes."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any

import pytest

import lsys_kit
from lsys_kit import derive, explore, link, linked, system
from tests.test_odd_arguments import FITTING

RECORD = re.compile(r"\b[A-Z]\w*\([a-z_]+=|\bobject at 0x")
"""How Python writes the attributes of a record, or that something is an object."""


def given_by(name: str) -> Iterator[Any]:
    """What a public function gives, and what that consists of."""
    function = getattr(lsys_kit, name.split()[0])
    given = function(*FITTING[name]()[: 1 if name in ("read", "limits") else None]) if name != "read_map" else read_map()
    yield given
    if isinstance(given, tuple | lsys_kit.derivation.derive.Derivation):
        yield from given


def read_map() -> Any:
    return lsys_kit.map_system("K28")


@pytest.mark.parametrize("name", [name for name in FITTING if name not in ("figure", "language")])
def test_what_a_public_function_gives_is_shown_in_words(name: str) -> None:
    for each in given_by(name):
        assert not RECORD.search(repr(each)), repr(each)[:200]
        assert len(repr(each)) <= 6_000


def test_every_public_function_is_tried() -> None:
    functions = {name for name in lsys_kit.__all__ if not inspect.isclass(getattr(lsys_kit, name))}
    assert functions <= {name.split()[0] for name in FITTING}


@pytest.mark.parametrize("id", ["J4", "K5", "P9", "L1", "K19"])
def test_the_parts_of_a_system_and_of_a_word_are_shown_in_words(id: str) -> None:
    known = system(id)
    for part in (*known.axiom, *known.productions, *known.constants, *derive(known, 2)[-1]):
        assert repr(part) == str(part)
    assert repr(known) == str(known)


def test_a_link_is_shown_as_the_panel_to_which_it_leads() -> None:
    there = linked(link(system("J4"), {"lifeTimeA": 4}, step=9))
    assert repr(there).splitlines()[-2:] == ["lifeTimeA = 4", "step = 9"]
    bundle = there._repr_mimebundle_()
    panel = explore(there.system, **there.settings)
    assert bundle["text/plain"] == panel._repr_mimebundle_()["text/plain"]
    assert bundle["text/plain"].startswith("Step 9: ")
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert linked(link(system("J4"), {"step": 3}, step=5)).settings["step"] == 5
