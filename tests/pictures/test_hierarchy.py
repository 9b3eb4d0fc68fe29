"""The languages of L-systems beside the Chomsky hierarchy: which ellipse lies in which, and what the examples prove."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from itertools import pairwise, product
from pathlib import Path

import pytest

from lsys_kit import ModelFileError, derive, draw_hierarchy, read
from lsys_kit.pictures.hierarchy import CHOMSKY, HEIGHT, LANGUAGES, PARALLEL, WIDTH, LanguageClass
from lsys_kit.pictures.style.colour_values import contrast
from lsys_kit.pictures.style.palette import BLUE
from lsys_kit.pictures.style.themes import DARK, LIGHT

POINTS = [*product(range(WIDTH), range(HEIGHT))]
CONTEXT, FREE = PARALLEL


def points_of(each: LanguageClass) -> set[tuple[int, int]]:
    return {point for point in POINTS if each.holds(*point)}


@pytest.mark.slow
def test_each_class_of_chomsky_lies_inside_the_one_before() -> None:
    for outer, inner in pairwise(map(points_of, CHOMSKY)):
        assert inner < outer


@pytest.mark.slow
def test_0l_languages_are_context_sensitive_and_cut_across_the_smaller_classes() -> None:
    free, (_, sensitive, *smaller) = points_of(FREE), map(points_of, CHOMSKY)
    assert free < sensitive
    assert all(each & free and each - free and free - each for each in smaller)


@pytest.mark.slow
def test_kl_systems_contain_0l_systems_and_cut_across_all_but_the_greatest_class() -> None:
    context, (enumerable, *smaller) = points_of(CONTEXT), map(points_of, CHOMSKY)
    assert points_of(FREE) < context < enumerable
    assert all(each & context and each - context and context - each for each in smaller)


def test_each_language_stands_in_its_classes_and_in_no_other() -> None:
    for language in LANGUAGES:
        assert {each.name for each in (*CHOMSKY, *PARALLEL) if each.holds(language.x, language.y)} == language.classes


@pytest.mark.parametrize(
    ("rules", "language"),
    [
        ("axiom: a", "a a a a"),
        ("axiom: b\nb -> a b a", "b aba aabaa aaabaaa"),
        ("axiom: a a\na -> a a", "aa aaaa aaaaaaaa"),
        ("axiom: a\na < a -> a\na > a -> a\na -> a a", "a aa aa aa"),
    ],
    ids=["one word", "not regular", "not free", "not 0L"],
)
def test_an_example_is_derived(rules: str, language: str) -> None:
    words = derive(read(rules), len(language.split()) - 1)
    assert ["".join(str(word).split()) for word in words] == language.split()


def test_every_class_and_language_has_its_name_inside_the_picture() -> None:
    root = ET.fromstring(draw_hierarchy().svg)
    texts = [text.text for text in root.iter("{http://www.w3.org/2000/svg}text")]
    assert texts == [each.name for each in (*CHOMSKY, *PARALLEL)] + [language.text for language in LANGUAGES]
    assert root.get("aria-label") == str(draw_hierarchy())
    for each in (*CHOMSKY, *PARALLEL):
        assert each.holds(*each.label)
        assert 0 < each.centre[0] - each.reach[0] < each.centre[0] + each.reach[0] < WIDTH
        assert 0 < each.centre[1] - each.reach[1] < each.centre[1] + each.reach[1] < HEIGHT


def test_the_hierarchy_is_kept_as_svg(tmp_path: Path) -> None:
    draw_hierarchy().save(tmp_path / "hierarchy.svg")
    assert (tmp_path / "hierarchy.svg").read_text(encoding="utf-8").startswith("<svg")
    assert draw_hierarchy()._repr_mimebundle_()["image/svg+xml"] == draw_hierarchy().svg
    with pytest.raises(ModelFileError, match=r"Let the name end in .svg"):
        draw_hierarchy().save(tmp_path / "hierarchy.glb")


def test_on_dark_paper_what_is_written_can_be_read() -> None:
    dark = draw_hierarchy("dark").svg
    assert DARK.paper in dark
    assert not {LIGHT.ink, LIGHT.paper, BLUE} & {*re.findall("#[0-9A-Fa-f]{6}", dark)}
    assert all(contrast(colour, DARK.paper) >= 4.5 for colour in re.findall('<text[^>]* fill="(#[^"]+)"', dark))
