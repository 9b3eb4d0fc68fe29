"""Exercises in another language: every text is translated, and a student is asked and answered in it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import pytest
from babel.messages.catalog import Catalog
from babel.messages.mofile import read_mo

from lsys_kit import (
    ModelNameError,
    ModelSyntaxError,
    check,
    derive,
    exercises,
    explain,
    explore,
    infer,
    language,
    practice,
    predict,
    read,
    read_map,
    vote,
    worksheet,
)
from lsys_kit.classroom.exercises.check import checked
from lsys_kit.classroom.exercises.declarations import QUESTIONS, questions_in
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.kinds.numbers import FORMULA, with_values
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.classroom.exercises.notebooks import exercise_notebook
from lsys_kit.classroom.exercises.practice.drafts import TOPICS
from lsys_kit.classroom.exercises.progress import Record, Try, progress_of
from lsys_kit.classroom.exercises.registry import lessons, texts, translated, translated_lesson
from lsys_kit.classroom.exercises.typed import typed_number, with_digits
from lsys_kit.classroom.lessons.lesson import table
from lsys_kit.classroom.lessons.worksheet import marked, summary
from lsys_kit.classroom.panel.bundle import translated_words
from lsys_kit.classroom.scorm.package import manifest
from lsys_kit.classroom.scorm.page import exercise_page
from lsys_kit.translation import gettext, ngettext, number_text
from tests.messages import (
    SCRIPTS,
    TABLES_OF_SCRIPTS,
    TEMPLATE,
    codes,
    in_scripts,
    is_translated,
    placeholders,
    po_file,
    po_text,
    renewed,
    template,
)

LESSONS = questions_in(QUESTIONS).lessons
EXERCISES = [exercise for lesson in LESSONS for exercise in lesson.exercises]
_RENEW = "python -m tests.messages renews the catalogues"


@pytest.fixture
def german() -> Iterator[None]:
    language("de")
    yield
    language("en")


# The catalogues


@pytest.mark.slow
def test_the_template_has_every_text():
    assert po_text(template()) == TEMPLATE.read_bytes(), _RENEW


@pytest.mark.slow
@pytest.mark.parametrize("code", codes())
def test_a_catalogue_has_the_texts_of_the_template(code):
    assert po_text(renewed(code)) == po_file(code).read_bytes(), _RENEW


@pytest.mark.slow
@pytest.mark.parametrize("code", codes())
def test_a_compiled_catalogue_says_what_its_source_says(code):
    with po_file(code).with_suffix(".mo").open("rb") as file:
        compiled = _translations(read_mo(file))
    assert compiled == _translations(renewed(code)), _RENEW


def _translations(catalogue: Catalog) -> dict[object, object]:
    def key(value: object) -> object:
        return value if isinstance(value, str) else tuple(value)

    return {key(message.id): key(message.string) for message in catalogue if message.id and is_translated(message)}


@pytest.mark.slow
def test_german_lacks_no_text():
    assert [message.id for message in renewed("de") if message.id and not is_translated(message)] == []


def _forms(message) -> list[tuple[str, str]]:
    """Each form of a text with its translation; what stands there for one is compared with what stands there for several."""
    if isinstance(message.id, str):
        return [(message.id, message.string)]
    return [(message.id[1], form) for form in message.string]


@pytest.mark.slow
@pytest.mark.parametrize("code", codes())
def test_a_translation_has_the_placeholders_of_its_text(code):
    in_files = {text for lesson in LESSONS for text in texts(lesson)}
    for message in renewed(code):
        if message.id and is_translated(message):
            for text, translation in _forms(message):
                if text in in_files:
                    assert sorted(FORMULA.findall(text)) == sorted(FORMULA.findall(translation)), text
                elif isinstance(message.id, str):
                    assert placeholders(text) == placeholders(translation), text
                else:  # the form for one thing need not say how many there are
                    assert {*placeholders(text)} - {*placeholders(translation)} <= {"number"}, text


@pytest.mark.slow
@pytest.mark.parametrize("code", codes())
def test_a_translation_has_the_code_and_the_listings_of_its_text(code):
    for message in renewed(code):
        if isinstance(message.id, str) and message.id and is_translated(message):
            assert len(re.findall("`[^`]*`", message.id)) == len(re.findall("`[^`]*`", message.string)), message.id
            assert message.id.count("**") == message.string.count("**"), message.id
            texts_of_both = (message.id, message.string)
            listing, other = (re.findall(r"^    .*(?:->|\d).*$", text, re.MULTILINE) for text in texts_of_both)
            assert [line.replace("und", "and") for line in other] == listing, message.id


# What a student sees


def test_english_is_the_language_at_the_beginning():
    assert language() == "en"


@pytest.mark.usefixtures("german")
def test_replies_are_in_the_language():
    assert repr(check("1.1", "al al br")) == (
        "Fast richtig. Das kommt heraus, wenn du einen Schritt zu früh aufhörst oder das Axiom Schritt 1 nennst. Das Axiom ist "
        "Schritt 0, und Schritt 1 ist, was aus seinen Modulen wird."
    )
    assert repr(check("1.1", "bl ar bl ar bl")) == (
        "Fast richtig. Bis Position 4 stimmt dein Wort; an Position 5 hast du bl. Sieh nach, was aus dem br an Position 3 von "
        "Schritt 3 wird."
    )
    assert "<b>Richtig.</b>" in check("1.1", "bl ar bl ar ar")._repr_html_()


@pytest.mark.usefixtures("german")
def test_the_key_of_a_verdict_is_the_same_in_every_language():
    assert (check("1.1", "bl ar bl ar ar").said, float(check("2.1", "2, 3, 5, 8, 13, 26"))) == ("Correct", 5 / 6)


@pytest.mark.usefixtures("german")
def test_hints_and_the_solution_are_in_the_language():
    said = check("1.1", "al al br", hint=1, solution=True).message
    assert "Tipp 1 von 3: Schreib für jeden Schritt eine Zeile" in said
    assert "Die Lösung:\n  bl ar bl ar ar\nSchritt für Schritt" in said


@pytest.mark.usefixtures("german")
def test_a_number_is_read_with_thewords_of_page_of_the_question():
    assert check("0.2", "64 Striche") == 1
    assert check("4.2", "72 Grad") == 1
    assert check("4.2", "etwa 72°") == 1
    assert check("0.2", "mehr als 64").said == "Not readable yet"
    assert "Einheit" in check("0.2", "64 Katzen").message


@pytest.mark.usefixtures("german")
@pytest.mark.parametrize("answer", ["vierundsechzig", "Vierundsechzig Striche", "gleich 64", "es sind 64"])
def test_numbers_are_read_in_german_words(answer):
    assert check("0.2", answer) == 1


@pytest.mark.parametrize("number", [*range(13), 16, 17, 21, 30, 66, 99, 100, 101, 240, 999, 1003, 28_500])
def test_german_number_words_are_read(number):
    assert with_digits(_in_german(number)) == str(number)


_SMALL = ["null", "eins", "zwei", "drei", "vier", "fünf", "sechs", "sieben", "acht", "neun", "zehn", "elf", "zwölf"]


def _in_german(number):
    """A number in words."""
    for factor, name in ((1000, "tausend"), (100, "hundert")):
        many, rest = divmod(number, factor)
        if many:
            return ("ein" if many == 1 else _in_german(many)) + name + (_in_german(rest) if rest else "")
    if number < 13:
        return _SMALL[number]
    stems = {2: "zwan", 6: "sech", 7: "sieb"}
    if number < 20:
        return f"{stems.get(number - 10, _SMALL[number - 10])}zehn"
    tens = stems.get(number // 10, _SMALL[number // 10]) + ("ßig" if number // 10 == 3 else "zig")
    return tens if number % 10 == 0 else f"{'ein' if number % 10 == 1 else _SMALL[number % 10]}und{tens}"


@pytest.mark.parametrize("text", ["Eine Zelle und ein Strich", "undundund", "einzweidrei", "Siebenschläfer"])
def test_what_is_no_german_number_stays(text):
    assert with_digits(text) == text


@pytest.mark.usefixtures("german")
@pytest.mark.parametrize(
    ("typed", "value"), [("1.000", 1000), ("1.234,5", Fraction(12345, 10)), ("0,25", Fraction(1, 4)), ("12.5", Fraction(25, 2))]
)
def test_numbers_are_read_with_german_signs(typed, value):
    assert typed_number(typed).value == value


@pytest.mark.usefixtures("german")
def test_numbers_are_written_with_german_signs():
    assert [number_text(each) for each in ("1,234.5", "1.123 cm", "A(0.5)", "3/4", "0.1 0.2")] == [
        "1.234,5",
        "1,123 cm",
        "A(0.5)",
        "3/4",
        "0.1 0.2",
    ]
    assert "1,3" in practice("slices", 2, 3).exercise.question
    assert "0,3333" in with_values("Das ist {1/answer}.", 3)


@pytest.mark.usefixtures("german")
def test_mistakes_that_readers_find_are_in_the_language():
    assert '"bx" (Zeile 1, Spalte 7). Die Symbole sind' in str(check("1.1", "al al bx"))
    with pytest.raises(ModelSyntaxError, match=r'^Dieses "\[" wird nie geschlossen \(Zeile 2, Spalte 7\). Jeder Zweig endet'):
        read("axiom: F\nF -> F[+F")
    with pytest.raises(ModelNameError, match=r'^Den Namen "tt" kenne ich nicht \(Zeile 2, Spalte 12\)'):
        read("axiom: A(1)\nA(x) : x > tt -> A(x+1)")
    with pytest.raises(ModelSyntaxError, match=r"^Eine Wand hat keine Werte"):
        read_map("map: ABAB\nA(1) -> B")


@pytest.mark.usefixtures("german")
def test_kinds_of_values_are_named_in_the_language():
    for exercise in ("0.1", "0.2", "1.1", "7.3", "10.5"):
        assert "nicht eine Liste." in str(check(exercise, [[1, 2], [3]]))


ENGLISH = frozenset(
    re.findall(
        r"\w+",
        """
    and are becomes does each every found from give has have here how is its look many must needed not
    of only other right should than that the there they this too what where which with would wrong you your
""",
    )
)
"""Words of English sentences that no German one has."""
WRONG = tomllib.loads((Path(__file__).parent / "data" / "wrong_answers.toml").read_text("utf-8"))


def english_in(reply: str, answer: object = "") -> set[str]:
    """The English words of a reply, without what was typed, is quoted or is code."""
    said = re.sub(r'"[^"]*"|`[^`]*`|„[^“]*“', " ", reply).replace(str(answer), " ")
    return ENGLISH & set(re.findall(r"\w+", said.lower()))


@pytest.mark.slow
@pytest.mark.usefixtures("german")
@pytest.mark.parametrize("name", WRONG)
def test_no_reply_and_no_hint_is_in_another_language(name):
    answers = [answer for several in WRONG[name].values() for answer in several]
    replies = [(answer, check(name, answer).message) for answer in answers]
    replies.append((answers[0], check(name, answers[0], hint=3).message))
    assert [(answer, reply) for answer, reply in replies if english_in(reply, answer)] == []


@pytest.mark.slow
@pytest.mark.usefixtures("german")
@pytest.mark.parametrize("topic", TOPICS)
def test_no_reply_and_no_hint_of_practice_is_in_another_language(topic):
    for level in (1, 2, 3):
        asked = practice(topic, level, 1).exercise
        for answer in ("", "7", "3.5", "1 2 3", "a -> b", "axiom: a\na -> a b", "A", "x+1", "[", ["a"]):
            assert not english_in(str(checked(asked, answer, 3, False, "check(answer")), answer), (level, answer)


@pytest.mark.usefixtures("german")
def test_what_stands_between_quotation_marks_is_as_it_was_typed():
    with pytest.raises(ModelNameError, match=r'Es gibt keine Aufgabe "99\.9"'):
        check("99.9", 1)
    assert gettext('Exercise "{id}" has the hints 1 to {most}', id="1.1", most=3).startswith('Aufgabe "1.1" hat')
    assert gettext("There are {number} words", number="1,000.5").startswith("There are 1.000,5")


@pytest.mark.usefixtures("german")
def test_an_option_is_read_by_its_text():
    assert check("8.2", "Ana und Ben, aber nicht Caro.") == 1


@pytest.mark.usefixtures("german")
def test_formulas_in_a_reply_are_computed():
    assert "Fünf solche Drehungen sind zusammen 5 Grad." in check("4.2", 1).message


@pytest.mark.slow
@pytest.mark.usefixtures("german")
@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda exercise: exercise.id)
def test_every_solution_is_right_and_every_slip_has_its_reply(exercise):
    own = translated(exercise)
    assert checked(own, own.solution, 0, False, "check(answer").said == "Correct"
    known = [slip.says or gettext(MISCONCEPTIONS[slip.misconception].but) for slip in own.slips]
    for slip in own.slips:
        reply = checked(own, slip.answer, 0, False, "check(answer")
        assert any(said in reply.message for said in known)


@pytest.mark.usefixtures("german")
@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda exercise: exercise.id)
def test_no_hint_contains_the_solution(exercise):
    own = translated(exercise)
    if exercise.kind in ("word", "system", "expression"):
        assert not any(exercise.solution in hint for hint in own.hints)
    assert len({option.text for option in own.options}) == len(letters(own))


@pytest.mark.usefixtures("german")
def test_a_notebook_is_written_in_the_language():
    notebook = exercise_notebook(translated_lesson(LESSONS[1]))
    assert "# Aufgaben: Alles auf einmal" in notebook
    assert json.loads(notebook)["cells"][1]["source"] == ["from lsys_kit import check, language, progress\n", 'language("de");']
    assert not re.search(r"After these exercises|hints 1 to|Not answered|Replace the", notebook)


@pytest.mark.usefixtures("german")
def test_exercises_are_listed_in_the_language():
    assert repr(exercises()).splitlines()[0] == "0.1      Ein Großbuchstabe"


@pytest.mark.usefixtures("german")
def test_a_text_without_translation_stays():
    assert gettext("No such text") == "No such text"


@pytest.mark.usefixtures("german")
def test_numbers_have_their_form():
    forms = "You have {number} word, and {asked} are asked for.", "You have {number} words, and {asked} are asked for."
    assert [ngettext(*forms, number, asked=3).split(",")[0] for number in (1, 2)] == ["Du hast 1 Wort", "Du hast 2 Wörter"]


# How it is chosen


def test_a_language_that_is_not_there_is_named():
    with pytest.raises(ModelNameError, match='There is no language "tlh"'):
        language("tlh")
    assert language() == "en"


def test_a_country_is_taken_for_its_language():
    try:
        assert (language("de_AT"), language("DE-ch")) == ("de", "de")
    finally:
        language("en")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("variable", "said"), [({"LSYS_KIT_LANGUAGE": "de"}, "Richtig."), ({"LANG": "de_DE.UTF-8"}, "Correct.")]
)
def test_the_environment_chooses_by_its_own_variable_alone(variable, said):
    code = "from lsys_kit import check; print(check('1.1', 'bl ar bl ar ar'))"
    done = subprocess.run(
        [sys.executable, "-c", code], env={**os.environ, **variable}, capture_output=True, text=True, check=True, timeout=120
    )
    assert done.stdout.strip() == said


# Practice


@pytest.mark.slow
@pytest.mark.usefixtures("german")
@pytest.mark.parametrize("topic", TOPICS)
def test_practice_is_the_same_exercise_in_the_language(topic):
    german = practice(topic, 2, 5).exercise
    language("en")
    english = practice(topic, 2, 5).exercise
    assert (german.solution, german.system) == (english.solution, english.system)
    assert german.question != english.question
    assert not {*german.hints} & {*english.hints}
    language("de")
    assert checked(german, german.solution, 0, False, "check(answer").said == "Correct"


# The questions of a lesson, and progress


@pytest.mark.usefixtures("german")
def test_the_labels_of_a_lesson_are_in_the_language():
    assert vote("01").words["Check"] == worksheet("01", "counts").words["Check"] == "Prüfen"
    sheet = table("01", "counts")
    assert summary(sheet, marked(sheet, ["2", "2", "3", "77"]), [3]) == (
        "3 von 8 Feldern sind richtig, 4 sind noch nicht ausgefüllt. Sieh dir noch einmal an: step 2, rule after rule."
    )


def test_english_labels_need_nowords_of_page():
    assert predict("How many?", "3").prompt.words == {}


def test_the_scripts_have_the_texts_that_are_said_to_stand_in_their_tables():
    scripts = "".join(path.read_text("utf-8") for path in SCRIPTS.rglob("*.js"))
    assert [text for text in TABLES_OF_SCRIPTS if f'"{text}"' not in scripts and f"'{text}'" not in scripts] == []


@pytest.mark.usefixtures("german")
def test_what_scripts_show_is_sent_to_them_in_the_language():
    sent = [
        *translated_words("panel"),
        *vote("01").words,
        *translated_words(
            *["practice", "board", "class_board", "phone", "class_page", "kit_page", "waiting", "contents", "kit_contents"]
        ),
    ]
    assert [text for text in in_scripts() if text not in sent and gettext(text) != text] == []


@pytest.mark.usefixtures("german")
def test_panels_and_their_pages_are_in_the_language():
    words = explore("J1").model["words"]
    assert words == explore("J1").page_data()["model"]["words"]
    assert (words["stages"], words["the step of the derivation"]) == ("Stufen", "der Schritt der Ableitung")


def test_an_english_panel_needs_no_words():
    assert "words" not in explore("J1").model


@pytest.mark.usefixtures("german")
def test_a_page_for_platforms_is_in_the_language():
    lesson = lessons()[1]
    page = exercise_page(lesson)
    assert page.startswith('<!doctype html>\n<html lang="de">')
    assert "<h1>Aufgaben: Alles auf einmal</h1>" in page
    for said in ("Das ist Übung und keine Prüfung.", "Deine Antwort, ein Wort", "<h2>Zusammenfassung</h2>", "Im Notebook</h2>"):
        assert said in page
    assert manifest([translated_lesson(lesson)], ["01.html"]).count("Alles auf einmal") == 2
    assert translated_words("practice")["{number} of {total} solved."] == "{number} von {total} gelöst."


@pytest.mark.usefixtures("german")
def test_progress_is_in_the_language():
    page = progress_of(Record((Try("1.1", True),)), 1)
    assert repr(page).startswith("Alles auf einmal: 1 von 5 gelöst.\n✓ 1.1  Ein Wort von Hand\n")
    assert 'aria-label="gelöst:"' in page._repr_html_()


# What `infer` and `explain` say


def test_systems_that_fit_and_steps_are_explained_in_the_chosen_language():
    language("de")
    try:
        mended = str(infer(["a", "ab", "abb", "abba"]))
        assert mended.startswith("Kein System passt zu diesen 4 Wörtern. Schritt 3 kann nicht aus Schritt 2 entstehen:")
        assert "wenn Buchstabe 4 von Schritt 3, a, ein b wäre. Mit context=(1, 0) passt ein System." in mended
        assert str(infer(["a", "bc", "caa"])).startswith(
            "2 Systeme passen zu diesen 3 Wörtern; sie trennen sich bei Schritt 3:"
        )
        assert "(0,6 ± 0,22, 3 von 5)" in str(infer([["a", "ab", "abb"], ["a", "b", "b"], ["a", "ab", "bb"]], stochastic=True))
        drawn = infer([[(0, 0, 0, 1)], [(0, 0, 0, 1), (0, 5, 0, 6)]])
        assert str(drawn).endswith("Die Striche von Schritt 1 hängen nicht zusammen.")
        explained = str(explain(derive(read("axiom: b a\nb < a -> b\na -> c"), 1), 1))
        assert explained.splitlines() == [
            "1. b wird zu b: keine Produktion ist für b",
            "2. a wird zu b: Produktion 1, b < a -> b",
            "     Produktion 2, a -> c: passt auch, aber Produktion 1 steht davor",
        ]
    finally:
        language("en")
    assert str(infer(["a", "ab", "aba"])).startswith("One system fits these 3 words:")
