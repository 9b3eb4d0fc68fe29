"""Life spans as letters: the recurrence and the growth are those of the words, whatever the life spans are."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import growth, life_spans, read, system, timed
from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelValueError

SPANS = st.integers(1, 6)


@given(SPANS, SPANS)
def test_the_growth_is_that_of_the_growth_matrix(a: int, b: int) -> None:
    found = life_spans(system("J4")).rate(lifeTimeA=a, lifeTimeB=b)
    assert found == pytest.approx(growth(system("J4"), lifeTimeA=a, lifeTimeB=b).rate, rel=1e-9)


def terms_of(model: object, **values: int) -> list[tuple[int, int]]:
    """The recurrence with numbers for its letters: how many steps before, and how often."""
    found = life_spans(model)  # type: ignore[arg-type]
    there = []
    for (number, *often), c in found._ordered():
        there.append((int(number + sum(x * values[name] for x, name in zip(often, found.letters, strict=True))), c))
    return there


@st.composite
def ageing_systems(draw: st.DrawFn) -> tuple[str, dict[str, int]]:
    """Two or three kinds of cells that live as many steps as letters say, born at age 0 or later, and leave any daughters."""
    names = "ABC"[: draw(st.integers(2, 3))]
    values = {f"life{name}": draw(st.integers(3, 5)) for name in names}
    lines = [f"life{name} = {value}" for name, value in zip(names, values.values(), strict=True)]
    lines.append(f"axiom: {names[0]}(0)")
    for name in names:
        made = [f"{draw(st.sampled_from(names))}({draw(st.integers(0, 2))})" for _ in range(draw(st.integers(1, 3)))]
        lines += [f"{name}(t) : t + 1 < life{name} -> {name}(t+1)", f"{name}(t) : t + 1 >= life{name} -> {' '.join(made)}"]
    return "\n".join(lines), values


@given(ageing_systems(), st.integers(0, 3))
def test_the_number_of_cells_obeys_the_recurrence(made: tuple[str, dict[str, int]], longer: int) -> None:
    text, values = made
    model = read(text)
    there = {name: value + longer * (i + 1) for i, (name, value) in enumerate(values.items())}
    try:
        terms = terms_of(model, **{name: there[name] for name in values})
    except ModelValueError:
        return  # nothing divides for ever
    lengths = growth(model, **there).lengths(120)
    late = max((span for span, _ in terms), default=0) + sum(there.values())
    for t in range(late, 121):
        assert lengths[t] == sum(c * lengths[t - span] for span, c in terms), t


@given(ageing_systems())
def test_the_growth_of_any_ageing_system_is_that_of_its_matrix(made: tuple[str, dict[str, int]]) -> None:
    model = read(made[0])
    try:
        found = life_spans(model)
    except ModelValueError:
        return
    assert found.rate() == pytest.approx(growth(model).rate, rel=1e-6)


def test_the_two_life_spans_of_a_filament() -> None:
    """N(t) = N(t - A) + N(t - B), and 5 and 1 grow as 3 and 2 do: x^5 = x^4 + 1 has x^3 = x + 1 as a factor (lesson 7)."""
    found = life_spans(system("J4"))
    assert found.letters == ("lifeTimeA", "lifeTimeB")
    assert found.recurrence == "N(t) = N(t - lifeTimeA) + N(t - lifeTimeB)"
    assert found.latex == r"1 = x^{- \textit{lifeTimeA}} + x^{- \textit{lifeTimeB}}", "names are read as names"
    assert found.rate(lifeTimeA=5, lifeTimeB=1) == pytest.approx(found.rate(), rel=1e-12)
    assert found.table.rows == (("Al(1)", "lifeTimeA", "Al(1), Br(1)"), ("Br(1)", "lifeTimeB", "Al(1), Br(1)"))
    assert life_spans(system("J4"), lifeTimeA=4).recurrence == "N(t) = N(t - 4) + N(t - lifeTimeB)"
    assert life_spans(system("P3")).recurrence == "N(t) = N(t - (lifeTime - 1)) + N(t - lifeTime)"


def test_in_continuous_time_it_grows_as_a_cell_must_that_hides_its_division() -> None:
    """a^t_div = a^t_s + a^t_l (Prusinkiewicz, section 8) is the equation for the growth of the number of cells, too."""
    found = life_spans(system("P6"))
    assert found.recurrence == "N(t) = N(t - (t_div - t_l)) + N(t - (t_div - t_s))"
    assert found.rate() == pytest.approx(2.167303978, abs=1e-8)
    assert found.rate(t_l="0.4") == pytest.approx(2.42530, abs=1e-4)
    assert life_spans(read("axiom: L(0)\nL(1) -> L(0) R(0.2)\nR(1) -> L(0.2) R(0)")).rate() == pytest.approx(found.rate())
    word = timed(system("P6")).word(9)
    assert math.log(len(word)) / 9 == pytest.approx(math.log(found.rate()), rel=0.1)


def test_constants_that_follow_from_others_follow_them() -> None:
    text = "half = 2\nwhole = 2*half\nsystem = 1\naxiom: A(1)\nA(whole) -> A(1) B(1)\nA(i) : i < whole -> A(i+1)\n"
    text += "B(half) -> A(1) B(1)\nB(i) : i < half -> B(i+1)"
    found = life_spans(read(text))
    assert found.letters == ("half",)
    assert found.recurrence == "N(t) = N(t - 2*half) + N(t - half)"
    assert found.rate() == pytest.approx(growth(read(text)).rate)


def test_cells_that_stop_dividing_do_not_matter() -> None:
    text = "d = 3\naxiom: A(1)\nA(d) -> A(1) B\nA(i) : i < d -> A(i+1)"
    assert repr(life_spans(read(text))) == "N(t) = N(t - d); 1 = x^(-d); growth 1.0000"


def test_a_value_is_found_for_a_growth() -> None:
    found = life_spans(system("J4"))
    rate = found.rate()
    assert found.solve("lifeTimeB", rate, lifeTimeA=5) == pytest.approx(1, abs=1e-9)
    assert found.solve("lifeTimeA", 2, lifeTimeB=1) == pytest.approx(1, abs=1e-9)
    with pytest.raises(ModelValueError, match="For no value"):
        found.solve("lifeTimeA", 100, lifeTimeB=1)
    with pytest.raises(ModelValueError, match="above 1"):
        found.solve("lifeTimeA", 1)


def test_whole_life_spans_of_equal_growth_are_marked() -> None:
    plot = life_spans(system("J4")).plot()
    own = next(level for level in plot.chart.levels if level.loud)  # type: ignore[attr-defined]
    assert [(x, round(y, 6)) for x, y in own.marked] == [(1, 5), (2, 3), (3, 2), (5, 1)]
    for level in plot.chart.levels:  # type: ignore[attr-defined]
        for x, y in level.points:
            assert level.value**-x + level.value**-y == pytest.approx(1, abs=1e-9)
    assert "t_div" in repr(life_spans(system("P6")).plot("t_div", "t_l"))


def test_what_cannot_be_asked_is_told() -> None:
    found = life_spans(system("J4"))
    for call, said in [
        (lambda: life_spans(system("J1")), "at which age"),
        (lambda: life_spans(system("J4"), lifeTimeA="lifeTimeA"), "need no value"),
        (lambda: life_spans(system("J4"), lifeTimeC=2), 'no constant "lifeTimeC"'),
        (lambda: life_spans(read("axiom: A(0)\nA(1) -> B(0)\nB(2) -> C")), "descendants of its own kind"),
        (lambda: found.rate(q=2), 'no life span depends on a letter "q"'),
        (lambda: found.rate(lifeTimeA=0), "above 0"),
        (lambda: found.rate(lifeTimeA="lifeTimeA"), "only where"),
        (lambda: found.rate(lifeTimeA=Fraction(1, 10**9), lifeTimeB="0.01"), "grow by more than"),
        (lambda: found.plot("lifeTimeA", "lifeTimeA"), "must be different"),
        (lambda: life_spans(system("P3")).plot(), "need two letters"),
        (lambda: life_spans(read("d = 1\naxiom: A(0)\nA(d*d) -> A(0) A(0)")), "no sums of multiples"),
    ]:
        with pytest.raises(LSystemError) as error:
            call()
        assert said.lower() in str(error.value).lower()
    assert issubclass(ModelNameError, LSystemError)


def test_many_kinds_of_cells_end_within_the_limit() -> None:
    rules = [f"A{i}({i + 1}) -> A{(i + 1) % 12}(0) A{(3 * i) % 12}(0)" for i in range(12)]
    with pytest.raises(ModelLimitError, match="more than 10 kinds"):
        life_spans(read("\n".join(["axiom: A0(0)", *rules])))
    with pytest.raises(ModelLimitError, match="modules are born"):
        life_spans(read("\n".join(["axiom: A0(0)", *(f"A{i}(1) -> A{i + 1}(0) A0(0)" for i in range(300))])))
