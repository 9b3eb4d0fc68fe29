"""Files that are written whole or not at all, and never over something that the kit did not make.

A file is first written under a name of its own beside the place where it belongs, and takes its name at one stroke. So a disk
that is full, or an interrupt, leaves the old file as it was, and nothing half written behind. A link is replaced, never
followed.
"""

from __future__ import annotations

import errno
import os
import re
import secrets
import shutil
import struct
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from lsys_kit.errors import ModelFileError, ModelValueError, quotable

KIT_MARK = b"lsys-kit"
"""What shows that a file was made by the kit; it is near the beginning or the end of each."""
LONGEST_STEM = 60
"""So much of a title is in the name of a file."""
SEARCHED = 4_096
"""So many bytes at either end of a file may hold the mark."""
_TO_THE_END = os.O_RDWR | os.O_APPEND | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
"""How a file is opened to which lines are added: links are not followed, and nothing is waited for."""


def replace_file(path: Path, content: bytes) -> None:
    """Write a file, in place of one that may be there.

    Raises
    ------
    OSError
        It cannot be written; what was there is as it was.
    """
    with _draft(path, content) as draft:
        if path.is_file() and not path.is_symlink():
            shutil.copymode(path, draft)
        os.replace(draft, path)


def create_file(path: Path, content: bytes) -> None:
    """Write a new file.

    Raises
    ------
    FileExistsError
        Something with this name is there already.
    OSError
        It cannot be written.
    """
    with _draft(path, content) as draft:
        try:
            os.link(draft, path)  # unlike a renaming, this never replaces anything
        except FileExistsError:
            raise
        except OSError:  # a file system without hard links
            if os.path.lexists(path):
                raise FileExistsError(path) from None
            os.rename(draft, path)
        else:
            draft.unlink()


def path_from(given: object) -> Path:
    """The path of a file from what a person gives.

    >>> path_from("plant.png").suffix
    '.png'

    Raises
    ------
    ModelValueError
        It is neither a text nor a path.
    """
    try:
        return Path(given)  # type: ignore[arg-type]
    except TypeError:
        raise ModelValueError(f"The name of a file is needed, not {type(given).__name__}") from None


def file_stem(title: str, kind: str, content: str) -> str:
    """What a file that somebody takes along is called, without its extension: after a title; without one after the kind of its
    content, and a number for that.

    >>> file_stem("K5: a pseudo-plant", "", ""), file_stem("", "L-system", "axiom: F")
    ('K5 a pseudo-plant', 'L-system-d091')
    """
    visible = "".join(character if character.isprintable() else " " for character in title)
    said = " ".join(re.sub(r'[<>:"/\\|?*]', " ", visible).split()).strip(". ")[:LONGEST_STEM]
    return said or f"{kind}-{zlib.crc32(content.encode(errors='replace')) & 0xFFFF:04x}"


def save_file(path: Path, content: bytes) -> None:
    """Write a file, in place of one that the kit itself has made, perhaps; anything else is not replaced.

    Raises
    ------
    ModelFileError
        Something that the kit did not make is there already, or the file cannot be written.
    """
    name = quotable(str(path))
    try:
        if os.path.lexists(path) and not made_by_the_kit(path):
            raise ModelFileError(
                f'"{name}" is there already, and was not made by the kit',
                hint="It would be lost: choose another name, or delete it first.",
            )
        replace_file(path, content)
    except (OSError, ValueError) as fault:
        raise ModelFileError(f'"{name}" cannot be written: {getattr(fault, "strerror", None) or fault}') from None


def append_line(path: Path, line: str, head: str) -> None:
    """Add a line to the end of a text file of the kit, at one stroke; two programs that do so at the same time lose nothing.

    Parameters
    ----------
    path
        The file; where none is there it is made.
    line
        The line, without its end.
    head
        The first line of the file, which shows that it is the kit's.

    Raises
    ------
    OSError
        It is no file of the kit, or cannot be written to; what was there is as it was.
    """
    if not os.path.lexists(path):
        with suppress(FileExistsError):
            create_file(path, f"{head}\n".encode())
    if path.is_symlink() or not path.is_file():
        raise OSError(errno.EINVAL, "it is no file")
    with open(os.open(path, _TO_THE_END), "r+b", buffering=0) as file:
        if head.encode() not in file.read(len(head) + 3):  # a spreadsheet may have put a mark of three bytes before it
            raise OSError(errno.EINVAL, "it is not a file of the kit")
        file.seek(-1, os.SEEK_END)
        added = (b"" if file.read(1) == b"\n" else b"\n") + line.encode() + b"\n"
        if file.write(added) != len(added):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def made_by_the_kit(path: Path) -> bool:
    """Whether a file, not a link, carries the kit's mark."""
    if path.is_symlink() or not path.is_file():
        return False
    with path.open("rb") as file:
        beginning = file.read(SEARCHED)
        file.seek(max(0, path.stat().st_size - SEARCHED))
        return KIT_MARK in beginning or KIT_MARK in file.read(SEARCHED)


def marked_xml(text: str) -> bytes:
    """An SVG picture or a PNML net as a file of the kit: with a processing instruction at its end (XML 1.0, 2.6).

    >>> marked_xml("<svg/>")
    b'<svg/>\\n<?lsys-kit?>\\n'
    """
    return text.encode() + b"\n<?" + KIT_MARK + b"?>\n"


def marked_png(image: bytes, dpi: float | None = None) -> bytes:
    """A PNG picture, animated or not, as a file of the kit: with a text chunk behind its header, and perhaps with the dots of
    an inch (PNG specification, 11.3.4 and 11.3.5)."""
    metre = 0 if dpi is None else round(dpi / 0.0254)
    size = b"" if dpi is None else _chunk(b"pHYs" + struct.pack(">IIB", metre, metre, 1))
    return image[:33] + _chunk(b"tEXtSoftware\0" + KIT_MARK) + size + image[33:]


def _chunk(content: bytes) -> bytes:
    """A chunk of a PNG picture, given its type and its data."""
    return struct.pack(">I", len(content) - 4) + content + struct.pack(">I", zlib.crc32(content))


def marked_gif(image: bytes) -> bytes:
    """A GIF picture as a file of the kit: with a comment behind its colours (GIF 89a, section 24)."""
    colours = 3 * 2 ** ((image[10] & 7) + 1) if image[10] & 128 else 0
    comment = b"!\xfe" + bytes([len(KIT_MARK)]) + KIT_MARK + b"\0"
    return image[: 13 + colours] + comment + image[13 + colours :]


def marked_mp4(film: bytes) -> bytes:
    """An MP4 film as a file of the kit: with a box at its end that players pass over (ISO/IEC 14496-12, 8.1.2)."""
    return film + struct.pack(">I", 8 + len(KIT_MARK)) + b"free" + KIT_MARK


@contextmanager
def _draft(path: Path, content: bytes) -> Iterator[Path]:
    """A file with the content under a name of its own, which is gone at the end, whatever happens."""
    draft = path.with_name(f".{path.name[:100]}.{secrets.token_hex(4)}")
    try:
        with draft.open("xb") as file:
            file.write(content)
        yield draft
    finally:
        with suppress(OSError):
            draft.unlink(missing_ok=True)
