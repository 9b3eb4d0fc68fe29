"""Variables of a whole cpfg model: statements that run before, after and between the steps.

What `Start:` computes once and nothing changes is a constant. What changes from step to step no record of a system holds, so
that productions cannot use it; where they do not, as where steps are only counted to be printed, it is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from lsys_kit.errors import ModelNameError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.dialects.cpfg.blocks import Block, assigned_names, computed
from lsys_kit.notation.model.expressions import Expression, Name, names_in
from lsys_kit.notation.model.modules import expressions_of
from lsys_kit.notation.model.system import Constant, Production

SEED = "srand"
"""The function that starts chance anew, whose value `Start:` stores under this name."""


@dataclass(frozen=True)
class Variables:
    """What the statements of a model around its steps come to.

    Attributes
    ----------
    constants
        What is computed once.
    seed
        Where chance begins, or None.
    changing
        The names of what changes while the model runs.
    """

    constants: tuple[Constant, ...] = ()
    seed: Expression | None = None
    changing: frozenset[str] = frozenset()


def variables_of(phases: Mapping[str, Sequence[Block]], rules: Iterable[Block], macros: Iterable[str],
                 source: str) -> Variables:
    """The variables of a model.

    Parameters
    ----------
    phases
        For "start", "end", "starteach" and "endeach" the blocks of statements.
    rules
        The blocks of the productions.
    macros
        The names of the macros, which no statement changes.
    source
        The text.

    Examples
    --------
    >>> from lsys_kit.notation.dialects.cpfg.blocks import Assignment
    >>> from lsys_kit.notation.model.expressions import Number
    >>> found = variables_of({"start": [(Assignment(Name("n"), Number(3)),)], "endeach": [(Assignment(Name("k"), Name("n")),)]},
    ...                      [], [], "")
    >>> [str(constant) for constant in found.constants], sorted(found.changing)
    (['n = 3'], ['k'])
    """
    start = computed((*_joined(phases.get("start", ())),), macros, source)
    each = {name for phase in ("starteach", "endeach") for name in assigned_names(_joined(phases.get(phase, ())))}
    local = {name for block in rules for name in assigned_names(block)}
    constants = tuple(Constant(name, value) for name, value in start.items() if name not in {*each, *local, SEED})
    return Variables(constants, start.get(SEED), frozenset((*each, *(local & start.keys()))))


def _joined(blocks: Iterable[Block]) -> Block:
    return tuple(statement for block in blocks for statement in block)


def check_changing(productions: Iterable[Production], changing: frozenset[str], source: str) -> None:
    """No production uses what changes while the model runs, unless its own block computes it."""
    for production in productions:
        own = {a.name for module in production.parameters for a in module.arguments if isinstance(a, Name)}
        for expression in _used(production):
            found = sorted((names_in(expression) & changing) - own)
            if found:
                raise ModelNameError(f'The variable "{found[0]}" changes while the model runs', source, *span(expression),
                                     'The kit has no such variables: give the modules that use it a parameter, as in '
                                     f'"A({found[0]}) --> A({found[0]}+1)".')


def _used(production: Production) -> Iterator[Expression]:
    yield from (part for part in (production.condition, production.probability) if part is not None)
    yield from expressions_of(production.successor)
