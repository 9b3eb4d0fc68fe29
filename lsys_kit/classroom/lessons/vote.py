"""Voting: a question, such as that with which a lesson begins, asked again at the end.

The first time nothing says whether the choice is right. It is kept, and shown when the question comes again, together with what
was predicted in between; only then is there a reply.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from functools import cache

import traitlets

from lsys_kit.budget import current, limits
from lsys_kit.classroom.catalogue import catalogued
from lsys_kit.classroom.lessons.kept import CHANGES, answered, keep
from lsys_kit.classroom.lessons.lesson import FEWEST, LETTERS, Lesson, Option, Vote, lesson
from lsys_kit.classroom.lessons.opening import announce
from lsys_kit.classroom.lessons.predicted import predictions_of
from lsys_kit.classroom.lessons.widget import LessonWidget, boxed_html, prose_html, prose_text
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.errors import ModelNameError, ModelValueError, require, shown
from lsys_kit.files import Entries
from lsys_kit.notation.read import read
from lsys_kit.pictures.draw import AnyPicture, draw
from lsys_kit.pictures.formats.notebook import SVGPicture, svg_bundle
from lsys_kit.translation import gettext

NONE = -1
"""No option has been chosen."""
MOST_SHAPES = 6_000
"""A vote shows its picture twice: one of more shapes is one of pixels, so that pages stay small."""


def vote(
    question: str,
    options: Sequence[str] | None = None,
    right: str | None = None,
    picture: SVGPicture | None = None,
    replies: Sequence[str] | None = None,
    again: bool = False,
) -> VoteBox:
    """A question with some options, to vote for one of them: that of a lesson, or one of your own.

    Votes are kept, as are predictions and the entries of tables: in a copy of the course in its file `answers.jsonl`. Whoever
    deletes that begins anew.

    Parameters
    ----------
    question
        The number of a lesson, such as "01", or its name; or a question of your own.
    options
        Two to six options of a question of your own; for the second vote they may be left out.
    right
        The letter of the right one, or its text; where it is left out, nothing is said of what is right.
    picture
        What the question is about, as `draw` makes it.
    replies
        What is said to whoever has voted for each option in the end.
    again
        Whether this is the second vote, which shows the first one and what was predicted, and replies to the choice.

    Raises
    ------
    ModelNameError
        There is no such lesson.
    ModelValueError
        The options are not two to six different texts, or the right one is none of them.

    Examples
    --------
    >>> vote("01")
    Three programs were given the same two rules, a -> ab and b -> a, and the same first cell a. In each step all cells live \
through the same hour. One of the programs drew this picture. Which program is right?
    [steps 0 to 5; the last: 32 cells, width 64, height 1]
      A  Program 1: a, aa, aaaa. An a makes a b, and a b becomes an a, so each a becomes aa.
      B  Program 2: a, ab, abb. In each step one rule replaces one cell.
      C  Program 3: a, ab, aba. Whatever was there before the step is replaced, and nothing else.
      D  More than one of them: it depends on which rule is written first.
    >>> vote("Which is the word of step 2?", ["a", "ab", "aba"], right="C")
    Which is the word of step 2?
      A  a
      B  ab
      C  aba
    """
    require(again, bool, 'True or False for "again"')
    require(picture, (SVGPicture, type(None)), "A picture that draw has made")
    asked = question.strip() if isinstance(question, str) else ""
    if options is not None:
        _OWN[asked] = _own_vote(question, options, right, () if replies is None else replies), picture
    if options is not None or (again and asked in _OWN):
        own, drawing = _OWN[asked]
        return VoteBox(own, _ballot(f"vote {asked}", len(own.options)), again, drawing=drawing)
    found = lesson(question)
    if found.vote is None:
        raise ModelNameError(f"The lesson {found.name} has no vote", hint="Declare it under [vote] in its file.")
    box = VoteBox(found.vote, _ballot(f"{found.key} vote", len(found.vote.options)), again, found)
    announce("vote", found.key, 2 if again else 1)
    return box


_OWN: dict[str, tuple[Vote, SVGPicture | None]] = {}
"""The questions of one's own that were asked, so that the second vote need not repeat their options."""


def _own_vote(question: object, options: object, right: object, replies: object) -> Vote:
    if not isinstance(question, str) or not question.strip():
        raise ModelValueError(f'A question must be a text such as "Which is right?", not {shown(question)}')
    texts, said = _texts(options, "options", '["a", "ab", "aba"]'), _texts(replies, "replies", '["No: ...", "Yes: ..."]')
    if not FEWEST <= len(texts) <= len(LETTERS) or len({*texts}) < len(texts) or not all(texts):
        raise ModelValueError(f"A vote needs {FEWEST} to {len(LETTERS)} different options, not {shown(options)}")
    if said and len(said) != len(texts):
        raise ModelValueError(f"There are {len(texts)} options and {len(said)} replies", hint="Give one reply for each option.")
    named = right.strip() if isinstance(right, str) else None
    known = [*LETTERS[: len(texts)], *texts]
    if right is not None and named not in known:
        raise ModelValueError(
            f"The right option must be a letter up to {LETTERS[len(texts) - 1]}, or its text, not {shown(right)}"
        )
    place = None if named is None else known.index(named) % len(texts)
    return Vote(question.strip(), tuple(Option(text, "".join(said[at : at + 1]), at == place) for at, text in enumerate(texts)))


def _texts(given: object, what: str, example: str) -> list[str]:
    if isinstance(given, str) or not isinstance(given, Sequence) or not all(isinstance(each, str) for each in given):
        raise ModelValueError(f"The {what} must be a list of texts such as {example}, not {shown(given)}")
    return [each.strip() for each in given]


class Ballot(traitlets.HasTraits):
    """The two votes on one question: the numbers of the options, from 0 on."""

    first = traitlets.Int(NONE)
    second = traitlets.Int(NONE)


@cache
def _ballot(key: str, options: int) -> Ballot:
    """The votes on a question, which are kept by their letters."""
    kept = [LETTERS[:options].find(each) if each else NONE for each in answered(key)] + [NONE, NONE]
    ballot = Ballot(first=kept[0], second=kept[1])
    ballot.observe(lambda _: keep(key, [*map(_letter, votes)] if max(votes := (ballot.first, ballot.second)) > NONE else []))
    return ballot


def _letter(vote: int) -> str:
    return LETTERS[vote] if vote != NONE else ""


class VoteBox(LessonWidget):
    """The question that `vote` shows.

    Attributes
    ----------
    chosen
        The number of the option that was chosen, from 0 on, or -1.
    """

    _script_name = "voting"
    asked = traitlets.Dict().tag(sync=True)
    chosen = traitlets.Int(NONE, min=NONE, max=len(LETTERS) - 1).tag(sync=True)
    said = traitlets.Dict().tag(sync=True)

    def __init__(
        self, vote: Vote, ballot: Ballot, again: bool, of: Lesson | None = None, drawing: SVGPicture | None = None
    ) -> None:
        self._vote, self._ballot, self._again, self._of = vote, ballot, again, of
        self._picture = _picture(drawing or drawn(vote.picture))
        image = {"picture": _address(self._picture), "described": self._picture["text/plain"]} if self._picture else {}
        super().__init__(asked={"question": vote.question, "options": [each.text for each in vote.options], **image})
        traitlets.link((ballot, "second" if again else "first"), (self, "chosen"))
        ballot.observe(self._tell)
        if again:
            CHANGES.observe(self._tell)
        self._tell()

    @traitlets.validate("chosen")
    def _is_an_option(self, proposal: traitlets.Bunch) -> int:
        if proposal["value"] >= len(self._vote.options):
            raise traitlets.TraitError(f"There are {len(self._vote.options)} options")
        return int(proposal["value"])

    @property
    def page_data(self) -> Data:
        """What a page without a kernel has to know: what is asked, and what is said for each first and each second vote."""
        votes = range(NONE, len(self._vote.options))
        said = [[self._said(Ballot(first=first, second=second)) for second in votes] for first in votes]
        return {"asked": self.asked, "again": self._again, "said": said}

    def _said(self, ballot: Ballot) -> Data:
        return _reply(self._vote, ballot) if self._again else _receipt(ballot)

    def _tell(self, _: object = None) -> None:
        predicted = predictions_of(self._of) if self._again and self._of else []
        self.said = {**self._said(self._ballot), **({"predicted": predicted} if predicted else {})}

    def _stored(self) -> Data:
        options = "".join(f"<li>{prose_html(each.text)}</li>" for each in self._vote.options)
        image = self._picture.get("text/html", "")
        html = boxed_html(f"<p>{prose_html(self._vote.question)}</p>", image, f'<ol type="A">{options}</ol>')
        return {"text/html": html, "text/plain": repr(self)}

    def close(self) -> None:
        """Close the widget, and hear of no more votes."""
        self._ballot.unobserve(self._tell)
        if self._again:
            CHANGES.unobserve(self._tell)
        super().close()

    def __repr__(self) -> str:
        options = (f"  {letter}  {prose_text(each.text)}" for letter, each in zip(LETTERS, self._vote.options, strict=False))
        described = [f"[{self._picture['text/plain']}]"] if self._picture else []
        return "\n".join([prose_text(self._vote.question), *described, *options])


def drawn(choices: Entries) -> AnyPicture | None:
    """The picture of a vote, from what its lesson declares of it; None where it has none.

    >>> drawn({"system": "J1", "step": 2})
    steps 0 to 2; the last: 3 cells, width 5, height 1
    """
    if not choices:
        return None
    found: AnyPicture = draw(
        read(choices["rules"]) if "rules" in choices else catalogued(choices["system"]),
        choices.get("step"),
        **choices.get("constants", {}),
        **{name: value for name, value in choices.items() if name in ("angle", "cells", "view")},
    )
    return found


def _picture(picture: SVGPicture | AnyPicture | None) -> Data:
    if picture is None:
        return {}
    with limits(segments=min(MOST_SHAPES, current().segments)):
        return svg_bundle(picture.svg, repr(picture))


def _address(picture: Data) -> str:
    return f"data:image/svg+xml;base64,{base64.b64encode(picture['image/svg+xml'].encode()).decode()}"


def _receipt(ballot: Ballot) -> Data:
    """What is said after the first vote: nothing of what is right."""
    if ballot.first == NONE:
        return {}
    return {
        "text": gettext(
            "Your vote, {letter}, is kept. The question comes again at the end of the lesson.", letter=LETTERS[ballot.first]
        )
    }


def _reply(vote: Vote, ballot: Ballot) -> Data:
    before = (
        gettext("Your first vote was {letter}.", letter=LETTERS[ballot.first])
        if ballot.first != NONE
        else gettext("You did not vote the first time.")
    )
    if ballot.second == NONE:
        return {"before": before}
    option = vote.options[ballot.second]
    judged = {"verdict": "Right" if option.right else "Not right"} if any(each.right for each in vote.options) else {}
    return {"before": before, **judged, "text": option.reply, "changed": _change(vote, ballot)}


def _change(vote: Vote, ballot: Ballot) -> str:
    if ballot.first == NONE:
        return ""
    if ballot.first == ballot.second:
        return gettext("You voted the same way the first time.")
    back = gettext("You were right the first time.") if vote.options[ballot.first].right else ""
    changed = gettext(
        "You have changed your vote from {first} to {second}.", first=LETTERS[ballot.first], second=LETTERS[ballot.second]
    )
    return f"{changed} {back}".rstrip()
