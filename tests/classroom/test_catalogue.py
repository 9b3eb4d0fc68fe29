"""Every word that the table of systems prints comes out of the catalogue's rules."""

from fractions import Fraction
from itertools import pairwise

import pytest

from lsys_kit import derive, draw, explore, read, stages, timed, write
from lsys_kit.classroom.catalogue import WORKS, Entry, entry, system, systems
from lsys_kit.classroom.lessons.lesson import lesson
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.filament import filament

STAGES = {"S": 1, "L": 2, "A": 3, "B": 4, "C": 5}
POLARITY = {"l": -1, "r": 1}


def staged(word):
    """A word of P2, P3 or P4 as stages and polarities."""
    if all(module.symbol[0] in STAGES for module in word):
        return [(STAGES[module.symbol[0]], POLARITY[module.symbol[2]]) for module in word]
    return [(m.arguments[0], m.arguments[1] if m.symbol == "M" else POLARITY[m.symbol[2]]) for m in word]


def ages(word):
    return [(float(module.arguments[0]), "L" if module.arguments[1] == -1 else "R") for module in word]


@pytest.mark.parametrize("id", systems())
def test_the_printed_words_come_out(id):
    for step, word in entry(id).words.items():
        assert str(derive(system(id), step)[-1]) == word


@pytest.mark.parametrize("id", systems())
def test_the_lengths_come_out(id):
    lengths = list(entry(id).lengths)
    assert lengths
    assert derive(system(id), len(lengths) - 1).lengths == lengths


@pytest.mark.parametrize("id", systems())
def test_what_is_written_reads_back(id):
    assert read(write(system(id)), system(id).notation) == system(id)


@pytest.mark.parametrize("id", systems())
def test_a_first_look_is_small_and_not_empty(id):
    steps = system(id).steps
    assert steps
    assert 2 <= len(derive(system(id), steps)[-1]) <= 2000


@pytest.mark.parametrize("id", systems())
def test_an_entry_says_where_it_comes_from(id):
    found = entry(id)
    assert isinstance(found, Entry)
    assert found.id == id
    assert found.work in WORKS
    assert found.status in ("as printed", "corrected", "found", "memory", "reconstruction")
    assert not (found.status == "corrected" and not found.errata)
    assert found.source
    assert all(sentence.endswith(".") for sentence in found.errata + found.notes)


def test_the_rows_of_the_lessons_are_all_there():
    assert " ".join(systems()) == (
        "J1 J2 J3 J4 J5 J6 T1 T2 T3 P1 P2 P3 P4 P5 P6 P7 P8 P9 P9w "
        "K1 K2 K3 K4 K5 K5b K6 K7 K8 K9 K10 K11 K12 K13 K14 K15 K16 K17a K17b K18 K19 K20 "
        "K21 K22 K23 K24 K24b K25 K26 K27 L0 L1 L2 L3 L4 N1 N1b N2 N3 N4 N5 N6 N7"
    )


@pytest.mark.slow
@pytest.mark.parametrize("id", systems())
def test_each_system_can_be_explored(id):
    panel = explore(id)
    for step in (0, 1, system(id).steps):
        panel.step = step
        assert panel.sight.step == step
    assert draw(stages(system(id)), tokens=panel.sight.word).svg.startswith("<svg")
    assert draw(system(id)).svg.startswith("<svg")


def test_the_words_of_j1_to_step_6():
    assert (
        "\n".join(map(str, derive(system("J1"), 6)))
        == """\
ar
al br
bl ar ar
al al br al br
bl ar bl ar ar bl ar ar
al al br al al br al br al al br al br
bl ar bl ar ar bl ar bl ar ar bl ar ar bl ar bl ar ar bl ar ar"""
    )


@pytest.mark.parametrize(("id", "names"), [("T1", {}), ("P1", {"L_": "a", "S_": "b"}), ("K1", {"A": "a", "B": "b"})])
def test_four_works_print_the_same_anabaena(id, names):
    for word, other in zip(derive(system("J1"), 7), derive(system(id), 7), strict=True):
        renamed = str(other)
        for name, letter in names.items():
            renamed = renamed.replace(name, letter)
        assert renamed == str(word)
    assert entry(id).same_as == "J1"


def test_the_filament_of_j1_grows_to_34_units():
    assert [filament(word).width for word in derive(system("J1"), 6)] == [2, 3, 5, 8, 13, 21, 34]


def test_one_word_of_j4_as_jacob_prints_it():
    printed = "Al(2)Br(2)Al(1)Br(1)Ar(3)Al(1)Br(1)Bl(2)Ar(2)Al(1)Br(1)Ar(3)"
    assert str(derive(system("J4"), 10)[-1]) == printed


@pytest.mark.parametrize(("id", "a", "b"), [("J4", 3, 2), ("J5", 2, 5), ("J4", 1, 4), ("J5", 6, 6)])
def test_the_cells_of_a_filament_obey_their_life_spans(id, a, b):
    lengths = derive(system(id), 25, lifeTimeA=a, lifeTimeB=b).lengths
    assert all(lengths[t] == lengths[t - a] + lengths[t - b] for t in range(max(a, b), 26))


def test_j5_has_no_filament_of_its_own_but_other_life_spans():
    assert list(derive(system("J4"), 15, lifeTimeA=2, lifeTimeB=5)) == list(derive(system("J5"), 15))


def test_the_koch_snowflake():
    derivation = derive(system("T2"), 4)
    assert [word.counts()["F"] for word in derivation] == [3, 12, 48, 192, 768]
    assert derivation.lengths == [7, 28, 112, 448, 1792]
    side = "F+F--F+F+F+F--F+F--F+F--F+F+F+F--F+F--"
    assert str(derivation[2]) == (3 * side).removesuffix("--")


@pytest.mark.slow
def test_chance_turns_the_bulges_of_a_stochastic_koch_curve_and_not_their_number():
    first = {"outward": "F+F--F+F", "inward": "F-F++F-F"}
    for seed in range(40):
        words = derive(system("T3"), 3, seed=seed)
        assert [word.counts()["F"] for word in words] == [3, 12, 48, 192]
    one = [str(derive(read("axiom: F\nF -> F+F--F+F : 1/2\nF -> F-F++F-F : 1/2"), 1, seed=seed)[-1]) for seed in range(900)]
    assert set(one) == set(first.values())
    assert all(390 <= one.count(word) <= 510 for word in first.values())


def test_the_production_of_the_plant_strings_notation_adds_eight_characters_to_each_i():
    words = derive(system("L0"), 8)
    assert [word.counts()["I"] for word in words] == [2**n for n in range(9)]
    assert words.lengths == [8 * 2**n - 7 for n in range(9)]


def test_the_stages_of_p2_are_the_values_of_p3_and_p4():
    p2, p3, p4 = (derive(system(id), 23) for id in ("P2", "P3", "P4"))
    for step in range(21):
        assert staged(p2[step]) == staged(p3[step])
        assert staged(p2[step + 3]) == staged(p4[step])


def test_p4_from_the_same_stage_is_p3():
    rules = entry("P4").rules.replace("axiom: M(lifeTime,RIGHT)", "axiom: M(2,RIGHT)")
    for word, other in zip(derive(read(rules), 20), derive(system("P3"), 20), strict=True):
        assert staged(word) == staged(other)


def test_a_short_cell_lives_five_steps_and_a_long_one_four():
    lengths = derive(system("P2"), 40).lengths
    assert all(lengths[t] == lengths[t - 4] + lengths[t - 5] for t in range(5, 41))


@pytest.mark.parametrize("id", ["P2", "P3", "P4"])
def test_a_filament_grows_without_a_jump_at_division(id):
    widths = [filament(word).width for word in derive(system(id), 15)]
    assert all(after / before == pytest.approx(2.1673**0.2, abs=1e-4) for before, after in pairwise(widths))


def test_l_system_5_steps_through_continuous_time():
    words = derive(system("P5"), 5)
    assert [ages(word) for word in words[:5]] == [
        [(0, "R")],
        [(0.7, "R")],
        [(0.6, "L"), (0.4, "R")],
        [(0.3, "L"), (0.5, "R"), (0.3, "L"), (0.1, "R")],
        [(0, "L"), (0.2, "R"), (0.4, "L"), (0.2, "R"), (0, "L"), (0.2, "R"), (0.8, "R")],
    ]
    assert words.lengths == [1, 1, 2, 4, 7, 9]


def test_too_long_a_step_leaves_cells_past_their_division():
    words = derive(system("P5"), 4, dt="14/10")
    assert words.lengths == [1, 2, 4, 8, 16]
    assert ages(words[2]) == [(1.0, "L"), (1.2, "R"), (1.0, "L"), (0.8, "R")]


def test_doubles_fall_into_the_trap():
    assert derive(system("P5"), 6, arithmetic="float").lengths == [1, 1, 2, 4, 5, 9, 16]


def test_decomposition_serves_steps_of_any_length():
    short, long = derive(system("P6"), 10), derive(system("P6"), 5, dt="14/10")
    assert [ages(word) for word in short][::2] == [ages(word) for word in long]
    assert long.lengths[:4] == [1, 2, 7, 17]
    assert [list(word) for word in short][:6] == [list(word) for word in derive(system("P5"), 5)]


def test_interpretation_rules_do_not_change_the_derivation():
    assert [list(word) for word in derive(system("P7"), 8)] == [list(word) for word in derive(system("P6"), 8)]


@pytest.mark.parametrize("id", ["P7", "P8"])
def test_the_filament_of_l_systems_7_and_8_grows_without_a_jump(id):
    widths = [filament(word).width for word in derive(system(id), 5)]
    assert widths == pytest.approx([1, 1.7185, 2.9532, 5.0749, 8.7212, 14.9872], rel=1e-4)


def test_size_and_age_divide_the_same_cells():
    for by_size, by_age in zip(derive(system("P8"), 12), derive(system("P6"), 12), strict=True):
        assert [module.arguments[1] for module in by_size] == [module.arguments[1] for module in by_age]


def test_walls_divide_cells_one_step_later():
    with_walls, without = derive(system("P9"), 9), derive(system("P6"), 8)
    for step in range(9):
        cells = [float(module.arguments[0]) for module in with_walls[step + 1] if module.symbol == "M"]
        assert cells == pytest.approx([age + 0.7 for age, _ in ages(without[step])])


def test_the_short_cell_lies_on_the_side_of_the_older_wall():
    for word in derive(system("P9w"), 8):
        for left, cell, right in zip(word[::2], word[1::2], word[2::2], strict=False):
            if cell.symbol.startswith("L"):
                assert (left.arguments > right.arguments) == (cell.symbol == "L_l")
        assert [m.symbol for m in word if m.symbol != "W"] == [m.symbol for m in derive(system("P1"), 8)[word_step(word)]]


def word_step(word):
    """The step of a word of P9w: the age of its first wall."""
    return word[0].arguments[0]


def test_a_hormone_front_moves_by_one_cell_a_step():
    words = ["".join(str(word).split()) for word in derive(system("J2"), 15)]
    assert [word.find("d") for word in words] == [8] * 9 + [7, 6, 5, 4, 3, 2, 1]
    assert {len(word) for word in words} == {9}


def test_a_layer_has_the_period_of_twice_its_width():
    for width in (2, 5, 11):
        words = [str(word) for word in derive(system("J3"), 4 * width + 3, w=width)]
        assert words[2 * width :] == words[: len(words) - 2 * width]
        assert len(set(words)) == 2 * width


def test_three_productions_are_drawn_alike():
    successors = {"F[+F]F[-F]F", "F[+F]F", "F[-F]F"}
    made = [str(derive(system("K7"), 1, seed=seed)[-1]) for seed in range(900)]
    assert set(made) == successors
    assert all(240 <= made.count(word) <= 360 for word in successors)


def opened_in(id, steps, **constants):
    """The step at which each branch, counted from below, has its flower; the main axis as `main`."""
    opened = {}
    for step, word in enumerate(derive(system(id), steps, **constants)):
        branch = depth = 0
        for module in word:
            depth += {"[": 1, "]": -1}.get(module.symbol, 0)
            branch += module.symbol == "[" and depth == 1
            if module.symbol == "C":
                opened.setdefault(branch if depth else "main", step)
    return opened


@pytest.mark.parametrize(("id", "lowest", "main"), [("K17a", 19, 24), ("K17b", 31, 24)])
def test_flowers_open_upward_or_downward(id, lowest, main):
    opened = opened_in(id, 31)
    assert (opened[1], opened["main"]) == (lowest, main)
    assert {lowest, main} == {min(opened.values()), max(opened.values())}


def test_the_plant_of_the_mystery_flowers_strictly_from_the_top_down_and_that_of_the_catalogue_on_the_whole():
    picture = lesson("10").vote.picture
    strictly = opened_in(picture["system"], 57, **picture["constants"])
    assert [strictly.pop("main"), *(strictly[branch] for branch in sorted(strictly, reverse=True))] == [24, *range(27, 58, 3)]
    on_the_whole = opened_in("K17b", 31)
    assert (on_the_whole[4], on_the_whole[5]) == (28, 29)


def test_two_branches_bear_the_first_flowers_of_the_plant_that_flowers_upward():
    opened = opened_in("K17a", 24)
    assert {place for place, step in opened.items() if step == 19} == {1, 2}
    assert {place for place, step in opened.items() if step == 24} == {11, "main"}


@pytest.mark.parametrize("id", ["K17a", "K17b"])
def test_signals_and_flowers_are_broad_and_nothing_else_is(id):
    word = derive(system(id), 24)[-1]
    widths = [*scene_of(word).segments.widths]
    assert (widths.count(4), widths.count(2)) == (2 * word.counts()["S"], 3 * word.counts()["C"])
    assert min(word.counts()["S"], word.counts()["C"]) > 0
    assert set(widths) == {-1, 2, 4}


def test_flowers_of_lychnis_are_fibonacci_numbers_less_one():
    flowers = [word.counts()["K"] for word in derive(system("K19"), 21)]
    assert flowers[1::4] == [1, 2, 4, 7, 12, 20]


def test_branches_are_longer_toward_the_top():
    word = derive(system("K11"), 3)[-1]
    assert [m.arguments[0] for m in word if m.symbol == "L+"] == [0, 100, 200, 300, 400]
    assert [w.counts()["F"] for w in derive(system("K11"), 3, branches=3)] == [0, 0, 4, 11]


def test_a_spruce_makes_as_many_shoots_each_year_as_the_table_says():
    assert [word.counts()["F"] for word in derive(system("K13"), 5)] == [0, 0, 1, 7, 28, 94]


def test_a_mint_has_twelve_nodes_with_24_leaves_and_14_cymes():
    words = derive(system("K14"), 13)
    assert [word.counts()["leaf"] for word in words] == [0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 24]
    assert words[-1].counts()["B"] == 14


def test_a_beech_twig_has_as_many_internodes_each_year_as_the_table_says():
    words = [word.counts() for word in derive(system("K15"), 3)]
    assert [counts["x"] + counts["y"] for counts in words] == [0, 6, 20, 46]


def test_two_signals_make_a_plant_flower_from_the_top_down():
    words = [[module.symbol for module in word if module.symbol in "BCK"] for word in derive(system("K18"), 60)]
    begun = [word.count("B") for word in words]
    assert begun[32] == 15
    for word in words[33:]:
        assert word == sorted(word), "buds B below, then what unfolds C, then flowers K"
    assert set(words[-1]) == {"K"}


def test_an_artificial_flower_sprouts_three_and_five_steps_after_each_bloom():
    blooms = [word.counts()["bloom"] for word in derive(system("J6"), 14)]
    opened = [0, *(after - before for before, after in pairwise(blooms))]
    assert opened[:2] == [0, 1]
    assert all(opened[n] == opened[n - 3] + (opened[n - 5] if n > 5 else 0) for n in range(4, 15))


def test_the_roots_of_meristems_send_up_plants_of_their_own():
    counts = derive(system("K12"), 15)[-1].counts()
    assert 954 <= counts["F"] <= 1448, "as chance will have it"
    assert counts["*"] in range(9, 16)
    assert counts["u2"] + counts["u2'"] == 0


def test_a_meta_rule_keeps_the_word_of_a_moving_organism_short():
    for step, word in enumerate(derive(system("K26"), 30, seed=4, short=1)):
        x, y = map(float, word[1].arguments) if step else (0, 0)
        assert [m.symbol for m in word] == (["h", "f", "a"] if step else ["h", "a"])
        assert x * x + y * y <= step * step + 1e-9


def test_without_the_meta_rule_the_word_shows_the_whole_path_and_is_longer_by_one_module_a_step():
    assert derive(system("K26"), 20).lengths == [n + 2 for n in range(21)]
    assert derive(system("K26"), 20, short=1).lengths == [2, *20 * [3]]
    for short, strokes in ((0, 12), (1, 1)):
        path = draw(system("K26"), 12, short=short, seed=3).scene.segments
        assert len(path) == 4 + strokes + 1, "the cross, the path, and the organism"
    straight, short = (draw(system("K26"), 9, turn=0, short=short).scene.segments.ends for short in (0, 1))
    assert straight[-1] == pytest.approx(short[-1]), "the organism is where its steps add up to"


TIMED_ANABAENA = "axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)"


@pytest.mark.slow
@pytest.mark.parametrize("dt", ["1/2", "1/3", "0.7", "1", "3/2", "2", "0.1"])
def test_the_timed_anabaena_in_steps_is_the_word_at_any_time(dt):
    at_time = timed(read(TIMED_ANABAENA))
    for step, word in enumerate(derive(system("K27"), 12, dt=dt)):
        assert word == at_time.word(step * Fraction(dt))


def test_the_timed_anabaena_grows_by_the_golden_ratio_in_a_time_of_one():
    for dt in ("1/2", "1/3", "0.7"):
        widths = [filament(word).width for word in derive(system("K27"), 12, dt=dt)]
        golden = (1 + 5**0.5) / 2
        assert widths == pytest.approx([golden ** (1 + step * float(Fraction(dt))) for step in range(13)])


def test_k5_multiplies_its_strokes_by_five():
    derivation = derive(system("K5"), 7)
    assert [word.counts()["F"] for word in derivation] == [5**n for n in range(8)]
    assert derivation.lengths[-1] == 195311


def test_the_plant_string_and_its_reader_exercise():
    words = derive(system("L1"), 3)
    assert str(words[2]) == "I[A]I(I)[A[I]B]I[A]I(I)(I[A]I(I))"
    assert [len(str(word)) for word in words] == [1, 8, 33, 119]
    step_2 = {"I": "I[A]I(I)", "A": "A[I]B"}
    assert str(words[3]) == "".join(step_2.get(letter, letter) for letter in str(words[2]))
