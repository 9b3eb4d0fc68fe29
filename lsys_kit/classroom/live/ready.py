"""Whatever starts workers imports this: what panels, replies and drawings need is loaded once; forked workers find it there."""

from __future__ import annotations

from lsys_kit.classroom.live.answers import answer

_ALGA = "axiom: a\na -> ab\nb -> a"
for _asked in (
    {"kind": "rules", "text": _ALGA, "panel": {"notation": "abop", "text": _ALGA}},
    {"kind": "check", "id": "1.1", "answer": "al"},
    {"kind": "plant", "text": "axiom: F\nF -> F[+F]F\nsteps: 2"},
):
    answer(_asked)
