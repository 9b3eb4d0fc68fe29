"""Everybody's plants on one page: each is a tile with its name, and what is broken or hostile is a tile that says so."""

from __future__ import annotations

import base64
import os
import re
from html.parser import HTMLParser

import pytest

from lsys_kit import link, map_system, read, system
from lsys_kit.__main__ import main
from lsys_kit.classroom import wall as wall_module
from lsys_kit.classroom.handed_in import handed_in
from lsys_kit.classroom.wall import Tile, drawn_as, models_in, wall, wall_page
from lsys_kit.errors import ModelFileError
from tests.test_hostile_names import HOSTILE, check_svg

PLANT = "angle: 25\naxiom: F\nF -> F[+F]F[-F]F\nsteps: 3"
LINK = link(read(PLANT), {"step": 2})


class Tags(HTMLParser):
    """The elements and attributes of a page, and where its addresses lead."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags, self.attributes, self.addresses = set[str](), set[str](), set[str]()
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}
        self.addresses |= {value[:5] for name, value in attrs if name in ("src", "href")}


def given(folder, **files):
    for name, text in files.items():
        (folder / f"{name}.txt").write_text(text, encoding="utf-8")
    return [(each.name, each.text, bool(each.problem)) for file in handed_in(folder) for each in models_in(file)]


def test_a_file_is_a_model_or_a_list_of_links(tmp_path):
    assert given(tmp_path, ann=PLANT, bob=LINK, cleo=f"{LINK}\n{LINK}\n", dora=f"{LINK[:40]}\n{LINK[40:]}\n") == [
        ("ann", PLANT, False),
        ("bob", LINK, False),
        ("cleo 1", LINK, False),
        ("cleo 2", LINK, False),
        ("dora", f"{LINK[:40]}\n{LINK[40:]}\n", False),
    ]


@pytest.mark.parametrize(
    "line",
    [
        f"Ann Lee: {LINK}",
        f"= Ann Lee = {LINK}",
        f"Ann Lee\t{LINK}",
        f"{LINK},Ann Lee",
        f'"Ann Lee";"{LINK}"',
        f"- Ann Lee - {LINK}",
        f"Ann Lee <{LINK}>",
    ],
)
def test_a_name_may_stand_beside_a_link(line, tmp_path):
    assert given(tmp_path, all=f"{line}\n\n{LINK}\nwhat is this") == [
        ("Ann Lee", LINK, False),
        ("all 2", LINK, False),
        ("all 3", "what is this", True),
    ]


@pytest.mark.parametrize("name", ["-1", "=cmd", "+Ann", "@bob", "–5°"])
def test_a_name_keeps_the_sign_with_which_it_begins(name, tmp_path):
    assert given(tmp_path, all=f"{name}: {LINK}\n{LINK} {name}\n- {name}, {LINK}") == [(name, LINK, False)] * 3


def test_a_byte_that_is_no_text_costs_no_other_link(tmp_path):
    assert given(tmp_path, all=f"Ann: {LINK}\nBob\0: {LINK}\nCem: {LINK}\0\n\0") == [
        ("Ann", LINK, False),
        ("Bob", LINK, False),
        ("Cem", LINK, False),
    ]


def test_a_comment_that_names_a_link_makes_no_list(tmp_path):
    text = f"{PLANT}  # after {LINK}"
    assert given(tmp_path, ann=text) == [("ann", text, False)]


def test_the_settings_of_a_link_are_drawn():
    assert drawn_as(LINK)["description"].startswith("step 2; 25 segments")
    changed, usual = {"step": 9, "lifeTimeA": 2}, {"step": 9}
    assert drawn_as(link(system("J4"), changed))["picture"] != drawn_as(link(system("J4"), usual))["picture"]
    assert drawn_as(link(read(PLANT), {"angle": 90}))["picture"] != drawn_as(link(read(PLANT)))["picture"]
    assert "walls" in drawn_as(link(map_system("K28"), {"step": 1, "pressure": 1}))["description"]


def test_a_tile_shows_the_rules_that_were_handed_in():
    assert read(drawn_as(LINK)["rules"]) == read(PLANT)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("axiom: F\nF -> F F F F F F F F F F\nsteps: 40", "the limit is"),
        (link(read("axiom: A\nA -> A A"), {"step": 10**9}), "the limit is"),
        ("axiom: F\nF -> F +", ""),
        ("axiom: A\nA -> B\nA -> (", "line 3"),
        ("", "axiom"),
        ("#lsys=aAAAA", "broken"),
        ("axiom: " + "[" * 50_000, ""),
        ("while True: pass", ""),
        ("axiom: A(9^9^9^9)", ""),
        ("F" * 1_100_000, "characters"),
    ],
    ids=range(10),
)
def test_what_cannot_be_drawn_says_why(text, said):
    found = drawn_as(text)
    assert found.keys() == {"mistake"} or not said
    assert said in found.get("mistake", "")
    assert len(found.get("mistake", "")) < 700


@pytest.mark.parametrize("name", HOSTILE)
def test_no_text_becomes_markup(name):
    tiles = [Tile(name, "<svg/>", name, name), Tile(name, mistake=name)]
    page, harmless = Tags(wall_page(name, tiles)), Tags(wall_page("", [Tile("", "<svg/>"), Tile("", mistake="a")]))
    assert page.tags == harmless.tags
    assert page.attributes == harmless.attributes
    assert page.addresses == {"data:"}
    wall_page(name, tiles).encode()


@pytest.mark.slow
def test_a_class_of_two_hundred_is_on_one_page_with_its_hostile_links_as_errors(tmp_path, capsys):
    good = [link(system(name), {"step": step}) for name in ("K5", "J4", "K18", "P9", "T2") for step in range(1, 5)]
    bad = [
        LINK[:-5],
        "#lsys=",
        "#lsys=zzzz",
        f"{'x' * 3_000}#lsys=a<script>",
        link(read("axiom: F\nF -> F F F F F F F F F F"), {"step": 50}),
    ]
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "links.txt").write_text(
        "\n".join(f"<b>Student {number}</b>: {(good + bad)[number % 25]}" for number in range(200)), encoding="utf-8"
    )
    (tmp_path / "in" / "plant.lsys").write_text(PLANT, encoding="utf-8")
    (tmp_path / "in" / "picture.png").write_bytes(b"\x89PNG\0\0\0")
    (tmp_path / "in" / "away").symlink_to("/dev/zero")
    target = tmp_path / "wall.html"
    assert main(["wall", str(tmp_path / "in"), "-o", str(target), "--title", "Class <3b>"]) == 0
    assert "203 plants, 42 of which cannot be drawn" in capsys.readouterr().out
    page = target.read_text("utf-8")
    assert page.count("<img ") == 161
    assert page.count('class="mistake"') == 42
    assert "<h1>Class &lt;3b&gt;</h1>" in page
    assert Tags(page).tags.isdisjoint(("script", "iframe", "a", "object", "svg"))
    assert Tags(page).addresses == {"data:"}
    assert "default-src 'none'" in page
    assert "script-src" not in page
    for picture in {*re.findall(r"data:image/svg\+xml;base64,([^\"]*)", page)}:
        check_svg(base64.b64decode(picture).decode())


def test_what_several_hand_in_is_drawn_once(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(
        wall_module, "in_child_processes", lambda work, texts, *_: asked.extend(texts) or [{"picture": text} for text in texts]
    )
    other = link(read(PLANT), {"step": 3})
    given(tmp_path, Ann=LINK, Ben=other, Cem=LINK)
    tiles = wall(tmp_path)
    assert asked == [LINK, other]
    assert [(tile.name, tile.picture) for tile in tiles] == [("Ann", LINK), ("Ben", other), ("Cem", LINK)]


def test_models_that_take_long_share_their_time(tmp_path, monkeypatch):
    given_seconds = []

    def children(work, texts, *_):
        seconds = work.keywords["seconds"]
        given_seconds.append((len(texts), seconds))
        return [{"picture": text} if text == LINK or seconds > int(text) else {} for text in texts]

    monkeypatch.setattr(wall_module, "in_child_processes", children)
    given(tmp_path, Ann=LINK, **{f"Slow{number}": str(number % 2) + " " * number for number in range(10)})
    tiles = wall(tmp_path)
    assert given_seconds == [(11, wall_module.QUICK), (5, 1.6)]
    assert all(tile.picture for tile in tiles)
    for number in range(40):
        (tmp_path / f"Endless{number}.txt").write_text(f"9{number}", encoding="utf-8")
    by_name = {tile.name: tile for tile in wall(tmp_path)}
    assert len(by_name) == 51
    assert given_seconds[2:] == [(51, wall_module.QUICK)]
    assert by_name["Ann"].picture == LINK
    assert (
        by_name["Endless7"].mistake
        == "It takes more than 0.25 seconds to draw; the 45 models here that take long have 8 seconds together."
    )


def test_a_model_that_takes_too_long_is_told_from_one_that_is_too_large():
    growing = link(read("axiom: A(1)\nA(x) -> A(sqrt(x*1.1)+sin(x)) A(x/3+1)"), {"step": 17})
    assert drawn_as(growing, seconds=0.05) == {}
    assert "modules" in drawn_as("axiom: F\nF -> F F F F F F F F F F\nsteps: 40", seconds=0.05)["mistake"]


@pytest.mark.slow
def test_a_page_is_renewed_and_nothing_else_is_lost(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "ann.txt").write_text(PLANT, encoding="utf-8")
    (tmp_path / "other.html").write_text("somebody's own", encoding="utf-8")
    results = [
        main(["wall", str(tmp_path / "in"), "-o", str(tmp_path / name)])
        for name in ("wall.html", "wall.html", "other.html", "wall.txt")
    ]
    assert results == [0, 0, 2, 2]
    assert (tmp_path / "other.html").read_text("utf-8") == "somebody's own"


def test_a_folder_without_files_is_said(tmp_path, capsys):
    assert main(["wall", str(tmp_path), "-o", str(tmp_path / "wall.html")]) == 2
    assert "There are no files" in capsys.readouterr().err
    assert os.listdir(tmp_path) == []


def test_a_page_has_room_for_a_thousand(tmp_path):
    (tmp_path / "links.txt").write_text(f"{LINK}\n" * 1_001, encoding="utf-8")
    with pytest.raises(ModelFileError, match="1,000 plants"):
        wall(tmp_path)
