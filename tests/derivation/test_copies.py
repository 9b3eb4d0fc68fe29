"""Words and derivations can be copied, and sent to other processes, and go on from there as if nothing had happened."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable

import pytest

from lsys_kit import derive, read, system
from lsys_kit.derivation.derive import Derivation

MODELS = {name: system(name) for name in ("J1", "P4", "P6", "K7", "J2", "K9", "K16", "K21", "K26")}
MODELS["columns"] = read("axiom: A(1/3)\nA(x) -> A(0.37*x+0.1) A(0.59*x+0.2)")
MODELS["long context"] = read("axiom: A\nA -> repeat(200,i) <B(i)>\nB(x) < B(y) : x > y -> C")
MODELS["several modules"] = read("axiom: A B A\nA B -> B A A\nB A > A -> A\nA -> A B")
COPIES: dict[str, Callable[[Derivation], Derivation]] = {
    "pickled": lambda words: pickle.loads(pickle.dumps(words)),
    "copied": copy.copy,
    "deeply copied": copy.deepcopy,
}


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("how", COPIES)
def test_a_copy_of_a_derivation_goes_on_as_the_original(name: str, how: str) -> None:
    words = derive(MODELS[name], 8)
    found, longer = COPIES[how](words), words.to(10)
    assert [str(word) for word in found] == [str(word) for word in words]
    assert found.origins(8) == words.origins(8)
    assert [str(word) for word in found.to(10)] == [str(word) for word in longer]


def test_a_pickled_derivation_goes_on_by_counting_in_columns_and_step_by_step() -> None:
    for name in ("J1", "columns", "long context"):
        words = derive(MODELS[name], 8)
        found = pickle.loads(pickle.dumps(words))
        assert str(found.to(9)[-1]) == str(words.to(9)[-1])
        assert found.origins(8) == words.origins(8)
        assert found.counts(8) == words.counts(8)


@pytest.mark.parametrize("name", MODELS)
def test_a_word_can_be_sent_to_another_process(name: str) -> None:
    word = derive(MODELS[name], 8)[-1]
    assert pickle.loads(pickle.dumps(word)) == word
    assert copy.deepcopy(word) == word
    assert copy.copy(word) == word
