// A page of the course without a kernel: its panels, votes, predictions, tables, rules and pictures, each where its data belong.

import { hostWith, cannot } from "./page.js";
import { bytesOf, inflated } from "./books/packing.js";
import { openComparison } from "./panels/compare.js";
import { openPanel } from "./panels/panel.js";
import { askForEntries } from "./lessons/filling.js";
import { showRules } from "./lessons/finding.js";
import { askForPrediction } from "./lessons/predicting.js";
import { askForVote } from "./lessons/voting.js";
import { checked } from "./lessons/checking.js";

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

// The file of a picture, which the page keeps deflated.
async function picture(place, { drawing }) {
  const text = await inflated(bytesOf(drawing), "deflate");
  place.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
}

async function comparison(place, { left, right, shared }, page) {
  const hosts = await Promise.all([left, right].map((data) => hostOf(data, page)));
  place.replaceChildren();
  openComparison(place, hosts, shared);
}

// Both votes on a question know of one another.
function vote(place, { asked, again, said }, { ballots }) {
  const key = JSON.stringify([asked.question, asked.options]), ballot = ballots.get(key) ?? { votes: [-1, -1], tellers: [] };
  ballots.set(key, ballot);
  const saying = () => said[ballot.votes[0] + 1][ballot.votes[1] + 1];
  const model = modelOf({ asked, chosen: -1, said: saying() }, () => {
    ballot.votes[Number(again)] = model.get("chosen");
    for (const tell of ballot.tellers) tell();
  });
  ballot.tellers.push(() => model.tell({ said: saying() }));
  place.replaceChildren();
  askForVote({ model, el: place });
}

function prediction(place, { question }, page) {
  const answer = place.querySelector("[data-answer]");
  const model = modelOf({ question, typed: "", revealed: false }, () => {
    place.append(answer);
    for (const each of answer.querySelectorAll("[data-part]")) open(each, page);
  });
  place.replaceChildren();
  askForPrediction({ model, el: place });
}

function worksheet(place, data) {
  const model = modelOf({ sheet: data.sheet, asked: {}, result: {} }, () => {
    const { number, entries } = model.get("asked");
    model.tell({ result: { number, ...checked(data, entries) } });
  });
  place.replaceChildren();
  askForEntries({ model, el: place });
}

// A panel, and the table that is filled in from what it shows.
async function beside(place, { panel: seen, sheet }, page) {
  const [left, right] = [0, 1].map(() => document.createElement("div"));
  place.replaceChildren(left, right);
  worksheet(right, sheet);
  await KINDS[seen.kind](left, seen.data, page);
}

function rules(place, found) {
  place.replaceChildren();
  showRules({ model: modelOf({ found, step: 1 }, () => {}), el: place });
}

// What a widget's script asks of its model, without a kernel: `saved` is called when the page was told something.
function modelOf(values, saved) {
  const handlers = new Map();
  const tell = (changes) => {
    Object.assign(values, changes);
    for (const name of Object.keys(changes)) for (const handler of handlers.get(`change:${name}`) ?? []) handler();
  };
  return {
    get: (name) => values[name],
    set: (name, value) => tell({ [name]: value }),
    on: (event, handler) => handlers.set(event, [...(handlers.get(event) ?? []), handler]),
    off: (event, handler) => handlers.set(event, (handlers.get(event) ?? []).filter((each) => each !== handler)),
    save_changes: saved,
    tell,
  };
}
