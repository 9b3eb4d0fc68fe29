"""The list of the house in `.github/CONTRIBUTING.md`, made from the import contracts in `pyproject.toml`.

    python -m tests.house

Each contract lists the files or folders of a room, from the last to the first: an arrow leads from one to what it may import.
A test compares the guide with this list.
"""

from __future__ import annotations

import re
import tomllib
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
    """A line for each room: what stands in it, from the last to the first."""
    return "".join(
        f"- `{room or 'lsys_kit'}`: {' → '.join(f'`{each}`' for each in there)}\n" for room, there in layers().items()
    )


def with_house(guide: str) -> str:
    """The guide with its list renewed."""
    return re.sub(f"{re.escape(BEGIN)}.*?{re.escape(END)}", lambda _: f"{BEGIN}{house()}{END}", guide, flags=re.DOTALL)


if __name__ == "__main__":
    GUIDE.write_text(with_house(GUIDE.read_text("utf-8")), "utf-8", newline="\n")
