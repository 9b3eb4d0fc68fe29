"""PNML: a stage diagram as Petri-net tools read it (ISO/IEC 15909-2, place/transition nets).

Those tools fire one transition at a time. A step of the system is each transition fired as often as its place had tokens at the
beginning of the step; where several leave a place, they share its tokens. What a plain net cannot say stands in `toolspecific`
elements: a transition's probability, how long it takes, and on which condition.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from lsys_kit.derivation.petri.net import Stages, Transition, likelihood
from lsys_kit.errors import require, whole_number
from lsys_kit.notation.model.arithmetic import number_text

GRAMMAR = "http://www.pnml.org/version-2009/grammar/"
"""Where the standard's names are at home: `pnml` is the language, `ptnet` the type of a place/transition net."""
TOOL = {"tool": "lsys-kit", "version": "1"}


_UNKNOWN = {
    "condition": "condition such as",
    "probability": "probability such as",
    "duration": "duration such as",
    "factor": "number of copies such as",
    "besides": "rule such as",
}
"""What a plain net cannot say, in words."""


def pnml(net: Stages, tokens: Sequence[int] | None = None) -> str:
    """A stage diagram as PNML.

    Parameters
    ----------
    net
        The stages of a system.
    tokens
        How many tokens lie in each place at first; by default those of the axiom.

    Returns
    -------
    str
        An XML document. A control character in a name is replaced by its picture (U+2400 and on), as XML has none.

    Raises
    ------
    ModelValueError
        The tokens are not one number for each place.

    Examples
    --------
    >>> from lsys_kit import read, stages
    >>> print(pnml(stages(read("axiom: a\\na -> a a"))))
    <?xml version="1.0" encoding="UTF-8"?>
    <pnml xmlns="http://www.pnml.org/version-2009/grammar/pnml">
      <net id="net" type="http://www.pnml.org/version-2009/grammar/ptnet">
        <name>
          <text>stages</text>
        </name>
        <page id="page">
          <place id="p0">
            <name>
              <text>a</text>
            </name>
            <initialMarking>
              <text>1</text>
            </initialMarking>
          </place>
          <transition id="t0">
            <name>
              <text>a -&gt; 2 a</text>
            </name>
          </transition>
          <arc id="f0" source="p0" target="t0" />
          <arc id="a0" source="t0" target="p0">
            <inscription>
              <text>2</text>
            </inscription>
          </arc>
        </page>
      </net>
    </pnml>
    """
    return placed_pnml(net, tokens)


def played_otherwise(net: Stages) -> str:
    """Why other programs play a diagram otherwise than the system grows, in a sentence; empty where they play it alike.

    >>> from lsys_kit import read, stages
    >>> played_otherwise(stages(read("axiom: s a a\\ns < a -> a s\\ns -> ε")))
    'Programs for Petri nets play this net otherwise than the system grows: they know no condition such as "s < a".'
    >>> played_otherwise(stages(read("axiom: a\\na -> a a")))
    ''
    """
    terms = [*map(_terms, net.transitions), *({"factor": arc.factor} for arc in net.arcs), {"besides": "; ".join(net.besides)}]
    found = (f'{words} "{each[name]}"' for name, words in _UNKNOWN.items() for each in terms if each.get(name))
    first = next(found, "")
    return first and f"Programs for Petri nets play this net otherwise than the system grows: they know no {first}."


def placed_pnml(net: Stages, tokens: Sequence[int] | None, positions: Mapping[str, tuple[float, float]] | None = None) -> str:
    """A stage diagram as PNML that says where the middle of a place ("p0") or transition ("t0") stands in a picture, in pixels
    from the left and from the top; places that are not in the picture are left out."""
    require(net, Stages, "A stage diagram")
    given = net.start if tokens is None else net.in_places(tokens)
    marking = [whole_number(each, "A number of tokens") for each in given]
    root = Element("pnml", xmlns=f"{GRAMMAR}pnml")
    whole = SubElement(root, "net", id="net", type=f"{GRAMMAR}ptnet")
    _labelled(whole, "name", "stages")
    page = SubElement(whole, "page", id="page")
    shown = {number: place for number, place in enumerate(net.places) if positions is None or f"p{number}" in positions}
    at = positions or {}
    for number, place in shown.items():
        node = SubElement(page, "place", id=f"p{number}")
        _labelled(node, "name", "/".join(dict.fromkeys(map(str, place.modules))) or place.symbol)
        _placed(node, at.get(f"p{number}"))
        if marking[number]:
            _labelled(node, "initialMarking", str(marking[number]))
    for number, transition in enumerate(net.transitions):
        node = SubElement(page, "transition", id=f"t{number}")
        _labelled(node, "name", net.line(number))
        _placed(node, at.get(f"t{number}"))
        _tool_specific(node, _terms(transition))
    for number, transition in enumerate(net.transitions):
        SubElement(page, "arc", id=f"f{number}", source=f"p{transition.place}", target=f"t{number}")
    for number, arc in enumerate(net.arcs):
        if arc.place not in shown:
            continue
        node = SubElement(page, "arc", id=f"a{number}", source=f"t{arc.transition}", target=f"p{arc.place}")
        if arc.copies != 1:
            _labelled(node, "inscription", str(arc.copies))
        _tool_specific(node, {"factor": arc.factor})
    _tool_specific(whole, {"besides": "; ".join(net.besides)})
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode")


def _terms(transition: Transition) -> Mapping[str, str]:
    """What a plain net cannot say of a transition; empty where there is nothing to say."""
    return {
        "probability": "" if transition.chance is None else likelihood(transition.chance),
        "duration": "0" if transition.at_once else "" if transition.span is None else number_text(transition.span),
        "condition": transition.condition,
    }


def _labelled(node: Element, tag: str, text: str) -> None:
    SubElement(SubElement(node, tag), "text").text = _legal(text)


def _placed(node: Element, position: tuple[float, float] | None) -> None:
    if position is not None:
        x, y = (f"{each:.1f}" for each in position)
        SubElement(SubElement(node, "graphics"), "position", x=x, y=y)


def _tool_specific(node: Element, terms: Mapping[str, str]) -> None:
    if any(terms.values()):
        own = SubElement(node, "toolspecific", TOOL)
        for tag, text in terms.items():
            if text:
                SubElement(own, tag).text = _legal(text)


def _legal(text: str) -> str:
    """A text that XML can hold: control characters as their pictures, what is no character as U+FFFD."""
    return re.sub("[\ud800-\udfff\ufffe\uffff]", "\ufffd", "".join(chr(0x2400 + ord(c)) if c < " " else c for c in text))
