"""What pytest does before it looks for a test, in whatever folder it is told to look (see pyproject.toml)."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from lsys_kit.budget import limits

pytest_plugins = ["tests.browser.fixtures", "tests.supervisors"]
"""The browser is for the tests of the lessons and for the benchmarks; supervisors are for budgets and interrupts."""

EXAMPLES = {"quick": 5, "usual": 25, "ci": 100, "thorough": 100}
"""How many examples of a law a run tries, unless the law sets a number of its own. Without slow tests a run is quick; where
`CI` is set it tries more than usual, and with `--thorough` all there is."""
FEW_VARIANTS = {"usual": {"quick": 6, "slow": 2, "browser": 1}, "ci": {"quick": 24, "slow": 8, "browser": 20}}
"""How many variants of each kind of test are tried, spread over all of them, unless the run is thorough. In a browser there are
as many as there are lessons."""
STARTS_A_BROWSER = {"browser", "lab", "graphics"}
"""The fixtures that do."""
AN_HOUR = 3600
"""Seconds: as long as a law may take."""

sys.modules["rfc3987_syntax"] = None  # type: ignore[assignment]  # jsonschema would build 38 grammars in each process, for addresses
os.environ["TQDM_DISABLE"] = "1"  # a progress bar that appears on a slow machine alone would be an output that differs
os.environ.pop("MPLBACKEND", None)  # with Agg in the environment, a notebook's plot cells show nothing


def pytest_addoption(parser: pytest.Parser) -> None:
    """`--screenshots FOLDER` keeps what the browser tests see; `--renew-pictures` writes the golden pictures anew."""
    parser.addoption("--screenshots", metavar="FOLDER", help="put pictures of what the browser tests see into this folder")
    parser.addoption(
        "--thorough",
        action="store_true",
        help="try all variants of each test, each benchmark once, and many examples of each law",
    )
    parser.addoption("--renew-pictures", action="store_true", help="renew the golden pictures of the printed figures")


@pytest.hookimpl(wrapper=True)
def pytest_cmdline_main(config: pytest.Config) -> Iterator[object]:
    """The whole suite is run by a process for each core, unless another number is asked for."""
    alone = hasattr(config, "workerinput") or any(map(config.getoption, ("collectonly", "benchmark_only", "usepdb")))
    if config.args_source is pytest.Config.ArgsSource.TESTPATHS and config.option.numprocesses is None and not alone:
        config.option.numprocesses = "auto"
    return (yield)


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    """Benchmarks run once, as tests, unless `--benchmark-only` asks for numbers; hypothesis has no deadline."""
    from hypothesis import Phase, settings

    quick = "not slow" in config.option.markexpr
    phases = set(Phase) - {Phase.explain}  # which traces every line after a failure, and makes all slow that is measured
    for name, many in EXAMPLES.items():
        settings.register_profile(name, settings.default, deadline=None, max_examples=many, phases=phases)
    settings.load_profile("quick" if quick else _level(config))
    config.option.benchmark_disable = config.option.benchmark_disable or not config.option.benchmark_only
    if config.option.benchmark_only:
        config.option.dist = "no"  # several processes would measure each other


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark `browser` whatever needs a browser, and `slow` the benchmarks and the notebooks."""
    for item in items:
        fixtures = getattr(item, "fixturenames", ())
        if _kind(item) == "browser":
            item.add_marker("browser")
        if "benchmark" in fixtures or "benchmarks" in item.path.parts or item.path.suffix == ".ipynb":
            item.add_marker("slow")


@pytest.hookimpl(wrapper=True)
def pytest_generate_tests(metafunc: pytest.Metafunc) -> Iterator[None]:
    """Of each test at most a few variants, spread over all of them, unless the run is thorough; no others are made."""
    yield
    made, level = metafunc._calls, _level(metafunc.config)
    if level in FEW_VARIANTS and made:
        few = min(FEW_VARIANTS[level][_kind(metafunc.definition)], len(made))
        made[:] = [made[place * len(made) // few] for place in range(few)]


def _level(config: pytest.Config) -> str:
    return "thorough" if config.option.thorough else "ci" if os.environ.get("CI") else "usual"


def _kind(item: pytest.Item) -> str:
    fixtures = getattr(item, "fixturenames", ())
    if not STARTS_A_BROWSER.isdisjoint(fixtures):
        return "browser"
    return "slow" if item.get_closest_marker("slow") is not None or "benchmark" in fixtures else "quick"


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """A run without slow tests, or without a browser, does not even open what holds nothing else; the whole suite has
    benchmarks if it is thorough."""
    if collection_path.match("browser/test_*.py") and "not browser" in config.option.markexpr:
        return True
    benchmarks = collection_path.name == "benchmarks"
    unasked = config.args_source is pytest.Config.ArgsSource.TESTPATHS and not config.option.thorough
    if benchmarks and unasked and not config.option.benchmark_only:
        return True
    slow = benchmarks or collection_path.suffix == ".ipynb"
    return True if slow and "not slow" in config.option.markexpr else None


def pytest_collection_finish() -> None:
    """What was collected lives to the end: the garbage collector need not look at it again and again."""
    _settle()


def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """So does what a file of tests leaves behind in caches: in the next file it costs no time, which that may measure."""
    if nextitem is not None and nextitem.path != item.path:
        _settle()


def _settle() -> None:
    gc.collect()
    gc.freeze()


@pytest.hookimpl(wrapper=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> Iterator[object]:
    """A law has all the time it needs: on a busy machine the kit's own limit of seconds must not make it fail."""
    if pyfuncitem.get_closest_marker("hypothesis") is None:
        return (yield)
    with limits(seconds=AN_HOUR):
        return (yield)
