"""What lies beside pages that hold the kit, what such pages may do, and what Python answers there."""

from __future__ import annotations

import io
import json
import os
import re
import subprocess
import sys
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import lsys_kit as kit
from lsys_kit.classroom.authoring.new import write_lesson
from lsys_kit.classroom.exercises import judging, registry
from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.panel.document import inflated_text
from lsys_kit.classroom.places import VARIABLE
from lsys_kit.classroom.site import answers
from lsys_kit.classroom.site.build import build_site
from lsys_kit.classroom.site.pages import CLASS, Answering, notebook_page
from lsys_kit.classroom.site.python import answering, archive
from lsys_kit.derivation.core.traits import traits_of
from tests.classroom.test_site import ENTRIES, ran
from tests.pyodide import TOLD
from tests.test_without_arrays import MISSING

KIT = Path(__file__).resolve().parents[2]
POLICY, DATA = re.compile('Content-Security-Policy" content="([^"]*)"'), re.compile('id="lsys-data">(.*?)</script>')
WIDGETS = "anywidget", "ipywidgets", "IPython", "PIL", "sympy", "tqdm", "networkx", "comm", "psygnal"
"""What Python in a page lacks besides arrays."""
ALGA = {"notation": "abop", "text": "axiom: a\na -> ab\nb -> a"}


@pytest.fixture(scope="module")
def live() -> Answering:
    return answering()


def page(live: Answering | None) -> str:
    return notebook_page(ENTRIES[0], [ran("explore('J4')", kit.explore("J4"))], ENTRIES, live)


def policy(text: str) -> str:
    found = POLICY.search(text)
    assert found
    return found[1]


def data(text: str) -> Any:
    found = DATA.search(text)
    assert found
    return json.loads(found[1])


@pytest.mark.slow
def test_python_of_the_network_is_named_with_the_hash_of_each_of_its_files(live: Answering) -> None:
    python = data(page(live))["python"]["python"]
    assert python == {"address": f"https://cdn.jsdelivr.net/npm/pyodide@{TOLD['version']}/", "files": TOLD["files"]}
    assert all(re.fullmatch("sha384-[A-Za-z0-9+/]{64}", each["integrity"]) for each in python["files"].values())


def test_the_kit_without_pictures_is_small_and_the_same_every_time(live: Answering) -> None:
    content = live.files["python/kit.zip"]
    assert len(content) < 1_500_000
    assert content == answering().files["python/kit.zip"]
    with zipfile.ZipFile(io.BytesIO(content)) as packed:
        names = packed.namelist()
    assert {"lark/LICENSE", "LICENSE"} & {*names} or any("lark" in each and "LICENSE" in each for each in names)
    assert not [each for each in names if each.endswith((".ipynb", ".pyc"))]


@pytest.mark.slow
def test_only_pages_that_hold_the_kit_may_start_a_worker_and_none_asks_another_server(live: Answering) -> None:
    plain, of_class, own = (policy(page(each)) for each in (None, CLASS, live))
    assert "worker-src 'self'" in own
    assert "connect-src" not in own
    assert "connect-src 'self'" in of_class
    assert "worker" not in plain + of_class
    for each in (plain, of_class, own):
        assert "'unsafe-eval'" not in each
        assert "://" not in each
    assert "kit_page" not in inflated_text(data(page(None))["script"]), "a page that does not think has none of it"


def test_a_folder_that_lacks_a_file_of_pyodide_is_refused_and_one_is_copied(tmp_path: Path) -> None:
    for name in TOLD["files"]:
        with pytest.raises(kit.ModelFileError, match="Pyodide") as refused:
            answering(tmp_path)
        assert "npm pack pyodide" in str(refused.value.hint)
        (tmp_path / name).write_bytes(name.encode())
    live = answering(tmp_path)
    told = live.data["python"]["python"]
    assert told["files"] == {name: {"bytes": len(name)} for name in TOLD["files"]}
    assert {f"{told['address']}{name}": name.encode() for name in TOLD["files"]}.items() <= live.files.items()
    assert "://" not in told["address"]


def test_a_site_that_holds_the_kit_is_written_again_and_nothing_else_is_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = write_lesson("ferns", tmp_path / "ferns")
    monkeypatch.setenv(VARIABLE, str(course))
    for path in (course / "notebooks").glob("*.ipynb"):
        path.unlink()
    for name in TOLD["files"]:
        (tmp_path / name).write_bytes(name.encode())
    live, site = answering(tmp_path, course), tmp_path / "site"
    for _ in range(2):
        build_site(site, course, live)
    assert {name: (site / name).read_bytes() for name in live.files} == live.files
    assert 'class="note"' not in (site / "index.html").read_text("utf-8")
    other = next(each for each in live.files if each.endswith(".wasm"))
    (site / other).write_bytes(b"of somebody else")
    with pytest.raises(kit.ModelFileError, match="not made by the kit"):
        build_site(site, course, live)


@pytest.mark.slow
def test_exercises_of_a_course_of_ones_own_are_known_in_its_pages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    course = write_lesson("ferns", tmp_path / "ferns")
    own, question = answering(source=course), {"kind": "check", "id": "ferns.1", "answer": "1"}
    variables = own.data["python"]["variables"]
    with asking(
        own, tmp_path / "kit", {**variables, VARIABLE: variables[VARIABLE].replace("/kit", str(tmp_path / "kit"))}
    ) as ask:
        there = ask(question)
    assert "message" in there
    monkeypatch.setenv(VARIABLE, str(course))
    assert there == here(question)


PROGRAM = """
import importlib.abc, json, sys

class Missing(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {missing!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Missing())
sys.path[0:0] = [sys.argv[1]]
from lsys_kit.classroom.site.answers import answered
for line in sys.stdin:
    print(answered(line), flush=True)
"""


@contextmanager
def asking(live: Answering, folder: Path, variables: Mapping[str, str]) -> Iterator[Callable[[object], Any]]:
    """Asks a process that has of the kit, and of what it needs, what is in the archive beside pages."""
    with zipfile.ZipFile(io.BytesIO(live.files["python/kit.zip"])) as packed:
        packed.extractall(folder)
    command = [sys.executable, "-c", PROGRAM.format(missing={*MISSING, *WIDGETS}), str(folder)]
    pipes = {
        "stdin": subprocess.PIPE,
        "stdout": subprocess.PIPE,
        "text": True,
        "cwd": folder,
        "env": {**os.environ, **variables},
    }
    with subprocess.Popen(command, **pipes) as process:  # type: ignore[call-overload]

        def ask(question: object) -> Any:
            process.stdin.write(json.dumps(question) + "\n")
            process.stdin.flush()
            return json.loads(process.stdout.readline())

        yield ask
        process.stdin.close()


@pytest.fixture(scope="module")
def there(live: Answering, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[object], Any]]:
    with asking(live, tmp_path_factory.mktemp("kit"), live.data["python"]["variables"]) as ask:
        yield ask


def here(question: object) -> Any:
    return json.loads(answers.answered(json.dumps(question)))


@pytest.mark.slow
@pytest.mark.parametrize("id", kit.systems())
def test_panels_are_answered_alike_where_nothing_else_is_installed(there: Any, id: str) -> None:
    """Without widgets and arrays; what needs these is named."""
    system = kit.system(id)
    shown = {"notation": system.notation, "text": str(system), "title": id}
    typed = f"{system}\n"
    for question in (
        {"kind": "open", "panel": {**shown, "step": 2, "mark": "", "seed": 1}},
        {"kind": "rules", "panel": shown, "text": typed},
        {"kind": "rules", "panel": shown, "text": f"{typed}A -> B ->"},
        {"kind": "keep", "what": "link", "panel": shown},
    ):
        found = there(question)
        if "needs" in found:
            assert found["needs"] == "numpy"
            assert traits_of(system).sensitive
            assert "JupyterLab" in found["mistake"]["hint"]
        else:
            assert found == here(question)


@pytest.mark.slow
def test_bombs_and_questions_that_no_page_asks_are_answered_in_words(there: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(registry, "_added", {})  # other tests add exercises of their own
    for question in (
        {"kind": "rules", "panel": ALGA, "text": "axiom: F\nF -> " + 500 * "F " + "\nsteps: 9"},
        {"kind": "rules", "panel": ALGA, "text": 30_000 * "F"},
        {"kind": "rules", "panel": ALGA, "text": "axiom: " + 5_000 * "["},
        {"kind": "book", "panel": ALGA, "constants": {}, "seed": "x"},
        {"kind": "__import__"},
        {"kind": "check", "id": "nowhere", "answer": "1"},
        {"kind": "check", "id": "1.1", "answer": "__import__('os').system('true')"},
        {},
        [],
    ):
        assert there(question) == here(question)


def test_what_a_missing_library_breaks_off_is_looked_for_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Else the misconceptions behind it would be forgotten as long as Python runs."""
    exercise = exercise_of("1.1")
    whole, broken = [*judging._Yields(exercise)], judging._Yields(exercise)
    computed = judging._yielded_by

    def fails(*given: Any) -> Any:
        raise ModuleNotFoundError(name="sympy")

    assert next(iter(broken)) == whole[0]
    monkeypatch.setattr(judging, "_yielded_by", fails)
    with pytest.raises(ModuleNotFoundError):
        list(broken)
    monkeypatch.setattr(judging, "_yielded_by", computed)
    assert [*broken] == whole


def test_an_archive_says_that_the_kit_made_it() -> None:
    assert archive({}).endswith(b"lsys-kit")
