// A vote: a question and four buttons. Which is right, the model says, and only the second time.

import { LETTERS } from "../drawing/constants.js";
import { freshId, made, worded } from "../views/controls.js";
import { againButton, predictedBeside, prose, question, tellModel } from "./asking.js";

const NONE = -1;
const VERDICTS = { "Right": ["✓", "lsys-right"], "Not right": ["✗", "lsys-wrong"] };

export function askForVote({ model, el }) {
  return question(model, el, "vote", ["chosen", "said"], (root) => {
    const { question: text, options, picture, described } = model.get("asked"), id = freshId();
    const status = made("div.lsys-said", { role: "status" });
    const before = made("p.lsys-before"), predicted = made("details.lsys-predicted");
    const again = againButton(() => tellModel(model, { chosen: NONE }, status));
    const buttons = options.map((option, number) => made("button.lsys-option", {
      type: "button", "aria-pressed": "false",
      onclick: () => tellModel(model, { chosen: number }, status),
    }, made("b.lsys-letter", LETTERS[number]), prose(option)));
    root.append(made("p.lsys-asked", { id }, prose(text)));
    if (picture) root.append(made("img.lsys-mystery", { src: picture, alt: described }));
    root.append(before, predicted, made("div.lsys-options", { role: "group", "aria-labelledby": id }, ...buttons), status, again);

    return () => {
      const chosen = model.get("chosen"), said = model.get("said"), [sign, looks] = VERDICTS[said.verdict] ?? ["", ""];
      buttons.forEach((button, number) => button.setAttribute("aria-pressed", String(number === chosen)));
      before.textContent = said.before ?? "";
      before.hidden = !said.before;
      again.hidden = chosen === NONE;
      showPredictions(predicted, said.predicted ?? []);
      status.className = `lsys-said ${looks}`.trim();
      status.replaceChildren();
      if (sign) status.append(made("b", `${sign} ${worded(said.verdict)}. `));
      if (said.text) status.append(prose(said.text));
      if (said.changed) status.append(made("p", said.changed));
    };
  });
}

// What was predicted in the lesson, folded: each question, what was said, and what came out.
function showPredictions(element, predicted) {
  element.hidden = !predicted.length;
  const known = predicted.filter(({ right }) => right !== undefined), right = known.filter((each) => each.right).length;
  const count = worded("{right} of {number} came out as you said", { right, number: known.length });
  element.replaceChildren(made("summary", `${worded("What you predicted in this lesson")} (${count})`),
    made("ul", ...predicted.map(({ question: text, typed, ...outcome }) => made("li", made("div", prose(text)), ...predictedBeside(typed, outcome)))));
}

export default { render: askForVote };
