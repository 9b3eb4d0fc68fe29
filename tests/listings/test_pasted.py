"""A hundred texts as people paste them, typed from memory of real pages by others than the author of the readers.

Each says what it is: the system that is meant, in the kit's notation, or how it is refused, and where.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read

TEXTS = json.loads((Path(__file__).parent / "pasted" / "texts.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("row", TEXTS, ids=[f"{number:03}" for number in range(1, len(TEXTS) + 1)])
def test_a_text_as_somebody_pasted_it_is_read_as_it_is_meant_or_refused_where_it_is_wrong(row: dict[str, str]) -> None:
    if "refused" in row:
        with pytest.raises(LSystemError) as found:
            read(row["text"])
        assert (found.value.message, found.value.line) == (row["refused"], row["line"])
        assert found.value.hint
    else:
        assert read(row["text"]) == read(row["reads"], row["notation"])
