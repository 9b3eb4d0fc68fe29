"""Variables of a whole cpfg model: statements that run before, after and between the steps.

What `Start:` computes once and nothing changes is a constant. What depends on nothing but the step is a parameter of the
modules whose productions use it (`counters`). Other variables no record of a system holds, so that productions cannot use
them; what they do not use, as where steps are only counted to be printed, is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from lsys_kit.errors import ModelNameError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.dialects.cpfg.blocks import Block, assigned_names, computed
from lsys_kit.notation.dialects.cpfg.counters import Counters, names_used, used_expressions
from lsys_kit.notation.model.expressions import Expression, names_in
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
    counters
        Those of them that depend on nothing but the step.
    """

    constants: tuple[Constant, ...] = ()
    seed: Expression | None = None
    changing: frozenset[str] = frozenset()
    counters: Counters = field(default_factory=lambda: Counters({}, {}))


def variables_of(
    phases: Mapping[str, Sequence[Block]], rules: Iterable[Block], macros: Iterable[str], source: str
) -> Variables:
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
    >>> from lsys_kit.notation.model.expressions import Name, Number
    >>> found = variables_of({"start": [(Assignment(Name("n"), Number(3)),)], "endeach": [(Assignment(Name("k"), Name("n")),)]},
    ...                      [], [], "")
    >>> [str(constant) for constant in found.constants], sorted(found.changing)
    (['n = 3'], ['k'])
    """
    known = (*macros,)
    begun, before, after = (_joined(phases.get(phase, ())) for phase in ("start", "starteach", "endeach"))
    start = computed(begun, known, source)
    each = assigned_names((*before, *after))
    local = {name for block in rules for name in assigned_names(block)}
    constants = tuple(Constant(name, value) for name, value in start.items() if name not in {*each, *local, SEED})
    first = computed((*begun, *before), known, source, each)
    following = computed((*after, *before), known, source, each)
    counters = Counters(first, {name: value for name, value in following.items() if name not in {*local, SEED}})
    return Variables(constants, start.get(SEED), frozenset((*each, *(local & start.keys()))), counters)


def _joined(blocks: Iterable[Block]) -> Block:
    return tuple(statement for block in blocks for statement in block)


def check_changing(productions: Iterable[Production], changing: frozenset[str], source: str) -> None:
    """No production uses what changes while the model runs, unless its own block computes it."""
    for production in productions if changing else ():
        used = names_used(production) & changing
        for expression in used_expressions(production):
            found = sorted(names_in(expression) & used)
            if found:
                raise ModelNameError(
                    f'The variable "{found[0]}" changes while the model runs',
                    source,
                    *span(expression),
                    "The kit has no such variables: give the modules that use it a parameter, as in "
                    f'"A({found[0]}) --> A({found[0]}+1)".',
                )
