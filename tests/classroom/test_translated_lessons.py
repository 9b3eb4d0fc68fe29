"""Translations of lessons: a file for translators and back, and the kit's lessons in German."""

from __future__ import annotations

import ast
import io
import json
import os
import re
import shutil
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from babel.messages.catalog import Catalog
from babel.messages.pofile import read_po, write_po
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelFileError, ModelNameError, ModelValueError, check, vote
from lsys_kit.__main__ import main
from lsys_kit.classroom.authoring.check import CHECKS
from lsys_kit.classroom.authoring.new import write_lesson
from lsys_kit.classroom.authoring.texts import LESSON, fixed_parts, has_words, recode, redeclared, retext
from lsys_kit.classroom.authoring.translating import Source, renewed, translate, translation
from lsys_kit.classroom.authoring.unpack import unpack
from lsys_kit.classroom.authoring.written import Written
from lsys_kit.classroom.course import copy_course, course_files
from lsys_kit.classroom.exercises import registry
from lsys_kit.classroom.exercises.notebooks import renew_exercises
from lsys_kit.classroom.lessons.lesson import lesson
from lsys_kit.classroom.live import questions
from lsys_kit.classroom.places import IN_LANGUAGE, VARIABLE, Place, choose_course, course_of, kit_place, translation_place
from lsys_kit.classroom.site.build import read_notebook, run_through
from lsys_kit.classroom.site.contents import index_page
from lsys_kit.classroom.site.markdown import markdown_html
from lsys_kit.classroom.site.pages import Entry
from lsys_kit.classroom.site.requests import notes
from lsys_kit.translation import ENGLISH, language, languages, spoken
from lsys_kit.translation import VARIABLE as SPOKEN

GERMAN = translation_place(kit_place(), "de")


@pytest.fixture(autouse=True)
def nothing_chosen(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A test chooses its course and language for itself alone."""
    for name in (VARIABLE, IN_LANGUAGE, SPOKEN):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(registry, "_added", {})
    with spoken(ENGLISH):
        yield
    for name in (VARIABLE, IN_LANGUAGE, SPOKEN):
        os.environ.pop(name, None)


@pytest.fixture
def ferns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A new lesson, and its file for translators into German."""
    monkeypatch.chdir(tmp_path)
    root = write_lesson("ferns", tmp_path / "ferns")
    translate(root, "de")
    return root


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text("utf-8")
    assert old in text, old
    path.write_text(text.replace(old, new, 1), "utf-8")


def say(path: Path, said: dict[str, str]) -> None:
    """Translate some texts in a file, as an editor for such files does."""
    catalogue = read(path)
    for message in catalogue:
        if message.id in said:
            message.string = said[message.id]
            message.flags.discard("fuzzy")
    file = io.BytesIO()
    write_po(file, catalogue)
    path.write_bytes(file.getvalue())


def read(path: Path) -> Catalog:
    return read_po(io.BytesIO(path.read_bytes()))


def same(text: str, kind: str) -> str:
    return text


def shout(text: str, kind: str) -> str:
    """Another text with the same fixed parts."""
    return f"¡{text}!"


# Texts, and what is between them

KINDS = """
## A name
a plant
- *one*
  more
1. two
> look
> `F -> F`
| a | `b` |
|---|---|
```
F -> F
<details><summary>Why</summary>
</details>
a $x$ and [b](c.md)
hard\\
"""
LINES = st.lists(st.sampled_from([*KINDS.splitlines(), "hard  "]), max_size=12)


@given(LINES)
def test_a_text_with_its_own_texts_in_their_place_is_the_same_but_for_line_breaks(lines: list[str]) -> None:
    text = "\n".join(lines)
    again = retext(text, same)
    assert re.sub(r"[>\\]", "", again).split() == re.sub(r"[>\\]", "", text).split()
    assert retext(again, same) == again


@given(LINES)
def test_whatever_a_translator_writes_code_and_structure_stay(lines: list[str]) -> None:
    text = "\n".join(lines)
    new = retext(text, shout)
    assert fixed_parts(new) == fixed_parts(text)
    assert re.sub("[¡!]", "", new).split() == retext(text, same).split()


@pytest.mark.parametrize("name", kit_place().names())
def test_a_lesson_of_the_kit_can_be_translated_and_its_code_says_the_same(name: str) -> None:
    source, place = Source(kit_place(), name), kit_place()
    known = {key: f"¡{key[0]}!" for key in source.messages()}
    made = source.files(known, "fr", translated=True)
    old, new = read_notebook(place.notebooks / f"{name}.ipynb"), json.loads(made[f"notebooks/{name}.ipynb"])
    assert [cell.id for cell in old.cells] == [cell["id"] for cell in new["cells"]]
    for before, after in zip(old.cells, new["cells"], strict=True):
        if before.cell_type == "code":
            assert without_sentences(before.source) == without_sentences("".join(after["source"]))
    declared = tomllib.loads((place.declared / f"{name}.toml").read_text("utf-8"))
    translated = tomllib.loads(made[f"notebooks/{name}.toml"].decode())
    assert translated.pop("language") == "fr"
    assert translated["title"] == f"¡{declared['title']}!"
    assert tomllib.loads(redeclared(made[f"notebooks/{name}.toml"].decode(), LESSON, quiet)) == {**declared, "language": "fr"}


def quiet(text: str, kind: str) -> str:
    return text.removeprefix("¡").removesuffix("!")


def without_sentences(source: str) -> str:
    """Code without its texts of several words, and what is typed in magic."""
    if source.startswith(("%", "!")):
        return source
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value and has_words(node.value):
            node.value = quiet(node.value, "")
    return ast.dump(tree)


@pytest.mark.parametrize(
    ("code", "texts"),
    [
        ('predict("How many?", draw(plant, 4))', ["How many?"]),
        ('asked = "How many cells?"\npredict(asked, "21 cells")', ["How many cells?", "21 cells"]),
        ('vote("00")\nworksheet("00", "dye")', []),
        ('vote("Is it so?", ["no way", "of course"], right="B")', ["Is it so?", "no way", "of course"]),
        ('worksheet(columns=["the step"], rows=[["step 0"]], title="How many?")', ["the step", "step 0", "How many?"]),
        ('plant = read("axiom: F G")', []),
        ("%%lsystem\naxiom: F G", []),
        ("predict(", []),
    ],
)
def test_of_code_only_what_its_questions_say_is_a_text(code: str, texts: list[str]) -> None:
    found = list[str]()
    assert recode(code, lambda text, kind: found.append(text) or text) == code
    assert sorted(found) == sorted(texts)


# A file for translators


def test_a_translated_lesson_runs_as_the_first_does(ferns: Path) -> None:
    path = ferns / "translations" / "de" / "ferns.po"
    say(
        path,
        {
            "A mystery": "x",
            "1 A mystery": "1 Ein Rätsel",
            "Step 2 has 4 buds. How many has step 4?": "Schritt 2 hat 4. Und Schritt 4?",
        },
    )
    (told,) = translate(ferns, "de")
    assert told.done == 2
    assert not told.findings
    notebook = read_notebook(path.parent / "notebooks" / "ferns.ipynb")
    text = "\n".join(cell.source for cell in notebook.cells)
    assert "## 1 Ein Rätsel" in text
    assert 'predict("Schritt 2 hat 4. Und Schritt 4?", draw(plant, 4))' in text
    assert 'language("de");' in text
    assert "Every bud does" in text or "every bud" in text  # what is not translated yet


def test_what_changed_is_fuzzy_and_what_stayed_is_kept(ferns: Path) -> None:
    path = ferns / "translations" / "de" / "ferns.po"
    asked = "Step 2 has 4 buds. How many has step 4?"
    say(path, {asked: "Und Schritt 4?", "1 A mystery": "1 Ein Rätsel"})
    change(ferns / "notebooks" / "ferns.ipynb", "How many has step 4?", "How many has step 5?")
    translate(ferns, "de")
    new = read(path).get("Step 2 has 4 buds. How many has step 5?")
    assert new is not None
    assert new.fuzzy
    assert new.string == "Und Schritt 4?"
    assert f'#| msgid "{asked}"' in path.read_text("utf-8")
    assert read(path).get("1 A mystery").string == "1 Ein Rätsel"
    assert "How many has step 5?" in (path.parent / "notebooks" / "ferns.ipynb").read_text("utf-8")
    before = path.read_bytes()
    translate(ferns, "de")
    assert path.read_bytes() == before, "to renew it again changes nothing"


@pytest.mark.parametrize(
    ("text", "broken", "lost"),
    [
        ("Take the rule `F -> F`.", "Nimm die Regel.", "`F -> F` is missing"),
        ("So $x^2$ it is.", "Also $x^3$.", "$x^2$ is missing"),
        ("See [lesson 2](02.ipynb).", "Siehe [Lektion 2](zwei.ipynb).", "(02.ipynb) is missing"),
        ("Step 2 has 1,024 buds.", "Schritt 2 hat 1.042 Knospen.", "1024 has become 1042"),
        ("{row} is {{fixed}}", "{row} ist fest", "{{fixed}} is missing"),
        ("It is so.", "Das ist `so`.", "`so` is not in the text"),
    ],
)
def test_a_translation_that_loses_a_formula_is_told_with_its_line(
    ferns: Path, capsys: pytest.CaptureFixture[str], text: str, broken: str, lost: str
) -> None:
    change(ferns / "notebooks" / "teacher" / "ferns.md", "## Minutes\n", f"## Minutes\n\n{text}\n")
    translate(ferns, "de")
    path = ferns / "translations" / "de" / "ferns.po"
    say(path, {text: broken})
    assert main(["lesson", "translate", "ferns", "--language", "de"])
    told = next(line for line in capsys.readouterr().out.splitlines() if lost in line)
    line = int(told.partition("line ")[2].partition(":")[0])
    assert f'msgid "{text}"' in path.read_text("utf-8").splitlines()[line - 1]
    assert text in (path.parent / "notebooks" / "teacher" / "ferns.md").read_text("utf-8")


def test_what_somebody_changed_in_the_translated_lesson_is_kept(ferns: Path) -> None:
    page = ferns / "translations" / "de" / "notebooks" / "teacher" / "ferns.md"
    page.write_text("my own", "utf-8")
    say(ferns / "translations" / "de" / "ferns.po", {"For the teacher: Ferns": "Für die Lehrkraft: Farne"})
    translate(ferns, "de")
    assert page.read_text("utf-8") == "my own"
    assert "Für die Lehrkraft: Farne" in (page.parent / "ferns.new.md").read_text("utf-8")


def test_links_to_sections_lead_to_the_translated_ones(ferns: Path) -> None:
    notebook = ferns / "notebooks" / "ferns.ipynb"
    change(notebook, "*about 40 minutes", "[first](#1-A-mystery) *about 40 minutes")
    translate(ferns, "de")
    path = ferns / "translations" / "de" / "ferns.po"
    first = next(each.id for each in read(path) if "#1-A-mystery" in str(each.id))
    say(path, {"1 A mystery": "1 Ein Rätsel", first: "[zuerst](#1-A-mystery)"})
    assert not translate(ferns, "de")[0].findings
    assert "[zuerst](#1-Ein-Rätsel)" in (path.parent / "notebooks" / "ferns.ipynb").read_text("utf-8")


def test_own_exercises_are_asked_in_the_language_of_the_course(ferns: Path) -> None:
    say(
        ferns / "translations" / "de" / "ferns.po",
        {"How many buds?": "Wie viele Knospen?", "How many buds does one bud become?": "Aus einer werden?"},
    )
    translate(ferns, "de")
    with spoken("de"):
        renew_exercises(choose_course(ferns, "de"))
        assert registry.exercise_of("ferns.2").title == "Wie viele Knospen?"
        assert "Aus einer werden?" in str(check("ferns.2", "1", hint=1))
    copied = [each.name for each in copy_course(ferns.parent / "mine", ferns)]
    assert "exercises/ferns.ipynb" in copied
    assert 'language(\\"de\\")' in (ferns.parent / "mine" / "exercises" / "ferns.ipynb").read_text("utf-8")
    choose_course(ferns)
    assert registry.exercise_of("ferns.2").title == "How many buds?"


def test_a_course_has_its_title_in_the_language_and_other_lessons_as_they_are(ferns: Path) -> None:
    root = ferns.parent
    (root / "course.toml").write_text('title = "Plants"\ndescription = "Before\\nus."\nlessons = ["ferns", 5, 1]\n', "utf-8")
    assert course_of(root).lead == "Before us."
    told = translate(root, "de")
    say(root / "translations" / "de" / "course.po", {"Plants": "Pflanzen"})
    translate(root, "de")
    course = course_of(root, "de")
    assert [each.path.name for each in told] == ["ferns.po", "course.po"]
    assert (course.title, course.lead) == ("Pflanzen", "Before us.")
    assert [place.root for place, _ in course.lessons] == [ferns / "translations" / "de", kit_place().root, GERMAN.root]
    assert course_of(root, "fr").lessons == course_of(root).lessons


def test_a_lesson_that_is_newer_than_the_translation_is_told(ferns: Path) -> None:
    for ending in ("ipynb", "toml"):
        (ferns / "notebooks" / f"mosses.{ending}").write_bytes((ferns / "notebooks" / f"ferns.{ending}").read_bytes())
    with pytest.raises(ModelFileError, match="mosses is not among the translations") as fault:
        course_of(ferns, "de")
    assert "lesson translate" in str(fault.value.hint)


@pytest.mark.parametrize("code", ["en", "German", "", "../x", "xx", "d"])
def test_what_is_no_language_is_told(ferns: Path, code: str) -> None:
    with pytest.raises(ModelValueError, match="no code of another language"):
        translate(ferns, code)


def test_mistakes_of_the_folder_or_the_file_are_told(ferns: Path) -> None:
    with pytest.raises(ModelFileError):
        translate(ferns / "none", "de")
    with pytest.raises(ModelNameError, match='no lesson "mosses"'):
        translate(ferns, "de", ["mosses"])
    for content in (b"\xff\xfe", b'msgid "a\nmsgstr'):
        (ferns / "translations" / "de" / "ferns.po").write_bytes(content)
        with pytest.raises(LSystemError):
            translate(ferns, "de")
    (ferns / "translations" / "de" / "ferns.po").unlink()
    (ferns / "notebooks" / "ferns.toml").write_text("title = = 1", "utf-8")
    with pytest.raises(ModelFileError, match=r"ferns\.toml: Invalid value"):
        translate(ferns, "de")


def test_one_lesson_of_a_course_is_begun_and_the_others_are_there_in_english(ferns: Path) -> None:
    for ending in ("ipynb", "toml"):
        (ferns / "notebooks" / f"mosses.{ending}").write_bytes((ferns / "notebooks" / f"ferns.{ending}").read_bytes())
    translate(ferns, "fr", ["ferns"])
    assert [each.path.name for each in translate(ferns, "fr")] == ["ferns.po"]
    assert [name for _, name in course_of(ferns, "fr").lessons] == ["ferns", "mosses"]


# The kit's lessons in German

TRANSLATED = [name for name in kit_place().names() if (GERMAN.root / f"{name}.po").is_file()]


def test_the_first_two_lessons_are_there_in_german() -> None:
    assert {"00_five_characters_one_plant", "01_all_at_once"} <= {*TRANSLATED} == {*GERMAN.names()}


@pytest.mark.parametrize("name", TRANSLATED)
def test_every_sentence_is_translated_and_up_to_date(name: str) -> None:
    source, path = Source(kit_place(), name), GERMAN.root / f"{name}.po"
    known = translation(read(path))
    missing = [text for text, kind in source.messages() if (text, kind) not in known]
    assert not missing, f'not translated in {path.name}: "{missing[0]}"; lsys-kit lesson translate . --language de renews it'
    assert not [each.id for each in renewed(path, source.messages(), "de").obsolete.values()], "left over"
    for file, content in source.files(known, "de", translated=True).items():
        assert (GERMAN.root / file).read_bytes() == content, f"{file} is not what {path.name} makes"


@pytest.mark.parametrize("name", TRANSLATED)
def test_a_careful_colleague_says_no_more_of_the_german_lesson(name: str) -> None:
    english, german = (Written(course_of(None, code), place, name) for code, place in ((ENGLISH, kit_place()), ("de", GERMAN)))
    assert german.language == "de"
    many = [len([each for each in found(written) if not any(text in each.what for text in english.lesson.accepted)])
            for found in CHECKS for written in (english, german)]  # fmt: skip
    assert many[::2] == many[1::2]


@pytest.mark.slow
@pytest.mark.usefixtures("kernels")
@pytest.mark.parametrize("name", TRANSLATED)
def test_the_cells_of_the_german_lesson_run(name: str) -> None:
    choose_course(None, "de")
    run_through(GERMAN.notebooks / f"{name}.ipynb", until_failed=True)


def test_the_course_in_german_has_what_there_is_and_english_for_the_rest() -> None:
    course = choose_course(None, "de")
    assert [name for place, name in course.lessons if place == GERMAN] == TRANSLATED
    assert [name for _, name in course.lessons] == [*kit_place().names()]
    files = course_files()
    assert files["notebooks/01_all_at_once.ipynb"].parent == GERMAN.notebooks
    assert files["exercises/01_all_at_once.ipynb"].parent == GERMAN.root / "exercises"
    assert files["notebooks/02_how_many.ipynb"].parent == kit_place().notebooks
    assert files["notebooks/gallery.ipynb"].parent == kit_place().notebooks
    assert lesson("01").title == "Alles auf einmal"
    assert lesson("02").title == "How many?"
    assert "Welches Programm hat recht?" in repr(vote("01"))
    questions.questions.cache_clear()
    questions.predictions.cache_clear()
    asked = {key: each.title for key, each in questions.questions().items()}
    questions.questions.cache_clear()
    questions.predictions.cache_clear()
    assert asked["prediction", "01:1"] == "Schritt 3 ist al al br al br. Wie lautet das Wort von Schritt 4?"
    choose_course(None)
    assert lesson("01").title == "All at once"


def test_the_copy_of_the_course_in_german_finds_its_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    choose_course(None, "de")
    language("de")
    copy_course(tmp_path / "mine")
    copied = json.loads((tmp_path / "mine" / "notebooks" / "01_all_at_once.ipynb").read_text("utf-8"))
    assert "So arbeitest du mit dieser Seite" in "".join(copied["cells"][1]["source"])
    choose_course(None)
    monkeypatch.chdir(tmp_path / "mine" / "notebooks")
    assert lesson("01").title == "Alles auf einmal"
    assert lesson("02").title == "How many?"


@pytest.mark.slow
@pytest.mark.parametrize(("code", "said"), [("de", "2 of 20 lessons; the others are in English"), ("de-AT", "2 of 20 lessons")])
def test_a_command_says_once_what_there_is_in_a_language(capsys: pytest.CaptureFixture[str], code: str, said: str) -> None:
    main(["lesson", "check", "--no-run", "--language", code])
    assert capsys.readouterr().out.count(said) == 1
    assert os.environ[SPOKEN] == "de"


def test_a_language_in_which_there_is_nothing_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert "fr" not in languages()
    assert main(["lesson", "check", "--no-run", "--language", "fr"])
    assert 'There is no language "fr"' in capsys.readouterr().err


def test_a_translated_lesson_is_packed_and_unpacked_with_its_file_for_translators(ferns: Path) -> None:
    say(ferns / "translations" / "de" / "ferns.po", {"1 A mystery": "1 Ein Rätsel"})
    translate(ferns, "de")
    packed = Path(shutil.make_archive(str(ferns.parent / "sent"), "zip", ferns.parent, "ferns"))
    root, *_ = unpack(packed, ferns.parent / "got")
    names = {str(path.relative_to(root)) for path in root.rglob("*.*") if path.name[0] != "."}
    assert names == {str(path.relative_to(ferns)) for path in ferns.rglob("*.*") if path.name[0] != "."}


def test_a_course_of_one_lesson_is_called_as_that_in_each_language(ferns: Path) -> None:
    assert course_of(ferns).title == "Ferns"
    say(ferns / "translations" / "de" / "ferns.po", {"Ferns": "Farne"})
    translate(ferns, "de")
    assert course_of(ferns, "de").title == "Farne"
    (ferns / "course.toml").write_text('title = "In May"\n', "utf-8")
    assert course_of(ferns, "de").title == "In May"


def test_the_first_page_is_in_the_language_and_has_ways_through_the_kits_course_alone() -> None:
    entry = Entry("notebooks/01_all_at_once.ipynb", "Alles auf einmal", lesson("01"), "L-Systeme", language="de")
    with spoken("de"):
        page = index_page([entry], {})
        assert '<html lang="de">' in page
        assert "50 Minuten" in page
        assert "Jede Lektion gehört zu einem Weg durch den Kurs" in page
        assert '"done":"erledigt"' in page
    assert "way through the course" not in index_page([entry], {}, in_tracks=False)
    assert 'class="track"' not in index_page([entry], {}, in_tracks=False)


@pytest.mark.parametrize("name", TRANSLATED)
def test_below_the_same_cells_it_is_said_that_a_page_cannot_do_it(name: str) -> None:
    english, german = ({*cannot(place, name)} for place in (kit_place(), GERMAN))
    assert german == english - {read_notebook(kit_place().notebooks / f"{name}.ipynb").cells[0].id}
    assert german


def cannot(place: Place, name: str) -> Iterator[str]:
    """The cells that ask for what a page without Python cannot do."""
    for cell in read_notebook(place.notebooks / f"{name}.ipynb").cells:
        if cell.cell_type == "markdown" and "data-cannot" in markdown_html(cell.source, lambda address: address, notes()):
            yield cell.id
