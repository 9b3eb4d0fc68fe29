"""Stage diagrams as answers, compared up to the names of their places."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import islice, pairwise, permutations

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import ARROW, quoted, text_answer, without_comments
from lsys_kit.derivation.petri.net import Stages
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.errors import ModelLimitError, ModelSyntaxError
from lsys_kit.notation.model.system import LSystem

MOST_TRANSITIONS = 60
"""The most transitions of a net that is compared."""
_TERMS = re.compile(r"\b(?:with probability|after|at once|if)\b.*")
_PART = re.compile(r"(?:^|(?<!\s)\s++)(?P<copies>\d*+)\s*+(?:\*\s*+)?(?P<place>[^\s+*,\d][^\s+,]*+)")
_JOINED = re.compile(r"\band\b|&", re.IGNORECASE)
_ARROW = re.compile(ARROW)
_APART = re.compile(r"[\s+,]")
_BETWEEN = re.compile(r"[\n;]|,(?=[^,;\n]*(?:->|=>|→))")
_START = re.compile(r"^\s*(?:start|tokens|axiom)\s*:\s*(?P<places>.*)$", re.IGNORECASE)


@dataclass(frozen=True)
class Firing:
    """A transition: the place that it empties, how many tokens it puts where, and its terms."""

    place: str
    made: tuple[tuple[str, int], ...]
    terms: str = ""


@dataclass(frozen=True)
class Net:
    """Transitions, and the tokens at the beginning; None where nothing is said of them."""

    firings: tuple[Firing, ...]
    start: tuple[tuple[str, int], ...] | None = field(default=None)


def net_of(found: Stages, start: bool = False) -> Net:
    """A net of the kit as lines.

    >>> from lsys_kit.notation.read import read
    >>> net_of(stages(read("axiom: a\\na -> ab\\nb -> a"))).firings[0]
    Firing(place='a', made=(('a', 1), ('b', 1)), terms='')
    """
    net = read_net(repr(found))
    marked = Counter({str(place): tokens for place, tokens in zip(found.places, found.start, strict=True) if tokens})
    return Net(net.firings, _sorted(marked)) if start else net


def read_net(text: str) -> Net:
    """A net as it is typed, a transition a line.

    >>> read_net("C -> L + 2 S\\nstart: C")
    Net(firings=(Firing(place='C', made=(('L', 1), ('S', 2)), terms=''),), start=(('C', 1),))
    >>> read_net("A-->B") == read_net("A -> B")
    True
    """
    firings: list[Firing] = []
    start: Counter[str] | None = None
    lines = [
        line for part in _BETWEEN.split(without_comments(text)) for line in _single(part) if not line.startswith("besides:")
    ]
    if len(lines) > MOST_TRANSITIONS:
        raise ModelLimitError(reply("net.too_many", most=MOST_TRANSITIONS), limit=MOST_TRANSITIONS)
    for line in lines:
        marked, arrow = _START.match(line), _ARROW.search(line)
        place = line[: arrow.start()].strip() if arrow else ""
        if marked:
            start = _counted(marked["places"].replace(",", "+"), text)
        elif arrow and place and not _APART.search(place):
            behind = line[arrow.end() :]
            terms = _TERMS.search(behind)
            made = _counted(behind[: terms.start()] if terms else behind, text)
            firings.append(Firing(place, _sorted(made), " ".join(terms[0].split()) if terms else ""))
        else:
            at = text.find(line)
            raise ModelSyntaxError(reply("net.no_transition"), text, at, at + len(line), reply("net.form"))
    return Net(tuple(firings), None if start is None else _sorted(start))


def _single(line: str) -> Iterator[str]:
    """The transitions of a line: of `A -> B -> C` two.

    >>> list(_single("A -> B -> C + D"))
    ['A -> B', 'B -> C + D']
    """
    parts = [part.strip() for part in _ARROW.split(line)]
    if len(parts) > 2 and all(part and not _APART.search(part) for part in parts[:-1]):
        yield from (f"{one} -> {other}" for one, other in pairwise(parts))
    elif line.strip():
        yield line.strip().rstrip(".")


def _counted(made: str, text: str) -> Counter[str]:
    found: Counter[str] = Counter()
    for part in re.split(r"[+,]", _JOINED.sub("+", made)) if made.strip() not in ("", "ε", "*", "nothing") else ():
        part = part.strip()
        read = list(_PART.finditer(part))
        if "".join(each[0] for each in read) != part or not read or _ARROW.search(part):
            at, form = max(text.find(part), 0), "net.named" if part.isdigit() else "net.form"
            raise ModelSyntaxError(reply("net.no_place", text=quoted(part)), text, at, at + len(part), reply(form))
        for each in read:
            if not each["place"][0].isalnum():
                place = re.escape(each["place"])
                there = re.search(rf"(?<![^\s+,]){place}(?![^\s+,])", text) or re.search(place, text)
                said = reply("net.no_name", text=quoted(each["place"]))
                raise ModelSyntaxError(said, text, *(there.span() if there else (0, 1)), reply("net.form"))
            found[each["place"]] += int(each["copies"][:6] or 1)
    return found


def _sorted(found: Counter[str]) -> tuple[tuple[str, int], ...]:
    return tuple(sorted(found.items()))


def _read(exercise: Exercise, answer: object) -> Net:
    with_start = bool(exercise.solution and _START.search(exercise.solution.splitlines()[-1]))
    if isinstance(answer, LSystem):
        answer = stages(answer)
    if isinstance(answer, Stages):
        return net_of(answer, with_start)
    return read_net(text_answer(answer, reply("net.what"), '"A -> B + 2 C"'))


def isomorphic(mine: Net, wanted: Net, fixed: Collection[str] = ()) -> bool:
    """Whether two nets are the same but for the names of their places; those that are fixed name the same place in both."""
    import networkx

    def graph(net: Net) -> networkx.DiGraph:
        found: networkx.DiGraph = networkx.DiGraph()
        tokens = dict(net.start if net.start is not None and wanted.start is not None else ())
        for place in places_of(net):
            found.add_node(place, label=("place", tokens.get(place, 0), place if place in fixed else ""))
        for number, firing in enumerate(net.firings):
            found.add_node(number, label=("transition", firing.terms))
            found.add_edge(firing.place, number, copies=1)
            for place, copies in firing.made:
                found.add_edge(number, place, copies=copies)
        return found

    return bool(
        networkx.is_isomorphic(
            graph(mine), graph(wanted), lambda a, b: a["label"] == b["label"], lambda a, b: a["copies"] == b["copies"]
        )
    )


def places_of(net: Net) -> Iterator[str]:
    """The places of a net, each as often as it is named."""
    for firing in net.firings:
        yield firing.place
        yield from (place for place, _ in firing.made)
    yield from (place for place, _ in net.start or ())


def with_places(net: Net, names: Mapping[str, str]) -> Net:
    """A net with other names for its places; places that get the same name become one.

    >>> with_places(read_net("A -> B + C"), {"B": "D", "C": "D"}).firings
    (Firing(place='A', made=(('D', 2),), terms=''),)
    """

    def renamed(made: Iterable[tuple[str, int]]) -> tuple[tuple[str, int], ...]:
        found: Counter[str] = Counter()
        for place, copies in made:
            found[names.get(place, place)] += copies
        return _sorted(found)

    firings = tuple(replace(f, place=names.get(f.place, f.place), made=renamed(f.made)) for f in net.firings)
    return Net(firings, None if net.start is None else renamed(net.start))


def _same(exercise: Exercise, mine: Net, wanted: Net) -> bool:
    return (wanted.start is None or mine.start is not None) and isomorphic(mine, wanted, exercise.symbols)


MOST_TRIED = 3_000
"""So many ways to rename are tried."""
MOST_RENAMED = 5
"""So many places of one's own names are tried under all names of the solution."""


@lru_cache(maxsize=256)
def _in_names_of(fixed: frozenset[str], mine: Net, wanted: Net) -> Net:
    """A net with its places called as in the solution, so that most transitions are the same; fixed names stay."""
    own, free = (sorted({*places_of(net)} - fixed) for net in (mine, wanted))
    if not own or own == free or max(len(own), len(free)) > MOST_RENAMED:
        return mine
    free += [f"{name} " for name in own]  # which no place of the solution is called
    renamed = (with_places(mine, dict(zip(own, names, strict=True))) for names in permutations(free, len(own)))
    asked = Counter(wanted.firings)
    return max([mine, *islice(renamed, MOST_TRIED)], key=lambda net: (Counter(net.firings) & asked).total())


def _transitions_right(exercise: Exercise, mine: Net, wanted: Net) -> tuple[int, int]:
    """How many transitions are right, up to names that are free; the tokens at the start are a part, too."""
    mine = _in_names_of(frozenset(exercise.symbols), mine, wanted)
    asked = wanted.start is not None
    right = (Counter(mine.firings) & Counter(wanted.firings)).total() + (asked and mine.start == wanted.start)
    return right, max(len(mine.firings), len(wanted.firings)) + asked


def _difference(exercise: Exercise, mine: Net, wanted: Net) -> Difference:
    right, all = _transitions_right(exercise, mine, wanted)
    likeness, near = right / all, len(wanted.firings) > 2 and right >= len(wanted.firings) - 1
    unnamed = next((place for place in exercise.symbols if place not in {*places_of(mine)}), None)
    if unnamed is not None:
        return Difference(reply("repair.net_unnamed", place=unnamed), likeness, near)
    for what, (own, asked) in {
        "places": [len({*places_of(net)}) for net in (mine, wanted)],
        "transitions": [len(net.firings) for net in (mine, wanted)],
    }.items():
        if own != asked:
            return Difference(reply(f"net.{what}_too_{'many' if own > asked else 'few'}", number=own), likeness, near)
    if wanted.start is not None and isomorphic(Net(mine.firings), Net(wanted.firings)):
        return Difference(reply("net.start"), 1, True)
    alike = zip(mine.firings, _in_names_of(frozenset(exercise.symbols), mine, wanted).firings, strict=True)
    odd = next((firing for firing, called in alike if called not in wanted.firings), mine.firings[0])
    return Difference(reply("net.transition", place=odd.place), likeness, near)


def _honest(_: Exercise, mine: Net, wanted: Net) -> bool:
    return 2 * len(mine.firings) >= len(wanted.firings)


NET = AnswerKind(_read, _difference, _same, _honest, parts_right=_transitions_right)
