"""The objects of a PDF file, and the file that they make together.

Nothing depends on when or where it is written: the same picture is the same file. Source: ISO 32000-1:2008, Document
management, Portable document format, chapter 7.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Mapping, Sequence

from lsys_kit.files import KIT_MARK

_MASKED = re.compile(r"([\\()])")


class Objects:
    """The objects of a file, numbered from 1 on."""

    def __init__(self) -> None:
        self._contents: list[bytes] = []

    def add(self, content: str | bytes) -> int:
        """Add an object, and return its number."""
        self._contents.append(content.encode("ascii") if isinstance(content, str) else content)
        return len(self._contents)

    def stream(self, data: bytes, entries: Mapping[str, object] | None = None) -> int:
        """Add a stream, compressed, with what stands in its dictionary."""
        packed = zlib.compress(data, 6)
        head = dictionary({"Filter": "/FlateDecode", "Length": len(packed), **(entries or {})})
        return self.add(head.encode("ascii") + b"\nstream\n" + packed + b"\nendstream")

    def file(self, root: int, info: int) -> bytes:
        """The file, given the numbers of its catalogue and of what is said about it."""
        parts, starts = [b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n%" + KIT_MARK + b"\n"], []
        at = len(parts[0])
        for number, content in enumerate(self._contents, 1):
            starts.append(at)
            parts.append(b"%d 0 obj\n%b\nendobj\n" % (number, content))
            at += len(parts[-1])
        many = len(starts) + 1
        rows = b"".join(b"%010d 00000 n \n" % start for start in starts)
        trailer = dictionary({"Size": many, "Root": reference(root), "Info": reference(info)}).encode("ascii")
        parts.append(b"xref\n0 %d\n0000000000 65535 f \n%btrailer\n%b\nstartxref\n%d\n%%%%EOF\n" % (many, rows, trailer, at))
        return b"".join(parts)


def reference(number: int) -> str:
    """What stands for an object in another."""
    return f"{number} 0 R"


def dictionary(entries: Mapping[str, object]) -> str:
    """A dictionary.

    >>> dictionary({"Type": "/Page", "Size": [1, 2]})
    '<</Type /Page /Size [1 2]>>'
    """
    return f"<<{' '.join(f'/{key} {_written(value)}' for key, value in entries.items())}>>"


def _written(value: object) -> str:
    if isinstance(value, Mapping):
        return dictionary(value)
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"[{' '.join(map(_written, value))}]"
    return number_text(value) if isinstance(value, float) else str(value)


def number_text(value: float) -> str:
    """A number, never with an exponent.

    >>> number_text(0.5), number_text(3.0), number_text(1e-9)
    ('0.5', '3', '0')
    """
    return f"{value:.5f}".rstrip("0").rstrip(".").replace("-0", "0", value == 0 or abs(value) < 5e-6)


def string(text: str) -> str:
    """A text about the file: in ASCII where that will do.

    >>> string("F(x)"), string("ω")
    ('(F\\\\(x\\\\))', '<feff03c9>')
    """
    if text.isascii():
        return "(" + _MASKED.sub(r"\\\1", text) + ")"
    return f"<feff{text.encode('utf-16-be').hex()}>"
