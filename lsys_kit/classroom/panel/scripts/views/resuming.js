// Rules that were typed, kept in the browser: where a cell is run again, or Python was restarted, they are offered once more.

import { button, made, worded } from "./controls.js";
import { remember, remembered } from "./folding.js";

const NAME = "typed", MOST = 20, LONGEST = 50_000; // texts, and characters of each

// `put` is called with rules that are taken up.
export function resuming(put) {
  const element = made("div.lsys-offer", { role: "status", hidden: true });
  let first = null;

  const answer = (face, hint, done) => button(face, hint, () => {
    element.hidden = true;
    done();
  });

  return {
    element,
    // The rules with which a panel was opened: from now on what is typed over them is kept, and what was typed before is offered.
    open(text) {
      if (first !== null) return;
      first = text;
      const before = typedOver(first);
      if (before === null) return;
      element.hidden = false;
      element.append(worded("You had changed the rules here."),
        answer(worded("take up my rules"), worded("put the rules that you typed before into the panel"), () => put(before)),
        answer(worded("leave them"), worded("forget the rules that you typed before"), () => typedOver(first) === before && keep(first, first)));
    },
    keep: (text) => keep(first, text),
  };
}

const here = () => location.pathname.split("/").at(-1); // the name of the notebook

// All that is kept, the latest first: the notebook, the rules with which a panel was opened, and those that were typed.
function kept() {
  try {
    const found = JSON.parse(remembered(NAME) ?? "[]");
    return Array.isArray(found) ? found.filter((each) => Array.isArray(each) && each.length === 3 && each.every((part) => typeof part === "string")) : [];
  } catch {
    return [];
  }
}

const typedOver = (first) => kept().find(([where, over]) => where === here() && over === first)?.[2] ?? null;

function keep(first, text) {
  if (text.length > LONGEST) return;
  const others = kept().filter(([where, over]) => where !== here() || over !== first);
  remember(NAME, JSON.stringify([...(text === first ? [] : [[here(), first, text]]), ...others].slice(0, MOST)));
}
