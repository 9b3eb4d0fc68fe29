// Letters in place of the numbers of constants: the switches beside their sliders, and a book whose modules are named by formulas.
// A page without letters has none of this.

import { button, worded } from "./controls.js";

const MATHML = "http://www.w3.org/1998/Math/MathML";

// The switches of the sliders of constants. A page holds formulas with all its letters alone, so that there they are switched together.
export function letterSwitches(host, constants) {
  const { lettered = [], letters: first = [], joint } = host.get("model"), chosen = () => host.get("letters") ?? [];
  const switches = constants.flatMap(({ name, control }) => {
    if (!lettered.includes(name)) return [];
    const hint = worded("{name} as a letter: formulas in place of numbers", { name }), toggled = () => host.set("letters", others(name));
    const element = button("x²", hint, toggled, { "aria-label": hint, class: "lsys-button lsys-letter" });
    control.element.prepend(element);
    return [{ name, element }];
  });

  function others(name) {
    if (joint) return chosen().length ? [] : first;
    return chosen().includes(name) ? chosen().filter((each) => each !== name) : [...chosen(), name];
  }

  const show = () => switches.forEach(({ name, element }) => element.setAttribute("aria-pressed", String(chosen().includes(name))));
  show();
  return { show, reset: () => switches.length && host.set("letters", first) };
}

// The data of a book whose modules and stages are named by formulas: of a state its values, its text, its formula, and its numbers.
export function withFormulas(data) {
  const states = data.states.map((row, state) => {
    const [formula, values, text, numbers] = data.formulas[state] || [];
    return formula ? [row[0], values, row[2], text, formula, ` (${numbers})`] : row;
  });
  const places = data.net.places.map((place) => ({ ...place, values: place.formula ?? place.values }));
  return { ...data, states, net: { ...data.net, places }, held: data.conditions };
}

// A formula as MathML: an element is a list, its name and what is in it; in it a text is a number, a name or a sign.
export function maths(formula, text) {
  const whole = element("math", formula);
  whole.setAttribute("alttext", text);
  return whole;
}

function element(name, ...parts) {
  const found = document.createElementNS(MATHML, name);
  found.append(...parts.map((part) => (Array.isArray(part) ? element(part[0], ...part.slice(1)) : leaf(part))));
  return found;
}

function leaf(text) {
  const found = document.createElementNS(MATHML, /^[\d.]/.test(text) ? "mn" : /^\p{L}/u.test(text) ? "mi" : "mo");
  if (/[()]/.test(text)) found.setAttribute("stretchy", "false");
  found.append(text);
  return found;
}
