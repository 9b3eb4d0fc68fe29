"""The power of the tests: of changes of the code drawn at random, how many make a test fail.

    nice python -m tests.mutants [--seed 0] [--count 150] [--json FILE] [--from FILE] [--jobs 2] [TESTS ...]

A *mutant* is the kit with one change: `<` for `<=`, `and` for `or`, a number that is one greater, a condition the wrong way
round. Mutants are drawn from some rooms and from the scripts of the panel. All of those in Python are compiled into the code at
once, as `changed if on(17) else original`, and none is on. The quick tests run once, to see which of them come to which change.
Then, for each mutant, a fork of the process turns it on and runs those tests, the nearest and fastest first, until one fails or
they have taken a minute. A mutant that runs away is caught. A test that fails alone without the mutant says nothing, and is
left out. If no quick test comes to a change, slow tests of its room are tried; if the kit comes to it while it is imported,
those of its room run in a new process. Scripts are changed as they are read, for the tests that open them in Chromium without
Jupyter; what the tests of the site alone would see is not caught.

On two cores that takes as long as the quick tests and about a quarter of an hour more. `--json` keeps the mutants with what
came of them, written after each; `--from` takes the mutants of such a file instead of a draw, to compare two states of the
tests, and names those whose code is gone.
"""
