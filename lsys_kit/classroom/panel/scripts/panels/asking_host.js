// The host of a panel on a page of the course whose rules can be edited, since there is somebody who answers: a class, or Python in the page.

import { hostWith, store } from "../page.js";

const SEEN = ["step", "angle", "around", "above", "seed", "mark", "settings"];

// The host of a panel: what the page itself holds is at hand, and for all else `ask` asks. What can be kept is in `keeps`, and `keep` keeps
// it, given its kind and a question that says how the panel stands; `soon` calls a function when there is somebody to ask.
export const askingHost = async (data, ask, how) => hostOf(await hostWith(data, false), data, ask, how);

// The host of a panel of which the page holds nothing: `opened` is what was answered to a question of the kind "open".
export function openedHost({ model, values, system }, ask, how) {
  const held = { get: (name) => (name === "model" ? model : values[name]), book: async () => ({}) };
  return hostOf(held, { model: { constants: [] }, system: { ...system, title: model.book.title } }, ask, how);
}

function hostOf(held, data, ask, { keeps, keep, soon }) {
  const values = Object.fromEntries(["model", ...SEEN].map((name) => [name, held.get(name)]));
  const { get, set, on, tell } = store(values);
  const { title, file } = values.model.book;
  let { system } = data, first = true;
  const titleOf = ({ text }) => (text === data.system.text ? title.split(":")[0] : ""); // other rules are another system
  const panel = () => ({ ...system, title: titleOf(system), without: values.model.without, unfold: values.model.unfold, show: values.model.show, ...Object.fromEntries(SEEN.map((name) => [name, values[name]])) });

  // Another model, and what is chosen in it: all of it is there before anybody hears of it.
  function adopt({ model, values: chosen, system: read }) {
    system = read;
    Object.assign(values, chosen, { model });
    for (const name of ["model", ...SEEN]) tell(name);
  }

  async function rules(text, constants) {
    const answer = await ask({ kind: "rules", text, constants, panel: panel() });
    if (answer.mistake) return answer;
    first = false;
    answer.model.book.title = titleOf(answer.system);
    adopt(answer);
    return { opened: true };
  }

  async function book(wanted) {
    const own = first ? await held.book(wanted) : {};
    return own.book ? own : ask({ kind: "book", ...wanted, panel: panel() });
  }

  // The page holds the sliders for which it has room; whoever is asked has them all.
  async function allSliders() {
    const before = values.model, answer = await ask({ kind: "open", panel: { ...panel(), ...data.fixed, settings: { ...data.fixed, ...values.settings } } });
    if (answer.model && values.model === before && first) adopt({ ...answer, values: Object.fromEntries(SEEN.map((name) => [name, name === "settings" ? answer.values.settings : values[name]])) });
  }

  if (data.model.fixed || data.model.constants.length || data.model.chance) soon(allSliders);
  return {
    get, set, on, save: () => {}, book, rules, notice: () => null, file,
    keep: (kind, state) => keep(kind, { kind: "keep", state, panel: panel() }),
    variants: () => ask({ kind: "variants", panel: panel() }),
    keeps, editable: true, ahead: false,
  };
}
