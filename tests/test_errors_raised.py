"""What errors say in another language: a place that raises one writes English, and it is found out what that says."""

import ast
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from itertools import pairwise

import pytest

from lsys_kit import ModelFileError, ModelLimitError, derive, draw, infer, language, limits, read, system
from lsys_kit.errors import LSystemError
from lsys_kit.translation import FORMS, LOCALE, gettext, retold
from tests.errors_raised import forms_of_errors
from tests.messages import forms_text, said_by_errors

PACKAGE = LOCALE.parent
ERRORS = {each.__name__ for each in (LSystemError, *LSystemError.__subclasses__())}
VALUE = re.compile(r"(?<!\{)\{(\w+)\}(?!\})")


@pytest.fixture
def german() -> Iterator[None]:
    language("de")
    yield
    language("en")


@pytest.fixture(scope="module")
def forms() -> list[str]:
    return sorted({form for form, _ in said_by_errors()})


@pytest.mark.slow
def test_the_forms_are_those_of_the_places_where_errors_are_raised():
    assert FORMS.read_text(encoding="utf-8") == forms_text(), "python -m tests.messages renews them"


def _literal_messages() -> Iterator[str]:
    """The messages and hints of all calls of classes of errors that are constants, found in another way."""
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call) and ast.unparse(node.exc.func) in ERRORS:
                given = [*node.exc.args[:1], *(each.value for each in node.exc.keywords if each.arg == "hint")]
                yield from (each.value for each in given if isinstance(each, ast.Constant) and isinstance(each.value, str))


@pytest.mark.slow
@pytest.mark.usefixtures("german")
def test_each_message_that_is_a_constant_where_it_is_raised_is_translated():
    found = [text for text in _literal_messages() if " " in text]
    assert len(found) > 150
    alike = {text for text in found if retold(text) == text}
    assert alike == set()


@pytest.mark.slow
@pytest.mark.usefixtures("german")
def test_each_form_is_found_again_in_what_it_says(forms):
    assert len(forms) > 800
    for form in forms:
        values = {name: str(number) for number, name in enumerate(VALUE.findall(form), 7)}
        assert retold(form.format(**values)) == gettext(form).format(**values), form


def test_what_a_text_is_made_of_is_followed_to_where_it_is_written(tmp_path):
    (tmp_path / "module.py").write_text(
        "END = 'It ends with \"{\".'\n"
        "class Own(LSystemError): pass\nclass ModelValueError(Own): pass\n"
        "def refuse(said, hint=None):\n    raise Own(said, hint=hint)\n"
        "def check(many, name, what):\n"
        "    there = 'is one' if many == 1 else 'are none'\n"
        "    if many: raise ModelValueError(f'There {there} of {name!r}', hint=END)\n"
        "    refuse(f\"{name} letter{'s' * (many > 1)}\", hint=guess(name) or f'Take another {what}.')\n"
        "check(1, 'F', 'a rule')\n",
        encoding="utf-8",
    )
    assert {form for form, _ in forms_of_errors(tmp_path)} == {
        "There is one of {name}",
        "There are none of {name}",
        'It ends with "{{".',
        "{name} letter",
        "{name} letters",
        "Take another {what}.",
        "a rule",
    }


@pytest.mark.parametrize("text", ["", "modules", "There is no such thing as this", 'There is no arithmetic called "real"'])
def test_in_english_and_where_nothing_is_known_a_text_stays(text):
    assert retold(text) == text


@pytest.mark.usefixtures("german")
@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (lambda: derive(system("J4"), -1), "Die Zahl der Schritte muss eine ganze Zahl ab 0 sein, nicht -1."),
        (lambda: system("J99"), 'Der Katalog hat kein System "J99".'),
        (lambda: derive(read("axiom: F\nF -> F F"), 40), "Schritt 23 hätte 8.388.608 Module; die Grenze ist 5.000.000."),
        (lambda: infer("ab"), "Gebraucht wird eine Folge von Wörtern, nicht str."),
        (lambda: infer(["a"]), "Regeln werden aus mindestens zwei Wörtern gefunden; hier ist eines."),
        (lambda: draw("F"), "nicht str. Zum Beispiel draw(system('F')) oder draw(read(text))."),
        (lambda: read("Koch {\nAngle 6\nAxiom F\nF=F+F", "fractint"), 'Dieses "{" wird nie geschlossen'),
        (lambda: read("#define n\nAxiom: A\nA --> B", "cpfg"), 'Das Makro "n" hat keinen Wert'),
        (lambda: read("\\axiom a,\na # b # c", "grogra"), "Das ist ein zweiter Pfeil in einer Regel"),
        (lambda: read("axiom = AXIOM[A", "mathematica"), 'Dieses "[" wird nie geschlossen'),
    ],
)
def test_a_mistake_is_told_in_the_language(asked, said):
    with pytest.raises(LSystemError) as found:
        asked()
    assert said in str(found.value)


@pytest.mark.usefixtures("german")
def test_the_steps_that_are_kept_are_told_in_the_language():
    with limits(modules=100), pytest.raises(ModelLimitError) as found:
        derive(read("axiom: F\nF -> F F"), 9)
    assert found.value.hint == (
        "Schritt 6 ist der letzte, der erreicht werden kann. Nimm weniger Schritte, oder setz limits(modules=...)."
    )


@pytest.mark.usefixtures("german")
def test_names_and_faults_of_others_stay_as_they_are(tmp_path):
    with pytest.raises(ModelFileError, match=r'No such file or directory"?\.$') as found:
        draw(read("axiom: F")).save(str(tmp_path / "no such folder" / "The step.svg"))
    assert "kann nicht geschrieben werden: " in found.value.message
    assert retold('There is no exercise "The step or 1"') == 'Es gibt keine Aufgabe "The step or 1"'


@pytest.mark.slow
def test_a_language_that_is_not_there_is_told_in_english():
    code = "from lsys_kit import read\nread('axiom: F\\nF -> [')"
    found = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "LSYS_KIT_LANGUAGE": "tlh"},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert found.stderr.strip().splitlines()[-1].startswith('lsys_kit.errors.ModelNameError: There is no language "tlh"')


@pytest.mark.slow
def test_no_two_forms_are_the_same_text_with_other_names(forms):
    """Of two such forms it could not be found out which one is said: they have one translation."""
    language("de")
    try:
        blank = sorted((VALUE.sub("{}", form), VALUE.sub("{}", gettext(form))) for form in forms)
    finally:
        language("en")
    assert [(one, other) for one, other in pairwise(blank) if one[0] == other[0] and one[1] != other[1]] == []
