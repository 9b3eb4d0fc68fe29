"""What a person types after `lsys-kit`, and what comes back: words on one stream, one message on the other."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from lsys_kit.__main__ import BAD_INPUT, BROKEN_PIPE, INTERRUPTED, main
from lsys_kit.classroom.catalogue import system
from lsys_kit.notation.read import read
from tests.endings import FLAT, SAID_OF_DRAWINGS, SAID_OF_FLAT, beginnings

FIBONACCI = "axiom: a\na -> ab\nb -> a\n"


@dataclass(frozen=True)
class Said:
    status: int
    out: str
    err: str


@pytest.fixture
def shell(capsys: pytest.CaptureFixture[str]):
    def run(*arguments: str) -> Said:
        try:
            status = main(arguments)
        except SystemExit as left:
            status = int(left.code or 0)
        return Said(status, *capsys.readouterr())

    return run


@pytest.fixture
def model(tmp_path: Path):
    def written(text: str | bytes, name: str = "model.txt") -> str:
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return str(path)

    return written


def process(*arguments: str, given: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    return subprocess.run([sys.executable, "-m", "lsys_kit", *arguments], input=given, capture_output=True, timeout=300)


def refused(said: Said, *words: str) -> None:
    """Exit status 2, nothing on the standard output, and one message that holds the words."""
    assert said.status == BAD_INPUT
    assert said.out == ""
    assert said.err.startswith("lsys-kit: ")
    assert "Traceback" not in said.err
    for word in words:
        assert word in said.err


# --- deriving ---------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_derive_keeps_letters_and_says_where_the_formulas_hold(shell, tmp_path):
    (tmp_path / "q.txt").write_text("q = 0.8\naxiom: A(1)\nA(x) : x > 0.3 -> F(x) A(q*x)")
    said = shell("derive", str(tmp_path / "q.txt"), "-n", "2", "--letter", "q")
    assert said.out.splitlines() == ["A(1)", "F(1)A(q)", "F(1)F(q)A(q^2)"]
    assert said.err == "lsys-kit: note: The formulas hold where q > 0.3.\n"
    assert 'declares no constant "p"' in shell("derive", str(tmp_path / "q.txt"), "-n", "2", "--letter", "p").err


def test_derive_prints_a_word_a_line_from_the_axiom_on(shell):
    assert shell("derive", "J1", "-n", "3") == Said(0, "ar\nal br\nbl ar ar\nal al br al br\n", "")


@pytest.mark.slow
def test_each_word_of_the_catalogue_comes_out_of_the_shell(shell):
    from lsys_kit.classroom.catalogue import entry, systems

    for id in systems():
        words = entry(id).words
        if words:
            lines = shell("derive", id, "-n", str(max(words))).out.splitlines()
            assert {step: lines[step] for step in words} == dict(words), id


def test_an_id_may_be_typed_in_small_letters(shell):
    assert shell("derive", "j1", "-n", "2") == shell("derive", "J1", "-n", "2")


def test_a_system_may_be_called_by_its_name(shell):
    assert shell("derive", "anabaena-life-spans", "-n", "2") == shell("derive", "J4", "-n", "2")


def test_a_catalogue_id_goes_before_a_file_of_that_name(shell, model, monkeypatch, tmp_path):
    model(FIBONACCI, "P4")
    monkeypatch.chdir(tmp_path)
    assert shell("derive", "P4", "-n", "0").out == "M(5,1)\n"
    assert shell("derive", "./P4", "-n", "0").out == "a\n"


@pytest.mark.parametrize(
    "text",
    [FIBONACCI, FIBONACCI.replace("\n", "\r\n"), "\ufeff" + FIBONACCI],
    ids=["plain", "Windows lines", "byte order mark"],
)
def test_a_file_is_read_as_any_editor_writes_it(shell, model, text):
    assert shell("derive", model(text), "-n", "2").out == "a\na b\na b a\n"


@pytest.mark.slow
def test_a_dash_reads_the_standard_input():
    done = process("derive", "-", "-n", "2", given=FIBONACCI.encode())
    assert (done.returncode, done.stdout.split(b"\n")) == (0, [b"a", b"a b", b"a b a", b""])


def test_constants_are_set_exactly(shell):
    exact = shell("derive", "P5", "-n", "2", "--set", "dt=14/10").out
    assert exact == shell("derive", "P5", "-n", "2", "--set", "dt=1.4").out
    assert exact.splitlines()[2] == "M(1,-1)M(1.2,1)M(1,-1)M(0.8,1)"


@pytest.mark.parametrize(
    "order",
    [
        ["J4", "-n", "9", "--set", "lifeTimeA=2", "--set", "lifeTimeB=5"],
        ["J4", "-n", "9", "--set", "lifeTimeA=2", "lifeTimeB=5"],
        ["--set", "lifeTimeA=2", "lifeTimeB=5", "J4", "-n", "9"],
    ],
    ids=["twice", "after one another", "before the system"],
)
def test_several_constants_are_set_in_any_order(shell, order):
    assert " ".join(shell("derive", *order, "--counts").out.split()) == "1 1 2 2 3 3 4 5 6 8"


def test_constants_may_have_any_name(shell, model):
    path = model("system = 1\narithmetic = 2\naxiom: A(system, arithmetic)\nA(x,y) -> A(x+system, y+arithmetic)\n")
    assert shell("derive", path, "-n", "1", "--set", "system=5", "arithmetic=7").out == "A(5,7)\nA(10,14)\n"


def test_float_arithmetic_falls_into_the_trap_that_exact_arithmetic_avoids(shell):
    assert shell("derive", "P5", "-n", "4", "--counts").out.split()[-1] == "7"
    assert shell("derive", "P5", "-n", "4", "--counts", "--arithmetic", "float").out.split()[-1] == "5"
    assert len(shell("derive", "P5", "-n", "4", "--arithmetic", "float").out.splitlines()[-1].split(")")) - 1 == 5


def test_counts_are_known_far_beyond_the_module_limit(shell):
    assert shell("derive", "K5", "-n", "300", "--counts").out.splitlines()[-1] == str((5**301 - 3) // 2)


@pytest.mark.slow
def test_counts_may_have_more_digits_than_python_likes_to_print(shell, model):
    last = shell("derive", model("axiom: A\nA -> AA\n"), "-n", "20000", "--counts").out.splitlines()[-1]
    assert len(last) == 6021
    assert last.startswith("3980276840")  # 2^20000


@pytest.mark.slow
def test_counts_of_ever_new_modules_end(shell, model):
    from lsys_kit.budget import limits

    with limits(seconds=0.2):
        said = shell("derive", model("axiom: A(0)\nA(x) -> A(x/2) A(x/2+1)\n"), "-n", "100", "--counts")
    assert said.status == BAD_INPUT
    assert "seconds" in said.err


def test_counts_where_neighbours_or_chance_have_a_say_are_those_of_the_words(shell):
    assert shell("derive", "P9", "-n", "6", "--counts").out.split() == ["3", "3", "3", "5", "9", "15", "19"]
    words = json.loads(shell("derive", "K7", "-n", "6", "--seed", "3", "--json").out)
    counts = shell("derive", "K7", "-n", "6", "--seed", "3", "--counts").out.split()
    assert counts == [str(step["modules"]) for step in words]


def test_counts_of_words_that_must_be_built_keep_to_the_limit(shell):
    said = shell("derive", "K7", "-n", "300", "--counts")
    refused(said, "modules; the limit is", "Use -n 1")
    assert "--counts" not in said.err


def test_a_seed_is_one_plant_and_another_seed_another(shell):
    from lsys_kit import derive, system

    seven = shell("derive", "K7", "-n", "4", "--seed", "7").out
    assert seven == shell("derive", "K7", "-n", "4", "--seed", "7").out
    assert seven.splitlines() == [str(word) for word in derive(system("K7"), 4, seed=7)]
    plants = {shell("derive", "K7", "-n", "4", "--seed", seed).out for seed in ("0", "7", "-7", "123456789012345")}
    assert len(plants) == 4
    assert shell("derive", "K7", "-n", "4").out == shell("derive", "K7", "-n", "4", "--seed", "0").out
    assert shell("derive", "J1", "-n", "4").out == shell("derive", "J1", "-n", "4", "--seed", "7").out


def test_json_is_one_document(shell):
    steps = json.loads(shell("derive", "J1", "-n", "2", "--json").out)
    assert steps[1] == {"step": 1, "modules": 2, "word": "al br"}
    assert [step["step"] for step in steps] == [0, 1, 2]
    assert json.loads(shell("derive", "J1", "-n", "2", "--json", "--counts").out)[2] == {"step": 2, "modules": 3}


def test_an_empty_word_is_an_empty_line(shell, model):
    assert shell("derive", model("axiom: A\nA -> ε\n"), "-n", "2").out == "A\n\n\n"


def test_a_plant_string_is_read_in_its_notation(shell, model):
    text = model("Axiom: I\nI -> I[A]I(I)\nA -> A[I]B\n")
    assert shell("derive", text, "-n", "1", "--notation", "plant-string").out == "I\nI[A]I(I)\n"


def test_one_of_several_systems_in_a_file_is_taken_by_its_name(shell, model):
    file = model("One {\n Angle 4\n Axiom F\n F=F+F\n}\nTwo {\n Angle 4\n Axiom G\n}", "two.l")
    assert shell("derive", file, "-n", "1", "--name", "one").out == "F\nF+F\n"
    assert "Axiom G" in shell("convert", file, "--to", "fractint", "--name", "Two").out
    assert shell("derive", file, "-n", "1").err.startswith("lsys-kit: There are 2 systems in this text (line 6, column 1).")
    assert (
        shell("derive", "K5", "-n", "1", "--name", "One").err
        == "lsys-kit: K5 is one system of the catalogue. Leave out --name.\n"
    )


def test_words_of_the_catalogue_are_printed_in_another_notation_if_it_can_hold_them(shell):
    assert shell("derive", "K5", "-n", "1").out == shell("derive", "K5", "-n", "1", "--notation", "plant-string").out
    refused(shell("derive", "P4", "-n", "1", "--notation", "plant-string"), "has no parameters")


# --- links ------------------------------------------------------------------------------------------------------------


def test_link_prints_an_address_that_leads_to_the_model_and_its_settings(shell):
    from lsys_kit import linked, system

    said = shell(
        "link", "J4", "-n", "9", "--set", "lifeTimeA=4", "lifeTimeB=5", "--seed", "3", "--base", "https://example.org/"
    )
    assert said.status == 0
    assert said.out.startswith("https://example.org/#lsys=")
    there = linked(said.out)
    assert (there.system, dict(there.settings)) == (system("J4"), {"step": 9, "seed": 3, "lifeTimeA": 4, "lifeTimeB": 5})
    assert linked(shell("link", "K5", "--angle", "25.7").out).settings["angle"] * 10 == 257


def test_a_map_and_a_file_have_links_too(shell, model):
    from lsys_kit import map_system, read, read_map

    assert read_map(shell("link", "K28").out) == map_system("K28")
    assert read(shell("link", model(FIBONACCI)).out) == read(FIBONACCI)


def test_the_other_commands_read_a_link(shell, tmp_path):
    address = shell("link", "J1").out.strip()
    assert shell("derive", address, "-n", "3") == shell("derive", "J1", "-n", "3")
    assert shell("convert", address, "--to", "mathematica") == shell("convert", "J1", "--to", "mathematica")
    refused(shell("derive", address[:-1], "-n", "3"), "This link is broken", "Copy the whole link again")


def test_link_writes_a_qr_code(shell, tmp_path):
    from lsys_kit import qr_code

    base = "--base", "https://example.org/j4.html"
    said = shell("link", "J4", "-n", "9", *base, "--qr", str(tmp_path / "j4.svg"))
    assert said.err == ""
    assert qr_code(said.out.strip()).svg in (tmp_path / "j4.svg").read_text()
    refused(shell("link", "J4", *base, "--qr", "j4.txt"), "j4.txt", SAID_OF_FLAT)


def test_a_link_that_no_browser_can_open_says_so_and_has_no_qr_code(shell, tmp_path):
    said = shell("link", "J4")
    assert said.out.startswith("#lsys=")
    assert "The kit alone reads this link" in said.err
    assert "--base" in said.err
    refused(shell("link", "J4", "--qr", str(tmp_path / "j4.svg")), "A phone cannot open", "--base", "lsys-kit page")
    assert not (tmp_path / "j4.svg").exists()


def test_link_refuses_what_the_model_has_not(shell):
    refused(shell("link", "J4", "--set", "lifetimeA=4"), "lifeTimeA")
    refused(shell("link", "J4", "--set", "lifeTimeA=lifeTimeA"), "known")
    refused(shell("link", "J4", "--base", "my page"), "%20")
    refused(shell("link", "K28", "--set", "dt=1"), "no constant")


# --- pages ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_page_writes_one_file_and_says_what_it_shows(shell, tmp_path):
    said = shell("page", "J4", "-n", "9", "--set", "lifeTimeA=4", "-o", str(tmp_path / "j4.html"))
    assert (said.status, said.err) == (0, "")
    assert said.out.startswith("Step 9: 5 cells. Al(2)Br(2)")
    text = (tmp_path / "j4.html").read_text("utf-8")
    assert "<title>J4: " in text
    assert said.out.partition(".")[0] in text
    assert '"step":9' in text


@pytest.mark.slow
def test_page_takes_models_of_files_and_links_and_says_what_it_holds(shell, model, tmp_path):
    random = model("n = 3 in 1 .. 4\naxiom: A(n)\nA(t) -> A(t+n) B : 0.5\n")
    said = shell("page", random, "--seed", "7", "-o", str(tmp_path / "a.html"))
    assert "holds" not in said.out  # it throws for itself, whatever the seed
    random = model("n = 3 in 1 .. 4\naxiom: A(n)\nA(t) -> A(t+n) B : 0.5\nA(t) < B -> C\n")
    said = shell("page", random, "--seed", "7", "-o", str(tmp_path / "a.html"))
    assert said.out.endswith("This page holds the seeds 0 to 35.\n")
    assert "<title>model</title>" in (tmp_path / "a.html").read_text("utf-8")
    assert shell("page", shell("link", "K5").out.strip(), "-n", "2", "-o", str(tmp_path / "a.html")).status == 0


@pytest.mark.slow
def test_page_shows_a_map_too(shell, tmp_path):
    said = shell("page", "K28", "-n", "2", "-o", str(tmp_path / "a.html"))
    assert said.out == "Step 2: 9 vertices, 12 walls, 4 cells. ABAB | BABA | ABAB | BABA\n"


@pytest.mark.slow
def test_page_fixes_the_forces_of_cells_that_only_the_kernel_lays_out(shell, tmp_path):
    said = shell("page", "K34", "-n", "1", "-o", str(tmp_path / "a.html"))
    assert said.out.startswith("Step ")
    assert said.out.endswith("Fixed on this page: stiffness = 1, rest = 0, pressure = 0.5, damping = 1.\n")


def test_page_refuses_what_it_cannot_show(shell, tmp_path):
    target = str(tmp_path / "a.html")
    refused(shell("page", "J4", "-o", "j4.htm"), "j4.htm", "end in .html")
    refused(shell("page", "J4", "--set", "lifeTimeA=99", "-o", target), "outside its slider's range")
    refused(shell("page", "J4", "--angle", "x", "-o", target), "x")
    assert not Path(target).exists()


# --- other notations --------------------------------------------------------------------------------------------------


def test_the_rules_behind_words_are_found_and_what_must_be_mended(shell, tmp_path):
    words = tmp_path / "words.txt"
    words.write_text("a\nab\n?\nabaab\n", "utf-8")
    assert shell("infer", str(words)).out.splitlines()[1:] == ["  a -> a b", "  b -> a", "The word of step 2 is a b a."]
    words.write_text("a\nab\naba\nabbab\n", "utf-8")
    assert "letter 3 of step 3, b, were a" in shell("infer", str(words)).out
    words.write_text("ab\naab\naaab\n", "utf-8")
    assert "  a > b -> a a" in shell("infer", str(words), "--context", "0,1").out
    words.write_text("a\nab\n\na\nb\n\na\nab\n", "utf-8")
    assert "a -> a b  (0.667" in shell("infer", str(words), "--stochastic").out
    assert "The context is two whole numbers" in shell("infer", str(words), "--context", "1").err
    assert "cannot be read" in shell("infer", str(tmp_path / "none.txt")).err


def test_convert_prints_the_same_system_in_another_notation(shell):
    from lsys_kit import read, system

    said = shell("convert", "K5", "--to", "plant-string")
    assert said == Said(0, "turtle: abop\nangle: 25.7\nsteps: 4\nAxiom: F\nF -> F[+F]F[-F]F\n", "")
    assert read(said.out, "plant-string") == system("K5")


def test_convert_leaves_the_interpretation_out_where_that_is_asked(shell):
    assert "--no-interpretation" in shell("convert", "J4", "--to", "mathematica").err
    said = shell("convert", "J4", "--to", "mathematica", "--no-interpretation")
    assert said.status == 0
    assert read(said.out) == replace(system("J4"), interpretation=())


def test_what_was_converted_converts_back(shell, model):
    there = shell("convert", "L1", "--to", "plant-string").out
    back = shell("convert", model(there), "--from", "plant-string", "--to", "plant-string").out
    assert back == there


@pytest.mark.slow
def test_convert_reads_the_standard_input():
    done = process("convert", "-", "--to", "plant-string", given=b"axiom: a\r\na -> b a")
    assert (done.returncode, done.stdout.split(), done.stderr) == (0, b"turtle: abop Axiom: a a -> ba".split(), b"")


def test_what_the_reader_has_to_tell_goes_to_the_other_stream(shell, model):
    said = shell("convert", model("axiom: F\nF -> FF\nG -> F\n"), "--to", "abop")
    assert said.out == "axiom: F\nF -> F F\nG -> F\n"
    assert said.err.splitlines() == [
        'lsys-kit: note: "FF" is read as F F.',
        "lsys-kit: note: The production G can never match: no module G occurs.",
    ]


def test_a_converted_model_goes_into_a_new_file(shell, tmp_path):
    path = tmp_path / "plant.txt"
    assert shell("convert", "K5", "--to", "abop", "--output", str(path)).status == 0
    assert path.read_text(encoding="utf-8") == shell("convert", "K5", "--to", "abop").out


def test_a_file_that_is_there_is_never_overwritten(shell, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("mine.txt").write_text("mine\n")
    refused(shell("convert", "K5", "--to", "abop", "--output", "mine.txt"), '"mine.txt" already exists', "overwritten")
    assert Path("mine.txt").read_text() == "mine\n"
    (tmp_path / "link").symlink_to(tmp_path / "nowhere")
    refused(shell("convert", "K5", "--to", "abop", "--output", str(tmp_path / "link")), "already exists")
    refused(shell("convert", "K5", "--to", "abop", "--output", str(tmp_path)), "already exists")
    assert not (tmp_path / "nowhere").exists()


def test_a_model_that_cannot_be_converted_leaves_no_file(shell, tmp_path):
    path = tmp_path / "out.txt"
    refused(shell("convert", "P4", "--to", "plant-string", "-o", str(path)), "plant-string has no parameters")
    assert not path.exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["P4"], ["--to"]),
        (["P4", "--to", "abob"], ['no notation called "abob"', "Notations are: abop"]),
        (["P4", "--to", "abop", "--from", "abob"], ['no notation called "abob"']),
        (["P4", "--to", "plant-string"], ["The notation plant-string has no parameters, which this system needs"]),
        (["P44", "--to", "abop"], ['no file "P44"', 'Did you mean "P4"?']),
        (["P4", "--to", "abop", "-o", "/no/such/folder/out.txt"], ["cannot be written", "No such file"]),
        (["P4", "--to", "abop", "-o", "a\0b"], ["cannot be written"]),
    ],
)
def test_a_conversion_that_cannot_be_is_one_message(shell, arguments, words):
    refused(shell("convert", *arguments), *words)


def test_a_mistake_in_a_model_to_be_converted_is_shown_with_its_place(shell, model):
    said = shell("convert", model("axiom: A\nA -> B(t)\n"), "--to", "abop")
    refused(said, "(line 2, column 8)")
    assert said.err.splitlines()[1:] == ["  A -> B(t)", "         ^"]


def test_the_help_of_convert_shows_an_example_that_works(shell, monkeypatch, tmp_path):
    monkeypatch.setenv("COLUMNS", "200")
    example = next(line for line in shell("convert", "--help").out.splitlines() if line.startswith("Example: lsys-kit "))
    monkeypatch.chdir(tmp_path)
    assert shell(*example.split()[2:]).status == 0
    assert [path.name for path in tmp_path.iterdir()] == ["plant.txt"]


# --- pictures ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("ending", "start"), beginnings(*FLAT))
def test_draw_writes_the_format_that_the_name_ends_in(shell, tmp_path, ending, start):
    said = shell("draw", "K5", "-n", "3", "-o", str(tmp_path / f"out{ending}"))
    assert said.status == 0
    assert "125 segments" in said.out
    assert (tmp_path / f"out{ending}").read_bytes().startswith(start)


def test_draw_turns_by_another_angle(shell, tmp_path):
    shell("draw", "K5", "-n", "3", "-o", str(tmp_path / "a.svg"))
    shell("draw", "K5", "-n", "3", "-o", str(tmp_path / "b.svg"), "--angle", "40.5")
    assert (tmp_path / "a.svg").read_text() != (tmp_path / "b.svg").read_text()


def test_draw_draws_the_plant_of_a_seed(shell, tmp_path):
    for name, seed in (("a", "1"), ("b", "1"), ("c", "2")):
        assert shell("draw", "K7", "-n", "3", "--seed", seed, "-o", str(tmp_path / f"{name}.svg")).status == 0
    one, same, other = ((tmp_path / f"{name}.svg").read_text() for name in "abc")
    assert one == same != other


def test_stages_writes_the_diagram_with_the_tokens_of_a_step(shell, tmp_path):
    path = tmp_path / "net.svg"
    assert shell("stages", "P4", "-o", str(path)).status == 0
    first = path.read_text()
    assert first.startswith("<svg")
    assert shell("stages", "P4", "-n", "9", "-o", str(path)).status == 0
    assert path.read_text() != first


def test_stages_writes_a_net_for_petri_net_tools(shell, tmp_path):
    path = tmp_path / "net.pnml"
    assert shell("stages", "P4", "-n", "9", "-o", str(path)).status == 0
    assert path.read_text().startswith('<?xml version="1.0" encoding="UTF-8"?>\n<pnml xmlns="http://www.pnml.org/')


def test_stages_tells_how_long_cells_live(shell, tmp_path):
    path = tmp_path / "net.svg"
    assert "2 stages M(0), M(0.2); tokens 2, 5" in shell("stages", "P7", "-n", "4", "--durations", "-o", str(path)).out
    assert "after 0.8" in path.read_text()
    refused(shell("stages", "J1", "--durations", "-o", str(path)), "How long a module lives cannot be told", "lets time pass")


def test_a_net_that_other_programs_play_otherwise_says_so_in_a_line(shell, tmp_path):
    path = str(tmp_path / "net.pnml")
    assert shell("stages", "J4", "-o", path).err == ""
    assert shell("stages", "K16", "-o", path).err == (
        "lsys-kit: note: Programs for Petri nets play this net otherwise than the system grows: "
        'they know no condition such as "s < a".\n'
    )
    assert shell("stages", "K16", "-o", str(tmp_path / "net.svg")).err == ""


@pytest.mark.slow
def test_stages_unfolds_all_symbols_or_some(shell, tmp_path):
    path = str(tmp_path / "net.svg")
    assert "5 stages A, I, F" in shell("stages", "K19", "-o", path).out
    assert "12 stages A(0), A(1)" in shell("stages", "K19", "--unfold", "A", "-o", path).out
    assert "32 stages A(0), A(1)" in shell("stages", "K19", "-o", path, "--unfold").out
    refused(shell("stages", "K19", "--unfold", "A,leaf", "-o", path), 'no symbol "leaf" here', "Symbols are: A, F, I, K, L.")
    assert "Stages A(7): 0, A(0): 1" in shell("page", "K19", "--unfold", "A", "-n", "1", "-o", str(tmp_path / "k19.html")).out
    refused(shell("page", "K28", "--unfold", "-o", str(tmp_path / "k28.html")), "Only the stages of an L-system")


def test_a_picture_goes_nowhere_else(shell, tmp_path):
    refused(shell("draw", "K5", "-n", "2", "-o", "out.bmp"), SAID_OF_DRAWINGS, ".gif")
    refused(shell("stages", "P4", "-o", "out.bmp"), ".svg", ".png", ".pnml")
    refused(shell("stages", "P4", "-o", str(tmp_path / "no" / "out.svg")), "cannot be written", "No such file")


# --- bad input --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], ["COMMAND"]),
        (["grow"], ["grow", "derive"]),
        (["derive"], ["SYSTEM", "-n"]),
        (["derive", "P4"], ["-n"]),
        (["derive", "P4", "-n", "two"], ["whole number", '"two"']),
        (["derive", "P4", "-n", "-1"], ["whole number", '"-1"']),
        (["derive", "P4", "-n", "1.5"], ["whole number"]),
        (["derive", "P4", "-n", "9" * 5000], ["whole number"]),
        (["derive", "P4", "-n", "1", "--set", "dt"], ["NAME=VALUE"]),
        (["derive", "P4", "-n", "1", "--set", "dt=1"], ['no constant "dt"', "LEFT, RIGHT"]),
        (["derive", "P5", "-n", "1", "--set", "dt=fast"], ["fast"]),
        (["derive", "P5", "-n", "1", "--set", "dt=1/0"], ["zero"]),
        (["derive", "J4", "-n", "1", "--set", "lifetimeA=2"], ['Did you mean "lifeTimeA"?']),
        (["derive", "K7", "-n", "1", "--seed", "seven"], ["--seed", "whole number", '"seven"']),
        (["derive", "K7", "-n", "1", "--seed", "1.5"], ["whole number", '"1.5"']),
        (["derive", "K7", "-n", "1", "--seed", "9" * 5000], ["whole number"]),
        (["derive", "K7", "-n", "1", "--seed"], ["--seed"]),
        (["derive", "P4", "-n", "1", "--arithmetic", "decimal"], ["exact", "float"]),
        (["derive", "P4", "-n", "1", "--notation", "abob"], ['no notation called "abob"', "abop"]),
        (["derive", "P44", "-n", "1"], ['no file "P44"', 'Did you mean "P4"?']),
        (["derive", "pseudo-plants", "-n", "1"], ['no file "pseudo-plants"', 'Did you mean "pseudo-plant"?']),
        (["derive", "zebra", "-n", "1"], ['no file "zebra"', "Catalogue ids are", "P4"]),
        (["derive", ".", "-n", "1"], ["There is no model in"]),
        (["derive", "a\0b", "-n", "1"], ["cannot be read"]),
        (["derive", "x" * 5000, "-n", "1"], ["cannot be read"]),
        (["derive", "\udc80\x1b[2J", "-n", "1"], ["no file"]),
        (["draw", "K5", "-n", "2", "-o", "out.svg", "--angle", "wide"], ["wide"]),
    ],
)
def test_a_mistake_on_the_command_line_is_one_message(shell, arguments, words):
    said = shell(*arguments)
    refused(said, *words)
    assert "\x1b" not in said.err


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("axiom: A\nA -> B(t)\n", ["(line 2, column 8)", "^"]),
        ("axiom: A\nA -> [B\n", ["(line 2", "^"]),
        ("axiom: A\nA B\n", ["(line 2", "arrow", "^"]),
        ("axiom: A\nA ->\n", ["(line 2", 'write "ε"', "^"]),
        ("axiom: A(1)\nA(t) : t + 1 -> A(t)\n", ["(line 2, column 8)", "true or false", "^"]),
        ("", ["axiom"]),
    ],
)
def test_a_mistake_in_a_model_is_shown_with_its_place(shell, model, text, words):
    refused(shell("derive", model(text), "-n", "1"), *words)


def test_the_line_quoted_from_a_windows_file_is_as_typed(shell, model):
    assert shell("derive", model("axiom: A\r\nA -> B(\r\n"), "-n", "1").err.splitlines()[1:] == ["  A -> B(", "         ^"]


def test_a_file_that_is_not_there_is_suggested_from_its_neighbours(shell, model):
    path = model(FIBONACCI, "fibonacci.txt")
    refused(shell("derive", path.replace("nacci", "nacii"), "-n", "1"), f'Did you mean "{path}"?')


def test_a_file_that_is_not_text_is_refused(shell, model):
    refused(shell("derive", model(b"axiom: A\nA -> \xff\n"), "-n", "1"), "UTF-8", "byte 15")


def test_what_another_program_wrote_is_called_so_and_the_name_of_a_file_is_a_hint(shell, model):
    refused(
        shell("derive", model("#lang lindenmayer racket\n## axiom ##\nF\n", "plant.txt"), "-n", "1"),
        "This is a model in Racket's language lindenmayer, which the kit does not read (line 1, column 1).",
        '"axiom:"',
    )
    refused(
        shell("derive", model("A = (\n", "tree.rgg"), "-n", "1"),
        "line 1",
        'The name ends in ".rgg": perhaps the file is a model in XL, the language of GroIMP, which the kit does not read.',
    )
    assert shell("derive", model("axiom: A\nA -> A B\n", "fine.lpy"), "-n", "1").out == "A\nA B\n"
    said = shell("derive", model("import turtle\n", "tree.py"), "-n", "1").err
    assert said.count("which the kit does not read") == 1


def test_a_file_in_utf_16_with_its_mark_is_read(shell, model):
    assert shell("derive", model("axiom: A\nA -> A B\n".encode("utf-16")), "-n", "1").out == "A\nA B\n"
    refused(shell("derive", model("axiom: A\nA -> A B\n".encode("utf-16-le")), "-n", "1"), "zero bytes", "UTF-8")


def test_a_file_that_never_ends_is_refused(shell):
    refused(shell("derive", "/dev/zero", "-n", "1"), "limit is 1,000,000")


def test_a_step_past_the_size_limit_says_how_far_one_can_go(shell):
    refused(shell("derive", "K5", "-n", "30"), "Step 10 would have 24,414,061 modules", "-n 9", "--counts")


@pytest.mark.slow
def test_a_message_of_a_model_is_no_traceback_in_a_real_process(model):
    done = process("derive", model("axiom: A\nA -> B(\n"), "-n", "1")
    assert (done.returncode, done.stdout) == (BAD_INPUT, b"")
    assert done.stderr.count(b"\n") == 3
    assert b"Traceback" not in done.stderr


# --- the process ------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_reader_that_goes_away_is_no_fault():
    derive = subprocess.Popen(
        [sys.executable, "-m", "lsys_kit", "derive", "K5", "-n", "8"], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert derive.stdout is not None
    assert derive.stderr is not None
    assert derive.stdout.readline() == b"F\n"
    derive.stdout.close()
    assert derive.stderr.read() == b""
    derive.stderr.close()
    assert derive.wait(60) == BROKEN_PIPE


def test_an_interruption_is_quiet(shell, monkeypatch):
    class Interrupted:
        @property
        def buffer(self):
            raise KeyboardInterrupt

    monkeypatch.setattr(sys, "stdin", Interrupted())
    assert shell("derive", "-", "-n", "1") == Said(INTERRUPTED, "", "")


@pytest.mark.slow
def test_the_shell_starts_without_what_it_does_not_need():
    needless = {"numpy", "sympy", "matplotlib", "ipywidgets", "PIL"}
    assert loaded_by("import lsys_kit.__main__") & {*needless, "lark"} == set()
    assert loaded_by("from lsys_kit.__main__ import main; main(['list'])") & needless == set()
    assert loaded_by("from lsys_kit.__main__ import main; main(['derive', 'P4', '-n', '2'])") & (needless - {"numpy"}) == set()


def loaded_by(code: str) -> set[str]:
    """The modules that some code loads in a new process."""
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        capture_output=True,
        text=True,
        timeout=300,
        check=True,
    )
    return set(done.stdout.splitlines()[-1].split())


def test_list_names_every_system(shell):
    from lsys_kit import book_systems, cellwork_systems, map_systems, systems

    rows = [line.split()[0] for line in shell("list").out.splitlines() if line.startswith("  ")]
    assert rows == [*systems(), *book_systems(), *map_systems(), *cellwork_systems()]


def test_draw_draws_maps_too(shell, tmp_path):
    for name in ("k30", "map-spiral-divisions"):
        said = shell("draw", name, "-n", "2", "-o", str(tmp_path / "map.svg"))
        assert (said.status, said.out) == (0, "steps 0 to 2; the last: 8 vertices, 10 walls, 3 cells\n")
    assert (tmp_path / "map.svg").read_text().startswith("<svg")


def test_help_names_every_command(shell):
    assert all(command in shell("--help").out for command in ("list", "derive", "draw", "stages", "convert", "lab"))


def test_the_lab_without_jupyterlab_says_how_to_get_it(shell, monkeypatch, tmp_path):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    said = shell("lab", str(tmp_path / "course"))
    assert said.status == BAD_INPUT
    assert "pip install 'lsys-kit[lab]'" in said.err
    assert "The course is in" in said.out


# --- the site ---------------------------------------------------------------------------------------------------------


def test_a_site_is_not_written_over_what_is_not_the_kits(shell, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a message names no long path in full
    (tmp_path / "index.html").write_text("mine")
    said = shell("site", "-o", ".")
    assert said.status == BAD_INPUT
    assert "index.html" in said.err
    assert "was not made by the kit" in said.err
    assert (tmp_path / "index.html").read_text() == "mine"


# --- hard limits ------------------------------------------------------------------------------------------------------


def left_alone(doing: str, **limits: float) -> subprocess.CompletedProcess[str]:
    """The command `list` as a process of its own, where it does something that looks at no budget."""
    code = (
        f"import sys\nfrom lsys_kit import __main__ as shell, limits\ndef endless(_):\n    {doing}\n"
        f"shell.commands.list_systems = endless\nsys.argv = ['lsys-kit', 'list']\n"
        f"with limits(**{limits}):\n    sys.exit(shell.run())"
    )
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=False)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="a process is limited as on Linux")
@pytest.mark.parametrize(
    ("doing", "limits", "said"),
    [
        ("while True: pass", {"seconds": 0.1}, "The command was not finished in 1 seconds. Take fewer steps."),
        ("bytearray(2**30)", {"bytes": 2**26}, "The command needs more memory than there is for it. Take fewer steps."),
    ],
)
def test_a_command_that_no_budget_stops_ends_with_a_sentence(doing, limits, said):
    done = left_alone(doing, **limits)
    assert (done.returncode, done.stdout, done.stderr) == (BAD_INPUT, "", f"lsys-kit: {said}\n")


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="a process is limited as on Linux")
@pytest.mark.parametrize(
    ("command", "limited"),
    [
        ("draw", (True, True)),
        ("derive", (True, True)),
        ("site", (True, False)),
        ("collect", (True, False)),
        ("lab", (False, False)),
    ],
)
def test_each_command_has_the_limits_of_its_kind(command, limited):
    code = (
        "import resource as r\nfrom lsys_kit.commands import set_hard_limits\n"
        f"set_hard_limits({command!r})\n"
        "print(*(r.getrlimit(kind)[0] != r.RLIM_INFINITY for kind in (r.RLIMIT_DATA, r.RLIMIT_CPU)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=True)
    assert done.stdout.split() == [str(each) for each in limited]


@pytest.mark.skipif(sys.platform != "linux", reason="a process is limited as on Linux")
def test_a_command_within_another_process_leaves_its_limits_as_they_are(shell):
    import resource

    kinds = resource.RLIMIT_DATA, resource.RLIMIT_CPU, resource.RLIMIT_AS
    before = [*map(resource.getrlimit, kinds)]
    shell("derive", "J1", "-n", "1")
    assert [*map(resource.getrlimit, kinds)] == before
