"""The table of engines: which engine derives a system follows from the system's traits, and from nothing else.

Each engine serves the systems that ask for no more than the traits in its row. The first that serves a system is the fastest
for it. Those further down serve it as well, and must give the same words: the laws in the tests compare them.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.traits import D0L, MOST, S0L, Traits
from lsys_kit.derivation.engines.columnar import ColumnarSteps
from lsys_kit.derivation.engines.contexts import ContextEngine
from lsys_kit.derivation.engines.counting import CountingEngine
from lsys_kit.derivation.engines.engine import Engine, Observer
from lsys_kit.derivation.engines.stepping import SteppingEngine
from lsys_kit.derivation.engines.stepwise import Stepper

ENGINES: Mapping[type, Traits] = MappingProxyType(
    {
        ColumnarSteps: Traits(),
        CountingEngine: D0L,
        ContextEngine: S0L._replace(context=1, meta=True),
        Stepper: Traits(MOST, MOST, *[True] * 11),
    }
)
"""The most that a system may have to be derived in columns, by counting, by arrays, and module by module."""


def serves(engine: type, traits: Traits) -> bool:
    """Whether an engine can derive systems with some traits.

    >>> serves(CountingEngine, Traits(decomposition=True)), serves(CountingEngine, Traits(stochastic=True))
    (True, False)
    """
    return traits.within(ENGINES[engine])


def engine_for(states: States, seed: int, world: Observer | None = None) -> Engine:
    """The engine that derives a system; where it asks what the turtle sees, in a world that answers."""
    traits = states.traits
    if serves(CountingEngine, traits):
        return CountingEngine(states, serves(ColumnarSteps, traits))
    stepper = Stepper(states, seed)
    arrays = ContextEngine(stepper) if serves(ContextEngine, traits) else None
    return SteppingEngine(stepper, arrays, world if traits.sensitive else None)
