"""Write the reference notebooks, `notebooks/reference`, from the kit's own tables; `rebuild` then runs them.

    python -m tests.notebooks.reference

The commands come from the table that the turtles follow, and the notations from the registry. What a table cannot say, an
example for each command and each notation, stands in `examples.toml`. A test compares the stored notebooks with what is built
here, so that a new command or notation must have its example.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Iterator
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from lsys_kit.geometry.turtle.commands import COMMAND_TABLE, COMMANDS, Row
from lsys_kit.notation.formats.reading import FORMATS
from lsys_kit.notation.registry import DIALECTS
from tests.notebooks.rebuild import METADATA, ROOT, rebuilt

FOLDER = ROOT / "notebooks" / "reference"
EXAMPLES = tomllib.loads((Path(__file__).parent / "examples.toml").read_text("utf-8"))
"""For each notation whose it is, and a listing; for each dialect of turtle commands the examples by symbol."""
IMPORT = "from lsys_kit import *"


def built() -> dict[str, NotebookNode]:
    """The reference notebooks by the names of their files, not yet run."""
    return {
        "commands.ipynb": _notebook(_command_cells()),
        "notation.ipynb": _notebook(_notation_cells()),
        "practice.ipynb": _notebook(_cells_of("practice")),
        "formulas.ipynb": _notebook(_cells_of("formulas")),
        "panel.ipynb": _notebook(_cells_of("panel")),
    }


def symbols_of(row: Row) -> dict[str, list[str]]:
    """The symbols of a row for each dialect of turtle commands that has some."""
    return {turtle: list(symbols) for turtle, symbols in row.symbols.items() if symbols}


def example_of(turtle: str, symbol: str) -> tuple[str, str]:
    """The notation and the text of a system that shows a command."""
    found = EXAMPLES["turtles"][turtle]
    word = found["words"][symbol]
    if "\n" in word:
        return found["elsewhere"], word.strip()
    return found["notation"], found["system"].strip().replace("WORD", word)


def _notebook(cells: Iterator[NotebookNode]) -> NotebookNode:
    """Cells with ids that depend on what they say, and on the cells before that say the same."""
    made: dict[str, NotebookNode] = {}
    for cell in cells:
        repeats = sum(other.source == cell.source for other in made.values())
        cell.id = hashlib.sha256(f"{repeats} {cell.source}".encode()).hexdigest()[:16]
        made[cell.id] = cell
    return new_notebook(cells=list(made.values()), metadata=METADATA)


def _command_cells() -> Iterator[NotebookNode]:
    yield new_markdown_cell(EXAMPLES["commands"]["introduction"].strip())
    yield new_code_cell(IMPORT)
    yield new_markdown_cell("## All commands\n\n" + "\n".join(_command_table()))
    yield new_markdown_cell("## Each command with its picture")
    for row in COMMAND_TABLE:
        if row.commands:
            yield new_markdown_cell(f"### {row.words[0].upper()}{row.words[1:]}")
            yield from _pictures(row)
    yield new_markdown_cell(EXAMPLES["commands"]["closing"].strip())


def _command_table() -> Iterator[str]:
    names = [EXAMPLES["turtles"][turtle]["title"] for turtle in COMMANDS]
    yield f"| {' | '.join(names)} | what the turtle does |"
    yield "|---" * (len(names) + 1) + "|"
    for row in COMMAND_TABLE:
        cells = (" ".join(f"`{symbol}`" for symbol in symbols_of(row).get(turtle, ())) for turtle in COMMANDS)
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} | {row.words} |"


def _pictures(row: Row) -> Iterator[NotebookNode]:
    for turtle, symbols in symbols_of(row).items():
        for symbol in symbols:
            notation, text = example_of(turtle, symbol)
            yield new_code_cell(
                f'# {EXAMPLES["turtles"][turtle]["title"]}: {symbol}\ndraw(read({_quoted(text)}, "{notation}"), 0, turtle=True)'
            )


def _notation_cells() -> Iterator[NotebookNode]:
    texts = EXAMPLES["notation"]
    yield new_markdown_cell(texts["introduction"].strip())
    yield new_code_cell(IMPORT)
    yield new_markdown_cell("## The notations\n\n" + "\n".join(_notation_table()))
    for name in DIALECTS:
        example = EXAMPLES["notations"][name]
        yield new_markdown_cell(f"### {name}\n\n{example['whose'][0].upper()}{example['whose'][1:]}.")
        yield new_code_cell(f'derive(read({_quoted(example["listing"].strip())}, "{name}"), {example["steps"]})')
    yield new_markdown_cell(texts["pasting"].strip())
    for name in FORMATS:
        example = EXAMPLES["formats"][name]
        yield new_markdown_cell(f"### Pasted: {name}\n\n{example['whose'][0].upper()}{example['whose'][1:]}.")
        yield new_code_cell(f"found = read({_quoted(example['listing'].strip())})")
        yield new_code_cell('print(found, *found.notes, sep="\\n")')
        yield new_code_cell(f"draw(found, {example['steps']})")
    yield new_markdown_cell(texts["writing"].strip())
    yield new_code_cell(texts["written"].strip())
    yield new_markdown_cell(texts["own"].strip())
    for part in texts["parts"]:
        yield new_markdown_cell(f"### {part['title']}\n\n{part['says'].strip()}")
        yield new_code_cell(part["shows"].strip())
    yield new_markdown_cell(texts["tissues"].strip())
    for part in texts["of_tissues"]:
        yield new_markdown_cell(f"### {part['title']}\n\n{part['says'].strip()}")
        for shown in part["shows"]:
            yield new_code_cell(shown.strip())


def _cells_of(name: str) -> Iterator[NotebookNode]:
    texts = EXAMPLES[name]
    yield new_markdown_cell(texts["introduction"].strip())
    yield new_code_cell(IMPORT)
    for part in texts["parts"]:
        yield new_markdown_cell(f"## {part['title']}\n\n{part['says'].strip()}")
        for shown in part["shows"]:
            yield new_code_cell(shown.strip())


def _notation_table() -> Iterator[str]:
    yield "| notation | whose | a rule |"
    yield "|---|---|---|"
    for name in DIALECTS:
        example = EXAMPLES["notations"][name]
        rules = ", ".join(f"`{rule.replace('|', chr(92) + '|')}`" for rule in example["rules"])
        yield f"| `{name}` | {example['whose']} | {rules} |"


def _quoted(text: str) -> str:
    """A text as Python reads it, with no backslash doubled."""
    quotes = '"""' if "\n" in text or '"' in text else '"'
    return ("r" if "\\" in text else "") + quotes + ("\n" if "\n" in text else "") + text + quotes


def main() -> None:
    """Write the notebooks and run them."""
    FOLDER.mkdir(exist_ok=True)
    for name, notebook in built().items():
        path = FOLDER / name
        if path.exists():
            kept = {cell.id: cell.get("outputs", []) for cell in nbformat.read(path, as_version=4).cells}
            for cell in notebook.cells:
                if cell.cell_type == "code":
                    cell.outputs = kept.get(cell.id, [])
        path.write_text(nbformat.writes(notebook, version=4) + "\n", "utf-8", newline="\n")
        path.write_text(rebuilt(path), "utf-8", newline="\n")


if __name__ == "__main__":
    main()
