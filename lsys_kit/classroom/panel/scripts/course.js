// A page of the course without a kernel: its panels, votes, predictions, tables, rules and pictures, each where its data belong.

import { bytesOf, inflated } from "./books/numbers.js";
import { checked } from "./lessons/checking.js";
import { askForEntries } from "./lessons/filling.js";
import { showRules } from "./lessons/finding.js";
import { askForPrediction } from "./lessons/predicting.js";
import { askForVote } from "./lessons/voting.js";
import { cannot, hostWith, store } from "./page.js";
import { openComparison } from "./panels/compare.js";
import { openPanel } from "./panels/panel.js";
import { made } from "./views/controls.js";

const KINDS = { panel, comparison, vote, prediction, worksheet, beside, rules, picture };
const NEAR = "50%"; // of a window's height: so near to it something is opened at once

// What comes into view is opened first; then all the rest, one after another, so that a page can be printed and searched.
// What a page of a class does otherwise is in `outside`: { hostWith, told(kind, asked, round, value), and functions that open parts }.
export async function openCoursePage(outside = {}) {
  const { parts, books } = JSON.parse(document.getElementById("lsys-data").textContent), page = { parts, books, ballots: new Map(), outside };
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
    await (page.outside[kind] ?? KINDS[kind])(place, data, page);
    place.dataset.open = "";
  } catch (fault) {
    place.append(cannot(fault));
  }
}

// Panels of the same books have them in common.
const hostOf = (data, { books, outside }) => (outside.hostWith ?? hostWith)({ ...data, books: books[data.books] }, false);

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

// Both votes on a question know of one another.
function vote(place, { asked: question, again, said }, { ballots, outside }) {
  const key = JSON.stringify([question.question, question.options]), ballot = ballots.get(key) ?? { votes: [-1, -1], tellers: [] };
  ballots.set(key, ballot);
  const saying = () => ({ said: said[ballot.votes[0] + 1][ballot.votes[1] + 1] });
  const model = asked(askForVote, place, { asked: question, chosen: -1, ...saying() }, ({ get }) => {
    ballot.votes[Number(again)] = get("chosen");
    for (const tell of ballot.tellers) tell();
    outside.told?.("vote", "", again ? 2 : 1, get("chosen"));
  });
  ballot.tellers.push(() => model.tell(saying()));
}

function prediction(place, { question }, page) {
  const answer = place.querySelector("[data-answer]");
  asked(askForPrediction, place, { question, typed: "", revealed: false }, ({ get }) => {
    place.append(answer);
    if (get("typed")) page.outside.told?.("prediction", question, 1, get("typed"));
    for (const each of answer.querySelectorAll("[data-part]")) open(each, page);
  });
}

function worksheet(place, data, { outside }) {
  asked(askForEntries, place, { sheet: data.sheet, asked: {}, result: {} }, ({ get, tell }) => {
    const { number, entries } = get("asked");
    tell({ result: { number, ...checked(data, entries) } });
    outside.told?.("table", data.sheet.title, 1, entries);
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
