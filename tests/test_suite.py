"""The tests themselves: they are collected in one order, and no law depends on how fast the machine is."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit.budget import Limits, current
from tests.plugin import AN_HOUR

ROOT = Path(__file__).parent.parent


def collected(seed: str) -> list[str]:
    """The tests in the order in which a process with a seed of hashes collects them."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--collect-only", "tests"]
    done = subprocess.run(command, cwd=ROOT, env={**os.environ, "PYTHONHASHSEED": seed}, capture_output=True, text=True,
                          timeout=600, check=True)
    return [line for line in done.stdout.splitlines() if "::" in line]


@pytest.mark.slow
def test_the_order_of_the_tests_does_not_depend_on_hashes() -> None:
    assert collected("1") == collected("2") != []


@given(st.none())
def test_a_law_has_an_hour(nothing: None) -> None:
    assert (nothing, current().seconds) == (None, AN_HOUR)


def test_whatever_is_no_law_has_the_limits_of_a_user() -> None:
    assert current() == Limits()


def test_a_law_has_no_deadline() -> None:
    assert settings().deadline is None


def test_what_needs_a_browser_is_marked(request: pytest.FixtureRequest) -> None:
    for item in request.session.items:
        if item.path.parent.name == "browser":
            assert item.get_closest_marker("browser")
        if item.path.parent.name == "benchmarks":
            assert item.get_closest_marker("slow")
