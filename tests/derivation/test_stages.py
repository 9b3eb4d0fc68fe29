"""Stage diagrams: places, transitions and tokens of a Petri net that fires everywhere at once (seed 002, figure 2)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import derive
from lsys_kit.classroom.catalogue import system as catalogued
from lsys_kit.classroom.catalogue import systems as catalogue
from lsys_kit.derivation.core.chance import Chance
from lsys_kit.derivation.petri.stages import Stages, stages
from lsys_kit.derivation.timed.timed import timed
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Module, Pattern
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read
from tests.derivation.timed_nets import fired_in_time

FILAMENT = """
a_r(t) : t < {0} -> a_r(t+1)
a_r(t) -> b_l(1) a_r(1)
a_l(t) : t < {0} -> a_l(t+1)
a_l(t) -> a_l(1) b_r(1)
b_r(t) : t < {1} -> b_r(t+1)
b_r(t) -> b_l(1) a_r(1)
b_l(t) : t < {1} -> b_l(t+1)
b_l(t) -> a_l(1) b_r(1)
interpretation:
a_r(t) -> R(2, 1, t)
a_l(t) -> L(2, 1, t)
b_r(t) -> R(1, 1, t)
b_l(t) -> L(1, 1, t)
axiom: a_r(1)"""


def test_places_are_states_and_transitions_are_productions() -> None:
    net = stages(read("axiom: S\nS -> L\nL -> A\nA -> L S S"))
    assert list(map(str, net.places)) == ["S", "L", "A"]
    assert [(t.place, t.production) for t in net.transitions] == [(0, 0), (1, 1), (2, 2)]
    assert repr(net) == "S -> L\nL -> A\nA -> L + 2 S"
    assert [(a.transition, a.place, a.copies, a.positions) for a in net.arcs] == [
        (0, 1, 1, (1,)),
        (1, 2, 1, (1,)),
        (2, 1, 1, (1,)),
        (2, 0, 2, (2, 3)),
    ]


def test_a_place_that_nothing_leaves_keeps_its_tokens() -> None:
    net = stages(read("axiom: A\nA -> B C\nB -> ε"))
    assert repr(net) == "A -> B + C\nB -> ε"
    assert net.fired((1, 2, 3)) == (0, 1, 4)


@pytest.mark.parametrize("life_spans", [(3, 2), (2, 5), (1, 1)])
def test_tokens_ignore_order_and_polarity(life_spans: tuple[int, int]) -> None:
    system = read(FILAMENT.format(*life_spans))
    net, both = stages(system), stages(system, polarity=True)
    assert len(net.places) == sum(life_spans)
    assert len(both.places) >= 2 * len(net.places) - 2
    for before, after in pairwise(derive(system, 9)):
        assert net.fired(net.tokens(before)) == net.tokens(after)
        assert both.fired(both.tokens(before)) == both.tokens(after)
        assert sum(net.tokens(after)) == len(after)


def test_cells_that_differ_in_more_than_polarity_have_places_of_their_own() -> None:
    system = read("axiom: A B\nA -> B\nB -> A\ninterpretation:\nA -> R(1,1)\nB -> L(2,1)")
    assert len(stages(system).places) == 2
    assert len(stages(read("axiom: A B\nA -> B\nB -> A\ninterpretation:\nA -> R(1,1)\nB -> L(1,1)")).places) == 1
    assert len(stages(read("axiom: A B\nA -> B\nB -> A\ninterpretation:\nA -> R(1,1)\nB -> F")).places) == 2


def test_positions_that_depend_on_the_polarity_are_not_told() -> None:
    net = stages(read(FILAMENT.format(1, 1)))
    assert {arc.positions for arc in net.arcs} == {()}


def test_states_that_do_not_end_are_grouped_by_symbol() -> None:
    net = stages(read("k = 3\naxiom: A(0)\nA(t) : t < k -> A(t+1)\nA(t) -> A(t+1) A(t) B\nB -> C(1)"))
    assert net.grouped
    assert list(map(str, net.places)) == ["A", "B", "C"]
    assert repr(net) == "A -> A if t < k\nA -> 2 A + B\nB -> C"
    assert net.tokens([Module("A", (7,)), Module("C", (1,)), Module("A", (2,))]) == (2, 0, 1)
    with pytest.raises(ModelValueError, match="grouped by symbol"):
        net.fired((1, 0, 0))


def test_a_diagram_that_nobody_could_read_is_grouped() -> None:
    text = "axiom: A(1)\nA(t) : t < {0} -> A(t+1)\nA(t) -> A(1) A(2)"
    assert not stages(read(text.format(40))).grouped
    assert stages(read(text.format(41))).grouped


def test_what_is_grouped_can_be_unfolded() -> None:
    system = read("axiom: A(1)\nA(t) : t < 41 -> A(t+1)\nA(t) -> A(1) A(2)")
    net = stages(system, unfold=True)
    assert not net.grouped
    assert len(net.places) == 41
    follows(net, system, 50)
    assert len(stages(catalogued("K19"), unfold=True).places) > len(stages(catalogued("K19")).places)


@pytest.mark.parametrize(
    "text",
    ["axiom: A(1)\nA(t) : t > 0 -> A(t+1)", "axiom: A B\nA > B -> B", "axiom: A(1)\nA(t) : t < 401 -> A(t+1)\nA(t) -> A(1)"],
)
def test_states_that_are_too_many_or_have_neighbours_cannot_be_unfolded(text: str) -> None:
    with pytest.raises(ModelValueError, match="cannot be unfolded"):
        stages(read(text), unfold=True)


def test_states_without_a_successor_are_grouped_too() -> None:
    net = stages(read("axiom: A(3)\nA(t) : 1/t > 0 -> A(t - 1) B"))
    assert net.grouped
    assert repr(net) == "A -> A + B if 1/t > 0"


def test_a_parameter_that_decides_nothing_does_not_keep_states_from_ending() -> None:
    system = read("axiom: A(0,1) L(0,1)\nA(t,x) : t < 2 -> A(t+1,2*x)\nA(t,x) -> A(0,1) L(0,x)\nL(t,x) -> L(t+1,x)")
    net = stages(system)
    assert repr(net) == "A(0) -> A(1)\nL -> L\nA(1) -> A(2)\nA(2) -> A(0) + L"
    assert net.place_of(Module("L", (17, 4))) == 1
    follows(net, system, 12)


@pytest.mark.parametrize("name", ["J6", "K13", "P9w", "K9"])
def test_the_tokens_of_a_lumped_net_are_the_words_counts(name: str) -> None:
    net = stages(catalogued(name))
    assert not net.grouped
    follows(net, catalogued(name), 9)


def test_a_lumped_net_of_too_many_transitions_is_grouped() -> None:
    assert repr(stages(catalogued("K19"))).splitlines() == [
        "A -> 2 F + 2 I + 4 [ + 4 & + 3 ~ + 2 L + 4 ] + 3 / + 2 A + K if A(7)",
        "A -> A if t < 7",
        "I -> 2 F + I if t > 0",
        "L -> L",
        "K -> K",
    ]


def test_symbols_that_are_never_met_have_no_place() -> None:
    net = stages(catalogued("K12"))
    assert net.grouped
    assert {"u2", "u2'"}.isdisjoint(place.symbol for place in net.places)


def follows(net: Stages, system: LSystem, steps: int) -> None:
    """The net's tokens, fired, are those of the words, and none is lost."""
    words = list(derive(system, steps))
    assert net.tokens(words[0]) == net.start
    for before, after in pairwise(words):
        assert net.fired(net.tokens(before)) == net.tokens(after)
        assert sum(net.tokens(after)) == len(after)


def test_places_are_parted_as_far_as_their_futures_differ() -> None:
    rules = "\ninterpretation:\nA -> R(1,1)\nB -> L(1,1)\nC -> R(1,1)\nD -> L(1,1)"
    assert [
        len(stages(read(text + rules)).places)
        for text in (
            "axiom: A B\nA -> B\nB -> A",
            "axiom: A\nA -> B\nB -> C\nC -> C D\nD -> D C",
            "axiom: A\nA -> B\nB -> C\nC -> F",
        )
    ] == [1, 3, 4]


def test_a_module_that_is_not_met_has_no_place() -> None:
    net = stages(read("axiom: A\nA -> A B"))
    assert net.place_of(Module("C")) is None
    assert net.tokens([Module("C"), Module("B")]) == (0, 1)


def test_an_empty_net() -> None:
    net = stages(LSystem((), ()))
    assert (net.places, net.tokens([]), net.fired(()), net.expected(3), repr(net)) == ((), (), (), (), "")


@pytest.mark.parametrize("name", catalogue())
def test_every_net_of_the_catalogue_has_the_words_counts(name: str) -> None:
    system = catalogued(name)
    net = stages(system)
    word = derive(system, min(3, system.steps or 3))[-1]
    by_symbol = Counter(net.places[net.place_of(module)].symbol for module in word)  # type: ignore[index]
    assert sum(net.tokens(word)) == len(word)
    if not any(len({module.symbol for module in place.modules}) > 1 for place in net.places):
        assert by_symbol == word.counts()


@pytest.mark.parametrize("name", catalogue())
def test_every_transition_of_the_catalogue_makes_what_its_production_makes(name: str) -> None:
    system = catalogued(name)
    net = stages(system)
    if not net.grouped:
        met = {net.place_of(module): module for word in derive(system, 4) for module in word}
        for place, module in met.items():
            alone = replace(system, axiom=(Pattern(module.symbol, tuple(map(Number, module.arguments))),))
            for seed in range(3):
                assert net.tokens(derive(alone, 1, seed=seed)[1]) in outcomes(net, place)  # type: ignore[arg-type]


def outcomes(net: Stages, place: int) -> list[tuple[int, ...]]:
    """What may become of one token."""
    numbers = [number for number, transition in enumerate(net.transitions) if transition.place == place]
    made = [Counter({arc.place: arc.copies for arc in net.arcs if arc.transition == number}) for number in numbers]
    return [tuple(counts[i] for i in range(len(net.places))) for counts in made or [Counter({place: 1})]]


def chances(net: Stages, place: int) -> list[object]:
    """The probabilities with which a token leaves a place."""
    return [transition.chance for transition in net.transitions if transition.place == place]


@pytest.mark.parametrize("name", catalogue())
def test_the_probabilities_at_a_place_sum_to_one(name: str) -> None:
    net = stages(catalogued(name))
    for place in range(len(net.places)):
        likely = [chance for chance in chances(net, place) if chance is not None]
        assert sum(likely) in (0, 1)  # type: ignore[call-overload]
        assert not likely or len(likely) > 1


BUDS = ("A", "B", "C")
words = st.lists(st.sampled_from((*BUDS, "F", "[", "]")).map(Pattern), max_size=3).map(tuple)
weights = st.sampled_from((0, 1, 2, Fraction(1, 3), Fraction(33, 100))).map(Number)


@st.composite
def systems_of_chance(draw: st.DrawFn) -> LSystem:
    """Systems whose modules take one of several ways; the first of a symbol's weights is not 0."""
    rules = []
    for bud in BUDS:
        ways = draw(st.lists(st.tuples(words, weights), max_size=3))
        rules += [
            Production((Pattern(bud),), made, probability=weight if number else Number(Fraction(13, 20)))
            for number, (made, weight) in enumerate(ways)
        ]
    return LSystem(tuple(map(Pattern, BUDS)), tuple(rules))


def mean(system: LSystem, counts: Mapping[str, Fraction]) -> dict[str, Fraction]:
    """The expected counts after one more step, read off the productions."""
    found: Counter[str] = Counter()
    for symbol, count in counts.items():
        rules = [rule for rule in system.productions if rule.predecessor.symbol == symbol]
        total = sum(Fraction(rule.probability.value) for rule in rules)  # type: ignore[union-attr]
        for rule in rules or [Production((Pattern(symbol),), (Pattern(symbol),))]:
            share = Fraction(rule.probability.value) / total if rules else 1  # type: ignore[union-attr]
            for module in rule.successor:
                found[module.symbol] += count * share  # type: ignore[union-attr, assignment]
    return dict(found)  # type: ignore[arg-type]


@given(systems_of_chance(), st.integers(0, 4))
def test_expected_tokens_are_the_mean_of_what_chance_may_do(system: LSystem, steps: int) -> None:
    net = stages(system)
    counts: Mapping[str, Fraction] = dict.fromkeys(BUDS, Fraction(1))
    for _ in range(steps):
        counts = mean(system, counts)
    assert {place.symbol: n for place, n in zip(net.places, net.expected(steps), strict=True) if n} == {
        symbol: n for symbol, n in counts.items() if n
    }


@given(systems_of_chance(), st.integers(0, 99))
def test_a_token_goes_one_way(system: LSystem, seed: int) -> None:
    net = stages(system)
    for place in range(len(net.places)):
        one = tuple(int(place == other) for other in range(len(net.places)))
        assert net.fired(one, Chance(seed, 0, 0)) in outcomes(net, place)
        alone = replace(system, axiom=tuple(Pattern(module.symbol) for module in net.places[place].modules))
        assert net.tokens(derive(alone, 1, seed=seed)[1]) in outcomes(net, place)


def test_many_tokens_go_about_as_is_expected() -> None:
    net = stages(catalogued("K8"))
    after = net.fired(tuple(10_000 if place.symbol == "*" else 0 for place in net.places), Chance(5, 0, 0))
    assert after[0] % 2 == 0
    assert abs(after[0] - 13_000) < 300


@pytest.mark.parametrize(("name", "symbol", "factor"), [("K8", "*", Fraction(13, 10)), ("K7", "F", Fraction(11, 3))])
def test_the_expected_growth_of_the_slides(name: str, symbol: str, factor: Fraction) -> None:
    net = stages(catalogued(name))
    place = [place.symbol for place in net.places].index(symbol)
    assert [net.expected(n)[place] for n in range(12)] == [factor**n for n in range(12)]


def test_without_chance_what_is_expected_is_what_happens() -> None:
    net = stages(catalogued("J4"))
    for steps, word in enumerate(derive(catalogued("J4"), 12)):
        assert net.expected(steps) == net.tokens(word)
        assert net.expected(12 - steps, net.tokens(word)) == net.expected(12)


def test_lots_are_drawn_by_whoever_fires() -> None:
    with pytest.raises(ModelValueError, match="decided by chance") as caught:
        stages(catalogued("K8")).fired((1,) * 9)
    assert "expected(steps)" in str(caught.value.hint)


def test_weights_that_are_none_leave_the_net_grouped() -> None:
    assert stages(read("axiom: A\nA -> B : 0\nA -> C : 0")).grouped
    assert (
        repr(stages(read("axiom: A(1)\nA(t) -> A(t+1) : t\nA(t) -> B : 2")))
        == "A -> A if with weight t\nA -> B if with weight 2"
    )


def test_chance_that_hangs_on_a_value_is_that_of_each_state() -> None:
    net = stages(read("axiom: A(1)\nA(t) : t < 3 -> A(t+1) : t\nA(t) : t < 3 -> B : 2\nA(t) -> A(1)"))
    assert repr(net) == (
        "A(1) -> A(2) with probability 1/3\nA(1) -> B with probability 2/3\n"
        "A(2) -> A(3) with probability 0.5\nA(2) -> B with probability 0.5\nA(3) -> A(1)"
    )


def test_cells_that_go_other_ways_with_another_chance_have_places_of_their_own() -> None:
    text = "axiom: A B\nA -> A : {0}\nA -> C : 1\nB -> B : {1}\nB -> C : 1\ninterpretation:\nA -> R(1,1)\nB -> L(1,1)"
    assert [len(stages(read(text.format(*weights))).places) for weights in ((1, 1), (2, 2), (1, 2))] == [2, 2, 3]


def test_context_and_condition_stand_apart() -> None:
    assert [transition.condition for transition in stages(catalogued("J3")).transitions] == [
        "a(i) > c : i > 1",
        "a(i) < b : i < w",
        "a(w) < b",
        "c < b",
        "a(i) < c : i > 1",
        "a(1) < c",
    ]


def test_decomposition_takes_no_time() -> None:
    assert repr(stages(catalogued("P8"))) == (
        "M -> M\nM -> 2 M at once if x >= x_div && p == LEFT\nM -> 2 M at once if x >= x_div && p == RIGHT"
    )


def test_repetitions_are_counted_or_named() -> None:
    text = "n = 3\naxiom: A(0)\nA(t) : t < 0 -> repeat(n) <F> repeat(t, i) <G(i) repeat(2) <H>> A(t+1)\nA(t) -> A(t+1)"
    assert repr(stages(read(text))) == "A -> 3 F + t G + 2 t H + A if t < 0\nA -> A"


def test_what_no_transition_shows_is_said() -> None:
    assert stages(catalogued("K26")).besides == ("meta: f(x,y)f(u,v) : short == 1 -> f(x + u,y + v)",)
    assert repr(stages(read("axiom: A\nA -> [ % A ]"))).endswith("besides: % cuts off the rest of its branch")


def test_a_rule_behind_one_that_always_matches_has_no_transition() -> None:
    assert repr(stages(read("axiom: A B\nA > B -> C\nA -> B\nA -> C"))) == "A -> C if A > B\nA -> B"


CELLS_OF_TWO_AGES = "short = 1/5\naxiom: M(0)\nM(1) -> M(short) M(0)"


@pytest.mark.parametrize(
    "text",
    [
        CELLS_OF_TWO_AGES,
        "axiom: ar(0)\nar(1) -> al(0) br(0)\nal(1) -> bl(0) ar(0)\nbr(1) -> ar(0)\nbl(1) -> al(0)",
        "axiom: a(0) X\na(2) -> a(0) b(1/3) X W(0)\nb(1) -> a(1/2) [b(0)] W(2)",
        "axiom: a(1/4)\na(1) -> a(1/4) a(1/2)",
    ],
)
@given(st.integers(0, 40))
def test_tokens_of_a_timed_net_move_when_their_time_is_up(text: str, twelfths: int) -> None:
    growing = timed(read(text))
    at = Fraction(twelfths, 12) + Fraction(1, 1000)  # at no time at which a cell divides
    net = stages(growing)
    assert fired_in_time(net, at) == net.tokens(growing.word(at))


def test_a_life_is_parted_where_others_begin() -> None:
    assert repr(stages(timed(read(CELLS_OF_TWO_AGES)))) == "M(0) -> M(0.2) after 0.2\nM(0.2) -> M(0.2) + M(0) after 0.8"
    assert repr(stages(timed(read(CELLS_OF_TWO_AGES), short=0))) == "M(0) -> 2 M(0) after 1"


def test_a_module_that_lives_for_ever_has_one_stretch() -> None:
    net = stages(timed(read("axiom: a(0)\na(1) -> a(0) W(0) W(2)")))
    assert repr(net) == "a(0) -> a(0) + 2 W(0) after 1"
    assert net.place_of(Module("W", (17,))) == net.place_of(Module("W", (1,))) == 1
    assert net.place_of(Module("V", (1,))) is None


def test_cells_of_both_polarities_share_a_stretch() -> None:
    rules = "axiom: r(0)\nr(1) -> l(0) s(0)\nl(1) -> s(0) r(0)\ns(1) -> r(0)"
    drawn = "\ninterpretation:\nr(t) -> R(2,1)\nl(t) -> L(2,1)\ns(t) -> R(1,1)"
    assert len(stages(timed(read(rules))).places) == 3
    assert repr(stages(timed(read(rules + drawn)))) == "r(0) -> r(0) + s(0) after 1\ns(0) -> r(0) after 1"
    assert len(stages(timed(read(rules + drawn)), polarity=True).places) == 3


def test_timed_nets_that_cannot_be() -> None:
    with pytest.raises(ModelValueError, match="its own time"):
        stages(timed(read(CELLS_OF_TWO_AGES))).expected(3)
    with pytest.raises(ModelValueError, match="when it is made"):
        stages(timed(read(CELLS_OF_TWO_AGES)), short=0)
    with pytest.raises(ModelValueError, match=r"is born older than it divides, at the age 1"):
        stages(timed(read("axiom: A(2)\nA(1) -> A(0)")))
    with pytest.raises(ModelValueError, match="depends on a constant that is not known"):
        stages(timed(read(CELLS_OF_TWO_AGES), short="short"))
    with pytest.raises(ModelLimitError, match="more than 40 different ages"):
        stages(timed(read("axiom: A(0,0)\nA(1,x) -> A(x/2,x/2+1)")))


@pytest.mark.parametrize("name", ["K27", "P6", "P7"])
@given(st.fractions("1/7", 2, max_denominator=40), st.integers(0, 4))
def test_durations_hold_whatever_a_step_is(name: str, dt: Fraction, step: int) -> None:
    dt += Fraction(1, 1009)  # so that no step ends at a division
    net = stages(catalogued(name), durations=True, dt=dt)
    word = derive(catalogued(name), step, dt=dt)[-1]
    assert net.tokens(word) == fired_in_time(net, step * dt)
    assert sum(net.tokens(word)) == len(word)


def test_the_paper_s_net_has_two_stages_with_durations() -> None:
    net = stages(catalogued("P7"), durations=True, t_l="0.4")
    assert repr(net) == "M(0,1) -> M(0.4,1) after 0.4\nM(0.4,1) -> M(0.4,1) + M(0,1) after 0.6"
    assert repr(stages(catalogued("K27"), durations=True)) == "ar(0) -> ar(0) + bl(0) after 1\nbl(0) -> ar(0) after 1"


def test_the_rule_that_is_the_first_to_apply_ends_a_life() -> None:
    text = "axiom: a(0) b(0,1)\na(t) -> a(t+1)\nb(t,p) -> b(t+1,p)\ndecomposition:\n"
    rules = "a(t) : t >= 3 -> b(0,0)\na(t) : t > 2 -> b(0,1)\nb(t,p) : t > 1 && p == 1 -> a(0)\nb(t,p) : t > 4 -> a(0) a(0)"
    assert (
        repr(stages(read(text + rules), durations=True))
        == "a(0) -> b(0,0) after 3\nb(0,0) -> 2 a(0) after 5\nb(0,1) -> a(0) after 2"
    )


@pytest.mark.parametrize("name", ["J1", "K8"])
def test_durations_that_no_rule_tells(name: str) -> None:
    with pytest.raises(ModelValueError, match="How long a module lives cannot be told, since"):
        stages(catalogued(name), durations=True)


def test_what_is_repeated_no_times_has_no_arc() -> None:
    text = "c = {}\naxiom: A(1)\nA(t) : t > 5 -> A(t+1)\nA(t) -> repeat(c) <B> C A(t+1)\nB -> C"
    assert repr(stages(read(text.format(0)))) == "A -> A if t > 5\nA -> C + A\nB -> C"
    assert repr(stages(read(text.format(2)))) == "A -> A if t > 5\nA -> 2 B + C + A\nB -> C"


def test_unknown_weights_are_shown_as_they_are_written() -> None:
    net = stages(read("k = 1\naxiom: A\nA -> B : k\nA -> C : 1"), k="k")
    assert repr(net) == "A -> B if with weight k\nA -> C if with weight 1"


def test_a_transition_that_is_not_there_has_no_line() -> None:
    with pytest.raises(ModelValueError, match="There are 2 transitions, and none has the number 2"):
        stages(read("axiom: a\na -> ab\nb -> a")).line(2)
