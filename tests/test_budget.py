"""Limits: nothing that a person types may run away with the machine."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import copy_context
from dataclasses import FrozenInstanceError

import pytest

from lsys_kit.budget import Limits, current, limits
from lsys_kit.errors import ModelNameError, ModelValueError


def test_limits_hold_for_a_stretch_of_code() -> None:
    with limits(modules=10, seconds=0.5) as inside:
        assert inside == current()
        assert (inside.modules, inside.seconds, inside.bytes) == (10, 0.5, 512 * 2**20)
        with limits(modules=5):
            assert (current().modules, current().seconds) == (5, 0.5)
        assert current().modules == 10
    assert current() == Limits()


def test_limits_end_with_an_error_too() -> None:
    with pytest.raises(ZeroDivisionError), limits(modules=10):
        raise ZeroDivisionError
    assert current() == Limits()


def test_limits_of_one_context_are_not_those_of_another() -> None:
    other = copy_context()
    with limits(modules=10):
        ask: Callable[[], Limits] = current
        assert other.run(ask).modules == 5_000_000
        assert copy_context().run(ask).modules == 10


def test_an_unknown_limit_is_named() -> None:
    message = r'There is no limit called "module"\. Limits are: modules, bytes, seconds'
    with pytest.raises(ModelNameError, match=message), limits(module=1):
        pass


@pytest.mark.parametrize("value", [0, -1, "5", None, True, float("nan")])
def test_a_limit_is_a_positive_number(value: object) -> None:
    message = 'The limit "modules" must be a positive number, not '
    with pytest.raises(ModelValueError, match=message), limits(modules=value):  # type: ignore[arg-type]
        pass


def test_limits_are_frozen() -> None:
    with pytest.raises(FrozenInstanceError):
        current().modules = 1  # type: ignore[misc]
