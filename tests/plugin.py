"""What pytest does before it looks for a test, in whatever folder it is told to look (see pyproject.toml)."""

from __future__ import annotations

import os

import pytest

pytest_plugins = ["tests.browser.fixtures"]
"""The browser is for the tests of the lessons and for the benchmarks."""

os.environ.pop("MPLBACKEND", None)  # with Agg in the environment, a notebook's plot cells show nothing


def pytest_addoption(parser: pytest.Parser) -> None:
    """`--screenshots FOLDER` keeps what the browser tests see; `--renew-pictures` writes the golden pictures anew."""
    parser.addoption("--screenshots", metavar="FOLDER", help="put pictures of what the browser tests see into this folder")
    parser.addoption("--renew-pictures", action="store_true", help="renew the golden pictures of the printed figures")


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    """Benchmarks run once, as tests, unless `--benchmark-only` asks for numbers; hypothesis has no stopwatch."""
    from hypothesis import settings

    settings.register_profile("kit", settings.default, deadline=None)
    settings.load_profile("kit")
    config.option.benchmark_disable = config.option.benchmark_disable or not config.option.benchmark_only
