// A vote: a question and four buttons. Which is right, the model says, and only the second time.

import { freshId, made } from "../views/controls.js";
import { translated, question, tellModel } from "./asking.js";
import { prose } from "./prose.js";

const LETTERS = "ABCD";

export function askForVote({ model, el }) {
  return question(model, el, "vote", ["chosen", "said"], (root) => {
    const { question: text, options, picture, described } = model.get("asked"), id = freshId();
    const status = made("div", { class: "lsys-said", role: "status" });
    const before = made("p", { class: "lsys-before" });
    const buttons = options.map((option, number) => made("button", {
      type: "button", class: "lsys-option", "aria-pressed": "false",
      onclick: () => tellModel(model, { chosen: number }, status),
    }, made("b", { class: "lsys-letter" }, LETTERS[number]), prose(option)));
    root.append(made("p", { class: "lsys-asked", id }, prose(text)));
    if (picture) root.append(made("img", { class: "lsys-mystery", src: picture, alt: described }));
    root.append(before, made("div", { class: "lsys-options", role: "group", "aria-labelledby": id }, ...buttons), status);

    return () => {
      const chosen = model.get("chosen"), said = model.get("said");
      buttons.forEach((button, number) => button.setAttribute("aria-pressed", String(number === chosen)));
      before.textContent = said.before ?? "";
      before.hidden = !said.before;
      status.className = said.verdict ? `lsys-said ${said.verdict === "Right" ? "lsys-right" : "lsys-wrong"}` : "lsys-said";
      status.replaceChildren();
      if (said.verdict) status.append(made("b", {}, `${said.verdict === "Right" ? "✓" : "✗"} ${translated(model, said.verdict)}. `));
      if (said.text) status.append(prose(said.text));
      if (said.changed) status.append(made("p", {}, said.changed));
    };
  });
}
