"""Misconceptions about growth, counting, formulas, chance and stage diagrams."""

from __future__ import annotations

from lsys_kit.classroom.exercises.misconceptions import expressions, sequences
from lsys_kit.classroom.exercises.misconceptions.answers import (
    arcs_reversed,
    by_sequences,
    by_solutions,
    copies_not_counted,
    last_stage_skipped,
    never,
    one_daughter,
    together,
    transposed,
)
from lsys_kit.classroom.exercises.misconceptions.misconception import BY_DECLARATION, Misconception

_GROWTH = "lengths, counts, strokes, first step past"

OF_GROWTH = (
    # How it grows
    Misconception(
        "linear growth",
        _GROWTH,
        "add the same number in every step",
        "The more modules there are, the more are made in a step.",
        by_sequences(sequences.linear),
    ),
    Misconception(
        "adding for multiplying",
        f"{_GROWTH}; formulas with products",
        "add where it multiplies",
        "Each module becomes several, in every step: that multiplies.",
        together(by_sequences(sequences.added_for_multiplied), by_solutions("expression", expressions.added_for_multiplied)),
    ),
    Misconception(
        "Fibonacci by reflex",
        _GROWTH,
        "add the two numbers just before",
        "From which earlier steps the modules come depends on how long each of them lives.",
        by_sequences(sequences.fibonacci),
    ),
    Misconception(
        "doubling by reflex",
        _GROWTH,
        "double the number in every step",
        "Not every module becomes two in every step.",
        by_sequences(sequences.doubling),
    ),
    Misconception(
        "linear for exponential",
        "formulas with powers",
        "multiply where a power belongs",
        "What is multiplied by the same number in every step grows as a power.",
        by_solutions("expression", expressions.multiplied_for_raised),
    ),
    Misconception(
        "rows and columns",
        "asks matrix",
        "take rows for columns",
        "A row says what one module becomes, a column from which modules it comes.",
        transposed,
    ),
    Misconception(
        "length of the rule",
        BY_DECLARATION,
        "take the length of a successor for the rate of growth",
        "What counts is what its modules become in turn.",
        never,
    ),
    Misconception(
        "life as length",
        BY_DECLARATION,
        "take a longer life for a larger filament",
        "A cell that lives longer divides less often.",
        never,
    ),
    Misconception(
        "kind as token", BY_DECLARATION, "take the kinds of cells for tokens", "A place is a stage; a token is one cell.", never
    ),
    # Counting and formulas
    Misconception(
        "fence post",
        "numbers; on request",
        "count the gaps for the posts, or the posts for the gaps",
        "From stage a to stage b there are b - a steps, and b - a + 1 stages.",
        by_solutions("number", expressions.next_number),
        near=True,
        on_request=True,
    ),
    Misconception(
        "walls for cells",
        "numbers; on request",
        "count walls for cells",
        "A filament of n cells has n - 1 walls between them, and n + 1 with its ends.",
        by_solutions("number", expressions.next_number),
        near=True,
        on_request=True,
    ),
    Misconception(
        "one too many",
        "formulas",
        "add one too many",
        "Put the smallest case into your formula and count by hand.",
        by_solutions("expression", expressions.one_more),
        near=True,
    ),
    Misconception(
        "one too few",
        "formulas",
        "leave out the one that comes last",
        "Put the smallest case into your formula and count by hand.",
        by_solutions("expression", expressions.one_less),
        near=True,
    ),
    Misconception(
        "names exchanged",
        "formulas with two names",
        "exchange two of the names",
        "Let one of them grow: should the result grow or shrink?",
        by_solutions("expression", expressions.names_exchanged),
    ),
    Misconception(
        "sign reversed",
        "formulas; numbers",
        "take the wrong sign",
        "Should it be positive?",
        together(by_solutions("expression", expressions.sign_reversed), by_solutions("number", expressions.opposite)),
    ),
    Misconception(
        "ratio inverted",
        "formulas with a division; numbers on request",
        "divide the wrong way round",
        "Should it be greater than 1, or less?",
        by_solutions("expression", expressions.ratio_inverted),
    ),
    Misconception(
        "number inverted",
        "numbers; on request",
        "divide the wrong way round",
        "Should it be greater than 1, or less?",
        by_solutions("number", expressions.inverse),
        on_request=True,
    ),
    Misconception(
        "contrary",
        "numbers from 0 to 1; on request",
        "give the probability of the contrary",
        "Which of the two is asked for?",
        by_solutions("number", expressions.complement),
        on_request=True,
    ),
    Misconception(
        "percent",
        "numbers; on request",
        "give percent",
        "50 percent are 0.5.",
        by_solutions("number", expressions.percent),
        on_request=True,
    ),
    # Chance
    Misconception(
        "mean decides",
        BY_DECLARATION,
        "conclude from the mean that the line survives",
        "A mean above 1 leaves a chance of extinction: the first few may all die.",
        never,
    ),
    Misconception(
        "random is different every time",
        BY_DECLARATION,
        "expect another result from the same seed",
        "The same seed gives the same random numbers.",
        never,
    ),
    Misconception(
        "weights must sum to 1",
        BY_DECLARATION,
        "take weights that do not sum to 1 for a mistake",
        "Weights are divided by their sum.",
        never,
    ),
    Misconception(
        "lengths added",
        BY_DECLARATION,
        "add the lengths of steps in different directions",
        "Steps in different directions add like arrows.",
        never,
    ),
    # Nets
    Misconception(
        "arcs reversed",
        "kind net",
        "draw the arrows the other way round",
        "An arrow leads from a stage to what comes of it.",
        by_solutions("net", arcs_reversed),
    ),
    Misconception(
        "copies not counted",
        "kind net",
        "put one token where there should be several",
        "Two daughters of one kind are two tokens.",
        by_solutions("net", copies_not_counted),
        near=True,
    ),
    Misconception(
        "one daughter",
        "kind net",
        "let a token go into one place only",
        "A cell that divides puts a token into the place of each daughter.",
        by_solutions("net", one_daughter),
    ),
    Misconception(
        "stage left out",
        "kind net",
        "leave out a stage",
        "Every stage through which a cell passes is a place, and takes a step.",
        by_solutions("net", last_stage_skipped),
        near=True,
    ),
    Misconception("one transition at a time", BY_DECLARATION, "fire one transition only", "In a step all tokens move.", never),
)
"""In the order in which they are looked for."""
