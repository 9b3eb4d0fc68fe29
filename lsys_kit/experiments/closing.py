"""Angles for which a turtle comes back: where its walk ends as a sum of powers of e^(iδ), and for which δ that is 0.

A turtle in the plane that has turned k times by the angle δ looks in the direction e^(ikδ). So its walk through a word ends at
a sum of c z^k, where z = e^(iδ) and c is how far it goes in that direction altogether. The figure is closed where this
polynomial is 0 at a point of the unit circle. An irreducible polynomial that has such a root has its inverse as a root, too,
and is the same read backwards: it is cyclotomic, with fractions of a full turn, or it is a polynomial in z + 1/z = 2 cos δ,
whose real roots between -2 and 2 are isolated exactly.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Choices
from lsys_kit.errors import ModelLimitError, ModelValueError, require, whole_number
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.geometry.turtle.plane import turtle_in_plane
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.system import USUAL_STEPS, LSystem
from lsys_kit.pictures.draw import draw
from lsys_kit.pictures.multiples import SmallMultiples
from lsys_kit.supervision import supervised
from lsys_kit.worlds.derive import derive

if TYPE_CHECKING:
    import sympy

MOST_TURNS = 200
"""The directions are at most so many turns apart: the degree of the polynomial."""
MOST_DRAWN = 24
"""So many closed figures stand side by side at most."""
FEWEST, ALMOST = 5, 1e-9
"""A root of unity of a polynomial is one of an order that is at most so many times the degree, for the degrees allowed; a sum
that is less than this share of its terms may be 0."""
LARGEST_DENOMINATOR = 10**6
"""Lengths are fractions of the first one, with no greater denominator."""


@dataclass(frozen=True)
class Closing:
    """Where a turtle's walk through a word ends, for any angle, and the angles for which that is where it began.

    Attributes
    ----------
    word
        The word.
    powers
        For each number of turns to the left how far the turtle goes altogether when it has turned so often; the unit is the
        length of the first step forward. The number is less by that of the first step forward, so that this one points ahead.
    """

    word: Word
    powers: dict[int, int | Fraction] = field(hash=False)

    @property
    def z(self) -> sympy.Symbol:
        """What stands for e^(iδ): the direction of a turtle that looked ahead and has turned once to the left."""
        import sympy

        return sympy.Symbol("z")

    @property
    def end(self) -> sympy.Expr:
        """Where the walk ends, in powers of z = e^(iδ).

        >>> from lsys_kit import read
        >>> closing_angles(read("axiom: F+F+F"), 0).end
        z**2 + z + 1
        """
        import sympy

        return sympy.Add(*(_rational(c) * self.z**k for k, c in self.powers.items()))

    @cached_property
    def factors(self) -> sympy.Expr:
        """The same as a product of polynomials that cannot be divided further, and a power of z.

        >>> from lsys_kit import read
        >>> closing_angles(read("axiom: F+F+F+F"), 0).factors
        (z + 1)*(z**2 + 1)
        """
        import sympy

        with Task("The factors were not found"), supervised():
            return sympy.factor(self.end)

    @cached_property
    def angles(self) -> tuple[Value, ...]:
        """The angles from 0 to 180 degrees for which the walk ends where it began; exactly, where they are fractions of a turn.

        Each stands for its opposite, too: turns to the other side draw the mirror image.

        >>> from lsys_kit import read
        >>> closing_angles(read("axiom: F--F--F"), 0).angles
        (60, 120)
        >>> closing_angles(read("axiom: F+F+F(1/2)"), 0).angles
        ()
        """
        import sympy

        if self.always:
            return ()
        with Task("The angles were not found"), supervised():
            least = min(self.powers)
            rest = sympy.Poly({(k - least,): _rational(c) for k, c in self.powers.items()}, self.z, domain="QQ")
            size, found = sum(abs(float(c)) for c in self.powers.values()), list[Value]()
            for parts in counted(range(1, FEWEST * rest.degree() + FEWEST), 1):
                if self.distance(360 / parts) > ALMOST * size:
                    continue
                divisor = sympy.Poly(sympy.cyclotomic_poly(parts, self.z), self.z, domain="QQ")
                quotient, remainder = sympy.div(rest, divisor)
                if remainder.is_zero:
                    found += [normalised(Fraction(360 * k, parts)) for k in range(parts // 2 + 1) if math.gcd(k, parts) == 1]
                while remainder.is_zero:
                    rest = quotient
                    quotient, remainder = sympy.div(rest, divisor)
            return tuple(sorted(found + _other_angles(rest)))

    @property
    def always(self) -> bool:
        """Whether the walk ends where it began for every angle."""
        return not self.powers

    def distance(self, angle: float) -> float:
        """How far from its beginning the walk ends, for an angle in degrees, in lengths of the first step forward.

        >>> from lsys_kit import read
        >>> round(closing_angles(read("axiom: F+F"), 0).distance(90), 6)
        1.414214
        """
        radians = [k * math.radians(angle) for k in self.powers]
        lengths = [float(c) for c in self.powers.values()]
        return math.hypot(
            *(math.fsum(c * turn(each) for c, each in zip(lengths, radians, strict=True)) for turn in (math.cos, math.sin))
        )

    def draw(self) -> SmallMultiples:
        """The closed figures side by side, each with its angle below it.

        >>> from lsys_kit import read
        >>> closing_angles(read("axiom: F--F--F"), 0).draw()
        60° to 120°; the last: 3 segments, width 0.87, height 1
        """
        if not self.angles:
            raise ModelValueError("There is no closed figure to draw" if not self.always else "It is closed for every angle")
        shown = self.angles[:MOST_DRAWN]
        pictures = [draw(self.word, angle=float(angle)) for angle in counted(shown, 1)]
        return SmallMultiples(pictures, [f"{_degrees(angle)}°" for angle in shown])

    @property
    def latex(self) -> str:
        """Where the walk ends, its factors, and the angles for which it is closed, one below the other, in LaTeX.

        >>> from lsys_kit import read
        >>> print(closing_angles(read("axiom: F|F"), 0).latex)
        0 \\quad \\text{for every } \\delta
        """
        import sympy

        if self.always:
            return r"0 \quad \text{for every } \delta"
        ends = [rf"{{\displaystyle {sympy.latex(each)}}}" for each in dict.fromkeys((self.end, self.factors))]
        said = r",\ ".join(rf"{_degrees(angle)}^\circ" for angle in self.angles) or r"\text{none}"
        rows = r" \\ ".join([r" \\ = ".join(ends), rf"z = e^{{i\delta}}:\quad \delta = {said}"])
        return rf"\begin{{array}}{{l}} {rows} \end{{array}}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex}$"

    def __repr__(self) -> str:
        if self.always:
            return "closed for every angle"
        said = ", ".join(map(_degrees, self.angles))
        where = f"closed for {said} degrees" if said else "closed for no angle"
        return f"end {number_text(self.end)}, z = e^(i angle); {where}"


def _degrees(angle: Value) -> str:
    return number_text(angle) if not isinstance(angle, float) else f"{angle:.4f}"


def _rational(value: int | Fraction) -> sympy.Rational:
    import sympy

    return sympy.Rational(value.numerator, value.denominator)


def _other_angles(whole: sympy.Poly) -> list[Value]:
    """The angles between 0 and 180 degrees of roots on the unit circle, of a polynomial without roots of unity."""
    import sympy

    backwards = sympy.Poly(whole.all_coeffs()[::-1], whole.gen, domain="QQ")
    coefficients = sympy.gcd(whole, backwards).sqf_part().all_coeffs()
    half = len(coefficients) // 2
    c = sympy.Symbol("c")  # stands for z + 1/z
    one, powers = sympy.Poly(c, c), [sympy.Poly(2, c), sympy.Poly(c, c)]
    while len(powers) <= half:  # z^k + z^-k
        powers.append(one * powers[-1] - powers[-2])
    halved = sum((powers[k] * coefficients[half - k] for k in range(1, half + 1)), sympy.Poly(coefficients[half], c))
    places = halved.intervals(eps=sympy.Rational(1, 2**60), inf=-2, sup=2) if half else []
    return [math.degrees(math.acos(float((low + high) / 4))) for (low, high), _ in places]


def closing_angles(system: LSystem, n: int | None = None, **constants: object) -> Closing:
    """For which angles a turtle comes back to where it began: the angle as a letter.

    Parameters
    ----------
    system
        A system that a turtle draws in the plane, turning by its angle; turns by other degrees must be half turns.
    n
        The step whose word the turtle follows; by default as many as the system asks for.
    **constants
        New values of declared constants.

    Returns
    -------
    Closing
        It has `.end`, a sum of powers of z = e^(iδ), `.factors`, `.angles` in degrees, `.draw()` and `.latex`.

    Raises
    ------
    ModelValueError
        The turtle leaves the plane, or turns by degrees that are not multiples of the angle, or goes lengths that are no
        fractions of one another.
    ModelLimitError
        The directions are more than 200 turns apart.

    Examples
    --------
    >>> from lsys_kit import read
    >>> closing_angles(read("axiom: F--F--F\\nF -> F+F--F+F"), 1).angles
    (60, 120, 180)
    >>> closing_angles(read("axiom: F+F+F"), 0)
    end z^2 + z + 1, z = e^(i angle); closed for 120 degrees
    """
    require(system, LSystem, "An L-system")
    with Task("The angles were not found"):
        steps = whole_number(n, "The step") if n is not None else USUAL_STEPS if system.steps is None else system.steps
        if drawing_mode(system) is not DrawingMode.PLANE:
            raise ModelValueError("Only a turtle that stays in the plane closes a figure by turning")
        chosen: Choices = constants
        word = derive(system, steps, **chosen)[-1]
        return Closing(word, _powers(word))


def _powers(word: Word) -> dict[int, int | Fraction]:
    """How far the turtle goes for each number of turns, along the walk to the end of the word."""
    turtle = turtle_in_plane(word)
    steps, found = [*turtle.walked()], defaultdict[int, Fraction](Fraction)
    at, walk = turtle.position, list[Sequence[float]]()
    while at >= 0:
        walk.append(steps[at])
        at = int(steps[at][3])
    if not walk:
        return {}
    turns_first, offset_first, length_first, *_ = walk[-1]
    for turns, offset, length, *_ in counted(walk[::-1]):
        way, rest = _way(turns - turns_first, offset - offset_first)
        found[way] += rest * _fraction(length, length_first)
    powers = {k: c.numerator if c.denominator == 1 else c for k, c in sorted(found.items(), reverse=True) if c}
    if powers and max(powers) - min(powers) > MOST_TURNS:
        wide = max(powers) - min(powers)
        raise ModelLimitError(f"The directions are {wide} turns apart, more than {MOST_TURNS}", limit=MOST_TURNS, needed=wide)
    return powers


def _way(turns: float, degrees: float) -> tuple[int, int]:
    """A direction as a number of turns by the angle, and 1 or -1, which is a half turn."""
    halves = degrees / 180
    if turns != math.floor(turns) or halves != math.floor(halves):
        raise ModelValueError(
            f"The turtle turns by {number_text(degrees)} degrees, whatever the angle is",
            hint="Let it turn by the angle alone: + and - without a number.",
        )
    return int(turns), -1 if int(halves) % 2 else 1


def _fraction(length: float, unit: float) -> Fraction:
    """A length as a fraction of another."""
    ratio = length / unit if unit else math.nan
    found = Fraction(ratio).limit_denominator(LARGEST_DENOMINATOR) if math.isfinite(ratio) else Fraction()
    if not math.isclose(float(found), ratio, rel_tol=1e-12):
        raise ModelValueError("The steps of the turtle have lengths that are no fractions of one another")
    return found
