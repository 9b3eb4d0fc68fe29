// The question of a prediction, with its box. What answers it is not here: the model is told when it may be seen.

import { freshId, made } from "../views/controls.js";
import { translated, question, tellModel } from "./asking.js";
import { prose } from "./prose.js";

export function askForPrediction({ model, el }) {
  return question(model, el, "prediction", ["revealed"], (root) => {
    const id = freshId(), status = made("p", { class: "lsys-said", role: "status", tabindex: -1 });
    const box = made("input", { type: "text", id, maxlength: 1000, autocomplete: "off", oninput: () => { show.disabled = !box.value.trim(); } });
    const reveal = (typed) => {
      tellModel(model, { typed, revealed: true }, status);
      if (!model.get("revealed")) return;
      status.focus();
    };
    const show = made("button", { type: "submit", disabled: true }, translated(model, "Show"));
    const unsure = made("button", { type: "button", onclick: () => reveal("") }, translated(model, "I have no idea, show me"));
    const form = made("form", { class: "lsys-predict", onsubmit: (event) => {
      event.preventDefault();
      if (box.value.trim()) reveal(box.value.trim());
    } }, box, show, unsure);
    root.append(made("label", { class: "lsys-asked", for: id }, prose(model.get("question"))), form, status);

    return () => {
      if (!model.get("revealed")) return;
      const typed = model.get("typed");
      form.hidden = true;
      const mine = () => [`${translated(model, "You said:")} `, made("b", { class: "mathjax_ignore tex2jax_ignore" }, typed)];
      status.replaceChildren(...(typed ? mine() : [translated(model, "You wanted to see it.")]));
    };
  });
}
