"""The cells of a notebook as HTML: texts, code, and what the code shows."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator, Mapping
from typing import Any
from urllib.parse import quote

from lsys_kit.classroom.lessons.displayed import escaped_lines, html
from lsys_kit.classroom.lessons.widget import prose_html
from lsys_kit.classroom.panel.document import deflated_text
from lsys_kit.classroom.site.markdown import Links, markdown_html, mathml
from lsys_kit.classroom.site.showing import PART
from lsys_kit.pictures.style.labels import escaped

Parts = list[dict[str, Any]]
"""What the script of a page has to know of each of its panels, votes, predictions, tables and pictures, in their order."""
QUESTIONS = ("vote", "prediction", "worksheet", "beside")
"""Kinds of parts whose code would give away what they ask, and is folded."""
_PICTURE = re.compile(r'src="data:image/svg\+xml;base64,([A-Za-z0-9+/=]{4000,})"')
"""A picture that is worth being kept apart, and how large it is."""
_SIZE = re.compile(r'<svg(?: (?!width)[\w:]+="[^"]*")*( width="[^"]*" height="[^"]*")')


def cells_html(cells: list[Any], links: Links, parts: Parts) -> str:
    """Cells of a notebook as HTML; what the script of the page has to know is added to `parts`."""
    return "".join(
        markdown_html(cell.source, links) if cell.cell_type == "markdown" else _code_html(cell, parts)
        for cell in cells
        if cell.cell_type in ("markdown", "code") and cell.source.strip()
    )


def _code_html(cell: Any, parts: Parts) -> str:
    """A code cell: its code, and below it what it shows; where it asks something, its code is folded and comes last."""
    shown = "".join(output_html(output, parts) for output in cell.outputs)
    code = f'<pre class="code"><code>{escaped_lines(cell.source.strip())}</code></pre>\n'
    asks = any(output.get("data", {}).get(PART, {}).get("kind") in QUESTIONS for output in cell.outputs)
    if asks:
        return f'{shown}<details class="folded"><summary>Code of this cell</summary>\n{code}</details>\n'
    return code + shown


def output_html(output: Mapping[str, Any], parts: Parts) -> str:
    """What a cell has put out, as HTML.

    >>> output_html({"output_type": "stream", "text": "a < b\\n"}, [])
    '<div class="output" tabindex="0"><pre>a &lt; b</pre></div>\\n'
    """
    if output["output_type"] == "stream":
        return _block(_lines(output["text"]))
    if output["output_type"] == "error":
        return _block(_lines(f"{output['ename']}: {output['evalue']}"))
    return data_html(output["data"], parts)


def data_html(data: Mapping[str, Any], parts: Parts) -> str:
    """What is shown of an object, by media types, as HTML.

    >>> data_html({"text/latex": "$x$", "text/plain": "x"}, [])
    '<div class="output" tabindex="0"><math display="block"><mrow><mi>x</mi></mrow></math></div>\\n'
    """
    if PART in data:
        return _part_html(data[PART], data["text/plain"], parts)
    if "text/latex" in data and "text/html" not in data:
        return _block(mathml(data["text/latex"], "block"))
    return _block(_PICTURE.sub(lambda found: _kept_picture(found[1], parts), html(data)))


def _kept_picture(packed: str, parts: Parts) -> str:
    """The place of a picture: an empty one of its size, which the script of the page fills before it comes into view."""
    drawing = base64.b64decode(packed).decode()
    size = _SIZE.search(drawing)
    empty = f'<svg xmlns="http://www.w3.org/2000/svg"{size[1] if size else ""}/>'
    number = len(parts)
    parts.append({"kind": "picture", "data": {"drawing": deflated_text(drawing)}})
    return f'data-part="{number}" src="data:image/svg+xml,{quote(empty)}"'


def _part_html(part: Mapping[str, Any], words: str, parts: Parts) -> str:
    """The place of a part, with what it asks or shows in words, for readers without scripts."""
    kind, number = part["kind"], len(parts)
    parts.append({"kind": kind, "data": part["data"]})
    inside = _prediction_html(part, parts) if kind == "prediction" else _lines(words)
    return f'<div class="part part-{kind}" data-part="{number}">{inside}</div>\n'


def _prediction_html(part: Mapping[str, Any], parts: Parts) -> str:
    """The question, and what answers it, folded."""
    answer = data_html(part["answer"], parts)
    question = prose_html(part["data"]["question"])
    return f"<details><summary>{question}</summary>\n<div data-answer>\n{answer}</div>\n</details>"


def _lines(text: str) -> str:
    return f"<pre>{escaped_lines(text.rstrip())}</pre>"


def _block(inside: str) -> str:
    return f'<div class="output" tabindex="0">{inside}</div>\n'


def headings(cells: list[Any]) -> Iterator[str]:
    """The headings of a notebook, from the greatest on, each as it is written."""
    for cell in cells:
        if cell.cell_type == "markdown":
            yield from (line for line in cell.source.splitlines() if line.startswith("#"))


def title_of(cells: list[Any], name: str) -> str:
    """The title of a notebook: its first heading."""
    first = next((line for line in headings(cells) if line.startswith("# ")), f"# {name}")
    return escaped(first[2:].strip()).replace("`", "").replace("*", "")
