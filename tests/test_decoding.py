"""Files are read as what their first bytes say that they are; anything else is refused with a reason."""

from __future__ import annotations

import codecs
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.errors import LSystemError, ModelFileError
from lsys_kit.files import decoded
from lsys_kit.notation.read import read

MOST = 10_000
MARKED = {
    "utf-8-sig": b"",
    "utf-16-le": codecs.BOM_UTF16_LE,
    "utf-16-be": codecs.BOM_UTF16_BE,
    "utf-32-le": codecs.BOM_UTF32_LE,
    "utf-32-be": codecs.BOM_UTF32_BE,
}
TEXTS = st.text(st.characters(blacklist_categories=["Cs"], blacklist_characters="\0\r\ufeff"), max_size=60)
"""Texts that are no other file by their first letters."""
KINDS = {
    "PNG": b"\x89PNG\r\n\x1a\n",
    "GIF": b"GIF89a",
    "JPEG": b"\xff\xd8\xff\xe0",
    "PDF": b"%PDF-1.7\n",
    "ZIP": b"PK\x03\x04\x14",
    "gzip": b"\x1f\x8b\x08",
    "older Word": b"\xd0\xcf\x11\xe0\xa1",
    "glTF": b"glTF\x02\0\0\0",
    "program": b"\x7fELF\x02",
}


@given(TEXTS, st.sampled_from([*MARKED, "utf-8"]))
def test_a_text_is_the_same_in_each_encoding_that_its_mark_tells(text: str, encoding: str) -> None:
    plain = f"axiom: {text}"
    assert decoded(MARKED.get(encoding, b"") + plain.encode(encoding), "it", MOST) == plain


@given(st.binary(max_size=60))
def test_any_bytes_are_a_text_or_an_explained_mistake(content: bytes) -> None:
    found = ""
    with suppress(ModelFileError):
        found = decoded(content, "it", MOST)
    assert "\r\n" not in found


@given(TEXTS.filter(bool), st.sampled_from(list(MARKED)), st.integers(0, 3))
def test_a_text_that_is_cut_off_within_a_character_is_read_up_to_there(text: str, encoding: str, cut: int) -> None:
    content = MARKED[encoding] + text.encode(encoding)
    content = content[: max(4, len(content) - cut)]
    assert text.startswith(decoded(content, "it", len(content)))


@pytest.mark.parametrize(("kind", "content"), KINDS.items())
def test_what_is_no_text_is_called_what_it_is(kind: str, content: bytes) -> None:
    with pytest.raises(ModelFileError, match=f"^The file is an? [A-Za-z ]*{kind}.*, not a text") as found:
        decoded(content, "the file", MOST)
    assert found.value.hint == "A model is plain text, in UTF-8."


@pytest.mark.parametrize(
    ("content", "message", "hint"),
    [
        (
            b"axiom: A\nangle: 30\xb0\n",
            "The file is not valid UTF-8 text: byte 19 is wrong",
            'In Windows-1252 line 2 has "angle: 30°": if that is right, save the file in UTF-8.',
        ),
        (
            b"/* B\xe4ume */ axiom: A",
            "The file is not valid UTF-8 text: byte 5 is wrong",
            'In Windows-1252 line 1 has "/* Bäume */ axiom: A": if that is right, save the file in UTF-8.',
        ),
        (
            b"\xef\xbb\xbfaxiom: \xff",
            "The file is not valid UTF-8 text: byte 11 is wrong",
            'In Windows-1252 line 1 has "ï»¿axiom: ÿ": if that is right, save the file in UTF-8.',
        ),
        (b"\xff\xfea\x00b", "The file is not valid UTF-16 text: byte 5 is wrong", "Save it as plain text, in UTF-8."),
        (
            "axiom: A".encode("utf-16-be"),
            "The file has zero bytes, as UTF-16 without a byte order mark has: byte 1 is the first",
            "Save it as plain text, in UTF-8.",
        ),
        (b"axiom: A\0", "The file has zero bytes, as no text has: byte 9 is the first", "Save it as plain text, in UTF-8."),
    ],
)
def test_a_text_in_another_encoding_is_not_guessed(content: bytes, message: str, hint: str) -> None:
    with pytest.raises(ModelFileError) as found:
        decoded(content, "the file", MOST)
    assert (found.value.message, found.value.hint) == (message, hint)


@pytest.mark.parametrize("text", ["axiom: A\nA -> A B", "Angle 6\nAxiom F\nF=F+F", "* # F a,\na # F", "Axiom: F\nF --> FF"])
def test_a_mark_that_an_editor_put_before_a_text_says_nothing(text: str) -> None:
    assert read(f"\ufeff{text}") == read(text)
    with pytest.raises(LSystemError) as found:
        read(f"\ufeff{text}\n(", "abop")
    assert not (found.value.source or "").startswith("\ufeff")
