"""The misconceptions: each is a function from a question to the wrong answers that it yields, with what a reply says.

A misconception that does not apply to a question yields none. `do` continues "That is what comes out if you ..." and
"Did you ...?", `but` says in a whole sentence how it is. So a reply says what the answer shows, and claims nothing of the
person.
"""

from __future__ import annotations

from collections.abc import Mapping

from lsys_kit.classroom.exercises.misconceptions.misconception import Misconception as Misconception
from lsys_kit.classroom.exercises.misconceptions.of_growth import OF_GROWTH
from lsys_kit.classroom.exercises.misconceptions.of_maps import OF_MAPS
from lsys_kit.classroom.exercises.misconceptions.of_rewriting import OF_REWRITING

MISCONCEPTIONS: Mapping[str, Misconception] = {each.name: each for each in (*OF_REWRITING, *OF_GROWTH, *OF_MAPS)}
"""The misconceptions, by their names."""
