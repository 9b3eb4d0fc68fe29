"""The named parts and rules of systems in a text, wherever they stand in its lines.

    variables : X F
    start  : X
    rules  : (X → F+[[X]-X]-F[-FX]+X), (F → FF)
    angle  : 25°

Each line is cut where another part begins. What is called by a name of `fields.toml`, or has an arrow between a symbol and
a word, is a part of a system; everything else is prose around it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cache

from lsys_kit.notation.formats.found import Passage, angle_of, tables

LONGEST_LINE = 2_000
"""Longer lines are prose."""
_KINDS = "axiom", "rules", "angle", "steps", "head", "tail", "ignore", "draws", "scale", "constant", "unread", "other"
BLANKS = r"[ \t]*+"
"""The pattern of blanks within a line."""
ARROW = r"(?:[-=|]{1,3}>|→|⟶|⟼|↦|⇒|➔|➜|➝|\\(?:long)?(?:rightarrow|mapsto)\b|\\to\b|::=|:=)"
"""That of an arrow."""
_LABEL = (
    rf"(?:(?:[pPrR]|[Rr]ule|[Rr]egel)[_ ]?\d{{1,3}}{BLANKS}(?:[:.)=]|(?=\(\d?\.\d))|\(\d{{1,3}}\)"
    rf"|(?!0?\.\d)\d{{1,2}}(?:\.\d{{1,2}})*[.)]?(?=[ \t])|[pP]{BLANKS}:)"
)
_OWN = r"(?:[A-Za-z]\w{0,15}|\d|[-+](?!→))"
_SIDE = r"[^\s<>:=,;()]{1,20}(?:\([^()\n]{0,60}\))?"
_CONDITION = (
    r"(?:\{[^{}\n→]{1,100}\}|(?::(?![:=])|(?:if|when)[ \t])"
    r"(?:[^\n=→<>!{]|[<>=!]=|[<>!=](?=[^=\n]*[^-=]=(?!=)|[^=\n]*(?:->|→))){1,100}?)"
)
_HEAD = (
    rf"(?:{_SIDE}{BLANKS}<{BLANKS})?[\"']?{_OWN}[\"']?{BLANKS}(?:\([^()\n]{{0,80}}\))?"
    rf"(?:{BLANKS}>{BLANKS}{_SIDE})?(?:{BLANKS}{_CONDITION})?"
)
_HEAD_ALONE = re.compile(_HEAD)
_CHANCE = r"(?:\d{1,3}(?:\.\d+)?\s?%|0?\.\d+|\(\d{1,3}\.?\d*\s?%\)|\(?\d{1,3}/\d{1,3}\)?)"
_RULE = (
    rf"(?:(?P<label>{_LABEL}){BLANKS})?(?:(?P<first>{_CHANCE}|\(0?\.\d+\)){BLANKS}:?{BLANKS})?(?P<head>{_HEAD}){BLANKS}"
    rf"(?:(?<=[ \t])(?P<over>{_CHANCE}){BLANKS}|[-=]{{1,2}}{BLANKS}(?P<within>{_CHANCE}|\(0?\.\d+\)){BLANKS}(?=[-=]*>|→))?"
    rf"(?P<arrow>-*{ARROW}|WORDS|=(?!=)(?![ \t]*\d+(?:\.\d+)?[ \t]*(?:$|[,;:)]))(?![^\n,;]*(?:->|→)))"
)
AFTER = re.compile(
    rf"(?:(?<![ \t])[ \t]++|(?<=[^\s(]))(?::{BLANKS}(?P<plain>{_CHANCE}|\d(?:\.\d+)?)"
    rf"|[(\[]{BLANKS}(?:p{BLANKS}={BLANKS})?(?P<bracketed>{_CHANCE}){BLANKS}[)\]]"
    rf"|(?:[,:]{BLANKS}|(?<=[ \t]))(?:(?:with[ ])?(?:p|prob\.?|probability){BLANKS}(?:[:=]|of\b)?)?{BLANKS}"
    rf"(?:(?P<named>{_CHANCE})|(?:WEIGHT)[ ]?[:=]?[ ]?(?P<weight>\d{{1,4}}(?:\.\d+)?))){BLANKS}$".replace(
        "WEIGHT", "|".join(tables()["said"]["weight"])
    )
)
"""A probability behind a successor."""
BEFORE = re.compile(
    rf"\A{BLANKS}(?:[(\[]{BLANKS}(?P<bracketed>{_CHANCE}){BLANKS}[)\]]|(?P<percents>\d{{1,3}}(?:\.\d+)?\s?%)){BLANKS}:?{BLANKS}(?=\S)"
)
"""A probability between an arrow and a successor, in brackets or in percents."""
NOTHING = re.compile(r"\([a-z ]{5,}\)|empty|nothing|none|[ελΛ∅]|\*")
"""Successors that are empty."""
COMMENT = re.compile(
    r"(?<![ \t])(?:[ \t]{2,}+\(\d+(?:\.\d+)*[a-z]?\)|[ \t]++(?:#|//|%|;|←)[ \t].*"
    r"|[ \t]++\{(?=[^{}\n]*?[a-z]{3})[^{}\n]*\}|[ \t]++\((?=[^()\n]*?[a-z]{3})[^()\n]*\)[.]?)$",
    re.MULTILINE,
)
"""What is said behind a part: a comment, the number of an equation."""
_NUMBER = re.compile(r"[ \t]*+[-+]?(?:\d++(?>(?:[.,]\d++)?)|\.\d++)(?>(?:/\d++)?)(?P<rest>.*)")
_SAY = {name: "|".join(map(re.escape, tables()["said"][name])) for name in ("is", "lead")}
_LEAD = rf"(?:(?:(?i:{_SAY['lead']})|[aoAO](?=[ \t]+(?:axiom|regra|[âa]ngul)))[ \t]+|[dlDL]')"
_BOUNDARY = re.compile(
    rf"[,;|\t({{]+[ \t]*(?:{_LEAD}){{0,3}}|[ \t]{{2,}}|[.][ \t]+(?>(?:{_LEAD})?)"
    r"|(?<![:=])[ \t](?:(?:with|mit|avec|con|and|und|et)[ \t]+)?(?=[ωδ][ \t]*[=:])"
    rf"|[ \t](?:and|und|y|et|en|e(?=[ \t]+(?:\(|\w{{3}}|o[ ]|[A-Z][ ]{{0,2}}(?:→|->))))[ \t]+(?>(?:{_LEAD})?)[({{]?"
    r"|[ \t]\^[ \t]*\("
    rf"|[ \t](?P<said>{_LEAD})(?>(?:{_LEAD})?)"
    r"|:(?=[ \t])|[ \t](?=(?:axiom|rules?|angle|iterations)[ \t])"
)
_LEADING = re.compile(rf"(?:{_LEAD}){{1,3}}")
"""What stands before a name at the beginning of a line."""
_TRIPLE = re.compile(r"[A-Z][ \t]*=[ \t]*[(⟨<][ \t]*\{[^{}\n]*\}[ \t]*,(?P<axiom>[^,{}\n]+),[ \t]*(?:(?=\{)|[A-Z][ \t]*[)⟩>])")
"""An L-system as a triple of its alphabet, its axiom and its rules."""
_BULLET = re.compile(
    r"[ \t]*(?:[*•▪‣·°☀-➓🌀-🫿][ \t]+(?!<)"  # an open bullet is taken for a sign of degrees
    r"|-[ \t]+(?=[A-Za-zΑ-ωА-я\"'][^<\n]*(?:[:=→]|->))|\d{1,2}(?:\.\d{1,2})*[.)][ \t]+|(?:[a-z]|\([ivx]{1,4})\)[ \t]+)*"
)
_SIGNS_ONLY = re.compile(r"[A-Za-z0-9+\-&^\\/|\[\]{}$!'\"#~;.%@<>_?*, \t]+")
_RUN = re.compile(r"[A-Za-z]{2,}")
_USUAL = frozenset("FfGgSXYZLRABW")
ALIAS = re.compile(r"\A[ \t]*(?:[ωδθφαPS]|w(?=[ \t]*=[ \t]*\S))[ \t]*[:=](?!=)[ \t]*")
"""A letter for a part, between its name and its value, as in "axiom ω: F"."""


def without_comment(text: str) -> str:
    """A part without what is said behind it, at the end of its last line."""
    last = text.rfind("\n", 0, len(text) - text.endswith("\n")) + 1
    return text[:last] + COMMENT.sub("", text[last:])


@cache
def fields() -> tuple[re.Pattern[str], dict[str, str]]:
    """The pattern of a part's name with what separates it from its value, and the kind of each name."""
    kinds = {
        name.replace(" ", "").replace("_", "").replace("-", ""): kind for kind in _KINDS for name in tables()["names"][kind]
    }
    names = sorted({name for kind in _KINDS for name in tables()["names"][kind]}, key=len, reverse=True)
    numbered = frozenset(tables()["names"]["rules"])
    every = "|".join(
        re.escape(each).replace(r"\ ", r"[ _-]?") + (r"(?:[ _]?\d{1,2})?" if each in numbered else "") for each in names
    )
    behind = r"(?![\wÀ-ÿ])(?:[ ]?\([^()\n]{0,40}\))?(?:[ ](?P<alias>[ωδθφPVSϕ])(?=[ ]?[:=]))?"
    return re.compile(
        rf"(?P<name>{every}){behind}(?:[ \t]+(?:{_SAY['is']})(?=[: \t]))?"
        rf"(?:{BLANKS}(?P<sep>::?=|::?|=(?![=>])|→|⟶|-{{1,2}}>)|(?=[ \t]|$)){BLANKS}",
        re.IGNORECASE,
    ), kinds


@cache
def _rules() -> re.Pattern[str]:
    """The pattern of a rule's beginning."""
    words = "|".join(sorted(tables()["arrows"]["words"], key=len, reverse=True))
    return re.compile(_RULE.replace("WORDS", rf"(?<=[ \t])(?:{words})(?=[ \t])"))


_COLON_RULE = re.compile(
    rf"(?:(?P<label>{_LABEL}|[Rr](?:ule|egel)(?=[ ][A-Za-z][ \t:])){BLANKS})?"
    rf"(?P<first>x)?(?P<over>x)?(?P<within>x)?(?P<head>[\"']?(?:[A-Za-z]|\d|[-+])[\"']?){BLANKS}"
    rf"(?P<arrow>[:>]|(?![-=]{{1,3}}>)(?=[^\s:]{{0,40}}?[-+\[]|[A-Z]{{2,40}}+(?!\w))){BLANKS}"
)
"""A rule with a colon for its arrow, behind a label or under a heading; or with none: rule F F+F."""


@dataclass(frozen=True)
class Part:
    """A part of a system in a text: its kind, where its value stands, and its beginning; of prose and blank lines, too.

    The kinds are those of `fields.toml`, "rule", "" for prose, and "blank".
    """

    kind: str
    start: int
    end: int
    match: re.Match[str] | None = None
    line: int = 0

    def value(self, text: str) -> Passage:
        return Passage(text[self.start : self.end], self.start).part(0)


def parts_in(text: str) -> list[Part]:
    """The parts of a text in their order."""
    found: list[Part] = []
    section = ""
    for number, match in enumerate(re.finditer(r"^.*$", text, re.MULTILINE)):
        if not match[0].strip():
            found.append(Part("blank", *match.span(), None, number))
            continue
        items = parts_in_line(text, *match.span(), number, section == "rules") if len(match[0]) <= LONGEST_LINE else []
        found += items or [Part("", *match.span(), None, number)]
        named = [item.kind for item in items if item.kind != "rule"]
        section = named[-1] if named else section
    return found


def parts_in_line(text: str, start: int, end: int, line: int, under_rules: bool) -> list[Part]:
    """The parts that a line has."""
    bullet = _BULLET.match(text, start, end)
    start = bullet.end() if bullet else start
    if (lead := _LEADING.match(text, start, end)) and fields()[0].match(text, lead.end(), end):
        start = lead.end()
    if triple := _TRIPLE.search(text, start, end):
        at, until = triple.span("axiom")
        return [Part("axiom", at, until, None, line), *parts_in_line(text, triple.end(), end, line, True)]
    begun: list[tuple[int, Part]] = []
    within = _glued(text, start, end)
    cuts = [
        (each.start(), each.end())
        for each in _BOUNDARY.finditer(text, start, end)
        if not each["said"] or _is_named(text, each.end(), end)
    ]
    for until, at in ((start, start), *cuts):
        if text[until : until + 1] == ":" and at > start:
            at += len(text[at:end]) - len(text[at:end].lstrip())
            if begun or not _is_named(text, at, end):
                continue
        if at < end and (at == start or not within[until - start]) and (not begun or at >= begun[-1][1].start):
            item = _item_at(text, at, end, line, bool(begun), under_rules)
            if item and not (item.match and item.match.re is _BARE_ANGLE and begun and begun[-1][1].kind != "rule"):
                begun.append((until, item))
                if item.kind == "rules" and (rule := _under(text, item)):
                    begun.append((item.start, rule))
                    under_rules = True
    ends = [*(until for until, _ in begun[1:]), end]
    return [replace(item, end=end_of_value(text, item.start, until)) for (_, item), until in zip(begun, ends, strict=False)]


def _is_named(text: str, at: int, end: int) -> bool:
    """Whether a part with a name begins at an offset, or a rule with an arrow."""
    named, rule = fields()[0].match(text, at, end), _rules().match(text, at, end)
    rule = rule or (_rules().match(text, named.end(), end) if named else None)
    return (named is not None and len(named["name"]) > 4) or (rule is not None and rule["arrow"] not in ("=", ":="))


def _under(text: str, item: Part) -> Part | None:
    """The first rule behind the name of the rules."""
    opened = re.compile(r"(?:[ \t({\[]|P[ \t]*=)*").match(text, item.start, item.end)
    at = opened.end() if opened else item.start
    return next((rule for where in (at, item.start) if (rule := _rule_at(text, where, item.end, item.line, True))), None)


def _glued(text: str, start: int, end: int) -> list[bool]:
    """For each offset of a line, whether it is within the brackets behind a symbol, or at such a bracket itself."""
    found, open_brackets, glued = [], [], 0
    for index in range(start, end):
        if text[index] == "(":
            open_brackets.append(index > start and text[index - 1] not in " \t:,;{=>→")
            glued += open_brackets[-1]
        found.append(glued > 0)
        if text[index] == ")" and open_brackets:
            glued -= open_brackets.pop()
    return [*found, glued > 0]


_BRACES = re.compile(r"[{}]")


def end_of_value(text: str, start: int, end: int) -> int:
    """The end of a value, without what separates it from the next, and without brackets that are opened before it."""
    opened = 0
    for sign in _BRACES.finditer(text, start, end):
        opened += 1 if sign[0] == "{" else -1
        if opened < 0:  # it ends the set of the rules
            end = sign.start()
            break
    said = text[start:end].rstrip(" \t,;|")
    said = said[:-1] if said.endswith(("}.", ").", " .")) else said
    while said and said[-1] in ")}" and said.count(said[-1]) > said.count("({"[said[-1] == "}"]):
        said = said[:-1].rstrip(" \t,;|")
    return start + len(said)


_ALIASES = {"ω": "axiom", "δ": "angle"}
"""What a letter calls behind a name that says nothing: the L-system ω: F."""


def _item_at(text: str, at: int, end: int, line: int, later: bool, under_rules: bool) -> Part | None:
    """The part that begins at an offset."""
    pattern, kinds = fields()
    named = pattern.match(text, at, end)
    rule = _rule_at(text, at, end, line, under_rules)
    if (later or _LONE_ANGLE.fullmatch(text, at, end)) and _BARE_ANGLE.match(text, at, end):
        return Part("angle", at, end, _BARE_ANGLE.match(text, at, end), line)
    if named and not (rule and rule.match and rule.match["label"]):
        kind = kinds[re.sub(r"[ _-]|(?<!\d)\d++$", "", named["name"].lower())]
        kind = _ALIASES.get(named["alias"] or "", kind) if kind == "other" else kind
        if _possible(kind, named, text[named.end() : end], rule, later):
            return Part(kind, named.end(), end, named, line)
    value = _VALUE.match(text, at, end)
    return rule or (Part("value", value.start("number"), end, value, line) if value else None)


_VALUE = re.compile(
    r"(?:(?:where|wobei)[ ])?(?P<name>[A-Za-z]\w{0,15})[ \t]*+(?P<sep>=)[ \t]*+"
    r"(?P<number>\d++(?:\.\d++)?)(?=[ \t]*+(?:[,;.]*+[ \t]*+$|[,;][ \t]))",
    re.MULTILINE,
)
"""A name with its value, which may be a constant."""


_BARE_ANGLE = re.compile(r"(?P<name>)(?P<sep>)(?<!\d[.,])(?=\d{1,3}(?:[.,]\d+)?[ ]?(?:°|degrees|deg\b))")
"""An angle without a name, behind a rule."""
_LONE_ANGLE = re.compile(r"\d{1,3}(?:[.,]\d+)?[ ]?(?:°|degrees|deg\b)[.]?")
"""The same, alone on a line."""


def _rule_at(text: str, at: int, end: int, line: int, under_rules: bool) -> Part | None:
    """The rule that begins at an offset."""
    rule = _rules().match(text, at, end)
    if (
        rule
        and _can_be_replaced(rule)
        and not DERIVATION.match(text, rule.start("arrow"), end)
        and not (
            rule["arrow"] in ("=", ":=")
            and (ANY_ARROW.search(text, rule.end(), end) or _CALCULATION.fullmatch(text[rule.end() : end].strip(" \t)")))
        )
        and not (
            (len(rule["head"].strip()) == 1 or _IN_SENTENCE.search(text, text.rfind("\n", 0, at) + 1, at))
            and (
                _is_prose(_SAID.split(text[rule.end() : end], maxsplit=1)[0].strip(" \t"))
                or (rule["arrow"] in ("=", ":=") and _SET.match(text, rule.end(), end))
                or (rule["head"].strip() in tuple("VNTvΣ") and _SET_OF_ONE.match(text, rule.end(), end))
            )
        )
    ):
        return Part("rule", rule.end(), end, rule, line)
    colon = _COLON_RULE.match(text, at, end)
    if (
        colon is None
        or not (colon["arrow"] or (colon["label"] or "")[:4].lower() in ("rule", "rege"))
        or (colon["arrow"] == ">" and not (colon["label"] or under_rules))
    ):
        return None
    further = _FURTHER.search(text, colon.end(), end)
    tail = text[colon.end() : further.start() if further else end].strip(" \"'")
    if is_word(tail) and (
        colon["label"] or under_rules or (len(tail) > 1 and colon["head"].isupper() and "," not in tail and not further)
    ):
        return Part("rule", colon.end(), end, colon, line)
    return None


DERIVATION = re.compile(rf"(?:⇒|={{1,2}}>){BLANKS}[\w+\-\[\]]+{BLANKS}(?:⇒|={{1,2}}>)")
"""Two arrows with a word between them: the words of a derivation, B ⇒ A ⇒ AB."""
_FURTHER = re.compile(rf"[,;]{BLANKS}(?={_COLON_RULE.pattern})".replace("?P<", "?P<_"))
"""Where another rule with a colon begins."""
ANY_ARROW = re.compile(ARROW)
"""An arrow that only rules have."""
_CALCULATION = re.compile(
    r"[a-z_]\w++(?:\.[a-z_]\w++)+(?:\(.*)?|\d++(?:\.\d++)?(?:[ ]?[*/^][ ]?\d++(?:\.\d++)?)+|[a-z][ ]?[-+*/^][ ]?\d++(?:\.\d++)?"
)
"""What a constant is, and no word."""
_SET = re.compile(r"[ \t]*[{<(⟨][ \t]*\S[ \t]*,")
"""A set of symbols."""
_SET_OF_ONE = re.compile(r"[ \t]*\{[ \t]*\S[ \t]*\}[ \t]*(?:$|[,;.])", re.MULTILINE)
"""A set of one symbol, which could be a polygon of it: of what is called as alphabets are."""


_IN_SENTENCE = re.compile(r"(?<![A-Za-zà-ÿ])[A-Za-zà-ÿ]{3,}+[ ,]++[a-zà-ÿ]{2,}+[ \t]++\Z")
"""Words of a sentence that goes on."""
_BEHIND_WORD = re.compile(
    rf"\t|  |[ ]#|[.,;][ ]|[.]$|[ ](?=(?:rules?|angle|iterations|{'|'.join(tables()['said']['and'])})[ ])"
)
"""Where the axiom ends in a sentence."""
_SAID = re.compile(r"[,;()]|\.(?:\s|$)")
"""Where what is said of a symbol ends."""


def _is_prose(text: str) -> bool:
    """Whether a text is a word or two of a language, and none of symbols."""
    return (
        re.fullmatch(r"(?>(?:[a-z]{2,3}[ ](?=[a-z]{4}))?)[A-Z]?[a-z]{4,}(?:[ ](?:[a-z]+|\d[\d.]*+[ ]?°?))*", text) is not None
        and len(set(text)) > 3
        and not NOTHING.fullmatch(text)
    )


def _can_be_replaced(rule: re.Match[str]) -> bool:
    """Whether what stands before an arrow can be replaced; before "=" only a symbol, and no condition before a word."""
    if rule["arrow"][0].isalpha() and ":" in rule["head"]:
        return False
    name = re.match(r"[^\s(:<>]*", rule["head"].strip("\"' "))
    return rule["arrow"] not in ("=", ":=") or bool(name and (len(name[0]) == 1 or "<" in rule["head"]))


_SETTINGS = "axiom", "angle", "steps"
"""What may have an arrow behind its name: ω → F."""


def _possible(kind: str, named: re.Match[str], value: str, rule: Part | None, later: bool) -> bool:
    """Whether a name can begin a part, by what stands behind it."""
    short, sep = len(named["name"]) == 1, named["sep"] or ""
    if sep[-1:] in (">", "→", "⟶") and (later or (short and (rule or kind not in ("axiom", "angle"))) or kind not in _SETTINGS):
        return False
    number = _NUMBER.fullmatch(ALIAS.sub("", value))
    if kind == "steps":
        return bool(
            number
            and (sep or not short or not (later or number["rest"].strip()))
            and re.match(r"[ \t]*(?:$|,(?![ ]?\d)|[-+…;.)#%(|]|[A-Za-zÀ-ÿ]|//|\t)", number["rest"])
        )
    if kind == "angle":
        if number and (sep or not short):
            return re.match(r"[ \t]*[:=]", number["rest"]) is None
        return bool(sep) and not (short and rule) and (angle_of(value) is not None or (not short and not later))
    if kind == "rules":
        return (
            (bool(sep) and not short and rule is None)
            or not value.strip()
            or (sep != "" and bool(re.match(r"[ \t]*(?:[A-Z][ \t]*=[ \t]*)?[{(]", value)))
            or (not short and _rules().match(value.strip(" \t(\"'")) is not None)
        )
    if kind == "axiom":
        if not sep and not value.strip():
            return not later and len(named["name"]) > 4
        if sep:
            return named["name"] in "ωw" if short else sep[-1] not in ">→⟶" or len(named["name"]) > 4
        said = _BEHIND_WORD.split(value.strip())[0]
        return len(named["name"]) > 4 and is_word(said) and re.fullmatch(r"\S+|\S(?:[ ]\S)+", said.strip()) is not None
    if kind == "ignore":
        return bool(sep) or is_word(value)
    if kind in ("head", "tail"):
        replaced = kind == "tail" or _HEAD_ALONE.fullmatch(value.strip()) is not None
        return bool(sep and value.strip()) and replaced and not later and rule is None
    if kind == "draws":
        return bool(sep) and not later and LETTERS.fullmatch(value) is not None
    if kind in ("scale", "constant"):
        return bool(sep and number)
    if later and named["name"].lower() in tables()["said"]["weight"]:
        return False  # it belongs to the rule before
    return (bool(sep) and not (rule and short)) or bool(not sep and not later and _NUMBER.fullmatch(value))


LETTERS = re.compile(r"[ \t]*+\w(?>(?:[ \t,]++(?:and[ ]++)?\w)*)[ \t.]*+")
"""Single letters, as in "A, B"."""


def is_word(text: str, letters: frozenset[str] = frozenset()) -> bool:
    """Whether a text can be a word: signs and letters that no language has in a row, but those that are replaced.

    >>> is_word("F-F++F"), is_word("the axiom"), is_word("abab", frozenset("ab"))
    (True, False, True)
    """
    bare = re.sub(r"\([^()]*\)", "", text.strip())
    return bool(bare and _SIGNS_ONLY.fullmatch(bare)) and all(
        run.isupper() or set(run) <= letters | _USUAL or len(set(run)) == 1 for run in _RUN.findall(bare)
    )
