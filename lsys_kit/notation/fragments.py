"""Links: a model and its settings in the fragment of an address, behind `#lsys=` (RFC 3986, section 3.5).

A fragment never leaves the machine on which the address is opened: what stands there is read by the page, or by `read`, and by
no server. It is a letter for the version, then in base64url (RFC 4648, section 5) a raw deflate stream (RFC 1951) with three
bytes of its CRC-32 behind it. Inflated, it is a line with the notation and the settings, as in `abop?step=9&lifeTimeA=4`, and
then the model.

A link is a text that anybody may have made: it is inflated up to the limit of a model and no further.
"""

from __future__ import annotations

import base64
import re
import zlib
from collections.abc import Mapping
from typing import NamedTuple
from urllib.parse import parse_qsl, urlencode

from lsys_kit.budget import current
from lsys_kit.errors import ModelLimitError, ModelSyntaxError, named

MARK = "#lsys="
"""How a fragment begins that is a model."""
VERSION = "a"
CHECK_BYTES = 3
LONGEST_HEADING = 4_000
"""So many bytes of notation and settings are read."""
MOST_SETTINGS = 100
_WHOLE = "Copy the whole link again, from its first character to its last."
_NO_DIGIT = re.compile(r"[^A-Za-z0-9_-]")


class LinkContent(NamedTuple):
    """What a link says: the notation of a model, its settings as texts by their names, and its text."""

    notation: str
    settings: Mapping[str, str]
    text: str


def is_link(text: str) -> bool:
    """Whether a text is an address with a model in its fragment; it may be broken into lines behind the mark.

    >>> is_link("https://example.org/#lsys=aS0zKBwA"), is_link("a -> b  # F#lsys=")
    (True, False)
    """
    before, mark, _ = text.strip().partition(MARK)
    return bool(mark) and before == "".join(before.split())


def packed(content: LinkContent) -> str:
    """The fragment, with its mark, that says this.

    Raises
    ------
    ModelLimitError
        It would be longer than what is read.

    Examples
    --------
    >>> unpacked(packed(LinkContent("abop", {"step": "3"}, "axiom: A")))
    LinkContent(notation='abop', settings={'step': '3'}, text='axiom: A')
    """
    asked = f"?{urlencode(content.settings)}" if content.settings else ""
    deflater = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    data = deflater.compress(f"{content.notation}{asked}\n{content.text}".encode()) + deflater.flush()
    fragment = MARK + VERSION + base64.urlsafe_b64encode(data + _check(data)).decode().rstrip("=")
    if len(fragment) > current().text:
        raise ModelLimitError(
            f"The link would have {len(fragment):,} characters; the limit is {current().text:,}",
            limit=current().text,
            needed=len(fragment),
            hint="Give away the model's file instead.",
        )
    return fragment


def unpacked(link: str) -> LinkContent:
    """What a link says.

    Raises
    ------
    ModelSyntaxError
        The link is broken, or of a version that the kit does not know.
    ModelLimitError
        The model is too long.
    """
    before, mark, written = link.partition(MARK)
    _check_digits(link, len(before) + len(mark))
    content = _inflated(_data("".join(written.split())[1:]))
    try:
        heading, _, text = content.decode().partition("\n")
        notation, _, asked = heading.partition("?")
        settings = parse_qsl(asked, strict_parsing=True, max_num_fields=MOST_SETTINGS) if asked else []
    except ValueError:
        raise _broken() from None
    if len(heading) > LONGEST_HEADING or len(dict(settings)) < len(settings):
        raise _broken()
    if len(text) > current().text:
        raise _too_long()
    return LinkContent(notation, dict(settings), text)


def _check_digits(link: str, start: int) -> None:
    """Refuse what is no digit of base64url, and other versions."""
    digits = link[start:].strip()
    if digits and digits[0] != VERSION:
        raise ModelSyntaxError(
            f"This link is of the version {named(digits[0])}; the kit reads the version {VERSION}",
            link,
            start,
            None,
            "It may be broken, or made by a newer version of the kit.",
        )
    for wrong in _NO_DIGIT.finditer(link, start):
        if not wrong.group().isspace():
            raise ModelSyntaxError(
                f"This link is broken: {named(wrong.group())} cannot stand in it", link, wrong.start(), None, _WHOLE
            )


def _data(digits: str) -> bytes:
    """The bytes that the digits stand for, without those of the check."""
    try:
        data = base64.urlsafe_b64decode(digits + "=" * (-len(digits) % 4))
    except ValueError:
        raise _broken() from None
    stream = data[:-CHECK_BYTES]
    if data[-CHECK_BYTES:] != _check(stream) or base64.urlsafe_b64encode(data).decode().rstrip("=") != digits:
        raise _broken()
    return stream


def _inflated(data: bytes) -> bytes:
    """The bytes of a stream; of a bomb no more than a model may have."""
    most = 4 * current().text + LONGEST_HEADING
    inflater = zlib.decompressobj(-zlib.MAX_WBITS)
    try:
        content = inflater.decompress(data, most + 1)
    except zlib.error:
        raise _broken() from None
    if len(content) > most:
        raise _too_long()
    if not inflater.eof or inflater.unused_data:
        raise _broken()
    return content


def _check(data: bytes) -> bytes:
    return zlib.crc32(data).to_bytes(4, "big")[-CHECK_BYTES:]


def _too_long() -> ModelLimitError:
    return ModelLimitError(f"The model in this link has more than {current().text:,} characters", limit=current().text)


def _broken() -> ModelSyntaxError:
    return ModelSyntaxError("This link is broken: it was cut off or changed on its way", hint=_WHOLE)
