// A vote: a question and four buttons. Which is right, the model says, and only the second time.

import { LETTERS } from "../drawing/constants.js";
import { freshId, made, worded } from "../views/controls.js";
import { prose, question, tellModel } from "./asking.js";

const VERDICTS = { "Right": ["✓", "lsys-right"], "Not right": ["✗", "lsys-wrong"] };

export function askForVote({ model, el }) {
  return question(model, el, "vote", ["chosen", "said"], (root) => {
    const { question: text, options, picture, described } = model.get("asked"), id = freshId();
    const status = made("div.lsys-said", { role: "status" });
    const before = made("p.lsys-before");
    const buttons = options.map((option, number) => made("button.lsys-option", {
      type: "button", "aria-pressed": "false",
      onclick: () => tellModel(model, { chosen: number }, status),
    }, made("b.lsys-letter", LETTERS[number]), prose(option)));
    root.append(made("p.lsys-asked", { id }, prose(text)));
    if (picture) root.append(made("img.lsys-mystery", { src: picture, alt: described }));
    root.append(before, made("div.lsys-options", { role: "group", "aria-labelledby": id }, ...buttons), status);

    return () => {
      const chosen = model.get("chosen"), said = model.get("said"), [sign, looks] = VERDICTS[said.verdict] ?? ["", ""];
      buttons.forEach((button, number) => button.setAttribute("aria-pressed", String(number === chosen)));
      before.textContent = said.before ?? "";
      before.hidden = !said.before;
      status.className = `lsys-said ${looks}`.trim();
      status.replaceChildren();
      if (sign) status.append(made("b", `${sign} ${worded(said.verdict)}. `));
      if (said.text) status.append(prose(said.text));
      if (said.changed) status.append(made("p", said.changed));
    };
  });
}

export default { render: askForVote };
