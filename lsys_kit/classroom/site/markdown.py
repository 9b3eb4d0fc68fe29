"""The Markdown of a notebook as HTML: links lead to pages of the site, mathematics becomes MathML, and of HTML
only a few plain tags pass.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterable
from dataclasses import dataclass
from html import escape, unescape
from pathlib import PurePosixPath
from posixpath import normpath
from types import ModuleType

from lsys_kit.classroom.lessons.widget import escaped_lines
from lsys_kit.errors import LSystemError
from lsys_kit.pictures.style.labels import escaped

Links = Callable[[str], str | None]
"""What an address in a notebook becomes on its page; None where nothing is there."""


@dataclass(frozen=True)
class Places:
    """What addresses of links and of pictures become."""

    links: Links
    pictures: Links = lambda address: None

    def __call__(self, address: str) -> str | None:
        return self.links(address)


PLAIN_TAGS = ("br", "details", "sub", "summary", "sup")
"""The tags of HTML that notebooks may use in their texts, without attributes."""
MOST_WHOLE = 24
"""So many characters of code at most stay in one line, so that no rule is broken within its arrow."""
_FLAT = re.compile(r"\\left\(([^\\]*+)\\right\)")
_PLAIN_TAG = re.compile(rf"&lt;(/?(?:{'|'.join(PLAIN_TAGS)}))&gt;")


def markdown_html(text: str, links: Links, after: Callable[[str], str] = lambda block: "") -> str:
    """A cell of Markdown as HTML. Of HTML in it no more passes than the plain tags of `PLAIN_TAGS`. After each of its blocks
    stands what a function makes of the HTML of that. What is long of code is said to be so: it may go on in another line.

    >>> markdown_html("## An *alga*\\n\\n`a -> ab`", lambda address: address)
    '<h2 id="An-alga">An <em>alga</em></h2>\\n<p><code>a -&gt; ab</code></p>\\n'
    >>> markdown_html("<b>no</b> [markup](x.html) [gone](y.html)", {"x.html": "X.html"}.get)
    '<p>&lt;b&gt;no&lt;/b&gt; <a href="X.html">markup</a> gone</p>\\n'
    >>> markdown_html("2&nbsp;cm &lt; `&lt;`", lambda address: address)
    '<p>2\\xa0cm &lt; <code>&amp;lt;</code></p>\\n'
    """
    mistune = _mistune()

    class Renderer(mistune.HTMLRenderer):  # type: ignore[misc, name-defined]
        def __call__(self, tokens: Iterable[object], state: object) -> str:
            blocks = (self.render_token(each, state) for each in tokens)
            return "".join(block + after(block) for block in blocks)

        def text(self, text: str) -> str:
            return escape(unescape(text))

        def heading(self, text: str, level: int, **_: object) -> str:
            return f'<h{level} id="{heading_id(text)}">{text}</h{level}>\n'

        def codespan(self, text: str) -> str:
            code = str(super().codespan(text))
            return code.replace("<code", '<code class="long"', 1) if len(text) > MOST_WHOLE else code

        def link(self, text: str, url: str, title: str | None = None) -> str:
            address = links(url)
            return text if address is None else f'<a href="{escaped(address)}">{text}</a>'

        def inline_html(self, html: str) -> str:
            return plain_tags(html)

        def block_html(self, html: str) -> str:
            return plain_tags(html)

        def image(self, text: str, url: str, title: str | None = None) -> str:
            address = links.pictures(url) if isinstance(links, Places) else None
            return text if address is None else f'<img class="picture" alt="{text}" src="{escaped(address)}">'

    renderer = Renderer(escape=True)
    read = mistune.create_markdown(renderer=renderer, plugins=["table", "math"])
    renderer.register("inline_math", lambda _, text: mathml(text))
    renderer.register("block_math", lambda _, text: f'<div class="formula" tabindex="0">{mathml(text, "block")}</div>\n')
    renderer.register("table", lambda _, text: f'<div class="scroll" tabindex="0"><table>\n{text}</table></div>\n')
    renderer.register("table_cell", _table_cell)
    return str(read(text))


def _table_cell(_: object, text: str, align: str | None = None, head: bool = False) -> str:
    """A cell of a table, in which a bar is written with a backslash before it; an empty one heads no column."""
    tag, inside = ("th", ' scope="col"') if head and text else ("td", "")
    return f"<{tag}{inside}>{text.replace(chr(92) + '|', '|')}</{tag}>\n"


def plain_tags(html: str) -> str:
    """HTML with its plain tags; all else in it is text.

    >>> plain_tags("<sup>3</sup><b onclick=x>")
    '<sup>3</sup>&lt;b onclick=x&gt;'
    """
    return _PLAIN_TAG.sub(r"<\1>", escaped_lines(html))


def heading_id(html: str) -> str:
    """What a link to a heading names, as in Jupyter: its text with hyphens for blanks.

    >>> heading_id("2 An <em>alga</em> &amp; more")
    '2-An-alga-&amp;-more'
    """
    return re.sub(r"<[^<>]*>", "", html).strip().replace(" ", "-")


def mathml(latex: str, display: str = "inline") -> str:
    """A formula as MathML, which browsers show without help; one that cannot be read stays as it is written. Parentheses about
    what is no higher than a line are no higher, also where no font has high ones.

    >>> mathml("x^2")
    '<math display="inline"><mrow><msup><mi>x</mi><mn>2</mn></msup></mrow></math>'
    """
    try:
        from latex2mathml.converter import convert
    except ImportError:
        raise missing("latex2mathml") from None
    flat, found = latex.strip().strip("$"), 1
    while found:
        flat, found = _FLAT.subn(r"{(\1)}", flat)
    try:
        made = convert(flat, display=display)
    except Exception:
        return f"<code>{escaped(latex)}</code>"
    return str(made).replace(' xmlns="http://www.w3.org/1998/Math/MathML"', "")


def address_on_site(page: str, pages: Container[str], address: str) -> str | None:
    """Where a link of a notebook leads on the site: to a page of it, or a place on the same page; else nowhere.

    >>> there = {"notebooks/01.ipynb", "exercises/01.ipynb"}
    >>> address_on_site("notebooks/01.ipynb", there, "../exercises/01.ipynb#try")
    '../exercises/01.html#try'
    >>> address_on_site("notebooks/01.ipynb", there, "02.ipynb") is None
    True
    """
    file, _, place = address.partition("#")
    if not file:
        return address
    target = normpath(str(PurePosixPath(page).parent / file))
    if target not in pages:
        return None
    return f"{file.removesuffix('.ipynb')}.html{'#' * bool(place)}{place}"


def missing(package: str) -> LSystemError:
    """The error that a package is not there which the site needs."""
    return LSystemError(f"Pages cannot be written without {package}", hint="Install it with: pip install 'lsys-kit[site]'")


def _mistune() -> ModuleType:
    try:
        import mistune
    except ImportError:
        raise missing("mistune") from None
    return mistune
