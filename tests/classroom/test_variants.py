"""Variants of a system: what may change, and what may not."""

import pytest

from lsys_kit import ModelValueError, derive, read, system, variants, write

PLANT = "angle: 25\nsteps: 3\naxiom: F\nF -> F[+F]F[-F]F"


def test_the_same_seed_gives_the_same_variants():
    assert variants(read(PLANT), 9, seed=4) == variants(read(PLANT), 9, seed=4) != variants(read(PLANT), 9, seed=5)


@pytest.mark.slow
@pytest.mark.parametrize("id", ["K5", "J6", "K7", "L2", "P5"])
def test_variants_differ_read_back_and_grow(id):
    found = variants(system(id), 5)
    assert len({write(each) for each in found}) == 5
    for each in found:
        assert each != system(id)
        assert read(write(each), each.notation) == each
        assert len(derive(each, each.steps if each.steps is not None else 5)[-1]) > 1


def test_a_branch_is_copied_or_left_out_as_a_whole():
    for each in variants(read(PLANT), 60, seed=2):
        successor = str(each.productions[0]).split("->")[1]
        assert successor.count("[") == successor.count("]")
        assert "[]" not in successor.replace(" ", "")


def test_a_small_system_has_fewer_variants():
    assert 0 < len(variants(read("angle: 0\naxiom: A\nA -> A"), 100)) < 100
    assert variants(read("angle: 0\naxiom: A"), 9) == ()


@pytest.mark.parametrize(
    ("choices", "told"),
    [
        ({"number": 0}, "from 1 to 100, not 0"),
        ({"number": 101}, "from 1 to 100, not 101"),
        ({"seed": "x"}, "must be a whole number"),
    ],
)
def test_what_is_no_number_of_variants(choices, told):
    with pytest.raises(ModelValueError, match=told):
        variants(read(PLANT), **choices)
