"""Meshes as files that other programs open: glTF in one file (.glb), and Wavefront's .obj with its colours in an .mtl.

In both y grows upwards and z towards the viewer. Nothing that a person has typed stands in them: materials have the names of
their colours.

Sources: Khronos Group, glTF 2.0 specification, sections 3.7, 3.9 and 4.4; for .obj and .mtl the appendices B of Wavefront's
Advanced Visualizer manual.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget, check_bytes, counted
from lsys_kit.files import Json
from lsys_kit.geometry.meshes.mesh import Mesh
from lsys_kit.geometry.meshes.solids import Numbers, Singles
from lsys_kit.pictures.rendering.looks import numbered_colours

_FLOAT, _UNSIGNED = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
"""How glTF calls kinds of numbers, and what a part of its bytes is for."""
ROWS_AT_A_TIME, LINE_BYTES = 65_536, 42
"""The number of lines of text that are formatted at a time, and about how long one is."""


class ColouredMesh(NamedTuple):
    """The triangles of one colour, with their own vertices."""

    colour: str
    vertices: Singles
    normals: Singles
    triangles: Numbers


def by_colour(mesh: Mesh, colour_of: Mapping[int, str]) -> Iterator[ColouredMesh]:
    """The parts of a mesh by colour, with y upwards as other programs expect.

    Parameters
    ----------
    mesh
        A mesh in which all vertices of a triangle have the same colour.
    colour_of
        For each state its colour.
    """
    names, colours = numbered_colours(mesh.states, mesh.colours, colour_of)
    first = colours[mesh.triangles[:, 0]]
    renumbered = np.empty(len(colours), np.uint32)
    for number in np.flatnonzero(np.bincount(first)).tolist():
        check_budget()
        ours = np.flatnonzero(colours == number)
        renumbered[ours] = np.arange(len(ours), dtype=np.uint32)
        yield ColouredMesh(
            names[number],
            _upright(mesh.vertices[ours]),
            _upright(mesh.normals[ours]),
            renumbered[mesh.triangles[first == number]],
        )


def _bytes_of(mesh: Mesh) -> int:
    return mesh.vertices.nbytes + mesh.normals.nbytes + mesh.triangles.nbytes


def _check_copies(mesh: Mesh, copies: int) -> None:
    """Refuse a file that takes too much memory while it is written, besides its mesh."""
    check_bytes(_bytes_of(mesh) + mesh.states.nbytes + mesh.colours.nbytes + copies, lambda: "The file was not written")


def _upright(points: Singles) -> Singles:
    """Points with y upwards instead of z; `+ 0` removes negative zeros."""
    turned: Singles = np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1) + np.float32(0)
    return turned


def glb(mesh: Mesh, colour_of: Mapping[int, str]) -> bytes:
    """A mesh as one file of glTF 2.0."""
    tree: dict[str, Json] = {"asset": {"version": "2.0", "generator": "lsys-kit"}}
    lists: dict[str, list[Json]] = {"materials": [], "accessors": [], "bufferViews": []}
    _check_copies(mesh, 3 * _bytes_of(mesh))
    primitives, data = list[Json](), bytearray()
    for number, part in enumerate(by_colour(mesh, colour_of)):
        attributes = {"POSITION": _accessor(lists, data, part.vertices), "NORMAL": _accessor(lists, data, part.normals)}
        primitives.append({"attributes": attributes, "indices": _accessor(lists, data, part.triangles), "material": number})
        lists["materials"].append(_material(part.colour))
    if primitives:  # in glTF no list is empty
        tree |= {
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": primitives}],
            **lists,
            "buffers": [{"byteLength": len(data)}],
        }
    return _packed(json.dumps(tree, separators=(",", ":")).encode(), data)


def _accessor(lists: Mapping[str, list[Json]], data: bytearray, rows: Singles | Numbers) -> int:
    """Append numbers to the buffer; return the index of their accessor."""
    vectors = rows.dtype == np.float32
    check_budget()
    added = rows.astype(rows.dtype.newbyteorder("<"), copy=False).tobytes()
    lists["bufferViews"].append(
        {"buffer": 0, "byteOffset": len(data), "byteLength": len(added), "target": _VERTICES if vectors else _INDICES}
    )
    accessor: dict[str, Json] = {
        "bufferView": len(lists["bufferViews"]) - 1,
        "componentType": _FLOAT if vectors else _UNSIGNED,
        "count": len(rows) if vectors else rows.size,
        "type": "VEC3" if vectors else "SCALAR",
    }
    if vectors:
        accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
    data += added
    lists["accessors"].append(accessor)
    return len(lists["accessors"]) - 1


def _material(colour: str) -> Json:
    factor = [round(_linear(channel), 6) for channel in channels(colour)]
    return {
        "name": colour,
        "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorFactor": [*factor, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8},
    }


def channels(colour: str) -> tuple[float, float, float]:
    """Red, green and blue from 0 to 1.

    >>> channels("#ff0033")
    (1.0, 0.0, 0.2)
    """
    red, green, blue = bytes.fromhex(colour[1:])
    return red / 255, green / 255, blue / 255


def _linear(channel: float) -> float:
    """The linear intensity of a channel of sRGB, from 0 to 1 (IEC 61966-2-1)."""
    return channel / 12.92 if channel <= 0.04045 else ((channel + 0.055) / 1.055) ** 2.4


def _packed(tree: bytes, data: bytearray) -> bytes:
    """The header of a .glb file, its JSON and its binary chunk, each padded to four bytes."""
    tree += b" " * (-len(tree) % 4)
    data += bytes(-len(data) % 4)
    chunks: list[bytes | bytearray] = [struct.pack("<I4s", len(tree), b"JSON"), tree]
    if data:
        chunks += [struct.pack("<I4s", len(data), b"BIN\0"), data]
    return b"".join([struct.pack("<4sII", b"glTF", 2, 12 + sum(map(len, chunks))), *chunks])


def obj(mesh: Mesh, colour_of: Mapping[int, str], library: str) -> bytes:
    """A mesh as text of an .obj file.

    Parameters
    ----------
    mesh, colour_of
        As for `by_colour`.
    library
        The name of the accompanying .mtl file.
    """
    _check_copies(mesh, 2 * LINE_BYTES * (len(mesh.triangles) + 2 * len(mesh.vertices)) + _bytes_of(mesh))
    found, first = [f"# A drawing of lsys-kit\nmtllib {library}\n".encode()], 1
    for part in by_colour(mesh, colour_of):
        found += [
            *_formatted_rows("v %.7g %.7g %.7g\n", part.vertices),
            *_formatted_rows("vn %.7g %.7g %.7g\n", part.normals),
            f"usemtl {_material_name(part.colour)}\n".encode(),
            *_formatted_rows("f %d//%d %d//%d %d//%d\n", part.triangles, repeated=2, added=first),
        ]
        first += len(part.vertices)
    return b"".join(found)


def _formatted_rows(pattern: str, rows: Singles | Numbers, repeated: int = 1, added: int = 0) -> Iterator[bytes]:
    """The lines for some rows, block by block; each number has something added, and stands there several times."""
    for first in counted(range(0, len(rows), ROWS_AT_A_TIME), 1):
        some = np.repeat(rows[first : first + ROWS_AT_A_TIME] + rows.dtype.type(added), repeated, axis=1)
        yield (pattern * len(some) % tuple(some.ravel().tolist())).encode()


def mtl(mesh: Mesh, colour_of: Mapping[int, str]) -> bytes:
    """The colours of a mesh as text of an .mtl file."""
    materials = (
        f"newmtl {_material_name(colour)}\nKd {red:.4f} {green:.4f} {blue:.4f}\nKs 0 0 0\nillum 1\n"
        for colour in dict.fromkeys(part.colour for part in by_colour(mesh, colour_of))
        for red, green, blue in [channels(colour)]
    )
    return "".join(["# Colours of a drawing of lsys-kit\n", *materials]).encode()


def _material_name(colour: str) -> str:
    """The name of a material in an .mtl file: without a number sign, which starts a comment."""
    return f"colour_{colour[1:]}"
