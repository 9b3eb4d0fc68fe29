"""A sweep keeps in a file what is finished, and the same call goes on from there, whatever has ended it."""

from __future__ import annotations

import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import ModelFileError, ensemble, limits, read, sweep, system
from lsys_kit.derivation.derive import Derivation
from lsys_kit.experiments import kept

PLANT = system("K7")
ALGA = read("d = 2 in 1 .. 3\naxiom: A(1)\nA(t) : t < d -> A(t+1)\nA(t) -> A(1) A(1)")
made: list[str] = []


def size(derivation: Derivation) -> int:
    """A measure that remembers that it was asked."""
    made.append("")
    return len(derivation[-1])


@pytest.fixture
def file(tmp_path: Path) -> Path:
    made.clear()
    return tmp_path / "sweep.csv"


class TestTheSameCall:
    def test_what_is_in_the_file_is_not_made_again(self, file: Path) -> None:
        first = ensemble(PLANT, 8, size, steps=3, file=file)
        assert len(made) == 8
        assert ensemble(PLANT, 8, size, steps=3, file=str(file)) == first == ensemble(PLANT, 8, {"size": "modules"}, steps=3)
        assert len(made) == 8

    def test_more_seeds_values_and_steps_are_added(self, file: Path) -> None:
        ensemble(PLANT, 4, size, steps=3, file=file)
        assert len(ensemble(PLANT, [2, 3, 9], size, steps=3, file=file)) == 3
        assert len(made) == 5
        ensemble(PLANT, 4, size, steps=(1, 3), file=file)
        assert len(made) == 5 + 2 * 4
        assert ensemble(PLANT, [9, 0], size, steps=3, file=file)["seed"] == (9, 0)
        assert len(made) == 13

    def test_values_come_back_exactly_as_they_were(self, file: Path) -> None:
        halves = read("x = 1\naxiom: F(x)\nF(y) -> F(y/3)F(y/2)")
        asked: dict[str, Any] = {"x": [Fraction(1, 3), 0.7, "14/10", 2]}
        measures = ["modules", "rate", "width", {"exact": lambda run: Fraction(len(run[-1]), 3), "double": lambda _: 0.7}]
        first = sweep(halves, asked, measures, steps=2, file=file)
        again = sweep(halves, asked, measures, steps=2, file=file)
        assert again == first == sweep(halves, asked, measures, steps=2)
        assert [[*map(type, row)] for row in again.rows] == [[*map(type, row)] for row in first.rows]

    @given(st.integers() | st.fractions() | st.floats(allow_nan=False))
    def test_every_number_is_read_as_it_was_written(self, value: Any) -> None:
        found = kept._number(kept._text(value))
        assert found == value
        assert isinstance(found, float) == isinstance(value, float)

    def test_the_file_is_a_table_that_others_read(self, file: Path) -> None:
        sweep(ALGA, "d", "rate", file=file)
        pandas = pytest.importorskip("pandas")
        frame = pandas.read_csv(file)
        assert frame["d"].tolist() == [1, 2, 3]
        assert frame["rate"].tolist() == pytest.approx([2, 2 ** (1 / 2), 2 ** (1 / 3)])

    def test_runs_that_are_left_out_are_tried_again(self, file: Path) -> None:
        with limits(modules=100):
            some = ensemble(PLANT, 20, "F", steps=3, file=file)
        assert 0 < len(some.left_out) < 20
        assert ensemble(PLANT, 20, "F", steps=3, file=file) == ensemble(PLANT, 20, "F", steps=3)


class TestEndings:
    @pytest.mark.slow
    def test_a_killed_program_loses_no_more_than_the_last_second(self, file: Path) -> None:
        program = f"""
import os, signal, time
from lsys_kit import ensemble, system
asked, LAST = [], int(os.environ["LAST"])
def slow(derivation):
    asked.append(0)
    time.sleep(0.02)
    if len(asked) == LAST:
        os.kill(os.getpid(), signal.SIGKILL)
    return len(derivation[-1])
ensemble(system("K7"), 200, slow, steps=3, file={str(file)!r})
"""
        ended = subprocess.run([sys.executable, "-c", program], env={**os.environ, "LAST": "150"}, check=False)
        assert ended.returncode == -9
        known = file.read_text().splitlines()
        assert 50 <= len(known) - 1 < 150
        again = [sys.executable, "-c", f"{program}print(len(asked))"]
        after = subprocess.run(again, env={**os.environ, "LAST": "0"}, check=True, stdout=subprocess.PIPE, text=True)
        assert int(after.stdout) == 200 - (len(known) - 1)
        assert len(file.read_text().splitlines()) == 201

    def test_a_row_that_was_cut_off_is_made_again(self, file: Path) -> None:
        whole = ensemble(PLANT, 5, size, steps=3, file=file)
        text = file.read_text()
        for end in range(len(text) - 4, len(text)):
            made.clear()
            file.write_text(text[:end])
            assert ensemble(PLANT, 5, size, steps=3, file=file) == whole
            assert len(made) == 1
            assert ensemble(PLANT, 5, size, steps=3, file=file) == whole
            assert len(made) == 1

    def test_an_error_keeps_what_was_finished(self, file: Path) -> None:
        def interrupted(derivation: Derivation) -> int:
            if len(made) == 3:
                raise KeyboardInterrupt
            return size(derivation)

        assert len(ensemble(PLANT, 9, interrupted, steps=2, file=file)) == 3
        assert len(file.read_text().splitlines()) == 4

    def test_a_file_that_is_lost_stops_nothing(self, file: Path) -> None:
        def loses_it(derivation: Derivation) -> int:
            if file.is_file() and len(derivation[-1]):
                file.unlink()
                file.mkdir()
            return 1

        found = ensemble(PLANT, 4, loses_it, steps=2, file=file)
        assert len(found) == 4
        assert found.remarks == ('"sweep.csv" does not have all of these runs: it is no file.',)


class TestRefusals:
    @pytest.mark.parametrize(
        "other",
        [
            lambda file: ensemble(system("K8"), 3, "F", steps=3, file=file),
            lambda file: ensemble(PLANT, 3, "modules", steps=3, file=file),
            lambda file: ensemble(PLANT, 3, {"F": "height"}, steps=3, file=file),
            lambda file: ensemble(PLANT, 3, {"F": lambda _: 2}, steps=3, file=file),
            lambda file: ensemble(PLANT, 3, "F", steps=3, arithmetic="float", file=file),
            lambda file: sweep(PLANT, {"seed": [1]}, ["F", "modules"], steps=3, file=file),
        ],
    )
    def test_other_runs_are_not_mixed_with_these(self, file: Path, other: Any) -> None:
        ensemble(PLANT, 3, "F", steps=3, file=file)
        before = file.read_bytes()
        with pytest.raises(ModelFileError, match="holds something else than these runs"):
            other(file)
        assert file.read_bytes() == before

    def test_a_measure_of_ones_own_is_known_by_what_it_does(self, file: Path) -> None:
        def of(many: int) -> Any:
            return {"F": lambda _: many}

        ensemble(PLANT, 3, of(2), steps=3, file=file)
        assert ensemble(PLANT, 3, of(2), steps=3, file=file)["F"] == (2, 2, 2)
        with pytest.raises(ModelFileError):
            ensemble(PLANT, 3, of(3), steps=3, file=file)

    @pytest.mark.parametrize("content", [b"", b"seed,step,F\n1,2,3\n", b"\xff\xfe\x00", b"a text of somebody's"])
    def test_what_the_kit_did_not_make_stays_as_it_is(self, file: Path, content: bytes) -> None:
        file.write_bytes(content)
        with pytest.raises(ModelFileError):
            ensemble(PLANT, 2, "F", steps=2, file=file)
        assert file.read_bytes() == content

    @pytest.mark.parametrize("name", ["sweep.parquet", "sweep.xlsx", "sweep"])
    def test_csv_is_the_form_of_what_is_kept(self, tmp_path: Path, name: str) -> None:
        with pytest.raises(ModelFileError, match="cannot be kept") as refused:
            ensemble(PLANT, 2, "F", steps=2, file=tmp_path / name)
        assert refused.value.hint == (
            "They are kept as CSV: let the name end in .csv. Other forms are made of the table afterwards, by to_pandas()."
        )

    @pytest.mark.parametrize("name", ["sweep.parquet", "sweep", "nowhere/sweep.csv", ""])
    def test_a_name_that_cannot_be_is_refused(self, tmp_path: Path, name: str) -> None:
        with pytest.raises(ModelFileError, match="cannot be kept"):
            ensemble(PLANT, 2, "F", steps=2, file=tmp_path / name)
        assert [*tmp_path.iterdir()] == []
