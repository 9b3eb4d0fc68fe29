"""The site as an app, which opens without a network: what browsers read of it, its icons, and the service worker that keeps it.

The service worker knows each file by its hash. When a site is written again, its text is another one, by which a browser sees
that there is something to be fetched.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Iterator, Mapping
from dataclasses import replace

from lsys_kit.classroom.catalogue import system
from lsys_kit.classroom.panel.bundle import Data, compact
from lsys_kit.classroom.panel.document import ICON, MANIFEST
from lsys_kit.classroom.site.pages import INDEX, Answering
from lsys_kit.files import KIT_MARK, marked_png
from lsys_kit.pictures.draw import draw
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.style.themes import LIGHT
from lsys_kit.translation import language

HERE = "./"
"""The way from the first page to the folder of its site."""
WORKER = "service_worker.js"
ICONS = {ICON: 192, "icon-512.png": 512}
"""The icons, and how many pixels they have in each direction."""
FILES = (MANIFEST, WORKER, *ICONS)
"""What lies beside the first page."""
MARGIN = 0.14
"""The part of an icon, on each side, that a system may cut away (Web Application Manifest, "maskable")."""


def app_files(title: str, live: Answering, pages: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files that make pages an app, given their contents by their names on the site.

    >>> from lsys_kit.classroom.site.python import answering
    >>> [*app_files("Ferns", answering(), {})]
    ['manifest.json', 'icon-192.png', 'icon-512.png', 'service_worker.js']
    """
    files = {MANIFEST: _manifest(title), **{name: _icon(pixels) for name, pixels in ICONS.items()}}
    return {**files, WORKER: _service_worker({**pages, **files}, live)}


def _manifest(title: str) -> bytes:
    icons = [
        {"src": name, "sizes": f"{pixels}x{pixels}", "type": "image/png", "purpose": purpose}
        for name, pixels in ICONS.items()
        for purpose in ("any", "maskable")
    ]
    told = {
        "name": title,
        "short_name": title[:12].rstrip() if len(title) > 12 else title,
        "lang": language(),
        "start_url": INDEX,
        "scope": HERE,
        "display": "standalone",
        "background_color": LIGHT.paper,
        "theme_color": LIGHT.paper,
        "icons": icons,
        "generator": KIT_MARK.decode(),
    }
    return json.dumps(told, ensure_ascii=False, indent=1).encode()


def _icon(pixels: int) -> bytes:
    """A plant on paper, as a square."""
    from PIL import Image

    drawn = draw(system("ABOP-1.24c"), 4)
    assert isinstance(drawn, Picture)
    room = round((1 - 2 * MARGIN) * pixels)
    plant = replace(drawn, labels=False, pixels=(room, None)).image().convert("RGB")
    plant.thumbnail((room, room))
    icon = Image.new("RGB", (pixels, pixels), LIGHT.paper)
    icon.paste(plant, tuple((pixels - side) // 2 for side in plant.size))  # type: ignore[arg-type]
    encoded = io.BytesIO()
    icon.save(encoded, "PNG")
    return marked_png(encoded.getvalue())


def _service_worker(files: Mapping[str, bytes], live: Answering) -> bytes:
    site = {
        "pages": {name: hashlib.sha256(files[name]).hexdigest()[:12] for name in sorted(files)},
        "python": [*_of_python(live)],
    }
    told = json.dumps(site, separators=(",", ":"))
    return f"// Made by {KIT_MARK.decode()}.\nglobalThis.SITE = {told};\n{compact('service_worker')}\n".encode()


def _of_python(live: Answering) -> Iterator[Data]:
    """The addresses of Python and the kit, and the hashes of those that come from elsewhere."""
    data = live.data["python"]
    yield {"address": data["worker"]}
    yield from ({"address": each["address"]} for each in (data["kit"], *data["packages"].values()))
    for name, told in data["python"]["files"].items():
        given = {"integrity": told["integrity"]} if "integrity" in told else {}
        yield {"address": f"{data['python']['address']}{name}", **given}


def kept_offline(live: Answering) -> Data:
    """What the first page has to know of Python, which browsers keep as well: one of its files, and how large all are."""
    data = live.data["python"]
    sizes = [each["bytes"] for each in (data["kit"], *data["packages"].values(), *data["python"]["files"].values())]
    return {"home": HERE, "python": {"file": [*_of_python(live)][-1]["address"], "bytes": sum(sizes)}}
