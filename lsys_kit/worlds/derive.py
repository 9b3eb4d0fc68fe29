"""Derivation in an environment: before each step a turtle interprets the word and answers the queries of its modules.

Interpret, query, fill in, step. The engines of derivation know no turtle: they are handed a function that observes a word,
as they are handed a seed. So the public `derive` stands here, above geometry; a system without queries is derived as if this
module did not exist.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import partial
from typing import TYPE_CHECKING, Any, overload

from lsys_kit.derivation import derive as words_alone
from lsys_kit.derivation.derive import Derivation, derive_observed
from lsys_kit.derivation.tissues.development import CellworkDevelopment, Development
from lsys_kit.notation.model.cells import CellworkSystem, MapSystem
from lsys_kit.notation.model.system import LSystem

if TYPE_CHECKING:
    from lsys_kit.derivation.core.words import Word
    from lsys_kit.worlds.fields import Field
    from lsys_kit.worlds.sight import TurtleObservation


@overload
def derive(
    system: LSystem,
    steps: int,
    *,
    seed: int | None = None,
    arithmetic: str = "exact",
    letters: str | Collection[str] = (),
    field: Field | None = None,
    **constants: object,
) -> Derivation: ...
@overload
def derive(system: MapSystem, steps: int) -> Development: ...
@overload
def derive(system: CellworkSystem, steps: int) -> CellworkDevelopment: ...
def derive(system: Any, steps: int, **choices: Any) -> Derivation | Development | CellworkDevelopment:
    """Derive a system: the words of steps 0 to `steps`.

    Parameters
    ----------
    system
        Any L-system. If its rules depend on the turtle, by a sensitive function or by a query module such as `?P(x,y)`, a
        turtle interprets each word before the next step. Or a map system or a cellwork system, whose
        maps or cellworks are derived; they take no choices.
    steps
        The number of steps.
    **choices
        `seed` of the random numbers: the same seed gives the same words on every machine; by default the system's own, else 0.
        `arithmetic`, "exact", or "float" to compute in doubles as cpfg and L-Py do. `letters`, names of constants, one or a
        list, that stay letters: words then have formulas, as far as comparisons are decided by the constants' numbers, and
        `notes` says under which conditions they hold. And new values for declared constants:
        numbers, or texts such as "14/10". `field`, what answers query modules `?E`: any object with a method
        `answer(questions, scene)` that returns a value for each question; by default the field that the model names.

    Returns
    -------
    Derivation
        A sequence of `steps + 1` words. A word is built when it is first used, `[-1]` without those between. A query module
        holds the answer of the last step; `sight(step)` gives what the next one sees. For a map system a
        `Development`, a sequence of `steps + 1` maps; for a cellwork system a `CellworkDevelopment`.

    Raises
    ------
    ModelLimitError
        A step would be too large; the error has the step, the size and, in `partial`, the derivation of the steps that fit.
    ModelValueError
        A value cannot be computed; the error names the module and the production. Or nothing answers `?E`, or what answers it
        returns no number for each question; `partial` has the derivation of the steps that were finished.

    Examples
    --------
    >>> from lsys_kit import read
    >>> fibonacci = read("axiom: a\\na -> ab\\nb -> a")
    >>> [str(word) for word in derive(fibonacci, 3)]
    ['a', 'a b', 'a b a', 'a b a a b']
    >>> derive(fibonacci, 30).lengths[-1]
    2178309

    An apex that grows while it is below 3:

    >>> derive(read("axiom: F A ?P(0,0)\\nA > ?P(x,y) : y < 3 -> F A"), 4)
    0 F A?P(0,0)
    1 F F A?P(0,1)
    2 F F F A?P(0,2)
    3 F F F A?P(0,3)
    4 F F F A?P(0,3)

    Lengths as formulas, where the production is applied as long as they are greater than 1/2:

    >>> shrinking = derive(read("q = 3/4\\naxiom: A(1)\\nA(x) : x > 1/2 -> F(x) A(q*x)"), 3, letters="q")
    >>> shrinking[-1], shrinking.notes
    (F(1)F(q)F(q^2)A(q^3), ('The formulas hold where q > 1/√2 ≈ 0.7071.',))

    And one that asks how high it is, of a field that answers for it:

    >>> class Height:
    ...     def answer(self, questions, scene):
    ...         return [question.place[1] for question in questions]
    >>> derive(read("axiom: F A ?E(0)\\nA > ?E(y) : y < 3 -> F A"), 4, field=Height())[-1]
    F F F A?E(3)
    """
    if isinstance(system, LSystem):
        field = choices.pop("field", None)
        return derive_observed(system, steps, _observe if field is None else partial(_observe, field=field), **choices)
    cells: Development | CellworkDevelopment = words_alone.derive(system, steps, **choices)
    return cells


def _observe(word: Word, field: Field | None = None) -> TurtleObservation:
    from lsys_kit.worlds.sight import observe  # imported late: most systems ask nothing

    return observe(word, field)
