"""Reproducible chance: every random number is a function of the seed, the step, the module's position, and how many numbers
it has drawn before.

So a plant is the same on every machine, whatever is computed first or at once. The numbers are those of the generator
splitmix64 (Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014), used as a hash.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from typing import TYPE_CHECKING

from lsys_kit.arrays import np
from lsys_kit.budget import check_budget, counted
from lsys_kit.notation.model.arithmetic import Value, normalised

if TYPE_CHECKING:
    from numpy.typing import NDArray

_GOLDEN, _FIRST, _SECOND, MASK = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB, 2**64 - 1
_UNIT = 2.0**-53


def splitmix64(number: int) -> int:
    """splitmix64's output for a state.

    >>> hex(splitmix64(0)), hex(splitmix64(0x9E3779B97F4A7C15))
    ('0xe220a8397b1dcdaf', '0x6e789e6aa1b965f4')
    """
    number = (number + _GOLDEN) & MASK
    number = (number ^ number >> 30) * _FIRST & MASK
    number = (number ^ number >> 27) * _SECOND & MASK
    return number ^ number >> 31


def splitmix64_array(numbers: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """The same for many states at once."""
    numbers = numbers + np.uint64(_GOLDEN)
    numbers = (numbers ^ numbers >> np.uint64(30)) * np.uint64(_FIRST)
    numbers = (numbers ^ numbers >> np.uint64(27)) * np.uint64(_SECOND)
    return numbers ^ numbers >> np.uint64(31)


def units(seed: int, step: int, positions: NDArray[np.integer]) -> NDArray[np.float64]:
    """The first random number, from 0 up to 1, of the modules at some positions of a step's word.

    >>> units(1, 2, np.arange(3)).tolist() == [Chance(1, 2, position).unit() for position in range(3)]
    True
    """
    return units_of(keys_of(seed, step, positions))


def keys_of(seed: int | NDArray[np.uint64], step: int, positions: NDArray[np.integer]) -> NDArray[np.uint64]:
    """What the modules at some positions of a step's word draw their random numbers from; each may have a seed of its own.

    >>> bool((keys_of(np.array([1, 2], dtype=np.uint64), 3, np.array([4, 4])) == [keys_of(1, 3, np.array([4]))[0],
    ...                                                                           keys_of(2, 3, np.array([4]))[0]]).all())
    True
    """
    stem = np.uint64(_stem(seed, step)) if isinstance(seed, int) else splitmix64_array(splitmix64_array(seed) ^ np.uint64(step))
    return splitmix64_array(stem ^ positions.astype(np.uint64))


def units_of(keys: NDArray[np.uint64], drawn: int | NDArray[np.integer] = 0) -> NDArray[np.float64]:
    """The next random number, from 0 up to 1, of modules that have drawn some before.

    >>> one = Chance(1, 2, 0)
    >>> [float(units_of(keys_of(1, 2, np.arange(1)), drawn)[0]) for drawn in range(2)] == [one.unit(), one.unit()]
    True
    """
    if not isinstance(drawn, int):
        keys = keys + drawn.astype(np.uint64) * np.uint64(_GOLDEN)
    elif drawn:
        keys = keys + np.uint64(drawn * _GOLDEN & MASK)
    return (splitmix64_array(keys) >> np.uint64(11)).astype(np.float64) * _UNIT


def few_units(seed: int, step: int, positions: Iterable[int]) -> list[float]:
    """The same for few modules, without arrays.

    >>> few_units(1, 2, range(3)) == units(1, 2, np.arange(3)).tolist()
    True
    """
    stem = _stem(seed, step)
    return [(splitmix64(splitmix64(stem ^ position)) >> 11) * _UNIT for position in positions]


def _stem(seed: int, step: int) -> int:
    return splitmix64(splitmix64(seed & MASK) ^ step)


@dataclass
class Chance:
    """The random numbers of one module at one step.

    seed
        Any whole number.
    step, position
        Which module: its place in the word of which step.
    sees
        Answers what the module asks of the turtle, given a function's number and values; None without an observer.

    >>> one, again = Chance(7, 3, 12), Chance(7, 3, 12)
    >>> one.unit() == again.unit(), 0 <= one.uniform(0, 360) < 360
    (True, True)
    """

    seed: int
    step: int
    position: int
    sees: Callable[..., Value] | None = None
    drawn: int = 0

    def unit(self) -> float:
        """A number from 0 up to, but not, 1."""
        key = splitmix64(_stem(self.seed, self.step) ^ self.position)
        self.drawn += 1
        return (splitmix64((key + (self.drawn - 1) * _GOLDEN) & MASK) >> 11) * _UNIT

    def uniform(self, low: float, high: float) -> float:
        """A number from `low` up to `high`, each equally likely."""
        return float(low) + (float(high) - float(low)) * self.unit()

    def normal(self, mean: float, deviation: float) -> float:
        """A number of a bell curve with a standard deviation, of which 0 gives the mean."""
        if deviation < 0:
            raise ValueError("a standard deviation is not negative")
        from statistics import NormalDist  # imported late: it takes longer than a short word

        unit = self.unit() + _UNIT / 2
        return float(mean) + float(deviation) * NormalDist().inv_cdf(unit)

    def binomial(self, trials: float, probability: float) -> int:
        """How many of some trials succeed."""
        if trials != int(trials) or not 0 <= trials <= 100_000:
            raise ValueError("trials are counted: a whole number from 0 to 100,000")
        _check_probability(probability)
        return sum(self.unit() < probability for _ in counted(range(int(trials))))

    def poisson(self, mean: float) -> int:
        """How many rare events happen, on average `mean`."""
        if not 0 <= mean <= 500:
            raise ValueError("the mean of a Poisson distribution is from 0 to 500 here")
        check_budget()
        product, count, least = self.unit(), 0, math.exp(-float(mean))
        while product > least:
            product, count = product * self.unit(), count + 1
        return count

    def table(self, *weights: float) -> int:
        """A number 0, 1, 2, ..., each as likely as its weight says."""
        return choose(weights, self.unit())


def choose(weights: Sequence[Value], unit: float) -> int:
    """Which of some weighted things a random number from 0 up to 1 chooses; the weights need not sum to one.

    >>> choose((1, 1, 2), 0.49), choose((1, 1, 2), 0.5)
    (1, 2)
    """
    ends, total = stretches(weights)
    return bisect_right(ends, unit * total)


def stretches(weights: Sequence[Value]) -> tuple[list[float], float]:
    """Where the stretch of each weight ends in a line from 0 on, and how long the line is.

    The last stretch has no end, so that rounding leaves nothing behind it.

    >>> stretches((1, 1, 2, 0)), stretches((2.0**1023, 2.0**1023))
    (([1.0, 2.0, inf, inf], 4.0), ([1.0, inf], 2.0))
    """
    weights, total = _moderate(weights)
    last = max(number for number, weight in enumerate(weights) if weight)
    return [*accumulate(map(float, weights[:last])), *[math.inf] * (len(weights) - last)], float(total)


def shares(weights: Sequence[Value]) -> list[Value]:
    """How likely each of some weighted things is; exact where the weights are.

    >>> shares((1, 1, 2))
    [Fraction(1, 4), Fraction(1, 4), Fraction(1, 2)]
    """
    weights, total = _moderate(weights)
    exact = all(isinstance(weight, int | Fraction) for weight in weights)
    return [normalised(Fraction(weight) / Fraction(total)) if exact else float(weight) / float(total) for weight in weights]


_MODERATE = 2**900
"""Weights up to this, and down to its reciprocal, have sums and quotients among the doubles."""


def _moderate(weights: Sequence[Value]) -> tuple[Sequence[Value], Value]:
    """The weights, multiplied by one power of two where the largest is very large or very small, and their sum.

    The sum is exact, or the double nearest to it: from Python 3.12 on, `sum` rounds doubles differently.
    """
    if not (all(weight >= 0 for weight in weights) and 0 < (largest := max(weights)) < math.inf):
        raise ValueError("probabilities are not negative, and one of them is greater than 0")
    if not Fraction(1, _MODERATE) <= largest <= _MODERATE:
        exact = Fraction(largest)
        scale = Fraction(2) ** (exact.denominator.bit_length() - exact.numerator.bit_length())
        scaled = [Fraction(weight) * scale for weight in weights]
        weights = [float(now) if isinstance(weight, float) else now for weight, now in zip(weights, scaled, strict=True)]
    return weights, math.fsum(weights) if any(isinstance(weight, float) for weight in weights) else sum(weights)


def _check_probability(probability: float) -> None:
    if not 0 <= probability <= 1:
        raise ValueError("a probability is from 0 to 1")
