// The board: who is there, what is open, and what the class thinks of it. Whatever is seen is a view of what the server tells; a
// board that was gone is soon as it was. On the projector it speaks with the server itself, below a cell the kernel does so.

import { prose } from "../lessons/asking.js";
import { made, speak, worded } from "../views/controls.js";
import { whatIsAsked } from "./outbox.js";

const LETTERS = "ABCDEF", AGAIN = 800; // milliseconds before the server is looked for again
const OWN = "own", EMPTY = "data:,";

// The board for the projector.
export function openBoard() {
  const { words, ...data } = JSON.parse(document.getElementById("lsys-data").textContent), [here, present, tools] = ["here", "present", "tools"].map((id) => document.getElementById(id));
  speak(words);
  let socket = null;
  const tell = (message) => socket.readyState === WebSocket.OPEN && socket.send(JSON.stringify(message));
  const board = showBoard({ here, present, tools }, data, { tell, asked: whatIsAsked, plant: (number) => `plants/${number}` });

  function connect() {
    const place = new URL("live", location.href);
    place.protocol = place.protocol === "https:" ? "wss:" : "ws:";
    socket = new WebSocket(place);
    socket.addEventListener("open", () => board.say(""));
    socket.addEventListener("message", ({ data: text }) => board.hear(JSON.parse(text)));
    socket.addEventListener("close", () => {
      board.say(worded("The server does not answer. It is looked for again."));
      setTimeout(connect, AGAIN);
    });
  }

  addEventListener("keydown", board.keyed);
  connect();
}

// A board in some elements. A carrier has tell(message), asked(kind, about, otherwise, arrived), as in outbox.js, and plant(number,
// arrived), the address of the picture of a plant, or nothing until it has arrived. What is told in turn is given to `hear`.
export function showBoard({ here, present, tools }, { address, code, plan, games, picture }, { tell, asked: whatIsAskedBy, plant }) {
  let state = { present: 0, current: null, pages: null }, joining = false, seen = "", asked = {};
  const said = made("p.board-said", { role: "alert" });

  function hear({ state: next, mistake }) {
    if (mistake) said.textContent = mistake;
    if (!next) return;
    const { current } = next;
    state = next;
    said.textContent = next.fault ? `\u26a0 ${next.fault}` : mistake ?? "";
    if (current && keyOf(current) !== seen) joining = false;
    seen = current ? keyOf(current) : "";
    show();
  }

  const keyOf = ({ kind, about, round }) => `${kind} ${about} ${round}`;
  const named = () => (({ kind, about, round }) => ({ kind, about, round }))(state.current);

  // What is seen.

  function show() {
    const making = state.pages ? ` · ${worded("pages of the course: {made} of {many}", state.pages)}` : "";
    present.textContent = `${worded("{number} here", { number: state.present })} · ${code}${making}`;
    const current = joining ? null : state.current, isAsked = current && current.kind in kinds;
    if (isAsked) asked = whatIsAskedBy(current.kind, current.about, notYet(current), show);
    here.dataset.kind = current?.kind ?? "join";
    here.replaceChildren(...(current ? VIEWS[current.kind](current) : join()));
    showTools();
  }

  function join() {
    const image = picture ? [made("img.board-code", { src: picture, alt: worded("QR code of the address {address}", { address }) })] : [];
    return [made("section.board-join", ...image, made("div", made("p", worded("Join with a phone")), made("p.board-address", address.replace(/^https?:\/\//, "").replace(/\/\w{4}\/$/, "")),
      made("p", worded("and this code")), made("p.board-letters", code), made("p.board-number", worded("{number} here", { number: state.present }))))];
  }

  // What stands in the place of a question until its picture is drawn, or its table is there.
  function notYet({ kind, about }) {
    const known = plan.flatMap(({ items: all }) => all).find((each) => each.kind === kind && each.about === about);
    return { question: known?.question ?? "", options: known?.options ?? [], columns: [], rows: [] };
  }

  const head = (kind, text, more = []) => [made("p.board-kind", kind), made("h2", prose(text)), ...more];
  const answered = ({ answered: many }) => made("div.board-count", made("strong", String(many)), made("span", worded("of {number} have answered", { number: state.present })),
    made("progress", { max: Math.max(1, state.present, many), value: many, "aria-label": worded("answered") }));
  const closedMark = ({ status }) => (status === "closed" ? ` · ${worded("closed")}` : "");

  function vote(current) {
    const { round, shown, bars, before, right, changes } = current;
    const all = (counts = []) => Math.max(1, counts.reduce((sum, each) => sum + each, 0));
    const rows = asked.options.map((text, number) => made("li.board-option", number === right ? { "data-right": true } : {},
      made("b", LETTERS[number]), made("div", made("p", prose(text), ...(number === right ? [made("span.board-tick", ` ✓ ${worded("right")}`)] : [])),
        ...(shown ? [...(before ? [bar(before[number], all(before), worded("first vote"), "first")] : []), bar(bars[number], all(bars), before ? worded("second vote") : "", "now")] : []))));
    const image = asked.picture && !shown ? [made("img.board-picture", { src: asked.picture, alt: asked.described })] : [];
    return [...head(`${round === 1 ? worded("First vote") : worded("Second vote")}${closedMark(current)}`, asked.question), ...image, made("ol.board-options", ...rows),
      ...(shown && changes ? [changed(changes)] : []), ...(shown ? [] : [answered(current)])];
  }

  function bar(count, total, label, kind) {
    const filled = made("span.board-fill");
    filled.style.width = `${(100 * count) / total}%`;
    return made("div.board-bar", { "data-bar": kind }, made("span.board-track", filled), made("strong", String(count)), ...(label ? [made("small", label)] : []));
  }

  function changed({ both, better, worse, gain }) {
    const parts = [worded("{better} from wrong to right, {worse} from right to wrong, of {both} who voted twice.", { better, worse, both })];
    if (gain !== null) parts.push(worded("Normalised gain: {gain}", { gain: gain.toFixed(2) }));
    return made("p.board-changes", parts.join(" "));
  }

  function prediction(current) {
    const { shown, said: texts = [], numbers, more, about } = current;
    if (!shown) return [...head(`${worded("Prediction")}${closedMark(current)}`, asked.question), answered(current)];
    const most = Math.max(1, ...texts.map(({ count }) => count));
    const each = texts.map(({ text, count, right }) => {
      const button = made("button.board-word", { type: "button", "aria-pressed": String(right), title: worded("mark as right"), onclick: () => tell({ do: "mark", about, text, on: !right }) },
        made("span", `${right ? "✓ " : ""}${text}`), made("strong", `× ${count}`));
      if (numbers) button.append(bar(count, most, "", right ? "right" : "now"));
      else button.style.fontSize = `${1 + (1.4 * count) / most}em`;
      return made("li", button);
    });
    return [...head(`${worded("Prediction")}${closedMark(current)}`, asked.question), made(`ul.board-words${numbers ? ".board-numbers" : ""}`, ...each),
      ...(more ? [made("p", worded("and {number} more", { number: more }))] : [])];
  }

  function table(current) {
    let place = 0;
    const rows = asked.rows.map((row) => made("tr", ...row.map((cell, column) => {
      if (cell !== null) return made(column ? "td" : "th", prose(String(cell)));
      const found = current.cells?.[place++];
      if (!found) return made("td.board-blank", "?");
      const all = found.right + found.wrong, share = all ? found.right / all : 0;
      const box = made("td.board-blank", { "data-filled": String(Boolean(all)) }, all ? `${found.right} / ${all}` : "–");
      box.style.setProperty("--share", `${Math.round(100 * share)}%`);
      return box;
    })));
    const headings = made("tr", ...asked.columns.map((name) => made("th", { scope: "col" }, prose(name))));
    return [...head(`${worded("Table to fill")}${closedMark(current)}`, asked.question), made("table.board-table", made("thead", headings), made("tbody", ...rows)),
      ...(current.cells ? [made("p", worded("Right of those who have filled it in"))] : [answered(current)])];
  }

  function exercise(current) {
    const { solved, stuck, replies } = current;
    return [...head(`${worded("Exercise")}${closedMark(current)}`, asked.question),
      made("div.board-pair", made("p", made("strong", String(solved)), ` ${worded("have solved it")}`), made("p", made("strong", String(stuck)), ` ${worded("are stuck")}`)),
      ...(replies ? [made("ul.board-replies", ...replies.map(({ text, count }) => made("li", made("strong", `${count}×`), made("span", text))))] : [])];
  }

  function game(current) {
    const { question, rules, before, played, outcome, round } = current;
    const row = made("ol.board-cells", ...before.map((text, place) => {
      const found = outcome?.cells[place];
      const made_ = found ? [made("span.board-made", { "data-fits": String(found.fits) }, `${found.fits ? "" : "✗ "}${found.made}`)] : [];
      return made("li", { "data-played": String(played[place]), "data-parts": String(outcome?.parts === place) }, made("b", text), made("span", { "aria-hidden": "true" }, "↓"), ...(found ? made_ : [made("span.board-made", played[place] ? "●" : "…")]));
    }));
    const rest = outcome ? judged(outcome) : [answered(current)];
    return [...head(`${worded("You are the cell: step {step}", { step: round })}${closedMark(current)}`, question), made("pre.board-rules", rules), row, ...rest];
  }

  function judged({ word, rightWord, parts, unplayed, others, like }) {
    const lines = [made("dt", worded("The class has made")), made("dd", word), made("dt", worded("The rules make")), made("dd", rightWord)];
    for (const { way, word: other } of others) lines.push(made("dt", way), made("dd", other));
    const verdict = parts === null ? `✓ ${worded("All cells are right.")}` : worded("The words part at cell {number}.", { number: parts + 1 });
    const notes = [...like.map((way) => worded("This is what comes of: {way}.", { way })), ...(unplayed ? [worded("Cells that the kit has played: {number}.", { number: unplayed })] : [])];
    return [made("p.board-verdict", { "data-right": String(parts === null) }, [verdict, ...notes].join(" ")), made("dl.board-outcome", ...lines)];
  }

  function wall({ plants }) {
    const tiles = plants.map(({ number, description }) => made("li", made("img", { src: plant(number, show) || EMPTY, alt: description, loading: "lazy" }),
      made("button", { type: "button", "aria-label": worded("take away: {what}", { what: description }), onclick: () => tell({ do: "remove", number }) }, "×")));
    return [...head(worded("The wall"), plants.length ? "" : worded("No plant yet")), made("ul.board-wall", ...tiles.reverse())];
  }

  const VIEWS = { vote, prediction, table, exercise, game, wall };

  // What the teacher does.

  const rows = plan.flatMap(({ lesson, items }) => items.flatMap((item) => Array.from({ length: item.rounds }, (_, at) => ({ ...item, lesson, round: at + 1 }))));
  const lessons = made("select", { "aria-label": worded("lesson"), onchange: () => offer() }, ...plan.map(({ lesson, title }) => made("option", { value: lesson }, /^\d\d$/.test(lesson) ? `${Number(lesson)} ${title}` : title)));
  const items = made("select.board-items", { "aria-label": worded("question") });
  const own = made("textarea", { rows: 5, "aria-label": worded("rules of the game"), placeholder: "axiom: a\na -> ab\nb -> a", hidden: true });
  const kinds = { vote: worded("vote"), prediction: worded("prediction"), table: worded("table"), exercise: worded("exercise") };
  const buttons = {};

  function offer() {
    const found = rows.filter(({ lesson }) => lesson === lessons.value);
    const plays = [...games, OWN].map((what) => made("option", { value: `game ${what}` }, `${worded("game")}: ${what === OWN ? worded("own rules") : what}`));
    items.replaceChildren(...found.map((item) => made("option", { value: rows.indexOf(item) }, `${kinds[item.kind]}${item.rounds > 1 ? ` ${item.round}` : ""}: ${item.title.slice(0, 60)}`)), ...plays,
      made("option", { value: "wall" }, worded("The wall")));
    own.hidden = true;
  }

  function openChosen() {
    const chosen = items.value;
    joining = false;
    if (chosen === "wall") tell({ do: "open", kind: "wall", about: "", round: 1 });
    else if (chosen === `game ${OWN}`) {
      if (own.hidden || !own.value.trim()) {
        own.hidden = false;
        own.focus();
      } else tell({ do: "begin", what: own.value });
    } else if (chosen.startsWith("game ")) tell({ do: "begin", what: chosen.slice(5) });
    else {
      const { kind, about, round } = rows[Number(chosen)];
      tell({ do: "open", kind, about, round });
    }
  }

  const isQuestion = () => state.current && state.current.kind !== "wall";
  const toggleShown = () => isQuestion() && tell({ do: "show", ...named(), on: !state.current.shown });
  const toggleClosed = () => isQuestion() && tell({ do: state.current.status === "closed" ? "open" : "close", ...named() });
  const toggleJoin = () => {
    joining = !joining;
    show();
  };

  const hasNext = () => state.current && (state.current.kind === "game" ? !state.current.last : state.current.round < state.current.rounds);
  const next = () => tell({ do: "open", ...named(), round: state.current.round + 1 });

  // What a remote control does: open, show, close, and then the second vote or the next step.
  function advance() {
    const { current } = state;
    if (!current) return openChosen();
    if (current.kind === "wall") return tell({ do: "finish" });
    if (!current.shown) return toggleShown();
    if (current.status !== "closed") return toggleClosed();
    if (hasNext()) return next();
    const at = rows.findIndex((each) => each.kind === current.kind && each.about === current.about && each.round === current.round);
    if (at >= 0 && at + 1 < rows.length) choose(at + 1);
    return tell({ do: "finish" });
  }

  function choose(at) {
    lessons.value = rows[at].lesson;
    offer();
    items.value = String(at);
  }

  function tool(name, text, key, done) {
    buttons[name] = made("button", { type: "button", onclick: done, "aria-keyshortcuts": key, title: `${text} (${key})` }, text);
    return buttons[name];
  }

  tools.append(lessons, items, tool("open", worded("Open"), "O", openChosen), tool("show", worded("Show"), "S", toggleShown), tool("close", worded("Close"), "C", toggleClosed),
    tool("next", worded("Next"), "N", () => hasNext() && next()), tool("finish", worded("Finish"), "F", () => tell({ do: "finish" })), tool("join", worded("Code"), "J", toggleJoin), own, said);

  function showTools() {
    const { current } = state;
    for (const name of ["show", "close"]) buttons[name].disabled = !current || current.kind === "wall";
    buttons.finish.disabled = !current;
    buttons.next.disabled = !hasNext();
    buttons.next.textContent = current?.kind === "game" ? worded("Next step") : worded("Second vote");
    buttons.show.textContent = current?.shown ? worded("Hide") : worded("Show");
    buttons.close.textContent = current?.status === "closed" ? worded("Open again") : worded("Close");
    buttons.join.setAttribute("aria-pressed", String(joining));
  }

  const KEYS = { ArrowRight: advance, PageDown: advance, ArrowLeft: () => state.current?.shown && toggleShown(), PageUp: () => state.current?.shown && toggleShown(),
    o: openChosen, s: toggleShown, c: toggleClosed, j: toggleJoin, f: () => tell({ do: "finish" }), n: () => hasNext() && next() };
  function keyed(event) {
    const done = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key], typing = /^(TEXTAREA|SELECT|INPUT)$/.test(/** @type {HTMLElement} */ (event.target).tagName);
    if (!done || typing || event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    event.preventDefault();
    done();
  }

  offer();
  lessons.value = plan[0]?.lesson === "00" ? "01" : plan[0]?.lesson; // the lesson before the first is a glance at all of them
  offer();
  show();
  return { hear, keyed, say: (text) => (said.textContent = text) };
}
