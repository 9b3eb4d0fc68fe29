"""The command: draws mutants, runs the tests, and prints what came of them."""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from types import MappingProxyType

import pytest

from tests.mutants.changes import ROOT, Change, Site, changes
from tests.mutants.running import CHOSEN, Outcome, Runner
from tests.mutants.schemata import Switches

SHARES: Mapping[str, int] = MappingProxyType(
    {
        "lsys_kit/derivation": 50,
        "lsys_kit/geometry": 40,
        "lsys_kit/notation/model": 20,
        "lsys_kit/classroom/exercises/kinds": 20,
        "lsys_kit/classroom/panel/scripts": 20,
    }
)
"""How many of 150 mutants are drawn from each room."""


def drawn(seed: int, count: int) -> dict[Change, Site]:
    """Mutants drawn by chance, as many from each room as is its share."""
    found: dict[Change, Site] = {}
    for room, share in SHARES.items():
        files = sorted(path for path in (ROOT / room).rglob("*") if path.suffix in (".py", ".js"))
        every = [each for path in files for each in changes(path.relative_to(ROOT).as_posix()).items()]
        found |= random.Random(f"{seed} {room}").sample(every, round(share * count / sum(SHARES.values())))
    return found


def taken(earlier: Path) -> dict[Change, Site]:
    """The mutants of an earlier file whose code is still there; the others are named."""
    found: dict[Change, Site] = {}
    for row in json.loads(earlier.read_text("utf-8"))["mutants"]:
        change = Change(**{each.name: row[each.name] for each in fields(Change)})
        site = changes(change.file).get(change) if (ROOT / change.file).exists() else None
        if site is None:
            print(f"gone: {change.file} {change.where}: {change.old}")
        else:
            found[change] = site
    return found


def table(outcomes: Mapping[Change, Outcome]) -> str:
    """How many mutants of each room were tried and caught."""
    rows = {room: [outcome for change, outcome in outcomes.items() if change.file.startswith(f"{room}/")] for room in SHARES}
    return "\n".join(
        [
            f"{'room':40} mutants  caught",
            *(
                f"{room:40}{len(every):8}{sum(each.caught for each in every):8}"
                for room, every in {**rows, "together": [*outcomes.values()]}.items()
            ),
        ]
    )


def _survivors(sites: Mapping[Change, Site], outcomes: Mapping[Change, Outcome]) -> str:
    return "\n".join(
        f"{change.file}:{sites[change].line} {change.where} ({outcome.tests} quick tests)\n    {change.old}\n    {change.new}"
        for change, outcome in outcomes.items()
        if not outcome.caught
    )


def _save(path: Path, sites: Mapping[Change, Site], outcomes: Mapping[Change, Outcome], seconds: float) -> None:
    rows = [
        {**asdict(change), "line": site.line, **(asdict(outcomes[change]) if change in outcomes else {})}
        for change, site in sites.items()
    ]
    path.write_text(json.dumps({"seconds": round(seconds), "mutants": rows}, indent=1), "utf-8")


def _asked(given: Sequence[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description="How many mutants the tests catch.")
    parser.add_argument("tests", nargs="*", default=["tests", "lsys_kit"], help="which tests are run")
    parser.add_argument("--seed", type=int, default=0, help="of the draw")
    parser.add_argument("--count", type=int, default=150, help="how many mutants")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="how many processes")
    parser.add_argument("--json", type=Path, help="where the mutants are kept, with what came of them")
    parser.add_argument("--from", type=Path, dest="earlier", help="take the mutants kept there instead of a draw")
    return parser.parse_args(given)


def main() -> int:
    """Draw, run, print."""
    asked, begun = _asked(), time.monotonic()
    sites = taken(asked.earlier) if asked.earlier else drawn(asked.seed, asked.count)
    outcomes: dict[Change, Outcome] = {}

    def tell(change: Change, outcome: Outcome) -> None:
        outcomes[change] = outcome
        said = f"caught by {outcome.by}" if outcome.caught else "SURVIVES"
        log(f"{len(outcomes)}/{len(sites)} {change.file}:{sites[change].line} {change.old} -> {change.new}: {said}")
        if asked.json:
            _save(asked.json, sites, outcomes, time.monotonic() - begun)

    def log(text: str) -> None:
        print(f"{time.monotonic() - begun:5.0f} s  {text}", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        os.environ["PYTEST_DEBUG_TEMPROOT"] = folder
        runner = Runner(Switches(sites), list(sites), asked.jobs, tell, log)
        status = pytest.main(["-qs", "-n0", "--thorough", "-p", "no:cacheprovider", "-m", CHOSEN, *asked.tests], [runner])
    print(f"\n{table(outcomes)}\n\nSurvivors:\n{_survivors(sites, outcomes)}\n{(time.monotonic() - begun) / 60:.0f} minutes")
    return int(status)


if __name__ == "__main__":
    sys.exit(main())
