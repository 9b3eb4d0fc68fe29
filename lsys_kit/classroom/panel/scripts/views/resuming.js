// Rules that were typed, kept in the browser: where a cell is run again, or Python was restarted, they are offered once more. Where
// a panel that lives on is shown again, they stand there at once.

import { button, made, worded } from "./controls.js";
import { remember, remembered } from "./folding.js";

const NAME = "typed", MOST = 20, LONGEST = 50_000; // texts, and characters of each

// `put` is called with rules that are taken up.
export function resuming(put) {
  const element = made("div.lsys-offer", { role: "status", hidden: true });
  let first = null, where = "";

  const isMine = ([there, over]) => there === where && over === first;
  const entry = () => kept().find(isMine);
  const answer = (face, hint, done) => button(face, hint, () => {
    element.hidden = true;
    done();
  });

  return {
    element,
    // The rules with which a panel was opened, where it stands, and the rules that it shows: from now on what is typed is kept, and
    // what was typed before is offered. Given back is what stands there.
    open(opened, standing, text) {
      if (first !== null) return text;
      [first, where] = [opened, standing || placeOf(element)];
      const [, , before, read] = entry() ?? [];
      if (before === undefined || read === text) return before ?? text;
      element.hidden = false;
      element.append(worded("You had changed the rules here."),
        answer(worded("take up my rules"), worded("put the rules that you typed before into the panel"), () => put(before)),
        answer(worded("leave them"), worded("forget the rules that you typed before"), () => entry()?.[2] === before && keep(first)));
      return text;
    },
    keep,
  };

  // Keep a text, and as what it was read, once it is.
  function keep(text, read = "") {
    if (text.length > LONGEST || read.length > LONGEST) return;
    remember(NAME, JSON.stringify([...(text === first ? [] : [[where, first, text, read]]), ...kept().filter((each) => !isMine(each))].slice(0, MOST)));
  }
}

// Where a panel stands whose cell has no id: the page, the part of it, and the side.
function placeOf(element) {
  const part = /** @type {HTMLElement | null} */ (element.closest("[data-part]"))?.dataset.part ?? "", side = element.closest(".lsys-side")?.previousElementSibling ? "right" : "";
  return `${location.pathname.split("/").at(-1)} ${part}${side}`;
}

// All that is kept, the latest first: where the panel stands, the rules with which it was opened, those that were typed, and as what
// they were read.
function kept() {
  try {
    const found = JSON.parse(remembered(NAME) ?? "[]");
    return Array.isArray(found) ? found.filter((each) => Array.isArray(each) && each.length === 4 && each.every((part) => typeof part === "string")) : [];
  } catch {
    return [];
  }
}
