// A page of the course that holds the kit: rules can be edited and exercises are answered, by Python in the page, once it is asked.

import { openCoursePage } from "../course.js";
import { askForAnswer, practise } from "../lessons/exercises.js";
import { hasLink } from "../books/link.js";
import { numberOf } from "../page.js";
import { askingHost, openedHost } from "../panels/asking_host.js";
import { openPanel } from "../panels/panel.js";
import { made, speak, worded } from "../views/controls.js";
import { handingIn, keepTry } from "./handing_in.js";
import { keepOffline } from "./offline.js";
import { pythonIn } from "./python.js";

const ASKING = ["panel", "comparison", "beside", "exercise", "practice"]; // kinds of parts that may ask Python

export function openKitPage() {
  const { words, python, home, parts } = JSON.parse(document.getElementById("lsys-data").textContent);
  speak(words);
  const bar = barOf(() => kit.begin()), kit = pythonIn(python, home, bar.show), offline = keepOffline(home);
  kit.whenReady(async () => (await offline)?.());
  if (parts.some(({ kind, data }) => ASKING.includes(kind) || JSON.stringify(data).includes('"mode"'))) document.body.append(bar.element);
  const how = { keeps: ["link"], keep: (_, question) => linked(kit.ask({ ...question, what: "link" })), soon: kit.whenReady };
  addEventListener("hashchange", () => hasLink(location.href) && location.reload());
  openCoursePage({
    hostWith: (data) => askingHost(data, kit.ask, how),
    opened: (content) => openLinked(content, kit.ask, how),
    exercise: (place, data) => askForAnswer(place, data, (question) => kit.ask({ ...question, kind: "check", id: data.id }), (said, answer) => keepTry(data.id, said, answer)),
    practice: (place, data) => practise(place, data, kit.ask, false),
  });
  const ids = parts.flatMap(({ kind, data }) => (kind === "exercise" ? [data.id] : []));
  if (ids.length) document.querySelector("main").append(handingIn(ids));
}

// A panel, above all else, with the model that a link in the address leads to.
async function openLinked({ notation, text, settings: { step, angle, seed, letters, ...settings } }, ask, how) {
  const said = made("p.lsys-message", { role: "status" }, worded("The model of the link in the address is opened.")), here = made("div"), place = made("div.part.part-panel.kit-linked", said, here);
  document.querySelector("main").prepend(place);
  const chosen = { ...(step && { step: Number(step) }), ...(angle && { angle: numberOf(angle) }), ...(seed && { seed: Number(seed) }) };
  const opened = await ask({ kind: "open", panel: { notation, text, settings, ...chosen } });
  if (opened.mistake) said.textContent = `\u26a0 ${opened.mistake.message}. ${opened.mistake.hint}`;
  else {
    openPanel(here, openedHost(opened, ask, how));
    said.textContent = worded("This model came with the link in the address.");
  }
}

// A link of the kit as an address of this page.
async function linked(asked) {
  const answer = await asked;
  return answer.text ? { ...answer, text: location.href.split("#")[0] + answer.text } : answer;
}

// What is said of Python, at the lower edge of the window; `begin` starts it.
function barOf(begin) {
  const text = made("p", { role: "status" }), meter = made("progress", { max: 1, hidden: true, "aria-label": worded("Python is fetched") });
  const button = made("button", { type: "button", onclick: begin }, worded("Start it"));
  const element = made("aside.kit-bar", { "aria-label": "Python" }, text, meter, button), isFile = location.protocol === "file:";
  const said = {
    idle: () => (isFile ? worded("This page is a file: panels move, and votes and tables answer. Rules and exercises need a web server.") : worded("Python comes when rules or answers first need it: 15 MB.")),
    fetching: (part) => worded("Python is fetched: {percent} %", { percent: Math.round(100 * part) }),
    starting: () => worded("Python starts."),
    ready: () => worded("Python is there."),
    ended: (why) => worded("{why}. It starts anew; what was typed is still there.", { why }),
    absent: (why) => `\u26a0 ${worded("Python cannot start in this page")}. ${why}`,
  };
  function show(state, more) {
    const comes = ["fetching", "starting"].includes(state);
    if (!comes || element.dataset.state !== "ended") { // why it ended stays in sight until there is another one
      text.textContent = said[state](more);
      element.dataset.state = state;
    }
    meter.hidden = !comes && state !== "ended";
    if (state === "fetching") meter.value = more;
    else meter.removeAttribute("value");
    button.hidden = isFile || !["idle", "absent"].includes(state);
    button.textContent = state === "absent" ? worded("Try it again") : worded("Start it");
  }
  show("idle");
  return { element, show };
}
