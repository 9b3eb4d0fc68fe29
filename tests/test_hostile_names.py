"""Text is text: whatever a person calls things, no output makes markup, a formula or a command of it.

Names come in two ways: typed, so that the readers see them first and refuse most; and in records made by hand, so that the
outputs are alone with them.
"""

from __future__ import annotations

import contextlib
import io
import json
import string
import struct
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from html.parser import HTMLParser
from types import SimpleNamespace

import pytest
from matplotlib.figure import Figure

from lsys_kit import LSystemError, animate, check, derive, draw, explain, explore, figure, growth, read, stages, system, write
from lsys_kit.__main__ import main
from lsys_kit.classroom import magic
from lsys_kit.classroom.exercises.registry import kit_questions
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.classroom.magic import shown, underlined
from lsys_kit.classroom.panel.word_view import word_html
from lsys_kit.notation.model.expressions import Apply, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Constant, LSystem, Production
from lsys_kit.notation.read import read_word
from lsys_kit.notation.registry import DIALECTS
from tests.endings import DRAWINGS, FILMS, MESHES

HOSTILE = [
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "' onmouseover='alert(1)",
    '" style="background:url(javascript:alert(1))',
    "<svg/onload=alert(1)>",
    "</title><script>alert(1)</script>",
    "</style></svg><iframe src=//evil>",
    "<!--",
    "-->",
    "]]>",
    "<![CDATA[x]]>",
    "<?xml version='1.0'?>",
    "&lt;b&gt;",
    "&#60;b&#62;",
    "&amp;amp;",
    r"$\frac{1}{0}$",
    "cost $5 and $6",
    r"\(x^2\)",
    r"\[x\]",
    r"\end{document}",
    r"\input{/etc/passwd}",
    "$$",
    "{{7*7}}",
    "${7*7}",
    "%s%n{0}{x}",
    "javascript:alert(1)",
    "__import__('os').system('x')",
    "a\u202egnp.exe",
    "a\u200bb\u2060c\ufeff",
    "e\u0301\u0302\u0303\u0304\u0305" * 3,
    "\x1b[31mred\x1b[0m",
    "a\nnewmtl b",
    "a\0b",
    "\ud800",
    "x" * 500,
    "'\"`",
    "(*/* //# comment",
]
"""Markup, formulas, templates, marks that turn text around, controls, lone surrogates, quotes, sheer length."""

TAGS = {"b", "br", "div", "i", "pre", "span", "sub", "sup", "table", "tbody", "td", "tr", "u"}
ATTRIBUTES = {"aria-hidden", "aria-label", "class", "colspan", "role", "style", "tabindex"}
SVG_TAGS = {
    "circle",
    "ellipse",
    "g",
    "image",
    "line",
    "path",
    "polygon",
    "polyline",
    "rect",
    "svg",
    "text",
    "title",
    "tspan",
    "defs",
    "marker",
}
SVG_ATTRIBUTES = {
    "aria-label",
    "class",
    "cx",
    "cy",
    "d",
    "dx",
    "dy",
    "fill",
    "fill-opacity",
    "font-family",
    "font-size",
    "font-style",
    "font-weight",
    "height",
    "id",
    "marker-end",
    "points",
    "r",
    "role",
    "rx",
    "ry",
    "stroke",
    "stroke-dasharray",
    "stroke-linecap",
    "stroke-linejoin",
    "stroke-opacity",
    "stroke-width",
    "style",
    "text-anchor",
    "transform",
    "viewBox",
    "width",
    "x",
    "x1",
    "x2",
    "y",
    "y1",
    "y2",
}


class Page(HTMLParser):
    """Reads HTML as a browser would, and notes elements, attributes, and text that MathJax would look at."""

    def __init__(self, html: str) -> None:
        super().__init__(convert_charrefs=True)
        self.tags: set[str] = set()
        self.attributes: set[str] = set()
        self.styles: list[str] = []
        self.said: list[str] = []
        self.looked_at: list[str] = []
        self._open: list[bool] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}
        self.styles += [value or "" for name, value in attrs if name == "style"]
        plain = tag == "pre" or "mathjax_ignore" in (dict(attrs).get("class") or "")
        if tag != "br":
            self._open.append(plain or any(self._open))

    def handle_endtag(self, tag: str) -> None:
        self._open.pop()

    def handle_data(self, data: str) -> None:
        self.said.append(data)
        if not any(self._open):
            self.looked_at.append(data)

    def handle_comment(self, data: str) -> None:
        self.tags.add("!--")

    def handle_decl(self, decl: str) -> None:
        self.tags.add("!")

    def handle_pi(self, data: str) -> None:
        self.tags.add("?")


def check_html(html: str, formulas: bool = True) -> None:
    page = Page(html)
    assert page.tags <= TAGS
    assert page.attributes <= ATTRIBUTES
    assert not [style for style in page.styles if "url" in style or "expression" in style]
    assert_printable("".join(page.said))
    if formulas:
        assert not set("".join(page.looked_at)) & set("$\\")


def check_svg(svg: str) -> None:
    """It is well-formed, and every element and attribute is the kit's own."""
    for element in ET.fromstring(svg).iter():
        assert element.tag.removeprefix("{http://www.w3.org/2000/svg}") in SVG_TAGS
        assert {name for name in element.attrib if not name.startswith("data-")} <= SVG_ATTRIBUTES
        assert "url" not in (element.get("style") or "")
        assert_printable((element.text or "") + (element.get("aria-label") or ""))


def assert_printable(text: str) -> None:
    assert all(character.isprintable() or character in "\n\u00a0\u2009" for character in text)


def refused(attempt: Callable[[], object]) -> object:
    """What comes of an attempt; an error of the kit that can be printed, or a result."""
    try:
        return attempt()
    except LSystemError as mistake:
        error = mistake
    assert_printable(str(error))
    assert len(str(error)) < 2_000
    check_html(underlined(error, error.source or "")["text/html"])
    return None


def typed(text: str) -> Iterator[str]:
    """Models in which a text stands wherever a person could have put it."""
    yield text
    yield f"axiom: {text}\n{text} -> {text}"
    yield f"axiom: A{text}B"
    yield f"{text} = 1 in 0 .. 2\naxiom: A({text})\nA({text}) -> A({text} + 1)"
    yield f"axiom: A(1)\nA(t) : {text} -> B"
    yield f"axiom: A(1)\nA(t) -> A({text})"
    yield f"axiom: A\nA -> B : {text}"
    yield f"/* {text} */\naxiom: A\nA -> A B /* {text} */"
    yield f"alphabet: {text}\nangle: {text}\naxiom: A\nignore: {text}"
    yield f"#define {text} 1\nAxiom: {text}\n{text} --> {text} [{text}]\nhomomorphism\n{text} --> {text}"
    yield f"\\var {text} uniform 0 1,\n* # {text},\n{text} # {text} [ {text} ],"
    yield f'AXIOM[{text}]; LRULES[LRule[LEFT[], PRED[{text}], RIGHT[], SUCC[{text}, "{text}"]]]'


def made(text: str) -> LSystem:
    """A system made by hand, all of whose names are a text."""
    name, t = Name(text), Pattern(text, (Name(text),))
    grown = Pattern(text, (Apply("+", (name, Number(1))),))
    return LSystem(
        (Pattern(text, (Number(1),)), Pattern("F")),
        (
            Production((t,), (grown, Pattern("F"), Pattern("[["), Pattern(text + "_r"))),
            Production((t,), (grown,), Apply("<", (name, Number(5))), left=(Pattern(text + "_l"),), probability=Number(1)),
        ),
        (Constant(f"{text}2", Number(1), (Number(0), Number(2), Number(1))),),
        notes=(f"A note on {text}.",),
    )


def shows(found: LSystem) -> None:
    """Every output of a system is the kit's own markup, with the names as text."""
    bundle = refused(lambda: shown(found, "system"))
    if bundle is not None:
        check_html(bundle["text/html"])
    derivation = refused(lambda: derive(found, 2))
    if derivation is not None:
        check_html(word_html(derivation[-1]), formulas=False)  # stands in a box, or in a widget, which knows no formulas
        refused(lambda: str(explain(derivation, 1)))
    for what in (lambda: draw(found, 2), lambda: draw(stages(found)), lambda: draw(stages(found), positions=True)):
        picture = refused(what)
        if picture is not None:
            check_svg(refused(lambda picture=picture: picture.svg) or "<svg/>")
            assert_printable(repr(picture))
    refused(lambda: repr(growth(found)))
    for notation in DIALECTS:
        refused(lambda notation=notation: write(found, notation))


@pytest.mark.slow
@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_what_is_typed_is_refused_or_shown_as_text(text):
    for model in typed(text):
        for notation in (None, *DIALECTS):
            found = refused(lambda model=model, notation=notation: read(model, notation))
            if found is not None:
                assert_printable("".join(found.notes))
                shows(found)


@pytest.mark.slow
def test_every_sign_that_may_be_a_symbol_is_shown_as_text():
    found = [
        system
        for sign in string.punctuation
        for system in [refused(lambda sign=sign: read(f"axiom: A {sign} B {sign}\nA -> {sign} A {sign}"))]
        if system
    ]
    for each in found:
        shows(each)
    assert {"$", "&", "'", ";", "\\", "%"} <= {module.symbol for each in found for module in each.axiom}


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_outputs_escape_names_of_records_made_by_hand(text):
    shows(made(text))
    check_html(magic._box(made(text), text, [text], derive(made(text), 1)))
    check_svg(draw(stages(made(text)), tokens=derive(made(text), 1)[-1]).svg)


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_the_explorer_shows_names_as_text(text):
    import ipywidgets

    panel = refused(lambda: explore(made(text), 1))
    if panel is None:
        return
    found = [panel]
    while found:
        widget = found.pop()
        found += getattr(widget, "children", ())
        if isinstance(widget, ipywidgets.HTML):
            if "<svg" in widget.value:
                check_svg(widget.value)
            else:
                check_html(widget.value, formulas=False)
        if getattr(widget, "svg", None):
            check_svg(widget.svg)
        assert not getattr(widget, "description_allow_html", False)


@pytest.mark.slow
@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_an_answer_is_shown_as_text(text):
    for exercise in {each.kind: each.id for _, _, each in kit_questions().exercises}.values():
        verdict = refused(lambda exercise=exercise: check(exercise, text, solution=True))
        check_html(verdict._repr_html_())
    for said in (text, f"Your {text} is {text}.\n  {text}\nand {text}"):
        check_html(Verdict("Not yet", said)._repr_html_())


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_a_cell_of_a_notebook_shows_its_text_as_text(text):
    shell = SimpleNamespace(user_ns={}, user_ns_hidden={}, push=lambda names: None)
    for line, cell in (
        (text, "axiom: A"),
        ("plant", text),
        (f"plant {text}", "axiom: A"),
        ("", f"axiom: {text}\nA -> {text}"),
        ("", f"axiom: A\n{text}\nA -> B"),
    ):
        check_html(magic._cell_output(shell, line, cell)["text/html"])


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_a_name_that_is_asked_for_is_named_or_refused(text):
    koch = system("T2")
    for attempt in (
        lambda: system(text),
        lambda: explore(text),
        lambda: check(text, "a"),
        lambda: check("1.1", text),
        lambda: read("axiom: A", text),
        lambda: write(koch, text),
        lambda: read_word(text),
        lambda: draw(koch, 1, angle=text),
        lambda: animate(koch, 1, seconds=text),
        lambda: derive(koch, 1, **{text: 1}),
        lambda: derive(koch, 1, seed=text),
        lambda: derive(koch, 1, arithmetic=text),
        lambda: derive(read("c = 1\naxiom: A(c)"), 1, c=text),
    ):
        refused(attempt)


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_files_for_other_programs_hold_no_names(text, tmp_path):
    picture = refused(lambda: draw(made(text), 2))
    if picture is None:
        return
    for ending in DRAWINGS:
        picture.save(tmp_path / f"a{ending}")
        content = (tmp_path / f"a{ending}").read_bytes()
        assert len(text) < 4 or text.encode("utf-8", "replace") not in content
    content = (tmp_path / "a.glb").read_bytes()
    tree = json.loads(content[20 : 20 + struct.unpack("<I", content[12:16])[0]])
    assert {material["name"][0] for material in tree["materials"]} == {"#"}


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_a_file_may_have_any_name_or_is_refused(text, tmp_path):
    for ending in (".svg", *MESHES, FILMS[0]):
        refused(lambda ending=ending: draw(system("T2"), 1).save(tmp_path / f"{text.replace('/', '-')}{ending}"))
    for path in tmp_path.glob("*.obj"):
        lines = path.read_text().splitlines()
        assert {line.split(" ")[0] for line in lines} == {"#", "mtllib", "v", "vn", "usemtl", "f"}
        assert sum(line.startswith("mtllib") for line in lines) == 1
        assert (tmp_path / lines[1].removeprefix("mtllib ")).exists()


@pytest.mark.slow
@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_matplotlib_reads_no_formula(text):
    if refused(lambda: draw(made(text), 2)) is None:
        return
    sheet = Figure()
    ax = figure(draw(made(text), 2), sheet.add_subplot())
    sheet.savefig(io.BytesIO(), format="svg")
    assert not [
        label
        for label in ax.findobj(lambda artist: hasattr(artist, "get_parse_math"))
        if label.get_text() and label.get_parse_math() and set("$\\") & set(label.get_text())
    ]


@pytest.mark.slow
@pytest.mark.parametrize("text", [text for text in HOSTILE if "\0" not in text and text != "\ud800"], ids=ascii)
def test_the_shell_prints_nothing_that_a_terminal_obeys(text, tmp_path, capsys):
    (tmp_path / "model.txt").write_text(f"axiom: A\nA -> {text}\n")
    for arguments in (
        ["derive", text, "-n", "1"],
        ["derive", "J1", "-n", text],
        ["draw", "J1", "-n", "1", "-o", text],
        ["derive", "J1", "-n", "1", "--set", text],
        ["derive", "J1", "-n", "1", "--set", f"{text}=1"],
        ["derive", "J1", "-n", "1", "--notation", text],
        ["convert", "J1", "--to", text],
        [text],
        ["list", text],
        ["derive", str(tmp_path / "model.txt"), "-n", "2"],
        ["convert", str(tmp_path / "model.txt"), "--to", "abop"],
        ["link", text],
        ["link", "J1", "--base", text],
        ["link", "J1", "--qr", text],
        ["link", "J1", "--set", f"{text}=1"],
        ["page", "J1", "-o", text],
        ["derive", "J1", "-n", "1", "--seed", text],
        ["derive", "J1", "-n", "1", "--arithmetic", text],
        ["draw", "J1", "-n", "1", "-o", "a.gif", "--seconds", text],
    ):
        with contextlib.suppress(SystemExit):
            main(arguments)
        said = capsys.readouterr()
        assert "Traceback" not in said.err
        assert_printable(said.err)
        assert_printable(said.out)


def test_the_checks_see_what_they_should():
    for html in (
        "<script>1</script>",
        '<b onclick="x">',
        "<img src=x>",
        "cost $5",
        '<b style="background:url(x)">a</b>',
        "\u202e",
    ):
        with pytest.raises(AssertionError):
            check_html(html)
    check_html('<div class="lsys mathjax_ignore"><b>$5</b></div>')
    for svg in ("<svg><script/></svg>", '<svg onload="x"/>', "<svg><title>\u202e</title></svg>"):
        with pytest.raises(AssertionError):
            check_svg(svg)
