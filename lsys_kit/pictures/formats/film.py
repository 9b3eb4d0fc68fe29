"""Films: pictures one after another, as an animated GIF or PNG, or as MP4, which the program ffmpeg writes."""

from __future__ import annotations

import io
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lsys_kit.budget import Task, check_budget
from lsys_kit.errors import LSystemError
from lsys_kit.files import marked_gif, marked_mp4, marked_png
from lsys_kit.pictures.formats.files import save_as
from lsys_kit.pictures.formats.notebook import film_bundle

if TYPE_CHECKING:
    from PIL.Image import Image

SECONDS, HELD = 0.6, 4
"""The duration of each step in seconds, and the factor by which the last is shown longer."""
RATE = 25
"""An MP4 film has so many pictures a second at least, many of them the same, because players expect about as many."""
QUALITY = 16
"""How much H.264 may lose, from 0 for nothing to 51."""
WAIT = 120
"""So many seconds ffmpeg may take."""


@dataclass(frozen=True)
class Film:
    """Pictures one after another, such as the steps of a development.

    Attributes
    ----------
    text
        What the film shows, in words.
    images
        The pictures, all of the same size.
    seconds
        The duration of each picture.
    held
        The factor by which the last is shown longer.
    """

    text: str
    images: tuple[Image, ...] = field(repr=False)
    seconds: float = SECONDS
    held: int = HELD

    @cached_property
    def gif(self) -> bytes:
        """The film as a GIF that loops for ever."""
        return self._film("GIF")

    @cached_property
    def apng(self) -> bytes:
        """The film as an animated PNG, whose colours are exact."""
        return self._film("PNG")

    @cached_property
    def mp4(self) -> bytes:
        """The film as MP4 (H.264), for slides and for pages with many films.

        Raises
        ------
        LSystemError
            There is no ffmpeg, or it failed.
        """
        with Task("The film was not written"):
            return mp4_of([*self.images, *[self.images[-1]] * (self.held - 1)], self.seconds)

    def save(self, path: str | Path) -> None:
        """Write the film to a file, in the format given by its extension: .gif, .apng, .png or .mp4.

        Raises
        ------
        ModelFileError
            The extension is unknown, or the file cannot be written.
        LSystemError
            For .mp4 there is no ffmpeg, or it failed.
        """
        save_as(Path(path), {".gif": lambda: marked_gif(self.gif), ".apng": lambda: marked_png(self.apng),
                             ".png": lambda: marked_png(self.apng), ".mp4": lambda: marked_mp4(self.mp4)})

    def _film(self, form: str) -> bytes:
        buffer, step = io.BytesIO(), round(1000 * self.seconds)
        first, *rest = self.images
        first.save(buffer, form, save_all=True, append_images=rest, loop=0, duration=[*[step] * len(rest), self.held * step])
        return buffer.getvalue()

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return film_bundle(self.gif, self._last, self.text)

    def _last(self) -> bytes:
        """The last picture, as PNG."""
        buffer = io.BytesIO()
        self.images[-1].save(buffer, "PNG")
        return buffer.getvalue()

    def __repr__(self) -> str:
        return self.text


def ffmpeg() -> str:
    """The program ffmpeg: that of the library imageio-ffmpeg, else the machine's own.

    Raises
    ------
    LSystemError
        There is none.
    """
    try:
        from imageio_ffmpeg import get_ffmpeg_exe
    except ImportError:
        found = shutil.which("ffmpeg")
    else:
        found = str(get_ffmpeg_exe())
    if found is None:
        raise LSystemError("Films in .mp4 are written by the program ffmpeg, which is not installed",
                           hint="Install it with: pip install 'lsys-kit[film]'; or take .gif or .apng.")
    return found


def mp4_of(images: Sequence[Image], seconds: float) -> bytes:
    """Pictures of the same size as MP4, each shown so long; the same on the same machine.

    H.264 takes even numbers of pixels alone: a row or a column of those in the left upper corner is added.
    """
    (width, height), ground = images[0].size, images[0].convert("RGB").crop((0, 0, 1, 1)).tobytes().hex()
    pace = Fraction(seconds).limit_denominator(1_000)
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "film.mp4"
        command = [ffmpeg(), "-nostdin", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgb24",
                   "-video_size", f"{width}x{height}", "-framerate", f"{pace.denominator}/{pace.numerator}",
                   "-i", str(_raw(images, Path(folder))),
                   "-vf", f"pad=ceil(iw/2)*2:ceil(ih/2)*2:color=0x{ground}", "-r", f"{max(RATE, 1 / seconds):g}",
                   "-c:v", "libx264", "-preset", "medium", "-crf", str(QUALITY), "-pix_fmt", "yuv420p", "-threads", "1",
                   "-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags", "+faststart", str(target)]
        try:
            done = subprocess.run(command, capture_output=True, timeout=WAIT, check=False)  # noqa: S603, no text of a user's
        except (OSError, subprocess.TimeoutExpired) as fault:
            raise LSystemError(f"ffmpeg did not write the film: {fault}", hint="Take .gif or .apng.") from None
        if done.returncode or not target.exists():
            said = done.stderr.decode(errors="replace").strip().splitlines()
            raise LSystemError(f"ffmpeg did not write the film: {said[-1] if said else 'it says nothing'}",
                               hint="Take .gif or .apng.")
        return target.read_bytes()


def _raw(images: Sequence[Image], folder: Path) -> Path:
    """A file with the pixels of pictures one after another."""
    path = folder / "film.rgb"
    with path.open("wb") as file:
        for image in images:
            check_budget()
            file.write(image.convert("RGB").tobytes())
    return path
