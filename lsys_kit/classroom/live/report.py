"""What a class has said, after class: a page to read, and a table of comma-separated values.

Both show numbers of answers; of a phone they show nothing but which of its answers were given by the same one.
"""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from lsys_kit.classroom.exercises.collecting import cell
from lsys_kit.classroom.lessons.lesson import LETTERS, lesson
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.classroom.live.events import FILE, ClassEntry, Events
from lsys_kit.classroom.live.game import made_by, outcome
from lsys_kit.classroom.live.questions import (
    EXERCISE,
    PREDICTION,
    TABLE,
    VOTE,
    question,
    replies,
    right_cells,
    right_option,
    table_of,
)
from lsys_kit.classroom.live.session import GAME, Asked, Said, Session
from lsys_kit.classroom.panel.bundle import style
from lsys_kit.classroom.panel.document import document
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.files import KIT_MARK, file_stem, save_file
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import gettext, language, ngettext

HEAD = ("question", "kind", "round", "answer", "number", "right", "of")
"""The columns of the table: a question, an answer to it, how many gave it, whether it is right, and how many answered. They are
called so in every language, for programs that read the table."""
FEW, MANY = 0.3, 0.7
"""Below and above these shares of right answers a vote is not worth a discussion (peer instruction: E. Mazur, 1997)."""


def write_reports(folder: str | Path) -> list[Path]:
    """Write a page and a table for each class of a folder, into the folder; where they are.

    Raises
    ------
    ModelFileError
        No class is kept in the folder, or the files cannot be written.
    """
    folder = Path(folder)
    if not (folder / FILE).is_file():
        raise ModelFileError(f'No class is kept in "{quotable(str(folder))}"', hint="lsys-kit class --folder FOLDER opens one.")
    events = Events(folder)
    written = []
    try:
        for entry in events.classes():
            session = Session(events.of(entry.code))
            stem = folder / f"report-{file_stem(entry.name, 'class', '')}-{entry.code}"
            for ending, content in ((".html", report_page(entry, session).encode()), (".csv", report_table(session).encode())):
                save_file(stem.with_name(stem.name + ending), content)
                written.append(stem.with_name(stem.name + ending))
    finally:
        events.close()
    return written


_Row: TypeAlias = tuple[str, str, int, str, int, str, int]
"""The question, its kind and its round; an answer, how often it was given, whether it is right, and how many answered."""


def rows_of(session: Session) -> Iterator[_Row]:
    """The rows of the table, question by question."""
    for asked in sorted(session.answers):
        said = session.values(asked)
        try:
            yield from _ROWS[asked.kind](session, asked, said)
        except LSystemError:  # a question that this version of the kit does not have any more
            yield (asked.about, asked.kind, asked.round, gettext("(no longer in the kit)"), len(said), "", len(said))


def _votes(session: Session, asked: Asked, said: Said) -> Iterator[_Row]:
    counts, right = Counter(said.values()), right_option(asked.about)
    for place, letter in enumerate(LETTERS[: len(replies(asked.about))]):
        yield (asked.about, VOTE, asked.round, letter, counts[place], "yes" if place == right else "no", len(said))


def _predictions(session: Session, asked: Asked, said: Said) -> Iterator[_Row]:
    marked = session.marked.get(asked.about, set())
    for text, count in Counter(said.values()).most_common():
        yield (asked.about, PREDICTION, asked.round, text, count, "yes" if text in marked else "", len(said))


def _tables(session: Session, asked: Asked, said: Said) -> Iterator[_Row]:
    table = table_of(question(TABLE, asked.about))
    marks = [right_cells(table, entries) for entries in said.values()]
    for place, (row, column, _) in enumerate(table.blanks):
        name = f"{prose_text(str(table.rows[row][0]))}: {prose_text(table.columns[column])}"
        for right, word in ((True, "yes"), (False, "no")):
            yield (asked.about, TABLE, asked.round, name, sum(mark[place] is right for mark in marks), word, len(said))


def _exercises(session: Session, asked: Asked, said: Said) -> Iterator[_Row]:
    counts = Counter((each["said"], each["message"] if each["said"] != "Correct" else "") for each in said.values())
    for (verdict, message), count in counts.most_common():
        right = "yes" if verdict == "Correct" else "no"
        yield (asked.about, EXERCISE, asked.round, f"{gettext(verdict)}. {message}".strip(), count, right, len(said))


def _games(session: Session, asked: Asked, said: Said) -> Iterator[_Row]:
    game = session.game(asked.about)
    found = outcome(game.turns[asked.round - 1], made_by(game.turns[asked.round - 1], session.chosen(asked)))
    right = "yes" if found["parts"] is None else "no"
    yield (f"{asked.about}: {game.title}", GAME, asked.round, found["word"], len(said), right, len(said))


_Rows: TypeAlias = Callable[[Session, Asked, Said], Iterator[_Row]]
_ROWS: Mapping[str, _Rows] = {VOTE: _votes, PREDICTION: _predictions, TABLE: _tables, EXERCISE: _exercises, GAME: _games}


def report_table(session: Session) -> str:
    """The table; no text in it is a formula for a spreadsheet.

    >>> report_table(Session())
    'question,kind,round,answer,number,right,of,lsys-kit\\n'
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([*HEAD, KIT_MARK.decode()])
    for row in rows_of(session):
        writer.writerow([cell(each) if isinstance(each, str) else each for each in row])
    return out.getvalue()


def report_page(entry: ClassEntry, session: Session) -> str:
    """The page: the votes with their gains, predictions, tables, exercises and games."""
    parts = [
        f"<h1>{escaped(entry.name)}</h1>",
        _paragraph(_took_part(len(session.phones)), gettext("Their numbers are random, and no name is kept.")),
        *_vote_parts(session),
        *_list_part(gettext("Predictions"), session, PREDICTION),
        *_list_part(gettext("Tables"), session, TABLE),
        *_list_part(gettext("Exercises"), session, EXERCISE),
        *_list_part(gettext("Be the cell"), session, GAME),
    ]
    if session.plants:
        many = len(session.plants)
        plants = ngettext("{number} plant was sent to the wall.", "{number} plants were sent to the wall.", many)
        parts += [f"<h2>{escaped(gettext('The wall'))}</h2>", _paragraph(plants)]
    body = f'<main class="report">{"".join(parts)}</main>\n'
    return document(entry.name, body, style("live"), gettext("What {name} has said", name=entry.name), language=language())


def _took_part(many: int) -> str:
    return ngettext("{number} phone took part.", "{number} phones took part.", many)


def _paragraph(*sentences: str) -> str:
    return f"<p>{escaped(' '.join(filter(None, sentences)))}</p>"


def _vote_parts(session: Session) -> Iterator[str]:
    numbers = sorted({asked.about for asked in session.answers if asked.kind == VOTE})
    if numbers:
        yield f"<h2>{escaped(gettext('Votes'))}</h2>"
    for number in numbers:
        first, second = (session.votes(number, round) for round in (1, 2))
        right, all_first = right_option(number), sum(first["bars"])
        rows = "".join(
            f'<tr><th scope="row">{letter}{" ✓" if place == right else ""}</th><td>{first["bars"][place]}</td>'
            f"<td>{second['bars'][place]}</td></tr>"
            for place, letter in enumerate(LETTERS[: len(first["bars"])])
        )
        of = lesson(number)
        title = of.title if of.number is None else gettext("Lesson {lesson}: {title}", lesson=of.number, title=of.title)
        columns = _head(gettext("answer"), gettext("first vote"), gettext("second vote"))
        yield f"<h3>{escaped(title)}</h3><table>{columns}<tbody>{rows}</tbody></table>"
        yield _paragraph(_changed(second["changes"]), _advice(first["bars"][right] / all_first) if all_first else "")


def _changed(changes: dict[str, object]) -> str:
    """How many have changed their minds, and the gain."""
    told = gettext(
        "Of {both} who voted twice {better} changed from wrong to right, and {worse} from right to wrong.",
        both=changes["both"],
        better=changes["better"],
        worse=changes["worse"],
    )
    gain = "" if changes["gain"] is None else gettext("Normalised gain: {gain}.", gain=f"{changes['gain']:.2f}")
    return f"{told} {gain}".strip()


def _advice(share: float) -> str:
    """What to do after a first vote, by the share of right answers."""
    percent = round(100 * share)
    if share < FEW:
        return gettext("{percent} % were right at first, which is few: explain it anew.", percent=percent)
    if share < MANY:
        return gettext("{percent} % were right at first: worth a discussion and a second vote.", percent=percent)
    return gettext("{percent} % were right at first, which is most: go on.", percent=percent)


def _head(*names: str) -> str:
    return f"<thead><tr>{''.join(f'<th scope=col>{escaped(each)}</th>' for each in names)}</tr></thead>"


def _list_part(title: str, session: Session, kind: str) -> Iterator[str]:
    rows: Sequence[_Row] = [row for row in rows_of(session) if row[1] == kind and row[4]]
    if not rows:
        return
    said = {"yes": gettext("yes"), "no": gettext("no"), "": ""}
    body = "".join(
        f'<tr><th scope="row">{escaped(str(row[0]))}</th><td>{escaped(_one_line(row[3]))}</td>'
        f"<td>{escaped(gettext('{number} of {all}', number=row[4], all=row[6]))}</td><td>{escaped(said[row[5]])}</td></tr>"
        for row in rows
    )
    columns = _head(gettext("question"), gettext("answer"), gettext("how many"), gettext("right"))
    yield f"<h2>{escaped(title)}</h2><table>{columns}<tbody>{body}</tbody></table>"


def _one_line(text: object) -> str:
    return " ".join(str(text).split())
