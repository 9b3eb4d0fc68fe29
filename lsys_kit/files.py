"""Files that are written whole or not at all, and never over something that the kit did not make; and texts that are read.

A file is first written under a name of its own beside the place where it belongs, and takes its name at one stroke. So a disk
that is full, or an interrupt, leaves the old file as it was, and nothing half written behind. A link is replaced, never
followed.

A text is UTF-8, or says by its first bytes that it is otherwise: a byte order mark of UTF-8 is passed over, those of UTF-16 and
UTF-32 say how to read the rest (Unicode 15.0, section 23.8). A text in an older encoding does not say in which, so that none is
guessed; the message shows what the file would say in Windows-1252, which most of them are in. What is no text at all is called
what it is.
"""

from __future__ import annotations

import codecs
import errno
import os
import re
import secrets
import shutil
import stat
import struct
import tomllib
import zipfile
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from importlib.resources import files
from io import FileIO
from pathlib import Path, PurePosixPath
from typing import Any, TypeAlias

from lsys_kit.errors import ModelFileError, ModelLimitError, ModelValueError, quotable

KIT_MARK = b"lsys-kit"
"""What shows that a file was made by the kit; it is near the beginning or the end of each."""
LONGEST_STEM = 60
"""So much of a title is in the name of a file."""
SEARCHED = 4_096
"""So many bytes at either end of a file may hold the mark."""
_TO_THE_END = os.O_RDWR | os.O_APPEND | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
"""How a file is opened to which lines are added: links are not followed, and nothing is waited for."""


Json: TypeAlias = "Mapping[str, Json] | Sequence[Json] | str | float | None"
"""What JSON can say."""
Entries: TypeAlias = Mapping[str, Any]
"""What a table of TOML or an object of JSON has in it, as it is read."""


def toml_tables(package: str, name: str) -> Entries:
    """What a file of the kit declares that stands in one of its packages.

    >>> sorted(toml_tables("lsys_kit", "commands.toml"))
    ['commands', 'shared']
    """
    return tomllib.loads((files(package) / name).read_text("utf-8"))


def replace_file(path: Path, content: bytes) -> None:
    """Write a file, in place of one that may be there."""
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


@contextmanager
def file_errors(what: str, hint: str | None = None) -> Iterator[None]:
    """A `with` block in which what the system says of a file becomes an error of the kit.

    >>> with file_errors('"plant.txt" cannot be read'):
    ...     open("/no such folder/plant.txt")
    Traceback (most recent call last):
    lsys_kit.errors.ModelFileError: "plant.txt" cannot be read: No such file or directory.
    """
    try:
        yield
    except (OSError, ValueError) as fault:
        raise ModelFileError(f"{what}: {getattr(fault, 'strerror', None) or fault}", hint=hint) from None


def save_file(path: Path, content: bytes) -> None:
    """Write a file, in place of one that the kit itself has made, perhaps; anything else is not replaced.

    Raises
    ------
    ModelFileError
        Something that the kit did not make is there already, or the file cannot be written.
    """
    name = quotable(str(path))
    with file_errors(f'"{name}" cannot be written'):
        if os.path.lexists(path) and not made_by_the_kit(path):
            raise ModelFileError(
                f'"{name}" is there already, and was not made by the kit',
                hint="It would be lost: choose another name, or delete it first.",
            )
        replace_file(path, content)


def append_line(path: Path, line: str, head: str) -> None:
    """Add a line to the end of a text file of the kit, at one stroke; two programs that do so at the same time lose nothing.

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
        _wait_for_others(file)
        if head.encode() not in file.read(len(head) + 3):  # a spreadsheet may have put a mark of three bytes before it
            raise OSError(errno.EINVAL, "it is not a file of the kit")
        file.seek(-1, os.SEEK_END)
        added = (b"" if file.read(1) == b"\n" else b"\n") + line.encode() + b"\n"
        if file.write(added) != len(added):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def _wait_for_others(file: FileIO) -> None:
    """Lock a file until it is closed, where the system can: a line that crosses a block is seen half written otherwise."""
    with suppress(ImportError, OSError):  # neither Windows nor every file system of a network has these locks
        from fcntl import LOCK_EX, flock

        flock(file, LOCK_EX)


def archive_members(path: Path, most: int) -> list[zipfile.ZipInfo]:
    """The plain files of a .zip archive; links and what macOS puts beside them are left out.

    Raises
    ------
    ModelFileError
        It is no archive, or one of its files would lead out of it.
    ModelLimitError
        It has more files than that.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            members = archive.infolist()
    except (zipfile.BadZipFile, NotImplementedError, ValueError) as fault:
        raise ModelFileError(f'"{quotable(path.name)}" is no complete archive: {fault}') from None
    if len(members) > most:
        raise ModelLimitError(f"This archive has more than {most:,} files", limit=most)
    for member in members:
        name = PurePosixPath(member.filename)
        if name.is_absolute() or ".." in name.parts or "\\" in member.filename or ":" in member.filename:
            raise ModelFileError(
                f'"{quotable(path.name)}" has a file outside of it: "{quotable(member.filename)}"',
                hint="Unpack it with care, and read the folder.",
            )
    return [each for each in members if not (each.is_dir() or _is_link(each) or each.filename.startswith("__MACOSX/"))]


def _is_link(member: zipfile.ZipInfo) -> bool:
    return stat.S_ISLNK(member.external_attr >> 16)


def archive_content(path: Path, member: zipfile.ZipInfo, most: int) -> bytes:
    """The first bytes of a file in an archive: no more of it is inflated.

    Raises
    ------
    ValueError
        It is encrypted, packed in an unusual way, or damaged.
    """
    if member.flag_bits & 1 or member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError("it is encrypted, or packed in an unusual way")
    try:
        with zipfile.ZipFile(path) as archive, archive.open(member) as file:
            return file.read(most)
    except (zipfile.BadZipFile, zlib.error, EOFError) as fault:
        raise ValueError(str(fault)) from None


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
    message = f"{_capital(name)} is not valid {encoding.upper()[:6]} text: byte {start + 1} is wrong"
    if encoding != "utf-8":
        return ModelFileError(message, hint=_SAVE)
    line_start = content.rfind(b"\n", 0, start) + 1
    shown = content[max(line_start, start - 30) : start + 30].split(b"\n")[0].decode("cp1252", errors="replace").strip()
    line = content.count(b"\n", 0, start) + 1
    return ModelFileError(message, hint=f'In Windows-1252 line {line} has "{shown}": if that is right, save the file in UTF-8.')


def _capital(name: str) -> str:
    return name[0].upper() + name[1:]
