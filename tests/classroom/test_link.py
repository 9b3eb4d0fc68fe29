"""Links: a model and its settings go into an address and come back the same; anything else is refused, never run."""

from __future__ import annotations

import base64
import json
import tracemalloc
import zlib
from fractions import Fraction
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import explore, limits, link, linked, map_system, map_systems, read, read_map, system, systems, write
from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.fragments import CHECK_BYTES, MARK, VERSION, LinkContent, is_link, packed, unpacked
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.registry import DIALECTS
from tests.derivation.random_maps import map_systems as random_maps
from tests.notation.foreign_systems import Systems
from tests.plants import plant
from tests.test_hostile_names import HOSTILE, made, refused

BASE = "https://example.org/panel.html"
SETTINGS = {"step": 9, "angle": Fraction(257, 10), "seed": -3}
ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"


def forged(content: bytes, tail: bytes = b"") -> str:
    """A link with any content, whose check is right."""
    deflater = zlib.compressobj(9, zlib.DEFLATED, -15)
    data = deflater.compress(content) + deflater.flush() + tail
    check = zlib.crc32(data).to_bytes(4, "big")[-CHECK_BYTES:]
    return f"{BASE}{MARK}{VERSION}{base64.urlsafe_b64encode(data + check).decode().rstrip('=')}"


def parts(found: LSystem) -> tuple[object, ...]:
    """Everything that a system says, with what equality ignores."""
    return found, found.notation, found.cells, found.widths, found.alphabet


@pytest.mark.parametrize("id", systems())
def test_a_system_of_the_catalogue_comes_back(id: str) -> None:
    address = link(system(id), SETTINGS, BASE)
    assert address.startswith(BASE + MARK)
    assert parts(read(address)) == parts(system(id))
    assert linked(address).settings == SETTINGS
    most = 700 if id in ("K22", "K23", "K25") else 480  # a QR code of such a length is read from the last row of a classroom
    assert len(link(system(id))) <= most


@pytest.mark.parametrize("id", map_systems())
def test_a_map_system_of_the_catalogue_comes_back(id: str) -> None:
    address = link(map_system(id), {"step": 2}, BASE)
    assert read_map(address) == linked(address).system == map_system(id)
    assert linked(address).settings == {"step": 2}


@given(random_maps())
def test_any_map_system_comes_back(found) -> None:
    assert read_map(link(found)) == found


@pytest.mark.slow
@given(st.randoms(use_true_random=False), st.sampled_from([*DIALECTS]))
def test_what_a_notation_can_write_comes_back(random: Random, notation: str) -> None:
    found = Systems(random).system()
    try:
        again = read(write(found, notation), notation)
    except LSystemError:
        return
    constants = {constant.name: Fraction(random.randrange(-50, 50), random.choice((1, 3, 10))) for constant in again.constants}
    chosen = {"step": random.randrange(100), "angle": Fraction(7, 3)} | constants | {"seed": random.randrange(9)}
    chosen["step"] = abs(int(chosen["step"]))
    address = link(again, chosen)
    assert parts(read(address)) == parts(again)
    assert linked(address).settings == chosen


@pytest.mark.parametrize("notation", DIALECTS)
def test_each_notation_keeps_its_name(notation: str) -> None:
    found = read(write(plant(notation), notation), notation)
    assert read(link(found)).notation == notation
    assert str(read(link(found))) == str(found)


def test_constants_are_exact() -> None:
    address = link(system("P5"), {"dt": 1.4})
    assert linked(address).settings == {"dt": Fraction(7, 5)}


def test_an_address_may_stand_before_it_and_line_breaks_within() -> None:
    address = link(system("J4"), {"step": 9})
    long = f"\n  https://example.org/a?b=c&d#{address.removeprefix('#')}"
    assert not is_link("https://example.org/a?b=c&d")
    wrapped = f"{BASE}{address[:40]}\n{address[40:80]}\r\n  {address[80:]}\n"
    assert read(wrapped) == system("J4")
    assert linked(long.replace("#lsys", "?x#lsys", 1)).settings == {"step": 9}


def test_a_model_is_no_link() -> None:
    for text in ("axiom: A\nA -> A /* https://example.org/#lsys=aAAAA */", "* # F a,\nF#FF,"):
        assert not is_link(text)
        assert read(text)


@pytest.mark.parametrize(
    ("settings", "kind", "words"),
    [
        ({"lifetimeA": 3}, ModelNameError, "lifeTimeA"),
        ({"step": -1}, ModelValueError, "whole number from 0 on"),
        ({"step": Fraction(1, 2)}, ModelValueError, "whole number"),
        ({"seed": "1/2"}, ModelValueError, "whole number"),
        ({"angle": "x"}, LSystemError, "x"),
        ({"lifeTimeA": "lifeTimeA"}, ModelValueError, "known"),
        ({"lifeTimeA": None}, ModelValueError, "number"),
        ({"angle": float("nan")}, ModelValueError, "number"),
        ({"step": 10**5000}, ModelValueError, "thousands of digits"),
        ({"letters": "lifeTimeC"}, ModelNameError, "declares no constant"),
        ({"letters": 3}, ModelValueError, "A letter or a list of letters"),
        ([("step", 1)], ModelValueError, "mapping of settings"),
    ],
)
def test_settings_that_a_model_has_not_are_refused(settings, kind, words) -> None:
    with pytest.raises(kind, match=words):
        link(system("J4"), settings)


@given(st.lists(st.sampled_from(["lifeTimeA", "lifeTimeB"])))
def test_a_letter_stays_a_letter(letters: list[str]) -> None:
    """In the order in which they are declared, whatever else the link says."""
    there = linked(link(system("J4"), {"lifeTimeB": 5, "letters": letters}))
    named = tuple(name for name in ("lifeTimeA", "lifeTimeB") if name in letters)
    assert there.settings == {"lifeTimeB": 5} | ({"letters": named} if named else {})
    assert (f"letters = {','.join(named)}" in repr(there)) == bool(named)


def test_a_panel_with_a_letter_is_sent_as_it_is() -> None:
    panel = explore("J4", 4, letters="lifeTimeA")
    again = explore(panel.link)
    assert again.letters == ["lifeTimeA"]
    assert again.link == panel.link
    assert "letters" not in linked(explore("J4", 4).link).settings
    assert explore(panel.link, letters="lifeTimeB").letters == ["lifeTimeB"]
    assert "image/png" in linked(panel.link)._repr_mimebundle_()


@pytest.mark.parametrize("base", ["my page.html", "a\n", "\u202e", "\ud800"])
def test_an_address_with_blanks_would_not_be_read(base: str) -> None:
    with pytest.raises(ModelValueError, match="no blanks"):
        link(system("J1"), base=base)


def test_what_is_no_system_has_no_link() -> None:
    with pytest.raises(ModelValueError, match="needed, not str"):
        link("J4")


def test_a_link_names_its_notation_itself() -> None:
    address = link(system("K5"))
    assert read(address, system("K5").notation) == system("K5")
    for choice in ({"notation": "cpfg"}, {"name": "x"}):
        with pytest.raises(ModelValueError, match="Leave out"):
            read(address, **choice)
    with pytest.raises(ModelValueError, match="read_map"):
        read(link(map_system("K28")))
    with pytest.raises(ModelValueError, match="read\\(link\\)"):
        read_map(address)


# --- broken links ---------------------------------------------------------------------------------------------------------


def test_a_link_that_was_cut_off_is_refused_wherever_it_was_cut() -> None:
    address = link(system("J4"), {"step": 9}, BASE)
    for end in range(len(BASE) + len(MARK), len(address)):
        with pytest.raises(ModelSyntaxError, match="broken"):
            read(address[:end])


def test_a_link_in_which_a_character_was_changed_is_refused() -> None:
    address, random = link(system("K12"), {"step": 4}), Random(1)
    for at in range(len(MARK), len(address)):
        other = random.choice(ALPHABET.replace(address[at], ""))
        with pytest.raises(ModelSyntaxError, match="This link is"):
            read(address[:at] + other + address[at + 1 :])


def test_two_links_are_never_read_as_one() -> None:
    one, other = link(system("J1")), link(system("J2"))
    for text in (one + other, one + other.removeprefix(MARK), one + "A", one + "."):
        with pytest.raises(ModelSyntaxError, match="broken"):
            read(text)


def test_an_error_says_where_and_what_to_try() -> None:
    address = link(system("J1"))
    with pytest.raises(ModelSyntaxError) as caught:
        read(f"<{address}>")
    assert caught.value.column == len(address) + 2
    assert 'broken: ">" cannot stand in it' in str(caught.value)
    assert "Copy the whole link again" in str(caught.value)


def test_a_link_of_another_version_is_named() -> None:
    with pytest.raises(ModelSyntaxError, match=r"version \"b\".*newer version of the kit"):
        read(link(system("J1")).replace(f"{MARK}{VERSION}", f"{MARK}b"))


@given(st.binary(max_size=300), st.binary(max_size=5))
def test_any_content_with_a_right_check_is_read_or_refused(content: bytes, tail: bytes) -> None:
    for text in (forged(content, tail), forged(b"abop\naxiom: " + content)):
        refused(lambda text=text: linked(text))


@pytest.mark.slow
@given(st.text(max_size=60), st.dictionaries(st.text(max_size=9), st.text(max_size=9), max_size=5), st.text(max_size=60))
def test_any_heading_is_read_or_refused(notation: str, settings: dict[str, str], text: str) -> None:
    for content in (LinkContent(notation, settings, text), LinkContent("abop", settings, "step = 1\naxiom: A(step)")):
        refused(lambda content=content: linked(packed(content)))


@pytest.mark.parametrize(
    "heading",
    [
        "abop?",
        "abop?step",
        "abop?step=1&step=2",
        "abop?step=1e999",
        "abop?step=9^9^9^9",
        "abop?angle=" + "9" * 5_000,
        "nothing",
        "abop?" + "&".join(f"a{n}=1" for n in range(200)),
        "abop?__class__=1",
        "abop?step=__import__('os')",
        "?",
        "",
        "map",
        "\0",
    ],
)
def test_a_heading_that_no_link_has_is_refused(heading: str) -> None:
    if heading == "abop?":
        assert linked(forged(b"abop?\naxiom: A")).settings == {}
        return
    with pytest.raises(LSystemError):
        linked(forged(f"{heading}\naxiom: A".encode()))


@pytest.mark.slow
def test_a_bomb_is_refused_in_little_memory() -> None:
    bomb = forged(b"abop\naxiom: " + b"A" * 200_000_000)
    assert len(bomb) < 300_000
    tracemalloc.start()
    try:
        with pytest.raises(ModelLimitError, match="more than 1,000,000 characters"):
            read(bomb)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 20_000_000


def test_a_model_in_a_link_has_the_limits_of_a_model() -> None:
    with limits(text=1_000), pytest.raises(ModelLimitError, match="more than 1,000 characters"):
        read(forged(b"abop\naxiom: " + b"A" * 2_000))
    with limits(text=20), pytest.raises(ModelLimitError, match="The link would have"):
        link(read("axiom: A B"))


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_a_link_with_hostile_names_is_refused(text: str) -> None:
    for attempt in (
        lambda: read(link(made(text))),
        lambda: linked(link(system("J4"), {text: 1})),
        lambda: linked(text),
        lambda: linked(link(system("J4"), {"step": text})),
        lambda: read(MARK + VERSION + text),
        lambda: linked(forged(f"abop?{text}\naxiom: A".encode(errors="replace"))),
        lambda: linked(forged(f"{text}\n{text}".encode(errors="replace"))),
    ):
        assert refused(attempt) is None


def test_a_link_holds_no_more_than_the_model() -> None:
    assert json.dumps(unpacked(link(system("J1")))) == json.dumps(LinkContent("abop", {}, write(system("J1"))))
