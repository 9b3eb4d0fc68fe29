"""Each sentence of the lessons that asks for something has a row that says how it is done."""

from __future__ import annotations

from itertools import groupby

from tests.browser.reader import NOTHING, ROWS, Reader
from tests.browser.requests import requests


def test_each_sentence_that_asks_for_something_has_a_row_in_the_order_of_the_lessons():
    for number, asked in groupby(requests(), key=lambda each: each.lesson):
        assert [each.says for each in asked] == [row[0] for row in ROWS[number]], f"lesson {number}"


def test_each_row_is_understood():
    words = {name.replace("_", " ") for name in vars(Reader) if not name.startswith("_")} | NOTHING
    for row in (row for rows in ROWS.values() for row in rows):
        assert len(row) > 1, row
        for act in row[1:]:
            assert any(act == word or act.startswith(f"{word} ") for word in words), act
