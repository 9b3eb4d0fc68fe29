// A page of the course without a kernel: its panels, votes, predictions, tables, rules and pictures.

import { checked } from "./lessons/checking.js";
import { doneBox, markDone, whenMarked } from "./lessons/done.js";
import { askForEntries } from "./lessons/filling.js";
import { showRules } from "./lessons/finding.js";
import { askForPrediction } from "./lessons/predicting.js";
import { askForVote } from "./lessons/voting.js";
import { cannot, hostWith, store } from "./page.js";
import { openComparison } from "./panels/compare.js";
import { openPanel } from "./panels/panel.js";
import { openPart, openParts } from "./parts.js";
import { made } from "./views/controls.js";

const KINDS = { panel, comparison, vote, prediction, worksheet, beside, rules };

export function openCoursePage() {
  return openParts(KINDS, cannot, { ballots: new Map(), finished: offerDone(document.querySelector("[data-lesson]")) });
}

// At the end of a lesson a box to be ticked when it is done; the second vote ticks it, too.
function offerDone(place) {
  if (!place) return () => {};
  const { lesson } = place.dataset, text = "I have done this lesson", box = doneBox(lesson, text, text);
  place.append(box.element);
  whenMarked(box.show);
  return () => {
    markDone(lesson, true);
    box.show();
  };
}

// Panels of the same books have them in common.
const hostOf = (data, { books }) => hostWith({ ...data, books: books[data.books] }, false);

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

// Both votes on a question know of one another.
function vote(place, { asked: question, again, said }, { ballots, finished }) {
  const key = JSON.stringify([question.question, question.options]), ballot = ballots.get(key) ?? { votes: [-1, -1], tellers: [] };
  ballots.set(key, ballot);
  const saying = () => ({ said: said[ballot.votes[0] + 1][ballot.votes[1] + 1] });
  const model = asked(askForVote, place, { asked: question, chosen: -1, ...saying() }, ({ get }) => {
    ballot.votes[Number(again)] = get("chosen");
    for (const tell of ballot.tellers) tell();
    if (again) finished();
  });
  ballot.tellers.push(() => model.tell(saying()));
}

function prediction(place, { question }, page) {
  const answer = place.querySelector("[data-answer]");
  asked(askForPrediction, place, { question, typed: "", revealed: false }, () => {
    place.append(answer);
    for (const each of answer.querySelectorAll("[data-part]")) openPart(each, page);
  });
}

function worksheet(place, data) {
  asked(askForEntries, place, { sheet: data.sheet, asked: {}, result: {} }, ({ get, tell }) => {
    const { number, entries } = get("asked");
    tell({ result: { number, ...checked(data, entries) } });
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
