"""Films: pictures one after another, as an animated GIF or PNG, or as MP4, which the program ffmpeg writes."""

from __future__ import annotations

import io
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lsys_kit.budget import Task, counted
from lsys_kit.errors import LSystemError
from lsys_kit.files import marked_gif, marked_mp4, marked_png, path_from
from lsys_kit.pictures.formats.files import save_as
from lsys_kit.pictures.formats.notebook import film_bundle

if TYPE_CHECKING:
    from PIL.Image import Image

SECONDS, HELD = 0.6, 4
"""The duration of each step in seconds, and the factor by which the last is shown longer."""
RATE = 25
"""An MP4 film has so many pictures a second at least, many of them the same, because players expect about as many."""
SETTINGS = (
    "-preset",
    "medium",
    "-crf",
    "16",
    "-threads",
    "1",
    "-fflags",
    "+bitexact",
    "-flags:v",
    "+bitexact",
    "-movflags",
    "+faststart",
)
"""What ffmpeg is told besides: to lose hardly anything, to write the same every time, and to let a page play the beginning
while the rest is loaded."""


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
        save_as(
            path_from(path),
            {
                ".gif": lambda: marked_gif(self.gif),
                ".apng": lambda: marked_png(self.apng),
                ".png": lambda: marked_png(self.apng),
                ".mp4": lambda: marked_mp4(self.mp4),
            },
        )

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


def mp4_of(images: Sequence[Image], seconds: float) -> bytes:
    """Pictures of the same size as MP4, each shown so long; the same on the same machine.

    Raises
    ------
    LSystemError
        There is no ffmpeg, or it failed.
    """
    try:
        from imageio_ffmpeg import get_ffmpeg_exe, write_frames

        get_ffmpeg_exe()
    except (ImportError, RuntimeError):
        raise LSystemError(
            "Films in .mp4 are written by the program ffmpeg, which is not installed",
            hint="Install it with: pip install 'lsys-kit[film]'; or take .gif or .apng.",
        ) from None
    even = [_even(image) for image in images]
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "film.mp4"
        writer = write_frames(
            str(target),
            even[0].size,
            fps=1 / Fraction(seconds).limit_denominator(1_000),
            codec="libx264",
            quality=None,
            macro_block_size=1,
            ffmpeg_log_level="fatal",
            output_params=[*SETTINGS, "-r", f"{max(RATE, 1 / seconds):g}"],
        )
        try:
            writer.send(None)
            for image in counted(even, 1):
                writer.send(image.tobytes())
            writer.close()
            return target.read_bytes()
        except OSError:
            raise LSystemError("ffmpeg did not write the film", hint="Take .gif or .apng.") from None


def _even(image: Image) -> Image:
    """An image with even numbers of pixels across and down, as H.264 wants it: pixels like those of its corner may be added."""
    from PIL import Image

    paper = Image.new(
        "RGB", (image.width + image.width % 2, image.height + image.height % 2), image.convert("RGB").getpixel((0, 0))
    )
    paper.paste(image)
    return paper
