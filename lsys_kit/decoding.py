r"""The text of a file: UTF-8, or what says by its first bytes that it is otherwise.

A file may begin with a byte order mark: that of UTF-8 is passed over, those of UTF-16 and UTF-32 say how to read the rest
(Unicode 15.0, section 23.8). A text in an older encoding does not say in which, so that none is guessed; the message shows
what the file would say in Windows-1252, which most of them are in. What is no text at all is called what it is.
"""

from __future__ import annotations

import codecs
from collections.abc import Mapping

from lsys_kit.errors import ModelFileError

_MARKS: Mapping[bytes, str] = {
    codecs.BOM_UTF8: "utf-8",
    codecs.BOM_UTF32_LE: "utf-32-le",
    codecs.BOM_UTF32_BE: "utf-32-be",
    codecs.BOM_UTF16_LE: "utf-16-le",
    codecs.BOM_UTF16_BE: "utf-16-be",
}
"""The byte order marks; that of UTF-32 begins with that of UTF-16, and comes before it."""
_BINARY: Mapping[bytes, str] = {
    b"\x89PNG": "a PNG picture",
    b"GIF8": "a GIF picture",
    b"\xff\xd8\xff": "a JPEG picture",
    b"%PDF-": "a PDF document",
    b"PK\x03\x04": "a ZIP archive, as documents of Word are",
    b"\x1f\x8b": "a gzip archive",
    b"glTF": "a glTF model",
    b"\xd0\xcf\x11\xe0": "a document of an older Word",
    b"\x7fELF": "a program",
    b"MZ\x90": "a program",
}
"""How files begin that are no text."""
_SAVE = "Save it as plain text, in UTF-8."


def decoded(content: bytes, name: str, most: int) -> str:
    r"""The text that the first bytes of a file hold, at most so many; lines end in line feeds.

    Raises
    ------
    ModelFileError
        They hold none.

    Examples
    --------
    >>> decoded("axiom: Ä\r\n".encode("utf-16"), "the file", 100)
    'axiom: Ä\n'
    """
    mark = next((mark for mark in _MARKS if content.startswith(mark)), b"")
    if not mark and len(content) < most:  # what is longer will be refused for that
        _check_bytes(content, name)
    encoding = _MARKS.get(mark, "utf-8")
    decoder = codecs.getincrementaldecoder(encoding)()
    try:
        text = decoder.decode(content[len(mark) :], final=len(content) < most)
    except UnicodeDecodeError as fault:
        raise _invalid(content, name, encoding, len(mark) + fault.start) from None
    return text.replace("\r\n", "\n")


def _check_bytes(content: bytes, name: str) -> None:
    """Refuse what is no text, or does not say how it is encoded."""
    kind = next((kind for beginning, kind in _BINARY.items() if content.startswith(beginning)), None)
    if kind:
        raise ModelFileError(f"{_capital(name)} is {kind}, not a text", hint="A model is plain text, in UTF-8.")
    if b"\0" in content:
        start = content.index(b"\0")
        likely = "as UTF-16 without a byte order mark has" if start < 4 else "as no text has"
        raise ModelFileError(f"{_capital(name)} has zero bytes, {likely}: byte {start + 1} is the first", hint=_SAVE)


def _invalid(content: bytes, name: str, encoding: str, start: int) -> ModelFileError:
    """The error at a byte that is wrong."""
    message = f"{_capital(name)} is not valid {encoding.upper()[:6]} text: byte {start + 1} is wrong"
    if encoding != "utf-8":
        return ModelFileError(message, hint=_SAVE)
    line_start = content.rfind(b"\n", 0, start) + 1
    shown = content[max(line_start, start - 30) : start + 30].split(b"\n")[0].decode("cp1252", errors="replace").strip()
    line = content.count(b"\n", 0, start) + 1
    return ModelFileError(message, hint=f'In Windows-1252 line {line} has "{shown}": if that is right, save the file in UTF-8.')


def _capital(name: str) -> str:
    return name[0].upper() + name[1:]
