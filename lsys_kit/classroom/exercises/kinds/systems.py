"""Systems as answers: right where their language is, whatever their symbols and parameters are called.

An answer is compared by its axiom, by what becomes of every module that the question is about, and by the words of all steps,
from the axiom and from other axioms. Where the question gives a part, the answer is tried in front of that part and behind it:
a production must itself say to which modules it applies.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from itertools import islice, pairwise, product, zip_longest

from lsys_kit.budget import counted
from lsys_kit.classroom.exercises.asked import beginning_with, system_of, with_constants
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.forms import form_of, in_names_of, with_names
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import ARROW, formula_text, quoted, read_typed, text_answer
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.petri.net import all_outcomes, outcomes_of
from lsys_kit.errors import LSystemError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.analysis.lint import warnings
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Number, expression_type, walk
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, Production, symbols
from lsys_kit.notation.read import read, read_expression, read_word
from lsys_kit.worlds.derive import derive

# Words that are the same but for the names of their symbols


class Renaming:
    """Which symbol of an answer stands for which of the solution, found as words are compared.

    Parameters
    ----------
    known
        The symbols of the solution.
    names
        "new": a symbol of the solution means itself, and a new one may stand for any; "any": any symbol may stand for any;
        "fixed": every symbol means itself. What is no name, such as + or [, always means itself.

    Examples
    --------
    >>> words = [[Module("x"), Module("y")], [Module("a"), Module("b")]]
    >>> Renaming(frozenset("ab"), "new").first_difference(*words), Renaming(frozenset("ab"), "fixed").first_difference(*words)
    (None, 0)
    >>> Renaming(frozenset("ab"), "new").first_difference([Module("b"), Module("a")], words[1])
    0
    """

    def __init__(self, known: Iterable[str], names: str = "new") -> None:
        self.known, self.names = frozenset(known), names
        self._wanted: dict[str, str] = {}
        self._own: dict[str, str] = {}

    def first_difference(self, mine: Sequence[Module], wanted: Sequence[Module]) -> int | None:
        """The first position at which a word of the answer is not that of the solution, or None."""
        for at, (own, other) in enumerate(zip_longest(mine, wanted)):
            if own is None or other is None:
                return at
            own, other = one_way_round(own), one_way_round(other)
            if own.arguments != other.arguments or not self._may_stand(own.symbol, other.symbol):
                return at
        return None

    def _may_stand(self, own: str, wanted: str) -> bool:
        """Whether a symbol may stand for another; from now on it does."""
        if own in self._wanted or wanted in self._own:
            return self._wanted.get(own) == wanted
        means_itself = (
            self.names == "fixed"
            or (self.names == "new" and own in self.known)
            or not (own[:1].isalpha() and wanted[:1].isalpha())
        )
        if means_itself and own != wanted:
            return False
        self._wanted[own], self._own[wanted] = wanted, own
        return True

    def own(self, module: Module) -> Module:
        """A module of the solution as the answer calls it."""
        return replace(module, symbol=self._own.get(module.symbol, module.symbol))

    @property
    def found(self) -> Mapping[str, str]:
        """For symbols of the solution what they are called in the answer, as far as that is known."""
        return self._own

    def wanted(self, module: Module) -> Module:
        """A module of the answer as the solution calls it."""
        return replace(module, symbol=self._wanted.get(module.symbol, module.symbol))


_OTHER_WAY = {"-": "+", "^": "&", "\\": "/"}
"""Turns, and those that lead the other way."""


def one_way_round(module: Module) -> Module:
    """A module; if it is a turn by an angle, that which does the same in the direction of +, & or /.

    >>> one_way_round(Module("-", (60,))), one_way_round(Module("/", (480,))), one_way_round(Module("F", (-1,)))
    (+(300), /(120), F(-1))
    """
    if len(module.arguments) != 1 or not (module.symbol in _OTHER_WAY or module.symbol in _OTHER_WAY.values()):
        return module
    (angle,) = module.arguments
    other = _OTHER_WAY.get(module.symbol)
    return Module(other, (-angle % 360,)) if other else replace(module, arguments=(angle % 360,))


# Two systems compared


MOST_MODULES = 300
"""Of so many different modules it is compared what becomes of them."""


@dataclass(frozen=True)
class SystemAnswer:
    """A system as somebody answers it.

    Attributes
    ----------
    front, behind
        The whole system: with its productions in front of those that the question gives, and behind them.
    own
        The part that was typed, with the axiom that it has or is given; its productions know where they stand in its source.
    """

    front: LSystem
    behind: LSystem
    own: LSystem


def completed(exercise: Exercise, own: LSystem) -> SystemAnswer:
    """A part of a system with what the question gives."""
    if not exercise.given:
        return whole(own)
    given = system_of(exercise.given)
    rest = tuple(rule for rule in given.productions if rule not in own.productions)
    behind = replace(own, productions=rest + own.productions)
    return SystemAnswer(behind if exercise.behind else replace(own, productions=own.productions + rest), behind, own)


@dataclass(frozen=True)
class Parting:
    """Where two systems part: at the axiom (step 0), at a step, or in what becomes of a module alone."""

    step: int = 0
    position: int = 0
    module: Module | None = None
    setting: str = ""


def renaming(exercise: Exercise, wanted: LSystem) -> Renaming:
    return Renaming(frozenset(symbols(wanted)), "fixed" if exercise.drawn else exercise.names)


def parting(exercise: Exercise, mine: LSystem, wanted: LSystem) -> Parting | None:
    """Where two systems first part, or None where they are the same up to renaming."""
    for setting in ({}, *exercise.settings):
        named = ", ".join(f"{name} = {value}" for name, value in setting.items())
        found = _parting(exercise, with_constants(mine, setting), with_constants(wanted, setting))
        if found is not None:
            return replace(found, setting=", ".join(filter(None, (named, found.setting))))
    return None


def _parting(exercise: Exercise, mine: LSystem, wanted: LSystem) -> Parting | None:
    names = renaming(exercise, wanted)
    certain = not States(wanted).traits.stochastic and not States(mine).traits.stochastic
    found = words_parting(mine, wanted, names, exercise.steps if certain else 0)
    if found is not None and found.step == 0:
        return found
    wrong = next(wrongly_replaced(exercise, mine, wanted, names), None)
    if wrong is not None:
        return Parting(found.step if found else 0, module=wrong)
    if found is not None:
        return found
    for probe in exercise.probes:
        word = read_word(probe, "abop", wanted)
        own_word = [names.own(module) for module in word]
        found = words_parting(beginning_with(mine, own_word), beginning_with(wanted, word), names, min(exercise.steps, 5))
        if found is not None:
            return Parting(found.step, found.position, setting=reply("system.axiom_is", word=probe))
    return _parting_in_context(mine, wanted, names) or _parting_at_a_bound(exercise, mine, wanted, names)


def _parting_in_context(mine: LSystem, wanted: LSystem, names: Renaming) -> Parting | None:
    """Where two systems part between the neighbours of a production with a condition that the solution does not have.

    Its parameters are tried with the numbers of its condition, with 0 and with numbers between and beyond.
    """
    known = {rule.condition for rule in wanted.productions}
    for rule in mine.productions:
        patterns = [*rule.left, *rule.predecessors, *rule.right]
        if rule.condition is None or rule.condition in known or not (rule.left or rule.right):
            continue
        values = sorted({0, *(value for value in bounds_of(rule) if value >= 0)})
        values.append(values[-1] + 7)
        for given in islice(product(values, repeat=sum(len(each.arguments) for each in patterns)), MOST_MODULES):
            each = iter(given)
            word = [Module(pattern.symbol, tuple(next(each) for _ in pattern.arguments)) for pattern in patterns]
            found = words_parting(beginning_with(mine, word), beginning_with(wanted, [*map(names.wanted, word)]), names, 1)
            if found is not None:
                return Parting(found.step, found.position, setting=reply("system.axiom_is", word="".join(map(str, word))))
    return None


def _parting_at_a_bound(exercise: Exercise, mine: LSystem, wanted: LSystem, names: Renaming) -> Parting | None:
    """Where two systems part for a number at a bound of their conditions, or between two bounds.

    Only where the numbers of the question need not be whole: where one of its probes is none.
    """
    probes = [module for probe in exercise.probes for module in read_word(probe, "abop", wanted)]
    symbol = next((each.symbol for each in probes if any(value != int(value) for value in each.arguments)), "")
    if not symbol:
        return None
    reached = [module.arguments[0] for module in (*asked_modules(exercise, wanted), *probes) if module.symbol == symbol]
    own, right = mine.productions, wanted.productions
    if mine.decomposition and wanted.decomposition:  # what a step makes is decomposed: what stays as it is, too
        own, right = mine.decomposition, wanted.decomposition
        mine, wanted = (replace(each, productions=()) for each in (mine, wanted))
    asked = [*reached, *numbers_compared(*right)]
    for value in bounds_of(*own, *right):
        if min(asked) <= value <= max(asked):
            start = Module(symbol, (value,))
            found = words_parting(beginning_with(mine, [names.own(start)]), beginning_with(wanted, [start]), names, 1)
            if found is not None:
                return Parting(found.step, found.position, setting=reply("system.axiom_is", word=start))
    return None


def words_parting(mine: LSystem, wanted: LSystem, names: Renaming, steps: int) -> Parting | None:
    """Where the words of two systems first part; which names stand for one another is found on the way."""
    own, other = derive(mine, steps), derive(wanted, steps)
    for step, (a, b) in enumerate(zip(own, other, strict=True)):
        at = names.first_difference(a, b)
        if at is not None:
            return Parting(step, at)
    return None


def asked_modules(exercise: Exercise, wanted: LSystem) -> list[Module]:
    """The modules that a question is about: those of the words of the solution, up to a limit."""
    states = States(wanted)
    if states.traits.stochastic and states.traits.s0l:
        all_outcomes(states, MOST_MODULES)
        return states.modules[:MOST_MODULES]
    words = derive(wanted, exercise.steps if states.traits.d0l else 0)
    return list(islice(dict.fromkeys(module for word in words for module in counted(word)), MOST_MODULES))


def wrongly_replaced(exercise: Exercise, mine: LSystem, wanted: LSystem, names: Renaming) -> Iterator[Module]:
    """The modules of the question, as the answer calls them, of which something else becomes."""
    own, other = States(mine), States(wanted)
    simple = all(states.traits.d0l or states.traits.s0l for states in (own, other))
    for module in asked_modules(exercise, wanted) if simple else ():
        called = names.own(module)
        if _fates(own, called, names) != _fates(other, module, None):
            yield called


def _fates(states: States, module: Module, names: Renaming | None) -> Mapping[tuple[object, ...], Value]:
    """What may become of a module, and how likely, in the symbols of the solution."""
    state = states.number(module.symbol, module.arguments)
    found: dict[tuple[object, ...], Value] = {}
    outcomes = [(outcome.successor, outcome.chance) for outcome in outcomes_of(states, state)] or [((state,), 1)]
    for successor, chance in outcomes:
        word = [states.modules[number] for number in successor]
        word = [one_way_round(names.wanted(each) if names else each) for each in word]
        found[tuple(word)] = found.get(tuple(word), 0) + chance
    return found


def unused(own: LSystem) -> Production | None:
    """A production before which another always applies."""
    found = (each.subject["rule"] for each in warnings(own) if each.code.startswith("production never applied"))
    return next((rule for rule in found if isinstance(rule, Production)), None)


def same(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    return (
        (not exercise.drawn or mine.front.angle == wanted.front.angle)
        and parting(exercise, mine.front, wanted.behind) is None
        and (mine.front is mine.behind or parting(exercise, mine.behind, wanted.behind) is None)
        and unused(mine.own) == unused(wanted.own)
    )


def tests_passed(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> tuple[int, int]:
    """How many tests a wrong answer passes, and how many there are; none where chance has a say.

    A test is a step, with each setting of the constants, whose word is not right without what was typed; it is passed if the
    words up to it are right. One more test is all else: other axioms, the angle, that no production is unused.
    """
    if any(States(each).traits.stochastic for each in (mine.behind, wanted.behind)):
        return 0, 0
    untyped = replace(
        wanted.behind, productions=tuple(rule for rule in wanted.behind.productions if rule not in wanted.own.productions)
    )
    passed = asked = 0
    for setting in ({}, *exercise.settings):
        given = _agreeing_steps(exercise, untyped, wanted.behind, setting)
        own = min(_agreeing_steps(exercise, each, wanted.behind, setting) for each in (mine.front, mine.behind))
        passed, asked = passed + max(own - given, 0), asked + exercise.steps - given
    return passed, asked + 1


def _agreeing_steps(exercise: Exercise, mine: LSystem, wanted: LSystem, setting: Mapping[str, Value]) -> int:
    try:
        names, each = renaming(exercise, wanted), [with_constants(system, setting) for system in (mine, wanted)]
        found = words_parting(each[0], each[1], names, exercise.steps)
    except LSystemError:
        return 0
    return exercise.steps if found is None else max(found.step - 1, 0)


def alike(exercise: Exercise, mine: SystemAnswer, other: SystemAnswer) -> bool:
    """Whether an answer is that which a misconception leads to, in its form: what does the same may be another mistake."""
    own = in_names_of(mine.own, other.own, symbols(solution_front(exercise)), exercise.names)
    given = system_of(exercise.given).productions if exercise.given else ()
    return form_of(own, given, exercise.drawn) == form_of(other.own, given, exercise.drawn)


@lru_cache(maxsize=128)
def solution_front(exercise: Exercise) -> LSystem:
    """The whole system of the solution."""
    return _read_typed(exercise, exercise.solution).front


def renamed_as_in(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer, system: LSystem) -> LSystem:
    """A system of the solution's symbols with the names that they have in an answer, as far as these are known."""
    names = renaming(exercise, wanted.behind)
    replaced = {module.symbol for rule in mine.own.productions for module in rule.predecessors}
    if names.names != "fixed" and not replaced <= names.known:
        with suppress(LSystemError):
            words_parting(mine.behind, wanted.behind, names, exercise.steps)
    return with_names(system, names.found)


def numbers_compared(*rules: Production) -> set[Value]:
    """The numbers in the conditions of productions."""
    conditions = [rule.condition for rule in rules if rule.condition is not None]
    return {part.value for condition in conditions for part in walk(condition) if isinstance(part, Number)}


def bounds_of(*rules: Production) -> list[Value]:
    """The bounds of conditions, and numbers between them.

    >>> rules = read("axiom: A(0)\\nA(x) : x < 1 -> A(x + 1)\\nA(x) : x < 4 -> B").productions
    >>> [*map(str, bounds_of(*rules))]
    ['1', '4', '5/2']
    """
    bounds = sorted(numbers_compared(*rules))
    return [*bounds, *(normalised(Fraction(a + b) / 2) for a, b in pairwise(bounds))]


def joined_names(exercise: Exercise, mine: SystemAnswer) -> Mapping[str, str]:
    """Names without a production that are letters of the question written together, each with these letters."""
    known = [each for each in symbols(solution_front(exercise)) if each[:1].isalpha()]
    letters = "|".join(map(re.escape, sorted(known, key=len, reverse=True)))
    replaced = {module.symbol for rule in mine.front.productions for module in rule.predecessors}
    own = [each for each in symbols(mine.own) if each not in known and each not in replaced]
    return {name: " ".join(re.findall(letters, name)) for name in own if letters and re.fullmatch(f"(?:{letters})+", name)}


def names_in_other_case(exercise: Exercise, mine: SystemAnswer) -> Mapping[str, str]:
    """Names that the question has in capital letters for small ones, or the other way round, with its own."""
    known = symbols(solution_front(exercise))
    if exercise.names != "fixed" and not exercise.given:
        return {}
    others = (each for each in symbols(mine.own) if each not in known and each not in ("F", "f"))
    return {each: each.swapcase() for each in others if each.swapcase() in known}


# As it was typed


_AXIOM_LINE = re.compile(r"^[ \t]*(axiom|omega|ω)[ \t]*:", re.IGNORECASE | re.MULTILINE)
"""An answer with an axiom of its own is the whole system."""
_ARROW = re.compile(r"->|→")
_ARROWS = re.compile(rf"{ARROW}|\\to\b|\\rightarrow")
_SETTING = re.compile(r"^[^\n=]*(?::|(?<![<>=!])=(?!=))", re.MULTILINE)
MOST_QUOTED = 200
"""How many characters of a production a reply quotes."""


def _read(exercise: Exercise, answer: object) -> SystemAnswer:
    if isinstance(answer, LSystem):
        return whole(answer)
    text = text_answer(answer, reply("system.what"), '"axiom: a"').strip()
    if not exercise.given and _is_without_axiom(text):
        raise ModelValueError(reply("system.no_axiom"), hint=reply("system.no_axiom_hint"))
    if not _ARROWS.search(text) and (turned := _TURNED_ARROW.search(text)):
        raise ModelSyntaxError(reply("system.turned_arrow"), text, *turned.span(1), hint=reply("system.form"))
    _refuse_part_of_production(exercise, text)
    if condition := _NO_CONDITION_HERE.search(text):
        said = reply("system.no_condition_here")
        raise ModelSyntaxError(said, text, *condition.span(1), hint=reply("system.form_with_condition"))
    try:
        found = _read_typed(exercise, text)
    except LSystemError as mistake:
        _refuse_equals(exercise, text)
        _refuse_slip_of_writing(text, mistake)
        _refuse_without_colon(text)
        raise
    if _is_as_typed(found.own.source, text):
        own = replace(found.own, source=text + (found.own.source or "")[len(text) :])
        found = whole(own) if found.front is found.own else replace(found, own=own)
    if "".join(module.symbol for module in found.own.axiom).lower().startswith("axiom"):
        _refuse_without_colon(text)
    return found


_COMMA_WITHIN = re.compile(r"(?<=\d),(?=\d)")
"""A decimal comma, where the question has no module with two values."""


def _is_as_typed(read: str | None, typed: str) -> bool:
    """Whether every character of what was read stands in its place, but for marks such as commas, so that it may be quoted."""
    beginning = (read or "")[: len(typed)]
    pairs = zip(beginning, typed, strict=False)
    return len(beginning) == len(typed) and all(a == b or not (a.isalnum() or b.isalnum()) for a, b in pairs)


def _read_typed(exercise: Exercise, text: str) -> SystemAnswer:
    if not re.search(r"\([^()]*,", f"{exercise.given}\n{exercise.solution}"):
        text = _COMMA_WITHIN.sub(".", text)
    return read_typed(text, lambda typed: _read_text(exercise, typed), f"{exercise.given}\n{exercise.solution}")


def _refuse_part_of_production(exercise: Exercise, text: str) -> None:
    """Refuse what is no production, but part of one, and say what it is."""
    if _ARROWS.search(text) or _SETTING.search(text):
        return
    what = ""
    with suppress(LSystemError):
        formula = read_expression(formula_text(text))
        what = (
            "condition_alone" if expression_type(formula) == "truth" else "number_alone" if isinstance(formula, Number) else ""
        )
    with suppress(LSystemError):
        known = symbols(solution_front(exercise))
        if not what and all(module.symbol in known for module in read_word(text, "abop", solution_front(exercise))):
            what = "word_alone"
    if what:
        hint = reply("system.form_with_condition" if "condition" in what else "system.form")
        raise ModelValueError(reply(f"system.{what}", text=quoted(text)), hint=hint)


def _is_without_axiom(text: str) -> bool:
    """Whether a text has productions alone: a reader would take the first letter for the axiom, which nobody has said."""
    lines = [line for line in re.split(r"[;\n]", text) if line.strip()]
    return bool(lines) and "axiom" not in text.lower() and "ω" not in text and all(map(_ARROWS.search, lines))


_NO_COLON = re.compile(r"^[ \t]*(axiom)[ \t]+(?![:=])[^\s:=]", re.IGNORECASE | re.MULTILINE)
_EQUALS = re.compile(
    r"^(?![^\n]*(?:->|→))[ \t]*+(?:[A-Za-z]\w*+[ \t]*+<[ \t]*+)?([A-Za-z]\w*+)(?:\([^()\n]*+\))?"
    r"(?:[ \t]*+>[ \t]*+[A-Za-z]\w*+)?[ \t]*+(=)(?![=>])",
    re.MULTILINE,
)
"""A production with = for its arrow."""
_NO_ARROW = re.compile(
    r"^[ \t]*[A-Za-z]\w*[ \t]*(?:\([^()\n]*\)[ \t]*)?(-[ \t]+>|(?<![-=])>(?=[ \t]*[^\n>=]*$)|-(?=[ \t]))(?![^\n]*(?:->|→))",
    re.MULTILINE,
)
_ALONE = re.compile(r"^(?>[^\n]*?(?:->|→))[^\n]*+\n[ \t]*+([A-Za-z]\w*+)[ \t]*+$", re.MULTILINE)
_NO_MODULE = re.compile(
    r"^[ \t]*(?:[A-Za-z]\w*[ \t]*(?:[<>]=|==|!=|≤|≥|≠)[^\n:]*?|[A-Za-z]\w*[ \t]*[<>][ \t]*[\d.]+[ \t]*)(?=->|→)", re.MULTILINE
)
_NO_CONDITION_HERE = re.compile(
    r"^[ \t]*+[A-Za-z]\w*+[ \t]*+\([^()\n]*+\)[ \t]*+((?:[<>=!]?=|[<>])[ \t]*+[-+\d.]++)[ \t]*+(?=->|→)", re.MULTILINE
)
_TURNED = re.compile(r"=[<>](?!=)")
_TURNED_ARROW = re.compile(r"(?<=[\w)\]])[ \t]*+(<-++|[←⟵⇐])(?=[ \t]*+[A-Za-z])")
_FACTOR = re.compile(r"(?:->|→)[ \t]*(\d+[ \t]*\*[ \t]*[A-Za-z]\w*)")
"""Slips of writing: an axiom without a colon, an arrow in pieces, a line without one, a condition without its module or without
its colon, => for >=, a factor before a module."""


def _turned_comparison(text: str) -> tuple[int, int] | None:
    """Where a comparison is written the wrong way round, between a colon and the arrow of a line.

    >>> _turned_comparison("M(s) : s => 6 -> M(3)")
    (9, 11)
    """
    start = 0
    for line in text.split("\n"):
        colon = line.find(":")
        arrow = max(line.rfind("->"), line.rfind("→"))
        if 0 <= colon < arrow and (found := _TURNED.search(line, colon, arrow)):
            return start + found.start(), start + found.end()
        start += len(line) + 1
    return None


def _refuse_equals(exercise: Exercise, text: str) -> None:
    """Refuse a line with = for its arrow, behind a symbol of the question."""
    known = symbols(solution_front(exercise))
    for found in _EQUALS.finditer(text):
        if found[1] in known:
            raise ModelSyntaxError(reply("system.equals"), text, *found.span(2), hint=reply("system.form"))


def _refuse_slip_of_writing(text: str, mistake: LSystemError) -> None:
    """Show a slip of writing, where a reader could not make sense of another line."""
    if not _ARROWS.search(text):
        return
    if turned := _turned_comparison(text):
        raise ModelSyntaxError(reply("expression.comparison"), text, *turned)
    if condition := _NO_MODULE.search(text):
        raise ModelSyntaxError(reply("system.no_module"), text, *condition.span(), hint=reply("system.form_with_condition"))
    for pattern, name in ((_NO_ARROW, "no_arrow"), (_ALONE, "line_alone"), (_FACTOR, "factor")):
        found = pattern.search(text)
        if found and (name == "factor" or f"(line {text.count(chr(10), 0, found.start(1)) + 1}," not in str(mistake)):
            raise ModelSyntaxError(reply(f"system.{name}"), text, found.start(1), found.end(1))


def _refuse_without_colon(text: str) -> None:
    """Refuse a text in which the colon behind "axiom" is missing."""
    if found := _NO_COLON.search(text):
        raise ModelSyntaxError(reply("system.no_colon"), text, found.start(1), found.end(1))


def _read_text(exercise: Exercise, text: str) -> SystemAnswer:
    if not exercise.given or _AXIOM_LINE.search(text):
        return whole(read(text))
    given = system_of(exercise.given)
    with suppress(LSystemError):  # in another notation
        found = read(text)
        if re.search("axiom|omega|ω", text, re.IGNORECASE):
            return whole(found)
        if found.notation != given.notation or not _ARROW.search(
            text
        ):  # a rule alone is read with its first letter as its axiom
            return completed(exercise, replace(given, productions=found.productions, source=found.source))
    together = read(f"{text}\n{exercise.given}")
    own = [rule for rule in together.productions if rule.at and rule.at[1] <= len(text) and rule not in given.productions]
    if not own:
        raise ModelValueError(reply("system.not_given"), hint=reply("system.form"))
    return completed(exercise, replace(together, productions=tuple(own)))


def whole(system: LSystem) -> SystemAnswer:
    return SystemAnswer(system, system, system)


# What to say


def _difference(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> Difference:
    joined = joined_names(exercise, mine)
    if joined:
        name, letters = next(iter(joined.items()))
        own, right = ({rule.predecessor.symbol for rule in each.front.productions} for each in (mine, wanted))
        return Difference(reply("system.joined", name=name, letters=letters), explains=right <= own)
    behind = parting(exercise, mine.behind, wanted.behind)
    front = parting(exercise, mine.front, wanted.behind) if mine.front is not mine.behind else behind
    likeness, near = _likeness(exercise, mine, wanted)
    if front is None and behind is None:
        return _difference_in_writing(mine)
    if behind is None and front is not None:
        module = _applied_too(front, mine.front)
        said = "not_by_itself" if any(rule.predecessor.arguments for rule in mine.own.productions) else "given_already"
        return Difference(reply(f"system.{said}", module=module), likeness * 0.9, near)
    found = behind or front
    assert found is not None
    return Difference(_in_words(found, mine, mine.behind if behind else mine.front, wanted.behind), likeness, near)


def _difference_in_writing(mine: SystemAnswer) -> Difference:
    never = unused(mine.own)
    if never is None:
        return Difference(reply("system.angle"), 1, True)
    return Difference(reply("system.never_used") + _typed(never, mine), 1, True, explains=True)


def _applied_too(found: Parting, system: LSystem) -> str:
    """A module to which a production applies that should not, or the axiom."""
    module = found.module
    if module is None and found.step == 0:
        return reply("system.the_axiom")
    if module is None:
        derivation = derive(system, found.step)
        parents, before = derivation.origins(found.step).parents, derivation[found.step - 1]
        module = before[parents[found.position] if found.position < len(parents) else len(before) - 1]
    return reply("system.module", module=module)


def _in_words(found: Parting, mine: SystemAnswer, system: LSystem, wanted: LSystem) -> str:
    besides = " " + reply("system.with", setting=found.setting) if found.setting else ""
    so_far = reply("system.up_to_step", step=found.step - 1) + " " if found.step > 1 and not besides else ""
    if found.module is not None:
        cause = _decomposition_for(found.module, mine, system, wanted) or _production_for(found.module, mine, system)
        return f"{so_far}{reply('system.becomes', module=found.module, besides=besides)} {cause}".strip()
    if found.step == 0:
        return reply("system.axiom")
    if besides:
        return reply("system.another_start", step=found.step, position=found.position + 1, besides=besides)
    derivation = derive(system, found.step)
    origins = derivation.origins(found.step)
    if found.position >= len(origins.parents):
        return so_far + reply("system.ends", step=found.step, position=found.position)
    production = origins.productions[found.position]
    have, mother = derivation[found.step][found.position], derivation[found.step - 1][origins.parents[found.position]]
    where = {"step": found.step, "position": found.position + 1, "module": have, "mother": mother}
    if production is None:
        return so_far + reply("system.stays", **where)
    return so_far + reply("system.production", **where) + _typed(system.productions[production], mine)


def _decomposition_for(module: Module, mine: SystemAnswer, system: LSystem, wanted: LSystem) -> str:
    """What is said where the production for a module is right, and the decomposition of what it makes is not."""
    if not (wanted.decomposition or system.decomposition):
        return ""
    one, other = (derive(replace(beginning_with(each, [module]), decomposition=()), 1)[1] for each in (system, wanted))
    if tuple(one) != tuple(other):
        return ""
    if not system.decomposition:
        return reply("system.no_decomposition")
    if len(system.decomposition) > 1:
        return reply("system.decompositions")
    return reply("system.decomposition") + _typed(system.decomposition[0], mine)


def _production_for(module: Module, mine: SystemAnswer, system: LSystem) -> str:
    states = States(system)
    state = states.number(module.symbol, module.arguments)
    number = states.production(state) if states.is_d0l(state) else None
    if number is None:
        return reply("system.no_production") if states.is_d0l(state) else ""
    return reply("system.this_production") + _typed(system.productions[number], mine)


def _typed(rule: Production, mine: SystemAnswer) -> str:
    return typed_rule(rule, mine.own)


def typed_rule(rule: Production, system: LSystem) -> str:
    """A production as it was typed, as a quoted line; as the kit writes it, where it was not typed."""
    source = system.source
    own = next((found for found in system.rules if found == rule and found.at), None)
    text = source[own.at[0] : own.at[1]] if own and own.at and source and own.at[1] <= len(source) else str(rule)
    line = " ".join(text.split())
    return f"\n  {line if len(line) <= MOST_QUOTED else f'{line[:MOST_QUOTED]}...'}"


def _likeness(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> tuple[float, bool]:
    """How many of the modules that the solution's own productions rewrite become what they should; whether all but one."""
    names = renaming(exercise, wanted.behind)
    try:
        axiom = names.first_difference(derive(mine.behind, 0)[0], derive(wanted.behind, 0)[0]) is None
        own = {rule.predecessor.symbol for rule in wanted.own.productions}
        modules = [module for module in asked_modules(exercise, wanted.behind) if module.symbol in own]
        wrong = set(wrongly_replaced(exercise, mine.behind, wanted.behind, names))
    except LSystemError:
        return 0, False
    wrong_ones = [module.symbol for module in modules if names.own(module) in wrong]
    near = len({module.symbol for module in modules}) > 2 and len({*wrong_ones}) + (not axiom) == 1
    return (len(modules) + axiom - len(wrong_ones)) / (len(modules) + 1), near


def _honest(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> bool:
    """Half as many productions as the solution has, of what the question is about; or all, in other names; or a test passed."""
    known, rules = set(symbols(wanted.behind)), mine.own.productions
    useful = [rule for rule in rules if rule.predecessor.symbol in known or exercise.names == "any"]
    own, right = (sorted(len(rule.successor) for rule in each.own.productions) for each in (mine, wanted))
    is_enough = 2 * len(useful) >= len(right) or (own == right and sum(right) > len(right) > 1)
    if not rules:  # the axiom alone, where it is asked for
        return "axiom: ..." in exercise.template and mine.own.axiom == wanted.own.axiom
    return is_enough or tests_passed(exercise, mine, wanted)[0] > 0


def _praise(exercise: Exercise, mine: SystemAnswer, wanted: SystemAnswer) -> str:
    said = "chance" if States(wanted.front).traits.stochastic else "agree"
    idle = next((each.subject["rule"] for each in warnings(mine.front) if each.code == "never matches"), None)
    more = (
        f" {reply('system.idle')}{_typed(idle, mine)}" if isinstance(idle, Production) and idle in mine.own.productions else ""
    )
    return reply(f"system.{said}", last=exercise.steps) + more


SYSTEM = AnswerKind(_read, _difference, same, _honest, _praise, alike, tests_passed)
