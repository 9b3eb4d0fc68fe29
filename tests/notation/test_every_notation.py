"""Every system of the catalogue goes through every notation that can express it, and comes back the same.

The notations are those of the registry: a new one is tested from the moment it is listed there.
"""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from lsys_kit.classroom.catalogue import system, systems
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.syntax.formatting import FEATURES
from lsys_kit.notation.syntax.systems import lacking
from lsys_kit.notation.write import write
from lsys_kit.worlds.derive import derive
from tests.notation.foreign_systems import record
from tests.plants import plant
from tests.rows import every_row

STEPS = 4
EVERY = [(id, notation) for notation in DIALECTS for id in systems()]
EXPRESSED = [(id, notation) for id, notation in EVERY if not lacking(DIALECTS[notation], system(id))]
REFUSED = [pair for pair in EVERY if pair not in EXPRESSED]


@pytest.mark.parametrize(("id", "notation"), EXPRESSED)
def test_what_is_written_reads_back_as_the_same_system(id: str, notation: str) -> None:
    written = write(system(id), notation)
    back = read(written, notation)
    assert record(back) == record(DIALECTS[notation].translated(system(id)))
    assert back.notation == notation
    assert write(back) == written


@pytest.mark.parametrize(("id", "notation"), EXPRESSED)
def test_the_same_words_come_out_in_every_notation(id: str, notation: str) -> None:
    back = read(write(system(id), notation), notation)
    for seed in (None, 7):
        assert [tuple(word) for word in derive(back, STEPS, seed=seed)] == [
            tuple(word) for word in derive(DIALECTS[notation].translated(system(id)), STEPS, seed=seed)
        ]


def test_a_refusal_names_a_feature_that_the_system_has_in_a_sentence() -> None:
    """What follows "has no" has no article of its own and no second negation."""
    with every_row() as row:
        for id, notation in REFUSED:
            with row(id, notation):
                feature = lacking(DIALECTS[notation], system(id))
                assert feature
                assert FEATURES.get(feature, lambda _: True)(system(id))
                assert not re.match(r"(a|an|the|no|any)\b|.*\b(no|not|but)\b", feature)
                said = re.escape(f"The notation {notation} has no {feature}, which this system needs")
                with pytest.raises(ModelValueError, match=said):
                    write(system(id), notation)


@pytest.mark.parametrize("id", ["J1", "J2", "J3", "J4", "J5"])
def test_a_system_goes_without_its_interpretation_where_that_is_asked(id: str) -> None:
    whole = system(id)
    with pytest.raises(ModelValueError) as refused:
        write(whole, "mathematica")
    assert "interpretation=False" in (refused.value.hint or "")
    back = read(write(whole, "mathematica", interpretation=False))
    assert whole.interpretation
    assert record(back) == record(replace(whole, interpretation=(), depth=1))
    assert list(map(str, derive(back, STEPS))) == list(map(str, derive(replace(whole, notation="mathematica"), STEPS)))


@pytest.mark.parametrize("notation", DIALECTS)
def test_every_notation_expresses_a_plant(notation: str) -> None:
    assert read(write(plant(notation), notation), notation) == plant(notation)


def test_the_notations_own_systems_go_without_loss() -> None:
    assert {id for id in systems() if (id, system(id).notation) not in EXPRESSED} == set()
