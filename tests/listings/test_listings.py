"""Every listing of the five seed documents is read as printed, and derives what the table beside it says once it is corrected.

A notation takes part from the moment it is in the registry. The table spells words as the catalogue of systems does; here each
spelling is translated into modules. What is not a system is named: `FRAGMENTS` are read as rules, map systems by `read_map`.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, TypeAlias

import pytest

from lsys_kit.classroom.catalogue import map_system
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.timed.timed import timed
from lsys_kit.errors import LSystemError
from lsys_kit.geometry.filament import filament
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read, read_word
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.worlds.derive import derive

FOLDER = Path(__file__).parent
LISTINGS: Sequence[dict[str, Any]] = tomllib.loads((FOLDER / "listings.toml").read_text(encoding="utf-8"))["listing"]
KNOWN = [listing for listing in LISTINGS if listing["notation"] in DIALECTS]
SYSTEMS = [listing for listing in KNOWN if listing["kind"] == "system"]
Told: TypeAlias = tuple[str, tuple[Any, ...]]
"""A module as the table tells it: its symbol, its values."""


def _cell(match: re.Match[str]) -> Told:
    """A cell with an arrow behind it, perhaps with a parameter."""
    return match[1] + {"<": "_l", ">": "_r"}[match[2]], (Fraction(match[3]),) if match[3] else ()


def _aged(match: re.Match[str]) -> Told:
    """A cell of L-systems 4 to 8: its age or length, and where it points."""
    return "M", (Fraction(match[1]), {"L": -1, "R": 1}[match[2]])


def _letter(match: re.Match[str]) -> Told:
    return match[1], tuple(Fraction(value) for value in match.groups()[1:] if value)


SPELLINGS: Mapping[str, tuple[str, Callable[[re.Match[str]], Told]]] = {
    "J1 T1 K1": (r"([ab][lr])", _letter),
    "J2": (r"([abcd])", _letter),
    "J3": (r"([abc])(?:\[(\d+)\])?", _letter),
    "J4 J5": (r"([AB][lr])(\d+)", _letter),
    "P1 P2 P3": (r"([A-Z])([<>])(?:\((\d+)\))?", _cell),
    "P4": (r"M\((\d+),([LR])\)", _aged),
    "P5 P6 P8": (r"([\d.]+)([LR])", _aged),
    "P9": (r"([WM])([\d.]+)", _letter),
    "K27": (r"\((\w+),([\d.]+)\)", _letter),
    "T2 K16 L1 L2": (r"(\S)", _letter),
}
"""How the table spells the modules of some systems, and what it means; all others are spelt in the listing's notation."""
AXIOMS = {
    "abop": "axiom: {}",
    "cpfg": "Axiom: {}",
    "plant-string": "Axiom: {}",
    "grogra": "\\axiom {},",
    "mathematica": "axiom = AXIOM[{}];",
}
BEGUN = {"002-L2.abop.txt": "\\vec{L}", "002-L3.abop.txt": "\\vec{M}(2)", "003-signal.abop.txt": "saaaa"}
"""Listings without an axiom, and the word of step 0, with which the table begins."""
FRAGMENTS = {
    "000-rule-form.abop.txt": ("l p r", "l < p > r -> s"),
    "000-rule-form.mathematica.txt": ("l, p, r", "l < p > r -> s"),
    "003-parameters.grogra.txt": ("a(2, 3)", "a(x,y) -> F(x^3 + 10)b(2 * y)"),
    "003-condition.grogra.txt": ("a(17, 1)", "a(x,y) : x >= 17 && y != 0 -> ε"),
    "004-first-production.plant-string.txt": ("I", "I -> I[A]A(I)A"),
}
"""Rules that make no system: an axiom with which they do, and what they are in the kit's own spelling."""
REFUSED = {
    "001-anabaena.abop.txt": ("This is not an arrow", 1, 4),
    "001-koch.abop.txt": ("This dash is not a minus sign", 1, 15),
}
"""Listings that cannot be read as printed: what is said, the line and the column."""


def each(listings: Iterable[Mapping[str, Any]]) -> pytest.MarkDecorator:
    """A test of some listings, each by the name of its file."""
    return pytest.mark.parametrize("listing", [pytest.param(listing, id=listing["file"]) for listing in listings])


def text_of(listing: Mapping[str, Any], corrected: bool = True) -> str:
    """A listing, as printed or without its errata; with an axiom, where it has none."""
    text = (FOLDER / listing["file"]).read_text(encoding="utf-8")
    for correction in listing["corrections"] if corrected else ():
        assert text.count(correction["printed"]) == 1
        text = text.replace(correction["printed"], correction["corrected"])
    begun = BEGUN.get(listing["file"])
    return f"{AXIOMS[listing['notation']].format(begun)}\n{text}" if begun else text


def listed(listing: Mapping[str, Any], corrected: bool = True) -> LSystem:
    return read(text_of(listing, corrected), listing["notation"])


def by_file(file: str) -> Mapping[str, Any]:
    return next(listing for listing in LISTINGS if listing["file"] == file)


def told(listing: Mapping[str, Any], text: str) -> list[Told]:
    """The modules of a word as the table spells it."""
    for ids, (pattern, meaning) in SPELLINGS.items():
        if listing["system"] in ids.split():
            return [meaning(match) for match in re.finditer(pattern, text)]
    return [(module.symbol, module.arguments) for module in read_word(text, listing["notation"])]


def derived(listing: Mapping[str, Any], word: Word) -> list[Told]:
    """The modules of a derived word, with the spelling of symbols that listings of one system do not share: a_r, aR, A_r."""
    like = listing["system"] in ("J1", "T1", "K1", "K27")
    return [(module.symbol.replace("_", "").lower() if like else module.symbol, module.arguments) for module in word]


def word_at(listing: Mapping[str, Any], system: LSystem, at: Any) -> Word:
    """The word at a step; at a time, where the system is a timed one."""
    return timed(system).word(at) if listing["system"] == "K27" else derive(system, at)[-1]


@each(listing for listing in SYSTEMS if listing["expected"])
def test_a_listing_derives_the_words_of_the_table(listing: Mapping[str, Any]) -> None:
    system, close = listed(listing), Fraction(1, 20_000) if listing["system"] == "P8" else 0
    for at, text in listing["expected"]:
        found, expected = derived(listing, word_at(listing, system, at)), told(listing, text)
        assert [symbol for symbol, _ in found] == [symbol for symbol, _ in expected]
        values = [(a, b) for (_, have), (_, want) in zip(found, expected, strict=True) for a, b in zip(have, want, strict=True)]
        assert all(abs(a - b) <= close for a, b in values)


@each(listing for listing in SYSTEMS if "counts" in listing)
def test_a_listing_grows_as_the_table_says(listing: Mapping[str, Any]) -> None:
    counts = listing["counts"]
    assert [len(word) for word in derive(listed(listing), len(counts) - 1)] == counts


@each(listing for listing in SYSTEMS if {"counts_at", "letters"} & listing.keys())
def test_a_listing_has_as_many_letters_as_the_table_says(listing: Mapping[str, Any]) -> None:
    system = listed(listing)
    assert all(len(word_at(listing, system, at)) == count for at, count in listing.get("counts_at", ()))
    for letter, counts in listing.get("letters", {}).items():
        for at, count in counts:
            assert sum(module.symbol == letter for module in derive(system, at)[-1]) == count


@each(listing for listing in SYSTEMS if "filament_lengths" in listing)
def test_a_filament_is_as_long_as_the_table_says(listing: Mapping[str, Any]) -> None:
    lengths = listing["filament_lengths"]
    found = [filament(word).cells.sizes[:, 0].sum() for word in derive(listed(listing), len(lengths) - 1)]
    assert found == pytest.approx(lengths, rel=1e-4)


@each(SYSTEMS)
def test_a_corrected_listing_runs_for_three_steps(listing: Mapping[str, Any]) -> None:
    system = listed(listing)
    assert system.productions
    assert system.notation == listing["notation"]
    assert str(derive(system, 3)[-1])


@each(SYSTEMS)
def test_a_listing_as_printed_is_read_or_refused_at_its_erratum(listing: Mapping[str, Any]) -> None:
    if listing["file"] not in REFUSED:
        assert listed(listing, corrected=False).productions
        return
    with pytest.raises(LSystemError) as caught:
        listed(listing, corrected=False)
    assert (caught.value.message, caught.value.line, caught.value.column) == REFUSED[listing["file"]]


@each(listing for listing in KNOWN if listing["kind"] == "fragment")
def test_a_fragment_is_a_rule(listing: Mapping[str, Any]) -> None:
    axiom, rule = FRAGMENTS[listing["file"]]
    system = read(f"{AXIOMS[listing['notation']].format(axiom)}\n{text_of(listing)}", listing["notation"])
    assert [str(production) for production in system.productions] == [rule]
    for at, text in listing["expected"]:
        assert derived(listing, derive(system, at)[-1]) == told(listing, text)


@each(listing for listing in LISTINGS if listing["kind"] == "map")
def test_a_map_as_printed_has_the_vertices_walls_and_cells_of_the_table(listing: Mapping[str, Any]) -> None:
    system, counts = read_map(text_of(listing, corrected=False)), listing["map_counts"]
    assert [list(found) for found in derive(system, len(counts) - 1).counts] == counts
    assert system.notes == ()
    assert read_map(str(system)) == system
    assert system.productions == map_system(listing["system"]).productions


def test_the_first_map_is_printed_twice() -> None:
    first, text = (read_map(text_of(by_file(f"003-map-{name}.abop.txt"))) for name in ("1", "1-text"))
    assert first == text


def test_every_listing_takes_part() -> None:
    assert {listing["kind"] for listing in LISTINGS} == {"system", "fragment", "map"}
    assert {listing["file"] for listing in LISTINGS if listing["kind"] == "fragment"} == FRAGMENTS.keys()
    assert {listing["file"] for listing in LISTINGS} == {path.name for path in FOLDER.glob("*.txt")}
    assert {listing["notation"] for listing in LISTINGS} == AXIOMS.keys()


def words(system: LSystem, steps: int) -> list[str]:
    return list(map(str, derive(system, steps)))


def symbols(word: Word) -> str:
    return "".join(module.symbol for module in word)


def test_a_correction_is_asked_for_wherever_something_is_printed_wrongly() -> None:
    assert {listing["file"] for listing in LISTINGS if listing["corrections"]} == {*REFUSED, *AS_PRINTED}


AS_PRINTED: Mapping[str, Callable[[LSystem, LSystem], bool]] = {
    "000-anabaena.mathematica.txt": lambda system, corrected: system == corrected,
    "000-ILSystem1.mathematica.txt": lambda system, _: symbols(derive(system, 7)[-1]) == "cccccccd",
    "000-ILSystem2.mathematica.txt": lambda system, _: len(set(words(system, 14))) == 11,
    "000-figure-2.mathematica.txt": lambda system, corrected: words(system, 10) == words(corrected, 10),
    "000-figure-3.mathematica.txt": lambda system, _: (
        words(system, 10) == words(listed(by_file("000-figure-2.mathematica.txt")), 10)
    ),
    "002-L2.abop.txt": lambda system, _: words(system, 4)[-1] == "L_l S_l",
    "002-L3.abop.txt": lambda system, _: words(system, 4)[-1] == "M_r(2)M_r(1)",
    "002-L9.cpfg.txt": lambda system, _: (
        len(derive(system, 5)[-1]) == 3
        and system.notes[-2:]
        == ("The production W(tl) < M(t,p) > W(tr) can never match: no module M with 2 parameters occurs.",) * 2
    ),
    "003-stochastic.abop.txt": lambda system, corrected: words(system, 4) == words(corrected, 4),
}
"""What listings with errata do as printed: the layer of ILSystem2 sticks, L-system 9 cannot divide, two figures are one."""


@each(listing for listing in KNOWN if listing["file"] in AS_PRINTED)
def test_a_listing_as_printed_does_what_its_errata_say(listing: Mapping[str, Any]) -> None:
    assert AS_PRINTED[listing["file"]](listed(listing, corrected=False), listed(listing))
