"""The systems of the seeds that need contexts, chance, decomposition, cuts, repetitions or meta-rules, with their outputs.

Each stands here in the kit's notation, with the words and counts that the seeds print or that follow from the definition.
"""

from __future__ import annotations

from fractions import Fraction
from math import sqrt
from statistics import mean, stdev

import pytest

from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.derive import derive
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read, read_word
from lsys_kit.notation.write import write
from tests.derivation import reference


def letters(system: LSystem, steps: int) -> list[str]:
    """The words of symbols without arguments, glued."""
    return ["".join(module.symbol for module in word) for word in derive(system, steps)]


def count(system: LSystem, steps: int, symbol: str, seed: int = 0) -> list[int]:
    """How often a symbol stands in each word."""
    return [sum(module.symbol == symbol for module in word) for word in derive(system, steps, seed=seed)]


# Contexts

BOOK = "axiom: A B C [ D E ] [ S G [ H I [ J K ] L ] M N O ]\nB C < S > {right} -> T"


def test_the_example_of_the_book() -> None:
    """BC < S > G[H]M matches in ABC[DE][SG[HI[JK]L]MNO] (ABOP, section 1.8)."""
    assert letters(read(BOOK.format(right="G [ H ] M")), 1)[1] == "ABC[DE][TG[HI[JK]L]MNO]"


@pytest.mark.parametrize(
    "right", ["G", "G M", "G M N O", "G [ H I ]", "G [ H I L ] M", "G [ H I [ J ] L ]", "G [ H I [ J K ] L ] M N O"]
)
def test_right_contexts_that_match_in_the_example_of_the_book(right: str) -> None:
    system = read(BOOK.format(right=right))
    assert letters(system, 1)[1] == "ABC[DE][TG[HI[JK]L]MNO]"


@pytest.mark.parametrize(
    "right", ["M", "H", "G H", "G [ I ] M", "G [ H ] N", "G M N O P", "G [ H ] [ H ] M", "G [ H J ]", "[ G ]"]
)
def test_right_contexts_that_do_not_match_there(right: str) -> None:
    assert letters(read(BOOK.format(right=right)), 1)[1] == "ABC[DE][SG[HI[JK]L]MNO]"


@pytest.mark.parametrize(
    ("rule", "matches"),
    [
        ("A B C < S", True),
        ("C < S", True),
        ("E < S", False),
        ("A C < S", False),
        ("X A B C < S", False),
        ("D < E", True),
        ("B C < D", True),
        ("K < L", False),
        ("H I < L", True),
        ("S G < M", True),
        ("L < M", False),
        ("O < S", False),
    ],
)
def test_left_contexts_in_the_example_of_the_book(rule: str, matches: bool) -> None:
    before = "ABC[DE][SG[HI[JK]L]MNO]"
    system = read(f"axiom: {' '.join(before)}\n{rule} -> T")
    after = before.replace(rule[-1], "T") if matches else before
    assert letters(system, 1)[1] == after


def test_two_named_branches_are_two_branches() -> None:
    def after(word: str) -> str:
        return letters(read(f"axiom: {' '.join(word)}\nS > [ A ] [ B ] C -> T"), 1)[1]

    assert after("S[A][B]C") == "T[A][B]C"
    assert after("S[X][A][X][B][X]C") == "T[X][A][X][B][X]C"
    assert after("S[B][A]C") == "S[B][A]C"
    assert after("S[AB]C") == "S[AB]C"


def test_symbols_that_are_ignored_and_symbols_that_are_considered() -> None:
    word = "axiom: A + B [ + B ] - A\n"
    assert letters(read(f"{word}A < B -> C"), 1)[1] == "A+B[+B]-A"
    assert letters(read(f"{word}ignore: + -\nA < B -> C"), 1)[1] == "A+C[+B]-A"
    assert letters(read(f"{word}consider: A B\nA < B > A -> C"), 1)[1] == "A+C[+B]-A"
    assert letters(read(f"{word}consider: A\nA < B -> C"), 1)[1] == "A+C[+C]-A"


@pytest.mark.parametrize("passing", ["ignore: +", "consider: A X"])
def test_nothing_lies_beyond_the_end_of_a_branch(passing: str) -> None:
    assert letters(read(f"{passing}\naxiom: X [ A ] [ A ] A\nA > [ A ] -> B\nA > A -> C"), 1)[1] == "X[A][A]A"


def test_hormone_spreads_through_a_filament() -> None:
    """J2: seed 000, ILSystem1, with the axiom as corrected."""
    system = read("axiom: b a a a a a a a d\nb < a -> b\n < b > b -> c\n < b > d -> c\nc < c > d -> d")
    assert letters(system, 16) == [
        "baaaaaaad",
        "bbaaaaaad",
        "cbbaaaaad",
        "ccbbaaaad",
        "cccbbaaad",
        "ccccbbaad",
        "cccccbbad",
        "ccccccbbd",
        "ccccccccd",
        "cccccccdd",
        "ccccccddd",
        "cccccdddd",
        "ccccddddd",
        "cccdddddd",
        "ccddddddd",
        "cdddddddd",
        "cdddddddd",
    ]


LAYER = """w = 11
axiom: a(1) b
a(i) < b : i < w -> a(i+1) b
a(i) > c : i > 1 -> c
a(w) < b -> c
c < b -> ε
a(i) < c : i > 1 -> ε
a(1) < c -> b"""


def test_a_layer_grows_to_a_width_and_shrinks() -> None:
    """J3: seed 000, ILSystem2; 31 lines, period 2w."""

    def layer(width: int, end: str) -> str:
        return "".join(f"a({i})" for i in range(1, width + 1)) + end

    expected = (
        [layer(k + 1, "b") for k in range(11)] + [layer(11 - j, "c") for j in range(11)] + [layer(k + 1, "b") for k in range(9)]
    )
    assert [str(word) for word in derive(read(LAYER), 30)] == expected
    assert [str(word) for word in derive(read(LAYER), 12, w=3)][6] == "a(1)b"


def test_with_the_width_as_printed_the_layer_sticks() -> None:
    stuck = list(derive(read(LAYER.replace("a(w)", "a(15)")), 14))
    assert str(stuck[10]) == str(stuck[14]) == "".join(f"a({i})" for i in range(1, 12)) + "b"


def test_a_signal_walks_through_a_filament() -> None:
    """K16, and its mirror image."""
    assert letters(read("axiom: s a a a a\ns < a -> a s\ns -> ε"), 6) == [
        "saaaa",
        "asaaa",
        "aasaa",
        "aaasa",
        "aaaas",
        "aaaa",
        "aaaa",
    ]
    assert letters(read("axiom: A A A B\nA > B -> B\nB -> A"), 4) == ["AAAB", "AABA", "ABAA", "BAAA", "AAAA"]
    assert letters(read("axiom: B A A A\nB < A -> B\nB -> A"), 4) == ["BAAA", "ABAA", "AABA", "AAAB", "AAAA"]


FLOWERING = """d = 10
m = 2
n = 3
u = 1
v = 1
p = 3
ignore: + - /
axiom: D(0) F(3,0) A(0)
S(i) < A(j) -> C(0)
S(i) < B(j) -> C(0)
A(i) : i < m-1 -> A(i+1)
A(i) : i == m-1 -> [+ F(3,1) B(0)] F(3,0) /(180) A(0)
B(i) : i < n-1 -> B(i+1)
B(i) : i == n-1 -> [+ L] F(3,1) /(180) B(0)
D(i) : i < d -> D(i+1)
D(i) : i == d -> S(0)
S(i) : i < u+v -> S(i+1)
S(i) : i == u+v -> ε
S(i) < F(l,o) : o == 0 && i == u-1 -> F(l,o) S(0)
S(i) < F(l,o) : o == 1 && i == v-1 -> F(l,o) S(0)
C(t) : t <= p -> C(t+1)"""


def first_flowers(system: LSystem, steps: int, flower: str = "C") -> list[int]:
    """When each axis first bears a flower: the lateral ones from the lowest on, at last the main axis."""
    found: dict[int, int] = {}
    for step, word in enumerate(derive(system, steps)):
        branch, depth, axis = 0, 0, 0
        for module in word:
            if module.symbol == "[":
                depth += 1
                branch += depth == 1
                axis = branch if depth else 0
            elif module.symbol == "]":
                depth -= 1
                axis = axis if depth else 0
            elif module.symbol == flower:
                found.setdefault(axis or 10**6, step)
    return [found[axis] for axis in sorted(found)]


def test_flowering_goes_up_or_down_with_the_speed_of_the_signal() -> None:
    """K17: ABOP, L-system 3.1; acropetal from step 19 to 24, basipetal from 24 to 31."""
    acropetal = first_flowers(read(FLOWERING), 24)
    assert acropetal == sorted(acropetal)
    assert (acropetal[0], acropetal[-1]) == (19, 24)
    basipetal = first_flowers(derive_with(FLOWERING, m=2, n=5, u=1, v=3), 31)
    for side in basipetal[::2], basipetal[1::2]:
        assert side == sorted(side, reverse=True)
    assert (basipetal[0], basipetal[-1]) == (max(basipetal), min(basipetal)) == (31, 24)


def derive_with(text: str, **constants: int) -> LSystem:
    """A system with constants set to other values."""
    lines = [
        f"{line.split(' = ')[0]} = {constants[line.split(' = ')[0]]}" if line.split(" = ")[0] in constants else line
        for line in text.splitlines()
    ]
    return read("\n".join(lines))


TWO_SIGNALS = """PL = 1
ignore: + /
axiom: D(0) I(0,0) A(0)
D(t) -> D(t+1)
D(t) < I(f,a) : t == 15 -> I(1,a)
I(f,a) < A(t) : f == 0 && t < 1 -> A(t+1)
I(f,a) < A(t) : f == 0 && t == 1 -> [+ B] I(0,0) /(180) A(0)
I(f,a) < A(t) : f == 1 -> K
I(f,a) > K -> I(f,1)
I(fl,al) < I(f,a) > I(fr,ar) -> I(fl,ar)
I(fl,al) < I(f,a) > A(t) -> I(fl,a)
D(t) < I(f,a) > I(fr,ar) -> I(f,ar)
I(f,a) < B : a == 1 -> C(0,0)
C(t,n) : t < PL -> C(t+1,n)
C(t,n) : t >= PL && n < 3 -> F C(0,n+1)
C(t,n) : n == 3 -> K"""


def test_florigen_goes_up_and_the_second_signal_comes_down() -> None:
    """K18: the apex becomes a flower when florigen arrives; then the branches open from the top to the base."""
    system = read(TWO_SIGNALS)
    opened = first_flowers(system, 60)
    assert len(opened) > 8
    assert opened == sorted(opened, reverse=True)
    assert len(set(opened)) == len(opened)
    last = list(derive(system, 60)[-1])
    assert not [module for module in last if module.symbol in "AB"]


# Walls: L-systems 6 to 9

CELLS = """LEFT = -1
RIGHT = 1
t_div = 1
t_s = 0
t_l = 0.2
dt = 0.7
axiom: M(0,RIGHT)
M(t,p) -> M(t+dt,p)
decomposition:
M(t,p) : t >= t_div && p == LEFT -> M(t-t_div+t_s,LEFT) M(t-t_div+t_l,RIGHT)
M(t,p) : t >= t_div && p == RIGHT -> M(t-t_div+t_l,LEFT) M(t-t_div+t_s,RIGHT)"""
DRAWN = """
interpretation:
M(t,p) : p == LEFT -> L(2.167303978^t,1)
M(t,p) : p == RIGHT -> R(2.167303978^t,1)"""


SIZES = """LEFT = -1
RIGHT = 1
x_div = 2.1673
SMALLER = 0.4614
gr = 1.7185
axiom: M(1,RIGHT)
M(x,p) -> M(x*gr,p)
decomposition:
M(x,p) : x >= x_div && p == LEFT -> M(x*SMALLER,LEFT) M(x*(1-SMALLER),RIGHT)
M(x,p) : x >= x_div && p == RIGHT -> M(x*(1-SMALLER),LEFT) M(x*SMALLER,RIGHT)"""


def cells(*ages: tuple[str, int]) -> list[tuple[object, ...]]:
    return [(Fraction(age), polarity) for age, polarity in ages]


def arguments(word: object) -> list[tuple[object, ...]]:
    return [module.arguments for module in word]  # type: ignore[attr-defined]


def test_cells_divide_as_often_as_a_long_step_needs() -> None:
    """P6: with dt = 1.4 every second word of dt = 0.7."""
    short, long = derive(read(CELLS), 10), derive(read(CELLS), 5, dt="14/10")
    assert arguments(short[2]) == cells((".6", -1), (".4", 1))
    assert arguments(short[3]) == cells((".3", -1), (".5", 1), (".3", -1), (".1", 1))
    assert arguments(short[4]) == cells(("0", -1), (".2", 1), (".4", -1), (".2", 1), ("0", -1), (".2", 1), (".8", 1))
    assert [len(word) for word in short][:6] == [1, 1, 2, 4, 7, 9]
    assert [len(word) for word in long][:4] == [1, 2, 7, 17]
    assert [list(word) for word in long] == [list(word) for word in short][::2]


def test_a_step_as_long_as_the_whole_time_gives_the_word_at_its_end() -> None:
    assert list(derive(read(CELLS), 1, dt=7)[-1]) == list(derive(read(CELLS), 10)[-1])


def test_the_filament_grows_without_a_jump() -> None:
    """P7: its length is a^(n dt), and its words are those of P6."""
    system = read(CELLS + DRAWN)
    derivation = derive(system, 5)
    assert [list(word) for word in derivation] == [list(word) for word in derive(read(CELLS), 5)]
    lengths = []
    for word in derivation:
        drawn = interpretations(derivation.states, list(word.numbers()))
        lengths.append(sum(float(m.arguments[0]) for number in word.numbers() for m in drawn[number]))  # type: ignore[arg-type]
    assert lengths == pytest.approx([1, 1.7185, 2.9532, 5.0749, 8.7212, 14.9872], abs=1e-4)


def test_size_divides_cells_as_age_does() -> None:
    """P8: the pattern of P6, from the lengths of the cells."""
    system = read(SIZES)
    sizes, ages = derive(system, 12), derive(read(CELLS), 12)
    assert [(round(float(x), 4), p) for x, p in arguments(sizes[2])] == [(1.5906, -1), (1.3626, 1)]  # type: ignore[arg-type]
    assert [(round(float(x), 4), p) for x, p in arguments(sizes[3])] == [  # type: ignore[arg-type]
        (1.2612, -1),
        (1.4722, 1),
        (1.2612, -1),
        (1.0804, 1),
    ]
    for by_size, by_age in zip(sizes, ages, strict=True):
        assert [p for _, p in arguments(by_size)] == [p for _, p in arguments(by_age)]


def test_the_short_cell_is_on_the_side_of_the_older_wall() -> None:
    """P9w: figure 8 of seed 002."""
    system = read("""axiom: W(0) Lr W(1)
        W(t) -> W(t+1)
        Sl -> Ll
        Sr -> Lr
        Lr -> Ll W(0) Sr
        Ll -> Sl W(0) Lr""")
    assert [str(word).replace(" ", "") for word in derive(system, 3)][1:] == [
        "W(1)LlW(0)SrW(2)",
        "W(2)SlW(0)LrW(1)LrW(3)",
        "W(3)LlW(1)LlW(0)SrW(2)LlW(0)SrW(4)",
    ]
    for word in derive(system, 8):
        row = list(word)
        for left, cell, right in zip(row[::2], row[1::2], row[2::2], strict=False):
            older_left = left.arguments[0] > right.arguments[0]  # type: ignore[operator]
            assert cell.symbol[1] == ("l" if older_left else "r")


WALLS = """t_div = 1
t_s = 0
t_l = 0.2
dt = 0.7
axiom: W(0) M(0) W(dt)
W(t) -> W(t+dt)
M(t) : t < t_div -> M(t+dt)
W(tl) < {M} > W(tr) : t >= t_div && tl {first} tr -> M(t-t_div+t_s+dt) W(t-t_div) M(t-t_div+t_l+dt)
W(tl) < {M} > W(tr) : t >= t_div && tr {second} tl -> M(t-t_div+t_l+dt) W(t-t_div) M(t-t_div+t_s+dt)"""


def test_walls_say_where_a_cell_divides() -> None:
    """P9, corrected: a step behind L-system 6."""
    walls = derive(read(WALLS.format(M="M(t)", first=">", second=">")), 9)
    assert [str(word) for word in walls][:5] == [
        "W(0)M(0)W(0.7)",
        "W(0.7)M(0.7)W(1.4)",
        "W(1.4)M(1.4)W(2.1)",
        "W(2.1)M(1.3)W(0.4)M(1.1)W(2.8)",
        "W(2.8)M(1)W(0.3)M(1.2)W(1.1)M(1)W(0.1)M(0.8)W(3.5)",
    ]
    for step, word in enumerate(derive(read(CELLS), 8)):
        ages = [module.arguments[0] for module in walls[step + 1] if module.symbol == "M"]
        assert ages == [age + Fraction(7, 10) for age, _ in arguments(word)]  # type: ignore[operator]


def test_a_rule_that_asks_for_two_parameters_is_warned_of() -> None:
    """P9 as printed: M(t,p) in the predecessor, M(t) in every word, so that no cell ever divides."""
    printed = read(WALLS.format(M="M(t,p)", first="<", second=">"))
    assert any("M(t" in note or '"M"' in note for note in printed.notes), printed.notes
    assert {len(word) for word in derive(printed, 6)} == {3}
    assert not read(WALLS.format(M="M(t)", first=">", second=">")).notes


# Chance


def near(values: list[int], expected: float, errors: float = 4) -> bool:
    """Whether a mean lies within some standard errors of what is expected."""
    return abs(mean(values) - expected) < errors * stdev(values) / sqrt(len(values))


def test_three_rules_of_the_same_weight_are_thirds() -> None:
    """K7: .33, .33 and .33 are thirds, so that E[F after 5] = (11/3)^5 = 662.8."""
    plant = read("axiom: F\nF -> F [+F] F [-F] F : .33\nF -> F [+F] F : .33\nF -> F [-F] F : .33")
    after = [count(plant, 5, "F", seed) for seed in range(400)]
    for step in (1, 2, 5):
        assert near([counts[step] for counts in after], (11 / 3) ** step)
    assert {counts[1] for counts in after} == {3, 5}


def test_buds_branch_or_die() -> None:
    """K8: E[buds after n] = 1.3^n."""
    system = read("axiom: S\nS -> F Lx [RU(35) S] RU(-35) S : 0.65\nS -> P(2) L(10) F : 0.35")
    after = [count(system, 8, "S", seed) for seed in range(400)]
    for step in (1, 4, 8):
        assert near([counts[step] for counts in after], 1.3**step)
    assert {counts[1] for counts in after} == {0, 2}


def test_a_random_flight_has_a_segment_a_step() -> None:
    """K9: directions differ at every use."""
    flight = derive(read("axiom: a\na -> RU(uniform(0,360)) RH(uniform(0,360)) F(100) a"), 50, seed=5)
    assert [sum(module.symbol == "F" for module in word) for word in flight] == list(range(51))
    turns = [module.arguments[0] for module in flight[-1] if module.symbol in ("RU", "RH")]
    assert len(set(turns)) == 100
    assert all(0 <= turn < 360 for turn in turns)  # type: ignore[operator]


# Repetition, cut


def test_powers_and_products_of_parameters() -> None:
    """K10."""
    assert str(derive(read("axiom: a(2,3)\na(x,y) -> F(x^3+10) b(2*y)"), 1)[-1]) == "F(18)b(6)"


ACROTONY = """axiom: S
S -> a({n})
a(n) -> repeat(n,i) <F [RU(50) lat(i)] RH(180)> F a(n)
lat(j) -> Lplus(j*100) F"""


def test_branches_grow_longer_towards_the_tip() -> None:
    """K11."""
    assert list(derive(read(ACROTONY.format(n=2)), 2)[-1]) == list(
        read_word("F [RU(50) lat(0)] RH(180) F [RU(50) lat(1)] RH(180) F a(2)")
    )
    five = read(ACROTONY.format(n=5))
    assert count(five, 3, "F") == [0, 0, 6, 17]
    assert [m.arguments[0] for m in derive(five, 3)[-1] if m.symbol == "Lplus"] == [0, 100, 200, 300, 400]


TREE = """axiom: S
S -> [P(14) t0] P(4) repeat(6) <[RH(uniform(0,360)) P(5) u1p]> Lx u0
t0 -> xt F D RH(137.5) [RL(80) Lh P(2) k(1) s1] [RH(180) RL(80) Lh P(2) k(1) s1] t0
s1 -> xs F D [RH(25) RU(60) $ Ls s2] [RH(-25) RU(-60) $ Ls s2] s1
s2 -> xs F D
xt -> xt Dplus(3)
xs -> xs Dplus(2)
k(t) : t < 6 -> k(t+1)
k(t) : t == 6 -> %
u0 -> RG RH(uniform(0,360)) RU(normal(0,sqrt(15))) xt F D [Lu k(1) P(15) u1] [Lu k(1) P(15) u1p] u0
u1p -> u1
u1 -> RG RL(90) RL(uniform(-10,0)) RU(uniform(-25,25)) xs F D a1 u1
u1 -> u2
u1p -> u2p
u2 -> RG RL(70) RL(uniform(-10,0)) RU(uniform(-25,25)) xs F D u2
u2p -> RG RH(180) RL(70) RL(uniform(-10,0)) RU(uniform(-25,25)) xs F D u2p
a1 -> a2
a2 -> a3
a3 -> [RG RU(180) S] : 0.2
a3 -> z : 0.8"""


@pytest.mark.slow
def test_a_tree_with_crown_roots_and_reiteration() -> None:
    """K12, where the first rule wins: 59 segments after 5 steps, some 950 to 1,450 after 15, with 9 to 15 new trees."""
    tree = read(TREE)
    segments, trees = [], []
    for seed in range(30):
        grown = count(tree, 15, "F", seed)
        assert grown[:8] == [0, 0, 2, 13, 32, 59, 94, 137]
        segments.append(grown[-1])
        trees.append(count(tree, 15, "S", seed)[-1])
    assert 954 < mean(segments) < 1448
    assert 9 < mean(trees) < 15
    assert not any(symbol in ("u2", "u2p") for symbol, _ in plain_last(tree, 10))


def plain_last(system: LSystem, steps: int, seed: int = 0) -> list[reference.PlainModule]:
    return [(module.symbol, module.arguments) for module in derive(system, steps, seed=seed)[-1]]


@pytest.mark.slow
def test_the_tree_is_the_tree_of_the_definition() -> None:
    tree = read(TREE)
    for seed in (0, 1, 99):
        assert plain_last(tree, 12, seed) == reference.words(tree, 12, seed)[0][-1]


def test_of_two_rules_without_probability_the_second_is_never_applied() -> None:
    assert letters(read("axiom: u\nu -> a u\nu -> b"), 3)[-1] == "aaau"


def test_a_clock_cuts_its_branch() -> None:
    """The clock of K12: `%` stands one word long, and takes what stands behind it in its branch."""
    system = read("axiom: a [ b k(5) c [ d ] e ] f\nk(t) : t < 6 -> k(t+1)\nk(t) : t == 6 -> %")
    assert [str(word) for word in derive(system, 4)] == ["a[b k(5)c[d]e]f", "a[b k(6)c[d]e]f", "a[b%c[d]e]f", "a[b]f", "a[b]f"]
    assert letters(read("axiom: a % b [ c ]"), 1)[1] == "a"
    assert letters(read("axiom: a [ % ] [ b % [ % ] c ] d"), 1)[1] == "a[][b]d"


def test_contexts_still_see_what_is_cut() -> None:
    assert letters(read("axiom: a % b\na > % b -> c"), 1)[1] == "c"
    assert letters(read("axiom: a [ % b ] d\nb -> c c\na > [ % b ] d -> e"), 1)[1] == "e[]d"


# Compound inflorescences, dichotomies, movement

LYCHNIS = """axiom: A(7)
A(7) -> F I(20) [ &(60) ~ L(0) ] /(90) [ &(45) A(0) ] /(90) [ &(60) ~ L(0) ] /(90) [ &(45) A(4) ] F I(10) ~ K(0)
A(t) : t < 7 -> A(t+1)
I(t) : t > 0 -> F F I(t-1)
L(t) -> L(t+1)
K(t) -> K(t+1)"""


def test_flowers_of_lychnis_are_fibonacci_numbers_less_one() -> None:
    """K19: ABOP, page 84."""
    flowers = count(read(LYCHNIS), 26, "K")
    assert [flowers[step] for step in (0, 1, 4, 5, 8, 9)] == [0, 1, 1, 2, 2, 4]
    assert [flowers[step] for step in range(1, 26, 4)] == [1, 2, 4, 7, 12, 20, 33]
    assert all(flowers[t] == flowers[t - 4] + flowers[t - 8] + 1 for t in range(9, 27))


def test_a_dichotomy_that_feels_nothing_doubles() -> None:
    """K20."""
    dichotomy = read("angle: 30\naxiom: a\na -> RH(180) F(100) [ - b ] + a\nb -> RH(180) F(70) [ - b ] + a")
    assert count(dichotomy, 8, "F") == [2**n - 1 for n in range(9)]


def test_steps_of_a_moving_organism_add_up() -> None:
    """K26: meta-rule f(dx,dy) f(ex,ey) -> f(dx+ex, dy+ey)."""
    rules = "axiom: S\nS -> a\na -> f(binomial(9,0.5)-4, binomial(9,0.5)-4) a"
    free, joined = read(rules), read(f"{rules}\nmeta: f(dx,dy) f(ex,ey) -> f(dx+ex, dy+ey)")
    for seed in range(20):
        step = derive(free, 2, seed=seed)[-1][0].arguments
        assert [str(word) for word in derive(joined, 2, seed=seed)][2] == str(Module("f", step)) + "a"
        assert all(len(word) == 2 for word in derive(joined, 30, seed=seed)[2:])
        assert plain_last(joined, 30, seed) == reference.words(joined, 30, seed)[0][-1]
    assert str(derive(read("axiom: f(1,2) f(3,4) f(5,6)\nmeta: f(a,b) f(c,d) -> f(a+c,b+d)"), 1)[1]) == "f(9,12)"


def test_turns_that_stand_between_steps_keep_them_apart() -> None:
    moving = read("axiom: a\na -> RU(90) f(1) a\nmeta: f(x) f(y) -> f(x+y)")
    assert str(derive(moving, 2)[-1]) == "RU(90)f(1)RU(90)f(1)a"


@pytest.mark.parametrize("text", [LAYER, FLOWERING, TWO_SIGNALS, CELLS + DRAWN, SIZES, ACROTONY.format(n=5), TREE, LYCHNIS])
def test_each_of_these_systems_reads_back(text: str) -> None:
    system = read(text)
    assert read(write(system)) == system
