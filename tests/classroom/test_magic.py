"""`%%lsystem` in IPython's own shell: a pasted text is a system with a name, or a mistake that is underlined."""

from __future__ import annotations

import atexit
import builtins
import html
import re
import subprocess
import sys
from dataclasses import dataclass

import pytest

from lsys_kit import read
from lsys_kit.notation.registry import DIALECTS
from tests.classroom.test_typeset import harmless
from tests.plants import plant
from tests.test_trust import HOSTILE
from tests.timing import spent

ALGA = "axiom: a\na -> b a\nb -> a"
MARKUP = [
    "<script>alert(1)</script>",
    "<img/src=x/onerror=alert(1)>",
    '"onload="alert(1)',
    "'--><svg/onload=alert(1)>",
    "]]>",
    "&lt;script&gt;",
    "</pre><b>",
    "</style><script>",
    "javascript:alert(1)",
    "<a/href=javascript:alert(1)>x</a>",
    "\u202e<b>",
    "\ud800",
    "\x00",
    "\x1b[2J",
    "<!--",
    "x" * 100_000,
]


@dataclass(frozen=True)
class Seen:
    """What a cell shows, as HTML and as plain text."""

    html: str
    text: str

    @property
    def wrong(self) -> str:
        """What is underlined."""
        (stretch,) = re.findall(r"<u [^>]*>(.*?)</u>", self.html)
        return html.unescape(stretch)

    @property
    def said(self) -> str:
        """The text of the HTML."""
        return html.unescape(re.sub(r"<[^>]+>", "", self.html))


class Notebook:
    """A shell of IPython's that has loaded the kit."""

    def __init__(self, shell) -> None:
        self.shell, self.names = shell, shell.user_ns

    def run(self, text: str) -> Seen:
        """Run a cell, which must show one thing and nothing else."""
        from IPython.utils.capture import capture_output

        with capture_output() as captured:
            result = self.shell.run_cell(text)
        assert result.success
        assert (captured.stdout, captured.stderr, len(captured.outputs)) == ("", "", 1)
        data = captured.outputs[0].data
        assert set(data) == {"text/html", "text/plain"}
        assert "Traceback" not in data["text/plain"]
        return Seen(harmless(data["text/html"]), data["text/plain"])


@pytest.fixture
def notebook(monkeypatch, tmp_path):
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    for name in ("display", "__IPYTHON__"):  # IPython leaves these among the names of Python
        monkeypatch.setattr(builtins, name, None, raising=False)
    monkeypatch.delattr(builtins, "_", raising=False)  # which a doctest leaves there, and which hides that of the shell
    shell = InteractiveShell.instance(config=Config(HistoryManager={"enabled": False}))
    shell.run_line_magic("load_ext", "lsys_kit")
    yield Notebook(shell)
    shell.restore_sys_module_state()
    InteractiveShell.clear_instance()
    atexit.unregister(shell.atexit_operations)  # each would collect all garbage once more when the process ends


# --- a system ---------------------------------------------------------------------------------------------------------


def test_a_pasted_text_is_a_system_with_a_name(notebook):
    seen = notebook.run(f"%%lsystem alga\n{ALGA}")
    assert notebook.names["alga"] == read(ALGA)
    assert seen.said.startswith("alga is an L-system in the notation abop.")
    assert seen.text.startswith(
        "alga is an L-system in the notation abop.\n  axiom: a\n  a -> b a\n  b -> a\nstep 0: a\nstep 1: b a\nstep 2: a b a\n"
    )


def test_without_a_name_it_is_shown_only(notebook):
    before = {name for name in notebook.names if name[0] != "_"}
    assert notebook.run(f"%%lsystem\n{ALGA}").text.startswith("This is an L-system")
    assert {name for name in notebook.names if name[0] != "_"} == before


def test_its_first_words_have_formulas_where_constants_are_letters(notebook):
    model = "q = 0.8\naxiom: A(1)\nA(x) : x > 0.3 -> F(x) A(q*x)"
    seen = notebook.run(f"%%lsystem shrinking abop --letter q\n{model}")
    assert "step 2: F(1)F(q)A(q^2)" in seen.text
    assert "The formulas hold where q > ∛0.3 ≈ 0.6694." in seen.text
    assert "<msup><mi>q</mi><mn>2</mn></msup>" in seen.html
    assert 'declares no constant "p"' in notebook.run(f"%%lsystem shrinking --letter p\n{model}").said


def test_a_notation_may_be_insisted_on(notebook):
    seen = notebook.run("%%lsystem weed plant-string\nAxiom: I\nI -> I[A]I(I)")
    assert notebook.names["weed"] == read("Axiom: I\nI -> I[A]I(I)", "plant-string")
    assert "in the notation plant-string" in seen.text


@pytest.mark.parametrize("notation", DIALECTS)
def test_every_notation_is_understood(notebook, notation):
    from lsys_kit import write

    seen = notebook.run(f"%%lsystem plant {notation}\n{write(plant(notation), notation)}\n")
    assert notebook.names["plant"] == plant(notation)
    assert f"in the notation {notation}." in seen.said


def test_what_the_reader_found_is_told(notebook):
    seen = notebook.run("%%lsystem plant\naxiom: F\nF -> FF\nG -> <F")
    assert seen.wrong
    seen = notebook.run("%%lsystem plant\naxiom: F\nF -> FF\nG -> F")
    assert "The production B &lt; F can never match" in notebook.run("%%lsystem plant\naxiom: F\nB < F -> F").html
    for note in ('"FF" is read as F F.', "The production G can never match: no module G occurs."):
        assert note in seen.said
        assert note in seen.text


def test_a_system_at_the_end_of_a_cell_is_shown_like_one_that_was_pasted(notebook):
    pasted = notebook.run(f"%%lsystem\n{ALGA}")
    assert notebook.run(f"from lsys_kit import read\ndisplay(read({ALGA!r}))") == pasted


def test_a_later_mistake_counts_lines_as_the_cell_does(notebook):
    notebook.run("%%lsystem plant\naxiom: A(0)\nA(t) -> A(1/t)")
    rule = notebook.names["plant"].productions[0]
    source = notebook.names["plant"].source
    assert source[slice(*rule.at)] == "A(t) -> A(1/t)"
    assert source.count("\n", 0, rule.at[0]) == 2


@pytest.mark.slow
def test_a_cell_is_answered_soon(notebook):
    with spent() as taken:
        notebook.run("%%lsystem wild\naxiom: F\nF -> " + "F[+F]" * 2_000)
    assert taken.seconds < 8


# --- a mistake --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "line", "wrong"),
    [
        ("axiom: A(1)\nA(t) : t = 1 -> B", 3, "="),
        ("axiom: A\nA -> [B", 3, "["),
        ("axiom: A\n\n\nA -> B(time)", 5, "time"),
        ("axiom: A(1)\nA(t) -> A(sqr(t))", 3, "sqr"),
        ("axiom: A\naxiom: B", 3, "axiom: B"),
        ("axiom: A\nA -> хB", 3, "х"),
        ("A -> B\nB -> A", 3, "\xa0"),
        ("axiom: A\nA ->", 3, "->"),
        ("axiom: A\nA -> B & < > \" '", 3, "<"),
        ("axiom: A" + " B" * 200 + " )" + " C" * 200, 2, ")"),
        ("axiom: A\n" * 300, 3, "axiom: A"),
    ],
)
def test_a_mistake_is_underlined_where_it_stands(notebook, text, line, wrong):
    seen = notebook.run(f"%%lsystem plant\n{text}\n")
    assert seen.wrong == wrong
    assert f"(line {line}, column " in seen.said
    assert f"(line {line}, column " in seen.text
    assert "plant" not in notebook.names
    assert seen.text.endswith('\nThere is no system "plant" yet.')
    assert len(seen.html) < 10_000


@pytest.mark.parametrize("text", ["axiom: A\nA -> B(time)", "axiom: A(1)\nA(t) : t => 1 -> B\n\nB -> C"])
def test_the_carets_stand_below_what_is_underlined(notebook, text):
    seen = notebook.run(f"%%lsystem\n{text}")
    line, carets = next(
        (one, two) for one, two in zip(seen.text.split("\n"), seen.text.split("\n")[1:], strict=False) if set(two) == {" ", "^"}
    )
    assert line[carets.index("^") : len(carets)] == seen.wrong
    shown = next(row for row in seen.said.split("\n") if line.strip() in row)
    assert int(shown.split()[0]) == [f"  {row}" for row in f"%%lsystem\n{text}".split("\n")].index(line) + 1


def test_a_mistake_is_told_by_more_than_its_colour(notebook):
    seen = notebook.run("%%lsystem\naxiom: A\nA -> B(u)")
    assert "text-decoration:underline" in seen.html
    assert 'role="alert"' in seen.html
    assert "Not readable yet." in seen.said
    assert seen.text.startswith('Not readable yet. I do not know the name "u" (line 3, column 8).')


def test_after_a_mistake_the_system_is_the_one_before(notebook):
    notebook.run(f"%%lsystem alga\n{ALGA}")
    assert '"alga" is still the system that was read before.' in notebook.run("%%lsystem alga\naxiom = A").said
    assert notebook.names["alga"] == read(ALGA)


# --- names ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("head", "wrong", "said"),
    [
        ("2koch", "2koch", '"2koch" cannot be a name (line 1, column 11). A name is made of letters'),
        ("koch-curve", "koch-curve", "cannot be a name"),
        ("lambda", "lambda", "is a keyword of Python"),
        ("None", "None", "is a keyword of Python"),
        ("derive", "derive", "is a name that the kit uses"),
        ("system abop", "system", "is a name that the kit uses"),
        ("ﬁgure", "ﬁgure", "is a name that the kit uses"),
        ("In", "In", "is a name that the notebook uses"),
        ("get_ipython", "get_ipython", "is a name that the notebook uses"),
        ("_", "_", "is a name that the notebook uses"),
        ("__builtins__", "__builtins__", "is a name that the notebook uses"),
        (
            "plant-string",
            "plant-string",
            'is a notation, not a name (line 1, column 11). Put a name before it, as in "%%lsystem plant plant-string".',
        ),
        (
            "plant  plant-strng",
            "plant-strng",
            'There is no notation called "plant-strng" (line 1, column 18). Did you mean "plant-string"?',
        ),
        ("plant X", "X", "Notations are: abop"),
        ("plant abop, please", "please", 'Only a name and a notation may follow %%lsystem (line 1, column 23). Write "%%'),
        ("plant = abop now", "abop now", "Only a name and a notation may follow %%lsystem"),
    ],
)
def test_a_first_line_that_makes_no_sense_is_underlined(notebook, head, wrong, said):
    before = dict(notebook.names)
    seen = notebook.run(f"%%lsystem {head}\n{ALGA}")
    assert seen.wrong == wrong
    assert said in seen.said
    assert said in seen.text
    assert {name: value for name, value in notebook.names.items() if name[:2] != "_i"} == {
        name: value for name, value in before.items() if name[:2] != "_i"
    }


def test_a_name_is_what_python_makes_of_it(notebook):
    notebook.run(f"%%lsystem ﬁlament\n{ALGA}")
    assert notebook.run("display(filament)") == notebook.run(f"%%lsystem\n{ALGA}")


def test_a_name_that_meant_something_else_is_told(notebook):
    notebook.names["x"] = 3
    assert '"x" meant something else in this notebook.' in notebook.run(f"%%lsystem x\n{ALGA}").said
    assert "meant" not in notebook.run(f"%%lsystem x\n{ALGA}").said
    assert '"sum" is also a name of Python\'s.' in notebook.run(f"%%lsystem sum\n{ALGA}").text


# --- nothing is run ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", range(len(HOSTILE + MARKUP)))
def test_whatever_is_typed_is_text(notebook, number, tmp_path):
    text, target = (HOSTILE + MARKUP)[number], tmp_path / "made"
    text = text.format(target) if number < len(HOSTILE) else text
    for cell in (
        f"%%lsystem {text}\n{ALGA}",
        f"%%lsystem plant {text}\n{ALGA}",
        f"%%lsystem plant\n{text}",
        f"%%lsystem plant\naxiom: A\nA -> {text}",
        f"%%lsystem plant\nalphabet: {text}\naxiom: {text}",
        f"%%lsystem plant\nc = {text}\naxiom: A(c)",
    ):
        seen = notebook.run(cell)
        assert len(seen.text) < 2_000
        assert not re.search("[\x00\x1b\u202e\ud800]", seen.html + seen.text)
    assert not target.exists()


@pytest.mark.parametrize("code", ["{open('{0}', 'w')}", "$target", "{target.touch()}", "!touch {0}", "$(touch {0})", "{{x}}"])
def test_the_first_line_is_not_filled_in(notebook, tmp_path, code):
    notebook.names["target"] = tmp_path / "made"
    seen = notebook.run(f"%%lsystem {code.replace('{0}', str(tmp_path / 'made'))}\n{ALGA}")
    assert "Not readable yet." in seen.said
    assert not (tmp_path / "made").exists()


def test_the_kit_is_loaded_only_when_it_is_asked_for():
    code = "import sys, lsys_kit; assert lsys_kit.load_ipython_extension; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=True)
    assert not {"IPython", "lark", "lsys_kit.classroom", "lsys_kit.notation"} & set(done.stdout.split())
