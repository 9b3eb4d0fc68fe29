// A page of the course on the server of a class: rules can be edited, exercises are answered, and the class hears of votes.

import { openCoursePage } from "../course.js";
import { askForAnswer, practise } from "../lessons/exercises.js";
import { askingHost } from "../panels/asking_host.js";
import { made, speak, worded } from "../views/controls.js";
import { askKit, classConnection, nextNumber } from "./outbox.js";

export function openClassPage() {
  speak(JSON.parse(document.getElementById("lsys-data").textContent).words);
  const [, code] = location.pathname.split("/"), base = `/${code}/`, [, name = ""] = /\/notebooks\/(\w+)\.html$/.exec(location.pathname) ?? [];
  const lesson = /^\d\d_/.test(name) ? name.slice(0, 2) : name;
  const banner = made("a.class-banner", { href: base, hidden: true });
  const status = made("p.class-status", { role: "status" });
  const skip = document.querySelector("body > .skip"), bar = made("nav.class-bar", { "aria-label": worded("The class") }, made("a", { href: base }, worded("The class")), status, banner);
  if (skip) skip.after(bar);
  else document.body.prepend(bar);
  const connection = classConnection(base, code, {
    linked: (isThere) => (status.textContent = isThere ? "" : worded("not connected: it is tried again, and nothing is lost")),
    state({ current }) {
      banner.hidden = !current || (current.page && location.pathname.endsWith(current.page));
      banner.textContent = worded("A question is open: answer it");
    },
    told: (message, answer) => (status.textContent = answer.kept ? `✓ ${worded("kept")}` : answer.later ? worded("Not kept yet: it is sent again by itself.") : ""),
  });
  const ask = (question) => askKit(base, question);
  openCoursePage({
    hostWith: (data) => askingHost(data, ask, { keeps: ["svg", "page", "link", "wall"], keep: (kind, question) => kept(kind, question, ask, code), soon: (act) => setTimeout(act, 300) }),
    told: (kind, asked, round, value) => lesson && connection.tell(kind, lesson, round, value, { asked }),
    exercise: (place, data) => askForAnswer(place, data, (question) => ask({ ...question, kind: "check", id: data.id, sent: nextNumber(code) })),
    practice: (place, data) => practise(place, data, ask, true),
  });
}

// Take something along from a panel, or send its drawing to the wall.
async function kept(kind, question, ask, code) {
  if (kind !== "wall") return ask({ ...question, what: kind });
  const { text = "" } = await ask({ ...question, what: "link" }), answer = await ask({ kind: "plant", text, sent: nextNumber(code) });
  return answer.mistake ? answer : { said: worded("sent to the wall") };
}
