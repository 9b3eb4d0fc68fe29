// The words of an organism up to a step, and beside them all systems that fit. All steps are there beforehand: no kernel is asked.

import { saved } from "../panels/kernel.js";
import { freshId, made } from "../views/controls.js";
import { question } from "./asking.js";

export function showRules({ model, el }) {
  return question(model, el, "rules that fit", ["step"], (root) => {
    const { words, steps } = model.get("found"), id = freshId();
    const range = made("input", { type: "range", id, min: 1, max: steps.length, step: 1, oninput: () => {
      model.set("step", Number(range.value));
      saved(model);
    } });
    const number = made("span", { "aria-hidden": "true" }), status = made("p.lsys-asked", { role: "status" });
    const rows = words.map((word, step) => made("tr", made("th", { scope: "row" }, String(step)),
      made("td", code(word)), made("td", step ? steps[step - 1].count : "")));
    const seen = made("table", made("caption", "The words up to this step"),
      made("thead", made("tr", ...["step", "word", "systems that fit"].map((name) => made("th", { scope: "col" }, name)))),
      made("tbody", ...rows));
    const rules = made("div");
    root.append(made("div.lsys-steps", made("label", { for: id }, "Step"), range, number),
      made("div.lsys-found", made("div.lsys-scroll", seen), made("div", status, rules)));

    return () => {
      const step = model.get("step"), found = steps[step - 1];
      range.value = step;
      range.setAttribute("aria-valuetext", `step ${step} of ${steps.length}`);
      number.textContent = `${step} of ${steps.length}`;
      rows.forEach((row, place) => {
        row.hidden = place > step;
        row.toggleAttribute("data-last", place === step);
      });
      status.textContent = `${found.heading}${found.common.length || found.systems.length ? ":" : ""}`;
      rules.replaceChildren(...systems(found));
    };
  });
}

// The rules that all systems have, and then each system with its own, and with its word at the step at which they part.
function systems({ common, systems: each, more, parting, words, notes }) {
  const shown = [];
  if (common.length) shown.push(made("p", each.length ? "All have" : ""), lines(common));
  if (each.length) shown.push(made("ol", ...each.map((own, number) => made("li", lines(own), ...later(parting, words[number])))));
  if (more) shown.push(made("p", `and ${more} more`));
  return [...shown, ...notes.map((note) => made("p.lsys-before", note))];
}

function later(parting, word) {
  if (!word) return [];
  return [made("p", `Its step ${parting}: `, made("code", word[0], made("mark", word[1])))];
}

const lines = (rules) => made("div.lsys-rules", ...rules.map(code));

const code = (text) => made("code.mathjax_ignore.tex2jax_ignore", text);

export default { render: showRules };
