"""The tests, in the rooms of the package; `pytest` runs them all, with the notebooks and the examples in docstrings."""
