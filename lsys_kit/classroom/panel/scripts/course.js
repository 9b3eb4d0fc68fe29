// A page of the course without a kernel: its panels, votes, predictions, tables, rules and pictures.

import { hasLink, unpackedLink } from "./books/link.js";
import { checked, isRight } from "./lessons/checking.js";
import { doneBox, markDone, whenMarked } from "./lessons/done.js";
import { askForEntries } from "./lessons/filling.js";
import { showRules } from "./lessons/finding.js";
import { fitted, keepAnswer, keptAnswer } from "./lessons/keeping.js";
import { askForPrediction } from "./lessons/predicting.js";
import { askForVote } from "./lessons/voting.js";
import { ANOTHER, BROKEN, cannot, hostWith, store } from "./page.js";
import { openComparison } from "./panels/compare.js";
import { openPanel } from "./panels/panel.js";
import { openPart, openParts } from "./parts.js";
import { made, speak, worded } from "./views/controls.js";

const KINDS = { panel, comparison, vote, prediction, worksheet, beside, rules };

// What a page of a class does otherwise is in `outside`: { hostWith, told(kind, asked, round, value), and functions that open parts }.
export function openCoursePage(outside = {}) {
  speak(JSON.parse(document.getElementById("lsys-data").textContent).words);
  const finished = offerDone(document.querySelector("[data-lesson]"));
  tellOfLink(outside.opened);
  return openParts({ ...KINDS, ...outside }, cannot, { ballots: new Map(), outside, finished });
}

// A link in the address that is broken, or leads to a model of which the page has no panel, is said to do so; unless somebody opens it.
async function tellOfLink(opened) {
  if (!hasLink(location.href)) return;
  const content = await unpackedLink(location.href), systems = [];
  JSON.parse(document.getElementById("lsys-data").textContent, (key, value) => {
    if (key === "system") systems.push(`${value.notation} ${value.text}`);
    return value;
  });
  const notice = !content ? BROKEN : systems.includes(`${content.notation} ${content.text}`) || opened?.(content) ? null : ANOTHER;
  if (notice) document.querySelector("main").prepend(made("p.lsys-message", { role: "status" }, `\u26a0 ${notice.message}. ${notice.hint}`));
}

// At the end of a lesson a box to be ticked when it is done; the second vote ticks it, too.
function offerDone(place) {
  if (!place) return () => {};
  const { lesson } = place.dataset, text = worded("I have done this lesson"), box = doneBox(lesson, text, text);
  place.append(box.element);
  whenMarked(box.show);
  return () => {
    markDone(lesson, true);
    box.show();
  };
}

// Panels of the same books have them in common.
const hostOf = (data, { books, outside }) => (outside.hostWith ?? hostWith)({ ...data, books: books[data.books] }, false);

async function panel(place, data, page) {
  const host = await hostOf(data, page);
  place.replaceChildren();
  openPanel(place, host);
}

async function comparison(place, { left, right, shared }, page) {
  const hosts = await Promise.all([left, right].map((data) => hostOf(data, page)));
  place.replaceChildren();
  openComparison(place, hosts, shared);
}

// Ask a question of a lesson, without a kernel: `saved` is called with its model when the page was told something.
function asked(ask, place, values, saved) {
  const found = store(values), tell = (changes) => Object.entries(changes).forEach(([name, value]) => found.set(name, value));
  const model = { get: found.get, set: found.set, on: (event, handler) => found.on(event.slice("change:".length), handler), off() {}, save_changes: () => saved(model), tell };
  place.replaceChildren();
  ask({ model, el: place });
  return model;
}

// Both votes on a question know of one another; the second one knows what was predicted on the page, too.
function vote(place, { asked: question, again, said }, page) {
  const key = `vote ${question.question}`, ballot = page.ballots.get(key) ?? { votes: votesOf(key), tellers: [] };
  page.ballots.set(key, ballot);
  const own = Number(again), saying = () => ({ said: { ...said[ballot.votes[0] + 1][ballot.votes[1] + 1], predicted: again ? predictedOn(page) : [] } });
  const model = asked(askForVote, place, { asked: question, chosen: ballot.votes[own], ...saying() }, ({ get }) => {
    ballot.votes[own] = get("chosen");
    keepAnswer(key, ballot.votes.some((each) => each >= 0) ? ballot.votes : null);
    for (const tell of ballot.tellers) tell();
    if (again && ballot.votes[own] >= 0) page.finished();
    page.outside.told?.("vote", "", again ? 2 : 1, ballot.votes[own]);
  });
  ballot.tellers.push(() => model.tell(saying()));
}

const votesOf = (key) => [0, 1].map((place) => [0, 1, 2, 3].indexOf(keptAnswer(key)?.[place])); // -1 where there is none

const OPEN = "open"; // behind what was typed, where its answer was not asked for yet

const keyOf = (question) => `prediction ${question}`;

function outcomeOf(known, typed, atTheEnd = false) {
  if (!known || (known.later && !atTheEnd)) return {};
  return { answer: known.answer, ...(known.right.length ? { right: isRight(typed, known.right) } : {}) };
}

function predictedOn({ parts }) {
  return parts.filter(({ kind }) => kind === "prediction").flatMap(({ data: { question, known } }) => {
    const before = keptAnswer(keyOf(question)), [typed] = fitted(before, 1);
    return known && typed && before.length === 1 ? [{ question, typed, ...outcomeOf(known, typed, true) }] : [];
  });
}

function prediction(place, { question, known }, page) {
  const answer = place.querySelector("[data-answer]"), key = keyOf(question), before = keptAnswer(key), [said] = fitted(before, 1);
  const show = ({ get, tell }) => {
    const revealed = get("revealed");
    keepAnswer(key, revealed ? [get("typed")] : get("typed") ? [get("typed"), OPEN] : null);
    tell({ outcome: revealed ? outcomeOf(known, get("typed")) : {} });
    for (const { tellers } of page.ballots.values()) for (const each of tellers) each();
    if (!revealed) return answer.remove();
    place.append(answer);
    for (const each of answer.querySelectorAll("[data-part]:not([data-open])")) openPart(each, page);
  };
  const model = asked(askForPrediction, place, { question, typed: said, revealed: before?.length === 1, outcome: {} }, (changed) => {
    show(changed);
    if (changed.get("revealed") && changed.get("typed")) page.outside.told?.("prediction", question, 1, changed.get("typed"));
  });
  if (model.get("revealed")) show(model);
}

function worksheet(place, data, { outside }) {
  const { title, columns } = data.sheet, key = `table ${[title, ...columns].join(" ")}`, many = data.blanks.length, before = keptAnswer(key);
  const [typed, entries, first] = ["typed", "entries", "first"].map((name) => fitted(before?.[name], many));
  const done = entries.some(Boolean) ? { number: 0, first, ...checked(data, entries) } : {};
  asked(askForEntries, place, { sheet: data.sheet, typed, asked: done.marks ? { number: 0, entries } : {}, result: done }, ({ get, tell }) => {
    const now = get("asked"), was = get("result");
    if (!now.entries) tell({ result: {} });
    else if (now.number !== was.number) {
      tell({ result: { number: now.number, first: now.entries.map((entry, at) => was.first?.[at] || entry), ...checked(data, now.entries) } });
      outside.told?.("table", data.sheet.title, 1, now.entries);
    }
    const { first: earliest } = get("result");
    keepAnswer(key, get("typed").some(Boolean) ? { typed: get("typed"), entries: now.entries, first: earliest } : null);
  });
}

async function beside(place, { panel: seen, sheet }, page) {
  const [left, right] = [made("div"), made("div")];
  place.replaceChildren(left, right);
  worksheet(right, sheet, page);
  await KINDS[seen.kind](left, seen.data, page);
}

function rules(place, found) {
  asked(showRules, place, { found, step: 1 }, () => {});
}
