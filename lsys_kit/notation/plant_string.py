"""Plant strings (seed 004): symbols of one letter, both kinds of brackets as branches; the grammar is `plant_string.lark`."""

from __future__ import annotations

from collections.abc import Iterator

from lsys_kit.notation.draft import assembled
from lsys_kit.notation.layout import first_lacking, settings
from lsys_kit.notation.model import LSystem, flat
from lsys_kit.notation.records import Statements
from lsys_kit.notation.slips import QUESTIONS
from lsys_kit.notation.statements import statements
from lsys_kit.notation.tradition import Notation

NAME = "plant-string"


def _lines(system: LSystem) -> Iterator[str]:
    yield from settings(system, NAME)
    yield f"Axiom: {PLANT_STRING.word(system.axiom)}"
    for production in system.productions:
        yield f"{production.predecessor} -> {PLANT_STRING.word(flat(production.successor)) or 'ε'}"


def _lacking(system: LSystem) -> str | None:
    return first_lacking(
        system, "parameters", "symbols of several letters", "conditions", "contexts", "probabilities", "repetition",
        "constants", "decomposition rules", "meta-rules", "interpretation rules", "starting direction", "ignored symbols",
        "alphabet")


PLANT_STRING = Notation(
    name=NAME, statements=statements, records=Statements, finish=assembled, questions=QUESTIONS, module=str, joined="".join,
    write=lambda system: "\n".join(_lines(system)), lacking=_lacking, likely=lambda text: 0,
    turtle=NAME)
