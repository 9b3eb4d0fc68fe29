// The question of a prediction, with its box. What answers it is not here: the model is told when it may be seen.

import { freshId, made, worded } from "../views/controls.js";
import { afterPause, againButton, predictedBeside, prose, question, tellModel } from "./asking.js";

export function askForPrediction({ model, el }) {
  return question(model, el, "prediction", ["typed", "revealed", "outcome"], (root) => {
    const id = freshId(), status = made("div.lsys-said", { role: "status", tabindex: -1 });
    const keep = () => tellModel(model, { typed: box.value }, status), later = afterPause(keep);
    const box = made("input", { type: "text", id, maxlength: 1000, autocomplete: "off", onchange: keep, oninput: () => {
      show.disabled = !box.value.trim();
      later();
    } });
    const reveal = (typed) => {
      later.cancel();
      tellModel(model, { typed, revealed: true }, status);
      if (model.get("revealed")) status.focus();
    };
    const show = made("button", { type: "submit", disabled: true }, worded("Show"));
    const unsure = made("button", { type: "button", onclick: () => reveal("") }, worded("I have no idea, show me"));
    const again = againButton(() => {
      tellModel(model, { typed: "", revealed: false }, status);
      box.focus();
    });
    const form = made("form.lsys-predict", { onsubmit: (event) => {
      event.preventDefault();
      if (box.value.trim()) reveal(box.value.trim());
    } }, box, show, unsure);
    root.append(made("label.lsys-asked", { for: id }, prose(model.get("question"))), form, status, again);

    return () => {
      const revealed = model.get("revealed"), typed = model.get("typed");
      form.hidden = revealed;
      again.hidden = !revealed;
      if (document.activeElement !== box) box.value = typed;
      show.disabled = !box.value.trim();
      if (revealed) status.replaceChildren(...predictedBeside(typed, model.get("outcome")));
      else status.replaceChildren();
    };
  });
}

export default { render: askForPrediction };
