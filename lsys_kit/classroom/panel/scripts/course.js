// A page of the course without a kernel: its panels, votes, predictions, tables, rules and pictures, each where its data belong.

import { bytesOf, inflated } from "./books/numbers.js";
import { checked, isRight } from "./lessons/checking.js";
import { askForEntries } from "./lessons/filling.js";
import { showRules } from "./lessons/finding.js";
import { fitted, keepAnswer, keptAnswer } from "./lessons/keeping.js";
import { askForPrediction } from "./lessons/predicting.js";
import { askForVote } from "./lessons/voting.js";
import { cannot, hostWith, store } from "./page.js";
import { openComparison } from "./panels/compare.js";
import { openPanel } from "./panels/panel.js";
import { made } from "./views/controls.js";

const KINDS = { panel, comparison, vote, prediction, worksheet, beside, rules, picture };
const NEAR = "50%"; // of a window's height: so near to it something is opened at once

// What comes into view is opened first; then all the rest, one after another, so that a page can be printed and searched.
export async function openCoursePage() {
  const { parts, books } = JSON.parse(document.getElementById("lsys-data").textContent), page = { parts, books, ballots: new Map() };
  const places = [...document.querySelectorAll("[data-part]")].filter((place) => !place.parentElement.closest("[data-part]"));
  const closed = new Set(places);
  const openOnce = async (place) => { if (closed.delete(place)) await open(place, page); };
  const watcher = new IntersectionObserver((seen) => {
    for (const { isIntersecting, target } of seen) if (isIntersecting) openOnce(target);
  }, { rootMargin: NEAR });
  for (const place of places) watcher.observe(place);
  for (const place of places) {
    if (closed.has(place)) await idle();
    await openOnce(place);
  }
  watcher.disconnect();
}

// When the browser has nothing else to do; one that does not tell is given a moment.
const idle = () => new Promise((done) => ("requestIdleCallback" in window ? requestIdleCallback(done) : setTimeout(done, 50)));

// Put a part in its place, instead of what stands there for readers without scripts.
async function open(place, page) {
  const { kind, data } = page.parts[Number(place.dataset.part)];
  try {
    await KINDS[kind](place, data, page);
    place.dataset.open = "";
  } catch (fault) {
    place.append(cannot(fault));
  }
}

// Panels of the same books have them in common.
const hostOf = (data, { books }) => hostWith({ ...data, books: books[data.books] }, false);

async function panel(place, data, page) {
  const host = await hostOf(data, page);
  place.replaceChildren();
  openPanel(place, host);
}

async function picture(place, { drawing }) {
  place.src = URL.createObjectURL(new Blob([await inflated(bytesOf(drawing), "deflate")], { type: "image/svg+xml" }));
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
  });
  ballot.tellers.push(() => model.tell(saying()));
}

const votesOf = (key) => [0, 1].map((place) => ([0, 1, 2, 3].includes(keptAnswer(key)?.[place]) ? keptAnswer(key)[place] : -1));

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
    for (const each of answer.querySelectorAll("[data-part]:not([data-open])")) open(each, page);
  };
  const model = asked(askForPrediction, place, { question, typed: said, revealed: before?.length === 1, outcome: {} }, show);
  if (model.get("revealed")) show(model);
}

function worksheet(place, data) {
  const { title, columns } = data.sheet, key = `table ${[title, ...columns].join(" ")}`, many = data.blanks.length, before = keptAnswer(key);
  const [typed, entries, first] = ["typed", "entries", "first"].map((name) => fitted(before?.[name], many));
  const done = entries.some(Boolean) ? { number: 0, first, ...checked(data, entries) } : {};
  asked(askForEntries, place, { sheet: data.sheet, typed, asked: done.marks ? { number: 0, entries } : {}, result: done }, ({ get, tell }) => {
    const now = get("asked"), was = get("result");
    if (!now.entries) tell({ result: {} });
    else if (now.number !== was.number) tell({ result: { number: now.number, first: now.entries.map((entry, at) => was.first?.[at] || entry), ...checked(data, now.entries) } });
    const { first: earliest } = get("result");
    keepAnswer(key, get("typed").some(Boolean) ? { typed: get("typed"), entries: now.entries, first: earliest } : null);
  });
}

async function beside(place, { panel: seen, sheet }, page) {
  const [left, right] = [made("div"), made("div")];
  place.replaceChildren(left, right);
  worksheet(right, sheet);
  await KINDS[seen.kind](left, seen.data, page);
}

function rules(place, found) {
  asked(showRules, place, { found, step: 1 }, () => {});
}
