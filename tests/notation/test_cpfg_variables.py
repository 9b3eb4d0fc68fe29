"""Variables of a whole cpfg model: what is computed once is a constant, and what changes between the steps is not."""

from __future__ import annotations

from collections.abc import Iterable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.derivation.derive import derive
from lsys_kit.errors import ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.dialects.cpfg.writer import joined_word, module_text
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.read import read
from lsys_kit.notation.write import write


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (
            "#define k 2\nStart: {n = 3*k; m = n+1;}\nAxiom: A(m)\nA(t) : t < n --> B",
            "#define k 2\n#define n (3*k)\n#define m (3*k+1)\nAxiom: A(m)\nA(t) : t < n --> B",
        ),
        ("Start: {\nn=1;\nif (n > 0) {\nn=n+1;\n}\n}\nAxiom: A(n)", "#define n (1 > 0 ? 1+1 : 1)\nAxiom: A(n)"),
        ("Start: {n=1;}\nStart: {n=n+1;}\nAxiom: A(n)", "#define n (1+1)\nAxiom: A(n)"),
        ("Start: {srand(7);}\nAxiom: A", "seed: 7\nAxiom: A"),
        ("seed: 5\nStart: {srand(7);}\nAxiom: A", "seed: 5\nAxiom: A"),
        ('End: {x = 3; printf("%f", x);}\nAxiom: A', "Axiom: A"),
        ('Start: {i=0;}\nEndEach: {i=i+1; printf("step %f\\n", i);}\nAxiom: A\nA --> B', "Axiom: A\nA --> B"),
        ("Start: {i=0;}\nAxiom: A(0)\nA(t) : 1 {i=t+1;} --> A(i)", "Axiom: A(0)\nA(t) --> A(t+1)"),
        ("EndEach: {t=t+1;}\nAxiom: A(0)\nA(t) --> A(t+1)", "Axiom: A(0)\nA(t) --> A(t+1)"),
        ('Axiom: A(0)\nA(t) : 1 {printf("%f", t); x=t+1; stop(1);} --> A(x)', "Axiom: A(0)\nA(t) --> A(t+1)"),
        ("Define: {array a[3] = {1,2,3};}\nAxiom: A(a[0])B(a[2])C(a[7])", "Axiom: A(1)B(3)C(3)"),
        (
            "#define N 2\nDefine: {\n array a[N]={N,\n N+1}, b[1] = {5};\n}\nAxiom: A(a[1])B(b[a[0]])",
            "#define N 2\nAxiom: A(N+1)B(5)",
        ),
    ],
)
def test_what_is_computed_once_is_a_constant(text: str, meant: str) -> None:
    system = read(f"Lsystem: 1\n{text}")
    assert system == read(f"Lsystem: 1\n{meant}")
    assert read(write(system)) == system


@pytest.mark.parametrize("size", [1, 2, 3, 7, 16, 40])
def test_an_element_is_the_one_with_its_number(size: int) -> None:
    """And below the first or beyond the last the nearest, as in cpfg; what follows the point of a number does not count."""
    elements = [10 * place for place in range(size)]
    system = read(
        f"Lsystem: 1\nDefine: {{array a[{size}] = {{{','.join(map(str, elements))}}};}}\nAxiom: A(-2)\nA(t) --> A(t+1/2)B(a[t])"
    )
    found = [module.arguments[0] for module in derive(system, 2 * size + 8)[-1] if module.symbol == "B"]
    assert found[::-1] == [elements[min(max(0, step // 2 - 2), size - 1)] for step in range(2 * size + 8)]


@pytest.mark.parametrize(
    ("text", "name", "place"),
    [
        ("Start: {c=1;}\nAxiom: AB\nA : 1 {c=2;} --> F\nB --> F(c)", "c", (5, 9)),
        ("Start: {c=1;}\nStartEach: {c=c+1;}\nAxiom: A\nhomomorphism\nA --> F(c)", "c", (6, 9)),
        ("EndEach: {c=c+1;}\nAxiom: A\nhomomorphism\nA --> F(c)\nB --> A", "c", (5, 9)),
        ("EndEach: {c=c+1;}\nAxiom: A\nA : c>2 --> B\nhomomorphism\nB --> A", "c", (4, 5)),
        ("Start: {c=1;}\nEndEach: {c=c+1;}\nAxiom: A\nA : c>2 --> B\ndecomposition\nB --> A", "c", (5, 5)),
        ("Start: {c=1;}\nEndEach: {c=c+1;}\nAxiom: A(c)", "c", (4, 10)),
        ("EndEach: {c=c+ran(1);}\nAxiom: A\nA : c>2 --> B", "c", (4, 5)),
        ("EndEach: {c=c+1;}\nAxiom: F\nF : c>2 --> FF", "c", (4, 5)),
        ("EndEach: {c=c+1;}\nAxiom: +\n+ : c>2 --> -", "c", (4, 5)),
        ("EndEach: {c=c+1;}\nAxiom: AA(1)\nA : c>2 --> B", "c", (4, 5)),
        ("EndEach: {c=c+1;}\nAxiom: A\nA : c>2 {c=3;} --> B(c)", "c", (4, 5)),
    ],
)
def test_a_variable_that_changes_is_named_where_it_is_used(text: str, name: str, place: tuple[int, int]) -> None:
    with pytest.raises(ModelNameError, match=f'The variable "{name}" changes while the model runs') as caught:
        read(f"Lsystem: 1\n{text}")
    assert (caught.value.line, caught.value.column) == place


@pytest.mark.parametrize(
    ("text", "error", "said"),
    [
        ("Start: {k=1;}\nAxiom: A", ModelNameError, 'constant "k" cannot be changed'),
        ("Start: {x=y;}\nAxiom: A(x)", ModelNameError, 'I do not know the name "y"'),
        ("Start: {x=y; srand(x);}\nAxiom: A", ModelNameError, 'I do not know the name "y"'),
        ("Start: {x=ran(1);}\nAxiom: A(x)", ModelValueError, "draws a new number at every use"),
        ("Define: {array a[2]={1,2};}\nAxiom: A\nA --> B(a[ran(2)])", ModelValueError, "index of an array cannot be random"),
        ("Define: {array a[2]={1,2};}\nAxiom: A\nA : 1 {a[1]=5;} --> B(a[1])", ModelSyntaxError, "no arrays that change"),
    ],
)
def test_what_no_constant_can_be_is_said(text: str, error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        read(f"#define k 3\nLsystem: 1\n{text}")


def test_a_counter_is_read_where_a_word_is_drawn() -> None:
    """As it is after the step: what is drawn of step 2 has counted twice."""
    text = "Lsystem: 1\nStart: {t=0;}\nEndEach: {t=t+0.5;}\nAxiom: AB\nA --> AB\nhomomorphism\nB --> F(t)\nC(x) --> f(x)F(x)"
    system = read(text)
    assert "To follow the steps A, B carry t as a parameter." in system.notes
    assert str(derive(system, 2)[-1]) == "A(1)B(1)B(1)B(1)"
    assert [str(rule) for rule in system.interpretation] == ["B(t) -> F(t)", "C(x) -> f(x)F(x)"]
    assert read(write(system)) == system


ROWS = [[10 * row + column for column in range(5)] for row in range(3)]


@pytest.mark.parametrize("row", range(-1, 5))
@pytest.mark.parametrize("column", [-1, 0, 3, 7])
def test_an_array_may_have_rows(row: int, column: int) -> None:
    elements = ", ".join(str(element) for each in ROWS for element in each)
    array = f"Define: {{ // rows\narray a[M][N] = {{{elements}}}, b[2] = {{1, 2}};}}"
    text = f"#define M 3\n#define N 5\nLsystem: 1\n{array}\nAxiom: A({row},{column})\nA(i,j) --> B(a[i][j])C(a[2][4])D(b[1])"
    nearest = ROWS[min(max(row, 0), 2)][min(max(column, 0), 4)]
    assert [module.arguments for module in derive(read(text), 1)[-1]] == [(nearest,), (24,), (2,)]


@pytest.mark.parametrize(
    "definition", ["a[2][K] = {1, 2}", "a[2][3] = {1, 2, 3, 4}", "a[2][2] = {1, 2, 3, 4}; b[2]", "a[2][2]"]
)
def test_an_array_whose_rows_are_not_known_is_refused(definition: str) -> None:
    with pytest.raises(ModelSyntaxError, match="no arrays that change, or have no values"):
        read(f"Lsystem: 1\nDefine: {{array {definition};}}\nAxiom: A(a[0][0])")


def test_an_array_without_its_second_index_is_refused() -> None:
    with pytest.raises(ModelSyntaxError):
        read("Lsystem: 1\nDefine: {array a[2][2] = {1, 2, 3, 4};}\nAxiom: A(a[0])")


@pytest.mark.parametrize(
    ("rule", "carrier"),
    [
        ("A(t) : 1 {x=ran(1);} --> B(x,t)C(x)", "Z(t,x)"),
        ("A(t) : 1 {x=t+ran(1);} --> B(x-t,t)C(x-t)", "Z(t,drawn_1)"),
        ("A(t) : 1 {t=ran(1);} --> B(t,5)C(t)", "Z(t,t_1)"),
        ("A(t) : t>1 {x=ran(1); if (x<0) {y=1-x;} else {y=x;}} --> B(y,t)C(y)", "Z(t,x)"),
    ],
)
def test_what_is_drawn_once_is_used_more_than_once(rule: str, carrier: str) -> None:
    system = read(f"Lsystem: 1\nAxiom: A(5)A(5)\n{rule}")
    assert f"{carrier} carries what is drawn once and used more than once." in system.notes
    for seed in range(5):
        first, second, third, fourth = derive(system, 1, seed=seed)[-1]
        assert first.arguments == pytest.approx((*second.arguments, 5))
        assert third.arguments == pytest.approx((*fourth.arguments, 5))
        assert 0 <= first.arguments[0] < 1
        assert first.arguments != third.arguments
    assert read(write(system)) == system


@pytest.mark.parametrize(
    "text",
    [
        "A : {x=ran(1);} x<0.5 --> F(x)",
        "A : 1 {x=ran(1);} --> FF(x) : x",
        "A : 1 {x=ran(1); y=ran(x);} --> F(x)F(y)F(y)",
        "A : 1 {x=ran(1);} --> F(x)F(x)\ndecomposition\nmaximum depth: 2\nB --> C",
        "homomorphism\nA : 1 {x=ran(1);} --> F(x)F(x)",
        "decomposition\nA : 1 {x=ran(1);} --> F(x)F(x)",
        "".join(f"{letter} --> F\n" for letter in "BCDEHIJKLMNOPQRSTUVWXYZ") + "A : 1 {x=ran(1);} --> F(x)F(x)",
    ],
)
def test_a_number_that_would_be_drawn_anew_is_named(text: str) -> None:
    with pytest.raises(ModelValueError, match="would be drawn anew at each of its uses"):
        read(f"Lsystem: 1\nAxiom: A\n{text}")


RULES = (
    "A(x) : n < 3 --> F[+A(x+n)]B",
    "A(x) : x > n --> C",
    "B > [A(x)] --> A(n)",
    "B : n == 2 --> A(0)B",
    "A(x) < B --> BF(n)",
    "C --> A(p)",
    "B < C --> *",
    "D : p > 5 --> B",
    "D --> DB",
    "A(x) --> A(x+1)",
)
"""Productions that use a counter n, and p, which depends on it."""


def carried(word: Iterable[Module], arities: dict[str, int]) -> str:
    """A word without what its modules carry."""
    return joined_word(module_text(Module(m.symbol, m.arguments[: arities.get(m.symbol, 9)])) for m in word)


@given(
    st.lists(st.sampled_from(RULES), min_size=1, max_size=5, unique=True),
    st.sampled_from(("n=n+1;", "n=n+2; if (n > 5) {n=0;}")),
)
def test_counters_are_what_the_statements_around_the_steps_make_them(rules: list[str], counting: str) -> None:
    """The definition: in each step the productions are those with the values that the counters have then."""
    body, start = "\n".join(rules), "A(0)[B]CDF"
    system = read(f"Lsystem: 1\nStart: {{n=0;}}\nStartEach: {{p=2*n;}}\nEndEach: {{{counting}}}\nAxiom: {start}\n{body}")
    word, n = start, 0
    for found in derive(system, 5):
        assert carried(found, {"A": 1, "B": 0, "C": 0, "D": 0}) == word
        now = read(f"#define n {n}\n#define p {2 * n}\nLsystem: 1\nAxiom: {word or 'F'}\n{body}", "cpfg")
        word = carried(derive(now, 1)[-1], {}) if word else ""
        n = n + 1 if counting == "n=n+1;" else (n + 2) * (n + 2 <= 5)


def test_what_is_left_out_is_noted() -> None:
    notes = read('Lsystem: 1\nEnd: {printf("done");}\nAxiom: A\nA : 1 {stop(1);} --> B').notes
    assert notes == ("Read as cpfg.", "Left out, because it changes nothing in the model: End:, printf, stop.")
