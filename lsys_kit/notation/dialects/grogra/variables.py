r"""GROGRA's variables: random numbers, indices of repetitions, sensitive functions (Kurth).

The records have no variables. A random variable is replaced by its draw at every use, since every use draws a new number:
after `\var x uniform 0 360` the command `RH(x)` is RH(uniform(0, 360)). A function becomes `sensed`, an index the name that
counts in its `Repeat`. Written back, each distinct draw becomes a variable again.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import isqrt

from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.arithmetic import normalised
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name, Number, TextSpan, names_in, transform
from lsys_kit.notation.model.modules import Item, Repeat, expressions_of
from lsys_kit.notation.model.system import Production
from lsys_kit.notation.syntax.actions import values_text

VARIABLE_KINDS: Mapping[str, tuple[int, int, str]] = {
    "uniform": (2, 2, "0 360"),
    "normal": (2, 2, "0 15"),
    "binomial": (2, 2, "10 0.5"),
    "poisson": (1, 1, "3"),
    "distribution": (1, 16, "0.2 0.3 0.5"),
    "table": (1, 16, "0.2 0.3 0.5"),
    "index": (0, 1, "0"),
    "function": (2, 2, "2 1"),
}
"""For each kind of variable the least and the greatest number of its values, and an example of them."""
QUERY_FUNCTIONS = frozenset(
    (
        "negbinomial",
        "generation",
        "length",
        "diameter",
        "color",
        "order",
        "xcoordinate",
        "ycoordinate",
        "zcoordinate",
        "register",
        "local",
    )
)
"""Other kinds of variables in GROGRA: most depend on the turtle, which words do not know."""
_POSSIBLE = f"Kinds of variables are: {', '.join(VARIABLE_KINDS)}."
_UNKNOWN_NAME_HINT = (
    'A parameter is named in front, as in "a(t) # a(t+1)"; a constant or a variable on a line such as '
    '"\\const k 3," or "\\var x uniform 0 360,".'
)


@dataclass(frozen=True)
class Variable:
    """What a `\\var` line declares."""

    name: str
    kind: str
    values: tuple[Expression, ...]
    at: TextSpan = field(default=None, compare=False)

    @property
    def numbers(self) -> tuple[int, ...]:
        """Its values, where they are whole numbers: a function's number and how many values it takes, an index's level."""
        return tuple(value.value for value in self.values if isinstance(value, Number) and isinstance(value.value, int))

    @property
    def level(self) -> int:
        """How many repetitions are around the one that an index counts."""
        return self.numbers[0] if self.numbers else 0


@dataclass(frozen=True)
class Scope:
    """What names mean at a place of a text.

    Attributes
    ----------
    known
        Constants and parameters.
    variables
        By their names.
    counting
        For each index that counts here the name of what it counts in the records.
    chance
        Whether random numbers are possible here.
    """

    known: frozenset[str]
    variables: Mapping[str, Variable]
    counting: Mapping[str, str] = field(default_factory=dict)
    chance: bool = False


def check_variables(variables: Sequence[Variable], constants: Iterable[str]) -> None:
    """Each variable has a name of its own, a kind that is possible here, and the values that belong to it."""
    taken = set(constants)
    for variable in variables:
        if variable.name in taken:
            raise problem("variable twice", variable.at, name=variable.name)
        taken.add(variable.name)
        _check_kind(variable)
        known = Scope(frozenset(constants), {v.name: v for v in variables})
        for value in variable.values:
            resolve(value, known)


def _check_kind(variable: Variable) -> None:
    kind = variable.kind
    if kind in QUERY_FUNCTIONS:
        raise problem("kind of variable", variable.at, kind=kind, hint=_POSSIBLE)
    if kind not in VARIABLE_KINDS:
        raise problem("unknown kind of variable", variable.at, kind=kind, hint=suggestion(kind, VARIABLE_KINDS) or _POSSIBLE)
    least, most, example = VARIABLE_KINDS[kind]
    said = {"kind": kind, "name": variable.name, "example": example}
    if not least <= len(variable.values) <= most:
        wanted = f"{least}" if least == most else f"up to {most}" if least == 0 else f"{least} or more"
        raise problem(
            "values of variable", variable.at, wanted=f"{wanted} value{'s' * (most > 1)}", given=len(variable.values), **said
        )
    if kind in ("index", "function") and (len(variable.numbers) < len(variable.values) or min(variable.numbers, default=0) < 0):
        raise problem("numbers of variable", variable.at, **said)


def resolve(expression: Expression, scope: Scope) -> Expression:
    """An expression with the variables replaced by what they mean."""

    def change(part: Expression) -> Expression | None:
        if isinstance(part, Name):
            return _resolve_name(part, scope)
        if isinstance(part, Apply) and part.operator == "sensed" and isinstance(part.operands[0], Name):
            return _sensed_call(part, part.operands[0], [resolve(value, scope) for value in part.operands[1:]], scope)
        return None

    return transform(expression, change)


def _resolve_name(name: Name, scope: Scope) -> Expression:
    variable = scope.variables.get(name.name)
    if name.name in scope.known:
        return name
    if name.name in scope.counting:
        return Name(scope.counting[name.name], name.at)
    if variable is None:
        names = {*scope.known, *scope.variables}
        hint = suggestion(name.name, names, 0.5)  # so that "xo" is like "x0"
        raise problem("unknown variable", name.at, name=name, hint=hint or _UNKNOWN_NAME_HINT)
    if variable.kind == "function" and variable.numbers[1] == 0:
        return Apply("sensed", (Number(variable.numbers[0]),), name.at)
    if variable.kind == "function":
        raise problem("function without values", name.at, name=name, values=", ".join("1" * variable.numbers[1]))
    if variable.kind == "index":
        inside = f" with {variable.level} more around it" if variable.level else ""
        raise problem("index outside", name.at, name=name, inside=inside)
    if not scope.chance:
        raise problem("draw not possible", name.at, name=name)
    return replace(random_call(variable), at=name.at)


def random_call(variable: Variable) -> Apply:
    """The draw of a random variable; a normal one is declared with its variance.

    >>> print(random_call(Variable("x", "normal", (Number(0), Number(15)))))
    normal(0, sqrt(15))
    """
    if variable.kind != "normal":
        return Apply("table" if variable.kind == "distribution" else variable.kind, variable.values)
    mean, variance = variable.values
    root = _root(variance.value) if isinstance(variance, Number) and isinstance(variance.value, int | Fraction) else None
    return Apply("normal", (mean, Apply("sqrt", (variance,)) if root is None else Number(normalised(root))))


def _root(value: int | Fraction) -> Fraction | None:
    """The square root of a number, where it is rational."""
    if value < 0:
        return None
    root = Fraction(isqrt(value.numerator), isqrt(value.denominator))
    return root if root * root == value else None


def _sensed_call(expression: Apply, name: Name, values: list[Expression], scope: Scope) -> Apply:
    variable = scope.variables.get(name.name)
    if variable is None or variable.kind != "function":
        functions = {v.name for v in scope.variables.values() if v.kind == "function"}
        functions |= {known for known, operator in OPERATORS.items() if operator.precedence is None and not operator.random}
        declare = f'Declare it, as in "\\var {name} function 2 {len(values)},".'
        hint = suggestion(name.name, functions - {"sensed"}, 0.7) or declare
        raise problem("unknown function", name.at, name=name, hint=hint)
    number, count = variable.numbers
    if len(values) != count:
        raise problem("number of arguments", name.at, name=name, wanted=values_text(count), given=len(values))
    return Apply("sensed", (Number(number), *values), expression.at)


def resolve_rule(rule: Production, scope: Scope, chance: bool) -> Production:
    """A rule with the variables replaced; its parameters come before variables of the same name."""
    named = {a.name for module in rule.parameters for a in module.arguments if isinstance(a, Name)}
    scope = replace(scope, known=scope.known | named)
    condition, probability = (part if part is None else resolve(part, scope) for part in (rule.condition, rule.probability))
    return replace(
        rule,
        condition=condition,
        probability=probability,
        successor=resolve_items(rule.successor, replace(scope, chance=chance)),
    )


def resolve_items(items: Iterable[Item], scope: Scope, depth: int = 0) -> tuple[Item, ...]:
    """A word with the variables replaced, so many repetitions deep."""
    found: list[Item] = []
    for item in items:
        if isinstance(item, Repeat):
            used = names_of(item.body)
            counters = [
                v.name
                for v in scope.variables.values()
                if v.kind == "index" and v.level == depth and v.name in used - scope.known
            ]
            index = counters[0] if counters else ""
            inner = replace(scope, counting={**scope.counting, **dict.fromkeys(counters, index)})
            found.append(Repeat(resolve(item.count, scope), resolve_items(item.body, inner, depth + 1), index, item.at))
        elif item.arguments:
            found.append(replace(item, arguments=tuple(resolve(a, scope) for a in item.arguments)))
        else:
            found.append(item)
    return tuple(found)


def names_of(items: Iterable[Item]) -> frozenset[str]:
    """The names that a word uses."""
    return frozenset(name for expression in expressions_of(items) for name in names_in(expression))
