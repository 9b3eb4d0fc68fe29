"""The commands about the course: its exercises, its pages, and a copy to work in."""

from __future__ import annotations

import argparse
import importlib.util
from pathlib import Path

from lsys_kit.errors import LSystemError, ModelFileError, quotable


def check_exercises(options: argparse.Namespace) -> None:
    """Print what is wrong with the exercises in a folder."""
    from lsys_kit.classroom.exercises.declarations import QUESTIONS
    from lsys_kit.classroom.exercises.lint import problems_in

    problems = problems_in(options.folder or QUESTIONS)
    for problem in problems:
        print(problem)
    if problems:
        raise ModelFileError(
            f"{len(problems)} mistake{'s' * (len(problems) > 1)} in the exercises",
            hint="Each line above says where one is and what to try.",
        )
    print("No mistakes.")


def write_exercises(options: argparse.Namespace) -> None:
    """Write the notebooks of the exercises in a folder."""
    from lsys_kit.classroom.exercises.notebooks import write_notebooks

    for path in write_notebooks(options.output, options.folder):
        print(path)


def write_package(options: argparse.Namespace) -> None:
    """Write exercises as a package for a learning platform."""
    from lsys_kit.classroom.scorm import package

    for line in package.report(*package.write_package(options.what_exercises, options.output)):
        print(line)


def write_site(options: argparse.Namespace) -> None:
    """Write the course as static pages."""
    from lsys_kit.classroom.site.build import build_site

    pages = build_site(options.output)
    print(f"{len(pages)} pages are written. Open {quotable(str(pages[0]))} in a browser.")


def open_lab(options: argparse.Namespace) -> None:
    """Copy the course and open it in JupyterLab."""
    from lsys_kit.classroom.course import FOLDER, copy_course, copy_report

    folder = Path(options.folder or FOLDER)
    copied = copy_course(folder)
    print(copy_report(folder, copied), flush=True)
    if importlib.util.find_spec("jupyterlab") is None:
        raise LSystemError("JupyterLab is not installed", hint="Install it with: pip install 'lsys-kit[lab]'")
    from jupyterlab.labapp import LabApp

    # In a container everybody is root; the server answers this machine alone, and asks for its token.
    LabApp.launch_instance(
        [
            "--ServerApp.allow_root=True",
            f"--ServerApp.root_dir={folder.resolve()}",
            f"--LabApp.default_url=/lab/tree/{copied[0].name}",
        ]
    )
