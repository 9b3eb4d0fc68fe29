// The page of a phone: whatever the teacher has opened can be answered here, and a tick says when the answer is kept.

import { plain, prose } from "../lessons/asking.js";
import { freshId, made, speak, worded } from "../views/controls.js";
import { classConnection, whatIsAsked } from "./outbox.js";

const LETTERS = "ABCDEF";

const boxIn = (place) => /** @type {HTMLInputElement | null} */ (place.querySelector("input[type=text]"));

export function openPhone() {
  const { code, course, words } = JSON.parse(document.getElementById("lsys-data").textContent);
  speak(words);
  const here = document.getElementById("here"), link = document.getElementById("link"), base = `/${code}/`;
  let told = null, state = null, own = null, shown = "";
  const status = made("p.tick", { role: "status" });

  const connection = classConnection(base, code, {
    linked(isThere) {
      link.textContent = isThere ? worded("connected") : worded("not connected: it is tried again, and nothing is lost");
      link.dataset.there = String(isThere);
    },
    state({ current }) {
      if (keyOf(told) !== keyOf(current)) {
        status.textContent = "";
        status.dataset.kept = "false";
      }
      told = current;
      if (told && keyOf(told) !== keyOf(own)) own = null;
      show();
    },
    told(message, answer) {
      if (answer.kept) status.textContent = `✓ ${worded("kept")}`;
      else if (answer.later) status.textContent = worded("Not kept yet: it is sent again by itself.");
      else status.textContent = answer.why;
      status.dataset.kept = String(Boolean(answer.kept));
    },
  });

  // One element for each picture: a new one would have no size at first, and what is below it would move under the finger.
  const pictures = new Map();
  function pictureOf(src, alt) {
    if (!pictures.has(src)) pictures.set(src, made("img", { src, alt }));
    return pictures.get(src);
  }

  const keyOf = (each) => (each ? `${each.kind} ${each.about} ${each.round}` : "");

  // Send an answer; it is shown as chosen at once, and ticked when it is kept.
  function tell(value) {
    const { kind, about, round } = state;
    own = { kind, about, round, value: kind === "game" ? { ...own?.value, ...value } : value };
    status.textContent = worded("sending");
    status.dataset.kept = "false";
    connection.tell(kind, about, round, value);
    show();
  }

  const answered = () => own?.value ?? state.own;

  function show() {
    const isAsked = told && ["vote", "prediction"].includes(told.kind);
    state = told && { ...(isAsked ? whatIsAsked(told.kind, told.about, { question: told.question, options: told.options }, show) : {}), ...told };
    const seen = JSON.stringify([state, own]);
    if (seen === shown) return;
    shown = seen;
    const focused = document.activeElement?.getAttribute("data-key");
    const typed = boxIn(here)?.value;
    here.replaceChildren(...(state ? [KINDS[state.kind](), status] : [waiting()]), ...lessons());
    const box = boxIn(here);
    if (box && typed && !answered()) box.value = typed;
    if (focused) /** @type {HTMLElement | null} */ (here.querySelector(`[data-key="${focused}"]`))?.focus();
  }

  const waiting = () => made("section.phone-card", made("h2", worded("You are in.")), made("p", worded("Look at the board. A question appears here when it is opened.")));
  const lessons = () => (course ? [made("p.phone-course", made("a", { href: `${base}course/index.html` }, worded("The course")))] : []);
  const isClosed = () => state.status === "closed";
  const closedNote = () => (isClosed() ? [made("p.phone-note", worded("This question is closed."))] : []);

  function vote() {
    const { options, picture, described, question, round, right, reply } = state, chosen = answered(), id = freshId();
    const buttons = options.map((option, number) => made("button.choice", {
      type: "button", "data-key": number, "aria-pressed": String(number === chosen), disabled: isClosed(), onclick: () => tell(number),
      ...(number === right ? { "data-right": true } : {}),
    }, made("b", LETTERS[number]), prose(option)));
    return made("section.phone-card", made("p.phone-kind", round === 1 ? worded("First vote") : worded("Second vote")), made("h2", { id }, prose(question)),
      ...(picture ? [pictureOf(picture, described)] : []), made("div.choices", { role: "group", "aria-labelledby": id }, ...buttons),
      ...(reply ? [made("p.phone-reply", made("b", chosen === right ? `✓ ${worded("Right")}. ` : `${LETTERS[right]} ${worded("is right")}. `), prose(reply))] : []), ...closedNote());
  }

  function prediction() {
    const id = freshId(), chosen = answered();
    const box = made("input", { type: "text", id, maxlength: 100, autocomplete: "off", value: chosen ?? "", "data-key": "box", disabled: isClosed() });
    const form = made("form.phone-form", { onsubmit: (event) => {
      event.preventDefault();
      if (box.value.trim()) tell(box.value.trim());
    } }, box, made("button.go", { type: "submit", disabled: isClosed() }, worded("Send")));
    const said = chosen ? [made("p", `${worded("You said:")} `, made("b", chosen))] : [];
    return made("section.phone-card", made("p.phone-kind", worded("Prediction")), made("label.phone-asked", { for: id }, prose(state.question)), form, ...said, ...closedNote());
  }

  const onPage = (kind, text) => () => made("section.phone-card", made("p.phone-kind", kind), made("h2", prose(state.title)), made("p", text),
    ...(course ? [made("p", made("a.go", { href: `${base}course/${state.page}` }, worded("Open the page")))] : []));

  function wall() {
    return made("section.phone-card", made("h2", worded("The wall")), made("p", worded("Make a plant in a panel of the course, and press: to the wall.")),
      ...(course ? [made("p", made("a.go", { href: `${base}course/notebooks/03_type_a_plant.html` }, worded("Open the page")))] : []));
  }

  function game() {
    const chosen = answered() ?? {};
    const cells = state.cells.map(({ place, before, cell, behind, choices }) => {
      const id = freshId();
      const row = made("p.cells", { id }, made("span.cell", before ?? "–"), made("b.cell.own", cell), made("span.cell", behind ?? "–"));
      const buttons = choices.map((text, number) => made("button.choice", {
        type: "button", "data-key": `${place}-${number}`, "aria-pressed": String(chosen[place] === number), disabled: isClosed(), onclick: () => tell({ [place]: number }),
      }, made("code", text), ...(text === "ε" ? [worded("it vanishes")] : text === cell ? [worded("it stays as it is")] : [])));
      return made("div.one-cell", made("p.phone-kind", worded("Cell {number} of {many}", { number: place + 1, many: state.many })), row,
        made("p", worded("What does your cell become?")), made("div.choices", { role: "group", "aria-label": plain(worded("What does the cell {cell} become?", { cell })) }, ...buttons));
    });
    const rules = made("details.rules", { open: true }, made("summary", worded("The rules")), made("pre", { tabindex: 0 }, state.rules));
    return made("section.phone-card", made("p.phone-kind", worded("You are the cell: step {step}", { step: state.round })), ...cells, rules, ...closedNote());
  }

  const KINDS = { vote, prediction, game, wall, table: onPage(worded("Table to fill"), worded("Fill it in on the page of the lesson, and press Check.")),
    exercise: onPage(worded("Exercise"), worded("Answer it on its page.")) };
  show();
}
