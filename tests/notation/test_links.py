"""Links in the readers: broken ones are refused, those of maps are told from those of L-systems."""

from __future__ import annotations

import base64
import zlib

import pytest

from lsys_kit.errors import ModelLimitError, ModelNameError, ModelSyntaxError
from lsys_kit.notation.fragments import LinkContent, _check, packed, unpacked
from lsys_kit.notation.read import cells_notation, read


def crafted(stream: bytes) -> str:
    """A link of a stream, with the right check behind it."""
    return "#lsys=a" + base64.urlsafe_b64encode(stream + _check(stream)).decode().rstrip("=")


def deflated(content: bytes) -> bytes:
    squeezed = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    return squeezed.compress(content) + squeezed.flush()


WHOLE = deflated(b"abop\naxiom: A")


def test_a_crafted_link_is_read_like_any_other() -> None:
    assert read(crafted(WHOLE)) == read("axiom: A")


@pytest.mark.parametrize("stream", [b"\xff\xff\xff", WHOLE[:-2], WHOLE + b"more"], ids=["no stream", "cut", "more behind"])
def test_a_broken_stream_is_a_broken_link(stream: bytes) -> None:
    with pytest.raises(ModelSyntaxError, match="This link is broken"):
        unpacked(crafted(stream))


def test_a_bomb_is_refused() -> None:
    with pytest.raises(ModelLimitError):
        unpacked(crafted(deflated(b"abop\n" + b"A" * 10_000_000)))


def test_the_link_of_a_map_is_that_of_a_map() -> None:
    assert cells_notation(packed(LinkContent("map", {}, "map: ABAB\nA -> B"))) == "map"
    assert not cells_notation(packed(LinkContent("abop", {}, "axiom: A")))


@pytest.mark.parametrize(
    ("line", "kind", "told"),
    [
        ("field: lihgt(1)", ModelNameError, 'I do not know the field "lihgt"'),
        ("field: light(1, 2, 3, 4)", ModelSyntaxError, "takes 0 to 1 values, not 4"),
    ],
)
def test_a_field_that_there_is_not_is_named(line: str, kind: type[Exception], told: str) -> None:
    with pytest.raises(kind, match=told):
        read(f"axiom: A ?E(0)\nA > ?E(x) -> A\n{line}")
