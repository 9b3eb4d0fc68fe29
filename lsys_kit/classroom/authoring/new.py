"""A lesson begun: from the template, or as a copy of one of the kit's, in a folder of its own where it runs at once."""

from __future__ import annotations

import json
import os
import re
import tomllib
from collections.abc import Iterator, Mapping
from functools import partial
from importlib.resources import files
from pathlib import Path

from lsys_kit.classroom.exercises.notebooks import renew_exercises
from lsys_kit.classroom.places import NAME, course_of, key_of, kit_place
from lsys_kit.errors import ModelFileError, ModelNameError, ModelValueError, quotable
from lsys_kit.files import Json, create_file, file_errors
from lsys_kit.notation.analysis.checks import suggestion

TEMPLATE = files(__package__) / "template"
"""The parts of a new lesson."""
_LINK = re.compile(
    r"\[([^\[\]\n]{0,500}+)\]"
    r"\(((?:\.\./){0,9}(?:notebooks/|exercises/|teacher/)?([\w./-]{1,200}\.(?:ipynb|md)))(#[^)\s]{0,200}+)?\)"
)
"""A link to another notebook or text, its text, its file and that file's name."""


def write_lesson(name: str, folder: Path | None = None, begin: str | None = None, title: str | None = None) -> Path:
    """Write a lesson into a new folder, and return that.

    name
        What it is called: small letters, digits and underscores.
    folder
        The folder, which must not be there yet, or be empty; by default one of that name.
    begin
        The number or name of a lesson of the kit that is copied; by default the template is.
    title
        Its title; by default made from its name, or that of the lesson that is copied.

    Raises
    ------
    ModelValueError
        It cannot be called so.
    ModelFileError
        The folder is there already, or cannot be written.
    """
    if not NAME.fullmatch(name):
        likely = re.sub("[^a-z0-9]+", "_", name.lower()).strip("_0123456789")[:60]
        hint = f'Try "{likely}".' if NAME.fullmatch(likely) else 'Such as "ferns".'
        raise ModelValueError(f'A lesson cannot be called "{quotable(name)}": small letters, digits and _ alone', hint=hint)
    root = folder or Path(name)
    told = f'The lesson cannot be written to "{quotable(str(root))}"'
    with file_errors(told):
        if os.path.lexists(root) and not (root.is_dir() and not any(root.iterdir())):
            there = str(root)
            raise ModelFileError(f'"{quotable(there)}" already exists', hint="Nothing is overwritten: choose another with -o.")
    contents = dict(_copied(name, begin, title) if begin is not None else _from_template(name, _title_of(name, title)))
    with file_errors(told):
        for each, text in contents.items():
            (root / each).parent.mkdir(parents=True, exist_ok=True)
            create_file(root / each, text.encode())
    renew_exercises(course_of(root))
    return root


def _title_of(name: str, title: str | None) -> str:
    return " ".join((title or name.replace("_", " ").capitalize()).split())


def _from_template(name: str, title: str) -> Iterator[tuple[str, str]]:
    texts = {
        each: (TEMPLATE / each).read_text("utf-8") for each in ("lesson.toml", "exercises.toml", "teacher.md", "notebook.toml")
    }
    texts = {each: text.replace("NAME", name).replace("TITLE", _quoted(title)) for each, text in texts.items()}
    yield f"notebooks/{name}.toml", texts["lesson.toml"]
    yield f"exercises/{name}.toml", texts["exercises.toml"]
    yield f"notebooks/teacher/{name}.md", texts["teacher.md"]
    yield f"notebooks/{name}.ipynb", notebook(tomllib.loads(texts["notebook.toml"])["cells"])


def notebook(cells: list[Mapping[str, str]]) -> str:
    """A notebook of texts and code, as the text of its file."""
    made = [_cell(number, each) for number, each in enumerate(cells, 1)]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    return _json({"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5})


def _cell(number: int, cell: Mapping[str, str]) -> Json:
    kind = "code" if "code" in cell else "markdown"
    source = cell["code" if kind == "code" else "text"].strip("\n").splitlines(keepends=True)
    more: dict[str, Json] = {"outputs": [], "execution_count": None} if kind == "code" else {}
    return {"cell_type": kind, "id": f"part-{number}", "metadata": {}, "source": source, **more}


def _json(content: object) -> str:
    return json.dumps(content, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def _copied(name: str, begin: str, title: str | None) -> Iterator[tuple[str, str]]:
    """The files of a lesson of the kit under another name, and title: what asks for it asks for the copy, links to others are
    texts."""
    kit, wanted = kit_place(), begin.strip().zfill(2) if begin.strip().isdecimal() else begin.strip()
    of = next((each for each in kit.names() if wanted in (each, key_of(each))), "")
    if not of:
        hint = suggestion(begin[:60], kit.names()) or f"Lessons are: {', '.join(kit.names())}."
        raise ModelNameError(f'The kit has no lesson "{quotable(begin)}"', hint=hint)
    key, number = key_of(of), str(int(of[:2]))
    declared = (kit.declared / f"{of}.toml").read_text("utf-8")
    old = str(tomllib.loads(declared)["title"])
    titled = partial(_titled, old=old, new=old if title is None else _title_of(name, title))
    yield f"notebooks/{name}.toml", titled(re.sub(r"(?m)^(number = \d+|points = \[(?:\n    .*)*\n\])\n", "", declared))
    questions = (kit.questions / f"{of}.toml").read_text("utf-8")
    yield f"exercises/{name}.toml", titled(re.sub(rf'"{number}\.(\d+)"', rf'"{name}.\1"', questions))
    page = kit.notebooks / "teacher" / f"{of}.md"
    if page.is_file():
        yield f"notebooks/teacher/{name}.md", titled(_relinked(page.read_text("utf-8"), of, name))
    content = json.loads((kit.notebooks / f"{of}.ipynb").read_text("utf-8"))
    for cell in content["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "code":
            source = re.sub(rf'\b(vote|worksheet)\("{key}"', rf'\1("{name}"', source)
            cell |= {"outputs": [], "execution_count": None}
        else:
            source = titled(_relinked(source, of, name)).replace(f"Lesson {number} · ", "", 1)
        cell["source"] = source.splitlines(keepends=True)
    yield f"notebooks/{name}.ipynb", _json(content)


def _titled(text: str, old: str, new: str) -> str:
    """A text with another title of its lesson, where that is declared or stands as a heading."""
    declared = f'title = "{_quoted(old)}"', f'title = "{_quoted(new)}"'
    return re.sub(
        rf"(?m)^(# (?:For the teacher: )?){re.escape(old)}$", lambda found: found[1] + new, text.replace(*declared, 1)
    )


def _quoted(title: str) -> str:
    """A title as it may stand between quotation marks in a file."""
    return title.replace("\\", "").replace('"', "'")


def _relinked(text: str, of: str, name: str) -> str:
    def changed(found: re.Match[str]) -> str:
        stem = Path(found[3]).stem
        return f"[{found[1]}]({found[2].replace(of, name)}{found[4] or ''})" if stem == of else found[1]

    return _LINK.sub(changed, text)
