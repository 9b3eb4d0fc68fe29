"""The picture of the house in `.github/CONTRIBUTING.md`, made from the import contracts in `pyproject.toml`.

    python -m tests.house

Each contract lists the files or folders of a room, from the last to the first: an arrow leads from one to what it may import.
What stands in one box, separated by bars, knows nothing of its neighbours there. A test compares the guide with this picture.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
GUIDE = ROOT / ".github" / "CONTRIBUTING.md"
BEGIN, END = "<!-- made by: python -m tests.house -->\n", "<!-- end of what is made -->"


def layers() -> dict[str, list[str]]:
    """The layers of each room, from the last to the first; the package is the room ""."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"]
    return {
        container.removeprefix("lsys_kit").removeprefix("."): contract["layers"]
        for contract in contracts
        if contract["type"] == "layers"
        for container in contract["containers"]
    }


def house() -> str:
    """A diagram of the rooms and of what stands in them, and a list of what stands deeper."""
    every = layers()
    deeper = [f"- `{room}`: {' → '.join(f'`{layer}`' for layer in every[room])}" for room in every if "." in room]
    return "\n".join(["```mermaid", "flowchart TB", *_rooms(every), "```", "", "One level deeper:", "", *deeper, ""])


def _rooms(every: dict[str, list[str]]) -> Iterator[str]:
    for room in every[""]:
        if room not in every:
            yield f'    {room}["{room}"]'
            continue
        yield f'    subgraph {room}["{room}/"]'
        names = [f"{room}_{number}" for number in range(len(every[room]))]
        yield from (f'        {name}["{layer}"]' for name, layer in zip(names, every[room], strict=True))
        if len(names) > 1:
            yield f"        {' --> '.join(names)}"
        yield "    end"
    yield f"    {' --> '.join(every[''])}"


def with_house(guide: str) -> str:
    """The guide with its picture renewed."""
    return re.sub(f"{re.escape(BEGIN)}.*?{re.escape(END)}", lambda _: f"{BEGIN}{house()}{END}", guide, flags=re.DOTALL)


if __name__ == "__main__":
    GUIDE.write_text(with_house(GUIDE.read_text("utf-8")), "utf-8", newline="\n")
