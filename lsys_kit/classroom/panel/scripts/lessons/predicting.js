// The question of a prediction, with its box. What answers it is not here: the model is told when it may be seen.

import { freshId, made, worded } from "../views/controls.js";
import { prose, question, tellModel } from "./asking.js";

export function askForPrediction({ model, el }) {
  return question(model, el, "prediction", ["revealed"], (root) => {
    const id = freshId(), status = made("p.lsys-said", { role: "status", tabindex: -1 });
    const box = made("input", { type: "text", id, maxlength: 1000, autocomplete: "off", oninput: () => { show.disabled = !box.value.trim(); } });
    const reveal = (typed) => {
      tellModel(model, { typed, revealed: true }, status);
      if (model.get("revealed")) status.focus();
    };
    const show = made("button", { type: "submit", disabled: true }, worded("Show"));
    const unsure = made("button", { type: "button", onclick: () => reveal("") }, worded("I have no idea, show me"));
    const form = made("form.lsys-predict", { onsubmit: (event) => {
      event.preventDefault();
      if (box.value.trim()) reveal(box.value.trim());
    } }, box, show, unsure);
    root.append(made("label.lsys-asked", { for: id }, prose(model.get("question"))), form, status);

    return () => {
      if (!model.get("revealed")) return;
      const typed = model.get("typed");
      form.hidden = true;
      if (typed) status.replaceChildren(`${worded("You said:")} `, made("b.mathjax_ignore.tex2jax_ignore", typed));
      else status.replaceChildren(worded("You wanted to see it."));
    };
  });
}

export default { render: askForPrediction };
