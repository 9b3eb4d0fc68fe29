"""The makers of practice exercises: for each table of `topics.toml` a function that draws the numbers, and knows the answer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import accumulate, chain, pairwise, product
from math import ceil, prod
from random import Random
from string import ascii_uppercase
from typing import TypeAlias

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise, Option, Slip
from lsys_kit.classroom.exercises.judging import wrong_answers
from lsys_kit.classroom.exercises.kinds.kind import first_difference
from lsys_kit.classroom.exercises.misconceptions.of_steps import WrongStep, leftmost_only, sequential, words_by
from lsys_kit.classroom.exercises.practice.drafts import (
    Draft,
    Maker,
    derivation_text,
    random_letters,
    random_rules,
    size_of,
    system_text,
    words_of,
)
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.derivation.inference.infer import infer
from lsys_kit.translation import gettext

# Words by hand


MOST_WRITTEN = 60
"""The most modules of a word that is to be written by hand."""


def _word(draft: Draft, system: str, steps: int, longest: int = MOST_WRITTEN) -> Exercise | None:
    words = words_of(system, steps)
    if not 3 < size_of(words[-1]) <= longest or words[-1] in words[:-1]:
        return None
    return draft.exercise(words[-1], {"system": system, "steps": steps}, derivation_text(words), question=draft.text("task"))


def _derive(chance: Random, level: int, draft: Draft) -> Exercise | None:
    rules = random_rules(chance, random_letters(chance, 2 + (level > 1)), 2 + (level != 2))
    return _word(draft, system_text(chance.choice([*rules]), rules), 3 + (level > 1), 12 + 8 * level)


def _brackets(chance: Random, level: int, draft: Draft) -> Exercise | None:
    bud = chance.choice("XABK")
    branch = ["[", chance.choice("+-"), bud, "]"]
    parts = [["F"], branch, [bud]] if level == 1 else [["F"], branch, ["F"], ["[", chance.choice("+-"), bud, "]"], [bud]]
    chance.shuffle(parts)
    rules = {
        bud: [*chain.from_iterable(parts)],
        "F": ["F", "F"] if level > 1 else chance.choice([["F", "F"], [bud, "F"], ["F", bud]]),
    }
    return _word(draft, system_text(bud, rules), 2)


def _conditions(chance: Random, level: int, draft: Draft) -> Exercise | None:
    bound, start, again = chance.randint(2, 4), chance.randint(1, 2), chance.randint(0, 2)
    older, daughters = chance.choice([1, 1, 2]), [f"A({again})", f"B({chance.randint(1, 3)})"]
    chance.shuffle(daughters)
    lines = [f"axiom: A({start})" + f" A({chance.randint(0, bound)})" * (level == 1)]
    past = f" : x >= {bound}" if level < 3 else ""  # without it the production is for the modules that the first leaves
    lines += [f"A(x) : x < {bound} -> A(x+{older})", f"A(x){past} -> {' '.join(daughters)}"]
    if level > 1:
        ripe = chance.randint(2, 4)
        lines += [f"B(y) : y < {ripe} -> B(y+1)", f"B(y) : y >= {ripe} -> A({chance.randint(0, 2)}) B(1)"]
    return _word(draft, "\n".join(lines), bound + 1 + level)


def _context(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    left, old = chance.sample(letters, 2)
    new = [chance.choice(letters) for _ in range(chance.randint(1, 2))]
    lines = [f"{left} < {old} -> {' '.join(new)}"]
    if level > 1:
        other = chance.choice(letters)
        lines.append(f"{other} -> {' '.join(chance.choice(letters) for _ in range(chance.randint(1, 2)))}")
    if level > 2:
        one, right = chance.sample(letters, 2)
        lines.insert(1, f"{one} > {right} -> {chance.choice(letters)}")
    axiom = " ".join(chance.choice(letters) for _ in range(4 + level + chance.randint(0, 2)))
    if f"{left} {old}" not in axiom or new == [old]:  # nothing would happen in the first step
        return None
    return _word(draft, "\n".join([f"axiom: {axiom}", *lines]), 2 + (level > 1), 24)


MOST_PORTIONS = 30
"""The highest concentration in portions, of which a step, or two, makes whole numbers."""


def _diffusion(chance: Random, level: int, draft: Draft) -> Exercise | None:
    cells, filled, portion = 3 + level, (1, 2, 3 + level)[level - 1], 4 if level == 1 else 16
    first = [0] * cells
    for place in chance.sample(range(cells), filled):
        first[place] = portion * chance.randint(1, MOST_PORTIONS)
    lines = [f"axiom: {' '.join(f'C({each})' for each in first)}", "C(x) < C(c) > C(y) -> C(c + (x + y - 2*c)/4)"]
    ends = ["C(x) < C(c) -> C(c + (x - c)/4)", "C(c) > C(y) -> C(c + (y - c)/4)"]
    return _word(draft, "\n".join([*lines, *ends]), 1 + (level > 1))


# Totals as formulas


FACTORS = (*map(Fraction, (2, 3, 4, 5)), Fraction(1, 2), Fraction(1, 3), Fraction(2, 3), Fraction(3, 2))
"""By how much pieces are longer than those before."""


def _formulas(chance: Random, level: int, draft: Draft) -> Exercise | None:
    first, buds = chance.randint(1, 6) * chance.randint(1, 4), 1 if level == 1 else chance.randint(2, 3)
    factor, letter = (Fraction(chance.randint(1, 3)), "q") if level == 3 else (chance.choice(FACTORS), "")
    if factor * buds == 1:
        return None
    bud = f"A({_multiple(factor, letter)}*x)"
    branches = "".join(f" [{turn}{bud}]" for turn in "+-"[: buds - 1])
    system = f"{'q = 1/5' if letter else ''}\naxiom: A({first})\nA(x) -> F(x){branches} {bud}".strip()
    names: dict[str, Sequence[Fraction | int]] = {"q": (2, 3, Fraction(1, 5))} if letter else {}
    ratio = _multiple(factor * buds, letter)

    def summed(power: str, by: str = ratio) -> str:
        return f"{first}*({by}^{power} - 1)/({by} - 1)"

    alone = summed("n", _multiple(factor, letter)) if level > 1 and (letter or factor != 1) else f"{first}*n"
    wrong = f"{first}*{ratio}^(n - 1)", summed("(n + 1)"), summed("(n - 1)"), f"{first}/(1 - {ratio})", alone
    slips = tuple(Slip(each, gettext(says)) for each, says in zip(wrong, draft.said["replies"], strict=True))
    return draft.exercise(
        summed("n"),
        {"values": {**names, "n": (2, 3, 4, 5)}, "slips": slips, "system": system},
        letters=draft.text("letters"),
        first=first,
        second=f"{first}*{ratio}",
        third=f"{first}*{ratio}^2",
        ratio=ratio,
        whole=summed("n"),
    )


def _multiple(factor: Fraction, letter: str) -> str:
    """A number, or a multiple of a letter, as a factor of a formula."""
    if not letter:
        return f"{factor}" if factor.denominator == 1 else f"({factor})"
    return letter if factor == 1 else f"({factor}*{letter})"


# A misprint


def _misprint(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    system = system_text(chance.choice(letters), random_rules(chance, letters, 2 + (level == 1)))
    steps = 4 + (level > 1)
    words = words_of(system, steps)
    wrong = chance.randint(2, steps)
    word = words[wrong].split()
    if not 3 <= len(words[-1].split()) <= 24 or len(word) < 2 or len(set(words)) <= steps:
        return None
    at = chance.randrange(len(word))
    word[at] = chance.choice([letter for letter in letters if letter != word[at]])
    printed = [*words[:wrong], " ".join(word), *words[wrong + 1 :]]
    line, text = wrong + 1, "\n".join(printed)
    exercise = draft.exercise(line, {"text": text}, derivation_text(words), system, wrong=line, words=words[wrong])
    return _with_first_departures(exercise, system, printed, draft.text("following"))


def _with_first_departures(exercise: Exercise, system: str, printed: list[str], following: str) -> Exercise | None:
    """An exercise with the lines as slips at which words derived by a misconception first differ from those printed."""
    last = len(printed) - 1
    solution = "\n".join(words_of(system, last))
    derived = replace(exercise, kind="words", solution=solution, system=system, steps=last, text="", expects=())
    slips: dict[str, Slip] = {}
    for wrong in wrong_answers(derived):
        line = str(first_difference([" ".join(map(str, word)) for word in wrong.answer], printed) + 1)
        if wrong.misconception is None or wrong.misconception.near or int(line) > len(printed):
            continue
        if line == exercise.solution and wrong.misconception.name in ("sequential", "leftmost only", "one production a step"):
            return None
        if line != exercise.solution:
            slips.setdefault(line, Slip(line, misconception=wrong.misconception.name))
    after = str(int(exercise.solution) + 1)
    if int(after) <= len(printed):
        slips[after] = Slip(after, following, near=True)
    return replace(exercise, slips=tuple(slips.values()))


# A word of a language


def _language(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    system = system_text(chance.choice(letters), random_rules(chance, letters, 2 + (level != 2)))
    words = words_of(system, 7 + 2 * (level > 1))
    at = 2 + (level > 1) + chance.randint(0, 1)
    right = words[at]
    if not 3 <= len(right.split()) <= 14 or len(words[-1].split()) < 2 * len(right.split()):
        return None
    one = chance.choice([*_wrong_words(leftmost_only, system, at + 2), ""])
    other = chance.choice([*_wrong_words(sequential, system, at), ""])
    changed = right.split()
    place = chance.randrange(len(changed))
    changed[place] = chance.choice([letter for letter in letters if letter != changed[place]])
    wrong = [one, other, " ".join(changed)]
    if not all(word and word not in words and len(word.split()) <= 16 for word in wrong):
        return None
    replies = zip(wrong, map(gettext, draft.said["replies"]), strict=True)
    return draft.choice(chance, right, [*replies], after=derivation_text(words[: at + 1]), listing=system)


def _wrong_words(step: WrongStep, system: str, steps: int) -> list[str]:
    found = [" ".join(module.symbol for module in word) for word in words_by(step, system_of(system), steps)]
    return [word for word in found[2:] if 2 < len(word.split()) <= 16]


# Which rules


def _rules(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    rules = random_rules(chance, letters, 2 + (level > 2))
    words = words_of(system_text(chance.choice(letters), rules), 3 + (level == 1))
    asked = chance.choice(letters)
    if len({*words}) < len(words) or not 4 < len(words[-1].split()) <= 24 or len(rules[asked]) < 2:
        return None
    replaced = " ".join(words[:-1])
    if asked not in replaced or len(infer([word.replace(" ", "") for word in words])) != 1:
        return None
    right, others = " ".join(rules[asked]), [" ".join(rules[letter]) for letter in letters if letter != asked]
    wrong = {right[:-2]: "too_short", **dict.fromkeys(others, "of_another")}
    wrong[f"{right} {letters[0]}"] = "too_long"
    wrong.pop(right, None)
    keys = {"symbols": tuple(letters), "slips": tuple(Slip(word, draft.text(says)) for word, says in wrong.items())}
    fitting = ", ".join(f"{letter} -> {' '.join(made)}" for letter, made in rules.items() if letter in replaced)
    return draft.exercise(right, keys, f"{fitting}.", "\n".join(words), asked=asked)


def _listed(numbers: Sequence[int]) -> str:
    return ", ".join(map(str, numbers))


# Modules of a word


def _counts(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    system, steps = system_text(_some_of(chance, letters), random_rules(chance, letters, 3)), 3 + level
    growing = growth(system_of(system))
    found = [growing.counts_of(letter, steps)[steps] for letter in letters if f"\n{letter} ->" in system]
    if not 6 < sum(found) < 200 or 0 in found or len(set(found)) < len(found):
        return None
    keys = {"system": system, "steps": steps, "symbols": tuple(letters)}
    return draft.exercise(_listed(found), keys, _listed(growing.lengths(steps)), letters=", ".join(letters))


def _matrix(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    system = system_text(letters[0], random_rules(chance, letters, 2 + level))
    entries = list(map(int, growth(system_of(system)).matrix))
    size = len(letters)
    if len(entries) != size * size or len(set(entries)) < 2:
        return None
    rows = "\n".join(" ".join(map(str, entries[at : at + size])) for at in range(0, len(entries), size))
    return draft.exercise(rows, {"system": system}, order=", ".join(letters))


def _some_of(chance: Random, letters: str) -> str:
    """An axiom of one letter or two."""
    return " ".join(chance.choices(letters, k=chance.randint(1, 2)))


def _length(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    system = system_text(_some_of(chance, letters), random_rules(chance, letters, 2 + (level == 1)))
    steps = 4 + 3 * level + chance.randint(0, 3)
    found = growth(system_of(system)).lengths(steps)
    if found[3] < 3 or not 12 < found[-1] < 300 * 2**level:
        return None
    return draft.exercise(found[-1], {"system": system, "steps": steps}, _listed(found))


def _first_past(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    system = system_text(chance.choice(letters), random_rules(chance, letters, 3))
    bound = 10 ** (1 + level)
    lengths = growth(system_of(system)).lengths(40)
    first = next((step for step, length in enumerate(lengths) if length > bound), 0)
    if first < 4 or first > 30:
        return None
    keys = {"system": system, "steps": 40, "asks": f"first step past {bound}"}
    return draft.exercise(first, keys, _listed(lengths[: first + 1]), bound=f"{bound:,}")


def _strokes(chance: Random, level: int, draft: Draft) -> Exercise | None:
    stem = ["F"] * chance.randint(1, 2)
    bud = chance.choice("XABK")
    for _ in range(chance.randint(1, 2)):
        branch = chance.choice(["F", "FF"] if level < 3 else ["F", bud, f"F{bud}"])
        stem += ["[", chance.choice("+-"), *branch, "]", *["F"] * chance.randint(0, 1)]
    rules = {"F": stem} if level < 3 else {bud: [*stem, bud], "F": ["F", "F"]}
    axiom = {1: "F", 2: chance.choice(["F F", "F [ + F ] F", "F + F + F"]), 3: bud}[level]
    system, steps = system_text(axiom, rules), 2 + chance.randint(0, 1)
    found = growth(system_of(system)).counts_of("F", steps)
    if not 6 < found[steps] < 700:
        return None
    return draft.exercise(found[steps], {"system": system, "steps": steps}, _listed(found))


# Life spans


def _life_spans(chance: Random, level: int, draft: Draft) -> Exercise | None:
    life_a, life_b = chance.sample(range(2, 5 + level), 2)
    daughters_a = chance.choice([("A", "B"), ("B", "A"), ("B", "B")])
    daughters_b = chance.choice([("A", "B"), ("B", "A"), ("A",)])
    system = "\n".join(["axiom: A(1)", *_ageing("A", life_a, daughters_a), *_ageing("B", life_b, daughters_b)])
    steps = life_a + life_b + 4 + level + chance.randint(0, 3)
    found = growth(system_of(system)).lengths(steps)
    if not 4 < found[-1] < 500:
        return None

    def named(cells: Sequence[str]) -> str:
        part = "one" if len(cells) == 1 else "two" if len({*cells}) == 1 else "both"
        return draft.text(part, cell=cells[0], other=cells[-1])

    named_a, named_b = named(daughters_a), named(daughters_b)
    return draft.exercise(
        found[-1],
        {"system": system, "steps": steps},
        _listed(found),
        life_a=life_a,
        daughters_a=named_a,
        life_b=life_b,
        daughters_b=named_b,
    )


def _ageing(cell: str, life: int, daughters: Sequence[str]) -> list[str]:
    newborn = " ".join(f"{each}(1)" for each in daughters)
    return [f"{cell}(t) : t < {life} -> {cell}(t+1)", f"{cell}(t) : t == {life} -> {newborn}"]


# Stage diagrams


def _stages(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + level)
    rules = {letter: [following] for letter, following in pairwise(letters)}
    rules[letters[-1]] = last = [chance.choice(letters) for _ in range(3)]
    if level > 2:
        rules[letters[1]] = [letters[2], chance.choice(letters)]
    if len(set(last)) != 2:  # two daughters of one kind, and another
        return None
    lines = [f"{place} -> {_sum(made)}" for place, made in rules.items()]
    return draft.exercise("\n".join(lines), {"system": system_text(letters[0], rules)})


def _sum(letters: Sequence[str]) -> str:
    return " + ".join(f"{copies} {letter}" if copies > 1 else letter for letter, copies in Counter(letters).items())


# Chance


def _chance(chance: Random, level: int, draft: Draft) -> Exercise | None:
    weight = Fraction(chance.randint(1, 6), chance.randint(7, 12))
    one, other = [*random_letters(chance, 2)]
    rules = {one: [([one, other], weight), ([other] if level > 1 else [one], 1 - weight)]}
    if level > 2:
        share = chance.choice([Fraction(1, 3), Fraction(1, 4), Fraction(2, 5)])
        rules[other] = [([one], share), ([other], 1 - share)]
    axiom, steps = ([one, one], 1) if level == 1 else ([one], 2)
    if level == 1 and chance.random() < 0.5:
        axiom = [one, other, one, one]
    outcomes = _after(rules, axiom, steps)
    word = chance.choice(sorted(outcomes))
    share = outcomes[word]
    if share in (weight, 1 - weight, Fraction(1, 2)) or weight == Fraction(1, 2):  # a half is its own contrary
        return None
    lines = [
        f"{letter} -> {' '.join(made)}   {draft.text('odds', odds=odds)}"
        for letter, choices in rules.items()
        for made, odds in choices
    ]
    return draft.number(
        share,
        [weight, 1 - weight],
        keys={"tolerance": Fraction(1, 1000)},
        after=", ".join(f"{each}: {odds}" for each, odds in sorted(outcomes.items())) + ".",
        listing="\n".join(lines),
        axiom=" ".join(axiom),
        stays="" if level > 2 else draft.text("stays"),
        steps=steps,
        word=word,
    )


def _after(rules: dict[str, list[tuple[list[str], Fraction]]], word: list[str], steps: int) -> dict[str, Fraction]:
    found = {" ".join(word): Fraction(1)}
    for _ in range(steps):
        after: dict[str, Fraction] = {}
        for before, odds in found.items():
            for choices in product(*(rules.get(letter, [([letter], Fraction(1))]) for letter in before.split())):
                made = " ".join(letter for successor, _ in choices for letter in successor)
                after[made] = after.get(made, Fraction(0)) + odds * prod(each for _, each in choices)
        found = after
    return found


# Plants


def _flowering(chance: Random, level: int, draft: Draft) -> Exercise | None:
    every, through = chance.randint(3, 6), chance.randint(1, 2 + (level > 1))
    starts = every * chance.randint(2, 4 + level) + chance.randint(1, every - 1)
    passed = next((passed for passed in range(60) if (starts + passed * through) // every <= passed), 0)
    day, there = starts + passed * through, starts // every
    if not passed or through >= every:
        return None
    right, wrong = day, [starts + there * through, day - starts, starts + through]
    if level > 2:
        right, wrong = passed, [there, day, passed + 1]
    return draft.number(
        right,
        wrong,
        every=every,
        starts=starts,
        through=reply("practice.days", number=through),
        asked=draft.text("asked"),
        there=there,
        passed=passed,
        day=day,
    )


def _looking(chance: Random, level: int, draft: Draft) -> Exercise | None:
    shrinks, steps = (level > 1) * chance.randint(1, 2), chance.randint(4, 5) + 3 * (level == 1)
    first = chance.randint(3, 7) if level == 1 else chance.randint(9, 13)
    lengths = [first - shrinks * step for step in range(steps)]
    limit = chance.randint(first + 1, sum(lengths) - 1)
    looks_first = level < 3 or chance.random() < 0.5
    heights, others = _heights(lengths, limit, looks_first), _heights(lengths, limit, not looks_first)
    return draft.number(
        heights[-1],
        [sum(lengths), limit, others[-1]],
        heights=_listed(heights),
        first=first,
        shorter=draft.text("shorter" if shrinks else "equal", shrinks=shrinks),
        looks=draft.text("looks_first" if looks_first else "looks_ahead", limit=limit),
        steps=steps,
    )


def _heights(lengths: Sequence[int], limit: int, looks_first: bool) -> list[int]:
    """The heights of a bud that looks where it is, or where it would be."""

    def grown(height: int, length: int) -> int:
        return height + length * (height < limit if looks_first else height + length <= limit)

    return [*accumulate(lengths, grown, initial=0)]


def _hedge(chance: Random, level: int, draft: Draft) -> Exercise | None:
    height, lost, buds = chance.randint(5, 9), chance.randint(2, 4), 2 + (level > 1) * chance.randint(0, 1)
    steps = chance.randint(height + lost, height + 5 * lost)
    cuts = sum(1 for step in range(1, steps + 1) if step >= height and (step - height) % lost == 0)
    start = chance.randint(2, 4) if level > 2 else 1
    return draft.number(
        start * buds**cuts,
        [start + (buds - 1) * cuts * start, start * buds ** (steps // height), start * buds ** (cuts - 1)],
        of=reply("practice.shoots", number=start),
        height=height,
        lost=lost,
        buds=buds,
        steps=steps,
        cuts=cuts,
    )


def _walls(chance: Random, level: int, draft: Draft) -> Exercise | None:
    sides, steps = chance.randint(3, 18), level + chance.randint(0, 2)
    cells = chance.randint(1, 2 + level)
    walls = cells * sides - (cells - 1)
    made = cells * (2**steps - 1)
    wanted = walls + 3 * made
    return draft.number(
        wanted,
        [walls + made, walls + 3 * cells * steps, walls * 2**steps],
        begin=draft.text("one_cell" if cells == 1 else "two_cells" if cells == 2 else "row", sides=sides, cells=cells),
        steps=steps,
        made=made,
        walls=walls,
        wanted=wanted,
    )


# Time


def _slices(chance: Random, level: int, draft: Draft) -> Exercise | None:
    slice_ = Fraction(chance.randint(6, 34), 20)
    life = chance.randint(1, 5)
    newborn = Fraction(chance.randint(1, 9), 10) if level > 1 else Fraction(0)
    slices = ceil(life / slice_)
    left = slices * slice_ - life
    if left + newborn >= life or not left or (level > 1 and slices < 2):
        return None
    passed, total, each = slices * slice_, ceil((2 * life - newborn) / slice_), ceil((life - newborn) / slice_)
    right, late = passed - life + newborn, passed - life
    if level == 1:
        wrong, after = [slice_, passed, life - (slices - 1) * slice_], "."
    elif level == 2:
        wrong, after = [newborn, passed, slice_ + newborn], draft.text("from_the_start", newborn=_decimal(newborn))
    else:
        right, passed, after = Fraction(total), 2 * life - newborn, ""
        wrong = [Fraction(slices), Fraction(slices + each), Fraction(each)]
    return draft.number(
        right,
        wrong,
        after=after,
        life=life,
        begins=draft.text("begins", newborn=_decimal(newborn)),
        slice=_decimal(slice_),
        slices=slices,
        passed=_decimal(passed),
        late=_decimal(late),
        total=total,
    )


def _decimal(value: Fraction | int) -> str:
    return f"{float(value):g}"


def _lengths(chance: Random, level: int, draft: Draft) -> Exercise | None:
    return (_shares, _other_daughter, _filament)[level - 1](chance, draft)


def _shares(chance: Random, draft: Draft) -> Exercise | None:
    short, long = sorted(chance.sample(range(1, 8), 2))
    length, parts = (short + long) * chance.randint(2, 15), short + long
    wrong = [Fraction(length, 2), length * Fraction(short, long), length * Fraction(long, parts)]
    return draft.number(length * Fraction(short, parts), wrong, length=length, short=short, long=long, parts=parts)


MOST_POWER = 20_000
"""The greatest power that is to be computed by hand."""


def _other_daughter(chance: Random, draft: Draft) -> Exercise | None:
    base, life = chance.randint(2, 12), chance.randint(2, 7)
    age = chance.randint(0, life - 1)
    mother, daughter = base**life, base**age
    if mother > MOST_POWER:
        return None
    wrong = [base ** (life - age), base * life - base * age, mother]
    return draft.number(mother - daughter, wrong, base=base, life=life, age=age, mother=mother, daughter=daughter)


def _filament(chance: Random, draft: Draft) -> Exercise | None:
    factor, units, first, cells = chance.randint(2, 4), chance.randint(2, 4), chance.randint(2, 9), chance.randint(3, 12)
    right = first * factor**units
    wrong = [first * factor * units, first * cells, right * cells]
    return draft.number(right, wrong, first=first, factor=factor, units=units, cells=cells)


# Types of growth


TYPES = ("bounded", "linear", "quadratic", "exponential")
"""The types of growth that are told apart."""


def growth_type(lengths: Sequence[int]) -> str:
    """The type of growth of a long row of lengths; empty where it is none of those that are told apart.

    >>> growth_type([2 * n + 3 for n in range(40)]), growth_type([1, 2] * 20), growth_type([2**n for n in range(40)])
    ('linear', 'bounded', 'exponential')
    """
    late = lengths[len(lengths) // 2 :]
    if max(late) <= max(lengths[: len(lengths) // 2]):
        return "bounded"
    ratio = late[-1] / late[0]
    if ratio > len(lengths):
        return "exponential"
    differences = [after - before for before, after in zip(late, late[6:], strict=False)]
    second = {after - before for before, after in zip(differences, differences[6:], strict=False)}
    return "" if len(second) > 1 else "linear" if second == {0} else "quadratic"


def _growth_type(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = random_letters(chance, 2 + (level > 1))
    wanted = chance.choice(TYPES[: 3 + (level > 1)] if level > 1 else ("bounded", "linear", "exponential"))
    rules = {
        letter: [chance.choice(letters[max(0, at - (level > 2)) :]) for _ in range(chance.randint(1, 3))]
        for at, letter in enumerate(letters)
    }
    first = letters[0]
    rules[first] = [first, *rules[first]] if wanted == "quadratic" else rules[first]
    system = system_text(first, rules)
    lengths = growth(system_of(system)).lengths(48)
    if growth_type(lengths) != wanted or (wanted == "bounded" and lengths[1] == 1):
        return None
    wrong = [(gettext(each), draft.text(each)) for each in TYPES if each != wanted]
    return draft.choice(chance, gettext(wanted), wrong, after=f"{_listed(lengths[:9])}, ...", listing=system)


# On squared paper


Place: TypeAlias = tuple[int, int]
Commands: TypeAlias = Mapping[str, str]
MISTAKEN: Mapping[str, Commands] = {
    "plus and minus swapped": {"+": "-", "-": "+"},
    "brackets dropped": {"[": "", "]": ""},
    "heading restored, place not": {"]": "h"},
    "place restored, heading not": {"]": "p"},
    "turn moves": {"+": "+F", "-": "-F"},
}
"""What somebody takes the commands for who has a misconception; h and p restore the heading alone, and the place."""


def end_of(word: str, mistaken: Commands | None = None) -> Place:
    """Where a turtle stands in the end that began at (0, 0), turned upwards, and turns by 90 degrees.

    >>> end_of("F+F"), end_of("F+F", MISTAKEN["plus and minus swapped"])
    ((-1, 1), (1, 1))
    """
    at, heading = 0j, 1j
    kept: list[tuple[complex, complex]] = []
    for symbol in "".join((mistaken or {}).get(each, each) for each in word):
        match symbol:
            case "F" | "f":
                at += heading
            case "+":
                heading *= 1j
            case "-":
                heading *= -1j
            case "[":
                kept.append((at, heading))
            case _:
                place, direction = kept.pop()
                at, heading = at if symbol == "h" else place, heading if symbol == "p" else direction
    return int(at.real), int(at.imag)


def _turtle(chance: Random, level: int, draft: Draft) -> Exercise | None:
    word = "F" + "".join(_part(chance, level) for _ in range(1 + level)) + chance.choice("+-") + "F"
    right = end_of(word)
    wrong: dict[Place, str] = {}
    for name, mistaken in MISTAKEN.items():
        wrong.setdefault(end_of(word, mistaken), name)
    if right in wrong or len(wrong) < 3:
        return None
    places = chance.sample(sorted(wrong), 3)
    expects = tuple(wrong[place] for place in places)
    places.insert(chance.randint(0, 3), right)
    options = tuple(Option(str(place), misconception=wrong.get(place, "")) for place in places)
    letter = ascii_uppercase[places.index(right)]
    return draft.exercise(letter, {"options": options, "expects": expects}, listing=word, right=right)


def _part(chance: Random, level: int) -> str:
    turn = chance.choice("+-")
    strokes = "F" * chance.randint(1, 1 + (level > 1))
    branch = f"[{turn}{strokes}{chance.choice(['', '+F', '-F']) if level > 1 else ''}]"
    return chance.choice([branch, f"{branch}F", f"{turn}{strokes}", f"F{branch}"])


# In space


Vector: TypeAlias = tuple[int, ...]
DIRECTIONS: Mapping[Vector, str] = {
    (0, 0, 1): "upwards",
    (0, 0, -1): "downwards",
    (-1, 0, 0): "to the left",
    (1, 0, 0): "to the right",
    (0, -1, 0): "towards you",
    (0, 1, 0): "away from you",
}
"""x grows to the right, y away from the viewer, z upwards."""


AXES: Sequence[Vector] = ((0, 0, 1), (-1, 0, 0), (0, -1, 0))
"""The turtle's heading, its left and its up: it looks upwards, and its back is turned to the viewer (ABOP, section 1.5)."""
_TURNS = {"+": (0, 1), "-": (1, 0), "&": (2, 0), "^": (0, 2), "\\": (2, 1), "/": (1, 2)}
"""For each turn by 90 degrees which of its axes comes to stand where which other one was."""


def heading_after(word: str) -> Vector:
    """The heading of the turtle behind a word.

    >>> DIRECTIONS[heading_after("F+F")], DIRECTIONS[heading_after("F&F")], DIRECTIONS[heading_after("F/F")]
    ('to the left', 'away from you', 'upwards')
    """
    axes = [*AXES]
    for command in word.replace("F", ""):
        one, other = _TURNS[command]
        axes[one], axes[other] = axes[other], tuple(-each for each in axes[one])
    return axes[0]


def _heading(chance: Random, level: int, draft: Draft) -> Exercise | None:
    commands = [chance.choice("+-&^/\\") for _ in range(max(3, level + chance.randint(1, 2)))]
    rolls = sum(command in "/\\" for command in commands)
    if not 0 < rolls < len(commands) or (level == 1 and rolls > 1):
        return None
    word = "F" + "".join(command + ("F" if chance.random() < 0.5 else "") for command in commands[:-1]) + commands[-1] + "F"
    right = heading_after(word)
    without_rolls, rolled = word.replace("/", "").replace("\\", ""), word.translate(str.maketrans("/\\", "\\/"))
    wrong = zip(map(heading_after, (without_rolls, rolled, word[::-1])), draft.said["replies"], strict=True)
    others = ((vector, draft.said["again"]) for vector in chance.sample([*DIRECTIONS], 6) if vector != right)
    found: dict[Vector, str] = {}
    for vector, says in (*wrong, *others):
        found.setdefault(vector, says)
    if right in found:
        return None
    shown = [(gettext(DIRECTIONS[vector]), gettext(says)) for vector, says in [*found.items()][:3]]
    direction = gettext(DIRECTIONS[right])
    return draft.choice(chance, direction, shown, listing=word, word=word, direction=direction)


MAKERS: dict[str, Maker] = {
    "derive": _derive,
    "misprint": _misprint,
    "brackets": _brackets,
    "conditions": _conditions,
    "context": _context,
    "diffusion": _diffusion,
    "counts": _counts,
    "matrix": _matrix,
    "length": _length,
    "first": _first_past,
    "stages": _stages,
    "formulas": _formulas,
    "life spans": _life_spans,
    "chance": _chance,
    "turtle": _turtle,
    "strokes": _strokes,
    "flowering": _flowering,
    "looking": _looking,
    "hedge": _hedge,
    "walls": _walls,
    "slices": _slices,
    "lengths": _lengths,
    "space": _heading,
    "language": _language,
    "growth type": _growth_type,
    "rules": _rules,
}
