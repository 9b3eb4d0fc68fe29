"""What can be seen of a model before it runs: what is never applied or answered, endless decomposition, and what its text says
and its author hardly meant, as comments that are read as modules, or decimals with a comma."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from graphlib import CycleError, TopologicalSorter
from itertools import groupby, islice, pairwise

from lsys_kit.notation.analysis.problems import Problem, problem
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import Expression, Name, Number, function_of, is_random, names_in
from lsys_kit.notation.model.modules import END, Item, Pattern, flat, joined
from lsys_kit.notation.model.system import LSystem, Production

_ModuleKind = tuple[str, int]
"""A symbol and a number of parameters: what a module is to the rules."""
_DRAWN_EITHER_WAY = frozenset(("F", "f", "G", "g"))
"""Commands that make sense with a value and without."""
_DEEP = 10
"""So often interpretation rules may be applied, where they lead to themselves, in an example."""


def _kind(module: Pattern) -> _ModuleKind:
    return module.symbol, len(module.arguments)


def warnings(system: LSystem) -> list[Problem]:
    """What is possible in a model and probably not meant.

    >>> from lsys_kit.notation.read import read
    >>> [problem.code for problem in warnings(read("axiom: M(1)\\nM(t,p) -> M(t+p)"))]
    ['never matches']
    >>> read("axiom: A\\nA -> B\\nA -> C").notes
    ('Production 2, for A, is never applied: production 1 comes before it and matches every A.',)
    """
    reachable = _reachable_kinds(system)
    return [
        *_unmatched(system, reachable),
        *_overtaken(system.productions, system, "production"),
        *_overtaken(system.decomposition, system, "decomposition rule"),
        *_without_probability(system),
        *_other_arities(system, reachable),
        *_several_replaced(system),
        *_final_signs(system),
        *_in_quotation_marks(system),
        *_unanswered(system, reachable),
        *_passed_over(system),
        *_timed(system),
        *_drawn_no_further(system, reachable),
        *_drawn_as_itself(system),
        *slips(system),
    ]


def _reachable_kinds(system: LSystem) -> set[_ModuleKind]:
    """The kinds of modules that can occur in words: those of the axiom, and what rules make of what can occur."""
    rules = [(rule.parameters, rule.successor) for rule in (*system.productions, *system.decomposition)]
    rules += [(rule.predecessors, rule.successor) for rule in system.meta]
    missing = [{_kind(module) for module in needed if module.symbol != END} for needed, _ in rules]
    waiting: dict[_ModuleKind, list[int]] = {}
    for number, kinds in enumerate(missing):
        for kind in kinds:
            waiting.setdefault(kind, []).append(number)
    reached = {_kind(module) for module in flat(system.axiom)}
    todo = list(reached)
    while todo:
        kind = todo.pop()
        for number in waiting.get(kind, ()):
            missing[number].discard(kind)
            if not missing[number]:
                new = {_kind(module) for module in flat(rules[number][1])} - reached
                reached |= new
                todo += new
    return reached


def _unmatched(system: LSystem, reachable: set[_ModuleKind]) -> Iterator[Problem]:
    """The rules that can never match, because a module that they need never occurs; perhaps its case is wrong."""
    symbols = {symbol for symbol, _ in reachable}
    for rule in (*system.productions, *system.decomposition):
        needed = *rule.predecessors, *rule.left, *rule.right
        missing = next((module for module in needed if _kind(module) not in reachable and module.symbol != END), None)
        if missing is not None:
            other = missing.symbol.swapcase()
            yield Problem(
                "never matches",
                rule.at,
                {"rule": rule, "missing": _described(missing, symbols)},
                other if other in symbols and missing.symbol not in symbols else None,
            )


def _passed_over(system: LSystem) -> Iterator[Problem]:
    """The productions whose contexts name what contexts pass over."""
    for rule in system.productions:
        seen = (module.symbol for module in (*rule.left, *rule.right) if module.symbol not in ("[", "]", "(", ")", END))
        passed = next(
            (symbol for symbol in seen if symbol in system.ignored or (system.considered and symbol not in system.considered)),
            None,
        )
        if passed:
            yield Problem("context passed over", rule.at, {"rule": rule, "symbol": passed})


def _without_probability(system: LSystem) -> Iterator[Problem]:
    """The productions without a probability beside others, for the same modules, that have one."""
    random = {_kind(rule.predecessor) for rule in system.productions if rule.probability is not None}
    first: dict[_ModuleKind, bool] = {}
    for number, rule in enumerate(system.productions, 1):
        comes_later = first.setdefault(_kind(rule.predecessor), rule.probability is not None)
        if rule.probability is None and comes_later and _kind(rule.predecessor) in random:
            yield Problem("no probability", rule.at, {"number": number, "rule": rule})


def _other_arities(system: LSystem, reachable: set[_ModuleKind]) -> Iterator[Problem]:
    """The modules that no production rewrites, because they have another number of values than those that it is for."""
    rewritten = {_kind(module) for rule in (*system.productions, *system.decomposition) for module in rule.predecessors}
    for symbol, count in sorted(reachable - rewritten):
        others = sorted(other for name, other in rewritten & reachable if name == symbol)
        if others and symbol.isalpha() and symbol not in _DRAWN_EITHER_WAY:
            yield Problem("other number of values", None, {"symbol": symbol, "count": count, "others": others[0]})


def _several_replaced(system: LSystem) -> Iterator[Problem]:
    """The productions whose strict predecessor has several modules: a context may have been meant."""
    numbers = [number for number, rule in enumerate(system.productions, 1) if len(rule.predecessors) > 1]
    if numbers:
        rule, others = system.productions[numbers[0] - 1], f"; so are those of {len(numbers) - 1} other productions"
        yield Problem(
            "several replaced",
            rule.at,
            {
                "number": numbers[0],
                "rule": rule,
                "count": len(rule.predecessors),
                "others": others * (len(numbers) > 2) or "; so are those of another production" * (len(numbers) == 2),
            },
        )


def _without_last_signs(modules: list[Pattern]) -> list[Pattern]:
    """The modules before the last one, and before those like it: "..." are several."""
    end = len(modules) - 1
    while end > 0 and modules[end - 1].symbol == modules[-1].symbol == ".":
        end -= 1
    return modules[:end]


def _final_signs(system: LSystem) -> Iterator[Problem]:
    """
    The successors that end in a sign as a sentence or a statement does; it is a command of the turtle.

    A system that has the sign in another place, or as a whole successor, uses it as a command.
    """
    successors = [(rule, [*flat(rule.successor)]) for rule in (system.rules if system.turtle == "abop" else ())]
    meant = {module.symbol for _, modules in successors for module in _without_last_signs(modules) or modules}
    for rule, modules in successors:
        last = modules[-1].symbol if modules and not modules[-1].arguments else ""
        if last not in meant and (last == ";" or (last == "." and all(module.symbol != "{" for module in modules))):
            yield Problem("final sign", rule.at, {"sign": last, "rule": rule})


def _in_quotation_marks(system: LSystem) -> Iterator[Problem]:
    """A word between apostrophes that has no others: the turtle takes them for changes of its colour."""
    words = [system.axiom, *(rule.successor for rule in system.rules)] if system.turtle == "abop" else []
    for word in words:
        signs = [module.symbol for module in flat(word)]
        if len(signs) > 2 and signs.count("'") == 2 and signs[0] == signs[-1] == "'":
            yield Problem("in quotation marks", None, {"word": "".join(signs[1:-1])})
            return


def _unanswered(system: LSystem, reachable: set[_ModuleKind]) -> Iterator[Problem]:
    """Queries that nothing answers: there is no field."""
    if system.field is None and any(symbol == "?E" and count for symbol, count in reachable):
        yield Problem("unanswered query", None, {"symbol": "?E"})


def _timed(system: LSystem) -> Iterator[Problem]:
    """Productions of a timed system, which no step applies: each asks for an age, and no module of the axiom has it."""
    constants = _values_of_constants(system)
    rules = [rule for rule in system.productions if constants is not None and _asks_age(rule, constants)]
    if rules and len(rules) == len(system.productions) and not system.decomposition:
        ages = {
            (_kind(module), _number(module.arguments[0], constants or {})) for module in flat(system.axiom) if module.arguments
        }
        asked = {(_kind(rule.predecessor), _number(rule.predecessor.arguments[0], constants or {})) for rule in rules}
        if not ages & asked and None not in {age for _, age in ages | asked}:
            yield Problem("only in time", rules[0].at, {"rule": rules[0]})


def _drawn_no_further(system: LSystem, reachable: set[_ModuleKind]) -> Iterator[Problem]:
    """The first module that stays in a drawing as an interpretation rule made it, though it has a rule too; where such rules
    lead to themselves, this is told only where no depth is set."""
    made = _drawn_as(system)
    applied = {kind: 1 for kind in made if kind in reachable}
    needed = _DEEP
    with suppress(CycleError):
        for kind in reversed([*TopologicalSorter(made).static_order()]):
            for other in made[kind] if kind in applied else ():
                applied[other] = max(applied.get(other, 0), applied[kind] + 1)
        needed = max(applied.values(), default=0)
    for rule in system.interpretation if 0 < system.depth < needed else ():
        own = _kind(rule.predecessor)
        found = next((kind for kind in made[own] if kind in map(_kind, flat(rule.successor))), None)
        if found and applied.get(own) == system.depth:
            often = "once" if system.depth == 1 else f"{system.depth} times"
            yield Problem("drawn no further", rule.at, {"rule": rule, "made": found[0], "often": often, "needed": needed})
            return


def _drawn_as(system: LSystem) -> dict[_ModuleKind, dict[_ModuleKind, None]]:
    """The kinds of modules with interpretation rules that other such rules make, and that are no commands of the turtle.

    What a rule makes of a module again, whatever its values are, stays as it is: "A -> @o A" is a circle at an A.
    """
    constants = {constant.name for constant in system.constants}
    ruled = {_kind(rule.predecessor) for rule in system.interpretation}
    found: dict[_ModuleKind, dict[_ModuleKind, None]] = {kind: {} for kind in ruled}
    for rule in system.interpretation:
        own = _kind(rule.predecessor)
        found[own] |= {
            kind: None
            for kind in map(_kind, flat(rule.successor))
            if kind in ruled
            and kind[0][0].isalpha()
            and kind[0] not in _DRAWN_EITHER_WAY
            and not (kind == own and _always(rule, constants))
        }
    return found


def _drawn_as_itself(system: LSystem) -> Iterator[Problem]:
    """Rules that are certain to draw a module as itself again: only the depth that is set ends them."""
    found = _certain_cycle(system.interpretation, system) if system.depth > 1 else None
    if found:
        names, rule = found
        yield Problem("drawn as itself", rule.at, {"symbol": names[0], "cycle": _shown_cycle(names), "often": system.depth})


def _asks_age(rule: Production, constants: Mapping[str, Value]) -> bool:
    """Whether all that a production asks is the first value of a module."""
    first, *others = rule.predecessor.arguments or (None,)
    free = [isinstance(argument, Name) and argument.name not in constants for argument in (first, *others)]
    return (
        first is not None
        and not free[0]
        and all(free[1:])
        and len(rule.predecessors) == 1
        and not (rule.left or rule.right)
        and rule.condition is None
        and rule.probability is None
    )


def _values_of_constants(system: LSystem) -> dict[str, Value] | None:
    """The values of the declared constants; None where one has no value."""
    values: dict[str, Value] = {}
    for constant in system.constants:
        found = _number(constant.value, values)
        if found is None:
            return None
        values[constant.name] = found
    return values


def _number(expression: Expression, values: Mapping[str, Value]) -> Value | None:
    """The value of an expression; None where it has none."""
    if is_random(expression) or not names_in(expression) <= values.keys():
        return None
    try:
        found: Value = function_of(expression, {name: at for at, name in enumerate(values)})(tuple(values.values()))
    except (ArithmeticError, ValueError, TypeError):
        return None
    return found


def _overtaken(rules: Iterable[Production], system: LSystem, called: str) -> Iterator[Problem]:
    """The rules before which another always applies; none where a rule with a probability comes first."""
    constants = {constant.name for constant in system.constants}
    certain: dict[_ModuleKind, int] = {}
    random: set[_ModuleKind] = set()
    for number, rule in enumerate(rules, 1):
        kind = _kind(rule.predecessor)
        if kind in certain:
            yield Problem(
                f"{called} never applied",
                rule.at,
                {"number": number, "rule": rule, "first": certain[kind], "module": rule.predecessor},
            )
        elif rule.probability is not None:
            random.add(kind)
        elif kind not in random and not rule.left and not rule.right and _always(rule, constants):
            certain[kind] = number


def _described(module: Pattern, symbols: Iterable[str]) -> str:
    """A module's symbol, with its number of parameters where others with that symbol occur."""
    count = len(module.arguments)
    if module.symbol not in symbols:
        return module.symbol
    return f"{module.symbol} with {count} parameter{'s' * (count != 1)}" if count else f"{module.symbol} without parameters"


def check_decomposition(system: LSystem) -> None:
    """No module is certain to be decomposed into itself again; where a depth is set, it may be.

    Only rules that are certain to be applied count: the first for a module, without condition or probability.
    """
    found = _certain_cycle(system.decomposition, system) if system.decomposition_depth is None else None
    if found:
        names, rule = found
        raise problem("endless decomposition", rule.at, symbol=names[0], cycle=_shown_cycle(names))


def _certain_cycle(applied: Iterable[Production], system: LSystem) -> tuple[list[str], Production] | None:
    """The symbols of rules that are certain to lead to each other, and the first of these rules."""
    rules: dict[_ModuleKind, Production] = {}
    for rule in applied:
        rules.setdefault(_kind(rule.predecessor), rule)
    constants = {constant.name for constant in system.constants}
    certain = {kind: rule for kind, rule in rules.items() if _always(rule, constants)}
    made = {kind: {_kind(module) for module in _always_made(rule.successor)} & certain.keys() for kind, rule in certain.items()}
    try:
        TopologicalSorter(made).prepare()
    except CycleError as error:
        return _cycle(error.args[1], certain)
    return None


def _always(rule: Production, constants: Iterable[str]) -> bool:
    """Whether a rule applies to every module with its symbol and number of parameters."""
    free = all(isinstance(argument, Name) and argument.name not in constants for argument in rule.predecessor.arguments)
    return free and len(rule.predecessors) == 1 and rule.condition is None and rule.probability is None


def _always_made(items: Iterable[Item]) -> Iterator[Pattern]:
    """The modules of a successor that occur however often its parts are repeated."""
    for item in items:
        if isinstance(item, Pattern):
            yield item
        elif isinstance(item.count, Number) and item.count.value >= 1:
            yield from _always_made(item.body)


def _cycle(cycle: list[_ModuleKind], rules: Mapping[_ModuleKind, Production]) -> tuple[list[str], Production]:
    """A cycle, beginning and ending with the rule that is written first."""
    kinds = cycle[:0:-1]  # the sorter gives a cycle backwards, with one of its ends twice
    order = list(rules)
    first = min(kinds, key=order.index)
    at = kinds.index(first)
    return [symbol for symbol, _ in (*kinds[at:], *kinds[:at], first)], rules[first]


def _shown_cycle(names: list[str]) -> str:
    return " -> ".join(names if len(names) <= 8 else [*names[:4], "...", *names[-3:]])


_ALONE, _DOUBLED = frozenset("#%;"), frozenset("/-#%;")
"""How comments begin elsewhere: with one sign, or with two."""
_PROSE = re.compile(r"[A-Za-z]{3,}")
"""A word of a sentence, rather than a symbol."""
_SENTENCE = _DOUBLED | frozenset(".!',")
"""Signs that stand in sentences, too."""
_ONE_VALUE = frozenset("Ffg+-&^\\/!#;',")
"""Symbols that take one value in the commands of most turtles."""
_ANGLES = frozenset(("delta", "theta", "angle", "angle_increment", "turn"))
"""What the angle of the turns is called elsewhere."""
_DECIMAL_COMMA = re.compile(r"\(\s*(\d+)\s*,\s*(\d+)\s*\)$")


def slips(system: LSystem) -> Iterator[Problem]:
    """What is probably not meant, wherever it stands.

    >>> from lsys_kit.notation.read import read
    >>> [problem.code for problem in slips(read("axiom: A\\nA -> F(0,5) A # it grows"))]
    ['comment as modules', 'decimal comma']
    """
    yield from _comments(system)
    yield from _decimal_commas(system)
    yield from _unused_constants(system)
    yield from _conjunctions(system)
    if (said := _DIFFERENCE.search(system.source)) and system.notation == "abop":
        yield Problem("difference as angle", said.span(1), {"said": said[1]})


_CONJUNCTIONS = frozenset(("or", "and", "oder", "und"))
_DIFFERENCE = re.compile(r"^[ \t]*+angle[ \t]*+:[ \t]*+(\d++(?:\.\d++)?[ \t]*+-[ \t]*+\d++(?:\.\d++)?)[ \t]*+$", re.MULTILINE)
"""An angle that is a difference of two numbers: perhaps from one to the other."""


def _conjunctions(system: LSystem) -> Iterator[Problem]:
    """Words of a language between modules, which no rule is for."""
    known = {module.symbol for rule in system.rules for module in rule.predecessors}.union(system.alphabet)
    for word in (system.axiom, *(rule.successor for rule in system.rules)):
        for module in [*flat(word)][1:-1]:
            if module.symbol in _CONJUNCTIONS - known:
                yield Problem("conjunction as modules", module.at, {"symbol": module.symbol})
                return


def _unused_constants(system: LSystem) -> Iterator[Problem]:
    """The constants whose names stand nowhere else in the text; files beside a model of cpfg may use its macros."""
    constants = system.constants if system.notation not in ("cpfg", "mathematica") else ()
    words = Counter(re.findall(r"\w+", system.source)) if constants else Counter()
    for constant in constants:
        if words[constant.name] == 1:
            angle = constant.name.lower() in _ANGLES and "angle" not in system.source
            yield Problem(
                "angle used nowhere" if angle else "constant used nowhere",
                constant.at,
                {"name": constant.name, "value": constant.value},
            )


def _comments(system: LSystem) -> Iterator[Problem]:
    """The ends of successors that read like a comment: a sign that begins one elsewhere, and words that occur nowhere else."""
    comments = [(rule, _comment(rule.successor, system.source)) for rule in system.rules]
    if not any(comment for _, comment in comments):
        return
    said = (module.symbol for rule, comment in comments for module in islice(flat(rule.successor), _before(rule, comment)))
    known = {
        *said,
        *(module.symbol for rule in system.rules for module in rule.predecessors),
        *(module.symbol for module in system.axiom),
    }
    for rule, comment in comments:
        words = [module.symbol for module in comment if module.symbol.isalnum() and module.symbol not in known]
        if any(map(_PROSE.fullmatch, words)) and words[0] == next(m.symbol for m in comment if m.symbol.isalnum()):
            yield Problem("comment as modules", rule.at, {"said": joined(map(str, comment)), "rule": rule})


def _before(rule: Production, comment: Sequence[Pattern]) -> int:
    """How many modules of a successor stand before its comment."""
    return sum(1 for _ in flat(rule.successor)) - len(comment)


def _comment(successor: Sequence[Item], source: str) -> Sequence[Pattern]:
    """The end of a successor, from a sign that begins a comment elsewhere: in one piece, or after a blank and before a word."""
    first = next((at for at in range(len(successor), 0, -1) if not _in_sentence(successor[at - 1])), 0)
    end = [item for item in successor[first:] if isinstance(item, Pattern)]
    runs = [(sign, [at for at, _ in run]) for sign, run in groupby(enumerate(end), lambda pair: pair[1].symbol)]
    for (sign, places), (following, _) in pairwise(runs):
        start = (end[places[0]].at or (0, 0))[0]
        alone = sign in _ALONE and source[start - 1 : start].isspace()
        if (alone or (sign in _DOUBLED and len(places) > 1)) and following.isalnum():
            return end[places[0] :]
    return ()


def _in_sentence(item: Item) -> bool:
    """Whether a module may be a word or a sign of a sentence."""
    return isinstance(item, Pattern) and not item.arguments and (item.symbol.isalnum() or item.symbol in _SENTENCE)


def _decimal_commas(system: LSystem) -> Iterator[Problem]:
    """Two whole numbers as values of what has one value elsewhere: probably one number, with a point."""
    whole = [module for module in system.modules if len(module.arguments) == 2 and all(map(_is_whole, module.arguments))]
    if not whole:
        return
    single = {module.symbol for module in system.modules if len(module.arguments) == 1} | _ONE_VALUE
    pairs = {module.symbol for rule in system.rules for module in rule.parameters if len(module.arguments) == 2}
    for module in dict.fromkeys(whole):
        if module.symbol in single - pairs:
            start, end = module.at or (0, 0)
            typed = _DECIMAL_COMMA.search(system.source[start : end + 1]) or _DECIMAL_COMMA.search(str(module))
            meant = f"{module.symbol}({typed[1]}.{typed[2]})" if typed else None
            yield Problem("decimal comma", module.at, {"module": module}, meant)


def _is_whole(argument: object) -> bool:
    return isinstance(argument, Number) and isinstance(argument.value, int) and argument.value >= 0
